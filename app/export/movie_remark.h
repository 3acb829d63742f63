// Text about an animation in its file: libavformat writes metadata into MP4 only.
#pragma once

#include "app/export/movie.h"

// Adds `text` (UTF-8) to the finished file at `path`: as the chunk iTXt "Comment" of APNG (PNG 3,
// 11.3.3.4), as the description in a chunk "XMP " of WebP (RIFF container), or as a comment
// extension of GIF89a (24). A WebP of one picture has no place for it and stays as it is. Does
// nothing for MP4.
SbStatus sb_movie_remark(const char *path, SbMovieFormat format, const char *text,
                         SbReport *report);
