// Scans of surfaces from files: heights on a grid or along a line, in metres.
//
//   text      a matrix, x z or x y z on a grid; headers of ESRI, SPIP, Gwyddion ("Width: 5 µm"),
//             names with units ("x [mm], z [µm]")
//   .gwy      Gwyddion's container (gwyddion.net, "Format of Gwyddion Files"); masked points
//   missing .sur      Digital Surf's surface and profile, format 2.00, 16 or 32 bits .x3p      ISO
//   25178-72 (ISO 5436-2): a zip of main.xml and binary data, where libzip was there
//
// The kind follows from the first bytes. Numbers are read independently of locale. What a file does
// not say, units and distances of a bare matrix, must be in the choices: nothing is assumed. Bytes
// and points are bounded (SB_SCAN_BYTES_MAX, SB_HEIGHTS_POINTS_MAX), and memory by the file's size
// times what its packing allows. A file that is cut short, or reads in two ways, is refused with
// the place.
#pragma once

#include "engine/contact/rough/heights.h"

#include <glib.h>

#define SB_SCAN_BYTES_MAX ((gsize)1 << 30)

// What the file need not say; zeroed: nothing.
typedef struct {
  const char *channel; // number or title of one of several
  double spacing;      // of points, in place of the file's [m]
  double unit;         // of heights, and of lengths unless the next says otherwise [m]
  double lateral_unit; // of x and y
  gboolean ignore_mask;
} SbScanChoices;

typedef struct {
  SbHeights heights;  // z: g_free
  const char *format; // "Gwyddion"; static
  char *title;        // of the channel or object; NULL: none
  char *sha256;       // of the file, hex; NULL from memory
  GPtrArray *notes;   // of char *: what was taken how
} SbScan;

// Reads `path`. FALSE with one sentence of SB_APP_ERROR that names the file, *out empty.
gboolean sb_scan_read(SbScan *out, const char *path, const SbScanChoices *choices, GError **error);

// The same from memory; `name` stands for the file.
gboolean sb_scan_parse(SbScan *out, const char *data, gsize length, const SbScanChoices *choices,
                       const char *name, GError **error);

// Takes an empty one.
void sb_scan_clear(SbScan *scan);
