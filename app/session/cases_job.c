// See cases_job.h. The thread reads a document of its own from the text of the session's.
#include "app/session/cases_job.h"

#include "app/session/worker.h"

#include <string.h>

struct SbCasesJob {
  SbWorker worker;
  SbRunHandle *handle; // owned reference
  char *text, *folder;
  SbDocument *document; // the thread's until it has ended
  SbCaseVerdict verdict[SB_VERDICT_COUNT];
  bool good; // set on the main thread
  void (*done)(void *data);
  void *data;
};

static void work(void *owner) {
  SbCasesJob *job = owner;
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(GPtrArray) problems = g_ptr_array_new_with_free_func(g_free);
  job->document = sb_document_parse(job->text, strlen(job->text), "cases", job->folder, issues);
  if (job->document != NULL) {
    const SbRunHooks hooks = {.cancelled = sb_worker_cancelled, .data = &job->worker};
    // A case that fails says so in the answers that it has none for.
    (void)sb_cases_judge(job->verdict, sb_run_summary(sb_run_handle_run(job->handle))->verdict,
                         job->document, &hooks, problems);
  }
}

static void on_done(void *data) {
  SbCasesJob *job = data;
  job->good = job->document != NULL;
  job->done(job->data);
}

SbCasesJob *sb_cases_job_start(SbRunHandle *handle, const SbDocument *document,
                               void (*done)(void *data), void *data) {
  SbCasesJob *job = g_new0(SbCasesJob, 1);
  const char *path = sb_document_path(document);
  job->handle = handle;
  job->text = sb_document_to_text(document, NULL);
  job->folder = path != NULL ? g_path_get_dirname(path) : NULL;
  job->done = done;
  job->data = data;
  sb_worker_start(&job->worker, "cases", work, job, on_done, job);
  return job;
}

const SbCaseVerdict *sb_cases_job_verdict(const SbCasesJob *job) {
  return job->good ? job->verdict : NULL;
}

const SbRun *sb_cases_job_run(const SbCasesJob *job) {
  return sb_run_handle_run(job->handle);
}

void sb_cases_job_free(SbCasesJob *job) {
  if (job != NULL) {
    sb_worker_finish(&job->worker);
    sb_run_handle_unref(job->handle);
    sb_document_free(job->document);
    g_free(job->text);
    g_free(job->folder);
    g_free(job);
  }
}
