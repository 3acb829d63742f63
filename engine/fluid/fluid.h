// Properties of canister fluids and lubricants at saturation. All pressures are absolute. All
// tables are constant, so the functions may be called concurrently.
//
// Propellants and ethanol: an equation of state (helmholtz.h) gives pressure, densities and
// enthalpy of vaporisation. The liquid's viscosity follows from a correlation or from corresponding
// states (viscosity.h), and the surface tension from
//
//   sigma = sum s_i (1 - T/T_s)^n_i         (Mulero et al. 2012, 2014)
//
// Silicone oils (polydimethylsiloxane, grade = kinematic viscosity at 25 degC):
//
//   log10 nu/nu_25 = 763.1/(273 + t) - 2.559, t in degC, from 100 mm2/s and -25 degC up (Shin-Etsu,
//   KF-96); density decreases by 0.95e-3/K, surface tension by 0.06 mN/(m.K)
//
// Mixtures of a propellant with ethanol, by mass: pressure by Raoult's law, viscosity by Grunberg
// and Nissan (1949) without interaction, ln eta = sum x_i ln eta_i, ideal volumes. This is an
// estimate: hydrofluoroalkanes with ethanol deviate from Raoult's law to higher pressures (Gavtash
// et al., Drug Delivery to the Lungs 26, 2015). The true pressure is between the estimate and the
// saturation pressure of the pure propellant.
//
// Nothing is extrapolated beyond a fluid's range of temperature, except the viscosity below
// `viscosity_min` (with a warning). Not modelled: dissolved air, drug, surfactants.
#pragma once

#include "engine/fluid/viscosity.h"

// Numbers of the inputs of a state, for SbReport.input and SbWarning.input.
enum { SB_FLUID_IN_TEMPERATURE = SB_FLUID_INPUTS, SB_FLUID_IN_NAME, SB_FLUID_IN_END };

// X(constant, name, suffix of the JSON key, SI unit, display unit, label, origin): the properties.
// PRESSURE is the absolute saturation pressure.
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

// Index of a property.
typedef enum {
#define SB_FLUID_PROPERTY_ENUM(id, name, suffix, si, shown, label, origin) SB_FLUID_##id,
  SB_FLUID_PROPERTY_LIST(SB_FLUID_PROPERTY_ENUM)
#undef SB_FLUID_PROPERTY_ENUM
      SB_FLUID_PROPERTY_COUNT
} SbFluidPropertyId;

// Which of a fluid's sources a property comes from.
typedef enum {
  SB_FLUID_FROM_EQUATION,  // the equation of state (or the data sheet of an oil)
  SB_FLUID_FROM_VISCOSITY, // the viscosity correlation
  SB_FLUID_FROM_TENSION,   // the surface tension correlation
  SB_FLUID_FROM_GWP,       // the list of global warming potentials
  SB_FLUID_ORIGIN_COUNT
} SbFluidOrigin;

// Row of the table of properties.
typedef struct {
  const char *name, *key;         // "density_liquid", "density_liquid_kg_per_m3"
  const char *label, *si, *shown; // "Density, liquid"; SI unit; display unit, "" if none
  SbFluidOrigin origin;
} SbFluidProperty;

// The table of properties, by SbFluidPropertyId.
extern const SbFluidProperty sb_fluid_property[SB_FLUID_PROPERTY_COUNT];

// Coefficients of a fluid.
typedef struct {
  const char *name, *label, *help;         // "hfa-134a"; name for the user; one line
  double temperature_min, temperature_max; // range of the properties [K]
  double temperature_critical;             // [K], 0: not given
  bool propellant;                         // may be mixed with ethanol
  double mass;                             // molar mass [kg/mol]
  double gwp100;                           // global warming potential; NAN: not listed
  const SbHelmholtz *equation;             // equation of state; NULL: a silicone oil, or `custom`
  const SbViscosity *viscosity;            // NULL: by `corresponding`, or a silicone oil
  double viscosity_min; // lower end of the viscosity correlation [K]; 0: temperature_min
  const SbCorresponding *corresponding;        // used if `viscosity` is NULL
  double tension_temperature;                  // T_s [K]
  double tension[3][2];                        // terms (s_i [N/m], n_i), unused ones 0
  double grade, density, tension_25;           // silicone oil at 25 degC: nu [m2/s], [kg/m3], [N/m]
  const char *source[SB_FLUID_ORIGIN_COUNT];   // reference of each origin; all NULL for `custom`
  double uncertainty[SB_FLUID_PROPERTY_COUNT]; // relative; negative: our estimate; 0: not stated
} SbFluid;

// All fluids, sb_fluids[sb_fluid_count]. The first is `custom`, which has no properties: the user
// specifies them.
extern const SbFluid sb_fluids[];
// Number of fluids.
extern const int sb_fluid_count;

// Returns the fluid whose name equals the first `length` bytes of `name`, ignoring case; static.
// NULL if there is none.
const SbFluid *sb_fluid_find(const char *name, size_t length);

// A property of a fluid in a state.
typedef struct {
  double value;       // SI; NAN: not available
  double uncertainty; // relative; NAN: not stated
  const char *source; // reference of the value, or the reason why it is not available; static
  bool estimated;     // the uncertainty is our estimate, not that of the source
} SbFluidFigure;

// Properties of a fluid at saturation.
typedef struct {
  double temperature;                            // [K]
  bool estimate;                                 // a mixture with ethanol
  SbFluidFigure figure[SB_FLUID_PROPERTY_COUNT]; // by SbFluidPropertyId
} SbFluidState;

// Largest mass fraction of ethanol in a mixture.
#define SB_FLUID_ETHANOL_MAX 0.3

// Computes the properties at saturation of `fluid` at `temperature` [K], mixed with the mass
// fraction `ethanol` (0: pure). Vapour density, surface tension and enthalpy of a mixture are not
// available. Warnings: "mixture-estimate", "viscosity-extrapolated". SB_ERROR_RANGE: `temperature`
// is outside the range of the fluid, or of the ethanol in it, or `ethanol` is outside 0 to
// SB_FLUID_ETHANOL_MAX. SB_ERROR_INPUT: `fluid` is `custom`, or ethanol with a fluid that is not a
// propellant. SB_ERROR_NOT_CONVERGED: no equilibrium of liquid and vapour was found.
SbStatus sb_fluid_state(SbFluidState *out, SbWarnings *warnings, const SbFluid *fluid,
                        double temperature, double ethanol, SbReport *report);

// Returns the density [kg/m3] of the vapour of the pure `fluid` at `temperature` [K] and the
// absolute `pressure` [Pa]. NAN if the fluid has no equation of state, the temperature is outside
// its range, or the pressure is above saturation.
double sb_fluid_vapour(const SbFluid *fluid, double temperature, double pressure);
