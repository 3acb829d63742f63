// A chart in words: its description for assistive technology, and its numbers as a table.
#include "ui/views/chart_view_private.h"

#include "app/base/device.h"
#include "app/base/figure_text.h"
#include "app/base/translation.h"
#include "app/chart/compare.h"
#include "app/chart/rig.h"
#include "engine/valve/figures/figures.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <math.h>

// "return force 1.6 N, " of each, or why it is not known.
static void append_figures(GString *text, const SbSummary *summary, const char *const *paths) {
  for (; *paths != NULL; paths++) {
    int index = sb_figure_find(*paths);
    const char *reason = sb_figure_reason(summary, index);
    g_autofree char *label = sb_translation_inside(sb_figure(index)->label);
    char value[SB_FORMAT_MAX];
    if (reason != NULL) {
      g_string_append_printf(text, _("%s not known: %s, "), label, reason);
    } else {
      g_string_append_printf(text, "%s %s, ", label, sb_format_figure(value, summary, index));
    }
  }
}

static void describe_loop(SbSession *session, GString *text) {
  const SbChartData *data = sb_session_chart(session);
  char a[SB_FORMAT_MAX], b[SB_FORMAT_MAX];
  if (data->run.count == 0) {
    g_string_append(text, _("No run yet."));
    return;
  }
  if (!sb_device(data->run.model)->stem) {
    const SbSummary *ended = data->run.summary;
    if (ended != NULL && ended->rig.found) {
      static const char *const paths[] = {"cycle.force_breakaway_N", "rig.coefficient_static",
                                          "rig.coefficient_dynamic", "rig.coefficient_mean", NULL};
      g_string_append(text, _("Sliding plate: "));
      append_figures(text, ended, paths);
      g_string_append_printf(text,
                             _("%zu peaks that follow, thesis 0.51 measured and 0.4 predicted, "),
                             ended->rig.of.peaks);
    }
    g_autofree char *now = sb_session_where(session);
    g_string_append_printf(text, _("now %s."), now);
    return;
  }
  const SbStageMark *marks = sb_trace_marks(data->run.trace);
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    if (marks[i].reached) {
      g_string_append_printf(text, _("%s %s at %s, "), sb_stage_name((SbStage)i),
                             sb_chart_stage_force(a, &data->run, (SbStage)i, marks[i].force),
                             sb_format_text(b, SB_QUANTITY_LENGTH, marks[i].displacement, 0));
    }
  }
  const SbSummary *summary = data->run.summary;
  if (summary != NULL) {
    static const char *const paths[] = {"cycle.force_breakaway_N", "cycle.force_return_margin_N",
                                        "cycle.energy_loss_J", NULL};
    append_figures(text, summary, paths);
  }
  g_autofree char *where = sb_session_where(session);
  g_string_append_printf(text, _("now %s."), where);
}

static void describe_contacts(const SbModel *model, const SbFrame *frame, SbChartViewKind kind,
                              GString *text) {
  char a[SB_FORMAT_MAX], b[SB_FORMAT_MAX];
  if (frame == NULL) {
    g_string_append(text, _("No run yet."));
    return;
  }
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const SbSealFrame *seal = &frame->seal[i];
    const char *name = sb_chart_seal_name(model, i);
    double width = seal->contact_right - seal->contact_left;
    if (width <= 0 || seal->land_fraction <= 0) {
      g_string_append_printf(text, _("%s: no contact. "), name);
    } else if (kind == SB_CHART_VIEW_PRESSURE) {
      g_string_append_printf(text, _("%s: peak %s over %s. "), name,
                             sb_format_text(a, SB_QUANTITY_PRESSURE, seal->pressure_peak, 0),
                             sb_format_text(b, SB_QUANTITY_LENGTH, width, 0));
    } else if (seal->film_central > 0) {
      g_string_append_printf(text, _("%s: centre %s, minimum %s. "), name,
                             sb_format_text(a, SB_QUANTITY_FILM, seal->film_central, 0),
                             sb_format_text(b, SB_QUANTITY_FILM, seal->film_min, 0));
    } else {
      g_string_append_printf(text, _("%s: at rest. "), name);
    }
  }
}

static void describe_life(SbSession *session, GString *text) {
  const SbChartRun *run = &sb_session_chart(session)->run;
  if (run->life_count == 0) {
    g_string_append(text, _("Known when the run has ended."));
    return;
  }
  char a[SB_FORMAT_MAX], b[SB_FORMAT_MAX];
  const SbLifeActuation *first = &run->life[0], *last = &run->life[run->life_count - 1];
  const double error = sb_chart_error_force(run);
  g_string_append_printf(text, _("%zu actuations: break-away %s at first and %s at last, "),
                         run->life_count,
                         sb_format_text(a, SB_QUANTITY_FORCE, first->force_breakaway, error),
                         sb_format_text(b, SB_QUANTITY_FORCE, last->force_breakaway, error));
  g_string_append_printf(text, _("minimum return force %s and %s."),
                         sb_format_text(a, SB_QUANTITY_FORCE, first->force_return, error),
                         sb_format_text(b, SB_QUANTITY_FORCE, last->force_return, error));
}

static void describe_shelf(SbSession *session, GString *text) {
  const SbSummary *summary = sb_session_chart(session)->run.summary;
  if (summary == NULL) {
    g_string_append(text, _("Known when the run has ended."));
    return;
  }
  const SbShelf *shelf = &summary->shelf;
  if (isnan(shelf->loss_per_year)) {
    g_string_append(text, sb_figure_reason(summary, sb_figure_find("shelf.loss_kg_per_year")));
    return;
  }
  SbFormatted loss, doses;
  const int loss_figure = sb_figure_find("shelf.loss_kg_per_year");
  const int doses_figure = sb_figure_find("shelf.doses_left");
  sb_figure_parts(&loss, loss_figure, shelf->loss_per_year, sb_figure_error(summary, loss_figure));
  sb_figure_parts(&doses, doses_figure, shelf->doses_left, sb_figure_error(summary, doses_figure));
  g_string_append_printf(text, _("Loss of %s mg a year, %s doses left. "), loss.number,
                         doses.number);
  if (shelf->typical) {
    g_string_append(text, _("It depends on typical values of the rubber."));
  }
}

const SbChartPredicted *sb_chart_view_prediction(const SbChartWidget *view) {
  const SbChartData *data = sb_session_chart(view->session);
  const bool draws = view->kind == SB_CHART_VIEW_LOOP || view->kind == SB_CHART_VIEW_PRESSURE ||
                     view->kind == SB_CHART_VIEW_FILM;
  return draws && sb_device(data->run.model)->stem ? data->predicted : NULL;
}

void sb_chart_view_describe(gpointer data) {
  SbChartWidget *view = data;
  g_autoptr(GString) text = g_string_new(NULL);
  const SbChartRun *run = &sb_session_chart(view->session)->run;
  const char *name = sb_chart_view_name(view->kind);
  if (view->kind == SB_CHART_VIEW_LOOP) {
    describe_loop(view->session, text);
  } else if (view->kind == SB_CHART_VIEW_COMPARE) {
    g_autofree char *table = sb_compare_text(sb_session_chart(view->session));
    g_string_append(text, table);
  } else if (view->kind == SB_CHART_VIEW_LIFE) {
    describe_life(view->session, text);
  } else if (view->kind == SB_CHART_VIEW_SHELF) {
    describe_shelf(view->session, text);
  } else if (view->kind == SB_CHART_VIEW_REASONS || !sb_device(run->model)->stem) {
    name = view->kind == SB_CHART_VIEW_PRESSURE ? _("Friction over load") : name;
    g_autofree char *reasons = sb_rig_reasons_text(run);
    g_string_append(text, reasons);
  } else {
    describe_contacts(sb_session_model(view->session), sb_session_frame(view->session), view->kind,
                      text);
  }
  if (view->zoomed) {
    g_string_append_printf(text, _(" Enlarged: %.3g to %.3g mm, %.3g to %.3g N."), view->zoom.x0,
                           view->zoom.x1, view->zoom.y0, view->zoom.y1);
  }
  SbProfileReading reading;
  if (sb_chart_view_read_contact(view, &reading)) {
    g_autofree char *read = sb_profiles_cursor_text(&reading, sb_session_chart(view->session),
                                                    view->kind == SB_CHART_VIEW_FILM);
    g_string_append_printf(text, _(" Under the pointer: %s."), read);
  }
  if (!isnan(view->cursor)) {
    g_autofree char *read = sb_hysteresis_cursor_text(run, view->cursor);
    g_string_append_printf(text, _(" Under the pointer: %s."), read);
  }
  g_autofree char *former = sb_session_former_text(view->session);
  if (former != NULL) {
    g_string_append_printf(text, _(" Of the %s."), former);
  }
  g_autofree char *grade = sb_session_grade_text(view->session);
  if (grade != NULL) {
    g_string_append_printf(text, _(" Solved: %s."), grade);
  }
  const SbChartPredicted *predicted = sb_chart_view_prediction(view);
  if (predicted != NULL) {
    g_string_append(text, _(" Dashed: predicted for the present values. "));
    if (view->kind != SB_CHART_VIEW_LOOP) {
      describe_contacts(sb_session_model(view->session), predicted->run.frames, view->kind, text);
    }
  }
  sb_style_name(view->area, name, text->str);
}

char *sb_chart_view_stage_table(SbSession *session) {
  const SbChartData *data = sb_session_chart(session);
  GString *text = g_string_new("stage\ttime [s]\tdisplacement [m]\tforce [N]\n");
  if (data->run.count > 0) {
    const SbStageMark *marks = sb_trace_marks(data->run.trace);
    for (int i = 0; i < SB_STAGE_COUNT; i++) {
      char a[G_ASCII_DTOSTR_BUF_SIZE], b[G_ASCII_DTOSTR_BUF_SIZE], c[G_ASCII_DTOSTR_BUF_SIZE];
      if (marks[i].reached) {
        g_string_append_printf(text, "%s\t%s\t%s\t%s\n", sb_stage_name((SbStage)i),
                               g_ascii_formatd(a, sizeof a, "%.6g", marks[i].time),
                               g_ascii_formatd(b, sizeof b, "%.6g", marks[i].displacement),
                               g_ascii_formatd(c, sizeof c, "%.6g", marks[i].force));
      }
    }
  }
  if (data->pin_count > 0 || data->measured != NULL) {
    g_autofree char *compared = sb_compare_text(data);
    g_string_append_printf(text, "\n%s", compared);
  }
  return g_string_free(text, FALSE);
}
