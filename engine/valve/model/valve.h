// The model of a valve as seen outside engine/valve: a checked, immutable set of physical
// quantities, compiled from parameters (params.h). Code outside engine/valve reads it by the
// functions below; its fields are private (model.h).
//
// A model never changes after its creation, so any number of threads may read it at the same time.
#pragma once

#include "engine/contact/fit.h"
#include "engine/contact/gland.h"
#include "engine/mechanism/bodies.h"
#include "engine/mechanism/drive.h"
#include "engine/mechanism/dynamics.h"
#include "engine/mechanism/outline.h"
#include "engine/rubber/rubber_time.h"
#include "engine/valve/model/params.h"

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

// A compiled valve.
typedef struct SbModel SbModel;

// A parameter value that replaces that of a base model.
typedef struct {
  SbParamId id;
  double value; // SI
} SbOverride;

// Index of a seal.
enum { SB_OUTER = 0, SB_INNER = 1, SB_SEAL_COUNT = 2 };

// Returns "outer" or "inner"; static.
const char *sb_seal_name(int seal);

// Leakage of a seal at rest under its pressures.
typedef enum {
  SB_LEAK_NOT_COMPUTED,
  SB_LEAK_CLOSED,      // no channel through the contact
  SB_LEAK_PERCOLATING, // channels between the asperities, contact/rough/percolation.h
  SB_LEAK_OPEN         // no contact, or none that the rubber presses: no leak law applies
} SbLeakState;

// Returns "not-computed", "closed", "percolating" or "open"; static.
const char *sb_leak_state_name(SbLeakState state);

// Capacity of SbProblems.
enum { SB_PROBLEMS_MAX = 32 };

// A problem of a parameter set.
typedef struct {
  char key[64];       // catalogue key of the parameter to change
  char text[SB_TEXT]; // one sentence: what is wrong
  double min, max;    // range that would be valid, SI; NaN: no limit on this side
} SbProblem;

// A list of problems; initialise with {0}. Problems beyond its capacity are omitted.
typedef struct {
  size_t count;
  SbProblem item[SB_PROBLEMS_MAX];
} SbProblems;

// Kind of a valve: the choices of valve.kind.
typedef enum {
  SB_VALVE_PISTON, // rings on the stem slide in a bore
  SB_VALVE_GASKET  // the stem slides through gaskets
} SbValveKind;

// Thickness of a gasket's plate on the chamber side divided by that of the gasket.
#define SB_GASKET_PLATE 0.12

// When the dose chamber has the canister's pressure: the choices of canister.pressure_map.
typedef enum {
  SB_MAP_CHAMBER_FILLED, // before the stroke the chamber is full
  SB_MAP_CHAMBER_VENTED, // before the stroke the chamber is at ambient pressure
  SB_MAP_PORTS           // the pressure is a state of the motion (mechanism/chamber.h)
} SbPressureMap;

// Set of models that applies where none is chosen (models.set).
typedef enum { SB_MODEL_SET_THESIS, SB_MODEL_SET_CONSISTENT } SbModelSet;

// Law of boundary friction.
typedef enum {
  SB_MODEL_FRICTION_THESIS, // shear strength on the real area plus a fraction of the load
                            // (eq. 5.14)
  SB_MODEL_FRICTION_SHEAR   // shear strength on the real area only
} SbModelFriction;

// How asperities and film share the load.
typedef enum {
  SB_MODEL_ASPERITIES_BESIDE, // evaluated at the smooth film, which carries the full load
  SB_MODEL_ASPERITIES_COUPLED // in the solve of the film
} SbModelAsperities;

// Adhesion between seal and bore.
typedef enum {
  SB_MODEL_ADHESION_OFF,
  SB_MODEL_ADHESION_ON,        // van der Waals attraction across the film
  SB_MODEL_ADHESION_ASPERITIES // adhesive asperity tips
} SbModelAdhesion;

// Model of the motion.
typedef enum {
  SB_MODEL_MOTION_QUASI_STATIC, // balance of forces at each instant
  SB_MODEL_MOTION_DYNAMIC,      // with inertia
  SB_MODEL_MOTION_RIG,          // the sliding plate of thesis 3.3 instead of the valve
  SB_MODEL_MOTION_BODIES        // as DYNAMIC, with constrained parts and joint reactions
} SbModelMotion;

// What drives the stem (drive.kind).
typedef enum {
  SB_MODEL_DRIVE_MACHINE,     // platen of a test machine, constant speed up to a force, and back
  SB_MODEL_DRIVE_HAND,        // force of a finger: rise, hold, fall
  SB_MODEL_DRIVE_FREE_RETURN, // none: the stem is released at the end stop
  SB_MODEL_DRIVE_SINUSOID,    // platen bonded to the stem, sinusoidal displacement about mid-stroke
  SB_MODEL_DRIVE_RAMP,        // force: rise and hold, without fall
  SB_MODEL_DRIVE_MEASURED     // displacement or force of a measured series
} SbDriveChoice;

// Capacity of a series.
enum { SB_MODEL_SERIES_MAX = 4096 };

// A measured series, linear between its rows.
typedef struct {
  SbDriveQuantity quantity;          // of a drive
  size_t count;                      // rows; 0: none
  double time[SB_MODEL_SERIES_MAX];  // [s], increasing from 0
  double value[SB_MODEL_SERIES_MAX]; // [m] or [N]; of shelf temperatures [K]
} SbModelSeries;

// The six criteria of the verdict, which limits on figures decide.
typedef enum {
  SB_VERDICT_SEALS,   // no seal is open, and its peak pressure exceeds the fluid's
  SB_VERDICT_PRESSES, // forces are within limits
  SB_VERDICT_RETURNS, // the stem returns by itself, with the required force
  SB_VERDICT_DOSES,   // doses are within limits
  SB_VERDICT_LEAK,    // leakage is within limits
  SB_VERDICT_FITS,    // sizes, contacts, films, times are within limits
  SB_VERDICT_COUNT,
  SB_VERDICT_NONE = SB_VERDICT_COUNT // SbFigure.verdict: no limit may be set on this figure
} SbVerdictKind;

// Capacity of SbLimits.
enum { SB_LIMITS_MAX = 64 };

// A limit on a figure.
typedef struct {
  int figure;       // index from sb_figure_find()
  double low, high; // allowed range, SI; -INFINITY, INFINITY: no limit on this side
} SbLimit;

// Limits on figures (group [limits] of a scene).
typedef struct {
  size_t count;
  SbLimit item[SB_LIMITS_MAX];
} SbLimits;

// State of the dose chamber in the cycle, which determines the seals' pressures (docs/thesis.md).
// In a gasket valve AT_REST is the full chamber, OPEN the chamber open to the canister before C and
// after F, and CLOSED the vented one.
typedef enum {
  SB_CHAMBER_AT_REST, // A to C: filled or vented before the stroke
  SB_CHAMBER_OPEN,    // C to F: open to the canister, the inner seal has no contact
  SB_CHAMBER_CLOSED   // F to A: closed again, at canister pressure
} SbChamber;

// Sizes for the drawing of the section [m]; the thesis does not state them. Some determine the
// metered volume and, with ports, the chamber pressure. Each is the parameter bore.NAME (housing)
// or stem.NAME of its name, whose help text describes it.
typedef struct {
  double entry_diameter, entry_length, land_length, vent_position, vent_diameter; // housing
  // Stem.
  double seal_spacing, nose_length, chamber_depth, chamber_length, shoulder_length, rod_diameter;
} SbValveShape;

// Half-sections of drawn parts, for the drawing only. The housing has its own x axis, the three
// stem parts share one; both point out of the canister.
typedef struct {
  SbOutline part[SB_VALVE_STEM_BOTTOM + 1]; // by SB_VALVE_HOUSING, ...; count 0: not drawn
  bool housing, stem;                       // the sizes below of housing, of stem are defined
  double land_edge, bore;                   // housing: x of the land's edge; radius of the land [m]
  // Stem: x of the groove walls, by SB_OUTER and SB_INNER; radii of groove floor and land [m].
  double groove_left[SB_SEAL_COUNT], groove_right[SB_SEAL_COUNT], floor, land;
} SbValveOutlines;

// Kind of section drawing (output.section): half, both halves, or three-dimensional with a quarter
// cut away.
enum { SB_SECTION_HALF, SB_SECTION_FULL, SB_SECTION_CUTAWAY };

// Number of rings of the sliding-plate rig.
enum { SB_RIG_RINGS = 4 };

// The sliding-plate rig of thesis 3.3 (motion RIG); run/rig.h.
typedef struct {
  double load;               // normal load of the full plate [N]
  double mass;               // moved mass [kg]
  double coefficient;        // sliding friction divided by load, before effects of speed and dwell
  SbDynamicsContact contact; // friction law of one ring
  double speed;              // speed at which the motor winds the thread [m/s]
  double thread_stiffness, thread_damping; // of thread and load cell [N/m], [N s/m]
  double rest;                             // time at rest before the motor starts [s]
  double duration;                         // length of the record [s]
  double rate;                             // samples per second [1/s]
} SbRig;

// Default style of the section drawing; no result depends on it.
typedef struct {
  int field;                 // choice of output.field = SbField
  int insets;                // 0: of the outer seal, 1: of the inner seal, 2: none
  int section;               // SB_SECTION_HALF, ...
  double azimuth, elevation; // camera of the cutaway [rad]
  bool undeformed;           // draw the rings' free outline
  double field_max; // upper end of the colour scale of stresses [Pa]; 0: maximum of the run
} SbSectionLook;

// Views of a scene (output.views), a bit each.
typedef enum {
  SB_VIEW_HYSTERESIS = 1 << 0, // force against displacement
  SB_VIEW_PROFILES = 1 << 1,   // contact pressure and film against x
  SB_VIEW_SECTION = 1 << 2,    // section of the valve
  SB_VIEW_DASHBOARD = 1 << 3,  // several charts
  SB_VIEW_RIG = 1 << 4,        // force of the sliding plate
  SB_VIEW_LIFE = 1 << 5,       // actuations of a life
  SB_VIEW_SHELF = 1 << 6       // loss on the shelf
} SbView;

// Declares a field for a row of params.def; rows with IN have their field elsewhere.
#define SB_DECLARE_OWN(type, name) type name;
#define SB_DECLARE_IN(...)

// A ring (or gasket) and the quantities that follow from its size and gland. Sizes and modulus are
// those after storage, at the temperature of use. For a gasket squeeze is its crimp, interference
// the stem diameter minus the inner diameter, and stretch_mean, section_fitted and gland_fill are
// NaN. The SB_SEAL rows of params.def declare the members poisson_ratio, mooney_share [1],
// section_diameter_tolerance and inner_diameter_tolerance [m].
typedef struct {
  SbRubberStorage stored; // the new ring (section and inner diameter, modulus) and its history
  SbRubberState storage;  // result of the storage
#define SB_SEAL(id, stage, where, place, ...) SB_DECLARE_##where(double, place)
#include "engine/valve/model/params.def"
  double section_diameter; // d, diameter of the free section [m]
  double inner_diameter;   // of the free ring [m]
  double modulus;          // Young's modulus E [Pa]
  double reduced_modulus;  // E' of thesis equation 5.8: 2/E' = sum (1 - nu^2)/E [Pa]
  double radius;           // R_x = d/2 [m]
  double squeeze;          // (d - g)/d with the radial space g [1]
  double stretch_mean;     // of the mean diameter, (D_fitted - D_free)/D_free
  double stretch_inner;    // of the inner diameter
  double section_fitted;   // section diameter after stretch, d (1 - nu stretch_mean) [m]
  double interference;     // section_fitted - g [m]
  double gland_fill;       // ring volume divided by groove volume
} SbSealModel;

// Large data of a model, shared by reference count. The reader of a file creates and fills it
// before it creates a model; then it is constant and may be read by any thread.
typedef struct {
  atomic_uint holders;    // reference count
  SbModelSeries measured; // drive; count 0: none
  SbModelSeries shelf;    // temperatures over time of shelf.file; count 0: none
  SbSealDrawing profile;  // of seal.profile_file; count 0: none
  SbGrooveDrawing groove; // of gland.profile_file; count 0: none
  SbValveOutlines outlines;
  SbRubberSheet rubber; // borrowed by the parameters of the model
} SbModelData;

// Creates empty data with one reference, which the caller releases with sb_model_data_release().
// Then fill the fields except `holders`. SB_ERROR_MEMORY is the only error; there is no report.
SbStatus sb_model_data_create(SbModelData **out);

// Releases a reference; the last one frees the data. Any thread. Takes NULL.
void sb_model_data_release(const SbModelData *data);

// Returns a hash (FNV-1a) of the drawn section and groove; 0 if neither is drawn.
uint64_t sb_model_data_drawings(const SbModelData *data);

// Compiles parameters into a model; free it with sb_model_destroy(). The model takes a reference of
// its own to `data` (NULL: no series, drawings and outlines) and copies `limits` (NULL: none).
// params->rubber is borrowed and must exist as long as the model (usually &data->rubber).
// SB_ERROR_INPUT: inconsistent values. *problems (NULL: not wanted) is overwritten by the list of
// them, with the count 0 after SB_OK.
SbStatus sb_model_create(SbModel **out, const SbParams *params, const SbModelData *data,
                         const SbLimits *limits, SbProblems *problems);

// Compiles the parameters of `base` with overrides[count] in their place (NULL if the count is 0);
// the last one of a parameter applies. Data and limits are those of the base. Free the model with
// sb_model_destroy(). SB_ERROR_RANGE: an override is outside its range; SB_ERROR_INPUT: it is no
// valid value, or the values are inconsistent. The report has key, value and range.
SbStatus sb_model_derive(SbModel **out, const SbModel *base, const SbOverride *overrides,
                         size_t count, SbReport *report);

// Creates a copy, which sb_model_destroy() frees. SB_ERROR_MEMORY is its only error; there is no
// report.
SbStatus sb_model_copy(SbModel **out, const SbModel *model);

// Frees a model and its reference to the data.
void sb_model_destroy(const SbModel *model);

// Returns whether two models have equal values and limits and share the same data object. Both may
// be NULL; NULL equals NULL only.
bool sb_model_same(const SbModel *a, const SbModel *b);

// Returns the value of a parameter of the model as given or by its default, SI. It is the input:
// sizes at 20 degC, before storage.
double sb_model_value(const SbModel *model, SbParamId id);

// Returns the value of an integer parameter, the index of a choice, or the bit mask of flags.
int sb_model_number(const SbModel *model, SbParamId id);

// Computes the default of a parameter. Returns true if the model uses this default and it follows
// from another parameter or the named rubber; false if the value is given, or the catalogue's.
bool sb_model_default(SbParamDefault *out, const SbModel *model, SbParamId id);

// Returns a number that two models share if and only if they use the same numerical methods: kind
// of valve and section, models.* from fit to motion. Discretisation errors of such runs have the
// same sign and a similar relative size.
uint64_t sb_model_methods(const SbModel *model);

// Writes the name of the model's choice of parameter `id` to name[size].
void sb_model_choice_name(const SbModel *model, SbParamId id, char *name, size_t size);

// Returns what the model's fit (models.fit) computes; static.
const SbFitKind *sb_model_fit(const SbModel *model);

// Returns whether a return spring pushes the stem out.
bool sb_model_has_spring(const SbModel *model);

// Returns the ring SB_OUTER or SB_INNER.
const SbSealModel *sb_model_seal(const SbModel *model, int seal);

// Returns the sizes for the drawing.
const SbValveShape *sb_model_shape(const SbModel *model);

// Returns inertia and joints of the parts.
const SbValveParts *sb_model_parts(const SbModel *model);

// Returns the sliding plate (meaningful if no valve moves: sb_motion_kind()).
const SbRig *sb_model_rig(const SbModel *model);

// Returns the default style of the section drawing.
const SbSectionLook *sb_model_look(const SbModel *model);

// Returns the force p pi D_p^2/4 of the canister pressure p on the stem (D_p:
// stem.pressure_diameter) [N], which pushes the stem out.
double sb_model_pressure_force(const SbModel *model);

// Returns the combined rms roughness of the first actuation [m].
double sb_model_sigma(const SbModel *model);

// Returns the number (from 1) of the actuation whose frames are shown.
int sb_model_shown_actuation(const SbModel *model);

// Returns the measured series of the drive; NULL if the model has none.
const SbModelSeries *sb_model_measured(const SbModel *model);

// Returns the outlines of drawn parts; NULL: the model has no data.
const SbValveOutlines *sb_model_outlines(const SbModel *model);

// Writes to *out the sizes that are possible but unlikely to be intended, with key and usual range.
void sb_model_remarks(const SbModel *model, SbProblems *out);

// Effect of the temperature of use on the modulus.
typedef struct {
  double factor;      // modulus divided by that at 20 degC
  const char *tag;    // "given", "entropy elasticity", "inferred", "typical" or "published"
  const char *source; // reference
} SbModulusChange;

// Computes the effect of `temperature` [K] on the modulus of the outer seal. The strings are
// static, or borrowed from the model's rubber.
void sb_model_modulus(SbModulusChange *out, const SbModel *model, double temperature);

// Adds the warning "modulus-temperature" if the modulus is assumed to be independent of temperature
// and typical slopes would change it by more than about 3 % at `temperature` [K]; or
// "modulus-entropic" if entropy elasticity changes it so much, or replaces a known slope.
void sb_model_warn_modulus(const SbModel *model, double temperature, SbWarnings *warnings);

// Adds the warning "fluid-property" if the value of the fluid-dependent parameter `id` is that of
// another fluid (sb_params_other_fluid()).
void sb_model_warn_fluid(const SbModel *model, SbParamId id, SbWarnings *warnings);

// Adds the warnings of the model itself: storage of the rings, fluid.
void sb_model_warn(const SbModel *model, SbWarnings *warnings);

// Returns the drawn groove; NULL: none.
const SbGrooveDrawing *sb_model_groove(const SbModel *model);

// Returns sb_model_data_drawings() of the model's data; 0: no data.
uint64_t sb_model_drawings(const SbModel *model);

// Returns the free section's shape with the sizes at the temperature of use.
SbSealProfile sb_model_profile(const SbModel *model, int seal);

// Sets *out to the gland of a seal with its tolerances, for sb_gland_readouts(): sizes as given, at
// 20 degC. It borrows the model's drawn groove.
void sb_model_gland(SbGland *out, const SbModel *model, int seal);

// Sets *out to the fit problem of a seal by the model's choice, for the pressure difference
// `pressure` [Pa] (> 0: higher on the left). It borrows the model's drawn groove.
void sb_model_fit_problem(SbFitProblem *out, const SbModel *model, int seal, double pressure);

// Counters of solver calls. Initialise with {0}; functions only add to them.
typedef struct {
  // Fits of any model; fits of discs; fits of rings; films by Reynolds' equation; Newton
  // iterations.
  size_t fit_solves, disc_solves, ring_solves, reynolds_solves, newton_iterations;
  size_t film_steps;                             // time steps of film histories of both seals
  size_t speed_nodes;                            // states solved for interpolation over the speed
  size_t field_evaluations, profile_evaluations; // section fields; contact profiles
} SbCounters;
