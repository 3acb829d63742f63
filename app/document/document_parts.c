// Parts by their shape: a half-profile or an STL mesh in a [part.NAME] group gives the part's mass
// and moments of inertia (engine/mechanism/solid.h), and by stretches of a profile the valve's
// diameters.
//
//   [part.stem_centre]
//   density = 1410 kg/m3
//   profile = mm 14,0 14,2.9 8,2.9 8,1.64 6,1.64 6,2.9 0,2.9 0,0
//   land = 8 mm .. 14 mm
//   inner_groove = 6 mm .. 8 mm
//
// A profile is a unit and points x,r counter-clockwise in the (x, r) plane, x along the axis; a
// third number is the bulge of the arc to the next point (tan of a quarter of its angle, > 0 to the
// left). It closes by repeating its first point, or by the axis where it starts and ends. A mesh is
// `stl = FILE` beside the document with `unit = mm` and, unless it is x, `axis = y` or `z`.
// Stretches of a profile, x pointing out of the canister:
//   bore (housing)               bore.diameter; with the land's ends and the mouth beside it
//   land                         stem.pressure_diameter
//   groove                       gland.radial_space (with the bore)
//   inner_groove, outer_groove   the same, wall to wall: gland.axial_width too, and both together
//                                stem.seal_spacing and the recess of the dose chamber between them
// A recess of any form counts as the rectangular one of its depth and volume.
#include "app/document/document_parts.h"

#include "app/base/unit.h"
#include "app/cad/profile.h"
#include "app/cad/stl.h"

#include "engine/mechanism/solid.h"

#include <math.h>
#include <string.h>

const char *const sb_shape_parts[] = {[SB_VALVE_HOUSING] = "housing",
                                      [SB_VALVE_STEM_CENTRE] = "stem_centre",
                                      [SB_VALVE_STEM_TOP] = "stem_top",
                                      [SB_VALVE_STEM_BOTTOM] = "stem_bottom"};

static const char *const shape_keys[] = {"density",      "profile",      "stl",  "unit",
                                         "axis",         "bore",         "land", "groove",
                                         "inner_groove", "outer_groove", NULL};

// How far a drawn arc may lie from the true one [m]: a fifth of a pixel at 800 pixels per mm.
static const double SAGITTA = 0.25e-6;

static void free_size(gpointer data) {
  SbShapeSize *size = data;
  g_free(size->source);
  g_free(size);
}

SbShapes *sb_shapes_new(void) {
  SbShapes *shapes = g_new0(SbShapes, 1);
  shapes->sizes = g_ptr_array_new_with_free_func(free_size);
  shapes->masses = g_ptr_array_new_with_free_func(free_size);
  return shapes;
}

void sb_shapes_free(SbShapes *shapes) {
  if (shapes == NULL) {
    return;
  }
  g_ptr_array_unref(shapes->sizes);
  g_ptr_array_unref(shapes->masses);
  for (size_t i = 0; i < G_N_ELEMENTS(shapes->text); i++) {
    g_free(shapes->text[i]);
  }
  g_free(shapes);
}

const SbShapeSize *sb_shapes_size(const SbShapes *shapes, SbParamId id) {
  const SbShapeSize *found = NULL;
  for (guint i = 0; i < shapes->sizes->len; i++) {
    const SbShapeSize *size = shapes->sizes->pdata[i];
    if (size->id == id && (found == NULL || !size->in_valve)) {
      found = size;
    }
  }
  return found;
}

const SbShapeSize *sb_shapes_own(const SbShapes *shapes, SbParamId id, bool in_valve) {
  for (int k = 0; k < 2; k++) {
    const GPtrArray *list = k == 0 ? shapes->sizes : shapes->masses;
    for (guint i = 0; i < list->len; i++) {
      const SbShapeSize *size = list->pdata[i];
      if (size->id == id && size->in_valve == in_valve) {
        return size;
      }
    }
  }
  return NULL;
}

bool sb_parts_is_shape_key(const char *group, const char *name) {
  return g_str_has_prefix(group, "part.") && g_strv_contains(shape_keys, name);
}

// What is read from one group, and where its problems go.
typedef struct {
  const GPtrArray *entries;
  const char *group, *shown;
  GPtrArray *issues, *notes;
  int index; // of the valve's parts
  SbShapes *shapes;
  SbParams *params;
  const SbParams *base;
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

// Sets `id` to what the shape says, if that is within its range.
static void set(const Part *part, SbParamId id, double value, const char *source) {
  const SbParam *param = sb_param(id);
  SbReport report = {0};
  if (sb_params_set(part->params, id, value, &report) != SB_OK) {
    g_autofree char *range = sb_param_range(id);
    complain(part, source, range, "results in a %s of %.5g %s, out of range", param->key,
             sb_quantity_to_shown(value, param->si, param->unit), param->unit);
  }
}

static bool differs(const Part *part, SbParamId id, double value) {
  double given = part->params->value[id];
  return fabs(given - value) > SB_SHAPE_ROUNDING * fabs(given);
}

static void keep_size(GPtrArray *list, const Part *part, SbParamId id, double value,
                      const char *source) {
  SbShapeSize *size = g_new(SbShapeSize, 1);
  *size = (SbShapeSize){id, value, part->base == NULL,
                        g_strdup_printf("the %s of [%s]", source, part->group)};
  g_ptr_array_add(list, size);
}

// A mass or moment: a given one may be weighed, or the part made of more than its shape.
static void derive_mass(const Part *part, SbParamId id, double value, const char *source) {
  const SbParam *param = sb_param(id);
  keep_size(part->shapes->masses, part, id, value, source);
  if (!part->params->given[id]) {
    set(part, id, value, source);
  } else if (differs(part, id, value)) {
    g_autofree char *says = sb_quantity_format(part->params->value[id], param->si, param->unit);
    g_autofree char *other = sb_quantity_round(value, param->si, param->unit, 5);
    g_ptr_array_add(part->notes,
                    g_strdup_printf("%s: %s = %s applies; the %s of [%s] results in %s",
                                    part->shown, param->key, says, source, part->group, other));
  }
}

// A size: the shape takes precedence.
static void derive_size(const Part *part, SbParamId id, double value, const char *source) {
  const SbParam *param = sb_param(id);
  if (!part->params->given[id]) {
    set(part, id, value, source);
  } else if (differs(part, id, value)) {
    const SbEntry *typed = NULL;
    for (guint i = 0; i < part->entries->len; i++) {
      const SbEntry *entry = part->entries->pdata[i];
      size_t length = entry->name != NULL ? strlen(entry->group) : 0;
      if (length > 0 && strncmp(param->key, entry->group, length) == 0 &&
          param->key[length] == '.' && strcmp(param->key + length + 1, entry->name) == 0) {
        typed = entry;
      }
    }
    g_autofree char *says = sb_quantity_format(part->params->value[id], param->si, param->unit);
    g_autofree char *other = sb_quantity_round(value, param->si, param->unit, 5);
    sb_issues_add(part->issues, part->shown, typed != NULL ? typed->line : 0, param->key, NULL,
                  "is %s, but the %s of [%s] results in %s: the shape takes precedence, remove "
                  "the key or correct one of them",
                  says, source, part->group, other);
    return;
  }
  const SbShapeSize *known = sb_shapes_size(part->shapes, id);
  if (known != NULL && known->in_valve == (part->base == NULL)) {
    return; // two grooves, one gland
  }
  keep_size(part->shapes->sizes, part, id, value, source);
}

// "3 mm .. 5 mm" of a profile. False if absent or wrong.
static bool read_stretch(const Part *part, const char *name, double *from, double *to) {
  const SbEntry *entry = find(part, name);
  if (entry == NULL) {
    return false;
  }
  g_auto(GStrv) ends = g_strsplit(entry->value, "..", 2);
  if (g_strv_length(ends) != 2) {
    complain(part, name, "3 mm .. 5 mm", "is not a stretch of the profile");
    return false;
  }
  *from = quantity(part, name, g_strstrip(ends[0]), "m", "mm");
  *to = isnan(*from) ? NAN : quantity(part, name, g_strstrip(ends[1]), "m", "mm");
  return !isnan(*to);
}

// Value in force for what is derived next.
static double in_force(const Part *part, SbParamId id) {
  bool own = part->params->given[id] || part->base == NULL;
  return own ? part->params->value[id] : part->base->value[id];
}

// The bore land about the stretch, the mouth ahead of it, and where both lie.
static void derive_land(const Part *part, double diameter, double from) {
  SbShapes *shapes = part->shapes;
  const SbOutline *outline = &shapes->outlines.part[part->index];
  g_autofree SbOutlineSurface *s = g_new(SbOutlineSurface, 1);
  sb_outline_surface(s, outline);
  // To the left as long as the hole is no wider.
  double wider = diameter / 2 * (1 + 1e-4);
  size_t k = 0;
  while (k + 2 < s->count && s->x[k + 1] <= from) {
    k++;
  }
  while (k > 0 && s->low_left[k] <= wider && s->low_right[k - 1] <= wider) {
    k--;
  }
  double edge = s->x[k], face = s->x[0], end = s->x[s->count - 1];
  double low, high;
  shapes->outlines.land_edge = edge;
  shapes->outlines.bore = diameter / 2;
  shapes->has_bore = true;
  derive_size(part, SB_P_BORE_LAND_LENGTH, end - edge, "bore");
  if (edge > face && sb_outline_radii(&low, &high, s, face + (edge - face) / 4)) {
    derive_size(part, SB_P_BORE_ENTRY_LENGTH, edge - face, "bore");
    derive_size(part, SB_P_BORE_ENTRY_DIAMETER, 2 * low, "bore");
  }
}

// One groove, wall to wall.
static void derive_groove(const Part *part, const SbProfile *profile, int seal, const char *name) {
  double from, to;
  SbProfileDiameters found;
  SbReport report = {0};
  if (!read_stretch(part, name, &from, &to)) {
    return;
  }
  if (sb_profile_diameters(&found, profile, from, to, &report) != SB_OK) {
    complain(part, name, NULL, "%s", report.text);
    return;
  }
  derive_size(part, SB_P_GLAND_RADIAL_SPACE,
              (in_force(part, SB_P_BORE_DIAMETER) - found.smallest) / 2, name);
  derive_size(part, SB_P_GLAND_AXIAL_WIDTH, to - from, name);
  SbValveOutlines *outlines = &part->shapes->outlines;
  outlines->groove_left[seal] = from;
  outlines->groove_right[seal] = to;
  outlines->floor = found.smallest / 2;
  part->shapes->has_groove[seal] = true;
}

// What lies between the two grooves of one part.
static void derive_chamber(const Part *part) {
  SbValveOutlines *outlines = &part->shapes->outlines;
  double left = outlines->groove_right[SB_INNER], right = outlines->groove_left[SB_OUTER];
  if (!(right > left)) {
    complain(part, "inner_groove", NULL,
             "must be before the outer_groove: x points out of the canister");
    return;
  }
  SbOutlineSurface *s = g_new(SbOutlineSurface, 1);
  sb_outline_surface(s, &outlines->part[part->index]);
  double deepest = outlines->land, low, high;
  for (size_t i = 0; i + 1 < s->count; i++) {
    double from = MAX(s->x[i], left), to = MIN(s->x[i + 1], right);
    double side = 1e-9 * (to - from);
    // Less than a nanometre is the wall's own place, rounded otherwise than the stretch's end.
    if (to - from <= 1e-9) {
      continue;
    }
    if (sb_outline_radii(&low, &high, s, from + side)) {
      deepest = MIN(deepest, high);
    }
    if (sb_outline_radii(&low, &high, s, to - side)) {
      deepest = MIN(deepest, high);
    }
  }
  double land = outlines->land, area = G_PI * (land * land - deepest * deepest);
  double room = sb_outline_room(s, land, left, right);
  g_free(s);
  derive_size(part, SB_P_STEM_SEAL_SPACING,
              outlines->groove_right[SB_OUTER] - outlines->groove_right[SB_INNER], "outer_groove");
  derive_size(part, SB_P_STEM_CHAMBER_DEPTH, land - deepest, "profile");
  if (area > 0) {
    derive_size(part, SB_P_STEM_CHAMBER_LENGTH, room / area, "profile");
  }
}

static void derive_sizes(const Part *part, const SbProfile *profile) {
  double from, to;
  SbProfileDiameters found;
  SbReport report = {0};
  bool stem = part->index >= SB_VALVE_STEM_CENTRE && part->index <= SB_VALVE_STEM_BOTTOM;
  if (read_stretch(part, "bore", &from, &to)) {
    if (sb_profile_diameters(&found, profile, from, to, &report) == SB_OK) {
      derive_size(part, SB_P_BORE_DIAMETER, found.bore, "bore");
      if (part->index == SB_VALVE_HOUSING) {
        derive_land(part, found.bore, from);
      }
    } else {
      complain(part, "bore", NULL, "%s", report.text);
    }
  }
  if (read_stretch(part, "land", &from, &to)) {
    if (sb_profile_diameters(&found, profile, from, to, &report) == SB_OK) {
      derive_size(part, SB_P_STEM_PRESSURE_DIAMETER, found.largest, "land");
      part->shapes->outlines.land = found.largest / 2;
    } else {
      complain(part, "land", NULL, "%s", report.text);
    }
  }
  if (read_stretch(part, "groove", &from, &to)) {
    if (sb_profile_diameters(&found, profile, from, to, &report) == SB_OK) {
      double bore = in_force(part, SB_P_BORE_DIAMETER);
      derive_size(part, SB_P_GLAND_RADIAL_SPACE, (bore - found.smallest) / 2, "groove");
    } else {
      complain(part, "groove", NULL, "%s", report.text);
    }
  }
  if (stem) {
    derive_groove(part, profile, SB_INNER, "inner_groove");
    derive_groove(part, profile, SB_OUTER, "outer_groove");
    SbShapes *shapes = part->shapes;
    if (find(part, "inner_groove") != NULL && find(part, "outer_groove") != NULL &&
        shapes->has_groove[SB_INNER] && shapes->has_groove[SB_OUTER]) {
      if (shapes->outlines.land == 0) {
        shapes->outlines.land = in_force(part, SB_P_STEM_PRESSURE_DIAMETER) / 2;
      }
      derive_chamber(part);
    }
  }
}

// Mass and moments by a mesh; false with an issue.
static bool solve_mesh(SbSolid *solid, const Part *part, const char *file, const char *directory,
                       double density, int *axis) {
  const SbEntry *unit = find(part, "unit");
  const SbEntry *along = find(part, "axis");
  if (unit == NULL) {
    complain(part, "unit", "mm, inch, m", "is missing: an STL file states no unit");
    return false;
  }
  *axis = along == NULL || strcmp(along->value, "x") == 0 ? 0
          : strcmp(along->value, "y") == 0                ? 1
          : strcmp(along->value, "z") == 0                ? 2
                                                          : -1;
  if (*axis < 0) {
    complain(part, "axis", "x, y or z", "'%s' is not an axis", along->value);
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

// The shape's keys as lines that stand alone.
static void keep_text(const Part *part, const char *directory) {
  GString *text = g_string_new(NULL);
  // A mesh lies beside the document, whose folder may be relative.
  g_autofree char *folder = g_canonicalize_filename(directory != NULL ? directory : ".", NULL);
  for (int i = 0; shape_keys[i] != NULL; i++) {
    const SbEntry *entry = find(part, shape_keys[i]);
    if (entry != NULL && strcmp(shape_keys[i], "stl") == 0) {
      g_autofree char *path = g_canonicalize_filename(entry->value, folder);
      g_string_append_printf(text, "stl = %s\n", path);
    } else if (entry != NULL) {
      g_string_append_printf(text, "%s = %s\n", shape_keys[i], entry->value);
    }
  }
  g_free(part->shapes->text[part->index]);
  part->shapes->text[part->index] = g_string_free(text, FALSE);
}

// A half-profile: its solid, its outline for the drawing and its sizes. False with an issue.
static bool solve_profile(SbSolid *solid, const Part *part, const char *text, double density) {
  bool closed;
  GError *error = NULL;
  g_autoptr(GArray) points = sb_profile_parse(text, &closed, &error);
  if (points == NULL) {
    complain(part, "profile", SB_PROFILE_FORM, "%s", error->message);
    g_error_free(error);
    return false;
  }
  const SbProfile shape = {(const SbProfilePoint *)(void *)points->data, points->len, closed};
  SbReport report = {0};
  bool good = sb_solid_revolve(solid, &shape, density, &report) == SB_OK;
  if (good && part->index <= SB_VALVE_STEM_BOTTOM) {
    good = sb_outline_of_profile(&part->shapes->outlines.part[part->index], &shape, SAGITTA,
                                 &report) == SB_OK;
  }
  if (good) {
    derive_sizes(part, &shape);
  } else {
    complain(part, "profile", NULL, "%s", report.text);
  }
  return good;
}

static void read_part(const Part *part, SbParamId mass, const char *directory) {
  const SbEntry *profile = find(part, "profile");
  const SbEntry *stl = find(part, "stl");
  if (profile == NULL && stl == NULL) {
    for (int i = 0; shape_keys[i] != NULL; i++) {
      if (find(part, shape_keys[i]) != NULL) {
        complain(part, shape_keys[i], NULL, "needs a profile or an stl too");
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
  bool good = profile != NULL ? solve_profile(&solid, part, profile->value, density)
                              : solve_mesh(&solid, part, stl->value, directory, density, &axis);
  if (!good) {
    return;
  }
  const char *source = profile != NULL ? "profile" : "stl";
  double across = (solid.inertia[(axis + 1) % 3][(axis + 1) % 3] +
                   solid.inertia[(axis + 2) % 3][(axis + 2) % 3]) /
                  2;
  // Mass, axial and transverse moment follow each other in the catalogue.
  derive_mass(part, mass, solid.mass, source);
  derive_mass(part, mass + 1, solid.inertia[axis][axis], source);
  derive_mass(part, mass + 2, across, source);
  if (part->index <= SB_VALVE_STEM_BOTTOM) {
    keep_text(part, directory);
    part->shapes->mesh[part->index] = stl != NULL;
  }
}

void sb_shapes_settle(SbShapes *shapes, const char *shown, GPtrArray *notes) {
  SbValveOutlines *outlines = &shapes->outlines;
  outlines->housing = shapes->has_bore && outlines->part[SB_VALVE_HOUSING].count > 0;
  outlines->stem = shapes->has_groove[SB_INNER] && shapes->has_groove[SB_OUTER] &&
                   outlines->part[SB_VALVE_STEM_CENTRE].count > 0;
  for (size_t i = 0; i < G_N_ELEMENTS(sb_shape_parts); i++) {
    if (shapes->mesh[i]) {
      // A mesh need not be a body of revolution, and facets are no diameters.
      g_ptr_array_add(notes,
                      g_strdup_printf("%s: the mesh of [part.%s] gives mass and moments only; "
                                      "the section draws a profile, not a mesh",
                                      shown, sb_shape_parts[i]));
    }
  }
  static const char *const needs[] = {"a bore", "an inner_groove and an outer_groove"};
  for (int i = 0; i < 2; i++) {
    int part = i == 0 ? SB_VALVE_HOUSING : SB_VALVE_STEM_CENTRE;
    bool drawn = i == 0 ? outlines->housing : outlines->stem;
    if (outlines->part[part].count > 0 && !drawn) {
      g_ptr_array_add(notes,
                      g_strdup_printf("%s: the section does not draw the shape of [part.%s], "
                                      "which needs %s to be put in its place",
                                      shown, i == 0 ? "housing" : "stem_centre", needs[i]));
    }
  }
}

// The stem's three parts together against stem.mass, whichever of them this document gives; what it
// does not give is its valve's.
static void tell_stem_mass(const SbParams *params, const SbParams *base, const char *shown,
                           GPtrArray *notes) {
  const SbParamId id[] = {SB_P_STEM_MASS, SB_P_PART_STEM_CENTRE_MASS, SB_P_PART_STEM_TOP_MASS,
                          SB_P_PART_STEM_BOTTOM_MASS};
  double mass[G_N_ELEMENTS(id)];
  bool own = false;
  for (size_t i = 0; i < G_N_ELEMENTS(id); i++) {
    const SbParams *source = params->given[id[i]] || base == NULL ? params : base;
    if (!source->given[id[i]]) {
      return;
    }
    own = own || source == params;
    mass[i] = source->value[id[i]];
  }
  double sum = mass[1] + mass[2] + mass[3];
  if (own && fabs(mass[0] - sum) > 1e-3 * mass[0]) {
    g_ptr_array_add(notes, g_strdup_printf("%s: stem.mass = %.5g g applies; the stem's parts add "
                                           "up to %.5g g and are scaled in proportion",
                                           shown, 1e3 * mass[0], 1e3 * sum));
  }
}

SbParamId sb_parts_mass(int part) {
  static const SbParamId masses[SB_VALVE_PARTS] = {
      [SB_VALVE_HOUSING] = SB_P_PART_HOUSING_MASS,
      [SB_VALVE_STEM_CENTRE] = SB_P_PART_STEM_CENTRE_MASS,
      [SB_VALVE_STEM_TOP] = SB_P_PART_STEM_TOP_MASS,
      [SB_VALVE_STEM_BOTTOM] = SB_P_PART_STEM_BOTTOM_MASS,
      [SB_VALVE_INNER_SEAL] = SB_P_PART_INNER_SEAL_MASS,
      [SB_VALVE_OUTER_SEAL] = SB_P_PART_OUTER_SEAL_MASS,
      [SB_VALVE_BLOCK] = SB_P_PART_BLOCK_MASS,
  };
  return masses[part];
}

void sb_parts_read(SbShapes *shapes, SbParams *params, const SbParams *base,
                   const GPtrArray *entries, const char *shown, const char *directory,
                   GPtrArray *issues, GPtrArray *notes) {
  // The housing comes first: its bore measures the grooves.
  for (int i = 0; i < SB_VALVE_PARTS; i++) {
    const SbParamId mass = sb_parts_mass(i);
    const char *key = sb_param(mass)->key;
    g_autofree char *group = g_strndup(key, (gsize)(strrchr(key, '.') - key));
    Part part = {entries, group, shown, issues, notes, i, shapes, params, base};
    read_part(&part, mass, directory);
  }
  tell_stem_mass(params, base, shown, notes);
}
