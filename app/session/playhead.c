// The playhead over one run's frames. Playback is linear in the cycle's time at the chosen speed
// and shows the nearest frame, nothing interpolated. A hitch longer than a quarter of a second is
// not caught up, so that the picture never leaps after the window was hidden.
#include "app/session/playhead.h"

#include <math.h>

void sb_playhead_init(SbPlayhead *playhead) {
  // Half way from C to D: the chamber is open, the canister's pressure is on one ring alone. How
  // long that takes only the run tells. One without that stage, a rig's or one whose stem sticks,
  // shows its middle.
  *playhead =
      (SbPlayhead){.loops = TRUE,
                   .duration = 10,
                   .waits = TRUE,
                   .placed = G_MAXSIZE,
                   .place = {.stage = SB_STAGE_C, .share = 0.5, .time = INFINITY, .whole = 0.5}};
}

size_t sb_playhead_nearest(const SbFrame *frames, size_t count, double time) {
  // First frame not before `time`, by bisection.
  size_t lo = 0;
  size_t hi = count;
  while (lo < hi) {
    size_t middle = lo + (hi - lo) / 2;
    if (frames[middle].time < time) {
      lo = middle + 1;
    } else {
      hi = middle;
    }
  }
  if (lo == count) {
    return count - 1;
  }
  if (lo > 0 && time - frames[lo - 1].time < frames[lo].time - time) {
    return lo - 1;
  }
  return lo;
}

size_t sb_playhead_event(const SbPlayhead *playhead, const SbTrace *trace, size_t count,
                         int direction) {
  size_t best = direction > 0 ? (count > 0 ? count - 1 : 0) : 0;
  size_t events = 0;
  const SbTraceEvent *event = sb_trace_events(trace, &events);
  for (size_t i = 0; i < events; i++) {
    size_t frame = event[i].mark.frame;
    if (direction > 0 && frame > playhead->frame && frame < best) {
      best = frame;
    } else if (direction < 0 && frame < playhead->frame && frame > best && frame < count) {
      best = frame;
    }
  }
  return best;
}

void sb_playhead_remember(SbPlayhead *playhead, const SbTrace *trace, const SbFrame *frames,
                          size_t count, gboolean complete) {
  if (playhead->waits || playhead->frame >= count || playhead->frame == playhead->placed) {
    return;
  }
  // An event's own frame counts to its stage here.
  size_t events = 0;
  const SbTraceEvent *event = sb_trace_events(trace, &events);
  size_t i = 0;
  while (i + 1 < events && event[i + 1].mark.frame <= playhead->frame) {
    i++;
  }
  double now = frames[playhead->frame].time, end = frames[count - 1].time;
  double from = events > 0 ? event[i].mark.time : 0;
  double to = i + 1 < events ? event[i + 1].mark.time : end;
  const gboolean ends = complete || i + 1 < events;
  playhead->place = (SbPlayheadPlace){.stage = events > 0 ? event[i].stage : SB_STAGE_A,
                                      .cycle = events > 0 ? event[i].cycle : 0,
                                      .share = now == from ? 0
                                               : ends      ? fmin((now - from) / (to - from), 1)
                                                           : NAN,
                                      .time = now - from,
                                      .whole = end > 0 ? now / end : 0};
}

void sb_playhead_return(SbPlayhead *playhead, const SbTrace *trace, const SbFrame *frames,
                        size_t count, gboolean complete) {
  playhead->waits = FALSE;
  if (count == 0) {
    playhead->frame = 0;
    playhead->placed = G_MAXSIZE;
    return;
  }
  const SbPlayheadPlace *place = &playhead->place;
  size_t frame = count - 1;
  if (!playhead->follows) {
    const SbStageMark *mark = sb_trace_mark(trace, place->stage, place->cycle);
    size_t last = sb_trace_stage_end(trace, place->stage, place->cycle, count);
    double end = frames[count - 1].time;
    double time = INFINITY;
    if (mark != NULL && !isnan(place->share) && (complete || last + 1 < count)) {
      time = mark->time + place->share * (frames[last].time - mark->time);
    } else if (mark != NULL) {
      time = mark->time + place->time; // how long the stage lasts here is not known yet
    } else if (complete) {
      time = place->whole * end;
    }
    playhead->waits = time > end && !complete;
    if (mark != NULL && place->share == 0) {
      frame = MIN(mark->frame, count - 1); // several frames may have an event's time
    } else if (time < end) {
      frame = sb_playhead_nearest(frames, count, time);
    }
  }
  playhead->frame = playhead->placed = frame;
  playhead->time = frames[frame].time;
}

size_t sb_playhead_same_place(const SbChartRun *run, size_t frame, const SbChartRun *other) {
  SbPlayhead place = {.frame = frame, .placed = G_MAXSIZE};
  if (run->count == 0) {
    return 0;
  }
  sb_playhead_remember(&place, run->trace, run->frames, run->count, TRUE);
  sb_playhead_return(&place, other->trace, other->frames, other->count, TRUE);
  return place.frame;
}

void sb_playhead_play(SbPlayhead *playhead, const SbFrame *frames, size_t count, gboolean on) {
  playhead->playing = on && count > 1;
  playhead->last = 0;
  if (playhead->playing) {
    playhead->follows = FALSE;
    playhead->waits = FALSE;
    if (playhead->frame + 1 >= count) {
      playhead->frame = 0;
    }
    playhead->time = frames[playhead->frame].time;
  }
}

gboolean sb_playhead_tick(SbPlayhead *playhead, const SbFrame *frames, size_t count, gint64 now) {
  if (!playhead->playing || count == 0) {
    return FALSE;
  }
  double passed = playhead->last > 0 ? (double)(now - playhead->last) / 1e6 : 0;
  playhead->last = now;
  double end = frames[count - 1].time;
  playhead->time += fmin(passed, 0.25) * end / playhead->duration;
  gboolean stopped = FALSE;
  if (playhead->time >= end) {
    if (playhead->loops && end > 0) {
      playhead->time = fmod(playhead->time, end);
    } else {
      playhead->time = end;
      playhead->playing = FALSE;
      stopped = TRUE;
    }
  }
  size_t frame = sb_playhead_nearest(frames, count, playhead->time);
  gboolean moved = frame != playhead->frame;
  playhead->frame = frame;
  return moved || stopped;
}
