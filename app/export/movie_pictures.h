// The pictures of a movie of a finished run, in order: which instant each shows, and its drawing.
// What becomes of them, a movie or files, is the caller's.
#pragma once

#include "app/export/movie.h"
#include "app/export/render.h"

// Which part of the run and how fast. Zeros and NULLs are the defaults.
typedef struct {
  double fps;         // pictures per second; 0 counts as 30
  double duration;    // of the movie [s]; 0 counts as 10 unless there is a speed
  double speed;       // seconds of the run per second of movie; 0: the duration decides
  const char *from;   // "B" or "2 s", see sb_render_frame_at(); NULL: the start
  const char *to;     // likewise; NULL: the end
  SbMovieHooks hooks; // progress and cancelling
} SbRenderMovie;

typedef struct SbMoviePictures SbMoviePictures;

// Prepares the movie of `run`; everything is borrowed until sb_movie_pictures_close(). Fails with
// SB_APP_ERROR_INPUT (unknown view, no frames, impossible range, rate or size).
bool sb_movie_pictures_open(SbMoviePictures **out, const SbRun *run, const SbRenderOptions *options,
                            const SbRenderMovie *movie, GError **error);

// NULL is allowed.
void sb_movie_pictures_close(SbMoviePictures *film);

// How many pictures, their size in pixels, and the rate as a fraction.
size_t sb_movie_pictures_count(const SbMoviePictures *film);
void sb_movie_pictures_size(const SbMoviePictures *film, int *width, int *height);
void sb_movie_pictures_rate(const SbMoviePictures *film, int *numerator, int *denominator);

// "Models: ...", for metadata; borrowed.
const char *sb_movie_pictures_comment(const SbMoviePictures *film);

// Draws picture `index` (below sb_movie_pictures_count()) at the movie's size.
void sb_movie_pictures_draw(SbMoviePictures *film, size_t index, cairo_t *cr);
