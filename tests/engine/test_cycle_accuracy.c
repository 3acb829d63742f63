// Accuracy and cost of a whole cycle with solved films: figures against a run of half the step and
// a hundredth of the tolerance, no allocation inside a Newton step (counted by a malloc of our
// own).
#include "engine/contact/fit.h"
#include "engine/film/film.h"
#include "engine/valve/run/run.h"
#include "engine/valve/sealbench.h"
#include "tests/engine/models.h"
#include "tests/sanitized.h"

#include <glib.h>
#include <math.h>
#include <stdatomic.h>
#include <string.h>

// ---------------------------------------------------------------- allocations

static atomic_size_t allocations;

#if !SB_SANITIZED
// glibc's own, behind the names that the program calls.
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);

void *malloc(size_t size) {
  atomic_fetch_add(&allocations, 1);
  return __libc_malloc(size);
}

void *calloc(size_t count, size_t size) {
  atomic_fetch_add(&allocations, 1);
  return __libc_calloc(count, size);
}

void *realloc(void *old, size_t size) {
  atomic_fetch_add(&allocations, 1);
  return __libc_realloc(old, size);
}
#endif

typedef struct {
  size_t polls, before, inside;
} Watch;

// Called before every Newton step.
static bool watch(void *data) {
  Watch *w = data;
  size_t now = atomic_load(&allocations);
  w->inside += w->polls > 0 ? now - w->before : 0;
  w->before = now;
  w->polls++;
  return false;
}

static void test_allocations(void) {
  if (SB_SANITIZED) {
    g_test_skip("a sanitizer has its own malloc");
    return;
  }
  SbFilmSolver *solver = NULL;
  SbFilm *film = g_new0(SbFilm, 1);
  size_t counted = atomic_load(&allocations);
  g_assert_cmpint(sb_film_solver_create(&solver, NULL), ==, SB_OK);
  g_assert_cmpuint(atomic_load(&allocations), >, counted); // the counter counts
  // Flooded, pressurised at the outlet, with a cavity, starved.
  static const double cases[][3] = {{0, 0, 0}, {0.3, 0.8, 0}, {0, 0.02, 0}, {0, 0, 1e-9}};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    SbFilmProblem problem;
    sb_film_problem_init(&problem);
    problem.load = 850.2;
    problem.speed = 0.01;
    problem.radius = 0.805e-3;
    problem.modulus = 6.5725e6;
    problem.viscosity = 0.211e-3;
    double hertz =
        0.25 * problem.modulus * sqrt(8 * problem.load / (problem.modulus * problem.radius) / G_PI);
    problem.pressure_left = cases[i][0] * hertz;
    problem.pressure_right = cases[i][1] * hertz;
    problem.inlet_film = cases[i][2];
    Watch w = {0};
    problem.cancelled = watch;
    problem.cancelled_data = &w;
    sb_film_solver_forget(solver);
    size_t before = atomic_load(&allocations);
    g_assert_cmpint(sb_film_solve(film, &problem, solver, NULL), ==, SB_OK);
    g_assert_cmpuint(atomic_load(&allocations) - before, ==, 0); // not in the solve either
    g_assert_cmpuint(w.polls, >, 5);
    g_assert_cmpuint(w.inside, ==, 0);
  }
  sb_film_solver_destroy(solver);
  g_free(film);
}

// ---------------------------------------------------------------- whole cycles

static SbRun *run_cycle(int fit, double frames, double tolerance, unsigned views) {
  const bool ring = fit == SB_FIT_RING; // held and rubbed so that it slides
  const Setting settings[] = {{SB_P_MODELS_FIT, fit},
                              {ring ? SB_P_GLAND_FLOOR_FRICTION : -1, 0.3},
                              {ring ? SB_P_GLAND_WALL_FRICTION : -1, 0.1},
                              {ring ? SB_P_FRICTION_SHEAR_STRENGTH : -1, 2e6},
                              {SB_P_MODELS_FILM, SB_FILM_REYNOLDS},
                              {SB_P_OUTPUT_FRAMES, frames},
                              {SB_P_OUTPUT_TOLERANCE, tolerance},
                              {SB_P_OUTPUT_VIEWS, views}};
  SbModel model;
  compile(&model, settings, G_N_ELEMENTS(settings));
  return run_of(&model, SB_OK, NULL);
}

static void within(const char *what, double got, double want, double relative) {
  if (!(fabs(got - want) <= relative * fabs(want))) {
    g_test_message("%s: %.8g against %.8g", what, got, want);
    g_test_fail();
  }
}

static void compare(const SbSummary *coarse, const SbSummary *fine, double bound, double film) {
  within("peak force", coarse->force_peak, fine->force_peak, bound);
  within("break-away force", coarse->force_breakaway, fine->force_breakaway, bound);
  within("least return force", coarse->force_return_min, fine->force_return_min, bound);
  within("loop", coarse->energy.loop, fine->energy.loop, bound);
  // What goes out less what comes back: each is known as well as its film.
  const double carried = fine->seal[SB_OUTER].leakage_per_stroke;
  within("leakage", coarse->leakage_per_cycle + carried, fine->leakage_per_cycle + carried, film);
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    within(sb_stage_name((SbStage)i), coarse->stage[i].force, fine->stage[i].force, bound);
  }
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const SbSealState *a = &coarse->seal[i];
    const SbSealState *b = &fine->seal[i];
    within("minimum film", a->film_min, b->film_min, film);
    within("central film", a->film_central, b->film_central, film);
    within("viscous friction", a->friction_viscous, b->friction_viscous, film);
    within("boundary friction", a->friction_boundary, b->friction_boundary, bound);
    within("peak pressure", a->pressure_peak, b->pressure_peak, bound);
  }
}

static void test_half_step(void) {
  SbRun *coarse = run_cycle(SB_FIT_KARASZKIEWICZ, 400, 1e-3, SB_VIEW_PROFILES);
  SbRun *fine = run_cycle(SB_FIT_KARASZKIEWICZ, 800, 1e-5, SB_VIEW_PROFILES);
  compare(sb_run_summary(coarse), sb_run_summary(fine), 1e-3, 1e-3);
  sb_run_destroy(coarse);
  sb_run_destroy(fine);
}

// With solved rings and the film on their own surfaces: within three times the reported error
// estimates, which is what an honest estimate means.
// The pressed ring's finest mesh is in both; the other's differ.
static void test_half_step_rings(void) {
  SbRun *coarse = run_cycle(SB_FIT_RING, 400, 1e-3, SB_VIEW_PROFILES);
  SbRun *fine = run_cycle(SB_FIT_RING, 800, 1e-4, SB_VIEW_PROFILES);
  const SbSummary *told = sb_run_summary(coarse);
  g_test_message("400 frames with rings and films: %.1f s, force %.2g, film %.2g", told->wall_s,
                 told->error_force, told->error_film);
  g_assert_cmpfloat(told->error_force, <, 0.02);
  g_assert_cmpfloat(told->error_film, <, 0.08);
  compare(told, sb_run_summary(fine), 3 * told->error_force, 3 * told->error_film);
  sb_run_destroy(coarse);
  sb_run_destroy(fine);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/cycle-accuracy/allocations", test_allocations);
  g_test_add_func("/cycle-accuracy/half-step", test_half_step);
  if (g_test_slow()) {
    g_test_add_func("/cycle-accuracy/half-step-rings", test_half_step_rings);
  }
  return g_test_run();
}
