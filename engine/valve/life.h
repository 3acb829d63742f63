// A valve's life: many actuations while the rings' roughness runs in, leakage added up.
//
// The roughness (or the product of tip density, tip radius and height that stands for it) falls
// from its value when new to its value when run in as exp(-n/actuations). Literature in the thesis
// gives 1.7 um new and 0.2 um run in (Rana); how fast is not given: an input. What one actuation
// does at a given roughness comes from the caller's model of the cycle. A stem that does not return
// ends the life: there is no stroke left; so does one of which that is not known. Leaves out: wear
// of the section, swelling, propellant loss between actuations (leak/).
#pragma once

#include "engine/base/status.h"

typedef struct {
  double start, end; // roughness measure, new and run in; the same unit, >= 0
  double actuations; // e-folding number, > 0
} SbRunningIn;

// What one actuation yields.
typedef struct {
  double roughness;       // as sb_life_roughness gives it; filled by sb_life_run
  double lambda;          // film over roughness
  double leakage;         // net, m3
  double carried;         // out under the film on the way in, m3
  double force_peak;      // N
  double force_breakaway; // at the first slip, N; NaN if there was none
  double force_return;    // least, N
  double returned;        // 1: the stem comes back to rest, 0: it does not; NaN: not known
} SbLifeActuation;

typedef struct {
  long done;                    // actuations computed
  double leakage;               // sum, m3; NaN like `carried` for a life that ended before its time
  double carried;               // sum, m3
  double peak_first, peak_last; // the last NaN for such a life
  double return_least;          // over the life, N; NaN if no actuation has one
  long failure;                 // number from 1 of the actuation without return, 0 if none
} SbLife;

// Roughness before actuation n (n = 0 is the first).
double sb_life_roughness(const SbRunningIn *law, long n);

// Runs `count` actuations in order. `actuate` fills one actuation for a roughness and may fail (the
// life ends there with that status, `life` holding what was done); one that is not known to return
// is the last, which is SB_OK. each[count] (may be NULL) keeps
// every actuation. `cancelled` (may be NULL) is asked before each.
SbStatus sb_life_run(SbLife *life, SbLifeActuation *each, const SbRunningIn *law, long count,
                     SbStatus (*actuate)(SbLifeActuation *out, long n, double roughness, void *user,
                                         SbReport *report),
                     bool (*cancelled)(void *user), void *user, SbReport *report);
