// What moves the stem: the position of a machine's platen or the force of a finger, against time.
//
// Every drive but the sinusoid is straight between its breaks, so that the motion between them has
// a closed form. A machine that goes to a place and back at constant speed is a press of its
// platen's position. SI units, positive into the canister. Source: thesis 3.5 (machine,
// 20 mm/min); the hand's press-and-release is ours.
#pragma once

#include "engine/base/status.h"

typedef enum {
  SB_DRIVE_NONE,  // nothing pushes: free return
  SB_DRIVE_PRESS, // `start` to `end` in `rise`, `hold` (INFINITY: a ramp), back in `fall`
  SB_DRIVE_SINE,  // start + amplitude sin(2 pi frequency t + phase)
  SB_DRIVE_TABLE, // straight lines between measured points, the ends held
} SbDriveKind;

typedef enum { SB_DRIVE_OF_POSITION, SB_DRIVE_OF_FORCE } SbDriveQuantity;

typedef struct {
  SbDriveKind kind;
  SbDriveQuantity quantity;
  double start, end;                  // m or N
  double rise, hold, fall;            // PRESS: s
  int cycles;                         // PRESS: repeats, at least 1
  double pause;                       // PRESS: s between repeats
  double amplitude, frequency, phase; // m or N, Hz, rad
  const double *time, *value;         // TABLE: s (strictly increasing), m or N; borrowed
  size_t count;
} SbDrive;

typedef enum {
  SB_DRIVE_FORWARD,
  SB_DRIVE_HOLD,
  SB_DRIVE_BACK,
  SB_DRIVE_PAUSE,
  SB_DRIVE_DONE,
} SbDrivePhase;

typedef struct {
  SbDrivePhase phase;
  double since, from; // time [s] and value [m or N] at the start of the phase
  int cycle;
  size_t cursor;
} SbDriveState;

// The drive on one piece of time: value + rate (t - at) until `until`, or a sinusoid.
typedef struct {
  double at, until;   // s
  double value, rate; // m or N, per s
  bool curved;        // sinusoid: value and rate hold at `at` only
  double step;        // s, which steps should not exceed then
} SbDrivePiece;

// Refuses a drive that makes no sense, naming what is wrong.
SbStatus sb_drive_check(const SbDrive *drive, SbReport *report);

// State at time t = 0.
void sb_drive_start(SbDriveState *state, const SbDrive *drive);

// The piece that holds at time t and on to `until` (> t, maybe INFINITY). Time never runs
// backwards.
void sb_drive_piece(SbDrivePiece *piece, SbDriveState *state, const SbDrive *drive, double t);

// Value and rate of a sinusoid at t.
void sb_drive_sine(const SbDrive *drive, double t, double *value, double *rate);
