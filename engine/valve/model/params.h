// The parameter catalogue, and a set of parameter values.
//
// SbParams has one double for each parameter (SI; an index for a choice, a bit mask for flags) and
// whether it was given. The value of a parameter that was not given follows from the first source
// that has one: the value for both seals; a choice with SB_DEFAULT rows (models.set); another size;
// a named fluid at the canister's temperature (fluid.name); a named rubber (rubber.name); the
// catalogue. It is resolved whenever it is requested, so it follows changes of its sources. The
// catalogue has ranges and texts; model.h defines which combinations are valid.
//
// The catalogue is constant, and functions with `const SbParams *` may be called concurrently.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>

// Number of a parameter, SB_P_... by the first column of params.def. A parameter of a seal has
// three: for both seals, the outer and the inner one.
typedef enum {
#define SB_REAL(id, ...) SB_P_##id,
#define SB_INT           SB_REAL
#define SB_CHOICE        SB_REAL
#define SB_FLAGS         SB_REAL
#define SB_SEAL(id, ...) SB_P_SEAL_##id, SB_P_SEAL_OUTER_##id, SB_P_SEAL_INNER_##id,
#include "engine/valve/model/params.def"
  SB_PARAM_COUNT
} SbParamId;

// Kind of a parameter's value: a real number, an integer, the index of a choice, or a bit mask of
// flags (bit i: choice i).
typedef enum { SB_PARAM_REAL, SB_PARAM_INT, SB_PARAM_CHOICE, SB_PARAM_FLAGS } SbParamKind;

// One row of the catalogue. All strings are static.
typedef struct {
  const char *key;     // "gland.radial_space": group, dot, name
  SbParamKind kind;    //
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
  int parent; // seal.outer.X, seal.inner.X: number of seal.X, whose value applies when it is not
              // given; else -1
} SbParam;

// Returns whether it is one of the few parameters with which a design of this kind of valve
// (valve.kind) begins.
bool sb_param_is_main(SbParamId id, int kind);

// Returns synonyms of a parameter in lower case, for searches; "" for most. Static.
const char *sb_param_words(SbParamId id);

// Returns the number of the parameter that is its tolerance; -1 if there is none.
int sb_param_tolerance(SbParamId id);

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

// A set of values. Initialise with sb_params_init().
typedef struct {
  double value[SB_PARAM_COUNT]; // SI; not used if not given
  const SbRubberSheet *rubber;  // borrowed; NULL: none
  bool given[SB_PARAM_COUNT];
} SbParams;

// Returns the row of a parameter; static.
const SbParam *sb_param(SbParamId id);

// Returns the number of a key, or -1.
int sb_param_find(const char *key);

// Sets all parameters to not given, and no rubber.
void sb_params_init(SbParams *params);

// The default of a parameter and its source. Strings are static, or borrowed from the rubber.
typedef struct {
  double value;       // SI; NAN: a fluid outside the range of its properties
  const char *from;   // key from which it follows; NULL: the catalogue
  int giver;          // number of that key's parameter; -1: it is not a parameter
  const char *name;   // value of that key as text; NULL: see the parameter
  const char *source; // reference of the value
  const char *tag;    // as SbParam.tag
} SbParamDefault;

// Computes the default that `id` has for the values of `params`, whether it is given or not, from
// the first source that has one (see the top of this file).
void sb_params_default(SbParamDefault *out, const SbParams *params, SbParamId id);

// Returns whether, in a valve of `kind` (valve.kind), the size `id` follows the size `giver` with a
// constant difference while it is not given.
bool sb_param_keeps(SbParamId id, SbParamId giver, int kind);

// Returns the fluid (a choice of fluid.name) to which the value of a fluid-dependent parameter
// applies, if it is not the fluid of fluid.name: the fluid of fluid.figures, or the fluid for which
// the named rubber has this value. Returns -1 if `id` does not depend on the fluid, or if its value
// applies to fluid.name.
int sb_params_other_fluid(const SbParams *params, SbParamId id);

// Returns the number of the fluid-dependent parameter `index` (from 0); -1 after the last one.
int sb_params_of_fluid(int index);

// Sets fluid.figures of `params` to the fluid of `base`, if the two have different fluids, share a
// given fluid-dependent value, and neither has fluid.figures.
void sb_params_keep_fluid(SbParams *params, const SbParams *base);

// Returns whether a rubber's file may have a value of this parameter.
bool sb_param_of_rubber(SbParamId id);

// Returns whether the default of a parameter may follow from something other than the catalogue.
bool sb_param_follows(SbParamId id);

// Returns the value of a parameter: the given one, else its default. SI; NAN: see SbParamDefault.
double sb_params_get(const SbParams *params, SbParamId id);

// Copies `given` to *effective with all values resolved; `given` flags are unchanged.
void sb_params_resolve(SbParams *effective, const SbParams *given);

// Returns the default number `index` (from 0) that a choice has for parameter `id`: out->giver is
// the choosing parameter, *choice its choice. Returns false after the last one.
bool sb_params_brought(SbParamDefault *out, int *choice, SbParamId id, int index);

// Sets a value [SI] as given. After SB_ERROR_INPUT (not finite, not an integer) or SB_ERROR_RANGE
// nothing has changed; the report has key and range in SI.
SbStatus sb_params_set(SbParams *params, SbParamId id, double value, SbReport *report);

// Returns the index of the choice whose name is the first `length` bytes of `name`, or -1.
int sb_param_choice(const SbParam *param, const char *name, size_t length);

// Writes the name of choice `index` to name[size]; "" if there is none.
void sb_param_choice_name(const SbParam *param, int index, char *name, size_t size);

// Returns the number of choices; 0 for numbers.
int sb_param_choice_count(const SbParam *param);
