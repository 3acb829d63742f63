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
#include "app/cad/cad.h"
#include "app/document/document_parts_private.h"
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

const SbEntry *sb_part_find(const SbPart *part, const char *name) {
  for (guint i = 0; i < part->entries->len; i++) {
    const SbEntry *entry = part->entries->pdata[i];
    if (entry->name != NULL && strcmp(entry->group, part->group) == 0 &&
        strcmp(entry->name, name) == 0) {
      return entry;
    }
  }
  return NULL;
}

void sb_part_complain(const SbPart *part, const char *name, const char *allowed, const char *format,
                      ...) {
  const SbEntry *entry = sb_part_find(part, name);
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *text = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  g_autofree char *key = g_strdup_printf("%s.%s", part->group, name);
  sb_issues_add(part->issues, part->shown, entry != NULL ? entry->line : 0, key, allowed, "%s",
                text);
}

double sb_part_quantity(const SbPart *part, const char *name, const char *text, const char *si,
                        const char *unit) {
  double value = NAN;
  GError *error = NULL;
  if (text == NULL) {
    sb_part_complain(part, name, NULL, "is missing: the part's shape needs it");
  } else if (!sb_quantity_parse(&value, text, si, unit, &error)) {
    sb_part_complain(part, name, NULL, "%s", error->message);
    g_error_free(error);
    value = NAN;
  }
  return value;
}

void sb_part_set(const SbPart *part, SbParamId id, double value, const char *source) {
  const SbParam *param = sb_param(id);
  SbReport report = {0};
  if (sb_params_set(part->params, id, value, &report) != SB_OK) {
    g_autofree char *range = sb_param_range(id);
    sb_part_complain(part, source, range, "results in a %s of %.5g %s, out of range", param->key,
                     sb_quantity_to_shown(value, param->si, param->unit), param->unit);
  }
}

// Mass and moments by a mesh; false with an issue.
static bool solve_mesh(SbSolid *solid, const SbPart *part, const char *file, const char *directory,
                       double density, int *axis) {
  const SbEntry *unit = sb_part_find(part, "unit");
  const SbEntry *along = sb_part_find(part, "axis");
  if (unit == NULL) {
    sb_part_complain(part, "unit", "mm, inch, m", "is missing: an STL file states no unit");
    return false;
  }
  *axis = along == NULL || strcmp(along->value, "x") == 0 ? 0
          : strcmp(along->value, "y") == 0                ? 1
          : strcmp(along->value, "z") == 0                ? 2
                                                          : -1;
  if (*axis < 0) {
    sb_part_complain(part, "axis", "x, y or z", "'%s' is not an axis", along->value);
    return false;
  }
  g_autofree char *path = g_path_is_absolute(file) || directory == NULL
                              ? g_strdup(file)
                              : g_build_filename(directory, file, NULL);
  SbStl stl = {0};
  GError *error = NULL;
  if (!sb_stl_read(&stl, NULL, 0, unit->value, path, &error)) {
    sb_part_complain(part, "stl", NULL, "%s", error->message);
    g_error_free(error);
    return false;
  }
  SbReport report = {0};
  SbStatus status = sb_solid_mesh(solid, stl.vertices, stl.vertex_count, stl.triangles,
                                  stl.triangle_count, density, &report);
  sb_stl_clear(&stl);
  if (status != SB_OK) {
    sb_part_complain(part, "stl", NULL, "%s", report.text);
  }
  return status == SB_OK;
}

// The shape's keys as lines that stand alone.
static void keep_text(const SbPart *part, const char *directory) {
  GString *text = g_string_new(NULL);
  // A mesh lies beside the document, whose folder may be relative.
  g_autofree char *folder = g_canonicalize_filename(directory != NULL ? directory : ".", NULL);
  for (int i = 0; shape_keys[i] != NULL; i++) {
    const SbEntry *entry = sb_part_find(part, shape_keys[i]);
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
static bool solve_profile(SbSolid *solid, const SbPart *part, const char *text, double density) {
  bool closed;
  GError *error = NULL;
  g_autoptr(GArray) points = sb_profile_parse(text, &closed, &error);
  if (points == NULL) {
    sb_part_complain(part, "profile", SB_PROFILE_FORM, "%s", error->message);
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
    sb_part_derive_sizes(part, &shape);
  } else {
    sb_part_complain(part, "profile", NULL, "%s", report.text);
  }
  return good;
}

static void read_part(const SbPart *part, SbParamId mass, const char *directory) {
  const SbEntry *profile = sb_part_find(part, "profile");
  const SbEntry *stl = sb_part_find(part, "stl");
  if (profile == NULL && stl == NULL) {
    for (int i = 0; shape_keys[i] != NULL; i++) {
      if (sb_part_find(part, shape_keys[i]) != NULL) {
        sb_part_complain(part, shape_keys[i], NULL, "needs a profile or an stl too");
      }
    }
    return;
  }
  if (profile != NULL && stl != NULL) {
    sb_part_complain(part, "stl", NULL, "a part has a profile or a mesh, not both");
    return;
  }
  const SbEntry *dense = sb_part_find(part, "density");
  double density =
      sb_part_quantity(part, "density", dense != NULL ? dense->value : NULL, "kg/m3", "kg/m3");
  if (isnan(density)) {
    return;
  }
  if (!(density > 0)) {
    sb_part_complain(part, "density", "above 0", "must be above 0");
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
  sb_part_derive_mass(part, mass, solid.mass, source);
  sb_part_derive_mass(part, mass + 1, solid.inertia[axis][axis], source);
  sb_part_derive_mass(part, mass + 2, across, source);
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
      g_autofree char *group = g_strdup_printf("part.%s", sb_shape_parts[i]);
      sb_issues_add(notes, shown, 0, group, NULL,
                    "%s: the mesh of [part.%s] gives mass and moments only; the section draws a "
                    "profile, not a mesh",
                    shown, sb_shape_parts[i]);
    }
  }
  static const char *const needs[] = {"a bore", "an inner_groove and an outer_groove"};
  for (int i = 0; i < 2; i++) {
    int part = i == 0 ? SB_VALVE_HOUSING : SB_VALVE_STEM_CENTRE;
    bool drawn = i == 0 ? outlines->housing : outlines->stem;
    if (outlines->part[part].count > 0 && !drawn) {
      sb_issues_add(notes, shown, 0, i == 0 ? "part.housing" : "part.stem_centre", NULL,
                    "%s: the section does not draw the shape of [part.%s], which needs %s to be "
                    "put in its place",
                    shown, i == 0 ? "housing" : "stem_centre", needs[i]);
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
    sb_issues_add(notes, shown, 0, sb_param(SB_P_STEM_MASS)->key, NULL,
                  "%s: stem.mass = %.5g g applies; the stem's parts add up to %.5g g and are "
                  "scaled in proportion",
                  shown, 1e3 * mass[0], 1e3 * sum);
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
    SbPart part = {entries, group, shown, issues, notes, i, shapes, params, base};
    read_part(&part, mass, directory);
  }
  tell_stem_mass(params, base, shown, notes);
}
