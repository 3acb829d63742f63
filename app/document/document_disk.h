// A document and the file on disk that it was read from or saved to: whether another program has
// changed that file since, and how both versions are merged.
#pragma once

#include "app/document/document.h"

// State of the files, compared with the last time that they were read or saved.
typedef enum {
  SB_DISK_SAME,          // the files have the same content, or the document has none
  SB_DISK_CHANGED,       // the document's own file has another content
  SB_DISK_VALVE_CHANGED, // only the file of the scene's valve has another content
  SB_DISK_GONE           // the document's own file does not exist any more
} SbDiskState;

// Returns the state. Compares size, time and identity of the files, and their content only if these
// differ.
SbDiskState sb_document_disk_state(const SbDocument *document);

// Returns the text of the document's file when it was last read or saved. Borrowed until the next
// save.
const char *sb_document_file_text(const SbDocument *document);

// Reads the file `path` again and returns a document with the changes from `base` to `mine` (texts
// of key files) applied, which sb_document_is_modified() then reports. `base` NULL: the document
// has all values of `mine`. `path` NULL: an untitled document with the changes of `mine`.
// If both sides changed a key to different values, that of `mine` applies and a line "group.key:
// VALUE (in the file: VALUE)" is appended to `conflicts` (of char *; may be NULL). Returns NULL
// with at least one issue if the file or `mine` cannot be read; other problems of either are issues
// too, as by sb_document_load(). Freed by sb_document_free().
SbDocument *sb_document_load_with(const char *path, const char *base, const char *mine,
                                  GPtrArray *conflicts, GPtrArray *issues);

// Replaces everything in `document` (values, pins, notes, path and the state of its file) by that
// of `other`, which `document` owns from now on. One step for undo, which restores everything.
void sb_document_become(SbDocument *document, SbDocument *other);

// Returns a path next to the document's that no file has: "NAME (2).scene", "NAME (3).scene" and so
// on. The document must have a path.
char *sb_document_free_path(const SbDocument *document);
