// sealbench design: the best valve within bounds and limits.
#include "app/cli/cli.h"

#include "app/base/figure_text.h"
#include "app/base/format.h"
#include "app/export/design_results.h"
#include "app/export/study_results.h"

#include <math.h>

static const char design_result_name[] = "results.json";

static void add_parameters(SbTable *table, const SbStudyFile *study, const SbDesign *design) {
  for (guint k = 0; k < study->vary->len; k++) {
    const SbVary *vary = &g_array_index(study->vary, SbVary, k);
    const SbParam *param = sb_param(vary->id);
    if (vary->distribution.kind != SB_DISTRIBUTION_LEVELS) {
      sb_table_add(table,
                   SB_CELLS(sb_cell_text(param->key),
                            sb_cell_quantity(design->value[k], param->si, param->unit, 6),
                            sb_cell_text(design->bound_active[k] < 0   ? " at its lower bound"
                                         : design->bound_active[k] > 0 ? " at its upper bound"
                                                                       : NULL)));
    }
  }
}

// Returns the limits on a figure, each with the margin of the design. Owned by the caller.
static char *limits_text(const SbStudyFile *study, const SbDesign *design, int figure) {
  GString *out = g_string_new(NULL);
  for (size_t k = 0; k < study->limits.count; k++) {
    const SbLimit *limit = &study->limits.item[k];
    if (limit->figure == figure) {
      g_autofree char *bound = sb_limit_format(figure, limit->low, limit->high);
      const double margin = sb_design_margin(design, study, k);
      const int column = sb_study_column_of(study, figure);
      const double value = design->figure[column];
      // The limit is exact: the margin has the absolute error of the figure, and none of its own
      // below the figure's digits.
      const double error = fabs(design->error[column] * value / margin);
      g_autofree char *by = sb_figure_format(figure, fabs(margin), error);
      const bool none = fabs(margin) < pow(10, -sb_figure(figure)->digits) * fabs(value);
      g_string_append_printf(
          out, " %s: %s%s%s", bound,
          isnan(margin) ? "not known"
          : none        ? "at the limit"
                        : by,
          isnan(margin) || none ? ""
          : margin < 0          ? " beyond it"
                                : " within it",
          design->limit_active[2 * k] || design->limit_active[2 * k + 1] ? ", active" : "");
    }
  }
  return g_string_free(out, FALSE);
}

// Returns the design: its parameters, then its figures with their limits.
static SbTable *make_table(const SbStudyFile *study, const SbDesign *design) {
  static const SbTableColumn columns[] = {
      {.layout = "  %-38s"}, {.layout = " %-16s"}, {.layout = "%s"}};
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  add_parameters(table, study, design);
  for (guint i = 0; i < study->figures->len; i++) {
    const int figure = g_array_index(study->figures, int, i);
    sb_table_add(table, SB_CELLS(sb_cell_text(sb_figure(figure)->path),
                                 sb_cell_shown(
                                     sb_figure_format(figure, design->figure[i], design->error[i])),
                                 sb_cell_own(limits_text(study, design, figure))));
  }
  return table;
}

static void print_design_table(const SbStudyFile *study, const SbDesign *design) {
  printf("%s: %s %s\n", study->title, study->design.maximise ? "maximise" : "minimise",
         sb_figure(study->design.figure)->path);
  g_autoptr(SbTable) table = make_table(study, design);
  (void)sb_cli_table(table, NULL);
  if (design->checked) {
    const double of[] = {design->holds, design->interval[0], design->interval[1], design->by_form};
    char text[4][SB_FORMAT_MAX];
    for (size_t i = 0; i < G_N_ELEMENTS(of); i++) {
      sb_format_given(text[i], SB_QUANTITY_FRACTION, of[i]);
    }
    printf("  over the tolerances all limits are met with a probability of %s (" SB_INTERVAL_COVERS
           ", 95 %%: %s to %s; by FORM %s)\n",
           text[0], text[1], text[2], text[3]);
  }
  g_autofree char *bounds = sb_design_bounds(design, study),
                  *codes = sb_warning_codes(design->warnings, ", ");
  if (bounds != NULL) {
    printf("  on a bound of the search: %s; wider bounds may have a better design\n", bounds);
  }
  if (codes != NULL) {
    printf("  warnings of validity: %s\n", codes);
  }
  printf("  %zu of %zu starts end within all limits, %zu evaluations", design->starts_feasible,
         design->starts, design->evaluations);
  if (design->feasible) {
    printf(", optimality %.1e", design->optimality);
  }
  putchar('\n');
}

// What must be said besides: an exit code.
static int judge(const SbStudyFile *study, const SbDesign *design) {
  if (!design->found) {
    g_autofree char *text = sb_design_lacking_text(study, design);
    return MAX(sb_cli_fail("%s", text), SB_EXIT_NOT_CONVERGED);
  }
  if (!design->feasible) {
    const int least = sb_design_least_missed(design, study);
    const SbLimit *limit = &study->limits.item[MAX(least, 0)];
    g_autofree char *bound = sb_limit_format(limit->figure, limit->low, limit->high);
    const int column = sb_study_column_of(study, limit->figure);
    g_autofree char *value =
        sb_figure_format(limit->figure, design->figure[column], design->error[column]);
    if (least < 0) {
      (void)sb_cli_fail("nothing feasible was found that is as robust; this one meets the limits "
                        "themselves");
    } else {
      (void)sb_cli_fail("nothing feasible was found from %zu starts; the least violated limit is "
                        "%s %s: it is %s",
                        design->starts, sb_figure(limit->figure)->path, bound, value);
    }
  } else if (isfinite(study->design.robust) && !design->met) {
    char holds[SB_FORMAT_MAX], asked[SB_FORMAT_MAX];
    (void)sb_cli_fail("all limits are met with a probability of only %s, not %s",
                      sb_format_given(holds, SB_QUANTITY_FRACTION, design->holds),
                      sb_format_given(asked, SB_QUANTITY_FRACTION, study->design.robust));
  }
  if (!design->converged) {
    return MAX(sb_cli_fail("the search did not converge: %s",
                           design->feasible
                               ? "no step reduces the objective, although its gradient predicts one"
                               : "it ended at its evaluations"),
               SB_EXIT_NOT_CONVERGED);
  }
  return SB_EXIT_DONE;
}

static bool fill_design_folder(SbOutputFolder *folder, void *json, GError **error) {
  return sb_output_folder_add_text(folder, design_result_name, json, error);
}

static int solve_design(const SbCliStudyOptions *options, const SbStudyFile *study) {
  SbDesign design;
  SbReport report = {0};
  sb_cli_catch_interrupts();
  const SbStatus status =
      sb_design_search(&design, study, options->threads, sb_cli_interrupted, NULL, &report);
  int code = SB_EXIT_DONE;
  if (status == SB_ERROR_CANCELLED) {
    (void)sb_cli_fail("interrupted: there is no design yet");
    code = SB_EXIT_INTERRUPTED;
  } else if (status != SB_OK) {
    code = sb_cli_status(status, &report);
  } else {
    g_autofree char *json = sb_design_json(study, &design);
    code = options->folder != NULL
               ? sb_cli_write_folder(options->folder, "design", fill_design_folder, json)
               : SB_EXIT_DONE;
    if (code == SB_EXIT_DONE && options->json != NULL) {
      code = sb_cli_emit(json, options->json);
    } else if (code == SB_EXIT_DONE && !sb_cli_quiet()) {
      print_design_table(study, &design);
    }
    const int judged = judge(study, &design);
    code = MAX(code, judged);
  }
  sb_design_release(&design);
  return code;
}

static bool design_asks(const SbStudyFile *study, const char *path, GPtrArray *issues) {
  if (!study->design.asked) {
    sb_issues_add(issues, path, 0, "design", "objective = minimise FIGURE",
                  "is missing: the objective of the design");
  }
  return study->design.asked;
}

static void add_design_names(GPtrArray *names, const SbStudyFile *study) {
  g_ptr_array_add(names, g_strdup(design_result_name));
}

int sb_command_design(int argc, char **argv) {
  static const SbCliStudyWork work = {design_asks, add_design_names, solve_design};
  SbCliStudyOptions options;
  const bool good = sb_cli_study_parse(&options, &argc, &argv, "Folder for results.json");
  return good ? sb_cli_study_run(&options, argv[1], &work) : SB_EXIT_INPUT;
}
