// sealbench sensitivity: derivatives of a scene's figures by its parameters.
#include "app/base/figure_text.h"
#include "app/base/format.h"
#include "app/base/nearest.h"
#include "app/cli/cli.h"
#include "app/study/effects.h"

#include <math.h>
#include <string.h>

typedef struct {
  char *parameters, *figures, *json;
  char **settings;
  GArray *parameter, *figure; // SbParamId, int: asked for, else all
} SensitivityOptions;

static void take(GArray *list, int index) {
  for (guint i = 0; i < list->len; i++) {
    if (g_array_index(list, int, i) == index) {
      return;
    }
  }
  g_array_append_val(list, index);
}

static const char *parameter_name(int i) {
  return sb_param((SbParamId)i)->key;
}

static const char *figure_name(int i) {
  return sb_figure(i)->path;
}

// Finds the names of a list among `count` others; an exit code.
static int read_list(GArray *out, const char *option, const char *text, int (*find)(const char *),
                     const char *(*name)(int), int count) {
  g_auto(GStrv) words = g_strsplit(text, ",", -1);
  for (char **word = words; *word != NULL; word++) {
    const int index = find(g_strstrip(*word));
    if (index < 0) {
      SbNearest nearest = sb_nearest(*word);
      for (int i = 0; i < count; i++) {
        sb_nearest_try(&nearest, name(i));
      }
      g_autofree char *hint = sb_nearest_hint(&nearest);
      g_autofree char *shown = sb_printable(*word, strlen(*word));
      return sb_cli_fail("%s: there is no \"%s\"%s", option, shown, hint);
    }
    take(out, index);
  }
  return SB_EXIT_DONE;
}

static int read_sensitivity_options(SensitivityOptions *options) {
  options->parameter = g_array_new(FALSE, FALSE, sizeof(int));
  options->figure = g_array_new(FALSE, FALSE, sizeof(int));
  int code = SB_EXIT_DONE;
  if (options->parameters != NULL) {
    code = read_list(options->parameter, "--parameters", options->parameters, sb_param_find,
                     parameter_name, SB_PARAM_COUNT);
  }
  for (guint i = 0; i < options->parameter->len && code == SB_EXIT_DONE; i++) {
    const SbParamId id = (SbParamId)g_array_index(options->parameter, int, i);
    if (!sb_gradient_wants(id)) {
      code = sb_cli_fail("--parameters: %s is not a real number and has no derivative",
                         sb_param(id)->key);
    }
  }
  for (int i = 0; i < SB_PARAM_COUNT && options->parameters == NULL; i++) {
    if (sb_gradient_wants((SbParamId)i)) {
      take(options->parameter, i);
    }
  }
  if (options->figures != NULL && code == SB_EXIT_DONE) {
    code = read_list(options->figure, "--figures", options->figures, sb_figure_find, figure_name,
                     SB_FIGURE_COUNT);
  }
  // What tells how well something was solved is no figure of a valve.
  for (int i = 0; i < SB_FIGURE_COUNT && options->figures == NULL; i++) {
    if (!sb_figure_is_estimate(sb_figure(i))) {
      take(options->figure, i);
    }
  }
  return code;
}

// ---- What people read ----

// Adds a figure: its value, the parameters of the largest effect, and those without a derivative.
static void add_sensitivity_figure(SbTable *table, const SbGradient *gradient, size_t figure,
                                   const SbModel *model) {
  enum { ROWS = 12 };
  const int index = sb_gradient_figure(gradient, figure);
  const double value = sb_gradient_value(gradient, figure);
  const size_t parameters = sb_gradient_parameters(gradient);
  g_autofree SbEffect *effects = g_new(SbEffect, parameters + 1);
  const size_t count = sb_effects(effects, gradient, figure, model);
  g_autofree char *text = sb_figure_format(index, value, sb_gradient_value_error(gradient, figure));
  const char *reason = parameters > 0 ? sb_gradient_reason(gradient, figure, 0) : NULL;
  if (isnan(value)) {
    sb_table_note(table, "%s: - (%s)", sb_figure(index)->path,
                  reason != NULL ? reason : "not computed");
    return;
  }
  sb_table_note(table, "%s: %s", sb_figure(index)->path, text);
  for (size_t i = 0; i < count && i < ROWS; i++) {
    const SbEffect *effect = &effects[i];
    const SbParamId id = sb_gradient_parameter(gradient, effect->parameter);
    const double error = effect->error / fabs(effect->change);
    char digits[SB_FORMAT_MAX];
    sb_table_add(
        table,
        SB_CELLS(
            sb_cell_text(sb_param(id)->key),
            sb_cell_shown(sb_figure_format(index, effect->change, error)),
            sb_cell_own(effect->tolerance ? sb_param_format(id, effect->step) : g_strdup("5 %")),
            sb_cell_shown(g_strdup_printf("%s %%", sb_format_digits(digits, 100 * error, 1)))));
  }
  if (count > ROWS) {
    sb_table_note(table, "  and %zu parameters of less effect: --json", count - ROWS);
  }
  for (size_t i = 0, printed = 0; i < parameters; i++) {
    const char *why = sb_gradient_reason(gradient, figure, i);
    // A parameter without another value is one that the model does not have.
    if (why != NULL && !sb_gradient_is_fixed(gradient, figure, i) && printed++ < ROWS) {
      sb_table_note(table, "  %-34s no derivative: %s",
                    sb_param(sb_gradient_parameter(gradient, i))->key, why);
    }
  }
}

// Prints the figures of short tables, or all that were requested.
static void print_sensitivity_table(const SbGradient *gradient, const SbCliFile *file, bool asked) {
  static const SbTableColumn columns[] = {{.layout = "  %-34s"},
                                          {.layout = " %14s"},
                                          {.layout = " per %-10s"},
                                          {.layout = " error %s"}};
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (size_t i = 0; i < sb_gradient_figures(gradient); i++) {
    const bool brief = sb_figure(sb_gradient_figure(gradient, i))->brief;
    if (asked || (brief && !isnan(sb_gradient_value(gradient, i)))) {
      add_sensitivity_figure(table, gradient, i, file->model);
    }
  }
  printf("%s\n", sb_document_title(file->document));
  (void)sb_cli_table(table, NULL);
}

// ---- JSON ----

typedef enum { GRADIENTS, ERRORS, REASONS } Block;

static void write_cell(SbJson *json, const SbGradient *gradient, Block block, size_t f, size_t p) {
  const char *key = sb_param(sb_gradient_parameter(gradient, p))->key;
  if (block == REASONS) {
    sb_json_string(json, key, sb_gradient_reason(gradient, f, p));
  } else {
    sb_json_number(json, key,
                   block == ERRORS ? sb_gradient_error(gradient, f, p)
                                   : sb_gradient_slope(gradient, f, p));
  }
}

// Writes one object for each figure with one member for each parameter: the derivative, its
// absolute error, or the reason where there is no derivative. Figures without reasons are left out
// of the reasons.
static void write_cells(SbJson *json, const SbGradient *gradient, Block block) {
  static const char *const names[] = {"gradients", "errors", "reasons"};
  sb_json_object(json, names[block]);
  for (size_t f = 0; f < sb_gradient_figures(gradient); f++) {
    const char *path = sb_figure(sb_gradient_figure(gradient, f))->path;
    bool begun = block != REASONS;
    if (begun) {
      sb_json_object(json, path);
    }
    for (size_t p = 0; p < sb_gradient_parameters(gradient); p++) {
      if (block == REASONS && sb_gradient_reason(gradient, f, p) == NULL) {
        continue;
      }
      if (!begun) {
        sb_json_object(json, path);
        begun = true;
      }
      write_cell(json, gradient, block, f, p);
    }
    if (begun) {
      sb_json_object_end(json);
    }
  }
  sb_json_object_end(json);
}

// Returns the document of the command.
static char *make_json(const SbGradient *gradient, const char *scene) {
  SbJson json;
  sb_json_document(&json);
  sb_json_string(&json, "scene", scene);
  sb_json_object(&json, "figures");
  for (size_t f = 0; f < sb_gradient_figures(gradient); f++) {
    sb_json_number(&json, sb_figure(sb_gradient_figure(gradient, f))->path,
                   sb_gradient_value(gradient, f));
  }
  sb_json_object_end(&json);
  write_cells(&json, gradient, GRADIENTS);
  write_cells(&json, gradient, ERRORS);
  write_cells(&json, gradient, REASONS);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}

// ---- The command ----

static void on_progress(void *data, size_t done, size_t count) {
  sb_progress_update(data, count > 0 ? (double)done / (double)count : 1);
}

static int differentiate(SbCliFiles *files, const SbCliFile *file, void *data) {
  const SensitivityOptions *options = data;
  if (!sb_cli_has_memory(file->model)) {
    return SB_EXIT_IO;
  }
  SbProgress progress;
  SbReport report = {0};
  SbEvaluator *evaluator = NULL;
  SbGradient *gradient = NULL;
  const SbQuestion question = {.base = file->model,
                               .figure = (const int *)(const void *)options->figure->data,
                               .figure_count = options->figure->len,
                               .as_run = options->figures == NULL,
                               .cancelled = sb_cli_interrupted,
                               .data = &progress};
  sb_progress_start(&progress, "sensitivity ");
  sb_cli_catch_interrupts();
  SbStatus status = sb_evaluator_create(&evaluator, &report);
  if (status == SB_OK) {
    status = sb_gradient_create(&gradient, evaluator, &question,
                                (const SbParamId *)(const void *)options->parameter->data,
                                options->parameter->len, on_progress, &report);
  }
  sb_progress_end(&progress);
  if (gradient != NULL && options->json != NULL) {
    g_ptr_array_add(files->json, make_json(gradient, file->full));
  } else if (gradient != NULL && !sb_cli_quiet()) {
    sb_cli_files_head(files);
    print_sensitivity_table(gradient, file, options->figures != NULL);
  }
  sb_gradient_destroy(gradient);
  sb_evaluator_destroy(evaluator);
  return sb_cli_status(status, &report);
}

int sb_command_sensitivity(int argc, char **argv) {
  SensitivityOptions options = {0};
  const GOptionEntry entries[] = {
      {"parameters", 0, 0, G_OPTION_ARG_FILENAME, &options.parameters,
       "Parameters, with commas between them; default every real one (sealbench list params)",
       "KEY,.."},
      {"figures", 0, 0, G_OPTION_ARG_FILENAME, &options.figures,
       "Figures, with commas between them; default all (sealbench list figures)", "FIGURE,.."},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &options.settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &options.json, SB_CLI_JSON_HELP, "FILE|-"},
      {0},
  };
  if (!sb_cli_parse(&argc, &argv, entries, 1, SB_CLI_FILES_MAX, NULL)) {
    return SB_EXIT_INPUT;
  }
  int code = read_sensitivity_options(&options);
  const SbCliFilesWork work = {options.settings, NULL, options.json, NULL, differentiate, &options};
  code = code == SB_EXIT_DONE ? sb_cli_files_run(argc, argv, &work) : code;
  g_array_unref(options.parameter);
  g_array_unref(options.figure);
  return code;
}
