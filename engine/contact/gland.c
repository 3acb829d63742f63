// Gland read-outs with tolerances and customary bands; see the header.
#include "engine/contact/gland.h"

#include "engine/base/label.h"

#include <math.h>

// The toleranced sizes: number of the input, value and half-width of the tolerance band.
static const struct {
  int input;
  size_t value, tolerance;
} SIZE[] = {
#define SIZE_OF(input, field)                                                                      \
  { input, offsetof(SbGland, field), offsetof(SbGland, field##_tolerance) }
    SIZE_OF(SB_CONTACT_IN_SECTION_DIAMETER, section_diameter),
    SIZE_OF(SB_CONTACT_IN_INNER_DIAMETER, inner_diameter),
    SIZE_OF(SB_CONTACT_IN_RADIAL_SPACE, radial_space),
    SIZE_OF(SB_CONTACT_IN_GLAND_WIDTH, axial_width),
    SIZE_OF(SB_CONTACT_IN_BORE_DIAMETER, bore_diameter),
    SIZE_OF(SB_CONTACT_IN_LAND_DIAMETER, land_diameter),
#undef SIZE_OF
};
enum { SIZES = sizeof SIZE / sizeof SIZE[0], CORNERS = 1 << SIZES };

// Rows of Parker's O-Ring Handbook ORD 5700: design chart 4-2 (static, male and female glands) and
// 5-2 (reciprocating). Both tables are in inches; bands in mm are rounded to 0.01 mm. The squeezes
// of both charts and the clearances of chart 4-2 were compared with a public copy of the charts,
// engineersedge.com/general_engineering: oring_gland_size_static_cylinders.htm and
// oring_gland_size_dynamic_cylinder.htm. That copy of chart 5-2 has no column of clearance: the
// reciprocating clearances below are those of chart 4-2 and were not compared with the handbook.
#define BANDS(chart, kind, mm, low, high, gap_low, gap_high)                                       \
  {                                                                                                \
    0.01 * (low), 0.01 * (high), 1e-3 * (gap_low), 1e-3 * (gap_high),                              \
        "Parker ORD 5700, chart " chart ", " kind ", " #mm " mm section: " #low " to " #high " %", \
        "Parker ORD 5700, chart " chart ", " kind ", " #mm                                         \
        " mm section: diametral clearance " #gap_low " to " #gap_high " mm"                        \
  }
#define ROW(mm, moving_low, moving_high, static_low, static_high, gap_low, gap_high)               \
  {                                                                                                \
    1e-3 * (mm), {                                                                                 \
      [SB_GLAND_RECIPROCATING] =                                                                   \
          BANDS("5-2", "reciprocating", mm, moving_low, moving_high, gap_low, gap_high),           \
      [SB_GLAND_STATIC] = BANDS("4-2", "static", mm, static_low, static_high, gap_low, gap_high)   \
    }                                                                                              \
  }

// Customary bands of a standard section in one use: squeeze [1] and diametral clearance [m], with
// their references (static strings).
typedef struct {
  double squeeze_low, squeeze_high, gap_low, gap_high;
  const char *squeeze_source, *gap_source;
} SbGlandBands;

// A row of the standard gland tables.
typedef struct {
  double section; // nominal section diameter [m]
  SbGlandBands use[SB_GLAND_USE_COUNT];
} SbGlandRow;

// Returns the row for a section diameter [m], static; NULL if no section of the tables is within
// 12.5 %.
static const SbGlandRow *gland_row(double section_diameter) {
  static const double NEAR = 0.125; // of the row's section
  static const SbGlandRow rows[] = {
      ROW(1.78, 15, 25, 22, 32, 0.05, 0.13), ROW(2.62, 10, 17, 17, 24, 0.05, 0.13),
      ROW(3.53, 9, 16, 16, 23, 0.08, 0.15),  ROW(5.33, 8, 14, 15, 21, 0.08, 0.15),
      ROW(6.99, 11, 16, 15, 20, 0.10, 0.18),
  };
  for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
    if (fabs(section_diameter - rows[i].section) <= NEAR * rows[i].section) {
      return &rows[i];
    }
  }
  return NULL;
}

static void set_band(SbGlandReadout *out, double low, double high, const char *source) {
  out->band_low = low;
  out->band_high = high;
  out->source = source;
}

// Fills the bands that depend on the section, or states why there are none.
static void take_row(SbGlandReadout out[SB_GLAND_COUNT], const SbGland *gland) {
  const bool round = gland->profile.kind == SB_SEAL_PROFILE_CIRCLE;
  const SbGlandRow *row = round ? gland_row(gland->section_diameter) : NULL;
  if (row == NULL) {
    out[SB_GLAND_SQUEEZE].why = out[SB_GLAND_EXTRUSION_GAP].why =
        round ? "the gland tables of Parker ORD 5700 have no section within an eighth of this one"
              : "the gland tables of Parker ORD 5700 are those of round sections";
    return;
  }
  const SbGlandBands *of = &row->use[gland->use];
  set_band(&out[SB_GLAND_SQUEEZE], of->squeeze_low, of->squeeze_high, of->squeeze_source);
  set_band(&out[SB_GLAND_EXTRUSION_GAP], of->gap_low, of->gap_high, of->gap_source);
}

double sb_groove_area(double radial_space, double axial_width, double draft, double corner_radius,
                      const SbGrooveDrawing *groove) {
  if (groove != NULL) {
    return sb_groove_drawn_area(groove, axial_width, radial_space);
  }
  return radial_space * (axial_width + tan(draft) * radial_space) -
         (2.0 - 0.5 * M_PI) * corner_radius * corner_radius;
}

static double number(const SbGland *gland, size_t at) {
  return *(const double *)((const char *)gland + at);
}

static void evaluate(double *q, const SbGland *s) {
  const double d = s->section_diameter, id = s->inner_diameter;
  const double g = s->radial_space, bore = s->bore_diameter;
  const double mean = (bore - g) / (id + d) - 1.0;
  q[SB_GLAND_STRETCH_INNER] = (bore - 2.0 * g) / id - 1.0;
  q[SB_GLAND_STRETCH_MEAN] = mean;
  q[SB_GLAND_SQUEEZE] = (d - g) / d;
  q[SB_GLAND_SECTION_FITTED] = d * (1.0 - s->poisson_ratio * mean);
  q[SB_GLAND_INTERFERENCE] = q[SB_GLAND_SECTION_FITTED] - g;
  q[SB_GLAND_SQUEEZE_FITTED] = q[SB_GLAND_INTERFERENCE] / q[SB_GLAND_SECTION_FITTED];
  double area, centroid;
  sb_seal_profile_area(&area, &centroid, &s->profile, d);
  const double groove = sb_groove_area(g, s->axial_width, s->draft, s->corner_radius, s->groove);
  q[SB_GLAND_FILL] = area * d * d * (id + d + 2.0 * centroid * d) / (groove * (bore - g));
  q[SB_GLAND_FILL_SWOLLEN] = q[SB_GLAND_FILL] * (1.0 + s->volume_swell);
  const double growth = cbrt(1.0 + s->volume_swell);
  const double mean_swollen = (bore - g) / (growth * (id + d)) - 1.0;
  q[SB_GLAND_SECTION_SWOLLEN] = growth * d * (1.0 - s->poisson_ratio * mean_swollen);
  q[SB_GLAND_SQUEEZE_SWOLLEN] = 1.0 - g / (growth * d);
  q[SB_GLAND_SWELL] = s->volume_swell;
  q[SB_GLAND_EXTRUSION_GAP] = bore - s->land_diameter;
}

// The read-outs with sizes moved by their tolerances, a bit for each that goes up and down.
static void evaluate_moved(double *q, const SbGland *gland, int up, int down) {
  SbGland at = *gland;
  for (int i = 0; i < SIZES; i++) {
    *(double *)((char *)&at + SIZE[i].value) +=
        ((up >> i & 1) - (down >> i & 1)) * number(gland, SIZE[i].tolerance);
  }
  evaluate(q, &at);
}

const char *sb_band_text(SbBand band) {
  static const char *const text[] = {[SB_BAND_NONE] = "",
                                     [SB_BAND_BELOW] = SB_LABEL("below"),
                                     [SB_BAND_WITHIN] = SB_LABEL("within"),
                                     [SB_BAND_ABOVE] = SB_LABEL("above")};
  return (size_t)band < sizeof text / sizeof text[0] ? text[band] : "";
}

SbBand sb_band_of(double value, double low, double high) {
  const double slack = 1e-9;
  return value < low - slack * fabs(low)     ? SB_BAND_BELOW
         : value > high + slack * fabs(high) ? SB_BAND_ABOVE
                                             : SB_BAND_WITHIN;
}

// Checks that the sizes are possible with their tolerances.
static SbStatus check_sizes(const SbGland *gland, SbReport *report) {
  for (int i = 0; i < SIZES; i++) {
    const double size = number(gland, SIZE[i].value), wide = number(gland, SIZE[i].tolerance);
    if (!(size > 0.0 && isfinite(size) && wide >= 0.0 && wide < size)) {
      return sb_fail_input(report, SB_ERROR_RANGE, SIZE[i].input,
                           "size %g m with a tolerance of %g m is not possible", size, wide);
    }
  }
  if (!(gland->poisson_ratio >= 0.0 && gland->poisson_ratio <= 0.5 && gland->volume_swell >= 0.0 &&
        isfinite(gland->volume_swell))) {
    return sb_fail_input(report, SB_ERROR_RANGE, SB_CONTACT_IN_POISSON_RATIO,
                         "Poisson's ratio %g or swell %g is not possible", gland->poisson_ratio,
                         gland->volume_swell);
  }
  if (!(gland->bore_diameter - gland->bore_diameter_tolerance >
        2.0 * (gland->radial_space + gland->radial_space_tolerance))) {
    return sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_BORE_DIAMETER,
                         "with its tolerances the bore leaves no stem inside the radial space");
  }
  return SB_OK;
}

// Sets the ranges of statistical tolerances: the root sum of squares of each tolerance alone.
static void add_squares(SbGlandReadout *out, const SbGland *gland) {
  double square[SB_GLAND_COUNT] = {0.0};
  for (int i = 0; i < SIZES; i++) {
    double high[SB_GLAND_COUNT], low[SB_GLAND_COUNT];
    evaluate_moved(high, gland, 1 << i, 0);
    evaluate_moved(low, gland, 0, 1 << i);
    for (int k = 0; k < SB_GLAND_COUNT; k++) {
      square[k] += 0.25 * (high[k] - low[k]) * (high[k] - low[k]);
    }
  }
  for (int k = 0; k < SB_GLAND_COUNT; k++) {
    out[k].rss_low = out[k].nominal - sqrt(square[k]);
    out[k].rss_high = out[k].nominal + sqrt(square[k]);
  }
}

SbStatus sb_gland_readouts(SbGlandReadout *out, const SbGland *gland, SbReport *report) {
  static const SbGlandReadout list[SB_GLAND_COUNT] = {
#define ENTRY(code, text, of_unit, low, high, of_band)                                             \
  [code] = {.name = text,                                                                          \
            .unit = of_unit,                                                                       \
            .source = of_band,                                                                     \
            .why = "",                                                                             \
            .band_low = (low) < 0.0 ? -INFINITY : (low),                                           \
            .band_high = (high) > 1e3 ? INFINITY : (high)},
      SB_GLAND_LIST(ENTRY)
#undef ENTRY
  };
  SbStatus status = check_sizes(gland, report);
  if (status != SB_OK) {
    return status;
  }

  // Nominal, and each corner of the tolerances: the read-outs are monotonic in every size.
  double value[SB_GLAND_COUNT];
  evaluate(value, gland);
  for (int k = 0; k < SB_GLAND_COUNT; k++) {
    out[k] = list[k];
    out[k].nominal = out[k].worst_low = out[k].worst_high = value[k];
  }
  take_row(out, gland);
  for (int corner = 0; corner < CORNERS; corner++) {
    evaluate_moved(value, gland, corner, ~corner);
    for (int k = 0; k < SB_GLAND_COUNT; k++) {
      out[k].worst_low = fmin(out[k].worst_low, value[k]);
      out[k].worst_high = fmax(out[k].worst_high, value[k]);
    }
  }

  add_squares(out, gland);
  for (int k = 0; k < SB_GLAND_COUNT; k++) {
    SbGlandReadout *r = &out[k];
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
