// What the studies share: building blocks that stay inside the bounds of SbStudy.
#pragma once

#include "engine/contact/fit.h"
#include "engine/valve/cost.h"
#include "engine/valve/model.h"
#include "engine/valve/sliding.h"
#include "engine/valve/studies/study.h"

#define SB_STUDY_DECLARE(code, function, name, title, help)                                        \
  SbStatus sb_study_##function(SbStudy *out, const SbModel *model, const SbStudyHooks *hooks,      \
                               SbReport *report);                                                  \
  double sb_study_##function##_cost(const SbModel *model);
SB_STUDY_LIST(SB_STUDY_DECLARE)
#undef SB_STUDY_DECLARE

// Names a quantity; `unit` is the one shown.
void sb_study_axis(SbStudyAxis *out, const char *quantity, const char *si, const char *unit,
                   bool logarithmic);

// Adds a panel, a series, a table's column or row; borrowed from `out`. They never
// fail: no study asks for more than SbStudy holds.
SbStudyPanel *sb_study_panel(SbStudy *out, const char *quantity, const char *si, const char *unit,
                             bool logarithmic);
SbStudySeries *sb_study_series(SbStudyPanel *panel, SbStudyStyle style, const char *format, ...)
    SB_PRINTF(3, 4);
SbStudyColumn *sb_study_column(SbStudy *out, const char *name, const char *si, const char *unit);

// A row of the columns' units (`si` NULL) or of its own; all values NaN at first.
SbStudyRow *sb_study_row(SbStudy *out, const char *si, const char *unit, const char *format, ...)
    SB_PRINTF(4, 5);

// Appends a point.
void sb_study_point(SbStudySeries *series, double x, double y);

void sb_study_mark(SbStudy *out, double x, const char *format, ...) SB_PRINTF(3, 4);
void sb_study_note(SbStudy *out, const char *format, ...) SB_PRINTF(2, 3);

// Tells the progress; SB_ERROR_CANCELLED if the hooks ask to stop.
SbStatus sb_study_step(const SbStudyHooks *hooks, double fraction, SbReport *report);

// Solves a fitment for a study: counts it, keeps the largest error estimate, hands on the hooks'
// cancel. What has no solution or does not converge leaves *fit without contact figures (NaN),
// warns once per model and clears `complete` (only where a solver gave up, not where the model says
// no); SB_OK then. Model warnings of `fit` are not merged: a study runs outside validity on
// purpose and says where.
SbStatus sb_study_fit(SbStudy *out, SbFit *fit, const SbFitProblem *problem,
                      const SbStudyHooks *hooks, SbReport *report);

// Solves a sliding state for a study, likewise: what does not converge leaves *state without
// figures (NaN) and warns. The state's own warnings are not merged.
SbStatus sb_study_sliding(SbStudy *out, SbSliding *state, const SbModel *model, int seal,
                          SbSealPressure pressure, double speed, SbSlidingMemory *memory,
                          SbReport *report);
