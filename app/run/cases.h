// Verdict of a scene with cases: the worst answer of the scene and of its [cases], each of which is
// the scene with some values replaced.
#pragma once

#include "app/document/document.h"
#include "engine/valve/sealbench.h"
#include "engine/valve/studies/study.h"

// The worst answer to one question of the verdict.
typedef struct {
  SbVerdict of; // the answer with figure, value, limit and reason; holds no pointers
  // Name of the case that gives the answer; NULL: the scene itself. Borrowed from the document
  // until it changes.
  const char *name;
} SbCaseVerdict;

// Writes the verdict of the finished run of a scene. A margin below the difference between the
// models that its studies[count] compare is uncertain (sb_study_spread()).
void sb_cases_own(SbVerdict out[SB_VERDICT_COUNT], const SbRun *run, const SbStudy *studies,
                  size_t count);

// Computes all cases of `document` one after the other, each with its own values and models, but
// only the figures: no profiles, interior fields, studies or later actuations of a life. Writes to
// out[kind] (kind: SbVerdictKind) the worst answer of the scene itself, whose verdict is `own`, and
// of all cases. `hooks` (NULL: none) receives the progress over all cases, 0 to 1, and may cancel.
//
// Returns SB_OK, or the status of the last case that did not end with SB_OK: SB_ERROR_INPUT if its
// values are inconsistent, SB_ERROR_CANCELLED, or the status of sb_run_execute(). `out` is complete
// in any case. A case that failed makes every answer unknown, with the problem as its reason,
// unless the scene or another case answers no. Each failed case, except one that was cancelled,
// appends a sentence with its name to `problems`, a list of char * that the caller creates with
// g_free() as its free function. After a cancellation the remaining cases are not computed.
SbStatus sb_cases_judge(SbCaseVerdict out[SB_VERDICT_COUNT], const SbVerdict own[SB_VERDICT_COUNT],
                        const SbDocument *document, const SbRunHooks *hooks, GPtrArray *problems);

// Appends one item to the plan of the scene: "N cases", with the sum of the costs of all cases [s]
// and the largest of their errors. Does nothing if there are no cases, or if the plan is full.
void sb_cases_plan(SbPlan *plan, const SbDocument *document);
