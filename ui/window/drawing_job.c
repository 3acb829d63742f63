// See drawing_job.h.
#include "ui/window/drawing_job.h"

#include "app/session/worker.h"

#include <string.h>

struct SbDrawingJob {
  SbWorker worker;
  char *path, *text, *why;
  SbDrawing drawing;
};

static bool choose(SbDrawingJob *job, GError **error) {
  g_auto(GStrv) lines = g_strsplit(job->text, "\n", -1);
  for (char **line = lines; *line != NULL; line++) {
    g_auto(GStrv) parts = g_strsplit(*line, " = ", 2);
    if (parts[0] != NULL && parts[1] != NULL &&
        !sb_cad_choose(&job->drawing.settings, parts[0], parts[1], error)) {
      g_prefix_error(error, "%s: ", parts[0]);
      return false;
    }
  }
  return true;
}

static void work(void *owner) {
  SbDrawingJob *job = owner;
  SbDrawing *drawing = &job->drawing;
  g_autoptr(GError) error = NULL;
  if (choose(job, &error)) {
    drawing->cad = sb_cad_read(job->path, &drawing->settings.read, &error);
  }
  if (drawing->cad == NULL ||
      !sb_cad_parts(drawing->part, drawing->cad, &drawing->settings, &error)) {
    job->why = g_strdup(error->message);
  }
}

SbDrawingJob *sb_drawing_job_start(const char *path, const char *choices, void (*done)(void *data),
                                   void *user) {
  SbDrawingJob *job = g_new0(SbDrawingJob, 1);
  job->path = g_strdup(path);
  job->text = g_strdup(choices);
  job->drawing.path = job->path;
  sb_cad_settings_init(&job->drawing.settings);
  sb_worker_start(&job->worker, "drawing", work, job, done, user);
  return job;
}

const SbDrawing *sb_drawing_job_drawing(const SbDrawingJob *job, const char **why) {
  *why = job->why;
  return job->why == NULL ? &job->drawing : NULL;
}

void sb_drawing_job_free(SbDrawingJob *job) {
  if (job == NULL) {
    return;
  }
  sb_worker_finish(&job->worker);
  sb_cad_free(job->drawing.cad);
  sb_cad_settings_clear(&job->drawing.settings);
  g_free(job->path);
  g_free(job->text);
  g_free(job->why);
  g_free(job);
}
