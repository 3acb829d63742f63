// sealbench-keep-run SCENE OUT: solves a scene and keeps the run, for what ships (a step of the
// build).
#include "app/base/output.h"
#include "app/run/process.h"
#include "app/session/stored_run.h"

#include <stdio.h>
#include <stdlib.h>

static int fail(const char *what) {
  fprintf(stderr, "sealbench-keep-run: %s\n", what);
  return EXIT_FAILURE;
}

int main(int argc, char **argv) {
  sb_process_set_up();
  if (argc != 3) {
    return fail("usage: sealbench-keep-run SCENE OUT");
  }
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(GError) error = NULL;
  SbDocument *document = sb_document_load(argv[1], issues);
  SbModel *model = NULL;
  if (document == NULL || !sb_document_compile(document, &model, issues)) {
    g_autofree char *line = issues->len > 0 ? sb_issue_line(g_ptr_array_index(issues, 0)) : NULL;
    sb_document_free(document);
    return fail(line != NULL ? line : "the scene cannot be read");
  }
  SbPlan plan;
  const SbPlanWishes wishes = sb_stored_run_wishes();
  sb_plan_wished(&plan, model, &wishes);
  SbRun *run = NULL;
  SbReport report = {0};
  SbStatus status = sb_run_create(&run, model, &plan, &report);
  status = status == SB_OK ? sb_run_execute(run, NULL, &report) : status;
  const bool kept = status == SB_OK && sb_stored_run_write(argv[2], document, run, &error);
  sb_run_destroy(run);
  sb_model_destroy(model);
  sb_document_free(document);
  return kept ? EXIT_SUCCESS : fail(status != SB_OK ? report.text : error->message);
}
