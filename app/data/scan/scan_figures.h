// All that is said of a scan: its heights made ready, the figures of the whole and of its parts,
// the spectrum, the asperities and how they hang on the cut-offs.
#pragma once

#include "app/data/scan/scan.h"

#include "engine/contact/rough/height_figures.h"
#include "engine/contact/rough/height_spectrum.h"

enum { SB_SCAN_PARTS_MAX = 9, SB_SCAN_CUTOFFS_MAX = 24 };

// A row of the table of cut-offs: the waves that the filters pass, by the spectrum.
typedef struct {
  double cutoff_short, cutoff_long; // [m], 0: none
  double moment[3];
  SbAsperityFigures asperities; // of the closed forms, sigma that of heights
} SbScanCutoff;

typedef struct {
  SbHeightsReport done;
  SbHeightFigures figures;
  SbHeightSpectrum spectrum;
  SbAsperityFigures scene;     // what surface.gt_product, .sigma, .sigma_over_beta mean
  int part_rows, part_columns; // 0: too small to be parted
  SbHeightFigures part[SB_SCAN_PARTS_MAX];
  int cutoff_count;
  SbScanCutoff cutoff[SB_SCAN_CUTOFFS_MAX];
  SbWarnings warnings;
} SbScanFigures;

// Makes the heights ready in place; *out is to be cleared in any case.
SbStatus sb_scan_figures(SbScanFigures *out, SbHeights *heights, const SbHeightsChoices *choices,
                         SbReport *report);
void sb_scan_figures_clear(SbScanFigures *figures);

// Mean and standard deviation of a figure over the parts that have it; NaN of fewer than two.
typedef struct {
  double mean, deviation;
} SbScanScatter;
SbScanScatter sb_scan_scatter(const SbScanFigures *figures,
                              double (*value)(const SbHeightFigures *part));
