// Views by name: what `sealbench render` and the export dialog draw, as a still or as one frame of
// a film.
#pragma once

#include "app/base/unit.h"
#include "app/chart/dashboard.h"
#include "app/document/document.h"
#include "engine/valve/run/run.h"

// One view of the table.
typedef struct {
  const char *name;     // "hysteresis"
  const char *label;    // "Force and displacement"
  double width, height; // size it is made for
  bool section;         // needs the section's drawing function
  bool compares;        // draws kept designs beside the run
} SbRenderView;

// The table, `*count` rows; static.
const SbRenderView *sb_render_views(size_t *count);

// A row by name; NULL if there is none.
const SbRenderView *sb_render_view(const char *name);

// Sizes with a name.
typedef struct {
  const char *name;  // "1080p"
  const char *label; // "Full HD, 1920 × 1080"
  int width, height; // pixels
} SbRenderSize;

// The table, `*count` rows; static.
const SbRenderSize *sb_render_sizes(size_t *count);

// A kept design's run to draw beside.
typedef struct {
  const SbRun *run;
  const char *name;
  int look; // of SB_CHART_PINS
} SbRenderPin;

// What a picture takes beside the run. Pointers are borrowed; zero is a good default everywhere but
// `view`.
typedef struct {
  const char *view;     // name in the table
  double width, height; // logical pixels; 0: the view's own size
  double scale;         // PNG pixels per logical pixel; 0 counts as 1
  bool dark;            //
  const char *at;       // "C" or "7.27 s"; NULL: see sb_render_frame_at()
  const char *title;    // of the scene
  const char *subtitle; // names of the files; the header adds the run's conditions
  const char *hash;     // of the parameters
  const char *scene;    // text that restores the scene, for PNG and SVG
  const char *ending;   // of a file whose path has none; NULL: the path's
  const char *stale;    // why the run no longer fits the scene, said on the page; NULL: it does
  const SbComparison *measured; // of the run; NULL: nothing
  SbRenderPin pin[SB_CHART_PINS];
  size_t pin_count;
  const SbChartMarker *marker; // bookmarks on timelines, `marker_count` of them
  size_t marker_count;
  SbSectionDraw section; // draws the section; NULL: views that need it are refused
  void *section_data;
} SbRenderOptions;

// Whether a run has what a view shows; false with SB_APP_ERROR_INPUT if not.
bool sb_render_view_fits(const SbRenderView *view, const SbRun *run, GError **error);

// Draws one page of the view: ground, header, the view, footer. For films call it once per frame on
// an image surface. `data` may be of a run that is still going.
void sb_render_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                    unsigned flags, const SbRenderView *view, SbSectionDraw section, void *user);

// What the options add to a run's chart data: texts, measured data, bookmarks and kept designs,
// each at the frame that stands where the playhead does.
typedef struct {
  SbTrace *trace[SB_CHART_PINS];
  SbChartRun run[SB_CHART_PINS];
} SbRenderBeside;

// The bookmarks of a document for SbRenderOptions; how many. The array is the caller's (g_free),
// its names are the document's.
size_t sb_render_markers(SbChartMarker **out, const SbDocument *document);

// Fills all of `data` but its run and playhead; both are borrowed until sb_render_beside_end().
void sb_render_beside_begin(SbRenderBeside *beside, SbChartData *data,
                            const SbRenderOptions *options);

// After the playhead has moved.
void sb_render_beside_place(SbChartData *data);
void sb_render_beside_end(SbRenderBeside *beside);

// Renders a finished run (done, cancelled or failed) into PNG, SVG or PDF by the ending of `path`.
// Fails with SB_APP_ERROR_INPUT (unknown view, stage not reached, size, ending) or SB_APP_ERROR_IO.
bool sb_render_still(const SbRun *run, const SbRenderOptions *options, const char *path,
                     GError **error);

// Frame of "A" to "F" (just before the event) or of a time with unit (nearest frame). NULL: the
// middle of B-C, where the run's figures are defined, or the last frame of a run that has no C.
// False with an error if the stage was not reached or the text is neither.
bool sb_render_frame_at(size_t *frame, const SbRun *run, const char *at, GError **error);
