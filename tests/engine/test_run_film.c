// The films' history in runs: each frame's film, lambda, real area and friction are of one state,
// that of its own transient film, with asperities in it or beside.
#include "engine/valve/run/run_private.h"
#include "tests/engine/models.h"

#include <glib.h>
#include <math.h>

#define TRANSIENT                                                                                  \
  {SB_P_MODELS_FILM, SB_FILM_REYNOLDS}, {SB_P_MODELS_FILM_TIME, 1}, {                              \
    SB_P_OUTPUT_FRAMES, 50                                                                         \
  }

// Frames of a press by hand in which a seal slides on its whole contact.
static void assert_frames(const SbRun *run, bool coupled) {
  const SbModel *model = run->model;
  size_t sliding = 0, apart = 0;
  for (size_t i = 0; i < run->count; i++) {
    const SbFrame *frame = &run->frames[i];
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      const SbSealFrame *s = &frame->seal[seal];
      if (s->land_fraction < 0.999F || !(fabs(s->friction_viscous) > 0)) {
        continue;
      }
      const double area = (s->contact_right - s->contact_left) * model->bore_circumference;
      const double boundary = model->shear_strength * s->real_area_share * area +
                              (coupled ? 0 : model->load_coefficient * s->load);
      g_assert_cmpfloat(fabs(fabs(s->friction_boundary) / boundary - 1), <, 1e-9);
      g_assert_cmpfloat(s->friction, ==, s->friction_boundary + s->friction_viscous);
      g_assert_cmpfloat(fabs(s->film_central / (model->sigma * s->lambda) - 1), <, 1e-12);
      // Couette's shear: beside, of the film at the middle; coupled, no more than of the least
      // film.
      const double shear = model->viscosity * fabs(frame->velocity) * area;
      const double viscous = fabs(s->friction_viscous);
      if (coupled) {
        g_assert_cmpfloat(viscous, <, 1.1 * shear / s->film_min);
      } else {
        const double middle = (1 - s->real_area_share) * shear / s->film_central;
        g_assert_cmpfloat(fabs(viscous / middle - 1), <, 1e-9);
      }
      const int way = frame->velocity < 0 ? SB_CYCLE_OUT : SB_CYCLE_IN;
      SbSealState steady;
      sb_run_state_at(&steady, (SbRun *)run, seal, frame->chamber, way, frame->velocity);
      sliding++;
      apart += fabs(s->film_central / steady.film_central - 1) > 0.05;
    }
  }
  g_test_message("%zu frames slide, %zu far from steady", sliding, apart);
  g_assert_cmpuint(sliding, >, 3);
  g_assert_cmpuint(apart, >, 1);
}

static void test_frames(void) {
  for (int coupled = 0; coupled < 2; coupled++) {
    const Setting settings[] = {TRANSIENT,
                                {SB_P_MODELS_ASPERITIES, coupled},
                                {SB_P_SURFACE_SIGMA, 0.2e-6},
                                {SB_P_FRICTION_LOAD_COEFFICIENT, coupled ? 0 : 0.19},
                                {SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC},
                                {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
                                {SB_P_DRIVE_PEAK_FORCE, coupled ? 150 : 45},
                                {SB_P_DRIVE_HOLD_TIME, 0.05},
                                {SB_P_DRIVE_FINGER_DAMPING, 100}};
    SbModel model;
    compile(&model, settings, G_N_ELEMENTS(settings));
    SbRun *run = run_of(&model, SB_OK, NULL);
    const SbSummary *summary = sb_run_summary(run);
    g_assert_cmpuint(summary->counters.film_steps, >, 0);
    assert_frames(run, coupled);
    sb_run_destroy(run);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/run-film/frames", test_frames);
  return g_test_run();
}
