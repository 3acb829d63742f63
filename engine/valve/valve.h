// A valve's model, as everybody outside engine/valve has it: a checked set of physical quantities
// that is compiled from parameters and never changes; its values are read here, another one is
// derived. What it is made of is model.h's.
#pragma once

#include "engine/contact/fit.h"
#include "engine/contact/gland.h"
#include "engine/mechanism/bodies.h"
#include "engine/mechanism/drive.h"
#include "engine/mechanism/outline.h"
#include "engine/rubber/rubber_time.h"
#include "engine/valve/params.h"
#include "engine/valve/rig.h"

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

typedef struct SbModel SbModel;

// One parameter in place of a base's.
typedef struct {
  SbParamId id;
  double value; // SI
} SbOverride;

enum { SB_OUTER = 0, SB_INNER = 1, SB_SEAL_COUNT = 2 };

// "outer" or "inner"; borrowed.
const char *sb_seal_name(int seal);

// Whether anything can pass a seal at rest under its pressures.
typedef enum {
  SB_LEAK_NOT_COMPUTED,
  SB_LEAK_CLOSED,
  SB_LEAK_PERCOLATING, // through channels between the asperities, contact/rough/percolation.h
  SB_LEAK_OPEN         // no contact, or none that the rubber presses: no leak law holds
} SbLeakState;

// "not-computed", "closed", "percolating", "open"; borrowed.
const char *sb_leak_state_name(SbLeakState state);

enum { SB_PROBLEMS_MAX = 32 };

// One thing wrong with a parameter set: the key to change, why, and the range that would do (SI;
// NaN where that side is open).
typedef struct {
  char key[64];
  char text[SB_TEXT];
  double min, max;
} SbProblem;

typedef struct {
  size_t count;
  SbProblem item[SB_PROBLEMS_MAX];
} SbProblems;

typedef enum {
  SB_VALVE_PISTON, // rings on the stem slide in a bore
  SB_VALVE_GASKET  // the stem slides through gaskets
} SbValveKind;

// Thickness of a gasket's plate on the chamber's side, over its own.
#define SB_GASKET_PLATE 0.12

typedef enum {
  SB_MAP_CHAMBER_FILLED,
  SB_MAP_CHAMBER_VENTED,
  SB_MAP_PORTS // the chamber's pressure is a state
} SbPressureMap;
// Which models stand where none is chosen.
typedef enum { SB_MODEL_SET_THESIS, SB_MODEL_SET_CONSISTENT } SbModelSet;
typedef enum {
  SB_MODEL_FRICTION_THESIS, // shear strength on the real area and a share of the load (eq. 5.14)
  SB_MODEL_FRICTION_SHEAR   // shear strength on the real area alone
} SbModelFriction;
typedef enum {
  SB_MODEL_ASPERITIES_BESIDE, // at the smooth film, taking no load off it
  SB_MODEL_ASPERITIES_COUPLED // in the film's own solve
} SbModelAsperities;
typedef enum {
  SB_MODEL_ADHESION_OFF,
  SB_MODEL_ADHESION_ON,        // van der Waals across the film
  SB_MODEL_ADHESION_ASPERITIES // of the asperities' tips
} SbModelAdhesion;
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

// Limits on figures, as a scene's [limits] gives them, and the six questions that they decide.
typedef enum {
  SB_VERDICT_SEALS,   // no seal open, its peak above the fluid's pressure
  SB_VERDICT_PRESSES, // forces within limits
  SB_VERDICT_RETURNS, // the stem comes back by itself, and with the force asked for
  SB_VERDICT_DOSES,
  SB_VERDICT_LEAK,
  SB_VERDICT_FITS,
  SB_VERDICT_COUNT,
  SB_VERDICT_NONE = SB_VERDICT_COUNT // decides nothing: no limit may be set
} SbVerdictKind;

enum { SB_LIMITS_MAX = 64 };

typedef struct {
  int figure;       // index, engine/valve/figures.h
  double low, high; // SI; -INFINITY, INFINITY: open
} SbLimit;

typedef struct {
  size_t count;
  SbLimit item[SB_LIMITS_MAX];
} SbLimits;

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

// Half of the section, both halves, or in three dimensions, a quarter cut away: output.section.
enum { SB_SECTION_HALF, SB_SECTION_FULL, SB_SECTION_CUTAWAY };

// How the section is shown when nobody says otherwise; no result depends on it.
typedef struct {
  int field;                 // index among the choices of output.field = SbField
  int insets;                // 0 of the outer seal, 1 of the inner one, 2 none
  int section;               // SB_SECTION_HALF, ...
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
  SB_VIEW_LIFE = 1 << 5,
  SB_VIEW_SHELF = 1 << 6
} SbView;

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

// What is large in a model: models share it by reference. Whoever reads a file makes and fills it.
typedef struct {
  atomic_uint holders;
  SbModelSeries measured; // count 0: none
  SbModelSeries shelf;    // temperatures [K] over time, of shelf.file; count 0: none
  SbSealDrawing profile;  // of seal.profile_file; count 0: none
  SbGrooveDrawing groove; // of gland.profile_file; count 0: none
  SbValveOutlines outlines;
  SbRubberSheet rubber; // of the parameters that it comes with, which borrow it
} SbModelData;

// *out is all zero and held once; to be filled before a model is made with it. SB_ERROR_MEMORY.
SbStatus sb_model_data_create(SbModelData **out);

// Lets go of it; with the last holder it goes. From any thread; takes NULL.
void sb_model_data_release(const SbModelData *data);

// A number of what files draw, section and groove: another one where they differ (FNV-1a). 0: there
// is neither.
uint64_t sb_model_data_drawings(const SbModelData *data);

// Compiles parameters. On SB_OK *out is owned by the caller and holds `data` (NULL: no
// measured series, drawn section or outlines); it has `limits` (NULL: none). Otherwise *out is
// NULL: SB_ERROR_MEMORY, or SB_ERROR_INPUT, and `problems` (may be NULL) lists every combination
// that makes no sense: bore smaller than the stem, no room for the ring...
SbStatus sb_model_create(SbModel **out, const SbParams *params, const SbModelData *data,
                         const SbLimits *limits, SbProblems *problems);

// Compiles the parameters of `base` with `count` overrides in their place, the last of a parameter
// counts; series, outlines and limits are the base's. SB_ERROR_RANGE or SB_ERROR_INPUT with a
// report that names key, value and range; SB_ERROR_MEMORY. As sb_model_create() otherwise.
SbStatus sb_model_derive(SbModel **out, const SbModel *base, const SbOverride *overrides,
                         size_t count, SbReport *report);

// One of its own for somebody who keeps it (another thread, a drawing). SB_ERROR_MEMORY.
SbStatus sb_model_copy(SbModel **out, const SbModel *model);

// Takes NULL.
void sb_model_destroy(const SbModel *model);

// Whether two are of the same values and data; NULL is like NULL only.
bool sb_model_same(const SbModel *a, const SbModel *b);

// The value of a parameter that it was compiled from: SI, or as a whole number, choice or bit mask.
double sb_model_value(const SbModel *model, SbParamId id);
int sb_model_number(const SbModel *model, SbParamId id);

// Whether a value follows from another parameter: that default with its source; false: it is given
// or the catalogue's.
bool sb_model_default(SbParamDefault *out, const SbModel *model, SbParamId id);

// Returns a number that is equal for two models of the same numerical methods and only for those:
// kind of valve and section, models.* from the fit to the motion. Errors of discretisation of two
// such runs have the same sign and about the same relative size.
uint64_t sb_model_methods(const SbModel *model);

// Name of a choice that it was compiled from, into `name` of `size` bytes.
void sb_model_choice_name(const SbModel *model, SbParamId id, char *name, size_t size);

// Whether it is the sliding plate in place of a valve (NULL: no).
bool sb_model_is_rig(const SbModel *model);

// Whether its stem slides through gaskets (NULL: no).
bool sb_model_is_gasket(const SbModel *model);

// Whether a return spring pushes the stem out.
bool sb_model_has_spring(const SbModel *model);

// What follows from the parameters; borrowed.
const SbSealModel *sb_model_seal(const SbModel *model, int seal);
const SbValveShape *sb_model_shape(const SbModel *model);
const SbValveParts *sb_model_parts(const SbModel *model);
const SbRig *sb_model_rig(const SbModel *model);
const SbSectionLook *sb_model_look(const SbModel *model);
double sb_model_pressure_force(const SbModel *model); // p pi D_p^2/4, pushes the stem out [N]
double sb_model_sigma(const SbModel *model);          // of the first actuation's surface [m]
int sb_model_shown_actuation(const SbModel *model);   // of a life, from 1

// The measured series and the parts' outlines; NULL: none. Borrowed.
const SbModelSeries *sb_model_measured(const SbModel *model);
const SbValveOutlines *sb_model_outlines(const SbModel *model);

// Geometry that is possible and hardly meant, with the key to change and the range that would do.
void sb_model_remarks(const SbModel *model, SbProblems *out);

// What the modulus does over the temperature of use: `factor` times that at 20 degC for the outer
// seal at `temperature` [K], and where this comes from. `tag` is "given", "entropy elasticity", or
// that of rubber.modulus_slope's default: "inferred", "typical" or "published". Strings are static
// or the rubber's.
typedef struct {
  double factor;
  const char *tag, *source;
} SbModulusChange;
void sb_model_modulus(SbModulusChange *out, const SbModel *model, double temperature);

// Warns ("modulus-temperature") where the modulus at `temperature` is inferred to be that of 20
// degC and measured slopes of filled rubbers would move it by more than some 3 %.
void sb_model_warn_modulus(const SbModel *model, double temperature, SbWarnings *warnings);

// Adds what the model has to say about its validity: the storage of the rings, the fluid.
void sb_model_warn(const SbModel *model, SbWarnings *warnings);

// The drawn groove, borrowed with the model's data; NULL: it is not drawn.
const SbGrooveDrawing *sb_model_groove(const SbModel *model);

// sb_model_data_drawings() of its data; 0: it has none.
uint64_t sb_model_drawings(const SbModel *model);

// The free section's profile, as large as the seal is in use.
SbSealProfile sb_model_profile(const SbModel *model, int seal);

// The gland of a seal with its tolerances, for sb_gland_readouts: sizes as stored, at 20 degC.
void sb_model_gland(SbGland *out, const SbModel *model, int seal);

// The fitment problem of a seal by the model's own choice, at a pressure difference (positive on
// the left).
void sb_model_fit_problem(SbFitProblem *out, const SbModel *model, int seal, double pressure);
// Counts of what a run computed; added to, never reset.
typedef struct {
  size_t fit_solves, disc_solves, ring_solves, reynolds_solves, newton_iterations;
  size_t film_steps;  // of the films' history, all seals
  size_t speed_nodes; // states solved to be interpolated over the speed
  size_t field_evaluations, profile_evaluations;
} SbCounters;
