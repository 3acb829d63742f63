// Figures of a run by their paths, the reasons of those that were not computed, limits on them and
// the verdict. A figure is NaN until something computes it; then it needs no reason.
#pragma once

#include "engine/valve/run/run.h"

typedef enum { SB_BETTER_NONE, SB_BETTER_LESS, SB_BETTER_MORE } SbBetter;

// One row of figures.def, a seal's for each seal; strings are static.
typedef struct {
  const char *path;
  size_t offset;          // of its value in SbSummary
  const char *where;      // "outer seal", "stage B": what tells it from others of its label; or ""
  int seal;               // that it is of; SB_SEAL_COUNT: of none, or of the valve through one
  const char *si, *shown; // unit, and that which people read
  int digits;             // significant ones in tables; 0: a yes or no, 1 or 0
  SbBetter better;
  const char *estimate;  // name of its error estimate below "solver.error_estimate."; "": none
  SbSealDepth needs;     // of its seal; of the outer one for a figure of no seal
  SbVerdictKind verdict; // what a limit on it decides
  bool brief;            // a short table lists it
  const char *label, *help;
} SbFigure;

// Figure `index` < SB_FIGURE_COUNT; borrowed.
const SbFigure *sb_figure(int index);

// Index of a path ("seals.outer.load_N"), or -1.
int sb_figure_find(const char *path);

// SI value of figure `index`; NaN: not computed.
double sb_figure_value(const SbSummary *summary, int index);

// Why it was not computed; NULL for a number. Borrowed.
const char *sb_figure_reason(const SbSummary *summary, int index);

// Estimate of its relative error; NaN: there is none.
double sb_figure_error(const SbSummary *summary, int index);

// Returns the absolute error of b - a, one figure of two designs with the relative errors
// `error_a` and `error_b`; NaN if one of them is not known. Runs of the same methods share the
// smaller of the two relative errors, which is proportional to the value and therefore acts on the
// difference only; the remainder acts on the full value of the run that has it:
//   min(e_a, e_b) |b - a| + |e_a - e_b| |v|, v the value with the larger error.
// Runs of other methods share nothing: e_a |a| + e_b |b|.
double sb_figure_difference_error(double a, double error_a, double b, double error_b,
                                  bool same_methods);

// "none", "less", "more"; borrowed.
const char *sb_better_name(SbBetter better);

// Makes every figure NaN, with no reason.
void sb_figures_clear(SbSummary *summary);

// Fills those that follow from the model alone: what the rings' and the chamber's sizes give.
void sb_figures_of_model(SbSummary *summary, const SbModel *model);

// Why the figures of `pattern` are missing, should they be: a path, or a beginning of paths with a
// '*'. The first reason given stays.
void sb_reason(SbSummary *summary, const char *pattern, const char *format, ...) SB_PRINTF(3, 4);

// The same for a seal's figures; `name` is what follows "seals.outer." in the pattern.
void sb_seal_reason(SbSummary *summary, int seal, const char *name, const char *format, ...)
    SB_PRINTF(4, 5);

// "never-moved", "stuck", "returned" or "held"; NULL for SB_OUTCOME_UNKNOWN. Static.
const char *sb_outcome_name(SbOutcome outcome);

// "seals", "presses", ...; borrowed.
const char *sb_verdict_name(SbVerdictKind kind);

// Takes `next` in place of *worst where it is worse (true): a no before what is unknown before a
// yes; of two yeses the one nearer to its limit, of two noes the one further beyond it.
bool sb_verdict_take_worse(SbVerdict *worst, const SbVerdict *next);

// What the summary says of the valve, against the model's limits. The summary must be complete.
void sb_verdict_fill(SbSummary *summary, const SbModel *model);
