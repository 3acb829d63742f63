// Rings solved ahead by the thread whose own seal is finished.
//
// The states of one seal are solved one after the other, because films start from each other; the
// first ring of each state depends on nothing before it. So a thread that has finished its own seal
// solves those that the other has not yet reached, and a seal's thread takes what is there or waits
// for what is in work. Results do not depend on which thread solved what.
#pragma once

#include "engine/valve/run/run_work.h"
#include "engine/valve/states/sliding.h"

// The queue of rings.
typedef struct SbRunAhead SbRunAhead;

// Returns an empty queue, owned by the caller; NULL: no memory.
SbRunAhead *sb_run_ahead_create(void);

// Frees the queue when no thread uses it any more. Takes NULL.
void sb_run_ahead_destroy(SbRunAhead *ahead);

// Adds the ring of a task (copied) in the order in which its seal reaches it; `slot` identifies it,
// `work` is the budget for solving it. Only before threads use the queue.
void sb_run_ahead_add(SbRunAhead *ahead, const SbSlidingTask *task, int slot, const SbWork *work);

// Solves rings that no thread has begun, until there are none or `cancelled` (not NULL; called with
// `data`) returns true. Any thread.
void sb_run_ahead_work(SbRunAhead *ahead, bool (*cancelled)(void *), void *data);

// Returns the ring of a slot, owned by the caller; waits if it is in work. NULL: no thread has
// begun it, and none will. Its steps are added to `work`. `cancelled` is called at least every 10
// ms while it waits. Any thread.
SbSlidingMemory *sb_run_ahead_take(SbRunAhead *ahead, int slot, SbWork *work,
                                   bool (*cancelled)(void *), void *data);
