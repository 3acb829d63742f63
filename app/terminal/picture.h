// Pictures in a terminal, drawn from a display list (app/section/draw_list.h): as pixels if the
// terminal supports them (sixel, kitty, iTerm; by chafa), as half blocks with two colours a cell,
// or as lines of Braille dots if there are few colours.
#pragma once

#include "app/section/draw_list.h"
#include "app/section/text.h"
#include "app/terminal/cells.h"

// Kind of pictures.
typedef enum {
  SB_PICTURES_AUTO, // as the environment states
  SB_PICTURES_SIXEL,
  SB_PICTURES_KITTY,
  SB_PICTURES_ITERM,
  SB_PICTURES_BLOCKS, // half blocks
  SB_PICTURES_LINES,  // Braille
  SB_PICTURES_NONE
} SbPictures;

// Returns the kind that the environment variables suggest: pixels for a terminal that is known to
// support them, else half blocks with 256 colours and UTF-8, else lines. Never SB_PICTURES_AUTO.
// `colors` and `ascii` are those of the terminal.
SbPictures sb_pictures_of_environment(SbColors colors, bool ascii);

// Returns whether a kind draws pixels.
static inline bool sb_pictures_are_pixels(SbPictures pictures) {
  return pictures >= SB_PICTURES_SIXEL && pictures <= SB_PICTURES_ITERM;
}

// The functions below scale the full picture of the list to the cells, in both directions. `text`
// (sb_text_create()) lays out texts. `rect` must be inside of the grid.

// Draws the list into the cells of `rect` as half blocks, and its texts as characters over them
// where there is space.
void sb_picture_blocks(SbCells *cells, SbCellRect rect, const SbDrawList *list, SbText *text);

// Draws the lines of the list into the cells of `rect` as Braille dots, and its texts as
// characters.
void sb_picture_lines(SbCells *cells, SbCellRect rect, const SbDrawList *list);

// Returns the height [px] of a picture in `rows` cells that are `height` pixels high each: for
// sixels a multiple of six, else rows * height.
int sb_picture_height(SbPictures pictures, int rows, int height);

// Returns the bytes that draw the list at the cursor over columns x rows cells of width x height
// pixels; `pictures` is one of the kinds with pixels. Freed by g_string_free().
GString *sb_picture_pixels(const SbDrawList *list, SbText *text, SbPictures pictures, int columns,
                           int rows, int width, int height);

// Returns the bytes, a string, that remove pixels that were drawn before; empty for kinds whose
// pixels disappear when text is written over them. Static.
const char *sb_picture_removal(SbPictures pictures);
