// Accuracy and cost of a whole cycle with solved films, and the drag of its solved rings: figures
// against a run of half the step and a hundredth of the tolerance, no allocation inside a Newton
// step (counted by a malloc of our own), the section's shear turning over at the reversals.
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
  const Setting settings[] = {{SB_P_MODELS_FIT, fit},
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

static void compare(const SbSummary *coarse, const SbSummary *fine) {
  static const double BOUND = 1e-3;
  within("peak force", coarse->force_peak, fine->force_peak, BOUND);
  within("break-away force", coarse->force_breakaway, fine->force_breakaway, BOUND);
  within("least return force", coarse->force_return_min, fine->force_return_min, BOUND);
  within("loop", coarse->energy.loop, fine->energy.loop, BOUND);
  within("leakage", coarse->leakage_per_cycle, fine->leakage_per_cycle, BOUND);
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    within(sb_stage_name((SbStage)i), coarse->stage[i].force, fine->stage[i].force, BOUND);
  }
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const SbSealState *a = &coarse->seal[i];
    const SbSealState *b = &fine->seal[i];
    within("least film", a->film_min, b->film_min, BOUND);
    within("central film", a->film_central, b->film_central, BOUND);
    within("viscous friction", a->friction_viscous, b->friction_viscous, BOUND);
    within("boundary friction", a->friction_boundary, b->friction_boundary, BOUND);
    within("peak pressure", a->pressure_peak, b->pressure_peak, BOUND);
  }
}

static void test_half_step(void) {
  SbRun *coarse = run_cycle(SB_FIT_KARASZKIEWICZ, 400, 1e-3, SB_VIEW_PROFILES);
  SbRun *fine = run_cycle(SB_FIT_KARASZKIEWICZ, 800, 1e-5, SB_VIEW_PROFILES);
  compare(sb_run_summary(coarse), sb_run_summary(fine));
  sb_run_destroy(coarse);
  sb_run_destroy(fine);
}

// With solved rings and the film on their own surfaces. The pressed ring's finest mesh is in both;
// the other's differ.
static void test_half_step_rings(void) {
  SbRun *coarse = run_cycle(SB_FIT_RING, 400, 1e-3, SB_VIEW_PROFILES);
  SbRun *fine = run_cycle(SB_FIT_RING, 800, 1e-4, SB_VIEW_PROFILES);
  g_test_message("400 frames with rings and films: %.1f s", sb_run_summary(coarse)->wall_s);
  compare(sb_run_summary(coarse), sb_run_summary(fine));
  sb_run_destroy(coarse);
  sb_run_destroy(fine);
}

// ---------------------------------------------------------------- the ring's drag

// Mean axial-radial shear over the section, by its triangles.
static double mean_shear(const SbSealShape *shape) {
  double sum = 0, area = 0;
  for (size_t i = 0; i < shape->triangles; i++) {
    const int *t = &shape->triangle[3 * i];
    const double *a = &shape->place[2 * t[0]], *b = &shape->place[2 * t[1]],
                 *c = &shape->place[2 * t[2]];
    double twice = fabs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
    double value = 0;
    for (int k = 0; k < 3; k++) {
      value += (double)shape->field[SB_FIELD_SHEAR][t[k]] / 3;
    }
    sum += value * twice;
    area += twice;
  }
  return sum / area;
}

// The outer ring's mean shear while the stem slides in and while it slides out: opposite signs, the
// in-stroke again at the next A-B, where the cycle begins anew; and its size is the seal's own
// friction over the contact, carried through the section.
static void test_drag(void) {
  SbRun *run = run_cycle(SB_FIT_RING, 100, 1e-3, SB_VIEW_SECTION);
  const SbSummary *summary = sb_run_summary(run);
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  double in = NAN, out = NAN, rest = NAN, borne[2] = {NAN, NAN};
  for (size_t i = 0; i < count; i++) {
    const SbFrame *f = &frames[i];
    const SbSealShape *shape = sb_run_shape(run, f->seal[SB_OUTER].shape);
    g_assert_nonnull(shape);
    bool moving = f->velocity != 0;
    double time = f->time;
    if (!moving && time <= summary->stage[SB_STAGE_B].time && isnan(rest)) {
      rest = mean_shear(shape);
    } else if (moving && time > summary->stage[SB_STAGE_B].time &&
               time < summary->stage[SB_STAGE_C].time && isnan(in)) {
      in = mean_shear(shape);
      borne[0] = shape->drag / f->seal[SB_OUTER].friction;
    } else if (moving && time > summary->stage[SB_STAGE_E].time) {
      out = mean_shear(shape); // the last
      borne[1] = shape->drag / f->seal[SB_OUTER].friction;
    }
  }
  g_test_message("mean shear at rest %.4g, in %.4g, out %.4g Pa", rest, in, out);
  g_assert_cmpfloat(in * out, <, 0);
  // The drawn ring bears the frame's friction, or a warning says how much of it.
  bool told = false;
  for (size_t i = 0; i < summary->warnings.count; i++) {
    const SbWarning *warning = &summary->warnings.item[i];
    told = told || (strcmp(warning->code, "ring-drag") == 0 && strstr(warning->text, "outer"));
  }
  for (int k = 0; k < 2; k++) {
    g_test_message("the drawn ring bears %.4f of the friction%s", borne[k], told ? ", told" : "");
    g_assert_true(fabs(fabs(borne[k]) - 1) < 0.02 || (told && fabs(borne[k]) < 0.98));
  }
  g_assert_cmpfloat(fabs(in), >, 1e3);
  g_assert_cmpfloat(fabs(out), >, 1e3);
  sb_run_destroy(run);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/cycle-accuracy/allocations", test_allocations);
  g_test_add_func("/cycle-accuracy/half-step", test_half_step);
  if (g_test_slow()) {
    g_test_add_func("/cycle-accuracy/half-step-rings", test_half_step_rings);
    g_test_add_func("/cycle-accuracy/drag", test_drag);
  }
  return g_test_run();
}
