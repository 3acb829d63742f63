// Dry rough contact by an independent method, for the tests of films with asperities: uniform cells
// of constant pressure, the half-plane's closed kernel and, if there is one, the smooth part of a
// fitted body at the cells' middles, Newton's method on the asperities' separations.
#pragma once

#include "engine/contact/compliance.h"
#include "engine/contact/rough/greenwood_tripp.h"
#include "tests/engine/films.h"

#include <glib.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Mean gap [m] of surfaces whose mean planes stand lambda sigma apart undeformed, by its closed
// form.
static inline double average_gap(double sigma, double lambda) {
  return sigma *
         (lambda * 0.5 * erfc(-lambda / G_SQRT2) + exp(-lambda * lambda / 2) / sqrt(2 * G_PI));
}

// Pressure of the asperities [Pa] (Greenwood and Tripp).
static inline double asperity_pressure(const SbFilmProblem *problem, double lambda) {
  return sb_gt_pressure(problem->gt_product, problem->sigma_over_beta, problem->modulus, lambda);
}

// Gap [m] at x of the undeformed body.
static inline double body_gap(const SbFilmProblem *problem, double x) {
  return problem->compliance != NULL ? sb_compliance_gap(problem->compliance, x, NULL)
                                     : x * x / (2 * problem->radius);
}

// kernel[i cells + j]: deflection at i for a unit of pressure on cell j [m/Pa].
static inline void cell_kernel(double *kernel, const SbFilmProblem *problem, int cells,
                               double half) {
  const SbSurfaceCompliance *c = problem->compliance;
  const double dx = 2 * half / cells;
  const int modes = c != NULL ? c->modes : 0;
  double *mode = g_new0(double, cells *SB_COMPLIANCE_MODES);
  for (int i = 0; c != NULL && i < cells; i++) {
    sb_compliance_modes(c, -half + (i + 0.5) * dx, mode + i * SB_COMPLIANCE_MODES, NULL);
  }
  for (int i = 0; i < cells; i++) {
    for (int j = 0; j < cells; j++) {
      const double a = (abs(i - j) - 0.5) * dx, b = (abs(i - j) + 0.5) * dx;
      double sum = -4 / (G_PI * (c != NULL ? c->modulus : problem->modulus)) *
                   (b * (log(fabs(b)) - 1) - a * (log(fabs(a)) - 1));
      for (int k = 0; k < modes; k++) {
        for (int l = 0; l < modes; l++) {
          sum += dx * c->smooth[k][l] * mode[i * SB_COMPLIANCE_MODES + k] *
                 mode[j * SB_COMPLIANCE_MODES + l];
        }
      }
      kernel[i * cells + j] = sum;
    }
  }
  g_free(mode);
}

// Central gap [m] of the contact under problem->load on cells over |x| < half; *peak is the largest
// pressure [Pa].
static inline double dry_by_cells(double *peak, const SbFilmProblem *problem, int cells,
                                  double half) {
  const int order = cells + 1;
  const double dx = 2 * half / cells;
  double *kernel = g_new(double, cells *cells), *A = g_new(double, order *order);
  double *right = g_new(double, order), *lambda = g_new(double, cells), *p = g_new(double, cells);
  lapack_int *pivot = g_new(lapack_int, order);
  cell_kernel(kernel, problem, cells, half);
  for (int i = 0; i < cells; i++) {
    lambda[i] = fabs(-half + (i + 0.5) * dx) < half / 1.5 ? -1 : 3;
  }
  double H0 = 0, worst = INFINITY;
  for (int pass = 0; pass < 200 && worst > 1e-9; pass++) {
    memset(A, 0, (size_t)order * (size_t)order * sizeof *A);
    right[cells] = problem->load;
    for (int i = 0; i < cells; i++) {
      p[i] = asperity_pressure(problem, lambda[i]);
      const double by = (asperity_pressure(problem, lambda[i] + 1e-6) - p[i]) / 1e-6;
      for (int k = 0; k < cells; k++) {
        A[k + i * order] = kernel[k * cells + i] * by;
      }
      A[i + i * order] -= problem->sigma * 0.5 * erfc(-lambda[i] / G_SQRT2);
      A[i + cells * order] = 1;
      A[cells + i * order] = by * dx;
      right[cells] -= p[i] * dx;
    }
    for (int i = 0; i < cells; i++) {
      right[i] =
          average_gap(problem->sigma, lambda[i]) - H0 - body_gap(problem, -half + (i + 0.5) * dx);
      for (int j = 0; j < cells; j++) {
        right[i] -= kernel[i * cells + j] * p[j];
      }
    }
    g_assert_cmpint(LAPACKE_dgesv(LAPACK_COL_MAJOR, order, 1, A, order, pivot, right, order), ==,
                    0);
    worst = 0;
    for (int i = 0; i < cells; i++) {
      worst = fmax(worst, fabs(right[i]));
      lambda[i] = CLAMP(lambda[i] + CLAMP(right[i], -0.7, 0.7), -9, 36);
    }
    H0 += right[cells];
  }
  g_assert_cmpfloat(worst, <=, 1e-9);
  *peak = 0;
  for (int i = 0; i < cells; i++) {
    *peak = fmax(*peak, p[i]);
  }
  const double central = average_gap(problem->sigma, lambda[cells / 2]);
  g_free(kernel);
  g_free(A);
  g_free(right);
  g_free(lambda);
  g_free(p);
  g_free(pivot);
  return central;
}

// A solved film at rest against cells over 1.5 times the half-width of the smooth dry contact:
// within 5e-4 at 225 cells, and it is the cells that are off.
static inline void check_dry_contact(const SbFilm *film, const SbFilmProblem *problem,
                                     double half_width) {
  close_to("asperities' share at rest", film->asperity_share, 1, 1e-9);
  double peak[2];
  const double coarse = dry_by_cells(&peak[0], problem, 75, 1.5 * half_width);
  const double fine = dry_by_cells(&peak[1], problem, 225, 1.5 * half_width);
  const double error[2] = {fabs(coarse / film->film_central - 1),
                           fabs(fine / film->film_central - 1)};
  g_test_message("cells off by %.2g and %.2g, order %.2f", error[0], error[1],
                 log(error[0] / error[1]) / log(3));
  close_to("central gap", fine, film->film_central, 5e-4);
  close_to("largest pressure", peak[1], film->pressure_max, 5e-4);
  g_assert_cmpfloat(error[1], <, 0.35 * error[0]);
}
