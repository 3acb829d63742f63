// The curve of a contact for drawing, in SI: the profile that the run kept, or, where it kept none,
// the shape of Hertz from the frame's peak, width and central film.
#pragma once

#include "app/chart/data.h"

typedef struct {
  size_t count;
  double *x, *pressure, *film, *asperity; // one block, owned through x
  bool asperities;                        // any share of the pressure is known to be theirs
  const char *model;                      // who made it; NULL: schematic
} SbContactCurve;

// Whether the seal of a frame has a loaded contact; NULL has none.
bool sb_contact_touches(const SbSealFrame *seal);

// Curve of a seal (SB_OUTER, SB_INNER) that touches, at a frame of the run.
void sb_contact_curve_init(SbContactCurve *out, const SbChartRun *run, const SbSealFrame *seal,
                           int index);
void sb_contact_curve_finish(SbContactCurve *curve);

// Moves the ends of the part to draw outwards to where the pressure has come down to the fluid's: a
// solved film spreads a little beyond the dry contact that the frame's width tells.
void sb_contact_curve_extend(const SbContactCurve *curve, const SbSealFrame *seal, double *left,
                             double *right);

// One of the curve's arrays at x, linear between its points.
double sb_contact_curve_at(const SbContactCurve *curve, const double *value, double x);
