// Runs parameter sets without a process for each: a line "KEY=SI KEY=SI ..." on standard input is
// one, a line of the outcome goes to standard output:
//
//   refused TEXT                       it makes no sense: no valve
//   done STATUS CLOSURE NULLS SECONDS TEXT
//
// STATUS is SbStatus, NULLS the number of figures that have neither a value nor a reason of their
// own, TEXT the report's.
#include "engine/valve/sealbench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool set_all(SbParams *params, char *line) {
  sb_params_init(params);
  for (char *item = strtok(line, " \n"); item != NULL; item = strtok(NULL, " \n")) {
    char *equal = strchr(item, '=');
    SbReport report = {0};
    if (equal == NULL) {
      printf("refused \"%s\" is no setting\n", item);
      return false;
    }
    *equal = '\0';
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
    if (!set_all(&params, line)) {
      fflush(stdout);
      continue;
    }
    if (sb_model_create(&model, &params, NULL, NULL, &problems) != SB_OK) {
      printf("refused %s: %s\n", problems.item[0].key, problems.item[0].text);
      fflush(stdout);
      continue;
    }
    SbPlan plan;
    SbRun *run;
    SbReport report = {0};
    sb_plan_make(&plan, model);
    SbStatus status = sb_run_create(&run, model, &plan, &report);
    if (status == SB_OK) {
      status = sb_run_execute(run, NULL, &report);
      const SbSummary *summary = sb_run_summary(run);
      printf("done %d %.3g %d %.3f %s\n", (int)status, summary->energy.closure, nulls(summary),
             summary->wall_s, report.text);
    }
    fflush(stdout);
    sb_run_destroy(run);
    sb_model_destroy(model);
  }
  return 0;
}
