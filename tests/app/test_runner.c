// The engine's thread: newest request wins, cancel is quick, frames are seen growing, nothing is
// lost or freed too early. Runs under the thread sanitizer in ./check.
#include "app/run/runner.h"

#include <glib.h>
#include <math.h>
#include <stdatomic.h>

static SbModel model_with(int frames) {
  SbParams params;
  sb_params_init(&params);
  sb_params_set(&params, SB_P_OUTPUT_FRAMES, frames, NULL);
  SbModel model;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL), ==, SB_OK);
  return model;
}

static void count(void *data) {
  atomic_fetch_add((atomic_uint *)data, 1);
}

static void wait_idle(SbRunner *runner) {
  gint64 end = g_get_monotonic_time() + 30 * G_USEC_PER_SEC;
  while (sb_runner_is_busy(runner)) {
    g_assert_cmpint(g_get_monotonic_time(), <, end);
    g_usleep(1000);
  }
}

static void test_one(void) {
  atomic_uint notes = 0;
  SbRunner *runner = sb_runner_create(count, &notes);
  g_assert_null(sb_runner_latest(runner));
  SbModel model = model_with(400);
  unsigned ticket = sb_runner_submit(runner, &model);
  wait_idle(runner);
  SbRunHandle *handle = sb_runner_latest(runner);
  g_assert_cmpuint(sb_run_handle_ticket(handle), ==, ticket);
  g_assert_true(sb_run_handle_is_done(handle));
  g_assert_cmpint(sb_run_handle_status(handle), ==, SB_OK);
  g_assert_cmpfloat(sb_run_handle_fraction(handle), ==, 1);
  g_assert_cmpuint(atomic_load(&notes), >=, 2);
  // A handle outlives its runner.
  sb_runner_destroy(runner);
  size_t frames = 0;
  sb_run_frames(sb_run_handle_run(handle), &frames);
  g_assert_cmpuint(frames, >=, 400);
  sb_run_handle_unref(handle);
}

// Frames are published while the run goes on, and each is complete when seen.
static void test_growing(void) {
  atomic_uint notes = 0;
  SbRunner *runner = sb_runner_create(count, &notes);
  SbModel model = model_with(100000);
  sb_runner_submit(runner, &model);
  size_t seen = 0;
  int looks = 0;
  while (sb_runner_is_busy(runner)) {
    SbRunHandle *handle = sb_runner_latest(runner);
    if (handle != NULL) {
      size_t frames = 0;
      const SbFrame *frame = sb_run_frames(sb_run_handle_run(handle), &frames);
      g_assert_cmpuint(frames, >=, seen);
      for (size_t i = seen; i < frames; i++) {
        g_assert_true(isfinite(frame[i].force));
        g_assert_true(i == 0 || frame[i].time >= frame[i - 1].time);
      }
      looks += frames > seen;
      seen = frames;
      sb_run_handle_unref(handle);
    }
  }
  g_assert_cmpint(looks, >, 1);
  sb_runner_destroy(runner);
}

static void test_cancel(void) {
  atomic_uint notes = 0;
  SbRunner *runner = sb_runner_create(count, &notes);
  SbModel model = model_with(500000);
  sb_runner_submit(runner, &model);
  SbRunHandle *handle = NULL;
  while (handle == NULL) {
    handle = sb_runner_latest(runner);
  }
  size_t frames = 0;
  while (frames == 0) {
    sb_run_frames(sb_run_handle_run(handle), &frames);
  }
  gint64 start = g_get_monotonic_time();
  sb_runner_cancel(runner);
  sb_runner_cancel(runner);
  wait_idle(runner);
  // 50 ms are promised; the machine may be busy with other things.
  g_assert_cmpint(g_get_monotonic_time() - start, <, 500000);
  g_assert_true(sb_run_handle_is_done(handle));
  g_assert_cmpint(sb_run_handle_status(handle), ==, SB_ERROR_CANCELLED);
  sb_run_frames(sb_run_handle_run(handle), &frames);
  g_assert_cmpuint(frames, >, 0);
  g_assert_cmpuint(sb_run_summary(sb_run_handle_run(handle))->frames, ==, frames);
  sb_run_handle_unref(handle);
  // A cancel of nothing does not hit the next request.
  sb_runner_cancel(runner);
  model = model_with(100);
  sb_runner_submit(runner, &model);
  wait_idle(runner);
  handle = sb_runner_latest(runner);
  g_assert_cmpint(sb_run_handle_status(handle), ==, SB_OK);
  sb_run_handle_unref(handle);
  sb_runner_destroy(runner);
}

// A storm of requests: the last one is what is seen in the end.
static void test_newest_wins(void) {
  atomic_uint notes = 0;
  SbRunner *runner = sb_runner_create(count, &notes);
  SbModel long_model = model_with(300000);
  unsigned ticket = 0;
  for (int i = 0; i < 200; i++) {
    ticket = sb_runner_submit(runner, &long_model);
    if (i % 20 == 0) {
      g_usleep(2000);
    }
  }
  SbModel model = model_with(123);
  ticket = sb_runner_submit(runner, &model);
  gint64 start = g_get_monotonic_time();
  wait_idle(runner);
  g_assert_cmpint(g_get_monotonic_time() - start, <, 1000000);
  SbRunHandle *handle = sb_runner_latest(runner);
  g_assert_cmpuint(sb_run_handle_ticket(handle), ==, ticket);
  g_assert_cmpint(sb_run_model(sb_run_handle_run(handle))->frames, ==, 123);
  g_assert_cmpint(sb_run_handle_status(handle), ==, SB_OK);
  sb_run_handle_unref(handle);
  // Destroyed in the middle of a run.
  sb_runner_submit(runner, &long_model);
  sb_runner_destroy(runner);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/runner/one", test_one);
  g_test_add_func("/runner/growing", test_growing);
  g_test_add_func("/runner/cancel", test_cancel);
  g_test_add_func("/runner/newest-wins", test_newest_wins);
  return g_test_run();
}
