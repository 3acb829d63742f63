// Shared by the readers of scan formats.
#pragma once

#include "app/base/error.h"
#include "app/base/text_table.h"
#include "app/data/scan/scan.h"

#include <string.h>

// The bytes of a file that are not read yet.
typedef struct {
  const guchar *at, *end; // first byte, and the one after the last
  const char *name;       // of the file, for messages
} SbScanBytes;

// Reads one format. The caller has checked that `bytes` begin with the format's signature, and
// passes `out` with all zeros but an empty list of notes. Returns FALSE with SB_APP_ERROR whose
// message names the file; the caller clears `out` then. Sets the heights, their dx and dy (0 or
// NaN: the file states none), the format and the title; the caller applies choices->spacing.
typedef gboolean SbScanReader(SbScan *out, SbScanBytes bytes, const SbScanChoices *choices,
                              GError **error);
SbScanReader sb_scan_parse_text;
SbScanReader sb_scan_parse_gwy;
SbScanReader sb_scan_parse_sur;
SbScanReader sb_scan_parse_x3p;
SbScanReader sb_scan_parse_sdf;

// Sets SB_APP_ERROR_INPUT with "NAME: " and the formatted text. Always returns FALSE.
gboolean sb_scan_fail(GError **error, const char *name, const char *format, ...)
    G_GNUC_PRINTF(3, 4);

// Allocates out->heights.z for a grid and sets columns, rows and stride. To be called once it is
// known that the file has bytes for so many points. Returns FALSE with an error if there are no
// points, more than SB_HEIGHTS_POINTS_MAX, or no memory.
gboolean sb_scan_allocate(SbScan *out, guint64 columns, guint64 rows, const char *name,
                          GError **error);

// Returns the metres of a unit of length as files write it ("nm", "µm", "um", "mkm", "[nm]"); 0 for
// any other text.
double sb_scan_length(const char *unit);

// Returns the little-endian integer at `p`; the caller checks that 2 bytes are left.
static inline guint16 sb_scan_u16(const guchar *p) {
  guint16 value;
  memcpy(&value, p, sizeof value);
  return GUINT16_FROM_LE(value);
}

// Returns the little-endian integer at `p`; the caller checks that 4 bytes are left.
static inline guint32 sb_scan_u32(const guchar *p) {
  guint32 value;
  memcpy(&value, p, sizeof value);
  return GUINT32_FROM_LE(value);
}

// Returns the little-endian IEEE float at `p`; the caller checks that 4 bytes are left.
static inline double sb_scan_float(const guchar *p) {
  const guint32 bits = sb_scan_u32(p);
  float value;
  memcpy(&value, &bits, sizeof value);
  return (double)value;
}

// Returns the little-endian IEEE double at `p`; the caller checks that 8 bytes are left.
static inline double sb_scan_double(const guchar *p) {
  guint64 bits;
  double value;
  memcpy(&bits, p, sizeof bits);
  bits = GUINT64_FROM_LE(bits);
  memcpy(&value, &bits, sizeof value);
  return value;
}

// ---- Text ----

// A header line "key = value unit".
typedef struct {
  char *key;     // only its letters and digits, small: "Z Unit" is "zunit"
  char *value;   // as it is in the file
  double number; // with which the value begins; NaN: none
  char *unit;    // from brackets in the key or after a number; empty: none
} SbScanEntry;

// A text file split into the entries of its header and all its numbers.
typedef struct {
  const char *name;         // of the file, borrowed
  GPtrArray *entries;       // of SbScanEntry
  const SbTextTable *table; // its columns and their units
  GArray *numbers;          // of double, row after row; NaN: missing
  gsize rows, columns;      // of the numbers
  int ragged;               // number of the first line with another count of numbers; 0: none
} SbScanText;

// Writes points with columns x, y, z to the grid that they form, for which sb_scan_is_grid()
// returned TRUE: allocates the heights (positions without a point are NaN) and sets dx and dy.
// `lateral` is the metres per unit of x and y, `vertical` those of z. Returns FALSE with an error
// of sb_scan_allocate(), or if a position occurs twice.
gboolean sb_scan_grid(SbScan *out, const SbScanText *text, double lateral, double vertical,
                      GError **error);

// Returns whether the first two of three columns are the coordinates of a grid.
gboolean sb_scan_is_grid(const SbScanText *text);

// Writes columns x, z (or z alone, which leaves dx unset) to a profile, whose heights it allocates.
// `lateral` is the metres per unit of x, `vertical` those of z. Returns FALSE with an error of
// sb_scan_allocate(), or if the steps of x are unequal.
gboolean sb_scan_profile(SbScan *out, const SbScanText *text, double lateral, double vertical,
                         GError **error);
