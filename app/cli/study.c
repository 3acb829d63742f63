// A study on the command line: computed with progress, listed, refused where it does not go.
#include "app/cli/cli.h"

#include "app/study/view.h"

static void on_progress(void *data, double fraction) {
  sb_progress_update(data, fraction);
}

int sb_cli_study(SbStudy *out, SbStudyKind kind, const SbModel *model) {
  g_autofree char *what = g_strdup_printf("study %s ", sb_study_name(kind));
  SbProgress progress;
  sb_progress_start(&progress, what);
  sb_cli_catch_interrupts();
  SbStudyHooks hooks = {on_progress, sb_cli_interrupted, &progress};
  SbReport report = {0};
  SbStatus status = sb_study_make(out, kind, model, &hooks, &report);
  sb_progress_end(&progress);
  if (status == SB_OK && !out->complete) {
    sb_cli_fail("study %s: a solver did not converge at every point; such points are omitted",
                sb_study_name(kind));
    return SB_EXIT_NOT_CONVERGED;
  }
  return sb_cli_status(status, &report);
}
