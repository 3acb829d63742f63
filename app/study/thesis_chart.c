// Charts of the thesis' figures: curves over the samples of a grid, over the frames of a run or
// over a contact, and what the thesis prints.
#include "app/study/thesis_private.h"

#include "app/base/unit.h"

#include <math.h>
#include <string.h>

// ---- Runs ----

static bool on_chart_cancelled(void *data) {
  return sb_thesis_stopped(data);
}

// A run that some items draw, by the hash of its model; NULL while it is computed or where it
// failed.
typedef struct {
  SbRun *run;
  bool busy;
} Shared;

struct SbThesisRuns {
  GMutex lock;
  GCond changed;
  GHashTable *runs; // hash -> Shared *
};

static void free_shared(void *data) {
  Shared *shared = data;
  sb_run_destroy(shared->run);
  g_free(shared);
}

SbThesisRuns *sb_thesis_runs_new(void) {
  SbThesisRuns *runs = g_new0(SbThesisRuns, 1);
  g_mutex_init(&runs->lock);
  g_cond_init(&runs->changed);
  runs->runs = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, free_shared);
  return runs;
}

void sb_thesis_runs_free(SbThesisRuns *runs) {
  if (runs != NULL) {
    g_hash_table_unref(runs->runs);
    g_mutex_clear(&runs->lock);
    g_cond_clear(&runs->changed);
    g_free(runs);
  }
}

// Owned by the caller.
static char *hash_of(const SbModel *model) {
  double value[SB_PARAM_COUNT];
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    value[i] = sb_model_value(model, (SbParamId)i);
  }
  return g_compute_checksum_for_data(G_CHECKSUM_SHA256, (const guchar *)value, sizeof value);
}

static SbRun *compute_run(SbThesisWork *work, const SbThesisGrid *grid, const SbModel *model) {
  SbRun *run = NULL;
  SbPlan plan;
  SbReport report = {0};
  const SbRunHooks hooks = {.cancelled = on_chart_cancelled, .data = work, .alone = true};
  sb_plan_make(&plan, model);
  SbStatus status = sb_run_create(&run, model, &plan, &report);
  status = status == SB_OK ? sb_run_execute(run, &hooks, &report) : status;
  if (status != SB_OK) {
    sb_run_destroy(run);
    run = NULL;
    if (status != SB_ERROR_CANCELLED) {
      sb_thesis_add_issue(work, "vary", grid->name, "%s", report.text);
    }
  }
  return run;
}

// The run of a grid's first sample, kept with the runs; NULL, told, where there is none. Borrowed.
static const SbRun *run_of(SbThesisWork *work, const SbThesisGrid *grid) {
  SbThesisRuns *runs = work->runs;
  SbModel *model = sb_thesis_model(work, grid, 0);
  if (model == NULL) {
    return NULL;
  }
  char *hash = hash_of(model);
  g_mutex_lock(&runs->lock);
  Shared *shared = g_hash_table_lookup(runs->runs, hash);
  const bool own = shared == NULL;
  if (own) {
    shared = g_new0(Shared, 1);
    shared->busy = true;
    g_hash_table_insert(runs->runs, hash, shared);
    g_mutex_unlock(&runs->lock);
    SbRun *run = compute_run(work, grid, model);
    g_mutex_lock(&runs->lock);
    shared->run = run;
    shared->busy = false;
    g_cond_broadcast(&runs->changed);
  } else {
    g_free(hash);
  }
  while (shared->busy) {
    g_cond_wait(&runs->changed, &runs->lock);
  }
  g_mutex_unlock(&runs->lock);
  sb_model_destroy(model);
  if (shared->run == NULL && !own && !sb_thesis_stopped(work)) {
    sb_thesis_add_issue(work, "vary", grid->name, "its run failed");
  }
  return shared->run;
}

// The seal's profile nearest to the middle of B-C; NULL: it has none.
static const SbContactProfile *profile_of(const SbRun *run, int seal) {
  const SbSummary *summary = sb_run_summary(run);
  const double middle = 0.5 * (summary->stage[SB_STAGE_B].time + summary->stage[SB_STAGE_C].time);
  size_t count;
  const SbFrame *frame = sb_run_frames(run, &count);
  size_t best = count;
  for (size_t i = 0; i < count; i++) {
    if (frame[i].seal[seal].profile != UINT32_MAX && frame[i].velocity > 0 &&
        (best == count || fabs(frame[i].time - middle) < fabs(frame[best].time - middle))) {
      best = i;
    }
  }
  return best < count ? sb_run_profile(run, frame[best].seal[seal].profile) : NULL;
}

// Quantities of a frame, each a double.
#define SEAL_QUANTITY(name, index, member)                                                         \
  { name "." #member, offsetof(SbFrame, seal[index].member) }
#define SEAL_QUANTITIES(seal, index)                                                               \
  SEAL_QUANTITY(seal, index, friction), SEAL_QUANTITY(seal, index, friction_boundary),             \
      SEAL_QUANTITY(seal, index, friction_viscous), SEAL_QUANTITY(seal, index, film_min),          \
      SEAL_QUANTITY(seal, index, film_central), SEAL_QUANTITY(seal, index, load)

static const struct {
  const char *name;
  size_t offset;
} quantities[] = {{"time", offsetof(SbFrame, time)},
                  {"displacement", offsetof(SbFrame, displacement)},
                  {"velocity", offsetof(SbFrame, velocity)},
                  {"force", offsetof(SbFrame, force)},
                  {"pressure_force", offsetof(SbFrame, pressure_force)},
                  SEAL_QUANTITIES("outer", SB_OUTER),
                  SEAL_QUANTITIES("inner", SB_INNER)};

bool sb_thesis_run_value(double *out, const char *name, const SbThesisPlace *at) {
  if (at->profile != NULL) {
    const SbContactProfile *of = at->profile;
    const double *column = strcmp(name, "x") == 0                   ? of->x
                           : strcmp(name, "pressure") == 0          ? of->pressure
                           : strcmp(name, "film") == 0              ? of->film
                           : strcmp(name, "asperity_pressure") == 0 ? of->asperity_pressure
                                                                    : NULL;
    *out = column != NULL ? column[at->point] : NAN;
    return column != NULL;
  }
  for (size_t i = 0; i < G_N_ELEMENTS(quantities); i++) {
    if (strcmp(name, quantities[i].name) == 0) {
      *out = *(const double *)((const char *)at->frame + quantities[i].offset);
      return true;
    }
  }
  return false;
}

// ---- Curves ----

typedef struct {
  GArray *x, *y; // of double, as they come
  double low, high;
} Points;

static void take_point(Points *to, SbThesisPlace *at, const char *x, const char *y,
                       const char *group) {
  double place = NAN, value = NAN;
  if (sb_thesis_value(&place, at, x, group, "x") && sb_thesis_value(&value, at, y, group, "y") &&
      isfinite(place) && isfinite(value) && place >= to->low && place <= to->high) {
    g_array_append_val(to->x, place);
    g_array_append_val(to->y, value);
  }
}

static void take_samples(Points *to, SbThesisPlace *at, const char *x, const char *y,
                         const char *group) {
  for (at->sample = 0; at->sample < at->grid->samples; at->sample++) {
    take_point(to, at, x, y, group);
  }
}

static void take_printed(Points *to, SbThesisPlace *at, const char *x, const char *y,
                         const char *group) {
  const SbPrinted *printed = at->work->printed;
  const char *where = sb_thesis_key(at->work, group, "where");
  for (guint row = 0; printed != NULL && row < printed->rows->len; row++) {
    if (sb_thesis_is_meant(at->work, row, where)) {
      at->row = (int)row;
      take_point(to, at, x, y, group);
    }
  }
}

static void take_frames(Points *to, SbThesisPlace *at, const SbRun *run, const char *x,
                        const char *y, const char *group) {
  const char *part = sb_thesis_key(at->work, group, "part");
  size_t count;
  const SbFrame *frame = sb_run_frames(run, &count);
  size_t turn = 0; // where the stem is furthest in
  for (size_t i = 0; i < count; i++) {
    turn = frame[i].platen > frame[turn].platen ? i : turn;
  }
  for (size_t i = 0; i < count; i++) {
    if (part == NULL || (strcmp(part, "in") == 0) == (i <= turn)) {
      at->frame = &frame[i];
      take_point(to, at, x, y, group);
    }
  }
}

static void take_profile(Points *to, SbThesisPlace *at, const SbContactProfile *profile,
                         const char *x, const char *y, const char *group) {
  at->profile = profile;
  for (at->point = 0; at->point < profile->count; at->point++) {
    take_point(to, at, x, y, group);
  }
}

// Which run a series is of: "GRID" or "GRID SEAL" of a key; NULL: none, or told.
static const SbRun *named_run(int *seal, SbThesisWork *work, const char *text, const char *group,
                              const char *key) {
  g_auto(GStrv) words = g_strsplit(text, ":", 2);
  g_autofree char *whole = g_strconcat(g_strstrip(words[0]), ":", NULL);
  SbThesisGrid *grid;
  const char *none;
  *seal = words[1] != NULL && strstr(words[1], "inner") != NULL ? SB_INNER : SB_OUTER;
  return sb_thesis_grid(&grid, &none, work, whole, group, key) && grid != NULL ? run_of(work, grid)
                                                                               : NULL;
}

static void gather_points(Points *to, SbThesisWork *work, const char *group) {
  SbThesisPlace at = {.work = work, .row = SB_THESIS_NO_ROW};
  const char *x = sb_thesis_key(work, group, "x"), *y = sb_thesis_key(work, group, "y");
  const char *run = sb_thesis_key(work, group, "run");
  const char *profile = sb_thesis_key(work, group, "profile");
  int seal = SB_OUTER;
  if (x == NULL || y == NULL) {
    sb_thesis_add_issue(work, group, x == NULL ? "x" : "y", "is missing");
  } else if (run != NULL || profile != NULL) {
    const SbRun *of =
        named_run(&seal, work, run != NULL ? run : profile, group, run != NULL ? "run" : "profile");
    const SbContactProfile *contact = of != NULL && run == NULL ? profile_of(of, seal) : NULL;
    if (of != NULL && run != NULL) {
      take_frames(to, &at, of, x, y, group);
    } else if (contact != NULL) {
      take_profile(to, &at, contact, x, y, group);
    }
  } else if (sb_thesis_grid(&at.grid, &x, work, x, group, "x") &&
             sb_thesis_grid(&at.grid, &y, work, y, group, "y")) {
    if (at.grid != NULL) {
      take_samples(to, &at, x, y, group);
    } else {
      take_printed(to, &at, x, y, group);
    }
  }
}

// What a chart has room for, in the order of x, the last point kept.
static void put_points(SbStudySeries *series, const Points *from) {
  const guint count = from->x->len;
  g_autofree guint *order = g_new(guint, count + 1);
  for (guint i = 0; i < count; i++) {
    guint k = i;
    for (;
         k > 0 && g_array_index(from->x, double, order[k - 1]) > g_array_index(from->x, double, i);
         k--) {
      order[k] = order[k - 1];
    }
    order[k] = i;
  }
  const guint room = MIN(count, (guint)SB_STUDY_POINTS);
  for (guint i = 0; i < room; i++) {
    const guint at = room > 1 ? order[(guint)((guint64)i * (count - 1) / (room - 1))] : order[0];
    sb_study_point(series, g_array_index(from->x, double, at), g_array_index(from->y, double, at));
  }
}

static void read_within(Points *to, SbThesisWork *work, const char *group, const SbStudyAxis *x) {
  const char *text = sb_thesis_key(work, group, "within");
  const char *dots = text != NULL ? strstr(text, "..") : NULL;
  to->low = -INFINITY;
  to->high = INFINITY;
  if (dots != NULL) {
    g_autoptr(GError) error = NULL;
    g_autofree char *low = g_strstrip(g_strndup(text, (gsize)(dots - text)));
    g_autofree char *high = g_strstrip(g_strdup(dots + 2));
    if (!sb_quantity_parse(&to->low, low, x->si, x->unit, &error) ||
        !sb_quantity_parse(&to->high, high, x->si, x->unit, &error)) {
      sb_thesis_add_issue(work, group, "within", "%s", error->message);
    }
  }
}

static void add_series(SbStudy *chart, SbThesisWork *work, const char *group) {
  const char *panel = sb_thesis_key(work, group, "panel");
  const char *style = sb_thesis_key(work, group, "style");
  const char *name = sb_thesis_key(work, group, "name");
  const gint64 at = panel != NULL ? g_ascii_strtoll(panel, NULL, 10) : 1;
  if (at < 1 || at > (gint64)chart->panel_count ||
      chart->panel[at - 1].series_count == SB_STUDY_SERIES) {
    sb_thesis_add_issue(work, group, "panel", "there is no such panel, or it is full");
    return;
  }
  SbStudySeries *series =
      sb_study_series(&chart->panel[at - 1],
                      style == NULL || strcmp(style, "curve") == 0 ? SB_STUDY_CURVE
                      : strcmp(style, "dots") == 0                 ? SB_STUDY_DOTS
                                                                   : SB_STUDY_REFERENCE,
                      name != NULL ? name : group + strlen("series "));
  Points points = {.x = g_array_new(FALSE, FALSE, sizeof(double)),
                   .y = g_array_new(FALSE, FALSE, sizeof(double))};
  read_within(&points, work, group, &chart->x);
  gather_points(&points, work, group);
  put_points(series, &points);
  if (points.x->len == 0) {
    sb_thesis_add_issue(work, group, "y", "has no point with a value");
  }
  g_array_unref(points.x);
  g_array_unref(points.y);
}

// "QUANTITY | SI unit | unit"; false: there is no such key.
static bool read_axis(SbStudyAxis *out, const SbThesisWork *work, const char *key) {
  const char *text = sb_thesis_key(work, "chart", key);
  const char *log = sb_thesis_key(work, "chart", "log");
  if (text == NULL) {
    return false;
  }
  g_auto(GStrv) parts = g_strsplit(text, "|", 3);
  g_auto(GStrv) logs = g_strsplit_set(log != NULL ? log : "", ", ", -1);
  const bool units = g_strv_length(parts) == 3;
  *out = (SbStudyAxis){.logarithmic = g_strv_contains((const char *const *)logs, key)};
  g_strlcpy(out->quantity, g_strstrip(parts[0]), sizeof out->quantity);
  g_strlcpy(out->si, units ? g_strstrip(parts[1]) : "1", sizeof out->si);
  g_strlcpy(out->unit, units ? g_strstrip(parts[2]) : "", sizeof out->unit);
  return true;
}

void sb_thesis_chart(SbThesisItem *item, SbThesisWork *work) {
  item->chart = g_new0(SbStudy, 1);
  item->chart->complete = true;
  if (!read_axis(&item->chart->x, work, "x")) {
    sb_thesis_add_issue(work, "chart", "x", "is missing");
    return;
  }
  for (int k = 1; k <= SB_STUDY_PANELS; k++) {
    g_autofree char *key = g_strdup_printf("y.%d", k);
    SbStudyAxis axis;
    if (read_axis(&axis, work, key)) {
      (void)sb_study_panel(item->chart, &axis, "no value");
    }
  }
  for (guint i = 0; i < work->entries->len && !work->stopped; i++) {
    const SbEntry *entry = work->entries->pdata[i];
    if (entry->name == NULL && g_str_has_prefix(entry->group, "series ")) {
      add_series(item->chart, work, entry->group);
    }
  }
}
