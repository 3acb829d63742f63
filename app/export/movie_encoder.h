// The encoder and its file: pictures in, a film out. One thread at a time.
#pragma once

#include "app/export/movie.h"

typedef struct SbMovieEncoder SbMovieEncoder;

// Opens the encoder and writes the header to `path` (a temporary name).
SbStatus sb_movie_encoder_open(SbMovieEncoder **out, const char *path,
                               const SbMovieOptions *options, SbReport *report);

// Adds the next picture; adds the time of conversion and encoding to *convert_s and *encode_s.
SbStatus sb_movie_encoder_add(SbMovieEncoder *encoder, const uint8_t *pixels, size_t stride,
                              double *convert_s, double *encode_s, SbReport *report);

// Flushes the encoder and writes the index, `comment` (may be NULL) among it, then closes the file.
SbStatus sb_movie_encoder_finish(SbMovieEncoder *encoder, const char *comment, SbReport *report);

// Frees it, whatever its state. NULL is allowed.
void sb_movie_encoder_destroy(SbMovieEncoder *encoder);
