// State of a calibration, shared by calibrate.c, calibrate_read.c (what the file states),
// calibrate_runs.c (runs, residuals, derivatives) and calibrate_bands.c.
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

// Returns parameter k of the study's `vary`, borrowed from the study.
const SbVary *sb_calibrate_vary(const SbCalibrateWork *work, size_t k);

// Returns the value [SI] of a parameter, given by its coordinate, at a standard normal variate z.
double sb_calibrate_value(const SbCalibrateWork *work, size_t coordinate, double z);

// ---- What the file states (calibrate_read.c) ----

// Returns whether each varied parameter has a prior; if not, adds an issue.
bool sb_calibrate_check_vary(const SbCalibrateWork *work, GPtrArray *issues);

// Reads the measured data of a curve, whose `data` is set, and sets what it states about the curve:
// `measured`, `point`, `set` and `breakaway`. Returns false with an issue.
bool sb_calibrate_read_curve(SbCalibrateCurve *curve, const SbCalibrateWork *work,
                             GPtrArray *issues);

// Assigns the coordinates of parameters, zeros and numerical errors, and the residuals of all
// curves, which were read. Returns false with an issue if there are too many coordinates.
bool sb_calibrate_lay_out(SbCalibrateWork *work, GPtrArray *issues);

// Returns the standard normal variate of a value [SI] under its prior, within +-3 for a normal one;
// 0 outside of the other priors.
double sb_calibrate_variate(const SbDistribution *of, double value);

// ---- Runs (calibrate_runs.c) ----

// Writes the overrides of a curve at z[coordinates] (`set` and the parameters) and returns their
// number, at most 2 SB_VARY_MAX.
size_t sb_calibrate_overrides(SbOverride *out, const SbCalibrateWork *work,
                              const SbCalibrateCurve *curve, const double *z);

// Runs a curve's valve with override[overrides] into *run, which is created if it is NULL, else
// replaced, and takes curve->loop from *run. If `base` is not NULL, the rings are linearised about
// those of `base`. The loop is empty if the values are infeasible. Returns false if cancelled or
// without memory; work->status and work->report have the problem.
bool sb_calibrate_run_at(SbCalibrateWork *work, SbCalibrateCurve *curve, SbRun **run,
                         const SbRun *base, const SbOverride *override, size_t overrides);

// Computes curve->run at z[coordinates] unless it is the run at z already. Returns as
// sb_calibrate_run_at().
bool sb_calibrate_settle(SbCalibrateWork *work, SbCalibrateCurve *curve, const double *z);

// Writes the derivatives of residual[residuals], which sb_calibrate_evaluate() computed at
// z[coordinates], to jacobian[residuals][coordinates] by differences. `data` is the
// SbCalibrateWork. Returns false if cancelled. The `differentiate` of inference.h.
bool sb_calibrate_differentiate(void *data, double *jacobian, const double *z,
                                const double *residual);

// As sb_calibrate_differentiate(), with full solves in place of linearised ones where rings are
// solved. The `differentiate_fit` of inference.h.
bool sb_calibrate_differentiate_fit(void *data, double *jacobian, const double *z,
                                    const double *residual);

// Computes residual[residuals] of all curves [N] at z[coordinates]; the curves' loops are then
// those of z. `data` is the SbCalibrateWork. Returns false if cancelled. The `evaluate` of
// inference.h.
bool sb_calibrate_evaluate(void *data, double *residual, const double *z);

// ---- Bands (calibrate_bands.c) ----

// Computes runs at draws of the prior (`prior`), or at samples of the posterior in equal distances,
// and from these the bands of the curves in `out` and, for a linearised posterior, out->check_rms.
// Returns false if cancelled.
bool sb_calibrate_draws(SbCalibration *out, SbCalibrateWork *work, const SbInference *found,
                        bool prior);
