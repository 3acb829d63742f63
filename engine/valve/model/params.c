// The catalogue's table and the checks that need nothing but the table.
#include "engine/film/film.h"
#include "engine/fluid/fluid.h"
#include "engine/valve/model/valve.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// All rows have the same form, except for what a kind omits.
#define ROW(id, stage, kind, parent, seal, ...)                                                    \
  [SB_P_##id] = {SB_ENTERS_##stage, kind, parent, seal, __VA_ARGS__},
#define SB_REAL(id, stage, where, place, key, symbol, si, unit, min, max, fallback, ...)           \
  ROW(id, stage, SB_PARAM_REAL, -1, SB_SEAL_COUNT, key, symbol, si, unit, min, max, fallback,      \
      NULL, __VA_ARGS__)
#define SB_INT(id, stage, where, place, key, symbol, min, max, fallback, ...)                      \
  ROW(id, stage, SB_PARAM_INT, -1, SB_SEAL_COUNT, key, symbol, "1", "", min, max, fallback, NULL,  \
      __VA_ARGS__)
#define SB_CHOICE(id, stage, type, where, place, key, choices, fallback, ...)                      \
  ROW(id, stage, SB_PARAM_CHOICE, -1, SB_SEAL_COUNT, key, "", "1", "", 0, 0, fallback, choices,    \
      __VA_ARGS__)
#define SB_FLAGS(id, stage, where, place, key, choices, fallback, ...)                             \
  ROW(id, stage, SB_PARAM_FLAGS, -1, SB_SEAL_COUNT, key, "", "1", "", 0, 0, fallback, choices,     \
      __VA_ARGS__)
#define SEAL_ROW(id, stage, parent, seal, key, symbol, si, unit, min, max, fallback, ...)          \
  ROW(SEAL_##id, stage, SB_PARAM_REAL, parent, seal, key, symbol, si, unit, min, max, fallback,    \
      NULL, __VA_ARGS__)
#define SB_SEAL(id, stage, where, place, name, ...)                                                \
  SEAL_ROW(id, stage, -1, SB_SEAL_COUNT, "seal." name, __VA_ARGS__)                                \
  SEAL_ROW(OUTER_##id, stage, SB_P_SEAL_##id, SB_OUTER, "seal.outer." name, __VA_ARGS__)           \
  SEAL_ROW(INNER_##id, stage, SB_P_SEAL_##id, SB_INNER, "seal.inner." name, __VA_ARGS__)
static const SbParam table[SB_PARAM_COUNT] = {
#include "engine/valve/model/params.def"
};

static const struct {
  SbParamId id, giver;
  int choice;
  double value;
  const char *source, *tag;
} brought[] = {
#define SB_DEFAULT(id, giver, choice, value, source, tag)                                          \
  {SB_P_##id, SB_P_##giver, choice, value, source, tag},
#include "engine/valve/model/params.def"
};

bool sb_params_brought(SbParamDefault *out, int *choice, SbParamId id, int index) {
  for (size_t i = 0; i < sizeof brought / sizeof brought[0]; i++) {
    if (brought[i].id == id && index-- == 0) {
      *choice = brought[i].choice;
      *out = (SbParamDefault){.value = brought[i].value,
                              .from = table[brought[i].giver].key,
                              .giver = (int)brought[i].giver,
                              .source = brought[i].source,
                              .tag = brought[i].tag};
      return true;
    }
  }
  return false;
}

// Of which kinds of valves it is one of the main ones, a bit each.
enum { PISTON = 1 << SB_VALVE_PISTON, GASKET = 1 << SB_VALVE_GASKET, BOTH = PISTON | GASKET };
static const unsigned char main_ones[SB_PARAM_COUNT] = {
#define SB_MAIN(id, kinds) [SB_P_##id] = kinds,
#include "engine/valve/model/params.def"
};

static const char *const words[SB_PARAM_COUNT] = {
#define SB_WORDS(id, text) [SB_P_##id] = text,
#include "engine/valve/model/params.def"
};

bool sb_param_is_main(SbParamId id, int kind) {
  return ((unsigned)main_ones[id] >> kind & 1u) != 0;
}

const char *sb_param_words(SbParamId id) {
  return words[id] != NULL ? words[id] : "";
}

int sb_param_tolerance(SbParamId id) {
  char key[96];
  snprintf(key, sizeof key, "%s_tolerance", table[id].key);
  return sb_param_find(key);
}

int sb_param_toleranced(SbParamId id) {
  const char *key = table[id].key, *ending = strstr(key, "_tolerance");
  char size[96];
  snprintf(size, sizeof size, "%.*s", ending != NULL ? (int)(ending - key) : 0, key);
  return sb_param_find(size);
}

SbParamGroup sb_param_group(SbParamId id) {
  static const char *const names[] = {
#define SB_PARAM_GROUP_NAME(group, name) name,
      SB_PARAM_GROUP_LIST(SB_PARAM_GROUP_NAME)
#undef SB_PARAM_GROUP_NAME
  };
  const size_t length = strcspn(table[id].key, ".");
  int group = 0;
  while (group < SB_PARAMS_GROUP_COUNT &&
         (strncmp(table[id].key, names[group], length) != 0 || names[group][length] != '\0')) {
    group++;
  }
  return (SbParamGroup)group;
}

const SbParam *sb_param(SbParamId id) {
  return &table[id];
}

int sb_param_find(const char *key) {
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    if (strcmp(table[i].key, key) == 0) {
      return i;
    }
  }
  return -1;
}

void sb_params_init(SbParams *params) {
  params->rubber = NULL;
  memset(params->drawn, 0, sizeof params->drawn);
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    params->value[i] = table[i].fallback;
    params->given[i] = false;
  }
}

static bool from_parent(SbParamDefault *out, const SbParams *params, SbParamId id) {
  const int parent = table[id].parent;
  if (parent >= 0) {
    *out = (SbParamDefault){.value = sb_params_get(params, (SbParamId)parent),
                            .from = table[parent].key,
                            .giver = parent,
                            .source = "as for both seals",
                            .tag = table[id].tag};
  }
  return parent >= 0;
}

static bool from_choice(SbParamDefault *out, const SbParams *params, SbParamId id) {
  int choice;
  for (int i = 0; sb_params_brought(out, &choice, id, i); i++) {
    if (sb_params_get(params, (SbParamId)out->giver) == choice) {
      return true;
    }
  }
  return false;
}

static const struct {
  SbParamId id, giver, tolerance;
  int kind; // of the valve
  double own, sign, given;
  const char *source;
} keeps[] = {
#define SB_KEEPS(id, giver, tolerance, kind, own, sign, given, source)                             \
  {SB_P_##id, SB_P_##giver, SB_P_##tolerance, kind, own, sign, given, source},
#include "engine/valve/model/params.def"
};

// By how much the followed size of a row differs from its default, with the sign of the row.
static double moved_by(const SbParams *params, int row) {
  return keeps[row].sign * (sb_params_get(params, keeps[row].giver) - keeps[row].given);
}

// A size that is not given, of which `row` is one, with no regard to its range. To 1e-15 m: the
// difference of decimals is a decimal (6.2 less 0.206 mm is 5.994 mm).
static double followed(const SbParams *params, int row) {
  double value = keeps[row].own;
  for (int i = 0; i < SB_KEEPS_COUNT; i++) {
    const bool same = keeps[i].id == keeps[row].id && keeps[i].kind == keeps[row].kind;
    value += same ? moved_by(params, i) : 0;
  }
  return round(value * 1e15) / 1e15;
}

// A size that differs from others by what their defaults differ by. At the others' defaults it is
// exactly its own. The first of the others that moves it is named.
static bool from_size(SbParamDefault *out, const SbParams *params, SbParamId id) {
  int row = -1;
  for (int i = 0; i < SB_KEEPS_COUNT; i++) {
    const bool follows =
        keeps[i].id == id && (int)sb_params_get(params, SB_P_VALVE_KIND) == keeps[i].kind;
    if (follows && (row < 0 || (moved_by(params, row) == 0 && moved_by(params, i) != 0))) {
      row = i;
    }
  }
  if (row < 0) {
    return false;
  }
  *out = (SbParamDefault){.value = followed(params, row),
                          .from = table[keeps[row].giver].key,
                          .giver = (int)keeps[row].giver,
                          .source = keeps[row].source,
                          .tag = table[id].tag};
  out->value = fmin(fmax(out->value, table[id].min), table[id].max);
  return true;
}

bool sb_params_keeps(SbParamId *id, SbParamId *giver, double *sign, int index, int kind) {
  *id = keeps[index].id;
  *giver = keeps[index].giver;
  *sign = keeps[index].sign;
  return keeps[index].kind == kind;
}

// Whether the dose chamber is longer than the stem between its grooves.
static bool chamber_overlaps(char text[SB_TEXT], const SbParams *params) {
  const double length = sb_params_get(params, SB_P_STEM_CHAMBER_LENGTH);
  const double space =
      sb_params_get(params, SB_P_STEM_SEAL_SPACING) - sb_params_get(params, SB_P_GLAND_AXIAL_WIDTH);
  if ((int)sb_params_get(params, SB_P_VALVE_KIND) != SB_VALVE_PISTON || length <= space + 1e-9) {
    return false;
  }
  sb_text(text, SB_TEXT,
          "the dose chamber does not fit between the grooves: %s is %.6g mm, %s less %s leaves "
          "%.6g mm",
          table[SB_P_STEM_CHAMBER_LENGTH].key, 1e3 * length, table[SB_P_STEM_SEAL_SPACING].key,
          table[SB_P_GLAND_AXIAL_WIDTH].key, 1e3 * space);
  return true;
}

const char *sb_params_size_check(char text[SB_TEXT], SbParamId *id, const SbParams *params,
                                 int index) {
  if (index == SB_KEEPS_COUNT) {
    *id = SB_P_STEM_CHAMBER_LENGTH;
    return chamber_overlaps(text, params) ? "size-overlap" : NULL;
  }
  *id = keeps[index].id;
  const SbParamId giver = keeps[index].giver;
  const bool row = keeps[index].kind == (int)sb_params_get(params, SB_P_VALVE_KIND);
  const double now = sb_params_get(params, giver), drawn = params->drawn[index];
  const double scatter = sb_params_get(params, keeps[index].tolerance) + 1e-12;
  if (row && !params->given[*id] && moved_by(params, index) != 0 &&
      followed(params, index) != sb_params_get(params, *id)) {
    sb_text(text, SB_TEXT,
            "%s follows %s to %.6g mm, which is out of its range: it is %.6g mm; set it too",
            table[*id].key, table[giver].key, 1e3 * followed(params, index),
            1e3 * sb_params_get(params, *id));
    return "size-limited";
  }
  if (!row || !params->given[*id] || !(drawn > 0) || fabs(now - drawn) <= scatter) {
    return NULL;
  }
  sb_text(text, SB_TEXT,
          "%s stays at %.6g mm while %s changes from %.6g mm to %.6g mm; set it too if the drawing "
          "changes both",
          table[*id].key, 1e3 * params->value[*id], table[giver].key, 1e3 * drawn, 1e3 * now);
  return "size-kept";
}

static bool is_kept(SbParamId id) {
  int i = 0;
  while (i < SB_KEEPS_COUNT && keeps[i].id != id) {
    i++;
  }
  return i < SB_KEEPS_COUNT;
}

// Parameters that follow from the saturated state of a named fluid.
static const struct {
  SbParamId id;
  SbFluidPropertyId property;
} of_fluid[] = {{SB_P_CANISTER_PRESSURE, SB_FLUID_PRESSURE},
                {SB_P_FLUID_VISCOSITY, SB_FLUID_VISCOSITY},
                {SB_P_FLUID_DENSITY, SB_FLUID_LIQUID}};
enum { OF_FLUID = sizeof of_fluid / sizeof of_fluid[0] };

static size_t place_of_fluid(SbParamId id) {
  size_t at = 0;
  while (at < OF_FLUID && of_fluid[at].id != id) {
    at++;
  }
  return at;
}

static bool from_fluid(SbParamDefault *out, const SbParams *params, SbParamId id) {
  const size_t at = place_of_fluid(id);
  const int fluid = at < OF_FLUID ? (int)sb_params_get(params, SB_P_FLUID_NAME) : 0;
  SbFluidState state;
  if (fluid == 0) {
    return false;
  }
  *out = (SbParamDefault){.value = NAN,
                          .from = table[SB_P_FLUID_NAME].key,
                          .giver = SB_P_FLUID_NAME,
                          .source = "beyond the range of the fluid's figures",
                          .tag = "published"};
  if (sb_fluid_state(&state, NULL, &sb_fluids[fluid],
                     sb_params_get(params, SB_P_CANISTER_TEMPERATURE),
                     sb_params_get(params, SB_P_FLUID_ETHANOL), NULL) == SB_OK) {
    const SbFluidFigure *figure = &state.figure[of_fluid[at].property];
    const bool gauge = id == SB_P_CANISTER_PRESSURE;
    out->value =
        figure->value - (gauge ? sb_params_get(params, SB_P_CANISTER_AMBIENT_PRESSURE) : 0);
    out->source = figure->source;
    return !isnan(figure->value); // an oil has no vapour pressure
  }
  return true;
}

bool sb_param_of_rubber(SbParamId id) {
  return sb_param_group(id) == SB_PARAMS_RUBBER || id == SB_P_SEAL_MODULUS ||
         id == SB_P_SEAL_POISSON_RATIO || id == SB_P_SEAL_MOONEY_SHARE;
}

// Parameters that depend on the fluid. `fluid`: that of the catalogue's default (a choice of
// fluid.name; custom: the thesis' HFA-134a), -1: the default is of none.
enum { CUSTOM, HFA_134A };
static const struct {
  SbParamId id;
  int fluid;
} figures[] = {{SB_P_RUBBER_SWELL_MASS, -1},
               {SB_P_RUBBER_PERMEABILITY, -1},
               {SB_P_HOUSING_PERMEABILITY, -1},
               {SB_P_RUBBER_DIFFUSION, HFA_134A},
               {SB_P_FLUID_PRESSURE_VISCOSITY, HFA_134A},
               {SB_P_FLUID_VAPOUR_VISCOSITY, HFA_134A}};

int sb_params_of_fluid(int index) {
  const int count = (int)(sizeof figures / sizeof figures[0]);
  return index < count ? (int)figures[index].id : -1;
}

// Whether a figure has the value of the catalogue, whose fluid is known.
static bool is_of_catalogue(const SbParams *params, int index) {
  const SbParamId id = figures[index].id;
  return figures[index].fluid >= 0 && sb_params_get(params, id) == table[id].fallback;
}

// Fluid of which figures that depend on the fluid are taken from a rubber.
static int figures_fluid(const SbParams *params) {
  const int other = (int)sb_params_get(params, SB_P_FLUID_FIGURES);
  return other > 0 ? other : (int)sb_params_get(params, SB_P_FLUID_NAME);
}

// The fluid of which a rubber has just this figure; -1: none, or it has one of `fluid`.
static int fluid_of_value(const SbRubberSheet *rubber, SbParamId id, double value, int fluid) {
  int found = -1;
  for (size_t i = 0; rubber != NULL && i < rubber->count; i++) {
    if (rubber->figure[i].id == id && rubber->figure[i].fluid == fluid) {
      return -1;
    }
    const bool same = fabs(rubber->figure[i].value - value) <= 1e-9 * fabs(value);
    found = rubber->figure[i].id == id && same ? rubber->figure[i].fluid : found;
  }
  return found;
}

int sb_params_other_fluid(const SbParams *params, SbParamId id) {
  const int own = (int)sb_params_get(params, SB_P_FLUID_NAME), stated = figures_fluid(params);
  int i = 0;
  while (sb_params_of_fluid(i) >= 0 && sb_params_of_fluid(i) != (int)id) {
    i++;
  }
  if (sb_params_of_fluid(i) < 0 || !(sb_params_get(params, id) > 0)) {
    return -1;
  }
  if (is_of_catalogue(params, i)) {
    return own == CUSTOM || own == figures[i].fluid ? -1 : figures[i].fluid;
  }
  if (stated != own) {
    return stated;
  }
  return params->given[id] ? fluid_of_value(params->rubber, id, params->value[id], own) : -1;
}

void sb_params_keep_fluid(SbParams *params, const SbParams *base) {
  const int from = (int)sb_params_get(base, SB_P_FLUID_NAME);
  const bool stated = params->given[SB_P_FLUID_FIGURES] || base->given[SB_P_FLUID_FIGURES];
  // A fluid without a name has no figures, and other fluids than propellants are no choices.
  if (stated || from < 1 || from >= sb_param_choice_count(&table[SB_P_FLUID_FIGURES]) ||
      from == (int)sb_params_get(params, SB_P_FLUID_NAME)) {
    return;
  }
  for (int i = 0; sb_params_of_fluid(i) >= 0; i++) {
    const int id = sb_params_of_fluid(i);
    if (params->given[id] && base->given[id] && params->value[id] == base->value[id] &&
        params->value[id] > 0 && !is_of_catalogue(params, i)) {
      params->value[SB_P_FLUID_FIGURES] = from;
      params->given[SB_P_FLUID_FIGURES] = true;
    }
  }
}

static bool from_rubber(SbParamDefault *out, const SbParams *params, SbParamId id) {
  const SbRubberSheet *rubber = params->rubber;
  for (size_t i = 0; rubber != NULL && i < rubber->count; i++) {
    const int fluid = rubber->figure[i].fluid;
    if (rubber->figure[i].id == id && (fluid < 0 || fluid == figures_fluid(params))) {
      *out = (SbParamDefault){.value = rubber->figure[i].value,
                              .from = "rubber.name",
                              .giver = -1,
                              .name = rubber->name,
                              .source = rubber->figure[i].source,
                              .tag = rubber->figure[i].typical ? "typical" : "published",
                              .typical = rubber->figure[i].typical};
      return true;
    }
  }
  return false;
}

static bool from_catalogue(SbParamDefault *out, const SbParams *params, SbParamId id) {
  *out = (SbParamDefault){
      .value = table[id].fallback, .giver = -1, .source = table[id].source, .tag = table[id].tag};
  return true;
}

void sb_params_default(SbParamDefault *out, const SbParams *params, SbParamId id) {
  static bool (*const sources[])(SbParamDefault *, const SbParams *, SbParamId) = {
      from_parent, from_choice, from_size, from_fluid, from_rubber, from_catalogue};
  for (size_t i = 0; !sources[i](out, params, id); i++) {
  }
}

bool sb_param_follows(SbParamId id) {
  SbParamDefault derived;
  int choice;
  return table[id].parent >= 0 || sb_params_brought(&derived, &choice, id, 0) || is_kept(id) ||
         place_of_fluid(id) < OF_FLUID || sb_param_of_rubber(id);
}

double sb_params_get(const SbParams *params, SbParamId id) {
  if (params->given[id]) {
    return params->value[id];
  }
  SbParamDefault derived;
  sb_params_default(&derived, params, id);
  return derived.value;
}

void sb_params_resolve(SbParams *effective, const SbParams *given) {
  effective->rubber = given->rubber;
  memcpy(effective->drawn, given->drawn, sizeof effective->drawn);
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    effective->value[i] = sb_params_get(given, (SbParamId)i);
    effective->given[i] = given->given[i];
  }
}

SbStatus sb_params_set(SbParams *params, SbParamId id, double value, SbReport *report) {
  const SbParam *param = &table[id];
  double min = param->min;
  double max = param->max;
  if (param->kind == SB_PARAM_CHOICE) {
    max = sb_param_choice_count(param) - 1;
  } else if (param->kind == SB_PARAM_FLAGS) {
    max = (double)((1u << sb_param_choice_count(param)) - 1u);
  }
  if (!isfinite(value)) {
    return sb_fail_input(report, SB_ERROR_INPUT, sb_input(id), "not a finite number");
  }
  if (value < min || value > max) {
    return sb_fail_input(report, SB_ERROR_RANGE, sb_input(id), "%g is outside %g to %g (%s)", value,
                         min, max, param->si);
  }
  if (param->kind != SB_PARAM_REAL && value != floor(value)) {
    return sb_fail_input(report, SB_ERROR_INPUT, sb_input(id), "%g is not a whole number", value);
  }
  params->value[id] = value;
  params->given[id] = true;
  for (int i = 0; i < SB_KEEPS_COUNT; i++) {
    params->drawn[i] = keeps[i].id == id ? 0 : params->drawn[i];
  }
  return SB_OK;
}

int sb_param_choice(const SbParam *param, const char *name, size_t length) {
  for (int i = 0; i < sb_param_choice_count(param); i++) {
    char own[48];
    sb_param_choice_name(param, i, own, sizeof own);
    if (strlen(own) == length && strncmp(own, name, length) == 0) {
      return i;
    }
  }
  return -1;
}

void sb_param_choice_name(const SbParam *param, int index, char *name, size_t size) {
  const char *at = param->choices;
  for (int i = 0; at != NULL && i < index; i++) {
    at = strchr(at, '|');
    at = at != NULL ? at + 1 : NULL;
  }
  at = at != NULL && index >= 0 ? at : "";
  snprintf(name, size, "%.*s", (int)strcspn(at, "|"), at);
}

int sb_param_choice_count(const SbParam *param) {
  int count = param->choices != NULL;
  for (const char *at = param->choices; count > 0 && *at != '\0'; at++) {
    count += *at == '|';
  }
  return count;
}
