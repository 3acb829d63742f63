// sealbench-cad FILE.step ANGLE: the bodies of a STEP file as text on standard output, by gmsh and
// its OpenCASCADE kernel. A program of its own: a kernel that crashes, hangs or takes memory
// without end on a hostile file ends here, within the limits set below. Lengths in m, the axis
// found along x; each body cut by the half-plane at ANGLE [rad] about it.
//
//   axis px py pz dx dy dz            in the file's place, a point and a direction
//   body NAME
//   solid V cx cy cz Ixx Ixy Ixz Iyy Iyz Izz     volume, centre, moments about it at 1 kg/m3
//   why TEXT                          instead of pieces
//   piece x0 y0 x1 y1 bulge           of the half-section, in no order
//   outline                           between the faces of a half-section
//   end
#include "app/cad/cad_private.h"

#include <gmshc.h>

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

// The kernel works in mm, for which its tolerances are made.
static const double SCALE = 1e-3;
enum { PIECES_MAX = 100000 };
static const rlim_t MEMORY_MAX = (rlim_t)4 << 30;

// What standard output was: the kernel prints there as it likes, from now on to nowhere.
static FILE *out;

static void take_output(void) {
  out = fdopen(dup(STDOUT_FILENO), "w");
  if (out == NULL || freopen("/dev/null", "w", stdout) == NULL) {
    exit(1);
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

typedef struct {
  double point[3], direction[3]; // mm
  double area;                   // of the faces about it
} Axis;

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(double product[3], const double a[3], const double b[3]) {
  const double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                       a[0] * b[1] - a[1] * b[0]};
  memcpy(product, c, sizeof c);
}

// The axis of the circle through three points; false where they lie on a line.
static bool axis_of(Axis *axis, const double p[9]) {
  double a[3], b[3], n[3], t[3];
  for (int k = 0; k < 3; k++) {
    a[k] = p[3 + k] - p[k];
    b[k] = p[6 + k] - p[k];
  }
  cross(n, a, b);
  const double nn = dot(n, n), aa = dot(a, a), bb = dot(b, b);
  if (nn <= 1e-18 * aa * bb || nn == 0) {
    return false;
  }
  double u[3], v[3];
  cross(u, n, a);
  cross(v, b, n);
  for (int k = 0; k < 3; k++) {
    t[k] = (bb * u[k] + aa * v[k]) / (2 * nn);
    axis->direction[k] = n[k] / sqrt(nn);
    axis->point[k] = p[k] + t[k];
  }
  // One sign for all, and the point nearest to the origin.
  int largest = 0;
  for (int k = 1; k < 3; k++) {
    largest = fabs(axis->direction[k]) > fabs(axis->direction[largest]) + 1e-9 ? k : largest;
  }
  if (axis->direction[largest] < 0) {
    for (int k = 0; k < 3; k++) {
      axis->direction[k] = -axis->direction[k];
    }
  }
  const double along = dot(axis->point, axis->direction);
  for (int k = 0; k < 3; k++) {
    axis->point[k] -= along * axis->direction[k];
  }
  return true;
}

// The axis that most area of the faces of revolution turns about. In OpenCASCADE the first
// parameter of a cylinder, a cone, a torus and a surface of revolution is the angle.
static bool find_axis(Axis *best) {
  static const char *const turned[] = {"Cylinder", "Cone", "Torus", "Surface of Revolution"};
  enum { AXES_MAX = 500 };
  static Axis axes[AXES_MAX];
  int count = 0, ierr;
  int *faces = NULL;
  size_t face_count = 0;
  gmshModelGetEntities(&faces, &face_count, 2, &ierr);
  check(ierr, "the file's faces cannot be listed");
  for (size_t i = 0; i + 1 < face_count; i += 2) {
    const int tag = faces[i + 1];
    char *type = NULL;
    gmshModelGetType(2, tag, &type, &ierr);
    bool is_turned = false;
    for (size_t k = 0; ierr == 0 && k < sizeof turned / sizeof *turned; k++) {
      is_turned = is_turned || strcmp(type, turned[k]) == 0;
    }
    gmshFree(type);
    if (!is_turned) {
      continue;
    }
    double *low = NULL, *high = NULL, *at = NULL, area = 0;
    size_t n_low = 0, n_high = 0, n_at = 0;
    Axis axis = {0};
    gmshModelGetParametrizationBounds(2, tag, &low, &n_low, &high, &n_high, &ierr);
    if (ierr == 0 && n_low == 2 && n_high == 2) {
      const double v = (low[1] + high[1]) / 2, step = (high[0] - low[0]) / 3;
      double where[6] = {low[0], v, low[0] + step, v, low[0] + 2 * step, v};
      gmshModelGetValue(2, tag, where, 6, &at, &n_at, &ierr);
      const bool valued = ierr == 0 && n_at == 9;
      gmshModelOccGetMass(2, tag, &area, &ierr);
      if (valued && ierr == 0 && axis_of(&axis, at)) {
        int k = 0;
        while (k < count &&
               (fabs(dot(axes[k].direction, axis.direction)) < 1 - 1e-10 ||
                hypot(hypot(axes[k].point[0] - axis.point[0], axes[k].point[1] - axis.point[1]),
                      axes[k].point[2] - axis.point[2]) > 1e-4)) {
          k++;
        }
        if (k == count && count < AXES_MAX) {
          axes[count++] = axis;
        }
        if (k < AXES_MAX) {
          axes[k].area += area;
        }
      }
    }
    gmshFree(low);
    gmshFree(high);
    gmshFree(at);
  }
  gmshFree(faces);
  for (int k = 0; k < count; k++) {
    if (k == 0 || axes[k].area > best->area) {
      *best = axes[k];
    }
  }
  return count > 0;
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
  g_autoptr(GArray) pieces = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
  for (size_t i = 0; good && i + 1 < count; i += 2) {
    Edge edge = {.tag = edges[i + 1]};
    double *low = NULL, *high = NULL;
    size_t n_low = 0, n_high = 0;
    gmshModelGetParametrizationBounds(1, edge.tag, &low, &n_low, &high, &n_high, &ierr);
    good = ierr == 0 && n_low == 1 && n_high == 1;
    if (good) {
      edge.low = low[0];
      edge.high = high[0];
      char *type = NULL;
      gmshModelGetType(1, edge.tag, &type, &ierr);
      const bool plain = ierr == 0 && (strcmp(type, "Line") == 0 || strcmp(type, "Circle") == 0);
      gmshFree(type);
      good = sb_cad_curve(pieces, edge_at, &edge, plain ? 1 : 4, SB_CAD_TOLERANCE);
    }
    gmshFree(low);
    gmshFree(high);
  }
  static guint told;
  told += pieces->len;
  good = good && told <= PIECES_MAX;
  fprintf(out, "outline\n");
  for (guint i = 0; good && i < pieces->len; i++) {
    const SbCadPiece *p = &g_array_index(pieces, SbCadPiece, i);
    fprintf(out, "piece %.17g %.17g %.17g %.17g %.17g\n", p->x0, p->y0, p->x1, p->y1, p->bulge);
  }
  gmshFree(edges);
  return good;
}

// The half-section of a body: its common part with a rectangle of the half-plane.
static void print_section(int body) {
  int ierr;
  double box[6];
  gmshModelOccGetBoundingBox(3, body, &box[0], &box[1], &box[2], &box[3], &box[4], &box[5], &ierr);
  if (ierr != 0) {
    fprintf(out, "why it has no extent\n");
    return;
  }
  const double reach =
      2 * hypot(fmax(fabs(box[1]), fabs(box[4])), fmax(fabs(box[2]), fabs(box[5])));
  const double margin = 0.1 * (box[3] - box[0]) + 0.1;
  const int plane = gmshModelOccAddRectangle(box[0] - margin, 0, 0, box[3] - box[0] + 2 * margin,
                                             reach + 1, -1, 0, &ierr);
  int object[2] = {3, body}, tool[2] = {2, plane}, *faces = NULL, **map = NULL;
  size_t count = 0, *map_n = NULL, maps = 0;
  if (ierr == 0) {
    gmshModelOccIntersect(object, 2, tool, 2, &faces, &count, &map, &map_n, &maps, -1, 0, 1, &ierr);
  }
  if (ierr == 0) {
    gmshModelOccSynchronize(&ierr);
  }
  bool good = ierr == 0;
  int cut = 0;
  for (size_t i = 0; good && i + 1 < count; i += 2) {
    if (faces[i] == 2) {
      cut++;
      good = print_edges(faces[i + 1]);
    }
  }
  if (!good || cut == 0) {
    fprintf(out, "why %s\n", good ? "the half-plane does not meet it" : "the kernel cannot cut it");
  }
  gmshFree(faces);
  for (size_t i = 0; i < maps; i++) {
    gmshFree(map[i]);
  }
  gmshFree(map);
  gmshFree(map_n);
}

static void print_body(int body, int number) {
  int ierr;
  char *name = NULL;
  gmshModelGetEntityName(3, body, &name, &ierr);
  // "Shapes/Assembly/stem": the last part; one line, whatever it holds.
  const char *whole = ierr == 0 && name != NULL ? name : "";
  const char *slash = strrchr(whole, '/');
  const char *last = slash != NULL ? slash + 1 : whole;
  // What the kernel writes where it was given no name.
  last = strncmp(last, "Open CASCADE STEP translator", 28) == 0 ? "" : last;
  char own[120];
  if (*last != '\0') {
    snprintf(own, sizeof own, "%s", last);
  } else {
    snprintf(own, sizeof own, "body %d", number);
  }
  for (char *at = own; *at != '\0'; at++) {
    *at = (unsigned char)*at < ' ' ? ' ' : *at;
  }
  fprintf(out, "body %s\n", own);
  gmshFree(name);
  double volume = 0, centre[3] = {0}, *moment = NULL;
  size_t count = 0;
  gmshModelOccGetMass(3, body, &volume, &ierr);
  check(ierr, "the kernel cannot measure a body");
  gmshModelOccGetCenterOfMass(3, body, &centre[0], &centre[1], &centre[2], &ierr);
  check(ierr, "the kernel cannot measure a body");
  gmshModelOccGetMatrixOfInertia(3, body, &moment, &count, &ierr);
  check(ierr != 0 || count != 9, "the kernel cannot measure a body");
  const double to_volume = SCALE * SCALE * SCALE, to_moment = to_volume * SCALE * SCALE;
  fprintf(out, "solid %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n",
          to_volume * volume, SCALE * centre[0], SCALE * centre[1], SCALE * centre[2],
          to_moment * moment[0], to_moment * moment[1], to_moment * moment[2],
          to_moment * moment[4], to_moment * moment[5], to_moment * moment[8]);
  gmshFree(moment);
  print_section(body);
  fflush(out);
}

int main(int argc, char **argv) {
  // A sanitizer maps more than any limit.
  if (!SB_SANITIZED) {
    setrlimit(RLIMIT_AS, &(struct rlimit){MEMORY_MAX, MEMORY_MAX});
  }
  // The first limit ends it by SIGXCPU, which the reader knows.
  setrlimit(RLIMIT_CPU, &(struct rlimit){SB_CAD_SECONDS_MAX, SB_CAD_SECONDS_MAX + 5});
  setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
  // It writes no files, whatever the library would like to keep.
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &(struct rlimit){0, 0});
  if (argc != 3) {
    fprintf(stderr, "usage: sealbench-cad FILE.step ANGLE\n");
    return 1;
  }
  take_output();
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
      bodies[2 * solids] = 3;
      bodies[2 * solids + 1] = bodies[i + 1];
      solids++;
    }
  }
  check(solids == 0, "it contains no solid body");
  check(solids > SB_CAD_BODIES_MAX,
        "it contains more than 200 bodies: export only the seal's parts");
  Axis axis = {0};
  check(!find_axis(&axis), "it has no face of revolution, so no axis");
  fprintf(out, "axis %.17g %.17g %.17g %.17g %.17g %.17g\n", SCALE * axis.point[0],
          SCALE * axis.point[1], SCALE * axis.point[2], axis.direction[0], axis.direction[1],
          axis.direction[2]);
  place(bodies, 2 * solids, &axis, strtod(argv[2], NULL));
  for (size_t i = 0; i < solids; i++) {
    print_body(bodies[2 * i + 1], (int)i + 1);
  }
  fprintf(out, "end\n");
  gmshFree(bodies);
  gmshFinalize(&ierr);
  return fflush(out) == 0 ? 0 : 1;
}
