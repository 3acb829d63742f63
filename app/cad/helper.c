// sealbench-cad FILE.step ANGLE DX DY DZ PX PY PZ: the bodies of a STEP file as text on standard
// output, by gmsh and its OpenCASCADE kernel. A program of its own: a kernel that crashes, hangs or
// takes memory without end on a hostile file ends here, within the limits set below. Lengths in m,
// the axis along x; each body cut by the half-plane at ANGLE [rad] about it; "nan": by one that
// meets no port. DX and PX: direction and a point [m] of the axis; "nan": found. The text:
//   axis px py pz dx dy dz            in the file's place, a point and a direction
//   body NAME
//   solid V V cx cy cz Ixx Ixy ... Izz     SbSolid: volume, mass, centre, moments at 1 kg/m3
//   note TEXT                         a warning
//   why TEXT                          instead of pieces
//   piece x0 y0 x1 y1 bulge           of the half-section, in no order
//   end
#include "app/cad/cad_private.h"

#include "engine/mechanism/vector3.h"

#include <gmshc.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

// The kernel works in mm, for which its tolerances are made.
static const double SCALE = 1e-3;
enum { PIECES_MAX = 100000 };

// Half-plane that is tried first [rad], off those in which ports and flats are drawn; how near the
// volumes of a body and its half-section, revolved, are where no other one is tried; how much more
// another one must give, relative.
static const double OFF_PORTS = 0.658, NEAR = 0.02, MORE = 1e-3;
static const rlim_t MEMORY_MAX = (rlim_t)4 << 30;

// What standard output was: the kernel prints there as it likes, from now on to nowhere.
static FILE *out;

// Each second: ends the program if it has not used the processor for too long.
static void on_alarm(int signal_number) {
  static clock_t before;
  static int stalled;
  const clock_t now = clock();
  stalled = now > before ? 0 : stalled + 1;
  before = now;
  if (stalled >= SB_CAD_STALLED_MAX) {
    signal(SIGALRM, SIG_DFL);
    raise(SIGALRM);
  }
}

// Ends the program where the kernel failed.
static void check(int failed, const char *what) {
  if (failed != 0) {
    fprintf(out, "error %s\n", what);
    fflush(out);
    exit(1);
  }
}

typedef enum { ROUND, BALL, PLANE, OTHER } Kind; // of faces; the point of a ball is its centre
typedef struct {
  double point[3], direction[3]; // mm
  double area;                   // of the faces about it
  Kind kind;
} Axis;

static void print_numbers(const char *word, const double *number, int count) {
  fprintf(out, "%s", word);
  for (int i = 0; i < count; i++) {
    fprintf(out, " %.17g", number[i]);
  }
  fprintf(out, "\n");
}

// Moves the point to the one nearest to the origin; `oriented`: one sign of opposite directions.
static void nearest_point(Axis *axis, bool oriented) {
  int largest = 0;
  for (int k = 1; k < 3; k++) {
    largest = fabs(axis->direction[k]) > fabs(axis->direction[largest]) + 1e-9 ? k : largest;
  }
  const double along = dot(axis->point, axis->direction);
  const double sign = oriented && axis->direction[largest] < 0 ? -1 : 1;
  for (int k = 0; k < 3; k++) {
    axis->point[k] -= along * axis->direction[k];
    axis->direction[k] *= sign;
  }
}

// Samples of a face in each direction; singular values that are zero, relative to the largest; two
// axes that are one: 1 - cosine of the angle, and distance [mm].
enum { GRID = 5, SAMPLES = GRID * GRID, AXES_MAX = 5000 };
static const double ZERO = 1e-3, PARALLEL = 1e-8, SAME = 1e-3;

// Gives points and unit normals of a face, freed by gmshFree(); returns whether the kernel has
// them.
static bool sample(double **at, double **normal, int tag) {
  double *low = NULL, *high = NULL, where[2 * SAMPLES];
  size_t n_low = 0, n_high = 0, n_at = 0, n_normal = 0;
  int ierr, wrong = 1;
  gmshModelGetParametrizationBounds(2, tag, &low, &n_low, &high, &n_high, &ierr);
  if (ierr == 0 && n_low == 2 && n_high == 2) {
    for (int i = 0; i < 2 * SAMPLES; i++) { // off poles and seams
      const int step = i % 2 == 0 ? i / 2 % GRID : i / 2 / GRID;
      where[i] = low[i % 2] + (step + 0.4) / GRID * (high[i % 2] - low[i % 2]);
    }
    gmshModelGetValue(2, tag, where, 2 * SAMPLES, at, &n_at, &ierr);
    gmshModelGetNormal(tag, where, 2 * SAMPLES, normal, &n_normal, &wrong);
  }
  gmshFree(low);
  gmshFree(high);
  bool good = ierr + wrong == 0 && n_at == 3 * SAMPLES && n_normal == 3 * SAMPLES;
  for (int i = 0; good && i < 3 * SAMPLES; i++) {
    good = isfinite((*at)[i]) && isfinite((*normal)[i]);
  }
  return good;
}

// Writes the direction of an axis, and to `p` its point nearest to the centre or the centre of a
// ball, from the last `count` columns of v[6][6] (d and m of a line): the shortest solution of
// p x d = m for all of them.
static Kind axis_of_columns(Axis *axis, double p[3], const double v[36], int count) {
  double a[27] = {0}, moments[9] = {0}, turns[9], s[3], work[3], longest = 0, pitch = 0;
  for (int j = 0; j < count; j++) {
    const double *from = v + 6 - count + j;
    const double d[3] = {from[0], from[6], from[12]}, m[3] = {from[18], from[24], from[30]};
    const double length = sqrt(dot(d, d));
    const double rows[9] = {0, d[2], -d[1], -d[2], 0, d[0], d[1], -d[0], 0};
    memcpy(a + 9 * (size_t)j, rows, sizeof rows);
    memcpy(moments + 3 * (size_t)j, m, sizeof m);
    for (int k = 0; length > longest && k < 3; k++) {
      axis->direction[k] = d[k] / length;
    }
    pitch = length > longest ? dot(axis->direction, m) / length : pitch;
    longest = fmax(longest, length);
  }
  gsl_matrix_view all = gsl_matrix_view_array(a, 9, 3), right = gsl_matrix_view_array(turns, 3, 3);
  gsl_vector_view values = gsl_vector_view_array(s, 3), room = gsl_vector_view_array(work, 3);
  gsl_vector_view b = gsl_vector_view_array(moments, 9), x = gsl_vector_view_array(p, 3);
  if (gsl_linalg_SV_decomp(&all.matrix, &right.matrix, &values.vector, &room.vector) != 0) {
    return OTHER;
  }
  const bool parallel = s[2] < ZERO;
  s[2] = parallel ? 0 : s[2];
  gsl_linalg_SV_solve(&all.matrix, &right.matrix, &values.vector, &b.vector, &x.vector);
  // All rotations of a plane have one direction. Without a rotation, an extruded face; with a
  // pitch, a thread.
  return count == 3                                             ? (parallel ? PLANE : BALL)
         : longest > ZERO && (count == 2 || fabs(pitch) < ZERO) ? ROUND
                                                                : OTHER;
}

// Finds the axis that all normals of a face meet, d.(q x n) + m.n = 0 with the moment m = p x d, as
// the null space of this linear system (the line complex of the normals: H. Pottmann, J. Wallner,
// Computational Line Geometry, Springer 2001, section 3.4). Its dimension is 1 for a face of
// revolution, 2 for a cylinder, 3 for a ball or a plane; others are not changed.
static void axis_of(Axis *axis, int tag) {
  double *q = NULL, *n = NULL, centre[3] = {0}, size = 0, a[SAMPLES * 6], v[36], s[6], w[6];
  const bool good = sample(&q, &n, tag);
  for (int i = 0; good && i < 3 * SAMPLES; i++) {
    centre[i % 3] += q[i] / SAMPLES;
  }
  for (int i = 0; good && i < SAMPLES; i++) {
    for (int k = 0; k < 3; k++) {
      q[3 * i + k] -= centre[k];
    }
    size = fmax(size, sqrt(dot(q + 3 * (size_t)i, q + 3 * (size_t)i)));
  }
  for (int i = 0; good && i < SAMPLES; i++) {
    cross(a + 6 * (size_t)i, q + 3 * (size_t)i, n + 3 * (size_t)i);
    for (int k = 0; k < 3; k++) {
      a[6 * i + k] /= size;
      a[6 * i + 3 + k] = n[3 * i + k];
    }
  }
  gmshFree(q);
  gmshFree(n);
  gsl_matrix_view all = gsl_matrix_view_array(a, SAMPLES, 6), cols = gsl_matrix_view_array(v, 6, 6);
  gsl_vector_view values = gsl_vector_view_array(s, 6), work = gsl_vector_view_array(w, 6);
  if (!(size > 0) ||
      gsl_linalg_SV_decomp(&all.matrix, &cols.matrix, &values.vector, &work.vector) != 0) {
    return;
  }
  int count = 0;
  while (count < 4 && s[5 - count] <= ZERO * s[0]) {
    count++;
  }
  double p[3] = {0};
  axis->kind = count == 0 || count > 3 ? OTHER : axis_of_columns(axis, p, v, count);
  for (int k = 0; k < 3; k++) {
    axis->point[k] = centre[k] + size * p[k];
  }
}

// Distance of two axes, centres of balls, or planes of one direction, which is 0 [mm].
static double apart(const Axis *a, const Axis *b) {
  double d[3], off[3];
  for (int k = 0; k < 3; k++) {
    d[k] = a->kind != PLANE ? a->point[k] - b->point[k] : 0;
  }
  cross(off, d, b->direction);
  return sqrt(a->kind == ROUND ? dot(off, off) : dot(d, d));
}

// Adds the area of a face to those about its axis.
static void count_face(Axis *axes, int *count, int tag) {
  Axis axis = {.kind = OTHER};
  int k = 0, ierr;
  axis_of(&axis, tag);
  gmshModelOccGetMass(2, tag, &axis.area, &ierr);
  if (axis.kind == OTHER || ierr != 0) {
    return;
  }
  while (k < *count &&
         (axes[k].kind != axis.kind || apart(&axis, &axes[k]) > SAME ||
          (axis.kind != BALL && fabs(dot(axes[k].direction, axis.direction)) < 1 - PARALLEL))) {
    k++;
  }
  if (k == *count && k < AXES_MAX) {
    axes[(*count)++] = axis;
  } else if (k < AXES_MAX) {
    axes[k].area += axis.area;
  }
}

static bool is_better(const Axis *a, const Axis *than) {
  return a->kind != than->kind ? a->kind < than->kind : a->area > than->area;
}

// Finds the axis that most area of the round faces turns about, of those along `direction` if that
// is given; without one that through the centre of the largest ball and that of another one, or
// else at right angles to the largest plane, or else along x; without a ball that through the
// centre of mass if a direction or a point is given. A given point replaces the one found. Returns
// what is wrong, static, or NULL.
static const char *find_axis(Axis *best, const int *bodies, size_t count, const double direction[3],
                             const double through[3]) {
  static Axis axes[AXES_MAX];
  int found = 0, ierr, *faces = NULL;
  size_t face_count = 0;
  const bool directed = !isnan(direction[0]), pointed = !isnan(through[0]);
  gmshModelGetEntities(&faces, &face_count, 2, &ierr);
  check(ierr, "the file's faces cannot be listed");
  for (size_t i = 0; i + 1 < face_count; i += 2) {
    count_face(axes, &found, faces[i + 1]);
  }
  gmshFree(faces);
  const Axis none = {.kind = OTHER}, *first = &none, *next = &none;
  for (const Axis *own = axes; own < axes + found; own++) {
    const bool fits = !directed || fabs(dot(own->direction, direction)) >= 1 - PARALLEL;
    first = (fits || own->kind != ROUND) && is_better(own, first) ? own : first;
  }
  int planes = 0; // directions of them
  for (const Axis *own = axes; own < axes + found; own++) {
    next = own != first && own->kind != ROUND && is_better(own, next) ? own : next;
    planes += own->kind == PLANE;
  }
  if (!directed && first->kind == BALL && next->kind == PLANE && planes > 1) {
    return "is a ball with planes of several directions: any of them may be across its axis";
  }
  *best = first->kind <= BALL ? *first : (Axis){.area = 0};
  for (int k = 0; best->kind == BALL && k < 3; k++) {
    const double way = (next->point[k] - first->point[k]) / apart(first, next);
    best->direction[k] = next->kind == BALL    ? way
                         : next->kind == PLANE ? next->direction[k]
                                               : k == 0;
  }
  double mass = 0;
  for (size_t i = 0; best->area == 0 && (directed || pointed) && i < count; i += 2) {
    double part = 0, at[3] = {0};
    gmshModelOccGetMass(3, bodies[i + 1], &part, &ierr);
    gmshModelOccGetCenterOfMass(3, bodies[i + 1], &at[0], &at[1], &at[2], &ierr);
    mass += part;
    for (int k = 0; k < 3; k++) {
      best->point[k] += part / mass * (at[k] - best->point[k]);
      best->direction[k] = k == 0;
    }
  }
  if (directed) {
    memcpy(best->direction, direction, sizeof best->direction);
  }
  if (pointed) {
    memcpy(best->point, through, sizeof best->point);
  }
  nearest_point(best, !directed);
  return best->area > 0 || mass > 0 ? NULL : "has no face of revolution, so no axis";
}

// Moves everything so that the axis is x and the half-plane at `angle` is y > 0, z = 0.
static void place(int *bodies, size_t count, const Axis *axis, double angle) {
  int ierr;
  gmshModelOccTranslate(bodies, count, -axis->point[0], -axis->point[1], -axis->point[2], &ierr);
  check(ierr, "the bodies cannot be moved");
  const double x[3] = {1, 0, 0};
  double by[3];
  cross(by, axis->direction, x);
  const double sine = sqrt(dot(by, by));
  if (sine > 1e-15) {
    gmshModelOccRotate(bodies, count, 0, 0, 0, by[0] / sine, by[1] / sine, by[2] / sine,
                       atan2(sine, axis->direction[0]), &ierr);
    check(ierr, "the bodies cannot be turned");
  }
  gmshModelOccRotate(bodies, count, 0, 0, 0, 1, 0, 0, -angle, &ierr);
  check(ierr, "the bodies cannot be turned");
  gmshModelOccSynchronize(&ierr);
  check(ierr, "the bodies cannot be placed");
}

typedef struct {
  int tag;
  double low, high;
} Edge;

static void edge_at(const void *curve, double t, double xy[2]) {
  const Edge *edge = curve;
  double where = edge->low + t * (edge->high - edge->low), *at = NULL;
  size_t count = 0;
  int ierr;
  gmshModelGetValue(1, edge->tag, &where, 1, &at, &count, &ierr);
  const bool good = ierr == 0 && count == 3;
  xy[0] = good ? SCALE * at[0] : NAN;
  xy[1] = good ? SCALE * at[1] : NAN;
  gmshFree(at);
}

static bool print_edges(int face) {
  int ierr, *edges = NULL;
  size_t count = 0;
  int of[2] = {2, face};
  gmshModelGetBoundary(of, 2, &edges, &count, 0, 0, 0, &ierr);
  bool good = ierr == 0;
  g_autoptr(GArray) pieces = g_array_new(FALSE, FALSE, sizeof(SbPiece));
  for (size_t i = 0; good && i + 1 < count; i += 2) {
    const int tag = edges[i + 1];
    double *low = NULL, *high = NULL;
    size_t n_low = 0, n_high = 0;
    gmshModelGetParametrizationBounds(1, tag, &low, &n_low, &high, &n_high, &ierr);
    good = ierr == 0 && n_low == 1 && n_high == 1;
    if (good) {
      const Edge edge = {tag, low[0], high[0]};
      char *type = NULL;
      gmshModelGetType(1, tag, &type, &ierr);
      const bool plain = ierr == 0 && (strcmp(type, "Line") == 0 || strcmp(type, "Circle") == 0);
      gmshFree(type);
      good = sb_cad_curve(pieces, edge_at, &edge, plain ? 1 : 4);
    }
    gmshFree(low);
    gmshFree(high);
  }
  static guint written;
  written += pieces->len;
  good = good && written <= PIECES_MAX;
  for (guint i = 0; good && i < pieces->len; i++) {
    const SbPiece *p = &g_array_index(pieces, SbPiece, i);
    print_numbers("piece", (double[]){p->x0, p->y0, p->x1, p->y1, p->bulge}, 5);
  }
  gmshFree(edges);
  return good;
}

// Prints the half-section of a body of this volume [mm3]: that of the first of PLANES half-planes
// that is near it, revolved, else that of the largest one: the others meet ports.
static void print_section(int body, double volume, bool chosen) {
  enum { PLANES = 8 };
  int ierr, *best = NULL, own[2] = {3, body};
  double box[6], most = -1;
  size_t best_count = 0;
  bool failed = true;
  gmshModelOccGetBoundingBox(3, body, &box[0], &box[1], &box[2], &box[3], &box[4], &box[5], &ierr);
  for (int k = 0; ierr == 0 && k < (chosen ? 1 : PLANES) && !(fabs(most / volume - 1) < NEAR);
       k++) {
    size_t count;
    double each;
    bool wrong;
    int *faces = sb_cad_cut(&count, &each, &wrong, body, box);
    failed = failed && wrong;
    const bool better = each > (1 + MORE) * most;
    gmshFree(better ? best : faces);
    best = better ? faces : best;
    best_count = better ? count : best_count;
    most = better ? each : most;
    gmshModelOccRotate(own, 2, 0, 0, 0, 1, 0, 0, -2 * M_PI / PLANES, &ierr);
  }
  gmshModelOccSynchronize(&ierr);
  bool good = ierr == 0 && !failed;
  for (size_t i = 0; good && i < best_count; i++) {
    good = print_edges(best[i]);
  }
  if (!good || best_count == 0) {
    fprintf(out, "why %s\n", good ? "the half-plane does not meet it" : "the kernel cannot cut it");
  }
  gmshFree(best);
}

static void print_body(int body, int number, bool chosen) {
  int ierr;
  char *name = NULL;
  gmshModelGetEntityName(3, body, &name, &ierr);
  // "Shapes/Assembly/stem": the last part; one line, whatever it holds.
  const char *whole = ierr == 0 && name != NULL ? name : "", *slash = strrchr(whole, '/');
  const char *last = slash != NULL ? slash + 1 : whole;
  // What the kernel writes where it was given no name.
  last = strncmp(last, "Open CASCADE STEP translator", 28) == 0 ? "" : last;
  g_autofree char *own = *last != '\0' ? g_strdup(last) : g_strdup_printf("body %d", number);
  fprintf(out, "body %s\n", g_strdelimit(own, "\r\n", ' '));
  gmshFree(name);
  SbSolid solid;
  bool coarse;
  check(!sb_cad_measure(&solid, body, &coarse), "the kernel cannot measure a body");
  double value[14] = {pow(SCALE, 3) * solid.volume, pow(SCALE, 3) * solid.volume};
  for (int k = 0; k < 9; k++) {
    value[2 + k % 3] = SCALE * solid.centre[k % 3];
    value[5 + k] = pow(SCALE, 5) * solid.inertia[k / 3][k % 3];
  }
  print_numbers("solid", value, 14);
  if (coarse) {
    fprintf(out, "note its volume and moments can be wrong by 1 %%: its spline faces could not be "
                 "measured accurately\n");
  }
  print_section(body, solid.volume, chosen);
  fflush(out);
}

// Limits of memory, time and files.
static void set_limits(void) {
  // A sanitizer maps more than any limit.
  if (!SB_SANITIZED) {
    setrlimit(RLIMIT_AS, &(struct rlimit){MEMORY_MAX, MEMORY_MAX});
  }
  // The first limit ends it by SIGXCPU, which the reader knows.
  setrlimit(RLIMIT_CPU, &(struct rlimit){SB_CAD_SECONDS_MAX, SB_CAD_SECONDS_MAX + 5});
  sigaction(SIGALRM, &(struct sigaction){.sa_handler = on_alarm, .sa_flags = SA_RESTART}, NULL);
  setitimer(ITIMER_REAL, &(struct itimerval){{1, 0}, {1, 0}}, NULL);
  setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
  // It writes no files, whatever the library would like to keep.
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &(struct rlimit){0, 0});
}

int main(int argc, char **argv) {
  set_limits();
  if (argc != 9) {
    fprintf(stderr, "usage: sealbench-cad FILE.step ANGLE DX DY DZ PX PY PZ\n");
    return 1;
  }
  out = fdopen(dup(STDOUT_FILENO), "w");
  if (out == NULL || freopen("/dev/null", "w", stdout) == NULL) {
    return 1;
  }
  int ierr, *bodies = NULL;
  size_t count = 0;
  gmshInitialize(0, NULL, 0, &ierr);
  check(ierr, "gmsh does not start");
  gmshOptionSetNumber("General.Terminal", 0, &ierr);
  gmshOptionSetString("Geometry.OCCTargetUnit", "MM", &ierr);
  gmshOptionSetNumber("Geometry.OCCImportLabels", 1, &ierr);
  gmshModelOccImportShapes(argv[1], &bodies, &count, 1, "step", &ierr);
  check(ierr != 0, "it is not a STEP file that OpenCASCADE reads");
  gmshModelOccSynchronize(&ierr);
  check(ierr, "its bodies cannot be built");
  size_t solids = 0;
  for (size_t i = 0; i + 1 < count; i += 2) {
    if (bodies[i] == 3) {
      memmove(bodies + 2 * solids++, bodies + i, 2 * sizeof *bodies);
    }
  }
  check(solids == 0, "it contains no solid body");
  check(solids > SB_CAD_BODIES_MAX,
        "it contains more than 200 bodies: export only the seal's parts");
  Axis axis = {0};
  double direction[3], through[3];
  for (int k = 0; k < 3; k++) {
    direction[k] = strtod(argv[3 + k], NULL);
    through[k] = strtod(argv[6 + k], NULL) / SCALE;
  }
  const double length = hypot(hypot(direction[0], direction[1]), direction[2]);
  for (int k = 0; k < 3; k++) {
    direction[k] /= length;
  }
  gsl_set_error_handler_off();
  const char *wrong = find_axis(&axis, bodies, 2 * solids, direction, through);
  g_autofree char *axis_error = g_strconcat("axis ", wrong, NULL); // for step.c
  check(wrong != NULL, axis_error);
  const double *p = axis.point, *d = axis.direction;
  print_numbers("axis", (double[]){SCALE * p[0], SCALE * p[1], SCALE * p[2], d[0], d[1], d[2]}, 6);
  const double angle = strtod(argv[2], NULL);
  place(bodies, 2 * solids, &axis, isnan(angle) ? OFF_PORTS : angle);
  for (size_t i = 0; i < solids; i++) {
    print_body(bodies[2 * i + 1], (int)i + 1, !isnan(angle));
  }
  fprintf(out, "end\n");
  gmshFree(bodies);
  gmshFinalize(&ierr);
  return fflush(out) == 0 ? 0 : 1;
}
