// The valve as a mechanism with one coordinate (mechanism/dynamics.h) and, if the scene asks for
// ports, one chamber pressure (mechanism/chamber.h); and the frame of any motion's instant.
//
// The same sliding states as in the quasi-static cycle give each seal's Coulomb level, m W + tau_0
// A_a, its static ratio and a viscous coefficient (the viscous force at the reference speed over
// that speed; it is a thousandth of the level, so its weak speed dependence is left out). While the
// edge of the land passes, the inner level follows the part that still touches. With ports the
// levels lie between those of the vented and of the filled chamber, in proportion to its pressure:
// exact where the chamber rests, which is all but the milliseconds of filling and venting.
//
// Contacts that age (friction.breakaway) hold by the law of the state that stands for their
// chamber.
//
// Ports by position. With y from the land's edge outwards and the contacts' edges l < r in each
// seal's frame, the inner contact starts at y = s_C - s and the outer ends of the chamber lie at
// s_C - s + (r - l)_inner and s_C - s - l_inner + spacing + l_outer. The chamber meets the canister
// when the inner contact has left the land, the vent while any of the hole lies between the two
// contacts (open wholly or not at all), and the canister through a by-pass below
// bore.refill_travel.
#include "engine/valve/breakaway.h"
#include "engine/valve/run/run_private.h"

#include <math.h>

// The state that stands for a chamber: sliding the way the stem moves in it.
static int direction_of(SbChamber chamber) {
  return chamber == SB_CHAMBER_CLOSED ? SB_CYCLE_OUT : SB_CYCLE_IN;
}

// How full of pressure the chamber is, 0 vented, 1 at the canister's.
static double filling(const SbRun *run, double pressure) {
  double canister = run->model->canister_pressure;
  return canister > 0 ? fmin(fmax(pressure / canister, 0), 1) : 1;
}

static double level_of(const SbCycle *cycle, int seal, SbChamber chamber, double s) {
  int direction = direction_of(chamber);
  const SbSealState *state = &cycle->state[seal][chamber][direction];
  const SbLandShare on = sb_cycle_land_share(cycle, seal, chamber, direction, s);
  return state->boundary_area * on.width + state->boundary_load * on.load;
}

static void valve_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                        void *user) {
  const SbValve *valve = user;
  const SbCycle *cycle = &valve->run->cycle;
  // Bore and stem are the same on either side of the chamber, so that its pressure cancels.
  loads->force = -valve->run->model->pressure_force;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    loads->rest[seal] =
        valve->run->model->contact_ageing ? &valve->run->rest[seal][valve->chamber] : NULL;
    if (valve->ports) {
      double q = filling(valve->run, extra[0]);
      double vented = q < 1 ? level_of(cycle, seal, SB_CHAMBER_AT_REST, x) : 0;
      double filled = q > 0 ? level_of(cycle, seal, SB_CHAMBER_CLOSED, x) : 0;
      loads->level[seal] = (1 - q) * vented + q * filled;
    } else {
      loads->level[seal] = level_of(cycle, seal, valve->chamber, x);
    }
  }
  // Only while the edge lies under the inner contact does anything change with x.
  bool still = valve->chamber == SB_CHAMBER_OPEN && !valve->ports;
  bool settled = !valve->ports || sb_chamber_settled(&valve->dose, extra[0]);
  loads->settled = settled;
  loads->constant = settled && (still || !valve->varies[region]);
}

// The viscous force is linear in the speed.
static void valve_band(SbDynamicsBand *band, double x, size_t region, int direction, double speed,
                       const double *extra, void *user) {
  const SbRun *run = ((SbValve *)user)->run;
  band->high = INFINITY;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    band->slope[seal] =
        run->cycle.state[seal][SB_CHAMBER_AT_REST][SB_CYCLE_IN].friction_viscous / run->speed;
  }
}

static void valve_cross(size_t edge, int direction, double *extra, void *user) {
  SbValve *valve = user;
  double x = valve->edge[edge];
  if (valve->touches && direction > 0 && x == valve->edge_open) {
    valve->chamber = SB_CHAMBER_OPEN;
  } else if (valve->touches && direction < 0 && x == valve->edge_closed &&
             valve->chamber == SB_CHAMBER_OPEN) {
    valve->chamber = SB_CHAMBER_CLOSED;
  }
  if (valve->ports) {
    sb_chamber_cross(&valve->dose, x, direction, extra);
  }
}

static void valve_rate(double *rate, double x, double v, size_t region, const double *extra,
                       void *user) {
  *rate = sb_chamber_rate(&((SbValve *)user)->dose, extra[0]);
}

// ---------------------------------------------------------------------------------------------------
// Set-up

// Inserts an edge, increasing, without doubles.
static void add_edge(SbDynamicsModel *out, double x) {
  size_t at = 0;
  while (at < out->edges && out->edge[at] < x) {
    at++;
  }
  if (!isfinite(x) || (at < out->edges && out->edge[at] == x) || out->edges == SB_DYNAMICS_EDGES) {
    return;
  }
  for (size_t k = out->edges; k > at; k--) {
    out->edge[k] = out->edge[k - 1];
  }
  out->edge[at] = x;
  out->edges++;
}

static SbStatus set_ports(SbDynamicsModel *out, SbValve *valve, SbReport *report) {
  const SbModel *model = valve->run->model;
  const SbCycle *cycle = &valve->run->cycle;
  const SbSealState *inner = &cycle->state[SB_INNER][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
  const SbSealState *outer = &cycle->state[SB_OUTER][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
  const SbValveShape *shape = &model->shape;
  bool at_once = model->chamber_at_once;
  double coefficient = model->discharge_coefficient;
  double canister = model->canister_pressure;
  SbChamberModel *chamber = &valve->chamber_model;
  *chamber = (SbChamberModel){.canister = canister,
                              .volume = model->metered_volume,
                              .stiffness = model->chamber_stiffness,
                              .density = model->density};

  // The land's edge: an annulus between stem and bore.
  double annulus = M_PI / 4 * (model->bore_diameter - model->stem_diameter) *
                   (model->bore_diameter + model->stem_diameter);
  double land_area = at_once || annulus <= 0 ? INFINITY : coefficient * annulus;
  double opens = valve->touches ? valve->edge_open : -INFINITY;
  chamber->port[chamber->ports++] =
      (SbChamberPort){opens, INFINITY, SB_PORT_BOTH_WAYS, canister, land_area};

  // The vent.
  double hole = shape->vent_diameter;
  double edge = model->land_edge;
  double low = edge + inner->contact_right - inner->contact_left - shape->vent_position - hole / 2;
  double high = edge - inner->contact_left + shape->seal_spacing + outer->contact_left -
                shape->vent_position + hole / 2;
  bool vents = hole > 0 && high > low && high > 0 && low < model->stroke;
  if (hole > 0 && !vents) {
    sb_warn(&valve->run->summary.warnings, "ports-no-vent", "bore.vent_position",
            "the dose chamber never reaches the vent: it would at a stem of %.3g to %.3g mm, which "
            "moves from 0 to %.3g mm",
            1e3 * low, 1e3 * high, 1e3 * model->stroke);
  }
  if (vents) {
    chamber->port[chamber->ports++] =
        (SbChamberPort){low, high, model->vent_on_return ? SB_PORT_ON_RETURN : SB_PORT_BOTH_WAYS, 0,
                        at_once ? INFINITY : coefficient * M_PI / 4 * hole * hole};
  }

  // The by-pass at rest.
  if (model->refill_travel > 0) {
    chamber->port[chamber->ports++] =
        (SbChamberPort){-INFINITY, model->refill_travel, SB_PORT_BOTH_WAYS, canister,
                        at_once ? INFINITY : coefficient * model->refill_area};
  }
  SbStatus status = sb_chamber_check(chamber, report);
  if (status != SB_OK) {
    return status;
  }
  for (size_t i = 0; at_once && i < chamber->ports; i++) {
    for (size_t k = 0; k < i; k++) {
      const SbChamberPort *a = &chamber->port[i];
      const SbChamberPort *b = &chamber->port[k];
      if (a->pressure != b->pressure && a->low < b->high && b->low < a->high) {
        return sb_fail_parameter(
            report, SB_ERROR_INFEASIBLE, "chamber.flow",
            "the chamber would be open to canister and vent at once (stem at %.3g to %.3g mm): "
            "a pressure between them needs chamber.flow = orifice, or other places of the vent "
            "(bore.vent_position) and the by-pass (bore.refill_travel)",
            1e3 * fmax(fmax(a->low, b->low), 0), 1e3 * fmin(fmin(a->high, b->high), model->stroke));
      }
    }
  }
  for (size_t i = 0; i < chamber->ports; i++) {
    add_edge(out, chamber->port[i].low);
    add_edge(out, chamber->port[i].high);
  }
  out->extra_rate = valve_rate;
  out->extra_scale = fmax(canister, 1e3);
  double pressure = canister;
  sb_chamber_start(&valve->dose, chamber, out->start_position, &pressure);
  out->extra_start = sb_chamber_rest_pressure(&valve->dose, pressure);
  return SB_OK;
}

static SbStatus valve_mass(double *mass, double x, double v, void *user, SbReport *report) {
  const SbValve *valve = user;
  return sb_run_bodies_move(mass, valve->run, x, v, report);
}

// The law of a contact that ages, over its sliding level.
static SbStatus set_rest(SbRun *run, int seal, SbChamber chamber, SbReport *report) {
  const SbSealState *state = &run->cycle.state[seal][chamber][direction_of(chamber)];
  const double level = state->boundary_area + state->boundary_load;
  SbDwellLaw *law = &run->rest[seal][chamber];
  double squeeze_time;
  SbStatus status = sb_breakaway_law(law, &squeeze_time, run->model, seal, state, report);
  for (size_t i = 0; i < law->count; i++) {
    SbDwellPiece *piece = &law->piece[i];
    piece->value = level > 0 ? piece->value / level : 1;
    piece->gain = level > 0 ? piece->gain / level : 0;
  }
  return status;
}

SbStatus sb_valve_set_up(SbDynamicsModel *out, SbValve *valve, SbRun *run, SbReport *report) {
  const SbModel *model = run->model;
  const SbCycle *cycle = &run->cycle;
  *valve = (SbValve){.run = run, .ports = model->pressure_map == SB_MAP_PORTS};
  *out = (SbDynamicsModel){
      .mass = run->bodies != NULL ? sb_run_bodies_mass(run->bodies) : model->moving_mass,
      .spring_preload = model->spring_preload,
      .spring_stiffness = model->spring_stiffness,
      .contacts = SB_SEAL_COUNT,
      .stops = 2,
      .loads = valve_loads,
      .band = valve_band,
      .cross = valve_cross,
      .mass_at = run->bodies != NULL ? valve_mass : NULL,
      .user = valve,
      .start_dwell = model->rest,
      .tolerance = model->motion_tolerance,
  };
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const SbSealState *state = &cycle->state[seal][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
    double level = state->boundary_area + state->boundary_load;
    // Static friction is that of the dry contact.
    double dry = level > 0 ? (state->rest_area + state->rest_load) / level : 1;
    out->contact[seal] = sb_model_contact(model, fmax(model->static_ratio * dry, 1), out->mass);
    out->contact[seal].dwell_gain *= model->contact_ageing ? 1 : dry;
    for (int chamber = 0; model->contact_ageing && chamber < SB_CYCLE_CHAMBERS; chamber++) {
      SbStatus status = set_rest(run, seal, (SbChamber)chamber, report);
      if (status != SB_OK) {
        return status;
      }
    }
  }
  out->stop[SB_REST_STOP] = (SbDynamicsStop){0, -1, INFINITY, 0};
  out->stop[SB_END_STOP] =
      (SbDynamicsStop){model->stroke, 1, model->stop_stiffness, model->stop_restitution};
  sb_valve_set_drive(out, &valve->times, run);

  // Edges: where the contact meets the land's end, where it has left, where it comes back.
  valve->touches = cycle->state[SB_INNER][SB_CHAMBER_AT_REST][SB_CYCLE_IN].touches;
  double near = INFINITY, far = -INFINITY;
  if (valve->touches) {
    double closed = sb_cycle_edge_begin(cycle, SB_CHAMBER_CLOSED, SB_CYCLE_OUT);
    near = fmin(model->land_edge, closed);
    add_edge(out, closed);
    valve->edge_open = sb_cycle_edge_end(cycle, SB_CHAMBER_AT_REST, SB_CYCLE_IN);
    valve->edge_closed = sb_cycle_edge_end(cycle, SB_CHAMBER_CLOSED, SB_CYCLE_OUT);
    far = fmax(valve->edge_open, valve->edge_closed);
    if (valve->ports) {
      // The wider contact decides, whatever the pressure is when it leaves.
      valve->edge_open = valve->edge_closed = far;
    }
    add_edge(out, model->land_edge);
    add_edge(out, valve->edge_open);
    add_edge(out, valve->edge_closed);
  }
  bool behind = out->start_position >= valve->edge_open;
  valve->chamber = !valve->touches || behind ? SB_CHAMBER_OPEN : SB_CHAMBER_AT_REST;
  if (valve->ports) {
    SbStatus status = set_ports(out, valve, report);
    if (status != SB_OK) {
      return status;
    }
    // The orifice law holds for turbulent jets of liquid.
    double jet = sqrt(2 * model->canister_pressure / model->density);
    double reynolds = model->density * jet * model->shape.vent_diameter / model->viscosity;
    if (valve->chamber_model.ports > 1 && !model->chamber_at_once && reynolds < 1e3) {
      sb_warn(&run->summary.warnings, "vent-laminar", "bore.vent_diameter",
              "the vent's jet has a Reynolds number of %.3g: the orifice law needs 1000 and more",
              reynolds);
    }
  }
  // Nothing varies with the place where the inner seal does not rub.
  bool rubs = level_of(cycle, SB_INNER, SB_CHAMBER_AT_REST, 0) > 0 ||
              level_of(cycle, SB_INNER, SB_CHAMBER_CLOSED, 0) > 0;
  for (size_t region = 0; region <= out->edges; region++) {
    double low = region > 0 ? out->edge[region - 1] : -INFINITY;
    double high = region < out->edges ? out->edge[region] : INFINITY;
    valve->varies[region] = valve->touches && rubs && low >= near && high <= far;
    if (region < out->edges) {
      valve->edge[region] = high;
    }
  }
  return SB_OK;
}

// ---------------------------------------------------------------------------------------------------
// Frames

double sb_valve_chamber_pressure(const SbValve *valve, double extra) {
  return valve->ports ? extra
                      : sb_model_seal_pressure(valve->run->model, SB_OUTER, valve->chamber).left;
}

SbSolvedState sb_valve_solved(const SbValve *valve, int direction, double pressure) {
  if (valve->chamber == SB_CHAMBER_OPEN) {
    return (SbSolvedState){SB_CHAMBER_OPEN, direction};
  }
  // With ports the nearest to what the chamber holds.
  SbChamber chamber = valve->chamber;
  if (valve->ports) {
    chamber = filling(valve->run, pressure) < 0.5 ? SB_CHAMBER_AT_REST : SB_CHAMBER_CLOSED;
  }
  return (SbSolvedState){chamber, direction_of(chamber)};
}

double sb_run_film_at(const SbRun *run, double speed) {
  return run->film_exponent > 0 ? pow(fabs(speed) / run->speed, run->film_exponent) : 1;
}

// Contact, load and film of one seal at stem displacement s.
static void fill_contact(SbSealFrame *out, const SbRun *run, int seal, SbSolvedState solved,
                         bool moving, double s) {
  const SbChamber chamber = solved.chamber;
  const int direction = solved.direction, motion = moving ? direction : SB_RUN_REST;
  // At rest a solved ring is one that friction does not drag; other models know one contact.
  const SbSealState *still = &run->cycle.state[seal][chamber][SB_RUN_REST];
  const SbSealState *slides = &run->cycle.state[seal][chamber][direction];
  const SbSealState *state = run->plan.ring && !moving && still->load > 0 ? still : slides;
  const SbSealPressure pressure = sb_model_seal_pressure(run->model, seal, chamber);
  const SbLandShare on = sb_cycle_land_share(&run->cycle, seal, chamber, direction, s);
  const uint32_t drawn = sb_run_shape_index(run, seal, chamber, motion, on.width < 1 ? s : 0);
  const SbSealShape *shape = on.width < 1 ? sb_run_shape(run, drawn) : NULL;
  double width = state->contact_right - state->contact_left;

  // The edge takes the contact away from the canister side.
  *out = (SbSealFrame){
      .land_fraction = (float)on.width,
      .pressure_left = (float)pressure.left,
      .pressure_right = (float)pressure.right,
      .profile = run->plan.profiles && state->touches
                     ? sb_run_profile_slot(seal, (int)chamber, motion)
                     : UINT32_MAX,
      .shape = drawn,
      .contact_left = shape != NULL ? shape->contact_left : state->contact_right - on.width * width,
      .contact_right = shape != NULL ? shape->contact_right : state->contact_right,
      .load = on.load * state->load,
      .pressure_peak = on.width > 0.5 ? state->pressure_peak : 0,
  };
  if (on.width > 0 && on.width <= 0.5) {
    // The elliptic profile's greatest remaining value, at the edge.
    double c = 1 - 2 * (1 - on.width);
    out->pressure_peak = state->pressure_peak * sqrt(fmax(1 - c * c, 0));
  }
  // At rest the surfaces meet; off the land there is no film.
  if (!state->touches || !(on.width > 0)) {
    out->film_min = out->film_central = out->lambda = NAN;
  } else if (moving) {
    out->film_min = state->film_min;
    out->film_central = state->film_central;
    out->lambda = state->lambda;
  }
}

// The contact of a seal between the vented and the filled chamber, as the friction is.
static void blend_contact(SbSealFrame *out, const SbRun *run, int seal, const SbInstant *at) {
  const SbSolvedState end[] = {{SB_CHAMBER_AT_REST, SB_CYCLE_IN},
                               {SB_CHAMBER_CLOSED, SB_CYCLE_OUT}};
  const double q = filling(run, at->pressure), share[] = {1 - q, q};
  out->contact_left = out->contact_right = out->load = out->pressure_peak = 0;
  for (int i = 0; i < 2; i++) {
    SbSealFrame of;
    fill_contact(&of, run, seal, end[i], at->moving, at->sample.position);
    out->contact_left += share[i] * of.contact_left;
    out->contact_right += share[i] * of.contact_right;
    out->load += share[i] * of.load;
    out->pressure_peak += share[i] * of.pressure_peak;
  }
}

void sb_run_fill_frame(SbFrame *out, const SbRun *run, const SbInstant *at) {
  const SbDynamicsSample *sample = &at->sample;
  *out = (SbFrame){
      .time = sample->time,
      .displacement = sample->position,
      .velocity = sample->speed,
      .platen = sample->drive_position,
      .force = sample->drive_force,
      .pressure_force = run->model->pressure_force,
      .stop_force = sample->stop_force[SB_END_STOP] - sample->stop_force[SB_REST_STOP],
      .spring_force = -sample->spring_force,
      .chamber_pressure = at->pressure,
      .stage = (uint8_t)at->stage,
      .chamber = (uint8_t)at->chamber,
  };
  const double film = sb_run_film_at(run, sample->speed);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    SbSealFrame *of = &out->seal[seal];
    fill_contact(of, run, seal, at->solved, at->moving, sample->position);
    if (run->model->pressure_map == SB_MAP_PORTS) {
      *(seal == SB_INNER ? &of->pressure_right : &of->pressure_left) = (float)at->pressure;
      if (at->chamber != SB_CHAMBER_OPEN) {
        blend_contact(of, run, seal, at);
      }
    }
    of->film_min *= film;
    of->film_central *= film;
    of->lambda *= film;
    of->friction = -sample->friction[seal];
    const SbSealState *state = &run->cycle.state[seal][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
    double viscous = state->friction_viscous / run->speed * sample->speed;
    of->friction_viscous = at->moving && of->friction != 0 ? viscous : 0;
    of->friction_boundary = of->friction - of->friction_viscous;
  }
}
