// Every validity warning of the film models and of a run: raised where its limit is passed, absent
// where it is kept. The fitment models' warnings are tested the same way in
// test_elastic_closed_forms.c.
#include "engine/film/film.h"
#include "engine/valve/sealbench.h"
#include "tests/engine/models.h"

#include <glib.h>
#include <math.h>
#include <string.h>

static bool has(const SbWarnings *warnings, const char *code) {
  for (size_t i = 0; i < warnings->count; i++) {
    if (strcmp(warnings->item[i].code, code) == 0) {
      g_assert_cmpuint(strlen(warnings->item[i].text), >, 20);
      return true;
    }
  }
  return false;
}

// One contact inside and one outside the limit of a code.
typedef struct {
  const char *code;
  SbFilmModel model;
  struct {
    double load, speed, modulus, viscosity, left, right, rupture;
  } outside, inside;
} FilmCase;

enum { DRY = 201 };

// A dry pressure (1 - X^2)^1.5 of the given load on |x| < 0.5 mm, for Blok's inverse film.
static void dry_pressure(double *x, double *p, size_t count, double load) {
  double a = 0.5e-3;
  double peak = load / (a * 3 * M_PI / 8);
  for (size_t i = 0; i < count; i++) {
    double X = -1 + 2.0 * (double)i / (double)(count - 1);
    x[i] = a * X;
    p[i] = peak * pow(fmax(1 - X * X, 0), 1.5);
  }
}

static bool film_warns(const FilmCase *c, bool outside) {
  double x[DRY];
  double p[DRY];
  SbFilmProblem problem;
  sb_film_problem_init(&problem);
  problem.model = c->model;
  problem.load = outside ? c->outside.load : c->inside.load;
  problem.speed = outside ? c->outside.speed : c->inside.speed;
  problem.modulus = outside ? c->outside.modulus : c->inside.modulus;
  problem.viscosity = outside ? c->outside.viscosity : c->inside.viscosity;
  problem.pressure_left = outside ? c->outside.left : c->inside.left;
  problem.pressure_right = outside ? c->outside.right : c->inside.right;
  problem.rupture_pressure = outside ? c->outside.rupture : c->inside.rupture;
  problem.radius = 0.805e-3;
  if (c->model == SB_FILM_INVERSE) {
    // "film-dry-load": a table whose own load is a tenth off; "film-dry-coarse": one of few points.
    bool wrong_load = outside && strcmp(c->code, "film-dry-load") == 0;
    bool coarse = outside && strcmp(c->code, "film-dry-coarse") == 0;
    problem.dry_count = coarse ? 9 : DRY;
    dry_pressure(x, p, problem.dry_count, (wrong_load ? 1.1 : 1) * problem.load);
    problem.dry_x = x;
    problem.dry_pressure = p;
  }
  SbFilm *film = g_new0(SbFilm, 1);
  SbReport report = {0};
  SbStatus status = sb_film_solve(film, &problem, NULL, &report);
  if (status != SB_OK) {
    g_error("%s: %s", c->code, report.text);
  }
  bool warned = has(&film->warnings, c->code);
  g_free(film);
  return warned;
}

static void test_films(void) {
  const double E = 6.5725e6;
  const FilmCase cases[] = {
      {"film-law-range", SB_FILM_THESIS, {850, 1e-3, E, 2e-4, 0, 0, 0}, {850, 1, E, 2e-4, 0, 0, 0}},
      {"film-law-error",
       SB_FILM_ASYMPTOTIC,
       {0.1, 1, E, 2e-4, 0, 0, 0},
       {850, 1, E, 2e-4, 0, 0, 0}},
      {"film-law-pressure",
       SB_FILM_THESIS,
       {850, 1, E, 2e-4, 1e5, 0, 0},
       {850, 1, E, 2e-4, 0, 0, 0}},
      {"film-rigid", SB_FILM_RIGID, {850, 1, E, 2e-4, 0, 0, 0}, {1e-3, 1, E, 1, 0, 0, 0}},
      {"film-below-continuum",
       SB_FILM_REYNOLDS,
       {850, 1e-4, E, 2e-4, 0, 0, 0},
       {850, 1, E, 2e-4, 0, 0, 0}},
      {"film-zero-speed", SB_FILM_REYNOLDS, {850, 0, E, 2e-4, 0, 0, 0}, {850, 1, E, 2e-4, 0, 0, 0}},
      {"film-contact-wide",
       SB_FILM_REYNOLDS,
       {850, 1, 1e6, 2e-4, 0, 0, 0},
       {850, 1, E, 2e-4, 0, 0, 0}},
      // 4.895 eta (u/2) R / W is 0.12 and 0.08 of the radius.
      {"film-thick",
       SB_FILM_REYNOLDS,
       {1e-3, 1, 1e8, 4.9e-5, 0, 0, 0},
       {1e-3, 1, 1e8, 3.3e-5, 0, 0, 0}},
      {"film-outlet-vapour",
       SB_FILM_REYNOLDS,
       {850, 1, E, 2e-4, 5e5, 0, 1e5},
       {850, 1, E, 2e-4, 0, 0, 0}},
      {"film-inverse-range",
       SB_FILM_INVERSE,
       {10, 10, E, 1e-2, 0, 0, 0},
       {850, 1e-2, E, 2e-4, 0, 0, 0}},
      {"film-dry-load",
       SB_FILM_INVERSE,
       {850, 1e-2, E, 2e-4, 0, 0, 0},
       {850, 1e-2, E, 2e-4, 0, 0, 0}},
      {"film-dry-coarse",
       SB_FILM_INVERSE,
       {850, 1e-2, E, 2e-4, 0, 0, 0},
       {850, 1e-2, E, 2e-4, 0, 0, 0}},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_test_message("%s", cases[i].code);
    g_assert_true(film_warns(&cases[i], true));
    g_assert_false(film_warns(&cases[i], false));
  }
}

static bool run_warns(const char *code, const Setting *settings, size_t count) {
  SbModel model;
  compile(&model, settings, count);
  SbRun *run = run_of(&model, SB_OK, NULL);
  bool warned = has(&sb_run_summary(run)->warnings, code);
  sb_run_destroy(run);
  return warned;
}

static void test_runs(void) {
  const struct {
    const char *code;
    Setting outside[3];
    Setting inside[3];
  } cases[] = {
      {"no-return",
       {{SB_P_SURFACE_GT_PRODUCT, 0.1676}, {-1, 0}, {-1, 0}},
       {{-1, 0}, {-1, 0}, {-1, 0}}},
      {"no-contact",
       {{SB_P_SEAL_INNER_SECTION_DIAMETER, 1.3e-3}, {-1, 0}, {-1, 0}},
       {{-1, 0}, {-1, 0}, {-1, 0}}},
      {"boundary-regime",
       {{-1, 0}, {-1, 0}, {-1, 0}},
       {{SB_P_SURFACE_SIGMA, 1e-9}, {SB_P_DRIVE_SPEED, 1}, {-1, 0}}},
      {"real-area-large",
       {{SB_P_SURFACE_GT_PRODUCT, 0.3}, {-1, 0}, {-1, 0}},
       {{-1, 0}, {-1, 0}, {-1, 0}}},
      {"persson-shear-strength",
       {{SB_P_MODELS_SURFACE, 1}, {-1, 0}, {-1, 0}},
       {{-1, 0}, {-1, 0}, {-1, 0}}},
      {"static-leak",
       {{SB_P_SURFACE_SIGMA_OVER_BETA, 1},
        {SB_P_SURFACE_GT_PRODUCT, 0.026},
        {SB_P_MODELS_SURFACE, 1}},
       {{SB_P_MODELS_SURFACE, 1}, {-1, 0}, {-1, 0}}},
      {"film-no-net-load",
       {{SB_P_CANISTER_PRESSURE, 2e6}, {SB_P_SEAL_POISSON_RATIO, 0.2}, {SB_P_SEAL_MODULUS, 0.5e6}},
       {{-1, 0}, {-1, 0}, {-1, 0}}},
      {"adhesion-beside",
       {{SB_P_MODELS_ADHESION, 1}, {-1, 0}, {-1, 0}},
       {{SB_P_MODELS_ADHESION, 1},
        {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED},
        {SB_P_SURFACE_SIGMA, 2e-7}}},
      {"film-snap-in", // nearly smooth
       {{SB_P_MODELS_ADHESION, 1},
        {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED},
        {SB_P_SURFACE_SIGMA, 1e-8}},
       {{SB_P_MODELS_ADHESION, 1},
        {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED},
        {SB_P_SURFACE_SIGMA, 2e-7}}},
      {"pressure-ignored",
       {{SB_P_MODELS_FIT, 1}, {-1, 0}, {-1, 0}},
       {{SB_P_MODELS_FIT, 1}, {SB_P_CANISTER_PRESSURE, 0}, {-1, 0}}},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_test_message("%s", cases[i].code);
    g_assert_true(run_warns(cases[i].code, cases[i].outside, 3));
    g_assert_false(run_warns(cases[i].code, cases[i].inside, 3));
  }
}

// Between tight and leaking the user is told that the leak is near.
static void test_static_leak_near(void) {
  bool near = false;
  for (double ratio = 0.1; ratio < 1 && !near; ratio += 0.05) {
    Setting rough[] = {{SB_P_SURFACE_SIGMA_OVER_BETA, ratio},
                       {SB_P_SURFACE_GT_PRODUCT, 0.03},
                       {SB_P_MODELS_SURFACE, 1}};
    near = run_warns("static-leak-near", rough, 3);
  }
  g_assert_true(near);
  g_assert_false(run_warns("static-leak-near", NULL, 0));
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/warnings/films", test_films);
  g_test_add_func("/warnings/runs", test_runs);
  g_test_add_func("/warnings/static-leak-near", test_static_leak_near);
  return g_test_run();
}
