// Runs of a session. An edit starts a run 150 ms later; a newer edit cancels it
// and starts again with the newest values. The new run replaces the shown one when it is complete,
// or once it has lasted long enough to be watched while it grows; the run before then stays behind
// it, paler, until the new one is complete, and comes back if the new one fails.
#include "app/session/session_private.h"

#include "app/base/format.h"
#include "app/base/translation.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

enum {
  DEBOUNCE_MS = 150,      // after the last edit
  WATCH_US = 120000,      // a run that lasts longer is shown while it grows
  FRAMES_PER_TICK = 20000 // read per drawn frame: about 2 ms
};

static void start_now(SbSession *session);

static void set_reference(SbDisplayedRun **run, SbDisplayedRun *value) {
  SbDisplayedRun *old = *run;
  *run = sb_displayed_run_ref(value);
  sb_displayed_run_unref(old);
}

// What views see ---------------------------------------------------------------------------------

// What the displayed run is; whether it is of the present values is another question.
static SbSessionState displayed_state(const SbSession *session) {
  switch (session->shown != NULL ? session->shown->chart.state : SB_CHART_EMPTY) {
  case SB_CHART_RUNNING:
  case SB_CHART_PARTIAL:
    return SB_SESSION_PARTIAL;
  case SB_CHART_FAILED:
    return SB_SESSION_FAILED;
  case SB_CHART_DONE:
    return SB_SESSION_DONE;
  default:
    return SB_SESSION_EMPTY;
  }
}

// Whether the displayed run is of former values and nothing is about to replace it: an edit that a
// short run answers at once does not make the pictures flicker.
static gboolean shows_former(SbSession *session) {
  if (session->shown == NULL || session->debounce != 0 ||
      (session->ticket != 0 && g_get_monotonic_time() - session->started <= WATCH_US)) {
    return FALSE;
  }
  return sb_session_is_stale(session, NULL, NULL);
}

static void refresh_chart(SbSession *session) {
  SbChartData *chart = &session->chart;
  memset(chart, 0, sizeof *chart);
  if (session->shown != NULL) {
    chart->run = session->shown->chart;
  } else if (session->ticket != 0) {
    // Nothing to show before the first frame; the axes are those of the values.
    chart->run.state = SB_CHART_RUNNING;
    chart->run.model = sb_session_model(session);
  }
  chart->earlier = session->earlier != NULL ? &session->earlier->chart : NULL;
  chart->pinned = session->pinned != NULL ? &session->pinned->chart : NULL;
  chart->pinned_name = session->pinned_name;
  chart->playhead = session->playhead.frame;
  chart->playing = session->playhead.playing;
  chart->progress = sb_session_progress(session);
  chart->title = sb_document_title(session->document);
  chart->hash = session->hash;
  chart->failure = session->failure;
}

static void run_changed(SbSession *session) {
  g_free(session->hash);
  session->hash = sb_document_sha256(session->document);
  session->former = shows_former(session);
  refresh_chart(session);
  sb_session_emit(session, SB_SIGNAL_RUN);
}

void sb_session_playhead_changed(SbSession *session) {
  session->chart.playhead = session->playhead.frame;
  session->chart.playing = session->playhead.playing;
  sb_session_emit(session, SB_SIGNAL_PLAYHEAD);
}

const SbChartData *sb_session_chart(SbSession *session) {
  return &session->chart;
}

// Showing ----------------------------------------------------------------------------------------

// Displays the fresh run, which has frames; the run before stays behind it until it is complete.
// The playhead keeps its place.
static void display_fresh(SbSession *session) {
  if (session->shown == session->fresh) {
    return;
  }
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(session, &count);
  if (session->shown != NULL) {
    sb_playhead_remember(&session->playhead, session->shown->trace, frames, count);
  }
  set_reference(&session->earlier, session->shown);
  set_reference(&session->shown, session->fresh);
}

static void place_playhead(SbSession *session) {
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(session, &count);
  const SbTrace *trace = session->shown != NULL ? session->shown->trace : NULL;
  gboolean complete = session->shown != NULL && session->shown->chart.state == SB_CHART_DONE &&
                      sb_displayed_run_complete(session->shown);
  sb_playhead_return(&session->playhead, trace, frames, count, complete);
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
  if (report->parameter[0] != '\0') {
    g_string_append_printf(text, _(" Look at %s."), report->parameter);
  }
  if (count > 0) {
    g_string_append_printf(text,
                           _(" Pictures show its last good state, up to %.2f s of the cycle."),
                           frames[count - 1].time);
  }
  g_free(session->failure);
  session->failure = g_string_free(g_steal_pointer(&text), FALSE);
}

// A run that ends without a frame, failed or cancelled, leaves the displayed one as it is.
static void finish(SbSession *session) {
  SbDisplayedRun *fresh = session->fresh;
  SbStatus status = sb_run_handle_status(fresh->handle);
  session->ticket = 0;
  fresh->chart.summary = sb_run_summary(fresh->run);
  fresh->chart.life = sb_run_life(fresh->run, &fresh->chart.life_count);
  fresh->chart.state = status == SB_OK                ? SB_CHART_DONE
                       : status == SB_ERROR_CANCELLED ? SB_CHART_PARTIAL
                                                      : SB_CHART_FAILED;
  g_clear_pointer(&session->failure, g_free);
  if (fresh->chart.state == SB_CHART_FAILED) {
    set_failure(session, status, sb_run_handle_report(fresh->handle));
  }
  size_t count = 0;
  sb_run_frames(fresh->run, &count);
  if (count > 0) {
    gboolean watched = session->shown == fresh;
    display_fresh(session);
    // A short run is read at once; a long one goes on being read by the ticks.
    sb_displayed_run_update(fresh, FRAMES_PER_TICK);
    if (!watched || session->playhead.follows || session->playhead.waits) {
      place_playhead(session);
    }
  }
  set_reference(&session->earlier, NULL);
  session->state = session->failure != NULL ? SB_SESSION_FAILED : displayed_state(session);
  run_changed(session);
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
      run_changed(session);
    }
    sb_run_handle_unref(handle);
    return;
  }
  if (session->fresh == NULL) {
    session->fresh = sb_displayed_run_new(handle, &session->asked);
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
  }
  inbox_unref(inbox);
  return G_SOURCE_REMOVE;
}

static void on_notify(void *data) {
  SbSessionInbox *inbox = data;
  if (g_atomic_int_compare_and_exchange(&inbox->pending, 0, 1)) {
    g_atomic_int_inc(&inbox->references);
    g_idle_add_full(G_PRIORITY_DEFAULT, on_inbox, inbox, NULL);
  }
}

static void start_now(SbSession *session) {
  if (session->debounce != 0) {
    g_source_remove(session->debounce);
    session->debounce = 0;
  }
  if (session->model == NULL) {
    return;
  }
  // A run that this one overtakes while it was being watched makes room for the one before it, or
  // stays as the part that it is.
  if (session->ticket != 0 && session->shown != NULL && session->shown == session->fresh) {
    session->shown->chart.state = SB_CHART_PARTIAL;
    if (session->earlier != NULL) {
      size_t count = 0;
      const SbFrame *frames = sb_session_frames(session, &count);
      sb_playhead_remember(&session->playhead, session->shown->trace, frames, count);
      set_reference(&session->shown, session->earlier);
      place_playhead(session);
    }
  }
  set_reference(&session->earlier, NULL);
  set_reference(&session->fresh, NULL);
  g_clear_pointer(&session->failure, g_free);
  // The window shows everything: the views of the scene do not limit it.
  session->asked = sb_document_params(session->document);
  session->started = g_get_monotonic_time();
  session->state = SB_SESSION_RUNNING;
  session->ticket = sb_runner_submit(session->runner, session->model,
                                     SB_VIEW_HYSTERESIS | SB_VIEW_PROFILES | SB_VIEW_SECTION);
  run_changed(session);
}

static gboolean on_debounced(gpointer data) {
  SbSession *session = data;
  session->debounce = 0;
  start_now(session);
  return G_SOURCE_REMOVE;
}

void sb_session_values_changed(SbSession *session) {
  // Values that are those of the shown or growing run need none (undo back to where it was).
  const SbParams *newest = session->ticket != 0                ? &session->asked
                           : session->state == SB_SESSION_DONE ? &session->shown->params
                                                               : NULL;
  SbParams params = sb_document_params(session->document);
  gboolean same = newest != NULL;
  for (int id = 0; same && id < SB_PARAM_COUNT; id++) {
    same = sb_params_get(&params, (SbParamId)id) == sb_params_get(newest, (SbParamId)id);
  }
  if (session->debounce != 0) {
    g_source_remove(session->debounce);
    session->debounce = 0;
  }
  if (!same && session->model != NULL && session->auto_run) {
    session->debounce = g_timeout_add(DEBOUNCE_MS, on_debounced, session);
  }
  session->former = shows_former(session);
}

void sb_session_start(SbSession *session) {
  start_now(session);
}

void sb_session_stop(SbSession *session) {
  if (session->debounce != 0) {
    g_source_remove(session->debounce);
    session->debounce = 0;
  }
  sb_runner_cancel(session->runner);
  if (session->ticket != 0 && session->fresh == NULL) {
    // It never began.
    session->ticket = 0;
    session->state = displayed_state(session);
    run_changed(session);
  }
}

void sb_session_set_auto_run(SbSession *session, gboolean on) {
  session->auto_run = on;
  if (on) {
    sb_session_values_changed(session);
  }
}

// Questions --------------------------------------------------------------------------------------

SbSessionState sb_session_state(SbSession *session) {
  return session->state;
}

double sb_session_progress(SbSession *session) {
  return session->ticket != 0 && session->fresh != NULL
             ? sb_run_handle_fraction(session->fresh->handle)
             : 0;
}

const SbRun *sb_session_run(SbSession *session) {
  return session->shown != NULL ? session->shown->run : NULL;
}

const SbFrame *sb_session_frames(SbSession *session, size_t *count) {
  *count = session->shown != NULL ? session->shown->chart.count : 0;
  return session->shown != NULL ? session->shown->chart.frames : NULL;
}

SbRunHandle *sb_session_handle(SbSession *session) {
  return session->shown != NULL && session->shown->chart.summary != NULL
             ? sb_run_handle_ref(session->shown->handle)
             : NULL;
}

const SbSummary *sb_session_summary(SbSession *session) {
  return session->shown != NULL ? session->shown->chart.summary : NULL;
}

const char *sb_session_failure(SbSession *session) {
  return session->failure;
}

gboolean sb_session_is_stale(SbSession *session, int *id, double *value) {
  if (session->shown == NULL) {
    return FALSE;
  }
  SbParams params = sb_document_params(session->document);
  int found = 0;
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    double old = sb_params_get(&session->shown->params, (SbParamId)i);
    gboolean differs = sb_params_get(&params, (SbParamId)i) != old;
    // An override that only follows its parent is not a change of its own.
    gboolean follows =
        sb_param((SbParamId)i)->parent >= 0 && !params.given[i] && !session->shown->params.given[i];
    if (differs && !follows) {
      found++;
      if (id != NULL) {
        *id = found == 1 ? i : -1;
      }
      if (value != NULL) {
        *value = old;
      }
    }
  }
  return found > 0;
}

gboolean sb_session_shows_former(SbSession *session) {
  return session->former;
}

char *sb_session_former_text(SbSession *session) {
  int id = -1;
  double value = 0;
  if (!session->former || !sb_session_is_stale(session, &id, &value)) {
    return NULL;
  }
  if (id < 0) {
    return g_strdup(_("run of earlier values"));
  }
  g_autofree char *label = sb_translation_inside(sb_param((SbParamId)id)->label);
  g_autofree char *shown = sb_param_format((SbParamId)id, value);
  return g_strdup_printf(_("run with %s %s"), label, shown);
}

char *sb_session_stale_text(SbSession *session) {
  int id = -1;
  double value = 0;
  if (!sb_session_is_stale(session, &id, &value)) {
    return NULL;
  }
  if (id < 0) {
    return g_strdup("stale: values have changed since this run");
  }
  g_autofree char *label = g_utf8_strdown(sb_param((SbParamId)id)->label, -1);
  g_autofree char *shown = sb_param_format((SbParamId)id, value);
  return g_strdup_printf("stale: this run is with %s %s", label, shown);
}

static char *pin_name(SbSession *session) {
  char peak[SB_FORMAT_MAX];
  sb_format_figure(peak, sb_run_summary(session->pinned->run),
                   sb_figure_find("cycle.force_breakaway_N"));
  return g_strdup_printf("break-away %s", peak);
}

void sb_session_pin(SbSession *session, gboolean on) {
  set_reference(&session->pinned,
                on && session->shown != NULL && session->shown->chart.summary != NULL
                    ? session->shown
                    : NULL);
  g_clear_pointer(&session->pinned_name, g_free);
  if (session->pinned != NULL) {
    session->pinned_name = pin_name(session);
  }
  run_changed(session);
}

const char *sb_session_pinned_name(SbSession *session) {
  return session->pinned_name;
}

// Ticks -------------------------------------------------------------------------------------------

void sb_session_tick(SbSession *session, gint64 now) {
  poll_frames(session);
  if (session->ticket != 0 && session->fresh != NULL && session->shown != session->fresh &&
      g_get_monotonic_time() - session->started > WATCH_US) {
    size_t published = 0;
    sb_run_frames(session->fresh->run, &published);
    if (published > 0) {
      display_fresh(session);
      sb_displayed_run_update(session->fresh, FRAMES_PER_TICK);
      place_playhead(session);
      run_changed(session);
      sb_session_playhead_changed(session);
    }
  }
  gboolean more =
      session->shown != NULL && sb_displayed_run_update(session->shown, FRAMES_PER_TICK);
  if (more && (session->playhead.follows || session->playhead.waits)) {
    place_playhead(session);
  }
  if (session->former != shows_former(session)) {
    run_changed(session);
  }
  if (more || session->ticket != 0) {
    refresh_chart(session);
    sb_session_emit(session, SB_SIGNAL_FRAMES);
  }
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(session, &count);
  if (sb_playhead_tick(&session->playhead, frames, count, now) || more) {
    sb_session_playhead_changed(session);
  }
}

gboolean sb_session_wants_ticks(SbSession *session) {
  return session->ticket != 0 || session->playhead.playing ||
         (session->shown != NULL && !sb_displayed_run_complete(session->shown));
}

// Life -------------------------------------------------------------------------------------------

static void drop_runs(SbSession *session) {
  session->ticket = 0;
  session->state = SB_SESSION_EMPTY;
  set_reference(&session->fresh, NULL);
  set_reference(&session->shown, NULL);
  set_reference(&session->earlier, NULL);
  set_reference(&session->pinned, NULL);
  g_clear_pointer(&session->pinned_name, g_free);
  g_clear_pointer(&session->failure, g_free);
  bool loops = session->playhead.loops;
  double duration = session->playhead.duration;
  sb_playhead_init(&session->playhead);
  session->playhead.loops = loops;
  session->playhead.duration = duration;
}

void sb_session_clear_runs(SbSession *session) {
  if (session->debounce != 0) {
    g_source_remove(session->debounce);
    session->debounce = 0;
  }
  sb_runner_cancel(session->runner);
  drop_runs(session);
  run_changed(session);
  sb_session_playhead_changed(session);
}

void sb_session_init_runs(SbSession *session) {
  session->inbox = g_new0(SbSessionInbox, 1);
  session->inbox->session = session;
  session->inbox->references = 1;
  session->runner = sb_runner_create(on_notify, session->inbox);
  if (session->runner == NULL) {
    g_error("The system has no thread left for the engine.");
  }
  session->auto_run = TRUE;
  sb_playhead_init(&session->playhead);
  refresh_chart(session);
}

void sb_session_dispose_runs(SbSession *session) {
  if (session->runner == NULL) {
    return;
  }
  if (session->debounce != 0) {
    g_source_remove(session->debounce);
    session->debounce = 0;
  }
  g_clear_pointer(&session->runner, sb_runner_destroy);
  session->inbox->session = NULL;
  g_clear_pointer(&session->inbox, inbox_unref);
  drop_runs(session);
  g_clear_pointer(&session->hash, g_free);
}
