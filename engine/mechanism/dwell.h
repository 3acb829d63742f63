// What a contact at rest holds, as a force or over its sliding level, as a function of how long it
// has rested: any law that grows, tabled in pieces that are straight in the logarithm of time, as
// dynamics.h finds its events by.
#pragma once

#include <stddef.h>

enum { SB_DWELL_PIECES = 64 };

// From a rest `from` on: value + gain ln(1 + (t - from)/time).
typedef struct {
  double from, time; // s; time > 0
  double value, gain;
} SbDwellPiece;

typedef struct {
  size_t count; // > 0
  SbDwellPiece piece[SB_DWELL_PIECES];
} SbDwellLaw;

// Tables `law`, which must not fall, where it is not straight in ln(t): pieces between 1e-3 `first`
// and 1e6 `last` [s] are halved where their middle is farthest off until all are used or that is
// below 1e-4 of the value. It goes on straight behind them.
void sb_dwell_table(SbDwellLaw *out, double (*law)(double dwell, const void *context),
                    const void *context, double first, double last);

// The piece that holds after a rest, and until when [s], maybe INFINITY.
const SbDwellPiece *sb_dwell_piece(double *until, const SbDwellLaw *law, double dwell);

// The law after a rest [s].
double sb_dwell_at(const SbDwellLaw *law, double dwell);
