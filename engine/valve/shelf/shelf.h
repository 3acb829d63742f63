// Loss of propellant from a sealed can on the shelf, and uptake of water.
//
// Three parallel paths between canister and ambient: through the rubber of the seal that separates
// them (sb_shelf_seal()), along its contact, and through the plastic of the housing if
// housing.permeation_length is given.
//
// Order of calls: seal = sb_shelf_seal(model); sb_shelf_rest(&rest, model, seal, ...);
// sb_shelf_rates(&rates, model, &rest); then, if rest.touches, sb_shelf_history().
//
//   permeation  P(T) S_g p M,  P = P_r exp(-Q_P/R (1/T - 1/T_r)); p is the absolute pressure of
//               the canister, and the propellant's pressure in the ambient air is 0. S_g [m] is the
//               conductance of the ring at rest (permeation/diffusion.h), or of a slab if
//               models.fit does not solve a ring
//   water       the same inwards, with its own permeability and the relative humidity times the
//               saturation pressure 610.94 exp(17.625 t/(t + 243.04)) Pa, t in degC (Alduchov and
//               Eskridge, J. Appl. Meteorol. 35 (1996) 601; 0.4 % from -40 to 50 degC)
//   contact     flow through the critical constriction of the rough contact at rest
//               (contact/rough/percolation.h); one constriction carries the flow of a square of the
//               contact, as wide as long. Liquid: Poiseuille flow driven by pressure difference and
//               meniscus. Vapour: permeation/slit.h, 0 while a condensed plug blocks it
//
// Over time: storage of the ring (relaxation, swell, network) at the mean kinetic temperature of
// the history (Haynes 1971; 83.144 kJ/mol, ICH Q1A) changes S_g and the contact pressure. Both are
// solved at five times and interpolated linearly in the square root of time. The rates at an
// instant are those of the temperature at that instant. Not modelled: stretch and swell in P and D,
// the time lag (reported), the chamber, inward air, partial pressures of mixtures.
#pragma once

#include "engine/valve/figures/summary.h"

// Species that permeate the rubber.
typedef enum { SB_SHELF_PROPELLANT, SB_SHELF_WATER, SB_SHELF_SPECIES } SbShelfSpecies;

// Returns the species that figure `figure` (index of sb_figure()), one of SB_GROUP_SHELF,
// describes: water for moisture, else propellant.
SbShelfSpecies sb_shelf_species(int figure);

// If the permeability for a species is a typical value of such rubbers, not a measurement on this
// one: returns its SbParamId, and writes a sentence about it to text[size]. Else returns -1 and
// leaves `text` unchanged.
int sb_shelf_typical(char *text, size_t size, const SbModel *model, SbShelfSpecies species);

// A seal at rest after storage, computed by sb_shelf_rest().
typedef struct {
  bool touches;            // the rubber presses on the bore; false: the seal is open
  double conductance;      // S_g: permeation divided by P and the pressure difference [m]
  double lag;              // time lag multiplied by the diffusivity D [m2]
  double error;            // estimated error of `conductance`, relative; NaN: slab, closed form
  double contact_pressure; // mean pressure of the rubber alone [Pa]; NaN if open
  double pressure_error;   // estimated error of `contact_pressure`, relative; NaN if open
  double width;            // contact width [m]; 0 if open
  double modulus;          // E' of rubber on bore, SbSealModel.reduced_modulus [Pa]
} SbShelfRest;

// Flows through the seal and the plastic, computed by sb_shelf_rates(); >= 0. NaN: not computed. If
// SbShelfRest.touches is false, all but plastic_moisture are NaN; else sb_shelf_lacks_...() return
// why.
typedef struct {
  double permeation;       // propellant through the rubber of the seal [kg/s]
  double plastic;          // propellant through the plastic [kg/s]; 0 without this path
  double interface;        // propellant along the contact [kg/s]; 0: closed or plugged channels
  double moisture;         // water through the rubber of the seal, into the can [kg/s]
  double plastic_moisture; // water through the plastic, into the can [kg/s]
  double sensitivity;      // d ln interface/d ln contact pressure [1], < 0; 0 if `interface` is 0
  SbLeakState state;       // of the contact; SB_LEAK_OPEN: `interface` is NaN
} SbShelfRates;

// Returns the seal that separates canister and ambient: SB_OUTER if canister.pressure_map is
// chamber-filled, else SB_INNER.
int sb_shelf_seal(const SbModel *model);

// Returns the conductance S_g [m] of a seal as a slab: its height is the radial space, and its
// width is the section area of the stretched ring divided by this height.
double sb_shelf_slab(const SbModel *model, int seal);

// Computes `seal` at rest, after the storage and under the pressures of the model. `cancel` (NULL:
// never) is called with `data` at each iteration of a solved ring; true ends the function with
// SB_ERROR_CANCELLED. SB_ERROR_NOT_CONVERGED: the ring or its permeation was not solved.
// SB_ERROR_RANGE, SB_ERROR_INPUT: a size is out of the range of the fit model; SB_ERROR_INFEASIBLE:
// the fit has no solution. An open seal is a result.
SbStatus sb_shelf_rest(SbShelfRest *out, const SbModel *model, int seal, bool (*cancel)(void *),
                       void *data, SbReport *report);

// Computes the flows at the model's temperature and pressures. `rest` is the result of
// sb_shelf_rest() for the seal sb_shelf_seal(model).
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

// Returns the diffusivity D of propellant in the rubber at the model's temperature [m2/s], from
// rubber.diffusivity and rubber.diffusion_energy. If they are not given their catalogue defaults
// apply, so the result is never NaN; it is 0 only if 0 is given. SbShelfRest.lag divided by D is
// the time lag [s].
double sb_shelf_diffusivity(const SbModel *model);

// Integrates the flows over the history of shelf.time, and sets point[], points, loss, moisture,
// mass_left and doses_left of *out. No other field is read or changed; the caller sets the
// others from SbShelfRest and SbShelfRates if needed. `seal` is sb_shelf_seal(model), and `now` the
// result of sb_shelf_rest() for the model, with now->touches true. A flow that sb_shelf_rates()
// does not compute makes its sums NaN. `cancel` and `data` as for sb_shelf_rest(). SB_ERROR_RANGE,
// SB_ERROR_INPUT: the model is not defined at a temperature of the history; other errors of
// sb_shelf_rest(). *out is unchanged after an error.
SbStatus sb_shelf_history(SbShelf *out, const SbModel *model, int seal, const SbShelfRest *now,
                          bool (*cancel)(void *), void *data, SbReport *report);
