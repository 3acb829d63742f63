// The file formats of pictures and movies. `render`, the terminal and the export dialog use this
// table.
#pragma once

#include "app/export/movie.h"

// What a format contains.
typedef enum {
  SB_FORMAT_PICTURE, // pixels
  SB_FORMAT_DRAWING, // vectors
  SB_FORMAT_FILM     // moving pictures
} SbFormatKind;

// One row; strings are static.
typedef struct {
  const char *ending; // ".png"
  const char *label;  // "Picture, PNG"; translate it to show it
  SbFormatKind kind;
  SbMovieFormat film; // of SB_FORMAT_FILM only
} SbExportFormat;

// Returns the table; *count is set to the number of rows. Static.
const SbExportFormat *sb_export_formats(size_t *count);

// Returns the row whose ending `path` has, regardless of upper and lower case; NULL: none has.
const SbExportFormat *sb_export_format(const char *path);

// Returns a list of endings: "png, svg, pdf or mp4". `kinds`: bit 1 << kind for each kind of format
// to list; `skip`: bytes that are left out at the start of each ending (1: the dot); `between`: the
// separator (", "); `last`: the separator before the last ending (" or ").
char *sb_export_endings(unsigned kinds, size_t skip, const char *between, const char *last);

// `kinds` of all formats.
enum { SB_FORMAT_ALL = 1 << SB_FORMAT_PICTURE | 1 << SB_FORMAT_DRAWING | 1 << SB_FORMAT_FILM };
