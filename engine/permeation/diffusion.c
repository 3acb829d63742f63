// See diffusion.h. Rows of wetted nodes are separated: the system has the other nodes, and the full
// matrices give the reactions.
#include "engine/permeation/diffusion.h"
#include "engine/numeric/cholesky.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Dunavant's rule of degree 6 (Int. J. Numer. Meth. Engng 21 (1985) 1129).
enum { POINTS = 12 };
static const double POINT[POINTS][3] = {{0.249286745170910, 0.249286745170910, 0.116786275726379},
                                        {0.501426509658179, 0.249286745170910, 0.116786275726379},
                                        {0.249286745170910, 0.501426509658179, 0.116786275726379},
                                        {0.063089014491502, 0.063089014491502, 0.050844906370207},
                                        {0.873821971016996, 0.063089014491502, 0.050844906370207},
                                        {0.063089014491502, 0.873821971016996, 0.050844906370207},
                                        {0.053145049844817, 0.310352451033784, 0.082851075618374},
                                        {0.310352451033784, 0.053145049844817, 0.082851075618374},
                                        {0.053145049844817, 0.636502499121399, 0.082851075618374},
                                        {0.636502499121399, 0.053145049844817, 0.082851075618374},
                                        {0.310352451033784, 0.636502499121399, 0.082851075618374},
                                        {0.636502499121399, 0.310352451033784, 0.082851075618374}};

struct SbDiffusion {
  const SbWettedMesh *section; // borrowed
  int n, free;                 // nodes; those that are not wetted
  int *start, *column;         // pattern of the whole matrices, [n + 1], [start[n]]
  double *stiff, *mass;        // on it
  int *number;                 // [n] among the free nodes, -1: wetted
  int *free_start, *free_column,
      *source;   // pattern of the free nodes; their entries in the full one
  double *value; // on it
  double *field; // [n] steady
  double conductance, flux_in, flux_out, lag, volume;
};

void sb_diffusion_destroy(SbDiffusion *d) {
  if (d != NULL) {
    free(d->start);
    free(d->column);
    free(d->stiff);
    free(d->number);
    free(d->free_column);
    free(d->value);
    free(d->field);
    free(d);
  }
}

static void shapes(double l1, double l2, double n[6], double d1[6], double d2[6]) {
  const double l0 = 1.0 - l1 - l2, l[3] = {l0, l1, l2};
  const double g1[3] = {-1.0, 1.0, 0.0}, g2[3] = {-1.0, 0.0, 1.0};
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3;
    n[i] = l[i] * (2.0 * l[i] - 1.0);
    d1[i] = g1[i] * (4.0 * l[i] - 1.0);
    d2[i] = g2[i] * (4.0 * l[i] - 1.0);
    n[3 + i] = 4.0 * l[i] * l[j];
    d1[3 + i] = 4.0 * (g1[i] * l[j] + l[i] * g1[j]);
    d2[3 + i] = 4.0 * (g2[i] * l[j] + l[i] * g2[j]);
  }
}

// Shapes n and their gradients g [1/m] at a point of an element. Returns the density of the area
// there, including the circumference, [m2] or [m3].
static double gradients(const SbWettedMesh *s, const int *tri, double l1, double l2, double n[6],
                        double g[6][2]) {
  double d1[6], d2[6], j[2][2] = {{0.0}}, radius = 0.0;
  shapes(l1, l2, n, d1, d2);
  for (int a = 0; a < 6; a++) {
    const double *x = &s->place[(size_t)2 * tri[a]];
    for (int k = 0; k < 2; k++) {
      j[0][k] += d1[a] * x[k];
      j[1][k] += d2[a] * x[k];
    }
    radius += n[a] * x[0];
  }
  const double det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
  for (int a = 0; a < 6; a++) {
    g[a][0] = (j[1][1] * d1[a] - j[0][1] * d2[a]) / det;
    g[a][1] = (j[0][0] * d2[a] - j[1][0] * d1[a]) / det;
  }
  return 0.5 * det * (s->axisymmetric ? 2.0 * M_PI * radius : 1.0);
}

// The pattern of the nodes that share an element ----------------------------------------------

static int compare(const void *a, const void *b) {
  return *(const int *)a - *(const int *)b;
}

static bool find_pattern(SbDiffusion *d) {
  const SbWettedMesh *s = d->section;
  const int n = d->n;
  int *fill = calloc((size_t)n + 1, sizeof *fill);
  d->start = calloc((size_t)n + 1, sizeof *d->start);
  d->column = malloc(36 * sizeof *d->column * ((size_t)s->elements + 1));
  if (fill == NULL || d->start == NULL || d->column == NULL) {
    free(fill);
    return false;
  }
  for (int i = 0; i < 6 * s->elements; i++) {
    d->start[s->triangle[i] + 1] += 6;
  }
  for (int i = 0; i < n; i++) {
    d->start[i + 1] += d->start[i];
  }
  for (int i = 0; i < 6 * s->elements; i++) {
    const int row = s->triangle[i], *tri = &s->triangle[(size_t)6 * (i / 6)];
    memcpy(&d->column[d->start[row] + fill[row]], tri, 6 * sizeof *tri);
    fill[row] += 6;
  }
  // Each row in order and without its repetitions.
  int out = 0;
  for (int i = 0; i < n; i++) {
    int *row = &d->column[d->start[i]];
    const int count = fill[i];
    qsort(row, (size_t)count, sizeof *row, compare);
    d->start[i] = out;
    for (int k = 0; k < count; k++) {
      if (k == 0 || row[k] != row[k - 1]) {
        fill[0] = row[k]; // `row` and what is written may overlap
        d->column[out++] = fill[0];
      }
    }
  }
  d->start[n] = out;
  free(fill);
  return true;
}

static size_t entry(const SbDiffusion *d, int row, int column) {
  int low = d->start[row], high = d->start[row + 1] - 1;
  while (low < high) {
    const int middle = (low + high) / 2;
    if (d->column[middle] < column) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return (size_t)low;
}

// False where an element is turned inside out.
static bool assemble(SbDiffusion *d) {
  const SbWettedMesh *s = d->section;
  for (int e = 0; e < s->elements; e++) {
    const int *tri = &s->triangle[(size_t)6 * e];
    double k[6][6] = {{0.0}}, m[6][6] = {{0.0}}, n[6], g[6][2];
    for (int q = 0; q < POINTS; q++) {
      const double w = POINT[q][2] * gradients(s, tri, POINT[q][0], POINT[q][1], n, g);
      if (!(w > 0.0)) {
        return false;
      }
      for (int a = 0; a < 6; a++) {
        for (int b = 0; b < 6; b++) {
          k[a][b] += w * (g[a][0] * g[b][0] + g[a][1] * g[b][1]);
          m[a][b] += w * n[a] * n[b];
        }
      }
    }
    for (int a = 0; a < 6; a++) {
      for (int b = 0; b < 6; b++) {
        const size_t at = entry(d, tri[a], tri[b]);
        d->stiff[at] += k[a][b];
        d->mass[at] += m[a][b];
      }
    }
  }
  return true;
}

static bool find_free(SbDiffusion *d) {
  const int n = d->n;
  d->number = malloc(sizeof *d->number * (2 * (size_t)n + 2));
  d->free_column = malloc(2 * sizeof *d->free_column * ((size_t)d->start[n] + 1));
  d->value = calloc((size_t)d->start[n] + 1, sizeof *d->value);
  d->field = calloc((size_t)n + 1, sizeof *d->field);
  if (d->number == NULL || d->free_column == NULL || d->value == NULL || d->field == NULL) {
    return false;
  }
  d->free_start = d->number + n;
  d->source = d->free_column + d->start[n] + 1;
  for (int i = 0; i < n; i++) {
    d->number[i] = d->section->face[i] == SB_FACE_DRY ? d->free++ : -1;
  }
  int out = 0;
  for (int i = 0; i < n; i++) {
    if (d->number[i] < 0) {
      continue;
    }
    d->free_start[d->number[i]] = out;
    for (int at = d->start[i]; at < d->start[i + 1]; at++) {
      if (d->number[d->column[at]] >= 0) {
        d->source[out] = at;
        d->free_column[out++] = d->number[d->column[at]];
      }
    }
  }
  d->free_start[d->free] = out;
  return true;
}

// Factorises the stiffness matrix of the free nodes.
static SbStatus factorise(SbCholesky *factor, const SbDiffusion *d, SbReport *report) {
  for (int i = 0; i < d->free_start[d->free]; i++) {
    d->value[i] = d->stiff[d->source[i]];
  }
  return sb_cholesky_compute(factor, d->value)
             ? sb_succeed(report)
             : sb_fail(report, SB_ERROR_NOT_CONVERGED,
                       "the section's equations are singular: a part of it has no wetted face");
}

// Returns a row of K u; K is the stiffness matrix.
static double row_times(const SbDiffusion *d, int row, const double *u) {
  double sum = 0.0;
  for (int at = d->start[row]; at < d->start[row + 1]; at++) {
    sum += d->stiff[at] * u[d->column[at]];
  }
  return sum;
}

// Returns the sum of the reactions K u of a face's nodes in the steady state.
static double reaction(const SbDiffusion *d, SbFace face) {
  double sum = 0.0;
  for (int i = 0; i < d->n; i++) {
    if (d->section->face[i] == face) {
      sum += row_times(d, i, d->field);
    }
  }
  return sum;
}

static SbStatus solve_steady(SbDiffusion *d, SbReport *report) {
  SbCholesky *factor = sb_cholesky_create(d->free, d->free_start, d->free_column);
  double *b = calloc((size_t)d->free + 1, sizeof *b);
  SbStatus status = factor == NULL || b == NULL
                        ? sb_fail(report, SB_ERROR_MEMORY, "no memory for a section's equations")
                        : factorise(factor, d, report);
  for (int i = 0; i < d->n; i++) {
    d->field[i] = d->section->face[i] == SB_FACE_INSIDE ? 1.0 : 0.0;
  }
  // The correction is solved once more, so that the rounding error does not depend on the mesh.
  for (int pass = 0; status == SB_OK && pass < 2; pass++) {
    for (int i = 0; i < d->n; i++) {
      if (d->number[i] >= 0) {
        b[d->number[i]] = -row_times(d, i, d->field);
      }
    }
    sb_cholesky_solve(factor, b);
    for (int i = 0; i < d->n; i++) {
      d->field[i] += d->number[i] >= 0 ? b[d->number[i]] : 0.0;
    }
  }
  sb_cholesky_destroy(factor);
  free(b);
  return status;
}

static void take_figures(SbDiffusion *d) {
  double held = 0.0;
  for (int i = 0; i < d->n; i++) {
    double of_rest = 0.0, whole = 0.0;
    for (int at = d->start[i]; at < d->start[i + 1]; at++) {
      of_rest += d->mass[at] * (1.0 - d->field[d->column[at]]);
      whole += d->mass[at];
    }
    held += d->field[i] * of_rest;
    d->volume += whole;
  }
  d->flux_in = reaction(d, SB_FACE_INSIDE);
  d->flux_out = -reaction(d, SB_FACE_OUTSIDE);
  d->conductance = 0.5 * (d->flux_in + d->flux_out);
  d->lag = held / d->conductance;
}

static SbStatus check_section(const SbWettedMesh *s, SbReport *report) {
  int inside = 0, outside = 0;
  for (int i = 0; i < s->nodes; i++) {
    inside += s->face[i] == SB_FACE_INSIDE;
    outside += s->face[i] == SB_FACE_OUTSIDE;
  }
  for (int i = 0; i < 6 * s->elements; i++) {
    if (s->triangle[i] < 0 || s->triangle[i] >= s->nodes) {
      return sb_fail(report, SB_ERROR_INPUT, "a triangle of the section names no node");
    }
  }
  return inside > 0 && outside > 0
             ? sb_succeed(report)
             : sb_fail(report, SB_ERROR_INPUT, "no side of the section is wetted from %s",
                       inside > 0 ? "outside" : "inside");
}

SbStatus sb_diffusion_create(SbDiffusion **out, const SbWettedMesh *section, SbReport *report) {
  *out = NULL;
  SbStatus status = check_section(section, report);
  if (status != SB_OK) {
    return status;
  }
  SbDiffusion *d = calloc(1, sizeof *d);
  if (d != NULL) {
    d->section = section;
    d->n = section->nodes;
  }
  if (d == NULL || !find_pattern(d) || !find_free(d) ||
      (d->stiff = calloc(2 * (size_t)d->start[d->n] + 1, sizeof *d->stiff)) == NULL) {
    sb_diffusion_destroy(d);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a section of %d nodes", section->nodes);
  }
  d->mass = d->stiff + d->start[d->n];
  status = assemble(d)
               ? solve_steady(d, report)
               : sb_fail(report, SB_ERROR_INPUT, "an element of the section is turned inside out");
  if (status != SB_OK) {
    sb_diffusion_destroy(d);
    return status;
  }
  take_figures(d);
  *out = d;
  return sb_succeed(report);
}

void sb_diffusion_steady(SbDiffusionSteady *out, const SbDiffusion *d) {
  *out = (SbDiffusionSteady){.conductance = d->conductance,
                             .flux_in = d->flux_in,
                             .flux_out = d->flux_out,
                             .lag = d->lag,
                             .volume = d->volume};
}

// Size of the gradient at corner or mid-side `a` of an element.
static double slope_at(const SbDiffusion *d, const int *tri, int a) {
  static const double L1[6] = {0.0, 1.0, 0.0, 0.5, 0.5, 0.0};
  static const double L2[6] = {0.0, 0.0, 1.0, 0.0, 0.5, 0.5};
  double n[6], g[6][2], slope[2] = {0.0, 0.0};
  (void)gradients(d->section, tri, L1[a], L2[a], n, g);
  for (int b = 0; b < 6; b++) {
    slope[0] += g[b][0] * d->field[tri[b]];
    slope[1] += g[b][1] * d->field[tri[b]];
  }
  return hypot(slope[0], slope[1]);
}

SbStatus sb_diffusion_gradient(double *out, const SbDiffusion *d, SbReport *report) {
  const SbWettedMesh *s = d->section;
  int *visits = calloc((size_t)d->n + 1, sizeof *visits);
  if (visits == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a section's gradient");
  }
  memset(out, 0, sizeof *out * (size_t)d->n);
  for (int i = 0; i < 6 * s->elements; i++) {
    const int node = s->triangle[i];
    if (s->end[node] == 0) {
      out[node] += slope_at(d, &s->triangle[(size_t)6 * (i / 6)], i % 6);
      visits[node]++;
    }
  }
  for (int i = 0; i < d->n; i++) {
    out[i] /= visits[i] > 0 ? visits[i] : 1;
  }
  for (int i = 0; i < d->n; i++) {
    int count = 0;
    for (int at = d->start[i]; s->end[i] != 0 && at < d->start[i + 1]; at++) {
      const int other = d->column[at];
      out[i] += s->end[other] == 0 ? out[other] : 0.0;
      count += s->end[other] == 0;
    }
    out[i] /= count > 0 ? count : 1;
  }
  free(visits);
  return sb_succeed(report);
}

// To an estimated error ------------------------------------------------------------------------

static SbStatus solve_quartered(SbDiffusionSteady *out, SbWettedMesh *section, SbReport *report) {
  SbDiffusion *d;
  sb_wetted_mesh_quarter(section);
  SbStatus status = sb_diffusion_create(&d, section, report);
  if (status == SB_OK) {
    sb_diffusion_steady(out, d);
  }
  sb_diffusion_destroy(d);
  return status;
}

static double extrapolated(double fine, double coarse) {
  return fine + (fine - coarse);
}

SbStatus sb_diffusion_converge(SbDiffusionConverged *out, const SbWettedMesh *section,
                               SbReport *report) {
  SbDiffusionSteady fine, coarse;
  SbWettedMesh *same = NULL, *parted = NULL;
  SbStatus status = sb_wetted_mesh_copy(&same, section, report);
  status = status == SB_OK ? sb_wetted_mesh_split(&parted, section, report) : status;
  status = status == SB_OK ? solve_quartered(&coarse, same, report) : status;
  status = status == SB_OK ? solve_quartered(&fine, parted, report) : status;
  sb_wetted_mesh_destroy(same);
  sb_wetted_mesh_destroy(parted);
  if (status != SB_OK) {
    return status;
  }
  *out =
      (SbDiffusionConverged){.steady = fine,
                             .error = 0.5 * fmax(fabs(coarse.conductance / fine.conductance - 1.0),
                                                 fabs(coarse.lag / fine.lag - 1.0)),
                             .flux_gap = fabs(fine.flux_in - fine.flux_out) / fine.conductance};
  out->steady.conductance = extrapolated(fine.conductance, coarse.conductance);
  out->steady.lag = extrapolated(fine.lag, coarse.lag);
  return sb_succeed(report);
}
