// Inside of the coupled film solver (private to engine/film): the case and the state on a mesh,
// Newton's method, continuation, and the results of a solution.
//
// One problem, with asperities and adhesion or without: q on a half-plane or a fitted body, in the
// flow frame and scaled as in scale.h,
//
//   q = p + p_a(h) - p_v(h)           p film, p_a asperities, p_v van der Waals' pull
//   h = H0 + X^2/2 - (1/pi) integral q ln|X - X'| dX'      (ehl_fitted.c adds a fitted body's own)
//   h^3 m p' = lambda h - kappa       where the film is full; kappa / lambda is the flux film
//   integral (q - ambient) dX = pi/2
//
// on spectral elements (ehl_mesh.h), with two sets of rows:
//
// Smooth (ehl_newton.c): Reynolds' equation collocated at Gauss points; the end of the film is a
// node of the mesh, the axis moves. Few unknowns, eight digits.
//
// Rough (ehl_rough_newton.c): the film's end may lie anywhere between the asperities that carry the
// rest. Reynolds' equation is integrated from node to node (collocation of Lobatto IIIA's kind);
// each node is in the full film or in the cavity by complementarity: p >= 0, and no more pressure
// than the flux brings where it is cavitated; then q = p_a - p_v. The step into the cavity ends
// where the film ends, so that the rupture is not tied to nodes. h is written h(t), p_a(t) with the
// parameter t of the rough law, and t and the slope s = p' are iterated beside q and made
// consistent by Newton's method itself: everything that it linearises is then gentle from a film
// ten times the roughness to full contact. On a smooth case these rows take three to ten times the
// smooth ones' time and leave 1e-6 of the least film beside the rupture's kink.
#pragma once

#include "engine/contact/rough/rough_law.h"
#include "engine/film/ehl_layers.h"
#include "engine/film/ehl_mesh.h"
#include "engine/film/fluid.h"
#include "engine/film/scale.h"

// Scaled gaps below this are closed for all that double precision tells.
#define SB_EHL_CLOSED 1e-11

// Unknowns on a mesh: nodal pressures, H0, shift c of the axis, flux film, and one free end.
typedef struct {
  double nodal[SB_EHL_DOFS_MAX];  // pressure q
  double gap[SB_EHL_TARGETS_MAX]; // at all targets, of smooth rows
  double H0, shift, flux;
  // Rough rows, at the nodes:
  double t[SB_EHL_DOFS_MAX]; // parameter of the gap
  double s[SB_EHL_DOFS_MAX]; // slope of the film pressure
  bool cavity[SB_EHL_DOFS_MAX];
  double flow; // kappa
} SbEhlState;

// Asperities and adhesion of a case, scaled.
typedef struct {
  bool rows;             // rough rows; all else is unused without
  const SbRoughLaw *law; // NULL: smooth
  double film, pressure; // scales of the law
  double smooth_gap;     // unit of t without a law
  double hamaker;        // A_H [J]; 0 = off
  double supply;         // kappa of a starved inlet; infinite when flooded
  bool sealed;        // at rest without flow: film pressure by the end pressures, cavity everywhere
  double flux, inlet; // guesses of the flux film and of where the film's pressure begins
  struct {
    double X, width; // of the layers at the film's two ends; X infinite: none
  } front[2];
} SbEhlRough;

// The scaled problem in the flow frame.
typedef struct {
  SbFilmBody body;
  SbEhlLayers layers;
  bool hold; // a free end stays where it is
  SbFilmFluid fluid;
  SbEhlRough rough;
} SbEhlCase;

// What Newton's method did.
typedef struct {
  int iterations;
  double residual; // largest scaled residual; of rough rows the last relative change
} SbEhlTrace;

// Everything at a node of rough rows.
typedef struct {
  double h, h_t;   // gap and its slope to t
  double solid;    // p_a - p_v
  double solid_t;  // slope to t
  double asperity; // p_a
  double share;    // real area
} SbEhlRoughPoint;

// One Newton step's data at the nodes of rough rows (ehl_rough_newton.c).
typedef struct {
  double p[SB_EHL_DOFS_MAX], k[SB_EHL_DOFS_MAX], r[SB_EHL_DOFS_MAX];
  // ds = s0 + s_h dh + s_p dp + s_kappa dkappa
  double s0[SB_EHL_DOFS_MAX], s_h[SB_EHL_DOFS_MAX], s_p[SB_EHL_DOFS_MAX];
  double s_kappa[SB_EHL_DOFS_MAX];
  double step[SB_EHL_DOFS_MAX]; // p[i+1] - p[i] - integral of s
} SbEhlRoughStep;

// Whom a continuation answers to.
typedef struct {
  double tolerance;             // scaled residual where Newton's method ends, of smooth rows
  SbFilmSolverInfo *info;       // account of all calls
  const SbFilmProblem *problem; // its callback
} SbEhlRun;

// Quantities of a solution, scaled, in the flow frame with x from the axis.
typedef struct {
  double film_min, film_central, film_flux;
  double position_min, position_rupture;
  double pressure_max, pressure_min;
  // Integrals of (1 - share)/H, times Eyring's factor when set, of (1 - share) H/2 dP/dX, and of
  // theta/H over the cavity.
  double couette, poiseuille, cavity;
  double real_area, asperity_load, central_share;
  double area_error; // of the real area where the share reaches its limit of 1 between two nodes
  double load_error, flux_error;
  bool ruptured;
} SbEhlResults;

// Work memory of ehl_fitted.c: moments of every nodal basis, the smooth compliance times these, and
// the body's polynomials at the targets.
typedef struct {
  double moment[SB_COMPLIANCE_MODES][SB_EHL_DOFS_MAX];
  double smooth[SB_COMPLIANCE_MODES][SB_EHL_DOFS_MAX];
  double value[SB_EHL_TARGETS_MAX][SB_COMPLIANCE_MODES];
} SbEhlFittedWork;

enum { SB_EHL_LEVELS_MAX = 6 };

struct SbFilmSolver {
  SbEhlTables tables;
  SbEhlMesh mesh[2]; // the current level and the next
  SbEhlState state[2];
  double matrix[SB_EHL_ORDER_MAX * SB_EHL_ORDER_MAX]; // of Newton's method, row after row
  double right[SB_EHL_ORDER_MAX];
  double column[SB_EHL_ORDER_MAX]; // derivative to the free end
  int pivot[SB_EHL_ORDER_MAX];
  double gaps[2 * SB_EHL_TARGETS_MAX]; // at all targets, and their derivatives to the shift
  // [targets][dofs] of a fitted body: the half-plane's and the smooth part.
  double kernel[SB_EHL_TARGETS_MAX * SB_EHL_DOFS_MAX];
  SbEhlFittedWork fitted;

  // Rough rows: nodes, states of a continuation, and the law of the last surface.
  SbEhlRoughPoint point[SB_EHL_DOFS_MAX];
  SbEhlRoughStep step;
  SbEhlState saved[2];
  SbRoughLaw law;
  bool law_ready;

  // The last solution, for warm starts.
  struct {
    bool ready;
    int which;
    SbEhlCase problem;
    double tolerance; // that it met
    double error[3];  // minimum, centre, flux
  } last;
};

// Readies the memory of a solver; false if LAPACK fails.
SB_CHECKED bool sb_ehl_init(SbFilmSolver *solver);

// Newton's method on mesh/state `which`. `independent`: state.gap is a guess of its own, to be made
// consistent by the first step; otherwise it is computed from the pressure.
SbStatus sb_ehl_newton(SbEhlTrace *trace, SbFilmSolver *solver, int which, SbEhlCase *problem,
                       bool independent, double tolerance, const SbFilmProblem *callback);

// The same with rough rows.
SbStatus sb_ehl_rough_newton(SbEhlTrace *trace, SbFilmSolver *solver, int which, const SbEhlCase *c,
                             const SbFilmProblem *callback);

// Either, with its account.
SbStatus sb_ehl_iterate(SbFilmSolver *solver, int which, SbEhlCase *c, bool independent,
                        const SbEhlRun *run);

// Kernel of a fitted body with the axis at `shift`, into solver->kernel ([targets][dofs]), and the
// gap that it gives at all targets into solver->gaps: the undeformed one and the deflection by the
// nodal pressures, without H0; behind it the derivatives to the shift.
void sb_ehl_fitted(SbFilmSolver *solver, const SbEhlMesh *mesh, const double *nodal, double shift,
                   const SbFilmBody *body);

// Load above the ambient step less its target pi/2.
double sb_ehl_load(const SbEhlMesh *mesh, const SbEhlState *state);

// Carries a solution from mesh/state `from` to `to`: along with the elements where these are the
// same in other degrees or moved with the layers, `before` to `after`, else by place. The film is
// multiplied by `scale`.
void sb_ehl_carry(SbFilmSolver *solver, int from, int to, const SbEhlLayers *before,
                  const SbEhlLayers *after, double scale);

// Results of a solution.
void sb_ehl_results(SbEhlResults *out, SbFilmSolver *solver, int which, const SbEhlCase *problem);

// Relative changes of minimum, centre and flux film from one level of degree to the next, whose
// results are `coarse` and `fine`. If `paired`, mesh and state `which` and the other one hold the
// two on the same elements: the first two are then root mean squares over the elements about the
// minimum and about the centre, as single values may agree by chance.
void sb_ehl_change(double change[3], SbFilmSolver *solver, int which, const SbEhlCase *problem,
                   const SbEhlResults *fine, const SbEhlResults *coarse, bool paired);

// Film that carries the flux under the slope dP/dX, by fixed-point steps from `film`; its
// Poiseuille part is small where this is used.
double sb_ehl_flat_film(const SbEhlCase *c, double flux, double film, double pressure,
                        double slope);

// Profile of a solution into `out`, in SI and in the seal's frame, with the points that `wanted`
// asks for.
void sb_ehl_profile(SbFilm *out, SbFilmSolver *solver, int which, const SbEhlCase *problem,
                    const SbFilmScale *scale, const SbFilmProblem *wanted);

// A solution of the lowest degree in mesh/state *which, from nothing: directly, or by continuation
// from an easier case, with the cavity or the meniscus that the case needs. `problem->layers` is
// completed (end, reform, meniscus, starvation). `flux` is the flux film supplied, infinite when
// flooded. *flooded tells whether the supply was enough.
SbStatus sb_ehl_start(bool *flooded, SbFilmSolver *solver, int *which, SbEhlCase *problem,
                      double flux, const SbEhlRun *run);

// Solves on another degree from the solution in mesh/state *which, moving a free end last. On
// failure the old solution and case stand.
SbStatus sb_ehl_refine(SbFilmSolver *solver, int *which, SbEhlCase *problem, int degree,
                       const SbEhlRun *run);

// Solves a case near the one whose solution is in mesh/state *which, on the same degree. Anything
// but SB_OK asks for a cold start; the old solution stands.
SbStatus sb_ehl_follow(SbFilmSolver *solver, int *which, const SbEhlCase *old,
                       const SbEhlCase *problem, const SbEhlRun *run);

// The problem's rough law in *law, from the solver's storage.
SbStatus sb_ehl_rough_law(const SbRoughLaw **law, SbFilmSolver *solver,
                          const SbFilmProblem *problem, SbReport *report);

// Asperities and adhesion of `problem` into a case that is complete otherwise, and its rough rows.
SbStatus sb_ehl_rough_case(SbEhlCase *c, SbFilmSolver *solver, const SbFilmProblem *problem,
                           const SbFilmScale *scale, SbReport *report);

// All levels of rough rows from a cold start: results of each, their number (0: nothing found), and
// in `run->info` the estimates. A gap too closed to tell a flow at rest is solved sealed.
SbStatus sb_ehl_rough_climb(SbEhlResults *results, int *levels, int *which, SbFilmSolver *solver,
                            SbEhlCase *c, const SbEhlRun *run);

// Lays out elements by the layers and the roughness and builds the kernel, that of a fitted body
// and the undeformed gap included. False if the mesh does not fit.
SB_CHECKED bool sb_ehl_rough_mesh(SbFilmSolver *solver, int which, const SbEhlCase *c, int degree);

// Where the film takes the load over from the asperities and hands it back, and how sharply, into
// c->rough.front for the next mesh; false if neither is sharp enough to need elements of its own.
bool sb_ehl_rough_fronts(SbEhlCase *c, const SbFilmSolver *solver, int which,
                         const SbEhlResults *results);

// Gap and solid pressures at t, and the parameter of a gap.
void sb_ehl_rough_point(SbEhlRoughPoint *out, const SbEhlCase *c, double t);
double sb_ehl_rough_of_gap(const SbEhlCase *c, double gap);

// Where the film of the sub-interval j of an element ends: the root of the slope, `s` at the
// element's nodes, as a coordinate in it, or its end.
double sb_ehl_rough_film_end(const SbEhlTable *rule, const double *s, int j);

// The whole solve.
SbStatus sb_ehl_solve(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                      SbFilmSolver *solver, SbReport *report);
