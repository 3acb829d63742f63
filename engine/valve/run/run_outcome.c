// The outcome of a motion, one for every kind of motion, and the figures of the return that follow
// from it. It is computed from states: what the stem did and where it is when the motion ends.
//
//   never-moved  no contact has slid and the stem has not reached the end stop
//   returned     the stem rests on its rest stop, and the drive has released it
//   held         the drive is bonded to the stem or still pushes it when the motion ends
//   stuck        the stem rests elsewhere without a push of the drive
//
// The outcome is unknown where the motion failed, or where the stem still moves when its motion
// ends. The return margin has one definition in all motions: the minimum over the return path of
// the push minus the friction, which is static, after the rest at the stop, wherever the stem may
// stop (drive.may_stop: sb_cycle_static_margin() or sb_cycle_first_reserve()), else that of
// sliding. It depends on the seals' states, on the largest displacement and on the dwell there.
#include "engine/valve/figures/figures.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdio.h>

// A stem slower than this is at rest [m/s].
static const double rest_speed = 1e-6;

static SbOutcome outcome_of(const SbSummary *summary, const SbModel *model, const SbRunEnd *end) {
  const bool slid = summary->stage[SB_STAGE_B].reached || summary->stage[SB_STAGE_D].reached;
  if (!slid && end->start == 0 && !end->bonded) {
    return SB_OUTCOME_NEVER_MOVED;
  }
  if (end->bonded || end->force > 1e-6 * fmax(summary->force_peak, 0)) {
    return SB_OUTCOME_HELD;
  }
  if (fabs(end->position) < 1e-6 * model->stroke) {
    return SB_OUTCOME_RETURNED;
  }
  return fabs(end->speed) < rest_speed ? SB_OUTCOME_STUCK : SB_OUTCOME_UNKNOWN;
}

// Reasons of what the outcome leaves out.
static void give_reasons(SbSummary *summary, const SbRunEnd *end) {
  switch (summary->outcome) {
  case SB_OUTCOME_NEVER_MOVED: {
    static const char *const none[] = {"cycle.returns", "cycle.force_return_*",
                                       "cycle.force_press_N", "cycle.stuck_at_m"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
      sb_reason(summary, none[i], "the stem never moved: the drive's %.4g N are not enough",
                summary->force_peak);
    }
    break;
  }
  case SB_OUTCOME_STUCK:
    sb_reason(summary, "cycle.force_return_min_N",
              "the stem is stuck at %.4g mm and never slides back", 1e3 * end->position);
    break;
  case SB_OUTCOME_UNKNOWN:
    sb_reason(summary, "cycle.returns", "the stem still moves, at %.4g mm, when its motion ends",
              1e3 * end->position);
    break;
  case SB_OUTCOME_RETURNED:
  case SB_OUTCOME_HELD:
    break;
  }
  sb_reason(summary, "cycle.stuck_at_m", "the stem is not stuck: its outcome is %s",
            summary->outcome == SB_OUTCOME_UNKNOWN ? "not known"
                                                   : sb_outcome_name(summary->outcome));
  sb_reason(summary, "cycle.force_press_N",
            "the stem does not reach its stop: the force required for it is not known");
}

SbStatus sb_run_conclude_motion(SbSummary *summary, SbRun *run, const SbRunEnd *end,
                                SbReport *report) {
  summary->outcome = outcome_of(summary, run->model, end);
  const bool stuck = summary->outcome == SB_OUTCOME_STUCK;
  summary->closes =
      (summary->outcome == SB_OUTCOME_RETURNED || summary->outcome == SB_OUTCOME_HELD) &&
      fabs(end->position - end->start) < 1e-6 * run->model->stroke;
  summary->returns = summary->outcome == SB_OUTCOME_RETURNED;
  summary->returned = summary->outcome == SB_OUTCOME_UNKNOWN ? NAN : summary->returns;
  summary->stuck_at = stuck ? end->position : NAN;
  summary->force_press = summary->stage[SB_STAGE_D].reached ? end->press : NAN;
  summary->force_return_min = summary->force_return_margin = NAN;
  summary->force_return_margin_anywhere = summary->force_return_margin_stop = NAN;
  if (summary->outcome == SB_OUTCOME_NEVER_MOVED) {
    summary->returned = NAN;
    give_reasons(summary, end);
    return SB_OK;
  }
  summary->dwell = end->dwell;
  SbStatus status = sb_cycle_rest(&run->cycle, end->dwell, report);
  if (status != SB_OK) {
    return status;
  }
  const double top = fmin(end->top, run->model->stroke); // the stop yields a little
  const double anywhere = sb_cycle_static_margin(&run->cycle, top);
  const double stop = sb_cycle_first_reserve(&run->cycle, top);
  const double sliding = fmin(sb_cycle_sliding_margin(&run->cycle, top), end->sliding_least);
  summary->force_return_margin_anywhere = anywhere;
  summary->force_return_margin_stop = stop;
  summary->force_return_margin = run->model->stops_at_stop ? fmin(stop, sliding) : anywhere;
  // A stem that static friction holds at the stop only follows the stop's deflection.
  if (!stuck || stop > 0) {
    summary->force_return_min = sliding;
  }
  if (stuck && summary->force_return_margin > 0) {
    // The contact has aged for longer where the stem is than it had at the stop: the friction there
    // balances the push.
    summary->force_return_margin = 0;
  }
  give_reasons(summary, end);
  return SB_OK;
}

bool sb_run_delivers(const SbRun *run) {
  const SbSummary *summary = &run->summary;
  const SbModel *model = run->model;
  const bool first = summary->stage[SB_STAGE_C].reached;
  if (sb_valve_type(model)->fills_at_rest) {
    return first && summary->stage[SB_STAGE_D].reached; // shut at C, emptied at the stop
  }
  // The chamber is filled from C to F and emptied after F, if no ports determine the time.
  const bool stuck = summary->outcome == SB_OUTCOME_STUCK;
  return first && summary->stage[SB_STAGE_F].reached &&
         (!stuck || model->pressure_map == SB_MAP_PORTS);
}

// Reasons of the leakages that the outcome leaves out.
static void give_reasons_of_leakage(SbRun *run) {
  SbSummary *summary = &run->summary;
  const double at = 1e3 * summary->stuck_at;
  char carried[32] = "";
  if (!isnan(run->bore.out)) {
    snprintf(carried, sizeof carried, " (%.3g nl)",
             1e12 * run->model->bore_circumference * run->bore.out);
  }
  if (summary->outcome == SB_OUTCOME_NEVER_MOVED) {
    sb_reason(summary, "cycle.leakage_*", "the stem never moved");
  } else if (summary->outcome == SB_OUTCOME_STUCK) {
    sb_reason(summary, "cycle.leakage_per_cycle_m3",
              "the stem is stuck at %.4g mm: what the outer seal transported in one direction%s is "
              "not a loss of a cycle",
              at, carried);
    sb_reason(summary, "cycle.leakage_*",
              "the stem is stuck at %.4g mm: there is no second actuation", at);
  } else if (!summary->closes) {
    sb_reason(summary, "cycle.leakage_*",
              "the motion does not end where it began: what the outer seal transported%s is not a "
              "loss of a cycle",
              carried);
  }
}

// Reasons of a dose that the outcome leaves out.
static void give_reasons_of_dose(SbRun *run) {
  SbSummary *summary = &run->summary;
  const char *missing = NULL; // the first stage that a dose needs
  for (int stage = SB_STAGE_C; stage <= SB_STAGE_F && missing == NULL; stage++) {
    const SbStage last = sb_valve_type(run->model)->fills_at_rest ? SB_STAGE_D : SB_STAGE_F;
    const bool needed = stage == SB_STAGE_C || stage == (int)last;
    missing = needed && !summary->stage[stage].reached ? sb_stage_name((SbStage)stage) : NULL;
  }
  if (summary->outcome == SB_OUTCOME_NEVER_MOVED) {
    sb_reason(summary, "cycle.dose_mass_kg", "the stem never moved");
  } else if (summary->outcome == SB_OUTCOME_STUCK) {
    sb_reason(summary, "cycle.dose_mass_kg", "the stem is stuck at %.4g mm before the chamber %s",
              1e3 * summary->stuck_at, missing != NULL ? "is filled and empties" : "has emptied");
  } else if (summary->outcome != SB_OUTCOME_UNKNOWN && missing != NULL) {
    sb_reason(summary, "cycle.dose_mass_kg", "the cycle does not reach stage %s: no dose", missing);
  }
}

void sb_run_leave_out(SbRun *run) {
  SbSummary *summary = &run->summary;
  const bool open = summary->seal[SB_OUTER].leak_state == SB_LEAK_OPEN;
  const bool strokes =
      summary->outcome == SB_OUTCOME_RETURNED || summary->outcome == SB_OUTCOME_HELD;
  if (open || !summary->closes) {
    summary->leakage_per_cycle = summary->leakage_net = NAN;
  }
  if (open || !strokes) {
    summary->leakage_carried = NAN;
  }
  summary->dose_mass = sb_run_delivers(run) ? summary->dose_mass : NAN;
  give_reasons_of_leakage(run);
  give_reasons_of_dose(run);
  if (open) { // its films are not what it loses
    const int leak = sb_figure_find("seals.outer.leakage_static_m3_per_s");
    const char *why = sb_figure_reason(summary, leak);
    sb_reason(summary, "cycle.leakage_*", "the outer seal is open: %s", why);
    sb_reason(summary, "life.leakage_*", "the outer seal is open: %s", why);
    summary->life.leakage = summary->life.carried = NAN;
    for (long i = 0; i < summary->life.done; i++) {
      run->life[i].leakage = run->life[i].carried = NAN;
    }
  }
}
