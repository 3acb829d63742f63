// See scan_job.h.
#include "ui/window/scan_job.h"

#include "app/session/worker.h"

#include <string.h>

struct SbScanJob {
  SbWorker worker;
  char *path, *text, *why;
  SbSurfaceChoices choices;
  SbScan scan;
  SbScanFigures *figures;
  SbSurface surface;
  bool good;
};

static bool choose(SbScanJob *job, GError **error) {
  g_auto(GStrv) lines = g_strsplit(job->text, "\n", -1);
  for (char **line = lines; *line != NULL; line++) {
    g_auto(GStrv) parts = g_strsplit(*line, " = ", 2);
    if (parts[0] != NULL && parts[1] != NULL &&
        !sb_surface_choose(&job->choices, parts[0], parts[1], error)) {
      return false;
    }
  }
  return true;
}

static void work(void *owner) {
  SbScanJob *job = owner;
  g_autoptr(GError) error = NULL;
  SbReport report = {0};
  if (!choose(job, &error) || !sb_scan_read(&job->scan, job->path, &job->choices.scan, &error)) {
    job->why = g_strdup(error->message);
  } else if (sb_scan_figures(job->figures, &job->scan.heights, &job->choices.heights, &report) !=
             SB_OK) {
    job->why = g_strdup(report.text);
  } else {
    job->surface = (SbSurface){job->path, &job->scan, &job->choices.heights, job->figures};
    job->good = true;
  }
}

SbScanJob *sb_scan_job_start(const char *path, const char *choices, void (*done)(void *data),
                             void *user) {
  SbScanJob *job = g_new0(SbScanJob, 1);
  job->path = g_strdup(path);
  job->text = g_strdup(choices);
  job->figures = g_new0(SbScanFigures, 1);
  sb_surface_choices_init(&job->choices);
  sb_worker_start(&job->worker, "scan", work, job, done, user);
  return job;
}

const SbSurface *sb_scan_job_surface(const SbScanJob *job, const char **why) {
  *why = job->why;
  return job->good ? &job->surface : NULL;
}

void sb_scan_job_free(SbScanJob *job) {
  if (job == NULL) {
    return;
  }
  sb_worker_finish(&job->worker);
  sb_scan_figures_clear(job->figures);
  sb_scan_clear(&job->scan);
  sb_surface_choices_clear(&job->choices);
  g_free(job->figures);
  g_free(job->path);
  g_free(job->text);
  g_free(job->why);
  g_free(job);
}
