// The parameter catalogue (params.def), and a set of parameter values.
//
// SbParams has one double for each parameter, and whether the user gave it: a number in SI, the
// index of a choice, or a bit mask of flags. The value of a parameter that was not given follows
// from the first of these sources that has one: seal.X for seal.outer.X and seal.inner.X; a choice
// with SB_DEFAULT rows (models.set); another size (SB_KEEPS); the named fluid at the canister's
// temperature (fluid.name); the named rubber (rubber.name); the catalogue. sb_params_get() resolves
// it at each call, so it follows changes of its sources. The catalogue has the range of each
// parameter; sb_model_create() checks combinations.
//
// The catalogue is constant. Functions with `const SbParams *` may be called concurrently for one
// set.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>

// Number of a parameter: SB_P_ID for each row of params.def with this ID. A row SB_SEAL has three,
// SB_P_SEAL_ID (both seals), SB_P_SEAL_OUTER_ID and SB_P_SEAL_INNER_ID.
typedef enum {
#define SB_REAL(id, ...) SB_P_##id,
#define SB_INT           SB_REAL
#define SB_CHOICE        SB_REAL
#define SB_FLAGS         SB_REAL
#define SB_SEAL(id, ...) SB_P_SEAL_##id, SB_P_SEAL_OUTER_##id, SB_P_SEAL_INNER_##id,
#include "engine/valve/model/params.def"
  SB_PARAM_COUNT
} SbParamId;

// X(group, name): all groups of keys, the part of a key before its first dot.
#define SB_PARAM_GROUP_LIST(X)                                                                     \
  X(BORE, "bore")                                                                                  \
  X(CANISTER, "canister")                                                                          \
  X(CHAMBER, "chamber")                                                                            \
  X(DRIVE, "drive")                                                                                \
  X(FLUID, "fluid")                                                                                \
  X(FRICTION, "friction")                                                                          \
  X(GASKET, "gasket")                                                                              \
  X(GLAND, "gland")                                                                                \
  X(HOUSING, "housing")                                                                            \
  X(JOINT, "joint")                                                                                \
  X(LIFE, "life")                                                                                  \
  X(MODELS, "models")                                                                              \
  X(OUTPUT, "output")                                                                              \
  X(PART, "part")                                                                                  \
  X(PEOPLE, "people")                                                                              \
  X(RIG, "rig")                                                                                    \
  X(RUBBER, "rubber")                                                                              \
  X(SEAL, "seal")                                                                                  \
  X(SHELF, "shelf")                                                                                \
  X(STEM, "stem")                                                                                  \
  X(STORAGE, "storage")                                                                            \
  X(STUDY, "study")                                                                                \
  X(SURFACE, "surface")                                                                            \
  X(VALVE, "valve")

// Group of a parameter, SB_PARAMS_BORE, ...
typedef enum {
#define SB_PARAM_GROUP_ENUM(group, name) SB_PARAMS_##group,
  SB_PARAM_GROUP_LIST(SB_PARAM_GROUP_ENUM)
#undef SB_PARAM_GROUP_ENUM
      SB_PARAMS_GROUP_COUNT
} SbParamGroup;

// Kind of a parameter's value: a real number, an integer, the index of a choice, or a bit mask of
// flags (bit i: choice i).
typedef enum { SB_PARAM_REAL, SB_PARAM_INT, SB_PARAM_CHOICE, SB_PARAM_FLAGS } SbParamKind;

// Stage at which an input enters. Results of an earlier stage do not depend on it. The model
// derives sizes, moduli and properties of the fluid from the inputs of RUBBER and FLUID: these
// inputs enter the later stages only by the derived values.
typedef enum {
  SB_ENTERS_GEOMETRY, // sizes of parts and gland
  SB_ENTERS_RUBBER,   // the rubber and its storage, expansion of the parts
  SB_ENTERS_FLUID,    // the fluid and its temperature
  SB_ENTERS_FIT,      // contact of a ring at rest, pressures, tolerance of the solvers
  SB_ENTERS_FILM,     // film of a sliding ring
  SB_ENTERS_SURFACE,  // rough contact
  SB_ENTERS_FRICTION, // friction, static friction
  SB_ENTERS_MOTION,   // drive, masses, springs, chamber and ports, the rig
  SB_ENTERS_LIFE,     // the actuations after the first, the contents of the canister
  SB_ENTERS_SHELF,    // loss and moisture at rest
  SB_ENTERS_VIEW      // pictures, studies, tolerances of sizes, people: no state
} SbInputStage;

// One row of the catalogue. All strings are static.
typedef struct {
  SbInputStage stage; // at which it enters
  SbParamKind kind;   // number, choice or flags
  int parent; // of seal.outer.X and seal.inner.X: number of seal.X, whose value applies to a seal
              // without its own; of all other parameters -1
  int seal;   // SB_OUTER of seal.outer.X, SB_INNER of seal.inner.X; else SB_SEAL_COUNT
  const char *key;     // "gland.radial_space": group, dot, name
  const char *symbol;  // short symbol for panels, UTF-8; "" if none
  const char *si;      // SI unit in the notation of udunits, "1" if dimensionless
  const char *unit;    // preferred unit for display and files, "" if none
  double min, max;     // allowed range of numbers, SI, inclusive
  double fallback;     // the catalogue's default, SI
  const char *choices; // "first|second" for choices and flags, else NULL
  const char *label;   // "Radial space"
  const char *help;    // one line
  const char *source;  // where the default is from
  const char *tag;     // "thesis", "inferred", "ours", "published" or "typical"
} SbParam;

// Returns whether `id` is one of the few parameters with which a design of a valve of `kind` (an
// SbValveKind, valve.kind) begins.
bool sb_param_is_main(SbParamId id, int kind);

// Returns synonyms of a parameter in lower case, for searches; "" for most. Static.
const char *sb_param_words(SbParamId id);

// Returns the SbParamId of the tolerance of size `id` (key with "_tolerance" appended); -1 if there
// is none.
int sb_param_tolerance(SbParamId id);

// Returns the SbParamId of the size whose tolerance is `id`; -1 if `id` is not a tolerance of a
// size.
int sb_param_toleranced(SbParamId id);

// Numbers of the valve's inputs in reports and warnings (SbReport.input): its parameters from
// SB_VALVE_INPUTS (status.h) on, then the files that keys of documents name.
enum {
  SB_INPUT_SECTION_FILE = SB_VALVE_INPUTS + SB_PARAM_COUNT, // seal.profile_file
  SB_INPUT_GROOVE_FILE,                                     // gland.profile_file
  SB_INPUT_DRIVE_FILE,                                      // drive.file
  SB_INPUT_SHELF_FILE,                                      // shelf.file
  SB_INPUT_END
};

// Returns the number of a parameter in reports and warnings.
static inline int sb_input(SbParamId id) {
  return SB_VALVE_INPUTS + (int)id;
}

// Maps an SbReport.input of a module that the valve uses (SB_CONTACT_IN_..., SB_FILM_IN_... and
// those of rubber, fluid and mechanism) to the number of the valve's input. Returns any other
// number unchanged. The next two functions also take both kinds of numbers.
int sb_input_resolve(int input);

// Returns the SbParamId of an input; -1 if the input is not a parameter.
int sb_input_parameter(int input);

// Returns the key of an input (of a parameter or a file); "" if there is none. Static.
const char *sb_input_key(int input);

// Returns the number of the valve's input with this key; 0 if there is none.
int sb_input_find(const char *key);

// Largest number of values of a rubber, and bytes of a source.
enum { SB_RUBBER_FIGURES_MAX = 48, SB_SOURCE_MAX = 256 };

// A named rubber: values of parameters that apply if they are not given, each with its source. The
// reader of a rubber's file fills it.
typedef struct {
  char name[48]; // as in the file; "": none
  size_t count;  // values in use
  struct {
    SbParamId id;
    int fluid;    // choice of fluid.name for which it applies, -1: any
    double value; // SI
    bool typical; // typical of such rubbers, not measured on this one
    char source[SB_SOURCE_MAX];
  } figure[SB_RUBBER_FIGURES_MAX];
} SbRubberSheet;

// Number of rows SB_KEEPS: sizes that follow another size with a constant difference while they are
// not given.
enum {
  SB_KEEPS_COUNT = 0
#define SB_KEEPS(...) +1
#include "engine/valve/model/params.def"
};

// A set of values. Initialise with sb_params_init(); set values with sb_params_set(), and given[id]
// to false to return to the default.
typedef struct {
  double value[SB_PARAM_COUNT]; // SI; not used if not given
  const SbRubberSheet *rubber;  // borrowed; NULL: none
  bool given[SB_PARAM_COUNT];
  // Of each row SB_KEEPS whose size is given: the value [SI] that the followed size has in the
  // drawing from which this size is; 0: not known. sb_params_set() of the size makes it 0.
  double drawn[SB_KEEPS_COUNT];
} SbParams;

// Returns the row of a parameter; static.
const SbParam *sb_param(SbParamId id);

// Returns the number of a key, or -1.
int sb_param_find(const char *key);

// Returns the group of a parameter.
SbParamGroup sb_param_group(SbParamId id);

// Sets all parameters to not given, and `rubber` to NULL.
void sb_params_init(SbParams *params);

// The default of a parameter and its source. Strings are static, or borrowed from the rubber.
typedef struct {
  double value;       // SI; NAN: the fluid has no such property at the canister's temperature
  const char *from;   // key from which the value follows; NULL: the catalogue
  int giver;          // SbParamId of `from`; -1: `from` is not a parameter (rubber.name)
  const char *name;   // value of `from` as text, if it is not a parameter; else NULL
  const char *source; // reference of the value
  const char *tag;    // as SbParam.tag
  bool typical;       // typical of such rubbers, not measured on the named one
} SbParamDefault;

// Computes the default that `id` has for the values of `params`, whether it is given or not, from
// the first source that has one (see the top of this file).
void sb_params_default(SbParamDefault *out, const SbParams *params, SbParamId id);

// Row `index` (below SB_KEEPS_COUNT) of SB_KEEPS, in a valve of `kind` (valve.kind): writes the
// size to *id, the size that it follows to *giver, and to *sign 1 if it grows with that size, -1 if
// it shrinks by as much. Returns false if the row is for another kind.
bool sb_params_keeps(SbParamId *id, SbParamId *giver, double *sign, int index, int kind);

// Number of checks of sizes that belong together: one for each row SB_KEEPS, then the chamber.
enum { SB_SIZE_CHECKS = SB_KEEPS_COUNT + 1 };

// Writes the size of check `index` (below SB_SIZE_CHECKS) to *id. Returns NULL if the size fits the
// others; else the code of the warning, and writes a sentence for the user to `text`. "size-kept":
// the size of a row SB_KEEPS is given while the size that it would follow differs from
// params->drawn[index] (> 0) by more than the tolerance of the row. "size-limited": the size
// follows another one out of its own range, whose end applies. "size-overlap": the dose chamber is
// longer than the stem between the grooves.
const char *sb_params_size_check(char text[SB_TEXT], SbParamId *id, const SbParams *params,
                                 int index);

// Returns the fluid (a choice of fluid.name) for which the value of the fluid-dependent
// parameter `id` is meant, if this is not the fluid of fluid.name: the fluid of the catalogue's
// default, whether it is given or not; the fluid of fluid.figures; or the fluid for which the named
// rubber has the same value. Returns -1 if the value is meant for fluid.name, if the parameter is
// 0, or if `id` does not depend on the fluid.
int sb_params_other_fluid(const SbParams *params, SbParamId id);

// Returns the SbParamId of the fluid-dependent parameter number `index` (from 0): a property of the
// liquid or vapour, or of rubber or plastic in it; -1 after the last one.
int sb_params_of_fluid(int index);

// Call it after changes to `params`, a copy of `base`. Sets fluid.figures of `params` to the fluid
// of `base`, if the two have different fluids, share a given fluid-dependent value above 0, and
// neither has fluid.figures; so the value remains that of the fluid for which it was given.
void sb_params_keep_fluid(SbParams *params, const SbParams *base);

// Returns whether a rubber's file may have a value of this parameter.
bool sb_param_of_rubber(SbParamId id);

// Returns whether the default of a parameter may follow from something other than the catalogue.
bool sb_param_follows(SbParamId id);

// Returns the value of a parameter: the given one, else its default. SI; NAN: see SbParamDefault.
double sb_params_get(const SbParams *params, SbParamId id);

// Copies `given` to *effective with all values resolved; `given` flags are unchanged.
void sb_params_resolve(SbParams *effective, const SbParams *given);

// Enumerates the SB_DEFAULT rows of `id`. Writes row number `index` (from 0) to *out, with the
// choosing parameter in out->giver and the index of its choice in *choice. Returns false, and
// leaves both, after the last one.
bool sb_params_brought(SbParamDefault *out, int *choice, SbParamId id, int index);

// Sets the value of `id` (SI, index of a choice, or bit mask) and marks it as given.
// SB_ERROR_INPUT: not finite, or not an integer where one is required; SB_ERROR_RANGE: outside min
// to max, or no such choice. *params is unchanged after an error, and the report has the input, and
// the range in SI in its text.
SbStatus sb_params_set(SbParams *params, SbParamId id, double value, SbReport *report);

// Returns the index of the choice whose name equals the first `length` bytes of `name` (which needs
// no NUL there); -1 if there is none.
int sb_param_choice(const SbParam *param, const char *name, size_t length);

// Writes the name of choice or flag `index` to name[size]; "" if there is none.
void sb_param_choice_name(const SbParam *param, int index, char *name, size_t size);

// Returns the number of choices or flags; 0 for numbers.
int sb_param_choice_count(const SbParam *param);
