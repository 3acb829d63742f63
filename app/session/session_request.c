// Requests of runs by a session. An edit starts a run, after a short delay if the run is
// expensive; a newer edit cancels it and starts again with the newest values. The new run replaces
// the displayed one when it is complete, or when it has lasted so long that it is displayed while
// it grows. The earlier run is then drawn paler behind it until the new one is complete, and is
// displayed again if the new one fails. The run of values that were solved before is reused
// (run_cache.h).
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

#include "app/document/shipped.h"
#include "app/session/stored_run.h"

#include <glib/gi18n.h>
#include <math.h>

enum {
  DELAY_MS = 30, // before a heavy run of several edits; an overtaken one ends within 50 ms
  IDLE_MS = 1000 // after a near run, before the whole one
};

// Expected time of a run from which on it comes in grades [s], and the share of it that a coarse
// run may take.
static const double HEAVY_S = 0.15, COARSE_SHARE = 0.5;

// Of a coarse run.
static const double COARSE_TOLERANCE = 0.01, COARSE_FRAMES = 200;

void sb_session_go(SbSession *session, SbRequestState to) {
#define TO(state) (1u << SB_REQUEST_##state)
  static const unsigned next[] = {
      [SB_REQUEST_NONE] = TO(NONE) | TO(DELAYED) | TO(COMPUTED) | TO(PAUSED),
      [SB_REQUEST_DELAYED] = TO(NONE) | TO(COMPUTED),
      [SB_REQUEST_COMPUTED] = TO(NONE) | TO(COMPUTED) | TO(OVERTAKEN),
      [SB_REQUEST_OVERTAKEN] = TO(NONE) | TO(COMPUTED) | TO(DELAYED),
      [SB_REQUEST_PAUSED] = TO(NONE) | TO(COMPUTED),
  };
#undef TO
  const SbRequestState from = session->request;
  g_return_if_fail(next[from] >> to & 1);
  if (session->timer != 0 && !(from == SB_REQUEST_OVERTAKEN && to == SB_REQUEST_DELAYED)) {
    g_source_remove(session->timer);
    session->timer = 0;
  }
  session->request = to;
  session->ticket = sb_session_computes(session) ? session->ticket : 0;
}

bool sb_session_computes(const SbSession *session) {
  return session->request == SB_REQUEST_COMPUTED || session->request == SB_REQUEST_OVERTAKEN;
}

bool sb_session_delays(const SbSession *session) {
  return session->request == SB_REQUEST_DELAYED || session->request == SB_REQUEST_OVERTAKEN;
}

// Ends what waits, not what is computed.
static void end_delay(SbSession *session) {
  sb_session_go(session, sb_session_computes(session) ? SB_REQUEST_COMPUTED : SB_REQUEST_NONE);
}

uint64_t sb_session_drawings(const SbSession *session) {
  return session->model != NULL ? sb_model_drawings(session->model) : 0;
}

bool sb_session_answers(const SbDisplayedRun *run, const SbParams *params, uint64_t drawings) {
  return run != NULL && run->chart.state == SB_CHART_DONE &&
         sb_displayed_run_is_of(run, params, drawings);
}

bool sb_session_is_current(const SbSession *session) {
  const SbParams present = sb_document_params(session->document);
  return session->model != NULL && session->asked_drawings == sb_session_drawings(session) &&
         sb_same_values(&session->asked, &present);
}

static void ask_request(SbSession *session) {
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

void sb_session_submit(SbSession *session, SbRunGrade grade) {
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
  ask_request(session);
  session->grade = grade;
  session->started = g_get_monotonic_time();
  sb_session_go(session, SB_REQUEST_COMPUTED);
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
  if (!session->heavy ||
      sb_session_answers(session->shown, &session->asked, session->asked_drawings)) {
    return SB_GRADE_WHOLE; // asked for again
  }
  // Rings of another drawing are no neighbours.
  const bool near = session->base != NULL &&
                    sb_model_drawings(sb_run_model(session->base->run)) == session->asked_drawings;
  return near ? SB_GRADE_NEAR : session->shown == NULL ? SB_GRADE_CLOSED : SB_GRADE_COARSE;
}

static gboolean on_idle_long(gpointer data) {
  SbSession *session = data;
  session->timer = 0;
  sb_session_submit(session, SB_GRADE_WHOLE);
  sb_session_run_changed(session);
  return G_SOURCE_REMOVE;
}

void sb_session_continue(SbSession *session) {
  if (session->shown->grade == SB_GRADE_CLOSED) {
    sb_session_submit(session, SB_GRADE_COARSE);
  } else if (session->shown->grade == SB_GRADE_COARSE || session->shown->grade == SB_GRADE_STORED) {
    sb_session_submit(session, SB_GRADE_WHOLE);
  } else if (session->shown->grade == SB_GRADE_NEAR) {
    sb_session_go(session, SB_REQUEST_PAUSED);
    session->timer = g_timeout_add(IDLE_MS, on_idle_long, session);
  }
}

void sb_session_keep_run(SbSession *session, SbDisplayedRun *run) {
  if (run->grade > SB_GRADE_COARSE) {
    sb_run_cache_put(session->cache, run);
  }
  sb_session_set_base(session, run);
}

// Start ------------------------------------------------------------------------------------------

// Begins the run of the present values; FALSE: they make no model. Not inlined: callers have
// parameters on their stacks as well.
static G_NO_INLINE gboolean begin_request(SbSession *session) {
  end_delay(session);
  if (session->model == NULL) {
    return FALSE;
  }
  // A run that this one overtakes while it was being watched makes room for the one before it, or
  // stays as the part that it is.
  if (sb_session_computes(session) && session->shown != NULL && session->shown == session->fresh) {
    session->shown->chart.state = SB_CHART_PARTIAL;
    if (session->earlier != NULL) {
      sb_session_remember_place(session);
      sb_session_set_reference(&session->shown, session->earlier);
      sb_session_place_playhead(session);
    }
  }
  sb_session_set_reference(&session->earlier, NULL);
  g_clear_pointer(&session->failure, g_free);
  ask_request(session);
  sb_session_submit(session, first_grade(session));
  return TRUE;
}

static void start_now(SbSession *session) {
  if (begin_request(session)) {
    sb_session_run_changed(session);
  }
}

static gboolean on_delayed(gpointer data) {
  SbSession *session = data;
  session->timer = 0;
  start_now(session);
  return G_SOURCE_REMOVE;
}

// Reports a run that has begun.
static gboolean on_begun(gpointer data) {
  SbSession *session = data;
  session->timer = 0;
  sb_session_run_changed(session);
  return G_SOURCE_REMOVE;
}

// Shows a complete run of the present values in place of what is shown or under way.
static void adopt(SbSession *session, SbDisplayedRun *run) {
  if (sb_session_computes(session)) {
    sb_runner_cancel(session->runner);
  }
  sb_session_go(session, SB_REQUEST_NONE);
  if (run != session->shown) {
    sb_session_set_reference(&session->fresh, run);
    sb_session_display_fresh(session);
    sb_session_place_playhead(session);
  }
  sb_session_set_reference(&session->fresh, NULL);
  sb_session_set_reference(&session->earlier, NULL);
  g_clear_pointer(&session->failure, g_free);
  sb_session_set_base(session, session->shown);
  if (session->auto_run) {
    sb_session_continue(session);
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
  end_delay(session);
  session->heavy = session->model != NULL && expected(session->model, false) > HEAVY_S;
  sb_session_predict(session);
  const bool computes = sb_session_computes(session);
  if (!computes || !sb_session_is_current(session)) {
    const uint64_t drawings = sb_session_drawings(session);
    SbDisplayedRun *known = session->model == NULL ? NULL
                            : sb_session_answers(session->shown, &params, drawings)
                                ? session->shown
                                : sb_run_cache_get(session->cache, &params, drawings);
    // A file is looked for where nothing else is shown: later, what is known here starts better.
    SbDisplayedRun *stored = known == NULL && session->heavy && session->shown == NULL && !computes
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
      // next. The run of a single edit begins before it is reported, which takes the window 40 ms.
      const bool grades = session->heavy && session->shown != NULL;
      const bool begun = grades && session->lone && begin_request(session);
      const guint wait = grades && !session->lone ? DELAY_MS : 0;
      if (!begun) {
        sb_session_go(session, computes ? SB_REQUEST_OVERTAKEN : SB_REQUEST_DELAYED);
      }
      session->timer = g_timeout_add(wait, begun ? on_begun : on_delayed, session);
    }
  }
  session->former = sb_session_is_former(session);
}

void sb_session_start(SbSession *session) {
  start_now(session);
}

void sb_session_stop(SbSession *session) {
  const bool begun = sb_session_computes(session) && session->fresh != NULL;
  const bool wanted = session->request != SB_REQUEST_NONE;
  sb_runner_cancel(session->runner);
  if (begun || !wanted) {
    end_delay(session);
  } else {
    sb_session_go(session, SB_REQUEST_NONE);
    sb_session_run_changed(session);
  }
}

void sb_session_set_auto_run(SbSession *session, gboolean on) {
  session->auto_run = on;
  if (on) {
    sb_session_values_changed(session);
  }
}
