// sealbench list, plan, asperity and open.
#include "app/base/beside.h"
#include "app/base/figure_text.h"
#include "app/cli/cli.h"
#include "app/document/rubber_sheet.h"
#include "app/document/shipped.h"
#include "app/export/results.h"
#include "app/run/cases.h"

#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/fluid/fluid.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

// ---- list ----

static void list_params(void) {
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParam *param = sb_param((SbParamId)i);
    if (param->parent >= 0) {
      continue;
    }
    g_autofree char *value = sb_param_format((SbParamId)i, param->fallback);
    g_autofree char *range = sb_param_range((SbParamId)i);
    printf("%-32s %s\n", param->key, param->help);
    printf("    %s (allowed %s; %s: %s)\n", *value != '\0' ? value : "none", range, param->tag,
           param->source);
    SbParamDefault derived;
    int choice;
    for (int k = 0; sb_params_brought(&derived, &choice, (SbParamId)i, k); k++) {
      const SbParam *giver = sb_param((SbParamId)derived.giver);
      g_autofree char *other = sb_param_format((SbParamId)i, derived.value);
      char name[64];
      sb_param_choice_name(giver, choice, name, sizeof name);
      printf("    %s with %s = %s (%s: %s)\n", other, giver->key, name, derived.tag,
             derived.source);
    }
  }
  for (const SbTextKey *text = sb_document_text_keys(); text->key != NULL; text++) {
    printf("%-32s %s\n    none (a text)\n", text->key, text->help);
  }
  printf("seal.outer.* and seal.inner.* override seal.* for one seal.\n");
}

static void list_models(void) {
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParam *param = sb_param((SbParamId)i);
    if (sb_param_group((SbParamId)i) == SB_PARAMS_MODELS) {
      g_autofree char *range = sb_param_range((SbParamId)i);
      printf("%-16s %s\n", param->key, range);
    }
  }
  printf("Of the command film (--model)\n");
  for (int i = 0; i < SB_FILM_MODEL_COUNT; i++) {
    printf("%-16s %s\n", sb_film_kind((SbFilmModel)i)->name, sb_film_kind((SbFilmModel)i)->help);
  }
}

// ---- Files that ship, and the user's own rubbers ----

// Returns the files of a kind, in order.
static SbTable *list_files(SbShippedKind kind) {
  static const SbTableColumn columns[] = {
      {.key = "name", .layout = "%-20s"}, {.key = "title", .layout = " %s"}, {.key = "file"}};
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  g_autoptr(GPtrArray) paths = sb_shipped_files(kind);
  if (kind == SB_SHIPPED_RUBBERS) {
    // Names of rubbers can also be files in the user's folder.
    g_auto(GStrv) names = sb_rubber_sheet_names(NULL);
    g_ptr_array_set_size(paths, 0);
    for (char **name = names; *name != NULL; name++) {
      g_ptr_array_add(paths, sb_rubber_sheet_find(*name, NULL));
    }
  }
  for (guint i = 0; i < paths->len; i++) {
    g_autofree char *path = g_canonicalize_filename(paths->pdata[i], NULL);
    g_autofree char *name = sb_shipped_name(path, kind);
    g_autofree char *title = sb_shipped_title(path);
    g_autofree char *shown = sb_printable(title, strlen(title));
    sb_table_add(table,
                 SB_CELLS(sb_cell_text(name), sb_cell_text_as(title, shown), sb_cell_text(path)));
  }
  return table;
}

int sb_command_list(int argc, char **argv) {
  char *target = NULL;
  const GOptionEntry entries[] = {
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &target, "JSON to a file or -", "FILE|-"},
      {0},
  };
  if (!sb_cli_parse(
          &argc, &argv, entries, 1, 1,
          "JSON numbers are SI in \"unit\"; tables and the window use \"display_unit\".")) {
    return SB_EXIT_INPUT;
  }
  static const struct {
    const char *name;
    SbTable *(*table)(void);
    char *(*json)(void); // NULL: that of the table
    void (*print)(void); // NULL: the text of the table
  } lists[] = {{"params", NULL, sb_results_params, list_params},
               {"figures", sb_list_figures, NULL, NULL},
               {"models", sb_list_models, NULL, list_models},
               {"views", sb_list_views, NULL, NULL},
               {"fluids", sb_list_fluids, NULL, NULL}};
  size_t at = 0;
  int kind = 0;
  while (at < G_N_ELEMENTS(lists) && strcmp(argv[1], lists[at].name) != 0) {
    at++;
  }
  while (kind < SB_SHIPPED_KINDS &&
         strcmp(argv[1], sb_shipped_kind_name((SbShippedKind)kind)) != 0) {
    kind++;
  }
  if (at == G_N_ELEMENTS(lists) && kind == SB_SHIPPED_KINDS) {
    return sb_cli_unknown(
        "there is no list", argv[1],
        "params|figures|models|views|fluids|scenes|studies|valves|rubbers|examples", NULL);
  }
  g_autoptr(SbTable) table = kind < SB_SHIPPED_KINDS   ? list_files((SbShippedKind)kind)
                             : lists[at].table != NULL ? lists[at].table()
                                                       : NULL;
  if (table != NULL && (target != NULL || at == G_N_ELEMENTS(lists) || lists[at].print == NULL)) {
    return sb_cli_table(table, target);
  }
  if (target == NULL) {
    lists[at].print();
    return SB_EXIT_DONE;
  }
  g_autofree char *json = lists[at].json();
  return sb_cli_emit(json, target);
}

// ---- plan ----

// "below 1 ms", "15 ms", "12 s".
static void cost_text(char *text, size_t size, double seconds) {
  char digits[SB_NUMBER_SIZE];
  if (seconds < 1e-3) {
    g_strlcpy(text, "below 1 ms", size);
  } else if (seconds < 1) {
    g_snprintf(text, size, "%s ms", sb_number_round(digits, 1e3 * seconds, 2));
  } else {
    g_snprintf(text, size, "%s s", sb_number_round(digits, seconds, 2));
  }
}

static void print_plan(const SbPlan *plan) {
  char cost[40];
  printf("Computed\n");
  for (size_t i = 0; i < plan->field_count; i++) {
    const SbPlanItem *item = &plan->field[i];
    char error[SB_NUMBER_SIZE];
    cost_text(cost, sizeof cost, item->cost_s);
    printf("  %s by %s: %s (%s", item->name, item->model, item->reason, cost);
    if (item->error > 0) {
      printf(", error about %s %%", sb_number_round(error, 100 * item->error, 2));
    }
    printf(")\n");
  }
  cost_text(cost, sizeof cost, sb_plan_cost(plan));
  printf("  together %s on one core, within a factor of two or three\n", cost);
  printf("Skipped\n");
  for (size_t i = 0; i < plan->skipped_count; i++) {
    printf("  %s: %s\n", plan->skipped[i].name, plan->skipped[i].reason);
  }
}

static int plan_file(SbCliFiles *files, const SbCliFile *file, void *target) {
  SbPlan plan;
  sb_plan_make(&plan, file->model);
  sb_cases_plan(&plan, file->document);
  if (target != NULL) {
    g_ptr_array_add(files->json, sb_results_plan(&plan, file->full));
  } else if (!sb_cli_quiet()) {
    sb_cli_files_head(files);
    print_plan(&plan);
  }
  return SB_EXIT_DONE;
}

int sb_command_plan(int argc, char **argv) {
  char *target = NULL, **settings = NULL;
  const GOptionEntry entries[] = {
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &target, SB_CLI_JSON_HELP, "FILE|-"},
      {0},
  };
  const bool good = sb_cli_parse(&argc, &argv, entries, 1, SB_CLI_FILES_MAX, NULL);
  const SbCliFilesWork work = {settings, NULL, target, NULL, plan_file, target};
  return good ? sb_cli_files_run(argc, argv, &work) : SB_EXIT_INPUT;
}

// ---- asperity ----

static char *asperity_json(const SbGtIntegrals *integrals) {
  SbJson json;
  sb_json_document(&json);
  sb_json_number(&json, "lambda", integrals->lambda);
  sb_json_number(&json, "F2", integrals->F2);
  sb_json_number(&json, "F5_2", integrals->F5_2);
  sb_json_bool(&json, "underflow", integrals->underflow);
  sb_json_array(&json, "warnings");
  if (integrals->underflow) {
    sb_json_object(&json, NULL);
    sb_json_string(&json, "code", "asperity-underflow");
    sb_json_string(&json, "text",
                   "the surfaces are so far apart that the integrals underflow to 0");
    sb_json_string(&json, "parameter", NULL);
    sb_json_object_end(&json);
  }
  sb_json_array_end(&json);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}

int sb_command_asperity(int argc, char **argv) {
  char *target = NULL;
  char *lambda_text = NULL;
  const GOptionEntry entries[] = {
      {"lambda", 0, 0, G_OPTION_ARG_FILENAME, &lambda_text, "Film over height deviation", "L"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &target, "JSON to a file or -", "FILE|-"},
      {0},
  };
  int code = SB_EXIT_INPUT;
  double lambda = 0;
  if (sb_cli_parse(&argc, &argv, entries, 0, 0, NULL) &&
      sb_cli_quantity(&lambda, "--lambda", lambda_text, true, "1", "")) {
    SbGtIntegrals integrals;
    SbReport report = {0};
    SbStatus status = sb_gt_integrals(&integrals, lambda, &report);
    code = sb_cli_status(status, &report);
    if (status == SB_OK && target != NULL) {
      g_autofree char *json = asperity_json(&integrals);
      code = sb_cli_emit(json, target);
    } else if (status == SB_OK && !sb_cli_quiet()) {
      char digits[SB_NUMBER_SIZE];
      sb_cli_line("lambda", sb_number_format(digits, integrals.lambda));
      sb_cli_line("F2", sb_number_format(digits, integrals.F2));
      sb_cli_line("F5/2", sb_number_format(digits, integrals.F5_2));
      if (integrals.underflow) {
        printf("Warnings\n  asperity-underflow: the integrals underflow to 0\n");
      }
    }
  }
  return code;
}

// ---- open ----

int sb_command_open(int argc, char **argv) {
  if (!sb_cli_parse(&argc, &argv, NULL, 0, 1, NULL)) {
    return SB_EXIT_INPUT;
  }
  g_autofree char *file = argc > 1 ? sb_shipped_resolve(argv[1], SB_SHIPPED_FOR_RUN) : NULL;
  if (file != NULL && strstr(file, "://") == NULL && access(file, R_OK) != 0) {
    return sb_cli_fail("%s: %s", file, g_strerror(errno));
  }
  // Beside this program (installed, or in the build folder), else on the path.
  static const char *const places[] = {".", "ui", "../ui", NULL};
  char *arguments[] = {(char *)"sealbench-gtk", file, NULL};
  g_autofree char *path = sb_beside_program(places, arguments[0]);
  if (path != NULL) {
    execv(path, arguments);
  }
  execvp("sealbench-gtk", arguments);
  sb_cli_fail("the window's program sealbench-gtk cannot be started: %s%s", g_strerror(errno),
              SB_GUI_BUILT ? "" : " (this build of Sealbench has no window: Meson's option `gui`)");
  return SB_EXIT_IO;
}
