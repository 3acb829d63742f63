// One picture into one file: PNG with the scene inside, SVG, PDF. The file appears whole or not at
// all.
#pragma once

#include "app/base/unit.h"

#include <cairo.h>
#include <stdio.h>

typedef struct {
  double width, height; // logical pixels
  double scale;         // device pixels per logical pixel, PNG only; 0 counts as 1
  const char *title;    // of the picture; NULL: none
  const char *scene;    // text that restores the scene when the file is opened; NULL: none
  const char *hash;     // of the parameters; NULL: none
  const char *comment;  // models, errors, warnings; NULL: none
  const char *ending;   // ".png" and the like, of a path that has none; NULL: the path's
  void (*draw)(cairo_t *cr, double width, double height, void *user);
  void *user;
} SbStill;

// Largest side of a PNG in device pixels, and smallest of any picture.
#define SB_STILL_MAX 16384
#define SB_STILL_MIN 16

// Draws and writes into `stream` what `ending` says (.png, .svg, .pdf). Fails with
// SB_APP_ERROR_INPUT on an unknown ending or an impossible size, SB_APP_ERROR_IO if it could not be
// drawn; failures to write show in the stream (ferror) at the latest.
bool sb_still_put(FILE *stream, const SbStill *still, const char *ending, GError **error);

// Draws and writes `path`, whose ending (.png, .svg, .pdf) says how. Fails with SB_APP_ERROR_INPUT
// on an unknown ending or an impossible size, SB_APP_ERROR_IO on a full disk and the like; an
// earlier file under that name stays intact then.
bool sb_still_write(const SbStill *still, const char *path, GError **error);
