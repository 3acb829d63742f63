// Reads an item of the thesis and has its grids answered; rows and charts are in files of their
// own.
#include "app/study/thesis_private.h"

#include "app/document/shipped.h"

#include "engine/valve/run/run.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

void sb_thesis_add_issue(SbThesisWork *work, const char *group, const char *key, const char *format,
                         ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *text = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  g_autofree char *whole = g_strdup_printf("%s.%s", group, key);
  sb_issues_add(work->issues, work->path, 0, whole, NULL, "%s", text);
}

const char *sb_thesis_key(const SbThesisWork *work, const char *group, const char *name) {
  for (guint i = 0; i < work->entries->len; i++) {
    const SbEntry *entry = work->entries->pdata[i];
    if (entry->name != NULL && strcmp(entry->group, group) == 0 && strcmp(entry->name, name) == 0) {
      return entry->value;
    }
  }
  return NULL;
}

SbModel *sb_thesis_model(SbThesisWork *work, const SbThesisGrid *grid, size_t sample) {
  const SbStudyFile *study = work->study;
  SbOverride override[SB_VARY_MAX];
  size_t count = 0;
  for (guint k = 0; k < study->vary->len; k++) {
    const SbVary *vary = &g_array_index(study->vary, SbVary, k);
    const double value = work->point[(grid->first + sample) * study->vary->len + k];
    if (vary->id != SB_VARY_VARIABLE && isfinite(value)) {
      override[count++] = (SbOverride){vary->id, value};
    }
  }
  SbModel *model = NULL;
  SbReport report = {0};
  if (sb_model_derive(&model, study->base, override, count, &report) != SB_OK) {
    sb_thesis_add_issue(work, "vary", grid->name, "%s", report.text);
  }
  return model;
}

// ---- The file ----

static void free_grid(void *data) {
  SbThesisGrid *grid = data;
  g_free(grid->name);
  g_array_unref(grid->figures);
  g_free(grid->value);
  g_free(grid->wanted);
  g_hash_table_unref(grid->reason);
  g_hash_table_unref(grid->models);
  g_free(grid);
}

static void free_model(void *model) {
  sb_model_destroy(model);
}

static void add_grid(SbThesisWork *work, const char *name, size_t first) {
  SbThesisGrid *grid = g_new0(SbThesisGrid, 1);
  grid->name = g_strdup(name);
  grid->first = first;
  grid->figures = g_array_new(FALSE, FALSE, sizeof(int));
  grid->reason = g_hash_table_new_full(NULL, NULL, NULL, g_free);
  grid->models = g_hash_table_new_full(NULL, NULL, NULL, free_model);
  g_ptr_array_add(work->grids, grid);
}

// The groups [vary NAME] in their order, each with its samples.
static void find_grids(SbThesisWork *work) {
  size_t first = 0;
  guint number = 0;
  for (guint i = 0; i < work->entries->len; i++) {
    const SbEntry *entry = work->entries->pdata[i];
    if (entry->name == NULL && g_str_has_prefix(entry->group, "vary ")) {
      add_grid(work, entry->group + strlen("vary "), first);
      SbThesisGrid *grid = work->grids->pdata[number++];
      grid->samples = sb_study_grid_samples(work->study, number);
      first += grid->samples;
    }
  }
}

static bool open_printed(SbThesisWork *work, const char *folder) {
  const char *file = sb_thesis_key(work, "printed", "file");
  if (file == NULL) {
    return true;
  }
  g_autofree char *path = g_build_filename(folder, file, NULL);
  work->printed = sb_printed_load(path, work->issues);
  return work->printed != NULL;
}

static void fill(SbThesisItem *item, SbThesisWork *work) {
  if (!sb_thesis_answer_grids(work)) {
    return;
  }
  for (guint i = 0; i < work->entries->len && !work->stopped; i++) {
    const SbEntry *entry = work->entries->pdata[i];
    if (entry->name == NULL && g_str_has_prefix(entry->group, "rows ")) {
      sb_thesis_rows(item, work, entry->group);
    } else if (entry->name != NULL && strcmp(entry->group, "notes") == 0) {
      const SbThesisPlace at = {.work = work, .row = SB_THESIS_NO_ROW};
      g_ptr_array_add(item->notes, sb_thesis_filled(&at, entry->value, "notes", entry->name));
    } else if (entry->name == NULL && strcmp(entry->group, "chart") == 0) {
      sb_thesis_chart(item, work);
    }
  }
  for (guint i = 0; i < item->rows->len; i++) {
    item->fails += ((SbThesisRow *)item->rows->pdata[i])->verdict == SB_THESIS_FAILS;
  }
}

static void free_row(void *data) {
  SbThesisRow *row = data;
  g_array_unref(row->reasons);
  g_array_unref(row->models);
  g_free(row->label);
  g_free(row->no_thesis);
  g_free(row->no_consistent);
  g_free(row->fault);
  g_free(row);
}

static SbThesisItem *new_item(const char *name, const SbThesisWork *work) {
  SbThesisItem *item = g_new0(SbThesisItem, 1);
  item->name = g_strdup(name);
  item->title = g_strdup(work->study->title);
  item->rows = g_ptr_array_new_with_free_func(free_row);
  item->notes = g_ptr_array_new_with_free_func(g_free);
  if (work->printed != NULL) {
    g_ptr_array_add(work->printed->comments, NULL);
    item->source = g_strjoinv("\n", (char **)work->printed->comments->pdata);
  }
  return item;
}

void sb_thesis_item_free(SbThesisItem *item) {
  if (item != NULL) {
    g_ptr_array_unref(item->rows);
    g_ptr_array_unref(item->notes);
    g_free(item->name);
    g_free(item->title);
    g_free(item->source);
    g_free(item->chart);
    g_free(item);
  }
}

static void clear(SbThesisWork *work) {
  g_clear_pointer(&work->grids, g_ptr_array_unref);
  g_clear_pointer(&work->entries, g_ptr_array_unref);
  sb_printed_free(work->printed);
  sb_study_file_free(work->study);
  free(work->point);
}

SbThesisItem *sb_thesis_compute(const char *name, int jobs, SbThesisRuns *runs,
                                bool (*cancelled)(void *data), void *data, GPtrArray *issues) {
  g_autofree char *folder = sb_shipped_thesis();
  g_autofree char *file = g_strconcat(name, ".study", NULL);
  g_autofree char *path = g_build_filename(folder != NULL ? folder : ".", file, NULL);
  return sb_thesis_compute_file(path, jobs, runs, cancelled, data, issues);
}

SbThesisItem *sb_thesis_compute_file(const char *path, int jobs, SbThesisRuns *runs,
                                     bool (*cancelled)(void *data), void *data, GPtrArray *issues) {
  g_autofree char *folder = g_path_get_dirname(path);
  g_autofree char *name = g_path_get_basename(path);
  *(g_str_has_suffix(name, ".study") ? strrchr(name, '.') : name + strlen(name)) = '\0';
  SbThesisWork work = {.path = path,
                       .jobs = jobs,
                       .cancelled = cancelled,
                       .data = data,
                       .issues = issues,
                       .runs = runs != NULL ? runs : sb_thesis_runs_new(),
                       .grids = g_ptr_array_new_with_free_func(free_grid)};
  const guint before = issues->len;
  SbThesisItem *item = NULL;
  SbReport report = {0};
  size_t length = 0;
  g_autofree char *text = sb_reader_load(&length, path, path, SB_DOCUMENT_BYTES_MAX, issues);
  work.study = text != NULL ? sb_study_file_load(path, NULL, issues) : NULL;
  if (work.study != NULL) {
    work.entries = sb_reader_scan(text, length, path, issues);
    find_grids(&work);
    if (open_printed(&work, folder) &&
        sb_study_file_points(&work.point, NULL, work.study, &report) == SB_OK) {
      item = new_item(name, &work);
      fill(item, &work);
    }
  }
  clear(&work);
  if (runs == NULL) {
    sb_thesis_runs_free(work.runs);
  }
  if (issues->len > before || work.stopped) {
    g_clear_pointer(&item, sb_thesis_item_free);
  }
  return item;
}

// ---- The list ----

// In the order of chapters and numbers, tables first.
static int by_number(const void *a, const void *b) {
  const char *const of[2] = {*(char *const *)a, *(char *const *)b};
  double key[2];
  for (int i = 0; i < 2; i++) {
    const char *dash = strchr(of[i], '-');
    const char *dot = dash != NULL ? strchr(dash, '.') : NULL;
    const double chapter = dash != NULL ? g_ascii_strtod(dash + 1, NULL) : 0;
    const double number = dot != NULL ? g_ascii_strtod(dot + 1, NULL) : 0;
    key[i] = (g_str_has_prefix(of[i], "table") ? 0 : 1e6) + floor(chapter) * 1000 + number;
  }
  return key[0] < key[1] ? -1 : key[0] > key[1] ? 1 : strcmp(of[0], of[1]);
}

static char *title_of(const char *path) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  size_t length = 0;
  g_autofree char *text = sb_reader_load(&length, path, path, SB_DOCUMENT_BYTES_MAX, issues);
  g_autoptr(GPtrArray) entries =
      text != NULL ? sb_reader_scan(text, length, path, issues) : sb_issues_new();
  for (guint i = 0; text != NULL && i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    if (entry->name != NULL && strcmp(entry->name, "title") == 0) {
      return sb_printable(entry->value, strlen(entry->value));
    }
  }
  return g_strdup("");
}

char **sb_thesis_items(void) {
  g_autofree char *folder = sb_shipped_thesis();
  g_autoptr(GDir) dir = folder != NULL ? g_dir_open(folder, 0, NULL) : NULL;
  if (dir == NULL) {
    return NULL;
  }
  g_autoptr(GPtrArray) names = g_ptr_array_new_with_free_func(g_free);
  for (const char *name; (name = g_dir_read_name(dir)) != NULL;) {
    if (g_str_has_suffix(name, ".study")) {
      g_ptr_array_add(names, g_strndup(name, strlen(name) - strlen(".study")));
    }
  }
  g_ptr_array_sort(names, by_number);
  g_autoptr(GPtrArray) out = g_ptr_array_new();
  for (guint i = 0; i < names->len; i++) {
    g_autofree char *file = g_strconcat(names->pdata[i], ".study", NULL);
    g_autofree char *path = g_build_filename(folder, file, NULL);
    g_ptr_array_add(out, g_strdup(names->pdata[i]));
    g_ptr_array_add(out, title_of(path));
  }
  g_ptr_array_add(out, NULL);
  return (char **)g_ptr_array_free(g_steal_pointer(&out), FALSE);
}
