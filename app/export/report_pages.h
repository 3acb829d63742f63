// Pages of a report: A4 pages that are filled from the top, with headings, paragraphs, tables that
// break between rows and repeat their heads, and pictures. The caller's function draws everything
// twice: first to count the pages, because every foot states their number, then into the file.
// Lengths are in logical pixels (1/96 inch).
#pragma once

#include "app/draw/canvas.h"
#include "app/table/table.h"

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

// Draws a whole report with the functions below; must make the same calls both times. The first
// page, in portrait, has begun. A part that does not fit on the rest of a page begins another one
// of the same orientation; parts must not be higher than a page.
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

// Ends the present page and begins another: portrait, or landscape if `across`.
void sb_report_page(SbReportPages *pages, bool across);

// Leaves `height` empty. Does not begin a page.
void sb_report_skip(SbReportPages *pages, double height);

// Draws the title of the report and below it `line`, the names of its files; adds the entry
// `bookmark` of SbReportTexts to the PDF's outline.
void sb_report_title(SbReportPages *pages, const char *title, const char *line);

// Draws a heading on a page that also has room for the height `follows` below it, and adds it to
// the PDF's outline.
void sb_report_heading(SbReportPages *pages, const char *text, double follows);

// Draws a paragraph. `size`: of the font; `weight` 400 (regular) to 700 (bold: begins a page unless
// a height of 60 remains below the text); `role`: its colour.
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

// Draws a table (app/table/table.h) of at most SB_REPORT_COLUMNS columns with a label; its head is
// repeated on each new page. The columns share the width as SbTableColumn.width states. A column
// whose first row is a number is aligned to the right. Long texts break between words. Notes are
// subheadings; marked rows and the answer yes are coloured.
void sb_report_table(SbReportPages *pages, const SbTable *table);

// Largest number of columns of a table.
enum { SB_REPORT_COLUMNS = 8 };
