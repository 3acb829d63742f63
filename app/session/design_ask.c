// The question to a design. See design_ask.h. Tolerances are those of the document: a half-width is
// three deviations of a normal one, as in `assets/studies/light-valve.study`.
#include "app/session/design_ask.h"

#include "app/base/device.h"

#include "engine/valve/sealbench.h"

#include <math.h>
#include <string.h>

// Of a design whose file says nothing.
static const struct {
  const char *figure;
  double low, high;
} usual[] = {{"cycle.force_breakaway_N", -INFINITY, 30},
             {"cycle.force_return_margin_N", 2, INFINITY},
             {"seals.outer.squeeze", 0.08, 0.25},
             {"seals.outer.gland_fill", -INFINITY, 0.85}};

// The choices that make closed forms of a document's models.
static const char *const closed_forms[][2] = {{"models.set", "thesis"},
                                              {"models.fit", "karaszkiewicz"},
                                              {"models.film", "thesis"},
                                              {"models.friction", "thesis"},
                                              {"models.surface", "greenwood-tripp"},
                                              {"models.inlet", "flooded"},
                                              {"models.asperities", "beside"}};

// Bounds about a value: a tenth to either side, to a hundredth of it in the unit shown.
static void lay_bounds(SbDesignRange *range, const SbDocument *document) {
  const SbParam *param = sb_param(range->id);
  const double value = sb_document_value(document, range->id);
  const double shown = fabs(sb_quantity_to_shown(value, param->si, param->unit));
  const int power = shown > 0 ? (int)floor(log10(0.0101 * shown)) : 0;
  const double wide = shown > 0 ? 0.1 * fabs(value) : 0.1 * param->max;
  range->low = sb_quantity_step(value - wide, param->si, param->unit, power, 0);
  range->high = sb_quantity_step(value + wide, param->si, param->unit, power, 0);
  range->low = fmin(fmax(range->low, param->min), param->max);
  range->high = fmin(fmax(range->high, param->min), param->max);
}

void sb_design_ask_limit(SbDesignAsk *ask, int figure, double low, double high) {
  SbLimits *limits = &ask->limits;
  size_t at = 0;
  while (at < limits->count && limits->item[at].figure != figure) {
    at++;
  }
  ask->usual = false;
  if (!isfinite(low) && !isfinite(high)) {
    if (at < limits->count) {
      memmove(&limits->item[at], &limits->item[at + 1],
              (limits->count - at - 1) * sizeof limits->item[0]);
      limits->count--;
    }
  } else if (at < SB_DESIGN_LIMITS) {
    limits->item[at] = (SbLimit){figure, low, high};
    limits->count = MAX(limits->count, at + 1);
  }
}

void sb_design_ask_init(SbDesignAsk *ask, const SbDocument *document) {
  *ask = (SbDesignAsk){.goal = sb_figure_find("cycle.force_breakaway_N"),
                       .limits = *sb_document_limits(document)};
  ask->left_out = ask->limits.count - MIN(ask->limits.count, SB_DESIGN_LIMITS);
  ask->limits.count -= ask->left_out;
  const SbParams params = sb_document_params(document);
  const int kind = (int)sb_params_get(&params, SB_P_VALVE_KIND);
  const SbDevice *device = sb_device_of_kind(kind);
  // Closed forms are of a round section in a groove.
  ask->closed =
      device->gland && sb_params_get(&params, SB_P_SEAL_PROFILE) == SB_SEAL_PROFILE_CIRCLE;
  if (ask->limits.count == 0) {
    // The last is of a ring in its groove.
    ask->usual = true;
    ask->limits.count = G_N_ELEMENTS(usual) - (device->gland ? 0 : 1);
    for (size_t i = 0; i < ask->limits.count; i++) {
      ask->limits.item[i] = (SbLimit){sb_figure_find(usual[i].figure), usual[i].low, usual[i].high};
    }
  }
  for (int id = 0; id < SB_PARAM_COUNT && ask->count < SB_DESIGN_RANGES; id++) {
    if (sb_param_is_main((SbParamId)id, kind) && sb_param((SbParamId)id)->kind == SB_PARAM_REAL) {
      SbDesignRange *range = &ask->range[ask->count];
      *range = (SbDesignRange){.id = (SbParamId)id};
      lay_bounds(range, document);
      if (!(range->low < range->high)) {
        continue;
      }
      const int axis = id == (int)device->up ? 1 : id == (int)device->across ? 0 : -1;
      range->free = axis >= 0;
      if (axis >= 0) {
        ask->axis[axis] = ask->count;
      }
      ask->count++;
    }
  }
}

size_t sb_design_ask_figures(int *figure, size_t room) {
  size_t count = 0;
  for (int i = 0; i < SB_FIGURE_COUNT && count < room; i++) {
    const SbFigure *of = sb_figure(i);
    if (of->brief && of->digits > 0 && of->verdict != SB_VERDICT_NONE) {
      figure[count++] = i;
    }
  }
  return count;
}

size_t sb_design_ask_goals(int *figure, size_t room) {
  const size_t count = sb_design_ask_figures(figure, room);
  size_t goals = 0;
  for (size_t i = 0; i < count; i++) {
    if (sb_figure(figure[i])->better != SB_BETTER_NONE) {
      figure[goals++] = figure[i];
    }
  }
  return goals;
}

void sb_design_ask_set_goal(SbDesignAsk *ask, int figure) {
  ask->goal = figure;
  ask->maximise = sb_figure(figure)->better == SB_BETTER_MORE;
}

static void append_quantity(GString *text, double value, const char *si, const char *unit) {
  g_autofree char *shown = sb_quantity_format(value, si, unit);
  g_string_append(text, shown);
}

static void append_bounds(GString *text, const SbDesignAsk *ask) {
  g_string_append(text, "\n[vary]\n");
  for (size_t i = 0; i < ask->count; i++) {
    const SbDesignRange *range = &ask->range[i];
    const SbParam *param = sb_param(range->id);
    if (range->free) {
      g_string_append_printf(text, "%s = uniform ", param->key);
      append_quantity(text, range->low, param->si, param->unit);
      g_string_append(text, " .. ");
      append_quantity(text, range->high, param->si, param->unit);
      g_string_append_c(text, '\n');
    }
  }
}

static void append_limits(GString *text, const SbDesignAsk *ask) {
  for (size_t i = 0; i < ask->limits.count; i++) {
    const SbLimit *limit = &ask->limits.item[i];
    const SbFigure *of = sb_figure(limit->figure);
    const bool low = isfinite(limit->low), high = isfinite(limit->high);
    g_string_append_printf(text, "%s%s = %s", i == 0 ? "\n[limits]\n" : "", of->path,
                           low && high ? ""
                           : low       ? ">= "
                                       : "<= ");
    append_quantity(text, low ? limit->low : limit->high, of->si, of->shown);
    if (low && high) {
      g_string_append(text, " .. ");
      append_quantity(text, limit->high, of->si, of->shown);
    }
    g_string_append_c(text, '\n');
  }
}

// Of the parameters that have one; not of one whose tolerance is nil.
static void append_tolerances(GString *text, const SbDocument *document) {
  const SbParams params = sb_document_params(document);
  bool begun = false;
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    const SbParam *param = sb_param((SbParamId)id);
    const int band = param->parent < 0 ? sb_param_tolerance((SbParamId)id) : -1;
    const double half = band >= 0 ? sb_params_get(&params, (SbParamId)band) : 0;
    if (half > 0) {
      const char *of = sb_param((SbParamId)band)->unit;
      g_string_append_printf(text, "%s%s = normal ", begun ? "" : "\n[tolerances]\n", param->key);
      append_quantity(text, 0, param->si, of);
      g_string_append(text, ", ");
      append_quantity(text, half / 3, param->si, of);
      g_string_append_c(text, '\n');
      begun = true;
    }
  }
}

// Returns the text of this study file, which names the file `scene` as its scene; also for a
// request that sb_design_ask_study() refuses. `closed` is not part of the text: the settings of the
// closed forms are options --set of the command.
static char *study_text(const SbDesignAsk *ask, const SbDocument *document, const char *scene) {
  GString *text = g_string_new("[sealbench]\nformat = 1\nkind = study\n");
  const char *goal = sb_figure(ask->goal)->path;
  g_string_append_printf(text, "scene = %s\n", scene);
  append_bounds(text, ask);
  g_string_append_printf(text, "\n[study]\nfigures = %s\n", goal);
  g_string_append_printf(text, "\n[design]\nobjective = %s %s\n",
                         ask->maximise ? "maximise" : "minimise", goal);
  if (ask->robust) {
    char digits[SB_NUMBER_SIZE];
    g_string_append_printf(text, "robust = %s\n", sb_number_round(digits, SB_DESIGN_ROBUST, 6));
  }
  append_limits(text, ask);
  append_tolerances(text, document);
  return g_string_free(text, FALSE);
}

SbStudyFile *sb_design_ask_study(const SbDesignAsk *ask, const SbDocument *document,
                                 GPtrArray *issues) {
  const char *path = sb_document_path(document);
  g_autofree char *directory = path != NULL ? g_path_get_dirname(path) : NULL;
  g_autofree char *own = sb_document_to_text(document, NULL);
  SbDocument *copy =
      sb_document_parse(own, strlen(own), sb_document_title(document), directory, issues);
  if (copy == NULL || issues->len > 0) {
    sb_document_free(copy);
    return NULL;
  }
  g_autoptr(GPtrArray) settings = g_ptr_array_new_with_free_func(g_free);
  for (size_t i = 0; ask->closed && i < G_N_ELEMENTS(closed_forms); i++) {
    g_ptr_array_add(settings, g_strdup_printf("%s=%s", closed_forms[i][0], closed_forms[i][1]));
  }
  g_ptr_array_add(settings, NULL);
  g_autofree char *text = study_text(ask, document, "document");
  return sb_study_file_parse(text, strlen(text), sb_document_title(document), directory,
                             (char **)settings->pdata, copy, issues);
}
