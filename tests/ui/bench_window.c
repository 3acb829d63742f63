// What an edit and the playback take in the window: a scene of solved rings is opened, a field of
// it edited eight times as by the keyboard, and the cycle played. Wall times of whatever machine
// this is, with nothing beside it: `meson test --benchmark`.
//
// bench-window SCENE PARAMETER VALUE...
#include "app/run/process.h"
#include "app/session/session.h"
#include "tests/ui/widgets.h"
#include "ui/window/latency.h"
#include "ui/window/window.h"

#include <math.h>
#include <stdio.h>

// Limits: of the prediction, of the first run of the new values, of the main loop's own work while
// the cycle plays and of its delay while runs are solved [ms].
static const double PREDICTED = 16, SHOWN = 200, PLAYED = 16, DELAY = 50;

static int count, failed;

static gboolean on_time(gpointer data) {
  return G_SOURCE_CONTINUE;
}

static void wait_seconds(double seconds) {
  const gint64 end = g_get_monotonic_time() + (gint64)(seconds * G_USEC_PER_SEC);
  while (g_get_monotonic_time() < end) {
    g_main_context_iteration(NULL, TRUE);
  }
}

static gboolean is_whole(SbSession *session) {
  return sb_session_state(session) == SB_SESSION_DONE && !sb_session_shows_former(session) &&
         sb_session_grade(session) == SB_GRADE_WHOLE;
}

// Until the whole run is there, its rings are ready to be started from, and slopes are found.
static void settle(SbSession *session) {
  const gint64 end = g_get_monotonic_time() + 120 * (gint64)G_USEC_PER_SEC;
  while (!is_whole(session)) {
    g_main_context_iteration(NULL, TRUE);
    if (g_get_monotonic_time() > end) {
      g_error("no whole run after two minutes");
    }
  }
  wait_seconds(4);
}

static void judge(double value, double most, const char *text) {
  const gboolean good = value <= most; // not what was not measured
  failed += !good;
  printf("%s %d - %s: %.1f ms of %g\n", good ? "ok" : "not ok", ++count, text, value, most);
  fflush(stdout);
}

static void measure(GtkWidget *window, const char *parameter, char **values, int values_count) {
  SbSession *session = sb_window_session(SB_WINDOW(window));
  GtkWidget *entry = named(window, parameter, GTK_TYPE_ENTRY);
  SbLatency latency;
  settle(session);
  sb_latency_start();
  for (int i = 0; i < values_count; i++) {
    gtk_widget_grab_focus(entry);
    gtk_entry_set_text(GTK_ENTRY(entry), values[i]);
    wait_seconds(1.5); // slopes of the field that is entered are found
    sb_latency_reset();
    g_signal_emit_by_name(entry, "activate");
    while (sb_session_shows_former(session)) {
      g_main_context_iteration(NULL, TRUE);
    }
    wait_seconds(0.1);
    const SbEditLatency took = sb_session_latency(session);
    settle(session);
    g_autofree char *predicted = g_strdup_printf("%s, predicted", values[i]);
    g_autofree char *shown = g_strdup_printf("%s, solved and shown", values[i]);
    g_autofree char *delay = g_strdup_printf("%s, main loop's delay, 99th percentile", values[i]);
    sb_latency_measured(&latency);
    if (isnan(took.predicted)) {
      printf("ok %d - %s # SKIP solved before its slopes were known\n", ++count, predicted);
    } else {
      judge(1e3 * took.predicted, PREDICTED, predicted);
    }
    judge(1e3 * took.shown, SHOWN, shown);
    judge(latency.p99, DELAY, delay);
  }
  sb_session_play(session, TRUE);
  wait_seconds(1);
  sb_latency_reset();
  wait_seconds(5);
  sb_latency_measured(&latency);
  judge(latency.own_p99, PLAYED, "played, main loop's own work, 99th percentile");
}

int main(int argc, char **argv) {
  if (argc < 4) {
    fprintf(stderr, "usage: bench-window SCENE PARAMETER VALUE...\n");
    return 1;
  }
  sb_process_set_up(); // as the window's own main
  g_autofree char *folder = g_dir_make_tmp("sealbench-bench-XXXXXX", NULL);
  g_setenv("XDG_DATA_HOME", folder, TRUE);
  g_setenv("XDG_CACHE_HOME", folder, TRUE);
  g_setenv("XDG_CONFIG_HOME", folder, TRUE);
  g_setenv("GTK_RECENT_FILES_ENABLED", "0", TRUE);
  g_autoptr(SbApplication) application = start_application();
  GtkWidget *window = sb_window_new(application);
  g_autoptr(GFile) file = g_file_new_for_path(argv[1]);
  sb_window_open(SB_WINDOW(window), file);
  gtk_window_present(GTK_WINDOW(window));
  const guint timer = g_timeout_add(5, on_time, NULL); // what waits looks again
  measure(window, argv[2], argv + 3, argc - 3);
  g_source_remove(timer);
  gtk_widget_destroy(window);
  g_application_release(G_APPLICATION(application));
  printf("1..%d\n", count);
  return failed > 0;
}
