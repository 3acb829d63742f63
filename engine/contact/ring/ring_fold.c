// Contact of the section with itself, in the hollows of its outline.
//
// A penalty on boundary nodes in a hollow of the free section that have come behind a piece of the
// other side of the same hollow: a pressure of STIFFNESS times how far, without friction, each side
// against the other. For a node at x behind the straight piece from a to b, n its outward normal, t
// its direction, L its length, w the node's area in the free section,
//
//   g = n . (x - a) < 0, s = t . (x - a)/L, force -k w g [n, -(1 - s) n, -s n] on (x, a, b),
//
// with the consistent tangent (Wriggers, Computational Contact Mechanics, section 9.2). Behind a
// corner between two pieces that lean apart, as those of a hollow do, it is the nearest point: the
// force is -k w (x - a) on the node. What is left behind is the pressure over the stiffness, 0.1 %
// of the section's height for one shear modulus. Leaves out fluid between the sides and friction.
#include "engine/contact/ring/ring_contact.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Pressure per depth, in shear moduli per section height.
static const double STIFFNESS = 1000.0;

// Smallest depth of a hollow's nodes in the hull of the free section; largest distance of a node
// behind a piece; smallest degree to which the two sides face each other.
static const double HOLLOW = 1e-3, BEHIND = 0.12, FACES = 0.2;

// Distance of a node behind a piece in the free section from which on it is the opposite surface of
// the piece's own flange or lip, in section heights: more than a state may penetrate itself.
static const double THROUGH = 0.03;

// Nodes adjacent to a hollow, at either end, that may come into it, and nodes along the boundary
// that belong to a node's own side.
enum { BESIDE = 6, OWN = 1 };

// Twice the area of a triangle, counter-clockwise.
static double turn(const double a[2], const double b[2], const double c[2]) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static const double *free_place(const SbRingMesh *mesh, int i) {
  return &mesh->x[2 * mesh->loop[i]];
}

// The boundary nodes of the free section's hull, in order (gift wrapping); how many.
static int wrap_hull(int *hull, const SbRingMesh *mesh) {
  const int n = mesh->loop_count;
  int first = 0, count = 0;
  for (int i = 1; i < n; i++) {
    const double *a = free_place(mesh, i), *b = free_place(mesh, first);
    first = a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]) ? i : first;
  }
  int at = first;
  do {
    hull[count++] = at;
    int next = (at + 1) % n;
    for (int i = 0; i < n; i++) {
      if (turn(free_place(mesh, at), free_place(mesh, next), free_place(mesh, i)) < -1e-15) {
        next = i;
      }
    }
    at = next;
  } while (at != first && count < n);
  return count;
}

// Returns whether the free section is convex, as a round one is.
static bool is_convex(const SbRingMesh *mesh) {
  const int n = mesh->loop_count;
  for (int i = 0; i < n; i++) {
    const double *a = free_place(mesh, i), *b = free_place(mesh, (i + 1) % n);
    if (turn(a, b, free_place(mesh, (i + 2) % n)) < -1e-9) {
      return false;
    }
  }
  return true;
}

void sb_ring_hollows(int *hollow, const SbRingMesh *mesh) {
  const int n = mesh->loop_count;
  memset(hollow, 0, sizeof(int) * (size_t)n);
  if (is_convex(mesh)) {
    return;
  }
  int *hull = malloc(sizeof(int) * (size_t)n);
  const int corners = hull != NULL ? wrap_hull(hull, mesh) : 0;
  int outside = -1;
  for (int i = 0; i < n; i++) {
    double depth = INFINITY;
    for (int k = 0; k < corners; k++) {
      const double *a = free_place(mesh, hull[k]), *b = free_place(mesh, hull[(k + 1) % corners]);
      depth = fmin(depth, turn(a, b, free_place(mesh, i)) / hypot(b[0] - a[0], b[1] - a[1]));
    }
    hollow[i] = corners > 0 && depth > HOLLOW ? 1 : 0;
    outside = hollow[i] == 0 ? i : outside;
  }
  free(hull);
  // Numbers of the runs, from a node outside all of them; then what may come into them.
  int count = 0;
  for (int k = 1; k <= n && outside >= 0; k++) {
    const int i = (outside + k) % n, before = (outside + k - 1) % n;
    count += hollow[i] != 0 && hollow[before] == 0 ? 1 : 0;
    hollow[i] = hollow[i] != 0 ? count : 0;
  }
  for (int pass = 0; pass < BESIDE && count > 0; pass++) {
    for (int i = 0; i < n; i++) {
      const int before = hollow[(i + n - 1) % n], after = hollow[(i + 1) % n];
      if (hollow[i] == 0 && (before > 0 || after > 0)) {
        hollow[i] = -(before > 0 ? before : after); // for the next pass
      }
    }
    for (int i = 0; i < n; i++) {
      hollow[i] = abs(hollow[i]);
    }
  }
}

// A node behind a piece, or behind the corner `from`, where `to` is the same.
typedef struct {
  int node, from, to; // of the mesh
  double gap, along, length, n[2], t[2];
} Fold;

// Returns the number of nodes along the boundary between two nodes.
static int apart(int a, int b, int count) {
  const int way = abs(a - b);
  return way < count - way ? way : count - way;
}

// A straight piece of the boundary from node k on: its ends, direction, outward normal.
typedef struct {
  double a[2], b[2], length, t[2], n[2];
} Piece;

static Piece piece_at(const SbRingContact *contact, int k) {
  Piece p;
  sb_ring_contact_place(contact, k, p.a);
  sb_ring_contact_place(contact, k + 1, p.b);
  p.length = hypot(p.b[0] - p.a[0], p.b[1] - p.a[1]);
  p.t[0] = (p.b[0] - p.a[0]) / p.length;
  p.t[1] = (p.b[1] - p.a[1]) / p.length;
  p.n[0] = p.t[1];
  p.n[1] = -p.t[0];
  return p;
}

// Returns the distance of x from a piece, > 0 outside, and its position along the piece as a
// fraction of its length.
static double outside_of(const Piece *p, const double x[2], double *along) {
  const double d[2] = {x[0] - p->a[0], x[1] - p->a[1]};
  *along = (p->t[0] * d[0] + p->t[1] * d[1]) / p->length;
  return p->n[0] * d[0] + p->n[1] * d[1];
}

// Returns whether node i is behind the piece from node k on through the material of the free
// section.
static bool through_material(const SbRingContact *contact, int i, int k) {
  const SbRingMesh *mesh = contact->fem->mesh;
  const double *a = free_place(mesh, k), *b = free_place(mesh, sb_ring_wrap(contact, k + 1));
  return turn(a, b, free_place(mesh, i)) > THROUGH * hypot(b[0] - a[0], b[1] - a[1]);
}

// The piece or corner that node i is behind, nearest to it; false if there is none.
static bool find(Fold *out, const SbRingContact *contact, int i) {
  const SbRingFem *fem = contact->fem;
  const int n = contact->count, *hollow = fem->hollow;
  double x[2], left[2], right[2];
  sb_ring_contact_place(contact, i, x);
  sb_ring_contact_place(contact, i - 1, left);
  sb_ring_contact_place(contact, i + 1, right);
  // Outward normal at the node: the boundary has the direction of the loop.
  const double way = hypot(right[0] - left[0], right[1] - left[1]);
  const double face[2] = {(right[1] - left[1]) / way, -(right[0] - left[0]) / way};
  bool found = false;
  for (int k = 0; k < n; k++) {
    const int next = k + 1 < n ? k + 1 : 0;
    if (hollow[k] != hollow[i] || hollow[next] != hollow[i] || apart(k, i, n) <= OWN ||
        apart(next, i, n) <= OWN) {
      continue;
    }
    const Piece p = piece_at(contact, k);
    double along;
    double gap = outside_of(&p, x, &along);
    int to = next;
    if (along < 0.0 && gap < 0.0) {
      double past;
      const Piece before = piece_at(contact, k - 1);
      if (outside_of(&before, x, &past) < 0.0 && past > 1.0) {
        to = k;
        along = 0.0;
        gap = -hypot(x[0] - p.a[0], x[1] - p.a[1]);
      }
    }
    if (gap < 0.0 && gap > -BEHIND && along >= 0.0 && along <= 1.0 &&
        p.n[0] * face[0] + p.n[1] * face[1] < -FACES && (!found || gap > out->gap) &&
        !through_material(contact, i, k)) {
      *out = (Fold){.node = fem->mesh->loop[i],
                    .from = fem->mesh->loop[k],
                    .to = fem->mesh->loop[to],
                    .gap = gap,
                    .along = along,
                    .length = p.length,
                    .n = {p.n[0], p.n[1]},
                    .t = {p.t[0], p.t[1]}};
      found = true;
    }
  }
  return found;
}

// Area of a boundary node in the free section.
static double free_area(const SbRingContact *contact, int i) {
  const SbRingMesh *mesh = contact->fem->mesh;
  const double *a = free_place(mesh, sb_ring_wrap(contact, i - 1)), *x = free_place(mesh, i);
  const double *b = free_place(mesh, sb_ring_wrap(contact, i + 1));
  const double length = 0.5 * (hypot(x[0] - a[0], x[1] - a[1]) + hypot(b[0] - x[0], b[1] - x[1]));
  return length * (contact->fem->around != 0.0 ? contact->fem->around * x[0] : 1.0);
}

static void press_corner(SbRingFem *fem, const Fold *fold, double stiffness) {
  const int node[2] = {fold->node, fold->from};
  for (int i = 0; i < 2; i++) {
    const double way = fem->mesh->x[2 * node[0] + i] + fem->u[2 * node[0] + i] -
                       fem->mesh->x[2 * node[1] + i] - fem->u[2 * node[1] + i];
    for (int a = 0; a < 2; a++) {
      fem->residual[2 * node[a] + i] += (a == 0 ? stiffness : -stiffness) * way;
      for (int b = 0; b < 2; b++) {
        sb_ring_fem_add(fem, node[a], i, node[b], i, a == b ? stiffness : -stiffness);
      }
    }
  }
}

static void press(SbRingFem *fem, const Fold *fold, double stiffness) {
  const int node[3] = {fold->node, fold->from, fold->to};
  const double share[3] = {1.0, -(1.0 - fold->along), -fold->along}, end[3] = {0.0, -1.0, 1.0};
  const double *n = fold->n, *t = fold->t, g = fold->gap, lean = g / fold->length;
  for (int a = 0; a < 3; a++) {
    for (int i = 0; i < 2; i++) {
      fem->residual[2 * node[a] + i] += stiffness * g * share[a] * n[i];
      for (int b = 0; b < 3; b++) {
        for (int j = 0; j < 2; j++) {
          const double normal = share[a] * n[i] * share[b] * n[j];
          const double turns = share[a] * t[i] * end[b] * n[j] + end[a] * n[i] * share[b] * t[j] +
                               lean * end[a] * n[i] * end[b] * n[j];
          sb_ring_fem_add(fem, node[a], i, node[b], j, stiffness * (normal - lean * turns));
        }
      }
    }
  }
}

double sb_ring_fold_apply(SbRingContact *contact) {
  double deepest = 0.0;
  contact->folds = 0;
  for (int i = 0; i < contact->count; i++) {
    Fold fold;
    if (contact->fem->hollow[i] != 0 && find(&fold, contact, i)) {
      (fold.from == fold.to ? press_corner : press)(contact->fem, &fold,
                                                    STIFFNESS * free_area(contact, i));
      deepest = fmax(deepest, -fold.gap);
      contact->folds =
          31 * contact->folds + (unsigned)(fold.node * contact->count + fold.from + fold.to) + 1;
    }
  }
  return deepest;
}

// Does the same between two positions of the section and their earlier positions, `at` and `was`
// between them.
static double across_over_along(const SbRingContact *contact, const double way[2],
                                const double was[2], double at, double from) {
  const double along = hypot(way[0], way[1]) / hypot(was[0], was[1]);
  return 1.0 / (along * along * (contact->fem->around != 0.0 ? at / from : 1.0));
}

double sb_ring_crease(const SbRingContact *contact) {
  static const double GAUSS = 0.57735026918962576;
  double most = 1.0;
  for (int i = 0; i < contact->count; i++) {
    double x[3][2], way[2], was[2];
    const double *rest[3];
    bool held = false;
    for (int k = 0; k < 3; k++) {
      sb_ring_contact_place(contact, i - 1 + k, x[k]);
      rest[k] = free_place(contact->fem->mesh, sb_ring_wrap(contact, i - 1 + k));
    }
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      held = held || sb_ring_touch(contact, i, s)->held;
    }
    // From the middle of one side to that of the next, across which the surface may be kinked; the
    // slopes of a quadratic side at its Gauss points.
    for (int side = -1; side <= 1 && !held; side += i % 2 == 0 ? 3 : 2) {
      const double bend = i % 2 == 0 ? 0.0 : side * GAUSS;
      for (int k = 0; k < 2; k++) {
        way[k] = 0.5 * (x[2][k] - x[0][k]) + bend * (x[0][k] + x[2][k] - 2.0 * x[1][k]);
        was[k] =
            0.5 * (rest[2][k] - rest[0][k]) + bend * (rest[0][k] + rest[2][k] - 2.0 * rest[1][k]);
      }
      most = fmax(most, across_over_along(contact, way, was, x[1][0], rest[1][0]));
    }
  }
  return most;
}
