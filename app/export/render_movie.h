// A finished run as a film or animation, or as a sequence of PNG files.
#pragma once

#include "app/base/output.h"
#include "app/export/movie_pictures.h"

// Renders `run` into the film `path`, in the format of its ending (formats.h); sizes default to the
// view's own, `at`, `scale` and `scene` of the options are not used. SB_APP_ERROR_INPUT (unknown
// view, size, rate, range, no frames), SB_APP_ERROR_IO (an earlier file is intact),
// SB_APP_ERROR_CANCELLED (a playable part is there, flagged partial, if result->frames > 0, which
// only MP4 has). `result` may be NULL.
bool sb_render_movie(const SbRun *run, const SbRenderOptions *options, const SbRenderMovie *movie,
                     const char *path, SbMovieResult *result, GError **error);

// Whether `path` names a sequence: one number field such as %04d and the ending .png, or a folder
// (an existing one, or a name that ends with a slash), in which frame-%04d.png is meant.
bool sb_render_is_sequence(const char *path);

// Whether the files of such a sequence that are there already may be replaced (see
// sb_output_check()), and its folder written to.
bool sb_render_sequence_check(const char *path, SbOutputCheck *check, GError **error);

// Renders the pictures of a film, counted from 1, into files named by `path` (see above), each
// complete with the scene in it; a missing folder is made. Errors as for a film; pictures done
// before a failure or cancelling stay, result->frames of them. In a folder pictures of an earlier
// sequence beyond the last one go; `kept` (of char *, or NULL) gets the names of those that were
// changed since.
bool sb_render_sequence(const SbRun *run, const SbRenderOptions *options,
                        const SbRenderMovie *movie, const char *path, SbMovieResult *result,
                        GPtrArray *kept, GError **error);
