// Lindley's closed forms for a ring squeezed between flats, and Kuran's width.
//
// With s = x/d the squeeze, d the section, D the mean diameter and E the modulus of the ring:
//   F = pi d D E (1.25 s^1.5)                     initial, small squeeze              (2.7)
//   F = pi d D E (1.25 s^1.5 + 50 s^6)            extended, to 25 % squeeze           (2.8)
//   b = d sqrt((6/pi)(1.25 s^1.5 + 50 s^6))       full width                          (2.10)
//   b = 2.4 x                                     simple width                        (2.11)
//   b = 2.5 x                                     Kuran, Gracie and Metcalfe (1995)   (2.13)
// 2.9, F = pi^2 b^2 D E/(6 d), is 2.8 and 2.10 combined. The pressure is Hertz's ellipse of that
// width and load. Source: Lindley (1967), thesis section 2.2; D is the free mean diameter (it gives
// the checked 4.34 N of the thesis' ring).
//
// The rubber is incompressible and free to move sideways; no stretch, walls or fluid. Loads are
// known to fall increasingly short at large squeeze (22 % against finite strain at 15.5 %).
#pragma once

#include "engine/base/status.h"

// enumerator, name
#define SB_LINDLEY_LIST(X)                                                                         \
  X(SB_LINDLEY_EXTENDED, "extended")                                                               \
  X(SB_LINDLEY_INITIAL, "initial")                                                                 \
  X(SB_LINDLEY_SIMPLE_WIDTH, "simple-width")                                                       \
  X(SB_LINDLEY_KURAN, "kuran")

typedef enum {
#define SB_LINDLEY_ENUM(code, text) code,
  SB_LINDLEY_LIST(SB_LINDLEY_ENUM)
#undef SB_LINDLEY_ENUM
      SB_LINDLEY_COUNT
} SbLindleyVariant;

// Largest squeeze of the extended and of the initial formula [-]; at the latter the left-out term
// is 0.7 % of the load.
#define SB_LINDLEY_SQUEEZE_MAX 0.25
#define SB_LINDLEY_INITIAL_MAX 0.15

typedef struct {
  double load_factor; // F/(pi d D E) [-]
  double width_ratio; // b/d, full width [-]
} SbLindley;

// Evaluates a variant at squeeze s (0 or less: nothing touches, zeros). Warns "lindley-squeeze"
// beyond its range and "incompressible-assumed" if Poisson's ratio is below 0.45.
void sb_lindley(SbLindley *out, SbLindleyVariant variant, double squeeze, double poisson_ratio,
                SbWarnings *warnings);
