// How storage and temperature change the rubber: stress relaxation, set and swell as functions of
// the time in storage, stiffness and expansion at the temperature of use; each changes the ring's
// sizes and modulus by itself.
//
//   Relaxation   E(t)/E_0 = 1 - sum g_i (1 - exp(-t/(a_T tau_i)))    Prony series, held strain
//   Shift        log10 a_T = -C1 (T - T_r)/(C2 + T - T_r)             Williams, Landel, Ferry 1955
//                ln a_T = (Q/R)(1/T - 1/T_r)                          Arrhenius
//   Temperature  E ~ E_0 [1 + beta (T - T_0)] + E_g/(1 + (t/tau)^0.7), tau = 100 s a_T from the
//                glass temperature by WLF's universal constants: a measured slope beta of filled
//                rubber, or E_0 T/T_0, entropy elasticity, of unfilled gum (Treloar 1975); without
//                either E_0 is constant. The glass transition as Cole and Cole's retardation, held
//                for t = 10 s as in Gehman's test (ISO 1432), with E_g = 1 GPa; 0.7 lets a rubber
//                of 2.5 MPa double its stiffness 20 K above T_g and grow it tenfold at 13 K, as
//                Gehman curves of nitrile typically do. Sizes x (1
//                + alpha (T - T_0)). Sizes and modulus are those at T_0 = 20 degC.
//   Network      f = exp(-k t) of the original is left, k by Arrhenius (Tobolsky, two networks);
//                the share beta of what broke forms anew, unstrained in the squeezed shape
//   Set          of the squeeze, after release: beta (1 - f)/(f + beta (1 - f)) for good; of the
//                rest what the Prony elements have not recovered yet
//   Uptake       M/M_inf = 1 - sum 4/a_n^2 exp(-a_n^2 D t/R^2), J_0(a_n) = 0: Fick, round section
//                (Crank, The Mathematics of Diffusion, 5.23)
//   Swell        volume v = m rho_rubber/rho_fluid (additive), length (1 + v)^(1/3) - 1; modulus
//                (1 + v)^(-1/3) (ideal network) or a given ratio at equilibrium
//
// The load of a fitted ring follows from the fit models with the sizes and the modulus below: the
// remaining network's share and the relaxation multiply the modulus, because a squeeze that is held
// is a constant strain. Time and temperature of storage are constants, that of use follows it at
// once; SI units and kelvin.
// Constants are the caller's: the thesis gives none but table 2.2 (mass after 24 h), and its text's
// 8 % length does not agree with its 17 % mass (docs/thesis.md, 15). Left out: swelling stress and
// slower uptake between walls, diffusion that depends on concentration, desorption, oxidation from
// the surface.
#pragma once

#include "engine/base/status.h"

enum { SB_RUBBER_TERMS = 12 };

// Of sizes and moduli as they are given: 20 degC (ISO 1) [K].
#define SB_SIZES_TEMPERATURE 293.15

typedef enum { SB_SHIFT_NONE, SB_SHIFT_WLF, SB_SHIFT_ARRHENIUS } SbShift;

// The rubber. All zero (but T_r) is a rubber that never changes.
typedef struct {
  double reference_temperature; // T_r of times and rates below [K]
  // Stress relaxation.
  size_t terms;
  double g[SB_RUBBER_TERMS];   // shares of the initial modulus, sum below 1
  double tau[SB_RUBBER_TERMS]; // relaxation times at T_r [s]
  SbShift shift;
  double wlf_c1, wlf_c2;    // [-], [K]; "universal" 17.44, 51.6 K if T_r is the glass temperature
  double relaxation_energy; // Q [J/mol]
  // Temperature.
  bool entropic;               // modulus proportional to T, whatever modulus_slope is
  double modulus_slope;        // beta, change of the modulus over that at T_0 [1/K]; 0: constant
  double slope_from, slope_to; // temperatures of use between which beta was measured [K]
  double glass_temperature;    // T_g [K], 0: none
  double thermal_expansion;    // alpha, linear [1/K]
  // Network.
  double network_rate;   // k at T_r [1/s]
  double network_energy; // [J/mol]
  double network_reform; // beta, 0 to 1
  // Swell.
  double swell_mass;       // mass taken up at equilibrium over dry mass [-]
  double rubber_density;   // dry [kg/m3]
  double fluid_density;    // as absorbed [kg/m3]
  double diffusion;        // D at T_r [m2/s]
  double diffusion_energy; // [J/mol]
  double swell_modulus;    // E_inf/E_dry at equilibrium; 0: ideal network
} SbRubber;

// The dry, new ring and what it goes through.
typedef struct {
  double section_diameter, inner_diameter; // [m]
  double radial_space;                     // it is squeezed into [m]
  double modulus;                          // E at T_0 when new [Pa]
  double storage_time;                     // fitted and wetted [s]
  double temperature;                      // of storage [K]
  double use_temperature;                  // afterwards [K]
  double recovery_time;                    // after release, for the set [s]
} SbRubberStorage;

typedef struct {
  double section_diameter, inner_diameter; // free and swollen, at temperature [m]
  double modulus;           // of the ring as held: relaxed, swollen, at temperature [Pa]
  double shift;             // a_T
  double stiffening;        // factor of the modulus by the temperature of use
  double relaxation;        // E(t)/E_0 by the Prony series alone
  double network;           // f
  double compression_set;   // of the squeeze, after the recovery time [-]
  double section_after_set; // free section after release and recovery [m]
  double uptake;            // M/M_inf
  double volume_swell;      // v
  double linear_swell;      // (1 + v)^(1/3) - 1
  double swell_modulus;     // factor of the modulus by swell
} SbRubberState;

// State after storage. SB_ERROR_RANGE for constants that make no sense (shares that sum to 1 or
// more, a temperature at or below C2 under T_r, use below T_g, ...). Warnings:
// "modulus-extrapolated" beyond the temperatures between which the modulus' slope was measured,
// "relaxation-extrapolated" beyond ten times the longest relaxation time, "shift-range" more than
// 100 K from T_r, "swell-large" above 50 % volume, "glass-near" where the glass transition has
// doubled the modulus.
SbStatus sb_rubber_state(SbRubberState *out, const SbRubber *rubber, const SbRubberStorage *storage,
                         SbWarnings *warnings, SbReport *report);

// M/M_inf of a round bar after the dimensionless time D t/R^2 >= 0; to 2e-7.
double sb_rubber_uptake(double fourier);

// Modulus at a temperature of use [K] divided by that at 20 degC, for a rubber whose modulus is
// `modulus` [Pa] there. Takes no part in storage; below the glass transition it means nothing.
double sb_rubber_stiffening(const SbRubber *rubber, double modulus, double temperature);

// Set of the Prony elements alone, of the held strain, `recovery` after release from `hold` (both
// in the same unit as `tau`): internal strains follow their own relaxation with zero stress.
double sb_rubber_viscoelastic_set(const double *g, const double *tau, size_t terms, double hold,
                                  double recovery);
