// A search for a design in a thread of its own, one part after the other: the map of two parameters
// (coarse, then fine), the search for the best design, the effects of tolerances at the present and
// at the best design, and valves drawn from the tolerances about both. Solver and studies are those
// of `sealbench design` and `study` (app/study).
//
// Functions are called in the main thread. Results can be read while the job runs, under its lock.
#pragma once

#include "app/session/design_answer.h"
#include "app/session/design_ask.h"

typedef struct SbDesignJob SbDesignJob;

// Parts, in their order.
typedef enum {
  SB_DESIGN_PART_MAP,
  SB_DESIGN_PART_SEARCH,
  SB_DESIGN_PART_TOLERANCES,
  SB_DESIGN_PART_VALVES
} SbDesignPart;

// Starts the job. It owns `study`, which sb_design_ask_study() made from `ask` (copied). `store`
// stores the evaluations of the map and of the valves; it is borrowed until the job is freed, and
// only one job may use it at a time (NULL: nothing is stored). Without `search`, only the map and
// the present design are computed. done(data) is called once in the main thread at the end, unless
// the job was freed before. sb_worker_progress() takes the job. Freed by sb_design_job_free().
SbDesignJob *sb_design_job_start(SbStudyFile *study, const SbDesignAsk *ask, SbStore *store,
                                 bool search, void (*done)(void *data), void *data);

// Locks the results and returns them as far as they are computed. Borrowed until
// sb_design_job_unlock(), which must follow soon: the job waits meanwhile.
const SbDesignAnswer *sb_design_job_lock(SbDesignJob *job);

// Unlocks the results.
void sb_design_job_unlock(SbDesignJob *job);

// Returns the part that is being computed.
SbDesignPart sb_design_job_part(SbDesignJob *job);

// Pauses the job between two valves (`on`), or continues it. Returns immediately.
void sb_design_job_pause(SbDesignJob *job, bool on);

// Requests the end of the job. Returns immediately; `done` follows.
void sb_design_job_cancel(SbDesignJob *job);

// To be called once, after `done`: returns the results as far as they were computed, freed by
// sb_design_answer_free(). *why (freed by g_free()) is the reason if the job ended early, "" if it
// was cancelled; NULL: the results are complete. Afterwards the job has no results:
// sb_design_job_lock() returns NULL.
SbDesignAnswer *sb_design_job_take(SbDesignJob *job, char **why);

// Cancels, waits for the thread and frees the job.
void sb_design_job_free(SbDesignJob *job);
