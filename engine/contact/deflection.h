// Closed-form deflections of the elastic models that the thesis compared with its disc (sections
// 6.3.1 to 6.3.4, figures 6.18 to 6.21). Linear, plane, small strains; valid for b << R. The
// functions have no state and may be called concurrently.
//
// Columns (6.45): independent laterally constrained columns of height d, v = p d/M,
//   M = E (1 - nu)/((1 + nu)(1 - 2 nu)). Too stiff near nu = 1/2; no deflection outside contact.
// Half-space (6.46): under Hertz's pressure p0 sqrt(1 - X^2), X = x/b, the deflection is
//   less than at x = 0 by x^2/2R in the contact, and outside of it by
//   x^2/2R - (b^2/2R)(|X| sqrt(X^2 - 1) - arcosh|X|), which grows as ln|x| far from it (Johnson,
//   Contact Mechanics, 1985, section 4.3). Only differences of deflections are defined.
// Panel (6.55 to 6.66): integral of -ln|x - x'| over a strip: influence coefficient of a uniform
//   mesh.
// Flamant (6.3.4): a line load w on the half-space deflects it by -(2 w/(pi E_d)) ln|x/datum|,
//   E_d = E/(1 - nu^2). Two opposite loads on a disc, distributed as Hertz's, move the middle of
//   each contact towards the centre by (w/(pi E_d)) (2 ln(4 R/b) - 1) (Johnson, 5.58).
#pragma once

// Returns the deflection [m] of a column under `pressure` [Pa]. `height` [m], `modulus` E [Pa],
// `poisson_ratio` < 0.5.
double sb_deflection_column(double pressure, double height, double modulus, double poisson_ratio);

// Returns the deflection at x = 0 minus that at x [m], both positive into the half-space, of a
// half-space under Hertz's pressure of `half_width` b > 0 [m] by a cylinder of `radius` R > 0 [m].
double sb_deflection_half_space(double x, double half_width, double radius);

// Returns the influence coefficient of a panel of `width` > 0 at `distance` from its middle, both
// divided by a reference length of the caller's choice. Multiply it by the reference length, the
// pressure and 2/(pi E_d) for the deflection.
double sb_deflection_panel(double distance, double width);

// Returns the deflection at x != 0 minus that at `datum` > 0 [m], positive into the half-space,
// under the line `load` w [N/m] at x = 0. `modulus` is E [Pa].
double sb_deflection_flamant(double x, double load, double datum, double modulus,
                             double poisson_ratio);

// Returns the approach [m] of the middle of a contact to the centre of a disc of `radius` R [m]
// between two opposite loads `load` [N/m] with `half_width` b, 0 < b < 4 R [m]. `modulus` is E
// [Pa].
double sb_deflection_disc(double load, double half_width, double radius, double modulus,
                          double poisson_ratio);
