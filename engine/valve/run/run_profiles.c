// Profiles of pressure and film over the contacts of a run.
//
// The pressure is the fitment's. A solved film is the solver's own, on the fitted body where the
// fitment gives one, and has a pressure of its own; of a closed form the central film is uniform in
// the contact (the law has no shape), with the dry gap outside.
#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/numeric/root.h"
#include "engine/valve/run/run_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { OUTSIDE_POINTS = 60, PROFILE_POINTS = SB_FIT_PROFILE_MAX + 2 * OUTSIDE_POINTS };

int sb_run_first_equal_chamber(const SbRun *run, int seal, int chamber) {
  SbSealPressure p = sb_model_seal_pressure(run->model, seal, (SbChamber)chamber);
  for (int c = 0; c < chamber; c++) {
    SbSealPressure q = sb_model_seal_pressure(run->model, seal, (SbChamber)c);
    if (run->cycle.state[seal][c][SB_CYCLE_IN].touches && p.left == q.left && p.right == q.right) {
      return c;
    }
  }
  return chamber;
}

uint32_t sb_run_profile_slot(int seal, int chamber, int motion) {
  return (uint32_t)((seal * SB_CYCLE_CHAMBERS + chamber) * SB_RUN_MOTIONS + motion);
}

SbContactProfile sb_run_profile_view(const double *rows, size_t count, const char *model) {
  const double *film_pressure = rows + 4 * count;
  const bool solved = count > 0 && isfinite(film_pressure[0]);
  return (SbContactProfile){
      .count = count,
      .x = rows,
      .pressure = rows + count,
      .film = rows + 2 * count,
      .asperity_pressure = rows + 3 * count,
      .model = model,
      .film_pressure = solved ? film_pressure : NULL,
      .film_model = solved ? "reynolds" : model,
  };
}

// Contact pressure of the fitment at x, by straight lines; the fluid's outside the contact.
static double fit_pressure(const SbFit *fit, double x, double left, double right) {
  size_t n = fit->profile_count;
  if (n < 2 || x <= fit->profile_x[0]) {
    return left;
  }
  if (x >= fit->profile_x[n - 1]) {
    return right;
  }
  size_t low = sb_interval(fit->profile_x, n, x), high = low + 1;
  double span = fit->profile_x[high] - fit->profile_x[low];
  double t = span > 0 ? (x - fit->profile_x[low]) / span : 0;
  return fit->profile_p[low] + t * (fit->profile_p[high] - fit->profile_p[low]);
}

// Pressure of Greenwood and Tripp's asperities at the local film (thesis equation 5.12). The film
// still carries this load too (sliding.h): the pressure is shown in addition to the film's.
static void asperity_pressure(const SbModel *model, int seal, const double *film, double *out,
                              size_t n) {
  double last = NAN;
  double pressure = 0;
  for (size_t i = 0; i < n; i++) {
    // F_5/2 changes by less than 2e-4 over this step; the flat of the film then costs one integral.
    double lambda = film[i] / model->sigma;
    if (!(fabs(lambda - last) < 1e-4)) {
      pressure = sb_gt_pressure(model->gt_product, model->sigma_over_beta,
                                model->seal[seal].reduced_modulus, lambda);
      last = lambda;
    }
    out[i] = pressure;
  }
}

// Contact pressure of the fitment at the points x. Between them the fitment's peak may fall: the
// curve is stretched, by less than 1e-3 for 100 points in the contact, so that its maximum is the
// peak that every other surface reports. The fluid's pressure acts where the fitment's is below it.
static void contact_pressure(double *out, const SbFit *fit, const double *x, size_t n, double left,
                             double right) {
  const double middle = (fit->contact_left + fit->contact_right) / 2;
  double largest = 0;
  for (size_t i = 0; i < n; i++) {
    out[i] = fit_pressure(fit, x[i], left, right);
    largest = fmax(largest, out[i]);
  }
  const double factor = largest > fmax(left, right) ? fit->pressure_peak / largest : 1;
  for (size_t i = 0; i < n; i++) {
    out[i] = fmax(factor * out[i], x[i] < middle ? left : right);
  }
}

// Writes the points of a solved film. `scale`: those of the half-plane, from its contact to the
// fitted one of the middle `middle` and the half-width `half` [m].
static size_t film_rows(double *x, double *pressure, double *h, const SbFilm *film, double low,
                        bool scale, double middle, double half) {
  const double stretch = half / film->hertz_half_width;
  for (size_t i = 0; i < film->points; i++) {
    x[i] = scale ? middle + stretch * film->x[i] : film->x[i];
    pressure[i] = film->pressure[i] - low;
    h[i] = film->film[i];
  }
  return film->points;
}

// Writes x and the film of a fitted contact without a solved film to `x` and `h`: points on both
// sides of the contact and those of the fit between them. Returns their number.
static size_t dry_rows(double *x, double *h, const SbRun *run, int seal, const SbFit *fit,
                       double film) {
  const SbContactLaw *law = sb_contact_law(run->model);
  const double middle = (fit->contact_left + fit->contact_right) / 2, a = fit->contact_width / 2;
  size_t n = 0;
  for (int i = -OUTSIDE_POINTS; i <= OUTSIDE_POINTS; i++) {
    double xi = 1 + pow(i / (double)OUTSIDE_POINTS, 2);
    for (size_t k = 0; i == 0 && k < fit->profile_count; k++) {
      x[n] = fit->profile_x[k];
      h[n++] = film;
    }
    if (i != 0) {
      x[n] = middle + copysign(xi * a, i);
      h[n++] = film + law->dry_gap(run->model, seal, xi, a);
    }
  }
  return n;
}

// Writes the pressure of a gasket's asperities: that of the contact `p` above the fluid's.
static SbStatus edge_asperities(double *out, const double *x, const double *p, size_t n,
                                SbSealPressure pressure, const SbRun *run, int seal,
                                double central_film, double middle, SbReport *report) {
  const double low = fmin(pressure.left, pressure.right);
  for (size_t i = 0; i < n; i++) {
    const double fluid = (x[i] < middle ? pressure.left : pressure.right) - low;
    out[i] = fmax(p[i] - fluid, 0);
  }
  return sb_sliding_edge_asperities(out, out, n, run->model, seal, central_film, report);
}

// Puts rows that are `capacity` apart next to each other, and replaces the profile by them.
static void store_profile(SbRunProfile *profile, double *x, size_t n, size_t capacity,
                          const SbModel *model) {
  free(profile->data);
  profile->data = x;
  for (size_t row = 1; row < SB_PROFILE_ROWS && n < capacity; row++) {
    memmove(x + row * n, x + row * capacity, n * sizeof *x);
  }
  profile->view = sb_run_profile_view(x, n, sb_fit_kind(model->fit)->name);
}

SbStatus sb_run_make_profile(SbRun *run, int seal, int chamber, int motion, SbSealPressure pressure,
                             const SbSealState *state, SbReport *report) {
  SbRunProfile *profile = &run->profile[sb_run_profile_slot(seal, chamber, motion)];
  const SbFit *fit = sb_sliding_fit(run->memory[seal]);
  const SbFilm *film = sb_sliding_film(run->memory[seal]);
  const SbContactLaw *law = sb_contact_law(run->model);
  bool solved = sb_contact_solves_film(run->model) && state->film_central > 0;
  bool fitted = state->touches && isfinite(state->load);
  const bool own_pressure = sb_fit_kind(run->model->fit)->points;
  // No film on the fitted body: the half-plane's is scaled from its contact to the fitted one.
  const bool scaled = solved && own_pressure && !state->film_fitted;
  size_t capacity = solved ? film->points : (size_t)PROFILE_POINTS, n = 0;
  double *x = calloc(SB_PROFILE_ROWS * capacity, sizeof *x);
  if (x == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a profile");
  }
  double *p = x + capacity, *h = x + 2 * capacity, *asperities = x + 3 * capacity;
  double *film_pressure = x + 4 * capacity;
  const double low = fmin(pressure.left, pressure.right);
  const double left = pressure.left - low, right = pressure.right - low;
  const double middle = (fit->contact_left + fit->contact_right) / 2, a = fit->contact_width / 2;
  if (solved) {
    n = film_rows(x, film_pressure, h, film, low, scaled, middle, a);
    if (fitted) {
      contact_pressure(p, fit, x, n, left, right);
    } else {
      memcpy(p, film_pressure, n * sizeof *p);
    }
  } else if (fitted) {
    n = dry_rows(x, h, run, seal, fit, state->film_central);
    contact_pressure(p, fit, x, n, left, right);
  }
  for (size_t i = 0; !solved && i < n; i++) {
    film_pressure[i] = NAN;
  }
  if (solved && law->shares) {
    memcpy(asperities, film->asperity_pressure, n * sizeof *asperities);
  } else if (law->closed_film && fitted) {
    SbStatus status = edge_asperities(asperities, x, p, n, pressure, run, seal, state->film_central,
                                      middle, report);
    if (status != SB_OK) {
      free(x);
      return status;
    }
  } else if (fitted && sb_rough_kind(run->model->surface)->asperities) {
    asperity_pressure(run->model, seal, h, asperities, n);
  }
  store_profile(profile, x, n, capacity, run->model);
  return SB_OK;
}
