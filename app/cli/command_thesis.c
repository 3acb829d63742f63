// sealbench thesis: tables and figures of the thesis, recomputed and compared with the printed
// values.
#include "app/cli/cli.h"

#include "app/document/shipped.h"
#include "app/export/thesis_results.h"

#include <math.h>
#include <string.h>

// ---- The list ----

static int list_items(const char *json) {
  g_auto(GStrv) items = sb_thesis_items();
  if (items == NULL) {
    return sb_cli_fail("the folder of the thesis' tables and figures is missing");
  }
  static const SbTableColumn columns[] = {{.key = "item", .layout = "%-14s"},
                                          {.key = "title", .layout = " %s"}};
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (char **item = items; *item != NULL; item += 2) {
    sb_table_add(table, SB_CELLS(sb_cell_text(item[0]), sb_cell_text(item[1])));
  }
  return json == NULL && sb_cli_quiet() ? SB_EXIT_DONE : sb_cli_table(table, json);
}

// ---- Results ----

typedef struct {
  SbThesisItem *const *items;
  size_t count;
} ThesisFiles;

static bool add_item(SbOutputFolder *out, const SbThesisItem *item, GError **error) {
  FILE *stream;
  SbJson json;
  g_autofree char *picture = g_strconcat(item->name, ".svg", NULL);
  g_autofree char *rows = g_strconcat(item->name, ".csv", NULL);
  g_autofree char *result = g_strconcat(item->name, ".json", NULL);
  if (item->rows->len > 0) {
    if (!sb_output_folder_add(&stream, out, rows, error)) {
      return false;
    }
    sb_csv_thesis(stream, item);
  }
  sb_json_init(&json);
  sb_json_thesis(&json, item);
  g_autofree char *text = sb_json_finish(&json);
  return sb_output_folder_add_text(out, result, text, error) &&
         (item->chart == NULL || (sb_output_folder_add(&stream, out, picture, error) &&
                                  sb_thesis_still(stream, item, ".svg", error)));
}

static bool add_index(SbOutputFolder *out, SbThesisItem *const *items, size_t count,
                      GError **error) {
  FILE *page, *text;
  if (!sb_output_folder_add(&page, out, "index.html", error)) {
    return false;
  }
  sb_html_thesis_begin(page, items, count);
  for (size_t i = 0; i < count; i++) {
    g_autofree char *picture = g_strconcat(items[i]->name, ".svg", NULL);
    sb_html_thesis(page, items[i], items[i]->chart != NULL ? picture : NULL);
  }
  sb_html_thesis_end(page);
  if (!sb_output_folder_add(&text, out, "thesis.md", error)) {
    return false;
  }
  g_autofree char *folder = sb_shipped_thesis();
  g_autofree char *path = g_build_filename(folder, "introduction.md", NULL);
  g_autofree char *introduction = NULL;
  if (!g_file_get_contents(path, &introduction, NULL, error)) {
    return false;
  }
  // It has values of many items.
  g_autofree char *filled = count > 1 ? sb_thesis_introduction(introduction, items, count) : NULL;
  fputs(filled != NULL ? filled : "", text);
  for (size_t i = 0; i < count; i++) {
    sb_markdown_thesis(text, items[i]);
  }
  return true;
}

static bool fill_thesis_folder(SbOutputFolder *folder, void *data, GError **error) {
  const ThesisFiles *files = data;
  bool good = true;
  for (size_t i = 0; good && i < files->count; i++) {
    good = add_item(folder, files->items[i], error);
  }
  return good && add_index(folder, files->items, files->count, error);
}

static int emit(SbThesisItem *const *items, size_t count, bool array, const char *target) {
  SbJson json;
  sb_json_init(&json);
  if (array) {
    sb_json_array(&json, NULL);
  }
  for (size_t i = 0; i < count; i++) {
    sb_json_thesis(&json, items[i]);
  }
  if (array) {
    sb_json_array_end(&json);
  }
  g_autofree char *text = sb_json_finish(&json);
  return sb_cli_emit(text, target);
}

// ---- The work ----

typedef struct {
  const char *name;
  SbThesisItem *item; // NULL: failed
  GPtrArray *issues;
} Job;

typedef struct {
  GPtrArray *jobs; // of Job *
  int threads;     // of one item
  SbThesisRuns *runs;
  gint done;
} Work;

static void compute_thesis(void *data, void *user) {
  Job *job = data;
  Work *work = user;
  job->item = sb_thesis_compute(job->name, work->threads, work->runs, sb_cli_interrupted, NULL,
                                job->issues);
  g_atomic_int_inc(&work->done);
}

// Several items side by side, each on one thread; one on all.
static void compute_all(Work *work, int threads) {
  SbProgress progress;
  sb_progress_start(&progress, "");
  work->threads = work->jobs->len > 1 ? 1 : threads;
  GThreadPool *pool =
      g_thread_pool_new(compute_thesis, work, work->jobs->len > 1 ? threads : 1, FALSE, NULL);
  for (guint i = 0; i < work->jobs->len; i++) {
    (void)g_thread_pool_push(pool, work->jobs->pdata[i], NULL);
  }
  while (g_atomic_int_get(&work->done) < (gint)work->jobs->len) {
    g_usleep(20000);
    sb_progress_update(&progress, (double)g_atomic_int_get(&work->done) / work->jobs->len);
  }
  g_thread_pool_free(pool, FALSE, TRUE);
  sb_progress_end(&progress);
}

// What must be said of the results: an exit code.
static int judge_thesis(const Work *work) {
  int code = SB_EXIT_DONE;
  for (guint i = 0; i < work->jobs->len; i++) {
    const Job *job = work->jobs->pdata[i];
    sb_cli_issues(job->issues);
    if (job->item == NULL) {
      code = MAX(code, sb_cli_interrupted(NULL) ? SB_EXIT_INTERRUPTED : SB_EXIT_INPUT);
      continue;
    }
    for (guint k = 0; k < job->item->rows->len; k++) {
      const SbThesisRow *row = job->item->rows->pdata[k];
      if (row->verdict == SB_THESIS_FAILS) {
        code = MAX(code, SB_EXIT_NOT_CONVERGED);
        (void)sb_cli_fail("%s: %s: %s", job->item->name, row->label, row->fault);
      }
    }
  }
  return code;
}

static void free_job(void *data) {
  Job *job = data;
  sb_thesis_item_free(job->item);
  g_ptr_array_unref(job->issues);
  g_free(job);
}

// Adds a job for the item `name`, or for all items if it is NULL. Returns false with a message if
// there is no such item.
static bool take_names(Work *work, char **items, const char *name) {
  g_autoptr(GString) names = g_string_new(NULL);
  for (char **item = items; *item != NULL; item += 2) {
    g_string_append_printf(names, "%s%s", names->len > 0 ? "|" : "", *item);
    if (name == NULL || strcmp(name, *item) == 0) {
      Job *job = g_new0(Job, 1);
      job->name = *item;
      job->issues = sb_issues_new();
      g_ptr_array_add(work->jobs, job);
    }
  }
  if (work->jobs->len == 0) {
    (void)sb_cli_unknown("there is no table or figure", name != NULL ? name : "", names->str,
                         "see sealbench thesis");
  }
  return work->jobs->len > 0;
}

static int run(char **items, const char *name, int threads, const char *folder,
               const char *target) {
  Work work = {.jobs = g_ptr_array_new_with_free_func(free_job), .runs = sb_thesis_runs_new()};
  int code = SB_EXIT_INPUT;
  if (take_names(&work, items, name)) {
    char *const names[] = {(char *)"index.html", (char *)"thesis.md", NULL};
    code = sb_cli_check_outputs(folder, names, target);
  }
  if (code == SB_EXIT_DONE) {
    sb_cli_catch_interrupts();
    compute_all(&work, threads);
    g_autofree SbThesisItem **done = g_new(SbThesisItem *, work.jobs->len);
    size_t count = 0;
    for (guint i = 0; i < work.jobs->len; i++) {
      const Job *job = work.jobs->pdata[i];
      if (job->item != NULL) {
        done[count++] = job->item;
      }
    }
    code = judge_thesis(&work);
    ThesisFiles files = {done, count};
    const int written = folder != NULL && count > 0
                            ? sb_cli_write_folder(folder, "thesis", fill_thesis_folder, &files)
                            : SB_EXIT_DONE;
    code = written != SB_EXIT_DONE ? written : code;
    if (target != NULL && count > 0 && written == SB_EXIT_DONE) {
      const int emitted = emit(done, count, name == NULL, target);
      code = emitted != SB_EXIT_DONE ? emitted : code;
    }
    for (size_t i = 0; i < count && target == NULL && !sb_cli_quiet(); i++) {
      g_autofree char *table = sb_thesis_table(done[i]);
      fputs(table, stdout);
    }
  }
  g_ptr_array_unref(work.jobs);
  sb_thesis_runs_free(work.runs);
  return code;
}

int sb_command_thesis(int argc, char **argv) {
  char *folder = NULL, *target = NULL, *jobs = NULL;
  gboolean all = FALSE;
  const GOptionEntry entries[] = {
      {"all", 0, 0, G_OPTION_ARG_NONE, &all, "All of them", NULL},
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &folder,
       "Folder for tables, charts and a page, index.html", "DIR"},
      {"jobs", 0, 0, G_OPTION_ARG_FILENAME, &jobs, SB_CLI_JOBS_HELP, "N"},
      {"json", 0, 0, G_OPTION_ARG_FILENAME, &target, "JSON to a file or -; with --all an array",
       "FILE|-"},
      {0},
  };
  int code = SB_EXIT_INPUT, threads = 1;
  if (sb_cli_parse(&argc, &argv, entries, 0, 1,
                   "Without ITEM and --all: the list. Exit code 2: a difference has no reason.") &&
      sb_cli_jobs(&threads, jobs)) {
    g_auto(GStrv) items = sb_thesis_items();
    if (all && argc > 1) {
      (void)sb_cli_fail("--all and %s: one or the other", argv[1]);
    } else if (!all && argc < 2) {
      code = folder != NULL ? sb_cli_fail("-o needs an item or --all") : list_items(target);
    } else if (items == NULL) {
      (void)sb_cli_fail("the folder of the thesis' tables and figures is missing");
    } else {
      code = run(items, all ? NULL : argv[1], threads, folder, target);
    }
  }
  return code;
}
