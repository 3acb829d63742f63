// The summary of a run. See run_text.h.
#include "app/cli/run_text.h"

#include "app/base/device.h"
#include "app/base/figure_text.h"
#include "app/cli/cli.h"
#include "app/cli/wrap.h"
#include "app/export/run_tables.h"
#include "app/session/verdict_text.h"

#include <limits.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

enum {
  SUMMARY_COLUMNS = 80,
  LOOP_LINES_MIN = 5, // of the loop: a blank line, the heading, three of dots
  LOOP_LINES_MAX = 14,
  VERDICT_WIDTH = 8,
  VALUE_WIDTH = 12
};

// The key figures, in the order in which they are printed.
static const char *const key_figures[] = {
    "cycle.force_breakaway_N",    "cycle.force_press_N", "cycle.force_return_margin_N",
    "seals.outer.load_N",         "seals.inner.load_N",  "seals.outer.pressure_peak_Pa",
    "cycle.leakage_per_cycle_m3", "cycle.energy_loss_J",
};

// ---- Items: lines that may be wrapped ----

// Appends "  label   text" with the text in a column of its own.
static void add_summary_item(GPtrArray *items, const char *label, int width, const char *text) {
  g_ptr_array_add(
      items, g_strdup_printf("  %s%*s  %s", label, MAX(width - sb_wrap_width(label), 0), "", text));
}

// Breaks words that are longer than a line. Owned by the caller.
static char *break_words(const char *text, int columns) {
  GString *out = g_string_new(NULL);
  int column = 0;
  for (const char *at = text; *at != '\0'; at = g_utf8_next_char(at)) {
    g_autofree char *one = g_strndup(at, (gsize)(g_utf8_next_char(at) - at));
    const int width = *at == '\n' ? 0 : sb_wrap_width(one);
    if (column + width > columns) {
      g_string_append_c(out, '\n');
      column = 0;
    }
    g_string_append(out, one);
    column = *at == '\n' ? 0 : column + width;
  }
  return g_string_free(out, FALSE);
}

// The item wrapped into lines of at most `columns`; with more than `most` lines the last one ends
// with an ellipsis. Owned by the caller (g_strfreev).
static char **item_lines(const char *item, int columns, int most) {
  g_autofree char *wrapped = sb_wrap_line(item, columns);
  g_autofree char *broken = break_words(wrapped, columns);
  char **lines = g_strsplit(broken, "\n", -1);
  if ((int)g_strv_length(lines) > most) {
    g_autofree char *last = lines[most - 1];
    char *end = last + strlen(last);
    do {
      end = g_utf8_find_prev_char(last, end);
      *end = '\0';
    } while (sb_wrap_width(last) >= columns);
    lines[most - 1] = g_strconcat(g_strchomp(last), "…", NULL);
    for (char **rest = lines + most; *rest != NULL; rest++) {
      g_clear_pointer(rest, g_free);
    }
  }
  return lines;
}

static int count_lines(const GPtrArray *items, int columns, int most) {
  int count = 0;
  for (guint i = 0; i < items->len; i++) {
    g_auto(GStrv) lines = item_lines(items->pdata[i], columns, most);
    count += (int)g_strv_length(lines);
  }
  return count;
}

// Prints the items in at most `room` lines and returns the number of lines. Each item has at least
// one line; the longest ones are shortened first.
static int print_items(const GPtrArray *items, int columns, int room) {
  int most = MAX(count_lines(items, columns, INT_MAX), 1);
  while (most > 1 && count_lines(items, columns, most) > room) {
    most--;
  }
  int used = count_lines(items, columns, most);
  for (guint i = 0; i < items->len; i++) {
    const int extra = used < room ? 1 : 0; // for the first items
    g_auto(GStrv) lines = item_lines(items->pdata[i], columns, most + extra);
    used += (int)g_strv_length(lines) > most ? 1 : 0;
    for (char **line = lines; *line != NULL; line++) {
      printf("%s\n", *line);
    }
  }
  return used;
}

// ---- Parts of the summary ----

static void add_verdict(GPtrArray *items, const SbSummary *summary, const SbCaseVerdict *verdict) {
  for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
    if (verdict[kind].of.figure >= 0) {
      g_autofree char *text = sb_run_verdict_text(summary, kind, &verdict[kind]);
      add_summary_item(items, sb_verdict_word(kind), VERDICT_WIDTH, text);
    }
  }
}

// Appends to `index` the key figures and, of a test rig, the figures that it has in place of a
// valve's cycle. Returns their number.
static size_t list_figures(int index[SB_FIGURE_COUNT], const SbCliRunText *of) {
  size_t count = 0;
  for (size_t i = 0; i < G_N_ELEMENTS(key_figures); i++) {
    index[count++] = sb_figure_find(key_figures[i]);
  }
  for (int i = 0; i < SB_FIGURE_COUNT && !sb_device(sb_run_model(of->run))->stem; i++) {
    if (sb_figure(i)->brief && sb_figure(i)->group == SB_GROUP_RIG) {
      index[count++] = i;
    }
  }
  return count;
}

// Why the figure index[at] was not computed; for the reason of a figure that is listed before it,
// the name of that figure. Owned by the caller; NULL for a number.
static char *missing_text(const SbSummary *summary, const int *index, size_t at) {
  const char *reason = sb_figure_reason(summary, index[at]);
  for (size_t i = 0; reason != NULL && i < at; i++) {
    if (reason == sb_figure_reason(summary, index[i])) { // each reason is stored once
      g_autofree char *label = sb_figure_label(index[i]);
      return g_strdup_printf("- (reason: see %s)", label);
    }
  }
  return reason != NULL ? g_strdup_printf("- (%s)", reason) : NULL;
}

// A figure that was computed, with the absolute estimate of its error or the reason why it has
// none. Owned by the caller.
static char *number_text(const SbSummary *summary, int index) {
  const double value = sb_figure_value(summary, index);
  const double error = sb_figure_error_absolute(summary, index);
  g_autofree char *number = sb_figure_format(index, value, sb_figure_error(summary, index));
  if (!isfinite(error)) {
    const char *why = sb_figure_error_reason(summary, index);
    return g_strdup_printf("%-*s error not known%s%s", VALUE_WIDTH, number, why != NULL ? ": " : "",
                           why != NULL ? why : "");
  }
  g_autofree char *estimate = sb_figure_error_format(index, value, error);
  return g_strdup_printf("%-*s ± %s", VALUE_WIDTH, number, estimate);
}

static void add_figures(GPtrArray *items, const SbCliRunText *of) {
  const SbSummary *summary = sb_run_summary(of->run);
  int index[SB_FIGURE_COUNT];
  const size_t count = list_figures(index, of);
  int width = 0;
  for (size_t i = 0; i < count; i++) {
    g_autofree char *label = sb_figure_label(index[i]);
    width = MAX(width, sb_wrap_width(label));
  }
  for (size_t i = 0; i < count; i++) {
    g_autofree char *label = sb_figure_label(index[i]);
    g_autofree char *missing = missing_text(summary, index, i);
    g_autofree char *number = missing == NULL ? number_text(summary, index[i]) : NULL;
    add_summary_item(items, label, width, missing != NULL ? missing : number);
  }
}

static void add_remarks(GPtrArray *items, const SbCliRunText *of, const SbSummary *summary) {
  if (!summary->converged) {
    g_ptr_array_add(items, g_strdup("Not converged: the figures belong to the last good states."));
  } else if (!of->converged) {
    g_ptr_array_add(items, g_strdup("Not converged: a point of a study has failed."));
  }
  if (of->measured != NULL) {
    g_ptr_array_add(items, sb_cli_comparison_brief(of->measured));
  }
  const size_t count = summary->warnings.count;
  g_autofree char *warnings = count == 0
                                  ? g_strdup("No warnings")
                                  : g_strdup_printf("%zu warning%s", count, count == 1 ? "" : "s");
  g_ptr_array_add(items, g_strconcat(warnings,
                                     ", more figures: see --all. ± is the numerical error, not the "
                                     "model's.",
                                     NULL));
}

void sb_cli_run_summary(const SbCliRunText *of) {
  const SbSummary *summary = sb_run_summary(of->run);
  const int terminal = sb_wrap_columns(STDOUT_FILENO);
  const int columns = terminal > 0 ? terminal : SUMMARY_COLUMNS;
  const int room = SB_CLI_SUMMARY_LINES - (of->folder != NULL);
  g_autoptr(GPtrArray) items = g_ptr_array_new_with_free_func(g_free);
  g_ptr_array_add(items, g_strdup(of->title));
  if (sb_device(sb_run_model(of->run))->stem) {
    add_verdict(items, summary, of->verdict);
  }
  add_figures(items, of);
  add_remarks(items, of, summary);
  // The loop takes the lines that the text leaves. A narrow terminal gets more lines instead of
  // numbers that are cut.
  const bool narrow = columns < SUMMARY_COLUMNS;
  const int left = room - print_items(items, columns, narrow ? INT_MAX : room);
  if (!of->plots->off && (narrow || left >= LOOP_LINES_MIN)) {
    sb_cli_plot_run(of->run, of->measured, CLAMP(left, LOOP_LINES_MIN, LOOP_LINES_MAX) - 1);
  }
  if (of->folder != NULL) {
    printf("Results are in %s\n", of->folder);
  }
}
