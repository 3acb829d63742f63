// Reads study files and lays out their points; see the header.
#include "app/document/study_file_private.h"

#include "app/base/nearest.h"
#include "app/base/reader.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

static const char *const methods[SB_METHOD_COUNT] = {
#define METHOD_NAME(code, name) [code] = name,
    SB_STUDY_METHODS(METHOD_NAME)
#undef METHOD_NAME
};

const char *sb_study_method_name(SbStudyMethod method) {
  return (unsigned)method < SB_METHOD_COUNT ? methods[method] : "";
}

static const char vary_forms[] = "uniform A .. B[, N], loguniform A .. B[, N], normal MEAN, "
                                 "DEVIATION [within A .. B], levels A, B, ...";

static const char tolerance_forms[] = "uniform A .. B, normal MEAN, DEVIATION [within A .. B]";

static char *full_key(const SbEntry *entry) {
  return g_strdup_printf("%s.%s", entry->group, entry->name);
}

void sb_study_complain(const SbStudyReader *reader, const SbEntry *entry, const char *allowed,
                       const char *text) {
  g_autofree char *key = full_key(entry);
  sb_issues_add(reader->issues, reader->shown, entry->line, key, allowed, "%s", text);
}

// The code of an error in a line's form, which the forms answer; of a value its range does. It
// stays in this file.
enum { BAD_FORM = 100 };

static bool fail(GError **error, const char *format, ...) G_GNUC_PRINTF(2, 3);
static bool fail(GError **error, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  if (error != NULL) {
    *error = g_error_new_valist(SB_APP_ERROR, BAD_FORM, format, arguments);
  }
  va_end(arguments);
  return false;
}

// ---- [vary] ----

// A difference of two values of a parameter.
static bool read_difference(double *out, const SbParam *param, const char *text, GError **error) {
  g_autofree char *trimmed = g_strstrip(g_strdup(text));
  const char *shown = sb_quantity_is_point(param->unit) ? "K" : param->unit;
  return sb_quantity_parse(out, trimmed, param->si, shown, error);
}

// A value of the parameter, within its range, or of a tolerance.
static bool read_value(double *out, const SbVary *vary, const char *text, GError **error) {
  if (vary->offset) {
    return read_difference(out, sb_param(vary->id), text, error);
  }
  g_autofree char *trimmed = g_strstrip(g_strdup(text));
  return sb_param_parse(out, vary->id, trimmed, error);
}

// "A .. B".
static bool read_range(double *low, double *high, const SbVary *vary, const char *text,
                       GError **error) {
  const char *dots = strstr(text, "..");
  if (dots == NULL) {
    return fail(error, "\"%.60s\" is no range", text);
  }
  g_autofree char *first = g_strndup(text, (gsize)(dots - text));
  if (!read_value(low, vary, first, error) || !read_value(high, vary, dots + 2, error)) {
    return false;
  }
  return *low < *high || fail(error, "the range \"%.60s\" does not rise", text);
}

// "A .. B" or "A .. B, N".
static bool read_uniform(SbVary *vary, const char *text, GError **error) {
  SbDistribution *of = &vary->distribution;
  const char *comma = strchr(text, ',');
  if (comma != NULL) {
    double count = 0;
    g_autofree char *digits = g_strstrip(g_strdup(comma + 1));
    if (!sb_number_parse(&count, digits) || count != floor(count) || count < 2 ||
        count > SB_SAMPLES_MAX) {
      return fail(error, "\"%.60s\" is no number of points (2 and more)", digits);
    }
    of->count = (size_t)count;
  }
  g_autofree char *range = g_strndup(text, comma != NULL ? (gsize)(comma - text) : strlen(text));
  if (!read_range(&of->a, &of->b, vary, range, error)) {
    return false;
  }
  return of->kind != SB_DISTRIBUTION_LOGUNIFORM || of->a > 0 ||
         fail(error, "a logarithm needs values above 0");
}

// "MEAN, DEVIATION" or "MEAN, DEVIATION within A .. B".
static bool read_normal(SbVary *vary, const char *text, GError **error) {
  SbDistribution *of = &vary->distribution;
  const char *comma = strchr(text, ','), *within = strstr(text, " within ");
  if (comma == NULL || (within != NULL && within < comma)) {
    return fail(error, "\"%.60s\" is no mean with a deviation", text);
  }
  g_autofree char *mean = g_strndup(text, (gsize)(comma - text));
  g_autofree char *deviation = g_strstrip(
      g_strndup(comma + 1, within != NULL ? (gsize)(within - comma - 1) : strlen(comma + 1)));
  if (!read_value(&of->a, vary, mean, error) ||
      !read_difference(&of->b, sb_param(vary->id), deviation, error)) {
    return false;
  }
  if (!(of->b > 0)) {
    return fail(error, "the deviation \"%.60s\" is not above 0", deviation);
  }
  of->low = -INFINITY;
  of->high = INFINITY;
  if (within != NULL) {
    if (!read_range(&of->low, &of->high, vary, within + strlen(" within "), error)) {
      return false;
    }
    // Six deviations out there is one value in 1e9.
    if (of->low > of->a + 6 * of->b || of->high < of->a - 6 * of->b) {
      return fail(error, "the range lies more than 6 deviations from the mean");
    }
  }
  return true;
}

static bool read_levels(SbVary *vary, const char *text, GError **error) {
  g_auto(GStrv) parts = g_strsplit(text, ",", -1);
  const size_t count = g_strv_length(parts);
  if (count > SB_SAMPLES_MAX / 10) {
    return fail(error, "there are too many levels");
  }
  vary->levels = g_new(double, count + 1);
  for (size_t i = 0; i < count; i++) {
    if (!read_value(&vary->levels[i], vary, parts[i], error)) {
      return false;
    }
  }
  vary->distribution.level = vary->levels;
  vary->distribution.count = count;
  return count > 0 || fail(error, "there are no levels");
}

static bool read_distribution(SbVary *vary, const char *text, GError **error) {
  static const struct {
    const char *name;
    SbDistributionKind kind;
    bool (*read)(SbVary *vary, const char *text, GError **error);
  } forms[] = {{"uniform", SB_DISTRIBUTION_UNIFORM, read_uniform},
               {"loguniform", SB_DISTRIBUTION_LOGUNIFORM, read_uniform},
               {"normal", SB_DISTRIBUTION_NORMAL, read_normal},
               {"levels", SB_DISTRIBUTION_LEVELS, read_levels}};
  const size_t length = strcspn(text, " \t");
  const SbParamKind kind = sb_param(vary->id)->kind;
  for (size_t i = 0; i < G_N_ELEMENTS(forms); i++) {
    if (strlen(forms[i].name) == length && strncmp(text, forms[i].name, length) == 0) {
      vary->distribution.kind = forms[i].kind;
      if (vary->offset && (kind != SB_PARAM_REAL || (forms[i].kind != SB_DISTRIBUTION_UNIFORM &&
                                                     forms[i].kind != SB_DISTRIBUTION_NORMAL))) {
        return fail(error, "\"%.60s\" is no tolerance", text);
      }
      if ((kind == SB_PARAM_CHOICE || kind == SB_PARAM_INT) &&
          forms[i].kind != SB_DISTRIBUTION_LEVELS) {
        return fail(error, "only levels suit %s",
                    kind == SB_PARAM_INT ? "a whole number" : "a choice");
      }
      return forms[i].read(vary, text + length, error);
    }
  }
  return fail(error, "\"%.60s\" says no distribution", text);
}

static void read_vary(SbStudyReader *reader, const SbEntry *entry, GArray *list, bool offset) {
  const int id = sb_param_find(entry->name);
  SbVary vary = {.id = (SbParamId)id, .offset = offset};
  g_autoptr(GError) error = NULL;
  if (id < 0) {
    g_autofree char *hint = sb_document_key_hint(entry->name);
    g_autofree char *text = g_strdup_printf("there is no such parameter%s", hint);
    sb_study_complain(reader, entry, NULL, text);
  } else if (sb_param(vary.id)->kind == SB_PARAM_FLAGS) {
    sb_study_complain(reader, entry, NULL, "a list of words does not vary");
  } else if (list->len == SB_VARY_MAX) {
    sb_study_complain(reader, entry, NULL, "is more than the 64 parameters that may vary");
  } else if (!read_distribution(&vary, entry->value, &error)) {
    g_autofree char *range = sb_param_range(vary.id);
    sb_study_complain(reader, entry,
                      error->code == BAD_FORM ? (offset ? tolerance_forms : vary_forms)
                      : offset                ? NULL
                                              : range,
                      error->message);
    g_free(vary.levels);
  } else {
    g_array_append_val(list, vary);
  }
}

// ---- [correlation] ----

int sb_study_vary_index(const SbStudyFile *study, const char *key) {
  for (guint i = 0; i < study->vary->len; i++) {
    if (strcmp(sb_param(g_array_index(study->vary, SbVary, i).id)->key, key) == 0) {
      return (int)i;
    }
  }
  return -1;
}

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
    sb_study_complain(reader, entry, "KEY, KEY = NUMBER", "does not name two parameters of [vary]");
  } else if (!sb_number_parse(&share, entry->value) || !(fabs(share) < 1)) {
    sb_study_complain(reader, entry, "between -1 and 1", "is no correlation");
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
                  "the method %s takes its parameters as independent", methods[study->method]);
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
    g_autofree char *text = g_strdup_printf("there is no figure \"%.60s\"%s", path, hint);
    sb_study_complain(reader, entry, NULL, text);
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
    while (method < SB_METHOD_COUNT && strcmp(methods[method], entry->value) != 0) {
      method++;
    }
    if (method == SB_METHOD_COUNT) {
      g_autofree char *list = g_strdup(methods[0]);
      for (int i = 1; i < SB_METHOD_COUNT; i++) {
        char *longer = g_strdup_printf("%s, %s", list, methods[i]);
        g_free(list);
        list = longer;
      }
      sb_study_complain(reader, entry, list, "there is no such method");
    } else {
      study->method = (SbStudyMethod)method;
    }
  } else if (strcmp(entry->name, "samples") == 0) {
    *has_samples = true;
    if (sb_study_read_count(&count, entry->value, 1, SB_SAMPLES_MAX)) {
      study->samples = (size_t)count;
    } else {
      sb_study_complain(reader, entry, "1 to 10000000", "is no number of samples");
    }
  } else if (strcmp(entry->name, "seed") == 0) {
    if (sb_study_read_count(&count, entry->value, 0, 9007199254740992.0)) {
      study->seed = (guint64)count;
    } else {
      sb_study_complain(reader, entry, "0 to 2^53", "is no seed");
    }
  } else if (strcmp(entry->name, "figures") == 0) {
    read_figures(reader, entry);
  } else {
    sb_study_complain(reader, entry, "method, samples, seed, figures", "unknown key");
  }
}

// How many samples the method makes of those that were asked for, 0 with an issue.
static void settle_samples(SbStudyReader *reader, bool has_samples) {
  SbStudyFile *study = reader->study;
  const size_t n = study->vary->len;
  size_t block = 1;
  if (study->method == SB_METHOD_GRID) {
    size_t points = 1;
    for (guint i = 0; i < n; i++) {
      const SbVary *vary = &g_array_index(study->vary, SbVary, i);
      if (vary->distribution.count == 0) {
        g_autofree char *key = g_strconcat(GROUP_VARY ".", sb_param(vary->id)->key, NULL);
        sb_issues_add(reader->issues, reader->shown, 0, key, vary_forms,
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
  if (!has_samples && study->design.asked) {
    study->samples = 0;
  } else if (!has_samples) {
    sb_issues_add(reader->issues, reader->shown, 0, "study.samples", "1 to 10000000",
                  "is missing: how many samples there are");
  } else if (study->samples < 2 * block && block > 1) {
    sb_issues_add(reader->issues, reader->shown, 0, "study.samples", NULL,
                  "%s of %zu parameters takes %zu at least, whole blocks of %zu",
                  methods[study->method], n, 2 * block, block);
  } else if (study->method == SB_METHOD_SOBOL_SEQUENCE && n > SB_SOBOL_DIMENSIONS) {
    sb_issues_add(reader->issues, reader->shown, 0, GROUP_VARY, NULL,
                  "a Sobol sequence takes at most %d parameters", SB_SOBOL_DIMENSIONS);
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
                    "the method reliability takes no levels: a study of each");
    }
  }
  if (study->limits.count == 0) {
    sb_issues_add(reader->issues, reader->shown, 0, SB_LIMITS_GROUP, "FIGURE = >= A, <= B, A .. B",
                  "the method reliability needs limits, here or in the scene");
  }
}

// ---- The file ----

static bool read_meta(SbStudyReader *reader, char **scene) {
  const GPtrArray *entries = reader->entries;
  const SbEntry *first = entries->len > 0 ? entries->pdata[0] : NULL;
  if (first == NULL || strcmp(first->group, SB_META_GROUP) != 0) {
    sb_issues_add(reader->issues, reader->shown, 0, NULL, NULL,
                  "is no study: the first group must be [sealbench]");
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
      sb_study_complain(reader, entry, "format, kind, title, scene", "unknown key");
    }
  }
  if (format == NULL || strcmp(format, "1") != 0) {
    sb_issues_add(reader->issues, reader->shown, 0, "sealbench.format", "1", "%s",
                  format == NULL ? "is missing" : "is a format that this version cannot read");
  }
  if (kind == NULL || strcmp(kind, "study") != 0) {
    sb_issues_add(reader->issues, reader->shown, 0, "sealbench.kind", "study", "%s",
                  kind == NULL ? "is missing" : "is no study");
    return false;
  }
  if (*scene == NULL || **scene == '\0') {
    sb_issues_add(reader->issues, reader->shown, 0, "sealbench.scene", NULL,
                  "is missing: a study names its scene's file");
    return false;
  }
  return true;
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
                                          GROUP_TOLERANCES,  "data",          NULL};
      study->design.asked |= strcmp(group, GROUP_DESIGN) == 0;
      known = g_strv_contains(names, group) || g_str_has_prefix(group, "data ");
      if (!known && (bad == NULL || strcmp(bad, group) != 0)) {
        bad = group;
        sb_issues_add(reader->issues, reader->shown, entry->line, NULL,
                      "vary, correlation, study, limits, design, tolerances, data",
                      "unknown group [%.60s]", group);
      }
    } else if (strcmp(group, GROUP_VARY) == 0) {
      varies = true;
      read_vary(reader, entry, study->vary, false);
    } else if (strcmp(group, GROUP_TOLERANCES) == 0) {
      read_vary(reader, entry, study->design.tolerances, true);
    } else if (strcmp(group, GROUP_DESIGN) == 0) {
      sb_study_read_design(reader, entry);
    } else if (strcmp(group, GROUP_STUDY) == 0) {
      read_study(reader, entry, &has_samples);
    }
  }
  if (!varies) {
    sb_issues_add(reader->issues, reader->shown, 0, GROUP_VARY, vary_forms, "nothing varies");
  }
  sb_document_read_limits(&study->limits, reader->entries, reader->shown, reader->issues);
  if (study->vary->len == 0) {
    return;
  }
  if (study->design.asked) {
    sb_study_check_design(reader);
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
  GString *text = g_string_new(values);
  const SbRubberSheet *rubber = scene->data != NULL ? &scene->data->rubber : NULL;
  for (size_t i = 0; rubber != NULL && i < rubber->count; i++) {
    char digits[SB_NUMBER_SIZE];
    g_string_append_printf(text, "\n%s,%d,%s", sb_param(rubber->figure[i].id)->key,
                           rubber->figure[i].fluid,
                           sb_number_format(digits, rubber->figure[i].value));
  }
  char *hash = g_compute_checksum_for_string(G_CHECKSUM_SHA256, text->str, -1);
  g_string_free(text, TRUE);
  return hash;
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
  for (char **setting = settings; setting != NULL && *setting != NULL; setting++) {
    (void)sb_document_set_option(study->scene, *setting, reader->issues);
  }
  if (reader->issues->len == 0 && sb_document_compile(study->scene, &study->base, reader->issues)) {
    study->base_sha256 = hash_scene(study->scene);
    study->limits = study->scene->limits;
  }
}

SbStudyFile *sb_study_file_parse(const char *text, size_t length, const char *name,
                                 const char *directory, char **settings, SbDocument *scene,
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
  SbStudyReader reader = {study, entries, name, issues};
  if (read_meta(&reader, &scene_name)) {
    open_scene(&reader, scene_name, settings, directory);
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
  for (size_t i = 0; i < study->limits.count; i++) {
    sb_study_take_figure(study->figures, study->limits.item[i].figure);
  }
  return g_steal_pointer(&study);
}

SbStudyFile *sb_study_file_load(const char *path, char **settings, GPtrArray *issues) {
  const bool stream = strcmp(path, "-") == 0;
  const char *shown = stream ? "standard input" : path;
  size_t length = 0;
  g_autofree char *text =
      stream ? sb_reader_load_stream(&length, STDIN_FILENO, shown, SB_DOCUMENT_BYTES_MAX, issues)
             : sb_reader_load(&length, path, shown, SB_DOCUMENT_BYTES_MAX, issues);
  if (text == NULL) {
    return NULL;
  }
  g_autofree char *directory = stream ? NULL : g_path_get_dirname(path);
  SbStudyFile *study = sb_study_file_parse(text, length, shown, directory, settings, NULL, issues);
  if (study != NULL && !stream) {
    study->path = g_strdup(path);
  }
  return study;
}

void sb_study_file_free(SbStudyFile *study) {
  if (study == NULL) {
    return;
  }
  for (guint i = 0; i < study->vary->len; i++) {
    g_free(g_array_index(study->vary, SbVary, i).levels);
  }
  g_array_unref(study->vary);
  g_array_unref(study->figures);
  if (study->design.tolerances != NULL) {
    g_array_unref(study->design.tolerances);
  }
  if (study->borrowed) {
    g_free(study);
    return;
  }
  sb_document_free(study->scene);
  sb_model_destroy(study->base);
  g_free(study->base_sha256);
  g_free(study->root);
  g_free(study->path);
  g_free(study->title);
  g_free(study);
}
