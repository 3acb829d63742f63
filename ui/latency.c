// A probe of the main loop: how long would a key press have waited? A source of high priority is
// due every 5 ms; its lateness is how long the loop was busy. While the loop is blocked further
// probes would have become due and waited, so a delay of 100 ms counts as 100, 95, 90, ... ms
// ("coordinated omission" otherwise hides long blocks). Left out: the time that the display server
// and the compositor take.
#include "ui/latency.h"

enum { PERIOD_US = 5000, BIN_US = 100, BINS = 20000 };

static guint32 bins[BINS];
static guint64 samples;
static gint64 longest;
static GSource *source;
static gint64 due;

static void record(gint64 lateness) {
  gint64 bin = MIN(MAX(lateness, 0) / BIN_US, BINS - 1);
  bins[bin]++;
  samples++;
  longest = MAX(longest, lateness);
}

static gboolean dispatch(GSource *self, GSourceFunc callback, gpointer data) {
  gint64 now = g_get_monotonic_time();
  for (gint64 lateness = now - due; lateness >= 0; lateness -= PERIOD_US) {
    record(lateness);
  }
  due = now + PERIOD_US;
  g_source_set_ready_time(self, due);
  return G_SOURCE_CONTINUE;
}

static GSourceFuncs functions = {NULL, NULL, dispatch, NULL, NULL, NULL};

void sb_latency_start(void) {
  if (source != NULL) {
    return;
  }
  source = g_source_new(&functions, sizeof(GSource));
  g_source_set_priority(source, G_PRIORITY_HIGH);
  due = g_get_monotonic_time() + PERIOD_US;
  g_source_set_ready_time(source, due);
  g_source_attach(source, NULL);
}

void sb_latency_reset(void) {
  for (int i = 0; i < BINS; i++) {
    bins[i] = 0;
  }
  samples = 0;
  longest = 0;
}

static double quantile(double share) {
  guint64 wanted = (guint64)((double)samples * share);
  guint64 seen = 0;
  for (int i = 0; i < BINS; i++) {
    seen += bins[i];
    if (seen > wanted) {
      return (i + 1) * BIN_US / 1000.0;
    }
  }
  return (double)longest / 1000.0;
}

gboolean sb_latency_write(const char *path, GError **error) {
  char p50[32], p99[32], max[32];
  g_ascii_formatd(p50, sizeof p50, "%.1f", quantile(0.50));
  g_ascii_formatd(p99, sizeof p99, "%.1f", quantile(0.99));
  g_ascii_formatd(max, sizeof max, "%.1f", (double)longest / 1000.0);
  g_autofree char *text = g_strdup_printf("{ \"samples\": %" G_GUINT64_FORMAT
                                          ", \"p50_ms\": %s, \"p99_ms\": %s, \"max_ms\": %s }\n",
                                          samples, p50, p99, max);
  return g_file_set_contents(path, text, -1, error);
}
