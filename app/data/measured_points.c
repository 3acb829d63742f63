// Rows of a measured loop that a computed one can be set against; see measured.h.
#include "app/data/measured_private.h"

#include <math.h>

const SbMeasuredCycle *sb_measured_cycle(const SbMeasured *m, size_t index) {
  return &g_array_index(m->cycle, SbMeasuredCycle, index);
}

// Whether a row is of a sliding stem, and in which way.
static bool slides(int *way, const SbMeasured *m, const SbMeasuredCycle *cycle, size_t row) {
  const double s = m->displacement[row], stroke = m->displacement[cycle->turn];
  const double margin = 0.01 * stroke;
  *way = row >= cycle->turn;
  const SbMeasuredStage *end = &m->stage[*way ? SB_STAGE_E : SB_STAGE_D];
  return s > margin && s < (end->found ? end->displacement : stroke) - margin;
}

SbMeasuredPoint *sb_measured_points(size_t *count, const SbMeasured *m, size_t count_max) {
  size_t rows = 0;
  int way;
  for (size_t c = m->first; c <= m->last; c++) {
    const SbMeasuredCycle *cycle = sb_measured_cycle(m, c);
    for (size_t i = cycle->begin; i < cycle->end; i++) {
      rows += slides(&way, m, cycle, i);
    }
  }
  const size_t each = rows / MAX(count_max, 1) + (rows % MAX(count_max, 1) != 0);
  SbMeasuredPoint *point =
      g_new(SbMeasuredPoint, rows / MAX(each, 1) + 2 * (m->last - m->first) + 4);
  SbMeasuredPoint sum = {0};
  *count = 0;
  for (size_t c = m->first; c <= m->last; c++) {
    const SbMeasuredCycle *cycle = sb_measured_cycle(m, c);
    for (size_t i = cycle->begin; i <= cycle->end; i++) {
      const bool takes = i < cycle->end && slides(&way, m, cycle, i);
      // A mean ends with its rows, its stroke or its cycle.
      if (sum.weight > 0 &&
          (sum.weight >= (double)each || i == cycle->end || (takes && way != sum.way))) {
        point[(*count)++] = (SbMeasuredPoint){sum.displacement / sum.weight, sum.force / sum.weight,
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
  return point;
}

void sb_measured_band(SbMeasuredBand *out, const SbMeasured *m) {
  out->end = 0;
  for (size_t c = m->first; c <= m->last; c++) {
    out->end = fmax(out->end, m->displacement[sb_measured_cycle(m, c)->turn] * (1 + 1e-9));
  }
  for (int way = 0; way < 2; way++) {
    for (int piece = 0; piece < SB_MEASURED_BAND; piece++) {
      out->force[way][piece][0] = out->force[way][piece][1] = NAN;
    }
  }
  for (size_t c = m->first; c <= m->last; c++) {
    const SbMeasuredCycle *cycle = sb_measured_cycle(m, c);
    for (size_t i = cycle->begin; i < cycle->end; i++) {
      int way;
      if (slides(&way, m, cycle, i)) {
        double *force = out->force[way][(int)(m->displacement[i] / out->end * SB_MEASURED_BAND)];
        force[0] = fmin(m->force[i], force[0]); // of NaN the other
        force[1] = fmax(m->force[i], force[1]);
      }
    }
  }
}
