// The playhead without a window: nearest frames, events, playing, looping.
#include "ui/playhead.h"

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

static void test_events(void) {
  fill();
  SbPlayhead playhead;
  sb_playhead_init(&playhead);
  SbStageMark marks[SB_STAGE_COUNT] = {{.reached = true, .frame = 0},
                                       {.reached = true, .frame = 10},
                                       {.reached = true, .frame = 40},
                                       {.reached = false, .frame = 50}};
  playhead.frame = 10;
  g_assert_cmpuint(sb_playhead_event(&playhead, marks, COUNT, 1), ==, 40);
  g_assert_cmpuint(sb_playhead_event(&playhead, marks, COUNT, -1), ==, 0);
  playhead.frame = 40;
  // The event that was not reached is none; the end is.
  g_assert_cmpuint(sb_playhead_event(&playhead, marks, COUNT, 1), ==, COUNT - 1);
  // An event beyond the frames that are there is none either.
  playhead.frame = 5;
  g_assert_cmpuint(sb_playhead_event(&playhead, marks, 8, 1), ==, 7);
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
  g_test_add_func("/playhead/play", test_play);
  g_test_add_func("/playhead/loop", test_loop);
  g_test_add_func("/playhead/nothing", test_nothing);
  return g_test_run();
}
