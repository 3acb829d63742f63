// The groups [data] and [data NAME] of scenes and studies: measured files, and what of their
// reading is said rather than found. Texts as they stand in the file; app/data reads them.
#pragma once

#include "app/base/issue.h"
#include "app/base/unit.h"

// code, key
#define SB_DATA_KEYS(X)                                                                            \
  X(SB_DATA_FILE, "file")                                                                          \
  X(SB_DATA_SIGNAL, "signal")                                                                      \
  X(SB_DATA_SEPARATOR, "separator")                                                                \
  X(SB_DATA_DECIMAL, "decimal")                                                                    \
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

typedef enum {
#define SB_DATA_KEY_ENUM(code, name) code,
  SB_DATA_KEYS(SB_DATA_KEY_ENUM)
#undef SB_DATA_KEY_ENUM
      SB_DATA_KEY_COUNT
} SbDataKey;

enum { SB_DATA_MAX = 64 };

// One group.
typedef struct {
  char *name;                    // behind "data "; empty of [data] alone
  char *path;                    // of its file, to open
  char *text[SB_DATA_KEY_COUNT]; // NULL: not said
  char *shown;                   // the file that has the group
  int line;
} SbData;

// Borrowed.
const char *sb_data_key_name(SbDataKey key);

// "data" or "data NAME".
bool sb_data_is_group(const char *group);

// Reads those of a scanned file (of SbEntry); what `directory` is to the files' names (NULL: the
// current one). A list that frees its SbData, owned by the caller.
GPtrArray *sb_data_read(const GPtrArray *entries, const char *directory, const char *shown,
                        GPtrArray *issues);

// Makes of each group with several cycles, `cycle = 1, 10, 40`, one for each cycle: "lot 1",
// "lot 10", "lot 40".
void sb_data_part(GPtrArray *list, GPtrArray *issues);

// One of a file that no group names; owned by the caller.
SbData *sb_data_of_file(const char *path);
void sb_data_free(gpointer data); // takes NULL
SbData *sb_data_copy(const SbData *data);

// Whether both say the same of one file, or are both NULL.
bool sb_data_same(const SbData *a, const SbData *b);

// The keys of a group as lines "key = value" of a text (sb_measured_keys()), in place of those
// that the text has; unknown ones are passed over.
void sb_data_take_keys(SbData *data, const char *text);

// "[data lot-2] columns: TEXT" as an issue.
void sb_data_complain(const SbData *data, SbDataKey key, const char *allowed, GPtrArray *issues,
                      const char *format, ...) G_GNUC_PRINTF(5, 6);
