// The JSON documents of `list`: the two catalogues, parameters and figures, and the models.
#include "app/export/results.h"

#include "app/base/figure_text.h"
#include "app/base/unit.h"
#include "app/export/json.h"

#include "engine/fluid/fluid.h"

#include <math.h>
#include <string.h>

static void put_default(SbJson *json, const SbParam *param, double value) {
  char name[64];
  if (param->kind == SB_PARAM_CHOICE) {
    sb_param_choice_name(param, (int)value, name, sizeof name);
    sb_json_string(json, "default", name);
  } else if (param->kind == SB_PARAM_FLAGS) {
    sb_json_array(json, "default");
    for (int i = 0; i < sb_param_choice_count(param); i++) {
      if ((unsigned)value & 1u << i) {
        sb_param_choice_name(param, i, name, sizeof name);
        sb_json_string(json, NULL, name);
      }
    }
    sb_json_array_end(json);
  } else {
    sb_json_number(json, "default", value);
  }
}

static void put_choices(SbJson *json, const SbParam *param) {
  char name[64];
  sb_json_array(json, "choices");
  for (int i = 0; i < sb_param_choice_count(param); i++) {
    sb_param_choice_name(param, i, name, sizeof name);
    sb_json_string(json, NULL, name);
  }
  sb_json_array_end(json);
}

// What choices of other parameters make of the default.
static void put_brought(SbJson *json, SbParamId id) {
  SbParamDefault derived;
  int choice;
  for (int i = 0; sb_params_brought(&derived, &choice, id, i); i++) {
    const SbParam *giver = sb_param((SbParamId)derived.giver);
    char name[64];
    sb_param_choice_name(giver, choice, name, sizeof name);
    if (i == 0) {
      sb_json_array(json, "defaults");
    }
    sb_json_object(json, NULL);
    sb_json_string(json, "key", giver->key);
    sb_json_string(json, "choice", name);
    put_default(json, sb_param(id), derived.value);
    sb_json_string(json, "source", derived.source);
    sb_json_string(json, "tag", derived.tag);
    sb_json_object_end(json);
  }
  if (sb_params_brought(&derived, &choice, id, 0)) {
    sb_json_array_end(json);
  }
}

char *sb_results_params(void) {
  static const char *const kinds[] = {"real", "integer", "choice", "flags"};
  SbJson json;
  sb_json_init(&json);
  sb_json_array(&json, NULL);
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParam *param = sb_param((SbParamId)i);
    sb_json_object(&json, NULL);
    sb_json_string(&json, "key", param->key);
    sb_json_string(&json, "kind", kinds[param->kind]);
    sb_json_string(&json, "symbol", param->symbol);
    // min, max and default are SI; people see display_unit.
    sb_json_string(&json, "unit", param->si);
    sb_json_string(&json, "display_unit", param->unit);
    sb_json_number(&json, "min", param->choices != NULL ? NAN : param->min);
    sb_json_number(&json, "max", param->choices != NULL ? NAN : param->max);
    put_default(&json, param, param->fallback);
    if (param->choices != NULL) {
      put_choices(&json, param);
    }
    sb_json_string(&json, "help", param->help);
    sb_json_string(&json, "source", param->source);
    sb_json_string(&json, "tag", param->tag);
    put_brought(&json, (SbParamId)i);
    sb_json_object_end(&json);
  }
  sb_json_array_end(&json);
  return sb_json_finish(&json);
}

char *sb_results_figures(void) {
  SbJson json;
  sb_json_init(&json);
  sb_json_array(&json, NULL);
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const SbFigure *figure = sb_figure(i);
    g_autofree char *label = sb_figure_label(i);
    g_autofree char *estimate = figure->error != SB_BY_RESIDUAL
                                    ? g_strconcat("error_estimates.", figure->path, NULL)
                                    : NULL;
    sb_json_object(&json, NULL);
    sb_json_string(&json, "key", figure->path);
    sb_json_string(&json, "unit", figure->si);
    sb_json_string(&json, "display_unit", figure->shown);
    sb_json_string(&json, "label", label);
    sb_json_string(&json, "help", figure->help);
    sb_json_string(&json, "better", sb_better_name(figure->better));
    sb_json_string(&json, "error_estimate", estimate);
    sb_json_string(&json, "verdict",
                   figure->verdict != SB_VERDICT_NONE ? sb_verdict_name(figure->verdict) : NULL);
    sb_json_object_end(&json);
  }
  sb_json_array_end(&json);
  return sb_json_finish(&json);
}

char *sb_results_models(void) {
  SbJson json;
  sb_json_init(&json);
  sb_json_array(&json, NULL);
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParam *param = sb_param((SbParamId)i);
    const bool is_model = sb_param_group((SbParamId)i) == SB_PARAMS_MODELS;
    for (int k = 0; is_model && k < sb_param_choice_count(param); k++) {
      char name[64];
      sb_param_choice_name(param, k, name, sizeof name);
      sb_json_object(&json, NULL);
      sb_json_string(&json, "key", param->key);
      sb_json_string(&json, "name", name);
      sb_json_bool(&json, "default", k == (int)param->fallback);
      sb_json_object_end(&json);
    }
  }
  // Film models that only the command `film` has.
  for (int k = 0; k < SB_FILM_MODEL_COUNT; k++) {
    const char *name = sb_film_kind((SbFilmModel)k)->name;
    if (sb_param_choice(sb_param(SB_P_MODELS_FILM), name, strlen(name)) < 0) {
      sb_json_object(&json, NULL);
      sb_json_string(&json, "key", "film");
      sb_json_string(&json, "name", name);
      sb_json_bool(&json, "default", false);
      sb_json_object_end(&json);
    }
  }
  sb_json_array_end(&json);
  return sb_json_finish(&json);
}

char *sb_results_fluids(void) {
  SbJson json;
  sb_json_init(&json);
  sb_json_array(&json, NULL);
  for (int i = 0; i < sb_fluid_count; i++) {
    const SbFluid *fluid = &sb_fluids[i];
    const bool known = fluid->mass > 0;
    sb_json_object(&json, NULL);
    sb_json_string(&json, "key", fluid->name);
    sb_json_string(&json, "unit", NULL); // as the other lists have it
    sb_json_string(&json, "label", fluid->label);
    sb_json_string(&json, "help", fluid->help);
    sb_json_string(&json, "better", NULL);
    sb_json_number(&json, "temperature_min_K", known ? fluid->temperature_min : NAN);
    sb_json_number(&json, "temperature_max_K", known ? fluid->temperature_max : NAN);
    sb_json_number(&json, "temperature_critical_K",
                   fluid->temperature_critical > 0 ? fluid->temperature_critical : NAN);
    sb_json_number(&json, "molar_mass_kg_per_mol", known ? fluid->mass : NAN);
    sb_json_number(&json, "gwp100", known ? fluid->gwp100 : NAN);
    sb_json_object_end(&json);
  }
  sb_json_array_end(&json);
  return sb_json_finish(&json);
}
