// Stands for movie_encoder.c in a build without libav: opening fails with a sentence.
#include "app/export/movie_encoder.h"

struct SbMovieEncoder {
  int unused;
};

const char *sb_movie_missing(SbMovieFormat format) {
  return "this build of Sealbench writes no movies (Meson's option `video`): write "
         "frames/%04d.png, a sequence of pictures";
}

SbStatus sb_movie_encoder_open(SbMovieEncoder **out, const char *path,
                               const SbMovieOptions *options, SbReport *report) {
  *out = NULL;
  return sb_fail(report, SB_ERROR_INPUT, "%s", sb_movie_missing(options->format));
}

SbStatus sb_movie_encoder_add(SbMovieEncoder *encoder, const uint8_t *pixels, size_t stride,
                              double *convert_s, double *encode_s, SbReport *report) {
  return sb_fail(report, SB_ERROR_INPUT, "%s", sb_movie_missing(SB_MOVIE_MP4));
}

SbStatus sb_movie_encoder_finish(SbMovieEncoder *encoder, const char *comment, SbReport *report) {
  return sb_fail(report, SB_ERROR_INPUT, "%s", sb_movie_missing(SB_MOVIE_MP4));
}

void sb_movie_encoder_destroy(SbMovieEncoder *encoder) {}
