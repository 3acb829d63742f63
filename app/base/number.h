// Numbers as text, the same in every locale: the shortest digits that read back to the same double.
#pragma once

#include <stdbool.h>
#include <stddef.h>

enum { SB_NUMBER_SIZE = 40, SB_NUMBER_LENGTH_MAX = 200 };

// Extent of the decimal number that `text` starts with: its length, and where its exponent starts
// (its end if it has none; NULL: not asked). 0 if there is none. Sign, digits, point and exponent
// only: no blanks before it, no hexadecimal, no "nan" or "inf".
size_t sb_number_scan(const char *text, size_t *exponent_at);

// Reads the decimal number that `text` starts with and returns its length. 0, *out untouched, if
// there is none, it is not finite, or it is longer than SB_NUMBER_LENGTH_MAX.
size_t sb_number_read(double *out, const char *text);

// The same for a text that is a number and nothing else.
bool sb_number_parse(double *out, const char *text);

// Writes a finite `value` with the fewest of 1 to 17 significant digits that read back exactly, a
// point as decimal mark and an exponent only where that is shorter to read: 0.00161, 2.5e+06.
// Returns `text`. A value that is not finite becomes "nan", "inf" or "-inf".
char *sb_number_format(char text[SB_NUMBER_SIZE], double value);

// As above, in the decimal notation of value x 10^-shift without rounding in between: 1.61e-3 with
// shift -3 is "1.61". Never more than 17 digits.
char *sb_number_format_shifted(char text[SB_NUMBER_SIZE], double value, int shift);

// Rounds to `digits` significant digits for people ("27.5", "1.72e-09").
char *sb_number_round(char text[SB_NUMBER_SIZE], double value, int digits);
