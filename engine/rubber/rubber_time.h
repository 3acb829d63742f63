// Ageing of a rubber ring in storage and its stiffness at the temperature of use. Computes the
// ring's sizes and modulus after storage. The functions have no state and may be called
// concurrently.
//
//   Relaxation   E(t)/E_0 = 1 - sum g_i (1 - exp(-t/(a_T tau_i)))    Prony series, constant strain
//   Shift        log10 a_T = -C1 (T - T_r)/(C2 + T - T_r)             Williams, Landel, Ferry 1955
//                ln a_T = (Q/R)(1/T - 1/T_r)                          Arrhenius
//   Temperature  E = E_0 [1 + beta (T - T_0)] + E_g/(1 + (t/tau)^0.7), T_0 = 20 degC
//                or E = E_0 T/T_0 + ... with `entropic` (Treloar 1975)
//   Network      f = exp(-k t) of the original network remains, k by Arrhenius (Tobolsky);
//                the fraction beta of the broken network reforms without stress in the squeezed
//                shape
//   Set          permanent: beta (1 - f)/(f + beta (1 - f)) of the squeeze; in addition, the strain
//                that the Prony elements have not recovered yet
//   Uptake       M/M_inf = 1 - sum 4/a_n^2 exp(-a_n^2 D t/R^2), J_0(a_n) = 0: Fick, round section
//                (Crank, The Mathematics of Diffusion, 5.23)
//   Swell        volume v = m rho_rubber/rho_fluid (additive), length (1 + v)^(1/3) - 1; modulus
//                (1 + v)^(-1/3) (ideal network) or a given ratio at equilibrium
//   Expansion    sizes x (1 + alpha (T - T_0))
//
// The glass transition term is a Cole-Cole retardation at t = 10 s, as in Gehman's test (ISO 1432),
// with E_g = 1 GPa and tau = 100 s a_T by WLF's universal constants from T_g. The exponent 0.7
// doubles the stiffness of a rubber of 2.5 MPa 20 K above T_g and multiplies it by ten at 13 K,
// typical of nitrile.
//
// The load of a fitted ring follows from the fit models with the sizes and the modulus below. A
// fitted ring has constant strain, so relaxation and network loss multiply the modulus. Storage has
// one temperature; the temperature of use applies afterwards, without a delay. Not modelled:
// swelling stress, slower uptake between walls, concentration-dependent diffusion, desorption,
// oxidation. Constants are the caller's; docs/thesis.md, 15, discusses those of the thesis.
#pragma once

#include "engine/base/status.h"

// Numbers of the inputs of a stored ring, for SbReport.input and SbWarning.input. RING: sizes and
// modulus; NETWORK, SWELL, RELAXATION: the constants of that effect.
enum {
  SB_RUBBER_IN_RING = SB_RUBBER_INPUTS,
  SB_RUBBER_IN_STORAGE_TIME,
  SB_RUBBER_IN_TEMPERATURE,
  SB_RUBBER_IN_USE_TEMPERATURE,
  SB_RUBBER_IN_GLASS_TEMPERATURE,
  SB_RUBBER_IN_MODULUS_SLOPE,
  SB_RUBBER_IN_NETWORK,
  SB_RUBBER_IN_SWELL,
  SB_RUBBER_IN_SWELL_MODULUS,
  SB_RUBBER_IN_RELAXATION,
  SB_RUBBER_IN_END
};

// Largest number of Prony terms.
enum { SB_RUBBER_TERMS = 12 };

// T_0, the temperature at which sizes and moduli are given: 20 degC (ISO 1) [K].
#define SB_SIZES_TEMPERATURE 293.15

// Temperature dependence of the relaxation times.
typedef enum {
  SB_SHIFT_NONE,     // a_T = 1
  SB_SHIFT_WLF,      // wlf_c1, wlf_c2
  SB_SHIFT_ARRHENIUS // relaxation_energy
} SbShift;

// Constants of a rubber. {.reference_temperature = T_r} is a rubber that never changes: a group of
// constants that are 0 switches its effect off.
typedef struct {
  double reference_temperature; // T_r, to which the times and rates below apply [K]
  // Stress relaxation.
  size_t terms;                // Prony terms in use
  double g[SB_RUBBER_TERMS];   // fractions of the initial modulus, sum below 1
  double tau[SB_RUBBER_TERMS]; // relaxation times at T_r [s]
  SbShift shift;
  double wlf_c1, wlf_c2;    // C1 [1], C2 [K]; universal 17.44, 51.6 K if T_r = T_g
  double relaxation_energy; // Q [J/mol]
  // Temperature.
  bool entropic;        // modulus proportional to T; modulus_slope is ignored
  double modulus_slope; // beta, dE/dT divided by E at T_0 [1/K]; 0: constant
  // Range of temperatures in which beta was measured [K]. At a temperature of use outside of this
  // range and outside of the temperatures between it and T_0 there is the warning
  // "modulus-extrapolated", unless beta is 0.
  double slope_from, slope_to;
  double glass_temperature; // T_g [K], below T_0; 0: no glass transition
  double thermal_expansion; // alpha, linear [1/K]
  // Network.
  double network_rate;   // k at T_r [1/s]; 0: the network does not change
  double network_energy; // activation energy of k [J/mol]
  double network_reform; // beta, 0 to 1
  // Swell.
  double swell_mass;       // m, mass of absorbed fluid at equilibrium divided by dry mass; 0: none
  double rubber_density;   // of the dry rubber [kg/m3]
  double fluid_density;    // of the absorbed fluid [kg/m3]
  double diffusion;        // D at T_r [m2/s]; 0: no uptake
  double diffusion_energy; // activation energy of D [J/mol]
  // Modulus at equilibrium divided by the dry modulus, at least 0.05; 0: ideal network.
  double swell_modulus;
} SbRubber;

// The dry, new ring, and its history.
typedef struct {
  double section_diameter, inner_diameter; // sizes of the free ring at T_0 [m]
  double radial_space;                     // space into which the section is squeezed [m]
  double modulus;                          // E at T_0 when new [Pa]
  double storage_time;                     // time in storage, fitted and wetted [s]
  double temperature;                      // temperature of storage [K]
  double use_temperature;                  // temperature of use, after storage [K]
  double recovery_time;                    // time between release and measurement of the set [s]
} SbRubberStorage;

// The ring after storage.
typedef struct {
  double section_diameter, inner_diameter; // free ring, swollen, at the temperature of use [m]
  double modulus;         // E of the fitted ring: relaxed, swollen, at the temperature of use [Pa]
  double shift;           // a_T at the storage temperature
  double stiffening;      // sb_rubber_stiffening()
  double relaxation;      // E(t)/E_0 by the Prony series alone
  double network;         // f
  double compression_set; // set divided by the squeeze, after recovery_time [1]
  double section_after_set; // free section after release and recovery, swollen, at the temperature
                            // of use [m]
  double uptake;            // M/M_inf
  double volume_swell;      // v
  double linear_swell;      // (1 + v)^(1/3) - 1
  double swell_modulus;     // factor of the modulus due to swell
} SbRubberState;

// Computes the ring after storage. Errors:
// SB_ERROR_RANGE: a constant or a condition is out of range (fractions that sum to 1 or more, use
//   below T_g, storage at or below T_r - C2, ...).
// SB_ERROR_INFEASIBLE: less than 1e-6 of the network remains.
// Warnings:
// "modulus-extrapolated": use outside the range of the measured slope.
// "relaxation-extrapolated": storage longer than ten times the longest relaxation time.
// "shift-range": storage more than 100 K from T_r.
// "swell-large": swell above 50 % by volume.
// "glass-near": the glass transition has at least doubled the modulus.
SbStatus sb_rubber_state(SbRubberState *out, const SbRubber *rubber, const SbRubberStorage *storage,
                         SbWarnings *warnings, SbReport *report);

// Returns M/M_inf of a round bar after the dimensionless time D t/R^2 = `fourier`; absolute error
// 2e-7.
double sb_rubber_uptake(double fourier);

// Returns the modulus at the temperature of use `temperature` [K] divided by that at T_0, for a
// rubber with `modulus` [Pa] at T_0. Storage is not considered. `temperature` must not be
// below the glass temperature.
double sb_rubber_stiffening(const SbRubber *rubber, double modulus, double temperature);

// Returns the set of the Prony elements alone, as a fraction of the strain: constant strain for the
// time `hold`, then `recovery` without stress. g[terms] and tau[terms] are those of the series;
// `hold` and `recovery` have the unit of `tau`. terms <= SB_RUBBER_TERMS.
double sb_rubber_viscoelastic_set(const double *g, const double *tau, size_t terms, double hold,
                                  double recovery);
