// Graded triangle meshes of any outline.
//
// First the boundary vertices, spaced as the zones require, more densely where the outline bends or
// the body is thin. Then Delaunay's triangulation of them (Bowyer and Watson 1981), refined at the
// centres of triangles larger than the local size, but not within the circle over a boundary side
// (Ruppert 1995), so that every side remains an edge. Then inner vertices are moved to the mean of
// their neighbours, and edges are swapped, if that improves the worst triangle. Own construction.
// The mesh of a symmetric outline is not symmetric.
//
// Long: boundary, triangulation, refinement and smoothing are steps on one set of triangles.
#include "engine/contact/ring/ring_mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 900, BOUNDARY_MAX = 3000, POINTS_MAX = 24000, SWEEPS = 6, BREAKS_MAX = 160 };
enum { TRIANGLES_MAX = 2 * POINTS_MAX + 16, CAVITY_MAX = 1024 };

// Largest angle of an arc's side [rad]; smallest number of sides across a thin part; smallest
// distance of two positions of a vertex divided by the local size; largest circumradius of a
// triangle divided by the size.
static const double TURN_MOST = 0.5, ACROSS = 3.0, NEAR = 0.4, RADIUS_MOST = 0.7;

// Smallest shape of a triangle that a mesh may have.
static const double SHAPE_LEAST = 0.15;

typedef struct {
  int v[3], beside[3]; // beside[k] across the side v[k] .. v[k + 1]; -1: none
  double over;         // circumradius over what is allowed; < 0: not to be refined
  bool dead, inside;
} Triangle;

typedef struct {
  const SbRingMeshPlan *plan;
  double place[SAMPLES][2], size[SAMPLES], cumulative[SAMPLES + 1];
  int sides;                    // boundary vertices
  double arc[BOUNDARY_MAX];     // of these
  double split[BOUNDARY_MAX];   // and those of half sides
  double spacing[BOUNDARY_MAX]; // mean of both sides
  int points;                   // boundary vertices first, three far ones last
  double x[POINTS_MAX][2];      // slightly displaced, so that no four are on a circle
  int triangles, cavity_count;
  Triangle t[TRIANGLES_MAX];
  int cavity[CAVITY_MAX], rim[CAVITY_MAX][3],
      rim_count; // of the point to come: edges and what is beyond
  int stack[TRIANGLES_MAX];
} Builder;

// ---- boundary

static double zone_size(const SbRingMeshPlan *plan, double arc) {
  const double length = plan->outline->length;
  double size = plan->size_max;
  for (int i = 0; i < plan->zone_count; i++) {
    const SbRingZone *zone = &plan->zone[i];
    double from = sb_ring_outline_arc(plan->outline, zone->from);
    double to = sb_ring_outline_arc(plan->outline, zone->to), away = INFINITY;
    for (int turn = -2; turn <= 2; turn++) {
      double at = arc + turn * length;
      away = fmin(away, fmax(0.0, fmax(from - at, at - to)));
    }
    size = fmin(size, zone->size + plan->growth * away);
  }
  return size;
}

// The size at evenly spaced places, by zones, bends and thin parts, growing no faster than allowed.
static void sample_sizes(Builder *b) {
  const SbRingMeshPlan *plan = b->plan;
  const SbRingOutline *outline = plan->outline;
  const double step = outline->length / SAMPLES;
  for (int i = 0; i < SAMPLES; i++) {
    sb_ring_outline_place(outline, i * step, b->place[i]);
    b->size[i] = zone_size(plan, i * step);
  }
  for (int i = 0; i < outline->count; i++) {
    const SbRingOutlinePart *part = &outline->part[i];
    for (int k = (int)ceil(part->at / step); part->radius > 0.0 && k < SAMPLES; k++) {
      if (k * step > part->at + part->length) {
        break;
      }
      b->size[k] = fmin(b->size[k], TURN_MOST * part->radius);
    }
  }
  for (int i = 0; i < SAMPLES; i++) {
    const double *x = b->place[i], *next = b->place[(i + 1) % SAMPLES];
    for (int k = 0; k < SAMPLES; k++) {
      // Across the body: to the left of the direction, and facing it.
      const double *y = b->place[k], *beyond = b->place[(k + 1) % SAMPLES];
      double u[2] = {next[0] - x[0], next[1] - x[1]}, v[2] = {beyond[0] - y[0], beyond[1] - y[1]};
      double w[2] = {y[0] - x[0], y[1] - x[1]}, away = hypot(w[0], w[1]);
      if (u[0] * v[0] + u[1] * v[1] < -0.3 * step * step &&
          u[0] * w[1] - u[1] * w[0] > 0.8 * step * away) {
        b->size[i] = fmin(b->size[i], away / ACROSS);
      }
    }
  }
  for (int pass = 0; pass < 2; pass++) {
    for (int i = 0; i < SAMPLES; i++) {
      for (int k = 0; k < SAMPLES; k++) {
        double away = hypot(b->place[i][0] - b->place[k][0], b->place[i][1] - b->place[k][1]);
        b->size[i] = fmin(b->size[i], b->size[k] + plan->growth * away);
      }
    }
  }
  b->cumulative[0] = 0.0;
  for (int i = 0; i < SAMPLES; i++) {
    double mean = 0.5 * (1.0 / b->size[i] + 1.0 / b->size[(i + 1) % SAMPLES]);
    b->cumulative[i + 1] = b->cumulative[i] + mean * step;
  }
}

static double cumulative_at(const Builder *b, double arc) {
  double at = arc / b->plan->outline->length * SAMPLES;
  int i = (int)fmin(SAMPLES - 1, floor(at));
  return b->cumulative[i] + (at - i) * (b->cumulative[i + 1] - b->cumulative[i]);
}

// Inverse of it.
static double arc_at(const Builder *b, double wanted) {
  int low = 0, high = SAMPLES;
  while (high - low > 1) {
    int middle = (low + high) / 2;
    low = b->cumulative[middle] <= wanted ? middle : low;
    high = b->cumulative[middle] <= wanted ? high : middle;
  }
  double part = (wanted - b->cumulative[low]) / (b->cumulative[high] - b->cumulative[low]);
  return (low + part) * b->plan->outline->length / SAMPLES;
}

// Adds a place that must be a vertex unless one is near.
static int add_break(const Builder *b, double *at, int count, double arc) {
  const double length = b->plan->outline->length;
  const double size = b->size[(int)(arc / length * SAMPLES) % SAMPLES];
  for (int i = 0; i < count; i++) {
    if (fabs(remainder(arc - at[i], length)) < NEAR * size) {
      return count;
    }
  }
  int j = count;
  for (; j > 0 && at[j - 1] > arc; j--) {
    at[j] = at[j - 1];
  }
  at[j] = arc;
  return count + 1;
}

static bool place_boundary(Builder *b) {
  const SbRingMeshPlan *plan = b->plan;
  const SbRingOutline *outline = plan->outline;
  const double length = outline->length;
  double at[BREAKS_MAX];
  int count = 1;
  at[0] = 0.0;
  for (int i = 0; i < plan->vertex_count; i++) {
    double arc = sb_ring_outline_arc(outline, plan->vertex[i]);
    count = add_break(b, at, count, arc - length * floor(arc / length));
  }
  count = add_break(b, at, count, outline->bore);
  for (int i = 1; i < outline->count; i++) {
    count = add_break(b, at, count, outline->part[i].at);
  }
  b->sides = 0;
  for (int s = 0; s < count; s++) {
    double from = cumulative_at(b, at[s]);
    double to = s + 1 < count ? cumulative_at(b, at[s + 1]) : b->cumulative[SAMPLES];
    int n = (int)fmax(1.0, floor(to - from + 0.5));
    for (int j = 0; j < n; j++) {
      if (b->sides >= BOUNDARY_MAX) {
        return false;
      }
      b->arc[b->sides++] = j == 0 ? at[s] : arc_at(b, from + (to - from) * j / n);
    }
  }
  return true;
}

// ---- triangulation

// A vertex's place, moved by what no size feels, in an order that looks random.
static void set_point(Builder *b, int i, const double x[2], double size) {
  for (int k = 0; k < 2; k++) {
    const double noise = sin(12.9898 * (i + 1) + 78.233 * k) * 43758.5453;
    b->x[i][k] = x[k] + 1e-6 * size * (noise - floor(noise) - 0.5);
  }
}

static double cross(const double *a, const double *b, const double *c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Returns whether a point is within the circumcircle of a triangle.
static bool in_circle(const Builder *b, const Triangle *t, const double p[2]) {
  double m[3][3];
  for (int k = 0; k < 3; k++) {
    m[k][0] = b->x[t->v[k]][0] - p[0];
    m[k][1] = b->x[t->v[k]][1] - p[1];
    m[k][2] = m[k][0] * m[k][0] + m[k][1] * m[k][1];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
             m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) >
         0.0;
}

static double circumcentre(const Builder *b, const Triangle *t, double at[2]) {
  const double *o = b->x[t->v[0]];
  double u[2], v[2];
  for (int k = 0; k < 2; k++) {
    u[k] = b->x[t->v[1]][k] - o[k];
    v[k] = b->x[t->v[2]][k] - o[k];
  }
  double uu = u[0] * u[0] + u[1] * u[1], vv = v[0] * v[0] + v[1] * v[1];
  double twice = 2.0 * (u[0] * v[1] - u[1] * v[0]);
  double c[2] = {(v[1] * uu - u[1] * vv) / twice, (u[0] * vv - v[0] * uu) / twice};
  at[0] = o[0] + c[0];
  at[1] = o[1] + c[1];
  return hypot(c[0], c[1]);
}

// Collects the triangles whose circumcircles contain p, starting from one of them, and the edges
// around them. False if they do not form a star around p, or are too many.
static bool find_cavity(Builder *b, int first, const double p[2]) {
  b->cavity_count = b->rim_count = 0;
  b->cavity[b->cavity_count++] = first;
  b->t[first].dead = true;
  bool good = true;
  for (int i = 0; i < b->cavity_count && good; i++) {
    const Triangle *t = &b->t[b->cavity[i]];
    for (int k = 0; k < 3 && good; k++) {
      int beyond = t->beside[k];
      if (beyond >= 0 && b->t[beyond].dead) {
        continue;
      }
      if (beyond >= 0 && in_circle(b, &b->t[beyond], p)) {
        good = b->cavity_count < CAVITY_MAX;
        if (good) {
          b->t[beyond].dead = true;
          b->cavity[b->cavity_count++] = beyond;
        }
        continue;
      }
      int a = t->v[k], c = t->v[(k + 1) % 3];
      good = b->rim_count < CAVITY_MAX && cross(b->x[a], b->x[c], p) > 0.0;
      if (good) {
        memcpy(b->rim[b->rim_count++], (int[3]){a, c, beyond}, sizeof b->rim[0]);
      }
    }
  }
  for (int i = 0; i < b->cavity_count && !good; i++) {
    b->t[b->cavity[i]].dead = false;
  }
  return good;
}

// Fills the cavity with triangles about a vertex.
static bool fill_cavity(Builder *b, int vertex, bool inside) {
  if (b->triangles + b->rim_count - b->cavity_count > TRIANGLES_MAX) {
    return false;
  }
  int made[CAVITY_MAX];
  for (int i = 0; i < b->rim_count; i++) {
    int at = i < b->cavity_count ? b->cavity[i] : b->triangles++; // there are two more
    const int *rim = b->rim[i];
    made[i] = at;
    b->t[at] = (Triangle){
        .v = {rim[0], rim[1], vertex}, .beside = {rim[2], -1, -1}, .over = -1.0, .inside = inside};
    for (int k = 0; rim[2] >= 0 && k < 3; k++) {
      if (b->t[rim[2]].v[k] == rim[1] && b->t[rim[2]].v[(k + 1) % 3] == rim[0]) {
        b->t[rim[2]].beside[k] = at;
      }
    }
  }
  for (int i = 0; i < b->rim_count; i++) {
    for (int k = 0; k < b->rim_count; k++) {
      if (b->rim[k][0] == b->rim[i][1]) {
        b->t[made[i]].beside[1] = made[k];
        b->t[made[k]].beside[2] = made[i];
      }
    }
  }
  return true;
}

// Triangulates the boundary vertices within a large triangle.
static bool triangulate_boundary(Builder *b) {
  static const double FAR[3][2] = {{-60.0, -40.0}, {60.0, -40.0}, {0.0, 80.0}};
  b->points = b->sides + 3;
  for (int k = 0; k < 3; k++) {
    memcpy(b->x[b->sides + k], FAR[k], sizeof FAR[k]);
  }
  b->t[0] = (Triangle){.v = {b->sides, b->sides + 1, b->sides + 2}, .beside = {-1, -1, -1}};
  b->triangles = 1;
  for (int i = 0; i < b->sides; i++) {
    double x[2];
    sb_ring_outline_place(b->plan->outline, b->arc[i], x);
    set_point(b, i, x, b->size[(int)(b->arc[i] / b->plan->outline->length * SAMPLES) % SAMPLES]);
    int first = -1;
    for (int t = b->triangles - 1; t >= 0 && first < 0; t--) {
      first = !b->t[t].dead && in_circle(b, &b->t[t], b->x[i]) ? t : -1;
    }
    if (first < 0 || !find_cavity(b, first, b->x[i]) || !fill_cavity(b, i, false)) {
      return false;
    }
  }
  return true;
}

// The living triangle that has a directed edge; -1: none.
static int with_edge(const Builder *b, int from, int to) {
  for (int t = 0; t < b->triangles; t++) {
    for (int k = 0; k < 3 && !b->t[t].dead; k++) {
      if (b->t[t].v[k] == from && b->t[t].v[(k + 1) % 3] == to) {
        return t;
      }
    }
  }
  return -1;
}

static bool is_side(const Builder *b, int from, int to) {
  return from < b->sides && to == (from + 1) % b->sides;
}

// Splits boundary sides that are no edges or whose circle contains another vertex; returns how
// many.
static int split_sides(Builder *b) {
  int splits = 0, count = 0;
  double *arc = b->split;
  for (int i = 0; i < b->sides; i++) {
    int next = (i + 1) % b->sides;
    double to = next == 0 ? b->plan->outline->length : b->arc[next];
    double middle[2] = {0.5 * (b->x[i][0] + b->x[next][0]), 0.5 * (b->x[i][1] + b->x[next][1])};
    double radius = 0.5 * hypot(b->x[i][0] - b->x[next][0], b->x[i][1] - b->x[next][1]);
    bool split = with_edge(b, i, next) < 0;
    for (int k = 0; k < b->sides && !split; k++) {
      split = k != i && k != next &&
              hypot(b->x[k][0] - middle[0], b->x[k][1] - middle[1]) < radius * (1.0 - 1e-3);
    }
    if (count + 2 > BOUNDARY_MAX) {
      return -1;
    }
    arc[count++] = b->arc[i];
    if (split) {
      arc[count++] = 0.5 * (b->arc[i] + to);
      splits++;
    }
  }
  memcpy(b->arc, arc, sizeof *arc * (size_t)count);
  b->sides = count;
  return splits;
}

// Marks the triangles within the outline.
static void mark_inside(Builder *b) {
  int count = 0, *stack = b->stack;
  for (int i = 0; i < b->sides; i++) {
    int t = with_edge(b, i, (i + 1) % b->sides);
    if (t >= 0 && !b->t[t].inside) {
      b->t[t].inside = true;
      stack[count++] = t;
    }
  }
  while (count > 0) {
    const Triangle *t = &b->t[stack[--count]];
    for (int k = 0; k < 3; k++) {
      int beyond = t->beside[k];
      if (beyond >= 0 && !b->t[beyond].inside && !is_side(b, t->v[k], t->v[(k + 1) % 3])) {
        b->t[beyond].inside = true;
        stack[count++] = beyond;
      }
    }
  }
}

// ---- refinement

// The size wanted inside, from those of all boundary sides.
static double size_at(const Builder *b, const double x[2]) {
  double size = b->plan->size_max;
  for (int i = 0; i < b->sides; i++) {
    double away = hypot(x[0] - b->x[i][0], x[1] - b->x[i][1]);
    size = fmin(size, b->spacing[i] + b->plan->growth * away);
  }
  return size;
}

static void judge(Builder *b, Triangle *t) {
  double at[2], radius = circumcentre(b, t, at);
  t->over = radius / (RADIUS_MOST * size_at(b, at));
}

// Returns whether a point is within the circle over a boundary side.
static bool encroaches(const Builder *b, const double p[2]) {
  for (int i = 0; i < b->sides; i++) {
    const double *u = b->x[i], *v = b->x[(i + 1) % b->sides];
    if ((u[0] - p[0]) * (v[0] - p[0]) + (u[1] - p[1]) * (v[1] - p[1]) < 0.0) {
      return true;
    }
  }
  return false;
}

static bool refine(Builder *b) {
  for (int i = 0; i < b->sides; i++) {
    const double *x = b->x[i], *left = b->x[(i + b->sides - 1) % b->sides],
                 *right = b->x[(i + 1) % b->sides];
    b->spacing[i] =
        0.5 * (hypot(x[0] - left[0], x[1] - left[1]) + hypot(x[0] - right[0], x[1] - right[1]));
  }
  for (int t = 0; t < b->triangles; t++) {
    if (!b->t[t].dead && b->t[t].inside) {
      judge(b, &b->t[t]);
    }
  }
  for (;;) {
    int worst = -1;
    double most = 1.0;
    for (int t = 0; t < b->triangles; t++) {
      if (!b->t[t].dead && b->t[t].over > most) {
        most = b->t[t].over;
        worst = t;
      }
    }
    if (worst < 0) {
      return true;
    }
    double at[2];
    (void)circumcentre(b, &b->t[worst], at);
    if (encroaches(b, at) || !find_cavity(b, worst, at)) {
      b->t[worst].over = -1.0;
      continue;
    }
    // A cavity that reaches outside would take boundary sides with it.
    bool outside = false;
    for (int i = 0; i < b->cavity_count; i++) {
      outside = outside || !b->t[b->cavity[i]].inside;
    }
    if (outside) {
      for (int i = 0; i < b->cavity_count; i++) {
        b->t[b->cavity[i]].dead = false;
      }
      b->t[worst].over = -1.0;
      continue;
    }
    if (b->points >= POINTS_MAX) {
      return false;
    }
    int rim = b->rim_count, vertex = b->points++;
    memcpy(b->x[vertex], at, sizeof at);
    if (!fill_cavity(b, vertex, true)) {
      return false;
    }
    for (int t = 0, made = 0; t < b->triangles && made < rim; t++) {
      if (!b->t[t].dead && b->t[t].v[2] == vertex) {
        judge(b, &b->t[t]);
        made++;
      }
    }
  }
}

// ---- smoothing

static double shape(const double *a, const double *b, const double *c) {
  double sides = (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) +
                 (c[0] - b[0]) * (c[0] - b[0]) + (c[1] - b[1]) * (c[1] - b[1]) +
                 (a[0] - c[0]) * (a[0] - c[0]) + (a[1] - c[1]) * (a[1] - c[1]);
  return 2.0 * sqrt(3.0) * cross(a, b, c) / sides;
}

// Turns an inner edge where its two triangles have a better worst shape so.
static void turn_edges(Builder *b) {
  for (int i = 0; i < b->triangles; i++) {
    for (int k = 0; k < 3; k++) {
      Triangle *t = &b->t[i];
      int j = t->beside[k];
      if (t->dead || !t->inside || j < i || !b->t[j].inside ||
          is_side(b, t->v[k], t->v[(k + 1) % 3]) || is_side(b, t->v[(k + 1) % 3], t->v[k])) {
        continue;
      }
      Triangle *o = &b->t[j];
      int m = 0;
      while (o->beside[m] != i) {
        m++;
      }
      int a = t->v[k], c = t->v[(k + 1) % 3], e = t->v[(k + 2) % 3], f = o->v[(m + 2) % 3];
      const double *xa = b->x[a], *xc = b->x[c], *xe = b->x[e], *xf = b->x[f];
      double now = fmin(shape(xa, xc, xe), shape(xc, xa, xf));
      if (fmin(shape(xa, xf, xe), shape(xf, xc, xe)) < now + 1e-9) {
        continue;
      }
      int ce = t->beside[(k + 1) % 3], ea = t->beside[(k + 2) % 3];
      int af = o->beside[(m + 1) % 3], fc = o->beside[(m + 2) % 3];
      *t = (Triangle){.v = {a, f, e}, .beside = {af, j, ea}, .inside = true};
      *o = (Triangle){.v = {f, c, e}, .beside = {fc, ce, i}, .inside = true};
      const int moved[2][3] = {{af, j, i}, {ce, i, j}}; // neighbour, its old and new neighbour
      for (int n = 0; n < 2; n++) {
        for (int s = 0; moved[n][0] >= 0 && s < 3; s++) {
          int *side = &b->t[moved[n][0]].beside[s];
          *side = *side == moved[n][1] ? moved[n][2] : *side;
        }
      }
    }
  }
}

// Moves inner vertices halfway to the mean of their neighbours where that betters the worst shape.
static void smooth(Builder *b, double (*sum)[3], double (*worst)[2]) {
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    turn_edges(b);
    for (int v = 0; v < b->points; v++) {
      sum[v][0] = sum[v][1] = sum[v][2] = 0.0;
      worst[v][0] = worst[v][1] = 1.0;
    }
    for (int pass = 0; pass < 2; pass++) {
      for (int i = 0; i < 3 * b->triangles; i++) {
        const Triangle *t = &b->t[i / 3];
        const int v = t->v[i % 3];
        if (t->dead || !t->inside || (pass == 1 && v < b->sides)) {
          continue;
        }
        const double *p = b->x[t->v[(i + 1) % 3]], *q = b->x[t->v[(i + 2) % 3]];
        double at[2] = {b->x[v][0], b->x[v][1]};
        if (pass == 0) {
          sum[v][0] += p[0] + q[0];
          sum[v][1] += p[1] + q[1];
          sum[v][2] += 2.0;
        } else {
          at[0] = 0.5 * (at[0] + sum[v][0] / sum[v][2]);
          at[1] = 0.5 * (at[1] + sum[v][1] / sum[v][2]);
        }
        worst[v][pass] = fmin(worst[v][pass], shape(at, p, q));
      }
    }
    // Moved one after the other, another order would give another mesh: all are moved together,
    // each by half.
    for (int v = b->sides + 3; v < b->points; v++) {
      if (worst[v][1] > worst[v][0]) {
        b->x[v][0] = 0.5 * (b->x[v][0] + sum[v][0] / sum[v][2]);
        b->x[v][1] = 0.5 * (b->x[v][1] + sum[v][1] / sum[v][2]);
      }
    }
  }
}

static double worst_shape(const Builder *b) {
  double worst = 1.0;
  for (int i = 0; i < b->triangles; i++) {
    const Triangle *t = &b->t[i];
    if (t->inside) {
      worst = fmin(worst, shape(b->x[t->v[0]], b->x[t->v[1]], b->x[t->v[2]]));
    }
  }
  return worst;
}

// ---- the mesh

typedef struct {
  double key;
  int at;
} Ordered;

static int compare(const void *a, const void *b) {
  const Ordered *p = a, *q = b;
  return (p->key > q->key) - (p->key < q->key);
}

// Orders the triangles in strips, so that a search from a near one is short. Returns their number.
static int order_triangles(Ordered *order, const Builder *b) {
  static const double STRIP = 0.06;
  int count = 0;
  for (int i = 0; i < b->triangles; i++) {
    const Triangle *t = &b->t[i];
    if (!t->dead && t->inside) {
      const double *p = b->x[t->v[0]], *q = b->x[t->v[1]], *r = b->x[t->v[2]];
      const double strip = floor((p[1] + q[1] + r[1]) / (3.0 * STRIP));
      order[count++] = (Ordered){10.0 * strip + (p[0] + q[0] + r[0]) / 3.0, i};
    }
  }
  qsort(order, (size_t)count, sizeof *order, compare);
  return count;
}

// Writes the vertices: those of the boundary on the outline, without the three far ones after them.
static void write_vertices(SbRingMesh *mesh, const Builder *b) {
  int used = 0;
  for (int i = 0; i < b->points; i++) {
    if (i >= b->sides && i < b->sides + 3) {
      continue;
    }
    double x[2] = {b->x[i][0], b->x[i][1]};
    if (i < b->sides) {
      sb_ring_outline_place(b->plan->outline, b->arc[i], x);
    }
    mesh->x[2 * used] = b->plan->centre + x[0];
    mesh->x[2 * used++ + 1] = x[1];
  }
  mesh->nodes = used;
}

// Writes the boundary in order, its mid-side nodes on the outline.
static void write_boundary(SbRingMesh *mesh, const Builder *b) {
  const SbRingOutline *outline = b->plan->outline;
  mesh->loop_count = 2 * b->sides;
  for (int i = 0; i < b->sides; i++) {
    mesh->loop[2 * i] = i;
  }
  for (int i = 0; i < 3 * mesh->elements; i++) {
    const int *tri = &mesh->tri[i / 3 * 6], k = i % 3;
    if (is_side(b, tri[k], tri[(k + 1) % 3])) {
      mesh->loop[2 * tri[k] + 1] = tri[3 + k];
    }
  }
  for (int i = 0; i < b->sides; i++) {
    double next = i + 1 < b->sides ? b->arc[i + 1] : outline->length, x[2];
    double middle = 0.5 * (b->arc[i] + next);
    int node = mesh->loop[2 * i + 1];
    sb_ring_outline_place(outline, middle, x);
    mesh->x[2 * node] = b->plan->centre + x[0];
    mesh->x[2 * node + 1] = x[1];
    mesh->angle[2 * i] = sb_ring_outline_angle(outline, b->arc[i]);
    mesh->angle[2 * i + 1] = sb_ring_outline_angle(outline, middle);
  }
  mesh->arc[0] = outline->bore / M_PI;
  mesh->arc[1] = (outline->length - outline->bore) / M_PI;
}

static SbStatus write_mesh(SbRingMesh **out, const Builder *b, Ordered *order, SbReport *report) {
  const int count = order_triangles(order, b);
  SbRingMesh *mesh = *out = sb_ring_mesh_allocate(b->points, count, 2 * b->sides);
  if (mesh == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's mesh");
  }
  write_vertices(mesh, b);
  for (int i = 0; i < count; i++) {
    int v[3];
    for (int k = 0; k < 3; k++) {
      v[k] = b->t[order[i].at].v[k];
      v[k] -= v[k] >= b->sides ? 3 : 0;
    }
    (void)sb_ring_mesh_add(mesh, v[0], v[1], v[2]);
  }
  const SbStatus status = sb_ring_mesh_add_midsides(mesh, report);
  if (status == SB_OK) {
    write_boundary(mesh, b);
  }
  return status;
}

static SbStatus build(SbRingMesh **out, Builder *b, SbReport *report) {
  enum { SPLITS_MAX = 8 };
  sample_sizes(b);
  int splits = place_boundary(b) ? 1 : -1;
  for (int i = 0; i < SPLITS_MAX && splits > 0; i++) {
    splits = triangulate_boundary(b) ? split_sides(b) : -1;
  }
  if (splits != 0) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "no mesh of this profile");
  }
  mark_inside(b);
  if (!refine(b)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "a mesh of this profile has too many elements");
  }
  double(*sum)[3] = malloc(sizeof *sum * (size_t)b->points);
  double(*worst)[2] = malloc(sizeof *worst * (size_t)b->points);
  Ordered *order = malloc(sizeof *order * (size_t)b->triangles);
  SbStatus status = SB_ERROR_MEMORY;
  if (sum != NULL && worst != NULL && order != NULL) {
    smooth(b, sum, worst);
    status = worst_shape(b) >= SHAPE_LEAST ? write_mesh(out, b, order, report)
                                           : sb_fail(report, SB_ERROR_NOT_CONVERGED,
                                                     "no mesh of this profile is good enough");
  }
  free(sum);
  free(worst);
  free(order);
  return status;
}

SbStatus sb_ring_triangles_create(SbRingMesh **out, const SbRingMeshPlan *plan, SbReport *report) {
  *out = NULL;
  Builder *b = calloc(1, sizeof *b);
  if (b == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's mesh");
  }
  b->plan = plan;
  SbStatus status = build(out, b, report);
  free(b);
  if (status != SB_OK) {
    sb_ring_mesh_destroy(*out);
    *out = NULL;
  }
  return status;
}
