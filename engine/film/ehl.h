// Coupled elastohydrodynamic film solver. Private to engine/film: cases, meshes, states, Newton's
// method, continuation and results.
//
// One problem, with or without asperities and adhesion: the pressure q on a half-plane or a fitted
// body, in the flow frame and scaled as in scale.h,
//
//   q = p + p_a(h) - p_v(h)           p film, p_a asperities, p_v van der Waals attraction
//   h = H0 + X^2/2 - (1/pi) integral q ln|X - X'| dX'      (ehl_fitted.c adds a fitted body's part)
//   h^3 m p' = lambda h - kappa       in the full film; kappa/lambda is the flux film
//   integral (q - ambient) dX = pi/2
//
// on spectral elements (ehl_mesh.h), with two sets of equations ("rows"):
//
// Smooth rows: Reynolds' equation is collocated at Gauss points. The end of the film is a node of
// the mesh, and the axis moves. Few unknowns, eight digits.
//
// Rough rows: the film may end anywhere between asperities. Reynolds' equation is integrated from
// node to node (Lobatto IIIA collocation). Each node is in the full film or in the cavity by
// complementarity: p >= 0; in the cavity q = p_a - p_v. The step into the cavity ends where the
// film ends, so rupture is not tied to nodes. h and p_a are functions of the parameter t of the
// rough law; t and the slope s = p' are iterated in addition to q. On a smooth case these rows cost
// three to ten times as much and leave 1e-6 of the minimum film near the rupture.
//
// Films, pressures and positions of this header are scaled, in the flow frame, and pressures are
// relative to the rupture pressure unless stated otherwise. Positions X have their origin at the
// middle of the window |X| < 1 of the mesh; the axis is at X = -shift.
//
// Sequence for a solution `s`: set s->solver and s->c; for rough rows complete s->c with
// sb_ehl_rough_case(). Build the mesh (sb_ehl_layers_mesh() or sb_ehl_rough_mesh()), then set the
// initial guess (sb_ehl_layers_guess(), sb_ehl_rough_guess() or sb_ehl_carry()), then call
// sb_ehl_newton(), then sb_ehl_results(). sb_ehl_start(), sb_ehl_refine(), sb_ehl_follow() and
// sb_ehl_from_base() do this for a complete case (all fields of SbEhlCase set, for rough rows by
// sb_ehl_rough_case()), except the results; the solver's `problem`, `info` and `tolerance` must be
// set before. sb_ehl_solve() sets these itself.
//
// A solver is used by one thread at a time. Functions without an SbReport report errors by their
// status only.
#pragma once

#include "engine/contact/rough/rough_law.h"
#include "engine/film/ehl_mesh.h"
#include "engine/film/scale.h"

#include <math.h>

// Scaled gaps below this are not distinguishable from 0 in double precision.
#define SB_EHL_CLOSED 1e-11

// How the film ends at the outlet.
typedef enum {
  SB_EHL_RUPTURE, // cavitates at the end of the mesh, p = 0 and p' = 0 there
  SB_EHL_FULL,    // flooded outlet under pressure, no cavity
  SB_EHL_REFORM   // cavitates, and re-forms at `reform` before the flooded outlet
} SbEhlEnd;

// Boundary layers of a film, scaled, and the other properties that determine a mesh.
typedef struct {
  double lambda;
  double inlet, outlet; // end pressures minus the rupture pressure, scaled
  double starvation;    // flux divided by the flooded flux, 1 if flooded
  double meniscus;      // X at which the film begins; -infinity if flooded
  double reform;        // X at which the film re-forms; only with SB_EHL_REFORM
  double moved;         // shift of a flooded outlet's layer from its estimate, divided by its width
  SbEhlEnd end;
  int degree; // polynomial degree of the elements
  // Fitted body (scale.h), 0 on a half-plane: middle of the contact, deviation of the dry pressure.
  double middle;
  double bow[SB_COMPLIANCE_PRESSURES];
} SbEhlLayers;

// Unknowns on a mesh, scaled.
typedef struct {
  double nodal[SB_EHL_DOFS_MAX];  // pressure q
  double gap[SB_EHL_TARGETS_MAX]; // h at all targets (smooth rows)
  double H0;                      // constant of the gap, H0 in the equation of h
  double shift;                   // x from the axis = X + shift
  double flux;                    // flux film (smooth rows)
  // Rough rows, at the nodes:
  double t[SB_EHL_DOFS_MAX];     // parameter t of the rough law, which gives the gap
  double s[SB_EHL_DOFS_MAX];     // slope of the film pressure
  bool cavity[SB_EHL_DOFS_MAX];  // the node is cavitated
  double given[SB_EHL_DOFS_MAX]; // prescribed film pressure of a sealed contact
  double flow;                   // kappa of the equation of h^3 m p' (rough rows)
} SbEhlState;

// Positions in a rough film that may need small elements: inlet, minimum film, rupture, and
// re-formation at the outlet.
enum {
  SB_EHL_FRONT_INLET,
  SB_EHL_FRONT_LEAST,
  SB_EHL_FRONT_RUPTURE,
  SB_EHL_FRONT_OUTLET,
  SB_EHL_FRONTS
};

// Asperities and adhesion of a case; lengths and pressures scaled.
typedef struct {
  bool rows;             // rough rows are used; if false, the other fields are not used
  const SbRoughLaw *law; // borrowed; NULL: smooth
  double film;           // unit of the law's gap [m]
  double pressure;       // unit of the law's pressure [Pa]
  double smooth_gap;     // scale of the gap as a function of t without a law
  double split;          // s of the roughness: 1 all on the wall, -1 all on the seal
  double hamaker;        // A_H [J]; 0: off
  bool sealed;        // no flow: prescribed film pressure of the dry contact, all nodes cavitated
  bool cautious;      // Newton's method keeps the cavity after a shortened step
  bool coarse;        // larger elements, so that two levels fit into the mesh
  bool least;         // small elements about the minimum film
  double flux, inlet; // estimates: flux film; X at which the film pressure begins
  struct {
    double X, width; // position and width of a layer; X infinite: none
  } front[SB_EHL_FRONTS];
} SbEhlRough;

// The scaled problem in the flow frame.
typedef struct {
  SbFilmBody body;
  SbEhlLayers layers;
  double supply; // flux film of a starved inlet; infinite: flooded
  SbFilmFluid fluid;
  SbEhlRough rough;
} SbEhlCase;

// A case with its mesh and state. `dofs` and `targets` of arrays are s->mesh.dofs and targets.
typedef struct {
  SbFilmSolver *solver; // the solver that contains it, with its work memory
  SbEhlCase c;
  SbEhlMesh mesh;
  SbEhlState state;
} SbEhlSolution;

// Quantities at a node of rough rows, scaled.
typedef struct {
  double h, h_t;   // gap; its derivative dh/dt
  double solid;    // p_a - p_v
  double solid_t;  // d solid/dt
  double asperity; // p_a
  double share;    // fraction of real contact area
  double share_t;  // d share/dt
  double flow;     // pressure flow factor phi_p > 0
  double flow_h;   // d flow/dh >= 0
  double drag;     // what the wall drags along, h + s psi; its flow is lambda drag
  double drag_h;   // d drag/dh
  // Coefficients of a Newton step:
  double p;                    // film pressure
  double k, r;                 // dp = dq + k dh; r: residual of the linearised elastic equation
  double s0, s_h, s_p, s_flow; // ds = s0 + s_h dh + s_p dp + s_flow dkappa
} SbEhlRoughPoint;

// Results of a solution, scaled, in the flow frame with x from the axis.
typedef struct {
  double film_min, film_central, film_flux;
  double position_min, position_rupture;
  double pressure_max, pressure_min;
  // Integrals of (1 - share)/H (times Eyring's factor), of (1 - share) H/2 dP/dX, and of theta/H
  // over the cavity (theta: fraction filled with liquid).
  double couette, poiseuille, cavity;
  double real_area, asperity_load, central_share; // integrals of share and p_a; share at the axis
  double solid_load;                              // integral of p_a - p_v
  // load_error: residual of the load divided by pi/2. flux_error of smooth rows: the largest error
  // of the flux film divided by the larger one of gap and film_flux; of rough rows: the largest
  // residual of the film pressure's increase from node to node in the full film.
  double load_error, flux_error;
  // Relative changes due to the rounding of the deflections (rough rows): the larger one of
  // film_min and film_central; the sum of those of real_area and asperity_load.
  double film_rounding, contact_rounding;
  bool ruptured;
} SbEhlResults;

// Samples per node, and capacity, of a march.
enum { SB_EHL_PARTS = 4, SB_EHL_SAMPLES_MAX = SB_EHL_PARTS * SB_EHL_DOFS_MAX };

// A rough film, found by integrating Reynolds' equation from the outlet to the inlet over samples
// of a mesh (ehl_rough_start.c), scaled.
typedef struct {
  int count;                         // samples
  double flow;                       // kappa
  double x[SB_EHL_SAMPLES_MAX];      // positions, increasing
  double offset[SB_EHL_SAMPLES_MAX]; // q of the solution minus a constant stiffness times its gap
  double t[SB_EHL_SAMPLES_MAX];      // parameter of the gap
  double p[SB_EHL_SAMPLES_MAX];      // film pressure
  bool cavity[SB_EHL_SAMPLES_MAX];   // the sample is cavitated
} SbEhlMarch;

// The solver (SbFilmSolver of film.h): two solutions, and work memory.
struct SbFilmSolver {
  SbEhlTables tables;
  SbEhlSolution solution[2];
  SbEhlSolution *now; // the last solution; the other one is for the next
  // Newton's method: the Jacobian by rows, and the factors of this or an earlier step.
  double matrix[SB_EHL_ORDER_MAX * SB_EHL_ORDER_MAX], factors[SB_EHL_ORDER_MAX * SB_EHL_ORDER_MAX];
  double right[SB_EHL_ORDER_MAX];
  int pivot[SB_EHL_ORDER_MAX];
  // At all targets: gap, its derivative with respect to `shift`, its change by a Newton step.
  double gaps[SB_EHL_TARGETS_MAX], by_shift[SB_EHL_TARGETS_MAX], change[SB_EHL_TARGETS_MAX];
  const double *by_nodal; // [targets][dofs] derivative of the gap with respect to `nodal`, borrowed
  // [targets][dofs] kernel of a fitted body: half-plane and smooth part.
  double kernel[SB_EHL_TARGETS_MAX * SB_EHL_DOFS_MAX];
  // ehl_fitted.c: moments of the nodal basis functions, the smooth compliance times these, and the
  // polynomials of the body at the targets.
  struct {
    double moment[SB_COMPLIANCE_MODES][SB_EHL_DOFS_MAX];
    double smooth[SB_COMPLIANCE_MODES][SB_EHL_DOFS_MAX];
    double value[SB_EHL_TARGETS_MAX][SB_COMPLIANCE_MODES];
  } fitted;
  SbEhlRoughPoint point[SB_EHL_DOFS_MAX]; // rough rows: at the nodes

  // Of the present solve:
  const SbFilmProblem *problem; // borrowed, for its callback
  SbFilmSolverInfo *info;       // borrowed, counters of all calls
  double tolerance;             // scaled residual at which Newton's method ends (smooth rows)

  SbEhlMarch march;
  SbRoughLaw law; // of the last surface
  bool law_ready; // `law` is valid

  double error[3]; // relative errors of the last solution: minimum, central, flux film

  // The last converged solution as the base of SB_FILM_NEAR and SB_FILM_BESIDE (ehl_beside.c).
  struct {
    bool solved;          // there is a base
    bool held;            // the base is stored in the fields below
    bool ready;           // factors and kernel of the base are in the solver
    bool in_use;          // factors and kernel must not be overwritten
    double error_contact; // SbFilmSolverInfo.error_contact of that solution
    SbEhlCase c;
    SbEhlState state;
    double gap_known[SB_EHL_TARGETS_MAX], load_known; // of SbEhlMesh
  } base;

  // Whether the last solution may be used for a warm start, and the relative tolerance that it met.
  struct {
    bool ready;
    double tolerance;
  } last;
};

// Initialises a solver: tables, `now`, and each solution's `solver` and mesh.tables are set, all
// else is zero. Matrices, and elements and operators of the meshes, are left uninitialised.
void sb_ehl_init(SbFilmSolver *solver);

// Returns the solution that is not the last one.
static inline SbEhlSolution *sb_ehl_other(SbFilmSolver *solver) {
  return &solver->solution[solver->now == &solver->solution[0] ? 1 : 0];
}

// Returns whether the caller's callback requests to stop.
static inline bool sb_ehl_cancelled(const SbFilmSolver *solver) {
  const SbFilmProblem *p = solver->problem;
  return p->cancelled != NULL && p->cancelled(p->cancelled_data);
}

// Returns an estimate of the scaled flux film (h where dp/dx = 0) of a flooded contact, to a few
// per cent.
double sb_ehl_layers_flux(const SbEhlLayers *layers);

// Returns the scaled width of the inlet layer, about lambda^0.4.
double sb_ehl_layers_width(const SbEhlLayers *layers);

// Returns the scaled width of the outlet layer: that of the inlet, or less where the dry pressure
// has the larger slope at the outlet.
double sb_ehl_layers_outlet_width(const SbEhlLayers *layers);

// Returns the slope factor of the dry pressure at the inlet edge; 1 for Hertz's.
double sb_ehl_layers_inlet_slope(const SbEhlLayers *layers);

// Returns the X of the minimum film before a flooded outlet if the film is thin; else 1, the edge
// of the contact.
double sb_ehl_layers_outlet(const SbEhlLayers *layers);

// Returns the dry contact pressure at X, and the end pressures outside the contact.
double sb_ehl_layers_dry_pressure(const SbEhlLayers *layers, double X);

// Returns the dry gap at X, including the bending by unequal end pressures outside the contact; at
// least 0.
double sb_ehl_layers_dry_gap(const SbEhlLayers *layers, double X);

// Writes pressure and film at X by the matched layers of a thin film with the flux film `flux`.
void sb_ehl_layers_shape(double *pressure, double *film, const SbEhlLayers *layers, double flux,
                         double X);

// Builds s->mesh with smooth rows for s->c. Returns false if it does not fit into the arrays.
SB_CHECKED bool sb_ehl_layers_mesh(SbEhlSolution *s);

// Sets the initial guess of smooth rows on the mesh of `s`.
void sb_ehl_layers_guess(SbEhlSolution *s);

// Returns the X at which the film re-forms, by Reynolds' equation on the dry gap. Requires
// layers->outlet > 0.
double sb_ehl_layers_reform(const SbEhlLayers *layers);

// Solves for s->state by Newton's method. The present state is the initial guess; its `gap` need
// not be the deflection by its pressures. SB_ERROR_NOT_CONVERGED, SB_ERROR_CANCELLED.
SbStatus sb_ehl_newton(SbEhlSolution *s);

// Factorises the Jacobian at the state of `s` into the solver's `factors`. SB_ERROR_NOT_CONVERGED:
// singular.
SbStatus sb_ehl_factor(SbEhlSolution *s);

// Solves the complete case `c` on the mesh of the base (base.solved must be true) as the solver's
// last solution; the base is not changed. `place`: SB_FILM_NEAR or SB_FILM_BESIDE; only rough rows
// with SB_FILM_NEAR compute their own factors, all others use those of the base.
// SB_ERROR_NOT_CONVERGED: the cases differ too much or in kind. SB_ERROR_CANCELLED.
SbStatus sb_ehl_from_base(SbFilmSolver *solver, const SbEhlCase *c, SbFilmPlace place);

// Returns the residual at which Newton's method of smooth rows ends: solver->tolerance, but not
// below the rounding error of the deflection divided by the film.
static inline double sb_ehl_tolerance(const SbEhlSolution *s) {
  double rounding = s->c.body.compliance != NULL ? 8e-16 : 1.1e-16;
  return fmax(s->solver->tolerance, rounding / s->state.flux);
}

// Computes for a fitted body solver->kernel [targets][dofs], solver->gaps (the gap at all targets
// without the half-plane's deflection) and solver->by_shift (its derivative with respect to the
// shift).
void sb_ehl_fitted(const SbEhlSolution *s);

// Returns the residual of the load: integral (q - ambient) dX - pi/2.
double sb_ehl_load(const SbEhlSolution *s);

// Writes to to->state the state of `from`, interpolated on the mesh of `to`, both in one solver: by
// element if both meshes have the same sequence of elements, else by position. The film is
// multiplied by `scale`.
void sb_ehl_carry(SbEhlSolution *to, const SbEhlSolution *from, double scale);

// Computes the results of a solution.
void sb_ehl_results(SbEhlResults *out, const SbEhlSolution *s);

// Writes the relative changes of minimum, central and flux film between two levels of degree, whose
// results are `coarse` and `fine`. `fine` has the results of solver->now. With `paired`, `coarse`
// has those of sb_ehl_other(solver); if both solutions have the same elements, the first two
// changes are root mean squares over the elements near the minimum and the centre.
void sb_ehl_change(double change[3], SbFilmSolver *solver, const SbEhlResults *fine,
                   const SbEhlResults *coarse, bool paired);

// Returns the film that transports `flux` at the slope dP/dX = `slope` and the given pressure, by
// Newton's method from `film`; without convergence the last iterate.
double sb_ehl_flat_film(const SbEhlCase *c, double flux, double film, double pressure,
                        double slope);

// Writes the profile of a solution to `out`, which sb_film_begin() has prepared, in SI with gauge
// pressures, in the flow frame, with about wanted->profile_points points (0: as many as accuracy
// requires). Does nothing if wanted->profile is NULL.
void sb_ehl_profile(SbFilm *out, const SbFilmProblem *wanted, const SbEhlSolution *s,
                    const SbFilmScale *scale);

// Cold start: solves `c` with its degree as solver->now, directly or by continuation from an easier
// case. `c` is that of a flooded inlet: c->supply is infinite, c->layers.meniscus -infinity, and
// c->layers.end is SB_EHL_FULL with an outlet pressure above that of rupture, else SB_EHL_RUPTURE.
// The function finds a cavity before a flooded outlet (SB_EHL_REFORM and `reform` of
// solver->now->c) and the meniscus itself. `supply` is the supplied flux film, infinite: flooded.
// SB_ERROR_NOT_CONVERGED; SB_ERROR_CANCELLED; SB_ERROR_INFEASIBLE: a starved inlet together with a
// cavity before a flooded outlet.
SbStatus sb_ehl_start(SbFilmSolver *solver, const SbEhlCase *c, double supply);

// Solves the case of solver->now again with another degree; the result is the new solver->now.
// SB_ERROR_RANGE: the mesh of rough rows does not fit. SB_ERROR_NOT_CONVERGED, SB_ERROR_CANCELLED.
SbStatus sb_ehl_refine(SbFilmSolver *solver, int degree);

// Warm start: solves `c` from the last solution, which must exist (last.ready), with its degree.
// After any error but SB_ERROR_CANCELLED the caller makes a cold start.
SbStatus sb_ehl_follow(SbFilmSolver *solver, const SbEhlCase *c);

// Sets *law to the rough law of the problem's surface: solver->law, borrowed until the next call.
// Its tables are computed only if the surface has changed, and copied from problem->law if possible
// (sb_rough_law_like()). SB_ERROR_RANGE: a parameter of the surface is not positive, or adhering
// tips stretch too far. SB_ERROR_INPUT: SB_ROUGH_NONE, or options that exclude each other.
// SB_ERROR_INFEASIBLE: no surface has this gt_product.
SbStatus sb_ehl_rough_law(const SbRoughLaw **law, SbFilmSolver *solver,
                          const SbFilmProblem *problem, SbReport *report);

// Returns the fraction of the load that asperities carry, A/(A + F). Force balance W = F + A - V
// with net load W = `load`, film pressure F, asperities A = `asperity`, adhesion V (integrals over
// x in one unit), so F = W - `solid`, `solid` = A - V. If the integral F is negative, the fraction
// is 1; if A is 0, it is 0.
double sb_ehl_asperity_share(double asperity, double solid, double load);

// Sets all fields of c->rough for solver->problem, with rough rows and no fronts; all other fields
// of `c` must be set. Errors of sb_ehl_rough_law().
SbStatus sb_ehl_rough_case(SbEhlCase *c, SbFilmSolver *solver, const SbFilmScale *scale,
                           SbReport *report);

// Estimates c->rough.flux and c->rough.inlet from the other fields (done by sb_ehl_rough_case()).
void sb_ehl_rough_flux(SbEhlCase *c);

// Returns whether asperities close the gap in the middle of the contact, so that nothing flows.
bool sb_ehl_rough_closed(const SbEhlCase *c);

// Sets the initial guess of rough rows on the mesh of `s`.
void sb_ehl_rough_guess(SbEhlSolution *s);

// Builds the mesh of rough rows for s->c, refined in layers and at the fronts, and its kernel.
// Returns false if it does not fit into the arrays.
SB_CHECKED bool sb_ehl_rough_mesh(SbEhlSolution *s);

// Finds the fronts of the solution `s`, where film and asperities exchange the load, and their
// widths, and writes them to c->rough.front for the next mesh of `c`. Returns false if no front
// needs small elements.
bool sb_ehl_rough_fronts(SbEhlCase *c, const SbEhlSolution *s);

// Does the same as sb_ehl_rough_fronts() for the film of a march.
bool sb_ehl_march_fronts(SbEhlCase *c, const SbEhlMarch *march);

// Integrates the rough film over the contact of a solution of rough rows (sealed or not) into
// s->solver->march. Returns false if no flow satisfies both end pressures.
SB_CHECKED bool sb_ehl_march(const SbEhlSolution *s);

// Sets the state of `s`, on any mesh, from s->solver->march: a flowing film, or with `sealed` a
// contact without flow whose film pressure state.given is that of the march.
void sb_ehl_march_state(SbEhlSolution *s, bool sealed);

// Returns the gap at which Reynolds' equation allows the largest slope of the pressure, for a flow
// lambda `flux` with `flux` > 0, scaled: 3/2 of it without a flow factor, less with one.
double sb_ehl_rough_steepest(const SbEhlCase *c, double flux);

// Sets h, h_t, solid, solid_t, asperity and share at the parameter t; the coefficients of a Newton
// step are not set.
void sb_ehl_rough_point(SbEhlRoughPoint *out, const SbEhlCase *c, double t);

// Returns the parameter t of a scaled gap.
double sb_ehl_rough_of_gap(const SbEhlCase *c, double gap);

// Writes to weight[degree + 1] the weights of the nodal slopes state.s in the increase of film
// pressure from node j of element `e` (of s->mesh) to node j + 1, or to the root of the slope if
// the film ends between the two nodes. The increase in the element coordinate r is to be multiplied
// by dX/dr. Returns the r at which the step ends.
double sb_ehl_rough_weights(double *weight, const SbEhlSolution *s, const SbEhlElement *e, int j);

// Solves the checked `problem` by the coupled solver: continuation or warm start, refinement until
// the tolerance is met, results and error estimates in *out, in the flow frame and without the
// profile. `scale` is that of sb_film_scale(), or of sb_film_scale_fitted() for a fitted body. *out
// must have been prepared by sb_film_begin(). SB_ERROR_RANGE: the film is lost in rounding.
// SB_ERROR_INFEASIBLE: the pressures allow no film. SB_ERROR_NOT_CONVERGED: *out is the best state
// found. SB_ERROR_CANCELLED; errors of sb_ehl_rough_law().
SbStatus sb_ehl_solve(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                      SbFilmSolver *solver, SbReport *report);
