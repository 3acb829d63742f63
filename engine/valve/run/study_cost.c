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

// Points of the curves, then rows of the table; a study that solves other numbers has a wrong
// prediction, not a wrong answer.
static const Solves solves_of[SB_STUDY_COUNT] = {
    [SB_STUDY_SQUEEZE] = {.rings = 2 * (20 + 1 + 4), .discs = 2 * (39 + 1 + 4)},
    [SB_STUDY_MODELS] = {.rings = 5 + 5, .discs = 2 * (5 + 5)},
    [SB_STUDY_FILM_LAW] = {.reynolds = 14 * 5 + 2},
    [SB_STUDY_STORAGE] = {.fits = (33 + 7 + 1) * SB_SEAL_COUNT,
                          .films = (33 + 7 + 1) * SB_SEAL_COUNT},
    [SB_STUDY_LEAK] = {.rings = 2 * (2 * (20 + 9) + 11), .discs = 39, .films = 5 * 39},
    [SB_STUDY_STRIBECK] = {.runs = 1, .speeds = 4 * 41},
    [SB_STUDY_TOLERANCE] = {.fits = 2 * 39, .films = 10 * 39, .cycles = 39},
    [SB_STUDY_PROPELLANTS] = {.fits = 2 * 216, .films = 10 * 216, .cycles = 216},
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
