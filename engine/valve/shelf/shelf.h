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

#include "engine/valve/model/valve.h"

// Number of points of a history.
enum { SB_SHELF_POINTS = 37 };

// Temperature history on the shelf (shelf.history).
typedef enum {
  SB_SHELF_CONSTANT,  // the temperature of the canister
  SB_SHELF_WAREHOUSE, // sines of the year and of the day about it
  SB_SHELF_FILE       // SbModelData.shelf
} SbShelfHistory;

// Parameters of the shelf (groups rubber, housing, fluid and shelf of the catalogue).
// Permeabilities [mol/(m s Pa)]; 0: not given.
typedef struct {
  double permeability_energy;       // Q_P of the rubber's permeability [J/mol]
  double water_permeability;        // of the rubber for water
  double water_permeability_energy; // [J/mol]
  double plastic_permeability, plastic_water_permeability; // of the housing
  double plastic_length;   // area of the wall divided by its thickness [m]; 0: no path
  double humidity;         // relative, of the ambient air
  double vapour_viscosity; // of the propellant [Pa s]
  double contact_angle;    // of the liquid on seal and bore [rad]
  bool vapour;             // the seals are in contact with vapour; else with liquid
  double time;             // on the shelf [s]
  SbShelfHistory history;
  double season, day; // amplitudes of the two sines [K]
} SbShelfInput;

// One seal at rest; NaN: not computed. All values of a seal without pressure difference are NaN; it
// leaks nothing.
typedef struct {
  double conductance;      // S_g [m]
  double permeation;       // [kg/s]
  double interface;        // along the contact [kg/s]
  double sensitivity;      // d ln interface/d ln contact pressure
  double contact_pressure; // mean, of the rubber only [Pa]
  double moisture;         // water inwards [kg/s]
  SbLeakState state;
} SbShelfSeal;

// A can. Without a path through the plastic `plastic` is NaN and the sums are the seals'. NaN: not
// computed.
typedef struct {
  double temperature;                      // of the rates below [K]
  double permeation;                       // propellant through seals and plastic [kg/s]
  double interface;                        // propellant along the contacts [kg/s]
  double plastic;                          // part of `permeation` through the plastic [kg/s]
  double loss_per_year, moisture_per_year; // at these rates [kg per 365 days]
  double lag;                              // time lag of the seal's permeation [s]
  double loss, moisture;                   // propellant lost, water taken up in shelf.time [kg]
  double mass_left, doses_left;            // remaining propellant [kg], complete doses
  double error;                            // relative, of S_g; NaN: closed form
  double pressure_error;                   // relative, of the seal's contact pressure
  SbShelfSeal seal[SB_SEAL_COUNT];
  bool typical;  // a value that is typical of such rubbers was used
  size_t points; // of the history; 0: not computed
  struct {
    double time;        // [s]
    double temperature; // mean since the previous point [K]
    // Sums since the start through rubber, contact, plastic; water taken up [kg].
    double permeated, passed, plastic, moisture;
    double doses; // remaining complete doses
  } point[SB_SHELF_POINTS];
} SbShelf;

// Number of species for sb_shelf_typical(): propellant (0), water (1).
enum { SB_SHELF_TYPICAL = 2 };

// Returns the key of the value for species `which` that is typical of such rubbers, not measured,
// and writes a sentence to text[size]. Returns NULL, and writes "", if there is none.
const char *sb_shelf_typical(char *text, size_t size, const SbModel *model, int which);

// How much of the shelf is computed.
typedef enum {
  SB_SHELF_NOTHING,
  SB_SHELF_RATES,    // rates at the model's temperature
  SB_SHELF_OVER_TIME // and the history
} SbShelfDepth;
