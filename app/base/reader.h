// Key files as lines: what stands where, so that every problem can be told with its line and an
// edit touches no other line. The format is GKeyFile's: [group], key = value, # comment.
#pragma once

#include "app/base/issue.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct {
  char *group; // "seal.outer"
  char *name;  // "modulus"; NULL for the line of the group itself
  char *value; // trimmed; NULL for a group
  int line;    // from 1
} SbEntry;

// Lets this process read pipes where it reads files (`<(command)` of a shell): for programs that
// read each file once and may wait for its writer. To be called at the start of the program.
void sb_reader_read_pipes(void);
bool sb_reader_reads_pipes(void);

// Reads a complete regular file, or pipe where the process reads them, of at most `bytes_max` bytes
// without ever blocking on something else. NULL with one issue otherwise. Owned by the caller, with
// a terminating NUL beyond *length.
char *sb_reader_load(size_t *length, const char *path, const char *shown, size_t bytes_max,
                     GPtrArray *issues);

// The same from an open descriptor of any kind to its end; it stays open.
char *sb_reader_load_stream(size_t *length, int fd, const char *shown, size_t bytes_max,
                            GPtrArray *issues);

// All groups and keys of `text` in order. Lines that are none, text that is not UTF-8, duplicate
// keys and groups become issues under the name `shown`; a duplicate is left out. Owned by the
// caller (g_ptr_array_unref frees the entries).
GPtrArray *sb_reader_scan(const char *text, size_t length, const char *shown, GPtrArray *issues);
