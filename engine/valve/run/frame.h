// Frames: the state of a valve at one instant of a run. Plain data, constant once published, so any
// thread may read them.
#pragma once

#include "engine/valve/figures/summary.h"

#include <stdint.h>

// One seal at one instant.
typedef struct {
  float land_fraction;  // fraction of the contact width on the land: 1 all of it, 0 none of it
  float pressure_left;  // fluid pressure on the canister side [Pa]
  float pressure_right; // fluid pressure on the ambient side [Pa]
  uint32_t profile;     // index for sb_run_profile(), UINT32_MAX: none
  uint32_t shape;       // index for sb_run_shape(), UINT32_MAX: none
  double contact_left;  // x of the left edge [m]; equal to the right one without contact
  double contact_right; // x of the right edge [m]
  double load;          // contact load around the circumference [N]
  double pressure_peak; // peak contact pressure minus the lower fluid pressure [Pa]
  double film_min;     // minimum film [m]; 0 at rest unless the film history is solved; NaN without
                       // contact
  double film_central; // film in the middle of the contact [m]; 0 and NaN as film_min
  double lambda;       // film_central divided by the rms roughness [1]; 0 and NaN as film_min
  double real_area_share; // real contact area divided by contact area [1]; at rest that of the dry
                          // contact; NaN without contact, and while sliding without a film
  double friction_boundary; // part of `friction` due to asperities, with its sign [N]
  double friction_viscous;  // part of `friction` due to the film, with its sign [N]
  double friction;          // force on the stem, > 0 if it pushes the stem out [N]
} SbSealFrame;

// Returns the left fluid pressure minus the lower of both [Pa]. Contact pressures of frames and
// profiles are relative to the lower one too.
static inline double sb_seal_step_left(const SbSealFrame *seal) {
  return (double)(seal->pressure_left > seal->pressure_right
                      ? seal->pressure_left - seal->pressure_right
                      : 0);
}

// Returns the right fluid pressure minus the lower of both [Pa].
static inline double sb_seal_step_right(const SbSealFrame *seal) {
  return (double)(seal->pressure_right > seal->pressure_left
                      ? seal->pressure_right - seal->pressure_left
                      : 0);
}

// The valve at one instant.
typedef struct {
  double time;             // [s]
  double displacement;     // s of the stem, > 0 into the canister [m]
  double velocity;         // of the stem, > 0 into the canister [m/s]
  double platen;           // displacement of the platen, of the rig's motor, else of the stem [m]
  double force;            // of the drive on the stem, > 0 into the canister [N]
  double pressure_force;   // of the canister pressure on the stem, > 0 pushes it out [N]
  double stop_force;       // end stop > 0 (pushes out), rest stop < 0 [N]
  double chamber_pressure; // in the dose chamber [Pa]
  double spring_force;     // of the return spring, > 0 pushes the stem out [N]; 0 without spring
  uint8_t stage;           // SbStage of the last event passed
  uint8_t chamber;         // SbChamber
  uint8_t on_event;        // 1: the frame is exactly at an event, just before it
  uint8_t peak;            // rig: 1 first peak, 2 a later one, else 0
  SbSealFrame seal[SB_SEAL_COUNT];
} SbFrame;

// Pressure and film of a contact, shared by all frames in the same state. Arrays of `count`, owned
// by the run.
typedef struct {
  size_t count;
  const double *x; // in the seal's frame [m], increasing
  // Contact pressure of the fit (fluid pressure outside the contact) minus the lower fluid pressure
  // [Pa]. Its maximum is the state's pressure peak.
  const double *pressure;
  const double *film;              // thickness [m]; 0: not computed (at rest)
  const double *asperity_pressure; // carried by asperities at this film [Pa]
  const char *model;               // fit model ("karaszkiewicz", "ring", ...); static
  // Pressure of the film's own solution [Pa]; differs from `pressure` if the film is solved on a
  // half-plane. NULL: no film was solved.
  const double *film_pressure;
  const char *film_model; // model of film and film_pressure; static
} SbContactProfile;

// Fields of a solved ring, for drawing.
typedef enum {
  SB_FIELD_VON_MISES,    // [Pa]
  SB_FIELD_HYDROSTATIC,  // mean pressure, compression positive [Pa]
  SB_FIELD_SHEAR,        // axial-radial shear stress [Pa]
  SB_FIELD_CONTACT,      // contact or fluid pressure on the surface, 0 inside [Pa]
  SB_FIELD_DISPLACEMENT, // magnitude, from the free ring [m]
  SB_FIELD_PERMEATION,   // permeation flux divided by permeability and pressure difference [1/m];
                         // 0 unless SbPlan.permeation
  SB_FIELD_COUNT
} SbField;

// Deformed section of a solved ring, shared by all frames in the same state. Arrays owned by the
// run.
typedef struct {
  size_t nodes, triangles, outline; // numbers of nodes, triangles and boundary nodes
  // [nodes][2]: x in the seal's frame; y above the groove floor, or of a gasket above the stem [m].
  const double *place;
  const float *field[SB_FIELD_COUNT]; // [nodes] each
  const int *triangle;                // [triangles][3] node numbers
  const int *outline_node;            // [outline] boundary nodes in order, not repeated at the end
  double contact_left, contact_right; // x of the bore contact [m]; equal if there is none
  double load;                        // on the bore [N]
  double drag;                        // friction of the bore on the ring, in-stroke > 0 [N]
} SbSealShape;
