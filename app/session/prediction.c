// Sums over the parameters that differ. See the header.
#include "app/session/prediction.h"

#include "engine/valve/figures/figures.h"

#include <math.h>
#include <string.h>

// How far a tangent is followed, over the base's value.
static const double REACH = 0.1;

typedef struct {
  int id;                     // of the parameter
  const SbTangent *tangent;   // of the base
  const SbGradient *gradient; // of the base's figures by the parameter alone; NULL: not known
  double by;                  // [SI]
} Change;

struct SbPrediction {
  const SbDisplayedRun *base;
  Change change[SB_PARAM_COUNT];
  size_t changes;
  GArray *displacement, *force; // of double
  SbSummary summary;
  SbFrame frame;
  SbContactProfile profile[SB_SEAL_COUNT];
  double *block[SB_SEAL_COUNT]; // of their arrays, owned
  SbChartPredicted chart;
};

SbPrediction *sb_prediction_new(void) {
  SbPrediction *prediction = g_new0(SbPrediction, 1);
  prediction->displacement = g_array_new(FALSE, FALSE, sizeof(double));
  prediction->force = g_array_new(FALSE, FALSE, sizeof(double));
  return prediction;
}

void sb_prediction_free(SbPrediction *prediction) {
  if (prediction != NULL) {
    g_array_unref(prediction->displacement);
    g_array_unref(prediction->force);
    for (int i = 0; i < SB_SEAL_COUNT; i++) {
      g_free(prediction->block[i]);
    }
    g_free(prediction);
  }
}

bool sb_prediction_differs(const SbParams *a, const SbParams *b, int id) {
  const bool follows = sb_param((SbParamId)id)->parent >= 0 && !a->given[id] && !b->given[id];
  return !follows && sb_params_get(a, (SbParamId)id) != sb_params_get(b, (SbParamId)id);
}

// Finds what differs; false where one of it has no slopes, or lies too far.
static bool find_changes(SbPrediction *prediction, const SbDisplayedRun *base,
                         const SbParams *params) {
  prediction->base = base;
  prediction->changes = 0;
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    if (!sb_prediction_differs(&base->params, params, id)) {
      continue;
    }
    const double from = sb_params_get(&base->params, (SbParamId)id);
    const double by = sb_params_get(params, (SbParamId)id) - from;
    if (base->tangent[id] == NULL || !(fabs(by) <= REACH * fabs(from))) {
      return false;
    }
    prediction->change[prediction->changes++] =
        (Change){id, base->tangent[id], base->gradient[id], by};
  }
  return prediction->changes > 0;
}

static void make_loop(SbPrediction *prediction) {
  size_t count;
  const SbTracePoint *point = sb_trace_points(prediction->base->trace, &count);
  g_array_set_size(prediction->displacement, (guint)count);
  g_array_set_size(prediction->force, (guint)count);
  double *displacement = (double *)(void *)prediction->displacement->data;
  double *force = (double *)(void *)prediction->force->data;
  for (size_t i = 0; i < count; i++) {
    displacement[i] = point[i].displacement;
    force[i] = point[i].force;
    for (size_t k = 0; k < prediction->changes; k++) {
      const Change *change = &prediction->change[k];
      sb_tangent_add_loop(&displacement[i], &force[i], change->tangent, point[i].frame, change->by);
    }
  }
  prediction->chart.loop = (SbChartCurve){count, displacement, force};
}

// Adds what a figure changes by; it has no value where one of the slopes is not accepted.
static void add_figure(SbSummary *summary, const Change *change, int f) {
  double *value = (double *)(void *)((char *)summary + sb_figure(f)->offset);
  const SbGradient *gradient = change->gradient;
  const char *key = sb_param((SbParamId)change->id)->key;
  if (isnan(*value)) {
    return; // the base has none, or a change before this one
  }
  *value += gradient != NULL ? change->by * sb_gradient_slope(gradient, (size_t)f, 0) : NAN;
  if (isnan(*value)) {
    summary->reasons.of[f] = 0; // of the base, which has the figure
    const char *why = gradient != NULL ? sb_gradient_reason(gradient, (size_t)f, 0) : NULL;
    sb_reason(summary, sb_figure(f)->path, "not predicted: its slope by %s is not known (%s)", key,
              why != NULL ? why : "not computed yet");
  }
}

static void make_figures(SbPrediction *prediction, const SbModel *model) {
  SbSummary *summary = &prediction->summary;
  *summary = *sb_run_summary(prediction->base->run);
  for (int f = 0; f < SB_FIGURE_COUNT; f++) {
    for (size_t k = 0; k < prediction->changes; k++) {
      add_figure(summary, &prediction->change[k], f);
    }
  }
  sb_figures_of_model(summary, model);
  if (summary->outcome == SB_OUTCOME_STUCK && summary->force_return_margin > 0) {
    // The predicted stem slides past the place where that of the base is stuck.
    summary->returned = NAN;
    sb_reason(summary, "cycle.returns", "not predicted: the stem of the solved run is stuck");
  }
  summary->outcome = isnan(summary->returned) ? SB_OUTCOME_UNKNOWN : summary->outcome;
  summary->returns = summary->outcome == SB_OUTCOME_RETURNED;
  sb_verdict_fill(summary, model);
}

// `run->profile` of the chart: the predicted frame's profiles are numbered by their seals.
static const SbContactProfile *profile_of(const void *source, uint32_t index) {
  const SbPrediction *prediction = source;
  const bool known = index < SB_SEAL_COUNT && prediction->profile[index].count > 0;
  return known ? &prediction->profile[index] : NULL;
}

bool sb_prediction_make(SbPrediction *prediction, const SbDisplayedRun *base,
                        const SbParams *params, const SbModel *model) {
  if (!find_changes(prediction, base, params)) {
    prediction->changes = 0;
    return false;
  }
  make_loop(prediction);
  make_figures(prediction, model);
  SbChartRun *run = &prediction->chart.run;
  memset(run, 0, sizeof *run);
  run->state = SB_CHART_DONE;
  run->frames = &prediction->frame;
  run->count = 1;
  run->model = model;
  run->summary = &prediction->summary;
  run->profile = profile_of;
  run->source = prediction;
  sb_prediction_show(prediction, 0);
  return true;
}

// The profile of a seal in the shown frame; none where one of the changes has no slopes of it.
static void make_profile(SbPrediction *prediction, int seal, uint32_t index) {
  SbContactProfile *out = &prediction->profile[seal];
  const SbContactProfile *base = sb_run_profile(prediction->base->run, index);
  const size_t n = base->count;
  double *block = g_renew(double, prediction->block[seal], 4 * n + 1);
  prediction->block[seal] = block;
  const SbTangentProfile arrays = {block, block + n, block + 2 * n, block + 3 * n};
  memcpy(arrays.x, base->x, n * sizeof *block);
  memcpy(arrays.pressure, base->pressure, n * sizeof *block);
  memcpy(arrays.film, base->film, n * sizeof *block);
  memset(arrays.asperity, 0, n * sizeof *block);
  if (base->asperity_pressure != NULL) {
    memcpy(arrays.asperity, base->asperity_pressure, n * sizeof *block);
  }
  bool known = true;
  for (size_t k = 0; k < prediction->changes && known; k++) {
    const Change *change = &prediction->change[k];
    SbTangentProfile moved = arrays;
    known = sb_tangent_add_profile(&moved, change->tangent, index, change->by);
  }
  *out = (SbContactProfile){.count = known ? n : 0,
                            .x = arrays.x,
                            .pressure = arrays.pressure,
                            .film = arrays.film,
                            .asperity_pressure =
                                base->asperity_pressure != NULL ? arrays.asperity : NULL,
                            .model = base->model,
                            .film_model = base->film_model};
}

void sb_prediction_show(SbPrediction *prediction, size_t frame) {
  const SbDisplayedRun *base = prediction->base;
  SbFrame *out = &prediction->frame;
  frame = MIN(frame, base->chart.count - 1);
  *out = base->chart.frames[frame];
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const uint32_t index = out->seal[i].profile;
    prediction->profile[i].count = 0;
    if (index != UINT32_MAX && sb_run_profile(base->run, index) != NULL) {
      make_profile(prediction, i, index);
    }
    out->seal[i].profile = (uint32_t)i;
    out->seal[i].shape = UINT32_MAX;
  }
  for (size_t k = 0; k < prediction->changes; k++) {
    const Change *change = &prediction->change[k];
    sb_tangent_add_frame(out, change->tangent, frame, change->by);
  }
}

const SbChartPredicted *sb_prediction_chart(const SbPrediction *prediction) {
  return &prediction->chart;
}
