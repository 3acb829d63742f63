// Forces of the quasi-static cycle, edges of its chamber, and the evaluation of a segment; the
// equations are in cycle.h.
#include "engine/valve/run/cycle_private.h"

#include "engine/numeric/root.h"
#include "engine/valve/run/valve_type.h"
#include "engine/valve/states/breakaway.h"

#include <math.h>

// ---------------------------------------------------------------------------------------------------
// Resistance

bool sb_cycle_inner_touches(const SbCycle *cycle, SbChamber chamber, int direction) {
  if (chamber == SB_CHAMBER_OPEN) {
    chamber = direction == SB_CYCLE_OUT ? SB_CHAMBER_CLOSED : SB_CHAMBER_AT_REST;
  }
  return cycle->state[SB_INNER][chamber][direction].touches;
}

double sb_cycle_edge_begin(const SbCycle *cycle, SbChamber chamber, int direction) {
  const SbSealState *first = &cycle->state[SB_INNER][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
  const SbSealState *inner = &cycle->state[SB_INNER][chamber][direction];
  const bool both = first->touches && inner->touches;
  return cycle->model->land_edge +
         (both ? sb_valve_type(cycle->model)->edge_shift(first, inner) : 0);
}

double sb_cycle_edge_end(const SbCycle *cycle, SbChamber chamber, int direction) {
  const SbSealState *inner = &cycle->state[SB_INNER][chamber][direction];
  return sb_cycle_edge_begin(cycle, chamber, direction) + inner->contact_right -
         inner->contact_left;
}

// Share of a seal's contact that the edge has passed, or that a gasket's shoulder has not reached;
// without contact all of it.
static double passed(const SbCycle *cycle, int seal, SbChamber chamber, int direction, double s) {
  const SbSealState *state = &cycle->state[seal][chamber][direction];
  if (!state->touches || (seal == SB_INNER && chamber == SB_CHAMBER_OPEN)) {
    return 1;
  }
  if (seal == SB_OUTER) {
    return 0;
  }
  double width = state->contact_right - state->contact_left;
  double t = (s - sb_cycle_edge_begin(cycle, chamber, direction)) / width;
  t = sb_valve_type(cycle->model)->open_beyond ? t : 1 - t;
  return t > 1 - 1e-12 ? 1 : fmax(t, 0); // what rounding of s leaves at the end is no contact
}

SbLandShare sb_cycle_land_share(const SbCycle *cycle, int seal, SbChamber chamber, int direction,
                                double s) {
  double t = passed(cycle, seal, chamber, direction, s);
  double c = 1 - 2 * t; // of the elliptic pressure
  return (SbLandShare){1 - t, 1 - (acos(c) - c * sqrt(fmax(1 - c * c, 0))) / M_PI};
}

double sb_cycle_seal_friction(const SbCycle *cycle, int seal, SbChamber chamber, int direction,
                              double s) {
  const SbSealState *state = &cycle->state[seal][chamber][direction];
  const SbLandShare on = sb_cycle_land_share(cycle, seal, chamber, direction, s);
  return (state->boundary_area + state->friction_viscous) * on.width +
         state->boundary_load * on.load;
}

double sb_cycle_friction(const SbCycle *cycle, SbChamber chamber, int direction, double s) {
  return sb_cycle_seal_friction(cycle, SB_OUTER, chamber, direction, s) +
         sb_cycle_seal_friction(cycle, SB_INNER, chamber, direction, s);
}

double sb_cycle_static_friction(const SbCycle *cycle, int seal, SbChamber chamber, int direction,
                                double s) {
  const SbSealState *state = &cycle->state[seal][chamber][direction];
  double kinetic = sb_sliding_friction(state);
  double ratio = kinetic > 0 ? state->friction_static / kinetic : 1;
  return ratio * sb_cycle_seal_friction(cycle, seal, chamber, direction, s);
}

SbStatus sb_cycle_rest(SbCycle *cycle, double dwell, SbReport *report) {
  for (int i = 0; i < SB_SEAL_COUNT * SB_CYCLE_CHAMBERS; i++) {
    const int seal = i / SB_CYCLE_CHAMBERS, chamber = i % SB_CYCLE_CHAMBERS;
    SbStatus status = sb_breakaway_after(&cycle->hold[seal][chamber], cycle->model, seal,
                                         &cycle->state[seal][chamber][SB_CYCLE_OUT], dwell, report);
    if (status != SB_OK) {
      return status;
    }
  }
  return SB_OK;
}

double sb_cycle_reserve(const SbCycle *cycle, SbChamber chamber, double s) {
  double friction = 0;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const SbSealState *state = &cycle->state[seal][chamber][SB_CYCLE_OUT];
    const SbLandShare on = sb_cycle_land_share(cycle, seal, chamber, SB_CYCLE_OUT, s);
    const double dry = state->rest_area + state->rest_load;
    // The dry contact's parts have the shares of the contact's width and load.
    const double part =
        dry > 0 ? (state->rest_area * on.width + state->rest_load * on.load) / dry : 0;
    friction += fmax(part * cycle->hold[seal][chamber],
                     sb_cycle_seal_friction(cycle, seal, chamber, SB_CYCLE_OUT, s));
  }
  return sb_model_push(cycle->model, s) - friction;
}

double sb_cycle_sign(int direction) {
  return direction == SB_CYCLE_IN ? 1 : -1;
}

double sb_cycle_friction_at(double s, const void *context) {
  const SbCyclePlace *p = context;
  return sb_cycle_friction(p->cycle, p->chamber, p->direction, s);
}

double sb_cycle_balance_at(double s, const void *context) {
  const SbCyclePlace *p = context;
  return sb_model_push(p->cycle->model, s) +
         sb_cycle_sign(p->direction) * sb_cycle_friction_at(s, p);
}

// The inner seal's friction falls while the edge passes, by the same ellipse as its share of the
// load. That of a gasket rises as the shoulder does.
double sb_cycle_rate_at(double s, const void *context) {
  const SbCyclePlace *p = context;
  const SbSealState *inner = &p->cycle->state[SB_INNER][p->chamber][p->direction];
  double t = passed(p->cycle, SB_INNER, p->chamber, p->direction, s);
  const double spring = 1 + p->cycle->model->spring_stiffness / p->cycle->model->stiffness;
  if (t <= 0 || t >= 1) {
    return spring;
  }
  double c = 1 - 2 * t;
  const double falls = sb_valve_type(p->cycle->model)->open_beyond ? 1 : -1;
  double slope = -falls *
                 ((inner->boundary_area + inner->friction_viscous) +
                  inner->boundary_load * 4 / M_PI * sqrt(fmax(1 - c * c, 0))) /
                 (inner->contact_right - inner->contact_left);
  return spring + sb_cycle_sign(p->direction) * slope / p->cycle->model->stiffness;
}

double sb_cycle_force(const SbCycle *cycle, double X, double s) {
  return fmax(cycle->model->stiffness * (X - s), 0);
}

double sb_cycle_reserve_at(double s, const void *context) {
  const SbCyclePlace *p = context;
  return sb_cycle_reserve(p->cycle, p->chamber, s);
}

double sb_cycle_excess_at(double s, const void *context) {
  const SbCyclePlace *p = context;
  return sb_cycle_sign(p->direction) *
         (sb_cycle_force(p->cycle, p->platen, s) - sb_cycle_balance_at(s, p));
}

// ---------------------------------------------------------------------------------------------------
// Evaluation inside a segment

// Returns the distance beyond X that the platen would need for the balance of a stem at s;
// increases with s.
static double platen_beyond(double *slope, double s, const void *context) {
  const SbCyclePlace *p = context;
  *slope = sb_cycle_rate_at(s, p);
  return s + sb_cycle_balance_at(s, p) / p->cycle->model->stiffness - p->platen;
}

double sb_cycle_stem(const SbCycle *cycle, const SbCycleSegment *segment, double X) {
  if (segment->mode != SB_CYCLE_SLIP) {
    return segment->stem0;
  }
  // X(s) = s + G(s)/k increases with s inside a segment: jumps are cut out when it is planned.
  double low = fmin(segment->stem0, segment->stem1);
  double high = fmax(segment->stem0, segment->stem1);
  double span = segment->platen1 - segment->platen0;
  double share = span != 0 ? (X - segment->platen0) / span : 1;
  const SbCyclePlace place = {cycle, segment->chamber, segment->direction, X};
  return sb_newton_bracketed(platen_beyond, &place, low, high,
                             segment->stem0 + (segment->stem1 - segment->stem0) * share);
}

double sb_cycle_stem_rate(const SbCycle *cycle, const SbCycleSegment *segment, double s) {
  if (segment->mode != SB_CYCLE_SLIP) {
    return 0;
  }
  const SbCyclePlace place = {cycle, segment->chamber, segment->direction, 0};
  // Close to a jump the rate has no bound; a thousand times the platen's rate replaces it.
  return 1 / fmax(sb_cycle_rate_at(s, &place), 1e-3);
}

double sb_cycle_balance(const SbCycle *cycle, const SbCycleSegment *segment, double X, double s,
                        double *stop_force) {
  const SbModel *model = cycle->model;
  double force = sb_cycle_force(cycle, X, s);
  *stop_force = 0;
  if (segment->mode != SB_CYCLE_STICK) {
    return sb_cycle_sign(segment->direction) *
           sb_cycle_friction(cycle, segment->chamber, segment->direction, s);
  }

  // At a stop the friction keeps its value on arrival until the stop is unloaded.
  double needed = force - sb_model_push(model, s);
  bool stopped = (s >= model->stroke && needed > segment->friction0) ||
                 (s <= 0 && needed < segment->friction0);
  *stop_force = stopped ? needed - segment->friction0 : 0;
  return needed - *stop_force;
}
