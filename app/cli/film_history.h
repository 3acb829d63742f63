// What `sealbench film` computes in addition to one steady film: the film or the content of a
// contact through a series of speeds (--history), and its friction at a content (--content); prints
// these and the interval between trapped and drained fluid (--sealed both). Called by the main
// thread. Functions "with a message" print it to standard error.
#pragma once

#include "app/document/series.h"
#include "app/export/results.h"

#include "engine/film/film.h"

// Reads the series of speeds [m/s] at `path` into `series`, which needs no initialisation and no
// freeing, and writes its first speed to problem->speed. `speed`: the text of --speed, or NULL;
// --speed and --history together are an error. False with a message.
SB_CHECKED bool sb_film_history_read(SbModelSeries *series, SbFilmProblem *problem,
                                     const char *path, const char *speed);

// Returns whether the history read from `path` may start with its first speed: 0 only with a
// percolation threshold; the contact then starts drained. To be called when `problem` is complete.
// False with a message.
SB_CHECKED bool sb_film_history_starts(const SbModelSeries *series, const SbFilmProblem *problem,
                                       const char *path);

// Reads a content [m] >= 0 from the text of --content, at most 10 times problem->sigma (NULL: *out
// is NaN). False with a message, also without a percolation threshold.
SB_CHECKED bool sb_film_history_read_content(double *out, const SbFilmProblem *problem,
                                             const char *text);

// Computes a row of `out` for each row of `series`: the film, or, if `problem` has a percolation
// threshold, the content. `out` is that of sb_results_history(), with all rows NaN; rows behind a
// failure stay NaN. Errors of sb_film_transient_create() and sb_film_transient_step(), or of
// sb_content_create() and sb_content_step().
SbStatus sb_film_history_follow(SbResultsHistory *out, const SbFilmProblem *problem,
                                const SbModelSeries *series, SbReport *report);

// Computes the contact of `problem` at rest with the content `u` [m] everywhere: without the shear
// of the fluid. Errors of sb_content_create().
SbStatus sb_film_history_content(SbResultsContent *out, const SbFilmProblem *problem, double u,
                                 SbReport *report);

// Prints those parts of `extra` that were computed to standard output; `film` is the steady film
// that they belong to.
void sb_film_history_print(const SbFilm *film, const SbResultsFilmExtra *extra);
