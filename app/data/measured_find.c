// What a measured loop shows by itself: direction, cycles, zero, compliance, noise, stages.
// Noise: second differences of neighbouring rows while the stem slides, their median magnitude over
// 0.6745 sqrt(6), which is the deviation where noise is white and normal; steps do not enter a
// median. Stages: B is the last row before the stem moves by more than 1 % of the stroke at the
// greatest force, taken half a row further up the rise; D the last row of the sliding force before
// it rises on the stop, E the first one after that went; C and F are the upper ends of the ramp
// between two levels: knots of the continuous line (level, ramp, level on a common slope) of least
// squares through means over equal pieces of the stroke, if it halves those of a straight line.
#include "app/data/measured_private.h"

#include "engine/numeric/dense.h"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics_double.h>

enum { LOOKED = 20000 };

// Median force of at most LOOKED of the rows of [begin, end) with a displacement in [low, high].
static double median_force(const SbMeasured *m, size_t begin, size_t end, double low, double high) {
  const size_t step = (end - begin) / LOOKED + 1;
  g_autofree double *value = g_new(double, (end - begin) / step + 1);
  size_t count = 0;
  for (size_t i = begin; i < end; i += step) {
    if (m->displacement[i] >= low && m->displacement[i] <= high) {
      value[count++] = m->force[i];
    }
  }
  return sb_number_median(value, count);
}

// Ends of strokes: rows where the displacement turns by more than a fifth of its range, the first
// and the last row included. Owned by the caller.
static GArray *find_turns(const SbMeasured *m) {
  GArray *turns = g_array_new(FALSE, FALSE, sizeof(size_t));
  double low, high;
  gsl_stats_minmax(&low, &high, m->displacement, 1, m->count);
  const double gap = 0.2 * (high - low);
  size_t least = 0, most = 0, extreme = 0;
  int way = 0;
  g_array_append_val(turns, extreme);
  for (size_t i = 1; i < m->count; i++) {
    const double s = m->displacement[i];
    if (way == 0) {
      least = s < m->displacement[least] ? i : least;
      most = s > m->displacement[most] ? i : most;
      if (s - m->displacement[least] > gap || m->displacement[most] - s > gap) {
        way = s - m->displacement[least] > gap ? 1 : -1;
        extreme = i;
      }
    } else if (way * (s - m->displacement[extreme]) >= 0) {
      extreme = i;
    } else if (way * (m->displacement[extreme] - s) > gap) {
      g_array_append_val(turns, extreme);
      extreme = i;
      way = -way;
    }
  }
  const size_t end = m->count - 1;
  if (end > g_array_index(turns, size_t, turns->len - 1)) {
    g_array_append_val(turns, end);
  }
  return turns;
}

// Mean force of the strokes that grow less that of those that fall; NaN without both.
static double opening(const SbMeasured *m, const GArray *turns) {
  double sum[2] = {0}, count[2] = {0};
  for (guint k = 0; k + 1 < turns->len; k++) {
    const size_t begin = g_array_index(turns, size_t, k);
    const size_t end = g_array_index(turns, size_t, k + 1);
    const int falls = m->displacement[end] < m->displacement[begin];
    // By displacement, so that a wait does not weigh.
    for (size_t i = begin; i < end; i++) {
      const double step = fabs(m->displacement[i + 1] - m->displacement[i]);
      sum[falls] += 0.5 * (m->force[i] + m->force[i + 1]) * step;
      count[falls] += step;
    }
  }
  return sum[0] / count[0] - sum[1] / count[1];
}

static void find_direction(SbMeasured *m, const GArray *turn, const SbData *data, GPtrArray *list) {
  const char *said = data->text[SB_DATA_DIRECTION];
  if (said != NULL) {
    m->direction = SB_HOW_SAID;
    const size_t turned = sb_data_word(data, SB_DATA_DIRECTION, sb_data_directions, list) - 1;
    m->turned_force = (turned & 1) != 0;
    m->turned_displacement = (turned & 2) != 0;
  } else {
    double low, high;
    gsl_stats_minmax(&low, &high, m->force, 1, m->count);
    const double middle = median_force(m, 0, m->count, -INFINITY, INFINITY);
    const double open = opening(m, turn);
    const bool pressed = fabs(middle) > 0.05 * (high - low), loop = isfinite(open) && open != 0;
    m->direction = pressed && loop ? SB_HOW_FOUND : SB_HOW_ASSUMED;
    m->turned_force = pressed && middle < 0;
    if (loop) {
      m->turned_displacement = (open < 0) != m->turned_force;
    } else if (turn->len > 1) {
      m->turned_displacement = m->displacement[g_array_index(turn, size_t, 1)] < m->displacement[0];
    }
  }
  for (size_t i = 0; i < m->count; i++) {
    m->force[i] *= m->turned_force ? -1 : 1;
    m->displacement[i] *= m->turned_displacement ? -1 : 1;
  }
}

static bool find_cycles(SbMeasured *m, const GArray *turns, const SbData *data, GPtrArray *issues) {
  m->cycle = g_array_new(FALSE, FALSE, sizeof(SbMeasuredCycle));
  for (guint k = 0; k + 1 < turns->len && m->cycle->len < SB_MEASURED_CYCLES_MAX; k++) {
    const size_t from = g_array_index(turns, size_t, k);
    const size_t turn = g_array_index(turns, size_t, k + 1);
    if (m->displacement[turn] > m->displacement[from]) {
      const size_t end = k + 2 < turns->len ? g_array_index(turns, size_t, k + 2) : turn;
      g_array_append_vals(m->cycle, &(SbMeasuredCycle){from, turn, end + (end + 1 == m->count)}, 1);
    }
  }
  if (m->cycle->len == 0) {
    return sb_data_add_issue(data, SB_DATA_FILE, NULL, issues,
                             "no stroke into the valve was found in it");
  }
  const char *said = data->text[SB_DATA_CYCLE];
  const bool all = said != NULL && strcmp(said, "all") == 0;
  m->last = m->tests > 0 && !all ? 0 : m->cycle->len - 1;
  if (said != NULL && !all) {
    double number = 0;
    if (!sb_number_parse(&number, said) || number != floor(number) || number < 1 ||
        number > m->cycle->len) {
      g_autofree char *allowed = g_strdup_printf("all, or 1 to %u", m->cycle->len);
      return sb_data_add_issue(data, SB_DATA_CYCLE, allowed, issues, "\"%s\" is not a cycle of it",
                               said);
    }
    m->first = m->last = (size_t)number - 1;
  }
  return true;
}

// Of a cycle's in-stroke: rows up to where the force reaches nine tenths of its sliding level.
typedef struct {
  size_t begin, end;
  double level; // sliding [N]
  double range; // of the displacement [m]
} Rise;

static Rise find_rise(const SbMeasured *m, size_t index) {
  const SbMeasuredCycle *cycle = sb_measured_cycle(m, index);
  Rise rise = {.begin = cycle->begin, .end = cycle->begin};
  const double s0 = m->displacement[cycle->begin], s1 = m->displacement[cycle->turn];
  rise.range = s1 - s0;
  rise.level =
      median_force(m, cycle->begin, cycle->turn, s0 + 0.2 * rise.range, s0 + 0.45 * rise.range);
  while (rise.end < cycle->turn && m->force[rise.end] < 0.9 * rise.level) {
    rise.end++;
  }
  return rise;
}

// The force while the crosshead approaches without touching: rows before the rise that lie within a
// tenth of the level of the first, over at least 1 % of the stroke.
static void find_no_load(SbMeasured *m, const Rise *rise) {
  size_t end = rise->begin;
  while (end < rise->end &&
         fabs(m->force[end] - m->force[rise->begin]) < 0.1 * (rise->level - m->force[end])) {
    end++;
  }
  const size_t kept = rise->begin + (end - rise->begin) * 4 / 5;
  if (kept >= rise->begin + 5 &&
      m->displacement[kept] - m->displacement[rise->begin] > 0.01 * rise->range) {
    m->force_zero = SB_HOW_FOUND;
    m->no_load_row = rise->begin;
    m->no_load_rows = kept - rise->begin;
    m->no_load = gsl_stats_mean(m->force + rise->begin, 1, m->no_load_rows);
  }
}

static void find_compliance(SbMeasured *m, const Rise *rise) {
  g_autofree double *force = g_new(double, rise->end - rise->begin + 1);
  g_autofree double *place = g_new(double, rise->end - rise->begin + 1);
  size_t n = 0;
  for (size_t i = rise->begin; i < rise->end; i++) {
    const double share = (m->force[i] - m->no_load) / (rise->level - m->no_load);
    force[n] = m->force[i];
    place[n] = m->displacement[i];
    n += share >= 0.2 && share <= 0.8;
  }
  double offset, slope, covariance[3], square;
  if (n >= 4 && gsl_stats_variance(force, 1, n) > 0) {
    gsl_fit_linear(force, 1, place, 1, n, &offset, &slope, covariance, covariance + 1,
                   covariance + 2, &square);
    m->compliance = SB_HOW_FOUND;
    m->slope = slope * (rise->level - m->no_load) > 2e-4 * rise->range ? slope : 0;
  }
}

static bool find_zero(SbMeasured *m, const SbData *data, GPtrArray *issues) {
  const Rise rise = find_rise(m, m->first);
  const char *zero = data->text[SB_DATA_ZERO], *compliance = data->text[SB_DATA_COMPLIANCE];
  if (zero != NULL) {
    m->zero = m->force_zero = SB_HOW_SAID;
    g_auto(GStrv) parts = g_strsplit(zero, ",", -1);
    if (strcmp(zero, "as-is") != 0 &&
        !(g_strv_length(parts) == 2 &&
          sb_quantity_parse(&m->at_rest, g_strstrip(parts[0]), "m", "mm", NULL) &&
          sb_quantity_parse(&m->no_load, g_strstrip(parts[1]), "N", "N", NULL))) {
      return sb_data_add_issue(data, SB_DATA_ZERO, "as-is, or as in 0.31 mm, 0.2 N", issues,
                               "\"%s\" is not such a pair", zero);
    }
  } else if (rise.level > 0) {
    find_no_load(m, &rise);
    if (m->force_zero != SB_HOW_FOUND && m->first > 0) {
      // A machine that stays on the stem between cycles has come to it once.
      const Rise approach = find_rise(m, 0);
      find_no_load(m, &approach);
    }
  }
  if (compliance != NULL) {
    m->compliance = SB_HOW_SAID;
    if (strcmp(compliance, "none") != 0 &&
        (!sb_quantity_parse(&m->slope, compliance, "m/N", "mm/N", NULL) || m->slope < 0)) {
      return sb_data_add_issue(data, SB_DATA_COMPLIANCE, "none, or as in 0.01 mm/N", issues,
                               "\"%s\" is not a compliance", compliance);
    }
  } else if (rise.level > m->no_load) {
    find_compliance(m, &rise);
  }
  for (size_t i = 0; i < m->count; i++) {
    m->force[i] -= m->no_load;
    m->displacement[i] -= m->slope * m->force[i];
  }
  if (zero == NULL) {
    g_autofree double *place = g_new(double, rise.end - rise.begin + 1);
    size_t count = 0;
    for (size_t i = rise.begin; i < rise.end && count < LOOKED; i++) {
      if (m->force[i] > 0.1 * (rise.level - m->no_load)) {
        place[count++] = m->displacement[i];
      }
    }
    if (count >= 4) {
      m->zero = SB_HOW_FOUND;
      m->at_rest = sb_number_median(place, count);
    }
  }
  for (size_t i = 0; i < m->count; i++) {
    m->displacement[i] -= m->at_rest;
  }
  return true;
}

// The stem rests on the stop: the machine turned at the greatest force, not at a displacement.
static void settle_turns(SbMeasured *m) {
  for (guint c = 0; c < m->cycle->len; c++) {
    SbMeasuredCycle *cycle = &g_array_index(m->cycle, SbMeasuredCycle, c);
    const double rest = 0.997 * m->displacement[cycle->turn];
    size_t most = cycle->turn;
    for (int step = -1; step <= 1; step += 2) {
      for (size_t i = cycle->turn; i > cycle->begin && i < cycle->end && m->displacement[i] >= rest;
           i += (size_t)step) {
        most = m->force[i] > m->force[most] ? i : most;
      }
    }
    cycle->turn = most;
  }
}

static void find_noise(SbMeasured *m) {
  const SbMeasuredCycle *cycle = sb_measured_cycle(m, m->first);
  const double stroke = m->displacement[cycle->turn];
  const size_t step = (cycle->end - cycle->begin) / LOOKED + 1;
  g_autofree double *value = g_new(double, (cycle->end - cycle->begin) / step + 1);
  size_t count = 0;
  for (size_t i = cycle->begin + 1; i + 1 < cycle->end; i += step) {
    if (m->displacement[i] > 0.05 * stroke && m->displacement[i] < 0.95 * stroke) {
      value[count++] = fabs(m->force[i - 1] - 2 * m->force[i] + m->force[i + 1]);
    }
  }
  m->noise = count >= 8 ? sb_number_median(value, count) / (0.6745 * sqrt(6)) : NAN;
  const bool known = m->no_load_rows > 0 && isfinite(m->noise);
  m->no_load_deviation = known ? m->noise / sqrt((double)m->no_load_rows) : 0;
}

enum { BINS = 160 };

// Level, ramp, level on a common slope through means of the stroke's pieces.
typedef struct {
  double x[BINS], y[BINS], weight[BINS];
  size_t count;
} Means;

static Means means_of(const SbMeasured *m, size_t begin, size_t end, double low, double high) {
  Means means = {0};
  for (size_t i = begin; i < end; i++) {
    const double share = (m->displacement[i] - low) / (high - low);
    if (share >= 0 && share < 1) {
      const int bin = (int)(share * BINS);
      means.x[bin] += share;
      means.y[bin] += m->force[i];
      means.weight[bin]++;
    }
  }
  for (int i = 0; i < BINS; i++) {
    const double weight = means.weight[i];
    if (weight > 0) {
      means.x[means.count] = means.x[i] / weight;
      means.y[means.count] = means.y[i] / weight;
      means.weight[means.count++] = weight;
    }
  }
  return means;
}

// Squares that y = a + b ramp + c x leaves, and the coefficients a, c, b; b = 0 where p = q.
static double ramp_squares(double coefficient[3], const Means *of, double p, double q) {
  const size_t n = q > p ? 3 : 2;
  double a[9] = {0}, right[3] = {0}, square = 0;
  for (size_t i = 0; i < of->count; i++) {
    const double ramp = q > p ? fmin(fmax((of->x[i] - p) / (q - p), 0), 1) : 0;
    const double term[3] = {1, of->x[i], ramp};
    for (size_t r = 0; r < n; r++) {
      for (size_t c = 0; c < n; c++) {
        a[r + n * c] += of->weight[i] * term[r] * term[c];
      }
      right[r] += of->weight[i] * term[r] * of->y[i];
    }
    square += of->weight[i] * of->y[i] * of->y[i];
  }
  memcpy(coefficient, right, sizeof right);
  if (!sb_eliminate(a, coefficient, n)) {
    return INFINITY;
  }
  for (size_t k = 0; k < n; k++) {
    square -= coefficient[k] * right[k];
  }
  return isfinite(square) ? fmax(square, 0) : INFINITY;
}

// The ramp of least squares; false where a straight line does nearly as well.
static bool find_ramp(double *p, double *q, double coefficient[3], const Means *of) {
  double best = INFINITY, trial[3], low[2] = {0.03, 0.05}, high[2] = {0.95, 0.97};
  *p = *q = 0;
  for (double step = 1.0 / 40; step > 1e-4; step /= 4) {
    for (double x = low[0]; x <= high[0]; x += step) {
      for (double z = fmax(low[1], x + 0.004); z <= high[1]; z += step) {
        const double square = ramp_squares(trial, of, x, z);
        if (square < best) {
          best = square;
          *p = x;
          *q = z;
        }
      }
    }
    for (int k = 0; k < 2; k++) {
      low[k] = (k == 0 ? *p : *q) - step;
      high[k] = low[k] + 2 * step;
    }
  }
  const double line = ramp_squares(trial, of, 0, 0);
  return isfinite(best) && best < 0.5 * line && isfinite(ramp_squares(coefficient, of, *p, *q));
}

// Finds the stages C and F of a cycle whose greatest displacement is `stroke` [m]: the upper ends
// of its ramps, or the reason why there are none.
static void find_ramps(SbMeasured *m, const SbMeasuredCycle *cycle, double stroke) {
  for (int way = 0; way < 2; way++) {
    SbMeasuredStage *stage = &m->stage[way == 0 ? SB_STAGE_C : SB_STAGE_F];
    const double low = 0.02 * stroke, high = 0.98 * stroke;
    const Means means = means_of(m, way == 0 ? cycle->begin : cycle->turn,
                                 way == 0 ? cycle->turn : cycle->end, low, high);
    double p, q, coefficient[3];
    stage->reason = "the force does not fall between two levels there";
    if (means.count < 20) {
      stage->reason = "there are too few rows";
    } else if (find_ramp(&p, &q, coefficient, &means) &&
               (way == 0 ? coefficient[2] < 0 : coefficient[2] > 0)) {
      const double at = way == 0 ? p : q;
      *stage =
          (SbMeasuredStage){true, low + at * (high - low),
                            coefficient[0] + coefficient[1] * at + (way == 1 ? coefficient[2] : 0),
                            m->noise / sqrt(fmax(means.count / 4.0, 1)), NULL};
    }
  }
}

// How much higher the force can have become between a row and the next, where the stem slipped
// somewhere between them while the force rose at its rate. A row between two others of the record's
// own spacing is that of the event itself: an export of events, or of both states at one time.
// Without a column of time the rows are equally spaced.
static double unseen_rise(const SbMeasured *m, size_t row) {
  const double rise = fmax(m->force[row] - m->force[row - 1], 0);
  if (m->time == NULL) {
    return rise;
  }
  const double before = m->time[row] - m->time[row - 1];
  const double after = m->time[row + 1] - m->time[row];
  const double spacing = m->time[row - 1] - m->time[row - 2];
  const bool event = before + after < 1.5 * spacing;
  return !event && before > 0 ? rise * after / before : 0;
}

static void find_first_slip(SbMeasured *m, const SbMeasuredCycle *cycle, double stroke) {
  SbMeasuredStage *b = &m->stage[SB_STAGE_B];
  size_t most = cycle->begin;
  for (size_t i = cycle->begin; i < cycle->turn && m->displacement[i] < 0.01 * stroke; i++) {
    most = m->force[i] > m->force[most] ? i : most;
  }
  b->reason = "the stem moves from the first row on";
  if (most > cycle->begin + 2 && m->force[cycle->begin] < 0.5 * m->force[most]) {
    const double step = unseen_rise(m, most);
    *b = (SbMeasuredStage){true, m->displacement[most], m->force[most] + 0.5 * step,
                           hypot(isfinite(m->noise) ? m->noise : 0, step / sqrt(12)), NULL};
  }
}

// Both ends of the time on the stop: D before it, E behind.
static void find_stop(SbMeasured *m, const SbMeasuredCycle *cycle, double stroke) {
  SbMeasuredStage *d = &m->stage[SB_STAGE_D], *e = &m->stage[SB_STAGE_E];
  const double inwards = median_force(m, cycle->begin, cycle->turn, 0.8 * stroke, 0.95 * stroke);
  const double back = median_force(m, cycle->turn, cycle->end, 0.8 * stroke, 0.95 * stroke);
  const double noise = isfinite(m->noise) ? m->noise : 0;
  const double gap = fmax(5 * noise, 0.05 * (inwards - back));
  d->reason = e->reason = "the force does not rise on a stop";
  size_t last = cycle->turn;
  while (last > cycle->begin && m->force[last] > inwards + gap) {
    last--;
  }
  if (isfinite(inwards) && last < cycle->turn) {
    *d = (SbMeasuredStage){true, m->displacement[last], inwards, noise, NULL};
  }
  size_t next = cycle->turn;
  while (next < cycle->end && m->force[next] > back + gap) {
    next++;
  }
  if (isfinite(back) && next > cycle->turn && next < cycle->end) {
    const double place = m->displacement[next];
    // A peak of static friction before the stem moves, if there is one.
    double least = INFINITY;
    for (size_t i = next; i < cycle->end && m->displacement[i] > place - 0.01 * stroke; i++) {
      least = fmin(least, m->force[i]);
    }
    *e = (SbMeasuredStage){true, place, least < back - gap ? least : back, noise, NULL};
  }
}

bool sb_measured_find(SbMeasured *m, const SbData *data, GPtrArray *issues) {
  const guint before = issues->len;
  if (!(gsl_stats_max(m->displacement, 1, m->count) >
        gsl_stats_min(m->displacement, 1, m->count))) {
    return sb_data_add_issue(data, SB_DATA_FILE, NULL, issues, "its displacement does not change");
  }
  g_autoptr(GArray) turns = find_turns(m);
  find_direction(m, turns, data, issues);
  if (issues->len > before || !find_cycles(m, turns, data, issues) || !find_zero(m, data, issues)) {
    return false;
  }
  settle_turns(m);
  find_noise(m);
  const SbMeasuredCycle *cycle = sb_measured_cycle(m, m->first);
  const double stroke = m->displacement[cycle->turn];
  find_first_slip(m, cycle, stroke);
  find_stop(m, cycle, stroke);
  find_ramps(m, cycle, m->stage[SB_STAGE_D].found ? m->stage[SB_STAGE_D].displacement : stroke);
  m->stage[SB_STAGE_A].reason = "it is where the record begins";
  return true;
}
