// Reduced modulus of two elastic bodies in plane-strain contact.
//
//   2/E' = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b        (thesis eq. 5.8)
//
// This is the E' of every model here (film, Hertz, W*, U*); the E* of contact textbooks is E'/2.
#pragma once

// Returns E' [Pa] of bodies a and b with Young's moduli [Pa] and Poisson's ratios [-]. A modulus
// that is zero or infinite stands for a rigid body; with both rigid the result is infinite.
double sb_reduced_modulus(double modulus_a, double poisson_a, double modulus_b, double poisson_b);
