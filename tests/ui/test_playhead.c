// The playhead without a window: nearest frames, events, playing, looping.
#include "app/session/playhead.h"

enum { COUNT = 101 };
static SbFrame frames[COUNT];

static void fill(void) {
  for (int i = 0; i < COUNT; i++) {
    frames[i] = (SbFrame){.time = 0.1 * i};
  }
}

static void test_nearest(void) {
  fill();
  g_assert_cmpuint(sb_playhead_nearest(frames, COUNT, -1), ==, 0);
  g_assert_cmpuint(sb_playhead_nearest(frames, COUNT, 99), ==, COUNT - 1);
  g_assert_cmpuint(sb_playhead_nearest(frames, COUNT, 0.149), ==, 1);
  g_assert_cmpuint(sb_playhead_nearest(frames, COUNT, 0.151), ==, 2);
  g_assert_cmpuint(sb_playhead_nearest(frames, 1, 5), ==, 0);
}

// A trace whose stages A, B and C begin at frames 0, 10 and 40, for `count` frames.
static SbTrace *trace_of(size_t count) {
  fill();
  for (int i = 0; i < COUNT; i++) {
    frames[i].stage = i <= 10 ? SB_STAGE_A : i <= 40 ? SB_STAGE_B : SB_STAGE_C;
  }
  SbTrace *trace = sb_trace_create(NULL);
  sb_trace_extend(trace, frames, count, 0);
  return trace;
}

static void test_events(void) {
  SbPlayhead playhead;
  sb_playhead_init(&playhead);
  SbTrace *trace = trace_of(COUNT);
  playhead.frame = 10;
  g_assert_cmpuint(sb_playhead_event(&playhead, trace, COUNT, 1), ==, 40);
  g_assert_cmpuint(sb_playhead_event(&playhead, trace, COUNT, -1), ==, 0);
  playhead.frame = 40;
  // After the last event the end.
  g_assert_cmpuint(sb_playhead_event(&playhead, trace, COUNT, 1), ==, COUNT - 1);
  // An event beyond the frames that are there is none.
  playhead.frame = 5;
  g_assert_cmpuint(sb_playhead_event(&playhead, trace, 8, 1), ==, 7);
  sb_trace_destroy(trace);
}

// The place is found again in a run with other frames, as soon as the run has come to it.
static void test_place(void) {
  SbPlayhead playhead;
  sb_playhead_init(&playhead);
  playhead.waits = FALSE;
  playhead.frame = 25; // half way from B to C
  SbTrace *trace = trace_of(COUNT);
  sb_playhead_remember(&playhead, trace, frames, COUNT, TRUE);
  g_assert_cmpint(playhead.place.stage, ==, SB_STAGE_B);
  sb_trace_destroy(trace);
  // While the run grows: its newest frame, then the place.
  trace = trace_of(20);
  sb_playhead_return(&playhead, trace, frames, 20, FALSE);
  g_assert_true(playhead.waits);
  g_assert_cmpuint(playhead.frame, ==, 19);
  sb_playhead_remember(&playhead, trace, frames, 20, FALSE); // the place stays what it was
  sb_trace_destroy(trace);
  trace = trace_of(COUNT);
  sb_playhead_return(&playhead, trace, frames, COUNT, TRUE);
  g_assert_false(playhead.waits);
  g_assert_cmpuint(playhead.frame, ==, 25);
  // On an event's frame it stays on the event.
  playhead.frame = 40;
  sb_playhead_remember(&playhead, trace, frames, COUNT, TRUE);
  sb_playhead_return(&playhead, trace, frames, COUNT, TRUE);
  g_assert_cmpuint(playhead.frame, ==, 40);
  // At the end it follows the end.
  playhead.follows = TRUE;
  sb_playhead_return(&playhead, trace, frames, COUNT, TRUE);
  g_assert_cmpuint(playhead.frame, ==, COUNT - 1);
  sb_trace_destroy(trace);
}

// Returned to a frame, it keeps its place, not that frame's: runs of other frames, and those that
// are overtaken while they grow, do not lead it away.
static void test_keeps(void) {
  SbPlayhead playhead;
  sb_playhead_init(&playhead);
  SbTrace *whole = trace_of(COUNT), *grows = trace_of(80);
  sb_playhead_return(&playhead, whole, frames, COUNT, TRUE);
  g_assert_cmpuint(playhead.frame, ==, 70);
  for (int i = 0; i < 3; i++) {
    sb_playhead_return(&playhead, grows, frames, 80 + (size_t)i, FALSE);
    sb_playhead_remember(&playhead, grows, frames, 80 + (size_t)i, FALSE);
  }
  sb_playhead_return(&playhead, whole, frames, COUNT, TRUE);
  g_assert_cmpuint(playhead.frame, ==, 70);
  g_assert_cmpfloat(playhead.place.share, ==, 0.5);
  // Moved by hand in a growing run it stays that long after the stage's event.
  sb_playhead_return(&playhead, grows, frames, 80, FALSE);
  playhead.waits = FALSE;
  playhead.frame = 60;
  sb_playhead_remember(&playhead, grows, frames, 80, FALSE);
  sb_playhead_return(&playhead, whole, frames, COUNT, TRUE);
  g_assert_cmpuint(playhead.frame, ==, 60);
  sb_trace_destroy(whole);
  sb_trace_destroy(grows);
}

// The first run opens half way through stage C; one that does not reach it, in its middle.
static void test_opens(void) {
  SbPlayhead playhead;
  sb_playhead_init(&playhead);
  SbTrace *trace = trace_of(30);
  sb_playhead_return(&playhead, trace, frames, 30, FALSE);
  g_assert_true(playhead.waits);
  g_assert_cmpuint(playhead.frame, ==, 29);
  sb_playhead_return(&playhead, trace, frames, 30, TRUE);
  g_assert_cmpuint(playhead.frame, ==, 15); // 1.45 s
  sb_trace_destroy(trace);
  sb_playhead_init(&playhead);
  trace = trace_of(COUNT);
  sb_playhead_return(&playhead, trace, frames, COUNT - 1, FALSE); // in C, for how long is not known
  g_assert_true(playhead.waits);
  sb_playhead_return(&playhead, trace, frames, COUNT, TRUE);
  g_assert_false(playhead.waits);
  g_assert_cmpuint(playhead.frame, ==, 70); // from 40 to 100
  sb_trace_destroy(trace);
}

static void test_play(void) {
  fill();
  SbPlayhead playhead;
  sb_playhead_init(&playhead);
  playhead.duration = 1;
  playhead.loops = FALSE;
  playhead.frame = COUNT - 1;
  // From the end it starts again; 10 s of cycle play in 1 s.
  sb_playhead_play(&playhead, frames, COUNT, TRUE);
  g_assert_cmpuint(playhead.frame, ==, 0);
  gint64 now = 1000000;
  sb_playhead_tick(&playhead, frames, COUNT, now);
  for (int i = 0; i < 5; i++) {
    now += 100000;
    g_assert_true(sb_playhead_tick(&playhead, frames, COUNT, now));
  }
  g_assert_cmpuint(playhead.frame, ==, 50);
  // A long hitch moves on by a quarter of a second at most.
  now += 5000000;
  sb_playhead_tick(&playhead, frames, COUNT, now);
  g_assert_cmpuint(playhead.frame, ==, 75);
  // At the end it stops.
  for (int i = 0; i < 5 && playhead.playing; i++) {
    now += 100000;
    sb_playhead_tick(&playhead, frames, COUNT, now);
  }
  g_assert_false(playhead.playing);
  g_assert_cmpuint(playhead.frame, ==, COUNT - 1);
}

static void test_loop(void) {
  fill();
  SbPlayhead playhead;
  sb_playhead_init(&playhead);
  playhead.duration = 1;
  playhead.frame = 90;
  sb_playhead_play(&playhead, frames, COUNT, TRUE);
  gint64 now = 1000000;
  sb_playhead_tick(&playhead, frames, COUNT, now);
  sb_playhead_tick(&playhead, frames, COUNT, now + 200000);
  g_assert_true(playhead.playing);
  g_assert_cmpuint(playhead.frame, ==, 10);
}

static void test_nothing(void) {
  SbPlayhead playhead;
  sb_playhead_init(&playhead);
  sb_playhead_play(&playhead, NULL, 0, TRUE);
  g_assert_false(playhead.playing);
  g_assert_false(sb_playhead_tick(&playhead, NULL, 0, 1));
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/playhead/nearest", test_nearest);
  g_test_add_func("/playhead/events", test_events);
  g_test_add_func("/playhead/place", test_place);
  g_test_add_func("/playhead/keeps", test_keeps);
  g_test_add_func("/playhead/opens", test_opens);
  g_test_add_func("/playhead/play", test_play);
  g_test_add_func("/playhead/loop", test_loop);
  g_test_add_func("/playhead/nothing", test_nothing);
  return g_test_run();
}
