// The valve as a mechanism with one coordinate (mechanism/dynamics.h) and, with ports, one chamber
// pressure (mechanism/chamber.h).
//
// The sliding states of the quasi-static cycle at all speeds (run_speeds.c) give each seal's
// friction. Its level is that without a film, tau_0 A_a(0) + m W. The decrease by the film and the
// increase by its shear at a speed are approximated by bands of speed in which they are linear, to
// BAND_TOLERANCE of the level (dynamics.h). While the edge of the land passes, the inner seal's
// friction follows the part that is still in contact. With ports, friction is interpolated between
// the vented and the filled chamber, in proportion to its pressure.
//
// Contacts that age (friction.breakaway) have the law of the state that applies to their chamber.
#include "engine/valve/run/run_valve.h"
#include "engine/valve/run/valve_type.h"
#include "engine/valve/states/breakaway.h"

#include <math.h>

// Of the friction without a film.
static const double band_tolerance = 1e-3;

double sb_valve_filling(const SbRun *run, double pressure) {
  double canister = run->model->canister_pressure;
  double full = canister != 0 ? fmin(fmax(pressure / canister, 0), 1) : 1;
  return sb_valve_type(run->model)->fills_at_rest ? 1 - full : full;
}

int sb_valve_passing(SbChamber chamber) {
  return chamber == SB_CHAMBER_CLOSED ? SB_CYCLE_OUT : SB_CYCLE_IN;
}

SbLandShare sb_valve_land_share(const SbCycle *cycle, int seal, SbChamber chamber, double s) {
  return sb_cycle_land_share(cycle, seal, chamber, sb_valve_passing(chamber), s);
}

// States between which friction is interpolated: with ports those of the vented and the filled
// chamber.
typedef struct {
  int count;
  SbChamber chamber[2];
  double share[2];
} Ends;

static Ends ends_of(const SbValve *valve, double pressure) {
  if (!valve->ports) {
    return (Ends){1, {valve->chamber}, {1}};
  }
  double q = sb_valve_filling(valve->run, pressure);
  return (Ends){2, {SB_CHAMBER_AT_REST, SB_CHAMBER_CLOSED}, {1 - q, q}};
}

// Does the same for the motion, which needs it several times at each position.
static SbLandShare land_at(SbValve *valve, int seal, SbChamber chamber, double s) {
  if (seal == SB_OUTER) {
    double whole =
        valve->run->cycle.state[seal][chamber][sb_valve_passing(chamber)].touches ? 1 : 0;
    return (SbLandShare){whole, whole};
  }
  if (valve->land_at[chamber] != s) {
    valve->land_at[chamber] = s;
    valve->land[chamber] = sb_valve_land_share(&valve->run->cycle, seal, chamber, s);
  }
  return valve->land[chamber];
}

// Friction of a contact without a film: as the speed goes to 0.
static double level_of(SbValve *valve, int seal, SbChamber chamber, int direction, double s) {
  const SbSealState *state = &valve->run->cycle.state[seal][chamber][direction];
  const SbLandShare on = land_at(valve, seal, chamber, s);
  return state->rest_area * on.width + state->rest_load * on.load;
}

static void valve_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                        void *user) {
  SbValve *valve = user;
  // Bore and stem are the same on either side of the chamber, so that its pressure cancels.
  loads->force = -valve->run->model->pressure_force;
  const Ends ends = ends_of(valve, extra[0]);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    loads->rest[seal] =
        valve->run->model->contact_ageing ? &valve->run->rest[seal][valve->chamber] : NULL;
    for (int i = 0; i < ends.count; i++) {
      if (ends.share[i] > 0) {
        double in = level_of(valve, seal, ends.chamber[i], SB_CYCLE_IN, x);
        double out =
            valve->both_alike ? in : level_of(valve, seal, ends.chamber[i], SB_CYCLE_OUT, x);
        loads->level[seal] += ends.share[i] * in;
        loads->back[seal] += ends.share[i] * (out - in);
      }
    }
  }
  // Something changes with x only while the edge is under the inner contact.
  bool still = valve->chamber == SB_CHAMBER_OPEN && !valve->ports;
  bool settled = !valve->ports || sb_chamber_settled(&valve->dose, extra[0]);
  loads->settled = settled;
  loads->constant = settled && (still || !valve->varies[region]);
}

// Contributions of the speed to the parts of friction, vented and filled.
typedef struct {
  double width[SB_SEAL_COUNT][2], load[SB_SEAL_COUNT][2]; // N
  double level[SB_SEAL_COUNT][2];                         // without a film
} Added;

static void added_at(Added *out, SbValve *valve, int direction, double speed) {
  const Ends ends = ends_of(valve, 0);
  *out = (Added){0};
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    for (int i = 0; i < ends.count; i++) {
      const int chamber = (int)ends.chamber[i];
      const SbSealState *base = &valve->run->cycle.state[seal][chamber][direction];
      if (!base->touches || (seal == SB_INNER && ends.chamber[i] == SB_CHAMBER_OPEN)) {
        continue;
      }
      out->level[seal][i] = base->rest_area + base->rest_load;
      if (speed > 0) {
        SbSealState state;
        sb_run_state_at(&state, valve->run, seal, chamber, direction, speed);
        out->width[seal][i] = state.boundary_area + state.friction_viscous - state.rest_area;
        out->load[seal][i] = state.boundary_load - state.rest_load;
      }
    }
  }
}

static SbBandPart line(const SbValveBand *band, double low, double high) {
  double slope = (high - low) / (band->high - band->low);
  return (SbBandPart){low - slope * band->low, slope};
}

// Fits the band from `low` to `high` to the friction at its ends. Returns its largest deviation in
// between, divided by the friction without a film. A power of the speed deviates most at a quarter
// of the band.
static double try_band(SbValveBand *band, SbValve *valve, int direction, double low, double high) {
  Added ends[2], at;
  band->low = low;
  band->high = high;
  added_at(&ends[0], valve, direction, low);
  added_at(&ends[1], valve, direction, high);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    for (int i = 0; i < 2; i++) {
      band->width[seal][i] = line(band, ends[0].width[seal][i], ends[1].width[seal][i]);
      band->load[seal][i] = line(band, ends[0].load[seal][i], ends[1].load[seal][i]);
    }
  }
  double worst = 0;
  for (int k = 1; k < 3; k++) {
    double speed = low + 0.25 * k * (high - low);
    added_at(&at, valve, direction, speed);
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      for (int i = 0; i < 2; i++) {
        const SbBandPart *w = &band->width[seal][i], *l = &band->load[seal][i];
        double off = fabs(w->rise + w->slope * speed - at.width[seal][i]) +
                     fabs(l->rise + l->slope * speed - at.load[seal][i]);
        worst = fmax(worst, off > 0 ? off / at.level[seal][i] : 0);
      }
    }
  }
  return worst;
}

// Adds the next band, from the end of the last one as far as friction is linear, in steps of a
// seventh of a decade so that no state is solved at speeds that never occur.
static void add_band(SbValveBands *bands, SbValve *valve, int direction) {
  const double step = pow(10, 1.0 / 7), first = 1e-2, most = 1e3;
  const double low = bands->count > 0 ? bands->item[bands->count - 1].high : 0;
  double high = low > 0 ? low * step : first;
  SbValveBand wider, *band = &bands->item[bands->count++];
  if (low >= most || bands->count == SB_VALVE_BANDS) {
    // So fast that nothing is known of it: as at its begin.
    (void)try_band(band, valve, direction, low, low * step);
    band->high = INFINITY;
    for (int i = 0; i < 2 * SB_SEAL_COUNT; i++) {
      SbBandPart *w = &band->width[i / 2][i % 2], *l = &band->load[i / 2][i % 2];
      *w = (SbBandPart){w->rise + w->slope * low, 0};
      *l = (SbBandPart){l->rise + l->slope * low, 0};
    }
    return;
  }
  double off = try_band(band, valve, direction, low, high);
  while (off > band_tolerance && high > SB_SPEED_LEAST && low == 0) {
    high /= step;
    off = try_band(band, valve, direction, low, high);
  }
  for (bool straight = low > 0 || high >= first; straight && high < most;) {
    double more = try_band(&wider, valve, direction, low, high * step);
    straight = more <= band_tolerance;
    if (straight) {
      *band = wider;
      high *= step;
      off = more;
    }
  }
  valve->run->straight_error = fmax(valve->run->straight_error, off);
}

static const SbValveBand *find_band(SbValve *valve, int direction, double speed) {
  SbValveBands *bands = &valve->run->bands[valve->ports ? 0 : valve->chamber][direction];
  while (bands->count == 0 || speed >= bands->item[bands->count - 1].high) {
    add_band(bands, valve, direction);
  }
  size_t i = 0;
  while (speed >= bands->item[i].high) {
    i++;
  }
  return &bands->item[i];
}

static void valve_band(SbDynamicsBand *out, double x, size_t region, int direction, double speed,
                       const double *extra, void *user) {
  SbValve *valve = user;
  const int way = direction > 0 ? SB_CYCLE_IN : SB_CYCLE_OUT;
  const SbValveBand *band = find_band(valve, way, speed);
  const Ends ends = ends_of(valve, extra[0]);
  out->low = band->low;
  out->high = band->high;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    for (int i = 0; i < ends.count; i++) {
      const SbLandShare on = land_at(valve, seal, ends.chamber[i], x);
      const SbBandPart *w = &band->width[seal][i], *l = &band->load[seal][i];
      out->rise[seal] += ends.share[i] * (on.width * w->rise + on.load * l->rise);
      out->slope[seal] += ends.share[i] * (on.width * w->slope + on.load * l->slope);
    }
  }
}

static void valve_cross(size_t edge, int direction, double *extra, void *user) {
  SbValve *valve = user;
  double x = valve->edge[edge];
  if (valve->touches) {
    valve->chamber =
        sb_valve_type(valve->run->model)->cross(&valve->edges, valve->chamber, direction, x);
  }
  if (valve->ports) {
    sb_chamber_cross(&valve->dose, x, direction, extra);
  }
}

// ---------------------------------------------------------------------------------------------------
// Set-up

void sb_valve_add_edge(SbDynamicsModel *out, double x) {
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

static SbStatus valve_mass(double *mass, double x, double v, void *user, SbReport *report) {
  const SbValve *valve = user;
  return sb_run_bodies_move(mass, valve->run, x, v, report);
}

// Computes the law of a contact that ages, divided by its level. A stem comes to rest through
// steady states of decreasing speed, the last of which has no film: static friction is at least the
// dry level.
static SbStatus set_rest(SbRun *run, int seal, SbChamber chamber, SbReport *report) {
  const SbSealState *state = &run->cycle.state[seal][chamber][sb_valve_passing(chamber)];
  const double level = state->rest_area + state->rest_load;
  SbDwellLaw *law = &run->rest[seal][chamber];
  double squeeze_time;
  SbStatus status = sb_breakaway_law(law, &squeeze_time, run->model, seal, state, NULL, report);
  for (size_t i = 0; i < law->count; i++) {
    SbDwellPiece *piece = &law->piece[i];
    const SbDwellPiece *next = piece + 1;
    piece->value = level > 0 ? piece->value / level : 1;
    piece->gain = level > 0 ? piece->gain / level : 0;
    if (piece->value < 1) {
      // Straight to where the next piece is above.
      double end = i + 1 < law->count && level > 0 ? fmax(1, next->value / level) : 1;
      piece->value = 1;
      piece->gain = end > 1 ? (end - 1) / log1p((next->from - piece->from) / piece->time) : 0;
    }
  }
  return status;
}

// Sets the contacts of both seals, and with contact ageing their states at rest.
static SbStatus set_contacts(SbDynamicsModel *out, SbRun *run, SbReport *report) {
  const SbModel *model = run->model;
  const SbCycle *cycle = &run->cycle;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const SbSealState *state = &cycle->state[seal][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
    double level = state->rest_area + state->rest_load;
    double ratio = state->section == SB_RING_ROLLS || state->section == SB_RING_JAMS
                       ? state->friction_static / level
                       : model->static_ratio;
    out->contact[seal] = sb_model_contact(model, level > 0 ? fmax(ratio, 1) : 1, out->mass);
    for (int chamber = 0; model->contact_ageing && chamber < SB_CYCLE_CHAMBERS; chamber++) {
      SbStatus status = set_rest(run, seal, (SbChamber)chamber, report);
      if (status != SB_OK) {
        return status;
      }
    }
  }
  return SB_OK;
}

// Adds the edges where the inner contact meets the land's end, where it has left it and where it
// returns. Writes the ends of the contact with the land to *near and *far [m]; without a contact
// they are INFINITY and -INFINITY.
static void set_edges(SbDynamicsModel *out, SbValve *valve, const SbRun *run, double *near,
                      double *far) {
  const SbModel *model = run->model;
  const SbCycle *cycle = &run->cycle;
  valve->touches = cycle->state[SB_INNER][SB_CHAMBER_AT_REST][SB_CYCLE_IN].touches;
  *near = INFINITY;
  *far = -INFINITY;
  if (!valve->touches) {
    return;
  }
  double closed = sb_cycle_edge_begin(cycle, SB_CHAMBER_CLOSED, SB_CYCLE_OUT);
  *near = fmin(model->land_edge, closed);
  sb_valve_add_edge(out, closed);
  const double end_open = sb_cycle_edge_end(cycle, SB_CHAMBER_AT_REST, SB_CYCLE_IN);
  const double end_closed = sb_cycle_edge_end(cycle, SB_CHAMBER_CLOSED, SB_CYCLE_OUT);
  *far = fmax(end_open, end_closed);
  sb_valve_add_edge(out, end_open);
  sb_valve_add_edge(out, end_closed);
  const bool beyond = sb_valve_type(model)->open_beyond;
  valve->edges.open = beyond ? end_open : model->land_edge;
  valve->edges.closed = beyond ? end_closed : closed;
  if (valve->ports) {
    // The wider contact decides, whatever the pressure is when it leaves.
    valve->edges.open = valve->edges.closed = beyond ? *far : *near;
  }
  // Where the seals' figures are taken.
  valve->middle = model->land_edge / 2;
  sb_valve_add_edge(out, valve->middle);
  sb_valve_add_edge(out, model->land_edge);
  sb_valve_add_edge(out, valve->edges.open);
  sb_valve_add_edge(out, valve->edges.closed);
}

// Warns if the jet of the vent is not turbulent, for which the orifice law is valid.
static void warn_laminar(SbRun *run, const SbValve *valve) {
  const SbModel *model = run->model;
  double jet = sqrt(2 * fabs(model->canister_pressure) / model->density);
  double reynolds = model->density * jet * model->shape.vent_diameter / model->viscosity;
  if (valve->chamber_model.ports > 1 && !model->chamber_at_once && reynolds < 1e3) {
    sb_warn(&run->summary.warnings, "vent-laminar", sb_input(SB_P_BORE_VENT_DIAMETER),
            "the vent's jet has a Reynolds number of %.3g: the orifice law needs 1000 and more",
            reynolds);
  }
}

// Sets in which regions between the edges the loads vary with the place, and whether they are equal
// in both directions.
static void set_regions(SbValve *valve, const SbDynamicsModel *out, const SbCycle *cycle,
                        double near, double far) {
  // Nothing varies with the place where the inner seal does not rub.
  bool rubs = false;
  valve->both_alike = true;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    for (int chamber = 0; chamber < SB_CYCLE_CHAMBERS; chamber++) {
      const SbSealState *in = &cycle->state[seal][chamber][SB_CYCLE_IN];
      const SbSealState *back = &cycle->state[seal][chamber][SB_CYCLE_OUT];
      rubs = rubs || (seal == SB_INNER && chamber != SB_CHAMBER_OPEN &&
                      (in->rest_area + in->rest_load > 0 || back->rest_area + back->rest_load > 0));
      valve->both_alike = valve->both_alike && in->rest_area == back->rest_area &&
                          in->rest_load == back->rest_load &&
                          in->contact_left == back->contact_left &&
                          in->contact_right == back->contact_right;
    }
  }
  for (size_t region = 0; region <= out->edges; region++) {
    double low = region > 0 ? out->edge[region - 1] : -INFINITY;
    double high = region < out->edges ? out->edge[region] : INFINITY;
    valve->varies[region] = valve->touches && rubs && low >= near && high <= far;
    if (region < out->edges) {
      valve->edge[region] = high;
    }
  }
}

SbStatus sb_valve_set_up(SbDynamicsModel *out, SbValve *valve, SbRun *run, SbReport *report) {
  const SbModel *model = run->model;
  const SbCycle *cycle = &run->cycle;
  *valve = (SbValve){.run = run, .ports = model->pressure_map == SB_MAP_PORTS};
  for (int chamber = 0; chamber < SB_CYCLE_CHAMBERS; chamber++) {
    valve->land_at[chamber] = NAN;
  }
  for (int i = 0; i < SB_CYCLE_CHAMBERS * SB_RUN_REST; i++) {
    (&run->bands[0][0])[i].count = 0;
  }
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
  SbStatus status = set_contacts(out, run, report);
  if (status != SB_OK) {
    return status;
  }
  out->stop[SB_REST_STOP] = (SbDynamicsStop){0, -1, INFINITY, 0};
  out->stop[SB_END_STOP] =
      (SbDynamicsStop){model->stroke, 1, model->stop_stiffness, model->stop_restitution};
  sb_valve_set_drive(out, &valve->times, run);

  double near, far;
  set_edges(out, valve, run, &near, &far);
  const SbValveType *type = sb_valve_type(model);
  const bool behind = out->start_position >= valve->edges.open;
  valve->edges.port = type->port(model);
  sb_valve_add_edge(out, valve->edges.port);
  valve->chamber = !valve->touches || behind == type->open_beyond ? SB_CHAMBER_OPEN
                   : out->start_position >= valve->edges.port     ? SB_CHAMBER_CLOSED
                                                                  : SB_CHAMBER_AT_REST;
  if (valve->ports) {
    status = sb_valve_set_ports(out, valve, report);
    if (status != SB_OK) {
      return status;
    }
    warn_laminar(run, valve);
  }
  set_regions(valve, out, cycle, near, far);
  return SB_OK;
}
