// The JSON documents of one film and one fitted ring, and the rows that their tables share.
#include "app/export/results.h"

#include <math.h>

const SbResultRow sb_film_rows[] = {
    {"film_min_m", "Film, minimum", "m", "nm", offsetof(SbFilm, film_min),
     offsetof(SbFilm, solver.error_film_min)},
    {"film_central_m", "Film, central", "m", "nm", offsetof(SbFilm, film_central),
     offsetof(SbFilm, solver.error_film_central)},
    {"film_flux_m", "Film, of the flow", "m", "nm", offsetof(SbFilm, film_flux),
     offsetof(SbFilm, solver.error_film_flux)},
    {"pressure_max_Pa", "Pressure, largest", "Pa", "MPa", offsetof(SbFilm, pressure_max), 0},
    {"position_film_min_m", "Position of the minimum film", "m", "mm",
     offsetof(SbFilm, position_film_min), 0},
    {"position_rupture_m", "Place of rupture", "m", "mm", offsetof(SbFilm, position_rupture), 0},
    {"friction_couette_N_per_m", "Friction, Couette", "N/m", "N/m",
     offsetof(SbFilm, friction_couette), 0},
    {"friction_poiseuille_N_per_m", "Friction, Poiseuille", "N/m", "N/m",
     offsetof(SbFilm, friction_poiseuille), 0},
    {0}};

const SbResultRow sb_film_contact_rows[] = {
    {"hertz_half_width_m", "Hertz half-width", "m", "mm", offsetof(SbFilm, hertz_half_width), 0},
    {"hertz_pressure_Pa", "Hertz pressure", "Pa", "MPa", offsetof(SbFilm, hertz_pressure), 0},
    {"moes_M", "Moes' M", "1", "", offsetof(SbFilm, moes_M), 0},
    {0}};

const SbResultRow sb_film_rough_rows[] = {
    {"film_ratio", "Central film over roughness", "1", "", offsetof(SbFilm, film_ratio), 0},
    {"asperity_load_N_per_m", NULL, "", "", offsetof(SbFilm, asperity_load), 0},
    {"asperity_load_share", "Load on asperities, fraction", "1", "",
     offsetof(SbFilm, asperity_share), 0},
    {"real_area_m", NULL, "", "", offsetof(SbFilm, real_area), 0},
    {"real_area_share", "Real contact at the axis, fraction", "1", "",
     offsetof(SbFilm, real_area_share), 0},
    {"friction_boundary_N_per_m", "Friction, boundary", "N/m", "N/m",
     offsetof(SbFilm, friction_boundary), 0},
    {"friction_cavity_N_per_m", "Friction, broken film", "N/m", "N/m",
     offsetof(SbFilm, friction_cavity), 0},
    {0}};

const SbResultRow sb_film_error_rows[] = {
    {"film_min", "Error estimate, minimum film", "1", "", offsetof(SbFilm, solver.error_film_min),
     0},
    {"film_central", "Error estimate, central film", "1", "",
     offsetof(SbFilm, solver.error_film_central), 0},
    {"film_flux", NULL, "", "", offsetof(SbFilm, solver.error_film_flux), 0},
    {0}};

const SbResultRow sb_fit_rows[] = {
    {"squeeze", "Squeeze", "1", "%", offsetof(SbFit, squeeze), 0},
    {"stretch_mean", "Stretch, mean diameter", "1", "%", offsetof(SbFit, stretch_mean), 0},
    {"stretch_inner", "Stretch, inner diameter", "1", "%", offsetof(SbFit, stretch_inner), 0},
    {"section_diameter_fitted_m", "Section when fitted", "m", "mm",
     offsetof(SbFit, section_diameter_fitted), 0},
    {"interference_m", "Interference", "m", "mm", offsetof(SbFit, interference), 0},
    {"gland_fill", "Gland fill", "1", "%", offsetof(SbFit, gland_fill), 0},
    {0}};

const SbResultRow sb_fit_contact_rows[] = {
    {"circumference_m", "Circumference of the load", "m", "mm", offsetof(SbFit, circumference), 0},
    {"contact_width_m", "Contact width", "m", "mm", offsetof(SbFit, contact_width),
     offsetof(SbFit, solver.error_estimate.contact_width)},
    {"contact_left_m", NULL, "", "", offsetof(SbFit, contact_left), 0},
    {"contact_right_m", NULL, "", "", offsetof(SbFit, contact_right), 0},
    {"load_N", "Load", "N", "N", offsetof(SbFit, load),
     offsetof(SbFit, solver.error_estimate.load)},
    {"load_N_per_m", "Load per length", "N/m", "N/m", offsetof(SbFit, load_per_length),
     offsetof(SbFit, solver.error_estimate.load)},
    {"pressure_peak_Pa", "Peak pressure", "Pa", "MPa", offsetof(SbFit, pressure_peak),
     offsetof(SbFit, solver.error_estimate.pressure_peak)},
    {0}};

const SbResultRow sb_fit_ring_rows[] = {
    {"floor_load_N", "Load on the groove floor", "N", "N", offsetof(SbFit, ring.floor_load), 0},
    {"wall_load_N", "Load on the groove wall", "N", "N", offsetof(SbFit, ring.wall_load), 0},
    {"radial_thickness_m", NULL, "", "", offsetof(SbFit, ring.thickness), 0},
    {"volume_change", NULL, "", "", offsetof(SbFit, ring.volume_change), 0},
    {"axial_imbalance", NULL, "", "", offsetof(SbFit, ring.axial_imbalance), 0},
    {0}};

const SbResultRow sb_fit_drag_rows[] = {
    {"drag_N", "Drag of the bore", "N", "N", offsetof(SbFit, ring.drag), 0},
    {"wall_load_N", NULL, "", "", offsetof(SbFit, ring.wall_load), 0},
    {"floor_load_N", NULL, "", "", offsetof(SbFit, ring.floor_load), 0},
    {"turn_rad", "Turn of the section", "rad", "°", offsetof(SbFit, ring.turn), 0},
    {0}};

const SbResultRow sb_fit_error_rows[] = {
    {"load", "Error estimate, load", "1", "", offsetof(SbFit, solver.error_estimate.load), 0},
    {"pressure_peak", NULL, "", "", offsetof(SbFit, solver.error_estimate.pressure_peak), 0},
    {"contact_width", NULL, "", "", offsetof(SbFit, solver.error_estimate.contact_width), 0},
    {0}};

// Of the JSON alone.
static const SbResultRow gland_rows[] = {
    {"nominal", NULL, "", "", offsetof(SbGlandReadout, nominal), 0},
    {"worst_low", NULL, "", "", offsetof(SbGlandReadout, worst_low), 0},
    {"worst_high", NULL, "", "", offsetof(SbGlandReadout, worst_high), 0},
    {"rss_low", NULL, "", "", offsetof(SbGlandReadout, rss_low), 0},
    {"rss_high", NULL, "", "", offsetof(SbGlandReadout, rss_high), 0},
    {"band_low", NULL, "", "", offsetof(SbGlandReadout, band_low), 0},
    {"band_high", NULL, "", "", offsetof(SbGlandReadout, band_high), 0},
    {0}};

static const SbResultRow storage_rows[] = {
    {"section_diameter_m", NULL, "", "", offsetof(SbRubberState, section_diameter), 0},
    {"inner_diameter_m", NULL, "", "", offsetof(SbRubberState, inner_diameter), 0},
    {"modulus_Pa", NULL, "", "", offsetof(SbRubberState, modulus), 0},
    {"relaxation", NULL, "", "", offsetof(SbRubberState, relaxation), 0},
    {"network", NULL, "", "", offsetof(SbRubberState, network), 0},
    {"compression_set", NULL, "", "", offsetof(SbRubberState, compression_set), 0},
    {"section_diameter_after_set_m", NULL, "", "", offsetof(SbRubberState, section_after_set), 0},
    {"uptake", NULL, "", "", offsetof(SbRubberState, uptake), 0},
    {"volume_swell", NULL, "", "", offsetof(SbRubberState, volume_swell), 0},
    {"linear_swell", NULL, "", "", offsetof(SbRubberState, linear_swell), 0},
    {0}};

// Why figures of a film are null, by path; a solver that found nothing has none of them.
static void put_film_reasons(SbJson *json, const SbFilm *film, bool none) {
  const SbResultRow *const rows[] = {sb_film_rows, sb_film_rough_rows};
  sb_json_object(json, "reasons");
  for (size_t k = 0; none && k < G_N_ELEMENTS(rows); k++) {
    for (const SbResultRow *row = rows[k]; row->key != NULL; row++) {
      sb_json_string(json, row->key, "the solver found no film");
    }
  }
  if (!none && isnan(film->film_ratio)) {
    sb_json_string(json, "film_ratio", "the film is that of smooth surfaces");
  }
  sb_json_object_end(json);
}

SbResultsHistory sb_results_history(size_t count, const double *time, double *values) {
  for (size_t i = 0; i < SB_RESULTS_HISTORY_COLUMNS * count; i++) {
    values[i] = NAN;
  }
  return (SbResultsHistory){.count = count,
                            .time = time,
                            .film_min = values,
                            .film_central = values + count,
                            .friction = values + 2 * count,
                            .error_min = values + 3 * count,
                            .error_central = values + 4 * count};
}

// Figures of a film that differ with the closure of its channels, each as low and high.
static void put_intervals(SbJson *json, const SbFilm *trapped, const SbFilm *drained) {
  const SbResultRow *const rows[] = {sb_film_rows, sb_film_rough_rows};
  sb_json_object(json, "intervals");
  for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
    for (const SbResultRow *row = rows[k]; row->key != NULL; row++) {
      const double a = sb_result_value(row, trapped), b = sb_result_value(row, drained);
      if (a != b) {
        sb_json_numbers(json, row->key, (const double[]){fmin(a, b), fmax(a, b)}, 2);
      }
    }
  }
  sb_json_object_end(json);
}

// What a document has beside the film.
static void put_extra(SbJson *json, const SbFilm *film, const SbResultsFilmExtra *extra) {
  const SbResultsHistory *history = extra->history;
  if (extra->drained != NULL) {
    put_intervals(json, film, extra->drained);
  }
  if (extra->content.closed > 0) {
    sb_json_object(json, "content");
    sb_json_number(json, "content_m", extra->content.content);
    sb_json_number(json, "closed_m", extra->content.closed);
    sb_json_number(json, "friction_N_per_m", extra->content.friction);
    sb_json_number(json, "real_area_m", extra->content.real_area);
    sb_json_object_end(json);
  }
  if (history != NULL) {
    sb_json_object(json, "history");
    sb_json_numbers(json, "time_s", history->time, history->count);
    sb_json_numbers(json, "film_min_m", history->film_min, history->count);
    sb_json_numbers(json, "film_central_m", history->film_central, history->count);
    sb_json_numbers(json, "friction_N_per_m", history->friction, history->count);
    sb_json_object(json, "error_estimate");
    sb_json_numbers(json, "film_min", history->error_min, history->count);
    sb_json_numbers(json, "film_central", history->error_central, history->count);
    sb_json_object_end(json);
    sb_json_object_end(json);
  }
}

char *sb_results_film(const SbFilm *film, const SbResultsFilmExtra *extra) {
  // A solver that found nothing has no figures; what describes the problem stays.
  const bool none = !film->solver.converged && film->film_central == 0;
  SbJson json;
  sb_json_document(&json);
  sb_json_string(&json, "model", sb_film_kind(film->model)->name);
  sb_json_rows(&json, sb_film_rows, film, !none);
  sb_json_rows(&json, sb_film_contact_rows, film, true);
  sb_json_rows(&json, sb_film_rough_rows, film, !none);
  sb_json_bool(&json, "ruptured", film->ruptured);
  sb_json_bool(&json, "starved", film->starved);
  sb_json_string(&json, "regime", film->regime);
  sb_json_number(&json, "expected_model_error", film->expected_error);
  sb_json_bool(&json, "valid", film->valid);
  put_film_reasons(&json, film, none);
  sb_json_warnings(&json, &film->warnings);
  const SbFilmSolverInfo *solver = &film->solver;
  sb_json_object(&json, "solver");
  sb_json_bool(&json, "converged", solver->converged);
  sb_json_count(&json, "unknowns", solver->unknowns);
  sb_json_count(&json, "newton_iterations", (guint64)MAX(solver->newton_iterations, 0));
  sb_json_count(&json, "continuation_steps", (guint64)MAX(solver->continuation_steps, 0));
  sb_json_number(&json, "residual", solver->residual);
  sb_json_object(&json, "error_estimate");
  sb_json_rows(&json, sb_film_error_rows, film, !none);
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
  put_extra(&json, film, extra);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}

// The gland's read-outs, none of a seal that lies in none, and what storage made of the ring.
static void put_gland(SbJson *json, const SbGlandReadout *gland) {
  sb_json_array(json, "gland");
  for (int i = 0; gland != NULL && i < SB_GLAND_COUNT; i++) {
    const SbGlandReadout *r = &gland[i];
    sb_json_object(json, NULL);
    sb_json_string(json, "name", r->name);
    sb_json_string(json, "unit", r->unit);
    sb_json_rows(json, gland_rows, r, true);
    sb_json_string(json, "band", r->band == SB_BAND_NONE ? NULL : sb_band_text(r->band));
    sb_json_string(json, "band_worst",
                   r->band == SB_BAND_NONE ? NULL : sb_band_text(r->band_worst));
    sb_json_string(json, "source", r->source[0] == '\0' ? NULL : r->source);
    sb_json_string(json, "reason", r->why[0] == '\0' ? NULL : r->why);
    sb_json_object_end(json);
  }
  sb_json_array_end(json);
}

static void put_storage(SbJson *json, const SbRubberState *storage) {
  sb_json_object(json, "storage");
  sb_json_rows(json, storage_rows, storage, true);
  sb_json_object_end(json);
}

// What a dragged ring has beside.
static void put_drag(SbJson *json, const SbFit *fit, bool limit) {
  const bool found = fit->solver.converged;
  sb_json_rows(json, sb_fit_drag_rows, fit, found);
  sb_json_string(json, "state", found ? sb_ring_state_name(fit->ring.state) : NULL);
  sb_json_number(json, "drag_limit", limit && found ? fit->ring.drag_limit : NAN);
}

static void put_solver_reasons(SbJson *json, const SbResultRow *row) {
  for (; row->key != NULL; row++) {
    sb_json_string(json, row->key, "the solver found no such state");
  }
}

// Why figures are null: of a contact that was not found, of what a dragged ring has beside.
static void put_fit_reasons(SbJson *json, const SbFit *fit, bool found, bool dragged, bool limit) {
  if (found && !dragged) {
    return;
  }
  sb_json_object(json, "reasons");
  if (!found) {
    put_solver_reasons(json, sb_fit_contact_rows);
  }
  if (dragged && !fit->solver.converged) {
    put_solver_reasons(json, sb_fit_drag_rows);
    sb_json_string(json, "state", "the solver found no such state");
    sb_json_string(json, "drag_limit", "the solver found no such state");
  } else if (dragged && !limit) {
    sb_json_string(json, "drag_limit", "not requested by --drag limit or --drag -limit");
  } else if (dragged && isnan(fit->ring.drag_limit)) {
    sb_json_string(json, "drag_limit", "the ring slides at every friction up to 2");
  }
  sb_json_object_end(json);
}

bool sb_results_fit_found(const SbFit *fit) {
  return fit->solver.converged || fit->load > 0;
}

char *sb_results_fit(const SbFit *fit, const SbFitProblem *problem, bool limit, const char *seal,
                     const SbGlandReadout *gland, const SbRubberState *storage, const char *file) {
  SbJson json;
  sb_json_document(&json);
  sb_json_string(&json, "file", file);
  sb_json_string(&json, "model", sb_fit_kind(fit->model)->name);
  sb_json_string(&json, "variant", sb_fit_variant_name(fit->model, fit->variant));
  sb_json_string(&json, "seal", seal);
  sb_json_number(&json, "pressure_Pa", problem->pressure);
  const bool found = sb_results_fit_found(fit);
  sb_json_rows(&json, sb_fit_rows, fit, true);
  sb_json_rows(&json, sb_fit_contact_rows, fit, found);
  if (problem->dragged) {
    put_drag(&json, fit, limit);
  }
  put_fit_reasons(&json, fit, found, problem->dragged, limit);
  sb_json_bool(&json, "touches", fit->touches);
  sb_json_bool(&json, "valid", fit->valid);
  sb_json_warnings(&json, &fit->warnings);
  sb_json_object(&json, "solver");
  sb_json_bool(&json, "converged", fit->solver.converged);
  sb_json_count(&json, "unknowns", fit->solver.unknowns);
  sb_json_count(&json, "newton_iterations", fit->solver.newton_iterations);
  sb_json_object(&json, "error_estimate");
  sb_json_rows(&json, sb_fit_error_rows, fit, found);
  sb_json_object_end(&json);
  sb_json_number(&json, "wall_s", fit->solver.wall_s);
  sb_json_object_end(&json);
  if (sb_fit_kind(fit->model)->section) {
    sb_json_object(&json, "ring");
    sb_json_rows(&json, sb_fit_ring_rows, fit, found);
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
