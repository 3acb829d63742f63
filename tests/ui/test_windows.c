// Windows opened on scenes and closed again, while their run goes and after it, leave nothing
// behind: no window outlives its closing, and the memory in use stops growing. (Leaks that nothing
// points to are the sanitizers' to find; this finds what something still points to.)
#include "ui/window/application.h"
#include "ui/window/window.h"

#include <glib/gstdio.h>
#include <malloc.h>

enum { ROUNDS = 8, WARM_UP = 3 };

static const char *const scenes[] = {"thesis-cycle", "quick-look", "sliding-plate",
                                     "part-profiles"};

// Lets the main loop go on for a while.
static void turn(int milliseconds) {
  gint64 end = g_get_monotonic_time() + milliseconds * 1000;
  while (g_get_monotonic_time() < end) {
    if (!g_main_context_iteration(NULL, FALSE)) {
      g_usleep(1000);
    }
  }
}

static void open_and_close(SbApplication *application, const char *scene, int shown_for) {
  g_autofree char *path =
      g_strdup_printf("%s/scenes/%s.scene", g_getenv("SEALBENCH_ASSETS"), scene);
  g_autoptr(GFile) file = g_file_new_for_path(path);
  GtkWidget *window = sb_window_new(application);
  g_object_add_weak_pointer(G_OBJECT(window), (gpointer *)&window);
  sb_window_open(SB_WINDOW(window), file);
  gtk_window_present(GTK_WINDOW(window));
  turn(shown_for);
  g_assert_false(sb_window_is_fresh(SB_WINDOW(window)));
  gtk_window_close(GTK_WINDOW(window));
  // Timers that draw or describe hold nothing for long.
  for (int i = 0; i < 100 && window != NULL; i++) {
    turn(20);
  }
  g_assert_null(window);
}

static void test_closed_windows_are_gone(void) {
  g_autoptr(SbApplication) application = sb_application_new();
  g_application_set_flags(G_APPLICATION(application),
                          G_APPLICATION_NON_UNIQUE | G_APPLICATION_HANDLES_OPEN);
  g_autoptr(GError) error = NULL;
  g_assert_true(g_application_register(G_APPLICATION(application), NULL, &error));
  g_application_hold(G_APPLICATION(application));
  size_t in_use[ROUNDS];
  for (int round = 0; round < ROUNDS; round++) {
    for (guint i = 0; i < G_N_ELEMENTS(scenes); i++) {
      open_and_close(application, scenes[i], i % 2 == 0 ? 60 : 400);
    }
    turn(100);
    in_use[round] = mallinfo2().uordblks;
    g_test_message("round %d: %zu kB in use", round, in_use[round] / 1024);
  }
  // Caches of fonts, icons and style fill at first.
  size_t growth = in_use[ROUNDS - 1] - MIN(in_use[WARM_UP], in_use[ROUNDS - 1]);
  size_t windows = (ROUNDS - 1 - WARM_UP) * G_N_ELEMENTS(scenes);
  g_test_message("%zu kB a window", growth / windows / 1024);
  g_assert_cmpuint(growth / windows, <, 100 * 1024);
  g_application_release(G_APPLICATION(application));
}

int main(int argc, char **argv) {
  g_autofree char *folder = g_dir_make_tmp("sealbench-windows-XXXXXX", NULL);
  g_setenv("XDG_CONFIG_HOME", folder, TRUE);
  g_setenv("XDG_DATA_HOME", folder, TRUE);
  g_setenv("GTK_RECENT_FILES_ENABLED", "0", TRUE);
  gtk_init(&argc, &argv);
  g_test_init(&argc, &argv, NULL);
  // Services of a desktop may be missing; only a critical message is a defect.
  g_log_set_always_fatal(G_LOG_LEVEL_CRITICAL | G_LOG_FATAL_MASK);
  g_test_add_func("/windows/closed-windows-are-gone", test_closed_windows_are_gone);
  return g_test_run();
}
