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
  GPtrArray *runs; // of Run
} CompareOptions;

// A run that is compared.
typedef struct {
  SbComparedRun of;
  double error[SB_FIGURE_COUNT]; // relative
  uint64_t methods;              // sb_model_methods()
  SbRun *run;                    // for the chart; NULL: none is drawn
  SbMeasured *measured;
} Run;

static void clear_run(void *data) {
  Run *run = data;
  for (int f = 0; f < SB_FIGURE_COUNT; f++) {
    g_free(run->of.reason[f]);
  }
  sb_run_destroy(run->run);
  sb_comparison_free((SbComparison *)run->of.comparison);
  sb_measured_free(run->measured);
  g_free((char *)run->of.name);
  g_free((char *)run->of.scene);
  g_free(run);
}

// Appends one run with the figures and the measured loop of a computed one, which it takes.
static void add_run(GPtrArray *runs, const SbCliFile *file, SbRun *run, const char *name,
                    SbMeasured *measured, const CompareOptions *options) {
  Run *kept = g_new0(Run, 1);
  *kept = (Run){.of = {.name = g_strdup(name), .scene = g_strdup(file->full)},
                .methods = sb_model_methods(sb_run_model(run)),
                .measured = measured};
  for (int f = 0; f < SB_FIGURE_COUNT; f++) {
    kept->of.figure[f] = sb_figure_value(sb_run_summary(run), f);
    kept->of.reason[f] = g_strdup(sb_figure_reason(sb_run_summary(run), f));
    kept->error[f] = sb_figure_error(sb_run_summary(run), f);
  }
  SbLoop loop = {0};
  if (measured != NULL && sb_loop_take(&loop, run)) {
    kept->of.comparison = sb_comparison_create(measured, &loop);
  } else if (measured != NULL) {
    (void)sb_cli_fail("%s: its stem does not slide, so there is no loop to compare", file->path);
  }
  sb_loop_clear(&loop);
  if (options->json == NULL && sb_cli_plots(&options->plots)) {
    kept->run = run;
  } else {
    sb_run_destroy(run);
  }
  g_ptr_array_add(runs, kept);
}

// Runs one model of a file and keeps it as `name`; an exit code.
static int run_model(GPtrArray *runs, const SbCliFile *file, const SbModel *model, const char *name,
                     const CompareOptions *options) {
  SbPlan plan;
  SbReport report = {0};
  SbRun *run = NULL;
  int code;
  g_autoptr(SbMeasured) measured = sb_cli_measured(&code, file->document, options->measured);
  if (code != SB_EXIT_DONE) {
    return code;
  }
  if (!sb_cli_has_memory(model)) {
    return SB_EXIT_IO;
  }
  const SbPlanWishes wishes = {.views = SB_VIEW_HYSTERESIS, .life = true};
  sb_plan_wished(&plan, model, &wishes);
  const SbStatus status = sb_cli_compute(&run, model, &plan, "", &report);
  if (status == SB_OK || status == SB_ERROR_NOT_CONVERGED) {
    add_run(runs, file, run, name, g_steal_pointer(&measured), options);
  } else {
    sb_run_destroy(run);
  }
  return sb_cli_status(status, &report);
}

// A file's document and its pins; an exit code.
static int run_file(SbCliFiles *files, const SbCliFile *file, void *data) {
  const CompareOptions *options = data;
  GPtrArray *runs = options->runs;
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

// Adds a figure of all runs, with the difference of each from the first and the decimals that the
// error of the differences supports.
static void add_figure(SbTable *table, const GPtrArray *runs, int f) {
  g_autofree SbFigureCompared *design = g_new(SbFigureCompared, runs->len);
  g_autofree SbTableCell *cell = g_new0(SbTableCell, runs->len + 1);
  bool known = false;
  for (guint i = 0; i < runs->len; i++) {
    const Run *run = runs->pdata[i];
    design[i] = (SbFigureCompared){run->of.figure[f], run->error[f], run->methods};
    known |= !isnan(run->of.figure[f]);
  }
  if (!known || !sb_figure(f)->brief) {
    return;
  }
  cell[0] = sb_cell_own(sb_figure_label(f));
  for (guint i = 0; i < runs->len; i++) {
    char value[SB_FORMAT_MAX], change[SB_FORMAT_MAX];
    const char *unit = sb_figure_compared(value, change, f, design, runs->len, i);
    const char *space = *unit != '\0' ? " " : "";
    cell[i + 1] = sb_cell_shown(
        *change == '\0' ? g_strconcat(value, space, unit, NULL)
                        : g_strconcat(value, space, unit, " (", change, space, unit, ")", NULL));
  }
  sb_table_add(table, cell);
}

// Prints the figures of the short table that a run knows, the measured loops and the chart.
static void print_runs(const GPtrArray *runs) {
  g_autoptr(GPtrArray) names = g_ptr_array_new(), drawn = g_ptr_array_new();
  for (guint i = 0; i < runs->len; i++) {
    const Run *run = runs->pdata[i];
    printf("%u: %s\n", i + 1, run->of.name);
    g_ptr_array_add(names, (char *)run->of.name);
    g_ptr_array_add(drawn, run->run);
  }
  g_autofree SbTableColumn *columns = g_new0(SbTableColumn, runs->len + 1);
  for (guint i = 0; i <= runs->len; i++) {
    columns[i].layout = i == 0 ? "  %-36s" : i == 1 ? "  %-12s" : "  %-24s";
  }
  g_autoptr(SbTable) table = sb_table_new(columns, runs->len + 1);
  for (int f = 0; f < SB_FIGURE_COUNT; f++) {
    add_figure(table, runs, f);
  }
  (void)sb_cli_table(table, NULL);
  const SbComparison *first = ((const Run *)runs->pdata[0])->of.comparison;
  for (guint i = 0; i < runs->len; i++) {
    const Run *run = runs->pdata[i];
    if (run->of.comparison != NULL) {
      printf("%u: %s\n", i + 1, run->of.name);
      sb_cli_comparison(run->of.comparison);
    }
  }
  if (drawn->pdata[0] != NULL) {
    sb_cli_plot_runs((SbRun **)drawn->pdata, (const char *const *)names->pdata, runs->len, first);
  }
}

int sb_command_compare(int argc, char **argv) {
  CompareOptions options = {0};
  const GOptionEntry entries[] = {
      {"measured", 0, 0, G_OPTION_ARG_FILENAME, &options.measured, SB_CLI_MEASURED_HELP, "FILE"},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &options.settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &options.json, "JSON to a file or -", "FILE|-"},
      {"plot", 0, 0, G_OPTION_ARG_NONE, &options.plots.on, SB_CLI_PLOT_HELP, NULL},
      {"no-plot", 0, 0, G_OPTION_ARG_NONE, &options.plots.off, SB_CLI_NO_PLOT_HELP, NULL},
      {0},
  };
  if (!sb_cli_parse(&argc, &argv, entries, 1, SB_CLI_FILES_MAX, NULL)) {
    return SB_EXIT_INPUT;
  }
  g_autoptr(GPtrArray) runs = options.runs = g_ptr_array_new_with_free_func(clear_run);
  const SbCliFilesWork work = {options.settings, NULL, options.json, NULL, run_file, &options};
  int code = sb_cli_files_run(argc, argv, &work), written = SB_EXIT_DONE;
  if (runs->len > 0 && options.json != NULL) {
    g_autofree char *json =
        sb_results_compare((const SbComparedRun *const *)runs->pdata, runs->len);
    written = sb_cli_emit(json, options.json);
  } else if (runs->len > 0 && !sb_cli_quiet()) {
    print_runs(runs);
  }
  return MAX(code, written);
}
