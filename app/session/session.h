// The state of a window: one document, the run of its values, and the playhead. Widgets read the
// session and connect to its signals; they do not call each other.
//
// Signals, without arguments, emitted in the main thread:
//   "params-changed"    a value, a field error, the document's name or its edited state changed
//   "run-changed"       the state of the run, or which run is displayed, changed
//   "frames-changed"    the displayed run has more frames (at most once per drawn frame)
//   "progress-changed"  a run that displays nothing new has progressed (once per drawn frame)
//   "playhead-changed"  the displayed frame changed, or playing started or stopped
//
// All functions are called in the main thread. Pointers that they return are borrowed until the
// session's next signal unless stated otherwise. Edits emit signals before they return. A handler
// of a signal may call all functions of the session; what it changes emits further signals.
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

// State of the run.
typedef enum {
  SB_SESSION_EMPTY,   // no run yet
  SB_SESSION_RUNNING, // a run is being computed, or about to start
  SB_SESSION_DONE,    // the displayed run is complete; without automatic runs, or with inconsistent
                      // values, it can be of earlier values (sb_session_is_stale())
  SB_SESSION_PARTIAL, // the displayed run was cancelled; its frames so far remain. A run that was
                      // cancelled before its first frame changes neither the displayed run nor this
  SB_SESSION_FAILED // the last run failed, and the last good state is displayed; or the files have
                    // errors (sb_session_is_faulty())
} SbSessionState;

// Returns a session with an untitled valve with all defaults, without a run. Freed by
// g_object_unref().
SbSession *sb_session_new(void);

// ---- The document ----

// Returns the document, for reading only: edits are made by the functions below.
const SbDocument *sb_session_document(SbSession *session);

// Opens a valve or scene file in place of the document. Returns FALSE without a change, with at
// least one issue (SbIssue), if it cannot be read. The issues of a file that was opened are
// appended, too (sb_session_is_faulty()).
gboolean sb_session_open(SbSession *session, const char *path, GPtrArray *issues);

// Returns whether the files of the document have errors: then nothing is computed, and
// sb_session_failure() states the errors.
gboolean sb_session_is_faulty(const SbSession *session);

// Restores unsaved changes of an earlier process: opens `path` (NULL: an untitled valve) and
// applies the changes from `base`, the text of that file at that time, to `text`. `base` NULL: the
// document becomes `text`. The changes count as unsaved and can be undone. If the file has changed
// since and both changed one key, the restored value is used and a line is appended to `conflicts`
// (of char *; may be NULL). Returns FALSE without a change, with issues, if a text cannot be read.
gboolean sb_session_restore(SbSession *session, const char *path, const char *base,
                            const char *text, GPtrArray *conflicts, GPtrArray *issues);

// Writes the document to `path` (NULL: to its own file, which it must have). Returns FALSE, with
// nothing written: SB_APP_ERROR_CHANGED if that is the document's own file and another program has
// changed it since it was read or saved (the user decides, see sb_session_reload());
// SB_APP_ERROR_IO if it fails.
gboolean sb_session_save(SbSession *session, const char *path, GError **error);

// Returns the state of the document's file on disk as the last check found it.
SbDiskState sb_session_disk_state(SbSession *session);

// Checks the document's file on disk and returns its state; emits "params-changed" if that changed.
SbDiskState sb_session_check_disk(SbSession *session);

// The four functions below are what the user can do about a file that another program changed. All
// but the last are one step for undo. They return FALSE without a change of the document, with
// issues or an error, if they fail. The document must have a path.

// Replaces the document by the content of its file.
gboolean sb_session_reload(SbSession *session, GPtrArray *issues);

// Replaces the document by the content of its file with the unsaved changes applied, key by key;
// `conflicts` as in sb_session_restore().
gboolean sb_session_merge(SbSession *session, GPtrArray *conflicts, GPtrArray *issues);

// Writes the document to a new file next to its own, which becomes its path; its former file keeps
// the other version.
gboolean sb_session_keep_both(SbSession *session, GError **error);

// Writes the document over the version of its file.
gboolean sb_session_save_over(SbSession *session, GError **error);

// Replaces the document by an untitled valve.
void sb_session_reset(SbSession *session);

// Replaces the document's measured data by `data`, which the session owns from now on (NULL: none),
// and reads its file in the background. Can be undone.
void sb_session_set_data(SbSession *session, SbData *data);

// Returns the measured loop; NULL: none, not read yet, or not readable.
const SbMeasured *sb_session_measured(SbSession *session);

// Returns why the measured data could not be read; NULL: no failure.
const char *sb_session_measured_failure(SbSession *session);

// Returns the speed of the present drive [m/s]; 0: not constant. sb_measured_read() requires it.
double sb_session_drive_speed(SbSession *session);

// Adds a bookmark (`text`: its time with unit) or a note, changes the text of an existing one, or
// removes it (`text` NULL). Returns FALSE with SB_APP_ERROR_INPUT, without a change, if the name or
// the text is not allowed or there are too many.
gboolean sb_session_put_remark(SbSession *session, SbRemarkKind kind, const char *name,
                               const char *text, GError **error);

// Adds a bookmark `name` at the time of the displayed frame. Returns FALSE with SB_APP_ERROR_INPUT
// if there is no frame, or as sb_session_put_remark().
gboolean sb_session_put_bookmark(SbSession *session, const char *name, GError **error);

// Stops playing and moves the playhead to the frame that is nearest to a time [s]. Does nothing
// without frames.
void sb_session_show_time(SbSession *session, double time);

// Returns whether the document differs from its file.
gboolean sb_session_is_modified(SbSession *session);

// Sets the direction from which this window shows the cutaway [rad]. Emits no signal.
void sb_session_set_camera(SbSession *session, double azimuth, double elevation);

// Writes this direction [rad].
void sb_session_camera(SbSession *session, double *azimuth, double *elevation);

// ---- Edits: each can be undone and leads to a new run if automatic runs are on ----

// Sets a value from text that the user typed (app/document/typed.h). Returns FALSE if the text is
// wrong: the value in force does not change, and the text and its error are stored for the field
// (sb_session_error()).
gboolean sb_session_edit(SbSession *session, SbParamId id, const char *text);

// Sets a value [SI]. Successive calls for the same parameter are one step for undo, until
// sb_session_end_merge(). Returns FALSE, with the value in force unchanged, if it is out of range.
gboolean sb_session_edit_value(SbSession *session, SbParamId id, double value);

// Sets override[count] as one step for undo. Returns FALSE if one was out of range and therefore
// not set.
gboolean sb_session_edit_values(SbSession *session, const SbOverride *override, size_t count);

// Ends a series of sb_session_edit_value(): the next one is a step of its own.
void sb_session_end_merge(SbSession *session);

// Sets the rubber of both rings by name (NULL: that of the valve). Returns FALSE with an issue if
// there is none.
gboolean sb_session_set_rubber(SbSession *session, const char *name, GPtrArray *issues);

// Sets the section of both seals to `section` with its radial height [m], as sb_seal_file_read()
// read them from `path`.
void sb_session_set_section(SbSession *session, const char *path, const SbSealDrawing *section,
                            double height);

// Sets the groove's outline as sb_groove_file_read() read it from `path`; `path` NULL removes it
// (only if sb_document_may_drop_groove()), and `groove` is not used.
void sb_session_set_groove(SbSession *session, const char *path, const SbGrooveDrawing *groove);

// Removes the document's own value, so that that of the valve, the parent or the catalogue is in
// force again, and the field's error.
void sb_session_unset(SbSession *session, SbParamId id);

// Reverts the last step. Returns the SbParamId that changed; -1 if none or something else changed.
int sb_session_undo(SbSession *session);

// Repeats the step that was reverted last. Returns as sb_session_undo().
int sb_session_redo(SbSession *session);

// Returns why the text of a field was rejected, a sentence; NULL: it was not. Borrowed until the
// next change.
const char *sb_session_error(SbSession *session, SbParamId id);

// Returns the rejected text of a field; NULL: none. Borrowed until the next change.
const char *sb_session_rejected(SbSession *session, SbParamId id);

// Returns whether the rejected text of a field is a number outside the range of the parameter.
gboolean sb_session_is_out_of_range(SbSession *session, SbParamId id);

// Returns the number of fields with an error.
int sb_session_error_count(SbSession *session);

// Returns the SbParamId of the field with an error to show: the last edited one if it has an error,
// else the first; -1: none.
int sb_session_first_error(SbSession *session);

// Removes a field's rejected text and error; the field then shows the value in force.
void sb_session_clear_error(SbSession *session, SbParamId id);

// Returns the model of the present values; NULL while they are inconsistent. Borrowed until the
// next change.
const SbModel *sb_session_model(SbSession *session);

// Returns why a parameter is locked (the chosen models do not use it, or a shape gives it), a
// translated sentence; NULL: it is not locked. Static.
const char *sb_session_lock(SbSession *session, SbParamId id);

// ---- The run ----

// Returns the state of the run.
SbSessionState sb_session_state(SbSession *session);

// Returns the fraction of the run that is being computed, 0 to 1; 0: none.
double sb_session_progress(SbSession *session);

// Times from the last edit until its run was predicted, and until a run of its values was
// displayed, whatever its grade [s]; NaN: not, or not yet.
typedef struct {
  double predicted, shown;
} SbEditLatency;

// Returns these times.
SbEditLatency sb_session_latency(SbSession *session);

// Starts a run of the present values immediately, without the delay after an edit.
void sb_session_start(SbSession *session);

// Cancels the run that is being computed or about to start; its frames so far remain. Does nothing
// if there is none.
void sb_session_stop(SbSession *session);

// Sets whether edits start runs (initially they do).
void sb_session_set_auto_run(SbSession *session, gboolean on);

// Returns the displayed run; NULL: none. Borrowed until the next "run-changed".
const SbRun *sb_session_run(SbSession *session);

// Returns the frames of the displayed run that are available, in the order of time, and their
// number in *count; NULL and 0: none. Borrowed until the next "run-changed".
const SbFrame *sb_session_frames(SbSession *session, size_t *count);

// Returns how the displayed run was computed; SB_GRADE_WHOLE without a run.
SbRunGrade sb_session_grade(SbSession *session);

// Returns how the displayed run was computed as a translated text; NULL for SB_GRADE_WHOLE, whose
// figures are those of `sealbench run`.
char *sb_session_grade_text(SbSession *session);

// Returns whether the displayed run can be exported: it has ended, with the grade SB_GRADE_WHOLE.
gboolean sb_session_may_keep(SbSession *session);

// States that the user is about to edit a parameter: its derivatives are computed in the background
// before those of others, if runs take long.
void sb_session_prepare(SbSession *session, SbParamId id);

// Returns a reference to the displayed run, released by sb_run_handle_unref(); NULL unless
// sb_session_may_keep().
SbRunHandle *sb_session_handle(SbSession *session);

// Returns the summary of the displayed run; NULL while it is computed and without a run.
const SbSummary *sb_session_summary(SbSession *session);

// Returns the predicted summary of the present values, with figures and verdict, while the
// displayed run belongs to other values (prediction.h); NULL: no prediction. The predicted loop and
// contacts are in sb_session_chart().
const SbSummary *sb_session_predicted(SbSession *session);

// ---- Pins: saved designs for comparison ----
//
// They are saved with the document ([pins]), each with all its values. At most SB_CHART_PINS are
// drawn with the live run (SbChartData.pin); all are in tables. "run-changed" is emitted when a pin
// is added or removed or has its run; "params-changed" as well if there is something to save.
// Indices count from 0.

// Returns whether the displayed run can be pinned: sb_session_may_keep() and it belongs to the
// present values.
gboolean sb_session_may_pin(SbSession *session);

// Pins the displayed run. Returns FALSE if it cannot be pinned or there are too many pins.
gboolean sb_session_pin(SbSession *session);

// Pins the present values with override[count] replacing some of them; its run is computed in the
// background. Returns FALSE if a value is out of range or there are too many pins.
gboolean sb_session_pin_values(SbSession *session, const SbOverride *override, size_t count);

// Returns the number of pins.
size_t sb_session_pin_count(SbSession *session);

// Removes pin `index`; later ones move up.
void sb_session_unpin(SbSession *session, size_t index);

// Returns the name of pin `index`, else how it differs from the present values ("section diameter
// 1.63 mm"). Borrowed until the next change.
const char *sb_session_pin_name(SbSession *session, size_t index);

// Sets the name of pin `index`; empty: none (see sb_document_name_pin()).
void sb_session_rename_pin(SbSession *session, size_t index, const char *name);

// Returns the drawing style of pin `index`, 0 to SB_CHART_PINS - 1; -1: it is not drawn.
int sb_session_pin_slot(SbSession *session, size_t index);

// Sets whether pin `index` is drawn. If all styles are used, it takes that of the first drawn pin,
// which is then not drawn.
void sb_session_draw_pin(SbSession *session, size_t index, gboolean on);

// Writes the run of pin `index` for charts: its view, name, style (0 if it is not drawn) and the
// frame at the position of the playhead. Returns FALSE while there is no run.
gboolean sb_session_pin_chart(SbSession *session, size_t index, SbChartPin *out);

// Returns a reference to the run of pin `index`, released by sb_run_handle_unref(); NULL while
// there is no run.
SbRunHandle *sb_session_pin_handle(SbSession *session, size_t index);

// Returns the summary of the run of pin `index`; NULL while it is computed or if it failed.
const SbSummary *sb_session_pin_summary(SbSession *session, size_t index);

// Returns whether the run of pin `index` failed.
gboolean sb_session_pin_failed(SbSession *session, size_t index);

// Sets the values of the document to those of pin `index`, as one step for undo; its run is
// displayed immediately if it is computed, else started as after an edit.
void sb_session_use_pin(SbSession *session, size_t index);

// ---- Displayed runs of earlier values ----

// Returns whether the displayed run belongs to other values or drawings than the present ones. Then
// *id (may be NULL) is the SbParamId of the only difference, else -1, and *value (may be NULL) is
// the displayed run's value of that parameter [SI], without a meaning if *id is -1. Both are
// unchanged after FALSE.
gboolean sb_session_is_stale(SbSession *session, int *id, double *value);

// Returns whether the displayed run belongs to earlier values and no run is about to replace it:
// views then draw it paler.
gboolean sb_session_shows_former(SbSession *session);

// Returns whether the displayed run belongs to earlier values while a run of the present values is
// computed. Views then postpone expensive drawing, except of the prediction.
gboolean sb_session_awaits(SbSession *session);

// Returns a translated description of the displayed run of earlier values, "run with modulus 2.5
// MPa"; NULL unless sb_session_shows_former().
char *sb_session_former_text(SbSession *session);

// Returns a sentence in English for pictures, "stale: this run is with modulus 2.5 MPa"; NULL
// unless sb_session_is_stale().
char *sb_session_stale_text(SbSession *session);

// Returns everything that the views of app/chart draw.
const SbChartData *sb_session_chart(SbSession *session);

// Returns the problem of the last run or of the files, one sentence with residual, time and
// parameter; NULL: none.
const char *sb_session_failure(SbSession *session);

// ---- The playhead ----

// Moves the playhead to frame `frame`, at most the last one; on the last one it follows a growing
// run. Does nothing without frames.
void sb_session_set_playhead(SbSession *session, size_t frame);

// Stops playing and moves the playhead to a fraction `share`, 0 to 1, of the time from a stage of
// the first cycle to the next event. Does nothing if the run does not reach the stage.
void sb_session_show_stage(SbSession *session, SbStage stage, double share);

// Returns the displayed frame; NULL: none.
const SbFrame *sb_session_frame(SbSession *session);

// Stops playing and moves the playhead by a number of frames, back if negative, at most to the
// ends.
void sb_session_step(SbSession *session, int frames);

// Stops playing and moves the playhead to the next event or bookmark (direction > 0) or the one
// before (direction < 0); without one, to the last or first frame.
void sb_session_step_event(SbSession *session, int direction);

// Returns whether the playhead moves with time.
gboolean sb_session_is_playing(SbSession *session);

// Starts or stops playing.
void sb_session_play(SbSession *session, gboolean on);

// Returns whether playing starts again at the end.
gboolean sb_session_loops(SbSession *session);

// Sets whether playing starts again at the end.
void sb_session_set_loops(SbSession *session, gboolean on);

// Sets the playing time of the full run [s].
void sb_session_set_play_duration(SbSession *session, double seconds);

// Takes over the frames that the runner has published, and moves the playhead. To be called once
// per drawn frame with the frame clock's time [us], while sb_session_wants_ticks().
void sb_session_tick(SbSession *session, gint64 now);

// Returns whether sb_session_tick() has something to do.
gboolean sb_session_wants_ticks(SbSession *session);

// Returns the position of the displayed frame, "stage C, 3.30 mm, 27.4 N"; empty: no frame.
char *sb_session_where(SbSession *session);
