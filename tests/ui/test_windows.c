// Windows opened on scenes and closed again, while their run goes and after it, leave nothing
// behind: no window outlives its closing, and the memory in use stops growing. (Leaks that nothing
// points to are the sanitizers' to find; this finds what something still points to.)
#include "app/export/export_job.h"
#include "tests/ui/widgets.h"
#include "ui/views/later.h"
#include "ui/window/application.h"
#include "ui/window/design_page.h"
#include "ui/window/import_dialog.h"
#include "ui/window/message_strip.h"
#include "ui/window/propellants_page.h"
#include "ui/window/toast.h"
#include "ui/window/window.h"

#include <glib/gstdio.h>
#include <malloc.h>
#include <unistd.h>

enum { ROUNDS = 8, WARM_UP = 3 };

static const char *const scenes[] = {"thesis-cycle", "quick-look", "sliding-plate",
                                     "part-profiles"};

// One for all tests: a process can register no second one on its bus.
static SbApplication *application;

// Lets the main loop go on for a while.
static void turn(int milliseconds) {
  gint64 end = g_get_monotonic_time() + milliseconds * 1000;
  while (g_get_monotonic_time() < end) {
    if (!g_main_context_iteration(NULL, FALSE)) {
      g_usleep(1000);
    }
  }
}

static void open_and_close(const char *scene, int shown_for) {
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
  size_t in_use[ROUNDS];
  for (int round = 0; round < ROUNDS; round++) {
    for (guint i = 0; i < G_N_ELEMENTS(scenes); i++) {
      open_and_close(scenes[i], i % 2 == 0 ? 60 : 400);
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
}

// Waits until the dialog may import, or may not.
static void wait_for(GtkDialog *dialog, gboolean ready) {
  GtkWidget *import = gtk_dialog_get_widget_for_response(dialog, GTK_RESPONSE_ACCEPT);
  for (int i = 0; i < 500 && gtk_widget_get_sensitive(import) != ready; i++) {
    turn(20);
  }
  g_assert_true(gtk_widget_get_sensitive(import) == ready);
}

static void on_exported(void *data) {
  *(gboolean *)data = TRUE;
}

// The size of the loop's picture as it is exported, with what was measured or without.
static gsize exported(SbSession *session, gboolean measured) {
  const SbDocument *document = sb_session_document(session);
  g_autofree char *path = g_build_filename(g_getenv("XDG_DATA_HOME"), "loop.svg", NULL);
  SbExportRequest request = {.path = g_strdup(path),
                             .view = g_strdup("hysteresis"),
                             .width = 640,
                             .height = 480,
                             .measured =
                                 measured ? sb_data_copy(sb_document_data(document, 0)) : NULL,
                             .hash = g_strdup("")};
  gboolean done = FALSE, good = FALSE;
  SbExportJob *job = sb_export_job_start(sb_session_handle(session), &request, on_exported, &done);
  for (int i = 0; i < 500 && !done; i++) {
    turn(20);
  }
  g_test_message("%s", sb_export_job_result(job, &good));
  g_assert_true(done && good);
  sb_export_job_free(job);
  g_autofree char *text = NULL;
  gsize length = 0;
  g_assert_true(g_file_get_contents(path, &text, &length, NULL));
  g_remove(path);
  return length;
}

// What is recognised fills the choices; one that is wrong is told, taken back it is found again;
// what is imported stands in the document and its text, and beside the run.
static void test_import(void) {
  g_autoptr(SbSession) session = sb_session_new();
  g_autofree char *loop = g_strdup_printf("%s/series/bench.csv", g_getenv("SEALBENCH_ASSETS"));
  g_autofree char *scene =
      g_strdup_printf("%s/scenes/quick-look.scene", g_getenv("SEALBENCH_ASSETS"));
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_assert_true(sb_session_open(session, scene, issues));
  GtkWidget *parent = gtk_window_new(GTK_WINDOW_TOPLEVEL);
  sb_import_measured(GTK_WINDOW(parent), session, loop);
  GtkDialog *dialog = open_dialog();
  wait_for(dialog, TRUE);
  GtkWidget *separator = named(dialog, "Separator", GTK_TYPE_WIDGET),
            *cycle = named(dialog, "Cycle", GTK_TYPE_WIDGET);
  g_autofree char *found = g_strdup(gtk_combo_box_get_active_id(GTK_COMBO_BOX(separator)));
  g_assert_nonnull(found);
  gtk_entry_set_text(GTK_ENTRY(cycle), "9");
  turn(500);
  wait_for(dialog, FALSE);
  g_assert_cmpstr(gtk_entry_get_text(GTK_ENTRY(cycle)), ==, "9");
  gtk_entry_set_text(GTK_ENTRY(cycle), "1");
  wait_for(dialog, TRUE);
  gtk_dialog_response(dialog, GTK_RESPONSE_ACCEPT);
  const SbDocument *document = sb_session_document(session);
  g_assert_cmpuint(sb_document_data_count(document), ==, 1);
  g_assert_true(sb_session_is_modified(session));
  for (int i = 0; i < 500 && sb_session_chart(session)->measured == NULL; i++) {
    turn(20);
  }
  g_assert_nonnull(sb_session_chart(session)->measured);
  g_assert_cmpuint(sb_session_chart(session)->measured->count, >, 100);
  g_assert_cmpuint(exported(session, TRUE), >, 3 * exported(session, FALSE) / 2);
  // Saved and read again it is the same; the name is as seen from there.
  g_autofree char *path = g_build_filename(g_getenv("XDG_DATA_HOME"), "measured.scene", NULL);
  g_assert_true(sb_session_save(session, path, NULL));
  g_assert_false(sb_session_is_modified(session));
  g_autoptr(SbDocument) again = sb_document_load(path, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  g_assert_cmpuint(sb_document_data_count(again), ==, 1);
  g_assert_cmpstr(sb_document_data(again, 0)->text[SB_DATA_SEPARATOR], ==, found);
  g_autoptr(SbMeasured) measured = sb_measured_read(sb_document_data(again, 0), 0, NULL, 0, issues);
  g_assert_nonnull(measured);
  g_assert_cmpuint(measured->count, ==, sb_session_measured(session)->count);
  g_remove(path);
  // A scan whose unit nothing says, until it is said.
  g_autofree char *scan = g_build_filename(g_getenv("XDG_DATA_HOME"), "scan.txt", NULL);
  GString *text = g_string_new(NULL);
  for (int i = 0; i < 64 * 64; i++) {
    g_string_append_printf(text, "%d%s", (i * 7919 + i * i * 31) % 997, i % 64 == 63 ? "\n" : " ");
  }
  g_assert_true(g_file_set_contents(scan, text->str, -1, NULL));
  g_string_free(text, TRUE);
  sb_import_scan(GTK_WINDOW(parent), session, scan);
  dialog = open_dialog();
  turn(300);
  wait_for(dialog, FALSE);
  gtk_entry_set_text(GTK_ENTRY(named(dialog, "Unit of heights", GTK_TYPE_WIDGET)), "nm");
  gtk_entry_set_text(GTK_ENTRY(named(dialog, "Distance of points", GTK_TYPE_WIDGET)), "1 um");
  wait_for(dialog, TRUE);
  const double before = sb_document_value(document, SB_P_SURFACE_GT_PRODUCT);
  gtk_dialog_response(dialog, GTK_RESPONSE_ACCEPT);
  g_assert_cmpfloat(sb_document_value(document, SB_P_SURFACE_GT_PRODUCT), !=, before);
  g_assert_true(sb_document_gives(document, SB_P_SURFACE_SIGMA));
  g_remove(scan);
  // A drawing waits until a body is a part, and tells what that changes.
  g_autofree char *drawing =
      g_strdup_printf("%s/../tests/fuzz/corpus/dxf/lines.dxf", g_getenv("SEALBENCH_ASSETS"));
  sb_import_drawing(GTK_WINDOW(parent), session, drawing);
  dialog = open_dialog();
  turn(300);
  wait_for(dialog, FALSE);
  gtk_entry_set_text(GTK_ENTRY(named(dialog, "Stem centre: body", GTK_TYPE_WIDGET)), "stem");
  wait_for(dialog, TRUE);
  const char *told = atk_object_get_description(
      gtk_widget_get_accessible(named(dialog, "Half-sections of the bodies", GTK_TYPE_WIDGET)));
  g_assert_nonnull(strstr(told, "1 stem: 62.83 mm³\n"));
  g_assert_nonnull(strstr(told, "stem.pressure_diameter: 5.794 mm → 4 mm\n"));
  gtk_entry_set_text(GTK_ENTRY(named(dialog, "Stem centre: body", GTK_TYPE_WIDGET)), "2");
  turn(500);
  wait_for(dialog, FALSE);
  gtk_dialog_response(dialog, GTK_RESPONSE_CANCEL);
  gtk_widget_destroy(parent);
}

// A point that was picked on a map is none once another document has taken the map away.
static void test_design_point_goes_with_its_map(void) {
  g_autoptr(SbSession) session = sb_session_new();
  g_autofree char *scene =
      g_strdup_printf("%s/scenes/thesis-cycle.scene", g_getenv("SEALBENCH_ASSETS"));
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_assert_true(sb_session_open(session, scene, issues));
  GtkWidget *window = gtk_window_new(GTK_WINDOW_TOPLEVEL);
  gtk_container_add(GTK_CONTAINER(window), sb_design_page_new(session));
  sb_toast_attach(GTK_WINDOW(window));
  gtk_widget_show_all(window);
  GtkWidget *map = named(window, "Map of the design", GTK_TYPE_WIDGET),
            *keep = named(window, "Save design", GTK_TYPE_WIDGET);
  g_assert_false(gtk_widget_get_sensitive(keep));
  // What a button's tooltip explains is not under it.
  GtkWidget *bounds = named(window, "Bounds", GTK_TYPE_WIDGET);
  g_assert_true(gtk_widget_get_has_tooltip(bounds));
  gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(bounds), TRUE);
  g_assert_false(gtk_widget_get_has_tooltip(bounds));
  gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(bounds), FALSE);
  g_assert_true(gtk_widget_get_has_tooltip(bounds));
  GdkEventKey up = {.type = GDK_KEY_PRESS, .keyval = GDK_KEY_Up};
  for (int i = 0; i < 500 && !gtk_widget_get_sensitive(keep); i++) {
    gboolean taken;
    turn(20);
    g_signal_emit_by_name(map, "key-press-event", &up, &taken);
  }
  g_assert_true(gtk_widget_get_sensitive(keep));
  gtk_button_clicked(GTK_BUTTON(keep));
  g_assert_cmpuint(sb_session_pin_count(session), ==, 1);
  sb_session_reset(session);
  g_assert_false(gtk_widget_get_sensitive(keep));
  gtk_button_clicked(GTK_BUTTON(keep));
  gtk_button_clicked(GTK_BUTTON(named(window, "Open design", GTK_TYPE_WIDGET)));
  g_assert_false(sb_session_is_modified(session));
  gtk_widget_destroy(window);
}

// What a run under way will replace is not told at once; what nothing replaces is.
static void test_message_strip(void) {
  g_autoptr(SbSession) session = sb_session_new();
  g_autofree char *scene =
      g_strdup_printf("%s/scenes/ring-cycle.scene", g_getenv("SEALBENCH_ASSETS"));
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_assert_true(sb_session_open(session, scene, issues));
  GtkWidget *window = gtk_window_new(GTK_WINDOW_TOPLEVEL), *strip = sb_message_strip_new(session);
  gtk_container_add(GTK_CONTAINER(window), strip);
  gtk_widget_show(window);
  for (int i = 0; i < 3000 && sb_session_state(session) != SB_SESSION_DONE; i++) {
    turn(10);
    sb_session_tick(session, g_get_monotonic_time());
  }
  const gboolean before = gtk_widget_get_visible(strip);
  sb_session_edit(session, SB_P_GLAND_RADIAL_SPACE, "1.364 mm");
  g_assert_true(sb_session_awaits(session));
  g_assert_true(gtk_widget_get_visible(strip) == before);
  sb_session_set_auto_run(session, FALSE);
  sb_session_stop(session);
  sb_session_edit(session, SB_P_GLAND_RADIAL_SPACE, "1.368 mm");
  g_assert_false(sb_session_awaits(session));
  g_assert_true(gtk_widget_get_visible(strip));
  gtk_widget_destroy(window);
}

static void count(gpointer data) {
  (*(int *)data)++;
}

typedef struct {
  SbLater later;
  GtkWidget *owner;
  int calls;
} Again;

static void call_again(gpointer data) {
  Again *again = data;
  g_assert_false(sb_later_is_due(&again->later));
  if (++again->calls < 3) {
    sb_later_ensure(&again->later, again->owner, 0, call_again, again);
  }
}

// A call runs once, can schedule the next one, is replaced or cancelled, and never runs after its
// owner was destroyed, although a reference keeps the owner's memory.
static void test_later(void) {
  g_autoptr(GtkWidget) owner = g_object_ref_sink(gtk_label_new(NULL));
  SbLater later = {0}, repeated = {0};
  int once = 0, often = 0;
  sb_later_set(&later, owner, 1, count, &once);
  sb_later_set(&later, owner, 0, count, &once);
  sb_later_ensure(&later, owner, 0, count, &once);
  g_assert_true(sb_later_is_due(&later));
  sb_later_repeat(&repeated, owner, 1, count, &often);
  while (often < 3) {
    turn(1);
  }
  g_assert_cmpint(once, ==, 1);
  g_assert_false(sb_later_is_due(&later));
  sb_later_set(&later, owner, 0, count, &once);
  sb_later_cancel(&later);
  sb_later_cancel(&later);
  Again again = {.owner = owner};
  sb_later_set(&again.later, owner, 0, call_again, &again);
  while (again.calls < 3) {
    turn(1);
  }
  sb_later_set(&later, owner, 0, count, &once);
  often = 0;
  gtk_widget_destroy(owner);
  g_assert_false(sb_later_is_due(&later) || sb_later_is_due(&repeated));
  turn(20);
  g_assert_cmpint(once, ==, 1);
  g_assert_cmpint(often, ==, 0);
}

// Pages that are destroyed while a change of their width waits to be shown leave no call behind. (A
// critical message of GTK ends this program.)
static void test_page_ends_with_its_calls(void) {
  GtkWidget *(*const make[])(SbSession *) = {sb_design_page_new, sb_propellants_page_new};
  g_autofree char *scene =
      g_strdup_printf("%s/scenes/quick-look.scene", g_getenv("SEALBENCH_ASSETS"));
  for (guint i = 0; i < G_N_ELEMENTS(make); i++) {
    g_autoptr(SbSession) session = sb_session_new();
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_assert_true(sb_session_open(session, scene, issues));
    GtkWidget *window = gtk_window_new(GTK_WINDOW_TOPLEVEL);
    g_autoptr(GtkWidget) page = g_object_ref_sink(make[i](session));
    gtk_container_add(GTK_CONTAINER(window), page);
    sb_toast_attach(GTK_WINDOW(window));
    gtk_widget_show_all(window);
    turn(50);
    static const int widths[] = {1900, 320, 1900, 320};
    for (guint k = 0; k < G_N_ELEMENTS(widths); k++) {
      gtk_widget_size_allocate(page, &(GtkAllocation){0, 0, widths[k], 900});
    }
    gtk_widget_destroy(window);
    turn(100);
  }
}

static guint window_count(void) {
  guint count = 0;
  for (GList *item = gtk_application_get_windows(GTK_APPLICATION(application)); item != NULL;
       item = item->next) {
    count += SB_IS_WINDOW(item->data);
  }
  return count;
}

// A file that has a window is raised by a second start, by whatever path it names the file. The
// window offers what to do once another program has written the file.
static void test_a_file_has_one_window(void) {
  g_autofree char *folder = g_dir_make_tmp("sealbench-window-XXXXXX", NULL);
  g_autofree char *path = g_build_filename(folder, "a.valve", NULL);
  g_autofree char *other = g_build_filename(folder, "b.valve", NULL);
  static const char text[] = "[sealbench]\nformat = 1\nkind = valve\n";
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
  g_assert_cmpint(symlink(path, other), ==, 0);
  const char *const paths[] = {path, path, other};
  for (guint i = 0; i < G_N_ELEMENTS(paths); i++) {
    g_autoptr(GFile) file = g_file_new_for_path(paths[i]);
    g_application_open(G_APPLICATION(application), &file, 1, "");
    turn(50);
    g_assert_cmpuint(window_count(), ==, 1);
  }
  GtkWidget *window = gtk_application_get_windows(GTK_APPLICATION(application))->data;
  SbSession *session = sb_window_session(SB_WINDOW(window));
  g_autofree char *changed = g_strconcat(text, "[gland]\nradial_space = 1.37 mm\n", NULL);
  g_assert_true(g_file_set_contents(path, changed, -1, NULL));
  g_assert_cmpint(sb_session_check_disk(session), ==, SB_DISK_CHANGED);
  GtkWidget *choose = named(window, "Choose…", GTK_TYPE_BUTTON);
  g_assert_true(gtk_widget_get_visible(choose));
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_assert_true(sb_session_reload(session, issues));
  g_assert_cmpstr(gtk_button_get_label(GTK_BUTTON(choose)), ==, "Choose…");
  g_assert_cmpint(sb_session_disk_state(session), ==, SB_DISK_SAME);
  gtk_widget_destroy(window);
  turn(50);
  g_unlink(other);
  g_unlink(path);
  g_rmdir(folder);
}

int main(int argc, char **argv) {
  g_autofree char *folder = g_dir_make_tmp("sealbench-windows-XXXXXX", NULL);
  g_setenv("XDG_CONFIG_HOME", folder, TRUE);
  g_setenv("XDG_DATA_HOME", folder, TRUE);
  g_setenv("XDG_CACHE_HOME", folder, TRUE);
  g_setenv("GTK_RECENT_FILES_ENABLED", "0", TRUE);
  gtk_init(&argc, &argv);
  g_test_init(&argc, &argv, NULL);
  // Services of a desktop may be missing; only a critical message is a defect.
  g_log_set_always_fatal(G_LOG_LEVEL_CRITICAL | G_LOG_FATAL_MASK);
  g_test_add_func("/windows/later", test_later);
  g_test_add_func("/windows/page-ends-with-its-calls", test_page_ends_with_its_calls);
  g_test_add_func("/windows/a-file-has-one-window", test_a_file_has_one_window);
  g_test_add_func("/windows/import", test_import);
  g_test_add_func("/windows/design-point", test_design_point_goes_with_its_map);
  g_test_add_func("/windows/message-strip", test_message_strip);
  g_test_add_func("/windows/closed-windows-are-gone", test_closed_windows_are_gone);
  application = start_application();
  const int failed = g_test_run();
  g_application_release(G_APPLICATION(application));
  g_object_unref(application);
  return failed;
}
