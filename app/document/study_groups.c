// Groups of a study file; see study_file.h.
#include "app/document/study_file_private.h"

#include "app/base/nearest.h"
#include "app/base/own_model.h"
#include "app/base/reader.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

// "KEY, KEY = 0.3" into the matrix.
static void read_correlation(SbStudyReader *reader, const SbEntry *entry, double *matrix) {
  SbStudyFile *study = reader->study;
  g_auto(GStrv) keys = g_strsplit(entry->name, ",", -1);
  int at[2] = {-1, -1};
  for (int i = 0; g_strv_length(keys) == 2 && i < 2; i++) {
    at[i] = sb_study_vary_index(study, g_strstrip(keys[i]));
  }
  double share = 0;
  if (at[0] < 0 || at[1] < 0 || at[0] == at[1]) {
    sb_study_add_issue(reader, entry, "KEY, KEY = NUMBER",
                       "does not name two parameters of [vary]");
  } else if (!sb_number_parse(&share, entry->value) || !(fabs(share) < 1)) {
    sb_study_add_issue(reader, entry, "between -1 and 1", "is not a correlation");
  } else {
    const size_t n = study->vary->len;
    matrix[(size_t)at[0] * n + (size_t)at[1]] = matrix[(size_t)at[1] * n + (size_t)at[0]] = share;
  }
}

// Cholesky's lower root in place; false if the matrix has none.
static bool take_root(double *a, size_t n) {
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j <= i; j++) {
      double sum = a[i * n + j];
      for (size_t k = 0; k < j; k++) {
        sum -= a[i * n + k] * a[j * n + k];
      }
      if (i == j && !(sum > 1e-12)) {
        return false;
      }
      a[i * n + j] = i == j ? sqrt(sum) : sum / a[j * n + j];
    }
  }
  return true;
}

static void read_correlations(SbStudyReader *reader) {
  SbStudyFile *study = reader->study;
  const size_t n = study->vary->len;
  double *matrix = NULL;
  int line = 0;
  for (guint i = 0; i < reader->entries->len; i++) {
    const SbEntry *entry = reader->entries->pdata[i];
    if (entry->name == NULL || strcmp(entry->group, GROUP_CORRELATION) != 0) {
      continue;
    }
    if (matrix == NULL) {
      matrix = g_new0(double, n *n + 1);
      for (size_t k = 0; k < n; k++) {
        matrix[k * n + k] = 1;
      }
    }
    line = line > 0 ? line : entry->line;
    read_correlation(reader, entry, matrix);
  }
  if (matrix != NULL && !take_root(matrix, n)) {
    sb_issues_add(reader->issues, reader->shown, line, GROUP_CORRELATION, NULL,
                  "no parameters are correlated like this: the matrix is not positive definite");
  } else if (matrix != NULL &&
             (study->method == SB_METHOD_GRID || study->method == SB_METHOD_MORRIS ||
              study->method == SB_METHOD_SOBOL_INDICES)) {
    sb_issues_add(reader->issues, reader->shown, line, GROUP_CORRELATION, NULL,
                  "the method %s requires independent parameters",
                  sb_study_method_name(study->method));
  }
  study->root = matrix;
}

// ---- [study] ----

void sb_study_take_figure(GArray *figures, int figure) {
  for (guint i = 0; i < figures->len; i++) {
    if (g_array_index(figures, int, i) == figure) {
      return;
    }
  }
  g_array_append_val(figures, figure);
}

// Index of a figure, -1 with an issue.
int sb_study_read_figure(const SbStudyReader *reader, const SbEntry *entry, const char *path) {
  const int figure = sb_figure_find(path);
  if (figure < 0) {
    SbNearest nearest = sb_nearest(path);
    for (int i = 0; i < SB_FIGURE_COUNT; i++) {
      sb_nearest_try(&nearest, sb_figure(i)->path);
    }
    g_autofree char *hint = sb_nearest_hint(&nearest);
    g_autofree char *text = g_strdup_printf("there is no figure \"%s\"%s", path, hint);
    sb_study_add_issue(reader, entry, NULL, text);
  }
  return figure;
}

static void read_figures(SbStudyReader *reader, const SbEntry *entry) {
  g_auto(GStrv) paths = g_strsplit_set(entry->value, ",;", -1);
  for (char **path = paths; *path != NULL; path++) {
    const int figure = *g_strstrip(*path) != '\0' ? sb_study_read_figure(reader, entry, *path) : -1;
    if (figure >= 0) {
      sb_study_take_figure(reader->study->figures, figure);
    }
  }
}

bool sb_study_read_count(double *out, const char *text, double least, double most) {
  double value = 0;
  if (!sb_number_parse(&value, text) || value != floor(value) || value < least || value > most) {
    return false;
  }
  *out = value;
  return true;
}

static void read_study(SbStudyReader *reader, const SbEntry *entry, bool *has_samples) {
  SbStudyFile *study = reader->study;
  double count = 0;
  if (strcmp(entry->name, "method") == 0) {
    int method = 0;
    while (method < SB_METHOD_COUNT &&
           strcmp(sb_study_method_name((SbStudyMethod)method), entry->value) != 0) {
      method++;
    }
    if (method == SB_METHOD_COUNT) {
      g_autofree char *list = g_strdup(sb_study_method_name(0));
      for (int i = 1; i < SB_METHOD_COUNT; i++) {
        char *longer = g_strdup_printf("%s, %s", list, sb_study_method_name((SbStudyMethod)i));
        g_free(list);
        list = longer;
      }
      sb_study_add_issue(reader, entry, list, "there is no such method");
    } else {
      study->method = (SbStudyMethod)method;
    }
  } else if (strcmp(entry->name, "samples") == 0) {
    *has_samples = true;
    if (sb_study_read_count(&count, entry->value, 1, SB_SAMPLES_MAX)) {
      study->samples = (size_t)count;
    } else {
      sb_study_add_issue(reader, entry, "1 to 10000000", "is not a number of samples");
    }
  } else if (strcmp(entry->name, "seed") == 0) {
    if (sb_study_read_count(&count, entry->value, 0, 9007199254740992.0)) {
      study->seed = (guint64)count;
    } else {
      sb_study_add_issue(reader, entry, "0 to 2^53", "is not a seed");
    }
  } else if (strcmp(entry->name, "figures") == 0) {
    read_figures(reader, entry);
  } else if (strcmp(entry->name, "hold") != 0) { // read before
    sb_study_add_issue(reader, entry, "method, samples, seed, figures, hold", "unknown key");
  }
}

// How many samples the method makes of those that were asked for, 0 with an issue.
static void settle_samples(SbStudyReader *reader, bool has_samples) {
  SbStudyFile *study = reader->study;
  const size_t n = study->vary->len;
  size_t block = 1;
  if (study->method == SB_METHOD_GRID) {
    size_t points = study->lines != NULL ? sb_study_grid_points(study) : 1;
    for (guint i = 0; i < n && study->lines == NULL; i++) {
      const SbVary *vary = &g_array_index(study->vary, SbVary, i);
      if (vary->distribution.count == 0) {
        g_autofree char *key = g_strconcat(GROUP_VARY ".", sb_param(vary->id)->key, NULL);
        sb_issues_add(reader->issues, reader->shown, 0, key, sb_study_vary_forms,
                      "a grid needs levels, or a range with a number of points");
        return;
      }
      if (vary->distribution.count > SB_SAMPLES_MAX / points) {
        sb_issues_add(reader->issues, reader->shown, 0, GROUP_VARY, NULL,
                      "the grid has more than %d points", SB_SAMPLES_MAX);
        return;
      }
      points *= vary->distribution.count;
    }
    if (has_samples && study->samples != points) {
      sb_issues_add(reader->issues, reader->shown, 0, "study.samples", NULL,
                    "the grid has %zu points, not %zu: leave it out", points, study->samples);
    }
    study->samples = points;
    return;
  }
  if (study->method == SB_METHOD_MORRIS) {
    block = n + 1;
  } else if (study->method == SB_METHOD_SOBOL_INDICES) {
    block = n + 2;
  }
  if (!has_samples && (study->design.asked || study->data->len > 0)) {
    study->samples = 0;
  } else if (!has_samples) {
    sb_issues_add(reader->issues, reader->shown, 0, "study.samples", "1 to 10000000",
                  "is missing: how many samples there are");
  } else if (study->samples < 2 * block && block > 1) {
    sb_issues_add(reader->issues, reader->shown, 0, "study.samples", NULL,
                  "%s of %zu parameters requires at least %zu samples, in full blocks of %zu",
                  sb_study_method_name(study->method), n, 2 * block, block);
  } else if (study->method == SB_METHOD_SOBOL_SEQUENCE && n > SB_SOBOL_DIMENSIONS) {
    sb_issues_add(reader->issues, reader->shown, 0, GROUP_VARY, NULL,
                  "a Sobol sequence has at most %d parameters", SB_SOBOL_DIMENSIONS);
  }
  study->samples -= study->samples % block;
}

// Failures are looked for along the slopes of figures with limits.
static void check_reliability(SbStudyReader *reader) {
  const SbStudyFile *study = reader->study;
  for (guint i = 0; i < study->vary->len; i++) {
    const SbVary *vary = &g_array_index(study->vary, SbVary, i);
    if (vary->distribution.kind == SB_DISTRIBUTION_LEVELS && vary->distribution.count > 1) {
      g_autofree char *key = g_strconcat(GROUP_VARY ".", sb_param(vary->id)->key, NULL);
      sb_issues_add(reader->issues, reader->shown, 0, key, "uniform, loguniform, normal, one level",
                    "the method reliability accepts no levels: write a study for each");
    }
  }
  if (study->limits.count == 0) {
    sb_issues_add(reader->issues, reader->shown, 0, SB_LIMITS_GROUP, "FIGURE = >= A, <= B, A .. B",
                  "the method reliability needs limits, here or in the scene");
  }
}

// ---- The file ----

static bool read_groups_meta(SbStudyReader *reader, char **scene) {
  const GPtrArray *entries = reader->entries;
  const SbEntry *first = entries->len > 0 ? entries->pdata[0] : NULL;
  if (first == NULL || strcmp(first->group, SB_META_GROUP) != 0) {
    sb_issues_add(reader->issues, reader->shown, 0, NULL, NULL,
                  "is not a study: the first group must be [sealbench]");
    return false;
  }
  const char *format = NULL, *kind = NULL;
  for (guint i = 0; i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    if (entry->name == NULL || strcmp(entry->group, SB_META_GROUP) != 0) {
      continue;
    }
    if (strcmp(entry->name, "format") == 0) {
      format = entry->value;
    } else if (strcmp(entry->name, "kind") == 0) {
      kind = entry->value;
    } else if (strcmp(entry->name, "scene") == 0) {
      *scene = g_strdup(entry->value);
    } else if (strcmp(entry->name, "title") == 0) {
      g_free(reader->study->title);
      reader->study->title = sb_printable(entry->value, strlen(entry->value));
    } else {
      sb_study_add_issue(reader, entry, "format, kind, title, scene", "unknown key");
    }
  }
  if (format == NULL || strcmp(format, "1") != 0) {
    sb_issues_add(reader->issues, reader->shown, 0, "sealbench.format", "1", "%s",
                  format == NULL ? "is missing" : "is a format that this version cannot read");
  }
  if (kind == NULL || strcmp(kind, "study") != 0) {
    sb_issues_add(reader->issues, reader->shown, 0, "sealbench.kind", "study", "%s",
                  kind == NULL ? "is missing" : "is not a study");
    return false;
  }
  if (*scene == NULL || **scene == '\0') {
    sb_issues_add(reader->issues, reader->shown, 0, "sealbench.scene", NULL,
                  "is missing: a study names its scene's file");
    return false;
  }
  return true;
}

// What a study's answers are compared with, app/study/thesis_item.h.
static bool is_for_thesis(const char *group) {
  static const char *const names[] = {"printed", "chart", "notes", NULL};
  return g_strv_contains(names, group) || g_str_has_prefix(group, "rows ") ||
         g_str_has_prefix(group, "series ");
}

static void read_groups(SbStudyReader *reader) {
  SbStudyFile *study = reader->study;
  bool has_samples = false, known = true, varies = false;
  const char *bad = NULL;
  for (guint i = 0; i < reader->entries->len; i++) {
    const SbEntry *entry = reader->entries->pdata[i];
    const char *group = entry->group;
    if (entry->name == NULL) {
      static const char *const names[] = {SB_META_GROUP,     GROUP_VARY,      GROUP_STUDY,
                                          GROUP_CORRELATION, SB_LIMITS_GROUP, GROUP_DESIGN,
                                          GROUP_TOLERANCES,  GROUP_LEAKAGE,   NULL};
      if (strcmp(group, GROUP_LEAKAGE) == 0 && study->leakage_tests == 0) {
        study->leakage_tests = SB_LEAKAGE_TESTS;
        study->leakage = (SbLeakageTest)SB_LEAKAGE_TEST_INIT;
      }
      study->design.asked |= strcmp(group, GROUP_DESIGN) == 0;
      const bool grid = g_str_has_prefix(group, GROUP_VARY " ");
      known =
          g_strv_contains(names, group) || sb_data_is_group(group) || grid || is_for_thesis(group);
      reader->grid = grid ? ++study->grids : 0;
      if (!known && (bad == NULL || strcmp(bad, group) != 0)) {
        bad = group;
        sb_issues_add(reader->issues, reader->shown, entry->line, NULL,
                      "vary, correlation, study, limits, design, tolerances, leakage_test, data",
                      "unknown group [%s]", group);
      }
    } else if (strcmp(group, GROUP_VARY) == 0 || reader->grid > 0) {
      varies = true;
      sb_study_read_vary(reader, entry, study->vary, false);
    } else if (strcmp(group, GROUP_TOLERANCES) == 0) {
      sb_study_read_vary(reader, entry, study->design.tolerances, true);
    } else if (strcmp(group, GROUP_DESIGN) == 0) {
      sb_study_read_design(reader, entry);
    } else if (strcmp(group, GROUP_LEAKAGE) == 0) {
      sb_study_read_leakage(reader, entry);
    } else if (strcmp(group, GROUP_STUDY) == 0) {
      read_study(reader, entry, &has_samples);
    }
  }
  if (!varies) {
    sb_issues_add(reader->issues, reader->shown, 0, GROUP_VARY, sb_study_vary_forms,
                  "nothing varies");
  }
  sb_document_read_limits(&study->limits, reader->entries, reader->shown, reader->issues);
  sb_study_take_lines(reader);
  if (study->vary->len == 0) {
    return;
  }
  if (study->design.asked) {
    sb_study_check_design(reader);
  }
  if (study->leakage_tests > 0) {
    sb_study_check_leakage(reader);
  }
  settle_samples(reader, has_samples);
  if (study->method == SB_METHOD_RELIABILITY) {
    check_reliability(reader);
  }
  read_correlations(reader);
}

// Hash of the scene's values and of its rubber's figures, which other values of [vary] may bring
// into force. Owned by the caller.
static char *hash_scene(const SbDocument *scene) {
  g_autofree char *values = sb_document_sha256(scene);
  g_autoptr(GString) text = g_string_new(values);
  const SbRubberSheet *rubber = scene->data != NULL ? &scene->data->rubber : NULL;
  for (size_t i = 0; rubber != NULL && i < rubber->count; i++) {
    char digits[SB_NUMBER_SIZE];
    g_string_append_printf(text, "\n%s,%d,%s", sb_param(rubber->figure[i].id)->key,
                           rubber->figure[i].fluid,
                           sb_number_format(digits, rubber->figure[i].value));
  }
  return g_compute_checksum_for_string(G_CHECKSUM_SHA256, text->str, -1);
}

// The scene as a model, and what tells it from every other.
static void open_scene(SbStudyReader *reader, const char *name, char **settings,
                       const char *directory) {
  SbStudyFile *study = reader->study;
  if (study->scene == NULL) {
    g_autofree char *path = g_path_is_absolute(name) || directory == NULL
                                ? g_strdup(name)
                                : g_build_filename(directory, name, NULL);
    study->scene = sb_document_load(path, reader->issues);
  }
  if (study->scene == NULL) {
    return;
  }
  sb_document_set_options(study->scene, settings, reader->issues);
  if (reader->issues->len == 0 && sb_document_compile(study->scene, &study->base, reader->issues)) {
    study->base_sha256 = hash_scene(study->scene);
    study->limits = study->scene->limits;
  }
}

// What of the scene the study holds; see engine/valve/studies/hold.h.
static void hold_base(SbStudyReader *reader) {
  SbStudyFile *study = reader->study;
  for (guint i = 0; i < reader->entries->len && study->base != NULL; i++) {
    const SbEntry *entry = reader->entries->pdata[i];
    if (entry->name == NULL || strcmp(entry->group, GROUP_STUDY) != 0 ||
        strcmp(entry->name, "hold") != 0) {
      continue;
    }
    g_auto(GStrv) words = g_strsplit_set(entry->value, ",;", -1);
    for (char **word = words; *word != NULL; word++) {
      SbHold hold;
      SbModel *held = NULL;
      SbReport report = {0};
      if (!sb_hold_from_name(&hold, g_strstrip(*word))) {
        sb_study_add_issue(reader, entry, sb_hold_names(),
                           "no group of parameters can be fixed by this name");
      } else if (sb_model_hold(&held, study->base, hold, &report) != SB_OK) {
        sb_study_add_issue(reader, entry, NULL, report.text);
      } else {
        sb_model_destroy(study->base);
        study->base = held;
      }
    }
    if (study->base_sha256 != NULL) {
      g_autofree char *text = g_strconcat(study->base_sha256, "\n", entry->value, NULL);
      g_free(study->base_sha256);
      study->base_sha256 = g_compute_checksum_for_string(G_CHECKSUM_SHA256, text, -1);
    }
  }
}

// `scene` or `model`, where it is not NULL, in place of the scene that the text names.
static SbStudyFile *parse(const char *text, size_t length, const char *name, const char *directory,
                          char **settings, SbDocument *scene, const SbModel *model,
                          GPtrArray *issues) {
  const guint before = issues->len;
  g_autoptr(GPtrArray) entries = sb_reader_scan(text, length, name, issues);
  g_autoptr(SbStudyFile) study = g_new0(SbStudyFile, 1);
  g_autofree char *scene_name = NULL;
  study->title = g_path_get_basename(name);
  study->scene = scene;
  study->vary = g_array_new(FALSE, FALSE, sizeof(SbVary));
  study->figures = g_array_new(FALSE, FALSE, sizeof(int));
  study->method = SB_METHOD_MONTE_CARLO;
  study->seed = 1;
  study->design = (SbDesignWish){.figure = SB_FIGURE_NONE, .robust = NAN, .starts = 8};
  study->design.tolerances = g_array_new(FALSE, FALSE, sizeof(SbVary));
  SbStudyReader reader = {.study = study, .entries = entries, .shown = name, .issues = issues};
  if (read_groups_meta(&reader, &scene_name)) {
    if (model == NULL) {
      open_scene(&reader, scene_name, settings, directory);
    } else {
      study->base = sb_own_model(model);
    }
    hold_base(&reader);
    study->data = sb_data_read(entries, directory, name, issues);
    sb_data_split(study->data, issues);
    read_groups(&reader);
  }
  if (issues->len > before) {
    return NULL;
  }
  // Probabilities of limits need no other figure.
  const bool all =
      study->figures->len == 0 && study->method != SB_METHOD_RELIABILITY && !study->design.asked;
  for (int i = 0; all && i < SB_FIGURE_COUNT; i++) {
    g_array_append_val(study->figures, i);
  }
  if (study->design.asked) {
    sb_study_take_figure(study->figures, study->design.figure);
  }
  for (size_t i = 0; i < study->limits.count; i++) {
    sb_study_take_figure(study->figures, study->limits.item[i].figure);
  }
  return g_steal_pointer(&study);
}

SbStudyFile *sb_study_file_parse(const char *text, size_t length, const char *name,
                                 const char *directory, char **settings, SbDocument *scene,
                                 GPtrArray *issues) {
  return parse(text, length, name, directory, settings, scene, NULL, issues);
}

SbStudyFile *sb_study_file_of_model(const char *path, const SbModel *scene, GPtrArray *issues) {
  size_t length = 0;
  g_autofree char *text = sb_reader_load(&length, path, path, SB_DOCUMENT_BYTES_MAX, issues);
  return text != NULL ? parse(text, length, path, NULL, NULL, NULL, scene, issues) : NULL;
}
