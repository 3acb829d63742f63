// Shared by the readers of scan formats.
#pragma once

#include "app/base/bytes.h"
#include "app/base/error.h"
#include "app/base/text_table.h"
#include "app/data/scan/scan.h"

// The bytes of a file that are not read yet.
typedef struct {
  const guchar *at, *end; // first byte, and the one after the last
} SbScanBytes;

// Reads one format. The caller has checked that `bytes` begin with the format's signature, and
// passes `out` with all zeros but an empty list of notes. Returns false with SB_APP_ERROR whose
// message does not name the file; the caller clears `out` then. Sets the heights, their dx and dy
// (0 or NaN: the file states none), the format and the title; the caller applies choices->spacing.
typedef bool SbScanReader(SbScan *out, SbScanBytes bytes, const SbScanChoices *choices,
                          GError **error);
SbScanReader sb_scan_parse_text;
SbScanReader sb_scan_parse_gwy;
SbScanReader sb_scan_parse_sur;
SbScanReader sb_scan_parse_x3p;
SbScanReader sb_scan_parse_sdf;

// Allocates out->heights.z for a grid and sets columns, rows and stride. To be called once it is
// known that the file has bytes for so many points. Returns false with an error if there are no
// points, more than SB_HEIGHTS_POINTS_MAX, or no memory.
bool sb_scan_allocate(SbScan *out, guint64 columns, guint64 rows, GError **error);

// Kinds of little-endian numbers, numbered as the DataType of ISO 25178-71.
typedef enum {
  SB_SCAN_U8,
  SB_SCAN_U16,
  SB_SCAN_U32,
  SB_SCAN_FLOAT,
  SB_SCAN_I8,
  SB_SCAN_I16,
  SB_SCAN_I32,
  SB_SCAN_DOUBLE,
  SB_SCAN_KINDS
} SbScanKind;

// Allocates and reads a grid from the first of `bytes`, row after row: heights are `scale` times
// the numbers; the number `missing` (NaN: none) and those beyond single precision are missing
// points. Returns false with an error of sb_scan_allocate(), or if there are too few bytes.
bool sb_scan_take_grid(SbScan *out, guint64 columns, guint64 rows, SbScanKind kind,
                       SbScanBytes bytes, double scale, double missing, GError **error);

// Returns the metres of a unit of length as files write it ("nm", "µm", "um", "mkm", "[nm]"); 0 for
// any other text.
double sb_scan_length(const char *unit);

// ---- Text ----

// A header line "key = value unit".
typedef struct {
  char *name;    // the key in small letters, with blanks for marks
  char *key;     // without blanks: "Z Unit" is "zunit"
  char *value;   // as it is in the file
  double number; // with which the value begins; NaN: none
  double unit;   // metres of the one in brackets in the key or after a number; 0: no length; NaN:
                 // the number counts points
  int line;      // from 1
} SbScanEntry;

// A text file split into the entries of its header and all its numbers.
typedef struct {
  GPtrArray *entries;       // of SbScanEntry
  const SbTextTable *table; // its columns and their units
  SbTextTableMatrix matrix; // its numbers
  gsize axes, use[3];       // columns in use: x, y, z; x, z; or z; above 3: a matrix
} SbScanText;

// Writes points with columns x, y, z to the grid that they form, for which sb_scan_is_grid()
// returned true: allocates the heights (positions without a point are NaN) and sets dx and dy.
// `lateral` is the metres per unit of x and y, `vertical` those of z. Returns false with an error
// of sb_scan_allocate(), or if a position occurs twice.
bool sb_scan_grid(SbScan *out, const SbScanText *text, double lateral, double vertical,
                  GError **error);

// Returns whether the first two of three columns are the coordinates of a grid.
bool sb_scan_is_grid(const SbScanText *text);

// Returns "column" or "row" if the first one of a matrix has even steps, as positions have and
// heights not; NULL: neither. A first row is not one of positions if the header states the number
// of heights (`announced`), or if the second one has even steps too, as an inclined plane has.
const char *sb_scan_placed(const SbScanText *text, bool announced);

// Writes columns x, z (or z alone: dx becomes 0) to a profile, whose heights it allocates.
// `lateral` is the metres per unit of x, `vertical` those of z. Returns false with an error of
// sb_scan_allocate(), or if the steps of x are unequal.
bool sb_scan_profile(SbScan *out, const SbScanText *text, double lateral, double vertical,
                     GError **error);
