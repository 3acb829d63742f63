// Streaming thinning in the space (time, displacement, force), each over its expected range. The
// gap of 1/4000 of a range is below half a pixel on any chart up to 2000 px; larger pictures show
// straight pieces of that length, which no eye separates. If a run is longer than expected the gap
// doubles and the points are thinned again, so memory stays bounded.
#include "app/chart/trace.h"

#include "app/base/device.h"

#include <glib.h>
#include <math.h>

enum { POINTS_MAX = 60000 };

struct SbTrace {
  GArray *points; // SbTracePoint
  GArray *peaks;  // SbTracePoint
  size_t consumed;
  double time_scale, displacement_scale, force_scale; // gap in each
  SbTraceRange range;
  SbStageMark mark[SB_STAGE_COUNT]; // of the first cycle
  GArray *events;                   // SbTraceEvent
  unsigned seen;                    // stages of the present cycle, a bit each
  int cycle;
  SbFrame last;
  bool last_kept;
};

SbTrace *sb_trace_create(const SbModel *model) {
  SbTrace *trace = g_new0(SbTrace, 1);
  trace->points = g_array_sized_new(FALSE, FALSE, sizeof(SbTracePoint), 4096);
  trace->peaks = g_array_new(FALSE, FALSE, sizeof(SbTracePoint));
  trace->events = g_array_new(FALSE, FALSE, sizeof(SbTraceEvent));
  if (!sb_device(model)->stem) {
    const SbRig *rig = sb_model_rig(model);
    trace->displacement_scale = rig->speed * rig->duration / 4000;
    trace->force_scale = rig->load / 4000;
    trace->time_scale = rig->duration / 4000;
    return trace;
  }
  double stroke = model ? sb_model_value(model, SB_P_DRIVE_STROKE) : 6.6e-3;
  double force =
      model ? fmax(sb_model_value(model, SB_P_DRIVE_REVERSAL_FORCE), sb_model_pressure_force(model))
            : 35;
  double speed = model ? sb_model_value(model, SB_P_DRIVE_SPEED) : 0.333e-3;
  trace->displacement_scale = stroke / 4000;
  trace->force_scale = (force > 0 ? force : 35) / 4000;
  trace->time_scale = 2.2 * stroke / speed / 4000;
  return trace;
}

void sb_trace_destroy(SbTrace *trace) {
  if (trace) {
    g_array_unref(trace->points);
    g_array_unref(trace->peaks);
    g_array_unref(trace->events);
    g_free(trace);
  }
}

static bool far_apart(const SbTrace *t, const SbTracePoint *p, double time, double displacement,
                      double force) {
  return fabs(time - p->time) >= t->time_scale ||
         fabs(displacement - p->displacement) >= t->displacement_scale ||
         fabs(force - p->force) >= t->force_scale;
}

static void thin_again(SbTrace *trace) {
  trace->time_scale *= 2;
  trace->displacement_scale *= 2;
  trace->force_scale *= 2;
  guint kept = 0;
  SbTracePoint *p = (SbTracePoint *)(void *)trace->points->data;
  for (guint i = 0; i < trace->points->len; i++) {
    bool event = false;
    for (guint e = 0; e < trace->events->len; e++) {
      event = event || g_array_index(trace->events, SbTraceEvent, e).mark.frame == p[i].frame;
    }
    if (kept == 0 || event || i + 1 == trace->points->len ||
        far_apart(trace, &p[kept - 1], p[i].time, p[i].displacement, p[i].force)) {
      p[kept++] = p[i];
    }
  }
  g_array_set_size(trace->points, kept);
}

static void keep(SbTrace *trace, const SbFrame *frame, size_t index) {
  SbTracePoint point = {frame->time, frame->displacement, frame->force, index};
  if (trace->points->len >= POINTS_MAX) {
    thin_again(trace);
  }
  g_array_append_val(trace->points, point);
}

// A new cycle begins where the stage changes from the end of the stroke or the return to A or B; a
// stem that rebounds from the stop stays in its cycle.
static void mark(SbTrace *trace, int stage, const SbFrame *frame, size_t index) {
  if (stage < 0 || stage >= SB_STAGE_COUNT) {
    return;
  }
  if (stage <= SB_STAGE_B && trace->seen >> (SB_STAGE_B + 1) != 0) {
    trace->cycle++;
    trace->seen = 0;
  }
  if ((trace->seen >> stage & 1u) != 0 || trace->events->len >= SB_TRACE_EVENTS_MAX) {
    return;
  }
  trace->seen |= 1u << stage;
  SbTraceEvent event = {
      {true, frame->time, frame->displacement, frame->force, index}, (SbStage)stage, trace->cycle};
  g_array_append_val(trace->events, event);
  if (trace->cycle == 0) {
    trace->mark[stage] = event.mark;
  }
}

static void widen(SbTraceRange *r, const SbFrame *frame, bool first) {
  r->time_max = first ? frame->time : fmax(r->time_max, frame->time);
  r->displacement_min =
      first ? frame->displacement : fmin(r->displacement_min, frame->displacement);
  r->displacement_max =
      first ? frame->displacement : fmax(r->displacement_max, frame->displacement);
  r->force_min = first ? frame->force : fmin(r->force_min, frame->force);
  r->force_max = first ? frame->force : fmax(r->force_max, frame->force);
  for (int s = 0; s < SB_SEAL_COUNT; s++) {
    r->pressure_peak_max = fmax(r->pressure_peak_max, frame->seal[s].pressure_peak);
    r->contact_left = fmin(r->contact_left, frame->seal[s].contact_left);
    r->contact_right = fmax(r->contact_right, frame->seal[s].contact_right);
    if (frame->seal[s].film_min > 0) {
      r->film_min =
          r->film_min > 0 ? fmin(r->film_min, frame->seal[s].film_min) : frame->seal[s].film_min;
      r->film_max = fmax(r->film_max, frame->seal[s].film_central);
    }
  }
}

bool sb_trace_extend(SbTrace *trace, const SbFrame *frames, size_t count, size_t limit) {
  size_t end = limit > 0 ? MIN(count, trace->consumed + limit) : count;
  for (size_t i = trace->consumed; i < end; i++) {
    const SbFrame *frame = &frames[i];
    widen(&trace->range, frame, i == 0);
    bool event = i == 0 || frame->on_event || frame->peak != 0;
    if (frame->peak != 0 && trace->peaks->len < SB_TRACE_PEAKS_MAX) {
      SbTracePoint peak = {frame->time, frame->displacement, frame->force, i};
      g_array_append_val(trace->peaks, peak);
    }
    if (i == 0) {
      mark(trace, SB_STAGE_A, frame, 0);
    } else if (frame->stage != trace->last.stage) {
      // The event lies between the last frame and this one, or on the one that says so.
      bool here = frame->on_event && !trace->last.on_event;
      mark(trace, frame->stage, here ? frame : &trace->last, here ? i : i - 1);
      if (!trace->last_kept) {
        keep(trace, &trace->last, i - 1);
      }
      event = true;
    }
    const SbTracePoint *p =
        trace->points->len > 0 ? &g_array_index(trace->points, SbTracePoint, trace->points->len - 1)
                               : NULL;
    bool far = !p || far_apart(trace, p, frame->time, frame->displacement, frame->force);
    if (far && !event && p && !trace->last_kept &&
        (fabs(frame->force - p->force) > 4 * trace->force_scale ||
         fabs(frame->displacement - p->displacement) > 4 * trace->displacement_scale)) {
      // A jump: keep the frame before it, else the corner is cut.
      keep(trace, &trace->last, i - 1);
    }
    trace->last_kept = far || event;
    if (trace->last_kept) {
      keep(trace, frame, i);
    }
    trace->last = *frame;
  }
  trace->consumed = MAX(trace->consumed, end);
  return trace->consumed < count;
}

const SbTracePoint *sb_trace_points(const SbTrace *trace, size_t *count) {
  *count = trace->points->len;
  return (const SbTracePoint *)(const void *)trace->points->data;
}

const SbTracePoint *sb_trace_peaks(const SbTrace *trace, size_t *count) {
  *count = trace->peaks->len;
  return (const SbTracePoint *)(const void *)trace->peaks->data;
}

size_t sb_trace_frames(const SbTrace *trace) {
  return trace->consumed;
}

SbTraceRange sb_trace_range(const SbTrace *trace) {
  return trace->range;
}

const SbStageMark *sb_trace_marks(const SbTrace *trace) {
  return trace->mark;
}

const SbTraceEvent *sb_trace_events(const SbTrace *trace, size_t *count) {
  *count = trace->events->len;
  return (const SbTraceEvent *)(const void *)trace->events->data;
}

static int find_event(const SbTrace *trace, SbStage stage, int cycle) {
  for (guint i = 0; i < trace->events->len; i++) {
    const SbTraceEvent *event = &g_array_index(trace->events, SbTraceEvent, i);
    if (event->stage == stage && event->cycle == cycle) {
      return (int)i;
    }
  }
  return -1;
}

const SbStageMark *sb_trace_mark(const SbTrace *trace, SbStage stage, int cycle) {
  int i = find_event(trace, stage, cycle);
  return i >= 0 ? &g_array_index(trace->events, SbTraceEvent, (guint)i).mark : NULL;
}

size_t sb_trace_stage_end(const SbTrace *trace, SbStage stage, int cycle, size_t count) {
  int i = find_event(trace, stage, cycle);
  return i >= 0 && i + 1 < (int)trace->events->len
             ? g_array_index(trace->events, SbTraceEvent, (guint)i + 1).mark.frame
             : count - 1;
}

int sb_trace_event_of(const SbTrace *trace, const SbFrame *frames, size_t frame) {
  size_t count = 0;
  const SbTraceEvent *event = sb_trace_events(trace, &count);
  int found = -1;
  while (found + 1 < (int)count && event[found + 1].mark.frame <= frame) {
    found++;
  }
  bool before = found > 0 && event[found].mark.frame == frame &&
                frames[frame].stage != (uint8_t)event[found].stage;
  return before ? found - 1 : found;
}

size_t sb_trace_find(const SbTrace *trace, size_t frame) {
  size_t count, lo = 0;
  const SbTracePoint *p = sb_trace_points(trace, &count);
  size_t hi = count;
  while (lo < hi) {
    size_t mid = lo + (hi - lo) / 2;
    if (p[mid].frame <= frame) {
      lo = mid + 1;
    } else {
      hi = mid;
    }
  }
  return lo > 0 ? lo - 1 : 0;
}
