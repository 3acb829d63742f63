// The report of a scene or a study as pages (PDF): what went in and from where, pictures, figures
// with their error estimates, the verdict with its margins, warnings, models and sources.
//
// Equal inputs make equal bytes: nothing of it is a time, but the day that SOURCE_DATE_EPOCH asks
// for. Like all exports it speaks English.
#pragma once

#include "app/data/compare.h"
#include "app/document/study_file.h"
#include "app/export/report_pages.h"
#include "app/run/cases.h"
#include "app/study/shares.h"
#include "engine/valve/studies/study.h"

// What a scene's report is made of; borrowed. The run has ended, whatever became of it.
typedef struct {
  const SbDocument *document;
  const SbRun *run;
  const SbCaseVerdict *verdict; // of SB_VERDICT_COUNT
  const SbComparison *measured; // NULL: nothing was
  const SbStudy *studies;       // `study_count` of them
  size_t study_count;
} SbReportScene;

// The views whose fields the pages show, for the plan of the run (SbPlanWishes).
unsigned sb_report_views(const SbModel *model);

bool sb_report_scene(FILE *stream, const SbReportScene *scene, const SbReportHooks *hooks,
                     GError **error);

// The same of a study's answers; borrowed.
typedef struct {
  const SbStudyFile *study;
  const double *value; // [samples][vary]
  const SbStudyDrawn *drawn;
  const SbAnswers *answers;
} SbReportStudy;

bool sb_report_study(FILE *stream, const SbReportStudy *study, const SbReportHooks *hooks,
                     GError **error);

// ---- Parts of both ----

// "piston.valve . thesis-cycle.scene". Owned by the caller.
char *sb_report_files(const SbDocument *document);

// Foot of all pages: program, day, hash and files. Owned by the caller.
char *sb_report_foot(const char *files, const char *hash);

// A figure's value, its unit and no more digits than its error estimate supports; that estimate.
// Owned by the caller.
char *sb_report_value(const SbSummary *summary, int index);
char *sb_report_error(const SbSummary *summary, int index);

// How far a value lies within a limit, "1.4 N (5 %)"; negative beyond it. "" where either is none.
// Owned by the caller.
char *sb_report_margin(int figure, double value, double error, double low, double high);

// The parameters in force with their tolerances and where they come from, the models, the sources
// that these name, and the defaults of the rest (report_inputs.c).
void sb_report_inputs(SbReportPages *pages, const SbDocument *document, const SbModel *model);
