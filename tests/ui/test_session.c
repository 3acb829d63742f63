// A session under a fast hand: values change while runs go, some of them out of range or not going
// together, runs are stopped, the playhead moves, undo and redo walk back and forth. In the end the
// shown run is that of the values in force. Needs no display.
#include "app/session/session.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

// The main loop and the frame clock for a while.
static void turn(SbSession *session, int milliseconds) {
  gint64 end = g_get_monotonic_time() + milliseconds * 1000;
  while (g_get_monotonic_time() < end) {
    while (g_main_context_iteration(NULL, FALSE)) {
    }
    sb_session_tick(session, g_get_monotonic_time());
    g_usleep(1000);
  }
}

static gboolean settled(SbSession *session) {
  return sb_session_state(session) == SB_SESSION_DONE && !sb_session_wants_ticks(session) &&
         !sb_session_is_stale(session, NULL, NULL);
}

// Until the newest run is done and shown.
static void settle(SbSession *session) {
  for (int i = 0; i < 3000 && !settled(session); i++) {
    turn(session, 10);
  }
  g_assert_true(settled(session));
}

static void test_fast_edits(void) {
  g_autoptr(SbSession) session = sb_session_new();
  GRand *random = g_rand_new_with_seed(7);
  sb_session_edit(session, SB_P_MODELS_FILM, "thesis");
  sb_session_edit(session, SB_P_OUTPUT_FRAMES, "50000"); // so that most edits meet a run
  for (int i = 0; i < 400; i++) {
    size_t count = 0;
    sb_session_frames(session, &count);
    switch (g_rand_int_range(random, 0, 12)) {
    case 0:
      sb_session_edit(session, SB_P_SEAL_SECTION_DIAMETER, "9 m");
      break;
    case 1: // Alone a good value, but no valve with it.
      sb_session_edit(session, SB_P_BORE_DIAMETER, "2 mm");
      break;
    case 2:
      sb_session_undo(session);
      break;
    case 3:
      sb_session_redo(session);
      break;
    case 4:
      sb_session_start(session);
      break;
    case 5:
      sb_session_stop(session);
      break;
    case 6:
      sb_session_set_playhead(session, count > 0 ? g_rand_int(random) % count : 0);
      sb_session_step_event(session, 1);
      break;
    case 7:
      sb_session_play(session, TRUE);
      if (sb_session_pin_count(session) > 2) {
        sb_session_unpin(session, 0);
      } else {
        sb_session_pin(session);
      }
      break;
    default:
      sb_session_edit_value(session, SB_P_SEAL_SECTION_DIAMETER,
                            g_rand_double_range(random, 1.5e-3, 1.75e-3));
    }
    // Mostly faster than the delay that edits wait for, at times slower.
    turn(session, i % 10 == 9 ? 200 : 2);
    const SbChartData *chart = sb_session_chart(session);
    sb_session_frames(session, &count);
    g_assert_true(count == 0 || chart->playhead < count);
    g_free(sb_session_where(session));
    g_free(sb_session_stale_text(session));
  }
  g_rand_free(random);

  sb_session_play(session, FALSE);
  sb_session_unset(session, SB_P_BORE_DIAMETER);
  g_assert_true(sb_session_edit(session, SB_P_SEAL_SECTION_DIAMETER, "1.63 mm"));
  g_assert_cmpint(sb_session_error_count(session), ==, 0);
  settle(session);
  double shown = sb_model_seal(sb_run_model(sb_session_run(session)), SB_OUTER)->section_diameter;
  g_assert_cmpfloat(fabs(shown - 1.63e-3), <, 1e-12);
}

static void at_stage(SbSession *session, const char *stage) {
  g_autofree char *where = sb_session_where(session);
  g_assert_cmpstr(where, >, "");
  g_autofree char *start = g_strdup_printf("stage %s,", stage);
  g_assert_true(g_str_has_prefix(where, start));
}

// The playhead stays at its event through a short run and through one that is watched while it
// grows, and half way between events half way.
static void test_playhead_keeps_its_place(void) {
  g_autoptr(SbSession) session = sb_session_new();
  sb_session_edit(session, SB_P_MODELS_FILM, "thesis");
  settle(session);
  sb_session_set_playhead(session, 0);
  sb_session_step_event(session, 1);
  sb_session_step_event(session, 1);
  at_stage(session, "C");
  sb_session_edit(session, SB_P_OUTPUT_FRAMES, "300");
  settle(session);
  at_stage(session, "C");
  sb_session_edit(session, SB_P_OUTPUT_FRAMES, "300000");
  settle(session);
  at_stage(session, "C");
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(session, &count);
  sb_session_set_playhead(
      session, sb_chart_nearest(&sb_session_chart(session)->run, 0.7 * frames[count - 1].time));
  double share = sb_session_frame(session)->time / frames[count - 1].time;
  sb_session_edit(session, SB_P_OUTPUT_FRAMES, "200000");
  settle(session);
  frames = sb_session_frames(session, &count);
  g_assert_cmpfloat(fabs(sb_session_frame(session)->time / frames[count - 1].time - share), <,
                    1e-3);
}

// A run of other values that is cancelled before its first frame leaves the complete run before it
// as it is, and that run is said to be of its own value.
static void test_cancelled_before_the_first_frame(void) {
  g_autoptr(SbSession) session = sb_session_new();
  sb_session_edit(session, SB_P_MODELS_FILM, "thesis");
  settle(session);
  const SbRun *before = sb_session_run(session);
  sb_session_edit(session, SB_P_MODELS_FIT, "ring"); // solves its rings for seconds before a frame
  for (int i = 0; i < 200 && !sb_session_shows_former(session); i++) {
    turn(session, 10);
    g_assert_true(sb_session_run(session) == before);
  }
  g_assert_cmpint(sb_session_state(session), ==, SB_SESSION_RUNNING);
  g_autofree char *during = sb_session_former_text(session);
  g_assert_cmpstr(during, ==, "run with fitment karaszkiewicz");
  sb_session_stop(session);
  for (int i = 0; i < 500 && sb_session_state(session) == SB_SESSION_RUNNING; i++) {
    turn(session, 10);
  }
  g_assert_cmpint(sb_session_state(session), ==, SB_SESSION_DONE);
  g_assert_true(sb_session_run(session) == before);
  g_assert_cmpint((int)sb_session_chart(session)->run.state, ==, SB_CHART_DONE);
  g_autofree char *after = sb_session_former_text(session);
  g_assert_cmpstr(after, ==, "run with fitment karaszkiewicz");
  // The value back: the displayed run is of the present values again, without another run.
  sb_session_undo(session);
  g_assert_false(sb_session_shows_former(session));
  g_assert_false(sb_session_wants_ticks(session));
}

static void wait_pins(SbSession *session) {
  for (int i = 0; i < 3000; i++) {
    size_t there = 0;
    for (size_t k = 0; k < sb_session_pin_count(session); k++) {
      there += sb_session_pin_summary(session, k) != NULL;
    }
    if (there == sb_session_pin_count(session)) {
      return;
    }
    turn(session, 10);
  }
  g_assert_not_reached();
}

static double breakaway(const SbSummary *summary) {
  return sb_figure_value(summary, sb_figure_find("cycle.force_breakaway_N"));
}

// Three designs are kept, two are drawn; they go by what differs, come back from the file with
// equal figures, and are used as one step, at once.
static void test_pins(void) {
  g_autoptr(SbSession) session = sb_session_new();
  sb_session_edit(session, SB_P_MODELS_FILM, "thesis");
  settle(session);
  g_assert_true(sb_session_pin(session));
  g_assert_cmpstr(sb_session_pin_name(session, 0), ==, "as now");
  sb_session_edit(session, SB_P_SEAL_SECTION_DIAMETER, "1.63 mm");
  g_assert_false(sb_session_pin(session)); // its run is still to come
  settle(session);
  const double first = breakaway(sb_session_summary(session));
  g_assert_true(sb_session_pin(session));
  sb_session_edit(session, SB_P_SEAL_SECTION_DIAMETER, "1.57 mm");
  sb_session_edit(session, SB_P_GLAND_RADIAL_SPACE, "1.34 mm");
  settle(session);
  // What both pins have in common tells nothing.
  g_assert_cmpstr(sb_session_pin_name(session, 0), ==, "section diameter 1.61 mm");
  g_assert_cmpstr(sb_session_pin_name(session, 1), ==, "section diameter 1.63 mm");
  g_assert_true(sb_session_pin(session));
  g_assert_cmpuint(sb_session_pin_count(session), ==, 3);
  const SbChartData *chart = sb_session_chart(session);
  g_assert_cmpuint(chart->pin_count, ==, 2);
  g_assert_cmpint(sb_session_pin_slot(session, 0), ==, -1); // the oldest gave way
  g_assert_true(chart->pin[0].frame < chart->pin[0].run->count);
  sb_session_rename_pin(session, 1, " wide = soft ");
  g_assert_cmpstr(sb_session_pin_name(session, 1), ==, "wide   soft");

  g_autofree char *folder = g_dir_make_tmp("sealbench-pins-XXXXXX", NULL);
  g_autofree char *path = g_build_filename(folder, "kept.valve", NULL);
  g_assert_true(sb_session_is_modified(session));
  g_assert_true(sb_session_save(session, path, NULL));
  g_assert_false(sb_session_is_modified(session));
  g_assert_true(chart->title == sb_document_title(sb_session_document(session))); // the file's name
  g_autoptr(SbSession) again = sb_session_new();
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_assert_true(sb_session_open(again, path, issues));
  g_assert_cmpuint(issues->len, ==, 0);
  settle(again);
  wait_pins(again);
  g_assert_cmpuint(sb_session_pin_count(again), ==, 3);
  g_assert_cmpstr(sb_session_pin_name(again, 1), ==, "wide   soft");
  g_assert_true(g_str_has_prefix(sb_session_pin_name(again, 0), "section diameter 1.61 mm"));
  g_assert_cmpfloat(breakaway(sb_session_pin_summary(again, 1)), ==, first);
  g_assert_false(sb_session_is_modified(again));

  const SbDocument *document = sb_session_document(again);
  sb_session_use_pin(again, 1);
  g_assert_cmpint(sb_session_state(again), ==, SB_SESSION_DONE); // nothing is solved again
  g_assert_cmpfloat(breakaway(sb_session_summary(again)), ==, first);
  g_assert_cmpfloat(sb_document_value(document, SB_P_GLAND_RADIAL_SPACE), ==, 1.36e-3);
  sb_session_undo(again);
  g_assert_cmpfloat(sb_document_value(document, SB_P_SEAL_SECTION_DIAMETER), ==, 1.57e-3);
  g_assert_cmpfloat(sb_document_value(document, SB_P_GLAND_RADIAL_SPACE), ==, 1.34e-3);
  sb_session_redo(again);
  g_assert_cmpfloat(sb_document_value(document, SB_P_SEAL_SECTION_DIAMETER), ==, 1.63e-3);

  // Dropped, and so from the file.
  sb_session_unpin(again, 0);
  g_assert_true(sb_session_save(again, path, NULL));
  g_autofree char *text = NULL;
  g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
  g_assert_nonnull(strstr(text, "wide   soft ="));
  g_autoptr(SbSession) last = sb_session_new();
  g_assert_true(sb_session_open(last, path, issues));
  g_assert_cmpuint(sb_session_pin_count(last), ==, 2);
  g_assert_cmpstr(sb_session_pin_name(last, 0), ==, "wide   soft");
  g_unlink(path);
  g_rmdir(folder);
}

// A drawing is no value, and solved for like one: what is shown is of it, also after undo.
static void test_drawn_groove(void) {
  static const SbSealPoint point[] = {
      {1.3e-3, -1.2e-3, 0}, {0, -1e-3, 0}, {0, 1e-3, 0}, {1.3e-3, 1.2e-3, 0}};
  SbGrooveDrawing groove;
  g_assert_cmpint(sb_groove_draw(&groove, point, 4, NULL), ==, SB_OK);
  g_autoptr(SbSession) session = sb_session_new();
  sb_session_start(session);
  settle(session);
  const double flat = sb_model_seal(sb_run_model(sb_session_run(session)), SB_OUTER)->gland_fill;
  sb_session_set_groove(session, "/groove.txt", &groove);
  g_assert_true(sb_session_is_stale(session, NULL, NULL));
  settle(session);
  g_assert_false(sb_session_is_stale(session, NULL, NULL));
  const SbModel *shown = sb_run_model(sb_session_run(session));
  g_assert_nonnull(sb_model_groove(shown));
  g_assert_cmpfloat(sb_model_seal(shown, SB_OUTER)->gland_fill, <, 0.98 * flat);
  sb_session_undo(session);
  settle(session);
  g_assert_null(sb_model_groove(sb_run_model(sb_session_run(session))));
  // Taken back while the run goes on.
  sb_session_redo(session);
  turn(session, 2);
  sb_session_undo(session);
  settle(session);
  g_assert_null(sb_model_groove(sb_run_model(sb_session_run(session))));
  g_assert_false(sb_session_is_stale(session, NULL, NULL));
}

// A pinned run stays with its document only.
static void test_another_document_forgets(void) {
  g_autoptr(SbSession) session = sb_session_new();
  sb_session_start(session);
  settle(session);
  g_assert_true(sb_session_pin(session));
  g_assert_cmpuint(sb_session_pin_count(session), ==, 1);
  sb_session_reset(session);
  g_assert_cmpuint(sb_session_pin_count(session), ==, 0);
  g_assert_null(sb_session_run(session));
}

// Before the first frame the chart's axes are those of the values, whatever they become.
static void test_edit_before_the_first_frame(void) {
  g_autoptr(SbSession) session = sb_session_new();
  sb_session_set_auto_run(session, FALSE);
  sb_session_edit(session, SB_P_MODELS_FILM, "thesis");
  sb_session_start(session);
  g_assert_null(sb_session_run(session));
  for (int i = 0; i < 3; i++) {
    const SbModel *former = sb_session_chart(session)->run.model;
    g_assert_true(former != NULL && former == sb_session_model(session));
    sb_session_edit(session, SB_P_SEAL_SECTION_DIAMETER, i % 2 == 0 ? "1.62" : "1.61");
    g_assert_true(sb_session_chart(session)->run.model == sb_session_model(session));
  }
  sb_session_edit(session, SB_P_SEAL_SECTION_DIAMETER, "9 m");
  g_assert_true(sb_session_chart(session)->run.model == sb_session_model(session));
}

// Given up in the middle of a run.
static void test_gone_while_running(void) {
  for (int i = 0; i < 20; i++) {
    SbSession *session = sb_session_new();
    sb_session_edit(session, SB_P_OUTPUT_FRAMES, "200000");
    sb_session_start(session);
    turn(session, i);
    g_object_unref(session);
    while (g_main_context_iteration(NULL, FALSE)) {
    }
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/session/fast-edits", test_fast_edits);
  g_test_add_func("/session/playhead-keeps-its-place", test_playhead_keeps_its_place);
  g_test_add_func("/session/cancelled-before-the-first-frame",
                  test_cancelled_before_the_first_frame);
  g_test_add_func("/session/pins", test_pins);
  g_test_add_func("/session/drawn-groove", test_drawn_groove);
  g_test_add_func("/session/another-document-forgets", test_another_document_forgets);
  g_test_add_func("/session/edit-before-the-first-frame", test_edit_before_the_first_frame);
  g_test_add_func("/session/gone-while-running", test_gone_while_running);
  return g_test_run();
}
