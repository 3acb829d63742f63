// Shared by the readers of scan formats.
#pragma once

#include "app/base/bytes.h"
#include "app/base/error.h"
#include "app/base/text_table.h"
#include "app/data/scan/scan.h"

#include <math.h>
#include <string.h>

// The bytes of a file that are not read yet.
typedef struct {
  const guchar *at, *end; // first byte, and the one after the last
} SbScanBytes;

// Reads one format. The caller has checked that `file` begins with the format's signature, and
// passes `out` with all zeros but an empty list of notes. Returns false with SB_APP_ERROR whose
// message does not name the file; the caller clears `out` then. Sets the heights, their dx and dy
// (0 or NaN: the file states none), the format and the title; the caller applies wish->spacing.
typedef bool SbScanReader(SbScan *out, SbScanBytes file, const SbScanChoices *wish, GError **error);
SbScanReader sb_scan_parse_text;
SbScanReader sb_scan_parse_gwy;
SbScanReader sb_scan_parse_sur;
SbScanReader sb_scan_parse_x3p;
SbScanReader sb_scan_parse_sdf;

// Allocates out->heights.z for a grid and sets columns, rows and stride. To be called once it is
// known that the file has bytes for so many points. Returns false with an error if there are no
// points, more than SB_HEIGHTS_POINTS_MAX, or no memory.
bool sb_scan_allocate(SbScan *out, size_t columns, size_t rows, GError **error);

// Kinds of little-endian numbers, numbered as the DataType of ISO 25178-71: unsigned integers of 8,
// 16 and 32 bits, float, signed integers of 8, 16 and 32 bits, double.
#define SB_SCAN_KINDS "BHIfbhid"

// Allocates and reads a grid from the first of `bytes`, row after row: heights are `scale` times
// the numbers, of a kind of SB_SCAN_KINDS; the number `missing` (NaN: none) and those beyond single
// precision are missing points. False with an error of sb_scan_allocate(), or: too few bytes.
bool sb_scan_take_grid(SbScan *out, size_t columns, size_t rows, char kind, SbScanBytes bytes,
                       double scale, double missing, GError **error);

// Returns the metres of a unit of length as files write it ("nm", "um", "mkm", "[nm]"); else 0.
double sb_scan_length(const char *unit);
