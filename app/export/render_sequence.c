// Hands a film's pictures to the writer of stills, one file each. Every file is written whole or
// not at all and carries the scene, so that any of them can be opened.
#include "app/export/render_movie.h"

#include "app/export/still.h"

#include <errno.h>
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
  return is_folder(path) || (g_str_has_suffix(path, ".png") && field_of(path, &at, &digits, &rest));
}

typedef struct {
  SbFilm *film;
  size_t index;
} Picture;

static void draw(cairo_t *cr, double width, double height, void *user) {
  const Picture *picture = user;
  sb_film_draw(picture->film, picture->index, cr);
}

// One file after the other.
static bool write_all(SbFilm *film, const SbRenderOptions *options, const SbMovieHooks *hooks,
                      const char *pattern, SbMovieResult *result, GError **error) {
  size_t at;
  int digits;
  const char *rest;
  if (!field_of(pattern, &at, &digits, &rest)) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s has no number field", pattern);
    return false;
  }
  size_t total = sb_film_pictures(film);
  int width;
  int height;
  sb_film_size(film, &width, &height);
  Picture picture = {film, 0};
  SbStill still = {.width = width,
                   .height = height,
                   .title = options->title,
                   .scene = options->scene,
                   .hash = options->hash,
                   .comment = sb_film_comment(film),
                   .draw = draw,
                   .user = &picture};
  for (size_t i = 0; i < total; i++) {
    if (hooks->cancelled != NULL && hooks->cancelled(hooks->data)) {
      result->partial = true;
      g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_CANCELLED,
                  "cancelled after %zu of %zu pictures", i, total);
      return false;
    }
    picture.index = i;
    char *path = g_strdup_printf("%.*s%0*zu%s", (int)at, pattern, digits, i + 1, rest);
    bool good = sb_still_write(&still, path, error);
    g_free(path);
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
                        GError **error) {
  SbMovieResult own = {0};
  SbFilm *film;
  if (!sb_film_open(&film, run, options, movie, error)) {
    return false;
  }
  char *pattern = is_folder(path) ? g_build_filename(path, "frame-%04d.png", NULL) : g_strdup(path);
  char *folder = g_path_get_dirname(pattern);
  bool good = true;
  if (strchr(folder, '%') != NULL) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "%s: the number field belongs into the file's name", path);
    good = false;
  } else if (g_mkdir_with_parents(folder, 0777) != 0) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "%s: %s", folder, g_strerror(errno));
    good = false;
  } else {
    gint64 begin = g_get_monotonic_time();
    good = write_all(film, options, &movie->hooks, pattern, &own, error);
    own.wall_s = 1e-6 * (double)(g_get_monotonic_time() - begin);
  }
  if (result != NULL) {
    *result = own;
  }
  g_free(folder);
  g_free(pattern);
  sb_film_close(film);
  return good;
}
