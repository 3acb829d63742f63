// Figures of a model with overrides: the one question that whoever asks many asks.
//
// evaluate(model, overrides) -> figures. A base that was compiled and checked, any parameters of it
// replaced, and the figures that are wanted; no more is computed than those need (plan.h), and
// those are the same to the bit as a run's of that model, whatever else is asked for with them.
//
// An evaluator is the memory of one thread: nothing is shared between two of them but the base,
// which nobody writes. What an answer is does not depend on what the evaluator was asked before:
// solvers start warm only from states of the same question, in the order of a run, or of a base
// that the question names: a ring's friction on floor and walls then has another history, within
// the errors that are told. Where a question asks for the very contacts of the one before (another
// stroke, drive, pressure diameter), those stand.
//
// Leaves out: derivatives; frames, profiles and shapes (run.h has them); wall times and counts.
#pragma once

#include "engine/valve/figures.h"

typedef struct SbEvaluator SbEvaluator;

// What is asked. Pointers are borrowed for the call.
typedef struct {
  const SbModel *base;
  const SbOverride *override; // [override_count], the last of a parameter counts
  size_t override_count;
  const int *figure; // [figure_count], indices of figures.def (sb_figure_find)
  size_t figure_count;
  // An evaluator that has answered a question with `keep` and none since, borrowed: rings start
  // from its states, and what is answered hangs on them and the question alone, however many ask at
  // the same time. NULL: cold. `keep`: keeps them for others, beside those of earlier questions
  // with `keep`.
  const SbEvaluator *start;
  bool keep;
  bool as_run;         // the shelf only where the base's views or limits ask for it
  bool tangent;        // rings are those of `start` to first order: sb_run_predict_from()
  SbRingsBeside rings; // of tangents: what they do
  // Polled as in a run (SbRunHooks), at least every 50 ms; may be NULL.
  bool (*cancelled)(void *data);
  void *data;
} SbQuestion;

// *out is owned by the caller. SB_ERROR_MEMORY.
SbStatus sb_evaluator_create(SbEvaluator **out, SbReport *report);

// Takes NULL.
void sb_evaluator_destroy(SbEvaluator *evaluator);

// Answers: value[i] is figure[i] in SI, or NaN where sb_evaluator_reason() tells why.
//   SB_OK                     every figure has its value or a reason of the valve's own
//   SB_ERROR_RANGE, _INPUT    an override is out of its range, or the values do not go together:
//   the
//                             report names key and range; all NaN
//   SB_ERROR_NOT_CONVERGED    some figures have values, others NaN
//   SB_ERROR_INFEASIBLE, _CANCELLED, _MEMORY
// `report` may be NULL.
SbStatus sb_evaluator_ask(double *value, SbEvaluator *evaluator, const SbQuestion *question,
                          SbReport *report);

// Whether it would answer without solving a contact, by those of the last question.
bool sb_evaluator_has_solved(const SbEvaluator *evaluator, const SbQuestion *question);

// Forgets the last question: the next one solves all that it needs.
void sb_evaluator_forget(SbEvaluator *evaluator);

// Why a figure of the last question has no value; NULL for one that has. Borrowed until the next
// question.
const char *sb_evaluator_reason(const SbEvaluator *evaluator, int figure);

// A seal's steady state at a speed [m/s] > 0 in the model of the last question, which asked for a
// figure of the return: sb_run_sliding(). NaN where the run has none.
SbStatus sb_evaluator_sliding(SbSealState *out, SbEvaluator *evaluator, int seal, int way,
                              double speed, SbReport *report);

// The model that the last question was answered for, and its whole summary, of which only what the
// figures asked for needed means something; NULL after one that was refused. Borrowed until the
// next question.
const SbModel *sb_evaluator_model(const SbEvaluator *evaluator);
const SbSummary *sb_evaluator_summary(const SbEvaluator *evaluator);
