// sealbench calibrate: a scene's parameters from measured loops.
#include "app/cli/cli.h"

#include "app/export/calibrate_results.h"

#include <math.h>

static const char result_name[] = "results.json", samples_name[] = "posterior.csv",
                  picture_name[] = "calibration.svg";

// The files that are written of each curve.
static const struct {
  const char *ending;
  char *(*text)(const SbCalibration *, const SbStudyFile *, size_t, const char *, GError **);
} fitted_file[] = {{"scene", sb_calibration_scene}, {"valve", sb_calibration_valve}};

// "fitted.ENDING", of several curves "fitted-NAME.ENDING". Owned by the caller.
static char *fitted_name(const SbStudyFile *study, size_t curve, size_t file) {
  const SbData *data = study->data->pdata[curve];
  if (study->data->len == 1) {
    return g_strconcat("fitted.", fitted_file[file].ending, NULL);
  }
  g_autofree char *name = *data->name != '\0' ? g_strdup(data->name) : g_strdup("data");
  g_strdelimit(name, "/\\ \t", '-');
  return g_strdup_printf("fitted-%s.%s", name, fitted_file[file].ending);
}

static void print_calibrate_table(const SbStudyFile *study, const SbCalibration *of) {
  printf("%s: %zu curves, %zu points\n", study->title, of->curves, of->points);
  g_autoptr(SbTable) table = sb_calibration_table(of);
  (void)sb_cli_table(table, NULL);
  g_autofree char *notes = sb_calibration_notes(of);
  g_auto(GStrv) line = g_strsplit(notes, "\n", 0);
  for (int i = 0; line[i] != NULL; i++) {
    printf("  %s\n", line[i]);
  }
}

typedef struct {
  const char *path, *json;
  const SbStudyFile *study;
  const SbCalibration *calibration;
} CalibrateFiles;

static bool fill_calibrate_folder(SbOutputFolder *folder, void *data, GError **error) {
  const CalibrateFiles *files = data;
  const SbCalibration *of = files->calibration;
  FILE *stream;
  if (!sb_output_folder_add_text(folder, result_name, files->json, error) ||
      !sb_output_folder_add(&stream, folder, samples_name, error)) {
    return false;
  }
  sb_calibration_csv(stream, of);
  bool good = sb_output_folder_add(&stream, folder, picture_name, error) &&
              sb_calibration_put(stream, of, files->study, ".svg", error);
  for (size_t i = 0; i < of->curves * G_N_ELEMENTS(fitted_file) && good; i++) {
    const size_t curve = i / G_N_ELEMENTS(fitted_file), file = i % G_N_ELEMENTS(fitted_file);
    g_autofree char *name = fitted_name(files->study, curve, file);
    g_autofree char *to = g_build_filename(files->path, name, NULL);
    g_autofree char *text = fitted_file[file].text(of, files->study, curve, to, error);
    good = text != NULL && sb_output_folder_add_text(folder, name, text, error);
  }
  return good;
}

static int solve(const SbCliStudyOptions *options, const SbStudyFile *study) {
  SbCalibration calibration;
  SbReport report = {0};
  SbProgress progress;
  g_autoptr(GPtrArray) issues = sb_issues_new();
  const SbCalibrateHooks hooks = {.jobs = options->threads,
                                  .cancelled = sb_cli_interrupted,
                                  .progress = sb_progress_update,
                                  .data = &progress};
  sb_progress_start(&progress, "calibrating ");
  sb_cli_catch_interrupts();
  const SbStatus status = sb_calibrate(&calibration, study, &hooks, issues, &report);
  sb_progress_end(&progress);
  sb_cli_issues(issues);
  int code = SB_EXIT_DONE;
  if (status == SB_ERROR_INPUT && issues->len > 0) {
    code = SB_EXIT_INPUT;
  } else if (status == SB_ERROR_CANCELLED && !calibration.partial) {
    (void)sb_cli_fail("interrupted: there is no fit yet");
    code = SB_EXIT_INTERRUPTED;
  } else if (status != SB_OK && status != SB_ERROR_NOT_CONVERGED && !calibration.partial) {
    code = sb_cli_status(status, &report);
  } else {
    g_autofree char *json = sb_calibration_json(&calibration, study);
    CalibrateFiles files = {options->folder, json, study, &calibration};
    code = options->folder != NULL
               ? sb_cli_write_folder(options->folder, "calibrate", fill_calibrate_folder, &files)
               : SB_EXIT_DONE;
    if (code == SB_EXIT_DONE && options->json != NULL) {
      code = sb_cli_emit(json, options->json);
    } else if (code == SB_EXIT_DONE && !sb_cli_quiet()) {
      print_calibrate_table(study, &calibration);
    }
    if (status == SB_ERROR_CANCELLED) {
      (void)sb_cli_fail("interrupted: the estimates are the best so far%s",
                        calibration.samples > 0 ? "" : ", without intervals");
      code = SB_EXIT_INTERRUPTED;
    } else if (status == SB_ERROR_NOT_CONVERGED) {
      (void)sb_cli_fail("the fit did not converge: its steps did not end");
      code = MAX(code, SB_EXIT_NOT_CONVERGED);
    }
  }
  sb_calibration_release(&calibration);
  return code;
}

static bool asks(const SbStudyFile *study, const char *path, GPtrArray *issues) {
  if (study->data->len == 0) {
    sb_issues_add(issues, path, 0, "data.file", "a file of numbers",
                  "is missing: the measured data");
  }
  return study->data->len > 0;
}

static void add_names(GPtrArray *names, const SbStudyFile *study) {
  g_ptr_array_add(names, g_strdup(result_name));
  g_ptr_array_add(names, g_strdup(samples_name));
  g_ptr_array_add(names, g_strdup(picture_name));
  for (size_t i = 0; i < study->data->len * G_N_ELEMENTS(fitted_file); i++) {
    const size_t curve = i / G_N_ELEMENTS(fitted_file), file = i % G_N_ELEMENTS(fitted_file);
    g_ptr_array_add(names, fitted_name(study, curve, file));
  }
}

int sb_command_calibrate(int argc, char **argv) {
  static const SbCliStudyWork work = {asks, add_names, solve};
  SbCliStudyOptions options;
  const bool good = sb_cli_study_parse(
      &options, &argc, &argv,
      "Folder for results.json, posterior.csv, calibration.svg and the fitted scenes and valves");
  return good ? sb_cli_study_run(&options, argv[1], &work) : SB_EXIT_INPUT;
}
