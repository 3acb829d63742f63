// The tables of `list`: the catalogues of parameters and figures, models, views and fluids.
#include "app/export/results.h"

#include "app/base/figure_text.h"
#include "app/base/unit.h"
#include "app/export/render.h"

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

SbTable *sb_list_figures(void) {
  static const SbTableColumn columns[] = {{.key = "key", .layout = "%-40s"},
                                          {.key = "unit"},
                                          {.key = "display_unit"},
                                          {.key = "label"},
                                          {.key = "help", .layout = " %s"},
                                          {.key = "better"},
                                          {.key = "error_estimate"},
                                          {.key = "verdict"},
                                          {.layout = "\n    %s"}};
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const SbFigure *figure = sb_figure(i);
    const char *verdict =
        figure->verdict != SB_VERDICT_NONE ? sb_verdict_name(figure->verdict) : NULL;
    const char *better = sb_better_name(figure->better);
    g_autofree char *label = sb_figure_label(i);
    g_autofree char *estimate = figure->error != SB_BY_RESIDUAL
                                    ? g_strconcat("error_estimates.", figure->path, NULL)
                                    : NULL;
    g_autofree char *line = g_strconcat(label, *figure->shown != '\0' ? " in " : "", figure->shown,
                                        figure->better != SB_BETTER_NONE ? "; better is " : "",
                                        figure->better != SB_BETTER_NONE ? better : "", NULL);
    sb_table_add(table,
                 SB_CELLS(sb_cell_text(figure->path), sb_cell_text(figure->si),
                          sb_cell_text(figure->shown), sb_cell_text(label),
                          sb_cell_text(figure->help), sb_cell_text(better), sb_cell_text(estimate),
                          sb_cell_text(verdict), sb_cell_text(line)));
  }
  return table;
}

static void add_model(SbTable *table, const char *key, const char *name, bool used) {
  sb_table_add(table, SB_CELLS(sb_cell_text(key), sb_cell_text(name), sb_cell_answer(used)));
}

SbTable *sb_list_models(void) {
  static const SbTableColumn columns[] = {{.key = "key"}, {.key = "name"}, {.key = "default"}};
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParam *param = sb_param((SbParamId)i);
    const bool is_model = sb_param_group((SbParamId)i) == SB_PARAMS_MODELS;
    for (int k = 0; is_model && k < sb_param_choice_count(param); k++) {
      char name[64];
      sb_param_choice_name(param, k, name, sizeof name);
      add_model(table, param->key, name, k == (int)param->fallback);
    }
  }
  // Film models that only the command `film` has.
  for (int k = 0; k < SB_FILM_MODEL_COUNT; k++) {
    const char *name = sb_film_kind((SbFilmModel)k)->name;
    if (sb_param_choice(sb_param(SB_P_MODELS_FILM), name, strlen(name)) < 0) {
      add_model(table, "film", name, false);
    }
  }
  return table;
}

SbTable *sb_list_views(void) {
  static const SbTableColumn columns[] = {{.key = "name", .layout = "%-12s"},
                                          {.key = "label", .layout = " %s"},
                                          {.key = "width_px"},
                                          {.key = "height_px"},
                                          {.key = "film"}};
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  size_t count = 0;
  const SbRenderView *views = sb_render_views(&count);
  for (size_t i = 0; i < count; i++) {
    sb_table_add(table, SB_CELLS(sb_cell_text(views[i].name), sb_cell_text(views[i].label),
                                 sb_cell_number(views[i].width), sb_cell_number(views[i].height),
                                 sb_cell_answer(true)));
  }
  sb_table_note(table, "Studies (pictures only; output.studies has run write them as tables)");
  for (int i = 0; i < SB_STUDY_COUNT; i++) {
    const SbStudyKind kind = (SbStudyKind)i;
    sb_table_add(table, SB_CELLS(sb_cell_text(sb_study_name(kind)),
                                 sb_cell_text_as(sb_study_title(kind), sb_study_help(kind)), {0},
                                 {0}, sb_cell_answer(false)));
  }
  return table;
}

SbTable *sb_list_fluids(void) {
  static const SbTableColumn columns[] = {{.key = "key", .layout = "%-16s"},
                                          {.key = "unit"},
                                          {.key = "label"},
                                          {.key = "help", .layout = " %s"},
                                          {.key = "better"},
                                          {.key = "temperature_min_K"},
                                          {.key = "temperature_max_K"},
                                          {.key = "temperature_critical_K"},
                                          {.key = "molar_mass_kg_per_mol"},
                                          {.key = "gwp100"},
                                          {.layout = " (%s)"}};
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (int i = 0; i < sb_fluid_count; i++) {
    const SbFluid *fluid = &sb_fluids[i];
    const bool known = fluid->mass > 0;
    char low[SB_NUMBER_SIZE];
    sb_number_round(low, sb_quantity_to_shown(fluid->temperature_min, "K", "°C"), 4);
    g_autofree char *high = sb_quantity_round(fluid->temperature_max, "K", "°C", 4);
    g_autofree char *range = g_strdup_printf("%s to %s", low, high);
    const double of[] = {known ? fluid->temperature_min : NAN, known ? fluid->temperature_max : NAN,
                         fluid->temperature_critical > 0 ? fluid->temperature_critical : NAN,
                         known ? fluid->mass : NAN, known ? fluid->gwp100 : NAN};
    sb_table_add(table,
                 SB_CELLS(sb_cell_text(fluid->name), sb_cell_text(NULL), sb_cell_text(fluid->label),
                          sb_cell_text(fluid->help), sb_cell_text(NULL), sb_cell_number(of[0]),
                          sb_cell_number(of[1]), sb_cell_number(of[2]), sb_cell_number(of[3]),
                          sb_cell_number(of[4]), sb_cell_text(known ? range : NULL)));
  }
  return table;
}
