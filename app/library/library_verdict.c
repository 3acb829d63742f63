// See library_private.h.
#include "app/library/library_private.h"

void sb_answers_clear(SbAnswers *answers) {
  for (size_t kind = 0; kind < answers->count; kind++) {
    g_free(answers->reason[kind]);
    g_free(answers->of_case[kind]);
  }
  *answers = (SbAnswers){0};
}

void sb_answers_take(SbAnswers *answers, const SbCaseVerdict worst[SB_VERDICT_COUNT]) {
  static const int as_int[] = {[SB_ANSWER_UNKNOWN] = -1, [SB_ANSWER_NO] = 0, [SB_ANSWER_YES] = 1};
  sb_answers_clear(answers);
  answers->count = SB_VERDICT_COUNT;
  for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
    const SbVerdict *of = &worst[kind].of;
    answers->reason[kind] = of->reason[0] != '\0' ? g_strdup(of->reason) : NULL;
    answers->of_case[kind] = g_strdup(worst[kind].name);
    answers->answer[kind] = (SbSceneVerdict){
        .question = sb_verdict_name((SbVerdictKind)kind),
        .ok = as_int[of->ok],
        .reason = answers->reason[kind],
        .figure = of->figure >= 0 ? sb_figure(of->figure)->path : NULL,
        .value = of->value,
        .limit = of->limit,
        .of_case = answers->of_case[kind],
    };
  }
}
