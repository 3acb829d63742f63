// The verdict in words. See verdict_text.h.
#include "app/session/verdict_text.h"

#include "app/base/figure_text.h"
#include "app/base/translation.h"
#include "engine/valve/figures/figures.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

// A question, the figure that stands for it while no limit decides, and the stage whose instant a
// click shows: the figure's own, or in whose middle the seals' figures are taken.
static const struct {
  const char *word, *figure;
  SbStage stage;
  double share; // of the way to the next event
} questions[SB_VERDICT_COUNT] = {
    [SB_VERDICT_SEALS] = {NC_("verdict", "Seals"), "seals.outer.pressure_peak_Pa", SB_STAGE_B, 0.5},
    [SB_VERDICT_PRESSES] = {NC_("verdict", "Presses"), "cycle.force_press_N", SB_STAGE_B, 0},
    [SB_VERDICT_RETURNS] = {NC_("verdict", "Returns"), "cycle.force_return_margin_N", SB_STAGE_F,
                            0.5},
    [SB_VERDICT_DOSES] = {NC_("verdict", "Doses"), "dose.metered_volume_m3", SB_STAGE_C, 0.5},
    [SB_VERDICT_LEAK] = {NC_("verdict", "Leak"), "seals.outer.leakage_static_m3_per_s", SB_STAGE_B,
                         0.5},
    [SB_VERDICT_FITS] = {NC_("verdict", "Fits"), "seals.outer.squeeze", SB_STAGE_A, 0},
};

const SbSummary *sb_verdict_summary(SbSession *session) {
  const SbSummary *predicted = sb_session_predicted(session);
  const SbChartRun *shown = &sb_session_chart(session)->run;
  return predicted != NULL ? predicted : shown->state == SB_CHART_DONE ? shown->summary : NULL;
}

const char *sb_verdict_word(int kind) {
  return g_dpgettext2(NULL, "verdict", questions[kind].word);
}

const char *sb_verdict_answer(SbAnswer answer) {
  return answer == SB_ANSWER_YES  ? C_("verdict", "yes")
         : answer == SB_ANSWER_NO ? C_("verdict", "no")
                                  : C_("verdict", "not known");
}

// A figure's value with the digits that it has on every surface, typeset. Owned by the caller.
static char *typeset(int figure, double value, double error) {
  char text[SB_FORMAT_MAX];
  return g_strdup(sb_figure_text(text, figure, value, error));
}

// The value of the verdict.
static char *shown_value(const SbSummary *summary, int figure, double value) {
  return typeset(figure, value, sb_figure_error(summary, figure));
}

// The deciding figure with its limit; `format` writes the value.
static char *figure_text(const SbSummary *summary, int kind, const SbVerdict *verdict,
                         char *(*format)(int figure, double value, double error)) {
  int figure = verdict->figure;
  double value = verdict->value;
  if (figure < 0) {
    figure = sb_figure_find(questions[kind].figure);
    value = sb_figure_value(summary, figure);
  }
  if (isnan(value)) {
    // A failure without a value has its reason: an open seal, or a stem that never moves.
    return g_strdup(kind == SB_VERDICT_LEAK || verdict->ok == SB_ANSWER_NO ? "" : _("not known"));
  }
  g_autofree char *own = format(figure, value, sb_figure_error(summary, figure));
  if (isnan(verdict->limit) || verdict->figure < 0) {
    return g_steal_pointer(&own);
  }
  g_autofree char *limit = sb_figure_given(figure, verdict->limit);
  if (summary->shelf.typical && sb_figure(figure)->group == SB_GROUP_SHELF) {
    return g_strdup_printf(_("%s (typical rubber) of %s"), own, limit);
  }
  return kind == SB_VERDICT_SEALS ? g_strdup_printf(_("%s over %s"), own, limit)
                                  : g_strdup_printf(_("%s of %s"), own, limit);
}

char *sb_verdict_figure_text(const SbSummary *summary, int kind, const SbVerdict *verdict) {
  return figure_text(summary, kind, verdict, typeset);
}

char *sb_verdict_figure_plain(const SbSummary *summary, int kind, const SbVerdict *verdict) {
  return figure_text(summary, kind, verdict, sb_figure_format);
}

char *sb_verdict_why(const SbSummary *summary, int kind, const SbVerdict *verdict) {
  g_autoptr(GString) text = g_string_new(NULL);
  g_string_append_printf(text, "%s: %s.", sb_verdict_word(kind), sb_verdict_answer(verdict->ok));
  const int figure =
      verdict->figure >= 0 ? verdict->figure : sb_figure_find(questions[kind].figure);
  const double value = verdict->figure >= 0 ? verdict->value : sb_figure_value(summary, figure);
  g_autofree char *label = sb_figure_label(figure);
  g_autofree char *shown =
      isnan(value) ? g_strdup(_("not known")) : shown_value(summary, figure, value);
  g_string_append_printf(text, "\n%s: %s.", sb_translation(label), shown);
  if (verdict->figure >= 0 && !isnan(verdict->limit)) {
    g_autofree char *limit = sb_figure_given(figure, verdict->limit);
    g_string_append_printf(text, _("\nLimit: %s."), limit);
  }
  if (verdict->reason[0] != '\0') {
    g_autofree char *reason = sb_sentence_case(verdict->reason);
    g_string_append_printf(text, "\n%s.", reason);
  }
  return g_string_free(g_steal_pointer(&text), FALSE);
}

void sb_verdict_show(SbSession *session, int kind) {
  if (questions[kind].stage != SB_STAGE_A) {
    sb_session_show_stage(session, questions[kind].stage, questions[kind].share);
  }
}
