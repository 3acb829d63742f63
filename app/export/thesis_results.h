// Recomputed tables and figures of the thesis (app/study/thesis_item.h) as text, JSON,
// comma-separated values, HTML and Markdown. Errors of writing are left in the stream (ferror()).
#pragma once

#include "app/study/thesis_item.h"
#include "app/table/json.h"

#include <stdio.h>

// Returns an item as lines of text: title, rows, reasons and notes.
char *sb_thesis_table(const SbThesisItem *item);

// Writes an item as an object, an element of the open array or the outermost value: engine, item,
// title, source, rows, chart, notes, fails.
void sb_json_thesis(SbJson *json, const SbThesisItem *item);

// Writes a heading and a line for each row of an item [SI].
void sb_csv_thesis(FILE *stream, const SbThesisItem *item);

// Writes an item as HTML: heading, picture, table, reasons, notes. `picture`: the chart's file
// relative to the page; NULL: none. Between sb_html_thesis_begin() and sb_html_thesis_end().
void sb_html_thesis(FILE *stream, const SbThesisItem *item, const char *picture);

// Writes the start of the page: title, explanation, and a list of `count` items.
void sb_html_thesis_begin(FILE *stream, SbThesisItem *const *items, size_t count);

// Writes the end of the page.
void sb_html_thesis_end(FILE *stream);

// Returns `text` with {ITEM | LABEL OF A ROW | WHAT} replaced by a value of that row with its unit.
// WHAT: printed, thesis, consistent, or ratio (printed divided by the thesis' model). "?" if there
// is no such item or row.
char *sb_thesis_introduction(const char *text, SbThesisItem *const *items, size_t count);

// Writes an item as Markdown, a part of docs/thesis.md.
void sb_markdown_thesis(FILE *stream, const SbThesisItem *item);

// Draws the item's chart (not NULL) into `stream` in the format of `ending` (".svg", ".png",
// ".pdf"). Returns false with SB_APP_ERROR_INPUT for another ending, SB_APP_ERROR_IO if it could
// not be drawn.
bool sb_thesis_still(FILE *stream, const SbThesisItem *item, const char *ending, GError **error);
