// The inside of a session, shared by session.c (document), session_run.c (runs), session_pins.c
// (designs kept to compare with), session_shown.c
// (what is shown of them), session_slope.c (what is predicted) and session_playhead.c (playhead).
#pragma once

#include "app/session/displayed_run.h"
#include "app/session/measure_job.h"
#include "app/session/playhead.h"
#include "app/session/prediction.h"
#include "app/session/run_cache.h"
#include "app/session/session.h"
#include "app/session/slope_job.h"
#include "app/session/tangent.h"

typedef enum {
  SB_SIGNAL_PARAMS,
  SB_SIGNAL_RUN,
  SB_SIGNAL_FRAMES,
  SB_SIGNAL_PROGRESS,
  SB_SIGNAL_PLAYHEAD,
  SB_SIGNAL_COUNT
} SbSessionSignal;

typedef struct SbSessionInbox SbSessionInbox;

struct _SbSession {
  GObject parent_instance;

  // The document and what is wrong with its fields.
  SbDocument *document; // owned
  SbDiskState disk;     // as sb_session_check_disk() last found it
  char *rejected[SB_PARAM_COUNT];
  char *error[SB_PARAM_COUNT];
  int last_edited; // parameter, or -1
  SbModel *model;  // of the present values, owned; NULL: they do not go together

  // Runs. `fresh` is what the runner computes; `shown` is what the pictures show: `fresh` as soon
  // as it is worth it, else the run before.
  SbRunner *runner; // owned
  SbSessionInbox *inbox;
  unsigned ticket;         // of the request under way; 0 if none is
  SbParams asked;          // its values
  uint64_t asked_drawings; // and what files draw
  SbRunGrade grade;        // its
  SbDisplayedRun *fresh, *shown, *earlier;
  SbSessionState state;
  char *failure;
  gboolean faulty; // it is of the document's files, which have errors
  gboolean auto_run;
  guint debounce;  // source of the delayed start
  guint later;     // source of the whole run after a near one
  gboolean heavy;  // runs of the present values come in grades
  gboolean former; // the displayed run is of former values, and stays
  SbRunCache *cache;
  char *runs; // folder of kept runs, owned; NULL: those that ship

  // What other values' rings start from, and what is predicted of their runs.
  SbDisplayedRun *base; // the last whole run of solved rings, NULL: none
  SbPrediction *prediction;
  gboolean predicted;       // it is of the present values
  SbRunner *slopes;         // owned, NULL until it is needed
  unsigned slope_ticket;    // of the run beside the base under way; 0 if none is
  int slope_id;             // its parameter, SB_SLOPE_LEVEL of no change
  SbParams slope_params;    // its values
  SbDisplayedRun *slope_up; // that to the one side, while the other is under way; NULL: none
  bool slope_down;          // the other side is what is under way
  SbSlopeJob *slope_job;    // derivatives of the base's figures, owned; NULL: none so far
  int slope_first;          // parameter that is edited: the first whose slopes are found; -1: none

  // Kept designs, one a pin of the document.
  GPtrArray *pins;             // see session_pins.c
  size_t drawn[SB_CHART_PINS]; // those in `chart`
  SbRunner *pin_runner;        // owned, NULL until it is needed
  unsigned pin_ticket;         // of the one that is computed; 0 if none is
  size_t pin_index;

  // What was measured, and what it differs by from a run (held; NULL: not compared).
  SbMeasureJob *measuring;
  SbMeasured *measured;
  SbComparison *comparison;
  SbRunHandle *compared;
  char *measured_failure;

  gint64 started; // [us]
  gint64 edited;  // when the values last changed [us], 0 once their run is shown
  bool lone;      // that one was not one of several at a time
  SbEditLatency latency;

  double azimuth, elevation; // of the cutaway's camera [rad]

  SbPlayhead playhead;
  SbChartData chart;      // what views are given
  SbChartMarker *markers; // owned: the document's bookmarks, for the chart
  char *hash;
};

// Takes another document (taken over) in the place of the present one, whose history ends.
void sb_session_replace_document(SbSession *session, SbDocument *document);

// All of the document is another, by a step that can be undone.
void sb_session_whole_changed(SbSession *session);

void sb_session_emit(SbSession *session, SbSessionSignal signal);

// After each change of values: asks for a run soon.
void sb_session_values_changed(SbSession *session);

// Tells the views and listeners that the playhead, or whether it plays, is another.
void sb_session_playhead_changed(SbSession *session);

// Another set of values has come from elsewhere: refused texts go, a run follows.
void sb_session_document_changed(SbSession *session);

// The kept designs: makes them those of the document; names them by the present values; computes
// what is missing, once nothing else is wanted; gives them to the charts, and their frames; a run
// of theirs that answers values (NULL: none).
void sb_session_init_pins(SbSession *session);
void sb_session_dispose_pins(SbSession *session);
void sb_session_load_pins(SbSession *session);
void sb_session_name_pins(SbSession *session);
void sb_session_poll_pins(SbSession *session);
void sb_session_chart_pins(SbSession *session);
void sb_session_place_pins(SbSession *session);
SbDisplayedRun *sb_session_pinned_answer(SbSession *session, const SbParams *params);

// Whether all values are equal.
bool sb_session_same_values(const SbParams *a, const SbParams *b);

// Of the present model, sb_model_drawings(); 0: there is none. And whether a run is of these values
// and drawings.
uint64_t sb_session_drawings(const SbSession *session);
bool sb_session_run_is_of(const SbDisplayedRun *run, const SbParams *params, uint64_t drawings);

// Forgets runs and the playhead (another document).
void sb_session_clear_runs(SbSession *session);

// Takes a reference to `value` (NULL: none) in place of the one in *run.
void sb_session_hold(SbDisplayedRun **run, SbDisplayedRun *value);

// What the displayed run is; whether it is of the present values is another question.
SbSessionState sb_session_shown_state(const SbSession *session);
gboolean sb_session_is_former(SbSession *session);
void sb_session_refresh_chart(SbSession *session);
void sb_session_refresh_markers(SbSession *session);
void sb_session_run_changed(SbSession *session);

// Reads the document's data anew; what is compared with the shown run, NULL: nothing; forgets both.
void sb_session_read_measured(SbSession *session);
const SbComparison *sb_session_compare(SbSession *session);
void sb_session_clear_measured(SbSession *session);

// SbRunnerNotify; `data` is the session's inbox.
void sb_session_notify(void *data);

// Predicts the run of the present values, if the shown one is not theirs; turns it to the playhead.
void sb_session_predict(SbSession *session);
void sb_session_place_predicted(SbSession *session);

// Takes a complete run as the base, if it is one.
void sb_session_set_base(SbSession *session, SbDisplayedRun *run);
void sb_session_drop_base(SbSession *session);

// Looks whether a run beside the base is there; goes on with what is wanted of them now.
enum { SB_SLOPE_LEVEL = -1, SB_SLOPE_NONE = -2 };
void sb_session_poll_slope(SbSession *session);
void sb_session_find_slopes(SbSession *session);

// The frame of a run that stands where the playhead does in the displayed one.
size_t sb_session_frame_of(SbSession *session, const SbDisplayedRun *run);

// The window shows everything: the views of the scene do not limit it.
#define SB_SESSION_VIEWS (SB_VIEW_HYSTERESIS | SB_VIEW_PROFILES | SB_VIEW_SECTION)

// A run that lasts longer is shown while it grows [us].
enum { SB_SESSION_WATCH_US = 120000 };

void sb_session_init_runs(SbSession *session);
void sb_session_dispose_runs(SbSession *session);
