// The film's history through a run: each seal's velocity of frame after frame goes through the
// transient film (film/transient.h), so that stops squeeze the film, reversals carry the old one
// back through the contact, and the frames show that in place of the steady film.
//
// A stretch is as long as the seal's whole contact lies on the land between the same pressures; the
// next begins with the film that was there, evened out. The first begins with fluid.rest_film. The
// load is the stretch's own. Lambda, real area and friction of a frame follow its film; the motion
// and the figures of a seal keep to the steady one. From where a film fails its frames have none.
// Left out: the land's edge under the contact and the step of the pressures themselves.
#include <math.h>

#include "engine/film/transient.h"
#include "engine/valve/figures.h"
#include "engine/valve/run/run_private.h"

// One seal's film through the frames.
typedef struct {
  SbRun *run;
  int seal;
  double speed_scale;
  SbFilmTransient *film; // of the present stretch, NULL between stretches
  int chamber;           // of the stretch
  double central;        // last film [m], what the next stretch begins with
  size_t frame;          // that it has come to
  double error;          // largest estimate of the least film
} History;

static bool whole_contact(const SbFrame *frame, int seal) {
  const SbSealFrame *s = &frame->seal[seal];
  return s->land_fraction > 0.999F && s->contact_right > s->contact_left;
}

static void end_stretch(History *history) {
  if (history->film != NULL) {
    const SbFilmTransientResult result = sb_film_transient_result(history->film);
    SbSummary *summary = &history->run->summary;
    summary->counters.film_steps += result.steps;
    summary->counters.newton_iterations += result.newton_iterations;
  }
  sb_film_transient_destroy(history->film);
  history->film = NULL;
}

// Begins a stretch at rest.
static SbStatus begin_stretch(History *history, int chamber, const SbRunHooks *hooks,
                              SbReport *report) {
  const SbRun *run = history->run;
  const SbSealState *state = &run->cycle.state[history->seal][chamber][SB_CYCLE_IN];
  const SbSealPressure pressure =
      sb_model_seal_pressure(run->model, history->seal, (SbChamber)chamber);
  SbFilmTransientProblem problem = {.speed_scale = history->speed_scale,
                                    .rest_film = history->central};
  sb_sliding_film_problem(&problem.film, run->model, history->seal, pressure, state->load_net, 0);
  const SbRunSurface *surface = &run->surface[history->seal][chamber];
  if (state->film_fitted && surface->known) {
    problem.film.compliance = &surface->compliance;
    problem.film.load = surface->load;
    problem.film.modulus = surface->compliance.modulus;
  }
  problem.film.cancelled = hooks->cancelled;
  problem.film.cancelled_data = hooks->data;

  // A front in the middle of the contact is smeared over a few hundredths of it; finer costs more
  // than a drawing gains.
  problem.film.tolerance = fmax(run->model->tolerance, 3e-3);
  history->chamber = chamber;
  return sb_film_transient_create(&history->film, &problem, report);
}

// One seal through all frames.
static SbStatus replay(History *history, size_t count, const SbRunHooks *hooks, SbReport *report) {
  SbRun *run = history->run;
  for (size_t i = 0; i < count; i++) {
    SbFrame *frame = &run->frames[i];
    history->frame = i;
    const double dt = i > 0 ? frame->time - run->frames[i - 1].time : 0;
    if (!whole_contact(frame, history->seal) ||
        (history->film != NULL && history->chamber != (int)frame->chamber)) {
      end_stretch(history);
    }
    if (!whole_contact(frame, history->seal)) {
      continue;
    }
    if (i % 16 == 0 && sb_run_cancelled(hooks, report)) {
      return SB_ERROR_CANCELLED;
    }
    SbStatus status = SB_OK;
    if (history->film == NULL) {
      status = begin_stretch(history, frame->chamber, hooks, report);
    } else if (dt > 0) {
      status = sb_film_transient_step(history->film, dt, frame->velocity, report);
    }
    if (status != SB_OK) {
      return status;
    }
    const SbFilmTransientResult result = sb_film_transient_result(history->film);
    history->central = result.film_central;
    // Least film of the coarse setting: the companion's difference and the bend of what its spacing
    // does not know. Without the companion nothing is known.
    const double least = result.error_film_min;
    history->error = isnan(least) ? INFINITY : fmax(history->error, least);
    sb_run_frame_film(frame, run, history->seal, result.film_min, result.film_central);
  }
  return SB_OK;
}

SbStatus sb_run_film_history(SbRun *run, size_t count, const SbRunHooks *hooks, SbReport *report) {
  static const char figure[] = "solver.error_estimate.film_history";
  SbSummary *summary = &run->summary;
  SbStatus worst = SB_OK;
  summary->error_film_history = 0;
  for (int seal = 0; seal < SB_SEAL_COUNT && worst != SB_ERROR_CANCELLED; seal++) {
    History history = {.run = run, .seal = seal, .central = run->model->rest_film};
    for (size_t i = 0; i < count; i++) {
      history.speed_scale = fmax(history.speed_scale, fabs(run->frames[i].velocity));
    }
    if (history.speed_scale == 0) {
      continue;
    }
    SbReport own = {0}, whole = {0};
    const SbStatus status = replay(&history, count, hooks, &own);
    end_stretch(&history);
    if (isinf(history.error)) {
      sb_reason(summary, figure, "%s seal: the film of half the resolution did not converge",
                sb_seal_name(seal));
    }
    if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
      worst = sb_fail(report, status, "%s", own.text);
    } else if (status != SB_OK) {
      SbFrame *at = &run->frames[history.frame];
      (void)sb_fail(
          &whole, status,
          "film in time, %s seal, stage %s, stem at %.4g mm, %.4g s: %.100s; kept: the films "
          "before, the motion",
          sb_seal_name(seal), sb_stage_name((SbStage)at->stage), 1e3 * at->displacement, at->time,
          own.text);
      sb_warn(&summary->warnings, "film-history", "models.film_time", "%s", whole.text);
      for (; at < run->frames + count; at++) {
        at->seal[seal].film_min = at->seal[seal].film_central = at->seal[seal].lambda = NAN;
        at->seal[seal].real_area_share = NAN;
      }
      history.error = INFINITY;
      sb_reason(summary, figure, "%s", whole.text);
      if (status == SB_ERROR_NOT_CONVERGED && worst == SB_OK) {
        worst = sb_fail(report, status, "%s", whole.text);
      }
    }
    summary->error_film_history = fmax(summary->error_film_history, history.error);
  }
  if (isinf(summary->error_film_history)) {
    summary->error_film_history = NAN;
  }
  return worst;
}
