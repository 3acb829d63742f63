// Values, model, remarks and checksum of a document; see document.h.
#include "app/document/document_private.h"

#include <inttypes.h>
#include <math.h>

const char *sb_document_path(const SbDocument *document) {
  return document->path;
}

const char *sb_document_valve_path(const SbDocument *document) {
  return document->valve_path;
}

const char *sb_document_title(const SbDocument *document) {
  return document->title;
}

// The values of the valve's file with `own` in force.
static SbParams overlay(const SbDocument *document, const SbParams *own) {
  SbParams params = document->base;
  params.rubber =
      document->data != NULL && document->data->rubber.count > 0 ? &document->data->rubber : NULL;
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    if (own->given[i]) {
      params.given[i] = true;
      params.value[i] = own->value[i];
    }
  }
  return params;
}

// A size is from the drawing of the file that gives it: that of the valve, or the document as its
// file states it, unless --set or an edit gives the size.
SbParams sb_document_params(const SbDocument *document) {
  SbParams params = overlay(document, &document->own);
  const SbParams *own = &document->own, *saved = &document->saved;
  const SbParams file = overlay(document, saved);
  const int kind = (int)sb_params_get(&params, SB_P_VALVE_KIND);
  for (int i = 0; i < SB_KEEPS_COUNT; i++) {
    SbParamId id, giver;
    double sign;
    const bool row = sb_params_keeps(&id, &giver, &sign, i, kind) && params.given[id];
    const SbParams *drawing = !own->given[id] ? &document->base : &file;
    const bool same = !own->given[id] || (saved->given[id] && !document->stated[id] &&
                                          saved->value[id] == own->value[id]);
    params.drawn[i] = row && same ? sb_params_get(drawing, giver) : 0;
  }
  return params;
}

double sb_document_value(const SbDocument *document, SbParamId id) {
  const SbParams params = overlay(document, &document->own);
  return sb_params_get(&params, id);
}

char *sb_document_text(const SbDocument *document, SbParamId id) {
  return sb_param_format(id, sb_document_value(document, id));
}

char *sb_document_problem_range(const SbProblem *problem, const SbParam *param) {
  char min[SB_NUMBER_SIZE] = "";
  char max[SB_NUMBER_SIZE] = "";
  double low = sb_quantity_to_shown(problem->min, param->si, param->unit);
  double high = sb_quantity_to_shown(problem->max, param->si, param->unit);
  bool has_min = isfinite(problem->min);
  bool has_max = isfinite(problem->max);
  if (has_min) {
    sb_number_round(min, low, 5);
  }
  if (has_max) {
    sb_number_round(max, high, 5);
  }
  const char *space = param->unit[0] != '\0' ? " " : "";
  if (has_min && has_max) {
    return g_strdup_printf("%s to %s%s%s", min, max, space, param->unit);
  }
  if (has_min || has_max) {
    return g_strdup_printf("at %s %s%s%s", has_min ? "least" : "most", has_min ? min : max, space,
                           param->unit);
  }
  return NULL;
}

// Each problem as an issue at the line to mend.
static void add_problems(const SbDocument *document, const SbParams *params,
                         const SbProblems *problems, GPtrArray *issues) {
  const char *shown = document->path != NULL ? document->path : document->name;
  for (size_t i = 0; i < problems->count; i++) {
    const SbProblem *problem = &problems->item[i];
    int id = sb_param_find(problem->key);
    if (id < 0) {
      sb_issues_add(issues, shown, 0, problem->key, NULL, "%s", problem->text);
      continue;
    }
    // The line to mend: the override's own, else its parent's; in this file, else in the valve's.
    const SbParam *param = sb_param((SbParamId)id);
    if (!params->given[id] && param->parent >= 0) {
      id = param->parent;
      param = sb_param((SbParamId)id);
    }
    bool in_valve = !document->own.given[id] && document->base.given[id];
    g_autofree char *range = sb_document_problem_range(problem, param);
    sb_issues_add(issues, in_valve ? document->valve_path : shown, 0, param->key, range, "%s",
                  problem->text);
  }
}

bool sb_document_compile(const SbDocument *document, SbModel **out, GPtrArray *issues) {
  *out = NULL;
  if (sb_document_faults(document, issues)) {
    return false;
  }
  SbParams params = sb_document_params(document);
  g_autofree SbProblems *problems = g_new(SbProblems, 1);
  const char *shown = document->path != NULL ? document->path : document->name;
  SbStatus status = sb_model_create(out, &params, document->data, &document->limits, problems);
  if (status == SB_ERROR_MEMORY) {
    sb_issues_add(issues, shown, 0, NULL, NULL, "%s", sb_status_text(status));
  } else if (status != SB_OK) {
    add_problems(document, &params, problems, issues);
  }
  return status == SB_OK;
}

void sb_document_remarks(const SbDocument *document, const SbModel *model, GPtrArray *issues) {
  SbParams params = sb_document_params(document);
  g_autofree SbProblems *problems = g_new(SbProblems, 1);
  sb_model_remarks(model, problems);
  add_problems(document, &params, problems, issues);
}

void sb_document_kept(const SbDocument *document, GPtrArray *notes) {
  const SbParams params = sb_document_params(document);
  for (int i = 0; i < SB_SIZE_CHECKS; i++) {
    char text[SB_TEXT];
    SbParamId id;
    if (sb_params_size_check(text, &id, &params, i) != NULL) {
      const bool own = document->own.given[id] || document->valve_path == NULL;
      sb_issues_add(notes, own ? document->name : document->valve_path, 0, sb_param(id)->key, NULL,
                    "%s", text);
    }
  }
}

static void sum_series(GChecksum *sum, const SbModelSeries *series) {
  for (size_t i = 0; i < series->count; i++) {
    char digits[2][SB_NUMBER_SIZE];
    sb_number_format(digits[0], series->time[i]);
    sb_number_format(digits[1], series->value[i]);
    g_autofree char *line = g_strdup_printf("%s,%s\n", digits[0], digits[1]);
    g_checksum_update(sum, (const guchar *)line, -1);
  }
}

char *sb_document_sha256(const SbDocument *document) {
  SbParams params = sb_document_params(document);
  GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    char digits[SB_NUMBER_SIZE];
    sb_number_format(digits, sb_params_get(&params, (SbParamId)i));
    g_autofree char *line = g_strdup_printf("%s=%s\n", sb_param((SbParamId)i)->key, digits);
    g_checksum_update(sum, (const guchar *)line, -1);
  }
  if (document->data != NULL) {
    sum_series(sum, &document->data->measured);
    sum_series(sum, &document->data->shelf);
    const uint64_t drawings = sb_model_data_drawings(document->data);
    g_autofree char *line = g_strdup_printf("drawn=%016" PRIx64 "\n", drawings);
    g_checksum_update(sum, (const guchar *)line, drawings != 0 ? -1 : 0);
  }
  char *hex = g_strdup(g_checksum_get_string(sum));
  g_checksum_free(sum);
  return hex;
}
