// Films: H.264 in MP4, and animations in WebP, APNG and GIF, which repeat without end. They are
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

enum { SB_MOVIE_SIZE_MIN = 16, SB_MOVIE_SIZE_MAX = 8192 };

typedef enum {
  SB_MOVIE_MP4,
  SB_MOVIE_WEBP,
  SB_MOVIE_APNG,
  SB_MOVIE_GIF,
  SB_MOVIE_FORMATS
} SbMovieFormat;

typedef struct {
  SbMovieFormat format; // all of the following options apply to each format, unless they name one
  int width, height;    // of the pictures; MP4 pads odd sizes by a repeated column or row
  int fps_num, fps_den; // frames per second; 0/0 counts as 30/1
  size_t frames;        // how many pictures
  const char *preset;   // MP4: libx264's; NULL: "veryfast"
  int quality;          // MP4: constant rate factor, 1 (best) to 51; 0: 18
  int threads;          // of the encoder; 0: one, which keeps up with the drawing
  bool bit_exact;       // the same bytes on every run (for tests); needs threads = 1
  const char *title;    // MP4: metadata; may be NULL
  const char *comment;  // metadata, such as models and errors; may be NULL
} SbMovieOptions;

// Draws picture `frame` into `pixels`: rows top down, cairo's ARGB32, `stride` bytes a row. Called
// in order on the thread of sb_movie_write(). A status other than SB_OK ends the film.
typedef SbStatus (*SbMovieDraw)(void *data, size_t frame, uint8_t *pixels, size_t stride,
                                SbReport *report);

// Both may be NULL; called on the thread of sb_movie_write() once per picture.
typedef struct {
  void (*progress)(void *data, size_t done, size_t total);
  bool (*cancelled)(void *data);
  void *data;
} SbMovieHooks;

// What became of it, and where the time went.
typedef struct {
  size_t frames;              // in the file
  bool partial;               // cancelled before the last one
  double wall_s, draw_s;      // this thread: all of it, drawing
  double convert_s, encode_s; // the encoder's thread
} SbMovieResult;

// Writes the film. SB_OK; SB_ERROR_CANCELLED (a partial MP4 is there if result->frames > 0);
// SB_ERROR_RANGE for an impossible size or rate; SB_ERROR_IO for a full disk or a missing encoder,
// with nothing new under `path` and an earlier file intact; or the drawing's own failure, likewise.
SbStatus sb_movie_write(const char *path, const SbMovieOptions *options, SbMovieDraw draw,
                        void *draw_data, const SbMovieHooks *hooks, SbMovieResult *result,
                        SbReport *report);

// Returns NULL, or the sentence that states why this build does not write films of a format;
// borrowed.
const char *sb_movie_missing(SbMovieFormat format);

// Returns the largest number of pictures per second of a format.
int sb_movie_fps_max(SbMovieFormat format);

// round(duration * fps), at least 1.
size_t sb_movie_frames(double duration, int fps_num, int fps_den);
