// Triangle meshes from STL files, binary or text, for the mass of a part
// (engine/mechanism/solid.h).
//
// The format knows no unit: the reader asks for one. STL repeats its corners, and rounds each time:
// corners that differ by at most 1e-5 of the diagonal of the part's box along every axis (or by two
// units of single precision, far from the origin) become one vertex, the first of them; triangles
// that lose a corner by that are left out and counted. Volume and moments change by as much.
// Files are bounded in size, text is read independently of locale, and a file that is not STL, is
// cut short or holds anything but finite numbers is refused with the place.
#pragma once

#include <glib.h>

enum { SB_STL_TRIANGLES_MAX = 2000000 };

typedef struct {
  double *vertices;    // 3 vertex_count, m
  unsigned *triangles; // 3 triangle_count
  gsize vertex_count, triangle_count;
  gsize dropped; // triangles without area because two corners coincide
  gboolean text; // whether the file was the text form
} SbStl;

// Reads `path`, whose numbers are in `unit` ("mm", "inch", ...). On success the arrays are the
// caller's (sb_stl_clear); on failure *out is empty and the error is of SB_APP_ERROR.
gboolean sb_stl_read(SbStl *out, const char *path, const char *unit, GError **error);

// The same from memory; `name` stands for the file in messages.
gboolean sb_stl_parse(SbStl *out, const char *data, gsize length, const char *unit,
                      const char *name, GError **error);

// Frees the arrays; takes an empty or NULL one.
void sb_stl_clear(SbStl *stl);
