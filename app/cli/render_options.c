// The options of `sealbench render`: what they request, and which do not combine.
#include "app/cli/render_private.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

// "1280x720", or a size with a name.
static bool parse_size(double *width, double *height, const char *text) {
  size_t count;
  const SbRenderSize *sizes = sb_render_sizes(&count);
  for (size_t i = 0; i < count; i++) {
    if (g_ascii_strcasecmp(text, sizes[i].name) == 0) {
      *width = sizes[i].width;
      *height = sizes[i].height;
      return true;
    }
  }
  char *end = NULL;
  long w = strtol(text, &end, 10);
  bool good = end != text && *end == 'x' && g_ascii_isdigit(end[1]);
  long h = good ? strtol(end + 1, &end, 10) : 0;
  if (!good || *end != '\0' || w < 1 || h < 1 || w > 100000 || h > 100000) {
    sb_cli_fail("--size: \"%s\" is not WIDTHxHEIGHT, 720p, 1080p, 4k or report", text);
    return false;
  }
  *width = (double)w;
  *height = (double)h;
  return true;
}

// The film's own options.
static bool parse_film(SbRenderRequest *request, const SbRenderArguments *options) {
  SbRenderMovie *movie = &request->movie;
  bool moves = request->film || request->sequence;
  if (moves && options->at != NULL) {
    sb_cli_fail("--at: a movie shows the full cycle (--from and --to select a part)");
    return false;
  }
  if (!moves && (options->fps != NULL || options->duration != NULL || options->speed != NULL ||
                 options->from != NULL || options->to != NULL)) {
    g_autofree char *films = sb_export_endings(1 << SB_FORMAT_FILM, 0, ", ", " or ");
    sb_cli_fail("--fps, --duration, --speed, --from and --to are for movies (%s) and sequences",
                films);
    return false;
  }
  if (options->duration != NULL && options->speed != NULL) {
    sb_cli_fail("--duration and --speed exclude each other");
    return false;
  }
  movie->fps = 30;
  movie->duration = 10;
  movie->speed = 1;
  if (!sb_cli_quantity(&movie->fps, "--fps", options->fps, false, "1", "") ||
      !sb_cli_quantity(&movie->duration, "--duration", options->duration, false, "s", "s") ||
      !sb_cli_quantity(&movie->speed, "--speed", options->speed, false, "1", "")) {
    return false;
  }
  if (!(movie->fps > 0 && movie->duration > 0 && movie->speed > 0)) {
    sb_cli_fail("--fps, --duration and --speed must be positive");
    return false;
  }
  const int most = request->film ? sb_movie_fps_max(request->format->film) : INT_MAX;
  if (movie->fps > most) {
    sb_cli_fail("--fps: %g is too fast for %s (allowed at most %d)", movie->fps,
                request->format->ending, most);
    return false;
  }
  if (options->speed == NULL) {
    movie->speed = 0;
  }
  movie->from = options->from;
  movie->to = options->to;
  return true;
}

// Whether -o and --format go together for `files` files.
static bool check_target(const SbRenderArguments *options, int files) {
  const bool stream = strcmp(options->output, "-") == 0;
  g_autofree char *names = sb_export_endings(SB_FORMAT_ALL, 1, ", ", " or ");
  if (files > 1) {
    const bool named = stream || sb_export_format(options->output) != NULL;
    if (named && !g_file_test(options->output, G_FILE_TEST_IS_DIR)) {
      sb_cli_fail("-o: %s: %d files need a folder; --format chooses %s", options->output, files,
                  names);
      return false;
    }
  } else if (stream && options->format == NULL) {
    sb_cli_fail("--format is missing: -o - needs %s", names);
    return false;
  } else if (!stream && options->format != NULL) {
    sb_cli_fail("--format is for -o - and for several files; the ending of a file chooses it");
    return false;
  }
  return true;
}

// Where the bytes go, of `files` files, and their format.
static bool parse_output(SbRenderRequest *request, const SbRenderArguments *options, int files) {
  if (!check_target(options, files)) {
    return false;
  }
  const bool stream = strcmp(options->output, "-") == 0;
  const SbExportFormat *format = sb_export_format(options->output);
  if (stream || files > 1) {
    g_autofree char *ending =
        g_strconcat(".", options->format != NULL ? options->format : "png", NULL);
    format = sb_export_format(ending);
    if (format == NULL || strlen(format->ending) != strlen(ending)) {
      g_autofree char *names = sb_export_endings(SB_FORMAT_ALL, 1, "|", "|");
      sb_cli_unknown("--format: there is no", options->format, names, NULL);
      return false;
    }
    request->how.ending = stream ? format->ending : NULL;
    request->name = files > 1 ? g_strconcat(request->how.view, format->ending, NULL) : NULL;
  } else {
    request->sequence = sb_render_is_sequence(options->output);
  }
  if (format == NULL && !request->sequence) {
    g_autofree char *endings = sb_export_endings(SB_FORMAT_ALL, 0, ", ", " or ");
    sb_cli_fail("-o: %s: the ending must be %s", options->output, endings);
    return false;
  }
  request->format = request->sequence ? NULL : format;
  request->film = !request->sequence && format->kind == SB_FORMAT_FILM;
  request->vector = !request->sequence && format->kind == SB_FORMAT_DRAWING;
  const char *missing = request->film ? sb_movie_missing(format->film) : NULL;
  if (missing != NULL) {
    sb_cli_fail("-o: %s: %s", format->ending, missing);
    return false;
  }
  return true;
}

static void refuse_view(const char *view) {
  size_t count;
  const SbRenderView *views = sb_render_views(&count);
  g_autoptr(GString) names = g_string_new(views[0].name);
  for (size_t i = 1; i < count + SB_STUDY_COUNT; i++) {
    g_string_append_printf(names, "|%s",
                           i < count ? views[i].name : sb_study_name((SbStudyKind)(i - count)));
  }
  sb_cli_unknown("--view: there is no view", view, names->str, "see sealbench list views");
}

bool sb_render_parse(SbRenderRequest *request, const SbRenderArguments *options, int files) {
  SbRenderOptions *how = &request->how;
  if (options->output == NULL) {
    sb_cli_fail("-o is missing: the picture or movie to write");
    return false;
  }
  how->view = options->view != NULL ? options->view : "section";
  how->dark = options->dark;
  how->at = options->at;
  request->is_study = sb_study_from_name(&request->study, how->view);
  if (!request->is_study && sb_render_view(how->view) == NULL) {
    refuse_view(how->view);
    return false;
  }
  if (options->size != NULL && !parse_size(&how->width, &how->height, options->size)) {
    return false;
  }
  if (!parse_output(request, options, files)) {
    return false;
  }
  if (request->is_study && (request->film || request->sequence)) {
    g_autofree char *stills =
        sb_export_endings(1 << SB_FORMAT_PICTURE | 1 << SB_FORMAT_DRAWING, 0, ", ", " or ");
    sb_cli_fail("--view %s is a study, which does not move: write a %s", how->view, stills);
    return false;
  }
  if (options->at != NULL && options->at[0] == '\0') {
    sb_cli_fail("--at: neither a stage (A to F) nor a time");
    return false;
  }
  if (request->is_study && options->at != NULL) {
    sb_cli_fail("--at: a study has no time");
    return false;
  }
  if (!parse_film(request, options)) {
    return false;
  }
  if (options->zoom != NULL) {
    bool inner = strcmp(options->zoom, "inner") == 0;
    if (!inner && strcmp(options->zoom, "outer") != 0) {
      sb_cli_unknown("--zoom: there is no seal", options->zoom, "outer|inner", NULL);
      return false;
    }
    request->zoom = inner ? SB_SECTION_ZOOM_INNER : SB_SECTION_ZOOM_OUTER;
  }
  int backend = options->backend != NULL ? sb_gl_backend_find(options->backend) : SB_GL_AUTO;
  if (backend < 0) {
    sb_cli_unknown("--backend: there is no back end", options->backend, "osmesa|egl", NULL);
    return false;
  }
  request->backend = (SbGlBackend)backend;
  return true;
}
