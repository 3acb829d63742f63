// Transient film: steady limits against the spectral solver, squeezing and transport against
// closed forms, balances at every step, order in time, independence of the steps asked for.
#include "engine/film/ehl_transient.h"

#include <glib.h>
#include <math.h>

// The inhaler's seal at Moes' M; steady at the speed that gives it.
static SbFilmTransientProblem seal(double M) {
  SbFilmTransientProblem p = {0};
  sb_film_problem_init(&p.film);
  p.film.radius = 0.805e-3;
  p.film.modulus = 6.5725e6;
  p.film.viscosity = 0.211e-3;
  p.film.load = 850.2;
  const double ER = p.film.modulus * p.film.radius;
  const double W = p.film.load / ER;
  p.film.speed = W * W / (M * M) * ER / p.film.viscosity;
  p.speed_scale = p.film.speed;
  return p;
}

static double half_width(const SbFilmTransientProblem *p) {
  return sqrt(8.0 * p->film.load * p->film.radius / (G_PI * p->film.modulus));
}

// The present pressure and film in SI, and the place of a node.
typedef struct {
  size_t points;
  double x[SB_TRANSIENT_NODES_MAX], pressure[SB_TRANSIENT_NODES_MAX], film[SB_TRANSIENT_NODES_MAX];
} Profile;

static void read_profile(Profile *out, const SbFilmTransient *t) {
  out->points = (size_t)t->nodes;
  for (int i = 0; i < t->nodes; i++) {
    out->x[i] = (t->scale.middle + t->X[i]) * t->scale.half_width;
    out->pressure[i] = t->now.P[i] * t->scale.pressure;
    out->film[i] = t->now.H[i] * t->scale.film;
  }
}

static SbFilmTransient *begin(const SbFilmTransientProblem *p) {
  SbFilmTransient *t = NULL;
  SbReport report = {0};
  SbStatus status = sb_film_transient_create(&t, p, &report);
  g_assert_cmpstr(status == SB_OK ? "" : report.text, ==, "");
  return t;
}

static void step(SbFilmTransient *t, double dt, double speed) {
  SbReport report = {0};
  SbStatus status = sb_film_transient_step(t, dt, speed, &report);
  g_assert_cmpstr(status == SB_OK ? "" : report.text, ==, "");
}

// Films of the finite volumes at constant speed are those of the spectral solver, at every M and
// with pressure at either end.
static void test_steady(void) {
  const double M[] = {30.0, 1000.0, 44000.0, 44000.0, 44000.0};
  SbFilm *steady = g_new(SbFilm, 1);
  for (int i = 0; i < 5; i++) {
    SbFilmTransientProblem p = seal(M[i]);
    p.film.pressure_left = i == 3 ? 0.4e6 : 0.0;
    p.film.pressure_right = i == 4 ? 0.4e6 : 0.0;
    SbFilmTransient *t = begin(&p);
    step(t, 0.5 * half_width(&p) / p.film.speed, p.film.speed);
    const SbFilmTransientResult film = sb_film_transient_result(t);
    g_assert_cmpint(sb_film_solve(steady, &p.film, NULL, NULL), ==, SB_OK);
    const double least = fabs(film.film_min / steady->film_min - 1.0);
    const double central = fabs(film.film_central / steady->film_central - 1.0);
    g_assert_cmpfloat(least, <, 1.5e-3);
    g_assert_cmpfloat(central, <, 5e-4);
    g_assert_cmpfloat(fmax(least, central), <, 3.0 * (film.error_mesh + film.error_time));
    sb_film_transient_destroy(t);
  }
  g_free(steady);
}

// Flow through x from a profile: u h/2 - h^3 p'/(12 eta), by straight lines.
static double profile_flow(const Profile *f, double x, double speed, double viscosity) {
  size_t i = 1;
  while (f->x[i] < x) {
    i++;
  }
  const double s = (x - f->x[i - 1]) / (f->x[i] - f->x[i - 1]);
  const double h = f->film[i - 1] + s * (f->film[i] - f->film[i - 1]);
  const double slope = (f->pressure[i] - f->pressure[i - 1]) / (f->x[i] - f->x[i - 1]);
  return 0.5 * speed * h - h * h * h * slope / (12.0 * viscosity);
}

// Film between two places from a profile.
static double profile_content(const Profile *f, double from, double to) {
  double sum = 0.0;
  for (size_t i = 1; i < f->points; i++) {
    const double a = fmax(f->x[i - 1], from), b = fmin(f->x[i], to);
    if (b > a) {
      const double rate = (f->film[i] - f->film[i - 1]) / (f->x[i] - f->x[i - 1]);
      sum += (b - a) * (f->film[i - 1] + rate * (0.5 * (a + b) - f->x[i - 1]));
    }
  }
  return sum;
}

// Where the film is thinnest within 0.9 b.
static double neck(const Profile *f, double b) {
  size_t at = f->points / 2;
  for (size_t i = 0; i < f->points; i++) {
    at = fabs(f->x[i]) < 0.9 * b && f->film[i] < f->film[at] ? i : at;
  }
  return f->x[at];
}

// Slides, stops, waits, and slides back: load and mass at every step, mass once more from the
// profiles alone, and the neck that the stop squeezed at the trailing edge crosses the contact at
// half the sliding speed.
static void test_reversal(void) {
  SbFilmTransientProblem p = seal(20000.0);
  const double b = half_width(&p), U = p.film.speed;
  const double transit = 4.0 * b / U;
  SbFilmTransient *t = begin(&p);
  Profile *film = g_new(Profile, 1);
  step(t, 0.2 * transit, 0.0);
  step(t, 0.3 * transit, 0.0);
  SbFilmTransientResult result = sb_film_transient_result(t);
  // Squeezed at both edges, trapped between them.
  g_assert_cmpfloat(result.film_min, <, 0.4 * result.film_central);
  step(t, 0.02 * transit, -U);
  step(t, 0.25 * transit, -U);

  read_profile(film, t);
  const double place = neck(film, b);
  const double from = place - 0.2 * b, to = 0.8 * b; // the neck leaves this window
  double content = profile_content(film, from, to);
  double change = 0.0, through = 0.0, largest = 0.0;
  for (int i = 0; i < 15; i++) {
    const double dt = 0.02 * transit;
    const double left = profile_flow(film, from, -U, p.film.viscosity);
    const double right = profile_flow(film, to, -U, p.film.viscosity);
    step(t, dt, -U);
    read_profile(film, t);
    const double now = profile_content(film, from, to);
    const double new_left = profile_flow(film, from, -U, p.film.viscosity);
    const double new_right = profile_flow(film, to, -U, p.film.viscosity);
    change += now - content;
    through += 0.5 * dt * (left + new_left - right - new_right);
    largest = fmax(largest, fabs(change));
    content = now;
  }
  const double moved = neck(film, b) - place;
  g_assert_cmpfloat(largest, >, 0.02 * content);
  g_assert_cmpfloat(fabs(change - through), <, 0.05 * largest);
  g_assert_cmpfloat(fabs(moved / (-0.5 * U * 0.3 * transit) - 1.0), <, 0.05);

  step(t, 2.5 * transit, -U);
  result = sb_film_transient_result(t);
  SbFilm *steady = g_new(SbFilm, 1);
  p.film.speed = -U;
  g_assert_cmpint(sb_film_solve(steady, &p.film, NULL, NULL), ==, SB_OK);
  g_assert_cmpfloat_with_epsilon(result.film_min / steady->film_min, 1.0, 3e-3);
  g_assert_cmpfloat_with_epsilon(result.film_central / steady->film_central, 1.0, 3e-3);
  g_assert_cmpfloat(result.load_error, <, 1e-10);
  g_assert_cmpfloat(result.mass_error, <, 1e-10);
  g_test_message("%zu steps, %zu Newton steps", result.steps, result.newton_iterations);
  g_assert_cmpuint(result.steps, <, 600);
  sb_film_transient_destroy(t);
  g_free(film);
  g_free(steady);
}

// Second order in time, observed on film and shear at the end of a slow-down.
static void test_order(void) {
  Profile *film = g_new(Profile, 1);
  double value[4][2];
  for (int level = 0; level < 4; level++) {
    SbFilmTransientProblem p = seal(50.0);
    const double transit = 4.0 * half_width(&p) / p.film.speed;
    SbFilmTransient *t = begin(&p);
    const int steps = 20 << level;
    const double v = t->now.speed;
    for (int k = 1; k <= steps; k++) {
      const double share = (double)k / steps;
      double error;
      g_assert_cmpint(
          sb_transient_advance(&error, t, 0.4 * transit / steps, v * (1.0 - 0.6 * share)), ==,
          SB_OK);
      sb_transient_accept(t, error);
    }
    read_profile(film, t);
    value[level][0] = film->film[film->points / 2];
    value[level][1] = 0.0; // Couette's shear over the full film
    for (int i = 1; i < t->nodes && !t->now.cavity[i]; i++) {
      value[level][1] +=
          0.5 * (film->x[i] - film->x[i - 1]) * (1.0 / film->film[i] + 1.0 / film->film[i - 1]);
    }
    sb_film_transient_destroy(t);
  }
  for (int k = 0; k < 2; k++) {
    const double coarse = fabs(value[1][k] - value[0][k]);
    const double middle = fabs(value[2][k] - value[1][k]);
    const double fine = fabs(value[3][k] - value[2][k]);
    g_test_message("order %.2f %.2f", log2(coarse / middle), log2(middle / fine));
    g_assert_cmpfloat(log2(middle / fine), >, 1.7);
    g_assert_cmpfloat(fine / value[3][k], <, 1e-3);
  }
  g_free(film);
}

// The history does not hang on the steps that the caller asks for.
static void test_steps(void) {
  double central[2], least[2], error = 0.0;
  for (int k = 0; k < 2; k++) {
    SbFilmTransientProblem p = seal(1000.0);
    const double transit = 4.0 * half_width(&p) / p.film.speed;
    SbFilmTransient *t = begin(&p);
    const int steps = k == 0 ? 3 : 50;
    for (int i = 1; i <= steps; i++) {
      const double s = (double)i / steps;
      step(t, 0.5 * transit / steps, p.film.speed * (1.0 - s));
    }
    SbFilmTransientResult film = sb_film_transient_result(t);
    central[k] = film.film_central;
    least[k] = film.film_min;
    error = film.error_time;
    sb_film_transient_destroy(t);
  }
  g_assert_cmpfloat(fabs(central[1] / central[0] - 1.0), <, 1e-3);
  g_assert_cmpfloat(fabs(central[1] / central[0] - 1.0), <, 3.0 * error);
  g_assert_cmpfloat(fabs(least[1] / least[0] - 1.0), <, 0.03);
}

// A stiff cylinder falls through a thick film: W = 3 sqrt(2) pi eta R^1.5 (-dh/dt)/h^1.5, so that
// h^-1/2 grows evenly (Reynolds' equation of the parabola without cavity, integrated).
static void test_squeeze(void) {
  SbFilmTransientProblem p = {0};
  sb_film_problem_init(&p.film);
  p.film.radius = 1e-3;
  p.film.modulus = 1e9;
  p.film.viscosity = 1.0;
  p.film.load = 100.0;
  p.speed_scale = 1e-5;
  const double b = half_width(&p);
  p.rest_film = 1000.0 * b * b / p.film.radius;
  const double rate =
      p.film.load / (6.0 * sqrt(2.0) * G_PI * p.film.viscosity * pow(p.film.radius, 1.5));
  const double unit = 1.0 / sqrt(p.rest_film) / rate;
  SbFilmTransient *t = begin(&p);
  step(t, 0.3 * unit, 0.0);
  SbFilmTransientResult film = sb_film_transient_result(t);
  const double before = 1.0 / sqrt(film.film_min);
  step(t, 0.5 * unit, 0.0);
  film = sb_film_transient_result(t);
  g_assert_cmpfloat(film.film_min, <, 0.5 * p.rest_film);
  g_assert_cmpfloat_with_epsilon((1.0 / sqrt(film.film_min) - before) / (0.5 * unit * rate), 1.0,
                                 5e-3);
  sb_film_transient_destroy(t);
}

// From rest under a trapped layer the film comes in at half the sliding speed and ends steady.
static void test_start(void) {
  SbFilmTransientProblem p = seal(20000.0);
  const double U = p.film.speed;
  const double transit = 4.0 * half_width(&p) / U;
  SbFilm *steady = g_new(SbFilm, 1);
  g_assert_cmpint(sb_film_solve(steady, &p.film, NULL, NULL), ==, SB_OK);
  p.film.speed = 0.0;
  p.rest_film = 0.1 * steady->film_central;
  SbFilmTransient *t = begin(&p);
  step(t, 0.01 * transit, U);
  step(t, 0.34 * transit, U);
  SbFilmTransientResult film = sb_film_transient_result(t);
  g_assert_cmpfloat_with_epsilon(film.film_central / p.rest_film, 1.0, 0.02);
  step(t, 0.3 * transit, U);
  film = sb_film_transient_result(t);
  g_assert_cmpfloat_with_epsilon(film.film_central / steady->film_central, 1.0, 0.02);
  step(t, 1.0 * transit, U);
  film = sb_film_transient_result(t);
  g_assert_cmpfloat_with_epsilon(film.film_min / steady->film_min, 1.0, 2e-3);
  g_assert_cmpfloat_with_epsilon(film.film_central / steady->film_central, 1.0, 2e-3);
  sb_film_transient_destroy(t);
  g_free(steady);
}

// Trapped at rest, a film a thousand times thinner than those of the speeds to come is squeezed at
// its necks; spacing finer by another third does not change them.
static void test_thin_rest(void) {
  double least[2];
  for (int k = 0; k < 2; k++) {
    SbFilmTransientProblem p = seal(20000.0);
    p.film.load = 1045.4;
    p.film.radius = 0.93619e-3;
    p.film.viscosity = 0.75836e-3;
    p.film.speed = 0.0;
    p.film.pressure_left = 168549.0;
    p.film.tolerance = k == 0 ? 3e-3 : 1e-3;
    p.speed_scale = 0.34;
    p.rest_film = 0.126e-9;
    SbFilmTransient *t = begin(&p);
    step(t, 5.3, 0.0);
    const SbFilmTransientResult film = sb_film_transient_result(t);
    least[k] = film.film_min;
    g_assert_cmpfloat_with_epsilon(film.film_central / p.rest_film, 1.0, 2e-3);
    g_assert_cmpfloat(film.error_film_min, <, 0.03);
    sb_film_transient_destroy(t);
  }
  g_assert_cmpfloat(least[1], <, 0.6 * 0.126e-9);
  g_assert_cmpfloat_with_epsilon(least[0] / least[1], 1.0, 0.01);
}

// From rest on a thick film a seal slides so much slower than its fastest that the steady film is
// three hundred times thinner: a mesh for that one brings it there.
static void test_thinned(void) {
  SbFilm *steady = g_new(SbFilm, 1);
  SbFilmTransientProblem p = seal(200.0);
  const double slow = 3e-4 * p.film.speed, transit = 4.0 * half_width(&p) / slow;
  p.film.tolerance = 1e-2;
  p.film.speed = slow;
  g_assert_cmpint(sb_film_solve(steady, &p.film, NULL, NULL), ==, SB_OK);
  p.film.speed = 0.0;
  p.rest_film = 1e-6;
  p.least_film = 5e-9;
  SbFilmTransient *t = begin(&p);
  step(t, 0.01 * transit, slow);
  step(t, 2.5 * transit, slow);
  const SbFilmTransientResult film = sb_film_transient_result(t);
  g_assert_cmpfloat_with_epsilon(film.film_min / steady->film_min, 1.0, 3e-3);
  g_assert_cmpfloat_with_epsilon(film.film_central / steady->film_central, 1.0, 3e-3);
  sb_film_transient_destroy(t);
  g_free(steady);
}

// Values of the least film that others know better. Never further off than three estimates and the
// reference's own uncertainty, whatever the resolution.
typedef struct {
  double time, speed, least, uncertainty; // [s], [m/s], [m]; 0: not known
  double claim;                           // most that the resolved film may say of its error
} Known;

static void history(const Known *row, int rows, bool resolve) {
  SbFilmTransientProblem p = seal(1000.0);
  p.film.modulus = 6.5725154e6;
  p.film.speed = p.speed_scale = 0.1;
  p.resolve = resolve;
  SbFilmTransient *t = begin(&p);
  for (int i = 0; i < rows; i++) {
    step(t, row[i].time - (i > 0 ? row[i - 1].time : 0.0), row[i].speed);
    SbFilmTransientResult film = sb_film_transient_result(t);
    if (row[i].least == 0.0) {
      continue;
    }
    const double error = fabs(film.film_min / row[i].least - 1.0);
    const double estimate = film.error_film_min;
    g_test_message("%g ms: %.4g nm, off %.2g, estimate %.2g", 1e3 * row[i].time,
                   1e9 * film.film_min, error, estimate);
    g_assert_cmpfloat(error, <=, 3.0 * estimate + row[i].uncertainty);
    if (resolve) {
      g_assert_cmpfloat(estimate, <, row[i].claim);
    }
  }
  const SbFilmTransientResult info = sb_film_transient_result(t);
  g_assert_cmpfloat(info.load_error, <, 1e-10);
  g_assert_cmpfloat(info.mass_error, <, 1e-10);
  sb_film_transient_destroy(t);
}

// Finite volumes with complementarity, extrapolated from three grids: from steady sliding to rest
// in 5 ms, 50 ms at rest, back in 10 ms.
static void test_history(void) {
  static const Known row[] = {
      {5e-3, 0.0, 7.550e-9, 0.003, 0.012}, {30e-3, 0.0, 8.821e-9, 0.001, 0.012},
      {55e-3, 0.0, 0.0, 0.0, 0.0},         {58e-3, -0.03, 7.326e-9, 0.001, 0.012},
      {65e-3, -0.1, 0.0, 0.0, 0.0},        {71e-3, -0.1, 9.24e-9, 0.05, 0.025}};
  history(row, 6, false);
  history(row, g_test_slow() ? 6 : 1, true);
}

// Our own solution at 0.58 times the spacing and steps (tolerance 2e-4); uncertain by what is left
// of a method of second order, half of the difference to the default. To rest in 2 ms, 20 ms at
// rest, back at half the speed: the dip of the reversal leaves slowly and is not outrun.
static void test_dwell(void) {
  static const Known row[] = {
      {2e-3, 0.0, 10.635e-9, 0.001, 0.01},   {12e-3, 0.0, 10.868e-9, 0.001, 0.01},
      {22e-3, 0.0, 9.947e-9, 0.001, 0.01},   {24e-3, -0.02, 7.807e-9, 0.003, 0.01},
      {27e-3, -0.05, 8.275e-9, 0.02, 0.02},  {32e-3, -0.05, 8.730e-9, 0.02, 0.025},
      {38e-3, -0.05, 9.084e-9, 0.02, 0.025}, {44e-3, -0.05, 9.341e-9, 0.02, 0.025}};
  history(row, G_N_ELEMENTS(row), false);
  history(row, G_N_ELEMENTS(row), true);
}

// The seal between rough surfaces.
static SbFilmTransientProblem rough(SbRoughModel surface, double sigma, double speed) {
  SbFilmTransientProblem p = seal(1000.0);
  p.film.surface = surface;
  p.film.gt_product = 0.1289;
  p.film.sigma = sigma;
  p.film.sigma_over_beta = 0.1;
  p.film.shear_strength = 3.5e6;
  p.film.load_coefficient = 0.19;
  p.film.speed = p.speed_scale = speed;
  p.film.tolerance = 3e-4;
  p.resolve = true;
  return p;
}

static void assert_near(double a, double b, double share) {
  g_assert_cmpfloat(fabs(a - b), <=, share * fabs(b));
}

// Held at its speed the film with asperities, and adhesion, is the steady one, with its friction,
// load and real area.
static void test_rough_steady(void) {
  static const struct {
    SbRoughModel surface;
    double sigma, speed, hamaker, off;
  } row[] = {{SB_ROUGH_GREENWOOD_TRIPP, 1e-6, 0.1, 0.0, 1e-4},
             {SB_ROUGH_GREENWOOD_TRIPP, 0.2e-6, -0.01, 1.35e-19, 1e-4},
             {SB_ROUGH_PERSSON, 0.2e-6, 0.1, 0.0, 1e-4}};
  SbFilm *steady = g_new(SbFilm, 1);
  for (size_t i = 0; i < G_N_ELEMENTS(row); i++) {
    SbFilmTransientProblem p = rough(row[i].surface, row[i].sigma, fabs(row[i].speed));
    p.film.speed = row[i].speed;
    p.film.hamaker = row[i].hamaker;
    SbFilmTransient *t = begin(&p);
    step(t, 0.1 * half_width(&p) / p.speed_scale, p.film.speed);
    const SbFilmTransientResult film = sb_film_transient_result(t);
    g_assert_cmpint(sb_film_solve(steady, &p.film, NULL, NULL), ==, SB_OK);
    g_test_message("%.3g %.3g %.3g %.3g", film.film_min / steady->film_min - 1.0,
                   film.film_central / steady->film_central - 1.0,
                   film.asperity_load / steady->asperity_load - 1.0,
                   film.friction_couette / steady->friction_couette - 1.0);
    assert_near(film.film_min, steady->film_min, 3.0 * row[i].off);
    assert_near(film.film_central, steady->film_central, row[i].off);
    assert_near(film.asperity_load, steady->asperity_load, row[i].off);
    assert_near(film.real_area, steady->real_area, row[i].off);
    assert_near(film.friction_boundary, steady->friction_boundary, row[i].off);
    assert_near(film.friction_couette, steady->friction_couette, 5.0 * row[i].off);
    // It ends with a cell.
    assert_near(film.friction_cavity, steady->friction_cavity, 0.05);
    g_assert_cmpfloat(film.load_error, <, 1e-10);
    g_assert_cmpfloat(film.mass_error, <, 1e-10);
    sb_film_transient_destroy(t);
  }
  g_free(steady);
}

// Slides, stops, waits and slides back. Hardly any roughness: the smooth film. With more the
// squeezed film hands its load to the asperities, to friction at rest, and comes back.
static void test_rough_history(void) {
  double least[2][4];
  for (int k = 0; k < 3; k++) {
    SbFilmTransientProblem p =
        rough(k > 0 ? SB_ROUGH_GREENWOOD_TRIPP : SB_ROUGH_NONE, k == 2 ? 0.5e-6 : 1e-10, 0.1);
    p.film.tolerance = 3e-3;
    p.resolve = false;
    const double transit = 4.0 * half_width(&p) / p.film.speed;
    SbFilmTransient *t = begin(&p);
    const double speed[] = {0.0, 0.0, -0.05, -0.1};
    double borne = 0.0;
    for (int i = 0; i < 4; i++) {
      step(t, 0.3 * transit, speed[i]);
      const SbFilmTransientResult film = sb_film_transient_result(t);
      if (k < 2) {
        least[k][i] = film.film_min;
      } else if (i < 2) {
        g_assert_cmpfloat(film.asperity_load, >, borne);
        borne = film.asperity_load;
      }
      g_assert_cmpfloat(film.friction_boundary * speed[i], >=, 0.0);
      g_assert_cmpfloat(film.load_error, <, 1e-10);
      g_assert_cmpfloat(film.mass_error, <, 1e-10);
    }
    if (k == 2) {
      step(t, 2.5 * transit, -0.1);
      SbFilm *steady = g_new(SbFilm, 1);
      p.film.speed = -0.1;
      g_assert_cmpint(sb_film_solve(steady, &p.film, NULL, NULL), ==, SB_OK);
      const SbFilmTransientResult film = sb_film_transient_result(t);
      assert_near(film.film_min, steady->film_min, 1e-2);
      assert_near(film.asperity_load, steady->asperity_load, 1e-2);
      g_free(steady);
    }
    sb_film_transient_destroy(t);
  }
  for (int i = 0; i < 4; i++) {
    assert_near(least[1][i], least[0][i], 1e-6);
  }
}

// At rest asperities hold the surfaces apart, whatever less film is asked for; sliding brings the
// steady film.
static void test_rough_start(void) {
  SbFilmTransientProblem p = rough(SB_ROUGH_GREENWOOD_TRIPP, 0.2e-6, 0.0);
  SbFilm *rest = g_new(SbFilm, 1), *steady = g_new(SbFilm, 1);
  g_assert_cmpint(sb_film_solve(rest, &p.film, NULL, NULL), ==, SB_OK);
  p.speed_scale = 0.1;
  p.rest_film = 1e-10;
  p.film.tolerance = 3e-3;
  p.resolve = false;
  SbFilmTransient *t = begin(&p);
  assert_near(sb_film_transient_result(t).film_central, rest->film_central, 1e-3);
  const double transit = 4.0 * half_width(&p) / p.speed_scale;
  step(t, 0.01 * transit, 0.1);
  step(t, 2.5 * transit, 0.1);
  p.film.speed = 0.1;
  g_assert_cmpint(sb_film_solve(steady, &p.film, NULL, NULL), ==, SB_OK);
  assert_near(sb_film_transient_result(t).film_min, steady->film_min, 3e-3);
  sb_film_transient_destroy(t);
  g_free(rest);
  g_free(steady);
}

typedef struct {
  double way, film, error; // in half-widths, [m], of the instant
} Instant;

enum { INSTANTS = 30 };

// A thin film left by a start leaves the contact; the history's error.
static double leave(Instant *out, double tolerance) {
  SbFilmTransientProblem p = seal(200.0);
  const double u = p.film.speed;
  p.film.tolerance = tolerance;
  p.film.speed = 0.0;
  p.rest_film = 20e-9;
  SbFilmTransient *t = begin(&p);
  const double transit = 4.0 * half_width(&p) / u;
  step(t, 0.01 * transit, u);
  for (int i = 0; i < INSTANTS; i++) {
    step(t, 1.25 * transit / INSTANTS, u);
    const SbFilmTransientResult film = sb_film_transient_result(t);
    out[i] = (Instant){2.5 * (i + 1) / INSTANTS, film.film_min, film.error_film_min};
  }
  const double error = sb_film_transient_result(t).error_history;
  sb_film_transient_destroy(t);
  return error;
}

// Films are told within what a finer solution shows of them within so much of the passage; of an
// instant they are much further off.
static void test_leave(void) {
  Instant told[INSTANTS], fine[INSTANTS];
  const double error = leave(told, 1e-2);
  (void)leave(fine, 3e-3);
  double instant = 0.0, apart = 0.0;
  for (int i = 0; i < INSTANTS; i++) {
    double best = INFINITY;
    for (int j = 0; j < INSTANTS * 10 - 9; j++) { // straight between the finer one's instants
      const Instant *a = &fine[j / 10], *b = j % 10 > 0 ? a + 1 : a;
      const double share = 0.1 * (j % 10);
      const double lag = 0.5 * fabs(a->way + share * (b->way - a->way) - told[i].way);
      const double film = a->film + share * (b->film - a->film);
      best = fmin(best, fmax(lag, fabs(told[i].film / film - 1.0)));
    }
    apart = fmax(apart, best);
    instant = fmax(instant, told[i].error);
  }
  g_test_message("off %.3g, told %.3g, of an instant %.3g", apart, error, instant);
  g_assert_cmpfloat(apart, <=, 3.0 * error);
  g_assert_cmpfloat(error, <, 0.5 * instant);
}

static bool count_step(void *data) {
  return ++*(int *)data > 1000;
}

// At rest asperities come to bear nearly all: the film's pressure is then a small difference, known
// to its rounding only, and no reason to shorten steps. The companion's count as well.
static void test_rough_rest(void) {
  int count = 0;
  SbFilmTransientProblem p = rough(SB_ROUGH_GREENWOOD_TRIPP, 0.3e-6, 0.0);
  p.speed_scale = 3.3e-4;
  p.rest_film = 1e-9;
  p.film.tolerance = 3e-3;
  p.resolve = false;
  p.film.pressure_left = 0.55e6;
  p.film.cancelled = count_step;
  p.film.cancelled_data = &count;
  SbFilmTransient *t = begin(&p);
  count = 0;
  step(t, 0.4, 0.0);
  g_test_message("%d steps tried", count);
  g_assert_cmpint(count, <, 100);
  g_assert_cmpfloat(sb_film_transient_result(t).error_film_min, <, 0.3);
  sb_film_transient_destroy(t);
}

// A rough contact at rest on a disc keeps the fluid of its gaps until it moves, also beyond the
// ends of the steady film's profile: there too the gap is that of the body under its pressures.
static void test_rough_gap(void) {
  SbFilmTransientProblem p = rough(SB_ROUGH_PERSSON, 0.766e-6, 0.0);
  SbSurfaceCompliance disc;
  const double R = p.film.radius;
  g_assert_cmpint(sb_compliance_disc(&disc, R, 0.75 * p.film.modulus, 0.5, 0.6 * R, NULL), ==,
                  SB_OK);
  p.film.modulus = disc.modulus;
  p.film.compliance = &disc;
  p.film.pressure_left = p.film.pressure_right = 0.55e6;
  p.speed_scale = 16.0;
  p.rest_film = 1e-10;
  p.film.tolerance = 1e-2;
  p.resolve = false;
  SbFilmTransient *t = begin(&p);
  double gap[SB_TRANSIENT_NODES_MAX], off = 0.0;
  sb_transient_gap(gap, t, &t->now);
  for (int i = 0; i < t->nodes; i++) {
    const int end = t->X[i] < 0.0 ? 0 : t->nodes - 1;
    if (fabs(t->X[i]) > 1.2) { // outside the contact, which ends at 1
      const double rise = gap[end] - gap[i];
      off = fmax(off, fabs(t->now.H[end] - t->now.H[i] - rise) / t->now.H[end]);
    }
  }
  g_test_message("X %.3g to %.3g, gap off by %.2g of that at the end", t->X[0], t->X[t->nodes - 1],
                 off);
  g_assert_cmpfloat(off, <, 1e-3);
  sb_film_transient_destroy(t);
}

// A wall that brings little holds the steady starved film, smooth and rough, and brings it back
// after a stop and a reversal; one that brings more than the film takes floods it. The error that
// the film tells holds.
static void test_starved(void) {
  static const struct {
    SbRoughModel surface;
    double layer;
  } row[] = {{SB_ROUGH_NONE, 5e-9},
             {SB_ROUGH_GREENWOOD_TRIPP, 5e-9},
             {SB_ROUGH_NONE, 1e-6},
             {SB_ROUGH_GREENWOOD_TRIPP, 1e-6}};
  SbFilm *steady = g_new(SbFilm, 1);
  for (size_t i = 0; i < G_N_ELEMENTS(row); i++) {
    SbFilmTransientProblem p = rough(row[i].surface, 0.2e-6, 0.1);
    p.film.tolerance = 3e-3;
    p.resolve = false;
    p.inlet_film[0] = p.inlet_film[1] = row[i].layer;
    const double transit = 4.0 * half_width(&p) / p.film.speed;
    SbFilmTransient *t = begin(&p);
    p.film.inlet_film = row[i].layer;
    g_assert_cmpint(sb_film_solve(steady, &p.film, NULL, NULL), ==, SB_OK);
    step(t, 0.2 * transit, 0.1);
    for (int back = 0; back < (row[i].layer < 1e-8 ? 2 : 1); back++) {
      const SbFilmTransientResult film = sb_film_transient_result(t);
      g_test_message("%.3g %.3g", film.film_min / steady->film_min - 1.0,
                     film.film_central / steady->film_central - 1.0);
      assert_near(film.film_min, steady->film_min, fmin(film.error_film_min, 8e-3));
      assert_near(film.film_central, steady->film_central, fmin(film.error_film_central, 3e-3));
      if (back == 0) {
        step(t, 0.05 * transit, 0.0);
        step(t, 0.05 * transit, -0.1);
        step(t, 2.8 * transit, -0.1);
      }
    }
    sb_film_transient_destroy(t);
  }
  g_free(steady);
}

// What it cannot solve is refused.
static void test_refused(void) {
  SbFilmTransient *t = NULL;
  SbFilmTransientProblem p = seal(1000.0);
  p.film.pressure_viscosity = 1e-9;
  g_assert_cmpint(sb_film_transient_create(&t, &p, NULL), ==, SB_ERROR_INPUT);
  p = seal(1000.0);
  p.speed_scale = 0.5 * p.film.speed;
  g_assert_cmpint(sb_film_transient_create(&t, &p, NULL), ==, SB_ERROR_RANGE);
  p = seal(1000.0);
  p.film.speed = 0.0;
  g_assert_cmpint(sb_film_transient_create(&t, &p, NULL), ==, SB_ERROR_RANGE);
  p = seal(1000.0);
  p.film.speed = p.speed_scale = p.film.speed * 4e6;
  g_assert_cmpint(sb_film_transient_create(&t, &p, NULL), ==, SB_ERROR_RANGE);
  p = seal(1000.0);
  p.film.hamaker = 1e-19; // closes smooth surfaces
  g_assert_cmpint(sb_film_transient_create(&t, &p, NULL), ==, SB_ERROR_INFEASIBLE);
  p = rough(SB_ROUGH_GREENWOOD_TRIPP, 0.1e-6, 0.1);
  p.film.work_of_adhesion = 0.13; // closes this surface's gaps below 0.45 um
  g_assert_cmpint(sb_film_transient_create(&t, &p, NULL), ==, SB_ERROR_INFEASIBLE);
  p = seal(1000.0);
  t = begin(&p);
  g_assert_cmpint(sb_film_transient_step(t, 1.0, 2.0 * p.film.speed, NULL), ==, SB_ERROR_RANGE);
  g_assert_cmpint(sb_film_transient_step(t, -1.0, p.film.speed, NULL), ==, SB_ERROR_RANGE);
  g_assert_cmpint(sb_film_transient_step(t, 1.0, NAN, NULL), ==, SB_ERROR_RANGE);
  sb_film_transient_destroy(t);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/film-transient/steady", test_steady);
  g_test_add_func("/film-transient/reversal", test_reversal);
  g_test_add_func("/film-transient/order", test_order);
  g_test_add_func("/film-transient/steps", test_steps);
  g_test_add_func("/film-transient/squeeze", test_squeeze);
  g_test_add_func("/film-transient/start", test_start);
  g_test_add_func("/film-transient/thin-rest", test_thin_rest);
  g_test_add_func("/film-transient/thinned", test_thinned);
  g_test_add_func("/film-transient/history", test_history);
  if (g_test_slow()) {
    g_test_add_func("/film-transient/dwell", test_dwell);
  }
  g_test_add_func("/film-transient/rough-steady", test_rough_steady);
  g_test_add_func("/film-transient/rough-history", test_rough_history);
  g_test_add_func("/film-transient/rough-start", test_rough_start);
  g_test_add_func("/film-transient/leave", test_leave);
  g_test_add_func("/film-transient/rough-rest", test_rough_rest);
  g_test_add_func("/film-transient/rough-gap", test_rough_gap);
  g_test_add_func("/film-transient/starved", test_starved);
  g_test_add_func("/film-transient/refused", test_refused);
  return g_test_run();
}
