// Inside the disc: the linear system for given contact edges, and how far it is from smooth edges.
//
// Dimensionless: lengths in the disc's radius, pressures times C. Over the contact xi = sin theta
// of [left, right] is mapped to tau in [-1, 1]. The unknowns are F_j at Chebyshev points, excess
// pressure = F/(h sqrt(1 - tau^2)) with h the half-width; where fluid stands on the left, a known
// smooth step from its pressure p at the left edge to 0 at the right is added. The groove wall
// on the right has its own F over [-wall, wall] and the unknown depth to which it flattens the
// disc.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/disc/disc_kernel.h"
#include "engine/contact/fit.h"

enum {
  SB_DISC_POINTS_MAX = 48, // Chebyshev points over a contact, at most
  SB_DISC_GAUSS = 20,
  SB_DISC_ROWS_MAX = 2 * SB_DISC_POINTS_MAX + 1,
};

typedef struct {
  // Problem.
  SbDiscKernel kernel;
  bool radial;
  double half_space;  // g/(2 R)
  double pressure;    // fluid on the left, p C; the wall is there if it is not 0
  double hydrostatic; // inward radial displacement by the pressure that is on both sides
  // Rule with n points; weights of the logarithm and of the kink, n x n by rows.
  size_t n;
  double tau[SB_DISC_POINTS_MAX]; // on [-1, 1]
  double log_weight[SB_DISC_POINTS_MAX * SB_DISC_POINTS_MAX];
  double kink_weight[SB_DISC_POINTS_MAX * SB_DISC_POINTS_MAX];
  double gauss_x[SB_DISC_GAUSS]; // on [0, 1]
  double gauss_w[SB_DISC_GAUSS]; // their sum is 1
  // Solution for the last edges, the bore's contact at centre +- half, sines: n bore values, n wall
  // values, depth of the wall.
  double centre, half;
  double solution[SB_DISC_ROWS_MAX];
  double series[2][SB_DISC_POINTS_MAX]; // F of bore and wall = sum series[][k] T_k(-tau)
  double matrix[SB_DISC_ROWS_MAX * SB_DISC_ROWS_MAX]; // by columns
} SbDiscSystem;

// Prepares the rule with n points (2 to SB_DISC_POINTS_MAX).
void sb_disc_system_points(SbDiscSystem *system, size_t n);

// Solves `system` for given sines of the edges: the right one and, under pressure, the left one and
// the wall's; without it the left one mirrors the right one. False if the matrix is singular or the
// edges leave (-1, 1). residual: F at the same edges over the mean of |F|; zero when all are
// smooth.
SB_CHECKED bool sb_disc_system_solve(double *residual, const double *edges, void *system);

// How pressure acts on an arc: normal to it, horizontally on the arc, horizontally on its height.
typedef enum { SB_DISC_NORMAL, SB_DISC_HORIZONTAL, SB_DISC_HEIGHT } SbDiscAction;

// Displacement at `to` along m by unit pressure on the arc of a length (negative: to the left) from
// an angle on and on its mirror image below. At the arc's beginning the logarithm is met by cubic
// grading.
double sb_disc_system_arc(const SbDiscSystem *system, SbDiscPoint to, SbDiscVector m, double from,
                          double length, SbDiscAction action);

// The thesis' own disc (disc_thesis.c), checked and in contact.
SbStatus sb_disc_thesis(SbFit *out, const SbFitProblem *in, SbReport *report);

// The smooth step of the known part, 1 at tau = -1 and 0 at 1.
double sb_disc_system_step(double tau);

// Outward displacement (x) at the right end of the horizontal diameter for the last solution.
double sb_disc_system_bulge(const SbDiscSystem *system);
