// Rubber in storage against closed limits, a finite-difference diffusion, an integrated recovery,
// table 2.2; the ring's load against storage time; every warning and refusal.
#include "engine/contact/fit.h"
#include "engine/rubber/rubber_time.h"
#include "tests/engine/near.h"

#include <glib.h>
#include <math.h>

static SbRubberStorage stored(double time, double temperature) {
  return (SbRubberStorage){.section_diameter = 1.61e-3,
                           .inner_diameter = 2.84e-3,
                           .radial_space = 1.36e-3,
                           .modulus = 2.5e6,
                           .storage_time = time,
                           .temperature = temperature,
                           .use_temperature = temperature};
}

static SbRubber prony(void) {
  return (SbRubber){
      .reference_temperature = 293.15, .terms = 3, .g = {0.1, 0.15, 0.2}, .tau = {1.0, 1e3, 1e6}};
}

static SbRubberState state(const SbRubber *rubber, const SbRubberStorage *storage) {
  SbRubberState out;
  SbReport report = {0};
  g_assert_cmpint(sb_rubber_state(&out, rubber, storage, NULL, &report), ==, SB_OK);
  g_assert_cmpstr(report.text, ==, "");
  return out;
}

// A rubber without constants does not change; Prony starts at 1, ends at 1 - sum g and falls
// between.
static void test_relaxation(void) {
  const SbRubber inert = {.reference_temperature = 293.15};
  SbRubberStorage in = stored(1e9, 310.0);
  SbRubberState s = state(&inert, &in);
  g_assert_cmpfloat(s.modulus, ==, 2.5e6);
  g_assert_cmpfloat(s.section_diameter, ==, 1.61e-3);
  g_assert_cmpfloat(s.section_after_set, ==, 1.61e-3);

  const SbRubber rubber = prony();
  in = stored(0.0, 293.15);
  g_assert_cmpfloat(state(&rubber, &in).relaxation, ==, 1.0);
  in = stored(1e9, 293.15);
  assert_close(state(&rubber, &in).relaxation, 0.55, 1e-12);
  double last = 1.0;
  for (double t = 1e-3; t < 1e8; t *= 3.0) {
    in = stored(t, 293.15);
    s = state(&rubber, &in);
    double expected = 1.0;
    for (size_t i = 0; i < 3; i++) {
      expected -= rubber.g[i] * (1.0 - exp(-t / rubber.tau[i]));
    }
    assert_close(s.relaxation, expected, 1e-12);
    assert_close(s.modulus, 2.5e6 * s.relaxation, 1e-12);
    g_assert_cmpfloat(s.relaxation, <, last);
    last = s.relaxation;
  }
}

// Shifts: time and temperature exchange; the values of the two laws by hand.
static void test_shift(void) {
  SbRubber rubber = prony();
  rubber.shift = SB_SHIFT_WLF;
  rubber.wlf_c1 = 17.44;
  rubber.wlf_c2 = 51.6;
  SbRubberStorage warm = stored(100.0, 293.15 + 51.6);
  const SbRubberState a = state(&rubber, &warm);
  assert_close(a.shift, pow(10.0, -8.72), 1e-12);
  SbRubberStorage long_time = stored(100.0 / a.shift, 293.15);
  assert_close(a.relaxation, state(&rubber, &long_time).relaxation, 1e-12);

  rubber.shift = SB_SHIFT_ARRHENIUS;
  rubber.relaxation_energy = 80e3;
  warm = stored(100.0, 313.15);
  // exp(80000/8.314462618 (1/313.15 - 1/293.15)) computed apart.
  assert_close(state(&rubber, &warm).shift, 0.1229237, 2e-3);
  // Rubber elasticity and thermal expansion.
  SbRubber entropic = {
      .reference_temperature = 293.15, .entropic = true, .thermal_expansion = 2e-4};
  const SbRubberState hot = state(&entropic, &warm);
  assert_close(hot.modulus, 2.5e6 * 313.15 / 293.15, 1e-12);
  assert_close(hot.inner_diameter, 2.84e-3 * 1.004, 1e-12);
  // Of the temperature of use, not that of storage or of the constants.
  warm.use_temperature = 293.15;
  entropic.reference_temperature = 250;
  g_assert_cmpfloat(state(&entropic, &warm).modulus, ==, 2.5e6);
  g_assert_cmpfloat(state(&entropic, &warm).inner_diameter, ==, 2.84e-3);
}

// A measured slope of the modulus, in place of which entropy elasticity is a choice; neither: it is
// constant. The run warns beyond the measured temperatures, but not at 20 degC, where nothing is
// extrapolated.
static void test_slope(void) {
  SbRubber rubber = {.reference_temperature = 293.15,
                     .modulus_slope = -1.6e-3,
                     .slope_from = 297.15,
                     .slope_to = 399.15};
  static const struct {
    double celsius, factor;
    bool warns;
  } rows[] = {{20, 1, false},
              {24, 0.9936, false},
              {126, 0.8304, false},
              {127, 0.8288, true},
              {19, 1.0016, true}};
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    SbRubberStorage in = stored(0.0, 293.15);
    SbWarnings warnings = {0};
    SbRubberState s;
    in.use_temperature = 273.15 + rows[i].celsius;
    g_assert_cmpint(sb_rubber_state(&s, &rubber, &in, &warnings, NULL), ==, SB_OK);
    assert_close(s.modulus, 2.5e6 * rows[i].factor, 1e-12);
    assert_close(sb_rubber_stiffening(&rubber, 2.5e6, in.use_temperature), rows[i].factor, 1e-12);
    g_assert_cmpint(warned(&warnings, "modulus-extrapolated"), ==, rows[i].warns);
    const SbRubber plain = {.reference_temperature = 293.15};
    g_assert_cmpfloat(state(&plain, &in).modulus, ==, 2.5e6);
    rubber.entropic = true;
    assert_close(state(&rubber, &in).modulus, 2.5e6 * in.use_temperature / 293.15, 1e-12);
    rubber.entropic = false;
  }
}

// Vendors' ring of 1.78 mm at 20 % squeeze (Parker's handbook; compound N0674-70): its force falls
// by 10 % from 23.9 to 125.6 °C. With the slope of assets/rubbers/nitrile.rubber the solved ring's
// falls by this within 2 %, as its expansion depends on the gland, which is not stated; entropy
// elasticity would raise it by a third or more.
static void test_parker(void) {
  double load[2][2];
  for (int hot = 0; hot < 2; hot++) {
    for (int entropic = 0; entropic < 2; entropic++) {
      const SbRubber rubber = {.reference_temperature = 293.15,
                               .modulus_slope = -1.6e-3,
                               .slope_to = 400,
                               .entropic = entropic == 1,
                               .thermal_expansion = 160e-6};
      SbRubberStorage in = stored(0.0, 293.15);
      in.section_diameter = 1.78e-3;
      in.inner_diameter = 8.95e-3;
      in.modulus = 5.5e6;
      in.use_temperature = 273.15 + (hot ? 125.6 : 23.9);
      const SbRubberState s = state(&rubber, &in);
      const double grown = 1 + 110e-6 * (in.use_temperature - 293.15); // a plastic gland
      SbFitProblem fit = {.model = SB_FIT_RING,
                          .section_diameter = s.section_diameter,
                          .inner_diameter = s.inner_diameter,
                          .modulus = s.modulus,
                          .poisson_ratio = 0.49,
                          .radial_space = 1.424e-3 * grown,
                          .bore_diameter = 12e-3 * grown,
                          .gland_width = 2.4e-3};
      SbFit out;
      g_assert_cmpint(sb_fit_solve(&out, &fit, NULL), ==, SB_OK);
      load[hot][entropic] = out.load;
    }
  }
  g_test_message("24 to 126 degC: %+.1f %%, with entropy elasticity %+.1f %%",
                 100 * (load[1][0] / load[0][0] - 1), 100 * (load[1][1] / load[0][1] - 1));
  g_assert_cmpfloat_with_epsilon(load[1][0] / load[0][0], 0.90, 0.02);
  g_assert_cmpfloat(load[1][1] / load[0][1], >, 1.33);
}

// The glass transition: nothing at 20 degC, stiffness over temperature as Gehman's test gives it
// (twice, 10 and 100 times the rubber's 2.5 MPa at some 20, 12 and 6 K above), refused below.
static void test_glass(void) {
  const SbRubber rubber = {.reference_temperature = 293.15, .glass_temperature = 245.0};
  SbRubberStorage in = stored(0.0, 293.15);
  g_assert_cmpfloat(state(&rubber, &in).modulus, ==, 2.5e6);
  static const double rows[][3] = {{2, 18, 22}, {10, 11, 14}, {100, 5, 8}}; // times, from, to [K]
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    in.use_temperature = 245.0 + rows[i][1];
    g_assert_cmpfloat(state(&rubber, &in).stiffening, >, rows[i][0]);
    in.use_temperature = 245.0 + rows[i][2];
    g_assert_cmpfloat(state(&rubber, &in).stiffening, <, rows[i][0]);
  }
  SbWarnings warnings = {0};
  SbRubberState s;
  SbReport report = {0};
  g_assert_cmpint(sb_rubber_state(&s, &rubber, &in, &warnings, NULL), ==, SB_OK);
  g_assert_true(warned(&warnings, "glass-near"));
  in.use_temperature = 244.9;
  g_assert_cmpint(sb_rubber_state(&s, &rubber, &in, NULL, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpstr(sb_input_key(report.input), ==, "canister.temperature");
}

// Set: what is left right after release is what has relaxed; it goes away with time; the equations
// integrated by the midpoint rule agree.
static void test_set(void) {
  const SbRubber rubber = prony();
  const double hold = 5e3;
  double instantaneous = 0.0;
  double e[3];
  for (int i = 0; i < 3; i++) {
    e[i] = 1.0 - exp(-hold / rubber.tau[i]);
    instantaneous += rubber.g[i] * e[i];
  }
  assert_close(sb_rubber_viscoelastic_set(rubber.g, rubber.tau, 3, hold, 0.0), instantaneous,
               1e-12);
  g_assert_cmpfloat(sb_rubber_viscoelastic_set(rubber.g, rubber.tau, 3, hold, 1e9), <, 1e-9);

  const int steps = 200000;
  const double span = 2000.0;
  const double h = span / steps;
  for (int k = 0; k < steps; k++) {
    double mid[3];
    double total = 0.0;
    for (int i = 0; i < 3; i++) {
      total += rubber.g[i] * e[i];
    }
    for (int i = 0; i < 3; i++) {
      mid[i] = e[i] + 0.5 * h * (total - e[i]) / rubber.tau[i];
    }
    total = rubber.g[0] * mid[0] + rubber.g[1] * mid[1] + rubber.g[2] * mid[2];
    for (int i = 0; i < 3; i++) {
      e[i] += h * (total - mid[i]) / rubber.tau[i];
    }
  }
  assert_close(sb_rubber_viscoelastic_set(rubber.g, rubber.tau, 3, hold, span),
               rubber.g[0] * e[0] + rubber.g[1] * e[1] + rubber.g[2] * e[2], 1e-6);

  // Network: with full reforming the lasting set is what broke; without it there is none.
  SbRubber network = {.reference_temperature = 293.15,
                      .network_rate = 1e-8,
                      .network_energy = 90e3,
                      .network_reform = 1.0};
  SbRubberStorage in = stored(5e7, 293.15);
  SbRubberState s = state(&network, &in);
  assert_close(s.network, exp(-0.5), 1e-12);
  assert_close(s.compression_set, 1.0 - exp(-0.5), 1e-12);
  assert_close(s.section_after_set, 1.61e-3 - s.compression_set * 0.25e-3, 1e-12);
  assert_close(s.modulus, 2.5e6 * exp(-0.5), 1e-12);
  network.network_reform = 0.0;
  g_assert_cmpfloat(state(&network, &in).compression_set, ==, 0.0);
  // Warmer is faster.
  in.temperature = 313.15;
  g_assert_cmpfloat(state(&network, &in).network, <, s.network);
}

// Fick's series and its early form against an implicit finite-volume solution with 400 rings,
// extrapolated from 200 (second order).
static double uptake_by_volumes(double end, int n) {
  double *c = g_new0(double, (gsize)n);
  double *upper = g_new0(double, (gsize)n);
  const int steps = 4000;
  const double dr = 1.0 / n;
  // Times grow quadratically, so that the start is resolved; the first steps are fully implicit (w
  // = 1), the others Crank and Nicolson's. Thomas' algorithm, c_i in and c_i out of (I - w dt A)
  // and the rest.
  for (int k = 0; k < steps; k++) {
    const double t0 = end * pow((double)k / steps, 2);
    const double dt = end * pow((k + 1.0) / steps, 2) - t0;
    const double w = k < 8 ? 1.0 : 0.5;
    double before = c[0];
    for (int i = 0; i < n; i++) {
      const double r = (i + 0.5) * dr;
      const double in = i > 0 ? i * dr / (r * dr * dr) : 0.0;
      const double out = (i < n - 1 ? (i + 1.0) * dr : 2.0) / (r * dr * dr);
      const double left = i > 0 ? before : 0.0;
      const double right = i < n - 1 ? c[i + 1] : 1.0;
      const double old = c[i];
      double rhs = old + (1 - w) * dt * (in * (left - old) + out * (right - old));
      rhs += i == n - 1 ? w * dt * out : 0.0;
      const double lower = -w * dt * in;
      const double pivot = 1.0 + w * dt * (in + out) - (i > 0 ? lower * upper[i - 1] : 0.0);
      upper[i] = i < n - 1 ? -w * dt * out / pivot : 0.0;
      before = old;
      c[i] = (rhs - (i > 0 ? lower * c[i - 1] : 0.0)) / pivot;
    }
    for (int i = n - 2; i >= 0; i--) {
      c[i] -= upper[i] * c[i + 1];
    }
  }
  double sum = 0.0;
  for (int i = 0; i < n; i++) {
    sum += c[i] * 2.0 * (i + 0.5) * dr * dr;
  }
  g_free(c);
  g_free(upper);
  return sum;
}

static void test_uptake(void) {
  g_assert_cmpfloat(sb_rubber_uptake(0.0), ==, 0.0);
  assert_close(sb_rubber_uptake(10.0), 1.0, 1e-12);
  for (double fourier = 0.01; fourier < 1.1; fourier *= 3.3) {
    const double coarse = uptake_by_volumes(fourier, 200);
    const double fine = uptake_by_volumes(fourier, 400);
    assert_close(sb_rubber_uptake(fourier), fine + (fine - coarse) / 3.0, 2e-5);
  }
  // The two forms meet.
  g_assert_cmpfloat(fabs(sb_rubber_uptake(1e-3 * (1 - 1e-9)) - sb_rubber_uptake(1e-3)), <, 2e-7);
  // Early: 4 sqrt(Dt/(pi R^2)).
  assert_close(sb_rubber_uptake(1e-8), 4.0 * sqrt(1e-8 / M_PI), 1e-4);
  double last = 0.0;
  for (double fourier = 1e-6; fourier < 3.0; fourier *= 1.3) {
    g_assert_cmpfloat(sb_rubber_uptake(fourier), >, last);
    last = sb_rubber_uptake(fourier);
  }
}

// Table 2.2 and docs/thesis.md, 15: nitrile's 17 % by mass are 15 % by volume and 4.8 % in length.
static void test_swell(void) {
  SbRubber rubber = {.reference_temperature = 293.15,
                     .swell_mass = 1.17 - 1.0,
                     .rubber_density = 1090.0,
                     .fluid_density = 1226.0,
                     .diffusion = 1e-11,
                     .diffusion_energy = 30e3};
  SbRubberStorage in = stored(30 * 86400.0, 293.15);
  SbRubberState s = state(&rubber, &in);
  assert_close(s.uptake, 1.0, 1e-6);
  assert_close(s.volume_swell, 0.151, 2e-3);
  assert_close(s.linear_swell, 0.048, 5e-3);
  assert_close(s.section_diameter, 1.61e-3 * cbrt(1.0 + s.volume_swell), 1e-12);
  assert_close(s.modulus, 2.5e6 / cbrt(1.0 + s.volume_swell), 1e-12);
  // A given modulus at equilibrium; half way up it is between.
  rubber.swell_modulus = 0.4;
  assert_close(state(&rubber, &in).modulus, 1.0e6, 1e-6);
  in.storage_time = 0.1 * 0.805e-3 * 0.805e-3 / 1e-11;
  s = state(&rubber, &in);
  assert_close(s.uptake, sb_rubber_uptake(0.1), 1e-12);
  assert_close(s.swell_modulus, pow(0.4, s.uptake), 1e-12);
  // A rubber that takes up nothing stays as stiff.
  SbRubber dry = rubber;
  dry.swell_mass = 0.0;
  assert_close(state(&dry, &in).swell_modulus, 1.0, 1e-15);
  // A gel is no seal.
  SbReport report;
  rubber.swell_modulus = 0.02;
  g_assert_cmpint(sb_rubber_state(&s, &rubber, &in, NULL, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpint(report.input, ==, SB_RUBBER_IN_SWELL_MODULUS);
}

// Load of the fitted ring against storage time: relaxation alone lowers it in proportion to the
// modulus, swell alone of a stiff network raises it.
static void test_load_over_time(void) {
  const SbRubber relaxing = prony();
  const SbRubber swelling = {.reference_temperature = 293.15,
                             .swell_mass = 0.17,
                             .rubber_density = 1090.0,
                             .fluid_density = 1226.0,
                             .diffusion = 5e-12};
  double last_relaxed = INFINITY;
  double last_swollen = 0.0;
  double first = 0.0;
  for (double t = 1.0; t < 1e6; t *= 10.0) {
    const SbRubberStorage in = stored(t, 293.15);
    double load[2];
    for (int k = 0; k < 2; k++) {
      const SbRubberState s = state(k == 0 ? &relaxing : &swelling, &in);
      const SbFitProblem problem = {.model = SB_FIT_DISC,
                                    .section_diameter = s.section_diameter,
                                    .inner_diameter = s.inner_diameter,
                                    .modulus = s.modulus,
                                    .poisson_ratio = 0.49,
                                    .radial_space = 1.36e-3,
                                    .bore_diameter = 6e-3,
                                    .gland_width = 2e-3};
      SbFit fit;
      g_assert_cmpint(sb_fit_solve(&fit, &problem, NULL), ==, SB_OK);
      load[k] = fit.load;
      if (k == 0) {
        first = first > 0.0 ? first : fit.load / s.relaxation;
        assert_close(fit.load, first * s.relaxation, 1e-6);
      }
    }
    g_assert_cmpfloat(load[0], <, last_relaxed);
    g_assert_cmpfloat(load[1], >, last_swollen);
    last_relaxed = load[0];
    last_swollen = load[1];
  }
}

static void test_warnings(void) {
  SbRubber shift = prony();
  shift.shift = SB_SHIFT_ARRHENIUS;
  shift.relaxation_energy = 50e3;
  SbRubber swell = {.reference_temperature = 293.15,
                    .swell_mass = 0.6,
                    .rubber_density = 1100.0,
                    .fluid_density = 1226.0,
                    .diffusion = 1e-9};
  const SbRubber plain = prony();
  const struct {
    const SbRubber *rubber;
    double time, temperature;
    const char *code;
  } row[] = {
      {&plain, 0.9e7, 293.15, NULL}, {&plain, 1.1e7, 293.15, "relaxation-extrapolated"},
      {&shift, 1.0, 392.0, NULL},    {&shift, 1.0, 394.0, "shift-range"},
      {&swell, 50.0, 293.15, NULL},  {&swell, 1e4, 293.15, "swell-large"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(row); i++) {
    SbWarnings warnings = {0};
    SbRubberState s;
    const SbRubberStorage in = stored(row[i].time, row[i].temperature);
    g_assert_cmpint(sb_rubber_state(&s, row[i].rubber, &in, &warnings, NULL), ==, SB_OK);
    g_assert_cmpuint(warnings.count, ==, row[i].code == NULL ? 0 : 1);
    if (row[i].code != NULL) {
      g_assert_true(warned(&warnings, row[i].code));
    }
  }
}

static void test_refusals(void) {
  SbRubberState s;
  SbReport report = {0};
  SbRubberStorage in = stored(1.0, 293.15);
  SbRubber r = prony();
  r.g[2] = 0.8;
  g_assert_cmpint(sb_rubber_state(&s, &r, &in, NULL, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpstr(sb_input_key(report.input), ==, "rubber.relaxation_share_1");
  r = prony();
  r.tau[0] = 0.0;
  g_assert_cmpint(sb_rubber_state(&s, &r, &in, NULL, &report), ==, SB_ERROR_RANGE);
  r = prony();
  r.shift = SB_SHIFT_WLF;
  r.wlf_c1 = 17.44;
  r.wlf_c2 = 51.6;
  in.temperature = 293.15 - 51.6;
  g_assert_cmpint(sb_rubber_state(&s, &r, &in, NULL, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpstr(sb_input_key(report.input), ==, "storage.temperature");
  in = stored(-1.0, 293.15);
  g_assert_cmpint(sb_rubber_state(&s, &r, &in, NULL, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpstr(sb_input_key(report.input), ==, "storage.time");
  in = stored(NAN, 293.15);
  g_assert_cmpint(sb_rubber_state(&s, &r, &in, NULL, &report), ==, SB_ERROR_RANGE);
  in = stored(1.0, 293.15);
  r = (SbRubber){.reference_temperature = 293.15, .swell_mass = 0.1};
  g_assert_cmpint(sb_rubber_state(&s, &r, &in, NULL, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpstr(sb_input_key(report.input), ==, "rubber.swell_mass");
  r = (SbRubber){.reference_temperature = 293.15, .network_reform = 1.5};
  g_assert_cmpint(sb_rubber_state(&s, &r, &in, NULL, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpstr(sb_input_key(report.input), ==, "rubber.network_rate");
  in.section_diameter = 0.0;
  g_assert_cmpint(sb_rubber_state(&s, &r, &in, NULL, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpstr(sb_input_key(report.input), ==, "seal.section_diameter");
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/rubber-time/relaxation", test_relaxation);
  g_test_add_func("/rubber-time/shift", test_shift);
  g_test_add_func("/rubber-time/slope", test_slope);
  g_test_add_func("/rubber-time/parker", test_parker);
  g_test_add_func("/rubber-time/glass", test_glass);
  g_test_add_func("/rubber-time/set", test_set);
  g_test_add_func("/rubber-time/uptake", test_uptake);
  g_test_add_func("/rubber-time/swell", test_swell);
  g_test_add_func("/rubber-time/load", test_load_over_time);
  g_test_add_func("/rubber-time/warnings", test_warnings);
  g_test_add_func("/rubber-time/refusals", test_refusals);
  return g_test_run();
}
