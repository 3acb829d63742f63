// The complete runs of a session by their values, so that values which were computed before are
// displayed immediately: those that the session displays, compares or has saved, and the last ones
// that nothing else uses, bounded in number and, by the frames, in memory.
#pragma once

#include "app/session/displayed_run.h"

typedef struct SbRunCache SbRunCache;

// Returns an empty cache. Freed by sb_run_cache_free().
SbRunCache *sb_run_cache_new(void);

// Frees the cache and its references.
void sb_run_cache_free(SbRunCache *cache);

// Adds a reference to a complete run, in place of an earlier one of the same values and drawings.
// The least recently used runs to which only the cache refers are removed to stay within the
// bounds.
void sb_run_cache_put(SbRunCache *cache, SbDisplayedRun *run);

// Returns the run of these values and drawings (sb_model_drawings()); NULL: there is none. Borrowed
// until the next sb_run_cache_put() or sb_run_cache_clear().
SbDisplayedRun *sb_run_cache_get(SbRunCache *cache, const SbParams *params, uint64_t drawings);

// Removes all runs.
void sb_run_cache_clear(SbRunCache *cache);
