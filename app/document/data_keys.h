// The groups [data] and [data NAME] of scenes and studies: a measured file each, and keys that
// state what would otherwise be found in the data (docs/measured-data.md explains the keys,
// app/data/measured.h reads the file). Here the keys are texts as in the file.
#pragma once

#include "app/base/issue.h"
#include "app/base/unit.h"

// X(enumerator, key in the file): the keys of a group.
#define SB_DATA_KEYS(X)                                                                            \
  X(SB_DATA_FILE, "file")                                                                          \
  X(SB_DATA_SIGNAL, "signal")                                                                      \
  X(SB_DATA_SEPARATOR, "separator")                                                                \
  X(SB_DATA_DECIMAL, "decimal")                                                                    \
  X(SB_DATA_DATES, "dates")                                                                        \
  X(SB_DATA_ENCODING, "encoding")                                                                  \
  X(SB_DATA_COLUMNS, "columns")                                                                    \
  X(SB_DATA_UNITS, "units")                                                                        \
  X(SB_DATA_SPEED, "speed")                                                                        \
  X(SB_DATA_ZERO, "zero")                                                                          \
  X(SB_DATA_DIRECTION, "direction")                                                                \
  X(SB_DATA_COMPLIANCE, "compliance")                                                              \
  X(SB_DATA_CYCLE, "cycle")                                                                        \
  X(SB_DATA_ACTUATION, "actuation")                                                                \
  X(SB_DATA_SET, "set")                                                                            \
  X(SB_DATA_OWN, "own")

// A key of a group.
typedef enum {
#define SB_DATA_KEY_ENUM(code, name) code,
  SB_DATA_KEYS(SB_DATA_KEY_ENUM)
#undef SB_DATA_KEY_ENUM
      SB_DATA_KEY_COUNT
} SbDataKey;

// Largest number of groups of a file.
enum { SB_DATA_MAX = 64 };

// One group. Freed by sb_data_free().
typedef struct {
  char *name;                    // after "data "; empty for [data]
  char *path;                    // of the measured file, ready to be opened; NULL: no key `file`
  char *text[SB_DATA_KEY_COUNT]; // value of each key as in the file; NULL: absent
  char *shown;                   // the file that contains the group, for messages
  int line;                      // of the group in that file, from 1; 0: none
} SbData;

// Texts of the keys `separator`, `decimal`, `dates` and `direction`, each list ended by NULL.
// Directions: bit 0 of the index is set if the force is reversed, bit 1 if the displacement is.
extern const char *const sb_data_separators[], *const sb_data_decimals[];
extern const char *const sb_data_dates[], *const sb_data_directions[];

// Returns the number in `words` (ended by NULL) of a key's text, counted from 1 (the index above is
// this number minus 1); 0 for an absent key, and for another text, which is an issue.
size_t sb_data_word(const SbData *data, SbDataKey key, const char *const *words, GPtrArray *issues);

// Returns the constant speed [m/s] of a drive with the values `kind` of drive.kind (an
// SbDriveChoice) and `speed` of drive.speed [m/s]: the latter of the test machine, 0 of other
// drives.
double sb_data_drive_speed(double kind, double speed);

// Returns the name of a key ("columns").
const char *sb_data_key_name(SbDataKey key);

// Returns whether the name of a group is "data" or "data NAME".
bool sb_data_is_group(const char *group);

// Returns the groups among the entries (of SbEntry, app/base/reader.h) of a file as an array of
// SbData that owns its elements, in the order of the file. Relative file names start in `directory`
// (NULL: the current one); `shown` names the file in issues. Never NULL: groups with an issue stay
// in the array (without a file their `path` is NULL), groups after the first SB_DATA_MAX are left
// out.
GPtrArray *sb_data_read(const GPtrArray *entries, const char *directory, const char *shown,
                        GPtrArray *issues);

// Replaces in `list` (of SbData) each group that names several cycles, `cycle = 1, 10, 40`, by one
// group for each of them: "lot 1", "lot 10", "lot 40". A group whose division would exceed
// SB_DATA_MAX groups stays undivided and becomes an issue.
void sb_data_split(GPtrArray *list, GPtrArray *issues);

// Returns a group for the file `path` without any other key, as if a scene contained it. Freed by
// sb_data_free().
SbData *sb_data_of_file(const char *path);

// Frees a group (SbData *). The type fits GDestroyNotify.
void sb_data_free(gpointer data);

// Returns a copy. Freed by sb_data_free().
SbData *sb_data_copy(const SbData *data);

// Returns whether both groups have the same file and the same keys, or are both NULL. A group must
// have a path; names are not compared.
bool sb_data_same(const SbData *a, const SbData *b);

// Sets keys from `text`, lines "key = value" as sb_measured_keys() returns them. Keys that `text`
// does not contain keep their values; unknown keys and `file` are ignored.
void sb_data_set_keys(SbData *data, const char *text);

// Appends an issue on a key of the group, "[data lot-2] columns: TEXT". `allowed` is the allowed
// range or NULL. Always returns false, as sb_issues_add().
bool sb_data_add_issue(const SbData *data, SbDataKey key, const char *allowed, GPtrArray *issues,
                       const char *format, ...) G_GNUC_PRINTF(5, 6);

// As sb_data_add_issue(), for a problem that one of the values of the key resolves:
// sb_issues_add_choice() with its remedy.
bool sb_data_add_choice(const SbData *data, SbDataKey key, const char *values, GPtrArray *issues,
                        const char *format, ...) G_GNUC_PRINTF(5, 6);
