// Changes to a key file's text that leave every other line as it stands.
#pragma once

#include <glib.h>
#include <stddef.h>

typedef struct {
  const char *group;
  const char *name;
  const char *value; // NULL removes the key
} SbChange;

// `text` (as scanned to `entries`) with the changes made: a key in place, a new key at the end of
// its group, a new group at the end. Owned by the caller.
char *sb_writer_apply(const char *text, const GPtrArray *entries, const SbChange *changes,
                      size_t count);
