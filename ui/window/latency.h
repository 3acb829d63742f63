// A probe of the main loop: how long would a key press have waited?
#pragma once

#include <glib.h>

// Starts the probe on the default main context. It costs one wake-up each 5 ms; nothing runs
// without a call.
void sb_latency_start(void);

// Forgets what was measured so far.
void sb_latency_reset(void);

// How late a probe of the main loop was: median, 99th percentile and most, and of the part in which
// the main thread used the processor [ms].
typedef struct {
  guint64 samples;
  double p50, p99, max, own_p99, own_max;
} SbLatency;

void sb_latency_measured(SbLatency *out);

// Writes {"samples", "p50_ms", "p99_ms", "max_ms", "own_p99_ms", "own_max_ms"} to `path`.
gboolean sb_latency_write(const char *path, GError **error);
