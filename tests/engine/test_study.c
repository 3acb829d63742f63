// Studies: their numbers against closed forms and reference figures, their bounds, progress and
// cancel.
#include "engine/study/study.h"

#include <glib.h>
#include <math.h>
#include <string.h>

static SbModel thesis_model(double tolerance) {
  SbParams params;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_TOLERANCE, tolerance, NULL), ==, SB_OK);
  SbModel model;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL), ==, SB_OK);
  return model;
}

static SbStudy *make(SbStudyKind kind, const SbModel *model) {
  SbStudy *study = g_new(SbStudy, 1);
  SbReport report = {0};
  SbStatus status = sb_study_make(study, kind, model, NULL, &report);
  g_assert_cmpstr(report.text, ==, "");
  g_assert_cmpint(status, ==, SB_OK);
  return study;
}

static const SbStudySeries *series(const SbStudy *study, const char *quantity, const char *name) {
  for (size_t p = 0; p < study->panel_count; p++) {
    for (size_t s = 0; s < study->panel[p].series_count; s++) {
      if (strcmp(study->panel[p].y.quantity, quantity) == 0 &&
          strcmp(study->panel[p].series[s].name, name) == 0) {
        return &study->panel[p].series[s];
      }
    }
  }
  g_error("no series %s, %s", quantity, name);
}

static double cell(const SbStudy *study, const char *row, const char *column) {
  for (size_t r = 0; r < study->row_count; r++) {
    for (size_t k = 0; k < study->column_count; k++) {
      if (strcmp(study->row[r].name, row) == 0 && strcmp(study->column[k].name, column) == 0) {
        return study->row[r].value[k];
      }
    }
  }
  g_error("no cell %s, %s", row, column);
}

#define NEAR(value, expected, relative)                                                            \
  g_assert_cmpfloat(fabs((value) / (expected)-1), <=, relative)

// Every study of the table: named, listed once, inside its bounds with room to spare.
static void test_table(void) {
  const SbParam *flags = sb_param(SB_P_OUTPUT_STUDIES);
  g_assert_cmpint(sb_param_choice_count(flags), ==, SB_STUDY_COUNT);
  for (int i = 0; i < SB_STUDY_COUNT; i++) {
    SbStudyKind kind = SB_STUDY_COUNT;
    const char *name = sb_study_name((SbStudyKind)i);
    g_assert_true(sb_study_from_name(&kind, name));
    g_assert_cmpint((int)kind, ==, i);
    // The bit of the parameter is the study's.
    g_assert_cmpint(sb_param_choice(flags, name, strlen(name)), ==, i);
    g_assert_nonnull(sb_study_title(kind));
    g_assert_nonnull(sb_study_help(kind));
  }
  SbStudyKind none;
  g_assert_false(sb_study_from_name(&none, "hysteresis"));
  g_assert_null(sb_study_name(SB_STUDY_COUNT));
}

// Lindley's closed form, thesis equation 2.8.
static double lindley_load(double s) {
  return M_PI * 1.61e-3 * 4.45e-3 * 2.5e6 * (1.25 * pow(s, 1.5) + 50 * pow(s, 6));
}

static void test_squeeze(void) {
  SbModel model = thesis_model(1e-2);
  SbStudy *study = make(SB_STUDY_SQUEEZE, &model);
  g_assert_true(study->complete);
  // Lindley over the whole range.
  const SbStudySeries *lindley = series(study, "load", "Lindley");
  g_assert_cmpuint(lindley->count, >, 50);
  NEAR(lindley->x[0], 0.02, 1e-12);
  NEAR(lindley->x[lindley->count - 1], 0.40, 1e-12);
  for (size_t i = 0; i < lindley->count; i++) {
    NEAR(lindley->y[i], lindley_load(lindley->x[i]), 1e-9);
  }
  // The ring as designed: reference figures of the axisymmetric ring, 0.5 % in load, 1 % in peak,
  // and the tolerance of 1 % that this test asks for.
  double load = cell(study, "ring", "load");
  NEAR(load, 4.772, 0.015);
  NEAR(cell(study, "ring", "peak"), 0.585e6, 0.02);
  NEAR(cell(study, "ring", "width"), 0.552e-3, 0.02);
  g_assert_cmpfloat(cell(study, "ring", "load against ring"), ==, 0);
  NEAR(1 + cell(study, "Lindley", "load against ring"), lindley_load(0.25 / 1.61) / load, 1e-9);
  // A ring that is stretched by 15.5 % is 1.500 mm thick: no contact below 1 - 1.500/1.61 = 6.8 %.
  const SbStudySeries *ring = series(study, "load", "ring");
  const SbStudySeries *loose = series(study, "load", "ring, not stretched");
  for (size_t i = 0; i < ring->count; i++) {
    g_assert_true(isfinite(ring->y[i]));
    g_assert_true(ring->x[i] < 0.065 ? ring->y[i] == 0 : ring->x[i] < 0.07 || ring->y[i] > 0);
    g_assert_cmpfloat(loose->y[i], >, ring->y[i]);
    g_assert_true(i == 0 || ring->y[i] >= ring->y[i - 1]);
  }
  g_free(study);
}

// Table 7.8's predicted 0.4 with the disc's own width and load; the thesis' nine loads printed.
static void test_models(void) {
  SbModel model = thesis_model(1e-2);
  SbStudy *study = make(SB_STUDY_MODELS, &model);
  g_assert_true(study->complete);
  const char *area = "friction by shear strength";
  g_assert_cmpfloat_with_epsilon(cell(study, area, "load thesis"), 0.388, 0.001);
  g_assert_cmpfloat_with_epsilon(cell(study, area, "load disc-thesis"), 0.39, 0.02);
  g_assert_cmpfloat_with_epsilon(cell(study, "friction with m", "load disc-thesis") -
                                     cell(study, area, "load disc-thesis"),
                                 0.19, 1e-12);
  NEAR(cell(study, "0.55 MPa", "load thesis"), 12.395, 1e-9);
  NEAR(cell(study, "0.55 MPa", "load disc-thesis"), 12.395, 0.025);
  // Audit: finite strain is 8 to 9 % above the thesis' loads under pressure.
  double above = cell(study, "0.55 MPa", "load ring") / 12.395 - 1;
  g_assert_cmpfloat_with_epsilon(above, 0.085, 0.015);
  // The thesis' sensitivity to d, from its table 7.3.
  NEAR(cell(study, "for d + 0.02 mm", "load thesis"), (13.181 - 11.611) / 2, 1e-9);
  g_free(study);

  // Another ring has no printed values.
  model.seal[SB_OUTER].modulus *= 1.1;
  study = make(SB_STUDY_MODELS, &model);
  g_assert_true(isnan(cell(study, "0.55 MPa", "load thesis")));
  g_assert_cmpuint(study->note_count, ==, 2);
  g_free(study);
}

typedef struct {
  double last;
  int calls, stop_after;
  bool rises;
} Watch;

static void on_progress(void *data, double fraction) {
  Watch *watch = data;
  watch->rises = watch->rises && fraction >= watch->last && fraction <= 1;
  watch->last = fraction;
  watch->calls++;
}

static bool is_cancelled(void *data) {
  const Watch *watch = data;
  return watch->calls > watch->stop_after;
}

static void test_hooks(void) {
  SbModel model = thesis_model(1e-2);
  SbStudy *study = g_new(SbStudy, 1);
  Watch watch = {.stop_after = 3, .rises = true};
  SbStudyHooks hooks = {on_progress, is_cancelled, &watch};
  SbReport report;
  g_assert_cmpint(sb_study_make(study, SB_STUDY_SQUEEZE, &model, &hooks, &report), ==,
                  SB_ERROR_CANCELLED);
  g_assert_cmpint(watch.calls, ==, 4);
  watch = (Watch){.stop_after = 1 << 30, .rises = true};
  g_assert_cmpint(sb_study_make(study, SB_STUDY_MODELS, &model, &hooks, &report), ==, SB_OK);
  g_assert_true(watch.rises);
  g_assert_cmpfloat(watch.last, ==, 1);
  g_assert_cmpint(sb_study_make(study, SB_STUDY_COUNT, &model, NULL, &report), ==, SB_ERROR_INPUT);
  g_free(study);
}

// A range that falls is refused with its key.
static void test_range(void) {
  SbParams params;
  SbModel model;
  SbProblems problems;
  sb_params_init(&params);
  sb_params_set(&params, SB_P_STUDY_SQUEEZE_MIN, 0.3, NULL);
  sb_params_set(&params, SB_P_STUDY_SQUEEZE_MAX, 0.2, NULL);
  g_assert_cmpint(sb_model_compile(&model, &params, &problems), ==, SB_ERROR_INPUT);
  g_assert_cmpstr(problems.item[0].key, ==, "study.squeeze_max");
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/study/table", test_table);
  g_test_add_func("/study/squeeze", test_squeeze);
  g_test_add_func("/study/models", test_models);
  g_test_add_func("/study/hooks", test_hooks);
  g_test_add_func("/study/range", test_range);
  return g_test_run();
}
