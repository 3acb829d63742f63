// What storage does: load, sliding friction, squeeze and modulus of both seals against storage
// time, by the scene's rubber (elastic/rubber_time.h: Prony relaxation, network scission and set,
// swell) and its own models of fitment, film and surface.
//
// At every time the ring is compiled afresh as the cycle would find it after that storage; nothing
// is interpolated. Pressures are those of B-C, sliding at the drive's speed. Leaves out what the
// rubber model leaves out: ageing that depends on the contact, desorption, evaporation.
#include "engine/valve/studies/study_private.h"

#include <math.h>
#include <stdlib.h>

enum { POINTS = 33, ROWS_MAX = 8, FIGURES = 4 };

double sb_study_storage_cost(const SbModel *model) {
  double fit = sb_cost_fit(model->fit);
  double film = sb_cost_film(model->film);
  return (POINTS + ROWS_MAX) * SB_SEAL_COUNT * (fit + film);
}

typedef struct {
  double load, friction, squeeze, modulus;
} Figures;

// One seal after a storage time.
static SbStatus solve(SbStudy *out, Figures *figures, SbModel *model, int seal, double time,
                      SbSlidingMemory *memory, SbReport *report) {
  model->seal[seal].stored.storage_time = time;
  SbProblems problems = {0};
  if (!sb_model_size_seal(model, seal, &problems)) {
    *figures = (Figures){NAN, NAN, NAN, NAN};
    sb_warn(&out->warnings, "study-gap-storage", problems.item[0].key,
            "the %s seal after some storage: %s", sb_seal_name(seal), problems.item[0].text);
    return SB_OK;
  }
  // The memory keeps a fitment by its pressure alone; the ring has changed.
  sb_sliding_memory_forget(memory);
  SbSliding state;
  SbStatus status = sb_study_sliding(out, &state, model, seal,
                                     sb_model_seal_pressure(model, seal, SB_CHAMBER_AT_REST),
                                     model->speed, memory, report);
  *figures = (Figures){state.load, sb_sliding_friction(&state), model->seal[seal].squeeze,
                       model->seal[seal].modulus};
  return status;
}

static const char *const seal_names[SB_SEAL_COUNT] = {"outer seal", "inner seal"};

static SbStatus draw(SbStudy *out, SbModel *model, SbSlidingMemory *memory,
                     const SbStudyHooks *hooks, SbReport *report) {
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
  double lo = model->study.time_min, hi = model->study.time_max;
  SbStatus status = SB_OK;
  for (int i = 0; status == SB_OK && i < POINTS; i++) {
    double time = lo * pow(hi / lo, i / (POINTS - 1.0));
    for (int seal = 0; status == SB_OK && seal < SB_SEAL_COUNT; seal++) {
      Figures f;
      status = solve(out, &f, model, seal, time, memory, report);
      const double value[FIGURES] = {f.load, f.friction, f.squeeze, f.modulus};
      for (int q = 0; q < FIGURES; q++) {
        sb_study_point(series[q][seal], time, value[q]);
      }
    }
    if (status == SB_OK) {
      status = sb_study_step(hooks, 0.85 * (i + 1) / POINTS, report);
    }
  }
  return status;
}

static SbStatus table(SbStudy *out, SbModel *model, double scene_time, SbSlidingMemory *memory,
                      SbReport *report) {
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
  SbStatus status = SB_OK;
  for (int i = 0; status == SB_OK && i <= TIMES; i++) {
    double time = i < TIMES ? times[i].time : scene_time;
    if (i < TIMES && time > model->study.time_max) {
      continue;
    }
    SbStudyRow *row =
        i < TIMES ? sb_study_row(out, NULL, NULL, "%s", times[i].name)
                  : sb_study_row(out, NULL, NULL, "this scene, %.3g days", scene_time / 86400);
    Figures f[SB_SEAL_COUNT];
    for (int seal = 0; status == SB_OK && seal < SB_SEAL_COUNT; seal++) {
      status = solve(out, &f[seal], model, seal, time, memory, report);
      row->value[seal] = f[seal].load;
      row->value[2 + seal] = f[seal].friction;
    }
    const SbSealModel *seal = &model->seal[SB_OUTER];
    row->value[4] = seal->section_diameter;
    row->value[5] = seal->squeeze;
    row->value[6] = seal->modulus;
    row->value[7] = seal->storage.network;
    row->value[8] = seal->storage.compression_set;
    row->value[9] = model->rubber.swell_mass > 0 ? seal->storage.uptake : NAN;
  }
  return status;
}

SbStatus sb_study_storage(SbStudy *out, const SbModel *model, const SbStudyHooks *hooks,
                          SbReport *report) {
  SbModel copy = *model;
  SbSlidingMemory *memory = NULL;
  SbStatus status = sb_sliding_memory_create(&memory, report);
  if (status == SB_OK) {
    sb_study_axis(&out->x, "storage time", "s", "day", true);
    status = draw(out, &copy, memory, hooks, report);
  }
  double scene_time = model->seal[SB_OUTER].stored.storage_time;
  if (status == SB_OK) {
    status = table(out, &copy, scene_time, memory, report);
  }
  sb_sliding_memory_destroy(memory);
  if (status != SB_OK) {
    return status;
  }
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
  return SB_OK;
}
