// The encoder of a movie and its file. For movie.c: open, add each picture, finish, destroy. One
// thread at a time. A build without libav has movie_encoder_off.c instead, whose functions fail
// with SB_ERROR_INPUT.
#pragma once

#include "app/export/movie.h"

typedef struct SbMovieEncoder SbMovieEncoder;

// Opens the encoder and writes the header to the file `path` (created or overwritten; a temporary
// name). `options` are checked by the caller and borrowed. SB_ERROR_IO: the file, or a missing
// encoder.
SbStatus sb_movie_encoder_open(SbMovieEncoder **out, const char *path,
                               const SbMovieOptions *options, SbReport *report);

// Adds the next picture (`pixels` [height][stride]: rows from the top, cairo's ARGB32, `stride`
// bytes each). Adds the times of conversion and encoding [s] to *convert_s and *encode_s.
// SB_ERROR_IO: encoding or writing failed.
SbStatus sb_movie_encoder_add(SbMovieEncoder *encoder, const uint8_t *pixels, size_t stride,
                              double *convert_s, double *encode_s, SbReport *report);

// Writes the remaining pictures and the index with `comment` (may be NULL), and closes the file.
// SB_ERROR_IO: encoding or writing failed.
SbStatus sb_movie_encoder_finish(SbMovieEncoder *encoder, const char *comment, SbReport *report);

// Frees the encoder and closes its file in any state; the file itself stays.
void sb_movie_encoder_destroy(SbMovieEncoder *encoder);
