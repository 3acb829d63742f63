// Reads a drawing (DXF, STEP) on a thread of its own. All functions of this header run in the main
// thread.
#pragma once

#include "app/document/cad_parts.h"

typedef struct SbDrawingJob SbDrawingJob;

// A drawing that was read. Owned by the job.
typedef struct {
  const char *path;
  SbCad *cad;                  // the bodies
  SbCadSettings settings;      // how it was read
  int part[SB_CAD_PART_COUNT]; // body of each part of the valve: index of cad->bodies; -1: none
} SbDrawing;

// Starts reading `path`. `choices` are lines "name = value" with the names of sb_cad_choose(); "":
// the defaults. Both are copied. `done` is called once with `user` in the main thread when the job
// has ended, also after a failure, unless the job was freed before. Never NULL; freed by
// sb_drawing_job_free().
SbDrawingJob *sb_drawing_job_start(const char *path, const char *choices, void (*done)(void *data),
                                   void *user);

// From the call of `done` on: returns the drawing, and sets *why to NULL; or returns NULL, and sets
// *why to a sentence. Both are borrowed from the job until it is freed.
const SbDrawing *sb_drawing_job_drawing(const SbDrawingJob *job, const char **why);

// Cancels, waits for the thread and frees.
void sb_drawing_job_free(SbDrawingJob *job);
