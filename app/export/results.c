// The results' JSON documents; see the header.
#include "app/export/results.h"

#include "app/export/json.h"
#include "app/export/studies.h"
#include "engine/film/regime.h"

#include <math.h>
#include <string.h>

// ---- run ----

static void put_choice(SbJson *json, const char *key, SbParamId id, int index) {
  char name[64];
  sb_param_choice_name(sb_param(id), index, name, sizeof name);
  sb_json_string(json, key, name);
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
    if (strcmp(path, "cycle.returns") == 0) {
      sb_json_answer(json, name,
                     isnan(summary->returned) ? SB_ANSWER_UNKNOWN
                     : summary->returned > 0  ? SB_ANSWER_YES
                                              : SB_ANSWER_NO);
    } else if (i < SB_FIGURE_COUNT) {
      sb_json_number(json, name, sb_figure_value(summary, i));
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
  const SbSealSummary *of = &summary->seal[seal];
  g_autofree char *scope = g_strdup_printf("seals.%s.", sb_seal_name(seal));
  sb_json_object(json, sb_seal_name(seal));
  put_figures(json, summary, scope);
  sb_json_string(json, "regime", isnan(of->lambda) ? NULL : sb_regime_of_lambda(of->lambda));
  sb_json_string(json, "leak_state", sb_leak_state_name(of->leak_state));
  sb_json_object_end(json);
}

// Numbers beside the catalogue's figures, by key.
typedef struct {
  const char *key;
  double value;
} Named;

enum { NAMED_MAX = 16 };

static void put_named(SbJson *json, const Named *rows, size_t count) {
  for (size_t i = 0; i < count; i++) {
    sb_json_number(json, rows[i].key, rows[i].value);
  }
}

static void put_named_reasons(SbJson *json, const char *scope, const Named *rows, size_t count,
                              const char *reason) {
  for (size_t i = 0; i < count; i++) {
    if (!isfinite(rows[i].value)) {
      g_autofree char *path = g_strdup_printf("%s.%s", scope, rows[i].key);
      sb_json_string(json, path, reason);
    }
  }
}

static size_t rig_rows(Named out[NAMED_MAX], const SbRun *run) {
  const SbRigSummary *rig = &sb_run_summary(run)->rig;
  const SbModel *model = sb_run_model(run);
  SbRigCoefficients of = rig->of;
  if (!rig->found) {
    of.static_coefficient = of.dynamic_coefficient = of.mean_coefficient = NAN;
    of.first_peak = of.first_time = NAN;
  }
  const Named rows[] = {{"load_N", model->rig.load},
                        {"sampling_rate_Hz", model->rig.rate},
                        {"coefficient_sliding", model->rig.coefficient},
                        {"coefficient_static", of.static_coefficient},
                        {"coefficient_dynamic", of.dynamic_coefficient},
                        {"coefficient_mean", of.mean_coefficient},
                        {"first_peak_N", of.first_peak},
                        {"first_peak_s", of.first_time},
                        {"coefficient_measured", SB_RIG_MEASURED_DYNAMIC},
                        {"coefficient_predicted", SB_RIG_PREDICTED_DYNAMIC},
                        {"coefficient_contact_model", rig->contact_coefficient},
                        {"load_of_sliding_coefficient_N", rig->contact_load}};
  memcpy(out, rows, sizeof rows);
  return G_N_ELEMENTS(rows);
}

static void put_rig(SbJson *json, const SbRun *run) {
  const SbRigSummary *rig = &sb_run_summary(run)->rig;
  Named rows[NAMED_MAX];
  sb_json_object(json, "rig");
  put_named(json, rows, rig_rows(rows, run));
  sb_json_count(json, "following_peaks", rig->found ? rig->of.peaks : 0);
  sb_json_bool(json, "stick_slip", rig->found && rig->of.stick_slip);
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
  for (int i = 0; i < SB_VALVE_GROUND; i++) {
    const SbValvePart *part = &model->parts.part[i];
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

// What is "last" stands for the whole life: NaN for one that ended before its time.
static size_t life_rows(Named out[NAMED_MAX], const SbRun *run) {
  const SbLife *life = &sb_run_summary(run)->life;
  size_t count;
  const SbLifeActuation *each = sb_run_life(run, &count);
  SbLifeActuation last = each[count - 1];
  if (life->done < sb_run_model(run)->life_actuations) {
    last.roughness = last.force_breakaway = last.force_return = last.lambda = NAN;
  }
  const Named rows[] = {{"roughness_last", last.roughness},
                        {"force_peak_first_N", life->peak_first},
                        {"force_peak_last_N", life->peak_last},
                        {"force_breakaway_first_N", each[0].force_breakaway},
                        {"force_breakaway_last_N", last.force_breakaway},
                        {"force_return_least_N", life->return_least},
                        {"force_return_last_N", last.force_return},
                        {"lambda_first", each[0].lambda},
                        {"lambda_last", last.lambda},
                        {"leakage_net_m3", life->leakage},
                        {"leakage_carried_m3", life->carried}};
  memcpy(out, rows, sizeof rows);
  return G_N_ELEMENTS(rows);
}

static void put_life(SbJson *json, const SbRun *run) {
  const SbLife *life = &sb_run_summary(run)->life;
  size_t count;
  const SbLifeActuation *each = sb_run_life(run, &count);
  Named rows[NAMED_MAX];
  sb_json_object(json, "life");
  sb_json_count(json, "actuations", (guint64)life->done);
  put_named(json, rows, life_rows(rows, run));
  sb_json_count(json, "failures", life->failure > 0);
  sb_json_count(json, "first_failure", (guint64)life->failure);
  const struct {
    const char *key;
    size_t offset;
  } columns[] = {{"roughness", offsetof(SbLifeActuation, roughness)},
                 {"force_peak_N", offsetof(SbLifeActuation, force_peak)},
                 {"force_breakaway_N", offsetof(SbLifeActuation, force_breakaway)},
                 {"force_return_N", offsetof(SbLifeActuation, force_return)},
                 {"lambda", offsetof(SbLifeActuation, lambda)},
                 {"leakage_m3", offsetof(SbLifeActuation, leakage)},
                 {"leakage_carried_m3", offsetof(SbLifeActuation, carried)}};
  double *values = g_new(double, MAX(count, 1));
  sb_json_object(json, "by_actuation");
  for (size_t k = 0; k < G_N_ELEMENTS(columns); k++) {
    for (size_t i = 0; i < count; i++) {
      values[i] = *(const double *)((const char *)&each[i] + columns[k].offset);
    }
    sb_json_numbers(json, columns[k].key, values, count);
  }
  sb_json_object_end(json);
  g_free(values);
  sb_json_object_end(json);
}

// Why what is null above is so, by path.
static void put_reasons(SbJson *json, const SbRun *run) {
  const SbSummary *summary = sb_run_summary(run);
  Named rows[NAMED_MAX];
  sb_json_object(json, "reasons");
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const char *reason = sb_figure_reason(summary, i);
    const char *path = sb_figure(i)->path;
    if (reason != NULL) {
      sb_json_string(json, path, reason);
    }
    if (reason != NULL && g_str_has_suffix(path, ".lambda")) {
      g_autofree char *regime =
          g_strdup_printf("%.*s.regime", (int)(strrchr(path, '.') - path), path);
      sb_json_string(json, regime, reason);
    }
  }
  if (sb_run_model(run)->motion == SB_MODEL_MOTION_RIG) {
    put_named_reasons(json, "rig", rows, rig_rows(rows, run),
                      "the force has no peak: the plate did not break away, or slid smoothly");
  }
  if (summary->life.done > 0) {
    g_autofree char *reason =
        summary->life.failure > 0
            ? g_strdup_printf("the life ends at actuation %ld: its stem does not return",
                              summary->life.failure)
            : g_strdup_printf("the life was not computed beyond actuation %ld", summary->life.done);
    put_named_reasons(json, "life", rows, life_rows(rows, run), reason);
    sb_json_string(json, "life.by_actuation", "null where an actuation does not slip or return");
  }
  sb_json_object_end(json);
}

static void put_run_solver(SbJson *json, const SbSummary *summary) {
  sb_json_object(json, "solver");
  sb_json_bool(json, "converged", summary->converged);
  sb_json_count(json, "frames", summary->frames);
  sb_json_count(json, "steps", summary->steps);
  sb_json_count(json, "rejected_steps", summary->rejected_steps);
  sb_json_count(json, "newton_iterations", summary->newton_iterations);
  sb_json_number(json, "wall_s", summary->wall_s);
  put_figures(json, summary, "solver.");
  const SbCounters *counters = &summary->counters;
  sb_json_object(json, "counters");
  sb_json_count(json, "reynolds_solves", counters->reynolds_solves);
  sb_json_count(json, "film_steps", counters->film_steps);
  sb_json_count(json, "ring_solves", counters->ring_solves);
  sb_json_count(json, "disc_solves", counters->disc_solves);
  sb_json_count(json, "fit_solves", counters->fit_solves);
  sb_json_count(json, "field_evaluations", counters->field_evaluations);
  sb_json_count(json, "profile_evaluations", counters->profile_evaluations);
  sb_json_object_end(json);
  sb_json_object_end(json);
}

char *sb_results_run(const SbRun *run, const SbResultsInfo *info) {
  const SbSummary *summary = sb_run_summary(run);
  const SbModel *model = sb_run_model(run);
  SbJson json;
  sb_json_init(&json);
  sb_json_object(&json, NULL);
  sb_json_string(&json, "scene", info->scene);
  sb_json_string(&json, "version", sb_version());
  sb_json_string(&json, "parameters_sha256", info->sha256);
  sb_json_bool(&json, "partial", info->partial);
  sb_json_object(&json, "models");
  put_choice(&json, "fit", SB_P_MODELS_FIT, model->fit);
  put_choice(&json, "film", SB_P_MODELS_FILM, (int)model->film);
  put_choice(&json, "film_time", SB_P_MODELS_FILM_TIME, model->film_history);
  put_choice(&json, "surface", SB_P_MODELS_SURFACE, (int)model->surface);
  put_choice(&json, "asperities", SB_P_MODELS_ASPERITIES, (int)model->asperities);
  sb_json_string(&json, "friction", "boundary-viscous-static");
  put_choice(&json, "motion", SB_P_MODELS_MOTION, (int)model->motion);
  sb_json_object_end(&json);
  sb_json_object(&json, "cycle");
  put_figures(&json, summary, "cycle.");
  put_verdict(&json, info->verdict);
  sb_json_object_end(&json);
  if (model->motion == SB_MODEL_MOTION_RIG) {
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
  sb_json_object(&json, "dose");
  sb_json_number(&json, "metered_volume_m3", model->metered_volume);
  sb_json_count(&json, "doses", (guint64)MAX(model->doses, 0));
  sb_json_object_end(&json);
  sb_json_warnings(&json, &summary->warnings);
  put_reasons(&json, run);
  if (info->study_count > 0) {
    sb_json_array(&json, "studies");
    for (size_t i = 0; i < info->study_count; i++) {
      sb_json_study(&json, &info->studies[i]);
    }
    sb_json_array_end(&json);
  }
  put_run_solver(&json, summary);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}

// ---- film and fit ----

char *sb_results_film(const SbFilm *film, const SbResultsHistory *history) {
  // A solver that found nothing has no figures; what describes the problem stays.
  const bool none = !film->solver.converged && film->film_central == 0;
  SbJson json;
  sb_json_init(&json);
  sb_json_object(&json, NULL);
  sb_json_string(&json, "model", sb_film_model_name(film->model));
  sb_json_number(&json, "film_min_m", none ? NAN : film->film_min);
  sb_json_number(&json, "film_central_m", none ? NAN : film->film_central);
  sb_json_number(&json, "film_flux_m", none ? NAN : film->film_flux);
  sb_json_number(&json, "pressure_max_Pa", none ? NAN : film->pressure_max);
  sb_json_number(&json, "position_film_min_m", none ? NAN : film->position_film_min);
  sb_json_number(&json, "position_rupture_m", none ? NAN : film->position_rupture);
  sb_json_bool(&json, "ruptured", film->ruptured);
  sb_json_bool(&json, "starved", film->starved);
  sb_json_number(&json, "hertz_half_width_m", film->hertz_half_width);
  sb_json_number(&json, "hertz_pressure_Pa", film->hertz_pressure);
  sb_json_number(&json, "friction_couette_N_per_m", none ? NAN : film->friction_couette);
  sb_json_number(&json, "friction_poiseuille_N_per_m", none ? NAN : film->friction_poiseuille);
  sb_json_number(&json, "friction_cavity_N_per_m", none ? NAN : film->friction_cavity);
  sb_json_number(&json, "friction_boundary_N_per_m", none ? NAN : film->friction_boundary);
  sb_json_number(&json, "asperity_load_N_per_m", none ? NAN : film->asperity_load);
  sb_json_number(&json, "asperity_load_share", none ? NAN : film->asperity_share);
  sb_json_number(&json, "real_area_m", none ? NAN : film->real_area);
  sb_json_number(&json, "real_area_share", none ? NAN : film->real_area_share);
  sb_json_number(&json, "film_ratio", none ? NAN : film->film_ratio);
  sb_json_number(&json, "moes_M", film->moes_M);
  sb_json_string(&json, "regime", film->regime);
  sb_json_number(&json, "expected_model_error", film->expected_error);
  sb_json_bool(&json, "valid", film->valid);
  sb_json_warnings(&json, &film->warnings);
  const SbFilmSolverInfo *solver = &film->solver;
  sb_json_object(&json, "solver");
  sb_json_bool(&json, "converged", solver->converged);
  sb_json_count(&json, "unknowns", solver->unknowns);
  sb_json_count(&json, "newton_iterations", (guint64)MAX(solver->newton_iterations, 0));
  sb_json_count(&json, "continuation_steps", (guint64)MAX(solver->continuation_steps, 0));
  sb_json_number(&json, "residual", solver->residual);
  sb_json_object(&json, "error_estimate");
  sb_json_number(&json, "film_min", none ? NAN : solver->error_film_min);
  sb_json_number(&json, "film_central", none ? NAN : solver->error_film_central);
  sb_json_number(&json, "film_flux", none ? NAN : solver->error_film_flux);
  sb_json_object_end(&json);
  sb_json_number(&json, "load_error", none ? NAN : solver->load_error);
  sb_json_number(&json, "flux_error", none ? NAN : solver->flux_error);
  sb_json_number(&json, "wall_s", solver->wall_s);
  sb_json_object_end(&json);
  sb_json_object(&json, "profile");
  sb_json_numbers(&json, "x_m", film->x, film->points);
  sb_json_numbers(&json, "pressure_Pa", film->pressure, film->points);
  sb_json_numbers(&json, "film_m", film->film, film->points);
  sb_json_numbers(&json, "asperity_pressure_Pa", film->asperity_pressure, film->points);
  sb_json_object_end(&json);
  if (history != NULL) {
    sb_json_object(&json, "history");
    sb_json_numbers(&json, "time_s", history->time, history->count);
    sb_json_numbers(&json, "film_min_m", history->film_min, history->count);
    sb_json_numbers(&json, "film_central_m", history->film_central, history->count);
    sb_json_object(&json, "error_estimate");
    sb_json_numbers(&json, "film_min", history->error_min, history->count);
    sb_json_numbers(&json, "film_central", history->error_central, history->count);
    sb_json_object_end(&json);
    sb_json_object_end(&json);
  }
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}

// The gland's read-outs, and what storage made of the ring.
static void put_gland(SbJson *json, const SbGlandReadout *gland) {
  sb_json_array(json, "gland");
  for (int i = 0; i < SB_GLAND_COUNT; i++) {
    const SbGlandReadout *r = &gland[i];
    sb_json_object(json, NULL);
    sb_json_string(json, "name", r->name);
    sb_json_string(json, "unit", r->unit);
    sb_json_number(json, "nominal", r->nominal);
    sb_json_number(json, "worst_low", r->worst_low);
    sb_json_number(json, "worst_high", r->worst_high);
    sb_json_number(json, "rss_low", r->rss_low);
    sb_json_number(json, "rss_high", r->rss_high);
    sb_json_number(json, "band_low", r->band_low);
    sb_json_number(json, "band_high", r->band_high);
    sb_json_string(json, "band", r->band == SB_BAND_NONE ? NULL : sb_band_text(r->band));
    sb_json_string(json, "band_worst",
                   r->band == SB_BAND_NONE ? NULL : sb_band_text(r->band_worst));
    sb_json_string(json, "source", r->source[0] == '\0' ? NULL : r->source);
    sb_json_object_end(json);
  }
  sb_json_array_end(json);
}

static void put_storage(SbJson *json, const SbRubberState *storage) {
  sb_json_object(json, "storage");
  sb_json_number(json, "section_diameter_m", storage->section_diameter);
  sb_json_number(json, "inner_diameter_m", storage->inner_diameter);
  sb_json_number(json, "modulus_Pa", storage->modulus);
  sb_json_number(json, "relaxation", storage->relaxation);
  sb_json_number(json, "network", storage->network);
  sb_json_number(json, "compression_set", storage->compression_set);
  sb_json_number(json, "section_diameter_after_set_m", storage->section_after_set);
  sb_json_number(json, "uptake", storage->uptake);
  sb_json_number(json, "volume_swell", storage->volume_swell);
  sb_json_number(json, "linear_swell", storage->linear_swell);
  sb_json_object_end(json);
}

char *sb_results_fit(const SbFit *fit, const char *seal, double pressure,
                     const SbGlandReadout *gland, const SbRubberState *storage) {
  SbJson json;
  sb_json_init(&json);
  sb_json_object(&json, NULL);
  sb_json_string(&json, "model", sb_fit_model_name(fit->model));
  sb_json_string(&json, "variant", sb_fit_variant_name(fit->model, fit->variant));
  sb_json_string(&json, "seal", seal);
  sb_json_number(&json, "pressure_Pa", pressure);
  sb_json_number(&json, "squeeze", fit->squeeze);
  sb_json_number(&json, "stretch_mean", fit->stretch_mean);
  sb_json_number(&json, "stretch_inner", fit->stretch_inner);
  sb_json_number(&json, "section_diameter_fitted_m", fit->section_diameter_fitted);
  sb_json_number(&json, "interference_m", fit->interference);
  sb_json_number(&json, "gland_fill", fit->gland_fill);
  sb_json_number(&json, "circumference_m", fit->circumference);
  sb_json_number(&json, "contact_width_m", fit->contact_width);
  sb_json_number(&json, "contact_left_m", fit->contact_left);
  sb_json_number(&json, "contact_right_m", fit->contact_right);
  sb_json_number(&json, "load_N", fit->load);
  sb_json_number(&json, "load_N_per_m", fit->load_per_length);
  sb_json_number(&json, "pressure_peak_Pa", fit->pressure_peak);
  sb_json_bool(&json, "touches", fit->touches);
  sb_json_bool(&json, "valid", fit->valid);
  sb_json_warnings(&json, &fit->warnings);
  sb_json_object(&json, "solver");
  sb_json_bool(&json, "converged", fit->solver.converged);
  sb_json_count(&json, "unknowns", fit->solver.unknowns);
  sb_json_count(&json, "newton_iterations", fit->solver.newton_iterations);
  sb_json_object(&json, "error_estimate");
  sb_json_number(&json, "load", fit->solver.error_estimate.load);
  sb_json_number(&json, "pressure_peak", fit->solver.error_estimate.pressure_peak);
  sb_json_number(&json, "contact_width", fit->solver.error_estimate.contact_width);
  sb_json_object_end(&json);
  sb_json_number(&json, "wall_s", fit->solver.wall_s);
  sb_json_object_end(&json);
  if (fit->model == SB_FIT_RING) {
    sb_json_object(&json, "ring");
    sb_json_number(&json, "floor_load_N", fit->ring.floor_load);
    sb_json_number(&json, "wall_load_N", fit->ring.wall_load);
    sb_json_number(&json, "radial_thickness_m", fit->ring.thickness);
    sb_json_number(&json, "volume_change", fit->ring.volume_change);
    sb_json_number(&json, "axial_imbalance", fit->ring.axial_imbalance);
    sb_json_count(&json, "load_steps", fit->ring.load_steps);
    sb_json_count(&json, "rejected_steps", fit->ring.rejected_steps);
    sb_json_object_end(&json);
  }
  sb_json_object(&json, "profile");
  sb_json_numbers(&json, "x_m", fit->profile_x, fit->profile_count);
  sb_json_numbers(&json, "pressure_Pa", fit->profile_p, fit->profile_count);
  sb_json_object_end(&json);
  put_gland(&json, gland);
  put_storage(&json, storage);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}

// ---- plan and lists ----

char *sb_results_plan(const SbPlan *plan, const char *scene) {
  SbJson json;
  sb_json_init(&json);
  sb_json_object(&json, NULL);
  if (scene != NULL) {
    sb_json_string(&json, "scene", scene);
  }
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

static void put_choices(SbJson *json, const SbParam *param, double fallback) {
  char name[64];
  sb_json_string(json, "min", NULL);
  sb_json_string(json, "max", NULL);
  if (param->kind == SB_PARAM_CHOICE) {
    sb_param_choice_name(param, (int)fallback, name, sizeof name);
    sb_json_string(json, "default", name);
  } else {
    sb_json_array(json, "default");
    for (int i = 0; i < sb_param_choice_count(param); i++) {
      if ((unsigned)fallback & 1u << i) {
        sb_param_choice_name(param, i, name, sizeof name);
        sb_json_string(json, NULL, name);
      }
    }
    sb_json_array_end(json);
  }
  sb_json_array(json, "choices");
  for (int i = 0; i < sb_param_choice_count(param); i++) {
    sb_param_choice_name(param, i, name, sizeof name);
    sb_json_string(json, NULL, name);
  }
  sb_json_array_end(json);
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
    if (param->choices != NULL) {
      put_choices(&json, param, param->fallback);
    } else {
      sb_json_number(&json, "min", param->min);
      sb_json_number(&json, "max", param->max);
      sb_json_number(&json, "default", param->fallback);
    }
    sb_json_string(&json, "help", param->help);
    sb_json_string(&json, "source", param->source);
    sb_json_string(&json, "tag", param->tag);
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
    for (int k = 0; g_str_has_prefix(param->key, "models.") && k < sb_param_choice_count(param);
         k++) {
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
    const char *name = sb_film_model_name((SbFilmModel)k);
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
