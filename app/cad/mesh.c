// A body from an STL mesh: its unit guessed, its axis found, its half-section cut out of the
// facets. Facets are chords of the surface: the half-plane goes through the vertex that is farthest
// from the axis, where diameters are those of the vertices.
#include "app/cad/cad_private.h"

#include "app/base/error.h"
#include "app/base/unit.h"
#include "app/cad/stl.h"

#include <math.h>
#include <string.h>

// Sides that a valve's part may have [m]; beside the vertex, so that none lies on the half-plane
// [rad]; what a body of revolution's moments across the axis differ by; ends that are one point
// [m].
static const double SIDE_LEAST = 1e-3, SIDE_MOST = 40e-3, BESIDE = 1e-7, ALIKE = 0.02, GAP = 1e-8,
                    SHORT = 1e-9;

bool sb_cad_is_stl(const char *data, gsize length) {
  const gsize head = 84, facet = 50;
  if (length >= head) {
    const guint8 *n = (const guint8 *)data + 80;
    const guint64 count = n[0] | (guint64)n[1] << 8 | (guint64)n[2] << 16 | (guint64)n[3] << 24;
    if (length == head + facet * count) {
      return true;
    }
  }
  return length > 6 && g_ascii_strncasecmp(data, "solid", 5) == 0;
}

// Metres to the unit in which `side`, the mesh's longest, is that of a valve's part, and its name;
// NULL with an error that tells what could be meant.
static const char *guess_unit(double side, double *scale, GError **error) {
  static const struct {
    const char *name;
    double scale;
  } units[] = {{"mm", 1e-3}, {"inch", 25.4e-3}, {"m", 1}, {"um", 1e-6}};
  const char *found = NULL;
  g_autoptr(GString) all = g_string_new(NULL);
  for (size_t i = 0; i < G_N_ELEMENTS(units); i++) {
    const double real = side * units[i].scale;
    if (real >= SIDE_LEAST && real <= SIDE_MOST) {
      g_string_append_printf(all, "%sin %s %.3g mm", all->len > 0 ? ", " : "", units[i].name,
                             1e3 * real);
      found = all->len > 0 && found != NULL ? "" : units[i].name;
      *scale = units[i].scale;
    }
  }
  if (found != NULL && found[0] != '\0') {
    return found;
  }
  g_set_error(
      error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
      "an STL file states no unit, and its longest side of %.4g is %s: specify it with --unit",
      side, found != NULL ? all->str : "that of a valve's part in none");
  return NULL;
}

// The mesh in metres with its axis along x.
static void turn(SbStl *stl, SbSolid *solid, int axis, double scale) {
  for (gsize i = 0; i < stl->vertex_count; i++) {
    double *v = stl->vertices + 3 * i;
    const double old[3] = {v[0], v[1], v[2]};
    for (int k = 0; k < 3; k++) {
      v[k] = scale * old[(axis + k) % 3];
    }
  }
  const SbSolid old = *solid;
  solid->volume = old.volume * pow(scale, 3);
  solid->mass = old.mass * pow(scale, 3);
  for (int k = 0; k < 3; k++) {
    solid->centre[k] = scale * old.centre[(axis + k) % 3];
    for (int l = 0; l < 3; l++) {
      solid->inertia[k][l] = pow(scale, 5) * old.inertia[(axis + k) % 3][(axis + l) % 3];
    }
  }
}

// How far a body is from one of revolution about an axis of the file.
static double asymmetry(const SbSolid *solid, int axis) {
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  const double ia = solid->inertia[a][a], ib = solid->inertia[b][b];
  return (fabs(ia - ib) + 2 * fabs(solid->inertia[a][b])) / (ia + ib);
}

static void extent(const SbStl *stl, double low[3], double high[3]) {
  for (int k = 0; k < 3; k++) {
    low[k] = INFINITY;
    high[k] = -INFINITY;
  }
  for (gsize i = 0; i < 3 * stl->vertex_count; i++) {
    low[i % 3] = fmin(low[i % 3], stl->vertices[i]);
    high[i % 3] = fmax(high[i % 3], stl->vertices[i]);
  }
}

// The middle of the mesh's box comes to the axis, unless the axis is as good as there.
static void centre(SbStl *stl, SbSolid *solid) {
  double low[3], high[3];
  extent(stl, low, high);
  for (int k = 1; k < 3; k++) {
    const double middle = 0.5 * (low[k] + high[k]);
    if (fabs(middle) > 1e-3 * (high[k] - low[k])) {
      solid->centre[k] -= middle;
      for (gsize i = 0; i < stl->vertex_count; i++) {
        stl->vertices[3 * i + (gsize)k] -= middle;
      }
    }
  }
}

// Where an edge crosses the plane; from its lower vertex on, so that both facets find the same.
static void cross(double xu[2], const SbStl *stl, unsigned a, unsigned b, const double *beside,
                  double c, double s) {
  const unsigned i = MIN(a, b), k = MAX(a, b);
  const double *p = stl->vertices + 3 * (gsize)i, *q = stl->vertices + 3 * (gsize)k;
  const double t = beside[i] / (beside[i] - beside[k]);
  const double up = p[1] * c + p[2] * s, uq = q[1] * c + q[2] * s;
  xu[0] = p[0] + t * (q[0] - p[0]);
  xu[1] = up + t * (uq - up);
}

// Cuts the facets by the plane through the axis and the vertex farthest from it.
static void cut(GArray *pieces, const SbStl *stl) {
  double most = 0, angle = 0;
  for (gsize i = 0; i < stl->vertex_count; i++) {
    const double *v = stl->vertices + 3 * i, r = hypot(v[1], v[2]);
    if (r > most) {
      most = r;
      angle = atan2(v[2], v[1]);
    }
  }
  const double c = cos(angle + BESIDE), s = sin(angle + BESIDE);
  g_autofree double *beside = g_new(double, stl->vertex_count + 1);
  for (gsize i = 0; i < stl->vertex_count; i++) {
    beside[i] = stl->vertices[3 * i + 2] * c - stl->vertices[3 * i + 1] * s;
  }
  for (gsize i = 0; i < stl->triangle_count; i++) {
    const unsigned *corner = stl->triangles + 3 * i;
    double at[2][2];
    int found = 0;
    for (int k = 0; k < 3 && found < 2; k++) {
      const unsigned a = corner[k], b = corner[(k + 1) % 3];
      if ((beside[a] < 0) != (beside[b] < 0)) {
        cross(at[found++], stl, a, b, beside, c, s);
      }
    }
    if (found == 2 && hypot(at[1][0] - at[0][0], at[1][1] - at[0][1]) > SHORT) {
      const SbCadPiece piece = {at[0][0], at[0][1], at[1][0], at[1][1], 0};
      g_array_append_val(pieces, piece);
    }
  }
}

// Leaves out the points between which an outline is straight.
static void straighten(SbCadBody *body) {
  const guint n = body->profile->len;
  g_autoptr(GArray) kept = g_array_new(FALSE, FALSE, sizeof(SbProfilePoint));
  for (guint i = 0; i < n; i++) {
    const SbProfilePoint p = g_array_index(body->profile, SbProfilePoint, i);
    const bool end = kept->len == 0 || (i + 1 == n && !body->closed);
    const SbProfilePoint a = end ? p : g_array_index(kept, SbProfilePoint, kept->len - 1);
    const SbProfilePoint b = g_array_index(body->profile, SbProfilePoint, (i + 1) % n);
    const double dx = b.x - a.x, dr = b.r - a.r, chord = hypot(dx, dr);
    const double off = chord > 0 ? fabs((p.r - a.r) * dx - (p.x - a.x) * dr) / chord : 1;
    if (end || off > SB_CAD_TOLERANCE) {
      g_array_append_val(kept, p);
    }
  }
  g_array_set_size(body->profile, 0);
  g_array_append_vals(body->profile, kept->data, kept->len);
}

static char *name_of(const char *path) {
  char *name = g_path_get_basename(path);
  char *dot = strrchr(name, '.');
  if (dot != NULL && dot > name) {
    *dot = '\0';
  }
  return name;
}

// From the mesh in the file's own numbers.
static SbCad *of_mesh(SbStl *stl, const char *path, const SbCadChoices *choices, GError **error) {
  double low[3], high[3], scale = 0;
  extent(stl, low, high);
  const double side = fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
  const char *unit = choices->unit;
  if (unit != NULL) {
    g_autofree char *one = g_strdup_printf("1 %s", unit);
    if (!sb_quantity_parse(&scale, one, "m", "mm", error)) {
      return NULL;
    }
  } else if ((unit = guess_unit(side, &scale, error)) == NULL) {
    return NULL;
  }
  SbSolid solid;
  SbReport report = {0};
  if (sb_solid_mesh(&solid, stl->vertices, stl->vertex_count, stl->triangles, stl->triangle_count,
                    1, &report) != SB_OK) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s", report.text);
    return NULL;
  }
  int axis = choices->axis != NULL ? choices->axis[0] - 'x' : 0;
  for (int k = 1; k < 3 && choices->axis == NULL; k++) {
    axis = asymmetry(&solid, k) < asymmetry(&solid, axis) ? k : axis;
  }
  SbCad *cad = sb_cad_new("STL");
  cad->unit = g_strdup(unit);
  cad->axis = g_strdup_printf("the file's %c", 'x' + axis);
  if (choices->unit == NULL) {
    g_ptr_array_add(cad->warnings, g_strdup_printf("an STL file states no unit: in %s its longest "
                                                   "side is %.4g mm",
                                                   unit, 1e3 * scale * side));
  }
  if (asymmetry(&solid, axis) > ALIKE) {
    g_ptr_array_add(cad->warnings, g_strdup_printf("it is not a body of revolution: its moments "
                                                   "across the axis differ by %.2g %%",
                                                   100 * asymmetry(&solid, axis)));
  }
  turn(stl, &solid, axis, scale);
  centre(stl, &solid);
  g_autoptr(GArray) pieces = g_array_new(FALSE, FALSE, sizeof(SbCadPiece));
  g_autofree char *name = name_of(path);
  cut(pieces, stl);
  sb_cad_outlines(cad, pieces, name, GAP);
  for (guint i = 0; i < cad->bodies->len; i++) {
    SbCadBody *body = cad->bodies->pdata[i];
    straighten(body);
    body->measured = cad->bodies->len == 1;
    body->solid = body->measured ? solid : body->solid;
    sb_cad_body_settle(body, choices);
  }
  if (cad->bodies->len == 0) {
    const guint told = cad->warnings->len;
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "its section contains no closed outline%s%s", told > 0 ? "; " : "",
                told > 0 ? (const char *)cad->warnings->pdata[told - 1] : "");
    g_clear_pointer(&cad, sb_cad_free);
  }
  return cad;
}

SbCad *sb_cad_parse_stl(const char *data, gsize length, const char *path,
                        const SbCadChoices *choices, GError **error) {
  SbStl stl;
  if (!sb_stl_parse(&stl, data, length, "m", path, error)) {
    return NULL;
  }
  GError *problem = NULL;
  SbCad *cad = of_mesh(&stl, path, choices, &problem);
  sb_stl_clear(&stl);
  if (problem != NULL) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s: %s", path, problem->message);
    g_error_free(problem);
  }
  return cad;
}
