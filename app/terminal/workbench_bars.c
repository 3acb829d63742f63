// Header, verdict and status of the workbench: the rows that every page has.
#include "app/terminal/workbench_private.h"

#include "app/base/device.h"
#include "app/base/format.h"
#include "app/session/verdict_text.h"
#include "app/session/worker.h"

#include <glib/gi18n.h>
#include <math.h>

// Header -----------------------------------------------------------------------------------------

static const char *model_text(const SbBench *bench) {
  const SbFitKind *fit = sb_fit_kind(
      (SbFitModel)sb_document_value(sb_session_document(bench->session), SB_P_MODELS_FIT));
  return fit->section ? _("rings solved") : fit->points ? fit->name : _("closed form");
}

void sb_bench_draw_header(SbBench *bench) {
  SbCells *cells = &bench->cells;
  const int width = cells->columns;
  const uint32_t ground = bench->theme.role[SB_ROLE_PANEL];
  sb_cells_fill(cells, (SbCellRect){0, 0, width, 1}, ' ',
                (SbPen){bench->theme.role[SB_ROLE_INK], ground, 0});
  const SbDocument *document = sb_session_document(bench->session);
  const char *valve = sb_document_valve_path(document);
  g_autofree char *base = valve != NULL ? g_path_get_basename(valve) : NULL;
  g_autofree char *name = g_strdup_printf(
      "%s%s%s%s", base != NULL ? base : "", base != NULL ? " · " : "", sb_document_title(document),
      sb_session_is_modified(bench->session) ? _(", edited") : "");

  // Pages, then the model on the right; the document takes what they leave.
  static const char *const pages[SB_PAGE_COUNT] = {N_("Valve"), N_("Design"), N_("Calibrate"),
                                                   N_("Propellants"), N_("Studies")};
  const bool narrow = width < 110;
  int need = 0;
  for (int i = 0; i < SB_PAGE_COUNT; i++) {
    need += narrow && i != (int)bench->page ? 3 : sb_cells_width(cells, _(pages[i])) + 4;
  }
  const char *model = model_text(bench);
  const int right = sb_cells_width(cells, model) + 2;
  int x = MAX(width - right - need - 2, 12);
  const int title =
      sb_cells_text(cells, 1, 0, 9, "Sealbench", sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD));
  sb_cells_text(cells, title + 3, 0, x - title - 5, name, sb_bench_pen(bench, SB_ROLE_SECOND, 0));
  for (int i = 0; i < SB_PAGE_COUNT; i++) {
    const bool chosen = i == (int)bench->page;
    g_autofree char *text = narrow && !chosen ? g_strdup_printf(" %d ", i + 1)
                                              : g_strdup_printf(" %d %s ", i + 1, _(pages[i]));
    SbPen pen = sb_bench_pen(bench, chosen ? SB_ROLE_INK : SB_ROLE_SECOND,
                             chosen ? SB_CELL_BOLD | SB_CELL_UNDERLINE : 0);
    pen.ground = chosen ? bench->theme.role[SB_ROLE_HAIRLINE] : SB_CELL_OWN;
    x += sb_cells_text(cells, x, 0, width - x, text, pen);
  }
  sb_cells_text_right(cells, width - right, 0, right - 1, model,
                      sb_bench_pen(bench, SB_ROLE_SECOND, 0));
}

// Verdict ----------------------------------------------------------------------------------------

SbCaseVerdict sb_bench_verdict(SbBench *bench, int kind) {
  const SbCaseVerdict *judged =
      bench->cases != NULL && sb_cases_job_run(bench->cases) == sb_session_run(bench->session)
          ? sb_cases_job_verdict(bench->cases)
          : NULL;
  return judged != NULL ? judged[kind]
                        : (SbCaseVerdict){sb_session_summary(bench->session)->verdict[kind], NULL};
}

// "−1.1 N · cold".
static char *verdict_figure(const SbSummary *summary, int kind, const SbCaseVerdict *verdict) {
  g_autofree char *figure = sb_verdict_figure_text(summary, kind, &verdict->of);
  return verdict->name == NULL
             ? g_steal_pointer(&figure)
             : g_strdup_printf("%s%s%s", figure, figure[0] != '\0' ? " · " : "", verdict->name);
}

// Returns what is left out for want of room: 0 nothing, 1 figures of verdicts that pass, 2 their
// words too, 3: even that is not enough.
static int level_of_room(SbCells *cells, const char *note, const SbAnswer answer[SB_VERDICT_COUNT],
                         char *const figure[SB_VERDICT_COUNT]) {
  int level = 0;
  for (; level < 3; level++) {
    int need = sb_cells_width(cells, note);
    for (int i = 0; i < SB_VERDICT_COUNT; i++) {
      const bool fails = answer[i] == SB_ANSWER_NO;
      const int words = sb_cells_width(cells, sb_verdict_word(i)) + 1;
      const int figures = figure[i][0] != '\0' ? sb_cells_width(cells, figure[i]) + 1 : 0;
      need += 4 + (level < 2 || fails ? words : 0) + (level < 1 || fails ? figures : 0);
    }
    if (need <= cells->columns) {
      break;
    }
  }
  return level;
}

void sb_bench_draw_verdict(SbBench *bench, int y) {
  if (!sb_device(sb_session_model(bench->session))->stem) {
    return; // the sliding plate has no verdict
  }
  const SbSummary *summary = sb_verdict_summary(bench->session);
  const bool predicted = sb_session_predicted(bench->session) != NULL;
  static const uint32_t sign[] = {
      [SB_ANSWER_UNKNOWN] = 0x2013, [SB_ANSWER_NO] = 0x2717, [SB_ANSWER_YES] = 0x2713};
  const bool former = sb_session_shows_former(bench->session) || predicted;
  char *figure[SB_VERDICT_COUNT];
  SbAnswer answer[SB_VERDICT_COUNT];
  for (int i = 0; i < SB_VERDICT_COUNT; i++) {
    const SbCaseVerdict verdict =
        summary != NULL ? sb_bench_verdict(bench, i) : (SbCaseVerdict){{0}, NULL};
    answer[i] = summary != NULL ? verdict.of.ok : SB_ANSWER_UNKNOWN;
    figure[i] = summary != NULL ? verdict_figure(summary, i, &verdict) : g_strdup("");
  }
  SbCells *cells = &bench->cells;
  const char *note = predicted ? _("predicted") : "";
  const int level = level_of_room(cells, note, answer, figure);
  int x = 1;
  for (int i = 0; i < SB_VERDICT_COUNT; i++) {
    const bool fails = answer[i] == SB_ANSWER_NO;
    const SbRole tone = former                       ? SB_ROLE_THIRD
                        : fails                      ? SB_ROLE_ERROR
                        : answer[i] == SB_ANSWER_YES ? SB_ROLE_PASS
                                                     : SB_ROLE_THIRD;
    const SbRole quiet = former ? SB_ROLE_THIRD : fails ? SB_ROLE_ERROR : SB_ROLE_SECOND;
    const SbRole word = former || fails ? quiet : SB_ROLE_INK;
    const int start = x;
    SbPen pen = sb_bench_pen(bench, tone, SB_CELL_BOLD);
    pen.ground = fails && !former ? bench->theme.role[SB_ROLE_ERROR_GROUND] : SB_CELL_OWN;
    sb_cells_put(cells, x - 1, y, ' ', pen);
    sb_cells_put(cells, x++, y, sign[answer[i]], pen);
    if (level < 2 || fails) {
      pen.ink = bench->theme.role[word];
      sb_cells_put(cells, x++, y, ' ', pen);
      x += sb_cells_text(cells, x, y, cells->columns - x, sb_verdict_word(i), pen);
    }
    if ((level < 1 || fails) && figure[i][0] != '\0') {
      pen.ink = bench->theme.role[quiet];
      pen.style = 0;
      sb_cells_put(cells, x++, y, ' ', pen);
      x += sb_cells_text(cells, x, y, cells->columns - x, figure[i], pen);
    }
    sb_cells_put(cells, x, y, ' ', pen);
    x += 3 + (start == x);
    g_free(figure[i]);
  }
  sb_cells_text(cells, x, y, cells->columns - x, note, sb_bench_pen(bench, SB_ROLE_WARN, 0));
}

// Status -----------------------------------------------------------------------------------------

static char *run_text(SbBench *bench) {
  const SbSummary *summary = sb_session_summary(bench->session);
  const bool running = sb_session_state(bench->session) == SB_SESSION_RUNNING;
  if (running || bench->export != NULL) {
    enum { CELLS = 12 };
    const double share =
        running ? sb_session_progress(bench->session) : sb_worker_progress(bench->export);
    GString *bar = g_string_new(NULL);
    for (int i = 0; i < CELLS; i++) {
      g_string_append(bar, i < share * CELLS ? "█" : "·");
    }
    g_string_append_printf(bar, " %.0f %%", 100 * share);
    return g_string_free(bar, FALSE);
  }
  if (summary == NULL) {
    return g_strdup("");
  }
  const double error = sb_chart_error_force(&sb_session_chart(bench->session)->run);
  char digits[SB_FORMAT_MAX];
  g_autofree char *told =
      error > 1e-5 && isfinite(error)
          ? g_strdup_printf(_(" · error %s %%"), sb_format_digits(digits, 100 * error, 2))
          : NULL;
  return summary->wall_s < 1 ? g_strdup_printf(_("%zu frames in %.0f ms%s"), summary->frames,
                                               1e3 * summary->wall_s, told != NULL ? told : "")
                             : g_strdup_printf(_("%zu frames in %.1f s%s"), summary->frames,
                                               summary->wall_s, told != NULL ? told : "");
}

// A message in the status line `y`, or if it is longer than `room` columns, wrapped into the rows
// above.
static void draw_message(SbBench *bench, int y, int room, const char *message, uint32_t ink) {
  SbCells *cells = &bench->cells;
  const SbPen pen = {ink, bench->theme.role[SB_ROLE_PANEL], SB_CELL_BOLD};
  if (sb_cells_width(cells, message) <= room) {
    sb_cells_text(cells, 1, y, room, message, pen);
    return;
  }
  // Once to see how long it is, then in its place.
  const int width = cells->columns - 2, most = y - 3;
  SbCells page;
  sb_cells_init(&page, width, most, cells->ascii);
  const int lines = sb_cells_paragraph(&page, (SbCellRect){0, 0, width, most}, message, pen);
  sb_cells_finish(&page);
  sb_cells_fill(cells, (SbCellRect){0, y - lines, cells->columns, lines}, ' ', pen);
  (void)sb_cells_paragraph(cells, (SbCellRect){1, y - lines, width, lines}, message, pen);
}

void sb_bench_draw_status(SbBench *bench, int y) {
  SbCells *cells = &bench->cells;
  const int width = cells->columns;
  sb_cells_fill(cells, (SbCellRect){0, y, width, 1}, ' ',
                (SbPen){bench->theme.role[SB_ROLE_SECOND], bench->theme.role[SB_ROLE_PANEL], 0});
  const SbSummary *summary = sb_session_summary(bench->session);
  const size_t count = summary != NULL ? summary->warnings.count + summary->warnings.dropped : 0;
  g_autofree char *warnings =
      count > 0 ? g_strdup_printf(ngettext("%zu warning", "%zu warnings", count), count)
                : g_strdup("");
  const int right = sb_cells_width(cells, warnings);
  sb_cells_text_right(cells, 0, y, width - 1, warnings,
                      sb_bench_pen(bench, SB_ROLE_WARN, SB_CELL_BOLD));
  g_autofree char *run = run_text(bench);
  const int run_width = sb_cells_width(cells, run);
  sb_cells_text_right(cells, 0, y, width - 1 - (right > 0 ? right + 3 : 0), run,
                      sb_bench_pen(bench, SB_ROLE_SECOND, 0));
  const int room = width - 4 - right - run_width - 3;
  const char *failure = sb_session_failure(bench->session);
  if (bench->message != NULL || failure != NULL) {
    const bool fails = bench->message == NULL || bench->message_fails;
    draw_message(bench, y, room, bench->message != NULL ? bench->message : failure,
                 bench->theme.role[fails ? SB_ROLE_ERROR : SB_ROLE_INK]);
    return;
  }
  const SbRun *shown = sb_session_run(bench->session);
  const SbModel *model = shown != NULL ? sb_run_model(shown) : sb_session_model(bench->session);
  if (model == NULL) {
    sb_cells_text(cells, 1, y, room, _("the values are inconsistent"),
                  sb_bench_pen(bench, SB_ROLE_ERROR, 0));
    return;
  }
  char fit[32], film[32], surface[32], motion[32];
  sb_model_choice_name(model, SB_P_MODELS_FIT, fit, sizeof fit);
  sb_model_choice_name(model, SB_P_MODELS_FILM, film, sizeof film);
  sb_model_choice_name(model, SB_P_MODELS_SURFACE, surface, sizeof surface);
  sb_model_choice_name(model, SB_P_MODELS_MOTION, motion, sizeof motion);
  g_autofree char *text =
      sb_device(model)->stem
          ? g_strdup_printf(_("fit %s · film %s · surface %s · %s"), fit, film, surface, motion)
          : g_strdup_printf(_("motion %s"), motion);
  sb_cells_text(cells, 1, y, room, text, sb_bench_pen(bench, SB_ROLE_SECOND, 0));
}
