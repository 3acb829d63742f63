// One export on a thread of its own: a picture or a film of a finished run.
#pragma once

#include "app/chart/data.h"
#include "app/data/measured.h"
#include "app/run/runner.h"
#include "app/section/painter.h"
#include "app/session/session.h"

#include <glib.h>

// What to make. Texts are owned by whoever holds the struct.
typedef struct {
  char *stale;          // why the run no longer fits the values, NULL if it does
  char *path;           // with an ending of formats.h, or the pattern of a sequence
  char *view;           // name in sb_render_views(), or "report": the pages, .json the figures
  double width, height; // pixels
  gboolean dark;
  SbSectionStyle style; // of views that show the section
  char *at;             // of a picture: "C" or "7.27 s"
  int fps;              // of a film
  double duration;      // of a film: the whole range in this time [s]
  double speed;         // or, if above 0, seconds of the run per second of film
  char *from, *to;      // of a film: "B" or "2 s"; NULL: the start or end
  char *title, *subtitle, *hash, *scene;
  SbData *measured;   // drawn beside the run, owned; NULL: none
  double drive_speed; // for it, as sb_measured_load()
  // Kept designs drawn beside, by their looks, NULL: none; and bookmarks. Both are owned.
  SbRunHandle *pin[SB_CHART_PINS];
  char *pin_name[SB_CHART_PINS]; // as pictures have it
  SbChartMarker *marker;         // `marker_count` of them, with names of their own
  size_t marker_count;
  // Of a report or .json: the document's file (NULL: it has none), and its text where that differs.
  char *file, *document;
} SbExportRequest;

// Adds the designs that a session draws beside its run, and its bookmarks.
void sb_export_request_beside(SbExportRequest *request, SbSession *session);

void sb_export_request_clear(SbExportRequest *request);

typedef struct SbExportJob SbExportJob;

// Starts it; takes over the texts of `request` and the reference `handle`. `done` is called once on
// the main thread unless the job was freed before. Owned by the caller.
SbExportJob *sb_export_job_start(SbRunHandle *handle, SbExportRequest *request,
                                 void (*done)(void *data), void *data);

// Share done, 0 to 1; a picture goes from 0 to 1 at once.
double sb_export_job_progress(SbExportJob *job);

// Seconds it will still take at the pace so far; negative as long as that cannot be said.
double sb_export_job_left(SbExportJob *job);

// Asks it to end; returns immediately. An MP4 keeps the pictures done so far, playable.
void sb_export_job_cancel(SbExportJob *job);

// Only after `done`: a sentence about the result, and whether it is a good one. Borrowed.
const char *sb_export_job_result(SbExportJob *job, gboolean *good);

// Cancels, waits, frees. Takes NULL.
void sb_export_job_free(SbExportJob *job);
