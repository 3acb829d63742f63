// Views by name: what `sealbench render` and the export dialog draw, as a still or as one frame of
// a movie.
#pragma once

#include "app/base/unit.h"
#include "app/chart/dashboard.h"
#include "app/document/document.h"
#include "engine/valve/run/run.h"

// Draws a view into `rect`, below the header of its page; `flags`: bits SB_CHART_PANEL, ... of
// app/chart/data.h.
typedef void SbViewDraw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                        unsigned flags);

// One view of the table; strings are static.
typedef struct {
  const char *name;        // "hysteresis"
  const char *label;       // "Force and displacement"; translate it to show it
  double width, height;    // size it is designed for [logical pixels]
  unsigned computes;       // what a run must compute for it, SB_VIEW_...
  bool section;            // needs the function that draws the section
  bool cutaway;            // shows the section in three dimensions
  bool compares;           // draws saved designs together with the run
  bool whole;              // a still without a given instant shows the full run
  SbViewDraw *valve, *rig; // draw a run of a valve, of the sliding plate; NULL: the section
  // Draws the full page with its own header and footer; NULL: `valve` and `rig` draw its body.
  void (*page)(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
               unsigned flags, SbSectionDraw section, void *user);
  // As sb_render_view_fits(); NULL: fits every run.
  bool (*fits)(const SbRun *run, GError **error);
} SbRenderView;

// Returns the table; *count is set to the number of rows. Static.
const SbRenderView *sb_render_views(size_t *count);

// Returns the row of a name; NULL: there is none. Static.
const SbRenderView *sb_render_view(const char *name);

// A size with a name; strings are static.
typedef struct {
  const char *name;  // "1080p"
  const char *label; // "1080p, 1920 × 1080"; translate it to show it
  int width, height; // [pixels]
} SbRenderSize;

// Returns the table; *count is set to the number of rows. Static.
const SbRenderSize *sb_render_sizes(size_t *count);

// The run of a saved design. Borrowed.
typedef struct {
  const SbRun *run;
  const char *name;
  int look; // its style, from 0, below SB_CHART_PINS
} SbRenderPin;

// What a picture shows in addition to the run. Pointers are borrowed during the call (or as the
// function states); all members but `view` may be zero.
typedef struct {
  const char *view;     // name in the table
  double width, height; // [logical pixels]; 0: the view's size
  double scale;         // of a PNG: device pixels per logical pixel; 0: 1
  bool dark;            // theme
  const char *at;       // of a still: "C" or "7.27 s"; NULL: the full run in a view with
                        // SbRenderView.whole, else as sb_render_frame_at()
  const char *title;    // of the scene
  const char *subtitle; // names of the files; the header adds the run's conditions
  const char *hash;     // SHA-256 of the parameters
  const char *scene;    // text of the scene, stored in PNG and SVG so that they can be opened
  const char *ending;   // format of a `path` without an ending, ".png"; NULL: by the path
  const char *stale;    // why the run no longer matches the scene, for the page; NULL: it matches
  const SbComparison *measured;   // measured data compared with the run; NULL: none
  SbRenderPin pin[SB_CHART_PINS]; // saved designs, [pin_count]
  size_t pin_count;
  const SbChartMarker *marker; // bookmarks on time axes, [marker_count]
  size_t marker_count;
  // Draws the section. NULL: views with SbRenderView.section are refused, except a still of one
  // that has SbRenderView.page, which then has no section.
  SbSectionDraw section;
  void *section_data; // passed to `section`
} SbRenderOptions;

// Returns whether `run` has what `view` shows; false with SB_APP_ERROR_INPUT if not.
bool sb_render_view_fits(const SbRenderView *view, const SbRun *run, GError **error);

// Draws one page of the view into `rect` [logical pixels]: ground, header, the view, footer.
// `flags`: bits SB_CHART_... of app/chart/data.h. `data` may be of a run that has not ended.
// `section` (may be NULL: nothing is drawn in its place) is called with `user`.
void sb_render_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                    unsigned flags, const SbRenderView *view, SbSectionDraw section, void *user);

// Memory for the saved designs in chart data; see sb_render_compared_begin().
typedef struct {
  SbTrace *trace[SB_CHART_PINS];
  SbChartRun run[SB_CHART_PINS];
} SbRenderCompared;

// Sets *out to an array of the bookmarks of a document, for SbRenderOptions, and returns their
// number. The array is freed by g_free(); the names in it are borrowed from the document.
size_t sb_render_markers(SbChartMarker **out, const SbDocument *document);

// Fills the members of `data` that come from the options: texts, measured data, bookmarks and saved
// designs that have frames. The caller has set all of `data` to zeros, and sets `run` and
// `playhead`. `compared` and the content of `options` are borrowed by `data` until
// sb_render_compared_end().
void sb_render_compared_begin(SbRenderCompared *compared, SbChartData *data,
                              const SbRenderOptions *options);

// Sets the frame of each saved design to the position of data->playhead; to be called after `run`
// and `playhead` were set or changed.
void sb_render_compared_place(SbChartData *data);

// Frees the memory of sb_render_compared_begin().
void sb_render_compared_end(SbRenderCompared *compared);

// Draws a finished run (done, cancelled or failed) into the file `path` as PNG, SVG or PDF by its
// ending. Returns false with SB_APP_ERROR_INPUT (unknown view, a view that the run has not, stage
// not reached, size, ending) or SB_APP_ERROR_IO; an earlier file is intact then.
bool sb_render_still(const SbRun *run, const SbRenderOptions *options, const char *path,
                     GError **error);

// Sets *frame (from 0) to the frame that `at` names: "A" to "F" (just before the event) or a time
// with its unit (nearest frame; a time without a unit is an error). NULL or "": the middle of B-C,
// where the run's figures are defined, or the last frame of a run without B or C. Returns false
// with SB_APP_ERROR_INPUT if the run has no frame, the stage was not reached, the time is outside
// of the run, or the text is neither.
bool sb_render_frame_at(size_t *frame, const SbRun *run, const char *at, GError **error);
