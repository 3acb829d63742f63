// See radau.h. The unknowns are the stage rates k_i = f(t + c_i h, z + h sum_j a_ij k_j), found by
// a simplified Newton iteration with a differenced Jacobian: at most 30 unknowns, dense LU. The
// halves of a pair start from the rates of the whole step, between its nodes.
#include "engine/mechanism/radau.h"

#include "engine/numeric/dense.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { S = SB_RADAU_STAGES, N = SB_RADAU_MAX, UNKNOWNS = SB_RADAU_STAGES * SB_RADAU_MAX };

#define ROOT6 2.449489742783178

static const double node[S] = {(4.0 - ROOT6) / 10.0, (4.0 + ROOT6) / 10.0, 1.0};
static const double butcher[S][S] = {
    {(88.0 - 7.0 * ROOT6) / 360.0, (296.0 - 169.0 * ROOT6) / 1800.0, (-2.0 + 3.0 * ROOT6) / 225.0},
    {(296.0 + 169.0 * ROOT6) / 1800.0, (88.0 + 7.0 * ROOT6) / 360.0, (-2.0 - 3.0 * ROOT6) / 225.0},
    {(16.0 - ROOT6) / 36.0, (16.0 + ROOT6) / 36.0, 1.0 / 9.0},
};

// Newton's iteration ends below this share of the tolerance, or below that one once its updates no
// longer shrink: what is left is rounding, of whatever size the rates make of it.
static const double enough = 1e-3, stalled = 0.1;

// Factors of a step's equations.
typedef struct {
  size_t size;
  double m[UNKNOWNS * UNKNOWNS];
  size_t pivot[UNKNOWNS];
} Factors;

static double scale(const SbRadauSystem *s, size_t i, double value) {
  double size = fabs(value) + s->floor[i];
  return s->tolerance * (s->ceiling[i] > 0.0 ? fmin(size, s->ceiling[i]) : size);
}

// Forward differences of the rates; `base` are the rates at z.
static void jacobian(double j[N][N], double *base, const SbRadauSystem *s, double t,
                     const double *z) {
  double moved[N] = {0}, dz[N];
  s->rates(base, NULL, t, z, s->user);
  memcpy(moved, z, s->n * sizeof *z);
  for (size_t c = 0; c < s->n; c++) {
    double step = sqrt(DBL_EPSILON) * (fabs(z[c]) + s->floor[c]);
    moved[c] = z[c] + step;
    step = moved[c] - z[c];
    s->rates(dz, NULL, t, moved, s->user);
    for (size_t r = 0; r < s->n; r++) {
      j[r][c] = (dz[r] - base[r]) / step;
    }
    moved[c] = z[c];
  }
}

// Rates of a solved step at a fraction theta of it: the parabola through its stages.
static void rates_at(double *k, const SbRadauStep *step, size_t n, double theta) {
  double weight[S];
  for (int i = 0; i < S; i++) {
    double p = node[(i + 1) % S], q = node[(i + 2) % S];
    weight[i] = (theta - p) * (theta - q) / ((node[i] - p) * (node[i] - q));
  }
  for (size_t i = 0; i < n; i++) {
    k[i] = weight[0] * step->k[0][i] + weight[1] * step->k[1][i] + weight[2] * step->k[2][i];
  }
}

// I - h A (x) J, factorised.
static bool prepare(Factors *f, size_t n, double h, double j[N][N]) {
  f->size = S * n;
  for (size_t a = 0; a < S; a++) {
    for (size_t r = 0; r < n; r++) {
      for (size_t b = 0; b < S; b++) {
        double factor = h * butcher[a][b];
        for (size_t c = 0; c < n; c++) {
          f->m[a * n + r + (b * n + c) * f->size] = -factor * j[r][c];
        }
      }
      f->m[(a * n + r) * (f->size + 1)] += 1.0;
    }
  }
  return sb_lu_factor(f->m, f->pivot, f->size);
}

// Writes the residuals of the stage rates, and the rates of the powers if they are `wanted`.
static void stage_residuals(double *residual, SbRadauStep *step, const SbRadauSystem *s, double t,
                            const double *z, double h, bool wanted) {
  for (size_t a = 0; a < S; a++) {
    double at[N] = {0}, dz[N];
    for (size_t i = 0; i < s->n; i++) {
      at[i] = z[i] + h * (butcher[a][0] * step->k[0][i] + butcher[a][1] * step->k[1][i] +
                          butcher[a][2] * step->k[2][i]);
    }
    s->rates(dz, wanted ? step->q[a] : NULL, t + node[a] * h, at, s->user);
    for (size_t i = 0; i < s->n; i++) {
      residual[a * s->n + i] = dz[i] - step->k[a][i];
    }
  }
}

// The stage rates in `step` are where the iteration starts; `f` is prepared for h. The powers are
// taken, if they are `wanted`, one update before the rates: that update must then be small, else
// what is left after it.
static bool solve(SbRadauStep *step, const SbRadauSystem *s, double t, const double *z, double h,
                  const Factors *f, bool wanted, long *iterations) {
  enum { ITERATIONS = 12 };
  step->t = t;
  step->h = h;
  memcpy(step->z0, z, s->n * sizeof *z);
  double previous = INFINITY;
  double noise = 0.0; // of an update, divided by its tolerance, as far as the system knows
  for (size_t i = 0; i < s->n; i++) {
    noise = fmax(noise, h * s->noise[i] / scale(s, i, z[i]));
  }
  const bool noisy = s->noisy && noise > 0.0;
  for (int iteration = 0; iteration < ITERATIONS; iteration++) {
    double residual[UNKNOWNS];
    stage_residuals(residual, step, s, t, z, h, wanted);
    ++*iterations;
    sb_lu_solve(f->m, f->pivot, residual, f->size);
    double size = 0.0;
    bool rounding = true;
    for (size_t a = 0; a < S; a++) {
      for (size_t i = 0; i < s->n; i++) {
        double change = residual[a * s->n + i];
        step->k[a][i] += change;
        size = fmax(size, fabs(h * change) / scale(s, i, z[i]));
        rounding = rounding && fabs(change) <= 64.0 * DBL_EPSILON * fabs(step->k[a][i]) +
                                                   (noisy ? s->noise[i] : 0.0);
      }
    }
    if (!isfinite(size)) {
      return false;
    }
    // The iteration contracts steadily: the next update would be smaller by as much as this one.
    double left = iteration > 0 ? size * (size / previous) : size;
    bool floor = noisy && iteration > 1 && size < stalled && size > 0.8 * previous;
    const bool ends = iteration + 1 == ITERATIONS || (iteration > 1 && size > 2.0 * previous);
    // Where the iteration does not converge, updates of the size of the rounding are its end.
    floor = floor || (ends && size < stalled && size <= noise);
    if ((wanted ? size : left) < enough || rounding || floor) {
      for (size_t i = 0; i < s->n; i++) {
        step->z1[i] = z[i];
        for (size_t b = 0; b < S; b++) {
          step->z1[i] += h * butcher[S - 1][b] * step->k[b][i];
        }
      }
      return true;
    }
    if (ends) {
      return false;
    }
    previous = size;
  }
  return false;
}

bool sb_radau_pair(SbRadauStep pair[2], double *error, double *local, const SbRadauSystem *system,
                   double t, const double *z, double h, long *iterations) {
  double j[N][N], base[N];
  SbRadauStep whole;
  jacobian(j, base, system, t, z);
  for (size_t a = 0; a < S; a++) {
    memcpy(whole.k[a], base, system->n * sizeof *base);
  }
  Factors f;
  if (!prepare(&f, system->n, h, j) || !solve(&whole, system, t, z, h, &f, false, iterations) ||
      !prepare(&f, system->n, 0.5 * h, j)) {
    return false;
  }
  for (int half = 0; half < 2; half++) {
    for (int a = 0; a < S; a++) {
      rates_at(pair[half].k[a], &whole, system->n, 0.5 * (half + node[a]));
    }
    double from = t + 0.5 * half * h;
    if (!solve(&pair[half], system, from, half > 0 ? pair[0].z1 : z, 0.5 * h, &f, true,
               iterations)) {
      return false;
    }
  }
  *error = 0.0;
  for (size_t i = 0; i < system->n; i++) {
    local[i] = fabs(whole.z1[i] - pair[1].z1[i]) / 31.0;
    *error = fmax(*error, local[i] / scale(system, i, fmax(fabs(z[i]), fabs(pair[1].z1[i]))));
  }
  return isfinite(*error);
}

void sb_radau_dense(const SbRadauStep *step, const SbRadauSystem *system, double theta, double *z,
                    double *integral) {
  // Integrals over (0, theta) of the Lagrange polynomials on the three nodes.
  double b[S];
  for (int i = 0; i < S; i++) {
    double p = node[(i + 1) % S], q = node[(i + 2) % S];
    double norm = (node[i] - p) * (node[i] - q);
    b[i] = theta * (theta * (theta / 3.0 - 0.5 * (p + q)) + p * q) / norm;
  }
  for (size_t i = 0; z != NULL && i < system->n; i++) {
    z[i] = step->z0[i];
    for (int a = 0; a < S; a++) {
      z[i] += step->h * b[a] * step->k[a][i];
    }
  }
  for (size_t i = 0; integral != NULL && i < system->powers; i++) {
    integral[i] = 0.0;
    for (int a = 0; a < S; a++) {
      integral[i] += step->h * b[a] * step->q[a][i];
    }
  }
}
