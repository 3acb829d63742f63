// Closed-form fit models of a ring in its gland (choices of fit.h; solved by sb_fit_solve()), and
// formulas of line contacts. The functions have no state and may be called concurrently.
//
// s = (d - g)/d is the squeeze, d the free section diameter, g the radial space, D = ID + d the
// free mean diameter, E and nu the ring's modulus and Poisson's ratio, w the load per length, F =
// pi D w:
//
// Karaszkiewicz (regression to experiments of 1979-1990, s = 0.07 to 0.25; thesis 5.1-5.7)
//   cwl   = d {(2 s + 0.13) + [0.39/(1 - s) - (2 s + 0.13)/2] [1 - exp(-4.6 p/E)]}    width (5.2)
//   sigma = (pi/6)(2 s + 0.13) E + nu/(1 - nu) p                                 pressure (5.4)
//   w = sigma cwl  (5.6, 5.7; the printed second factor pi of the load is an error)
//   peak 4 sigma/pi; p is the magnitude of the fluid pressure. Without squeeze the width is 0.13 d:
//   a formal result.
// Lindley (1967; thesis section 2.2) and Kuran, Gracie and Metcalfe (1995)
//   F = pi d D E (1.25 s^1.5)                     initial, error 0.7 % at s = 0.15   (2.7)
//   F = pi d D E (1.25 s^1.5 + 50 s^6)            extended, to s = 0.25              (2.8)
//   F = pi^2 b^2 D E/(6 d)                        gives the full width b             (2.9)
//   b = 2.4 s d, 2.5 s d                          simple width (2.11), Kuran's       (2.13)
//   The load is 22 % below finite strain at s = 0.155.
// Green and English (fits to finite elements, 1994; thesis 2.12 and table 2.1)
//   F = pi d D E (a s^b + c s^n),  width by Lindley's 2.9
//   for seven load cases, to s = 0.32; cases between side walls ("restrained") to about 0.1.
//   Lindley's formulas and these assume incompressible rubber.
// Hertz, a disc of radius R between two rigid flats (thesis 6.33 with the factor 8, 6.35; Johnson,
// Contact Mechanics, 5.58, plane strain)
//   b = sqrt(8 w R/(pi E')),  approach = (2 w/(pi E_d)) [2 ln(4 R/b) - 1],  E_d = E/(1 - nu^2)
//   b is the half-width; valid for b << R; the load is 8 % low at s = 0.155.
//
// The pressure profile is Hertz's ellipse with that width and load. d and s are those of the free
// section, or of the stretched section (SbFitProblem.fitted_section). Not modelled: groove walls,
// sliding; fluid pressure except by Karaszkiewicz. Outside the stated ranges the result has a
// warning.
#pragma once

#include "engine/contact/fit.h"

// SbFitProblem.variant of SB_FIT_LINDLEY: equations 2.8; 2.7; 2.8 with width 2.11; 2.8 with width
// 2.13.
typedef enum {
  SB_LINDLEY_EXTENDED,
  SB_LINDLEY_INITIAL,
  SB_LINDLEY_SIMPLE_WIDTH,
  SB_LINDLEY_KURAN,
  SB_LINDLEY_COUNT
} SbLindleyVariant;

// SbFitProblem.variant of SB_FIT_GREEN_ENGLISH: the load cases of their table (direction of
// compression; plane: plane strain; restrained: between side walls).
typedef enum {
  SB_GREEN_ENGLISH_RADIAL,
  SB_GREEN_ENGLISH_PLANE,
  SB_GREEN_ENGLISH_AXIAL_LUBRICATED,
  SB_GREEN_ENGLISH_AXIAL,
  SB_GREEN_ENGLISH_AXIAL_RESTRAINED,
  SB_GREEN_ENGLISH_RADIAL_RESTRAINED,
  SB_GREEN_ENGLISH_PLANE_RESTRAINED,
  SB_GREEN_ENGLISH_COUNT
} SbGreenEnglishRow;

// Returns the reduced modulus E' [Pa] of two bodies with Young's moduli [Pa] and Poisson's ratios
// in plane strain: 2/E' = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b (thesis 5.8). All models use this E';
// the E* of contact textbooks is E'/2. A modulus of 0 or infinity means a rigid body; if both are
// rigid the result is INFINITY.
double sb_reduced_modulus(double modulus_a, double poisson_a, double modulus_b, double poisson_b);

// Returns the half-width [m] of a Hertz line contact with `load_per_length` [N/m], `radius` [m] and
// `reduced_modulus` E' [Pa], both > 0. Returns 0 if the load is not positive.
double sb_hertz_half_width(double load_per_length, double radius, double reduced_modulus);

// Returns the ratio b/R of the half-width to the radius of Hertz's disc between flats. `approach`
// is the approach of the two flats (2 R minus their distance) divided by R, > 0; `stiffness` is 4
// E_d/E', 2 for rigid flats. Returns 1 if b would exceed R.
double sb_hertz_width_of_approach(double approach, double stiffness);

// Returns the interference with the bore [m] of a stretched round ring: the fitted section diameter
// minus the radial space. The section shrinks and is flattened on the groove floor by the hoop
// tension:
//   d (1 - nu e) - delta - g,  e = (D - g)/(ID + d) - 1, D the bore diameter
//   delta = w/(pi E_d) [2 ln(4 R/b) - 1],  w = E e A/((D - g)/2),  A = (pi/4) d^2 (1 - 2 nu e)
// delta is half of Hertz's approach on a rigid floor; b and R are those of the shrunk section. Of
// `problem` only the sizes of ring and gland, modulus and poisson_ratio are used. Negative: the
// ring has no contact with the bore. An estimate for e below about 0.25.
double sb_interference_on_floor(const SbFitProblem *problem);
