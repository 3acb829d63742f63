// Unsaved changes of a session, kept in a file of the user's data folder while there are any: after
// a crash the next start offers them. Nothing is written over the user's own file.
#pragma once

#include "app/session/session.h"

typedef struct SbAutosave SbAutosave;

// Follows `session`; its file is written at most SB_AUTOSAVE_DELAY ms after a change, by way of a
// temporary one, and removed once there is nothing to save. Owned by the caller.
enum { SB_AUTOSAVE_DELAY = 1000 };
SbAutosave *sb_autosave_new(SbSession *session);

// Writes what is to be saved now.
void sb_autosave_write(SbAutosave *autosave);

// The same, and leaves the file behind: nobody is there to be asked.
void sb_autosave_leave(SbAutosave *autosave);

// The session has ended in good order: removes its file. NULL is allowed.
void sb_autosave_free(SbAutosave *autosave);

// A file that a process which no longer runs has left behind, or NULL. Owned by the caller.
char *sb_autosave_find(void);

// What such a file holds. Release with sb_unsaved_clear().
typedef struct {
  char *path; // of the document; NULL: it was never saved
  char *base; // text of that file when the document was read; NULL: none, or not known
  char *text; // of the document with its unsaved changes
} SbUnsaved;

// FALSE, and nothing in *out, where `file` cannot be read or is not such a file.
gboolean sb_autosave_read(SbUnsaved *out, const char *file);
void sb_unsaved_clear(SbUnsaved *unsaved);
G_DEFINE_AUTO_CLEANUP_CLEAR_FUNC(SbUnsaved, sb_unsaved_clear)

// Returns whether the document's file is not `base` any more: another program has changed it since.
gboolean sb_unsaved_is_outdated(const SbUnsaved *unsaved);
