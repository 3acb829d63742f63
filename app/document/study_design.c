// [design] and [tolerances] of a study file, and the study of a design's scatter; see study_file.h.
#include "app/document/study_file_private.h"

#include <math.h>
#include <string.h>

static void read_objective(SbStudyReader *reader, const SbEntry *entry) {
  static const char form[] = "minimise FIGURE, maximise FIGURE";
  SbDesignWish *design = &reader->study->design;
  const size_t length = strcspn(entry->value, " \t");
  design->maximise = length == 8 && strncmp(entry->value, "maximise", length) == 0;
  if (!design->maximise && (length != 8 || strncmp(entry->value, "minimise", length) != 0)) {
    sb_study_add_issue(reader, entry, form, "is not an objective");
    design->figure = SB_FIGURE_REFUSED;
    return;
  }
  g_autofree char *path = g_strstrip(g_strdup(entry->value + length));
  const int figure = sb_study_read_figure(reader, entry, path);
  design->figure = figure >= 0 ? figure : SB_FIGURE_REFUSED;
  if (design->figure >= 0 && sb_figure(design->figure)->digits == 0) {
    sb_study_add_issue(reader, entry, NULL, "a yes or no is not an objective");
  }
}

void sb_study_read_design(SbStudyReader *reader, const SbEntry *entry) {
  SbDesignWish *design = &reader->study->design;
  double value = 0;
  if (strcmp(entry->name, "objective") == 0) {
    read_objective(reader, entry);
  } else if (strcmp(entry->name, "robust") == 0) {
    if (sb_number_parse(&value, entry->value) && value >= 0.5 && value < 1) {
      design->robust = value;
    } else {
      sb_study_add_issue(reader, entry, "0.5 to below 1",
                         "is not a probability that all limits hold");
    }
  } else if (strcmp(entry->name, "starts") == 0) {
    if (sb_study_read_count(&value, entry->value, 1, 10000)) {
      design->starts = (size_t)value;
    } else {
      sb_study_add_issue(reader, entry, "1 to 10000", "is not a number of starts");
    }
  } else {
    sb_study_add_issue(reader, entry, "objective, robust, starts", "unknown key");
  }
}

static bool is_bounds(const SbVary *vary) {
  const SbDistribution *of = &vary->distribution;
  return of->kind == SB_DISTRIBUTION_UNIFORM || of->kind == SB_DISTRIBUTION_LOGUNIFORM ||
         (of->kind == SB_DISTRIBUTION_LEVELS && of->count == 1);
}

// What a design needs of its groups.
void sb_study_check_design(SbStudyReader *reader) {
  const SbStudyFile *study = reader->study;
  const SbDesignWish *design = &study->design;
  size_t free = 0;
  for (guint i = 0; i < study->vary->len; i++) {
    const SbVary *vary = &g_array_index(study->vary, SbVary, i);
    free += vary->distribution.kind != SB_DISTRIBUTION_LEVELS;
    if (!is_bounds(vary)) {
      g_autofree char *key = g_strconcat(GROUP_VARY ".", sb_param(vary->id)->key, NULL);
      sb_issues_add(reader->issues, reader->shown, 0, key,
                    "uniform A .. B, loguniform A .. B, levels A",
                    "a design requires bounds, or one value");
    }
  }
  for (guint i = 0; i < design->tolerances->len; i++) {
    // Both seals' size does not move that of one seal, which is set by itself.
    const SbParamId id = g_array_index(design->tolerances, SbVary, i).id;
    for (guint k = 0; k < study->vary->len; k++) {
      const SbParam *param = sb_param(g_array_index(study->vary, SbVary, k).id);
      if (param->parent == (int)id) {
        g_autofree char *key = g_strconcat(GROUP_TOLERANCES ".", sb_param(id)->key, NULL);
        sb_issues_add(reader->issues, reader->shown, 0, key, NULL,
                      "%s varies, which this does not move: name each seal's", param->key);
      }
    }
  }
  if (design->figure == SB_FIGURE_NONE) {
    sb_issues_add(reader->issues, reader->shown, 0, GROUP_DESIGN ".objective",
                  "minimise FIGURE, maximise FIGURE", "is missing");
  }
  if (free == 0 && study->vary->len > 0) {
    sb_issues_add(reader->issues, reader->shown, 0, GROUP_VARY, NULL,
                  "a design needs bounds: nothing is free");
  }
  if (isfinite(design->robust) && (design->tolerances->len == 0 || study->limits.count == 0)) {
    sb_issues_add(reader->issues, reader->shown, 0, GROUP_DESIGN ".robust", NULL, "needs %s",
                  design->tolerances->len == 0 ? "[tolerances]" : "[limits]");
  }
}

void sb_study_note_kept(SbStudyReader *reader) {
  const SbStudyFile *study = reader->study;
  if (study->scene == NULL) {
    return;
  }
  const SbParams params = sb_document_params(study->scene);
  const int kind = (int)sb_params_get(&params, SB_P_VALVE_KIND);
  for (guint k = 0; k < study->vary->len; k++) {
    const SbVary *vary = &g_array_index(study->vary, SbVary, k);
    for (int i = 0; i < SB_KEEPS_COUNT; i++) {
      SbParamId id, giver;
      double sign;
      const bool row = sb_params_keeps(&id, &giver, &sign, i, kind) && vary->id == giver;
      if (row && params.given[id] && vary->distribution.kind != SB_DISTRIBUTION_NORMAL &&
          sb_study_vary_index(study, sb_param(id)->key) < 0) {
        g_autofree char *key = g_strdup_printf(GROUP_VARY ".%s", sb_param(giver)->key);
        g_autofree char *stays = sb_param_format(id, params.value[id]);
        sb_issues_add(study->notes, reader->shown, vary->line, key, NULL,
                      "%s stays at %s while %s varies; vary it too if the drawing changes both",
                      sb_param(id)->key, stays, sb_param(giver)->key);
      }
    }
  }
}

// A size that follows another one follows its design, not the scatter of its manufacture: it is
// fixed at what the middle of the other one's tolerance makes of it.
static void fix_kept(SbStudyFile *about, const SbStudyFile *study, const double *value) {
  const SbParams params = sb_document_params(study->scene);
  const int kind = (int)sb_params_get(&params, SB_P_VALVE_KIND);
  const guint tolerances = about->vary->len;
  for (guint k = 0; k < tolerances; k++) {
    const SbParamId giver = g_array_index(about->vary, SbVary, k).id;
    const int at = sb_study_vary_index(study, sb_param(giver)->key);
    const double change = at >= 0 ? value[at] - sb_model_value(study->base, giver) : 0;
    for (int i = 0; i < SB_KEEPS_COUNT; i++) {
      SbParamId id, follows;
      double sign;
      const bool row = sb_params_keeps(&id, &follows, &sign, i, kind) && follows == giver;
      const char *key = sb_param(id)->key;
      if (!row || params.given[id] || sb_study_vary_index(about, key) >= 0 ||
          sb_study_vary_index(study, key) >= 0) {
        continue;
      }
      SbVary vary = {.id = id, .levels = g_new(double, 1)};
      vary.levels[0] = sb_model_value(study->base, id) + sign * change;
      vary.distribution =
          (SbDistribution){.kind = SB_DISTRIBUTION_LEVELS, .level = vary.levels, .count = 1};
      g_array_append_val(about->vary, vary);
    }
  }
}

SbStudyFile *sb_study_file_about(const SbStudyFile *study, const double *value, size_t samples) {
  SbStudyFile *about = g_new0(SbStudyFile, 1);
  *about = (SbStudyFile){.borrowed = true,
                         .title = study->title,
                         .scene = study->scene,
                         .base = study->base,
                         .base_sha256 = study->base_sha256,
                         .method = SB_METHOD_RELIABILITY,
                         .samples = samples,
                         .seed = study->seed,
                         .limits = study->limits};
  about->vary = g_array_new(FALSE, FALSE, sizeof(SbVary));
  about->figures = g_array_new(FALSE, FALSE, sizeof(int));
  for (size_t i = 0; i < study->limits.count; i++) {
    sb_study_take_figure(about->figures, study->limits.item[i].figure);
  }
  const GArray *tolerances = study->design.tolerances;
  for (guint i = 0; i < tolerances->len; i++) {
    SbVary vary = g_array_index(tolerances, SbVary, i);
    const SbParam *param = sb_param(vary.id);
    int at = sb_study_vary_index(study, param->key);
    // A seal's size that nobody set follows that of both.
    if (at < 0 && param->parent >= 0 && !sb_document_params(study->scene).given[vary.id]) {
      at = sb_study_vary_index(study, sb_param((SbParamId)param->parent)->key);
    }
    const double middle = at >= 0 ? value[at] : sb_model_value(study->base, vary.id);
    SbDistribution *of = &vary.distribution;
    of->a += middle;
    of->b += of->kind == SB_DISTRIBUTION_UNIFORM ? middle : 0;
    of->low += middle;
    of->high += middle;
    vary.offset = false;
    g_array_append_val(about->vary, vary);
  }
  fix_kept(about, study, value);
  for (guint i = 0; i < study->vary->len; i++) {
    SbVary vary = {.id = g_array_index(study->vary, SbVary, i).id};
    if (sb_study_vary_index(about, sb_param(vary.id)->key) < 0) {
      vary.levels = g_new(double, 1);
      vary.levels[0] = value[i];
      vary.distribution =
          (SbDistribution){.kind = SB_DISTRIBUTION_LEVELS, .level = vary.levels, .count = 1};
      g_array_append_val(about->vary, vary);
    }
  }
  return about;
}
