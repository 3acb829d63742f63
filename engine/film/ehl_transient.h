// Transient film: mesh, state, and one implicit step. Private to engine/film.
//
// sb_film_transient_create() sets problem, scale and the solver, calls sb_transient_mesh(), and
// computes the initial state t->now. A time step then is sb_transient_advance(), which computes
// t->next; if its error is small, sb_transient_accept() and sb_transient_adapt(); else a shorter
// step from the same t->now.
#pragma once

#include "engine/film/ehl.h"
#include "engine/film/transient.h"

// Capacity: nodes, and unknowns of a step.
enum { SB_TRANSIENT_NODES_MAX = 1000, SB_TRANSIENT_ORDER_MAX = 1400 };

// State at one time, scaled by b, p_H and b^2/R of the steady problem; time in seconds. Nodes are
// at x = middle + X, in units of b, in the seal's frame.
typedef struct {
  double time;                         // [s]
  double speed;                        // v = u/(2 b) [1/s]
  double travel;                       // integral of v over time: distance that the fluid has moved
  double H0;                           // constant of the gap (sb_transient_gap())
  double P[SB_TRANSIENT_NODES_MAX];    // film pressure minus rupture pressure
  double Q[SB_TRANSIENT_NODES_MAX];    // total pressure, including asperities and adhesion
  double H[SB_TRANSIENT_NODES_MAX];    // gap
  double m[SB_TRANSIENT_NODES_MAX];    // height of liquid, H where the film is full
  bool cavity[SB_TRANSIENT_NODES_MAX]; // active set: the node is cavitated
} SbTransientState;

// The face half-way between two nodes, with the four nodes around it.
typedef struct {
  double X;
  double carried;            // velocity of the face divided by v
  int first;                 // number of the first of the four nodes
  double value[4], slope[4]; // their Lagrange polynomials at the face, and derivatives
  double upwind[2][4];       // upwind interpolation of m, for flow to the right and to the left
  bool limited;              // the cell is larger than the layers: limited interpolation
  bool monotonic;            // a front is here at the start of the step: monotonic interpolation
  bool beside_cavity;        // adjacent to the cavity at the start of the step: also monotonic
  double flow;               // v m - kappa H^3 P', relative to the face
  double by_m[4], by_H[4], by_P[4]; // derivatives of `flow` with respect to the nodes
} SbTransientFace;

// Samples of the core for SbTransientSpacing.
enum { SB_TRANSIENT_SAMPLES = 2000 };

// Cells with the integral of liquid height up to their faces; face i is behind cell i. They begin
// slightly before the requested range, because the surroundings hold much more liquid than the
// contact.
typedef struct {
  int from, to;                            // first and last face in use
  const double *height;                    // liquid height of the cells, borrowed
  double place[SB_TRANSIENT_NODES_MAX];    // X of the faces
  double integral[SB_TRANSIENT_NODES_MAX]; // integral of `height` up to the faces
} SbTransientCells;

// Desired spacing at samples of the core, with smaller distances near its ends, and the accumulated
// number of nodes.
typedef struct {
  double X[SB_TRANSIENT_SAMPLES], spacing[SB_TRANSIENT_SAMPLES], nodes[SB_TRANSIENT_SAMPLES];
} SbTransientSpacing;

// Capacity of the trace.
enum { SB_TRANSIENT_TRACE = 64 };

// Minimum films of the film and of its companion, at a distance that the fluid has moved.
typedef struct {
  double travel;  // distance that the fluid has moved, divided by b
  double film[2]; // minimum films of the film and of its companion, scaled
} SbTransientTrace;

// The transient film (SbFilmTransient of transient.h).
struct SbFilmTransient {
  SbFilmTransientProblem problem;
  SbFilmScale scale;
  SbEhlLayers layers; // of the contact at speed_scale, without end pressures
  double supply[2];   // height of liquid at a starved end of the mesh; infinite: flooded
  bool rough;         // asperities or adhesion: Q differs from P
  SbEhlCase surface;  // the case with asperities and adhesion (rough rows)
  int nodes;
  int side;                   // nodes at and outside each edge; they do not move
  double core;                // the other nodes are in |X| < core
  double layer;               // width of the layers at the edges
  double share, inner_share;  // spacing divided by the distance to the edge, outside and inside
  double finest;              // lower limit of that distance
  double cell;                // largest spacing between the layers
  double ramp;                // distance from the edge in which face velocities rise to v
  double bend;                // desired relative curvature of the height from node to node
  double coarseness;          // factor of spacing and steps: 1, in the companion 2
  SbFilmTransient *companion; // owned; NULL in the companion itself
  SbFilmSolver *solver;       // tables and a mesh; borrowed by the companion
  double X[SB_TRANSIENT_NODES_MAX];
  double volume[SB_TRANSIENT_NODES_MAX]; // length of a node's cell
  double weight[SB_TRANSIENT_NODES_MAX]; // quadrature weight of the load
  SbTransientFace face[SB_TRANSIENT_NODES_MAX];
  double reach;                         // distance in a step up to which the faces move
  double diffusion;                     // kappa = film^2 p_H/(12 eta b^2) [1/s]
  double flow;                          // scale of v m
  double known[SB_TRANSIENT_NODES_MAX]; // undeformed gap plus that of the ambient pressures
  // Pressure of asperities and adhesion at the present gaps, and its derivative with respect to the
  // gap.
  double solid[SB_TRANSIENT_NODES_MAX], solid_H[SB_TRANSIENT_NODES_MAX];
  int extra[SB_TRANSIENT_NODES_MAX]; // index of the unknown Q of a cavitated node with solid
                                     // pressure; else 0
  int order;                         // number of unknowns
  // Gap by the pressures [nodes][nodes]; factors of the Jacobian, for the step coefficient and the
  // unknowns below (factored_c0 = 0: none).
  double kernel[SB_TRANSIENT_NODES_MAX * SB_TRANSIENT_NODES_MAX];
  double matrix[SB_TRANSIENT_ORDER_MAX * SB_TRANSIENT_ORDER_MAX];
  double factored_c0;
  bool factored_cavity[SB_TRANSIENT_NODES_MAX];
  int factored_extra[SB_TRANSIENT_NODES_MAX];
  int pivot[SB_TRANSIENT_ORDER_MAX];
  double right[SB_TRANSIENT_ORDER_MAX];
  // Fitted body: its polynomials at the nodes, and S times these.
  double mode[2][SB_TRANSIENT_NODES_MAX][SB_COMPLIANCE_MODES];
  // The step: dm/dt = c0 m + old (0 if steady); face velocity divided by `carried`.
  double c0, carried_rate;
  double old[SB_TRANSIENT_NODES_MAX];
  double guess[SB_TRANSIENT_NODES_MAX]; // m extrapolated in time, the initial guess
  double work[2][SB_TRANSIENT_NODES_MAX];
  SbTransientCells cells;     // work memory
  SbTransientSpacing spacing; // work memory
  double old_X[SB_TRANSIENT_NODES_MAX];
  SbTransientState next, now, before, earlier; // state of the step, present and two earlier states
  int known_times;                             // valid states from `now` on, 1 to 3
  double travel, apart[2], apart_travel[2];    // distance moved by the fluid; largest difference to
                                               // the companion, and `travel` then
  SbTransientTrace trace[SB_TRANSIENT_TRACE];  // since the last rest
  int traced;                                  // entries in use
  double step;                                 // next time step to try [s]
  SbFilmTransientResult result;                // except films and friction
};

// Builds mesh and kernel for initial gaps at rest up to `rest` and films that come to rest down to
// `least`, both scaled, 0: none. The fields problem, scale, layers, coarseness and solver of `t`
// must be set.
void sb_transient_mesh(SbFilmTransient *t, double rest, double least);

// Builds a new mesh in the core and transfers the states, if the transported film needs another
// spacing. The new spacing is chosen so that it suffices while the fluid moves by `ahead`, signed
// and divided by b (0: it rests). Returns whether the mesh changed.
bool sb_transient_adapt(SbFilmTransient *t, double ahead);

// Transfers the states `now`, `before` and `earlier` from the nodes t->old_X[nodes] to the present
// mesh; the side nodes of both meshes are equal.
void sb_transient_remap(SbFilmTransient *t, int nodes);

// Returns whether height[count] contains a front: the largest value exceeds `factor` times the
// smallest one.
bool sb_transient_front(const double *height, int count, double factor);

// Computes t->solid at the gaps of `s`, then Q = P + solid at each node; with `split` P = Q - solid
// at full nodes.
void sb_transient_solids(SbFilmTransient *t, SbTransientState *s, bool split);

// Computes friction, asperity load and share, and real area of the present state t->now, in the
// units of SbFilmTransientResult; the other fields of *out are not changed.
void sb_transient_friction(SbFilmTransientResult *out, const SbFilmTransient *t);

// Writes the elastic gap due to Q at all nodes to out[nodes].
void sb_transient_gap(double *out, const SbFilmTransient *t, const SbTransientState *s);

// Transports the liquid height[nodes] by the signed distance `travel` (divided by b, times
// `carried` at the faces) and writes its means over the cells to out[nodes]. Conserves mass. Uses
// t->cells.
void sb_transient_transport(double *out, SbFilmTransient *t, const double *height, double travel);

// Solves the implicit step described in `t` (c0, carried_rate, old, guess) by Newton's method from
// the guess `s`, in which H need not be the gap of P; s->time and speed are those of the end of the
// step. SB_ERROR_NOT_CONVERGED.
SbStatus sb_transient_newton(SbFilmTransient *t, SbTransientState *s);

// Computes t->next from t->now by one step of length h [s] to `speed` (as in SbTransientState).
// *error receives the local error of m, its mean over the contact divided by the mean film;
// infinite while unknown. SB_ERROR_NOT_CONVERGED.
SbStatus sb_transient_advance(double *error, SbFilmTransient *t, double h, double speed);

// Makes t->next the present state and adds `error` of sb_transient_advance() to the estimates.
void sb_transient_accept(SbFilmTransient *t, double error);
