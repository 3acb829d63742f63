// Parts by their shape: a half-profile or an STL mesh in a [part.NAME] group gives the part's mass
// and moments of inertia (engine/motion/solid.h), and by stretches of a profile the valve's
// diameters.
//
//   [part.stem_centre]
//   density = 1410 kg/m3
//   profile = mm 14,0 14,2.9 8,2.9 8,1.64 6,1.64 6,2.9 0,2.9 0,0
//   land = 8 mm .. 14 mm
//   groove = 6 mm .. 8 mm
//
// A profile is a unit and points x,r counter-clockwise in the (x, r) plane, x along the axis; a
// third number is the bulge of the arc to the next point (tan of a quarter of its angle, > 0 to the
// left). It closes by repeating its first point, or by the axis where it starts and ends. A mesh is
// `stl = FILE` beside the document with `unit = mm` and, unless it is x, `axis = y` or `z`.
// `land` gives stem.pressure_diameter, `groove` gland.radial_space (with the bore), `bore`
// bore.diameter. Keys that are given win; a note tells where the shape says otherwise.
#include "app/document/document_parts.h"

#include "app/document/stl.h"
#include "app/document/unit.h"

#include "engine/motion/solid.h"

#include <math.h>
#include <string.h>

static const char *const shape_keys[] = {"profile", "stl",    "unit", "axis", "density",
                                         "land",    "groove", "bore", NULL};

bool sb_parts_is_shape_key(const char *group, const char *name) {
  return g_str_has_prefix(group, "part.") && g_strv_contains(shape_keys, name);
}

// What is read from one group, and where its problems go.
typedef struct {
  const GPtrArray *entries;
  const char *group, *shown;
  GPtrArray *issues;
} Part;

static const SbEntry *find(const Part *part, const char *name) {
  for (guint i = 0; i < part->entries->len; i++) {
    const SbEntry *entry = part->entries->pdata[i];
    if (entry->name != NULL && strcmp(entry->group, part->group) == 0 &&
        strcmp(entry->name, name) == 0) {
      return entry;
    }
  }
  return NULL;
}

static void G_GNUC_PRINTF(4, 5)
    complain(const Part *part, const char *name, const char *allowed, const char *format, ...) {
  const SbEntry *entry = find(part, name);
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *text = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  g_autofree char *key = g_strdup_printf("%s.%s", part->group, name);
  sb_issues_add(part->issues, part->shown, entry != NULL ? entry->line : 0, key, allowed, "%s",
                text);
}

// A quantity of group key `name`; NaN with an issue if it is none or missing.
static double quantity(const Part *part, const char *name, const char *text, const char *si,
                       const char *unit) {
  double value = NAN;
  GError *error = NULL;
  if (text == NULL) {
    complain(part, name, NULL, "is missing: the part's shape needs it");
  } else if (!sb_quantity_parse(&value, text, si, unit, &error)) {
    complain(part, name, NULL, "%s", error->message);
    g_error_free(error);
    value = NAN;
  }
  return value;
}

// Points of a profile; NULL with an issue. Owned by the caller.
static SbProfilePoint *read_points(const Part *part, const char *text, size_t *count,
                                   bool *closed) {
  static const char form[] = "mm 0,0 10,0 10,2 0,2";
  g_auto(GStrv) words = g_strsplit_set(text, " \t", -1);
  guint n = g_strv_length(words);
  SbProfilePoint *points = g_new0(SbProfilePoint, n);
  GError *error = NULL;
  double scale = 0;
  *count = 0;
  for (guint i = 0; i < n; i++) {
    if (*words[i] == '\0') {
      continue;
    }
    if (scale == 0) {
      g_autofree char *one = g_strdup_printf("1 %s", words[i]);
      if (!sb_quantity_parse(&scale, one, "m", "mm", &error) || scale <= 0) {
        complain(part, "profile", form, "starts with the unit of its points, not '%.20s'",
                 words[i]);
        g_clear_error(&error);
        g_free(points);
        return NULL;
      }
      continue;
    }
    g_auto(GStrv) numbers = g_strsplit(words[i], ",", -1);
    guint parts = g_strv_length(numbers);
    double value[3] = {0};
    bool good = parts == 2 || parts == 3;
    for (guint k = 0; good && k < parts; k++) {
      char *end = NULL;
      value[k] = g_ascii_strtod(numbers[k], &end);
      good = *numbers[k] != '\0' && *end == '\0' && isfinite(value[k]);
    }
    if (!good || *count == SB_PROFILE_MAX) {
      complain(part, "profile", form,
               good ? "has more than %d points" : "point %d is not x,r or x,r,bulge",
               good ? SB_PROFILE_MAX : (int)*count + 1);
      g_free(points);
      return NULL;
    }
    points[(*count)++] = (SbProfilePoint){scale * value[0], scale * value[1], value[2]};
  }
  *closed =
      *count > 1 && points[0].x == points[*count - 1].x && points[0].r == points[*count - 1].r;
  *count -= *closed;
  if (*count < 2) {
    complain(part, "profile", form, "has %zu points, not two or more", *count);
    g_free(points);
    return NULL;
  }
  return points;
}

// Sets `id` to what the shape says unless it is given; then only compares.
static void derive(SbParams *params, SbParamId id, double value, const Part *part,
                   const char *source, GPtrArray *notes) {
  const SbParam *param = sb_param(id);
  if (params->given[id]) {
    double given = params->value[id];
    if (fabs(given - value) > 1e-3 * fabs(given)) {
      g_autofree char *says = sb_quantity_format(given, param->si, param->unit);
      char other[SB_NUMBER_SIZE];
      sb_number_round(other, sb_quantity_to_shown(value, param->si, param->unit), 5);
      g_ptr_array_add(notes, g_strdup_printf("%s: %s = %s is in force; the %s of [%s] makes %s %s",
                                             part->shown, param->key, says, source, part->group,
                                             other, param->unit));
    }
    return;
  }
  SbReport report = {0};
  if (sb_params_set(params, id, value, &report) != SB_OK) {
    g_autofree char *range = sb_param_range(id);
    complain(part, source, range, "makes a %s of %.5g %s, out of range", param->key,
             sb_quantity_to_shown(value, param->si, param->unit), param->unit);
  }
}

// "3 mm .. 5 mm" of a profile. False if absent or wrong.
static bool read_stretch(const Part *part, const char *name, double *from, double *to) {
  const SbEntry *entry = find(part, name);
  if (entry == NULL) {
    return false;
  }
  g_auto(GStrv) ends = g_strsplit(entry->value, "..", 2);
  if (g_strv_length(ends) != 2) {
    complain(part, name, "3 mm .. 5 mm", "is no stretch of the profile");
    return false;
  }
  *from = quantity(part, name, g_strstrip(ends[0]), "m", "mm");
  *to = isnan(*from) ? NAN : quantity(part, name, g_strstrip(ends[1]), "m", "mm");
  return !isnan(*to);
}

static void derive_diameters(SbParams *params, const Part *part, const SbProfile *profile,
                             GPtrArray *notes) {
  double from;
  double to;
  double least;
  double most;
  SbReport report = {0};
  if (read_stretch(part, "bore", &from, &to)) {
    if (sb_profile_bore(&least, profile, from, to, &report) == SB_OK) {
      derive(params, SB_P_BORE_DIAMETER, least, part, "bore", notes);
    } else {
      complain(part, "bore", NULL, "%s", report.text);
    }
  }
  if (read_stretch(part, "land", &from, &to)) {
    if (sb_profile_diameters(&least, &most, profile, from, to, &report) == SB_OK) {
      derive(params, SB_P_STEM_PRESSURE_DIAMETER, most, part, "land", notes);
    } else {
      complain(part, "land", NULL, "%s", report.text);
    }
  }
  if (read_stretch(part, "groove", &from, &to)) {
    if (sb_profile_diameters(&least, &most, profile, from, to, &report) == SB_OK) {
      double bore = sb_params_get(params, SB_P_BORE_DIAMETER);
      derive(params, SB_P_GLAND_RADIAL_SPACE, (bore - least) / 2, part, "groove", notes);
    } else {
      complain(part, "groove", NULL, "%s", report.text);
    }
  }
}

// Mass and moments by a mesh; false with an issue.
static bool solve_mesh(SbSolid *solid, const Part *part, const char *file, const char *directory,
                       double density, int *axis) {
  const SbEntry *unit = find(part, "unit");
  const SbEntry *along = find(part, "axis");
  if (unit == NULL) {
    complain(part, "unit", "mm, inch, m", "is missing: an STL file knows no unit");
    return false;
  }
  *axis = along == NULL || strcmp(along->value, "x") == 0 ? 0
          : strcmp(along->value, "y") == 0                ? 1
          : strcmp(along->value, "z") == 0                ? 2
                                                          : -1;
  if (*axis < 0) {
    complain(part, "axis", "x, y or z", "'%.20s' is no axis", along->value);
    return false;
  }
  g_autofree char *path = g_path_is_absolute(file) || directory == NULL
                              ? g_strdup(file)
                              : g_build_filename(directory, file, NULL);
  SbStl stl = {0};
  GError *error = NULL;
  if (!sb_stl_read(&stl, path, unit->value, &error)) {
    complain(part, "stl", NULL, "%s", error->message);
    g_error_free(error);
    return false;
  }
  SbReport report = {0};
  SbStatus status = sb_solid_mesh(solid, stl.vertices, stl.vertex_count, stl.triangles,
                                  stl.triangle_count, density, &report);
  sb_stl_clear(&stl);
  if (status != SB_OK) {
    complain(part, "stl", NULL, "%s", report.text);
  }
  return status == SB_OK;
}

static void read_part(SbParams *params, const Part *part, SbParamId mass, const char *directory,
                      GPtrArray *notes) {
  const SbEntry *profile = find(part, "profile");
  const SbEntry *stl = find(part, "stl");
  if (profile == NULL && stl == NULL) {
    for (int i = 0; shape_keys[i] != NULL; i++) {
      if (find(part, shape_keys[i]) != NULL) {
        complain(part, shape_keys[i], NULL, "needs a profile or an stl beside it");
      }
    }
    return;
  }
  if (profile != NULL && stl != NULL) {
    complain(part, "stl", NULL, "a part has a profile or a mesh, not both");
    return;
  }
  const SbEntry *dense = find(part, "density");
  double density = quantity(part, "density", dense != NULL ? dense->value : NULL, "kg/m3", "kg/m3");
  if (isnan(density)) {
    return;
  }
  if (!(density > 0)) {
    complain(part, "density", "above 0", "must be above 0");
    return;
  }
  SbSolid solid;
  int axis = 0;
  if (profile != NULL) {
    SbProfile shape = {0};
    SbProfilePoint *points = read_points(part, profile->value, &shape.count, &shape.closed);
    if (points == NULL) {
      return;
    }
    shape.point = points;
    SbReport report = {0};
    bool good = sb_solid_revolve(&solid, &shape, density, &report) == SB_OK;
    if (good) {
      derive_diameters(params, part, &shape, notes);
    } else {
      complain(part, "profile", NULL, "%s", report.text);
    }
    g_free(points);
    if (!good) {
      return;
    }
  } else if (!solve_mesh(&solid, part, stl->value, directory, density, &axis)) {
    return;
  }
  const char *source = profile != NULL ? "profile" : "stl";
  double across = (solid.inertia[(axis + 1) % 3][(axis + 1) % 3] +
                   solid.inertia[(axis + 2) % 3][(axis + 2) % 3]) /
                  2;
  // Mass, axial and transverse moment follow each other in the catalogue.
  derive(params, mass, solid.mass, part, source, notes);
  derive(params, mass + 1, solid.inertia[axis][axis], part, source, notes);
  derive(params, mass + 2, across, part, source, notes);
}

void sb_parts_read(SbParams *params, const GPtrArray *entries, const char *shown,
                   const char *directory, GPtrArray *issues, GPtrArray *notes) {
  // Every part has a mass in the catalogue. The housing comes first: its bore measures the grooves.
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    const char *key = sb_param((SbParamId)id)->key;
    if (g_str_has_prefix(key, "part.") && g_str_has_suffix(key, ".mass")) {
      g_autofree char *group = g_strndup(key, strlen(key) - strlen(".mass"));
      Part part = {entries, group, shown, issues};
      read_part(params, &part, (SbParamId)id, directory, notes);
    }
  }
  // The stem's three parts together against stem.mass.
  const SbParamId stem[] = {SB_P_PART_STEM_CENTRE_MASS, SB_P_PART_STEM_TOP_MASS,
                            SB_P_PART_STEM_BOTTOM_MASS};
  double sum = 0;
  bool given = params->given[SB_P_STEM_MASS];
  for (size_t i = 0; i < G_N_ELEMENTS(stem); i++) {
    sum += params->value[stem[i]];
    given = given && params->given[stem[i]];
  }
  double mass = params->value[SB_P_STEM_MASS];
  if (given && fabs(mass - sum) > 1e-3 * mass) {
    g_ptr_array_add(notes, g_strdup_printf("%s: stem.mass = %.5g g is in force; the stem's parts "
                                           "make %.5g g and share it in proportion",
                                           shown, 1e3 * mass, 1e3 * sum));
  }
}
