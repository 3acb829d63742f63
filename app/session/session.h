// What a window works on: one document, the run that belongs to it, and the playhead. Widgets read
// it and listen to it; they never talk to each other.
//
// Signals (all on the main thread):
//   "params-changed"    a value, a field error, or the document's name or edited state changed
//   "run-changed"       the state of the run, or which run is shown, changed
//   "frames-changed"    the shown run has more frames (at most once per drawn frame)
//   "progress-changed"  a run is on its way of which nothing new is shown (once per drawn frame)
//   "playhead-changed"  the shown frame, or whether it plays, changed
#pragma once

#include "app/chart/data.h"
#include "app/data/measured.h"
#include "app/document/document_disk.h"
#include "app/run/runner.h"
#include "app/session/displayed_run.h"
#include "engine/valve/sealbench.h"

#include <gio/gio.h>

#define SB_TYPE_SESSION (sb_session_get_type())
G_DECLARE_FINAL_TYPE(SbSession, sb_session, SB, SESSION, GObject)

typedef enum {
  SB_SESSION_EMPTY,   // nothing has run
  SB_SESSION_RUNNING, // a run is under way (or about to start)
  SB_SESSION_DONE,    // the shown run is complete and belongs to the values
  SB_SESSION_PARTIAL, // the shown run was cancelled: its frames so far stand. A run cancelled
                      // before its first frame leaves the shown run, and its state, as they are
  SB_SESSION_FAILED   // the last run failed; the last good state is shown
} SbSessionState;

// An untitled valve with all defaults, nothing run.
SbSession *sb_session_new(void);

// The document -----------------------------------------------------------------------------------

// Borrowed; read only. Edits go through the session.
const SbDocument *sb_session_document(SbSession *session);

// Opens a file in place of the present document. On failure nothing changes and `issues` (of
// SbIssue) says why; issues of a file that opened all the same are added as well.
gboolean sb_session_open(SbSession *session, const char *path, GPtrArray *issues);

// Whether the files of the document have errors: nothing is computed from them, and
// sb_session_failure() names the errors.
gboolean sb_session_is_faulty(const SbSession *session);

// Restores unsaved changes of an earlier process: opens `path` (NULL: an untitled valve) and makes
// the changes that lead from `base`, the text of that file at the time, to `text`. `base` NULL: the
// document becomes `text`. The changes are to be saved and can be undone. Where the file has
// changed since and both changed one key, the restored value is used and a line is added to
// `conflicts` (of char *; may be NULL). FALSE with issues if a text cannot be read; the session
// stays as it is.
gboolean sb_session_restore(SbSession *session, const char *path, const char *base,
                            const char *text, GPtrArray *conflicts, GPtrArray *issues);

// Writes the document to `path` (NULL: where it came from). SB_APP_ERROR_CHANGED, and nothing is
// written, where that is the document's own file and another program has changed it since it was
// read or saved: the user decides (sb_session_reload() and on). SB_APP_ERROR_IO.
gboolean sb_session_save(SbSession *session, const char *path, GError **error);

// The document's file on disk (app/document/document_disk.h): as the last check found it; checks it
// now and emits "params-changed" where the state is another than before.
SbDiskState sb_session_disk_state(SbSession *session);
SbDiskState sb_session_check_disk(SbSession *session);

// What the user can do about a file that another program changed. Each but the last is one step
// that can be undone. FALSE: nothing has changed here, and issues or the error say why.
//   reload:    the document becomes what the file says
//   merge:     the same with the unsaved changes made in it, key by key; conflicts as above
//   keep both: writes this version to a new file next to it, with which the document goes on; the
//              file keeps the other version
//   save over: writes this version over the other one
gboolean sb_session_reload(SbSession *session, GPtrArray *issues);
gboolean sb_session_merge(SbSession *session, GPtrArray *conflicts, GPtrArray *issues);
gboolean sb_session_keep_both(SbSession *session, GError **error);
gboolean sb_session_save_over(SbSession *session, GError **error);

// A fresh untitled valve.
void sb_session_reset(SbSession *session);

// Puts measured data (taken over; NULL: none) in place of the document's, and reads them.
void sb_session_set_data(SbSession *session, SbData *data);

// The loop that was read, NULL: none, or not yet; and why its file could not be. Borrowed.
const SbMeasured *sb_session_measured(SbSession *session);
const char *sb_session_measured_failure(SbSession *session);

// Of the drive at present, for records over time alone [m/s]; 0: it has no constant one.
double sb_session_drive_speed(SbSession *session);

// Adds, changes or (`text` NULL) takes away what a review keeps with the document, as
// sb_document_put_remark(); a bookmark of the shown frame; shows the frame of a time [s].
gboolean sb_session_put_remark(SbSession *session, SbRemarkKind kind, const char *name,
                               const char *text, GError **error);
gboolean sb_session_put_bookmark(SbSession *session, const char *name, GError **error);
void sb_session_show_time(SbSession *session, double time);

gboolean sb_session_is_modified(SbSession *session);

// Where the cutaway is seen from in this window [rad]; the scene's own at first. No signal.
void sb_session_set_camera(SbSession *session, double azimuth, double elevation);
void sb_session_camera(SbSession *session, double *azimuth, double *elevation);

// Edits a value by text as people type it (app/document/typed.h). A text that cannot be taken stays
// as the field's error, and the value in force stays as it was.
gboolean sb_session_edit(SbSession *session, SbParamId id, const char *text);

// The same by value; successive calls merge into one undo step.
gboolean sb_session_edit_value(SbSession *session, SbParamId id, double value);

// Several values as one undo step; FALSE where one was out of range and left out.
gboolean sb_session_edit_values(SbSession *session, const SbOverride *override, size_t count);

// The next edit by value is a step of its own.
void sb_session_end_merge(SbSession *session);

// Names the rubber of both rings (NULL: the valve's again); false with an issue.
gboolean sb_session_set_rubber(SbSession *session, const char *name, GPtrArray *issues);

// Takes a section that was read from a file for both seals: seal.profile = file.
void sb_session_set_section(SbSession *session, const char *path, const SbSealDrawing *section,
                            double height);

// Takes a groove's outline that was read from a file; path NULL: none.
void sb_session_set_groove(SbSession *session, const char *path, const SbGrooveDrawing *groove);

// The value of the valve, the parent or the catalogue again; clears the field's error.
void sb_session_unset(SbSession *session, SbParamId id);

// Each returns the parameter that changed, -1 if none did.
int sb_session_undo(SbSession *session);
int sb_session_redo(SbSession *session);

// What is wrong with a field: the sentence and the rejected text; NULL if nothing is. Borrowed
// until the next change.
const char *sb_session_error(SbSession *session, SbParamId id);
const char *sb_session_rejected(SbSession *session, SbParamId id);

// Number of fields with an error, and the one to name: the last edited if it has one, else the
// first
// (-1 if none).
int sb_session_error_count(SbSession *session);
int sb_session_first_error(SbSession *session);

// Drops a field's rejected text, so that the value in force stands again.
void sb_session_clear_error(SbSession *session, SbParamId id);

// The model of the present values; NULL while they do not go together. Borrowed until the next
// change.
const SbModel *sb_session_model(SbSession *session);

// Why a parameter is locked now (it would have no effect, or a run holds it); NULL if it is not.
const char *sb_session_lock(SbSession *session, SbParamId id);

// The run
// ------------------------------------------------------------------------------------------

SbSessionState sb_session_state(SbSession *session);

// Share of the run under way that is done, 0 to 1.
double sb_session_progress(SbSession *session);

// How long the last edit took until its run was predicted, and until a run of its values was
// shown, whatever its grade [s]; NaN: it was not, or not yet.
typedef struct {
  double predicted, shown;
} SbEditLatency;
SbEditLatency sb_session_latency(SbSession *session);

// Starts a run of the present values now (without the delay that edits wait for).
void sb_session_start(SbSession *session);

// Cancels the run under way; its frames so far stay. Does nothing if none is.
void sb_session_stop(SbSession *session);

// Whether edits start runs by themselves.
void sb_session_set_auto_run(SbSession *session, gboolean on);

// The shown run and how many of its frames are there; NULL if nothing is shown. Borrowed until the
// next "run-changed".
const SbRun *sb_session_run(SbSession *session);
const SbFrame *sb_session_frames(SbSession *session, size_t *count);

// How the shown run was solved, and that in words for the user (g_free()): NULL of a whole run,
// whose figures are those of `sealbench run`.
SbRunGrade sb_session_grade(SbSession *session);
char *sb_session_grade_text(SbSession *session);

// Whether the shown run may be exported: it has ended and is a whole one.
gboolean sb_session_may_keep(SbSession *session);

// An edit of a parameter is about to begin: what its run will be is made ready in the background,
// before that of other parameters, where runs take long.
void sb_session_prepare(SbSession *session, SbParamId id);

// The shown run for others to keep, once it may be kept: a reference for the caller; NULL before.
SbRunHandle *sb_session_handle(SbSession *session);

// The shown run's summary; NULL while it is computed.
const SbSummary *sb_session_summary(SbSession *session);

// That of the present values as predicted, figures and verdict, while the shown run is of others
// (prediction.h); NULL where nothing is predicted. Loop and contacts are in sb_session_chart().
const SbSummary *sb_session_predicted(SbSession *session);

// Designs that are kept to compare with ----------------------------------------------------------
//
// They are saved with the document ([pins]), each with all its values. At most SB_CHART_PINS are
// drawn beside the live run (SbChartData.pin), all are in tables. Signals: "run-changed" when one
// comes, goes, or has its run; "params-changed" as well where there is something to save.

// Keeps the shown run, which must be a whole one of the present values; FALSE where it is not.
gboolean sb_session_may_pin(SbSession *session);
gboolean sb_session_pin(SbSession *session);

// Keeps the present design with other values in place of some, whose run is then computed; FALSE
// where one is out of range.
gboolean sb_session_pin_values(SbSession *session, const SbOverride *override, size_t count);

size_t sb_session_pin_count(SbSession *session);
void sb_session_unpin(SbSession *session, size_t index);

// Its own name, else what it differs in from the present values ("section diameter 1.63 mm").
// Borrowed until the next change. An empty name gives it up.
const char *sb_session_pin_name(SbSession *session, size_t index);
void sb_session_rename_pin(SbSession *session, size_t index, const char *name);

// The look it is drawn with, 0 to SB_CHART_PINS - 1; -1: it is not. Drawing one more than there are
// looks takes that of the oldest.
int sb_session_pin_slot(SbSession *session, size_t index);
void sb_session_draw_pin(SbSession *session, size_t index, gboolean on);

// Its run, name as pictures have it, look and the frame that stands where the playhead does; FALSE
// while there is no run. Borrowed until the next signal.
gboolean sb_session_pin_chart(SbSession *session, size_t index, SbChartPin *out);

// The run itself for others to keep: a reference for the caller, NULL while there is none.
SbRunHandle *sb_session_pin_handle(SbSession *session, size_t index);

// NULL while its run is computed, or if there is none (`failed`).
const SbSummary *sb_session_pin_summary(SbSession *session, size_t index);
gboolean sb_session_pin_failed(SbSession *session, size_t index);

// Makes its values the present ones, as one step that can be undone; its run is shown at once.
void sb_session_use_pin(SbSession *session, size_t index);

// True if the shown run is not of the present values; then `*id` is a parameter in which it differs
// (-1 if several do) and `*value` the shown run's value [SI].
gboolean sb_session_is_stale(SbSession *session, int *id, double *value);

// True while the pictures are of former values and no run is about to replace them: views then show
// them paler. The text names that run, "run with modulus 2.5 MPa" (g_free), and is NULL otherwise.
gboolean sb_session_shows_former(SbSession *session);

// True while they are and a run of the present values is computed: what is new in a picture but the
// prediction can wait for it, which needs the processors.
gboolean sb_session_awaits(SbSession *session);
char *sb_session_former_text(SbSession *session);

// The same as a sentence for pictures: "stale: this run is with modulus 2.5 MPa"; NULL if the shown
// run is of the present values. Owned by the caller (g_free).
char *sb_session_stale_text(SbSession *session);

// All that views of app/chart are given. Borrowed; its pointers hold until the next signal.
const SbChartData *sb_session_chart(SbSession *session);

// What went wrong in the last run, one sentence with residual, time and parameter; NULL if nothing
// did.
const char *sb_session_failure(SbSession *session);

// The playhead -----------------------------------------------------------------------------------

// Shows a frame by its index, or the last one.
void sb_session_set_playhead(SbSession *session, size_t frame);

// Shows the instant at a share of the way from a stage of the first cycle to what follows it; stays
// where it is if the run does not reach it.
void sb_session_show_stage(SbSession *session, SbStage stage, double share);

// The shown frame, or NULL.
const SbFrame *sb_session_frame(SbSession *session);

// Moves by frames, or to the next or previous event.
void sb_session_step(SbSession *session, int frames);
void sb_session_step_event(SbSession *session, int direction);

gboolean sb_session_is_playing(SbSession *session);
void sb_session_play(SbSession *session, gboolean on);
gboolean sb_session_loops(SbSession *session);
void sb_session_set_loops(SbSession *session, gboolean on);

// How long one cycle takes to play [s].
void sb_session_set_play_duration(SbSession *session, double seconds);

// To be called once per drawn frame with the frame clock's time [us]: takes over what the runner
// has published and moves the playhead.
void sb_session_tick(SbSession *session, gint64 now);

// True while sb_session_tick() has something to do.
gboolean sb_session_wants_ticks(SbSession *session);

// "stage C, 3.30 mm, 27.4 N" of the shown frame, "" if there is none. Owned by the caller.
char *sb_session_where(SbSession *session);
