// Values of parameters as text of a file and back; see unit.h.
#include "app/base/unit.h"

#include "app/base/hardness.h"
#include "app/base/nearest.h"

#include <math.h>
#include <string.h>

char *sb_param_format(SbParamId id, double value) {
  const SbParam *param = sb_param(id);
  char name[64];
  switch (param->kind) {
  case SB_PARAM_REAL:
    return sb_quantity_format(value, param->si, param->unit);
  case SB_PARAM_INT:
    return g_strdup_printf("%.0f", value);
  case SB_PARAM_CHOICE:
    sb_param_choice_name(param, (int)value, name, sizeof name);
    return g_strdup(name);
  case SB_PARAM_FLAGS:
    break;
  }
  GString *list = g_string_new(NULL);
  for (int i = 0; i < sb_param_choice_count(param); i++) {
    if ((unsigned)value & 1u << i) {
      sb_param_choice_name(param, i, name, sizeof name);
      g_string_append_printf(list, "%s%s", list->len > 0 ? ";" : "", name);
    }
  }
  return g_string_free(list, FALSE);
}

static bool fail_name(GError **error, const SbParam *param, const char *name) {
  SbNearest nearest = sb_nearest(name);
  sb_nearest_try_list(&nearest, param->choices);
  g_autofree char *hint = sb_nearest_hint(&nearest);
  return sb_app_error_input(error, "\"%s\" is not one of the names%s", name, hint);
}

// Bit mask of a list "hysteresis;profiles".
static bool parse_flags(double *out, const SbParam *param, const char *text, GError **error) {
  unsigned mask = 0;
  char **names = g_strsplit(text, ";", 64);
  bool good = true;
  for (char **name = names; good && *name != NULL; name++) {
    g_strstrip(*name);
    if (**name == '\0') {
      continue;
    }
    int index = sb_param_choice(param, *name, strlen(*name));
    if (index < 0) {
      good = fail_name(error, param, *name);
    } else {
      mask |= 1u << index;
    }
  }
  g_strfreev(names);
  if (good) {
    *out = mask;
  }
  return good;
}

bool sb_param_parse(double *out, SbParamId id, const char *text, GError **error) {
  const SbParam *param = sb_param(id);
  double value = 0;
  if (param->kind == SB_PARAM_FLAGS) {
    return parse_flags(out, param, text, error);
  }
  if (param->kind == SB_PARAM_CHOICE) {
    g_autofree char *name = g_strstrip(g_strdup(text));
    int index = sb_param_choice(param, name, strlen(name));
    bool good = index >= 0 || fail_name(error, param, name);
    if (good) {
      *out = index;
    }
    return good;
  }
  GError *hardness = NULL;
  if (sb_hardness_applies(id) && sb_hardness_parse(&value, text, &hardness)) {
    *out = value;
    return true;
  }
  if (hardness != NULL) {
    g_propagate_error(error, hardness);
    return false;
  }
  if (!sb_quantity_parse(&value, text, param->si, param->unit, error)) {
    return false;
  }
  if (param->kind == SB_PARAM_INT && value != floor(value)) {
    return sb_app_error_input(error, "\"%.60s\" is not a whole number", text);
  }
  // A limit typed in the unit of people may miss by its rounding.
  const double rounding = 1e-12;
  if (fabs(value - param->min) <= rounding * fabs(param->min)) {
    value = param->min;
  } else if (fabs(value - param->max) <= rounding * fabs(param->max)) {
    value = param->max;
  }
  if (value < param->min || value > param->max) {
    g_autofree char *shown = sb_param_format(id, value);
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_RANGE, "%s is out of range", shown);
    return false;
  }
  *out = value;
  return true;
}

// An end of a range. Where a round number of SI is none in the unit that people read (3.2e9 s are
// 37037.03703703704 days), three digits of it, rounded into the range.
static char *range_end(const SbParam *param, double value, bool lower) {
  char *exact = sb_quantity_format(value, param->si, param->unit);
  size_t digits = 0;
  for (const char *c = exact; *c != '\0' && *c != ' ' && *c != 'e'; c++) {
    digits += g_ascii_isdigit(*c);
  }
  double shown = sb_quantity_to_shown(value, param->si, param->unit);
  if (digits <= 10 || !isfinite(shown) || shown == 0) {
    return exact;
  }
  g_free(exact);
  double step = pow(10, floor(log10(fabs(shown))) - 2);
  char text[SB_NUMBER_SIZE];
  sb_number_round(text, (lower ? ceil(shown / step) : floor(shown / step)) * step, 3);
  return g_strdup_printf("%s %s", text, param->unit);
}

void sb_param_range_ends(SbParamId id, char *end[2]) {
  const SbParam *param = sb_param(id);
  const bool real = param->kind == SB_PARAM_REAL;
  end[0] = range_end(param, param->min, true);
  end[1] = real ? range_end(param, param->max, false) : sb_param_format(id, param->max);
  // A unit that both have stands behind the second only.
  char *space = param->unit[0] != '\0' ? strchr(end[0], ' ') : NULL;
  if (space != NULL && g_str_has_suffix(end[1], space)) {
    *space = '\0';
  }
}

char *sb_param_range(SbParamId id) {
  const SbParam *param = sb_param(id);
  if (param->kind == SB_PARAM_CHOICE || param->kind == SB_PARAM_FLAGS) {
    g_auto(GStrv) names = g_strsplit(param->choices, "|", 0);
    return g_strjoinv(", ", names);
  }
  char *end[2];
  sb_param_range_ends(id, end);
  char *range = g_strdup_printf("%s to %s", end[0], end[1]);
  g_free(end[0]);
  g_free(end[1]);
  return range;
}
