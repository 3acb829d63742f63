// Numbers as text, the same in every locale: the shortest digits that read back to the same double.
#pragma once

#include <stdbool.h>
#include <stddef.h>

enum { SB_NUMBER_SIZE = 40 };

// Writes a finite `value` with the fewest of 1 to 17 significant digits that read back exactly, a
// point as decimal mark and an exponent only where that is shorter to read: 0.00161, 2.5e+06.
// Returns `text`. A value that is not finite becomes "nan", "inf" or "-inf".
char *sb_number_format(char text[SB_NUMBER_SIZE], double value);

// As above, in the decimal notation of value x 10^-shift without rounding in between: 1.61e-3 with
// shift -3 is "1.61". Never more than 17 digits.
char *sb_number_format_shifted(char text[SB_NUMBER_SIZE], double value, int shift);

// Rounds to `digits` significant digits for people ("27.5", "1.72e-09").
char *sb_number_round(char text[SB_NUMBER_SIZE], double value, int digits);
