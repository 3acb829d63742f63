// How a predicted run (sb_run_predict_from()) evaluates its solved rings: its model differs
// slightly from that of a base run, whose ring states are stored.
#pragma once

// How the rings of a prediction are evaluated.
typedef enum {
  SB_RINGS_FOLLOW, // linearised about the base's rings with respect to all differences of the
                   // models
  SB_RINGS_STAY,   // constant: as in the first prediction from this base; only films change
  // Solved from the linearised state on the base's meshes, and films on the base's film meshes: the
  // reference that checks SB_RINGS_FOLLOW. SbSummary.ring_fault is then 0 if all rings have the
  // base's active set, else INFINITY.
  SB_RINGS_SOLVED
} SbRingsBeside;
