// Loss of propellant from a sealed can on the shelf, and uptake of water.
//
// Three parallel paths between canister and ambient: through the rubber of the seal that separates
// them (outer seal if the chamber is full, else inner seal), along its contact, and through the
// plastic of the housing if housing.permeation_length is given.
//
//   permeation  P(T) S_g p M,  P = P_r exp(-Q_P/R (1/T - 1/T_r)), p the propellant's vapour
//               pressure at T, 0 outside; S_g of the ring at rest (permeation/diffusion.h), or of
//               a slab if models.fit does not solve a ring
//   water       the same inwards, with its own permeability and the relative humidity times the
//               saturation pressure 610.94 exp(17.625 t/(t + 243.04)) Pa, t in degC (Alduchov and
//               Eskridge, J. Appl. Meteorol. 35 (1996) 601; 0.4 % from -40 to 50 degC)
//   contact     the critical constriction of the contact at rest (contact/rough/percolation.h), one
//               for each square: liquid by Poiseuille flow driven by pressure difference and
//               meniscus, vapour by permeation/slit.h unless a condensed plug remains
//
// Over time: storage of the ring (relaxation, swell, network) at the mean kinetic temperature of
// the history (Haynes 1971; 83.144 kJ/mol, ICH Q1A) changes S_g and the contact pressure. They are
// solved at five times and interpolated in the square root of time; rates follow the temperature
// without delay. Not modelled: stretch and swell in P and D, the time lag (reported), the chamber,
// inward air, partial pressures of mixtures.
#pragma once

#include "engine/valve/figures/summary.h"

// Number of species for sb_shelf_typical(): propellant (0), water (1).
enum { SB_SHELF_TYPICAL = 2 };

// Returns the key of the value for species `which` that is typical of such rubbers, not measured,
// and writes a sentence to text[size]. Returns NULL, and writes "", if there is none.
const char *sb_shelf_typical(char *text, size_t size, const SbModel *model, int which);

// A seal at rest after storage.
typedef struct {
  bool touches;            // there is contact pressure of the rubber; else the seal is open
  double conductance;      // S_g [m]
  double lag;              // D times the time lag [m2]
  double error;            // relative, of S_g; NaN: closed form
  double contact_pressure; // of the rubber only [Pa]
  double pressure_error;   // relative, of contact_pressure
  double width;            // of the contact [m]
  double modulus;          // E' [Pa]
} SbShelfRest;

// Flows past a seal and through the plastic; NaN: not known.
typedef struct {
  double permeation, plastic, interface; // propellant [kg/s]
  double moisture;                       // water through the seal, inwards [kg/s]
  double plastic_moisture;               // water through the plastic, inwards [kg/s]
  double sensitivity;                    // SbShelfSeal.sensitivity
  SbLeakState state;
} SbShelfRates;

// Returns the seal that separates canister and ambient, SB_OUTER or SB_INNER.
int sb_shelf_seal(const SbModel *model);

// Returns S_g of a seal as a slab with the height of the radial space and the width that its
// stretched volume then has [m].
double sb_shelf_slab(const SbModel *model, int seal);

// Solves a seal at rest under the model's pressures; `cancel` (NULL: never) is called with `data`
// by solved rings. Errors of sb_fit_solve() and sb_diffusion_create().
SbStatus sb_shelf_rest(SbShelfRest *out, const SbModel *model, int seal, bool (*cancel)(void *),
                       void *data, SbReport *report);

// Computes the flows at the model's temperature and pressure.
void sb_shelf_rates(SbShelfRates *out, const SbModel *model, const SbShelfRest *rest);

// Returns why permeation of propellant is not computed; NULL if it is. Static.
const char *sb_shelf_lacks_permeability(const SbModel *model);

// Returns why permeation of water is not computed; NULL if it is. Static.
const char *sb_shelf_lacks_water(const SbModel *model);

// Returns why flow along the contact is not computed; NULL if it is. Static.
const char *sb_shelf_lacks_interface(const SbModel *model);

// Returns why there is no path through the plastic (which then counts as zero); NULL if there is.
// Static.
const char *sb_shelf_lacks_plastic(const SbModel *model);

// Returns D at the model's temperature [m2/s].
double sb_shelf_diffusivity(const SbModel *model);

// Returns the temperature of the history at a time [s] [K].
double sb_shelf_temperature(const SbModel *model, double time);

// Returns the range of temperatures of the history [K].
void sb_shelf_range(double *low, double *high, const SbModel *model);

// Integrates the history into *out, whose rates at the model's state must be set before the call.
// `now` is the seal at the model's state. SB_ERROR_RANGE, SB_ERROR_INPUT: the model is not defined
// at a temperature of the history; else as for sb_shelf_rest().
SbStatus sb_shelf_history(SbShelf *out, const SbModel *model, int seal, const SbShelfRest *now,
                          bool (*cancel)(void *), void *data, SbReport *report);
