// Viscosity correlations and corresponding states; equations in viscosity.h.
#include "engine/fluid/viscosity.h"

#include <math.h>

#define AVOGADRO 6.02214129e23 // [1/mol]

static double polynomial(const double *a, size_t count, double x) {
  double sum = 0.0;
  while (count > 0) {
    sum = sum * x + a[--count];
  }
  return sum;
}

static double dilute(const SbViscosity *v, double temperature) {
  if (v->chapman == 0.0) {
    return polynomial(v->above, 4, temperature) / polynomial(v->below, 3, temperature);
  }
  return v->chapman * sqrt(v->mass * temperature) / (v->sigma * v->sigma) *
         exp(-polynomial(v->collision, 5, log(temperature / v->epsilon)));
}

// B*(kT/epsilon).
static double second_virial(double reduced) {
  static const double b[] = {-19.572881, 219.73999, -1015.3226, 2471.01251,
                             -3375.1717, 2491.6597, -787.26086};
  return polynomial(b, 7, pow(reduced, -0.25)) + 14.085455 * pow(reduced, -2.5) -
         0.34664158 * pow(reduced, -5.5);
}

double sb_viscosity(double *residual, const SbViscosity *v, double density, double temperature) {
  const double tau = v->temperature / temperature, delta = density / v->density;
  const double eta_0 = dilute(v, temperature);
  double sum = 0.0;
  if (v->initial) {
    sum += eta_0 * second_virial(temperature / v->epsilon) * AVOGADRO * pow(1e-9 * v->sigma, 3.0) *
           density;
  }
  for (size_t i = 0; i < v->count; i++) {
    sum += v->term[i][0] * pow(delta, v->term[i][1]) * pow(tau, v->term[i][2]);
  }
  if (v->free != 0.0) {
    const double packed =
        (v->g[0] + v->g[1] / sqrt(tau)) / (1.0 + v->h[0] / tau + v->h[1] / (tau * tau));
    sum += v->free * pow(delta, v->free_d) * (1.0 / (packed - delta) - 1.0 / packed);
  }
  if (residual != NULL) {
    *residual = sum;
  }
  return eta_0 + sum;
}

SbStatus sb_viscosity_corresponding(double *out, const SbCorresponding *c,
                                    const SbHelmholtz *equation, double mass,
                                    const SbResidual *state, double density, double temperature,
                                    SbReport *report) {
  // Start: equal reduced states.
  double delta = density / equation->density, tau = equation->temperature / temperature;
  const SbStatus status = sb_helmholtz_conformal(&delta, &tau, c->reference, state, report);
  if (status != SB_OK) {
    return status;
  }
  const double there = c->reference->density * delta, at = c->reference->temperature / tau;
  const double psi = polynomial(c->psi, 3, density / c->density);
  double residual = 0.0;
  (void)sb_viscosity(&residual, c->viscosity, there * psi, at);
  const double t = temperature / c->epsilon; // Neufeld, Janzen and Aziz (1972)
  const double omega =
      1.16145 * pow(t, -0.14874) + 0.52487 * exp(-0.7732 * t) + 2.16178 * exp(-2.43787 * t);
  *out = 26.692e-9 * sqrt(1e3 * mass * temperature) / (c->sigma * c->sigma * omega) +
         residual * sqrt(temperature / at * mass / c->mass) * pow(density / there, 2.0 / 3.0);
  return sb_succeed(report);
}
