// Hands a film's pictures to the movie writer.
#include "app/export/render_movie.h"

#include "app/export/formats.h"

#include <string.h>

static SbStatus draw_movie(void *data, size_t picture, uint8_t *pixels, size_t stride,
                           SbReport *report) {
  SbMoviePictures *film = data;
  int width;
  int height;
  sb_movie_pictures_size(film, &width, &height);
  cairo_surface_t *surface =
      cairo_image_surface_create_for_data(pixels, CAIRO_FORMAT_ARGB32, width, height, (int)stride);
  cairo_t *cr = cairo_create(surface);
  sb_movie_pictures_draw(film, picture, cr);
  cairo_status_t status = cairo_status(cr);
  cairo_destroy(cr);
  cairo_surface_flush(surface);
  cairo_surface_destroy(surface);
  return status == CAIRO_STATUS_SUCCESS
             ? SB_OK
             : sb_fail(report, SB_ERROR_MEMORY, "drawing: %s", cairo_status_to_string(status));
}

bool sb_render_movie(const SbRun *run, const SbRenderOptions *options, const SbRenderMovie *movie,
                     const char *path, SbMovieResult *result, GError **error) {
  SbMoviePictures *film;
  if (!sb_movie_pictures_open(&film, run, options, movie, error)) {
    return false;
  }
  const SbExportFormat *format = sb_export_format(options->ending != NULL ? options->ending : path);
  SbMovieOptions how = {.format = format != NULL ? format->film : SB_MOVIE_MP4,
                        .frames = sb_movie_pictures_count(film),
                        .title = options->title,
                        .comment = sb_movie_pictures_comment(film)};
  sb_movie_pictures_size(film, &how.width, &how.height);
  sb_movie_pictures_rate(film, &how.fps_num, &how.fps_den);
  SbReport report = {0};
  SbMovieResult own = {0};
  SbStatus status = sb_movie_write(path, &how, draw_movie, film, &movie->hooks, &own, &report);
  if (result != NULL) {
    *result = own;
  }
  sb_movie_pictures_close(film);
  if (status == SB_OK) {
    return true;
  }
  SbAppError code = status == SB_ERROR_CANCELLED                           ? SB_APP_ERROR_CANCELLED
                    : status == SB_ERROR_RANGE || status == SB_ERROR_INPUT ? SB_APP_ERROR_INPUT
                                                                           : SB_APP_ERROR_IO;
  const char *text = report.text[0] != '\0' ? report.text : sb_status_text(status);
  bool named = code != SB_APP_ERROR_IO || strstr(text, path) != NULL;
  g_set_error(error, SB_APP_ERROR, code, "%s%s%s", named ? "" : path, named ? "" : ": ", text);
  return false;
}
