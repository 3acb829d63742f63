// See breakaway.h.
#include "engine/valve/states/breakaway.h"

#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/film/squeeze.h"
#include "engine/valve/states/contact_law.h"

#include <math.h>
#include <stdlib.h>

enum { SLIDING, DRY };

// Data of an ageing contact's law.
typedef struct {
  const SbModel *model;
  double kinetic;          // friction of sliding, viscous part included [N]
  double area[2], load[2]; // tau_0 A and m W [N]
  double squeeze_time;     // as in the header
  SbRoughSurface surface;
  double lambda;   // of the smooth film, while sliding
  double share[2]; // real contact that belongs to the ends of the squeeze
  SbSqueeze squeeze;
} Contact;

// Real contact under a film of the squeeze, over the nominal.
static double share_under(const Contact *c, double film) {
  if (c->squeeze.law == NULL) {
    return sb_rough_area_share(&c->surface,
                               fmin(c->lambda * film / c->squeeze.film, SB_GT_LAMBDA_MAX));
  }
  SbRoughPoint at;
  sb_rough_law_at(&at, c->squeeze.law, sb_rough_law_of_gap(c->squeeze.law, film));
  return at.share;
}

// The squeeze of the state's film, if it has one, and how real contact follows it. `law` is room
// for that of asperities that share the load, or `known` if that is the law of this surface.
static SbStatus squeeze_out(Contact *c, SbRoughLaw *law, int seal, const SbSealState *state,
                            const SbRoughLaw *known, SbReport *report) {
  const SbModel *model = c->model;
  const double width = state->contact_right - state->contact_left;
  const double pressure = state->load_net / width;
  double film = state->film_central;
  if (!(film > 0 && pressure > 0)) {
    return SB_OK;
  }
  const double roughness = film / (state->lambda * model->sigma); // run in, over the model's
  c->surface = sb_model_surface(model, seal, roughness);
  if (law != NULL) {
    SbStatus status = law != known ? sb_rough_law_like(law, &c->surface, known, report) : SB_OK;
    if (status != SB_OK) {
      return status;
    }
    // The mean gap at which asperities have their share of the mean pressure.
    SbRoughPoint at;
    double borne = fmax(state->asperity_share, 1e-12) * pressure;
    sb_rough_law_at(&at, law, sb_rough_law_of_pressure(law, borne));
    film = fmax(film, at.gap);
  }
  sb_squeeze_init(&c->squeeze, film, pressure, width / 2, model->viscosity, law);
  const double rest = c->squeeze.rest;
  c->squeeze_time = film > rest ? sb_squeeze_time(&c->squeeze, (film + rest) / 2) : 0;
  c->share[SLIDING] = share_under(c, film);
  c->share[DRY] = share_under(c, rest);
  return SB_OK;
}

static double aged_friction(double dwell, const void *context) {
  const Contact *c = context;
  double done = 1; // of a film that is not there nothing is to go
  if (c->squeeze_time > 0 && c->share[DRY] > c->share[SLIDING]) {
    double share = share_under(c, sb_squeeze_film(&c->squeeze, dwell));
    done = (share - c->share[SLIDING]) / (c->share[DRY] - c->share[SLIDING]);
  }
  double area = c->area[SLIDING] + done * (c->area[DRY] - c->area[SLIDING]);
  double load = c->load[SLIDING] + done * (c->load[DRY] - c->load[SLIDING]);
  double aged = 1 + c->model->ageing_gain * log1p(dwell / c->model->ageing_time);
  return fmax(area * aged + load, c->kinetic);
}

// Parts of a state on which the squeeze depends, off by a part of their errors.
typedef enum { OFF_FILM, OFF_SHARE, OFF_LOAD, OFF_WIDTH, OFF_COUNT } Off;

static SbSealState off_by(const SbSealState *state, Off part, double times) {
  SbSealState out = *state;
  if (part == OFF_FILM) {                                                     // on the same surface
    const double error = state->central_error > 0 ? state->central_error : 0; // NaN: exact
    const double to = fmax(1 + times * error, 0.01);
    out.film_central *= to;
    out.lambda *= to;
  } else if (part == OFF_SHARE) {
    // Its error includes those of net load and width, which have their own turn.
    const double own = fmax(state->share_error - state->net_error - state->width_error, 0);
    out.asperity_share *= fmax(1 + times * own, 0);
  } else if (part == OFF_LOAD) {
    out.load_net *= fmax(1 + times * state->net_error, 0.01);
  } else {
    const double by = fmax(times * state->width_error, -0.99);
    out.contact_right += by * (state->contact_right - state->contact_left);
  }
  return out;
}

SbStatus sb_breakaway_squeeze_error(double *out, const SbModel *model, int seal,
                                    const SbSealState *state, const SbRoughLaw *known,
                                    SbReport *report) {
  const bool coupled = sb_contact_law(model)->shares;
  SbRoughLaw *law = coupled ? malloc(sizeof *law) : NULL;
  *out = 0;
  if (coupled && law == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the rough contact");
  }
  Contact contact = {.model = model, .squeeze_time = NAN, .lambda = state->lambda};
  SbStatus status = squeeze_out(&contact, law, seal, state, known, report);
  for (int i = 0; i < OFF_COUNT && status == SB_OK && isfinite(contact.squeeze_time); i++) {
    double end[2] = {NAN, NAN};
    for (int k = 0; k < 2 && status == SB_OK; k++) {
      const SbSealState off = off_by(state, (Off)i, k == 0 ? -1 : 1);
      Contact other = {.model = model, .squeeze_time = NAN, .lambda = off.lambda};
      status = squeeze_out(&other, law, seal, &off, law, report);
      end[k] = other.squeeze_time;
    }
    *out += fabs(end[1] - end[0]) / 2;
  }
  *out = contact.squeeze_time > 0 ? *out / contact.squeeze_time : 0;
  free(law);
  return status;
}

// The law of a fixed ratio, which needs no film.
static SbDwellLaw law_of_ratio(const SbModel *model, const SbSealState *state) {
  const double dry = state->rest_area + state->rest_load;
  return (SbDwellLaw){1,
                      {{0, model->dwell_time, model->static_ratio * dry, model->dwell_gain * dry}}};
}

SbStatus sb_breakaway_law(SbDwellLaw *out, double *squeeze_time, const SbModel *model, int seal,
                          const SbSealState *state, const SbRoughLaw *known, SbReport *report) {
  const bool coupled = sb_contact_law(model)->shares;
  const double kinetic = sb_sliding_friction(state);
  Contact contact = {
      .model = model,
      .kinetic = kinetic,
      .area = {state->boundary_area, state->rest_area},
      .load = {state->boundary_load, state->rest_load},
      .squeeze_time = NAN,
      .lambda = state->lambda,
  };
  SbRoughLaw *law = coupled ? malloc(sizeof *law) : NULL;
  if (coupled && law == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the rough contact");
  }
  SbStatus status = squeeze_out(&contact, law, seal, state, known, report);
  *squeeze_time = contact.squeeze_time;
  if (status == SB_OK && model->contact_ageing && kinetic > 0) {
    const double ageing = model->ageing_time;
    const double squeeze = contact.squeeze_time > 0 ? contact.squeeze_time : ageing;
    sb_dwell_table(out, aged_friction, &contact, fmin(squeeze, ageing), fmax(squeeze, ageing));
  } else if (model->contact_ageing) {
    *out = (SbDwellLaw){1, {{0, model->ageing_time, kinetic, 0}}};
  } else {
    *out = law_of_ratio(model, state);
  }
  free(law);
  return status;
}

SbStatus sb_breakaway_after(double *out, const SbModel *model, int seal, const SbSealState *state,
                            double dwell, SbReport *report) {
  double squeeze_time;
  SbDwellLaw law = law_of_ratio(model, state);
  SbStatus status = SB_OK;
  if (!state->touches) {
    *out = 0;
    return SB_OK;
  }
  if (state->section == SB_RING_ROLLS || state->section == SB_RING_JAMS) {
    *out = state->friction_static;
    return SB_OK;
  }
  if (model->contact_ageing) {
    status = sb_breakaway_law(&law, &squeeze_time, model, seal, state, NULL, report);
  }
  *out = sb_dwell_at(&law, dwell);
  return status;
}
