// State of a calibration, shared by calibrate.c and calibrate_bands.c.
#pragma once

#include "app/study/calibrate.h"

// Coordinates for the numerical error of a solved contact's forces: one for each direction on
// either side of the land's edge.
enum { SB_CALIBRATE_NUMERIC = 4 };

// A curve. `z` are the coordinates of inference.h.
typedef struct {
  const SbData *data; // borrowed
  SbMeasured *measured;
  SbMeasuredPoint *point; // [points]: measured points that are compared
  size_t points;
  size_t first;                // index of its first residual
  bool breakaway;              // its last residual is that of the break-away force, stage B
  SbOverride set[SB_VARY_MAX]; // [sets]: values of its `set` [SI]
  size_t sets;
  size_t at[SB_VARY_MAX]; // [vary]: index of the coordinate of each parameter
  size_t zero;            // index of the coordinate of the force's zero; SIZE_MAX: known
  size_t numeric;         // index of the first of SB_CALIBRATE_NUMERIC coordinates; SIZE_MAX: none
  double error;           // standard deviation of the numerical error [N]
  double edge[2];         // displacement of the land's edge, in-stroke and return [m]
  SbRun *run;             // at the coordinates evaluated last, with its ring states; NULL: none
  SbRun *beside;          // at perturbed coordinates; NULL: none
  double z[SB_INFERENCE_COORDINATES]; // coordinates of `run`
  bool known;                         // `run` and `z` are valid
  SbLoop loop;                        // of `run`
} SbCalibrateCurve;

// The calibration.
typedef struct {
  const SbStudyFile *study;      // borrowed
  const SbCalibrateHooks *hooks; // borrowed
  SbCalibrateCurve *curve;       // [curves]
  size_t curves;
  size_t coordinates;                    // parameters first, then zeros and numerical errors
  size_t parameters;                     // number of the former
  size_t vary[SB_INFERENCE_COORDINATES]; // [parameters]: index into study->vary
  int owner[SB_INFERENCE_COORDINATES];   // [parameters]: curve that has it alone; -1: all
  size_t residuals;                      // of all curves
  bool rings;                            // rings are solved
  bool tangent;                          // the posterior is that of the linearised model
  bool full;                             // derivatives are computed from full solves
  bool ending; // interrupted: the remaining steps are done without asking `cancelled`
  size_t evaluations, expected; // runs of all curves so far; estimate of their final number
  SbStatus status;              // of the last run
  SbReport report;              // its problem
} SbCalibrateWork;

// Computes residual[residuals] of all curves [N] at z[coordinates]; the curves' loops are then
// those of z. `data` is the SbCalibrateWork. Returns false if cancelled. The `evaluate` of
// inference.h.
bool sb_calibrate_evaluate(void *data, double *residual, const double *z);

// Computes runs at draws of the prior (`prior`), or at samples of the posterior in equal distances,
// and from these the bands of the curves in `out` and, for a linearised posterior, out->check_rms.
// Returns false if cancelled.
bool sb_calibrate_draws(SbCalibration *out, SbCalibrateWork *work, const SbInference *found,
                        bool prior);
