// What the readers of scans share. Each gets bytes that begin as its format does.
#pragma once

#include "app/base/error.h"
#include "app/data/scan/scan.h"

#include <string.h>

// Bytes of a file to be taken one after the other.
typedef struct {
  const guchar *at, *end;
  const char *name; // of the file, in messages
} SbScanBytes;

typedef gboolean SbScanReader(SbScan *out, SbScanBytes bytes, const SbScanChoices *choices,
                              GError **error);
SbScanReader sb_scan_parse_text, sb_scan_parse_gwy, sb_scan_parse_sur, sb_scan_parse_x3p;

// "NAME: what is wrong"; always FALSE.
gboolean sb_scan_fail(GError **error, const char *name, const char *format, ...)
    G_GNUC_PRINTF(3, 4);

// Memory for a grid, once its bytes are known to be there. FALSE for too many points.
gboolean sb_scan_allocate(SbScan *out, guint64 columns, guint64 rows, const char *name,
                          GError **error);

// Metres of a unit of length as files write it ("nm", "µm", "um", "mkm", "[nm]"); 0 for anything
// else.
double sb_scan_length(const char *unit);

// Integers and floats as files have them. At least so many bytes must be left.
static inline guint16 sb_scan_u16(const guchar *p) {
  guint16 value;
  memcpy(&value, p, sizeof value);
  return GUINT16_FROM_LE(value);
}

static inline guint32 sb_scan_u32(const guchar *p) {
  guint32 value;
  memcpy(&value, p, sizeof value);
  return GUINT32_FROM_LE(value);
}

static inline double sb_scan_float(const guchar *p) {
  const guint32 bits = sb_scan_u32(p);
  float value;
  memcpy(&value, &bits, sizeof value);
  return (double)value;
}

static inline double sb_scan_double(const guchar *p) {
  guint64 bits;
  double value;
  memcpy(&bits, p, sizeof bits);
  bits = GUINT64_FROM_LE(bits);
  memcpy(&value, &bits, sizeof value);
  return value;
}

// ---- Text ----

// A header's line "key = value unit", key in small letters and digits alone.
typedef struct {
  char *key, *value, *unit; // owned; unit from brackets in the key or behind a number, or empty
} SbScanEntry;

// A text file taken apart: its header's entries and all its numbers, NaN where missing.
typedef struct {
  const char *name;   // of the file, borrowed
  GPtrArray *entries; // of SbScanEntry
  GPtrArray *units;   // of char *: those of the line above the numbers, a column each, or none
  GArray *numbers;    // of double, row after row
  gsize rows, columns;
  int ragged; // first line of another number of columns; 0: none
} SbScanText;

gboolean sb_scan_text_read(SbScanText *out, SbScanBytes bytes, GError **error);
void sb_scan_text_clear(SbScanText *text);

// Points x y z to a grid; FALSE with an error where they lie on none. Numbers times `lateral` and
// `vertical` are metres.
gboolean sb_scan_grid(SbScan *out, const SbScanText *text, double lateral, double vertical,
                      GError **error);

// Whether the first two of three columns are coordinates of a grid.
gboolean sb_scan_is_grid(const SbScanText *text);

// Rows x z to a profile of even steps; a single column is one of heights, and dx stays open.
gboolean sb_scan_profile(SbScan *out, const SbScanText *text, double lateral, double vertical,
                         GError **error);
