// Grids that say more than levels of parameters: several in one file, variables, and what follows
// from them; see study_file.h.
#include "app/document/expression.h"
#include "app/document/study_file_private.h"

#include <math.h>
#include <string.h>

const char *sb_vary_name(const SbVary *vary) {
  return vary->id == SB_VARY_VARIABLE ? vary->name : sb_param(vary->id)->key;
}

const char *sb_vary_si(const SbVary *vary) {
  return vary->id == SB_VARY_VARIABLE ? "1" : sb_param(vary->id)->si;
}

bool sb_study_base_value(double *out, const char *name, void *data) {
  const int id = sb_param_find(name);
  if (id >= 0) {
    *out = sb_model_value(data, (SbParamId)id);
  }
  return id >= 0;
}

double sb_study_grid_level(const SbDistribution *of, size_t index) {
  if (of->kind == SB_DISTRIBUTION_LEVELS) {
    return of->level[index];
  }
  const double t = (double)index / (double)(of->count - 1);
  return of->kind == SB_DISTRIBUTION_LOGUNIFORM
             ? of->a * pow(of->b / of->a, t)
             : of->a + (of->b - of->a) * (double)index / (double)(of->count - 1);
}

// ---- What a sample is ----

// Lines of a grid, which are what varies where it says no more.
static guint line_count(const SbStudyFile *study) {
  return study->lines != NULL ? study->lines->len : study->vary->len;
}

static const SbVary *line_at(const SbStudyFile *study, guint i) {
  return &g_array_index(study->lines != NULL ? study->lines : study->vary, SbVary, i);
}

// Whether a line has levels in a group.
static bool runs(const SbVary *line, guint grid) {
  return line->by == NULL && (line->grid == 0 || line->grid == grid);
}

// The last line of a group with levels, which runs fastest; NULL: it has none.
static const SbVary *fastest(const SbStudyFile *study, guint grid) {
  const SbVary *last = NULL;
  for (guint i = 0; i < line_count(study); i++) {
    const SbVary *line = line_at(study, i);
    // Those of [vary] stand before those of the group, wherever they are in the file.
    const bool behind = last == NULL || line->grid > 0 || last->grid == 0;
    last = runs(line, grid) && behind ? line : last;
  }
  return last;
}

// Samples of a group; 0: a line has no levels, or there are too many.
static size_t samples_of(const SbStudyFile *study, guint grid) {
  size_t points = 1;
  for (guint i = 0; i < line_count(study); i++) {
    const SbVary *line = line_at(study, i);
    if (runs(line, grid)) {
      const size_t count = line->distribution.count;
      points = count > 0 && count <= SB_SAMPLES_MAX / points ? points * count : 0;
    }
    if (points == 0) {
      return 0;
    }
  }
  return points;
}

static guint first_grid(const SbStudyFile *study) {
  return study->grids > 0 ? 1 : 0;
}

size_t sb_study_grid_points(const SbStudyFile *study) {
  size_t points = 0;
  for (guint grid = first_grid(study); grid <= study->grids; grid++) {
    points += samples_of(study, grid);
  }
  return points;
}

size_t sb_study_grid_samples(const SbStudyFile *study, guint grid) {
  return samples_of(study, grid);
}

void sb_study_grid_place(size_t *line, double *x, const SbStudyFile *study, size_t sample) {
  *line = 0;
  for (guint grid = first_grid(study); grid <= study->grids; grid++) {
    const SbDistribution *of = &fastest(study, grid)->distribution;
    const size_t count = samples_of(study, grid);
    if (sample < count) {
      *line += sample / of->count;
      *x = sb_study_grid_level(of, sample % of->count);
      return;
    }
    sample -= count;
    *line += count / of->count;
  }
}

// Names in an expression: keys of the base, variables of the row.
typedef struct {
  const SbStudyFile *study;
  const double *row;
} Names;

static bool value_of(double *out, const char *name, void *data) {
  const Names *names = data;
  for (guint k = 0; k < names->study->vary->len; k++) {
    const SbVary *vary = &g_array_index(names->study->vary, SbVary, k);
    if (vary->id == SB_VARY_VARIABLE && strcmp(vary->name, name) == 0) {
      *out = isnan(names->row[k]) ? 0 : names->row[k];
      return true;
    }
  }
  return sb_study_base_value(out, name, names->study->base);
}

static bool follow(double *out, const SbStudyFile *study, const SbVary *line, const double *row,
                   GError **error) {
  Names names = {study, row};
  const bool variable = line->id == SB_VARY_VARIABLE;
  return sb_expression_value(out, line->by, sb_vary_si(line),
                             variable ? "" : sb_param(line->id)->unit, value_of, &names, error);
}

void sb_study_grid_follow(double *row, const SbStudyFile *study, guint grid) {
  for (guint i = 0; i < line_count(study); i++) {
    const SbVary *line = line_at(study, i);
    if (line->by != NULL && (line->grid == 0 || line->grid == grid)) {
      double value = NAN;
      (void)follow(&value, study, line, row, NULL);
      row[line->column] = value;
    }
  }
}

// A group's sample, what follows left out.
static void put_levels(double *row, const SbStudyFile *study, guint grid, size_t sample) {
  for (guint k = 0; k < study->vary->len; k++) {
    row[k] = NAN;
  }
  for (int own = 1; own >= 0; own--) { // the group's lines run faster than those of [vary]
    for (guint i = line_count(study); i-- > 0;) {
      const SbVary *line = line_at(study, i);
      const size_t count = line->distribution.count;
      if (runs(line, grid) && (line->grid > 0) == own) {
        row[line->column] = sb_study_grid_level(&line->distribution, sample % count);
        sample /= count;
      }
    }
  }
}

void sb_study_grid_row(double *row, guint *grid, guint *column, const SbStudyFile *study,
                       size_t line) {
  size_t levels = 0;
  for (*grid = first_grid(study);; ++*grid) {
    levels = fastest(study, *grid)->distribution.count;
    const size_t lines = samples_of(study, *grid) / levels;
    if (line < lines || *grid == study->grids) {
      break;
    }
    line -= lines;
  }
  *column = fastest(study, *grid)->column;
  put_levels(row, study, *grid, line * levels);
}

void sb_study_grid_fill(double *value, const SbStudyFile *study) {
  double *row = value;
  for (guint grid = first_grid(study); grid <= study->grids; grid++) {
    const size_t count = samples_of(study, grid);
    for (size_t i = 0; i < count; i++, row += study->vary->len) {
      put_levels(row, study, grid, i);
      sb_study_grid_follow(row, study, grid);
    }
  }
}

// ---- Reading ----

static void complain(const SbStudyReader *reader, const SbVary *line, const char *text) {
  g_autofree char *key = g_strconcat(GROUP_VARY ".", sb_vary_name(line), NULL);
  sb_issues_add(reader->issues, reader->shown, line->line, key, NULL, "%s", text);
}

// Gives a line its column: that of the same parameter or variable in another group.
static bool find_column(SbStudyFile *study, SbVary *line) {
  for (line->column = 0; line->column < study->vary->len; line->column++) {
    const SbVary *of = &g_array_index(study->vary, SbVary, line->column);
    if (strcmp(sb_vary_name(of), sb_vary_name(line)) == 0) {
      return true;
    }
  }
  if (study->vary->len == SB_VARY_MAX) {
    return false;
  }
  const SbVary column = {.id = line->id, .name = line->name};
  g_array_append_val(study->vary, column);
  return true;
}

static bool says_more(const SbVary *line) {
  return line->grid > 0 || line->by != NULL || line->id == SB_VARY_VARIABLE;
}

void sb_study_take_lines(SbStudyReader *reader) {
  SbStudyFile *study = reader->study;
  bool more = false;
  for (guint i = 0; i < study->vary->len; i++) {
    SbVary *line = &g_array_index(study->vary, SbVary, i);
    line->column = i;
    more = more || says_more(line);
  }
  if (!more) {
    return;
  }
  study->lines = study->vary;
  study->vary = g_array_new(FALSE, FALSE, sizeof(SbVary));
  const guint before = reader->issues->len;
  for (guint i = 0; i < study->lines->len; i++) {
    SbVary *line = &g_array_index(study->lines, SbVary, i);
    if (study->method != SB_METHOD_GRID || study->design.asked) {
      complain(reader, line, "variables, expressions and groups [vary NAME] belong to a grid");
      return;
    }
    if (line->by == NULL && line->distribution.count == 0) {
      complain(reader, line, "a grid needs levels, or a range with a number of points");
    } else if (!find_column(study, line)) {
      complain(reader, line, "is more than the 64 parameters that may vary");
    }
  }
  // With all variables known, at 1, which no quotient minds.
  double row[SB_VARY_MAX];
  for (guint k = 0; k < SB_VARY_MAX; k++) {
    row[k] = 1;
  }
  for (guint i = 0; reader->issues->len == before && study->base != NULL && i < study->lines->len;
       i++) {
    const SbVary *line = line_at(study, i);
    g_autoptr(GError) error = NULL;
    double value;
    if (line->by != NULL && !follow(&value, study, line, row, &error)) {
      complain(reader, line, error->message);
    }
  }
  bool good = study->grids <= SB_VARY_MAX;
  for (guint grid = first_grid(study); good && grid <= study->grids; grid++) {
    good = fastest(study, grid) != NULL && samples_of(study, grid) > 0;
  }
  if (reader->issues->len == before && (!good || sb_study_grid_points(study) > SB_SAMPLES_MAX)) {
    sb_issues_add(
        reader->issues, reader->shown, 0, GROUP_VARY, NULL,
        "each group [vary NAME] requires the levels of a parameter; at most %d groups, together "
        "%d points",
        SB_VARY_MAX, SB_SAMPLES_MAX);
  }
}
