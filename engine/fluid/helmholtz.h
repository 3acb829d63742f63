// A fluid's equation of state in the residual Helmholtz energy, and the equilibrium of liquid and
// vapour that follows from it.
//
//   alpha(delta, tau) = sum n delta^d tau^t exp(-delta^l - eta (delta - epsilon)^2
//                                               - beta (tau - gamma)^2)
//   p = rho R T (1 + delta alpha_delta),   delta = rho / rho_r,   tau = T_r / T
//
// with delta^l left out where l = 0: polynomial, exponential and Gaussian terms of the papers are
// one term. In equilibrium (Maxwell's criterion) p and ln delta + alpha + delta alpha_delta agree;
// the enthalpy of vaporisation is R T times the difference of tau alpha_tau + delta alpha_delta,
// because the ideal gas' part depends on temperature alone.
#pragma once

#include "engine/base/status.h"

// What a term consists of; what is not written in the table is 0.
enum {
  SB_TERM_N,
  SB_TERM_D,
  SB_TERM_T,
  SB_TERM_L,
  SB_TERM_ETA,
  SB_TERM_EPSILON,
  SB_TERM_BETA,
  SB_TERM_GAMMA,
  SB_TERM_SIZE
};

typedef struct {
  double gas_constant; // of the paper [J/(mol.K)]
  double temperature;  // T_r [K]
  double density;      // rho_r [mol/m3]
  double acentric;     // acentric factor, for starting values
  const double (*term)[SB_TERM_SIZE];
  size_t count;
} SbHelmholtz;

// alpha and its derivatives times their variables.
typedef struct {
  double alpha, delta_alpha_delta, tau_alpha_tau;
} SbResidual;

SbResidual sb_helmholtz(const SbHelmholtz *equation, double delta, double tau);

// Pressure [Pa] at a density [mol/m3] and temperature [K].
double sb_helmholtz_pressure(const SbHelmholtz *equation, double density, double temperature);

typedef struct {
  double pressure;         // [Pa]
  double liquid, vapour;   // densities [mol/m3]
  double enthalpy;         // of vaporisation [J/mol]
  SbResidual liquid_state; // alpha of the liquid
} SbSaturation;

// State at saturation, for temperatures clearly below the critical one. SB_ERROR_NOT_CONVERGED.
SbStatus sb_helmholtz_saturation(SbSaturation *out, const SbHelmholtz *equation, double temperature,
                                 SbReport *report);

// delta and tau of `equation` at which alpha and the compression factor are those given: the
// conformal state of another fluid. *delta and *tau hold starting values.
SbStatus sb_helmholtz_conformal(double *delta, double *tau, const SbHelmholtz *equation,
                                const SbResidual *state, SbReport *report);
