// Results as JSON documents, with stable keys, the unit in each.
#pragma once

#include "app/data/compare.h"
#include "app/export/json.h"
#include "app/run/cases.h"
#include "engine/contact/fit.h"
#include "engine/contact/gland.h"
#include "engine/film/film.h"
#include "engine/rubber/rubber_time.h"
#include "engine/valve/sealbench.h"
#include "engine/valve/studies/study.h"

#include <glib.h>

// What a run's document needs beyond the run.
typedef struct {
  const char *scene;      // full path of the file, "-" for standard input; or a title
  const char *sha256;     // of the parameters
  bool partial;           // interrupted
  const SbStudy *studies; // `study_count` of them, what output.studies asked for
  size_t study_count;
  const SbCaseVerdict *verdict; // of SB_VERDICT_COUNT
  const SbComparison *measured; // NULL: nothing was
} SbResultsInfo;

// Whether a run and every point of its studies have converged, as the exit status states.
bool sb_results_converged(const SbSummary *summary, const SbResultsInfo *info);

// A film through a series of speeds, one value a row; NAN where it was not reached.
typedef struct {
  size_t count;
  const double *time;                // [s]
  double *film_min, *film_central;   // [m]
  double *error_min, *error_central; // estimates, relative
} SbResultsHistory;

// Rows of SbFilm: what was found, what the contact's problem alone gives, what asperities do, error
// estimates; of SbFit: what was found, with the ring model, error estimates. Each ends with a key
// of NULL.
extern const SbResultRow sb_film_rows[], sb_film_contact_rows[], sb_film_rough_rows[],
    sb_film_error_rows[], sb_fit_rows[], sb_fit_contact_rows[], sb_fit_ring_rows[],
    sb_fit_drag_rows[], sb_fit_error_rows[];

// All of these return a text owned by the caller. Numbers that do not exist are null.
char *sb_results_run(const SbRun *run, const SbResultsInfo *info);
char *sb_results_film(const SbFilm *film, const SbResultsHistory *history); // NULL: none
// Whether the solver has a contact, perhaps above its tolerance; else there is none to tell of.
bool sb_results_fit_found(const SbFit *fit);

// With the figures of a dragged ring; the greatest drag if that was looked for. `file` is the full
// path of the valve or scene, "-" for standard input.
char *sb_results_fit(const SbFit *fit, const SbFitProblem *problem, bool limit, const char *seal,
                     const SbGlandReadout *gland, const SbRubberState *storage, const char *file);
char *sb_results_plan(const SbPlan *plan, const char *scene); // full path
char *sb_results_params(void);
char *sb_results_figures(void);
char *sb_results_models(void);
char *sb_results_fluids(void);
