// Rubber in storage: Prony relaxation and recovery, shift, network scission, Fickian swell; see the
// header.
#include "engine/rubber/rubber_time.h"

#include "engine/base/check.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_sf_bessel.h>
#include <math.h>

static const double gas_constant = 8.31446261815324; // [J/(mol K)]

// ---- uptake

double sb_rubber_uptake(double fourier) {
  if (!(fourier > 0.0)) {
    return 0.0;
  }
  // Early: the boundary layer of a plane with the curvature's first corrections (Crank 5.25).
  if (fourier < 1e-3) {
    const double root = sqrt(fourier / M_PI);
    return 4.0 * root - fourier - fourier * root / 3.0;
  }
  double sum = 0.0;
  for (unsigned n = 1; n <= 80; n++) {
    const double zero = gsl_sf_bessel_zero_J0(n);
    const double decay = zero * zero * fourier;
    if (decay > 45.0) {
      break;
    }
    sum += 4.0 / (zero * zero) * exp(-decay);
  }
  return 1.0 - sum;
}

// ---- recovery

double sb_rubber_viscoelastic_set(const double *g, const double *tau, size_t terms, double hold,
                                  double recovery) {
  // Free of stress the strain is e = sum g_j e_j and e_i' = (e - e_i)/tau_i. With y_i = sqrt(g_i
  // tau_i) e_i the matrix v v^T - diag(1/tau), v_i = sqrt(g_i/tau_i), is symmetric and negative.
  enum { N = SB_RUBBER_TERMS };
  double a[N * N], vector[N * N], value[N], v[N], start[N], strain = 0.0;
  size_t n = 0;
  for (size_t i = 0; i < terms; i++) {
    if (g[i] > 0.0) {
      v[n] = sqrt(g[i] / tau[i]);
      value[n] = -1.0 / tau[i];
      start[n++] = -sqrt(g[i] * tau[i]) * expm1(-hold / tau[i]);
    }
  }
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < n; j++) {
      a[i * n + j] = v[i] * v[j] + (i == j ? value[i] : 0.0);
    }
  }
  gsl_matrix_view matrix = gsl_matrix_view_array(a, n, n);
  gsl_matrix_view vectors = gsl_matrix_view_array(vector, n, n);
  gsl_vector_view values = gsl_vector_view_array(value, n);
  unsigned rotations;
  // Jacobi's rotations keep the digits of small values; the off-diagonal remainder after 60 sweeps
  // is below rounding.
  (void)gsl_eigen_jacobi(&matrix.matrix, &values.vector, &vectors.matrix, 60, &rotations);
  // e(recovery) = sum g_j e_j = sum_j sqrt(g_j/tau_j) y_j.
  for (size_t k = 0; k < n; k++) {
    double from = 0.0, to = 0.0;
    for (size_t i = 0; i < n; i++) {
      from += vector[i * n + k] * start[i];
      to += vector[i * n + k] * v[i];
    }
    strain += to * exp(value[k] * recovery) * from;
  }
  return fmax(0.0, strain);
}

// ---- state

// Smallest modulus of a swollen rubber over its dry one: a softer one is a gel, not a seal. Nitrile
// with 20 % of swell has 0.4 (thesis 2.2.6).
static const double SWOLLEN_MIN = 0.05;

static SbStatus check_swollen(const SbRubber *r, SbReport *report) {
  if (r->swell_mass > 0.0 && r->swell_modulus > 0.0 && r->swell_modulus < SWOLLEN_MIN) {
    return sb_fail_input(
        report, SB_ERROR_RANGE, SB_RUBBER_IN_SWELL_MODULUS,
        "a swollen modulus of %g times the dry one: at least %g, or 0 for an ideal "
        "network",
        r->swell_modulus, SWOLLEN_MIN);
  }
  return SB_OK;
}

static SbStatus check(const SbRubber *r, const SbRubberStorage *in, SbReport *report) {
  // Densities matter for a rubber that swells only.
  const double least = r->swell_mass > 0.0 ? DBL_MIN : 0.0;
  SbStatus status = SB_CHECK(
      report, {SB_RUBBER_IN_RING, "the section diameter [m]", in->section_diameter, SB_ABOVE_ZERO},
      {SB_RUBBER_IN_RING, "the inner diameter [m]", in->inner_diameter, SB_ABOVE_ZERO},
      {SB_RUBBER_IN_RING, "the radial space [m]", in->radial_space, SB_ABOVE_ZERO},
      {SB_RUBBER_IN_RING, "the modulus [Pa]", in->modulus, SB_ABOVE_ZERO},
      {SB_RUBBER_IN_STORAGE_TIME, "the storage time [s]", in->storage_time, SB_NOT_NEGATIVE},
      {SB_RUBBER_IN_STORAGE_TIME, "the recovery time [s]", in->recovery_time, 0.0, INFINITY},
      {SB_RUBBER_IN_TEMPERATURE, "the temperature [K]", in->temperature, SB_ABOVE_ZERO},
      {SB_RUBBER_IN_TEMPERATURE, "the reference [K]", r->reference_temperature, SB_ABOVE_ZERO},
      {SB_RUBBER_IN_USE_TEMPERATURE, "the temperature of use [K]", in->use_temperature,
       SB_ABOVE_ZERO},
      {SB_RUBBER_IN_GLASS_TEMPERATURE, "the glass temperature [K]", r->glass_temperature, 0.0,
       SB_SIZES_TEMPERATURE},
      {SB_RUBBER_IN_MODULUS_SLOPE, "the slope of the modulus [1/K]", r->modulus_slope, -5e-3, 5e-3},
      {SB_RUBBER_IN_NETWORK, "the network's rate [1/s]", r->network_rate, 0.0, INFINITY},
      {SB_RUBBER_IN_NETWORK, "the reformed fraction", r->network_reform, 0.0, 1.0},
      {SB_RUBBER_IN_SWELL, "swell by mass", r->swell_mass, SB_NOT_NEGATIVE},
      {SB_RUBBER_IN_SWELL, "diffusion [m2/s]", r->diffusion, SB_NOT_NEGATIVE},
      {SB_RUBBER_IN_SWELL_MODULUS, "the swollen modulus over the dry", r->swell_modulus,
       SB_NOT_NEGATIVE},
      {SB_RUBBER_IN_SWELL, "the rubber's density [kg/m3]", r->rubber_density, least, INFINITY},
      {SB_RUBBER_IN_SWELL, "the fluid's density [kg/m3]", r->fluid_density, least, INFINITY});
  double sum = 0.0;
  for (size_t i = 0; i < r->terms && i < SB_RUBBER_TERMS && status == SB_OK; i++) {
    status = SB_CHECK(report,
                      {SB_RUBBER_IN_RELAXATION, "a Prony term's fraction", r->g[i], 0.0, INFINITY},
                      {SB_RUBBER_IN_RELAXATION, "its time [s]", r->tau[i], SB_ABOVE_ZERO});
    sum += r->g[i];
  }
  if (status != SB_OK) {
    return status;
  }
  if (r->terms > SB_RUBBER_TERMS || !(sum < 1.0)) {
    return sb_fail_input(report, SB_ERROR_RANGE, SB_RUBBER_IN_RELAXATION,
                         "%zu Prony terms with fractions that sum to %g (at most %d, below 1)",
                         r->terms, sum, SB_RUBBER_TERMS);
  }
  if (in->use_temperature < r->glass_temperature) {
    return sb_fail_input(report, SB_ERROR_RANGE, SB_RUBBER_IN_USE_TEMPERATURE,
                         "%.4g °C is below the rubber's glass transition at %.4g °C: there it "
                         "is glass, for which there is no model",
                         in->use_temperature - 273.15, r->glass_temperature - 273.15);
  }
  if (r->shift == SB_SHIFT_WLF &&
      !(r->wlf_c2 > 0.0 && in->temperature > r->reference_temperature - r->wlf_c2)) {
    return sb_fail_input(report, SB_ERROR_RANGE, SB_RUBBER_IN_TEMPERATURE,
                         "%.4g K is at or below the pole of the WLF shift at %.4g K",
                         in->temperature, r->reference_temperature - r->wlf_c2);
  }
  return check_swollen(r, report);
}

// Share of the network below which the rubber is a liquid, not a seal.
static const double NETWORK_MIN = 1e-6;

// What the glass transition adds to the modulus [Pa].
static double glassy(const SbRubber *r, double temperature) {
  static const double GLASS = 1e9, HELD = 10.0, AT_GLASS = 100.0, SHAPE = 0.7; // [Pa], [s], [s]
  const double above = temperature - r->glass_temperature;
  return r->glass_temperature > 0.0
             ? GLASS /
                   (1.0 + pow(HELD / AT_GLASS * pow(10.0, 17.44 * above / (51.6 + above)), SHAPE))
             : 0.0;
}

// The rubber's own modulus at a temperature of use over that at 20 degC, without the glass
// transition.
static double rubbery(const SbRubber *r, double temperature) {
  return r->entropic ? temperature / SB_SIZES_TEMPERATURE
                     : 1.0 + r->modulus_slope * (temperature - SB_SIZES_TEMPERATURE);
}

double sb_rubber_stiffening(const SbRubber *r, double modulus, double temperature) {
  if (!(r->glass_temperature > 0.0)) {
    return rubbery(r, temperature);
  }
  return (modulus * rubbery(r, temperature) + glassy(r, temperature)) /
         (modulus + glassy(r, SB_SIZES_TEMPERATURE));
}

static double arrhenius(double energy, double temperature, double reference) {
  return exp(-energy / gas_constant * (1.0 / temperature - 1.0 / reference));
}

// Sets the shift of the relaxation times by the temperature of storage.
static void shift_times(SbRubberState *out, const SbRubber *r, double temperature,
                        SbWarnings *warnings) {
  const double reference = r->reference_temperature, away = temperature - reference;
  out->shift = 1.0;
  if (r->shift == SB_SHIFT_WLF) {
    out->shift = pow(10.0, -r->wlf_c1 * away / (r->wlf_c2 + away));
  } else if (r->shift == SB_SHIFT_ARRHENIUS) {
    out->shift = 1.0 / arrhenius(r->relaxation_energy, temperature, reference);
  }
  if (r->shift != SB_SHIFT_NONE && fabs(away) > 100.0) {
    sb_warn(warnings, "shift-range", SB_RUBBER_IN_TEMPERATURE,
            "%.0f K from the reference: the temperature shift is valid to about 100 K", away);
  }
}

// Sets relaxation, network and compression set, from the shift: relaxation, and the remaining
// stress of the elements after release.
static void age(SbRubberState *out, const SbRubber *r, const SbRubberStorage *storage,
                SbWarnings *warnings) {
  const double t = storage->storage_time;
  double tau[SB_RUBBER_TERMS];
  double longest = 0.0;
  out->relaxation = 1.0;
  for (size_t i = 0; i < r->terms; i++) {
    tau[i] = r->tau[i] * out->shift;
    out->relaxation += r->g[i] * expm1(-t / tau[i]);
    longest = r->g[i] > 0.0 ? fmax(longest, tau[i]) : longest;
  }
  if (longest > 0.0 && t > 10.0 * longest) {
    sb_warn(warnings, "relaxation-extrapolated", SB_RUBBER_IN_STORAGE_TIME,
            "storage is %.2g times the longest relaxation time: slower relaxation is unknown",
            t / longest);
  }
  out->network =
      exp(-r->network_rate *
          arrhenius(r->network_energy, storage->temperature, r->reference_temperature) * t);
  const double reformed = r->network_reform * (1.0 - out->network);
  const double lasting = reformed > 0.0 ? reformed / (out->network + reformed) : 0.0;
  const double slow = sb_rubber_viscoelastic_set(r->g, tau, r->terms, t, storage->recovery_time);
  out->compression_set = lasting + (1.0 - lasting) * slow;
}

// Sets uptake and swell, and the effect of swell on the modulus.
static void swell(SbRubberState *out, const SbRubber *r, const SbRubberStorage *storage,
                  SbWarnings *warnings) {
  const double radius = 0.5 * storage->section_diameter;
  const double diffusion =
      r->diffusion * arrhenius(r->diffusion_energy, storage->temperature, r->reference_temperature);
  out->uptake = sb_rubber_uptake(diffusion * storage->storage_time / (radius * radius));
  const double full =
      r->swell_mass > 0.0 ? r->swell_mass * r->rubber_density / r->fluid_density : 0.0;
  out->volume_swell = out->uptake * full;
  out->linear_swell = cbrt(1.0 + out->volume_swell) - 1.0;
  out->swell_modulus = r->swell_mass > 0.0 && r->swell_modulus > 0.0
                           ? pow(r->swell_modulus, out->uptake)
                           : 1.0 / cbrt(1.0 + out->volume_swell);
  if (out->volume_swell > 0.5) {
    sb_warn(warnings, "swell-large", SB_RUBBER_IN_SWELL,
            "swell of %.0f %% by volume: diffusion and elasticity are no longer linear",
            100.0 * out->volume_swell);
  }
}

// Sets the effect of the temperature of use on the modulus.
static void stiffen(SbRubberState *out, const SbRubber *r, const SbRubberStorage *storage,
                    SbWarnings *warnings) {
  const double use = storage->use_temperature;
  out->stiffening = sb_rubber_stiffening(r, storage->modulus, use);
  if (!r->entropic && r->modulus_slope != 0.0 &&
      (use < fmin(r->slope_from, SB_SIZES_TEMPERATURE) ||
       use > fmax(r->slope_to, SB_SIZES_TEMPERATURE))) {
    sb_warn(warnings, "modulus-extrapolated", SB_RUBBER_IN_MODULUS_SLOPE,
            "%.4g °C is outside %.4g to %.4g °C, where the slope of the modulus was measured",
            use - 273.15, r->slope_from - 273.15, r->slope_to - 273.15);
  }
  if (glassy(r, use) > storage->modulus * rubbery(r, use)) {
    sb_warn(warnings, "glass-near", SB_RUBBER_IN_USE_TEMPERATURE,
            "%.3g K above its glass transition the rubber is %.2g times as stiff as at 20 °C: "
            "stiffness depends on time there, and one modulus replaces all of it",
            use - r->glass_temperature, out->stiffening);
  }
}

SbStatus sb_rubber_state(SbRubberState *out, const SbRubber *rubber, const SbRubberStorage *storage,
                         SbWarnings *warnings, SbReport *report) {
  *out = (SbRubberState){0};
  const SbRubber *r = rubber;
  SbStatus status = check(r, storage, report);
  if (status != SB_OK) {
    return status;
  }
  shift_times(out, r, storage->temperature, warnings);
  age(out, r, storage, warnings);
  swell(out, r, storage, warnings);
  stiffen(out, r, storage, warnings);

  // The ring as it is now.
  const double warmer = storage->use_temperature - SB_SIZES_TEMPERATURE;
  const double growth = (1.0 + out->linear_swell) * (1.0 + r->thermal_expansion * warmer);
  out->section_diameter = storage->section_diameter * growth;
  out->inner_diameter = storage->inner_diameter * growth;
  if (out->network < NETWORK_MIN) {
    return sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_RUBBER_IN_NETWORK,
                         "no network is left to carry a load after %.3g s of storage: bonds "
                         "break at %.3g 1/s",
                         storage->storage_time, r->network_rate);
  }
  out->modulus =
      storage->modulus * out->stiffening * out->swell_modulus * out->relaxation * out->network;
  out->section_after_set =
      out->section_diameter -
      out->compression_set * fmax(0.0, out->section_diameter - storage->radial_space);
  return sb_succeed(report);
}
