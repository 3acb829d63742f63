// sealbench store: verifies the rows of a store, saves the sound ones, or writes them as a table.
#include "app/base/output.h"
#include "app/cli/cli.h"
#include "app/export/study_results.h"

#include "app/study/store.h"

#include <math.h>
#include <string.h>

typedef struct {
  char *output, *csv, *json;
} StoreOptions;

// ---- check ----

typedef struct {
  SbJson *json; // of the array of damaged rows; NULL: lines for people
  const char *path;
  guint64 rows, damaged;
  guint64 other;   // of another engine
  guint64 unnamed; // whose list of names is damaged
} StoreCheck;

static bool see_row(void *data, const SbStoreRow *row) {
  StoreCheck *check = data;
  check->rows++;
  check->unnamed += row->damage == NULL && row->list == NULL;
  check->other += row->list != NULL && strcmp(row->list->engine, sb_engine_identity()->source) != 0;
  if (row->damage != NULL) {
    g_autofree char *name = sb_store_row_name(row);
    check->damaged++;
    if (check->json != NULL) {
      sb_json_object(check->json, NULL);
      sb_json_count(check->json, "row", row->number);
      sb_json_string(check->json, "name", name);
      sb_json_string(check->json, "damage", row->damage);
      sb_json_object_end(check->json);
    } else {
      (void)sb_cli_fail("%s: %s: %s", check->path, name, row->damage);
    }
  }
  return true;
}

static void print_store_check(const StoreCheck *check, int format) {
  printf("%s: %" G_GUINT64_FORMAT " rows, %" G_GUINT64_FORMAT " damaged", check->path, check->rows,
         check->damaged);
  if (check->other > 0 && format >= 2) {
    printf(", %" G_GUINT64_FORMAT " of another engine", check->other);
  }
  putchar('\n');
}

static int check_store(const StoreOptions *options, const char *path, SbStore *store) {
  SbJson json;
  StoreCheck check = {.path = path};
  const int format = sb_store_format(store);
  g_autoptr(GError) structure = NULL;
  if (options->json != NULL) {
    sb_json_document(&json);
    check.json = &json;
    sb_json_string(&json, "store", path);
    sb_json_count(&json, "format", (guint64)format);
    sb_json_array(&json, "damaged_rows");
  }
  const bool readable = sb_store_visit(store, see_row, &check, &structure);
  const bool sound = readable && check.damaged == 0 && check.unnamed == 0 && format >= 2;
  if (!readable) {
    (void)sb_cli_fail("%s", structure->message);
  }
  if (format < 2) {
    (void)sb_cli_fail(
        "%s: is a store of Sealbench 0.1, whose rows carry no checksums: none of its "
        "%" G_GUINT64_FORMAT
        " rows can be verified; sealbench store export writes the rows that can be read",
        path, check.rows);
  } else if (check.unnamed > 0) {
    (void)sb_cli_fail(
        "%s: the names of parameters and figures of %" G_GUINT64_FORMAT
        " sound rows are damaged; the study that computed them writes the names again",
        path, check.unnamed);
  } else if (!sound) {
    (void)sb_cli_fail("%s: sealbench store recover %s -o NEW.store saves the sound rows", path,
                      path);
  }
  int code = SB_EXIT_DONE;
  if (options->json != NULL) {
    sb_json_array_end(&json);
    sb_json_string(&json, "structure", structure != NULL ? structure->message : NULL);
    sb_json_count(&json, "rows", check.rows);
    sb_json_count(&json, "damaged", check.damaged);
    sb_json_count(&json, "unnamed", check.unnamed);
    sb_json_count(&json, "other_engine", check.other);
    sb_json_bool(&json, "sound", sound);
    sb_json_object_end(&json);
    g_autofree char *text = sb_json_finish(&json);
    code = sb_cli_emit(text, options->json);
  } else if (!sb_cli_quiet()) {
    print_store_check(&check, format);
  }
  return sound ? code : MAX(code, SB_EXIT_INPUT);
}

// ---- recover ----

static int recover_store(const StoreOptions *options, const char *path, SbStore *store) {
  GError *error = NULL;
  guint64 saved = 0;
  if (options->output == NULL) {
    return sb_cli_fail("store recover: -o is missing: the new store for the sound rows");
  }
  if (g_file_test(options->output, G_FILE_TEST_EXISTS)) {
    return sb_cli_fail("-o: %s exists: a recovered store is a new file", options->output);
  }
  SbStoreHealth health;
  sb_store_health(&health, store);
  const bool good = sb_store_recover(&saved, store, options->output, &error);
  if (good && !sb_cli_quiet()) {
    printf("%s: %" G_GUINT64_FORMAT " sound rows of %s%s\n", options->output, saved, path,
           health.structure != NULL ? ", whose structure is damaged" : "");
  }
  if (good && health.damaged > 0) {
    (void)sb_cli_fail("%s: %" G_GUINT64_FORMAT " damaged rows are left out; the first: %s", path,
                      health.damaged, health.first);
  }
  sb_store_health_release(&health);
  return good ? SB_EXIT_DONE : sb_cli_error(error);
}

// ---- export ----

// The columns: the names of all lists, each once, in the order in which rows use them.
typedef struct {
  GPtrArray *parameter, *figure; // borrowed names
  FILE *stream;
  SbJson *json;
  guint64 damaged;
} Export;

static void add_store_names(GPtrArray *columns, char **names) {
  for (; *names != NULL; names++) {
    if (!g_ptr_array_find_with_equal_func(columns, *names, g_str_equal, NULL)) {
      g_ptr_array_add(columns, g_strdup(*names));
    }
  }
}

static bool see_columns(void *data, const SbStoreRow *row) {
  Export *out = data;
  if (row->list != NULL && row->damage == NULL) {
    add_store_names(out->parameter, row->list->parameter);
    add_store_names(out->figure, row->list->figure);
  }
  return true;
}

// A value of a row by its column's name; NaN where the row has none.
static double value_of(char **names, const double *value, size_t count, const char *name) {
  for (size_t i = 0; i < count && names[i] != NULL; i++) {
    if (strcmp(names[i], name) == 0) {
      return value[i];
    }
  }
  return NAN;
}

// The parameter of a column as study tables print it; NULL: this program knows none of that name.
static const SbParam *param_of(const Export *out, const GPtrArray *columns, const char *name) {
  const int id = columns == out->parameter ? sb_param_find(name) : -1;
  return id >= 0 ? sb_param((SbParamId)id) : NULL;
}

static void put_values(const Export *out, const GPtrArray *columns, char **names,
                       const double *value, size_t count) {
  for (guint i = 0; i < columns->len; i++) {
    char choice[64];
    const char *name = columns->pdata[i];
    const double of = value_of(names, value, count, name);
    const SbTableCell cell = sb_study_cell(choice, param_of(out, columns, name), of);
    if (out->json != NULL) {
      sb_json_cell(out->json, name, &cell);
    } else {
      sb_csv_put(out->stream, cell);
    }
  }
}

static bool put_csv_row(void *data, const SbStoreRow *row) {
  Export *out = data;
  out->damaged += row->damage != NULL;
  if (row->damage == NULL && row->list != NULL) {
    fprintf(out->stream, "%" G_GUINT64_FORMAT, row->number);
    put_values(out, out->parameter, row->list->parameter, row->parameter, row->parameters);
    put_values(out, out->figure, row->list->figure, row->figure, row->figures);
    fprintf(out->stream, ",%s", sb_study_status_name((uint8_t)row->status));
    sb_csv_put(out->stream, sb_cell_text(row->reason));
    fprintf(out->stream, ",%s,%s\n", row->list->engine, row->warnings != NULL ? row->warnings : "");
  }
  return true;
}

static bool put_json_row(void *data, const SbStoreRow *row) {
  Export *out = data;
  SbJson *json = out->json;
  out->damaged += row->damage != NULL;
  if (row->damage == NULL && row->list != NULL) {
    sb_json_object(json, NULL);
    sb_json_count(json, "row", row->number);
    sb_json_object(json, "parameters");
    put_values(out, out->parameter, row->list->parameter, row->parameter, row->parameters);
    sb_json_object_end(json);
    sb_json_object(json, "figures");
    put_values(out, out->figure, row->list->figure, row->figure, row->figures);
    sb_json_object_end(json);
    sb_json_string(json, "status", sb_study_status_name((uint8_t)row->status));
    sb_json_string(json, "reason", row->reason);
    sb_json_string(json, "source", row->list->engine[0] != '\0' ? row->list->engine : NULL);
    sb_json_string(json, "warnings", row->warnings);
    sb_json_object_end(json);
  }
  return true;
}

static bool put_csv(Export *out, SbStore *store, GError **error) {
  fputs("row", out->stream);
  for (guint i = 0; i < out->parameter->len + out->figure->len; i++) {
    const bool parameter = i < out->parameter->len;
    const char *name =
        parameter ? out->parameter->pdata[i] : out->figure->pdata[i - out->parameter->len];
    const SbParam *param = parameter ? param_of(out, out->parameter, name) : NULL;
    g_autofree char *heading =
        param != NULL ? g_strdup_printf("%s [%s]", name, param->si) : g_strdup(name);
    sb_csv_put(out->stream, sb_cell_text(heading));
  }
  fputs(",status,reason,engine,warnings\n", out->stream);
  return sb_store_visit(store, put_csv_row, out, error);
}

static bool write_csv(Export *out, const char *target, SbStore *store, GError **error) {
  SbOutput file = {0};
  if (!sb_output_begin(&file, target, error)) {
    return false;
  }
  out->stream = file.stream;
  g_autoptr(GError) cut = NULL;
  const bool whole = put_csv(out, store, &cut);
  if (!whole) {
    (void)sb_cli_fail("%s", cut->message);
  }
  return sb_output_commit(&file, error);
}

static int write_json(Export *out, const char *target, const char *path, SbStore *store) {
  SbJson json;
  g_autoptr(GError) cut = NULL;
  sb_json_document(&json);
  sb_json_string(&json, "store", path);
  sb_json_array(&json, "rows");
  out->json = &json;
  const bool whole = sb_store_visit(store, put_json_row, out, &cut);
  if (!whole) {
    (void)sb_cli_fail("%s", cut->message);
  }
  sb_json_array_end(&json);
  sb_json_object_end(&json);
  g_autofree char *text = sb_json_finish(&json);
  return sb_cli_emit(text, target);
}

static int export_store(const StoreOptions *options, const char *path, SbStore *store) {
  const bool named_json = options->output != NULL && sb_output_ends_in(options->output, ".json");
  const char *json = options->json != NULL ? options->json : named_json ? options->output : NULL;
  const char *csv = options->csv != NULL                     ? options->csv
                    : options->output != NULL && !named_json ? options->output
                    : json == NULL                           ? "-"
                                                             : NULL;
  g_autoptr(GPtrArray) parameter = g_ptr_array_new_with_free_func(g_free);
  g_autoptr(GPtrArray) figure = g_ptr_array_new_with_free_func(g_free);
  Export out = {.parameter = parameter, .figure = figure};
  GError *error = NULL;
  int code = sb_cli_check_outputs(NULL, NULL, csv);
  code = code == SB_EXIT_DONE ? sb_cli_check_outputs(NULL, NULL, json) : code;
  if (code != SB_EXIT_DONE) {
    return code;
  }
  // Rows behind damage of the structure are reported by the second visit.
  (void)sb_store_visit(store, see_columns, &out, NULL);
  if (csv != NULL && !write_csv(&out, csv, store, &error)) {
    return sb_cli_error(error);
  }
  out.damaged = 0;
  code = json != NULL ? write_json(&out, json, path, store) : SB_EXIT_DONE;
  SbStoreHealth health;
  sb_store_health(&health, store);
  if (health.damaged > 0) {
    (void)sb_cli_fail("%s: %" G_GUINT64_FORMAT " damaged rows are left out; the first: %s", path,
                      health.damaged, health.first);
  }
  if (health.unnamed > 0) {
    (void)sb_cli_fail("%s: %" G_GUINT64_FORMAT " rows are left out, whose names of parameters and "
                      "figures are damaged",
                      path, health.unnamed);
  }
  if (sb_store_format(store) < 2) {
    (void)sb_cli_fail("%s: is a store of Sealbench 0.1: its rows carry no checksums and are not "
                      "verified",
                      path);
  }
  sb_store_health_release(&health);
  return code;
}

// ---- The command ----

static const struct {
  const char *name;
  int (*main)(const StoreOptions *options, const char *path, SbStore *store);
} actions[] = {{"check", check_store}, {"recover", recover_store}, {"export", export_store}};

static int run_action(const StoreOptions *options, const char *name, const char *path) {
  size_t at = 0;
  while (at < G_N_ELEMENTS(actions) && strcmp(actions[at].name, name) != 0) {
    at++;
  }
  if (at == G_N_ELEMENTS(actions)) {
    return sb_cli_unknown("store: there is no action", name, "check|recover|export", NULL);
  }
  if (!g_file_test(path, G_FILE_TEST_IS_REGULAR)) {
    return sb_cli_fail("%s: is not a file", path);
  }
  GError *error = NULL;
  SbStore *store = sb_store_open_rows(path, &error);
  if (store == NULL) {
    return sb_cli_error(error);
  }
  const int code = actions[at].main(options, path, store);
  sb_store_discard(store);
  return code;
}

int sb_command_store(int argc, char **argv) {
  StoreOptions options = {0};
  const GOptionEntry entries[] = {
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &options.output,
       "recover: the new store; export: a file that ends in .csv or .json", "FILE"},
      {"csv", 0, 0, G_OPTION_ARG_FILENAME, &options.csv,
       "export: a row for each answer, to a file or -", "FILE|-"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &options.json, "check, export: JSON to a file or -",
       "FILE|-"},
      {0},
  };
  return sb_cli_parse(&argc, &argv, entries, 2, 2, NULL) ? run_action(&options, argv[1], argv[2])
                                                         : SB_EXIT_INPUT;
}
