// The last runs by the hash of what they were made from, so that values which were solved before
// are shown at once. Bounded in number and, by the frames, in memory.
#pragma once

#include "app/session/displayed_run.h"

typedef struct SbRunCache SbRunCache;

SbRunCache *sb_run_cache_new(void);
void sb_run_cache_free(SbRunCache *cache); // takes NULL

// Keeps a complete run, in place of one of the same hash; the least recently used go.
void sb_run_cache_put(SbRunCache *cache, const char *hash, SbDisplayedRun *run);

// The run of a hash, borrowed; NULL if there is none.
SbDisplayedRun *sb_run_cache_get(SbRunCache *cache, const char *hash);

void sb_run_cache_clear(SbRunCache *cache);
