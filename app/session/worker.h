// A thread that makes one thing beside the window: its progress, its cancelling, and the call back
// on the main thread when it is done. What it makes is the owner's affair.
#pragma once

#include <glib.h>
#include <stdbool.h>

typedef struct {
  void (*work)(void *owner); // on the thread
  void *owner;
  void (*done)(void *data); // on the main thread
  void *data;
  GThread *thread;
  GMutex lock;    // guards `source`
  guint source;   // posted by the thread as its last act
  gint cancel;    // atomic
  gint per_mille; // atomic: progress
} SbWorker;

// Starts the thread. `done` is called once on the main thread unless the worker is finished before.
void sb_worker_start(SbWorker *worker, const char *name, void (*work)(void *owner), void *owner,
                     void (*done)(void *data), void *data);

// From the thread: the share done, 0 to 1, and whether to end.
void sb_worker_tell(SbWorker *worker, double share);
bool sb_worker_cancelled(SbWorker *worker);

// Share done, 0 to 1.
double sb_worker_progress(SbWorker *worker);

// Asks the thread to end; returns at once.
void sb_worker_cancel(SbWorker *worker);

// Cancels and waits; `done` is not called any more.
void sb_worker_finish(SbWorker *worker);
