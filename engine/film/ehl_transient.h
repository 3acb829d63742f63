// Inside of the transient film (private to engine/film): mesh, state, and one implicit step.
#pragma once

#include "engine/film/ehl.h"
#include "engine/film/transient.h"

enum { SB_TRANSIENT_NODES_MAX = 1000, SB_TRANSIENT_ORDER_MAX = 1400 };

// Everything is scaled by the steady problem's b, p_H and b^2/R; time stays in seconds. Nodes are
// at x = middle + X, in units of b.
typedef struct {
  double time;
  double speed;  // v = u/(2 b) [1/s]
  double travel; // of the fluid at v since the start
  double H0;
  double P[SB_TRANSIENT_NODES_MAX];    // of the film, above the rupture pressure
  double Q[SB_TRANSIENT_NODES_MAX];    // total: with what the surfaces bear
  double H[SB_TRANSIENT_NODES_MAX];    // gap
  double m[SB_TRANSIENT_NODES_MAX];    // height of the fluid, H where the film is full
  bool cavity[SB_TRANSIENT_NODES_MAX]; // active set
} SbTransientState;

// The face half-way from a node to the next, with four nodes about it.
typedef struct {
  double X;
  double carried;                   // share of v that it moves at
  int first;                        // of the four nodes
  double value[4], slope[4];        // Lagrange's polynomials of these at the face
  double upwind[2][4];              // of three of them, for a flow to the right and to the left
  bool limited;                     // of a cell wider than the layers
  bool monotonic;                   // transport is kept so: a front stands here when a step begins
  bool beside_cavity;               // the same, by the cavity when a step begins
  double flow;                      // v m - kappa H^3 P', relative to the face
  double by_m[4], by_H[4], by_P[4]; // its derivatives to the nodes
} SbTransientFace;

enum { SB_TRANSIENT_SAMPLES = 2000 };

// Cells with the integral of their heights up to faces; face i is behind cell i. It begins a little
// before what is asked for: the surroundings hold so much more liquid that the contact's would be
// lost in rounding.
typedef struct {
  int from, to; // faces
  const double *height;
  double place[SB_TRANSIENT_NODES_MAX], integral[SB_TRANSIENT_NODES_MAX];
} SbTransientCells;

// Spacing wanted at samples of the core, denser to its ends, and the number of spacings up to
// there.
typedef struct {
  double X[SB_TRANSIENT_SAMPLES], spacing[SB_TRANSIENT_SAMPLES], nodes[SB_TRANSIENT_SAMPLES];
} SbTransientSpacing;

enum { SB_TRANSIENT_TRACE = 64 };

// The least film and the companion's at a way of the fluid.
typedef struct {
  double way, film[2];
} SbTransientTrace;

struct SbFilmTransient {
  SbFilmTransientProblem problem;
  SbFilmScale scale;
  SbEhlLayers layers; // of the contact at speed_scale, without end pressures
  double supply[2];   // fluid's height at a starved end of the mesh; infinite: flooded
  bool rough;         // asperities or adhesion: the total pressure is not the film's
  SbEhlCase surface;  // they, of rough rows
  int nodes;
  int side;                   // nodes at either edge and beyond, which never move
  double core;                // the others are inside |X| < core
  double layer;               // width of the layers at the edges
  double share, inner_share;  // spacing over the distance to the edge, outside and inside
  double finest;              // least distance that counts for it
  double cell;                // largest spacing between the layers
  double ramp;                // way within which the faces come to move with the fluid
  double bend;                // wanted of the height from node to node, over the height
  double coarseness;          // of mesh and steps: 1, the companion's 2
  SbFilmTransient *companion; // NULL in itself
  SbFilmSolver *solver;       // its tables and a mesh; the companion borrows it
  double X[SB_TRANSIENT_NODES_MAX];
  double volume[SB_TRANSIENT_NODES_MAX]; // length of a node's cell
  double weight[SB_TRANSIENT_NODES_MAX]; // of the load
  SbTransientFace face[SB_TRANSIENT_NODES_MAX];
  double reach;                         // way in a step up to which faces move
  double diffusion;                     // kappa = film^2 p_H / (12 eta b^2) [1/s]
  double flow;                          // scale of v m
  double known[SB_TRANSIENT_NODES_MAX]; // undeformed gap and that of ambient pressures
  // What the surfaces bear at the state's gaps, its slope to the gap, and of a cavity's node where
  // that is not nil the place of its total pressure among the unknowns; else 0.
  double solid[SB_TRANSIENT_NODES_MAX], solid_H[SB_TRANSIENT_NODES_MAX];
  int extra[SB_TRANSIENT_NODES_MAX];
  int order; // unknowns
  // [nodes][nodes]: gap by the pressures; factors for the step c0 and the unknowns below, c0 = 0:
  // none.
  double kernel[SB_TRANSIENT_NODES_MAX * SB_TRANSIENT_NODES_MAX];
  double matrix[SB_TRANSIENT_ORDER_MAX * SB_TRANSIENT_ORDER_MAX];
  double factored_c0;
  bool factored_cavity[SB_TRANSIENT_NODES_MAX];
  int factored_extra[SB_TRANSIENT_NODES_MAX];
  int pivot[SB_TRANSIENT_ORDER_MAX];
  double right[SB_TRANSIENT_ORDER_MAX];
  // Of a fitted body: its polynomials at the nodes, and S times these.
  double mode[2][SB_TRANSIENT_NODES_MAX][SB_COMPLIANCE_MODES];
  // The step: m' = c0 m + old, zero when steady, and the faces' velocity over their carried share.
  double c0, carried_rate;
  double old[SB_TRANSIENT_NODES_MAX];
  double guess[SB_TRANSIENT_NODES_MAX]; // of m, on from earlier times
  double work[2][SB_TRANSIENT_NODES_MAX];
  SbTransientCells cells;     // work memory
  SbTransientSpacing spacing; // the same
  double old_X[SB_TRANSIENT_NODES_MAX];
  SbTransientState next, now, before, earlier;
  int known_times;                            // 1 to 3, from now back
  double way, apart[2], apart_way[2];         // of the fluid; largest difference, and the way then
  SbTransientTrace trace[SB_TRANSIENT_TRACE]; // the last ones, since the last rest
  int traced;
  double step;                  // next step to try [s]
  SbFilmTransientResult result; // but for the films
};

// Mesh and kernel for films up to `rest`, trapped ones down to `least` (0: none).
void sb_transient_mesh(SbFilmTransient *t, double rest, double least);

// New mesh in the core, with the states on it, if what the fluid carries there needs another
// spacing; `ahead` is the way that it will be carried, for which the new spacing is to last.
bool sb_transient_adapt(SbFilmTransient *t, double ahead);

// The states from the nodes old_X, whose sides are those of the present mesh, on that mesh.
void sb_transient_remap(SbFilmTransient *t, int nodes);

// Whether a front stands among so many heights: they differ by more than the factor.
bool sb_transient_front(const double *height, int count, double factor);

// What the surfaces bear at the state's gaps into t->solid. Gives every node the total pressure of
// its film, or, if `split`, a full one the film pressure that its total leaves.
void sb_transient_bear(SbFilmTransient *t, SbTransientState *s, bool split);

// Friction, asperities' load and real area of the present state into the result.
void sb_transient_rub(SbFilmTransientResult *out, const SbFilmTransient *t);

// Elastic gap of the state's total pressure at all nodes.
void sb_transient_gap(double *out, const SbFilmTransient *t, const SbTransientState *s);

// Mean over each cell, displaced back by the carried share of `way`, of earlier heights: the
// derivatives of their integral over the mesh, which keeps the mass exactly.
void sb_transient_carry(double *out, SbFilmTransient *t, const double *height, double way);

// Newton's method for the step in `t` from the guess in `s`, whose H may disagree with its P.
SbStatus sb_transient_newton(SbFilmTransient *t, SbTransientState *s);

// One implicit step of length h to the given speed (SbTransientState's), from `now` to `next`;
// *error is the step's own, the mean over the contact against the mean film, infinite while
// unknown. Then takes `next` for `now`.
SbStatus sb_transient_advance(double *error, SbFilmTransient *t, double h, double speed);
void sb_transient_accept(SbFilmTransient *t, double error);
