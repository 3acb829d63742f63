// Measured less computed, and the measured rows for that; see compare.h and measured.h.
#include "app/data/compare.h"

#include "app/base/figure_text.h"
#include "app/data/measured_private.h"

static void add(SbLoop *loop, int way, double displacement, double force) {
  size_t *count = &loop->count[way];
  const double last = *count > 0 ? loop->displacement[way][*count - 1] : way ? INFINITY : -INFINITY;
  // Only on: where the stem sticks or jumps back, the loop has no one force.
  if (way == 0 ? displacement > last : displacement < last) {
    loop->displacement[way][*count] = displacement;
    loop->force[way][(*count)++] = force;
  }
}

bool sb_loop_take(SbLoop *loop, const SbRun *run) {
  const SbStageMark *mark = sb_run_summary(run)->stage;
  size_t frames;
  const SbFrame *frame = sb_run_frames(run, &frames);
  for (int s = 0; s < SB_STAGE_COUNT; s++) {
    loop->stage_displacement[s] = mark[s].reached ? mark[s].displacement : NAN;
    loop->stage_force[s] = mark[s].reached ? mark[s].force : NAN;
    loop->stage_error[s] = sb_figure_error(sb_run_summary(run), sb_figure_stage_force((SbStage)s));
  }
  for (int way = 0; way < 2; way++) {
    loop->count[way] = 0;
    loop->displacement[way] = g_renew(double, loop->displacement[way], frames);
    loop->force[way] = g_renew(double, loop->force[way], frames);
  }
  if (!mark[SB_STAGE_B].reached) {
    return false;
  }
  for (size_t i = mark[SB_STAGE_B].frame + 1; i < frames && frame[i].stage < SB_STAGE_D; i++) {
    add(loop, 0, frame[i].displacement, frame[i].force);
  }
  for (size_t i = mark[SB_STAGE_E].reached ? mark[SB_STAGE_E].frame + 1 : frames;
       i < frames && frame[i].stage >= SB_STAGE_E; i++) {
    add(loop, 1, frame[i].displacement, frame[i].force);
  }
  return loop->count[0] > 1;
}

void sb_loop_clear(SbLoop *loop) {
  for (int way = 0; way < 2; way++) {
    g_free(loop->displacement[way]);
    g_free(loop->force[way]);
  }
  *loop = (SbLoop){0};
}

double sb_loop_force(const SbLoop *loop, int way, double displacement) {
  const size_t count = loop->count[way];
  const double *s = loop->displacement[way], *force = loop->force[way];
  if (count < 2) {
    return NAN;
  }
  const double sign = way == 0 ? 1 : -1, margin = 0.01 * fabs(s[count - 1] - s[0]);
  const double x = sign * displacement;
  if (x < sign * s[0] - margin || x > sign * s[count - 1] + margin) {
    return NAN;
  }
  size_t low = 0, high = count - 1;
  while (high - low > 1) {
    const size_t middle = (low + high) / 2;
    *(sign * s[middle] <= x ? &low : &high) = middle;
  }
  const double t = fmin(fmax((displacement - s[low]) / (s[high] - s[low]), 0), 1);
  return force[low] + t * (force[high] - force[low]);
}

// Whether the stem slides, and in which way. If it jams on the return, it rests at the cycle's end.
static bool slides(int *way, const SbMeasured *m, const SbMeasuredCycle *cycle, size_t row) {
  const double s = m->displacement[row], stroke = m->displacement[cycle->turn];
  const double margin = 0.01 * stroke;
  *way = row >= cycle->turn;
  const double rest = *way ? fmax(m->displacement[cycle->end - 1], 0) : 0;
  const SbMeasuredStage *end = &m->stage[*way ? SB_STAGE_E : SB_STAGE_D];
  return s > rest + margin && s < (end->found ? end->displacement : stroke) - margin;
}

SbMeasuredPoint *sb_measured_points(size_t *count, const SbMeasured *m, size_t count_max) {
  int way;
  const size_t rows = sb_measured_cycle(m, m->last)->end - sb_measured_cycle(m, m->first)->begin;
  const size_t each = rows / MAX(count_max, 1) + (rows % MAX(count_max, 1) != 0);
  SbMeasuredPoint *out = g_new(SbMeasuredPoint, rows / MAX(each, 1) + 2 * (m->last - m->first) + 4);
  SbMeasuredPoint sum = {0};
  *count = 0;
  for (size_t c = m->first; c <= m->last; c++) {
    const SbMeasuredCycle *cycle = sb_measured_cycle(m, c);
    for (size_t i = cycle->begin; i <= cycle->end; i++) {
      const bool takes = i < cycle->end && slides(&way, m, cycle, i);
      // A mean ends with its rows, its stroke or its cycle.
      if (sum.weight > 0 &&
          (sum.weight >= (double)each || i == cycle->end || (takes && way != sum.way))) {
        out[(*count)++] = (SbMeasuredPoint){sum.displacement / sum.weight, sum.force / sum.weight,
                                            sum.weight, sum.way};
        sum = (SbMeasuredPoint){0};
      }
      if (takes) {
        sum.displacement += m->displacement[i];
        sum.force += m->force[i];
        sum.weight++;
        sum.way = way;
      }
    }
  }
  return out;
}

SbComparison *sb_comparison_create(const SbMeasured *m, const SbLoop *loop) {
  SbComparison *out = g_new0(SbComparison, 1);
  out->measured = m;
  out->point = sb_measured_points(&out->count, m, SB_COMPARISON_POINTS);
  out->residual = g_new(double, out->count + 1);
  double rows = 0, sum = 0, square = 0;
  out->most = NAN;
  for (size_t i = 0; i < out->count; i++) {
    const SbMeasuredPoint *point = &out->point[i];
    const double r = point->force - sb_loop_force(loop, point->way, point->displacement);
    out->residual[i] = r;
    if (isnan(r)) {
      out->outside++;
      continue;
    }
    rows += point->weight;
    sum += point->weight * r;
    square += point->weight * r * r;
    out->most = fmax(fabs(r), out->most);
  }
  out->mean = rows > 0 ? sum / rows : NAN;
  out->rms = rows > 0 ? sqrt(square / rows) : NAN;
  memcpy(out->model_displacement, loop->stage_displacement, sizeof loop->stage_displacement);
  memcpy(out->model_force, loop->stage_force, sizeof loop->stage_force);
  memcpy(out->model_error, loop->stage_error, sizeof loop->stage_error);
  SbMeasuredBand *band = &out->band;
  const size_t cycles = m->last > m->first ? m->last + 1 : 0; // one cycle has no scatter
  for (size_t c = m->first; c < cycles; c++) {
    band->end = fmax(band->end, m->displacement[sb_measured_cycle(m, c)->turn] * (1 + 1e-9));
  }
  for (int i = 0; i < 4 * SB_MEASURED_BAND; i++) {
    band->force[i / 2 / SB_MEASURED_BAND][i / 2 % SB_MEASURED_BAND][i % 2] = NAN;
  }
  for (size_t c = m->first; c < cycles; c++) {
    const SbMeasuredCycle *cycle = sb_measured_cycle(m, c);
    for (size_t i = cycle->begin; i < cycle->end; i++) {
      int way;
      if (slides(&way, m, cycle, i)) {
        double *force = band->force[way][(int)(m->displacement[i] / band->end * SB_MEASURED_BAND)];
        force[0] = fmin(m->force[i], force[0]); // of NaN the other
        force[1] = fmax(m->force[i], force[1]);
      }
    }
  }
  return out;
}

void sb_comparison_free(SbComparison *comparison) {
  if (comparison != NULL) {
    g_free(comparison->point);
    g_free(comparison->residual);
    g_free(comparison);
  }
}
