// Runs of a session: the frames of a requested run, what is displayed of it, its end, and the ticks
// of the clock. session_request.c decides what is run.
#include "app/session/session_private.h"

#include "app/base/format.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

enum { FRAMES_PER_TICK = 20000 }; // read per drawn frame: about 2 ms

// Showing ----------------------------------------------------------------------------------------

static gboolean shows_all(const SbSession *session) {
  return session->shown != NULL && session->shown->chart.state == SB_CHART_DONE &&
         sb_displayed_run_complete(session->shown);
}

void sb_session_remember_place(SbSession *session) {
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(session, &count);
  sb_playhead_remember(&session->playhead, session->shown->trace, frames, count,
                       shows_all(session));
}

void sb_session_display_fresh(SbSession *session) {
  if (session->shown == session->fresh) {
    return;
  }
  if (session->shown != NULL) {
    sb_session_remember_place(session);
  }
  sb_session_set_reference(&session->earlier, session->shown);
  sb_session_set_reference(&session->shown, session->fresh);
}

void sb_session_place_playhead(SbSession *session) {
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
  g_autofree char *what =
      sb_sentence_case(report->text[0] != '\0' ? report->text : sb_status_text(status));
  g_autoptr(GString) text = g_string_new(what);
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

// What was computed has ended; what waits goes on waiting.
static void end_request(SbSession *session) {
  sb_session_go(session,
                session->request == SB_REQUEST_OVERTAKEN ? SB_REQUEST_DELAYED : SB_REQUEST_NONE);
}

// Takes over what a request has ended with. A run that ends without a frame, failed or cancelled,
// leaves the displayed one as it is, and so does one that is cancelled while an earlier grade of it
// is shown, and one of former values that ends while that of newer ones waits to begin.
static void finish(SbSession *session) {
  SbDisplayedRun *fresh = session->fresh;
  SbStatus status = sb_run_handle_status(fresh->handle);
  const bool current = sb_session_is_current(session);
  end_request(session);
  if (!current && sb_session_delays(session) && session->shown != NULL && session->shown != fresh) {
    return;
  }
  if (fresh->grade != SB_GRADE_WHOLE && status != SB_OK && status != SB_ERROR_CANCELLED &&
      current) {
    sb_session_submit(session, SB_GRADE_WHOLE);
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
  if (count > 0 &&
      !(status == SB_ERROR_CANCELLED &&
        sb_session_answers(session->shown, &session->asked, session->asked_drawings))) {
    gboolean watched = session->shown == fresh;
    sb_session_display_fresh(session);
    // A short run is read at once; a long one goes on being read by the ticks.
    sb_displayed_run_update(fresh, FRAMES_PER_TICK);
    // If a growing run placed it by a stage of unknown length, it is placed again.
    if (!watched || session->playhead.follows || session->playhead.waits ||
        session->playhead.frame == session->playhead.placed) {
      sb_session_place_playhead(session);
    }
  }
  sb_session_set_reference(&session->earlier, NULL);
  if (status == SB_OK && current && session->shown == fresh) {
    sb_session_keep_run(session, fresh);
    sb_session_continue(session);
  }
  sb_session_run_changed(session);
  sb_session_emit(session, SB_SIGNAL_FRAMES);
  sb_session_playhead_changed(session);
}

// The runner has something new.
static void poll_frames(SbSession *session) {
  SbRunHandle *handle = sb_session_computes(session) ? sb_runner_latest(session->runner) : NULL;
  if (handle == NULL || sb_run_handle_ticket(handle) != session->ticket) {
    sb_run_handle_unref(handle);
    return;
  }
  if (sb_run_handle_run(handle) == NULL) {
    if (sb_run_handle_is_done(handle)) {
      session->failure =
          g_strdup_printf(_("The run could not start: %s."), sb_run_handle_report(handle)->text);
      end_request(session);
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

// Ticks -------------------------------------------------------------------------------------------

void sb_session_tick(SbSession *session, gint64 now) {
  poll_frames(session);
  // Of a run in grades nothing is shown before it is complete, unless nothing else is there.
  if (sb_session_computes(session) && session->fresh != NULL && session->shown != session->fresh &&
      !(session->heavy && session->shown != NULL) &&
      g_get_monotonic_time() - session->started > SB_SESSION_WATCH_US) {
    size_t published = 0;
    sb_run_frames(session->fresh->run, &published);
    if (published > 0) {
      sb_session_display_fresh(session);
      sb_displayed_run_update(session->fresh, FRAMES_PER_TICK);
      sb_session_place_playhead(session);
      sb_session_run_changed(session);
      sb_session_playhead_changed(session);
    }
  }
  gboolean more =
      session->shown != NULL && sb_displayed_run_update(session->shown, FRAMES_PER_TICK);
  if (more && (session->playhead.follows || session->playhead.waits)) {
    sb_session_place_playhead(session);
  }
  if (session->former != sb_session_is_former(session)) {
    sb_session_run_changed(session);
  }
  if (more || (sb_session_computes(session) && session->shown == NULL)) {
    sb_session_refresh_chart(session);
    sb_session_emit(session, SB_SIGNAL_FRAMES);
  } else if (sb_session_computes(session)) {
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
  return sb_session_computes(session) || session->playhead.playing ||
         (session->shown != NULL && !sb_displayed_run_complete(session->shown));
}

// Life -------------------------------------------------------------------------------------------

static void drop_runs(SbSession *session) {
  session->edited = 0;
  session->latency = (SbEditLatency){NAN, NAN};
  sb_session_go(session, SB_REQUEST_NONE);
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
