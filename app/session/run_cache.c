// A list, the last used first. See the header.
#include "app/session/run_cache.h"

#include <string.h>

enum { RUNS_MAX = 8, FRAMES_MAX = 200000 }; // some 100 MB of frames

typedef struct {
  char *hash;
  SbDisplayedRun *run; // owned reference
} Entry;

struct SbRunCache {
  GQueue entries; // of Entry
};

SbRunCache *sb_run_cache_new(void) {
  SbRunCache *cache = g_new0(SbRunCache, 1);
  g_queue_init(&cache->entries);
  return cache;
}

static void entry_free(gpointer data) {
  Entry *entry = data;
  g_free(entry->hash);
  sb_displayed_run_unref(entry->run);
  g_free(entry);
}

void sb_run_cache_clear(SbRunCache *cache) {
  g_queue_clear_full(&cache->entries, entry_free);
}

void sb_run_cache_free(SbRunCache *cache) {
  if (cache != NULL) {
    sb_run_cache_clear(cache);
    g_free(cache);
  }
}

static GList *find(SbRunCache *cache, const char *hash) {
  GList *link = cache->entries.head;
  while (link != NULL && strcmp(((Entry *)link->data)->hash, hash) != 0) {
    link = link->next;
  }
  return link;
}

SbDisplayedRun *sb_run_cache_get(SbRunCache *cache, const char *hash) {
  GList *link = find(cache, hash);
  if (link == NULL) {
    return NULL;
  }
  g_queue_unlink(&cache->entries, link);
  g_queue_push_head_link(&cache->entries, link);
  return ((Entry *)link->data)->run;
}

void sb_run_cache_put(SbRunCache *cache, const char *hash, SbDisplayedRun *run) {
  if (sb_run_capacity(run->run) > FRAMES_MAX) {
    return;
  }
  Entry *entry = g_new(Entry, 1);
  *entry = (Entry){g_strdup(hash), sb_displayed_run_ref(run)};
  GList *link = find(cache, hash);
  if (link != NULL) {
    entry_free(link->data);
    g_queue_delete_link(&cache->entries, link);
  }
  g_queue_push_head(&cache->entries, entry);
  size_t frames = 0;
  guint kept = 0;
  for (link = cache->entries.head; link != NULL; link = link->next) {
    frames += sb_run_capacity(((Entry *)link->data)->run->run);
    kept += frames <= FRAMES_MAX && kept < RUNS_MAX;
  }
  while (cache->entries.length > kept) {
    entry_free(g_queue_pop_tail(&cache->entries));
  }
}
