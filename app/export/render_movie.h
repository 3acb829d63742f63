// A finished run as a movie or animation, or as a sequence of PNG files.
#pragma once

#include "app/base/output.h"
#include "app/export/movie_pictures.h"

// Renders `run` into the movie `path`, in the format of its ending (formats.h) or of
// options->ending. `at`, `scale` and `scene` of the options are not used. `result` may be NULL.
// Returns false with SB_APP_ERROR_INPUT (unknown view, size, rate, range, no frames);
// SB_APP_ERROR_IO (an earlier file is intact); SB_APP_ERROR_CANCELLED (a playable part, marked as
// partial, is there if result->frames > 0, which only MP4 has).
bool sb_render_movie(const SbRun *run, const SbRenderOptions *options, const SbRenderMovie *movie,
                     const char *path, SbMovieResult *result, GError **error);

// Returns whether `path` names a sequence: a file name with one number field such as %04d and the
// ending .png, or a folder (an existing one, or a name that ends with a slash), in which
// frame-%04d.png is meant.
bool sb_render_is_sequence(const char *path);

// Returns whether the existing files of the sequence `path` may be replaced and its folder can be
// written to. Returns false with SB_APP_ERROR_INPUT if one of them is an input or was checked
// before, SB_APP_ERROR_IO if the folder is not writable. Adds the first file to `check`
// (app/base/output.h), which the caller frees by sb_output_check_clear().
bool sb_render_sequence_check(const char *path, SbOutputCheck *check, GError **error);

// Renders the pictures of a movie, numbered from 1, into the files of the sequence `path`; each is
// a complete PNG that contains the scene. A missing folder is created. Returns false as
// sb_render_movie(); the pictures before a failure or cancellation stay, result->frames of them. If
// `path` is a folder, pictures of an earlier sequence that this one does not have are deleted; the
// names (char *) of those that were changed since are appended to `kept`, and they stay. `kept` and
// `result` may be NULL.
bool sb_render_sequence(const SbRun *run, const SbRenderOptions *options,
                        const SbRenderMovie *movie, const char *path, SbMovieResult *result,
                        GPtrArray *kept, GError **error);
