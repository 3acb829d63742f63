// What the studies share: whom they ask, and building blocks that stay inside the bounds of
// SbStudy.
#pragma once

#include "engine/contact/fit.h"
#include "engine/valve/cost.h"
#include "engine/valve/evaluate.h"
#include "engine/valve/model.h"
#include "engine/valve/studies/study.h"

// A study at work. A failure that ends it stays in `status`: whoever asks on gets NaN at no cost,
// so that loops need not look.
typedef struct {
  SbStudy *out;
  const SbModel *scene;
  SbModel base; // what is asked: the scene, but for what the study holds fixed
  SbEvaluator *evaluator;
  const SbStudyHooks *hooks;
  SbReport *report;
  SbStatus status;
  double spent, total; // [s] what questions have cost, and what the study will
} SbStudyWork;

#define SB_STUDY_DECLARE(code, function, name, title, help)                                        \
  void sb_study_##function(SbStudyWork *work);                                                     \
  double sb_study_##function##_cost(const SbModel *model);
SB_STUDY_LIST(SB_STUDY_DECLARE)
#undef SB_STUDY_DECLARE

// Holds parameters fixed for all questions that follow. Values that do not go together end the
// study.
void sb_study_fix(SbStudyWork *work, const SbOverride *override, size_t count);

// The cycle of the test machine, quasi-static, whatever drives the scene.
void sb_study_fix_machine(SbStudyWork *work);

// The outer ring as the scene's storage left it, from now on without any; the inner one like it, so
// that no gland suits but one of them. The chamber is filled.
void sb_study_fix_outer(SbStudyWork *work);

// Values that give the outer ring a squeeze: the bore moves and the groove floor stays, D = D_floor
// + 2 g with g = d (1 - s), so that the stretch on the floor stays as it is. The stem's land keeps
// its share of the gap. For a base with sb_study_fix_outer().
enum { SB_STUDY_SQUEEZED = 3 };
void sb_study_squeezed(SbOverride out[SB_STUDY_SQUEEZED], const SbStudyWork *work, double squeeze);

// Asks for figures of the base with overrides and tells the progress. Where a solver gives up or
// the values do not go together what it would have given is NaN, with a warning, and `complete` is
// cleared in the first case. Warnings of models are not merged: a study runs outside validity on
// purpose and says where. The evaluator has the model and the summary.
void sb_study_ask(SbStudyWork *work, double *value, const char *const *path, size_t paths,
                  const SbOverride *override, size_t overrides);

// The outer seal's contact by overrides of the base.
typedef struct {
  double load, peak, width; // [N], [Pa], [m]
} SbStudyContact;

SbStudyContact sb_study_contact(SbStudyWork *work, const SbOverride *override, size_t overrides);

// Net load per length of the scene's outer seal at rest under its pressures [N/m]; NaN: none.
double sb_study_net_load(SbStudyWork *work);

// Passes on how the work on something else than a question ended; true: well.
bool sb_study_goes_on(SbStudyWork *work, SbStatus status, const SbReport *report);

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

// A series of one name in every panel, and a point of the newest in each: y[panel_count].
void sb_study_curve(SbStudy *out, SbStudyStyle style, const char *name);
void sb_study_put(SbStudy *out, double x, const double *y);

void sb_study_mark(SbStudy *out, double x, const char *format, ...) SB_PRINTF(3, 4);
void sb_study_note(SbStudy *out, const char *format, ...) SB_PRINTF(2, 3);

// Tells the progress and looks for a cancel.
void sb_study_step(SbStudyWork *work, double fraction);
