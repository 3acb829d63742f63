// Multifrontal LU factors of a sparse matrix of 2 x 2 node blocks with a symmetric pattern.
//
// Internal to the ring. Symbolic work once per mesh, numeric work without allocation. Pivots are
// those of the diagonal: whoever solves checks the residual.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>

typedef struct SbRingFronts SbRingFronts;

// `row_start` and `column` of the 2 nodes rows, both rows of a node with the same columns, pairs of
// them in any order; `order`: rows in the order of elimination. NULL without memory.
SbRingFronts *sb_ring_fronts_create(int nodes, const int *row_start, const int *column,
                                    const int *order);
void sb_ring_fronts_destroy(SbRingFronts *fronts);

// False where a pivot vanishes.
SB_CHECKED bool sb_ring_fronts_factor(SbRingFronts *fronts, const double *value);

// x = A^-1 x with the last factors.
void sb_ring_fronts_solve(const SbRingFronts *fronts, double *x);
