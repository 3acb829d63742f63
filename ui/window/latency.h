// Measures how late the main loop is: how long a key press would have waited.
#pragma once

#include <glib.h>

// Starts the measurement in the default main context; later calls do nothing. It wakes the main
// loop every 5 ms. Without this call nothing is measured.
void sb_latency_start(void);

// Discards what was measured so far.
void sb_latency_reset(void);

// The delays since the start or the last reset [ms]. `own` counts only the time in which the main
// thread used the processor.
typedef struct {
  guint64 samples;
  double p50, p99, max;    // median, 99th percentile, largest
  double own_p99, own_max; // 99th percentile, largest
} SbLatency;

// Sets `out` to the delays so far; all 0 without samples.
void sb_latency_measured(SbLatency *out);

// Writes {"samples", "p50_ms", "p99_ms", "max_ms", "own_p99_ms", "own_max_ms"} as JSON to the file
// `path`. Returns FALSE with an error of G_FILE_ERROR.
gboolean sb_latency_write(const char *path, GError **error);
