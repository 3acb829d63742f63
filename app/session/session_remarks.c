// What a review adds to the document: bookmarks on the timeline, notes, named runs.
#include "app/session/session_private.h"

void sb_session_refresh_markers(SbSession *session) {
  const SbDocument *document = session->document;
  const size_t count = sb_document_remark_count(document, SB_REMARK_BOOKMARK);
  g_free(session->markers);
  session->markers = g_new0(SbChartMarker, count + 1);
  for (size_t i = 0; i < count; i++) {
    session->markers[i] = (SbChartMarker){sb_document_bookmark(document, i),
                                          sb_document_remark_name(document, SB_REMARK_BOOKMARK, i)};
  }
  session->chart.marker = session->markers;
  session->chart.marker_count = count;
}

gboolean sb_session_put_remark(SbSession *session, SbRemarkKind kind, const char *name,
                               const char *text, GError **error) {
  if (!sb_document_put_remark(session->document, kind, name, text, error)) {
    return FALSE;
  }
  sb_session_refresh_markers(session);
  sb_session_emit(session, SB_SIGNAL_PARAMS);
  sb_session_emit(session, SB_SIGNAL_PLAYHEAD);
  return TRUE;
}

gboolean sb_session_put_bookmark(SbSession *session, const char *name, GError **error) {
  const SbFrame *frame = sb_session_frame(session);
  if (frame == NULL) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "nothing has run yet");
    return FALSE;
  }
  g_autofree char *time = sb_quantity_format(frame->time, "s", "s");
  return sb_session_put_remark(session, SB_REMARK_BOOKMARK, name, time, error);
}

void sb_session_show_time(SbSession *session, double time) {
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(session, &count);
  if (count > 0) {
    sb_session_play(session, FALSE);
    sb_session_set_playhead(session, sb_playhead_nearest(frames, count, time));
  }
}
