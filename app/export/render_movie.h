// A finished run as a film: the whole cycle of any view in a given time, H.264 in MP4.
#pragma once

#include "app/export/movie.h"
#include "app/export/render.h"

typedef struct {
  double fps;      // pictures per second; 0 counts as 30
  double duration; // of the film, in which the whole cycle is shown [s]; 0 counts as 10
  SbMovieHooks hooks;
} SbRenderMovie;

// Renders `run` into the MP4 file `path`; sizes default to the view's own, `at`, `scale` and
// `scene` of the options are not used. SB_APP_ERROR_INPUT (unknown view, size, rate, no frames),
// SB_APP_ERROR_IO (an earlier file is intact), SB_APP_ERROR_CANCELLED (a playable part is there,
// flagged partial, if result->frames > 0). `result` may be NULL.
bool sb_render_movie(const SbRun *run, const SbRenderOptions *options, const SbRenderMovie *movie,
                     const char *path, SbMovieResult *result, GError **error);
