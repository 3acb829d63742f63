// A list, the last used first. See the header.
#include "app/session/run_cache.h"

enum { RUNS_MAX = 8, FRAMES_MAX = 200000 }; // some 100 MB of frames

struct SbRunCache {
  GQueue runs; // of SbDisplayedRun, owned references
};

SbRunCache *sb_run_cache_new(void) {
  SbRunCache *cache = g_new0(SbRunCache, 1);
  g_queue_init(&cache->runs);
  return cache;
}

void sb_run_cache_clear(SbRunCache *cache) {
  g_queue_clear_full(&cache->runs, (GDestroyNotify)sb_displayed_run_unref);
}

void sb_run_cache_free(SbRunCache *cache) {
  if (cache != NULL) {
    sb_run_cache_clear(cache);
    g_free(cache);
  }
}

SbDisplayedRun *sb_run_cache_get(SbRunCache *cache, const SbParams *params, uint64_t drawings) {
  for (GList *link = cache->runs.head; link != NULL; link = link->next) {
    if (sb_displayed_run_is_of(link->data, params, drawings)) {
      g_queue_unlink(&cache->runs, link);
      g_queue_push_head_link(&cache->runs, link);
      return link->data;
    }
  }
  return NULL;
}

void sb_run_cache_put(SbRunCache *cache, SbDisplayedRun *run) {
  SbDisplayedRun *former =
      sb_run_cache_get(cache, &run->params, sb_model_drawings(sb_run_model(run->run)));
  sb_displayed_run_ref(run);
  if (former != NULL) {
    sb_displayed_run_unref(g_queue_pop_head(&cache->runs));
  }
  g_queue_push_head(&cache->runs, run);
  size_t frames = 0, unused = 0;
  for (GList *link = cache->runs.head, *next; link != NULL; link = next) {
    next = link->next;
    SbDisplayedRun *each = link->data;
    if (each->references > 1) {
      continue;
    }
    frames += sb_run_capacity(each->run);
    if (++unused > RUNS_MAX || frames > FRAMES_MAX) {
      sb_displayed_run_unref(each);
      g_queue_delete_link(&cache->runs, link);
    }
  }
}
