#include "app/cli/film_history.h"

#include "app/base/issue.h"
#include "app/base/unit.h"
#include "app/cli/cli.h"

#include "engine/film/content.h"
#include "engine/film/transient.h"

#include <math.h>

bool sb_film_history_read(SbModelSeries *series, SbFilmProblem *problem, const char *path,
                          const char *speed) {
  if (speed != NULL) {
    sb_cli_fail("--speed: the speeds are those of --history");
    return false;
  }
  g_autoptr(GPtrArray) issues = sb_issues_new();
  const bool good = sb_series_read(series, SB_SERIES_SPEED, NULL, 0, path, issues);
  sb_cli_issues(issues);
  problem->speed = good ? series->value[0] : 0;
  return good;
}

bool sb_film_history_starts(const SbModelSeries *series, const SbFilmProblem *problem,
                            const char *path) {
  const bool good = series->value[0] != 0 || problem->percolation_threshold > 0;
  if (!good) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    sb_issues_add(issues, path, 0, "speed", NULL, "begins at rest, where no steady film is");
    sb_cli_issues(issues);
  }
  return good;
}

bool sb_film_history_read_content(double *out, const SbFilmProblem *problem, const char *text) {
  *out = NAN;
  if (text == NULL) {
    return true;
  }
  if (!(problem->percolation_threshold > 0)) {
    sb_cli_fail("--content: needs --percolation-threshold");
    return false;
  }
  if (!sb_cli_quantity(out, "--content", text, true, "m", "nm")) {
    return false;
  }
  if (!(*out >= 0 && *out <= 10 * problem->sigma)) {
    g_autofree char *most = sb_quantity_round(10 * problem->sigma, "m", "nm", 5);
    sb_cli_fail("--content: %s is out of range (allowed 0 nm to %s, ten times --sigma)", text,
                most);
    return false;
  }
  return true;
}

static double largest_speed(const SbModelSeries *series) {
  double largest = 0;
  for (size_t i = 0; i < series->count; i++) {
    largest = fmax(largest, fabs(series->value[i]));
  }
  return largest;
}

static SbStatus follow_film(SbResultsHistory *out, const SbFilmProblem *problem,
                            const SbModelSeries *series, SbReport *report) {
  SbFilmTransientProblem transient = {.film = *problem,
                                      .speed_scale = largest_speed(series),
                                      .inlet_film = {problem->inlet_film, problem->inlet_film},
                                      .resolve = true};
  transient.film.inlet_film = 0;
  SbFilmTransient *solver = NULL;
  SbStatus status = sb_film_transient_create(&solver, &transient, report);
  for (size_t i = 0; i < series->count && status == SB_OK; i++) {
    if (i > 0) {
      status = sb_film_transient_step(solver, series->time[i] - series->time[i - 1],
                                      series->value[i], report);
    }
    if (status == SB_OK) {
      const SbFilmTransientResult film = sb_film_transient_result(solver);
      out->film_min[i] = film.film_min;
      out->film_central[i] = film.film_central;
      out->friction[i] = film.friction_couette + film.friction_poiseuille + film.friction_cavity +
                         film.friction_boundary;
      out->error_min[i] = film.error_film_min;
      out->error_central[i] = film.error_film_central;
    }
  }
  sb_film_transient_destroy(solver);
  return status;
}

static SbStatus follow_content(SbResultsHistory *out, const SbFilmProblem *problem,
                               const SbModelSeries *series, SbReport *report) {
  const SbContentProblem memory = {.film = *problem, .speed_scale = largest_speed(series)};
  SbContent *content = NULL;
  SbStatus status = sb_content_create(&content, &memory, report);
  for (size_t i = 0; i < series->count && status == SB_OK; i++) {
    if (i > 0) {
      status =
          sb_content_step(content, series->time[i] - series->time[i - 1], series->value[i], report);
    }
    if (status == SB_OK) {
      const SbContentResult now = sb_content_result(content);
      out->film_min[i] = now.least;
      out->film_central[i] = now.mean;
      out->friction[i] = now.friction;
      out->error_min[i] = out->error_central[i] = now.error_mean;
    }
  }
  sb_content_destroy(content);
  return status;
}

SbStatus sb_film_history_follow(SbResultsHistory *out, const SbFilmProblem *problem,
                                const SbModelSeries *series, SbReport *report) {
  return (problem->percolation_threshold > 0 ? follow_content : follow_film)(out, problem, series,
                                                                             report);
}

SbStatus sb_film_history_content(SbResultsContent *out, const SbFilmProblem *problem, double u,
                                 SbReport *report) {
  SbContentProblem memory = {.film = *problem};
  memory.film.speed = 0;
  SbContent *content = NULL;
  SbStatus status = sb_content_create(&content, &memory, report);
  if (status == SB_OK) {
    const SbContentResult result = sb_content_uniform(content, u);
    *out = (SbResultsContent){.content = u,
                              .closed = sb_content_closed(content),
                              .friction = result.friction,
                              .real_area = result.real_area};
  }
  sb_content_destroy(content);
  return status;
}

void sb_film_history_print(const SbFilm *film, const SbResultsFilmExtra *extra) {
  if (extra->drained != NULL) {
    puts("Fluid in the closed contact             trapped        drained");
    for (const SbResultRow *row = sb_film_rough_rows; row->key != NULL; row++) {
      if (row->label != NULL) {
        g_autofree char *trapped =
            sb_quantity_round(sb_result_value(row, film), row->si, row->shown, 5);
        g_autofree char *drained =
            sb_quantity_round(sb_result_value(row, extra->drained), row->si, row->shown, 5);
        printf("  %-34s %14s %14s\n", row->label, trapped, drained);
      }
    }
  }
  if (extra->content.closed > 0) {
    puts("With a given content");
    sb_cli_figure("Content", extra->content.content, "m", "nm");
    sb_cli_figure("Content at which channels close", extra->content.closed, "m", "nm");
    sb_cli_figure("Friction", extra->content.friction, "N/m", "N/m");
  }
  const SbResultsHistory *h = extra->history;
  if (h != NULL) {
    puts("Film by time                      minimum    central     friction  error estimates");
  }
  for (size_t i = 0; h != NULL && i < h->count; i++) {
    printf("  %12.6g s           %9.4g nm %9.4g nm %9.5g N/m  %.2g, %.2g\n", h->time[i],
           h->film_min[i] * 1e9, h->film_central[i] * 1e9, h->friction[i], h->error_min[i],
           h->error_central[i]);
  }
}
