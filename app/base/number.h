// Numbers as text, the same in every locale: the shortest digits that read back to the same double.
// Any thread.
#pragma once

#include <stdbool.h>
#include <stddef.h>

// Size of a buffer for a number; longest number that is read [bytes].
enum { SB_NUMBER_SIZE = 40, SB_NUMBER_LENGTH_MAX = 200 };

// Returns the length of the decimal number with which `text` starts, 0 if there is none. Only sign,
// digits, point and exponent: no leading blanks, no hexadecimal, no "nan" or "inf". *exponent_at
// (may be NULL) is the offset of its exponent, or its length if it has none.
size_t sb_number_scan(const char *text, size_t *exponent_at);

// Reads the decimal number with which `text` starts and returns its length. Returns 0, with *out
// not changed, if there is none, it is not finite, or it is longer than SB_NUMBER_LENGTH_MAX.
size_t sb_number_read(double *out, const char *text);

// Reads a text that is a decimal number and nothing else. Returns false, with *out not changed, if
// it is not.
bool sb_number_parse(double *out, const char *text);

// Compares two doubles for qsort(): ascending.
int sb_number_compare(const void *a, const void *b);

// Sorts `value` in place, ascending, and returns the median; not a number if `count` is 0.
double sb_number_median(double *value, size_t count);

// Writes a finite `value` with the fewest of 1 to 17 significant digits that read back exactly, a
// point as decimal mark, and an exponent below 1e-5 and from 1e16 on: 0.00161, 2500000, 2.5e-06.
// Returns `text`. A value that is not finite becomes "nan", "inf" or "-inf".
char *sb_number_format(char text[SB_NUMBER_SIZE], double value);

// As sb_number_format(), in the decimal notation of value x 10^-shift without rounding in
// between: 1.61e-3 with shift -3 is "1.61". Never more than 17 digits.
char *sb_number_format_shifted(char text[SB_NUMBER_SIZE], double value, int shift);

// Writes `value` rounded to `digits` significant digits ("27.5", "1.72e-09") and returns `text`.
char *sb_number_round(char text[SB_NUMBER_SIZE], double value, int digits);
