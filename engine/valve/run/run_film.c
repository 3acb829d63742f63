// The film's history through a run: the transient film (film/transient.h) follows the velocity of
// each seal from frame to frame. Stops squeeze the film, reversals carry the old film back through
// the contact, and the frames show this film instead of the steady one.
//
// A stretch lasts as long as the seal's full contact is on the land between the same pressures, and
// has one direction of sliding if the two directions have different contacts. The next stretch
// begins with the present film, made uniform. The first begins with fluid.rest_film. Body, load and
// inlets are those of the steady states (run_supply.c). While a seal slides out of a room without
// liquid it has no film. Lambda, real area and friction of a frame follow its film; the motion and
// the figures of a seal use the steady one. A stretch whose film collapses is repeated on a mesh
// for thinner films: it has slowed down to films far thinner than at its start, whose necks the
// edges' spacing does not resolve. A stretch whose error is larger than its film is repeated with a
// smaller tolerance. From the instant at which a film fails its frames have none. Not
// modelled: the land's edge under the contact, and the step of the pressures themselves.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "engine/film/transient.h"
#include "engine/valve/figures/figures.h"
#include "engine/valve/run/run_private.h"

// A stretch is followed so many times more, for films thinner by this factor.
enum { FINER_MAX = 2 };
static const double THINNER = 0.05;

// The tolerance of a stretch. A front in the middle of the contact is then smeared over a few
// hundredths of it; finer costs more than a drawing gains. A stretch whose estimated error is above
// UNKNOWN is followed so many times more, each time with a tolerance smaller by this factor.
static const double COARSEST = 3e-3, SHARPER = 0.3, UNKNOWN = 1;
enum { SHARPER_MAX = 3 };

// One seal's film through the frames.
typedef struct {
  SbRun *run;
  int seal;
  double speed_scale;
  SbFilmTransient *film; // of the present stretch, NULL between stretches
  int chamber;           // of the stretch
  int direction;         // of sliding; below 0: not yet
  bool fitted;           // the film is on the fitted body
  double central;        // last film [m], what the next stretch begins with
  size_t frame;          // that it has come to
  double error;          // largest estimate of the history of the minimum film
  int finer;             // times that the stretch's mesh was made for thinner films
  int sharper;           // times that the stretch's tolerance was made smaller
  size_t begin;          // of the stretch: frame; film, error and direction of sliding before it
  double begin_central, begin_error;
  int begin_direction;
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

// Returns whether a seal has the same contact in both directions of sliding; a stretch then
// continues through a reversal.
static bool both_alike(const SbRun *run, int seal, int chamber) {
  const SbSealState *in = &run->cycle.state[seal][chamber][SB_CYCLE_IN];
  const SbSealState *back = &run->cycle.state[seal][chamber][SB_CYCLE_OUT];
  return in->load_net == back->load_net && in->contact_left == back->contact_left &&
         in->contact_right == back->contact_right;
}

// Begins a stretch at rest.
static SbStatus begin_stretch(History *history, int chamber, const SbRunHooks *hooks,
                              SbReport *report) {
  SbRun *run = history->run;
  const int seal = history->seal;
  SbFilmTransientProblem problem = {.speed_scale = history->speed_scale,
                                    .rest_film = history->central > 0 ? history->central
                                                                      : run->model->rest_film};
  if (history->finer > 0) {
    problem.least_film = problem.rest_film * pow(THINNER, history->finer);
  }
  history->fitted = sb_run_film_of(&problem.film, run, seal, chamber, history->direction) != NULL;
  problem.film.speed = problem.film.inlet_film = 0;
  for (int way = SB_CYCLE_IN; way <= SB_CYCLE_OUT; way++) {
    const SbSupply supply = sb_run_supply(run, seal, (SbChamber)chamber, way);
    // By the way of the surface along x, first to the right.
    const bool right = (way == SB_CYCLE_IN) == (sb_model_way(run->model) > 0);
    problem.inlet_film[right ? 0 : 1] = supply.limited ? supply.layer : 0;
  }
  problem.film.cancelled = sb_work_step;
  problem.film.cancelled_data = run->work;
  problem.film.tolerance = fmax(run->model->tolerance, COARSEST) * pow(SHARPER, history->sharper);
  history->chamber = chamber;
  SbStatus status = sb_film_transient_create(&history->film, &problem, report);
  const bool tips = problem.film.work_of_adhesion > 0;
  if (status == SB_ERROR_INFEASIBLE && (problem.film.hamaker > 0 || tips)) {
    sb_warn_serious(&run->summary.warnings, "film-snap-in",
                    tips ? SB_FILM_IN_WORK_OF_ADHESION : SB_FILM_IN_HAMAKER,
                    "the %s seal's film in time is that without adhesion: %s", sb_seal_name(seal),
                    report->text);
    problem.film.hamaker = problem.film.work_of_adhesion = 0;
    status = sb_film_transient_create(&history->film, &problem, report);
  }
  return status;
}

// Stores the present film in a frame of the run.
static void show(const History *history, const SbFilmTransientResult *result, SbFrame *frame) {
  SbFilm *film = &history->run->history_film; // too large for a small stack
  memset(film, 0, sizeof *film);
  film->film_min = result->film_min;
  film->film_central = result->film_central;
  film->film_ratio = result->film_central / history->run->model->sigma;
  film->hertz_half_width = result->half_width;
  film->friction_couette = result->friction_couette;
  film->friction_cavity = result->friction_cavity;
  film->asperity_load = result->asperity_load;
  film->asperity_share = result->asperity_share;
  film->real_area = result->real_area;
  sb_run_frame_film(frame, history->run, history->seal, film, history->fitted);
}

// Returns the direction of sliding in a frame; at rest the previous one, or at the start the next
// one.
static int way_of(const History *history, size_t i, size_t count) {
  const SbFrame *frames = history->run->frames;
  for (size_t k = i; k < count && (k == i || history->direction < 0); k++) {
    if (frames[k].velocity != 0) {
      return frames[k].velocity < 0 ? SB_CYCLE_OUT : SB_CYCLE_IN;
    }
  }
  return history->direction < 0 ? SB_CYCLE_IN : history->direction;
}

// Notes what a stretch begins with at frame i, unless it is followed again.
static void remember_begin(History *history, size_t i, double error, int direction) {
  if (i != history->begin || history->finer + history->sharper == 0) {
    history->finer = history->sharper = 0;
    history->begin = i;
    history->begin_central = history->central;
    history->begin_error = error;
    history->begin_direction = direction;
  }
}

// Ends a stretch that is to be followed again, and goes back to its first frame, which is returned.
static size_t go_back(History *history) {
  end_stretch(history);
  history->central = history->begin_central;
  history->error = history->begin_error;
  history->direction = history->begin_direction;
  return history->begin;
}

// One seal through all frames.
static SbStatus replay(History *history, size_t count, const SbRunHooks *hooks, SbReport *report) {
  SbRun *run = history->run;
  for (size_t i = 0, next; i < count; i = next) {
    SbFrame *frame = &run->frames[i];
    history->frame = i;
    next = i + 1;
    const double error = history->error;
    const double dt = i > 0 ? frame->time - run->frames[i - 1].time : 0;
    const int before = history->direction;
    history->direction = way_of(history, i, count);
    const SbSupply supply =
        sb_run_supply(run, history->seal, (SbChamber)frame->chamber, history->direction);
    const bool dry = supply.limited && !(supply.layer > 0);
    const bool turned =
        before != history->direction && !both_alike(run, history->seal, (int)frame->chamber);
    if (dry || turned || !whole_contact(frame, history->seal) ||
        history->chamber != (int)frame->chamber) {
      end_stretch(history);
    }
    if (dry || !whole_contact(frame, history->seal)) {
      continue; // without liquid as without a contact the frame stays as it is
    }
    if (i % 16 == 0 && sb_run_cancelled(hooks, report)) {
      return SB_ERROR_CANCELLED;
    }
    SbStatus status = SB_OK;
    if (history->film == NULL) {
      remember_begin(history, i, error, before);
      status = begin_stretch(history, frame->chamber, hooks, report);
    } else if (dt > 0) {
      status = sb_film_transient_step(history->film, dt, sb_model_way(run->model) * frame->velocity,
                                      report);
    }
    if (status == SB_ERROR_NOT_CONVERGED && history->film != NULL && history->finer < FINER_MAX) {
      next = go_back(history);
      history->finer++;
      continue;
    }
    if (status != SB_OK) {
      return status;
    }
    const SbFilmTransientResult result = sb_film_transient_result(history->film);
    if (result.error_history > UNKNOWN && history->sharper < SHARPER_MAX) {
      next = go_back(history);
      history->sharper++;
      continue;
    }
    history->central = result.film_central;
    // Without the companion nothing is known.
    const double least = result.error_history;
    history->error = isnan(least) ? INFINITY : fmax(history->error, least);
    show(history, &result, frame);
  }
  return SB_OK;
}

SbStatus sb_run_film_history(SbRun *run, size_t count, const SbRunHooks *hooks, SbReport *report) {
  static const char figure[] = "solver.error_estimate.film_history";
  SbSummary *summary = &run->summary;
  SbStatus worst = SB_OK;
  summary->error_film_history = 0;
  for (int seal = 0; seal < SB_SEAL_COUNT && worst != SB_ERROR_CANCELLED; seal++) {
    History history = {.run = run, .seal = seal, .direction = -1, .central = run->model->rest_film};
    for (size_t i = 0; i < count; i++) {
      history.speed_scale = fmax(history.speed_scale, fabs(run->frames[i].velocity));
    }
    if (history.speed_scale == 0) {
      continue;
    }
    SbReport own = {0}, whole = {0};
    const SbStatus replayed = replay(&history, count, hooks, &own);
    const SbStatus status = sb_work_status(run->work, replayed, &own);
    end_stretch(&history);
    if (isinf(history.error)) {
      sb_reason(summary, figure, "%s seal: the film of half the resolution did not converge",
                sb_seal_name(seal));
    }
    if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
      worst = sb_fail(report, status, "%s", own.text);
    } else if (status != SB_OK) {
      SbFrame *at = &run->frames[history.frame];
      char solver[60];
      snprintf(solver, sizeof solver, "film (in time), %s seal", sb_seal_name(seal));
      const SbRunPlace place = {solver,           "stem",   (SbStage)at->stage,
                                at->displacement, at->time, "the films before, the motion"};
      (void)sb_run_fail_at(&whole, status, &place, &own);
      sb_warn_serious(&summary->warnings, "film-history", sb_input(SB_P_MODELS_FILM_TIME), "%s",
                      whole.text);
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
