// The model: a checked, immutable set of physical quantities compiled from parameters.
//
// Everything downstream reads SbModel and nothing else; keys, defaults and overrides end here. Of
// what others need of a valve without its model, valve.h has the types.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/fit.h"
#include "engine/contact/gland.h"
#include "engine/film/film.h"
#include "engine/mechanism/bodies.h"
#include "engine/rubber/rubber_time.h"
#include "engine/valve/life.h"
#include "engine/valve/limits.h"
#include "engine/valve/rig.h"
#include "engine/valve/valve.h"

#include <stdatomic.h>
#include <stddef.h>

// Members that lines of params.def declare; those of places that are declared here are left out.
#define SB_DECLARE_OWN(type, name) type name;
#define SB_DECLARE_IN(...)

// One ring and what follows from its size and its gland alone. Sizes and modulus are those after
// storage; the new ring's are in `stored`.
typedef struct {
  SbRubberStorage stored; // the new ring and what it went through
  SbRubberState storage;  // what that made of it
#define SB_SEAL(id, where, place, ...) SB_DECLARE_##where(double, place)
#include "engine/valve/params.def"
  double section_diameter; // d, free [m]
  double inner_diameter;   // free [m]
  double modulus;          // E [Pa]
  double reduced_modulus;  // E' of thesis equation 5.8: 2/E' = sum (1 - nu^2)/E [Pa]
  double radius;           // R_x = d/2 [m]
  double squeeze;          // (d - g)/d
  double stretch_mean;     // of the mean diameter, (D_fitted - D_free)/D_free
  double stretch_inner;    // of the inner diameter
  double section_fitted;   // section diameter after stretch, d (1 - nu stretch_mean) [m]
  double interference;     // section_fitted - g [m]
  double gland_fill;       // ring volume over groove volume
} SbSealModel;

// What is large in a model and never changes: models share it by reference, so that runs and
// studies may copy them freely. Whoever reads a file makes it; a model and a plain copy of one
// borrow it. What keeps a copy for longer than a call (a run, another thread, a drawing) does so by
// sb_model_keep() and need not ask who else has let go.
typedef struct {
  atomic_uint holders;
  SbModelSeries measured; // count 0: none
  SbValveOutlines outlines;
} SbModelData;

// Ranges that studies cover.
typedef struct {
  double squeeze_min, squeeze_max; // of the free section
  double speed_min, speed_max;     // sliding [m/s]
  double load_min, load_max;       // net, per length [N/m]
  double time_min, time_max;       // in storage [s]
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
  double metered_volume;     // of the dose chamber between the two seals [m3]
  long doses;                // whole ones in the canister
  double pressure_force;     // p pi D_p^2/4, pushes the stem out [N]
  SbValveParts parts;        // the stem's share stem_mass
  double moving_mass;        // stem, seals and block [kg]
  SbRoughModel surface;
  SbRunningIn running_in; // factor on the roughness
  SbRig rig;              // motion RIG
  SbSectionLook look;     // for the drawing only
  SbValveShape shape;     // for the drawing only
  SbStudyRange study;
  const SbModelData *data; // borrowed; NULL: neither a measured series nor outlines
  SbLimits limits;         // filled by whoever read them, none otherwise
};

// Compiles parameters. On SB_OK the model is complete. Otherwise *out is as it was: SB_ERROR_MEMORY
// (`problems` is not looked at then), or SB_ERROR_INPUT, and `problems`
// (may be NULL) lists every combination that makes no sense: bore smaller than the stem, no room
// for the ring...
SbStatus sb_model_compile(SbModel *out, const SbParams *params, SbProblems *problems);

// Compiles the parameters of `base` with `count` overrides in their place, the last of a parameter
// counts; series, shapes and limits are the base's, the data borrowed. What else somebody wrote
// into `base` is left behind. SB_ERROR_RANGE or SB_ERROR_INPUT with a report that names key, value
// and range, *out as it was; SB_ERROR_MEMORY. `out` may be `base`.
SbStatus sb_model_override(SbModel *out, const SbModel *base, const SbOverride *overrides,
                           size_t count, SbReport *report);

// All zero and held once, or NULL without memory. To be filled before a model points to it.
SbModelData *sb_model_data_create(void);

// Lets go of it; with the last holder it goes. From any thread; takes NULL.
void sb_model_data_release(const SbModelData *data);

// Copies a model into `kept`, which holds what it refers to until the next keep or clear. `kept` is
// all zero before the first.
void sb_model_keep(SbModel *kept, const SbModel *model);
void sb_model_clear(SbModel *kept);

// The measured series and the parts' outlines; NULL: none. Borrowed.
static inline const SbModelSeries *sb_model_measured(const SbModel *model) {
  return model->data != NULL && model->data->measured.count > 0 ? &model->data->measured : NULL;
}
static inline const SbValveOutlines *sb_model_outlines(const SbModel *model) {
  return model->data != NULL ? &model->data->outlines : NULL;
}

// Geometry that is possible and hardly meant, with the key to change and the range that would do.
void sb_model_remarks(const SbModel *model, SbProblems *out);

// Adds what the storage of the rings has to say about its validity.
void sb_model_warn_storage(const SbModel *model, SbWarnings *warnings);

// The gland of a seal with its tolerances, for sb_gland_readouts: sizes as stored.
void sb_model_gland(SbGland *out, const SbModel *model, int seal);

// Pressures on the two sides of a seal [Pa gauge]: canister side (left, x < 0) and ambient side
// (right).
typedef struct {
  double left, right;
} SbSealPressure;

SbSealPressure sb_model_seal_pressure(const SbModel *model, int seal, SbChamber chamber);
