// The JSON documents of runs and plans; see the header.
#include "app/export/results.h"

#include "app/base/device.h"
#include "app/base/figure_text.h"
#include "app/base/unit.h"
#include "app/export/csv.h"
#include "app/export/measured_results.h"
#include "app/export/studies.h"
#include "app/table/json.h"
#include "engine/film/laws.h"

#include <math.h>
#include <string.h>

// ---- run ----

static void put_choice(SbJson *json, const char *key, const SbModel *model, SbParamId id) {
  char name[64];
  sb_model_choice_name(model, id, name, sizeof name);
  sb_json_string(json, key, name);
}

// A figure's value; what asks yes or no is a boolean.
static void put_value(SbJson *json, const char *key, int index, double value) {
  if (sb_figure(index)->digits > 0) {
    sb_json_number(json, key, value);
  } else {
    sb_json_answer(json, key,
                   isnan(value) ? SB_ANSWER_UNKNOWN
                   : value > 0  ? SB_ANSWER_YES
                                : SB_ANSWER_NO);
  }
}

// What sliding makes of a seal's contact, beside the figures of its stroke.
static void put_section(SbJson *json, const SbSummary *summary, const SbFigure *figure) {
  const SbContacts *of = &summary->contact[figure->seal];
  const SbContact *contact = figure->direction == SB_DIRECTION_OUT ? &of->back : &of->in_stroke;
  sb_json_string(json, "state", contact->known ? sb_ring_state_name(contact->section) : NULL);
}

// Adds the states that the JSON has after a figure: that of a section after its turn, and that of a
// leak on the shelf after the moisture that passes the seal.
static void put_states(SbJson *json, const SbSummary *summary, const SbFigure *figure) {
  if (figure->direction != SB_DIRECTION_NONE && figure->quantity == SB_FIGURE_QUANTITY_ANGLE) {
    put_section(json, summary, figure);
  }
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    if (figure->offset ==
        offsetof(SbSummary, shelf.seal[0].moisture) + (size_t)seal * sizeof(SbShelfSeal)) {
      sb_json_string(json, "leak_state", sb_leak_state_name(summary->shelf.seal[seal].state));
    }
  }
}

// The catalogue's figures whose paths begin with `scope`, as objects; inside the scope's own
// object.
static void put_figures(SbJson *json, const SbSummary *summary, const char *scope) {
  char open[64] = ""; // path of the objects open below the scope, each with its dot
  for (int i = 0; i <= SB_FIGURE_COUNT; i++) {
    const char *path = i < SB_FIGURE_COUNT ? sb_figure(i)->path : "";
    if (*path != '\0' && !g_str_has_prefix(path, scope)) {
      continue;
    }
    const char *rest = *path != '\0' ? path + strlen(scope) : "";
    while (*open != '\0' && !g_str_has_prefix(rest, open)) {
      sb_json_object_end(json);
      open[strlen(open) - 1] = '\0';
      char *dot = strrchr(open, '.');
      *(dot != NULL ? dot + 1 : open) = '\0';
    }
    const char *name = rest + strlen(open);
    for (const char *dot = strchr(name, '.'); dot != NULL; dot = strchr(name, '.')) {
      g_autofree char *object = g_strndup(name, (gsize)(dot - name));
      sb_json_object(json, object);
      g_strlcpy(open, rest, (gsize)(dot - rest) + 2);
      name = dot + 1;
    }
    if (i < SB_FIGURE_COUNT) {
      put_value(json, name, i, sb_figure_value(summary, i));
      put_states(json, summary, sb_figure(i));
    }
  }
}

static void put_verdict(SbJson *json, const SbCaseVerdict *verdicts) {
  sb_json_object(json, "verdict");
  for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
    const SbVerdict *verdict = &verdicts[kind].of;
    sb_json_object(json, sb_verdict_name((SbVerdictKind)kind));
    sb_json_answer(json, "ok", verdict->ok);
    sb_json_string(json, "reason", verdict->reason[0] != '\0' ? verdict->reason : NULL);
    sb_json_string(json, "figure", verdict->figure >= 0 ? sb_figure(verdict->figure)->path : NULL);
    sb_json_number(json, "value", verdict->value);
    sb_json_number(json, "limit", verdict->limit);
    sb_json_string(json, "case", verdicts[kind].name);
    sb_json_object_end(json);
  }
  sb_json_object_end(json);
}

static void put_seal(SbJson *json, const SbSummary *summary, int seal) {
  const SbSealState *of = &summary->seal[seal];
  g_autofree char *scope = g_strdup_printf("seals.%s.", sb_seal_name(seal));
  sb_json_object(json, sb_seal_name(seal));
  put_figures(json, summary, scope);
  sb_json_string(json, "regime", isnan(of->lambda) ? NULL : sb_regime_of_lambda(of->lambda));
  sb_json_string(json, "leak_state", sb_leak_state_name(of->leak_state));
  sb_json_object_end(json);
}

// The figures' object, with the inputs and the thesis' figures to hold against them.
static void put_rig(SbJson *json, const SbRun *run) {
  const SbRigSummary *rig = &sb_run_summary(run)->rig;
  const SbRig *model = sb_model_rig(sb_run_model(run));
  sb_json_object(json, "rig");
  sb_json_number(json, "load_N", model->load);
  sb_json_number(json, "sampling_rate_Hz", model->rate);
  sb_json_number(json, "coefficient_sliding", model->coefficient);
  put_figures(json, sb_run_summary(run), "rig.");
  sb_json_number(json, "coefficient_measured", SB_RIG_MEASURED_DYNAMIC);
  sb_json_number(json, "coefficient_predicted", SB_RIG_PREDICTED_DYNAMIC);
  sb_json_count(json, "following_peaks", rig->of.peaks);
  sb_json_bool(json, "stick_slip", rig->of.stick_slip);
  sb_json_object_end(json);
}

static void put_bodies(SbJson *json, const SbRun *run) {
  const SbBodiesSummary *bodies = &sb_run_summary(run)->bodies;
  const SbModel *model = sb_run_model(run);
  if (bodies->joints == 0) {
    return;
  }
  sb_json_object(json, "bodies");
  sb_json_number(json, "gruebler", bodies->gruebler);
  sb_json_number(json, "constraints", bodies->constraints);
  sb_json_number(json, "degrees_of_freedom", bodies->freedom);
  sb_json_string(json, "text", bodies->text);
  sb_json_number(json, "moving_mass_kg", bodies->moving_mass);
  sb_json_number(json, "acceleration_error", bodies->acceleration_error);
  sb_json_number(json, "joint_error_m", bodies->joint_error);
  sb_json_array(json, "parts");
  for (int i = 0; i < SB_VALVE_PARTS; i++) {
    const SbValvePart *part = &sb_model_parts(model)->part[i];
    sb_json_object(json, NULL);
    sb_json_string(json, "name", sb_valve_part_name(i));
    sb_json_number(json, "mass_kg", part->mass);
    sb_json_number(json, "inertia_axial_kg_m2", part->axial);
    sb_json_number(json, "inertia_transverse_kg_m2", part->transverse);
    sb_json_object_end(json);
  }
  sb_json_array_end(json);
  sb_json_array(json, "joints");
  for (size_t i = 0; i < bodies->joints; i++) {
    const SbJointSummary *joint = &bodies->joint[i];
    sb_json_object(json, NULL);
    sb_json_string(json, "name", joint->name);
    sb_json_string(json, "kind", joint->kind);
    sb_json_number(json, "force_axial_min_N", joint->axial_min);
    sb_json_number(json, "force_axial_max_N", joint->axial_max);
    sb_json_number(json, "force_transverse_max_N", joint->transverse_max);
    sb_json_number(json, "torque_max_Nm", joint->torque_max);
    sb_json_object_end(json);
  }
  sb_json_array_end(json);
  sb_json_object_end(json);
}

// A parameter that the shelf rests on, with what it is worth.
static void put_basis(SbJson *json, const char *key, const SbModel *model, SbParamId id) {
  SbParamDefault from;
  const bool follows = sb_model_default(&from, model, id);
  const double value = sb_model_value(model, id);
  if (!(value > 0)) {
    return; // the figures' reasons say so
  }
  sb_json_object(json, key);
  sb_json_number(json, "value_mol_per_m_s_Pa", value);
  sb_json_string(json, "tag", follows ? from.tag : "given");
  sb_json_string(json, "source", follows ? from.source : "the scene or its valve");
  sb_json_object_end(json);
}

// One column of the shelf's history, and the figure that says why it is empty.
typedef struct {
  const char *key, *figure;
  size_t offset; // in a point
} ShelfColumn;

#define AT(member) (offsetof(SbShelf, point[0].member) - offsetof(SbShelf, point[0]))
static const ShelfColumn shelf_columns[] = {
    {"time_s", NULL, AT(time)},
    {"temperature_K", NULL, AT(temperature)},
    {"permeated_kg", "shelf.permeation_kg_per_s", AT(permeated)},
    {"interface_kg", "shelf.interface_kg_per_s", AT(passed)},
    {"plastic_kg", "shelf.plastic_kg_per_s", AT(plastic)},
    {"moisture_kg", "shelf.moisture_kg_per_year", AT(moisture)},
    {"doses_left", "shelf.doses_left", AT(doses)},
};
#undef AT

static double shelf_value(const SbShelf *shelf, const ShelfColumn *column, size_t point) {
  return *(const double *)((const char *)&shelf->point[point] + column->offset);
}

static void put_shelf(SbJson *json, const SbRun *run) {
  const SbShelf *shelf = &sb_run_summary(run)->shelf;
  sb_json_object(json, "shelf");
  put_figures(json, sb_run_summary(run), "shelf.");
  put_basis(json, "permeability", sb_run_model(run), SB_P_RUBBER_PERMEABILITY);
  put_basis(json, "water_permeability", sb_run_model(run), SB_P_RUBBER_WATER_PERMEABILITY);
  if (shelf->points > 0) {
    sb_json_object(json, "history");
    for (size_t c = 0; c < G_N_ELEMENTS(shelf_columns); c++) {
      double values[SB_SHELF_POINTS];
      for (size_t i = 0; i < shelf->points; i++) {
        values[i] = shelf_value(shelf, &shelf_columns[c], i);
      }
      sb_json_numbers(json, shelf_columns[c].key, values, shelf->points);
    }
    sb_json_object_end(json);
  }
  sb_json_object_end(json);
}

static void put_life(SbJson *json, const SbRun *run) {
  const SbLife *life = &sb_run_summary(run)->life;
  size_t count;
  const SbLifeActuation *each = sb_run_life(run, &count);
  sb_json_object(json, "life");
  sb_json_count(json, "actuations", (guint64)life->done);
  put_figures(json, sb_run_summary(run), "life.");
  sb_json_count(json, "failures", life->failure > 0);
  sb_json_count(json, "first_failure", (guint64)life->failure);
  g_autofree double *values = g_new(double, MAX(count, 1));
  sb_json_object(json, "by_actuation");
  for (const SbLifeColumn *column = sb_life_columns; column->name != NULL; column++) {
    if (column->unit == NULL) {
      continue;
    }
    const char *unit = strcmp(column->unit, "1") != 0 ? column->unit : "";
    g_autofree char *key = g_strconcat(column->name, *unit != '\0' ? "_" : "", unit, NULL);
    for (size_t i = 0; i < count; i++) {
      values[i] = sb_life_value(&each[i], column);
    }
    sb_json_numbers(json, key, values, count);
  }
  sb_json_object_end(json);
  sb_json_object_end(json);
}

// Whether a block that holds the figure is in the document.
static bool result_is_there(const SbRun *run, int figure) {
  const SbFigureGroup group = sb_figure(figure)->group;
  return group == SB_GROUP_LIFE  ? sb_run_summary(run)->life.done > 0
         : group == SB_GROUP_RIG ? !sb_device(sb_run_model(run))->stem
                                 : true;
}

// Relative errors by path.
static void put_errors(SbJson *json, const SbRun *run) {
  const SbSummary *summary = sb_run_summary(run);
  sb_json_object(json, "error_estimates");
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    if (result_is_there(run, i)) {
      sb_json_number(json, sb_figure(i)->path, sb_figure_error_reported(summary, i));
    }
  }
  sb_json_object_end(json);
}

// Whether a figure is the lambda of a seal, which determines the regime.
static bool is_film_parameter(const SbFigure *figure) {
  return figure->group == SB_GROUP_SEAL &&
         figure->offset == offsetof(SbSummary, seal[0].lambda) +
                               (size_t)figure->seal * sizeof(((SbSummary *)NULL)->seal[0]);
}

// Why what is null above is so, by path; of blocks that are there.
static void put_results_reasons(SbJson *json, const SbRun *run, const SbResultsInfo *info) {
  const SbSummary *summary = sb_run_summary(run);
  sb_json_object(json, "reasons");
  if (summary->outcome == SB_OUTCOME_UNKNOWN) {
    sb_json_string(json, "cycle.outcome",
                   sb_figure_reason(summary, sb_figure_find("cycle.returns")));
  }
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const char *reason = sb_figure_reason(summary, i);
    const char *path = sb_figure(i)->path;
    const char *error_reason = sb_figure_error_reason(summary, i);
    if (error_reason != NULL && result_is_there(run, i)) {
      g_autofree char *error_path = g_strconcat("error_estimates.", path, NULL);
      sb_json_string(json, error_path, error_reason);
    }
    if (reason == NULL || !result_is_there(run, i)) {
      continue;
    }
    sb_json_string(json, path, reason);
    if (is_film_parameter(sb_figure(i))) {
      g_autofree char *regime =
          g_strdup_printf("%.*s.regime", (int)(strrchr(path, '.') - path), path);
      sb_json_string(json, regime, reason);
    }
    if (sb_figure(i)->error == SB_BY_WIDTH && sb_figure(i)->direction != SB_DIRECTION_NONE) {
      g_autofree char *state =
          g_strdup_printf("%.*s.state", (int)(strrchr(path, '.') - path), path);
      sb_json_string(json, state, reason);
    }
  }
  for (size_t c = 0; summary->shelf.points > 0 && c < G_N_ELEMENTS(shelf_columns); c++) {
    const ShelfColumn *column = &shelf_columns[c];
    if (column->figure != NULL &&
        isnan(shelf_value(&summary->shelf, column, summary->shelf.points - 1))) {
      g_autofree char *path = g_strconcat("shelf.history.", column->key, NULL);
      sb_json_string(json, path, sb_figure_reason(summary, sb_figure_find(column->figure)));
    }
  }
  if (summary->life.done > 0) {
    sb_json_string(json, "life.by_actuation", "null where an actuation does not slip or return");
  }
  for (size_t i = 0; i < info->study_count; i++) {
    sb_json_study_reasons(json, &info->studies[i], i);
  }
  sb_json_object_end(json);
}

static void put_counters(SbJson *json, const char *key, const SbCounters *counters) {
  sb_json_object(json, key);
  sb_json_count(json, "reynolds_solves", counters->reynolds_solves);
  sb_json_count(json, "film_steps", counters->film_steps);
  sb_json_count(json, "speed_nodes", counters->speed_nodes);
  sb_json_count(json, "ring_solves", counters->ring_solves);
  sb_json_count(json, "disc_solves", counters->disc_solves);
  sb_json_count(json, "fit_solves", counters->fit_solves);
  sb_json_count(json, "field_evaluations", counters->field_evaluations);
  sb_json_count(json, "profile_evaluations", counters->profile_evaluations);
  sb_json_object_end(json);
}

bool sb_results_converged(const SbSummary *summary, const SbResultsInfo *info) {
  bool converged = summary->converged && (info->problems == NULL || info->problems->len == 0);
  for (size_t i = 0; i < info->study_count; i++) {
    converged = converged && info->studies[i].complete;
  }
  return converged;
}

static void put_run_solver(SbJson *json, const SbSummary *summary, const SbResultsInfo *info) {
  sb_json_object(json, "solver");
  sb_json_bool(json, "converged", sb_results_converged(summary, info));
  sb_json_count(json, "frames", summary->frames);
  sb_json_count(json, "steps", summary->steps);
  sb_json_count(json, "rejected_steps", summary->rejected_steps);
  sb_json_count(json, "work", summary->work);
  sb_json_count(json, "newton_iterations", summary->counters.newton_iterations);
  sb_json_number(json, "wall_s", summary->wall_s);
  put_figures(json, summary, "solver.");
  put_counters(json, "counters", &summary->counters);
  sb_json_object_end(json);
}

// Values in force that follow from another parameter.
static void put_follows(SbJson *json, const SbModel *model) {
  sb_json_object(json, "follows");
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    SbParamDefault derived;
    const SbParam *param = sb_param((SbParamId)i);
    if (param->parent < 0 && sb_model_default(&derived, model, (SbParamId)i)) {
      const SbParamId giver = (SbParamId)derived.giver;
      g_autofree char *name = derived.name != NULL
                                  ? g_strdup(derived.name)
                                  : sb_param_format(giver, sb_model_value(model, giver));
      sb_json_object(json, param->key);
      if (param->kind == SB_PARAM_CHOICE) {
        put_choice(json, "value", model, (SbParamId)i);
      } else {
        sb_json_number(json, "value", derived.value);
      }
      sb_json_string(json, "unit", param->si);
      sb_json_string(json, "from", derived.from);
      sb_json_string(json, "name", name);
      sb_json_string(json, "source", derived.source);
      sb_json_string(json, "tag", derived.tag);
      sb_json_object_end(json);
    }
  }
  sb_json_object_end(json);
}

static void put_models(SbJson *json, const SbModel *model) {
  static const struct {
    const char *key;
    SbParamId id;
  } models[] = {{"set", SB_P_MODELS_SET},         {"fit", SB_P_MODELS_FIT},
                {"film", SB_P_MODELS_FILM},       {"film_time", SB_P_MODELS_FILM_TIME},
                {"surface", SB_P_MODELS_SURFACE}, {"asperities", SB_P_MODELS_ASPERITIES},
                {"inlet", SB_P_MODELS_INLET},     {"friction", SB_P_MODELS_FRICTION},
                {"motion", SB_P_MODELS_MOTION}};
  sb_json_object(json, "models");
  for (size_t i = 0; i < G_N_ELEMENTS(models); i++) {
    put_choice(json, models[i].key, model, models[i].id);
  }
  sb_json_object_end(json);
}

// Warnings of the run and of cases that failed.
static void put_run_warnings(SbJson *json, const SbSummary *summary, const SbResultsInfo *info) {
  g_autofree SbWarnings *all = g_memdup2(&summary->warnings, sizeof summary->warnings);
  for (guint i = 0; info->problems != NULL && i < info->problems->len; i++) {
    const char *problem = g_ptr_array_index(info->problems, i);
    sb_warn_about(all, problem); // one of each case
    sb_warn_serious(all, "case-failed", 0, "%s", problem);
  }
  sb_json_warnings(json, all);
}

char *sb_results_run(const SbRun *run, const SbResultsInfo *info) {
  const SbSummary *summary = sb_run_summary(run);
  const SbModel *model = sb_run_model(run);
  SbJson json;
  sb_json_document(&json);
  sb_json_string(&json, "scene", info->scene);
  sb_json_string(&json, "version", sb_version());
  sb_json_string(&json, "parameters_sha256", info->sha256);
  sb_json_bool(&json, "partial", info->partial);
  put_models(&json, model);
  put_follows(&json, model);
  sb_json_object(&json, "cycle");
  sb_json_string(&json, "outcome", sb_outcome_name(summary->outcome));
  put_figures(&json, summary, "cycle.");
  put_verdict(&json, info->verdict);
  sb_json_object_end(&json);
  if (!sb_device(model)->stem) {
    put_rig(&json, run);
  }
  if (summary->life.done > 0) {
    put_life(&json, run);
  }
  sb_json_object(&json, "seals");
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    put_seal(&json, summary, i);
  }
  sb_json_object_end(&json);
  put_bodies(&json, run);
  static const char *const scopes[][2] = {{"people", "people."}, {"dose", "dose."}};
  for (size_t i = 0; i < G_N_ELEMENTS(scopes); i++) {
    sb_json_object(&json, scopes[i][0]);
    put_figures(&json, summary, scopes[i][1]);
    sb_json_object_end(&json);
  }
  put_shelf(&json, run);
  put_errors(&json, run);
  put_run_warnings(&json, summary, info);
  put_results_reasons(&json, run, info);
  if (info->study_count > 0) {
    sb_json_array(&json, "studies");
    for (size_t i = 0; i < info->study_count; i++) {
      sb_json_study(&json, &info->studies[i]);
    }
    sb_json_array_end(&json);
  }
  if (info->measured != NULL) {
    sb_json_comparison(&json, "measured", info->measured);
  }
  put_run_solver(&json, summary, info);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}

// ---- plan ----

char *sb_results_plan(const SbPlan *plan, const char *scene) {
  SbJson json;
  sb_json_document(&json);
  sb_json_string(&json, "scene", scene);
  sb_json_array(&json, "fields");
  for (size_t i = 0; i < plan->field_count; i++) {
    const SbPlanItem *item = &plan->field[i];
    sb_json_object(&json, NULL);
    sb_json_string(&json, "name", item->name);
    sb_json_string(&json, "model", item->model);
    sb_json_string(&json, "reason", item->reason);
    sb_json_number(&json, "cost_s", item->cost_s);
    sb_json_number(&json, "error", item->error);
    sb_json_object_end(&json);
  }
  sb_json_array_end(&json);
  put_counters(&json, "expected", &plan->expected);
  sb_json_array(&json, "skipped");
  for (size_t i = 0; i < plan->skipped_count; i++) {
    sb_json_object(&json, NULL);
    sb_json_string(&json, "name", plan->skipped[i].name);
    sb_json_string(&json, "reason", plan->skipped[i].reason);
    sb_json_object_end(&json);
  }
  sb_json_array_end(&json);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}
