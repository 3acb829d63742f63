// Runs of a session. An edit starts a run, after a short delay if the run is expensive; a newer
// edit cancels it and starts again with the newest values. The new run replaces the displayed one
// when it is complete, or when it has lasted so long that it is displayed while it grows. The
// earlier run is then drawn paler behind it until the new one is complete, and is displayed again
// if the new one fails. The run of values that were solved before is reused (run_cache.h).
//
// Solved rings take seconds. If the plan expects more than HEAVY_S, the runs below are computed one
// after the other, and each is displayed when it is complete:
//
//   - the run of these values that is stored in a file (stored_run.h);
//   - otherwise, while nothing is displayed, a run by closed forms, which takes milliseconds;
//   - if there is a full run of other values, a coarse run whose rings start from that run's (near
//     run); its figures differ from those of a cold run by at most the reported errors, and depend
//     on these two sets of values only;
//   - otherwise a run with a coarse tolerance, if the plan expects less than half of the time;
//   - the full run with a cold start: immediately after a coarse or stored run, IDLE_MS after the
//     last edit if there was a near run. Its figures are those of `sealbench run`. Only this run is
//     exported, pinned, and used as the start of rings of other values.
//
// If an earlier one of these runs fails, it is omitted: the full run reports the reason.
#include "app/session/session_private.h"

#include "app/base/format.h"
#include "app/base/translation.h"
#include "app/document/shipped.h"
#include "app/session/stored_run.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

enum {
  DEBOUNCE_MS = 30,       // before a heavy run of several edits; an overtaken one ends within 50 ms
  IDLE_MS = 1000,         // after a near run, before the whole one
  FRAMES_PER_TICK = 20000 // read per drawn frame: about 2 ms
};

// Expected time of a run from which on it comes in grades [s], and the share of it that a coarse
// run may take.
static const double HEAVY_S = 0.15, COARSE_SHARE = 0.5;

// Of a coarse run.
static const double COARSE_TOLERANCE = 0.01, COARSE_FRAMES = 200;

static void cancel_source(guint *source) {
  if (*source != 0) {
    g_source_remove(*source);
    *source = 0;
  }
}

uint64_t sb_session_drawings(const SbSession *session) {
  return session->model != NULL ? sb_model_drawings(session->model) : 0;
}

// Whether a run is complete and of these values and drawings.
static bool answers(const SbDisplayedRun *run, const SbParams *params, uint64_t drawings) {
  return run != NULL && run->chart.state == SB_CHART_DONE &&
         sb_displayed_run_is_of(run, params, drawings);
}

// Whether what is asked is what the document says.
static bool is_current(const SbSession *session) {
  const SbParams present = sb_document_params(session->document);
  return session->model != NULL && session->asked_drawings == sb_session_drawings(session) &&
         sb_same_values(&session->asked, &present);
}

static void ask(SbSession *session) {
  session->asked = sb_document_params(session->document);
  session->asked_drawings = sb_session_drawings(session);
}

// Grades -----------------------------------------------------------------------------------------

// Predicted processor time of a model's run [s]; 0 without solved rings.
static double expected(const SbModel *model, bool coarse) {
  SbPlan plan;
  sb_plan_wished(&plan, model,
                 &(SbPlanWishes){.views = SB_SESSION_VIEWS, .life = true, .coarse = coarse});
  return plan.ring ? sb_plan_cost(&plan) : 0;
}

// NULL where the model is no finer or memory is short.
static SbModel *coarse_model(const SbModel *model) {
  const double tolerance = sb_model_value(model, SB_P_OUTPUT_TOLERANCE);
  const SbOverride override[] = {
      {SB_P_OUTPUT_TOLERANCE, COARSE_TOLERANCE},
      {SB_P_OUTPUT_FRAMES, fmin(sb_model_value(model, SB_P_OUTPUT_FRAMES), COARSE_FRAMES)}};
  SbModel *coarse = NULL;
  if (tolerance < COARSE_TOLERANCE &&
      sb_model_derive(&coarse, model, override, G_N_ELEMENTS(override), NULL) != SB_OK) {
    return NULL;
  }
  return coarse;
}

// With closed forms in place of the rings; NULL where that cannot be.
static SbModel *closed_model(const SbModel *model) {
  static const SbOverride closed_form[] = {{SB_P_MODELS_FIT, SB_FIT_KARASZKIEWICZ},
                                           {SB_P_MODELS_FIT_VARIANT, 0}};
  SbModel *closed = NULL;
  return sb_model_derive(&closed, model, closed_form, G_N_ELEMENTS(closed_form), NULL) == SB_OK
             ? closed
             : NULL;
}

// Asks for a run of the present values. One by closed forms that cannot be is a coarse one; a
// coarse one that does not pay is the whole one.
static void submit(SbSession *session, SbRunGrade grade) {
  g_autoptr(SbModel) coarse = grade == SB_GRADE_CLOSED ? closed_model(session->model) : NULL;
  if (grade == SB_GRADE_CLOSED && coarse == NULL) {
    grade = SB_GRADE_COARSE;
  }
  if (grade == SB_GRADE_COARSE || grade == SB_GRADE_NEAR) {
    coarse = coarse_model(session->model);
  }
  if (grade == SB_GRADE_COARSE &&
      (coarse == NULL || expected(coarse, true) > COARSE_SHARE * expected(session->model, false))) {
    g_clear_pointer(&coarse, sb_model_destroy);
    grade = SB_GRADE_WHOLE;
  }
  sb_session_set_reference(&session->fresh, NULL);
  ask(session);
  session->grade = grade;
  session->started = g_get_monotonic_time();
  session->state = SB_SESSION_RUNNING;
  session->ticket = sb_runner_submit(
      session->runner, &(SbRunRequest){
                           .model = coarse != NULL ? coarse : session->model,
                           .wishes = {.views = SB_SESSION_VIEWS,
                                      .life = grade != SB_GRADE_CLOSED,
                                      .coarse = coarse != NULL},
                           .start = grade == SB_GRADE_NEAR ? session->base->handle : NULL,
                           .keep = grade == SB_GRADE_WHOLE && session->heavy,
                       });
}

static SbRunGrade first_grade(SbSession *session) {
  if (!session->heavy || answers(session->shown, &session->asked, session->asked_drawings)) {
    return SB_GRADE_WHOLE; // asked for again
  }
  // Rings of another drawing are no neighbours.
  const bool near = session->base != NULL &&
                    sb_model_drawings(sb_run_model(session->base->run)) == session->asked_drawings;
  return near ? SB_GRADE_NEAR : session->shown == NULL ? SB_GRADE_CLOSED : SB_GRADE_COARSE;
}

static gboolean on_idle_long(gpointer data) {
  SbSession *session = data;
  session->later = 0;
  submit(session, SB_GRADE_WHOLE);
  sb_session_run_changed(session);
  return G_SOURCE_REMOVE;
}

// What follows after a run of the present values is shown.
static void go_on(SbSession *session) {
  if (session->shown->grade == SB_GRADE_CLOSED) {
    submit(session, SB_GRADE_COARSE);
  } else if (session->shown->grade == SB_GRADE_COARSE || session->shown->grade == SB_GRADE_STORED) {
    submit(session, SB_GRADE_WHOLE);
  } else if (session->shown->grade == SB_GRADE_NEAR) {
    session->state = SB_SESSION_RUNNING;
    session->later = g_timeout_add(IDLE_MS, on_idle_long, session);
  }
}

// A complete run for others: by its values, as the base of rings and of slopes.
static void keep(SbSession *session, SbDisplayedRun *run) {
  if (run->grade > SB_GRADE_COARSE) {
    sb_run_cache_put(session->cache, run);
  }
  sb_session_set_base(session, run);
}

// Showing ----------------------------------------------------------------------------------------

static gboolean shows_all(const SbSession *session) {
  return session->shown != NULL && session->shown->chart.state == SB_CHART_DONE &&
         sb_displayed_run_complete(session->shown);
}

static void remember_place(SbSession *session) {
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(session, &count);
  sb_playhead_remember(&session->playhead, session->shown->trace, frames, count,
                       shows_all(session));
}

// Displays the fresh run, which has frames; the run before stays behind it until it is complete.
// The playhead keeps its place.
static void display_fresh(SbSession *session) {
  if (session->shown == session->fresh) {
    return;
  }
  if (session->shown != NULL) {
    remember_place(session);
  }
  sb_session_set_reference(&session->earlier, session->shown);
  sb_session_set_reference(&session->shown, session->fresh);
}

static void place_playhead(SbSession *session) {
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(session, &count);
  const SbTrace *trace = session->shown != NULL ? session->shown->trace : NULL;
  sb_playhead_return(&session->playhead, trace, frames, count, shows_all(session));
  session->playhead.waits = session->playhead.waits && !session->playhead.playing;
}

// Job --------------------------------------------------------------------------------------------

// One sentence each: what, how far off, how far it got, which parameter, and what is shown.
static void set_failure(SbSession *session, SbStatus status, const SbReport *report) {
  size_t count = 0;
  const SbFrame *frames = sb_run_frames(session->fresh->run, &count);
  g_autoptr(GString) text =
      g_string_new(report->text[0] != '\0' ? report->text : sb_status_text(status));
  text->str[0] = g_ascii_toupper(text->str[0]);
  if (text->str[text->len - 1] != '.') {
    g_string_append_c(text, '.');
  }
  if (report->residual > 0) {
    g_string_append_printf(text, _(" Residual %.1e after %d iterations."), report->residual,
                           report->iteration);
  }
  if (report->input != 0) {
    g_string_append_printf(text, _(" Look at %s."), sb_input_key(report->input));
  }
  if (count > 0) {
    g_string_append_printf(text,
                           _(" Pictures show its last good state, up to %.2f s of the cycle."),
                           frames[count - 1].time);
  }
  g_free(session->failure);
  session->failure = g_string_free(g_steal_pointer(&text), FALSE);
}

static SbSessionState ended_state(const SbSession *session) {
  return session->failure != NULL ? SB_SESSION_FAILED : sb_session_shown_state(session);
}

// Takes over what a request has ended with. A run that ends without a frame, failed or cancelled,
// leaves the displayed one as it is, and so does one that is cancelled while an earlier grade of it
// is shown, and one of former values that ends while that of newer ones waits to begin.
static void finish(SbSession *session) {
  SbDisplayedRun *fresh = session->fresh;
  SbStatus status = sb_run_handle_status(fresh->handle);
  const bool current = is_current(session);
  session->ticket = 0;
  if (!current && session->debounce != 0 && session->shown != NULL && session->shown != fresh) {
    return;
  }
  if (fresh->grade != SB_GRADE_WHOLE && status != SB_OK && status != SB_ERROR_CANCELLED &&
      current) {
    submit(session, SB_GRADE_WHOLE);
    sb_session_run_changed(session);
    return;
  }
  sb_displayed_run_end(fresh);
  g_clear_pointer(&session->failure, g_free);
  if (fresh->chart.state == SB_CHART_FAILED) {
    set_failure(session, status, sb_run_handle_report(fresh->handle));
  }
  size_t count = 0;
  sb_run_frames(fresh->run, &count);
  if (count > 0 && !(status == SB_ERROR_CANCELLED &&
                     answers(session->shown, &session->asked, session->asked_drawings))) {
    gboolean watched = session->shown == fresh;
    display_fresh(session);
    // A short run is read at once; a long one goes on being read by the ticks.
    sb_displayed_run_update(fresh, FRAMES_PER_TICK);
    // If a growing run placed it by a stage of unknown length, it is placed again.
    if (!watched || session->playhead.follows || session->playhead.waits ||
        session->playhead.frame == session->playhead.placed) {
      place_playhead(session);
    }
  }
  sb_session_set_reference(&session->earlier, NULL);
  session->state = ended_state(session);
  if (status == SB_OK && current && session->shown == fresh) {
    keep(session, fresh);
    go_on(session);
  }
  sb_session_run_changed(session);
  sb_session_emit(session, SB_SIGNAL_FRAMES);
  sb_session_playhead_changed(session);
}

// The runner has something new.
static void poll_frames(SbSession *session) {
  SbRunHandle *handle = session->ticket != 0 ? sb_runner_latest(session->runner) : NULL;
  if (handle == NULL || sb_run_handle_ticket(handle) != session->ticket) {
    sb_run_handle_unref(handle);
    return;
  }
  if (sb_run_handle_run(handle) == NULL) {
    if (sb_run_handle_is_done(handle)) {
      session->failure =
          g_strdup_printf(_("The run could not start: %s."), sb_run_handle_report(handle)->text);
      session->ticket = 0;
      session->state = SB_SESSION_FAILED;
      sb_session_run_changed(session);
    }
    sb_run_handle_unref(handle);
    return;
  }
  if (session->fresh == NULL) {
    session->fresh = sb_displayed_run_new(handle, &session->asked, session->grade);
  } else {
    sb_run_handle_unref(handle);
  }
  if (sb_run_handle_is_done(session->fresh->handle)) {
    finish(session);
  }
}

// The way from the engine's thread to the main loop: at most one idle callback is on its way. It
// outlives the session by as much as that callback needs.
struct SbSessionInbox {
  SbSession *session; // NULL once the session is gone; main thread only
  int references;     // atomic
  int pending;        // atomic
};

static void inbox_unref(SbSessionInbox *inbox) {
  if (g_atomic_int_dec_and_test(&inbox->references)) {
    g_free(inbox);
  }
}

static gboolean on_inbox(gpointer data) {
  SbSessionInbox *inbox = data;
  g_atomic_int_set(&inbox->pending, 0);
  if (inbox->session != NULL) {
    poll_frames(inbox->session);
    sb_session_poll_slope(inbox->session);
    sb_session_poll_pins(inbox->session);
  }
  inbox_unref(inbox);
  return G_SOURCE_REMOVE;
}

void sb_session_notify(void *data) {
  SbSessionInbox *inbox = data;
  if (g_atomic_int_compare_and_exchange(&inbox->pending, 0, 1)) {
    g_atomic_int_inc(&inbox->references);
    g_idle_add_full(G_PRIORITY_DEFAULT, on_inbox, inbox, NULL);
  }
}

// Begins the run of the present values; FALSE: they make no model. Not inlined: callers have
// parameters on their stacks as well.
static G_NO_INLINE gboolean begin(SbSession *session) {
  cancel_source(&session->debounce);
  cancel_source(&session->later);
  if (session->model == NULL) {
    return FALSE;
  }
  // A run that this one overtakes while it was being watched makes room for the one before it, or
  // stays as the part that it is.
  if (session->ticket != 0 && session->shown != NULL && session->shown == session->fresh) {
    session->shown->chart.state = SB_CHART_PARTIAL;
    if (session->earlier != NULL) {
      remember_place(session);
      sb_session_set_reference(&session->shown, session->earlier);
      place_playhead(session);
    }
  }
  sb_session_set_reference(&session->earlier, NULL);
  g_clear_pointer(&session->failure, g_free);
  ask(session);
  submit(session, first_grade(session));
  return TRUE;
}

static void start_now(SbSession *session) {
  if (begin(session)) {
    sb_session_run_changed(session);
  }
}

static gboolean on_debounced(gpointer data) {
  SbSession *session = data;
  session->debounce = 0;
  start_now(session);
  return G_SOURCE_REMOVE;
}

// A run that has begun is told.
static gboolean on_begun(gpointer data) {
  SbSession *session = data;
  session->debounce = 0;
  sb_session_run_changed(session);
  return G_SOURCE_REMOVE;
}

// Shows a complete run of the present values in place of what is shown or under way.
static void adopt(SbSession *session, SbDisplayedRun *run) {
  if (session->ticket != 0) {
    sb_runner_cancel(session->runner);
    session->ticket = 0;
  }
  if (run != session->shown) {
    sb_session_set_reference(&session->fresh, run);
    display_fresh(session);
    place_playhead(session);
  }
  sb_session_set_reference(&session->fresh, NULL);
  sb_session_set_reference(&session->earlier, NULL);
  g_clear_pointer(&session->failure, g_free);
  session->state = sb_session_shown_state(session);
  sb_session_set_base(session, session->shown);
  if (session->auto_run) {
    go_on(session);
  }
  sb_session_run_changed(session);
  sb_session_emit(session, SB_SIGNAL_FRAMES);
  sb_session_playhead_changed(session);
}

// A run of the present values that was kept in a file, for the caller; NULL if there is none.
static SbDisplayedRun *stored_run(SbSession *session, const SbParams *params) {
  g_autofree char *hash = sb_document_sha256(session->document);
  g_autofree char *folder = session->runs != NULL ? g_strdup(session->runs) : sb_shipped_runs();
  char *date = NULL;
  SbRunHandle *handle = sb_stored_run_find(&date, folder, hash, session->model);
  if (handle == NULL) {
    return NULL;
  }
  SbDisplayedRun *run = sb_displayed_run_new(handle, params, SB_GRADE_STORED);
  run->date = date;
  sb_displayed_run_end(run);
  sb_displayed_run_update(run, G_MAXSIZE);
  return run;
}

// Errors of the document's files are the failure of its run, until they are corrected.
static void take_faults(SbSession *session) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  const bool faulty = sb_document_faults(session->document, issues);
  if (faulty || session->faulty) {
    g_clear_pointer(&session->failure, g_free);
  }
  session->faulty = faulty;
  if (faulty) {
    g_autoptr(GString) text = g_string_new(_("Nothing is computed: the file has errors."));
    for (guint i = 0; i < issues->len; i++) {
      g_autofree char *line = sb_issue_line(issues->pdata[i]);
      g_string_append_printf(text, "%s%s", i == 0 ? " " : "; ", line);
    }
    session->failure = g_strconcat(text->str, ".", NULL);
  }
}

void sb_session_values_changed(SbSession *session) {
  take_faults(session);
  SbParams params = sb_document_params(session->document);
  cancel_source(&session->debounce);
  cancel_source(&session->later);
  session->heavy = session->model != NULL && expected(session->model, false) > HEAVY_S;
  sb_session_predict(session);
  if (session->ticket == 0) {
    session->state = ended_state(session);
  }
  if (session->ticket == 0 || !is_current(session)) {
    const uint64_t drawings = sb_session_drawings(session);
    SbDisplayedRun *known = session->model == NULL ? NULL
                            : answers(session->shown, &params, drawings)
                                ? session->shown
                                : sb_run_cache_get(session->cache, &params, drawings);
    // A file is looked for where nothing else is shown: later, what is known here starts better.
    SbDisplayedRun *stored =
        known == NULL && session->heavy && session->shown == NULL && session->ticket == 0
            ? stored_run(session, &params)
            : NULL;
    if (stored != NULL) {
      sb_run_cache_put(session->cache, stored);
    }
    if (known != NULL || stored != NULL) {
      adopt(session, known != NULL ? known : stored);
      sb_displayed_run_unref(stored);
    } else if (session->model != NULL && session->auto_run) {
      // What was just opened is complete, so is a single edit, and a quick run ends before the
      // next. A single edit's begins before anybody is told, which takes the window 40 ms.
      const bool grades = session->heavy && session->shown != NULL;
      const bool begun = grades && session->lone && begin(session);
      const guint wait = grades && !session->lone ? DEBOUNCE_MS : 0;
      session->debounce = g_timeout_add(wait, begun ? on_begun : on_debounced, session);
      session->state = session->heavy ? SB_SESSION_RUNNING : session->state;
    }
  }
  session->former = sb_session_is_former(session);
}

void sb_session_start(SbSession *session) {
  start_now(session);
}

void sb_session_stop(SbSession *session) {
  const bool waits = session->debounce != 0 || session->later != 0;
  cancel_source(&session->debounce);
  cancel_source(&session->later);
  sb_runner_cancel(session->runner);
  if (session->ticket != 0 ? session->fresh == NULL : waits) {
    // It never began.
    session->ticket = 0;
    session->state = ended_state(session);
    sb_session_run_changed(session);
  }
}

void sb_session_set_auto_run(SbSession *session, gboolean on) {
  session->auto_run = on;
  if (on) {
    sb_session_values_changed(session);
  }
}

// Ticks -------------------------------------------------------------------------------------------

void sb_session_tick(SbSession *session, gint64 now) {
  poll_frames(session);
  // Of a run in grades nothing is shown before it is complete, unless nothing else is there.
  if (session->ticket != 0 && session->fresh != NULL && session->shown != session->fresh &&
      !(session->heavy && session->shown != NULL) &&
      g_get_monotonic_time() - session->started > SB_SESSION_WATCH_US) {
    size_t published = 0;
    sb_run_frames(session->fresh->run, &published);
    if (published > 0) {
      display_fresh(session);
      sb_displayed_run_update(session->fresh, FRAMES_PER_TICK);
      place_playhead(session);
      sb_session_run_changed(session);
      sb_session_playhead_changed(session);
    }
  }
  gboolean more =
      session->shown != NULL && sb_displayed_run_update(session->shown, FRAMES_PER_TICK);
  if (more && (session->playhead.follows || session->playhead.waits)) {
    place_playhead(session);
  }
  if (session->former != sb_session_is_former(session)) {
    sb_session_run_changed(session);
  }
  if (more || (session->ticket != 0 && session->shown == NULL)) {
    sb_session_refresh_chart(session);
    sb_session_emit(session, SB_SIGNAL_FRAMES);
  } else if (session->ticket != 0) {
    // The earlier run is unchanged: nothing is redrawn, so that the run has the processors.
    sb_session_emit(session, SB_SIGNAL_PROGRESS);
  }
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(session, &count);
  const gboolean played = session->playhead.playing;
  if (sb_playhead_tick(&session->playhead, frames, count, now) || more) {
    sb_session_playhead_changed(session);
  }
  if (played && !session->playhead.playing) {
    sb_session_find_slopes(session);
  }
}

gboolean sb_session_wants_ticks(SbSession *session) {
  return session->ticket != 0 || session->playhead.playing ||
         (session->shown != NULL && !sb_displayed_run_complete(session->shown));
}

// Life -------------------------------------------------------------------------------------------

static void drop_runs(SbSession *session) {
  session->edited = 0;
  session->latency = (SbEditLatency){NAN, NAN};
  session->ticket = 0;
  session->state = SB_SESSION_EMPTY;
  sb_session_set_reference(&session->fresh, NULL);
  sb_session_set_reference(&session->shown, NULL);
  sb_session_set_reference(&session->earlier, NULL);
  sb_session_drop_base(session);
  session->slope_first = -1;
  sb_run_cache_clear(session->cache);
  g_clear_pointer(&session->failure, g_free);
  bool loops = session->playhead.loops;
  double duration = session->playhead.duration;
  sb_playhead_init(&session->playhead);
  session->playhead.loops = loops;
  session->playhead.duration = duration;
}

void sb_session_clear_runs(SbSession *session) {
  cancel_source(&session->debounce);
  cancel_source(&session->later);
  sb_runner_cancel(session->runner);
  drop_runs(session);
  sb_session_run_changed(session);
  sb_session_playhead_changed(session);
}

void sb_session_init_runs(SbSession *session) {
  session->inbox = g_new0(SbSessionInbox, 1);
  session->inbox->session = session;
  session->inbox->references = 1;
  session->runner = sb_runner_create(sb_session_notify, session->inbox, false);
  if (session->runner == NULL) {
    g_error("The system has no thread left for the engine.");
  }
  session->cache = sb_run_cache_new();
  session->prediction = sb_prediction_new();
  session->auto_run = TRUE;
  session->latency = (SbEditLatency){NAN, NAN};
  sb_playhead_init(&session->playhead);
  sb_session_init_pins(session);
  sb_session_refresh_chart(session);
}

void sb_session_dispose_runs(SbSession *session) {
  if (session->runner == NULL) {
    return;
  }
  cancel_source(&session->debounce);
  cancel_source(&session->later);
  g_clear_pointer(&session->runner, sb_runner_destroy);
  sb_session_drop_base(session);
  g_clear_pointer(&session->slopes, sb_runner_destroy);
  sb_session_dispose_pins(session);
  session->inbox->session = NULL;
  g_clear_pointer(&session->inbox, inbox_unref);
  drop_runs(session);
  g_clear_pointer(&session->cache, sb_run_cache_free);
  g_clear_pointer(&session->prediction, sb_prediction_free);
  g_clear_pointer(&session->hash, g_free);
  g_clear_pointer(&session->runs, g_free);
}
