// A probe of the main loop: how long would a key press have waited? A source of high priority is
// due every 5 ms; its lateness is how long the loop was busy. While the loop is blocked further
// probes would have become due and waited, so a delay of 100 ms counts as 100, 95, 90, ... ms
// ("coordinated omission" otherwise hides long blocks). On a machine with more to do than
// processors most of that is waiting for a turn, so the part in which this thread itself used the
// processor is counted too ("own"). Left out: the time that the display server and the compositor
// take.
#include "ui/window/latency.h"

#include <string.h>
#include <time.h>

enum { PERIOD_US = 5000, BIN_US = 100, BINS = 20000 };

typedef struct {
  guint32 bins[BINS];
  guint64 samples;
  gint64 longest; // [us]
} Histogram;

static Histogram all, own;
static GSource *source;
static gint64 due, cpu_before;

// Processor time of this thread [us].
static gint64 cpu_now(void) {
  struct timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return time.tv_sec * G_USEC_PER_SEC + time.tv_nsec / 1000;
}

static void record(Histogram *histogram, gint64 lateness) {
  for (gint64 waited = lateness; waited >= 0; waited -= PERIOD_US) {
    histogram->bins[MIN(waited / BIN_US, BINS - 1)]++;
    histogram->samples++;
  }
  histogram->longest = MAX(histogram->longest, lateness);
}

static gboolean dispatch(GSource *self, GSourceFunc callback, gpointer data) {
  gint64 now = g_get_monotonic_time();
  gint64 cpu = cpu_now();
  gint64 lateness = MAX(now - due, 0);
  record(&all, lateness);
  record(&own, MIN(lateness, cpu - cpu_before));
  due = now + PERIOD_US;
  cpu_before = cpu;
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
  cpu_before = cpu_now();
  g_source_set_ready_time(source, due);
  g_source_attach(source, NULL);
}

void sb_latency_reset(void) {
  memset(&all, 0, sizeof all);
  memset(&own, 0, sizeof own);
}

static double quantile(const Histogram *histogram, double share) {
  guint64 wanted = (guint64)((double)histogram->samples * share);
  guint64 seen = 0;
  for (int i = 0; i < BINS; i++) {
    seen += histogram->bins[i];
    if (seen > wanted) {
      return (i + 1) * BIN_US / 1000.0;
    }
  }
  return (double)histogram->longest / 1000.0;
}

void sb_latency_measured(SbLatency *out) {
  *out = (SbLatency){
      .samples = all.samples,
      .p50 = quantile(&all, 0.50),
      .p99 = quantile(&all, 0.99),
      .max = (double)all.longest / 1000.0,
      .own_p99 = quantile(&own, 0.99),
      .own_max = (double)own.longest / 1000.0,
  };
}

gboolean sb_latency_write(const char *path, GError **error) {
  SbLatency of;
  sb_latency_measured(&of);
  const struct {
    const char *key;
    double value;
  } figures[] = {
      {"samples", (double)of.samples},
      {"p50_ms", of.p50},
      {"p99_ms", of.p99},
      {"max_ms", of.max},
      {"own_p99_ms", of.own_p99},
      {"own_max_ms", of.own_max},
  };
  g_autoptr(GString) text = g_string_new("{ ");
  for (guint i = 0; i < G_N_ELEMENTS(figures); i++) {
    char number[G_ASCII_DTOSTR_BUF_SIZE];
    g_ascii_formatd(number, sizeof number, "%.1f", figures[i].value);
    g_string_append_printf(text, "%s\"%s\": %s", i > 0 ? ", " : "", figures[i].key, number);
  }
  g_string_append(text, " }\n");
  return g_file_set_contents(path, text->str, (gssize)text->len, error);
}
