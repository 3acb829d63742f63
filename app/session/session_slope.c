// What the loop of a session will be at values that are not solved yet: the base whose rings and
// tangents serve, and the runs beside it that give the tangents (prediction.h). A neighbour is
// computed on a thread of its own when an edit of a parameter begins, its rings the base's to first
// order; what is solved for the edits themselves serves as well.
#include "app/session/session_private.h"

#include <math.h>

// A neighbour's change, over the value. Its rings are the base's to first order, without the
// scatter of solved ones, so that a small step does.
static const double STEP = 0.004;

void sb_session_predict(SbSession *session) {
  SbParams params = sb_document_params(session->document);
  session->predicted = session->shown != NULL && session->model != NULL &&
                       sb_session_is_stale(session, NULL, NULL) &&
                       sb_prediction_make(session->prediction, &params);
  session->chart.predicted = session->predicted ? sb_prediction_curve(session->prediction) : NULL;
}

static void cancel(SbSession *session) {
  if (session->slope_ticket != 0) {
    sb_runner_cancel(session->slopes);
    session->slope_ticket = 0;
  }
}

void sb_session_set_base(SbSession *session, SbDisplayedRun *run) {
  if (run->grade == SB_GRADE_WHOLE && sb_run_plan(run->run)->ring) {
    if (session->base != run) {
      cancel(session);
    }
    sb_session_hold(&session->base, run);
    sb_prediction_set_base(session->prediction, run);
  } else if (run->grade == SB_GRADE_NEAR) {
    sb_prediction_take(session->prediction, run);
  }
}

void sb_session_drop_base(SbSession *session) {
  cancel(session);
  sb_session_hold(&session->base, NULL);
  sb_prediction_set_base(session->prediction, NULL);
  session->predicted = FALSE;
}

// The base's values with one of them moved; false where there is no room for that.
static bool move(SbParams *params, const SbDisplayedRun *base, SbParamId id) {
  const double value = sb_params_get(&base->params, id);
  for (int sign = 1; sign >= -1; sign -= 2) {
    *params = base->params;
    if (value != 0 && sb_params_set(params, id, (1 + sign * STEP) * value, NULL) == SB_OK) {
      return true;
    }
  }
  return false;
}

void sb_session_prepare(SbSession *session, SbParamId id) {
  const SbDisplayedRun *base = session->base;
  SbParams params;
  if (base == NULL || sb_param(id)->kind != SB_PARAM_REAL ||
      sb_prediction_knows(session->prediction, id) ||
      (session->slope_ticket != 0 && session->slope_id == id) || !move(&params, base, id)) {
    return;
  }
  const SbOverride moved = {id, sb_params_get(&params, id)};
  g_autoptr(SbModel) model = NULL;
  if (sb_model_derive(&model, sb_run_model(base->run), &moved, 1, NULL) != SB_OK) {
    return;
  }
  if (session->slopes == NULL) {
    session->slopes = sb_runner_create(sb_session_notify, session->inbox);
  }
  if (session->slopes != NULL) {
    session->slope_id = id;
    session->slope_params = params;
    session->slope_ticket = sb_runner_submit(
        session->slopes,
        &(SbRunRequest){.model = model, .start = base->handle, .tangent = true, .alone = true});
  }
}

void sb_session_poll_slope(SbSession *session) {
  SbRunHandle *handle = session->slope_ticket != 0 ? sb_runner_latest(session->slopes) : NULL;
  if (handle == NULL || sb_run_handle_ticket(handle) != session->slope_ticket ||
      !sb_run_handle_is_done(handle)) {
    sb_run_handle_unref(handle);
    return;
  }
  session->slope_ticket = 0;
  if (sb_run_handle_status(handle) != SB_OK) {
    sb_run_handle_unref(handle); // that parameter has no tangent
    return;
  }
  SbDisplayedRun *run = sb_displayed_run_new(handle, &session->slope_params, SB_GRADE_NEAR);
  sb_displayed_run_update(run, G_MAXSIZE);
  sb_prediction_take(session->prediction, run);
  sb_displayed_run_unref(run);
  sb_session_predict(session);
  sb_session_emit(session, SB_SIGNAL_FRAMES);
}
