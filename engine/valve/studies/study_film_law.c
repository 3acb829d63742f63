// The film as a power law of speed and load, regressed on our own coupled solutions, compared with
// the thesis' law (eq. 7.5), Karaszkiewicz' (eq. 7.6) and the exact limit of thin films.
//
//   h/R = k U^beta W^alpha,   U = eta (u/2)/(E' R),  W = w/(E' R)
//
// over the range study.speed_* and study.load_* of the outer seal, on a grid even in ln U and ln W
// (least squares of the logarithms, 95 % confidence by Student's t; the residuals are the law's
// lack of fit, not noise). The thesis' exponent 0.5434 results from a mesh that is too coarse at
// low speed (docs/thesis.md, 3); with a resolved mesh it is 0.6.
//
// Not a grid of valves: the load of these films is given, not that of a ring.
#include "engine/valve/studies/study_private.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multifit.h>
#include <math.h>

enum { SPEEDS = SB_FILM_LAW_SPEEDS, LOADS = SB_FILM_LAW_LOADS, CURVE = 41, GRID = SPEEDS * LOADS };
enum { CENTRAL, LEAST, FILMS };
enum { GIVEN = 4, LAWS = FILMS + GIVEN }; // ours first

// A line of the study is a load of the grid, or the outer seal's own behind them.
enum { MIDDLE = LOADS / 2, OWN = LOADS };

// A law of one of the films.
typedef struct {
  const char *name;
  int film;
  SbFilmLaw law;
} Law;

// The solutions and the laws, ours regressed on them; the outer seal's numbers: U per speed [s/m],
// W per load [m/N], the length of h/R [m].
typedef struct {
  double speed[GRID], U[GRID], W[GRID], H[FILMS][GRID];
  double U_speed, W_load, R;
  Law laws[LAWS];
} Regression;

static double load_of(const SbStudyWork *work, int line) {
  const SbStudyRange *range = &work->scene->study;
  double t = line / (LOADS - 1.0);
  return line == OWN ? work->load : range->load_min * pow(range->load_max / range->load_min, t);
}

// Films at a speed. The laws are those of an isoviscous fluid without end pressure.
static void solve(double *value, SbStudyWork *work, int line, double speed) {
  SbFilmProblem problem;
  SbReport report;
  sb_study_film_problem(&problem, work, load_of(work, line), speed);
  if (line != OWN) {
    problem.pressure_viscosity = problem.eyring_stress = problem.rupture_pressure = 0;
  }
  SbStatus status = sb_study_film(work, &problem, &report);
  if (sb_study_goes_on(work, status, &report)) {
    value[CENTRAL] = work->film.film_central;
    value[LEAST] = work->film.film_min;
  }
}

SbStatus sb_study_fit_law(SbFilmLaw *out, const double *U, const double *W, const double *H,
                          size_t count, SbReport *report) {
  double rows[SB_STUDY_LAW_POINTS][3], ln_H[SB_STUDY_LAW_POINTS], c[3], covariance[3][3], chi2;
  bool sane = count >= 3 && count <= SB_STUDY_LAW_POINTS;
  for (size_t i = 0; sane && i < count; i++) {
    rows[i][0] = 1.0;
    rows[i][1] = log(U[i]);
    rows[i][2] = log(W[i]);
    ln_H[i] = log(H[i]);
    sane = isfinite(rows[i][1]) && isfinite(rows[i][2]) && isfinite(ln_H[i]);
  }
  if (!sane) {
    return sb_fail(report, SB_ERROR_RANGE, "film law: 3 to %d films are wanted, all above zero",
                   SB_STUDY_LAW_POINTS);
  }
  gsl_matrix_view X = gsl_matrix_view_array(&rows[0][0], count, 3);
  gsl_vector_view y = gsl_vector_view_array(ln_H, count);
  gsl_vector_view coefficients = gsl_vector_view_array(c, 3);
  gsl_matrix_view spread = gsl_matrix_view_array(&covariance[0][0], 3, 3);
  gsl_multifit_linear_workspace *work = gsl_multifit_linear_alloc(count, 3);
  if (work == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "film law: out of memory");
  }
  const int failed =
      gsl_multifit_linear(&X.matrix, &y.vector, &coefficients.vector, &spread.matrix, &chi2, work);
  gsl_multifit_linear_free(work);
  if (failed != 0) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "film law: the regression failed");
  }
  double quantile = count > 3 ? gsl_cdf_tdist_Pinv(0.975, (double)(count - 3)) : 0.0;
  *out = (SbFilmLaw){.k = exp(c[0]),
                     .a = c[1],
                     .b = c[2],
                     .k_confidence = quantile * sqrt(covariance[0][0]),
                     .a_confidence = quantile * sqrt(covariance[1][1]),
                     .b_confidence = quantile * sqrt(covariance[2][2])};
  return sb_succeed(report);
}

static Regression regress(SbStudyWork *work) {
  const SbSealModel *seal = &work->scene->seal[SB_OUTER];
  const double unit = seal->reduced_modulus * seal->radius;
  Regression out = {
      .U_speed = work->scene->viscosity / 2 / unit,
      .W_load = 1 / unit,
      .R = seal->radius,
      .laws = {{SB_LABEL("ours, central"), CENTRAL, {.k = 0}},
               {SB_LABEL("ours, minimum"), LEAST, {.k = 0}},
               {SB_LABEL("thesis, eq. 7.5"), CENTRAL, {.k = 1.492, .a = 0.5434, .b = -0.2893}},
               {"Karaszkiewicz, eq. 7.6", CENTRAL, {.k = 4.4, .a = 0.65, .b = -0.21}},
               {SB_LABEL("thin-film limit"), CENTRAL, {.k = 3.77334, .a = 0.6, .b = -0.2}},
               {SB_LABEL("thin-film limit, minimum"), LEAST, {.k = 3.00434, .a = 0.6, .b = -0.2}}}};
  SbReport report;
  for (int i = 0; i < GRID; i++) {
    out.speed[i] = sb_study_place(work, i % SPEEDS, SPEEDS);
    out.U[i] = out.speed[i] * out.U_speed;
    out.W[i] = load_of(work, i / SPEEDS) * out.W_load;
    for (int f = 0; f < FILMS; f++) {
      out.H[f][i] = sb_study_at(work, i / SPEEDS, out.speed[i])[f] / out.R;
    }
  }
  for (int f = 0; f < FILMS && work->status == SB_OK; f++) {
    SbStatus status = sb_study_fit_law(&out.laws[f].law, out.U, out.W, out.H[f], GRID, &report);
    (void)sb_study_goes_on(work, status, &report);
  }
  return out;
}

// Returns the ratio of a solution of the grid to a law's film.
static double over_law(const Regression *ours, const Law *law, int i) {
  return ours->H[law->film][i] / sb_film_law(&law->law, ours->U[i], ours->W[i]);
}

static void draw(SbStudyWork *work, const Regression *ours) {
  SbStudyPanel *panel = work->out->panel;
  const double W = load_of(work, MIDDLE) * ours->W_load;
  SbStudySeries *dots = sb_study_series(&panel[0], SB_STUDY_DOTS, SB_LABEL("solved"));
  for (int i = MIDDLE * SPEEDS; i < (MIDDLE + 1) * SPEEDS; i++) {
    sb_study_point(dots, ours->speed[i], ours->R * ours->H[CENTRAL][i]);
  }
  for (const Law *law = ours->laws; law < ours->laws + LAWS; law++) {
    if (law->film != CENTRAL) {
      continue;
    }
    const bool own = law == ours->laws;
    SbStudyStyle style = own ? SB_STUDY_CURVE : SB_STUDY_REFERENCE;
    SbStudySeries *line = sb_study_series(&panel[0], style, own ? SB_LABEL("our law") : law->name);
    for (int i = 0; i < CURVE; i++) {
      double speed = sb_study_place(work, i, CURVE);
      sb_study_point(line, speed, ours->R * sb_film_law(&law->law, speed * ours->U_speed, W));
    }
    SbStudySeries *over = sb_study_series(&panel[1], style, line->name);
    for (int i = MIDDLE * SPEEDS; i < (MIDDLE + 1) * SPEEDS; i++) {
      sb_study_point(over, ours->speed[i], 1 / over_law(ours, law, i));
    }
  }
  for (int j = 0; j < LOADS; j += (LOADS - 1) / 2) {
    char name[40];
    sb_text(name, sizeof name, "%.0f N/m", load_of(work, j));
    SbStudySeries *line = sb_study_series(&panel[2], SB_STUDY_CURVE, name);
    for (int k = j * SPEEDS; k < (j + 1) * SPEEDS; k++) {
      sb_study_point(line, ours->speed[k], over_law(ours, &ours->laws[CENTRAL], k) - 1);
    }
  }
}

// A law, and how far the solutions are from it: solved/law - 1.
static void put_row(SbStudyWork *work, const Regression *ours, const Law *row) {
  const SbFilmLaw *law = &row->law;
  double *value = sb_study_row(work->out, "%s", row->name)->value, squares = 0, largest = 0;
  for (int i = 0; i < GRID; i++) {
    double miss = over_law(ours, row, i) - 1;
    squares += miss * miss;
    largest = fmax(largest, fabs(miss));
  }
  value[0] = law->k;
  value[2] = law->a;
  value[4] = law->b;
  if (row < ours->laws + FILMS) {
    value[1] = law->k_confidence;
    value[3] = law->a_confidence;
    value[5] = law->b_confidence;
  }
  value[6] = sqrt(squares / GRID);
  value[7] = largest;
  value[8] =
      ours->R * sb_film_law(law, work->scene->speed * ours->U_speed, work->load * ours->W_load);
}

static void make(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  const SbStudyRange *range = &model->study;
  const SbSealModel *seal = &model->seal[SB_OUTER];
  // The scene's own point: the net load of its outer seal at the drive's speed.
  double own = sb_study_net_load(work);
  work->load = own > 0 ? own : load_of(work, MIDDLE);
  const double *film = sb_study_at(work, OWN, model->speed);
  const Regression ours = regress(work);
  if (work->status != SB_OK) {
    return;
  }
  draw(work, &ours);
  for (int l = 0; l < LAWS; l++) {
    put_row(work, &ours, &ours.laws[l]);
  }
  sb_study_row(out, SB_LABEL("solved, central"))->value[8] = film[CENTRAL];
  sb_study_row(out, SB_LABEL("solved, minimum"))->value[8] = film[LEAST];
  sb_study_mark(work, model->speed, SB_LABEL("drive"));
  sb_message(out->validity, sizeof out->validity,
             "our law: U %.2g to %.2g, W %.3g to %.3g only; the limit: thin films (M above 100)",
             work->lo * ours.U_speed, work->hi * ours.U_speed, range->load_min * ours.W_load,
             range->load_max * ours.W_load);
  sb_study_note(out,
                "U = \xce\xb7 (u/2)/(E' R), W = w/(E' R); R %.4g mm, E' %.4g MPa, \xce\xb7 %.4g "
                "mPa s. \xc2\xb1: 95 %% confidence in this range. Curves at %.0f N/m.",
                seal->radius * 1e3, seal->reduced_modulus * 1e-6, model->viscosity * 1e3,
                load_of(work, MIDDLE));
  sb_study_note(out,
                "Last column: at %.4g mm/s and the outer seal's %.0f N/m. Residuals of the given "
                "laws are against the same %d solutions.",
                model->speed * 1e3, work->load, GRID);
}

const SbStudyDesign sb_study_film_law = {
    .x = SB_QUANTITY("sliding speed", "mm/s"),
    .x_logarithmic = true,
    .panel = {SB_QUANTITY("central film", "nm"), SB_LABEL("law over the solved film"),
              SB_QUANTITY("solved against our law", "%")},
    .logarithmic = {true, true, false},
    .range = offsetof(SbStudyRange, speed_min),
    .row_heading = "h/R = k U^\xce\xb2 W^\xce\xb1",
    .column = {"k", "\xc2\xb1 of k [%]", "\xce\xb2 of U", "\xc2\xb1 of \xce\xb2", "\xce\xb1 of W",
               "\xc2\xb1 of \xce\xb1", SB_QUANTITY("residual, rms", "%"),
               SB_QUANTITY("residual, largest", "%"),
               SB_QUANTITY("film at the drive's speed", "nm")},
    .digits = {4, 3, 4, 3, 4, 3, 3, 3, 3},
    .models = "reynolds, half-plane, smooth, isoviscous; thesis eq. 7.5; Karaszkiewicz eq. 7.6; "
              "exact limit",
    .solve = solve,
    .make = make,
};
