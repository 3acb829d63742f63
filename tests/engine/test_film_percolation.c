// Films of a contact whose channels close, against the reference page's independent finite volumes:
// its tables B1 and B2 (line contact over speed and roughness) and B3 (the rings' loads and
// widths), both ends of the distribution of the roughness, and other thresholds.
//
// The page's grid has an error, which the column "now" (no flow factor) shows against this solver.
#include "engine/film/film.h"
#include "tests/engine/films.h"

#include <glib.h>
#include <math.h>
#include <string.h>

static SbFilmSolver *solver;

static double friction(const SbFilm *film) {
  return film->friction_couette + film->friction_poiseuille + film->friction_cavity +
         film->friction_boundary;
}

// Line contact of the page. `width`: of Hertz's contact [m]; 0: the page's radius.
static SbFilm solve(double load, double width, double sigma, double speed, double threshold,
                    double split) {
  SbFilmProblem problem;
  SbReport report;
  SbFilm film;
  sb_film_problem_init(&problem);
  problem.load = load;
  problem.modulus = 6.5725154e6;
  problem.radius = width > 0 ? M_PI * problem.modulus * width * width / (32 * load) : 0.805e-3;
  problem.viscosity = 0.211e-3;
  problem.speed = speed;
  problem.surface = SB_ROUGH_PERSSON;
  problem.gt_product = 0.1289;
  problem.sigma = sigma;
  problem.sigma_over_beta = 0.1;
  problem.shear_strength = 0.388e6;
  problem.percolation_threshold = threshold;
  problem.roughness_split = split;
  SbStatus status = sb_film_solve(&film, &problem, solver, &report);
  g_test_message("w %g N/m, sigma %g m, %g m/s, A* %g, s %g: F %.5g N/m, A %.4g, u %.4g nm, "
                 "%d iterations, %s",
                 load, sigma, speed, threshold, split, friction(&film), film.real_area_share,
                 1e9 * film.film_central, film.solver.newton_iterations, report.text);
  g_assert_cmpint(status, ==, SB_OK);
  g_assert_cmpfloat(film.solver.error_film_min, <, 2e-3);
  // The film's own flow factors need no warning that they are missing.
  for (size_t i = 0; i < film.warnings.count; i++) {
    g_assert_true(threshold == 0 || strcmp(film.warnings.item[i].code, "film-flow-factors") != 0);
  }
  return film;
}

static void test_speeds(void) {
  static const double sigma[] = {1e-6, 0.3e-6, 0.1e-6, 0.03e-6};
  static const struct {
    double speed;
    double area_now[4], area[4], content[4]; // middle; [nm]
    double friction_now[4], friction[4];     // [N/m]
  } rows[] = {
      {1,
       {0.378, 0.188, 0.049, 0},
       {0.212, 0.120, 0.037, 0},
       {360, 189, 125, 108},
       {164.3, 82.4, 23.2, 2.4},
       {92.6, 53.1, 17.6, 2.3}},
      {0.01,
       {0.722, 0.562, 0.396, 0.218},
       {0.354, 0.308, 0.230, 0.139},
       {164, 63.1, 32.5, 16.8},
       {310.3, 242.2, 170.9, 94.2},
       {154.0, 133.4, 99.5, 60.3}},
      {3.333e-4,
       {0.875, 0.775, 0.646, 0.473},
       {0.402, 0.370, 0.335, 0.274},
       {126, 45.0, 18.1, 7.6},
       {374.1, 331.9, 277.4, 204.0},
       {174.6, 160.4, 145.0, 118.4}},
      {1e-5,
       {0.954, 0.907, 0.834, 0.714},
       {0.416, 0.411, 0.389, 0.353},
       {117, 36.1, 13.6, 4.9},
       {406.1, 386.6, 356.5, 306.2},
       {180.9, 177.9, 168.1, 152.6}},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    for (int k = 0; k < 4; k++) {
      const SbFilm now = solve(997.7344, 0, sigma[k], rows[i].speed, 0, 0);
      const SbFilm film = solve(997.7344, 0, sigma[k], rows[i].speed, 0.42, 0);
      const double grid = fabs(rows[i].friction_now[k] / friction(&now) - 1);
      close_to("friction", friction(&film), rows[i].friction[k], 0.02 + grid);
      close_to("content", 1e9 * film.film_central, rows[i].content[k], 0.05);
      if (rows[i].area[k] > 0) {
        const double area_grid = fabs(rows[i].area_now[k] / now.real_area_share - 1);
        close_to("real area", film.real_area_share, rows[i].area[k], 0.02 + area_grid);
      }
    }
  }
}

// In-stroke and return of the outer ring, and the inner ring, at 0.333 mm/s: friction over pi 6 mm.
static void test_rings(void) {
  static const struct {
    double load, width, drained, trapped;
  } rings[] = {{997.7344, 0.807e-3, 5.834, 2.431},
               {437.9, 0.666e-3, 4.660, 1.965},
               {547.8, 0.625e-3, 4.462, 1.872}};
  for (size_t i = 0; i < G_N_ELEMENTS(rings); i++) {
    const double around = M_PI * 6e-3;
    const SbFilm trapped = solve(rings[i].load, rings[i].width, 1e-6, 3.333e-4, 0.42, 0);
    const SbFilm drained = solve(rings[i].load, rings[i].width, 1e-6, 0, 0.42, 0);
    close_to("trapped", around * friction(&trapped), rings[i].trapped, 0.02);
    close_to("drained", around * friction(&drained), rings[i].drained, 0.02);
  }
}

static void test_choices(void) {
  // The rough wall takes its pockets along: content 132 and 409 nm, friction 2 and 10 % lower.
  close_to("s = 1", solve(997.7344, 0, 1e-6, 3.333e-4, 0.42, 1).film_central, 132e-9, 0.05);
  close_to("s = 1, fast", solve(997.7344, 0, 1e-6, 1, 0.42, 1).film_central, 409e-9, 0.05);
  // Thresholds: content [nm] and friction [N/m].
  static const double at[][3] = {{0.3, 222, 129.8}, {0.35, 176, 148.4}, {0.5, 89, 202.1}};
  for (size_t i = 0; i < G_N_ELEMENTS(at); i++) {
    const SbFilm film = solve(997.7344, 0, 1e-6, 3.333e-4, at[i][0], 0);
    close_to("threshold's content", film.film_central, 1e-9 * at[i][1], 0.05);
    close_to("threshold's friction", friction(&film), at[i][2], 0.025);
  }
}

// At this speed a coarse mesh has a false film, whose cavity fills again; it is not the result.
static void test_false_start(void) {
  const SbFilm film = solve(997.7344, 0, 1e-6, 0.000624986, 0.42, 0);
  const SbFilm near = solve(997.7344, 0, 1e-6, 0.000624886, 0.42, 0);
  close_to("content", film.film_central, near.film_central, 1e-4);
}

// A surface a thousandth as rough as the film is thick has the smooth film.
static void test_smooth(void) {
  const SbFilm rough = solve(997.7344, 0, 4e-10, 10, 0.42, 0);
  const SbFilm smooth = solve(997.7344, 0, 4e-13, 10, 0, 0);
  close_to("smooth film", rough.film_central, smooth.film_central, 1e-4);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_assert_cmpint(sb_film_solver_create(&solver, NULL), ==, SB_OK);
  g_test_add_func("/film/percolation/speeds", test_speeds);
  g_test_add_func("/film/percolation/rings", test_rings);
  g_test_add_func("/film/percolation/choices", test_choices);
  g_test_add_func("/film/percolation/false-start", test_false_start);
  g_test_add_func("/film/percolation/smooth", test_smooth);
  int code = g_test_run();
  sb_film_solver_destroy(solver);
  return code;
}
