// sealbench film: the film of one sliding line contact.
#include "app/base/reader.h"
#include "app/cli/cli.h"
#include "app/cli/film_history.h"
#include "app/cli/plots.h"
#include "app/cli/timing.h"
#include "app/export/results.h"

#include "engine/contact/rough/rough_law.h"
#include "engine/film/laws.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static void print_film_table(const SbFilm *film, const SbFilmProblem *problem) {
  printf("Film by %s\n", sb_film_kind(film->model)->name);
  if (!film->solver.converged && film->film_central == 0) {
    sb_cli_line("Converged", "NO, nothing found");
    return;
  }
  sb_cli_rows(sb_film_rows, film);
  sb_cli_rows(sb_film_contact_rows, film);
  sb_cli_line("Regime", film->regime);
  if (problem->surface != SB_ROUGH_NONE) {
    sb_cli_line("Asperities", sb_rough_model_name(problem->surface));
    sb_cli_rows(sb_film_rough_rows, film);
    sb_cli_figure("Coefficient of friction",
                  fabs(film->friction_boundary + film->friction_couette + film->friction_cavity) /
                      problem->load,
                  "1", "");
  }
  sb_cli_rows(sb_film_error_rows, film);
  sb_cli_figure("Time", film->solver.wall_s, "s", "ms");
  if (!film->solver.converged) {
    sb_cli_line("Converged", "NO");
  }
  sb_cli_warnings(&film->warnings);
}

// Two columns x [m], p [Pa], separated by a comma, semicolon or blanks; '#' comments and one
// heading line are allowed. False with a message.
static bool read_dry_pressure(const char *path, GArray *x, GArray *p) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  size_t length = 0;
  g_autofree char *text = sb_reader_load(&length, path, path, SB_DOCUMENT_BYTES_MAX, issues);
  if (text != NULL && (memchr(text, '\0', length) != NULL || !g_utf8_validate(text, -1, NULL))) {
    sb_issues_add(issues, path, 0, NULL, NULL, "is not a text table");
    g_clear_pointer(&text, g_free);
  }
  g_auto(GStrv) lines = g_strsplit(text != NULL ? text : "", "\n", -1);
  for (int i = 0; lines[i] != NULL && issues->len == 0; i++) {
    const char *c = g_strstrip(lines[i]);
    if (*c == '\0' || *c == '#') {
      continue;
    }
    double value[2];
    bool good = true;
    for (int k = 0; k < 2 && good; k++) {
      size_t number = sb_number_read(&value[k], c);
      size_t gap = strspn(c + number, ",; \t");
      good = number > 0 && (gap > 0 || c[number] == '\0');
      c += number + gap;
    }
    if (good && *c == '\0') {
      double before = x->len > 0 ? g_array_index(x, double, x->len - 1) : -INFINITY;
      if (value[0] <= before) {
        sb_issues_add(issues, path, i + 1, NULL, NULL, "x does not increase");
      }
      g_array_append_val(x, value[0]);
      g_array_append_val(p, value[1]);
    } else if (x->len > 0 || !g_ascii_isalpha(lines[i][0])) {
      sb_issues_add(issues, path, i + 1, NULL, NULL, "\"%s\" is not two numbers x [m], p [Pa]",
                    lines[i]);
    }
  }
  if (issues->len == 0 && x->len < 3) {
    sb_issues_add(issues, path, 0, NULL, NULL, "has %u points, at least 3 are needed", x->len);
  }
  bool good = issues->len == 0;
  sb_cli_issues(issues);
  return good;
}

// Reads the dry pressure of the model inverse, which alone has one, into x and p (borrowed by
// `problem`) from `path` (NULL: none is given). False with a message.
static bool choose_dry_pressure(SbFilmProblem *problem, const char *path, GArray *x, GArray *p) {
  if (sb_film_kind(problem->model)->from_dry != (path != NULL)) {
    sb_cli_fail(path != NULL ? "--dry-pressure: only the model inverse uses it"
                             : "--dry-pressure is missing: the model inverse needs it");
    return false;
  }
  if (path != NULL && !read_dry_pressure(path, x, p)) {
    return false;
  }
  problem->dry_x = (const double *)(void *)x->data;
  problem->dry_pressure = (const double *)(void *)p->data;
  problem->dry_count = x->len;
  return true;
}

// The same contact by every closed form and by the solver, so that their differences are seen at
// once; and why a printed table of the thesis differs. `alpha` and `hamaker` are the options given,
// or the catalogue's.
static void print_other_models(const SbFilm *film, const SbFilmProblem *problem, double alpha,
                               double hamaker) {
  static const SbFilmModel models[] = {SB_FILM_REYNOLDS,      SB_FILM_ASYMPTOTIC, SB_FILM_MOES,
                                       SB_FILM_KARASZKIEWICZ, SB_FILM_THESIS,     SB_FILM_RIGID};
  g_autofree SbFilm *other = g_new0(SbFilm, 1);
  printf("By model                         central    minimum\n");
  for (size_t i = 0; i < G_N_ELEMENTS(models); i++) {
    SbFilmProblem same = *problem;
    same.model = models[i];
    same.surface = SB_ROUGH_NONE; // smooth, all of them
    same.hamaker = 0;
    same.profile = NULL;
    SbReport report = {0};
    if (sb_film_solve(other, &same, NULL, &report) == SB_OK) {
      printf("  %-26s %9.4g nm %9.4g nm%s\n", sb_film_kind(models[i])->name,
             other->film_central * 1e9, other->film_min * 1e9,
             other->valid ? "" : "  outside its range");
    } else {
      printf("  %-26s %s\n", sb_film_kind(models[i])->name, report.text);
    }
  }
  double entrainment = fabs(problem->speed) / 2;
  if (entrainment > 0) {
    SbChartPoint chart = sb_regime_chart(problem->load, entrainment, problem->radius,
                                         problem->modulus, problem->viscosity, alpha);
    printf("Greenwood's chart (alpha %.4g/GPa): g_E %.4g, g_V %.4g, %s\n", alpha * 1e9, chart.g_E,
           chart.g_V, chart.regime);
  }
  // Equations 5.9 and 5.17 at this film: the drag of a plane taper from central to least film over
  // the Hertz width, and the attraction across the least film.
  if (film->film_min > 0) {
    double taper = sb_taper_factor(fmax(film->film_central / film->film_min, 1));
    sb_cli_figure("Friction, tapered film (5.9)",
                  problem->viscosity * fabs(problem->speed) / film->film_min * taper * 2 *
                      film->hertz_half_width,
                  "N/m", "N/m");
    sb_cli_figure("Van der Waals pull (5.17)", sb_vdw_attraction(hamaker, film->film_min), "Pa",
                  "MPa");
  }
  if (sb_film_kind(film->model)->power_law) {
    puts("Note: the laws take the entrainment speed, half the sliding speed. Tables 7.5 and 7.12 "
         "of the\n"
         "thesis are thicker: their Karaszkiewicz columns use the speed times 1000/60, their "
         "current\n"
         "column of 7.12 the full sliding speed and the load over pi x 6 mm.");
  }
}

typedef struct {
  SbFilm *film;
  const SbFilmProblem *problem;
  SbReport report;
} Solve;

static SbStatus solve_film(void *data, double *wall_s) {
  Solve *job = data;
  SbStatus status = sb_film_solve(job->film, job->problem, NULL, &job->report);
  *wall_s = job->film->solver.wall_s;
  return status;
}

// An option that is a quantity: where its text and its value go.
typedef struct {
  const char *name;
  bool required;
  const char *si, *shown, *help;
  size_t offset; // of the double in SbFilmProblem
} Quantity;

static const Quantity quantities[] = {
    {"load", true, "N/m", "N/m", "Net load per length", offsetof(SbFilmProblem, load)},
    {"speed", true, "m/s", "mm/s", "Sliding speed, signed", offsetof(SbFilmProblem, speed)},
    {"radius", true, "m", "mm", "Radius of the cylinder", offsetof(SbFilmProblem, radius)},
    {"modulus", true, "Pa", "MPa", "Reduced modulus, 2/E' = sum (1-nu^2)/E",
     offsetof(SbFilmProblem, modulus)},
    {"viscosity", true, "Pa.s", "mPa.s", "Dynamic viscosity", offsetof(SbFilmProblem, viscosity)},
    {"pressure-left", false, "Pa", "MPa", "Gauge pressure at x < 0",
     offsetof(SbFilmProblem, pressure_left)},
    {"pressure-right", false, "Pa", "MPa", "Gauge pressure at x > 0",
     offsetof(SbFilmProblem, pressure_right)},
    {"tolerance", false, "1", "", "Relative error wanted, 1e-3",
     offsetof(SbFilmProblem, tolerance)},
    {"pressure-viscosity", false, "1/Pa", "1/GPa", "Barus coefficient (reynolds)",
     offsetof(SbFilmProblem, pressure_viscosity)},
    {"eyring-stress", false, "Pa", "MPa", "Eyring's stress of shear thinning (reynolds)",
     offsetof(SbFilmProblem, eyring_stress)},
    {"inlet-film", false, "m", "nm", "Layer that the wall brings; else flooded (reynolds)",
     offsetof(SbFilmProblem, inlet_film)},
    {"rupture-pressure", false, "Pa", "MPa", "Gauge pressure at which the film breaks (reynolds)",
     offsetof(SbFilmProblem, rupture_pressure)},
    {"gt-product", false, "1", "", "Asperity product (--surface), 0.1289",
     offsetof(SbFilmProblem, gt_product)},
    {"sigma", false, "m", "um", "Height deviation (--surface), 1 um",
     offsetof(SbFilmProblem, sigma)},
    {"sigma-over-beta", false, "1", "", "Height deviation over tip radius (--surface), 0.1",
     offsetof(SbFilmProblem, sigma_over_beta)},
    {"percolation-threshold", false, "1", "",
     "Real area at which the last channel closes (--surface persson); else none",
     offsetof(SbFilmProblem, percolation_threshold)},
    {"roughness-split", false, "1", "",
     "Variance of the wall's heights less that of the seal's, over their sum; else 0 (--surface "
     "persson)",
     offsetof(SbFilmProblem, roughness_split)},
    {"hamaker", false, "J", "J", "Hamaker constant; else no adhesion (reynolds)",
     offsetof(SbFilmProblem, hamaker)},
    {"work-of-adhesion", false, "J/m2", "J/m2",
     "Of asperities' tips that stick; else none (--surface greenwood-tripp)",
     offsetof(SbFilmProblem, work_of_adhesion)},
    {"shear-strength", false, "Pa", "MPa", "Of the real contact (--surface), 3.5 MPa",
     offsetof(SbFilmProblem, shear_strength)},
    {"load-coefficient", false, "1", "", "On the asperities' load (--surface), 0.19",
     offsetof(SbFilmProblem, load_coefficient)},
};
enum { QUANTITIES = G_N_ELEMENTS(quantities) };

// False with a message if a value is beyond what the engine takes.
static bool in_range(const char *option, const Quantity *q, double value) {
  size_t count;
  const SbFilmRange *range = sb_film_ranges(&count);
  while (count > 0 && range->offset != q->offset) {
    range++;
    count--;
  }
  if (count == 0 || (value >= range->min && value <= range->max)) {
    return true;
  }
  g_autofree char *given = sb_quantity_format(value, q->si, q->shown);
  g_autofree char *min = sb_quantity_format(range->min, q->si, q->shown);
  g_autofree char *max = sb_quantity_format(range->max, q->si, q->shown);
  sb_cli_fail("%s: %s is out of range (allowed %s to %s)", option, given, min, max);
  return false;
}

// Reads every quantity given; false with a message. `moves`: the speed is that of a history.
static bool read_quantities(SbFilmProblem *problem, char *const *texts, bool moves) {
  for (int i = 0; i < QUANTITIES; i++) {
    const Quantity *q = &quantities[i];
    double value = 0;
    g_autofree char *option = g_strconcat("--", q->name, NULL);
    const bool known = q->offset == offsetof(SbFilmProblem, speed) && moves;
    bool good = sb_cli_quantity(&value, option, texts[i], q->required && !known, q->si, q->shown) &&
                (texts[i] == NULL || in_range(option, q, value));
    if (!good) {
      return false;
    }
    if (texts[i] != NULL) {
      *(double *)(void *)((char *)problem + q->offset) = value;
    }
  }
  return true;
}

static const char *model_name(int i) {
  return sb_film_kind((SbFilmModel)i)->name;
}

static bool choose_model(SbFilmProblem *problem, const char *name) {
  if (sb_film_model_from_name(&problem->model, name)) {
    return true;
  }
  g_autofree char *names = sb_cli_names(model_name, SB_FILM_MODEL_COUNT);
  sb_cli_unknown("--model: there is no film model", name, names, NULL);
  return false;
}

// The surface and the catalogue's figures for what is not given; false with a message. Figures of a
// surface without one are an error, as they would be ignored.
static bool choose_surface(SbFilmProblem *problem, const char *name, char *const *texts) {
  if (name != NULL && !sb_rough_model_from_name(&problem->surface, name)) {
    sb_cli_unknown("--surface: there is no surface", name, "none|greenwood-tripp|persson", NULL);
    return false;
  }
  static const struct {
    size_t offset;
    SbParamId id;
  } figure[] = {
      {offsetof(SbFilmProblem, gt_product), SB_P_SURFACE_GT_PRODUCT},
      {offsetof(SbFilmProblem, sigma), SB_P_SURFACE_SIGMA},
      {offsetof(SbFilmProblem, sigma_over_beta), SB_P_SURFACE_SIGMA_OVER_BETA},
      {offsetof(SbFilmProblem, shear_strength), SB_P_FRICTION_SHEAR_STRENGTH},
      {offsetof(SbFilmProblem, load_coefficient), SB_P_FRICTION_LOAD_COEFFICIENT},
  };
  for (size_t f = 0; f < G_N_ELEMENTS(figure); f++) {
    for (int i = 0; i < QUANTITIES; i++) {
      if (quantities[i].offset != figure[f].offset) {
        continue;
      }
      if (problem->surface == SB_ROUGH_NONE && texts[i] != NULL) {
        sb_cli_fail("--%s: needs --surface greenwood-tripp or persson", quantities[i].name);
        return false;
      }
      if (problem->surface != SB_ROUGH_NONE && texts[i] == NULL) {
        *(double *)(void *)((char *)problem + figure[f].offset) = sb_param(figure[f].id)->fallback;
      }
    }
  }
  return true;
}

// The value at `offset` of the problem where its option was given, the catalogue's otherwise.
static double given_or(const SbFilmProblem *problem, size_t offset, char *const *texts,
                       SbParamId id) {
  for (int i = 0; i < QUANTITIES; i++) {
    if (quantities[i].offset == offset && texts[i] != NULL) {
      return *(const double *)(const void *)((const char *)problem + offset);
    }
  }
  return sb_param(id)->fallback;
}

// How the fluid of a contact whose channels are closed is taken.
typedef enum { TRAPPED, DRAINED, BOTH } Closure;

static const char *const closures[] = {"trapped", "drained", "both"};

// What one call computes beside the film.
typedef struct {
  const SbModelSeries *series; // speeds of a history; NULL: none
  double content;              // of the contact [m]; NaN: none is given
  Closure closure;
  const char *target; // of the JSON; NULL: a table
} Extra;

static bool choose_closure(Closure *out, const char *name, const SbFilmProblem *problem) {
  for (size_t i = 0; i < G_N_ELEMENTS(closures) && name != NULL; i++) {
    if (strcmp(name, closures[i]) == 0) {
      *out = (Closure)i;
      if (!(problem->percolation_threshold > 0)) {
        sb_cli_fail("--sealed: needs --percolation-threshold");
        return false;
      }
      return true;
    }
  }
  if (name != NULL) {
    sb_cli_unknown("--sealed: there is no closure", name, "drained|trapped|both", NULL);
  }
  return name == NULL;
}

// Solves, and writes or prints what came out; an exit code.
static int solve_and_show(const SbFilmProblem *problem, char *const *texts, const Extra *extra,
                          const SbCliPlots *plots) {
  const bool plot = extra->target == NULL && sb_cli_plots(plots);
  g_autofree SbFilm *film = g_new0(SbFilm, 1), *drained = g_new0(SbFilm, 1);
  SbFilmProblem lent = *problem;
  lent.profile = extra->target != NULL || plot ? g_new(SbFilmProfile, 1) : NULL;
  lent.speed = extra->closure == DRAINED ? 0 : problem->speed;
  Solve job = {film, &lent, {0}};
  sb_cli_catch_interrupts();
  double wall_s = 0;
  SbStatus status = sb_timing_median(&wall_s, solve_film, &job);
  film->solver.wall_s = wall_s;
  SbResultsFilmExtra more = {0};
  g_autofree double *values = NULL;
  SbResultsHistory history = {0};
  if (status == SB_OK && extra->closure == BOTH) {
    SbFilmProblem dry = *problem;
    dry.speed = 0;
    status = sb_film_solve(drained, &dry, NULL, &job.report);
    more.drained = drained;
  }
  if (status == SB_OK && extra->series != NULL) {
    values = g_new(double, SB_RESULTS_HISTORY_COLUMNS * extra->series->count);
    history = sb_results_history(extra->series->count, extra->series->time, values);
    status = sb_film_history_follow(&history, problem, extra->series, &job.report);
    more.history = &history;
  }
  if (status == SB_OK && !isnan(extra->content)) {
    status = sb_film_history_content(&more.content, problem, extra->content, &job.report);
  }
  job.report.input = 0; // the catalogue's key and range are a seal's, not this command's
  int code = sb_cli_status(status, &job.report);
  if (status == SB_OK || status == SB_ERROR_NOT_CONVERGED) {
    int written = SB_EXIT_DONE;
    if (extra->target != NULL) {
      g_autofree char *json = sb_results_film(film, &more);
      written = sb_cli_emit(json, extra->target);
    } else if (!sb_cli_quiet()) {
      print_film_table(film, problem);
      sb_film_history_print(film, &more);
      print_other_models(film, problem,
                         given_or(problem, offsetof(SbFilmProblem, pressure_viscosity), texts,
                                  SB_P_FLUID_PRESSURE_VISCOSITY),
                         given_or(problem, offsetof(SbFilmProblem, hamaker), texts,
                                  SB_P_SURFACE_HAMAKER_CONSTANT));
      if (plot && film->points > 1) {
        sb_cli_plot_profile(film->x, film->pressure, film->film, film->points);
      }
    }
    code = written != SB_EXIT_DONE ? written : code;
  }
  g_free(lent.profile);
  return code;
}

int sb_command_film(int argc, char **argv) {
  char *texts[QUANTITIES] = {NULL};
  char *name = NULL, *surface = NULL, *dry = NULL, *path = NULL, *target = NULL;
  char *closure = NULL, *content = NULL;
  SbCliPlots plots = {0};
  const GOptionEntry others[] = {
      {"model", 0, 0, G_OPTION_ARG_FILENAME, &name,
       "reynolds (default), or another of sealbench list models", "NAME"},
      {"surface", 0, 0, G_OPTION_ARG_FILENAME, &surface,
       "Asperities in the same solve: none (default), greenwood-tripp, persson (reynolds)", "NAME"},
      {"dry-pressure", 0, 0, G_OPTION_ARG_FILENAME, &dry,
       "Table x [m], p [Pa] for the model inverse", "FILE.csv"},
      {"history", 0, 0, G_OPTION_ARG_FILENAME, &path,
       "Table time [s], speed [m/s] to follow the film through, in place of --speed (reynolds)",
       "FILE.csv"},
      {"sealed", 0, 0, G_OPTION_ARG_FILENAME, &closure,
       "Fluid in a contact whose channels are closed: trapped (default), drained, or both", "NAME"},
      {"content", 0, 0, G_OPTION_ARG_FILENAME, &content,
       "Also the friction with so much fluid in the contact (--percolation-threshold)", "VALUE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &target, "JSON to a file or -", "FILE|-"},
      {"plot", 0, 0, G_OPTION_ARG_NONE, &plots.on, SB_CLI_PLOT_HELP, NULL},
      {"no-plot", 0, 0, G_OPTION_ARG_NONE, &plots.off, SB_CLI_NO_PLOT_HELP, NULL},
  };
  enum { OTHERS = G_N_ELEMENTS(others) };
  GOptionEntry entries[QUANTITIES + OTHERS + 1] = {0};
  for (int i = 0; i < QUANTITIES; i++) {
    entries[i] = (GOptionEntry){quantities[i].name, 0,      0, G_OPTION_ARG_FILENAME, &texts[i],
                                quantities[i].help, "VALUE"};
  }
  memcpy(&entries[QUANTITIES], others, sizeof others);
  g_autoptr(GArray) x = g_array_new(FALSE, FALSE, sizeof(double));
  g_autoptr(GArray) p = g_array_new(FALSE, FALSE, sizeof(double));
  g_autofree SbModelSeries *series = g_new0(SbModelSeries, 1);
  SbFilmProblem problem;
  sb_film_problem_init(&problem);
  problem.cancelled = sb_cli_interrupted;
  Extra extra = {.content = NAN};
  if (!sb_cli_parse(&argc, &argv, entries, 0, 0, SB_TIMING_NOTE) ||
      (path != NULL && !sb_film_history_read(series, &problem, path, texts[1])) ||
      !read_quantities(&problem, texts, path != NULL) ||
      (name != NULL && !choose_model(&problem, name)) ||
      !choose_surface(&problem, surface, texts) ||
      !choose_closure(&extra.closure, closure, &problem) ||
      !sb_film_history_read_content(&extra.content, &problem, content) ||
      (path != NULL && !sb_film_history_starts(series, &problem, path))) {
    return SB_EXIT_INPUT;
  }
  if (!choose_dry_pressure(&problem, dry, x, p)) {
    return SB_EXIT_INPUT;
  }
  if (!sb_cli_has_memory(NULL)) {
    return SB_EXIT_IO;
  }
  extra.series = path != NULL ? series : NULL;
  extra.target = target;
  const int code = sb_cli_check_outputs(NULL, NULL, target);
  return code == SB_EXIT_DONE ? solve_and_show(&problem, texts, &extra, &plots) : code;
}
