// A measured surface or profile: heights on a grid, and their preparation (form, outliers,
// filters). The functions may be called concurrently on different heights.
//
// The form is removed by least squares in z: mean, plane, polynomial of degree 2, or a cylinder of
// any direction, tilt and sign. Outliers are points whose distance from the median of the remainder
// exceeds a number of robust deviations (1.4826 times the median distance, P.J. Rousseeuw & C.
// Croux, J. Am. Stat. Assoc. 88 (1993) 1273); the form is then fitted again. Gaussian filters of
// ISO 16610-61 (areas) and -21 (profiles) have the weight
//
//   s(r) = exp(-pi (r/(alpha L))^2)/(alpha L)^n,  alpha = sqrt(ln 2/pi),
//
// and transmit half of the wavelength L. The short cut-off keeps the filtered surface (S filter),
// the long one the remainder (L filter). At edges and missing points the weights are normalised
// over the existing points. Not available: robust and spline filters.
#pragma once

#include "engine/base/status.h"

#include <stdint.h>

// Heights on a grid. One row: a profile.
typedef struct {
  size_t columns, rows;
  size_t stride; // elements of z from one row to the next, at least `columns`
  double dx, dy; // distance of adjacent columns and of adjacent rows [m]; dy of a profile is unused
  double *z;     // [rows][stride] heights [m], NaN: missing; owned by the caller
} SbHeights;

// Smallest number of columns (and of rows, unless 1), and largest number of points.
enum { SB_HEIGHTS_SIDE_MIN = 16 };
#define SB_HEIGHTS_POINTS_MAX ((size_t)1 << 26)

// X(enumerator, name): the forms.
#define SB_FORM_LIST(X)                                                                            \
  X(SB_FORM_NONE, "none")                                                                          \
  X(SB_FORM_PLANE, "plane")                                                                        \
  X(SB_FORM_QUADRATIC, "quadratic")                                                                \
  X(SB_FORM_CYLINDER, "cylinder")

// Form that is removed; the mean is removed in any case.
typedef enum {
#define SB_FORM_ENUM(code, text) code,
  SB_FORM_LIST(SB_FORM_ENUM)
#undef SB_FORM_ENUM
      SB_FORM_COUNT
} SbForm;

// Returns the name of a form (SbForm), such as "plane"; static.
const char *sb_form_name(int form);

// Steps of the preparation, in their order. The long cut-off is applied before the short one.
typedef struct {
  SbForm form;
  double outliers;     // robust deviations beyond which a point becomes missing; 0: no removal
  bool fill;           // missing points get a value, as by sb_heights_fill()
  double cutoff_short; // of the S filter, wavelength [m]; 0: none
  double cutoff_long;  // of the L filter, wavelength [m]; 0: none
} SbHeightsChoices;

// Robust deviations beyond which a point is counted as suspicious if outliers are not removed.
#define SB_HEIGHTS_SUSPICIOUS 8.0

// Result of the preparation.
typedef struct {
  size_t points;       // number of points of the grid
  size_t missing;      // number of missing points in the measured data
  size_t outliers;     // number of points that were made missing
  size_t suspicious;   // number of points beyond SB_HEIGHTS_SUSPICIOUS; 0 if outliers are removed
  size_t filled;       // number of missing points that got a value
  double form_share;   // fraction of the variance about the mean that the form explains
  double curved_share; // fraction of the variance about the plane that a quadratic form explains
  double form_radius;  // radius of the cylinder, > 0 convex, < 0 concave [m]; NaN: other forms
} SbHeightsReport;

// Prepares the heights in place. SB_ERROR_RANGE: grid too small, too large or without spacing, a
// height beyond 1000 km, an `outliers` that is not 0 to 1e6, a cut-off that is not 0 to 1 km, or a
// short cut-off that is not below the long one. SB_ERROR_INFEASIBLE: less than a quarter of the
// points is measured, or nothing remains. SB_ERROR_NOT_CONVERGED: no cylinder fits. After an error
// the heights are partly processed.
SbStatus sb_heights_prepare(SbHeightsReport *out, SbHeights *heights,
                            const SbHeightsChoices *choices, SbReport *report);

// Subtracts the least-squares form in place. *radius is SbHeightsReport.form_radius.
// SB_ERROR_INFEASIBLE: too few points determine the form. SB_ERROR_NOT_CONVERGED: no cylinder fits.
// After an error the heights are unchanged.
SbStatus sb_heights_level(double *radius, SbHeights *heights, SbForm form, SbReport *report);

// Applies a Gaussian filter of wavelength `cutoff` > 0 [m] in place: with `keep` the heights become
// the filtered surface (waves longer than `cutoff`), else the remainder (shorter waves). Missing
// points remain missing.
SbStatus sb_heights_filter(SbHeights *heights, double cutoff, bool keep, SbReport *report);

// Replaces missing points by the mean of the nearest measured ones in their row and column,
// weighted by the inverse distance; by 0, the mean of levelled heights, if there are none.
SbStatus sb_heights_fill(SbHeights *heights, SbReport *report);
