// Gas flow through a narrow wide slit, from free molecular to viscous flow, and the capillary
// pressure of a liquid in it. The functions have no state and may be called concurrently.
//
//   mass flow per width = h^2/(v L) int_low^high Q(d) dp,  v = sqrt(2 R T/M),  d = p h/(eta v)
//   Q(d) = d/6 + 1.0162 + ln(1 + A(d)/(d + d_L))/sqrt(pi),  A = 0.33 + 1.56 d^0.75/(d^0.75 + 1.885)
//
// Here h is the height and L the length in flow direction, p the absolute pressure. d/6 is
// Poiseuille flow, 1.0162 slip at diffusely reflecting walls (Cercignani and Albertoni, Phys.
// Fluids 6 (1963) 993). The logarithm is that of the linearised Boltzmann equation between plates
// (Cercignani and Daneri, J. Appl. Phys. 34 (1963) 3509). A(d) connects the limits within 2.5 % of
// the BGK solution (Fukui and Kaneko, J. Tribology 110 (1988) 253 and 112 (1990) 78). d_L limits
// the logarithm by the finite length: Q(0) = W L/(h sqrt(pi)) is free molecular flow with Berman's
// transmission probability W(L/h) (J. Appl. Phys. 36 (1965) 3356), reduced by its difference from
// Clausing's equation (up to 0.5 %). If Q(0) <= 1.0162 (L/h below about 5), Q = d/6 + Q(0).
//
// Isothermal. Not modelled: inertia, end effects of a short slit in viscous flow.
#pragma once

#include <stdbool.h>

// A slit and the gas in it.
typedef struct {
  double height, length; // h; L in flow direction [m]
  double temperature;    // T [K]
  double molar_mass;     // M [kg/mol]
  double viscosity;      // eta of the gas [Pa s]
} SbSlit;

// Returns the probability that a molecule which enters one end of a slit with L/h =
// `length_over_height` >= 0 leaves it at the other end.
double sb_slit_transmission(double length_over_height);

// Returns the dimensionless flow rate Q at the inverse Knudsen number d = `rarefaction` >= 0, for a
// slit with L/h = `length_over_height` > 0.
double sb_slit_rate(double rarefaction, double length_over_height);

// Returns the mass flow per width of the slit [kg/(m s)] from the absolute pressure `high` to `low`
// [Pa], 0 <= low <= high.
double sb_slit_mass_flow(const SbSlit *slit, double high, double low);

// Returns the pressure difference that drives a liquid through the slit [Pa], at least 0:
// `difference` (wet side minus dry side) [Pa] plus the capillary pressure 2 tension
// cos(contact_angle)/height of the meniscus at the dry end (Young and Laplace). `tension` is the
// surface tension [N/m], `contact_angle` in rad; above pi/2 the capillary pressure retains the
// liquid. The liquid is assumed to evaporate at the dry end as fast as it arrives.
double sb_slit_liquid_drive(double difference, double tension, double contact_angle, double height);

// Returns whether a plug of condensed liquid stays in the slit: the gas pressure `difference` [Pa]
// (the side of higher gas pressure minus the other one) is below the capillary pressure 2 tension
// cos(contact_angle)/height. `tension` [N/m], `contact_angle` [rad], `height` [m].
bool sb_slit_plugged(double difference, double tension, double contact_angle, double height);
