// Spectral elements for a pressure on a half-plane (private to engine/film).
//
// The line is cut into elements; on each the pressure is a polynomial in the element's own
// coordinate r in [-1, 1], continuous across elements, and the film equation is collocated at Gauss
// points. The gap's integral with the logarithmic kernel is taken exactly for these polynomials.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/compliance.h"

#include <stdbool.h>
#include <stddef.h>

enum {
  SB_EHL_DEGREE_MAX = 18,
  SB_EHL_ELEMENTS_MAX = 100,
  SB_EHL_DOFS_MAX = 604, // nodal pressures: every element of degree 6
  SB_EHL_TARGETS_MAX = SB_EHL_DOFS_MAX + SB_EHL_ELEMENTS_MAX + 4,
  SB_EHL_ORDER_MAX = SB_EHL_DOFS_MAX + 4, // with the unknowns beside the pressures
  SB_EHL_QUAD = 24,                       // points of the fine rule for smooth remainders
  SB_EHL_MULTIPOLES = 34,                 // terms of the expansion for distant targets
  SB_EHL_PROJECT = SB_EHL_DEGREE_MAX + 12
};

// How r maps to X.
typedef enum {
  SB_EHL_AFFINE, // X = m + h r
  SB_EHL_COSINE, // X = -cos(theta), theta = m + h r: Hertz's pressure is sin(theta)
  SB_EHL_FAR     // X = A +- B / s^2 to infinity, s = (1 -+ r) / 2; pressure = far + s^4 polynomial
} SbEhlMap;

// Tables of one degree.
typedef struct {
  int degree;
  double node[SB_EHL_DEGREE_MAX + 1]; // Lobatto
  double bary[SB_EHL_DEGREE_MAX + 1];
  // Gauss rules of collocation: [0] with `degree` points, [1] with degree + 1.
  double gauss[2][SB_EHL_DEGREE_MAX + 1];
  double weight[2][SB_EHL_DEGREE_MAX + 1];
  double value[2][SB_EHL_DEGREE_MAX + 1][SB_EHL_DEGREE_MAX + 1]; // [rule][point][node]
  double slope[2][SB_EHL_DEGREE_MAX + 1][SB_EHL_DEGREE_MAX + 1];
  double fine[SB_EHL_QUAD][SB_EHL_DEGREE_MAX + 1]; // basis at the fine rule
  // Points from which the gap is interpolated: the collocation points and the finite ends.
  // [0] finite elements, [1] to minus infinity, [2] to infinity; degree + 2 points each.
  double gap_node[3][SB_EHL_DEGREE_MAX + 2];
  double gap_bary[3][SB_EHL_DEGREE_MAX + 2];
  bool ready;
  // Rule from node to node, made by sb_ehl_steps().
  double node_slope[SB_EHL_DEGREE_MAX + 1][SB_EHL_DEGREE_MAX + 1]; // [node][basis]
  double step[SB_EHL_DEGREE_MAX][SB_EHL_DEGREE_MAX + 1]; // integral of a basis from node j to j + 1
  bool stepped;
} SbEhlTable;

// Everything that outlives a solve: rules and tables of the degrees in use.
typedef struct {
  double fine[SB_EHL_QUAD], fine_weight[SB_EHL_QUAD];
  double fine_legendre[SB_EHL_QUAD][SB_EHL_PROJECT + 1];
  SbEhlTable table[SB_EHL_DEGREE_MAX + 1];
} SbEhlTables;

// One element; columns 0 .. degree belong to the nodes. The node at which an infinite one touches
// its neighbour holds the full pressure.
typedef struct {
  SbEhlMap map;
  int side; // of infinity: -1 left, 1 right, 0 of a finite element
  int degree;
  const SbEhlTable *table;
  int points;    // collocation points
  int first_dof; // of degree + 1; the first is shared with the element before unless `apart`
  int first_row;
  int gap_target[SB_EHL_DEGREE_MAX + 2]; // targets from which the gap is interpolated
  bool apart;                            // does not touch the element before: a cavity lies between
  double x0, x1;                         // ends; the infinite one is unused
  double m, h, A, B;
  double far_pressure;
  int modes; // highest Legendre mode of the projected weight
  double project[SB_EHL_PROJECT + 1][SB_EHL_DEGREE_MAX + 1];
  double fine_x[SB_EHL_QUAD];
  double fine_wb[SB_EHL_QUAD][SB_EHL_DEGREE_MAX + 1];
  // Of finite elements: integrals with -((X - middle) / half)^(m + 1) / (m + 1).
  double middle, half;
  double multipole[SB_EHL_MULTIPOLES][SB_EHL_DEGREE_MAX + 1];
  double integral[SB_EHL_DEGREE_MAX + 1]; // of the pressure (less the far pressure) over X
  double log_s[SB_EHL_DEGREE_MAX + 1];    // integral with ln s, infinite elements
} SbEhlElement;

// Share of each node in the pressure at a place of an element and in its slope to X.
typedef struct {
  double value[SB_EHL_DEGREE_MAX + 1], slope[SB_EHL_DEGREE_MAX + 1];
} SbEhlLocal;

// A mesh with its operators. Targets are the collocation points (the first `rows`), then the finite
// ends of the elements; of a nodal mesh, the nodes, without local operators. The known parts hold
// what does not depend on the nodal pressures.
typedef struct {
  SbEhlTables *tables;
  int count;
  bool fits;    // so far
  double end;   // so far
  bool apart;   // a cavity lies before the next element
  int film_end; // element before the cavity, the last one without
  SbEhlElement element[SB_EHL_ELEMENTS_MAX];
  int dofs, rows, targets;
  double inlet_pressure, outlet_pressure; // constant pressure beyond the two ends of the mesh
  double left_end, right_end;             // where those constants begin
  double x[SB_EHL_TARGETS_MAX];           // of the targets
  int owner[SB_EHL_TARGETS_MAX];          // element of a target
  // [targets][dofs] -(1/pi) integral of basis ln|X - X'|, and the gap of the known pressure, of the
  // far pressures and their tilt.
  double gap[SB_EHL_TARGETS_MAX * SB_EHL_DOFS_MAX], gap_known[SB_EHL_TARGETS_MAX];
  // Of the known parts, what a unit of the pressure beyond either end adds.
  double gap_by_end[2][SB_EHL_TARGETS_MAX], load_by_end[2];
  double weight[SB_EHL_DOFS_MAX];           // [rows] quadrature weights dX
  SbEhlLocal local[SB_EHL_DOFS_MAX];        // [rows]
  double load[SB_EHL_DOFS_MAX], load_known; // integrals of the basis and of the known pressure
} SbEhlMesh;

// Rules; the tables of a degree follow on first use.
void sb_ehl_tables_init(SbEhlTables *tables);

// The tables of a degree with the rule from node to node, and an element's integral of each basis
// function from node j to r.
const SbEhlTable *sb_ehl_steps(SbEhlTables *tables, int degree);
void sb_ehl_partial(double *weight, const SbEhlTable *table, int j, double r);

// Empties the mesh, whose tables stand, to begin at `start`; adds elements from its end to `end`;
// adds an infinite element on a side, up to X = x or from there.
void sb_ehl_mesh_begin(SbEhlMesh *mesh, double start, double inlet_pressure,
                       double outlet_pressure);
void sb_ehl_mesh_add(SbEhlMesh *mesh, SbEhlMap map, double end, int degree);
void sb_ehl_mesh_add_far(SbEhlMesh *mesh, int side, double x, double B, int degree);

// Gap by pressures that are constant beyond the ends of a mesh, up to a constant, with the tilt
// that leaves the dry contact |X| < 1 (docs/verification.md).
double sb_ehl_ambient_gap(double X, double left, double right, double inlet, double outlet);

// Numbers the unknowns and builds every operator, unless the elements did not fit: then false;
// `nodal`: with the nodes for targets, on affine elements without cavities.
SB_CHECKED bool sb_ehl_mesh_build(SbEhlMesh *mesh, bool nodal);

// Gives a mesh that is built other pressures beyond its ends.
void sb_ehl_mesh_ends(SbEhlMesh *mesh, double inlet_pressure, double outlet_pressure);

// Place of node k of an element, of one at infinity a place far away; and the nodal value that
// gives the pressure there.
double sb_ehl_node(const SbEhlElement *e, int k);
double sb_ehl_nodal(const SbEhlElement *e, int k, double pressure);

// Element that holds X (a cavity belongs to the element after it), and the coordinate of X in an
// element.
int sb_ehl_find(const SbEhlMesh *mesh, double X);
double sb_ehl_coordinate(const SbEhlElement *e, double X);

// Polynomial through `value` at the nodes, at r.
double sb_ehl_interpolate(const SbEhlTable *table, const double *value, double r);

// The node of an infinite element that touches the neighbour.
static inline int sb_ehl_touching(const SbEhlElement *e) {
  return e->side < 0 ? e->degree : 0;
}

// s of an infinite element: 1 at its finite end, 0 at infinity.
static inline double sb_ehl_inverse(const SbEhlElement *e, double r) {
  return 0.5 * (1.0 - e->side * r);
}

// Pressure at r, where the nodes' Lagrange polynomials are `basis` with the slopes `rise` to r
// (NULL: values only).
void sb_ehl_local(SbEhlLocal *out, const SbEhlElement *e, const double *basis, const double *rise,
                  double r);

// Pressure by the nodal values, and its slope unless NULL.
double sb_ehl_sum(double *slope, const SbEhlLocal *local, const SbEhlElement *e,
                  const double *nodal);

// Everything about an element that its integrals need, for every target alike.
void sb_ehl_kernel_prepare(SbEhlElement *e, const SbEhlTables *tables);

// Adds to row[j], j <= degree, the integral of column j times ln|X - X'|.
void sb_ehl_kernel_row(double *row, const SbEhlElement *e, const SbEhlTables *tables, double X);

// X of the element's coordinate, and dX/dr.
double sb_ehl_position(const SbEhlElement *e, double r);
double sb_ehl_stretch(const SbEhlElement *e, double r);

// Pressure at r of element e from nodal values, the far pressure included; its slope to X unless
// NULL.
double sb_ehl_pressure(double *slope, const SbEhlElement *e, const double *nodal, double r);

// Gap at r of element e, interpolated from the gap at all targets (`target_gap`) at the
// collocation points and ends of the element.
double sb_ehl_gap(const SbEhlElement *e, const double *target_gap, double r);
