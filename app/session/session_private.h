// Shared by the files of the session: session.c (document), session_disk.c (its file),
// session_measured.c, session_remarks.c, session_request.c (requests of runs), session_run.c (their
// results), session_pins.c (saved designs), session_shown.c (the displayed run), session_slope.c
// (predictions) and session_playhead.c. Main thread only, except sb_session_notify().
#pragma once

#include "app/session/displayed_run.h"
#include "app/session/measure_job.h"
#include "app/session/playhead.h"
#include "app/session/prediction.h"
#include "app/session/run_cache.h"
#include "app/session/session.h"
#include "app/session/slope_job.h"
#include "app/session/tangent.h"

// The signals of session.h, in its order.
typedef enum {
  SB_SIGNAL_PARAMS,
  SB_SIGNAL_RUN,
  SB_SIGNAL_FRAMES,
  SB_SIGNAL_PROGRESS,
  SB_SIGNAL_PLAYHEAD,
  SB_SIGNAL_COUNT
} SbSessionSignal;

// What happens to the run of the present values. sb_session_go() has the transitions,
// docs/developer/session.md their diagram.
typedef enum {
  SB_REQUEST_NONE,      // nothing
  SB_REQUEST_DELAYED,   // the timer starts it
  SB_REQUEST_COMPUTED,  // it is computed
  SB_REQUEST_OVERTAKEN, // a run of earlier values is computed; the timer starts the new one
  SB_REQUEST_PAUSED     // a near run of it is displayed; the timer starts the full run
} SbRequestState;

// Where the runners' threads leave their notifications (session_run.c).
typedef struct SbSessionInbox SbSessionInbox;

struct _SbSession {
  GObject parent_instance;

  // The document and the errors of its fields.
  SbDocument *document;                  // owned
  SbDiskState disk;                      // as sb_session_check_disk() last found it
  char *rejected[SB_PARAM_COUNT];        // text of a field that was rejected; NULL: none
  char *error[SB_PARAM_COUNT];           // why; NULL: no error
  gboolean out_of_range[SB_PARAM_COUNT]; // the rejected text is a number outside the range
  int last_edited;                       // SbParamId; -1: none
  SbModel *model; // of the present values, owned; NULL: they are inconsistent

  // Runs. `fresh` is being computed by the runner; `shown` is displayed: `fresh` as soon as it has
  // enough frames, until then the run before. References; NULL: none.
  SbRunner *runner; // owned
  SbSessionInbox *inbox;
  SbRequestState request;
  guint timer;             // GLib source: of `request`, or of the signal "run-changed"; 0: none
  unsigned ticket;         // of the run that is computed; 0: none
  SbParams asked;          // values of this request
  uint64_t asked_drawings; // sb_model_drawings() of this request
  SbRunGrade grade;        // of this request
  SbDisplayedRun *fresh, *shown, *earlier;
  char *failure;     // see sb_session_failure()
  gboolean faulty;   // `failure` states errors of the document's files
  gboolean auto_run; // edits start runs
  gboolean heavy;    // runs of the present values are computed in several grades
  gboolean former;   // see sb_session_shows_former()
  SbRunCache *cache;
  char *runs; // folder of stored runs; NULL: the shipped ones

  // Warm start and prediction.
  SbDisplayedRun *base;     // the last converged run with solved rings, a reference; NULL: none
  SbPrediction *prediction; // owned
  gboolean predicted;       // `prediction` is for the present values
  SbRunner *slopes;         // for perturbed runs, owned; NULL until it is needed
  unsigned slope_ticket;    // of the perturbed run that is computed; 0: none
  int slope_id;             // its SbParamId, SB_SLOPE_LEVEL or SB_SLOPE_NONE
  SbParams slope_params;    // its values
  SbDisplayedRun *slope_up; // run at p0 + h while that at p0 - h is computed; NULL: none
  bool slope_down;          // the run at p0 - h is computed
  SbSlopeJob *slope_job;    // derivatives of the base's figures, owned; NULL: none yet
  int slope_first;          // SbParamId whose derivatives are computed first; -1: none

  // Saved designs.
  GPtrArray *pins;             // one for each pin of the document (session_pins.c)
  size_t drawn[SB_CHART_PINS]; // index of each pin in `chart`
  SbRunner *pin_runner;        // owned; NULL until it is needed
  unsigned pin_ticket;         // of the pin's run that is computed; 0: none
  size_t pin_index;            // that pin

  // Measured data, and the comparison with the displayed run.
  SbMeasureJob *measuring;  // reading; NULL: none
  SbMeasured *measured;     // owned; NULL: none
  SbComparison *comparison; // with `compared`, owned; NULL: none
  SbRunHandle *compared;    // a reference
  char *measured_failure;   // why the data could not be read; NULL: no failure

  gint64 started; // time at which the run was requested [us]
  gint64 edited;  // time of the last edit [us]; 0 once its run is displayed
  bool lone;      // at the last edit no run of an earlier edit was awaited
  SbEditLatency latency;

  double azimuth, elevation; // of the cutaway's camera [rad]

  SbPlayhead playhead;
  SbChartData chart;      // see sb_session_chart()
  SbChartMarker *markers; // the document's bookmarks, for the chart
  char *hash;             // sb_document_sha256() of the present values
};

// ---- The document ----

// Replaces the document by `document`, which the session owns from now on. Not an edit: undo starts
// again.
void sb_session_replace_document(SbSession *session, SbDocument *document);

// Updates everything after a step that changed the full document (SB_DOCUMENT_WHOLE).
void sb_session_whole_changed(SbSession *session);

// Emits a signal.
void sb_session_emit(SbSession *session, SbSessionSignal signal);

// Called after each change of values: requests a run after a short delay.
void sb_session_values_changed(SbSession *session);

// Called after the values were changed by something else than a field: removes rejected texts,
// compiles and requests a run.
void sb_session_document_changed(SbSession *session);

// ---- Saved designs (session_pins.c) ----

// Creates the empty list.
void sb_session_init_pins(SbSession *session);

// Frees the list and the runner.
void sb_session_dispose_pins(SbSession *session);

// Replaces the list by the pins of the document, without runs.
void sb_session_load_pins(SbSession *session);

// Updates the names that state differences from the present values.
void sb_session_name_pins(SbSession *session);

// Takes over the run that was computed, and starts the next missing one unless another run is
// wanted.
void sb_session_poll_pins(SbSession *session);

// Sets the pins of session->chart.
void sb_session_chart_pins(SbSession *session);

// Sets the frame of each pin of session->chart to the position of the playhead.
void sb_session_place_pins(SbSession *session);

// ---- Runs ----

// Returns sb_model_drawings() of the present model; 0: there is none.
uint64_t sb_session_drawings(const SbSession *session);

// Initialises the members for runs.
void sb_session_init_runs(SbSession *session);

// Ends the threads and releases all runs.
void sb_session_dispose_runs(SbSession *session);

// Releases all runs and resets the playhead, for another document.
void sb_session_clear_runs(SbSession *session);

// Replaces the reference in *run by a new reference to `value` (NULL: none).
void sb_session_set_reference(SbDisplayedRun **run, SbDisplayedRun *value);

// An SbRunnerNotify, called in the runners' threads; `data` is the session's inbox.
void sb_session_notify(void *data);

// Gives the playhead its place in the displayed run: that of sb_session_remember_place(), or as it
// follows or waits for the run.
void sb_session_place_playhead(SbSession *session);

// Stores the place of the playhead in the displayed run, before another one is displayed.
void sb_session_remember_place(SbSession *session);

// Displays session->fresh, which has frames; the run displayed before becomes session->earlier,
// which is drawn behind it. The caller places the playhead.
void sb_session_display_fresh(SbSession *session);

// ---- Requests of runs (session_request.c) ----

// Makes `to` the state of the request. Its timer ends, except that of an overtaken run that is now
// delayed; `ticket` ends where nothing is computed. A transition that there is not is a programming
// error (g_critical), and nothing changes.
void sb_session_go(SbSession *session, SbRequestState to);

// Returns whether a run is computed, of the present or of earlier values.
bool sb_session_computes(const SbSession *session);

// Returns whether the timer is going to start a run of the present values, of which nothing is
// computed yet.
bool sb_session_delays(const SbSession *session);

// Returns whether a run (NULL: no) is complete and belongs to values and drawings
// (sb_model_drawings()).
bool sb_session_answers(const SbDisplayedRun *run, const SbParams *params, uint64_t drawings);

// Returns whether the last request was for the present values and drawings.
bool sb_session_is_current(const SbSession *session);

// Requests a run of the present values, which make a model. If there is no run of this grade, or it
// would save no time, the next better grade is used.
void sb_session_submit(SbSession *session, SbRunGrade grade);

// Requests the grade that follows the displayed run of the present values, or does so later.
void sb_session_continue(SbSession *session);

// Stores a complete run of the present values for reuse, and makes it the base of ring states and
// of derivatives.
void sb_session_keep_run(SbSession *session, SbDisplayedRun *run);

// ---- What is displayed ----

// Returns whether the displayed run belongs to earlier values and will not be replaced soon.
gboolean sb_session_is_former(SbSession *session);

// Sets all members of session->chart.
void sb_session_refresh_chart(SbSession *session);

// Sets the bookmarks of session->chart.
void sb_session_refresh_markers(SbSession *session);

// Called after the displayed run or its state changed: updates prediction and chart, and emits
// "run-changed".
void sb_session_run_changed(SbSession *session);

// Called after the playhead moved, or started or stopped: updates the chart and emits
// "playhead-changed".
void sb_session_playhead_changed(SbSession *session);

// Returns the frame of `run` at the position of the playhead in the displayed run; 0: none.
size_t sb_session_frame_of(SbSession *session, const SbDisplayedRun *run);

// ---- Measured data (session_measured.c) ----

// Starts to read the document's measured data.
void sb_session_read_measured(SbSession *session);

// Returns the comparison with the displayed run; NULL: none.
const SbComparison *sb_session_compare(SbSession *session);

// Frees data and comparison.
void sb_session_clear_measured(SbSession *session);

// ---- Predictions and derivatives (session_slope.c) ----

// Predicts the run of the present values unless the displayed run belongs to them.
void sb_session_predict(SbSession *session);

// Moves the prediction to the position of the playhead.
void sb_session_place_predicted(SbSession *session);

// Makes a complete run the base for warm start and predictions, if it is suitable.
void sb_session_set_base(SbSession *session, SbDisplayedRun *run);

// Releases the base and what was computed from it.
void sb_session_drop_base(SbSession *session);

// slope_id of the run without a change, and without a run.
enum { SB_SLOPE_LEVEL = -1, SB_SLOPE_NONE = -2 };

// Takes over a perturbed run that has ended.
void sb_session_poll_slope(SbSession *session);

// Starts the next perturbed run or derivatives that are missing, unless another run is computed.
void sb_session_find_slopes(SbSession *session);

// Views that are computed: all that the window shows, whatever the scene selects.
#define SB_SESSION_VIEWS (SB_VIEW_HYSTERESIS | SB_VIEW_PROFILES | SB_VIEW_SECTION)

// A run that takes longer is displayed while it grows [us].
enum { SB_SESSION_WATCH_US = 120000 };
