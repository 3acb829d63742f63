// A half-plane under a parabola as a surface compliance, to hold fitted bodies against the
// half-plane.
#pragma once

#include "engine/contact/compliance.h"

// The gap x^2/(2 radius) + slope x over -reach .. reach, nothing beside the half-plane of
// `modulus`.
static inline SbSurfaceCompliance parabola(double modulus, double radius, double reach,
                                           double slope) {
  const double bend = 0.25 * reach * reach / radius; // x^2 = reach^2 (1 + T_2)/2
  return (SbSurfaceCompliance){.modes = 3,
                               .left = -reach,
                               .right = reach,
                               .modulus = modulus,
                               .gap = {bend, slope * reach, bend},
                               .beyond = {slope - reach / radius, slope + reach / radius}};
}
