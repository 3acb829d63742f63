// Calibration against loops made with parameters that it is not told: recovered from hostile files,
// their intervals as wide as they should be, what cannot be parted flagged, several curves at once.
#include "app/export/calibrate_results.h"
#include "app/study/calibrate.h"

#include "engine/numeric/sampling.h"
#include "tests/executed.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

static char *folder;
static const double sigma = 0.16; // of the force [N]

typedef struct {
  int rows;
  bool crossed;  // signs, offsets, compliance and an approach, as a machine has them
  uint64_t seed; // of the noise
  double wrong;  // deviation of a smooth force that no model here has [N]
} Bench;

// A smooth force along the loop, another one for each seed and way: three half waves of random
// amplitude and phase in a stroke of 6.6 mm.
static double wrong_force(const Bench *bench, double displacement, bool back) {
  enum { WAVES = 3 };
  double sum = 0;
  for (uint32_t k = 0; k < WAVES; k++) {
    const uint64_t draw = 2 * k + back;
    const double size = sb_normal_quantile(sb_random(bench->seed, draw, 11));
    const double phase = 2 * M_PI * sb_random(bench->seed, draw, 12);
    sum += size * cos((k + 1) * M_PI * displacement / 6.6e-3 + phase);
  }
  return bench->wrong * sum / sqrt(WAVES / 2.0);
}

static double normal(uint64_t seed, uint64_t sample) {
  return sb_normal_quantile(sb_random(seed, sample, 3));
}

static const char *scene_name = "quick-look.scene";

static SbModel *scene_model(const SbOverride *truth, size_t count) {
  g_autofree char *path =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "scenes", scene_name, NULL);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document = sb_document_load(path, issues);
  g_autoptr(SbModel) base = NULL;
  g_assert_true(sb_document_compile(document, &base, issues));
  SbModel *model = NULL;
  g_assert_cmpint(sb_model_derive(&model, base, truth, count, NULL), ==, SB_OK);
  return model;
}

// A machine's file of the loop with these values.
static char *write_bench(const char *name, const Bench *bench, const SbOverride *truth,
                         size_t count) {
  g_autoptr(SbModel) model = scene_model(truth, count);
  SbRun *run = executed_run(model);
  size_t frames, at = 0;
  const SbFrame *frame = sb_run_frames(run, &frames);
  GString *text = g_string_new(bench->crossed ? "Zeit;Weg;Kraft\ns;mm;N\n"
                                              : "time [s],travel [mm],force [N]\n");
  const int air = bench->crossed ? 60 : 0;
  for (int i = -air; i < bench->rows; i++) {
    const double time = frame[frames - 1].time * i / (bench->rows - 1);
    double place = 0.005 * i, force = 0;
    while (i >= 0 && at + 2 < frames && frame[at + 1].time <= time) {
      at++;
    }
    if (i >= 0) {
      const SbFrame *a = &frame[at], *b = &frame[at + 1];
      const double t = b->time > a->time ? (time - a->time) / (b->time - a->time) : 0;
      const bool platen = bench->crossed;
      place = 1e3 * (platen ? a->platen + t * (b->platen - a->platen)
                            : a->displacement + t * (b->displacement - a->displacement));
      force = a->force + t * (b->force - a->force);
      if (bench->wrong > 0 && a->velocity != 0) {
        force += wrong_force(bench, a->displacement, a->velocity < 0);
      }
    }
    force += sigma * normal(bench->seed, (uint64_t)(i + air));
    char cell[3][40];
    const double value[3] = {time, bench->crossed ? 41.7 - place : place,
                             bench->crossed ? 0.4 - force : force};
    for (int k = 0; k < 3; k++) {
      g_ascii_formatd(cell[k], sizeof cell[k], "%.5f", value[k]);
      if (bench->crossed) {
        *strchr(cell[k], '.') = ',';
      }
    }
    g_string_append_printf(text, bench->crossed ? "%s;%s;%s\r\n" : "%s,%s,%s\n", cell[0], cell[1],
                           cell[2]);
  }
  char *path = g_build_filename(folder, name, NULL);
  g_assert_true(g_file_set_contents(path, text->str, (gssize)text->len, NULL));
  g_string_free(text, TRUE);
  sb_run_destroy(run);
  return path;
}

static SbStudyFile *study_of(const char *groups) {
  g_autofree char *text = g_strdup_printf("[sealbench]\nformat = 1\nkind = study\n"
                                          "scene = %s/scenes/%s\n%s",
                                          g_getenv("SEALBENCH_ASSETS"), scene_name, groups);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbStudyFile *study =
      sb_study_file_parse(text, strlen(text), "x.study", folder, NULL, NULL, issues);
  for (guint i = 0; i < issues->len; i++) {
    g_autofree char *line = sb_issue_line(issues->pdata[i]);
    g_error("%s", line);
  }
  return study;
}

static void calibrate(SbCalibration *out, const SbStudyFile *study) {
  const SbCalibrateHooks hooks = {.jobs = 1};
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbReport report = {0};
  const SbStatus status = sb_calibrate(out, study, &hooks, issues, &report);
  for (guint i = 0; i < issues->len; i++) {
    g_autofree char *line = sb_issue_line(issues->pdata[i]);
    g_error("%s", line);
  }
  if (status != SB_OK) {
    g_test_message("%s", report.text);
  }
  g_assert_cmpint(status, ==, SB_OK);
  for (size_t j = 0; j < out->parameters; j++) {
    const SbCalibrated *one = &out->parameter[j];
    g_assert_true(one->interval[0] < one->estimate && one->estimate < one->interval[1]);
  }
}

#define FOUR                                                                                       \
  "friction.load_coefficient = uniform 0.1 .. 0.3\n"                                               \
  "stem.pressure_diameter = normal 5.75 mm, 0.05 mm\n"                                             \
  "bore.land_edge = uniform 2.5 mm .. 4 mm\n"                                                      \
  "friction.static_ratio = uniform 1 .. 1.4\n"

static const SbOverride truth[] = {{SB_P_FRICTION_LOAD_COEFFICIENT, 0.15},
                                   {SB_P_STEM_PRESSURE_DIAMETER, 5.81e-3},
                                   {SB_P_BORE_LAND_EDGE, 3.05e-3},
                                   {SB_P_FRICTION_STATIC_RATIO, 1.17}};

// Four parameters from a crossed file; the fitted scene has them, where they come from, and fits.
static void test_recovers(void) {
  const Bench bench = {.rows = 2000, .crossed = true, .seed = 2};
  g_autofree char *file = write_bench("crossed.csv", &bench, truth, G_N_ELEMENTS(truth));
  g_autoptr(SbStudyFile) study =
      study_of("[vary]\n" FOUR "[study]\nsamples = 3000\n[data]\nfile = crossed.csv\n");
  SbCalibration found;
  calibrate(&found, study);
  g_assert_cmpuint(found.parameters, ==, 4);
  for (size_t j = 0; j < 4; j++) {
    const SbCalibrated *one = &found.parameter[j];
    g_test_message("%s %.6g, is %.6g +- %.2g", one->name, truth[j].value, one->estimate,
                   one->deviation);
    g_assert_cmpint(one->id, ==, truth[j].id);
    g_assert_cmpfloat_with_epsilon(one->estimate, truth[j].value, 3 * one->deviation);
    g_assert_cmpint(one->identifiable, ==, SB_IDENTIFIABLE_YES);
  }
  g_assert_true(found.curve[0].measured->turned_force &&
                found.curve[0].measured->turned_displacement);
  g_assert_cmpfloat_with_epsilon(found.rms, sigma, 0.02);
  g_assert_cmpfloat_with_epsilon(found.chi2, 1, 0.2);
  g_assert_cmpfloat(found.curve[0].before_rms, >, 0.25);
  g_assert_cmpfloat_with_epsilon(found.curve[0].noise, sigma, 0.01);
  // The scene that is written.
  g_autofree char *path = g_build_filename(folder, "fitted.scene", NULL);
  g_autofree char *text = sb_calibration_scene(&found, study, 0, path, NULL);
  g_assert_nonnull(strstr(text, "# Calibrated with "));
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) scene = sb_document_load(path, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  for (size_t j = 0; j < 4; j++) {
    g_assert_cmpfloat(sb_document_value(scene, truth[j].id), ==, found.parameter[j].estimate);
  }
  // Its data are the same rows by what it says of them.
  g_autoptr(SbMeasured) again = sb_measured_read(sb_document_data(scene, 0), 0, NULL, 0, issues);
  g_assert_nonnull(again);
  g_assert_cmpmem(again->force, again->count * sizeof(double), found.curve[0].measured->force,
                  again->count * sizeof(double));
  // Equal seeds, equal samples.
  SbCalibration twice;
  calibrate(&twice, study);
  g_assert_cmpmem(twice.sample, twice.samples * 4 * sizeof(double), found.sample,
                  found.samples * 4 * sizeof(double));
  sb_calibration_release(&twice);
  sb_calibration_release(&found);
  g_unlink(path);
  g_unlink(file);
}

// Friction by load and by real area make the same loop: told, with the experiment that would part
// them; a parameter that no loop shows keeps its value.
static void test_inseparable(void) {
  const Bench bench = {.rows = 600, .seed = 5};
  g_autofree char *file = write_bench("one.csv", &bench, truth, G_N_ELEMENTS(truth));
  g_autoptr(SbStudyFile) study =
      study_of("[vary]\nfriction.load_coefficient = uniform 0.1 .. 0.3\n"
               "surface.gt_product = uniform 0.08 .. 0.16\nfluid.viscosity = uniform 0.1 mPa.s .. "
               "0.3 mPa.s\n"
               "[study]\nsamples = 3000\n[data]\nfile = one.csv\n"
               "set = stem.pressure_diameter = 5.81 mm; bore.land_edge = 3.05 mm\n");
  SbCalibration found;
  calibrate(&found, study);
  g_assert_cmpint(found.parameter[0].identifiable, ==, SB_IDENTIFIABLE_WITH_OTHER);
  g_assert_cmpint(found.parameter[1].identifiable, ==, SB_IDENTIFIABLE_WITH_OTHER);
  g_assert_cmpint(found.parameter[2].identifiable, ==, SB_IDENTIFIABLE_NO);
  g_assert_cmpfloat(found.correlation[1], <, -0.9);
  g_assert_nonnull(
      strstr(found.sentence, "friction.load_coefficient and surface.gt_product are correlated"));
  g_assert_nonnull(strstr(found.sentence, "a loop at another squeeze"));
  g_assert_nonnull(strstr(found.sentence, "fluid.viscosity is hardly narrower than its prior"));
  g_autofree char *path = g_build_filename(folder, "kept.scene", NULL);
  g_autofree char *text = sb_calibration_scene(&found, study, 0, path, NULL);
  g_assert_null(strstr(text, "\nviscosity = "));
  g_assert_nonnull(strstr(text, "\nload_coefficient = "));
  sb_calibration_release(&found);
  g_unlink(file);
}

// Two pressures: what is shared has one value, what is own has two.
static void test_curves(void) {
  const SbOverride low[] = {{SB_P_FRICTION_LOAD_COEFFICIENT, 0.23},
                            {SB_P_STEM_PRESSURE_DIAMETER, 5.81e-3},
                            {SB_P_BORE_LAND_EDGE, 3.05e-3},
                            {SB_P_CANISTER_PRESSURE, 0.4e6}};
  const SbOverride high[] = {{SB_P_FRICTION_LOAD_COEFFICIENT, 0.23},
                             {SB_P_STEM_PRESSURE_DIAMETER, 5.81e-3},
                             {SB_P_BORE_LAND_EDGE, 3.45e-3}};
  const Bench bench[] = {{.rows = 800, .seed = 6}, {.rows = 500, .seed = 7}};
  g_autofree char *one = write_bench("low.csv", &bench[0], low, G_N_ELEMENTS(low));
  g_autofree char *two = write_bench("high.csv", &bench[1], high, G_N_ELEMENTS(high));
  g_autoptr(SbStudyFile) study =
      study_of("[vary]\nfriction.load_coefficient = uniform 0.1 .. 0.3\n"
               "stem.pressure_diameter = normal 5.75 mm, 0.05 mm\n"
               "bore.land_edge = uniform 2.5 mm .. 4 mm\n"
               "[study]\nsamples = 2000\n"
               "[data low]\nfile = low.csv\nset = canister.pressure = 0.4 MPa\n"
               "own = bore.land_edge\n"
               "[data high]\nfile = high.csv\nown = bore.land_edge\n");
  SbCalibration found;
  calibrate(&found, study);
  g_assert_cmpuint(found.curves, ==, 2);
  g_assert_cmpuint(found.parameters, ==, 4);
  static const struct {
    const char *name;
    double value;
  } values[] = {{"friction.load_coefficient", 0.23},
                {"stem.pressure_diameter", 5.81e-3},
                {"bore.land_edge@low", 3.05e-3},
                {"bore.land_edge@high", 3.45e-3}};
  for (size_t j = 0; j < 4; j++) {
    bool seen = false;
    for (size_t k = 0; k < 4; k++) {
      const SbCalibrated *is = &found.parameter[k];
      if (strcmp(is->name, values[j].name) == 0) {
        seen = true;
        g_assert_cmpfloat_with_epsilon(is->estimate, values[j].value, 3 * is->deviation);
      }
    }
    g_assert_true(seen);
  }
  sb_calibration_release(&found);
  g_unlink(one);
  g_unlink(two);
}

// A stem that jams halfway back: the rows in which it rests there, while the force falls, are not
// of a sliding stem.
static void test_jammed(void) {
  const SbOverride jammed[] = {{SB_P_FRICTION_LOAD_COEFFICIENT, 0.216},
                               {SB_P_STEM_PRESSURE_DIAMETER, 5.832e-3},
                               {SB_P_BORE_LAND_EDGE, 2.895e-3}};
  const Bench bench = {.rows = 150, .seed = 1019};
  g_autofree char *file = write_bench("jammed.csv", &bench, jammed, G_N_ELEMENTS(jammed));
  g_autoptr(SbStudyFile) study =
      study_of("[vary]\nfriction.load_coefficient = uniform 0.15 .. 0.22\n"
               "stem.pressure_diameter = normal 5.8 mm, 0.03 mm\n"
               "bore.land_edge = uniform 2.8 mm .. 3.6 mm\n"
               "[study]\nsamples = 200\n"
               "[data]\nfile = jammed.csv\nzero = as-is\ncompliance = none\n");
  SbCalibration found;
  calibrate(&found, study);
  g_assert_cmpfloat(found.curve[0].measured->displacement[149], >, 2.5e-3); // it does jam
  g_assert_cmpfloat(found.chi2, <, 1.5);
  for (size_t j = 0; j < 3; j++) {
    const SbCalibrated *one = &found.parameter[j];
    g_assert_cmpfloat_with_epsilon(one->estimate, jammed[j].value, 3 * one->deviation);
  }
  sb_calibration_release(&found);
  g_unlink(file);
}

// A valve that runs in, eight strokes of it in one file from its third on: how much and how soon,
// from three of them. The same strokes taken for those of a valve long run in are not.
static void test_running_in(void) {
  static const SbOverride wear[] = {{SB_P_LIFE_ROUGHNESS_NEW, 1.3},
                                    {SB_P_LIFE_ROUGHNESS_RUN_IN, 0.72},
                                    {SB_P_LIFE_RUNNING_IN, 3.4}};
  GString *text = g_string_new(NULL);
  for (int n = 0; n < 8; n++) {
    const Bench bench = {.rows = 300, .seed = 20 + (uint64_t)n};
    // At 0.7 MPa the stem returns with the new surface's friction too.
    const SbOverride all[] = {wear[0],
                              wear[1],
                              wear[2],
                              {SB_P_LIFE_FIRST_ACTUATION, 3 + n},
                              {SB_P_CANISTER_PRESSURE, 0.7e6}};
    g_autofree char *one = write_bench("one.csv", &bench, all, G_N_ELEMENTS(all));
    g_autofree char *rows = NULL;
    g_assert_true(g_file_get_contents(one, &rows, NULL, NULL));
    g_string_append(text, n == 0 ? rows : strchr(rows, '\n') + 1);
    g_unlink(one);
  }
  g_autofree char *file = g_build_filename(folder, "strokes.csv", NULL);
  g_assert_true(g_file_set_contents(file, text->str, (gssize)text->len, NULL));
  g_string_free(text, TRUE);
  for (int wrong = 0; wrong < 2; wrong++) {
    g_autofree char *groups =
        g_strdup_printf("[vary]\nlife.roughness_new = uniform 0.8 .. 1.8\n"
                        "life.roughness_run_in = uniform 0.4 .. 1\n"
                        "life.running_in = loguniform 0.5 .. 50\n"
                        "[study]\nsamples = %d\n[data strokes]\nfile = strokes.csv\n"
                        "set = canister.pressure = 0.7 MPa\n"
                        "actuation = %d\ncycle = 1, 3, 8\nzero = as-is\ncompliance = none\n",
                        wrong ? 20 : 250, wrong ? 2000 : 3);
    g_autoptr(SbStudyFile) study = study_of(groups);
    SbCalibration found;
    calibrate(&found, study);
    g_assert_cmpuint(found.curves, ==, 3);
    g_assert_cmpstr(found.curve[2].name, ==, "strokes 8");
    for (size_t j = 0; j < 3; j++) {
      const SbCalibrated *one = &found.parameter[j];
      g_test_message("%s %.6g, is %.6g +- %.2g", one->name, wear[j].value, one->estimate,
                     one->deviation);
      if (!wrong) {
        g_assert_cmpfloat_with_epsilon(one->estimate, wear[j].value, 3 * one->deviation);
      }
    }
    g_test_message("%s, chi2 %.3g", found.sentence, found.chi2);
    if (wrong) {
      g_assert_cmpfloat(found.chi2, >, 1.5);
    } else {
      g_assert_cmpfloat_with_epsilon(found.chi2, 1, 0.2);
      g_autofree char *scene = sb_calibration_scene(&found, study, 2, "x.scene", NULL);
      g_assert_nonnull(strstr(scene, "first_actuation = 10\n"));
    }
    sb_calibration_release(&found);
  }
  g_unlink(file);
}

// Truths from the priors: intervals of 95 % cover so many, ranks are even. The whole of it is slow.
static void test_coverage(void) {
  enum { BINS = 5, PARAMETERS = 3 };
  const int repeats = g_test_slow() ? 100 : 25;
  static const SbParamId id[PARAMETERS] = {SB_P_FRICTION_LOAD_COEFFICIENT,
                                           SB_P_STEM_PRESSURE_DIAMETER, SB_P_BORE_LAND_EDGE};
  const SbDistribution prior[PARAMETERS] = {
      {.kind = SB_DISTRIBUTION_UNIFORM, .a = 0.15, .b = 0.22},
      {.kind = SB_DISTRIBUTION_NORMAL, .a = 5.8e-3, .b = 3e-5, .low = -INFINITY, .high = INFINITY},
      {.kind = SB_DISTRIBUTION_UNIFORM, .a = 2.8e-3, .b = 3.6e-3}};
  double ranks[PARAMETERS][BINS] = {{0}}, covered = 0;
  for (int r = 0; r < repeats; r++) {
    SbOverride drawn[PARAMETERS];
    for (uint32_t j = 0; j < PARAMETERS; j++) {
      drawn[j] =
          (SbOverride){id[j], sb_distribution_quantile(&prior[j], sb_random(99, (uint64_t)r, j))};
    }
    const Bench bench = {.rows = 150, .seed = 1000 + (uint64_t)r};
    g_autofree char *file = write_bench("repeat.csv", &bench, drawn, PARAMETERS);
    g_autofree char *groups =
        g_strdup_printf("[vary]\nfriction.load_coefficient = uniform 0.15 .. 0.22\n"
                        "stem.pressure_diameter = normal 5.8 mm, 0.03 mm\n"
                        "bore.land_edge = uniform 2.8 mm .. 3.6 mm\n"
                        "[study]\nsamples = 500\nseed = %d\n"
                        "[data]\nfile = repeat.csv\nzero = as-is\ncompliance = none\n",
                        r + 1);
    g_autoptr(SbStudyFile) study = study_of(groups);
    SbCalibration found;
    calibrate(&found, study);
    for (size_t j = 0; j < PARAMETERS; j++) {
      size_t below = 0;
      for (size_t i = 0; i < found.samples; i++) {
        below += found.sample[i * PARAMETERS + j] < drawn[j].value;
      }
      const SbCalibrated *one = &found.parameter[j];
      covered += drawn[j].value > one->interval[0] && drawn[j].value < one->interval[1];
      ranks[j][below * BINS / (found.samples + 1)]++;
    }
    sb_calibration_release(&found);
    g_unlink(file);
  }
  const double share = covered / (repeats * PARAMETERS);
  g_test_message("covered %.3f", share);
  for (size_t j = 0; j < PARAMETERS; j++) {
    double chi = 0;
    for (int b = 0; b < BINS; b++) {
      chi += pow(ranks[j][b] - (double)repeats / BINS, 2) / ((double)repeats / BINS);
    }
    g_test_message("%s: %.0f %.0f %.0f %.0f %.0f ranks, chi2 %.1f", sb_param(id[j])->key,
                   ranks[j][0], ranks[j][1], ranks[j][2], ranks[j][3], ranks[j][4], chi);
    g_assert_cmpfloat(chi, <, 13.3); // 99 % of four degrees of freedom
  }
  // Of 75 intervals as many as four deviations of a binomial allow.
  g_assert_cmpfloat(share, >, g_test_slow() ? 0.90 : 0.85);
  g_assert_cmpfloat(share, <, g_test_slow() ? 0.99 : 1.01);
}

// A model that is wrong on purpose: a smooth force of five times the noise along the loop that no
// parameter makes. Intervals of 95 % contain the truth in at least 85 % of the loops, each
// parameter by itself.
static void test_wrong_model(void) {
  enum { LOOPS = 50, PARAMETERS = 2 };
  static const SbParamId id[PARAMETERS] = {SB_P_FRICTION_LOAD_COEFFICIENT,
                                           SB_P_STEM_PRESSURE_DIAMETER};
  const SbDistribution prior[PARAMETERS] = {
      {.kind = SB_DISTRIBUTION_UNIFORM, .a = 0.1, .b = 0.3},
      {.kind = SB_DISTRIBUTION_NORMAL, .a = 5.8e-3, .b = 3e-4, .low = -INFINITY, .high = INFINITY}};
  size_t covered[PARAMETERS] = {0};
  double width[PARAMETERS] = {0};
  for (int r = 0; r < LOOPS; r++) {
    SbOverride drawn[PARAMETERS];
    for (uint32_t j = 0; j < PARAMETERS; j++) {
      // The middle of the priors, whose ends are where the stem does not return.
      const double share = 0.25 + 0.5 * sb_random(77, (uint64_t)r, j);
      drawn[j] = (SbOverride){id[j], sb_distribution_quantile(&prior[j], share)};
    }
    const Bench bench = {.rows = 240, .seed = 3000 + (uint64_t)r, .wrong = 5 * sigma};
    g_autofree char *file = write_bench("wrong.csv", &bench, drawn, PARAMETERS);
    g_autofree char *groups =
        g_strdup_printf("[vary]\nfriction.load_coefficient = uniform 0.1 .. 0.3\n"
                        "stem.pressure_diameter = normal 5.8 mm, 0.3 mm\n"
                        "[study]\nsamples = 300\nseed = %d\n"
                        "[data]\nfile = wrong.csv\nzero = as-is\ncompliance = none\n",
                        r + 1);
    g_autoptr(SbStudyFile) study = study_of(groups);
    SbCalibration found;
    calibrate(&found, study);
    g_assert_cmpfloat(found.chi2, >, 1.5); // it is reported
    for (size_t j = 0; j < PARAMETERS; j++) {
      const SbCalibrated *one = &found.parameter[j];
      covered[j] += drawn[j].value > one->interval[0] && drawn[j].value < one->interval[1];
      width[j] += (one->interval[1] - one->interval[0]) / (one->prior[1] - one->prior[0]) / LOOPS;
    }
    sb_calibration_release(&found);
    g_unlink(file);
  }
  for (size_t j = 0; j < PARAMETERS; j++) {
    g_test_message("%s: covered %zu of %d, intervals %.2f of the prior's", sb_param(id[j])->key,
                   covered[j], LOOPS, width[j]);
    g_assert_cmpuint(covered[j], >=, LOOPS * 85 / 100);
    g_assert_cmpfloat(width[j], <, 0.6); // the data still say much
  }
}

// Solved rings: the fit goes along their tangents, the posterior is that of the fit's, and solved
// loops at its samples are those of the tangent within the noise.
static void test_rings(void) {
  const SbOverride rings[] = {{SB_P_FRICTION_LOAD_COEFFICIENT, 0.22},
                              {SB_P_BORE_LAND_EDGE, 3.1e-3}};
  scene_name = "ring-cycle.scene";
  const Bench bench = {.rows = 600, .seed = 5};
  g_autofree char *file = write_bench("rings.csv", &bench, rings, G_N_ELEMENTS(rings));
  g_autoptr(SbStudyFile) study =
      study_of("[vary]\nfriction.load_coefficient = uniform 0.1 .. 0.3\n"
               "bore.land_edge = uniform 2.5 mm .. 4 mm\n"
               "[data]\nfile = rings.csv\nzero = as-is\ncompliance = none\n");
  SbCalibration found;
  calibrate(&found, study);
  g_assert_true(found.tangent);
  for (size_t j = 0; j < 2; j++) {
    const SbCalibrated *one = &found.parameter[j];
    g_test_message("%s %.6g, is %.6g +- %.2g", one->name, rings[j].value, one->estimate,
                   one->deviation);
    g_assert_cmpfloat_with_epsilon(one->estimate, rings[j].value, 3 * one->deviation);
  }
  g_test_message("tangent %.3g N, %zu runs", found.check_rms, found.evaluations);
  g_assert_cmpfloat(found.check_rms, <, sigma / 4);
  g_assert_cmpfloat_with_epsilon(found.rms, sigma, 0.02);
  sb_calibration_release(&found);
  g_unlink(file);
  scene_name = "quick-look.scene";
}

// What the data or [vary] lack is one complaint that says it.
static void test_refused(void) {
  const Bench bench = {.rows = 300, .seed = 5};
  g_autofree char *file = write_bench("one.csv", &bench, truth, G_N_ELEMENTS(truth));
  static const struct {
    const char *groups, *said;
  } cases[] = {
      {"[vary]\nmodels.film = levels thesis\n[data]\nfile = one.csv\n", "has no prior"},
      {"[vary]\nbore.land_edge = uniform 2 mm .. 4 mm\n[data]\nfile = none.csv\n", "No such file"},
      {"[vary]\nbore.land_edge = uniform 2 mm .. 4 mm\n[data]\nfile = one.csv\nset = x = 3\n",
       "\"x = 3\" sets no parameter"},
      {"[vary]\nbore.land_edge = uniform 2 mm .. 4 mm\n[data]\nfile = one.csv\n"
       "columns = displacement, force\n",
       "column 1 \"time\" (displacement) has the unit \"s\""},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autoptr(SbStudyFile) study = study_of(cases[i].groups);
    const SbCalibrateHooks hooks = {.jobs = 1};
    g_autoptr(GPtrArray) issues = sb_issues_new();
    SbCalibration found;
    g_assert_cmpint(sb_calibrate(&found, study, &hooks, issues, NULL), ==, SB_ERROR_INPUT);
    g_assert_cmpuint(issues->len, ==, 1);
    g_autofree char *line = sb_issue_line(issues->pdata[0]);
    if (strstr(line, cases[i].said) == NULL) {
      g_error("%s instead of %s", line, cases[i].said);
    }
    sb_calibration_release(&found);
    g_autoptr(GPtrArray) checked = sb_issues_new();
    sb_calibrate_check(study, checked);
    g_assert_cmpuint(checked->len, ==, 1);
    g_autofree char *same = sb_issue_line(checked->pdata[0]);
    g_assert_cmpstr(same, ==, line);
  }
  g_unlink(file);
}

static bool at_once(void *data) {
  return ++*(int *)data > 400; // past the fit's first step
}

// The number in the file of a fitted parameter.
static void assert_written(const char *text, SbDocumentKind kind, const SbCalibrated *one) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document = sb_document_parse(text, strlen(text), "x", folder, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  g_assert_cmpint(sb_document_kind(document), ==, kind);
  g_assert_true(sb_document_gives(document, one->id));
  g_assert_cmpfloat(sb_document_value(document, one->id), ==, one->estimate);
  g_assert_null(strstr(text, "nan"));
  g_assert_nonnull(strstr(text, "# The calibration was interrupted: these are its best values."));
}

// A cancel ends it, with the best place so far: estimates and residuals, no posterior. The files
// that are written hold these estimates.
static void test_cancel(void) {
  const Bench bench = {.rows = 300, .seed = 5};
  g_autofree char *file = write_bench("one.csv", &bench, truth, G_N_ELEMENTS(truth));
  g_autoptr(SbStudyFile) study =
      study_of("[vary]\nbore.land_edge = uniform 2 mm .. 4 mm\n[data]\nfile = one.csv\n");
  int polled = 0;
  const SbCalibrateHooks hooks = {.jobs = 1, .cancelled = at_once, .data = &polled};
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbCalibration found;
  g_assert_cmpint(sb_calibrate(&found, study, &hooks, issues, NULL), ==, SB_ERROR_CANCELLED);
  g_assert_cmpint(polled, <, 420);
  g_assert_true(found.partial && !found.converged);
  g_assert_cmpuint(found.samples, ==, 0);
  g_assert_cmpfloat(found.parameter[0].estimate, >=, 2e-3);
  g_assert_cmpfloat(found.parameter[0].estimate, <=, 4e-3);
  g_assert_true(isnan(found.parameter[0].interval[0]));
  g_assert_true(isfinite(found.rms));
  g_assert_cmpfloat(found.parameter[0].estimate, !=, found.parameter[0].before);
  // Every null of its JSON has a reason.
  g_autofree char *json = sb_calibration_json(&found, study);
  static const char *const paths[] = {
      "parameters.bore.land_edge.standard_deviation", "parameters.bore.land_edge.interval_95",
      "parameters.bore.land_edge.identifiable", "correlation.matrix", "posterior.tangent_rms_N"};
  for (size_t i = 0; i < G_N_ELEMENTS(paths); i++) {
    g_autofree char *reason = g_strdup_printf("\"%s\": \"interrupted: ", paths[i]);
    g_assert_nonnull(strstr(json, reason));
  }
  g_autofree char *path = g_build_filename(folder, "partial.scene", NULL);
  g_autofree char *scene = sb_calibration_scene(&found, study, 0, path, NULL);
  assert_written(scene, SB_DOCUMENT_SCENE, &found.parameter[0]);
  g_autofree char *valve = sb_calibration_valve(&found, study, 0, path, NULL);
  assert_written(valve, SB_DOCUMENT_VALVE, &found.parameter[0]);
  sb_calibration_release(&found);
  g_unlink(file);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  folder = g_dir_make_tmp("sealbench-XXXXXX", NULL);
  g_test_add_func("/calibrate/recovers", test_recovers);
  g_test_add_func("/calibrate/inseparable", test_inseparable);
  g_test_add_func("/calibrate/curves", test_curves);
  g_test_add_func("/calibrate/running-in", test_running_in);
  g_test_add_func("/calibrate/refused", test_refused);
  g_test_add_func("/calibrate/cancel", test_cancel);
  g_test_add_func("/calibrate/jammed", test_jammed);
  g_test_add_func("/calibrate/coverage", test_coverage);
  g_test_add_func("/calibrate/wrong-model", test_wrong_model);
  if (g_test_slow()) {
    g_test_add_func("/calibrate/slow/coverage", test_coverage);
    g_test_add_func("/calibrate/slow/rings", test_rings);
  }
  const int result = g_test_run();
  g_rmdir(folder);
  g_free(folder);
  return result;
}
