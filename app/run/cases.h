// The cases of a scene: each is the scene with some values replaced, and the verdict takes the
// worst answer of the scene and its cases.
#pragma once

#include "app/document/document.h"
#include "engine/valve/sealbench.h"

// One question's worst answer, and the case that gives it; NULL: the scene itself. Borrowed from
// the document.
typedef struct {
  SbVerdict of;
  const char *name;
} SbCaseVerdict;

// Answers of `run`, which is finished, and of every case of its document: run one after the other
// by the same models, but without what no question asks for (profiles, interior fields, studies,
// the later actuations of a life). A case that fails leaves its questions without an answer, unless
// the answer is no; `problems` (of char *) gets a sentence that names it. SB_OK, or the last status
// that is not; cancelled, the cases left are not computed.
SbStatus sb_cases_judge(SbCaseVerdict out[SB_VERDICT_COUNT], const SbRun *run,
                        const SbDocument *document, const SbRunHooks *hooks, GPtrArray *problems);

// Adds the cases to the plan of their scene. Nothing where there are none.
void sb_cases_plan(SbPlan *plan, const SbDocument *document);
