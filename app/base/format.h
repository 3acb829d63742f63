// Numbers for the user: magnitude, digits, unit; the same in every locale. Any thread.
//
// Three significant digits, or as many as the error estimate supports up to four (the rounding rule
// is that of sb_format_decimals()); a minus sign, thin spaces between thousands, always the unit,
// zero as "0". Figures of a run have their own module, figure_text.h. Functions that write to `out`
// need SB_FORMAT_MAX bytes and return `out`.
#pragma once

#include <stddef.h>

// A quantity with its display unit.
typedef enum {
  SB_QUANTITY_NUMBER,   // no unit
  SB_QUANTITY_FORCE,    // N
  SB_QUANTITY_LENGTH,   // mm
  SB_QUANTITY_FILM,     // nm or µm
  SB_QUANTITY_PRESSURE, // MPa
  SB_QUANTITY_ENERGY,   // mJ
  SB_QUANTITY_TIME,     // s
  SB_QUANTITY_SPEED,    // mm/s
  SB_QUANTITY_VOLUME,   // pl, nl or µl
  SB_QUANTITY_FRACTION, // %
  SB_QUANTITY_COUNT
} SbQuantity;

// Returns the display unit of `value` [SI] of a quantity, that of a film or volume by its size; ""
// for SB_QUANTITY_NUMBER. Static.
const char *sb_quantity_unit(SbQuantity quantity, double value);

// Size of a buffer for a formatted number [bytes].
enum { SB_FORMAT_MAX = 48 };

// A number and its unit, for displays that draw the unit smaller.
typedef struct {
  char number[SB_FORMAT_MAX];
  char unit[16];
} SbFormatted;

// Writes number and unit of `value` [SI]. `relative_error` is an estimate of its relative error; 0
// or NaN: none. NaN and infinity become an en dash with the unit. A force below 0.5 mN, which is
// rounding noise, is "0".
void sb_format(SbFormatted *out, SbQuantity quantity, double value, double relative_error);

// Writes number and unit with a no-break space, "27.4 N".
char *sb_format_text(char *out, SbQuantity quantity, double value, double relative_error);

// As sb_format_text() without an error, with `digits` significant digits and without trailing
// zeros.
char *sb_format_trimmed(char *out, SbQuantity quantity, double value, int digits);

// As sb_format_trimmed() with six digits, for a value that was given, not computed.
char *sb_format_given(char *out, SbQuantity quantity, double value);

// Writes a number without unit with `decimals` decimals, at most 12; negative: rounded to tens,
// hundreds, ... "0" for zero, an en dash for NaN and infinity.
char *sb_format_fixed(char *out, double value, int decimals);

// As sb_format_fixed(), with `digits` significant digits.
char *sb_format_digits(char *out, double value, int digits);

// Returns the number of decimals with which a value displayed as `shown` is printed: the rounding
// rule of the whole program. P is the decimal place of the first significant digit of the error, or
// the next finer place if that digit is 1 or 2. The value is rounded at P, or at its `digits`-th
// significant digit if that place is coarser (25.826 +- 0.775 is 25.8, 6.686 +- 0.201 is 6.69).
// `relative_error` 0 or NaN: no error, `digits` alone decides. Negative: tens, hundreds, ...
int sb_format_decimals(double shown, int digits, double relative_error);

// Writes the label of a tick of a logarithmic length axis, `length` in m: "1 nm", "100 nm", "10
// µm".
char *sb_format_film_tick(char *out, double length);

// Writes 10 to the power `exponent` with superscript digits.
char *sb_format_power(char *out, int exponent);

// Returns a copy of `text` whose first letter is a capital, as a sentence begins; not if its first
// word has a dot, as keys of parameters and figures have ("cycle.force_peak_N"). Freed by g_free().
char *sb_sentence_case(const char *text);
