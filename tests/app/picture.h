// Pictures in tests: draw into memory, compare with a golden file, show what differs.
#pragma once

#include <cairo.h>
#include <stdbool.h>

// A fresh ARGB32 surface of width x height logical pixels at device scale `scale`.
cairo_surface_t *picture_new(int width, int height, double scale);

// Share of pixels that differ by more than 2 in any channel; 1 if the sizes differ. Writes the
// difference, exaggerated, into `difference` (a PNG path) unless NULL.
double picture_distance(cairo_surface_t *a, cairo_surface_t *b, const char *difference);

// Compares with tests/golden/NAME.png: at most 0.1 % of pixels may differ by more than 2. On a
// mismatch expected, actual and difference are written beside the test's working directory and the
// test fails. With SB_GOLDEN_UPDATE set, writes the golden file instead. The actual picture is
// always left in SB_PICTURES, if set.
void picture_check(cairo_surface_t *actual, const char *name);

// The must-fail partner: true if `wrong` would NOT pass as NAME.
bool picture_rejects(cairo_surface_t *wrong, const char *name);

// Leaves a picture in SB_PICTURES, if set, for eyes.
void picture_show(cairo_surface_t *surface, const char *name);
