// Static friction of a seal after a dwell (time at rest): one law for the quasi-static cycle, the
// motion with inertia, each actuation of a life, and figures. The functions have no state.
//
// friction.breakaway = ratio: friction of the dry contact times a ratio that may grow with the
// dwell,
//
//   F_s(t) = [static_ratio + dwell_gain ln(1 + t/dwell_time)] [tau_0 A_dry + m W_dry]
//
// friction.breakaway = ageing: the contact of the last sliding, whose film is squeezed out and
// which ages,
//
//   F_s(t) = tau_0 A(t) [1 + B ln(1 + t/t_c)] + m W(t),   at least the kinetic friction
//
// The real area A(t) and (coupled asperities) the asperities' load W(t) change from those of
// sliding to the dry ones while the film is squeezed out (film/squeeze.h) by the mean net pressure.
// A(t) is that of Greenwood and Tripp's model at the film, or of the rough law at its mean gap if
// asperities share the load. Persson's area only ages. A dwell much shorter than the squeeze-out
// gives no peak, a long one the full static friction and a logarithmic increase.
//
// Ageing: growth of real area (Dieterich and Kilgore, Pure Appl. Geophys. 143 (1994) 283) or
// strength. Baumberger and Caroli, Adv. Phys. 55 (2006) 279: B = 0.01 to 0.1 for polymers below and
// elastomers above the glass transition; t_c is the age of sliding contacts, their size divided by
// the speed. Not modelled: rest after sliding at other speeds than the cycle's, squeezing during
// deceleration at a stop, ageing under shear.
#pragma once

#include "engine/mechanism/dwell.h"
#include "engine/valve/figures/summary.h"
#include "engine/valve/model/model.h"

// Tabulates the static friction [N] of a seal's solved state against the dwell (values NaN if the
// state lacks a quantity), and writes the dwell after which half of the film is squeezed out [s] to
// *squeeze_time (NaN without a film). `known` is a law of the seal's surface as in
// sb_rough_law_like(), or NULL.
SbStatus sb_breakaway_law(SbDwellLaw *out, double *squeeze_time, const SbModel *model, int seal,
                          const SbSealState *state, const SbRoughLaw *known, SbReport *report);

// Computes *out, the static friction of a seal's state after a `dwell` [s], in N: by that law, or
// the largest sliding friction of a section that rolls or jams; 0 without contact. SB_ERROR_MEMORY
// is its only error.
SbStatus sb_breakaway_after(double *out, const SbModel *model, int seal, const SbSealState *state,
                            double dwell, SbReport *report);
