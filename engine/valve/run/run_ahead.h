// First rings of a run's states, solved ahead by the thread whose own seal is done.
//
// The states of one seal go one after the other, since their films start from each other; the first
// ring of each hangs on nothing before. So the thread that has ended with its own seal solves those
// that the other one has still to come to, and a seal's thread takes what is there, or waits for
// what is in work. Results do not depend on who solved what.
#pragma once

#include "engine/valve/run/run_work.h"
#include "engine/valve/states/sliding.h"

typedef struct SbRunAhead SbRunAhead;

// Of no state yet; owned, NULL: no memory. `destroy`, once nobody works on it, takes NULL.
SbRunAhead *sb_run_ahead_create(void);
void sb_run_ahead_destroy(SbRunAhead *ahead);

// Adds the ring of a task, in the order in which its seal comes to it; `slot` names it, `work` is
// the budget that solving it may use. Before any thread works.
void sb_run_ahead_add(SbRunAhead *ahead, const SbSlidingTask *task, int slot, const SbWork *work);

// Solves rings that nobody has begun, until there are none or `cancelled` says so.
void sb_run_ahead_work(SbRunAhead *ahead, bool (*cancelled)(void *), void *data);

// What was solved for a slot, owned by the caller from now on, after waiting for what is in work;
// NULL: nothing was begun, and nobody will. What it took is added to `work`. `cancelled` is asked
// while it waits.
SbSlidingMemory *sb_run_ahead_take(SbRunAhead *ahead, int slot, SbWork *work,
                                   bool (*cancelled)(void *), void *data);
