// Small dense linear systems.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>

// Solves a x = b in place: `a` is n x n by columns and is lost, b becomes x; false if singular. For
// systems of some dozens of rows, where a threaded library costs more than the work.
SB_CHECKED bool sb_eliminate(double *a, double *b, size_t n);

// Solves a x = b in place by LAPACK: `a` is n x n by rows. `fresh` replaces it by its factors, with
// `pivot` [n]; else it holds those of an earlier call. False if singular.
SB_CHECKED bool sb_factor_solve(double *a, int *pivot, double *b, int n, bool fresh);
