#include "engine/valve/run/run_ahead.h"

#include "engine/valve/run/run_private.h"

#include <pthread.h>
#include <stdlib.h>
#include <time.h>

enum { RINGS_MAX = SB_SEAL_COUNT * SB_CYCLE_CHAMBERS * SB_RUN_MOTIONS };

typedef enum { WAITING, IN_WORK, SOLVED, TAKEN } Progress;

typedef struct {
  int slot;
  SbSlidingTask task;
  SbSlidingMemory *memory; // owned, from its beginning until it is taken
  SbWork work;             // what solving it takes, of its seal's budget
  Progress progress;
} Ring;

struct SbRunAhead {
  pthread_mutex_t lock;
  pthread_cond_t solved;
  Ring ring[RINGS_MAX];
  int count;
};

SbRunAhead *sb_run_ahead_create(void) {
  SbRunAhead *ahead = calloc(1, sizeof *ahead);
  if (ahead != NULL && pthread_mutex_init(&ahead->lock, NULL) != 0) {
    free(ahead);
    return NULL;
  }
  if (ahead != NULL && pthread_cond_init(&ahead->solved, NULL) != 0) {
    pthread_mutex_destroy(&ahead->lock);
    free(ahead);
    return NULL;
  }
  return ahead;
}

void sb_run_ahead_destroy(SbRunAhead *ahead) {
  if (ahead != NULL) {
    for (int i = 0; i < ahead->count; i++) {
      sb_sliding_memory_destroy(ahead->ring[i].memory);
    }
    pthread_cond_destroy(&ahead->solved);
    pthread_mutex_destroy(&ahead->lock);
    free(ahead);
  }
}

void sb_run_ahead_add(SbRunAhead *ahead, const SbSlidingTask *task, int slot, const SbWork *work) {
  if (ahead->count < RINGS_MAX) {
    ahead->ring[ahead->count++] = (Ring){.slot = slot, .task = *task, .work = *work};
  }
}

// Returns the next ring that no thread has begun, and marks it as begun.
static Ring *begin(SbRunAhead *ahead) {
  Ring *ring = NULL;
  pthread_mutex_lock(&ahead->lock);
  for (int i = 0; i < ahead->count && ring == NULL; i++) {
    if (ahead->ring[i].progress == WAITING) {
      ring = &ahead->ring[i];
      ring->progress = IN_WORK;
    }
  }
  pthread_mutex_unlock(&ahead->lock);
  return ring;
}

void sb_run_ahead_work(SbRunAhead *ahead, bool (*cancelled)(void *), void *data) {
  Ring *ring;
  while (!cancelled(data) && (ring = begin(ahead)) != NULL) {
    SbSlidingMemory *memory = NULL;
    if (sb_sliding_memory_create(&memory, NULL) == SB_OK) {
      SbCounters counters = {0}; // who takes the ring counts it
      SbSlidingTask task = ring->task;
      task.memory = memory;
      task.counts = &counters;
      task.warnings = NULL;
      ring->work.cancelled = cancelled;
      ring->work.data = data;
      sb_sliding_memory_poll(memory, sb_work_step, &ring->work);
      sb_sliding_prefetch(&task, ring->task.memory);
    }
    pthread_mutex_lock(&ahead->lock);
    ring->memory = memory;
    ring->progress = SOLVED;
    pthread_cond_broadcast(&ahead->solved);
    pthread_mutex_unlock(&ahead->lock);
  }
}

SbSlidingMemory *sb_run_ahead_take(SbRunAhead *ahead, int slot, SbWork *work,
                                   bool (*cancelled)(void *), void *data) {
  static const long ASK_NS = 10000000;
  SbSlidingMemory *memory = NULL;
  pthread_mutex_lock(&ahead->lock);
  for (int i = 0; i < ahead->count; i++) {
    Ring *ring = &ahead->ring[i];
    if (ring->slot != slot || ring->progress == TAKEN) {
      continue;
    }
    while (ring->progress == IN_WORK) {
      struct timespec until;
      timespec_get(&until, TIME_UTC);
      until.tv_nsec += ASK_NS;
      until.tv_sec += until.tv_nsec / 1000000000;
      until.tv_nsec %= 1000000000;
      pthread_cond_timedwait(&ahead->solved, &ahead->lock, &until);
      pthread_mutex_unlock(&ahead->lock);
      (void)cancelled(data); // passes a cancel on to the working thread
      pthread_mutex_lock(&ahead->lock);
    }
    memory = ring->memory;
    ring->memory = NULL;
    ring->progress = TAKEN;
    sb_work_add(work, &ring->work);
    if (work->spent) { // the seal would not have solved it
      sb_sliding_memory_destroy(memory);
      memory = NULL;
    }
  }
  pthread_mutex_unlock(&ahead->lock);
  return memory;
}
