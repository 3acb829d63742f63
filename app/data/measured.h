// A measured loop of force over displacement, from any table of numbers (app/base/table.h), made
// comparable with a run: SI, compression positive, the in-stroke growing, the stem's own
// displacement from where it rests. What of that was found in the data, and how, is kept beside it
// and told; what a group [data NAME] says stands instead:
//
//   signal = force over displacement
//   separator = comma | semicolon | tab | blank     decimal = point | comma
//   encoding = utf-8 | latin-1 | utf-16le | utf-16be
//   columns = time, displacement, -, force          in the file's order, - for others
//   units = s, mm, -, N
//   speed = 20 mm/min                                of the crosshead, without a displacement
//   direction = as-is | force | displacement | both  which of them to turn round
//   zero = as-is | 0.31 mm, 0.2 N                    readings at rest and without a load
//   compliance = none | 0.012 mm/N                   of the machine between crosshead and stem
//   cycle = all | 2                                  calibrate: 1, 10, 40, a curve each
//   actuation = 1                                    calibrate: since new, of the file's first
//   cycle
//
// Direction: friction takes energy out, so the force is greater on the way in; canister pressure
// pushes out, so its mean is positive. Compliance: the slope of displacement over force while the
// stem still rests, before the first slip. Zero: the displacement there, the force of the approach
// before it. Stages B to F: see measured_find.c. Without a column of displacement, time alone makes
// it at a constant speed, out to the greatest force and back: that of one cycle, as where the next
// begins the time does not show.
#pragma once

#include "app/base/table.h"
#include "app/document/data_keys.h"

#include "engine/valve/run/frame.h"

typedef enum { SB_CHANNEL_TIME, SB_CHANNEL_DISPLACEMENT, SB_CHANNEL_FORCE, SB_CHANNELS } SbChannel;

// Borrowed.
const char *sb_channel_name(SbChannel channel);

typedef enum {
  SB_HOW_ASSUMED, // the data do not show it: taken as it is in the file
  SB_HOW_FOUND,   // in the data
  SB_HOW_SAID     // by a key
} SbHow;

// Rows of a cycle: the in-stroke from `begin`, the return from `turn` to before `end`.
typedef struct {
  size_t begin, turn, end;
} SbMeasuredCycle;

enum { SB_MEASURED_CYCLES_MAX = 100000 };

typedef struct {
  bool found;
  double displacement, force; // SI
  double deviation;           // of the force, by noise and distance of the rows [N]
  const char *reason;         // why it was not found; static
} SbMeasuredStage;

typedef struct {
  char *name; // of the file, for people
  // What the file is.
  SbTableDialect dialect;
  size_t header_lines, skipped;
  int skipped_line;
  char *skipped_text;
  struct {
    int index; // in the file, from 0; -1: none
    char *name, *unit;
    SbHow how;
  } column[SB_CHANNELS];
  // Rows.
  size_t count, dropped; // dropped: rows with an empty or unreadable cell
  double *time;          // [s], NULL without
  double *displacement;  // of the stem [m]
  double *force;         // [N]
  double speed;          // that made the displacement of the time [m/s]; 0: a column did
  SbHow speed_how;       // assumed: the drive's
  size_t behind;         // rows behind the one cycle of a time, left out
  // What was found or said.
  SbHow direction, zero, force_zero, compliance;
  bool turned_displacement, turned_force;
  double at_rest;                   // crosshead's reading, in the file's direction turned [m]
  double no_load;                   // force's reading [N]
  size_t no_load_row, no_load_rows; // it is the mean of so many from there
  double no_load_deviation; // its standard deviation by the noise, 0 where it is not found [N]
  double slope;             // compliance [m/N]
  GArray *cycle;            // of SbMeasuredCycle
  size_t first, last;       // cycles in use, last included
  double noise;             // standard deviation of the force [N]
  SbMeasuredStage stage[SB_STAGE_COUNT]; // of the first cycle in use
} SbMeasured;

// Reads a group's file; `speed` is that of the drive beside it [m/s], for a record over time alone
// (0: the drive has none). NULL with at least one issue. Owned by the caller.
SbMeasured *sb_measured_load(const SbData *data, double speed, GPtrArray *issues);

// The same from memory.
SbMeasured *sb_measured_parse(const SbData *data, double speed, const void *bytes, size_t length,
                              GPtrArray *issues);

// The speed of the drive with these values of drive.kind and drive.speed; 0 but for the machine.
double sb_measured_speed(double kind, double speed);

// Takes NULL.
void sb_measured_free(SbMeasured *measured);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbMeasured, sb_measured_free)

// What was recognised, a line each, as people read it: "separator  semicolon". Owned by the caller.
char *sb_measured_text(const SbMeasured *measured);

// The same as keys of a group [data], which make it what is said. Owned by the caller.
char *sb_measured_keys(const SbMeasured *measured);

// ---- Rows that can be compared: the stem slides, both ways ----

typedef struct {
  double displacement, force; // means
  double weight;              // rows that they are of
  int way;                    // 0 in-stroke, 1 return
} SbMeasuredPoint;

// Those of the cycles in use, in order; more than `count_max` become means of as many neighbours.
// Rows at rest, on the stop and within 1 % of the stroke of either are left out. Owned by the
// caller (g_free).
SbMeasuredPoint *sb_measured_points(size_t *count, const SbMeasured *measured, size_t count_max);

// Least and greatest force of the cycles in use in equal pieces of the stroke up to `end`; NaN in a
// piece without a row.
enum { SB_MEASURED_BAND = 200 };
typedef struct {
  double end;                           // [m]
  double force[2][SB_MEASURED_BAND][2]; // way; least, greatest [N]
} SbMeasuredBand;
void sb_measured_band(SbMeasuredBand *out, const SbMeasured *measured);
