// Shared by report_study.c (the pages) and report_study_pictures.c.
#pragma once

#include "app/chart/samples.h"
#include "app/chart/study.h"
#include "app/export/report.h"

// Maximum number of histograms, and of tornado diagrams.
enum { SB_REPORT_STUDY_CHARTS = 24 };

// A study while its report is made.
typedef struct {
  const SbReportStudy *of;  // content of the report, borrowed
  const SbStudyFile *study; // of->study
  const SbAnswers *answers; // of->answers
  char *files;              // names of the study's and the scene's file, owned
  SbStudy *curves;          // curves of a grid, owned; NULL: the method is not a grid
  size_t tornados;          // number of tornado diagrams
  SbTornado *tornado;       // [tornados], owned
  GPtrArray *names;         // of char *, owned: titles that `tornado` borrows
  SbStatus status;          // first error of the statistics, otherwise SB_OK
} SbReportStudyParts;

// Returns figure k of the study, an index of sb_figure().
int sb_report_study_figure(const SbReportStudyParts *study, size_t k);

// Returns varied parameter k, borrowed from the study.
const SbVary *sb_report_study_vary(const SbReportStudyParts *study, size_t k);

// Returns the label of a varied parameter with its seal, "Section diameter, outer", or the name of
// a variable. Freed with g_free().
char *sb_report_study_vary_label(const SbVary *vary);

// Returns the limit on a figure (index of sb_figure()); both ends are infinite if there is none.
SbLimit sb_report_study_limit(const SbReportStudyParts *study, int figure);

// ---- Pictures (report_study_pictures.c) ----

// Draws a histogram of each figure that has values.
void sb_report_study_histograms(SbReportPages *pages, const SbReportStudyParts *study);

// Computes the sensitivities of the figures, if the study's method gives them: sets `tornado`
// (freed with g_free()), `tornados`, which is 0 before, and `names` (freed with
// g_ptr_array_unref()). Sets `status` after an error.
void sb_report_study_make_tornados(SbReportStudyParts *study);

// Draws the tornado diagrams that sb_report_study_make_tornados() made.
void sb_report_study_tornados(SbReportPages *pages, const SbReportStudyParts *study);
