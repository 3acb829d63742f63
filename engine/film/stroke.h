// Leakage dragged through the contact by one stroke.
//
// Source: thesis equations 5.19 to 5.21. A film of central thickness h under a sliding seal carries
// half of it along, q = (1/2) pi D h L over a stroke L, D being the bore; the net loss of a cycle
// is what the out-stroke carries less what the return brings back. Validity: flooded inlet; a film,
// not a rough gap.
#pragma once

#include <math.h>

// Volume [m3] over a signed stroke `length` [m] at film `film` [m] on a bore of `diameter` [m].
static inline double sb_leak_stroke(double diameter, double film, double length) {
  return M_PI * diameter * film * length / 2;
}
