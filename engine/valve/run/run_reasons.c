// Why figures are missing: what a run that ended early cannot tell, and what its models leave out.
#include "engine/valve/figures.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void sb_run_lacks_motion(SbRun *run, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  if (run->lacks[0] == '\0') {
    vsnprintf(run->lacks, sizeof run->lacks, format, arguments);
  }
  va_end(arguments);
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

// Why figures of a run, or of a seal (`name` is what follows "seals.NAME."), are missing.
typedef struct {
  bool when;
  const char *name, *why;
} Reason;

// Of the whole run for a seal below 0.
static void give(SbSummary *summary, int seal, const Reason *reasons, size_t count) {
  for (const Reason *reason = reasons; reason < reasons + count; reason++) {
    if (reason->when && seal < 0) {
      sb_reason(summary, reason->name, "%s", reason->why);
    } else if (reason->when) {
      sb_seal_reason(summary, seal, reason->name, "%s", reason->why);
    }
  }
}

void sb_run_give_reasons(SbRun *run, SbStatus status, const SbReport *report) {
  SbSummary *summary = &run->summary;
  const SbModel *model = &run->model;
  const SbLife *life = &summary->life;
  const bool rig = model->motion == SB_MODEL_MOTION_RIG, well = status == SB_OK;
  const bool coupled = model->asperities == SB_MODEL_ASPERITIES_COUPLED;
  const bool closed = !coupled && model->film != SB_FILM_REYNOLDS;
  if (life->failure > 0) {
    sb_reason(summary, "life.*", "the life ends at actuation %ld: its stem does not return",
              life->failure);
  } else if (life->done > 0) {
    sb_reason(summary, "life.*", "the life was not computed beyond actuation %ld", life->done);
  }
  const Reason before[] = {
      {!run->plan.life, "life.*", "life.actuations = 1: there is no life"},
      {run->lacks[0] != '\0', "life.*", run->lacks},
      {!rig, "rig.*", "models.motion is not rig: no plate is pulled"},
      {rig && well, "rig.*",
       "the force has no peak: the plate did not break away, or slid smoothly"},
      {rig, "cycle.force_breakaway_N", "the plate never slips"},
      {rig, "cycle.stages.B*", "the plate never slips"},
      {rig, "cycle.*", "the sliding plate (models.motion = rig) has no valve's cycle"},
      {rig, "seals.*", "the sliding plate (models.motion = rig) has no valve's seals"},
      {rig, "solver.*", "the sliding plate (models.motion = rig) solves no film or fit"},
      {well, "cycle.force_breakaway_N", "the stem never slips: stage B is not reached"},
  };
  give(summary, -1, before, sizeof before / sizeof before[0]);
  for (int i = 0; well && i < SB_STAGE_COUNT; i++) {
    char pattern[32];
    snprintf(pattern, sizeof pattern, "cycle.stages.%s.*", sb_stage_name((SbStage)i));
    sb_reason(summary, pattern, "the cycle does not reach stage %s", sb_stage_name((SbStage)i));
  }
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const bool done = !isnan(summary->seal[seal].load); // else the run ended before
    const Reason reasons[] = {
        {summary->seal[seal].load == 0, "*",
         "the seal does not touch the bore under its pressures"},
        {closed, "film_by_model.reynolds", "models.film is a closed form: no film was solved"},
        {!coupled, "asperity_load_share",
         "models.asperities = beside: asperities share no load with the film"},
        {done, "film*", "the fluid opens the contact or carries it alone: no film law applies"},
        {done, "lambda", "there is no film"},
        {done, "real_area_share", "there is no film to tell it"},
        {done, "friction*", "there is no film to tell it"},
        {done, "coefficient*", "there is no film to tell the friction"},
        {done, "leakage_per_stroke_m3", "there is no film to carry it"},
    };
    give(summary, seal, reasons, sizeof reasons / sizeof reasons[0]);
  }
  if (well) {
    const char *outer = sb_figure_reason(summary, sb_figure_find("seals.outer.film_central_m"));
    sb_reason(summary, "cycle.leakage*", "outer seal: %s",
              outer != NULL ? outer : "it does not touch in all of the cycle's states");
  }
  const Reason after[] = {
      {closed, "solver.error_estimate.film", "models.film is a closed form"},
      {!run->plan.film_history, "solver.error_estimate.film_history",
       "models.film_time = steady: no film was followed in time"},
      {well, "solver.error_estimate.film*", "no seal has a film to solve"},
      // What is left was to come behind the point where the run ended.
      {status == SB_ERROR_CANCELLED, "*", "the run was stopped before"},
      {!well, "*", report->text[0] != '\0' ? report->text : sb_status_text(status)},
  };
  give(summary, -1, after, sizeof after / sizeof after[0]);
}
