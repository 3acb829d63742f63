// Models and runs of the default valve with some parameters changed.
#pragma once

#include "engine/valve/model/model.h"
#include "engine/valve/run/plan.h"
#include "engine/valve/run/run.h"

#include <glib.h>

// A parameter's value; an identifier below 0: none.
typedef struct {
  int id;
  double value;
} Setting;

static inline void compile(SbModel *model, const Setting *settings, size_t count) {
  SbParams params;
  sb_params_init(&params);
  for (size_t i = 0; i < count; i++) {
    if (settings[i].id >= 0) {
      SbStatus status = sb_params_set(&params, (SbParamId)settings[i].id, settings[i].value, NULL);
      g_assert_cmpint(status, ==, SB_OK);
    }
  }
  g_assert_cmpint(sb_model_compile(model, &params, NULL, NULL), ==, SB_OK);
}

// Plans and executes a run, which must end so; the caller owns it.
static inline SbRun *run_of(const SbModel *model, SbStatus wanted, SbReport *report) {
  SbPlan plan;
  sb_plan_make(&plan, model);
  SbRun *run = NULL;
  SbReport own = {0};
  report = report != NULL ? report : &own;
  g_assert_cmpint(sb_run_create(&run, model, &plan, report), ==, SB_OK);
  SbStatus status = sb_run_execute(run, NULL, report);
  if (status != wanted) {
    g_test_message("%s", report->text);
  }
  g_assert_cmpint(status, ==, wanted);
  return run;
}
