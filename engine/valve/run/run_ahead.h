// Prefetch of rings: a thread that has finished its own seal solves rings of the other seal.
//
// The states of one seal are solved one after the other, because films start from each other, but
// the first ring of each state has no predecessor. Order: create; add() for all states of both
// seals; then each seal's thread calls take() before it solves a state and, when its own states are
// finished, work(). take() returns a ring that another thread has solved, or waits for one in work.
// Results do not depend on which thread solved a ring.
#pragma once

#include "engine/valve/run/run_work.h"
#include "engine/valve/states/sliding.h"

// The queue of rings.
typedef struct SbRunAhead SbRunAhead;

// Creates an empty queue; NULL: no memory. Free it with sb_run_ahead_destroy().
SbRunAhead *sb_run_ahead_create(void);

// Frees the queue and the rings that were not taken. No thread may use it any more.
void sb_run_ahead_destroy(SbRunAhead *ahead);

// Adds the first ring of a task. The task is copied, and its pointers are borrowed until the queue
// is destroyed. task->memory is that of the seal's own thread, which other threads only read
// (sb_sliding_prefetch()); its counts and warnings are not used: whoever solves the state counts
// it. `slot` is a number of the caller that identifies the state, different for each, in
// sb_run_ahead_take(). `work` (copied) is the budget for solving it. Rings are solved in the order
// in which they are added, so add them in the order in which the seals reach them. Only before
// threads use the queue. Beyond one ring for each seal, SbChamber and motion it does nothing.
void sb_run_ahead_add(SbRunAhead *ahead, const SbSlidingTask *task, int slot, const SbWork *work);

// Solves rings that no thread has begun or taken, until there are none or `cancelled` (not NULL;
// called with `data` at least at each solver step) returns true. Any thread.
void sb_run_ahead_work(SbRunAhead *ahead, bool (*cancelled)(void *), void *data);

// Takes the ring of a slot and adds its steps to `work`. Waits while another thread solves it; then
// `cancelled` (not NULL) is called with `data` at least every 10 ms, to pass a cancel on; its
// result is ignored. Returns a memory for sb_sliding_memory_prefetched(), which the caller frees
// with sb_sliding_memory_destroy(). NULL: no thread has begun the ring (and none will), there is no
// such slot, or the budget is exhausted; the caller then solves the ring itself. Any thread.
SbSlidingMemory *sb_run_ahead_take(SbRunAhead *ahead, int slot, SbWork *work,
                                   bool (*cancelled)(void *), void *data);
