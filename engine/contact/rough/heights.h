// A measured surface: heights on a grid, made ready for its figures.
//
// Form is taken away by least squares in z: the mean, a plane, a polynomial of order 2, or a
// cylinder that lies on the surface with any direction, tilt and sign. Outliers are points further
// from the median of what is left than so many robust deviations (1.4826 times the median distance,
// P.J. Rousseeuw & C. Croux, J. Am. Stat. Assoc. 88 (1993) 1273); without them the form is fitted
// once more. Waves are then cut off by the Gaussian filter of ISO 16610-61 (areas) and -21
// (profiles), with the weight
//
//   s(r) = exp(-pi (r/(alpha L))^2)/(alpha L)^n,  alpha = sqrt(ln 2/pi),
//
// which passes half of the wave length L: the short cut-off keeps the mean line of the filter (S),
// the long one what is left beside it (L). At edges and missing points the weights are those of the
// points that there are. Leaves out robust and spline filters, and end corrections beyond that.
#pragma once

#include "engine/base/status.h"

#include <stdint.h>

// One row is a profile.
typedef struct {
  size_t columns, rows;
  size_t stride; // from a row to the next, at least `columns`
  double dx, dy; // between neighbours [m]
  double *z;     // heights [m], row after row, NaN where missing
} SbHeights;

enum { SB_HEIGHTS_SIDE_MIN = 16 }; // points that a side must have
#define SB_HEIGHTS_POINTS_MAX ((size_t)1 << 26)

// choice, name
#define SB_FORM_LIST(X)                                                                            \
  X(SB_FORM_NONE, "none")                                                                          \
  X(SB_FORM_PLANE, "plane")                                                                        \
  X(SB_FORM_QUADRATIC, "quadratic")                                                                \
  X(SB_FORM_CYLINDER, "cylinder")

typedef enum {
#define SB_FORM_ENUM(code, text) code,
  SB_FORM_LIST(SB_FORM_ENUM)
#undef SB_FORM_ENUM
      SB_FORM_COUNT
} SbForm;

const char *sb_form_name(int form); // borrowed

typedef struct {
  SbForm form;         // the mean is taken away in any case
  double outliers;     // robust deviations beyond which a point is none; 0: all stay
  bool fill;           // missing points take the value that their neighbours make likely
  double cutoff_short; // wave lengths [m]; 0: none
  double cutoff_long;
} SbHeightsChoices;

// Robust deviations beyond which points are counted as suspicious where all stay.
#define SB_HEIGHTS_SUSPICIOUS 8.0

// What was done.
typedef struct {
  size_t points;       // of the grid
  size_t missing;      // as measured
  size_t outliers;     // taken away
  size_t suspicious;   // beyond SB_HEIGHTS_SUSPICIOUS and left
  size_t filled;       //
  double form_share;   // of the variance about the mean that the form takes
  double curved_share; // of the variance about the plane that a quadratic form takes or would take
  double form_radius;  // of the cylinder, positive where it is convex [m]; NaN of others
} SbHeightsReport;

// Does it in place. SB_ERROR_RANGE for a grid too small, too large or without size, numbers that
// are no numbers, cut-offs out of range; SB_ERROR_INFEASIBLE where too few points are left;
// SB_ERROR_NOT_CONVERGED for a cylinder that does not fit.
SbStatus sb_heights_prepare(SbHeightsReport *out, SbHeights *heights,
                            const SbHeightsChoices *choices, SbReport *report);

// Least-squares form alone: subtracts it. *radius as in SbHeightsReport.
SbStatus sb_heights_level(double *radius, SbHeights *heights, SbForm form, SbReport *report);

// The Gaussian mean surface at wave length `cutoff` in place of the heights (`keep`: short), or
// what is left beside it.
SbStatus sb_heights_filter(SbHeights *heights, double cutoff, bool keep, SbReport *report);

// Gives missing points the mean of the nearest measured ones in their row and column, weighted by
// the inverse distance.
SbStatus sb_heights_fill(SbHeights *heights, SbReport *report);
