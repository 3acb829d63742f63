// The full table of a run. See run_text.h.
#include "app/cli/run_text.h"

#include "app/base/device.h"
#include "app/cli/cli.h"
#include "app/export/run_tables.h"

// Prints a table behind a heading (NULL: none) and frees it.
static void print_run_table(const char *heading, SbTable *table) {
  if (heading != NULL) {
    printf("%s\n", heading);
  }
  (void)sb_cli_table(table, NULL);
  sb_table_free(table);
}

void sb_cli_run_table(const SbCliRunText *of) {
  const SbSummary *summary = sb_run_summary(of->run);
  printf("%s\n", of->title);
  print_run_table(NULL, sb_run_figures(of->run));
  if (sb_device(sb_run_model(of->run))->stem) {
    print_run_table("Stages", sb_run_stages(summary));
    print_run_table(NULL, sb_run_seals(summary));
    print_run_table("Verdict", sb_run_verdict(summary, of->verdict));
  }
  sb_cli_warnings(&summary->warnings);
  printf("Solver\n");
  sb_cli_line("Converged", of->converged ? "yes" : "NO");
  g_autofree char *frames = g_strdup_printf("%zu", summary->frames);
  sb_cli_line("Frames", frames);
  sb_cli_figure("Engine time", summary->wall_s, "s", "ms");
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
