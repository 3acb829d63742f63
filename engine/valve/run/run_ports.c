// The dose chamber of a valve in motion: its ports, whose flow changes its pressure
// (mechanism/chamber.h).
//
// Ports by position. With y outwards from the land's edge and the contacts' edges l < r in each
// seal's frame, the inner contact starts at y = s_C - s and the outer ends of the chamber are at
// s_C - s + (r - l)_inner and s_C - s - l_inner + spacing + l_outer. The chamber is connected to
// the canister when the inner contact has left the land, to the vent while any of the hole is
// between the two contacts (fully open or closed), and to the canister through a by-pass below
// bore.refill_travel.
#include "engine/valve/run/run_valve.h"

#include <math.h>

static void valve_rate(double *rate, double x, double v, size_t region, const double *extra,
                       void *user) {
  *rate = sb_chamber_rate(&((SbValve *)user)->dose, extra[0]);
}

// Refuses ports without resistance that are open to different pressures simultaneously.
static SbStatus check_ports(const SbChamberModel *chamber, const SbModel *model, SbReport *report) {
  for (size_t i = 0; i < chamber->ports; i++) {
    for (size_t k = 0; k < i; k++) {
      const SbChamberPort *a = &chamber->port[i];
      const SbChamberPort *b = &chamber->port[k];
      if (a->pressure != b->pressure && a->low < b->high && b->low < a->high) {
        return sb_fail_input(
            report, SB_ERROR_INFEASIBLE, sb_input(SB_P_CHAMBER_FLOW),
            "the chamber would be open to canister and vent simultaneously (stem at %.3g to %.3g "
            "mm): "
            "a pressure between them needs chamber.flow = orifice, or other places of the vent "
            "(bore.vent_position) and the by-pass (bore.refill_travel)",
            1e3 * fmax(fmax(a->low, b->low), 0), 1e3 * fmin(fmin(a->high, b->high), model->stroke));
      }
    }
  }
  return SB_OK;
}

// Warns if the chamber never reaches the vent, which is open from `low` to `high` [m].
static void warn_no_vent(const SbValve *valve, double low, double high) {
  sb_warn_serious(
      &valve->run->summary.warnings, "ports-no-vent", sb_input(SB_P_BORE_VENT_POSITION),
      "the dose chamber never reaches the vent: it would at a stem of %.3g to %.3g mm, which "
      "moves from 0 to %.3g mm",
      1e3 * low, 1e3 * high, 1e3 * valve->run->model->stroke);
}

SbStatus sb_valve_set_ports(SbDynamicsModel *out, SbValve *valve, SbReport *report) {
  const SbModel *model = valve->run->model;
  const SbValveType *type = sb_valve_type(model);
  bool at_once = model->chamber_at_once;
  double coefficient = model->discharge_coefficient;
  double canister = model->canister_pressure;
  SbChamberModel *chamber = &valve->chamber_model;
  *chamber = (SbChamberModel){.canister = canister,
                              .volume = model->supply.volume,
                              .stiffness = model->chamber_stiffness,
                              .density = model->density};

  // The land's edge: an annulus.
  const double annulus = model->passage_area;
  double land_area = at_once || annulus <= 0 ? INFINITY : coefficient * annulus;
  const bool bounded = valve->touches; // a chamber whose inner seal has no contact is always open
  chamber->port[chamber->ports++] =
      (SbChamberPort){bounded && type->open_beyond ? valve->edges.open : -INFINITY,
                      bounded && !type->open_beyond ? valve->edges.open : INFINITY,
                      SB_PORT_BOTH_WAYS, canister, land_area};

  double low, high, hole = model->outlet_diameter;
  const bool vents = type->vent(&low, &high, &valve->run->cycle);
  if (hole > 0 && !vents && !type->fills_at_rest) {
    warn_no_vent(valve, low, high);
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
  status = at_once ? check_ports(chamber, model, report) : SB_OK;
  if (status != SB_OK) {
    return status;
  }
  for (size_t i = 0; i < chamber->ports; i++) {
    sb_valve_add_edge(out, chamber->port[i].low);
    sb_valve_add_edge(out, chamber->port[i].high);
  }
  out->extra_rate = valve_rate;
  out->extra_scale = fmax(fabs(canister), 1e3);
  double pressure = canister;
  sb_chamber_start(&valve->dose, chamber, out->start_position, &pressure);
  out->extra_start = sb_chamber_rest_pressure(&valve->dose, pressure);
  return SB_OK;
}
