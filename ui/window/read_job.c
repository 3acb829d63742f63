// See read_job.h.
#include "ui/window/read_job.h"

#include "app/base/error.h"
#include "app/session/worker.h"

#include <string.h>

// ---- The kinds ----

typedef struct {
  SbSurface surface; // the result
  SbSurfaceChoices choices;
  SbScan scan;
  SbScanFigures figures;
} Scan;

static void init_scan(void *object) {
  sb_surface_choices_init(&((Scan *)object)->choices);
}

static bool choose_scan(void *object, const char *name, const char *text, GError **error) {
  return sb_surface_choose(&((Scan *)object)->choices, name, text, error);
}

static bool read_scan(void *object, const char *path, GError **error) {
  Scan *of = object;
  SbReport report = {0};
  if (!sb_scan_read(&of->scan, NULL, 0, &of->choices.scan, path, error)) {
    return false;
  }
  if (sb_scan_figures(&of->figures, &of->scan.heights, &of->choices.heights, &report) != SB_OK) {
    g_set_error_literal(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, report.text);
    return false;
  }
  of->surface = (SbSurface){path, &of->scan, &of->choices.heights, &of->figures};
  return true;
}

static void clear_scan(void *object) {
  Scan *of = object;
  sb_scan_figures_clear(&of->figures);
  sb_scan_clear(&of->scan);
  sb_surface_choices_clear(&of->choices);
}

const SbReadKind sb_read_scan = {sizeof(Scan), init_scan, choose_scan, read_scan, clear_scan};

static void init_drawing(void *object) {
  sb_cad_settings_init(&((SbDrawing *)object)->settings);
}

static bool choose_drawing(void *object, const char *name, const char *text, GError **error) {
  const bool good = sb_cad_choose(&((SbDrawing *)object)->settings, name, text, error);
  if (!good) {
    g_prefix_error(error, "%s: ", name);
  }
  return good;
}

static bool read_drawing(void *object, const char *path, GError **error) {
  SbDrawing *of = object;
  of->path = path;
  of->cad = sb_cad_read(path, &of->settings.read, error);
  return of->cad != NULL && sb_cad_parts(of->part, of->cad, &of->settings, error);
}

static void clear_drawing(void *object) {
  SbDrawing *of = object;
  sb_cad_free(of->cad);
  sb_cad_settings_clear(&of->settings);
}

const SbReadKind sb_read_drawing = {sizeof(SbDrawing), init_drawing, choose_drawing, read_drawing,
                                    clear_drawing};

// ---- The job ----

struct SbReadJob {
  SbWorker worker;
  const SbReadKind *kind;
  char *path, *choices;
  void *object;  // the thread's until it has ended
  GError *error; // NULL: it is read
};

static void work_read_job(void *owner) {
  SbReadJob *job = owner;
  g_auto(GStrv) lines = g_strsplit(job->choices, "\n", -1);
  bool good = true;
  for (char **line = lines; good && *line != NULL; line++) {
    g_auto(GStrv) parts = g_strsplit(*line, " = ", 2);
    good = parts[0] == NULL || parts[1] == NULL ||
           job->kind->choose(job->object, parts[0], parts[1], &job->error);
  }
  (void)(good && job->kind->read(job->object, job->path, &job->error));
}

SbReadJob *sb_read_job_start(const SbReadKind *kind, const char *path, const char *choices,
                             void (*done)(void *data), void *user) {
  SbReadJob *job = g_new0(SbReadJob, 1);
  job->kind = kind;
  job->path = g_strdup(path);
  job->choices = g_strdup(choices);
  job->object = g_malloc0(kind->size);
  kind->init(job->object);
  sb_worker_start(&job->worker, "import", work_read_job, job, done, user);
  return job;
}

const void *sb_read_job_result(const SbReadJob *job, const GError **why) {
  *why = job->error;
  return job->error == NULL ? job->object : NULL;
}

void sb_read_job_free(SbReadJob *job) {
  if (job == NULL) {
    return;
  }
  sb_worker_finish(&job->worker);
  job->kind->clear(job->object);
  g_free(job->object);
  g_clear_error(&job->error);
  g_free(job->path);
  g_free(job->choices);
  g_free(job);
}
