#include "app/study/view.h"

#include "app/base/issue.h"
#include "app/document/shipped.h"
#include "app/document/study_file.h"
#include "app/study/answers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// A study, and the parameters of its columns, those of the file first.
typedef struct {
  const SbStudyFile *study;
  size_t columns;
  const SbParamId *parameter;
} Asked;

static void place(void *data, double *row, int line, double x) {
  const Asked *of = data;
  const SbStudyFile *study = of->study;
  guint grid = 0, column = 0;
  if (line >= 0) {
    for (size_t k = study->vary->len; k < of->columns; k++) {
      row[k] = NAN;
    }
    sb_study_grid_row(row, &grid, &column, study, (size_t)line);
    row[column] = x;
  }
  sb_study_grid_follow(row, study, grid);
}

static SbStatus answer(void *data, double *value, const SbStudyAsk *ask) {
  const Asked *of = data;
  const SbStudyFile *study = of->study;
  const SbQuestions asked = {.base = study->base,
                             .base_sha256 = "",
                             .parameter = of->parameter,
                             .parameters = of->columns,
                             .figure = (const int *)(const void *)study->figures->data,
                             .figures = study->figures->len,
                             .value = ask->value,
                             .samples = ask->rows,
                             .jobs = (int)g_get_num_processors(),
                             .work_used = ask->work_used,
                             .separate = true,
                             .seen = ask->seen,
                             .progress = ask->progress,
                             .cancelled = ask->cancelled,
                             .data = ask->data};
  SbAnswers answers;
  g_autoptr(GError) error = NULL;
  const bool good = sb_answers_get(&answers, &asked, &error);
  if (good) {
    memcpy(value, answers.value, ask->rows * asked.figures * sizeof *value);
  }
  sb_answers_release(&answers);
  return good                                                                 ? SB_OK
         : error->code == SB_APP_ERROR_CANCELLED && ask->cancelled(ask->data) ? SB_ERROR_CANCELLED
                                                                              : SB_ERROR_MEMORY;
}

static SbStatus view(SbStudy *out, SbStudyKind kind, const SbModel *model, SbStudyFile *study,
                     const SbStudyHooks *hooks, SbReport *report) {
  const SbParamId *extra;
  const size_t own = study->vary->len, samples = study->samples;
  const size_t columns = own + sb_study_extra(&extra, kind);
  double *points = NULL;
  SbStatus status = sb_study_file_points(&points, NULL, study, report);
  if (status == SB_OK) {
    g_autofree double *value = g_new(double, samples *columns);
    g_autofree const char **column = g_new(const char *, columns);
    g_autofree SbParamId *parameter = g_new(SbParamId, columns);
    g_autofree int *line = g_new(int, samples);
    g_autofree double *x = g_new(double, samples);
    for (size_t k = 0; k < columns; k++) {
      const SbVary *vary = k < own ? &g_array_index(study->vary, SbVary, k) : NULL;
      parameter[k] = vary != NULL ? vary->id : extra[k - own];
      column[k] = vary != NULL ? sb_vary_name(vary) : sb_param(parameter[k])->key;
    }
    for (size_t i = 0; i < samples; i++) {
      size_t at;
      sb_study_grid_place(&at, &x[i], study, i);
      line[i] = (int)at;
      for (size_t k = 0; k < columns; k++) {
        value[i * columns + k] = k < own ? points[i * own + k] : NAN;
      }
    }
    Asked asked = {study, columns, parameter};
    const SbStudyGrid grid = {study->base, column, columns, samples, study->figures->len,
                              value,       line,   x,       place,   answer,
                              &asked};
    status = sb_study_view(out, kind, model, &grid, hooks, report);
  }
  free(points);
  return status;
}

SbStatus sb_study_make(SbStudy *out, SbStudyKind kind, const SbModel *model,
                       const SbStudyHooks *hooks, SbReport *report) {
  if (!sb_study_has_grid(kind)) {
    return sb_study_view(out, kind, model, NULL, hooks, report);
  }
  g_autofree char *path = sb_shipped_study(sb_study_name(kind));
  g_autoptr(GPtrArray) issues = sb_issues_new();
  if (path == NULL) {
    return sb_fail(report, SB_ERROR_INPUT, "the study's file %s.study is not among what ships",
                   sb_study_name(kind));
  }
  g_autoptr(SbStudyFile) study = sb_study_file_of_model(path, model, issues);
  if (study == NULL) {
    const SbIssue *issue = issues->len > 0 ? issues->pdata[0] : NULL;
    g_autofree char *text = issue != NULL ? sb_issue_line(issue) : g_strdup("cannot be read");
    return sb_fail(report, SB_ERROR_INPUT, "%s", text);
  }
  return view(out, kind, model, study, hooks, report);
}
