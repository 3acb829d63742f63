// The pages of studies, and what is shown over a page: help, the verdict's
// reasons, warnings, questions.
#include "app/terminal/workbench_private.h"

#include "app/base/format.h"
#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/export/measured_results.h"
#include "app/session/verdict_text.h"
#include "app/session/worker.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

// Studies ----------------------------------------------------------------------------------------

static void on_study(void *data) {
  SbBench *bench = data;
  const char *why = NULL;
  SbStudy *study = sb_study_job_take(bench->job, &why);
  if (study != NULL) {
    g_free(bench->study);
    bench->study = study;
    g_free(bench->study_hash);
    bench->study_hash = g_steal_pointer(&bench->job_hash);
    sb_bench_status(bench, false, "%s", sb_translation(sb_study_title(study->kind)));
  } else {
    sb_bench_status(bench, true, "%s", why);
  }
  g_clear_pointer(&bench->job, sb_study_job_free);
  g_clear_pointer(&bench->job_hash, g_free);
  sb_bench_changed(bench);
}

void sb_bench_study_start(SbBench *bench) {
  const SbModel *model = sb_session_model(bench->session);
  if (bench->job != NULL) {
    sb_bench_status(bench, true, _("A study is being computed; c cancels it."));
  } else if (model == NULL) {
    sb_bench_status(bench, true, _("The values are inconsistent."));
  } else {
    bench->job_kind = bench->study_kind;
    bench->job_hash = sb_document_sha256(sb_session_document(bench->session));
    bench->job = sb_study_job_start(bench->job_kind, model, on_study, bench);
  }
  sb_bench_changed(bench);
}

bool sb_bench_study_stop(SbBench *bench) {
  if (bench->job != NULL) {
    sb_worker_cancel(bench->job);
  }
  return bench->job != NULL;
}

// What people read in a table's cell.
static void cell_text(char *out, const SbStudyRow *row, const SbStudyColumn *column, double value) {
  const bool own = row->si[0] != '\0';
  const char *si = own ? row->si : column->si, *unit = own ? row->unit : column->unit;
  if (isnan(value)) {
    g_strlcpy(out, "–", SB_FORMAT_MAX);
  } else if (column->digits == 0) {
    sb_format_fixed(out, value, 0);
  } else {
    sb_format_digits(out, sb_quantity_to_shown(value, si, unit), column->digits);
  }
}

static void draw_study_table(SbBench *bench, SbCellRect rect, const SbStudy *study) {
  enum { NAME = 26, WIDTH = 12 };
  SbCells *cells = &bench->cells;
  const SbPen head = sb_bench_pen(bench, SB_ROLE_SECOND, 0);
  const SbPen plain = sb_bench_pen(bench, SB_ROLE_INK, 0);
  sb_cells_text(cells, rect.x, rect.y, NAME, study->row_heading, head);
  const size_t columns = MIN(study->column_count, (size_t)MAX((rect.width - NAME) / WIDTH, 0));
  for (size_t i = 0; i < columns; i++) {
    g_autofree char *name =
        g_strdup_printf("%s%s%s", study->column[i].name,
                        study->column[i].unit[0] != '\0' ? " / " : "", study->column[i].unit);
    sb_cells_text_right(cells, rect.x + NAME + (int)i * WIDTH, rect.y, WIDTH - 1, name, head);
  }
  for (size_t k = 0; k < study->row_count && (int)k + 1 < rect.height; k++) {
    const int y = rect.y + 1 + (int)k;
    sb_cells_text(cells, rect.x, y, NAME - 1, study->row[k].name, plain);
    for (size_t i = 0; i < columns; i++) {
      char text[SB_FORMAT_MAX];
      cell_text(text, &study->row[k], &study->column[i], study->row[k].value[i]);
      sb_cells_text_right(cells, rect.x + NAME + (int)i * WIDTH, y, WIDTH - 1, text, plain);
    }
  }
}

static void draw_study(SbBench *bench, SbCellRect rect) {
  SbCells *cells = &bench->cells;
  const SbStudy *study = bench->study;
  if (study == NULL || study->kind != bench->study_kind) {
    sb_cells_paragraph(cells, rect, _("Not computed yet: Enter computes it, c cancels."),
                       sb_bench_pen(bench, SB_ROLE_SECOND, 0));
    return;
  }
  const int rows = study->row_count > 0 && rect.height >= 24
                       ? MIN((int)study->row_count + 2, rect.height / 3)
                       : 0;
  const int notes = study->note_count > 0 && rect.height >= 16 ? 2 : 0;
  const int charts = rect.height - rows - notes;
  const size_t panels = MIN(study->panel_count, (size_t)MAX(charts / 6, 1));
  const bool beside = rect.width >= 110 && panels > 1;
  const int columns = beside ? 2 : 1;
  const int lines = ((int)panels + columns - 1) / columns;
  for (size_t i = 0; i < panels; i++) {
    const SbCellRect at = {rect.x + (int)i % columns * (rect.width / columns),
                           rect.y + (int)i / columns * (charts / lines),
                           rect.width / columns - (beside ? 2 : 0), charts / lines};
    sb_chart_study(cells, at, &bench->theme, study, i);
  }
  if (rows > 0) {
    draw_study_table(bench, (SbCellRect){rect.x, rect.y + charts, rect.width, rows}, study);
  }
  if (notes > 0) {
    sb_cells_paragraph(cells, (SbCellRect){rect.x, rect.y + rect.height - notes, rect.width, notes},
                       study->note[0], sb_bench_pen(bench, SB_ROLE_SECOND, 0));
  }
}

SbPen sb_bench_row(SbBench *bench, int x, int y, int width, bool chosen) {
  const bool plain = sb_screen_colors(bench->screen) == SB_COLORS_NONE;
  SbPen pen = sb_bench_pen(bench, SB_ROLE_INK,
                           (uint8_t)(chosen ? SB_CELL_BOLD | (plain ? SB_CELL_REVERSE : 0) : 0));
  pen.ground = chosen ? bench->theme.role[SB_ROLE_HAIRLINE] : bench->theme.ground;
  sb_cells_fill(&bench->cells, (SbCellRect){x, y, width, 1}, ' ', pen);
  return pen;
}

void sb_bench_draw_progress(SbBench *bench, int x, int y, int width, const char *title,
                            double share) {
  g_autofree char *text = g_strdup_printf("%s %.0f %%", title, 100 * share);
  sb_cells_text(&bench->cells, x, y, width, text, sb_bench_pen(bench, SB_ROLE_NOW, SB_CELL_BOLD));
  sb_cells_bar(&bench->cells, x, y + 1, (int)lround(8 * share * width),
               sb_bench_pen(bench, SB_ROLE_NOW, 0));
}

// How far it is, or whether it is of other values.
static void draw_study_state(SbBench *bench, SbCellRect rect) {
  g_autofree char *now = sb_document_sha256(sb_session_document(bench->session));
  if (bench->job != NULL) {
    sb_bench_draw_progress(bench, rect.x, rect.y, rect.width,
                           sb_translation(sb_study_title(bench->job_kind)),
                           sb_worker_progress(bench->job));
  } else if (bench->study != NULL && bench->study->kind == bench->study_kind &&
             g_strcmp0(now, bench->study_hash) != 0) {
    sb_cells_text(&bench->cells, rect.x, rect.y, rect.width, _("of earlier values"),
                  sb_bench_pen(bench, SB_ROLE_WARN, SB_CELL_BOLD));
  } else if (bench->study != NULL && bench->study->kind == bench->study_kind) {
    g_autofree char *text = g_strdup_printf("%zu solves", bench->study->solves);
    sb_cells_text(&bench->cells, rect.x, rect.y, rect.width,
                  bench->study->complete ? text : _("A solver did not converge everywhere."),
                  sb_bench_pen(bench, SB_ROLE_SECOND, 0));
  }
}

static void draw_studies(SbBench *bench, SbCellRect rect) {
  enum { LIST = 38 };
  SbCells *cells = &bench->cells;
  sb_cells_text(cells, 1, rect.y, LIST - 2, _("Studies of this valve"),
                sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD));
  for (int i = 0; i < SB_STUDY_COUNT; i++) {
    const SbPen pen = sb_bench_row(bench, 0, rect.y + 2 + i, LIST - 1, i == (int)bench->study_kind);
    sb_cells_text(cells, 2, rect.y + 2 + i, LIST - 4,
                  sb_translation(sb_study_title((SbStudyKind)i)), pen);
  }
  const int y = rect.y + SB_STUDY_COUNT + 3;
  draw_study_state(bench, (SbCellRect){1, y, LIST - 3, 2});
  sb_cells_paragraph(cells, (SbCellRect){1, y + 3, LIST - 3, MAX(rect.y + rect.height - y - 3, 0)},
                     sb_translation(sb_study_help(bench->study_kind)),
                     sb_bench_pen(bench, SB_ROLE_SECOND, 0));
  for (int row = rect.y; row < rect.y + rect.height; row++) {
    sb_cells_put(cells, LIST, row, 0x2502, sb_bench_pen(bench, SB_ROLE_AXIS, 0));
  }
  draw_study(bench, (SbCellRect){LIST + 2, rect.y, rect.width - LIST - 4, rect.height});
}

static void draw_propellants(SbBench *bench, SbCellRect rect) {
  draw_study_state(bench, (SbCellRect){1, rect.y, rect.width - 2, 2});
  draw_study(bench, (SbCellRect){2, rect.y + 2, rect.width - 4, rect.height - 2});
}

void sb_bench_draw_page(SbBench *bench, SbCellRect rect) {
  switch (bench->page) {
  case SB_PAGE_DESIGN:
    sb_bench_draw_design(bench, rect);
    break;
  case SB_PAGE_CALIBRATE:
    sb_bench_draw_calibrate(bench, rect);
    break;
  case SB_PAGE_PROPELLANTS:
    draw_propellants(bench, rect);
    break;
  case SB_PAGE_STUDIES:
    draw_studies(bench, rect);
    break;
  default:
    sb_bench_draw_valve(bench, rect);
  }
}

// Over the page ----------------------------------------------------------------------------------

static const char *const help[] = {
    N_("↑ ↓ PgUp PgDn   choose a row of the list"),
    N_("← →             step its value; Shift: a tenth, Ctrl: ten steps"),
    N_("⏎               type a value: 1.63, 1,63, 1.63 mm, +5 %, 1.7/2 mm, 60 Shore A"),
    N_("Backspace       the value of the valve, or the default, again"),
    N_("Tab             main, changed or all parameters; / searches"),
    N_("u  Ctrl-R       undo and redo"),
    N_("space           play and stop; , . a frame, [ ] an event"),
    N_("p  P            pin the loop, remove the last pin"),
    N_("m               closed form or solved rings"),
    N_("e               the figure whose effects are shown"),
    N_("f  i            field of the section, inset"),
    N_("v  w            verdict and warnings in words"),
    N_("1 2 3 4 5       valve, design, calibrate, propellants, studies"),
    N_("⏎  c  a  b      there: compute, cancel, use the best design or the estimates, bounds"),
    N_("s  S  o         save, save as, open"),
    N_("x               export: .json, .txt of this screen, a picture or movie of a view"),
    N_("Ctrl-L          redraw the screen; Ctrl-Z suspend"),
    N_("q               quit"),
};

// Appends the warnings, serious ones first.
static void append_warnings(GString *text, const SbWarnings *warnings) {
  for (int pass = 1; pass >= 0; pass--) {
    for (size_t i = 0; i < warnings->count; i++) {
      const SbWarning *warning = &warnings->item[i];
      if (warning->serious == (pass == 1)) {
        g_string_append_printf(text, "%s: %s%s%s%s\n\n", warning->code, warning->text,
                               warning->input != 0 ? " (" : "", sb_input_key(warning->input),
                               warning->input != 0 ? ")" : "");
      }
    }
  }
}

// Names the file whose changes were not saved, and the choices.
static void append_restore(GString *text, const SbBench *bench) {
  g_auto(SbUnsaved) unsaved = {0};
  (void)sb_autosave_read(&unsaved, bench->orphan);
  g_autofree char *name = unsaved.path != NULL ? sb_printable(unsaved.path, strlen(unsaved.path))
                                               : g_strdup(_("Untitled"));
  g_string_append_printf(text, "%s\n\n", name);
  g_string_append(text, _("Sealbench ended before they were saved.\n\ny  restore\nd  discard\n"
                          "Esc  later"));
}

static char *popup_text(SbBench *bench, const char **title) {
  GString *text = g_string_new(NULL);
  const SbSummary *summary = sb_session_summary(bench->session);
  switch (bench->popup) {
  case SB_POPUP_HELP:
    *title = _("Keys");
    for (size_t i = 0; i < G_N_ELEMENTS(help); i++) {
      g_string_append_printf(text, "%s\n", _(help[i]));
    }
    break;
  case SB_POPUP_VERDICT:
    *title = _("Verdict");
    for (int i = 0; summary != NULL && i < SB_VERDICT_COUNT; i++) {
      const SbCaseVerdict verdict = sb_bench_verdict(bench, i);
      g_autofree char *why = sb_verdict_why(summary, i, &verdict.of);
      g_string_append(text, why);
      if (verdict.name != NULL) {
        g_string_append_printf(text, _("\nCase: %s."), verdict.name);
      }
      g_string_append(text, "\n\n");
    }
    break;
  case SB_POPUP_WARNINGS:
    *title = _("Warnings");
    if (summary != NULL) {
      append_warnings(text, &summary->warnings);
    }
    break;
  case SB_POPUP_LINES:
    *title = _("Message");
    g_string_assign(text, bench->lines);
    break;
  case SB_POPUP_QUIT:
    *title = _("Unsaved changes");
    g_string_assign(text, _("s  save and quit\nd  discard the changes and quit\nEsc  continue"));
    break;
  case SB_POPUP_RESTORE:
    *title = _("Restore unsaved changes?");
    append_restore(text, bench);
    break;
  case SB_POPUP_DISK:
    *title = _("Another program has changed the file");
    g_string_assign(text, _("r  reload: show the file, undo your changes\n"
                            "m  merge the file's changes and yours, value by value\n"
                            "b  keep both: your version becomes a new file next to it\n"
                            "o  overwrite the file with your version\n"
                            "Esc  decide later\n\nu undoes a reload or a merge."));
    break;
  default:
    *title = "";
  }
  if (text->len == 0) {
    g_string_assign(text, _("No complete run is displayed yet."));
  }
  return g_string_free(text, FALSE);
}

void sb_bench_draw_popup(SbBench *bench) {
  if (bench->popup == SB_POPUP_NONE) {
    return;
  }
  SbCells *cells = &bench->cells;
  const char *title;
  g_autofree char *text = popup_text(bench, &title);
  const int width = MIN(80, cells->columns - 4);
  // Once to see how long it is, then in its place, scrolled.
  enum { LINES = 400 };
  SbCells page;
  sb_cells_init(&page, width - 4, LINES, cells->ascii);
  const SbPen pen = {bench->theme.role[SB_ROLE_INK], bench->theme.role[SB_ROLE_PANEL], 0};
  int lines = 0;
  g_auto(GStrv) each = g_strsplit(g_strchomp(text), "\n", 0);
  for (char **line = each; *line != NULL && lines < LINES; line++) {
    const int used =
        sb_cells_paragraph(&page, (SbCellRect){0, lines, width - 4, LINES - lines}, *line, pen);
    lines += MAX(used, 1);
  }
  const int height = MIN(lines + 4, cells->rows - 4);
  const SbCellRect at = {(cells->columns - width) / 2, (cells->rows - height) / 2, width, height};
  bench->popup_scroll = CLAMP(bench->popup_scroll, 0, MAX(lines - (height - 4), 0));
  sb_cells_fill(cells, at, ' ', pen);
  sb_cells_frame(cells, at, sb_bench_pen(bench, SB_ROLE_SECOND, 0));
  g_autofree char *head = g_strdup_printf(" %s ", title);
  sb_cells_text(cells, at.x + 2, at.y, width - 4, head, (SbPen){pen.ink, pen.ground, SB_CELL_BOLD});
  for (int y = 0; y < height - 4; y++) {
    for (int x = 0; x < width - 4; x++) {
      const uint32_t glyph = sb_cells_at(&page, x, bench->popup_scroll + y);
      if (glyph != 0 && glyph != ' ') {
        sb_cells_put(cells, at.x + 2 + x, at.y + 2 + y, glyph, pen);
      }
    }
  }
  if (lines > height - 4) {
    sb_cells_text_right(cells, at.x, at.y + height - 1, width - 2, _(" ↑ ↓ more "), pen);
  }
  sb_cells_finish(&page);
}
