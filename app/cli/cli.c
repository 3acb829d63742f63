// Shared parts of the commands.
#include "app/cli/cli.h"

#include "app/base/figure_text.h"
#include "app/base/nearest.h"
#include "app/base/output.h"
#include "app/cli/wrap.h"
#include "app/document/shipped.h"
#include "app/export/run_tables.h"
#include "app/lazy/lazy.h"
#include "app/run/process.h"
#include "app/table/json.h"
#include "engine/valve/model/motion_kind.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// ---- Options and messages ----

// GLib names an unknown option; the one most like it among those of `groups` (NULL: an empty one).
static char *option_hint(const char *message, const GOptionEntry *const *groups, size_t count) {
  const char *start = strstr(message, "--");
  g_autofree char *word = g_strdup(start != NULL ? start + 2 : "");
  word[strcspn(word, "= ")] = '\0';
  SbNearest nearest = sb_nearest(word);
  for (size_t i = 0; i < count; i++) {
    for (const GOptionEntry *each = groups[i]; each != NULL && each->long_name != NULL; each++) {
      sb_nearest_try(&nearest, each->long_name);
    }
  }
  return nearest.best != NULL ? g_strdup_printf(", do you mean --%s?", nearest.best) : g_strdup("");
}

// How progress is shown.
typedef enum { PROGRESS_NONE, PROGRESS_BAR, PROGRESS_LINES, PROGRESS_JSON } ProgressStyle;

// What every command takes.
static struct {
  gboolean quiet, keep_existing;
  ProgressStyle progress;
  char *file; // that messages and progress name; NULL: none
} common;

void sb_cli_name_file(const char *path) {
  g_free(common.file);
  common.file = path != NULL ? sb_printable(path, strlen(path)) : NULL;
}

static bool take_common(const char *progress) {
  common.progress = isatty(STDERR_FILENO) != 0 ? PROGRESS_BAR : PROGRESS_NONE;
  if (g_strcmp0(progress, "lines") == 0) {
    common.progress = PROGRESS_LINES;
  } else if (g_strcmp0(progress, "json") == 0) {
    common.progress = PROGRESS_JSON;
  } else if (progress != NULL) {
    sb_cli_fail("--progress: there is no \"%s\" (allowed lines, json)", progress);
    return false;
  }
  sb_output_keep_existing(common.keep_existing);
  return true;
}

// Stores the values of options until the program ends: no command frees them, and leak checkers
// find them.
static void keep_texts(const GOptionEntry *entry) {
  static GPtrArray *kept;
  if (kept == NULL) {
    kept = g_ptr_array_new();
  }
  for (; entry != NULL && entry->long_name != NULL; entry++) {
    if (entry->arg == G_OPTION_ARG_FILENAME || entry->arg == G_OPTION_ARG_FILENAME_ARRAY) {
      g_ptr_array_add(kept, *(void **)entry->arg_data);
    }
  }
}

// Whether an option was given an empty value, which names no file and is no number: prints it.
static bool has_empty_value(const GOptionEntry *entry) {
  for (; entry != NULL && entry->long_name != NULL; entry++) {
    bool empty = false;
    if (entry->arg == G_OPTION_ARG_FILENAME) {
      const char *value = *(char **)entry->arg_data;
      empty = value != NULL && *value == '\0';
    } else if (entry->arg == G_OPTION_ARG_FILENAME_ARRAY) {
      for (char **value = *(char ***)entry->arg_data; value != NULL && *value != NULL; value++) {
        empty |= **value == '\0';
      }
    }
    if (empty && entry->short_name != 0) {
      sb_cli_fail("-%c, --%s: is empty (a value is needed: %s)", entry->short_name,
                  entry->long_name, entry->arg_description);
    } else if (empty) {
      sb_cli_fail("--%s: is empty (a value is needed: %s)", entry->long_name,
                  entry->arg_description);
    }
    if (empty) {
      return true;
    }
  }
  return false;
}

bool sb_cli_quiet(void) {
  return common.quiet;
}

// Removes a "--" before the operands. Returns whether their number is in [least, most]; false with
// a message.
static bool has_operands(int *argc, char **argv, int least, int most, const SbCommand *command) {
  // A "--" that separates operands stays in argv.
  if (*argc > 1 && strcmp(argv[1], "--") == 0) {
    memmove(argv + 1, argv + 2, (size_t)(*argc - 1) * sizeof *argv);
    (*argc)--;
  }
  const int operands = *argc - 1;
  if (operands < least || operands > most) {
    sb_cli_fail("%s: usage: sealbench %s %s",
                operands < least ? "too few operands" : "too many operands", command->name,
                command->usage);
  }
  return operands >= least && operands <= most;
}

bool sb_cli_parse(int *argc, char ***argv, const GOptionEntry *entries, int operands_min,
                  int operands_max, const char *notes) {
  const SbCommand *command = sb_commands();
  while (strcmp(command->name, (*argv)[0]) != 0) {
    command++;
  }
  g_autofree char *name = g_strdup_printf("sealbench %s", command->name);
  g_set_prgname(name);
  g_autoptr(GOptionContext) context = g_option_context_new(command->usage);
  g_option_context_set_summary(context, command->help);
  g_option_context_set_description(context, notes);
  // GLib's own --help prints by the locale, which the program never sets: "?" for "°".
  gboolean help = FALSE;
  const GOptionEntry own[] = {
      {"help", 'h', 0, G_OPTION_ARG_NONE, &help, "Shows this", NULL},
      {0},
  };
  g_option_context_set_help_enabled(context, FALSE);
  g_option_context_add_main_entries(context, own, NULL);
  char *progress = NULL;
  const GOptionEntry every[] = {
      {"quiet", 'q', 0, G_OPTION_ARG_NONE, &common.quiet,
       "No progress, no table, no notes: errors alone", NULL},
      {"progress", 0, 0, G_OPTION_ARG_FILENAME, &progress,
       "Progress on standard error where it is not a terminal", "lines|json"},
      {0},
  };
  const GOptionEntry writing[] = {
      {"no-overwrite", 0, 0, G_OPTION_ARG_NONE, &common.keep_existing, "Refuses to replace a file",
       NULL},
      {"overwrite", 0, G_OPTION_FLAG_REVERSE, G_OPTION_ARG_NONE, &common.keep_existing,
       "Replaces files (default)", NULL},
      {0},
  };
  if (entries != NULL) {
    g_option_context_add_main_entries(context, entries, NULL);
    g_option_context_add_main_entries(context, writing, NULL);
  }
  g_option_context_add_main_entries(context, every, NULL);
  g_autoptr(GError) error = NULL;
  if (!g_option_context_parse(context, argc, argv, &error)) {
    const bool unknown = g_error_matches(error, G_OPTION_ERROR, G_OPTION_ERROR_UNKNOWN_OPTION);
    const GOptionEntry *groups[] = {own, every, entries, entries != NULL ? writing : NULL};
    g_autofree char *hint =
        unknown ? option_hint(error->message, groups, G_N_ELEMENTS(groups)) : g_strdup("");
    sb_cli_fail("%s%s (see sealbench %s --help)", error->message, hint, command->name);
    return false;
  }
  keep_texts(entries);
  keep_texts(every);
  if (help) {
    g_autofree char *text = g_option_context_get_help(context, TRUE, NULL);
    exit(sb_cli_emit(text, "-"));
  }
  return has_operands(argc, *argv, operands_min, operands_max, command) &&
         !has_empty_value(entries) && !has_empty_value(every) && take_common(progress);
}

// One object on one line of standard error: the writer's line ends are all indentation.
static void print_json(SbJson *json) {
  g_autofree char *text = sb_json_finish(json);
  g_auto(GStrv) lines = g_strsplit(text, "\n", -1);
  for (char **line = lines; *line != NULL; line++) {
    g_strstrip(*line);
  }
  g_autofree char *whole = g_strjoinv("", lines);
  fprintf(stderr, "%s\n", whole);
}

static void put_file(SbJson *json) {
  if (common.file != NULL) {
    sb_json_string(json, "file", common.file);
  }
}

static void print_line(const char *text) {
  g_autofree char *printable = sb_printable(text, strlen(text));
  if (common.progress == PROGRESS_JSON) {
    SbJson json;
    sb_json_init(&json);
    sb_json_object(&json, NULL);
    sb_json_string(&json, "event", "message");
    put_file(&json);
    sb_json_string(&json, "text", printable);
    sb_json_object_end(&json);
    print_json(&json);
  } else {
    const char *file = common.file;
    g_autofree char *line = g_strdup_printf("sealbench: %s%s%s", file != NULL ? file : "",
                                            file != NULL ? ": " : "", printable);
    g_autofree char *wrapped = sb_wrap_line(line, sb_wrap_columns(STDERR_FILENO));
    fprintf(stderr, "%s\n", wrapped);
  }
}

void sb_cli_note(const char *format, ...) {
  if (common.progress != PROGRESS_NONE && !common.quiet) {
    va_list arguments;
    va_start(arguments, format);
    g_autofree char *text = g_strdup_vprintf(format, arguments);
    va_end(arguments);
    print_line(text);
  }
}

int sb_cli_fail(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *text = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  print_line(text);
  return SB_EXIT_INPUT;
}

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
  print_line(error->message);
  g_error_free(error);
  return code;
}

int sb_cli_status(SbStatus status, const SbReport *report) {
  if (status == SB_OK) {
    return SB_EXIT_DONE;
  }
  const char *text = report->text[0] != '\0' ? report->text : sb_status_text(status);
  const int id = sb_input_parameter(report->input);
  if (id >= 0) {
    g_autofree char *range = sb_param_range((SbParamId)id);
    g_autoptr(GPtrArray) issues = sb_issues_new();
    sb_issues_add(issues, NULL, 0, sb_input_key(report->input), range, "%s", text);
    sb_cli_issues(issues);
  } else {
    print_line(text);
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
    print_line(line);
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

SbStudyFile *sb_cli_open_study(const char *path, char **settings) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autofree char *file = sb_shipped_resolve(path, SB_SHIPPED_FOR_STUDY);
  SbStudyFile *study = sb_study_file_load(file, settings, issues);
  if (study == NULL) {
    sb_cli_add_file_hint(path, SB_SHIPPED_FOR_STUDY, issues);
  }
  sb_cli_issues(issues);
  return study;
}

char *sb_cli_full_path(const char *operand, unsigned kinds) {
  g_autofree char *file = sb_shipped_resolve(operand, kinds);
  return strcmp(file, "-") == 0 ? g_strdup(file) : g_canonicalize_filename(file, NULL);
}

SbDocument *sb_cli_open(SbModel **model, const char *path, char **settings) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autofree char *file = sb_shipped_resolve(path, SB_SHIPPED_FOR_RUN);
  SbDocument *document = sb_document_load(file, issues);
  if (document == NULL) {
    sb_cli_add_file_hint(path, SB_SHIPPED_FOR_RUN, issues);
  }
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
  const GPtrArray *notes = document != NULL && !sb_cli_quiet() ? sb_document_notes(document) : NULL;
  for (guint i = 0; notes != NULL && i < notes->len; i++) {
    g_autofree char *note = g_strconcat("note: ", notes->pdata[i], NULL);
    print_line(note);
  }
  return document;
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

// ---- Interrupts ----

static atomic_int interrupted;

static void on_interrupt(int number) {
  // Two signals may come to two threads at the same time: one of them is the second.
  if (atomic_exchange(&interrupted, 1) != 0 && !sb_output_is_committing()) {
    signal(number, SIG_DFL);
    raise(number);
  }
}

void sb_cli_catch_interrupts(void) {
  struct sigaction action = {.sa_handler = on_interrupt, .sa_flags = SA_RESTART};
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, NULL);
  sigaction(SIGTERM, &action, NULL);
  struct sigaction former;
  if (sigaction(SIGHUP, NULL, &former) == 0 && former.sa_handler != SIG_IGN) { // nohup
    sigaction(SIGHUP, &action, NULL);
  }
}

bool sb_cli_interrupted(void *unused) {
  return atomic_load(&interrupted) != 0;
}

// ---- Progress ----

void sb_progress_start(SbProgress *progress, const char *what) {
  *progress = (SbProgress){what, 0, 0, g_get_monotonic_time()};
}

static void print_progress(const SbProgress *progress, double fraction, double elapsed) {
  g_autofree char *what = g_strchomp(g_strdup(progress->what));
  SbJson json;
  sb_json_init(&json);
  sb_json_object(&json, NULL);
  sb_json_string(&json, "event", "progress");
  put_file(&json);
  sb_json_string(&json, "work", what[0] != '\0' ? what : "computing");
  sb_json_number(&json, "fraction", fraction);
  sb_json_number(&json, "elapsed_s", elapsed);
  sb_json_number(&json, "left_s", elapsed * (1 - fraction) / fraction);
  sb_json_object_end(&json);
  print_json(&json);
}

// One line that is narrower than the terminal, so that the next one replaces it: the bar and what
// is done, without what has no room.
static void print_bar(SbProgress *progress, int percent, double left_s) {
  enum { CELLS_MAX = 40, CELLS_LEAST = 8 };
  const int room = sb_wrap_columns(STDERR_FILENO) - 1;
  g_autofree char *done = g_strdup_printf("%3d %%", percent);
  g_autofree char *left = g_strdup_printf("%s  %.0f s left", done, left_s);
  g_autofree char *what = g_strconcat(progress->what, left, NULL);
  g_autofree char *file = g_strdup_printf("%s%s%s", common.file != NULL ? common.file : "",
                                          common.file != NULL ? ": " : "", what);
  const char *const texts[] = {file, what, left, done, ""};
  size_t i = 0;
  while (sb_wrap_width(texts[i]) > room) {
    i++;
  }
  const int cells = MIN(CELLS_MAX, room - sb_wrap_width(texts[i]) - 3);
  g_autoptr(GString) line = g_string_new(NULL);
  if (cells >= CELLS_LEAST) {
    g_string_append_c(line, '[');
    for (int k = 0; k < cells; k++) {
      g_string_append_c(line, k < cells * percent / 100 ? '#' : '.');
    }
    g_string_append(line, "] ");
  }
  g_string_append(line, texts[i]);
  const int width = sb_wrap_width(line->str);
  // Blanks replace what is left of a longer line before.
  fprintf(stderr, "\r%s%*s", line->str, MAX(MIN(progress->width, room) - width, 0), "");
  progress->width = MAX(width, 0);
}

void sb_progress_update(void *of, double fraction) {
  SbProgress *progress = of;
  if (common.quiet) {
    return;
  }
  fraction = CLAMP(fraction, 0, 1);
  int percent = (int)(100 * fraction);
  double elapsed = (double)(g_get_monotonic_time() - progress->start) / G_USEC_PER_SEC;
  const char *file = common.file != NULL ? common.file : "";
  const char *colon = common.file != NULL ? ": " : "";
  if (common.progress == PROGRESS_LINES) {
    for (; progress->last < percent / 10; progress->last++) {
      fprintf(stderr, "sealbench: %s%s%s%d %%\n", file, colon, progress->what,
              10 * (progress->last + 1));
    }
  }
  if (common.progress == PROGRESS_JSON && percent > progress->last) {
    progress->last = percent;
    print_progress(progress, fraction, elapsed);
  }
  // The first blink of a short run needs no bar.
  if (common.progress != PROGRESS_BAR || percent <= progress->last || elapsed < 0.3) {
    return;
  }
  progress->last = percent;
  print_bar(progress, percent, elapsed * (100 - percent) / percent);
}

void sb_progress_end(SbProgress *progress) {
  if (common.progress == PROGRESS_BAR && progress->width > 0) {
    fprintf(stderr, "\r%*s\r", progress->width, "");
  }
}
