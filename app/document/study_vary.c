// Lines of [vary] and [tolerances]: a parameter or a variable, and how it varies.
#include "app/base/hardness.h"
#include "app/document/expression.h"
#include "app/document/study_file_private.h"

#include <math.h>
#include <string.h>

const char sb_study_vary_forms[] = "uniform A .. B[, N], loguniform A .. B[, N], normal MEAN, "
                                   "DEVIATION [within A .. B], levels A, B, ..., by EXPRESSION";

static const char tolerance_forms[] = "uniform A .. B, normal MEAN, DEVIATION [within A .. B]";

// The code of an error in a line's form, which the forms answer; of a value its range does. It
// stays in this file.
enum { BAD_FORM = 100 };

static bool fail_vary(GError **error, const char *format, ...) G_GNUC_PRINTF(2, 3);
static bool fail_vary(GError **error, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  if (error != NULL) {
    *error = g_error_new_valist(SB_APP_ERROR, BAD_FORM, format, arguments);
  }
  va_end(arguments);
  return false;
}

// A difference of two values of a parameter, one of which is `at` (NaN: not known).
static bool read_difference(double *out, const SbVary *vary, double at, const char *text,
                            GError **error) {
  const SbParam *param = sb_param(vary->id);
  GError *hardness = NULL;
  if (sb_hardness_applies(vary->id) && sb_hardness_difference(out, at, text, &hardness)) {
    return true;
  }
  if (hardness != NULL) {
    g_propagate_error(error, hardness);
    return false;
  }
  g_autofree char *trimmed = g_strstrip(g_strdup(text));
  const char *shown = sb_quantity_is_point(param->unit) ? "K" : param->unit;
  return sb_quantity_parse(out, trimmed, param->si, shown, error);
}

// A value of the parameter, within its range, or of a tolerance. Appends the text of a value that
// is not an expression to `values` (of char *), as do the functions that call this one.
static bool read_value(double *out, const SbVary *vary, GPtrArray *values, const char *text,
                       GError **error) {
  if (vary->offset) {
    return read_difference(out, vary, NAN, text, error);
  }
  g_autofree char *trimmed = g_strstrip(g_strdup(text));
  const bool variable = vary->id == SB_VARY_VARIABLE;
  if (variable ? sb_quantity_parse(out, trimmed, "1", "", error)
               : sb_param_parse(out, vary->id, trimmed, error)) {
    g_ptr_array_add(values, g_steal_pointer(&trimmed));
    return true;
  }
  const SbParam *param = variable ? NULL : sb_param(vary->id);
  if (vary->base == NULL ||
      !sb_expression_value(out, trimmed, sb_vary_si(vary), variable ? "" : param->unit,
                           sb_study_base_value, (void *)vary->base, NULL) ||
      (param != NULL && param->kind != SB_PARAM_CHOICE &&
       !(*out >= param->min && *out <= param->max))) {
    return false; // what is wrong with it as a value
  }
  g_clear_error(error);
  return true;
}

// "A .. B".
static bool read_range(double *low, double *high, const SbVary *vary, GPtrArray *values,
                       const char *text, GError **error) {
  text += strspn(text, " \t");
  const char *dots = strstr(text, "..");
  if (dots == NULL) {
    return fail_vary(error, "\"%s\" is not a range", text);
  }
  g_autofree char *first = g_strndup(text, (gsize)(dots - text));
  if (!read_value(low, vary, values, first, error) ||
      !read_value(high, vary, values, dots + 2, error)) {
    return false;
  }
  return *low < *high || fail_vary(error, "the range \"%s\" does not rise", text);
}

// "A .. B" or "A .. B, N".
static bool read_uniform(SbVary *vary, GPtrArray *values, const char *text, GError **error) {
  SbDistribution *of = &vary->distribution;
  const char *comma = strchr(text, ',');
  if (comma != NULL) {
    double count = 0;
    g_autofree char *digits = g_strstrip(g_strdup(comma + 1));
    if (!sb_number_parse(&count, digits) || count != floor(count) || count < 2 ||
        count > SB_SAMPLES_MAX) {
      return fail_vary(error, "\"%s\" is not a number of points (2 and more)", digits);
    }
    of->count = (size_t)count;
  }
  g_autofree char *range = g_strndup(text, comma != NULL ? (gsize)(comma - text) : strlen(text));
  if (!read_range(&of->a, &of->b, vary, values, range, error)) {
    return false;
  }
  return of->kind != SB_DISTRIBUTION_LOGUNIFORM || of->a > 0 ||
         fail_vary(error, "a logarithm needs values above 0");
}

// "MEAN, DEVIATION" or "MEAN, DEVIATION within A .. B".
static bool read_normal(SbVary *vary, GPtrArray *values, const char *text, GError **error) {
  SbDistribution *of = &vary->distribution;
  const char *comma = strchr(text, ','), *within = strstr(text, " within ");
  if (comma == NULL || (within != NULL && within < comma)) {
    return fail_vary(error, "\"%s\" is not a mean with a deviation", text);
  }
  g_autofree char *mean = g_strndup(text, (gsize)(comma - text));
  g_autofree char *deviation = g_strstrip(
      g_strndup(comma + 1, within != NULL ? (gsize)(within - comma - 1) : strlen(comma + 1)));
  if (!read_value(&of->a, vary, values, mean, error) ||
      !(vary->id == SB_VARY_VARIABLE
            ? read_value(&of->b, vary, values, deviation, error)
            : read_difference(&of->b, vary, vary->offset ? NAN : of->a, deviation, error))) {
    return false;
  }
  if (!(of->b > 0)) {
    return fail_vary(error, "the deviation \"%s\" is not above 0", deviation);
  }
  of->low = -INFINITY;
  of->high = INFINITY;
  if (within != NULL) {
    if (!read_range(&of->low, &of->high, vary, values, within + strlen(" within "), error)) {
      return false;
    }
    // Six deviations out there is one value in 1e9.
    if (of->low > of->a + 6 * of->b || of->high < of->a - 6 * of->b) {
      return fail_vary(error, "the range is more than 6 deviations from the mean");
    }
  }
  return true;
}

// Levels behind the `before` that are there.
static bool add_levels(SbVary *vary, GPtrArray *values, size_t before, const char *text,
                       GError **error) {
  g_auto(GStrv) parts = g_strsplit(text, ",", -1);
  const size_t count = before + g_strv_length(parts);
  if (count > SB_SAMPLES_MAX / 10) {
    return fail_vary(error, "there are too many levels");
  }
  vary->levels = g_renew(double, vary->levels, count + 1);
  for (size_t i = before; i < count; i++) {
    if (!read_value(&vary->levels[i], vary, values, parts[i - before], error)) {
      return false;
    }
  }
  vary->distribution.kind = SB_DISTRIBUTION_LEVELS;
  vary->distribution.level = vary->levels;
  vary->distribution.count = count;
  return count > 0 || fail_vary(error, "there are no levels");
}

static bool read_levels(SbVary *vary, GPtrArray *values, const char *text, GError **error) {
  return add_levels(vary, values, 0, text, error);
}

// "uniform A .. B, N and C, D": the points of the range as levels, then others.
static bool read_and(SbVary *vary, GPtrArray *values, const char *text, const char *others,
                     bool (*read)(SbVary *vary, GPtrArray *values, const char *text,
                                  GError **error),
                     GError **error) {
  const SbDistribution *of = &vary->distribution;
  g_autofree char *range = g_strndup(text, (gsize)(others - text));
  if (!read(vary, values, range, error)) {
    return false;
  }
  const size_t count = of->count;
  if (count < 2 || count > SB_SAMPLES_MAX / 10) {
    return fail_vary(error, "\"%s\" has no number of points to add levels to", range);
  }
  vary->levels = g_new(double, count + 1);
  for (size_t i = 0; i < count; i++) {
    vary->levels[i] = sb_study_grid_level(of, i);
  }
  return add_levels(vary, values, count, others + strlen(" and "), error);
}

static bool read_distribution(SbVary *vary, GPtrArray *values, const char *text, GError **error) {
  static const struct {
    const char *name;
    SbDistributionKind kind;
    bool (*read)(SbVary *vary, GPtrArray *values, const char *text, GError **error);
  } forms[] = {{"uniform", SB_DISTRIBUTION_UNIFORM, read_uniform},
               {"loguniform", SB_DISTRIBUTION_LOGUNIFORM, read_uniform},
               {"normal", SB_DISTRIBUTION_NORMAL, read_normal},
               {"levels", SB_DISTRIBUTION_LEVELS, read_levels}};
  const size_t length = strcspn(text, " \t");
  const SbParamKind kind = vary->id == SB_VARY_VARIABLE ? SB_PARAM_REAL : sb_param(vary->id)->kind;
  const char *and = strstr(text, " and ");
  if (length == 2 && strncmp(text, "by", 2) == 0 && !vary->offset) {
    vary->by = g_strdup(text + length);
    return true;
  }
  for (size_t i = 0; i < G_N_ELEMENTS(forms); i++) {
    if (strlen(forms[i].name) == length && strncmp(text, forms[i].name, length) == 0) {
      vary->distribution.kind = forms[i].kind;
      if (vary->offset && (kind != SB_PARAM_REAL || (forms[i].kind != SB_DISTRIBUTION_UNIFORM &&
                                                     forms[i].kind != SB_DISTRIBUTION_NORMAL))) {
        return fail_vary(error, "\"%s\" is not a tolerance", text);
      }
      if ((kind == SB_PARAM_CHOICE || kind == SB_PARAM_INT) &&
          forms[i].kind != SB_DISTRIBUTION_LEVELS) {
        return fail_vary(error, "only levels suit %s",
                         kind == SB_PARAM_INT ? "a whole number" : "a choice");
      }
      return and != NULL && (vary->distribution.kind == SB_DISTRIBUTION_UNIFORM ||
                             vary->distribution.kind == SB_DISTRIBUTION_LOGUNIFORM)
                 ? read_and(vary, values, text + length, and, forms[i].read, error)
                 : forms[i].read(vary, values, text + length, error);
    }
  }
  return fail_vary(error, "\"%s\" is not a distribution", text);
}

void sb_study_read_vary(SbStudyReader *reader, const SbEntry *entry, GArray *list, bool offset) {
  const int id = sb_param_find(entry->name);
  const bool variable = id < 0 && !offset && strchr(entry->name, '.') == NULL;
  SbVary vary = {.id = variable ? SB_VARY_VARIABLE : (SbParamId)id,
                 .offset = offset,
                 .base = reader->study->base,
                 .line = entry->line,
                 .grid = reader->grid};
  g_autoptr(GError) error = NULL;
  g_autoptr(GPtrArray) values = g_ptr_array_new_with_free_func(g_free);
  if (id < 0 && !variable) {
    g_autofree char *hint = sb_document_key_hint(entry->name);
    g_autofree char *text = g_strdup_printf("there is no such parameter%s", hint);
    sb_study_add_issue(reader, entry, NULL, text);
  } else if (!variable && sb_param(vary.id)->kind == SB_PARAM_FLAGS) {
    sb_study_add_issue(reader, entry, NULL, "a list of words does not vary");
  } else if (list->len == SB_VARY_MAX) {
    sb_study_add_issue(reader, entry, NULL, "is more than the 64 parameters that may vary");
  } else if (!read_distribution(&vary, values, entry->value, &error)) {
    g_autofree char *range = variable ? g_strdup("numbers") : sb_param_range(vary.id);
    sb_study_add_issue(reader, entry,
                       error->code == BAD_FORM ? (offset ? tolerance_forms : sb_study_vary_forms)
                       : offset                ? NULL
                                               : range,
                       error->message);
    g_free(vary.levels);
    g_free(vary.by);
  } else {
    vary.name = variable ? g_strdup(entry->name) : NULL;
    g_array_append_val(list, vary);
    g_autofree char *key = g_strdup_printf("%s.%s", entry->group, entry->name);
    for (guint i = 0; i < values->len && !variable; i++) {
      sb_hardness_note(reader->study->notes, reader->shown, entry->line, key, vary.id,
                       values->pdata[i]);
    }
  }
}
