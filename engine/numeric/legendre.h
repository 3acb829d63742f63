// Legendre polynomials: quadrature rules and nodes for spectral elements.
#pragma once

// Values P_0 .. P_degree at r in out[0..degree].
void sb_legendre_values(double *out, double r, int degree);

// Gauss rule with n >= 1 points on [-1, 1], increasing; exact to degree 2n - 1.
void sb_legendre_gauss(double *node, double *weight, int n);

// Lobatto nodes: n + 1 >= 2 points on [-1, 1] with both ends, the extrema of P_n.
void sb_legendre_lobatto(double *node, int n);

// Barycentric weights of `count` distinct nodes, for sb_barycentric_basis.
void sb_barycentric_weights(double *weight, const double *node, int count);

// Lagrange polynomials of the nodes at r: basis[i] is 1 at node i and 0 at the others.
void sb_barycentric_basis(double *basis, double r, const double *node, const double *weight,
                          int count);

// Derivatives of the Lagrange polynomials at r (away from or at a node alike), from their Legendre
// values being known: slope[i] = d basis_i / d r, by differentiating the product form.
void sb_barycentric_slope(double *slope, double r, const double *node, const double *weight,
                          int count);
