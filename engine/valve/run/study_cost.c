// Predicted time of drawn studies: the number of solves of each kind, times the cost of one.
#include "engine/valve/run/study_cost.h"

#include "engine/valve/run/cost.h"
#include "engine/valve/run/plan.h"

// Numbers of solves.
typedef struct {
  int rings, discs; // fitments
  int fits, films;  // by the scene's own models
  int reynolds;     // films on the half-plane
  int cycles;       // quasi-static
  int runs;         // of the scene itself
  int speeds;       // films of its states at other speeds
} Solves;

enum {
  STORAGE = (SB_STORAGE_POINTS + SB_STORAGE_TIMES + 1) * SB_SEAL_COUNT,
  MODELS = SB_MODELS_PRESSURES + SB_MODELS_SIZES,
  CYCLES = 1 + 2 * (SB_TOLERANCE_SIZES * SB_TOLERANCE_STEPS + SB_TOLERANCE_FIGURES),
  ANSWERS =
      SB_PROPELLANTS_FLUIDS * (SB_PROPELLANTS_POINTS + SB_PROPELLANTS_TABLE * SB_PROPELLANTS_PARTS),
  FILMS = 10 // films of a cycle
};

// Points of the curves, then rows of the table.
static const Solves solves_of[SB_STUDY_COUNT] = {
    [SB_STUDY_SQUEEZE] = {.rings = 2 * (SB_SQUEEZE_RING_POINTS + 1 + SB_SQUEEZE_TABLE),
                          .discs = 2 * (SB_SQUEEZE_DISC_POINTS + 1 + SB_SQUEEZE_TABLE)},
    [SB_STUDY_MODELS] = {.rings = MODELS, .discs = 2 * MODELS},
    [SB_STUDY_FILM_LAW] = {.reynolds = SB_FILM_LAW_SPEEDS * SB_FILM_LAW_LOADS + 2},
    [SB_STUDY_STORAGE] = {.fits = STORAGE, .films = STORAGE},
    [SB_STUDY_LEAK] = {.rings = 2 * (2 * (SB_LEAK_RING_POINTS + SB_LEAK_FINE) + SB_LEAK_ROWS),
                       .discs = SB_LEAK_POINTS,
                       .films = SB_LEAK_LINES * SB_LEAK_POINTS},
    [SB_STUDY_STRIBECK] = {.runs = 1, .speeds = SB_STRIBECK_LINES * SB_STRIBECK_POINTS},
    [SB_STUDY_TOLERANCE] = {.fits = SB_SEAL_COUNT * CYCLES,
                            .films = FILMS * CYCLES,
                            .cycles = CYCLES},
    [SB_STUDY_PROPELLANTS] = {.fits = SB_SEAL_COUNT * ANSWERS,
                              .films = FILMS * ANSWERS,
                              .cycles = ANSWERS},
};

double sb_study_cost(SbStudyKind kind, const SbModel *model) {
  if ((unsigned)kind >= SB_STUDY_COUNT) {
    return 0;
  }
  const Solves *solves = &solves_of[kind];
  double runs = 0;
  if (solves->runs > 0) {
    SbPlan plan;
    sb_plan_wished(&plan, model, &(SbPlanWishes){0});
    for (size_t i = 0; i < plan.field_count; i++) {
      runs += solves->runs * plan.field[i].cost_s;
    }
  }
  return runs + solves->speeds * sb_cost_speed_state(model) + solves->rings * SB_COST_RING +
         solves->discs * SB_COST_DISC + solves->fits * sb_cost_fit(model->fit) +
         solves->films * sb_cost_film(model->film) + solves->reynolds * SB_COST_FILM +
         solves->cycles * SB_COST_ACTUATION;
}
