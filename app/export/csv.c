// Frames and profiles as text tables.
#include "app/export/csv.h"

#include "app/base/device.h"
#include "app/base/figure_text.h"
#include "app/table/table.h"

#include "engine/valve/sealbench.h"

#include <glib.h>
#include <math.h>
#include <string.h>

void sb_csv_figures(FILE *stream, const SbRun *run) {
  static const SbTableColumn columns[] = {{.key = "figure"}, {.key = "value"},
                                          {.key = "unit"},   {.key = "error_estimate [1]"},
                                          {.key = "label"},  {.key = "reason"}};
  const SbSummary *summary = sb_run_summary(run);
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    g_autofree char *label = sb_figure_label(i);
    sb_table_add(
        table, SB_CELLS(sb_cell_text(sb_figure(i)->path),
                        sb_cell_number(sb_figure_value(summary, i)), sb_cell_text(sb_figure(i)->si),
                        sb_cell_number(sb_figure_error_reported(summary, i)), sb_cell_text(label),
                        sb_cell_text(sb_figure_error_reason(summary, i))));
  }
  sb_table_csv(stream, table);
}

// The columns of a frame behind its time, a heading and an expression each; stage and on_event
// stand between.
#define COLUMNS_BEFORE(COLUMN)                                                                     \
  COLUMN("displacement [m]", frame->displacement)                                                  \
  COLUMN("velocity [m/s]", frame->velocity)                                                        \
  COLUMN("force [N]", frame->force)                                                                \
  COLUMN("pressure_force [N]", frame->pressure_force)                                              \
  COLUMN("friction_inner [N]", frame->seal[SB_INNER].friction)                                     \
  COLUMN("friction_outer [N]", frame->seal[SB_OUTER].friction)                                     \
  COLUMN("platen [m]", frame->platen)                                                              \
  COLUMN("stop_force [N]", frame->stop_force)                                                      \
  COLUMN("spring_force [N]", frame->spring_force)
#define COLUMNS_AFTER(COLUMN)                                                                      \
  COLUMN("load_inner [N]", frame->seal[SB_INNER].load)                                             \
  COLUMN("load_outer [N]", frame->seal[SB_OUTER].load)                                             \
  COLUMN("film_central_inner [m]", frame->seal[SB_INNER].film_central)                             \
  COLUMN("film_central_outer [m]", frame->seal[SB_OUTER].film_central)                             \
  COLUMN("land_fraction_inner [1]", (double)frame->seal[SB_INNER].land_fraction)                   \
  COLUMN("land_fraction_outer [1]", (double)frame->seal[SB_OUTER].land_fraction)                   \
  COLUMN("chamber_pressure [Pa]", frame->chamber_pressure)                                         \
  COLUMN("friction_boundary_inner [N]", frame->seal[SB_INNER].friction_boundary)                   \
  COLUMN("friction_boundary_outer [N]", frame->seal[SB_OUTER].friction_boundary)                   \
  COLUMN("friction_viscous_inner [N]", frame->seal[SB_INNER].friction_viscous)                     \
  COLUMN("friction_viscous_outer [N]", frame->seal[SB_OUTER].friction_viscous)
#define HEADING(name, value) "," name
#define PUT(name, value)     sb_csv_put(stream, sb_cell_number(value));

void sb_csv_cycle(FILE *stream, const SbRun *run) {
  fputs("time [s]" COLUMNS_BEFORE(HEADING) ",stage,on_event" COLUMNS_AFTER(HEADING), stream);
  // Axial force of each joint on the first part it names.
  const SbBodiesSummary *bodies = &sb_run_summary(run)->bodies;
  for (size_t i = 0; i < bodies->joints; i++) {
    // "stem centre, stem top" becomes reaction_stem_centre_stem_top.
    g_auto(GStrv) words = g_strsplit_set(bodies->joint[i].name, ", ", -1);
    fputs(",reaction", stream);
    for (char **word = words; *word != NULL; word++) {
      fprintf(stream, "%s%s", **word != '\0' ? "_" : "", *word);
    }
    fputs(" [N]", stream);
  }
  // Of the rig's force: 1 the first peak, 2 one that follows.
  bool rig = !sb_device(sb_run_model(run))->stem;
  fputs(rig ? ",peak\n" : "\n", stream);
  size_t count = 0;
  const SbFrame *frames = sb_run_frames(run, &count);
  for (size_t i = 0; i < count && ferror(stream) == 0; i++) {
    const SbFrame *frame = &frames[i];
    char digits[SB_NUMBER_SIZE];
    fputs(sb_number_format(digits, frame->time), stream);
    COLUMNS_BEFORE(PUT)
    fprintf(stream, ",%s,%d", sb_stage_name((SbStage)frame->stage), frame->on_event);
    COLUMNS_AFTER(PUT)
    const SbReaction *reaction = sb_run_reactions(run, i);
    for (size_t k = 0; k < bodies->joints; k++) {
      sb_csv_put(stream, sb_cell_number(reaction[k].force[0]));
    }
    fprintf(stream, rig ? ",%d\n" : "\n", frame->peak);
  }
}

const SbLifeColumn sb_life_columns[] = {
    {"roughness", "1", offsetof(SbLifeActuation, roughness)},
    {"force_peak", "N", offsetof(SbLifeActuation, force_peak)},
    {"force_breakaway", "N", offsetof(SbLifeActuation, force_breakaway)},
    {"force_return", "N", offsetof(SbLifeActuation, force_return)},
    {"returns", NULL, offsetof(SbLifeActuation, returned)},
    {"lambda", "1", offsetof(SbLifeActuation, lambda)},
    {"leakage", "m3", offsetof(SbLifeActuation, leakage)},
    {"leakage_carried", "m3", offsetof(SbLifeActuation, carried)},
    {"dose", "kg", offsetof(SbLifeActuation, dose)},
    {0}};

double sb_life_value(const SbLifeActuation *of, const SbLifeColumn *column) {
  return *(const double *)((const char *)of + column->offset);
}

void sb_csv_life(FILE *stream, const SbRun *run) {
  fputs("actuation", stream);
  for (const SbLifeColumn *column = sb_life_columns; column->name != NULL; column++) {
    fprintf(stream, column->unit != NULL ? ",%s [%s]" : ",%s", column->name, column->unit);
  }
  fputs(",leakage_sum [m3],leakage_carried_sum [m3]\n", stream);
  size_t count;
  const SbLifeActuation *each = sb_run_life(run, &count);
  double net = 0;
  double carried = 0;
  for (size_t i = 0; i < count && ferror(stream) == 0; i++) {
    net += each[i].leakage;
    carried += each[i].carried;
    fprintf(stream, "%zu", i + 1);
    for (const SbLifeColumn *column = sb_life_columns; column->name != NULL; column++) {
      sb_csv_put(stream, sb_cell_number(sb_life_value(&each[i], column)));
    }
    sb_csv_put(stream, sb_cell_number(net));
    sb_csv_put(stream, sb_cell_number(carried));
    fputc('\n', stream);
  }
}

void sb_csv_profiles(FILE *stream, const SbRun *run) {
  fputs("frame,seal,x [m],pressure [Pa],film [m],asperity_pressure [Pa],film_pressure [Pa]\n",
        stream);
  size_t count = 0;
  const SbFrame *frames = sb_run_frames(run, &count);
  uint32_t shown[SB_SEAL_COUNT] = {UINT32_MAX, UINT32_MAX};
  for (size_t i = 0; i < count; i++) {
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      uint32_t index = frames[i].seal[seal].profile;
      if (index == shown[seal]) {
        continue;
      }
      shown[seal] = index;
      const SbContactProfile *profile = index != UINT32_MAX ? sb_run_profile(run, index) : NULL;
      for (size_t k = 0; profile != NULL && k < profile->count && ferror(stream) == 0; k++) {
        const double film = profile->film_pressure != NULL ? profile->film_pressure[k] : NAN;
        const SbTableCell row[] = {sb_cell_number((double)i),
                                   sb_cell_text(sb_seal_name(seal)),
                                   sb_cell_number(profile->x[k]),
                                   sb_cell_number(profile->pressure[k]),
                                   sb_cell_number(profile->film[k]),
                                   sb_cell_number(profile->asperity_pressure[k]),
                                   sb_cell_number(film)};
        sb_csv_row(stream, row, G_N_ELEMENTS(row));
      }
    }
  }
}
