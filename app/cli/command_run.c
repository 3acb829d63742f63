// sealbench run: a scene's cycle to a table, JSON or a folder of results.
#include "app/base/figure_text.h"
#include "app/cli/cli.h"
#include "app/cli/plots.h"
#include "app/export/results_files.h"

#include <math.h>
#include <string.h>

// A line of the table: the figure, or a dash and the reason.
static void print_figure(const SbSummary *summary, int index) {
  double value = sb_figure_value(summary, index);
  const char *reason = sb_figure_reason(summary, index);
  g_autofree char *text = sb_figure_format(index, value, sb_figure_error(summary, index));
  g_autofree char *why = reason != NULL ? g_strdup_printf("%s (%s)", text, reason) : NULL;
  sb_cli_line(sb_figure(index)->label, reason != NULL ? why : text);
}

// Those of the short table whose paths begin with `scope`; `known`: without those that are not.
static void print_figures(const SbSummary *summary, const char *scope, bool known) {
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const SbFigure *figure = sb_figure(i);
    if (figure->brief && g_str_has_prefix(figure->path, scope) &&
        !(known && isnan(sb_figure_value(summary, i)))) {
      print_figure(summary, i);
    }
  }
}

// Time, displacement and force in a line.
static void print_stage(const SbSummary *summary, SbStage stage) {
  g_autofree char *scope = g_strdup_printf("cycle.stages.%s.", sb_stage_name(stage));
  g_autofree char *label = g_strdup_printf("Stage %s", sb_stage_name(stage));
  g_autoptr(GString) text = g_string_new(NULL);
  for (int i = 0; i < SB_FIGURE_COUNT && summary->stage[stage].reached; i++) {
    if (g_str_has_prefix(sb_figure(i)->path, scope)) {
      g_autofree char *one =
          sb_figure_format(i, sb_figure_value(summary, i), sb_figure_error(summary, i));
      g_string_append_printf(text, "%s%s", text->len > 0 ? ", " : "", one);
    }
  }
  sb_cli_line(label, text->len > 0 ? text->str : "not reached");
}

static void print_seal(const SbSummary *summary, int seal) {
  g_autofree char *scope = g_strdup_printf("seals.%s.", sb_seal_name(seal));
  printf("%s seal, middle of B-C\n", seal == SB_OUTER ? "Outer" : "Inner");
  print_figures(summary, scope, false);
  sb_cli_line("Leak path", sb_leak_state_name(summary->seal[seal].leak_state));
}

// The figure that decides a question, with its limit; owned by the caller.
static char *deciding_text(const SbSummary *summary, const SbVerdict *verdict) {
  if (isnan(verdict->value) || isnan(verdict->limit)) {
    return g_strdup("");
  }
  const double error = sb_figure_error(summary, verdict->figure);
  g_autofree char *value = sb_figure_format(verdict->figure, verdict->value, error);
  g_autofree char *limit = sb_figure_given(verdict->figure, verdict->limit);
  return g_strdup_printf(", %s against %s", value, limit);
}

// The questions that have an answer.
static void print_verdict(const SbSummary *summary, const SbCaseVerdict *verdicts) {
  printf("Verdict\n");
  for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
    const SbVerdict *verdict = &verdicts[kind].of;
    const char *name = verdicts[kind].name;
    if (verdict->figure >= 0) {
      static const char *const answers[] = {"-", "NO", "yes"};
      bool because = verdict->reason[0] != '\0';
      g_autofree char *deciding = deciding_text(summary, verdict);
      g_autofree char *text = g_strdup_printf(
          "%s%s%s%s%s%s%s", answers[verdict->ok], deciding, because ? " (" : "", verdict->reason,
          because ? ")" : "", name != NULL ? ", case " : "", name != NULL ? name : "");
      sb_cli_line(sb_verdict_name((SbVerdictKind)kind), text);
    }
  }
}

static void print_rig(const SbSummary *summary) {
  print_figures(summary, "rig.", false);
  sb_cli_figure("Dynamic, measured in the thesis", SB_RIG_MEASURED_DYNAMIC, "1", "");
  sb_cli_figure("Dynamic, predicted there", SB_RIG_PREDICTED_DYNAMIC, "1", "");
  g_autofree char *peaks = g_strdup_printf("%zu", summary->rig.of.peaks);
  sb_cli_line("Peaks that follow", peaks);
}

static void print_solver(const SbSummary *summary) {
  sb_cli_warnings(&summary->warnings);
  printf("Solver\n");
  sb_cli_line("Converged", summary->converged ? "yes" : "NO");
  char *frames = g_strdup_printf("%zu", summary->frames);
  sb_cli_line("Frames", frames);
  g_free(frames);
  sb_cli_figure("Engine time", summary->wall_s, "s", "ms");
}

static void print_table(const SbDocument *document, const SbRun *run,
                        const SbCaseVerdict *verdict) {
  const SbSummary *summary = sb_run_summary(run);
  printf("%s\n", sb_document_title(document));
  bool rig = sb_model_is_rig(sb_run_model(run));
  print_figures(summary, "cycle.", rig);
  if (rig) {
    print_rig(summary);
    print_solver(summary);
    return;
  }
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    print_stage(summary, (SbStage)i);
  }
  print_figures(summary, "people.", false);
  if (summary->life.done > 0) {
    printf("Life of %ld actuations\n", summary->life.done);
    print_figures(summary, "life.", false);
  }
  print_seal(summary, SB_OUTER);
  print_seal(summary, SB_INNER);
  print_verdict(summary, verdict);
  print_solver(summary);
}

static void on_progress(void *data, double fraction, size_t frames) {
  sb_progress_update(data, fraction);
}

static bool on_cancelled(void *data) {
  return sb_cli_interrupted(NULL);
}

// The studies of a bit mask, in order; returns the worst exit code. An interrupt ends with those
// that are done.
static int make_studies(SbStudy *out, size_t *count, const SbModel *model, unsigned mask) {
  int code = SB_EXIT_DONE;
  for (int i = 0; i < SB_STUDY_COUNT; i++) {
    if ((mask & (1u << i)) == 0) {
      continue;
    }
    int made = sb_cli_study(&out[*count], (SbStudyKind)i, model);
    *count += made == SB_EXIT_DONE || made == SB_EXIT_NOT_CONVERGED ? 1 : 0;
    code = made != SB_EXIT_DONE ? made : code;
    if (made == SB_EXIT_INTERRUPTED) {
      break;
    }
  }
  return code;
}

typedef struct {
  char *folder, *json_target, *measured;
  char **settings;
  SbCliPlots plots;
} Options;

// Whether all that will be written can be: told before the work, not after it. An exit code.
static int check_outputs(const SbCliFiles *files, const Options *options) {
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
static int write_results(SbCliFiles *files, const SbCliFile *file, const Options *options,
                         const SbRun *run, const SbResultsInfo *info) {
  g_autofree char *json = sb_results_run(run, info);
  g_autoptr(GPtrArray) kept = g_ptr_array_new_with_free_func(g_free);
  GError *error = NULL;
  if (file->folder != NULL && !sb_results_folder_write(file->folder, run, json, info->studies,
                                                       info->study_count, kept, &error)) {
    return sb_cli_error(error);
  }
  sb_cli_kept(file->folder, kept);
  if (options->json_target != NULL) {
    g_ptr_array_add(files->json, g_steal_pointer(&json));
  } else if (!sb_cli_quiet()) {
    sb_cli_files_head(files);
    print_table(file->document, run, info->verdict);
    if (info->measured != NULL) {
      sb_cli_comparison(info->measured);
    }
    if (sb_cli_plots(&options->plots)) {
      sb_cli_plot_run(run, info->measured);
    }
    if (file->folder != NULL) {
      printf("Results are in %s\n", file->folder);
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

// The worst answers of the scene and its cases; an exit code.
static int judge(SbCaseVerdict *verdict, const SbRun *run, const SbDocument *document) {
  g_autoptr(GPtrArray) problems = g_ptr_array_new_with_free_func(g_free);
  SbProgress progress;
  sb_progress_start(&progress, "cases ");
  SbRunHooks hooks = {.progress = on_progress, .cancelled = on_cancelled, .data = &progress};
  SbStatus status = sb_cases_judge(verdict, run, document, &hooks, problems);
  sb_progress_end(&progress);
  for (guint i = 0; i < problems->len; i++) {
    sb_cli_fail("%s", (const char *)problems->pdata[i]);
  }
  return status == SB_OK                ? SB_EXIT_DONE
         : status == SB_ERROR_CANCELLED ? SB_EXIT_INTERRUPTED
         : status == SB_ERROR_MEMORY    ? SB_EXIT_IO
                                        : SB_EXIT_NOT_CONVERGED;
}

// Computes one file's run, cases and studies, and writes them. An exit code.
static int run_file(SbCliFiles *files, const SbCliFile *file, const Options *options) {
  const SbModel *model = file->model;
  SbPlan plan;
  SbReport report = {0};
  sb_plan_make(&plan, model);
  if (!has_memory(file, plan.studies != 0)) {
    return SB_EXIT_IO;
  }
  int read;
  g_autoptr(SbMeasured) measured = sb_cli_measured(&read, file->document, options->measured);
  if (read != SB_EXIT_DONE) {
    return read;
  }
  SbRun *run = NULL;
  SbStatus status = sb_run_create(&run, model, &plan, &report);
  if (status != SB_OK) {
    return sb_cli_status(status, &report);
  }
  SbProgress progress;
  sb_progress_start(&progress, "");
  sb_cli_catch_interrupts();
  SbRunHooks hooks = {.progress = on_progress, .cancelled = on_cancelled, .data = &progress};
  status = sb_run_execute(run, &hooks, &report);
  sb_progress_end(&progress);
  int code = sb_cli_status(status, &report);
  g_autofree SbStudy *studies = NULL;
  if (status == SB_OK || status == SB_ERROR_NOT_CONVERGED || status == SB_ERROR_CANCELLED) {
    g_autofree char *sha256 = sb_document_sha256(file->document);
    size_t study_count = 0;
    SbCaseVerdict verdict[SB_VERDICT_COUNT];
    int judged = judge(verdict, run, file->document);
    code = MAX(code, judged);
    if (code != SB_EXIT_INTERRUPTED && plan.studies != 0) {
      studies = g_new(SbStudy, SB_STUDY_COUNT);
      int studied = make_studies(studies, &study_count, model, plan.studies);
      code = studied != SB_EXIT_DONE ? studied : code;
    }
    SbLoop loop = {0};
    g_autoptr(SbComparison) comparison =
        measured != NULL && sb_loop_take(&loop, run) ? sb_comparison_create(measured, &loop) : NULL;
    sb_loop_clear(&loop);
    SbResultsInfo info = {.scene = file->full,
                          .sha256 = sha256,
                          .partial = code == SB_EXIT_INTERRUPTED,
                          .verdict = verdict,
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
  Options options = {0};
  const GOptionEntry entries[] = {
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &options.folder,
       "Folder for results.json, cycle.csv, profiles.csv, and life or study tables; of several "
       "files a folder each in it",
       "DIR"},
      {"measured", 0, 0, G_OPTION_ARG_FILENAME, &options.measured, SB_CLI_MEASURED_HELP, "FILE"},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &options.settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &options.json_target, SB_CLI_JSON_HELP, "FILE|-"},
      {"plot", 0, 0, G_OPTION_ARG_NONE, &options.plots.on, SB_CLI_PLOT_HELP, NULL},
      {"no-plot", 0, 0, G_OPTION_ARG_NONE, &options.plots.off, SB_CLI_NO_PLOT_HELP, NULL},
      {0},
  };
  SbCliFiles files = {.code = SB_EXIT_INPUT};
  if (sb_cli_parse(&argc, &argv, entries, 1, SB_CLI_FILES_MAX, NULL) &&
      sb_cli_files_open(&files, argc, argv, options.settings, options.folder)) {
    int checked = check_outputs(&files, &options);
    sb_cli_files_done(&files, checked);
    for (const SbCliFile *file;
         checked == SB_EXIT_DONE && (file = sb_cli_files_next(&files)) != NULL;) {
      if (!sb_cli_quiet() && sb_document_kind(file->document) == SB_DOCUMENT_VALVE &&
          sb_document_path(file->document) != NULL) {
        sb_cli_name_file(NULL);
        sb_cli_fail("note: %s is a valve, no scene: its default cycle is run", file->path);
        sb_cli_name_file(files.count > 1 ? file->path : NULL);
      }
      sb_cli_files_done(&files, run_file(&files, file, &options));
    }
    sb_cli_files_emit(&files, options.json_target);
  }
  sb_cli_files_close(&files);
  g_strfreev(options.settings);
  g_free(options.folder);
  g_free(options.json_target);
  g_free(options.measured);
  return files.code;
}
