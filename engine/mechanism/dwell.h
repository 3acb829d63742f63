// Static friction of a contact as a function of its time at rest (dwell), tabulated piecewise
// linear in the logarithm of time, as dynamics.h requires. The law is increasing; its value is a
// force or a factor of the sliding friction, as the user of the table chooses. The functions have
// no state and may be called concurrently.
#pragma once

#include <stddef.h>

// Largest number of pieces.
enum { SB_DWELL_PIECES = 64 };

// A piece: value + gain ln(1 + (t - from)/time) from the dwell t = `from` to that of the next
// piece.
typedef struct {
  double from, time;  // [s]; time > 0
  double value, gain; // value at `from`, and increase; unit of the law; gain >= 0
} SbDwellPiece;

// A tabulated law. Pieces in increasing order; the first begins at 0.
typedef struct {
  size_t count; // > 0
  SbDwellPiece piece[SB_DWELL_PIECES];
} SbDwellLaw;

// Tabulates the non-decreasing, positive function `law` of the dwell [s], with its `context`.
// `first` and `last` [s] are the shortest and the longest dwell of interest, 0 < first <= last:
// pieces between 1e-3 first and 1e6 last are halved until their error is below 1e-4 of the value or
// all pieces are used. In the last piece the law continues linearly in ln(t).
void sb_dwell_table(SbDwellLaw *out, double (*law)(double dwell, const void *context),
                    const void *context, double first, double last);

// Returns the piece that contains the `dwell` [s] >= 0, borrowed from `law`, and writes the dwell
// at which the piece ends to *until (INFINITY for the last one).
const SbDwellPiece *sb_dwell_piece(double *until, const SbDwellLaw *law, double dwell);

// Returns the value of the law at `dwell` [s].
double sb_dwell_at(const SbDwellLaw *law, double dwell);
