// Errors, inputs and results of commands; see cli.h.
#include "app/cli/cli.h"

#include "app/base/figure_text.h"
#include "app/base/nearest.h"
#include "app/base/output.h"
#include "app/base/reader.h"
#include "app/document/shipped.h"
#include "app/export/run_tables.h"
#include "app/lazy/lazy.h"
#include "app/run/process.h"
#include "app/table/json.h"
#include "engine/valve/model/motion_kind.h"

#include <math.h>
#include <string.h>

int sb_cli_unknown(const char *what, const char *word, const char *names, const char *see) {
  SbNearest nearest = sb_nearest(word);
  sb_nearest_try_list(&nearest, names);
  g_autofree char *hint = sb_nearest_hint(&nearest);
  if (see != NULL) {
    return sb_cli_fail("%s \"%s\"%s (%s)", what, word, hint, see);
  }
  g_auto(GStrv) each = g_strsplit(names, "|", 0);
  g_autofree char *allowed = g_strjoinv(", ", each);
  return sb_cli_fail("%s \"%s\"%s (allowed %s)", what, word, hint, allowed);
}

char *sb_cli_names(const char *(*name)(int), int count) {
  GString *names = g_string_new(NULL);
  for (int i = 0; i < count; i++) {
    g_string_append_printf(names, "%s%s", i > 0 ? "|" : "", name(i));
  }
  return g_string_free(names, FALSE);
}

int sb_cli_error(GError *error) {
  int code = SB_EXIT_IO;
  if (error->domain == SB_APP_ERROR) {
    code = error->code == SB_APP_ERROR_INPUT           ? SB_EXIT_INPUT
           : error->code == SB_APP_ERROR_RANGE         ? SB_EXIT_INPUT
           : error->code == SB_APP_ERROR_CANCELLED     ? SB_EXIT_INTERRUPTED
           : error->code == SB_APP_ERROR_NOT_CONVERGED ? SB_EXIT_NOT_CONVERGED
                                                       : SB_EXIT_IO;
  }
  (void)sb_cli_fail("%s", error->message);
  g_error_free(error);
  return code;
}

int sb_cli_status(SbStatus status, const SbReport *report) {
  if (status == SB_OK) {
    return SB_EXIT_DONE;
  }
  const char *text = report->text[0] != '\0' ? report->text : sb_status_text(status);
  if (sb_input_parameter(report->input) >= 0) {
    // The text states what would be valid: the catalogue's range holds for other values, too.
    g_autoptr(GPtrArray) issues = sb_issues_new();
    sb_issues_add(issues, NULL, 0, sb_input_key(report->input), NULL, "%s", text);
    sb_cli_issues(issues);
  } else {
    (void)sb_cli_fail("%s", text);
  }
  switch (status) {
  case SB_ERROR_NOT_CONVERGED:
    return SB_EXIT_NOT_CONVERGED;
  case SB_ERROR_CANCELLED:
    return SB_EXIT_INTERRUPTED;
  case SB_ERROR_MEMORY:
  case SB_ERROR_IO:
    return SB_EXIT_IO;
  default:
    return SB_EXIT_INPUT;
  }
}

void sb_cli_issues(const GPtrArray *issues) {
  for (guint i = 0; i < issues->len; i++) {
    g_autofree char *line = sb_issue_line(issues->pdata[i]);
    (void)sb_cli_fail("%s", line);
  }
}

bool sb_cli_quantity(double *out, const char *option, const char *text, bool required,
                     const char *si, const char *shown) {
  if (text == NULL) {
    if (required) {
      sb_cli_fail("%s is missing%s%s", option, *shown != '\0' ? ", a value in " : "", shown);
    }
    return !required;
  }
  GError *error = NULL;
  bool good = g_utf8_validate(text, -1, NULL);
  if (!good) {
    sb_cli_fail("%s: not UTF-8 text", option);
  } else if (!sb_quantity_parse(out, text, si, shown, &error)) {
    sb_cli_fail("%s: %s", option, error->message);
    g_error_free(error);
    good = false;
  }
  return good;
}

void sb_cli_add_file_hint(const char *path, unsigned kinds, GPtrArray *issues) {
  if (issues->len != 1 || strcmp(path, "-") == 0 || g_file_test(path, G_FILE_TEST_EXISTS)) {
    return;
  }
  g_autofree char *folder = g_path_get_dirname(path);
  g_autofree char *name = g_path_get_basename(path);
  g_autofree char *bare = g_strdup(name);
  char *dot = strrchr(bare, '.');
  if (dot != NULL) {
    *dot = '\0';
  }
  SbIssue *issue = issues->pdata[0];
  g_autofree char *text = issue->text;
  g_autofree char *shipped =
      strchr(path, G_DIR_SEPARATOR) == NULL ? sb_shipped_find(bare, kinds) : NULL;
  if (shipped != NULL) {
    issue->text =
        g_strdup_printf("%s; the shipped file is named without its ending: %s", text, bare);
    return;
  }
  SbNearest nearest = sb_nearest(name);
  g_autoptr(GDir) dir = g_dir_open(folder, 0, NULL);
  for (const char *each; dir != NULL && (each = g_dir_read_name(dir)) != NULL;) {
    if (sb_shipped_has_ending(each, kinds)) {
      sb_nearest_try(&nearest, g_intern_string(each));
    }
  }
  for (int kind = 0; strchr(path, G_DIR_SEPARATOR) == NULL && kind < SB_SHIPPED_KINDS; kind++) {
    g_autoptr(GPtrArray) files = sb_shipped_files((SbShippedKind)kind);
    for (guint i = 0; (kinds >> kind & 1) != 0 && i < files->len; i++) {
      g_autofree char *each = sb_shipped_name(files->pdata[i], (SbShippedKind)kind);
      sb_nearest_try(&nearest, g_intern_string(each));
    }
  }
  g_autofree char *hint = sb_nearest_hint(&nearest);
  issue->text = g_strconcat(text, hint, NULL);
}

static void print_notes(const GPtrArray *notes) {
  for (guint i = 0; i < notes->len && !sb_cli_quiet(); i++) {
    sb_cli_fail("note: %s", ((const SbIssue *)notes->pdata[i])->text);
  }
}

static void print_document_notes(const SbDocument *document) {
  g_autoptr(GPtrArray) kept = sb_issues_new();
  sb_document_kept(document, kept);
  print_notes(sb_document_notes(document));
  print_notes(kept);
}

// Prints all problems, or the notes of a study and of its scene.
static SbStudyFile *tell_study(SbStudyFile *study, const GPtrArray *issues) {
  sb_cli_issues(issues);
  if (study != NULL) {
    print_document_notes(study->scene);
    print_notes(study->notes);
  }
  return study;
}

SbStudyFile *sb_cli_open_study(const char *path, char **settings) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autofree char *file = sb_shipped_resolve(path, SB_SHIPPED_FOR_STUDY);
  SbStudyFile *study = sb_study_file_load(file, settings, issues);
  if (study == NULL) {
    sb_cli_add_file_hint(path, SB_SHIPPED_FOR_STUDY, issues);
  }
  return tell_study(study, issues);
}

char *sb_cli_full_path(const char *operand, unsigned kinds) {
  g_autofree char *file = sb_shipped_resolve(operand, kinds);
  return strcmp(file, "-") == 0 ? g_strdup(file) : g_canonicalize_filename(file, NULL);
}

// Applies the settings, compiles the document and prints all problems and notes. Frees it and
// returns NULL if there is any problem.
static SbDocument *compile(SbModel **model, SbDocument *document, char **settings,
                           GPtrArray *issues) {
  if (document != NULL) {
    sb_document_set_options(document, settings, issues);
  }
  if (document != NULL && issues->len == 0) {
    // What --set changed may not go together with a case.
    if (sb_document_compile(document, model, issues) && settings != NULL) {
      (void)sb_document_check_cases(document, issues);
    }
  }
  sb_cli_issues(issues);
  if (issues->len > 0) {
    sb_document_free(document);
    document = NULL;
  }
  if (document != NULL) {
    print_document_notes(document);
  }
  return document;
}

SbDocument *sb_cli_open(SbModel **model, const char *path, char **settings) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autofree char *file = sb_shipped_resolve(path, SB_SHIPPED_FOR_RUN);
  SbDocument *document = sb_document_load(file, issues);
  if (document == NULL) {
    sb_cli_add_file_hint(path, SB_SHIPPED_FOR_RUN, issues);
  }
  return compile(model, document, settings, issues);
}

SbDocument *sb_cli_open_either(SbStudyFile **study, SbModel **model, const char *path,
                               char **settings) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autofree char *file = sb_shipped_resolve(path, SB_SHIPPED_FOR_RUN | SB_SHIPPED_FOR_STUDY);
  size_t length = 0;
  g_autofree char *text = sb_document_load_text(&length, file, issues);
  bool grouped = false;
  g_autofree char *kind = text != NULL ? sb_reader_kind(&grouped, text, length) : NULL;
  *study = NULL;
  if (text == NULL) {
    sb_cli_add_file_hint(path, SB_SHIPPED_FOR_RUN | SB_SHIPPED_FOR_STUDY, issues);
  } else if (g_strcmp0(kind, "study") != 0) {
    return compile(model, sb_document_read(file, text, length, issues), settings, issues);
  } else {
    *study = sb_study_file_read(file, text, length, settings, issues);
  }
  (void)tell_study(*study, issues);
  return NULL;
}

bool sb_cli_has_memory(const SbModel *model) {
  // Opens the solvers' libraries before the work, whose time is reported (`wall_s`). If that fails,
  // their first call reports it.
  (void)sb_lazy_missing(&sb_lazy_algebra);
  // Closed forms and the quasi-static cycle solve nothing dense.
  bool dense = model == NULL;
  if (model != NULL) {
    int film = sb_model_number(model, SB_P_MODELS_FILM);
    dense = sb_motion_kind(model)->inertia ||
            sb_model_number(model, SB_P_MODELS_ASPERITIES) !=
                (int)sb_param(SB_P_MODELS_ASPERITIES)->fallback ||
            !sb_film_kind((SbFilmModel)film)->power_law;
  }
  if (dense && !sb_process_has_memory()) {
    sb_cli_fail(
        "there is not enough memory for the solvers: they need 140 MB of address space more "
        "(see ulimit -v)");
    return false;
  }
  return true;
}

// ---- Output ----

int sb_cli_check_outputs(const char *folder, char *const *names, const char *target) {
  GError *error = NULL;
  SbOutputCheck check = {0};
  bool good = true;
  // A file beside those of a folder finds it made.
  bool finds_folder = false;
  g_autofree char *in = g_path_get_dirname(target != NULL ? target : "");
  g_autofree char *beside = g_canonicalize_filename(in, NULL);
  for (; folder != NULL && *names != NULL && good; names++) {
    g_autofree char *path = g_build_filename(folder, *names, NULL);
    g_autofree char *of = g_path_get_dirname(path);
    g_autofree char *made = g_canonicalize_filename(of, NULL);
    g_autofree char *whole = g_canonicalize_filename(folder, NULL);
    finds_folder |= strcmp(made, beside) == 0 || strcmp(whole, beside) == 0;
    good = sb_output_check(&check, path, true, &error);
  }
  good = good && sb_output_check(&check, target, finds_folder, &error);
  sb_output_check_clear(&check);
  return good ? SB_EXIT_DONE : sb_cli_error(error);
}

int sb_cli_check_targets(const char *const *targets, size_t count) {
  GError *error = NULL;
  SbOutputCheck check = {0};
  bool good = true;
  for (size_t i = 0; i < count && good; i++) {
    good = sb_output_check(&check, targets[i], false, &error);
  }
  sb_output_check_clear(&check);
  return good ? SB_EXIT_DONE : sb_cli_error(error);
}

void sb_cli_kept(const char *folder, const GPtrArray *kept) {
  for (guint i = 0; i < kept->len; i++) {
    g_autofree char *path = g_build_filename(folder, kept->pdata[i], NULL);
    sb_cli_fail("%s: belongs to an earlier result and was changed since; it is not deleted", path);
  }
}

int sb_cli_write_folder(const char *path, const char *command, SbOutputFill fill, void *data) {
  GError *error = NULL;
  g_autoptr(GPtrArray) kept = g_ptr_array_new_with_free_func(g_free);
  const bool good = sb_output_folder_write(path, command, fill, data, kept, &error);
  sb_cli_kept(path, kept);
  return good ? SB_EXIT_DONE : sb_cli_error(error);
}

int sb_cli_emit(const char *json, const char *target) {
  GError *error = NULL;
  return sb_output_write(target, json, strlen(json), &error) ? SB_EXIT_DONE : sb_cli_error(error);
}

int sb_cli_table(const SbTable *table, const char *target) {
  if (target != NULL) {
    SbJson json;
    sb_json_init(&json);
    sb_table_json(&json, NULL, table);
    g_autofree char *text = sb_json_finish(&json);
    return sb_cli_emit(text, target);
  }
  g_autofree char *text = sb_table_text(table);
  fputs(text, stdout);
  return SB_EXIT_DONE;
}

void sb_cli_line(const char *label, const char *text) {
  enum { WIDTH = 36 };
  glong gap = WIDTH - g_utf8_strlen(label, -1);
  printf("  %s%*s %s\n", label, (int)MAX(gap, 0), "", text);
}

void sb_cli_figure(const char *label, double value, const char *si, const char *shown) {
  g_autofree char *text = sb_quantity_round(value, si, shown, 5);
  sb_cli_line(label, text);
}

// With the digits that the error estimate supports, where there is one.
static void put_row(const SbResultRow *row, const void *of) {
  const double value = sb_result_value(row, of);
  const double error = row->error > 0 ? *(const double *)((const char *)of + row->error) : 0;
  if (!isfinite(value) || !(error > 0)) {
    sb_cli_figure(row->label, value, row->si, row->shown);
    return;
  }
  char digits[SB_NUMBER_SIZE];
  sb_number_with_error(digits, sb_quantity_to_shown(value, row->si, row->shown), 5, error);
  g_autofree char *text = g_strconcat(digits, *row->shown != '\0' ? " " : "", row->shown, NULL);
  sb_cli_line(row->label, text);
}

void sb_cli_rows(const SbResultRow *row, const void *of) {
  for (; row->key != NULL; row++) {
    if (row->label != NULL) {
      put_row(row, of);
    }
  }
}

void sb_cli_warnings(const SbWarnings *warnings) {
  g_autoptr(SbTable) table = sb_run_warnings(warnings, NULL);
  fputs(warnings->count > 0 ? "Warnings\n" : "", stdout);
  (void)sb_cli_table(table, NULL);
}
