// Items of the thesis outside the program: JSON, a table of comma-separated values, a part of the
// index page, and the part of docs/thesis.md.
#pragma once

#include "app/export/json.h"
#include "app/study/thesis_item.h"

#include <stdio.h>

// Title, rows, reasons and notes as lines. Owned by the caller.
char *sb_thesis_table(const SbThesisItem *item);

// An object: item, title, rows, chart, notes.
void sb_json_thesis(SbJson *json, const SbThesisItem *item);

// A line a row, SI.
void sb_csv_thesis(FILE *stream, const SbThesisItem *item);

// The item as HTML below a heading; `picture` is the chart's file, NULL: none. The page around.
void sb_html_thesis(FILE *stream, const SbThesisItem *item, const char *picture);
void sb_html_thesis_begin(FILE *stream, SbThesisItem *const *items, size_t count);
void sb_html_thesis_end(FILE *stream);

// A text with {ITEM | LABEL OF A ROW | WHAT} replaced by that row's value: printed, thesis,
// consistent, or ratio, printed over the thesis' model; "?" where there is none. Owned by the
// caller.
char *sb_thesis_introduction(const char *text, SbThesisItem *const *items, size_t count);

// The item as Markdown.
void sb_markdown_thesis(FILE *stream, const SbThesisItem *item);

// The chart into a stream, by the ending ".svg", ".png" or ".pdf". SB_APP_ERROR_IO.
bool sb_thesis_still(FILE *stream, const SbThesisItem *item, const char *ending, GError **error);

// A row's value with its unit, four digits; "-" without. Owned by the caller.
char *sb_thesis_text(const SbThesisRow *row, double value);

// The reasons of a row in a sentence, with what each explains; NULL: none. Owned by the caller.
char *sb_thesis_reason(const SbThesisRow *row);

// All reasons of an item, each once, those of its rows before those of the consistent set: char *,
// "TEXT (COMMAND)". Owned by the caller.
GPtrArray *sb_thesis_reasons(const SbThesisItem *item);

// How a row stands, in the numbers of that list from 1: "agrees", "1: +3 nm, 2: -1 nm; remains
// 0.1 nm"; `models`: of the consistent set. Owned by the caller.
char *sb_thesis_standing(const SbThesisRow *row, const GPtrArray *reasons, bool models);
