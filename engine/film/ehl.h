// Inside of the coupled film solver (private to engine/film): a solution, which is a case on a mesh
// with its state, Newton's method, continuation, and the results of a solution.
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
// Smooth: Reynolds' equation collocated at Gauss points; the end of the film is a
// node of the mesh, the axis moves. Few unknowns, eight digits.
//
// Rough: the film's end may lie anywhere between the asperities that carry the
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
#include "engine/film/ehl_mesh.h"
#include "engine/film/scale.h"

#include <math.h>

// Scaled gaps below this are closed for all that double precision tells.
#define SB_EHL_CLOSED 1e-11

// How the film ends.
typedef enum {
  SB_EHL_RUPTURE, // breaks at the end of the mesh, p = 0 and p' = 0 there
  SB_EHL_FULL,    // flooded outlet under pressure
  SB_EHL_REFORM   // breaks, and forms again at `reform` before the flooded outlet
} SbEhlEnd;

// The layers of a film, scaled, and what else fixes a mesh.
typedef struct {
  double lambda;
  double inlet, outlet; // end pressures over the rupture pressure, scaled
  double starvation;    // flux over the flooded flux, 1 when flooded
  double meniscus;      // where the film begins; -infinity when flooded
  double reform;        // where it forms again
  double moved;         // a flooded outlet's layer from where it is expected, in its widths
  SbEhlEnd end;
  int degree;
  // Of a fitted body (scale.h), zero on a half-plane: middle of the contact, rest of its dry
  // pressure.
  double middle;
  double bow[SB_COMPLIANCE_PRESSURES];
} SbEhlLayers;

// Unknowns on a mesh, scaled: nodal pressures, H0, shift c of the axis, flux film.
typedef struct {
  double nodal[SB_EHL_DOFS_MAX];  // pressure q
  double gap[SB_EHL_TARGETS_MAX]; // at all targets, of smooth rows
  double H0, shift, flux;         // flux: of smooth rows
  // Rough rows, at the nodes:
  double t[SB_EHL_DOFS_MAX]; // parameter of the gap
  double s[SB_EHL_DOFS_MAX]; // slope of the film pressure
  bool cavity[SB_EHL_DOFS_MAX];
  double given[SB_EHL_DOFS_MAX]; // film pressure where sealed
  double flow;                   // kappa
} SbEhlState;

// Ends of a film between asperities: its inlet's, the least film, the rupture, and where fluid from
// the outlet meets it.
enum {
  SB_EHL_FRONT_INLET,
  SB_EHL_FRONT_LEAST,
  SB_EHL_FRONT_RUPTURE,
  SB_EHL_FRONT_OUTLET,
  SB_EHL_FRONTS
};

// Asperities and adhesion of a case.
typedef struct {
  bool rows;             // rough rows; all else is unused without
  const SbRoughLaw *law; // NULL: smooth
  double film;           // scale of the law's gap [m]
  double pressure;       // scale of the law's pressure [Pa]
  double smooth_gap;     // unit of t without a law, scaled
  double hamaker;        // A_H [J]; 0 = off
  bool sealed;        // no flow: film pressure as given, that of the ends at rest; cavity all over
  bool coarse;        // elements that grow faster: the others have no room for two levels
  double flux, inlet; // guesses of the flux film and of where the film's pressure begins, scaled
  struct {
    double X, width; // of the layers at the film's ends, scaled; X infinite: none
  } front[SB_EHL_FRONTS];
} SbEhlRough;

// The scaled problem in the flow frame.
typedef struct {
  SbFilmBody body;
  SbEhlLayers layers;
  double supply; // flux film of a starved inlet, scaled; infinite when flooded
  SbFilmFluid fluid;
  SbEhlRough rough;
} SbEhlCase;

// A case with its mesh and state.
typedef struct {
  SbFilmSolver *solver; // its work memory
  SbEhlCase c;
  SbEhlMesh mesh;
  SbEhlState state;
} SbEhlSolution;

// Everything at a node of rough rows, scaled.
typedef struct {
  double h, h_t;   // gap and its slope to t
  double solid;    // p_a - p_v
  double solid_t;  // slope to t
  double asperity; // p_a
  double share;    // real area
  // Of a Newton step:
  double p;                    // film pressure
  double k, r;                 // dp = dq + k dh; r: what the linear elastic equation lacks
  double s0, s_h, s_p, s_flow; // ds = s0 + s_h dh + s_p dp + s_flow dkappa
} SbEhlRoughPoint;

// Quantities of a solution, scaled, in the flow frame with x from the axis.
typedef struct {
  double film_min, film_central, film_flux;
  double position_min, position_rupture;
  double pressure_max, pressure_min;
  // Integrals of (1 - share)/H, times Eyring's factor when set, of (1 - share) H/2 dP/dX, and of
  // theta/H over the cavity.
  double couette, poiseuille, cavity;
  double real_area, asperity_load, central_share;
  double solid_load; // integral of p_a - p_v
  double area_error; // of the real area where the share reaches its limit of 1 between two nodes
  double load_error, flux_error;
  bool ruptured;
} SbEhlResults;

// A film marched against the flow over samples of a mesh (ehl_rough_start.c).
enum { SB_EHL_PARTS = 4, SB_EHL_SAMPLES_MAX = SB_EHL_PARTS * SB_EHL_DOFS_MAX };
typedef struct {
  int count;
  double flow;                       // kappa
  double x[SB_EHL_SAMPLES_MAX];      // places
  double offset[SB_EHL_SAMPLES_MAX]; // total pressure of the contact less stiffness times gap
  double t[SB_EHL_SAMPLES_MAX];      // parameter of the gap
  double p[SB_EHL_SAMPLES_MAX];      // film pressure
  bool cavity[SB_EHL_SAMPLES_MAX];
} SbEhlMarch;

struct SbFilmSolver {
  SbEhlTables tables;
  SbEhlSolution solution[2];
  SbEhlSolution *now; // the last solution; the other one is the next
  // Work memory.
  // Of Newton's method, row after row, and its factors of this or an earlier step.
  double matrix[SB_EHL_ORDER_MAX * SB_EHL_ORDER_MAX], factors[SB_EHL_ORDER_MAX * SB_EHL_ORDER_MAX];
  double right[SB_EHL_ORDER_MAX];
  int pivot[SB_EHL_ORDER_MAX];
  // At all targets: the gap by the pressure, its derivatives to the shift and to the nodal
  // pressures [targets][dofs] (borrowed), and its change by a step.
  double gaps[SB_EHL_TARGETS_MAX], by_shift[SB_EHL_TARGETS_MAX], change[SB_EHL_TARGETS_MAX];
  const double *by_nodal;
  // [targets][dofs] of a fitted body: the half-plane's and the smooth part.
  double kernel[SB_EHL_TARGETS_MAX * SB_EHL_DOFS_MAX];
  // Of ehl_fitted.c: moments of every nodal basis, the smooth compliance times these, and the
  // body's polynomials at the targets.
  struct {
    double moment[SB_COMPLIANCE_MODES][SB_EHL_DOFS_MAX];
    double smooth[SB_COMPLIANCE_MODES][SB_EHL_DOFS_MAX];
    double value[SB_EHL_TARGETS_MAX][SB_COMPLIANCE_MODES];
  } fitted;
  SbEhlRoughPoint point[SB_EHL_DOFS_MAX]; // rough rows: at the nodes

  // Whom a solve answers to.
  const SbFilmProblem *problem; // its callback
  SbFilmSolverInfo *info;       // account of all calls
  double tolerance;             // scaled residual where Newton's method ends, of smooth rows

  SbEhlMarch march;
  SbRoughLaw law; // of the last surface
  bool law_ready;

  double error[3]; // of the last solution, relative: minimum, centre, flux

  // The last solution as the base of others on its mesh, if it converged (ehl_beside.c).
  struct {
    bool solved, held, ready; // held: as below; ready: with its factors and its kernel as well
    bool in_use;              // a step changes neither of them
    double error_contact;     // of that solution (SbFilmSolverInfo)
    SbEhlCase c;
    SbEhlState state;
    double gap_known[SB_EHL_TARGETS_MAX], load_known;
  } base;

  // The last solution serves for warm starts if it is ready.
  struct {
    bool ready;
    double tolerance; // that it met, relative
  } last;
};

// Readies the memory of a solver: zero, but for the matrices, whose 20 MB no solve takes whole.
void sb_ehl_init(SbFilmSolver *solver);

// The solution that is not the last one.
static inline SbEhlSolution *sb_ehl_other(SbFilmSolver *solver) {
  return &solver->solution[solver->now == &solver->solution[0] ? 1 : 0];
}

// Whether the caller wants to stop.
static inline bool sb_ehl_cancelled(const SbFilmSolver *solver) {
  const SbFilmProblem *p = solver->problem;
  return p->cancelled != NULL && p->cancelled(p->cancelled_data);
}

// Flux film (h where dp/dx = 0) of a flooded contact, scaled, to a few per cent.
double sb_ehl_layers_flux(const SbEhlLayers *layers);

// Width of the inlet layer, about lambda^0.4.
double sb_ehl_layers_width(const SbEhlLayers *layers);

// Length that a thick film lives on, that of the rigid wedge between the end pressures, no shorter
// than the contact; 0 where the film is thin.
double sb_ehl_layers_wedge(const SbEhlLayers *layers);

// Slope factor of the dry pressure at the inlet edge: 1 for Hertz's.
double sb_ehl_layers_inlet_slope(const SbEhlLayers *layers);

// Place of the least film before a flooded outlet, of a thin film; else the edge, 1.
double sb_ehl_layers_outlet(const SbEhlLayers *layers);

// Pressure of the dry contact at X, the end pressures outside it.
double sb_ehl_layers_dry_pressure(const SbEhlLayers *layers, double X);

// Dry gap of Hertz's contact, with the bend that unequal end pressures add outside it.
double sb_ehl_layers_dry_gap(const SbEhlLayers *layers, double X);

// Pressure and film of the joined layers of a thin film at X.
void sb_ehl_layers_shape(double *pressure, double *film, const SbEhlLayers *layers, double flux,
                         double X);

// Builds the mesh of smooth rows. False if it does not fit.
SB_CHECKED bool sb_ehl_layers_mesh(SbEhlSolution *s);

// Starting state of smooth rows on the solution's mesh.
void sb_ehl_layers_guess(SbEhlSolution *s);

// Where the film forms again, by Reynolds' equation on the dry gap.
double sb_ehl_layers_reform(const SbEhlLayers *layers);

// Newton's method; state.gap is a guess of its own.
SbStatus sb_ehl_newton(SbEhlSolution *s);

// The factors of a solution's equations in its state, in the solver.
SbStatus sb_ehl_factor(SbEhlSolution *s);

// A case next to the base's, on its mesh and by its factors, as the solver's last solution; the
// base stays. SB_ERROR_NOT_CONVERGED where it is too far or of another kind.
SbStatus sb_ehl_beside(SbFilmSolver *solver, const SbEhlCase *c, SbFilmPlace place);

// Where Newton's method of smooth rows ends: what the solver asks for, but no residual is smaller
// than the rounding of deflections of size one against the film. A fitted body's have more terms.
static inline double sb_ehl_tolerance(const SbEhlSolution *s) {
  double rounding = s->c.body.compliance != NULL ? 8e-16 : 1.1e-16;
  return fmax(s->solver->tolerance, rounding / s->state.flux);
}

// Kernel of a fitted body into solver->kernel ([targets][dofs]), and into solver->gaps the gap at
// all targets without the half-plane's deflection; into solver->by_shift its derivatives to the
// shift.
void sb_ehl_fitted(const SbEhlSolution *s);

// Load above the ambient step less its target pi/2.
double sb_ehl_load(const SbEhlSolution *s);

// Carries a solution to another mesh: along with the elements where these are the same in other
// degrees or moved with the layers, else by place. The film is multiplied by `scale`.
void sb_ehl_carry(SbEhlSolution *to, const SbEhlSolution *from, double scale);

// Results of a solution.
void sb_ehl_results(SbEhlResults *out, const SbEhlSolution *s);

// Relative changes of minimum, centre and flux film from one level of degree to the next, whose
// results are `coarse` and `fine`, the finer one the solver's last solution. If `paired`, the other
// solution is the coarser one: where they share the elements, the first two are then root mean
// squares over the elements about the minimum and about the centre, as single values may agree by
// chance.
void sb_ehl_change(double change[3], SbFilmSolver *solver, const SbEhlResults *fine,
                   const SbEhlResults *coarse, bool paired);

// Film that carries the flux under the slope dP/dX, by Newton's method from `film`; where this is
// used the pressure falls along the flow, or the Poiseuille part is small.
double sb_ehl_flat_film(const SbEhlCase *c, double flux, double film, double pressure,
                        double slope);

// Profile of a solution into `out`, in SI, with the points that the problem asks for.
void sb_ehl_profile(SbFilm *out, const SbFilmProblem *wanted, const SbEhlSolution *s,
                    const SbFilmScale *scale);

// A solution of the case and its degree, from nothing: directly, or by continuation from an easier
// case, with the cavity or the meniscus that the case needs; `supply` is the flux film supplied.
SbStatus sb_ehl_start(SbFilmSolver *solver, const SbEhlCase *c, double supply);

// The last solution on another degree; SB_ERROR_RANGE if rough rows have no room for its mesh.
SbStatus sb_ehl_refine(SbFilmSolver *solver, int degree);

// Solves a case near the last solution's on the same degree. Anything but SB_OK asks for a cold
// start.
SbStatus sb_ehl_follow(SbFilmSolver *solver, const SbEhlCase *c);

// The problem's rough law in *law, from the solver's storage.
SbStatus sb_ehl_rough_law(const SbRoughLaw **law, SbFilmSolver *solver,
                          const SbFilmProblem *problem, SbReport *report);

// Share of the pressing load that asperities carry: A/(A + F). Force balance of the contact,
// W = F + A - V: net load W, film pressure F, asperities A, adhesion V, all integrals over x in the
// same unit. So F = W - `solid` with `solid` = A - V. Adhesion adds to what presses: the share does
// not exceed 1 where A exceeds W. Where the film's own integral is negative (its cavity pulls) the
// asperities carry all that presses, and the share is 1.
double sb_ehl_asperity_share(double asperity, double solid, double load);

// Asperities and adhesion of the solver's problem into a case that is complete otherwise.
SbStatus sb_ehl_rough_case(SbEhlCase *c, SbFilmSolver *solver, const SbFilmScale *scale,
                           SbReport *report);

// Flux film of a rough case, and where the film's pressure begins, into c->rough.
void sb_ehl_rough_flux(SbEhlCase *c);

// Whether asperities leave no gap in the middle of a contact through which anything flows.
bool sb_ehl_rough_closed(const SbEhlCase *c);

// Starting state of rough rows on the solution's mesh.
void sb_ehl_rough_guess(SbEhlSolution *s);

// Lays out elements by the layers and the roughness and builds the kernel. False if the mesh does
// not fit.
SB_CHECKED bool sb_ehl_rough_mesh(SbEhlSolution *s);

// Where a film takes the load over from the asperities and hands it back, and how sharply, into a
// case's rough.front for its mesh: of a solution, or of the solver's last march. False if nothing
// is sharp enough to need elements of its own.
bool sb_ehl_rough_fronts(SbEhlCase *c, const SbEhlSolution *s);
bool sb_ehl_march_fronts(SbEhlCase *c, const SbEhlMarch *march);

// Marches the film over the contact of a solution, sealed or not, into its solver's memory. False
// if no flow is found that meets both end pressures.
SB_CHECKED bool sb_ehl_march(const SbEhlSolution *s);

// The last march as the state of a solution on any mesh: of the film, or of the contact sealed with
// the film's pressure.
void sb_ehl_march_state(SbEhlSolution *s, bool sealed);

// Gap and solid pressures at t, and the parameter of a gap.
void sb_ehl_rough_point(SbEhlRoughPoint *out, const SbEhlCase *c, double t);
double sb_ehl_rough_of_gap(const SbEhlCase *c, double gap);

// Weights of the slopes at an element's nodes in the rise of the film pressure from its node j to
// the next, or to the root of the slope where the film ends between them; coordinate of that end.
double sb_ehl_rough_weights(double *weight, const SbEhlSolution *s, const SbEhlElement *e, int j);

// The whole solve.
SbStatus sb_ehl_solve(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                      SbFilmSolver *solver, SbReport *report);
