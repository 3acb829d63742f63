// A seal at rest, and the flow past it at one temperature; see the header for the equations.
#include "engine/valve/shelf/shelf.h"

#include "engine/contact/rough/percolation.h"
#include "engine/fluid/fluid.h"
#include "engine/permeation/diffusion.h"
#include "engine/permeation/slit.h"
#include "engine/permeation/wetted_ring.h"
#include "engine/valve/figures/figures.h"
#include "engine/valve/model/model.h"

#include <math.h>
#include <stdlib.h>

static const double GAS_CONSTANT = 8.314462618; // J/(mol K)
static const double WATER = 0.018015;           // kg/mol

int sb_shelf_seal(const SbModel *model) {
  return model->pressure_map == SB_MAP_CHAMBER_FILLED ? SB_OUTER : SB_INNER;
}

const char *sb_shelf_lacks_permeability(const SbModel *model) {
  return model->fluid == 0 ? "fluid.name = custom has no vapour pressure and no molar mass"
         : !(sb_fluids[model->fluid].mass > 0) || !sb_fluids[model->fluid].propellant
             ? "fluid.name is not a propellant with a vapour pressure"
         : model->ethanol > 0         ? "a mixture's partial pressure is not known (fluid.ethanol)"
         : !(model->permeability > 0) ? "rubber.permeability is not set, and no rubber with a "
                                        "value for this propellant is chosen"
                                      : NULL;
}

const char *sb_shelf_lacks_water(const SbModel *model) {
  return model->shelf.water_permeability > 0
             ? NULL
             : "rubber.water_permeability is not set, and no rubber with a value is chosen";
}

const char *sb_shelf_lacks_interface(const SbModel *model) {
  return sb_rough_kind(model->surface)->spectrum
             ? NULL
             : "loss along the contact: Greenwood and Tripp's independent asperities are not valid "
               "near full contact (models.surface = persson does)";
}

const char *sb_shelf_lacks_plastic(const SbModel *model) {
  return model->shelf.plastic_length > 0
             ? NULL
             : "no path through the plastic is given (housing.permeation_length)";
}

static double arrhenius(const SbModel *model, double energy) {
  return exp(-energy / GAS_CONSTANT *
             (1 / model->temperature - 1 / model->rubber.reference_temperature));
}

double sb_shelf_diffusivity(const SbModel *model) {
  return model->rubber.diffusion * arrhenius(model, model->rubber.diffusion_energy);
}

// The ring ---------------------------------------------------------------------------------------

static double slab_width(const SbModel *model, int seal) {
  const double d = model->seal[seal].section_fitted;
  const SbSealProfile profile = sb_model_profile(model, seal);
  double area, centroid;
  sb_seal_profile_area(&area, &centroid, &profile, model->seal[seal].section_diameter);
  return area * d * d / model->radial_space;
}

double sb_shelf_slab(const SbModel *model, int seal) {
  const double g = model->radial_space;
  return M_PI * (model->bore_diameter - g) * g / slab_width(model, seal);
}

static void as_slab(SbShelfRest *out, const SbModel *model, int seal) {
  const double width = slab_width(model, seal);
  out->conductance = sb_shelf_slab(model, seal);
  out->lag = width * width / 6;
  out->error = NAN;
}

static SbStatus as_ring(SbShelfRest *out, const SbRing *ring, const SbFit *fit, SbReport *report) {
  SbWettedMesh *section;
  SbDiffusionConverged value;
  SbStatus status = sb_wetted_ring_create(&section, ring, false, report);
  if (status == SB_OK) {
    status = sb_diffusion_converge(&value, section, report);
  }
  sb_wetted_mesh_destroy(section);
  if (status == SB_OK) {
    out->conductance = value.steady.conductance;
    out->lag = value.steady.lag;
    // The contact's ends bound the wetted faces.
    out->error = value.error + 0.5 * fit->solver.error_estimate.contact_width;
  }
  return status;
}

// Rubber's own share of the load, as films have it (sliding_fit.c).
static void take_contact(SbShelfRest *out, const SbFit *fit, double difference) {
  const bool holds_fluid = sb_fit_kind(fit->model)->fluid;
  const double net =
      fit->load_per_length - (holds_fluid ? fabs(difference) * fit->contact_width / 2 : 0);
  out->touches = fit->touches && net > 0;
  out->width = fit->contact_width;
  out->contact_pressure = out->touches ? net / fit->contact_width : NAN;
  // A difference over the width: the errors of its terms add up.
  const double load = fit->load_per_length * fit->solver.error_estimate.load;
  out->pressure_error = out->touches ? (load / net + (fit->load_per_length / net + 1) *
                                                         fit->solver.error_estimate.contact_width)
                                     : NAN;
}

SbStatus sb_shelf_rest(SbShelfRest *out, const SbModel *model, int seal, bool (*cancel)(void *),
                       void *data, SbReport *report) {
  const SbSealPressure side = sb_model_seal_pressure(model, seal, SB_CHAMBER_AT_REST);
  SbFitProblem problem;
  SbRing *ring = NULL;
  SbFit *fit = malloc(sizeof *fit); // large for a stack
  if (fit == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a seal at rest");
  }
  *out = (SbShelfRest){.modulus = model->seal[seal].reduced_modulus, .error = NAN};
  sb_model_fit_problem(&problem, model, seal, side.left - side.right);
  problem.cancel = cancel;
  problem.cancel_data = data;
  problem.kept = &ring;
  SbStatus status = sb_fit_solve(fit, &problem, report);
  if (status == SB_OK) {
    take_contact(out, fit, side.left - side.right);
    if (out->touches && ring != NULL) {
      status = as_ring(out, ring, fit, report);
    } else {
      as_slab(out, model, seal);
    }
  }
  sb_ring_destroy(ring);
  free(fit);
  return status;
}

// The contact ------------------------------------------------------------------------------------

// Mass through the channels at a contact pressure [kg/s], 0 where they are closed; NaN: open.
static double through_channels(const SbModel *model, const SbShelfRest *rest,
                               const SbSpectrum *spectrum, double tension, double contact_pressure,
                               SbLeakState *state) {
  const double high = model->canister_pressure + model->ambient_pressure,
               low = model->ambient_pressure;
  const SbPercolationProblem problem = {.spectrum = spectrum,
                                        .modulus = rest->modulus,
                                        .contact_pressure = contact_pressure,
                                        .viscosity = model->viscosity,
                                        .pressure_drop = 1,
                                        .width = rest->width,
                                        .circumference = model->bore_circumference};
  SbPercolation channel;
  if (sb_percolation_solve(&channel, &problem, NULL) != SB_OK) {
    *state = SB_LEAK_NOT_COMPUTED;
    return NAN;
  }
  *state = !channel.percolates ? SB_LEAK_CLOSED
           : channel.constriction_gap >= SB_PERCOLATION_OPEN_GAP * spectrum->sigma
               ? SB_LEAK_OPEN
               : SB_LEAK_PERCOLATING;
  if (*state != SB_LEAK_PERCOLATING || !(channel.constriction_gap > 0) || !(high > low)) {
    return *state == SB_LEAK_OPEN ? NAN : 0;
  }
  const double gap = channel.constriction_gap, angle = model->shelf.contact_angle;
  if (!model->shelf.vapour) {
    return channel.leak_rate * model->density *
           sb_slit_liquid_drive(high - low, tension, angle, gap);
  }
  const SbSlit slit = {.height = gap,
                       .length = 2 * M_PI / channel.constriction_q,
                       .temperature = model->temperature,
                       .molar_mass = sb_fluids[model->fluid].mass,
                       .viscosity = model->shelf.vapour_viscosity};
  // As wide as long, one a square.
  return sb_slit_plugged(high - low, tension, angle, gap)
             ? 0
             : sb_slit_mass_flow(&slit, high, low) * slit.length * model->bore_circumference /
                   rest->width;
}

static void along_contact(SbShelfRates *out, const SbModel *model, const SbShelfRest *rest) {
  SbSpectrum spectrum;
  SbFluidState fluid;
  double tension = 0;
  if (sb_spectrum_from_asperities(&spectrum, model->sigma, model->sigma_over_beta,
                                  model->gt_product, NULL) != SB_OK) {
    return;
  }
  if (sb_fluid_state(&fluid, NULL, &sb_fluids[model->fluid], model->temperature, 0, NULL) ==
      SB_OK) {
    tension = fluid.figure[SB_FLUID_TENSION].value;
    tension = isnan(tension) ? 0 : tension;
  }
  const double step = 1e-3;
  SbLeakState less;
  out->interface =
      through_channels(model, rest, &spectrum, tension, rest->contact_pressure, &out->state);
  const double beside =
      through_channels(model, rest, &spectrum, tension, rest->contact_pressure * (1 - step), &less);
  out->sensitivity = out->interface == 0 ? 0 : log(out->interface / beside) / -log1p(-step);
}

// Saturation pressure of water [Pa].
static double water_pressure(double temperature) {
  const double t = temperature - 273.15;
  return 610.94 * exp(17.625 * t / (t + 243.04));
}

void sb_shelf_rates(SbShelfRates *out, const SbModel *model, const SbShelfRest *rest) {
  const SbShelfInput *in = &model->shelf;
  *out = (SbShelfRates){NAN, NAN, NAN, NAN, NAN, NAN, SB_LEAK_NOT_COMPUTED};
  const double water = in->humidity * water_pressure(model->temperature) * WATER;
  out->plastic_moisture = in->plastic_water_permeability * in->plastic_length * water;
  if (sb_shelf_lacks_water(model) == NULL) {
    out->moisture = in->water_permeability * arrhenius(model, in->water_permeability_energy) *
                    rest->conductance * water;
  }
  if (!rest->touches) {
    out->moisture = NAN;
    out->state = SB_LEAK_OPEN;
    return;
  }
  const double pressure = model->canister_pressure + model->ambient_pressure;
  const double mass = sb_fluids[model->fluid].mass;
  if (sb_shelf_lacks_permeability(model) == NULL) {
    out->permeation = model->permeability * arrhenius(model, in->permeability_energy) *
                      rest->conductance * pressure * mass;
    out->plastic = in->plastic_permeability * in->plastic_length * pressure * mass;
  }
  if (sb_shelf_lacks_interface(model) == NULL && model->fluid > 0) {
    along_contact(out, model, rest);
  }
}

SbShelfSpecies sb_shelf_species(int figure) {
  static const size_t water[] = {offsetof(SbSummary, shelf.moisture),
                                 offsetof(SbSummary, shelf.moisture_per_year),
                                 offsetof(SbSummary, shelf.seal[SB_OUTER].moisture),
                                 offsetof(SbSummary, shelf.seal[SB_INNER].moisture)};
  for (size_t i = 0; i < sizeof water / sizeof *water; i++) {
    if (sb_figure(figure)->offset == water[i]) {
      return SB_SHELF_WATER;
    }
  }
  return SB_SHELF_PROPELLANT;
}

int sb_shelf_typical(char *text, size_t size, const SbModel *model, SbShelfSpecies species) {
  static const struct {
    SbParamId id;
    const char *what;
  } figures[SB_SHELF_SPECIES] = {{SB_P_RUBBER_PERMEABILITY, "loss by permeation"},
                                 {SB_P_RUBBER_WATER_PERMEABILITY, "moisture"}};
  SbParamDefault from;
  if (!sb_model_default(&from, model, figures[species].id) || !from.typical) {
    return -1;
  }
  sb_text(text, size, "the %s depends on a typical value of %s, not on a measurement: %s",
          figures[species].what, from.name != NULL ? from.name : "such rubbers", from.source);
  return (int)figures[species].id;
}
