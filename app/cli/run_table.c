// The full table of a run. See run_text.h.
#include "app/cli/run_text.h"

#include "app/base/figure_text.h"
#include "app/cli/cli.h"

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

// The brief figures of a group; `seal`: of this seal (SB_SEAL_COUNT: of no seal); `known`: without
// those that were not computed.
static void print_figures(const SbSummary *summary, SbFigureGroup group, int seal, bool known) {
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const SbFigure *figure = sb_figure(i);
    if (figure->brief && figure->group == group && figure->seal == seal &&
        !(known && isnan(sb_figure_value(summary, i)))) {
      print_figure(summary, i);
    }
  }
}

// Time, displacement and force in a line.
static void print_stage(const SbSummary *summary, SbStage stage) {
  static const char *const names[] = {"time_s", "displacement_m", "force_N"};
  g_autofree char *label = g_strdup_printf("Stage %s", sb_stage_name(stage));
  g_autoptr(GString) text = g_string_new(NULL);
  for (size_t k = 0; k < G_N_ELEMENTS(names) && summary->stage[stage].reached; k++) {
    g_autofree char *path = g_strdup_printf("cycle.stages.%s.%s", sb_stage_name(stage), names[k]);
    const int i = sb_figure_find(path);
    g_autofree char *one =
        sb_figure_format(i, sb_figure_value(summary, i), sb_figure_error(summary, i));
    g_string_append_printf(text, "%s%s", k > 0 ? ", " : "", one);
  }
  sb_cli_line(label, text->len > 0 ? text->str : "not reached");
}

static void print_seal(const SbSummary *summary, int seal) {
  printf("%s seal, middle of B-C\n", seal == SB_OUTER ? "Outer" : "Inner");
  print_figures(summary, SB_GROUP_SEAL, seal, false);
  sb_cli_line("Leak path", sb_leak_state_name(summary->seal[seal].leak_state));
}

// The questions that have an answer.
static void print_verdict(const SbSummary *summary, const SbCaseVerdict *verdicts) {
  printf("Verdict\n");
  for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
    if (verdicts[kind].of.figure >= 0) {
      g_autofree char *text = sb_cli_verdict_text(summary, kind, &verdicts[kind]);
      sb_cli_line(sb_verdict_name((SbVerdictKind)kind), text);
    }
  }
}

static void print_rig(const SbSummary *summary) {
  print_figures(summary, SB_GROUP_RIG, SB_SEAL_COUNT, false);
  sb_cli_figure("Dynamic, measured in the thesis", SB_RIG_MEASURED_DYNAMIC, "1", "");
  sb_cli_figure("Dynamic, predicted there", SB_RIG_PREDICTED_DYNAMIC, "1", "");
  g_autofree char *peaks = g_strdup_printf("%zu", summary->rig.of.peaks);
  sb_cli_line("Peaks that follow", peaks);
}

static void print_solver(const SbSummary *summary, bool converged) {
  sb_cli_warnings(&summary->warnings);
  printf("Solver\n");
  sb_cli_line("Converged", converged ? "yes" : "NO");
  g_autofree char *frames = g_strdup_printf("%zu", summary->frames);
  sb_cli_line("Frames", frames);
  sb_cli_figure("Engine time", summary->wall_s, "s", "ms");
}

static void print_valve(const SbCliRunText *of, const SbSummary *summary) {
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    print_stage(summary, (SbStage)i);
  }
  print_figures(summary, SB_GROUP_PEOPLE, SB_SEAL_COUNT, false);
  if (summary->life.done > 0) {
    printf("Life of %ld actuations\n", summary->life.done);
    print_figures(summary, SB_GROUP_LIFE, SB_SEAL_COUNT, false);
  }
  print_seal(summary, SB_OUTER);
  print_seal(summary, SB_INNER);
  print_verdict(summary, of->verdict);
}

void sb_cli_run_table(const SbCliRunText *of) {
  const SbSummary *summary = sb_run_summary(of->run);
  printf("%s\n", of->title);
  bool rig = sb_model_is_rig(sb_run_model(of->run));
  print_figures(summary, SB_GROUP_CYCLE, SB_SEAL_COUNT, rig);
  if (rig) {
    print_rig(summary);
  } else {
    print_valve(of, summary);
  }
  print_solver(summary, of->converged);
  if (of->measured != NULL) {
    sb_cli_comparison(of->measured);
  }
  if (sb_cli_plots(of->plots)) {
    sb_cli_plot_run(of->run, of->measured, SB_CLI_PLOT_ROWS);
  }
  if (of->folder != NULL) {
    printf("Results are in %s\n", of->folder);
  }
}
