// Evaluator: computes requested figures (figures/figures.h) of a base model with overrides.
//
// It plans and executes a run (run.h) that computes only what these figures need (plan.h). The
// figures equal those of a full run of the model to the last bit.
//
// Different evaluators may share a base model and a `start` evaluator, which are only read. An
// answer does not depend on earlier questions: every solver starts cold, or from the states of
// `start`. With `start`, a ring's friction on floor and walls has another history, so figures
// differ within their error estimates. If only inputs that do not affect the contacts have changed
// since the last question (stroke, drive, stem.pressure_diameter), the solved contacts are reused,
// which does not change the figures. Frames, profiles and shapes need a run; derivatives need
// gradient.h.
#pragma once

#include "engine/valve/figures/figures.h"
#include "engine/valve/states/perturbed.h"

// An evaluator with its memory and its last answer.
typedef struct SbEvaluator SbEvaluator;

// A question. Initialise with {0}, then set base, figure and figure_count; all other fields may
// stay 0. All pointers are borrowed during the call.
typedef struct {
  const SbModel *base;
  const SbOverride *override; // [override_count]; NULL if the count is 0. If a parameter is listed
                              // twice, its last element applies.
  size_t override_count;
  const int *figure; // [figure_count] indices from sb_figure_find()
  size_t figure_count;
  // Warm start: an evaluator whose last question had `keep`. Rings are solved from its stored
  // states. Several threads may use one `start` simultaneously. NULL: cold start.
  const SbEvaluator *start;
  bool keep;    // store the ring states, so that this evaluator can be the `start` of others
  bool as_run;  // compute shelf figures only if the views or limits of `base` need them
  bool tangent; // linearise rings about `start` instead of solving them; ignored without `start`
  size_t work_used;    // steps of output.work_limit that are not available to this question
  SbRingsBeside rings; // with `tangent` and `start`: how rings are evaluated; 0: SB_RINGS_FOLLOW
  // Called at least every 50 ms in the calling thread; true cancels. NULL: never.
  bool (*cancelled)(void *data);
  void *data;
} SbQuestion;

// Creates an evaluator.
SbStatus sb_evaluator_create(SbEvaluator **out, SbReport *report);

// Frees the evaluator. Takes NULL. An evaluator whose last question had it as `start` may then only
// be destroyed, or asked a question with another `start`.
void sb_evaluator_destroy(SbEvaluator *evaluator);

// Computes value[figure_count] in SI, in the order of question->figure. For a NaN
// sb_evaluator_reason() returns the cause. `value` is defined after any status.
//   SB_OK                     a NaN has a cause in the valve (a seal is open, a stage not reached)
//   SB_ERROR_RANGE, _INPUT    an override is out of range, or the values are inconsistent: the
//                             question is refused, all values are NaN, the report has input, range
//   SB_ERROR_NOT_CONVERGED    a solver failed, or output.work_limit is exhausted
//   SB_ERROR_INFEASIBLE       the model has no solution
//   SB_ERROR_CANCELLED        `cancelled` returned true
// After the last three, figures that were computed have values and all others are NaN.
SbStatus sb_evaluator_ask(double *value, SbEvaluator *evaluator, const SbQuestion *question,
                          SbReport *report);

// Returns whether the solved contacts of the last question serve for this question, so that
// sb_evaluator_ask() solves no contact. False if the question would be refused.
bool sb_evaluator_has_solved(const SbEvaluator *evaluator, const SbQuestion *question);

// Discards the solved contacts of the last question, so that the next question solves all contacts.
// Stored ring states (`keep`) remain.
void sb_evaluator_forget(SbEvaluator *evaluator);

// Returns why the figure with the index `figure` (as in question->figure) has no value in the last
// question; NULL if it has one. If the question was refused it returns the text of that error.
// Borrowed until the next question.
const char *sb_evaluator_reason(const SbEvaluator *evaluator, int figure);

// Computes the steady sliding state of `seal` (SB_OUTER, SB_INNER) at `speed` [m/s] > 0, whose
// magnitude is positive in both directions, in direction `way` (SB_CYCLE_IN, SB_CYCLE_OUT of
// cycle.h), in the model of the last question; see sb_run_sliding(). That question must have
// returned SB_OK and must have requested at least one figure with sb_figure(index)->needs ==
// SB_DEPTH_WHOLE (for example "seals.outer.contact.return.friction_N" or "cycle.force_peak_N").
// Then the states of both seals in both directions are available; otherwise *out is meaningless,
// without an error. In *out, film and friction are NaN if the fluid alone carries the seal; without
// contact out->touches is false, and load, contact width and friction are 0. SB_ERROR_CANCELLED by
// `cancelled` of the last question, which must still be callable; SB_ERROR_NOT_CONVERGED:
// output.work_limit is exhausted.
SbStatus sb_evaluator_sliding(SbSealState *out, SbEvaluator *evaluator, int seal, int way,
                              double speed, SbReport *report);

// Returns the model of the last question, with its overrides; NULL if the question was refused or
// there was none. Borrowed until the next question.
const SbModel *sb_evaluator_model(const SbEvaluator *evaluator);

// Returns the summary of the last question; NULL if the question was refused or there was none.
// Only members that its figures need are computed; all other figures are NaN. Borrowed until the
// next question.
const SbSummary *sb_evaluator_summary(const SbEvaluator *evaluator);
