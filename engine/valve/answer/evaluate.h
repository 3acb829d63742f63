// Evaluation: figures of a model with overrides.
//
// A question is a base model, overrides of its parameters, and figures. Only what these figures
// need is computed (plan.h), and they equal those of a run of that model to the bit.
//
// An evaluator is used by one thread at a time. Different evaluators may share a base model and a
// `start` evaluator, which are only read. The answer to a question does not depend on earlier
// questions: solvers start from states of the same question, or from the `start` that it names (a
// ring's friction on floor and walls then has another history, within the error estimates). If a
// question has the same contacts as the one before (another stroke, drive, pressure diameter),
// these are reused. Not available: frames, profiles, shapes (run.h), derivatives (gradient.h).
#pragma once

#include "engine/valve/figures/figures.h"
#include "engine/valve/states/perturbed.h"

// An evaluator with its memory and its last answer.
typedef struct SbEvaluator SbEvaluator;

// A question. Initialise with {0}, then set base and figures. All pointers are borrowed during the
// call.
typedef struct {
  const SbModel *base;
  const SbOverride *override; // [override_count]; the last one of a parameter applies
  size_t override_count;
  const int *figure; // [figure_count] indices of figures.h
  size_t figure_count;
  // Warm start: an evaluator whose last question had `keep`; solved rings start from its states. It
  // may be used by several threads. NULL: cold start.
  const SbEvaluator *start;
  bool keep;    // store the rings' states for other questions, in addition to those stored before
  bool as_run;  // shelf figures only if the base's views or limits need them
  bool tangent; // rings are linearised about `start`: sb_run_predict_from()
  SbRingsBeside rings; // with `tangent`: how they are evaluated
  // Called at least every 50 ms in the calling thread; true cancels. NULL: never.
  bool (*cancelled)(void *data);
  void *data;
} SbQuestion;

// Creates an evaluator.
SbStatus sb_evaluator_create(SbEvaluator **out, SbReport *report);

// Frees the evaluator. Takes NULL. Evaluators that started from it must not be used with it any
// more.
void sb_evaluator_destroy(SbEvaluator *evaluator);

// Computes value[figure_count] in SI, in the order of question->figure; NaN: sb_evaluator_reason()
// states why.
//   SB_OK                     each figure has a value, or a reason that lies in the valve
//   SB_ERROR_RANGE, _INPUT    an override is out of range, or the values are inconsistent: the
//                             report has key and range; all values are NaN
//   SB_ERROR_NOT_CONVERGED, _INFEASIBLE, _CANCELLED   values that were computed, others NaN
SbStatus sb_evaluator_ask(double *value, SbEvaluator *evaluator, const SbQuestion *question,
                          SbReport *report);

// Returns whether the evaluator can answer the question with the contacts of its last question,
// without solving any.
bool sb_evaluator_has_solved(const SbEvaluator *evaluator, const SbQuestion *question);

// Discards the last answer, so that the next question solves everything.
void sb_evaluator_forget(SbEvaluator *evaluator);

// Returns why figure `figure` of the last question has no value; NULL if it has one. Borrowed until
// the next question.
const char *sb_evaluator_reason(const SbEvaluator *evaluator, int figure);

// Computes the steady state of a seal at `speed` [m/s] > 0 in direction `way` (SB_CYCLE_IN,
// SB_CYCLE_OUT) in the model of the last question, which must have requested a figure of the
// return; see sb_run_sliding(). NaN if the run has none.
SbStatus sb_evaluator_sliding(SbSealState *out, SbEvaluator *evaluator, int seal, int way,
                              double speed, SbReport *report);

// Returns the model of the last question; NULL if that was refused. Borrowed until the next
// question.
const SbModel *sb_evaluator_model(const SbEvaluator *evaluator);

// Returns the summary of the last question, in which only what its figures need is defined; NULL if
// it was refused. Borrowed until the next question.
const SbSummary *sb_evaluator_summary(const SbEvaluator *evaluator);
