// sealbench report: a scene's run, or a study's answers, as pages.
#include "app/cli/cli.h"

#include "app/base/output.h"
#include "app/export/report.h"

#include <string.h>

typedef struct {
  char *output, *measured, *jobs;
  char **settings;
  int threads;
} ReportOptions;

static bool on_page(void *data, int done, int count) {
  sb_progress_update(data, (double)done / count);
  return sb_cli_interrupted(NULL);
}

// One of the two, with its progress; an exit code.
static int write_pages(const char *output, const SbReportScene *scene, const SbReportStudy *study) {
  GError *error = NULL;
  SbOutput out = {0};
  if (!sb_output_begin(&out, output, &error)) {
    return sb_cli_error(error);
  }
  SbProgress progress;
  sb_progress_start(&progress, "drawing ");
  const SbReportHooks hooks = {on_page, &progress};
  const bool good = scene != NULL ? sb_report_scene(out.stream, scene, &hooks, &error)
                                  : sb_report_study(out.stream, study, &hooks, &error);
  sb_progress_end(&progress);
  if (!good) {
    sb_output_abort(&out);
  }
  return good && sb_output_commit(&out, &error) ? SB_EXIT_DONE : sb_cli_error(error);
}

// ---- A scene ----

static int report_run(const SbRun *run, const SbDocument *document, const SbMeasured *measured,
                      const ReportOptions *options) {
  SbCaseVerdict verdict[SB_VERDICT_COUNT];
  g_autofree SbStudy *studies = g_new(SbStudy, SB_STUDY_COUNT);
  size_t count = 0;
  const SbModel *model = sb_run_model(run);
  const unsigned mask = (unsigned)sb_model_number(model, SB_P_OUTPUT_STUDIES);
  const int studied =
      sb_cli_interrupted(NULL) ? SB_EXIT_INTERRUPTED : sb_cli_studies(studies, &count, model, mask);
  g_autoptr(GPtrArray) problems = g_ptr_array_new_with_free_func(g_free);
  const SbStatus judged = sb_cli_judge(verdict, problems, run, document, studies, count);
  if (studied == SB_EXIT_INTERRUPTED || judged == SB_ERROR_CANCELLED) {
    sb_cli_fail("interrupted: nothing was written");
    return SB_EXIT_INTERRUPTED;
  }
  SbLoop loop = {0};
  g_autoptr(SbComparison) comparison =
      measured != NULL && sb_loop_take(&loop, run) ? sb_comparison_create(measured, &loop) : NULL;
  sb_loop_clear(&loop);
  const SbReportScene scene = {.document = document,
                               .run = run,
                               .verdict = verdict,
                               .measured = comparison,
                               .studies = studies,
                               .study_count = count};
  const int written = write_pages(options->output, &scene, NULL);
  return written != SB_EXIT_DONE   ? written
         : studied != SB_EXIT_DONE ? studied
         : judged == SB_OK         ? SB_EXIT_DONE
                                   : SB_EXIT_NOT_CONVERGED;
}

static int report_scene(const SbDocument *document, const SbModel *model,
                        const ReportOptions *options) {
  int code = sb_cli_check_outputs(NULL, NULL, options->output), read = SB_EXIT_DONE;
  if (code == SB_EXIT_DONE && !sb_cli_has_memory(model)) {
    code = SB_EXIT_IO;
  }
  g_autoptr(SbMeasured) measured =
      code == SB_EXIT_DONE ? sb_cli_measured(&read, document, options->measured) : NULL;
  code = MAX(code, read);
  if (code == SB_EXIT_DONE) {
    const SbPlanWishes wishes = {.views = sb_report_views(model),
                                 .studies = (unsigned)sb_model_number(model, SB_P_OUTPUT_STUDIES),
                                 .life = true};
    g_autofree SbPlan *plan = g_new(SbPlan, 1);
    SbReport report = {0};
    SbRun *run = NULL;
    sb_plan_wished(plan, model, &wishes);
    const SbStatus status = sb_cli_compute(&run, model, plan, "computing ", &report);
    code = sb_cli_status(status, &report);
    if (status == SB_OK || status == SB_ERROR_NOT_CONVERGED) {
      const int reported = report_run(run, document, measured, options);
      code = reported != SB_EXIT_DONE ? reported : code;
    }
    sb_run_destroy(run);
  }
  return code;
}

// ---- A study ----

static int answered(void *data, const SbCliAnswers *of) {
  if (sb_cli_interrupted(NULL)) {
    sb_cli_fail("interrupted: nothing was written");
    return SB_EXIT_INTERRUPTED;
  }
  const SbReportStudy study = {of->study, of->value, of->drawn, of->answers};
  return write_pages(((const ReportOptions *)data)->output, NULL, &study);
}

static int report_study(const SbStudyFile *study, const char *path, const ReportOptions *options) {
  if (options->measured != NULL) {
    return sb_cli_fail("--measured: is for a scene, not for a study");
  }
  if (study->design.asked || study->data->len > 0) {
    return sb_cli_fail(
        "%s: requests a %s: a report requires a study that `sealbench study` computes", path,
        study->design.asked ? "design" : "calibration");
  }
  const int code = sb_cli_check_outputs(NULL, NULL, options->output);
  if (code != SB_EXIT_DONE) {
    return code;
  }
  // What `sealbench study` has computed is not computed again; a store is made by that alone.
  g_autofree char *store = sb_cli_store_path(NULL, study);
  const bool there = store != NULL && g_file_test(store, G_FILE_TEST_IS_REGULAR);
  const SbCliAsk ask = {.store = there ? store : NULL, .threads = options->threads};
  return sb_cli_answer(study, &ask, answered, (void *)options);
}

// The kind of the file decides, not its name: a pipe or standard input has no ending.
static int report(const char *path, const ReportOptions *options) {
  SbModel *model = NULL;
  g_autoptr(SbStudyFile) study = NULL;
  g_autoptr(SbDocument) document = sb_cli_open_either(&study, &model, path, options->settings);
  const int code = study != NULL      ? report_study(study, path, options)
                   : document != NULL ? report_scene(document, model, options)
                                      : SB_EXIT_INPUT;
  sb_model_destroy(model);
  return code;
}

int sb_command_report(int argc, char **argv) {
  ReportOptions options = {0};
  const GOptionEntry entries[] = {
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &options.output, "The pages, a .pdf or -",
       "OUT.pdf"},
      {"measured", 0, 0, G_OPTION_ARG_FILENAME, &options.measured, SB_CLI_MEASURED_HELP, "FILE"},
      {"jobs", 0, 0, G_OPTION_ARG_FILENAME, &options.jobs, SB_CLI_JOBS_HELP, "N"},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &options.settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {0},
  };
  int code = SB_EXIT_INPUT;
  if (sb_cli_parse(&argc, &argv, entries, 1, 1,
                   "Answers that NAME.store next to a study has are not computed again.") &&
      sb_cli_jobs(&options.threads, options.jobs)) {
    if (options.output == NULL) {
      code = sb_cli_fail("-o is missing: the pages to write (.pdf, or - for standard output)");
    } else if (strcmp(options.output, "-") != 0 && !sb_output_ends_in(options.output, ".pdf")) {
      code = sb_cli_fail("-o: %s: the ending must be .pdf", options.output);
    } else {
      code = report(argv[1], &options);
    }
  }
  return code;
}
