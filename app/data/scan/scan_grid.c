// Points in text files to grids and profiles of even steps.
#include "app/data/scan/scan_private.h"

#include "app/base/number.h"

#include <math.h>
#include <stdlib.h>

// A step may differ by this part of the mean one: coordinates are rounded.
static const double uneven_max = 0.02;

// The number of a row for an axis in use.
static double at(const SbScanText *text, gsize row, gsize axis) {
  return g_array_index(text->matrix.value, double, row * text->matrix.columns + text->use[axis]);
}

// Even places along an axis; count 0 where there are none.
typedef struct {
  double first, step;
  gsize count;
} Axis;

// Of the `rows` numbers from `first`, each `stride` behind the last.
static Axis find_axis(const SbScanText *text, gsize first, gsize stride, gsize rows) {
  g_autofree double *value = g_try_new(double, rows);
  bool good = value != NULL;
  for (gsize i = 0; good && i < rows; i++) {
    value[i] = g_array_index(text->matrix.value, double, first + stride * i);
    good = isfinite(value[i]);
  }
  if (!good) {
    return (Axis){0};
  }
  qsort(value, rows, sizeof *value, sb_number_compare);
  const double range = value[rows - 1] - value[0];
  double least = INFINITY, most = 0, last = value[0];
  gsize count = 1;
  for (gsize i = 1; i < rows; i++) {
    const double gap = value[i] - last;
    if (gap > 1e-6 * range) {
      least = fmin(least, gap);
      most = fmax(most, gap);
      last = value[i];
      count++;
    }
  }
  good = count > 1 && isfinite(range) && most - least <= 2 * uneven_max * most;
  return good ? (Axis){value[0], range / (double)(count - 1), count} : (Axis){0};
}

bool sb_scan_is_grid(const SbScanText *text) {
  // Of a matrix of three columns the first two do not repeat themselves evenly.
  const gsize rows = text->matrix.rows, columns = text->matrix.columns;
  const Axis x = find_axis(text, text->use[0], columns, rows);
  const Axis y = find_axis(text, text->use[1], columns, rows);
  return x.count > 1 && y.count > 1 && x.count < rows && y.count < rows &&
         (double)x.count * (double)y.count <= 4.0 * (double)rows;
}

const char *sb_scan_placed(const SbScanText *text, bool announced) {
  const gsize rows = text->matrix.rows, columns = text->matrix.columns;
  if (text->matrix.ragged > 0) {
    return NULL;
  }
  // One place may be void, where the row and the column of positions meet.
  const bool column = rows > 8 && find_axis(text, 0, columns, rows).count + 1 >= rows;
  const bool row = columns > 8 && rows > 1 && !announced &&
                   find_axis(text, 0, 1, columns).count + 1 >= columns &&
                   find_axis(text, columns, 1, columns).count + 1 < columns;
  return column ? "column" : row ? "row" : NULL;
}

bool sb_scan_grid(SbScan *out, const SbScanText *text, double lateral, double vertical,
                  GError **error) {
  const gsize rows = text->matrix.rows, columns = text->matrix.columns;
  const Axis x = find_axis(text, text->use[0], columns, rows);
  const Axis y = find_axis(text, text->use[1], columns, rows);
  if (!sb_scan_allocate(out, x.count, y.count, error)) {
    return false;
  }
  for (gsize k = 0; k < x.count * y.count; k++) {
    out->heights.z[k] = NAN;
  }
  for (gsize i = 0; i < text->matrix.rows; i++) {
    const double j = round((at(text, i, 0) - x.first) / x.step);
    const double k = round((at(text, i, 1) - y.first) / y.step);
    double *z = &out->heights.z[(gsize)k * x.count + (gsize)j];
    if (!isnan(*z)) {
      return sb_app_error_input(error, "the point x = %g, y = %g is there twice", at(text, i, 0),
                                at(text, i, 1));
    }
    *z = vertical * at(text, i, 2);
  }
  out->heights.dx = lateral * x.step;
  out->heights.dy = lateral * y.step;
  return true;
}

bool sb_scan_profile(SbScan *out, const SbScanText *text, double lateral, double vertical,
                     GError **error) {
  const gsize rows = text->matrix.rows;
  if (!sb_scan_allocate(out, rows, 1, error)) {
    return false;
  }
  for (gsize i = 0; i < rows; i++) {
    out->heights.z[i] = vertical * at(text, i, text->axes - 1);
  }
  const double step = rows > 1 ? (at(text, rows - 1, 0) - at(text, 0, 0)) / (double)(rows - 1) : 0;
  for (gsize i = 1; i < rows && text->axes > 1; i++) {
    const double each = at(text, i, 0) - at(text, i - 1, 0);
    if (!(fabs(each - step) <= uneven_max * fabs(step)) || step == 0) {
      return sb_app_error_input(
          error, "x is not even: a step of %g before row %" G_GSIZE_FORMAT " where %g is the mean",
          each, i + 1, step);
    }
  }
  out->heights.dx = text->axes > 1 ? lateral * fabs(step) : 0;
  return true;
}
