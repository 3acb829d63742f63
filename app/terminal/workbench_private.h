// Shared by the files of the workbench in a terminal: workbench.c (start, end, drawing),
// workbench_valve.c, workbench_design.c, workbench_design_map.c, workbench_calibrate.c and
// workbench_pages.c (content of the pages), workbench_params.c (list of parameters),
// workbench_export.c, workbench_keys.c (keys and mouse) and workbench_entry.c (lines that the user
// types, popups). Main thread only.
//
// Drawing: sb_bench_draw_...() write to bench->cells, and workbench.c alone calls them when the
// screen is to be drawn. All other functions that change what is displayed request a drawing
// themselves, except sb_bench_list(). Code that changes a field of SbBench calls
// sb_bench_changed().
#pragma once

#include "app/export/export_job.h"
#include "app/session/autosave.h"
#include "app/session/calibrate_ask.h"
#include "app/session/calibrate_job.h"
#include "app/session/cases_job.h"
#include "app/session/design_job.h"
#include "app/session/effect_watch.h"
#include "app/session/section_source.h"
#include "app/session/session.h"
#include "app/session/study_job.h"
#include "app/terminal/charts.h"
#include "app/terminal/workbench.h"

// Pages, chosen by a tab each.
typedef enum {
  SB_PAGE_VALVE,
  SB_PAGE_DESIGN,
  SB_PAGE_CALIBRATE,
  SB_PAGE_PROPELLANTS,
  SB_PAGE_STUDIES,
  SB_PAGE_COUNT
} SbBenchPage;

// Which parameters are listed: the main ones, those that differ from the default, all.
typedef enum { SB_LIST_MAIN, SB_LIST_CHANGED, SB_LIST_ALL, SB_LIST_COUNT } SbListKind;

// Purpose of the line of text that the user types.
typedef enum {
  SB_INPUT_NONE,
  SB_INPUT_VALUE,
  SB_INPUT_SEARCH,
  SB_INPUT_SAVE,
  SB_INPUT_EXPORT,
  SB_INPUT_BOUNDS, // of the selected parameter of the page Design
  SB_INPUT_OPEN
} SbInput;

// What covers the page.
typedef enum {
  SB_POPUP_NONE,
  SB_POPUP_HELP,
  SB_POPUP_VERDICT,
  SB_POPUP_WARNINGS,
  SB_POPUP_LINES, // bench->lines
  SB_POPUP_QUIT,
  SB_POPUP_RESTORE,
  SB_POPUP_DISK // another program has changed the file
} SbPopup;

// SbListRow.id of a heading; duration of one played cycle [s].
enum { SB_HEADING_ROW = -1, SB_PLAY_S = 10 };

// A line of the list: a parameter, or the heading of those that follow.
typedef struct {
  int id;            // SbParamId, or SB_HEADING_ROW
  const char *title; // of a heading; static
} SbListRow;

// The page Design. Objects are owned.
typedef struct {
  SbDesignAsk ask;            // what is requested
  const SbDocument *document; // the document that `ask` belongs to; only compared
  int kind;                   // kind of its valve
  int row, scroll;        // selected row: objective, models, ranges; ranges above the visible ones
  size_t effect;          // index of the figure, among those shown, whose effects are drawn
  SbDesignJob *job;       // NULL: none
  SbDesignAnswer *answer; // last results; NULL: none
  SbStore *store;         // store of evaluations; NULL: not open
  char *hash;             // sb_document_sha256() of the values of the last request
  char *sentence;         // how the last search ended; NULL: no search yet
  bool changed;           // the request was changed since
} SbBenchDesign;

// The page Calibrate. Objects are owned.
typedef struct {
  SbCalibrateAsk ask;  // what is requested
  int row;             // selected parameter
  SbCalibrateJob *job; // NULL: none
  SbStudyFile *study;  // of `found`; NULL: there is no result
  SbCalibration found;
  SbData *fitted; // the data that `found` and `job` belong to; NULL: none
  char *hash;     // sb_document_sha256() of the values of the last request
  char *sentence; // why there is no result, or only a part of it; NULL: nothing
} SbBenchCalibrate;

// The workbench. Objects are owned unless stated otherwise.
typedef struct {
  SbSession *session;
  SbAutosave *autosave;
  SbScreen *screen;
  GMainLoop *loop;
  guint tick, draw;  // GLib sources of animation and of the next drawing; 0: none
  bool begun, ended; // a screen was sent; the user leaves

  SbCellTheme theme;
  SbCells cells; // the picture that is drawn
  SbBenchPage page;
  SbPopup popup;
  int popup_scroll;   // lines above the first visible one
  char *message;      // result of the last action; NULL: none
  bool message_fails; // the message states an error
  char *lines;        // text of SB_POPUP_LINES; NULL: none yet
  gint64 looked;      // time of the last check of the file on disk, g_get_monotonic_time() [us]
  SbDiskState disk;   // state for which the user was last asked to decide
  char *orphan;       // path of unsaved changes of a process that ended, offered to be restored

  // The list. After a change of list, search or of a value, call sb_bench_list() to renew `rows`.
  SbListKind list;
  GString *search; // text that listed parameters must contain; not empty: `list` is ignored
  GArray *rows;    // of SbListRow, filled by sb_bench_list()
  int selected;    // SbParamId, always valid; one of `rows` unless these have no parameter
  int scroll;      // rows above the first visible one
  SbCellRect list_at, timeline_at; // position in the last picture, for the mouse

  // The line that the user types.
  SbInput input;
  GString *typed; // UTF-8
  int caret;      // characters before the caret

  // The section.
  SbSectionSource *source;
  SbDrawList drawing;
  SbText *text;
  SbField field; // shown by the colours of the rings
  SbSectionZoom zoom;
  bool solved;          // the last picture has fields in its rings
  GString *pixels;      // picture for the terminal; NULL: none
  SbCellRect pixels_at; // its cells

  SbEffectWatch *effects; // effect of each parameter on the goal
  int goal;               // index of a figure (sb_figure())

  // Studies.
  SbStudyKind study_kind;      // chosen by the user
  SbStudyJob *job;             // being computed; NULL: none
  SbStudyKind job_kind;        // of `job`
  SbStudy *study;              // last complete study, of any kind; NULL: none yet
  char *study_hash, *job_hash; // sb_document_sha256() of the values of `study` and `job`

  SbBenchDesign design;
  SbBenchCalibrate calibrate;

  SbExportJob *export; // running; NULL: none
  SbCasesJob *cases;   // of the displayed run if the scene has cases; NULL: none
} SbBench;

// ---- workbench.c ----

// Requests a new drawing from the main loop; several requests become one.
void sb_bench_changed(SbBench *bench);

// Shows a message (printf format) in the status line; `fails`: as an error. Replaces the earlier
// one.
void sb_bench_status(SbBench *bench, bool fails, const char *format, ...) G_GNUC_PRINTF(3, 4);

// Ends the workbench: sb_workbench_run() returns.
void sb_bench_end(SbBench *bench);

// Returns a pen with the colour of a role on the present background; `style` of SB_CELL_BOLD, ...
SbPen sb_bench_pen(const SbBench *bench, SbRole role, uint8_t style);

// ---- workbench_params.c ----

// Fills bench->rows with the parameters that bench->list or bench->search selects. If the selected
// parameter is not among them, the first one becomes selected. Does not request a drawing.
void sb_bench_list(SbBench *bench);

// Draws bench->rows into `rect`.
void sb_bench_draw_list(SbBench *bench, SbCellRect rect);

// Moves the selection by a number of parameters, down if positive; stops at the ends. Headings are
// not counted.
void sb_bench_move(SbBench *bench, int rows);

// Selects parameter `id` (SbParamId). If it is not listed, clears the search and lists all.
void sb_bench_select(SbBench *bench, int id);

// ---- workbench_valve.c ----

// Returns the answer to question `kind` (of SbVerdictKind) of the displayed run, which must have
// ended (sb_session_summary() is not NULL): the worst over all cases once these are computed, and
// the case that gives it (name NULL: the scene itself; else borrowed from bench->cases).
SbCaseVerdict sb_bench_verdict(SbBench *bench, int kind);

// Draws the title and the tabs into the first rows.
void sb_bench_draw_header(SbBench *bench);

// Draws the verdict into row `y`.
void sb_bench_draw_verdict(SbBench *bench, int y);

// Draws the page Valve into `rect`.
void sb_bench_draw_valve(SbBench *bench, SbCellRect rect);

// Draws the status line into row `y`.
void sb_bench_draw_status(SbBench *bench, int y);

// ---- workbench_pages.c ----

// Draws the present page, other than Valve, into `rect`.
void sb_bench_draw_page(SbBench *bench, SbCellRect rect);

// Draws the popup over the page if there is one.
void sb_bench_draw_popup(SbBench *bench);

// Returns the pen of a row in a list, whose background it fills from (x, y) over `width` columns;
// `chosen`: the selected row.
SbPen sb_bench_row(SbBench *bench, int x, int y, int width, bool chosen);

// Draws what is being computed with its progress `share`, 0 to 1, into two rows.
void sb_bench_draw_progress(SbBench *bench, int x, int y, int width, const char *title,
                            double share);

// Starts to compute the study bench->study_kind with the present values. The result appears in
// bench->study later. Starts nothing and shows a message if a study is being computed, or if the
// values are inconsistent.
void sb_bench_study_start(SbBench *bench);

// Requests that the study being computed ends; bench->job becomes NULL later, from the main loop,
// and bench->study stays. Returns whether a study is being computed.
bool sb_bench_study_stop(SbBench *bench);

// ---- workbench_design.c ----

// Sets the initial request if the document or the kind of its valve is another one; then ends the
// running search and forgets its result. To be called at the start and after each edit.
void sb_bench_design_follow(SbBench *bench);

// Acts on a key of the page.
void sb_bench_design_key(SbBench *bench, const SbKey *key);

// Sets the bounds of the selected parameter from text that the user typed, "1.45 mm .. 1.77 mm",
// and lets the search vary it. Shows a message if the text is wrong.
void sb_bench_design_bounds(SbBench *bench, const char *text);

// Shows the effects on the next figure of the page.
void sb_bench_design_effect(SbBench *bench);

// Requests that the running search ends. Returns whether there is one.
bool sb_bench_design_stop(SbBench *bench);

// Draws the page into `rect`.
void sb_bench_draw_design(SbBench *bench, SbCellRect rect);

// Ends the search and frees what the page owns.
void sb_bench_design_finish(SbBench *bench);

// ---- workbench_design_map.c ----

// Draws the map of a search into `rect`; `answer` NULL: none, and nothing is drawn.
void sb_bench_draw_design_map(SbBench *bench, const SbDesignAnswer *answer, SbCellRect rect);

// Draws the largest effects of tolerances on a figure (index of sb_figure()), at the best design if
// there is one, as many as `rect` has rows for.
void sb_bench_draw_design_effects(SbBench *bench, const SbDesignAnswer *answer, int figure,
                                  SbCellRect rect);

// ---- workbench_calibrate.c ----

// Ends the calibration and forgets its result if the document has other measured data. To be called
// at the start and after each edit.
void sb_bench_calibrate_follow(SbBench *bench);

// Acts on a key of the page.
void sb_bench_calibrate_key(SbBench *bench, const SbKey *key);

// Requests that the running calibration ends. Returns whether there is one.
bool sb_bench_calibrate_stop(SbBench *bench);

// Draws the page into `rect`.
void sb_bench_draw_calibrate(SbBench *bench, SbCellRect rect);

// Ends the calibration and frees what the page owns.
void sb_bench_calibrate_finish(SbBench *bench);

// ---- workbench_export.c ----

// Starts an export from a line that the user typed: a path and a view, "loop.png hysteresis". Shows
// a message if the line is wrong or an export is running.
void sb_bench_export(SbBench *bench, const char *text);

// ---- workbench_entry.c ----

// Lets the user type a line, which starts with `text`; bench->input becomes `input`.
void sb_bench_type(SbBench *bench, SbInput input, const char *text);

// Acts on a key while the user types a line.
void sb_bench_type_key(SbBench *bench, const SbKey *key);

// Shows a popup over the page.
void sb_bench_open_popup(SbBench *bench, SbPopup popup);

// Acts on a key while a popup is shown.
void sb_bench_popup_key(SbBench *bench, const SbKey *key);

// Saves the document as `path`; NULL: to its own file. Returns whether it was saved; otherwise
// shows a message, requests a name, or shows the popup about a file that another program has
// changed.
bool sb_bench_save(SbBench *bench, const char *path);

// Checks whether another program has changed the document's file, and shows a popup after a change.
// Does nothing within a second of the last check, while a popup is shown, or while the user types.
void sb_bench_check_disk(SbBench *bench);

// ---- workbench_keys.c ----

// Acts on a key or mouse event.
void sb_bench_key(SbBench *bench, const SbKey *key);
