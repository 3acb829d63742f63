// Gas through a narrow slit of height h, length L and great width, over the whole range from free
// flight of the molecules to viscous flow, and what surface tension does in it.
//
//   mass per width = h^2/(v L) int Q(d) dp,  v = sqrt(2 R T/M),  d = p h/(eta v)
//   Q(d) = d/6 + 1.0162 + ln(1 + A(d)/(d + d_L))/sqrt(pi),  A = 0.33 + 1.56 d^0.75/(d^0.75 + 1.885)
//
// d/6 is Poiseuille's flow, 1.0162 the slip at diffuse walls (Cercignani and Albertoni, Phys.
// Fluids 6 (1963) 993), and the logarithm that of the linearised Boltzmann equation between plates
// (Cercignani and Daneri, J. Appl. Phys. 34 (1963) 3509), with a minimum near d = 1; A joins them
// within 2.5 % of that equation's solution (BGK; Fukui and Kaneko, J. Tribology 110 (1988) 253 and
// 112 (1990) 78). Between plates without end the logarithm has no bound; d_L ends it where the
// slit's length does: Q(0) is free flight through the slit, W L/(h sqrt(pi)) with Berman's
// transmission probability W(L/h) (J. Appl. Phys. 36 (1965) 3356), less what it exceeds Clausing's
// equation by (0.5 % in a long slit). A slit shorter than some five
// heights has Q = d/6 + Q(0): its ends are more than its walls.
//
// Isothermal, diffuse reflexion. Leaves out: inertia, the ends of a short slit in viscous flow.
#pragma once

#include <stdbool.h>

typedef struct {
  double height, length; // h, L [m]
  double temperature;    // [K]
  double molar_mass;     // [kg/mol]
  double viscosity;      // of the gas [Pa s]
} SbSlit;

// Probability that a molecule that enters a slit of L/h >= 0 by one end leaves it by the other.
double sb_slit_transmission(double length_over_height);

// Q at the rarefaction d >= 0 for a slit of L/h.
double sb_slit_rate(double rarefaction, double length_over_height);

// Mass flow from the pressure `high` to `low` per width of the slit [kg/(m s)].
double sb_slit_mass_flow(const SbSlit *slit, double high, double low);

// Pressure that drives a liquid through it [Pa], 0 where its surface tension holds it: what the
// pressures differ by and what the meniscus at the dry end draws, 2 gamma cos(theta)/h, which holds
// back where the liquid does not wet (Young and Laplace). Evaporation keeps up.
double sb_slit_liquid_drive(double difference, double tension, double contact_angle, double height);

// Whether a plug of a wetting liquid that has condensed in it stays against a gas.
bool sb_slit_plugged(double difference, double tension, double contact_angle, double height);
