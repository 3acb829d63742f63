// Bodies from an STL mesh: its unit guessed, its axis found, its shells separated and measured,
// their half-sections cut out of the facets. Facets are chords of the surface: the half-plane goes
// through a vertex that is farthest from the axis, where diameters are those of the vertices.
#include "app/cad/cad_private.h"

#include "engine/mechanism/vector3.h"

// Sides that a valve's part may have [m]; how far the half-plane is from the vertex, so that no
// vertex is on it [rad]; a piece that is none [m]; how much more volume another half-plane must
// give, revolved; and when it need not be tried, relative.
static const double SIDE_LEAST = 1e-3, SIDE_MOST = 40e-3, NEXT_TO = 1e-7, SHORT = 1e-9, MORE = 1e-3,
                    MESH_ROUND = 0.02;

// Half-planes that are tried, one in each sector about the axis.
enum { SECTORS = 8 };

// A connected part of the mesh with its cavities.
typedef struct {
  GArray *triangles; // [3] vertex indices
  SbSolid solid;
} Shell;

// Returns the only unit in which `side`, the longest one, is that of a valve's part; NULL: none.
static const char *guess_unit(double side, GError **error) {
  static const char *const units[] = {"mm", "cm", "inch", "m", "um"};
  const char *found = NULL;
  guint count = 0;
  g_autoptr(GString) all = g_string_new(NULL), values = g_string_new(NULL);
  g_autoptr(GString) others = g_string_new(NULL);
  for (size_t i = 0; i < G_N_ELEMENTS(units); i++) {
    double scale;
    if (!sb_unit_scale(&scale, units[i], "m", "mm", NULL)) {
      continue;
    }
    const bool fits = side * scale >= SIDE_LEAST && side * scale <= SIDE_MOST;
    GString *list = fits ? all : others;
    g_string_append_printf(list, "%s%.3g mm in %s", list->len > 0 ? ", " : "", 1e3 * side * scale,
                           units[i]);
    if (fits) {
      g_string_append_printf(values, "%s%s", count++ > 0 ? "\n" : "", units[i]);
      found = units[i];
    }
  }
  if (count != 1) {
    sb_app_error_choose(error, "unit", count > 0 ? values->str : NULL,
                        "an STL file states no unit, and its longest side of %.4g is %s%s", side,
                        count > 0 ? "" : "that of a valve's part, 1 to 40 mm, in none: ",
                        count > 0 ? all->str : others->str);
  }
  return count == 1 ? found : NULL;
}

static void shell_free(gpointer data) {
  g_array_unref(((Shell *)data)->triangles);
  g_free(data);
}

// Returns the bodies of the mesh in its order, connected parts with their cavities; NULL: too many.
static GPtrArray *find_bodies(const SbStl *stl, GError **error) {
  g_autoptr(GPtrArray) shells = g_ptr_array_new_with_free_func(shell_free);
  g_autofree Shell **shell_of = g_new0(Shell *, stl->triangle_count + 1);
  for (gsize i = 0; i < stl->triangle_count; i++) {
    Shell **shell = &shell_of[stl->body[i]];
    if (*shell == NULL && shells->len == SB_CAD_BODIES_MAX) {
      sb_app_error_input(error, "it contains more than %d bodies: export the seal's parts alone",
                         SB_CAD_BODIES_MAX);
      return NULL;
    }
    if (*shell == NULL) {
      *shell = g_new0(Shell, 1);
      (*shell)->triangles = g_array_new(FALSE, FALSE, 3 * sizeof(unsigned));
      g_ptr_array_add(shells, *shell);
    }
    g_array_append_vals((*shell)->triangles, stl->triangles + 3 * i, 1);
  }
  return g_steal_pointer(&shells);
}

// Measures the bodies where the mesh is now. False with an error if one is not closed.
static bool measure(const SbStl *stl, const GPtrArray *shells, GError **error) {
  for (guint i = 0; i < shells->len; i++) {
    Shell *shell = shells->pdata[i];
    SbReport report = {0};
    if (sb_solid_mesh(&shell->solid, stl->vertices, stl->vertex_count,
                      (const unsigned *)(void *)shell->triangles->data, shell->triangles->len, 1,
                      &report) != SB_OK) {
      return sb_app_error_input(error, "body %u: %s", i + 1, report.text);
    }
  }
  return true;
}

// Writes the axis about which the bodies are closest to bodies of revolution. Returns false if that
// is so about several axes and they are not a ball, whose moments are the least of its volume V:
// 2/5 V r^2, with V = 4/3 pi r^3.
static bool find_mesh_axis(double axis[3], const GPtrArray *shells) {
  double sum[3][3] = {{0}}, volume = 0;
  for (guint i = 0; i < 9 * shells->len; i++) {
    const Shell *shell = shells->pdata[i / 9];
    sum[i % 9 / 3][i % 3] += shell->solid.inertia[i % 9 / 3][i % 3];
    volume += shell->solid.volume / 9;
  }
  const double least = 0.4 * volume * pow(3 * volume / (4 * M_PI), 2.0 / 3);
  return sb_solid_axis(axis, (const double(*)[3])sum) || sum[0][0] < 1.02 * least;
}

// Unit vectors at right angles, the first along `axis`; of a coordinate axis, the next two follow.
static void frame_of(double frame[3][3], const double axis[3]) {
  const double length = hypot(hypot(axis[0], axis[1]), axis[2]);
  int main = 0;
  for (int k = 0; k < 3; k++) {
    main = fabs(axis[k]) > fabs(axis[main]) ? k : main;
    frame[0][k] = axis[k] / length;
  }
  const int next = (main + 1) % 3;
  const double off = frame[0][next], norm = sqrt(1 - off * off);
  for (int k = 0; k < 3; k++) {
    frame[1][k] = ((k == next) - off * frame[0][k]) / norm;
  }
  cross(frame[2], frame[0], frame[1]);
}

// Makes the axis of the mesh x. `through` NULL: the middle of the box, unless the axis is near it.
static void place(SbStl *stl, const double frame[3][3], const double *through) {
  double low[3], high[3], to[3] = {0};
  for (gsize i = 0; i < stl->vertex_count; i++) {
    turn(stl->vertices + 3 * i, frame[0], stl->vertices + 3 * i);
  }
  sb_stl_extent(stl->vertices, stl->vertex_count, low, high);
  if (through != NULL) {
    turn(to, frame[0], through);
  } else {
    for (int k = 1; k < 3; k++) {
      const double middle = 0.5 * (low[k] + high[k]);
      to[k] = fabs(middle) > 1e-3 * (high[k] - low[k]) ? middle : 0;
    }
  }
  for (gsize i = 0; i < stl->vertex_count; i++) {
    stl->vertices[3 * i + 1] -= to[1];
    stl->vertices[3 * i + 2] -= to[2];
  }
}

// Cuts the facets of a body by the half-plane at `angle`. Writes the volume of the pieces,
// revolved.
static GArray *cut(double *volume, const SbStl *stl, const Shell *shell, double angle) {
  const double c = cos(angle), s = sin(angle);
  GArray *pieces = g_array_new(FALSE, FALSE, sizeof(SbPiece));
  *volume = 0;
  for (guint i = 0; i < shell->triangles->len; i++) {
    const unsigned *corner = (const unsigned *)(void *)shell->triangles->data + 3 * (gsize)i;
    double at[2][2];
    bool behind[3];
    int found = 0;
    for (int k = 0; k < 3; k++) {
      const double *v = stl->vertices + 3 * (gsize)corner[k];
      behind[k] = v[2] * c - v[1] * s < 0;
    }
    for (int k = 0; k < 3 && found < 2; k++) {
      if (behind[k] != behind[(k + 1) % 3]) {
        // From the edge's lower vertex on, so that both facets find the same.
        const unsigned a = corner[k], b = corner[(k + 1) % 3];
        const double *p = stl->vertices + 3 * (gsize)MIN(a, b);
        const double *q = stl->vertices + 3 * (gsize)MAX(a, b);
        const double off = p[2] * c - p[1] * s, t = off / (off - (q[2] * c - q[1] * s));
        const double up = p[1] * c + p[2] * s, uq = q[1] * c + q[2] * s;
        at[behind[k]][0] = p[0] + t * (q[0] - p[0]);
        at[behind[k]][1] = up + t * (uq - up);
        found++;
      }
    }
    if (found == 2 && hypot(at[1][0] - at[0][0], at[1][1] - at[0][1]) > SHORT) {
      g_array_append_vals(pieces, &(SbPiece){at[0][0], at[0][1], at[1][0], at[1][1], 0}, 1);
      const double r = fmax(at[0][1], 0), next = fmax(at[1][1], 0);
      *volume += M_PI / 3 * (at[0][0] - at[1][0]) * (r * r + r * next + next * next);
    }
  }
  return pieces;
}

// Angles of the farthest vertex of each sector, first of the farthest of all; NaN: it has none.
static void farthest(double angle[SECTORS], const SbStl *stl, const Shell *shell) {
  double most[SECTORS] = {0};
  int first = 0;
  for (int k = 0; k < SECTORS; k++) {
    angle[k] = NAN;
  }
  for (guint i = 0; i < 3 * shell->triangles->len; i++) {
    const double *v =
        stl->vertices + 3 * (gsize)((const unsigned *)(void *)shell->triangles->data)[i];
    const double r = hypot(v[1], v[2]), at = atan2(v[2], v[1]);
    const int sector = CLAMP((int)((at + M_PI) / (2 * M_PI) * SECTORS), 0, SECTORS - 1);
    if (r > most[sector]) {
      most[sector] = r;
      angle[sector] = at + NEXT_TO;
      first = r > most[first] ? sector : first;
    }
  }
  const double swap = angle[0];
  angle[0] = angle[first];
  angle[first] = swap;
}

// Adds a body with its half-section: without a chosen angle at the first of the farthest vertices,
// or where the half-plane meets clearly more of the body, as next to ports.
static void add_body(SbCad *cad, const SbStl *stl, const Shell *shell, const char *name,
                     const SbCadChoices *choices) {
  double angle[SECTORS], best, volume;
  farthest(angle, stl, shell);
  angle[0] = choices->angle != NULL ? *choices->angle + NEXT_TO : angle[0];
  g_autoptr(GArray) pieces = cut(&best, stl, shell, angle[0]);
  for (int k = 1; choices->angle == NULL && k < SECTORS; k++) {
    if (!(isnan(angle[k]) || fabs(best / shell->solid.volume - 1) < MESH_ROUND)) {
      GArray *other = cut(&volume, stl, shell, angle[k]);
      const bool better = volume > (1 + MORE) * best;
      g_array_unref(better ? pieces : other);
      pieces = better ? other : pieces;
      best = better ? volume : best;
    }
  }
  SbCadBody *body = sb_cad_body_new(name);
  g_ptr_array_add(cad->bodies, body);
  sb_cad_section(cad, body, pieces);
  body->measured = true;
  body->solid = shell->solid;
}

// From the mesh in the file's own numbers.
static SbCad *of_mesh(SbStl *stl, const char *path, const SbCadChoices *choices, GError **error) {
  double low[3], high[3], scale = 0;
  sb_stl_extent(stl->vertices, stl->vertex_count, low, high);
  const double side = fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
  const char *unit = choices->unit != NULL ? choices->unit : guess_unit(side, error);
  if (unit == NULL || !sb_unit_scale(&scale, unit, "m", "mm", error)) {
    return NULL;
  }
  for (gsize i = 0; i < 3 * stl->vertex_count; i++) {
    stl->vertices[i] *= scale;
  }
  g_autoptr(GPtrArray) shells = find_bodies(stl, error);
  if (shells == NULL || !measure(stl, shells, error)) {
    return NULL;
  }
  double found[3];
  if (!find_mesh_axis(found, shells) && choices->axis == NULL) {
    sb_app_error_choose(error, "axis", "x\ny\nz", "has equal moments about several axes");
    return NULL;
  }
  const double *axis = choices->axis != NULL ? choices->axis : found;
  double frame[3][3];
  frame_of(frame, axis);
  place(stl, (const double(*)[3])frame, choices->through);
  if (!measure(stl, shells, error)) {
    return NULL;
  }
  SbCad *cad = sb_cad_new("STL");
  cad->unit = g_strdup(unit);
  cad->axis = sb_cad_axis_text(choices->through, axis);
  if (choices->unit == NULL) {
    sb_note_add(cad->warnings, "an STL file states no unit: in %s its longest side is %.4g mm",
                unit, 1e3 * scale * side);
  }
  if (stl->turned > 0) {
    sb_note_add(cad->warnings, "%zu facets were inside out and are turned", stl->turned);
  }
  g_autofree char *shown = sb_printable(path, strlen(path)), *name = g_path_get_basename(shown);
  char *ending = strrchr(name, '.');
  if (ending != NULL && ending > name) {
    *ending = '\0';
  }
  for (guint i = 0; i < shells->len; i++) {
    g_autofree char *own = i > 0 ? g_strdup_printf("%s %u", name, i + 1) : g_strdup(name);
    add_body(cad, stl, shells->pdata[i], own, choices);
  }
  sb_cad_settle(cad, choices);
  return cad;
}

SbCad *sb_cad_parse_stl(const char *data, gsize length, const char *path,
                        const SbCadChoices *choices, GError **error) {
  SbStl stl;
  if (!sb_stl_read(&stl, data, length, "m", path, error)) {
    return NULL;
  }
  SbCad *cad = of_mesh(&stl, path, choices, error);
  sb_stl_clear(&stl);
  sb_app_error_prefix(error, path);
  return cad;
}
