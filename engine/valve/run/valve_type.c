// The kinds of valves, see the header: a stem whose rings slide in a bore, and one that slides
// through gaskets (engine/valve/model/gasket.h).
#include "engine/valve/run/valve_type.h"

#include "engine/valve/model/gasket.h"

#include <math.h>

// ---------------------------------------------------------------------------------------------------
// Rings in a bore

static double piston_base_radius(const SbModel *model, const SbRingLoad *load) {
  (void)model;
  return load->floor_radius;
}

static double piston_edge_shift(const SbSealState *first, const SbSealState *inner) {
  // Friction displaces the contact of a solved ring on the return.
  return inner->contact_left - first->contact_left;
}

static SbChamber piston_closes_as(int direction) {
  return direction == SB_CYCLE_OUT ? SB_CHAMBER_CLOSED : SB_CHAMBER_OPEN;
}

static double piston_port(const SbModel *model) {
  (void)model;
  return NAN;
}

static int piston_reach(SbChamber *chamber, const SbCycle *cycle, const SbPassage *from, double s,
                        int event) {
  const bool in = from->direction == SB_CYCLE_IN;
  *chamber = from->chamber;
  if (in && from->chamber != SB_CHAMBER_OPEN) {
    const bool open = s >= sb_cycle_edge_end(cycle, from->chamber, from->direction);
    *chamber = open ? SB_CHAMBER_OPEN : from->chamber;
  } else if (!in && from->chamber == SB_CHAMBER_OPEN) {
    const double end = sb_cycle_edge_end(cycle, SB_CHAMBER_CLOSED, SB_CYCLE_OUT);
    *chamber = s <= end ? SB_CHAMBER_CLOSED : SB_CHAMBER_OPEN;
    event = s == end ? SB_STAGE_F : -1;
  }
  return in && s == cycle->model->land_edge && from->stage == SB_STAGE_B ? SB_STAGE_C : event;
}

static SbChamber piston_cross(const SbChamberEdges *edges, SbChamber chamber, int direction,
                              double s) {
  if (direction > 0 && s == edges->open) {
    return SB_CHAMBER_OPEN;
  }
  const bool closes = direction < 0 && s == edges->closed && chamber == SB_CHAMBER_OPEN;
  return closes ? SB_CHAMBER_CLOSED : chamber;
}

static double piston_stop_friction(const SbCycle *cycle, int seal) {
  return sb_cycle_static_friction(cycle, seal, SB_CHAMBER_AT_REST, SB_CYCLE_IN, 0);
}

static bool piston_is_wet(const SbModel *model, SbChamber chamber) {
  // With ports the chamber at rest represents the vented one.
  return chamber != SB_CHAMBER_AT_REST || model->pressure_map == SB_MAP_CHAMBER_FILLED;
}

static bool piston_vent(double *low, double *high, const SbCycle *cycle) {
  const SbModel *model = cycle->model;
  const SbSealState *inner = &cycle->state[SB_INNER][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
  const SbSealState *outer = &cycle->state[SB_OUTER][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
  const SbValveShape *shape = &model->shape;
  const double hole = model->outlet_diameter, edge = model->land_edge;
  *low = edge + inner->contact_right - inner->contact_left - shape->vent_position - hole / 2;
  *high = edge - inner->contact_left + shape->seal_spacing + outer->contact_left -
          shape->vent_position + hole / 2;
  return hole > 0 && *high > *low && *high > 0 && *low < model->stroke;
}

// ---------------------------------------------------------------------------------------------------
// Gaskets around the stem

// The stem's surface.
static double gasket_base_radius(const SbModel *model, const SbRingLoad *load) {
  (void)load;
  return model->bore_diameter / 2;
}

static double gasket_edge_shift(const SbSealState *first, const SbSealState *inner) {
  // The stem's shoulder comes from the right, and goes to the left.
  return first->contact_right - inner->contact_right;
}

static SbChamber gasket_closes_as(int direction) {
  (void)direction;
  return SB_CHAMBER_AT_REST;
}

static int gasket_reach(SbChamber *chamber, const SbCycle *cycle, const SbPassage *from, double s,
                        int event) {
  const bool in = from->direction == SB_CYCLE_IN, open = from->chamber == SB_CHAMBER_OPEN;
  const SbChamber closes = open ? SB_CHAMBER_AT_REST : from->chamber;
  const double edge = sb_cycle_edge_begin(cycle, closes, from->direction);
  *chamber = from->chamber;
  if (in && open && s >= edge) {
    *chamber = SB_CHAMBER_AT_REST;
    event = s == edge && from->stage == SB_STAGE_B ? SB_STAGE_C : event;
  } else if (!in && !open && s <= edge) {
    *chamber = SB_CHAMBER_OPEN;
    event = s == edge ? SB_STAGE_F : event;
  }
  if (in && *chamber == SB_CHAMBER_AT_REST && s >= sb_gasket_port_opens(cycle->model)) {
    *chamber = SB_CHAMBER_CLOSED; // vented
  }
  return event;
}

// The shoulder closes the full chamber and opens it again, the port empties it.
static SbChamber gasket_cross(const SbChamberEdges *edges, SbChamber chamber, int direction,
                              double s) {
  if (direction > 0 && s == edges->open && chamber == SB_CHAMBER_OPEN) {
    return SB_CHAMBER_AT_REST;
  }
  if (direction > 0 && s == edges->port && chamber == SB_CHAMBER_AT_REST) {
    return SB_CHAMBER_CLOSED;
  }
  const bool opens = direction < 0 && ((s == edges->closed && chamber == SB_CHAMBER_CLOSED) ||
                                       (s == edges->open && chamber == SB_CHAMBER_AT_REST));
  return opens ? SB_CHAMBER_OPEN : chamber;
}

static double gasket_stop_friction(const SbCycle *cycle, int seal) {
  return sb_cycle_static_friction(cycle, seal, SB_CHAMBER_CLOSED, SB_CYCLE_IN,
                                  cycle->model->stroke);
}

static bool gasket_is_wet(const SbModel *model, SbChamber chamber) {
  (void)model;
  return chamber != SB_CHAMBER_CLOSED; // vented, and both gaskets close it
}

static bool gasket_vent(double *low, double *high, const SbCycle *cycle) {
  *low = sb_gasket_port_opens(cycle->model);
  *high = INFINITY;
  return *low < cycle->model->stroke;
}

static const SbValveType types[] = {
    [SB_VALVE_PISTON] = {.open_beyond = true,
                         .drawn_over_edge = true,
                         .pressed_by = SB_P_GLAND_RADIAL_SPACE,
                         .base_radius = piston_base_radius,
                         .edge_shift = piston_edge_shift,
                         .closes_as = piston_closes_as,
                         .port = piston_port,
                         .reach = piston_reach,
                         .cross = piston_cross,
                         .stop_friction = piston_stop_friction,
                         .is_wet = piston_is_wet,
                         .vent = piston_vent},
    [SB_VALVE_GASKET] = {.fills_at_rest = true,
                         .layer_evaporates = true,
                         .drive_friction = true,
                         .pressed_by = SB_P_GASKET_CRIMP,
                         .no_gland = "a gasket is clamped between plates, not in a gland",
                         .base_radius = gasket_base_radius,
                         .edge_shift = gasket_edge_shift,
                         .closes_as = gasket_closes_as,
                         .port = sb_gasket_port_opens,
                         .reach = gasket_reach,
                         .cross = gasket_cross,
                         .stop_friction = gasket_stop_friction,
                         .is_wet = gasket_is_wet,
                         .vent = gasket_vent},
};

const SbValveType *sb_valve_type(const SbModel *model) {
  return &types[model->kind];
}
