// Gland read-outs with tolerances and customary bands; see the header.
#include "engine/contact/gland.h"

#include <math.h>

enum { SIZES = 6, CORNERS = 1 << SIZES };

// d, ID, g, b, D, land.
typedef struct {
  double v[SIZES];
} Sizes;

static void evaluate(double *q, const Sizes *s, const SbGland *gland) {
  const double d = s->v[0];
  const double id = s->v[1];
  const double g = s->v[2];
  const double b = s->v[3];
  const double bore = s->v[4];
  const double land = s->v[5];
  const double mean = (bore - g) / (id + d) - 1.0;
  q[SB_GLAND_STRETCH_INNER] = (bore - 2.0 * g) / id - 1.0;
  q[SB_GLAND_STRETCH_MEAN] = mean;
  q[SB_GLAND_SQUEEZE] = (d - g) / d;
  q[SB_GLAND_SECTION_FITTED] = d * (1.0 - gland->poisson_ratio * mean);
  q[SB_GLAND_INTERFERENCE] = q[SB_GLAND_SECTION_FITTED] - g;
  q[SB_GLAND_SQUEEZE_FITTED] = q[SB_GLAND_INTERFERENCE] / q[SB_GLAND_SECTION_FITTED];
  q[SB_GLAND_FILL] = 0.25 * M_PI * d * d * (id + d) / (g * (bore - g) * b);
  q[SB_GLAND_FILL_SWOLLEN] = q[SB_GLAND_FILL] * (1.0 + gland->volume_swell);
  const double growth = cbrt(1.0 + gland->volume_swell);
  const double mean_swollen = (bore - g) / (growth * (id + d)) - 1.0;
  q[SB_GLAND_SECTION_SWOLLEN] = growth * d * (1.0 - gland->poisson_ratio * mean_swollen);
  q[SB_GLAND_SQUEEZE_SWOLLEN] = 1.0 - g / (growth * d);
  q[SB_GLAND_SWELL] = gland->volume_swell;
  q[SB_GLAND_EXTRUSION_GAP] = bore - land;
}

const char *sb_band_text(SbBand band) {
  switch (band) {
  case SB_BAND_BELOW:
    return "below";
  case SB_BAND_WITHIN:
    return "within";
  case SB_BAND_ABOVE:
    return "above";
  default:
    return "";
  }
}

SbBand sb_band_of(double value, double low, double high) {
  const double slack = 1e-9;
  return value < low - slack * fabs(low)     ? SB_BAND_BELOW
         : value > high + slack * fabs(high) ? SB_BAND_ABOVE
                                             : SB_BAND_WITHIN;
}

SbStatus sb_gland_readouts(SbGlandReadout *out, const SbGland *gland, SbReport *report) {
  static const struct {
    const char *name, *unit, *source;
    double low, high;
  } list[SB_GLAND_COUNT] = {
#define ENTRY(code, text, unit, low, high, source) [code] = {text, unit, source, low, high},
      SB_GLAND_LIST(ENTRY)
#undef ENTRY
  };
  static const char *const keys[SIZES] = {"seal.section_diameter", "seal.inner_diameter",
                                          "gland.radial_space",    "gland.axial_width",
                                          "bore.diameter",         "stem.land_diameter"};
  const Sizes nominal = {{gland->section_diameter, gland->inner_diameter, gland->radial_space,
                          gland->axial_width, gland->bore_diameter, gland->land_diameter}};
  const Sizes tolerance = {{gland->section_diameter_tolerance, gland->inner_diameter_tolerance,
                            gland->radial_space_tolerance, gland->axial_width_tolerance,
                            gland->bore_diameter_tolerance, gland->land_diameter_tolerance}};
  for (int i = 0; i < SIZES; i++) {
    if (!(nominal.v[i] > 0.0 && isfinite(nominal.v[i]) && tolerance.v[i] >= 0.0 &&
          tolerance.v[i] < nominal.v[i])) {
      return sb_fail_parameter(report, SB_ERROR_RANGE, keys[i],
                               "size %g m with a tolerance of %g m makes no sense", nominal.v[i],
                               tolerance.v[i]);
    }
  }
  if (!(gland->poisson_ratio >= 0.0 && gland->poisson_ratio <= 0.5 && gland->volume_swell >= 0.0 &&
        isfinite(gland->volume_swell))) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "seal.poisson_ratio",
                             "Poisson's ratio %g or swell %g makes no sense", gland->poisson_ratio,
                             gland->volume_swell);
  }
  if (!(nominal.v[4] - tolerance.v[4] > 2.0 * (nominal.v[2] + tolerance.v[2]))) {
    return sb_fail_parameter(report, SB_ERROR_INFEASIBLE, "bore.diameter",
                             "with its tolerances the bore leaves no stem inside the radial space");
  }

  // Nominal, and each corner of the tolerances: the read-outs are monotonic in every size.
  double value[SB_GLAND_COUNT];
  evaluate(value, &nominal, gland);
  for (int k = 0; k < SB_GLAND_COUNT; k++) {
    out[k] = (SbGlandReadout){
        .name = list[k].name,
        .unit = list[k].unit,
        .source = list[k].source,
        .nominal = value[k],
        .worst_low = value[k],
        .worst_high = value[k],
        .band_low = list[k].low < 0.0 ? -INFINITY : list[k].low,
        .band_high = list[k].high > 1e3 ? INFINITY : list[k].high,
    };
  }
  for (int corner = 0; corner < CORNERS; corner++) {
    Sizes at = nominal;
    for (int i = 0; i < SIZES; i++) {
      at.v[i] += (corner >> i & 1) ? tolerance.v[i] : -tolerance.v[i];
    }
    evaluate(value, &at, gland);
    for (int k = 0; k < SB_GLAND_COUNT; k++) {
      out[k].worst_low = fmin(out[k].worst_low, value[k]);
      out[k].worst_high = fmax(out[k].worst_high, value[k]);
    }
  }

  // Root sum of squares of each tolerance alone.
  double square[SB_GLAND_COUNT] = {0.0};
  for (int i = 0; i < SIZES; i++) {
    Sizes up = nominal;
    Sizes down = nominal;
    up.v[i] += tolerance.v[i];
    down.v[i] -= tolerance.v[i];
    double high[SB_GLAND_COUNT];
    double low[SB_GLAND_COUNT];
    evaluate(high, &up, gland);
    evaluate(low, &down, gland);
    for (int k = 0; k < SB_GLAND_COUNT; k++) {
      square[k] += 0.25 * (high[k] - low[k]) * (high[k] - low[k]);
    }
  }
  for (int k = 0; k < SB_GLAND_COUNT; k++) {
    SbGlandReadout *r = &out[k];
    r->rss_low = r->nominal - sqrt(square[k]);
    r->rss_high = r->nominal + sqrt(square[k]);
    if (r->source[0] == '\0') {
      continue;
    }
    r->band = sb_band_of(r->nominal, r->band_low, r->band_high);
    const SbBand low = sb_band_of(r->worst_low, r->band_low, r->band_high);
    const SbBand high = sb_band_of(r->worst_high, r->band_low, r->band_high);
    r->band_worst = low == SB_BAND_BELOW ? SB_BAND_BELOW : high;
  }
  return sb_succeed(report);
}
