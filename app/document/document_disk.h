// A document and the file on disk that it was read from or saved to: whether another program has
// changed that file since, and what then becomes of both versions. On the thread of the document.
#pragma once

#include "app/document/document.h"

typedef enum {
  SB_DISK_SAME,          // the files are as they were read or written, or the document has none
  SB_DISK_CHANGED,       // the document's own file has other bytes
  SB_DISK_VALVE_CHANGED, // only the file of the scene's valve has other bytes
  SB_DISK_GONE           // the document's own file is not there any more
} SbDiskState;

// Compares size, time and identity of the files with those at the last reading or saving, and their
// bytes only where these differ.
SbDiskState sb_document_disk_state(const SbDocument *document);

// Text of the document's file when it was last read or saved; borrowed until the next save.
const char *sb_document_file_text(const SbDocument *document);

// Three-way merge of key files: returns `theirs` with the changes that lead from `base` to `mine`,
// key by key, in the user's line order and with the comments of `theirs`. Where both sides changed
// one key to different values, `mine` is used and a line "group.key: VALUE (in the file: VALUE)" is
// added to `conflicts` (of char *; may be NULL). Owned by the caller (g_free()).
char *sb_document_merge_texts(const char *base, const char *mine, const char *theirs,
                              GPtrArray *conflicts);

// Reads `path` again and returns a document that differs from that file by what leads from `base`
// to `mine`, which sb_document_is_modified() then reports. `base` NULL: it has all that `mine`
// says. `path` NULL: an untitled document with the changes of `mine`. NULL with at least one issue
// if either cannot be read. Owned by the caller (sb_document_free()).
SbDocument *sb_document_load_with(const char *path, const char *base, const char *mine,
                                  GPtrArray *conflicts, GPtrArray *issues);

// Puts all of `other` (taken over) in the place of what the document is: values, pins, notes, path
// and the state of its file. One step that can be undone, and then everything is as before.
void sb_document_become(SbDocument *document, SbDocument *other);

// A path next to the document's that no file has: "NAME (2).scene", "NAME (3).scene" and so on.
// Owned by the caller (g_free()).
char *sb_document_free_path(const SbDocument *document);
