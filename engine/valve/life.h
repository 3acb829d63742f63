// A valve's life: many actuations while the rings' roughness runs in, leakage added up
// (run/run_life.c). A stem that does not return ends it.
#pragma once

// Roughness before actuation n, 0 the first: end + (start - end) exp(-n/actuations).
typedef struct {
  double start, end; // roughness over the given one, new and run in, > 0
  double actuations; // e-folding number, > 0
} SbRunningIn;

// What one actuation yields.
typedef struct {
  double roughness;       // over the given one
  double lambda;          // film over roughness
  double leakage;         // net [m3]
  double carried;         // out under the film on the way in [m3]
  double force_peak;      // [N]
  double force_breakaway; // at the first slip [N]; NaN if there was none
  double force_return;    // least [N]
  double returned;        // 1: the stem comes back to rest, 0: it does not
} SbLifeActuation;

typedef struct {
  long done;      // actuations computed
  double leakage; // sum [m3]; NaN like `carried` for a life that ended before its time
  double carried; // sum [m3]
  SbLifeActuation first, last; // figures of the last NaN for such a life
  double return_least;          // over the life [N]; NaN if no actuation has one
  long failure;                 // number from 1 of the actuation without return, 0 if none
} SbLife;
