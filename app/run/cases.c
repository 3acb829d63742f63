// See cases.h.
#include "app/run/cases.h"

#include "engine/valve/figures/figures.h"

#include <math.h>
#include <string.h>

// The answers of one set of values.
static SbStatus evaluate(SbVerdict out[SB_VERDICT_COUNT], const SbModel *model,
                         const SbRunHooks *hooks, SbReport *report) {
  g_autofree SbPlan *plan = g_new(SbPlan, 1);
  sb_plan_wished(plan, model, &(SbPlanWishes){0});
  SbRun *run = NULL;
  SbStatus status = sb_run_create(&run, model, plan, report);
  if (status == SB_OK) {
    status = sb_run_execute(run, hooks, report);
    memcpy(out, sb_run_summary(run)->verdict, SB_VERDICT_COUNT * sizeof *out);
  }
  sb_run_destroy(run);
  return status;
}

void sb_cases_own(SbVerdict out[SB_VERDICT_COUNT], const SbRun *run, const SbStudy *studies,
                  size_t count) {
  const SbModel *model = sb_run_model(run);
  double spread[SB_FIGURE_COUNT] = {0};
  for (size_t i = 0; i < count; i++) {
    sb_study_spread(spread, &studies[i], model);
  }
  sb_verdict_judge(out, sb_run_summary(run), model, spread);
}

// Progress over all cases.
typedef struct {
  const SbRunHooks *hooks;
  size_t index, count;
} Share;

static void on_progress(void *data, double fraction, size_t frames) {
  const Share *share = data;
  if (share->hooks != NULL && share->hooks->progress != NULL) {
    share->hooks->progress(share->hooks->data,
                           ((double)share->index + fraction) / (double)share->count, frames);
  }
}

static bool on_cancelled(void *data) {
  const Share *share = data;
  return share->hooks != NULL && share->hooks->cancelled != NULL &&
         share->hooks->cancelled(share->hooks->data);
}

SbStatus sb_cases_judge(SbCaseVerdict out[SB_VERDICT_COUNT], const SbVerdict own[SB_VERDICT_COUNT],
                        const SbDocument *document, const SbRunHooks *hooks, GPtrArray *problems) {
  for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
    out[kind] = (SbCaseVerdict){own[kind], NULL};
  }
  SbStatus worst = SB_OK;
  Share share = {hooks, 0, sb_document_case_count(document)};
  const SbRunHooks each_hooks = {
      .progress = on_progress, .cancelled = on_cancelled, .data = &share};
  g_autoptr(GPtrArray) issues = sb_issues_new();
  for (; share.index < share.count; share.index++) {
    const char *name = sb_document_case_name(document, share.index);
    SbReport report = {0};
    SbVerdict each[SB_VERDICT_COUNT];
    g_autoptr(SbModel) model = NULL;
    SbStatus status = SB_ERROR_CANCELLED;
    for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
      each[kind] = (SbVerdict){SB_ANSWER_UNKNOWN, out[kind].of.figure, NAN, NAN, ""};
    }
    if (worst != SB_ERROR_CANCELLED) {
      status = sb_document_compile_case(document, share.index, &model, issues)
                   ? evaluate(each, model, &each_hooks, &report)
                   : sb_fail(&report, SB_ERROR_INPUT, "its values are inconsistent");
    }
    if (status == SB_ERROR_CANCELLED) {
      (void)sb_fail(&report, status, "not computed");
    } else if (status != SB_OK) {
      g_ptr_array_add(problems, g_strdup_printf("case %s: %s", name, report.text));
    }
    worst = status != SB_OK ? status : worst;
    for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
      if (each[kind].ok == SB_ANSWER_UNKNOWN && each[kind].reason[0] == '\0') {
        sb_message(each[kind].reason, SB_TEXT, "%s", report.text);
      }
      // A question that has no limit stays without an answer.
      if (each[kind].figure >= 0 && sb_verdict_take_worse(&out[kind].of, &each[kind])) {
        out[kind].name = name;
      }
    }
  }
  return worst;
}

void sb_cases_plan(SbPlan *plan, const SbDocument *document) {
  size_t count = sb_document_case_count(document);
  if (count == 0 || plan->field_count == SB_PLAN_ITEMS_MAX) {
    return;
  }
  SbPlanItem *item = &plan->field[plan->field_count++];
  *item = (SbPlanItem){0};
  sb_text(item->name, sizeof item->name, "%zu case%s", count, count > 1 ? "s" : "");
  sb_text(item->model, sizeof item->model, "the scene's models");
  sb_text(item->reason, sizeof item->reason, "the verdict takes the worst");
  g_autofree SbPlan *each = g_new(SbPlan, 1);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  for (size_t i = 0; i < count; i++) {
    g_autoptr(SbModel) model = NULL;
    if (sb_document_compile_case(document, i, &model, issues)) {
      sb_plan_wished(each, model, &(SbPlanWishes){0});
      for (size_t k = 0; k < each->field_count; k++) {
        item->cost_s += each->field[k].cost_s;
        item->error = fmax(item->error, each->field[k].error);
      }
    }
  }
}
