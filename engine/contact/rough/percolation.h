// Static leakage through a closed rough contact at rest, by percolation and the critical
// constriction. The functions have no state and may be called concurrently.
//
// Source: B.N.J. Persson & C. Yang, J. Phys.: Condens. Matter 20 (2008) 315011. With increasing
// magnification (wave number q) the fraction of real contact A(q)/A0 decreases. At the wave number
// q_c it reaches the percolation threshold (0.42; Dapp et al., Phys. Rev. Lett. 108 (2012) 244301),
// and the first open channel crosses the contact, through a constriction of lateral size 2 pi/q_c
// and height u_c. The full pressure drop dp acts across the constriction, and each square of the
// contact has one constriction:
//
//   Q = (u_c^3/(12 eta)) dp L_y/L_x
//
// for a laminar liquid, L_y the circumference, L_x the width of the contact. If the contact stays
// above the threshold at all wavelengths, Q = 0. Near the threshold Q is very sensitive to the
// contact pressure (`sensitivity`). Not modelled: the pressure profile (the mean contact pressure
// is used), two-phase flow, diffusion.
#pragma once

#include "engine/contact/rough/persson.h"

// Fraction of real contact at which the first channel opens.
#define SB_PERCOLATION_THRESHOLD 0.42

// Height of the constriction divided by the rms roughness from which on Gaussian surfaces have no
// contact: an open path. sb_percolation_solve() does not compare with it; its caller does.
#define SB_PERCOLATION_OPEN_GAP 3.0

// A contact.
typedef struct {
  const SbSpectrum *spectrum; // borrowed during the call
  double modulus;             // E', 2/E' = sum (1 - nu^2)/E [Pa]
  double contact_pressure;    // mean pressure of the solids (total minus fluid) [Pa]
  double viscosity;           // [Pa s]
  double pressure_drop;       // of the fluid [Pa]
  double width;               // L_x, in flow direction [m]
  double circumference;       // L_y [m]
} SbPercolationProblem;

// Leakage of a contact.
typedef struct {
  bool percolates;         // an open channel exists
  double real_share;       // fraction of real contact with all roughness, A(q1)/A0
  double constriction_q;   // q_c [1/m]; 0 if closed
  double constriction_gap; // u_c [m]; 0 if closed
  double leak_rate;        // Q [m3/s], with the sign of pressure_drop; 0 if closed
  double sensitivity;      // d ln Q/d ln contact_pressure, negative; 0 if leak_rate is not positive
  double closing_pressure; // contact pressure above which no channel is open [Pa]
} SbPercolation;

// Computes the leakage. problem->spectrum is set by sb_spectrum_from_asperities(). SB_ERROR_RANGE:
// modulus, viscosity or width is not positive, or the contact pressure is negative.
SbStatus sb_percolation_solve(SbPercolation *out, const SbPercolationProblem *problem,
                              SbReport *report);

// Returns the contact pressure [Pa] above which no channel is open, for the modulus E' [Pa].
double sb_percolation_closing_pressure(const SbSpectrum *spectrum, double modulus);
