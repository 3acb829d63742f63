// Design values of a ring in its gland, with tolerances and customary bands. The functions have no
// state and may be called concurrently.
//
// Each value has its nominal, its worst case over all corners of the tolerances, its
// root-sum-square range (linear, independent tolerances) and a customary band. The bands are
// practice for hydraulic and pneumatic O-rings, not limits of physics: Parker O-Ring Handbook ORD
// 5700. Those of squeeze and clearance are rows of its gland tables, reciprocating (chart 5-2) or
// static (chart 4-2); a row applies to round sections within 12.5 % of its own.
//
//   stretch_inner (D - 2 g)/ID - 1      stretch_mean (D - g)/(ID + d) - 1
//   squeeze (d - g)/d                   section_fitted d (1 - nu stretch_mean)
//   interference section_fitted - g     gland_fill (pi/4) d^2 (ID + d)/(g (D - g) b)
//   squeeze_fitted interference/section_fitted
//   extrusion_gap D - D_land, diametral
//   section_diameter_swollen a d (1 - nu ((D - g)/(a (ID + d)) - 1)),  a = (1 + v)^(1/3)
//   squeeze_swollen (a d - g)/(a d)     gland_fill_swollen gland_fill (1 + v)
//
// d section diameter, ID inner diameter, g radial space, b axial width, D bore diameter, v volume
// swell.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/ring/ring_drawn_groove.h"

// X(enumerator, name, unit, low and high end of the band (low < 0 or high > 1e3: open end), source
// of the band): the values. An empty source: no band, or that of the gland tables.
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

// Index of a value.
typedef enum {
#define SB_GLAND_ENUM(code, text, unit, low, high, source) code,
  SB_GLAND_LIST(SB_GLAND_ENUM)
#undef SB_GLAND_ENUM
      SB_GLAND_COUNT
} SbGlandQuantity;

// Returns the area of a groove's section up to the bore [m2]. The walls open by `draft` [rad], the
// corners at the floor have `corner_radius` [m]. With `groove` (NULL: none) its drawing replaces
// draft and corners.
double sb_groove_area(double radial_space, double axial_width, double draft, double corner_radius,
                      const SbGrooveDrawing *groove);

// Use of the gland, for the bands of squeeze and clearance.
typedef enum { SB_GLAND_RECIPROCATING, SB_GLAND_STATIC, SB_GLAND_USE_COUNT } SbGlandUse;

// Sizes of ring and gland, each with the half-width of its tolerance band [m].
typedef struct {
  SbGlandUse use;        // selects the bands; 0: reciprocating
  SbSealProfile profile; // shape of the section; if not a circle, section_diameter is its radial
                         // height
  double section_diameter, section_diameter_tolerance;
  double inner_diameter, inner_diameter_tolerance;
  double radial_space, radial_space_tolerance;
  double axial_width, axial_width_tolerance; // width of the groove at the floor
  double draft, corner_radius; // opening angle of each wall [rad]; radius of the corners at the
                               // floor [m]
  // Replaces draft and corner_radius, borrowed during the call; NULL: none.
  const SbGrooveDrawing *groove;
  double bore_diameter, bore_diameter_tolerance;
  double land_diameter, land_diameter_tolerance; // diameter of the stem next to the groove
  double poisson_ratio;                          // Poisson's ratio of the rubber
  double volume_swell;                           // v of rubber_time.h, 0: dry
} SbGland;

// Position of a value relative to a band.
typedef enum {
  SB_BAND_NONE,   // there is no band
  SB_BAND_BELOW,  // below its lower end
  SB_BAND_WITHIN, // inside, ends included
  SB_BAND_ABOVE   // above its upper end
} SbBand;

// Returns "below", "within", "above" or ""; static.
const char *sb_band_text(SbBand band);

// Returns the position of a value, which is not NaN, relative to a band. A value within 1e-9
// (relative) of an end belongs to the band. Infinite ends are open.
SbBand sb_band_of(double value, double low, double high);

// A design value.
typedef struct {
  const char *name;   // as in the list, static
  const char *unit;   // "1" or "m"
  const char *source; // reference of the band, "" if none
  const char *why;    // reason why a usual band does not apply; "" otherwise
  double nominal;
  double worst_low, worst_high; // minimum and maximum over all corners of the tolerances
  double rss_low, rss_high;     // nominal minus and plus the root of the sum of squares
  double band_low, band_high;   // ends of the band; -INFINITY, INFINITY: open
  SbBand band;                  // of the nominal value
  SbBand band_worst;            // of the worst cases: WITHIN only if both are inside
} SbGlandReadout;

// Computes out[SB_GLAND_COUNT], indexed by SbGlandQuantity. SB_ERROR_RANGE, with the input: a size
// is not positive, a tolerance is negative or not below its size, or Poisson's ratio or swell is
// out of range. SB_ERROR_INFEASIBLE: a corner of the tolerances leaves no groove floor. A land
// wider than the bore gives a negative extrusion gap and is not an error.
SbStatus sb_gland_readouts(SbGlandReadout *out, const SbGland *gland, SbReport *report);
