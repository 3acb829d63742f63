// Legendre quadrature rules and nodes of spectral elements, Chebyshev coefficients, and Lagrange
// interpolation in barycentric form. Coordinates are in [-1, 1]. The functions have no state and
// may be called concurrently. Degrees up to 128 are allowed; the formulas are meant for degrees
// below about 60.
#pragma once

// Writes the Gauss-Legendre rule of n points (1 <= n <= 128) to node[n] and weight[n], in
// increasing order of the nodes. It integrates polynomials of degree 2n - 1 exactly over [-1, 1].
void sb_legendre_gauss(double *node, double *weight, int n);

// Writes the Gauss-Lobatto nodes of degree n (1 <= n <= 128) to node[n + 1], in increasing order:
// -1, the extrema of P_n, 1.
void sb_legendre_lobatto(double *node, int n);

// Writes to out[n] the coefficients c_k of sum_k c_k T_k(z), k < n, that interpolates value[i] at
// z_i = -cos(pi (i + 1/2)/n), i < n. T_k is Chebyshev's polynomial.
void sb_chebyshev_coefficients(double *out, const double *value, int n);

// Writes to out[n] an antiderivative of each Chebyshev polynomial T_0 .. T_(n-1) at z. Its constant
// of integration is arbitrary (0 at z = 0 for even orders): use differences between two z.
void sb_chebyshev_integrals(double *out, double z, int n);

// Writes the barycentric weights of the distinct nodes node[count] to weight[count], scaled by 2^(1
// - count). Input of the two functions below.
void sb_barycentric_weights(double *weight, const double *node, int count);

// Writes to basis[count] the Lagrange polynomials of the nodes at r: basis[i] is 1 at node[i] and 0
// at the other nodes. `weight` is the result of sb_barycentric_weights() for the same nodes.
void sb_barycentric_basis(double *basis, double r, const double *node, const double *weight,
                          int count);

// Writes to slope[count] the derivatives d basis_i/dr of the Lagrange polynomials at r, which may
// be a node. `weight` is the result of sb_barycentric_weights() for the same nodes.
void sb_barycentric_slope(double *slope, double r, const double *node, const double *weight,
                          int count);
