// The answer to a design question. See design_answer.h.
#include "app/session/design_answer.h"

#include <math.h>

void sb_design_answer_free(SbDesignAnswer *answer) {
  if (answer == NULL) {
    return;
  }
  for (int i = 0; i < SB_DESIGN_PLACES; i++) {
    g_free(answer->place[i].sample);
  }
  sb_design_release(&answer->found);
  sb_study_file_free(answer->study);
  g_free(answer->map.value);
  g_free(answer->map.status);
  g_free(answer);
}

int sb_design_answer_figure(const SbDesignAnswer *answer, int figure) {
  return sb_study_column_of(answer->study, figure);
}

static double value_at(const SbDesignMap *map, size_t figure, size_t across, size_t up) {
  return map->value[(up * map->n + across) * map->figures + figure];
}

double sb_design_map_at(const SbDesignMap *map, size_t figure, double across, double up) {
  const double last = (double)(map->n - 1);
  const double x = (across - map->low[0]) / (map->high[0] - map->low[0]) * last;
  const double y = (up - map->low[1]) / (map->high[1] - map->low[1]) * last;
  if (!(x >= 0 && x <= last && y >= 0 && y <= last)) {
    return NAN;
  }
  const size_t i = (size_t)fmin(x, last - 1), k = (size_t)fmin(y, last - 1);
  const double u = x - (double)i, v = y - (double)k;
  const double a = value_at(map, figure, i, k), d = value_at(map, figure, i + 1, k + 1);
  // The triangles that lines are drawn in: split from the lower left to the upper right.
  return u >= v ? a + u * (value_at(map, figure, i + 1, k) - a) +
                      v * (d - value_at(map, figure, i + 1, k))
                : a + v * (value_at(map, figure, i, k + 1) - a) +
                      u * (d - value_at(map, figure, i, k + 1));
}

bool sb_design_on_map(const SbDesignAnswer *answer, int place) {
  const SbDesignPlace *of = &answer->place[place];
  for (guint k = 0; of->known && k < answer->study->vary->len; k++) {
    const SbParamId id = g_array_index(answer->study->vary, SbVary, k).id;
    if (id != answer->map.axis[0] && id != answer->map.axis[1] &&
        of->value[k] != sb_model_value(answer->study->base, id)) {
      return false;
    }
  }
  return of->known && of->axis[0] >= answer->map.low[0] && of->axis[0] <= answer->map.high[0] &&
         of->axis[1] >= answer->map.low[1] && of->axis[1] <= answer->map.high[1];
}

bool sb_design_violates(const SbDesignAnswer *answer, int place, size_t limit) {
  const SbLimit *of = &answer->study->limits.item[limit];
  const int column = sb_design_answer_figure(answer, of->figure);
  const SbDesignPlace *at = &answer->place[place];
  const double value = column >= 0 && at->known ? at->figure[column] : NAN;
  const bool best = place == SB_DESIGN_BEST && answer->found.feasible;
  return !best && (value < of->low || value > of->high);
}

double sb_design_sigmas(const SbDesignAnswer *answer, int place, size_t limit) {
  const SbLimit *of = &answer->study->limits.item[limit];
  const int column = sb_design_answer_figure(answer, of->figure);
  const SbDesignPlace *at = &answer->place[place];
  if (column < 0 || column >= SB_DESIGN_FIGURES || !at->known) {
    return NAN;
  }
  const double margin = fmin(at->figure[column] - of->low, of->high - at->figure[column]);
  return at->variance[column] > 0 ? margin / sqrt(at->variance[column]) : NAN;
}

size_t sb_design_best_values(SbOverride *values, const SbDesignAnswer *answer) {
  const SbDesignPlace *best = &answer->place[SB_DESIGN_BEST];
  const guint count = best->known ? answer->study->vary->len : 0;
  for (guint k = 0; k < count; k++) {
    const SbVary *vary = &g_array_index(answer->study->vary, SbVary, k);
    const SbDistribution *of = &vary->distribution;
    const SbParam *param = sb_param(vary->id);
    const double wide = sb_quantity_to_shown(of->b, param->si, param->unit) -
                        sb_quantity_to_shown(of->a, param->si, param->unit);
    const int power = (int)floor(log10(fabs(wide) / 1000));
    values[k] =
        (SbOverride){vary->id, sb_quantity_step(best->value[k], param->si, param->unit, power, 0)};
  }
  return count;
}
