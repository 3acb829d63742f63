// How the stem of a valve opens and closes the dose chamber: one row for each kind of valve
// (valve.kind). Motion, dose, supply, plan and shapes read the row. What differs in the contacts of
// its seals is in engine/valve/states/contact_law.h.
//
// Pure functions of their arguments, for any thread. s is the stem's displacement [m]; a direction
// is SB_CYCLE_IN or SB_CYCLE_OUT.
#pragma once

#include "engine/contact/ring/ring.h"
#include "engine/valve/run/cycle.h"

// Where a stem is when it moves to another position.
typedef struct {
  SbChamber chamber;
  SbStage stage;
  int direction;
} SbPassage;

// Stem displacements at which the chamber changes its state in a motion with inertia [m].
typedef struct {
  double open; // where the edge opens (gasket: closes) the chamber on the in-stroke
  // Where the edge closes the chamber on the return (gasket: opens it, if the port has emptied it).
  double closed;
  double port; // beyond it the port empties the chamber; NAN: there is none
} SbChamberEdges;

// One kind of valve.
typedef struct {
  // The chamber fills at rest and is emptied by a port on the in-stroke. Else it fills between
  // stages C and F, and is emptied by the vent.
  bool fills_at_rest;
  // The chamber is open to the canister beyond the land's edge, where the inner contact has left
  // the land. Else it is closed there, where the contact has come onto the land.
  bool open_beyond;
  // Liquid that a stroke leaves on the sliding surface evaporates before the next one.
  bool layer_evaporates;
  // In quasi-static motion the frames have the friction of the drive's speed. Else of the stem's,
  // which a return spring makes slower.
  bool drive_friction;
  // The inner seal is drawn in places over the land's edge, which deforms it on its chamfer. Else
  // it is drawn without contact until the edge has passed it.
  bool drawn_over_edge;
  // The input to change if the contact pressure is too low (SB_P_...).
  SbParamId pressed_by;
  // Why the seals have no gland; NULL: they have one.
  const char *no_gland;

  // Returns the radius [m] from which the heights of a drawn seal with the load `load` are
  // measured: that of the groove floor, or of the stem under a gasket.
  double (*base_radius)(const SbModel *model, const SbRingLoad *load);

  // Returns the stem displacement at which the edge reaches the inner contact `inner`, minus
  // bore.land_edge [m]; `first` is the contact in SB_CHAMBER_AT_REST on the in-stroke.
  double (*edge_shift)(const SbSealState *first, const SbSealState *inner);
  // Returns the chamber state whose inner contact decides where an open chamber closes, for a stem
  // that moves in `direction`.
  SbChamber (*closes_as)(int direction);
  // Returns the displacement at which the port empties the chamber [m]; NAN: it has none.
  double (*port)(const SbModel *model);
  // Returns the SbStage that a stem which moves to s reaches there, -1 for none; `event` is the
  // stage, or -1, that it reaches there for other reasons. Writes the chamber from there on to
  // *chamber. The inner seal has contact.
  int (*reach)(SbChamber *chamber, const SbCycle *cycle, const SbPassage *from, double s,
               int event);
  // Returns the state of the chamber after the stem has crossed the edge at s (one of `edges`, or
  // another one); here `direction` is > 0 into the canister, < 0 out. The inner seal has contact.
  SbChamber (*cross)(const SbChamberEdges *edges, SbChamber chamber, int direction, double s);
  // Returns the static friction of a seal that the drive must overcome beyond the push of the stem
  // to hold it at the end stop [N].
  double (*stop_friction)(const SbCycle *cycle, int seal);
  // Returns whether the chamber in state `chamber` has liquid.
  bool (*is_wet)(const SbModel *model, SbChamber chamber);
  // Writes the range of s [m] in which the chamber is open to the outside; *high may be INFINITY.
  // Returns false, with both written, if the stem never is in this range.
  bool (*vent)(double *low, double *high, const SbCycle *cycle);
} SbValveType;

// Returns the row of the model's kind of valve; static.
const SbValveType *sb_valve_type(const SbModel *model);
