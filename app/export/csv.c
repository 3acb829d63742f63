// Frames and profiles as text tables.
#include "app/export/csv.h"

#include "app/base/number.h"

#include <glib.h>
#include <math.h>

static void put(FILE *stream, double value, char end) {
  char digits[SB_NUMBER_SIZE];
  // What was not computed is empty.
  fputs(isnan(value) ? "" : sb_number_format(digits, value), stream);
  fputc(end, stream);
}

void sb_csv_cycle(FILE *stream, const SbRun *run) {
  fputs("time [s],displacement [m],velocity [m/s],force [N],pressure_force [N],"
        "friction_inner [N],friction_outer [N],platen [m],stop_force [N],spring_force [N],"
        "stage,on_event,"
        "load_inner [N],load_outer [N],film_central_inner [m],film_central_outer [m],"
        "land_fraction_inner [1],land_fraction_outer [1],chamber_pressure [Pa]",
        stream);
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
  bool rig = sb_run_model(run)->motion == SB_MODEL_MOTION_RIG;
  fputs(rig ? ",peak\n" : "\n", stream);
  size_t count = 0;
  const SbFrame *frames = sb_run_frames(run, &count);
  for (size_t i = 0; i < count && ferror(stream) == 0; i++) {
    const SbFrame *frame = &frames[i];
    const SbSealFrame *inner = &frame->seal[SB_INNER];
    const SbSealFrame *outer = &frame->seal[SB_OUTER];
    const double before[] = {frame->time,        frame->displacement,   frame->velocity,
                             frame->force,       frame->pressure_force, inner->friction,
                             outer->friction,    frame->platen,         frame->stop_force,
                             frame->spring_force};
    for (size_t k = 0; k < sizeof before / sizeof before[0]; k++) {
      put(stream, before[k], ',');
    }
    fprintf(stream, "%s,%d,", sb_stage_name((SbStage)frame->stage), frame->on_event);
    const double after[] = {
        inner->load,          outer->load,          inner->film_central,    outer->film_central,
        inner->land_fraction, outer->land_fraction, frame->chamber_pressure};
    const size_t last = sizeof after / sizeof after[0] - 1;
    for (size_t k = 0; k <= last; k++) {
      put(stream, after[k], k < last || rig || bodies->joints > 0 ? ',' : '\n');
    }
    const SbReaction *reaction = sb_run_reactions(run, i);
    for (size_t k = 0; k < bodies->joints; k++) {
      put(stream, reaction[k].force[0], k + 1 < bodies->joints ? ',' : '\n');
    }
    if (rig) {
      fprintf(stream, "%d\n", frame->peak);
    }
  }
}

void sb_csv_life(FILE *stream, const SbRun *run) {
  fputs("actuation,roughness [1],force_peak [N],force_breakaway [N],force_return "
        "[N],returns,lambda [1],leakage [m3],"
        "leakage_carried [m3],leakage_sum [m3],leakage_carried_sum [m3]\n",
        stream);
  size_t count;
  const SbLifeActuation *each = sb_run_life(run, &count);
  double net = 0;
  double carried = 0;
  for (size_t i = 0; i < count && ferror(stream) == 0; i++) {
    const SbLifeActuation *one = &each[i];
    net += one->leakage;
    carried += one->carried;
    fprintf(stream, "%zu,", i + 1);
    put(stream, one->roughness, ',');
    put(stream, one->force_peak, ',');
    put(stream, one->force_breakaway, ',');
    put(stream, one->force_return, ',');
    put(stream, one->returned, ',');
    put(stream, one->lambda, ',');
    put(stream, one->leakage, ',');
    put(stream, one->carried, ',');
    put(stream, net, ',');
    put(stream, carried, '\n');
  }
}

void sb_csv_profiles(FILE *stream, const SbRun *run) {
  fputs("frame,seal,x [m],pressure [Pa],film [m],asperity_pressure [Pa]\n", stream);
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
        fprintf(stream, "%zu,%s,", i, sb_seal_name(seal));
        put(stream, profile->x[k], ',');
        put(stream, profile->pressure[k], ',');
        put(stream, profile->film[k], ',');
        put(stream, profile->asperity_pressure[k], '\n');
      }
    }
  }
}
