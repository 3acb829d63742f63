// Spectral elements for a pressure on an elastic half-plane, scaled.
//
// Each element maps r in [-1, 1] to X so that the pressure is smooth in r: affine in the layers,
// X = -cos(theta) inside the contact, and inverse squares towards the infinite ends, where p falls
// like s^4 and faster. The gap's integrals are those of ehl_kernel.c.
//
// Left out: anything but the half-plane; unequal far pressures are given the tilt of
// docs/verification.md (the dry contact stays |x| < b).
#include "engine/film/ehl_mesh.h"

#include "engine/numeric/legendre.h"

#include <cblas.h>
#include <gsl/gsl_sf_legendre.h>
#include <math.h>
#include <string.h>

static const double INVERSE_PI = 0.31830988618379067;

void sb_ehl_tables_init(SbEhlTables *tables) {
  sb_legendre_gauss(tables->fine, tables->fine_weight, SB_EHL_QUAD);
  for (int q = 0; q < SB_EHL_QUAD; q++) {
    (void)gsl_sf_legendre_Pl_array(SB_EHL_PROJECT, tables->fine[q], tables->fine_legendre[q]);
  }
}

// Tables of a degree, made on first use.
static SbEhlTable *table_of(SbEhlTables *tables, int degree) {
  SbEhlTable *t = &tables->table[degree];
  if (t->ready) {
    return t;
  }
  t->degree = degree;
  int count = degree + 1;
  sb_legendre_lobatto(t->node, degree);
  sb_barycentric_weights(t->bary, t->node, count);
  for (int rule = 0; rule < 2; rule++) {
    int points = degree + rule;
    sb_legendre_gauss(t->gauss[rule], t->weight[rule], points);
    for (int i = 0; i < points; i++) {
      sb_barycentric_basis(t->value[rule][i], t->gauss[rule][i], t->node, t->bary, count);
      sb_barycentric_slope(t->slope[rule][i], t->gauss[rule][i], t->node, t->bary, count);
    }
  }
  for (int q = 0; q < SB_EHL_QUAD; q++) {
    sb_barycentric_basis(t->fine[q], tables->fine[q], t->node, t->bary, count);
  }
  // Points of the gap: both ends and the Gauss points, or one end and one more Gauss point.
  for (int kind = 0; kind < 3; kind++) {
    int rule = kind > 0 ? 1 : 0;
    t->gap_node[kind][0] = -1.0;
    memcpy(&t->gap_node[kind][kind != 1], t->gauss[rule], (size_t)(degree + rule) * sizeof(double));
    t->gap_node[kind][degree + 1] = kind != 2 ? 1.0 : t->gap_node[kind][degree + 1];
    sb_barycentric_weights(t->gap_bary[kind], t->gap_node[kind], degree + 2);
  }
  t->ready = true;
  return t;
}

void sb_ehl_partial(double *weight, const SbEhlTable *t, int j, double r) {
  double gauss[SB_EHL_DEGREE_MAX], w[SB_EHL_DEGREE_MAX];
  int points = t->degree / 2 + 1;
  sb_legendre_gauss(gauss, w, points);
  double half = 0.5 * (r - t->node[j]);
  memset(weight, 0, (size_t)(t->degree + 1) * sizeof *weight);
  for (int g = 0; g < points; g++) {
    double basis[SB_EHL_DEGREE_MAX + 1];
    sb_barycentric_basis(basis, t->node[j] + half * (1.0 + gauss[g]), t->node, t->bary,
                         t->degree + 1);
    for (int k = 0; k <= t->degree; k++) {
      weight[k] += half * w[g] * basis[k];
    }
  }
}

const SbEhlTable *sb_ehl_steps(SbEhlTables *tables, int degree) {
  SbEhlTable *t = table_of(tables, degree);
  for (int i = 0; i <= degree && !t->stepped; i++) {
    sb_barycentric_slope(t->node_slope[i], t->node[i], t->node, t->bary, degree + 1);
    if (i < degree) {
      sb_ehl_partial(t->step[i], t, i, t->node[i + 1]);
    }
  }
  t->stepped = true;
  return t;
}

double sb_ehl_interpolate(const SbEhlTable *t, const double *value, double r) {
  double basis[SB_EHL_DEGREE_MAX + 1];
  sb_barycentric_basis(basis, r, t->node, t->bary, t->degree + 1);
  double sum = 0.0;
  for (int k = 0; k <= t->degree; k++) {
    sum += basis[k] * value[k];
  }
  return sum;
}

// ---------------------------------------------------------------- maps

double sb_ehl_position(const SbEhlElement *e, double r) {
  double s = sb_ehl_inverse(e, r);
  return e->map == SB_EHL_AFFINE   ? e->m + e->h * r
         : e->map == SB_EHL_COSINE ? -cos(e->m + e->h * r)
                                   : e->A + e->side * e->B / (s * s);
}

double sb_ehl_stretch(const SbEhlElement *e, double r) {
  double s = sb_ehl_inverse(e, r);
  return e->map == SB_EHL_AFFINE   ? e->h
         : e->map == SB_EHL_COSINE ? e->h * sin(e->m + e->h * r)
                                   : e->B / (s * s * s);
}

double sb_ehl_coordinate(const SbEhlElement *e, double X) {
  return e->map == SB_EHL_AFFINE   ? (X - e->m) / e->h
         : e->map == SB_EHL_COSINE ? (acos(fmin(fmax(-X, -1.0), 1.0)) - e->m) / e->h
                                   : e->side * (1.0 - 2.0 * sqrt(e->B / fabs(X - e->A)));
}

int sb_ehl_find(const SbEhlMesh *mesh, double X) {
  int i = 0;
  while (i < mesh->count - 1 && !(X < mesh->element[i].x1)) {
    i++;
  }
  return i;
}

// Factor of the nodal polynomial in the pressure.
static double factor_at(const SbEhlElement *e, double r) {
  double s = sb_ehl_inverse(e, r);
  return e->side != 0 ? s * s * s * s : 1.0;
}

// Coordinate of a node, for the one at infinity that of its neighbour.
static double node_at(const SbEhlElement *e, int k) {
  bool infinite = e->side != 0 && k == e->degree - sb_ehl_touching(e);
  return e->table->node[infinite ? k - e->side : k];
}

double sb_ehl_node(const SbEhlElement *e, int k) {
  return sb_ehl_position(e, node_at(e, k));
}

double sb_ehl_nodal(const SbEhlElement *e, int k, double pressure) {
  return k == sb_ehl_touching(e) ? pressure
                                 : (pressure - e->far_pressure) / factor_at(e, node_at(e, k));
}

void sb_ehl_local(SbEhlLocal *out, const SbEhlElement *e, const double *basis, const double *rise,
                  double r) {
  double stretch = sb_ehl_stretch(e, r);
  double s = sb_ehl_inverse(e, r);
  double factor = factor_at(e, r);
  double factor_rise = -2.0 * e->side * s * s * s;
  for (int k = 0; k <= e->degree; k++) {
    out->value[k] = factor * basis[k];
    out->slope[k] = rise != NULL ? (factor * rise[k] + factor_rise * basis[k]) / stretch : 0.0;
  }
}

// ---------------------------------------------------------------- meshes

void sb_ehl_mesh_begin(SbEhlMesh *mesh, double start, double inlet_pressure,
                       double outlet_pressure) {
  mesh->count = 0;
  mesh->fits = true;
  mesh->end = start;
  mesh->apart = true;
  mesh->film_end = -1;
  mesh->dofs = 0;
  mesh->rows = 0;
  mesh->inlet_pressure = inlet_pressure;
  mesh->outlet_pressure = outlet_pressure;
}

// The next element, with its unknowns; NULL if it does not fit.
static SbEhlElement *next_element(SbEhlMesh *mesh, SbEhlMap map, int degree) {
  int first = mesh->apart ? mesh->dofs : mesh->dofs - 1;
  int points = degree + (map == SB_EHL_FAR);
  mesh->fits = mesh->fits && degree <= SB_EHL_DEGREE_MAX && mesh->count < SB_EHL_ELEMENTS_MAX &&
               first + degree + 1 <= SB_EHL_DOFS_MAX && mesh->rows + points <= SB_EHL_DOFS_MAX;
  if (!mesh->fits) {
    return NULL;
  }
  SbEhlElement *e = &mesh->element[mesh->count];
  e->map = map;
  e->side = 0;
  e->degree = degree;
  e->table = table_of(mesh->tables, degree);
  e->points = points;
  e->apart = mesh->apart && mesh->count > 0;
  e->first_dof = first;
  e->first_row = mesh->rows;
  e->far_pressure = 0.0;
  mesh->film_end += mesh->film_end + 1 == mesh->count && !e->apart;
  mesh->count++;
  mesh->apart = false;
  mesh->dofs = first + degree + 1;
  mesh->rows += points;
  return e;
}

void sb_ehl_mesh_add(SbEhlMesh *mesh, SbEhlMap map, double end, int degree) {
  SbEhlElement *e = next_element(mesh, map, degree);
  if (e != NULL) {
    e->x0 = mesh->end;
    e->x1 = end;
    double begin = map == SB_EHL_COSINE ? acos(-e->x0) : e->x0;
    double last = map == SB_EHL_COSINE ? acos(-e->x1) : e->x1;
    e->m = 0.5 * (begin + last);
    e->h = 0.5 * (last - begin);
  }
  mesh->end = end;
}

void sb_ehl_mesh_add_far(SbEhlMesh *mesh, int side, double x, double B, int degree) {
  SbEhlElement *e = next_element(mesh, SB_EHL_FAR, degree);
  if (e != NULL) {
    e->side = side;
    e->x0 = e->x1 = x;
    e->A = x - side * B;
    e->B = B;
    e->far_pressure = side < 0 ? mesh->inlet_pressure : mesh->outlet_pressure;
  }
  mesh->end = x;
}

// The next target, in an element.
static int add_target(SbEhlMesh *mesh, int element, double X) {
  mesh->owner[mesh->targets] = element;
  mesh->x[mesh->targets] = X;
  return mesh->targets++;
}

// Position and owner of every target: collocation points, then ends.
static void place_targets(SbEhlMesh *mesh) {
  mesh->targets = 0;
  for (int i = 0; i < mesh->count; i++) {
    const SbEhlElement *e = &mesh->element[i];
    const SbEhlTable *t = e->table;
    int rule = e->points - e->degree;
    for (int k = 0; k < e->points; k++) {
      double r = t->gauss[rule][k];
      int row = add_target(mesh, i, sb_ehl_position(e, r));
      mesh->weight[row] = t->weight[rule][k] * sb_ehl_stretch(e, r);
      sb_ehl_local(&mesh->local[row], e, t->value[rule][k], t->slope[rule][k], r);
    }
  }
  // Ends: the left one is the right one of the element before, unless apart or first.
  int before = -1;
  for (int i = 0; i < mesh->count; i++) {
    SbEhlElement *e = &mesh->element[i];
    int *target = e->gap_target;
    if (e->side >= 0) {
      *target++ = before < 0 || e->apart ? add_target(mesh, i, e->x0) : before;
    }
    for (int k = 0; k < e->points; k++) {
      *target++ = e->first_row + k;
    }
    if (e->side <= 0) {
      *target = before = add_target(mesh, i, e->x1);
    }
  }
}

// The nodes for targets.
static void place_nodes(SbEhlMesh *mesh) {
  mesh->rows = mesh->targets = mesh->dofs;
  for (int i = 0; i < mesh->count; i++) {
    const SbEhlElement *e = &mesh->element[i];
    const SbEhlTable *t = e->table;
    for (int k = 0; k <= e->degree; k++) {
      mesh->x[e->first_dof + k] = sb_ehl_position(e, t->node[k]);
      mesh->owner[e->first_dof + k] = i;
    }
  }
}

// x (ln|x| - 1): the gap of a constant pressure on a half-line, up to tilt and constant.
static double half_line(double x) {
  return x == 0.0 ? 0.0 : x * (log(fabs(x)) - 1.0);
}

double sb_ehl_ambient_gap(double X, double left, double right, double inlet, double outlet) {
  return (inlet * half_line(X - left) - outlet * half_line(X - right) +
          (inlet - outlet) * log(2.0) * X) /
         M_PI;
}

bool sb_ehl_mesh_build(SbEhlMesh *mesh, bool nodal) {
  if (!mesh->fits) {
    return false;
  }
  for (int i = 0; i < mesh->count; i++) {
    sb_ehl_kernel_prepare(&mesh->element[i], mesh->tables);
  }
  (nodal ? place_nodes : place_targets)(mesh);
  const SbEhlElement *first = &mesh->element[0];
  const SbEhlElement *last = &mesh->element[mesh->count - 1];
  mesh->left_end = first->x0;
  mesh->right_end = last->x1;

  // Element by element, as its tables fill the nearest cache.
  memset(mesh->gap, 0, (size_t)mesh->targets * (size_t)mesh->dofs * sizeof *mesh->gap);
  for (int i = 0; i < mesh->targets; i++) {
    mesh->gap_known[i] = sb_ehl_ambient_gap(mesh->x[i], mesh->left_end, mesh->right_end,
                                            mesh->inlet_pressure, mesh->outlet_pressure);
    mesh->gap_by_end[0][i] =
        sb_ehl_ambient_gap(mesh->x[i], mesh->left_end, mesh->right_end, 1.0, 0.0);
    mesh->gap_by_end[1][i] =
        sb_ehl_ambient_gap(mesh->x[i], mesh->left_end, mesh->right_end, 0.0, 1.0);
  }
  for (int k = 0; k < mesh->count; k++) {
    const SbEhlElement *e = &mesh->element[k];
    for (int i = 0; i < mesh->targets; i++) {
      double *gap = mesh->gap + (size_t)i * (size_t)mesh->dofs + e->first_dof;
      double row[SB_EHL_DEGREE_MAX + 1] = {0};
      sb_ehl_kernel_row(row, e, mesh->tables, mesh->x[i]);
      for (int j = 0; j <= e->degree; j++) {
        gap[j] -= INVERSE_PI * row[j];
      }
      mesh->gap_known[i] += INVERSE_PI * e->far_pressure * row[sb_ehl_touching(e)];
      if (e->side != 0) {
        mesh->gap_by_end[e->side > 0][i] += INVERSE_PI * row[sb_ehl_touching(e)];
      }
    }
  }

  memset(mesh->load, 0, (size_t)mesh->dofs * sizeof(double));
  mesh->load_known = mesh->load_by_end[0] = mesh->load_by_end[1] = 0.0;
  for (int k = 0; k < mesh->count; k++) {
    const SbEhlElement *e = &mesh->element[k];
    for (int j = 0; j <= e->degree; j++) {
      mesh->load[e->first_dof + j] += e->integral[j];
    }
    mesh->load_known -= e->far_pressure * e->integral[sb_ehl_touching(e)];
    if (e->side != 0) {
      mesh->load_by_end[e->side > 0] -= e->integral[sb_ehl_touching(e)];
    }
  }
  return true;
}

void sb_ehl_mesh_ends(SbEhlMesh *mesh, double inlet_pressure, double outlet_pressure) {
  const double more[2] = {inlet_pressure - mesh->inlet_pressure,
                          outlet_pressure - mesh->outlet_pressure};
  for (int end = 0; end < 2; end++) {
    cblas_daxpy(mesh->targets, more[end], mesh->gap_by_end[end], 1, mesh->gap_known, 1);
    mesh->load_known += more[end] * mesh->load_by_end[end];
  }
  mesh->inlet_pressure = inlet_pressure;
  mesh->outlet_pressure = outlet_pressure;
  for (int i = 0; i < mesh->count; i++) {
    SbEhlElement *e = &mesh->element[i];
    e->far_pressure = e->side < 0 ? inlet_pressure : e->side > 0 ? outlet_pressure : 0.0;
  }
}

double sb_ehl_sum(double *slope, const SbEhlLocal *local, const SbEhlElement *e,
                  const double *nodal) {
  double sum = e->far_pressure * (1.0 - local->value[sb_ehl_touching(e)]);
  double rise = -e->far_pressure * local->slope[sb_ehl_touching(e)];
  for (int j = 0; j <= e->degree; j++) {
    sum += local->value[j] * nodal[e->first_dof + j];
    rise += local->slope[j] * nodal[e->first_dof + j];
  }
  if (slope != NULL) {
    *slope = rise;
  }
  return sum;
}

double sb_ehl_pressure(double *slope, const SbEhlElement *e, const double *nodal, double r) {
  const SbEhlTable *t = e->table;
  double basis[SB_EHL_DEGREE_MAX + 1], rise[SB_EHL_DEGREE_MAX + 1];
  sb_barycentric_basis(basis, r, t->node, t->bary, e->degree + 1);
  if (slope != NULL) {
    sb_barycentric_slope(rise, r, t->node, t->bary, e->degree + 1);
  }
  SbEhlLocal local;
  sb_ehl_local(&local, e, basis, slope != NULL ? rise : NULL, r);
  return sb_ehl_sum(slope, &local, e, nodal);
}

double sb_ehl_gap(const SbEhlElement *e, const double *target_gap, double r) {
  const SbEhlTable *t = e->table;
  int kind = e->side == 0 ? 0 : e->side < 0 ? 1 : 2;
  double basis[SB_EHL_DEGREE_MAX + 2];
  sb_barycentric_basis(basis, r, t->gap_node[kind], t->gap_bary[kind], e->degree + 2);
  double sum = 0.0;
  for (int k = 0; k < e->degree + 2; k++) {
    sum += basis[k] * target_gap[e->gap_target[k]] * factor_at(e, t->gap_node[kind][k]);
  }
  return sum / factor_at(e, r);
}
