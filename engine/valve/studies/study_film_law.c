// The film as a power law of speed and load, regressed on our own coupled solutions, beside the
// thesis' (eq. 7.5), Karaszkiewicz' (eq. 7.6) and the exact limit of thin films.
//
//   h/R = k U^beta W^alpha,   U = eta (u/2)/(E' R),  W = w/(E' R)
//
// over the range study.speed_* and study.load_* of the outer seal, on a grid even in ln U and ln W
// (film/laws.h: least squares of the logarithms, 95 % confidence by Student's t; the residuals
// are the law's lack of fit, not noise). What the thesis' exponent 0.5434 is: a mesh that is too
// coarse at low speed (docs/thesis.md, 3); solved in the mesh it is 0.6.
#include "engine/film/laws.h"
#include "engine/valve/studies/study_private.h"

#include <math.h>

enum { SPEEDS = 14, LOADS = 5, CURVE = 41, GIVEN = 4, DRAWN = 3, GRID = SPEEDS * LOADS };
enum { CENTRAL, LEAST, FILMS };

// A line of the study is a load of the grid, or the outer seal's own behind them.
enum { MIDDLE = LOADS / 2, OWN = LOADS };

static const struct {
  const char *name;
  SbFilmLaw law;
  int film; // that it gives
} given[GIVEN] = {
    {"thesis, eq. 7.5", {.k = 1.492, .a = 0.5434, .b = -0.2893}, CENTRAL},
    {"Karaszkiewicz, eq. 7.6", {.k = 4.4, .a = 0.65, .b = -0.21}, CENTRAL},
    {"thin-film limit", {.k = 3.77334, .a = 0.6, .b = -0.2}, CENTRAL},
    {"thin-film limit, least", {.k = 3.00434, .a = 0.6, .b = -0.2}, LEAST},
};

// A seal's numbers: U per speed [s/m], W per load [m/N], the length of h/R [m].
typedef struct {
  double U, W, R;
} Scale;

static Scale scale_of(const SbModel *model) {
  const SbSealModel *seal = &model->seal[SB_OUTER];
  double unit = seal->reduced_modulus * seal->radius;
  return (Scale){model->viscosity / 2 / unit, 1 / unit, seal->radius};
}

static double load_of(const SbStudyWork *work, int line) {
  const SbStudyRange *range = &work->scene->study;
  double t = line / (LOADS - 1.0);
  return line == OWN ? work->load : range->load_min * pow(range->load_max / range->load_min, t);
}

// The solutions, and the laws they give.
typedef struct {
  double U[GRID], W[GRID], H[FILMS][GRID];
  SbFilmLaw law[FILMS];
} Regression;

// Films at a speed. The laws are those of an isoviscous fluid without end pressure.
static void solve(double *value, SbStudyWork *work, int line, double speed) {
  SbFilmProblem problem;
  SbReport report;
  sb_study_film_problem(&problem, work, load_of(work, line), speed);
  if (line != OWN) {
    problem.pressure_viscosity = problem.eyring_stress = problem.rupture_pressure = 0;
  }
  SbStatus status = sb_study_film(work, &problem, &report);
  bool good = sb_study_goes_on(work, status, &report);
  value[CENTRAL] = good ? work->film.film_central : NAN;
  value[LEAST] = good ? work->film.film_min : NAN;
}

static bool regress(Regression *out, SbStudyWork *work) {
  const Scale scale = scale_of(work->scene);
  SbReport report;
  for (int i = 0; i < GRID; i++) {
    double speed = sb_study_place(work, i % SPEEDS, SPEEDS);
    const double *film = sb_study_at(work, i / SPEEDS, speed);
    out->U[i] = speed * scale.U;
    out->W[i] = load_of(work, i / SPEEDS) * scale.W;
    out->H[CENTRAL][i] = film[CENTRAL] / scale.R;
    out->H[LEAST][i] = film[LEAST] / scale.R;
  }
  for (int f = 0; f < FILMS && work->status == SB_OK; f++) {
    SbStatus status = sb_film_law_fit(&out->law[f], out->U, out->W, out->H[f], GRID, &report);
    (void)sb_study_goes_on(work, status, &report);
  }
  return work->status == SB_OK;
}

static void draw(SbStudyWork *work, const Regression *ours) {
  SbStudyPanel *film = &work->out->panel[0], *ratio = &work->out->panel[1];
  SbStudyPanel *residual = &work->out->panel[2];
  const Scale scale = scale_of(work->scene);
  const double W = load_of(work, MIDDLE) * scale.W;
  SbStudySeries *dots = sb_study_series(film, SB_STUDY_DOTS, "solved");
  for (int l = 0; l <= DRAWN; l++) {
    const SbFilmLaw *law = l == 0 ? &ours->law[CENTRAL] : &given[l - 1].law;
    SbStudyStyle style = l == 0 ? SB_STUDY_CURVE : SB_STUDY_REFERENCE;
    SbStudySeries *line = sb_study_series(film, style, l == 0 ? "our law" : given[l - 1].name);
    SbStudySeries *over = sb_study_series(ratio, style, line->name);
    for (int i = 0; i < CURVE; i++) {
      double speed = sb_study_place(work, i, CURVE);
      sb_study_point(line, speed, scale.R * sb_film_law(law, speed * scale.U, W));
    }
    for (int i = 0; i < SPEEDS; i++) {
      double speed = sb_study_place(work, i, SPEEDS);
      double solved = sb_study_at(work, MIDDLE, speed)[CENTRAL];
      if (l == 0) {
        sb_study_point(dots, speed, solved);
      }
      sb_study_point(over, speed, scale.R * sb_film_law(law, speed * scale.U, W) / solved);
    }
  }
  for (int j = 0; j < LOADS; j += (LOADS - 1) / 2) {
    char name[40];
    sb_text(name, sizeof name, "%.0f N/m", load_of(work, j));
    SbStudySeries *line = sb_study_series(residual, SB_STUDY_CURVE, name);
    for (int k = j * SPEEDS; k < (j + 1) * SPEEDS; k++) {
      sb_study_point(
          line, ours->U[k] / scale.U,
          ours->H[CENTRAL][k] / sb_film_law(&ours->law[CENTRAL], ours->U[k], ours->W[k]) - 1);
    }
  }
}

// A law, and how far the solutions are from it: solved/law - 1.
static void put_row(SbStudyWork *work, const Regression *ours, const char *name,
                    const SbFilmLaw *law, int film) {
  const Scale scale = scale_of(work->scene);
  double *value = sb_study_row(work->out, "%s", name)->value, squares = 0, largest = 0;
  for (int i = 0; i < GRID; i++) {
    double miss = ours->H[film][i] / sb_film_law(law, ours->U[i], ours->W[i]) - 1;
    squares += miss * miss;
    largest = fmax(largest, fabs(miss));
  }
  value[0] = law->k;
  value[2] = law->a;
  value[4] = law->b;
  if (law == &ours->law[film]) {
    value[1] = law->k_confidence;
    value[3] = law->a_confidence;
    value[5] = law->b_confidence;
  }
  value[6] = sqrt(squares / GRID);
  value[7] = largest;
  value[8] = scale.R * sb_film_law(law, work->scene->speed * scale.U, work->load * scale.W);
}

static void make(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  const SbStudyRange *range = &model->study;
  const SbSealModel *seal = &model->seal[SB_OUTER];
  const Scale scale = scale_of(model);
  // The scene's own point: the net load of its outer seal at the drive's speed.
  double own = sb_study_net_load(work);
  work->load = own > 0 ? own : load_of(work, MIDDLE);
  Regression ours;
  const double *film = sb_study_at(work, OWN, model->speed);
  if (!regress(&ours, work)) {
    return;
  }
  draw(work, &ours);
  put_row(work, &ours, "ours, central", &ours.law[CENTRAL], CENTRAL);
  put_row(work, &ours, "ours, least", &ours.law[LEAST], LEAST);
  for (int l = 0; l < GIVEN; l++) {
    put_row(work, &ours, given[l].name, &given[l].law, given[l].film);
  }
  sb_study_row(out, "solved, central")->value[8] = film[CENTRAL];
  sb_study_row(out, "solved, least")->value[8] = film[LEAST];
  sb_study_mark_scene(work, model->speed, "drive");
  sb_text(out->validity, sizeof out->validity,
          "our law: U %.2g to %.2g, W %.3g to %.3g only; the limit: thin films (M above 100)",
          work->lo * scale.U, work->hi * scale.U, range->load_min * scale.W,
          range->load_max * scale.W);
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
    .x = {"sliding speed", "m/s", "mm/s", true},
    .panel = {{"central film", "m", "nm", true},
              {"law over the solved film", "1", "", true},
              {"solved against our law", "1", "%", false}},
    .range = offsetof(SbStudyRange, speed_min),
    .row_heading = "h/R = k U^\xce\xb2 W^\xce\xb1",
    .column = {{"k", "1", "", 4},
               {"\xc2\xb1 of k", "1", "%", 3},
               {"\xce\xb2 of U", "1", "", 4},
               {"\xc2\xb1 of \xce\xb2", "1", "", 3},
               {"\xce\xb1 of W", "1", "", 4},
               {"\xc2\xb1 of \xce\xb1", "1", "", 3},
               {"residual, rms", "1", "%", 3},
               {"residual, largest", "1", "%", 3},
               {"film at the drive's speed", "m", "nm", 3}},
    .models = "reynolds, half-plane, smooth, isoviscous; thesis eq. 7.5; Karaszkiewicz eq. 7.6; "
              "exact limit",
    .solves = {.reynolds = GRID + 2},
    .solve = solve,
    .make = make,
};
