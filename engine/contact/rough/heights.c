// See heights.h.
#include "engine/contact/rough/heights.h"

#include "engine/base/check.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

static const char *const form_names[] = {
#define FORM_NAME(code, text) text,
    SB_FORM_LIST(FORM_NAME)
#undef FORM_NAME
};

const char *sb_form_name(int form) {
  return form_names[form];
}

// Points that there are, and the variance about their mean.
static size_t variance(double *out, const SbHeights *h) {
  double shift = NAN, sum = 0, squares = 0;
  size_t count = 0;
  for (size_t i = 0; i < h->rows; i++) {
    for (size_t j = 0; j < h->columns; j++) {
      const double z = h->z[i * h->stride + j];
      if (!isnan(z)) {
        shift = isnan(shift) ? z : shift;
        sum += z - shift;
        squares += (z - shift) * (z - shift);
        count++;
      }
    }
  }
  const double n = (double)count;
  *out = count > 0 ? fmax(squares / n - sum / n * (sum / n), 0) : NAN;
  return count;
}

static SbStatus check(const SbHeights *h, const SbHeightsChoices *choices, SbReport *report) {
  const size_t least = SB_HEIGHTS_SIDE_MIN;
  if (h->columns < least || (h->rows != 1 && h->rows < least)) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "%zu x %zu points: a profile needs %zu, a surface as many on each side",
                   h->columns, h->rows, least);
  }
  if (h->columns > SB_HEIGHTS_POINTS_MAX / h->rows) {
    return sb_fail(report, SB_ERROR_RANGE, "%zu x %zu points are more than %zu", h->columns,
                   h->rows, SB_HEIGHTS_POINTS_MAX);
  }
  const SbStatus status =
      SB_CHECK(report, {0, "the distance of columns [m]", h->dx, 1e-12, 1},
               {0, "the distance of rows [m]", h->rows > 1 ? h->dy : 1, 1e-12, 1},
               {0, "the limit of outliers", choices->outliers, 0, 1e6},
               {0, "the short cut-off [m]", choices->cutoff_short, 0, 1e3},
               {0, "the long cut-off [m]", choices->cutoff_long, 0, 1e3});
  if (status == SB_OK && choices->cutoff_long > 0 &&
      choices->cutoff_short >= choices->cutoff_long) {
    return sb_fail(report, SB_ERROR_RANGE, "the short cut-off must be below the long one");
  }
  for (size_t i = 0; i < h->rows && status == SB_OK; i++) {
    for (size_t j = 0; j < h->columns; j++) {
      // Squares of squares are formed.
      if (fabs(h->z[i * h->stride + j]) > 1e6) {
        return sb_fail(report, SB_ERROR_RANGE, "point %zu of row %zu is not within 1000 km", j + 1,
                       i + 1);
      }
    }
  }
  return status;
}

// Median and robust deviation of a sample of the points.
static SbStatus robust(double *median, double *deviation, const SbHeights *h, size_t count,
                       SbReport *report) {
  enum { SAMPLE = 1 << 20 };
  const size_t step = count / SAMPLE + 1;
  double *sample = malloc((count / step + 1) * sizeof *sample);
  if (sample == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for %zu heights", count / step);
  }
  size_t seen = 0, n = 0;
  for (size_t i = 0; i < h->rows; i++) {
    for (size_t j = 0; j < h->columns; j++) {
      const double z = h->z[i * h->stride + j];
      if (!isnan(z) && seen++ % step == 0) {
        sample[n++] = z;
      }
    }
  }
  *median = gsl_stats_select(sample, 1, n, n / 2);
  for (size_t i = 0; i < n; i++) {
    sample[i] = fabs(sample[i] - *median);
  }
  *deviation = 1.4826 * gsl_stats_select(sample, 1, n, n / 2);
  free(sample);
  return SB_OK;
}

// Points further than `limit` from the median; removes them or counts them alone.
static size_t beyond(SbHeights *h, double median, double limit, bool remove) {
  size_t count = 0;
  for (size_t i = 0; i < h->rows; i++) {
    for (size_t j = 0; j < h->columns; j++) {
      double *z = &h->z[i * h->stride + j];
      if (fabs(*z - median) > limit) {
        count++;
        *z = remove ? NAN : *z;
      }
    }
  }
  return count;
}

static SbStatus treat_outliers(SbHeightsReport *out, SbHeights *h, const SbHeightsChoices *choices,
                               SbReport *report) {
  double median = 0, deviation = 0, ignored;
  SbStatus status = robust(&median, &deviation, h, variance(&ignored, h), report);
  if (status != SB_OK || deviation == 0) {
    return status; // half of the points at one height: none is far from the others
  }
  if (choices->outliers > 0) {
    out->outliers = beyond(h, median, choices->outliers * deviation, true);
    if (out->outliers > 0) {
      status = sb_heights_level(&out->form_radius, h, choices->form, report);
    }
  } else {
    out->suspicious = beyond(h, median, SB_HEIGHTS_SUSPICIOUS * deviation, false);
  }
  return status;
}

// ---- Missing points ----

// Adds the nearest measured value on either side along a line, by the inverse distance.
static void add_nearest(double *sum, double *weight, const double *z, size_t n, size_t step,
                        double distance) {
  for (int side = 0; side < 2; side++) {
    double last = NAN;
    size_t gap = 0;
    for (size_t k = 0; k < n; k++) {
      const size_t at = (side == 0 ? k : n - 1 - k) * step;
      gap++;
      if (!isnan(z[at])) {
        last = z[at];
        gap = 0;
      } else if (!isnan(last)) {
        sum[at] += last / ((double)gap * distance);
        weight[at] += 1 / ((double)gap * distance);
      }
    }
  }
}

SbStatus sb_heights_fill(SbHeights *h, SbReport *report) {
  const size_t points = h->rows * h->stride;
  double *sum = calloc(2 * points, sizeof *sum), *weight = sum + points;
  if (sum == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for %zu heights", points);
  }
  for (size_t i = 0; i < h->rows; i++) {
    const size_t at = i * h->stride;
    add_nearest(sum + at, weight + at, h->z + at, h->columns, 1, h->dx);
  }
  for (size_t j = 0; j < h->columns && h->rows > 1; j++) {
    add_nearest(sum + j, weight + j, h->z + j, h->rows, h->stride, h->dy);
  }
  // Points without a measured point in their row and column get the mean.
  for (size_t i = 0; i < h->rows; i++) {
    for (size_t j = 0; j < h->columns; j++) {
      const size_t at = i * h->stride + j;
      if (isnan(h->z[at])) {
        h->z[at] = weight[at] > 0 ? sum[at] / weight[at] : 0;
      }
    }
  }
  free(sum);
  return SB_OK;
}

// ---- All of it ----

SbStatus sb_heights_prepare(SbHeightsReport *out, SbHeights *h, const SbHeightsChoices *choices,
                            SbReport *report) {
  *out = (SbHeightsReport){.form_radius = NAN};
  SbStatus status = check(h, choices, report);
  if (status != SB_OK) {
    return status;
  }
  double whole, left, plane, ignored;
  out->points = h->rows * h->columns;
  const size_t count = variance(&whole, h);
  out->missing = out->points - count;
  if (count < out->points / 4 || count < SB_HEIGHTS_SIDE_MIN) {
    return sb_fail(report, SB_ERROR_INFEASIBLE, "only %zu of %zu points are measured", count,
                   out->points);
  }
  // The share of a curved form is reported for every choice, from a copy if another is chosen.
  const SbForm form = choices->form;
  SbHeights copy = *h;
  copy.stride = h->columns;
  copy.z = malloc(out->points * sizeof *copy.z);
  if (copy.z == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for %zu heights", out->points);
  }
  for (size_t i = 0; i < h->rows; i++) {
    for (size_t j = 0; j < h->columns; j++) {
      copy.z[i * copy.stride + j] = h->z[i * h->stride + j];
    }
  }
  status = sb_heights_level(&ignored, &copy, SB_FORM_PLANE, report);
  variance(&plane, &copy);
  if (status == SB_OK) {
    status = sb_heights_level(&ignored, &copy, SB_FORM_QUADRATIC, report);
  }
  variance(&left, &copy);
  free(copy.z);
  out->curved_share = plane > 0 ? 1 - left / plane : 0;
  if (status == SB_OK) {
    status = sb_heights_level(&out->form_radius, h, form, report);
  }
  variance(&left, h);
  out->form_share = whole > 0 ? 1 - left / whole : 0;
  if (status == SB_OK) {
    status = treat_outliers(out, h, choices, report);
  }
  if (status == SB_OK && choices->fill && out->missing + out->outliers > 0) {
    out->filled = out->missing + out->outliers;
    status = sb_heights_fill(h, report);
  }
  if (status == SB_OK && choices->cutoff_long > 0) {
    status = sb_heights_filter(h, choices->cutoff_long, false, report);
  }
  if (status == SB_OK && choices->cutoff_short > 0) {
    status = sb_heights_filter(h, choices->cutoff_short, true, report);
  }
  variance(&left, h);
  if (status == SB_OK && !(left > 0)) {
    return sb_fail(report, SB_ERROR_INFEASIBLE, "the surface is flat: nothing is left of it");
  }
  return status;
}
