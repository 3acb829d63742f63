// Inside the contact models: what fit.c calls to solve each of them. Every function gets a checked
// problem and a result with the common sizes filled in, and adds contact, solver and warnings.
#pragma once

#include "engine/contact/fit.h"

// The closed forms, all four (closed_forms.h).
SbStatus sb_fit_closed(SbFit *out, const SbFitProblem *in, SbReport *report);
// The linear disc, the thesis' own too (disc/).
SbStatus sb_fit_disc(SbFit *out, const SbFitProblem *in, SbReport *report);
SbStatus sb_fit_ring(SbFit *out, const SbFitProblem *in, SbReport *report);

// A contact between two edges [m] with the circumference and the load per length that stand in
// `out`: edges, width and load, and a profile of zero pressure at SB_FIT_POINTS places that crowd
// towards the edges.
enum { SB_FIT_POINTS = 257 };
void sb_fit_contact(SbFit *out, double left, double right);

// The sizes that follow from a problem alone.
void sb_fit_sizes(SbFit *out, const SbFitProblem *in);

// Relative errors of load, peak and width.
void sb_fit_errors(SbFit *out, double load, double peak, double width);
