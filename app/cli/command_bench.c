// sealbench bench: error against time for every solver, by the engine's cases with known answers.
#include "app/cli/cli.h"
#include "app/cli/start_up.h"
#include "app/export/bench_page.h"
#include "app/table/json.h"

#include "engine/valve/answer/bench.h"

#include <math.h>

// `start_up` may be NULL: not measured.
static char *to_json(const SbBenchCase *cases, size_t count, const SbStartUp *start_up) {
  SbJson json;
  sb_json_document(&json);
  sb_json_array(&json, "cases");
  for (size_t i = 0; i < count; i++) {
    const SbBenchCase *row = &cases[i];
    sb_json_object(&json, NULL);
    sb_json_string(&json, "solver", row->solver);
    sb_json_string(&json, "case", row->name);
    sb_json_count(&json, "unknowns", row->unknowns);
    sb_json_count(&json, "iterations", row->iterations);
    sb_json_number(&json, "wall_s", row->wall_s);
    sb_json_number(&json, "error", row->error);
    sb_json_number(&json, "error_estimate", row->error_estimate);
    sb_json_number(&json, "order", row->order);
    sb_json_object_end(&json);
  }
  sb_json_array_end(&json);
  if (start_up != NULL) {
    sb_start_up_put(&json, start_up);
  }
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}

static const char *cell(char text[SB_NUMBER_SIZE], double value) {
  return isfinite(value) ? sb_number_round(text, value, 2) : "-";
}

static void print_table(const SbBenchCase *cases, size_t count) {
  printf("%-16s %-40s %8s %6s %11s %9s %9s %6s\n", "solver", "case", "unknowns", "iter.", "time",
         "error", "estimate", "order");
  for (size_t i = 0; i < count; i++) {
    const SbBenchCase *row = &cases[i];
    char error[SB_NUMBER_SIZE];
    char estimate[SB_NUMBER_SIZE];
    char order[SB_NUMBER_SIZE];
    printf("%-16s %-40s %8zu %6zu %8.3f ms %9s %9s %6s\n", row->solver, row->name, row->unknowns,
           row->iterations, row->wall_s * 1e3, cell(error, row->error),
           cell(estimate, row->error_estimate), cell(order, row->order));
  }
}

// Runs the cases; *done of them are complete afterwards. Returns an exit code.
static int run_cases(SbBenchCase *cases, size_t count, size_t *done, int repeats) {
  int code = SB_EXIT_DONE;
  SbProgress progress;
  sb_progress_start(&progress, "");
  for (*done = 0; *done < count; ++*done) {
    if (sb_cli_interrupted(NULL)) {
      code = SB_EXIT_INTERRUPTED;
      break;
    }
    SbReport report = {0};
    const SbBenchCase *previous = *done > 0 ? &cases[*done - 1] : NULL;
    SbStatus status = sb_bench_run(&cases[*done], *done, repeats, previous, &report);
    if (status != SB_OK) {
      sb_progress_end(&progress);
      sb_cli_fail("%s, %s: %s", cases[*done].solver, cases[*done].name,
                  report.text[0] != '\0' ? report.text : sb_status_text(status));
      code = SB_EXIT_NOT_CONVERGED;
    }
    sb_progress_update(&progress, (double)(*done + 1) / (double)count);
  }
  sb_progress_end(&progress);
  return code;
}

typedef struct {
  const char *json;
  const SbBenchCase *cases;
  size_t count;
} Files;

// Adds bench.json and its picture.
static bool fill_folder(SbOutputFolder *folder, void *data, GError **error) {
  const Files *files = data;
  FILE *stream;
  return sb_output_folder_add_text(folder, "bench.json", files->json, error) &&
         sb_output_folder_add(&stream, folder, "bench.png", error) &&
         sb_bench_put(stream, files->cases, files->count, error);
}

int sb_command_bench(int argc, char **argv) {
  char *folder = NULL, *target = NULL;
  gboolean quick = FALSE;
  const GOptionEntry entries[] = {
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &folder, "Folder for bench.json and bench.png",
       "DIR"},
      {"quick", 0, 0, G_OPTION_ARG_NONE, &quick, "Times each case once", NULL},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &target, "JSON to a file or -", "FILE|-"},
      {0},
  };
  int code = SB_EXIT_INPUT;
  char *names[] = {(char *)"bench.json", (char *)"bench.png", NULL};
  bool good = sb_cli_parse(&argc, &argv, entries, 0, 0,
                           "Times are the median of 20 cold solves after a warm-up; those of the "
                           "start-up are processor times of 20 starts.");
  if (good) {
    code = sb_cli_check_outputs(folder, names, target);
  }
  if (code == SB_EXIT_DONE && !sb_cli_has_memory(NULL)) {
    code = SB_EXIT_IO;
  }
  if (code == SB_EXIT_DONE) {
    const int repeats = quick ? 1 : 20;
    size_t count = sb_bench_count();
    g_autofree SbBenchCase *cases = g_new0(SbBenchCase, count);
    size_t done = 0;
    sb_cli_catch_interrupts();
    code = run_cases(cases, count, &done, repeats);
    SbStartUp start_up;
    const bool started = code != SB_EXIT_INTERRUPTED && sb_start_up_measure(&start_up, repeats);
    g_autofree char *json = to_json(cases, done, started ? &start_up : NULL);
    Files files = {json, cases, done};
    int written =
        folder != NULL ? sb_cli_write_folder(folder, "bench", fill_folder, &files) : SB_EXIT_DONE;
    if (written == SB_EXIT_DONE && target != NULL) {
      written = sb_cli_emit(json, target);
    } else if (written == SB_EXIT_DONE && !sb_cli_quiet()) {
      print_table(cases, done);
      if (started) {
        sb_start_up_print(&start_up);
      }
    }
    code = written != SB_EXIT_DONE ? written : code;
  }
  return code;
}
