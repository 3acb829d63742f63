#include "engine/film/content.h"

#include "engine/film/scale.h"

#include <gsl/gsl_spline.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Steady films per decade of speed, and limits of their number. The slowest is at most `near` above
// u*; below it u_T approaches u* as a power of the speed.
enum { PER_DECADE = 3, STEADY_LEAST = 5, STEADY_MOST = 19 };
static const double near = 0.05;

// Cells along the contact, of the companion too (half as many), and places of the dry pressure.
enum { CELLS = 320, CELLS_MAX = CELLS + 2, PLACES = 801 };
// Change of the mean content by squeezing in one step, as a part of it.
static const double squeeze_step = 0.01;

// One of two memories of the same contact.
typedef struct {
  double cell;             // width of a new cell [m]
  int count;               // cells, from -b to b
  double width[CELLS_MAX]; // [m]
  double u[CELLS_MAX];     // content [m]
} Cells;

struct SbContent {
  SbFilmProblem film;
  SbRoughLaw law;
  double b, peak;      // half-width [m] and peak pressure [Pa] of Hertz's contact
  double scale, speed; // [m/s]
  double closed;       // u* [m]
  gsl_spline *steady;  // ln u_T against ln V
  double power;        // of u_T - u* below the table
  double error_steady; // relative, of u_T
  double area[PLACES]; // integral of A(p) from -b to b sin(theta_i) [m]
  Cells cells[2];      // the second has cells twice as wide
};

static const double steepest = M_PI_2;

// Real contact area and pressure of the solids at a content; drained at 0.
static SbRoughPoint point_of(const SbContent *c, double u) {
  SbRoughPoint at = {.share = 1, .pressure = INFINITY};
  if (u > 1e-9 * c->closed) {
    sb_rough_law_at(&at, &c->law, sb_rough_law_of_gap(&c->law, u));
  }
  return at;
}

// Integral of A(p) of the dry contact from -b to x [m].
static double dry_area(const SbContent *c, double x) {
  const double theta = asin(fmax(-1, fmin(1, x / c->b)));
  const double place = (theta / steepest + 1) * 0.5 * (PLACES - 1);
  const int i = (int)fmin(place, PLACES - 2);
  return c->area[i] + (place - i) * (c->area[i + 1] - c->area[i]);
}

// Steady content at the speed |V|.
static double steady_content(const SbContent *c, double speed) {
  const double v = log(fmin(fabs(speed), c->scale)), least = c->steady->x[0];
  if (v >= least) {
    return exp(gsl_spline_eval(c->steady, v, NULL));
  }
  return c->closed + (exp(c->steady->y[0]) - c->closed) * exp(c->power * (v - least));
}

// Area [m] and friction [N/m] of one cell from x0 to x1 with content u.
static void add_cell(SbContentResult *sum, const SbContent *c, double x0, double x1, double u) {
  const SbRoughPoint at = point_of(c, u);
  // The solids carry all of the dry pressure outside -inner to inner.
  const double ratio = at.pressure / c->peak;
  const double inner = ratio < 1 ? c->b * sqrt(1 - ratio * ratio) : 0;
  const double from = fmin(fmax(x0, -inner), inner), to = fmin(fmax(x1, -inner), inner);
  const double outside = dry_area(c, x1) - dry_area(c, x0) - dry_area(c, to) + dry_area(c, from);
  sum->real_area += at.share * (to - from) + outside;
  if (u > 0) {
    const double open = 1 - at.share;
    const double shear = c->film.viscosity * c->speed * open * open / u;
    sum->friction += fmax(-c->film.shear_strength, fmin(shear, c->film.shear_strength)) * (x1 - x0);
  }
  sum->mean += u * (x1 - x0) / (2 * c->b);
  sum->least = fmin(sum->least, u);
}

static SbContentResult result_of(const SbContent *c, const Cells *cells) {
  SbContentResult sum = {.least = INFINITY};
  double x = -c->b;
  for (int i = 0; i < cells->count; i++) {
    add_cell(&sum, c, x, x + cells->width[i], cells->u[i]);
    x += cells->width[i];
  }
  sum.friction += copysign(c->film.shear_strength * sum.real_area, c->speed);
  return sum;
}

// Moves the contact's content by d [m] > 0 to +x, and lets `u` in at -b. The innermost cell takes
// what enters until it has the width of a cell.
static void carry(Cells *cells, double d, double u) {
  double *width = cells->width, *held = cells->u;
  for (double out = d; cells->count > 0 && out > 0;) { // what leaves at b
    const int last = cells->count - 1;
    const double part = fmin(out, width[last]);
    width[last] -= part;
    out -= part;
    cells->count -= width[last] <= 0;
  }
  const bool joins = cells->count > 0 && width[0] + d <= cells->cell;
  if (!joins && cells->count < CELLS_MAX) {
    memmove(width + 1, width, (size_t)cells->count * sizeof *width);
    memmove(held + 1, held, (size_t)cells->count * sizeof *held);
    width[0] = held[0] = 0;
    cells->count++;
  }
  held[0] = (held[0] * width[0] + u * d) / (width[0] + d);
  width[0] += d;
}

static void mirror(Cells *cells) {
  for (int i = 0, k = cells->count - 1; i < k; i++, k--) {
    const double width = cells->width[i], u = cells->u[i];
    cells->width[i] = cells->width[k];
    cells->u[i] = cells->u[k];
    cells->width[k] = width;
    cells->u[k] = u;
  }
}

// S P_f/(4 eta b^2) of a contact with the content u [m/s].
static double outflow(const SbContent *c, double u) {
  const SbRoughPoint at = point_of(c, u);
  const double pressure = fmax(0, c->film.load / (2 * c->b) - at.pressure);
  return at.flow * u * u * u * pressure / (4 * c->film.viscosity * c->b * c->b);
}

static double mean_of(const SbContent *c, const Cells *cells) {
  double sum = 0;
  for (int i = 0; i < cells->count; i++) {
    sum += cells->u[i] * cells->width[i];
  }
  return sum / (2 * c->b);
}

// Squeezes the mean content towards `steady` for the time dt [s]: what the cells hold above it
// shrinks by a common factor. Steps of Heun's method.
static void squeeze(const SbContent *c, Cells *cells, double steady, double dt) {
  double mean = mean_of(c, cells);
  if (mean <= steady) {
    return;
  }
  const double least = outflow(c, steady), first = mean;
  while (dt > 0 && mean > steady) {
    const double rate = outflow(c, mean) - least;
    const double step = fmin(dt, squeeze_step * mean / fmax(rate, 1e-300));
    const double end = fmax(steady, mean - rate * step);
    mean = fmax(steady, mean - 0.5 * step * (rate + outflow(c, end) - least));
    dt -= step;
  }
  double above = 0; // mean excess of the cells that exceed it
  for (int i = 0; i < cells->count; i++) {
    above += fmax(0, cells->u[i] - steady) * cells->width[i] / (2 * c->b);
  }
  const double kept = fmax(0, 1 - (first - mean) / above);
  for (int i = 0; i < cells->count; i++) {
    cells->u[i] -= (1 - kept) * fmax(0, cells->u[i] - steady);
  }
}

// Advances one memory from the present speed to `speed`, of the same sign or 0, in dt [s].
static void advance(const SbContent *c, Cells *cells, double dt, double speed) {
  const double carried = 0.5 * (1 + c->film.roughness_split);
  const double way = 0.5 * dt * (fabs(c->speed) + fabs(speed)) * carried;
  const double steps = fmin(ceil(fmax(way / (0.5 * cells->cell), speed == c->speed ? 1 : 32)), 1e8);
  const bool back = c->speed + speed < 0;
  if (back) {
    mirror(cells);
  }
  const double part = dt / steps;
  for (double k = 0; k < steps; k++) {
    const double v = c->speed + (k + 0.5) / steps * (speed - c->speed);
    const double steady = v != 0 ? steady_content(c, v) : c->closed;
    const double d = fmin(fabs(v) * carried * part, 2 * c->b);
    if (d > 0) {
      carry(cells, d, steady);
    }
    squeeze(c, cells, steady, part);
  }
  if (back) {
    mirror(cells);
  }
}

static void fill(const SbContent *c, Cells *cells, int count, double u) {
  cells->cell = 2 * c->b / count;
  cells->count = count;
  for (int i = 0; i < count; i++) {
    cells->width[i] = cells->cell;
    cells->u[i] = u;
  }
}

// Hertz's contact and the integral of its real area, by the trapezoidal rule over theta, x = b sin
// theta, where p is the peak times cos theta.
static void set_dry_contact(SbContent *c) {
  const SbFilmScale scale = sb_film_scale(&c->film);
  c->b = scale.half_width;
  c->peak = scale.pressure;
  double before = 0;
  for (int i = 0; i < PLACES; i++) {
    const double p = c->peak * cos(steepest * (2.0 * i / (PLACES - 1) - 1));
    SbRoughPoint at = {.share = 0};
    if (p > 1e-9 * c->peak) {
      sb_rough_law_at(&at, &c->law, sb_rough_law_of_pressure(&c->law, p));
    }
    const double now = at.share * p / c->peak * c->b; // dA/dtheta
    c->area[i] = i > 0 ? c->area[i - 1] + 0.5 * (before + now) * M_PI / (PLACES - 1) : 0;
    before = now;
  }
}

// Solves the steady films of the table, from the fastest to the slowest.
static SbStatus solve_steady(SbContent *c, SbReport *report) {
  SbFilmSolver *solver = NULL;
  SbFilm *film = malloc(sizeof *film);
  SbStatus status = film == NULL ? sb_fail(report, SB_ERROR_MEMORY, "out of memory")
                                 : sb_film_solver_create(&solver, report);
  double v[STEADY_MOST], u[STEADY_MOST];
  SbFilmProblem problem = c->film;
  int first = STEADY_MOST; // of those solved
  bool enough = false;
  while (status == SB_OK && !enough) {
    first--;
    problem.speed = c->scale * pow(10, (double)(first + 1 - STEADY_MOST) / PER_DECADE);
    status = sb_film_solve(film, &problem, solver, report);
    v[first] = log(problem.speed);
    u[first] = log(film->film_central);
    c->error_steady = fmax(c->error_steady, film->solver.error_film_central);
    const int count = STEADY_MOST - first; // odd, so that every second one is a table too
    enough = first == 0 || (count >= STEADY_LEAST && count % 2 == 1 &&
                            film->film_central < (1 + near) * c->closed);
  }
  sb_film_solver_destroy(solver);
  free(film);
  if (status != SB_OK) {
    return status;
  }
  const int count = STEADY_MOST - first;
  // Error of the table: a quarter of that of one with every second film. By the order of cubic
  // splines it is a sixteenth, but a table of a few films may not have reached that order.
  gsl_spline *coarse = gsl_spline_alloc(gsl_interp_cspline, (size_t)(count + 1) / 2);
  c->steady = gsl_spline_alloc(gsl_interp_cspline, (size_t)count);
  if (c->steady == NULL || coarse == NULL) {
    gsl_spline_free(coarse);
    return sb_fail(report, SB_ERROR_MEMORY, "out of memory");
  }
  gsl_spline_init(c->steady, v + first, u + first, (size_t)count);
  double error = 0;
  for (int i = 0; i < count; i += 2) {
    v[i / 2] = v[first + i];
    u[i / 2] = u[first + i];
  }
  gsl_spline_init(coarse, v, u, (size_t)(count + 1) / 2);
  for (int i = 1; i < count; i += 2) {
    const double at = c->steady->x[i];
    error = fmax(error, 0.25 * fabs(expm1(gsl_spline_eval(coarse, at, NULL) - c->steady->y[i])));
  }
  gsl_spline_free(coarse);
  c->error_steady += error;
  const double last = exp(c->steady->y[0]) - c->closed, before = exp(c->steady->y[1]) - c->closed;
  c->power =
      last > 0 && before > last ? log(before / last) / (c->steady->x[1] - c->steady->x[0]) : 1;
  return sb_succeed(report);
}

SbStatus sb_content_create(SbContent **out, const SbContentProblem *problem, SbReport *report) {
  const SbFilmProblem *film = &problem->film;
  *out = NULL;
  if (!sb_rough_kind(film->surface)->spectrum || !(film->percolation_threshold > 0) ||
      film->compliance != NULL || film->inlet_film != 0) {
    return sb_fail(report, SB_ERROR_INPUT,
                   "the content of a contact needs the surface persson, a percolation threshold, a "
                   "half-plane and flooded inlets");
  }
  if (!(fabs(film->speed) <= problem->speed_scale)) {
    return sb_fail(report, SB_ERROR_RANGE, "the speed exceeds the largest speed");
  }
  SbContent *c = calloc(1, sizeof *c);
  if (c == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "out of memory");
  }
  c->film = *film;
  c->scale = problem->speed_scale;
  c->speed = film->speed;
  c->film.profile = NULL;
  const SbRoughSurface surface = {.model = film->surface,
                                  .product = film->gt_product,
                                  .sigma = film->sigma,
                                  .sigma_over_beta = film->sigma_over_beta,
                                  .modulus = film->modulus,
                                  .threshold = film->percolation_threshold};
  SbStatus status = sb_rough_law_like(&c->law, &surface, film->law, report);
  c->film.law = &c->law;
  if (status == SB_OK) {
    c->closed = sb_rough_law_closed_gap(&c->law);
    set_dry_contact(c);
    status = c->scale > 0 ? solve_steady(c, report) : sb_succeed(report);
  }
  if (status != SB_OK) {
    sb_content_destroy(c);
    return status;
  }
  const double u = c->speed != 0 ? steady_content(c, c->speed) : 0;
  for (int i = 0; i < 2; i++) {
    fill(c, &c->cells[i], CELLS >> i, u);
  }
  *out = c;
  return sb_succeed(report);
}

void sb_content_destroy(SbContent *content) {
  if (content != NULL) {
    gsl_spline_free(content->steady);
    free(content);
  }
}

SbStatus sb_content_step(SbContent *content, double dt, double speed, SbReport *report) {
  if (!(dt > 0) || !(fabs(speed) <= content->scale)) {
    return sb_fail(report, SB_ERROR_RANGE, "time step or speed are out of range");
  }
  if (content->film.cancelled != NULL && content->film.cancelled(content->film.cancelled_data)) {
    return sb_fail(report, SB_ERROR_CANCELLED, "cancelled");
  }
  if (content->speed * speed < 0) { // through rest
    const double until = dt * content->speed / (content->speed - speed);
    SbStatus status = sb_content_step(content, until, 0, report);
    return status == SB_OK ? sb_content_step(content, dt - until, speed, report) : status;
  }
  for (int i = 0; i < 2; i++) {
    advance(content, &content->cells[i], dt, speed);
  }
  content->speed = speed;
  return sb_succeed(report);
}

SbContentResult sb_content_result(const SbContent *content) {
  SbContentResult fine = result_of(content, &content->cells[0]);
  const SbContentResult wide = result_of(content, &content->cells[1]);
  fine.error_mean = fine.mean > 0 ? content->error_steady + fabs(wide.mean / fine.mean - 1) : 0;
  // The real area falls by less than its content grows, so their relative errors are compared as
  // equal.
  fine.error_friction = content->error_steady + fabs(wide.friction / fine.friction - 1);
  return fine;
}

SbContentResult sb_content_uniform(const SbContent *content, double u) {
  SbContentResult sum = {.least = INFINITY, .error_mean = NAN, .error_friction = NAN};
  add_cell(&sum, content, -content->b, content->b, u);
  sum.friction += copysign(content->film.shear_strength * sum.real_area, content->speed);
  return sum;
}

double sb_content_closed(const SbContent *content) {
  return content->closed;
}
