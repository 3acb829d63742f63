// The file formats of pictures and films: the one table that `render`, the terminal and the export
// dialog read.
#pragma once

#include "app/export/movie.h"

typedef enum {
  SB_FORMAT_PICTURE, // pixels
  SB_FORMAT_DRAWING, // vectors
  SB_FORMAT_FILM     // moves
} SbFormatKind;

// One row; strings are static.
typedef struct {
  const char *ending; // ".png"
  const char *label;  // "Picture, PNG", to be translated
  SbFormatKind kind;
  SbMovieFormat film; // of a film
} SbExportFormat;

// Returns the table of `*count` rows; static.
const SbExportFormat *sb_export_formats(size_t *count);

// Returns the row whose ending `path` has, in either case; NULL if there is none.
const SbExportFormat *sb_export_format(const char *path);

// Returns the endings of the formats whose bit 1 << kind is set in `kinds`, without the first
// `skip` bytes of each, in a list: "png, svg, pdf or mp4". `between` separates them, and `last`
// separates the last one. Owned by the caller (g_free).
char *sb_export_endings(unsigned kinds, size_t skip, const char *between, const char *last);

// All kinds.
enum { SB_FORMAT_ALL = 1 << SB_FORMAT_PICTURE | 1 << SB_FORMAT_DRAWING | 1 << SB_FORMAT_FILM };
