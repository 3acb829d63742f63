// Static friction of a seal after a dwell (time at rest). The quasi-static cycle, the motion with
// inertia, each actuation of a life, and figures use these functions, which have no state.
//
// tau_0 is friction.shear_strength, m friction.load_coefficient, A the real contact area, W the
// load, t the dwell. friction.breakaway = ratio: friction of the dry contact times a ratio that may
// grow with the dwell,
//
//   F_s(t) = [static_ratio + dwell_gain ln(1 + t/dwell_time)] [tau_0 A_dry + m W_dry]
//
// friction.breakaway = ageing: the film of the last sliding is squeezed out, and the contact ages,
//
//   F_s(t) = tau_0 A(t) [1 + B ln(1 + t/t_c)] + m W(t),   at least the kinetic friction
//
// While the mean net pressure squeezes the film out (film/squeeze.h), the real area A(t) and, with
// coupled asperities, the asperities' load W(t) change from their values in sliding to those of the
// dry contact.
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

// Tabulates the static friction [N] of a solved sliding state against the dwell, for a state that
// touches and whose section slides (sb_breakaway_after() takes the others too); read the table with
// sb_dwell_at(). The table owns nothing. Its values are NaN if `state` lacks a quantity of the law.
// Writes the dwell after which half of the film is squeezed out [s] to *squeeze_time (0: the film
// is not thicker than the gap of the dry contact; NaN: there is no film). `known` is a rough law
// already computed for this seal's surface, which saves time, or NULL. The only error is
// SB_ERROR_MEMORY.
SbStatus sb_breakaway_law(SbDwellLaw *out, double *squeeze_time, const SbModel *model, int seal,
                          const SbSealState *state, const SbRoughLaw *known, SbReport *report);

// Computes *out, the relative error [1] of the time that sb_breakaway_law() writes to
// *squeeze_time: the sum of half its changes between both signs of the errors of film, asperities'
// fraction of the load, net load, and contact width (central_error, share_error, net_error,
// width_error of `state`). The time depends steeply on them where the film is hardly thicker than
// the gap of the dry contact. 0 without a film. `known` and errors: sb_breakaway_law().
SbStatus sb_breakaway_squeeze_error(double *out, const SbModel *model, int seal,
                                    const SbSealState *state, const SbRoughLaw *known,
                                    SbReport *report);

// Computes *out, the static friction of a solved sliding state after the time `dwell` [s], a
// magnitude [N]: by sb_breakaway_law(); of a section that rolls or jams the kinetic friction; 0
// without contact. SB_ERROR_MEMORY is its only error.
SbStatus sb_breakaway_after(double *out, const SbModel *model, int seal, const SbSealState *state,
                            double dwell, SbReport *report);
