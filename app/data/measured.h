// A measured loop of force against displacement, read from a table of numbers
// (app/base/text_table.h) and made comparable with a run: SI units, compression positive,
// displacement increasing on the in-stroke, and the stem's own displacement from its rest position.
// SbMeasured states what was found in the data and how. Keys of the group [data NAME]
// (docs/measured-data.md) replace what would be found. Direction: friction dissipates energy, so
// the force is greater on the in-stroke; the canister's pressure pushes outwards, so the mean force
// is positive. Compliance: the slope of displacement against force before the first slip, while the
// stem is at rest. Zero: the displacement of these rows, and the mean force of the approach before
// them. Stages B to F: see measured_find.c. Without a column of displacement, it is speed times
// time up to the maximum force and back; then only the first cycle is used.
#pragma once

#include "app/base/text_table.h"
#include "app/document/data_keys.h"

#include "engine/valve/run/frame.h"

// Columns that are used.
typedef enum { SB_CHANNEL_TIME, SB_CHANNEL_DISPLACEMENT, SB_CHANNEL_FORCE, SB_CHANNELS } SbChannel;

// "time", "displacement" and "force".
extern const char *const sb_channel_names[SB_CHANNELS];

// Origin of a value.
typedef enum {
  SB_HOW_ASSUMED, // the data do not show it: the value of the file is used unchanged
  SB_HOW_FOUND,   // found in the data
  SB_HOW_SAID     // specified by a key of the group
} SbHow;

// A cycle: rows `begin` to turn - 1 are the in-stroke, rows `turn` to end - 1 the return. `turn` is
// the row of the largest force among the rows around and within 0.3 % of the largest displacement.
typedef struct {
  size_t begin, turn, end;
} SbMeasuredCycle;

// Largest number of cycles; further ones are ignored.
enum { SB_MEASURED_CYCLES_MAX = 100000 };

// A stage of the cycle, B to F, as seen in the data. Without `found` only `reason` has a value.
typedef struct {
  bool found;
  double displacement; // of the stem [m]
  double force;        // just before the event [N]
  double deviation;    // standard deviation of `force` by noise and by the distance of the rows [N]
  const char *reason;  // why it was not found; static. NULL if found
} SbMeasuredStage;

// A file that was read. The arrays and strings belong to this structure.
typedef struct {
  char *name; // of the file, without its folder
  // Format of the file.
  SbTextTableDialect dialect;
  size_t header_lines;   // number of lines before the first row
  SbTextTableRows lines; // rows of the file, and its lines that are not rows of the table
  struct {
    size_t at;  // number of the file's column, from 1; 0: the file has no such column
    char *name; // as the file's header has it
    char *unit; // as the file has it or a key states it; "clock": time of day
    bool clock; // the column has times of day
    SbHow how;  // origin of the assignment
  } column[SB_CHANNELS];
  size_t specimens; // pairs of displacement and force side by side, the first in use; 0: only one
  // Rows, in the order of the file. Displacement and force are corrected as above.
  size_t count;   // rows in use
  size_t dropped; // rows with an empty or unreadable cell, or that do not continue the table
  size_t tests;   // further tests below the first one, whose rows are in use with `cycle` alone
  bool jumps; // at a blank line or names time or displacement jumps, and yet the rows are in use
  union {
    struct {
      double *time;         // [count] [s]; NULL: no such column
      double *displacement; // [count], of the stem from its rest position, positive inwards [m]
      double *force;        // [count], on the stem, without load 0, compression positive [N]
    };
    double *value[SB_CHANNELS]; // the same arrays by SbChannel
  };
  double speed;    // of the crosshead, if it gives the displacement [m/s]; 0: a column does
  SbHow speed_how; // SB_HOW_ASSUMED: the speed of the scene's drive
  size_t behind;   // if `speed` > 0: rows after the first cycle; `count` does not include them
  // Corrections.
  SbHow direction, zero, force_zero, compliance; // origin of the values below
  bool turned_displacement, turned_force;        // the column's sign was reversed
  double at_rest; // subtracted from the displacement after reversal and compliance [m]
  double no_load; // subtracted from the force after reversal [N]
  size_t no_load_row, no_load_rows; // first row and number of the rows whose mean force is no_load
  double no_load_deviation;         // standard deviation of that mean by noise [N]; 0: not found
  double slope;                     // compliance: slope times corrected force is subtracted [m/N]
  GArray *cycle;                    // of SbMeasuredCycle, in the order of time; at least one
  size_t first, last;               // indices of the cycles in use, `last` included
  double noise; // standard deviation of the force's noise [N]; NaN: too few rows
  SbMeasuredStage stage[SB_STAGE_COUNT]; // of cycle `first`
} SbMeasured;

// Reads the `length` bytes of the file of the group `data`; NULL bytes: the file data->path, which
// is used for messages only otherwise and must not be NULL. `speed` is the speed of the scene's
// drive [m/s], for a file without displacement (0: the drive has none, see sb_data_drive_speed()).
// Returns NULL with at least one issue: the file cannot be read, is larger than 1 GiB, its format,
// columns or units are ambiguous or missing, fewer than 8 rows, no stroke, or a value out of range.
// `data` may be freed afterwards. Freed by sb_measured_free(). A list of cycles is an issue:
// sb_data_split() divides such a group first.
SbMeasured *sb_measured_read(const SbData *data, double speed, const void *bytes, size_t length,
                             GPtrArray *issues);

// Frees a measured loop.
void sb_measured_free(SbMeasured *measured);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbMeasured, sb_measured_free)

// Returns what was found, for the user, several lines that end with a newline: "separator
// semicolon, decimal comma, utf-8, 3 header lines".
char *sb_measured_text(const SbMeasured *measured);

// Returns what of the file is left out or in doubt, for the user, in one line. NULL: nothing.
char *sb_measured_doubts(const SbMeasured *measured);

// Returns what was found as lines "key = value" of a group [data], which fix it for later readings.
char *sb_measured_keys(const SbMeasured *measured);

// ---- Rows for a comparison: those where the stem slides ----

// A row, or the mean of neighbouring rows.
typedef struct {
  double displacement; // of the stem [m]
  double force;        // [N]
  double weight;       // number of rows in the mean
  int way;             // 0: in-stroke, 1: return
} SbMeasuredPoint;

// Returns the rows of the cycles in use, in the order of time, and their number in *count. Rows at
// rest, on the stop, and within 1 % of the stroke of either are left out. If the cycles have more
// rows than `count_max`, means of equally many neighbours on one stroke take their place (then up
// to two more points for each cycle). Freed by g_free().
SbMeasuredPoint *sb_measured_points(size_t *count, const SbMeasured *measured, size_t count_max);
