// Commands that answer a study file with a folder: their options, and what comes before the work.
#include "app/cli/cli.h"

bool sb_cli_study_parse(SbCliStudyOptions *out, int *argc, char ***argv, const char *folder_help) {
  *out = (SbCliStudyOptions){0};
  const GOptionEntry entries[] = {
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &out->folder, folder_help, "DIR"},
      {"jobs", 0, 0, G_OPTION_ARG_FILENAME, &out->jobs, SB_CLI_JOBS_HELP, "N"},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &out->settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &out->json, "JSON to a file or -", "FILE|-"},
      {0},
  };
  return sb_cli_parse(argc, argv, entries, 1, 1, NULL) && sb_cli_jobs(&out->threads, out->jobs);
}

int sb_cli_study_run(const SbCliStudyOptions *options, const char *path,
                     const SbCliStudyWork *work) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbStudyFile) study = sb_cli_open_study(path, options->settings);
  const bool asks = study != NULL && work->asks(study, path, issues);
  sb_cli_issues(issues);
  if (!asks) {
    return SB_EXIT_INPUT;
  }
  g_autoptr(GPtrArray) names = g_ptr_array_new_with_free_func(g_free);
  work->names(names, study);
  g_ptr_array_add(names, NULL);
  const int code = sb_cli_check_outputs(options->folder, (char **)names->pdata, options->json);
  return code != SB_EXIT_DONE             ? code
         : sb_cli_has_memory(study->base) ? work->solve(options, study)
                                          : SB_EXIT_IO;
}
