// How a run evaluates ring states that are perturbed from those of another run.
#pragma once

// How the rings of a prediction are evaluated.
typedef enum {
  SB_RINGS_FOLLOW, // linearised
  SB_RINGS_STAY,   // constant, as in the first state predicted from the base; only films follow
  // Solved from the linearised state on its meshes, and films next to the base's films: reference
  // for predictions. SbSummary.ring_fault is then 0 if all rings have the base's active set, else
  // infinite.
  SB_RINGS_SOLVED
} SbRingsBeside;
