// sealbench run: a scene's cycle to a table, JSON or a folder of results.
#include "app/cli/cli.h"
#include "app/export/results_files.h"

#include <math.h>
#include <string.h>

// A line of the table: the figure, or a dash and the reason.
static void print_figure(const SbSummary *summary, int index) {
  double value = sb_figure_value(summary, index);
  const char *reason = sb_figure_reason(summary, index);
  g_autofree char *text = sb_figure_format(index, value, sb_figure_error(summary, index));
  g_autofree char *why = reason != NULL ? g_strdup_printf("%s (%s)", text, reason) : NULL;
  sb_cli_line(sb_figure(index)->label, reason != NULL ? why : text);
}

// Those of the short table whose paths begin with `scope`; `known`: without those that are not.
static void print_figures(const SbSummary *summary, const char *scope, bool known) {
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const SbFigure *figure = sb_figure(i);
    if (figure->brief && g_str_has_prefix(figure->path, scope) &&
        !(known && isnan(sb_figure_value(summary, i)))) {
      print_figure(summary, i);
    }
  }
}

// Time, displacement and force in a line.
static void print_stage(const SbSummary *summary, SbStage stage) {
  g_autofree char *scope = g_strdup_printf("cycle.stages.%s.", sb_stage_name(stage));
  g_autofree char *label = g_strdup_printf("Stage %s", sb_stage_name(stage));
  g_autoptr(GString) text = g_string_new(NULL);
  for (int i = 0; i < SB_FIGURE_COUNT && summary->stage[stage].reached; i++) {
    if (g_str_has_prefix(sb_figure(i)->path, scope)) {
      g_autofree char *one =
          sb_figure_format(i, sb_figure_value(summary, i), sb_figure_error(summary, i));
      g_string_append_printf(text, "%s%s", text->len > 0 ? ", " : "", one);
    }
  }
  sb_cli_line(label, text->len > 0 ? text->str : "not reached");
}

static void print_seal(const SbSummary *summary, int seal) {
  g_autofree char *scope = g_strdup_printf("seals.%s.", sb_seal_name(seal));
  printf("%s seal, middle of B-C\n", seal == SB_OUTER ? "Outer" : "Inner");
  print_figures(summary, scope, false);
  sb_cli_line("Leak path", sb_leak_state_name(summary->seal[seal].leak_state));
}

// The questions that have an answer.
static void print_verdict(const SbSummary *summary) {
  printf("Verdict\n");
  for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
    const SbVerdict *verdict = &summary->verdict[kind];
    if (verdict->figure >= 0) {
      static const char *const answers[] = {"-", "NO", "yes"};
      g_autofree char *text =
          g_strdup_printf("%s%s%s%s", answers[verdict->ok], verdict->reason[0] != '\0' ? " (" : "",
                          verdict->reason, verdict->reason[0] != '\0' ? ")" : "");
      sb_cli_line(sb_verdict_name((SbVerdictKind)kind), text);
    }
  }
}

static void print_rig(const SbSummary *summary) {
  print_figures(summary, "rig.", false);
  sb_cli_figure("  measured in the thesis", SB_RIG_MEASURED_DYNAMIC, "1", "");
  sb_cli_figure("  predicted there", SB_RIG_PREDICTED_DYNAMIC, "1", "");
  g_autofree char *peaks = g_strdup_printf("%zu", summary->rig.of.peaks);
  sb_cli_line("Peaks that follow", peaks);
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
  bool rig = sb_run_model(run)->motion == SB_MODEL_MOTION_RIG;
  print_figures(summary, "cycle.", rig);
  if (rig) {
    print_rig(summary);
    print_solver(summary);
    return;
  }
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    print_stage(summary, (SbStage)i);
  }
  if (summary->life.done > 0) {
    printf("Life of %ld actuations\n", summary->life.done);
    print_figures(summary, "life.", false);
  }
  print_seal(summary, SB_OUTER);
  print_seal(summary, SB_INNER);
  print_verdict(summary);
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
       "Folder for results.json, tables of figures, cycle and profiles, and of life or studies",
       "DIR"},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &json_target, "JSON to a file or - ", "FILE|-"},
      {0},
  };
  int code = SB_EXIT_INPUT;
  g_autofree SbModel *model = g_new(SbModel, 1);
  g_autoptr(GPtrArray) kept = g_ptr_array_new_with_free_func(g_free);
  SbDocument *document = NULL;
  SbRun *run = NULL;
  SbStudy *studies = NULL;
  if (!sb_cli_parse(&argc, &argv, entries, 1, 1, NULL)) {
    goto done;
  }
  document = sb_cli_open(model, argv[1], settings);
  if (document == NULL) {
    goto done;
  }
  if (!sb_cli_quiet() && sb_document_kind(document) == SB_DOCUMENT_VALVE &&
      sb_document_path(document) != NULL) {
    fprintf(stderr, "sealbench: note: %s is a valve, no scene: its default cycle is run\n",
            argv[1]);
  }
  SbPlan plan;
  SbReport report = {0};
  sb_plan_make(&plan, model);
  // What cannot be written is told before the work, not after it.
  char **names = sb_results_folder_names(plan.studies, model->life_actuations > 1);
  code = sb_cli_check_outputs(folder, names, json_target);
  g_strfreev(names);
  if (code != SB_EXIT_DONE) {
    goto done;
  }
  if (!sb_cli_has_memory(plan.studies == 0 ? model : NULL)) {
    code = SB_EXIT_IO;
    goto done;
  }
  SbStatus status = sb_run_create(&run, model, &plan, &report);
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
    int studied = make_studies(studies, &study_count, model, plan.studies);
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
