// A calibration at work, shared by calibrate.c and calibrate_bands.c.
#pragma once

#include "app/study/calibrate.h"

// A solved contact's error is its mesh's: one for each way, on either side of the land's edge.
enum { SB_CALIBRATE_NUMERIC = 4 };

typedef struct {
  const SbData *data;
  SbMeasured *measured;
  SbMeasuredPoint *point;
  size_t points, first; // first: of its residuals
  bool breakaway;       // its last residual is that of B
  SbOverride set[SB_VARY_MAX];
  size_t sets;
  size_t at[SB_VARY_MAX]; // coordinate of each of [vary]
  size_t zero;            // coordinate of the force's zero, SIZE_MAX: known
  // The first of SB_CALIBRATE_NUMERIC for the forces' numerical error, SIZE_MAX: none; its
  // deviation [N], and where the land's edge parts the strokes [m].
  size_t numeric;
  double error, edge[2];
  // The run at the place last evaluated, with its rings; and one beside it.
  SbRun *run, *beside;
  double z[SB_INFERENCE_COORDINATES];
  bool known;
  SbLoop loop;
} SbCalibrateCurve;

typedef struct {
  const SbStudyFile *study;
  const SbCalibrateHooks *hooks;
  SbCalibrateCurve *curve;
  size_t curves;
  size_t coordinates, parameters; // parameters come first, then zeros
  size_t vary[SB_INFERENCE_COORDINATES];
  int owner[SB_INFERENCE_COORDINATES];
  size_t residuals;
  bool rings, tangent;
  bool full;   // derivatives are those of full solves
  bool ending; // interrupted: what is left is done all the same
  size_t evaluations, expected;
  SbStatus status; // of the last run
  SbReport report; // where it failed
} SbCalibrateWork;

// Residuals of all curves at z, whose loops stay; an evaluation of inference.h.
bool sb_calibrate_evaluate(void *data, double *residual, const double *z);

// Runs at draws of the prior or at samples, evenly taken: the model's bands, and what a tangent
// leaves out. False: cancelled.
bool sb_calibrate_draws(SbCalibration *out, SbCalibrateWork *work, const SbInference *found,
                        bool prior);
