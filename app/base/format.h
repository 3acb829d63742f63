// Numbers as a person reads them: magnitude, digits, unit; the same in every locale.
//
// Three significant digits, or as many as the error estimate supports up to four (the rounding rule
// is that of sb_format_decimals()); true minus, thin space in thousands, always the unit, zero as
// "0". Figures of a run have a module of their own, figure_text.h.
#pragma once

#include <stddef.h>

typedef enum {
  SB_QUANTITY_NUMBER,   // no unit
  SB_QUANTITY_FORCE,    // N
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

// Unit in which people read `value` [SI] of a quantity: "nm" or "µm" by its size. Borrowed.
const char *sb_quantity_unit(SbQuantity quantity, double value);

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

// As sb_format_text() for a given value rather than a computed one: no trailing zeros.
char *sb_format_given(char *out, SbQuantity quantity, double value);

// A plain number with a fixed number of decimals, true minus and thin-space thousands; "0" for
// zero.
char *sb_format_fixed(char *out, double value, int decimals);

// A plain number with `digits` significant digits.
char *sb_format_digits(char *out, double value, int digits);

// Returns the number of decimals with which a value displayed as `shown` is printed: the rounding
// rule of the whole program. P is the decimal place of the first significant digit of the error, or
// the next finer place if that digit is 1 or 2. The value is rounded at P, or at its `digits`-th
// significant digit if that place is coarser (25.826 +- 0.775 is 25.8, 6.686 +- 0.201 is 6.69).
// `relative_error` 0 or NaN: no error, `digits` alone decides. Negative: tens, hundreds, ...
int sb_format_decimals(double shown, int digits, double relative_error);

// Mark of a logarithmic length axis [m]: "1 nm", "100 nm", "10 um".
char *sb_format_film_tick(char *out, double length);

// 10 to a whole power, the exponent raised: "10^-3" with superscript digits.
char *sb_format_power(char *out, int exponent);
