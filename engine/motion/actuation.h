// One actuation by dynamics.h, told as the thesis tells it: stages A to F, peaks, return, energy.
//
// Stages by event (contract): A start; B the stem breaks away, the last contact that still held it
// slips; C the stem crosses the land edge inwards; D first touch of the end stop; E the first slip
// backwards of everything after D; F the edge outwards. A stage's force is the drive's just before
// the event. Errors of a run that needs the numerical path are estimated by a second run at ten
// times the tolerance: with break-away in the cycle a sum of local errors says little (tested), one
// and a half times the difference of two runs is honest. SI units.
#pragma once

#include "engine/motion/dynamics.h"

typedef struct {
  bool passed;
  double time, position, force;
} SbActuationStage;

enum { SB_ACTUATION_STAGES = 6 };

typedef struct {
  double until;  // s
  size_t frames; // samples, evenly over (0, until], at least 1
  int land_edge; // index of the edge of C and F, -1: none
  int end_stop;  // index of the stop of D, -1: none
  int rest_stop; // index of the stop that the stem should return to, -1: start position
  bool estimate; // second run for the errors (only if the numerical path was used)
  bool (*cancelled)(void *user); // polled at every frame; may be NULL
  void *user;
} SbActuationOptions;

typedef struct {
  SbActuationStage stage[SB_ACTUATION_STAGES];
  double force_peak;       // largest drive force before D (or all, if D is not reached), N
  double force_breakaway;  // at B; 0 if the stem never slips
  double force_return_min; // least (outward load - sliding friction) on the way back from D, N
  bool left_stop;          // whether there was a way back; else it is taken where the run ended
  bool returns;            // at rest on the rest stop at the end, the drive not touching
  SbDynamicsEnergy energy;
  SbDynamicsCounters counters;
  double end_time, end_position;
  double error_position; // m, over the frames
  double error_force;    // N, of force_peak
  double error_energy;   // J, of the friction work
} SbActuation;

// Runs a model. sample[frames] and energy[frames] (either may be NULL) receive the frames. On
// failure the stages, counters and frames so far (*done, may be NULL) are kept.
SbStatus sb_actuation_run(SbActuation *actuation, SbDynamicsSample *sample,
                          SbDynamicsEnergy *energy, size_t *done, const SbDynamicsModel *model,
                          const SbActuationOptions *options, SbReport *report);
