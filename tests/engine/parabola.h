// Surface compliances: a half-plane under a parabola, to hold fitted bodies against the half-plane,
// and the disc's.
#pragma once

#include "engine/contact/compliance.h"

#include <glib.h>

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

// The linear disc's, over three quarters of its radius to either side.
static inline SbSurfaceCompliance disc_surface(double radius, double young, double poisson) {
  SbSurfaceCompliance c;
  g_assert_cmpint(sb_compliance_disc(&c, radius, young, poisson, 0.75 * radius, NULL), ==, SB_OK);
  return c;
}
