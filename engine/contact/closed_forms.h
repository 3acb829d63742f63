// Closed forms of a ring squeezed in its gland, of a line contact and of two bodies' modulus.
//
// With s = (d - g)/d the squeeze, d the free section, g the radial space, D = ID + d the free mean
// diameter, E and nu the ring's modulus and Poisson's ratio, w the load per length and F = pi D w:
//
// Karaszkiewicz (regression to experiments of 1979-1990, s = 0.07 to 0.25; thesis 5.1-5.7)
//   cwl   = d {(2 s + 0.13) + [0.39/(1 - s) - (2 s + 0.13)/2] [1 - exp(-4.6 p/E)]}    width (5.2)
//   sigma = (pi/6)(2 s + 0.13) E + nu/(1 - nu) p                                 pressure (5.4)
//   w = sigma cwl  (5.6, 5.7; the printed second factor pi of the load is a slip), peak 4/pi sigma
//   p is the fluid's pressure, its side does not matter. At no squeeze it still gives a width of
//   0.13 d: below its range the result is only formal.
// Lindley (1967; thesis section 2.2) and Kuran, Gracie and Metcalfe (1995)
//   F = pi d D E (1.25 s^1.5)                     initial, 0.7 % off at s = 0.15     (2.7)
//   F = pi d D E (1.25 s^1.5 + 50 s^6)            extended, to s = 0.25              (2.8)
//   F = pi^2 b^2 D E/(6 d)                        gives the full width b             (2.9)
//   b = 2.4 s d, 2.5 s d                          simple width (2.11), Kuran's       (2.13)
//   22 % short in load of finite strain at s = 0.155.
// Green and English (fits to finite elements, 1994; thesis 2.12 and table 2.1)
//   F = pi d D E (a s^b + c s^n),  width by Lindley's 2.9
//   for seven cases of loading, to s = 0.32. Between side walls ("restrained") the second term
//   grows so fast, and plane strain was found to agree so poorly beyond about 0.1, that those rows
//   warn there. Lindley's and these are for incompressible rubber.
// Hertz, a disc of radius R between two rigid flats (thesis 6.33 with the factor 8, 6.35; Johnson,
// Contact Mechanics, 5.58, plane strain)
//   b = sqrt(8 w R/(pi E')),  approach = (2 w/(pi E_d)) [2 ln(4 R/b) - 1],  E_d = E/(1 - nu^2)
//   with b the half-width; valid while b is small against R, 8 % low in load at s = 0.155.
//
// The pressure is Hertz's ellipse of width and load. d and s are those of the free section, or of
// the section after stretch (SbFitProblem.fitted_section). All leave out groove walls and sliding,
// all but the first the fluid's pressure.
#pragma once

#include "engine/contact/fit.h"

typedef enum {
  SB_LINDLEY_EXTENDED,
  SB_LINDLEY_INITIAL,
  SB_LINDLEY_SIMPLE_WIDTH,
  SB_LINDLEY_KURAN,
  SB_LINDLEY_COUNT
} SbLindleyVariant;

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

// Reduced modulus E' [Pa] of bodies a and b with Young's moduli [Pa] and Poisson's ratios [-] in
// plane strain: 2/E' = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b (thesis 5.8). It is the E' of every
// model here (film, Hertz, W*, U*); the E* of contact textbooks is E'/2. A modulus that is zero or
// infinite stands for a rigid body; with both rigid the result is infinite.
double sb_reduced_modulus(double modulus_a, double poisson_a, double modulus_b, double poisson_b);

// Half-width [m] of Hertz's line contact under load w [N/m], radius R [m] and reduced modulus E'
// [Pa], all positive; 0 for no load.
double sb_hertz_half_width(double load_per_length, double radius, double reduced_modulus);

// Half-width over radius of Hertz's disc between flats that approach by `approach` > 0 over the
// radius, `stiffness` being 4 E_d/E'; 1 where the contact would be as wide as the disc or wider.
double sb_hertz_width_of_approach(double approach, double stiffness);

// Interference [m], diametral, of a stretched round ring with the bore: its section shrinks, and
// the hoop tension flattens it on the groove floor.
//   d (1 - nu e) - delta - g,  e = (D - g)/(ID + d) - 1
//   delta = w/(pi E_d) [2 ln(4 R/b) - 1],  w = E e A/((D - g)/2),  A = (pi/4) d^2 (1 - 2 nu e)
// delta is half of Hertz's approach above, on a rigid floor, b and R those of the shrunk section.
// Negative: the ring does not reach the bore. An estimate for e below some 0.25: solved rings of
// the thesis' section lose contact at an interference of -0.02 mm to 0 by this formula (test).
double sb_interference_on_floor(const SbFitProblem *problem);
