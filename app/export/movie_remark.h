// A comment in the file of an animation: libavformat writes metadata into MP4 only.
#pragma once

#include "app/export/movie.h"

// Adds `text` (UTF-8) to the finished file `path`: as the chunk iTXt "Comment" of APNG (PNG 3,
// 11.3.3.4), as the description in a chunk "XMP " of WebP (RIFF container), or as a comment
// extension of GIF89a (24). A WebP of one picture cannot have one and stays as it is; an MP4 also
// stays as it is. SB_ERROR_IO: the file could not be changed (it may be damaged).
SbStatus sb_movie_remark(const char *path, SbMovieFormat format, const char *text,
                         SbReport *report);
