// One export on a thread of its own: the run is complete and immutable, the painter and the trace
// belong to this thread, so nothing is shared with the window but a counter and a flag.
#include "app/export/export_job.h"

#include "app/base/output.h"
#include "app/data/compare.h"
#include "app/export/formats.h"
#include "app/export/render_movie.h"
#include "app/export/report.h"
#include "app/export/results.h"
#include "app/session/worker.h"
#include "app/study/view.h"
#include "app/table/json.h"

#include <glib/gi18n.h>
#include <string.h>

struct SbExportJob {
  SbWorker worker;
  SbRunHandle *handle; // owned reference
  SbExportRequest request;
  gint64 begin; // [us]
  char *result;
  gboolean good;
};

void sb_export_request_add_compared(SbExportRequest *request, SbSession *session) {
  for (size_t i = 0; i < sb_session_pin_count(session); i++) {
    const int look = sb_session_pin_slot(session, i);
    SbChartPin pin;
    if (look >= 0 && sb_session_pin_chart(session, i, &pin)) {
      request->pin[look] = sb_session_pin_handle(session, i);
      request->pin_name[look] = g_strdup(pin.name);
    }
  }
  request->marker_count = sb_render_markers(&request->marker, sb_session_document(session));
  for (size_t i = 0; i < request->marker_count; i++) {
    request->marker[i].name = g_strdup(request->marker[i].name);
  }
}

// Frees the content of a request that was not started, and sets its pointers to NULL.
static void clear_request(SbExportRequest *request) {
  char **texts[] = {&request->path,     &request->view,  &request->at,    &request->title,
                    &request->subtitle, &request->hash,  &request->scene, &request->from,
                    &request->to,       &request->stale, &request->file,  &request->document};
  for (guint i = 0; i < G_N_ELEMENTS(texts); i++) {
    g_clear_pointer(texts[i], g_free);
  }
  g_clear_pointer(&request->measured, sb_data_free);
  for (int i = 0; i < SB_CHART_PINS; i++) {
    g_clear_pointer(&request->pin[i], sb_run_handle_unref);
    g_clear_pointer(&request->pin_name[i], g_free);
  }
  for (size_t i = 0; i < request->marker_count; i++) {
    g_free((char *)request->marker[i].name);
  }
  g_clear_pointer(&request->marker, g_free);
  request->marker_count = 0;
}

// Drawing ----------------------------------------------------------------------------------------

static void on_film_progress(void *user, size_t done, size_t total) {
  SbExportJob *job = user;
  sb_worker_set_progress(&job->worker, (double)done / (double)MAX(total, 1));
}

static bool film_cancelled(void *user) {
  SbExportJob *job = user;
  return sb_worker_cancelled(&job->worker);
}

static bool on_report_page(void *data, int done, int count) {
  SbExportJob *job = data;
  sb_worker_set_progress(&job->worker, (double)done / MAX(count, 1));
  return sb_worker_cancelled(&job->worker);
}

// "x.mp4 is partial, 3 of 40 frames" and the like, from what a film's writer said.
static void tell_film(SbExportJob *job, bool good, const SbMovieResult *result, bool sequence,
                      const GError *error) {
  g_autofree char *name = g_filename_display_basename(job->request.path);
  bool cancelled = error != NULL && error->code == SB_APP_ERROR_CANCELLED;
  job->good = good;
  if (good && sequence) {
    job->result = g_strdup_printf(_("%zu pictures are written."), result->frames);
  } else if (good) {
    job->result = g_strdup_printf(_("%s is written: %zu frames."), name, result->frames);
  } else if (sequence && result->frames > 0) {
    job->result = cancelled
                      ? g_strdup_printf(_("Cancelled: %zu pictures are written."), result->frames)
                      : g_strdup_printf(_("Stopped: %zu pictures are written, then %s."),
                                        result->frames, error->message);
  } else if (cancelled && result->frames > 0) {
    job->result = g_strdup_printf(_("Cancelled: %s is partial, %zu frames."), name, result->frames);
  } else if (cancelled) {
    job->result = g_strdup(_("Cancelled: nothing was written."));
  } else {
    job->result = g_strdup_printf(_("Nothing was written: %s."), error->message);
  }
}

// Adds which pictures of an earlier sequence stayed.
static void tell_kept(SbExportJob *job, GPtrArray *kept) {
  if (kept->len > 0) {
    g_ptr_array_add(kept, NULL);
    g_autofree char *names = g_strjoinv(", ", (char **)kept->pdata);
    g_autofree char *result = g_steal_pointer(&job->result);
    job->result = g_strdup_printf(_("%s Not deleted, because changed since an earlier export: %s."),
                                  result, names);
  }
}

// What was measured, read again for this thread; NULL where it can no longer be.
static SbMeasured *read_measured(const SbExportRequest *request) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  return request->measured != NULL
             ? sb_measured_read(request->measured, request->drive_speed, NULL, 0, issues)
             : NULL;
}

static void make(SbExportJob *job, SbSectionPainter *painter) {
  const SbExportRequest *request = &job->request;
  sb_section_painter_style(painter, &request->style);
  const SbRun *run = sb_run_handle_run(job->handle);
  g_autoptr(SbMeasured) measured = read_measured(request);
  SbLoop loop = {0};
  g_autoptr(SbComparison) comparison =
      measured != NULL && sb_loop_take(&loop, run) ? sb_comparison_create(measured, &loop) : NULL;
  sb_loop_clear(&loop);
  SbRenderOptions options = {
      .view = request->view,
      .width = request->width,
      .height = request->height,
      .dark = request->dark,
      .at = request->at,
      .title = request->title,
      .subtitle = request->subtitle,
      .hash = request->hash,
      .scene = request->scene,
      .stale = request->stale,
      .measured = comparison,
      .marker = request->marker,
      .marker_count = request->marker_count,
      .section = sb_section_painter_draw,
      .section_data = painter,
  };
  for (int look = 0; look < SB_CHART_PINS; look++) {
    if (request->pin[look] != NULL) {
      options.pin[options.pin_count++] =
          (SbRenderPin){sb_run_handle_run(request->pin[look]), request->pin_name[look], look};
    }
  }
  SbRenderMovie movie = {.fps = request->fps,
                         .duration = request->duration,
                         .speed = request->speed,
                         .from = request->from,
                         .to = request->to,
                         .hooks = {on_film_progress, film_cancelled, job}};
  SbMovieResult result = {0};
  g_autoptr(GError) error = NULL;
  bool sequence = sb_render_is_sequence(request->path);
  const SbExportFormat *format = sb_export_format(request->path);
  if (sequence) {
    g_autoptr(GPtrArray) kept = g_ptr_array_new_with_free_func(g_free);
    bool good = sb_render_sequence(run, &options, &movie, request->path, &result, kept, &error);
    tell_film(job, good, &result, true, error);
    tell_kept(job, kept);
  } else if (format != NULL && format->kind == SB_FORMAT_FILM) {
    bool good = sb_render_movie(run, &options, &movie, request->path, &result, &error);
    tell_film(job, good, &result, false, error);
  } else {
    job->good = sb_render_still(run, &options, request->path, &error);
    g_autofree char *name = g_filename_display_basename(request->path);
    job->result = job->good ? g_strdup_printf(_("%s is written."), name)
                            : g_strdup_printf(_("Nothing was written: %s."), error->message);
  }
  sb_worker_set_progress(&job->worker, 1);
}

// The studies that the scene asks for; how many.
static size_t make_studies(SbExportJob *job, SbStudy *out, const SbModel *model) {
  const unsigned mask = (unsigned)sb_model_number(model, SB_P_OUTPUT_STUDIES);
  const SbStudyHooks hooks = {.cancelled = film_cancelled, .data = job};
  size_t count = 0;
  for (int i = 0; i < SB_STUDY_COUNT; i++) {
    SbReport report = {0};
    if ((mask & (1u << i)) != 0 && !film_cancelled(job)) {
      count += sb_study_make(&out[count], (SbStudyKind)i, model, &hooks, &report) == SB_OK;
    }
  }
  return count;
}

static bool write_pages(SbExportJob *job, const SbReportScene *scene, GError **error) {
  const SbReportHooks pages = {on_report_page, job};
  SbOutput out = {0};
  if (!sb_output_begin(&out, job->request.path, error)) {
    return false;
  }
  if (!sb_report_scene(out.stream, scene, &pages, error)) {
    sb_output_abort(&out);
    return false;
  }
  return sb_output_commit(&out, error);
}

static bool write_json(SbExportJob *job, const SbReportScene *scene, GError **error) {
  const SbExportRequest *request = &job->request;
  const SbResultsInfo info = {.scene = request->file != NULL ? request->file : "",
                              .sha256 = request->hash,
                              .verdict = scene->verdict,
                              .measured = scene->measured,
                              .studies = scene->studies,
                              .study_count = scene->study_count};
  g_autofree char *text = sb_results_run(scene->run, &info);
  return sb_output_write(request->path, text, strlen(text), error);
}

// What `sealbench run --json` or `sealbench report` writes, with the verdict over all cases.
static bool write_results(SbExportJob *job, const SbDocument *document, GError **error) {
  const SbRun *run = sb_run_handle_run(job->handle);
  const SbRunHooks hooks = {.cancelled = film_cancelled, .data = job};
  SbCaseVerdict verdict[SB_VERDICT_COUNT];
  g_autoptr(GPtrArray) problems = g_ptr_array_new_with_free_func(g_free);
  g_autofree SbStudy *studies = g_new(SbStudy, SB_STUDY_COUNT);
  const size_t study_count = make_studies(job, studies, sb_run_model(run));
  SbVerdict own[SB_VERDICT_COUNT];
  sb_cases_own(own, run, studies, study_count);
  (void)sb_cases_judge(verdict, own, document, &hooks, problems);
  g_autoptr(SbMeasured) measured = read_measured(&job->request);
  SbLoop loop = {0};
  g_autoptr(SbComparison) comparison =
      measured != NULL && sb_loop_take(&loop, run) ? sb_comparison_create(measured, &loop) : NULL;
  sb_loop_clear(&loop);
  const SbReportScene scene = {.document = document,
                               .run = run,
                               .verdict = verdict,
                               .measured = comparison,
                               .studies = studies,
                               .study_count = study_count};
  return !film_cancelled(job) &&
         (sb_output_ends_in(job->request.path, ".json") ? write_json(job, &scene, error)
                                                        : write_pages(job, &scene, error));
}

static void make_results(SbExportJob *job) {
  const SbExportRequest *request = &job->request;
  g_autoptr(GError) error = NULL;
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autofree char *folder = request->file != NULL ? g_path_get_dirname(request->file) : NULL;
  const char *name = request->file != NULL ? request->file : _("the unsaved changes");
  g_autoptr(SbDocument) document =
      request->document != NULL
          ? sb_document_parse(request->document, strlen(request->document), name, folder, issues)
      : request->file != NULL ? sb_document_load(request->file, issues)
                              : sb_document_new();
  job->good = document != NULL && write_results(job, document, &error);
  g_autofree char *shown = g_filename_display_basename(request->path);
  g_autofree char *issue =
      document == NULL && issues->len > 0 ? sb_issue_line(issues->pdata[0]) : NULL;
  const char *why = issue != NULL ? issue : error != NULL ? error->message : "";
  job->result = job->good             ? g_strdup_printf(_("%s is written."), shown)
                : film_cancelled(job) ? g_strdup(_("Cancelled: nothing was written."))
                                      : g_strdup_printf(_("Nothing was written: %s."), why);
}

// Thread -----------------------------------------------------------------------------------------

static void work(void *owner) {
  SbExportJob *job = owner;
  SbSectionPainter *painter = NULL;
  SbReport report = {0};
  if (job->request.view == NULL) {
    make_results(job);
    return;
  }
  if (sb_section_painter_create(&painter, true, SB_GL_AUTO, &report) != SB_OK) {
    job->result = g_strdup_printf(_("Nothing was written: %s."), report.text);
  } else {
    make(job, painter);
  }
  sb_section_painter_destroy(painter);
}

SbExportJob *sb_export_job_start(SbRunHandle *handle, SbExportRequest *request,
                                 void (*done)(void *data), void *data) {
  SbExportJob *job = g_new0(SbExportJob, 1);
  job->handle = handle;
  job->request = *request;
  memset(request, 0, sizeof *request);
  job->begin = g_get_monotonic_time();
  sb_worker_start(&job->worker, "export", work, job, done, data);
  return job;
}

double sb_export_job_left(SbExportJob *job) {
  double done = sb_worker_progress(job);
  double elapsed = 1e-6 * (double)(g_get_monotonic_time() - job->begin);
  return done > 0 && elapsed > 0.5 ? elapsed * (1 - done) / done : -1;
}

const char *sb_export_job_result(SbExportJob *job, gboolean *good) {
  *good = job->good;
  return job->result;
}

void sb_export_job_free(SbExportJob *job) {
  if (job == NULL) {
    return;
  }
  sb_worker_finish(&job->worker);
  sb_run_handle_unref(job->handle);
  clear_request(&job->request);
  g_free(job->result);
  g_free(job);
}
