// The reduced modulus of thesis eq. 5.8; see the header.
#include "engine/contact/closed/reduced_modulus.h"

#include <math.h>

static double compliance(double modulus, double poisson) {
  return modulus > 0.0 && isfinite(modulus) ? (1.0 - poisson * poisson) / modulus : 0.0;
}

double sb_reduced_modulus(double modulus_a, double poisson_a, double modulus_b, double poisson_b) {
  double sum = compliance(modulus_a, poisson_a) + compliance(modulus_b, poisson_b);
  return sum > 0.0 ? 2.0 / sum : INFINITY;
}
