// See slit.h.
#include "engine/permeation/slit.h"

#include "engine/numeric/legendre.h"

#include <math.h>

static const double GAS_CONSTANT = 8.314462618; // J/(mol K)
static const double SLIP = 1.0162;

// Difference of Berman's formula from Clausing's equation, solved to 1e-6 (test_permeation_slit.c
// solves it again), against ln(L/h); beyond, the last value, accurate to 0.05 %.
static double above_clausing(double l) {
  static const double at[] = {3, 5, 7, 10, 14, 20, 30, 50, 100, 200, 500};
  static const double by[] = {0.0,     2.0e-4,  5.14e-4, 1.03e-3, 1.64e-3, 2.35e-3,
                              3.14e-3, 3.97e-3, 4.69e-3, 4.91e-3, 4.67e-3};
  enum { COUNT = sizeof at / sizeof at[0] };
  int i = 1;
  if (l <= at[0]) {
    return by[0];
  }
  while (i < COUNT - 1 && l > at[i]) {
    i++;
  }
  const double share = fmin(1.0, log(l / at[i - 1]) / log(at[i] / at[i - 1]));
  return by[i - 1] + share * (by[i] - by[i - 1]);
}

double sb_slit_transmission(double l) {
  const double root = sqrt(1.0 + l * l), direct = 0.5 * (1.0 + 1.0 / (root + l));
  if (l < 1e-3) {
    return direct; // the remainder is of third order
  }
  if (l > 1e4) {
    // The difference below is rounding.
    return (log(2.0 * l) - 0.5) / l * (1.0 - above_clausing(l));
  }
  const double bend = l - asinh(l);
  const double below = l * l * l + 3.0 * l * l + 4.0 - (l * l + 4.0) * root;
  return (direct - 1.5 * bend * bend / below) * (1.0 - above_clausing(l));
}

double sb_slit_rate(double d, double l) {
  const double free_flight = sb_slit_transmission(l) * l / sqrt(M_PI);
  if (free_flight <= SLIP) {
    return d / 6.0 + free_flight;
  }
  const double least = 0.33, x = pow(d, 0.75);
  const double end = least / expm1(sqrt(M_PI) * (free_flight - SLIP));
  const double a = least + 1.56 * x / (x + 1.885);
  return d / 6.0 + SLIP + log1p(a / (d + end)) / sqrt(M_PI);
}

double sb_slit_mass_flow(const SbSlit *s, double high, double low) {
  enum { POINTS = 24, PANELS = 3 };
  const double v = sqrt(2.0 * GAS_CONSTANT * s->temperature / s->molar_mass);
  double x[POINTS], w[POINTS], sum = 0.0;
  sb_legendre_gauss(x, w, POINTS);
  // Towards a vacuum the integrand bends near 0: panels that shrink by ten.
  double top = high;
  for (int panel = 0; panel < PANELS; panel++) {
    const double bottom = panel == PANELS - 1 ? low : fmax(low, 0.1 * top);
    for (int i = 0; i < POINTS; i++) {
      const double p = 0.5 * (top + bottom) + 0.5 * (top - bottom) * x[i];
      sum += 0.5 * (top - bottom) * w[i] *
             sb_slit_rate(p * s->height / (s->viscosity * v), s->length / s->height);
    }
    top = bottom;
  }
  return s->height * s->height / (v * s->length) * sum;
}

double sb_slit_liquid_drive(double difference, double tension, double contact_angle,
                            double height) {
  return fmax(difference + 2.0 * tension * cos(contact_angle) / height, 0.0);
}

bool sb_slit_plugged(double difference, double tension, double contact_angle, double height) {
  return difference < 2.0 * tension * cos(contact_angle) / height;
}
