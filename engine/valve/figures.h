// Figures of a run by their paths, the reasons of those that were not computed, limits on them and
// the verdict. A figure is NaN until something computes it; then it needs no reason.
#pragma once

#include "engine/valve/limits.h"
#include "engine/valve/run/run.h"

// One row of figures.def, of the cycle or of one seal; strings are static.
typedef struct {
  const char *path;
  const char *si, *shown; // unit, and that which people read
  SbVerdictKind verdict;  // what a limit on it decides
  size_t offset;          // of its value in SbSummary
} SbFigure;

// Figure `index` < SB_FIGURE_COUNT; borrowed.
const SbFigure *sb_figure(int index);

// Index of a path ("seals.outer.load_N"), or -1.
int sb_figure_find(const char *path);

// SI value of figure `index`; NaN: not computed.
double sb_figure_value(const SbSummary *summary, int index);

// Why it was not computed; NULL for a number. Borrowed.
const char *sb_figure_reason(const SbSummary *summary, int index);

// Makes every figure NaN, with no reason.
void sb_figures_clear(SbSummary *summary);

// Why the figures of `pattern` are missing, should they be: a path, or a beginning of paths with a
// '*'. The first reason given stays.
void sb_reason(SbSummary *summary, const char *pattern, const char *format, ...) SB_PRINTF(3, 4);

// The same for a seal's figures; `name` is what follows "seals.outer." in the pattern.
void sb_seal_reason(SbSummary *summary, int seal, const char *name, const char *format, ...)
    SB_PRINTF(4, 5);

// "seals", "presses", ...; borrowed.
const char *sb_verdict_name(SbVerdictKind kind);

// Takes `next` in place of *worst where it is worse (true): a no before what is unknown before a
// yes; of two yeses the one nearer to its limit, of two noes the one further beyond it.
bool sb_verdict_take_worse(SbVerdict *worst, const SbVerdict *next);

// What the summary says of the valve, against the model's limits. The summary must be complete.
void sb_verdict_fill(SbSummary *summary, const SbModel *model);
