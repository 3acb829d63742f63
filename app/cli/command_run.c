// sealbench run: a scene's cycle to a table, JSON or a folder of results.
#include "app/cli/cli.h"
#include "app/export/results_files.h"

#include <math.h>
#include <string.h>

// A line of the table: the figure at `path`, or a dash and the reason.
static void print_figure(const SbSummary *summary, const char *label, const char *path) {
  int index = sb_figure_find(path);
  const SbFigure *figure = sb_figure(index);
  const char *reason = sb_figure_reason(summary, index);
  if (reason != NULL) {
    g_autofree char *dash = g_strdup_printf("- (%s)", reason);
    sb_cli_line(label, dash);
  } else {
    sb_cli_figure(label, sb_figure_value(summary, index), figure->si, figure->shown);
  }
}

static void print_seal(const SbSummary *summary, int seal) {
  static const struct {
    const char *label, *name;
  } lines[] = {{"Contact width", "contact_width_m"},
               {"Load", "load_N"},
               {"Peak pressure", "pressure_peak_Pa"},
               {"Film, least", "film_min_m"},
               {"Film, central", "film_central_m"},
               {"  by Karaszkiewicz, eq. 7.6", "film_by_model.karaszkiewicz"},
               {"  by the thesis, eq. 7.5", "film_by_model.thesis"},
               {"  by Reynolds, solved", "film_by_model.reynolds"},
               {"Film over roughness", "lambda"},
               {"Friction, boundary", "friction_boundary_N"},
               {"Friction, viscous", "friction_viscous_N"},
               {"Friction, static", "friction_static_N"},
               {"Coefficient of friction", "coefficient_of_friction"},
               {"Leakage per stroke", "leakage_per_stroke_m3"},
               {"Leak at rest", "leakage_static_m3_per_s"},
               {"Closed at a pressure of", "closing_pressure_Pa"}};
  printf("%s seal, middle of B-C\n", seal == SB_OUTER ? "Outer" : "Inner");
  for (size_t i = 0; i < G_N_ELEMENTS(lines); i++) {
    g_autofree char *path = g_strdup_printf("seals.%s.%s", sb_seal_name(seal), lines[i].name);
    print_figure(summary, lines[i].label, path);
  }
  sb_cli_line("Leak path", sb_leak_state_name(summary->seal[seal].leak_state));
}

// The questions that have an answer.
static void print_verdict(const SbCaseVerdict *verdicts) {
  printf("Verdict\n");
  for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
    const SbVerdict *verdict = &verdicts[kind].of;
    const char *name = verdicts[kind].name;
    if (verdict->figure >= 0) {
      static const char *const answers[] = {"-", "NO", "yes"};
      bool because = verdict->reason[0] != '\0';
      g_autofree char *text = g_strdup_printf(
          "%s%s%s%s%s%s", answers[verdict->ok], because ? " (" : "", verdict->reason,
          because ? ")" : "", name != NULL ? ", case " : "", name != NULL ? name : "");
      sb_cli_line(sb_verdict_name((SbVerdictKind)kind), text);
    }
  }
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
  if (life->failure > 0) {
    printf("  the stem does not return from actuation %ld: none after it\n", life->failure);
  }
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

static void print_table(const SbDocument *document, const SbRun *run,
                        const SbCaseVerdict *verdict) {
  const SbSummary *summary = sb_run_summary(run);
  printf("%s\n", sb_document_title(document));
  if (sb_run_model(run)->motion == SB_MODEL_MOTION_RIG) {
    print_rig(run);
    print_figure(summary, "Energy of the pull", "cycle.energy_loss_J");
    print_figure(summary, "Energy closure", "cycle.energy_closure");
    print_figure(summary, "Duration", "cycle.duration_s");
    print_solver(summary);
    return;
  }
  print_figure(summary, "Peak force", "cycle.force_peak_N");
  print_figure(summary, "Break-away force", "cycle.force_breakaway_N");
  print_figure(summary, "Least return force", "cycle.force_return_min_N");
  if (isnan(summary->returned)) {
    print_figure(summary, "Stem returns", "cycle.returns");
  } else {
    sb_cli_line("Stem returns", summary->returns ? "yes" : "no");
  }
  print_figure(summary, "Energy of the loop", "cycle.energy_loss_J");
  print_figure(summary, "Energy closure", "cycle.energy_closure");
  print_figure(summary, "Leakage per cycle", "cycle.leakage_per_cycle_m3");
  print_figure(summary, "  carried out, all actuations", "cycle.leakage_carried_all_actuations_m3");
  print_figure(summary, "  net, all actuations", "cycle.leakage_net_all_actuations_m3");
  print_figure(summary, "Dose", "cycle.dose_mass_kg");
  print_figure(summary, "Duration", "cycle.duration_s");
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
  print_seal(summary, SB_OUTER);
  print_seal(summary, SB_INNER);
  print_verdict(verdict);
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

typedef struct {
  char *folder, *json_target;
  char **settings;
} Options;

// Whether all that will be written can be: told before the work, not after it. An exit code.
static int check_outputs(const SbCliFiles *files, const Options *options) {
  g_autoptr(GPtrArray) all = g_ptr_array_new_with_free_func(g_free);
  for (int i = 0; i < files->count; i++) {
    const SbCliFile *file = &files->file[i];
    if (file->document == NULL) {
      continue;
    }
    const SbModel *model = file->model;
    g_auto(GStrv) names = sb_results_folder_names(model->studies, model->life_actuations > 1);
    for (char **name = names; *name != NULL; name++) {
      g_ptr_array_add(all, files->count > 1 ? g_build_filename(file->name, *name, NULL)
                                            : g_strdup(*name));
    }
  }
  g_ptr_array_add(all, NULL);
  return sb_cli_check_outputs(options->folder, (char **)all->pdata, options->json_target);
}

// Writes or prints what was computed; an exit code.
static int write_results(SbCliFiles *files, const SbCliFile *file, const Options *options,
                         const SbRun *run, const SbResultsInfo *info) {
  g_autofree char *json = sb_results_run(run, info);
  g_autoptr(GPtrArray) kept = g_ptr_array_new_with_free_func(g_free);
  GError *error = NULL;
  if (file->folder != NULL && !sb_results_folder_write(file->folder, run, json, info->studies,
                                                       info->study_count, kept, &error)) {
    return sb_cli_error(error);
  }
  sb_cli_kept(file->folder, kept);
  if (options->json_target != NULL) {
    g_ptr_array_add(files->json, g_steal_pointer(&json));
  } else if (!sb_cli_quiet()) {
    sb_cli_files_head(files);
    print_table(file->document, run, info->verdict);
    if (file->folder != NULL) {
      printf("Results are in %s\n", file->folder);
    }
  }
  return SB_EXIT_DONE;
}

// Whether there is memory for the scene and its cases.
static bool has_memory(const SbCliFile *file, bool studies) {
  g_autofree SbModel *model = g_new(SbModel, 1);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  bool good = sb_cli_has_memory(studies ? NULL : file->model);
  for (size_t i = 0; good && i < sb_document_case_count(file->document); i++) {
    good = !sb_document_compile_case(file->document, i, model, issues) || sb_cli_has_memory(model);
  }
  return good;
}

// The worst answers of the scene and its cases; an exit code.
static int judge(SbCaseVerdict *verdict, const SbRun *run, const SbDocument *document) {
  g_autoptr(GPtrArray) problems = g_ptr_array_new_with_free_func(g_free);
  SbProgress progress;
  sb_progress_start(&progress, "cases ");
  SbRunHooks hooks = {on_progress, on_cancelled, &progress};
  SbStatus status = sb_cases_judge(verdict, run, document, &hooks, problems);
  sb_progress_end(&progress);
  for (guint i = 0; i < problems->len; i++) {
    sb_cli_fail("%s", (const char *)problems->pdata[i]);
  }
  return status == SB_OK                ? SB_EXIT_DONE
         : status == SB_ERROR_CANCELLED ? SB_EXIT_INTERRUPTED
         : status == SB_ERROR_MEMORY    ? SB_EXIT_IO
                                        : SB_EXIT_NOT_CONVERGED;
}

// Computes one file's run, cases and studies, and writes them. An exit code.
static int run_file(SbCliFiles *files, const SbCliFile *file, const Options *options) {
  const SbModel *model = file->model;
  SbPlan plan;
  SbReport report = {0};
  sb_plan_make(&plan, model);
  if (!has_memory(file, plan.studies != 0)) {
    return SB_EXIT_IO;
  }
  SbRun *run = NULL;
  SbStatus status = sb_run_create(&run, model, &plan, &report);
  if (status != SB_OK) {
    return sb_cli_status(status, &report);
  }
  SbProgress progress;
  sb_progress_start(&progress, "");
  sb_cli_catch_interrupts();
  SbRunHooks hooks = {on_progress, on_cancelled, &progress};
  status = sb_run_execute(run, &hooks, &report);
  sb_progress_end(&progress);
  int code = sb_cli_status(status, &report);
  g_autofree SbStudy *studies = NULL;
  if (status == SB_OK || status == SB_ERROR_NOT_CONVERGED || status == SB_ERROR_CANCELLED) {
    g_autofree char *sha256 = sb_document_sha256(file->document);
    size_t study_count = 0;
    SbCaseVerdict verdict[SB_VERDICT_COUNT];
    int judged = judge(verdict, run, file->document);
    code = MAX(code, judged);
    if (code != SB_EXIT_INTERRUPTED && plan.studies != 0) {
      studies = g_new(SbStudy, SB_STUDY_COUNT);
      int studied = make_studies(studies, &study_count, model, plan.studies);
      code = studied != SB_EXIT_DONE ? studied : code;
    }
    SbResultsInfo info = {.scene = file->path,
                          .sha256 = sha256,
                          .partial = code == SB_EXIT_INTERRUPTED,
                          .verdict = verdict,
                          .studies = studies,
                          .study_count = study_count};
    int written = write_results(files, file, options, run, &info);
    code = written != SB_EXIT_DONE ? written : code;
  }
  sb_run_destroy(run);
  return code;
}

int sb_command_run(int argc, char **argv) {
  Options options = {0};
  const GOptionEntry entries[] = {
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &options.folder,
       "Folder for results.json, cycle.csv, profiles.csv, and life or study tables; of several "
       "files a folder each in it",
       "DIR"},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &options.settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &options.json_target, SB_CLI_JSON_HELP, "FILE|-"},
      {0},
  };
  SbCliFiles files = {.code = SB_EXIT_INPUT};
  if (sb_cli_parse(&argc, &argv, entries, 1, SB_CLI_FILES_MAX, NULL) &&
      sb_cli_files_open(&files, argc, argv, options.settings, options.folder)) {
    int checked = check_outputs(&files, &options);
    sb_cli_files_done(&files, checked);
    for (const SbCliFile *file;
         checked == SB_EXIT_DONE && (file = sb_cli_files_next(&files)) != NULL;) {
      if (!sb_cli_quiet() && sb_document_kind(file->document) == SB_DOCUMENT_VALVE &&
          sb_document_path(file->document) != NULL) {
        sb_cli_name_file(NULL);
        sb_cli_fail("note: %s is a valve, no scene: its default cycle is run", file->path);
        sb_cli_name_file(files.count > 1 ? file->path : NULL);
      }
      sb_cli_files_done(&files, run_file(&files, file, &options));
    }
    sb_cli_files_emit(&files, options.json_target);
  }
  sb_cli_files_close(&files);
  g_strfreev(options.settings);
  g_free(options.folder);
  g_free(options.json_target);
  return files.code;
}
