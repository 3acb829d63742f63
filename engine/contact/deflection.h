// Deflections in closed form of the elastic models that the thesis tried before its disc (sections
// 6.3.1 to 6.3.4), so that its figures 6.18 to 6.21 stand beside the disc.
//
// Columns (6.45): the section is independent columns of height d held from the sides, v = p d/M,
//   M = E (1 - nu)/((1 + nu)(1 - 2 nu)). Too stiff near nu = 1/2, and nothing outside the contact.
// Half-space (6.46): under Hertz's pressure p0 sqrt(1 - X^2), X = x/b, the surface is the parabola
//   x^2/2R within the contact and, outside, leaves it by (b^2/2R)(|X| sqrt(X^2 - 1) - arcosh|X|)
//   (Johnson, Contact Mechanics, 1985, section 4.3). Only differences of deflections mean anything.
// Panel (6.55 to 6.66): the integral of -ln|x - x'| over a strip of some width, the coefficients of
//   influence of a uniform mesh.
// Flamant (6.3.4): a line load w on the half-space deflects by -(2 w/(pi E_d)) ln|x/datum|,
//   E_d = E/(1 - nu^2); two opposite ones on a disc, spread as by Hertz, let the middle of each
//   contact approach the centre by (w/(pi E_d)) (2 ln(4 R/b) - 1) (Johnson, 5.58).
//
// Linear, small strains, plane; valid while b is small against R.
#pragma once

// Deflection [m] of a column under a pressure [Pa]; height [m], modulus [Pa], Poisson's ratio below
// 0.5.
double sb_deflection_column(double pressure, double height, double modulus, double poisson_ratio);

// Deflection [m] of the half-space's surface less than in the middle, at x [m] under Hertz's
// pressure of half-width b > 0 [m] by a cylinder of radius R > 0 [m].
double sb_deflection_half_space(double x, double half_width, double radius);

// Influence of a panel of `width` > 0 at a distance from its middle, both over any one length:
// dimensionless, to be multiplied by that length, pressure and 2/(pi E_d).
double sb_deflection_panel(double distance, double width);

// Deflection [m] at x != 0 [m] by a line load [N/m] on the half-space, less than at the datum > 0
// [m].
double sb_deflection_flamant(double x, double load, double datum, double modulus,
                             double poisson_ratio);

// Approach [m] of the middle of a contact and the centre of a disc of radius R between two opposite
// loads [N/m] of half-width b, 0 < b < 4 R [m].
double sb_deflection_disc(double load, double half_width, double radius, double modulus,
                          double poisson_ratio);
