// Axis of a body by its moments. See solid.h.
#include "engine/mechanism/solid.h"

#include <gsl/gsl_eigen.h>

#include <math.h>

// How far moments about the axis k of a frame are from those of a body of revolution, relative to
// the moments across it.
static double asymmetry(const double inertia[3][3], int k) {
  const int a = (k + 1) % 3, b = (k + 2) % 3;
  const double across = hypot(inertia[a][a] - inertia[b][b], 2 * inertia[a][b]);
  const double along = 2 * hypot(inertia[k][a], inertia[k][b]);
  return hypot(across, along) / (inertia[a][a] + inertia[b][b]);
}

bool sb_solid_axis(double axis[3], const double inertia[3][3]) {
  static const double UNEVEN = 0.02, CLEARLY = 0.1;
  double a[9], values[3], vectors[9], principal[3][3] = {{0}};
  int best = 0, other = 0, largest = 0;
  for (int k = 0; k < 9; k++) {
    a[k] = inertia[k / 3][k % 3];
  }
  gsl_matrix_view matrix = gsl_matrix_view_array(a, 3, 3);
  gsl_matrix_view columns = gsl_matrix_view_array(vectors, 3, 3);
  gsl_vector_view diagonal = gsl_vector_view_array(values, 3);
  unsigned rotations;
  (void)gsl_eigen_jacobi(&matrix.matrix, &diagonal.vector, &columns.matrix, 60, &rotations);
  for (int k = 0; k < 3; k++) {
    principal[k][k] = values[k];
    best = asymmetry(inertia, k) < asymmetry(inertia, best) ? k : best;
  }
  double own[3], second = INFINITY;
  for (int k = 0; k < 3; k++) {
    own[k] = asymmetry((const double(*)[3])principal, k);
    other = own[k] < own[other] ? k : other;
  }
  for (int k = 0; k < 3; k++) {
    second = k != other ? fmin(second, own[k]) : second;
  }
  const double off = asymmetry(inertia, best);
  const bool turned =
      off > fmin(UNEVEN, CLEARLY * second) && own[other] < fmin(UNEVEN, CLEARLY * off);
  for (int k = 0; k < 3; k++) {
    axis[k] = turned ? vectors[3 * k + other] : k == best;
    largest = fabs(axis[k]) > fabs(axis[largest]) ? k : largest;
  }
  for (int k = 0; k < 3 && axis[largest] < 0; k++) {
    axis[k] = k == largest ? axis[k] : -axis[k];
  }
  axis[largest] = fabs(axis[largest]);
  return second > UNEVEN || own[other] < CLEARLY * second;
}
