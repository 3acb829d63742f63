// Asperities and adhesion of a case, and the start of its rough rows: Hertz's pressure under the
// dry gap, opened by the film of the layers (ehl_layers.c) and by the asperities.
#include "engine/film/ehl.h"

#include "engine/numeric/root.h"

#include <cblas.h>
#include <math.h>
#include <string.h>

void sb_ehl_rough_point(SbEhlRoughPoint *out, const SbEhlCase *c, double t) {
  const SbEhlRough *rough = &c->rough;
  SbRoughPoint p = {.flow = 1};
  if (rough->law != NULL) {
    sb_rough_law_at(&p, rough->law, t);
  } else { // smooth: linear above t = 1, falling exponentially to nothing below
    double unit = rough->smooth_gap * rough->film;
    p.gap = t >= 1 ? unit * t : unit * exp(t - 1);
    p.gap_slope = t >= 1 ? unit : p.gap;
  }
  // The equation of a closed contact needs a remainder; it holds the gap where the wall's flow is
  // the contact's.
  static const double CLOSED = 1e-12;
  double pull_slope;
  double pull = sb_rough_pull(&pull_slope, &p, rough->hamaker);
  const double flow_h = p.flow_slope / p.gap_slope * rough->film;
  const double h = p.gap / rough->film, by = rough->split;
  *out = (SbEhlRoughPoint){.h = h,
                           .h_t = p.gap_slope / rough->film,
                           .asperity = p.pressure / rough->pressure,
                           .solid = (p.pressure - pull) / rough->pressure,
                           .solid_t = (p.pressure_slope - pull_slope) / rough->pressure,
                           .share = p.share,
                           .share_t = p.share_slope,
                           .flow = fmax(p.flow, CLOSED),
                           .flow_h = flow_h,
                           .drag = h * (1 + by * (1 - p.flow)),
                           .drag_h = 1 + by * (1 - p.flow - h * flow_h)};
}

typedef struct {
  const SbEhlCase *c;
  double flux;
} Steepest;

// (drag - flux) n - h d drag/dh with n = d ln(h^3 phi_p)/d ln h: positive above the gap with the
// largest slope, (drag - flux)/(h^3 phi_p).
static double beyond_steepest(double gap, const void *context) {
  const Steepest *of = context;
  SbEhlRoughPoint at;
  sb_ehl_rough_point(&at, of->c, sb_ehl_rough_of_gap(of->c, gap));
  return (at.drag - of->flux) * (3 + gap * at.flow_h / at.flow) - gap * at.drag_h;
}

double sb_ehl_rough_steepest(const SbEhlCase *c, double flux) {
  const bool obstructed = c->rough.law != NULL && c->rough.law->surface.threshold > 0;
  // Thick films have the same drag with every split.
  const double thick =
      obstructed ? 1.5 * flux + 20 * c->rough.law->surface.sigma / c->rough.film : 0;
  return obstructed ? sb_bisect(beyond_steepest, &(Steepest){c, flux}, thick, 0.5 * flux)
                    : 1.5 * flux;
}

double sb_ehl_asperity_share(double asperity, double solid, double load) {
  return asperity > 0 ? asperity / (asperity + fmax(load - solid, 0)) : 0;
}

double sb_ehl_rough_of_gap(const SbEhlCase *c, double gap) {
  if (c->rough.law != NULL) {
    return sb_rough_law_of_gap(c->rough.law, gap * c->rough.film);
  }
  double t = gap / c->rough.smooth_gap;
  return t >= 1 ? t : 1 + log(t);
}

typedef struct {
  const SbEhlTable *rule;
  const double *slope; // at the element's nodes
} Slopes;

static double fall_at(double r, const void *context) {
  const Slopes *of = context;
  return -sb_ehl_interpolate(of->rule, of->slope, r);
}

double sb_ehl_rough_weights(double *weight, const SbEhlSolution *s, const SbEhlElement *e, int j) {
  const SbEhlTable *t = e->table;
  const double *slope = &s->state.s[e->first_dof];
  double end = t->node[j + 1];
  memcpy(weight, t->step[j], sizeof t->step[j]);
  if (s->state.cavity[e->first_dof + j + 1]) {
    end = !(slope[j] < 0)       ? t->node[j]
          : !(slope[j + 1] > 0) ? end
                                : sb_bisect(fall_at, &(Slopes){t, slope}, t->node[j], end);
    sb_ehl_partial(weight, t, j, end);
  }
  return end;
}

// What the asperities carry at a gap, less what their tips pull, at most Hertz's pressure, both
// scaled.
static double carried(const SbEhlCase *c, double gap) {
  SbRoughPoint at;
  sb_rough_law_at(&at, c->rough.law, sb_rough_law_of_gap(c->rough.law, gap * c->rough.film));
  return fmin(fmax(at.pressure - at.pull, 0) / c->rough.pressure, 1);
}

// Gap at which they carry a pressure.
static double gap_under(const SbEhlCase *c, double pressure) {
  SbRoughPoint at;
  sb_rough_law_at(&at, c->rough.law,
                  sb_rough_law_of_load(c->rough.law, pressure * c->rough.pressure));
  return at.gap / c->rough.film;
}

bool sb_ehl_rough_closed(const SbEhlCase *c) {
  static const double CLOSED = 3e-12; // m, a hundredth of a molecule
  const double fluid = 0.5 * (c->layers.inlet + c->layers.outlet);
  return c->rough.law != NULL && fluid < 1 && gap_under(c, 1 - fluid) * c->rough.film < CLOSED;
}

static double lacking_slope(double ln_gap, const void *context) {
  const SbEhlCase *c = context;
  double h = exp(ln_gap);
  double p = carried(c, h), steepest = sb_ehl_rough_steepest(c, h);
  SbEhlRoughPoint at;
  sb_ehl_rough_point(&at, c, sb_ehl_rough_of_gap(c, steepest));
  const double slope = (at.drag - h) / (steepest * steepest * steepest * at.flow);
  return slope * c->layers.lambda * p - sb_ehl_layers_inlet_slope(&c->layers) * sqrt(1 - p * p);
}

// Flux film of a rough contact: inside, the fluid carries what Hertz's pressure has above p_a(h);
// at the inlet, where the two meet, its slope is the largest that Reynolds allows, (4/27) lambda /
// h^2 (as in Blok's inverse film). Blended with the smooth film.
void sb_ehl_rough_flux(SbEhlCase *c) {
  double smooth = c->layers.lambda > 0 ? sb_ehl_layers_flux(&c->layers) : 0;
  c->rough.flux = smooth;
  c->rough.inlet = 1;
  if (c->rough.law == NULL || !(c->layers.lambda > 0)) {
    return;
  }
  double low = fmin(log(gap_under(c, 0.999999)), log(smooth) - 40);
  c->rough.flux = hypot(exp(sb_bisect(lacking_slope, c, low, log(smooth) + 40)), smooth);
  double p = carried(c, c->rough.flux);
  c->rough.inlet = sqrt(1 - p * p);
}

void sb_ehl_rough_guess(SbEhlSolution *solution) {
  const SbEhlMesh *mesh = &solution->mesh;
  const SbEhlCase *c = &solution->c;
  SbEhlState *state = &solution->state;
  double film = c->rough.flux;
  double width = sb_ehl_layers_width(&c->layers);
  double floor = 0.02;
  // A film hardly thickened by asperities has the smooth one's layers.
  bool layered = c->layers.lambda > 0 && width < 0.8 && film < 1.2 * sb_ehl_layers_flux(&c->layers);
  for (int i = 0; i < mesh->dofs; i++) {
    double X = mesh->x[i];
    double q = sb_ehl_layers_dry_pressure(&c->layers, X);
    double dry = sb_ehl_layers_dry_gap(&c->layers, X);
    double ambient = c->layers.lambda > 0 ? (X < 0 ? c->layers.inlet : c->layers.outlet)
                                          : sb_film_ends(X, c->layers.inlet, c->layers.outlet);
    double fluid = film > 0 ? film * (1 + 1.2 * exp(-fabs(X + 1) / width)) : 0;
    if (layered) {
      double h;
      sb_ehl_layers_shape(&q, &h, &c->layers, film, X);
      fluid = fmax(h - dry, 0.5 * film);
    }
    double rough = c->rough.law != NULL ? gap_under(c, fmax(q - ambient, floor)) : 0;
    double lift = pow(pow(fluid, 6) + pow(rough, 6), 1 / 6.0);
    state->nodal[i] = q;
    state->given[i] = sb_film_ends(X, c->layers.inlet, c->layers.outlet);
    state->t[i] = fmax(sb_ehl_rough_of_gap(c, lift + dry), -3);
  }
  // Flow: by the film, and by the end pressures through the gap (Poiseuille).
  double resistance = 0;
  for (int i = 1; i < mesh->dofs; i++) {
    SbEhlRoughPoint at;
    sb_ehl_rough_point(&at, c, 0.5 * (state->t[i] + state->t[i - 1]));
    resistance += (mesh->x[i] - mesh->x[i - 1]) / (at.h * at.h * at.h * at.flow);
  }
  state->flow = c->rough.sealed
                    ? 0
                    : c->layers.lambda * film + (c->layers.inlet - c->layers.outlet) / resistance;
  // Film pressure that the guess leaves, for the slopes; H0 follows from the first step.
  double p[SB_EHL_DOFS_MAX];
  for (int i = 0; i < mesh->dofs; i++) {
    SbEhlRoughPoint at;
    sb_ehl_rough_point(&at, c, state->t[i]);
    p[i] = state->nodal[i] - at.solid;
    state->cavity[i] = c->rough.sealed ||
                       (c->layers.outlet <= 0 && c->layers.lambda > 0 &&
                        mesh->x[i] > c->rough.inlet && c->layers.lambda * at.drag > state->flow);
  }
  for (int i = 0; i < mesh->dofs; i++) {
    const SbEhlElement *e = &mesh->element[mesh->owner[i > 0 ? i - 1 : 0]];
    const double *slope = e->table->node_slope[i - e->first_dof];
    state->s[i] =
        c->rough.sealed ? 0 : cblas_ddot(e->degree + 1, slope, 1, &p[e->first_dof], 1) / e->h;
  }
  state->H0 = 0;
  state->shift = c->layers.middle;
}

SbStatus sb_ehl_rough_law(const SbRoughLaw **law, SbFilmSolver *solver,
                          const SbFilmProblem *problem, SbReport *report) {
  const SbRoughSurface surface = {.model = problem->surface,
                                  .product = problem->gt_product,
                                  .sigma = problem->sigma,
                                  .sigma_over_beta = problem->sigma_over_beta,
                                  .modulus = problem->modulus,
                                  .work = problem->work_of_adhesion,
                                  .threshold = problem->percolation_threshold};
  *law = &solver->law;
  if (solver->law_ready && sb_rough_same_surface(&solver->law.surface, &surface)) {
    return SB_OK;
  }
  SbStatus status = sb_rough_law_like(&solver->law, &surface, problem->law, report);
  solver->law_ready = status == SB_OK;
  return status;
}

SbStatus sb_ehl_rough_case(SbEhlCase *c, SbFilmSolver *solver, const SbFilmScale *scale,
                           SbReport *report) {
  const SbFilmProblem *problem = solver->problem;
  c->rough = (SbEhlRough){
      .rows = true,
      .film = scale->film,
      .pressure = scale->pressure,
      .split = problem->roughness_split,
      .hamaker = problem->hamaker,
      .smooth_gap = 0.01 * sb_ehl_layers_flux(&c->layers),
      .sealed = !(scale->lambda > 0) && c->layers.inlet == c->layers.outlet, // no flow at all
      .front = {{INFINITY, 0.0}, {INFINITY, 0.0}, {INFINITY, 0.0}, {INFINITY, 0.0}},
  };
  if (problem->surface != SB_ROUGH_NONE) {
    SbStatus made = sb_ehl_rough_law(&c->rough.law, solver, problem, report);
    if (made != SB_OK) {
      return made;
    }
  }
  sb_ehl_rough_flux(c);
  return SB_OK;
}
