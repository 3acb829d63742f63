// The frame of an instant of any motion.
#include "engine/valve/model/motion_kind.h"
#include "engine/valve/run/run_valve.h"

#include <math.h>

double sb_valve_chamber_pressure(const SbValve *valve, double extra) {
  return valve->ports ? extra
                      : sb_model_seal_pressure(valve->run->model, SB_OUTER, valve->chamber).left;
}

SbSolvedState sb_valve_solved(const SbValve *valve, int direction, double pressure) {
  if (valve->chamber == SB_CHAMBER_OPEN) {
    return (SbSolvedState){SB_CHAMBER_OPEN, direction, direction};
  }
  // With ports the state nearest to the chamber's pressure.
  SbChamber chamber = valve->chamber;
  if (valve->ports) {
    chamber = sb_valve_filling(valve->run, pressure) < 0.5 ? SB_CHAMBER_AT_REST : SB_CHAMBER_CLOSED;
  }
  return (SbSolvedState){chamber, direction, sb_valve_passing(chamber)};
}

// Greatest pressure on what the land still carries of an elliptic contact: while the middle is on
// the land its own, then that at the edge.
static double peak_on(double peak, double share) {
  double c = 1 - 2 * (1 - share);
  return share > 0.5 ? peak : share > 0 ? peak * sqrt(fmax(1 - c * c, 0)) : 0;
}

// Fills films, real contact and friction of a frame from the state of the seal; `on`: the fractions
// on the land; `moving` in `direction`, else at rest. `out` has the friction of the motion.
static void fill_film(SbSealFrame *out, const SbModel *model, const SbSealState *state,
                      const SbLandShare *on, bool moving, int direction) {
  // At rest the surfaces meet; off the land there is no film.
  out->friction_boundary = out->friction;
  if (!state->touches || !(on->width > 0)) {
    out->film_min = out->film_central = out->lambda = out->real_area_share = NAN;
  } else if (moving) {
    out->film_min = state->film_min;
    out->film_central = state->film_central;
    out->lambda = state->lambda;
    out->real_area_share = state->real_area_share;
    const double way = direction == SB_CYCLE_IN ? 1 : -1;
    out->friction_viscous = way * on->width * state->friction_viscous;
    out->friction_boundary =
        way * (on->width * state->boundary_area + on->load * state->boundary_load);
    if (model->stribeck_speed > 0 || !(way * out->friction > 0)) {
      // Stribeck's factor acts on the boundary part; a patch may slide in the other direction.
      out->friction_boundary = out->friction - out->friction_viscous;
    }
    out->friction = out->friction_boundary + out->friction_viscous;
  } else {
    out->real_area_share = state->rest_area_share;
  }
}

// Contact, load, film and friction of one seal, all of one state.
static void fill_seal(SbSealFrame *out, SbRun *run, int seal, const SbInstant *at) {
  const SbDynamicsSample *sample = &at->sample;
  const SbModel *model = run->model;
  const SbChamber chamber = at->solved.chamber;
  const int direction = at->solved.direction;
  const bool moving = at->moving && sample->contact[seal] != SB_CONTACT_STUCK;
  const bool mixed = model->pressure_map == SB_MAP_PORTS && at->chamber != SB_CHAMBER_OPEN;
  const double filled = sb_valve_filling(run, at->pressure), s = sample->position;
  // Where a quasi-static stem jumps its speed is not known.
  const bool balanced = sb_valve_type(model)->drive_friction && !sb_motion_kind(model)->inertia;
  const bool own = moving && sample->speed != 0 && run->plan.frame_films && !balanced;
  const double speed = own ? sample->speed : run->speed;
  SbSealState state;
  SbLandShare on = sb_cycle_land_share(&run->cycle, seal, chamber, at->solved.land, s);
  if (mixed) {
    sb_run_state_between(&state, run, seal, filled, direction, speed);
    const SbLandShare vented = sb_valve_land_share(&run->cycle, seal, SB_CHAMBER_AT_REST, s);
    const SbLandShare full = sb_valve_land_share(&run->cycle, seal, SB_CHAMBER_CLOSED, s);
    on.width = (1 - filled) * vented.width + filled * full.width;
    on.load = (1 - filled) * vented.load + filled * full.load;
  } else {
    sb_run_state_at(&state, run, seal, chamber, direction, speed);
    // At rest a solved ring is not dragged by friction; other models have one contact.
    const SbSealState *still = &run->cycle.state[seal][chamber][SB_RUN_REST];
    state = run->plan.ring && !moving && still->load > 0 ? *still : state;
  }
  const int motion = moving ? direction : SB_RUN_REST;
  const SbSealPressure pressure = sb_model_seal_pressure(model, seal, chamber);
  const bool edged = seal == SB_INNER && on.width < 1 && run->plan.section_fields;
  const uint32_t over = edged ? sb_run_shape_over_edge(run, direction, s) : UINT32_MAX;
  const uint32_t drawn = over != UINT32_MAX ? over : sb_run_shape_index(run, seal, chamber, motion);
  const SbSealShape *shape = sb_run_shape(run, over);
  const double width = state.contact_right - state.contact_left;
  // The edge takes the contact away from the canister side.
  *out = (SbSealFrame){
      .land_fraction = (float)on.width,
      .pressure_left = (float)pressure.left,
      .pressure_right = (float)pressure.right,
      .profile = run->plan.profiles && state.touches
                     ? sb_run_profile_slot(seal, (int)chamber, motion)
                     : UINT32_MAX,
      .shape = drawn,
      .contact_left = shape != NULL  ? shape->contact_left
                      : on.width < 1 ? state.contact_right - on.width * width
                                     : state.contact_left,
      .contact_right = shape != NULL ? shape->contact_right : state.contact_right,
      .load = on.load * state.load,
      .pressure_peak = peak_on(state.pressure_peak, on.width),
      .friction = -sample->friction[seal],
  };
  if (model->pressure_map == SB_MAP_PORTS) {
    *(seal == SB_INNER ? &out->pressure_right : &out->pressure_left) = (float)at->pressure;
  }
  fill_film(out, model, &state, &on, moving, direction);
}

void sb_run_frame_film(SbFrame *frame, SbRun *run, int seal, const SbFilm *film, bool fitted) {
  SbSealFrame *out = &frame->seal[seal];
  const int direction = frame->velocity < 0 ? SB_CYCLE_OUT : SB_CYCLE_IN;
  const double speed = frame->velocity != 0 ? frame->velocity : run->speed;
  // A stem at rest, or a patch that sticks, has the friction that holds it.
  const bool slides = out->friction_viscous > 0 || out->friction_viscous < 0;
  SbSealState state;
  sb_run_state_at(&state, run, seal, frame->chamber, direction, speed);
  sb_run_set_film(&state, run, seal, frame->chamber, direction, speed, film, fitted);
  out->film_min = film->film_min;
  out->film_central = film->film_central;
  out->lambda = state.lambda;
  out->real_area_share = state.real_area_share;
  if (slides) {
    const double way = direction == SB_CYCLE_IN ? 1 : -1;
    out->friction_viscous = way * state.friction_viscous;
    out->friction_boundary = way * (state.boundary_area + state.boundary_load);
    out->friction = out->friction_boundary + out->friction_viscous;
  }
}

void sb_run_fill_frame(SbFrame *out, SbRun *run, const SbInstant *at) {
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
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    fill_seal(&out->seal[seal], run, seal, at);
  }
}

SbStatus sb_run_fail_at(SbReport *report, SbStatus status, const SbRunPlace *place,
                        const SbReport *cause) {
  return sb_fail_input(report, status, cause->input,
                       "%s, stage %s, %s at %.4g mm, %.4g s: %s; available: %s", place->solver,
                       sb_stage_name(place->stage), place->mover, 1e3 * place->position,
                       place->time, cause->text, place->available);
}
