// Triangle meshes from STL files, binary or text, for the mass of a part
// (engine/mechanism/solid.h).
//
// The format states no unit: the caller states it. STL repeats its corners, and rounds each time.
// Corners that differ by at most 1e-5 of the diagonal of the part's bounding box along every axis
// (or by two units of single precision, far from the origin) become one vertex, the first of them.
// Triangles that lose a corner by that are removed and counted. Volume and moments change by as
// much. A file that is not STL, is incomplete, has more than SB_STL_TRIANGLES_MAX triangles or a
// number that is not finite is refused.
#pragma once

#include <glib.h>

enum { SB_STL_TRIANGLES_MAX = 2000000 };

// A mesh. Freed by sb_stl_clear().
typedef struct {
  double *vertices;     // [vertex_count][3]: x, y, z in the file's axes [m]
  unsigned *triangles;  // [triangle_count][3]: vertex indices from 0, in the file's order
  gsize *body;          // [triangle_count]: number of its body, below triangle_count
  gsize vertex_count;   //
  gsize triangle_count; //
  gsize dropped;        // triangles removed because two corners coincide
  gsize turned;         // triangles reversed to face outwards (sb_mesh_orient())
  gboolean text;        // the file was in the text format
} SbStl;

// Reads the file `path`, whose numbers are in `unit`: any unit of length that udunits-2 knows
// ("mm", "um", "inch", "m", ...). Returns FALSE with SB_APP_ERROR_IO (the file cannot be read) or
// SB_APP_ERROR_INPUT (its contents, or the unit); the message names the file and the place. *out is
// then empty. *out is overwritten: clear an earlier mesh first.
gboolean sb_stl_read(SbStl *out, const char *path, const char *unit, GError **error);

// As sb_stl_read(), from the `length` bytes of a file; `name` is used as its path in messages.
gboolean sb_stl_parse(SbStl *out, const char *data, gsize length, const char *unit,
                      const char *name, GError **error);

// Writes the corners of the bounding box of points[count][3]; of no points, INFINITY and -INFINITY.
void sb_stl_extent(const double *points, gsize count, double low[3], double high[3]);

// Frees the arrays; the mesh is then empty and may be cleared again. Takes NULL.
void sb_stl_clear(SbStl *stl);
