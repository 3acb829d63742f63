// Graded triangle meshes of a circular section.
//
// Rows of triangles follow the surface inwards. Each row has as many vertices as its local size
// requires, so the mesh is fine under a contact and at its edges and coarse inside. A structured
// quadrilateral grid would continue the fine spacing through the section. The two halves share the
// axis of symmetry; equal plans give mirrored meshes. Own construction.
//
// Long: plan, rows, triangles and smoothing are steps of one construction on the same arrays.
#include "engine/contact/ring/ring_mesh.h"
#include "engine/numeric/root.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { LAYERS_MAX = 24, ROW_MAX = 2000, SAMPLES = 720, SMOOTHINGS = 4 };
enum { VERTEX_MAX = 2 * LAYERS_MAX * ROW_MAX };

// Smallest shape of a triangle that a mesh may have, and trial parameters of rows: number of added
// rows and how strongly their depth follows the surface size.
static const double QUALITY_LEAST = 0.35;
static const struct {
  int rows;
  double follow;
} TRIAL[] = {{0, 0.5}, {1, 0.5}, {0, 0.3}, {1, 0.3}, {-1, 0.5}, {2, 0.3}, {0, 0.15}, {1, 0.0}};

// Wanted size on the surface at an angle of one half (sign +1 right, -1 left).
static double surface_size(const SbRingMeshPlan *plan, double angle, double growth) {
  double size = plan->size_max;
  for (int i = 0; i < plan->zone_count; i++) {
    const SbRingZone *zone = &plan->zone[i];
    // The angle and its turn by 2 pi, so that a zone may straddle the floor at +-pi.
    double away = INFINITY;
    for (int turn = -1; turn <= 1; turn++) {
      double a = angle + turn * 2.0 * M_PI;
      away = fmin(away, fmax(0.0, fmax(zone->from - a, a - zone->to)));
    }
    size = fmin(size, zone->size + growth * plan->radius * away);
  }
  return size;
}

// Geometric rows: the depth that m of them leave of the total with a ratio q.
typedef struct {
  double first, total;
  int m;
} Rows;

static double depth_left(double q, const void *context) {
  const Rows *rows = context;
  double left = rows->total, t = rows->first;
  for (int k = 0; k < rows->m; k++) {
    left -= t;
    t *= q;
  }
  return left;
}

// Depth below the surface after k of m rows, the first as thick as the surface size, geometric.
static void row_depths(double *depth, double first, double total, int m) {
  const Rows rows = {first, total, m};
  double q = sb_bisect(depth_left, &rows, 0.3, 6.0), sum = 0.0, t = first;
  depth[0] = 0.0;
  for (int k = 0; k < m; k++) {
    sum += t;
    depth[k + 1] = sum;
    t *= q;
  }
  for (int k = 1; k <= m; k++) {
    depth[k] *= total / sum;
  }
}

// Surroundings of a vertex: the other corners of its triangles, their worst shape before and after
// a move.
typedef struct {
  int spokes;
  double sum[2], worst[2];
} Neighbours;

// Everything that is needed while one mesh is built.
typedef struct {
  const SbRingMeshPlan *plan;
  double follow; // share of the surface's growth that the rows' depth follows
  SbRingMesh *mesh;
  int vertex_count, surface_count; // the first vertices are those on the surface
  double vertex[2 * VERTEX_MAX];
  Neighbours neighbours[VERTEX_MAX];
  double size[2][SAMPLES + 1], depth[2][SAMPLES + 1][LAYERS_MAX + 1], cumulative[SAMPLES + 1];
  int row_count[2][LAYERS_MAX + 1];
  int row[2][LAYERS_MAX + 1][ROW_MAX + 1]; // vertices of each row and half, from bore to floor
  int element[2][ROW_MAX];                 // at the surface, between two of these vertices
} Builder;

static int add_vertex(Builder *b, double r, double z) {
  b->vertex[2 * b->vertex_count] = r;
  b->vertex[2 * b->vertex_count + 1] = z;
  return b->vertex_count++;
}

// Fills the depths of all rows at all sampled angles of one half.
static void sample_depths(Builder *b, int half) {
  const SbRingMeshPlan *plan = b->plan;
  double last = -1.0;
  for (int i = 0; i <= SAMPLES; i++) {
    double angle = (half == 0 ? M_PI : -M_PI) * i / SAMPLES;
    b->size[half][i] = surface_size(plan, angle, plan->growth);
    // Rows must not follow every change of the surface size, or coarse inner rows would cross them.
    double size = surface_size(plan, angle, b->follow * plan->growth);
    if (size == last) {
      memcpy(b->depth[half][i], b->depth[half][i - 1], sizeof b->depth[half][i]);
    } else {
      row_depths(b->depth[half][i], size, plan->radius, plan->layers);
    }
    last = size;
  }
}

// Angles where the surface row must have a vertex: both ends of the half and what the plan names.
static int list_breaks(const SbRingMeshPlan *plan, int half, int k, double *at) {
  int count = 0;
  at[count++] = 0.0;
  for (int i = 0; k == 0 && i < plan->vertex_count; i++) {
    double angle = half == 0 ? plan->vertex[i] : -plan->vertex[i];
    if (angle > 1e-3 && angle < M_PI - 1e-3) {
      int j = count++;
      for (; j > 1 && at[j - 1] > angle; j--) {
        at[j] = at[j - 1];
      }
      at[j] = angle;
    }
  }
  at[count++] = M_PI;
  return count;
}

// Integral of 1/size from the bore to an angle, from the samples.
static double cumulative_at(const double *cumulative, double angle) {
  double place = angle / M_PI * SAMPLES;
  int i = (int)fmin(SAMPLES - 1, floor(place));
  return cumulative[i] + (place - i) * (cumulative[i + 1] - cumulative[i]);
}

// Places the vertices of one row of one half by equal shares of the integral of 1/size.
// The left half borrows the right half's vertices on the axis.
static void place_row(Builder *b, int half, int k) {
  const SbRingMeshPlan *plan = b->plan;
  double sign = half == 0 ? 1.0 : -1.0;
  double *cumulative = b->cumulative;
  double before = 0.0;
  cumulative[0] = 0.0;
  for (int i = 0; i <= SAMPLES; i++) {
    const double *depth = b->depth[half][i];
    double size = k == 0 ? b->size[half][i] : 0.5 * (depth[k + 1] - depth[k - 1]);
    double density = (plan->radius - depth[k]) / size;
    if (i > 0) {
      cumulative[i] = cumulative[i - 1] + 0.5 * (density + before) * M_PI / SAMPLES;
    }
    before = density;
  }
  double breaks[SB_RING_VERTICES_MAX + 2];
  int break_count = list_breaks(plan, half, k, breaks);
  int *row = b->row[half][k];
  int count = 0, at = 0;
  for (int s = 0; s + 1 < break_count; s++) {
    double c0 = cumulative_at(cumulative, breaks[s]), c1 = cumulative_at(cumulative, breaks[s + 1]);
    int n = (int)fmax(break_count == 2 ? 2.0 : 1.0, floor(c1 - c0 + 0.5));
    n = n > ROW_MAX / SB_RING_VERTICES_MAX ? ROW_MAX / SB_RING_VERTICES_MAX : n;
    for (int j = 0; j < n; j++) {
      double want = c0 + (c1 - c0) * j / n;
      while (at < SAMPLES - 1 && cumulative[at + 1] < want) {
        at++;
      }
      double part = (want - cumulative[at]) / (cumulative[at + 1] - cumulative[at]);
      double angle = j == 0 ? breaks[s] : M_PI * (at + fmin(1.0, fmax(0.0, part))) / SAMPLES;
      part = angle / M_PI * SAMPLES - at;
      double radius = plan->radius - b->depth[half][at][k] -
                      part * (b->depth[half][at + 1][k] - b->depth[half][at][k]);
      bool axis = s == 0 && j == 0;
      row[count++] = axis && half == 1 ? b->row[0][k][0]
                                       : add_vertex(b, plan->centre + radius * cos(angle),
                                                    axis ? 0.0 : sign * radius * sin(angle));
    }
  }
  row[count++] = half == 1
                     ? b->row[0][k][b->row_count[0][k] - 1]
                     : add_vertex(b, plan->centre - plan->radius + b->depth[half][SAMPLES][k], 0.0);
  b->row_count[half][k] = count;
}

// Shape of a triangle: 1 equilateral, 0 flat, negative if wound clockwise in (r, z).
static double quality(const double *a, const double *b, const double *c) {
  double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
  double sides = (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) +
                 (c[0] - b[0]) * (c[0] - b[0]) + (c[1] - b[1]) * (c[1] - b[1]) +
                 (a[0] - c[0]) * (a[0] - c[0]) + (a[1] - c[1]) * (a[1] - c[1]);
  return 2.0 * sqrt(3.0) * area / sides;
}

int sb_ring_mesh_add(SbRingMesh *mesh, int a, int b, int c) {
  memcpy(&mesh->tri[6 * mesh->elements], (int[3]){a, b, c}, sizeof(int[3]));
  return mesh->elements++;
}

static double distance2(const double *a, const double *b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

// Joins an outer and an inner row: the shorter of the two possible diagonals, unless its triangle
// would be flat and the other not.
static void stitch(Builder *b, int half, int k) {
  int *outer = b->row[half][k], *inner = b->row[half][k + 1];
  int no = b->row_count[half][k], ni = b->row_count[half][k + 1];
  const double *v = b->vertex;
  double sign = half == 0 ? 1.0 : -1.0;
  int i = 0, j = 0;
  while (i < no - 1 || j < ni - 1) {
    bool step_outer = j == ni - 1;
    const double *o = &v[2 * outer[i]], *n = &v[2 * inner[j]];
    if (i < no - 1 && j < ni - 1) {
      const double *o1 = &v[2 * outer[i + 1]], *n1 = &v[2 * inner[j + 1]];
      bool outer_flat = sign * quality(o, o1, n) < 0.1, inner_flat = sign * quality(o, n1, n) < 0.1;
      step_outer = outer_flat == inner_flat ? distance2(o1, n) <= distance2(o, n1) : inner_flat;
    }
    // Counter-clockwise in (r, z).
    int next = step_outer ? outer[i + 1] : inner[j + 1];
    int element = half == 0 ? sb_ring_mesh_add(b->mesh, outer[i], next, inner[j])
                            : sb_ring_mesh_add(b->mesh, outer[i], inner[j], next);
    if (k == 0 && step_outer) {
      b->element[half][i] = element;
    }
    i += step_outer ? 1 : 0;
    j += step_outer ? 0 : 1;
  }
}

// Moves inner vertices to the mean of their neighbours (half of the distance, because the
// neighbours move too) if that improves their worst triangle.
static void smooth(Builder *b) {
  SbRingMesh *mesh = b->mesh;
  double *x = mesh->x, *moved = b->vertex; // the builder's own copy takes the new places
  for (int sweep = 0; sweep < SMOOTHINGS; sweep++) {
    for (int v = 0; v < b->vertex_count; v++) {
      b->neighbours[v] = (Neighbours){.worst = {1.0, 1.0}};
    }
    for (int pass = 0; pass < 2; pass++) {
      for (int i = 0; i < 3 * mesh->elements; i++) {
        const int *tri = &mesh->tri[i / 3 * 6];
        int v = tri[i % 3];
        const double *at = pass == 0 ? &x[2 * v] : &moved[2 * v];
        const double *p = &x[2 * tri[(i + 1) % 3]], *q = &x[2 * tri[(i + 2) % 3]];
        Neighbours *n = &b->neighbours[v];
        n->spokes += 2;
        n->sum[0] += p[0] + q[0];
        n->sum[1] += p[1] + q[1];
        n->worst[pass] = fmin(n->worst[pass], quality(at, p, q));
      }
      for (int v = 0; v < b->vertex_count && pass == 0; v++) {
        const Neighbours *n = &b->neighbours[v];
        moved[2 * v] = 0.5 * (x[2 * v] + n->sum[0] / n->spokes);
        moved[2 * v + 1] = x[2 * v + 1] == 0.0 ? 0.0 : 0.5 * (x[2 * v + 1] + n->sum[1] / n->spokes);
      }
    }
    for (int v = b->surface_count; v < b->vertex_count; v++) {
      if (b->neighbours[v].worst[1] > b->neighbours[v].worst[0]) {
        memcpy(&x[2 * v], &moved[2 * v], sizeof(double[2]));
      }
    }
  }
}

// A triangle's side: its two vertices and the place of its mid-side node.
typedef struct {
  int vertex[2], at;
} Side;

static int compare_sides(const void *a, const void *b) {
  const int *p = ((const Side *)a)->vertex, *q = ((const Side *)b)->vertex;
  return p[0] != q[0] ? (p[0] > q[0]) - (p[0] < q[0]) : (p[1] > q[1]) - (p[1] < q[1]);
}

// Adds the mid-side nodes of all triangles; straight ones, the caller bends the boundary.
SbStatus sb_ring_mesh_add_midsides(SbRingMesh *mesh, SbReport *report) {
  int sides = 3 * mesh->elements;
  Side *side = malloc(sizeof *side * (size_t)sides);
  if (side == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's mesh");
  }
  for (int i = 0; i < sides; i++) {
    const int *tri = &mesh->tri[i / 3 * 6];
    int a = tri[i % 3], c = tri[(i + 1) % 3];
    side[i] = (Side){{a < c ? a : c, a < c ? c : a}, i / 3 * 6 + 3 + i % 3};
  }
  qsort(side, (size_t)sides, sizeof *side, compare_sides);
  for (int i = 0; i < sides; i++) {
    if (i == 0 || compare_sides(&side[i], &side[i - 1]) != 0) {
      const double *a = &mesh->x[2 * side[i].vertex[0]], *c = &mesh->x[2 * side[i].vertex[1]];
      mesh->x[2 * mesh->nodes] = 0.5 * (a[0] + c[0]);
      mesh->x[2 * mesh->nodes++ + 1] = 0.5 * (a[1] + c[1]);
    }
    mesh->tri[side[i].at] = mesh->nodes - 1;
  }
  free(side);
  return SB_OK;
}

SbRingMesh *sb_ring_mesh_allocate(int vertices, int triangles, int loop) {
  SbRingMesh *mesh = calloc(1, sizeof *mesh);
  if (mesh == NULL) {
    return NULL;
  }
  // Euler: fewer sides than vertices + triangles.
  size_t nodes = 2 * (size_t)vertices + (size_t)triangles + 8;
  mesh->x = calloc(2 * nodes, sizeof(double));
  mesh->tri = calloc(6 * (size_t)triangles, sizeof(int));
  mesh->loop = calloc((size_t)loop + 1, sizeof(int));
  mesh->angle = calloc((size_t)loop + 1, sizeof(double));
  if (mesh->x == NULL || mesh->tri == NULL || mesh->loop == NULL || mesh->angle == NULL) {
    sb_ring_mesh_destroy(mesh);
    return NULL;
  }
  return mesh;
}

void sb_ring_mesh_destroy(SbRingMesh *mesh) {
  if (mesh != NULL) {
    free(mesh->x);
    free(mesh->tri);
    free(mesh->loop);
    free(mesh->angle);
    free(mesh);
  }
}

// Lists the boundary from the floor over the left flank to the bore and on, and bends its sides.
static void close_loop(Builder *b) {
  SbRingMesh *mesh = b->mesh;
  int left = b->row_count[1][0] - 1, count = left + b->row_count[0][0] - 1;
  mesh->loop_count = 2 * count;
  for (int i = 0; i < count; i++) {
    int half = i < left ? 1 : 0, side = half == 1 ? left - 1 - i : i - left;
    int vertex = b->row[half][0][side + half];
    const int *tri = &mesh->tri[6 * b->element[half][side]];
    mesh->loop[2 * i] = vertex;
    mesh->loop[2 * i + 1] = half == 0 ? tri[3] : tri[5];
    const double *x = &mesh->x[2 * vertex];
    mesh->angle[2 * i] = i == 0 ? -M_PI : atan2(x[1], x[0] - b->plan->centre);
  }
  for (int i = 1; i < 2 * count; i += 2) {
    double next = i + 1 < 2 * count ? mesh->angle[i + 1] : M_PI;
    double angle = mesh->angle[i] = 0.5 * (mesh->angle[i - 1] + next);
    mesh->x[2 * mesh->loop[i]] = b->plan->centre + b->plan->radius * cos(angle);
    mesh->x[2 * mesh->loop[i] + 1] = b->plan->radius * sin(angle);
  }
}

static SbStatus build(SbRingMesh **out, Builder *b) {
  const SbRingMeshPlan *plan = b->plan;
  // Vertices, row by row.
  int segments = 0;
  for (int k = 0; k < plan->layers; k++) {
    for (int half = 0; half < 2; half++) {
      if (k == 0) {
        sample_depths(b, half);
      }
      place_row(b, half, k);
      segments += b->row_count[half][k];
    }
    b->surface_count = k == 0 ? b->vertex_count : b->surface_count;
  }
  int centre = add_vertex(b, plan->centre, 0.0), loop = 2 * b->surface_count + 4;
  for (int half = 0; half < 2; half++) {
    b->row[half][plan->layers][0] = centre;
    b->row_count[half][plan->layers] = 1;
  }

  // Triangles, mid-sides, boundary.
  SbRingMesh *mesh = b->mesh = sb_ring_mesh_allocate(b->vertex_count, 2 * segments, loop);
  if (mesh == NULL) {
    return SB_ERROR_MEMORY;
  }
  for (int half = 0; half < 2; half++) {
    for (int k = 0; k < plan->layers; k++) {
      stitch(b, half, k);
    }
  }
  memcpy(mesh->x, b->vertex, sizeof(double) * 2 * (size_t)b->vertex_count);
  mesh->nodes = b->vertex_count;
  smooth(b);
  if (sb_ring_mesh_add_midsides(mesh, NULL) != SB_OK) {
    sb_ring_mesh_destroy(mesh);
    return SB_ERROR_MEMORY;
  }
  close_loop(b);
  mesh->arc[0] = mesh->arc[1] = plan->radius;
  *out = mesh;
  return SB_OK;
}

// Returns the smallest triangle shape; negative if a triangle is inverted.
static double worst_quality(const SbRingMesh *mesh) {
  double worst = 1.0;
  for (int e = 0; e < mesh->elements; e++) {
    const int *tri = &mesh->tri[6 * e];
    const double *x = mesh->x;
    worst = fmin(worst, quality(&x[2 * tri[0]], &x[2 * tri[1]], &x[2 * tri[2]]));
  }
  return worst;
}

SbStatus sb_ring_mesh_create(SbRingMesh **out, const SbRingMeshPlan *plan, SbReport *report) {
  *out = NULL;
  if (plan->outline != NULL) {
    return sb_ring_triangles_create(out, plan, report);
  }
  if (plan->layers < 3 || plan->layers + 3 >= LAYERS_MAX || !(plan->size_max > 0.0)) {
    return sb_fail(report, SB_ERROR_INPUT, "ring mesh with %d rows, size %g", plan->layers,
                   plan->size_max);
  }
  // The first trial is nearly always good; the best one is used.
  double best = 0.0;
  for (size_t i = 0; i < sizeof TRIAL / sizeof TRIAL[0] && best < QUALITY_LEAST; i++) {
    SbRingMeshPlan trial = *plan;
    trial.layers += TRIAL[i].rows;
    SbRingMesh *mesh = NULL;
    Builder *b = malloc(sizeof *b); // a mesh fills a small part of it
    SbStatus status = SB_ERROR_MEMORY;
    if (b != NULL) {
      b->vertex_count = b->surface_count = 0;
      b->plan = &trial;
      b->follow = TRIAL[i].follow;
      status = build(&mesh, b);
    }
    free(b);
    if (status != SB_OK) {
      sb_ring_mesh_destroy(*out);
      *out = NULL;
      return sb_fail(report, status, "no memory for the ring's mesh");
    }
    double worst = worst_quality(mesh);
    bool better = worst > best;
    sb_ring_mesh_destroy(better ? *out : mesh);
    *out = better ? mesh : *out;
    best = fmax(best, worst);
  }
  return *out != NULL ? sb_succeed(report)
                      : sb_fail(report, SB_ERROR_NOT_CONVERGED, "no ring mesh with these zones");
}

// From angle 0, on to the right half.
static double arc_from_bore(const SbRingMesh *mesh, double angle) {
  const double turns = floor((angle + M_PI) / (2.0 * M_PI)), rest = angle - 2.0 * M_PI * turns;
  return turns * M_PI * (mesh->arc[0] + mesh->arc[1]) + rest * mesh->arc[rest < 0.0 ? 0 : 1];
}

double sb_ring_mesh_arc(const SbRingMesh *mesh, double from, double to) {
  return arc_from_bore(mesh, to) - arc_from_bore(mesh, from);
}

SbStatus sb_ring_mesh_mirror(SbRingMesh **out, const SbRingMesh *mesh, SbReport *report) {
  static const int CORNER[6] = {0, 2, 1, 5, 4, 3};
  const int count = mesh->loop_count;
  SbRingMesh *mirror = *out = sb_ring_mesh_allocate(mesh->nodes, mesh->elements, count);
  if (mirror == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's mesh");
  }
  mirror->nodes = mesh->nodes;
  mirror->elements = mesh->elements;
  mirror->loop_count = count;
  mirror->arc[0] = mesh->arc[1];
  mirror->arc[1] = mesh->arc[0];
  for (int i = 0; i < mesh->nodes; i++) {
    mirror->x[2 * i] = mesh->x[2 * i];
    mirror->x[2 * i + 1] = -mesh->x[2 * i + 1];
  }
  for (int i = 0; i < 6 * mesh->elements; i++) {
    mirror->tri[i] = mesh->tri[i / 6 * 6 + CORNER[i % 6]];
  }
  for (int i = 0; i < count; i++) {
    int at = (count - i) % count;
    mirror->loop[i] = mesh->loop[at];
    mirror->angle[i] = i == 0 ? mesh->angle[0] : -mesh->angle[at];
  }
  return SB_OK;
}

SbStatus sb_ring_mesh_copy(SbRingMesh **out, const SbRingMesh *mesh, double shift,
                           SbReport *report) {
  SbRingMesh *copy = *out = sb_ring_mesh_allocate(mesh->nodes, mesh->elements, mesh->loop_count);
  if (copy == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's mesh");
  }
  copy->nodes = mesh->nodes;
  copy->elements = mesh->elements;
  copy->loop_count = mesh->loop_count;
  memcpy(copy->arc, mesh->arc, sizeof copy->arc);
  for (int i = 0; i < 2 * mesh->nodes; i++) {
    copy->x[i] = mesh->x[i] + (i % 2 == 0 ? shift : 0.0);
  }
  memcpy(copy->tri, mesh->tri, sizeof *copy->tri * 6 * (size_t)mesh->elements);
  memcpy(copy->loop, mesh->loop, sizeof *copy->loop * (size_t)mesh->loop_count);
  memcpy(copy->angle, mesh->angle, sizeof *copy->angle * (size_t)mesh->loop_count);
  return SB_OK;
}

void sb_ring_side_at(const double v[3], double wanted, double n[3], double d[3]) {
  double xi = 2.0 * (wanted - v[0]) / (v[2] - v[0]) - 1.0;
  for (int i = 0; i < 6; i++) {
    sb_ring_side_shape(xi, n, d);
    xi -= (sb_ring_side_sum(n, v) - wanted) / sb_ring_side_sum(d, v);
  }
  sb_ring_side_shape(xi, n, d);
}

void sb_ring_shape(double l1, double l2, double n[6], double dn1[6], double dn2[6]) {
  double l0 = 1.0 - l1 - l2;
  n[0] = l0 * (2.0 * l0 - 1.0);
  n[1] = l1 * (2.0 * l1 - 1.0);
  n[2] = l2 * (2.0 * l2 - 1.0);
  n[3] = 4.0 * l0 * l1;
  n[4] = 4.0 * l1 * l2;
  n[5] = 4.0 * l2 * l0;
  dn1[0] = 1.0 - 4.0 * l0;
  dn1[1] = 4.0 * l1 - 1.0;
  dn1[2] = 0.0;
  dn1[3] = 4.0 * (l0 - l1);
  dn1[4] = 4.0 * l2;
  dn1[5] = -4.0 * l2;
  dn2[0] = 1.0 - 4.0 * l0;
  dn2[1] = 0.0;
  dn2[2] = 4.0 * l2 - 1.0;
  dn2[3] = -4.0 * l1;
  dn2[4] = 4.0 * l1;
  dn2[5] = 4.0 * (l0 - l2);
}

int sb_ring_mesh_locate(const SbRingMesh *mesh, const double x[2], int near, double *l1,
                        double *l2) {
  int best = 0;
  double best_out = INFINITY;
  // To both sides of the nearby one.
  for (int k = 0; k < 2 * mesh->elements; k++) {
    int e = near + (k % 2 == 0 ? k / 2 : -1 - k / 2);
    if (e < 0 || e >= mesh->elements) {
      continue;
    }
    const int *tri = &mesh->tri[6 * e];
    const double *a = &mesh->x[2 * tri[0]], *b = &mesh->x[2 * tri[1]], *c = &mesh->x[2 * tri[2]];
    double d11 = b[0] - a[0], d12 = c[0] - a[0], d21 = b[1] - a[1], d22 = c[1] - a[1];
    double det = d11 * d22 - d12 * d21;
    double m1 = ((x[0] - a[0]) * d22 - (x[1] - a[1]) * d12) / det;
    double m2 = ((x[1] - a[1]) * d11 - (x[0] - a[0]) * d21) / det;
    double out = fmax(fmax(-m1, -m2), m1 + m2 - 1.0);
    if (out < best_out) {
      best_out = out;
      best = e;
      *l1 = m1;
      *l2 = m2;
      if (out <= 0.0) {
        break;
      }
    }
  }
  return best;
}
