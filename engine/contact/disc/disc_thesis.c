// The thesis' disc with one-degree nodes; see the header. Lengths in the fitted radius, pressures
// times C.
#include "engine/contact/disc/disc_thesis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/base/check.h"
#include "engine/contact/disc/disc_kernel.h"
#include "engine/numeric/dense.h"
#include "engine/numeric/legendre.h"

enum { MAX = SB_DISC_THESIS_NODES, GAUSS = 5 };

// Workspace: influence of each cell on each node, the factorised part of it, right-hand side.
typedef struct {
  SbDiscKernel kernel;
  size_t count; // nodes within 75 degrees
  double step;
  double space;                // radial space over the fitted section
  double influence[MAX * MAX]; // by columns: inward displacement at i by unit pressure on cell j
  double matrix[MAX * MAX];
  double wanted[MAX];
  SbDiscPoint node[MAX];
  double fluid[MAX]; // inward displacement by the fluid
  double pressure[MAX];
  double gauss_x[GAUSS], gauss_w[GAUSS];
} Work;

static const SbDiscVector down = {0.0, -1.0};
static const double nodes_limit = 75.0 / 180.0 * M_PI;

// Inward displacement at `to` of unit pressure per projected width on the cell [a, b] and its image
// below: two Gauss points for what is smooth over a degree, the logarithm exactly.
static double cell(const Work *w, SbDiscPoint to, double a, double b) {
  const double sine_a = sin(a);
  const double sine_b = sin(b);
  const double half = 0.5 * (sine_b - sine_a);
  double sum = 0.0;
  for (int side = -1; side <= 1; side += 2) {
    const SbDiscPoint p = sb_disc_point_at(0.5 * (sine_a + sine_b) + side * half / sqrt(3.0));
    double kink;
    sum += half * (sb_disc_kernel_smooth(&w->kernel, to, down, p, down, 0.0, &kink) +
                   sb_disc_kernel_mirror(&w->kernel, to, down, p, down));
  }
  // Minus the integral of ln|xi - xi'|.
  const double ra = to.sin - sine_a;
  const double rb = to.sin - sine_b;
  sum -= (ra != 0.0 ? ra * log(fabs(ra)) : 0.0) - (rb != 0.0 ? rb * log(fabs(rb)) : 0.0) -
         (sine_b - sine_a);
  return sum;
}

static void fill_influence(Work *w) {
  for (size_t j = 0; j < w->count; j++) {
    const double centre = (double)j * w->step;
    for (size_t i = 0; i < w->count; i++) {
      const SbDiscPoint to = w->node[i];
      double sum = cell(w, to, centre - 0.5 * w->step, centre + 0.5 * w->step);
      if (j > 0) {
        sum += cell(w, to, -centre - 0.5 * w->step, -centre + 0.5 * w->step);
      }
      w->influence[i + j * w->count] = sum;
    }
  }
}

// Inward displacement at the first `nodes` nodes by horizontal forces p dbeta on both flanks beyond
// angle alpha, on panels that widen away from it.
static void fill_fluid(Work *w, size_t nodes, double alpha, double pressure) {
  enum { PANELS = 6 };
  const double arc = 0.5 * M_PI - alpha;
  memset(w->fluid, 0, nodes * sizeof(double));
  for (int panel = 0; pressure > 0.0 && panel < PANELS; panel++) {
    const double low = alpha + arc * pow((double)panel / PANELS, 2.0);
    const double high = alpha + arc * pow((panel + 1.0) / PANELS, 2.0);
    for (int k = 0; k < GAUSS; k++) {
      const double half = 0.5 * (high - low);
      const SbDiscPoint right = sb_disc_point(0.5 * (low + high) + half * w->gauss_x[k]);
      const SbDiscPoint left = {.angle = -right.angle, .sin = -right.sin, .cos = right.cos};
      const double weight = pressure * half * w->gauss_w[k];
      for (size_t i = 0; i < nodes; i++) {
        const SbDiscPoint to = w->node[i];
        w->fluid[i] +=
            weight * (sb_disc_kernel_pair(&w->kernel, to, down, right, (SbDiscVector){-1.0, 0.0}) +
                      sb_disc_kernel_pair(&w->kernel, to, down, left, (SbDiscVector){1.0, 0.0}));
      }
    }
  }
}

// Pressure with the first `loaded` nodes on the flat; false if singular. The fluid begins at the
// first node whose cell is wholly outside the contact.
static bool solve_set(Work *w, size_t loaded, double pressure) {
  fill_fluid(w, loaded + 1, ((double)loaded + 0.5) * w->step, pressure);
  for (size_t j = 0; j < loaded; j++) {
    memcpy(&w->matrix[j * loaded], &w->influence[j * w->count], loaded * sizeof(double));
    w->pressure[j] = w->wanted[j] - w->fluid[j];
  }
  return sb_eliminate(w->matrix, w->pressure, loaded);
}

// Gap left at a node that carries no pressure, positive if open.
static double gap(const Work *w, size_t node, size_t loaded) {
  double inward = w->fluid[node];
  for (size_t j = 0; j < loaded; j++) {
    inward += w->influence[node + j * w->count] * w->pressure[j];
  }
  return inward - w->wanted[node];
}

// Number of loaded nodes of the contact within angle `limit`, with their pressure in the workspace;
// 0 if there is none.
static size_t find_contact(Work *w, double limit, double pressure, size_t *iterations) {
  w->count = 1 + (size_t)floor(limit / w->step + 1e-9);
  for (size_t i = 0; i < w->count; i++) {
    w->node[i] = sb_disc_point((double)i * w->step);
    w->wanted[i] = cos((double)i * w->step) - w->space;
  }
  fill_influence(w);

  // Bisect for the smallest set whose next node does not overlap: the gap there grows with the set.
  // As the fluid moves with the edge, its last pressure may then be negative by less than the next
  // node's share; 6.73 drops that node.
  size_t low = 0;
  size_t high = w->count - 2;
  bool ok = true;
  while (ok && high - low > 1) {
    const size_t middle = (low + high) / 2;
    ok = solve_set(w, middle, pressure);
    (*iterations)++;
    if (ok && gap(w, middle, middle) >= 0.0) {
      high = middle;
    } else {
      low = middle;
    }
  }
  ok = ok && high < w->count - 2 && solve_set(w, high, pressure);
  if (ok && high > 1 && w->pressure[high - 1] < 0.0) {
    high--;
    ok = solve_set(w, high, pressure);
  }
  for (size_t j = 0; ok && j < high; j++) {
    ok = w->pressure[j] >= 0.0;
  }
  return ok ? high : 0;
}

SbStatus sb_disc_thesis(SbDiscThesis *out, const SbDiscThesisInput *in, double step,
                        SbWarnings *warnings, SbReport *report) {
  *out = (SbDiscThesis){.step = step};
  SbStatus status = SB_CHECK(
      report,
      {"seal.section_diameter", "the section diameter [m]", in->section_diameter, SB_ABOVE_ZERO},
      {"seal.section_diameter", "the fitted section [m]", in->section_fitted, SB_ABOVE_ZERO},
      {"gland.radial_space", "the radial space [m]", in->radial_space, SB_ABOVE_ZERO},
      {"seal.modulus", "the modulus [Pa]", in->modulus, SB_ABOVE_ZERO},
      {"seal.poisson_ratio", "Poisson's ratio", in->poisson_ratio, SB_POISSON},
      {"canister.pressure", "the pressure [Pa]", in->pressure, SB_NOT_NEGATIVE},
      {"", "the angle between nodes [rad]", step, nodes_limit / (MAX - 1), 0.1});
  if (status != SB_OK) {
    return status;
  }
  const double squeeze = 1.0 - in->radial_space / in->section_fitted;
  if (!(squeeze > 0.0)) {
    sb_warn(warnings, "no-contact", "seal.section_diameter",
            "the stretched ring does not touch the bore (squeeze %.3g %%): load 0",
            100.0 * squeeze);
    return sb_succeed(report);
  }
  if (squeeze > 0.1) {
    sb_warn(warnings, "disc-strain", "seal.section_diameter",
            "squeeze %.3g %% is beyond 10 %%: linear elasticity is an estimate", 100.0 * squeeze);
  }

  Work *w = malloc(sizeof *w);
  if (w == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the disc");
  }
  const double compliance = sb_disc_compliance(in->modulus, in->poisson_ratio);
  w->kernel = sb_disc_kernel(in->poisson_ratio);
  w->step = step;
  sb_legendre_gauss(w->gauss_x, w->gauss_w, GAUSS);
  w->space = in->radial_space / in->section_fitted;

  // Most contacts end within 45 degrees, which costs a third of the full table.
  size_t loaded = find_contact(w, 0.6 * nodes_limit, in->pressure * compliance, &out->iterations);
  if (loaded == 0) {
    loaded = find_contact(w, nodes_limit, in->pressure * compliance, &out->iterations);
  }
  if (loaded == 0) {
    free(w);
    return sb_fail_parameter(report, SB_ERROR_NOT_CONVERGED, "gland.radial_space",
                             "no contact within 75 degrees satisfies the thesis' disc");
  }

  out->touches = true;
  out->nodes = loaded;
  out->contact_width = in->section_diameter * sin(((double)loaded - 0.5) * step);
  for (size_t j = 0; j < loaded; j++) {
    out->pressure[j] = w->pressure[j] / compliance;
    out->pressure_peak = fmax(out->pressure_peak, out->pressure[j]);
    const double inner = j == 0 ? 0.0 : sin(((double)j - 0.5) * step);
    out->load_per_length +=
        out->pressure[j] * in->section_fitted * (sin(((double)j + 0.5) * step) - inner);
  }
  free(w);
  return sb_succeed(report);
}
