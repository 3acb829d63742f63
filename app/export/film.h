// The pictures of a film of a finished run, in order: which instant each shows, and its drawing.
// What becomes of them, a movie or files, is the caller's.
#pragma once

#include "app/export/movie.h"
#include "app/export/render.h"

// Which part of the run and how fast. Zeros and NULLs are the defaults.
typedef struct {
  double fps;         // pictures per second; 0 counts as 30
  double duration;    // of the film [s]; 0 counts as 10 unless there is a speed
  double speed;       // seconds of the run per second of film; 0: the duration decides
  const char *from;   // "B" or "2 s", see sb_render_frame_at(); NULL: the start
  const char *to;     // likewise; NULL: the end
  SbMovieHooks hooks; // progress and cancelling
} SbRenderMovie;

typedef struct SbFilm SbFilm;

// Prepares the film of `run`; everything is borrowed until sb_film_close(). Fails with
// SB_APP_ERROR_INPUT (unknown view, no frames, impossible range, rate or size).
bool sb_film_open(SbFilm **out, const SbRun *run, const SbRenderOptions *options,
                  const SbRenderMovie *movie, GError **error);

// NULL is allowed.
void sb_film_close(SbFilm *film);

// How many pictures, their size in pixels, and the rate as a fraction.
size_t sb_film_pictures(const SbFilm *film);
void sb_film_size(const SbFilm *film, int *width, int *height);
void sb_film_rate(const SbFilm *film, int *numerator, int *denominator);

// "Models: ...", for metadata; borrowed.
const char *sb_film_comment(const SbFilm *film);

// Draws picture `index` (below sb_film_pictures()) at the film's size.
void sb_film_draw(SbFilm *film, size_t index, cairo_t *cr);
