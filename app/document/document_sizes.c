// Masses and sizes that the shape of a part gives, against those of the file; see document_parts.c.
#include "app/document/document_parts_private.h"

#include "app/base/unit.h"
#include "engine/mechanism/solid.h"

#include <math.h>
#include <string.h>

static bool differs(const SbPart *part, SbParamId id, double value) {
  double given = part->params->value[id];
  return fabs(given - value) > SB_SHAPE_ROUNDING * fabs(given);
}

static void keep_size(GPtrArray *list, const SbPart *part, SbParamId id, double value,
                      const char *source) {
  SbShapeSize *size = g_new(SbShapeSize, 1);
  *size = (SbShapeSize){id, value, part->base == NULL,
                        g_strdup_printf("the %s of [%s]", source, part->group)};
  g_ptr_array_add(list, size);
}

void sb_part_derive_mass(const SbPart *part, SbParamId id, double value, const char *source) {
  const SbParam *param = sb_param(id);
  keep_size(part->shapes->masses, part, id, value, source);
  if (!part->params->given[id]) {
    sb_part_set(part, id, value, source);
  } else if (differs(part, id, value)) {
    g_autofree char *says = sb_quantity_format(part->params->value[id], param->si, param->unit);
    g_autofree char *other = sb_quantity_round(value, param->si, param->unit, 5);
    sb_issues_add(part->notes, part->shown, 0, param->key, NULL,
                  "%s: %s = %s applies; the %s of [%s] results in %s", part->shown, param->key,
                  says, source, part->group, other);
  }
}

// A size: the shape takes precedence.
static void derive_size(const SbPart *part, SbParamId id, double value, const char *source) {
  const SbParam *param = sb_param(id);
  if (!part->params->given[id]) {
    sb_part_set(part, id, value, source);
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
static bool read_stretch(const SbPart *part, const char *name, double *from, double *to) {
  const SbEntry *entry = sb_part_find(part, name);
  if (entry == NULL) {
    return false;
  }
  g_auto(GStrv) ends = g_strsplit(entry->value, "..", 2);
  if (g_strv_length(ends) != 2) {
    sb_part_complain(part, name, "3 mm .. 5 mm", "is not a stretch of the profile");
    return false;
  }
  *from = sb_part_quantity(part, name, g_strstrip(ends[0]), "m", "mm");
  *to = isnan(*from) ? NAN : sb_part_quantity(part, name, g_strstrip(ends[1]), "m", "mm");
  return !isnan(*to);
}

// Value in force for what is derived next.
static double in_force(const SbPart *part, SbParamId id) {
  bool own = part->params->given[id] || part->base == NULL;
  return own ? part->params->value[id] : part->base->value[id];
}

// The bore land about the stretch, the mouth ahead of it, and where both lie.
static void derive_land(const SbPart *part, double diameter, double from) {
  SbShapes *shapes = part->shapes;
  const SbOutline *outline = &shapes->outlines.part[part->index];
  g_autofree SbOutlineSurface *s = g_new(SbOutlineSurface, 1);
  sb_outline_surface(s, outline);
  // To the left as long as the hole is not wider.
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
static void derive_groove(const SbPart *part, const SbProfile *profile, int seal,
                          const char *name) {
  double from, to;
  SbProfileDiameters found;
  SbReport report = {0};
  if (!read_stretch(part, name, &from, &to)) {
    return;
  }
  if (sb_profile_diameters(&found, profile, from, to, &report) != SB_OK) {
    sb_part_complain(part, name, NULL, "%s", report.text);
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
static void derive_chamber(const SbPart *part) {
  SbValveOutlines *outlines = &part->shapes->outlines;
  double left = outlines->groove_right[SB_INNER], right = outlines->groove_left[SB_OUTER];
  if (!(right > left)) {
    sb_part_complain(part, "inner_groove", NULL,
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

void sb_part_derive_sizes(const SbPart *part, const SbProfile *profile) {
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
      sb_part_complain(part, "bore", NULL, "%s", report.text);
    }
  }
  if (read_stretch(part, "land", &from, &to)) {
    if (sb_profile_diameters(&found, profile, from, to, &report) == SB_OK) {
      derive_size(part, SB_P_STEM_PRESSURE_DIAMETER, found.largest, "land");
      part->shapes->outlines.land = found.largest / 2;
    } else {
      sb_part_complain(part, "land", NULL, "%s", report.text);
    }
  }
  if (read_stretch(part, "groove", &from, &to)) {
    if (sb_profile_diameters(&found, profile, from, to, &report) == SB_OK) {
      double bore = in_force(part, SB_P_BORE_DIAMETER);
      derive_size(part, SB_P_GLAND_RADIAL_SPACE, (bore - found.smallest) / 2, "groove");
    } else {
      sb_part_complain(part, "groove", NULL, "%s", report.text);
    }
  }
  if (stem) {
    derive_groove(part, profile, SB_INNER, "inner_groove");
    derive_groove(part, profile, SB_OUTER, "outer_groove");
    SbShapes *shapes = part->shapes;
    if (sb_part_find(part, "inner_groove") != NULL && sb_part_find(part, "outer_groove") != NULL &&
        shapes->has_groove[SB_INNER] && shapes->has_groove[SB_OUTER]) {
      if (shapes->outlines.land == 0) {
        shapes->outlines.land = in_force(part, SB_P_STEM_PRESSURE_DIAMETER) / 2;
      }
      derive_chamber(part);
    }
  }
}
