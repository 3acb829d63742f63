// The JSON documents of one film and one fitted ring, and the rows that their tables share.
#include "app/export/results.h"

#include <math.h>

const SbResultRow sb_film_rows[] = {
    {"film_min_m", "Film, least", "m", "nm", offsetof(SbFilm, film_min)},
    {"film_central_m", "Film, central", "m", "nm", offsetof(SbFilm, film_central)},
    {"film_flux_m", "Film, of the flow", "m", "nm", offsetof(SbFilm, film_flux)},
    {"pressure_max_Pa", "Pressure, largest", "Pa", "MPa", offsetof(SbFilm, pressure_max)},
    {"position_film_min_m", "Place of the least film", "m", "mm",
     offsetof(SbFilm, position_film_min)},
    {"position_rupture_m", "Place of rupture", "m", "mm", offsetof(SbFilm, position_rupture)},
    {"friction_couette_N_per_m", "Friction, Couette", "N/m", "N/m",
     offsetof(SbFilm, friction_couette)},
    {"friction_poiseuille_N_per_m", "Friction, Poiseuille", "N/m", "N/m",
     offsetof(SbFilm, friction_poiseuille)},
    {0}};

const SbResultRow sb_film_contact_rows[] = {
    {"hertz_half_width_m", "Hertz half-width", "m", "mm", offsetof(SbFilm, hertz_half_width)},
    {"hertz_pressure_Pa", "Hertz pressure", "Pa", "MPa", offsetof(SbFilm, hertz_pressure)},
    {"moes_M", "Moes' M", "1", "", offsetof(SbFilm, moes_M)},
    {0}};

const SbResultRow sb_film_rough_rows[] = {
    {"film_ratio", "Central film over roughness", "1", "", offsetof(SbFilm, film_ratio)},
    {"asperity_load_N_per_m", NULL, "", "", offsetof(SbFilm, asperity_load)},
    {"asperity_load_share", "Load on asperities, share", "1", "", offsetof(SbFilm, asperity_share)},
    {"real_area_m", NULL, "", "", offsetof(SbFilm, real_area)},
    {"real_area_share", "Real contact at the axis, share", "1", "",
     offsetof(SbFilm, real_area_share)},
    {"friction_boundary_N_per_m", "Friction, boundary", "N/m", "N/m",
     offsetof(SbFilm, friction_boundary)},
    {"friction_cavity_N_per_m", "Friction, broken film", "N/m", "N/m",
     offsetof(SbFilm, friction_cavity)},
    {0}};

const SbResultRow sb_film_error_rows[] = {
    {"film_min", "Error estimate, least film", "1", "", offsetof(SbFilm, solver.error_film_min)},
    {"film_central", "Error estimate, central film", "1", "",
     offsetof(SbFilm, solver.error_film_central)},
    {"film_flux", NULL, "", "", offsetof(SbFilm, solver.error_film_flux)},
    {0}};

const SbResultRow sb_fit_rows[] = {
    {"squeeze", "Squeeze", "1", "%", offsetof(SbFit, squeeze)},
    {"stretch_mean", "Stretch, mean diameter", "1", "%", offsetof(SbFit, stretch_mean)},
    {"stretch_inner", "Stretch, inner diameter", "1", "%", offsetof(SbFit, stretch_inner)},
    {"section_diameter_fitted_m", "Section when fitted", "m", "mm",
     offsetof(SbFit, section_diameter_fitted)},
    {"interference_m", "Interference", "m", "mm", offsetof(SbFit, interference)},
    {"gland_fill", "Gland fill", "1", "%", offsetof(SbFit, gland_fill)},
    {0}};

const SbResultRow sb_fit_contact_rows[] = {
    {"circumference_m", "Circumference of the load", "m", "mm", offsetof(SbFit, circumference)},
    {"contact_width_m", "Contact width", "m", "mm", offsetof(SbFit, contact_width)},
    {"contact_left_m", NULL, "", "", offsetof(SbFit, contact_left)},
    {"contact_right_m", NULL, "", "", offsetof(SbFit, contact_right)},
    {"load_N", "Load", "N", "N", offsetof(SbFit, load)},
    {"load_N_per_m", "Load per length", "N/m", "N/m", offsetof(SbFit, load_per_length)},
    {"pressure_peak_Pa", "Peak pressure", "Pa", "MPa", offsetof(SbFit, pressure_peak)},
    {0}};

const SbResultRow sb_fit_ring_rows[] = {
    {"floor_load_N", "Load on the groove floor", "N", "N", offsetof(SbFit, ring.floor_load)},
    {"wall_load_N", "Load on the groove wall", "N", "N", offsetof(SbFit, ring.wall_load)},
    {"radial_thickness_m", NULL, "", "", offsetof(SbFit, ring.thickness)},
    {"volume_change", NULL, "", "", offsetof(SbFit, ring.volume_change)},
    {"axial_imbalance", NULL, "", "", offsetof(SbFit, ring.axial_imbalance)},
    {0}};

const SbResultRow sb_fit_drag_rows[] = {
    {"drag_N", "Drag of the bore", "N", "N", offsetof(SbFit, ring.drag)},
    {"wall_load_N", NULL, "", "", offsetof(SbFit, ring.wall_load)},
    {"floor_load_N", NULL, "", "", offsetof(SbFit, ring.floor_load)},
    {"turn_rad", "Turn of the section", "rad", "°", offsetof(SbFit, ring.turn)},
    {0}};

const SbResultRow sb_fit_error_rows[] = {
    {"load", "Error estimate, load", "1", "", offsetof(SbFit, solver.error_estimate.load)},
    {"pressure_peak", NULL, "", "", offsetof(SbFit, solver.error_estimate.pressure_peak)},
    {"contact_width", NULL, "", "", offsetof(SbFit, solver.error_estimate.contact_width)},
    {0}};

// Of the JSON alone.
static const SbResultRow gland_rows[] = {
    {"nominal", NULL, "", "", offsetof(SbGlandReadout, nominal)},
    {"worst_low", NULL, "", "", offsetof(SbGlandReadout, worst_low)},
    {"worst_high", NULL, "", "", offsetof(SbGlandReadout, worst_high)},
    {"rss_low", NULL, "", "", offsetof(SbGlandReadout, rss_low)},
    {"rss_high", NULL, "", "", offsetof(SbGlandReadout, rss_high)},
    {"band_low", NULL, "", "", offsetof(SbGlandReadout, band_low)},
    {"band_high", NULL, "", "", offsetof(SbGlandReadout, band_high)},
    {0}};

static const SbResultRow storage_rows[] = {
    {"section_diameter_m", NULL, "", "", offsetof(SbRubberState, section_diameter)},
    {"inner_diameter_m", NULL, "", "", offsetof(SbRubberState, inner_diameter)},
    {"modulus_Pa", NULL, "", "", offsetof(SbRubberState, modulus)},
    {"relaxation", NULL, "", "", offsetof(SbRubberState, relaxation)},
    {"network", NULL, "", "", offsetof(SbRubberState, network)},
    {"compression_set", NULL, "", "", offsetof(SbRubberState, compression_set)},
    {"section_diameter_after_set_m", NULL, "", "", offsetof(SbRubberState, section_after_set)},
    {"uptake", NULL, "", "", offsetof(SbRubberState, uptake)},
    {"volume_swell", NULL, "", "", offsetof(SbRubberState, volume_swell)},
    {"linear_swell", NULL, "", "", offsetof(SbRubberState, linear_swell)},
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

char *sb_results_film(const SbFilm *film, const SbResultsHistory *history) {
  // A solver that found nothing has no figures; what describes the problem stays.
  const bool none = !film->solver.converged && film->film_central == 0;
  SbJson json;
  sb_json_document(&json);
  sb_json_string(&json, "model", sb_film_model_name(film->model));
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

static void put_reasons(SbJson *json, const SbResultRow *row) {
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
    put_reasons(json, sb_fit_contact_rows);
  }
  if (dragged && !fit->solver.converged) {
    put_reasons(json, sb_fit_drag_rows);
    sb_json_string(json, "state", "the solver found no such state");
    sb_json_string(json, "drag_limit", "the solver found no such state");
  } else if (dragged && !limit) {
    sb_json_string(json, "drag_limit", "not asked for by --drag limit or --drag -limit");
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
  sb_json_string(&json, "model", sb_fit_model_name(fit->model));
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
  if (fit->model == SB_FIT_RING) {
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
