// The playhead over one run's frames. Playback is linear in the cycle's time at the chosen speed
// and shows the nearest frame, nothing interpolated. A hitch longer than a quarter of a second is
// not caught up, so that the picture never leaps after the window was hidden.
#include "ui/playhead.h"

#include <math.h>

void sb_playhead_init(SbPlayhead *playhead) {
  *playhead = (SbPlayhead){.follows = TRUE, .loops = TRUE, .duration = 10};
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

size_t sb_playhead_event(const SbPlayhead *playhead, const SbStageMark *marks, size_t count,
                         int direction) {
  size_t best = direction > 0 ? (count > 0 ? count - 1 : 0) : 0;
  for (int stage = 0; stage < SB_STAGE_COUNT; stage++) {
    size_t frame = marks[stage].frame;
    if (!marks[stage].reached || frame >= count) {
      continue;
    }
    if (direction > 0 && frame > playhead->frame && frame < best) {
      best = frame;
    } else if (direction < 0 && frame < playhead->frame && frame > best) {
      best = frame;
    }
  }
  return best;
}

void sb_playhead_play(SbPlayhead *playhead, const SbFrame *frames, size_t count, gboolean on) {
  playhead->playing = on && count > 1;
  playhead->last = 0;
  if (playhead->playing) {
    playhead->follows = FALSE;
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
