// The complete run of a model, as tests that look at results need it.
#pragma once

#include "engine/valve/sealbench.h"

#include <glib.h>

// Plans, creates and executes; fails the test where that fails. Owned by the caller
// (sb_run_destroy).
static inline SbRun *executed_run(const SbModel *model) {
  SbPlan plan;
  sb_plan_make(&plan, model);
  SbRun *run = NULL;
  SbReport report = {0};
  g_assert_cmpint(sb_run_create(&run, model, &plan, &report), ==, SB_OK);
  if (sb_run_execute(run, NULL, &report) != SB_OK) {
    g_error("%s", report.text);
  }
  return run;
}
