// The actions of the window, which its menus, buttons and shortcuts activate, and the keys of the
// playhead.
#include "ui/window/window_private.h"

#include "app/session/param_list.h"
#include "ui/params/param_panel.h"
#include "ui/params/param_row.h"
#include "ui/views/chart_view.h"
#include "ui/views/section_view.h"
#include "ui/window/export_dialog.h"
#include "ui/window/import_dialog.h"
#include "ui/window/study_window.h"
#include "ui/window/toast.h"

#include <glib/gi18n.h>
#include <string.h>

// Takes an edit back or makes it again: tells which, and shows its row.
static void go_back(SbWindow *window, bool redo) {
  g_autofree char *what = sb_param_undo_text(sb_session_document(window->session), redo);
  const int id = redo ? sb_session_redo(window->session) : sb_session_undo(window->session);
  if (what != NULL) {
    g_autofree char *text = g_strdup_printf(redo ? _("Done again: %s") : _("Undone: %s"), what);
    sb_toast_show(GTK_WINDOW(window), text, NULL, NULL, FALSE);
  }
  if (id >= 0) {
    sb_param_panel_show(SB_PARAM_PANEL(window->panel), (SbParamId)id);
  }
}

static void on_undo(GSimpleAction *action, GVariant *parameter, gpointer data) {
  go_back(data, false);
}

static void on_redo(GSimpleAction *action, GVariant *parameter, gpointer data) {
  go_back(data, true);
}

static void on_run_or_stop(GSimpleAction *action, GVariant *parameter, gpointer data) {
  SbSession *session = SB_WINDOW(data)->session;
  if (sb_session_state(session) == SB_SESSION_RUNNING) {
    sb_session_stop(session);
  } else {
    sb_session_start(session);
  }
}

static void on_search(GSimpleAction *action, GVariant *parameter, gpointer data) {
  gtk_widget_show(SB_WINDOW(data)->left_column);
  sb_param_panel_search(SB_PARAM_PANEL(SB_WINDOW(data)->panel));
}

static void on_next_error(GSimpleAction *action, GVariant *parameter, gpointer data) {
  SbWindow *window = data;
  int id = sb_session_first_error(window->session);
  if (id >= 0) {
    gtk_widget_show(window->left_column);
    sb_param_panel_reveal(SB_PARAM_PANEL(window->panel), (SbParamId)id);
  }
}

static void on_event(GSimpleAction *action, GVariant *parameter, gpointer data) {
  bool next = g_str_equal(g_action_get_name(G_ACTION(action)), "next-event");
  sb_session_step_event(SB_WINDOW(data)->session, next ? 1 : -1);
}

static void on_actions_pin(GSimpleAction *action, GVariant *parameter, gpointer data) {
  if (sb_session_pin(SB_WINDOW(data)->session)) { // refresh() follows
    sb_toast_show(GTK_WINDOW(data), _("This run is pinned for comparison with later runs."), NULL,
                  NULL, FALSE);
  }
}

static void on_auto_run(GSimpleAction *action, GVariant *state, gpointer data) {
  sb_session_set_auto_run(SB_WINDOW(data)->session, g_variant_get_boolean(state));
  g_simple_action_set_state(action, state);
}

static void on_actions_open(GSimpleAction *action, GVariant *parameter, gpointer data) {
  sb_window_files_open_dialog(SB_WINDOW(data)->files);
}

static void on_new(GSimpleAction *action, GVariant *parameter, gpointer data) {
  sb_window_files_new(SB_WINDOW(data)->files);
}

static void on_save(GSimpleAction *action, GVariant *parameter, gpointer data) {
  sb_window_files_save(SB_WINDOW(data)->files, FALSE);
}

static void on_file_changed(GSimpleAction *action, GVariant *parameter, gpointer data) {
  sb_window_files_resolve(SB_WINDOW(data)->files);
}

void sb_window_on_active(SbWindow *window) {
  if (gtk_window_is_active(GTK_WINDOW(window))) {
    (void)sb_session_check_disk(window->session);
  }
}

static void on_save_as(GSimpleAction *action, GVariant *parameter, gpointer data) {
  sb_window_files_save(SB_WINDOW(data)->files, TRUE);
}

// One of "zoom-in", "zoom-out", "zoom-fit".
static void on_zoom(GSimpleAction *action, GVariant *parameter, gpointer data) {
  const char *name = g_action_get_name(G_ACTION(action));
  int step = g_str_equal(name, "zoom-in") - g_str_equal(name, "zoom-out");
  sb_section_view_zoom(SB_WINDOW(data)->section, step);
}

static void on_cutaway(GSimpleAction *action, GVariant *parameter, gpointer data) {
  sb_section_view_toggle_cutaway(SB_WINDOW(data)->section);
}

// One of "turn-left", "turn-right", "turn-up", "turn-down".
static void on_turn(GSimpleAction *action, GVariant *parameter, gpointer data) {
  const char *name = g_action_get_name(G_ACTION(action));
  int right = g_str_equal(name, "turn-right") - g_str_equal(name, "turn-left");
  int up = g_str_equal(name, "turn-up") - g_str_equal(name, "turn-down");
  sb_section_view_turn(SB_WINDOW(data)->section, right, up);
}

static void on_copy_table(GSimpleAction *action, GVariant *parameter, gpointer data) {
  g_autofree char *text = sb_chart_view_stage_table(SB_WINDOW(data)->session);
  gtk_clipboard_set_text(gtk_clipboard_get(GDK_SELECTION_CLIPBOARD), text, -1);
  sb_toast_show(GTK_WINDOW(data), _("The data table is in the clipboard."), NULL, NULL, FALSE);
}

static void on_actions_export(GSimpleAction *action, GVariant *parameter, gpointer data) {
  sb_export_dialog_open(GTK_WINDOW(data), SB_WINDOW(data)->session);
}

static void on_import_measured(GSimpleAction *action, GVariant *parameter, gpointer data) {
  sb_import_measured(GTK_WINDOW(data), SB_WINDOW(data)->session, NULL);
}

static void on_import_scan(GSimpleAction *action, GVariant *parameter, gpointer data) {
  sb_import_scan(GTK_WINDOW(data), SB_WINDOW(data)->session, NULL);
}

static void on_import_drawing(GSimpleAction *action, GVariant *parameter, gpointer data) {
  sb_import_drawing(GTK_WINDOW(data), SB_WINDOW(data)->session, NULL);
}

static void on_studies(GSimpleAction *action, GVariant *parameter, gpointer data) {
  sb_study_window_open(GTK_WINDOW(data), SB_WINDOW(data)->session);
}

// GTK does not give back all of an overview of shortcuts: one serves all windows, made when it is
// first asked for.
static void on_shortcuts(GSimpleAction *action, GVariant *parameter, gpointer data) {
  static GtkWidget *overview;
  if (overview == NULL) {
    g_autoptr(GtkBuilder) builder = gtk_builder_new_from_resource("/org/sealbench/ui/shortcuts.ui");
    overview = GTK_WIDGET(gtk_builder_get_object(builder, "help_overlay"));
    g_object_add_weak_pointer(G_OBJECT(overview), (gpointer *)&overview);
    g_signal_connect(overview, "delete-event", G_CALLBACK(gtk_widget_hide_on_delete), NULL);
  }
  gtk_window_set_transient_for(GTK_WINDOW(overview), GTK_WINDOW(data));
  gtk_window_present(GTK_WINDOW(overview));
}

// The parameter's page in whose row the focus is, else the keys.
static void on_help(GSimpleAction *action, GVariant *parameter, gpointer data) {
  if (!sb_param_row_help(gtk_window_get_focus(GTK_WINDOW(data)))) {
    on_shortcuts(action, parameter, data);
  }
}

// Asks about unsaved changes on the way.
static void on_close(GSimpleAction *action, GVariant *parameter, gpointer data) {
  gtk_window_close(GTK_WINDOW(data));
}

void sb_window_on_chosen(void *data, SbParamId id, const char *typed) {
  SbWindow *window = data;
  if (typed == NULL) {
    sb_param_panel_show(SB_PARAM_PANEL(window->panel), id);
    return;
  }
  gtk_widget_show(window->left_column);
  sb_param_panel_reveal(SB_PARAM_PANEL(window->panel), id);
  GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(window));
  if (GTK_IS_ENTRY(focus)) {
    gtk_entry_set_text(GTK_ENTRY(focus), typed);
    gtk_editable_set_position(GTK_EDITABLE(focus), -1);
  }
}

gboolean sb_window_on_key(GtkWidget *widget, GdkEventKey *event, gpointer data) {
  SbWindow *window = SB_WINDOW(widget);
  GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(window));
  gboolean plain =
      (event->state & gtk_accelerator_get_default_mod_mask() & ~(guint)GDK_SHIFT_MASK) == 0;
  const char *page = gtk_stack_get_visible_child_name(GTK_STACK(window->pages));
  if (!plain || GTK_IS_ENTRY(focus) || GTK_IS_TEXT_VIEW(focus) || g_strcmp0(page, "valve") != 0) {
    return GDK_EVENT_PROPAGATE;
  }
  if (sb_section_view_key(window->section, event)) {
    return GDK_EVENT_STOP;
  }
  size_t count = 0;
  sb_session_frames(window->session, &count);
  switch (event->keyval) {
  case GDK_KEY_space:
    if (GTK_IS_BUTTON(focus) || GTK_IS_EXPANDER(focus) || GTK_IS_COMBO_BOX(focus)) {
      return GDK_EVENT_PROPAGATE;
    }
    sb_session_play(window->session, !sb_session_is_playing(window->session));
    return GDK_EVENT_STOP;
  case GDK_KEY_Left:
    sb_session_step(window->session, -1);
    return GDK_EVENT_STOP;
  case GDK_KEY_Right:
    sb_session_step(window->session, 1);
    return GDK_EVENT_STOP;
  case GDK_KEY_Home:
    sb_session_set_playhead(window->session, 0);
    return GDK_EVENT_STOP;
  case GDK_KEY_End:
    sb_session_set_playhead(window->session, count > 0 ? count - 1 : 0);
    return GDK_EVENT_STOP;
  case GDK_KEY_Escape:
    if (sb_session_state(window->session) == SB_SESSION_RUNNING) {
      sb_session_stop(window->session);
      return GDK_EVENT_STOP;
    }
    return GDK_EVENT_PROPAGATE;
  default:
    return GDK_EVENT_PROPAGATE;
  }
}

void sb_window_add_actions(SbWindow *window) {
  static const GActionEntry entries[] = {
      {.name = "open", .activate = on_actions_open},
      {.name = "new", .activate = on_new},
      {.name = "save", .activate = on_save},
      {.name = "save-as", .activate = on_save_as},
      {.name = "file-changed", .activate = on_file_changed},
      {.name = "undo", .activate = on_undo},
      {.name = "redo", .activate = on_redo},
      {.name = "search", .activate = on_search},
      {.name = "next-error", .activate = on_next_error},
      {.name = "run-or-stop", .activate = on_run_or_stop},
      {.name = "previous-event", .activate = on_event},
      {.name = "next-event", .activate = on_event},
      {.name = "zoom-in", .activate = on_zoom},
      {.name = "zoom-out", .activate = on_zoom},
      {.name = "zoom-fit", .activate = on_zoom},
      {.name = "cutaway", .activate = on_cutaway},
      {.name = "turn-left", .activate = on_turn},
      {.name = "turn-right", .activate = on_turn},
      {.name = "turn-up", .activate = on_turn},
      {.name = "turn-down", .activate = on_turn},
      {.name = "export", .activate = on_actions_export},
      {.name = "import-measured", .activate = on_import_measured},
      {.name = "import-scan", .activate = on_import_scan},
      {.name = "import-drawing", .activate = on_import_drawing},
      {.name = "studies", .activate = on_studies},
      {.name = "close", .activate = on_close},
      {.name = "help", .activate = on_help},
      {.name = "show-help-overlay", .activate = on_shortcuts},
      {.name = "copy-table", .activate = on_copy_table},
      {.name = "pin", .activate = on_actions_pin},
      {.name = "auto-run", .state = "true", .change_state = on_auto_run},
  };
  g_action_map_add_action_entries(G_ACTION_MAP(window), entries, G_N_ELEMENTS(entries), window);

  g_autoptr(GPropertyAction) page =
      g_property_action_new("page", window->pages, "visible-child-name");
  g_action_map_add_action(G_ACTION_MAP(window), G_ACTION(page));

  // What can be hidden has an action of its own.
  const struct {
    const char *name;
    GtkWidget *panel;
  } panels[] = {{"show-parameters", window->left_column},
                {"show-charts", window->right_column},
                {"show-timeline", window->bottom}};
  for (guint i = 0; i < G_N_ELEMENTS(panels); i++) {
    g_autoptr(GPropertyAction) shown =
        g_property_action_new(panels[i].name, panels[i].panel, "visible");
    g_action_map_add_action(G_ACTION_MAP(window), G_ACTION(shown));
  }
}
