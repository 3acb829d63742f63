// JSON of measured loops; see the header.
#include "app/export/measured_results.h"

#include "app/base/figure_text.h"
#include "app/base/unit.h"

#include <math.h>

static const char *how_name(SbHow how) {
  static const char *const names[] = {"assumed", "found", "said"};
  return names[how];
}

static void put_recognised(SbJson *json, const SbMeasured *m) {
  const char separator[] = {m->dialect.separator, '\0'}, decimal[] = {m->dialect.decimal, '\0'};
  sb_json_object(json, "recognised");
  sb_json_string(json, "encoding", sb_text_table_encodings[m->dialect.encoding]);
  sb_json_string(json, "separator", separator);
  sb_json_string(json, "decimal", decimal);
  sb_json_count(json, "header_lines", m->header_lines);
  sb_json_count(json, "rows", m->count);
  sb_json_count(json, "rows_dropped", m->dropped);
  sb_json_count(json, "lines_skipped", m->lines.skipped);
  sb_json_bool(json, "jumps_at_blank_line", m->jumps);
  sb_json_object(json, "columns");
  for (int c = 0; c < SB_CHANNELS; c++) {
    if (m->column[c].at > 0) {
      sb_json_object(json, sb_channel_names[c]);
      sb_json_count(json, "column", m->column[c].at);
      sb_json_string(json, "name", m->column[c].name);
      sb_json_string(json, "unit", m->column[c].unit);
      sb_json_string(json, "how", how_name(m->column[c].how));
      sb_json_object_end(json);
    }
  }
  sb_json_object_end(json);
  if (m->speed > 0) {
    sb_json_object(json, "speed");
    sb_json_number(json, "m_per_s", m->speed);
    sb_json_string(json, "how", how_name(m->speed_how));
    sb_json_count(json, "rows_left_out", m->behind);
    sb_json_object_end(json);
  }
  sb_json_object(json, "direction");
  sb_json_bool(json, "force_turned", m->turned_force);
  sb_json_bool(json, "displacement_turned", m->turned_displacement);
  sb_json_string(json, "how", how_name(m->direction));
  sb_json_object_end(json);
  sb_json_object(json, "zero");
  sb_json_number(json, "displacement_m", m->at_rest);
  sb_json_string(json, "displacement_how", how_name(m->zero));
  sb_json_number(json, "force_N", m->no_load);
  sb_json_string(json, "force_how", how_name(m->force_zero));
  sb_json_object_end(json);
  sb_json_object(json, "compliance");
  sb_json_number(json, "m_per_N", m->slope);
  sb_json_string(json, "how", how_name(m->compliance));
  sb_json_object_end(json);
  sb_json_count(json, "cycles", m->cycle->len);
  sb_json_count(json, "cycle_first", m->first + 1);
  sb_json_count(json, "cycle_last", m->last + 1);
  sb_json_object_end(json);
}

void sb_measured_stage_texts(char *out[3], const SbComparison *comparison, SbStage stage) {
  const SbMeasuredStage *seen = &comparison->measured->stage[stage];
  const int figure = sb_figure_stage_force(stage);
  const double force = seen->found ? seen->force : NAN, model = comparison->model_force[stage];
  const double error = comparison->model_error[stage];
  out[0] = sb_figure_format(figure, force, seen->deviation / fabs(force));
  out[1] = sb_figure_format(figure, model, error);
  out[2] = sb_figure_format(figure, force - model,
                            hypot(seen->deviation, error * model) / fabs(force - model));
}

char *sb_measured_difference(double force) {
  return isfinite(force) ? sb_quantity_round(force, "N", "N", 3) : g_strdup("-");
}

SbTable *sb_measured_stages(const SbComparison *comparison) {
  static const SbTableColumn columns[] = {
      {.layout = "  %-10s", .label = "Stage", .width = 1},
      {"measured_N", "%12s", "Measured", "measured", 1.2},
      {"model_N", "%12s", "Model", "model", 1.2},
      {"difference_N", "%12s", "Difference", "difference", 1.2},
      {.key = "measured_m"},
      {.key = "model_m"},
      {.key = "measured_deviation_N"},
      {"reason", "  %s", "", .width = 3},
  };
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (int s = SB_STAGE_B; s < SB_STAGE_COUNT; s++) {
    const SbMeasuredStage *stage = &comparison->measured->stage[s];
    const bool found = stage->found;
    const double force = found ? stage->force : NAN, model = comparison->model_force[s];
    const char *name = sb_stage_name((SbStage)s);
    g_autofree char *label = g_strdup_printf("Stage %s", name);
    char *text[3];
    sb_measured_stage_texts(text, comparison, (SbStage)s);
    sb_table_add(table, SB_CELLS(sb_cell_text_as(name, label), sb_cell_number_own(force, text[0]),
                                 sb_cell_number_own(model, text[1]),
                                 sb_cell_number_own(force - model, text[2]),
                                 sb_cell_number(found ? stage->displacement : NAN),
                                 sb_cell_number(comparison->model_displacement[s]),
                                 sb_cell_number(found ? stage->deviation : NAN),
                                 sb_cell_text(stage->reason)));
  }
  return table;
}

void sb_json_measured_stages(SbJson *json, const SbComparison *comparison) {
  g_autoptr(SbTable) table = sb_measured_stages(comparison);
  sb_table_json(json, "stages", table);
}

void sb_json_comparison(SbJson *json, const char *key, const SbComparison *comparison) {
  sb_json_object(json, key);
  sb_json_string(json, "file", comparison->measured->name);
  sb_json_number(json, "rms_N", comparison->rms);
  sb_json_number(json, "mean_N", comparison->mean);
  sb_json_number(json, "most_N", comparison->most);
  sb_json_number(json, "noise_N", comparison->measured->noise);
  sb_json_count(json, "points", comparison->count);
  sb_json_count(json, "outside", comparison->outside);
  put_recognised(json, comparison->measured);
  sb_json_measured_stages(json, comparison);
  sb_json_object_end(json);
}

char *sb_results_compare(const SbComparedRun *const *run, size_t runs) {
  SbJson json;
  sb_json_document(&json);
  sb_json_array(&json, "runs");
  for (size_t i = 0; i < runs; i++) {
    sb_json_object(&json, NULL);
    sb_json_string(&json, "name", run[i]->name);
    sb_json_string(&json, "scene", run[i]->scene);
    sb_json_object(&json, "figures");
    for (int f = 0; f < SB_FIGURE_COUNT; f++) {
      sb_json_number(&json, sb_figure(f)->path, run[i]->figure[f]);
    }
    sb_json_object_end(&json);
    sb_json_object(&json, "reasons");
    for (int f = 0; f < SB_FIGURE_COUNT; f++) {
      if (run[i]->reason[f] != NULL) {
        sb_json_string(&json, sb_figure(f)->path, run[i]->reason[f]);
      }
    }
    sb_json_object_end(&json);
    sb_json_number(&json, "rms_N", run[i]->comparison != NULL ? run[i]->comparison->rms : NAN);
    sb_json_object_end(&json);
  }
  sb_json_array_end(&json);
  sb_json_object(&json, "differences");
  g_autofree double *difference = g_new(double, runs + 1);
  for (int f = 0; f < SB_FIGURE_COUNT; f++) {
    for (size_t i = 0; i < runs; i++) {
      difference[i] = run[i]->figure[f] - run[0]->figure[f];
    }
    sb_json_numbers(&json, sb_figure(f)->path, difference, runs);
  }
  sb_json_object_end(&json);
  if (runs > 0 && run[0]->comparison != NULL) {
    sb_json_comparison(&json, "measured", run[0]->comparison);
  }
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}
