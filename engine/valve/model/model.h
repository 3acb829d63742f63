// The fields of SbModel and functions on them, for engine/valve only; all others use valve.h. A
// model is constant after its creation.
#pragma once

#include "engine/contact/fit.h"
#include "engine/film/film.h"
#include "engine/mechanism/chamber.h"
#include "engine/valve/model/valve.h"

// Roughness before actuation n (0: the first) divided by the scene's roughness:
// end + (start - end) exp(-n/actuations).
typedef struct {
  double start, end; // of a new surface; of a fully run-in surface; > 0
  double actuations; // e-folding number, > 0
} SbRunningIn;

// Ranges of the abscissas of the drawn studies (study.* parameters).
typedef struct {
  double squeeze_min, squeeze_max;         // squeeze of the free section [1]
  double speed_min, speed_max;             // of sliding [m/s]
  double load_min, load_max;               // net load per length [N/m]
  double time_min, time_max;               // in storage [s]
  double temperature_min, temperature_max; // of canister and valve [K]
  bool rings_solved;                       // rings are solved at each temperature
} SbStudyRange;

// Temperature history on the shelf (shelf.history).
typedef enum {
  SB_SHELF_CONSTANT,  // the temperature of the canister
  SB_SHELF_WAREHOUSE, // sines of the year and of the day about it
  SB_SHELF_FILE       // SbModelData.shelf
} SbShelfHistory;

// Parameters of the shelf (groups rubber, housing, fluid and shelf of the catalogue).
// Permeabilities [mol/(m s Pa)]; 0: not given.
typedef struct {
  double permeability_energy;       // Q_P of the rubber's permeability [J/mol]
  double water_permeability;        // of the rubber for water
  double water_permeability_energy; // [J/mol]
  double plastic_permeability, plastic_water_permeability; // of the housing
  double plastic_length;   // area of the wall divided by its thickness [m]; 0: no path
  double humidity;         // relative, of the ambient air
  double vapour_viscosity; // of the propellant [Pa s]
  double contact_angle;    // of the liquid on seal and bore [rad]
  bool vapour;             // vapour is in contact with the seals; false: liquid
  double time;             // on the shelf [s]
  SbShelfHistory history;
  double season, day; // amplitudes of the two sines [K]
} SbShelfInput;

// A model. Each row of params.def with OWN declares a member with the name in its fourth
// (SB_CHOICE: fifth) column and the row's type, in SI: for example radial_space, bore_diameter [m],
// canister_pressure [Pa], viscosity [Pa s], shear_strength [Pa], fit (SbFitModel). After
// compilation sizes are those at the temperature of use, and options that are switched off are 0.
struct SbModel {
  SbParams params; // values from which the model was compiled
#define SB_REAL(id, stage, where, place, ...)         SB_DECLARE_##where(double, place)
#define SB_INT(id, stage, where, place, ...)          SB_DECLARE_##where(int, place)
#define SB_CHOICE(id, stage, type, where, place, ...) SB_DECLARE_##where(type, place)
#define SB_FLAGS(id, stage, where, place, ...)        SB_DECLARE_##where(unsigned, place)
#include "engine/valve/model/params.def"
  SbSealModel seal[SB_SEAL_COUNT]; // by SB_OUTER, SB_INNER
  SbRubber rubber;                 // law of the rubber's change in storage
  double bore_circumference;       // pi D, length of the friction area [m]
  SbDoseSupply supply;             // of the dose chamber between the two seals
  double passage_area;             // between canister and chamber, where the chamber is open [m2]
  double outlet_diameter;          // of the hole that empties the chamber; 0: none [m]
  double filling_time;             // to fill the chamber past the land's edge [s]; NaN: no pressure
  double pressure_force;           // p pi D_p^2/4, > 0 pushes the stem out [N]
  SbValveParts parts;              // the stem has the mass stem_mass
  double moving_mass;              // stem, seals and block [kg]
  SbRoughModel surface;            // model of the rough contact
  SbRunningIn running_in;          // factor on the roughness
  SbRig rig;                       // models.motion = rig
  SbSectionLook look;              // for drawing only
  SbValveShape shape;              // for drawing only
  SbStudyRange study;              // ranges of the drawn studies
  SbShelfInput shelf;              // parameters of the loss on the shelf
  const SbModelData *data;         // borrowed; NULL: no series, drawn section or outlines
  SbLimits limits;                 // set by the reader of a scene; else empty
};

// Adds a problem to `problems` (may be NULL): the parameter `key` to change, a formatted reason,
// and the range [min, max] in SI that would be valid (NaN: no limit). Does nothing if the list is
// full.
void SB_PRINTF(5, 6) sb_model_refuse(SbProblems *problems, const char *key, double min, double max,
                                     const char *format, ...);

// Takes a reference to `data`, which sb_model_data_release() releases. Any thread.
void sb_model_data_hold(const SbModelData *data);

// Adds the problems of a model whose parameters are set (model.c calls it before it derives sizes):
// sizes, profiles, grooves, combinations of models, fluid.
void sb_model_check(const SbModel *model, SbProblems *problems);

// Compiles parameters into *out, without limits; `data` (NULL: none) is borrowed as long as *out is
// used, and *out needs no destroy. SB_ERROR_INPUT: inconsistent values. *problems (NULL: not
// wanted) is overwritten by the list of them. *out is unchanged after an error.
SbStatus sb_model_compile(SbModel *out, const SbParams *params, const SbModelData *data,
                          SbProblems *problems);

// Compiles the parameters of `base` with overrides[count] (NULL if the count is 0) into *out, in
// memory of the caller, like sb_model_derive() and with its errors. *out borrows the data of
// `base`, needs no destroy, may be `base` itself, and is unchanged after an error. Only
// base->params and limits are used: fields of `base` that were changed directly are computed again.
SbStatus sb_model_override(SbModel *out, const SbModel *base, const SbOverride *overrides,
                           size_t count, SbReport *report);

// Returns the friction law of a contact from the friction.* parameters, without its viscous part.
// `static_ratio` is static friction divided by sliding friction (1 is used if contacts age). `mass`
// [kg] is the mass on the contact's tangential spring, whose damping is drive.damping_ratio of
// critical.
SbDynamicsContact sb_model_contact(const SbModel *model, double static_ratio, double mass);

// Pressures on the two sides of a seal.
typedef struct {
  double left, right; // canister side (x < 0), ambient side [Pa], gauge
} SbSealPressure;

// Returns the rough surface of a seal on the bore, with the model's roughness multiplied by
// `roughness`.
SbRoughSurface sb_model_surface(const SbModel *model, int seal, double roughness);

// Returns the direction along x in which the surface slides over the seals on the in-stroke: +1 for
// the bore over rings, -1 for the stem through gaskets.
static inline double sb_model_way(const SbModel *model) {
  return model->kind == SB_VALVE_GASKET ? -1 : 1;
}

// Returns the force of canister pressure and return spring on the stem at the displacement s [m], >
// 0 out of the canister [N].
static inline double sb_model_push(const SbModel *model, double s) {
  return model->pressure_force + model->spring_preload + model->spring_stiffness * s;
}

// Returns the pressures of `seal` in a state of the chamber. With canister.pressure_map = ports,
// SB_CHAMBER_AT_REST is the vented and SB_CHAMBER_CLOSED the full chamber; in a gasket valve
// AT_REST is full and CLOSED vented.
SbSealPressure sb_model_seal_pressure(const SbModel *model, int seal, SbChamber chamber);
