// The workbench in a terminal: its life, when it draws, and the frame of every page. See
// workbench.h. A picture of the screen is made when something changed and the line has taken the
// one before, at most 60 times a second; only cells that differ are sent (screen_output.c).
#include "app/terminal/workbench_private.h"

#include "app/base/translation.h"
#include "app/document/shipped.h"

#include <glib/gi18n.h>
#include <locale.h>
#include <string.h>

enum {
  LEAST_COLUMNS = 40, // below that nothing can be told
  LEAST_ROWS = 10,
  TICK_MS = 33 // while something moves
};

SbPen sb_bench_pen(const SbBench *bench, SbRole role, uint8_t style) {
  return (SbPen){bench->theme.role[role], SB_CELL_OWN, style};
}

void sb_bench_status(SbBench *bench, bool fails, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_free(bench->message);
  bench->message = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  bench->message_fails = fails;
  sb_bench_changed(bench);
}

void sb_bench_end(SbBench *bench) {
  bench->ended = true;
  g_main_loop_quit(bench->loop);
}

// Drawing ----------------------------------------------------------------------------------------

// A key in the last row; `ascii` NULL: the same in an ASCII grid.
typedef struct {
  const char *key, *ascii, *word;
} KeyHint;

static const KeyHint valve_hints[] = {
    {"↑↓", "Up/Dn", N_("row")}, {"←→", "Lf/Rt", N_("value")}, {"⏎", "Enter", N_("type")},
    {"␣", "Spc", N_("play")},   {"[ ]", NULL, N_("event")},   {"p", NULL, N_("pin")},
    {"m", NULL, N_("model")},   {"e", NULL, N_("effect")},    {"v", NULL, N_("verdict")},
    {"x", NULL, N_("export")},  {"?", NULL, N_("help")},      {"q", NULL, N_("quit")}};
static const KeyHint design_hints[] = {{"↑↓", "Up/Dn", N_("row")},    {"←→", "Lf/Rt", N_("switch")},
                                       {"⏎", "Enter", N_("compute")}, {"b", NULL, N_("bounds")},
                                       {"c", NULL, N_("cancel")},     {"a", NULL, N_("apply")},
                                       {"e", NULL, N_("effect")},     {"u", NULL, N_("undo")},
                                       {"?", NULL, N_("help")},       {"q", NULL, N_("quit")}};
static const KeyHint calibrate_hints[] = {
    {"↑↓", "Up/Dn", N_("row")}, {"←→", "Lf/Rt", N_("switch")}, {"⏎", "Enter", N_("compute")},
    {"c", NULL, N_("cancel")},  {"a", NULL, N_("apply")},      {"u", NULL, N_("undo")},
    {"?", NULL, N_("help")},    {"q", NULL, N_("quit")}};
static const KeyHint study_hints[] = {{"↑↓", "Up/Dn", N_("row")},
                                      {"⏎", "Enter", N_("compute")},
                                      {"c", NULL, N_("cancel")},
                                      {"?", NULL, N_("help")},
                                      {"q", NULL, N_("quit")}};

static const struct {
  const KeyHint *hint;
  size_t count;
} hints_of[SB_PAGE_COUNT] = {
    [SB_PAGE_VALVE] = {valve_hints, G_N_ELEMENTS(valve_hints)},
    [SB_PAGE_DESIGN] = {design_hints, G_N_ELEMENTS(design_hints)},
    [SB_PAGE_CALIBRATE] = {calibrate_hints, G_N_ELEMENTS(calibrate_hints)},
    [SB_PAGE_PROPELLANTS] = {study_hints, G_N_ELEMENTS(study_hints)},
    [SB_PAGE_STUDIES] = {study_hints, G_N_ELEMENTS(study_hints)},
};

static const char *hint_key(const SbBench *bench, const KeyHint *hint) {
  return bench->cells.ascii && hint->ascii != NULL ? hint->ascii : hint->key;
}

static void draw_keys(SbBench *bench, int y) {
  const KeyHint *hint = hints_of[bench->page].hint;
  const size_t count = hints_of[bench->page].count;
  SbCells *cells = &bench->cells;
  int need = 0;
  for (size_t i = 0; i < count; i++) {
    need += sb_cells_width(cells, hint_key(bench, &hint[i])) +
            sb_cells_width(cells, _(hint[i].word)) + 1;
  }
  // Short of room, the arrows and the next keys go without words, more of them if need be, so that
  // help and quit have theirs.
  enum { FIRST = 5, LAST = 2 };
  size_t wordless = 0;
  while (wordless < count - LAST &&
         (cells->columns - 2 - need < (int)count - 1 || (wordless > 0 && wordless < FIRST))) {
    need -= sb_cells_width(cells, _(hint[wordless++].word)) + 1;
  }
  const int gap = CLAMP((cells->columns - 2 - need) / ((int)count - 1), 1, 3);
  int x = 1;
  for (size_t i = 0; i < count && x < cells->columns; i++) {
    x += sb_cells_text(cells, x, y, cells->columns - x, hint_key(bench, &hint[i]),
                       sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD));
    if (i >= wordless) {
      x += 1 + sb_cells_text(cells, x + 1, y, cells->columns - x - 1, _(hint[i].word),
                             sb_bench_pen(bench, SB_ROLE_SECOND, 0));
    }
    x += gap;
  }
}

// A line that is typed for something else than a field of the list.
static void draw_question(SbBench *bench, int y) {
  const char *question = bench->input == SB_INPUT_SAVE     ? _("Save as: ")
                         : bench->input == SB_INPUT_EXPORT ? _("Export to, then a view: ")
                         : bench->input == SB_INPUT_BOUNDS ? _("Bounds: ")
                                                           : _("Open: ");
  SbCells *cells = &bench->cells;
  const int x = 1 + sb_cells_text(cells, 1, y, cells->columns - 2, question,
                                  sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD));
  const int room = MAX(cells->columns - x - 1, 1), first = MAX(bench->caret - room + 1, 0);
  sb_cells_text(cells, x, y, room, g_utf8_offset_to_pointer(bench->typed->str, first),
                sb_bench_pen(bench, SB_ROLE_INK, 0));
  sb_screen_cursor(bench->screen, x + bench->caret - first, y);
}

static void compose(SbBench *bench) {
  SbCells *cells = &bench->cells;
  const int columns = sb_screen_columns(bench->screen), rows = sb_screen_rows(bench->screen);
  if (cells->columns != columns || cells->rows != rows) {
    sb_cells_finish(cells);
    sb_cells_init(cells, columns, rows, sb_screen_ascii(bench->screen));
  }
  const SbPen ground = {bench->theme.role[SB_ROLE_INK], bench->theme.ground, 0};
  sb_cells_fill(cells, (SbCellRect){0, 0, columns, rows}, ' ', ground);
  sb_screen_cursor(bench->screen, -1, -1);
  if (bench->pixels != NULL) {
    g_string_free(bench->pixels, TRUE);
    bench->pixels = NULL;
  }
  bench->list_at = bench->timeline_at = (SbCellRect){0, 0, 0, 0};
  if (columns < LEAST_COLUMNS || rows < LEAST_ROWS) {
    g_autofree char *least =
        g_strdup_printf(_("Too small: %d x %d at least"), LEAST_COLUMNS, LEAST_ROWS);
    sb_cells_text(cells, 0, 0, columns, least, ground);
    return;
  }
  sb_bench_draw_header(bench);
  sb_bench_draw_verdict(bench, 1);
  for (int x = 0; x < columns; x++) {
    sb_cells_put(cells, x, 2, 0x2500, sb_bench_pen(bench, SB_ROLE_AXIS, 0));
  }
  sb_bench_draw_page(bench, (SbCellRect){0, 3, columns, rows - 5});
  sb_bench_draw_status(bench, rows - 2);
  if (bench->input > SB_INPUT_SEARCH) {
    draw_question(bench, rows - 1);
  } else {
    draw_keys(bench, rows - 1);
  }
  sb_bench_draw_popup(bench);
}

static gboolean on_draw(gpointer data) {
  SbBench *bench = data;
  bench->draw = 0;
  if (!sb_screen_is_behind(bench->screen)) {
    compose(bench);
    sb_screen_show(bench->screen, &bench->cells, bench->pixels, bench->pixels_at);
    if (!bench->begun) {
      bench->begun = true;
      sb_bench_changed(bench); // with the section
    }
  }
  return G_SOURCE_REMOVE;
}

// Whether something is under way that tells how far it is.
static bool is_busy(const void *data) {
  const SbBench *bench = data;
  return bench->job != NULL || bench->design.job != NULL || bench->calibrate.job != NULL ||
         bench->export != NULL;
}

static gboolean on_tick(gpointer data) {
  SbBench *bench = data;
  sb_session_tick(bench->session, g_get_monotonic_time());
  if (is_busy(bench)) {
    sb_bench_changed(bench);
  }
  if (sb_session_wants_ticks(bench->session) || is_busy(bench)) {
    return G_SOURCE_CONTINUE;
  }
  bench->tick = 0;
  return G_SOURCE_REMOVE;
}

void sb_bench_changed(SbBench *bench) {
  if (bench->draw == 0 && !bench->ended) {
    bench->draw = g_idle_add(on_draw, bench);
  }
  if (bench->tick == 0 && (sb_session_wants_ticks(bench->session) || is_busy(bench))) {
    bench->tick = g_timeout_add(TICK_MS, on_tick, bench);
  }
}

// Life -------------------------------------------------------------------------------------------

static void on_key(void *data, const SbKey *key) {
  sb_bench_key(data, key);
}

static void on_screen(void *data) {
  sb_bench_changed(data);
}

// Nobody is there to be asked: what is unsaved stays for the next start.
static void on_end(void *data) {
  SbBench *bench = data;
  if (!bench->ended) {
    sb_autosave_leave(bench->autosave);
    sb_bench_end(bench);
  }
}

static void on_effects(void *data) {
  sb_bench_changed(data);
}

static void on_params(SbBench *bench) {
  if (bench->list == SB_LIST_CHANGED && bench->input == SB_INPUT_NONE) {
    sb_bench_list(bench);
  }
  sb_bench_design_follow(bench);
  sb_bench_calibrate_follow(bench);
  sb_bench_changed(bench);
}

static void on_cases(void *data) {
  sb_bench_changed(data);
}

// The verdict takes the worst of the scene's cases, once its own run is whole.
static void judge_cases(SbBench *bench) {
  const SbDocument *document = sb_session_document(bench->session);
  const bool whole =
      sb_session_may_keep(bench->session) && !sb_session_is_stale(bench->session, NULL, NULL);
  if (bench->cases != NULL && sb_cases_job_run(bench->cases) != sb_session_run(bench->session)) {
    g_clear_pointer(&bench->cases, sb_cases_job_free);
  }
  SbRunHandle *handle = whole && bench->cases == NULL && sb_document_case_count(document) > 0
                            ? sb_session_handle(bench->session)
                            : NULL;
  if (handle != NULL) {
    bench->cases = sb_cases_job_start(handle, document, on_cases, bench);
  }
}

static void on_run(SbBench *bench) {
  judge_cases(bench);
  sb_section_source_forget(bench->source);
  sb_bench_changed(bench);
}

static gboolean on_restore(gpointer data) {
  SbBench *bench = data;
  bench->orphan = sb_autosave_find();
  if (bench->orphan != NULL && bench->popup == SB_POPUP_NONE &&
      !sb_session_is_modified(bench->session)) {
    bench->popup = SB_POPUP_RESTORE;
    sb_bench_changed(bench);
  }
  return G_SOURCE_REMOVE;
}

static void translate(void) {
  // Words in the user's language; numbers are the same everywhere.
  setlocale(LC_CTYPE, "");
  setlocale(LC_MESSAGES, "");
  sb_translation_begin();
}

static bool open_file(SbBench *bench, const SbWorkbenchOptions *options) {
  const char *path = options->path;
  g_autofree char *file = path != NULL ? sb_shipped_resolve(path, SB_SHIPPED_FOR_RUN)
                                       : sb_shipped_find("piston", SB_SHIPPED_FOR_RUN);
  // Without an operand and without shipped files the session stays an empty valve.
  return file == NULL || (sb_session_open(bench->session, file, options->issues) &&
                          !sb_session_is_faulty(bench->session));
}

static void finish(SbBench *bench) {
  sb_screen_close(bench->screen);
  const guint sources[] = {bench->tick, bench->draw};
  for (size_t i = 0; i < G_N_ELEMENTS(sources); i++) {
    if (sources[i] != 0) {
      g_source_remove(sources[i]);
    }
  }
  g_signal_handlers_disconnect_by_data(bench->session, bench);
  g_clear_pointer(&bench->job, sb_study_job_free);
  sb_bench_design_finish(bench);
  sb_bench_calibrate_finish(bench);
  g_clear_pointer(&bench->export, sb_export_job_free);
  g_clear_pointer(&bench->cases, sb_cases_job_free);
  g_clear_pointer(&bench->effects, sb_effect_watch_free);
  sb_autosave_free(bench->autosave);
  sb_section_source_free(bench->source);
  sb_draw_list_finish(&bench->drawing);
  sb_text_destroy(bench->text);
  g_object_unref(bench->session);
  g_main_loop_unref(bench->loop);
  sb_cells_finish(&bench->cells);
  g_array_unref(bench->rows);
  g_string_free(bench->search, TRUE);
  g_string_free(bench->typed, TRUE);
  if (bench->pixels != NULL) {
    g_string_free(bench->pixels, TRUE);
  }
  g_free(bench->message);
  g_free(bench->lines);
  g_free(bench->orphan);
  g_free(bench->study);
  g_free(bench->study_hash);
  g_free(bench->job_hash);
}

bool sb_workbench_run(const SbWorkbenchOptions *options, GError **error) {
  if (!sb_screen_is_possible(error)) { // before there are threads
    return false;
  }
  translate();
  SbBench bench = {.session = sb_session_new(),
                   .loop = g_main_loop_new(NULL, FALSE),
                   .rows = g_array_new(FALSE, FALSE, sizeof(SbListRow)),
                   .search = g_string_new(NULL),
                   .typed = g_string_new(NULL),
                   .text = sb_text_create(),
                   .study_kind = SB_STUDY_SQUEEZE};
  sb_cells_init(&bench.cells, 1, 1, false);
  sb_cell_theme(&bench.theme, false);
  sb_draw_list_init(&bench.drawing);
  bench.source = sb_section_source_new(bench.session);
  bench.autosave = sb_autosave_new(bench.session);
  sb_session_set_play_duration(bench.session, SB_PLAY_S);
  sb_session_set_loops(bench.session, TRUE);
  const SbScreenClient client = {.key = on_key, .draw = on_screen, .end = on_end, .data = &bench};
  const bool good = open_file(&bench, options) &&
                    (bench.screen = sb_screen_open(&options->screen, &client, error)) != NULL;
  if (good) {
    if (sb_screen_colors(bench.screen) == SB_COLORS_NONE) {
      bench.theme.ground = SB_CELL_OWN;
    }
    const SbModel *model = sb_session_model(bench.session);
    bench.field = model != NULL ? (SbField)sb_model_look(model)->field : SB_FIELD_VON_MISES;
    g_signal_connect_swapped(bench.session, "params-changed", G_CALLBACK(on_params), &bench);
    g_signal_connect_swapped(bench.session, "run-changed", G_CALLBACK(on_run), &bench);
    g_signal_connect_swapped(bench.session, "frames-changed", G_CALLBACK(sb_bench_changed), &bench);
    g_signal_connect_swapped(bench.session, "progress-changed", G_CALLBACK(sb_bench_changed),
                             &bench);
    g_signal_connect_swapped(bench.session, "playhead-changed", G_CALLBACK(sb_bench_changed),
                             &bench);
    sb_bench_list(&bench);
    sb_bench_design_follow(&bench);
    sb_calibrate_ask_init(&bench.calibrate.ask);
    sb_bench_calibrate_follow(&bench);
    bench.effects = sb_effect_watch_new(bench.session, on_effects, is_busy, &bench);
    sb_bench_changed(&bench);
    g_timeout_add(300, on_restore, &bench);
    g_main_loop_run(bench.loop);
  }
  finish(&bench);
  return good;
}
