// Effects of storage: load, sliding friction, squeeze and modulus of both seals against storage
// time, by the scene's rubber (rubber/rubber_time.h: Prony relaxation, network scission and set,
// swell) and its own models of fit, film and surface.
//
// The grid is assets/studies/storage.study. At every time the ring is compiled as the cycle would
// find it after that storage; nothing is interpolated. Pressures are those of B-C, sliding at the
// drive's speed. Not modelled, as in the rubber model: ageing that depends on the contact,
// desorption, evaporation.
#include "engine/valve/studies/study_private.h"

#include <math.h>
#include <string.h>

enum { POINTS = SB_STORAGE_POINTS, TIMES = SB_STORAGE_TIMES };
enum { LOAD, FRICTION, SQUEEZE, MODULUS, SECTION, NETWORK, SET, UPTAKE };

static const struct {
  const char *name;
  double time; // [s]
} times[TIMES] = {{SB_LABEL("new"), 0},
                  {SB_LABEL("1 hour"), 3600},
                  {SB_LABEL("1 day"), 86400},
                  {SB_LABEL("7 days"), 7 * 86400.0},
                  {SB_LABEL("30 days"), 30 * 86400.0},
                  {SB_LABEL("1 year"), 365 * 86400.0},
                  {SB_LABEL("3 years"), 3 * 365 * 86400.0}};

// The grid has both seals in one line, the outer's figures first.
enum { BOUNDARY = 1, VISCOUS, SECOND, ASKED = 9 };

static void read_seal(double *value, const double *asked, const SbModel *scene) {
  value[LOAD] = asked[LOAD];
  value[FRICTION] = asked[BOUNDARY] + asked[VISCOUS];
  memcpy(value + SQUEEZE, asked + SECOND, 5 * sizeof *value);
  value[UPTAKE] = scene->rubber.swell_mass > 0 ? asked[ASKED - 1] : NAN;
}

static void derive(double *value, SbStudyWork *work, int line, double time) {
  double asked[2 * ASKED];
  (void)line;
  memcpy(asked, value, sizeof asked);
  read_seal(value, asked, work->scene);
  read_seal(sb_study_put(work, SB_INNER, time), asked + ASKED, work->scene);
}

static void make(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  const double scene_time = model->seal[SB_OUTER].stored.storage_time;
  sb_study_curves(work, SB_STUDY_CURVE, SB_LABEL("outer seal"), SB_OUTER, NULL, POINTS);
  sb_study_curves(work, SB_STUDY_CURVE, SB_LABEL("inner seal"), SB_INNER, NULL, POINTS);
  for (size_t p = 0; p < out->panel_count; p++) {
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      out->panel[p].series[seal].seal = 1 + seal;
    }
  }
  for (int i = 0; i < TIMES; i++) {
    if (times[i].time <= work->hi) {
      sb_study_cells(sb_study_row(out, "%s", times[i].name)->value, work, times[i].time, 0);
    }
  }
  SbStudyRow *scene = sb_study_row(out, "this scene, %.3g days", scene_time / 86400);
  sb_study_cells(scene->value, work, scene_time, 0);
  sb_study_mark(work, scene_time, SB_LABEL("this scene"));
  sb_message(out->models, sizeof out->models, "fit %s, film %s; rubber: %d Prony terms, %s",
             sb_fit_kind(model->fit)->name, sb_film_kind(model->film)->name,
             (int)model->rubber.terms, model->rubber.swell_mass > 0 ? "Fickian swell" : "no swell");
  sb_study_note(out,
                "%.1f K. Sliding at %.4g mm/s, pressures of B to C; the ring of each time is "
                "fitted afresh.",
                model->seal[SB_OUTER].stored.temperature, model->speed * 1e3);
  bool changes = model->rubber.swell_mass > 0 || model->rubber.network_rate > 0;
  for (size_t i = 0; i < model->rubber.terms; i++) {
    changes = changes || model->rubber.g[i] > 0;
  }
  if (!changes) {
    sb_study_note(out, "This rubber never changes: give it rubber.relaxation_share_*, "
                       "rubber.network_rate or rubber.swell_mass.");
  }
  sb_model_warn(model, &out->warnings);
}

const SbStudyDesign sb_study_storage = {
    .x = SB_QUANTITY("storage time", "day"),
    .x_logarithmic = true,
    .panel = {SB_QUANTITY("load", "N"), SB_QUANTITY("sliding friction", "N"),
              SB_QUANTITY("squeeze", "%"), SB_QUANTITY("modulus after storage", "MPa")},
    .range = offsetof(SbStudyRange, time_min),
    .row_heading = SB_LABEL("stored for"),
    .column = {SB_QUANTITY("load, outer seal", "N"), SB_QUANTITY("load, inner seal", "N"),
               SB_QUANTITY("friction, outer seal", "N"), SB_QUANTITY("friction, inner seal", "N"),
               SB_QUANTITY("section, free", "mm"), SB_QUANTITY("squeeze", "%"),
               SB_QUANTITY("modulus after storage", "MPa"), SB_QUANTITY("network left", "%"),
               SB_QUANTITY("compression set", "%"), SB_QUANTITY("uptake of its equilibrium", "%")},
    .line = {SB_OUTER, SB_INNER, SB_OUTER, SB_INNER},
    .value = {LOAD, LOAD, FRICTION, FRICTION, SECTION, SQUEEZE, MODULUS, NETWORK, SET, UPTAKE},
    .validity = "relaxation to ten times its longest time; swell below 50 % by volume; the "
                "constants are the scene's, the thesis gives only table 2.2",
    .grid = true,
    .derive = derive,
    .make = make,
};
