// Housing and stem of the section.
#include "app/base/own_model.h"
#include "app/section/cutaway.h"
#include "app/section/section_private.h"

#include <math.h>
#include <string.h>

SbSectionFrameMap sb_section_frame_map(double x0, double y0, double scale, const SbRect *rect) {
  enum { BEYOND = 20 };
  double left = (double)rect->x - BEYOND, top = (double)rect->y - BEYOND;
  return (SbSectionFrameMap){x0,
                             y0,
                             scale,
                             left,
                             top,
                             left + (double)rect->width + 2 * BEYOND,
                             top + (double)rect->height + 2 * BEYOND};
}

// Points that clipping a solid against four edges can make.
enum { CLIPPED_MAX = SB_VALVE_POINTS_MAX + 16 };

// Keeps what of a polygon lies on one side of a pixel's column (or row). Returns the new count.
static size_t clip(SbPoint *points, size_t count, bool row, double limit, double side) {
  SbPoint from[CLIPPED_MAX];
  size_t n = 0;
  memcpy(from, points, count * sizeof *from);
  for (size_t i = 0; i < count; i++) {
    SbPoint a = from[i], b = from[(i + 1) % count];
    double da = side * ((double)(row ? a.y : a.x) - limit);
    double db = side * ((double)(row ? b.y : b.x) - limit);
    if (da >= 0 && n < CLIPPED_MAX) {
      points[n++] = a;
    }
    if ((da >= 0) != (db >= 0) && n < CLIPPED_MAX) {
      float f = (da / (da - db));
      points[n++] = (SbPoint){a.x + f * (b.x - a.x), a.y + f * (b.y - a.y)};
    }
  }
  return n;
}

// Fills a polygon shifted by -dx, clipped. Returns its points, which are the caller's, and their
// count; NULL where nothing is left.
static SbPoint *fill(SbSection *section, const SbSectionFrameMap *map, const SbValvePoint *point,
                     size_t *count, double dx, SbColor color, const SbDrawHatch *lines) {
  g_autofree SbPoint *pixel = g_new(SbPoint, CLIPPED_MAX);
  size_t n = *count;
  for (size_t i = 0; i < n; i++) {
    const SbValvePoint *at = &point[i];
    pixel[i] = (SbPoint){(map->x0 + (at->x - dx) * map->scale), (map->y0 - at->y * map->scale)};
  }
  n = clip(pixel, n, false, map->left, 1);
  n = clip(pixel, n, false, map->right, -1);
  n = clip(pixel, n, true, map->top, 1);
  n = clip(pixel, n, true, map->bottom, -1);
  *count = n;
  if (n < 3) {
    return NULL;
  }
  SbDrawItem *item = sb_draw_fill(section->list, pixel, n, color);
  if (lines != NULL) {
    item->hatch = *lines;
  }
  item->feather = false;
  return g_steal_pointer(&pixel);
}

// Fills and outlines a part. Edges on the axis are no edges.
static void draw_part(SbSection *section, const SbSectionFrameMap *map, const SbValvePoint *point,
                      size_t n, double dx, SbColor color, const SbDrawHatch *lines) {
  g_autofree SbPoint *pixel = fill(section, map, point, &n, dx, color, lines);
  if (pixel == NULL) {
    return;
  }
  float axis = map->y0;
  size_t start = 0;
  bool closed = true;
  for (size_t i = 0; i < n; i++) {
    if (pixel[i].y == axis && pixel[(i + 1) % n].y == axis) {
      start = (i + 1) % n;
      closed = false;
    }
  }
  g_autofree SbPoint *line = g_new(SbPoint, n);
  for (size_t i = 0; i < n; i++) {
    line[i] = pixel[(start + i) % n];
  }
  sb_draw_stroke(section->list, line, n, 1.8, section->palette->outline)->closed = closed;
}

static SbDrawHatch hatch(SbColor color, double lean, double offset) {
  return sb_draw_hatch(color, SB_HATCH_PITCH, SB_HATCH_WIDTH, lean, offset);
}

// Above a housing of known shape nothing is known: no fluid, no wall.
static void draw_outside(SbSection *section, const SbSectionFrameMap *map) {
  const SbOutlineSurface *surface = &section->valve.housing;
  g_autofree SbPoint *pixel = g_new(SbPoint, 2 * SB_OUTLINE_MAX + 2);
  size_t n = 0;
  for (size_t i = 0; i < surface->count; i++) {
    for (int side = 0; side < 2; side++) {
      double high = side == 0 ? surface->high_left[i] : surface->high_right[i];
      if (high >= 0) {
        float y = MAX((map->y0 - high * map->scale), map->top);
        pixel[n++] = (SbPoint){(map->x0 + surface->x[i] * map->scale), y};
      }
    }
  }
  if (n > 1) {
    pixel[n] = (SbPoint){pixel[n - 1].x, map->top};
    pixel[n + 1] = (SbPoint){pixel[0].x, map->top};
    sb_draw_fill(section->list, pixel, n + 2, section->palette->panel)->feather = false;
  }
}

// What stands behind the gaskets, in their pockets: the lower of their two pressures.
static void draw_pockets(SbSection *section, const SbSectionFrameMap *map) {
  const SbValveOutline *valve = &section->valve;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const SbSealFrame *seal = &section->instant->frame->seal[i];
    const double left = valve->groove_left[i], right = valve->groove_right[i];
    const double low = (valve->rim + valve->bore) / 2;
    const SbValvePoint room[] = {
        {left, low}, {right, low}, {right, valve->rim}, {left, valve->rim}};
    size_t n = G_N_ELEMENTS(room);
    const double pressure = (double)MIN(seal->pressure_left, seal->pressure_right);
    g_free(fill(section, map, room, &n, 0, sb_palette_fluid(section->palette, pressure), NULL));
  }
}

// Rooms, can, ferrule and cage around a gasket valve's body, and its spring.
static void draw_around(SbSection *section, const SbSectionFrameMap *map) {
  const SbValveOutline *valve = &section->valve;
  const SbPalette *palette = section->palette;
  const SbSealFrame *seal = section->instant->frame->seal;
  const SbDrawHatch lines = hatch(palette->housing_hatch, 1, map->x0 + map->y0);
  const SbColor color[] = {
      [SB_VALVE_CANISTER] = sb_palette_fluid(palette, (double)seal[SB_INNER].pressure_left),
      [SB_VALVE_AMBIENT] = sb_palette_fluid(palette, (double)seal[SB_OUTER].pressure_right),
      [SB_VALVE_SHEET] = palette->stem,
      [SB_VALVE_RUBBER] = sb_color_mix(palette->panel, palette->seal[SB_OUTER], 0.5),
      [SB_VALVE_PLASTIC] = palette->housing};
  for (size_t i = 0; i < valve->around_count; i++) {
    const SbValveAround *part = &valve->around[i];
    size_t n = part->count;
    if (part->material < SB_VALVE_SHEET) {
      g_free(fill(section, map, part->point, &n, 0, color[part->material], NULL));
    } else {
      draw_part(section, map, part->point, n, 0, color[part->material],
                part->material == SB_VALVE_PLASTIC ? &lines : NULL);
    }
  }
  // Coils apart by what room there is.
  enum { ROUND = 24 };
  const double first = valve->spring_seat + valve->coil / 2;
  const double last = valve->nose - sb_section_displacement(section) - valve->coil / 2;
  for (int i = 0; i < SB_VALVE_COILS && sb_model_has_spring(section->model); i++) {
    SbValvePoint coil[ROUND];
    for (int k = 0; k < ROUND; k++) {
      const double angle = 2 * G_PI * k / ROUND;
      coil[k].x = first + (last - first) * i / (SB_VALVE_COILS - 1) + valve->coil / 2 * cos(angle);
      coil[k].y = valve->spring_radius + valve->coil / 2 * sin(angle);
    }
    draw_part(section, map, coil, ROUND, 0, palette->stem, NULL);
  }
}

void sb_section_draw_housing(SbSection *section, const SbSectionFrameMap *map) {
  const SbValveOutline *valve = &section->valve;
  if (valve->gasket) {
    draw_around(section, map);
    draw_pockets(section, map);
  }
  if (valve->shaped_housing) {
    draw_outside(section, map);
  }
  SbDrawHatch lines = hatch(section->palette->housing_hatch, 1, map->x0 + map->y0);
  for (size_t i = 0; i < valve->solid_count; i++) {
    if (!valve->solid[i].moves) {
      draw_part(section, map, valve->solid[i].point, valve->solid[i].count, 0,
                section->palette->housing, &lines);
    }
  }
}

void sb_section_draw_stem(SbSection *section, const SbSectionFrameMap *map) {
  const SbValveOutline *valve = &section->valve;
  double s = sb_section_displacement(section);
  SbDrawHatch lines = hatch(section->palette->stem_hatch, -1, map->x0 - s * map->scale - map->y0);
  for (size_t i = 0; i < valve->solid_count; i++) {
    if (valve->solid[i].moves) {
      draw_part(section, map, valve->solid[i].point, valve->solid[i].count, s,
                section->palette->stem, &lines);
    }
  }
}
