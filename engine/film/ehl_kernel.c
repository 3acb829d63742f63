// Elastic kernel of the spectral elements: the gap of a pressure P on a half-plane, scaled, is
// -(1/pi) integral P ln|X - X'| dX' (thesis eq. 6.46-6.50 without its constant).
//
// Near a target the logarithm is split into ln|z - r|, z being the target's own (complex)
// coordinate, and a smooth remainder. The first part is exact for polynomials: integral of P_k(r)
// ln(z - r) = 2/(2k+1) (Q_{k+1} - Q_{k-1})(z) with the Legendre functions of the second kind; the
// remainder and targets at a middling distance take a Gauss rule, distant ones the expansion about
// the element's middle c, half its length h, ln|X - X'| = ln|X - c| - sum ((X' - c)/h)^m z^-m / m
// with z = (X - c)/h.
#include "engine/film/ehl_mesh.h"

#include <math.h>
#include <string.h>

enum { COLUMNS = SB_EHL_DEGREE_MAX + 1 };

// Half the sum of the distances to -1 and 1 is (rho + 1/rho)/2 on Bernstein's ellipse rho: closer
// than NEAR (rho = 2) the split kernel is used. Beyond FAR half-lengths from the middle the
// expansion has 16 digits with at most SB_EHL_MULTIPOLES terms, -ln z of them each.
static const double NEAR = 1.25;
static const double FAR = 3.0;
static const double DIGITS = 37.0; // ln of what is left out, negative

// ---------------------------------------------------------------- logarithmic moments

// out[k] = Re integral over [-1, 1] of P_k(r) ln(z - r), k = 0 .. n, for z = x + i y near the
// element. Legendre's recurrence by real and imaginary part; these do not mix for real z.
static void moments(double *out, double x, double y, int n) {
  double plus = log(fmax(y == 0.0 ? fabs(x + 1.0) : hypot(x + 1.0, y), 1e-40));
  double minus = log(fmax(y == 0.0 ? fabs(x - 1.0) : hypot(x - 1.0, y), 1e-40));
  double plus_angle = y == 0.0 ? 0.0 : atan2(y, x + 1.0);
  double minus_angle = y == 0.0 ? 0.0 : atan2(y, x - 1.0);
  double before = 0.5 * (plus - minus), before_i = 0.5 * (plus_angle - minus_angle);
  double now = x * before - y * before_i - 1.0, now_i = x * before_i + y * before;
  out[0] = (x + 1.0) * plus - (x - 1.0) * minus - y * (plus_angle - minus_angle) - 2.0;
  for (int k = 1; k <= n; k++) {
    double next = ((2 * k + 1) * (x * now - y * now_i) - k * before) / (k + 1);
    out[k] = 2.0 / (2 * k + 1) * (next - before);
    if (y != 0.0) {
      double next_i = ((2 * k + 1) * (x * now_i + y * now) - k * before_i) / (k + 1);
      before_i = now_i;
      now_i = next_i;
    }
    before = now;
    now = next;
  }
}

// ---------------------------------------------------------------- elements

// row[j] += sum over k < count of value[k] matrix[k][j], rows of COLUMNS.
static void accumulate(double *restrict row, const double *restrict value,
                       const double *restrict matrix, int count, int columns) {
  int k = 0;
  for (; k + 4 <= count; k += 4, matrix += 4 * COLUMNS) {
    for (int j = 0; j < columns; j++) {
      row[j] += (value[k] * matrix[j] + value[k + 1] * matrix[COLUMNS + j]) +
                (value[k + 2] * matrix[2 * COLUMNS + j] + value[k + 3] * matrix[3 * COLUMNS + j]);
    }
  }
  for (; k < count; k++, matrix += COLUMNS) {
    for (int j = 0; j < columns; j++) {
      row[j] += value[k] * matrix[j];
    }
  }
}

// Moments about the middle of a finite element.
static void expand(SbEhlElement *e) {
  e->middle = 0.5 * (e->x0 + e->x1);
  e->half = 0.5 * (e->x1 - e->x0);
  memset(e->multipole, 0, sizeof e->multipole);
  double power[SB_EHL_QUAD], value[SB_EHL_QUAD];
  for (int m = 0; m < SB_EHL_MULTIPOLES; m++) {
    for (int q = 0; q < SB_EHL_QUAD; q++) {
      power[q] = (m > 0 ? power[q] : 1.0) * (e->fine_x[q] - e->middle) / e->half;
      value[q] = -power[q] / (m + 1);
    }
    accumulate(e->multipole[m], value, e->fine_wb[0], SB_EHL_QUAD, e->degree + 1);
  }
}

// A smooth part of the kernel by its values at the fine rule.
static void add_values(double *row, const SbEhlElement *e, const double *value) {
  accumulate(row, value, e->fine_wb[0], SB_EHL_QUAD, e->degree + 1);
}

static void add_constant(double *row, const SbEhlElement *e, double value) {
  for (int j = 0; j <= e->degree; j++) {
    row[j] += value * e->integral[j];
  }
}

// ln|z - r| with z = x + i y in the element's coordinate r.
static void add_log(double *row, const SbEhlElement *e, const SbEhlTables *tables, double x,
                    double y) {
  double distance = y == 0.0 ? fmax(1.0, fabs(x)) : 0.5 * (hypot(x - 1.0, y) + hypot(x + 1.0, y));
  if (distance > NEAR) {
    double value[SB_EHL_QUAD];
    for (int q = 0; q < SB_EHL_QUAD; q++) {
      double dr = x - tables->fine[q];
      value[q] = 0.5 * log(dr * dr + y * y);
    }
    add_values(row, e, value);
    return;
  }
  double moment[SB_EHL_PROJECT + 1];
  moments(moment, x, y, e->modes);
  accumulate(row, moment, e->project[0], e->modes + 1, e->degree + 1);
}

void sb_ehl_kernel_prepare(SbEhlElement *e, const SbEhlTables *tables) {
  const SbEhlTable *t = e->table;
  int columns = e->degree + 1;
  int extra = e->map == SB_EHL_AFFINE ? 0 : e->map == SB_EHL_COSINE ? 10 : 1;
  e->modes = e->degree + extra;
  memset(e->project, 0, sizeof e->project);
  memset(e->integral, 0, sizeof e->integral);
  double value[SB_EHL_QUAD];
  for (int q = 0; q < SB_EHL_QUAD; q++) {
    double r = tables->fine[q];
    double scale = tables->fine_weight[q] * sb_ehl_stretch(e, r);
    SbEhlLocal local;
    sb_ehl_local(&local, e, t->fine[q], NULL, r);
    for (int k = 0; k <= e->degree; k++) {
      e->fine_wb[q][k] = scale * local.value[k];
    }
    e->fine_x[q] = e->side != 0 ? sb_ehl_inverse(e, r) : sb_ehl_position(e, r);
    value[q] = 1.0;
  }
  accumulate(e->integral, value, e->fine_wb[0], SB_EHL_QUAD, columns);
  for (int k = 0; k <= e->modes; k++) {
    for (int q = 0; q < SB_EHL_QUAD; q++) {
      value[q] = 0.5 * (2 * k + 1) * tables->fine_legendre[q][k];
    }
    accumulate(e->project[k], value, e->fine_wb[0], SB_EHL_QUAD, columns);
  }
  if (e->side == 0) {
    expand(e);
    return;
  }
  // Integral with ln s, the distance from the infinite end.
  memset(e->log_s, 0, sizeof e->log_s);
  add_log(e->log_s, e, tables, e->side, 0.0);
  add_constant(e->log_s, e, -log(2.0));
}

// Infinite elements: |X - X'| = |B + a s^2| / s^2 with a = X - A (inlet) or A - X (outlet).
static void row_infinite(double *row, const SbEhlElement *e, const SbEhlTables *tables, double X) {
  for (int j = 0; j <= e->degree; j++) {
    row[j] -= 2.0 * e->log_s[j];
  }
  // Roots s = +-y or +-iy, finite ones to rounding; in r they are side (1 - 2 s).
  double a = e->side * (e->A - X);
  double size = fmax(fabs(a), 1e-16 * e->B);
  double y = 2.0 * sqrt(e->B / size);
  for (int sign = -1; sign <= 1; sign += 2) {
    add_log(row, e, tables, e->side * (1.0 + (a < 0.0 ? sign * y : 0.0)), a < 0.0 ? 0.0 : y);
  }
  add_constant(row, e, log(0.25 * size));
}

void sb_ehl_kernel_row(double *row, const SbEhlElement *e, const SbEhlTables *tables, double X) {
  if (e->side != 0) {
    row_infinite(row, e, tables, X);
    return;
  }
  double z = fabs(X - e->middle) / e->half;
  if (z > FAR) {
    add_constant(row, e, log(z * e->half));
    double inverse = e->half / (X - e->middle);
    int terms = (int)fmin(DIGITS / log(z) + 1.0, SB_EHL_MULTIPOLES);
    double power[SB_EHL_MULTIPOLES] = {inverse};
    for (int m = 1; m < terms; m++) {
      power[m] = power[m - 1] * inverse;
    }
    accumulate(row, power, e->multipole[0], terms, e->degree + 1);
    return;
  }
  // The target's own coordinate, complex outside |X| <= 1 on the cosine map.
  double imaginary = 0.0;
  double real;
  if (e->map == SB_EHL_AFFINE) {
    real = (X - e->m) / e->h;
  } else if (fabs(X) <= 1.0) {
    real = (acos(-X) - e->m) / e->h;
  } else {
    real = ((X < 0.0 ? 0.0 : M_PI) - e->m) / e->h;
    imaginary = acosh(fabs(X)) / e->h;
  }
  add_log(row, e, tables, real, imaginary);
  if (e->map == SB_EHL_AFFINE) {
    add_constant(row, e, log(e->h));
    return;
  }
  // Remainder of the cosine map's kernel, ln|(X - X')/(z - r)|, smooth in r.
  double value[SB_EHL_QUAD];
  for (int q = 0; q < SB_EHL_QUAD; q++) {
    double dr = real - tables->fine[q];
    double dX = X - e->fine_x[q];
    value[q] = 0.5 * log(dX * dX / (dr * dr + imaginary * imaginary));
  }
  add_values(row, e, value);
}
