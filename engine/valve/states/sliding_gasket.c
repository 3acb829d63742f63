// Film and rough contact under a gasket, whose edges are sharp.
//
// The film that a surface transports into a contact depends on the slope of the pressure at the
// inlet (Blok 1963, film/inverse.c). With the steepest slope p'_max it is
//
//   h = 2/3 sqrt(4 eta u_m / p'_max), u_m half the sliding speed.
//
// A ring's film thus depends on the radius of its section. A gasket's pressure rises within its
// edge's radius r, where the pressure of the finite elements has a root and no steepest slope. The
// mean slope over r replaces it, (p(r) - p(0))/r. The film is nanometres thick and does not lift
// the gasket. The pressure remains the dry one; at each position the gap is the larger of h and the
// gap of the dry rough contact, the asperities carry their pressure at that gap, and the fluid
// carries the remainder. Towards the outlet Reynolds' equation gives k y^3 - y + 1 = 0, y =
// h_min/h, k = p' h^2/(12 eta u_m) < 0.
//
// Valid while h is a small part of the roughness; above a tenth of it there is a warning. Not
// modelled: deformation of the edge by the film, adhesion.
#include "engine/contact/rough/rough_law.h"
#include "engine/valve/states/sliding_private.h"

#include <math.h>
#include <stdlib.h>

enum { POINTS = SB_SEAL_EDGE_POINTS, LAST = POINTS - 1 };

static double angle_of(int i) {
  return M_PI * i / LAST;
}

// Sets edge_pressure of a state from its fit.
static void set_edges(SbSealState *out, const SbFit *fit) {
  const double middle = (fit->contact_left + fit->contact_right) / 2, half = fit->contact_width / 2;
  size_t at = 0;
  for (int i = 0; i < POINTS; i++) {
    const double x = middle - half * cos(angle_of(i));
    while (at + 2 < fit->profile_count && fit->profile_x[at + 1] < x) {
      at++;
    }
    const double from = fit->profile_x[at], to = fit->profile_x[at + 1];
    const double t = to > from ? fmin(fmax((x - from) / (to - from), 0), 1) : 0;
    out->edge_pressure[i] = fit->profile_p[at] + t * (fit->profile_p[at + 1] - fit->profile_p[at]);
  }
}

// Pressure at a distance from the left end.
static double pressure_at(const SbSealState *state, double distance) {
  const double half = (state->contact_right - state->contact_left) / 2;
  const double place = acos(fmin(fmax(1 - distance / half, -1), 1)) / M_PI * LAST;
  const int at = (int)fmin(floor(place), LAST - 1);
  const double t = place - at;
  return (1 - t) * state->edge_pressure[at] + t * state->edge_pressure[at + 1];
}

// Rise of the pressure over the edge's radius, from either end inwards [Pa/m].
static double rise(const SbSealState *state, const SbModel *model, bool left) {
  const double radius = model->profile_corner_radius;
  const double width = state->contact_right - state->contact_left;
  const double inside = pressure_at(state, left ? radius : width - radius);
  return (inside - state->edge_pressure[left ? 0 : LAST]) / radius;
}

// Returns h_min/h behind an outlet with the slope k, k >= 0 its magnitude: y + k y^3 = 1.
static double outlet(double k) {
  double y = 1;
  for (int i = 0; i < 60; i++) {
    y -= (y + k * y * y * y - 1) / (1 + 3 * k * y * y);
  }
  return y;
}

// Returns the rough contact that carries a pressure, or the contact at the gap of the film if that
// gap is larger.
static SbRoughPoint point_at(const SbRoughLaw *law, double p, double film) {
  SbRoughPoint at;
  sb_rough_law_at(&at, law, sb_rough_law_of_pressure(law, p));
  if (film > at.gap) {
    sb_rough_law_at(&at, law, sb_rough_law_of_gap(law, film));
  }
  return at;
}

// The law of a surface, owned, NULL without memory; too large for a small stack.
static SbStatus make_law(SbRoughLaw **out, const SbRoughSurface *surface, SbReport *report) {
  *out = malloc(sizeof **out);
  return *out != NULL ? sb_rough_law_init(*out, surface, report)
                      : sb_fail(report, SB_ERROR_MEMORY, "no memory for a rough surface's law");
}

// Returns the law of a task's surface. It is the same at every speed and pressure, so the task's
// memory stores it. A task without a memory gets a law of its own in *own, NULL otherwise.
static SbStatus law_of(const SbRoughLaw **out, SbRoughLaw **own, const SbSlidingTask *task,
                       double roughness, SbReport *report) {
  const SbRoughSurface surface = sb_model_surface(task->model, task->seal, roughness);
  *own = NULL;
  if (task->memory == NULL) {
    SbStatus status = make_law(own, &surface, report);
    *out = *own;
    return status;
  }
  SbRoughLaw *law = &task->memory->law;
  *out = law;
  return law->count > 0 && sb_rough_same_surface(&law->surface, &surface)
             ? sb_succeed(report)
             : sb_rough_law_like(law, &surface, law, report);
}

SbStatus sb_sliding_edge_asperities(double *out, const double *p, size_t count,
                                    const SbModel *model, int seal, double film, SbReport *report) {
  const SbRoughSurface surface = sb_model_surface(model, seal, 1);
  SbRoughLaw *law;
  SbStatus status = make_law(&law, &surface, report);
  for (size_t i = 0; status == SB_OK && i < count; i++) {
    out[i] = p[i] > 0 ? fmin(point_at(law, p[i], film).pressure, p[i]) : 0;
  }
  free(law);
  return status;
}

// Results of the asperities over the contact, with a gap of at least `film`.
typedef struct {
  double area, load, shear; // real area, their load and the open part's shear, per length
} Rough;

static Rough rough_at(const SbSealState *state, const SbModel *model, const SbRoughLaw *law,
                      double film, double speed) {
  const double half = (state->contact_right - state->contact_left) / 2;
  Rough sum = {0};
  for (int i = 1; i < LAST; i++) { // at both ends sin t is 0
    const double p = state->edge_pressure[i], dx = half * sin(angle_of(i)) * M_PI / LAST;
    if (!(p > 0)) {
      continue;
    }
    const SbRoughPoint at = point_at(law, p, film);
    const double shear = model->viscosity * fabs(speed) / fmax(at.gap, 1e-30);
    sum.area += at.share * dx;
    sum.load += fmin(at.pressure, p) * dx;
    sum.shear += fmin(shear, model->shear_strength) * (1 - at.share) * dx;
  }
  return sum;
}

// Computes the film of a state whose edge_pressure is set, at the task's speed.
static void edge_film(SbSealState *out, const SbSlidingTask *task) {
  const SbModel *model = task->model;
  double film = 0, least = 0;
  if (sb_sliding_has_film(task)) {
    const double mean = fabs(task->speed) / 2, inlet = rise(out, model, task->speed > 0);
    film = inlet > 0 ? 2.0 / 3 * sqrt(4 * model->viscosity * mean / inlet) : 0;
    const double most = task->supply.limited ? 2 * task->supply.layer : INFINITY;
    film = fmin(film, most);
    const double falls = fmax(rise(out, model, task->speed < 0), 0);
    least = film * outlet(falls * film * film / (12 * model->viscosity * mean));
  }
  out->film_central = film;
  out->film_min = least;
  out->layer = film / 2;
  // The film is proportional to the power -1/2 of the slope at the edge, which depends on few nodes
  // there: as for a ring's film (sb_sliding_read_film()), three times the error of the peak.
  out->film_error = out->central_error =
      film > 0 ? 0.5 * 3 * (out->peak_error + 0.5 * out->width_error) : NAN;
}

// Relative error of a real area: its change with the contact pressure, and that of its open part.
// Near full contact the open part is at the edges, where the pressure is that of single nodes: it
// has three times the error of the peak, as the film at the edge (it changed by 18 % between
// tolerances of 2e-2 and 1e-4, gasket-hand.scene, 0.975 mm thick).
static double area_error(double area, double less, double width, double peak_error) {
  const double open = fmax(1 - area / width, 0);
  return area > 0 ? fabs(less / area - 1) + 3 * peak_error * open : 0;
}

// Sets the errors of both real areas and of the asperities' fraction of the load, from those of the
// contact pressure and, with a film, of the film.
static void set_rough_errors(SbSealState *out, const SbModel *model, const SbRoughLaw *law,
                             const Rough *on, const Rough *dry, double speed) {
  const double film = out->film_central, width = out->contact_right - out->contact_left;
  const double error = out->net_error + out->width_error + out->peak_error;
  SbSealState other = *out;
  for (int i = 0; i < POINTS; i++) {
    other.edge_pressure[i] /= 1 + error;
  }
  const Rough less = rough_at(&other, model, law, film, speed);
  const Rough dry_less = rough_at(&other, model, law, 0, 0);
  out->area_error = area_error(on->area, less.area, width, out->peak_error);
  out->rest_error = area_error(dry->area, dry_less.area, width, out->peak_error);
  out->share_error = out->net_error + out->width_error;
  if (film > 0 && on->load > 0) {
    const Rough thick = rough_at(out, model, law, film * (1 + out->central_error), speed);
    out->share_error += fabs(thick.load / on->load - 1);
  }
}

SbStatus sb_edge_contact(SbSealState *out, const SbSlidingTask *task, double roughness,
                         SbReport *report) {
  const SbModel *model = task->model;
  const double width = out->contact_right - out->contact_left;
  const double around = model->bore_circumference, speed = task->speed;
  const bool slides = sb_sliding_has_film(task);
  const SbRoughLaw *law;
  SbRoughLaw *own;
  SbStatus status = law_of(&law, &own, task, roughness, report);
  if (status != SB_OK) {
    free(own);
    return status;
  }
  const double film = out->film_central;
  out->lambda = slides ? film / (roughness * model->sigma) : NAN;
  const Rough on = rough_at(out, model, law, film, speed), dry = rough_at(out, model, law, 0, 0);
  set_rough_errors(out, model, law, &on, &dry, speed);
  free(own);
  out->real_area_share = fmin(on.area / width, 1);
  out->rest_area_share = fmin(dry.area / width, 1);
  // At every point asperities carry at most the contact pressure (rough_at()). Above 1 only by the
  // difference of two quadratures: that sum is over strips, load_net is the solved ring's.
  out->asperity_share = out->load_net > 0 ? fmin(on.load / out->load_net, 1) : NAN;
  out->boundary_area = model->shear_strength * out->real_area_share * width * around;
  out->rest_area = model->shear_strength * out->rest_area_share * width * around;
  out->rest_load = model->load_coefficient * out->load;
  const bool coupled = sb_contact_law(model)->shares;
  out->boundary_load = out->rest_load * (coupled && slides ? out->asperity_share : 1);
  out->friction_viscous = slides ? on.shear * around : 0;
  sb_sliding_kinetic_errors(out, coupled && slides ? out->net_error : 0);
  if (out->lambda > 0.1) {
    sb_warn(task->warnings, "film-edge", sb_input(SB_P_DRIVE_SPEED),
            "%.3g nm of film under the %s gasket, a tenth of the roughness and more: it would "
            "round the edge that it is computed for",
            1e9 * film, sb_seal_name(task->seal));
  }
  return SB_OK;
}

SbStatus sb_edge_resurface(SbSealState *state, const SbSlidingTask *task, double roughness,
                           SbReport *report) {
  SbStatus status = sb_edge_contact(state, task, roughness, report);
  status = status == SB_OK ? sb_sliding_set_static(state, task, report) : status;
  sb_sliding_set_static_error(state);
  return status;
}

SbStatus sb_edge_update_errors(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  edge_film(out, task);
  return sb_edge_resurface(out, task, 1, report);
}

SbStatus sb_edge_solve(SbSealState *out, const SbSlidingTask *task, SbReport *report) {
  set_edges(out, &task->memory->now->fit);
  task->memory->last = &task->memory->plane; // which has none
  return sb_edge_update_errors(out, task, report);
}

SbStatus sb_edge_respeed(SbSealState *state, const SbSlidingTask *task, const SbSlidingBody *body,
                         SbReport *report) {
  (void)body; // its film is that of its edge
  task->memory->last = &task->memory->plane;
  edge_film(state, task);
  return sb_sliding_refilm(state, task, 1, report);
}

void sb_edge_warn_limit(SbWarnings *warnings, const SbSlidingTask *task, const SbSealState *state) {
  sb_warn_serious(
      warnings, "gasket-detaches", sb_input(SB_P_FRICTION_SHEAR_STRENGTH),
      "the friction of the %s gasket %s exceeds half of its pressure, where the surface of the "
      "rubber folds and no steady contact was found: the gasket carries %.0f %% of that friction",
      sb_seal_name(task->seal), sb_sliding_stroke(task), 100 * state->borne_share);
}

// The edge is a quarter of a circle.
double sb_edge_dry_gap(const SbModel *model, int seal, double over, double half) {
  (void)seal;
  return pow((over - 1) * half, 2) / (2 * model->profile_corner_radius);
}
