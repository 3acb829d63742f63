// A grid of character cells: what a terminal shows, before anyone sends it. Screens and the charts
// below the tables of plain commands are both made here.
//
// A cell holds one character of one column; what is wider, or has none (control characters,
// combining marks), does not get in. In ASCII every sign has its stand-in, so that whoever writes
// does not ask.
#pragma once

#include "app/base/theme.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { SB_CELLS_COLUMNS_MAX = 1000, SB_CELLS_ROWS_MAX = 400 };

// 0xRRGGBB, or the terminal's own colour.
#define SB_CELL_OWN UINT32_MAX

enum { SB_CELL_BOLD = 1, SB_CELL_REVERSE = 2, SB_CELL_UNDERLINE = 4 };

typedef struct {
  uint32_t ink, ground;
  uint8_t style; // of SB_CELL_BOLD, ...
} SbPen;

typedef struct {
  uint32_t glyph; // Unicode
  SbPen pen;
} SbCell;

typedef struct {
  int x, y, width, height;
} SbCellRect;

typedef struct {
  int columns, rows;
  bool ascii;
  SbCell *cell; // [rows][columns], owned
} SbCells;

// All blank in the terminal's own colours. Sizes are clamped to 1 and the maxima.
void sb_cells_init(SbCells *cells, int columns, int rows, bool ascii);
void sb_cells_finish(SbCells *cells);

// A theme's colour as cells have it.
uint32_t sb_cell_color(SbColor color);

void sb_cells_fill(SbCells *cells, SbCellRect rect, uint32_t glyph, SbPen pen);

// One character; nothing outside the grid.
void sb_cells_put(SbCells *cells, int x, int y, uint32_t glyph, SbPen pen);

// The glyph at a place, 0 outside the grid.
uint32_t sb_cells_at(const SbCells *cells, int x, int y);

// Columns that a text takes.
int sb_cells_width(const SbCells *cells, const char *text);

// Writes a line into at most `width` columns, a longer one with an ellipsis at its end; a pen whose
// ground is SB_CELL_OWN keeps the grounds. Returns the columns taken.
int sb_cells_text(SbCells *cells, int x, int y, int width, const char *text, SbPen pen);

// The same against the right end of `width`.
void sb_cells_text_right(SbCells *cells, int x, int y, int width, const char *text, SbPen pen);

// Text broken at words into at most `height` lines; returns the lines used.
int sb_cells_paragraph(SbCells *cells, SbCellRect rect, const char *text, SbPen pen);

// A horizontal bar of `length` eighths of a cell from x on, to the left if negative.
void sb_cells_bar(SbCells *cells, int x, int y, int length, SbPen pen);

// A frame of lines round a rectangle.
void sb_cells_frame(SbCells *cells, SbCellRect rect, SbPen pen);

// How many colours a terminal has.
typedef enum { SB_COLORS_NONE, SB_COLORS_16, SB_COLORS_256, SB_COLORS_TRUE } SbColors;

// What the environment says (NO_COLOR, COLORTERM, TERM), and whether it takes UTF-8 (LC_ALL,
// LC_CTYPE, LANG).
SbColors sb_colors_of_environment(void);
bool sb_cells_ascii_environment(void);

// The nearest of the terminal's first 16 or 256 colours.
int sb_colors_nearest(SbColors colors, uint32_t rgb);

// The grid's text, lines without blanks at their ends. Owned by the caller (g_free).
char *sb_cells_to_text(const SbCells *cells);

// The same with colours, for a terminal's scrolling text.
void sb_cells_print(const SbCells *cells, SbColors colors, FILE *stream);
