// Contact models, called by sb_fit_solve(). Private to engine/contact. Each function requires a
// problem that sb_fit_solve() has checked, and a result that is zero except the common sizes
// (squeeze, stretch, fill). It sets contact, profile, solver information and warnings. Errors are
// those of sb_fit_solve().
#pragma once

#include "engine/contact/fit.h"

// Solves one of the four closed forms (closed_forms.h).
SbStatus sb_fit_closed(SbFit *out, const SbFitProblem *in, SbReport *report);

// Solves the linear disc or the thesis' disc (disc/).
SbStatus sb_fit_disc(SbFit *out, const SbFitProblem *in, SbReport *report);

// Solves the finite-element ring (ring/).
SbStatus sb_fit_ring(SbFit *out, const SbFitProblem *in, SbReport *report);

// Number of profile points that sb_fit_contact() sets.
enum { SB_FIT_POINTS = 257 };

// Sets `touches`, contact_left = `left`, contact_right = `right` [m], contact_width, load (from
// load_per_length and circumference, which must be set), and SB_FIT_POINTS profile positions with
// zero pressure, denser near the edges.
void sb_fit_contact(SbFit *out, double left, double right);

// Sets out->solver.error_estimate: relative errors of load, peak pressure and width.
void sb_fit_errors(SbFit *out, double load, double peak, double width);
