// A session and the file of its document: saving, restoring, and a file that another program
// changed.
#include "app/session/session_private.h"

#include <glib/gi18n.h>
#include <string.h>

gboolean sb_session_restore(SbSession *session, const char *path, const char *base,
                            const char *text, GPtrArray *conflicts, GPtrArray *issues) {
  SbDocument *document = sb_document_load_with(path, base, text, conflicts, issues);
  if (document == NULL) {
    return FALSE;
  }
  sb_session_replace_document(session, document);
  return TRUE;
}

static gboolean write_to(SbSession *session, const char *path, GError **error) {
  if (!sb_document_save(session->document, path, error)) {
    return FALSE;
  }
  session->disk = SB_DISK_SAME;
  sb_session_refresh_chart(session); // the title may be the file's name
  sb_session_emit(session, SB_SIGNAL_PARAMS);
  return TRUE;
}

gboolean sb_session_save(SbSession *session, const char *path, GError **error) {
  const char *own = sb_document_path(session->document);
  const char *target = path != NULL ? path : own;
  if (g_strcmp0(target, own) == 0 && sb_session_check_disk(session) == SB_DISK_CHANGED) {
    g_autofree char *name = g_filename_display_basename(target);
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_CHANGED,
                _("%s was changed by another program since it was opened here"), name);
    return FALSE;
  }
  return write_to(session, target, error);
}

gboolean sb_session_save_over(SbSession *session, GError **error) {
  return write_to(session, sb_document_path(session->document), error);
}

SbDiskState sb_session_disk_state(SbSession *session) {
  return session->disk;
}

SbDiskState sb_session_check_disk(SbSession *session) {
  const SbDiskState now = sb_document_disk_state(session->document);
  if (now != session->disk) {
    session->disk = now;
    sb_session_emit(session, SB_SIGNAL_PARAMS);
  }
  return now;
}

void sb_session_whole_changed(SbSession *session) {
  session->disk = sb_document_disk_state(session->document);
  sb_session_load_pins(session);
  sb_session_read_measured(session);
  sb_session_refresh_chart(session);
  sb_session_document_changed(session);
  sb_session_poll_pins(session); // no run may follow: that of the document may be known
}

static gboolean become(SbSession *session, SbDocument *other) {
  if (other == NULL) {
    return FALSE;
  }
  sb_document_become(session->document, other);
  sb_session_whole_changed(session);
  return TRUE;
}

gboolean sb_session_reload(SbSession *session, GPtrArray *issues) {
  return become(session, sb_document_load(sb_document_path(session->document), issues));
}

gboolean sb_session_merge(SbSession *session, GPtrArray *conflicts, GPtrArray *issues) {
  const SbDocument *document = session->document;
  g_autofree char *mine = sb_document_to_text(document, sb_document_path(document));
  return become(session,
                sb_document_load_with(sb_document_path(document), sb_document_file_text(document),
                                      mine, conflicts, issues));
}

gboolean sb_session_keep_both(SbSession *session, GError **error) {
  const SbDocument *document = session->document;
  g_autofree char *path = sb_document_free_path(document);
  g_autofree char *mine = sb_document_to_text(document, path);
  g_autofree char *folder = g_path_get_dirname(path);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) copy = sb_document_parse(mine, strlen(mine), path, folder, issues);
  if (copy == NULL) { // a document that was read once
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, _("%s cannot be written as a file"),
                sb_document_title(document));
    return FALSE;
  }
  return sb_document_save(copy, path, error) && become(session, g_steal_pointer(&copy));
}
