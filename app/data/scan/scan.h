// Scans of surfaces from files: heights on a grid or along a line, in metres.
//   text   a matrix; columns x z or, on a grid, x y z, by their names or in this order. Headers of
//          ESRI, SPIP and Gwyddion ("Width: 5 µm"), or names with units ("x [mm], z [µm]").
//   .gwy   Gwyddion's container ("Format of Gwyddion Files"); masked points are missing points.
//   .sur   Digital Surf's surface and profile, format 2.00, 16 or 32 bits.
//   .sdf   ISO 25178-71 (and BCR), text or binary.
//   .x3p   ISO 25178-72 (ISO 5436-2): a zip of main.xml and binary data, if the build has libzip.
//
// The format follows from the first bytes, not from the name. Numbers are read independently of the
// locale. Units and distances that the file does not state must be in the choices: nothing is
// assumed. A file that is larger than SB_SCAN_BYTES_MAX, has more than SB_HEIGHTS_POINTS_MAX
// points, is incomplete or is ambiguous is refused, with the place in the message.
#pragma once

#include "engine/contact/rough/height_figures.h"
#include "engine/contact/rough/height_spectrum.h"

#include <glib.h>

#define SB_SCAN_BYTES_MAX ((gsize)1 << 30)

// What the caller states about the file. Initialise with zeros: the file states everything.
typedef struct {
  // Number (as in the file) or title of a channel of a .gwy; NULL: its only one, or another format.
  const char *channel;
  double spacing; // distance of the points in x and y, in place of the file's [m]; 0: the file's
  // For a text file; a file of another format is refused if one of these two is set.
  double unit;          // metres per unit of the heights, e.g. 1e-6; 0: as the file states
  double lateral_unit;  // metres per unit of x and y; 0: as the file states, else `unit`
  char decimal;         // of a text file, '.' or ','; 0: as the file shows
  gboolean ignore_mask; // of a .gwy: use masked points as if they were measured
} SbScanChoices;

// A scan. Freed by sb_scan_clear().
typedef struct {
  SbHeights heights;  // heights [m], a row after the other, NaN: missing; z is owned by the scan
  const char *format; // for the user, such as "Gwyddion"; static
  char *title;        // of the channel or object; NULL: none
  char *sha256;       // of the file, 64 hexadecimal digits
  GPtrArray *notes;   // of char *: sentences on how the file was read; may be empty
} SbScan;

// Reads the `length` bytes of the file `path`, NULL: the file itself. Returns FALSE, with an empty
// `out`, and SB_APP_ERROR_INPUT (not readable, refused, without a unit or distance) or
// SB_APP_ERROR_IO (no memory); the message names the file.
gboolean sb_scan_read(SbScan *out, const char *data, gsize length, const SbScanChoices *choices,
                      const char *path, GError **error);

// Frees what a scan owns; it is then empty (all zeros), which may be cleared again.
void sb_scan_clear(SbScan *scan);

// ---- Results ----
// Results of a scan: the prepared heights, the figures of the full scan and of its parts, the
// spectrum, the asperities, and their dependence on the cut-offs of the filters.

enum { SB_SCAN_PARTS_MAX = 9, SB_SCAN_CUTOFFS_MAX = 24 };

// A row of the table of cut-offs: for the waves that these Gaussian filters pass, by the spectrum.
typedef struct {
  double cutoff_short, cutoff_long; // wavelengths [m]; 0: no such filter
  double moment[3];                 // m0 [m2], m2 [1], m4 [1/m2]
  SbAsperityFigures asperities;     // that follow from the moments
} SbScanCutoff;

// Freed by sb_scan_figures_clear().
typedef struct {
  SbHeightsReport done;    // how the heights were prepared
  SbHeightFigures figures; // of the prepared heights
  SbHeightSpectrum spectrum;
  SbAsperityFigures scene; // for surface.gt_product, surface.sigma and surface.sigma_over_beta
  // The scan is divided into part_rows x part_columns equal parts; 0: it is too small.
  int part_rows, part_columns;
  SbHeightFigures part[SB_SCAN_PARTS_MAX]; // [part_rows][part_columns]
  int cutoff_count;
  SbScanCutoff cutoff[SB_SCAN_CUTOFFS_MAX]; // [cutoff_count], the first without filters
  SbWarnings warnings;                      // limits of validity
} SbScanFigures;

// Prepares `heights` in place (form, outliers, filters: `choices`) and computes all results.
// Returns SB_OK or the status of sb_heights_prepare(), sb_height_figures() or sb_height_spectrum():
// RANGE, INFEASIBLE, NOT_CONVERGED, heights partly processed. Always sb_scan_figures_clear() it.
SbStatus sb_scan_figures(SbScanFigures *out, SbHeights *heights, const SbHeightsChoices *choices,
                         SbReport *report);

// Frees what the results own; the heights belong to the caller.
void sb_scan_figures_clear(SbScanFigures *figures);

// Scatter of a figure over the parts, in the figure's unit; NaN if fewer than two parts have it.
typedef struct {
  double mean, deviation; // arithmetic mean, sample standard deviation
} SbScanScatter;

// Returns the scatter of the figure that `value` returns for a part (NaN: the part has none).
SbScanScatter sb_scan_scatter(const SbScanFigures *from, double (*value)(const SbHeightFigures *));
