// The section's layout, its rings and its parts in order, back to front. Labels of the strip are in
// section_labels.c, the insets in section_insets.c, the legends in section_frame.c, rings in
// section_ring.c, the valve in three dimensions in cutaway.c.
#include "app/base/own_model.h"
#include "app/section/cutaway.h"
#include "app/section/section_private.h"

#include <glib/gi18n.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Room beside the valve [m per m of bore diameter].
static const double RIGHT_ROOM = 0.26;

SbSection *sb_section_create(const SbModel *model, const SbSectionLimits *limits) {
  SbSection *section = g_new0(SbSection, 1);
  section->model = sb_own_model(model);
  section->limits = *limits;
  section->text = sb_text_create();
  double top = 2 * sb_model_value(model, SB_P_BORE_DIAMETER);
  sb_valve_outline_make(&section->valve, model, limits->inner_contact_left, top, true);
  return section;
}

void sb_section_destroy(SbSection *section) {
  if (section == NULL) {
    return;
  }
  sb_text_destroy(section->text);
  g_free(section->scratch);
  g_free(section->scratch_scalar);
  sb_cutaway_destroy(section->cutaway);
  sb_model_destroy(section->model);
  g_free(section);
}

void sb_section_limits_of_frames(SbSectionLimits *limits, const SbFrame *frames, size_t count) {
  *limits = (SbSectionLimits){0};
  bool inner_found = false;
  for (size_t i = 0; i < count; i++) {
    limits->force_max =
        fmax(limits->force_max, fmax(fabs(frames[i].force), fabs(frames[i].pressure_force)));
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      const SbSealFrame *at = &frames[i].seal[seal];
      limits->pressure_max = fmax(limits->pressure_max, at->pressure_peak);
      limits->film_max = fmax(limits->film_max, at->film_central);
      limits->contact_left[seal] = fmin(limits->contact_left[seal], at->contact_left);
      limits->contact_right[seal] = fmax(limits->contact_right[seal], at->contact_right);
    }
    // The inner contact as it reaches the land edge: the last whole one before it.
    const SbSealFrame *inner = &frames[i].seal[SB_INNER];
    if (frames[i].stage <= SB_STAGE_B && inner->land_fraction >= 1 &&
        inner->contact_right > inner->contact_left) {
      limits->inner_contact_left = inner->contact_left;
      inner_found = true;
    }
  }
  if (!inner_found && count > 0) {
    limits->inner_contact_left = frames[0].seal[SB_INNER].contact_left;
  }
}

static int ascending(const void *a, const void *b) {
  float x = *(const float *)a;
  float y = *(const float *)b;
  return (x > y) - (x < y);
}

void sb_section_limits_add_shape(SbSectionLimits *limits, const SbSealShape *shape) {
  if (shape == NULL) {
    return;
  }
  g_autofree float *sorted = g_new(float, shape->nodes);
  for (int field = 0; field < SB_FIELD_COUNT; field++) {
    memcpy(sorted, shape->field[field], shape->nodes * sizeof *sorted);
    qsort(sorted, shape->nodes, sizeof *sorted, ascending);
    limits->field_min[field] = fmin(limits->field_min[field], sorted[shape->nodes / 50]);
    limits->field_max[field] =
        fmax(limits->field_max[field], sorted[shape->nodes - 1 - shape->nodes / 50]);
  }
}

void sb_section_limits_add_run(SbSectionLimits *limits, const SbRun *run) {
  for (uint32_t i = 0; i < SB_RUN_SHAPES_MAX; i++) {
    sb_section_limits_add_shape(limits, sb_run_shape(run, i));
  }
}

const char *sb_section_field_name(SbField field) {
  static const char *const names[SB_FIELD_COUNT] = {
      N_("von Mises stress"), N_("hydrostatic pressure"), N_("shear stress"),
      N_("contact pressure"), N_("displacement"),         N_("permeation flux over P Δp")};
  return names[field];
}

const char *sb_section_field_unit(SbField field) {
  return field == SB_FIELD_DISPLACEMENT ? "mm" : field == SB_FIELD_PERMEATION ? "1/mm" : "MPa";
}

double sb_section_field_scale(SbField field) {
  return field == SB_FIELD_DISPLACEMENT ? 1e3 : field == SB_FIELD_PERMEATION ? 1e-3 : 1e-6;
}

SbPoint sb_section_at(const SbSection *section, double x, double y) {
  return (SbPoint){(section->x0 + x * section->scale), (section->y0 - y * section->scale)};
}

double sb_section_displacement(const SbSection *section) {
  return section->instant->frame->displacement;
}

double sb_section_origin(const SbSection *section, int seal) {
  const SbValveOutline *valve = &section->valve;
  return valve->origin[seal] - (valve->gasket ? 0 : sb_section_displacement(section));
}

const SbRingShape *sb_section_ring(const SbSection *section, int seal) {
  return &section->ring[seal];
}

const SbValveOutline *sb_section_valve(const SbSection *section) {
  return &section->valve;
}

void sb_section_transform(const SbSection *section, double *scale, double *x0, double *y0) {
  *scale = section->scale;
  *x0 = section->x0;
  *y0 = section->y0;
}

typedef struct {
  const SbValveOutline *valve;
  double origin;
} Surroundings;

static double housing_above(void *data, double x) {
  const Surroundings *around = data;
  return sb_valve_outline_bore(around->valve, x + around->origin) - around->valve->floor;
}

// Outlines of both rings in their own frames.
static void shape_rings(SbSection *section) {
  const SbValveOutline *valve = &section->valve;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const SbSealFrame *seal = &section->instant->frame->seal[i];
    Surroundings around = {valve, sb_section_origin(section, i)};
    SbRingRoom room = {
        .space = valve->bore - valve->floor,
        .wall_left = valve->groove_left[i] - valve->origin[i],
        .wall_right = valve->groove_right[i] - valve->origin[i],
        .area = valve->section_area[i],
        .section = 2 * sqrt(valve->section_area[i] / M_PI),
        .housing = housing_above,
        .data = &around,
    };
    if (valve->gasket) { // drawn so only where none is solved
      sb_ring_shape_rectangle(&section->ring[i], room.wall_left, room.wall_right,
                              room.area / (room.wall_right - room.wall_left));
      section->ring[i].contact_left = seal->contact_left;
      section->ring[i].contact_right = seal->contact_right;
      continue;
    }
    double edge = -around.origin;
    double left = fmax(seal->contact_left, fmin(edge, seal->contact_right));
    sb_ring_shape_make(&section->ring[i], &room, left, seal->contact_right, seal->land_fraction);
    // Bars and labels follow the contact that is drawn.
    const SbSealShape *solved = section->instant->ring[i];
    if (solved != NULL) {
      section->ring[i].contact_left = fmax(solved->contact_left, edge);
      section->ring[i].contact_right = fmax(solved->contact_right, edge);
    }
  }
}

// Fluid behind everything: tinted by pressure, changing at the sealing contacts.
static void draw_fluid(SbSection *section) {
  const SbFrame *frame = section->instant->frame;
  const SbRect *strip = &section->strip;
  const SbSealFrame *inner = &frame->seal[SB_INNER];
  const SbSealFrame *outer = &frame->seal[SB_OUTER];
  double split_inner = sb_section_at(section,
                                     sb_section_origin(section, SB_INNER) +
                                         (inner->contact_left + inner->contact_right) / 2,
                                     0)
                           .x;
  double split_outer = sb_section_at(section,
                                     sb_section_origin(section, SB_OUTER) +
                                         (outer->contact_left + outer->contact_right) / 2,
                                     0)
                           .x;
  double right = strip->x + strip->width;
  const double edge[4] = {strip->x, CLAMP(split_inner, strip->x, right),
                          CLAMP(split_outer, strip->x, right), right};
  const double pressure[3] = {inner->pressure_left, outer->pressure_left, outer->pressure_right};
  for (int i = 0; i < 3; i++) {
    if (edge[i + 1] > edge[i]) {
      sb_draw_rect(section->list, edge[i], strip->y, edge[i + 1] - edge[i], strip->height,
                   sb_palette_fluid(section->palette, pressure[i]))
          ->feather = false;
    }
  }
}

static bool shows_both_halves(const SbSectionView *view) {
  return view->full && view->zoom == SB_SECTION_WHOLE;
}

// Draws the strip: housing, stem, fluid and rings.
static void draw_strip(SbSection *section) {
  const SbPalette *palette = section->palette;
  SbDrawList *list = section->list;
  const SbFrame *frame = section->instant->frame;
  sb_draw_clip(list, &section->strip);
  draw_fluid(section);
  size_t first = list->item_count;
  const SbRect *strip = &section->strip;
  SbSectionFrameMap map = sb_section_frame_map(section->x0, section->y0, section->scale, strip);
  sb_section_draw_housing(section, &map);
  sb_section_draw_stem(section, &map);

  // Rings, and the contact bars over exactly the engine's contact.
  double bore = section->valve.bore;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    SbPoint origin = sb_section_at(section, sb_section_origin(section, i), section->valve.floor);
    const SbSectionPlane plane = {origin.x, section->scale, 0, origin.y, 0, -section->scale};
    sb_section_draw_ring(section, i, &plane);
    const SbRingShape *ring = &section->ring[i];
    if (frame->seal[i].land_fraction > 0 && ring->contact_right > ring->contact_left) {
      double left = sb_section_origin(section, i) + ring->contact_left;
      double right = sb_section_origin(section, i) + ring->contact_right;
      SbPoint a = sb_section_at(section, left, bore);
      SbPoint b = sb_section_at(section, right, bore);
      sb_draw_line(list, a.x, a.y, b.x, b.y, 4, palette->seal[i]);
    }
  }
  if (shows_both_halves(section->view)) {
    sb_draw_reflect(list, first, section->y0);
  }
  if (section->view->zoom == SB_SECTION_WHOLE) {
    double y = section->y0 - 0.5;
    sb_draw_line(list, section->strip.x, y, section->strip.x + section->strip.width, y, 1,
                 palette->outline)
        ->dash = &sb_dash_centre;
  }
  sb_draw_clip(list, NULL);
}

// Where strip and insets go. The strip takes the width; what its height leaves goes to the insets.
// A wide picture has its title and legends in a column on the left of the insets, a narrow one in a
// row above them.
typedef struct {
  double margin, top, legend_width, inset_top, inset_height;
  bool insets, column, stacked;
} Layout;

static const double COLUMN_LEAST = 860, LEGENDS = 232, COLUMN_GAP = 48, SCALE_ROW = 34,
                    STACK_GAP = 46;

// The cutaway has the panel for itself.
static void lay_out_cutaway(SbSection *section, const Layout *layout, double bottom) {
  const SbSectionView *view = section->view;
  double left = layout->margin + (layout->column ? LEGENDS + COLUMN_GAP / 2 : 0);
  double top = layout->top + (layout->column ? 0 : 66);
  section->strip =
      (SbRect){left, top, fmax(view->width - layout->margin - left, 1), fmax(bottom - top, 1)};
}

// One seal's surroundings, from below the groove floor to above the land.
static void lay_out_zoom(SbSection *section, const Layout *layout, double bottom) {
  const SbSectionView *view = section->view;
  const SbValveOutline *valve = &section->valve;
  int seal = view->zoom == SB_SECTION_ZOOM_INNER ? SB_INNER : SB_OUTER;
  double left = view->bare ? 0 : layout->margin + (layout->column ? LEGENDS + COLUMN_GAP : 0);
  double top = view->bare ? 0 : layout->top + (layout->column ? 0 : 66);
  bottom = view->bare ? view->height : bottom;
  double width = view->bare ? view->width : view->width - layout->margin - left;
  double tall = bottom - top;
  section->strip = (SbRect){left, top, width, tall};
  const bool gasket = valve->gasket;
  double g =
      sb_model_value(section->model, gasket ? SB_P_GASKET_THICKNESS : SB_P_GLAND_RADIAL_SPACE);
  section->scale = MIN(width / (2.6 * g), tall / (1.85 * g));
  double centre = sb_section_origin(section, seal);
  section->x0 = left + width / 2 - centre * section->scale;
  section->y0 = bottom - tall * 0.56 + (valve->floor + g / 2) * section->scale;
}

// The strip fills the picture, its top cut where it is too high to be wide.
static void lay_out_bare(SbSection *section, double left, double right, double left_room) {
  const SbSectionView *view = section->view;
  const double bore = section->valve.size;
  static const double LEAST = 0.66; // of the bore's diameter: the housing over the seals
  const double scale =
      fmin((view->width - left_room) / (right - left), view->height / (LEAST * bore));
  section->scale = fmax(scale, 1);
  section->strip = (SbRect){0, 0, view->width, view->height};
  const double used = (right - left) * section->scale + left_room;
  section->x0 = (view->width - used) / 2 + left_room - left * section->scale;
  section->y0 = view->height - 1;
}

static void lay_out(SbSection *section, Layout *layout) {
  const SbSectionView *view = section->view;
  const SbValveOutline *valve = &section->valve;
  const SbModel *model = section->model;
  double margin = view->margin;
  layout->margin = margin;
  layout->top = margin;
  layout->column = view->width - 2 * margin >= COLUMN_LEAST;
  layout->legend_width = layout->column ? LEGENDS : MIN(LEGENDS, view->width / 2 - margin - 12);
  double bottom = view->height - margin - SCALE_ROW + 8;
  if (view->cutaway) {
    lay_out_cutaway(section, layout, bottom);
    return;
  }
  if (view->zoom != SB_SECTION_WHOLE) {
    lay_out_zoom(section, layout, bottom);
    return;
  }

  // Room on the left for the pressure arrow at full stroke, on the right for the ambient.
  double strip_width = view->width - 2 * margin;
  double left_room = valve->gasket ? 0 : 3.4 * fabs(sb_model_pressure_force(model)) + 18;
  double left = valve->gasket
                    ? valve->left
                    : MIN(valve->nose - sb_model_value(model, SB_P_DRIVE_STROKE), valve->face);
  double bore = valve->size;
  double right = valve->end + RIGHT_ROOM * bore;
  if (view->bare) {
    lay_out_bare(section, left, right, left_room);
    return;
  }
  double scale = (strip_width - left_room) / (right - left);
  double radius = SB_SECTION_TOP * bore * (view->full ? 2 : 1);
  // A low picture gives the insets at least 130 px of the strip's height, then none. A high narrow
  // one stacks them, and what it cannot use stays free below.
  double titles = layout->column ? 22 : 82, gap = 30;
  double room = bottom - layout->top;
  layout->insets = !view->hide_insets && room >= 330;
  if (layout->insets) {
    scale = MIN(scale, (room - gap - titles - 130) / radius);
    double height = room - radius * scale - gap - titles;
    double most = 0.62 * strip_width;
    layout->stacked = !layout->column && height > 1.2 * most;
    layout->inset_height = layout->stacked ? MIN((height - STACK_GAP) / 2, most)
                                           : MIN(height, layout->column ? 320 : most);
    double used = layout->stacked ? 2 * layout->inset_height + STACK_GAP : layout->inset_height;
    bottom -= layout->column ? 0 : height - used;
  } else {
    scale = MAX(MIN(scale, (room - (layout->column ? 100 : titles)) / radius), 1 / radius);
  }
  layout->inset_top = layout->top + titles;
  section->scale = scale;
  section->strip = (SbRect){margin, (bottom - radius * scale), strip_width, (radius * scale)};
  double used = (right - left) * scale + left_room;
  section->x0 = margin + (strip_width - used) / 2 + left_room - left * scale;
  section->y0 = view->full ? bottom - radius * scale / 2 : bottom;
}

double sb_section_strip_height(SbSection *section, const SbSectionView *view,
                               const SbSectionInstant *instant) {
  Layout layout = {0};
  section->view = view;
  section->instant = instant;
  lay_out(section, &layout);
  return (double)section->strip.height;
}

void sb_section_draw(SbSection *section, SbDrawList *list, const SbSectionView *view,
                     const SbSectionInstant *instant) {
  section->list = list;
  section->view = view;
  section->instant = instant;
  section->palette = sb_palette(view->dark);
  section->placed_count = 0;
  sb_draw_list_clear(list, view->width, view->height, section->palette->panel);

  Layout layout = {0};
  lay_out(section, &layout);
  shape_rings(section);
  if (view->cutaway) {
    if (section->cutaway == NULL) {
      section->cutaway = sb_cutaway_create(section->model, section->limits.inner_contact_left);
    }
    sb_cutaway_draw(section->cutaway, section);
    sb_section_draw_legends(section, layout.margin, layout.top, layout.legend_width);
    section->list = NULL;
    return;
  }
  draw_strip(section);
  double x = layout.margin + (layout.column ? layout.legend_width + COLUMN_GAP : 0);
  double gap = 24;
  double width = view->width - layout.margin - x;
  double each = layout.stacked ? width : (width - gap) / 2;
  SbRect pressure = {x, layout.inset_top, each, layout.inset_height};
  SbRect film = pressure;
  if (layout.stacked) {
    film.y += (layout.inset_height + STACK_GAP);
  } else {
    film.x += (each + gap);
  }
  // The leader goes below the labels, which keep off it.
  if (layout.insets) {
    sb_section_draw_leader(section, &pressure, &film);
  }
  sb_section_draw_strip_labels(section);
  if (!view->bare) {
    sb_section_draw_legends(section, layout.margin, layout.top, layout.legend_width);
  }
  if (layout.insets) {
    sb_section_draw_insets(section, &pressure, &film);
  }
  section->list = NULL;
}
