// A monkey at the window: random actions from a seed, among them edits good and bad, buttons,
// lists, switches, undo, pins, pages, wheel and pointer on the pictures. Nothing it does may end
// the program, raise a critical, or lose what was edited: in the end the unsaved document is what a
// restart would offer. With --log each state of the document is written down with its time, for
// who kills the program (tests/campaigns/monkey).
//
// test-ui-monkey [SEED [ACTIONS [LOG]]]
#include "app/run/process.h"
#include "app/session/autosave.h"
#include "tests/ui/widgets.h"
#include "ui/window/window.h"

#include <glib/gstdio.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SEED = 1, ACTIONS = 60, PARAMETERS_AT_ONCE = 12 };

static GRand *dice;
static FILE *states; // NULL: nobody asks
static GtkWidget *window;

static void turn(int milliseconds) {
  const gint64 end = g_get_monotonic_time() + milliseconds * 1000;
  do {
    while (g_main_context_iteration(NULL, FALSE) && g_get_monotonic_time() < end + 200000) {
    }
    g_usleep(500);
  } while (g_get_monotonic_time() < end);
}

// Whatever asks something is sent away, the one that waits for an answer first; another window is
// closed.
static gboolean send_away(gpointer data) {
  GtkWidget *grab = gtk_grab_get_current();
  GtkWidget *asks = grab != NULL ? gtk_widget_get_toplevel(grab) : NULL;
  if (GTK_IS_DIALOG(asks)) {
    gtk_dialog_response(GTK_DIALOG(asks), GTK_RESPONSE_CANCEL);
    return G_SOURCE_CONTINUE;
  }
  g_autolist(GtkWidget) tops = gtk_window_list_toplevels();
  for (GList *one = tops; one != NULL; one = one->next) {
    g_object_ref(one->data); // closing one may end another
  }
  for (GList *one = tops; one != NULL; one = one->next) {
    if (one->data == window || !gtk_widget_get_visible(one->data)) {
      continue;
    }
    if (GTK_IS_DIALOG(one->data)) {
      gtk_dialog_response(one->data, GTK_RESPONSE_CANCEL);
      break;
    }
    if (gtk_window_get_window_type(one->data) == GTK_WINDOW_TOPLEVEL) {
      gtk_window_close(one->data);
      break;
    }
  }
  return G_SOURCE_CONTINUE;
}

static void on_params(SbSession *session, gpointer data) {
  g_autofree char *text = sb_document_to_text(sb_session_document(session), NULL);
  g_autofree char *sum = g_compute_checksum_for_string(G_CHECKSUM_SHA256, text, -1);
  fprintf(states, "%.3f %s\n", 1e-6 * (double)g_get_real_time(), sum);
  fflush(states);
}

// With nothing to ask about the window would close, and all would end.
static gboolean on_delete(GtkWidget *widget, GdkEvent *event, gpointer data) {
  return !sb_session_is_modified(sb_window_session(SB_WINDOW(widget)));
}

// Actions ----------------------------------------------------------------------------------------

static void edit(SbSession *session) {
  static const SbParamId ids[PARAMETERS_AT_ONCE] = {
      SB_P_SEAL_SECTION_DIAMETER, SB_P_SEAL_INNER_DIAMETER,  SB_P_GLAND_RADIAL_SPACE,
      SB_P_GLAND_AXIAL_WIDTH,     SB_P_BORE_DIAMETER,        SB_P_CANISTER_PRESSURE,
      SB_P_SEAL_MODULUS,          SB_P_DRIVE_STROKE,         SB_P_DRIVE_SPEED,
      SB_P_OUTPUT_FRAMES,         SB_P_CANISTER_TEMPERATURE, SB_P_STEM_PRESSURE_DIAMETER};
  static const char *const texts[] = {"",     "x",     "9 m", "-1",       "1,6",
                                      "+5 %", "1e400", "0",   "1.6 + 0.1"};
  const SbParamId id = ids[g_rand_int_range(dice, 0, PARAMETERS_AT_ONCE)];
  if (g_rand_int_range(dice, 0, 4) == 0) {
    sb_session_edit(session, id, texts[g_rand_int_range(dice, 0, G_N_ELEMENTS(texts))]);
    return;
  }
  const double value = sb_document_value(sb_session_document(session), id);
  sb_session_edit_value(session, id, value * g_rand_double_range(dice, 0.97, 1.03));
}

static void act(void) {
  static const char *const actions[] = {
      "undo",    "redo",     "undo",     "run-or-stop", "previous-event", "next-event",
      "zoom-in", "zoom-out", "zoom-fit", "cutaway",     "turn-left",      "turn-up",
      "pin",     "pin",      "search",   "next-error",  "copy-table",     "new",
      "save",    "open",     "export",   "studies",     "save-as"};
  const char *name = actions[g_rand_int_range(dice, 0, G_N_ELEMENTS(actions))];
  g_action_group_activate_action(G_ACTION_GROUP(window), name, NULL);
}

static void collect(GtkWidget *widget, gpointer data) {
  const gboolean taken = GTK_IS_BUTTON(widget) || GTK_IS_COMBO_BOX(widget) ||
                         GTK_IS_DRAWING_AREA(widget) || GTK_IS_ENTRY(widget);
  if (gtk_widget_get_mapped(widget) && gtk_widget_is_sensitive(widget)) {
    if (taken) {
      g_ptr_array_add(data, widget);
    }
    if (GTK_IS_CONTAINER(widget) && !GTK_IS_COMBO_BOX(widget)) {
      gtk_container_forall(GTK_CONTAINER(widget), collect, data);
    }
  }
}

static void pointer_event(GtkWidget *area, GdkEventType type, double x, double y) {
  GdkEvent *event = gdk_event_new(type);
  GdkSeat *seat = gdk_display_get_default_seat(gtk_widget_get_display(area));
  GdkWindow *of = gtk_widget_get_window(area);
  event->any.window = of != NULL ? g_object_ref(of) : NULL;
  gdk_event_set_device(event, gdk_seat_get_pointer(seat));
  if (type == GDK_MOTION_NOTIFY) {
    event->motion.x = x;
    event->motion.y = y;
    event->motion.state = GDK_BUTTON1_MASK;
  } else if (type == GDK_SCROLL) {
    event->scroll.x = x;
    event->scroll.y = y;
    event->scroll.direction = g_rand_boolean(dice) ? GDK_SCROLL_UP : GDK_SCROLL_DOWN;
  } else {
    event->button.x = x;
    event->button.y = y;
    event->button.button = 1;
  }
  gtk_widget_event(area, event);
  gdk_event_free(event);
}

static void use_pointer(GtkWidget *area) {
  const double width = gtk_widget_get_allocated_width(area);
  const double height = gtk_widget_get_allocated_height(area);
  double x = g_rand_double_range(dice, 0, width), y = g_rand_double_range(dice, 0, height);
  if (g_rand_int_range(dice, 0, 3) == 0) {
    pointer_event(area, GDK_SCROLL, x, y);
    return;
  }
  pointer_event(area, GDK_BUTTON_PRESS, x, y);
  for (int i = g_rand_int_range(dice, 0, 5); i > 0; i--) {
    x += g_rand_double_range(dice, -30, 30);
    y += g_rand_double_range(dice, -30, 30);
    pointer_event(area, GDK_MOTION_NOTIFY, x, y);
    turn(1);
  }
  pointer_event(area, GDK_BUTTON_RELEASE, x, y);
}

static void poke(void) {
  g_autoptr(GPtrArray) all = g_ptr_array_new();
  collect(window, all);
  if (all->len == 0) {
    return;
  }
  GtkWidget *widget = all->pdata[g_rand_int_range(dice, 0, (gint32)all->len)];
  if (GTK_IS_COMBO_BOX(widget)) {
    const int count =
        gtk_tree_model_iter_n_children(gtk_combo_box_get_model(GTK_COMBO_BOX(widget)), NULL);
    gtk_combo_box_set_active(GTK_COMBO_BOX(widget), g_rand_int_range(dice, 0, MAX(count, 1)));
  } else if (GTK_IS_DRAWING_AREA(widget)) {
    use_pointer(widget);
  } else if (GTK_IS_ENTRY(widget)) {
    gtk_widget_grab_focus(widget);
    gtk_entry_set_text(GTK_ENTRY(widget), g_rand_boolean(dice) ? "1.6" : "gland");
    g_signal_emit_by_name(widget, "activate");
  } else {
    gtk_button_clicked(GTK_BUTTON(widget));
  }
}

// An open menu takes all pointer events, so a user closes it before another widget can be used.
static void close_menu(void) {
  GtkWidget *grab = gtk_grab_get_current();
  if (GTK_IS_MENU_SHELL(grab)) {
    gtk_menu_shell_cancel(GTK_MENU_SHELL(grab));
  }
}

static void one_action(void) {
  close_menu();
  static const char *const pages[] = {"valve",     "valve",       "valve", "design",
                                      "calibrate", "propellants", "thesis"};
  SbSession *session = sb_window_session(SB_WINDOW(window));
  switch (g_rand_int_range(dice, 0, 20)) {
  case 0:
    g_action_group_change_action_state(
        G_ACTION_GROUP(window), "page",
        g_variant_new_string(pages[g_rand_int_range(dice, 0, G_N_ELEMENTS(pages))]));
    break;
  case 1:
  case 2:
  case 3:
    act();
    break;
  case 4: {
    const size_t pins = sb_session_pin_count(session);
    if (pins > 0) {
      const size_t one = (size_t)g_rand_int_range(dice, 0, (gint32)pins);
      switch (g_rand_int_range(dice, 0, 3)) {
      case 0:
        sb_session_use_pin(session, one);
        break;
      case 1:
        sb_session_draw_pin(session, one, g_rand_boolean(dice));
        break;
      default:
        sb_session_unpin(session, one);
      }
    }
    break;
  }
  case 5:
  case 6:
  case 7:
  case 8:
    edit(session);
    break;
  default:
    poke();
  }
}

// What a restart would offer is what is there, once the delay has passed.
static void check_kept(void) {
  SbSession *session = sb_window_session(SB_WINDOW(window));
  turn(SB_AUTOSAVE_DELAY + 300);
  g_autofree char *in = g_build_filename(g_get_user_data_dir(), "sealbench", "unsaved", NULL);
  g_autoptr(GDir) dir = g_dir_open(in, 0, NULL);
  const char *name = dir != NULL ? g_dir_read_name(dir) : NULL;
  g_assert_true((name != NULL) == sb_session_is_modified(session));
  if (name != NULL) {
    g_autofree char *file = g_build_filename(in, name, NULL);
    g_auto(SbUnsaved) kept = {0};
    g_assert_true(sb_autosave_read(&kept, file));
    g_autofree char *text = sb_document_to_text(sb_session_document(session), NULL);
    g_assert_cmpstr(kept.text, ==, text);
  }
}

// A copy of the shipped scenes, which the monkey may overwrite.
static char *copy_scene(const char *folder) {
  static const char *const files[] = {"valves/piston.valve", "scenes/thesis-cycle.scene"};
  for (guint i = 0; i < G_N_ELEMENTS(files); i++) {
    g_autofree char *from = g_build_filename(g_getenv("SEALBENCH_ASSETS"), files[i], NULL);
    g_autofree char *to = g_build_filename(folder, files[i], NULL);
    g_autofree char *in = g_path_get_dirname(to);
    g_autofree char *text = NULL;
    g_assert_cmpint(g_mkdir_with_parents(in, 0700), ==, 0);
    g_assert_true(g_file_get_contents(from, &text, NULL, NULL));
    g_assert_true(g_file_set_contents(to, text, -1, NULL));
  }
  return g_build_filename(folder, files[1], NULL);
}

int main(int argc, char **argv) {
  const guint32 seed = argc > 1 ? (guint32)g_ascii_strtoull(argv[1], NULL, 10) : SEED;
  const int actions = argc > 2 ? (int)g_ascii_strtoull(argv[2], NULL, 10) : ACTIONS;
  sb_process_set_up(); // as the window's own main
  g_autofree char *folder = g_dir_make_tmp("sealbench-monkey-XXXXXX", NULL);
  if (argc <= 3) { // else they are the caller's
    g_setenv("XDG_DATA_HOME", folder, TRUE);
    g_setenv("XDG_CACHE_HOME", folder, TRUE);
    g_setenv("XDG_CONFIG_HOME", folder, TRUE);
  }
  g_setenv("GTK_RECENT_FILES_ENABLED", "0", TRUE);
  g_log_set_always_fatal(G_LOG_LEVEL_CRITICAL | G_LOG_LEVEL_ERROR);
  dice = g_rand_new_with_seed(seed);
  g_autoptr(SbApplication) application = start_application();
  window = sb_window_new(application);
  g_signal_connect(window, "delete-event", G_CALLBACK(on_delete), NULL);
  g_autofree char *scene = copy_scene(folder);
  g_autoptr(GFile) file = g_file_new_for_path(scene);
  sb_window_open(SB_WINDOW(window), file);
  gtk_window_present(GTK_WINDOW(window));
  if (argc > 3) {
    states = fopen(argv[3], "a");
    g_signal_connect(sb_window_session(SB_WINDOW(window)), "params-changed", G_CALLBACK(on_params),
                     NULL);
    on_params(sb_window_session(SB_WINDOW(window)), NULL);
  }
  const guint away = g_timeout_add(20, send_away, NULL);
  turn(200);
  for (int i = 0; i < actions; i++) {
    one_action();
    turn(g_rand_int_range(dice, 0, 25) == 0 ? 60 : 1);
  }
  check_kept();
  g_source_remove(away);
  gtk_widget_destroy(window); // as the program ends: what still computes is cancelled and awaited
  turn(1);
  g_application_release(G_APPLICATION(application));
  printf("1..1\nok 1 - %d actions of seed %u\n", actions, seed);
  return 0;
}
