// The results of `sealbench bench` as a picture: a chart of error over time for every solver, above
// a table of the cases.
#pragma once

#include "app/base/unit.h"
#include "engine/valve/answer/bench.h"

#include <stdio.h>

// Draws `count` cases into `stream` as a PNG, 1280 pixels wide. A case whose error estimate is NaN
// (closed form, or its solver failed) is only in the table. Returns false with SB_APP_ERROR_IO if
// it could not be drawn; errors of writing are left in the stream (ferror()).
bool sb_bench_put(FILE *stream, const SbBenchCase *cases, size_t count, GError **error);
