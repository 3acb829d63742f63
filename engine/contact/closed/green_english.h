// Green and English's fits to finite-element loads of a compressed ring (thesis eq. 2.12,
// table 2.1).
//
//   F/(pi d D E) = a s^b + c s^n,   s = x/d the squeeze, D the mean diameter
//
// for seven cases of loading. The sources give load only in this form: the width comes from
// Lindley's relation 2.9, F = pi^2 b^2 D E/(6 d), and the pressure is Hertz's ellipse of both.
//
// Validity: their elements went to 32 % squeeze (Green and English 1994, abstract). Between side
// walls ("restrained") the second term grows so fast, and plane strain was found to agree so poorly
// beyond about 10 % (thesis section 2.2), that those rows warn above 10 %. Rubber is
// incompressible; no fluid pressure.
#pragma once

#include "engine/base/status.h"

// enumerator, name, a, b, c, n (table 2.1), largest squeeze
#define SB_GREEN_ENGLISH_LIST(X)                                                                   \
  X(SB_GREEN_ENGLISH_RADIAL, "radial-unrestrained", 1.03792, 1.2871, 7.77994, 3.534, 0.32)         \
  X(SB_GREEN_ENGLISH_PLANE, "plane-strain-unrestrained", 0.97184, 1.29093, 7.1014, 3.55262, 0.32)  \
  X(SB_GREEN_ENGLISH_AXIAL_LUBRICATED, "axial-unrestrained-lubricated", 0.74602, 1.25282, 3.09259, \
    3.38757, 0.32)                                                                                 \
  X(SB_GREEN_ENGLISH_AXIAL, "axial-unrestrained-unlubricated", 0.97275, 1.29292, 6.93373, 3.55385, \
    0.32)                                                                                          \
  X(SB_GREEN_ENGLISH_AXIAL_RESTRAINED, "axial-restrained", 1.63328, 1.38463, 683.984, 5.1869,      \
    0.10)                                                                                          \
  X(SB_GREEN_ENGLISH_RADIAL_RESTRAINED, "radial-restrained", 1.7673, 1.38755, 948.475, 5.32269,    \
    0.10)                                                                                          \
  X(SB_GREEN_ENGLISH_PLANE_RESTRAINED, "plane-strain-restrained", 1.55365, 1.38072, 530.577,       \
    5.13163, 0.10)

typedef enum {
#define SB_GREEN_ENGLISH_ENUM(code, text, a, b, c, n, s_max) code,
  SB_GREEN_ENGLISH_LIST(SB_GREEN_ENGLISH_ENUM)
#undef SB_GREEN_ENGLISH_ENUM
      SB_GREEN_ENGLISH_COUNT
} SbGreenEnglishRow;

typedef struct {
  double load_factor; // F/(pi d D E) [-]
  double width_ratio; // full width over d, by Lindley's 2.9 [-]
} SbGreenEnglish;

// Evaluates a row at squeeze s (0 or less: zeros). Warns "green-english-squeeze" beyond its range
// and "incompressible-assumed" if Poisson's ratio is below 0.45.
void sb_green_english(SbGreenEnglish *out, SbGreenEnglishRow row, double squeeze,
                      double poisson_ratio, SbWarnings *warnings);
