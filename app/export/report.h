// The report of a scene or of a study as pages (PDF): inputs and their origin, pictures, figures
// with their error estimates, the verdict with its margins, warnings, models and sources.
//
// Equal inputs make equal bytes: the file has no time other than the day of SOURCE_DATE_EPOCH. Like
// all exports it is in English.
#pragma once

#include "app/data/compare.h"
#include "app/document/study_file.h"
#include "app/export/report_pages.h"
#include "app/run/cases.h"
#include "app/study/shares.h"
#include "engine/valve/studies/study.h"

// The content of a scene's report. Borrowed during the call. The run has ended, also by failure or
// cancellation.
typedef struct {
  const SbDocument *document;
  const SbRun *run;
  const SbCaseVerdict *verdict; // [SB_VERDICT_COUNT], from sb_cases_judge()
  const SbComparison *measured; // measured data compared with the run; NULL: none
  const SbStudy *studies;       // [study_count]
  size_t study_count;
} SbReportScene;

// Returns the views whose fields the report of a scene shows, bits SB_VIEW_..., for the plan of the
// run (SbPlanWishes): a run computes only what is wished.
unsigned sb_report_views(const SbModel *model);

// Writes the report of a scene into `stream`. `hooks` may be NULL. Returns false with
// SB_APP_ERROR_IO (not drawn) or SB_APP_ERROR_CANCELLED; errors of writing are left in the stream
// (ferror()).
bool sb_report_scene(FILE *stream, const SbReportScene *scene, const SbReportHooks *hooks,
                     GError **error);

// The content of a study's report. Borrowed during the call.
typedef struct {
  const SbStudyFile *study;
  const double *value;       // [samples][study->vary->len]: parameters of the samples [SI]
  const SbStudyDrawn *drawn; // points of the method
  const SbAnswers *answers;  // results of the samples
} SbReportStudy;

// Writes the report of a study into `stream`; as sb_report_scene().
bool sb_report_study(FILE *stream, const SbReportStudy *study, const SbReportHooks *hooks,
                     GError **error);

// ---- Parts of both reports, for app/export/report*.c only ----

// Returns the file names of valve and scene, "piston.valve · thesis-cycle.scene".
char *sb_report_files(const SbDocument *document);

// Returns the foot of all pages: version of program and engine, `files`, day, start of `hash`
// (SHA-256 of the parameters).
char *sb_report_foot(const char *files, const char *hash);

// Draws the chapter "Inputs": the parameters in force with tolerances and origin, the models, the
// sources that these name, and the other defaults (report_inputs.c).
void sb_report_inputs(SbReportPages *pages, const SbDocument *document, const SbModel *model);
