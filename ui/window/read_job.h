// Reads a scan or a drawing on a thread of its own. All functions of this header run in the main
// thread.
#pragma once

#include "app/document/cad_parts.h"
#include "app/export/surface.h"

// A kind of file, whose functions get an object of `size` bytes, zero at first. The job calls
// `init`, then on its thread `choose` for each choice and `read`, at last `clear`. `choose` and
// `read` return false and set *error after a failure, which ends the job.
typedef struct {
  size_t size;
  void (*init)(void *object); // sets the default choices
  // Sets the choice `name` to the value `text`.
  bool (*choose)(void *object, const char *name, const char *text, GError **error);
  bool (*read)(void *object, const char *path, GError **error); // `path` outlives the object
  void (*clear)(void *object);                                  // also after a failure
} SbReadKind;

// A drawing that was read.
typedef struct {
  const char *path;
  SbCad *cad;                  // the bodies
  SbCadSettings settings;      // how it was read
  int part[SB_CAD_PART_COUNT]; // body of each part of the valve: index of cad->bodies; -1: none
} SbDrawing;

// A scan: choices of sb_surface_choose(), result SbSurface. A drawing (DXF, STEP): choices of
// sb_cad_choose(), result SbDrawing.
extern const SbReadKind sb_read_scan, sb_read_drawing;

typedef struct SbReadJob SbReadJob;

// Starts reading `path`. `choices` are lines "name = value"; "": the defaults. Both are copied.
// `done` is called once with `user` in the main thread when the job has ended, also after a
// failure, unless the job was freed before. Never NULL; freed by sb_read_job_free().
SbReadJob *sb_read_job_start(const SbReadKind *kind, const char *path, const char *choices,
                             void (*done)(void *data), void *user);

// From the call of `done` on: returns the result of the kind, and sets *why to NULL; or returns
// NULL, and sets *why to the error. Both are borrowed from the job until it is freed.
const void *sb_read_job_result(const SbReadJob *job, const GError **why);

// Waits for the thread, which reads to its end first, and frees the job.
void sb_read_job_free(SbReadJob *job);
