// What a session shows: the state, age and names of the displayed run, and what
// views are given of them.
#include "app/session/session_private.h"

#include "app/base/format.h"
#include "app/base/translation.h"

#include <glib/gi18n.h>
#include <string.h>

void sb_session_set_reference(SbDisplayedRun **run, SbDisplayedRun *value) {
  SbDisplayedRun *old = *run;
  *run = sb_displayed_run_ref(value);
  sb_displayed_run_unref(old);
}

// What views see ---------------------------------------------------------------------------------

// What the displayed run is; whether it is of the present values is another question.
static SbSessionState shown_state(const SbSession *session) {
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
gboolean sb_session_is_former(SbSession *session) {
  const bool soon = sb_session_delays(session) ||
                    (sb_session_computes(session) &&
                     g_get_monotonic_time() - session->started <= SB_SESSION_WATCH_US);
  if (session->shown == NULL || (soon && !session->heavy)) {
    return FALSE;
  }
  return sb_session_is_stale(session, NULL, NULL);
}

void sb_session_refresh_chart(SbSession *session) {
  SbChartData *chart = &session->chart;
  memset(chart, 0, sizeof *chart);
  if (session->shown != NULL) {
    chart->run = session->shown->chart;
  } else if (sb_session_computes(session)) {
    // Nothing to show before the first frame; the axes are those of the values.
    chart->run.state = SB_CHART_RUNNING;
    chart->run.model = sb_session_model(session);
  }
  chart->earlier = session->earlier != NULL ? &session->earlier->chart : NULL;
  chart->predicted = session->predicted ? sb_prediction_chart(session->prediction) : NULL;
  chart->measured = sb_session_compare(session);
  chart->playhead = session->playhead.frame;
  chart->playing = session->playhead.playing;
  chart->progress = sb_session_progress(session);
  chart->title = sb_document_title(session->document);
  chart->hash = session->hash;
  chart->failure = session->failure;
  sb_session_chart_pins(session);
  sb_session_refresh_markers(session);
}

void sb_session_run_changed(SbSession *session) {
  g_free(session->hash);
  session->hash = sb_document_sha256(session->document);
  sb_session_predict(session);
  session->former = sb_session_is_former(session);
  if (session->edited != 0 && session->shown != NULL &&
      session->shown->chart.state == SB_CHART_DONE && !sb_session_is_stale(session, NULL, NULL)) {
    session->latency.shown = 1e-6 * (double)(g_get_monotonic_time() - session->edited);
    session->edited = 0;
  }
  sb_session_refresh_chart(session);
  sb_session_find_slopes(session);
  sb_session_emit(session, SB_SIGNAL_RUN);
}

void sb_session_playhead_changed(SbSession *session) {
  session->chart.playhead = session->playhead.frame;
  session->chart.playing = session->playhead.playing;
  sb_session_place_pins(session);
  sb_session_place_predicted(session);
  sb_session_emit(session, SB_SIGNAL_PLAYHEAD);
}

const SbChartData *sb_session_chart(SbSession *session) {
  return &session->chart;
}

// Questions --------------------------------------------------------------------------------------

SbSessionState sb_session_state(SbSession *session) {
  // A light run that waits for its timer begins before anybody sees the state.
  const bool running =
      session->request == SB_REQUEST_DELAYED ? session->heavy : session->request != SB_REQUEST_NONE;
  return running                    ? SB_SESSION_RUNNING
         : session->failure != NULL ? SB_SESSION_FAILED
                                    : shown_state(session);
}

SbEditLatency sb_session_latency(SbSession *session) {
  return session->latency;
}

double sb_session_progress(SbSession *session) {
  return sb_session_computes(session) && session->fresh != NULL
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

SbRunGrade sb_session_grade(SbSession *session) {
  return session->shown != NULL ? session->shown->grade : SB_GRADE_WHOLE;
}

char *sb_session_grade_text(SbSession *session) {
  switch (sb_session_grade(session)) {
  case SB_GRADE_CLOSED:
    return g_strdup(_("closed forms, rings follow"));
  case SB_GRADE_COARSE:
  case SB_GRADE_NEAR:
    return g_strdup(_("coarse, to 1 %"));
  case SB_GRADE_STORED:
    return g_strdup_printf(_("stored result of %s"), session->shown->date);
  default:
    return NULL;
  }
}

gboolean sb_session_may_keep(SbSession *session) {
  return session->shown != NULL && session->shown->chart.summary != NULL &&
         session->shown->grade == SB_GRADE_WHOLE;
}

SbRunHandle *sb_session_handle(SbSession *session) {
  return sb_session_may_keep(session) ? sb_run_handle_ref(session->shown->handle) : NULL;
}

const SbSummary *sb_session_summary(SbSession *session) {
  return session->shown != NULL ? session->shown->chart.summary : NULL;
}

const char *sb_session_failure(SbSession *session) {
  return session->failure;
}

gboolean sb_session_is_faulty(const SbSession *session) {
  return session->faulty;
}

gboolean sb_session_is_stale(SbSession *session, int *id, double *value) {
  if (session->shown == NULL) {
    return FALSE;
  }
  SbParams params = sb_document_params(session->document);
  const uint64_t drawn = sb_model_drawings(sb_run_model(session->shown->run));
  int found = session->model != NULL && drawn != sb_session_drawings(session) ? 1 : 0;
  if (found > 0 && id != NULL) {
    *id = -1;
  }
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

gboolean sb_session_awaits(SbSession *session) {
  return session->former && sb_session_state(session) == SB_SESSION_RUNNING;
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
