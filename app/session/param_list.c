// The list of parameters. See param_list.h.
#include "app/session/param_list.h"

#include "app/base/translation.h"
#include "app/base/unit.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

static const SbParamHeading headings[SB_PARAMS_GROUP_COUNT] = {
    [SB_PARAMS_SEAL] = {N_("Seals"), N_("both"), TRUE},
    [SB_PARAMS_GLAND] = {N_("Gland"), NULL, TRUE},
    [SB_PARAMS_CANISTER] = {N_("Canister"), NULL, TRUE},
    [SB_PARAMS_SURFACE] = {N_("Surface"), NULL, TRUE},
    [SB_PARAMS_DRIVE] = {N_("Drive"), NULL, TRUE},
    [SB_PARAMS_BORE] = {N_("Bore"), NULL, FALSE},
    [SB_PARAMS_MODELS] = {N_("Models"), NULL, TRUE},
    [SB_PARAMS_CHAMBER] = {N_("Chamber"), NULL, FALSE},
    [SB_PARAMS_FLUID] = {N_("Fluid"), NULL, FALSE},
    [SB_PARAMS_FRICTION] = {N_("Friction"), NULL, FALSE},
    [SB_PARAMS_GASKET] = {N_("Gasket"), NULL, FALSE},
    [SB_PARAMS_HOUSING] = {N_("Housing"), NULL, FALSE},
    [SB_PARAMS_JOINT] = {N_("Joint"), NULL, FALSE},
    [SB_PARAMS_LIFE] = {N_("Life"), NULL, FALSE},
    [SB_PARAMS_OUTPUT] = {N_("Output"), NULL, FALSE},
    [SB_PARAMS_PART] = {N_("Part"), NULL, FALSE},
    [SB_PARAMS_PEOPLE] = {N_("People"), NULL, FALSE},
    [SB_PARAMS_RIG] = {N_("Rig"), NULL, FALSE},
    [SB_PARAMS_RUBBER] = {N_("Rubber"), NULL, FALSE},
    [SB_PARAMS_SHELF] = {N_("Shelf"), NULL, FALSE},
    [SB_PARAMS_STEM] = {N_("Stem"), NULL, FALSE},
    [SB_PARAMS_STORAGE] = {N_("Storage"), NULL, FALSE},
    [SB_PARAMS_STUDY] = {N_("Study"), NULL, FALSE},
    [SB_PARAMS_VALVE] = {N_("Valve"), NULL, FALSE},
};
static const SbParamHeading seals[SB_SEAL_COUNT] = {
    [SB_OUTER] = {N_("Outer seal only"), NULL, FALSE},
    [SB_INNER] = {N_("Inner seal only"), NULL, FALSE},
};

const SbParamHeading *sb_param_heading(SbParamId id) {
  const int seal = sb_param(id)->seal;
  const bool of_canister =
      id == SB_P_FLUID_NAME || id == SB_P_FLUID_ETHANOL; // like its temperature
  return seal < SB_SEAL_COUNT ? &seals[seal]
                              : &headings[of_canister ? SB_PARAMS_CANISTER : sb_param_group(id)];
}

gboolean sb_param_is_changed(const SbParams *params, SbParamId id) {
  SbParamDefault fallback;
  sb_params_default(&fallback, params, id);
  return params->given[id] && sb_params_get(params, id) != fallback.value;
}

const char *sb_param_owner(SbParamId id) {
  const int seal = sb_param(id)->seal;
  return seal == SB_OUTER                          ? _("Outer seal: ")
         : seal == SB_INNER                        ? _("Inner seal: ")
         : sb_param_group(id) == SB_PARAMS_HOUSING ? _("Housing: ")
                                                   : "";
}

char *sb_param_undo_text(const SbDocument *document, bool redo) {
  static const char *const others[] = {
      [SB_DOCUMENT_RUBBER - SB_PARAM_COUNT] = N_("Rubber"),
      [SB_DOCUMENT_MEASURED - SB_PARAM_COUNT] = N_("Measured data"),
      [SB_DOCUMENT_SECTION - SB_PARAM_COUNT] = N_("Drawn section"),
      [SB_DOCUMENT_GROOVE - SB_PARAM_COUNT] = N_("Drawn groove"),
      [SB_DOCUMENT_WHOLE - SB_PARAM_COUNT] = N_("Another version of the file"),
  };
  double value[2];
  const int id = sb_document_next_undo(document, redo, value);
  if (id < 0 || id >= SB_PARAM_COUNT) {
    return id < 0 ? NULL : g_strdup(_(others[id - SB_PARAM_COUNT]));
  }
  g_autofree char *before = sb_param_format((SbParamId)id, value[0]);
  g_autofree char *after = sb_param_format((SbParamId)id, value[1]);
  // The unit is given once if both values have the same one.
  char *unit = strchr(before, ' ');
  if (unit != NULL && g_str_has_suffix(after, unit)) {
    *unit = '\0';
  }
  return g_strdup_printf("%s%s %s → %s", sb_param_owner((SbParamId)id),
                         sb_translation(sb_param((SbParamId)id)->label), before, after);
}

static gboolean contains(const char *text, const char *needle) {
  g_autofree char *folded = g_utf8_casefold(text, -1);
  return strstr(folded, needle) != NULL;
}

gboolean sb_param_matches(SbParamId id, const char *needle) {
  const SbParam *param = sb_param(id);
  return contains(param->label, needle) || contains(sb_translation(param->label), needle) ||
         contains(param->key, needle) || contains(param->symbol, needle) ||
         contains(param->help, needle) || contains(sb_param_owner(id), needle) ||
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
