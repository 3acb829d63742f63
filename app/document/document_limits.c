// A document's [limits]: FIGURE = >= A, <= B or A .. B, each value with its unit. A scene's take
// the place of its valve's, figure by figure.
#include "app/base/nearest.h"
#include "app/base/reader.h"
#include "app/document/document_private.h"

#include <math.h>
#include <string.h>

// ", do you mean ...?" for a mistyped figure. Owned by the caller.
static char *figure_hint(const char *path) {
  SbNearest nearest = sb_nearest(path);
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    sb_nearest_try(&nearest, sb_figure(i)->path);
  }
  return sb_nearest_hint(&nearest);
}

// One bound; false with an error that says which value is no good.
static bool parse_bound(double *out, const char *text, const SbFigure *figure, GError **error) {
  g_autofree char *trimmed = g_strstrip(g_strdup(text));
  return sb_quantity_parse(out, trimmed, figure->si, figure->shown, error);
}

static bool parse_limit(SbLimit *out, const char *text, const SbFigure *figure, GError **error) {
  const char *dots = strstr(text, "..");
  out->low = -INFINITY;
  out->high = INFINITY;
  if (g_str_has_prefix(text, ">=")) {
    return parse_bound(&out->low, text + 2, figure, error);
  }
  if (g_str_has_prefix(text, "<=")) {
    return parse_bound(&out->high, text + 2, figure, error);
  }
  if (dots == NULL) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "\"%s\" is not a limit", text);
    return false;
  }
  g_autofree char *first = g_strndup(text, (gsize)(dots - text));
  if (!parse_bound(&out->low, first, figure, error) ||
      !parse_bound(&out->high, dots + 2, figure, error)) {
    return false;
  }
  if (!(out->low < out->high)) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "the range \"%s\" does not rise", text);
    return false;
  }
  return true;
}

// Adds a limit, in place of an earlier one on its figure.
static bool keep(SbLimits *limits, const SbLimit *limit) {
  size_t at = 0;
  while (at < limits->count && limits->item[at].figure != limit->figure) {
    at++;
  }
  if (at == SB_LIMITS_MAX) {
    return false;
  }
  limits->item[at] = *limit;
  limits->count = MAX(limits->count, at + 1);
  return true;
}

void sb_document_read_limits(SbLimits *limits, const GPtrArray *entries, const char *shown,
                             GPtrArray *issues) {
  for (guint i = 0; i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    if (entry->name == NULL || strcmp(entry->group, SB_LIMITS_GROUP) != 0) {
      continue;
    }
    g_autofree char *key = g_strdup_printf("%s.%s", SB_LIMITS_GROUP, entry->name);
    SbLimit limit = {.figure = sb_figure_find(entry->name)};
    const SbFigure *figure = limit.figure >= 0 ? sb_figure(limit.figure) : NULL;
    g_autoptr(GError) error = NULL;
    if (figure == NULL) {
      g_autofree char *hint = issues->len < SB_ISSUES_MAX ? figure_hint(entry->name) : NULL;
      sb_issues_add(issues, shown, entry->line, key, NULL, "there is no such figure%s",
                    hint != NULL ? hint : "");
    } else if (figure->verdict == SB_VERDICT_NONE) {
      sb_issues_add(issues, shown, entry->line, key, NULL, "no limit can be set on this figure");
    } else if (!parse_limit(&limit, entry->value, figure, &error)) {
      g_autofree char *allowed = g_strdup_printf(
          ">= A, <= B or A .. B%s%s", *figure->shown != '\0' ? ", in " : "", figure->shown);
      sb_issues_add(issues, shown, entry->line, key, allowed, "%s", error->message);
    } else if (!keep(limits, &limit)) {
      sb_issues_add(issues, shown, entry->line, key, NULL,
                    "is more than the %d limits there may be", SB_LIMITS_MAX);
    }
  }
}

void sb_document_append_limits(GString *text, const SbLimits *limits) {
  for (size_t i = 0; i < limits->count; i++) {
    const SbLimit *limit = &limits->item[i];
    const SbFigure *figure = sb_figure(limit->figure);
    bool has_low = isfinite(limit->low);
    bool has_high = isfinite(limit->high);
    g_autofree char *low = sb_quantity_format(limit->low, figure->si, figure->shown);
    g_autofree char *high = sb_quantity_format(limit->high, figure->si, figure->shown);
    const char *relation = has_low && has_high ? " .. " : has_low ? ">= " : "<= ";
    g_string_append_printf(text, "%s%s = %s%s%s\n", i == 0 ? "\n[" SB_LIMITS_GROUP "]\n" : "",
                           figure->path, has_low && has_high ? low : "", relation,
                           has_high ? high : low);
  }
}

const SbLimits *sb_document_limits(const SbDocument *document) {
  return &document->limits;
}
