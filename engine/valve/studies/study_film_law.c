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

enum { SPEEDS = 14, LOADS = 5, CURVE = 41, FITS = 2 };

typedef struct {
  const char *name;
  double k, beta, alpha;
  bool least; // of the least film, else of the central one
} Law;

static const Law given[] = {
    {"thesis, eq. 7.5", 1.492, 0.5434, -0.2893, false},
    {"Karaszkiewicz, eq. 7.6", 4.4, 0.65, -0.21, false},
    {"thin-film limit", 3.77334, 0.6, -0.2, false},
    {"thin-film limit, least", 3.00434, 0.6, -0.2, true},
};
enum { GIVEN = sizeof given / sizeof given[0], DRAWN = 3 };

double sb_study_film_law_cost(const SbModel *model) {
  return (FITS * SPEEDS * LOADS + 2) * SB_COST_FILM;
}

// A seal's scales: U and W per speed and load, and the length of h/R.
typedef struct {
  double U_per_speed, W_per_load, radius;
} Scale;

static double law_film(const Law *law, const Scale *scale, double speed, double load) {
  return scale->radius * law->k * pow(speed * scale->U_per_speed, law->beta) *
         pow(load * scale->W_per_load, law->alpha);
}

// Passes the progress of one regression on as its part of the study.
typedef struct {
  SbStudyWork *work;
  double from, share;
} Part;

static void on_progress(void *data, double fraction) {
  const Part *part = data;
  sb_study_step(part->work, part->from + part->share * fraction);
}

static bool is_cancelled(void *data) {
  const Part *part = data;
  return part->work->status != SB_OK;
}

// Root mean square and largest of solved/law - 1 over the points of a regression.
static void misfit(const Law *law, const SbFilmLaw *solved, double *rms, double *largest) {
  double sum = 0;
  *largest = 0;
  for (size_t i = 0; i < solved->count; i++) {
    double h = law->k * pow(solved->U[i], law->beta) * pow(solved->W[i], law->alpha);
    double miss = solved->H[i] / h - 1;
    sum += miss * miss;
    *largest = fmax(*largest, fabs(miss));
  }
  *rms = sqrt(sum / (double)solved->count);
}

static void put_row(SbStudy *out, const Law *law, const SbFilmLaw *own, const SbFilmLaw *solved,
                    const Scale *scale, double speed, double load) {
  SbStudyRow *row = sb_study_row(out, NULL, NULL, "%s", law->name);
  row->value[0] = law->k;
  row->value[2] = law->beta;
  row->value[4] = law->alpha;
  if (own != NULL) {
    row->value[1] = own->k_confidence;
    row->value[3] = own->a_confidence;
    row->value[5] = own->b_confidence;
  }
  misfit(law, solved, &row->value[6], &row->value[7]);
  row->value[8] = law_film(law, scale, speed, load);
}

// The film solved at one speed and load.
static bool solve_film(SbStudyWork *work, SbFilm *film, double speed, double load) {
  SbFilmProblem problem;
  SbReport report;
  sb_sliding_film_problem(&problem, work->scene, SB_OUTER, (SbSealPressure){0, 0}, load, speed);
  if (work->hooks != NULL) {
    problem.cancelled = work->hooks->cancelled;
    problem.cancelled_data = work->hooks->data;
  }
  SbStatus status = sb_film_solve(film, &problem, NULL, &report);
  work->out->solves++;
  work->out->error = fmax(work->out->error, film->solver.error_film_central);
  return sb_study_goes_on(work, status, &report);
}

static void draw(SbStudy *out, const Law laws[], const SbFilmLaw *central, const Scale *scale,
                 const SbStudyRange *range) {
  double middle = sqrt(range->load_min * range->load_max);
  SbStudyPanel *film = sb_study_panel(out, "central film", "m", "nm", true);
  SbStudyPanel *ratio = sb_study_panel(out, "law over the solved film", "1", "", true);
  SbStudyPanel *residual = sb_study_panel(out, "solved against our law", "1", "%", false);
  // Solved at the middle load: the grid's middle row.
  SbStudySeries *dots = sb_study_series(film, SB_STUDY_DOTS, "solved");
  for (size_t i = 0; i < central->count; i++) {
    if (i / SPEEDS == LOADS / 2) {
      sb_study_point(dots, central->U[i] / scale->U_per_speed, central->H[i] * scale->radius);
    }
  }
  for (int l = 0; l < 1 + DRAWN; l++) {
    const Law *law = l == 0 ? &laws[0] : &given[l - 1];
    SbStudySeries *line = sb_study_series(film, l == 0 ? SB_STUDY_CURVE : SB_STUDY_REFERENCE, "%s",
                                          l == 0 ? "our law" : law->name);
    for (int i = 0; i < CURVE; i++) {
      double v = range->speed_min * pow(range->speed_max / range->speed_min, i / (CURVE - 1.0));
      sb_study_point(line, v, law_film(law, scale, v, middle));
    }
    SbStudySeries *over = sb_study_series(ratio, l == 0 ? SB_STUDY_CURVE : SB_STUDY_REFERENCE, "%s",
                                          l == 0 ? "our law" : law->name);
    for (size_t i = 0; i < dots->count; i++) {
      sb_study_point(over, dots->x[i], law_film(law, scale, dots->x[i], middle) / dots->y[i]);
    }
  }
  for (int j = 0; j < LOADS; j += (LOADS - 1) / 2) {
    double load = central->W[j * SPEEDS] / scale->W_per_load;
    SbStudySeries *line = sb_study_series(residual, SB_STUDY_CURVE, "%.0f N/m", load);
    for (int i = 0; i < SPEEDS; i++) {
      size_t k = (size_t)(j * SPEEDS + i);
      sb_study_point(line, central->U[k] / scale->U_per_speed, central->residual[k]);
    }
  }
}

static void regress(SbStudyWork *work, SbFilmLaw *fits, const Scale *scale) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  const SbStudyRange *range = &model->study;
  for (int f = 0; work->status == SB_OK && f < FITS; f++) {
    Part part = {work, 0.95 * f / FITS, 0.95 / FITS};
    SbReport report;
    SbFilmLawRange grid = {
        .film = f == 0 ? SB_FILM_LAW_CENTRAL : SB_FILM_LAW_MIN,
        .U_min = range->speed_min * scale->U_per_speed,
        .U_max = range->speed_max * scale->U_per_speed,
        .W_min = range->load_min * scale->W_per_load,
        .W_max = range->load_max * scale->W_per_load,
        .U_count = SPEEDS,
        .W_count = LOADS,
        .tolerance = model->tolerance,
        .cancelled = is_cancelled,
        .progress = on_progress,
        .data = &part,
    };
    (void)sb_study_goes_on(work, sb_film_law_fit(&fits[f], &grid, &report), &report);
    out->solves += fits[f].count;
    out->error = fmax(out->error, fits[f].error);
  }
}

static void table(SbStudy *out, const Law laws[], const SbFilmLaw *fits, const Scale *scale,
                  double speed, double load, const SbFilm *film) {
  sb_text(out->row_heading, sizeof out->row_heading, "h/R = k U^\xce\xb2 W^\xce\xb1");
  sb_study_column(out, "k", "1", "")->digits = 4;
  sb_study_column(out, "\xc2\xb1 of k", "1", "%");
  sb_study_column(out, "\xce\xb2 of U", "1", "")->digits = 4;
  sb_study_column(out, "\xc2\xb1 of \xce\xb2", "1", "");
  sb_study_column(out, "\xce\xb1 of W", "1", "")->digits = 4;
  sb_study_column(out, "\xc2\xb1 of \xce\xb1", "1", "");
  sb_study_column(out, "residual, rms", "1", "%");
  sb_study_column(out, "residual, largest", "1", "%");
  sb_study_column(out, "film at the drive's speed", "m", "nm");
  for (int f = 0; f < FITS; f++) {
    put_row(out, &laws[f], &fits[f], &fits[f], scale, speed, load);
  }
  for (size_t g = 0; g < GIVEN; g++) {
    put_row(out, &given[g], NULL, &fits[given[g].least ? 1 : 0], scale, speed, load);
  }
  sb_study_row(out, NULL, NULL, "solved, central")->value[8] = film->film_central;
  sb_study_row(out, NULL, NULL, "solved, least")->value[8] = film->film_min;
}

void sb_study_film_law(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  const SbStudyRange *range = &model->study;
  const SbSealModel *seal = &model->seal[SB_OUTER];
  double unit = seal->reduced_modulus * seal->radius;
  const Scale scale = {model->viscosity / 2 / unit, 1 / unit, seal->radius};
  SbFilmLaw *fits = calloc(FITS, sizeof *fits);
  SbFilm *film = calloc(1, sizeof *film);
  if (fits == NULL || film == NULL) {
    work->status = sb_fail(work->report, SB_ERROR_MEMORY, "no memory for a study");
  } else {
    regress(work, fits, &scale);
  }
  // The scene's own point: the net load of its outer seal at the drive's speed, without end
  // pressure as the laws have it.
  work->total = INFINITY; // this question is no measure of the progress
  sb_study_fix_machine(work);
  double own = sb_study_net_load(work);
  double load = own > 0 ? own : sqrt(range->load_min * range->load_max);
  if (work->status == SB_OK && solve_film(work, film, model->speed, load)) {
    Law laws[FITS];
    for (int f = 0; f < FITS; f++) {
      laws[f] =
          (Law){f == 0 ? "ours, central" : "ours, least", fits[f].k, fits[f].a, fits[f].b, f == 1};
    }
    sb_study_axis(&out->x, "sliding speed", "m/s", "mm/s", true);
    draw(out, laws, &fits[0], &scale, range);
    table(out, laws, fits, &scale, model->speed, load, film);
    if (model->speed >= range->speed_min && model->speed <= range->speed_max) {
      sb_study_mark(out, model->speed, "drive");
    }
    sb_text(out->models, sizeof out->models,
            "reynolds, half-plane, smooth, isoviscous; thesis eq. 7.5; Karaszkiewicz eq. 7.6; "
            "exact limit");
    sb_text(out->validity, sizeof out->validity,
            "our law: U %.2g to %.2g, W %.3g to %.3g only; the limit: thin films (M above 100)",
            range->speed_min * scale.U_per_speed, range->speed_max * scale.U_per_speed,
            range->load_min * scale.W_per_load, range->load_max * scale.W_per_load);
    sb_study_note(out,
                  "U = \xce\xb7 (u/2)/(E' R), W = w/(E' R); R %.4g mm, E' %.4g MPa, \xce\xb7 %.4g "
                  "mPa s. \xc2\xb1: 95 %% confidence in this range. Curves at %.0f N/m.",
                  seal->radius * 1e3, seal->reduced_modulus * 1e-6, model->viscosity * 1e3,
                  sqrt(range->load_min * range->load_max));
    sb_study_note(out,
                  "Last column: at %.4g mm/s and the outer seal's %.0f N/m. Residuals of the given "
                  "laws are against the same %zu solutions.",
                  model->speed * 1e3, load, fits[0].count);
  }
  free(film);
  free(fits);
}
