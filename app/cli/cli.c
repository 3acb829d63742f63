// Shared parts of the commands.
#include "app/cli/cli.h"

#include "app/base/nearest.h"
#include "app/base/output.h"
#include "app/cli/wrap.h"
#include "app/export/run_tables.h"
#include "app/table/json.h"

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

// Removes a "--" before the operands. Returns whether their number is in [least, most] and none is
// empty; false with a message.
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
  for (int i = 1; i < *argc; i++) {
    if (*argv[i] == '\0') {
      sb_cli_fail("operand %d: the name is empty: usage: sealbench %s %s", i, command->name,
                  command->usage);
      return false;
    }
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
