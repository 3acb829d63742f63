// What is said of a valve without its model: its seals and chamber, the choices of models, and what
// documents and drawings hand to a model or take from it. SbModel itself is model.h's.
#pragma once

#include "engine/mechanism/bodies.h"
#include "engine/mechanism/drive.h"
#include "engine/mechanism/outline.h"
#include "engine/valve/params.h"

typedef struct SbModel SbModel;

// One parameter in place of a base's.
typedef struct {
  SbParamId id;
  double value; // SI
} SbOverride;

enum { SB_OUTER = 0, SB_INNER = 1, SB_SEAL_COUNT = 2 };

// "outer" or "inner"; borrowed.
const char *sb_seal_name(int seal);

enum { SB_PROBLEMS_MAX = 32 };

// One thing wrong with a parameter set: the key to change, why, and the range that would do (SI;
// NaN where that side is open).
typedef struct {
  char key[64];
  char text[200];
  double min, max;
} SbProblem;

typedef struct {
  size_t count;
  SbProblem item[SB_PROBLEMS_MAX];
} SbProblems;

typedef enum {
  SB_MAP_CHAMBER_FILLED,
  SB_MAP_CHAMBER_VENTED,
  SB_MAP_PORTS // the chamber's pressure is a state
} SbPressureMap;
typedef enum {
  SB_MODEL_ASPERITIES_BESIDE, // at the smooth film, taking no load off it
  SB_MODEL_ASPERITIES_COUPLED // in the film's own solve
} SbModelAsperities;
typedef enum {
  SB_MODEL_MOTION_QUASI_STATIC,
  SB_MODEL_MOTION_DYNAMIC,
  SB_MODEL_MOTION_RIG,   // the sliding plate of thesis 3.3 instead of the valve
  SB_MODEL_MOTION_BODIES // as DYNAMIC, by the constrained parts and with their joints' reactions
} SbModelMotion;

typedef enum {
  SB_MODEL_DRIVE_MACHINE,
  SB_MODEL_DRIVE_HAND,
  SB_MODEL_DRIVE_FREE_RETURN,
  SB_MODEL_DRIVE_SINUSOID,
  SB_MODEL_DRIVE_RAMP,
  SB_MODEL_DRIVE_MEASURED
} SbDriveChoice;

// A measured series for drive MEASURED, straight lines between its rows.
enum { SB_MODEL_SERIES_MAX = 4096 };
typedef struct {
  SbDriveQuantity quantity;
  size_t count;                      // 0: none
  double time[SB_MODEL_SERIES_MAX];  // [s], increasing from 0
  double value[SB_MODEL_SERIES_MAX]; // [m] or [N]
} SbModelSeries;

// Where in the cycle the chamber and so the seals' pressures change (docs/thesis.md).
typedef enum {
  SB_CHAMBER_AT_REST, // A to C: as filled or vented before
  SB_CHAMBER_OPEN,    // C to F: open to the canister, the inner seal out of contact
  SB_CHAMBER_CLOSED   // F to A: cut off again, still at canister pressure
} SbChamber;

// Sizes that the drawing of the section needs beside the rest; the thesis gives none of them. The
// metered volume comes from some, and with ports the chamber's pressure. All in m; the catalogue
// says what each is.
typedef struct {
  double entry_diameter, entry_length, land_length, vent_position, vent_diameter; // housing
  double seal_spacing, nose_length, chamber_depth, chamber_length, shoulder_length,
      rod_diameter; // stem
} SbValveShape;

// Half-sections of the parts whose shape a document gives, as it gives them; for the drawing only.
// The housing has an x axis of its own, the three parts of the stem share one; both point out of
// the canister.
typedef struct {
  SbOutline part[SB_VALVE_STEM_BOTTOM + 1]; // by the valve's parts; count 0: no shape
  bool housing, stem;                       // the sizes below are known: it can be drawn
  double land_edge, bore;                   // where the bore land begins [m], its radius
  double groove_left[SB_SEAL_COUNT], groove_right[SB_SEAL_COUNT], floor, land; // walls, radii
} SbValveOutlines;

// How the section is shown when nobody says otherwise; no result depends on it.
typedef struct {
  int field;                 // index among the choices of output.field = SbField
  int insets;                // 0 of the outer seal, 1 of the inner one, 2 none
  bool full;                 // both halves
  bool cutaway;              // in three dimensions, a quarter cut away
  double azimuth, elevation; // of the cutaway's camera [rad]
  bool undeformed;           // the rings' outline before fitting
  double field_max;          // end of the colours of stresses [Pa]; 0: the range of the run
} SbSectionLook;

typedef enum {
  SB_VIEW_HYSTERESIS = 1 << 0,
  SB_VIEW_PROFILES = 1 << 1,
  SB_VIEW_SECTION = 1 << 2,
  SB_VIEW_DASHBOARD = 1 << 3,
  SB_VIEW_RIG = 1 << 4,
  SB_VIEW_LIFE = 1 << 5
} SbView;

// Counts of what a run computed; added to, never reset.
typedef struct {
  size_t fit_solves, disc_solves, ring_solves, reynolds_solves, newton_iterations;
  size_t film_steps; // of the films' history, all seals
  size_t field_evaluations, profile_evaluations;
} SbCounters;
