// Keeps the section of the model drawn last, so that a film prepares it once. On an image surface
// the GL picture is read straight into the surface's memory where it lies on whole pixels; text and
// lines are then made at the device's resolution.
#include "app/section/painter.h"

#include "app/base/own_model.h"
#include "app/section/draw_cairo.h"
#include "app/section/gl_renderer.h"

#include <glib.h>
#include <math.h>
#include <string.h>

struct SbSectionPainter {
  SbGlContext *context;
  SbGlRenderer *renderer;
  char reason[SB_TEXT];
  SbSectionStyle style;
  SbDrawList list;
  SbText *text;
  cairo_surface_t *picture; // GL's result
  gint64 read_back;         // [us]
  // The section in use and what it was made for.
  SbSection *section;
  SbModel *model;
  SbSectionLimits limits;
  const SbFrame *frames;
  size_t count;
};

SbStatus sb_section_painter_create(SbSectionPainter **out, bool use_gl, SbGlBackend backend,
                                   SbReport *report) {
  *out = NULL;
  SbSectionPainter *painter = g_new0(SbSectionPainter, 1);
  sb_draw_list_init(&painter->list);
  painter->text = sb_text_create();
  g_strlcpy(painter->reason, "cairo: as requested", sizeof painter->reason);
  if (use_gl) {
    SbReport why = {0};
    SbStatus status = sb_gl_context_create(&painter->context, backend, &why);
    if (status == SB_OK) {
      status = sb_gl_renderer_create(&painter->renderer, painter->context, &why);
    }
    if (status == SB_OK) {
      g_strlcpy(painter->reason, sb_gl_context_reason(painter->context), sizeof painter->reason);
    } else if (backend != SB_GL_AUTO) {
      sb_section_painter_destroy(painter);
      return sb_fail(report, SB_ERROR_IO, "%s", why.text);
    } else {
      sb_text(painter->reason, sizeof painter->reason, "cairo: %s", why.text);
    }
  }
  *out = painter;
  return sb_succeed(report);
}

void sb_section_painter_destroy(SbSectionPainter *painter) {
  if (painter == NULL) {
    return;
  }
  sb_gl_renderer_destroy(painter->renderer);
  sb_gl_context_destroy(painter->context);
  if (painter->picture != NULL) {
    cairo_surface_destroy(painter->picture);
  }
  sb_section_destroy(painter->section);
  sb_model_destroy(painter->model);
  sb_text_destroy(painter->text);
  sb_draw_list_finish(&painter->list);
  g_free(painter);
}

const char *sb_section_painter_reason(const SbSectionPainter *painter) {
  return painter->reason;
}

double sb_section_painter_read_back(const SbSectionPainter *painter) {
  return 1e-6 * (double)painter->read_back;
}

SbSectionStyle sb_section_style_of(const SbModel *model) {
  const SbSectionLook *look = sb_model_look(model);
  enum { OF_INNER = 1, NONE = 2 };
  return (SbSectionStyle){.inset_seal = look->insets == OF_INNER ? SB_INNER : SB_OUTER,
                          .hide_insets = look->insets == NONE,
                          .full = look->section == SB_SECTION_FULL,
                          .cutaway = look->section == SB_SECTION_CUTAWAY,
                          .azimuth = look->azimuth,
                          .elevation = look->elevation,
                          .undeformed = look->undeformed,
                          .field = (SbField)look->field,
                          .field_max = look->field_max};
}

void sb_section_painter_style(SbSectionPainter *painter, const SbSectionStyle *style) {
  painter->style = *style;
}

// Rebuilds the section for this run if the model changed, and its limits if frames were added.
static void prepare(SbSectionPainter *painter, const SbChartRun *run) {
  bool same_model = painter->section != NULL && sb_model_same(painter->model, run->model);
  bool same_frames = painter->frames == run->frames && painter->count == run->count;
  if (same_model && same_frames) {
    return;
  }
  SbSectionLimits limits;
  sb_section_limits_of_frames(&limits, run->frames, run->count);
  for (uint32_t i = 0; run->shape != NULL && i < SB_RUN_SHAPES_MAX; i++) {
    sb_section_limits_add_shape(&limits, run->shape(run->source, i));
  }
  bool same_limits = memcmp(&limits, &painter->limits, sizeof limits) == 0;
  painter->frames = run->frames;
  painter->count = run->count;
  if (same_model && same_limits) {
    return;
  }
  sb_section_destroy(painter->section);
  painter->section = sb_section_create(run->model, &limits);
  painter->limits = limits;
  sb_model_destroy(painter->model);
  painter->model = sb_own_model(run->model);
}

// The list through GL onto the context; false if GL cannot (size).
static bool paint_by_gl(SbSectionPainter *painter, cairo_t *cr, SbRect rect) {
  double x = rect.x, y = rect.y, sx = 1, sy = 0;
  cairo_user_to_device(cr, &x, &y);
  cairo_user_to_device_distance(cr, &sx, &sy);
  double device_x, device_y;
  cairo_surface_get_device_scale(cairo_get_target(cr), &device_x, &device_y);
  double scale = sx * device_x;
  int left = (int)lround(x * device_x), top = (int)lround(y * device_y);
  int width = (int)lround(x * device_x + rect.width * scale) - left;
  int height = (int)lround(y * device_y + rect.height * scale) - top;
  if (width < 1 || height < 1 || !sb_gl_context_make_current(painter->context) ||
      sb_gl_renderer_draw(painter->renderer, &painter->list, width, height, scale, NULL) != SB_OK) {
    return false;
  }
  if (painter->picture == NULL || cairo_image_surface_get_width(painter->picture) != width ||
      cairo_image_surface_get_height(painter->picture) != height) {
    if (painter->picture != NULL) {
      cairo_surface_destroy(painter->picture);
    }
    painter->picture = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  }
  if (cairo_surface_status(painter->picture) != CAIRO_STATUS_SUCCESS) {
    cairo_surface_destroy(painter->picture);
    painter->picture = NULL;
    return false;
  }
  cairo_surface_flush(painter->picture);
  gint64 begin = g_get_monotonic_time();
  sb_gl_renderer_read(painter->renderer, cairo_image_surface_get_data(painter->picture),
                      (size_t)cairo_image_surface_get_stride(painter->picture));
  painter->read_back += g_get_monotonic_time() - begin;
  cairo_surface_mark_dirty(painter->picture);
  cairo_save(cr);
  cairo_identity_matrix(cr);
  cairo_scale(cr, 1 / device_x, 1 / device_y);
  cairo_set_source_surface(cr, painter->picture, left, top);
  cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_NEAREST);
  cairo_rectangle(cr, left, top, width, height);
  cairo_fill(cr);
  cairo_restore(cr);
  return true;
}

void sb_section_painter_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                             const SbChartData *data, void *user) {
  SbSectionPainter *painter = user;
  const SbFrame *frame = sb_chart_frame(data);
  if (frame == NULL || data->run.model == NULL) {
    return;
  }
  prepare(painter, &data->run);
  SbSectionInstant instant = {.frame = frame, .summary = data->run.summary};
  for (int i = 0; i < SB_SEAL_COUNT && data->run.profile != NULL; i++) {
    instant.profile[i] = data->run.profile(data->run.source, frame->seal[i].profile);
  }
  for (int i = 0; i < SB_SEAL_COUNT && data->run.shape != NULL; i++) {
    instant.ring[i] = data->run.shape(data->run.source, frame->seal[i].shape);
  }
  // Inside the panel's hairline and rounded corners.
  SbRect inside = {rect.x + 2, rect.y + 2, rect.width - 4, rect.height - 4};
  SbSectionView view = {
      .width = inside.width,
      .height = inside.height,
      .margin = SB_GRID_PADDING - 2,
      .dark = theme->dark,
      .hide_insets = painter->style.hide_insets,
      .hide_forces = painter->style.hide_forces,
      .hide_labels = painter->style.hide_labels,
      .inset_seal = painter->style.inset_seal,
      .zoom = painter->style.zoom,
      .full = painter->style.full,
      .cutaway = painter->style.cutaway,
      .azimuth = painter->style.azimuth,
      .elevation = painter->style.elevation,
      .field = painter->style.field,
      .field_max = painter->style.field_max,
      .undeformed = painter->style.undeformed,
  };
  sb_section_draw(painter->section, &painter->list, &view, &instant);
  cairo_surface_type_t type = cairo_surface_get_type(cairo_get_target(cr));
  if (painter->renderer != NULL && type == CAIRO_SURFACE_TYPE_IMAGE &&
      paint_by_gl(painter, cr, inside)) {
    return;
  }
  cairo_save(cr);
  cairo_translate(cr, inside.x, inside.y);
  sb_draw_list_to_cairo(&painter->list, painter->text, cr);
  cairo_restore(cr);
}
