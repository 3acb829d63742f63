// Inside of the workbench in a terminal, shared by workbench.c (life, drawing), workbench_valve.c
// and workbench_pages.c (what the pages show), workbench_params.c (the list of parameters) and
// workbench_keys.c (keys and mouse).
#pragma once

#include "app/export/export_job.h"
#include "app/session/autosave.h"
#include "app/session/cases_job.h"
#include "app/session/effect_watch.h"
#include "app/session/section_source.h"
#include "app/session/session.h"
#include "app/session/study_job.h"
#include "app/terminal/charts.h"
#include "app/terminal/workbench.h"

typedef enum {
  SB_PAGE_VALVE,
  SB_PAGE_DESIGN,
  SB_PAGE_CALIBRATE,
  SB_PAGE_PROPELLANTS,
  SB_PAGE_COUNT
} SbPage;

typedef enum { SB_LIST_MAIN, SB_LIST_CHANGED, SB_LIST_ALL, SB_LIST_COUNT } SbListKind;

// What a line of text is being typed for.
typedef enum {
  SB_INPUT_NONE,
  SB_INPUT_VALUE,
  SB_INPUT_SEARCH,
  SB_INPUT_SAVE,
  SB_INPUT_EXPORT,
  SB_INPUT_OPEN
} SbInput;

typedef enum {
  SB_POPUP_NONE,
  SB_POPUP_HELP,
  SB_POPUP_VERDICT,
  SB_POPUP_WARNINGS,
  SB_POPUP_QUIT,
  SB_POPUP_RESTORE,
  SB_POPUP_DISK // another program has changed the file
} SbPopup;

enum { SB_HEADING_ROW = -1, SB_PLAY_S = 10 }; // the latter: one cycle

// A line of the list: a parameter, or the heading of those that follow.
typedef struct {
  int id; // SB_HEADING_ROW
  const char *title;
} SbListRow;

typedef struct {
  SbSession *session;
  SbAutosave *autosave;
  SbScreen *screen;
  GMainLoop *loop;
  guint tick, draw;  // sources, 0 if none
  bool begun, ended; // begun: a screen was sent

  SbCellTheme theme;
  SbCells cells;
  SbPage page;
  SbPopup popup;
  int popup_scroll;
  char *message; // of the last action; NULL: none
  bool message_fails;
  gint64 looked;    // at the file on disk [us]
  SbDiskState disk; // as the user was last asked about it
  char *orphan;     // unsaved changes of another process, that are asked about

  // The list.
  SbListKind list;
  GString *search;
  GArray *rows; // of SbListRow
  int selected; // parameter
  int scroll;
  SbCellRect list_at, timeline_at; // where the last picture has them, for the mouse

  // The line that is typed.
  SbInput input;
  GString *typed;
  int caret; // in characters

  // The section.
  SbSectionSource *source;
  SbDrawList drawing;
  SbText *text;
  SbField field;
  SbSectionZoom zoom;
  bool solved;     // the last picture has fields in its rings
  GString *pixels; // for the terminal; NULL: none
  SbCellRect pixels_at;

  SbEffectWatch *effects; // what parameters do to the goal
  int goal;

  // Studies.
  SbStudyKind study_kind; // chosen
  SbStudyJob *job;
  SbStudyKind job_kind;
  SbStudy *study; // shown, NULL: none yet
  char *study_hash, *job_hash;

  SbExportJob *export; // under way; NULL: none
  SbCasesJob *cases;   // of the shown run, where the scene has cases; NULL: none
} SbBench;

// workbench.c
void sb_bench_changed(SbBench *bench); // draws soon
void sb_bench_say(SbBench *bench, bool fails, const char *format, ...) G_GNUC_PRINTF(3, 4);
void sb_bench_end(SbBench *bench);
SbPen sb_bench_pen(const SbBench *bench, SbRole role, uint8_t style);

// workbench_params.c
void sb_bench_list(SbBench *bench); // what is listed
void sb_bench_draw_list(SbBench *bench, SbCellRect rect);
void sb_bench_move(SbBench *bench, int rows); // the selection
void sb_bench_select(SbBench *bench, int id);

// workbench_valve.c
// An answer of the verdict over all cases and the case that gives it (NULL name: the scene itself).
SbCaseVerdict sb_bench_verdict(SbBench *bench, int kind);
void sb_bench_draw_header(SbBench *bench);
void sb_bench_draw_verdict(SbBench *bench, int y);
void sb_bench_draw_valve(SbBench *bench, SbCellRect rect);
void sb_bench_draw_status(SbBench *bench, int y);

// workbench_pages.c
void sb_bench_draw_page(SbBench *bench, SbCellRect rect);
void sb_bench_draw_popup(SbBench *bench);
void sb_bench_study_start(SbBench *bench);
void sb_bench_study_stop(SbBench *bench);

// workbench_export.c
void sb_bench_export(SbBench *bench, const char *text); // "loop.png hysteresis"

// workbench_keys.c
void sb_bench_key(SbBench *bench, const SbKey *key);
