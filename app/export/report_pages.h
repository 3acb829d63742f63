// Pages of a report: A4 pages that are filled from the top, with headings, paragraphs, tables that
// break between rows and repeat their heads, and pictures. The caller's function draws everything
// twice: first to count the pages, because every foot states their number, then into the file.
// Lengths are in logical pixels (1/96 inch).
#pragma once

#include "app/draw/canvas.h"

#include <stdbool.h>
#include <stdio.h>

// Width and height of A4, and the margin on the left and right.
#define SB_REPORT_WIDTH  794.0
#define SB_REPORT_HEIGHT 1123.0
#define SB_REPORT_MARGIN 56.0

// Texts on every page and in the PDF's metadata. Borrowed during sb_report_pages_write().
typedef struct {
  const char *title;    // of the scene or study
  const char *foot;     // version, hash
  const char *comment;  // models, errors, warnings; NULL: none
  const char *hash;     // of the parameters; NULL: none
  const char *bookmark; // name of the first page in the PDF's outline
} SbReportTexts;

// The pages that are being drawn; exists only during sb_report_pages_write().
typedef struct SbReportPages SbReportPages;

// Draws a whole report with the functions below; must make the same calls both times.
typedef void (*SbReportDraw)(SbReportPages *pages, const void *of);

// Progress.
typedef struct {
  // Called after page `done` of `count` is in the file; returns true to cancel. May be NULL.
  bool (*page)(void *data, int done, int count);
  void *data;
} SbReportHooks;

// Writes a report as PDF into `stream`; calls `draw` with `of` twice. `hooks` may be NULL. False
// with SB_APP_ERROR_IO (not drawn) or SB_APP_ERROR_CANCELLED (nothing was written); errors of
// writing are left in the stream (ferror()).
bool sb_report_pages_write(FILE *stream, const SbReportTexts *texts, SbReportDraw draw,
                           const void *of, const SbReportHooks *hooks, GError **error);

// Returns the width between the margins of the present page.
double sb_report_width(const SbReportPages *pages);

// Begins another page of the same orientation if less than `height` is left on the present one.
void sb_report_room(SbReportPages *pages, double height);

// Begins a page: portrait, or landscape if `across`.
void sb_report_page(SbReportPages *pages, bool across);

// Leaves `height` empty.
void sb_report_skip(SbReportPages *pages, double height);

// Draws the title of the report and below it the line of its files.
void sb_report_title(SbReportPages *pages, const char *title, const char *line);

// Draws a heading on a page that also has room for `follows`, and adds it to the PDF's outline.
void sb_report_heading(SbReportPages *pages, const char *text, double follows);

// Draws a paragraph. `size` [pixels]; `weight` 400 (regular) to 700 (bold: stays on the page of
// what follows it); `role`: its colour.
void sb_report_text(SbReportPages *pages, const char *text, double size, int weight, SbRole role);

// Draws a paragraph on a coloured ground: an error, or else a warning.
void sb_report_notice(SbReportPages *pages, const char *text, bool error);

// Draws a picture into `rect`. Called only in the second pass.
typedef void (*SbReportPicture)(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of);

// Places a picture of the full width; `draw` is called with `of`.
void sb_report_picture(SbReportPages *pages, double height, SbReportPicture draw, const void *of);

// Places two pictures next to each other: `draw` is called with `left` and with `right`; NULL: that
// half stays empty.
void sb_report_pair(SbReportPages *pages, double height, SbReportPicture draw, const void *left,
                    const void *right);

// Returns the height that is left on the present page.
double sb_report_left(const SbReportPages *pages);

// ---- Tables ----

// Largest number of columns.
enum { SB_REPORT_COLUMNS = 8 };

// Content of a column's cells; long texts break between words.
typedef enum {
  SB_REPORT_WORDS,  // aligned left
  SB_REPORT_NUMBER, // aligned right
  SB_REPORT_ANSWER  // aligned left, "yes" is highlighted as good
} SbReportCells;

// A column.
typedef struct {
  const char *head; // heading
  double share;     // its width relative to the sum of all shares
  SbReportCells cells;
} SbReportColumn;

// A table. The caller sets `column` and `columns` and zeroes the rest, in each of both passes. It
// ends with its last row.
typedef struct {
  const SbReportColumn *column; // [columns]
  size_t columns;               // at most SB_REPORT_COLUMNS
  bool open;                    // internal: the head is on this page
} SbReportTable;

// Looks of a row.
typedef enum {
  SB_REPORT_PLAIN,
  SB_REPORT_GROUP, // a subheading across all columns
  SB_REPORT_WRONG, // as an error
  SB_REPORT_DOUBT  // as a warning
} SbReportLook;

// Draws a row, and the table's head before the first row and on each new page. `cell`: [columns]
// texts, NULL: empty; of SB_REPORT_GROUP only the first is used.
void sb_report_row(SbReportPages *pages, SbReportTable *table, const char *const *cell,
                   SbReportLook look);
