// The model from inside: what engine/valve reads and, in a copy of its own, fills. Keys, defaults
// and overrides end here. Everybody else has valve.h.
#pragma once

#include "engine/contact/fit.h"
#include "engine/film/film.h"
#include "engine/mechanism/chamber.h"
#include "engine/valve/shelf.h"
#include "engine/valve/valve.h"

// Roughness before actuation n, 0 the first: end + (start - end) exp(-n/actuations).
typedef struct {
  double start, end; // roughness over the given one, new and run in, > 0 [1]
  double actuations; // e-folding number, > 0 [1]
} SbRunningIn;

// Ranges that studies cover.
typedef struct {
  double squeeze_min, squeeze_max;         // of the free section
  double speed_min, speed_max;             // sliding [m/s]
  double load_min, load_max;               // net, per length [N/m]
  double time_min, time_max;               // in storage [s]
  double temperature_min, temperature_max; // of canister and valve [K]
  bool rings_solved;                       // in every cycle over the temperature
} SbStudyRange;

struct SbModel {
  SbParams params; // what it was compiled from
#define SB_REAL(id, where, place, ...)         SB_DECLARE_##where(double, place)
#define SB_INT(id, where, place, ...)          SB_DECLARE_##where(int, place)
#define SB_CHOICE(id, type, where, place, ...) SB_DECLARE_##where(type, place)
#define SB_FLAGS(id, where, place, ...)        SB_DECLARE_##where(unsigned, place)
#include "engine/valve/params.def"
  SbSealModel seal[SB_SEAL_COUNT];
  SbRubber rubber;           // how storage changes it
  double bore_circumference; // pi D: the friction area's length [m]
  SbDoseSupply supply;       // of the dose chamber between the two seals
  double filling_time;       // of that, past the land's edge [s]; NAN: nothing drives liquid in
  double pressure_force;     // p pi D_p^2/4, pushes the stem out [N]
  SbValveParts parts;        // the stem's share stem_mass
  double moving_mass;        // stem, seals and block [kg]
  SbRoughModel surface;
  SbRunningIn running_in; // factor on the roughness
  SbRig rig;              // motion RIG
  SbSectionLook look;     // for the drawing only
  SbValveShape shape;     // for the drawing only
  SbStudyRange study;
  SbShelfInput shelf;      // what a loss on the shelf hangs on beside the rest
  const SbModelData *data; // borrowed; NULL: no series, drawn section or outlines
  SbLimits limits;         // filled by whoever read them, none otherwise
};

// Adds a problem with a key: why, and the range that would do (NaN: open).
void SB_PRINTF(5, 6) sb_model_refuse(SbProblems *problems, const char *key, double min, double max,
                                     const char *format, ...);

// Holds data once more, for sb_model_data_release().
void sb_model_data_hold(const SbModelData *data);

// Adds what makes no sense of the values alone: sizes, profiles, grooves, combinations, the fluid.
void sb_model_check(const SbModel *model, SbProblems *problems);

// Compiles parameters into *out, which borrows `data`, without limits. Otherwise as
// sb_model_create(), *out as it was.
SbStatus sb_model_compile(SbModel *out, const SbParams *params, const SbModelData *data,
                          SbProblems *problems);

// As sb_model_derive(), into *out, which borrows the data and may be `base`, and is as it was where
// it fails. What else was written into `base` is left behind.
SbStatus sb_model_override(SbModel *out, const SbModel *base, const SbOverride *overrides,
                           size_t count, SbReport *report);

// A contact's law of friction by the friction.* keys, but for its viscous part: `mass` [kg] swings
// on its tangential spring, damped as drive.damping_ratio says.
SbDynamicsContact sb_model_contact(const SbModel *model, double static_ratio, double mass);

// Pressures on the two sides of a seal [Pa gauge]: canister side (left, x < 0) and ambient side
// (right).
typedef struct {
  double left, right;
} SbSealPressure;

// Rough surface of a seal on the bore, its roughness over the model's.
SbRoughSurface sb_model_surface(const SbModel *model, int seal, double roughness);

// Way of the surface that slides on the seals along x on the in-stroke: the bore's past rings is
// +1, that of the stem through gaskets -1.
static inline double sb_model_way(const SbModel *model) {
  return model->kind == SB_VALVE_GASKET ? -1 : 1;
}

// What pushes the stem out at a displacement beside friction and stops: the canister and a return
// spring [N].
static inline double sb_model_push(const SbModel *model, double s) {
  return model->pressure_force + model->spring_preload + model->spring_stiffness * s;
}

SbSealPressure sb_model_seal_pressure(const SbModel *model, int seal, SbChamber chamber);
