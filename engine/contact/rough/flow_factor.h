// Pressure flow factor of Persson's contact: how much the roughness obstructs a flow through the
// contact, up to the percolation threshold, where the last channel closes.
//
//   flow per width = -S/(12 eta) dp_f/dx,  S = phi_p u^3,  u = mean separation (persson.h)
//
// Distribution of gaps (A. Almqvist, C. Campana, N. Prodanov & B.N.J. Persson, J. Mech. Phys.
// Solids 59 (2011) 2355): when the roughness of wave numbers up to q is seen, the fraction -dA of
// the area loses contact with the gap u_1 = u + (du/dq) A/(dA/dq), scattered by the roughness
// beyond q, of deviation h_r: |u_1 + h_r x| with x standard normal. The distribution is scaled to
// the mean u. Conductance by Bruggeman's effective medium, generalised from n = 2 dimensions,
//
//   1/S = < n/(g^3 + (n - 1) S) > over the open area + A n/((n - 1) S),
//   n = 2 - (2 - 1/(1 - A*)) min(A/A*, 1),
//
// so that S = 0 where the real contact A reaches the threshold A* (0.42 for isotropic Gaussian
// surfaces: W.B. Dapp, A. Luecke, B.N.J. Persson & M.H. Mueser, Phys. Rev. Lett. 108 (2012)
// 244301), and phi_p = 1 - (3/2) (sigma/u)^2 for thick films (J.H. Tripp, J. Lubr. Technol. 105
// (1983) 458). From u = 1.4 to 2.2 sigma it changes into the value of the undeformed Gaussian
// surface.
//
// Validity: direct computations on small cells (4 roll-off waves) confirm u within 7 % up to 0.75
// of the closing pressure; phi_p is up to 1.8 times too large below 0.22 of it, and more above,
// where these cells scatter as much. Friction hardly depends on this: a phi_p five times smaller
// changes it by 5 %. The average over x takes 16 nodes of Gauss and Hermite, as the figures of
// reference do (docs/physics.md), and this is part of the law: with many nodes phi_p differs by up
// to 4 % below 0.4 of the closing pressure, and is 28 to 40 % smaller from 0.5 to 0.7 (computed
// once by a separate program).
#pragma once

#include "engine/contact/rough/persson.h"

// Largest number of pressures of one call.
enum { SB_FLOW_PRESSURES = 256 };

// Writes phi_p to phi[count] at the pressures of the solids exp(log_p) E* (log_p[count], in any
// order, count <= SB_FLOW_PRESSURES) for the percolation `threshold` A* (0 < A* < 1). 0 from A* on.
// SB_ERROR_MEMORY is its only error. Any thread.
SbStatus sb_flow_factors(double *phi, const double *log_p, int count, const SbSpectrum *spectrum,
                         double threshold, SbReport *report);
