// A session under a fast hand: values change while runs go, some of them out of range or not going
// together, runs are stopped, the playhead moves, undo and redo walk back and forth. In the end the
// shown run is that of the values in force. Needs no display.
#include "app/session/autosave.h"
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

// A session has one store of its runs: that of a saved design stays after any number of others, the
// oldest run that nothing uses does not.
static void test_runs(void) {
  g_autoptr(SbSession) session = sb_session_new();
  sb_session_edit(session, SB_P_MODELS_FILM, "thesis");
  sb_session_edit(session, SB_P_SEAL_SECTION_DIAMETER, "1.62 mm");
  settle(session);
  g_assert_true(sb_session_pin(session));
  for (int i = 0; i < 10; i++) {
    g_autofree char *text = g_strdup_printf("%.3f mm", 1.600 + 0.001 * i);
    sb_session_edit(session, SB_P_SEAL_SECTION_DIAMETER, text);
    settle(session);
  }
  sb_session_edit(session, SB_P_SEAL_SECTION_DIAMETER, "1.608 mm");
  g_assert_false(sb_session_is_stale(session, NULL, NULL));
  sb_session_use_pin(session, 0);
  g_assert_false(sb_session_is_stale(session, NULL, NULL));
  sb_session_edit(session, SB_P_SEAL_SECTION_DIAMETER, "1.6 mm");
  g_assert_true(sb_session_is_stale(session, NULL, NULL));
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

// Files of a test in a folder of their own.
typedef struct {
  char *folder, *valve, *scene;
} Files;

static const char scene_text[] = "# mine\n[sealbench]\nformat = 1\nkind = scene\nvalve = a.valve\n"
                                 "\n[drive]\nspeed = 20 mm/min\n\n[seal]\nmodulus = 3 MPa\n";

static void put(const char *path, const char *text) {
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
}

static Files files_new(void) {
  Files files = {.folder = g_dir_make_tmp("sealbench-disk-XXXXXX", NULL)};
  files.valve = g_build_filename(files.folder, "a.valve", NULL);
  files.scene = g_build_filename(files.folder, "a.scene", NULL);
  put(files.valve, "[sealbench]\nformat = 1\nkind = valve\n\n[canister]\npressure = 0.5 MPa\n");
  put(files.scene, scene_text);
  return files;
}

static void files_finish(Files *files) {
  g_autoptr(GDir) dir = g_dir_open(files->folder, 0, NULL);
  const char *name;
  while ((name = g_dir_read_name(dir)) != NULL) {
    g_autofree char *path = g_build_filename(files->folder, name, NULL);
    g_unlink(path);
  }
  g_rmdir(files->folder);
  g_free(files->folder);
  g_free(files->valve);
  g_free(files->scene);
}

static char *contents(const char *path) {
  char *text = NULL;
  g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
  return text;
}

static double value(SbSession *session, SbParamId id) {
  return sb_document_value(sb_session_document(session), id);
}

static const char theirs[] =
    "# mine\n[sealbench]\nformat = 1\nkind = scene\nvalve = a.valve\n\n# theirs\n[drive]\n"
    "speed = 30 mm/min\n\n[seal]\nmodulus = 4 MPa\n\n[gland]\nradial_space = 1.37 mm\n";

// Opens the file, edits modulus and frames, lets another program write the file.
static SbSession *conflict(const Files *files) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  put(files->scene, scene_text);
  SbSession *session = sb_session_new();
  sb_session_set_auto_run(session, FALSE);
  g_assert_true(sb_session_open(session, files->scene, issues));
  g_assert_cmpint(sb_session_check_disk(session), ==, SB_DISK_SAME);
  sb_session_edit(session, SB_P_SEAL_MODULUS, "3.5 MPa");
  sb_session_edit(session, SB_P_OUTPUT_FRAMES, "77");
  put(files->scene, theirs);
  return session;
}

// The version that was edited, with the file as it was read below it.
static void assert_mine(SbSession *session) {
  g_assert_cmpfloat_with_epsilon(value(session, SB_P_SEAL_MODULUS), 3.5e6, 1);
  g_assert_cmpfloat_with_epsilon(value(session, SB_P_DRIVE_SPEED), 20e-3 / 60, 1e-9);
  g_assert_cmpfloat(value(session, SB_P_OUTPUT_FRAMES), ==, 77);
  g_assert_false(sb_document_gives(sb_session_document(session), SB_P_GLAND_RADIAL_SPACE));
  g_assert_true(sb_session_is_modified(session));
}

// Saving never replaces what another program wrote, unless the user says so.
static void test_save_refuses_a_changed_file(void) {
  Files files = files_new();
  g_autoptr(SbSession) session = conflict(&files);
  g_autoptr(GError) error = NULL;
  g_assert_false(sb_session_save(session, NULL, &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_CHANGED);
  g_autofree char *there = contents(files.scene);
  g_assert_cmpstr(there, ==, theirs);
  g_assert_cmpint(sb_session_disk_state(session), ==, SB_DISK_CHANGED);
  assert_mine(session);
  g_assert_true(sb_session_save_over(session, NULL));
  g_assert_cmpint(sb_session_check_disk(session), ==, SB_DISK_SAME);
  g_assert_true(sb_session_save(session, NULL, NULL));
  // Another time, the same bytes: nothing has changed.
  g_autofree char *mine = contents(files.scene);
  put(files.scene, mine);
  g_assert_cmpint(sb_session_check_disk(session), ==, SB_DISK_SAME);
  g_assert_true(sb_session_save(session, NULL, NULL));
  g_unlink(files.scene);
  g_assert_cmpint(sb_session_check_disk(session), ==, SB_DISK_GONE);
  g_assert_true(sb_session_save(session, NULL, NULL));
  put(files.valve, "[sealbench]\nformat = 1\nkind = valve\n");
  g_assert_cmpint(sb_session_check_disk(session), ==, SB_DISK_VALVE_CHANGED);
  files_finish(&files);
}

// Reloading shows the file, merging makes the user's changes in it, and both are one step back.
static void test_reload_and_merge(void) {
  Files files = files_new();
  g_autoptr(GPtrArray) issues = sb_issues_new();
  for (int merge = 0; merge < 2; merge++) {
    g_autoptr(SbSession) session = conflict(&files);
    g_autoptr(GPtrArray) conflicts = g_ptr_array_new_with_free_func(g_free);
    g_assert_true(sb_session_put_remark(session, SB_REMARK_NOTE, "valve", "mine", NULL));
    g_assert_true(merge ? sb_session_merge(session, conflicts, issues)
                        : sb_session_reload(session, issues));
    g_assert_cmpint(sb_session_disk_state(session), ==, SB_DISK_SAME);
    g_assert_cmpfloat_with_epsilon(value(session, SB_P_DRIVE_SPEED), 30e-3 / 60, 1e-9);
    g_assert_cmpfloat_with_epsilon(value(session, SB_P_GLAND_RADIAL_SPACE), 1.37e-3, 1e-12);
    g_assert_cmpfloat_with_epsilon(value(session, SB_P_SEAL_MODULUS), merge ? 3.5e6 : 4e6, 1);
    g_assert_cmpint(sb_session_is_modified(session), ==, merge);
    g_assert_cmpuint(conflicts->len, ==, merge);
    if (merge) {
      g_assert_cmpstr(conflicts->pdata[0], ==, "seal.modulus: 3.5 MPa (in the file: 4 MPa)");
    }
    const SbDocument *document = sb_session_document(session);
    g_assert_cmpuint(sb_document_remark_count(document, SB_REMARK_NOTE), ==, merge);
    for (int again = 0; again < 2; again++) {
      g_assert_cmpint(sb_session_undo(session), ==, -1); // of no parameter
      assert_mine(session);
      g_assert_cmpuint(sb_document_remark_count(document, SB_REMARK_NOTE), ==, 1);
      g_assert_cmpint(sb_session_disk_state(session), ==, SB_DISK_CHANGED);
      sb_session_redo(session);
      g_assert_cmpfloat_with_epsilon(value(session, SB_P_DRIVE_SPEED), 30e-3 / 60, 1e-9);
    }
    if (merge) {
      g_assert_true(sb_session_save(session, NULL, NULL));
      g_autofree char *text = contents(files.scene);
      g_assert_nonnull(strstr(text, "# theirs\n[drive]\nspeed = 30 mm/min"));
      g_assert_nonnull(strstr(text, "modulus = 3.5 MPa"));
      g_assert_nonnull(strstr(text, "frames = 77"));
      g_assert_nonnull(strstr(text, "radial_space = 1.37 mm"));
    }
    // Edits from before it can still be taken back.
    sb_session_undo(session);
    sb_session_undo(session);
    g_assert_cmpfloat(value(session, SB_P_OUTPUT_FRAMES), !=, 77);
  }
  g_assert_cmpuint(issues->len, ==, 0);
  files_finish(&files);
}

static void test_keep_both(void) {
  Files files = files_new();
  g_autoptr(SbSession) session = conflict(&files);
  g_assert_true(sb_session_keep_both(session, NULL));
  const SbDocument *document = sb_session_document(session);
  g_assert_true(g_str_has_suffix(sb_document_path(document), "/a (2).scene"));
  g_autofree char *there = contents(files.scene);
  g_assert_cmpstr(there, ==, theirs);
  g_autofree char *copy = contents(sb_document_path(document));
  g_assert_nonnull(strstr(copy, "modulus = 3.5 MPa"));
  g_assert_false(sb_session_is_modified(session));
  g_assert_cmpint(sb_session_check_disk(session), ==, SB_DISK_SAME);
  sb_session_undo(session);
  assert_mine(session);
  g_assert_cmpstr(sb_document_path(sb_session_document(session)), ==, files.scene);
  g_assert_true(sb_session_keep_both(session, NULL));
  g_assert_true(g_str_has_suffix(sb_document_path(sb_session_document(session)), "/a (3).scene"));
  files_finish(&files);
}

// Unsaved changes are restored into what the file says by then.
static void test_restore_into_a_changed_file(void) {
  Files files = files_new();
  SbSession *before = conflict(&files);
  SbAutosave *autosave = sb_autosave_new(before);
  sb_autosave_write(autosave);
  g_autofree char *in = g_build_filename(g_get_user_data_dir(), "sealbench", "unsaved", NULL);
  g_autoptr(GDir) dir = g_dir_open(in, 0, NULL);
  g_autofree char *file = g_build_filename(in, g_dir_read_name(dir), NULL);
  g_auto(SbUnsaved) unsaved = {0};
  g_assert_true(sb_autosave_read(&unsaved, file));
  g_assert_cmpstr(unsaved.path, ==, files.scene);
  g_assert_cmpstr(unsaved.base, ==, scene_text);
  g_assert_true(sb_unsaved_is_outdated(&unsaved));
  sb_autosave_free(autosave);
  g_object_unref(before);
  g_autoptr(SbSession) session = sb_session_new();
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(GPtrArray) conflicts = g_ptr_array_new_with_free_func(g_free);
  g_assert_true(
      sb_session_restore(session, unsaved.path, unsaved.base, unsaved.text, conflicts, issues));
  g_assert_cmpuint(conflicts->len, ==, 1);
  g_assert_cmpfloat_with_epsilon(value(session, SB_P_SEAL_MODULUS), 3.5e6, 1);
  g_assert_cmpfloat_with_epsilon(value(session, SB_P_DRIVE_SPEED), 30e-3 / 60, 1e-9);
  g_assert_cmpfloat(value(session, SB_P_OUTPUT_FRAMES), ==, 77);
  files_finish(&files);
}

static char *write_scene(const char *folder, const char *text) {
  char *path = g_build_filename(folder, "bad.scene", NULL);
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
  return path;
}

// Nothing is computed and nothing of an earlier run is shown; the failure names the error.
static void fails_with(SbSession *session, const char *error) {
  turn(session, 300);
  sb_session_start(session);
  turn(session, 50);
  g_assert_true(sb_session_is_faulty(session));
  g_assert_null(sb_session_model(session));
  g_assert_null(sb_session_run(session));
  g_assert_null(sb_session_summary(session));
  g_assert_cmpint(sb_session_state(session), ==, SB_SESSION_FAILED);
  if (strstr(sb_session_failure(session), error) == NULL) {
    g_error("%s", sb_session_failure(session));
  }
}

// Errors of a file are errors of the run: a missing valve, an unknown key, a value that cannot be
// read. The last is corrected by an edit, also after the file was saved.
static void test_faulty_files(void) {
  g_autoptr(SbSession) session = sb_session_new();
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autofree char *folder = g_dir_make_tmp("sealbench-test-XXXXXX", NULL);
  const char *assets = g_getenv("SEALBENCH_ASSETS");
  g_autofree char *good = g_build_filename(assets, "scenes", "quick-look.scene", NULL);
  g_assert_true(sb_session_open(session, good, issues));
  settle(session);
  g_autofree char *path =
      write_scene(folder, "[sealbench]\nformat = 1\nkind = scene\nvalve = missing.valve\n");
  g_assert_true(sb_session_open(session, path, issues));
  fails_with(session, "missing.valve");
  sb_session_edit(session, SB_P_GLAND_RADIAL_SPACE, "1.35 mm"); // does not bring the valve
  fails_with(session, "missing.valve");
  g_autofree char *text =
      g_strdup_printf("[sealbench]\nformat = 1\nkind = scene\nvalve = %s/valves/piston.valve\n"
                      "[seal]\nsection_diameter = 1.6 N\nfoo = 3\n",
                      assets);
  g_free(write_scene(folder, text));
  g_assert_true(sb_session_open(session, path, issues));
  fails_with(session, "foo: unknown key");
  *strstr(text, "foo") = '#';
  g_free(write_scene(folder, text));
  g_assert_true(sb_session_open(session, path, issues));
  fails_with(session, "section_diameter");
  sb_session_edit(session, SB_P_SEAL_SECTION_DIAMETER, "1.6 mm");
  g_assert_false(sb_session_is_faulty(session));
  settle(session);
  sb_session_undo(session);
  g_assert_true(sb_session_is_faulty(session));
  sb_session_redo(session);
  g_assert_true(sb_session_save(session, NULL, NULL));
  g_assert_false(sb_session_is_faulty(session));
  settle(session);
  // A case that cannot be read is corrected in the file; one that the values forbid, by an edit.
  *strstr(text, "[seal]") = '\0';
  g_autofree char *unread = g_strconcat(text, "[cases]\na = seal.modulus\n", NULL);
  g_free(write_scene(folder, unread));
  g_assert_true(sb_session_open(session, path, issues));
  sb_session_edit(session, SB_P_SEAL_MODULUS, "3 MPa");
  fails_with(session, "seal.modulus");
  g_autofree char *impossible =
      g_strconcat(text, "[cases]\na = stem.pressure_diameter = 7 mm\n", NULL);
  g_free(write_scene(folder, impossible));
  g_assert_true(sb_session_open(session, path, issues));
  fails_with(session, "the bore is smaller than the stem");
  sb_session_edit(session, SB_P_BORE_DIAMETER, "7.4 mm");
  g_assert_false(sb_session_is_faulty(session));
  g_remove(path);
  g_rmdir(folder);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  // Unsaved changes of these tests are not the user's.
  g_autofree char *home = g_dir_make_tmp("sealbench-session-XXXXXX", NULL);
  g_setenv("XDG_DATA_HOME", home, TRUE);
  g_test_add_func("/session/runs", test_runs);
  g_test_add_func("/session/save-refuses-a-changed-file", test_save_refuses_a_changed_file);
  g_test_add_func("/session/reload-and-merge", test_reload_and_merge);
  g_test_add_func("/session/keep-both", test_keep_both);
  g_test_add_func("/session/restore-into-a-changed-file", test_restore_into_a_changed_file);
  g_test_add_func("/session/fast-edits", test_fast_edits);
  g_test_add_func("/session/playhead-keeps-its-place", test_playhead_keeps_its_place);
  g_test_add_func("/session/cancelled-before-the-first-frame",
                  test_cancelled_before_the_first_frame);
  g_test_add_func("/session/pins", test_pins);
  g_test_add_func("/session/drawn-groove", test_drawn_groove);
  g_test_add_func("/session/another-document-forgets", test_another_document_forgets);
  g_test_add_func("/session/edit-before-the-first-frame", test_edit_before_the_first_frame);
  g_test_add_func("/session/gone-while-running", test_gone_while_running);
  g_test_add_func("/session/faulty-files", test_faulty_files);
  const int failed = g_test_run();
  g_autofree char *sealbench = g_build_filename(home, "sealbench", NULL);
  g_autofree char *unsaved = g_build_filename(sealbench, "unsaved", NULL);
  g_rmdir(unsaved);
  g_rmdir(sealbench);
  g_rmdir(home);
  return failed;
}
