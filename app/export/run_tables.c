// Tables of a run. See the header.
#include "app/export/run_tables.h"

#include "app/base/device.h"
#include "app/base/figure_text.h"
#include "app/base/format.h"
#include "app/base/issue.h"
#include "app/session/verdict_text.h"

#include "engine/valve/sealbench.h"

#include <math.h>
#include <string.h>

char *sb_run_value(const SbSummary *summary, int index) {
  return sb_figure_format(index, sb_figure_value(summary, index), sb_figure_error(summary, index));
}

char *sb_run_error(const SbSummary *summary, int index) {
  const double error = sb_figure_error_reported(summary, index);
  char digits[SB_FORMAT_MAX];
  if (isnan(sb_figure_value(summary, index)) || isnan(error)) {
    return g_strdup("");
  }
  return error < 1e-9 ? g_strdup("rounding")
                      : g_strdup_printf("%s\xc2\xa0%%", sb_format_digits(digits, 100 * error, 2));
}

char *sb_run_margin(int figure, double value, double error, double low, double high) {
  const double below = value - low, above = high - value;
  const double margin = fmin(below, above), limit = below < above ? low : high;
  if (!isfinite(margin) || sb_figure(figure)->digits == 0) {
    return g_strdup("");
  }
  // The limit is exact: the margin has the absolute error of the value.
  g_autofree char *size =
      sb_figure_format(figure, fabs(margin), margin != 0 ? fabs(error * value / margin) : 0);
  g_autofree char *share =
      limit != 0 ? g_strdup_printf(" (%.0f\xc2\xa0%%)", 100 * fabs(margin / limit)) : g_strdup("");
  return g_strdup_printf("%s%s%s", margin < 0 ? "\xe2\x88\x92" : "", size, share);
}

// ---- Figures ----

// Adds a row of texts to the table of figures.
static void add_text(SbTable *table, const char *label, char *text) {
  sb_table_add(table, SB_CELLS(sb_cell_text(label), sb_cell_shown(text), sb_cell_text(NULL),
                               sb_cell_shown(NULL), sb_cell_text(NULL)));
}

// Adds the brief figures of a group behind a line with `name`; `known`: without those that were not
// computed.
static void add_figures(SbTable *table, const SbSummary *summary, SbFigureGroup group,
                        const char *name, bool known) {
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const SbFigure *figure = sb_figure(i);
    const char *reason = sb_figure_reason(summary, i);
    if (!figure->brief || figure->group != group || (known && isnan(sb_figure_value(summary, i)))) {
      continue;
    }
    if (name != NULL) {
      sb_table_note(table, "%s", name);
      name = NULL;
    }
    char *why =
        reason != NULL ? g_strdup_printf("not computed: %s", reason) : g_strdup(figure->help);
    sb_table_add(table, SB_CELLS(sb_cell_text(figure->label),
                                 sb_cell_shown(sb_run_value(summary, i)), sb_cell_text(reason),
                                 sb_cell_shown(sb_run_error(summary, i)), sb_cell_own(why)));
  }
}

SbTable *sb_run_figures(const SbRun *run) {
  static const SbTableColumn columns[] = {
      {.layout = "  %-36s", .label = "Figure", .width = 2.5},
      {.layout = " %s", .label = "Value", .width = 1.4},
      {.layout = " (%s)"},
      {.label = "Error estimate", .width = 1.3},
      {.label = "Meaning", .width = 4.4},
  };
  const SbSummary *summary = sb_run_summary(run);
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  const bool rig = !sb_device(sb_run_model(run))->stem;
  add_figures(table, summary, SB_GROUP_CYCLE, "Cycle", rig);
  if (rig) {
    add_figures(table, summary, SB_GROUP_RIG, "Sliding plate", false);
    add_text(table, "Dynamic, measured in the thesis",
             sb_quantity_round(SB_RIG_MEASURED_DYNAMIC, "1", "", 5));
    add_text(table, "Dynamic, predicted there",
             sb_quantity_round(SB_RIG_PREDICTED_DYNAMIC, "1", "", 5));
    add_text(table, "Peaks that follow", g_strdup_printf("%zu", summary->rig.of.peaks));
    return table;
  }
  add_figures(table, summary, SB_GROUP_DOSE, "Dose", true);
  add_figures(table, summary, SB_GROUP_SHELF, "On the shelf", true);
  add_figures(table, summary, SB_GROUP_PEOPLE, "Who can press it", false);
  g_autofree char *life = g_strdup_printf("Life of %ld actuations", summary->life.done);
  if (summary->life.done > 0) {
    add_figures(table, summary, SB_GROUP_LIFE, life, false);
  }
  return table;
}

SbTable *sb_run_seals(const SbSummary *summary) {
  static const SbTableColumn columns[] = {
      {NULL, "  %-36s",
       "Seals, in the middle of B\xe2\x80\x93"
       "C",
       "Seals, in the middle of B-C", 3},
      {NULL, " %-16s", "Outer", "outer", 1.3},
      {.label = "Error", .width = 1},
      {NULL, " %s", "Inner", "inner", 1.3},
      {.label = "Error", .width = 1},
      {NULL, "  (%s)", "", NULL, 2.6},
  };
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const SbFigure *figure = sb_figure(i);
    if (!figure->brief || figure->group != SB_GROUP_SEAL || figure->seal != SB_OUTER) {
      continue;
    }
    g_autofree char *path =
        g_strconcat("seals.inner.", figure->path + strlen("seals.outer."), NULL);
    const int inner = sb_figure_find(path);
    const char *why = sb_figure_reason(summary, i), *other = sb_figure_reason(summary, inner);
    const bool same = g_strcmp0(why, other) == 0;
    char *note = same          ? g_strdup(why)
                 : why != NULL ? g_strdup_printf("outer: %s", why)
                               : g_strdup_printf("inner: %s", other);
    sb_table_add(table,
                 SB_CELLS(sb_cell_text(figure->label), sb_cell_shown(sb_run_value(summary, i)),
                          sb_cell_shown(sb_run_error(summary, i)),
                          sb_cell_shown(sb_run_value(summary, inner)),
                          sb_cell_shown(sb_run_error(summary, inner)), sb_cell_own(note)));
  }
  const SbTableCell none = sb_cell_text(NULL);
  const char *const state[] = {sb_leak_state_name(summary->seal[SB_OUTER].leak_state),
                               sb_leak_state_name(summary->seal[SB_INNER].leak_state)};
  sb_table_add(table, SB_CELLS(sb_cell_text("Leak path"), sb_cell_text(state[0]), none,
                               sb_cell_text(state[1]), none, none));
  return table;
}

SbTable *sb_run_stages(const SbSummary *summary) {
  static const SbTableColumn columns[] = {
      {.layout = "  Stage %-30s", .label = "Stage", .width = 0.6},
      {.layout = " %s", .label = "Time", .width = 1},
      {.layout = ", %s", .label = "Stem", .width = 1},
      {.layout = ", %s", .label = "Force", .width = 1},
      {.layout = "  %s", .label = "Event", .width = 4},
  };
  static const char *const events[SB_STAGE_COUNT] = {"start",
                                                     "first slip, the force at its peak",
                                                     "the land's edge reaches the inner contact",
                                                     "first contact with the stop",
                                                     "first slip on the return",
                                                     "the inner seal is in the bore again"};
  static const char *const paths[] = {"time_s", "displacement_m", "force_N"};
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (int s = 0; s < SB_STAGE_COUNT; s++) {
    const bool reached = summary->stage[s].reached;
    SbTableCell cell[] = {sb_cell_text(sb_stage_name((SbStage)s)), sb_cell_shown(NULL),
                          sb_cell_shown(NULL), sb_cell_shown(NULL),
                          sb_cell_text(reached ? events[s] : "not reached")};
    for (size_t k = 0; k < G_N_ELEMENTS(paths) && reached; k++) {
      g_autofree char *path =
          g_strdup_printf("cycle.stages.%s.%s", sb_stage_name((SbStage)s), paths[k]);
      cell[1 + k] = sb_cell_shown(sb_run_value(summary, sb_figure_find(path)));
    }
    sb_table_add(table, cell);
  }
  return table;
}

// ---- Verdict ----

char *sb_run_verdict_text(const SbSummary *summary, int kind, const SbCaseVerdict *verdict) {
  const SbVerdict *of = &verdict->of;
  g_autoptr(GString) text = g_string_new(sb_verdict_answer(of->ok));
  // Before the reason, which may be long.
  if (verdict->name != NULL) {
    g_string_append_printf(text, ", case %s", verdict->name);
  }
  if (!isnan(of->value)) {
    g_autofree char *label = sb_figure_label(of->figure);
    g_autofree char *figure = sb_verdict_figure_plain(summary, kind, of);
    g_string_append_printf(text, ": %s %s", label, figure);
  }
  if (of->reason[0] != '\0') {
    g_string_append_printf(text, " (%s)", of->reason);
  }
  return g_string_free(g_steal_pointer(&text), FALSE);
}

static char *decided_by(const SbVerdict *of) {
  if (of->figure < 0) {
    return g_strdup(of->reason[0] != '\0' ? of->reason : "no limit is set");
  }
  g_autofree char *label = sb_figure_label(of->figure);
  return g_strconcat(label, of->reason[0] != '\0' ? ": " : "", of->reason, NULL);
}

SbTable *sb_run_verdict(const SbSummary *summary, const SbCaseVerdict *verdict) {
  static const SbTableColumn columns[] = {
      {.layout = "  %-36s", .label = "Verdict", .width = 1.1},
      {.layout = " %s"},
      {.label = "", .width = 0.7},
      {.label = "Decided by", .width = 3.4},
      {.label = "Value", .width = 1.4},
      {.label = "Limit", .width = 1.4},
      {.label = "Margin", .width = 1.8},
      {.label = "Case", .width = 1},
  };
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
    const SbVerdict *of = &verdict[kind].of;
    const bool known = of->figure >= 0, limited = known && isfinite(of->limit);
    const double error = known ? sb_figure_error(summary, of->figure) : NAN;
    // The answer states on which side of the limit the value should be.
    const bool above = (of->value >= of->limit) == (of->ok != SB_ANSWER_NO);
    const double low = above ? of->limit : -INFINITY, high = above ? INFINITY : of->limit;
    SbTableCell answer = sb_cell_answer(of->ok == SB_ANSWER_YES);
    answer.shown = of->ok == SB_ANSWER_NO ? "NO" : of->ok == SB_ANSWER_YES ? "yes" : "-";
    sb_table_add(
        table,
        SB_CELLS(
            sb_cell_text(sb_verdict_word(kind)),
            sb_cell_own(known ? sb_run_verdict_text(summary, kind, &verdict[kind])
                              : decided_by(of)),
            answer, sb_cell_own(decided_by(of)),
            sb_cell_shown(known ? sb_figure_format(of->figure, of->value, error) : NULL),
            sb_cell_shown(limited ? sb_figure_given(of->figure, of->limit) : NULL),
            sb_cell_shown(limited ? sb_run_margin(of->figure, of->value, error, low, high) : NULL),
            sb_cell_text(verdict[kind].name)));
    sb_table_mark(table, of->ok == SB_ANSWER_NO ? SB_TABLE_WRONG : SB_TABLE_PLAIN);
  }
  return table;
}

// ---- Warnings ----

SbTable *sb_run_warnings(const SbWarnings *warnings, const GPtrArray *notes) {
  static const SbTableColumn columns[] = {
      {.layout = "  %s:"},
      {.layout = " %s", .label = "Finding", .width = 6},
      {.label = "Code", .width = 1.8},
      {.layout = " (%s)", .label = "Parameter", .width = 2},
  };
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (size_t i = 0; i < warnings->count; i++) {
    const SbWarning *warning = &warnings->item[i];
    const SbTableCell code = sb_cell_text(warning->code);
    sb_table_add(table, SB_CELLS(code, sb_cell_text(warning->text), code,
                                 sb_cell_text(sb_input_key(warning->input))));
    sb_table_mark(table, warning->serious ? SB_TABLE_DOUBT : SB_TABLE_PLAIN);
  }
  for (guint i = 0; notes != NULL && i < notes->len; i++) {
    const SbTableCell code = sb_cell_text("note");
    sb_table_add(table, SB_CELLS(code, sb_cell_text(((const SbIssue *)notes->pdata[i])->text), code,
                                 sb_cell_text(NULL)));
  }
  return table;
}
