// What storage does: load, sliding friction, squeeze and modulus of both seals against storage
// time, by the scene's rubber (elastic/rubber_time.h: Prony relaxation, network scission and set,
// swell) and its own models of fitment, film and surface.
//
// At every time the ring is compiled afresh as the cycle would find it after that storage; nothing
// is interpolated. Pressures are those of B-C, sliding at the drive's speed. Leaves out what the
// rubber model leaves out: ageing that depends on the contact, desorption, evaporation.
#include "engine/valve/studies/study_private.h"

#include <math.h>

enum { POINTS = 33, ROWS_MAX = 8, FIGURES = 4 };

double sb_study_storage_cost(const SbModel *model) {
  double fit = sb_cost_fit(model->fit);
  double film = sb_cost_film(model->film);
  return (POINTS + ROWS_MAX) * SB_SEAL_COUNT * (fit + film);
}

// Both seals after a storage time; the evaluator has their rings.
typedef struct {
  double load[SB_SEAL_COUNT], friction[SB_SEAL_COUNT];
} Figures;

static Figures solve(SbStudyWork *work, double time) {
  static const char *const paths[] = {"seals.outer.load_N",
                                      "seals.inner.load_N",
                                      "seals.outer.friction_boundary_N",
                                      "seals.inner.friction_boundary_N",
                                      "seals.outer.friction_viscous_N",
                                      "seals.inner.friction_viscous_N"};
  const SbOverride stored = {SB_P_STORAGE_TIME, time};
  double value[6];
  sb_study_ask(work, value, paths, 6, &stored, 1);
  return (Figures){{value[0], value[1]}, {value[2] + value[4], value[3] + value[5]}};
}

static const char *const seal_names[SB_SEAL_COUNT] = {"outer seal", "inner seal"};

static void draw(SbStudyWork *work) {
  SbStudy *out = work->out;
  SbStudyPanel *panel[FIGURES] = {
      sb_study_panel(out, "load", "N", "N", false),
      sb_study_panel(out, "sliding friction", "N", "N", false),
      sb_study_panel(out, "squeeze", "1", "%", false),
      sb_study_panel(out, "modulus as held", "Pa", "MPa", false),
  };
  SbStudySeries *series[FIGURES][SB_SEAL_COUNT];
  for (int q = 0; q < FIGURES; q++) {
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      series[q][seal] = sb_study_series(panel[q], SB_STUDY_CURVE, "%s", seal_names[seal]);
    }
  }
  double lo = work->scene->study.time_min, hi = work->scene->study.time_max;
  for (int i = 0; i < POINTS; i++) {
    double time = lo * pow(hi / lo, i / (POINTS - 1.0));
    Figures f = solve(work, time);
    const SbModel *then = sb_evaluator_model(work->evaluator);
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      const SbSealModel *ring = then != NULL ? &then->seal[seal] : NULL;
      sb_study_point(series[0][seal], time, f.load[seal]);
      sb_study_point(series[1][seal], time, f.friction[seal]);
      sb_study_point(series[2][seal], time, ring != NULL ? ring->squeeze : NAN);
      sb_study_point(series[3][seal], time, ring != NULL ? ring->modulus : NAN);
    }
  }
}

static void table(SbStudyWork *work, double scene_time) {
  SbStudy *out = work->out;
  static const struct {
    const char *name;
    double time;
  } times[] = {{"new", 0},
               {"1 hour", 3600},
               {"1 day", 86400},
               {"7 days", 7 * 86400.0},
               {"30 days", 30 * 86400.0},
               {"1 year", 365 * 86400.0},
               {"3 years", 3 * 365 * 86400.0}};
  enum { TIMES = sizeof times / sizeof times[0] };
  sb_text(out->row_heading, sizeof out->row_heading, "stored for");
  sb_study_column(out, "load, outer seal", "N", "N");
  sb_study_column(out, "load, inner seal", "N", "N");
  sb_study_column(out, "friction, outer seal", "N", "N");
  sb_study_column(out, "friction, inner seal", "N", "N");
  sb_study_column(out, "section, free", "m", "mm");
  sb_study_column(out, "squeeze", "1", "%");
  sb_study_column(out, "modulus as held", "Pa", "MPa");
  sb_study_column(out, "network left", "1", "%");
  sb_study_column(out, "compression set", "1", "%");
  sb_study_column(out, "uptake of its equilibrium", "1", "%");
  for (int i = 0; i <= TIMES; i++) {
    double time = i < TIMES ? times[i].time : scene_time;
    if (i < TIMES && time > work->scene->study.time_max) {
      continue;
    }
    SbStudyRow *row =
        i < TIMES ? sb_study_row(out, NULL, NULL, "%s", times[i].name)
                  : sb_study_row(out, NULL, NULL, "this scene, %.3g days", scene_time / 86400);
    Figures f = solve(work, time);
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      row->value[seal] = f.load[seal];
      row->value[2 + seal] = f.friction[seal];
    }
    const SbModel *then = sb_evaluator_model(work->evaluator);
    if (then == NULL) {
      continue;
    }
    const SbSealModel *seal = &then->seal[SB_OUTER];
    row->value[4] = seal->section_diameter;
    row->value[5] = seal->squeeze;
    row->value[6] = seal->modulus;
    row->value[7] = seal->storage.network;
    row->value[8] = seal->storage.compression_set;
    row->value[9] = then->rubber.swell_mass > 0 ? seal->storage.uptake : NAN;
  }
}

void sb_study_storage(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbModel *model = work->scene;
  double scene_time = model->seal[SB_OUTER].stored.storage_time;
  sb_study_fix_machine(work);
  sb_study_axis(&out->x, "storage time", "s", "day", true);
  draw(work);
  table(work, scene_time);
  if (scene_time >= model->study.time_min && scene_time <= model->study.time_max) {
    sb_study_mark(out, scene_time, "this scene");
  }
  char film[32];
  sb_param_choice_name(sb_param(SB_P_MODELS_FILM), (int)model->film, film, sizeof film);
  sb_text(out->models, sizeof out->models, "fit %s, film %s; rubber: %d Prony terms, %s",
          sb_fit_model_name(model->fit), film, (int)model->rubber.terms,
          model->rubber.swell_mass > 0 ? "Fickian swell" : "no swell");
  sb_text(out->validity, sizeof out->validity,
          "relaxation to ten times its longest time; swell below 50 %% by volume; the constants "
          "are the scene's, the thesis gives but table 2.2");
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
  sb_model_warn_storage(model, &out->warnings);
}
