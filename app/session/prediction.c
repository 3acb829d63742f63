// Points of the base's thinned trace, moved. See the header.
#include "app/session/prediction.h"

#include <math.h>

// How far a tangent is followed, over the base's value.
static const double REACH = 0.1;

struct SbPrediction {
  SbDisplayedRun *base;                      // owned reference, NULL: none
  SbDisplayedRun *neighbour[SB_PARAM_COUNT]; // owned references, NULL: none
  GArray *displacement, *force;              // of double
  SbChartCurve curve;
};

SbPrediction *sb_prediction_new(void) {
  SbPrediction *prediction = g_new0(SbPrediction, 1);
  prediction->displacement = g_array_new(FALSE, FALSE, sizeof(double));
  prediction->force = g_array_new(FALSE, FALSE, sizeof(double));
  return prediction;
}

static void forget(SbPrediction *prediction) {
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    g_clear_pointer(&prediction->neighbour[id], sb_displayed_run_unref);
  }
  prediction->curve = (SbChartCurve){0};
}

void sb_prediction_free(SbPrediction *prediction) {
  if (prediction != NULL) {
    forget(prediction);
    sb_displayed_run_unref(prediction->base);
    g_array_unref(prediction->displacement);
    g_array_unref(prediction->force);
    g_free(prediction);
  }
}

// Whether a value differs by itself; one that only follows its parent does not.
static bool differs(const SbParams *a, const SbParams *b, int id) {
  const bool follows = sb_param((SbParamId)id)->parent >= 0 && !a->given[id] && !b->given[id];
  return !follows && sb_params_get(a, (SbParamId)id) != sb_params_get(b, (SbParamId)id);
}

int sb_prediction_difference(const SbParams *a, const SbParams *b) {
  int found = -1;
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    if (differs(a, b, id)) {
      if (found >= 0 || sb_param((SbParamId)id)->kind != SB_PARAM_REAL) {
        return -1;
      }
      found = id;
    }
  }
  return found;
}

// Whether two runs have the same events in the same order.
static bool same_events(const SbTrace *a, const SbTrace *b) {
  size_t count, others;
  const SbTraceEvent *one = sb_trace_events(a, &count), *other = sb_trace_events(b, &others);
  bool same = count == others && count > 0;
  for (size_t i = 0; same && i < count; i++) {
    same = one[i].stage == other[i].stage && one[i].cycle == other[i].cycle;
  }
  return same;
}

void sb_prediction_take(SbPrediction *prediction, SbDisplayedRun *run) {
  const SbDisplayedRun *base = prediction->base;
  const int id = base != NULL && base != run && sb_displayed_run_complete(run)
                     ? sb_prediction_difference(&base->params, &run->params)
                     : -1;
  if (id >= 0 && same_events(base->trace, run->trace)) {
    sb_displayed_run_unref(prediction->neighbour[id]);
    prediction->neighbour[id] = sb_displayed_run_ref(run);
  }
}

void sb_prediction_set_base(SbPrediction *prediction, SbDisplayedRun *base) {
  SbDisplayedRun *before = prediction->base;
  if (base != before) {
    forget(prediction);
    prediction->base = sb_displayed_run_ref(base);
    if (before != NULL) {
      sb_prediction_take(prediction, before);
    }
    sb_displayed_run_unref(before);
  }
}

bool sb_prediction_knows(const SbPrediction *prediction, SbParamId id) {
  return prediction->neighbour[id] != NULL;
}

const SbChartCurve *sb_prediction_curve(const SbPrediction *prediction) {
  return &prediction->curve;
}

// A run and where its present stage lies in it, by frames.
typedef struct {
  const SbFrame *frames;
  size_t count, begin, end;
} Span;

static void to_stage(Span *span, const SbTrace *trace, size_t stage) {
  size_t count;
  const SbTraceEvent *event = sb_trace_events(trace, &count);
  span->begin = event[stage].mark.frame;
  span->end = stage + 1 < count ? event[stage + 1].mark.frame : span->count - 1;
}

// Displacement and force at a share of a stage's time; of frames at the same time, before and after
// an event, the last.
static void at_share(double *displacement, double *force, const Span *span, double share) {
  const SbFrame *frames = span->frames;
  const double from = frames[span->begin].time, to = frames[span->end].time;
  const double time = from + share * (to - from);
  size_t low = span->begin, high = span->end;
  while (high > low + 1) {
    const size_t middle = low + (high - low) / 2;
    *(frames[middle].time <= time ? &low : &high) = middle;
  }
  const SbFrame *a = &frames[low], *b = &frames[high];
  const double part = b->time > a->time ? fmin((time - a->time) / (b->time - a->time), 1) : 0;
  *displacement = a->displacement + part * (b->displacement - a->displacement);
  *force = a->force + part * (b->force - a->force);
}

// Adds one neighbour's change times `share`.
static void add(SbPrediction *prediction, const SbDisplayedRun *neighbour, double share) {
  const SbDisplayedRun *base = prediction->base;
  Span mine = {base->chart.frames, base->chart.count, 0, 0};
  Span its = {neighbour->chart.frames, neighbour->chart.count, 0, 0};
  size_t events, points, stage = 0;
  const SbTraceEvent *event = sb_trace_events(base->trace, &events);
  const SbTracePoint *point = sb_trace_points(base->trace, &points);
  to_stage(&mine, base->trace, 0);
  to_stage(&its, neighbour->trace, 0);
  for (size_t i = 0; i < points; i++) {
    // An event's own frame ends the stage before it.
    while (stage + 1 < events && point[i].frame > event[stage + 1].mark.frame) {
      stage++;
      to_stage(&mine, base->trace, stage);
      to_stage(&its, neighbour->trace, stage);
    }
    double s, f;
    const double from = mine.frames[mine.begin].time, to = mine.frames[mine.end].time;
    const bool first = point[i].frame <= mine.begin, last = point[i].frame >= mine.end;
    if (first || last) {
      const SbFrame *frame = &its.frames[first ? its.begin : its.end];
      s = frame->displacement;
      f = frame->force;
    } else {
      at_share(&s, &f, &its, to > from ? (point[i].time - from) / (to - from) : 0);
    }
    g_array_index(prediction->displacement, double, i) += share * (s - point[i].displacement);
    g_array_index(prediction->force, double, i) += share * (f - point[i].force);
  }
}

// The share of a neighbour's change that a value wants; NaN: it cannot be predicted.
static double share_of(const SbPrediction *prediction, const SbParams *params, int id) {
  const SbDisplayedRun *neighbour = prediction->neighbour[id];
  if (neighbour == NULL) {
    return NAN;
  }
  const double from = sb_params_get(&prediction->base->params, (SbParamId)id);
  const double step = sb_params_get(&neighbour->params, (SbParamId)id) - from;
  const double change = sb_params_get(params, (SbParamId)id) - from;
  return fabs(change) <= fmax(REACH * fabs(from), fabs(step)) ? change / step : NAN;
}

bool sb_prediction_make(SbPrediction *prediction, const SbParams *params) {
  const SbDisplayedRun *base = prediction->base;
  prediction->curve = (SbChartCurve){0};
  size_t count = 0;
  const SbTracePoint *point = base != NULL ? sb_trace_points(base->trace, &count) : NULL;
  int changed = 0;
  for (int id = 0; base != NULL && id < SB_PARAM_COUNT; id++) {
    if (differs(&base->params, params, id)) {
      if (isnan(share_of(prediction, params, id))) {
        return false;
      }
      changed++;
    }
  }
  if (changed == 0 || count == 0) {
    return false;
  }
  g_array_set_size(prediction->displacement, (guint)count);
  g_array_set_size(prediction->force, (guint)count);
  for (size_t i = 0; i < count; i++) {
    g_array_index(prediction->displacement, double, i) = point[i].displacement;
    g_array_index(prediction->force, double, i) = point[i].force;
  }
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    if (differs(&base->params, params, id)) {
      add(prediction, prediction->neighbour[id], share_of(prediction, params, id));
    }
  }
  prediction->curve = (SbChartCurve){count, (const double *)prediction->displacement->data,
                                     (const double *)prediction->force->data};
  return true;
}
