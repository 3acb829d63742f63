// Turns outlines into cells and puts them in order: sectors by their angle from the camera's, cut
// faces among them, within a sector each piece after all that it hides. What faces away is left
// out: the bodies are closed.
#include "app/section/revolve.h"

#include <math.h>
#include <stdlib.h>

// The open quarter's middle is this much above the front at azimuth and elevation 0, so that the
// upper cut face is seen nearly from the front and the lower one from above.
static const double RAISED = 30 * G_PI / 180;

// Edges: where an outline turns by more than this [rad].
static const double CREASE = 0.35;

// Lights fixed to the camera: components along the picture's right and up and towards the camera.
// A key light from the upper left, a weak one that opens the shadows, and the sky. The highlight
// belongs to the key light.
enum { LIGHT_KEY, LIGHT_FILL, LIGHT_SKY, LIGHT_HALF, LIGHTS };
static const double light_from[LIGHTS][3] = {{-0.45, 0.65, 0.61},
                                             {0.62, -0.48, 0.62},
                                             {0, 1, 0},
                                             {-0.251, 0.362, 0.898}}; // key and camera, halfway
static const double KEY = 0.50, FILL = 0.22, SKY = 0.12, AMBIENT = 0.10, HIGHLIGHT = 0.16;

// Edges reach this much further, so that pieces of one line meet without a gap [px].
static const double OVERLAP = 0.6;

typedef struct {
  double z[2], r[2];
  double nz[2], nr[2]; // outward normals at both ends
  SbRevolveBody solid;
  int next, previous; // segments of the same outline
  bool crease;        // edge between it and the next
} Segment;

// A visible piece of a sector's outlines on its way into the order: place across the sight lines
// and depth along them, of both ends.
typedef struct {
  size_t segment;
  double across[2], depth[2];
  enum { WAITING, VISITED, PAINTED } state;
} Piece;

SbOrbit sb_orbit(double azimuth, double elevation) {
  double a = azimuth, e = elevation;
  double c = cos(RAISED), s = sin(RAISED);
  // In the room: x along the axis, y up, z to the front.
  const double room[3][3] = {{cos(a), 0, -sin(a)},
                             {-sin(a) * sin(e), cos(e), -cos(a) * sin(e)},
                             {sin(a) * cos(e), sin(e), cos(a) * cos(e)}};
  double out[3][3];
  for (int i = 0; i < 3; i++) {
    out[i][0] = room[i][0];
    out[i][1] = c * room[i][2] + s * room[i][1];
    out[i][2] = c * room[i][1] - s * room[i][2];
  }
  SbOrbit orbit;
  for (int k = 0; k < 3; k++) {
    orbit.right[k] = out[0][k];
    orbit.up[k] = out[1][k];
    orbit.toward[k] = out[2][k];
  }
  return orbit;
}

void sb_revolve_init(SbRevolve *revolve) {
  *revolve = (SbRevolve){0};
  revolve->segment = g_array_new(FALSE, FALSE, sizeof(Segment));
  revolve->cell = g_array_new(FALSE, FALSE, sizeof(SbRevolveCell));
  revolve->edge = g_array_new(FALSE, FALSE, sizeof(SbRevolveEdge));
  revolve->step = g_array_new(FALSE, FALSE, sizeof(SbRevolveStep));
  revolve->facing = g_array_new(FALSE, FALSE, 1);
  revolve->piece = g_array_new(FALSE, FALSE, sizeof(Piece));
  revolve->place = g_array_new(FALSE, FALSE, sizeof(int));
}

void sb_revolve_finish(SbRevolve *revolve) {
  GArray *const arrays[] = {revolve->segment, revolve->cell,  revolve->edge, revolve->step,
                            revolve->facing,  revolve->piece, revolve->place};
  for (size_t i = 0; i < G_N_ELEMENTS(arrays); i++) {
    g_array_free(arrays[i], TRUE);
  }
  *revolve = (SbRevolve){0};
}

void sb_revolve_begin(SbRevolve *revolve, const SbOrbit *orbit, double scale, double x0,
                      double y0) {
  revolve->orbit = *orbit;
  revolve->scale = scale;
  revolve->x0 = x0;
  revolve->y0 = y0;
  g_array_set_size(revolve->segment, 0);
}

static Segment *segment_at(const SbRevolve *revolve, size_t i) {
  return &g_array_index(revolve->segment, Segment, i);
}

static void normalise(double *a, double *b) {
  double length = fmax(hypot(*a, *b), 1e-300);
  *a /= length;
  *b /= length;
}

// Smooth outlines get the mean of two neighbours' normals where they meet.
static void smooth_normals(SbRevolve *revolve, size_t first) {
  for (size_t i = first; i < revolve->segment->len; i++) {
    Segment *one = segment_at(revolve, i), *two = segment_at(revolve, (size_t)one->next);
    double nz = one->nz[1] + two->nz[0], nr = one->nr[1] + two->nr[0];
    normalise(&nz, &nr);
    one->nz[1] = two->nz[0] = nz;
    one->nr[1] = two->nr[0] = nr;
  }
}

void sb_revolve_add(SbRevolve *revolve, SbRevolveBody solid, const SbValvePoint *point,
                    size_t count, bool smooth) {
  size_t first = revolve->segment->len;
  for (size_t i = 0; i < count; i++) {
    SbValvePoint a = point[i], b = point[(i + 1) % count];
    double length = hypot(b.x - a.x, b.y - a.y);
    if (length <= 0 || (a.y <= 0 && b.y <= 0)) {
      continue; // nothing, or a piece of the axis
    }
    double nz = (b.y - a.y) / length, nr = -(b.x - a.x) / length;
    Segment segment = {.z = {a.x, b.x},
                       .r = {a.y, b.y},
                       .nz = {nz, nz},
                       .nr = {nr, nr},
                       .solid = solid,
                       .next = (int)revolve->segment->len + 1};
    g_array_append_val(revolve->segment, segment);
  }
  if (revolve->segment->len == first) {
    return;
  }
  segment_at(revolve, revolve->segment->len - 1)->next = (int)first;
  for (size_t i = first; i < revolve->segment->len; i++) {
    segment_at(revolve, (size_t)segment_at(revolve, i)->next)->previous = (int)i;
  }
  for (size_t i = first; i < revolve->segment->len && !smooth; i++) {
    Segment *one = segment_at(revolve, i);
    const Segment *two = segment_at(revolve, (size_t)one->next);
    one->crease = one->nz[1] * two->nz[0] + one->nr[1] * two->nr[0] < cos(CREASE);
  }
  if (smooth) {
    smooth_normals(revolve, first);
  }
}

// Returns the angle of boundary k of the sectors, k = 0 to SB_REVOLVE_SECTORS [rad].
static double boundary_angle(int k) {
  return G_PI / 4 + 1.5 * G_PI * k / SB_REVOLVE_SECTORS;
}

double sb_revolve_face_angle(int face) {
  return face == 0 ? G_PI / 4 : -G_PI / 4;
}

// Component of (z, r at the angle) along a vector.
static double along(const double v[3], double z, double r, double angle) {
  return v[0] * z + r * (v[1] * cos(angle) + v[2] * sin(angle));
}

// Returns whether a cut face, 0 or 1, faces the camera.
static bool face_shows(const SbRevolve *revolve, int face) {
  // Its normal points into the open quarter.
  double angle = face == 0 ? -G_PI / 4 : G_PI / 4;
  return along(revolve->orbit.toward, 0, 1, angle) > 1e-6;
}

// What a boundary between sectors adds to a point's place and brightness, per r.
typedef struct {
  double x, y, depth, light[LIGHTS];
} Boundary;

typedef struct {
  SbRevolve *revolve;
  Boundary boundary[SB_REVOLVE_SECTORS + 1];
  double light[LIGHTS]; // along the axis
  double camera;        // angle
} Build;

// Ends of a segment at a boundary: x, y, depth.
static void end_at(const Build *build, const Segment *segment, int end, int k, float *x, float *y,
                   float *depth) {
  const SbRevolve *revolve = build->revolve;
  const Boundary *at = &build->boundary[k];
  double z = segment->z[end], r = segment->r[end];
  *x = (float)(revolve->x0 + revolve->scale * (revolve->orbit.right[0] * z + r * at->x));
  *y = (float)(revolve->y0 - revolve->scale * (revolve->orbit.up[0] * z + r * at->y));
  *depth = (float)(revolve->orbit.toward[0] * z + r * at->depth);
}

static float brightness(const Build *build, const Segment *segment, int end, int k) {
  double lit[LIGHTS];
  for (int i = 0; i < LIGHTS; i++) {
    lit[i] = segment->nz[end] * build->light[i] + segment->nr[end] * build->boundary[k].light[i];
  }
  double sharp = fmax(lit[LIGHT_HALF], 0);
  for (int i = 0; i < 4; i++) {
    sharp *= sharp; // to the sixteenth
  }
  return (float)(AMBIENT + KEY * fmax(lit[LIGHT_KEY], 0) + FILL * fmax(lit[LIGHT_FILL], 0) +
                 SKY * (1 + lit[LIGHT_SKY]) / 2 + HIGHLIGHT * sharp);
}

// Is the plane piece of a segment in a sector turned to the camera? Its normal, of the piece
// itself: the mean of both boundaries' radial directions stands on it.
static bool faces(const Build *build, const Segment *segment, int k) {
  double dz = segment->z[1] - segment->z[0], dr = segment->r[1] - segment->r[0];
  double half = 0.75 * G_PI / SB_REVOLVE_SECTORS;
  double across = (build->boundary[k].depth + build->boundary[k + 1].depth) / 2;
  // The chord's plane lies at r cos(half); its radial direction has length cos(half) in the mean.
  double out = dr * cos(half) * build->revolve->orbit.toward[0] - dz * across / cos(half);
  return out > 1e-12 * hypot(dz, dr);
}

static bool facing_at(const Build *build, int k, size_t segment) {
  size_t n = build->revolve->segment->len;
  return k >= 0 && k < SB_REVOLVE_SECTORS &&
         g_array_index(build->revolve->facing, guint8, (size_t)k * n + segment) != 0;
}

typedef struct {
  double depth;
  size_t what;
} Key;

static int by_depth(const void *a, const void *b) {
  const Key *x = a, *y = b;
  if (x->depth != y->depth) {
    return x->depth < y->depth ? -1 : 1;
  }
  return (x->what > y->what) - (x->what < y->what);
}

static void add_step(SbRevolve *revolve, SbRevolveKind kind, size_t first, size_t count) {
  if (count == 0) {
    return;
  }
  size_t steps = revolve->step->len;
  SbRevolveStep *last = steps > 0 ? &g_array_index(revolve->step, SbRevolveStep, steps - 1) : NULL;
  if (last != NULL && last->kind == kind && kind != SB_REVOLVE_FACE) {
    last->count += count;
    return;
  }
  SbRevolveStep step = {kind, first, count};
  g_array_append_val(revolve->step, step);
}

// The edge of a cell between two of its corners; a silhouette if nothing visible follows behind it.
static void add_edge(const Build *build, const SbRevolveCell *cell, int from, int to,
                     bool silhouette) {
  SbRevolveEdge edge = {.x = {cell->x[from], cell->x[to]}, .y = {cell->y[from], cell->y[to]}};
  float dx = edge.x[1] - edge.x[0], dy = edge.y[1] - edge.y[0];
  float length = hypotf(dx, dy);
  if (length < 1e-3f) {
    return;
  }
  dx /= length;
  dy /= length;
  if (silhouette) {
    float x = -2.0f * (edge.x[0] + edge.x[1]), y = -2.0f * (edge.y[0] + edge.y[1]);
    for (int c = 0; c < 4; c++) {
      x += cell->x[c];
      y += cell->y[c];
    }
    float side = x * dy - y * dx > 0.0f ? -1.0f : 1.0f;
    edge.out_x = side * dy;
    edge.out_y = -side * dx;
  }
  edge.x[0] -= (float)OVERLAP * dx;
  edge.y[0] -= (float)OVERLAP * dy;
  edge.x[1] += (float)OVERLAP * dx;
  edge.y[1] += (float)OVERLAP * dy;
  g_array_append_val(build->revolve->edge, edge);
}

static double depth_at(const Piece *piece, double across) {
  double width = piece->across[1] - piece->across[0];
  double t = fabs(width) > 0 ? (across - piece->across[0]) / width : 0.5;
  return piece->depth[0] + t * (piece->depth[1] - piece->depth[0]);
}

// Whether `a` is hidden by `b` somewhere. Outlines do not cross, so that one sight line that meets
// both decides.
static bool is_behind(const Piece *a, const Piece *b, double least) {
  double low = fmax(fmin(a->across[0], a->across[1]), fmin(b->across[0], b->across[1]));
  double high = fmin(fmax(a->across[0], a->across[1]), fmax(b->across[0], b->across[1]));
  if (high - low <= least) {
    return false;
  }
  double middle = (low + high) / 2;
  return depth_at(a, middle) < depth_at(b, middle);
}

static Piece *piece_at(const Build *build, size_t i) {
  return &g_array_index(build->revolve->piece, Piece, i);
}

// Whether segment i of sector k is on the list already.
static bool is_painted(const Build *build, size_t segment) {
  int i = g_array_index(build->revolve->place, int, segment);
  return i >= 0 && piece_at(build, (size_t)i)->state == PAINTED;
}

// The cell of a piece in sector k, then its edges: silhouettes, and creases whose other side has
// been painted.
static void paint(const Build *build, int k, size_t i) {
  SbRevolve *revolve = build->revolve;
  size_t index = piece_at(build, i)->segment;
  const Segment *segment = segment_at(revolve, index);
  SbRevolveCell cell = {.solid = segment->solid};
  static const int end[4] = {0, 1, 1, 0}, side[4] = {0, 0, 1, 1};
  for (int c = 0; c < 4; c++) {
    end_at(build, segment, end[c], k + side[c], &cell.x[c], &cell.y[c], &cell.depth[c]);
    cell.shade[c] = brightness(build, segment, end[c], k + side[c]);
  }
  add_step(revolve, SB_REVOLVE_CELLS, revolve->cell->len, 1);
  g_array_append_val(revolve->cell, cell);
  piece_at(build, i)->state = PAINTED;

  size_t first = revolve->edge->len;
  size_t next = (size_t)segment->next, previous = (size_t)segment->previous;
  bool open = !facing_at(build, k, next);
  if (open || (segment->crease && is_painted(build, next))) {
    add_edge(build, &cell, 1, 2, open);
  }
  open = !facing_at(build, k, previous);
  if (open || (segment_at(revolve, previous)->crease && is_painted(build, previous))) {
    add_edge(build, &cell, 0, 3, open);
  }
  if (!facing_at(build, k - 1, index)) {
    add_edge(build, &cell, 0, 1, true);
  }
  if (!facing_at(build, k + 1, index)) {
    add_edge(build, &cell, 3, 2, true);
  }
  add_step(revolve, SB_REVOLVE_EDGES, first, revolve->edge->len - first);
}

// Paints what is behind a piece, then the piece. `least`: overlap that counts [m].
static void paint_from_behind(const Build *build, int k, size_t i, double least) {
  Piece *piece = piece_at(build, i);
  if (piece->state != WAITING) {
    return;
  }
  piece->state = VISITED;
  for (size_t j = 0; j < build->revolve->piece->len; j++) {
    if (piece_at(build, j)->state == WAITING && is_behind(piece_at(build, j), piece, least)) {
      paint_from_behind(build, k, j, least);
    }
  }
  paint(build, k, i);
}

// Cells and edges in sector k. In the plane of the outlines
// the sight lines are taken as straight ones, in the direction of the sector's middle; among
// segments that do not cross, "behind" has no circles.
static void add_sector(const Build *build, int k) {
  SbRevolve *revolve = build->revolve;
  double along_z = revolve->orbit.toward[0];
  double along_r = (build->boundary[k].depth + build->boundary[k + 1].depth) / 2;
  double longest = 0;
  g_array_set_size(revolve->piece, 0);
  for (size_t i = 0; i < revolve->segment->len; i++) {
    const Segment *segment = segment_at(revolve, i);
    g_array_index(revolve->place, int, i) = -1;
    if (!facing_at(build, k, i)) {
      continue;
    }
    Piece piece = {.segment = i, .state = WAITING};
    for (int end = 0; end < 2; end++) {
      piece.depth[end] = along_z * segment->z[end] + along_r * segment->r[end];
      piece.across[end] = along_r * segment->z[end] - along_z * segment->r[end];
    }
    longest = fmax(longest, fabs(piece.across[1] - piece.across[0]));
    g_array_index(revolve->place, int, i) = (int)revolve->piece->len;
    g_array_append_val(revolve->piece, piece);
  }
  for (size_t i = 0; i < revolve->piece->len; i++) {
    paint_from_behind(build, k, i, 1e-6 * longest);
  }
}

// Angle between two directions about the axis, 0 to pi.
static double apart(double a, double b) {
  return fabs(remainder(a - b, 2 * G_PI));
}

void sb_revolve_build(SbRevolve *revolve) {
  const SbOrbit *orbit = &revolve->orbit;
  Build build = {.revolve = revolve, .camera = atan2(orbit->toward[2], orbit->toward[1])};
  double light[LIGHTS][3];
  for (int n = 0; n < LIGHTS; n++) {
    for (int i = 0; i < 3; i++) {
      light[n][i] = light_from[n][0] * orbit->right[i] + light_from[n][1] * orbit->up[i] +
                    light_from[n][2] * orbit->toward[i];
    }
    build.light[n] = light[n][0];
  }
  for (int k = 0; k <= SB_REVOLVE_SECTORS; k++) {
    double angle = boundary_angle(k);
    Boundary *boundary = &build.boundary[k];
    boundary->x = along(orbit->right, 0, 1, angle);
    boundary->y = along(orbit->up, 0, 1, angle);
    boundary->depth = along(orbit->toward, 0, 1, angle);
    for (int i = 0; i < LIGHTS; i++) {
      boundary->light[i] = along(light[i], 0, 1, angle);
    }
  }
  size_t n = revolve->segment->len;
  g_array_set_size(revolve->place, (guint)n);
  g_array_set_size(revolve->facing, (guint)(n * SB_REVOLVE_SECTORS));
  for (int k = 0; k < SB_REVOLVE_SECTORS; k++) {
    for (size_t i = 0; i < n; i++) {
      g_array_index(revolve->facing, guint8, (size_t)k * n + i) =
          faces(&build, segment_at(revolve, i), k) ? 1 : 0;
    }
  }
  g_array_set_size(revolve->cell, 0);
  g_array_set_size(revolve->edge, 0);
  g_array_set_size(revolve->step, 0);

  // Sectors and faces, the farthest from the camera's angle first.
  Key order[SB_REVOLVE_SECTORS + SB_REVOLVE_FACES];
  size_t count = 0;
  for (int k = 0; k < SB_REVOLVE_SECTORS; k++) {
    double middle = (boundary_angle(k) + boundary_angle(k + 1)) / 2;
    order[count++] = (Key){-apart(middle, build.camera), (size_t)k};
  }
  for (int face = 0; face < SB_REVOLVE_FACES; face++) {
    if (face_shows(revolve, face)) {
      order[count++] = (Key){-apart(sb_revolve_face_angle(face), build.camera),
                             (size_t)(SB_REVOLVE_SECTORS + face)};
    }
  }
  qsort(order, count, sizeof *order, by_depth);
  for (size_t i = 0; i < count; i++) {
    if (order[i].what >= SB_REVOLVE_SECTORS) {
      add_step(revolve, SB_REVOLVE_FACE, order[i].what - SB_REVOLVE_SECTORS, 1);
      continue;
    }
    add_sector(&build, (int)order[i].what);
  }
}

// Divergence theorem: a third of the sum of position times area over all pieces, cut faces (which
// hold the axis and so have position times normal zero) included.
double sb_revolve_volume(const SbRevolve *revolve, SbRevolveBody solid) {
  double six = 0;
  for (size_t i = 0; i < revolve->segment->len; i++) {
    const Segment *segment = segment_at(revolve, i);
    for (int k = 0; k < SB_REVOLVE_SECTORS && segment->solid == solid; k++) {
      double p[4][3];
      static const int end[4] = {0, 1, 1, 0}, side[4] = {0, 0, 1, 1};
      for (int c = 0; c < 4; c++) {
        double angle = boundary_angle(k + side[c]);
        p[c][0] = segment->z[end[c]];
        p[c][1] = segment->r[end[c]] * cos(angle);
        p[c][2] = segment->r[end[c]] * sin(angle);
      }
      for (int t = 1; t < 3; t++) {
        const double *a = p[0], *b = p[t], *c = p[t + 1];
        six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
      }
    }
  }
  return fabs(six) / 6;
}
