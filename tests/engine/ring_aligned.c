// Bordered Newton for contact ends (ring_aligned.h).
//
// Long: a proof in one file, with the state that the ring solver would have to keep for it.
#include "ring_aligned.h"

#include "engine/numeric/dense.h"

#include <glib.h>
#include <math.h>
#include <string.h>

enum { ENDS = 24, REACH_SIDES = 16, SWEEPS = 60, SMOOTHINGS = 6, ITERATIONS = 25, LEAST_NODES = 4 };

// Differences by an end's position and by an input; largest correction of an end and of a node in
// one iteration; largest distance along the outline that an end moves the mesh.
static const double STEP = 2e-6, END_MOST = 0.02, NODE_MOST = 0.05, REACH = 0.35;
// Of the element equations, of gaps and of the ends' equations.
static const double BALANCE = 2e-10, GAP = 1e-10, PLACED = 1e-11;
static const double MID_SHARE = 1.0 / 12.0;

// An end of a contact: its vertex (loop index) and the way into the contact, +1 or -1.
typedef struct {
  SbRingSurface surface;
  int vertex, way;
} End;

// A state: what the mesh's motion and a solve change.
typedef struct {
  double *x, *u, *start, *angle, *inner;
} State;

struct AlignedRing {
  SbRing *ring;
  double friction, free_friction; // now, and without a change of the input
  SbRingLoad load;                // without a change of the input
  double force;
  int count;
  End end[ENDS];
  double *weight; // [count][loop] motion of a node of the outline along it, per unit of an end's
  double *motion; // [count][nodes][2] motion of inner nodes
  int *loop_at;   // [nodes] loop index; -1: inside
  // The linear system of the present state, by linearise():
  double *scale;        // [nodes] of the rows of gaps
  double *gradient;     // [2][nodes][4] of the state's and of the start's displacement
  double *column[ENDS]; // [2 nodes] displacement per unit of an end's motion
  double small[ENDS * ENDS];
};

static size_t nodes_of(const AlignedRing *a) {
  return (size_t)a->ring->mesh->nodes;
}

static int wrap(const AlignedRing *a, int i) {
  return sb_ring_wrap(a->ring->contact, i);
}

static double arc_of(const AlignedRing *a, int i) {
  return sb_ring_outline_arc(&a->ring->outline, a->ring->mesh->angle[wrap(a, i)]);
}

// ---- the mesh's motion

// Motion of the outline's nodes for one end, with its direction.
static void slide_outline(AlignedRing *a, int k) {
  const SbRingMesh *mesh = a->ring->mesh;
  const SbRingOutline *outline = &a->ring->outline;
  const double whole = outline->length, at = arc_of(a, a->end[k].vertex), h = 1e-5;
  double up = REACH, down = REACH;
  for (int j = 0; j < a->count; j++) {
    const double away = fmod(arc_of(a, a->end[j].vertex) - at + 2.0 * whole, whole);
    if (away > 1e-9 && away < whole - 1e-9) {
      up = fmin(up, away);
      down = fmin(down, whole - away);
    }
  }
  for (int i = 0; i < mesh->loop_count; i++) {
    const double arc = arc_of(a, i), away = remainder(arc - at, whole);
    const double weight = fmax(0.0, away >= 0.0 ? 1.0 - away / up : 1.0 + away / down);
    double x[2][2];
    sb_ring_outline_place(outline, fmod(arc - h + whole, whole), x[0]);
    sb_ring_outline_place(outline, fmod(arc + h, whole), x[1]);
    a->weight[k * mesh->loop_count + i] = weight;
    for (int c = 0; c < 2; c++) {
      a->motion[2 * (k * mesh->nodes + mesh->loop[i]) + c] =
          weight * (x[1][c] - x[0][c]) / (2.0 * h);
    }
  }
}

// Motion of the other vertices: the mean of their neighbours', by sweeps; mid-sides between theirs.
static void follow_inside(AlignedRing *a, int k) {
  const SbRingMesh *mesh = a->ring->mesh;
  double *motion = &a->motion[2 * k * mesh->nodes];
  double *sum = g_new(double, 3 * nodes_of(a));
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    memset(sum, 0, sizeof(double) * 3 * nodes_of(a));
    for (int s = 0; s < 6 * mesh->elements; s++) {
      const int *tri = &mesh->tri[s / 6 * 6], corner = s % 3;
      const int to = tri[corner], from = tri[(corner + (s % 6 < 3 ? 1 : 2)) % 3];
      sum[3 * to] += motion[2 * from];
      sum[3 * to + 1] += motion[2 * from + 1];
      sum[3 * to + 2] += 1.0;
    }
    for (int i = 0; i < mesh->nodes; i++) {
      for (int c = 0; c < 2 && a->loop_at[i] < 0 && sum[3 * i + 2] > 0.0; c++) {
        motion[2 * i + c] = sum[3 * i + c] / sum[3 * i + 2];
      }
    }
  }
  for (int s = 0; s < 3 * mesh->elements; s++) {
    const int *tri = &mesh->tri[s / 3 * 6], mid = tri[3 + s % 3];
    for (int c = 0; c < 2 && a->loop_at[mid] < 0; c++) {
      motion[2 * mid + c] = 0.5 * (motion[2 * tri[s % 3] + c] + motion[2 * tri[(s + 1) % 3] + c]);
    }
  }
  g_free(sum);
}

// Gradient at the nodes of the deformation by displacements u: the mean of the elements'.
static void gradients(const AlignedRing *a, const double *u, double *out) {
  static const double at[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  const SbRingMesh *mesh = a->ring->mesh;
  int *around = g_new0(int, nodes_of(a));
  memset(out, 0, sizeof(double) * 4 * nodes_of(a));
  for (int e = 0; e < 6 * mesh->elements; e++) {
    const int *tri = &mesh->tri[e / 6 * 6], node = tri[e % 6];
    double n[6], d[2][6], from[2][2] = {{0}}, to[2][2] = {{0}};
    sb_ring_shape(at[e % 6][0], at[e % 6][1], n, d[0], d[1]);
    for (int b = 0; b < 6; b++) {
      for (int c = 0; c < 4; c++) {
        const int at_node = 2 * tri[b] + c / 2;
        from[c / 2][c % 2] += d[c % 2][b] * mesh->x[at_node];
        to[c / 2][c % 2] += d[c % 2][b] * (mesh->x[at_node] + u[at_node]);
      }
    }
    const double det = from[0][0] * from[1][1] - from[0][1] * from[1][0];
    for (int c = 0; c < 2; c++) {
      out[4 * node + 2 * c] += (to[c][0] * from[1][1] - to[c][1] * from[1][0]) / det;
      out[4 * node + 2 * c + 1] += (to[c][1] * from[0][0] - to[c][0] * from[0][1]) / det;
    }
    around[node]++;
  }
  for (int i = 0; i < 4 * mesh->nodes; i++) {
    out[i] /= around[i / 4];
  }
  // Smooth: the root in the strain at an end moves with the end.
  double *mean = g_new(double, 4 * nodes_of(a));
  for (int sweep = 0; sweep < SMOOTHINGS; sweep++) {
    memset(mean, 0, sizeof(double) * 4 * nodes_of(a));
    for (int e = 0; e < mesh->elements; e++) {
      const int *tri = &mesh->tri[6 * e];
      for (int c = 0; c < 4; c++) {
        double sum = 0.0;
        for (int b = 0; b < 6; b++) {
          sum += out[4 * tri[b] + c] / 6.0;
        }
        for (int b = 0; b < 6; b++) {
          mean[4 * tri[b] + c] += sum / around[tri[b]];
        }
      }
    }
    memcpy(out, mean, sizeof(double) * 4 * nodes_of(a));
  }
  g_free(mean);
  g_free(around);
}

// Takes over what the elements compute from their nodes' places. False: an element is inverted.
static bool measure(AlignedRing *a) {
  SbRingFem *fem = a->ring->fem, *fresh;
  if (sb_ring_fem_create(&fresh, fem->mesh, fem->material, fem->around, NULL) != SB_OK) {
    return false;
  }
  double *gauss = fem->gauss;
  fem->gauss = fresh->gauss;
  fresh->gauss = gauss;
  memcpy(fem->mass, fresh->mass, sizeof(double) * nodes_of(a));
  sb_ring_fem_destroy(fresh);
  return true;
}

// Moves the ends by `by` and the mesh with them, in the material that stays.
static bool move(AlignedRing *a, const double by[ENDS]) {
  SbRing *ring = a->ring;
  SbRingMesh *mesh = ring->mesh;
  const double whole = ring->outline.length;
  for (int i = 0; i < mesh->nodes; i++) {
    const int l = a->loop_at[i];
    double dx[2] = {0.0, 0.0}, along = 0.0;
    for (int k = 0; k < a->count; k++) {
      dx[0] += by[k] * a->motion[2 * (k * mesh->nodes + i)];
      dx[1] += by[k] * a->motion[2 * (k * mesh->nodes + i) + 1];
      along += l >= 0 ? by[k] * a->weight[k * mesh->loop_count + l] : 0.0;
    }
    if (along != 0.0) {
      const double arc = fmod(arc_of(a, l) + along + whole, whole), was = mesh->angle[l];
      double x[2];
      sb_ring_outline_place(&ring->outline, arc, x);
      dx[0] = x[0] + ring->centre - mesh->x[2 * i];
      dx[1] = x[1] - mesh->x[2 * i + 1];
      mesh->angle[l] =
          was + remainder(sb_ring_outline_angle(&ring->outline, arc) - was, 2.0 * M_PI);
    }
    double *field[2] = {ring->fem->u, ring->fem->saved[SB_RING_START]};
    for (int c = 0; c < 2; c++) {
      mesh->x[2 * i + c] += dx[c];
      for (int f = 0; f < 2; f++) {
        const double *g = &a->gradient[4 * (f * mesh->nodes + i) + 2 * c];
        field[f][2 * i + c] += g[0] * dx[0] + g[1] * dx[1] - dx[c];
      }
    }
  }
  return measure(a);
}

// ---- states

static void save(const AlignedRing *a, State *state) {
  const SbRingFem *fem = a->ring->fem;
  const size_t n = 2 * nodes_of(a), inner = SB_RING_INNER * (size_t)fem->mesh->elements;
  state->x = g_memdup2(fem->mesh->x, sizeof(double) * n);
  state->u = g_memdup2(fem->u, sizeof(double) * n);
  state->start = g_memdup2(fem->saved[SB_RING_START], sizeof(double) * n);
  state->angle = g_memdup2(fem->mesh->angle, sizeof(double) * (size_t)fem->mesh->loop_count);
  state->inner = g_memdup2(fem->inner, sizeof(double) * inner);
}

static void restore(AlignedRing *a, const State *state) {
  SbRingFem *fem = a->ring->fem;
  const size_t n = 2 * nodes_of(a), inner = SB_RING_INNER * (size_t)fem->mesh->elements;
  memcpy(fem->mesh->x, state->x, sizeof(double) * n);
  memcpy(fem->u, state->u, sizeof(double) * n);
  memcpy(fem->saved[SB_RING_START], state->start, sizeof(double) * n);
  memcpy(fem->mesh->angle, state->angle, sizeof(double) * (size_t)fem->mesh->loop_count);
  memcpy(fem->inner, state->inner, sizeof(double) * inner);
  (void)measure(a);
}

static void forget(State *state) {
  g_free(state->x);
  g_free(state->u);
  g_free(state->start);
  g_free(state->angle);
  g_free(state->inner);
}

// ---- equations

// Normal force of the fluid on a loop node: of all its sides, or of the open ones.
static double fluid_on(const AlignedRing *a, int i, const double n[2], bool open_only) {
  const SbRingContact *contact = a->ring->contact;
  double sum = 0.0;
  i = wrap(a, i);
  for (int first = i - (i % 2 != 0 ? 1 : 2); first <= i; first += 2) {
    const int side = wrap(a, first) / 2, node = i - first;
    double force[3][2], tangent[3][2][3][2], area[3];
    if (node > 2 || (open_only && contact->closed[side])) {
      continue;
    }
    sb_ring_side_load(contact, side, (SbRingSidePressure){.value = contact->wet[side]}, force,
                      tangent, area);
    sum += n[0] * force[node][0] + n[1] * force[node][1];
  }
  return sum;
}

// Coulomb's friction of the bore at a node, of its force without the fluid's on open sides.
static void rub(AlignedRing *a, int i) {
  const SbRingContact *contact = a->ring->contact;
  SbRingFem *fem = a->ring->fem;
  SbRingCondition *condition = &fem->condition[fem->mesh->loop[i]];
  const double *n = condition->direction[0];
  condition->mix = -a->friction;
  condition->drive = -a->friction * fluid_on(a, i, n, true);
  condition->beside_count = condition->drive != 0.0 ? SB_RING_BESIDE : 0;
  memset(condition->drive_slope, 0, sizeof condition->drive_slope);
  for (int k = 0; k < condition->beside_count; k++) {
    condition->beside[k] = fem->mesh->loop[wrap(a, i - 2 + k)];
  }
  for (int half = 0; half < 2 && condition->beside_count > 0; half++) {
    const int side = wrap(a, i - 2 + 2 * half) / 2, node = 2 - 2 * half;
    double force[3][2], tangent[3][2][3][2], area[3];
    if (contact->closed[side]) {
      continue;
    }
    sb_ring_side_load(contact, side, (SbRingSidePressure){.value = contact->wet[side]}, force,
                      tangent, area);
    for (int k = 0; k < 6; k++) { // minus the derivative of the fluid's force
      condition->drive_slope[2 * half + k / 2][k % 2] +=
          a->friction *
          (n[0] * tangent[node][0][k / 2][k % 2] + n[1] * tangent[node][1][k / 2][k % 2]);
    }
  }
}

// Computes residual, tangent and conditions of the present state. False: an element is inverted.
static bool assemble(AlignedRing *a, double *gap) {
  SbRing *ring = a->ring;
  if (!sb_ring_fem_assemble(ring->fem)) {
    return false;
  }
  *gap = sb_ring_contact_apply(ring->contact);
  for (int i = 0; i < ring->contact->count && a->friction != 0.0; i++) {
    if (sb_ring_touch(ring->contact, i, SB_RING_BORE)->held) {
      rub(a, i);
    }
  }
  return true;
}

// Change of the fluid's normal force on a node by the displacements fem->du.
static double fluid_change(const AlignedRing *a, int i, const double n[2]) {
  static const double h = 1e-6;
  SbRingFem *fem = a->ring->fem;
  double *own = fem->u, *moved = g_new(double, 2 * nodes_of(a)), by[2];
  for (int s = 0; s < 2; s++) {
    for (size_t q = 0; q < 2 * nodes_of(a); q++) {
      moved[q] = own[q] + (s == 0 ? -h : h) * fem->du[q];
    }
    fem->u = moved;
    by[s] = fluid_on(a, i, n, false);
    fem->u = own;
  }
  g_free(moved);
  return (by[1] - by[0]) / (2.0 * h);
}

// The equation of an end, or its change by the displacements fem->du.
static double end_equation(const AlignedRing *a, int k, bool change) {
  const End *end = &a->end[k];
  const SbRingFem *fem = a->ring->fem;
  double sum = 0.0;
  for (int j = 0; j < 2; j++) {
    const int i = wrap(a, end->vertex + j * end->way), node = fem->mesh->loop[i];
    const SbRingFrame frame = sb_ring_frame_at(a->ring->contact, i, end->surface);
    const double *n = frame.n, *residual = &fem->residual[2 * node];
    double force[2] = {residual[0], residual[1]};
    if (change) {
      sb_ring_fem_reaction(fem, node, force);
      force[0] -= residual[0];
      force[1] -= residual[1];
    }
    const double fluid = change ? fluid_change(a, i, n) : fluid_on(a, i, n, false);
    sum += (j == 0 ? 1.0 : -MID_SHARE) * (n[0] * force[0] + n[1] * force[1] - fluid);
  }
  return sum;
}

// Minus the equations of the present residual and conditions, in the rows of the factorised matrix.
static void right_side(const AlignedRing *a, double *rhs) {
  const SbRingFem *fem = a->ring->fem;
  for (int i = 0; i < fem->mesh->nodes; i++) {
    const SbRingCondition *c = &fem->condition[i];
    const double r[2] = {fem->residual[2 * i], fem->residual[2 * i + 1]};
    const double *n = c->direction[0], *t = c->direction[1];
    const int fixed = fabs(n[0]) >= fabs(n[1]) ? 0 : 1;
    rhs[2 * i] = -r[0];
    rhs[2 * i + 1] = -r[1];
    if (c->count > 0) {
      const double along = t[0] * r[0] + t[1] * r[1] + c->mix * (n[0] * r[0] + n[1] * r[1]);
      rhs[2 * i + fixed] = a->scale[i] * c->gap[0];
      rhs[2 * i + 1 - fixed] = c->count == 2 ? a->scale[i] * c->gap[1] : c->drive - along;
    }
  }
}

// ---- the bordered system

// Differences of all equations by one number: `turn` changes it by +-h, `data` with it. The matrix
// and what belongs to it stay those of the present state.
typedef bool Turn(AlignedRing *a, int which, double h);

static void differences(AlignedRing *a, Turn *turn, int which, double *rows, double ends[ENDS]) {
  SbRingFem *fem = a->ring->fem;
  const size_t n = 2 * nodes_of(a);
  const size_t blocks = SB_RING_BLOCK * (size_t)fem->row_start[fem->mesh->nodes];
  const size_t condensed = SB_RING_INNER * (2 * 6 + 1) * (size_t)fem->mesh->elements;
  double *value = fem->value, *kept = g_memdup2(fem->condensed, sizeof(double) * condensed);
  double *residual = g_memdup2(fem->residual, sizeof(double) * n), *moved = g_new(double, n);
  SbRingCondition *condition = g_memdup2(fem->condition, sizeof *condition * nodes_of(a));
  State state;
  save(a, &state);
  fem->value = g_new(double, blocks);
  memset(rows, 0, sizeof(double) * n);
  memset(ends, 0, sizeof(double) * ENDS);
  for (int s = 0; s < 2; s++) {
    const double share = (s == 0 ? -0.5 : 0.5) / STEP;
    double gap;
    (void)(turn(a, which, s == 0 ? -STEP : STEP) && assemble(a, &gap));
    right_side(a, moved);
    for (size_t q = 0; q < n; q++) {
      rows[q] += share * moved[q];
    }
    for (int k = 0; k < a->count; k++) {
      ends[k] += share * end_equation(a, k, false);
    }
    (void)turn(a, which, 0.0);
    restore(a, &state);
  }
  g_free(fem->value);
  fem->value = value;
  memcpy(fem->condensed, kept, sizeof(double) * condensed);
  memcpy(fem->residual, residual, sizeof(double) * n);
  memcpy(fem->condition, condition, sizeof *condition * nodes_of(a));
  g_free(kept);
  g_free(residual);
  g_free(moved);
  g_free(condition);
  forget(&state);
}

static bool turn_end(AlignedRing *a, int end, double h) {
  double by[ENDS] = {0.0};
  by[end] = h;
  return h == 0.0 || move(a, by);
}

// Multiplies an input by 1 + change.
static void set_input(AlignedRing *a, AlignedInput input, double change) {
  SbRingLoad *now = &a->ring->contact->is.now;
  *now = a->load;
  a->ring->force = a->force;
  a->friction = a->free_friction;
  switch (input) {
  case ALIGNED_MODULUS: // the unit of stress
    now->pressure_left /= 1.0 + change;
    now->pressure_right /= 1.0 + change;
    a->ring->force *= 1.0 + change;
    break;
  case ALIGNED_SQUEEZE:
    now->bore_radius -= change * (1.0 - (now->bore_radius - now->floor_radius));
    break;
  default:
    a->friction *= 1.0 + change;
  }
}

static bool turn_input(AlignedRing *a, int input, double h) {
  set_input(a, (AlignedInput)input, h);
  return true;
}

// Factorises the matrix of the assembled state and solves for the columns of the ends.
static bool linearise(AlignedRing *a) {
  SbRingFem *fem = a->ring->fem;
  const size_t n = 2 * nodes_of(a);
  for (int i = 0; i < fem->mesh->nodes; i++) {
    const double *diagonal = &fem->value[SB_RING_BLOCK * fem->diagonal[i]];
    a->scale[i] = fmax(fabs(diagonal[0]), fabs(diagonal[3]));
  }
  gradients(a, fem->u, a->gradient);
  gradients(a, fem->saved[SB_RING_START], a->gradient + 4 * nodes_of(a));
  if (sb_ring_fem_factor(fem, NULL) != SB_OK) {
    return false;
  }
  double *rhs = g_memdup2(fem->rhs, sizeof(double) * n), ends[ENDS];
  bool good = true;
  for (int k = 0; k < a->count && good; k++) {
    differences(a, turn_end, k, fem->rhs, ends);
    good = sb_ring_fem_apply_factor(fem, NULL) == SB_OK;
    memcpy(a->column[k], fem->du, sizeof(double) * n);
    for (int j = 0; j < a->count; j++) {
      a->small[k * a->count + j] = ends[j] + end_equation(a, j, true);
    }
  }
  memcpy(fem->rhs, rhs, sizeof(double) * n);
  g_free(rhs);
  return good;
}

// Solves for the displacements fem->du and the ends' motion by the right-hand side fem->rhs and the
// ends' equations `ends`.
static bool solve_linear(AlignedRing *a, const double ends[ENDS], double by[ENDS]) {
  SbRingFem *fem = a->ring->fem;
  double small[ENDS * ENDS];
  if (sb_ring_fem_apply_factor(fem, NULL) != SB_OK) {
    return false;
  }
  for (int j = 0; j < a->count; j++) {
    by[j] = -ends[j] - end_equation(a, j, true);
  }
  memcpy(small, a->small, sizeof small);
  if (!sb_eliminate(small, by, (size_t)a->count)) {
    return false;
  }
  for (int k = 0; k < a->count; k++) {
    for (size_t q = 0; q < 2 * nodes_of(a); q++) {
      fem->du[q] += by[k] * a->column[k][q];
    }
  }
  return true;
}

static double largest(const double *v, size_t n) {
  double most = 0.0;
  for (size_t i = 0; i < n; i++) {
    most = fmax(most, fabs(v[i]));
  }
  return most;
}

int aligned_solve(AlignedRing *a) {
  SbRingFem *fem = a->ring->fem;
  const size_t n = 2 * nodes_of(a);
  for (int it = 0; it < ITERATIONS; it++) {
    double gap, ends[ENDS], by[ENDS];
    if (!assemble(a, &gap)) {
      return -1;
    }
    for (int k = 0; k < a->count; k++) {
      ends[k] = end_equation(a, k, false);
    }
    if (sb_ring_fem_free_residual(fem) < BALANCE && gap < GAP &&
        largest(ends, (size_t)a->count) < PLACED) {
      return it;
    }
    if (!linearise(a) || !solve_linear(a, ends, by)) {
      return -1;
    }
    const double moves = largest(by, (size_t)a->count);
    const double step = fmin(1.0, fmin(END_MOST / moves, NODE_MOST / largest(fem->du, n)));
    for (int k = 0; k < a->count; k++) {
      by[k] *= step;
    }
    sb_ring_fem_advance(fem, step);
    if (!move(a, by)) {
      return -1;
    }
  }
  return -1;
}

// ---- contacts

// Returns the vertex for an end of a run of nodes in contact, near `place` along the surface: that
// of the recovered pressure, or NaN.
static int end_vertex(const AlignedRing *a, SbRingSurface surface, int node, int way,
                      double place) {
  const int axis = surface == SB_RING_BORE || surface == SB_RING_FLOOR ? 1 : 0;
  int best = node % 2 == 0 ? node : node - way;
  double least = INFINITY;
  for (int i = node - REACH_SIDES; i <= node + REACH_SIDES && isfinite(place); i++) {
    double x[2];
    sb_ring_contact_place(a->ring->contact, i, x);
    if (i % 2 == 0 && fabs(x[axis] - place) < least) {
      least = fabs(x[axis] - place);
      best = i;
    }
  }
  return best;
}

// Makes the ends of one surface's contacts from its nodes in contact.
static void find_contacts(AlignedRing *a, SbRingSurface surface) {
  SbRingContact *contact = a->ring->contact;
  const int count = contact->count;
  SbRingPatch patch;
  SbDryContact pressure;
  if (!sb_ring_patch(a->ring, surface, &patch)) {
    return;
  }
  (void)sb_ring_ends(a->ring, surface, &patch, &pressure);
  bool *held = g_new(bool, (size_t)count);
  for (int i = 0; i < count; i++) { // without single open nodes
    held[i] =
        sb_ring_touch(contact, i, surface)->held || (sb_ring_touch(contact, i - 1, surface)->held &&
                                                     sb_ring_touch(contact, i + 1, surface)->held);
  }
  for (int i = 0; i < count; i++) {
    sb_ring_touch(contact, i, surface)->held = false;
  }
  for (int first = patch.first; first < patch.first + count; first++) {
    int last = first;
    if (!held[wrap(a, first)] || held[wrap(a, first - 1)]) {
      continue;
    }
    while (held[wrap(a, last + 1)]) {
      last++;
    }
    if (last - first + 1 < LEAST_NODES || a->count + 2 > ENDS) {
      continue;
    }
    const bool outer[2] = {wrap(a, first) == wrap(a, patch.first),
                           wrap(a, last) == wrap(a, patch.last)};
    const int from = end_vertex(a, surface, first, 1, outer[0] ? patch.place[0] : NAN);
    const int to = end_vertex(a, surface, last, -1, outer[1] ? patch.place[1] : NAN);
    a->end[a->count++] = (End){surface, wrap(a, from), 1};
    a->end[a->count++] = (End){surface, wrap(a, to), -1};
    for (int i = from; i <= to; i++) {
      sb_ring_touch(contact, i, surface)->held = true;
    }
  }
  g_free(held);
}

AlignedRing *aligned_create(SbRing *ring, double friction) {
  AlignedRing *a = g_new0(AlignedRing, 1);
  SbRingFem *fem = ring->fem;
  a->ring = ring;
  a->friction = a->free_friction = friction;
  a->load = ring->contact->is.now;
  a->force = ring->force;
  fem->axial_damping = fem->axial_rest = 0.0;
  for (int s = 0; s < SB_RING_SURFACES; s++) {
    find_contacts(a, (SbRingSurface)s);
  }
  const size_t nodes = nodes_of(a), count = (size_t)a->count, loop = (size_t)ring->contact->count;
  a->loop_at = g_new(int, nodes);
  memset(a->loop_at, -1, sizeof(int) * nodes);
  for (size_t i = 0; i < loop; i++) {
    a->loop_at[ring->mesh->loop[i]] = (int)i;
  }
  a->weight = g_new0(double, count *loop);
  a->motion = g_new0(double, 2 * count * nodes);
  a->scale = g_new0(double, nodes);
  a->gradient = g_new0(double, 8 * nodes);
  for (int k = 0; k < a->count; k++) {
    a->column[k] = g_new0(double, 2 * nodes);
    slide_outline(a, k);
    follow_inside(a, k);
  }
  if (a->count == 0) {
    aligned_destroy(a);
    return NULL;
  }
  return a;
}

void aligned_destroy(AlignedRing *a) {
  for (int k = 0; k < a->count; k++) {
    g_free(a->column[k]);
  }
  g_free(a->loop_at);
  g_free(a->weight);
  g_free(a->motion);
  g_free(a->scale);
  g_free(a->gradient);
  g_free(a);
}

// ---- results

// Sums a surface's normal and tangential force of the assembled state.
static void sum_force(const AlignedRing *a, SbRingSurface surface, double force[2]) {
  const SbRingFem *fem = a->ring->fem;
  force[0] = force[1] = 0.0;
  for (int i = 0; i < a->ring->contact->count; i++) {
    if (sb_ring_touch(a->ring->contact, i, surface)->held) {
      const double *r = &fem->residual[2 * fem->mesh->loop[i]];
      const SbRingFrame frame = sb_ring_frame_at(a->ring->contact, i, surface);
      force[0] += frame.n[0] * r[0] + frame.n[1] * r[1] - fluid_on(a, i, frame.n, true);
      force[1] += frame.t[0] * r[0] + frame.t[1] * r[1];
    }
  }
  force[0] *= a->ring->force;
  force[1] *= a->ring->force;
}

double aligned_force(AlignedRing *a, SbRingSurface surface) {
  double force[2], gap;
  (void)assemble(a, &gap);
  sum_force(a, surface, force);
  return force[0];
}

void aligned_results(AlignedRing *a, double out[ALIGNED_RESULTS]) {
  double force[2], x[2][2], gap;
  (void)assemble(a, &gap);
  sum_force(a, SB_RING_FLOOR, force);
  out[ALIGNED_FLOOR] = force[0];
  sum_force(a, SB_RING_BORE, force);
  out[ALIGNED_LOAD] = force[0];
  out[ALIGNED_DRAG] = fabs(force[1]);
  for (int k = 0; k < 2; k++) { // the bore's ends come first
    sb_ring_contact_place(a->ring->contact, a->end[k].vertex, x[k]);
  }
  out[ALIGNED_WIDTH] = (x[1][1] - x[0][1]) * a->ring->length;
}

bool aligned_slopes(AlignedRing *a, AlignedInput input, double out[ALIGNED_RESULTS]) {
  static const double h = 1e-5; // of the results along the solution
  SbRingFem *fem = a->ring->fem;
  const size_t n = 2 * nodes_of(a);
  double gap, ends[ENDS], by[ENDS], base[ALIGNED_RESULTS], at[2][ALIGNED_RESULTS];
  State state;
  aligned_results(a, base);
  if (!assemble(a, &gap) || !linearise(a)) {
    return false;
  }
  differences(a, turn_input, (int)input, fem->rhs, ends);
  if (!solve_linear(a, ends, by)) {
    return false;
  }
  double *du = g_memdup2(fem->du, sizeof(double) * n);
  save(a, &state);
  for (int s = 0; s < 2; s++) {
    const double share = s == 0 ? -h : h;
    double moved[ENDS];
    (void)assemble(a, &gap);
    memcpy(fem->du, du, sizeof(double) * n);
    sb_ring_fem_advance(fem, share);
    for (int k = 0; k < a->count; k++) {
      moved[k] = share * by[k];
    }
    (void)move(a, moved);
    set_input(a, input, share);
    aligned_results(a, at[s]);
    set_input(a, input, 0.0);
    restore(a, &state);
  }
  for (int q = 0; q < ALIGNED_RESULTS; q++) {
    out[q] = (at[1][q] - at[0][q]) / (2.0 * h * base[q]);
  }
  forget(&state);
  g_free(du);
  return true;
}

int aligned_solve_at(AlignedRing *a, AlignedInput input, double change,
                     double out[ALIGNED_RESULTS]) {
  State state;
  save(a, &state);
  set_input(a, input, change);
  const int iterations = aligned_solve(a);
  aligned_results(a, out);
  set_input(a, input, 0.0);
  restore(a, &state);
  forget(&state);
  return iterations;
}

bool aligned_roots(AlignedRing *a, double out[2]) {
  SbRing *ring = a->ring;
  SbRingPatch patch;
  SbDryContact pressure;
  double gap;
  (void)assemble(a, &gap);
  sb_ring_contact_forces(ring->contact);
  if (!sb_ring_patch(ring, SB_RING_BORE, &patch) ||
      !sb_ring_ends(ring, SB_RING_BORE, &patch, &pressure)) {
    return false;
  }
  // 1 - z^2 = 2 d / half at the distance d from an end.
  const double half = 0.5 * (pressure.right - pressure.left) * ring->length * 1e3;
  out[0] = pressure.edge_left * ring->stress * 1e-6 * sqrt(2.0 / half);
  out[1] = pressure.edge_right * ring->stress * 1e-6 * sqrt(2.0 / half);
  return true;
}

void aligned_faults(AlignedRing *a, double *tension, double *penetration) {
  const SbRingContact *contact = a->ring->contact;
  const SbRingFem *fem = a->ring->fem;
  double gap;
  (void)assemble(a, &gap);
  *tension = *penetration = 0.0;
  for (int i = 0; i < contact->count; i++) {
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      const SbRingFrame frame = sb_ring_frame_at(contact, i, (SbRingSurface)s);
      const double *r = &fem->residual[2 * fem->mesh->loop[i]], *n = frame.n;
      const double excess = n[0] * r[0] + n[1] * r[1] - fluid_on(a, i, n, false);
      if (sb_ring_touch(contact, i, s)->held) {
        *tension = fmax(*tension, -excess / contact->weight[i]);
      } else {
        *penetration = fmax(*penetration, -frame.gap);
      }
    }
  }
}
