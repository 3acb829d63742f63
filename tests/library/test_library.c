// The library through its header alone: files, keys and units, figures and reasons, frames and
// profiles, evaluation, callbacks, two scenes in two threads.
#include "sealbench.h"

#include <glib.h>
#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

static SbScene *open_scene(const char *name) {
  SbScene *scene;
  g_autofree char *path = g_build_filename(SB_ASSETS, name, NULL);
  SbSceneStatus status = sb_scene_open(&scene, path);
  if (status != SB_SCENE_OK) {
    g_error("%s", sb_scene_message(scene));
  }
  return scene;
}

static double figure(SbScene *scene, const char *path) {
  double value;
  g_assert_cmpint(sb_scene_figure(scene, path, &value), ==, SB_SCENE_OK);
  return value;
}

static void test_catalogues(void) {
  size_t parameters, figures, quantities;
  const SbParameterInfo *p = sb_list_parameters(&parameters);
  const SbFigureInfo *f = sb_list_figures(&figures);
  const SbFigureInfo *q = sb_list_quantities(&quantities);
  g_assert_cmpuint(parameters, >, 150);
  g_assert_cmpuint(figures, >, 70);
  g_assert_cmpuint(quantities, ==, 35);
  SbScene *scene;
  g_assert_cmpint(sb_scene_new(&scene), ==, SB_SCENE_OK);
  for (size_t i = 0; i < parameters; i++) {
    double value;
    g_assert_cmpint(sb_scene_get(scene, p[i].key, &value), ==, SB_SCENE_OK);
    g_assert_nonnull(sb_scene_get_text(scene, p[i].key));
    g_assert_true(p[i].help[0] != '\0' && p[i].unit[0] != '\0');
  }
  g_assert_cmpstr(f[0].key, ==, "cycle.force_peak_N");
  g_assert_cmpstr(q[0].key, ==, "time_s");
  g_assert_true(SB_LIBRARY_AT_LEAST(0, 1, 0) && !SB_LIBRARY_AT_LEAST(99, 0, 0));
  g_autofree char *version = g_strdup_printf("%d.%d.%d", SB_LIBRARY_VERSION_MAJOR,
                                             SB_LIBRARY_VERSION_MINOR, SB_LIBRARY_VERSION_MICRO);
  g_assert_cmpstr(sb_library_version(), ==, version);
  sb_scene_close(scene);
  sb_scene_close(NULL);
}

static void test_parameters(void) {
  SbScene *scene = open_scene("valves/piston.valve");
  double value;
  g_assert_cmpint(sb_scene_set_text(scene, "seal.section_diameter", "1.63 mm"), ==, SB_SCENE_OK);
  g_assert_cmpint(sb_scene_get(scene, "seal.section_diameter", &value), ==, SB_SCENE_OK);
  g_assert_cmpfloat(value, ==, 1.63e-3);
  g_assert_cmpint(sb_scene_set(scene, "seal.section_diameter", 1.65e-3), ==, SB_SCENE_OK);
  g_assert_cmpstr(sb_scene_get_text(scene, "seal.section_diameter"), ==, "1.65 mm");
  g_assert_cmpint(sb_scene_unset(scene, "seal.section_diameter"), ==, SB_SCENE_OK);
  // Refused: the value stays, the message names key and range.
  static const struct {
    const char *key, *text;
    double value;
    SbSceneStatus status;
    const char *says;
  } bad[] = {
      {"gland.radial_space", "9 m", 0, SB_SCENE_ERROR_INPUT, "0.1 to 20 mm"},
      {"gland.radial_space", NULL, 9, SB_SCENE_ERROR_RANGE, "0.0001 to 0.02 (m)"},
      {"gland.radial_space", NULL, NAN, SB_SCENE_ERROR_INPUT, "finite"},
      {"gland.radial_space", "1.3", 0, SB_SCENE_ERROR_INPUT, "unit"},
      {"models.fit", "rung", 0, SB_SCENE_ERROR_INPUT, "ring"},
      {"models.fit", NULL, 0.5, SB_SCENE_ERROR_INPUT, "whole"},
      {"gland.radius", "1 mm", 0, SB_SCENE_ERROR_INPUT, "gland.radius"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
    SbSceneStatus status = bad[i].text != NULL ? sb_scene_set_text(scene, bad[i].key, bad[i].text)
                                               : sb_scene_set(scene, bad[i].key, bad[i].value);
    g_assert_cmpint(status, ==, bad[i].status);
    g_assert_cmpstr(sb_scene_message_key(scene), ==, bad[i].key);
    g_assert_nonnull(strstr(sb_scene_message(scene), bad[i].key));
    if (strstr(sb_scene_message(scene), bad[i].says) == NULL) {
      g_error("%s", sb_scene_message(scene));
    }
  }
  g_assert_cmpint(sb_scene_get(scene, "gland.radial_space", &value), ==, SB_SCENE_OK);
  g_assert_cmpfloat(value, ==, 1.36e-3);
  g_assert_cmpint(sb_scene_get(scene, "gland.radius", &value), ==, SB_SCENE_ERROR_INPUT);
  g_assert_true(isnan(value));
  g_assert_null(sb_scene_get_text(scene, "gland.radius"));
  // Each in its range, and not together.
  g_assert_cmpint(sb_scene_set_text(scene, "stem.pressure_diameter", "7 mm"), ==, SB_SCENE_OK);
  g_assert_cmpint(sb_scene_run(scene), ==, SB_SCENE_ERROR_INPUT);
  g_assert_cmpstr(sb_scene_message_key(scene), ==, "bore.diameter");
  g_assert_cmpuint(sb_scene_frame_count(scene), ==, 0);
  sb_scene_close(scene);
}

// A scene whose file has errors computes nothing from defaults: the message names the error.
static void refuses_to_compute(SbScene *scene, const char *error) {
  static const char *const figures[] = {"seals.outer.load_N"};
  double value = 0;
  g_assert_cmpint(sb_scene_run(scene), ==, SB_SCENE_ERROR_INPUT);
  g_assert_nonnull(strstr(sb_scene_message(scene), error));
  g_assert_cmpuint(sb_scene_frame_count(scene), ==, 0);
  g_assert_cmpint(sb_scene_evaluate(scene, NULL, NULL, 0, figures, 1, &value), ==,
                  SB_SCENE_ERROR_INPUT);
  g_assert_true(isnan(value));
}

static void test_files(void) {
  static const char bad[] = "[sealbench]\nformat = 1\nkind = valve\n[gland]\nradial_spac = 1 mm\n"
                            "axial_width = 9 m\n";
  SbScene *scene;
  g_assert_cmpint(sb_scene_parse(&scene, bad, strlen(bad), NULL), ==, SB_SCENE_ERROR_INPUT);
  g_assert_nonnull(strstr(sb_scene_issue(scene, 0), "do you mean gland.radial_space"));
  g_assert_nonnull(strstr(sb_scene_issue(scene, 1), "0.2 to 50 mm"));
  g_assert_null(sb_scene_issue(scene, 2));
  g_assert_cmpstr(sb_scene_message(scene), ==, sb_scene_issue(scene, 0));
  refuses_to_compute(scene, "radial_spac");
  sb_scene_close(scene);
  g_assert_cmpint(sb_scene_open(&scene, "/nowhere.scene"), ==, SB_SCENE_ERROR_IO);
  g_assert_nonnull(strstr(sb_scene_message(scene), "/nowhere.scene"));
  refuses_to_compute(scene, "/nowhere.scene");
  sb_scene_close(scene);
  static const char no_valve[] = "[sealbench]\nformat = 1\nkind = scene\nvalve = missing.valve\n";
  g_assert_cmpint(sb_scene_parse(&scene, no_valve, strlen(no_valve), SB_ASSETS), ==,
                  SB_SCENE_ERROR_INPUT);
  refuses_to_compute(scene, "missing.valve");
  sb_scene_close(scene);
  static const struct {
    const char *lines, *error;
  } groups[] = {
      {"[cases]\na = seal.modulus\n", "seal.modulus"},
      {"[cases]\na = foo = 3\n", "foo: unknown key"},
      {"[cases]\na = stem.pressure_diameter = 7 mm\n", "bore.diameter"},
      {"[limits]\ncycle.foo = >= 1 N\n", "no such figure"},
      {"[pins]\na = foo = 3\n", "foo: unknown key"},
      // Where another error hides what the case's values give, its line is read all the same.
      {"[gland]\nradial_space = 9 m\n[cases]\na = foo = 3\n", "foo: unknown key"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(groups); i++) {
    g_autofree char *text = g_strdup_printf("[sealbench]\nformat = 1\nkind = scene\nvalve = "
                                            "valves/piston.valve\n%s",
                                            groups[i].lines);
    g_assert_cmpint(sb_scene_parse(&scene, text, strlen(text), SB_ASSETS), ==,
                    SB_SCENE_ERROR_INPUT);
    const int at = i == G_N_ELEMENTS(groups) - 1 ? 1 : 0;
    g_assert_nonnull(sb_scene_issue(scene, (size_t)at));
    g_assert_nonnull(strstr(sb_scene_issue(scene, (size_t)at), groups[i].error));
    refuses_to_compute(scene, at == 1 ? "radial_space" : groups[i].error);
    sb_scene_close(scene);
  }
  static const char good[] = "[sealbench]\nformat = 1\nkind = scene\ntitle = Ours\n"
                             "valve = valves/piston.valve\n[drive]\nspeed = 10 mm/s\n";
  g_assert_cmpint(sb_scene_parse(&scene, good, strlen(good), SB_ASSETS), ==, SB_SCENE_OK);
  g_assert_cmpstr(sb_scene_title(scene), ==, "Ours");
  g_assert_null(sb_scene_issue(scene, 0));
  sb_scene_close(scene);
}

static void test_run(void) {
  SbScene *scene = open_scene("scenes/thesis-cycle.scene");
  double value;
  g_assert_cmpint(sb_scene_figure(scene, "cycle.force_peak_N", &value), ==, SB_SCENE_ERROR_INPUT);
  g_assert_cmpint(sb_scene_run(scene), ==, SB_SCENE_OK);
  size_t count = sb_scene_frame_count(scene);
  g_assert_cmpuint(count, >, 100);
  g_autofree double *time = g_new(double, count);
  g_autofree double *force = g_new(double, count);
  g_assert_cmpint(sb_scene_frames(scene, "time_s", time), ==, SB_SCENE_OK);
  g_assert_cmpint(sb_scene_frames(scene, "force_N", force), ==, SB_SCENE_OK);
  double peak = 0, last = -1;
  for (size_t i = 0; i < count; i++) {
    g_assert_cmpfloat(time[i], >=, last);
    last = time[i];
    peak = fmax(peak, force[i]);
  }
  g_assert_cmpfloat_with_epsilon(peak, figure(scene, "cycle.force_peak_N"), 1e-9);
  // A quantity kept with single precision, and one that is not there.
  g_assert_cmpint(sb_scene_frames(scene, "seals.outer.pressure_left_Pa", force), ==, SB_SCENE_OK);
  g_assert_cmpfloat_with_epsilon(force[0], 0.55e6, 1);
  g_assert_cmpint(sb_scene_frames(scene, "force", force), ==, SB_SCENE_ERROR_INPUT);

  SbSceneProfile profile;
  g_assert_cmpint(sb_scene_profile(scene, count / 4, "outer", &profile), ==, SB_SCENE_OK);
  g_assert_cmpuint(profile.count, >, 50);
  double film = INFINITY;
  for (size_t i = 1; i < profile.count; i++) {
    g_assert_cmpfloat(profile.x[i], >=, profile.x[i - 1]);
    film = fmin(film, profile.film[i]);
  }
  g_assert_cmpfloat(fabs(film / figure(scene, "seals.outer.film_min_m") - 1), <, 0.02);
  g_assert_cmpint(sb_scene_profile(scene, count, "outer", &profile), ==, SB_SCENE_ERROR_INPUT);
  g_assert_cmpint(sb_scene_profile(scene, 0, "middle", &profile), ==, SB_SCENE_ERROR_INPUT);
  g_assert_cmpuint(profile.count, ==, 0);

  // Values or reasons, never neither.
  size_t figures;
  const SbFigureInfo *list = sb_list_figures(&figures);
  for (size_t i = 0; i < figures; i++) {
    g_assert_true(isnan(figure(scene, list[i].key)) ==
                  (sb_scene_reason(scene, list[i].key) != NULL));
  }
  g_assert_nonnull(sb_scene_warning(scene, 0));
  g_assert_nonnull(sb_scene_warning_code(scene, 0));
  g_assert_null(sb_scene_warning_code(scene, 1000));
  g_assert_null(sb_scene_warning(scene, 1000));
  // Changed and run again, the old results are gone.
  double before = figure(scene, "seals.outer.load_N");
  g_assert_cmpint(sb_scene_set_text(scene, "seal.section_diameter", "1.63 mm"), ==, SB_SCENE_OK);
  g_assert_cmpfloat(figure(scene, "seals.outer.load_N"), ==, before);
  g_assert_cmpint(sb_scene_run(scene), ==, SB_SCENE_OK);
  g_assert_cmpfloat(figure(scene, "seals.outer.load_N"), >, before);
  sb_scene_close(scene);
}

static void test_evaluate(void) {
  static const char *const keys[] = {"gland.radial_space", "models.film"};
  static const char *const paths[] = {"seals.outer.load_N", "cycle.force_breakaway_N",
                                      "seals.outer.asperity_load_share"};
  const double values[] = {1.38e-3, 3};
  SbScene *scene = open_scene("scenes/quick-look.scene");
  double out[3];
  g_assert_cmpint(sb_scene_run(scene), ==, SB_SCENE_OK);
  double load = figure(scene, "seals.outer.load_N");
  g_assert_cmpint(sb_scene_evaluate(scene, keys, values, 2, paths, 3, out), ==, SB_SCENE_OK);
  g_assert_true(isnan(out[2]));
  g_assert_nonnull(strstr(sb_scene_evaluation_reason(scene, paths[2]), "beside"));
  g_assert_null(sb_scene_evaluation_reason(scene, paths[0]));
  g_assert_cmpfloat(figure(scene, "seals.outer.load_N"), ==, load); // the run stands
  // The same scene, run.
  g_assert_cmpint(sb_scene_set(scene, keys[0], values[0]), ==, SB_SCENE_OK);
  g_assert_cmpint(sb_scene_set_text(scene, keys[1], "reynolds"), ==, SB_SCENE_OK);
  g_assert_cmpint(sb_scene_run(scene), ==, SB_SCENE_OK);
  g_assert_cmpfloat(figure(scene, paths[0]), ==, out[0]);
  g_assert_cmpfloat(figure(scene, paths[1]), ==, out[1]);
  // The codes of validity of an evaluation are its own.
  static const char *const space[] = {"gland.radial_space"};
  const double open = 1.6e-3;
  g_assert_cmpint(sb_scene_evaluate(scene, space, &open, 1, paths, 1, out), ==, SB_SCENE_OK);
  bool outside = false;
  const char *code;
  for (size_t i = 0; (code = sb_scene_evaluation_warning_code(scene, i)) != NULL; i++) {
    outside |= strcmp(code, "karaszkiewicz-squeeze") == 0;
    g_assert_nonnull(sb_scene_evaluation_warning(scene, i));
  }
  g_assert_true(outside);
  // Refused by key and range; by an unknown key, an unknown figure.
  const double far = 1;
  g_assert_cmpint(sb_scene_evaluate(scene, keys, &far, 1, paths, 3, out), ==, SB_SCENE_ERROR_RANGE);
  g_assert_nonnull(
      strstr(sb_scene_message(scene), "gland.radial_space: 1 is outside 0.0001 to 0.02"));
  g_assert_true(isnan(out[0]) && isnan(out[1]));
  static const char *const unknown[] = {"gland.space"};
  g_assert_cmpint(sb_scene_evaluate(scene, unknown, &far, 1, paths, 3, out), ==,
                  SB_SCENE_ERROR_INPUT);
  g_assert_cmpint(sb_scene_evaluate(scene, NULL, NULL, 0, unknown, 1, out), ==,
                  SB_SCENE_ERROR_INPUT);
  g_assert_cmpstr(sb_scene_message_key(scene), ==, "gland.space");
  sb_scene_close(scene);
}

typedef struct {
  double last;
  int told, asked, stop_after;
} Watch;

static void on_progress(void *data, double fraction) {
  Watch *watch = data;
  g_assert_cmpfloat(fraction, >=, watch->last);
  watch->last = fraction;
  watch->told++;
}

static int is_cancelled(void *data) {
  Watch *watch = data;
  return ++watch->asked > watch->stop_after;
}

// The verdict is the worst of the scene and its cases; a run without cases forgets it.
static void test_judge(void) {
  static const char text[] = "[sealbench]\nformat = 1\nkind = scene\nvalve = piston.valve\n"
                             "[limits]\ncycle.force_breakaway_N = <= 40 N\n"
                             "[cases]\ntight = gland.radial_space = 1.2 mm\n"
                             "wide = gland.radial_space = 1.5 mm\n";
  static const char *const question[] = {"seals", "presses", "returns", "doses", "leak", "fits"};
  SbScene *scene;
  Watch watch = {.stop_after = G_MAXINT};
  g_assert_cmpint(sb_scene_parse(&scene, text, strlen(text), SB_ASSETS "/valves"), ==, SB_SCENE_OK);
  sb_scene_callbacks(scene, on_progress, is_cancelled, &watch);
  g_assert_null(sb_scene_verdict(scene, 0));
  g_assert_cmpint(sb_scene_judge(scene), ==, SB_SCENE_OK);
  g_assert_cmpfloat(watch.last, ==, 1);
  for (size_t i = 0; i < G_N_ELEMENTS(question); i++) {
    g_assert_cmpstr(sb_scene_verdict(scene, i)->question, ==, question[i]);
  }
  g_assert_null(sb_scene_verdict(scene, G_N_ELEMENTS(question)));
  const SbSceneVerdict *returns = sb_scene_verdict(scene, 2);
  g_assert_cmpint(returns->ok, ==, 0);
  g_assert_cmpstr(returns->of_case, ==, "tight");
  g_assert_cmpstr(returns->figure, ==, "cycle.force_return_margin_N");
  g_assert_cmpfloat(returns->value, <, 0);
  g_assert_cmpfloat(figure(scene, "cycle.force_return_margin_N"), >, returns->value);
  watch = (Watch){.stop_after = G_MAXINT};
  g_assert_cmpint(sb_scene_run(scene), ==, SB_SCENE_OK);
  g_assert_null(sb_scene_verdict(scene, 0));
  watch = (Watch){.stop_after = 5};
  g_assert_cmpint(sb_scene_judge(scene), ==, SB_SCENE_ERROR_CANCELLED);
  g_assert_null(sb_scene_verdict(scene, 0));
  sb_scene_close(scene);
}

static void test_callbacks(void) {
  Watch watch = {.stop_after = G_MAXINT};
  SbScene *scene = open_scene("scenes/thesis-cycle.scene");
  sb_scene_callbacks(scene, on_progress, is_cancelled, &watch);
  g_assert_cmpint(sb_scene_run(scene), ==, SB_SCENE_OK);
  g_assert_cmpfloat(watch.last, ==, 1);
  g_assert_cmpint(watch.told, >, 3);
  g_assert_cmpint(watch.asked, >, 10);
  watch = (Watch){.stop_after = 5};
  g_assert_cmpint(sb_scene_run(scene), ==, SB_SCENE_ERROR_CANCELLED);
  g_assert_true(isnan(figure(scene, "cycle.force_peak_N")));
  g_assert_nonnull(sb_scene_reason(scene, "cycle.force_peak_N"));
  static const char *const path[] = {"cycle.force_peak_N"};
  double value;
  watch = (Watch){.stop_after = 5};
  g_assert_cmpint(sb_scene_evaluate(scene, NULL, NULL, 0, path, 1, &value), ==,
                  SB_SCENE_ERROR_CANCELLED);
  g_assert_true(isnan(value));
  sb_scene_callbacks(scene, NULL, NULL, NULL);
  g_assert_cmpint(sb_scene_run(scene), ==, SB_SCENE_OK);
  sb_scene_close(scene);
}

// Messages of some failures, a line each. Owned by the caller.
static char *messages(void) {
  SbScene *scene;
  g_assert_cmpint(sb_scene_open(&scene, "/nowhere.scene"), ==, SB_SCENE_ERROR_IO);
  g_autoptr(GString) text = g_string_new(sb_scene_message(scene));
  sb_scene_close(scene);
  scene = open_scene("scenes/quick-look.scene");
  (void)sb_scene_set(scene, "gland.radial_space", 1.5);
  g_string_append_printf(text, "\n%s", sb_scene_message(scene));
  (void)sb_scene_set_text(scene, "gland.radial_space", "2,5 mm");
  g_string_append_printf(text, "\n%s", sb_scene_message(scene));
  (void)sb_scene_set_text(scene, "bore.diameter", "5.5 mm");
  (void)sb_scene_run(scene);
  g_string_append_printf(text, "\n%s", sb_scene_message(scene));
  sb_scene_close(scene);
  return g_string_free(g_steal_pointer(&text), FALSE);
}

static void note_decimal(void *data, double fraction) {
  *(char *)data = localeconv()->decimal_point[0];
}

// A decimal comma changes nothing, and the texts are the same. Callbacks have the caller's locale.
static void test_locale(void) {
  g_autofree char *english = messages();
  g_assert_nonnull(strstr(english, "No such file"));
  if (setlocale(LC_ALL, "de_DE.UTF-8") == NULL) {
    g_test_skip("no German locale");
    return;
  }
  g_autofree char *german = messages();
  g_assert_cmpstr(german, ==, english);
  char decimal = 0;
  SbScene *called = open_scene("scenes/quick-look.scene");
  sb_scene_callbacks(called, note_decimal, NULL, &decimal);
  g_assert_cmpint(sb_scene_run(called), ==, SB_SCENE_OK);
  g_assert_cmpint(decimal, ==, ',');
  g_assert_cmpint(localeconv()->decimal_point[0], ==, ',');
  sb_scene_close(called);
  SbScene *scene = open_scene("scenes/quick-look.scene");
  double value;
  g_assert_cmpint(sb_scene_set_text(scene, "seal.modulus", "2.75 MPa"), ==, SB_SCENE_OK);
  g_assert_cmpint(sb_scene_get(scene, "seal.modulus", &value), ==, SB_SCENE_OK);
  g_assert_cmpfloat(value, ==, 2.75e6);
  g_assert_cmpstr(sb_scene_get_text(scene, "seal.modulus"), ==, "2.75 MPa");
  sb_scene_close(scene);
  setlocale(LC_ALL, "C.UTF-8");
}

enum { ROUNDS = 6 };

typedef struct {
  int first;
  double value[ROUNDS][2];
} Job;

static gpointer work(gpointer data) {
  Job *job = data;
  static const char *const key[] = {"gland.radial_space"};
  static const char *const path[] = {"seals.inner.film_central_m"};
  for (int n = 0; n < ROUNDS; n++) {
    int i = (n + job->first) % ROUNDS;
    SbScene *scene = open_scene("scenes/thesis-cycle.scene");
    double space = 1.33e-3 + 1e-5 * i;
    g_autofree char *text = g_strdup_printf("%.2f mm", 1e3 * space);
    g_assert_cmpint(sb_scene_set_text(scene, "gland.radial_space", text), ==, SB_SCENE_OK);
    g_assert_cmpint(sb_scene_run(scene), ==, SB_SCENE_OK);
    job->value[i][0] = figure(scene, "cycle.force_breakaway_N");
    g_assert_cmpint(sb_scene_evaluate(scene, key, &space, 1, path, 1, &job->value[i][1]), ==,
                    SB_SCENE_OK);
    sb_scene_close(scene);
  }
  return NULL;
}

// Two scenes in two threads, from the file to the figure, in different orders.
static void test_threads(void) {
  Job job[2] = {{.first = 0}, {.first = 3}};
  GThread *thread[2];
  for (int i = 0; i < 2; i++) {
    thread[i] = g_thread_new("scene", work, &job[i]);
  }
  for (int i = 0; i < 2; i++) {
    g_thread_join(thread[i]);
  }
  g_assert_cmpmem(job[0].value, sizeof job[0].value, job[1].value, sizeof job[1].value);
  g_assert_cmpfloat(job[0].value[0][0], >, job[0].value[ROUNDS - 1][0]);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/library/catalogues", test_catalogues);
  g_test_add_func("/library/parameters", test_parameters);
  g_test_add_func("/library/files", test_files);
  g_test_add_func("/library/run", test_run);
  g_test_add_func("/library/evaluate", test_evaluate);
  g_test_add_func("/library/judge", test_judge);
  g_test_add_func("/library/callbacks", test_callbacks);
  g_test_add_func("/library/locale", test_locale);
  g_test_add_func("/library/threads", test_threads);
  return g_test_run();
}
