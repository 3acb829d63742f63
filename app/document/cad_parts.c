// See parts.h.
#include "app/document/cad_parts.h"

#include "app/base/error.h"
#include "app/base/number.h"
#include "app/base/unit.h"

#include <math.h>
#include <string.h>

// Two grooves for equal rings: widths and floors within this, relative.
static const double ALIKE = 0.02;

// Beyond this relative difference of the volumes, mass and moments are those of the file's body
// and not of its revolved half-section. The half-section of a STEP is exact to about 1e-8.
static const double REVOLVED = 1e-6;

int sb_cad_part_of(const char *name) {
  g_autofree char *plain = g_ascii_strdown(name, -1);
  g_strdelimit(plain, " -", '_');
  for (int i = 0; i < SB_CAD_PART_COUNT; i++) {
    if (strcmp(plain, sb_shape_parts[i]) == 0) {
      return i;
    }
  }
  return -1;
}

// ---- Choices ----

void sb_cad_settings_init(SbCadSettings *settings) {
  *settings = (SbCadSettings){.density = 1410}; // acetal, as in piston-profiles.valve
}

void sb_cad_settings_clear(SbCadSettings *settings) {
  g_free(settings->unit);
  for (int i = 0; i < SB_CAD_PART_COUNT; i++) {
    g_free(settings->part[i]);
  }
  *settings = (SbCadSettings){0};
}

static bool refuse(GError **error, const char *says) {
  g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s", says);
  return false;
}

// Reads X,Y,Z: numbers, or lengths in the unit that follows each or all, else in mm.
static bool read_vector(double out[3], const char *text, bool lengths, GError **error) {
  g_auto(GStrv) parts = g_strsplit(text, ",", -1);
  double number;
  bool good = g_strv_length(parts) == 3;
  const char *unit = good ? g_strstrip(parts[2]) + sb_number_read(&number, parts[2]) : "";
  for (int i = 0; good && i < 3; i++) {
    const bool bare = sb_number_parse(&out[i], g_strstrip(parts[i]));
    g_autofree char *one = g_strdup_printf("%s %s", parts[i], !bare ? "" : *unit ? unit : "mm");
    good = lengths ? sb_quantity_parse(&out[i], g_strstrip(one), "m", "mm", NULL) : bare;
  }
  good = good && (lengths || out[0] != 0 || out[1] != 0 || out[2] != 0);
  return good || refuse(error, lengths ? "three lengths X,Y,Z, such as 0,0,5mm"
                                       : "x, y, z or a direction X,Y,Z, not zero");
}

bool sb_cad_choose(SbCadSettings *settings, const char *name, const char *text, GError **error) {
  const int part = sb_cad_part_of(name);
  if (part >= 0) {
    g_free(settings->part[part]);
    settings->part[part] = g_strdup(text);
    return true;
  }
  if (strcmp(name, "unit") == 0) {
    g_free(settings->unit);
    settings->unit = g_strdup(text);
    settings->read.unit = settings->unit;
    return true;
  }
  if (strcmp(name, "axis") == 0) {
    settings->read.axis = settings->axis;
    const bool one = strlen(text) == 1 && strchr("xyz", text[0]) != NULL;
    for (int i = 0; i < 3; i++) {
      settings->axis[i] = text[0] == 'x' + i;
    }
    return one || read_vector(settings->axis, text, false, error);
  }
  if (strcmp(name, "through") == 0) {
    settings->read.through = settings->through;
    return read_vector(settings->through, text, true, error);
  }
  if (strcmp(name, "join") == 0) {
    const double most = 1e-3;
    return sb_quantity_parse(&settings->read.join, text, "m", "mm", error) &&
           ((settings->read.join > 0 && settings->read.join <= most) ||
            refuse(error, "above 0, up to 1 mm"));
  }
  if (strcmp(name, "flip") == 0) {
    settings->read.flip = strcmp(text, "yes") == 0;
    return settings->read.flip || strcmp(text, "no") == 0 || refuse(error, "yes or no");
  }
  if (strcmp(name, "angle") == 0) {
    settings->read.angle = &settings->angle;
    return sb_quantity_parse(&settings->angle, text, "rad", "deg", error);
  }
  if (strcmp(name, "shift") == 0) {
    return sb_quantity_parse(&settings->read.shift, text, "m", "mm", error);
  }
  if (strcmp(name, "density") == 0) {
    return sb_quantity_parse(&settings->density, text, "kg/m3", "kg/m3", error) &&
           ((settings->density >= 1 && settings->density <= 30000) ||
            refuse(error, "1 to 30000 kg/m3"));
  }
  return refuse(error, "there is no such choice");
}

// The body of that number (from 1) or name; -1: none.
static int find_body(const SbCad *cad, const char *text) {
  double number = 0;
  if (sb_number_parse(&number, text) && number >= 1 && number <= cad->bodies->len) {
    return (int)number - 1;
  }
  for (guint i = 0; i < cad->bodies->len; i++) {
    const SbCadBody *one = cad->bodies->pdata[i];
    if (g_ascii_strcasecmp(one->name, text) == 0) {
      return (int)i;
    }
  }
  return -1;
}

// By names, where nobody chose.
static void find_parts(int body[SB_CAD_PART_COUNT], const SbCad *cad) {
  for (int i = 0; i < SB_CAD_PART_COUNT; i++) {
    body[i] = -1;
  }
  for (guint i = 0; i < cad->bodies->len; i++) {
    const SbCadBody *one = cad->bodies->pdata[i];
    const int part = sb_cad_part_of(one->name);
    if (part >= 0 && body[part] < 0 && one->profile->len > 0) {
      body[part] = (int)i;
    }
  }
}

// Refuses a body that the drawing does not have, with those that it has. Always false.
static bool refuse_body(const SbCad *cad, const char *text, const char *part, GError **error) {
  g_autoptr(GString) list = g_string_new(NULL), values = g_string_new(NULL);
  g_autofree char *key = g_strconcat("part=", part, NULL);
  for (guint i = 0; i < cad->bodies->len; i++) {
    const SbCadBody *one = cad->bodies->pdata[i];
    g_string_append_printf(list, "%s%u %s", i > 0 ? ", " : "", i + 1, one->name);
    g_string_append_printf(values, "%s%u", i > 0 ? "\n" : "", i + 1);
  }
  return sb_app_error_choose(error, key, values->str,
                             "there is no body '%s' for %s, by number or name, among %s", text,
                             part, list->str);
}

bool sb_cad_parts(int body[SB_CAD_PART_COUNT], const SbCad *cad, const SbCadSettings *settings,
                  GError **error) {
  find_parts(body, cad);
  for (int i = 0; i < SB_CAD_PART_COUNT; i++) {
    const char *text = settings->part[i];
    if (text == NULL) {
      continue;
    }
    body[i] = find_body(cad, text);
    if (body[i] < 0) {
      return refuse_body(cad, text, sb_shape_parts[i], error);
    }
    const SbCadBody *one = cad->bodies->pdata[body[i]];
    if (one->profile->len == 0) {
      g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "'%s' has no half-section for %s: %s",
                  one->name, sb_shape_parts[i], one->why);
      return false;
    }
  }
  return true;
}

// ---- Stretches ----

static void append_stretch(GString *text, const char *key, const SbCadFeature *feature) {
  char x0[SB_NUMBER_SIZE], x1[SB_NUMBER_SIZE];
  sb_number_round(x0, 1e3 * feature->x0, 12);
  sb_number_round(x1, 1e3 * feature->x1, 12);
  g_string_append_printf(text, "%s = %s mm .. %s mm\n", key, x0, x1);
}

// The longest of the largest (LAND) or smallest (BORE) cylinders.
static const SbCadFeature *cylinder(const SbCadBody *body, SbCadKind kind) {
  const SbCadFeature *best = NULL;
  for (guint i = 0; i < body->features->len; i++) {
    const SbCadFeature *one = &g_array_index(body->features, SbCadFeature, i);
    if (one->kind != kind) {
      continue;
    }
    const double more = best == NULL          ? 1
                        : kind == SB_CAD_LAND ? one->diameter - best->diameter
                                              : best->diameter - one->diameter;
    const bool same = best != NULL && fabs(more) <= 1e-6;
    if (same ? one->x1 - one->x0 > best->x1 - best->x0 : more > 0) {
      best = one;
    }
  }
  return best;
}

// The two grooves that are alike and furthest apart; the only one twice.
static bool grooves(const SbCadBody *body, const SbCadFeature *pair[2]) {
  pair[0] = pair[1] = NULL;
  double apart = 0;
  for (guint i = 0; i < body->features->len; i++) {
    const SbCadFeature *one = &g_array_index(body->features, SbCadFeature, i);
    for (guint k = i + 1; one->kind == SB_CAD_GROOVE && k < body->features->len; k++) {
      const SbCadFeature *other = &g_array_index(body->features, SbCadFeature, k);
      const double width = one->x1 - one->x0, other_width = other->x1 - other->x0;
      if (other->kind == SB_CAD_GROOVE && fabs(width - other_width) <= ALIKE * width &&
          fabs(one->diameter - other->diameter) <= ALIKE * one->diameter &&
          other->x0 - one->x0 > apart) {
        apart = other->x0 - one->x0;
        pair[0] = one;
        pair[1] = other;
      }
    }
  }
  return pair[0] != NULL;
}

static void append_part(GString *text, const SbCadBody *body, int part, double density,
                        const char *drawing) {
  char number[SB_NUMBER_SIZE];
  g_autofree char *profile = sb_cad_profile_text(body);
  g_autofree char *file = g_path_get_basename(drawing);
  g_autofree char *shown = sb_printable(file, strlen(file));
  g_string_append_printf(text, "\n# Drawing: %s, %s\n[part.%s]\n", shown, body->name,
                         sb_shape_parts[part]);
  g_string_append_printf(text, "density = %s kg/m3\n", sb_number_round(number, density, 12));
  g_string_append_printf(text, "profile = %s\n", profile);
  const double volume = body->solid.volume;
  if (body->measured && fabs(body->revolved.volume - volume) > REVOLVED * volume) {
    // Ports and flats: what the kernel measured of the whole body.
    const double across = (body->solid.inertia[1][1] + body->solid.inertia[2][2]) / 2;
    char axial[SB_NUMBER_SIZE], transverse[SB_NUMBER_SIZE];
    g_string_append_printf(text,
                           "mass = %s g\ninertia_axial = %s g.mm2\ninertia_transverse = %s g.mm2\n",
                           sb_number_round(number, 1e3 * density * volume, 12),
                           sb_number_round(axial, 1e9 * density * body->solid.inertia[0][0], 12),
                           sb_number_round(transverse, 1e9 * density * across, 12));
  }
  const SbCadFeature *found, *pair[2];
  if (part == SB_VALVE_HOUSING && (found = cylinder(body, SB_CAD_BORE)) != NULL) {
    append_stretch(text, "bore", found);
  }
  if (part == SB_VALVE_STEM_CENTRE && (found = cylinder(body, SB_CAD_LAND)) != NULL) {
    append_stretch(text, "land", found);
  }
  if (part == SB_VALVE_STEM_CENTRE && grooves(body, pair)) {
    append_stretch(text, "inner_groove", pair[0]);
    append_stretch(text, "outer_groove", pair[1]);
  }
}

// ---- The scene ----

// The document's text without its groups of the parts that are drawn.
static char *without_parts(const char *text, const int body[SB_CAD_PART_COUNT]) {
  g_auto(GStrv) lines = g_strsplit(text, "\n", -1);
  GString *kept = g_string_new(NULL);
  bool drop = false;
  for (char **line = lines; *line != NULL; line++) {
    if (**line == '[') {
      drop = false;
      for (int i = 0; i < SB_CAD_PART_COUNT; i++) {
        g_autofree char *group = g_strdup_printf("[part.%s]", sb_shape_parts[i]);
        drop = drop || (body[i] >= 0 && g_str_has_prefix(*line, group));
      }
    }
    if (!drop) {
      g_string_append_printf(kept, "%s%s", *line, line[1] != NULL ? "\n" : "");
    }
  }
  return g_string_free(kept, FALSE);
}

char *sb_cad_scene(SbDocument **after, const SbCad *cad, const int body[SB_CAD_PART_COUNT],
                   double density, const SbDocument *base, const char *drawing, const char *path,
                   GPtrArray *issues) {
  *after = NULL;
  g_autoptr(GString) parts = g_string_new(NULL);
  for (int i = 0; i < SB_CAD_PART_COUNT; i++) {
    if (body[i] >= 0) {
      append_part(parts, cad->bodies->pdata[body[i]], i, density, drawing);
    }
  }
  // What the shapes alone give.
  g_autoptr(GString) alone =
      g_string_new("[sealbench]\nformat = 1\nkind = valve\ntitle = Drawing\n");
  g_string_append(alone, parts->str);
  g_autoptr(SbDocument) shapes = sb_document_parse(alone->str, alone->len, drawing, NULL, issues);
  if (shapes == NULL || issues->len > 0) {
    return NULL;
  }
  // A copy of the base as a scene's text, in which those sizes are not given.
  g_autofree char *flat = sb_document_kind(base) == SB_DOCUMENT_SCENE
                              ? sb_document_to_text(base, path)
                              : sb_document_to_flat_text(base);
  g_autofree char *directory = g_path_get_dirname(path);
  g_autofree char *plain = without_parts(flat, body);
  g_autoptr(SbDocument) copy = sb_document_parse(plain, strlen(plain), drawing, directory, issues);
  if (copy == NULL || issues->len > 0) {
    return NULL;
  }
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    if (sb_document_shape_source(shapes, (SbParamId)i) != NULL &&
        sb_document_gives(copy, (SbParamId)i)) {
      sb_document_unset(copy, (SbParamId)i);
    }
  }
  g_autofree char *kept = sb_document_to_text(copy, path);
  char *text = g_strconcat(kept, parts->str, NULL);
  *after = sb_document_parse(text, strlen(text), path, directory, issues);
  if (*after == NULL || issues->len > 0) {
    g_clear_pointer(after, sb_document_free);
    g_clear_pointer(&text, g_free);
  }
  return text;
}

char *sb_cad_differences(const SbDocument *before, const SbDocument *after) {
  GString *lines = g_string_new(NULL);
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParamId id = (SbParamId)i;
    const SbParam *param = sb_param(id);
    const double old = sb_document_value(before, id), now = sb_document_value(after, id);
    if (fabs(old - now) > 1e-9 * fabs(old)) {
      g_autofree char *one = sb_quantity_round(old, param->si, param->unit, 6);
      g_autofree char *other = sb_quantity_round(now, param->si, param->unit, 6);
      g_string_append_printf(lines, "%s: %s → %s\n", param->key, one, other);
    }
  }
  return g_string_free(lines, FALSE);
}
