// What the run of a session will be at values that are not solved yet: the base, the last whole run
// of solved rings, and its slopes (tangent.h), which stay with that run. They are found in the
// background, on a thread of its own: first those of the parameter that is edited and of what
// differs from the base, at any time but while a single edit is solved; then, while no other run is
// wanted and nothing plays, those of all main parameters. Each takes two runs whose rings are the
// base's to first order. Figures have the engine's derivatives (slope_job.h), which follow in the
// same order while no run is wanted: they take full solves.
#include "app/session/session_private.h"

#include <math.h>

void sb_session_predict(SbSession *session) {
  SbParams params = sb_document_params(session->document);
  session->predicted =
      session->shown != NULL && session->model != NULL && session->base != NULL &&
      sb_session_is_stale(session, NULL, NULL) &&
      sb_prediction_make(session->prediction, session->base, &params, session->model);
  session->chart.predicted = NULL;
  if (session->predicted) {
    session->chart.predicted = sb_prediction_chart(session->prediction);
    sb_session_place_predicted(session);
  }
}

void sb_session_place_predicted(SbSession *session) {
  if (session->predicted) {
    sb_prediction_show(session->prediction, sb_session_frame_of(session, session->base));
  }
}

const SbSummary *sb_session_predicted(SbSession *session) {
  return session->predicted ? sb_prediction_chart(session->prediction)->run.summary : NULL;
}

// Gives up what is under way.
static void cancel(SbSession *session) {
  if (session->slope_ticket != 0) {
    sb_runner_cancel(session->slopes);
    session->slope_ticket = 0;
  }
  session->slope_down = false;
  session->slope_id = SB_SLOPE_NONE;
  g_clear_pointer(&session->slope_up, sb_displayed_run_unref);
}

void sb_session_drop_base(SbSession *session) {
  cancel(session);
  g_clear_pointer(&session->slope_job, sb_slope_job_free);
  session->predicted = FALSE; // it is of that base
  session->chart.predicted = NULL;
  sb_session_set_reference(&session->base, NULL);
}

void sb_session_set_base(SbSession *session, SbDisplayedRun *run) {
  if (run->grade == SB_GRADE_WHOLE && sb_run_plan(run->run)->ring && session->base != run) {
    sb_session_drop_base(session);
    sb_session_set_reference(&session->base, run);
  }
}

// ---- What is wanted

static bool is_wanted(const SbSession *session, int id) {
  return sb_param((SbParamId)id)->kind == SB_PARAM_REAL && !session->base->sought[id];
}

// Whether a coarse run of a single edit is on its way: it is there as soon as slopes would be, and
// on two cores they slow it down.
static bool is_soon_there(const SbSession *session) {
  const bool near = sb_session_computes(session) && session->grade == SB_GRADE_NEAR;
  return session->lone && session->edited != 0 && (near || sb_session_delays(session));
}

static bool is_idle(const SbSession *session) {
  return session->request == SB_REQUEST_NONE && !session->playhead.playing;
}

// The parameter whose slopes are to be found now; SB_SLOPE_NONE: none.
static int next_wanted(SbSession *session) {
  if (session->base == NULL || is_soon_there(session)) {
    return SB_SLOPE_NONE;
  }
  if (session->slope_first >= 0 && is_wanted(session, session->slope_first)) {
    return session->slope_first;
  }
  const SbParams params = sb_document_params(session->document);
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    if (is_wanted(session, id) && sb_prediction_differs(&session->base->params, &params, id)) {
      return id;
    }
  }
  const int kind = (int)sb_params_get(&params, SB_P_VALVE_KIND);
  const bool idle = is_idle(session);
  for (int id = 0; idle && id < SB_PARAM_COUNT; id++) {
    if (sb_param_is_main((SbParamId)id, kind) && is_wanted(session, id)) {
      return id;
    }
  }
  return SB_SLOPE_NONE;
}

// The base's values with one of them moved to a side; false where there is no room for that.
static bool move(SbParams *params, const SbDisplayedRun *base, int id, bool down) {
  const double value = sb_params_get(&base->params, (SbParamId)id);
  const double step = SB_TANGENT_STEP * fabs(value);
  *params = base->params;
  return value != 0 &&
         sb_params_set(params, (SbParamId)id, value + (down ? -step : step), NULL) == SB_OK;
}

// Asks for a run beside the base; false where there is none.
static bool submit(SbSession *session, int id) {
  const SbDisplayedRun *base = session->base;
  const bool moves = id != SB_SLOPE_LEVEL;
  session->slope_params = base->params;
  if (moves && !move(&session->slope_params, base, id, session->slope_down)) {
    return false;
  }
  const SbParamId of = moves ? (SbParamId)id : (SbParamId)0;
  const SbOverride moved = {of, sb_params_get(&session->slope_params, of)};
  g_autoptr(SbModel) model = NULL;
  if (sb_model_derive(&model, sb_run_model(base->run), &moved, moves ? 1 : 0, NULL) != SB_OK) {
    return false;
  }
  if (session->slopes == NULL) {
    session->slopes = sb_runner_create(sb_session_notify, session->inbox, true);
  }
  if (session->slopes == NULL) {
    return false;
  }
  session->slope_id = id;
  session->slope_ticket = sb_runner_submit(
      session->slopes, &(SbRunRequest){.model = model,
                                       .wishes = {.views = SB_VIEW_HYSTERESIS | SB_VIEW_PROFILES},
                                       .start = base->handle,
                                       .tangent = true,
                                       .alone = true});
  return true;
}

// ---- What is found

// Makes the slopes of what both sides are known of; `down` may be NULL.
static void take_slopes(SbSession *session, int id, SbDisplayedRun *down) {
  SbDisplayedRun *base = session->base;
  const SbTangentRuns runs = {base->level, session->slope_up, down};
  base->sought[id] = true;
  base->tangent[id] =
      runs.up != NULL || down != NULL ? sb_tangent_new(base, &runs, (SbParamId)id) : NULL;
  g_clear_pointer(&session->slope_up, sb_displayed_run_unref);
  session->slope_down = false;
  session->slope_id = SB_SLOPE_NONE;
  if (base->tangent[id] != NULL && sb_session_is_stale(session, NULL, NULL)) {
    sb_session_run_changed(session);
    if (session->predicted && session->edited != 0 && isnan(session->latency.predicted)) {
      session->latency.predicted = 1e-6 * (double)(g_get_monotonic_time() - session->edited);
    }
    sb_session_emit(session, SB_SIGNAL_FRAMES);
  }
}

// Takes what a run beside the base has ended with (NULL: with nothing).
static void take_slope(SbSession *session, SbDisplayedRun *run) {
  const int id = session->slope_id;
  if (id == SB_SLOPE_LEVEL) {
    session->base->level = sb_displayed_run_ref(run);
    session->slope_id = SB_SLOPE_NONE;
    for (int i = 0; run == NULL && i < SB_PARAM_COUNT; i++) {
      session->base->sought[i] = true; // such rings have no slopes
    }
  } else if (!session->slope_down) {
    session->slope_up = sb_displayed_run_ref(run);
    session->slope_down = true;
    if (!submit(session, id)) {
      take_slopes(session, id, NULL);
    }
  } else {
    take_slopes(session, id, run);
  }
}

// ---- Derivatives of the figures

static bool is_to_differentiate(const SbSession *session, int id) {
  return session->base->tangent[id] != NULL && !session->base->differentiated[id];
}

// The parameter by which the base's figures are to be differentiated next; SB_SLOPE_NONE: none.
static int next_to_differentiate(const SbSession *session) {
  if (session->base == NULL || !is_idle(session)) {
    return SB_SLOPE_NONE;
  }
  if (session->slope_first >= 0 && is_to_differentiate(session, session->slope_first)) {
    return session->slope_first;
  }
  int id = 0;
  while (id < SB_PARAM_COUNT && !is_to_differentiate(session, id)) {
    id++;
  }
  return id < SB_PARAM_COUNT ? id : SB_SLOPE_NONE;
}

static void differentiate(SbSession *session);

static void on_differentiated(void *data) {
  SbSession *session = data;
  SbParamId id;
  SbGradient *gradient = sb_slope_job_take(session->slope_job, &id);
  session->base->gradient[id] = gradient;
  session->base->differentiated[id] = true;
  const SbParams params = sb_document_params(session->document);
  if (session->predicted && sb_prediction_differs(&session->base->params, &params, (int)id)) {
    sb_session_predict(session);
    sb_session_emit(session, SB_SIGNAL_FRAMES);
  }
  differentiate(session);
}

static void differentiate(SbSession *session) {
  const int id = next_to_differentiate(session);
  if (id == SB_SLOPE_NONE ||
      (session->slope_job != NULL && sb_slope_job_is_busy(session->slope_job))) {
    return;
  }
  if (session->slope_job == NULL) {
    session->slope_job = sb_slope_job_new(sb_run_model(session->base->run));
  }
  sb_slope_job_start(session->slope_job, (SbParamId)id, on_differentiated, session);
}

static void find_tangents(SbSession *session) {
  for (;;) {
    const int wanted = next_wanted(session);
    const bool other = session->slope_id != wanted && session->slope_id != SB_SLOPE_LEVEL;
    if (session->slope_ticket != 0 && other) {
      cancel(session);
    }
    if (session->slope_ticket != 0 || wanted == SB_SLOPE_NONE) {
      return;
    }
    const int id = session->base->level == NULL ? SB_SLOPE_LEVEL : wanted;
    session->slope_down = false;
    if (submit(session, id)) {
      return;
    }
    session->slope_id = id;
    take_slope(session, NULL);
  }
}

void sb_session_find_slopes(SbSession *session) {
  find_tangents(session);
  differentiate(session);
}

void sb_session_prepare(SbSession *session, SbParamId id) {
  session->slope_first = (int)id;
  sb_session_find_slopes(session);
}

void sb_session_poll_slope(SbSession *session) {
  SbRunHandle *handle = session->slope_ticket != 0 ? sb_runner_latest(session->slopes) : NULL;
  if (handle == NULL || sb_run_handle_ticket(handle) != session->slope_ticket ||
      !sb_run_handle_is_done(handle)) {
    sb_run_handle_unref(handle);
    return;
  }
  session->slope_ticket = 0;
  SbDisplayedRun *run = NULL;
  if (sb_run_handle_status(handle) == SB_OK) {
    run = sb_displayed_run_new(handle, &session->slope_params, SB_GRADE_NEAR);
    sb_displayed_run_update(run, G_MAXSIZE);
  } else {
    sb_run_handle_unref(handle);
  }
  take_slope(session, run);
  sb_displayed_run_unref(run);
  sb_session_find_slopes(session);
}
