// sealbench render: a view of a scene as a picture or a film.
#include "app/cli/cli.h"
#include "app/export/render_movie.h"
#include "app/export/studies.h"
#include "app/section/painter.h"

#include <stdlib.h>
#include <string.h>

// "1280x720".
static bool parse_size(double *width, double *height, const char *text) {
  char *end = NULL;
  long w = strtol(text, &end, 10);
  bool good = end != text && *end == 'x' && g_ascii_isdigit(end[1]);
  long h = good ? strtol(end + 1, &end, 10) : 0;
  if (!good || *end != '\0' || w < 1 || h < 1 || w > 100000 || h > 100000) {
    sb_cli_fail("--size: \"%s\" is not WIDTHxHEIGHT", text);
    return false;
  }
  *width = (double)w;
  *height = (double)h;
  return true;
}

static void on_progress(void *data, double fraction, size_t frames) {
  sb_progress_update(data, fraction);
}

static bool on_cancelled(void *data) {
  return sb_cli_interrupted(NULL);
}

static void on_picture(void *data, size_t done, size_t total) {
  sb_progress_update(data, (double)done / (double)total);
}

// The film, with its own progress.
static int render_film(const SbRun *run, const SbRenderOptions *options, double fps,
                       double duration, const char *output, bool quiet) {
  SbProgress progress;
  sb_progress_start(&progress, "drawing ", quiet);
  SbRenderMovie movie = {fps, duration, {on_picture, on_cancelled, &progress}};
  SbMovieResult result = {0};
  GError *error = NULL;
  bool good = sb_render_movie(run, options, &movie, output, &result, &error);
  sb_progress_end(&progress);
  if (!good) {
    return sb_cli_error(error);
  }
  if (!quiet && result.wall_s > 0) {
    double read_back = sb_section_painter_read_back(options->section_data);
    fprintf(stderr,
            "sealbench: %zu pictures in %.1f s (%.0f a second): drawing %.1f s, of it %.1f s "
            "waiting for GL and reading back; beside it colours %.1f s and encoding %.1f s; engine "
            "%.2f s before\n",
            result.frames, result.wall_s, (double)result.frames / result.wall_s, result.draw_s,
            read_back, result.convert_s, result.encode_s, sb_run_summary(run)->wall_s);
  }
  return SB_EXIT_DONE;
}

// "piston.valve . thesis-cycle.scene", for the line below the title. Owned by the caller.
static char *file_names(const SbDocument *document) {
  const char *path = sb_document_path(document), *valve_path = sb_document_valve_path(document);
  char *own = path != NULL ? g_path_get_basename(path) : g_strdup("");
  char *valve = valve_path != NULL ? g_path_get_basename(valve_path) : NULL;
  char *names = valve != NULL ? g_strdup_printf("%s  \xc2\xb7  %s", valve, own) : g_strdup(own);
  g_free(valve);
  g_free(own);
  return names;
}

// A study needs no run.
static int render_study(SbStudyKind kind, SbDocument *document, const SbModel *model,
                        const SbRenderOptions *options, const char *output, bool quiet) {
  SbStudy *study = g_new(SbStudy, 1);
  int code = sb_cli_study(study, kind, model, quiet);
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
                        .width = options->width,
                        .height = options->height};
    GError *error = NULL;
    if (!sb_study_still(study, &page, output, &error)) {
      code = sb_cli_error(error);
    }
  }
  g_free(study);
  return code;
}

int sb_command_render(int argc, char **argv) {
  char *output = NULL;
  char *view = NULL;
  char *size = NULL;
  char *at = NULL;
  char *fps_text = NULL;
  char *duration_text = NULL;
  char *backend_text = NULL;
  char **settings = NULL;
  gboolean dark = FALSE;
  gboolean quiet = FALSE;
  const GOptionEntry entries[] = {
      {"output", 'o', 0, G_OPTION_ARG_FILENAME, &output,
       "Picture (.png, .svg, .pdf) or film (.mp4) to write", "OUT"},
      {"view", 0, 0, G_OPTION_ARG_FILENAME, &view,
       "section (default), hysteresis, profiles, dashboard, rig or a study (sealbench list views)",
       "VIEW"},
      {"size", 0, 0, G_OPTION_ARG_FILENAME, &size, "Size in pixels", "WxH"},
      {"at", 0, 0, G_OPTION_ARG_FILENAME, &at, "Stage (A to F) or time (\"7.3 s\") of a picture",
       "STAGE|TIME"},
      {"fps", 0, 0, G_OPTION_ARG_FILENAME, &fps_text, "Pictures per second of a film, 30", "N"},
      {"duration", 0, 0, G_OPTION_ARG_FILENAME, &duration_text,
       "Time in which a film shows the whole cycle, 10 s", "S"},
      {"backend", 0, 0, G_OPTION_ARG_FILENAME, &backend_text,
       "What draws the section: osmesa or egl; else the first that works", "NAME"},
      {"set", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &settings, "Overrides a parameter", "KEY=VALUE"},
      {"dark", 0, 0, G_OPTION_ARG_NONE, &dark, "Dark theme", NULL},
      {"quiet", 0, 0, G_OPTION_ARG_NONE, &quiet, "No progress", NULL},
      {0},
  };
  int code = SB_EXIT_INPUT;
  SbModel model;
  SbDocument *document = NULL;
  SbRun *run = NULL;
  SbSectionPainter *painter = NULL;
  double fps = 30;
  double duration = 10;
  char *sha256 = NULL;
  char *scene = NULL;
  char *subtitle = NULL;
  SbRenderOptions options = {.dark = dark};
  if (!sb_cli_parse(&argc, &argv, entries, 1, 1, NULL)) {
    goto done;
  }
  if (output == NULL) {
    sb_cli_fail("-o is missing: the picture or film to write");
    goto done;
  }
  options.view = view != NULL ? view : "section";
  options.dark = dark;
  options.at = at;
  SbStudyKind study = SB_STUDY_COUNT;
  bool is_study = sb_study_from_name(&study, options.view);
  if (!is_study && sb_render_view(options.view) == NULL) {
    sb_cli_fail("--view: there is no view \"%s\" (see sealbench list views)", options.view);
    goto done;
  }
  if (size != NULL && !parse_size(&options.width, &options.height, size)) {
    goto done;
  }
  bool film = g_str_has_suffix(output, ".mp4");
  if (is_study && film) {
    sb_cli_fail("--view %s is a study, which does not move: write a .png, .svg or .pdf",
                options.view);
    goto done;
  }
  if (is_study && at != NULL) {
    sb_cli_fail("--at: a study has no time");
    goto done;
  }
  if (film && at != NULL) {
    sb_cli_fail("--at: a film shows the whole cycle");
    goto done;
  }
  if (!film && (fps_text != NULL || duration_text != NULL)) {
    sb_cli_fail("--fps and --duration are for films (.mp4)");
    goto done;
  }
  if (!sb_cli_quantity(&fps, "--fps", fps_text, false, "1", "") ||
      !sb_cli_quantity(&duration, "--duration", duration_text, false, "s", "s")) {
    goto done;
  }
  if (!(fps > 0 && duration > 0)) {
    sb_cli_fail("--fps and --duration must be positive");
    goto done;
  }
  int backend = backend_text != NULL ? sb_gl_backend_find(backend_text) : SB_GL_AUTO;
  if (backend < 0) {
    sb_cli_fail("--backend: there is no back end \"%s\" (allowed osmesa, egl)", backend_text);
    goto done;
  }
  document = sb_cli_open(&model, argv[1], settings);
  if (document == NULL) {
    goto done;
  }
  if (is_study) {
    code = render_study(study, document, &model, &options, output, quiet);
    goto done;
  }
  // What is drawn decides what is computed, not what the scene would show by itself.
  int index = sb_param_choice(sb_param(SB_P_OUTPUT_VIEWS), options.view, strlen(options.view));
  model.views = index >= 0 ? 1u << index : model.views;

  SbPlan plan;
  SbReport report = {0};
  sb_plan_make(&plan, &model);
  SbStatus status = sb_run_create(&run, &model, &plan, &report);
  SbProgress progress;
  sb_progress_start(&progress, "computing ", quiet);
  if (status == SB_OK) {
    sb_cli_catch_interrupts();
    SbRunHooks hooks = {on_progress, on_cancelled, &progress};
    status = sb_run_execute(run, &hooks, &report);
    sb_progress_end(&progress);
  }
  code = sb_cli_status(status, &report);
  if (status != SB_OK && status != SB_ERROR_NOT_CONVERGED) {
    goto done;
  }
  // Vectors need no GL, and views without a section do not either.
  bool vector = g_str_has_suffix(output, ".svg") || g_str_has_suffix(output, ".pdf");
  bool use_gl = !vector && sb_render_view(options.view)->section;
  status = sb_section_painter_create(&painter, use_gl, (SbGlBackend)backend, &report);
  if (status != SB_OK) {
    code = sb_cli_status(status, &report);
    goto done;
  }
  if (use_gl && !quiet) {
    fprintf(stderr, "sealbench: section by %s\n", sb_section_painter_reason(painter));
  }
  sha256 = sb_document_sha256(document);
  scene = sb_document_to_flat_text(document);
  options.title = sb_document_title(document);
  subtitle = file_names(document);
  options.subtitle = subtitle;
  options.hash = sha256;
  options.scene = scene;
  options.section = sb_section_painter_draw;
  options.section_data = painter;
  GError *error = NULL;
  if (film) {
    int drawn = render_film(run, &options, fps, duration, output, quiet);
    code = drawn != SB_EXIT_DONE ? drawn : code;
  } else if (!sb_render_still(run, &options, output, &error)) {
    code = sb_cli_error(error);
  }
done:
  sb_section_painter_destroy(painter);
  sb_run_destroy(run);
  sb_document_free(document);
  g_strfreev(settings);
  g_free(sha256);
  g_free(subtitle);
  g_free(scene);
  g_free(output);
  g_free(view);
  g_free(size);
  g_free(at);
  g_free(fps_text);
  g_free(duration_text);
  g_free(backend_text);
  return code;
}
