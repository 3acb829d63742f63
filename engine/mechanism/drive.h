// The drive of the stem as a function of time: the position of a machine's platen, or the force of
// a finger. Position and force are positive into the canister.
//
// Every drive except the sinusoid is piecewise linear in time. Source: thesis 3.5 (machine, 20
// mm/min); the press of a finger is our choice. The functions have no state of their own and may be
// called concurrently.
#pragma once

#include "engine/base/status.h"

// Time function of a drive.
typedef enum {
  SB_DRIVE_NONE,  // no drive: free return
  SB_DRIVE_PRESS, // from `start` to `end` in `rise`, constant for `hold`, back in `fall`
  SB_DRIVE_SINE,  // start + amplitude sin(2 pi frequency t + phase)
  SB_DRIVE_TABLE, // linear between given points, constant before the first and after the last
} SbDriveKind;

// What the time function describes.
typedef enum {
  SB_DRIVE_OF_POSITION, // position of the platen [m]
  SB_DRIVE_OF_FORCE     // force on the stem [N]
} SbDriveQuantity;

// A drive. Values have the unit of `quantity`, m or N. Fields that are marked with another kind are
// not used and may be 0.
typedef struct {
  SbDriveKind kind;
  SbDriveQuantity quantity;
  double start;                       // PRESS: value at rest; SINE: mean value; else 0
  double end;                         // PRESS: value when pressed
  double rise, hold, fall;            // PRESS [s], rise and fall > 0; hold INFINITY: no return
  int cycles;                         // PRESS: number of presses, at least 1
  double pause;                       // PRESS: time between presses [s]
  double amplitude, frequency, phase; // SINE: [m] or [N], [Hz] > 0, [rad]
  const double *time, *value;         // TABLE: [count], time strictly increasing [s]; borrowed
  size_t count;                       // TABLE: points, at least 2
} SbDrive;

// Phase of a press.
typedef enum {
  SB_DRIVE_FORWARD, // from start to end
  SB_DRIVE_HOLD,    // at end
  SB_DRIVE_BACK,    // from end to start
  SB_DRIVE_PAUSE,   // at start, before the next press
  SB_DRIVE_DONE,    // at start, after the last press
} SbDrivePhase;

// Position in the time function; set by sb_drive_start(), the fields are private.
typedef struct {
  SbDrivePhase phase;
  double since, from; // time [s] and value at the start of the phase
  int cycle;          // presses completed
  size_t cursor;      // TABLE: next point
} SbDriveState;

// The drive in an interval of time: value + rate (t - at) from `at` to `until`, or a sinusoid.
typedef struct {
  double at, until;   // reference time and end of the interval [s]
  double value, rate; // value at `at` [m] or [N], and its time derivative [m/s] or [N/s]
  bool curved;        // sinusoid: value and rate are those at `at`, see sb_drive_sine()
  double step;        // sinusoid: recommended upper limit of time steps [s]
} SbDrivePiece;

// Checks a drive. SB_ERROR_RANGE or SB_ERROR_INPUT, with the field and its range.
SbStatus sb_drive_check(const SbDrive *drive, SbReport *report);

// Sets *state to time t = 0.
void sb_drive_start(SbDriveState *state, const SbDrive *drive);

// Writes to *piece the interval that contains the time t [s]; its `until` is after t, possibly
// INFINITY. *state advances: t must not decrease from call to call. `drive` must have passed
// sb_drive_check(). SB_DRIVE_NONE: value and rate are 0, `until` is INFINITY.
void sb_drive_piece(SbDrivePiece *piece, SbDriveState *state, const SbDrive *drive, double t);

// Writes value and time derivative of a drive of kind SB_DRIVE_SINE at time t [s].
void sb_drive_sine(const SbDrive *drive, double t, double *value, double *rate);
