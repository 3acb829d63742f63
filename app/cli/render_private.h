// Shared by command_render.c and render_options.c.
#pragma once

#include "app/cli/cli.h"
#include "app/export/formats.h"
#include "app/export/render_movie.h"
#include "app/export/studies.h"
#include "app/section/painter.h"

// The options as they were given: texts are owned; NULL: the option was not given.
typedef struct {
  char *output, *format, *view, *size, *at, *fps, *duration, *speed, *from, *to, *backend;
  char *field, *field_max, *insets, *zoom, *azimuth, *elevation, *measured;
  char **settings; // of --set, up to NULL
  gboolean dark, full, undeformed, no_pins;
} SbRenderArguments;

// What the options request.
typedef struct {
  SbRenderOptions how;              // of a picture, or of each picture of a movie
  SbRenderMovie movie;              // if `film` or `sequence`
  SbSectionZoom zoom;               // seal that the section enlarges
  SbGlBackend backend;              // what draws the section
  const SbExportFormat *format;     // static; NULL: a sequence
  const SbRenderArguments *options; // borrowed
  bool film;                        // one file that moves
  bool sequence;                    // numbered pictures
  bool vector;                      // a drawing (PDF, SVG)
  bool is_study;                    // the view is the study `study`
  SbStudyKind study;
  char *name; // file name in the output folder ("section.png"), owned; NULL: -o names the file
} SbRenderRequest;

// Interprets the options of a command with `files` input files. `request` is all zero before;
// `options` is borrowed by it. Returns false after a message if an option is missing, wrong or does
// not combine with another. request->name is freed with g_free(), also after false.
bool sb_render_parse(SbRenderRequest *request, const SbRenderArguments *options, int files);
