// Fits a ring and runs the thesis' cycle by the installed library: fit_and_cycle SCENE.
#include <sealbench.h>
#include <stdio.h>

static int fail(SbScene *scene) {
  fprintf(stderr, "%s\n", scene != NULL ? sb_scene_message(scene) : "no memory");
  sb_scene_close(scene);
  return 1;
}

int main(int argc, char **argv) {
  static const char *const figure[] = {"seals.outer.load_N"};
  double load, force, peak = 0;
  SbSceneProfile profile;
  SbScene *scene;
  if (sb_scene_open(&scene, argc > 1 ? argv[1] : "") != SB_SCENE_OK ||
      sb_scene_set_text(scene, "models.fit", "ring") != SB_SCENE_OK ||
      sb_scene_evaluate(scene, NULL, NULL, 0, figure, 1, &load) != SB_SCENE_OK ||
      sb_scene_unset(scene, "models.fit") != SB_SCENE_OK || sb_scene_run(scene) != SB_SCENE_OK ||
      sb_scene_figure(scene, "cycle.stages.B.force_N", &force) != SB_SCENE_OK ||
      sb_scene_profile(scene, sb_scene_frame_count(scene) / 4, "outer", &profile) != SB_SCENE_OK) {
    return fail(scene);
  }
  for (size_t i = 0; i < profile.count; i++) {
    peak = profile.pressure[i] > peak ? profile.pressure[i] : peak;
  }
  printf("ring %.17g N, B %.17g N, peak %.17g Pa\n", load, force, peak);
  sb_scene_close(scene);
  return 0;
}
