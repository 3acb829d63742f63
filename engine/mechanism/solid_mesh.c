// Closed triangle meshes. See solid.h. A mesh bounds a body if every edge occurs once in each
// direction; it is inside out if its signed volume is negative.
#include "engine/mechanism/solid.h"
#include "engine/mechanism/vector3.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

// ---- closed? ----

typedef struct {
  uint64_t ends; // from and to
  size_t triangle;
} Edge;

static uint64_t ends_of(uint64_t from, uint64_t to) {
  return from << 32 | to;
}

static int by_ends(const void *a, const void *b) {
  const Edge *e = a, *f = b;
  return (e->ends > f->ends) - (e->ends < f->ends);
}

static SbStatus check_edges(const unsigned *triangles, size_t count, SbReport *report) {
  size_t n = 3 * count;
  Edge *edge = malloc(n * sizeof *edge);
  if (edge == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for %zu edges", n);
  }
  for (size_t t = 0; t < count; t++) {
    for (size_t k = 0; k < 3; k++) {
      edge[3 * t + k] = (Edge){ends_of(triangles[3 * t + k], triangles[3 * t + (k + 1) % 3]), t};
    }
  }
  qsort(edge, n, sizeof *edge, by_ends);
  SbStatus status = SB_OK;
  for (size_t i = 0; i < n && status == SB_OK; i++) {
    if (i + 1 < n && edge[i].ends == edge[i + 1].ends) {
      status =
          sb_fail(report, SB_ERROR_INPUT,
                  "triangles %zu and %zu run along their common edge in the same direction: two "
                  "solids touch or one is there twice (export each by itself), or the mesh has "
                  "mixed handedness",
                  edge[i].triangle, edge[i + 1].triangle);
      break;
    }
    Edge back = {ends_of(edge[i].ends & UINT32_MAX, edge[i].ends >> 32), 0};
    if (bsearch(&back, edge, n, sizeof *edge, by_ends) == NULL) {
      status = sb_fail(report, SB_ERROR_INPUT, "the mesh is open at an edge of triangle %zu",
                       edge[i].triangle);
    }
  }
  free(edge);
  return status;
}

// ---- crossing itself? ----

typedef struct {
  double low[3], high[3];
  size_t triangle;
} Box;

static int by_low(const void *a, const void *b) {
  const Box *p = a, *q = b;
  return p->low[0] < q->low[0] ? -1 : p->low[0] > q->low[0];
}

static double side_of(const double *a, const double *b, const double *c, const double *d) {
  double ab[3], ac[3], ad[3], n[3];
  for (int k = 0; k < 3; k++) {
    ab[k] = b[k] - a[k];
    ac[k] = c[k] - a[k];
    ad[k] = d[k] - a[k];
  }
  cross(n, ab, ac);
  return dot(n, ad);
}

// Returns whether the open segment pq passes through the inside of triangle abc.
static bool pierces(const double *p, const double *q, const double *a, const double *b,
                    const double *c) {
  double sp = side_of(a, b, c, p), sq = side_of(a, b, c, q);
  if (!((sp > 0.0 && sq < 0.0) || (sp < 0.0 && sq > 0.0))) {
    return false;
  }
  double u = side_of(p, q, a, b), v = side_of(p, q, b, c), w = side_of(p, q, c, a);
  return (u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0);
}

static bool triangles_cross(const double *vertices, const unsigned *s, const unsigned *t) {
  const double *p[3], *q[3];
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 3; k++) {
      if (s[i] == t[k]) {
        return false;
      }
    }
    p[i] = vertices + 3 * (size_t)s[i];
    q[i] = vertices + 3 * (size_t)t[i];
  }
  for (int i = 0; i < 3; i++) {
    if (pierces(p[i], p[(i + 1) % 3], q[0], q[1], q[2]) ||
        pierces(q[i], q[(i + 1) % 3], p[0], p[1], p[2])) {
      return true;
    }
  }
  return false;
}

static SbStatus check_crossing(const double *vertices, const unsigned *triangles, size_t count,
                               SbReport *report) {
  Box *box = malloc(count * sizeof *box);
  if (box == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for %zu triangles", count);
  }
  for (size_t t = 0; t < count; t++) {
    box[t] = (Box){.triangle = t};
    for (int k = 0; k < 3; k++) {
      double a = vertices[3 * (size_t)triangles[3 * t] + (size_t)k];
      double b = vertices[3 * (size_t)triangles[3 * t + 1] + (size_t)k];
      double c = vertices[3 * (size_t)triangles[3 * t + 2] + (size_t)k];
      box[t].low[k] = fmin(a, fmin(b, c));
      box[t].high[k] = fmax(a, fmax(b, c));
    }
  }
  qsort(box, count, sizeof *box, by_low);
  SbStatus status = SB_OK;
  for (size_t i = 0; i < count && status == SB_OK; i++) {
    for (size_t j = i + 1; j < count && box[j].low[0] <= box[i].high[0]; j++) {
      if (box[j].low[1] > box[i].high[1] || box[j].high[1] < box[i].low[1] ||
          box[j].low[2] > box[i].high[2] || box[j].high[2] < box[i].low[2]) {
        continue;
      }
      size_t s = box[i].triangle, t = box[j].triangle;
      if (triangles_cross(vertices, triangles + 3 * s, triangles + 3 * t)) {
        status = sb_fail(report, SB_ERROR_INPUT, "the mesh crosses itself (triangles %zu and %zu)",
                         s < t ? s : t, s < t ? t : s);
        break;
      }
    }
  }
  free(box);
  return status;
}

// Checks that all vertices are numbers and all triangles have three of them, and that each edge has
// two triangles. Writes the largest distance along an axis from the first vertex.
static SbStatus check_mesh(double *extent, const double *vertices, size_t vertex_count,
                           const unsigned *triangles, size_t triangle_count, SbReport *report) {
  const double *origin = vertices;
  *extent = 0.0;
  for (size_t i = 0; i < 3 * vertex_count; i++) {
    if (!isfinite(vertices[i])) {
      return sb_fail(report, SB_ERROR_INPUT, "vertex %zu of the mesh is not a number", i / 3);
    }
    *extent = fmax(*extent, fabs(vertices[i] - origin[i % 3]));
  }
  for (size_t t = 0; t < triangle_count; t++) {
    const unsigned *v = triangles + 3 * t;
    if (v[0] >= vertex_count || v[1] >= vertex_count || v[2] >= vertex_count) {
      return sb_fail(report, SB_ERROR_INPUT, "triangle %zu names a vertex that is not there", t);
    }
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
      return sb_fail(report, SB_ERROR_INPUT, "triangle %zu has two equal corners", t);
    }
  }
  return check_edges(triangles, triangle_count, report);
}

// ---- orientation ----

// Largest numbers of parts whose places in each other are looked at, and of vertices of a part.
enum { PARTS_MAX = 1000, TRIED_MAX = 100 };

// A triangle in a tree of those that edges connect. Sums of the tree are at its root.
typedef struct {
  size_t parent;
  bool odd;         // its orientation differs from that of its parent
  double area[2];   // of the triangles that are oriented as the root, and of the others
  double normal[3]; // sum of their area vectors, where all are oriented as the root
  double volume;    // signed, where all are oriented as the root
  double box[2][3]; // lowest and highest coordinates
  size_t body;      // the part that this one is a cavity of, else itself
  bool flip_same;   // whether triangles that are oriented as the root are to be reversed
} Node;

// Returns the root of a triangle and whether it differs from it in orientation.
static size_t root_of(Node *node, size_t t, bool *odd) {
  size_t root = t;
  for (*odd = false; node[root].parent != root; root = node[root].parent) {
    *odd ^= node[root].odd;
  }
  for (bool rest = *odd; t != root;) { // the path becomes short
    const Node step = node[t];
    node[t].parent = root;
    node[t].odd = rest;
    rest ^= step.odd;
    t = step.parent;
  }
  return root;
}

// Connects the triangles across the edges that exactly two of them have.
static void connect_triangles(Node *node, Edge *edge, const unsigned *triangles, size_t count) {
  for (size_t i = 0; i < 3 * count; i++) {
    const uint64_t from = triangles[i], to = triangles[i % 3 < 2 ? i + 1 : i - 2];
    edge[i] = (Edge){from < to ? ends_of((unsigned)from, (unsigned)to) : ends_of(to, from),
                     2 * (i / 3) + (from < to)};
  }
  qsort(edge, 3 * count, sizeof *edge, by_ends);
  for (size_t i = 0, next; i < 3 * count; i = next) {
    for (next = i + 1; next < 3 * count && edge[next].ends == edge[i].ends;) {
      next++;
    }
    if (next - i == 2) {
      const bool same = edge[i].triangle % 2 == edge[i + 1].triangle % 2;
      bool odd[2];
      const size_t a = root_of(node, edge[i].triangle / 2, &odd[0]);
      const size_t b = root_of(node, edge[i + 1].triangle / 2, &odd[1]);
      node[b].odd = a != b && (same ^ odd[0] ^ odd[1]);
      node[b].parent = a;
    }
  }
}

static void add_to_part(Node *part, bool odd, const double *vertices, const unsigned *corner) {
  double d[3][3], n[3], normal[3] = {0};
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 3; k++) {
      const double x = vertices[3 * (size_t)corner[i] + (size_t)k];
      d[i][k] = x - vertices[k];
      part->box[0][k] = fmin(part->box[0][k], x);
      part->box[1][k] = fmax(part->box[1][k], x);
    }
  }
  for (int i = 0; i < 3; i++) {
    cross(n, d[i], d[(i + 1) % 3]);
    for (int k = 0; k < 3; k++) {
      normal[k] += n[k];
    }
  }
  cross(n, d[0], d[1]);
  for (int k = 0; k < 3; k++) {
    part->normal[k] += odd ? -normal[k] : normal[k];
  }
  part->area[odd] += sqrt(dot(normal, normal));
  part->volume += odd ? -dot(n, d[2]) : dot(n, d[2]);
}

// Returns the sum of the solid angles, divided by 4 pi, at which a point sees the triangles of the
// part with this root: 1 or -1 inside, 0 outside.
static double turns_about(Node *node, size_t root, const double *at, const double *vertices,
                          const unsigned *triangles, size_t count) {
  double sum = 0.0;
  for (size_t t = 0; t < count; t++) {
    bool odd;
    if (root_of(node, t, &odd) == root) {
      double d[3][3], size[3], n[3];
      for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
          d[i][k] = vertices[3 * (size_t)triangles[3 * t + (size_t)i] + (size_t)k] - at[k];
        }
        size[i] = sqrt(dot(d[i], d[i]));
      }
      cross(n, d[0], d[1]); // A. van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng. 30, 125, 1983
      const double angle =
          atan2(dot(n, d[2]), size[0] * size[1] * size[2] + dot(d[0], d[1]) * size[2] +
                                  dot(d[1], d[2]) * size[0] + dot(d[2], d[0]) * size[1]);
      sum += odd ? -angle : angle;
    }
  }
  return sum / (2.0 * M_PI);
}

// Returns whether a part is within another one: by its first vertex that is not on that.
static bool is_within(Node *node, size_t inner, size_t outer, const double *vertices,
                      const unsigned *triangles, size_t count) {
  for (int k = 0; k < 3; k++) {
    if (node[outer].box[0][k] > node[inner].box[0][k] ||
        node[outer].box[1][k] < node[inner].box[1][k]) {
      return false;
    }
  }
  bool odd;
  for (size_t i = 0, tried = 0; i < 3 * count; i++) {
    if (root_of(node, i / 3, &odd) == inner && tried++ < TRIED_MAX) {
      const double turns = fabs(turns_about(node, outer, vertices + 3 * (size_t)triangles[i],
                                            vertices, triangles, count));
      if (turns < 0.1 || turns > 0.9) {
        return turns > 0.9;
      }
    }
  }
  return false;
}

static bool is_open(const Node *part) {
  return sqrt(dot(part->normal, part->normal)) > 1e-9 * (part->area[0] + part->area[1]);
}

// Finds what a part is a cavity of, and whether it is to be reversed.
static void place_part(Node *node, size_t i, const size_t *parts, size_t found,
                       const double *vertices, const unsigned *triangles, size_t count) {
  Node *part = &node[parts[i]];
  size_t depth = 0;
  part->body = parts[i];
  part->flip_same = part->area[0] < part->area[1];
  if (is_open(part)) {
    return;
  }
  for (size_t k = 0; k < found; k++) {
    if (k != i && is_within(node, parts[i], parts[k], vertices, triangles, count)) {
      const bool nearer =
          depth++ == 0 || fabs(node[parts[k]].volume) < fabs(node[part->body].volume);
      part->body = nearer ? parts[k] : part->body;
    }
  }
  part->body = depth % 2 == 1 ? part->body : parts[i];
  part->flip_same = (part->volume >= 0.0) == (depth % 2 == 1);
}

SbStatus sb_mesh_orient(size_t *turned, size_t *body, unsigned *triangles, size_t count,
                        const double *vertices, SbReport *report) {
  Node *node = calloc(count + 1, sizeof *node);
  Edge *edge = calloc(3 * count + 1, sizeof *edge);
  size_t parts[PARTS_MAX], found = 0;
  bool odd;
  *turned = 0;
  for (size_t t = 0; node != NULL && t < count; t++) {
    node[t] = (Node){.parent = t,
                     .box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}};
  }
  if (node == NULL || edge == NULL || count == 0) {
    free(node);
    free(edge);
    return count == 0 ? sb_fail(report, SB_ERROR_INPUT, "no triangles")
                      : sb_fail(report, SB_ERROR_MEMORY, "no memory for %zu triangles", count);
  }
  connect_triangles(node, edge, triangles, count);
  for (size_t t = 0; t < count; t++) {
    const size_t root = root_of(node, t, &odd);
    add_to_part(&node[root], odd, vertices, triangles + 3 * t);
    if (root == t) {
      parts[found < PARTS_MAX ? found : 0] = t;
      found++;
    }
  }
  for (size_t i = 0; i < found && found <= PARTS_MAX; i++) {
    place_part(node, i, parts, found, vertices, triangles, count);
  }
  for (size_t t = 0, first = count; t < count && body != NULL; t++) {
    const size_t root = root_of(node, t, &odd);
    first = first == count && is_open(&node[root]) ? root : first;
    body[t] = is_open(&node[root]) ? first : found <= PARTS_MAX ? node[root].body : root;
  }
  for (size_t t = 0; t < count && found <= PARTS_MAX; t++) {
    if (node[root_of(node, t, &odd)].flip_same != odd) {
      const unsigned swap = triangles[3 * t];
      triangles[3 * t] = triangles[3 * t + 1];
      triangles[3 * t + 1] = swap;
      ++*turned;
    }
  }
  free(node);
  free(edge);
  return sb_succeed(report);
}

// ---- moments ----

// Sums over tetrahedra (first vertex, a, b, c): volume, centre, and second moments
// integral of x_k x_l = V/20 (sum over pairs of corners x_k x_l + sum x_k sum x_l).
typedef struct {
  double six, first[3], second[3][3];
} Moments;

static void sum_moments(Moments *out, const double *vertices, const unsigned *triangles,
                        size_t triangle_count) {
  const double *origin = vertices;
  *out = (Moments){0};
  for (size_t t = 0; t < triangle_count; t++) {
    double p[3][3], n[3], sum[3];
    for (int i = 0; i < 3; i++) {
      for (int k = 0; k < 3; k++) {
        p[i][k] = vertices[3 * (size_t)triangles[3 * t + (size_t)i] + (size_t)k] - origin[k];
      }
    }
    cross(n, p[0], p[1]);
    double v = dot(n, p[2]);
    out->six += v;
    for (int k = 0; k < 3; k++) {
      sum[k] = p[0][k] + p[1][k] + p[2][k];
      out->first[k] += v * sum[k] / 4.0;
    }
    for (int k = 0; k < 3; k++) {
      for (int l = 0; l < 3; l++) {
        double corners = p[0][k] * p[0][l] + p[1][k] * p[1][l] + p[2][k] * p[2][l];
        out->second[k][l] += v / 20.0 * (corners + sum[k] * sum[l]);
      }
    }
  }
}

SbStatus sb_solid_integrate(SbSolid *solid, const double *vertices, size_t vertex_count,
                            const unsigned *triangles, size_t triangle_count, double density,
                            SbReport *report) {
  if (!(density > 0.0) || !isfinite(density)) {
    return sb_fail(report, SB_ERROR_RANGE, "the density must be above 0, not %g kg/m3", density);
  }
  if (triangle_count < 4 || vertex_count < 4 || triangle_count > (size_t)1 << 26) {
    return sb_fail(report, SB_ERROR_INPUT, "a closed mesh needs at least four triangles");
  }
  double extent;
  SbStatus status = check_mesh(&extent, vertices, vertex_count, triangles, triangle_count, report);
  if (status != SB_OK) {
    return status;
  }
  Moments m;
  sum_moments(&m, vertices, triangles, triangle_count);
  const double six = m.six;
  if (!(fabs(six) > 1e-14 * extent * extent * extent)) {
    return sb_fail(report, SB_ERROR_INPUT, "the mesh encloses no volume");
  }
  if (six < 0.0) {
    return sb_fail(report, SB_ERROR_INPUT,
                   "the mesh has the wrong handedness: it is inside out (volume %.3g m3)",
                   six / 6.0);
  }
  *solid = (SbSolid){.volume = six / 6.0, .mass = density * six / 6.0};
  double trace = 0.0, about[3][3];
  for (int k = 0; k < 3; k++) {
    double centre = m.first[k] / six;
    solid->centre[k] = vertices[k] + centre;
    for (int l = 0; l < 3; l++) {
      about[k][l] = density / 6.0 * (m.second[k][l] - centre * m.first[l]);
    }
    trace += about[k][k];
  }
  for (int k = 0; k < 3; k++) {
    for (int l = 0; l < 3; l++) {
      solid->inertia[k][l] = (k == l ? trace : 0.0) - about[k][l];
    }
  }
  return sb_succeed(report);
}

SbStatus sb_solid_mesh(SbSolid *solid, const double *vertices, size_t vertex_count,
                       const unsigned *triangles, size_t triangle_count, double density,
                       SbReport *report) {
  SbSolid found;
  SbStatus status = sb_solid_integrate(&found, vertices, vertex_count, triangles, triangle_count,
                                       density, report);
  if (status == SB_OK) {
    status = check_crossing(vertices, triangles, triangle_count, report);
  }
  if (status == SB_OK) {
    *solid = found;
  }
  return status;
}
