// Runs parameter sets without a process for each: a line "KEY=SI KEY=SI ..." on standard input is
// one, series=f:TIME:N,TIME:N,... (or d: and metres) its measured drive; a line of the outcome goes
// to standard output:
//
//   refused TEXT                       it makes no sense: no valve
//   done STATUS CLOSURE NULLS WORK SECONDS TEXT
//
// STATUS is SbStatus, NULLS the number of figures that have neither a value nor a reason of their
// own, WORK the solver steps of the run, TEXT the report's.
#include "engine/valve/contradiction.h"
#include "engine/valve/sealbench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void set_series(SbModelSeries *series, const char *text) {
  series->quantity = text[0] == 'f' ? SB_DRIVE_OF_FORCE : SB_DRIVE_OF_POSITION;
  series->count = 0;
  for (const char *at = text + 1; at != NULL && series->count < SB_MODEL_SERIES_MAX;
       at = strchr(at + 1, ',')) {
    char *end;
    series->time[series->count] = strtod(at + 1, &end);
    series->value[series->count++] = strtod(end + 1, NULL);
  }
}

static bool set_all(SbParams *params, SbModelSeries *series, char *line) {
  sb_params_init(params);
  series->count = 0;
  for (char *item = strtok(line, " \n"); item != NULL; item = strtok(NULL, " \n")) {
    char *equal = strchr(item, '=');
    SbReport report = {0};
    if (equal == NULL) {
      printf("refused \"%s\" is no setting\n", item);
      return false;
    }
    *equal = '\0';
    if (strcmp(item, "series") == 0) {
      set_series(series, equal + 1);
      continue;
    }
    int id = sb_param_find(item);
    if (id < 0 || sb_params_set(params, (SbParamId)id, atof(equal + 1), &report) != SB_OK) {
      printf("refused %s: %s\n", item, id < 0 ? "no such key" : report.text);
      return false;
    }
  }
  return true;
}

// Figures without a value whose reason is the one for want of a better.
static int nulls(const SbSummary *summary) {
  int count = 0;
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const char *reason = sb_figure_reason(summary, i);
    count += reason != NULL && (reason[0] == '\0' || summary->reasons.of[i] == 0);
  }
  return count;
}

int main(void) {
  static char line[8192];
  while (fgets(line, sizeof line, stdin) != NULL) {
    SbParams params;
    SbProblems problems;
    SbModel *model;
    SbModelData *data;
    if (sb_model_data_create(&data) != SB_OK) {
      return 1;
    }
    bool made = set_all(&params, &data->measured, line);
    if (made && sb_model_create(&model, &params, data, NULL, &problems) != SB_OK) {
      printf("refused %s: %s\n", problems.item[0].key, problems.item[0].text);
      made = false;
    }
    sb_model_data_release(data);
    if (!made) {
      fflush(stdout);
      continue;
    }
    SbPlan plan;
    SbRun *run;
    SbReport report = {0};
    sb_plan_make(&plan, model);
    SbStatus status = sb_run_create(&run, model, &plan, &report);
    if (status == SB_OK) {
      // One thread: the campaign runs several of these programs.
      const SbRunHooks hooks = {.alone = true};
      status = sb_run_execute(run, &hooks, &report);
      const SbSummary *summary = sb_run_summary(run);
      char wrong[256], text[300] = "";
      if (sb_summary_contradiction(wrong, sizeof wrong, summary, model)) {
        snprintf(text, sizeof text, "contradiction: %s; ", wrong);
      }
      printf("done %d %.3g %d %zu %.3f %s%s\n", (int)status, summary->energy.closure,
             nulls(summary), summary->work, summary->wall_s, text, report.text);
    }
    fflush(stdout);
    sb_run_destroy(run);
    sb_model_destroy(model);
  }
  return 0;
}
