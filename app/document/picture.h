// The scene inside a picture: what a PNG that this program wrote restores when it is opened.
#pragma once

#include "app/document/unit.h"

#include <png.h>
#include <setjmp.h>

// Key of the text chunk that holds the scene.
#define SB_PICTURE_SCENE_KEY "sealbench-scene"

// libpng reports by a callback that must not return: `text` says what was wrong, `back` is where it
// goes on.
typedef struct {
  jmp_buf back;
  char text[160];
} SbPngFailure;

// The callbacks, for png_create_*_struct() with an SbPngFailure; warnings are dropped.
void sb_png_failed(png_structp png, png_const_charp text);
void sb_png_warned(png_structp png, png_const_charp text);

// Largest PNG that is looked into.
#define SB_PICTURE_BYTES_MAX ((size_t)256 << 20)

// The scene's text in a PNG that sb_still_write() made; owned by the caller. NULL with an error if
// there is none.
char *sb_picture_find_scene(const void *data, size_t length, GError **error);
