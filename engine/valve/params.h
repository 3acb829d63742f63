// The parameter catalogue and a set of values.
//
// SbParams holds one double per parameter (SI; an index for a choice, a bit mask for flags) and
// whether it was given. What was not given follows: one seal's value from both seals', where
// SB_DEFAULT rows say so from a choice (models.set), from a named fluid at the canister's
// temperature (fluid.name), and from a named rubber (rubber.name). That is resolved whenever it is
// asked for, so that a choice that changes takes with it what follows from it. The catalogue knows
// ranges and texts; what a combination of values means is model.h.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum {
#define SB_REAL(id, ...) SB_P_##id,
#define SB_INT           SB_REAL
#define SB_CHOICE        SB_REAL
#define SB_FLAGS         SB_REAL
#define SB_SEAL(id, ...) SB_P_SEAL_##id, SB_P_SEAL_OUTER_##id, SB_P_SEAL_INNER_##id,
#include "engine/valve/params.def"
  SB_PARAM_COUNT
} SbParamId;

typedef enum { SB_PARAM_REAL, SB_PARAM_INT, SB_PARAM_CHOICE, SB_PARAM_FLAGS } SbParamKind;

// One row of the catalogue. All strings are static.
typedef struct {
  const char *key;     // "gland.radial_space": group, dot, name
  SbParamKind kind;    //
  const char *symbol;  // short symbol for panels, UTF-8
  const char *si;      // SI unit as udunits reads it, "1" if none
  const char *unit;    // unit shown and saved first, "" if none
  double min, max;     // allowed range, SI, inclusive
  double fallback;     // default, SI
  const char *choices; // "first|second" for choices and flags, else NULL
  const char *label;   // "Radial space"
  const char *help;    // one line
  const char *source;  // where the default comes from
  const char *tag;     // "thesis", "inferred", "ours", "published" or "typical"
  int parent;          // for seal.outer.X and seal.inner.X the id of seal.X, whose value they take
                       // when not given; -1 for every other parameter
} SbParam;

// Whether it is one of the few that a design begins with, of a kind of valve (valve.kind).
bool sb_param_is_main(SbParamId id, int kind);

// What people also call it, in small letters; "" for most. Borrowed.
const char *sb_param_words(SbParamId id);

// The parameter that holds its tolerance; -1 if none does.
int sb_param_tolerance(SbParamId id);

// A rubber by name: figures that stand where nobody gives them, each with its source. Whoever reads
// a file fills it.
enum { SB_RUBBER_FIGURES_MAX = 48, SB_SOURCE_MAX = 256 }; // bytes of a source
typedef struct {
  char name[48]; // as the file has it; empty: none
  size_t count;
  struct {
    SbParamId id;
    int fluid;    // choice of fluid.name that it holds for, -1: any
    double value; // SI
    bool typical; // usual of such rubbers, no figure of one
    char source[SB_SOURCE_MAX];
  } figure[SB_RUBBER_FIGURES_MAX];
} SbRubberSheet;

typedef struct {
  double value[SB_PARAM_COUNT]; // SI
  const SbRubberSheet *rubber;  // borrowed; NULL: none
  bool given[SB_PARAM_COUNT];
} SbParams;

// Row `id` of the catalogue; borrowed.
const SbParam *sb_param(SbParamId id);

// Id of a key, or -1.
int sb_param_find(const char *key);

// All defaults, nothing given.
void sb_params_init(SbParams *params);

// What a parameter is while nobody gives it, and why. Strings are static, or the rubber's.
typedef struct {
  double value;       // SI; NAN: of a fluid beyond the range of its figures
  const char *from;   // key that it follows from; NULL: the catalogue's own default
  int giver;          // that key's parameter; -1: it names no parameter
  const char *name;   // what that key is; NULL: the parameter's value
  const char *source; // where the value comes from
  const char *tag;    // as SbParam's
} SbParamDefault;

// That of `id` beside the given values of `params`: from the first source that has one, its parent,
// a choice that brings defaults, a named fluid, a named rubber, the catalogue.
void sb_params_default(SbParamDefault *out, const SbParams *params, SbParamId id);

// Whether `id` is a size that a drawing changes with the size `giver`, in a valve of a kind
// (valve.kind): while nobody gives it, the difference of the two stays.
bool sb_param_keeps(SbParamId id, SbParamId giver, int kind);

// Fluid (choice of fluid.name) that the value in force of a figure that depends on the fluid holds
// for, where this is another one than fluid.name: fluid.figures, or the one of which the named
// rubber has the given value. -1: the parameter is no such figure, or holds for fluid.name.
int sb_params_other_fluid(const SbParams *params, SbParamId id);

// The figures that depend on the fluid, counted from 0; -1: no more of them.
int sb_params_of_fluid(int index);

// States by fluid.figures that given figures which `params` shares with `base` hold for the base's
// fluid, where the two have different fluids and neither states another one.
void sb_params_keep_fluid(SbParams *params, const SbParams *base);

// Whether a parameter may be a figure of a rubber.
bool sb_param_of_rubber(SbParamId id);

// Whether a parameter has sources of its default beside the catalogue.
bool sb_param_follows(SbParamId id);

// The value in force: its own if given, else its default.
double sb_params_get(const SbParams *params, SbParamId id);

// All values in force, each given or not as in `given`.
void sb_params_resolve(SbParams *effective, const SbParams *given);

// Whether some choice brings a default for a parameter, and how often: `index` counts from 0. The
// parameter that chooses and the choice, with the default; false: no more of them.
bool sb_params_brought(SbParamDefault *out, int *choice, SbParamId id, int index);

// Sets a value [SI] after checking kind and range. SB_ERROR_INPUT (not a number, not whole) or
// SB_ERROR_RANGE; then nothing changes and the report names the key and the range in SI.
SbStatus sb_params_set(SbParams *params, SbParamId id, double value, SbReport *report);

// Index of `name` (length `length`) among the choices of a parameter, or -1.
int sb_param_choice(const SbParam *param, const char *name, size_t length);

// Copies the name of choice `index` into `name` (of `size` bytes); empty if there is none.
void sb_param_choice_name(const SbParam *param, int index, char *name, size_t size);

// Number of choices, 0 for other kinds.
int sb_param_choice_count(const SbParam *param);
