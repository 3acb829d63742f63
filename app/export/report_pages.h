// Pages of a report: A4 sheets that fill from the top, with headings, paragraphs, tables that break
// between rows and repeat their heads, and pictures. Everything is drawn twice: once to count the
// pages, which every foot names, without the pictures.
#pragma once

#include "app/base/canvas.h"

#include <stdbool.h>
#include <stdio.h>

// A4 in logical pixels, and the margins at the sides.
#define SB_REPORT_WIDTH  794.0
#define SB_REPORT_HEIGHT 1123.0
#define SB_REPORT_MARGIN 56.0

// What stands on every page, and in the file's own texts; borrowed.
typedef struct {
  const char *title;    // of the scene or study
  const char *foot;     // version, hash
  const char *comment;  // models, errors, warnings
  const char *hash;     // of the parameters; NULL: none
  const char *bookmark; // name of the first page in the outline
} SbReportTexts;

typedef struct SbReportPages SbReportPages;

// What draws a whole report; it must do the same both times.
typedef void (*SbReportDraw)(SbReportPages *pages, const void *of);

// Told after each finished page, `done` of `count`; returns true to stop. May be NULL.
typedef struct {
  bool (*page)(void *data, int done, int count);
  void *data;
} SbReportHooks;

// Writes a report into `stream`. SB_APP_ERROR_IO, _CANCELLED.
bool sb_report_pages_write(FILE *stream, const SbReportTexts *texts, SbReportDraw draw,
                           const void *of, const SbReportHooks *hooks, GError **error);

// Width between the margins of the present page.
double sb_report_width(const SbReportPages *pages);

// Makes sure of `height` on the present page, or begins another one of its kind.
void sb_report_room(SbReportPages *pages, double height);

// Begins a page: upright, or across for what is wide.
void sb_report_page(SbReportPages *pages, bool across);

void sb_report_skip(SbReportPages *pages, double height);

// The title of the whole, with a line of what it is made from below it.
void sb_report_title(SbReportPages *pages, const char *title, const char *line);

// A heading, which `follows` [px] stay with; it goes into the file's outline.
void sb_report_heading(SbReportPages *pages, const char *text, double follows);

// A paragraph in a role's colour; one of weight 700 heads what follows.
void sb_report_text(SbReportPages *pages, const char *text, double size, int weight, SbRole role);

// A sentence on a ground of its own, for what nobody may miss.
void sb_report_notice(SbReportPages *pages, const char *text, bool error);

// A rectangle of the page for a picture: `draw` is called when it is drawn, not when it is counted.
typedef void (*SbReportPicture)(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of);
void sb_report_picture(SbReportPages *pages, double height, SbReportPicture draw, const void *of);

// Two of them side by side, either may be NULL.
void sb_report_pair(SbReportPages *pages, double height, SbReportPicture draw, const void *left,
                    const void *right);

// What is left below the present place.
double sb_report_left(const SbReportPages *pages);

// ---- Tables ----

enum { SB_REPORT_COLUMNS = 8 };

// Texts stand to the left, numbers to the right; all break at words. Of answers a "yes" is good.
typedef enum { SB_REPORT_WORDS, SB_REPORT_NUMBER, SB_REPORT_ANSWER } SbReportCells;

typedef struct {
  const char *head;
  double share; // of the width
  SbReportCells cells;
} SbReportColumn;

// One being drawn; zeroed but for these two.
typedef struct {
  const SbReportColumn *column;
  size_t columns;
  bool open; // the head stands on this page
} SbReportTable;

// Looks of a row.
typedef enum { SB_REPORT_PLAIN, SB_REPORT_GROUP, SB_REPORT_WRONG, SB_REPORT_DOUBT } SbReportLook;

// A row of `columns` texts (NULL: empty); of a SB_REPORT_GROUP the first, across the whole.
void sb_report_row(SbReportPages *pages, SbReportTable *table, const char *const *cell,
                   SbReportLook look);
