// Why figures are missing: what a run that ended early cannot tell, and what its models leave out.
#include "engine/valve/figures.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void sb_run_lacks_motion(SbRun *run, const char *why) {
  if (run->lacks[0] == '\0') {
    snprintf(run->lacks, sizeof run->lacks, "%s", why);
  }
}

void sb_run_clear_motion(SbRun *run, const char *why) {
  SbSummary *summary = &run->summary; // stages that were reached stand
  summary->force_peak = summary->force_return_min = summary->leakage_per_cycle = NAN;
  summary->duration = summary->error_force = summary->error_energy = NAN;
  summary->energy = (SbEnergy){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
  summary->returns = false;
  summary->returned = NAN;
  sb_reason(summary, "cycle.*", "%s", why);
  sb_reason(summary, "solver.error_estimate.force", "%s", why);
  sb_reason(summary, "solver.error_estimate.energy", "%s", why);
}

double sb_run_cycle_leakage(SbSummary *summary, double carried, bool back) {
  if (!back) {
    sb_reason(summary, "cycle.leakage_per_cycle_m3",
              "the stem does not come back: what the outer seal carried one way (%.3g nl) is no "
              "loss of a cycle",
              1e12 * carried);
    sb_reason(summary, "cycle.leakage_net_all_actuations_m3",
              "the stem does not come back: there is no second actuation");
  }
  return back ? carried : NAN;
}

void sb_run_give_reasons(SbRun *run, SbStatus status, const SbReport *report) {
  SbSummary *summary = &run->summary;
  const SbModel *model = &run->model;
  const SbLife *life = &summary->life;
  if (life->failure > 0) {
    sb_reason(summary, "life.*", "the life ends at actuation %ld: its stem does not return",
              life->failure);
  } else if (life->done > 0) {
    sb_reason(summary, "life.*", "the life was not computed beyond actuation %ld", life->done);
  } else if (!run->plan.life) {
    sb_reason(summary, "life.*", "life.actuations = 1: there is no life");
  } else if (run->lacks[0] != '\0') {
    sb_reason(summary, "life.*", "%s", run->lacks);
  }
  if (model->motion != SB_MODEL_MOTION_RIG) {
    sb_reason(summary, "rig.*", "models.motion is not rig: no plate is pulled");
  } else {
    if (status == SB_OK) {
      sb_reason(summary, "rig.*",
                "the force has no peak: the plate did not break away, or slid smoothly");
    }
    sb_reason(summary, "cycle.force_breakaway_N", "the plate never slips");
    sb_reason(summary, "cycle.stages.B*", "the plate never slips");
    sb_reason(summary, "cycle.*", "the sliding plate (models.motion = rig) has no valve's cycle");
    sb_reason(summary, "seals.*", "the sliding plate (models.motion = rig) has no valve's seals");
    sb_reason(summary, "solver.*", "the sliding plate (models.motion = rig) solves no film or fit");
  }
  if (status == SB_OK && model->motion != SB_MODEL_MOTION_RIG) {
    sb_reason(summary, "cycle.force_breakaway_N", "the stem never slips: stage B is not reached");
    for (int i = 0; i < SB_STAGE_COUNT; i++) {
      char pattern[32];
      snprintf(pattern, sizeof pattern, "cycle.stages.%s.*", sb_stage_name((SbStage)i));
      sb_reason(summary, pattern, "the cycle does not reach stage %s", sb_stage_name((SbStage)i));
    }
  }
  bool coupled = model->asperities == SB_MODEL_ASPERITIES_COUPLED;
  bool solved = coupled || model->film == SB_FILM_REYNOLDS;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const SbSealSummary *of = &summary->seal[seal];
    if (of->load == 0) {
      sb_seal_reason(summary, seal, "*", "the seal does not touch the bore under its pressures");
    }
    if (!solved) {
      sb_seal_reason(summary, seal, "film_by_model.reynolds",
                     "models.film is a closed form: no film was solved");
    }
    if (!coupled) {
      sb_seal_reason(summary, seal, "asperity_load_share",
                     "models.asperities = beside: asperities share no load with the film");
    }
    if (isnan(of->load)) {
      continue; // the run ended before
    }
    sb_seal_reason(summary, seal, "film*",
                   "the fluid opens the contact or carries it alone: no film law applies");
    sb_seal_reason(summary, seal, "lambda", "there is no film");
    sb_seal_reason(summary, seal, "real_area_share", "there is no film to tell it");
    sb_seal_reason(summary, seal, "friction*", "there is no film to tell it");
    sb_seal_reason(summary, seal, "coefficient*", "there is no film to tell the friction");
    sb_seal_reason(summary, seal, "leakage_per_stroke_m3", "there is no film to carry it");
  }
  if (status == SB_OK) {
    const char *outer = sb_figure_reason(summary, sb_figure_find("seals.outer.film_central_m"));
    sb_reason(summary, "cycle.leakage*", "outer seal: %s",
              outer != NULL ? outer : "it does not touch in all of the cycle's states");
  }
  if (!solved) {
    sb_reason(summary, "solver.error_estimate.film", "models.film is a closed form");
  }
  if (!run->plan.film_history) {
    sb_reason(summary, "solver.error_estimate.film_history",
              "models.film_time = steady: no film was followed in time");
  }
  if (status == SB_OK) {
    sb_reason(summary, "solver.error_estimate.film*", "no seal has a film to solve");
  }
  // What is left was to come behind the point where the run ended.
  if (status != SB_OK) {
    sb_reason(summary, "*", "%s",
              status == SB_ERROR_CANCELLED ? "the run was stopped before"
              : report->text[0] != '\0'    ? report->text
                                           : sb_status_text(status));
  }
}
