// A grid of character cells, as a terminal shows it. The screen of the workbench and the charts
// below the tables of commands are both drawn into such a grid.
//
// (0, 0) is the top left cell, x counts columns, y rows downwards. A cell contains one character of
// one column; wider characters and characters without a width (control characters, combining marks)
// are replaced or omitted. In an ASCII grid every other character is replaced by one of ASCII (not
// by sb_cells_fill()), so the functions that draw need not care. Drawing outside of the grid is
// clipped.
#pragma once

#include "app/draw/theme.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { SB_CELLS_COLUMNS_MAX = 1000, SB_CELLS_ROWS_MAX = 400 };

// Colours are 0xRRGGBB; this value is the terminal's own text or background colour. As the ground
// of a pen it keeps the background that a cell has, except in sb_cells_init() and sb_cells_fill().
#define SB_CELL_OWN UINT32_MAX

// Bits of SbPen.style.
enum { SB_CELL_BOLD = 1, SB_CELL_REVERSE = 2, SB_CELL_UNDERLINE = 4 };

// How a character is drawn.
typedef struct {
  uint32_t ink, ground; // colours of the character and of its background
  uint8_t style;        // SB_CELL_BOLD | ...; 0: plain
} SbPen;

// One cell.
typedef struct {
  uint32_t glyph; // Unicode code point
  SbPen pen;
} SbCell;

// A rectangle of cells: (x, y) is its top left cell.
typedef struct {
  int x, y, width, height;
} SbCellRect;

// A grid. Initialised by sb_cells_init(), freed by sb_cells_finish().
typedef struct {
  int columns, rows;
  bool ascii;   // only ASCII characters
  SbCell *cell; // [rows][columns]
} SbCells;

// Initialises a grid of blanks in the terminal's own colours. Sizes below 1 become 1, and sizes
// above the maxima become those.
void sb_cells_init(SbCells *cells, int columns, int rows, bool ascii);

// Frees the cells.
void sb_cells_finish(SbCells *cells);

// Returns a colour of a theme as 0xRRGGBB; its opacity is ignored.
uint32_t sb_cell_color(SbColor color);

// Sets all cells of a rectangle to one character, which must have one column; it is not replaced in
// an ASCII grid.
void sb_cells_fill(SbCells *cells, SbCellRect rect, uint32_t glyph, SbPen pen);

// Sets one cell. Does nothing outside of the grid.
void sb_cells_put(SbCells *cells, int x, int y, uint32_t glyph, SbPen pen);

// Returns the character of a cell; 0 outside of the grid.
uint32_t sb_cells_at(const SbCells *cells, int x, int y);

// Returns the number of columns that a UTF-8 text takes in this grid.
int sb_cells_width(const SbCells *cells, const char *text);

// Writes one line of UTF-8 text from (x, y) into at most `width` columns; a longer text ends with
// an ellipsis. Returns the number of columns that the text takes, also outside of the grid.
int sb_cells_text(SbCells *cells, int x, int y, int width, const char *text, SbPen pen);

// As sb_cells_text(), aligned to the right end of the columns x to x + width - 1.
void sb_cells_text_right(SbCells *cells, int x, int y, int width, const char *text, SbPen pen);

// Writes text that is broken at words into the rectangle, as many lines as fit. Returns the number
// of lines written.
int sb_cells_paragraph(SbCells *cells, SbCellRect rect, const char *text, SbPen pen);

// Draws a horizontal bar of |length| eighths of a cell: from the left edge of cell x to the right,
// or if `length` is negative, to the left.
void sb_cells_bar(SbCells *cells, int x, int y, int length, SbPen pen);

// Draws a frame of lines in the outermost cells of a rectangle.
void sb_cells_frame(SbCells *cells, SbCellRect rect, SbPen pen);

// Number of colours of a terminal.
typedef enum { SB_COLORS_NONE, SB_COLORS_16, SB_COLORS_256, SB_COLORS_TRUE } SbColors;

// Returns the number of colours that the environment variables NO_COLOR, COLORTERM and TERM state.
SbColors sb_colors_of_environment(void);

// Returns true if LC_ALL, LC_CTYPE and LANG state no UTF-8, so that only ASCII may be sent.
bool sb_cells_ascii_environment(void);

// Returns the index of the terminal's colour that is nearest to `rgb` (0xRRGGBB): for SB_COLORS_16
// among 0 to 15, for SB_COLORS_256 among 16 to 255, because users change the first 16. Main thread.
int sb_colors_nearest(SbColors colors, uint32_t rgb);

// Returns the characters as UTF-8 lines that end with a newline, without trailing blanks.
char *sb_cells_to_text(const SbCells *cells);

// Prints the grid as lines with escape sequences for colours and bold text (no other style), for a
// terminal that scrolls; with SB_COLORS_NONE the text of sb_cells_to_text().
void sb_cells_print(const SbCells *cells, SbColors colors, FILE *stream);
