// Around the section: title and read-outs, legends, footer with models, errors and warnings.
#include "app/section/section_private.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// What happens after each event.
static const char *const phase[SB_STAGE_COUNT] = {
    [SB_STAGE_A] = "force builds up",      [SB_STAGE_B] = "both seals slide",
    [SB_STAGE_C] = "chamber open",         [SB_STAGE_D] = "at the stop",
    [SB_STAGE_E] = "return, chamber open", [SB_STAGE_F] = "both seals slide back",
};

// What an event is; a frame on an event sits just before it.
static const char *const event[SB_STAGE_COUNT] = {
    [SB_STAGE_A] = "start",       [SB_STAGE_B] = "first slip",   [SB_STAGE_C] = "land edge reached",
    [SB_STAGE_D] = "at the stop", [SB_STAGE_E] = "reverse slip", [SB_STAGE_F] = "contact again",
};

// A value with its unit smaller behind it, right-aligned at x; a caption below. Returns the width.
static double read_out(SbSection *section, double x, double y, const char *value, const char *unit,
                       const char *caption, SbDrawColour value_colour, SbDrawColour caption_colour,
                       int caption_weight) {
  double size = 30;
  double unit_width = unit[0] != '\0' ? sb_text_width(section->text, unit, 0.6 * size, 400) : 0;
  double value_width = sb_text_width(section->text, value, size, 600);
  double gap = unit[0] != '\0' ? 6 : 0;
  sb_draw_text(section->list, x, y, 0.6 * size, 400, SB_ALIGN_RIGHT, section->palette->ink, unit);
  sb_draw_text(section->list, x - unit_width - gap, y, size, 600, SB_ALIGN_RIGHT, value_colour,
               value);
  sb_draw_text(section->list, x, y + 24, 12.5, caption_weight, SB_ALIGN_RIGHT, caption_colour,
               caption);
  double caption_width = sb_text_width(section->text, caption, 12.5, caption_weight);
  return fmax(value_width + gap + unit_width, caption_width);
}

void sb_section_draw_header(SbSection *section, double margin) {
  const SbPalette *palette = section->palette;
  const SbSectionView *view = section->view;
  const SbFrame *frame = section->instant->frame;
  double y = margin + 14;
  double right = view->width - margin;
  char number[SB_SECTION_NUMBER];

  // Columns of constant width, so that the figures stand still while they change.
  double column = view->width >= 1100 ? 128 : 104;
  sb_section_fixed(number, frame->force, fabs(frame->force) >= 100 ? 0 : 1);
  read_out(section, right, y, number, "N", "force on the stem", palette->ink, palette->second, 400);
  sb_section_fixed(number, frame->displacement * 1e3, 2);
  read_out(section, right - column, y, number, "mm", "stroke", palette->ink, palette->second, 400);
  sb_section_fixed(number, frame->time, 2);
  read_out(section, right - 2 * column, y, number, "s", "time", palette->ink, palette->second, 400);
  SbStage stage = (SbStage)MIN(frame->stage, SB_STAGE_COUNT - 1);
  SbStage next = (SbStage)((stage + 1) % SB_STAGE_COUNT);
  char letters[16];
  const char *caption = phase[stage];
  if (frame->on_event) {
    SbStage at = frame->time > 0 ? next : SB_STAGE_A;
    snprintf(letters, sizeof letters, "%s", sb_stage_name(at));
    caption = at == SB_STAGE_A && frame->time > 0 ? "back at rest" : event[at];
  } else {
    snprintf(letters, sizeof letters, "%s\xe2\x80\x93%s", sb_stage_name(stage),
             sb_stage_name(next));
  }
  double used = 3 * column;
  used += read_out(section, right - 3 * column, y, letters, "", caption, palette->now, palette->now,
                   600);

  double room = right - used - 24 - margin;
  if (view->title != NULL && sb_text_width(section->text, view->title, 28, 700) < room) {
    sb_draw_text(section->list, margin, y, 28, 700, SB_ALIGN_LEFT, palette->ink, view->title);
  } else if (view->title != NULL && sb_text_width(section->text, view->title, 17, 700) < room) {
    sb_draw_text(section->list, margin, y - 4, 17, 700, SB_ALIGN_LEFT, palette->ink, view->title);
  }
  if (view->subtitle != NULL && sb_text_width(section->text, view->subtitle, 13, 400) < room) {
    sb_draw_text(section->list, margin, y + 24, 13, 400, SB_ALIGN_LEFT, palette->second,
                 view->subtitle);
  }
}

// "Models  fit karaszkiewicz ..." with a bold head; false if it does not fit into `room`.
static bool headed_line(SbSection *section, double x, double y, const char *head, const char *body,
                        double room) {
  double width = sb_text_width(section->text, head, 12, 600);
  if (width + 6 + sb_text_width(section->text, body, 12, 400) > room) {
    return false;
  }
  sb_draw_text(section->list, x, y, 12, 600, SB_ALIGN_LEFT, section->palette->second, head);
  sb_draw_text(section->list, x + width + 6, y, 12, 400, SB_ALIGN_LEFT, section->palette->second,
               body);
  return true;
}

void sb_section_draw_footer(SbSection *section, double margin, double top) {
  const SbPalette *palette = section->palette;
  const SbSectionView *view = section->view;
  double right = view->width - margin;
  double first = top + 16, second = top + 34;
  double warning_room = view->width - 2 * margin;
  if (view->stamp != NULL) {
    sb_draw_text(section->list, right, second, 12, 400, SB_ALIGN_RIGHT, palette->third,
                 view->stamp);
  }
  double stamp = view->stamp != NULL ? sb_text_width(section->text, view->stamp, 12, 400) : 0;
  if (view->errors != NULL) {
    headed_line(section, margin, second, "Error estimates", view->errors,
                warning_room - stamp - 16);
  }
  double models = 0;
  if (view->models != NULL &&
      headed_line(section, margin, first, "Models", view->models, warning_room)) {
    models = sb_text_width(section->text, "Models", 12, 600) + 6 +
             sb_text_width(section->text, view->models, 12, 400);
  }
  if (view->warning == NULL || view->warning[0] == '\0') {
    return;
  }
  // As much of the warning as fits, cut at a word.
  double head = sb_text_width(section->text, "Warning", 12, 600) + 6;
  double room = warning_room - models - 24 - head;
  char text[SB_DRAW_TEXT_MAX];
  g_utf8_strncpy(text, view->warning, MIN(g_utf8_strlen(view->warning, -1), 120));
  bool cut = false;
  while (text[0] != '\0' && sb_text_width(section->text, text, 12, 400) + (cut ? 14 : 0) > room) {
    char *space = strrchr(text, ' ');
    *(space != NULL ? space : text) = '\0';
    cut = true;
  }
  if (text[0] == '\0') {
    return;
  }
  if (cut) {
    g_strlcat(text, " \xe2\x80\xa6", sizeof text);
  }
  double width = sb_text_width(section->text, text, 12, 400);
  sb_draw_text(section->list, right, first, 12, 400, SB_ALIGN_RIGHT, palette->warn, text);
  sb_draw_text(section->list, right - width - 6, first, 12, 600, SB_ALIGN_RIGHT, palette->warn,
               "Warning");
}

// One bar of a colour map with its ticks.
static double legend(SbSection *section, double x, double y, double width, const char *name,
                     const char *unit, const SbDrawMap *map, double min, double max) {
  const SbPalette *palette = section->palette;
  SbDrawList *list = section->list;
  sb_draw_text(list, x, y, 12, 600, SB_ALIGN_LEFT, palette->ink, name);
  double name_width = sb_text_width(section->text, name, 12, 600);
  sb_draw_text(list, x + name_width + 7, y, 12, 400, SB_ALIGN_LEFT, palette->second, unit);
  float x0 = (float)x, x1 = (float)(x + width), y0 = (float)(y + 9), y1 = (float)(y + 21);
  const SbDrawPoint corner[6] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y0}, {x1, y1}, {x0, y1}};
  const float scalar[6] = {0.0f, 1.0f, 1.0f, 0.0f, 1.0f, 0.0f};
  sb_draw_mesh(list, corner, scalar, 6, map, 0, 1);
  const SbDrawPoint frame[4] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  sb_draw_stroke(list, frame, 4, 1, palette->axis)->closed = true;
  double target = (max - min) / 3;
  double unit_step = pow(10, floor(log10(target)));
  double m = target / unit_step;
  double step = unit_step * (m >= 5 ? 5 : m >= 2 ? 2 : 1);
  for (double v = ceil(min / step - 1e-9) * step; v <= max * (1 + 1e-9); v += step) {
    double tick = x + (v - min) / (max - min) * width;
    sb_draw_line(list, tick, y1 + 1, tick, y1 + 5, 1, palette->axis);
    char text[SB_SECTION_NUMBER];
    sb_section_fixed(text, v, step >= 1 ? 0 : (int)ceil(-log10(step) - 1e-9));
    sb_draw_text(list, tick, y1 + 17, 11, 400, SB_ALIGN_CENTRE, palette->second, text);
  }
  return 62;
}

// The forces on the stem as lengths on one scale.
static void force_bars(SbSection *section, double x, double y, double width) {
  const SbPalette *palette = section->palette;
  SbDrawList *list = section->list;
  const SbFrame *frame = section->instant->frame;
  sb_draw_text(list, x, y, 12, 600, SB_ALIGN_LEFT, palette->ink, "forces on the stem");
  sb_draw_text(list, x + sb_text_width(section->text, "forces on the stem", 12, 600) + 7, y, 12,
               400, SB_ALIGN_LEFT, palette->second, "N");
  const struct {
    const char *name;
    double force;
    SbDrawColour colour;
  } row[4] = {
      {"drive", frame->force, palette->ink},
      {"pressure", frame->pressure_force, palette->fluid_line},
      {"inner friction", frame->seal[SB_INNER].friction, palette->seal[SB_INNER]},
      {"outer friction", frame->seal[SB_OUTER].friction, palette->seal[SB_OUTER]},
  };
  double zero = x + 106;
  double px = (x + width - 44 - zero) / 36.0;
  for (int i = 0; i < 4; i++) {
    double base = y + 19 + 17 * i;
    char text[SB_SECTION_NUMBER];
    sb_draw_text(list, x, base, 11, 400, SB_ALIGN_LEFT, palette->second, row[i].name);
    double length = fabs(row[i].force) * px;
    if (length > 0.5) {
      sb_draw_rect(list, zero, base - 8, fmin(length, x + width - zero), 8, row[i].colour);
    }
    sb_section_fixed(text, row[i].force, 1);
    sb_draw_text(list, zero + fmin(length, x + width - zero - 40) + 6, base, 11, 600, SB_ALIGN_LEFT,
                 palette->ink, text);
  }
  sb_draw_line(list, zero - 0.5, y + 8, zero - 0.5, y + 8 + 17 * 4, 1, palette->axis);
}

void sb_section_draw_legends(SbSection *section, double x, double y, double width) {
  const SbPalette *palette = section->palette;
  const SbSectionView *view = section->view;
  const SbSectionRing *ring = section->instant->ring[SB_OUTER];
  const SbFrame *frame = section->instant->frame;
  bool column = view->width - 2 * x >= 860;
  double low = section->strip.y - 10;
  if (!column) {
    legend(section, x, y + 12, width, "fluid pressure", "MPa, gauge", &palette->fluid, 0,
           SB_PALETTE_FLUID_FULL * 1e-6);
    if (ring != NULL) {
      legend(section, view->width - x - width, y + 12, width, ring->field_name, ring->field_unit,
             &palette->field, ring->scalar_min * ring->display_scale,
             ring->scalar_max * ring->display_scale);
    }
    return;
  }
  char text[96], value[SB_SECTION_NUMBER];
  sb_draw_text(section->list, x, y + 14, 17, 700, SB_ALIGN_LEFT, palette->ink, "Axial section");
  snprintf(text, sizeof text, "stem and seals at %s s, housing at rest",
           sb_section_fixed(value, frame->time, 2));
  sb_draw_text(section->list, x, y + 34, 12, 400, SB_ALIGN_LEFT, palette->second, text);
  double at = y + 64;
  if (ring != NULL) {
    at += legend(section, x, at, width, ring->field_name, ring->field_unit, &palette->field,
                 ring->scalar_min * ring->display_scale, ring->scalar_max * ring->display_scale);
  }
  at += legend(section, x, at, width, "fluid pressure", "MPa, gauge", &palette->fluid, 0,
               SB_PALETTE_FLUID_FULL * 1e-6);
  if (!view->hide_forces && at + 84 < low) {
    force_bars(section, x, at + 4, width);
  }
}
