// A run as the window holds it. The count of frames that charts see never runs ahead of the trace
// by more than one update, so that a curve and its playhead agree.
#include "app/session/displayed_run.h"

#include "app/session/tangent.h"

enum { LARGE = 100000 }; // frames

SbDisplayedRun *sb_displayed_run_new(SbRunHandle *handle, const SbParams *params,
                                     SbRunGrade grade) {
  const SbRun *run = sb_run_handle_run(handle);
  SbDisplayedRun *shown = g_new0(SbDisplayedRun, 1);
  shown->references = 1;
  shown->handle = handle;
  shown->run = run;
  shown->params = *params;
  shown->grade = grade;
  shown->trace = sb_trace_create(sb_run_model(run));
  sb_chart_run_init(&shown->chart, run, shown->trace, SB_CHART_RUNNING);
  shown->chart.count = 0;
  shown->chart.summary = NULL;
  return shown;
}

void sb_displayed_run_end(SbDisplayedRun *shown) {
  const SbStatus status = sb_run_handle_status(shown->handle);
  shown->chart.summary = sb_run_summary(shown->run);
  shown->chart.life = sb_run_life(shown->run, &shown->chart.life_count);
  shown->chart.state = status == SB_OK                ? SB_CHART_DONE
                       : status == SB_ERROR_CANCELLED ? SB_CHART_PARTIAL
                                                      : SB_CHART_FAILED;
}

SbDisplayedRun *sb_displayed_run_ref(SbDisplayedRun *shown) {
  if (shown != NULL) {
    shown->references++;
  }
  return shown;
}

// Returning half a gigabyte to the system takes tens of milliseconds: not on the main loop.
static gpointer release(gpointer data) {
  sb_run_handle_unref(data);
  return NULL;
}

void sb_displayed_run_unref(SbDisplayedRun *shown) {
  if (shown == NULL || --shown->references > 0) {
    return;
  }
  sb_trace_destroy(shown->trace);
  g_free(shown->date);
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    sb_tangent_free(shown->tangent[id]);
    sb_gradient_destroy(shown->gradient[id]);
  }
  sb_displayed_run_unref(shown->level);
  GThread *thread = sb_run_capacity(shown->run) > LARGE
                        ? g_thread_try_new("release", release, shown->handle, NULL)
                        : NULL;
  if (thread != NULL) {
    g_thread_unref(thread);
  } else {
    sb_run_handle_unref(shown->handle);
  }
  g_free(shown);
}

bool sb_displayed_run_update(SbDisplayedRun *shown, size_t limit) {
  size_t published = 0;
  const SbFrame *frames = sb_run_frames(shown->run, &published);
  size_t before = sb_trace_frames(shown->trace);
  if (before >= published) {
    return false;
  }
  sb_trace_extend(shown->trace, frames, published, limit);
  shown->chart.frames = frames;
  shown->chart.count = sb_trace_frames(shown->trace);
  return true;
}

bool sb_displayed_run_complete(const SbDisplayedRun *shown) {
  size_t published = 0;
  sb_run_frames(shown->run, &published);
  return sb_trace_frames(shown->trace) >= published;
}

bool sb_same_values(const SbParams *a, const SbParams *b) {
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    if (sb_params_get(a, (SbParamId)id) != sb_params_get(b, (SbParamId)id)) {
      return false;
    }
  }
  return true;
}

bool sb_displayed_run_is_of(const SbDisplayedRun *shown, const SbParams *params,
                            uint64_t drawings) {
  return sb_model_drawings(sb_run_model(shown->run)) == drawings &&
         sb_same_values(&shown->params, params);
}
