// Inside of the transient film (private to engine/film): mesh, state, and one implicit step.
#pragma once

#include "engine/film/ehl.h"
#include "engine/film/scale.h"
#include "engine/film/transient.h"

enum { SB_TRANSIENT_NODES_MAX = 1000 };

// Everything is scaled by the steady problem's b, p_H and b^2/R; time stays in seconds. Nodes are
// at x = middle + X, in units of b.
typedef struct {
  double time;
  double speed;  // v = u/(2 b) [1/s]
  double travel; // of the fluid at v since the start
  double H0;
  double P[SB_TRANSIENT_NODES_MAX];     // above the rupture pressure
  double H[SB_TRANSIENT_NODES_MAX];     // gap
  double void_[SB_TRANSIENT_NODES_MAX]; // H less the fluid's height m
  bool cavity[SB_TRANSIENT_NODES_MAX];  // active set
} SbTransientState;

// An earlier time.
typedef struct {
  double time, travel;
  double height[SB_TRANSIENT_NODES_MAX]; // m
} SbTransientPast;

// A step: m' = c0 m + old, and the faces' velocity over their carried share.
typedef struct {
  double c0;
  const double *old; // [nodes] combination of earlier heights; NULL when steady
  double carried_rate;
} SbTransientStep;

typedef struct {
  int iterations;
  double mass_error, load_error;
} SbTransientTrace;

struct SbFilmTransient {
  SbFilmTransientProblem problem;
  SbFilmScale scale;
  int nodes;
  double middle;              // of the contact
  double layer;               // width of the layers at the edges
  double cell;                // spacing between the layers
  double coarseness;          // of mesh and steps: 1, the companion's 2
  SbFilmTransient *companion; // NULL in itself
  double X[SB_TRANSIENT_NODES_MAX];
  double volume[SB_TRANSIENT_NODES_MAX];      // length of a node's cell
  double weight[SB_TRANSIENT_NODES_MAX];      // of the load
  double carried[SB_TRANSIENT_NODES_MAX];     // share of v that face i, i + 1 moves at
  double reach;                               // way in a step up to which faces move
  bool limited[SB_TRANSIENT_NODES_MAX];       // faces of cells wider than the layers
  bool steep[SB_TRANSIENT_NODES_MAX];         // transport through the face is kept monotonic: a
                                              // front stands there when a step begins
  bool beside_cavity[SB_TRANSIENT_NODES_MAX]; // the same, by the cavity when a step begins
  double diffusion;                           // kappa = film^2 p_H / (12 eta b^2) [1/s]
  double flow;                                // scale of v m
  double inlet, outlet;                       // left and right ambient pressure above the rupture's
  double *kernel;                             // [nodes][nodes]
  double known[SB_TRANSIENT_NODES_MAX];       // undeformed gap and that of ambient pressures
  SbSurfaceCompliance compliance;             // modes = 0: half-plane and parabola
  double *matrix;
  double right[SB_TRANSIENT_NODES_MAX];
  int pivot[SB_TRANSIENT_NODES_MAX];
  double row_scale[SB_TRANSIENT_NODES_MAX];
  double work[3][SB_TRANSIENT_NODES_MAX];   // of a step, outside Newton's method
  double newton[2][SB_TRANSIENT_NODES_MAX]; // inside: elastic gap and change of the pressure
  double moment[SB_COMPLIANCE_MODES][SB_TRANSIENT_NODES_MAX]; // of the hats, of a fitted body
  bool factored; // `matrix` holds the factors for this step size and cavity
  double factored_c0;
  bool factored_cavity[SB_TRANSIENT_NODES_MAX];
  SbTransientState now, next, before;
  SbTransientPast past[3];            // newest first
  int known_times;                    // of these
  double way, apart[2], apart_way[2]; // of the fluid; largest difference, and the way then
  double step;                        // next step to try [s]
  SbFilmTransientInfo info;
};

// Layers of the contact at speed_scale.
SbEhlLayers sb_transient_layers(const SbFilmTransient *t);

// Mesh and kernel for films up to `rest`; the arrays and the place of the contact stand. Takes the
// solver's tables and a mesh.
void sb_transient_mesh(SbFilmTransient *t, SbFilmSolver *solver, double rest);

// Mean over each cell, displaced back by the carried share of `way`, of earlier heights: the
// derivatives of their integral over the mesh, which keeps the mass exactly.
void sb_transient_carry(double *out, const SbFilmTransient *t, const double *height, double way);

// Fluid height of a node.
double sb_transient_height(const SbTransientState *s, int i);

// Elastic gap of the state's pressure at all nodes.
void sb_transient_gap(double *out, const SbFilmTransient *t, const SbTransientState *s);

// Flow v m - kappa H^3 P' through the face between i and i + 1, relative to the wall's frame.
double sb_transient_flow(const SbFilmTransient *t, const SbTransientState *s, int face);

// Newton's method for one implicit step (or the steady state, old = NULL) from the guess in `s`,
// whose H may disagree with its P.
SbStatus sb_transient_newton(SbTransientTrace *trace, SbFilmTransient *t, SbTransientState *s,
                             const SbTransientStep *step);

// One implicit step of length h to the given speed (SbTransientState's), from `now` to `next`;
// *error is the step's own, the mean over the contact against the mean film, infinite while
// unknown. Then takes `next` for `now`.
SbStatus sb_transient_advance(double *error, SbFilmTransient *t, double h, double speed);
void sb_transient_accept(SbFilmTransient *t, double error);
