// Expressions of an item of the thesis and the answers that they need; see thesis_private.h.
#include "app/study/thesis_private.h"

#include "app/document/expression.h"
#include "app/study/answers.h"

#include "engine/valve/run/run.h"

#include <math.h>
#include <string.h>

// ---- Expressions ----

static int column_of(const GArray *figures, int figure) {
  for (guint k = 0; k < figures->len; k++) {
    if (g_array_index(figures, int, k) == figure) {
      return (int)k;
    }
  }
  return -1;
}

// The sample's model, which other values may follow in from those that vary; kept.
static const SbModel *model_of(const SbThesisPlace *at) {
  GHashTable *models = at->grid->models;
  SbModel *model = g_hash_table_lookup(models, GSIZE_TO_POINTER(at->sample));
  if (model == NULL && (model = sb_thesis_model(at->work, at->grid, at->sample)) != NULL) {
    g_hash_table_insert(models, GSIZE_TO_POINTER(at->sample), model);
  }
  return model;
}

// The grid of one sample that "GRID.FIGURE" names; *figure is what is behind it. NULL: it names
// none.
static SbThesisGrid *grid_in_name(int *figure, const SbThesisWork *work, const char *name) {
  const char *dot = strchr(name, '.');
  *figure = dot != NULL ? sb_figure_find(dot + 1) : -1;
  for (guint i = 0; *figure >= 0 && i < work->grids->len; i++) {
    SbThesisGrid *grid = work->grids->pdata[i];
    if (grid->samples == 1 && strlen(grid->name) == (size_t)(dot - name) &&
        strncmp(grid->name, name, (size_t)(dot - name)) == 0) {
      return grid;
    }
  }
  return NULL;
}

static bool sample_value(double *out, const SbThesisPlace *at, const char *name) {
  const SbThesisWork *work = at->work;
  int other;
  const SbThesisGrid *elsewhere = grid_in_name(&other, work, name);
  if (elsewhere != NULL && elsewhere->done) {
    *out = elsewhere->value[column_of(elsewhere->figures, other)];
    return true;
  }
  const SbStudyFile *study = work->study;
  const int figure = sb_figure_find(name);
  if (figure >= 0) {
    const int column = at->grid != NULL ? column_of(at->grid->figures, figure) : -1;
    if (column >= 0 && at->grid->done) {
      *out = at->grid->value[at->sample * at->grid->figures->len + (size_t)column];
    }
    return column >= 0 && at->grid->done;
  }
  const size_t vary = study->vary->len;
  const double *point =
      at->grid != NULL ? &work->point[(at->grid->first + at->sample) * vary] : NULL;
  for (guint k = 0; point != NULL && k < vary; k++) {
    if (strcmp(sb_vary_name(&g_array_index(study->vary, SbVary, k)), name) == 0 &&
        isfinite(point[k])) {
      *out = point[k];
      return true;
    }
  }
  const int id = sb_param_find(name);
  const SbModel *model = id >= 0 && at->grid != NULL ? model_of(at) : study->base;
  if (id >= 0 && model != NULL) {
    *out = sb_model_value(model, (SbParamId)id);
  }
  return id >= 0 && model != NULL;
}

// "COLUMN" of the printed row, or "COLUMN.rounding", half of its last digit's unit.
static bool printed_value(double *out, const SbThesisPlace *at, const char *name) {
  static const char ROUNDING[] = ".rounding";
  if (at->row < 0 || at->work->printed == NULL) {
    return false;
  }
  const bool rounding = g_str_has_suffix(name, ROUNDING);
  g_autofree char *column = g_strndup(name, strlen(name) - (rounding ? strlen(ROUNDING) : 0));
  const char *cell = sb_printed_cell(at->work->printed, (guint)at->row, column);
  double value, half;
  if (cell != NULL) {
    const bool number = sb_printed_number(&value, &half, cell);
    *out = !number ? NAN : rounding ? half : value;
  }
  return cell != NULL;
}

static bool value_of(double *out, const char *name, void *data) {
  const SbThesisPlace *at = data;
  if (at->frame != NULL || at->profile != NULL) {
    return sb_thesis_run_value(out, name, at);
  }
  const struct {
    const char *name;
    double value;
  } known[] = {{"pi", G_PI},
               {"printed", at->printed},
               {"thesis", at->thesis},
               {"consistent", at->consistent},
               {"ours", at->ours}};
  for (size_t i = 0; i < G_N_ELEMENTS(known); i++) {
    if (strcmp(name, known[i].name) == 0) {
      *out = known[i].value;
      return true;
    }
  }
  return printed_value(out, at, name) || sample_value(out, at, name);
}

bool sb_thesis_value(double *out, const SbThesisPlace *at, const char *text, const char *group,
                     const char *key) {
  g_autoptr(GError) error = NULL;
  SbThesisPlace place = *at;
  *out = NAN;
  if (sb_expression_value(out, text, "1", "", value_of, &place, &error)) {
    return true;
  }
  // A quantity that has no value leaves the row without one.
  *out = NAN;
  if (g_error_matches(error, SB_APP_ERROR, SB_APP_ERROR_RANGE)) {
    return true;
  }
  sb_thesis_add_issue(at->work, group, key, "%s", error->message);
  return false;
}

bool sb_thesis_grid(SbThesisGrid **grid, const char **expression, SbThesisWork *work,
                    const char *text, const char *group, const char *key) {
  const char *colon = strchr(text, ':');
  *grid = NULL;
  *expression = text;
  if (colon == NULL) {
    return true;
  }
  g_autofree char *name = g_strstrip(g_strndup(text, (gsize)(colon - text)));
  *expression = colon + 1 + strspn(colon + 1, " ");
  for (guint i = 0; i < work->grids->len; i++) {
    SbThesisGrid *of = work->grids->pdata[i];
    if (strcmp(of->name, name) == 0) {
      *grid = of;
      return true;
    }
  }
  sb_thesis_add_issue(work, group, key, "there is no grid [vary %s]", name);
  return false;
}

// ---- Answers ----

typedef struct {
  SbThesisWork *work;
  SbThesisGrid *grid;
} Gathering;

// Takes note of a figure; every name is 1.
static bool gather(double *out, const char *name, void *data) {
  const Gathering *to = data;
  int figure;
  SbThesisGrid *grid = grid_in_name(&figure, to->work, name);
  if (grid == NULL) {
    grid = to->grid;
    figure = sb_figure_find(name);
  }
  if (figure >= 0 && grid != NULL && column_of(grid->figures, figure) < 0) {
    g_array_append_val(grid->figures, figure);
  }
  *out = 1;
  return true;
}

static void gather_from(SbThesisWork *work, const char *text) {
  Gathering to = {work, NULL};
  const char *expression;
  const guint before = work->issues->len;
  if (sb_thesis_grid(&to.grid, &expression, work, text, "", "") && to.grid != NULL) {
    double value;
    (void)sb_expression_value(&value, expression, "1", "", gather, &to, NULL);
  }
  g_ptr_array_set_size(work->issues, (gint)before); // told where it is used
}

// The expression of a value: behind the last bar, without what says that it is a bound.
static const char *expression_of(const char *value) {
  const char *bar = strrchr(value, '|');
  const char *text = bar != NULL ? bar + 1 : value;
  text += strspn(text, " ");
  return sb_thesis_bound(NULL, NULL, text);
}

// All that the texts of a group's keys name: an expression stands behind the last bar, what is in
// brackets differs from row to row, and values to be written stand in braces.
static void gather_entry(SbThesisWork *work, const SbEntry *entry) {
  const char *text = expression_of(entry->value);
  const guint rows =
      strchr(text, '[') != NULL && work->printed != NULL ? work->printed->rows->len : 1;
  for (guint row = 0; row < rows; row++) {
    const SbThesisPlace at = {.work = work, .row = (int)row};
    g_autofree char *whole = sb_thesis_with_cells(&at, text);
    gather_from(work, whole);
  }
  for (const char *c = entry->value; (c = strstr(c, "{=")) != NULL; c += 2) {
    g_autofree char *inside = g_strndup(c + 2, strcspn(c + 2, ",}"));
    gather_from(work, g_strstrip(inside));
  }
}

static bool has_figures(const SbThesisGrid *grid) {
  return grid->figures->len > 0;
}

// ---- Samples that are asked for ----

// Whether a text is "GRID: ..." of this grid.
static bool is_of(const SbThesisGrid *grid, const char *text) {
  const size_t length = strlen(grid->name);
  return strncmp(text, grid->name, length) == 0 && text[length] == ':';
}

static bool names_grid(const SbEntry *entry, const SbThesisGrid *grid) {
  return is_of(grid, expression_of(entry->value));
}

// The samples of a grid that rows ask for; a curve asks for all.
static void find_wanted(SbThesisWork *work, SbThesisGrid *grid) {
  grid->wanted = g_new0(bool, grid->samples);
  bool all = grid->samples == 1;
  for (guint i = 0; i < work->entries->len && has_figures(grid); i++) {
    const SbEntry *entry = work->entries->pdata[i];
    const bool used = entry->name != NULL && names_grid(entry, grid);
    if (used && g_str_has_prefix(entry->group, "rows ")) {
      sb_thesis_want(work, grid, entry->group);
    }
    all = all || (used && g_str_has_prefix(entry->group, "series "));
    // A text has the figures of the first sample.
    for (const char *c = entry->name != NULL ? entry->value : ""; (c = strstr(c, "{=")) != NULL;) {
      c += 2;
      c += strspn(c, " ");
      grid->wanted[0] = grid->wanted[0] || is_of(grid, c);
    }
  }
  for (size_t i = 0; i < grid->samples && all; i++) {
    grid->wanted[i] = true;
  }
}

// ---- Answers ----

typedef struct {
  GMutex lock;
  SbThesisGrid *grid;
  SbThesisWork *work;
  size_t *sample; // of those asked for
} Seen;

bool sb_thesis_stopped(SbThesisWork *work) {
  work->stopped = work->stopped || (work->cancelled != NULL && work->cancelled(work->data));
  return work->stopped;
}

static bool on_cancelled(void *data) {
  return sb_thesis_stopped(((Seen *)data)->work);
}

static void on_seen(void *data, size_t sample, SbStatus status, const SbReport *report,
                    const SbEvaluator *evaluator) {
  Seen *seen = data;
  const char *reason = status != SB_OK && report != NULL ? report->text : NULL;
  for (guint k = 0; reason == NULL && k < seen->grid->figures->len; k++) {
    reason = sb_evaluator_reason(evaluator, g_array_index(seen->grid->figures, int, k));
  }
  if (reason != NULL) {
    g_mutex_lock(&seen->lock);
    g_hash_table_insert(seen->grid->reason, GSIZE_TO_POINTER(seen->sample[sample]),
                        g_strdup(reason));
    g_mutex_unlock(&seen->lock);
  }
}

// The figures of those samples that are asked for; the others stay without a value.
static bool answer_grid(SbThesisWork *work, SbThesisGrid *grid) {
  const SbStudyFile *study = work->study;
  const size_t vary = study->vary->len, figures = grid->figures->len;
  if (!has_figures(grid)) {
    return true;
  }
  find_wanted(work, grid);
  g_autofree SbParamId *parameter = g_new(SbParamId, vary);
  g_autofree size_t *sample = g_new(size_t, grid->samples);
  g_autofree double *point = g_new(double, grid->samples *vary);
  size_t count = 0;
  for (size_t k = 0; k < vary; k++) {
    parameter[k] = g_array_index(study->vary, SbVary, k).id;
  }
  for (size_t i = 0; i < grid->samples; i++) {
    if (grid->wanted[i]) {
      memcpy(&point[count * vary], &work->point[(grid->first + i) * vary], vary * sizeof *point);
      sample[count++] = i;
    }
  }
  Seen seen = {.grid = grid, .work = work, .sample = sample};
  g_mutex_init(&seen.lock);
  const SbQuestions asked = {.base = study->base,
                             .base_sha256 = "",
                             .parameter = parameter,
                             .parameters = vary,
                             .figure = (const int *)(const void *)grid->figures->data,
                             .figures = figures,
                             .value = point,
                             .samples = count,
                             .jobs = work->jobs,
                             .seen = on_seen,
                             .cancelled = on_cancelled,
                             .data = &seen};
  SbAnswers answers = {0};
  g_autoptr(GError) error = NULL;
  const bool good = count == 0 || sb_answers_get(&answers, &asked, &error);
  if (good) {
    grid->value = g_new(double, grid->samples *figures);
    for (size_t i = 0; i < grid->samples * figures; i++) {
      grid->value[i] = NAN;
    }
    for (size_t i = 0; i < count; i++) {
      memcpy(&grid->value[sample[i] * figures], &answers.value[i * figures],
             figures * sizeof *grid->value);
    }
    grid->done = true;
  } else if (!work->stopped) {
    sb_thesis_add_issue(work, "vary", grid->name, "%s", error->message);
  }
  sb_answers_release(&answers);
  g_mutex_clear(&seen.lock);
  return good;
}

// Computes all figures of all grids that expressions of rows and series use. Returns false if that
// failed (with an issue) or was cancelled.
bool sb_thesis_answer_grids(SbThesisWork *work) {
  for (guint i = 0; i < work->entries->len; i++) {
    const SbEntry *entry = work->entries->pdata[i];
    if (entry->name != NULL &&
        (g_str_has_prefix(entry->group, "rows ") || g_str_has_prefix(entry->group, "series ") ||
         strcmp(entry->group, "notes") == 0)) {
      gather_entry(work, entry);
    }
  }
  for (guint i = 0; i < work->grids->len; i++) {
    if (sb_thesis_stopped(work) || !answer_grid(work, work->grids->pdata[i])) {
      return false;
    }
  }
  return true;
}
