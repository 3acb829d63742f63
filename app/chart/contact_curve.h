// The curve of a contact for drawing: the profile that the run stored, or if it stored none,
// Hertz's shape from the frame's peak pressure, width and central film.
#pragma once

#include "app/chart/data.h"

// A curve. Initialised by sb_contact_curve_init(), freed by sb_contact_curve_finish(). Pressures
// are above the lower of the two fluid pressures of the seal.
typedef struct {
  size_t count;
  double *x;         // [count], in the seal's frame, increasing [m]
  double *pressure;  // [count], contact pressure, outside of the contact that of the fluid [Pa]
  double *film;      // [count], film thickness [m]; 0: not computed
  double *asperity;  // [count], pressure carried by asperities [Pa]
  bool asperities;   // `asperity` is not 0 everywhere
  const char *model; // name of the model that computed it, static; NULL: Hertz's shape
} SbContactCurve;

// Returns whether the seal of a frame (NULL: no) has a loaded contact.
bool sb_contact_touches(const SbSealFrame *seal);

// Sets the curve of seal `index` (SB_OUTER, SB_INNER), which must be in contact, at the frame of
// `run` to which `seal` belongs.
void sb_contact_curve_init(SbContactCurve *out, const SbChartRun *run, const SbSealFrame *seal,
                           int index);

// Frees the arrays.
void sb_contact_curve_finish(SbContactCurve *curve);

// Moves the ends *left and *right [m] of the part that is drawn, which the caller has set to the
// contact's ends, outwards to where the pressure equals the fluid's on that side: a solved film
// extends a little beyond the dry contact of the frame.
void sb_contact_curve_extend(const SbContactCurve *curve, const SbSealFrame *seal, double *left,
                             double *right);

// Returns the value of `value`, one of the curve's arrays, at x [m]: linear between its points,
// outside of them that of the nearer end.
double sb_contact_curve_at(const SbContactCurve *curve, const double *value, double x);
