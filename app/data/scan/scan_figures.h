// Results of a scan: the prepared heights, the figures of the full scan and of its parts, the
// spectrum, the asperities, and their dependence on the cut-offs of the filters.
#pragma once

#include "app/data/scan/scan.h"

#include "engine/contact/rough/height_figures.h"
#include "engine/contact/rough/height_spectrum.h"

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
SbScanScatter sb_scan_scatter(const SbScanFigures *figures,
                              double (*value)(const SbHeightFigures *part));
