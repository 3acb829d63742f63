// The film as a power law of speed and load, regressed on our own coupled solutions, beside the
// thesis' (eq. 7.5), Karaszkiewicz' (eq. 7.6) and the exact limit of thin films.
//
//   h/R = k U^beta W^alpha,   U = eta (u/2)/(E' R),  W = w/(E' R)
//
// over the range study.speed_* and study.load_* of the outer seal, on a grid even in ln U and ln W
// (film/law_fit.h: least squares of the logarithms, 95 % confidence by Student's t; the residuals
// are the law's lack of fit, not noise). What the thesis' exponent 0.5434 is: a mesh that is too
// coarse at low speed (docs/thesis.md, 3); solved in the mesh it is 0.6.
#include "engine/film/film.h"
#include "engine/film/law_fit.h"
#include "engine/valve/sliding.h"
#include "engine/valve/studies/study_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SPEEDS = 14, LOADS = 5, CURVE = 41, FITS = 2, GIVEN = 4, LAWS = FITS + GIVEN };

typedef struct {
  const char *name;
  double k, beta, alpha;
  bool least; // of the least film, else of the central one
} Law;

// Ours first, to be fitted; of the others those for the central film are drawn.
static const Law laws[LAWS] = {
    {"ours, central", NAN, NAN, NAN, false},
    {"ours, least", NAN, NAN, NAN, true},
    {"thesis, eq. 7.5", 1.492, 0.5434, -0.2893, false},
    {"Karaszkiewicz, eq. 7.6", 4.4, 0.65, -0.21, false},
    {"thin-film limit", 3.77334, 0.6, -0.2, false},
    {"thin-film limit, least", 3.00434, 0.6, -0.2, true},
};

// The laws in a seal's units.
typedef struct {
  double U_per_speed, W_per_load, radius; // [s/m], [m/N], and the length of h/R [m]
  Law law[LAWS];
  SbFilmLaw fit[FITS]; // of the central film, of the least one
} Laws;

static double law_film(const Laws *all, int law, double speed, double load) {
  const Law *of = &all->law[law];
  return all->radius * of->k * pow(speed * all->U_per_speed, of->beta) *
         pow(load * all->W_per_load, of->alpha);
}

// Passes the progress of one regression on as its part of the study.
typedef struct {
  SbStudyWork *work;
  double from;
} Part;

static const double share = 0.95 / FITS;

static void on_progress(void *data, double fraction) {
  const Part *part = data;
  sb_study_step(part->work, part->from + share * fraction);
}

static bool is_cancelled(void *data) {
  const Part *part = data;
  return part->work->status != SB_OK;
}

static void regress(SbStudyWork *work, Laws *all) {
  SbStudy *out = work->out;
  const SbStudyRange *range = &work->scene->study;
  memcpy(all->law, laws, sizeof laws);
  for (int f = 0; work->status == SB_OK && f < FITS; f++) {
    SbFilmLaw *fit = &all->fit[f];
    Part part = {work, share * f};
    SbReport report;
    SbFilmLawRange grid = {
        .film = laws[f].least ? SB_FILM_LAW_MIN : SB_FILM_LAW_CENTRAL,
        .U_min = range->speed_min * all->U_per_speed,
        .U_max = range->speed_max * all->U_per_speed,
        .W_min = range->load_min * all->W_per_load,
        .W_max = range->load_max * all->W_per_load,
        .U_count = SPEEDS,
        .W_count = LOADS,
        .tolerance = work->scene->tolerance,
        .cancelled = is_cancelled,
        .progress = on_progress,
        .data = &part,
    };
    (void)sb_study_goes_on(work, sb_film_law_fit(fit, &grid, &report), &report);
    all->law[f] = (Law){laws[f].name, fit->k, fit->a, fit->b, laws[f].least};
    out->solves += fit->count;
    out->error = fmax(out->error, fit->error);
  }
}

// The film solved at one speed and load.
static bool solve_film(SbStudyWork *work, SbFilm *film, double speed, double load) {
  SbFilmProblem problem;
  SbReport report;
  sb_sliding_film_problem(&problem, work->scene, SB_OUTER, (SbSealPressure){0, 0}, load, speed);
  problem.cancelled = work->hooks.cancelled;
  problem.cancelled_data = work->hooks.data;
  SbStatus status = sb_film_solve(film, &problem, NULL, &report);
  work->out->solves++;
  work->out->error = fmax(work->out->error, film->solver.error_film_central);
  return sb_study_goes_on(work, status, &report);
}

static void draw(SbStudyWork *work, const Laws *all, double middle) {
  SbStudyPanel *film = &work->out->panel[0], *ratio = &work->out->panel[1];
  SbStudyPanel *residual = &work->out->panel[2];
  const SbFilmLaw *central = &all->fit[0];
  // Solved at the middle load: the grid's middle row.
  SbStudySeries *dots = sb_study_series(film, SB_STUDY_DOTS, "solved");
  for (size_t i = LOADS / 2 * SPEEDS; i < (LOADS / 2 + 1) * SPEEDS; i++) {
    sb_study_point(dots, central->U[i] / all->U_per_speed, central->H[i] * all->radius);
  }
  for (int l = 0; l < LAWS; l++) {
    if (laws[l].least) {
      continue;
    }
    SbStudyStyle style = l == 0 ? SB_STUDY_CURVE : SB_STUDY_REFERENCE;
    SbStudySeries *line = sb_study_series(film, style, l == 0 ? "our law" : laws[l].name);
    SbStudySeries *over = sb_study_series(ratio, style, line->name);
    for (int i = 0; i < CURVE; i++) {
      double speed = sb_study_place(work, i, CURVE);
      sb_study_point(line, speed, law_film(all, l, speed, middle));
    }
    for (size_t i = 0; i < dots->count; i++) {
      sb_study_point(over, dots->x[i], law_film(all, l, dots->x[i], middle) / dots->y[i]);
    }
  }
  for (size_t j = 0; j < LOADS; j += (LOADS - 1) / 2) {
    char name[40];
    sb_text(name, sizeof name, "%.0f N/m", central->W[j * SPEEDS] / all->W_per_load);
    SbStudySeries *line = sb_study_series(residual, SB_STUDY_CURVE, name);
    for (size_t k = j * SPEEDS; k < (j + 1) * SPEEDS; k++) {
      sb_study_point(line, central->U[k] / all->U_per_speed, central->residual[k]);
    }
  }
}

// A law, and how far the solutions are from it: solved/law - 1.
static void put_row(SbStudy *out, const Laws *all, int l, double speed, double load) {
  const Law *law = &all->law[l];
  const SbFilmLaw *solved = &all->fit[law->least ? 1 : 0];
  double *value = sb_study_row(out, "%s", law->name)->value, squares = 0;
  value[7] = 0;
  for (size_t i = 0; i < solved->count; i++) {
    double h = law->k * pow(solved->U[i], law->beta) * pow(solved->W[i], law->alpha);
    double miss = solved->H[i] / h - 1;
    squares += miss * miss;
    value[7] = fmax(value[7], fabs(miss));
  }
  value[0] = law->k;
  value[2] = law->beta;
  value[4] = law->alpha;
  if (l < FITS) {
    value[1] = solved->k_confidence;
    value[3] = solved->a_confidence;
    value[5] = solved->b_confidence;
  }
  value[6] = sqrt(squares / (double)solved->count);
  value[8] = law_film(all, l, speed, load);
}

static void make_with(SbStudyWork *work, Laws *all, SbFilm *film) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  const SbStudyRange *range = &model->study;
  const double middle = sqrt(range->load_min * range->load_max), speed = model->speed;
  regress(work, all);
  // The scene's own point: the net load of its outer seal at the drive's speed, without end
  // pressure as the laws have it.
  work->total = INFINITY; // this question is no measure of the progress
  sb_study_fix_machine(work);
  double own = sb_study_net_load(work);
  double load = own > 0 ? own : middle;
  if (work->status != SB_OK || !solve_film(work, film, speed, load)) {
    return;
  }
  draw(work, all, middle);
  for (int l = 0; l < LAWS; l++) {
    put_row(out, all, l, speed, load);
  }
  sb_study_row(out, "solved, central")->value[8] = film->film_central;
  sb_study_row(out, "solved, least")->value[8] = film->film_min;
  sb_study_mark_scene(work, speed, "drive");
  sb_text(out->validity, sizeof out->validity,
          "our law: U %.2g to %.2g, W %.3g to %.3g only; the limit: thin films (M above 100)",
          range->speed_min * all->U_per_speed, range->speed_max * all->U_per_speed,
          range->load_min * all->W_per_load, range->load_max * all->W_per_load);
  const SbSealModel *seal = &model->seal[SB_OUTER];
  sb_study_note(out,
                "U = \xce\xb7 (u/2)/(E' R), W = w/(E' R); R %.4g mm, E' %.4g MPa, \xce\xb7 %.4g "
                "mPa s. \xc2\xb1: 95 %% confidence in this range. Curves at %.0f N/m.",
                seal->radius * 1e3, seal->reduced_modulus * 1e-6, model->viscosity * 1e3, middle);
  sb_study_note(out,
                "Last column: at %.4g mm/s and the outer seal's %.0f N/m. Residuals of the given "
                "laws are against the same %zu solutions.",
                speed * 1e3, load, all->fit[0].count);
}

static void make(SbStudyWork *work) {
  const SbSealModel *seal = &work->scene->seal[SB_OUTER];
  const double unit = seal->reduced_modulus * seal->radius;
  Laws *all = calloc(1, sizeof *all);
  SbFilm *film = calloc(1, sizeof *film);
  if (all == NULL || film == NULL) {
    work->status = sb_fail(work->report, SB_ERROR_MEMORY, "no memory for a study");
  } else {
    all->U_per_speed = work->scene->viscosity / 2 / unit;
    all->W_per_load = 1 / unit;
    all->radius = seal->radius;
    make_with(work, all, film);
  }
  free(film);
  free(all);
}

const SbStudyDesign sb_study_film_law = {
    .x = {"sliding speed", "m/s", "mm/s", true},
    .panel = {{"central film", "m", "nm", true},
              {"law over the solved film", "1", "", true},
              {"solved against our law", "1", "%"}},
    .range = offsetof(SbStudyRange, speed_min),
    .row_heading = "h/R = k U^\xce\xb2 W^\xce\xb1",
    .column = {{"k", "1", "", 4},
               {"\xc2\xb1 of k", "1", "%"},
               {"\xce\xb2 of U", "1", "", 4},
               {"\xc2\xb1 of \xce\xb2", "1", ""},
               {"\xce\xb1 of W", "1", "", 4},
               {"\xc2\xb1 of \xce\xb1", "1", ""},
               {"residual, rms", "1", "%"},
               {"residual, largest", "1", "%"},
               {"film at the drive's speed", "m", "nm"}},
    .models = "reynolds, half-plane, smooth, isoviscous; thesis eq. 7.5; Karaszkiewicz eq. 7.6; "
              "exact limit",
    .solves = {.reynolds = FITS * SPEEDS * LOADS + 2},
    .make = make,
};
