// Inside of the coupled film solver (private to engine/film): the state on a mesh, Newton's method,
// and what is read off a solution.
#pragma once

#include "engine/film/ehl_layers.h"
#include "engine/film/ehl_mesh.h"
#include "engine/film/fluid.h"
#include "engine/film/scale.h"

// Unknowns on a mesh: nodal pressures, H0, shift c of the axis, flux film, and one free end.
typedef struct {
  double nodal[SB_EHL_DOFS_MAX];
  double gap[SB_EHL_DOFS_MAX + SB_EHL_ELEMENTS_MAX + 4]; // at all targets
  double H0, shift, flux;
} SbEhlState;

// The scaled problem in the flow frame.
typedef struct {
  SbFilmBody body;
  SbEhlLayers layers;
  bool hold; // a free end stays where it is
  SbFilmFluid fluid;
} SbEhlCase;

// What Newton's method did.
typedef struct {
  int iterations;
  double residual; // largest scaled residual
  double step;     // last relative change of the flux film
} SbEhlTrace;

// Quantities of a solution, scaled, in the flow frame with x from the axis.
typedef struct {
  double film_min, film_central, film_flux;
  double position_min, position_rupture;
  double pressure_max, pressure_min;
  double couette;    // integral of dX / H, times Eyring's factor when set
  double poiseuille; // integral of H/2 dP/dX
  double load_error, flux_error;
} SbEhlResults;

struct SbFilmSolver {
  SbEhlTables tables;
  SbEhlMesh mesh[2]; // the current level and the next
  SbEhlState state[2];
  double *matrix; // of Newton's method, row after row
  double *right;
  double *column; // derivative to the free end
  double *gaps;   // at all targets
  double *kernel; // [targets][dofs] of a fitted body: the half-plane's and the smooth part
  int *pivot;
  struct SbEhlRoughSolver *mixed; // film with asperities, NULL until one is asked for (ehl_rough.h)

  // The last solution, for warm starts.
  struct {
    bool ready;
    int which;
    SbEhlCase problem;
    double tolerance; // that it met
    double error[3];  // minimum, centre, flux
  } last;
};

// Storage; false when out of memory.
bool sb_ehl_init(SbFilmSolver *solver);
void sb_ehl_finish(SbFilmSolver *solver);

// Newton's method on mesh/state `which`. `independent`: state.gap is a guess of its own, to be made
// consistent by the first step; otherwise it is computed from the pressure.
SbStatus sb_ehl_newton(SbEhlTrace *trace, SbFilmSolver *solver, int which, SbEhlCase *problem,
                       bool independent, double tolerance, const SbFilmProblem *callback);

// Kernel of a fitted body with the axis at the state's shift, into `kernel` ([targets][dofs]), and
// the gap that it gives at all targets: the undeformed one and the deflection by the state's
// pressure, without H0. `slope` takes the derivatives to the shift.
void sb_ehl_fitted(double *kernel, double *gaps, double *slope, const SbEhlMesh *mesh,
                   const SbEhlState *state, const SbEhlCase *problem);

// Carries a solution from mesh/state `from` to `to`, which has the same elements in other degrees
// or moved with the layers, `before` to `after`. The film is multiplied by `scale`.
void sb_ehl_carry(SbFilmSolver *solver, int from, int to, const SbEhlLayers *before,
                  const SbEhlLayers *after, double scale);

// The same to a mesh of other elements, by place.
void sb_ehl_resample(SbFilmSolver *solver, int from, int to);

// Reads a solution.
void sb_ehl_results(SbEhlResults *out, SbFilmSolver *solver, int which, const SbEhlCase *problem);

// Relative changes of minimum, centre and flux film from one level of degree to the next, whose
// readings are `coarse` and `fine`. If `paired`, mesh and state `which` and the other one hold the
// two on the same elements: the first two are then root mean squares over the elements about the
// minimum and about the centre, as single values may agree by chance.
void sb_ehl_change(double change[3], SbFilmSolver *solver, int which, const SbEhlCase *problem,
                   const SbEhlResults *fine, const SbEhlResults *coarse, bool paired);

// Coordinate r of position X in element e.
double sb_ehl_coordinate(const SbEhlElement *e, double X);

// Profile of a solution into `out`, in SI and in the seal's frame, with the points that `wanted`
// asks for (ehl_profile.c).
void sb_ehl_profile(SbFilm *out, SbFilmSolver *solver, int which, const SbEhlCase *problem,
                    const SbFilmScale *scale, const SbFilmProblem *wanted);

// A solution of the lowest degree in mesh/state *which, from nothing: directly, or by continuation
// from an easier case, with the cavity or the meniscus that the case needs. `problem->layers` is
// completed (end, reform, meniscus, starvation). `flux` is the flux film supplied, infinite when
// flooded. *flooded tells whether the supply was enough.
SbStatus sb_ehl_start(bool *flooded, SbFilmSolver *solver, int *which, SbEhlCase *problem,
                      double flux, double tolerance, SbFilmSolverInfo *info,
                      const SbFilmProblem *callback);

// Solves on another degree from the solution in mesh/state *which, moving a free end last. On
// failure the old solution and case stand.
SbStatus sb_ehl_refine(SbFilmSolver *solver, int *which, SbEhlCase *problem, int degree,
                       double tolerance, SbFilmSolverInfo *info, const SbFilmProblem *callback);

// Solves a case near the one whose solution is in mesh/state *which, on the same degree. Anything
// but SB_OK asks for a cold start; the old solution stands.
SbStatus sb_ehl_follow(SbFilmSolver *solver, int *which, const SbEhlCase *old,
                       const SbEhlCase *problem, double tolerance, SbFilmSolverInfo *info,
                       const SbFilmProblem *callback);

// The whole solve.
SbStatus sb_ehl_solve(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                      SbFilmSolver *solver, SbReport *report);
