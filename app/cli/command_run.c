// sealbench run: a scene's cycle to a summary, a table, JSON or a folder of results.
#include "app/cli/cli.h"
#include "app/cli/plots.h"
#include "app/cli/run_text.h"
#include "app/export/results_files.h"

typedef struct {
  char *folder, *json_target, *measured;
  char **settings;
  SbCliPlots plots;
  gboolean all;
} RunOptions;

// Checks before the work whether all outputs can be written. Returns an exit code.
static int check_run_outputs(const SbCliFiles *files, void *data) {
  const RunOptions *options = data;
  g_autoptr(GPtrArray) all = g_ptr_array_new_with_free_func(g_free);
  for (int i = 0; i < files->count; i++) {
    const SbCliFile *file = &files->file[i];
    if (file->document == NULL) {
      continue;
    }
    const SbModel *model = file->model;
    g_auto(GStrv) names =
        sb_results_folder_names((unsigned)sb_model_number(model, SB_P_OUTPUT_STUDIES),
                                sb_model_number(model, SB_P_LIFE_ACTUATIONS) > 1);
    for (char **name = names; *name != NULL; name++) {
      g_ptr_array_add(all, files->count > 1 ? g_build_filename(file->name, *name, NULL)
                                            : g_strdup(*name));
    }
  }
  g_ptr_array_add(all, NULL);
  return sb_cli_check_outputs(options->folder, (char **)all->pdata, options->json_target);
}

// Writes or prints what was computed; an exit code.
static int write_results(SbCliFiles *files, const SbCliFile *file, const RunOptions *options,
                         const SbRun *run, const SbResultsInfo *info) {
  g_autofree char *json = sb_results_run(run, info);
  SbResultsFiles all = {run, json, info->studies, info->study_count};
  const int code = file->folder != NULL
                       ? sb_cli_write_folder(file->folder, "run", sb_results_folder_fill, &all)
                       : SB_EXIT_DONE;
  if (code != SB_EXIT_DONE) {
    return code;
  }
  if (options->json_target != NULL) {
    g_ptr_array_add(files->json, g_steal_pointer(&json));
  } else if (!sb_cli_quiet()) {
    sb_cli_files_head(files);
    const SbCliRunText text = {.title = sb_document_title(file->document),
                               .run = run,
                               .converged = sb_results_converged(sb_run_summary(run), info),
                               .verdict = info->verdict,
                               .measured = info->measured,
                               .folder = file->folder,
                               .plots = &options->plots};
    if (options->all) {
      sb_cli_run_table(&text);
    } else {
      sb_cli_run_summary(&text);
    }
  }
  return SB_EXIT_DONE;
}

// Whether there is memory for the scene and its cases.
static bool has_memory(const SbCliFile *file, bool studies) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  bool good = sb_cli_has_memory(studies ? NULL : file->model);
  for (size_t i = 0; good && i < sb_document_case_count(file->document); i++) {
    g_autoptr(SbModel) model = NULL;
    good = !sb_document_compile_case(file->document, i, &model, issues) || sb_cli_has_memory(model);
  }
  return good;
}

// Computes one file's run, cases and studies, and writes them. An exit code.
static int run_one_file(SbCliFiles *files, const SbCliFile *file, void *data) {
  const RunOptions *options = data;
  const SbModel *model = file->model;
  if (!sb_cli_quiet() && sb_document_kind(file->document) == SB_DOCUMENT_VALVE &&
      sb_document_path(file->document) != NULL) {
    sb_cli_name_file(NULL);
    sb_cli_fail("note: %s is a valve, no scene: its default cycle is run", file->path);
    sb_cli_name_file(files->count > 1 ? file->path : NULL);
  }
  g_autofree SbPlan *plan = g_new(SbPlan, 1);
  SbReport report = {0};
  sb_plan_make(plan, model);
  if (!has_memory(file, plan->studies != 0)) {
    return SB_EXIT_IO;
  }
  int read;
  g_autoptr(SbMeasured) measured = sb_cli_measured(&read, file->document, options->measured);
  if (read != SB_EXIT_DONE) {
    return read;
  }
  SbRun *run = NULL;
  const SbStatus status = sb_cli_compute(&run, model, plan, "", &report);
  int code = sb_cli_status(status, &report);
  g_autofree SbStudy *studies = NULL;
  if (status == SB_OK || status == SB_ERROR_NOT_CONVERGED || status == SB_ERROR_CANCELLED) {
    g_autofree char *sha256 = sb_document_sha256(file->document);
    size_t study_count = 0;
    SbCaseVerdict verdict[SB_VERDICT_COUNT];
    if (status != SB_ERROR_CANCELLED && plan->studies != 0) {
      studies = g_new(SbStudy, SB_STUDY_COUNT);
      int studied = sb_cli_studies(studies, &study_count, model, plan->studies);
      code = studied != SB_EXIT_DONE ? studied : code;
    }
    g_autoptr(GPtrArray) problems = g_ptr_array_new_with_free_func(g_free);
    const SbStatus judged =
        sb_cli_judge(verdict, problems, run, file->document, studies, study_count);
    const int judged_code = judged == SB_OK                ? SB_EXIT_DONE
                            : judged == SB_ERROR_CANCELLED ? SB_EXIT_INTERRUPTED
                            : judged == SB_ERROR_MEMORY    ? SB_EXIT_IO
                                                           : SB_EXIT_NOT_CONVERGED;
    code = MAX(code, judged_code);
    SbLoop loop = {0};
    g_autoptr(SbComparison) comparison =
        measured != NULL && sb_loop_take(&loop, run) ? sb_comparison_create(measured, &loop) : NULL;
    sb_loop_clear(&loop);
    SbResultsInfo info = {.scene = file->full,
                          .sha256 = sha256,
                          .partial = code == SB_EXIT_INTERRUPTED,
                          .verdict = verdict,
                          .problems = problems,
                          .measured = comparison,
                          .studies = studies,
                          .study_count = study_count};
    int written = write_results(files, file, options, run, &info);
    code = written != SB_EXIT_DONE ? written : code;
  }
  sb_run_destroy(run);
  return code;
}

int sb_command_run(int argc, char **argv) {
  RunOptions options = {0};
  const GOptionEntry entries[] = {
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &options.folder,
       "Folder for results.json, cycle.csv, profiles.csv, and life or study tables; of several "
       "files a folder each in it",
       "DIR"},
      {"measured", 0, 0, G_OPTION_ARG_FILENAME, &options.measured, SB_CLI_MEASURED_HELP, "FILE"},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &options.settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &options.json_target, SB_CLI_JSON_HELP, "FILE|-"},
      {"all", 0, 0, G_OPTION_ARG_NONE, &options.all,
       "Prints all figures, stages, warnings and the solver's state in place of the summary", NULL},
      {"plot", 0, 0, G_OPTION_ARG_NONE, &options.plots.on, "With --all: " SB_CLI_PLOT_HELP, NULL},
      {"no-plot", 0, 0, G_OPTION_ARG_NONE, &options.plots.off, "Draws no loop", NULL},
      {0},
  };
  const bool good = sb_cli_parse(&argc, &argv, entries, 1, SB_CLI_FILES_MAX, NULL);
  const SbCliFilesWork work = {options.settings,  options.folder, options.json_target,
                               check_run_outputs, run_one_file,   &options};
  return good ? sb_cli_files_run(argc, argv, &work) : SB_EXIT_INPUT;
}
