// Residual Helmholtz energy and phase equilibrium; equations in helmholtz.h.
#include "engine/fluid/helmholtz.h"

#include "engine/numeric/root.h"

#include <math.h>

SbResidual sb_helmholtz(const SbHelmholtz *equation, double delta, double tau) {
  SbResidual sum = {0.0, 0.0, 0.0};
  for (size_t i = 0; i < equation->count; i++) {
    const double *k = equation->term[i];
    const double power = k[SB_TERM_L] > 0.0 ? pow(delta, k[SB_TERM_L]) : 0.0;
    const double from = delta - k[SB_TERM_EPSILON], to = tau - k[SB_TERM_GAMMA];
    const double value = k[SB_TERM_N] * pow(delta, k[SB_TERM_D]) * pow(tau, k[SB_TERM_T]) *
                         exp(-power - k[SB_TERM_ETA] * from * from - k[SB_TERM_BETA] * to * to);
    sum.alpha += value;
    sum.delta_alpha_delta +=
        value * (k[SB_TERM_D] - k[SB_TERM_L] * power - 2.0 * k[SB_TERM_ETA] * delta * from);
    sum.tau_alpha_tau += value * (k[SB_TERM_T] - 2.0 * k[SB_TERM_BETA] * tau * to);
  }
  return sum;
}

double sb_helmholtz_pressure(const SbHelmholtz *equation, double density, double temperature) {
  const SbResidual at =
      sb_helmholtz(equation, density / equation->density, equation->temperature / temperature);
  return density * equation->gas_constant * temperature * (1.0 + at.delta_alpha_delta);
}

typedef struct {
  const SbHelmholtz *equation;
  double tau;
  SbResidual liquid, vapour;
} Equilibrium;

// Maxwell's criterion; unknowns are delta of the liquid and ln delta of the vapour.
static bool equilibrium(double *r, const double *x, void *context) {
  Equilibrium *e = context;
  const double liquid = x[0], vapour = exp(x[1]);
  if (!(liquid > 1.0 && vapour < 1.0)) {
    return false; // towards the trivial solution
  }
  e->liquid = sb_helmholtz(e->equation, liquid, e->tau);
  e->vapour = sb_helmholtz(e->equation, vapour, e->tau);
  // Over the liquid's ideal pressure, of which rounding leaves little at low temperatures.
  r[0] = 1.0 + e->liquid.delta_alpha_delta - vapour / liquid * (1.0 + e->vapour.delta_alpha_delta);
  r[1] = log(liquid) + e->liquid.alpha + e->liquid.delta_alpha_delta - x[1] - e->vapour.alpha -
         e->vapour.delta_alpha_delta;
  return true;
}

SbStatus sb_helmholtz_saturation(SbSaturation *out, const SbHelmholtz *equation, double temperature,
                                 SbReport *report) {
  // Start: Wilson's vapour pressure over an ideal gas, the orthobaric density by Guggenheim (1945).
  const double tau = equation->temperature / temperature, theta = 1.0 - 1.0 / tau;
  const double critical = 1.0 + sb_helmholtz(equation, 1.0, 1.0).delta_alpha_delta;
  double x[2] = {1.0 + 1.75 * cbrt(theta) + 0.75 * theta,
                 log(critical * tau) + 5.373 * (1.0 + equation->acentric) * (1.0 - tau)};
  Equilibrium e = {.equation = equation, .tau = tau};
  SbBroyden broyden = {0};
  if (!(theta > 0.0) || !sb_solve_system(equilibrium, &e, x, 2, 1e-12, &broyden)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                   "no equilibrium of liquid and vapour found at %g K", temperature);
  }
  const double rt = equation->gas_constant * temperature;
  *out = (SbSaturation){
      .liquid = equation->density * x[0],
      .vapour = equation->density * exp(x[1]),
      .enthalpy = rt * (e.vapour.tau_alpha_tau + e.vapour.delta_alpha_delta -
                        e.liquid.tau_alpha_tau - e.liquid.delta_alpha_delta),
      .liquid_state = e.liquid,
  };
  out->pressure = out->vapour * rt * (1.0 + e.vapour.delta_alpha_delta);
  return sb_succeed(report);
}

typedef struct {
  const SbHelmholtz *equation;
  const SbResidual *state;
} Conformal;

static bool conformal(double *r, const double *x, void *context) {
  const Conformal *c = context;
  if (!(x[0] > 0.0 && x[1] > 0.0)) {
    return false;
  }
  const SbResidual at = sb_helmholtz(c->equation, x[0], x[1]);
  r[0] = at.alpha - c->state->alpha;
  r[1] = at.delta_alpha_delta - c->state->delta_alpha_delta;
  return true;
}

SbStatus sb_helmholtz_conformal(double *delta, double *tau, const SbHelmholtz *equation,
                                const SbResidual *state, SbReport *report) {
  double x[2] = {*delta, *tau};
  SbBroyden broyden = {0};
  if (!sb_solve_system(conformal, &(Conformal){equation, state}, x, 2, 1e-12, &broyden)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "no conformal state of the reference fluid");
  }
  *delta = x[0];
  *tau = x[1];
  return sb_succeed(report);
}
