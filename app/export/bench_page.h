// The bench as a picture: error against time for every solver, and the table behind it.
#pragma once

#include "app/base/unit.h"
#include "engine/valve/answer/bench.h"

#include <stdio.h>

// Draws `count` finished cases into `stream` as a PNG (see sb_still_put() for errors). Cases
// without an error (their solver failed) are rows without figures.
bool sb_bench_put(FILE *stream, const SbBenchCase *cases, size_t count, GError **error);
