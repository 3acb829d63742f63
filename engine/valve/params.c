// The catalogue's table and the checks that need nothing but the table.
#include "engine/valve/params.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const SbParam table[SB_PARAM_COUNT] = {
#define SB_REAL(id, key, symbol, si, unit, min, max, fallback, label, help, source, tag)           \
  [SB_P_##id] = {key,      SB_PARAM_REAL, symbol, si,   unit,   min, max,                          \
                 fallback, NULL,          label,  help, source, tag, -1},
#define SB_INT(id, key, symbol, min, max, fallback, label, help, source, tag)                      \
  [SB_P_##id] = {key,      SB_PARAM_INT, symbol, "1",  "",     min, max,                           \
                 fallback, NULL,         label,  help, source, tag, -1},
#define SB_CHOICE(id, key, choices, fallback, label, help, source, tag)                            \
  [SB_P_##id] = {key,      SB_PARAM_CHOICE, "",    "1",  "",     0,   0,                           \
                 fallback, choices,         label, help, source, tag, -1},
#define SB_FLAGS(id, key, choices, fallback, label, help, source, tag)                             \
  [SB_P_##id] = {key,      SB_PARAM_FLAGS, "",    "1",  "",     0,   0,                            \
                 fallback, choices,        label, help, source, tag, -1},
#define SB_SEAL(id, name, symbol, si, unit, min, max, fallback, label, help, source, tag)          \
  SB_REAL(SEAL_##id, "seal." name, symbol, si, unit, min, max, fallback, label, help, source, tag) \
  [SB_P_SEAL_OUTER_##                                                                              \
      id] = {"seal.outer." name, SB_PARAM_REAL, symbol, si,   unit,   min, max,                    \
             fallback,           NULL,          label,  help, source, tag, SB_P_SEAL_##id},        \
    [SB_P_SEAL_INNER_##                                                                            \
        id] = {"seal.inner." name, SB_PARAM_REAL, symbol, si,   unit,   min, max,                  \
               fallback,           NULL,          label,  help, source, tag, SB_P_SEAL_##id},
#include "engine/valve/params.def"
#undef SB_REAL
#undef SB_INT
#undef SB_CHOICE
#undef SB_FLAGS
#undef SB_SEAL
};

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
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    params->value[i] = table[i].fallback;
    params->given[i] = false;
  }
}

double sb_params_get(const SbParams *params, SbParamId id) {
  if (!params->given[id] && table[id].parent >= 0) {
    return params->value[table[id].parent];
  }
  return params->value[id];
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
    return sb_fail_parameter(report, SB_ERROR_INPUT, param->key, "not a finite number");
  }
  if (value < min || value > max) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, param->key, "%g is outside %g to %g (%s)",
                             value, min, max, param->si);
  }
  if (param->kind != SB_PARAM_REAL && value != floor(value)) {
    return sb_fail_parameter(report, SB_ERROR_INPUT, param->key, "%g is not a whole number", value);
  }
  params->value[id] = value;
  params->given[id] = true;
  return SB_OK;
}

int sb_param_choice(const SbParam *param, const char *name, size_t length) {
  const char *start = param->choices;
  for (int i = 0; start != NULL; i++) {
    const char *bar = strchr(start, '|');
    size_t n = bar != NULL ? (size_t)(bar - start) : strlen(start);
    if (n == length && strncmp(start, name, n) == 0) {
      return i;
    }
    start = bar != NULL ? bar + 1 : NULL;
  }
  return -1;
}

void sb_param_choice_name(const SbParam *param, int index, char *name, size_t size) {
  const char *start = param->choices;
  name[0] = '\0';
  for (int i = 0; start != NULL; i++) {
    const char *bar = strchr(start, '|');
    size_t n = bar != NULL ? (size_t)(bar - start) : strlen(start);
    if (i == index) {
      snprintf(name, size, "%.*s", (int)n, start);
      return;
    }
    start = bar != NULL ? bar + 1 : NULL;
  }
}

int sb_param_choice_count(const SbParam *param) {
  int count = param->choices != NULL ? 1 : 0;
  for (const char *c = param->choices; c != NULL && *c != '\0'; c++) {
    count += *c == '|';
  }
  return count;
}
