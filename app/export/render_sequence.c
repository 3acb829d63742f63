// Hands a film's pictures to the writer of stills, one file each. Every file is written whole or
// not at all and carries the scene, so that any of them can be opened.
#include "app/export/render_movie.h"

#include "app/base/output.h"
#include "app/export/still.h"

#include <string.h>

// Splits "a%04db" at its number field: the digits it asks for and what follows. False if the text
// holds no field, several, or any other use of %.
static bool field_of(const char *path, size_t *at, int *digits, const char **rest) {
  const char *percent = strchr(path, '%');
  if (percent == NULL || strrchr(path, '%') != percent) {
    return false;
  }
  const char *p = percent + 1;
  int n = 0;
  while (g_ascii_isdigit(*p) && n < 100) {
    n = 10 * n + (*p - '0');
    p++;
  }
  if (*p != 'd' || n > 12) {
    return false;
  }
  *at = (size_t)(percent - path);
  *digits = n;
  *rest = p + 1;
  return true;
}

static bool is_folder(const char *path) {
  return g_str_has_suffix(path, G_DIR_SEPARATOR_S) || g_file_test(path, G_FILE_TEST_IS_DIR);
}

bool sb_render_is_sequence(const char *path) {
  size_t at;
  int digits;
  const char *rest;
  return is_folder(path) ||
         (sb_output_ends_in(path, ".png") && field_of(path, &at, &digits, &rest));
}

// The folder and the pattern of names in it; both owned by the caller. True if the user gave the
// names.
static bool split(const char *path, char **folder, char **pattern) {
  bool named = !is_folder(path);
  *folder = named ? g_path_get_dirname(path) : g_strdup(path);
  *pattern = named ? g_path_get_basename(path) : g_strdup("frame-%04d.png");
  return named;
}

bool sb_render_sequence_check(const char *path, SbOutputCheck *check, GError **error) {
  g_autofree char *folder = NULL;
  g_autofree char *pattern = NULL;
  split(path, &folder, &pattern);
  size_t at;
  int digits;
  const char *rest;
  if (!field_of(pattern, &at, &digits, &rest)) {
    return true; // said later
  }
  g_autofree char *first =
      g_strdup_printf("%s/%.*s%0*d%s", folder, (int)at, pattern, digits, 1, rest);
  bool good = sb_output_check(check, first, true, error);
  GDir *dir = g_dir_open(folder, 0, NULL);
  const char *name;
  while (good && dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
    size_t count = strncmp(name, pattern, at) == 0 ? strspn(name + at, "0123456789") : 0;
    if (count > 0 && strcmp(name + at + count, rest) == 0) {
      g_autofree char *file = g_build_filename(folder, name, NULL);
      SbOutputCheck each = {0};
      good = sb_output_check(&each, file, true, error);
      sb_output_check_clear(&each);
    }
  }
  if (dir != NULL) {
    g_dir_close(dir);
  }
  return good;
}

typedef struct {
  SbMoviePictures *film;
  size_t index;
} Picture;

static void draw_sequence(cairo_t *cr, double width, double height, void *user) {
  const Picture *picture = user;
  sb_movie_pictures_draw(picture->film, picture->index, cr);
}

// One picture into the folder.
static bool write_one(SbOutputFolder *folder, const SbStill *still, const char *name,
                      GError **error) {
  FILE *stream;
  if (!sb_output_folder_add(&stream, folder, name, error)) {
    return false;
  }
  // What a full stream stopped is the file's failure; committing finds its reason.
  if (!sb_still_put(stream, still, name, error) && ferror(stream) == 0) {
    return false;
  }
  g_clear_error(error);
  return sb_output_folder_commit(folder, error);
}

// One file after the other; names are made by `pattern`.
static bool write_all(SbOutputFolder *folder, SbMoviePictures *film, const SbRenderOptions *options,
                      const SbMovieHooks *hooks, const char *pattern, SbMovieResult *result,
                      GError **error) {
  size_t at;
  int digits;
  const char *rest;
  if (!field_of(pattern, &at, &digits, &rest)) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s has no number field", pattern);
    return false;
  }
  size_t total = sb_movie_pictures_count(film);
  int width;
  int height;
  sb_movie_pictures_size(film, &width, &height);
  Picture picture = {film, 0};
  SbStill still = {.width = width,
                   .height = height,
                   .title = options->title,
                   .scene = options->scene,
                   .hash = options->hash,
                   .comment = sb_movie_pictures_comment(film),
                   .draw = draw_sequence,
                   .user = &picture};
  for (size_t i = 0; i < total; i++) {
    if (hooks->cancelled != NULL && hooks->cancelled(hooks->data)) {
      result->partial = true;
      g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_CANCELLED,
                  "cancelled after %zu of %zu pictures", i, total);
      return false;
    }
    picture.index = i;
    g_autofree char *name = g_strdup_printf("%.*s%0*zu%s", (int)at, pattern, digits, i + 1, rest);
    bool good = write_one(folder, &still, name, error);
    if (!good) {
      return false;
    }
    result->frames = i + 1;
    if (hooks->progress != NULL) {
      hooks->progress(hooks->data, i + 1, total);
    }
  }
  return true;
}

bool sb_render_sequence(const SbRun *run, const SbRenderOptions *options,
                        const SbRenderMovie *movie, const char *path, SbMovieResult *result,
                        GPtrArray *kept, GError **error) {
  SbMovieResult own = {0};
  SbMoviePictures *film;
  if (!sb_movie_pictures_open(&film, run, options, movie, error)) {
    return false;
  }
  char *pattern;
  char *in;
  // Only names that are the program's own are remembered (see output.h).
  bool named = split(path, &in, &pattern);
  SbOutputFolder *folder = NULL;
  bool good = false;
  if (named && strchr(in, '%') != NULL) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "%s: the number field belongs into the file's name", path);
  } else if (sb_output_folder_open(&folder, in, named ? NULL : "render", error)) {
    gint64 begin = g_get_monotonic_time();
    good = write_all(folder, film, options, &movie->hooks, pattern, &own, error);
    own.wall_s = 1e-6 * (double)(g_get_monotonic_time() - begin);
  }
  // A sequence cut short by its user is a result of its own, one that failed is none.
  if (good) {
    good = sb_output_folder_finish(folder, kept, error);
  } else if (own.partial) {
    sb_output_folder_finish(folder, kept, NULL);
  }
  sb_output_folder_close(folder);
  if (result != NULL) {
    *result = own;
  }
  g_free(in);
  g_free(pattern);
  sb_movie_pictures_close(film);
  return good;
}
