// What was measured beside a session's runs: the document's first [data], read on a thread, and its
// differences from the displayed run once that is complete.
#include "app/session/session_private.h"

static void drop_comparison(SbSession *session) {
  g_clear_pointer(&session->comparison, sb_comparison_free);
  g_clear_pointer(&session->compared, sb_run_handle_unref);
}

static void take_measured(SbSession *session, SbMeasured *measured) {
  drop_comparison(session);
  sb_measured_free(session->measured);
  session->measured = measured;
}

static void on_read(void *data) {
  SbSession *session = data;
  g_clear_pointer(&session->measured_failure, g_free);
  const SbIssue *why;
  take_measured(session, sb_measure_job_take(session->measuring, &why));
  session->measured_failure = why != NULL ? sb_issue_line(why) : NULL;
  g_clear_pointer(&session->measuring, sb_measure_job_free);
  sb_session_run_changed(session);
}

double sb_session_drive_speed(SbSession *session) {
  return sb_data_drive_speed(sb_document_value(session->document, SB_P_DRIVE_KIND),
                             sb_document_value(session->document, SB_P_DRIVE_SPEED));
}

void sb_session_read_measured(SbSession *session) {
  g_clear_pointer(&session->measuring, sb_measure_job_free);
  g_clear_pointer(&session->measured_failure, g_free);
  take_measured(session, NULL);
  if (sb_document_data_count(session->document) > 0) {
    session->measuring = sb_measure_job_start(sb_data_copy(sb_document_data(session->document, 0)),
                                              sb_session_drive_speed(session), on_read, session);
  }
}

void sb_session_set_data(SbSession *session, SbData *data) {
  sb_document_put_data(session->document, data);
  sb_session_read_measured(session);
  sb_session_run_changed(session);
  sb_session_emit(session, SB_SIGNAL_PARAMS);
}

const SbMeasured *sb_session_measured(SbSession *session) {
  return session->measured;
}

const char *sb_session_measured_failure(SbSession *session) {
  return session->measured_failure;
}

const SbComparison *sb_session_compare(SbSession *session) {
  const SbDisplayedRun *shown = session->shown;
  if (session->measured == NULL || shown == NULL || shown->chart.summary == NULL) {
    drop_comparison(session);
    return NULL;
  }
  if (session->comparison == NULL || session->compared != shown->handle) {
    SbLoop loop = {0};
    drop_comparison(session);
    (void)sb_loop_take(&loop, shown->run);
    session->comparison = sb_comparison_create(session->measured, &loop);
    session->compared = sb_run_handle_ref(shown->handle);
    sb_loop_clear(&loop);
  }
  return session->comparison;
}

void sb_session_clear_measured(SbSession *session) {
  g_clear_pointer(&session->measuring, sb_measure_job_free);
  g_clear_pointer(&session->measured_failure, g_free);
  take_measured(session, NULL);
}
