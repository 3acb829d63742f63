// sealbench compare: runs of scenes side by side, and a measured loop beside them.
#include "app/base/figure_text.h"
#include "app/cli/cli.h"
#include "app/cli/plots.h"
#include "app/export/measured_results.h"
#include "app/session/pin_names.h"

#include <math.h>

typedef struct {
  char *measured, *json;
  char **settings;
  SbCliPlots plots;
} Options;

// What is kept of each run.
typedef struct {
  size_t count;
  char **name;
  const char **scene;       // full path of each run's file, borrowed
  double **figure, **error; // [SB_FIGURE_COUNT] each
  uint64_t *methods;        // sb_model_methods() of each
  SbRun **run;              // for the chart; NULL: none is drawn
  SbMeasured **measured;
  SbComparison **comparison; // NULL: nothing measured
} Runs;

static void on_progress(void *data, double fraction, size_t frames) {
  sb_progress_update(data, fraction);
}

// Runs one model of a file, keeps its figures and calls it `name`; an exit code.
static int run_model(Runs *runs, const SbCliFile *file, const SbModel *model, const char *name,
                     const Options *options) {
  SbPlan plan;
  SbReport report = {0};
  SbRun *run = NULL;
  int code;
  SbMeasured *measured = sb_cli_measured(&code, file->document, options->measured);
  if (code != SB_EXIT_DONE) {
    return code;
  }
  if (!sb_cli_has_memory(model)) {
    sb_measured_free(measured);
    return SB_EXIT_IO;
  }
  const SbPlanWishes wishes = {.views = SB_VIEW_HYSTERESIS, .life = true};
  sb_plan_wished(&plan, model, &wishes);
  SbStatus status = sb_run_create(&run, model, &plan, &report);
  if (status == SB_OK) {
    SbProgress progress;
    sb_progress_start(&progress, "");
    sb_cli_catch_interrupts();
    const SbRunHooks hooks = {
        .progress = on_progress, .cancelled = sb_cli_interrupted, .data = &progress};
    status = sb_run_execute(run, &hooks, &report);
    sb_progress_end(&progress);
  }
  if (status == SB_OK || status == SB_ERROR_NOT_CONVERGED) {
    const size_t at = runs->count++;
    runs->name[at] = g_strdup(name);
    runs->scene[at] = file->full;
    runs->figure[at] = g_new(double, SB_FIGURE_COUNT);
    runs->error[at] = g_new(double, SB_FIGURE_COUNT);
    runs->methods[at] = sb_model_methods(model);
    for (int f = 0; f < SB_FIGURE_COUNT; f++) {
      runs->figure[at][f] = sb_figure_value(sb_run_summary(run), f);
      runs->error[at][f] = sb_figure_error(sb_run_summary(run), f);
    }
    SbLoop loop = {0};
    if (measured != NULL && sb_loop_take(&loop, run)) {
      runs->measured[at] = measured;
      runs->comparison[at] = sb_comparison_create(measured, &loop);
      measured = NULL;
    } else if (measured != NULL) {
      (void)sb_cli_fail("%s: its stem does not slide, so there is no loop to compare", file->path);
    }
    sb_loop_clear(&loop);
    if (options->json == NULL && sb_cli_plots(&options->plots)) {
      runs->run[at] = run;
      run = NULL;
    }
  }
  sb_measured_free(measured);
  sb_run_destroy(run);
  return sb_cli_status(status, &report);
}

// A file's document and its pins; an exit code.
static int run_file(Runs *runs, const SbCliFile *file, const Options *options) {
  const SbDocument *document = file->document;
  int code = run_model(runs, file, file->model, sb_document_title(document), options);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  for (size_t i = 0; i < sb_document_pin_count(document); i++) {
    g_autoptr(SbModel) model = NULL;
    g_autofree char *name = sb_pin_name(document, i);
    if (!sb_cli_interrupted(NULL) && sb_document_compile_pin(document, i, &model, issues)) {
      const int ran = run_model(runs, file, model, name, options);
      code = MAX(code, ran);
    }
  }
  sb_cli_issues(issues);
  return issues->len > 0 ? MAX(code, SB_EXIT_INPUT) : code;
}

// Prints a figure of all runs, and the difference of each from the first, with the decimals that
// the error of the differences supports.
static void print_figure(const Runs *runs, int f) {
  g_autofree SbFigureCompared *design = g_new(SbFigureCompared, runs->count);
  for (size_t i = 0; i < runs->count; i++) {
    design[i] = (SbFigureCompared){runs->figure[i][f], runs->error[i][f], runs->methods[i]};
  }
  g_autofree char *label = sb_figure_label(f);
  printf("  %-36s", label);
  for (size_t i = 0; i < runs->count; i++) {
    char value[SB_FORMAT_MAX], change[SB_FORMAT_MAX];
    const char *unit = sb_figure_compared(value, change, f, design, runs->count, i);
    g_autofree char *all = *change == '\0'
                               ? g_strdup_printf("%s%s%s", value, *unit != '\0' ? " " : "", unit)
                               : g_strdup_printf("%s%s%s (%s%s%s)", value, *unit != '\0' ? " " : "",
                                                 unit, change, *unit != '\0' ? " " : "", unit);
    printf("  %-*s", i == 0 ? 12 : 24, all);
  }
  putchar('\n');
}

// The figures of the short table that a run knows.
static void print_figures(const Runs *runs) {
  for (size_t i = 0; i < runs->count; i++) {
    printf("%zu: %s\n", i + 1, runs->name[i]);
  }
  for (int f = 0; f < SB_FIGURE_COUNT; f++) {
    const SbFigure *figure = sb_figure(f);
    bool known = false;
    for (size_t i = 0; i < runs->count; i++) {
      known |= !isnan(runs->figure[i][f]);
    }
    if (!figure->brief || !known) {
      continue;
    }
    print_figure(runs, f);
  }
}

int sb_command_compare(int argc, char **argv) {
  Options options = {0};
  const GOptionEntry entries[] = {
      {"measured", 0, 0, G_OPTION_ARG_FILENAME, &options.measured, SB_CLI_MEASURED_HELP, "FILE"},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &options.settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &options.json, "JSON to a file or -", "FILE|-"},
      {"plot", 0, 0, G_OPTION_ARG_NONE, &options.plots.on, SB_CLI_PLOT_HELP, NULL},
      {"no-plot", 0, 0, G_OPTION_ARG_NONE, &options.plots.off, SB_CLI_NO_PLOT_HELP, NULL},
      {0},
  };
  SbCliFiles files = {.code = SB_EXIT_INPUT};
  if (sb_cli_parse(&argc, &argv, entries, 1, SB_CLI_FILES_MAX, NULL) &&
      sb_cli_files_open(&files, argc, argv, options.settings, NULL)) {
    size_t room = (size_t)files.count;
    for (int i = 0; i < files.count; i++) {
      if (files.file[i].document != NULL) {
        room += sb_document_pin_count(files.file[i].document);
      }
    }
    Runs runs = {.name = g_new0(char *, room + 1),
                 .scene = g_new0(const char *, room),
                 .figure = g_new0(double *, room),
                 .error = g_new0(double *, room),
                 .methods = g_new0(uint64_t, room),
                 .run = g_new0(SbRun *, room),
                 .measured = g_new0(SbMeasured *, room),
                 .comparison = g_new0(SbComparison *, room)};
    const int checked = sb_cli_check_outputs(NULL, NULL, options.json);
    sb_cli_files_done(&files, checked);
    for (const SbCliFile *file;
         checked == SB_EXIT_DONE && (file = sb_cli_files_next(&files)) != NULL;) {
      sb_cli_files_done(&files, run_file(&runs, file, &options));
    }
    if (runs.count > 0 && options.json != NULL) {
      g_autofree char *json = sb_results_compare(runs.count, (const char *const *)runs.name,
                                                 runs.scene, runs.figure, runs.comparison);
      sb_cli_files_done(&files, sb_cli_emit(json, options.json));
    } else if (runs.count > 0 && !sb_cli_quiet()) {
      print_figures(&runs);
      for (size_t i = 0; i < runs.count; i++) {
        if (runs.comparison[i] != NULL) {
          printf("%zu: %s\n", i + 1, runs.name[i]);
          sb_cli_comparison(runs.comparison[i]);
        }
      }
      if (runs.run[0] != NULL) {
        sb_cli_plot_runs(runs.run, (const char *const *)runs.name, runs.count, runs.comparison[0]);
      }
    }
    for (size_t i = 0; i < runs.count; i++) {
      g_free(runs.figure[i]);
      g_free(runs.error[i]);
      sb_run_destroy(runs.run[i]);
      sb_comparison_free(runs.comparison[i]);
      sb_measured_free(runs.measured[i]);
    }
    g_strfreev(runs.name);
    g_free(runs.scene);
    g_free(runs.figure);
    g_free(runs.error);
    g_free(runs.methods);
    g_free(runs.run);
    g_free(runs.measured);
    g_free(runs.comparison);
  }
  sb_cli_files_close(&files);
  return files.code;
}
