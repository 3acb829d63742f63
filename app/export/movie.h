// Movies: H.264 in MP4, and animations in WebP, APNG and GIF, which repeat without end. They are
// encoded in this process while the next pictures are drawn.
//
// A caller's function draws picture after picture; a thread of the movie's own converts (for MP4 to
// yuv420p by BT.709, limited range, tagged so) and encodes (libavcodec). The file appears under its
// name only when it is complete: it is written with a temporary name and renamed. A cancelled MP4
// keeps the pictures done so far, playable, with "partial" in its comment. A cancelled
// animation is removed: a page that shows it would not state that it is partial.
#pragma once

#include "engine/base/status.h"

#include <stddef.h>
#include <stdint.h>

// Smallest and largest side of a movie [pixels].
enum { SB_MOVIE_SIZE_MIN = 16, SB_MOVIE_SIZE_MAX = 8192 };

// The formats.
typedef enum {
  SB_MOVIE_MP4,
  SB_MOVIE_WEBP,
  SB_MOVIE_APNG,
  SB_MOVIE_GIF,
  SB_MOVIE_FORMATS
} SbMovieFormat;

// How a movie is written. Strings are only read during sb_movie_write(). Options without a format's
// name apply to every format.
typedef struct {
  SbMovieFormat format;
  int width, height;    // of the pictures [pixels]; MP4 pads odd sizes by a repeated column or row
  int fps_num, fps_den; // pictures per second, as a fraction; 0/0: 30/1
  size_t frames;        // number of pictures, at least 1
  const char *preset;   // MP4: libx264's; NULL: "veryfast"
  int quality;          // MP4: constant rate factor, 1 (best) to 51; 0: 18
  int threads;          // of the encoder; 0: one, which keeps up with the drawing
  bool bit_exact;       // the same bytes on every run (for tests); needs threads = 1
  const char *title;    // MP4: metadata; NULL: none
  const char *comment;  // metadata, such as models and errors; NULL: none
} SbMovieOptions;

// Draws picture `frame` (from 0) into `pixels` [height][stride]: rows from the top, cairo's ARGB32,
// `stride` bytes each. Called in order in the thread of sb_movie_write(). Any status other than
// SB_OK ends the movie with that status.
typedef SbStatus (*SbMovieDraw)(void *data, size_t frame, uint8_t *pixels, size_t stride,
                                SbReport *report);

// Callbacks in the thread of sb_movie_write(), once per picture; each may be NULL.
typedef struct {
  void (*progress)(void *data, size_t done, size_t total); // `done` pictures are drawn
  bool (*cancelled)(void *data);                           // returns true to cancel
  void *data;
} SbMovieHooks;

// The result and the time it took.
typedef struct {
  size_t frames;              // pictures in the file; 0: there is no file
  bool partial;               // cancelled before the last one
  double wall_s, draw_s;      // the calling thread: all, drawing [s]
  double convert_s, encode_s; // the encoder's thread [s]
} SbMovieResult;

// Draws and writes the movie `path`. Returns SB_OK; SB_ERROR_CANCELLED (a partial MP4 is there if
// result->frames > 0); SB_ERROR_RANGE for an impossible size, rate or number of pictures;
// SB_ERROR_IO for a path that cannot be written, a full disk or a missing encoder (SB_ERROR_INPUT
// in a build without movies); or the status of `draw`. After an error other than cancellation
// nothing new is under `path` and an earlier file is intact. `hooks` and `result` may be NULL.
SbStatus sb_movie_write(const char *path, const SbMovieOptions *options, SbMovieDraw draw,
                        void *draw_data, const SbMovieHooks *hooks, SbMovieResult *result,
                        SbReport *report);

// Returns NULL if this build can write movies of `format`, else a sentence that states why not;
// static. May be called from any thread.
const char *sb_movie_missing(SbMovieFormat format);

// Returns the largest number of pictures per second of a format.
int sb_movie_fps_max(SbMovieFormat format);

// Returns the number of pictures of `duration` seconds: round(duration * fps_num / fps_den), at
// least 1, at most 1e9.
size_t sb_movie_frames(double duration, int fps_num, int fps_den);
