// sealbench run: a scene's cycle to a table, JSON or a folder of results.
#include "app/cli/cli.h"
#include "app/export/results_files.h"

#include <math.h>
#include <string.h>

static void print_seal(const char *name, const SbSealSummary *seal) {
  printf("%s seal, middle of B-C\n", name);
  sb_cli_figure("Contact width", seal->contact_width, "m", "mm");
  sb_cli_figure("Load", seal->load, "N", "N");
  sb_cli_figure("Peak pressure", seal->pressure_peak, "Pa", "MPa");
  sb_cli_figure("Film, least", seal->film_min, "m", "nm");
  sb_cli_figure("Film, central", seal->film_central, "m", "nm");
  sb_cli_figure("  by Karaszkiewicz, eq. 7.6", seal->film_karaszkiewicz, "m", "nm");
  sb_cli_figure("  by the thesis, eq. 7.5", seal->film_thesis, "m", "nm");
  sb_cli_figure("  by Reynolds, solved", seal->film_reynolds, "m", "nm");
  sb_cli_figure("Film over roughness", seal->lambda, "1", "");
  sb_cli_figure("Friction, boundary", seal->friction_boundary, "N", "N");
  sb_cli_figure("Friction, viscous", seal->friction_viscous, "N", "N");
  sb_cli_figure("Friction, static", seal->friction_static, "N", "N");
  sb_cli_figure("Coefficient of friction", seal->coefficient_of_friction, "1", "");
  sb_cli_figure("Leakage per stroke", seal->leakage_per_stroke, "m3", "nl");
  sb_cli_figure("Leak at rest", seal->leakage_static, "m3/s", "nl/s");
  sb_cli_figure("Closed at a pressure of", seal->closing_pressure, "Pa", "MPa");
}

static void print_life(const SbRun *run) {
  const SbLife *life = &sb_run_summary(run)->life;
  size_t count;
  const SbLifeActuation *each = sb_run_life(run, &count);
  printf("Life of %ld actuations\n", life->done);
  sb_cli_figure("Roughness, last over given", each[count - 1].roughness, "1", "");
  sb_cli_figure("Break-away force, last", each[count - 1].force_breakaway, "N", "N");
  sb_cli_figure("Return force, last", each[count - 1].force_return, "N", "N");
  sb_cli_figure("  least of all", life->return_least, "N", "N");
  sb_cli_figure("Film over roughness, last", each[count - 1].lambda, "1", "");
  sb_cli_figure("Leakage, carried out", life->carried, "m3", "nl");
  sb_cli_figure("  net", life->leakage, "m3", "nl");
  char *failures = g_strdup_printf("%ld", life->failures);
  sb_cli_line("Without return", failures);
  g_free(failures);
}

static void print_rig(const SbRun *run) {
  const SbRigSummary *rig = &sb_run_summary(run)->rig;
  const SbRigCoefficients *of = &rig->of;
  double none = NAN;
  sb_cli_figure("Static coefficient", rig->found ? of->static_coefficient : none, "1", "");
  sb_cli_figure("Dynamic coefficient", rig->found ? of->dynamic_coefficient : none, "1", "");
  sb_cli_figure("  of the mean force", rig->found ? of->mean_coefficient : none, "1", "");
  sb_cli_figure("  measured in the thesis", SB_RIG_MEASURED_DYNAMIC, "1", "");
  sb_cli_figure("  predicted there", SB_RIG_PREDICTED_DYNAMIC, "1", "");
  sb_cli_figure("  surface model, this load", rig->contact_coefficient, "1", "");
  sb_cli_figure("First peak", rig->found ? of->first_peak : none, "N", "N");
  sb_cli_figure("  at", rig->found ? of->first_time : none, "s", "s");
  char *peaks = g_strdup_printf("%zu", rig->found ? of->peaks : 0);
  sb_cli_line("Peaks that follow", peaks);
  g_free(peaks);
}

static void print_solver(const SbSummary *summary) {
  sb_cli_warnings(&summary->warnings);
  printf("Solver\n");
  sb_cli_line("Converged", summary->converged ? "yes" : "NO");
  char *frames = g_strdup_printf("%zu", summary->frames);
  sb_cli_line("Frames", frames);
  g_free(frames);
  sb_cli_figure("Engine time", summary->wall_s, "s", "ms");
}

static void print_table(const SbDocument *document, const SbRun *run) {
  const SbSummary *summary = sb_run_summary(run);
  printf("%s\n", sb_document_title(document));
  if (sb_run_model(run)->motion == SB_MODEL_MOTION_RIG) {
    print_rig(run);
    sb_cli_figure("Energy of the pull", summary->energy.loop, "J", "mJ");
    sb_cli_figure("Energy closure", summary->energy.closure, "1", "");
    sb_cli_figure("Duration", summary->duration, "s", "s");
    print_solver(summary);
    return;
  }
  sb_cli_figure("Peak force", summary->force_peak, "N", "N");
  sb_cli_figure("Break-away force", summary->force_breakaway, "N", "N");
  sb_cli_figure("Least return force", summary->force_return_min, "N", "N");
  sb_cli_line("Stem returns", summary->returns ? "yes" : "no");
  sb_cli_figure("Energy of the loop", summary->energy.loop, "J", "mJ");
  sb_cli_figure("Energy closure", summary->energy.closure, "1", "");
  sb_cli_figure("Leakage per cycle", summary->leakage_per_cycle, "m3", "nl");
  sb_cli_figure("  carried out, all actuations", summary->leakage_carried, "m3", "nl");
  sb_cli_figure("  net, all actuations", summary->leakage_net, "m3", "nl");
  sb_cli_figure("Duration", summary->duration, "s", "s");
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    const SbStageMark *mark = &summary->stage[i];
    char digits[3][SB_NUMBER_SIZE];
    char *text =
        mark->reached
            ? g_strdup_printf("%s s, %s mm, %s N", sb_number_round(digits[0], mark->time, 4),
                              sb_number_round(digits[1], mark->displacement * 1e3, 4),
                              sb_number_round(digits[2], mark->force, 4))
            : g_strdup("not reached");
    char label[] = {'S', 't', 'a', 'g', 'e', ' ', sb_stage_name((SbStage)i)[0], '\0'};
    sb_cli_line(label, text);
    g_free(text);
  }
  if (summary->life.done > 0) {
    print_life(run);
  }
  print_seal("Outer", &summary->seal[SB_OUTER]);
  print_seal("Inner", &summary->seal[SB_INNER]);
  print_solver(summary);
}

static void on_progress(void *data, double fraction, size_t frames) {
  sb_progress_update(data, fraction);
}

static bool on_cancelled(void *data) {
  return sb_cli_interrupted(NULL);
}

// The studies of a bit mask, in order; returns the worst exit code. An interrupt ends with those
// that are done.
static int make_studies(SbStudy *out, size_t *count, const SbModel *model, unsigned mask) {
  int code = SB_EXIT_DONE;
  for (int i = 0; i < SB_STUDY_COUNT; i++) {
    if ((mask & (1u << i)) == 0) {
      continue;
    }
    int made = sb_cli_study(&out[*count], (SbStudyKind)i, model);
    *count += made == SB_EXIT_DONE || made == SB_EXIT_NOT_CONVERGED ? 1 : 0;
    code = made != SB_EXIT_DONE ? made : code;
    if (made == SB_EXIT_INTERRUPTED) {
      break;
    }
  }
  return code;
}

int sb_command_run(int argc, char **argv) {
  char *folder = NULL;
  char *json_target = NULL;
  char **settings = NULL;
  const GOptionEntry entries[] = {
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &folder,
       "Folder for results.json, cycle.csv, profiles.csv, and life or study tables", "DIR"},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &settings, "Overrides a parameter", "KEY=VALUE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &json_target, "JSON to a file or - ", "FILE|-"},
      {0},
  };
  int code = SB_EXIT_INPUT;
  g_autoptr(GPtrArray) kept = g_ptr_array_new_with_free_func(g_free);
  SbModel model;
  SbDocument *document = NULL;
  SbRun *run = NULL;
  SbStudy *studies = NULL;
  if (!sb_cli_parse(&argc, &argv, entries, 1, 1, NULL)) {
    goto done;
  }
  document = sb_cli_open(&model, argv[1], settings);
  if (document == NULL) {
    goto done;
  }
  SbPlan plan;
  SbReport report = {0};
  sb_plan_make(&plan, &model);
  // What cannot be written is told before the work, not after it.
  char **names = sb_results_folder_names(plan.studies, model.life_actuations > 1);
  code = sb_cli_check_outputs(folder, names, json_target);
  g_strfreev(names);
  if (code != SB_EXIT_DONE) {
    goto done;
  }
  SbStatus status = sb_run_create(&run, &model, &plan, &report);
  if (status != SB_OK) {
    code = sb_cli_status(status, &report);
    goto done;
  }
  SbProgress progress;
  sb_progress_start(&progress, "");
  sb_cli_catch_interrupts();
  SbRunHooks hooks = {on_progress, on_cancelled, &progress};
  status = sb_run_execute(run, &hooks, &report);
  sb_progress_end(&progress);
  code = sb_cli_status(status, &report);
  bool has_results =
      status == SB_OK || status == SB_ERROR_NOT_CONVERGED || status == SB_ERROR_CANCELLED;
  if (!has_results) {
    goto done;
  }
  char *sha256 = sb_document_sha256(document);
  size_t study_count = 0;
  if (status != SB_ERROR_CANCELLED && plan.studies != 0) {
    studies = g_new(SbStudy, SB_STUDY_COUNT);
    int studied = make_studies(studies, &study_count, &model, plan.studies);
    code = studied != SB_EXIT_DONE ? studied : code;
  }
  SbResultsInfo info = {.scene = argv[1],
                        .sha256 = sha256,
                        .partial = status == SB_ERROR_CANCELLED || code == SB_EXIT_INTERRUPTED,
                        .studies = studies,
                        .study_count = study_count};
  char *json = sb_results_run(run, &info);
  int written = SB_EXIT_DONE;
  GError *error = NULL;
  if (folder != NULL &&
      !sb_results_folder_write(folder, run, json, studies, study_count, kept, &error)) {
    written = sb_cli_error(error);
  }
  sb_cli_kept(folder, kept);
  if (json_target != NULL && written == SB_EXIT_DONE) {
    written = sb_cli_emit(json, json_target);
  } else if (!sb_cli_quiet() && written == SB_EXIT_DONE) {
    print_table(document, run);
    if (folder != NULL) {
      printf("Results are in %s\n", folder);
    }
  }
  code = written != SB_EXIT_DONE ? written : code;
  g_free(json);
  g_free(sha256);
done:
  g_free(studies);
  sb_run_destroy(run);
  sb_document_free(document);
  g_strfreev(settings);
  g_free(folder);
  g_free(json_target);
  return code;
}
