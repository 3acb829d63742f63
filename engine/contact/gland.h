// Design read-outs of a ring in its gland against customary bands, with tolerances.
//
// Stretch, squeeze, fill and extrusion gap from sizes alone, also for the ring as swollen; each
// with its worst case over all corners of the tolerances, its root-sum-square range (linearised,
// independent tolerances) and a customary band. The bands are habits for hydraulic and pneumatic
// O-rings, not limits of physics: Parker O-Ring Handbook ORD 5700. Those of squeeze and clearance
// are rows of its gland tables for standard sections, reciprocating (chart 5-2) or static (chart
// 4-2). A row holds for round sections within an eighth of its own; for others the table gives no
// judgement. The thesis' valve stretches its ring by 15.5 % on the stem against the customary 5 %.
//
//   stretch_inner (D - 2 g)/ID - 1      stretch_mean (D - g)/(ID + d) - 1
//   squeeze (d - g)/d                   section_fitted d (1 - nu stretch_mean)
//   interference section_fitted - g     gland_fill (pi/4) d^2 (ID + d)/(g (D - g) b)
//   squeeze_fitted interference/section_fitted
//   extrusion_gap D - D_land, diametral
//   section_diameter_swollen, squeeze_swollen: the free ring grown by (1 + v)^(1/3), then fitted
//   gland_fill_swollen gland_fill (1 + v)
#pragma once

#include "engine/base/status.h"
#include "engine/contact/ring/ring_drawn_groove.h"

// enumerator, name, unit, customary low, high (of the value; a value below 0 or above 1e3 is no
// limit), source of the band ("": no band, or the one of the row for the section)
#define SB_GLAND_LIST(X)                                                                           \
  X(SB_GLAND_STRETCH_INNER, "stretch_inner", "1", 0.0, 0.05,                                       \
    "Parker ORD 5700, section 5.10: stretch on the groove floor up to 5 %")                        \
  X(SB_GLAND_STRETCH_MEAN, "stretch_mean", "1", -1.0, 1e9, "")                                     \
  X(SB_GLAND_SQUEEZE, "squeeze", "1", -1.0, 1e9, "")                                               \
  X(SB_GLAND_SQUEEZE_FITTED, "squeeze_fitted", "1", -1.0, 1e9, "")                                 \
  X(SB_GLAND_SECTION_FITTED, "section_diameter_fitted", "m", -1.0, 1e9, "")                        \
  X(SB_GLAND_INTERFERENCE, "interference", "m", 0.2e-3, 1e9,                                       \
    "Parker ORD 5700, section 5.9: at least about 0.2 mm for any section")                         \
  X(SB_GLAND_FILL, "gland_fill", "1", 0.60, 0.85, "Parker ORD 5700: 60 to 85 %, best 75 %")        \
  X(SB_GLAND_FILL_SWOLLEN, "gland_fill_swollen", "1", -1.0, 0.95,                                  \
    "room for swell: the groove must not be filled")                                               \
  X(SB_GLAND_SECTION_SWOLLEN, "section_diameter_swollen", "m", -1.0, 1e9, "")                      \
  X(SB_GLAND_SQUEEZE_SWOLLEN, "squeeze_swollen", "1", -1.0, 0.30,                                  \
    "Parker ORD 5700, section 5.9: at most 30 %")                                                  \
  X(SB_GLAND_SWELL, "volume_swell", "1", -1.0, 0.20,                                               \
    "Parker ORD 5700, section 5.16.4: above 20 % is excessive for a moving seal")                  \
  X(SB_GLAND_EXTRUSION_GAP, "extrusion_gap", "m", -1.0, 1e9, "")

typedef enum {
#define SB_GLAND_ENUM(code, text, unit, low, high, source) code,
  SB_GLAND_LIST(SB_GLAND_ENUM)
#undef SB_GLAND_ENUM
      SB_GLAND_COUNT
} SbGlandQuantity;

// Area of a groove's section up to the bore [m2]: walls lean apart by the draft [rad], corners at
// the floor are rounded; or as it is drawn (NULL: it is not).
double sb_groove_area(double radial_space, double axial_width, double draft, double corner_radius,
                      const SbGrooveDrawing *groove);

typedef enum { SB_GLAND_RECIPROCATING, SB_GLAND_STATIC, SB_GLAND_USE_COUNT } SbGlandUse;

// Customary bands of a standard section in one use: squeeze [1] and diametral clearance [m].
typedef struct {
  double squeeze_low, squeeze_high, gap_low, gap_high;
  const char *squeeze_source, *gap_source;
} SbGlandBands;

// A row of the standard gland tables.
typedef struct {
  double section; // nominal section diameter [m]
  SbGlandBands use[SB_GLAND_USE_COUNT];
} SbGlandRow;

// Returns the row for a section diameter [m]; NULL: the tables have no section within an eighth.
const SbGlandRow *sb_gland_row(double section_diameter);

// Sizes with half-widths of their tolerance bands [m].
typedef struct {
  SbGlandUse use;        // whose bands judge squeeze and clearance; 0: reciprocating
  SbSealProfile profile; // of the section; of others than the circle section_diameter is its height
  double section_diameter, section_diameter_tolerance;
  double inner_diameter, inner_diameter_tolerance;
  double radial_space, radial_space_tolerance;
  double axial_width, axial_width_tolerance; // at the floor
  double draft, corner_radius;               // of walls [rad], of the corners at the floor [m]
  const SbGrooveDrawing *groove;             // instead of those, borrowed; NULL: it is not drawn
  double bore_diameter, bore_diameter_tolerance;
  double land_diameter, land_diameter_tolerance; // of the stem beside the groove
  double poisson_ratio;                          // [-]
  double volume_swell;                           // v of rubber_time.h, 0 dry [-]
} SbGland;

typedef enum { SB_BAND_NONE, SB_BAND_BELOW, SB_BAND_WITHIN, SB_BAND_ABOVE } SbBand;

// Word for a verdict: "below", "within", "above" or ""; borrowed.
const char *sb_band_text(SbBand band);

// Where a value lies against a band; an end of the band, met but for rounding (1e-9 of it), belongs
// to the band: a squeeze of (1.6 - 1.36)/1.6 is 15 %. Infinite ends are open.
SbBand sb_band_of(double value, double low, double high);

typedef struct {
  const char *name;   // as in the list, borrowed
  const char *unit;   // "1" or "m"
  const char *source; // of the band, "" without
  const char *why;    // why a quantity that customarily has a band has none here; "" otherwise
  double nominal;
  double worst_low, worst_high; // over all corners of the tolerances
  double rss_low, rss_high;     // nominal -+ root of the sum of squares
  double band_low, band_high;   // -infinity, infinity if open
  SbBand band;                  // of the nominal value
  SbBand band_worst;            // WITHIN only if both worst cases are
} SbGlandReadout;

// Fills SB_GLAND_COUNT read-outs, indexed by SbGlandQuantity. SB_ERROR_RANGE with the key if a
// size is not positive or a tolerance is negative or as large as its size; SB_ERROR_INFEASIBLE if a
// corner of the tolerances leaves no groove floor. A land wider than the bore gives a negative
// extrusion gap, no error.
SbStatus sb_gland_readouts(SbGlandReadout *out, const SbGland *gland, SbReport *report);
