// The shelf's figures of a run, and why some are missing. Computed on request.
#include "engine/valve/figures/figures.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double YEAR = 365 * 86400.0;

// A seal that has the same pressures on both sides passes nothing; it is not computed.
static void idle_seal(SbShelfSeal *out) {
  *out = (SbShelfSeal){NAN, NAN, NAN, NAN, NAN, NAN, SB_LEAK_NOT_COMPUTED};
}

static void fill(SbShelf *out, const SbModel *model, int seal, const SbShelfRest *rest,
                 const SbShelfRates *rates) {
  out->temperature = model->temperature;
  out->lag = rest->lag / sb_shelf_diffusivity(model);
  out->error = rest->error;
  out->pressure_error = rest->pressure_error;
  out->permeation = rates->permeation + rates->plastic;
  out->plastic = sb_shelf_lacks_plastic(model) == NULL ? rates->plastic : NAN;
  out->interface = rates->interface;
  out->loss_per_year = YEAR * (out->permeation + out->interface);
  out->moisture_per_year = YEAR * (rates->moisture + rates->plastic_moisture);
  idle_seal(&out->seal[SB_SEAL_COUNT - 1 - seal]);
  out->seal[seal] = (SbShelfSeal){.conductance = rest->touches ? rest->conductance : NAN,
                                  .permeation = rates->permeation,
                                  .interface = rates->interface,
                                  .sensitivity = rates->sensitivity,
                                  .contact_pressure = rest->contact_pressure,
                                  .moisture = rates->moisture,
                                  .state = rates->state};
}

// Reports inputs of the figures that were not measured on this rubber.
static void warn_typical(SbShelf *out, SbWarnings *warnings, const SbModel *model) {
  for (int i = 0; i < SB_SHELF_SPECIES; i++) {
    char text[SB_TEXT];
    const int id = sb_shelf_typical(text, sizeof text, model, (SbShelfSpecies)i);
    if (id >= 0) {
      out->typical = true;
      sb_warn(warnings, "shelf-typical", sb_input((SbParamId)id), "%s", text);
    }
  }
}

static void give_reasons(SbSummary *summary, const SbModel *model, int seal) {
  const SbShelf *shelf = &summary->shelf;
  const char *const lacks[] = {sb_shelf_lacks_permeability(model), sb_shelf_lacks_water(model),
                               sb_shelf_lacks_interface(model)};
  char name[64];
  sb_text(name, sizeof name, "shelf.seals.%s*", sb_seal_name(SB_SEAL_COUNT - 1 - seal));
  sb_reason(summary, name, "there is no pressure difference across this seal at rest");
  if (shelf->seal[seal].state == SB_LEAK_OPEN) {
    sb_reason(summary, "shelf.*", "the %s seal is open: nothing retains the propellant",
              sb_seal_name(seal));
    return;
  }
  if (sb_shelf_lacks_plastic(model) != NULL) {
    sb_reason(summary, "shelf.plastic_kg_per_s", "%s", sb_shelf_lacks_plastic(model));
  }
  if (isnan(shelf->error)) {
    sb_reason(summary, "solver.error_estimate.permeation",
              "a slab in place of a solved ring (models.fit = ring) has no error of a mesh");
  }
  static const char *const water[] = {"shelf.moisture*", "shelf.seals.outer.moisture*",
                                      "shelf.seals.inner.moisture*"};
  static const char *const contact[] = {"shelf.interface*", "shelf.seals.outer.interface*",
                                        "shelf.seals.inner.interface*"};
  for (int i = 0; i < 3; i++) {
    if (lacks[1] != NULL) {
      sb_reason(summary, water[i], "%s", lacks[1]);
    }
    if (lacks[2] != NULL) {
      sb_reason(summary, contact[i], "%s", lacks[2]);
    }
  }
  for (int i = 0; i < 3; i += 2) {
    if (lacks[i] != NULL) {
      sb_reason(summary, "shelf.*", "%s", lacks[i]);
    }
  }
  sb_reason(summary, "shelf.*", "the loss along the contact is not known");
}

SbStatus sb_run_shelf(SbRun *run, const SbRunHooks *hooks, SbReport *report) {
  SbSummary *summary = &run->summary;
  const SbModel *model = run->model;
  const int seal = sb_shelf_seal(model);
  SbShelfRest rest;
  SbShelfRates rates;
  SbReport own = {0};
  SbStatus status = sb_shelf_rest(&rest, model, seal, sb_work_step, run->work, &own);
  status = sb_work_status(run->work, status, &own);
  if (status == SB_OK) {
    sb_shelf_rates(&rates, model, &rest);
    fill(&summary->shelf, model, seal, &rest, &rates);
    warn_typical(&summary->shelf, &summary->warnings, model);
    if (rest.touches) { // the time lag
      sb_model_warn_fluid(model, SB_P_RUBBER_DIFFUSION, &summary->warnings);
    }
    if (model->shelf.vapour && rates.interface > 0) {
      sb_model_warn_fluid(model, SB_P_FLUID_VAPOUR_VISCOSITY, &summary->warnings);
    }
    if (isnan(rest.error) && rest.touches) {
      sb_warn(&summary->warnings, "shelf-slab", sb_input(SB_P_MODELS_FIT),
              "the ring permeates as a slab of its height and volume: a solved ring (models.fit = "
              "ring) lets some 10 to 30 %% more through");
    }
    if (run->plan.shelf == SB_SHELF_OVER_TIME && rest.touches) {
      status = sb_shelf_history(&summary->shelf, model, seal, &rest, sb_work_step, run->work, &own);
      status = sb_work_status(run->work, status, &own);
      static const char *const sums[] = {"shelf.loss_kg", "shelf.moisture_kg", "shelf.mass_left_kg",
                                         "shelf.doses_left"};
      for (int i = 0; status != SB_OK && i < 4; i++) {
        sb_reason(summary, sums[i], "over time: %s", own.text);
      }
    }
    give_reasons(summary, model, seal);
  } else {
    sb_reason(summary, "shelf.*", "the seal at rest: %s", own.text);
  }
  if (status != SB_OK && report != NULL) {
    *report = own;
  }
  // Quantities for which the model has no state are reasons; a cancel or a solver that did not
  // converge is a status.
  return status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY ||
                 status == SB_ERROR_NOT_CONVERGED
             ? status
             : SB_OK;
}
