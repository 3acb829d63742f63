// The pictures of a movie of a finished run, in order: which instant each shows, and its drawing.
// The caller writes them into a movie or into files.
#pragma once

#include "app/export/movie.h"
#include "app/export/render.h"

// Which part of the run and how fast. Zeros and NULLs are the defaults.
typedef struct {
  double fps;         // pictures per second, 0.1 to 1000; 0: 30
  double duration;    // of the movie [s]; 0: 10; ignored if `speed` is above 0
  double speed;       // seconds of the run per second of movie; 0: by `duration`
  const char *from;   // "B" or "2 s", see sb_render_frame_at(); NULL: the start
  const char *to;     // in the same form; NULL: the end
  SbMovieHooks hooks; // progress and cancelling, for the caller that writes the pictures
} SbRenderMovie;

typedef struct SbMoviePictures SbMoviePictures;

// Prepares the movie of `run`. `run`, `options` and what they point to are borrowed until
// sb_movie_pictures_close(); `movie` is only read. Fails with SB_APP_ERROR_INPUT (unknown view, a
// view that the run has not, no frames, impossible range or rate, more than a million pictures).
bool sb_movie_pictures_open(SbMoviePictures **out, const SbRun *run, const SbRenderOptions *options,
                            const SbRenderMovie *movie, GError **error);

// Frees it. Takes NULL.
void sb_movie_pictures_close(SbMoviePictures *film);

// Returns the number of pictures, at least 1.
size_t sb_movie_pictures_count(const SbMoviePictures *film);

// Sets the size of each picture [pixels].
void sb_movie_pictures_size(const SbMoviePictures *film, int *width, int *height);

// Sets the pictures per second as a fraction.
void sb_movie_pictures_rate(const SbMoviePictures *film, int *numerator, int *denominator);

// Returns "Models: ... Parameters: HASH", for metadata; borrowed from `film`.
const char *sb_movie_pictures_comment(const SbMoviePictures *film);

// Draws picture `index` (from 0, below sb_movie_pictures_count()) from (0, 0) to the size of
// sb_movie_pictures_size(), in units of `cr`. It shows the frame nearest to its time; the first
// picture is the start of the range, the last one its end.
void sb_movie_pictures_draw(SbMoviePictures *film, size_t index, cairo_t *cr);
