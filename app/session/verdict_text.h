// The six questions of the verdict in words, as every front end shows them.
#pragma once

#include "app/session/session.h"

// The summary whose verdict is shown: what is predicted of the present values, else the shown
// run's; NULL while that is computed.
const SbSummary *sb_verdict_summary(SbSession *session);

// "Seals", "Presses", ...; borrowed.
const char *sb_verdict_word(int kind);

// "yes", "no", "not known"; borrowed.
const char *sb_verdict_answer(SbAnswer answer);

// What decides, in a few words: "26 N of 30 N", "1.2 MPa over 0.55 MPa". Owned by the caller.
char *sb_verdict_figure_text(const SbSummary *summary, int kind, const SbVerdict *verdict);

// The same text with numbers in plain ASCII, for standard output. Owned by the caller (g_free).
char *sb_verdict_figure_plain(const SbSummary *summary, int kind, const SbVerdict *verdict);

// The whole answer, some lines. Owned by the caller.
char *sb_verdict_why(const SbSummary *summary, int kind, const SbVerdict *verdict);

// Shows the instant that an answer is of, where the run has it.
void sb_verdict_show(SbSession *session, int kind);
