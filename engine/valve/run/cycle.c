// Plans the segments of the quasi-static cycle, and its energies; the equations are in cycle.h.
#include "engine/valve/run/cycle_private.h"

#include "engine/numeric/legendre.h"
#include "engine/numeric/root.h"
#include "engine/valve/run/valve_type.h"
#include "engine/valve/states/breakaway.h"

#include <float.h>
#include <math.h>

// ---------------------------------------------------------------------------------------------------
// Planning

// Static limit of both seals [N].
static double static_limit(const SbCycle *cycle, SbChamber chamber, int direction, double s) {
  return sb_cycle_static_friction(cycle, SB_OUTER, chamber, direction, s) +
         sb_cycle_static_friction(cycle, SB_INNER, chamber, direction, s);
}

// State of the planner.
typedef struct {
  SbCycle *cycle;
  double X, s;
  int platen;
  SbChamber chamber;
  SbStage stage;
  int direction;
  double friction; // last friction on the stem, signed
  bool full;
} Planner;

// Returns the nearest of four positions in front of the stem (NaN: none), or the stop.
static double nearest_ahead(const Planner *p, const double marks[4]) {
  const double sign = sb_cycle_sign(p->direction);
  double best = p->direction == SB_CYCLE_IN ? p->cycle->model->stroke : 0;
  for (int i = 0; i < 4; i++) {
    bool nearer = sign * marks[i] > sign * p->s && sign * marks[i] < sign * best;
    best = nearer ? marks[i] : best;
  }
  return best;
}

// Returns the end of the smooth piece from s in `direction`: the nearest of the edge's start,
// middle and end, the port, or the stop.
static double piece_end(const Planner *p) {
  const SbValveType *type = sb_valve_type(p->cycle->model);
  const SbChamber chamber =
      p->chamber == SB_CHAMBER_OPEN ? type->closes_as(p->direction) : p->chamber;
  double start = sb_cycle_edge_begin(p->cycle, chamber, p->direction);
  double end = sb_cycle_edge_end(p->cycle, chamber, p->direction);
  const double port = p->direction == SB_CYCLE_IN ? type->port(p->cycle->model) : p->s;
  return nearest_ahead(p, (const double[]){start, (start + end) / 2, end, port});
}

// The stage that a stem which moves to s reaches there, or -1, and the chamber from there on.
static int reach(SbChamber *chamber, const Planner *p, double s) {
  const SbCycle *cycle = p->cycle;
  const bool in = p->direction == SB_CYCLE_IN;
  int event = in && s == cycle->model->stroke && p->stage < SB_STAGE_D ? SB_STAGE_D : -1;
  *chamber = p->chamber;
  const SbPassage from = {p->chamber, p->stage, p->direction};
  return sb_cycle_inner_touches(cycle, p->chamber, p->direction)
             ? sb_valve_type(cycle->model)->reach(chamber, cycle, &from, s, event)
             : event;
}

// Computes the platen position at which a sticking stem slips in `direction`, after a dwell of
// `dwell` so far: the present position, or one in front of it. A contact that ages does so during
// this motion. Each pass uses the friction of the previous one, which is less than its own, so the
// passes are monotonic and find the first such position. The friction is increased by the ratio of
// the static friction to the kinetic one of the last sliding.
static SbStatus slip_platen(double *out, const Planner *p, int direction, double dwell,
                            SbReport *report) {
  const SbModel *model = p->cycle->model;
  SbDwellLaw law[SB_SEAL_COUNT];
  enum { PASSES = 100000 }; // near the first place that is none, each is little further
  double kinetic[SB_SEAL_COUNT], sliding[SB_SEAL_COUNT], X = p->X, squeeze_time;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const SbSealState *state = &p->cycle->state[seal][p->chamber][p->direction];
    SbStatus status = sb_breakaway_law(&law[seal], &squeeze_time, model, seal, state, NULL, report);
    if (status != SB_OK) {
      return status;
    }
    kinetic[seal] = sb_sliding_friction(state);
    sliding[seal] = sb_cycle_seal_friction(p->cycle, seal, p->chamber, direction, p->s);
  }
  for (int pass = 0; pass < PASSES; pass++) {
    double friction = 0, rested = dwell + fabs(X - p->X) / model->speed;
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      double grown = kinetic[seal] > 0 ? sb_dwell_at(&law[seal], rested) / kinetic[seal] : 1;
      friction += fmax(1, grown) * sliding[seal];
    }
    const double before = X;
    X = p->s +
        (sb_model_push(model, p->s) + sb_cycle_sign(direction) * friction) / model->stiffness;
    X = direction == SB_CYCLE_IN ? fmax(X, p->X) : fmin(X, p->X);
    if (fabs(X - before) <= 1e-9 * fabs(X - p->s) || X <= 0) {
      *out = X;
      return SB_OK;
    }
  }
  return sb_fail_input(report, SB_ERROR_NOT_CONVERGED, sb_input(SB_P_DRIVE_SPEED),
                       "the contact ages as fast as the machine loads it: it never slips");
}

// Adds a segment; `event` ends one at which the stem does not move, else where it comes to decides.
static void emit(Planner *p, SbCycleMode mode, double X1, double s1, int event) {
  SbCycle *cycle = p->cycle;
  if (cycle->count == SB_CYCLE_SEGMENTS_MAX) {
    p->full = true;
    return;
  }
  SbChamber chamber = p->chamber;
  event = mode != SB_CYCLE_STICK ? reach(&chamber, p, s1) : event;
  SbCycleSegment *segment = &cycle->segment[cycle->count++];
  *segment = (SbCycleSegment){
      .mode = mode,
      .direction = p->direction,
      .platen = p->platen,
      .chamber = p->chamber,
      .stage = p->stage,
      .platen0 = p->X,
      .platen1 = X1,
      .stem0 = p->s,
      .stem1 = s1,
      .friction0 = p->friction,
      .event = event,
  };
  double stop_force;
  p->friction = sb_cycle_balance(cycle, segment, X1, s1, &stop_force);
  p->X = X1;
  p->s = s1;
  p->chamber = chamber;
  p->stage = event >= 0 ? (SbStage)event : p->stage;
}

// Jumps to the first balance ahead, or through the whole piece that ends at `end`.
static void jump(Planner *p, const SbCyclePlace *place, double end) {
  double target =
      sb_cycle_excess_at(end, place) > 0 ? end : sb_bisect(sb_cycle_excess_at, place, p->s, end);
  emit(p, SB_CYCLE_JUMP, p->X, target, -1);
}

// Push less the friction that can hold the stem at s on its return: static friction where the stem
// may stop (drive.may_stop), else that of sliding.
static double hold_at(double s, const void *place) {
  const SbCycle *cycle = ((const SbCyclePlace *)place)->cycle;
  const bool moves = cycle->model->stops_at_stop && s < cycle->stem_top;
  return (moves ? sb_cycle_balance_at : sb_cycle_reserve_at)(s, place);
}

// Returns whether friction holds the stem at its position on the return. The first such position is
// known to rounding only.
static bool is_held(const Planner *p) {
  const SbCyclePlace place = {p->cycle, p->chamber, SB_CYCLE_OUT, 0};
  return hold_at(p->s, &place) <= 1e-9 * fabs(sb_model_push(p->cycle->model, p->s));
}

// Slides from the present point in the present direction until the stem sticks, stops, or (on the
// return) the platen leaves it; on the in-stroke a stem that leaves the platen jumps. Forces
// balance at entry unless a jump is due.
static void slide(Planner *p) {
  const SbModel *model = p->cycle->model;
  double k = model->stiffness;
  bool out = p->direction == SB_CYCLE_OUT;
  while (!p->full && p->s != (out ? 0 : model->stroke)) {
    const SbCyclePlace place = {p->cycle, p->chamber, p->direction, p->X};
    double balance = sb_cycle_balance_at(p->s, &place);
    double excess = sb_cycle_sign(p->direction) * (sb_cycle_force(p->cycle, p->X, p->s) - balance);
    double noise = 1e-12 * (fabs(balance) + fabs(sb_model_push(model, p->s))) +
                   8 * 2.3e-16 * k * (p->X + p->s);
    double end = piece_end(p);

    if (excess < -noise || (out && is_held(p))) {
      return; // resistance has risen above the force: the stem sticks
    }
    if (out && hold_at(end, &place) < 0) {
      // Friction exceeds the push inside this piece: the stem comes to rest there.
      end = sb_bisect(hold_at, &place, p->s, end);
      if (end == p->s) {
        return;
      }
    }
    if (excess > noise) {
      jump(p, &place, end);
      continue;
    }

    // Balanced sliding, up to where dX/ds changes sign (the middle of the edge is a piece end, so
    // the slope is monotonic and there is at most one such point).
    double turn = end;
    bool unstable_end = sb_cycle_rate_at(end - (end - p->s) * 1e-9, &place) <= 0;
    if (sb_cycle_rate_at(p->s, &place) > 0 && unstable_end) {
      turn = sb_bisect(sb_cycle_rate_at, &place, p->s, end);
    } else if (unstable_end) {
      turn = p->s;
    }
    if (!out && sb_cycle_balance_at(turn, &place) < 0) {
      // The platen cannot pull (sb_cycle_force()): the stem leaves it where the canister's pull, at
      // a pressure below ambient, equals the friction.
      turn = balance > 0 ? sb_bisect(sb_cycle_balance_at, &place, p->s, turn) : p->s;
    }
    if (turn == p->s) {
      // At the very edge of stability, or of leaving: step over it by the smallest jump.
      p->s = nextafter(p->s, end);
      jump(p, &place, end);
      continue;
    }
    emit(p, SB_CYCLE_SLIP, turn + sb_cycle_balance_at(turn, &place) / k, turn, -1);
  }
}

// Places of the return path at which a margin can have its minimum: friction changes
// monotonically between the ends of the path and of the land's edge under the contact, for a
// return spring and friction together it is sampled.
enum { EDGE_PLACES = 64 };

// Returns whether the edge leaves the chamber open at s, for a stem that moves in `direction` with
// one state of the closed chamber.
static bool is_open(const SbCycle *cycle, SbChamber closed, int direction, double s) {
  const bool beyond = sb_valve_type(cycle->model)->open_beyond;
  const double edge = beyond ? sb_cycle_edge_end(cycle, closed, direction)
                             : sb_cycle_edge_begin(cycle, closed, direction);
  return !sb_cycle_inner_touches(cycle, closed, direction) || (s >= edge) == beyond;
}

// The chamber at s on the return, with one state of the closed chamber.
static SbChamber chamber_at(const SbCycle *cycle, SbChamber closed, double s) {
  return is_open(cycle, closed, SB_CYCLE_OUT, s) ? SB_CHAMBER_OPEN : closed;
}

// Minimum of `margin` over the return path from `top`, with one state of the closed chamber.
static double least_over(const SbCycle *cycle, SbFunction margin, SbChamber closed, double top) {
  const bool touches = sb_cycle_inner_touches(cycle, closed, SB_CYCLE_OUT);
  const double begin = touches ? sb_cycle_edge_begin(cycle, closed, SB_CYCLE_OUT) : 0;
  const double end = touches ? sb_cycle_edge_end(cycle, closed, SB_CYCLE_OUT) : 0;
  const double ends[] = {0, top, fmin(top, end)};
  double least = INFINITY;
  for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
    const double s = fmax(ends[i], 0);
    least = fmin(least,
                 margin(s, &(SbCyclePlace){cycle, chamber_at(cycle, closed, s), SB_CYCLE_OUT, 0}));
  }
  for (int i = 0; touches && i <= EDGE_PLACES; i++) {
    const double s = fmin(top, begin + (end - begin) * i / EDGE_PLACES);
    least =
        s >= 0 ? fmin(least, margin(s, &(SbCyclePlace){cycle, closed, SB_CYCLE_OUT, 0})) : least;
  }
  return least;
}

// The state of the closed chamber after a stroke to `top`: a port has not emptied it below its
// position.
static SbChamber closed_after(const SbCycle *cycle, double top) {
  const double port = sb_valve_type(cycle->model)->port(cycle->model);
  return top < port ? SB_CHAMBER_AT_REST : SB_CHAMBER_CLOSED;
}

static double least_of(const SbCycle *cycle, SbFunction margin, double top) {
  const double least = least_over(cycle, margin, closed_after(cycle, top), top);
  // Ports leave a chamber that fills in the stroke between its filled and its vented state.
  return cycle->model->pressure_map == SB_MAP_PORTS && !sb_valve_type(cycle->model)->fills_at_rest
             ? fmin(least, least_over(cycle, margin, SB_CHAMBER_AT_REST, top))
             : least;
}

double sb_cycle_first_reserve(const SbCycle *cycle, double top) {
  return sb_cycle_reserve(cycle, chamber_at(cycle, closed_after(cycle, top), top), top);
}

double sb_cycle_sliding_margin(const SbCycle *cycle, double top) {
  return least_of(cycle, sb_cycle_balance_at, top);
}

double sb_cycle_static_margin(const SbCycle *cycle, double top) {
  return least_of(cycle, sb_cycle_reserve_at, top);
}

// Follows the in-stroke: the stem sticks until the static limit, slides, and again, until the stop;
// there the platen reverses. Writes the time [s] for which the stem rests at the stop under a
// rising force, and the platen's position at which it stopped [m].
static SbStatus press(Planner *p, double *dwell, double *stopped, SbReport *report) {
  SbCycle *cycle = p->cycle;
  const SbModel *model = cycle->model;
  const double k = model->stiffness;
  while (!p->full) {
    double friction = p->stage == SB_STAGE_A
                          ? static_limit(cycle, p->chamber, SB_CYCLE_IN, p->s)
                          : sb_cycle_friction(cycle, p->chamber, SB_CYCLE_IN, p->s);
    // Below ambient the canister's pressure may draw the stem in by itself.
    double X_slip = fmax(p->s + (sb_model_push(model, p->s) + friction) / k, p->X);
    const bool first = p->stage == SB_STAGE_A;
    if (model->contact_ageing || (first && model->dwell_gain > 0)) {
      double rested = first ? model->rest : 0;
      SbStatus status = slip_platen(&X_slip, p, SB_CYCLE_IN, rested, report);
      if (status != SB_OK) {
        return status;
      }
    }
    if (p->s >= model->stroke) {
      *dwell = fmax(p->s + model->reversal_force / k - p->X, 0) / model->speed;
      *stopped = p->X;
      emit(p, SB_CYCLE_STICK, fmax(p->s + model->reversal_force / k, p->X), p->s, -1);
      break;
    }
    emit(p, SB_CYCLE_STICK, X_slip, p->s, p->stage == SB_STAGE_A ? SB_STAGE_B : -1);
    slide(p);
  }
  return SB_OK;
}

// Follows the return after a rest of `dwell` [s] at the stop: the stem follows the platen while the
// push exceeds the friction that can hold it.
static SbStatus release(Planner *p, double dwell, SbReport *report) {
  SbCycle *cycle = p->cycle;
  const SbModel *model = cycle->model;
  const double k = model->stiffness;
  while (!p->full && p->X > 0) {
    const double limit =
        sb_cycle_balance_at(p->s, &(SbCyclePlace){cycle, p->chamber, SB_CYCLE_OUT, 0});
    double X_slip = p->s + limit / k;
    if (model->contact_ageing) {
      SbStatus status = slip_platen(&X_slip, p, SB_CYCLE_OUT, dwell, report);
      if (status != SB_OK) {
        return status;
      }
      dwell = 0;
    }
    if (p->s <= 0 || is_held(p) || X_slip <= 0) {
      emit(p, SB_CYCLE_STICK, 0, p->s, -1);
      break;
    }
    emit(p, SB_CYCLE_STICK, fmin(X_slip, p->X), p->s,
         p->stage < SB_STAGE_E && p->stage >= SB_STAGE_B ? SB_STAGE_E : -1);
    p->direction = SB_CYCLE_OUT;
    slide(p);
  }
  return SB_OK;
}

SbStatus sb_cycle_build(SbCycle *cycle, SbReport *report) {
  const SbModel *model = cycle->model;
  cycle->count = 0;
  double k = model->stiffness, dwell = 0, stopped = 0;
  Planner p = {.cycle = cycle, .platen = 1, .direction = SB_CYCLE_IN, .stage = SB_STAGE_A};
  // A chamber whose inner seal has no contact is always open.
  p.chamber =
      is_open(cycle, SB_CHAMBER_AT_REST, SB_CYCLE_IN, 0) ? SB_CHAMBER_OPEN : SB_CHAMBER_AT_REST;
  SbStatus status = press(&p, &dwell, &stopped, report);
  if (status != SB_OK) {
    return status;
  }
  cycle->platen_top = p.X;
  cycle->stem_top = p.s;

  // Return: the platen moves back to X = 0; the stem follows while the push exceeds static
  // friction. The dwell at the stop ends when the push alone carries the platen's force.
  p.platen = -1;
  const double pushed =
      sb_cycle_balance_at(p.s, &(SbCyclePlace){cycle, p.chamber, SB_CYCLE_OUT, 0});
  cycle->dwell = (p.X - stopped + fmax(p.X - p.s - fmax(pushed, 0) / k, 0)) / model->speed;
  status = sb_cycle_rest(cycle, cycle->dwell, report);
  if (status != SB_OK) {
    return status;
  }
  status = release(&p, dwell, report);
  if (status != SB_OK) {
    return status;
  }
  cycle->stem_end = p.s;
  if (p.full) {
    return sb_fail_input(report, SB_ERROR_NOT_CONVERGED, sb_input(SB_P_DRIVE_STIFFNESS),
                         "the cycle does not end within %d events", SB_CYCLE_SEGMENTS_MAX);
  }
  return sb_succeed(report);
}

// ---------------------------------------------------------------------------------------------------
// Energy

enum { POINTS = 16 };

// Gauss' rule over a segment.
typedef struct {
  const SbCycle *cycle;
  const SbCycleSegment *segment;
  double node[POINTS], weight[POINTS];
} Rule;

static double integral(const Rule *rule, double a, double b, SbFunction f, const void *context) {
  double sum = 0;
  for (int i = 0; i < POINTS; i++) {
    sum += rule->weight[i] * f((a + b) / 2 + (b - a) / 2 * rule->node[i], context);
  }
  return sum * (b - a) / 2;
}

// The platen's work and the loop are integrated over X, friction over s: separate evaluations of
// separate functions, so that the closure tests the motion and not an identity.
static double force_of_platen(double X, const void *context) {
  const Rule *rule = context;
  return sb_cycle_force(rule->cycle, X, sb_cycle_stem(rule->cycle, rule->segment, X));
}

void sb_cycle_energy(const SbCycle *cycle, SbEnergy *out) {
  const SbModel *model = cycle->model;
  double k = model->stiffness;
  Rule rule = {.cycle = cycle};
  sb_legendre_gauss(rule.node, rule.weight, POINTS);
  *out = (SbEnergy){0};
  for (size_t i = 0; i < cycle->count; i++) {
    const SbCycleSegment *segment = rule.segment = &cycle->segment[i];
    const SbCyclePlace place = {cycle, segment->chamber, segment->direction, segment->platen0};
    double ds = segment->stem1 - segment->stem0;
    double X0 = segment->platen0;
    double X1 = segment->platen1;

    // Where the platen leaves a stem at rest the force has a kink: X = s.
    double corner = segment->mode == SB_CYCLE_STICK
                        ? fmin(fmax(segment->stem0, fmin(X0, X1)), fmax(X0, X1))
                        : X1;
    double rubbed =
        fabs(integral(&rule, segment->stem0, segment->stem1, sb_cycle_friction_at, &place));
    // A stem that jumps ahead of the platen leaves it at s = X, where the force has a corner too.
    const double leaves =
        fmin(fmax(X0, fmin(segment->stem0, segment->stem1)), fmax(segment->stem0, segment->stem1));
    if (segment->mode == SB_CYCLE_JUMP) {
      out->seal += sb_cycle_sign(place.direction) *
                   (integral(&rule, segment->stem0, leaves, sb_cycle_excess_at, &place) +
                    integral(&rule, leaves, segment->stem1, sb_cycle_excess_at, &place));
    } else {
      out->external += integral(&rule, X0, corner, force_of_platen, &rule) +
                       integral(&rule, corner, X1, force_of_platen, &rule);
    }
    out->friction += rubbed;
    out->external -= model->pressure_force * ds;
    out->external_max = fmax(out->external_max, fabs(out->external));

    double force0 = sb_cycle_force(cycle, X0, segment->stem0);
    double force1 = sb_cycle_force(cycle, X1, segment->stem1);
    const double spring =
        (sb_model_push(model, segment->stem0) + sb_model_push(model, segment->stem1)) / 2 * ds -
        model->pressure_force * ds; // exact: it is straight
    out->stored += (force1 * force1 - force0 * force0) / (2 * k) + spring;
    // F ds around the loop: in a jump the force falls along the spring's line, in sliding it is F_p
    // +- f.
    if (segment->mode == SB_CYCLE_JUMP) {
      const double force = sb_cycle_force(cycle, X0, leaves);
      out->loop += (force0 + force) / 2 * (leaves - segment->stem0) +
                   (force + force1) / 2 * (segment->stem1 - leaves);
    } else {
      out->loop += model->pressure_force * ds + spring + rubbed;
    }
  }
  // A spring with equal initial and final state stores nothing; the remainder is rounding.
  out->stored = fabs(out->stored) <= 16 * DBL_EPSILON * out->external_max ? 0 : out->stored;
  double sum = out->friction + out->stored + out->seal + out->kinetic + out->stop;
  out->closure =
      sb_cycle_closure(out->external_max > 0 ? fabs(out->external - sum) / out->external_max : 0);
}

double sb_cycle_closure(double residual) {
  return residual <= 1e-10 ? 0 : residual;
}
