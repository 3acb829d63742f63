// Karaszkiewicz, Hertz and E' against the thesis' printed tables, closed identities and limits, and
// every way in which they warn or refuse.
#include "engine/contact/closed_forms.h"
#include "engine/contact/deflection.h"
#include "engine/contact/fit.h"
#include "tests/engine/near.h"
#include "tests/engine/seals.h"

#include <glib.h>
#include <math.h>

static void test_reduced_modulus(void) {
  assert_close(sb_reduced_modulus(2.5e6, 0.49, 2.6e9, 0.35), 6.5725e6, 1e-5);
  assert_close(sb_reduced_modulus(2.5e6, 0.49, 0.0, 0.0), 2.0 * 2.5e6 / (1.0 - 0.49 * 0.49), 1e-15);
  assert_close(sb_reduced_modulus(2.5e6, 0.49, INFINITY, 0.3), 2.0 * 2.5e6 / (1.0 - 0.49 * 0.49),
               1e-15);
  g_assert_true(isinf(sb_reduced_modulus(0.0, 0.3, INFINITY, 0.3)));
}

// Tables 7.2 to 7.4, columns of Karaszkiewicz. Printed to five digits in load (four in width),
// hence the tolerance of 0.01 %.
static void test_karaszkiewicz_tables(void) {
  const struct {
    double id_mm, d_mm, p_mpa, width_mm, load, peak;
  } row[] = {
      {2.82, 1.61, 0.55, 0.9567, 14.714, 1407084.8}, {2.84, 1.61, 0.55, 0.9567, 14.781, 1407084.8},
      {2.86, 1.61, 0.55, 0.9567, 14.847, 1407084.8}, {2.84, 1.59, 0.55, 0.9160, 13.733, 1371666.7},
      {2.84, 1.63, 0.55, 0.9976, 15.861, 1441633.6}, {2.84, 1.61, 0.00, 0.7093, 5.719, 734265.0},
      {2.84, 1.61, 0.29, 0.8700, 10.403, 1089024.5},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(row); i++) {
    SbFitProblem in = thesis(SB_FIT_KARASZKIEWICZ);
    in.inner_diameter = 1e-3 * row[i].id_mm;
    in.section_diameter = 1e-3 * row[i].d_mm;
    in.pressure = 1e6 * row[i].p_mpa;
    SbFit fit;
    g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_OK);
    assert_close(fit.contact_width, 1e-3 * row[i].width_mm, 1e-4);
    assert_close(fit.load, row[i].load, 1e-4);
    assert_close(fit.pressure_peak, row[i].peak, 1e-6);
    g_assert_true(!fit.valid && fit.touches && fit.solver.converged);
    g_assert_cmpuint(fit.warnings.count, ==, 1);
    g_assert_true(warned(&fit.warnings, "stretch-interference"));
  }
}

// Each closed form on the fitted section is that form on an unstretched ring of this section. With
// an inner diameter of 2.4 mm the solved ring carries 0.847 N (docs/verification.md): the free
// section gives six times this load, the fitted one less than three times.
static void test_fitted_section(void) {
  for (int m = SB_FIT_KARASZKIEWICZ; m <= SB_FIT_GREEN_ENGLISH; m++) {
    SbFitProblem in = thesis((SbFitModel)m);
    in.inner_diameter = 2.4e-3;
    SbFit free, fitted, round;
    g_assert_cmpint(sb_fit_solve(&free, &in, NULL), ==, SB_OK);
    in.fitted_section = true;
    g_assert_cmpint(sb_fit_solve(&fitted, &in, NULL), ==, SB_OK);
    in.fitted_section = false;
    in.section_diameter = fitted.section_diameter_fitted;
    in.inner_diameter = in.bore_diameter - in.radial_space - in.section_diameter;
    g_assert_cmpint(sb_fit_solve(&round, &in, NULL), ==, SB_OK);
    g_assert_cmpfloat(free.load, >, 4 * 0.847);
    g_assert_cmpfloat(fitted.load, <, 3 * 0.847);
    assert_close(fitted.load_per_length, round.load_per_length, 1e-12);
    assert_close(fitted.contact_width, round.contact_width, 1e-12);
    g_assert_true(warned(&free.warnings, "stretch-interference"));
    g_assert_true(warned(&fitted.warnings, "stretch-interference"));
    g_assert_false(warned(&round.warnings, "stretch-interference"));
  }
}

// The warning begins at 3 % of the unstretched interference, for stretch and for compression alike;
// the ring solves its stretch.
static void test_stretch_warning(void) {
  const double limit = 0.03 * 0.25e-3; // of d - g
  for (int sign = -1; sign <= 1; sign += 2) {
    for (int beyond = 0; beyond < 2; beyond++) {
      SbFitProblem in = thesis(SB_FIT_KARASZKIEWICZ);
      const double moved = sign * limit * (beyond ? 1.01 : 0.99);
      const double stretch = moved / (in.poisson_ratio * in.section_diameter);
      in.inner_diameter =
          (in.bore_diameter - in.radial_space) / (1 + stretch) - in.section_diameter;
      SbFit fit;
      g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_OK);
      g_assert_cmpint(warned(&fit.warnings, "stretch-interference"), ==, beyond);
      in.model = SB_FIT_DISC;
      g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_OK);
      g_assert_cmpint(warned(&fit.warnings, "stretch-interference"), ==, beyond);
    }
  }
}

// The estimate of when a stretched ring leaves the bore, against solved rings: those of the thesis'
// section do between inner diameters of 2.26 and 2.28 mm (sealbench fit --model ring), where the
// estimate is within the 0.02 mm that the header states; the thesis' own ring is far from it.
static void test_interference_on_floor(void) {
  SbFitProblem in = thesis(SB_FIT_KARASZKIEWICZ);
  g_assert_cmpfloat(sb_interference_on_floor(&in), >, 0.15e-3);
  in.inner_diameter = 2.27e-3;
  const double left = sb_interference_on_floor(&in);
  g_assert_cmpfloat(left, <, 0);
  g_assert_cmpfloat(left, >, -0.025e-3);
  in.inner_diameter = in.bore_diameter - in.radial_space - in.section_diameter; // no stretch
  assert_close(sb_interference_on_floor(&in), 0.25e-3, 1e-12);
}

// The profile carries the load and reaches the peak: trapezium rule in the angle of its points.
static void test_profile(void) {
  SbFitProblem in = thesis(SB_FIT_KARASZKIEWICZ);
  in.pressure = 0.55e6;
  SbFit fit;
  g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_OK);
  double load = 0.0;
  double peak = 0.0;
  for (size_t i = 1; i < fit.profile_count; i++) {
    g_assert_cmpfloat(fit.profile_x[i], >, fit.profile_x[i - 1]);
    load +=
        0.5 * (fit.profile_p[i] + fit.profile_p[i - 1]) * (fit.profile_x[i] - fit.profile_x[i - 1]);
    peak = fmax(peak, fit.profile_p[i]);
  }
  assert_close(load, fit.load_per_length, 1e-4);
  assert_close(peak, fit.pressure_peak, 1e-12);
  g_assert_cmpfloat(fit.profile_x[0], ==, fit.contact_left);
  g_assert_cmpfloat(fit.profile_x[fit.profile_count - 1], ==, fit.contact_right);
}

// Sizes by the definitions of docs/results.md.
static void test_sizes(void) {
  SbFitProblem in = thesis(SB_FIT_KARASZKIEWICZ);
  SbFit fit;
  g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_OK);
  assert_close(fit.squeeze, 0.25 / 1.61, 1e-12);
  assert_close(fit.stretch_mean, 0.19 / 4.45, 1e-12);
  assert_close(fit.stretch_inner, 0.44 / 2.84, 1e-12);
  assert_close(fit.section_diameter_fitted, 1.5763e-3, 3e-5);
  assert_close(fit.interference, 0.2163e-3, 3e-4);
  assert_close(fit.circumference, 13.98e-3, 1e-4);
  // Ring volume over gland volume, both as solids of revolution.
  double ring = 0.25 * M_PI * 1.61 * 1.61 * M_PI * 4.45;
  double gland = 0.25 * M_PI * (6.0 * 6.0 - 3.28 * 3.28) * 2.0;
  assert_close(fit.gland_fill, ring / gland, 1e-12);
}

static void test_hertz(void) {
  // 6.33 with the factor 8: 0.515 mm and 1.05 MPa at 850.2 N/m (docs/thesis.md, 6), from the
  // approach that Johnson's 5.58 gives for that load.
  const double disc = 2.5e6 / (1 - 0.49 * 0.49), radius = 0.805e-3, modulus = 6.5725e6;
  double b = sb_hertz_half_width(850.2, radius, modulus);
  assert_close(b, 0.515e-3, 1e-3);
  assert_close(2 * 850.2 / (M_PI * b), 1.05e6, 2e-3);
  double approach = 2 * 850.2 / (M_PI * disc) * (2 * log(4 * radius / b) - 1);
  assert_close(sb_hertz_width_of_approach(approach / radius, 4 * disc / modulus), b / radius,
               1e-12);

  // Row "Hertz" of the reference figures: rigid flats, squeeze 0.25/1.61.
  SbFitProblem in = thesis(SB_FIT_HERTZ);
  in.housing_modulus = 0.0;
  SbFit fit;
  g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_OK);
  assert_close(fit.load_per_length / (2.5e6 * 1.61e-3), 0.0917, 6e-4);
  assert_close(fit.contact_width / 1.61e-3, 0.4212, 2e-4);
  assert_close(fit.pressure_peak / 2.5e6, 0.2771, 2e-4);

  // Small squeeze: the width vanishes with it and stays finite.
  for (double squeeze = 1e-2; squeeze > 1e-12; squeeze *= 0.1) {
    const double t = sb_hertz_width_of_approach(squeeze, 2.0);
    assert_close(t * t * (2 * log(4 / t) - 1), 2.0 * squeeze, 1e-12);
  }
}

// Figures by hand for the thesis' ring: 4.34 N with D = 4.45 mm, widths 0.618 and 0.600 mm
// (2.10, 2.11), Kuran 2.5 x = 0.625 mm, and the identity 2.9.
static void test_lindley(void) {
  SbFit fit[SB_LINDLEY_COUNT];
  for (int i = 0; i < SB_LINDLEY_COUNT; i++) {
    SbFitProblem in = thesis(SB_FIT_LINDLEY);
    in.variant = i;
    g_assert_cmpint(sb_fit_solve(&fit[i], &in, NULL), ==, SB_OK);
  }
  assert_close(fit[SB_LINDLEY_EXTENDED].load, 4.34, 2e-3);
  assert_close(fit[SB_LINDLEY_EXTENDED].contact_width, 0.618e-3, 1e-3);
  assert_close(fit[SB_LINDLEY_SIMPLE_WIDTH].contact_width, 0.600e-3, 1e-12);
  assert_close(fit[SB_LINDLEY_KURAN].contact_width, 0.625e-3, 1e-12);
  g_assert_cmpfloat(fit[SB_LINDLEY_KURAN].load, ==, fit[SB_LINDLEY_EXTENDED].load);
  const double b = fit[SB_LINDLEY_EXTENDED].contact_width;
  assert_close(fit[SB_LINDLEY_EXTENDED].load, M_PI * M_PI * b * b * 4.45e-3 * 2.5e6 / (6 * 1.61e-3),
               1e-12);
  // Reference figures: 0.0772 and width 0.373 d at 15.53 % (the initial formula gives 0.0765,
  // 0.382).
  assert_close(fit[SB_LINDLEY_EXTENDED].load_per_length / (2.5e6 * 1.61e-3), 0.0772, 1e-3);
  assert_close(fit[SB_LINDLEY_SIMPLE_WIDTH].contact_width / 1.61e-3, 0.373, 1e-3);
  assert_close(fit[SB_LINDLEY_INITIAL].load,
               M_PI * 1.61e-3 * 4.45e-3 * 2.5e6 * 1.25 * pow(0.25 / 1.61, 1.5), 1e-12);
}

// Every row of table 2.1 at 5, 15.5 and 30 % squeeze, computed apart from this program.
static void test_green_english(void) {
  const struct {
    const char *name;
    double factor[3];
  } row[] = {
      {"axial-unrestrained-lubricated", {0.0176112292685, 0.0777654944192, 0.217437703834}},
      {"axial-unrestrained-unlubricated", {0.0203892324906, 0.096524770519, 0.301200143362}},
      {"radial-unrestrained", {0.0221551758873, 0.104903131114, 0.330816268595}},
      {"plane-strain-unrestrained", {0.0204957389979, 0.0970113264244, 0.303969594374}},
      {"axial-restrained", {0.0259218540211, 0.166775524386, 1.63553524421}},
      {"radial-restrained", {0.027786360354, 0.1794967069, 1.8953023003}},
      {"plane-strain-restrained", {0.0249428230374, 0.155559800491, 1.39505942735}},
  };
  const double squeeze[3] = {0.05, 0.155, 0.30};
  for (size_t i = 0; i < G_N_ELEMENTS(row); i++) {
    int variant = 0;
    while (!g_str_equal(sb_fit_variant_name(SB_FIT_GREEN_ENGLISH, variant), row[i].name)) {
      variant++;
    }
    for (int k = 0; k < 3; k++) {
      SbFitProblem in = thesis(SB_FIT_GREEN_ENGLISH);
      in.variant = variant;
      in.radial_space = (1.0 - squeeze[k]) * in.section_diameter;
      SbFit fit;
      g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_OK);
      assert_close(fit.load / (M_PI * 1.61e-3 * 4.45e-3 * 2.5e6), row[i].factor[k], 1e-9);
      assert_close(fit.load,
                   M_PI * M_PI * pow(fit.contact_width, 2) * 4.45e-3 * 2.5e6 / (6 * 1.61e-3),
                   1e-12);
    }
  }
  g_assert_cmpint(G_N_ELEMENTS(row), ==, SB_GREEN_ENGLISH_COUNT);
  // Reference figure: plane strain 0.0973 at 0.25/1.61.
  SbFitProblem in = thesis(SB_FIT_GREEN_ENGLISH);
  in.variant = SB_GREEN_ENGLISH_PLANE;
  SbFit plane;
  g_assert_cmpint(sb_fit_solve(&plane, &in, NULL), ==, SB_OK);
  assert_close(plane.load_per_length / (2.5e6 * 1.61e-3), 0.0973, 1e-3);
}

static void test_no_contact(void) {
  for (int model = SB_FIT_KARASZKIEWICZ; model <= SB_FIT_GREEN_ENGLISH; model++) {
    SbFitProblem in = thesis((SbFitModel)model);
    in.section_diameter = 1.30e-3;
    in.pressure = 0.55e6;
    SbFit fit;
    g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_OK);
    g_assert_cmpfloat(fit.load, ==, 0.0);
    g_assert_cmpfloat(fit.contact_width, ==, 0.0);
    g_assert_cmpfloat(fit.pressure_peak, ==, 0.0);
    g_assert_cmpuint(fit.profile_count, ==, 0);
    g_assert_true(fit.valid);
    g_assert_false(fit.touches);
    g_assert_true(warned(&fit.warnings, "no-contact"));
  }
}

// One row for each validity warning: what triggers it, and a neighbour that does not.
static void test_warnings(void) {
  const struct {
    SbFitModel model;
    double d_mm, p_mpa;
    const char *code; // NULL: valid
    int variant;
    double poisson; // 0: 0.49
  } row[] = {
      {SB_FIT_KARASZKIEWICZ, 1.46, 0.0, "karaszkiewicz-squeeze", 0, 0.0}, // 6.8 %
      {SB_FIT_KARASZKIEWICZ, 1.47, 0.0, NULL, 0, 0.0},                    // 7.5 %
      {SB_FIT_KARASZKIEWICZ, 1.81, 0.0, NULL, 0, 0.0},                    // 24.9 %
      {SB_FIT_KARASZKIEWICZ, 1.82, 0.0, "karaszkiewicz-squeeze", 0, 0.0}, // 25.3 %
      {SB_FIT_HERTZ, 1.45, 0.0, NULL, 0, 0.0},                            // b/R 0.26
      {SB_FIT_HERTZ, 1.61, 0.0, "hertz-width", 0, 0.0},                   // b/R 0.42
      {SB_FIT_HERTZ, 1.45, 0.2, "pressure-ignored", 0, 0.0},
      {SB_FIT_LINDLEY, 1.81, 0.0, NULL, SB_LINDLEY_EXTENDED, 0.0},
      {SB_FIT_LINDLEY, 1.82, 0.0, "lindley-squeeze", SB_LINDLEY_EXTENDED, 0.0},
      {SB_FIT_LINDLEY, 1.82, 0.0, "lindley-squeeze", SB_LINDLEY_KURAN, 0.0},
      {SB_FIT_LINDLEY, 1.59, 0.0, NULL, SB_LINDLEY_INITIAL, 0.0},
      {SB_FIT_LINDLEY, 1.61, 0.0, "lindley-squeeze", SB_LINDLEY_INITIAL, 0.0},
      {SB_FIT_LINDLEY, 1.61, 0.2, "pressure-ignored", SB_LINDLEY_EXTENDED, 0.0},
      {SB_FIT_LINDLEY, 1.61, 0.0, "incompressible-assumed", SB_LINDLEY_EXTENDED, 0.44},
      {SB_FIT_GREEN_ENGLISH, 1.99, 0.0, NULL, SB_GREEN_ENGLISH_RADIAL, 0.0},
      {SB_FIT_GREEN_ENGLISH, 2.01, 0.0, "green-english-squeeze", SB_GREEN_ENGLISH_RADIAL, 0.0},
      {SB_FIT_GREEN_ENGLISH, 1.51, 0.0, NULL, SB_GREEN_ENGLISH_RADIAL_RESTRAINED, 0.0},
      {SB_FIT_GREEN_ENGLISH, 1.52, 0.0, "green-english-squeeze", SB_GREEN_ENGLISH_RADIAL_RESTRAINED,
       0.0},
      {SB_FIT_GREEN_ENGLISH, 1.61, 0.2, "pressure-ignored", SB_GREEN_ENGLISH_PLANE, 0.0},
      {SB_FIT_GREEN_ENGLISH, 1.61, 0.0, "incompressible-assumed", SB_GREEN_ENGLISH_PLANE, 0.44},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(row); i++) {
    SbFitProblem in = thesis(row[i].model);
    in.section_diameter = 1e-3 * row[i].d_mm;
    in.pressure = 1e6 * row[i].p_mpa;
    in.variant = row[i].variant;
    in.poisson_ratio = row[i].poisson > 0.0 ? row[i].poisson : in.poisson_ratio;
    in.inner_diameter = in.bore_diameter - in.radial_space - in.section_diameter; // no stretch
    in.gland_width = 4 * in.section_diameter;                                     // not full
    SbFit fit;
    g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_OK);
    g_assert_cmpint(fit.valid, ==, row[i].code == NULL);
    g_assert_cmpuint(fit.warnings.count, ==, row[i].code == NULL ? 0 : 1);
    if (row[i].code != NULL) {
      g_assert_true(warned(&fit.warnings, row[i].code));
    }
  }
}

// Everything unphysical is refused with the key at fault and leaves no number behind.
static void test_refusals(void) {
  const struct {
    size_t offset;
    double value;
    const char *key;
    SbStatus status;
  } row[] = {
      {G_STRUCT_OFFSET(SbFitProblem, section_diameter), 0.0, "seal.section_diameter",
       SB_ERROR_RANGE},
      {G_STRUCT_OFFSET(SbFitProblem, section_diameter), NAN, "seal.section_diameter",
       SB_ERROR_RANGE},
      {G_STRUCT_OFFSET(SbFitProblem, inner_diameter), -1e-3, "seal.inner_diameter", SB_ERROR_RANGE},
      {G_STRUCT_OFFSET(SbFitProblem, modulus), INFINITY, "seal.modulus", SB_ERROR_RANGE},
      {G_STRUCT_OFFSET(SbFitProblem, poisson_ratio), 0.5, "seal.poisson_ratio", SB_ERROR_RANGE},
      {G_STRUCT_OFFSET(SbFitProblem, poisson_ratio), NAN, "seal.poisson_ratio", SB_ERROR_RANGE},
      {G_STRUCT_OFFSET(SbFitProblem, housing_modulus), -1.0, "housing.modulus", SB_ERROR_RANGE},
      {G_STRUCT_OFFSET(SbFitProblem, housing_poisson), 0.6, "housing.poisson_ratio",
       SB_ERROR_RANGE},
      {G_STRUCT_OFFSET(SbFitProblem, radial_space), 0.0, "gland.radial_space", SB_ERROR_RANGE},
      {G_STRUCT_OFFSET(SbFitProblem, gland_width), 0.0, "gland.axial_width", SB_ERROR_RANGE},
      {G_STRUCT_OFFSET(SbFitProblem, pressure), INFINITY, "canister.pressure", SB_ERROR_RANGE},
      {G_STRUCT_OFFSET(SbFitProblem, tolerance), 1.0, "", SB_ERROR_RANGE},
      {G_STRUCT_OFFSET(SbFitProblem, bore_diameter), 2.72e-3, "bore.diameter", SB_ERROR_INFEASIBLE},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(row); i++) {
    SbFitProblem in = thesis(SB_FIT_KARASZKIEWICZ);
    G_STRUCT_MEMBER(double, &in, row[i].offset) = row[i].value;
    SbFit fit;
    SbReport report = {0};
    g_assert_cmpint(sb_fit_solve(&fit, &in, &report), ==, row[i].status);
    g_assert_cmpstr(sb_input_key(report.input), ==, row[i].key);
    g_assert_cmpfloat(fit.load, ==, 0.0);
  }

  // A disc squeezed so far that Hertz's contact would be as wide as itself.
  SbFitProblem in = thesis(SB_FIT_HERTZ);
  in.section_diameter = 3.0e-3;
  SbFit fit;
  SbReport report = {0};
  g_assert_cmpint(sb_fit_solve(&fit, &in, &report), ==, SB_ERROR_INFEASIBLE);
  in.variant = 99;
  g_assert_cmpint(sb_fit_solve(&fit, &in, &report), ==, SB_ERROR_INPUT);
}

static void test_names(void) {
  for (int i = 0; i < SB_FIT_MODEL_COUNT; i++) {
    SbFitModel model;
    g_assert_true(sb_fit_model_from_name(&model, sb_fit_kind((SbFitModel)i)->name));
    g_assert_cmpint(model, ==, i);
    g_assert_nonnull(sb_fit_variant_name(model, 0));
    g_assert_null(sb_fit_variant_name(model, 1000));
    g_assert_null(sb_fit_variant_name(model, -1));
  }
  SbFitModel untouched = SB_FIT_RING;
  g_assert_false(sb_fit_model_from_name(&untouched, "no such model"));
  g_assert_cmpint(untouched, ==, SB_FIT_RING);
  g_assert_null(sb_fit_kind(SB_FIT_MODEL_COUNT));
}

// Deflections of the models that the thesis dropped: the half-space is the sum of line loads, and
// of panels, over Hertz's pressure; the disc's approach is Hertz's; columns are that of one at nu =
// 0.
static void test_deflections(void) {
  enum { PANELS = 4000 };
  const double b = 0.3e-3, R = 0.805e-3, E = 2.5e6, nu = 0.49, plane = E / (1 - nu * nu);
  // A half-space on a rigid body: E'/2 = plane, p0 = b E'/(4 R).
  const double peak = b * plane / (2 * R), width = 2 * b / PANELS;
  const double places[] = {0.2 * b, 0.9 * b, 1.5 * b, 4 * b};
  for (size_t i = 0; i < G_N_ELEMENTS(places); i++) {
    double panels = 0, lines = 0;
    for (int k = 0; k < PANELS; k++) {
      const double at = -b + (k + 0.5) * width, p = peak * sqrt(1 - at * at / (b * b));
      panels += p * 2 / (M_PI * plane) *
                (sb_deflection_panel(-at, width) - sb_deflection_panel(places[i] - at, width));
      lines += sb_deflection_flamant(places[i] - at, -p * width, fabs(at), E, nu);
    }
    const double told = sb_deflection_half_space(places[i], b, R);
    g_assert_cmpfloat_with_epsilon(panels / told, 1, 1e-3);
    g_assert_cmpfloat_with_epsilon(lines / told, 1, 2e-2); // a node may lie on its load
  }
  g_assert_cmpfloat_with_epsilon(sb_deflection_half_space(0.5 * b, b, R), 0.125 * b * b / R, 1e-15);
  g_assert_cmpfloat_with_epsilon(sb_deflection_column(1e5, 1e-3, 2e6, 0), 5e-5, 1e-12);
  g_assert_cmpfloat_with_epsilon(sb_deflection_column(1e5, 1e-3, 2e6, 0.5), 0, 1e-15);
  const double approach = 0.1, t = sb_hertz_width_of_approach(approach, 2);
  const double load = M_PI * 2 * plane * t * t * R / 8;
  g_assert_cmpfloat_with_epsilon(sb_deflection_disc(load, t * R, R, E, nu) / R, approach / 2, 1e-6);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/elastic/reduced-modulus", test_reduced_modulus);
  g_test_add_func("/elastic/karaszkiewicz/tables", test_karaszkiewicz_tables);
  g_test_add_func("/elastic/fit/profile", test_profile);
  g_test_add_func("/elastic/fit/sizes", test_sizes);
  g_test_add_func("/elastic/fit/fitted-section", test_fitted_section);
  g_test_add_func("/elastic/fit/stretch-warning", test_stretch_warning);
  g_test_add_func("/elastic/fit/interference-on-floor", test_interference_on_floor);
  g_test_add_func("/elastic/hertz", test_hertz);
  g_test_add_func("/elastic/lindley", test_lindley);
  g_test_add_func("/elastic/green-english", test_green_english);
  g_test_add_func("/elastic/fit/no-contact", test_no_contact);
  g_test_add_func("/elastic/fit/warnings", test_warnings);
  g_test_add_func("/elastic/fit/refusals", test_refusals);
  g_test_add_func("/elastic/fit/names", test_names);
  g_test_add_func("/elastic/deflections", test_deflections);
  return g_test_run();
}
