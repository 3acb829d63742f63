// What `sealbench film` computes beside one steady film: the film or the content of a contact
// through a series of speeds (--history), its friction at a content (--content), and the interval
// between trapped and drained fluid (--sealed both). Called by the main thread.
#pragma once

#include "app/document/series.h"
#include "app/export/results.h"

#include "engine/film/film.h"

// Reads the series of speeds in [m/s] at `path`; its first speed is written to problem->speed.
// `speed`: the text of --speed, which excludes it; NULL: none. False with a message.
SB_CHECKED bool sb_film_history_read(SbModelSeries *series, SbFilmProblem *problem,
                                     const char *path, const char *speed);

// Returns whether a history may start with the first speed of `series`, read from `path`: at rest
// there is no steady film, but a contact whose channels close is drained. False with a message.
bool sb_film_history_starts(const SbModelSeries *series, const SbFilmProblem *problem,
                            const char *path);

// Reads a content [m] > 0 from the text of --content (NULL: *out is NaN). False with a message.
SB_CHECKED bool sb_film_history_read_content(double *out, const SbFilmProblem *problem,
                                             const char *text);

// Computes the film of `problem` at every row of `series`, or the content with a percolation
// threshold. `out` has as many rows; rows behind a failure are NaN. Errors of
// sb_film_transient_create(), sb_film_transient_step(), sb_content_create().
SbStatus sb_film_history_follow(SbResultsHistory *out, const SbFilmProblem *problem,
                                const SbModelSeries *series, SbReport *report);

// Computes the contact of `problem` with the content `u` [m] everywhere. Errors of
// sb_content_create().
SbStatus sb_film_history_content(SbResultsContent *out, const SbFilmProblem *problem, double u,
                                 SbReport *report);

// Prints what there is of `extra` of `film`.
void sb_film_history_print(const SbFilm *film, const SbResultsFilmExtra *extra);
