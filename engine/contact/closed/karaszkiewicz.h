// Karaszkiewicz's closed form for a ring in a rectangular groove, as the thesis uses it.
//
//   eps   = (d - g)/d                                                        squeeze       (5.1)
//   cwl   = d {(2 eps + 0.13) + [0.39/(1 - eps) - (2 eps + 0.13)/2] [1 - exp(-4.6 p/E)]}    (5.2)
//   sigma = (pi/6)(2 eps + 0.13) E + nu/(1 - nu) p                           mean pressure (5.4)
//   w     = sigma cwl           load per length   (5.6 unpressurised, 5.7 pressurised)
//   F     = w pi (ID + d)       load; the thesis' printed second factor pi is a slip
//   peak  = (4/pi) sigma        elliptic (Hertz) profile of that width and load
//
// Regression to experiments of Karaszkiewicz (1979-1990): squeeze 0.07 to 0.25. It leaves out the
// stretch on the stem, the groove walls and the direction of sliding, and at no squeeze it still
// gives a width of 0.13 d, so that below its range the result is only formal.
#pragma once

#include "engine/base/status.h"

typedef struct {
  double section_diameter; // d, free [m]
  double inner_diameter;   // ID, free [m]
  double radial_space;     // g, from the groove floor to the bore [m]
  double modulus;          // E, Young's modulus of the rubber [Pa]
  double poisson_ratio;    // nu [-]
  double pressure;         // p, pressure difference [Pa]; its sign (which side) does not matter
} SbKaraszkiewiczInput;

typedef struct {
  double squeeze;         // eps [-]
  double circumference;   // pi (ID + d) [m]
  double contact_width;   // cwl [m]
  double mean_pressure;   // sigma [Pa]
  double pressure_peak;   // 4/pi sigma [Pa]
  double load_per_length; // w [N/m]
  double load;            // F [N]
  bool touches;           // false: the ring is smaller than its space, width and load are 0
} SbKaraszkiewicz;

// Range of squeeze the regression was made for [-].
#define SB_KARASZKIEWICZ_SQUEEZE_MIN 0.07
#define SB_KARASZKIEWICZ_SQUEEZE_MAX 0.25

// Evaluates eq. 5.1-5.7. A ring that does not touch is no error: load 0 and a warning "no-contact".
// Outside the range of squeeze the warning is "karaszkiewicz-squeeze". Returns SB_ERROR_RANGE with
// the catalogue key for sizes, modulus or ratio that are not physical. `warnings` and `report` may
// be NULL.
SbStatus sb_karaszkiewicz(SbKaraszkiewicz *out, const SbKaraszkiewiczInput *in,
                          SbWarnings *warnings, SbReport *report);
