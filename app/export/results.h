// Results as JSON documents, with stable keys that contain the unit. Numbers that do not exist are
// null. docs/results.md describes the documents.
#pragma once

#include "app/data/compare.h"
#include "app/run/cases.h"
#include "app/table/table.h"
#include "engine/contact/fit.h"
#include "engine/contact/gland.h"
#include "engine/film/film.h"
#include "engine/rubber/rubber_time.h"
#include "engine/valve/sealbench.h"
#include "engine/valve/studies/study.h"

#include <glib.h>

// What the document of a run contains in addition to the run. Borrowed during the call.
// sb_results_converged() uses only the studies.
typedef struct {
  const char *scene;      // full path of the file, "-" for standard input; or a title
  const char *sha256;     // of the parameters
  bool partial;           // the run was interrupted
  const SbStudy *studies; // [study_count], as output.studies requests
  size_t study_count;
  const SbCaseVerdict *verdict; // [SB_VERDICT_COUNT], from sb_cases_judge()
  const GPtrArray *problems;    // of cases that failed, as sb_cases_judge() gives them; NULL: none
  const SbComparison *measured; // measured data compared with the run; NULL: none
} SbResultsInfo;

// Returns whether a run, every point of its studies and every case have converged
// (solver.converged; if not, the exit status reports it).
bool sb_results_converged(const SbSummary *summary, const SbResultsInfo *info);

// Number of columns of a history, without its times.
enum { SB_RESULTS_HISTORY_COLUMNS = 5 };

// A film, or the content of a contact whose channels close (content.h), through a series of speeds;
// each array has `count` values, NaN where it was not computed.
typedef struct {
  size_t count;
  const double *time;                // [s]
  double *film_min, *film_central;   // of a content: least and mean [m]
  double *friction;                  // on the wall [N/m]
  double *error_min, *error_central; // error estimates, relative
} SbResultsHistory;

// Returns a history of `count` rows, all NaN, with the `time` [s] (borrowed) and its columns in
// `values` (SB_RESULTS_HISTORY_COLUMNS * count, borrowed).
SbResultsHistory sb_results_history(size_t count, const double *time, double *values);

// Friction of a contact with a given content of fluid (content.h).
typedef struct {
  double content, closed;     // u; u*, at which the last channel closes [m]
  double friction, real_area; // [N/m]; [m]
} SbResultsContent;

// What a document of a film has beside the film; NULL and zero: nothing.
typedef struct {
  const SbResultsHistory *history;
  const SbFilm *drained; // the same contact without fluid, for "intervals"
  SbResultsContent content;
} SbResultsFilmExtra;

// Rows (sb_result_value()) of SbFilm: the results; what the contact alone determines; the
// asperities; the error estimates. Of SbFit: the results; those with a contact; those of the ring
// model; those of a dragged ring; the error estimates. Each list ends with a key of NULL.
extern const SbResultRow sb_film_rows[], sb_film_contact_rows[], sb_film_rough_rows[],
    sb_film_error_rows[], sb_fit_rows[], sb_fit_contact_rows[], sb_fit_ring_rows[],
    sb_fit_drag_rows[], sb_fit_error_rows[];

// Returns the document of a run that has ended.
char *sb_results_run(const SbRun *run, const SbResultsInfo *info);

// Returns the document of a film with what `extra` has.
char *sb_results_film(const SbFilm *film, const SbResultsFilmExtra *extra);

// Returns whether the solver found a contact, also one whose residual is above the tolerance. If
// false, the results of the contact are null.
bool sb_results_fit_found(const SbFit *fit);

// Returns the document of a fitment. `problem` is what `fit` solves; if it is dragged, the document
// has the results of dragging. `limit`: the largest drag was computed too. `seal`: name of the
// seal. `gland`: [SB_GLAND_COUNT] compression, stretch and fill of the groove, NULL: the seal is in
// no groove; `storage`: state of the rubber after storage; `file`: full path of the valve or scene,
// "-" for standard input.
char *sb_results_fit(const SbFit *fit, const SbFitProblem *problem, bool limit, const char *seal,
                     const SbGlandReadout *gland, const SbRubberState *storage, const char *file);

// Returns the document of a plan: what a run would compute. `scene`: full path of its file, "-" for
// standard input.
char *sb_results_plan(const SbPlan *plan, const char *scene);

// Returns the catalogue of parameters, an array of objects.
char *sb_results_params(void);

// Returns the catalogue of figures. Freed by sb_table_free().
SbTable *sb_list_figures(void);

// Returns the choices of the parameters "models.*" and the film models of the command `film`, for
// files alone. Freed by sb_table_free().
SbTable *sb_list_models(void);

// Returns the views and the drawn studies. Freed by sb_table_free().
SbTable *sb_list_views(void);

// Returns the fluids. Freed by sb_table_free().
SbTable *sb_list_fluids(void);
