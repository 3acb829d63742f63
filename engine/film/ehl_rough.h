// Inside of the mixed-film solver (private to engine/film): film and asperities in one Newton.
//
// The unknown is the total pressure q on the half-plane or a fitted body. At every node
//
//   q = p + p_a(h) - p_v(h)           p film, p_a asperities, p_v van der Waals' pull
//   h = H0 + X^2/2 - (1/pi) integral q ln|X - X'| dX'      (ehl_fitted.c adds a fitted body's own)
//   h^3 m p' = lambda h - kappa       where the film is full; kappa / lambda is the flux film
//   p >= 0, and no more pressure than the flux brings, where it is broken: then q = p_a - p_v
//
// scaled as in scale.h, in the flow frame with X from the middle of the dry contact. h is written
// h(t), p_a(t) with the parameter t of the rough law, and t and the slope s = p' are iterated
// beside q and made consistent by Newton's method itself: everything that it linearises is then
// gentle from a film ten times the roughness to full contact. Elements are polynomials on Lobatto
// nodes; Reynolds' equation is integrated from node to node (collocation of Lobatto IIIA's kind);
// each node is in the full film or in the cavity by complementarity, and the step into the cavity
// ends where the film ends, so that the rupture is not tied to nodes.
#pragma once

#include "engine/film/ehl_layers.h"
#include "engine/film/fluid.h"
#include "engine/film/scale.h"
#include "engine/surface/rough_law.h"

enum {
  SB_EHL_ROUGH_DEGREE_MAX = 8,
  SB_EHL_ROUGH_ELEMENTS_MAX = 100,
  SB_EHL_ROUGH_NODES_MAX = 440,
  SB_EHL_ROUGH_DOWN = SB_EHL_ROUGH_DEGREE_MAX + 44, // terms of a downward recurrence
};

// Scaled gaps below this are closed for all that double precision tells.
#define SB_EHL_ROUGH_CLOSED 1e-11

// Tables of one degree on [-1, 1].
typedef struct {
  int degree;
  double node[SB_EHL_ROUGH_DEGREE_MAX + 1];
  double bary[SB_EHL_ROUGH_DEGREE_MAX + 1];
  double project[SB_EHL_ROUGH_DEGREE_MAX + 1]
                [SB_EHL_ROUGH_DEGREE_MAX + 1];                            // [Legendre mode][basis]
  double slope[SB_EHL_ROUGH_DEGREE_MAX + 1][SB_EHL_ROUGH_DEGREE_MAX + 1]; // [node][basis]
  // Integral of a basis function from node j to node j + 1.
  double step[SB_EHL_ROUGH_DEGREE_MAX][SB_EHL_ROUGH_DEGREE_MAX + 1];
  double down[SB_EHL_ROUGH_DOWN][2]; // (2 k + 1) / k and (k + 1) / k
} SbEhlRoughRule;

typedef struct {
  int elements, nodes, degree;
  double edge[SB_EHL_ROUGH_ELEMENTS_MAX + 1];
  double x[SB_EHL_ROUGH_NODES_MAX];
  double inlet, outlet;                 // far pressures
  double shift;                         // X + shift is counted from the axis
  double known[SB_EHL_ROUGH_NODES_MAX]; // undeformed gap and that of the far pressures, tilt as in
                                        // ehl_mesh.c
  double load[SB_EHL_ROUGH_NODES_MAX];  // integral of the basis
  double *kernel;                       // [nodes][nodes] gap of a nodal pressure
} SbEhlRoughMesh;

typedef struct {
  double q[SB_EHL_ROUGH_NODES_MAX]; // total pressure
  double t[SB_EHL_ROUGH_NODES_MAX]; // parameter of the gap
  double s[SB_EHL_ROUGH_NODES_MAX]; // slope of the film pressure
  bool broken[SB_EHL_ROUGH_NODES_MAX];
  double H0, kappa;
} SbEhlRoughState;

// What is solved.
typedef struct {
  SbFilmBody body;
  SbEhlLayers layers; // lambda and end pressures; places the mesh
  double lambda;      // 0 at rest
  double supply;      // kappa of a starved inlet; infinite when flooded
  bool sealed; // at rest without flow: film pressure by sb_ehl_rough_ends(), all nodes broken
  SbFilmFluid fluid;
  const SbRoughLaw *law; // NULL: smooth
  double smooth_gap;     // unit of t without a law
  double film, pressure; // scales of the law
  double hamaker;        // A_H / (6 pi h^3) with h, p scaled; 0 = off
  double cutoff;         // scaled
  double flux, mouth;    // guesses of the flux film and of where the film's pressure begins
  struct {
    double X, width; // of the layers at the film's two mouths; width 0: none
  } front[2];
} SbEhlRoughCase;

// Everything at a node.
typedef struct {
  double h, h_t;   // gap and its slope to t
  double solid;    // p_a - p_v
  double solid_t;  // slope to t
  double asperity; // p_a
  double share;    // real area
} SbEhlRoughPoint;

// Storage of a solver.
typedef struct SbEhlRoughSolver {
  SbEhlRoughRule rule[SB_EHL_ROUGH_DEGREE_MAX + 1];
  SbEhlRoughMesh mesh[2];
  SbEhlRoughState state[2];
  SbEhlRoughState saved[2]; // of a continuation
  SbEhlRoughPoint point[SB_EHL_ROUGH_NODES_MAX];
  double gap[SB_EHL_ROUGH_NODES_MAX];
  double *matrix, *right;
  int *pivot;
  SbRoughLaw law;
  bool law_ready;
} SbEhlRoughSolver;

// A solver's storage, NULL when out of memory; destroy takes NULL.
SbEhlRoughSolver *sb_ehl_rough_create(void);
void sb_ehl_rough_destroy(SbEhlRoughSolver *solver);

// Rule of a degree, made on first use.
const SbEhlRoughRule *sb_ehl_rough_rule(SbEhlRoughSolver *solver, int degree);

// Lays out elements by the layers and the roughness and builds the kernel; `fineness` divides the
// sizes (1 usual). False if the mesh does not fit.
bool sb_ehl_rough_mesh(SbEhlRoughMesh *mesh, const SbEhlRoughRule *rule, const SbEhlRoughCase *c,
                       double fineness);

// Gives a new mesh the body of the case: its undeformed gap and smooth compliance in place of the
// parabola's (ehl_fitted.c).
void sb_ehl_rough_fitted(SbEhlRoughMesh *mesh, const SbEhlRoughRule *rule, const SbEhlRoughCase *c);

// Load above the ambient step that the nodal pressures q make, less its target pi/2.
double sb_ehl_rough_load(const SbEhlRoughMesh *mesh, const double *q);

// Element that holds X, and the coordinate there.
int sb_ehl_rough_locate(const SbEhlRoughMesh *mesh, double X, double *r);

// Value at r of element e of a nodal field.
double sb_ehl_rough_value(const SbEhlRoughMesh *mesh, const SbEhlRoughRule *rule,
                          const double *field, int e, double r);

// End pressures joined as in the dry smooth contact (docs/verification.md), at X.
double sb_ehl_rough_ends(const SbEhlRoughCase *c, double X);

// Gap and solid pressures at t.
void sb_ehl_rough_point(SbEhlRoughPoint *out, const SbEhlRoughCase *c, double t);

// Parameter of a gap.
double sb_ehl_rough_of_gap(const SbEhlRoughCase *c, double gap);

// A cold start, and a start from another mesh's state.
void sb_ehl_rough_guess(SbEhlRoughSolver *solver, int which, const SbEhlRoughCase *c);
void sb_ehl_rough_resample(SbEhlRoughSolver *solver, int from, int to);

// What Newton's method did.
typedef struct {
  int iterations;
  double step; // last relative change of gap and pressure
} SbEhlRoughTrace;

// Newton's method on mesh and state `which`. SB_ERROR_NOT_CONVERGED, SB_ERROR_CANCELLED.
SbStatus sb_ehl_rough_newton(SbEhlRoughTrace *trace, SbEhlRoughSolver *solver, int which,
                             const SbEhlRoughCase *c, const SbFilmProblem *callback);

// Where the film of the sub-interval j of element e ends: the root of the slope, as a coordinate in
// it, or its end.
double sb_ehl_rough_film_end(const SbEhlRoughMesh *mesh, const SbEhlRoughRule *rule,
                             const double *s, int e, int j);

// Integral of a basis function from node j to r.
void sb_ehl_rough_partial(double *weight, const SbEhlRoughRule *rule, int j, double r);

// What is read off a solution, scaled.
typedef struct {
  double film_min, film_central, film_flux, position_min, position_rupture;
  double pressure_max;
  double couette, poiseuille, cavity; // integrals of (1 - share)/h, (1 - share) h p'/2, theta/h
  double real_area, asperity_load, central_share;
  double load_error, flux_error;
  bool ruptured;
} SbEhlRoughResults;

// Reads a converged state.
void sb_ehl_rough_results(SbEhlRoughResults *out, SbEhlRoughSolver *solver, int which,
                          const SbEhlRoughCase *c);

// Where the film takes the load over from the asperities and hands it back, and how sharply, into
// c->front for the next mesh; false if neither is sharp enough to need elements of its own.
bool sb_ehl_rough_fronts(SbEhlRoughCase *c, const SbEhlRoughSolver *solver, int which,
                         const SbEhlRoughResults *reading);

// Profile in SI and the seal's frame.
void sb_ehl_rough_profile(SbFilm *out, SbEhlRoughSolver *solver, int which, const SbEhlRoughCase *c,
                          const SbFilmScale *scale, bool forward);

// The mixed solution of `problem`, speed zero included.
SbStatus sb_ehl_rough_solve(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                            SbEhlRoughSolver *solver, SbReport *report);
