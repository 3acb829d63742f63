// The list of parameters. See param_list.h.
#include "app/session/param_list.h"

#include "app/base/translation.h"
#include "app/base/unit.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

// Headings by key prefix.
static const SbParamHeading headings[] = {
    {"seal.outer.", N_("Outer seal only"), NULL, FALSE},
    {"seal.inner.", N_("Inner seal only"), NULL, FALSE},
    {"seal.", N_("Seals"), N_("both"), TRUE},
    {"gland.", N_("Gland"), NULL, TRUE},
    {"canister.", N_("Canister"), NULL, TRUE},
    {"fluid.name", N_("Canister"), NULL, TRUE}, // beside its temperature
    {"fluid.ethanol", N_("Canister"), NULL, TRUE},
    {"surface.", N_("Surface"), NULL, TRUE},
    {"drive.", N_("Drive"), NULL, TRUE},
    {"bore.", N_("Bore"), NULL, FALSE},
    {"models.", N_("Models"), NULL, TRUE},
    {"chamber.", N_("Chamber"), NULL, FALSE},
    {"fluid.", N_("Fluid"), NULL, FALSE},
    {"friction.", N_("Friction"), NULL, FALSE},
    {"gasket.", N_("Gasket"), NULL, FALSE},
    {"housing.", N_("Housing"), NULL, FALSE},
    {"joint.", N_("Joint"), NULL, FALSE},
    {"life.", N_("Life"), NULL, FALSE},
    {"output.", N_("Output"), NULL, FALSE},
    {"part.", N_("Part"), NULL, FALSE},
    {"people.", N_("People"), NULL, FALSE},
    {"rig.", N_("Rig"), NULL, FALSE},
    {"rubber.", N_("Rubber"), NULL, FALSE},
    {"shelf.", N_("Shelf"), NULL, FALSE},
    {"stem.", N_("Stem"), NULL, FALSE},
    {"storage.", N_("Storage"), NULL, FALSE},
    {"study.", N_("Study"), NULL, FALSE},
    {"valve.", N_("Valve"), NULL, FALSE},
    {"", N_("Other"), NULL, FALSE},
};

const SbParamHeading *sb_param_heading(const char *key) {
  const SbParamHeading *heading = headings;
  while (!g_str_has_prefix(key, heading->prefix)) {
    heading++;
  }
  return heading;
}

gboolean sb_param_is_changed(const SbParams *params, SbParamId id) {
  SbParamDefault fallback;
  sb_params_default(&fallback, params, id);
  return params->given[id] && sb_params_get(params, id) != fallback.value;
}

const char *sb_param_owner(const SbParam *param) {
  if (g_str_has_prefix(param->key, "seal.outer.")) {
    return _("Outer seal: ");
  }
  if (g_str_has_prefix(param->key, "seal.inner.")) {
    return _("Inner seal: ");
  }
  if (g_str_has_prefix(param->key, "housing.")) {
    return _("Housing: ");
  }
  return "";
}

static gboolean contains(const char *text, const char *needle) {
  g_autofree char *folded = g_utf8_casefold(text, -1);
  return strstr(folded, needle) != NULL;
}

gboolean sb_param_matches(SbParamId id, const char *needle) {
  const SbParam *param = sb_param(id);
  return contains(param->label, needle) || contains(sb_translation(param->label), needle) ||
         contains(param->key, needle) || contains(param->symbol, needle) ||
         contains(param->help, needle) || contains(sb_param_owner(param), needle) ||
         strstr(sb_param_words(id), needle) != NULL ||
         (param->choices != NULL && contains(param->choices, needle));
}

char *sb_param_range_shown(SbParamId id) {
  const SbParamKind kind = sb_param(id)->kind;
  if (kind == SB_PARAM_CHOICE || kind == SB_PARAM_FLAGS) {
    return sb_param_range(id); // names of choices, as in the files
  }
  char *end[2];
  sb_param_range_ends(id, end);
  char *range = g_strdup_printf(_("%s to %s"), end[0], end[1]);
  g_free(end[0]);
  g_free(end[1]);
  return range;
}

void sb_param_step(SbSession *session, SbParamId id, double count) {
  const SbParam *param = sb_param(id);
  double value = sb_document_value(sb_session_document(session), id);
  if (param->kind == SB_PARAM_FLAGS) {
    return; // any of them, not one after the other
  }
  if (param->kind == SB_PARAM_CHOICE) {
    const int choices = sb_param_choice_count(param);
    value = fmin(fmax(value + (count > 0 ? 1 : -1), 0), choices - 1);
  } else if (param->kind == SB_PARAM_INT) {
    value += copysign(fmax(fabs(count), 1), count);
  } else {
    double shown = sb_quantity_to_shown(value, param->si, param->unit);
    double scale = fabs(shown) > 0 ? fabs(shown)
                                   : sb_quantity_to_shown(param->max, param->si, param->unit) / 10;
    int power = (int)floor(log10(scale * 0.0101));
    // A tenth of a step is one of the next digit.
    const bool fine = fabs(count) < 1;
    value = sb_quantity_step(value, param->si, param->unit, fine ? power - 1 : power,
                             fine ? copysign(1, count) : count);
  }
  value = fmin(fmax(value, param->min), param->max);
  sb_session_edit_value(session, id, value);
}
