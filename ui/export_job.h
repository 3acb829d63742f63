// One export on a thread of its own: a picture or a film of a finished run.
#pragma once

#include "app/run/runner.h"

#include <glib.h>

// What to make. Texts are owned by whoever holds the struct.
typedef struct {
  char *path;           // .png, .svg, .pdf, or .mp4 for a film
  char *view;           // name in sb_render_views()
  double width, height; // pixels
  gboolean dark;
  char *at;        // of a picture: "C" or "7.27 s"
  int fps;         // of a film
  double duration; // of a film: the whole cycle in this time [s]
  char *title, *subtitle, *hash, *scene;
} SbExportRequest;

void sb_export_request_clear(SbExportRequest *request);

typedef struct SbExportJob SbExportJob;

// Starts it; takes over the texts of `request` and the reference `handle`. `done` is called once on
// the main thread unless the job was freed before. Owned by the caller.
SbExportJob *sb_export_job_start(SbRunHandle *handle, SbExportRequest *request,
                                 void (*done)(void *data), void *data);

// Share done, 0 to 1; a picture goes from 0 to 1 at once.
double sb_export_job_progress(SbExportJob *job);

// Asks it to end; returns at once. A film keeps the pictures done so far, playable.
void sb_export_job_cancel(SbExportJob *job);

// Only after `done`: a sentence about the result, and whether it is a good one. Borrowed.
const char *sb_export_job_result(SbExportJob *job, gboolean *good);

// Cancels, waits, frees. Takes NULL.
void sb_export_job_free(SbExportJob *job);
