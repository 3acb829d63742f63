// Measured loops on the command line: --measured, or a scene's own [data].
#include "app/cli/cli.h"

#include "app/document/shipped.h"
#include "app/export/measured_results.h"

#include <string.h>

static double drive_speed(const SbDocument *document) {
  return sb_data_drive_speed(sb_document_value(document, SB_P_DRIVE_KIND),
                             sb_document_value(document, SB_P_DRIVE_SPEED));
}

SbMeasured *sb_cli_measured(int *code, const SbDocument *document, const char *operand) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autofree char *path =
      operand != NULL ? sb_shipped_resolve(operand, SB_SHIPPED_FOR_IMPORT) : NULL;
  const SbData *data = NULL;
  g_autofree char *wanted = path != NULL ? g_canonicalize_filename(path, NULL) : NULL;
  *code = SB_EXIT_DONE;
  for (size_t i = 0; i < sb_document_data_count(document) && data == NULL; i++) {
    const SbData *one = sb_document_data(document, i);
    g_autofree char *its = g_canonicalize_filename(one->path, NULL);
    data = wanted == NULL || strcmp(wanted, its) == 0 ? one : NULL;
  }
  if (data == NULL && path == NULL) {
    return NULL;
  }
  SbData *bare = data == NULL ? sb_data_of_file(path) : NULL;
  SbMeasured *measured =
      sb_measured_read(data != NULL ? data : bare, drive_speed(document), NULL, 0, issues);
  sb_data_free(bare);
  sb_cli_issues(issues);
  *code = measured != NULL ? SB_EXIT_DONE : SB_EXIT_INPUT;
  return measured;
}

void sb_cli_recognised(const SbMeasured *measured) {
  printf("Measured: %s\n", measured->name);
  g_autofree char *text = sb_measured_text(measured);
  g_auto(GStrv) lines = g_strsplit(g_strchomp(text), "\n", -1);
  for (char **line = lines; *line != NULL; line++) {
    printf("  %s\n", *line);
  }
}

void sb_cli_check_data(const SbDocument *document, bool print, GPtrArray *issues) {
  for (size_t i = 0; i < sb_document_data_count(document); i++) {
    g_autoptr(SbMeasured) measured =
        sb_measured_read(sb_document_data(document, i), drive_speed(document), NULL, 0, issues);
    if (measured != NULL && print && !sb_cli_quiet()) {
      sb_cli_recognised(measured);
    }
  }
}

char *sb_cli_comparison_brief(const SbComparison *comparison) {
  g_autofree char *rms = sb_measured_difference(comparison->rms);
  g_autofree char *most = sb_measured_difference(comparison->most);
  return g_strdup_printf("Measured: %s, difference %s (root mean square), at most %s",
                         comparison->measured->name, rms, most);
}

void sb_cli_comparison(const SbComparison *comparison) {
  sb_cli_recognised(comparison->measured);
  g_autoptr(SbTable) stages = sb_measured_stages(comparison);
  sb_cli_table(stages, NULL);
  g_autofree char *rms = sb_measured_difference(comparison->rms);
  g_autofree char *mean = sb_measured_difference(comparison->mean);
  g_autofree char *most = sb_measured_difference(comparison->most);
  sb_cli_line("Difference, root mean square", rms);
  sb_cli_line("Difference, mean", mean);
  sb_cli_line("Difference, maximum", most);
  if (comparison->outside > 0) {
    printf("  %zu of %zu points are outside the run's displacements\n", comparison->outside,
           comparison->count);
  }
}
