// First and second derivatives of the isochoric energy plus p (J - 1).
//
// Internal to the ring. With no shear out of the plane the energy depends on three numbers only:
// a = F:F of the 2 x 2 in-plane gradient, D its determinant and f the hoop stretch
// (I1 = a + f^2, I2 = D^2 + a f^2, J = D f), so that Mooney-Rivlin needs no tensor algebra.
#pragma once

#include "engine/contact/ring/ring_fem.h"

typedef struct {
  double a, d, f, ad, af, dd, ff, df;
} SbRingSlopes;

// Derivatives at (a, D > 0, f > 0) and pressure-like multiplier p (tension positive).
void sb_ring_material(const SbRingMaterial *material, double a, double d, double f, double p,
                      SbRingSlopes *w);
