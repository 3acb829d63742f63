// Runs, cases and drawn studies on the command line: computed with progress and interrupts.
#include "app/cli/cli.h"

#include "app/base/unit.h"
#include "app/study/view.h"

#include <math.h>

static void on_run(void *data, double fraction, size_t frames) {
  sb_progress_update(data, fraction);
}

SbStatus sb_cli_compute(SbRun **out, const SbModel *model, const SbPlan *plan, const char *what,
                        SbReport *report) {
  const SbStatus status = sb_run_create(out, model, plan, report);
  if (status != SB_OK) {
    return status;
  }
  SbProgress progress;
  sb_progress_start(&progress, what);
  sb_cli_catch_interrupts();
  const SbRunHooks hooks = {.progress = on_run, .cancelled = sb_cli_interrupted, .data = &progress};
  const SbStatus executed = sb_run_execute(*out, &hooks, report);
  sb_progress_end(&progress);
  return executed;
}

SbStatus sb_cli_judge(SbCaseVerdict *verdict, GPtrArray *problems, const SbRun *run,
                      const SbDocument *document, const SbStudy *studies, size_t count) {
  SbVerdict own[SB_VERDICT_COUNT];
  sb_cases_own(own, run, studies, count);
  SbProgress progress;
  sb_progress_start(&progress, "cases ");
  const SbRunHooks hooks = {.progress = on_run, .cancelled = sb_cli_interrupted, .data = &progress};
  const SbStatus status = sb_cases_judge(verdict, own, document, &hooks, problems);
  sb_progress_end(&progress);
  for (guint i = 0; i < problems->len; i++) {
    sb_cli_fail("%s", (const char *)problems->pdata[i]);
  }
  return status;
}

int sb_cli_study(SbStudy *out, SbStudyKind kind, const SbModel *model) {
  g_autofree char *what = g_strdup_printf("study %s ", sb_study_name(kind));
  SbProgress progress;
  sb_progress_start(&progress, what);
  sb_cli_catch_interrupts();
  SbStudyHooks hooks = {sb_progress_update, sb_cli_interrupted, &progress};
  SbReport report = {0};
  SbStatus status = sb_study_make(out, kind, model, &hooks, &report);
  sb_progress_end(&progress);
  if (status == SB_OK && !out->complete) {
    char at[SB_TEXT] = "";
    if (isfinite(out->gap_at)) {
      g_snprintf(at, sizeof at, " at %s %.4g %s", out->x.quantity,
                 sb_quantity_to_shown(out->gap_at, out->x.si, out->x.unit), out->x.unit);
    }
    sb_cli_fail("study %s: a solver did not converge at every point; such points are omitted; the "
                "first%s: %s",
                sb_study_name(kind), at, out->gap);
    return SB_EXIT_NOT_CONVERGED;
  }
  return sb_cli_status(status, &report);
}

int sb_cli_studies(SbStudy *out, size_t *count, const SbModel *model, unsigned mask) {
  int code = SB_EXIT_DONE;
  for (int i = 0; i < SB_STUDY_COUNT && code != SB_EXIT_INTERRUPTED; i++) {
    if ((mask & (1u << i)) != 0) {
      const int made = sb_cli_study(&out[*count], (SbStudyKind)i, model);
      *count += made == SB_EXIT_DONE || made == SB_EXIT_NOT_CONVERGED;
      code = made != SB_EXIT_DONE ? made : code;
    }
  }
  return code;
}
