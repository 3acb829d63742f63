// What the files of the shelf share: a seal at rest, and what passes it at a temperature.
#pragma once

#include "engine/valve/model.h"

// A resting seal after its storage.
typedef struct {
  bool touches;            // and the rubber presses; else it is open
  double conductance;      // S_g [m]
  double lag;              // D times the time lag [m2]
  double error;            // of S_g, relative; NaN: closed form
  double contact_pressure; // of the rubber alone [Pa]
  double pressure_error;   // of that, relative
  double width;            // of the contact [m]
  double modulus;          // E' [Pa]
} SbShelfRest;

// What passes it and the plastic; NaN: not known.
typedef struct {
  double permeation, plastic, interface; // propellant [kg/s]
  double moisture;                       // through the seal, inwards [kg/s]
  double plastic_moisture;               // [kg/s]
  double sensitivity;
  SbLeakState state;
} SbShelfRates;

// The seal that parts canister and open air.
int sb_shelf_seal(const SbModel *model);

// S_g of a seal as a slab [m]: as high as the radial space, as wide as its volume leaves it, which
// stretch has thinned.
double sb_shelf_slab(const SbModel *model, int seal);

// Solves it at rest under the model's pressures; solved rings poll `cancel`. Statuses of
// sb_fit_solve() and sb_diffusion_create().
SbStatus sb_shelf_rest(SbShelfRest *out, const SbModel *model, int seal, bool (*cancel)(void *),
                       void *data, SbReport *report);

// At the model's temperature and pressure.
void sb_shelf_rates(SbShelfRates *out, const SbModel *model, const SbShelfRest *rest);

// Why there is no permeation, no water's, no flow along the contact, no path through the plastic
// (which then counts as none); NULL: there is.
const char *sb_shelf_lacks_permeability(const SbModel *model);
const char *sb_shelf_lacks_water(const SbModel *model);
const char *sb_shelf_lacks_interface(const SbModel *model);
const char *sb_shelf_lacks_plastic(const SbModel *model);

// D at the model's temperature [m2/s].
double sb_shelf_diffusivity(const SbModel *model);

// A temperature of the history at a time [s], and the range in which they lie [K].
double sb_shelf_temperature(const SbModel *model, double time);
void sb_shelf_range(double *low, double *high, const SbModel *model);

// Sums the history into `out`, whose fill in kg is `filled`. `now` is the seal as the model has it.
// SB_ERROR_RANGE or _INPUT: the model has no such temperature; else as sb_shelf_rest().
SbStatus sb_shelf_history(SbShelf *out, const SbModel *model, int seal, const SbShelfRest *now,
                          bool (*cancel)(void *), void *data, SbReport *report);
