// Changes of a key file's text that leave every other line unchanged.
#pragma once

#include <glib.h>
#include <stddef.h>

// One change.
typedef struct {
  const char *group; // "seal.outer"
  const char *name;  // "modulus"
  const char *value; // with unit, as in the file; NULL removes the key
} SbChange;

// Returns `text`, whose entries (of SbEntry) are `entries` (sb_reader_scan()), with changes[count]
// applied in their order: an existing key in its line, a new key at the end of its group, a new
// group at the end. Each key is changed at most once. The removal of an absent key does nothing.
char *sb_writer_apply(const char *text, const GPtrArray *entries, const SbChange *changes,
                      size_t count);
