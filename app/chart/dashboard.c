// The dashboard's grid: margins 32, gutters 24 across and 16 down; the loop takes a third of the
// width, the section the rest; profiles below, half each; timeline and footer at fixed heights, so
// that extra height goes to the section. Leaves out any drawing of its own.
#include "app/chart/dashboard.h"
#include "app/base/device.h"
#include "app/chart/hysteresis.h"
#include "app/chart/page.h"
#include "app/chart/profiles.h"
#include "app/chart/rig.h"
#include "app/chart/timeline.h"

#include <math.h>

#define NOMINAL_WIDTH  1920.0
#define NOMINAL_HEIGHT 1080.0
#define LEAST_SCALE    0.75

// Positions of the parts: a point (x, y) of the page is the pixel (rect.x + scale * x, rect.y +
// scale * y) of the picture.
typedef struct {
  double scale; // of the page
  SbRect page, section, loop, pressure, film, timeline;
} Layout;

// Writes the positions of the parts for `rect` [px] as sb_dashboard_draw() uses them.
// `with_section`: the page has a section; without one out->section has no meaning.
static void lay_out(Layout *out, SbRect rect, bool with_section) {
  double scale = fmin(rect.width / NOMINAL_WIDTH, rect.height / NOMINAL_HEIGHT);
  // Below three quarters the text would be too small: keep it, give the panels less. A page too
  // small even for that is scaled as a whole again.
  if (scale < LEAST_SCALE) {
    scale = fmin(LEAST_SCALE, fmin(rect.width / 1280, rect.height / 900));
  }
  scale = fmax(scale, 0.05);
  const double w = rect.width / scale, h = rect.height / scale;
  const double margin = SB_GRID_MARGIN, gutter = SB_GRID_GUTTER;
  out->scale = scale;
  out->page = (SbRect){0, 0, w, h};
  double timeline_top = h - 104 - sb_page_footer_height(out->page);
  double profiles = fmin(fmax(floor(h * 240 / NOMINAL_HEIGHT), 200), 300);
  double profiles_top = timeline_top - 16 - profiles, top = SB_PAGE_HEADER;
  double height = profiles_top - 16 - top;
  double loop = with_section ? floor(w / 3) : w - 2 * margin;
  out->loop = (SbRect){w - margin - loop, top, loop, height};
  out->section = (SbRect){margin, top, w - 2 * margin - gutter - loop, height};
  double half = floor(0.5 * (w - 2 * margin - gutter));
  out->pressure = (SbRect){margin, profiles_top, half, profiles};
  out->film = (SbRect){w - margin - half, profiles_top, half, profiles};
  out->timeline = (SbRect){margin, timeline_top, w - 2 * margin, 104};
}

void sb_dashboard_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                       unsigned flags, SbSectionDraw section, void *user) {
  Layout at;
  lay_out(&at, rect, section != NULL);
  flags = (flags | SB_CHART_PANEL) & ~(unsigned)SB_CHART_COMPACT;
  cairo_save(cr);
  cairo_translate(cr, rect.x, rect.y);
  cairo_scale(cr, at.scale, at.scale);
  SbColor ground = theme->role[SB_ROLE_BACKGROUND];
  cairo_set_source_rgb(cr, ground.r, ground.g, ground.b);
  cairo_rectangle(cr, 0, 0, at.page.width, at.page.height);
  cairo_fill(cr);

  sb_page_header_draw(cr, at.page, theme, data, flags);
  if (!sb_device(data->run.model)->stem) {
    // No valve to cut: the signal takes the section's place, the plate the lower panels'.
    SbRect lower = at.pressure;
    lower.width = at.film.x + at.film.width - lower.x;
    SbRect upper = at.loop;
    upper.x = section ? at.section.x : at.loop.x;
    upper.width = at.loop.x + at.loop.width - upper.x;
    sb_rig_page_draw(cr, upper, theme, data, flags);
    sb_rig_plate_draw(cr, lower, theme, data, flags);
    sb_timeline_draw(cr, at.timeline, theme, data, flags);
    sb_page_footer_draw(cr, at.page, theme, data, flags);
    cairo_restore(cr);
    return;
  }
  if (section) {
    SbCanvas canvas;
    sb_canvas_init(&canvas, cr, theme);
    sb_canvas_panel(&canvas, at.section);
    sb_canvas_finish(&canvas);
    cairo_save(cr);
    cairo_rectangle(cr, at.section.x, at.section.y, at.section.width, at.section.height);
    cairo_clip(cr);
    section(cr, at.section, theme, data, user);
    cairo_restore(cr);
  }
  sb_hysteresis_draw(cr, at.loop, theme, data, flags);
  sb_profiles_pressure_draw(cr, at.pressure, theme, data, flags);
  sb_profiles_film_draw(cr, at.film, theme, data, flags);
  sb_timeline_draw(cr, at.timeline, theme, data, flags);
  sb_page_footer_draw(cr, at.page, theme, data, flags);
  cairo_restore(cr);
}
