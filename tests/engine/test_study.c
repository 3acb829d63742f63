// Studies: their numbers against closed forms and reference figures, their bounds, progress and
// cancel.
#include "app/study/view.h"
#include "engine/contact/fit.h"
#include "engine/valve/model/model.h"
#include "engine/valve/sealbench.h"
#include "engine/valve/studies/study.h"
#include "tests/engine/films.h"
#include "tests/engine/models.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static SbModel thesis_model(double tolerance) {
  SbParams params;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_TOLERANCE, tolerance, NULL), ==, SB_OK);
  SbModel model;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
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
  const Setting stiffer[] = {{SB_P_OUTPUT_TOLERANCE, 1e-2}, {SB_P_SEAL_MODULUS, 2.75e6}};
  compile(&model, stiffer, G_N_ELEMENTS(stiffer));
  study = make(SB_STUDY_MODELS, &model);
  g_assert_true(isnan(cell(study, "0.55 MPa", "load thesis")));
  g_assert_cmpuint(study->note_count, ==, 2);
  g_free(study);
}

// A ring stretched so far that it leaves the bore, where the disc still touches: told by name.
static void test_models_contact(void) {
  const Setting setting[] = {{SB_P_OUTPUT_TOLERANCE, 1e-2},
                             {SB_P_SEAL_OUTER_SECTION_DIAMETER, 1.36e-3 / (1 - 0.075)},
                             {SB_P_SEAL_OUTER_INNER_DIAMETER, 2.66e-3}};
  SbModel model;
  for (int stretched = 0; stretched < 2; stretched++) {
    compile(&model, setting, stretched ? 3 : 1);
    SbStudy *study = make(SB_STUDY_MODELS, &model);
    bool told = false;
    for (size_t i = 0; i < study->warnings.count; i++) {
      told = told || g_str_equal(study->warnings.item[i].code, "disc-ring-contact");
    }
    g_test_message("0 MPa: disc %g N, ring %g N", cell(study, "0.00 MPa", "load disc"),
                   cell(study, "0.00 MPa", "load ring"));
    g_assert_true(told == stretched);
    g_assert_true(study->complete); // without friction as well
    if (stretched) {
      g_assert_cmpfloat(cell(study, "0.00 MPa", "load disc"), >, 0);
      g_assert_cmpfloat(cell(study, "0.00 MPa", "load ring"), ==, 0);
    }
    g_free(study);
  }
}

// The film law over a range where films are thin: the exact exponents and coefficients.
static void test_film_law(void) {
  SbModel model = thesis_model(1e-3);
  model.study.speed_min = 1e-6;
  model.study.speed_max = 1e-3;
  SbStudy *study = make(SB_STUDY_FILM_LAW, &model);
  NEAR(cell(study, "ours, central", "\xce\xb2 of U"), 0.6, 2e-4);
  NEAR(cell(study, "ours, central", "\xce\xb1 of W"), -0.2, 2e-3);
  NEAR(cell(study, "ours, central", "k"), 3.77334, 5e-3);
  NEAR(cell(study, "ours, minimum", "k"), 3.00434, 5e-3);
  g_assert_cmpfloat(cell(study, "ours, central", "residual, largest"), <, 1e-3);
  // The error is the estimate of the solutions, a decade or more below the requested 1e-3.
  g_assert_cmpfloat(study->error, >, 1e-7);
  g_assert_cmpfloat(study->error, <, 1e-4);
  // The thesis' law is some 4 times too thick at 1 um/s: the exponent makes it.
  const SbStudySeries *law = series(study, "law over the solved film", "thesis, eq. 7.5");
  double U = 0.211e-3 * 0.5e-6 / (6.5725e6 * 0.805e-3),
         W = sqrt(300.0 * 1008) / (6.5725e6 * 0.805e-3);
  double expected = 1.492 / 3.77334 * pow(U, 0.5434 - 0.6) * pow(W, -0.2893 + 0.2);
  NEAR(law->y[0], expected, 2e-3);
  g_assert_cmpfloat(cell(study, "thesis, eq. 7.5", "residual, largest"), >, 0.5);
  g_free(study);
}

// A Prony rubber of one term: E falls by g (1 - exp(-t/tau)), and the closed-form load with it.
static void test_storage(void) {
  SbParams params;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_RUBBER_RELAXATION_SHARE_1, 0.3, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_RUBBER_RELAXATION_TIME_1, 86400, NULL), ==, SB_OK);
  SbModel model;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  SbModel before = model;
  SbStudy *study = make(SB_STUDY_STORAGE, &model);
  g_assert_cmpmem(&model, sizeof model, &before, sizeof before);
  const SbStudySeries *modulus = series(study, "modulus after storage", "outer seal");
  const SbStudySeries *load = series(study, "load", "inner seal");
  g_assert_cmpuint(modulus->count, >, 20);
  // Karaszkiewicz without pressure difference: load = circumference x width x sigma_0 ~ E.
  double width = (2 * 0.25 / 1.61 + 0.13) * 1.61e-3;
  for (size_t i = 0; i < modulus->count; i++) {
    double E = 2.5e6 * (1 - 0.3 * (1 - exp(-modulus->x[i] / 86400)));
    NEAR(modulus->y[i], E, 1e-9);
    NEAR(load->y[i], M_PI * 4.45e-3 * width * M_PI / 6 * (2 * 0.25 / 1.61 + 0.13) * E, 1e-9);
  }
  NEAR(cell(study, "new", "modulus after storage"), 2.5e6, 1e-12);
  g_free(study);

  // Swell of 17 % by mass: 0.17 x 1090/1226 by volume, squeeze from the swollen section.
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_RUBBER_SWELL_MASS, 0.17, NULL), ==, SB_OK);
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  study = make(SB_STUDY_STORAGE, &model);
  double d = 1.61e-3 * cbrt(1 + 0.17 * 1090 / 1226);
  NEAR(cell(study, "1 year", "section, free"), d, 1e-9);
  NEAR(cell(study, "1 year", "squeeze"), (d - 1.36e-3) / d, 1e-9);
  g_assert_cmpfloat(cell(study, "1 year", "load, outer seal"), >,
                    cell(study, "1 hour", "load, outer seal"));
  g_free(study);
}

// Curve and cycle have one friction at the cycle's speed, each seal both ways, and the curve goes
// through it: the thesis' set, the solved film with its asperities, the consistent set but its
// rings.
static void test_stribeck_meets(void) {
  const Setting sets[][4] = {
      {{-1, 0}, {-1, 0}, {-1, 0}, {-1, 0}},
      {{SB_P_MODELS_FIT, SB_FIT_DISC}, {SB_P_MODELS_FILM, SB_FILM_REYNOLDS}, {-1, 0}, {-1, 0}},
      {{SB_P_MODELS_SET, SB_MODEL_SET_CONSISTENT},
       {SB_P_MODELS_FIT, SB_FIT_DISC},
       {-1, 0},
       {-1, 0}},
      {{SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC},
       {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
       {SB_P_MODELS_FILM, SB_FILM_REYNOLDS},
       {SB_P_LIFE_ACTUATIONS, 2}}};
  static const char *const lines[] = {"outer seal, in", "outer seal, back", "inner seal, in",
                                      "inner seal, back"};
  for (size_t k = 0; k < G_N_ELEMENTS(sets); k++) {
    SbModel model;
    compile(&model, sets[k], G_N_ELEMENTS(sets[k]));
    const bool hand = model.drive == SB_MODEL_DRIVE_HAND;
    model.study.speed_min = hand ? 0.5 : 2e-4;
    model.study.speed_max = hand ? 50 : 1e-3;
    SbRun *run = run_of(&model, SB_OK, NULL);
    SbStudy *study = make(SB_STUDY_STRIBECK, &model);
    g_assert_true(study->complete);
    for (int i = 0; i < 4; i++) {
      const SbContacts *contact = &sb_run_summary(run)->contact[i / 2];
      const SbContact *cycle = i % 2 == 0 ? &contact->in_stroke : &contact->back;
      const SbStudySeries *friction = series(study, "coefficient of friction", lines[i]);
      const SbStudySeries *film = series(study, "central film over roughness", lines[i]);
      g_assert_cmpfloat(friction->x[friction->count - 1], <=, 10 * (1 + 1e-12));
      size_t at = 0;
      while (at < friction->count && friction->x[at] != fabs(cycle->speed)) {
        at++;
      }
      g_assert_cmpuint(at, <, friction->count - 1);
      g_test_message("%zu, %s at %g m/s: %.9g, %.9g", k, lines[i], friction->x[at], friction->y[at],
                     cycle->friction / cycle->load);
      NEAR(friction->y[at], cycle->friction / cycle->load, 1e-6);
      NEAR(film->y[at], cycle->film_central / model.sigma, 1e-6);
      // No step there: what lies on the straight line through the neighbours, but for its bend.
      const double *x = friction->x + at - 1, *y = friction->y + at - 1;
      const double t = log(x[1] / x[0]) / log(x[2] / x[0]);
      NEAR(y[1], pow(y[0], 1 - t) * pow(y[2], t), 5e-3);
    }
    g_free(study);
    sb_run_destroy(run);
  }
}

// The Stribeck curve: from asperities to the film without a jump; a point solved anew by itself.
static void test_stribeck(void) {
  const Setting coupled[] = {{SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED}};
  SbModel model;
  compile(&model, coupled, 1);
  model.study.speed_min = 1e-3;
  model.study.speed_max = 10;
  SbStudy *study = make(SB_STUDY_STRIBECK, &model);
  const char *name = "outer seal, in";
  const SbStudySeries *friction = series(study, "coefficient of friction", name);
  const SbStudySeries *area = series(study, "real contact", name);
  const SbStudySeries *film = series(study, "central film over roughness", name);
  for (size_t i = 1; i < film->count; i++) {
    g_assert_cmpfloat(film->y[i], >, film->y[i - 1]);
    g_assert_cmpfloat(area->y[i], <, area->y[i - 1]);
    // No jump: a step of the grid is a factor of 1.3 in speed.
    g_assert_cmpfloat(fabs(log(friction->y[i] / friction->y[i - 1])), <, 0.35);
  }
  g_assert_cmpfloat(area->y[0], >, 0.5);
  g_assert_cmpfloat(area->y[area->count - 1], <, 0.1);
  // Karaszkiewicz' load (14.781 N on pi 4.45 mm) less the fluid's half step over the width.
  size_t at = film->count / 2;
  SbFilmProblem problem = rough_seal(film->x[at], SB_ROUGH_GREENWOOD_TRIPP);
  problem.load = 14.781 / (M_PI * 4.45e-3) - 0.55e6 / 2 * 0.9567e-3;
  problem.pressure_left = 0.55e6;
  SbFilm *own = g_new(SbFilm, 1);
  g_assert_cmpint(sb_film_solve(own, &problem, NULL, NULL), ==, SB_OK);
  g_assert_cmpfloat(study->error, <, 0.9e-3); // said, not aimed at
  NEAR(film->y[at], own->film_central / 1e-6, 2e-3);
  NEAR(area->y[at], own->real_area / (2 * own->hertz_half_width), 2e-3);
  g_free(own);
  g_free(study);
}

// Tolerances of the thesis valve by Karaszkiewicz: table 7.3's loads at d -+ 0.02 mm, table 7.2's
// at ID -+ 0.02 mm, the pressure on the stem's land.
static void test_tolerance(void) {
  SbModel model = thesis_model(1e-3);
  SbStudy *study = make(SB_STUDY_TOLERANCE, &model);
  const char *load = "load of the outer seal", *force = "break-away force";
  NEAR(cell(study, load, "nominal"), 14.781, 1e-4);
  NEAR(cell(study, load, "by d, outer"), (15.861 - 13.733) / 2, 1e-3);
  NEAR(cell(study, load, "by ID, outer"), (14.847 - 14.714) / 2, 2e-2);
  g_assert_cmpfloat(cell(study, load, "by d, inner"), ==, 0);
  NEAR(cell(study, force, "by stem"), 0.55e6 * M_PI / 2 * 5.794e-3 * 0.02e-3, 1e-6);
  g_assert_cmpfloat(cell(study, "return margin", "by g"), >, 0);
  NEAR(cell(study, "dose", "nominal"), model.supply.volume * model.density, 1e-12);
  g_assert_cmpfloat(cell(study, "dose", "by bore"), >, 0);
  for (size_t r = 0; r < study->row_count; r++) {
    if (isnan(study->row[r].value[4])) {
      // Valves of the band that do not return have no dose.
      g_assert_cmpstr(study->row[r].name, ==, "dose");
      continue;
    }
    const double *v = study->row[r].value;
    double squares = 0, sum = 0;
    for (int i = 5; i < 12; i++) {
      squares += v[i] * v[i];
      sum += fabs(v[i]);
    }
    NEAR(v[4] - v[0], sqrt(squares), 1e-9);
    NEAR(v[0] - v[3], sqrt(squares), 1e-9);
    // The corner, solved anew, is the sum of the parts but for curvature.
    NEAR(v[2] - v[1], 2 * sum, 0.03);
    g_assert_cmpfloat(v[1], <, v[3]);
    g_assert_cmpfloat(v[2], >, v[4]);
  }
  g_free(study);
}

// Where the leak begins: the closing pressure, and no leak above it, on the coarsest rings too.
static void check_leak(double tolerance) {
  SbModel model;
  const Setting settings[] = {{SB_P_OUTPUT_TOLERANCE, tolerance},
                              {SB_P_MODELS_FIT, SB_FIT_RING}, // fewer curves
                              {SB_P_STUDY_SQUEEZE_MIN, 0.06},
                              {SB_P_STUDY_SQUEEZE_MAX, 0.12}};
  compile(&model, settings, G_N_ELEMENTS(settings));
  SbStudy *study = make(SB_STUDY_LEAK, &model);
  double closing = series(study, "pressure of the rubber on the bore", "channels close")->y[0];
  const char *name = "ring, 0.055 MPa";
  const SbStudySeries *pressure = series(study, "pressure of the rubber on the bore", name);
  const SbStudySeries *leak = series(study, "leak at rest", name);
  size_t leaking = 0;
  for (size_t i = 0; i < leak->count; i++) {
    g_assert_true(i == 0 || leak->x[i] > leak->x[i - 1]);
    if (isfinite(leak->y[i])) {
      g_assert_cmpfloat(pressure->y[i], <, closing);
      leaking++;
    }
    if (pressure->y[i] > closing) {
      g_assert_true(isnan(leak->y[i]));
    }
  }
  // The refinement puts points where it matters.
  g_assert_cmpuint(leaking, >=, 3);
  g_assert_nonnull(strstr(study->note[2], "closed from"));
  // As designed and under pressure nothing leaks.
  g_assert_cmpfloat(cell(study, "15.5 %, 0.55 MPa", "leak at rest ring"), ==, 0);
  g_assert_cmpfloat(cell(study, "15.5 %, 0.55 MPa", "per stroke ring"), >, 0);
  g_free(study);
}

static void test_leak(void) {
  check_leak(1e-1);
}

static void test_leak_fine(void) {
  check_leak(1e-2);
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

// True from the poll on that brings the count to 0.
static bool poll_cancels(void *data) {
  int *left = data;
  return --*left <= 0;
}

// A cancel is told alike between two answers and inside one.
static void test_cancelled(void) {
  SbModel model = thesis_model(1e-2);
  g_autofree SbStudy *study = g_new(SbStudy, 1);
  for (int polls = 1; polls < 60; polls += polls < 12 ? 1 : 16) {
    int left = polls;
    const SbStudyHooks hooks = {NULL, poll_cancels, &left};
    SbReport report = {0};
    g_assert_cmpint(sb_study_make(study, SB_STUDY_SQUEEZE, &model, &hooks, &report), ==,
                    SB_ERROR_CANCELLED);
    g_assert_cmpstr(report.text, ==, "the study was cancelled");
  }
  // One without a grid, before it has begun: a sanitizer sees that nothing stays behind.
  int left = 1;
  const SbStudyHooks hooks = {NULL, poll_cancels, &left};
  SbReport report = {0};
  g_assert_cmpint(sb_study_make(study, SB_STUDY_STRIBECK, &model, &hooks, &report), ==,
                  SB_ERROR_CANCELLED);
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

static SbStudy *make_rings(SbModel *model, double work_limit) {
  SbParams params;
  // Little friction: rings that are dragged much take seconds.
  const SbOverride few[] = {
      {SB_P_MODELS_FIT, SB_FIT_RING},       {SB_P_FRICTION_LOAD_COEFFICIENT, 0.02},
      {SB_P_FRICTION_SHEAR_STRENGTH, 1e5},  {SB_P_STUDY_TEMPERATURE_MIN, 263.15},
      {SB_P_STUDY_TEMPERATURE_MAX, 305.15}, {SB_P_OUTPUT_TOLERANCE, 1e-2},
      {SB_P_OUTPUT_WORK_LIMIT, work_limit}};
  sb_params_init(&params);
  for (size_t i = 0; i < G_N_ELEMENTS(few); i++) {
    g_assert_cmpint(sb_params_set(&params, few[i].id, few[i].value, NULL), ==, SB_OK);
  }
  g_assert_cmpint(sb_model_compile(model, &params, NULL, NULL), ==, SB_OK);
  return make(SB_STUDY_PROPELLANTS, model);
}

// Pressures whose rings do not converge are left out while three are there: the rest is
// interpolated within an error. With fewer the study has a gap.
static void test_bridged(void) {
  SbModel model;
  SbStudy *study = make_rings(&model, 3500);
  int pressures = 0;
  g_assert_cmpint(sscanf(study->models, "rings solved at %d", &pressures), ==, 1);
  g_test_message("%s", study->models);
  g_assert_cmpint(pressures, >=, 3);
  g_assert_cmpint(pressures, <, 6);
  g_assert_true(study->complete);
  g_assert_cmpfloat(study->error, >, 0);
  g_free(study);
  study = make_rings(&model, 1000);
  g_assert_false(study->complete);
  g_assert_null(strstr(study->models, "interpolated"));
  g_assert_nonnull(strstr(study->gap, "work limit"));
  g_assert_true(isfinite(study->gap_at));
  g_free(study);
}

// Propellants with solved rings: some pressures are solved, and the friction in between has an
// error estimate: where nothing was solved a cycle agrees within it.
static void test_rings(void) {
  SbModel model;
  SbStudy *study = make_rings(&model, 1e6);
  g_assert_true(study->complete);
  g_assert_nonnull(strstr(study->models, "rings solved at"));
  int pressures = 0;
  double told = NAN;
  g_assert_cmpint(sscanf(study->models, "rings solved at %d", &pressures), ==, 1);
  g_assert_cmpint(sscanf(strstr(study->models, "within"), "within %lf", &told), ==, 1);
  g_assert_cmpfloat(told, <, 5);
  g_assert_cmpint(pressures, >=, 6);
  g_assert_cmpint(pressures, <=, 8);
  const SbOverride here[] = {{SB_P_FLUID_NAME, 3}, {SB_P_CANISTER_TEMPERATURE, 293.15}};
  SbEvaluator *evaluator;
  const int figure[] = {sb_figure_find("cycle.force_breakaway_N"),
                        sb_figure_find("cycle.force_return_margin_N")};
  double value[2];
  const SbQuestion question = {
      .base = &model, .override = here, .override_count = 2, .figure = figure, .figure_count = 2};
  g_assert_cmpint(sb_evaluator_create(&evaluator, NULL), ==, SB_OK);
  g_assert_cmpint(sb_evaluator_ask(value, evaluator, &question, NULL), ==, SB_OK);
  const double force = sb_model_pressure_force(sb_evaluator_model(evaluator));
  const char *row = "HFA-152a, 20 \xc2\xb0"
                    "C";
  const double within = 0.01 * fmax(told, 0.1);
  NEAR(cell(study, row, "break-away") - force, value[0] - force, within);
  NEAR(force - cell(study, row, "return margin"), force - value[1], within);
  sb_evaluator_destroy(evaluator);
  g_free(study);
}

// A study with a solver that failed names the first place and the reason, which names the seal.
static void test_gap(void) {
  SbParams params;
  SbModel model;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_FILM, SB_FILM_REYNOLDS, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_WORK_LIMIT, 1, NULL), ==, SB_OK);
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  SbStudy *study = make(SB_STUDY_TOLERANCE, &model);
  g_test_message("at %g: %s", study->gap_at, study->gap);
  g_assert_false(study->complete);
  g_assert_nonnull(strstr(study->gap, "seal"));
  g_free(study);
}

// A study ends within its budget of work, with what it has finished, and names solver, seal and
// place; each of its solves needs far less than the budget.
static void test_budget(void) {
  static const SbStudyKind kinds[] = {SB_STUDY_PROPELLANTS, SB_STUDY_TOLERANCE, SB_STUDY_FILM_LAW,
                                      SB_STUDY_STRIBECK};
  for (size_t i = 0; i < G_N_ELEMENTS(kinds); i++) {
    SbParams params;
    SbModel model;
    size_t work = 0;
    sb_params_init(&params);
    g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_FILM, SB_FILM_REYNOLDS, NULL), ==, SB_OK);
    g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_TOLERANCE, 1e-2, NULL), ==, SB_OK);
    for (int cut = 0; cut < 2; cut++) {
      if (cut) {
        const double limit = floor(0.7 * (double)work);
        g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_WORK_LIMIT, limit, NULL), ==, SB_OK);
      }
      g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
      SbStudy *study = make(kinds[i], &model);
      g_test_message("%s: %zu steps; %s", sb_study_name(kinds[i]), study->work, study->gap);
      g_assert_cmpint(study->complete, ==, !cut);
      g_assert_cmpuint(study->work, <=, (size_t)model.work_limit);
      g_assert_cmpuint(study->work, >, 0);
      if (cut) {
        g_assert_nonnull(strstr(study->gap, "work limit"));
        g_assert_nonnull(strstr(study->gap, "film (reynolds), "));
        g_assert_nonnull(strstr(study->gap, " seal, "));
        g_assert_cmpuint(study->warnings.count, >, 0);
      }
      work = study->work;
      g_free(study);
    }
  }
}

// Places solved side by side are those solved one after the other, to the bit, and a cancel ends
// them.
static void test_side_by_side(void) {
  SbModel model = thesis_model(1e-3);
  SbStudy *study = make(SB_STUDY_PROPELLANTS, &model), *again = make(SB_STUDY_PROPELLANTS, &model);
  g_assert_cmpmem(study, sizeof *study, again, sizeof *again);
  const double *x = series(study, "return margin", "HFA-134a")->x;
  g_assert_cmpfloat(fabs(x[0] - 253.15), <, 1e-9);
  SbEvaluator *evaluator;
  g_assert_cmpint(sb_evaluator_create(&evaluator, NULL), ==, SB_OK);
  const int figure = sb_figure_find("cycle.force_return_margin_N");
  for (int i = 0; i < 29; i += 7) {
    const SbOverride here[] = {{SB_P_FLUID_NAME, 1}, {SB_P_CANISTER_TEMPERATURE, x[i]}};
    const SbQuestion question = {.base = &model,
                                 .override = here,
                                 .override_count = 2,
                                 .figure = &figure,
                                 .figure_count = 1};
    double value;
    g_assert_cmpint(sb_evaluator_ask(&value, evaluator, &question, NULL), ==, SB_OK);
    g_assert_cmpfloat(series(study, "return margin", "HFA-134a")->y[i], ==, value);
  }
  sb_evaluator_destroy(evaluator);
  Watch watch = {.stop_after = 20, .rises = true};
  SbStudyHooks hooks = {on_progress, is_cancelled, &watch};
  g_assert_cmpint(sb_study_make(again, SB_STUDY_PROPELLANTS, &model, &hooks, NULL), ==,
                  SB_ERROR_CANCELLED);
  g_assert_true(watch.rises);
  watch = (Watch){.stop_after = 1 << 30, .rises = true};
  g_assert_cmpint(sb_study_make(again, SB_STUDY_PROPELLANTS, &model, &hooks, NULL), ==, SB_OK);
  g_assert_true(watch.rises);
  g_free(again);
  g_free(study);
}

// A range that falls is refused with its key.
static void test_range(void) {
  SbParams params;
  SbModel model;
  SbProblems problems;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_STUDY_SQUEEZE_MIN, 0.3, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_STUDY_SQUEEZE_MAX, 0.2, NULL), ==, SB_OK);
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, &problems), ==, SB_ERROR_INPUT);
  g_assert_cmpstr(problems.item[0].key, ==, "study.squeeze_max");
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/study/table", test_table);
  g_test_add_func("/study/models", test_models);
  g_test_add_func("/study/models-contact", test_models_contact);
  g_test_add_func("/study/film-law", test_film_law);
  g_test_add_func("/study/storage", test_storage);
  g_test_add_func("/study/stribeck", test_stribeck);
  g_test_add_func("/study/stribeck-meets", test_stribeck_meets);
  g_test_add_func("/study/tolerance", test_tolerance);
  g_test_add_func("/study/leak", test_leak);
  g_test_add_func("/study/hooks", test_hooks);
  g_test_add_func("/study/cancelled", test_cancelled);
  g_test_add_func("/study/range", test_range);
  g_test_add_func("/study/side-by-side", test_side_by_side);
  g_test_add_func("/study/gap", test_gap);
  g_test_add_func("/study/budget", test_budget);
  if (g_test_slow()) {
    g_test_add_func("/study/squeeze", test_squeeze);
    g_test_add_func("/study/leak-fine", test_leak_fine);
    g_test_add_func("/study/rings", test_rings);
    g_test_add_func("/study/bridged", test_bridged);
  }
  return g_test_run();
}
