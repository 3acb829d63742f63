// Mooney-Rivlin energy c1 (J^(-2/3) I1 - 3) + c2 (J^(-4/3) I2 - 3) + p (J - 1), differentiated in
// the invariants a, D, f of a gradient without out-of-plane shear (see the header). c2 = 0 is the
// neo-Hookean energy, mu/2 = c1. Hyperelastic, isotropic; no rate, no damage.
#include "engine/contact/ring/ring_material.h"

#include <math.h>

void sb_ring_material(const SbRingMaterial *material, double a, double d, double f, double p,
                      SbRingSlopes *w) {
  double cube = cbrt(d * f);
  double v = material->c1 / (cube * cube);
  double q = material->c2 / (cube * cube * cube * cube);
  double s1 = a + f * f, s2 = d * d + a * f * f;
  // c1 (D f)^(-2/3) (a + f^2)
  w->a = v;
  w->d = -2.0 / 3.0 * v / d * s1;
  w->f = v * (-2.0 / 3.0 * s1 / f + 2.0 * f);
  w->ad = -2.0 / 3.0 * v / d;
  w->af = -2.0 / 3.0 * v / f;
  w->dd = 10.0 / 9.0 * v / (d * d) * s1;
  w->ff = v * (10.0 / 9.0 * s1 / (f * f) - 8.0 / 3.0 + 2.0);
  w->df = v * (4.0 / 9.0 * s1 / (d * f) - 4.0 / 3.0 * f / d);
  // c2 (D f)^(-4/3) (D^2 + a f^2)
  if (q != 0.0) {
    w->a += q * f * f;
    w->d += q * (-4.0 / 3.0 * s2 / d + 2.0 * d);
    w->f += q * (-4.0 / 3.0 * s2 / f + 2.0 * a * f);
    w->ad += -4.0 / 3.0 * q * f * f / d;
    w->af += 2.0 / 3.0 * q * f;
    w->dd += q * (28.0 / 9.0 * s2 / (d * d) - 16.0 / 3.0 + 2.0);
    w->ff += q * (28.0 / 9.0 * s2 / (f * f) - 16.0 / 3.0 * a + 2.0 * a);
    w->df += q * (16.0 / 9.0 * s2 / (d * f) - 8.0 / 3.0 * a * f / d - 8.0 / 3.0 * d / f);
  }
  // p (D f - 1)
  w->d += p * f;
  w->f += p * d;
  w->df += p;
}
