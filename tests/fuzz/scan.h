// What any bytes must survive as a scan: either heights that are finite or missing, with distances,
// of which the figures are found or refused, or one complaint and nothing.
#pragma once

#include "app/base/error.h"
#include "app/data/scan/scan.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static inline void fuzz_scan(const void *data, size_t size, const SbScanChoices *choices) {
  SbScan scan;
  GError *error = NULL;
  if (!sb_scan_read(&scan, data, size, choices, "fuzz", &error)) {
    g_assert_true(error->domain == SB_APP_ERROR);
    g_assert_true(g_utf8_validate(error->message, -1, NULL));
    g_assert_null(strchr(error->message, '\n'));
    g_assert_null(scan.heights.z);
    g_error_free(error);
    return;
  }
  SbHeights *h = &scan.heights;
  g_assert_true(h->columns > 0 && h->rows > 0 && h->dx > 0 && (h->rows == 1 || h->dy > 0));
  for (size_t i = 0; i < h->columns * h->rows; i++) {
    g_assert_false(isinf(h->z[i]));
  }
  if (h->columns * h->rows <= 4096) {
    SbScanFigures figures;
    SbReport report = {0};
    const SbHeightsChoices forms = {.form = (SbForm)(size % SB_FORM_COUNT),
                                    .outliers = size % 3 == 0 ? 6 : 0,
                                    .fill = size % 2 == 0,
                                    .cutoff_short = size % 5 == 0 ? 3 * h->dx : 0,
                                    .cutoff_long = size % 7 == 0 ? 9 * h->dx : 0};
    if (sb_scan_figures(&figures, h, &forms, &report) == SB_OK) {
      g_assert_true(figures.figures.sq > 0 && isfinite(figures.figures.sq));
    } else {
      g_assert_true(report.text[0] != '\0');
    }
    sb_scan_figures_clear(&figures);
  }
  sb_scan_clear(&scan);
}
