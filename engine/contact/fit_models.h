// Inside the contact models: what fit.c calls to solve each of them. Every function gets a checked
// problem and a result with the common sizes filled in, and adds contact, solver and warnings.
#pragma once

#include "engine/contact/fit.h"

SbStatus sb_fit_karaszkiewicz(SbFit *out, const SbFitProblem *in, SbReport *report);
SbStatus sb_fit_hertz(SbFit *out, const SbFitProblem *in, SbReport *report);
SbStatus sb_fit_lindley(SbFit *out, const SbFitProblem *in, SbReport *report);
SbStatus sb_fit_green_english(SbFit *out, const SbFitProblem *in, SbReport *report);
SbStatus sb_fit_disc(SbFit *out, const SbFitProblem *in, SbReport *report);
SbStatus sb_fit_disc_thesis(SbFit *out, const SbFitProblem *in, SbReport *report);
SbStatus sb_fit_ring(SbFit *out, const SbFitProblem *in, SbReport *report);
