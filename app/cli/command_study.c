// sealbench study and merge: many valves of one scene, and stores joined.
#include "app/cli/cli.h"
#include "app/cli/plots.h"

#include "app/base/figure_text.h"
#include "app/base/format.h"
#include "app/base/output.h"
#include "app/export/study_results.h"

#include "engine/numeric/statistics.h"
#include "engine/valve/shelf/shelf.h"

#include <glib/gstdio.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  char *store, *jobs, *shard, *csv, *json, *slurm;
  char **settings;
  int threads;
  size_t shard_index, shard_count; // from 0; count 0: no shards
  SbCliPlots plots;
} StudyOptions;

// A whole number and nothing else.
static bool read_whole(int *out, const char *text, int most) {
  double value = 0;
  if (!sb_number_parse(&value, text) || value != floor(value) || value < 1 || value > most) {
    return false;
  }
  *out = (int)value;
  return true;
}

bool sb_cli_jobs(int *threads, const char *text) {
  *threads = (int)g_get_num_processors();
  if (text != NULL && !read_whole(threads, text, 256)) {
    (void)sb_cli_fail("--jobs: \"%s\" is not a number of threads (1 to 256)", text);
    return false;
  }
  return true;
}

static int read_study_options(StudyOptions *options) {
  if (!sb_cli_jobs(&options->threads, options->jobs)) {
    return SB_EXIT_INPUT;
  }
  if (options->shard != NULL) {
    g_auto(GStrv) parts = g_strsplit(options->shard, "/", -1);
    int index = 0, count = 0;
    if (g_strv_length(parts) != 2 || !read_whole(&count, parts[1], 100000) ||
        !read_whole(&index, parts[0], count)) {
      return sb_cli_fail("--shard: \"%s\" is not of the form I/N, from 1/N to N/N", options->shard);
    }
    options->shard_index = (size_t)index - 1;
    options->shard_count = (size_t)count;
  }
  return SB_EXIT_DONE;
}

// A store that is there is added to; it must not be what the study is read from.
static int check_targets(const StudyOptions *options, const char *store) {
  GError *error = NULL;
  if (store != NULL && !sb_store_check_name(store, &error)) {
    return sb_cli_error(error);
  }
  if (store != NULL && !g_file_test(store, G_FILE_TEST_EXISTS)) {
    const int code = sb_cli_check_outputs(NULL, NULL, store);
    if (code != SB_EXIT_DONE) {
      return code;
    }
  }
  if (store != NULL && options->csv != NULL && strcmp(store, options->csv) == 0) {
    return sb_cli_fail("--csv: %s is the store", store);
  }
  const int code = sb_cli_check_outputs(NULL, NULL, options->csv);
  return code == SB_EXIT_DONE ? sb_cli_check_outputs(NULL, NULL, options->json) : code;
}

// ---- What people read ----

static void print_unknown(const SbLimitShare *share) {
  if (share->unknown > 0) {
    printf(", %zu without a value", share->unknown);
  }
}

static void print_share(const SbStudyFile *study, const SbLimitShare *share) {
  const bool reliability = study->method == SB_METHOD_RELIABILITY;
  const double unit = reliability ? 1e6 : 100;
  const char *name = reliability ? "ppm" : "%";
  char p[SB_FORMAT_MAX], low[SB_FORMAT_MAX], high[SB_FORMAT_MAX];
  sb_format_digits(p, unit * share->probability, 3);
  sb_format_digits(low, unit * share->interval[0], 3);
  sb_format_digits(high, unit * share->interval[1], 3);
  if (share->of == 0) {
    puts(" no sample has it");
  } else if (share->certain && (reliability || study->method == SB_METHOD_MONTE_CARLO)) {
    printf(" %s (" SB_INTERVAL_COVERS ", 95 %%: at least %s %s)\n", share->reason, low, name);
  } else if (reliability && isnan(share->probability)) {
    puts(" not all samples are there");
  } else if (reliability || study->method == SB_METHOD_MONTE_CARLO) {
    if (!reliability) {
      printf(" %zu of %zu beyond", share->beyond, share->of);
      print_unknown(share);
      putchar(':');
    }
    printf(" %s %s (" SB_INTERVAL_COVERS ", 95 %%: %s to %s %s)", p, name, low, high, name);
    if (reliability && isfinite(share->beta)) {
      printf(", beta %.3f", share->beta);
    }
    printf("%s%s\n", reliability && share->reason[0] != '\0' ? ": " : "",
           reliability ? share->reason : "");
  } else {
    printf(" %zu of %zu beyond", share->beyond, share->of);
    print_unknown(share);
    putchar('\n');
  }
}

// Where the searches found failures to be most probable.
static void print_modes(const SbStudyFile *study, const SbReliability *reliability, size_t limit) {
  for (size_t i = 0; i < reliability->count; i++) {
    const SbFailureMode *mode = &reliability->mode[i];
    if (mode->limit != limit) {
      continue;
    }
    if (mode->found.end != SB_SEARCH_FOUND) {
      printf("      sampled without a point of failure: %s\n", sb_failure_text(&mode->found));
      continue;
    }
    printf("      most probable (FORM: beta %.3f) at", mode->found.beta);
    for (guint k = 0; k < study->vary->len; k++) {
      const SbParam *param = sb_param(g_array_index(study->vary, SbVary, k).id);
      if (param->kind == SB_PARAM_REAL) {
        g_autofree char *value = sb_quantity_round(mode->value[k], param->si, param->unit, 5);
        printf("%s %s %s", k > 0 ? "," : "", param->key, value);
      }
    }
    putchar('\n');
  }
}

static SbStatus print_limits(const SbStudyFile *study, const SbStudyDrawn *drawn,
                             const SbAnswers *answers, SbReport *report) {
  SbStatus status = SB_OK;
  for (size_t i = 0; status == SB_OK && study->limits.count > 0 && i <= study->limits.count; i++) {
    SbLimitShare share;
    status = sb_study_limit_share(&share, study, drawn, answers, i, report);
    if (i == study->limits.count) {
      printf("  %-38s %-18s", "any limit", "");
      print_share(study, &share);
      break;
    }
    const SbLimit *limit = &study->limits.item[i];
    g_autofree char *text = sb_limit_format(limit->figure, limit->low, limit->high);
    printf("  %-38s %-18s", sb_figure(limit->figure)->path, text);
    print_share(study, &share);
    if (drawn->reliability != NULL) {
      print_modes(study, drawn->reliability, i);
    }
  }
  return status;
}

// A line below the table: which validity codes, and how many samples carry them.
static void print_warnings(const SbAnswers *answers) {
  size_t count = 0;
  g_autofree SbCodeCount *codes = sb_study_warnings(&count, answers);
  for (size_t i = 0; i < count; i++) {
    printf("%s%s in %zu", i > 0 ? ", " : "  warnings of validity: ", codes[i].code, codes[i].count);
  }
  if (count > 0) {
    printf(" of %zu samples\n", answers->samples);
  }
}

static SbStatus print_leakage(const SbStudyFile *study, const SbAnswers *answers,
                              SbReport *report) {
  SbLeakageOdds odds;
  const SbStatus status = sb_study_leakage(&odds, study, answers, report);
  if (status == SB_OK && isnan(odds.probability)) {
    printf("  %s: no sample has a loss on the shelf\n", study->leakage.edition);
  } else if (status == SB_OK) {
    char p[SB_FORMAT_MAX], low[SB_FORMAT_MAX], high[SB_FORMAT_MAX];
    printf("  %s: %zu of %zu simulated tests pass, %s %% (" SB_INTERVAL_COVERS
           ", 95 %%: %s to %s %%), %zu in the second stage\n",
           study->leakage.edition, odds.passed, odds.tests,
           sb_format_digits(p, 100 * odds.probability, 3),
           sb_format_digits(low, 100 * odds.interval[0], 3),
           sb_format_digits(high, 100 * odds.interval[1], 3), odds.second);
  }
  return status;
}

// Prints the statistics of the figures. Returns an exit code.
static int print_statistics(const SbStudyFile *study, const SbAnswers *answers) {
  enum { ROWS = 24 };
  static const SbTableColumn columns[] = {
      {.layout = "  %-38s"},
      {.layout = " %12s", .head = "mean"},
      {.layout = " %12s", .head = "deviation"},
      {.layout = " %12s", .head = "5 %"},
      {.layout = " %12s", .head = "median"},
      {.layout = " %12s", .head = "95 %"},
      {.layout = "  %s"},
  };
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  size_t shown = 0, with = 0;
  for (size_t k = 0; k < answers->figures; k++) {
    const int figure = g_array_index(study->figures, int, k);
    SbSummaryOfSamples of;
    SbReport report = {0};
    const SbStatus status =
        sb_samples_summary(&of, answers->value + k, answers->samples, answers->figures, &report);
    if (status != SB_OK) {
      return sb_cli_status(status, &report);
    }
    with += of.count > 0;
    if (of.count > 0 && shown < ROWS) {
      shown++;
      sb_table_add(table,
                   SB_CELLS(sb_cell_text(sb_figure(figure)->path),
                            sb_cell_shown(sb_study_statistic(figure, of.mean)),
                            sb_cell_shown(sb_study_statistic(figure, of.deviation)),
                            sb_cell_shown(sb_study_statistic(figure, of.quantile[1])),
                            sb_cell_shown(sb_study_statistic(figure, of.quantile[2])),
                            sb_cell_shown(sb_study_statistic(figure, of.quantile[3])),
                            sb_cell_text(of.count > 1 && !of.varies ? "does not vary" : NULL)));
    }
  }
  sb_cli_table(table, NULL);
  if (with > shown) {
    printf("  and %zu more figures: --csv, --json, or figures = in [study]\n", with - shown);
  }
  return SB_EXIT_DONE;
}

static int print_study_table(const SbStudyFile *study, const SbStudyDrawn *drawn,
                             const SbAnswers *answers) {
  SbReport report = {0};
  printf("%s: %s, %zu samples\n", study->title, sb_study_method_name(study->method),
         study->samples);
  if (drawn->reliability != NULL) {
    return sb_cli_status(print_limits(study, drawn, answers, &report), &report);
  }
  const int code = print_statistics(study, answers);
  if (code != SB_EXIT_DONE) {
    return code;
  }
  SbStatus status = print_limits(study, drawn, answers, &report);
  if (status == SB_OK && study->leakage_tests > 0) {
    status = print_leakage(study, answers, &report);
  }
  for (int i = 0; i < SB_SHELF_SPECIES; i++) {
    g_autofree char *text = sb_study_typical(study, (SbShelfSpecies)i);
    if (text != NULL) {
      printf("  %s\n", text);
    }
  }
  return sb_cli_status(status, &report);
}

// ---- The command ----

// Histograms of the figures that have limits, else of the first.
static void plot(const SbStudyFile *study, const SbAnswers *answers) {
  enum { MOST = 3 };
  int drawn = 0;
  for (int pass = 0; pass < 2 && drawn == 0; pass++) {
    for (size_t k = 0; k < answers->figures && drawn < (pass == 0 ? MOST : 1); k++) {
      const int figure = g_array_index(study->figures, int, k);
      bool limited = pass == 1;
      for (size_t i = 0; i < study->limits.count; i++) {
        limited |= study->limits.item[i].figure == figure;
      }
      if (limited) {
        sb_cli_plot_histogram(figure, answers->value + k, answers->samples, answers->figures,
                              &study->limits);
        drawn++;
      }
    }
  }
}

static int write_outputs(const StudyOptions *options, const SbCliAnswers *of) {
  const SbStudyFile *study = of->study;
  const SbStudyDrawn *drawn = of->drawn;
  const SbAnswers *answers = of->answers;
  GError *error = NULL;
  if (options->csv != NULL) {
    SbOutput out = {0};
    if (!sb_output_begin(&out, options->csv, &error)) {
      return sb_cli_error(error);
    }
    sb_study_csv(out.stream, study, of->value, answers);
    if (!sb_output_commit(&out, &error)) {
      return sb_cli_error(error);
    }
  }
  if (options->json != NULL) {
    SbReport report = {0};
    g_autofree char *json = sb_study_json(study, drawn, answers, of->cpus, of->store, &report);
    return json != NULL ? sb_cli_emit(json, options->json) : sb_cli_status(report.status, &report);
  }
  const bool streamed = options->csv != NULL && strcmp(options->csv, "-") == 0;
  if (sb_cli_quiet() || streamed) {
    return SB_EXIT_DONE;
  }
  const int code = print_study_table(study, drawn, answers);
  print_warnings(answers);
  if (of->store != NULL) {
    printf("  answers in %s (-o STORE chooses another file)\n", of->store);
  }
  if (sb_cli_plots(&options->plots)) {
    plot(study, answers);
  }
  return code;
}

// A store of one shard beside the whole one: NAME-I-of-N.store.
static char *shard_path(const char *store, const char *index, size_t count) {
  const bool ending = g_str_has_suffix(store, ".store");
  return g_strdup_printf("%.*s-%s-of-%zu.store", (int)strlen(store) - (ending ? 6 : 0), store,
                         index, count);
}

// Refuses what would end a line of the script: behind it, a comment's text would be a command.
static int check_scripted(const char *what, const char *text) {
  for (const char *c = text; *c != '\0'; c++) {
    if (g_ascii_iscntrl(*c)) {
      return sb_cli_fail("--emit-slurm: the %s \"%s\" has a control character; names in a job "
                         "script must have none",
                         what, text);
    }
  }
  return SB_EXIT_DONE;
}

// The job script of an array of shards, each with a store of its own, on one thread each.
static int emit_slurm(const StudyOptions *options, const SbStudyFile *study) {
  if (options->csv != NULL || options->json != NULL) {
    return sb_cli_fail("--emit-slurm: computes nothing, so there is nothing for %s; merge the "
                       "stores of its jobs first",
                       options->csv != NULL ? "--csv" : "--json");
  }
  g_autofree char *store = sb_cli_store_path(options->store, study);
  GError *unusable = NULL;
  if (store != NULL && !sb_store_check_name(store, &unusable)) {
    return sb_cli_error(unusable);
  }
  if (study->path == NULL || store == NULL || options->shard_count == 0) {
    return sb_cli_fail(
        "--emit-slurm: requires a study file, and --shard 1/N for the number of jobs");
  }
  GError *error = NULL;
  g_autofree char *program = g_file_read_link("/proc/self/exe", NULL);
  g_autofree char *file = g_canonicalize_filename(study->path, NULL);
  g_autofree char *whole = g_canonicalize_filename(store, NULL);
  g_autofree char *part = shard_path(whole, "$SLURM_ARRAY_TASK_ID", options->shard_count);
  g_autofree char *run = g_shell_quote(program != NULL ? program : "sealbench");
  g_autofree char *of = g_shell_quote(file);
  g_autofree char *into = g_shell_quote(whole);
  int code = check_scripted("program", run);
  code = code == SB_EXIT_DONE ? check_scripted("study", file) : code;
  code = code == SB_EXIT_DONE ? check_scripted("store", whole) : code;
  for (char **setting = options->settings;
       code == SB_EXIT_DONE && setting != NULL && *setting != NULL; setting++) {
    code = check_scripted("setting", *setting);
  }
  if (code != SB_EXIT_DONE) {
    return code;
  }
  if (strpbrk(whole, "\"$`\\") != NULL) {
    return sb_cli_fail("-o: %s has characters that a shell interprets", whole);
  }
  g_autoptr(GString) settings = g_string_new(NULL);
  for (char **setting = options->settings; setting != NULL && *setting != NULL; setting++) {
    g_autofree char *text = g_shell_quote(*setting);
    g_string_append_printf(settings, " --set %s", text);
  }
  g_autofree char *text = g_strdup_printf(
      "#!/bin/sh\n"
      "#SBATCH --job-name=sealbench\n"
      "#SBATCH --array=1-%zu\n"
      "#SBATCH --cpus-per-task=1\n"
      "# A job that fails is sent again alone: sbatch --array=I. When all are done:\n"
      "#   sealbench merge %s %s\n"
      "exec %s study %s%s -q --jobs 1 --shard \"$SLURM_ARRAY_TASK_ID/%zu\" -o \"%s\"\n",
      options->shard_count, into, "the stores of the jobs", run, of, settings->str,
      options->shard_count, part);
  return sb_output_write(options->slurm, text, strlen(text), &error) ? SB_EXIT_DONE
                                                                     : sb_cli_error(error);
}

static int study_answered(void *data, const SbCliAnswers *of) {
  return write_outputs(data, of);
}

static int study_file(const StudyOptions *options, const SbStudyFile *study) {
  g_autofree char *path = sb_cli_store_path(options->store, study);
  const int code = sb_cli_answers_elsewhere() ? SB_EXIT_DONE : check_targets(options, path);
  if (code != SB_EXIT_DONE) {
    return code;
  }
  const SbCliAsk ask = {.store = path,
                        .threads = options->threads,
                        .shard = options->shard_index,
                        .shards = options->shard_count};
  return sb_cli_answer(study, &ask, study_answered, (void *)options);
}

int sb_command_study(int argc, char **argv) {
  StudyOptions options = {0};
  const GOptionEntry entries[] = {
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &options.store,
       "Store of the answers, added to if it exists; default NAME.store next to the study file, or "
       "in "
       "the current folder for a study of the installed program",
       "STORE"},
      {"jobs", 0, 0, G_OPTION_ARG_FILENAME, &options.jobs, SB_CLI_JOBS_HELP, "N"},
      {"shard", 0, 0, G_OPTION_ARG_FILENAME, &options.shard,
       "Computes the part I of N alone, from 1; `sealbench merge` joins the stores", "I/N"},
      {"emit-slurm", 0, 0, G_OPTION_ARG_FILENAME, &options.slurm,
       "Computes nothing: writes a job script for an array of the N shards", "FILE"},
      {"csv", 0, 0, G_OPTION_ARG_FILENAME, &options.csv, "A row a sample, to a file or -", "FILE"},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &options.settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &options.json, "JSON to a file or -", "FILE|-"},
      {"plot", 0, 0, G_OPTION_ARG_NONE, &options.plots.on, SB_CLI_PLOT_HELP, NULL},
      {"no-plot", 0, 0, G_OPTION_ARG_NONE, &options.plots.off, SB_CLI_NO_PLOT_HELP, NULL},
      {0},
  };
  int code = SB_EXIT_INPUT;
  if (sb_cli_parse(&argc, &argv, entries, 1, 1, NULL) &&
      (code = read_study_options(&options)) == SB_EXIT_DONE) {
    g_autoptr(SbStudyFile) study = sb_cli_open_study(argv[1], options.settings);
    code = study == NULL           ? SB_EXIT_INPUT
           : options.slurm != NULL ? emit_slurm(&options, study)
                                   : study_file(&options, study);
  }
  return code;
}

int sb_command_merge(int argc, char **argv) {
  if (!sb_cli_parse(&argc, &argv, NULL, 2, SB_CLI_FILES_MAX, NULL)) {
    return SB_EXIT_INPUT;
  }
  for (int i = 2; i < argc; i++) {
    if (!g_file_test(argv[i], G_FILE_TEST_IS_REGULAR)) {
      return sb_cli_fail("%s: is not a file", argv[i]);
    }
  }
  GError *error = NULL;
  const bool existed = g_file_test(argv[1], G_FILE_TEST_EXISTS);
  SbStore *store = sb_store_open(argv[1], &error);
  bool good = store != NULL;
  for (int i = 2; good && i < argc; i++) {
    good = sb_store_merge(store, argv[i], &error);
  }
  if (good && !sb_cli_quiet()) {
    printf("%s: %" G_GUINT64_FORMAT " answers\n", argv[1], sb_store_count(store));
  }
  if (!good) {
    sb_store_discard(store);
    if (!existed) {
      g_unlink(argv[1]);
    }
    return sb_cli_error(error);
  }
  return sb_store_close(store, &error) ? SB_EXIT_DONE : sb_cli_error(error);
}
