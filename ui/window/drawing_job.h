// Reads a drawing (DXF, STEP) on a thread beside the window.
#pragma once

#include "app/document/cad_parts.h"

typedef struct SbDrawingJob SbDrawingJob;

// What was read; `part` as in parts.h. Belongs to the job.
typedef struct {
  const char *path;
  SbCad *cad;
  SbCadSettings settings;
  int part[SB_CAD_PART_COUNT];
} SbDrawing;

// `choices` are lines "name = value" by the names of sb_cad_choose(). `done` is called once on the
// main thread unless the job is freed before.
SbDrawingJob *sb_drawing_job_start(const char *path, const char *choices, void (*done)(void *data),
                                   void *user);

// Once it is done: what was read, or NULL and why. Both belong to the job.
const SbDrawing *sb_drawing_job_drawing(const SbDrawingJob *job, const char **why);

// Waits for the thread; takes NULL.
void sb_drawing_job_free(SbDrawingJob *job);
