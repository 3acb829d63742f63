// The page Design of the workbench: the request for a search for a design, and its results. Request
// and job are those of the window (app/session/design_ask.h, design_job.h).
#include "app/terminal/workbench_private.h"

#include "app/base/figure_text.h"
#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/document/typed.h"
#include "app/export/design_map.h"
#include "app/export/design_text.h"
#include "app/session/kept_store.h"
#include "app/session/worker.h"

#include <glib/gi18n.h>
#include <math.h>

enum {
  ROW_GOAL,   // rows that can be selected: the objective,
  ROW_MODELS, // the models,
  ROW_RANGES, // and from here on the ranges
  DESIGN_GOALS = 64,
  DESIGN_FIGURES = 1 + SB_DESIGN_LIMITS,
  TABLES_ROOM = 84,  // columns of the tables where there is room for a map next to them
  WITH_MAP = 116,    // columns of the page from which on this is so
  VALUE_ROOM = 11,   // columns of a value,
  LIMIT_ROOM = 14,   // of a limit,
  MARK_ROOM = 9,     // of a mark,
  MARGIN_ROOM = 11,  // and of a margin
  DESIGN_DIGITS = 6, // of a parameter, as `sealbench design` prints it
};

// The request and the job ------------------------------------------------------------------------

static void forget_design(SbBenchDesign *design) {
  g_clear_pointer(&design->job, sb_design_job_free);
  g_clear_pointer(&design->answer, sb_design_answer_free);
  g_clear_pointer(&design->sentence, g_free);
}

void sb_bench_design_follow(SbBench *bench) {
  SbBenchDesign *design = &bench->design;
  const SbDocument *document = sb_session_document(bench->session);
  const SbParams params = sb_document_params(document);
  const int kind = (int)sb_params_get(&params, SB_P_VALVE_KIND);
  if (document != design->document || kind != design->kind) {
    forget_design(design);
    design->document = document;
    design->kind = kind;
    design->changed = false;
    design->row = ROW_GOAL;
    sb_design_ask_init(&design->ask, document);
  }
}

static void on_design(void *data) {
  SbBench *bench = data;
  SbBenchDesign *design = &bench->design;
  g_autofree char *why = NULL;
  SbDesignAnswer *answer = sb_design_job_take(design->job, &why);
  forget_design(design);
  design->answer = answer;
  design->sentence = sb_design_end_text(answer, why);
  if (bench->page == SB_PAGE_DESIGN) { // which has the sentence
    g_clear_pointer(&bench->message, g_free);
    sb_bench_changed(bench);
  } else {
    sb_bench_status(bench, why != NULL && *why != '\0', "%s", design->sentence);
  }
}

static void start_design(SbBench *bench) {
  SbBenchDesign *design = &bench->design;
  const SbDocument *document = sb_session_document(bench->session);
  if (design->job != NULL) {
    sb_bench_status(bench, true, _("A search is running; c cancels it."));
    return;
  }
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbStudyFile *study = sb_design_ask_study(&design->ask, document, issues);
  if (study == NULL) {
    g_autofree char *line = sb_issue_line(issues->pdata[0]);
    sb_bench_status(bench, true, "%s", line);
    return;
  }
  forget_design(design);
  if (design->store == NULL) {
    design->store = sb_kept_store_open();
  }
  g_free(design->hash);
  design->hash = sb_document_sha256(document);
  design->changed = false;
  design->job = sb_design_job_start(study, &design->ask, design->store, true, on_design, bench);
}

bool sb_bench_design_stop(SbBench *bench) {
  if (bench->design.job != NULL) {
    sb_design_job_cancel(bench->design.job);
  }
  return bench->design.job != NULL;
}

void sb_bench_design_finish(SbBench *bench) {
  forget_design(&bench->design);
  sb_store_close(bench->design.store, NULL);
  g_free(bench->design.hash);
}

// The results so far; borrowed until release_answer(), also after NULL.
static const SbDesignAnswer *borrow_answer(SbBench *bench) {
  return bench->design.job != NULL ? sb_design_job_lock(bench->design.job) : bench->design.answer;
}

static void release_answer(SbBench *bench) {
  if (bench->design.job != NULL) {
    sb_design_job_unlock(bench->design.job);
  }
}

// The figures of the request: the objective, then those with a limit.
static size_t requested_figures(const SbDesignAsk *ask, int figure[DESIGN_FIGURES]) {
  size_t count = 0;
  figure[count++] = ask->goal;
  for (size_t i = 0; i < ask->limits.count; i++) {
    if (ask->limits.item[i].figure != ask->goal) {
      figure[count++] = ask->limits.item[i].figure;
    }
  }
  return count;
}

// Keys -------------------------------------------------------------------------------------------

static void use_best(SbBench *bench) {
  SbOverride values[SB_VARY_MAX];
  const SbDesignAnswer *answer = borrow_answer(bench);
  const size_t count = answer != NULL ? sb_design_best_values(values, answer) : 0;
  release_answer(bench);
  if (count == 0) {
    sb_bench_status(bench, true, _("There is no best design yet: Enter searches it."));
  } else if (sb_session_edit_values(bench->session, values, count)) {
    sb_bench_status(bench, false, _("The valve has the values of the best design; u undoes it."));
  } else {
    sb_bench_status(bench, true, _("A value is out of range."));
  }
}

static void step_goal(SbDesignAsk *ask, int step) {
  int goal[DESIGN_GOALS];
  const int count = (int)sb_design_ask_goals(goal, DESIGN_GOALS);
  int at = 0;
  while (at < count - 1 && goal[at] != ask->goal) {
    at++;
  }
  sb_design_ask_set_goal(ask, goal[(at + step + count) % count]);
}

static void change_request(SbBenchDesign *design, int step) {
  if (design->row == ROW_GOAL) {
    step_goal(&design->ask, step);
  } else if (design->row == ROW_MODELS) {
    design->ask.closed = !design->ask.closed;
  } else {
    SbDesignRange *range = &design->ask.range[design->row - ROW_RANGES];
    range->free = !range->free;
  }
  design->changed = true;
}

// Lets the user type the bounds of the selected parameter.
static void type_bounds(SbBench *bench) {
  const SbBenchDesign *design = &bench->design;
  if (design->row < ROW_RANGES) {
    sb_bench_status(bench, true, _("Bounds are of a parameter: choose its row."));
    return;
  }
  const SbDesignRange *range = &design->ask.range[design->row - ROW_RANGES];
  g_autofree char *low = sb_param_format(range->id, range->low);
  g_autofree char *high = sb_param_format(range->id, range->high);
  g_autofree char *text = g_strdup_printf("%s .. %s", low, high);
  sb_bench_type(bench, SB_INPUT_BOUNDS, text);
}

void sb_bench_design_bounds(SbBench *bench, const char *text) {
  SbBenchDesign *design = &bench->design;
  if (design->row < ROW_RANGES) {
    return; // another document was opened meanwhile
  }
  SbDesignRange *range = &design->ask.range[design->row - ROW_RANGES];
  g_auto(GStrv) part = g_strsplit(text, "..", 2);
  double end[2] = {range->low, range->high};
  g_autoptr(GError) error = NULL;
  for (int i = 0; i < 2; i++) {
    g_autofree char *typed =
        sb_typed_text(range->id, end[i], part[i] != NULL ? g_strstrip(part[i]) : "");
    if (!sb_param_parse(&end[i], range->id, typed, &error)) {
      break;
    }
  }
  if (error != NULL || !(end[0] < end[1])) {
    sb_bench_status(bench, true, "%s",
                    error != NULL ? error->message : _("The minimum must be below the maximum."));
    return;
  }
  range->low = end[0];
  range->high = end[1];
  range->free = true;
  design->changed = true;
}

void sb_bench_design_key(SbBench *bench, const SbKey *key) {
  SbBenchDesign *design = &bench->design;
  const int last = ROW_RANGES + (int)design->ask.count - 1;
  switch (key->kind) {
  case SB_KEY_ENTER:
    start_design(bench);
    break;
  case SB_KEY_UP:
    design->row = MAX(design->row - 1, 0);
    break;
  case SB_KEY_DOWN:
    design->row = MIN(design->row + 1, last);
    break;
  case SB_KEY_LEFT:
  case SB_KEY_RIGHT:
    change_request(design, key->kind == SB_KEY_RIGHT ? 1 : -1);
    break;
  case SB_KEY_CHARACTER:
    if (key->character == 'a' && !key->control) {
      use_best(bench);
    } else if (key->character == 'b' && !key->control) {
      type_bounds(bench);
    }
    break;
  default:
    break;
  }
}

void sb_bench_design_effect(SbBench *bench) {
  bench->design.effect++;
}

// The tables -------------------------------------------------------------------------------------

static void draw_form(SbBench *bench, int y, int width) {
  SbBenchDesign *design = &bench->design;
  g_autofree char *goal = sb_design_goal_text(design->ask.goal);
  const char *const name[] = {_("Goal"), _("Models")};
  const char *const value[] = {goal, design->ask.closed ? _("closed forms of the thesis")
                                                        : _("the valve's own")};
  for (int i = 0; i < ROW_RANGES; i++) {
    const bool chosen = design->row == i;
    const SbPen pen = sb_bench_row(bench, 0, y + i, width, chosen);
    g_autofree char *text = g_strdup_printf(chosen ? "← %s →" : "  %s", value[i]);
    sb_cells_text(&bench->cells, 1, y + i, 10, name[i], sb_bench_pen(bench, SB_ROLE_SECOND, 0));
    sb_cells_text(&bench->cells, 11, y + i, width - 12, text, pen);
  }
}

// Returns the index of a parameter among those that a search varied; -1: it did not.
static int varied(const SbDesignAnswer *answer, SbParamId id) {
  for (guint k = 0; answer != NULL && k < answer->study->vary->len; k++) {
    if (g_array_index(answer->study->vary, SbVary, k).id == id) {
      return (int)k;
    }
  }
  return -1;
}

static void draw_value(SbBench *bench, int x, int y, SbParamId id, double value, SbPen pen) {
  const SbParam *param = sb_param(id);
  g_autofree char *text = isnan(value)
                              ? g_strdup("–")
                              : sb_quantity_round(value, param->si, param->unit, DESIGN_DIGITS);
  sb_cells_text_right(&bench->cells, x, y, VALUE_ROOM, text, pen);
}

static void draw_range(SbBench *bench, const SbDesignAnswer *answer, int index, int y, int width) {
  const SbDesignRange *range = &bench->design.ask.range[index];
  const int k = varied(answer, range->id);
  const SbDesignPlace *present = k >= 0 ? &answer->place[SB_DESIGN_PRESENT] : NULL;
  const SbDesignPlace *best = k >= 0 ? &answer->place[SB_DESIGN_BEST] : NULL;
  SbPen pen = sb_bench_row(bench, 0, y, width, bench->design.row == ROW_RANGES + index);
  SbCells *cells = &bench->cells;
  if (!range->free) {
    pen.ink = bench->theme.role[SB_ROLE_THIRD];
  }
  int x = width - 4 * VALUE_ROOM - MARK_ROOM;
  sb_cells_text(cells, 1, y, 1, range->free ? "✓" : "·", pen);
  sb_cells_text(cells, 3, y, x - 4, sb_translation(sb_param(range->id)->label), pen);
  const double own = sb_document_value(sb_session_document(bench->session), range->id);
  draw_value(bench, x, y, range->id, present != NULL && present->known ? present->value[k] : own,
             pen);
  x += VALUE_ROOM;
  SbPen strong = pen;
  strong.style |= SB_CELL_BOLD;
  draw_value(bench, x, y, range->id, best != NULL && best->known ? best->value[k] : NAN, strong);
  draw_value(bench, x + VALUE_ROOM, y, range->id, range->free ? range->low : NAN, pen);
  draw_value(bench, x + 2 * VALUE_ROOM, y, range->id, range->free ? range->high : NAN, pen);
  const int bound = best != NULL && best->known ? answer->found.bound_active[k] : 0;
  pen.ink = bench->theme.role[SB_ROLE_WARN];
  sb_cells_text(cells, x + 3 * VALUE_ROOM + 1, y, MARK_ROOM - 1,
                bound < 0   ? _("lower")
                : bound > 0 ? _("upper")
                            : "",
                pen);
}

static void draw_heads(SbBench *bench, int y, int width, const char *const *head, int count) {
  const SbPen quiet = sb_bench_pen(bench, SB_ROLE_SECOND, 0);
  for (int i = 0; i < count; i++) {
    sb_cells_text_right(&bench->cells, width + i * VALUE_ROOM, y, VALUE_ROOM, _(head[i]), quiet);
  }
}

// The parameters, scrolled to the selected one.
static void draw_ranges(SbBench *bench, const SbDesignAnswer *answer, SbCellRect rect) {
  static const char *const heads[] = {N_("present"), N_("best"), N_("minimum"), N_("maximum")};
  SbBenchDesign *design = &bench->design;
  const int count = (int)design->ask.count, rows = rect.height - 1;
  const int chosen = design->row - ROW_RANGES;
  const int x = rect.width - 4 * VALUE_ROOM - MARK_ROOM;
  g_autofree char *more = count > rows ? g_strdup_printf(_("Parameters, %d of %d"), rows, count)
                                       : g_strdup(_("Parameters"));
  sb_cells_text(&bench->cells, 1, rect.y, x - 2, more,
                sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD));
  draw_heads(bench, rect.y, x, heads, G_N_ELEMENTS(heads));
  sb_cells_text(&bench->cells, x + 4 * VALUE_ROOM + 1, rect.y, MARK_ROOM - 1, _("at bound"),
                sb_bench_pen(bench, SB_ROLE_SECOND, 0));
  design->scroll = MAX(MIN(design->scroll, MAX(chosen, 0)), chosen - rows + 1);
  design->scroll = CLAMP(design->scroll, 0, MAX(count - rows, 0));
  for (int i = 0; i < rows && design->scroll + i < count; i++) {
    draw_range(bench, answer, design->scroll + i, rect.y + 1 + i, rect.width);
  }
}

// Returns the index of the limit on a figure; -1: none.
static int limit_of(const SbLimits *limits, int figure) {
  for (size_t i = 0; i < limits->count; i++) {
    if (limits->item[i].figure == figure) {
      return (int)i;
    }
  }
  return -1;
}

// The limit on a figure, whether the best design meets it, and its margin.
static void draw_limit(SbBench *bench, const SbDesignAnswer *answer, int figure, double best, int x,
                       int y) {
  const SbLimits *limits = &bench->design.ask.limits;
  const int own = limit_of(limits, figure);
  if (own < 0) {
    return;
  }
  SbCells *cells = &bench->cells;
  const SbLimit *limit = &limits->item[own];
  g_autofree char *text = sb_limit_format(figure, limit->low, limit->high);
  sb_cells_text(cells, x + 2, y, LIMIT_ROOM - 2, text, sb_bench_pen(bench, SB_ROLE_SECOND, 0));
  const int at = answer != NULL ? limit_of(&answer->study->limits, figure) : -1;
  if (at < 0 || isnan(best)) {
    return;
  }
  const SbDesign *found = &answer->found;
  const bool met = !sb_design_violates(answer, SB_DESIGN_BEST, (size_t)at);
  const bool active = found->limit_active[2 * at] || found->limit_active[2 * at + 1];
  g_autofree char *mark =
      g_strdup_printf("%s%s%s", met ? "✓" : "✗", active ? " " : "", active ? _("active") : "");
  sb_cells_text(cells, x + LIMIT_ROOM, y, MARK_ROOM, mark,
                sb_bench_pen(bench, met ? SB_ROLE_PASS : SB_ROLE_ERROR, SB_CELL_BOLD));
  const double sigmas = sb_design_sigmas(answer, SB_DESIGN_BEST, (size_t)at);
  g_autofree char *margin = isnan(sigmas) ? g_strdup("–") : g_strdup_printf("%.1f", sigmas);
  sb_cells_text_right(cells, x + LIMIT_ROOM + MARK_ROOM, y, MARGIN_ROOM, margin,
                      sb_bench_pen(bench, SB_ROLE_INK, 0));
}

static void draw_figure(SbBench *bench, const SbDesignAnswer *answer, int figure, int y,
                        int width) {
  SbCells *cells = &bench->cells;
  int x = width - 2 * VALUE_ROOM - LIMIT_ROOM - MARK_ROOM - MARGIN_ROOM;
  const bool goal = figure == bench->design.ask.goal;
  g_autofree char *name = sb_design_figure_name(figure);
  sb_cells_text(cells, 1, y, x - 2, name,
                sb_bench_pen(bench, SB_ROLE_INK, goal ? SB_CELL_BOLD : 0));
  const int column = answer != NULL ? sb_design_answer_figure(answer, figure) : -1;
  double best = NAN;
  for (int place = 0; place < SB_DESIGN_PLACES; place++, x += VALUE_ROOM) {
    const SbDesignPlace *at =
        column >= 0 && answer->place[place].known ? &answer->place[place] : NULL;
    const double value = best = at != NULL ? at->figure[column] : NAN;
    g_autofree char *text =
        isnan(value) ? g_strdup("–") : sb_design_value_text(figure, value, at->error[column]);
    sb_cells_text_right(
        cells, x, y, VALUE_ROOM, text,
        sb_bench_pen(bench, SB_ROLE_INK, place == SB_DESIGN_BEST ? SB_CELL_BOLD : 0));
  }
  draw_limit(bench, answer, figure, best, x, y);
}

// Draws the figures, and below them the drawn valves beyond a limit.
static void draw_figures(SbBench *bench, const SbDesignAnswer *answer, SbCellRect rect) {
  static const char *const heads[] = {N_("present"), N_("best")};
  SbCells *cells = &bench->cells;
  const int x = rect.width - 2 * VALUE_ROOM - LIMIT_ROOM - MARK_ROOM - MARGIN_ROOM;
  const SbPen quiet = sb_bench_pen(bench, SB_ROLE_SECOND, 0);
  sb_cells_text(cells, 1, rect.y, x - 2, _("Figures"),
                sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD));
  draw_heads(bench, rect.y, x, heads, G_N_ELEMENTS(heads));
  sb_cells_text(cells, x + 2 * VALUE_ROOM + 2, rect.y, LIMIT_ROOM - 2, _("limit"), quiet);
  sb_cells_text(cells, x + 2 * VALUE_ROOM + LIMIT_ROOM, rect.y, MARK_ROOM, _("met"), quiet);
  sb_cells_text_right(cells, rect.width - MARGIN_ROOM, rect.y, MARGIN_ROOM, _("margin / σ"), quiet);
  int figure[DESIGN_FIGURES];
  const size_t count = requested_figures(&bench->design.ask, figure);
  int y = rect.y + 1;
  for (size_t i = 0; i < count && y < rect.y + rect.height - 1; i++) {
    draw_figure(bench, answer, figure[i], y++, rect.width);
  }
  sb_cells_text(cells, 1, y, x - 2, _("Beyond any limit"), quiet);
  for (int place = 0; answer != NULL && place < SB_DESIGN_PLACES; place++) {
    g_autofree char *fails = sb_design_fails_text(&answer->place[place]);
    sb_cells_text_right(cells, x + place * VALUE_ROOM, y, VALUE_ROOM, fails, quiet);
  }
}

// The page ---------------------------------------------------------------------------------------

// What is being computed, or how the last search ended and what marks its result.
static void draw_design_foot(SbBench *bench, const SbDesignAnswer *answer, SbCellRect rect) {
  SbBenchDesign *design = &bench->design;
  if (design->job != NULL) {
    sb_bench_draw_progress(bench, rect.x, rect.y, rect.width,
                           sb_design_part_text(sb_design_job_part(design->job)),
                           sb_worker_progress(design->job));
    return;
  }
  if (answer == NULL) {
    sb_cells_paragraph(&bench->cells, rect,
                       _("Enter searches the best design within the limits, c cancels, a uses it. "
                         "← → change the selected row."),
                       sb_bench_pen(bench, SB_ROLE_SECOND, 0));
    return;
  }
  g_autofree char *now = sb_document_sha256(sb_session_document(bench->session));
  const bool former = g_strcmp0(now, design->hash) != 0;
  g_autofree char *marks = sb_design_marks_text(answer);
  const int first = former || design->changed; // number of its line
  const char *state = former ? _("of earlier values") : first ? _("of an earlier request") : "";
  g_autofree char *all = g_strdup_printf("%s%s%s\n%s", state, first ? "\n" : "", design->sentence,
                                         marks != NULL ? marks : "");
  g_auto(GStrv) line = g_strsplit(all, "\n", 0);
  int y = rect.y;
  for (int i = 0; line[i] != NULL && y < rect.y + rect.height; i++) {
    y += sb_cells_paragraph(&bench->cells,
                            (SbCellRect){rect.x, y, rect.width, rect.y + rect.height - y}, line[i],
                            sb_bench_pen(bench, i != first ? SB_ROLE_WARN : SB_ROLE_INK, 0));
  }
}

// Draws request and tables one below the other. Returns the row behind them.
static int draw_tables(SbBench *bench, const SbDesignAnswer *answer, SbCellRect rect) {
  int figure[DESIGN_FIGURES];
  const int figures = (int)requested_figures(&bench->design.ask, figure) + 2;
  const int gap = rect.height >= 30, foot = rect.height >= 24 ? 4 : 3, effects = 1;
  const int room = rect.height - ROW_RANGES - figures - foot - effects - 3 * gap;
  const int ranges = CLAMP((int)bench->design.ask.count + 1, 2, MAX(room, 2));
  int y = rect.y;
  draw_form(bench, y, rect.width);
  y += ROW_RANGES + gap;
  draw_ranges(bench, answer, (SbCellRect){0, y, rect.width, ranges});
  y += ranges + gap;
  draw_figures(bench, answer, (SbCellRect){0, y, rect.width, figures});
  y += figures + gap;
  draw_design_foot(bench, answer, (SbCellRect){1, y, rect.width - 2, foot});
  return y + foot;
}

void sb_bench_draw_design(SbBench *bench, SbCellRect rect) {
  SbBenchDesign *design = &bench->design;
  int figure[DESIGN_FIGURES];
  const size_t count = requested_figures(&design->ask, figure);
  const int chosen = figure[design->effect % count];
  const bool map = rect.width >= WITH_MAP;
  const SbDesignAnswer *answer = borrow_answer(bench);
  const int width = map ? TABLES_ROOM : rect.width;
  const int y = draw_tables(bench, answer, (SbCellRect){0, rect.y, width, rect.height});
  const int bottom = rect.y + rect.height;
  if (map) {
    const int high = rect.height * 3 / 5;
    const int x = width + 3, across = rect.width - x - 1;
    for (int row = rect.y; row < bottom; row++) {
      sb_cells_put(&bench->cells, width + 1, row, 0x2502, sb_bench_pen(bench, SB_ROLE_AXIS, 0));
    }
    sb_bench_draw_design_map(bench, answer, (SbCellRect){x, rect.y, across, high});
    sb_bench_draw_design_effects(
        bench, answer, chosen,
        (SbCellRect){x, rect.y + high + 1, across, bottom - rect.y - high - 1});
  } else {
    sb_bench_draw_design_effects(bench, answer, chosen, (SbCellRect){1, y, width - 2, bottom - y});
  }
  release_answer(bench);
}
