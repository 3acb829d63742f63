// Static leakage through a closed rough contact at rest: percolation and the critical constriction.
//
// Source: B.N.J. Persson & C. Yang, J. Phys.: Condens. Matter 20 (2008) 315011. Looking at the
// contact ever more closely, the real contact A(q)/A0 falls; where it reaches the percolation
// threshold (0.42; Dapp et al., Phys. Rev. Lett. 108 (2012) 244301) the first open channel crosses
// it, through a constriction of lateral size 2 pi/q_c and height u_c. All of the pressure drops
// there, and there is one per square, so that
//
//   Q = (u_c^3/(12 eta)) dp L_y/L_x
//
// for a laminar liquid, L_y round the bore, L_x the contact's width.
//
// A contact that stays above the threshold to the shortest wave does not leak by this mechanism
// (0). The rate is steep near the threshold: `sensitivity` is d ln Q/d ln p there, so that the user
// sees it coming. Leaves out the pressure profile (mean contact pressure is used), two-phase flow,
// diffusion.
#pragma once

#include "engine/contact/rough/persson.h"

#define SB_PERCOLATION_THRESHOLD 0.42

// Gap of the constriction over the roughness beyond which the surfaces no longer touch each other
// (Gaussian heights): an open path, not a contact with channels.
#define SB_PERCOLATION_OPEN_GAP 3.0

typedef struct {
  const SbSpectrum *spectrum;
  double modulus;          // E', 2/E' = sum (1 - nu^2)/E [Pa]
  double contact_pressure; // mean, of the solids (total less the fluid's) [Pa]
  double viscosity;        // [Pa s]
  double pressure_drop;    // [Pa]
  double width;            // of the contact along the flow [m]
  double circumference;    // [m]
} SbPercolationProblem;

typedef struct {
  bool percolates;
  double real_share;       // A/A0 with all roughness
  double constriction_q;   // q_c [1/m], 0 if closed
  double constriction_gap; // u_c [m]
  double leak_rate;        // [m3/s]
  double sensitivity;      // d ln Q/d ln contact pressure, negative; 0 if closed
  double closing_pressure; // contact pressure at which the last channel closes [Pa]
} SbPercolation;

// SB_ERROR_RANGE for a modulus, viscosity, width that is not positive or a pressure below 0.
SbStatus sb_percolation_solve(SbPercolation *out, const SbPercolationProblem *problem,
                              SbReport *report);

// Contact pressure [Pa] at which the last channel closes, for a modulus E' [Pa].
double sb_percolation_closing_pressure(const SbSpectrum *spectrum, double modulus);
