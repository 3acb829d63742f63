// The fluids of a canister and what lubricates it, at saturation.
//
// Propellants and ethanol: an equation of state in the Helmholtz energy (helmholtz.h) gives
// pressure, densities and enthalpy of vaporisation, a correlation of its own or corresponding
// states the liquid's viscosity (viscosity.h), and
//
//   sigma = sum s_i (1 - T/T_s)^n_i         surface tension (Mulero et al. 2012, 2014)
//
// Silicone oils (polydimethylsiloxane, by grade in mm2/s at 25 degC):
//
//   log10 nu/nu_25 = 763.1/(273 + t) - 2.559, t in degC, from 100 mm2/s and -25 degC up (Shin-Etsu,
//   KF-96); density falling by 0.95e-3/K, surface tension by 0.06 mN/(m.K)
//
// Ethanol as a cosolvent, by mass: pressure by Raoult's law, viscosity by Grunberg and Nissan
// (1949) without interaction, ln eta = sum x_i ln eta_i, ideal volumes. An estimate:
// hydrofluoroalkanes and ethanol deviate from Raoult's law to higher pressures (Gavtash et al.,
// Drug Delivery to the Lungs 26, 2015), so that the pressure lies between the estimate and the
// propellant's own.
//
// Valid at saturation in each fluid's range of temperature; never extrapolated, but for the
// viscosity below `viscosity_min`, of which a warning tells. Left out: the dissolved air of a
// canister that was not evacuated, drug and surfactants.
#pragma once

#include "engine/fluid/viscosity.h"

// Properties: constant, name, unit in JSON's key, SI unit, unit that people read, label, and which
// of a fluid's sources it comes from.
#define SB_FLUID_PROPERTY_LIST(X)                                                                  \
  X(PRESSURE, "pressure_saturation", "_Pa", "Pa", "kPa", "Saturation pressure", EQUATION)          \
  X(LIQUID, "density_liquid", "_kg_per_m3", "kg/m3", "kg/m3", "Density, liquid", EQUATION)         \
  X(VAPOUR, "density_vapour", "_kg_per_m3", "kg/m3", "kg/m3", "Density, vapour", EQUATION)         \
  X(VISCOSITY, "viscosity_liquid", "_Pa_s", "Pa.s", "mPa.s", "Viscosity, liquid", VISCOSITY)       \
  X(TENSION, "surface_tension", "_N_per_m", "N/m", "mN/m", "Surface tension", TENSION)             \
  X(ENTHALPY, "enthalpy_vaporisation", "_J_per_kg", "J/kg", "kJ/kg", "Enthalpy of vaporisation",   \
    EQUATION)                                                                                      \
  X(MASS, "molar_mass", "_kg_per_mol", "kg/mol", "g/mol", "Molar mass", EQUATION)                  \
  X(GWP, "gwp100", "", "1", "", "Global warming potential, 100 years", GWP)

typedef enum {
#define SB_FLUID_PROPERTY_ENUM(id, name, suffix, si, shown, label, origin) SB_FLUID_##id,
  SB_FLUID_PROPERTY_LIST(SB_FLUID_PROPERTY_ENUM)
#undef SB_FLUID_PROPERTY_ENUM
      SB_FLUID_PROPERTY_COUNT
} SbFluidPropertyId;

typedef enum {
  SB_FLUID_FROM_EQUATION,
  SB_FLUID_FROM_VISCOSITY,
  SB_FLUID_FROM_TENSION,
  SB_FLUID_FROM_GWP,
  SB_FLUID_ORIGIN_COUNT
} SbFluidOrigin;

typedef struct {
  const char *name, *key; // "density_liquid", "density_liquid_kg_per_m3"
  const char *label, *si, *shown;
  SbFluidOrigin origin;
} SbFluidProperty;

extern const SbFluidProperty sb_fluid_property[SB_FLUID_PROPERTY_COUNT];

typedef struct {
  const char *name, *label, *help;         // "hfa-134a"
  double temperature_min, temperature_max; // [K]
  double temperature_critical;             // [K], 0: none
  bool propellant;                         // takes ethanol
  double mass;                             // [kg/mol]
  double gwp100;                           // NAN: not listed
  const SbHelmholtz *equation;             // NULL: a silicone oil, or no figures at all
  const SbViscosity *viscosity;
  double viscosity_min;                 // [K] where the correlation begins, 0: with the range
  const SbCorresponding *corresponding; // where viscosity is NULL
  double tension_temperature;           // T_s [K]
  double tension[3][2];                 // s_i [N/m], n_i
  double grade, density, tension_25;    // of a silicone oil at 25 degC [m2/s], [kg/m3], [N/m]
  const char *source[SB_FLUID_ORIGIN_COUNT];
  double uncertainty[SB_FLUID_PROPERTY_COUNT]; // relative; below 0: estimated here; 0: none
} SbFluid;

// All fluids; the first is `custom`, which has no figures.
extern const SbFluid sb_fluids[];
extern const int sb_fluid_count;

// The fluid of a name of `length` bytes, in upper or lower case; NULL if there is none.
const SbFluid *sb_fluid_find(const char *name, size_t length);

typedef struct {
  double value;       // SI; NAN: there is none
  double uncertainty; // relative; NAN: not stated
  const char *source; // of the value, or why there is none
  bool estimated;     // the uncertainty, here rather than by the source
} SbFluidFigure;

typedef struct {
  double temperature; // [K]
  bool estimate;      // with ethanol
  SbFluidFigure figure[SB_FLUID_PROPERTY_COUNT];
} SbFluidState;

// Largest share of ethanol in the mass for which a mixture is estimated.
#define SB_FLUID_ETHANOL_MAX 0.3

// State of a fluid at a temperature [K], with a share `ethanol` of the mass (0: none). `warnings`
// (may be NULL) tells of an estimate with ethanol and of an extrapolated viscosity. SB_ERROR_RANGE
// outside the fluid's range, SB_ERROR_INPUT for `custom` and for ethanol in what is no propellant.
SbStatus sb_fluid_state(SbFluidState *out, SbWarnings *warnings, const SbFluid *fluid,
                        double temperature, double ethanol, SbReport *report);

// Density [kg/m3] of a fluid's vapour at a temperature [K] in its range and an absolute pressure
// [Pa] not above saturation; NAN for one without an equation of state.
double sb_fluid_vapour(const SbFluid *fluid, double temperature, double pressure);
