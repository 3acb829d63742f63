// Friction by the content of fluid of a contact, against the reference page's independent programs:
// its tables B4 (friction over content) and C3 (steps, reversal, slips and dwell, by the full
// equations on cells, its first-order fronts extrapolated).
#include "engine/film/content.h"
#include "tests/engine/films.h"

#include <glib.h>
#include <math.h>

static const double slow = 3.333e-4, fast = 0.1; // [m/s]

// The page's contact: of a `load` [N/m], as wide as Hertz's contact of `width` [m]; 0: its radius.
static SbContent *contact(double load, double width, double speed, double scale) {
  SbContentProblem problem = {.speed_scale = scale};
  SbFilmProblem *film = &problem.film;
  sb_film_problem_init(film);
  film->load = load;
  film->modulus = 6.5725154e6;
  film->radius = width > 0 ? M_PI * film->modulus * width * width / (32 * load) : 0.805e-3;
  film->viscosity = 0.211e-3;
  film->speed = speed;
  film->surface = SB_ROUGH_PERSSON;
  film->gt_product = 0.1289;
  film->sigma = 1e-6;
  film->sigma_over_beta = 0.1;
  film->shear_strength = 0.388e6;
  film->percolation_threshold = 0.42;
  SbContent *content;
  SbReport report = {0};
  const SbStatus status = sb_content_create(&content, &problem, &report);
  g_test_message("%s", report.text);
  g_assert_cmpint(status, ==, SB_OK);
  return content;
}

static void step(SbContent *content, double dt, double speed) {
  SbReport report;
  g_assert_cmpint(sb_content_step(content, dt, speed, &report), ==, SB_OK);
}

// Keeps the speed until each time; friction [N/m] then.
typedef struct {
  double time, friction, tolerance;
} Stage;

static void keep(SbContent *content, double speed, const Stage *stage, size_t count) {
  step(content, 1e-9, speed);
  double now = 1e-9;
  for (size_t i = 0; i < count; i++) {
    step(content, stage[i].time - now, speed);
    now = stage[i].time;
    const SbContentResult result = sb_content_result(content);
    g_test_message("%g s: %g N/m, content %g nm", now, result.friction, 1e9 * result.mean);
    close_to("friction", fabs(result.friction), stage[i].friction, stage[i].tolerance);
    g_assert_cmpfloat(result.error_friction, <, 5e-3);
    // Between trapped and drained fluid, and of the sign of the speed.
    g_assert_cmpfloat(result.friction * (speed < 0 ? -1 : 1), >, 0);
    g_assert_cmpfloat(fabs(result.friction), <, 424);
  }
}

static void test_contents(void) {
  static const double share[] = {1.7, 1.3, 1, 0.75, 0.5, 0.25, 0.1, 0.05, 0.02, 0};
  static const struct {
    double load, width, friction[G_N_ELEMENTS(share)];
  } rows[] = {
      {997.7344, 0.807e-3, {1.90, 2.19, 2.48, 2.79, 3.20, 3.86, 4.56, 4.96, 5.32, 5.83}},
      {437.9, 0.666e-3, {1.57, 1.81, 2.04, 2.29, 2.63, 3.16, 3.72, 4.03, 4.31, 4.66}},
      {547.8, 0.625e-3, {1.47, 1.70, 1.92, 2.15, 2.48, 2.98, 3.51, 3.82, 4.09, 4.46}},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    SbContent *content = contact(rows[i].load, rows[i].width, slow, slow);
    close_to("u*", sb_content_closed(content), 0.1146e-6, 2e-3);
    const double trapped = sb_content_result(content).friction;
    for (size_t k = 0; k < G_N_ELEMENTS(share); k++) {
      const double u = share[k] * sb_content_closed(content);
      const double friction = sb_content_uniform(content, u).friction;
      close_to("friction", M_PI * 6e-3 * friction, rows[i].friction[k], 5e-3);
      // Less fluid than steady sliding has: between trapped and drained.
      g_assert_true(share[k] > 1 || friction >= trapped * (1 - 1e-9));
    }
    sb_content_destroy(content);
  }
}

static void test_steps(void) {
  static const Stage up[] = {{0.99e-3, 172.3, 0.01},
                             {9.1e-3, 157.1, 0.01},
                             {21.6e-3, 136, 0.01},
                             {40e-3, 133.5, 0.01},
                             {140e-3, 133.5, 0.005}};
  static const Stage back[] = {{3.3e-3, 134.3, 0.01},
                               {84e-3, 139, 0.01},
                               {1.03, 151, 0.04},
                               {3.58, 162.3, 0.04},
                               {13.4, 174.6, 0.005}};
  SbContent *content = contact(997.7344, 0, slow, fast);
  keep(content, fast, up, G_N_ELEMENTS(up));
  keep(content, slow, back, G_N_ELEMENTS(back));
  sb_content_destroy(content);
}

// A reversal and then a dwell, at either speed.
static void test_reversal_and_dwell(void) {
  static const Stage slowly[] = {{2.7, 174.68, 0.005}, {60, 174.46, 0.005}};
  static const Stage quickly[] = {{8.4e-3, 133.6, 0.009}, {0.2, 132.8, 0.009}};
  static const Stage after_slow[] = {{1.2, 174.8, 0.02}, {44, 176.9, 0.02}, {640, 179.9, 0.02}};
  static const Stage after_fast[] = {{5.9e-3, 134, 0.005}, {55e-3, 137.3, 0.01},
                                     {0.8, 149.2, 0.025},  {12, 165.7, 0.03},
                                     {23, 169.5, 0.025},   {560, 179.6, 0.02}};
  SbContent *content = contact(997.7344, 0, slow, slow);
  keep(content, -slow, slowly, G_N_ELEMENTS(slowly));
  keep(content, 0, after_slow, G_N_ELEMENTS(after_slow));
  sb_content_destroy(content);
  content = contact(997.7344, 0, fast, fast);
  keep(content, -fast, quickly, G_N_ELEMENTS(quickly));
  keep(content, 0, after_fast, G_N_ELEMENTS(after_fast));
  sb_content_destroy(content);
}

// A slip of 0.114 mm within 0.617 ms changes the friction of a wet contact by less than 2 %, of a
// drained one by less than 3 %.
static void test_slip(void) {
  enum { STEPS = 200 };
  const double largest = 0.29, time = 0.617e-3;
  for (int dry = 0; dry < 2; dry++) {
    SbContent *content = contact(997.7344, 0, dry ? 0 : slow, largest);
    if (!dry) {
      step(content, 1e-9, 0);
      step(content, 1, 0);
    }
    const double before = sb_content_result(content).friction;
    for (int i = 1; i <= STEPS; i++) {
      step(content, time / STEPS, i < STEPS ? largest * sin(M_PI * i / STEPS) : 1e-9);
    }
    const double after = sb_content_result(content).friction;
    close_to("after the slip", after, dry ? 412.1 : 171.9, 0.005);
    close_to("before the slip", before, dry ? 423.8 : 174.7, 0.003);
    sb_content_destroy(content);
  }
}

// A contact that stays at rest needs no steady film.
static void test_rest(void) {
  SbContent *content = contact(997.7344, 0, 0, 0);
  step(content, 10, 0);
  const SbContentResult rest = sb_content_result(content);
  close_to("friction at rest", rest.friction, 423.8, 0.003);
  g_assert_cmpfloat(rest.mean, ==, 0);
  const SbContentResult half = sb_content_uniform(content, 0.5 * sb_content_closed(content));
  g_assert_true(half.friction < rest.friction && isnan(half.error_friction));
  sb_content_destroy(content);
}

static void test_start(void) {
  static const Stage start[] = {{0.42e-3 / 3.333e-4, 381, 0.05},
                                {0.91e-3 / 3.333e-4, 317, 0.05},
                                {1.53e-3 / 3.333e-4, 230, 0.1},
                                {4.46e-3 / 3.333e-4, 174.5, 0.005}};
  SbContent *content = contact(997.7344, 0, 0, slow);
  keep(content, slow, start, G_N_ELEMENTS(start));
  sb_content_destroy(content);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/film/content/friction", test_contents);
  g_test_add_func("/film/content/steps", test_steps);
  g_test_add_func("/film/content/reversal-and-dwell", test_reversal_and_dwell);
  g_test_add_func("/film/content/slip", test_slip);
  g_test_add_func("/film/content/rest", test_rest);
  g_test_add_func("/film/content/start", test_start);
  return g_test_run();
}
