// Sheets by cairo and pango, each place from what was drawn before it.
#include "app/export/report_pages.h"

#include "app/export/pdf.h"

#include <cairo-pdf.h>
#include <math.h>
#include <string.h>

#define TOP       56.0
#define BOTTOM    64.0 // of the foot, below the last line
#define CELL      11.0 // type of tables
#define ROW_ABOVE 4.0
#define ROW_BELOW 4.0
#define GAP       10.0 // between columns

struct SbReportPages {
  SbPdf pdf;
  cairo_t *cr;
  SbCanvas canvas;
  const SbReportTexts *texts;
  const SbReportHooks *hooks;
  double width, height; // of this page
  double y;
  bool counting, across, stopped;
  int page, count;
};

// Returns the width between the margins of the present page.
static double width_of(const SbReportPages *pages) {
  return pages->width - 2 * SB_REPORT_MARGIN;
}

double sb_report_left(const SbReportPages *pages) {
  return pages->height - BOTTOM - pages->y;
}

static SbTextStyle style_of(SbReportPages *pages, double size, int weight, SbRole role) {
  return sb_canvas_style(&pages->canvas, size, weight, role);
}

// ---- Sheets ----

static void draw_foot(SbReportPages *pages) {
  const double left = SB_REPORT_MARGIN, right = pages->width - SB_REPORT_MARGIN;
  const double y = pages->height - 34;
  SbCanvas *c = &pages->canvas;
  sb_canvas_hairline(c, left, y - 16, right, y - 16, sb_canvas_role(c, SB_ROLE_HAIRLINE));
  const SbTextStyle style = style_of(pages, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  g_autofree char *number = g_strdup_printf("page %d of %d", pages->page, pages->count);
  const double width = sb_canvas_text(c, number, &style, right, y, SB_RIGHT);
  sb_canvas_text_fit(c, pages->texts->foot, &style, left, y, right - left - width - 24);
  // The first page has the title itself.
  if (pages->page > 1) {
    const SbTextStyle head = style_of(pages, SB_TYPE_NOTE, 600, SB_ROLE_SECOND);
    sb_canvas_text_fit(c, pages->texts->title, &head, left, 34, right - left);
  }
}

static void end_page(SbReportPages *pages) {
  if (pages->page == 0) {
    return;
  }
  draw_foot(pages);
  cairo_surface_show_page(pages->pdf.surface);
  if (!pages->counting && pages->hooks != NULL && pages->hooks->page != NULL) {
    pages->stopped |= pages->hooks->page(pages->hooks->data, pages->page, pages->count);
  }
}

void sb_report_page(SbReportPages *pages, bool across) {
  end_page(pages);
  pages->across = across;
  pages->width = across ? SB_REPORT_HEIGHT : SB_REPORT_WIDTH;
  pages->height = across ? SB_REPORT_WIDTH : SB_REPORT_HEIGHT;
  cairo_pdf_surface_set_size(pages->pdf.surface, pages->width * SB_PDF_POINTS,
                             pages->height * SB_PDF_POINTS);
  pages->page++;
  pages->y = TOP;
}

// Begins another page of the same orientation if less than `height` is left on the present one.
static void ensure_room(SbReportPages *pages, double height) {
  if (sb_report_left(pages) < height) {
    sb_report_page(pages, pages->across);
  }
}

void sb_report_skip(SbReportPages *pages, double height) {
  pages->y += height;
}

// One time through; the number of pages.
static int pass(SbReportPages *pages, SbReportDraw draw, const void *of) {
  const SbPdfTexts texts = {pages->texts->title, pages->texts->comment, pages->texts->hash};
  sb_pdf_begin(&pages->pdf, SB_REPORT_WIDTH, SB_REPORT_HEIGHT, &texts);
  pages->cr = cairo_create(pages->pdf.surface);
  cairo_scale(pages->cr, SB_PDF_POINTS, SB_PDF_POINTS);
  sb_canvas_init(&pages->canvas, pages->cr, sb_theme(false));
  pages->page = 0;
  sb_report_page(pages, false);
  draw(pages, of);
  end_page(pages);
  sb_canvas_finish(&pages->canvas);
  return pages->page;
}

bool sb_report_pages_write(FILE *stream, const SbReportTexts *texts, SbReportDraw draw,
                           const void *of, const SbReportHooks *hooks, GError **error) {
  SbReportPages pages = {.texts = texts, .hooks = hooks, .counting = true};
  pages.count = pass(&pages, draw, of);
  cairo_destroy(pages.cr);
  (void)sb_pdf_finish(&pages.pdf, NULL, NULL);
  pages.counting = false;
  (void)pass(&pages, draw, of);
  const cairo_status_t status = cairo_status(pages.cr);
  cairo_destroy(pages.cr);
  if (pages.stopped || status != CAIRO_STATUS_SUCCESS) {
    (void)sb_pdf_finish(&pages.pdf, NULL, NULL);
    g_set_error(error, SB_APP_ERROR, pages.stopped ? SB_APP_ERROR_CANCELLED : SB_APP_ERROR_IO,
                pages.stopped ? "interrupted: nothing was written"
                              : "the pages could not be drawn: %s",
                cairo_status_to_string(status));
    return false;
  }
  return sb_pdf_finish(&pages.pdf, stream, error);
}

// ---- Texts ----

void sb_report_title(SbReportPages *pages, const char *title, const char *line) {
  SbCanvas *c = &pages->canvas;
  const SbTextStyle big = style_of(pages, SB_TYPE_TITLE, 700, SB_ROLE_INK);
  const SbTextStyle small = style_of(pages, 13, 400, SB_ROLE_SECOND);
  const double width = width_of(pages);
  pages->y += sb_canvas_paragraph(c, title, &big, SB_REPORT_MARGIN, pages->y - 8, width);
  pages->y += 4 + sb_canvas_paragraph(c, line, &small, SB_REPORT_MARGIN, pages->y, width);
  if (!pages->counting) {
    cairo_pdf_surface_add_outline(pages->pdf.surface, CAIRO_PDF_OUTLINE_ROOT,
                                  pages->texts->bookmark, "page=1 pos=[0 0]",
                                  CAIRO_PDF_OUTLINE_FLAG_OPEN);
  }
}

void sb_report_heading(SbReportPages *pages, const char *text, double follows) {
  SbCanvas *c = &pages->canvas;
  ensure_room(pages, 44 + follows);
  pages->y += pages->y > TOP ? 22 : 0;
  const SbTextStyle style = style_of(pages, SB_TYPE_PANEL, 700, SB_ROLE_INK);
  sb_canvas_text(c, text, &style, SB_REPORT_MARGIN, pages->y + 14, SB_LEFT);
  if (!pages->counting) {
    g_autofree char *place = g_strdup_printf("page=%d", pages->page);
    cairo_pdf_surface_add_outline(pages->pdf.surface, CAIRO_PDF_OUTLINE_ROOT, text, place, 0);
  }
  pages->y += 26;
}

void sb_report_text(SbReportPages *pages, const char *text, double size, int weight, SbRole role) {
  const SbTextStyle style = style_of(pages, size, weight, role);
  const double width = width_of(pages);
  ensure_room(pages, sb_canvas_paragraph_height(&pages->canvas, text, &style, width) +
                         (weight >= 700 ? 60 : 0));
  pages->y +=
      4 + sb_canvas_paragraph(&pages->canvas, text, &style, SB_REPORT_MARGIN, pages->y, width);
}

void sb_report_notice(SbReportPages *pages, const char *text, bool error) {
  SbCanvas *c = &pages->canvas;
  const SbTextStyle style =
      style_of(pages, SB_TYPE_LABEL, 600, error ? SB_ROLE_ERROR : SB_ROLE_WARN);
  const double width = width_of(pages) - 24;
  const double height = sb_canvas_paragraph_height(c, text, &style, width) + 12;
  ensure_room(pages, height + 6);
  sb_canvas_rounded(c, (SbRect){SB_REPORT_MARGIN, pages->y, width + 24, height}, 4);
  sb_canvas_color(c, sb_canvas_role(c, error ? SB_ROLE_ERROR_GROUND : SB_ROLE_WARN_GROUND), 1);
  cairo_fill(pages->cr);
  sb_canvas_paragraph(c, text, &style, SB_REPORT_MARGIN + 12, pages->y + 6, width);
  pages->y += height + 6;
}

// ---- Pictures ----

static void draw_in(SbReportPages *pages, SbRect rect, SbReportPicture draw, const void *of) {
  if (pages->counting || of == NULL) {
    return;
  }
  cairo_save(pages->cr);
  draw(pages->cr, rect, pages->canvas.theme, of);
  cairo_restore(pages->cr);
  cairo_new_path(pages->cr);
}

void sb_report_picture(SbReportPages *pages, double height, SbReportPicture draw, const void *of) {
  ensure_room(pages, height);
  draw_in(pages, (SbRect){SB_REPORT_MARGIN, pages->y, width_of(pages), height}, draw, of);
  pages->y += height + 12;
}

void sb_report_pair(SbReportPages *pages, double height, SbReportPicture draw, const void *left,
                    const void *right) {
  ensure_room(pages, height);
  const double width = 0.5 * (width_of(pages) - 12);
  draw_in(pages, (SbRect){SB_REPORT_MARGIN, pages->y, width, height}, draw, left);
  draw_in(pages, (SbRect){SB_REPORT_MARGIN + width + 12, pages->y, width, height}, draw, right);
  pages->y += height + 12;
}

// ---- Tables ----

// The columns of a table that a page has, and the table's first row of cells.
typedef struct {
  size_t count, index[SB_REPORT_COLUMNS];
  double width[SB_REPORT_COLUMNS];
  bool right[SB_REPORT_COLUMNS]; // the first row has a number there
  const char *head[SB_REPORT_COLUMNS];
  bool headed;
} Columns;

static Columns columns_of(const SbReportPages *pages, const SbTable *table) {
  Columns out = {0};
  size_t all, first = 0;
  double sum = 0;
  const SbTableColumn *column = sb_table_columns(table, &all);
  const SbTableRow *row = sb_table_row(table, 0);
  while (row != NULL && row->note != NULL) {
    row = sb_table_row(table, ++first);
  }
  for (size_t k = 0; k < all && out.count < SB_REPORT_COLUMNS; k++) {
    if (column[k].label != NULL) {
      sum += column[k].width;
      out.index[out.count] = k;
      out.width[out.count] = column[k].width;
      out.right[out.count] = row != NULL && row->cell[k].kind == SB_CELL_NUMBER;
      out.headed |= column[k].label[0] != '\0';
      out.head[out.count++] = column[k].label;
    }
  }
  for (size_t k = 0; k < out.count; k++) {
    out.width[k] = width_of(pages) * out.width[k] / sum - GAP;
  }
  return out;
}

// Draws the texts of a row, or only returns the height it needs.
static double put_texts(SbReportPages *pages, const Columns *columns, const char *const *text,
                        const SbTextStyle *style, const bool *good, bool draw) {
  const SbTextStyle pass = style_of(pages, CELL, 700, SB_ROLE_PASS);
  double height = CELL, x = SB_REPORT_MARGIN + 0.5 * GAP;
  for (size_t k = 0; k < columns->count; k++) {
    const double width = columns->width[k];
    if (draw) {
      sb_canvas_paragraph_aligned(&pages->canvas, text[k], good[k] ? &pass : style, x,
                                  pages->y + ROW_ABOVE - 1, width,
                                  columns->right[k] ? SB_RIGHT : SB_LEFT);
    } else if (text[k][0] != '\0') {
      height = fmax(height, sb_canvas_paragraph_height(&pages->canvas, text[k], style, width));
    }
    x += width + GAP;
  }
  return fmax(height, 1.3 * CELL) + ROW_ABOVE + ROW_BELOW;
}

static void draw_head(SbReportPages *pages, const Columns *columns) {
  const bool plain[SB_REPORT_COLUMNS] = {false};
  if (columns->headed) {
    const SbTextStyle style = style_of(pages, CELL, 700, SB_ROLE_SECOND);
    const double height = put_texts(pages, columns, columns->head, &style, plain, false);
    (void)put_texts(pages, columns, columns->head, &style, plain, true);
    pages->y += height;
  }
  sb_canvas_hairline(&pages->canvas, SB_REPORT_MARGIN, pages->y, pages->width - SB_REPORT_MARGIN,
                     pages->y, sb_canvas_role(&pages->canvas, SB_ROLE_AXIS));
}

// Draws a row; `first`: the first of its table.
static void draw_row(SbReportPages *pages, const Columns *columns, const SbTableRow *row,
                     bool first) {
  static const SbRole inks[] = {SB_ROLE_INK, SB_ROLE_WARN, SB_ROLE_ERROR};
  static const SbRole grounds[] = {0, SB_ROLE_WARN_GROUND, SB_ROLE_ERROR_GROUND};
  SbCanvas *c = &pages->canvas;
  const bool group = row->note != NULL;
  const SbTextStyle style = style_of(pages, CELL, group ? 700 : 400, inks[row->mark]);
  char *text[SB_REPORT_COLUMNS] = {NULL};
  bool good[SB_REPORT_COLUMNS] = {false};
  double height = 1.3 * CELL + ROW_ABOVE + ROW_BELOW + 6;
  if (!group) {
    for (size_t k = 0; k < columns->count; k++) {
      const SbTableCell *cell = &row->cell[columns->index[k]];
      text[k] = sb_table_shown(cell);
      good[k] = cell->kind == SB_CELL_ANSWER && cell->number > 0;
    }
    height = put_texts(pages, columns, (const char *const *)text, &style, good, false);
  }
  const int page = pages->page;
  ensure_room(pages, height + (group || first ? 50 : 0));
  if (first || page != pages->page) {
    draw_head(pages, columns);
  }
  const double width = width_of(pages);
  if (row->mark != SB_TABLE_PLAIN) {
    sb_canvas_color(c, sb_canvas_role(c, grounds[row->mark]), 1);
    cairo_rectangle(pages->cr, SB_REPORT_MARGIN, pages->y + 1, width, height - 1);
    cairo_fill(pages->cr);
  }
  if (group) {
    sb_canvas_text(c, row->note, &style, SB_REPORT_MARGIN + 0.5 * GAP,
                   pages->y + height - ROW_BELOW - 0.3 * CELL, SB_LEFT);
  } else {
    (void)put_texts(pages, columns, (const char *const *)text, &style, good, true);
  }
  pages->y += height;
  sb_canvas_hairline(c, SB_REPORT_MARGIN, pages->y, SB_REPORT_MARGIN + width, pages->y,
                     sb_canvas_role(c, SB_ROLE_HAIRLINE));
  for (size_t k = 0; k < columns->count; k++) {
    g_free(text[k]);
  }
}

void sb_report_table(SbReportPages *pages, const SbTable *table) {
  const Columns columns = columns_of(pages, table);
  const SbTableRow *row;
  for (size_t i = 0; (row = sb_table_row(table, i)) != NULL; i++) {
    draw_row(pages, &columns, row, i == 0);
  }
}
