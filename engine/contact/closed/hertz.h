// Hertz line contact, and a disc pressed between two flats by it.
//
//   b   = sqrt(8 w R/(pi E'))       half-width (thesis 6.33 with the factor corrected from 4 to 8)
//   p_H = 2 w/(pi b) = E' b/(4 R)   peak (6.34, 6.35)
//   p   = p_H sqrt(1 - (x/b)^2)
//
// Approach of two rigid flats with a disc of diameter 2 R between them (Johnson, Contact Mechanics,
// eq. 5.58, plane strain): delta = (2 w/(pi E_d)) [2 ln(4 R/b) - 1] with E_d = E/(1 - nu^2) of the
// disc alone. R is the cylinder's radius, w the load per length.
//
// Valid while b is small against R; at 15 % squeeze it is 8 % low in load against finite strain.
#pragma once

#include "engine/base/status.h"

typedef struct {
  double half_width;      // b [m]
  double pressure_peak;   // p_H [Pa]
  double load_per_length; // w [N/m]
  double approach;        // total approach of the two flats [m]
} SbHertz;

// Contact half-width beyond which "hertz-width" warns, as a fraction of the radius: by then the
// parabola has left the circle by 4 % of the approach.
#define SB_HERTZ_WIDTH_MAX 0.3

// Half-width [m] of a line contact under load w [N/m], radius R [m] and reduced modulus E' [Pa],
// all positive; 0 for no load.
double sb_hertz_half_width(double load_per_length, double radius, double reduced_modulus);

// The same for a given total approach of the flats [m]: 0 or less gives no contact ("no-contact").
// An approach that would make the contact as wide as the disc is SB_ERROR_INFEASIBLE.
SbStatus sb_hertz_from_approach(SbHertz *out, double approach, double radius,
                                double reduced_modulus, double disc_modulus, SbWarnings *warnings,
                                SbReport *report);
