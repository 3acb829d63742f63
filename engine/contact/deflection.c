// Equations and sources in deflection.h.
#include "engine/contact/deflection.h"

#include <math.h>

double sb_deflection_column(double pressure, double height, double modulus, double poisson_ratio) {
  const double nu = poisson_ratio;
  return pressure * height * (1 + nu) * (1 - 2 * nu) / (1 - nu) / modulus;
}

double sb_deflection_half_space(double x, double half_width, double radius) {
  const double X = fabs(x) / half_width;
  const double gap = X > 1 ? X * sqrt(X * X - 1) - acosh(X) : 0;
  return half_width * half_width / (2 * radius) * (X * X - gap);
}

// Integral of ln|x|, 0 at 0.
static double log_integral(double x) {
  return x != 0 ? x * (log(fabs(x)) - 1) : 0;
}

double sb_deflection_panel(double distance, double width) {
  return log_integral(distance - width / 2) - log_integral(distance + width / 2);
}

double sb_deflection_flamant(double x, double load, double datum, double modulus,
                             double poisson_ratio) {
  const double plane = modulus / (1 - poisson_ratio * poisson_ratio);
  return -2 * load / (M_PI * plane) * log(fabs(x) / datum);
}

double sb_deflection_disc(double load, double half_width, double radius, double modulus,
                          double poisson_ratio) {
  const double plane = modulus / (1 - poisson_ratio * poisson_ratio);
  return load / (M_PI * plane) * (2 * log(4 * radius / half_width) - 1);
}
