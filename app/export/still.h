// One picture as a file: PNG and SVG with the scene inside, PDF.
#pragma once

#include "app/base/unit.h"

#include <cairo.h>
#include <stdio.h>

// A picture and the texts that are stored in its file. Borrowed during the call.
typedef struct {
  double width, height; // logical pixels, SB_STILL_MIN to SB_STILL_MAX
  double scale;         // of a PNG: device pixels per logical pixel; 0: 1
  const char *title;    // of the picture; NULL: none
  const char *scene;    // text that restores the scene when the file is opened; NULL: none
  const char *hash;     // of the parameters; NULL: none
  const char *comment;  // models, errors, warnings; NULL: none
  const char *ending;   // format of sb_still_write(), ".png"; NULL: by the ending of the path
  void (*draw)(cairo_t *cr, double width, double height, void *user); // in logical pixels
  void *user;                                                         // passed to `draw`
} SbStill;

// Largest side of a PNG in device pixels, and smallest side of any picture.
#define SB_STILL_MAX 16384
#define SB_STILL_MIN 16

// Draws and writes into `stream` in the format of `ending`, a name that ends in .png, .svg or .pdf.
// Returns false with SB_APP_ERROR_INPUT for an unknown ending or an impossible size,
// SB_APP_ERROR_IO if it could not be drawn. Errors of writing are left in the stream (ferror(), at
// the latest after a flush), also if true is returned.
bool sb_still_put(FILE *stream, const SbStill *still, const char *ending, GError **error);

// Draws and writes the file `path`, in the format of still->ending or of the ending of `path`
// (.png, .svg, .pdf). Returns false with SB_APP_ERROR_INPUT for an unknown ending, an impossible
// size, or a path that may not be written (an input; an existing file with --no-overwrite),
// SB_APP_ERROR_IO for a full disk and other failures; an earlier file is intact then.
bool sb_still_write(const SbStill *still, const char *path, GError **error);
