// Legendre polynomials: quadrature rules and nodes for spectral elements; Chebyshev coefficients.
// Arrays hold as many numbers as the comment of each function says; r and the nodes lie in [-1, 1].
#pragma once

// Gauss rule node[n], weight[n] with n >= 1 points, increasing; exact to degree 2n - 1.
void sb_legendre_gauss(double *node, double *weight, int n);

// Lobatto nodes: node[0 .. n], n + 1 >= 2 points with both ends, the extrema of P_n.
void sb_legendre_lobatto(double *node, int n);

// Coefficients of Chebyshev's polynomials T_0 .. T_(n-1) for values at z_i = -cos(pi (i + 1/2)/n).
void sb_chebyshev_coefficients(double *out, const double *value, int n);

// Integrals of T_0 .. T_(n-1) up to z, from 0 for even orders.
void sb_chebyshev_integrals(double *out, double z, int n);

// Barycentric weights of `count` distinct nodes, for sb_barycentric_basis.
void sb_barycentric_weights(double *weight, const double *node, int count);

// Lagrange polynomials of the nodes at r: basis[i] is 1 at node i and 0 at the others.
void sb_barycentric_basis(double *basis, double r, const double *node, const double *weight,
                          int count);

// Derivatives of the Lagrange polynomials at r (away from or at a node alike), from their Legendre
// values being known: slope[i] = d basis_i / d r, by differentiating the product form.
void sb_barycentric_slope(double *slope, double r, const double *node, const double *weight,
                          int count);
