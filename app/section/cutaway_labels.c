// Names of the parts around a cutaway, with leaders, and its caption.
#include "app/section/cutaway_private.h"

#include "app/chart/data.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  char text[96];
  SbColor color;
  SbPoint at;     // what it names
  double x, half; // middle and half width
} Callout;

enum { CALLOUTS_MAX = 6, PASSES = 40 };

static void name_point(Callout *callouts, size_t *count, SbPoint at, SbColor color,
                       const char *text) {
  Callout *callout = &callouts[(*count)++];
  *callout = (Callout){.color = color, .at = at, .x = (double)at.x};
  g_strlcpy(callout->text, text, sizeof callout->text);
}

static int from_left(const void *a, const void *b) {
  const Callout *x = a, *y = b;
  return (x->at.x > y->at.x) - (x->at.x < y->at.x);
}

// One row of labels in the order of their points, each as near to its own as the others let it, and
// a line from each. A row that is too long is left out.
static void draw_row(const SbCutaway *cutaway, SbSection *section, Callout *callouts, size_t count,
                     bool above) {
  const SbRect *strip = &section->strip;
  const double gap = 14;
  double left = (double)strip->x, right = (double)(strip->x + strip->width), total = 0;
  for (size_t i = 0; i < count; i++) {
    callouts[i].half = sb_text_width(section->text, callouts[i].text, 12, 600) / 2;
    total += 2 * callouts[i].half + gap;
  }
  if (total > right - left) {
    return;
  }
  qsort(callouts, count, sizeof *callouts, from_left);
  for (int pass = 0; pass < PASSES; pass++) {
    for (size_t i = 0; i < count; i++) {
      Callout *one = &callouts[i], *two = one + 1;
      one->x = CLAMP(one->x, left + one->half, right - one->half);
      if (i + 1 < count && two->x - one->x < one->half + two->half + gap) {
        double apart = (one->half + two->half + gap - (two->x - one->x)) / 2;
        one->x -= apart;
        two->x += apart;
      }
    }
  }
  double y = above ? fmax((double)strip->y + 14, cutaway->top - 24)
                   : fmin((double)(strip->y + strip->height) - 6, cutaway->bottom + 30);
  double from = above ? y + 5 : y - 14;
  for (size_t i = 0; i < count; i++) {
    const Callout *it = &callouts[i];
    sb_draw_line(section->list, it->x, from, it->at.x, it->at.y, 1, it->color);
    sb_draw_disc(section->list, it->at.x, it->at.y, 3.2, section->palette->panel);
    sb_draw_disc(section->list, it->at.x, it->at.y, 2.2, it->color);
    sb_draw_text(section->list, it->x, y, 12, 600, SB_MIDDLE, it->color, it->text);
  }
}

void sb_cutaway_labels(SbCutaway *cutaway, SbSection *section) {
  const SbPalette *palette = section->palette;
  const SbValveOutline *valve = &section->valve;
  const SbFrame *frame = section->instant->frame;
  const double *toward = cutaway->revolve.orbit.toward;
  bool looks_in = toward[1] > 0.3 && fabs(toward[2]) < 1.1 * toward[1];
  if (!looks_in || section->view->magnify > 1) {
    return;
  }
  SbSectionPlane upper = sb_cutaway_plane(&cutaway->revolve, 0),
                 lower = sb_cutaway_plane(&cutaway->revolve, 1);
  Callout row[CALLOUTS_MAX];
  size_t count = 0;
  double s = frame->displacement;
  char text[96], value[SB_SECTION_NUMBER];
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    bool free = frame->seal[i].land_fraction <= 0;
    snprintf(text, sizeof text, "%s%s", sb_chart_seal_name(section->model, i),
             !free           ? ""
             : valve->gasket ? _(", around the neck")
                             : _(", off the land"));
    double x = sb_section_origin(section, i);
    name_point(row, &count,
               sb_section_plane_at(&upper, x,
                                   valve->gasket ? (valve->bore + valve->rim) / 2
                                                 : (valve->floor + valve->bore) / 2),
               palette->seal[i], text);
  }
  double end = valve->vent_right > valve->vent_left ? valve->vent_left : valve->end;
  double place = fmax(end - 0.15 * valve->size, valve->face / 2);
  double low, high;
  if (sb_outline_radii(&low, &high, &cutaway->valve.housing, place)) {
    name_point(row, &count, sb_section_plane_at(&upper, place, (low + high) / 2), palette->ink,
               valve->gasket ? _("Body") : _("Housing"));
  }
  snprintf(text, sizeof text, _("Chamber %s"),
           sb_section_megapascal(value, (double)frame->seal[SB_INNER].pressure_right));
  double middle = (valve->chamber_floor + (valve->gasket ? valve->chamber_roof : valve->land)) / 2;
  name_point(row, &count,
             sb_section_plane_at(&upper, valve->chamber - (valve->gasket ? 0 : s), middle),
             palette->fluid_line, text);
  snprintf(text, sizeof text, _("Canister %s"),
           sb_section_megapascal(value, (double)frame->seal[SB_INNER].pressure_left));
  double mouth = 0.9 * valve->face;
  double hole = sb_valve_outline_bore(valve, mouth);
  if (isfinite(hole)) {
    name_point(row, &count, sb_section_plane_at(&upper, mouth, (hole + valve->land) / 2),
               palette->fluid_line, text);
  }
  draw_row(cutaway, section, row, count, true);

  count = 0;
  name_point(row, &count,
             sb_section_plane_at(&lower, valve->chamber - s, 0.5 * valve->chamber_floor),
             palette->ink, _("Stem"));
  draw_row(cutaway, section, row, count, false);
}

void sb_cutaway_caption(SbSection *section) {
  const SbSectionView *view = section->view;
  double y = (double)(section->strip.y + section->strip.height) + 22;
  bool schematic =
      section->instant->ring[SB_OUTER] == NULL || section->instant->ring[SB_INNER] == NULL;
  char azimuth[SB_SECTION_NUMBER], elevation[SB_SECTION_NUMBER], caption[200];
  const char *const parts[3] = {_("a quarter cut away, parallel projection"),
                                schematic ? _("; rings: schematic shape") : "",
                                view->undeformed ? _("; dashed: rings before fitting") : ""};
  snprintf(caption, sizeof caption, _("%s%s%s; azimuth %s\xc2\xb0, elevation %s\xc2\xb0"), parts[0],
           parts[1], parts[2], sb_section_fixed(azimuth, view->azimuth * 180 / G_PI, 0),
           sb_section_fixed(elevation, view->elevation * 180 / G_PI, 0));
  if (sb_text_width(section->text, caption, 11, 400) > (double)section->strip.width) {
    snprintf(caption, sizeof caption, "%s", schematic ? _("rings: schematic shape") : parts[0]);
  }
  sb_draw_text(section->list, section->strip.x, y, 11, 400, SB_LEFT, section->palette->second,
               caption);
}
