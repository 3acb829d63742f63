// sealbench render: a view of a scene as a picture, a film or a sequence of pictures.
#include "app/cli/cli.h"

#include "app/base/output.h"
#include "app/export/formats.h"
#include "app/export/render_movie.h"
#include "app/export/studies.h"
#include "app/section/painter.h"
#include "app/session/pin_names.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// The options as they were given; texts are owned.
typedef struct {
  char *output, *format, *view, *size, *at, *fps, *duration, *speed, *from, *to, *backend;
  char *field, *field_max, *insets, *zoom, *azimuth, *elevation, *measured;
  char **settings;
  gboolean dark, full, undeformed, no_pins;
} Options;

// What they mean.
typedef struct {
  SbRenderOptions how;
  SbRenderMovie movie;
  SbSectionZoom zoom;
  SbGlBackend backend;
  const SbExportFormat *format; // NULL: a sequence
  const Options *options;
  bool film, sequence, vector, is_study;
  SbStudyKind study;
  char *name; // of a picture in its file's folder: "section.png"; NULL: -o names it
} Request;

// The runs of kept designs, drawn beside the file's.
typedef struct {
  SbRun *run[SB_CHART_PINS];
  char *name[SB_CHART_PINS];
} Pins;

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
static bool parse_film(Request *request, const Options *options) {
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
static bool check_target(const Options *options, int files) {
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
static bool parse_output(Request *request, const Options *options, int files) {
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

static bool parse(Request *request, const Options *options, int files) {
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

// --set, and behind it the options that are short for a key. Free with g_strfreev().
static char **all_settings(const Options *options) {
  GPtrArray *all = g_ptr_array_new();
  for (char **p = options->settings; p != NULL && *p != NULL; p++) {
    g_ptr_array_add(all, g_strdup(*p));
  }
  const struct {
    const char *key, *value;
  } keys[] = {
      {"output.field", options->field},
      {"output.field_max", options->field_max},
      {"output.insets", options->insets},
      {"output.azimuth", options->azimuth},
      {"output.elevation", options->elevation},
      {"output.section", options->full ? "full" : NULL},
      {"output.undeformed", options->undeformed ? "shown" : NULL},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(keys); i++) {
    if (keys[i].value != NULL) {
      g_ptr_array_add(all, g_strdup_printf("%s=%s", keys[i].key, keys[i].value));
    }
  }
  g_ptr_array_add(all, NULL);
  return (char **)g_ptr_array_free(all, FALSE);
}

static void on_picture(void *data, size_t done, size_t total) {
  sb_progress_update(data, (double)done / (double)total);
}

// Runs what the view needs. An engine's status; `*run` may hold a partial run.
static SbStatus compute(SbRun **run, const SbModel *model, const SbRenderView *view,
                        SbReport *report) {
  // What is drawn decides what is computed, not what the scene would show by itself.
  const SbPlanWishes wishes = {.views = view->computes,
                               .studies = (unsigned)sb_model_number(model, SB_P_OUTPUT_STUDIES),
                               .life = true};
  SbPlan plan;
  sb_plan_wished(&plan, model, &wishes);
  return sb_cli_compute(run, model, &plan, "computing ", report);
}

// Computes the first saved designs if the view shows them, and prints a note on those that it
// omits. A design that cannot be computed is reported and omitted. Returns an exit code.
static int compute_pins(Pins *pins, const SbDocument *document, Request *request) {
  const size_t count = sb_document_pin_count(document);
  SbRenderOptions *how = &request->how;
  g_autoptr(GPtrArray) issues = sb_issues_new();
  int code = SB_EXIT_DONE;
  for (size_t i = 0; i < count && i < SB_CHART_PINS && !sb_cli_interrupted(NULL); i++) {
    g_autoptr(SbModel) model = NULL;
    SbReport report = {0};
    if (!sb_document_compile_pin(document, i, &model, issues)) {
      code = SB_EXIT_INPUT;
      continue;
    }
    pins->name[i] = sb_pin_name(document, i);
    const SbStatus status = compute(&pins->run[i], model, sb_render_view(how->view), &report);
    code = MAX(code, sb_cli_status(status, &report));
    if (status == SB_OK || status == SB_ERROR_NOT_CONVERGED) {
      how->pin[how->pin_count++] = (SbRenderPin){pins->run[i], pins->name[i], (int)i};
    }
  }
  sb_cli_issues(issues);
  if (count > SB_CHART_PINS) {
    sb_cli_note("of %zu saved designs only the first %d are drawn", count, SB_CHART_PINS);
  }
  return code;
}

static void pins_clear(Pins *pins) {
  for (int i = 0; i < SB_CHART_PINS; i++) {
    sb_run_destroy(pins->run[i]);
    g_free(pins->name[i]);
  }
}

// The film or sequence, with its own progress.
static int render_film(const SbRun *run, Request *request, const char *output) {
  SbProgress progress;
  sb_progress_start(&progress, "drawing ");
  request->movie.hooks = (SbMovieHooks){on_picture, sb_cli_interrupted, &progress};
  SbMovieResult result = {0};
  g_autoptr(GPtrArray) kept = g_ptr_array_new_with_free_func(g_free);
  GError *error = NULL;
  bool good =
      request->sequence
          ? sb_render_sequence(run, &request->how, &request->movie, output, &result, kept, &error)
          : sb_render_movie(run, &request->how, &request->movie, output, &result, &error);
  sb_progress_end(&progress);
  sb_cli_kept(output, kept);
  if (result.wall_s > 0 && request->sequence) {
    sb_cli_note("%zu pictures in %.1f s (%.0f a second); engine %.2f s before", result.frames,
                result.wall_s, (double)result.frames / result.wall_s, sb_run_summary(run)->wall_s);
  } else if (good && result.wall_s > 0) {
    double read_back = sb_section_painter_read_back(request->how.section_data);
    sb_cli_note(
        "%zu pictures in %.1f s (%.0f a second): drawing %.1f s, of it %.1f s "
        "waiting for GL and reading back; in parallel colours %.1f s and encoding %.1f s; engine "
        "%.2f s before",
        result.frames, result.wall_s, (double)result.frames / result.wall_s, result.draw_s,
        read_back, result.convert_s, result.encode_s, sb_run_summary(run)->wall_s);
  }
  return good ? SB_EXIT_DONE : sb_cli_error(error);
}

// "piston.valve . thesis-cycle.scene", for the line below the title. Owned by the caller.
static char *file_names(const SbDocument *document) {
  const char *path = sb_document_path(document), *valve_path = sb_document_valve_path(document);
  g_autofree char *own = path != NULL ? g_path_get_basename(path) : g_strdup("");
  g_autofree char *valve = valve_path != NULL ? g_path_get_basename(valve_path) : NULL;
  return valve != NULL ? g_strdup_printf("%s  \xc2\xb7  %s", valve, own) : g_strdup(own);
}

// Takes folders that a failure left empty away again: nothing was written.
static void remove_folder(const char *output, const char *root, bool root_was_there) {
  g_autofree char *path = g_path_get_dirname(output);
  if (rmdir(path) == 0 && !root_was_there) {
    (void)rmdir(root);
  }
}

// Makes the folder of one of several files, when there is something to put into it.
static bool make_folder(const Request *request, const char *output, GError **error) {
  g_autofree char *path = g_path_get_dirname(output);
  SbOutputFolder *folder = NULL;
  bool good = request->name == NULL || sb_output_folder_open(&folder, path, NULL, error);
  sb_output_folder_close(folder);
  return good;
}

// A study needs no run.
static int render_study(const Request *request, SbDocument *document, const SbModel *model,
                        const char *output) {
  const SbRenderOptions *options = &request->how;
  g_autofree SbStudy *study = g_new(SbStudy, 1);
  int code = sb_cli_study(study, request->study, model);
  if (code == SB_EXIT_DONE || code == SB_EXIT_NOT_CONVERGED) {
    g_autofree char *sha256 = sb_document_sha256(document);
    g_autofree char *scene = sb_document_to_flat_text(document);
    g_autofree char *subtitle = file_names(document);
    SbStudyPage page = {.model = model,
                        .title = sb_document_title(document),
                        .subtitle = subtitle,
                        .hash = sha256,
                        .scene = scene,
                        .dark = options->dark,
                        .ending = options->ending,
                        .width = options->width,
                        .height = options->height};
    GError *error = NULL;
    if (!make_folder(request, output, &error) || !sb_study_still(study, &page, output, &error)) {
      code = sb_cli_error(error);
    }
  }
  return code;
}

// Draws the finished run; an exit code.
static int render(const SbRun *run, const SbDocument *document, const SbMeasured *measured,
                  Request *request, const char *output) {
  // Vectors need no GL, and views without a section do not either.
  bool use_gl = !request->vector && sb_render_view(request->how.view)->section;
  SbSectionPainter *painter = NULL;
  SbReport report = {0};
  SbStatus status = sb_section_painter_create(&painter, use_gl, request->backend, &report);
  if (status != SB_OK) {
    return sb_cli_status(status, &report);
  }
  if (use_gl) {
    sb_cli_note("section by %s", sb_section_painter_reason(painter));
  }
  SbSectionStyle style = sb_section_style_of(sb_run_model(run));
  style.zoom = request->zoom;
  style.cutaway = style.cutaway || sb_render_view(request->how.view)->cutaway;
  sb_section_painter_style(painter, &style);
  g_autofree char *sha256 = sb_document_sha256(document);
  char *scene = sb_document_to_flat_text(document);
  char *subtitle = file_names(document);
  SbRenderOptions *how = &request->how;
  how->title = sb_document_title(document);
  how->subtitle = subtitle;
  how->hash = sha256;
  how->scene = scene;
  g_autofree SbChartMarker *marker = NULL;
  how->marker_count = sb_render_markers(&marker, document);
  how->marker = marker;
  how->section = sb_section_painter_draw;
  how->section_data = painter;
  SbLoop loop = {0};
  g_autoptr(SbComparison) comparison =
      measured != NULL && sb_loop_take(&loop, run) ? sb_comparison_create(measured, &loop) : NULL;
  sb_loop_clear(&loop);
  how->measured = comparison;
  int code = SB_EXIT_DONE;
  GError *error = NULL;
  if (!make_folder(request, output, &error)) {
    code = sb_cli_error(error);
  } else if (request->film || request->sequence) {
    code = render_film(run, request, output);
  } else if (!sb_render_still(run, how, output, &error)) {
    code = sb_cli_error(error);
  }
  sb_section_painter_destroy(painter);
  g_free(subtitle);
  g_free(scene);
  return code;
}

// Checks before the work whether all outputs can be written. Returns an exit code.
static int check_outputs(const SbCliFiles *files, void *data) {
  const Request *request = data;
  const char *output = request->options->output;
  if (request->name != NULL) {
    g_autoptr(GPtrArray) names = g_ptr_array_new_with_free_func(g_free);
    for (int i = 0; i < files->count; i++) {
      if (files->file[i].document != NULL) {
        g_ptr_array_add(names, g_build_filename(files->file[i].name, request->name, NULL));
      }
    }
    g_ptr_array_add(names, NULL);
    return sb_cli_check_outputs(output, (char **)names->pdata, NULL);
  }
  GError *error = NULL;
  SbOutputCheck check = {0};
  bool good = request->sequence ? sb_render_sequence_check(output, &check, &error)
                                : sb_output_check(&check, output, false, &error);
  sb_output_check_clear(&check);
  return good ? SB_EXIT_DONE : sb_cli_error(error);
}

// Computes and draws one file; an exit code.
static int render_file(SbCliFiles *files, const SbCliFile *file, void *data) {
  Request request = *(const Request *)data;
  const Options *options = request.options;
  const SbModel *model = file->model;
  if (!sb_cli_has_memory(request.is_study ? NULL : model)) {
    return SB_EXIT_IO;
  }
  g_autofree char *output = request.name != NULL
                                ? g_build_filename(file->folder, request.name, NULL)
                                : g_strdup(options->output);
  bool root_was_there = g_file_test(options->output, G_FILE_TEST_IS_DIR);
  bool was_there = file->folder != NULL && g_file_test(file->folder, G_FILE_TEST_IS_DIR);
  int code;
  if (request.is_study) {
    code = render_study(&request, file->document, model, output);
  } else {
    int read;
    g_autoptr(SbMeasured) measured = sb_cli_measured(&read, file->document, options->measured);
    if (read != SB_EXIT_DONE) {
      return read;
    }
    SbRun *run = NULL;
    SbReport report = {0};
    SbStatus status = compute(&run, model, sb_render_view(request.how.view), &report);
    code = sb_cli_status(status, &report);
    Pins pins = {0};
    if (status == SB_OK || status == SB_ERROR_NOT_CONVERGED) {
      if (sb_render_view(request.how.view)->compares && !options->no_pins) {
        const int kept = compute_pins(&pins, file->document, &request);
        code = MAX(code, kept);
      }
      int drawn = sb_cli_interrupted(NULL)
                      ? SB_EXIT_INTERRUPTED
                      : render(run, file->document, measured, &request, output);
      code = drawn != SB_EXIT_DONE ? drawn : code;
    }
    pins_clear(&pins);
    sb_run_destroy(run);
  }
  if (request.name != NULL && !was_there && code != SB_EXIT_DONE) {
    remove_folder(output, options->output, root_was_there);
  }
  return code;
}

// Renders the files of the command line. Returns the exit code.
static int render_files(Request *request, int argc, char **argv) {
  g_auto(GStrv) settings = all_settings(request->options);
  const SbCliFilesWork work = {settings, request->options->output, NULL, check_outputs, render_file,
                               request};
  const int code = sb_cli_files_run(argc, argv, &work);
  g_free(request->name);
  return code;
}

int sb_command_render(int argc, char **argv) {
  Options options = {0};
  const GOptionEntry entries[] = {
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &options.output,
       "Picture (.png, .svg, .pdf), movie (.mp4), animation (.webp, .apng, .gif) or sequence "
       "(frames/%04d.png or a folder); of several files a folder, for SCENE-NAME/VIEW.png in it",
       "OUT"},
      {"format", 0, 0, G_OPTION_ARG_FILENAME, &options.format,
       "Of -o -, which writes to standard output, and of several files: png, svg, pdf, mp4, webp, "
       "apng or gif",
       "NAME"},
      {"view", 0, 0, G_OPTION_ARG_FILENAME, &options.view,
       "section (default), cutaway, hysteresis, profiles, dashboard, rig, life or a study "
       "(sealbench "
       "list views)",
       "VIEW"},
      {"size", 0, 0, G_OPTION_ARG_FILENAME, &options.size,
       "Size in pixels, or 720p, 1080p, 4k, report (1600x1200)", "WxH"},
      {"at", 0, 0, G_OPTION_ARG_FILENAME, &options.at,
       "Stage (A to F) or time (\"7.3 s\") of a picture", "STAGE|TIME"},
      {"fps", 0, 0, G_OPTION_ARG_FILENAME, &options.fps, "Pictures per second of a movie, 30", "N"},
      {"duration", 0, 0, G_OPTION_ARG_FILENAME, &options.duration,
       "Duration of a movie of the full cycle, 10 s", "S"},
      {"speed", 0, 0, G_OPTION_ARG_FILENAME, &options.speed,
       "In place of the duration: how many times faster than real", "FACTOR"},
      {"from", 0, 0, G_OPTION_ARG_FILENAME, &options.from, "Where a movie starts", "STAGE|TIME"},
      {"to", 0, 0, G_OPTION_ARG_FILENAME, &options.to, "Where a movie ends", "STAGE|TIME"},
      {"backend", 0, 0, G_OPTION_ARG_FILENAME, &options.backend,
       "Renderer of the section: osmesa or egl; default the first that works", "NAME"},
      {"field", 0, 0, G_OPTION_ARG_FILENAME, &options.field,
       "Colours of solved rings: von-mises, hydrostatic-pressure, shear, contact-pressure, "
       "displacement or permeation (output.field)",
       "NAME"},
      {"field-max", 0, 0, G_OPTION_ARG_FILENAME, &options.field_max,
       "Stress at the end of the colours; else the range of the run (output.field_max)", "STRESS"},
      {"insets", 0, 0, G_OPTION_ARG_FILENAME, &options.insets,
       "Whose contact is enlarged: outer, inner or none (output.insets)", "SEAL"},
      {"zoom", 0, 0, G_OPTION_ARG_FILENAME, &options.zoom,
       "One seal's surroundings only: outer or inner", "SEAL"},
      {"azimuth", 0, 0, G_OPTION_ARG_FILENAME, &options.azimuth,
       "Where the cutaway is seen from, about the vertical: \"-30°\" (output.azimuth)", "ANGLE"},
      {"elevation", 0, 0, G_OPTION_ARG_FILENAME, &options.elevation,
       "Where the cutaway is seen from, above the horizontal (output.elevation)", "ANGLE"},
      {"full", 0, 0, G_OPTION_ARG_NONE, &options.full,
       "Both halves of the section (output.section)", NULL},
      {"undeformed", 0, 0, G_OPTION_ARG_NONE, &options.undeformed,
       "The rings' outline before fitting, dashed (output.undeformed)", NULL},
      {"measured", 0, 0, G_OPTION_ARG_FILENAME, &options.measured, SB_CLI_MEASURED_HELP, "FILE"},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &options.settings, SB_CLI_SET_HELP, "KEY=VALUE"},
      {"no-pins", 0, 0, G_OPTION_ARG_NONE, &options.no_pins,
       "Omits the file's saved designs; loops and contacts show the first two of them", NULL},
      {"dark", 0, 0, G_OPTION_ARG_NONE, &options.dark, "Dark theme", NULL},
      {0},
  };
  Request request = {.options = &options};
  return sb_cli_parse(&argc, &argv, entries, 1, SB_CLI_FILES_MAX, NULL) &&
                 parse(&request, &options, argc - 1)
             ? render_files(&request, argc, argv)
             : SB_EXIT_INPUT;
}
