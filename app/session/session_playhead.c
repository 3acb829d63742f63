// The playhead of a session: which frame is shown, how it plays and steps, and what stands there in
// words. What moves it while a run grows is in session_run.c.
#include "app/session/session_private.h"

#include "app/base/format.h"

#include <glib/gi18n.h>

const SbFrame *sb_session_frame(SbSession *session) {
  return sb_chart_frame(&session->chart);
}

void sb_session_set_playhead(SbSession *session, size_t frame) {
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(session, &count);
  if (count == 0) {
    return;
  }
  session->playhead.frame = MIN(frame, count - 1);
  session->playhead.time = frames[session->playhead.frame].time;
  session->playhead.follows = session->playhead.frame + 1 == count;
  session->playhead.waits = FALSE;
  sb_session_playhead_changed(session);
}

void sb_session_show_stage(SbSession *session, SbStage stage, double share) {
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(session, &count);
  const SbTrace *trace = session->shown != NULL ? session->shown->trace : NULL;
  const SbStageMark *mark = count > 0 ? sb_trace_mark(trace, stage, 0) : NULL;
  if (mark == NULL) {
    return;
  }
  const double from = frames[MIN(mark->frame, count - 1)].time;
  const double to = frames[sb_trace_stage_end(trace, stage, 0, count)].time;
  sb_session_play(session, FALSE);
  sb_session_set_playhead(session,
                          share > 0 ? sb_playhead_nearest(frames, count, from + share * (to - from))
                                    : mark->frame);
}

void sb_session_step(SbSession *session, int frames) {
  gint64 frame = (gint64)session->playhead.frame + frames;
  sb_session_play(session, FALSE);
  sb_session_set_playhead(session, (size_t)MAX(frame, 0));
}

void sb_session_step_event(SbSession *session, int direction) {
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(session, &count);
  if (session->shown == NULL || count == 0) {
    return;
  }
  size_t frame = sb_playhead_event(&session->playhead, session->shown->trace, count, direction);
  // A bookmark on the way comes first.
  const size_t now = session->playhead.frame;
  for (size_t i = 0; i < session->chart.marker_count; i++) {
    const size_t at = sb_playhead_nearest(frames, count, session->chart.marker[i].time);
    if (direction > 0 ? at > now && (at < frame || frame <= now)
                      : at < now && (at > frame || frame >= now)) {
      frame = at;
    }
  }
  sb_session_play(session, FALSE);
  sb_session_set_playhead(session, frame);
}

gboolean sb_session_is_playing(SbSession *session) {
  return session->playhead.playing;
}

void sb_session_play(SbSession *session, gboolean on) {
  if (on == session->playhead.playing) {
    return;
  }
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(session, &count);
  sb_playhead_play(&session->playhead, frames, count, on);
  sb_session_playhead_changed(session);
  sb_session_find_slopes(session);
}

gboolean sb_session_loops(SbSession *session) {
  return session->playhead.loops;
}

void sb_session_set_loops(SbSession *session, gboolean on) {
  session->playhead.loops = on;
}

void sb_session_set_play_duration(SbSession *session, double seconds) {
  session->playhead.duration = seconds;
}

char *sb_session_where(SbSession *session) {
  const SbFrame *frame = sb_session_frame(session);
  if (frame == NULL) {
    return g_strdup("");
  }
  // On the frame of an event its letter; in between the two letters.
  const char *stage = sb_chart_span(&session->chart.run, frame->stage);
  size_t events = 0;
  const SbTraceEvent *event = sb_trace_events(session->shown->trace, &events);
  int cycle = 0;
  for (size_t i = 0; i < events && event[i].mark.frame <= session->playhead.frame; i++) {
    cycle = event[i].cycle;
    if (event[i].mark.frame == session->playhead.frame) {
      stage = sb_stage_name(event[i].stage);
    }
  }
  char displacement[SB_FORMAT_MAX], force[SB_FORMAT_MAX], name[SB_FORMAT_MAX];
  sb_format_text(displacement, SB_QUANTITY_LENGTH, frame->displacement, 0);
  sb_format_text(force, SB_QUANTITY_FORCE, frame->force, sb_chart_error_force(&session->chart.run));
  sb_chart_cycle_name(name, &session->chart.run, cycle);
  g_autofree char *where = g_strdup_printf(_("stage %s, %s, %s"), stage, displacement, force);
  return name[0] != '\0' ? g_strdup_printf("%s, %s", where, name) : g_steal_pointer(&where);
}
