// Parameters of a scene from measured loops: a study file's [vary] are the priors, its [data] the
// curves.
//
// A curve is the scene with the values of its `set`, run with the parameters. The residuals are the
// differences of the force at equal displacement while the stem slides (app/data/measured.h). The
// break-away force, one number of a curve, is a residual if friction.static_ratio is fitted, which
// only it identifies. All curves share the parameters, except those that a curve's `own` names.
// Additional unknowns are each force's zero, if it was found in the data (with the deviation of
// this finding), and for solved contacts the numerical error of the forces that the model reports,
// one constant for each direction on either side of the land's edge. Fit, noise and posterior:
// inference.h. If a run takes more than some milliseconds, the posterior is that of the model
// linearised about the fit, and SB_CALIBRATION_CHECKS runs at samples measure the error of this;
// with solved rings the derivatives are those of their equations (sb_run_predict_from()).
//
// A difference that no values of the parameters remove is part of the noise, correlated along the
// loop (inference.h): it makes chi2_reduced exceed 1 and widens the intervals.
#pragma once

#include "app/data/compare.h"
#include "app/document/study_file.h"
#include "app/study/inference.h"

// Runs that check a linearised posterior; samples of the posterior; most points of a curve.
enum { SB_CALIBRATION_CHECKS = 20, SB_CALIBRATION_SAMPLES = 8000, SB_CALIBRATION_POINTS = 4000 };

// Bounds of SbIdentifiable: width of the interval divided by that of the prior's; correlation.
#define SB_IDENTIFIABLE_FRACTION    0.62
#define SB_IDENTIFIABLE_CORRELATION 0.7

// Whether the data identify a parameter.
typedef enum {
  SB_IDENTIFIABLE_YES,        // the interval is below 62 % of the prior's, no correlation above 0.7
  SB_IDENTIFIABLE_WITH_OTHER, // a correlation above 0.7
  SB_IDENTIFIABLE_NO          // the interval is that of the prior
} SbIdentifiable;

// Returns "yes", "with-other" or "no".
const char *sb_identifiable_name(SbIdentifiable identifiable);

// A fitted parameter. Values are [SI].
typedef struct {
  SbParamId id;
  int curve;                   // index of the only curve that has it; -1: all
  char *name;                  // its key; of a single curve "key@curve"
  double before;               // value of the scene
  double estimate;             // median of the posterior; without samples the best fit
  double deviation;            // standard deviation of the posterior; NaN: no samples
  double interval[2];          // 95 % interval of the posterior; NaN: no samples
  double prior[2];             // 95 % interval of the prior
  SbDistribution distribution; // the prior
  SbIdentifiable identifiable;
} SbCalibrated;

// A curve. Everything is owned by the calibration.
typedef struct {
  char *name;           // of its group, else its file
  SbMeasured *measured; // the data
  SbOverride *value;    // [values]: of the curve at the fit, `set` first, then the parameters
  size_t values;
  double before_rms;               // root mean square difference with the scene's values [N]
  double offset;                   // fitted correction of the force's zero [N]
  double noise;                    // standard deviation of the residuals [N]
  double spread;                   // number of correlated rows that count as one (inference.h)
  SbComparison *after;             // with the fitted model; NULL: the fitted stem does not slide
  SbLoop before_loop, after_loop;  // of the scene, and of the fitted model
  SbMeasuredBand prior, posterior; // contain 95 % of the model's loops; end 0: not computed
} SbCalibratedCurve;

// The result. Freed by sb_calibration_release().
typedef struct {
  // Interrupted: the estimates are the best so far. There are no bands, and samples only if all of
  // them were drawn before the interruption.
  bool partial;
  bool converged;            // the fit converged
  bool tangent;              // the posterior is that of the model linearised about the fit
  size_t parameters, curves; // numbers of the elements below
  size_t points;             // residuals of the curves
  size_t samples;            // of the posterior; 0: none
  size_t evaluations;        // runs of all curves
  SbCalibrated *parameter;   // [parameters]
  SbCalibratedCurve *curve;  // [curves]
  double *correlation;       // [parameters][parameters], of the samples
  double *sample;            // [samples][parameters] [SI]
  double accepted;           // fraction of the proposals that the sampler accepted
  double rms;                // of all residuals [N]
  double chi2; // mean square residual divided by the noise between neighbouring rows, per degree of
               // freedom
  double check_rms; // rms difference of linearised and computed curves at samples [N]; NaN: none
  char *sentence;   // what the data do and do not identify, for the user
  SbWarnings *warnings; // limits of validity of the runs at the fit; NULL: no run
} SbCalibration;

// How the work is done. Both callbacks may be NULL; `data` is passed to them.
typedef struct {
  int jobs;                      // number of threads, from 1
  bool (*cancelled)(void *data); // returns true to interrupt; called from any thread
  void (*progress)(void *data, double fraction); // receives the fraction done, 0 to 1; called in
                                                 // the calling thread
  void *data;
} SbCalibrateHooks;

// Adds the issues of a study for which sb_calibrate() would return SB_ERROR_INPUT with issues: on
// its priors, on its measured files and on the keys of its groups [data]. Nothing is computed.
void sb_calibrate_check(const SbStudyFile *study, GPtrArray *issues);

// Fits the parameters and samples the posterior. `study` must have groups [vary] and [data]; it is
// only read, but must outlive *out. Call sb_calibration_release() in any case. Returns SB_OK;
// SB_ERROR_INPUT with issues on the files or on [vary], or with the report alone if the stem does
// not slide with the scene's values; SB_ERROR_CANCELLED (out->partial if the fit had begun);
// SB_ERROR_NOT_CONVERGED (the fit has not converged, the result is complete); or the error of the
// first run.
SbStatus sb_calibrate(SbCalibration *out, const SbStudyFile *study, const SbCalibrateHooks *hooks,
                      GPtrArray *issues, SbReport *report);

// Frees what the result owns.
void sb_calibration_release(SbCalibration *calibration);

// Sets `deviation`, `interval` and `identifiable` of each parameter, and `correlation` and
// `sentence` (both NULL before) from the samples and the parameters' `prior`. Used by
// sb_calibrate().
void sb_calibration_identify(SbCalibration *calibration);

// Returns the text of the scene of curve `curve` (from 0) with the fitted values, comments on their
// origin, and the curve's data, for a file at `path`. Parameters that the data do not identify keep
// the scene's values; without a posterior every parameter has the best value so far. NULL with
// SB_APP_ERROR.
char *sb_calibration_scene(const SbCalibration *calibration, const SbStudyFile *study, size_t curve,
                           const char *path, GError **error);

// As sb_calibration_scene(), for the valve of the scene. Values of the curve's `set` are conditions
// of the measurement and are omitted.
char *sb_calibration_valve(const SbCalibration *calibration, const SbStudyFile *study, size_t curve,
                           const char *path, GError **error);
