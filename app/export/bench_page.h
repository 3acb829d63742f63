// The bench as a picture: error against time for every solver, and the table behind it.
#pragma once

#include "app/document/unit.h"
#include "engine/bench.h"

// Draws `count` finished cases and writes `path` (.png, .svg, .pdf; see still.h for errors). Cases
// without an error (their solver failed) are rows without figures.
bool sb_bench_still(const SbBenchCase *cases, size_t count, const char *path, GError **error);
