// Viscosity of a fluid from its density and temperature. The functions have no state and may be
// called concurrently.
//
//   eta = eta_0(T) (1 + N_A sigma^3 B*(kT/epsilon) rho) + sum n delta^d tau^t
//         + f delta^d (1/(delta_0 - delta) - 1/delta_0)
//   delta_0 = (g_0 + g_1 tau^(-1/2)) / (1 + h_1/tau + h_2/tau^2)
//
// B*: second viscosity virial of Rainwater and Friend by Vogel, Kuechenmeister, Bich and Laesecke,
// J. Phys. Chem. Ref. Data 27 (1998) 947, if the publication uses it. eta_0: viscosity of the
// dilute gas, by a fit of the collision integral or a quotient of polynomials in T. Without a
// free-volume term f = 0. tau = temperature/T and delta = rho/density with the constants of
// SbViscosity.
//
// A fluid without a correlation uses that of a reference fluid (index 0) in the conformal state
// (rho_0, T_0), where alpha and the compressibility factor are equal (extended corresponding
// states, Huber, Laesecke and Perkins, Ind. Eng. Chem. Res. 42 (2003) 3163):
//
//   eta = eta_0(T) + (eta - eta_0)_reference(rho_0 psi, T_0) sqrt(T/T_0 M/M_0) (rho/rho_0)^(2/3)
//
// with eta_0 by Neufeld's collision integral and psi a polynomial of the density.
#pragma once

#include "engine/fluid/helmholtz.h"

// Coefficients of a correlation; symbols as above.
typedef struct {
  double epsilon; // epsilon/k of the Lennard-Jones potential [K]
  double sigma;   // sigma of the Lennard-Jones potential [nm]
  // eta_0 [Pa.s] = chapman sqrt(mass T)/(sigma^2 exp(sum a_i ln^i (kT/epsilon))), mass in g/mol
  double chapman, mass;
  double collision[5];         // a_i
  double above[4], below[3];   // if chapman is 0: eta_0 = sum above_i T^i / sum below_i T^i [Pa.s]
  bool initial;                // the term with B* is used
  double temperature, density; // reducing temperature [K] and density [mol/m3]
  const double (*term)[3];     // [count] (n [Pa.s], d, t), borrowed
  size_t count;                // number of terms
  // Free-volume term: f [Pa.s] (0: none), d, (g_0, g_1), (h_1, h_2).
  double free, free_d, g[2], h[2];
} SbViscosity;

// Coefficients for corresponding states.
typedef struct {
  double epsilon, sigma;  // Lennard-Jones parameters epsilon/k [K] and sigma [nm] of the fluid
  double psi[3], density; // psi = sum psi_i (rho/density)^i, density in mol/m3
  const SbHelmholtz *reference; // equation of state of the reference fluid, borrowed
  const SbViscosity *viscosity; // correlation of the reference fluid, borrowed
  double mass;                  // molar mass of the reference fluid [kg/mol]
} SbCorresponding;

// Returns the viscosity eta [Pa.s] at a molar density [mol/m3] and temperature [K]. Writes eta -
// eta_0 [Pa.s] to *residual (NULL: not wanted).
double sb_viscosity(double *residual, const SbViscosity *viscosity, double density,
                    double temperature);

// Computes the viscosity *out [Pa.s] by corresponding states, for a fluid with the molar mass
// `mass` [kg/mol] and the equation of state `equation`. `state` is the result of sb_helmholtz() for
// `equation` at `density` [mol/m3] and `temperature` [K] (of a saturated liquid:
// SbSaturation.liquid_state). SB_ERROR_NOT_CONVERGED: no conformal state was found.
SbStatus sb_viscosity_corresponding(double *out, const SbCorresponding *corresponding,
                                    const SbHelmholtz *equation, double mass,
                                    const SbResidual *state, double density, double temperature,
                                    SbReport *report);
