// sealbench bench: error against time for every solver.
//
// Films are measured against reference/ehl's independent figures of the least film (hp collocation,
// checked by finite volumes, better than 1e-6); fitments and the cycle against their own finest
// solution, which each row names. Closed forms are timed only.
#include "app/cli/cli.h"
#include "app/cli/timing.h"
#include "app/document/atomic.h"
#include "app/export/json.h"

#include "engine/elastic/fit.h"
#include "engine/film/film.h"
#include "engine/surface/greenwood_tripp.h"

#include <errno.h>
#include <math.h>
#include <string.h>

typedef struct {
  char solver[32], name[64];
  const char *reference;
  size_t unknowns, iterations;
  double wall_s, error, error_estimate, order; // NaN: does not apply
} Row;

typedef struct {
  GArray *rows;
  bool quick;
  SbStatus worst;
} Bench;

static const double tolerances[] = {1e-2, 1e-3, 1e-4, 1e-6};

static int tolerance_count(const Bench *bench) {
  return bench->quick ? 2 : (int)G_N_ELEMENTS(tolerances);
}

static void add(Bench *bench, const Row *row) {
  Row kept = *row;
  Row *last = bench->rows->len > 0 ? &g_array_index(bench->rows, Row, bench->rows->len - 1) : NULL;
  kept.order = NAN;
  // Observed order in unknowns, between two rows of one series.
  bool series = last != NULL && strcmp(last->solver, row->solver) == 0 &&
                strncmp(last->name, row->name, strcspn(row->name, ",")) == 0;
  if (series && row->unknowns > last->unknowns && last->error > row->error && row->error > 0) {
    kept.order =
        log(last->error / row->error) / log((double)row->unknowns / (double)last->unknowns);
  }
  g_array_append_val(bench->rows, kept);
}

static void note(Bench *bench, const char *solver, SbStatus status) {
  if (status != SB_OK && !sb_cli_interrupted(NULL)) {
    sb_cli_fail("%s: %s", solver, sb_status_text(status));
    bench->worst = status;
  }
}

// ---- Film ----

typedef struct {
  SbFilm *film;
  SbFilmProblem problem;
} FilmJob;

static SbStatus solve_film(void *data, double *wall_s) {
  FilmJob *job = data;
  SbStatus status = sb_film_solve(job->film, &job->problem, NULL, NULL);
  *wall_s = job->film->solver.wall_s;
  return status;
}

// A contact of the thesis' ring with Moes' M: U = (W/M)^2/2, at W = 1e-3 so that the speeds stay
// below 30 m/s.
static void film_problem(SbFilmProblem *out, double M) {
  sb_film_problem_init(out);
  const double W = 1e-3;
  out->radius = 0.805e-3;
  out->modulus = 6.5725e6;
  out->viscosity = 0.211e-3;
  out->load = W * out->modulus * out->radius;
  double U = W / M * (W / M) / 2;
  out->speed = 2 * U * out->modulus * out->radius / out->viscosity;
}

static void bench_film(Bench *bench) {
  // M, least film over R sqrt(2 U).
  static const struct {
    double M, H;
  } references[] = {{1, 3.06313643},    {5, 1.59060139},     {20, 1.12468687},
                    {100, 0.796100592}, {1000, 0.498582133}, {10000, 0.314215466}};
  FilmJob job = {.film = g_new0(SbFilm, 1)};
  for (size_t i = bench->quick ? 4 : 0; i < G_N_ELEMENTS(references); i++) {
    for (int k = 0; k < tolerance_count(bench) && !sb_cli_interrupted(NULL); k++) {
      film_problem(&job.problem, references[i].M);
      job.problem.tolerance = tolerances[k];
      Row row = {.solver = "film-reynolds", .reference = "independent hp collocation"};
      note(bench, row.solver, sb_timing_median(&row.wall_s, solve_film, &job));
      double M = references[i].M;
      double exact = references[i].H * job.problem.radius * job.film->moes_W / M;
      snprintf(row.name, sizeof row.name, "M = %g, tolerance %g", M, tolerances[k]);
      row.unknowns = job.film->solver.unknowns;
      row.iterations = (size_t)MAX(job.film->solver.newton_iterations, 0);
      row.error = fabs(job.film->film_min / exact - 1);
      row.error_estimate = job.film->solver.error_film_min;
      add(bench, &row);
    }
  }
  static const SbFilmModel laws[] = {SB_FILM_KARASZKIEWICZ, SB_FILM_THESIS, SB_FILM_ASYMPTOTIC};
  for (size_t i = 0; i < G_N_ELEMENTS(laws); i++) {
    film_problem(&job.problem, 10000);
    job.problem.model = laws[i];
    Row row = {.reference = "independent hp collocation; the law's own error",
               .error_estimate = NAN};
    snprintf(row.solver, sizeof row.solver, "film-%s", sb_film_model_name(laws[i]));
    snprintf(row.name, sizeof row.name, "M = 10000");
    note(bench, row.solver, sb_timing_median(&row.wall_s, solve_film, &job));
    double exact = 0.314215466 * job.problem.radius * job.film->moes_W / 10000;
    row.error = fabs(job.film->film_min / exact - 1);
    add(bench, &row);
  }
  g_free(job.film);
}

// ---- Fitment ----

typedef struct {
  SbFit *fit;
  SbFitProblem problem;
  SbReport report;
} FitJob;

static SbStatus solve_fit(void *data, double *wall_s) {
  FitJob *job = data;
  SbStatus status = sb_fit_solve(job->fit, &job->problem, &job->report);
  *wall_s = job->fit->solver.wall_s;
  return status;
}

static void fit_problem(SbFitProblem *out, SbFitModel model, double pressure) {
  SbParams params;
  SbModel valve;
  sb_params_init(&params);
  sb_model_compile(&valve, &params, NULL);
  const SbSealModel *ring = &valve.seal[SB_OUTER];
  *out = (SbFitProblem){.model = model,
                        .section_diameter = ring->section_diameter,
                        .inner_diameter = ring->inner_diameter,
                        .modulus = ring->modulus,
                        .poisson_ratio = ring->poisson_ratio,
                        .housing_modulus = valve.housing_modulus,
                        .housing_poisson = valve.housing_poisson_ratio,
                        .radial_space = valve.radial_space,
                        .bore_diameter = valve.bore_diameter,
                        .gland_width = valve.axial_width,
                        .pressure = pressure};
}

static void bench_fit_model(Bench *bench, SbFitModel model, double pressure) {
  bool solved = model == SB_FIT_DISC || model == SB_FIT_RING;
  FitJob job = {.fit = g_new0(SbFit, 1)};
  fit_problem(&job.problem, model, pressure);
  // Affordable for the ring, within reach of the disc.
  const double finest = model == SB_FIT_RING ? 1e-4 : 1e-5;
  double exact = NAN;
  double unused = 0;
  if (solved) {
    job.problem.tolerance = finest;
    SbStatus status = solve_fit(&job, &unused);
    if (status == SB_ERROR_INPUT) {
      // Not in this build.
      g_free(job.fit);
      return;
    }
    note(bench, sb_fit_model_name(model), status);
    exact = job.fit->load;
  }
  int count = solved ? tolerance_count(bench) : 1;
  for (int k = 0; k < count && !sb_cli_interrupted(NULL); k++) {
    if (solved && tolerances[k] <= 3 * finest) {
      continue;
    }
    job.problem.tolerance = solved ? tolerances[k] : 1e-3;
    Row row = {.reference = solved ? "own finest solution, load" : "none: timed only"};
    snprintf(row.solver, sizeof row.solver, "fit-%s", sb_fit_model_name(model));
    if (solved) {
      snprintf(row.name, sizeof row.name, "p = %g MPa, tolerance %g", pressure / 1e6,
               tolerances[k]);
    } else {
      snprintf(row.name, sizeof row.name, "p = %g MPa", pressure / 1e6);
    }
    note(bench, row.solver, sb_timing_median(&row.wall_s, solve_fit, &job));
    row.unknowns = job.fit->solver.unknowns;
    row.iterations = job.fit->solver.newton_iterations;
    row.error = solved ? fabs(job.fit->load / exact - 1) : NAN;
    row.error_estimate = solved ? job.fit->solver.error_estimate.load : NAN;
    add(bench, &row);
  }
  g_free(job.fit);
}

static void bench_fit(Bench *bench) {
  for (int model = 0; model < SB_FIT_MODEL_COUNT; model++) {
    bench_fit_model(bench, (SbFitModel)model, 0);
    bench_fit_model(bench, (SbFitModel)model, 0.55e6);
  }
}

// ---- Cycle and asperities ----

typedef struct {
  const SbModel *model;
  double loss, estimate;
  size_t steps;
} CycleJob;

static SbStatus solve_cycle(void *data, double *wall_s) {
  CycleJob *job = data;
  SbPlan plan;
  SbRun *run = NULL;
  sb_plan_make(&plan, job->model);
  SbStatus status = sb_run_create(&run, job->model, &plan, NULL);
  if (status == SB_OK) {
    status = sb_run_execute(run, NULL, NULL);
    const SbSummary *summary = sb_run_summary(run);
    *wall_s = summary->wall_s;
    job->loss = summary->energy.loop;
    job->estimate = summary->error_energy;
    job->steps = summary->steps;
  }
  sb_run_destroy(run);
  return status;
}

static void bench_cycle(Bench *bench) {
  SbParams params;
  SbModel model;
  sb_params_init(&params);
  CycleJob job = {.model = &model};
  double exact = NAN;
  static const int frames[] = {20000, 400, 800, 1600};
  for (size_t i = 0; i < G_N_ELEMENTS(frames) && !sb_cli_interrupted(NULL); i++) {
    sb_params_set(&params, SB_P_OUTPUT_FRAMES, frames[i], NULL);
    sb_model_compile(&model, &params, NULL);
    Row row = {.solver = "cycle-quasi-static", .reference = "20000 frames, energy of the loop"};
    snprintf(row.name, sizeof row.name, "closed forms, %d frames", frames[i]);
    note(bench, row.solver, sb_timing_median(&row.wall_s, solve_cycle, &job));
    if (i == 0) {
      exact = job.loss;
      continue;
    }
    row.unknowns = job.steps;
    row.error = fabs(job.loss / exact - 1);
    row.error_estimate = job.estimate;
    add(bench, &row);
  }
}

static void bench_asperity(Bench *bench) {
  // F2(0) = 1/2 exactly.
  Row row = {
      .solver = "asperity", .name = "lambda = 0", .reference = "exact", .error_estimate = NAN};
  SbGtIntegrals integrals;
  enum { REPEATS = 1000 };
  gint64 start = g_get_monotonic_time();
  for (int i = 0; i < REPEATS; i++) {
    note(bench, row.solver, sb_gt_integrals(&integrals, 0, NULL));
  }
  row.wall_s = (double)(g_get_monotonic_time() - start) / G_USEC_PER_SEC / REPEATS;
  row.error = fabs(integrals.F2 / 0.5 - 1);
  add(bench, &row);
}

// ---- Output ----

static char *to_json(const GArray *rows) {
  SbJson json;
  sb_json_init(&json);
  sb_json_object(&json, NULL);
  sb_json_array(&json, "cases");
  for (guint i = 0; i < rows->len; i++) {
    const Row *row = &g_array_index(rows, Row, i);
    sb_json_object(&json, NULL);
    sb_json_string(&json, "solver", row->solver);
    sb_json_string(&json, "case", row->name);
    sb_json_string(&json, "reference", row->reference);
    sb_json_count(&json, "unknowns", row->unknowns);
    sb_json_count(&json, "iterations", row->iterations);
    sb_json_number(&json, "wall_s", row->wall_s);
    sb_json_number(&json, "error", row->error);
    sb_json_number(&json, "error_estimate", row->error_estimate);
    sb_json_number(&json, "order", row->order);
    sb_json_object_end(&json);
  }
  sb_json_array_end(&json);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}

static void print_table(const GArray *rows) {
  printf("%-22s %-32s %9s %6s %11s %10s %10s %6s\n", "solver", "case", "unknowns", "iter.", "time",
         "error", "estimate", "order");
  for (guint i = 0; i < rows->len; i++) {
    const Row *row = &g_array_index(rows, Row, i);
    char error[SB_NUMBER_SIZE];
    char estimate[SB_NUMBER_SIZE];
    char order[SB_NUMBER_SIZE];
    printf("%-22s %-32s %9zu %6zu %8.3f ms %10s %10s %6s\n", row->solver, row->name, row->unknowns,
           row->iterations, row->wall_s * 1e3,
           isnan(row->error) ? "-" : sb_number_round(error, row->error, 2),
           isnan(row->error_estimate) ? "-" : sb_number_round(estimate, row->error_estimate, 2),
           isnan(row->order) ? "-" : sb_number_round(order, row->order, 2));
  }
}

int sb_command_bench(int argc, char **argv) {
  char *folder = NULL;
  char *target = NULL;
  gboolean quick = FALSE;
  const GOptionEntry entries[] = {
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &folder, "Folder for bench.json", "DIR"},
      {"quick", 0, 0, G_OPTION_ARG_NONE, &quick, "Fewer cases", NULL},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &target, "JSON to a file or -", "FILE|-"},
      {0},
  };
  int code = SB_EXIT_INPUT;
  if (sb_cli_parse(&argc, &argv, entries, 0, 0, SB_TIMING_NOTE)) {
    Bench bench = {g_array_new(FALSE, TRUE, sizeof(Row)), quick, SB_OK};
    sb_cli_catch_interrupts();
    bench_asperity(&bench);
    bench_film(&bench);
    bench_fit(&bench);
    bench_cycle(&bench);
    code = sb_cli_interrupted(NULL)                ? SB_EXIT_INTERRUPTED
           : bench.worst == SB_ERROR_NOT_CONVERGED ? SB_EXIT_NOT_CONVERGED
           : bench.worst != SB_OK                  ? SB_EXIT_INPUT
                                                   : SB_EXIT_DONE;
    char *json = to_json(bench.rows);
    int written = SB_EXIT_DONE;
    if (folder != NULL && g_mkdir_with_parents(folder, 0777) != 0) {
      sb_cli_fail("%s: %s", folder, g_strerror(errno));
      written = SB_EXIT_IO;
    } else if (folder != NULL) {
      char *path = g_build_filename(folder, "bench.json", NULL);
      written = sb_cli_emit(json, path);
      g_free(path);
    }
    if (written == SB_EXIT_DONE && target != NULL) {
      written = sb_cli_emit(json, target);
    } else if (written == SB_EXIT_DONE) {
      print_table(bench.rows);
    }
    code = written != SB_EXIT_DONE ? written : code;
    g_free(json);
    g_array_unref(bench.rows);
  }
  g_free(folder);
  g_free(target);
  return code;
}
