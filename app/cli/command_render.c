// sealbench render: a view of a scene as a picture, a film or a sequence of pictures.
#include "app/cli/cli.h"

#include "app/cli/render_private.h"
#include "app/session/pin_names.h"

#include <limits.h>
#include <string.h>
#include <unistd.h>

// The runs of kept designs, drawn beside the file's.
typedef struct {
  SbRun *run[SB_CHART_PINS];
  char *name[SB_CHART_PINS];
} Pins;

// --set, and behind it the options that are short for a key. Free with g_strfreev().
static char **all_settings(const SbRenderArguments *options) {
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
static SbStatus compute_render(SbRun **run, const SbModel *model, const SbRenderView *view,
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
static int compute_pins(Pins *pins, const SbDocument *document, SbRenderRequest *request) {
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
    const SbStatus status =
        compute_render(&pins->run[i], model, sb_render_view(how->view), &report);
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
static int render_film(const SbRun *run, SbRenderRequest *request, const char *output) {
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
static bool make_folder(const SbRenderRequest *request, const char *output, GError **error) {
  g_autofree char *path = g_path_get_dirname(output);
  SbOutputFolder *folder = NULL;
  bool good = request->name == NULL || sb_output_folder_open(&folder, path, NULL, error);
  sb_output_folder_close(folder);
  return good;
}

// A study needs no run.
static int render_study(const SbRenderRequest *request, SbDocument *document, const SbModel *model,
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
                  SbRenderRequest *request, const char *output) {
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
  const SbRenderRequest *request = data;
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
  SbRenderRequest request = *(const SbRenderRequest *)data;
  const SbRenderArguments *options = request.options;
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
    SbStatus status = compute_render(&run, model, sb_render_view(request.how.view), &report);
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
static int render_files(SbRenderRequest *request, int argc, char **argv) {
  g_auto(GStrv) settings = all_settings(request->options);
  const SbCliFilesWork work = {settings, request->options->output, NULL, check_outputs, render_file,
                               request};
  const int code = sb_cli_files_run(argc, argv, &work);
  g_free(request->name);
  return code;
}

int sb_command_render(int argc, char **argv) {
  SbRenderArguments options = {0};
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
  SbRenderRequest request = {.options = &options};
  return sb_cli_parse(&argc, &argv, entries, 1, SB_CLI_FILES_MAX, NULL) &&
                 sb_render_parse(&request, &options, argc - 1)
             ? render_files(&request, argc, argv)
             : SB_EXIT_INPUT;
}
