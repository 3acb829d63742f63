// The inputs of a report: what was given and by which file, what follows from it, the models, and a
// numbered list of the sources; the parameters without effect or left to their
// defaults stand behind.
#include "app/export/report.h"

#include "app/base/number.h"
#include "engine/valve/model/motion_kind.h"

#include <string.h>

// Sources by their numbers, in the order in which they are first named.
typedef struct {
  GPtrArray *text; // of char *
} Sources;

// "[3]" of a source, which is added if it is new. Owned by the caller.
static char *cite(Sources *sources, const char *tag, const char *source) {
  // "thesis table 7.1" says it itself.
  g_autofree char *text = source == NULL || *source == '\0' ? g_strdup(tag)
                          : g_str_has_prefix(source, tag)   ? g_strdup(source)
                                                          : g_strdup_printf("%s: %s", tag, source);
  guint at = 0;
  if (!g_ptr_array_find_with_equal_func(sources->text, text, g_str_equal, &at)) {
    at = sources->text->len;
    g_ptr_array_add(sources->text, g_steal_pointer(&text));
  }
  return g_strdup_printf("[%u]", at + 1);
}

// How a scene is shown is no input of its figures.
static bool is_input(SbParamId id) {
  const SbParamGroup group = sb_param_group(id);
  // A tolerance is in the row of its size.
  return group != SB_PARAMS_OUTPUT && group != SB_PARAMS_MODELS && group != SB_PARAMS_STUDY &&
         sb_param_toleranced(id) < 0;
}

// "Gland" of "gland.radial_space". Owned by the caller.
static char *group_of(SbParamId id) {
  const char *key = sb_param(id)->key;
  char *name = g_strndup(key, strcspn(key, "."));
  name[0] = g_ascii_toupper(name[0]);
  return name;
}

// Who says a value: the scene, its valve, another parameter, or nobody, and the source of that.
// Both owned by the caller.
static char *origin_of(char **source, Sources *sources, const SbDocument *document,
                       const SbModel *model, const SbParams *params, SbParamId id) {
  const SbParam *param = sb_param(id);
  SbParamDefault follows;
  *source = NULL;
  if (params->given[id]) {
    // A file that repeats the catalogue's value has its source.
    if (params->value[id] == param->fallback) {
      *source = cite(sources, param->tag, param->source);
    }
    const char *valve = sb_document_valve_path(document);
    const char *path =
        sb_document_gives(document, id) || valve == NULL ? sb_document_path(document) : valve;
    return path != NULL ? g_path_get_basename(path) : g_strdup("not saved");
  }
  if (sb_model_default(&follows, model, id)) {
    *source = cite(sources, follows.tag, follows.source);
    return g_strdup_printf("follows from %s", follows.from);
  }
  *source = cite(sources, param->tag, param->source);
  return g_strdup("default");
}

// Six digits: what a file needs to read back to the bit nobody wants to read.
static char *value_of(const SbModel *model, SbParamId id) {
  const SbParam *param = sb_param(id);
  const double value = sb_model_value(model, id);
  if (param->kind == SB_PARAM_REAL) {
    return sb_quantity_round(value, param->si, param->unit, 6);
  }
  char *text = sb_param_format(id, value);
  if (*text == '\0') {
    g_free(text);
    return g_strdup("none");
  }
  return text;
}

static void add_parameter(SbTable *table, Sources *sources, const SbDocument *document,
                          const SbModel *model, const SbParams *params, SbParamId id) {
  const SbParam *param = sb_param(id);
  const int tolerance = sb_param_tolerance(id);
  char *source = NULL, *origin = origin_of(&source, sources, document, model, params, id);
  g_autofree char *range = tolerance >= 0 && sb_model_value(model, (SbParamId)tolerance) > 0
                               ? value_of(model, (SbParamId)tolerance)
                               : NULL;
  const bool seal = param->parent >= 0;
  sb_table_add(table,
               SB_CELLS(sb_cell_own(g_strconcat(param->label, seal ? ", " : "",
                                                seal ? sb_seal_name(param->seal) : NULL, NULL)),
                        sb_cell_text(param->symbol), sb_cell_shown(value_of(model, id)),
                        sb_cell_shown(range != NULL ? g_strdup_printf("\xc2\xb1 %s", range) : NULL),
                        sb_cell_own(origin), sb_cell_shown(source)));
}

static void draw_models(SbReportPages *pages, Sources *sources, const SbDocument *document,
                        const SbModel *model, const SbParams *params) {
  static const SbTableColumn columns[] = {{.label = "Model", .width = 1.4},
                                          {.label = "Choice", .width = 1.6},
                                          {.label = "Meaning", .width = 4.6},
                                          {.label = "From", .width = 2.2},
                                          {.label = "Source", .width = 0.9}};
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  sb_report_heading(pages, "Models", 120);
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParam *param = sb_param((SbParamId)i);
    if (sb_param_group((SbParamId)i) == SB_PARAMS_MODELS && param->kind == SB_PARAM_CHOICE) {
      char *source = NULL;
      char *origin = origin_of(&source, sources, document, model, params, (SbParamId)i);
      sb_table_add(table,
                   SB_CELLS(sb_cell_text(param->label), sb_cell_own(value_of(model, (SbParamId)i)),
                            sb_cell_text(param->help), sb_cell_own(origin), sb_cell_shown(source)));
    }
  }
  sb_report_table(pages, table);
}

// Returns whether a parameter is in the table of inputs rather than among the defaults.
static bool is_listed(const SbModel *model, const SbParams *params, SbParamId id) {
  SbParamDefault follows;
  const SbParamGroup group = sb_param_group(id);
  if (!sb_motion_kind(model)->joints && (group == SB_PARAMS_PART || group == SB_PARAMS_JOINT)) {
    return false; // the motion has no parts
  }
  if (params->given[id]) {
    return true;
  }
  return sb_param(id)->parent < 0 &&
         (sb_param_is_main(id, sb_model_number(model, SB_P_VALVE_KIND)) ||
          sb_model_default(&follows, model, id));
}

// Two parameters a row.
static void draw_defaults(SbReportPages *pages, const SbModel *model, const SbParams *params) {
  static const SbTableColumn columns[] = {{.label = "", .width = 2.6},
                                          {.label = "", .width = 1.6},
                                          {.label = "", .width = 0.2},
                                          {.label = "", .width = 2.6},
                                          {.label = "", .width = 1.6}};
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  SbTableCell cell[G_N_ELEMENTS(columns)] = {{0}};
  size_t filled = 0;
  sb_report_heading(pages, "All other parameters", 60);
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParam *param = sb_param((SbParamId)i);
    if (is_input((SbParamId)i) && param->parent < 0 && !is_listed(model, params, (SbParamId)i)) {
      cell[filled] = sb_cell_text(param->key);
      cell[filled + 1] = sb_cell_shown(value_of(model, (SbParamId)i));
      filled += 3;
    }
    if (filled > 3 || (filled > 0 && i + 1 == SB_PARAM_COUNT)) {
      sb_table_add(table, cell);
      memset(cell, 0, sizeof cell);
      filled = 0;
    }
  }
  sb_report_table(pages, table);
}

void sb_report_inputs(SbReportPages *pages, const SbDocument *document, const SbModel *model) {
  static const SbTableColumn columns[] = {
      {.label = "Parameter", .width = 3.2}, {.label = "", .width = 0.8},
      {.label = "Value", .width = 1.8},     {.label = "Tolerance", .width = 1.5},
      {.label = "From", .width = 2.4},      {.label = "Source", .width = 0.9}};
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  Sources sources = {g_ptr_array_new_with_free_func(g_free)};
  const SbParams params = sb_document_params(document);
  sb_report_heading(pages, "Inputs", 100);
  // By groups, which the catalogue comes back to.
  bool done[SB_PARAM_COUNT] = {false};
  SbParamGroup group = SB_PARAMS_GROUP_COUNT;
  for (int first = 0; first < SB_PARAM_COUNT; first++) {
    bool named = false;
    for (int i = first; i < SB_PARAM_COUNT; i++) {
      if (done[i] || !is_input((SbParamId)i) || !is_listed(model, &params, (SbParamId)i) ||
          (named && sb_param_group((SbParamId)i) != group)) {
        continue;
      }
      if (!named) {
        group = sb_param_group((SbParamId)i);
        g_autofree char *name = group_of((SbParamId)i);
        sb_table_note(table, "%s", name);
        named = true;
      }
      done[i] = true;
      add_parameter(table, &sources, document, model, &params, (SbParamId)i);
    }
  }
  sb_report_table(pages, table);
  draw_models(pages, &sources, document, model, &params);
  sb_report_heading(pages, "Sources", 60);
  for (guint i = 0; i < sources.text->len; i++) {
    g_autofree char *line =
        g_strdup_printf("[%u]  %s", i + 1, (const char *)g_ptr_array_index(sources.text, i));
    sb_report_text(pages, line, SB_TYPE_NOTE, 400, SB_ROLE_INK);
  }
  g_ptr_array_unref(sources.text);
  draw_defaults(pages, model, &params);
}
