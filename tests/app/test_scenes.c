// Every shipped scene: sound, closes its energy and keeps to its plan. In slow mode also: its
// figures do not depend on the number of frames, and a motion with inertia converges with its
// tolerance.
#include "app/base/device.h"
#include "app/cli/run_text.h"
#include "app/document/document.h"

#include "engine/valve/sealbench.h"

#include "tests/executed.h"
#include "tests/sanitized.h"

#include <math.h>

#include <stdio.h>
#include <string.h>
#include <unistd.h>

typedef void SceneTest(const char *path);

static SbRun *run_scene(const char *path, int frames_factor, unsigned views) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document = sb_document_load(path, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  g_assert_nonnull(document);
  g_autoptr(SbModel) scene = NULL, model = NULL;
  g_assert_true(sb_document_compile(document, &scene, issues));
  SbOverride change[3] = {
      {SB_P_OUTPUT_FRAMES, frames_factor * sb_model_number(scene, SB_P_OUTPUT_FRAMES)}};
  size_t changes = 1;
  if (views != 0) {
    change[changes++] = (SbOverride){SB_P_OUTPUT_VIEWS, views};
  }
  // What frames do and what a sanitizer finds hang on no mesh: solved rings are halved in time.
  if (views != 0 || SB_SANITIZED) {
    change[changes++] = (SbOverride){SB_P_OUTPUT_TOLERANCE, 1e-2};
  }
  g_assert_cmpint(sb_model_derive(&model, scene, change, changes, NULL), ==, SB_OK);
  return executed_run(model);
}

// A scene with inertia at another tolerance of its steps; NULL for others.
static SbRun *run_tolerance(const char *path, double tolerance) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document = sb_document_load(path, issues);
  g_autoptr(SbModel) scene = NULL, model = NULL;
  g_assert_true(sb_document_compile(document, &scene, issues));
  int motion = sb_model_number(scene, SB_P_MODELS_MOTION);
  if (motion != SB_MODEL_MOTION_DYNAMIC && motion != SB_MODEL_MOTION_BODIES) {
    return NULL;
  }
  const SbOverride change = {SB_P_OUTPUT_MOTION_TOLERANCE, tolerance};
  g_assert_cmpint(sb_model_derive(&model, scene, &change, 1, NULL), ==, SB_OK);
  return executed_run(model);
}

// At least one actuation: the stem leaves its rest and the machine or hand turns it; or one pull.
static void actuates(const SbRun *run) {
  const SbSummary *summary = sb_run_summary(run);
  g_assert_true(summary->stage[SB_STAGE_B].reached);
  // The rig has no stop: its one actuation is the pull.
  if (!sb_device(sb_run_model(run))->stem) {
    g_assert_true(summary->rig.found);
    g_assert_cmpuint(summary->rig.of.peaks, >, 10);
  } else {
    g_assert_true(summary->stage[SB_STAGE_D].reached);
  }
  g_assert_cmpfloat(summary->energy.closure, <=, 1e-6);
}

// What the plan lists is what the counters show.
static void keeps_plan(const SbRun *run) {
  const SbPlan *plan = sb_run_plan(run);
  const SbCounters *counters = &sb_run_summary(run)->counters;
  g_assert_cmpint(plan->profiles, ==, counters->profile_evaluations > 0);
  g_assert_cmpint(plan->reynolds, ==, counters->reynolds_solves > 0);
  g_assert_cmpint(plan->film_history, ==, counters->film_steps > 0);
  g_assert_cmpint(plan->ring, ==, counters->ring_solves > 0);
  g_assert_cmpint(plan->section_fields, ==, counters->field_evaluations > 0);
  // How often, within a factor of two: what its predicted time is reckoned with.
  static const struct {
    const char *name;
    size_t place;
  } counts[] = {{"fits", offsetof(SbCounters, fit_solves)},
                {"discs", offsetof(SbCounters, disc_solves)},
                {"rings", offsetof(SbCounters, ring_solves)},
                {"films", offsetof(SbCounters, reynolds_solves)},
                {"nodes", offsetof(SbCounters, speed_nodes)},
                {"steps of films", offsetof(SbCounters, film_steps)},
                {"fields", offsetof(SbCounters, field_evaluations)},
                {"profiles", offsetof(SbCounters, profile_evaluations)}};
  for (size_t i = 0; i < G_N_ELEMENTS(counts) && sb_device(sb_run_model(run))->stem; i++) {
    const size_t told = *(const size_t *)((const char *)&plan->expected + counts[i].place);
    const size_t done = *(const size_t *)((const char *)counters + counts[i].place);
    if (told > 2 * done || done > 2 * told) {
      g_test_message("%s: %zu expected, %zu counted", counts[i].name, told, done);
      g_test_fail();
    }
  }
}

// What `run` prints of it, from a file that replaces standard output. Owned by the caller (g_free).
static char *summary_text(const SbCliRunText *of) {
  fflush(stdout);
  const int kept = dup(STDOUT_FILENO);
  FILE *file = tmpfile();
  g_assert_nonnull(file);
  g_assert_cmpint(dup2(fileno(file), STDOUT_FILENO), >=, 0);
  sb_cli_run_summary(of);
  fflush(stdout);
  g_assert_cmpint(dup2(kept, STDOUT_FILENO), >=, 0);
  close(kept);
  const off_t size = lseek(fileno(file), 0, SEEK_END);
  g_autofree char *text = g_malloc0((gsize)size + 1);
  g_assert_cmpint(pread(fileno(file), text, (gsize)size, 0), ==, size);
  fclose(file);
  return g_steal_pointer(&text);
}

// The summary of `run` fits a small terminal and ends with the loop.
static void prints(const SbRun *run, const char *path) {
  SbCaseVerdict verdict[SB_VERDICT_COUNT];
  for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
    verdict[kind] = (SbCaseVerdict){sb_run_summary(run)->verdict[kind], NULL};
  }
  const SbCliPlots plots = {0};
  const SbCliRunText of = {.title = path,
                           .run = run,
                           .converged = sb_run_summary(run)->converged,
                           .verdict = verdict,
                           .plots = &plots};
  g_autofree char *text = summary_text(&of);
  g_auto(GStrv) lines = g_strsplit(text, "\n", -1);
  g_assert_cmpuint(g_strv_length(lines) - 1, <=, SB_CLI_SUMMARY_LINES);
  for (char **line = lines; *line != NULL; line++) {
    g_assert_cmpint(g_utf8_strlen(*line, -1), <=, 80);
  }
  g_assert_null(strstr(text, "…")); // no reason of a shipped scene is cut
  g_assert_nonnull(strstr(text, "\n  Peak pressure, outer seal  "));
  g_assert_nonnull(strstr(text, "Force / N over "));
}

static void runs(const char *path) {
  SbRun *run = run_scene(path, 1, 0);
  actuates(run);
  keeps_plan(run);
  g_autofree char *name = g_path_get_basename(path);
  prints(run, name);
  sb_run_destroy(run);
}

// The loop alone computes no profile and no field. With twice the frames, peak force, return force
// and energy are the same.
static void keeps_frames(const char *path) {
  SbRun *a = run_scene(path, 1, SB_VIEW_HYSTERESIS);
  keeps_plan(a);
  const SbSummary *x = sb_run_summary(a);
  g_assert_cmpuint(x->counters.field_evaluations, ==, 0);
  g_assert_cmpuint(x->counters.profile_evaluations, ==, 0);
  SbRun *b = run_scene(path, 2, SB_VIEW_HYSTERESIS);
  const SbSummary *y = sb_run_summary(b);
  g_assert_cmpfloat(fabs(x->force_peak / y->force_peak - 1), <, 1e-3);
  g_assert_cmpfloat(fabs(x->force_breakaway / y->force_breakaway - 1), <, 1e-3);
  g_assert_cmpfloat(fabs(x->energy.loop / y->energy.loop - 1), <, 1e-3);
  if (!sb_device(sb_run_model(a))->stem) {
    g_assert_true(isnan(x->force_return_min));
  } else {
    g_assert_cmpfloat(fabs(x->force_return_min - y->force_return_min), <, 1e-3 * 14.5);
  }
  sb_run_destroy(b);
  sb_run_destroy(a);
}

// A motion with inertia: tolerances a decade apart against a hundredth of the finest. Radau IIA has
// order 5 in its step, which makes 5/6 a decade; closed forms do not change at all. The estimate
// covers the error; one that is a small part of the tolerance has no order.
static void converges(const char *path) {
  double error[2] = {0};
  SbRun *fine = run_tolerance(path, 1e-10);
  if (fine == NULL) {
    return;
  }
  const SbSummary *a = sb_run_summary(fine);
  for (int i = 0; i < 2; i++) {
    SbRun *run = run_tolerance(path, i == 0 ? 1e-6 : 1e-8);
    const SbSummary *b = sb_run_summary(run);
    double force = fabs(b->force_peak / a->force_peak - 1);
    double loop = fabs(b->energy.loop / a->energy.loop - 1);
    g_test_message("%s: force %.1e (estimate %.1e), loop %.1e (estimate %.1e)", path, force,
                   b->error_force, loop, b->error_energy);
    g_assert_cmpfloat(force, <=, 3 * b->error_force);
    g_assert_cmpfloat(loop, <=, 3 * b->error_energy);
    g_assert_cmpfloat(fabs(b->force_return_min - a->force_return_min), <=,
                      3 * b->error_force * a->force_peak);
    error[i] = fmax(force, loop);
    sb_run_destroy(run);
  }
  g_assert_cmpfloat(error[1], <=, fmax(0.1 * error[0], 0.03 * 1e-8));
  sb_run_destroy(fine);
}

static void each_scene(gconstpointer data) {
  SceneTest *test = *(SceneTest *const *)data;
  g_autofree char *folder = g_build_filename(g_getenv("SEALBENCH_ASSETS"), "scenes", NULL);
  g_autoptr(GDir) dir = g_dir_open(folder, 0, NULL);
  g_assert_nonnull(dir);
  int count = 0;
  for (const char *name = g_dir_read_name(dir); name != NULL; name = g_dir_read_name(dir)) {
    if (g_str_has_suffix(name, ".scene")) {
      g_test_message("%s", name);
      g_autofree char *path = g_build_filename(folder, name, NULL);
      test(path);
      count++;
    }
  }
  g_assert_cmpint(count, >=, 2);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  static SceneTest *const tests[] = {runs, keeps_frames, converges};
  g_test_add_data_func("/scenes/run", &tests[0], each_scene);
  if (g_test_slow()) {
    g_test_add_data_func("/scenes/frames", &tests[1], each_scene);
    g_test_add_data_func("/scenes/converge", &tests[2], each_scene);
  }
  return g_test_run();
}
