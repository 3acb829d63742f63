// See scan.h.
#include "app/data/scan/scan.h"

#include "engine/valve/model/params.h"

#include <gsl/gsl_statistics_double.h>

#include <math.h>
#include <string.h>

static void add_cutoff(SbScanFigures *out, double cutoff_short, double cutoff_long) {
  if (out->cutoff_count < SB_SCAN_CUTOFFS_MAX) {
    SbScanCutoff *row = &out->cutoff[out->cutoff_count++];
    *row = (SbScanCutoff){.cutoff_short = cutoff_short, .cutoff_long = cutoff_long};
    sb_height_spectrum_moments(row->moment, &out->spectrum, cutoff_short, cutoff_long);
    row->asperities = sb_asperities_of_moments(row->moment, false);
  }
}

// From the distance of points up, and from the length of the scan down, by twos: the short
// cut-offs make asperities fewer and blunter, the long ones take the height.
static void find_cutoffs(SbScanFigures *out, const SbHeights *h) {
  const double step = fmax(h->dx, h->rows > 1 ? h->dy : 0);
  const double width = (double)h->columns * h->dx;
  const double length = h->rows > 1 ? fmin(width, (double)h->rows * h->dy) : width;
  add_cutoff(out, 0, 0);
  for (double cutoff = 4 * step; cutoff <= length / 8; cutoff *= 2) {
    add_cutoff(out, cutoff, 0);
  }
  for (double cutoff = length / 2; cutoff >= 16 * step; cutoff /= 2) {
    add_cutoff(out, 0, cutoff);
  }
}

SbScanScatter sb_scan_scatter(const SbScanFigures *from, double (*value)(const SbHeightFigures *)) {
  double each[SB_SCAN_PARTS_MAX];
  size_t count = 0;
  for (int k = 0; k < from->part_rows * from->part_columns; k++) {
    each[count] = value(&from->part[k]);
    count += isfinite(each[count]);
  }
  return count < 2 ? (SbScanScatter){NAN, NAN}
                   : (SbScanScatter){gsl_stats_mean(each, 1, count), gsl_stats_sd(each, 1, count)};
}

static void warn(SbScanFigures *out, const SbHeights *h, const SbHeightsChoices *choices) {
  SbWarnings *list = &out->warnings;
  const SbHeightFigures *f = &out->figures;
  const SbHeightsReport *done = &out->done;
  const double points = (double)done->points;
  if (choices->form <= SB_FORM_PLANE && done->curved_share > 0.5) {
    sb_warn(list, "surface-form", 0,
            "a quadratic form would take %.0f %% of the variance about the plane: is it the "
            "part's shape? (form quadratic or cylinder)",
            100 * done->curved_share);
  }
  if (done->suspicious > 0) {
    sb_warn(
        list, "surface-outliers", 0,
        "%zu points are beyond %g robust deviations and are included (outliers: %g excludes them)",
        done->suspicious, SB_HEIGHTS_SUSPICIOUS, SB_HEIGHTS_SUSPICIOUS);
  }
  const double missing = (double)(done->missing + done->outliers) / points;
  if (missing > 0.05) {
    sb_warn(list, "surface-missing", 0,
            "%.0f %% of the points are missing; the spectrum uses values interpolated between "
            "their neighbours",
            100 * missing);
  }
  const double step = fmax(h->dx, h->rows > 1 ? h->dy : 0);
  double fine = 0; // share of m4
  for (size_t r = 0; r < out->spectrum.ring_count; r++) {
    const SbSpectrumRing *ring = &out->spectrum.ring[r];
    fine += ring->q > 2 * M_PI / (8 * step) ? ring->moment[2] : 0;
  }
  fine /= out->spectrum.moment[2];
  if (fine > 0.5) {
    sb_warn(list, "surface-sampling", sb_input(SB_P_SURFACE_GT_PRODUCT),
            "%.0f %% of m4 is in waves of fewer than 8 points: density and radius of asperities "
            "are those of the sampling, or of noise (cutoff of short waves)",
            100 * fine);
  }
  const double ratio = out->spectrum.moment[2] / f->moment[2];
  if (fabs(log(ratio)) > log(1.3)) {
    sb_warn(list, "surface-moments", sb_input(SB_P_SURFACE_GT_PRODUCT),
            "m4 by the spectrum is %.3g times that by differences: waves of few points, noise, "
            "missing points or parts unlike each other",
            ratio);
  }
  if (!(f->breadth > 1.5)) {
    sb_warn(list, "surface-breadth", sb_input(SB_P_SURFACE_GT_PRODUCT),
            "m0 m4/m2^2 = %.3g: no random isotropic surface has these moments (above 1.5)",
            f->breadth);
  }
  if (fabs(f->ssk) > 1 || fabs(f->sku - 3) > 2) {
    sb_warn(list, "surface-gaussian", 0,
            "skewness %.2g and kurtosis %.2g: the contact laws assume Gaussian heights (0 and 3)",
            f->ssk, f->sku);
  }
}

SbStatus sb_scan_figures(SbScanFigures *out, SbHeights *heights, const SbHeightsChoices *choices,
                         SbReport *report) {
  enum { PART_SIDE = 64 };
  memset(out, 0, sizeof *out); // too large for a temporary on a small stack
  SbStatus status = sb_heights_prepare(&out->done, heights, choices, report);
  status = status == SB_OK ? sb_height_figures(&out->figures, heights, report) : status;
  status = status == SB_OK ? sb_height_spectrum(&out->spectrum, heights, report) : status;
  const size_t rows = heights->rows, columns = heights->columns;
  const size_t shorter = rows > 1 && rows < columns ? rows : columns;
  const int side = shorter >= 3 * PART_SIDE ? 3 : shorter >= 2 * PART_SIDE ? 2 : 0;
  out->part_columns = side;
  out->part_rows = rows > 1 || side == 0 ? side : 1;
  for (int k = 0; k < out->part_rows * side && status == SB_OK; k++) {
    const SbHeights part = sb_heights_part(heights, (size_t)(k / side), (size_t)out->part_rows,
                                           (size_t)(k % side), (size_t)side);
    status = sb_height_figures(&out->part[k], &part, report);
  }
  if (status == SB_OK) {
    out->scene = sb_asperities_of_moments(out->figures.moment, false);
    find_cutoffs(out, heights);
    warn(out, heights, choices);
  }
  return status;
}

void sb_scan_figures_clear(SbScanFigures *figures) {
  sb_height_spectrum_finish(&figures->spectrum);
}
