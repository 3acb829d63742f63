// Beside the section: its title, the legends of its colours, the balance of forces.
#include "app/section/section_private.h"

#include "app/base/device.h"
#include "app/base/format.h"
#include "app/base/translation.h"
#include "app/chart/data.h"
#include "app/draw/axis.h"
#include "app/draw/theme.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// One bar of a colour map with its ticks.
static double legend(SbSection *section, double x, double y, double width, const char *name,
                     const char *unit, const SbDrawMap *map, double min, double max) {
  const SbPalette *palette = section->palette;
  SbDrawList *list = section->list;
  sb_draw_text(list, x, y, 12, 600, SB_LEFT, palette->ink, name);
  double name_width = sb_text_width(section->text, name, 12, 600);
  // Where there is no room for all of it, the unit alone.
  char written[64];
  g_strlcpy(written, unit, sizeof written);
  char *comment = strchr(written, ',');
  if (comment != NULL && name_width + 7 + sb_text_width(section->text, unit, 12, 400) > width) {
    *comment = '\0';
  }
  sb_draw_text(list, x + name_width + 7, y, 12, 400, SB_LEFT, palette->second, written);
  float x0 = x, x1 = (x + width), y0 = (y + 9), y1 = (y + 21);
  const SbPoint corner[6] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y0}, {x1, y1}, {x0, y1}};
  const float scalar[6] = {0.0, 1.0, 1.0, 0.0, 1.0, 0.0};
  sb_draw_mesh(list, corner, scalar, 6, map, 0, 1);
  const SbPoint frame[4] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  sb_draw_stroke(list, frame, 4, 1, palette->axis)->closed = true;
  if (!(max > min)) { // one value everywhere, or none known
    return 62;
  }
  const SbScale scale = {min, max, x, x + width, false};
  char text[SB_FORMAT_MAX];
  SbTicks ticks;
  // Signed numbers on a short bar need a coarser step.
  for (int wanted = 5; wanted > 1; wanted--) {
    sb_axis_ticks(&ticks, min, max, wanted);
    sb_axis_text(text, &ticks, ticks.value[min < 0 ? 0 : ticks.count - 1]);
    if (sb_text_width(section->text, text, 11, 400) + 6 < ticks.step / (max - min) * width) {
      break;
    }
  }
  for (int i = 0; i < ticks.count; i++) {
    const double tick = sb_axis_at(&scale, ticks.value[i]);
    sb_axis_text(text, &ticks, ticks.value[i]);
    sb_draw_line(list, tick, y1 + 1, tick, y1 + 5, 1, palette->axis);
    sb_draw_text(list, tick, y1 + 17, 11, 400, SB_MIDDLE, palette->second, text);
  }
  return 62;
}

// The forces on the stem as lengths on one scale, where they fit above `low`.
static void force_bars(SbSection *section, double x, double y, double width, double low) {
  const SbPalette *palette = section->palette;
  SbDrawList *list = section->list;
  const SbFrame *frame = section->instant->frame;
  SbChartForce row[SB_CHART_FORCES_MAX];
  const size_t rows = sb_chart_forces(row, section->model, frame);
  if (y + 12 + 17 * (double)rows >= low) {
    return;
  }
  const char *title = _("forces on the stem");
  sb_draw_text(list, x, y, 12, 600, SB_LEFT, palette->ink, title);
  sb_draw_text(list, x + sb_text_width(section->text, title, 12, 600) + 7, y, 12, 400, SB_LEFT,
               palette->second, "N");
  double zero = x + 106;
  double px = (x + width - 44 - zero) / fmax(section->limits.force_max, 36);
  for (size_t i = 0; i < rows; i++) {
    double base = y + 19 + 17 * (double)i;
    char text[SB_SECTION_NUMBER];
    sb_draw_text(list, x, base, 11, 400, SB_LEFT, palette->second, row[i].name);
    double length = fabs(row[i].force) * px;
    if (length > 0.5) {
      sb_draw_rect(list, zero, base - 8, length, 8, sb_theme(palette->dark)->role[row[i].role]);
    }
    sb_section_fixed(text, row[i].force, 1);
    sb_draw_text(list, zero + length + 6, base, 11, 600, SB_LEFT, palette->ink, text);
  }
  sb_draw_line(list, zero - 0.5, y + 8, zero - 0.5, y + 8 + 17 * (double)rows, 1, palette->axis);
}

// Title of the panel, or the frame's read-outs in its place. At most 44 px high.
static void draw_title(SbSection *section, double x, double y) {
  const SbPalette *palette = section->palette;
  const SbFrame *frame = section->instant->frame;
  SbDrawList *list = section->list;
  char text[160], time[SB_SECTION_NUMBER];
  sb_section_fixed(time, frame->time, 2);
  if (!section->view->read_outs) {
    sb_draw_text(list, x, y + 14, SB_TYPE_PANEL, 700, SB_LEFT, palette->ink,
                 section->view->cutaway ? _("Cutaway") : _("Axial section"));
    snprintf(text, sizeof text, _("stem and seals at %s s, housing at rest"), time);
    sb_draw_text(list, x, y + 34, 12, 400, SB_LEFT, palette->second, text);
    return;
  }
  const char *span = sb_chart_span(NULL, frame->stage);
  sb_draw_text(list, x, y + 20, 26, 700, SB_LEFT, palette->now, span);
  double width = sb_text_width(section->text, span, 26, 700);
  static const char *const rings[SB_STAGE_COUNT] = {
      [SB_STAGE_A] = N_("force builds up"),      [SB_STAGE_B] = N_("both seals slide"),
      [SB_STAGE_C] = N_("chamber open"),         [SB_STAGE_D] = N_("at the stop"),
      [SB_STAGE_E] = N_("return, chamber open"), [SB_STAGE_F] = N_("both seals slide back"),
  };
  const int stage = MIN(frame->stage, SB_STAGE_COUNT - 1);
  const char *phase = sb_device(section->model)->phase[stage];
  sb_draw_text(list, x + width + 10, y + 20, 13, 600, SB_LEFT, palette->now,
               _(phase != NULL ? phase : rings[stage]));
  char stroke[SB_SECTION_NUMBER], force[SB_SECTION_NUMBER];
  snprintf(text, sizeof text, "%s s    %s    %s", time,
           sb_section_millimetre(stroke, frame->displacement),
           sb_section_force(force, frame->force));
  sb_draw_text(list, x, y + 42, 13, 600, SB_LEFT, palette->ink, text);
}

void sb_section_draw_legends(SbSection *section, double x, double y, double width) {
  const SbPalette *palette = section->palette;
  const SbSectionView *view = section->view;
  bool ring = section->instant->ring[SB_OUTER] != NULL || section->instant->ring[SB_INNER] != NULL;
  const char *name = sb_translation(sb_section_field_name(view->field));
  const char *unit = sb_section_field_unit(view->field);
  double least, most;
  sb_section_field_limits(section, view->field, &least, &most);
  least *= sb_section_field_scale(view->field);
  most *= sb_section_field_scale(view->field);
  const SbDrawMap *map = view->field == SB_FIELD_SHEAR ? &palette->diverging : &palette->field;
  bool column = view->width - 2 * x >= 860;
  bool zoom = view->cutaway || view->zoom != SB_SECTION_WHOLE;
  double low = zoom ? view->height - x : (double)section->strip.y - 10;
  draw_title(section, x, y);
  double fluid_full = SB_PALETTE_FLUID_FULL * 1e-6;
  if (!column) {
    // A row right of the title, as far as there is room.
    double right = view->width - x, left = x + 260;
    double each = MIN(width, 200);
    if (ring) {
      each = MIN(each, MAX((right - left - 24) / 2, 120));
    }
    if (right - each >= left) {
      legend(section, right - each, y + 8, each, _("fluid pressure"), _("MPa, gauge"),
             &palette->fluid, 0, fluid_full);
    }
    if (ring && right - 2 * each - 24 >= left) {
      legend(section, right - 2 * each - 24, y + 8, each, name, unit, map, least, most);
    }
    return;
  }
  double at = y + 68;
  if (ring) {
    at += legend(section, x, at, width, name, unit, map, least, most);
  }
  at += legend(section, x, at, width, _("fluid pressure"), _("MPa, gauge"), &palette->fluid, 0,
               fluid_full);
  if (!view->hide_forces) {
    force_bars(section, x, at + 4, width, low);
  }
}
