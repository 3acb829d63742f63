// The form of a surface by least squares in z; see heights.h. Coordinates are relative to the
// middle, divided by half of the longer side. The cylinder is fitted to about 512 x 512 evenly
// spaced points, which are enough for its five parameters.
#include "engine/contact/rough/heights.h"

#include "engine/numeric/dense.h"

#include <math.h>
#include <string.h>

enum { TERMS = 6 }; // 1, x, y, x^2, x y, y^2

typedef struct {
  const SbHeights *heights;
  double half; // [m]
} Frame;

static Frame frame_of(const SbHeights *h) {
  const double width = (double)(h->columns - 1) * h->dx, height = (double)(h->rows - 1) * h->dy;
  return (Frame){h, fmax(width, h->rows > 1 ? height : 0) / 2};
}

static double x_at(const Frame *f, size_t j) {
  return ((double)j - (double)(f->heights->columns - 1) / 2) * f->heights->dx / f->half;
}

static double y_at(const Frame *f, size_t i) {
  const double from = (double)i - (double)(f->heights->rows - 1) / 2;
  return f->heights->rows > 1 ? from * f->heights->dy / f->half : 0;
}

static const int power_x[TERMS] = {0, 1, 0, 2, 1, 0}, power_y[TERMS] = {0, 0, 1, 0, 1, 2};

// Returns whether the form has the term; a profile has none in y.
static bool has_term(SbForm form, const SbHeights *h, int k) {
  const int order = form == SB_FORM_NONE ? 0 : form == SB_FORM_PLANE ? 1 : 2;
  return power_x[k] + power_y[k] <= order && (h->rows > 1 || power_y[k] == 0);
}

// Normal equations row by row: sums of powers of x, then those of y. False if singular.
static bool fit_polynomial(double out[TERMS], const Frame *f, SbForm form) {
  const SbHeights *h = f->heights;
  double a[TERMS * TERMS] = {0}, b[TERMS] = {0};
  for (size_t i = 0; i < h->rows; i++) {
    double s[5] = {0}, t[3] = {0};
    const double *z = h->z + i * h->stride;
    for (size_t j = 0; j < h->columns; j++) {
      if (!isnan(z[j])) {
        const double x = x_at(f, j), x2 = x * x;
        s[0] += 1;
        s[1] += x;
        s[2] += x2;
        s[3] += x2 * x;
        s[4] += x2 * x2;
        t[0] += z[j];
        t[1] += z[j] * x;
        t[2] += z[j] * x2;
      }
    }
    const double y = y_at(f, i), y_to[5] = {1, y, y * y, y * y * y, y * y * y * y};
    for (int k = 0; k < TERMS; k++) {
      for (int m = 0; m < TERMS; m++) {
        a[k * TERMS + m] += s[power_x[k] + power_x[m]] * y_to[power_y[k] + power_y[m]];
      }
      b[k] += t[power_x[k]] * y_to[power_y[k]];
    }
  }
  for (int k = 0; k < TERMS; k++) {
    for (int m = 0; m < TERMS; m++) {
      if (!has_term(form, h, k) || !has_term(form, h, m)) {
        a[k * TERMS + m] = k == m;
      }
    }
    b[k] = has_term(form, h, k) ? b[k] : 0;
  }
  if (!sb_eliminate(a, b, TERMS)) {
    return false;
  }
  memcpy(out, b, sizeof b);
  return true;
}

static void subtract_polynomial(SbHeights *h, const Frame *f, const double c[TERMS]) {
  for (size_t i = 0; i < h->rows; i++) {
    const double y = y_at(f, i);
    for (size_t j = 0; j < h->columns; j++) {
      const double x = x_at(f, j);
      h->z[i * h->stride + j] -= c[0] + x * (c[1] + c[3] * x + c[4] * y) + y * (c[2] + c[5] * y);
    }
  }
}

// ---- Cylinder ----

// z/half = level + tilt v - k s^2/(1 + sqrt(1 - k^2 s^2)), s = w - middle, where w runs across
// the axis and v along it, and k is the curvature times half.
typedef struct {
  double level, tilt, middle, curvature, angle;
} Cylinder;

enum { UNKNOWNS = 5, SIDE_MAX = 512 };

// Value at a point and its derivatives by the unknowns, in their order; false beyond the cylinder.
static bool cylinder_at(double *z, double slope[UNKNOWNS], const Cylinder *c, double cosine,
                        double sine, double x, double y) {
  const double w = x * cosine + y * sine, v = y * cosine - x * sine;
  const double s = w - c->middle, inside = 1 - c->curvature * c->curvature * s * s;
  if (inside < 1e-3) {
    return false;
  }
  const double root = sqrt(inside);
  *z = c->level + c->tilt * v - c->curvature * s * s / (1 + root);
  const double across = -c->curvature * s / root;
  slope[0] = 1;
  slope[1] = v;
  slope[2] = -across;
  slope[3] = -s * s / (root * (1 + root));
  slope[4] = across * v - c->tilt * w;
  return true;
}

// Computes the sum of squares of the residuals, and the normal equations (NULL: not wanted);
// infinite if points are beyond the cylinder.
static double cylinder_sums(double *a, double *b, const Cylinder *c, const Frame *f) {
  const SbHeights *h = f->heights;
  const double cosine = cos(c->angle), sine = sin(c->angle);
  const size_t down = h->rows / SIDE_MAX + 1, across = h->columns / SIDE_MAX + 1;
  double squares = 0;
  for (size_t i = 0; i < h->rows; i += down) {
    const double y = y_at(f, i), *row = h->z + i * h->stride;
    for (size_t j = 0; j < h->columns; j += across) {
      double z, slope[UNKNOWNS];
      if (isnan(row[j])) {
        continue;
      }
      if (!cylinder_at(&z, slope, c, cosine, sine, x_at(f, j), y)) {
        return INFINITY;
      }
      const double left = row[j] / f->half - z;
      squares += left * left;
      for (int k = 0; k < UNKNOWNS && a != NULL; k++) {
        b[k] += slope[k] * left;
        for (int m = 0; m <= k; m++) {
          a[k * UNKNOWNS + m] += slope[k] * slope[m];
        }
      }
    }
  }
  return squares;
}

// Levenberg and Marquardt's descent; false where it does not end.
static bool fit_cylinder(Cylinder *c, const Frame *f) {
  enum { STEPS = 60 };
  double damping = 1e-6, squares = cylinder_sums(NULL, NULL, c, f);
  for (int step = 0; step < STEPS && isfinite(squares); step++) {
    double a[UNKNOWNS * UNKNOWNS] = {0}, b[UNKNOWNS] = {0};
    cylinder_sums(a, b, c, f);
    for (int k = 0; k < UNKNOWNS; k++) {
      for (int m = 0; m < k; m++) {
        a[m * UNKNOWNS + k] = a[k * UNKNOWNS + m];
      }
      // A profile knows no tilt along the axis and no angle.
      const bool known = f->heights->rows > 1 || (k != 1 && k != 4);
      a[k * UNKNOWNS + k] = known ? a[k * UNKNOWNS + k] * (1 + damping) + 1e-300 : 1;
      b[k] = known ? b[k] : 0;
    }
    if (!sb_eliminate(a, b, UNKNOWNS)) {
      return false;
    }
    const Cylinder next = {c->level + b[0], c->tilt + b[1], c->middle + b[2], c->curvature + b[3],
                           c->angle + b[4]};
    const double found = cylinder_sums(NULL, NULL, &next, f);
    if (found <= squares) {
      const bool ended = squares - found <= 1e-10 * squares;
      *c = next;
      squares = found;
      damping = fmax(damping / 10, 1e-12);
      if (ended) {
        return true;
      }
    } else {
      damping *= 10;
      if (damping > 1e12) {
        return true; // rounding alone is left
      }
    }
  }
  return false;
}

// Initial guess from the quadratic form: the axis has the direction of the smallest curvature.
static Cylinder cylinder_start(const double p[TERMS], const Frame *f) {
  const double mean = (p[3] + p[5]), half = hypot(p[3] - p[5], p[4]);
  Cylinder c = {p[0] / f->half, 0, 0, 0, 0};
  double bend = 2 * p[3];
  if (f->heights->rows > 1) {
    c.angle = 0.5 * atan2(p[4], p[3] - p[5]); // of the greater curvature, with sign
    bend = mean + half;
    if (fabs(mean - half) > fabs(bend)) {
      bend = mean - half;
      c.angle += M_PI / 2;
    }
  }
  const double cosine = cos(c.angle), sine = sin(c.angle);
  const double across = (p[1] * cosine + p[2] * sine) / f->half;
  c.tilt = (p[2] * cosine - p[1] * sine) / f->half;
  c.curvature = -bend / f->half;
  c.middle = c.curvature != 0 ? fmax(fmin(across / c.curvature, 2), -2) : 0;
  // Within the cylinder from the first.
  const double reach = 1.5 + fabs(c.middle);
  c.curvature = fmax(fmin(c.curvature, 0.9 / reach), -0.9 / reach);
  return c;
}

SbStatus sb_heights_level(double *radius, SbHeights *h, SbForm form, SbReport *report) {
  const Frame f = frame_of(h);
  double p[TERMS] = {0};
  *radius = NAN;
  if (!fit_polynomial(p, &f, form)) {
    return sb_fail(report, SB_ERROR_INFEASIBLE, "the measured points leave the form open");
  }
  if (form != SB_FORM_CYLINDER) {
    subtract_polynomial(h, &f, p);
    return SB_OK;
  }
  Cylinder c = cylinder_start(p, &f);
  if (!fit_cylinder(&c, &f) || c.curvature == 0) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "no cylinder fits the surface");
  }
  *radius = f.half / c.curvature;
  const double cosine = cos(c.angle), sine = sin(c.angle);
  for (size_t i = 0; i < h->rows; i++) {
    for (size_t j = 0; j < h->columns; j++) {
      double *z = &h->z[i * h->stride + j], of = NAN, slope[UNKNOWNS];
      // Missing points may be beyond it.
      *z = cylinder_at(&of, slope, &c, cosine, sine, x_at(&f, j), y_at(&f, i)) ? *z - f.half * of
                                                                               : NAN;
    }
  }
  return SB_OK;
}
