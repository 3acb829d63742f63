// Unsaved changes of a session, stored in a file of the user's data folder as long as there are
// any. After a crash the next start offers to restore them. The user's own file is never written.
#pragma once

#include "app/session/session.h"

typedef struct SbAutosave SbAutosave;

// Delay between a change and writing [ms].
enum { SB_AUTOSAVE_DELAY = 1000 };

// Follows `session` (borrowed; must outlive the result): SB_AUTOSAVE_DELAY after a change its file
// is written atomically, and it is removed once there is nothing to save. Failures to write are
// ignored. Freed by sb_autosave_free().
SbAutosave *sb_autosave_new(SbSession *session);

// Writes unsaved changes immediately.
void sb_autosave_write(SbAutosave *autosave);

// Writes unsaved changes immediately; sb_autosave_free(), which must still follow, then does not
// remove the file. For a program that must end without asking the user.
void sb_autosave_leave(SbAutosave *autosave);

// Frees `autosave` and removes the file, because the session ends as the user wants; not after
// sb_autosave_leave(). Call it before the session is freed.
void sb_autosave_free(SbAutosave *autosave);

// Returns the path of a file of a process that does not run any more; NULL: there is none.
char *sb_autosave_find(void);

// Content of such a file. Freed by sb_unsaved_clear().
typedef struct {
  char *path; // of the document; NULL: it was never saved
  char *base; // text of that file when the document was read or saved; NULL: none, or not known
  char *text; // of the document with its unsaved changes
} SbUnsaved;

// Reads the file `file` of sb_autosave_find(). The file stays: the caller removes it once the
// changes are restored (sb_session_restore(), then sb_autosave_write()) or discarded. Returns
// FALSE, with *out empty, if it cannot be read or is not such a file.
gboolean sb_autosave_read(SbUnsaved *out, const char *file);

// Frees the strings; `unsaved` is then empty.
void sb_unsaved_clear(SbUnsaved *unsaved);
G_DEFINE_AUTO_CLEANUP_CLEAR_FUNC(SbUnsaved, sb_unsaved_clear)

// Returns whether the document's file differs from `base` or is gone: another program has changed
// it since. FALSE if `path` or `base` is NULL.
gboolean sb_unsaved_is_outdated(const SbUnsaved *unsaved);
