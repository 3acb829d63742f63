// The questions of the verdict as text, the same in every front end. `kind` is an SbVerdictKind, 0
// to SB_VERDICT_COUNT - 1. Texts are translated unless stated otherwise.
#pragma once

#include "app/session/session.h"

// Returns the summary whose verdict is displayed: that of the prediction for the present values,
// else that of the displayed run; NULL while that is computed. Borrowed until the session's next
// signal.
const SbSummary *sb_verdict_summary(SbSession *session);

// Returns the name of a question: "Seals", "Presses", ... Static.
const char *sb_verdict_word(int kind);

// Returns "yes", "no" or "not known". Static.
const char *sb_verdict_answer(SbAnswer answer);

// Returns the value of the figure that decides, with its limit: "26 N of 30 N", "1.2 MPa over 0.55
// MPa". If none decides, returns the value of the main figure of the question, without a limit. A
// value that is not known gives "not known", or "" for SB_VERDICT_LEAK. `summary` is the run's,
// `verdict` its answer to the question.
char *sb_verdict_figure_text(const SbSummary *summary, int kind, const SbVerdict *verdict);

// As sb_verdict_figure_text(), with numbers in ASCII, for standard output.
char *sb_verdict_figure_plain(const SbSummary *summary, int kind, const SbVerdict *verdict);

// Returns the answer with figure, limit and reason on several lines.
char *sb_verdict_why(const SbSummary *summary, int kind, const SbVerdict *verdict);

// Moves the playhead to the position in the cycle at which the answer is evaluated, if the run
// reaches it.
void sb_verdict_show(SbSession *session, int kind);
