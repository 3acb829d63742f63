// Numbers as a person reads them: magnitude, digits, unit; the same in every locale.
//
// Three significant digits (two for forces below 10 N), never more than the relative error
// supports, true minus, thin space in thousands, the unit always, zero as "0".
#pragma once

#include "engine/valve/figures.h"

#include <stddef.h>

typedef enum {
  SB_QUANTITY_NUMBER,   // no unit
  SB_QUANTITY_FORCE,    // N, two digits below 10
  SB_QUANTITY_LENGTH,   // mm
  SB_QUANTITY_FILM,     // nm or um
  SB_QUANTITY_PRESSURE, // MPa
  SB_QUANTITY_ENERGY,   // mJ
  SB_QUANTITY_TIME,     // s
  SB_QUANTITY_SPEED,    // mm/s
  SB_QUANTITY_VOLUME,   // pl, nl or ul
  SB_QUANTITY_FRACTION, // percent
  SB_QUANTITY_COUNT
} SbQuantity;

// The quantity that people read in `unit` ("nm": SB_QUANTITY_FILM); SB_QUANTITY_NUMBER for what is
// none of these.
SbQuantity sb_quantity_of_unit(const char *unit);

enum { SB_FORMAT_MAX = 48 };

// A number and its unit apart, for read-outs that set the unit smaller.
typedef struct {
  char number[SB_FORMAT_MAX];
  char unit[16];
} SbFormatted;

// Splits an SI value. `relative_error` is an estimate of the value's relative error; 0 or NaN when
// there is none. NaN and Inf become an en dash with the unit.
void sb_format(SbFormatted *out, SbQuantity quantity, double value, double relative_error);

// "27.4 N" into `out` (of SB_FORMAT_MAX bytes), which is returned. No break inside.
char *sb_format_text(char *out, SbQuantity quantity, double value, double relative_error);

// A figure of a run (engine/valve/figures.h) in the unit that people read, with no more digits than
// its error estimate supports.
char *sb_format_figure(char *out, const SbSummary *summary, int index);

// As sb_format_text() for a given value rather than a computed one: no trailing zeros.
char *sb_format_given(char *out, SbQuantity quantity, double value);

// A plain number with a fixed number of decimals, true minus and thin-space thousands; "0" for
// zero.
char *sb_format_fixed(char *out, double value, int decimals);

// A plain number with `digits` significant digits.
char *sb_format_digits(char *out, double value, int digits);

// Decimals that a value displayed as `shown` deserves: `digits` significant ones, fewer where
// `relative_error` says that the last of them mean nothing. 0 or more.
int sb_format_decimals(double shown, int digits, double relative_error);

// Mark of a logarithmic length axis [m]: "1 nm", "100 nm", "10 um".
char *sb_format_film_tick(char *out, double length);

// 10 to a whole power, the exponent raised: "10^-3" with superscript digits.
char *sb_format_power(char *out, int exponent);
