// The list of parameters: groups and rows from the catalogue, the value in force, what is typed.
#include "app/terminal/workbench_private.h"

#include "app/base/format.h"
#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/session/param_list.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

// Columns of a row: a bar where it is changed, the name, the value, and of the main ones the effect
// on the goal about a line.
enum {
  EFFECT = 9, // columns of the effects, of which the line is the middle one
  SHORT_VALUE = 10,
  HEAD = 2,   // lines over the rows: which list, and the search
  FOOT = 4,   // below them: range, help or error
  VALUE = 13, // columns of a value
  MARGIN = 3  // in front of a name
};

static bool is_listed(const SbBench *bench, const SbParams *params, const char *needle,
                      SbParamId id) {
  return needle[0] != '\0' ? sb_param_matches(id, needle)
         : bench->list == SB_LIST_MAIN
             ? sb_param_is_main(id, (int)sb_params_get(params, SB_P_VALVE_KIND))
         : bench->list == SB_LIST_CHANGED ? sb_param_is_changed(params, id)
                                          : true;
}

void sb_bench_list(SbBench *bench) {
  g_autofree char *needle = g_utf8_casefold(bench->search->str, -1);
  g_strstrip(needle);
  const SbParams params = sb_document_params(sb_session_document(bench->session));
  g_array_set_size(bench->rows, 0);
  bool there = false;
  // Groups in the order of their first key; keys of a group may stand apart in the catalogue.
  g_autofree bool *done = g_new0(bool, SB_PARAM_COUNT);
  for (int first = 0; first < SB_PARAM_COUNT; first++) {
    if (done[first] || !is_listed(bench, &params, needle, (SbParamId)first)) {
      continue;
    }
    const SbParamHeading *heading = sb_param_heading((SbParamId)first);
    g_array_append_val(bench->rows, ((SbListRow){SB_HEADING_ROW, heading->title}));
    for (int id = first; id < SB_PARAM_COUNT; id++) {
      if (!done[id] && is_listed(bench, &params, needle, (SbParamId)id) &&
          sb_param_heading((SbParamId)id) == heading) {
        done[id] = true;
        there |= id == bench->selected;
        g_array_append_val(bench->rows, ((SbListRow){id, NULL}));
      }
    }
  }
  if (!there && bench->rows->len > 1) {
    bench->selected = g_array_index(bench->rows, SbListRow, 1).id;
  }
}

static int row_of(const SbBench *bench, int id) {
  for (guint i = 0; i < bench->rows->len; i++) {
    if (g_array_index(bench->rows, SbListRow, i).id == id) {
      return (int)i;
    }
  }
  return -1;
}

void sb_bench_select(SbBench *bench, int id) {
  bench->selected = id;
  if (row_of(bench, id) < 0) {
    g_string_truncate(bench->search, 0);
    bench->list = SB_LIST_ALL;
    sb_bench_list(bench);
  }
  sb_bench_changed(bench);
}

void sb_bench_move(SbBench *bench, int rows) {
  int at = row_of(bench, bench->selected);
  const int step = rows > 0 ? 1 : -1;
  for (int left = abs(rows), look = at + step; left > 0; look += step) {
    if (look < 0 || look >= (int)bench->rows->len) {
      break;
    }
    if (g_array_index(bench->rows, SbListRow, (guint)look).id != SB_HEADING_ROW) {
      at = look;
      left--;
    }
  }
  if (at >= 0) {
    bench->selected = g_array_index(bench->rows, SbListRow, (guint)at).id;
    sb_session_prepare(bench->session, (SbParamId)bench->selected);
  }
  sb_bench_changed(bench);
}

// Drawing ----------------------------------------------------------------------------------------

static bool shows_effects(const SbBench *bench, int width) {
  return bench->list == SB_LIST_MAIN && bench->search->len == 0 && width >= 38;
}

static void draw_head(SbBench *bench, SbCellRect rect) {
  const SbParams params = sb_document_params(sb_session_document(bench->session));
  const int kind = (int)sb_params_get(&params, SB_P_VALVE_KIND);
  int count[SB_LIST_COUNT] = {0};
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    count[SB_LIST_MAIN] += sb_param_is_main((SbParamId)id, kind);
    count[SB_LIST_CHANGED] += sb_param_is_changed(&params, (SbParamId)id);
    count[SB_LIST_ALL]++;
  }
  int x = rect.x + 1;
  for (int i = 0; i < SB_LIST_COUNT; i++) {
    g_autofree char *name = g_strdup_printf(i == SB_LIST_MAIN      ? _("Main %d")
                                            : i == SB_LIST_CHANGED ? _("Changed %d")
                                                                   : _("All %d"),
                                            count[i]);
    const bool chosen = (int)bench->list == i && bench->search->len == 0;
    SbPen pen = sb_bench_pen(bench, chosen ? SB_ROLE_INK : SB_ROLE_SECOND,
                             chosen ? SB_CELL_BOLD | SB_CELL_UNDERLINE : 0);
    x += sb_cells_text(&bench->cells, x, rect.y, rect.x + rect.width - x, name, pen) + 2;
  }
  const bool searching = bench->input == SB_INPUT_SEARCH || bench->search->len > 0;
  g_autofree char *search = g_strdup_printf(
      "/ %s", bench->input == SB_INPUT_SEARCH ? bench->typed->str : bench->search->str);
  if (searching) {
    sb_cells_text(&bench->cells, rect.x + 1, rect.y + 1, rect.width - 2, search,
                  sb_bench_pen(bench, SB_ROLE_INK, 0));
  } else {
    sb_cells_text_right(&bench->cells, rect.x, rect.y, rect.width - 1, "/",
                        sb_bench_pen(bench, SB_ROLE_SECOND, 0));
    if (shows_effects(bench, rect.width)) {
      g_autofree char *effect =
          g_strdup_printf(_("effect on %s, per tol."), sb_effect_goal_name(bench->goal));
      sb_cells_text(&bench->cells, rect.x + 1, rect.y + 1, rect.width - 2, effect,
                    sb_bench_pen(bench, SB_ROLE_SECOND, 0));
    }
  }
  if (bench->input == SB_INPUT_SEARCH) {
    sb_screen_cursor(bench->screen, rect.x + 3 + bench->caret, rect.y + 1);
  }
}

// The text in a field while it is typed, so that the caret stays in sight.
static void draw_typed(SbBench *bench, int x, int y, int width) {
  const SbPen pen = {bench->theme.role[SB_ROLE_INK], bench->theme.role[SB_ROLE_HAIRLINE],
                     SB_CELL_UNDERLINE};
  const int first = MAX(bench->caret - width + 1, 0);
  sb_cells_fill(&bench->cells, (SbCellRect){x, y, width, 1}, ' ', pen);
  const char *from = g_utf8_offset_to_pointer(bench->typed->str, first);
  sb_cells_text(&bench->cells, x, y, width, from, pen);
  sb_screen_cursor(bench->screen, x + bench->caret - first, y);
}

// One scale for all rows, ends at the largest.
static void draw_effect(SbBench *bench, int x, int y, int id) {
  const int middle = x + EFFECT / 2;
  sb_cells_put(&bench->cells, middle, y, 0x2502, sb_bench_pen(bench, SB_ROLE_AXIS, 0));
  bool former;
  const SbEffects *effects = sb_effect_watch_effects(bench->effects, &former);
  const double share = id >= 0 ? sb_effect_share(effects, bench->goal, id) : NAN;
  if (!isfinite(share)) {
    return;
  }
  const SbColor color = sb_theme_diverging(sb_theme(true), share < 0 ? -0.95 : 0.95);
  const uint32_t ink = former ? bench->theme.role[SB_ROLE_THIRD] : sb_cell_color(color);
  const int longest = 8 * (EFFECT / 2); // eighths of a column on each side of the line
  const int eighths = (int)lround(longest * share);
  sb_cells_bar(&bench->cells, eighths < 0 ? middle : middle + 1, y, eighths,
               (SbPen){ink, SB_CELL_OWN, 0});
}

static void draw_row(SbBench *bench, SbCellRect rect, const SbListRow *row, int y) {
  SbCells *cells = &bench->cells;
  const bool effects = shows_effects(bench, rect.width);
  const int effect = rect.x + rect.width - EFFECT;
  if (row->id == SB_HEADING_ROW) {
    g_autofree char *text = g_strdup_printf("▾ %s", _(row->title));
    sb_cells_text(cells, rect.x + 1, y, rect.width - 2, text,
                  sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD));
    return;
  }
  const SbParamId id = (SbParamId)row->id;
  const SbDocument *document = sb_session_document(bench->session);
  const SbParams params = sb_document_params(document);
  const bool selected = row->id == bench->selected;
  const bool changed = sb_param_is_changed(&params, id);
  const char *rejected = sb_session_rejected(bench->session, id);
  const uint8_t style =
      (uint8_t)((changed ? SB_CELL_BOLD : 0) |
                (selected && sb_screen_colors(bench->screen) == SB_COLORS_NONE ? SB_CELL_REVERSE
                                                                               : 0));
  const bool locked = sb_session_lock(bench->session, id) != NULL;
  const SbRole role = locked ? SB_ROLE_THIRD : SB_ROLE_INK;
  SbPen pen = sb_bench_pen(bench, role, style);
  if (selected) {
    pen.ground = sb_cell_color(sb_color_mix(sb_theme(true)->role[SB_ROLE_BACKGROUND],
                                            sb_theme(true)->role[SB_ROLE_INNER], 0.25));
    sb_cells_fill(cells, (SbCellRect){rect.x, y, rect.width - 1, 1}, ' ', pen);
  }
  if (changed) {
    sb_cells_put(cells, rect.x + 1, y, 0x258e, pen);
  }
  const int columns = effects ? SHORT_VALUE : VALUE;
  const int value = (effects ? effect : rect.x + rect.width - 2) - columns;
  if (effects) {
    draw_effect(bench, effect, y, row->id);
  }
  g_autofree char *text = rejected != NULL ? g_strdup(rejected) : sb_document_text(document, id);
  const int room = columns - MIN(sb_cells_width(cells, text), columns);
  sb_cells_text(cells, rect.x + MARGIN, y, value + room - rect.x - MARGIN - 1,
                sb_translation(sb_param(id)->label), pen);
  if (selected && bench->input == SB_INPUT_VALUE) {
    draw_typed(bench, value, y, columns);
    return;
  }
  if (rejected != NULL) {
    pen.ink = bench->theme.role[SB_ROLE_ERROR];
  }
  sb_cells_text_right(cells, value, y, columns, text, pen);
}

// What there is to say of the selected one: what is wrong, why it is locked, its range and help.
static void draw_foot(SbBench *bench, SbCellRect rect) {
  if (bench->rows->len == 0) {
    sb_cells_text(&bench->cells, rect.x + 1, rect.y, rect.width - 2,
                  bench->search->len > 0 ? _("Nothing has this name.") : _("No value is changed."),
                  sb_bench_pen(bench, SB_ROLE_SECOND, 0));
    return;
  }
  const SbParamId id = (SbParamId)bench->selected;
  const char *error = sb_session_error(bench->session, id);
  const char *lock = sb_session_lock(bench->session, id);
  g_autofree char *range = sb_param_range_shown(id);
  g_autofree char *help =
      sb_param(id)->kind == SB_PARAM_FLAGS || sb_param(id)->kind == SB_PARAM_CHOICE
          ? g_strdup_printf("%s. %s", sb_param(id)->key, sb_param(id)->help)
          : g_strdup_printf("%s. %s", range, sb_param(id)->help);
  const bool wrong = error != NULL;
  bool former;
  const SbEffects *effects = sb_effect_watch_effects(bench->effects, &former);
  g_autofree char *effect = wrong ? NULL : sb_effect_text(effects, bench->goal, id);
  if (effect != NULL && rect.height > 1) {
    sb_cells_text(&bench->cells, rect.x + 1, rect.y, rect.width - 2, effect,
                  sb_bench_pen(bench, SB_ROLE_INK, 0));
    rect.y++;
    rect.height--;
  }
  sb_cells_paragraph(&bench->cells, (SbCellRect){rect.x + 1, rect.y, rect.width - 2, rect.height},
                     wrong          ? error
                     : lock != NULL ? lock
                                    : help,
                     sb_bench_pen(bench, wrong ? SB_ROLE_ERROR : SB_ROLE_SECOND, 0));
}

// What is kept to compare with, a line each at the bottom of `rect`; returns the lines taken.
static int draw_pins(SbBench *bench, SbCellRect rect) {
  const SbChartData *data = sb_session_chart(bench->session);
  const int count = rect.height > 12 ? (int)data->pin_count : 0;
  for (int i = 0; i < count; i++) {
    const SbChartPin *pin = &data->pin[i];
    const SbPen pen = sb_bench_pen(bench, sb_chart_pin_role(pin->look), 0);
    const int y = rect.y + rect.height - count + i;
    sb_cells_text(&bench->cells, rect.x + 1, y, 4, pin->look == 0 ? "╌╌" : "··", pen);
    sb_cells_text(&bench->cells, rect.x + 4, y, rect.width - 5, pin->name, pen);
  }
  return count > 0 ? count + 1 : 0;
}

void sb_bench_draw_list(SbBench *bench, SbCellRect rect) {
  draw_head(bench, rect);
  const int pins = draw_pins(bench, rect);
  rect.height -= pins;
  const int foot = MIN(FOOT, MAX(rect.height - 8, 1));
  const SbCellRect at = {rect.x, rect.y + HEAD, rect.width, MAX(rect.height - HEAD - foot - 1, 1)};
  // The selected row stays in sight, with its heading where that is the line before.
  int row = row_of(bench, bench->selected);
  const int from =
      row > 0 && g_array_index(bench->rows, SbListRow, (guint)row - 1).id < 0 ? row - 1 : row;
  bench->scroll = MIN(bench->scroll, MAX(from, 0));
  bench->scroll = MAX(bench->scroll, row - at.height + 1);
  bench->scroll = CLAMP(bench->scroll, 0, MAX((int)bench->rows->len - at.height, 0));
  for (int y = 0; y < at.height && bench->scroll + y < (int)bench->rows->len; y++) {
    draw_row(bench, at, &g_array_index(bench->rows, SbListRow, (guint)(bench->scroll + y)),
             at.y + y);
  }
  bench->list_at = at;
  draw_foot(bench, (SbCellRect){rect.x, rect.y + rect.height - foot, rect.width, foot});
}
