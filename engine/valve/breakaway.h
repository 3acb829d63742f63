// Friction that a seal's contact holds after a rest, and how it grows: one law for the quasi-static
// cycle, the motion with inertia, every actuation of a life, and figures.
//
// ratio (friction.breakaway = ratio): the dry contact's, raised by a fixed ratio that may grow,
//
//   F_s(t) = [static_ratio + dwell_gain ln(1 + t/dwell_time)] [tau_0 A_dry + m W_dry]
//
// ageing: the contact of the last sliding, from which the film goes and which ages,
//
//   F_s(t) = tau_0 A(t) [1 + B ln(1 + t/t_c)] + m W(t),   never below kinetic friction
//
// A(t) and W(t), real area and (asperities coupled) the asperities' load, go from those of sliding
// to the dry ones as the real contact does under a film that is squeezed out (film/squeeze.h) by
// the mean net pressure from that of steady sliding: at the film of Greenwood and Tripp's model
// beside it; at the mean gap of the rough law where asperities share the load, from their share in
// sliding on. Persson's area beside the film does not know it and only ages. So a rest much shorter
// than the squeeze-out shows no peak, a long one full static friction and a logarithm.
//
// Ageing, growth of the real area (Dieterich and Kilgore, Pure Appl. Geophys. 143 (1994) 283) or of
// its strength with the logarithm of the contacts' age: Baumberger and Caroli, Adv. Phys. 55 (2006)
// 279, give B of 0.01 to 0.1 for polymers below and elastomers above the glass transition, and for
// t_c the age of contacts that slide, their size over the speed. Leaves out: rest at other speeds
// than the cycle's (the film of its state stands for the last sliding's), what a stop's own
// deceleration squeezes (with inertia friction follows the speed down to the dry level, the least
// that then holds), ageing under shear.
#pragma once

#include "engine/mechanism/dwell.h"
#include "engine/valve/model.h"
#include "engine/valve/run/run.h"

// The law of a solved state of a seal [N], NaN where what it needs was not computed, and the rest
// in which half of the sliding film that goes has gone [s], NaN without a film. `known`: a law of
// the seal's surface, as in sb_rough_law_like().
SbStatus sb_breakaway_law(SbDwellLaw *out, double *squeeze_time, const SbModel *model, int seal,
                          const SbSealState *state, const SbRoughLaw *known, SbReport *report);

// Returns in *out what a state of a seal holds after a rest [N]: by that law, or by the section
// that rolls or jams under friction its greatest sliding friction. 0 for a seal that does not
// touch. SB_ERROR_MEMORY.
SbStatus sb_breakaway_after(double *out, const SbModel *model, int seal, const SbSealState *state,
                            double dwell, SbReport *report);
