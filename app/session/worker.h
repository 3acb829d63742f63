// A thread that computes one thing in the background of the window: progress, cancellation, and a
// callback in the main thread when it has ended. Input and result belong to the owner of the
// worker.
#pragma once

#include <glib.h>
#include <stdbool.h>

// A worker, the first member of its owner's structure. All members are for worker.c.
typedef struct {
  void (*work)(void *owner); // called in the thread
  void *owner;               // passed to `work`
  void (*done)(void *data);  // called in the main thread
  void *data;                // passed to `done`
  GThread *thread;
  GMutex lock;    // guards `source`
  guint source;   // idle source that the thread adds at its end; 0: none
  gint cancel;    // atomic: the thread is to end
  gint per_mille; // atomic: progress
} SbWorker;

// Initialises the worker and starts its thread, which calls work(owner) with a low priority. `name`
// names the thread. Once `work` has returned, also after a cancellation, done(data) is called once
// in the main thread, unless sb_worker_finish() was called before. `done` may call
// sb_worker_finish() and free the worker. The fields need not be initialised before. Main thread.
void sb_worker_start(SbWorker *worker, const char *name, void (*work)(void *owner), void *owner,
                     void (*done)(void *data), void *data);

// The following functions take the worker or its owner, whose first member it is: as hooks of the
// engine, and for a job that only its own file knows.

// Called by `work`: sets the fraction done, 0 to 1.
void sb_worker_set_progress(void *worker, double share);

// Called by `work`: returns whether it is to end. Any thread.
bool sb_worker_cancelled(void *worker);

// Returns the fraction done, 0 to 1. Any thread.
double sb_worker_progress(void *worker);

// Requests the end of the thread and returns immediately. Any thread.
void sb_worker_cancel(void *worker);

// Cancels, waits for the thread and releases the worker; `done` is not called afterwards. To be
// called once for each started worker, in the main thread, also after `done`.
void sb_worker_finish(SbWorker *worker);
