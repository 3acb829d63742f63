// A design question answered on a thread of its own, a part after the other: the map of two
// parameters (coarse, then fine), the search for the best, what tolerances do to figures at the
// present and at the best design, and valves drawn from the tolerances about both.
//
// What is there can be looked at meanwhile, under the lock. Solver and studies are those of
// `sealbench design` and `study` (app/study).
#pragma once

#include "app/session/design_answer.h"
#include "app/session/design_ask.h"

typedef struct SbDesignJob SbDesignJob;

typedef enum {
  SB_DESIGN_PART_MAP,
  SB_DESIGN_PART_SEARCH,
  SB_DESIGN_PART_TOLERANCES,
  SB_DESIGN_PART_VALVES
} SbDesignPart;

// Starts it on a study made from `ask` (sb_design_ask_study()), which it takes over. `store` keeps
// the map's answers and the valves'; borrowed, of one job at a time. Without `search` the map and
// the present design alone. `done` is called once on the main thread unless the job was freed
// before. Owned by the caller.
SbDesignJob *sb_design_job_start(SbStudyFile *study, const SbDesignAsk *ask, SbStore *store,
                                 bool search, void (*done)(void *data), void *data);

// The answer so far; borrowed, to be read between lock and unlock only.
const SbDesignAnswer *sb_design_job_lock(SbDesignJob *job);
void sb_design_job_unlock(SbDesignJob *job);

// Which part is under way; share of all that is done, 0 to 1.
SbDesignPart sb_design_job_part(SbDesignJob *job);
double sb_design_job_progress(SbDesignJob *job);

// Holds it between two valves, or goes on; asks it to end. Return at once.
void sb_design_job_pause(SbDesignJob *job, bool on);
void sb_design_job_cancel(SbDesignJob *job);

// Only after `done`: the answer, as far as it came, for the caller to free. *why says what ended it
// early (owned by the caller), NULL: it is whole. Once.
SbDesignAnswer *sb_design_job_take(SbDesignJob *job, char **why);

// Cancels, waits, frees. Takes NULL.
void sb_design_job_free(SbDesignJob *job);
