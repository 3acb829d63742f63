// The section as one part of a page: draws the frame under a chart's playhead into a rectangle of
// any cairo context, by OpenGL on pictures, as vectors on SVG and PDF.
#pragma once

#include "app/chart/dashboard.h"
#include "app/section/gl_context.h"
#include "app/section/section.h"

typedef struct SbSectionPainter SbSectionPainter;

// How the section is shown; zero is the default view.
typedef struct {
  int inset_seal; // SB_OUTER or SB_INNER
  SbSectionZoom zoom;
  bool hide_insets, hide_forces, hide_labels;
  bool full, undeformed, cutaway; // as in SbSectionView
  double azimuth, elevation;      // of the cutaway's camera [rad]
  SbField field;
  double field_max; // [Pa], 0: automatic
} SbSectionStyle;

// What a scene says about it.
SbSectionStyle sb_section_style_of(const SbModel *model);

// A painter for this thread. With `use_gl` it opens a context (SB_ERROR_IO if an explicitly asked
// back end does not work; with SB_GL_AUTO it falls back to cairo and says so in its reason).
SbStatus sb_section_painter_create(SbSectionPainter **out, bool use_gl, SbGlBackend backend,
                                   SbReport *report);

// On the thread that made it. NULL is allowed.
void sb_section_painter_destroy(SbSectionPainter *painter);

// "osmesa (llvmpipe ...): why", or "cairo: why"; borrowed.
const char *sb_section_painter_reason(const SbSectionPainter *painter);

// Seconds spent so far in waiting for GL and reading its pictures back.
double sb_section_painter_read_back(const SbSectionPainter *painter);

void sb_section_painter_style(SbSectionPainter *painter, const SbSectionStyle *style);

// Draws into `rect` (an SbSectionDraw; `user` is the SbSectionPainter). Nothing where there is no
// frame or no model yet. Colours follow the theme's darkness.
void sb_section_painter_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                             const SbChartData *data, void *user);
