// The last runs, by the hash of their values, so that values which were computed before are
// displayed immediately. Bounded in number and, by the frames, in memory.
#pragma once

#include "app/session/displayed_run.h"

typedef struct SbRunCache SbRunCache;

// Returns an empty cache. Freed by sb_run_cache_free().
SbRunCache *sb_run_cache_new(void);

// Frees the cache and its references.
void sb_run_cache_free(SbRunCache *cache);

// Stores a reference to a complete run under `hash` (sb_document_sha256(), copied), in place of an
// earlier one. The least recently used runs are removed to stay within the bounds; a run that is
// too large is not stored.
void sb_run_cache_put(SbRunCache *cache, const char *hash, SbDisplayedRun *run);

// Returns the run of a hash; NULL: there is none. Borrowed until the next sb_run_cache_put() or
// sb_run_cache_clear().
SbDisplayedRun *sb_run_cache_get(SbRunCache *cache, const char *hash);

// Removes all runs.
void sb_run_cache_clear(SbRunCache *cache);
