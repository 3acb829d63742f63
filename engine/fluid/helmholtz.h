// Equation of state of a fluid by its residual Helmholtz energy, and the equilibrium of liquid and
// vapour. Pressures are absolute. The functions have no state and may be called concurrently.
//
//   alpha(delta, tau) = sum n delta^d tau^t exp(-delta^l - eta (delta - epsilon)^2
//                                               - beta (tau - gamma)^2)
//   p = rho R T (1 + delta alpha_delta),   delta = rho/rho_r,   tau = T_r/T
//
// delta^l is omitted if l = 0, so polynomial, exponential and Gaussian terms have one form. In
// equilibrium (Maxwell's criterion) p and ln delta + alpha + delta alpha_delta of both phases are
// equal. The enthalpy of vaporisation is R T times the difference of tau alpha_tau + delta
// alpha_delta, because the ideal-gas part depends on temperature only.
#pragma once

#include "engine/base/status.h"

// Position of each coefficient in a term; coefficients that are not given are 0.
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

// Coefficients of an equation of state.
typedef struct {
  double gas_constant;                // R of the publication [J/(mol.K)]
  double temperature;                 // T_r [K]
  double density;                     // rho_r [mol/m3]
  double acentric;                    // acentric factor, for initial guesses
  const double (*term)[SB_TERM_SIZE]; // [count], borrowed
  size_t count;                       // number of terms
} SbHelmholtz;

// alpha, and its derivatives multiplied by their variables [1].
typedef struct {
  double alpha, delta_alpha_delta, tau_alpha_tau;
} SbResidual;

// Returns alpha and its derivatives at the reduced density `delta` and the inverse reduced
// temperature `tau`, both > 0.
SbResidual sb_helmholtz(const SbHelmholtz *equation, double delta, double tau);

// Returns the pressure [Pa] at a density [mol/m3] and a temperature [K].
double sb_helmholtz_pressure(const SbHelmholtz *equation, double density, double temperature);

// Liquid and vapour in equilibrium.
typedef struct {
  double pressure;         // [Pa]
  double liquid, vapour;   // molar densities [mol/m3]
  double enthalpy;         // molar enthalpy of vaporisation, > 0 [J/mol]
  SbResidual liquid_state; // sb_helmholtz() of the liquid, for sb_helmholtz_conformal()
} SbSaturation;

// Computes the saturation state at `temperature` [K], clearly below the critical one.
// SB_ERROR_NOT_CONVERGED: no equilibrium was found (also above the critical temperature).
SbStatus sb_helmholtz_saturation(SbSaturation *out, const SbHelmholtz *equation, double temperature,
                                 SbReport *report);

// Finds the delta and tau of `equation` at which alpha and delta alpha_delta equal those of `state`
// (the conformal state of another fluid). *delta and *tau contain the initial guess and receive the
// solution; they are unchanged after SB_ERROR_NOT_CONVERGED.
SbStatus sb_helmholtz_conformal(double *delta, double *tau, const SbHelmholtz *equation,
                                const SbResidual *state, SbReport *report);
