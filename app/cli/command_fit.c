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

static void print_table(const SbFit *fit, const char *seal, bool dragged) {
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
} Solve;

static SbStatus solve(void *data, double *wall_s) {
  Solve *job = data;
  SbStatus status = sb_fit_solve(job->fit, job->problem, &job->report);
  *wall_s = job->fit->solver.wall_s;
  return status;
}

// --model NAME or NAME:VARIANT.
static bool choose_model(SbFitProblem *problem, const char *name) {
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

int sb_command_fit(int argc, char **argv) {
  char *seal = NULL, *pressure = NULL, *name = NULL, *tolerance = NULL, *drag = NULL;
  char *target = NULL, **settings = NULL, **exports = NULL;
  SbCliPlots plots = {0};
  SbRing *ring = NULL;
  const GOptionEntry entries[] = {
      {"seal", 0, 0, G_OPTION_ARG_FILENAME, &seal, "outer or inner", "NAME"},
      {"pressure", 0, 0, G_OPTION_ARG_FILENAME, &pressure,
       "Pressure on the left (ambient on the right), default 0", "P"},
      {"model", 0, 0, G_OPTION_ARG_FILENAME, &name, "Model, or MODEL:VARIANT; else the file's",
       "NAME"},
      {"drag", 0, 0, G_OPTION_ARG_FILENAME, &drag,
       "Friction of the sliding bore, > 0 towards the wall; limit or -limit: the maximum", "MU"},
      {"tolerance", 0, 0, G_OPTION_ARG_FILENAME, &tolerance, "Relative error wanted", "T"},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {"export", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &exports,
       "The ring's mesh and fields (.vtu), as a CalculiX problem (.inp), its outlines (.dxf), its "
       "body (.stl, free: .free.stl)",
       "FILE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &target, "JSON to a file or -", "FILE|-"},
      {"plot", 0, 0, G_OPTION_ARG_NONE, &plots.on, SB_CLI_PLOT_HELP, NULL},
      {"no-plot", 0, 0, G_OPTION_ARG_NONE, &plots.off, SB_CLI_NO_PLOT_HELP, NULL},
      {0},
  };
  g_autoptr(SbModel) model = NULL;
  g_autoptr(SbDocument) document = NULL;
  if (!sb_cli_parse(&argc, &argv, entries, 1, 1, SB_TIMING_NOTE)) {
    return SB_EXIT_INPUT;
  }
  document = sb_cli_open(&model, argv[1], settings);
  if (document == NULL) {
    return SB_EXIT_INPUT;
  }
  int index = 0;
  while (index < SB_SEAL_COUNT && g_strcmp0(sb_seal_name(index), seal) != 0) {
    index++;
  }
  if (index == SB_SEAL_COUNT) {
    if (seal == NULL) {
      sb_cli_fail("--seal: is missing (allowed outer, inner)");
    } else {
      sb_cli_unknown("--seal: unknown seal", seal, "outer|inner", NULL);
    }
    return SB_EXIT_INPUT;
  }
  SbFitProblem problem;
  sb_model_fit_problem(&problem, model, index, 0);
  problem.cancel = sb_cli_interrupted;
  problem.tolerance = 1e-3;
  if (!sb_cli_quantity(&problem.pressure, "--pressure", pressure, false, "Pa", "MPa") ||
      !sb_cli_quantity(&problem.tolerance, "--tolerance", tolerance, false, "1", "") ||
      (name != NULL && !choose_model(&problem, name))) {
    return SB_EXIT_INPUT;
  }
  bool limit = false;
  if (drag != NULL && !choose_drag(&problem, &limit, drag, name != NULL)) {
    return SB_EXIT_INPUT;
  }
  const SbParam *allowed = sb_param(SB_P_CANISTER_PRESSURE);
  if (!(problem.pressure >= allowed->min && problem.pressure <= allowed->max)) {
    g_autofree char *given = sb_param_format(SB_P_CANISTER_PRESSURE, problem.pressure);
    g_autofree char *range = sb_param_range(SB_P_CANISTER_PRESSURE);
    sb_cli_fail("--pressure: %s is out of range (allowed %s)", given, range);
    return SB_EXIT_INPUT;
  }
  if (!(problem.tolerance >= 1e-8 && problem.tolerance <= 0.1)) {
    sb_cli_fail("--tolerance: out of range (allowed 1e-8 to 0.1)");
    return SB_EXIT_INPUT;
  }
  int code = sb_cli_check_outputs(NULL, NULL, target);
  if (code == SB_EXIT_DONE) {
    code = check_exports(exports, &problem);
  }
  problem.kept = exports != NULL ? &ring : NULL;
  if (code != SB_EXIT_DONE) {
    return code;
  }
  g_autofree SbFit *fit = g_new0(SbFit, 1);
  Solve job = {fit, &problem, {0}};
  sb_cli_catch_interrupts();
  double wall_s = 0;
  SbStatus status = sb_timing_median(&wall_s, solve, &job);
  fit->solver.wall_s = wall_s;
  code = sb_cli_status(status, &job.report);
  sb_model_warn(model, &fit->warnings);

  // Design read-outs of the gland.
  SbGland gland;
  SbGlandReadout readouts[SB_GLAND_COUNT];
  SbReport gland_report = {0};
  sb_model_gland(&gland, model, index);
  // A gasket lies in none.
  const SbGlandReadout *in_gland = problem.gasket ? NULL : readouts;
  if (in_gland != NULL && sb_gland_readouts(readouts, &gland, &gland_report) != SB_OK) {
    sb_cli_fail("%s: %s", sb_input_key(gland_report.input), gland_report.text);
    sb_ring_destroy(ring);
    return SB_EXIT_INPUT;
  }
  if (status == SB_OK || status == SB_ERROR_NOT_CONVERGED) {
    int written = SB_EXIT_DONE;
    if (target != NULL) {
      g_autofree char *file = sb_cli_full_path(argv[1], SB_SHIPPED_FOR_RUN);
      g_autofree char *json = sb_results_fit(fit, &problem, limit, seal, in_gland,
                                             &sb_model_seal(model, index)->storage, file);
      written = sb_cli_emit(json, target);
    } else if (!sb_cli_quiet()) {
      print_table(fit, seal, problem.dragged);
      if (in_gland != NULL) {
        print_gland(in_gland);
      }
      if (sb_cli_plots(&plots) && fit->profile_count > 1) {
        sb_cli_plot_profile(fit->profile_x, fit->profile_p, NULL, fit->profile_count);
      }
    }
    if (written == SB_EXIT_DONE && ring != NULL) {
      written = write_exports(exports, ring, &problem);
    }
    code = written != SB_EXIT_DONE ? written : code;
  }
  sb_ring_destroy(ring);
  return code;
}
