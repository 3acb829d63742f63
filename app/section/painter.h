// The section as a part of a page: draws the frame at a chart's playhead into a rectangle of any
// cairo context, by OpenGL for pictures and as vectors for SVG and PDF.
#pragma once

#include "app/chart/dashboard.h"
#include "app/section/gl_context.h"
#include "app/section/section.h"

// A painter is used in the thread that created it.
typedef struct SbSectionPainter SbSectionPainter;

// How the section is shown; all zeros is the default view. Members as in SbSectionView.
typedef struct {
  int inset_seal;                             // SB_OUTER or SB_INNER: seal of the insets
  SbSectionZoom zoom;                         // full valve or one seal
  bool hide_insets, hide_forces, hide_labels; // omit these parts
  bool full, undeformed, cutaway;             // both halves; free outlines; three dimensions
  double azimuth, elevation;                  // of the cutaway's camera [rad]
  SbField field;                              // shown by the colours of solved rings
  double field_max; // end of the colours [Pa]; 0: automatic; not for displacement and permeation
} SbSectionStyle;

// Returns the style that a scene specifies.
SbSectionStyle sb_section_style_of(const SbModel *model);

// Creates a painter with the default style. With `use_gl` it creates a context of `backend`:
// SB_ERROR_IO if a named one does not work; SB_GL_AUTO then uses cairo, which the reason of the
// painter states. Without `use_gl` it uses cairo. Freed by sb_section_painter_destroy().
SbStatus sb_section_painter_create(SbSectionPainter **out, bool use_gl, SbGlBackend backend,
                                   SbReport *report);

// Frees a painter.
void sb_section_painter_destroy(SbSectionPainter *painter);

// Returns what draws and why: "osmesa (llvmpipe ...): why", or "cairo: why".
const char *sb_section_painter_reason(const SbSectionPainter *painter);

// Returns the time spent so far in waiting for GL and reading its pictures [s].
double sb_section_painter_read_back(const SbSectionPainter *painter);

// Sets the style of the next pictures (copied).
void sb_section_painter_style(SbSectionPainter *painter, const SbSectionStyle *style);

// Draws the section at the playhead of `data` into `rect` [px], with light or dark colours as
// `theme`. Draws nothing without a frame or a model. It has the type SbSectionDraw
// (app/chart/dashboard.h); `user` is the SbSectionPainter.
void sb_section_painter_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                             const SbChartData *data, void *user);
