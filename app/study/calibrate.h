// Parameters of a scene from measured loops: a study file's [vary] as priors, its [data] as curves.
//
// A curve is the scene with the values of its `set`, run with the parameters; what is compared is
// the force at equal displacement while the stem slides (app/data/measured.h). The break-away, one
// number of a curve, enters where friction.static_ratio is fitted, which it alone tells. Parameters
// are shared by all curves but for those that a curve's `own` names. Unknown beside them is each
// force's zero where it was found in the data, to the deviation it was found with, and where the
// model is solved, the error it tells of its forces, constant each way on either side of the land's
// edge. Fit, noise and posterior: inference.h. Where a run takes more than some milliseconds the
// posterior is that of the tangent at the fit, and SB_CALIBRATION_CHECKS runs at samples tell what
// that leaves out; with solved rings the tangent is that of their equations
// (sb_run_predict_from()).
//
// What a model cannot follow whatever its parameters is a part of the noise, correlated along the
// loop (inference.h): it shows in chi2_reduced, beyond 1, and widens the intervals.
#pragma once

#include "app/data/compare.h"
#include "app/document/study_file.h"
#include "app/study/inference.h"

enum { SB_CALIBRATION_CHECKS = 20, SB_CALIBRATION_SAMPLES = 8000, SB_CALIBRATION_POINTS = 4000 };

#define SB_TOLD_SHARE       0.62
#define SB_TOLD_CORRELATION 0.7

typedef enum {
  SB_TOLD_YES,        // the interval is below 62 % of the prior's, no correlation above 0.7
  SB_TOLD_WITH_OTHER, // a correlation above 0.7
  SB_TOLD_NO          // the prior's interval stands
} SbTold;

// "yes", "with-other", "no"; borrowed.
const char *sb_told_name(SbTold told);

typedef struct {
  SbParamId id;
  int curve;                                       // whose own it is; -1: of all
  char *name;                                      // key, of an own one "key@curve"
  double before, estimate, deviation, interval[2]; // SI; interval of 95 %
  double prior[2];                                 // interval of 95 % before
  SbDistribution distribution;                     // prior
  SbTold told;
} SbCalibrated;

typedef struct {
  char *name;           // of its group, else its file
  SbMeasured *measured; //
  SbOverride *value;    // [values] of the curve at the fit: `set`, then parameters
  size_t values;        //
  double before_rms;    // [N]
  double offset;        // of the force's zero at the fit [N]
  double noise;         // of the residuals [N]
  double spread;        // rows that count as one, as they are correlated (inference.h)
  SbComparison *after;  // NULL: the fitted stem does not slide
  SbLoop before_loop, after_loop;
  SbMeasuredBand prior, posterior; // hold 95 % of the model's loops; end 0: not known
} SbCalibratedCurve;

typedef struct {
  // Interrupted: the estimates are the best so far. There are no bands, and samples only if all of
  // them were taken before the interruption.
  bool partial;
  bool converged, tangent; // tangent: the posterior is that of the fit's tangent
  size_t parameters, curves, points, samples, evaluations;
  SbCalibrated *parameter;
  SbCalibratedCurve *curve;
  double *correlation; // [parameters][parameters] of the samples
  double *sample;      // [samples][parameters], SI
  double accepted;     // share of proposals
  double rms;          // of all residuals [N]
  double chi2;      // mean square over the noise between neighbouring rows, per degree of freedom
  double check_rms; // of a tangent's curves from solved ones at samples [N]; NaN: not asked
  char *sentence;   // what these data cannot tell
  SbWarnings *warnings; // of validity, of the runs at the fit; NULL without any run
} SbCalibration;

// Fits and samples; *out is to be released in any case. SB_ERROR_CANCELLED with `partial` where the
// fit had begun. False with issues: of the files, or of
// what [vary] says.
typedef struct {
  int jobs;
  bool (*cancelled)(void *data);
  void (*progress)(void *data, double fraction);
  void *data;
} SbCalibrateHooks;
SbStatus sb_calibrate(SbCalibration *out, const SbStudyFile *study, const SbCalibrateHooks *hooks,
                      GPtrArray *issues, SbReport *report);
void sb_calibration_release(SbCalibration *calibration);

// Intervals, correlations, what is told and the sentence, from the samples and the priors.
void sb_calibration_tell(SbCalibration *calibration);

// The scene of a curve as it was fitted, with its origin in comments and its data, for a file at
// `path`. Parameters that the data do not tell keep their values; without a posterior every
// parameter has the best value so far. Owned by the caller.
char *sb_calibration_scene(const SbCalibration *calibration, const SbStudyFile *study, size_t curve,
                           const char *path, GError **error);

// The valve of the scene with the fitted parameters in place of its own, for a file at `path`; the
// values of the curve's `set` are conditions of the measurement and are left out. Owned by the
// caller.
char *sb_calibration_valve(const SbCalibration *calibration, const SbStudyFile *study, size_t curve,
                           const char *path, GError **error);
