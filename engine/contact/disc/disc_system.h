// Linear system of the disc for given contact edges, and the singularity of the pressure at the
// edges. Private to engine/contact/disc.
//
// Dimensionless: lengths divided by the disc's radius, pressures times C (disc_kernel.h). Angles
// and vectors are those of disc_kernel.h: the bore is at the top. The contact with the bore, xi =
// sin theta in [left, right], is mapped to tau in [-1, 1]. The unknowns are F_j at Chebyshev
// points, excess pressure = F/(h sqrt(1 - tau^2)) with h the half-width. If there is fluid on the
// left, a known smooth step from its pressure p at the left edge to 0 at the right edge is added.
// The groove wall is at the right end of the horizontal diameter, symmetric to it. It has its own F
// over xi in [-wall, wall], the sine of the angle from that end, and its depth of flattening is an
// unknown.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/disc/disc_kernel.h"
#include "engine/contact/fit.h"

// Capacities.
enum {
  SB_DISC_POINTS_MAX = 48, // Chebyshev points of a contact
  SB_DISC_GAUSS = 20,      // Gauss points of an arc
  SB_DISC_ROWS_MAX = 2 * SB_DISC_POINTS_MAX + 1,
};

// The system. The caller sets the fields of the problem and calls sb_disc_system_points(), in any
// order; both may be repeated between solves.
typedef struct {
  // Problem.
  SbDiscKernel kernel;
  bool radial;        // contact forces are radial; else vertical
  double half_space;  // g/(2 R), g the distance of the flats
  double pressure;    // p C of the fluid on the left, >= 0; > 0: the disc is at the groove wall
  double hydrostatic; // inward radial displacement that a pressure on both sides causes [R]
  // Quadrature with n points; weights of the logarithm and of the kink, [n][n] by rows.
  size_t n;
  double tau[SB_DISC_POINTS_MAX]; // points in [-1, 1], decreasing
  double log_weight[SB_DISC_POINTS_MAX * SB_DISC_POINTS_MAX];
  double kink_weight[SB_DISC_POINTS_MAX * SB_DISC_POINTS_MAX];
  double gauss_x[SB_DISC_GAUSS]; // points in [0, 1]
  double gauss_w[SB_DISC_GAUSS]; // weights, sum 1
  // Solution for the last edges; the bore's contact is at centre +- half (sines).
  double centre, half;
  double solution[SB_DISC_ROWS_MAX]; // F at tau[] of the bore; with pressure F of the wall, depth
  double series[2][SB_DISC_POINTS_MAX]; // F of bore and wall = sum series[][k] T_k(-tau)
  double matrix[SB_DISC_ROWS_MAX * SB_DISC_ROWS_MAX]; // by columns, work memory
} SbDiscSystem;

// Computes the quadrature with n points (2 to SB_DISC_POINTS_MAX).
void sb_disc_system_points(SbDiscSystem *system, size_t n);

// Solves the system for given sines of the edges; the parameters are those of an SbSystem (root.h),
// `system` is an SbDiscSystem. Without pressure there is one edge: edges[0] is the right one, and
// the left one mirrors it. With pressure there are three: the right edge, the left edge, and the
// edge of the wall's contact (> 0). residual[i] is F at edge i divided by the mean of |F|: 0 for a
// smooth edge. Returns false if the matrix is singular, an edge is outside (-1, 1), or the contacts
// overlap.
SB_CHECKED bool sb_disc_system_solve(double *residual, const double *edges, void *system);

// Direction of a pressure on an arc, always towards the inside: normal to the arc; horizontal,
// towards the vertical axis, per length of arc; the same per vertical projection of the arc.
typedef enum { SB_DISC_NORMAL, SB_DISC_HORIZONTAL, SB_DISC_HEIGHT } SbDiscAction;

// Returns the displacement (C = R = 1) at `to` in the direction m due to unit pressure on the arc
// that begins at the angle `from` and has the signed `length` [rad] (negative: to the left), and on
// its mirror image below the horizontal axis. Cubic grading resolves the logarithm at `from`. Needs
// the kernel and sb_disc_system_points(), but no solution.
double sb_disc_system_arc(const SbDiscSystem *system, SbDiscPoint to, SbDiscVector m, double from,
                          double length, SbDiscAction action);

// Solves the thesis' disc (disc_thesis.c). Called by sb_fit_disc() with a problem that
// sb_fit_solve() has checked, if the squeeze is positive. Reads out->section_diameter_fitted, which
// the caller has set. Errors as for sb_fit_solve().
SbStatus sb_disc_thesis(SbFit *out, const SbFitProblem *in, SbReport *report);

// Returns the smooth step of the known pressure: 1 at tau = -1, 0 at tau = 1.
double sb_disc_system_step(double tau);

// Returns the displacement in +x at the right end of the horizontal diameter for the last solution,
// which must be one without pressure.
double sb_disc_system_bulge(const SbDiscSystem *system);
