// Viscosity of a fluid from its density and temperature.
//
//   eta = eta_0(T) (1 + N_A sigma^3 B*(kT/epsilon) rho) + sum n delta^d tau^t
//         + f delta^d (1/(delta_0 - delta) - 1/delta_0)
//   delta_0 = (g_0 + g_1 tau^(-1/2)) / (1 + h_1/tau + h_2/tau^2)
//
// B*: Rainwater and Friend's second viscosity virial by Vogel, Kuechenmeister, Bich and Laesecke,
// J. Phys. Chem. Ref. Data 27 (1998) 947, where the paper has one. eta_0: a fit of the collision
// integral, or a quotient of polynomials in T. Where a paper gives no free-volume term, f = 0.
//
// A fluid without a correlation of its own follows a reference fluid in the conformal state
// (delta_0, T_0), at which alpha and the compression factor agree (extended corresponding states,
// Huber, Laesecke and Perkins, Ind. Eng. Chem. Res. 42 (2003) 3163):
//
//   eta = eta_0(T) + (eta - eta_0)_reference(rho_0 psi, T_0) sqrt(T/T_0 M/M_0) (rho/rho_0)^(2/3)
//
// with eta_0 by Neufeld's collision integral and psi a polynomial of the density.
#pragma once

#include "engine/fluid/helmholtz.h"

typedef struct {
  double epsilon;       // epsilon/k of Lennard and Jones [K]
  double sigma;         // [nm]
  double chapman, mass; // eta_0 = chapman sqrt(mass T)/(sigma^2 exp(sum a_i ln^i (kT/epsilon)))
  double collision[5];  // a_i
  // Where chapman is 0, eta_0 = sum a_i T^i / sum b_i T^i [Pa.s].
  double above[4], below[3];
  bool initial;                // with B*
  double temperature, density; // tau = temperature/T [K], delta = rho/density [mol/m3]
  const double (*term)[3];     // n [Pa.s], d, t
  size_t count;
  double free, free_d, g[2], h[2]; // f [Pa.s] and what goes with it
} SbViscosity;

typedef struct {
  double epsilon, sigma;  // [K], [nm]
  double psi[3], density; // polynomial of rho/density [mol/m3]
  const SbHelmholtz *reference;
  const SbViscosity *viscosity; // of the reference
  double mass;                  // of the reference [kg/mol]
} SbCorresponding;

// Viscosity [Pa.s] at a density [mol/m3] and temperature [K]; in *residual (may be NULL) without
// eta_0.
double sb_viscosity(double *residual, const SbViscosity *viscosity, double density,
                    double temperature);

// The same by corresponding states, of a fluid of `mass` [kg/mol] in a `state` of its `equation`.
SbStatus sb_viscosity_corresponding(double *out, const SbCorresponding *corresponding,
                                    const SbHelmholtz *equation, double mass,
                                    const SbResidual *state, double density, double temperature,
                                    SbReport *report);
