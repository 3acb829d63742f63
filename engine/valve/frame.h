// Frames: what one instant of a run looks like. Plain numbers; immutable once published.
#pragma once

#include "engine/valve/valve.h"

#include <stdint.h>

// Events of the cycle; docs/results.md, Definitions.
typedef enum {
  SB_STAGE_A,
  SB_STAGE_B,
  SB_STAGE_C,
  SB_STAGE_D,
  SB_STAGE_E,
  SB_STAGE_F,
  SB_STAGE_COUNT
} SbStage;

// "A" to "F"; borrowed.
const char *sb_stage_name(SbStage stage);

// One seal at one instant.
typedef struct {
  float land_fraction;    // share of the contact width on the land [1]: 1 sliding on it, 0 off
  float pressure_left;    // fluid pressure, canister side [Pa]
  float pressure_right;   // fluid pressure, ambient side [Pa]
  uint32_t profile;       // index into the run's contact profiles, UINT32_MAX: none
  uint32_t shape;         // index into the run's solved ring shapes, UINT32_MAX: none
  double contact_left;    // contact in the seal's frame [m], left < right; equal when there is none
  double contact_right;   // [m]
  double load;            // total contact load, around the circumference [N]
  double pressure_peak;   // [Pa]
  double film_min;        // [m], 0 at rest unless the films' history is solved, NAN without contact
  double film_central;    // [m]
  double lambda;          // film_central / sigma [1]
  double real_area_share; // of the contact's area that slides [1], NAN like the film
  double friction_boundary; // signed as friction [N]
  double friction_viscous;  // [N]
  double friction;          // force on the stem, positive when it pushes the stem out (resists the
                            // in-stroke) [N]
} SbSealFrame;

// Fluid pressure on each side above the lower of the two [Pa]: the step that the contact holds.
// Contact pressures of frames and profiles count from the lower one too; what both sides share lies
// on everything.
static inline double sb_seal_step_left(const SbSealFrame *seal) {
  return (double)(seal->pressure_left > seal->pressure_right
                      ? seal->pressure_left - seal->pressure_right
                      : 0);
}

static inline double sb_seal_step_right(const SbSealFrame *seal) {
  return (double)(seal->pressure_right > seal->pressure_left
                      ? seal->pressure_right - seal->pressure_left
                      : 0);
}

// The valve at one instant. Displacement s > 0 is the in-stroke; compression forces are positive.
typedef struct {
  double time;           // [s]
  double displacement;   // of the stem [m]
  double velocity;       // of the stem [m/s]
  double platen;         // displacement of the machine's platen [m]
  double force;          // on the stem by the machine, positive in compression [N]
  double pressure_force; // pushes the stem out [N]
  double
      stop_force; // of the end stop, positive pushes the stem out; of the rest stop, negative [N]
  double chamber_pressure; // in the dose chamber [Pa]
  double spring_force;     // of a return spring, pushes the stem out [N]
  uint8_t stage;           // SbStage of the last event passed
  uint8_t chamber;         // SbChamber
  uint8_t on_event;        // 1 if this frame sits exactly on an event, just before it
  uint8_t peak;            // of a rig's force: 1 the first peak, 2 a following one, else 0
  SbSealFrame seal[SB_SEAL_COUNT];
} SbFrame;

// Pressure and film over one contact, shared by all frames that have the same state. Arrays of
// `count`, owned by the run. x in the seal's frame [m]; film is 0 where none was computed (a seal
// at rest).
typedef struct {
  size_t count;
  const double *x;
  // Contact pressure of the fitment, the fluid's outside the contact, above the lower side [Pa].
  // Its maximum in the contact is the state's `pressure_peak`.
  const double *pressure;
  const double *film;              // [m]
  const double *asperity_pressure; // what asperities bear at this film [Pa]
  const char *model;               // of the pressure ("karaszkiewicz", "ring", ...)
  // Pressure that the film's own solution has: it differs from the contact's where the film is
  // solved on a half-plane. NULL: no film was solved. [Pa]
  const double *film_pressure;
  const char *film_model; // of the film and of its pressure
} SbContactProfile;

// Fields on a solved ring, for drawing.
typedef enum {
  SB_FIELD_VON_MISES,    // [Pa]
  SB_FIELD_HYDROSTATIC,  // mean pressure, compression positive [Pa]
  SB_FIELD_SHEAR,        // axial-radial [Pa]
  SB_FIELD_CONTACT,      // contact or fluid pressure on the surface, 0 inside [Pa]
  SB_FIELD_DISPLACEMENT, // from the free ring, magnitude [m]
  SB_FIELD_PERMEATION,   // what permeates per area over P and the pressure across [1/m]; 0 unless
                         // the plan asks for it
  SB_FIELD_COUNT
} SbField;

// A solved ring's deformed section, shared by all frames in the same state. Arrays owned by the
// run.
typedef struct {
  size_t nodes, triangles, outline;
  const double *place; // [2 nodes]: x in the seal's frame, y above the groove floor, of a gasket
                       // above the stem [m]
  const float *field[SB_FIELD_COUNT]; // [nodes] each
  const int *triangle;                // [3 triangles] node numbers
  const int *outline_node;            // [outline] in order, closed by the first
  double contact_left, contact_right; // bore contact [m]; equal if there is none
  double load;                        // on the bore [N]
  double drag;                        // friction of the bore on the ring, in-stroke > 0 [N]
} SbSealShape;

// Energy of the cycle, each term accumulated by itself.
typedef struct {
  // By the platen and the canister pressure on the stem, and its largest magnitude on the way, the
  // scale of the closure [J]; not a number where a spring alone moves the stem.
  double external, external_max;
  double friction; // by both seals [J]
  double stored;   // change of elastic energy (machine, stops) [J]
  double seal;     // released where the stem jumps (slip onset, land edge) or lost inside the
                   // rubber [J]
  double kinetic;  // change [J]
  double stop;     // lost at the stops [J]
  double loop;     // area of the force-displacement loop: energy_loss_J [J]
  double closure;  // |external - friction - stored - seal - kinetic - stop| / external_max, or over
                   // the largest |stored| where there is no external work [1]
} SbEnergy;
