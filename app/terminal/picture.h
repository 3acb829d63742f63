// Pictures in a terminal, from the display list that every front end draws: as pixels where the
// terminal takes them (sixel, kitty, iTerm: by chafa), as half blocks of two colours a cell, or as
// its lines in Braille where colours are few.
#pragma once

#include "app/section/draw_list.h"
#include "app/section/text.h"
#include "app/terminal/cells.h"

typedef enum {
  SB_PICTURES_AUTO,
  SB_PICTURES_SIXEL,
  SB_PICTURES_KITTY,
  SB_PICTURES_ITERM,
  SB_PICTURES_BLOCKS,
  SB_PICTURES_LINES,
  SB_PICTURES_NONE,
  SB_PICTURES_COUNT
} SbPictures;

// "auto", "sixel", ...; borrowed.
const char *sb_pictures_name(int pictures);

// What the environment tells of the terminal: pixels in a known one, else half blocks where there
// are 256 colours and UTF-8, else lines.
SbPictures sb_pictures_of_environment(SbColors colors, bool ascii);

static inline bool sb_pictures_are_pixels(SbPictures pictures) {
  return pictures >= SB_PICTURES_SIXEL && pictures <= SB_PICTURES_ITERM;
}

// The list, scaled to the cells of `rect`, as half blocks; its text in characters over them, where
// it has room.
void sb_picture_blocks(SbCells *cells, SbCellRect rect, const SbDrawList *list, SbText *text);

// Its lines and labels.
void sb_picture_lines(SbCells *cells, SbCellRect rect, const SbDrawList *list);

// Its labels alone, over what stands there.
void sb_picture_labels(SbCells *cells, SbCellRect rect, const SbDrawList *list);

// Pixels that a picture takes of `rows` cells of `height` pixels: sixels come in bands of six.
int sb_picture_height(SbPictures pictures, int rows, int height);

// Bytes that draw it at the cursor over columns x rows cells of width x height pixels. Owned by the
// caller.
GString *sb_picture_pixels(const SbDrawList *list, SbText *text, SbPictures pictures, int columns,
                           int rows, int width, int height);

// Bytes that remove pixels that were drawn before, for terminals in which text does not; borrowed.
const char *sb_picture_removal(SbPictures pictures);
