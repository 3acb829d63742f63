// What a sealed can loses on the shelf, and the water it takes in.
//
// Three paths between canister and open air, side by side: through the rubber of the seal that
// parts the two (and no other has a pressure across it: chamber-filled the outer one, else the
// inner one), along its contact, and through the plastic where housing.permeation_length is given.
//
//   permeation  P(T) S_g p M,  P = P_r exp(-Q_P/R (1/T - 1/T_r)), p the propellant's vapour
//               pressure at T, none outside; S_g of the ring as it lies at rest
//               (permeation/diffusion.h), or of a slab where models.fit solves no ring
//   water       the same inwards with its own permeability and the humidity's share of the
//               saturation pressure 610.94 exp(17.625 t/(t + 243.04)) Pa, t in degC (Alduchov and
//               Eskridge, J. Appl. Meteorol. 35 (1996) 601; 0.4 % from -40 to 50 degC)
//   contact     the critical constriction of the resting contact (contact/rough/percolation.h), one
//               a square; in it the liquid flows by Poiseuille under what the pressures differ by
//               and its meniscus draws or holds back, the vapour by permeation/slit.h unless a
//               condensed plug stays. Both without what the other would add.
//
// Over time: the ring's storage (relaxation, swell, network) at the mean kinetic temperature of the
// history (Haynes 1971; 83.144 kJ/mol, ICH Q1A) changes S_g and the contact's pressure, which are
// solved at five times and straight in the root of time between them; rates follow the temperature
// at once. Left out: stretch and swell in P and D, the time lag (told), what the other side of the
// chamber holds back, air that leaks in, and a mixture's partial pressures.
#pragma once

#include "engine/valve/valve.h"

enum { SB_SHELF_POINTS = 37 };

// Temperatures on the shelf.
typedef enum { SB_SHELF_CONSTANT, SB_SHELF_WAREHOUSE, SB_SHELF_FILE } SbShelfHistory;

// Its parameters; the catalogue says what each is.
typedef struct {
  double permeability_energy, water_permeability, water_permeability_energy; // of the rubber
  double plastic_permeability, plastic_water_permeability, plastic_length;   // of the housing
  double humidity, vapour_viscosity, contact_angle;
  bool vapour; // stands at the seals, else the liquid
  double time; // [s]
  SbShelfHistory history;
  double season, day; // [K]
} SbShelfInput;

// One seal at rest; NaN: not computed, as all of a seal without pressure across it, which passes
// nothing.
typedef struct {
  double conductance;      // S_g [m]
  double permeation;       // [kg/s]
  double interface;        // [kg/s]
  double sensitivity;      // d ln interface/d ln contact pressure [1]
  double contact_pressure; // of the rubber alone, mean [Pa]
  double moisture;         // inwards [kg/s]
  SbLeakState state;
} SbShelfSeal;

// A whole can. Members are figures of figures.def ("shelf...."); NaN: not computed. Without a
// path through the plastic its members are NaN and the sums are the seals'.
typedef struct {
  double temperature, permeation, interface, plastic, loss_per_year, moisture_per_year, lag;
  double loss, moisture, mass_left, doses_left; // after shelf.time
  double error;                                 // of S_g, relative; NaN: closed form
  double pressure_error;                        // of the seal's contact pressure, relative
  SbShelfSeal seal[SB_SEAL_COUNT];
  bool typical;  // rests on a figure that is usual of such rubbers
  size_t points; // of the history; 0: not computed
  struct {
    double time;        // [s]
    double temperature; // mean since the point before [K]
    double permeated, passed, plastic,
        moisture; // sums through rubber, contact, plastic; water [kg]
    double doses;
  } point[SB_SHELF_POINTS];
} SbShelf;

// Says which figure that is not measured, but typical of such rubbers, propellant (0) or water (1)
// rests on; its key, or NULL (and nothing said) where there is none.
enum { SB_SHELF_TYPICAL = 2 };
const char *sb_shelf_typical(char *text, size_t size, const SbModel *model, int which);

// What of it is asked for.
typedef enum { SB_SHELF_NOTHING, SB_SHELF_RATES, SB_SHELF_OVER_TIME } SbShelfDepth;
