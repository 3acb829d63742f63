// sealbench fit: one seal in its gland, by any of the contact models.
#include "app/base/output.h"
#include "app/cli/cli.h"
#include "app/cli/plots.h"
#include "app/cli/timing.h"
#include "app/document/shipped.h"
#include "app/export/cae.h"
#include "app/export/results.h"

#include <math.h>
#include <string.h>

static void print_fit_table(const SbFit *fit, const char *seal, bool dragged) {
  printf("%s seal by %s\n", seal, sb_fit_kind(fit->model)->name);
  sb_cli_rows(sb_fit_rows, fit);
  const bool found = sb_results_fit_found(fit);
  if (found) {
    sb_cli_rows(sb_fit_contact_rows, fit);
  }
  if (found && sb_fit_kind(fit->model)->section) {
    sb_cli_rows(sb_fit_ring_rows, fit);
    char text[96];
    snprintf(text, sizeof text, "%zu unknowns, %zu load steps (%zu halved), %zu Newton iterations",
             fit->solver.unknowns, fit->ring.load_steps, fit->ring.rejected_steps,
             fit->solver.newton_iterations);
    sb_cli_line("Solver", text);
    if (dragged) {
      sb_cli_rows(sb_fit_drag_rows, fit);
      sb_cli_line("State", sb_ring_state_name(fit->ring.state));
    }
  }
  if (found) {
    sb_cli_rows(sb_fit_error_rows, fit);
  }
  sb_cli_figure("Time", fit->solver.wall_s, "s", "ms");
  if (!fit->solver.converged) {
    sb_cli_line("Converged", found ? "NO" : "NO, no such state was found");
  }
  sb_cli_warnings(&fit->warnings);
}

// Read-outs that have a customary band: value, worst case, verdict and source.
static void print_gland(const SbGlandReadout *gland) {
  printf("Gland against customary bands\n");
  for (int i = 0; i < SB_GLAND_COUNT; i++) {
    const SbGlandReadout *r = &gland[i];
    if (r->band == SB_BAND_NONE && r->why[0] == '\0') {
      continue;
    }
    const bool judged = r->band != SB_BAND_NONE;
    const bool length = strcmp(r->unit, "m") == 0;
    const double scale = length ? 1e3 : 1e2;
    g_autofree char *text =
        g_strdup_printf("%.4g %s (worst %.4g to %.4g, RSS %.4g to %.4g): %s; %s",
                        scale * r->nominal, length ? "mm" : "%", scale * r->worst_low,
                        scale * r->worst_high, scale * r->rss_low, scale * r->rss_high,
                        judged ? sb_band_text(r->band) : "not judged", judged ? r->source : r->why);
    sb_cli_line(r->name, text);
  }
}

// What is to be timed.
typedef struct {
  SbFit *fit;
  const SbFitProblem *problem;
  SbReport report;
} FitSolve;

static SbStatus solve_fit(void *data, double *wall_s) {
  FitSolve *job = data;
  SbStatus status = sb_fit_solve(job->fit, job->problem, &job->report);
  *wall_s = job->fit->solver.wall_s;
  return status;
}

// --model NAME or NAME:VARIANT.
static bool choose_fit_model(SbFitProblem *problem, const char *name) {
  const char *colon = strchr(name, ':');
  g_autofree char *base = colon != NULL ? g_strndup(name, (size_t)(colon - name)) : g_strdup(name);
  bool good = sb_fit_model_from_name(&problem->model, base);
  if (good && colon != NULL) {
    problem->variant = sb_fit_variant_find(problem->model, colon + 1);
    good = problem->variant >= 0;
  }
  if (!good) {
    g_autoptr(GString) names = g_string_new(NULL);
    for (int i = 0; i < SB_FIT_MODEL_COUNT; i++) {
      const char *model = sb_fit_kind((SbFitModel)i)->name;
      g_string_append_printf(names, "%s%s", i > 0 ? "|" : "", model);
      for (int k = 1; sb_fit_variant_name((SbFitModel)i, k) != NULL; k++) {
        g_string_append_printf(names, "|%s:%s", model, sb_fit_variant_name((SbFitModel)i, k));
      }
    }
    sb_cli_unknown("--model: there is no fitment model", name, names->str, NULL);
  }
  return good;
}

// --drag MU, limit or -limit: the ring model.
static bool choose_drag(SbFitProblem *problem, bool *limit, const char *text, bool model_given) {
  *limit = strcmp(text, "limit") == 0 || strcmp(text, "-limit") == 0;
  if (*limit) {
    problem->drag = *text == '-' ? -SB_FIT_DRAG_MAX : SB_FIT_DRAG_MAX;
  } else if (!sb_cli_quantity(&problem->drag, "--drag", text, false, "1", "")) {
    return false;
  }
  if (!(fabs(problem->drag) <= SB_FIT_DRAG_MAX)) {
    sb_cli_fail("--drag: %s is out of range (allowed -%g to %g, limit, -limit)", text,
                SB_FIT_DRAG_MAX, SB_FIT_DRAG_MAX);
    return false;
  }
  if (model_given && !sb_fit_kind(problem->model)->section) {
    sb_cli_fail("--drag: only the ring model computes a dragged ring, not --model %s",
                sb_fit_kind(problem->model)->name);
    return false;
  }
  problem->model = SB_FIT_RING;
  problem->variant = 0;
  problem->dragged = true;
  return true;
}

// Whether all files of --export are of kinds that are written, and can be; an exit code.
static int check_exports(char **exports, const SbFitProblem *problem) {
  int code = SB_EXIT_DONE;
  for (char **path = exports; path != NULL && *path != NULL && code == SB_EXIT_DONE; path++) {
    GError *error = NULL;
    code = sb_cae_check(*path, problem, &error) ? sb_cli_check_outputs(NULL, NULL, *path)
                                                : sb_cli_error(error);
  }
  return code;
}

// Writes them; an exit code.
static int write_exports(char **exports, const SbRing *ring, const SbFitProblem *problem) {
  int code = SB_EXIT_DONE;
  for (char **path = exports; path != NULL && *path != NULL && code == SB_EXIT_DONE; path++) {
    GError *error = NULL;
    g_autofree char *text = sb_cae_text(*path, ring, problem);
    const bool good = sb_output_write(*path, text, strlen(text), &error);
    code = good ? SB_EXIT_DONE : sb_cli_error(error);
  }
  return code;
}

typedef struct {
  char *seal, *pressure, *model, *tolerance, *drag, *json;
  char **settings, **exports;
  SbCliPlots plots;
  bool limit; // the maximum drag is requested
} FitOptions;

// Reads the problem of the seal *index of a model from the options; false with a message.
static bool read_problem(SbFitProblem *problem, int *index, FitOptions *options,
                         const SbModel *model) {
  for (*index = 0; g_strcmp0(sb_seal_name(*index), options->seal) != 0;) {
    if (++*index == SB_SEAL_COUNT) {
      (void)(options->seal == NULL
                 ? sb_cli_fail("--seal: is missing (allowed outer, inner)")
                 : sb_cli_unknown("--seal: unknown seal", options->seal, "outer|inner", NULL));
      return false;
    }
  }
  sb_model_fit_problem(problem, model, *index, 0);
  problem->cancel = sb_cli_interrupted;
  problem->tolerance = 1e-3;
  if (!sb_cli_quantity(&problem->pressure, "--pressure", options->pressure, false, "Pa", "MPa") ||
      !sb_cli_quantity(&problem->tolerance, "--tolerance", options->tolerance, false, "1", "") ||
      (options->model != NULL && !choose_fit_model(problem, options->model)) ||
      (options->drag != NULL &&
       !choose_drag(problem, &options->limit, options->drag, options->model != NULL))) {
    return false;
  }
  const SbParam *allowed = sb_param(SB_P_CANISTER_PRESSURE);
  if (!(problem->pressure >= allowed->min && problem->pressure <= allowed->max)) {
    g_autofree char *given = sb_param_format(SB_P_CANISTER_PRESSURE, problem->pressure);
    g_autofree char *range = sb_param_range(SB_P_CANISTER_PRESSURE);
    sb_cli_fail("--pressure: %s is out of range (allowed %s)", given, range);
    return false;
  }
  if (!(problem->tolerance >= 1e-8 && problem->tolerance <= 0.1)) {
    sb_cli_fail("--tolerance: out of range (allowed 1e-8 to 0.1)");
    return false;
  }
  return true;
}

// Writes or prints a fit; an exit code.
static int show(const SbFit *fit, const SbFitProblem *problem, const FitOptions *options,
                const SbGlandReadout *gland, const SbRubberState *storage, const char *path) {
  if (options->json != NULL) {
    g_autofree char *file = sb_cli_full_path(path, SB_SHIPPED_FOR_RUN);
    g_autofree char *json =
        sb_results_fit(fit, problem, options->limit, options->seal, gland, storage, file);
    return sb_cli_emit(json, options->json);
  }
  if (!sb_cli_quiet()) {
    print_fit_table(fit, options->seal, problem->dragged);
    if (gland != NULL) {
      print_gland(gland);
    }
    if (sb_cli_plots(&options->plots) && fit->profile_count > 1) {
      sb_cli_plot_profile(fit->profile_x, fit->profile_p, NULL, fit->profile_count);
    }
  }
  return SB_EXIT_DONE;
}

// Solves, shows and exports the fit of the seal `index`; an exit code.
static int solve_fit_and_show(SbFitProblem *problem, int index, const FitOptions *options,
                              const SbModel *model, const char *path) {
  SbRing *ring = NULL;
  problem->kept = options->exports != NULL ? &ring : NULL;
  g_autofree SbFit *fit = g_new0(SbFit, 1);
  FitSolve job = {fit, problem, {0}};
  sb_cli_catch_interrupts();
  double wall_s = 0;
  const SbStatus status = sb_timing_median(&wall_s, solve_fit, &job);
  fit->solver.wall_s = wall_s;
  int code = sb_cli_status(status, &job.report);
  sb_model_warn(model, &fit->warnings);

  // Design read-outs of the gland; a gasket has no gland.
  SbGland gland;
  SbGlandReadout readouts[SB_GLAND_COUNT];
  SbReport report = {0};
  sb_model_gland(&gland, model, index);
  const SbGlandReadout *in_gland = problem->gasket ? NULL : readouts;
  if (in_gland != NULL && sb_gland_readouts(readouts, &gland, &report) != SB_OK) {
    code = sb_cli_fail("%s: %s", sb_input_key(report.input), report.text);
  } else if (status == SB_OK || status == SB_ERROR_NOT_CONVERGED) {
    int written =
        show(fit, problem, options, in_gland, &sb_model_seal(model, index)->storage, path);
    if (written == SB_EXIT_DONE && ring != NULL) {
      written = write_exports(options->exports, ring, problem);
    }
    code = written != SB_EXIT_DONE ? written : code;
  }
  sb_ring_destroy(ring);
  return code;
}

int sb_command_fit(int argc, char **argv) {
  FitOptions options = {0};
  const GOptionEntry entries[] = {
      {"seal", 0, 0, G_OPTION_ARG_FILENAME, &options.seal, "outer or inner", "NAME"},
      {"pressure", 0, 0, G_OPTION_ARG_FILENAME, &options.pressure,
       "Pressure on the left (ambient on the right), default 0", "P"},
      {"model", 0, 0, G_OPTION_ARG_FILENAME, &options.model,
       "Model, or MODEL:VARIANT; else the file's", "NAME"},
      {"drag", 0, 0, G_OPTION_ARG_FILENAME, &options.drag,
       "Friction of the sliding bore, > 0 towards the wall; limit or -limit: the maximum", "MU"},
      {"tolerance", 0, 0, G_OPTION_ARG_FILENAME, &options.tolerance, "Relative error wanted", "T"},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &options.settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {"export", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &options.exports,
       "The ring's mesh and fields (.vtu), as a CalculiX problem (.inp), its outlines (.dxf), its "
       "body (.stl, free: .free.stl)",
       "FILE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &options.json, "JSON to a file or -", "FILE|-"},
      {"plot", 0, 0, G_OPTION_ARG_NONE, &options.plots.on, SB_CLI_PLOT_HELP, NULL},
      {"no-plot", 0, 0, G_OPTION_ARG_NONE, &options.plots.off, SB_CLI_NO_PLOT_HELP, NULL},
      {0},
  };
  if (!sb_cli_parse(&argc, &argv, entries, 1, 1, SB_TIMING_NOTE)) {
    return SB_EXIT_INPUT;
  }
  int index;
  SbFitProblem problem;
  g_autoptr(SbModel) model = NULL;
  g_autoptr(SbDocument) document = sb_cli_open(&model, argv[1], options.settings);
  if (document == NULL || !read_problem(&problem, &index, &options, model)) {
    return SB_EXIT_INPUT;
  }
  int code = sb_cli_check_outputs(NULL, NULL, options.json);
  code = code == SB_EXIT_DONE ? check_exports(options.exports, &problem) : code;
  return code == SB_EXIT_DONE ? solve_fit_and_show(&problem, index, &options, model, argv[1])
                              : code;
}
