// One export of a finished run on a thread of its own: a picture, a movie, a sequence of pictures,
// a report, or the figures as JSON. All functions of this header run in the main thread.
#pragma once

#include "app/chart/data.h"
#include "app/data/measured.h"
#include "app/run/runner.h"
#include "app/section/painter.h"
#include "app/session/session.h"

#include <glib.h>

// What to export. Texts, `measured`, `pin`, `pin_name` and `marker` are owned by the struct; zero
// it, then fill it. NULL and 0: as the comment states, else none.
typedef struct {
  char *stale; // why the run no longer matches the values; NULL: it matches
  char *path;  // of a file, whose ending chooses the format (formats.h), or of a sequence as
               // sb_render_is_sequence() accepts it
  char *view;  // name of sb_render_views(); NULL: the report, whose .json has the figures
               // and any other ending the pages as PDF
  double width, height; // [logical pixels]; 0: the size of the view
  gboolean dark;        // theme
  SbSectionStyle style; // of views that show the section
  char *at;        // instant of a picture: "C" or "7.27 s"; NULL: the full run in a view that can
                   // show it, else the middle of B-C
  int fps;         // of a movie: pictures per second; 0: 30
  double duration; // of a movie: it shows the whole range in this time [s]; 0: 10
  double speed;    // of a movie: if above 0, seconds of the run per second of movie
  char *from, *to; // of a movie: "B" or "2 s"; NULL: the start and end of the run
  // Title of the scene, names of the files, SHA-256 of the parameters, and text of the scene, which
  // is stored in PNG and SVG so that they can be opened.
  char *title, *subtitle, *hash, *scene;
  SbData *measured;                // drawn together with the run; NULL: none
  double drive_speed;              // for `measured`: sb_session_drive_speed() [m/s]
  SbRunHandle *pin[SB_CHART_PINS]; // saved designs, by their look; NULL: none
  char *pin_name[SB_CHART_PINS];   // their names in pictures
  SbChartMarker *marker;           // bookmarks, [marker_count], owned with their names
  size_t marker_count;
  char *file;     // of a report or .json: the document's file; NULL: not saved
  char *document; // and its text if it differs from the file; NULL: it does not
} SbExportRequest;

// Adds the saved designs that a session draws together with its run, and its bookmarks, to a
// request that has none.
void sb_export_request_add_compared(SbExportRequest *request, SbSession *session);

typedef struct SbExportJob SbExportJob;

// Starts the export of the finished run `handle`. Takes over the reference `handle` and the content
// of `request`, which is zeroed. `done` is called once in the main thread when the export has ended
// (also after failure or cancellation), unless the job was freed before. Never NULL; freed by
// sb_export_job_free().
//
// sb_worker_progress() takes the job; the progress of a picture is 0 until it is finished. So does
// sb_worker_cancel(): an MP4 then keeps the pictures done so far and can be played; pictures of a
// sequence stay; a single picture is completed; animations, reports and .json are not written.
SbExportJob *sb_export_job_start(SbRunHandle *handle, SbExportRequest *request,
                                 void (*done)(void *data), void *data);

// Returns the estimated remaining time [s]; negative: there is no estimate yet.
double sb_export_job_left(SbExportJob *job);

// Only after `done`: returns a sentence about the result, translated; *good is set to whether the
// export succeeded. Borrowed from the job.
const char *sb_export_job_result(SbExportJob *job, gboolean *good);

// Cancels, waits for the thread and frees.
void sb_export_job_free(SbExportJob *job);
