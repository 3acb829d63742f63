// Spectral elements for a pressure on a half-plane. Private to engine/film.
//
// The line is divided into elements. On each element the pressure is a polynomial of the element
// coordinate r in [-1, 1], continuous across elements. The film equation is collocated at Gauss
// points. The integral of the gap with the logarithmic kernel is exact for these polynomials. All
// quantities are scaled (scale.h). Tables and meshes are used by one thread at a time.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/compliance.h"

#include <stdbool.h>
#include <stddef.h>

// Capacities and constants.
enum {
  SB_EHL_DEGREE_MAX = 18,    // largest polynomial degree
  SB_EHL_ELEMENTS_MAX = 100, // largest number of elements
  SB_EHL_DOFS_MAX = 604,     // largest number of nodal pressures: 100 elements of degree 6
  SB_EHL_TARGETS_MAX = SB_EHL_DOFS_MAX + SB_EHL_ELEMENTS_MAX + 4, // points of the gap
  SB_EHL_ORDER_MAX = SB_EHL_DOFS_MAX + 4, // unknowns: pressures and up to four others
  SB_EHL_QUAD = 24,                       // points of the fine quadrature rule
  SB_EHL_MULTIPOLES = 34,                 // terms of the expansion for distant targets
  SB_EHL_PROJECT = SB_EHL_DEGREE_MAX + 12 // largest Legendre mode of projected weights
};

// Map from r to X.
typedef enum {
  SB_EHL_AFFINE, // X = m + h r
  SB_EHL_COSINE, // X = -cos(theta), theta = m + h r: Hertz's pressure is sin(theta)
  SB_EHL_FAR     // to infinity: X = A +- B/s^2, s = (1 -+ r)/2; pressure = far pressure + s^4
                 // polynomial
} SbEhlMap;

// Tables of one degree.
typedef struct {
  int degree;
  double node[SB_EHL_DEGREE_MAX + 1]; // Lobatto nodes
  double bary[SB_EHL_DEGREE_MAX + 1]; // barycentric weights of the Lobatto nodes
  // Gauss rules for collocation: [0] with `degree` points, [1] with degree + 1.
  double gauss[2][SB_EHL_DEGREE_MAX + 1];
  double weight[2][SB_EHL_DEGREE_MAX + 1];
  // Basis functions and their derivatives at these points, [rule][point][node].
  double value[2][SB_EHL_DEGREE_MAX + 1][SB_EHL_DEGREE_MAX + 1];
  double slope[2][SB_EHL_DEGREE_MAX + 1][SB_EHL_DEGREE_MAX + 1];
  double fine[SB_EHL_QUAD][SB_EHL_DEGREE_MAX + 1]; // basis functions at the fine rule
  // Interpolation points of the gap: collocation points and finite ends, degree + 2 points. [0]
  // finite elements, [1] to minus infinity, [2] to infinity.
  double gap_node[3][SB_EHL_DEGREE_MAX + 2];
  double gap_bary[3][SB_EHL_DEGREE_MAX + 2];
  bool ready; // the fields above are set
  // Integration from node to node, set by sb_ehl_steps().
  double node_slope[SB_EHL_DEGREE_MAX + 1][SB_EHL_DEGREE_MAX + 1]; // [node][basis]
  double step[SB_EHL_DEGREE_MAX]
             [SB_EHL_DEGREE_MAX + 1]; // integral of a basis function from node j to j + 1
  bool stepped;                       // node_slope and step are set
} SbEhlTable;

// Quadrature rule and tables of all degrees, computed when first used.
typedef struct {
  double fine[SB_EHL_QUAD], fine_weight[SB_EHL_QUAD];
  double fine_legendre[SB_EHL_QUAD][SB_EHL_PROJECT + 1];
  SbEhlTable table[SB_EHL_DEGREE_MAX + 1];
} SbEhlTables;

// One element. Columns 0 to degree of its arrays belong to its nodes. The node at which an infinite
// element touches its neighbour has the full pressure as nodal value.
typedef struct {
  SbEhlMap map;
  int side; // -1: extends to minus infinity, 1: to infinity, 0: a finite element
  int degree;
  const SbEhlTable *table; // borrowed
  int points;              // collocation points
  int first_dof; // first of degree + 1 unknowns, shared with the previous element unless `apart`
  int first_row; // first collocation row
  int gap_target[SB_EHL_DEGREE_MAX + 2]; // targets from which the gap is interpolated
  bool apart;                            // separated from the previous element by a cavity
  double x0, x1;       // X of the ends; of an infinite element both the finite end
  double m, h, A, B;   // constants of the map (SbEhlMap)
  double far_pressure; // pressure at infinity
  int modes;           // largest Legendre mode of the projected weight
  // Kernel integrals: projected weights; positions and weighted basis functions at the fine rule.
  double project[SB_EHL_PROJECT + 1][SB_EHL_DEGREE_MAX + 1];
  double fine_x[SB_EHL_QUAD];
  double fine_wb[SB_EHL_QUAD][SB_EHL_DEGREE_MAX + 1];
  // Finite elements: integrals with -((X - middle)/half)^(m + 1)/(m + 1).
  double middle, half;
  double multipole[SB_EHL_MULTIPOLES][SB_EHL_DEGREE_MAX + 1];
  double integral[SB_EHL_DEGREE_MAX + 1]; // integral of the pressure minus the far pressure over X
  double log_s[SB_EHL_DEGREE_MAX + 1];    // infinite elements: this integral with the factor ln s
} SbEhlElement;

// Coefficients of the nodal values in the pressure at a point (`value`) and in its derivative dp/dX
// (`slope`).
typedef struct {
  double value[SB_EHL_DEGREE_MAX + 1], slope[SB_EHL_DEGREE_MAX + 1];
} SbEhlLocal;

// A mesh with its operators. Targets are points at which the gap is computed: the collocation
// points (the first `rows`), then the finite ends of the elements. On a nodal mesh the targets are
// the nodes instead, in the order of the nodal pressures: rows = targets = dofs, and `weight`,
// `local` and the elements' gap_target are not set, so sb_ehl_gap() must not be called. "Known"
// parts are independent of the nodal pressures. All is set by sb_ehl_mesh_begin(), _add() and
// _build(), except `tables`.
typedef struct {
  SbEhlTables *tables; // borrowed
  int count;           // elements, from left to right
  bool fits;           // while adding elements: they fit so far
  double end;          // while adding elements: end of the last one
  bool apart;          // while adding elements: a cavity follows
  int film_end;        // last element before the cavity, or of the mesh
  SbEhlElement element[SB_EHL_ELEMENTS_MAX];
  int dofs;                               // nodal pressures
  int rows;                               // collocation points
  int targets;                            // points of the gap
  double inlet_pressure, outlet_pressure; // constant pressures left and right of the mesh
  double left_end, right_end;             // X of the left and right end of the mesh
  double x[SB_EHL_TARGETS_MAX];           // X of the targets
  int owner[SB_EHL_TARGETS_MAX];          // element of each target
  // [targets][dofs] -(1/pi) integral of the basis functions times ln|X - X'|; gap of the known
  // pressures with their tilt.
  double gap[SB_EHL_TARGETS_MAX * SB_EHL_DOFS_MAX], gap_known[SB_EHL_TARGETS_MAX];
  // Change of the known parts per unit of pressure beyond the left and the right end.
  double gap_by_end[2][SB_EHL_TARGETS_MAX], load_by_end[2];
  double weight[SB_EHL_DOFS_MAX];           // [rows] quadrature weights dX; not on a nodal mesh
  SbEhlLocal local[SB_EHL_DOFS_MAX];        // [rows] not on a nodal mesh
  double load[SB_EHL_DOFS_MAX], load_known; // integrals of the basis functions and known pressures
} SbEhlMesh;

// Computes the fine rule; *tables must be zero before. Tables of a degree are computed by the
// functions below when first used.
void sb_ehl_tables_init(SbEhlTables *tables);

// Returns the tables of a degree, including integration from node to node; borrowed.
const SbEhlTable *sb_ehl_steps(SbEhlTables *tables, int degree);

// Writes to weight[degree + 1] the integrals over r of the basis functions from node j to r;
// `table` is the result of sb_ehl_steps().
void sb_ehl_partial(double *weight, const SbEhlTable *table, int j, double r);

// Empties the mesh; mesh->tables must be set. The first element begins at X = `start` (not used if
// it is an infinite element). The pressures are those beyond the ends. Then add the elements from
// left to right, and call sb_ehl_mesh_build().
void sb_ehl_mesh_begin(SbEhlMesh *mesh, double start, double inlet_pressure,
                       double outlet_pressure);

// Appends a finite element of map SB_EHL_AFFINE or SB_EHL_COSINE (within |X| <= 1) from the present
// end mesh->end to X = `end`. To leave a cavity before the element, set mesh->apart to true and
// mesh->end to its start. If the element does not fit, mesh->fits becomes false.
void sb_ehl_mesh_add(SbEhlMesh *mesh, SbEhlMap map, double end, int degree);

// Appends an infinite element: from minus infinity to X = x (side -1, the first element), or from x
// to infinity (side 1, the last element). B > 0 is the length scale of its map.
void sb_ehl_mesh_add_far(SbEhlMesh *mesh, int side, double x, double B, int degree);

// Returns the gap at X due to the constant pressures `inlet` (X < left) and `outlet` (X > right),
// up to a constant, with the tilt that keeps the dry contact at |X| < 1 (docs/verification.md).
double sb_ehl_ambient_gap(double X, double left, double right, double inlet, double outlet);

// Computes all operators of a mesh with at least one element. `nodal`: the targets are the nodes;
// only for affine elements without cavities. Returns false if an element did not fit; the mesh must
// then be begun again.
SB_CHECKED bool sb_ehl_mesh_build(SbEhlMesh *mesh, bool nodal);

// Sets other pressures beyond the ends of a built mesh.
void sb_ehl_mesh_ends(SbEhlMesh *mesh, double inlet_pressure, double outlet_pressure);

// Returns the X of node k (0 to degree) of an element; for the node at infinity a distant X.
double sb_ehl_node(const SbEhlElement *e, int k);

// Returns the nodal value of node k for which the pressure at sb_ehl_node() is `pressure`.
double sb_ehl_nodal(const SbEhlElement *e, int k, double pressure);

// Returns the number of the element that contains X, of the first or last one if X is outside the
// mesh. A cavity belongs to the element after it.
int sb_ehl_find(const SbEhlMesh *mesh, double X);

// Returns the coordinate r of X in an element, X within the element.
double sb_ehl_coordinate(const SbEhlElement *e, double X);

// Returns at r the polynomial through value[degree + 1] at the nodes.
double sb_ehl_interpolate(const SbEhlTable *table, const double *value, double r);

// Returns the number of the node of an infinite element that touches its neighbour.
static inline int sb_ehl_touching(const SbEhlElement *e) {
  return e->side < 0 ? e->degree : 0;
}

// Returns s of an infinite element: 1 at its finite end, 0 at infinity.
static inline double sb_ehl_inverse(const SbEhlElement *e, double r) {
  return 0.5 * (1.0 - e->side * r);
}

// Computes the coefficients at r of element `e`. basis[degree + 1] are the Lagrange polynomials of
// the nodes at r, `rise` their derivatives (NULL: out->slope is 0).
void sb_ehl_local(SbEhlLocal *out, const SbEhlElement *e, const double *basis, const double *rise,
                  double r);

// Returns the pressure by the nodal values of the element, including the far pressure; `nodal` is
// that of the whole mesh. Writes dp/dX to *slope (NULL: not wanted).
double sb_ehl_sum(double *slope, const SbEhlLocal *local, const SbEhlElement *e,
                  const double *nodal);

// Computes the parts of an element's kernel integrals that are independent of the target, and its
// `integral`. sb_ehl_mesh_build() calls it for each element; call it for an element of a mesh that
// is not built (sb_ehl_mesh_add() has set the element's other fields).
void sb_ehl_kernel_prepare(SbEhlElement *e, const SbEhlTables *tables);

// Adds to row[degree + 1] the integrals over X' of the element's basis functions times ln|X - X'|.
// Requires sb_ehl_kernel_prepare() for the element.
void sb_ehl_kernel_row(double *row, const SbEhlElement *e, const SbEhlTables *tables, double X);

// Returns X at the element coordinate r.
double sb_ehl_position(const SbEhlElement *e, double r);

// Returns dX/dr at r.
double sb_ehl_stretch(const SbEhlElement *e, double r);

// Returns the pressure at r of element `e`, including the far pressure; `nodal` is that of the
// whole mesh. Writes dp/dX to *slope (NULL: not wanted).
double sb_ehl_pressure(double *slope, const SbEhlElement *e, const double *nodal, double r);

// Returns the gap at r of element `e`, interpolated from target_gap[targets] at the element's
// collocation points and ends.
double sb_ehl_gap(const SbEhlElement *e, const double *target_gap, double r);
