// Key files as lines, so that every problem can be reported with its line and an edit changes no
// other line. The format is GKeyFile's: [group], key = value, # comment.
#pragma once

#include "app/base/issue.h"

#include <stdbool.h>
#include <stddef.h>
#include <sys/stat.h>

// A line of a key file. Strings are owned by the entry.
typedef struct {
  char *group; // "seal.outer"
  char *name;  // "modulus"; NULL for the line of the group itself
  char *value; // trimmed; NULL for a group
  int line;    // from 1
} SbEntry;

// Lets this process read pipes in place of files (`<(command)` of a shell): for programs that read
// each file once and may wait for its writer. To be called at the start of the program.
void sb_reader_read_pipes(void);

// Opens the regular file `path` (or pipe, see sb_reader_read_pipes()) for reading without waiting
// for anything else, and writes its state to *info. Returns the descriptor, which the caller
// closes; -1 with one issue, in which `shown` names the file.
int sb_reader_open(struct stat *info, const char *path, const char *shown, GPtrArray *issues);

// Returns the content of the regular file `path` (or pipe, see sb_reader_read_pipes()) of at most
// `bytes_max` bytes, *length bytes and a terminating 0; freed by g_free(). Does not
// wait for anything that is neither. NULL with one issue, in which `shown` names the file, if it
// cannot be read or is too large.
char *sb_reader_load(size_t *length, const char *path, const char *shown, size_t bytes_max,
                     GPtrArray *issues);

// As sb_reader_load(), with the problem as an error of the code `code` (app/base/error.h).
char *sb_reader_load_file(size_t *length, const char *path, const char *shown, size_t bytes_max,
                          int code, GError **error);

// As sb_reader_load(), from the open descriptor `fd` of any kind to its end; the descriptor stays
// open.
char *sb_reader_load_stream(size_t *length, int fd, const char *shown, size_t bytes_max,
                            GPtrArray *issues);

// Returns the folder from which the names in the file `path` are resolved, freed by g_free(); NULL,
// the current folder: `path` is a stream ("-", a pipe, or a descriptor such as /dev/fd/63).
char *sb_reader_folder(const char *path);

// Returns the value of [sealbench] kind of the `length` bytes of a text, such as "study"; NULL if
// the text has none. *grouped: whether the text has any group of a key file. Freed by g_free().
char *sb_reader_kind(bool *grouped, const char *text, size_t length);

// Returns all groups and keys of the `length` bytes of a text, in their order, as a list of SbEntry
// that owns its elements; freed by g_ptr_array_unref(), never NULL. Comments and empty lines are
// skipped. Other lines and duplicate keys and groups become issues in which `shown` names the file;
// of a duplicate only its own line is omitted. A text that is not UTF-8 or contains a 0 is one
// issue and gives an empty list.
GPtrArray *sb_reader_scan(const char *text, size_t length, const char *shown, GPtrArray *issues);
