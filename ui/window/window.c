// One window: puts the parts together, turns the session's state into the header and the
// sensitivity of actions, and asks before changes are lost.
#include "ui/window/window.h"
#include "ui/window/autosave_offer.h"

#include "app/base/translation.h"
#include "app/session/param_list.h"
#include "app/session/session.h"
#include "ui/params/derived_panel.h"
#include "ui/params/gland_panel.h"
#include "ui/params/param_panel.h"
#include "ui/params/param_row.h"
#include "ui/views/chart_column.h"
#include "ui/views/chart_view.h"
#include "ui/views/section_view.h"
#include "ui/views/style.h"
#include "ui/views/timeline_view.h"
#include "ui/window/calibrate_page.h"
#include "ui/window/design_page.h"
#include "ui/window/export_dialog.h"
#include "ui/window/header_room.h"
#include "ui/window/import_dialog.h"
#include "ui/window/message_strip.h"
#include "ui/window/model_switch.h"
#include "ui/window/paned_layout.h"
#include "ui/window/preferences.h"
#include "ui/window/propellants_page.h"
#include "ui/window/review.h"
#include "ui/window/status_bar.h"
#include "ui/window/study_window.h"
#include "ui/window/thesis_page.h"
#include "ui/window/toast.h"
#include "ui/window/verdict_strip.h"
#include "ui/window/window_files.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

struct _SbWindow {
  GtkApplicationWindow parent_instance;
  SbSession *session; // owned
  GtkWidget *header, *document_title, *document_file, *pages, *switcher, *recent_button,
      *run_button, *run_icon, *run_label, *document_box, *export_label, *model_switch;
  GtkWidget *run_state_icon, *run_state_label, *run_progress;
  GtkWidget *undo_button, *redo_button, *valve_page, *columns, *views, *left_column, *centre_column,
      *right_column, *bottom;
  GtkWidget *panel; // SbParamPanel
  GtkWidget *section;
  SbWindowFiles *files;
  SbAutosave *autosave;
  guint tick;
  gint64 run_from; // when the run of the header began, microseconds; 0: none
};

G_DEFINE_TYPE(SbWindow, sb_window, GTK_TYPE_APPLICATION_WINDOW)

// The clock runs only while something moves ------------------------------------------------------

static gboolean on_tick(GtkWidget *widget, GdkFrameClock *clock, gpointer data) {
  SbWindow *window = SB_WINDOW(widget);
  sb_session_tick(window->session, gdk_frame_clock_get_frame_time(clock));
  if (!sb_session_wants_ticks(window->session)) {
    window->tick = 0;
    return G_SOURCE_REMOVE;
  }
  return G_SOURCE_CONTINUE;
}

static void ensure_tick(SbWindow *window) {
  if (window->tick == 0 && sb_session_wants_ticks(window->session)) {
    window->tick = gtk_widget_add_tick_callback(GTK_WIDGET(window), on_tick, NULL, NULL);
  }
}

// State to header --------------------------------------------------------------------------------

static void set_enabled(SbWindow *window, const char *name, gboolean enabled) {
  GAction *action = g_action_map_lookup_action(G_ACTION_MAP(window), name);
  g_simple_action_set_enabled(G_SIMPLE_ACTION(action), enabled);
}

static void refresh_titles(SbWindow *window) {
  const SbDocument *document = sb_session_document(window->session);
  const char *path = sb_document_path(document);
  g_autofree char *file = path != NULL ? g_path_get_basename(path) : g_strdup(_("not saved yet"));
  g_autofree char *subtitle =
      g_strconcat(file, sb_session_is_modified(window->session) ? _(", edited") : "", NULL);
  g_autofree char *title =
      g_strdup_printf("%s (%s) – Sealbench", sb_document_title(document), subtitle);
  gtk_window_set_title(GTK_WINDOW(window), title);
  gtk_label_set_text(GTK_LABEL(window->document_title), sb_document_title(document));
  gtk_label_set_text(GTK_LABEL(window->document_file), subtitle);
}

// Of a run in grades what is done beside the shown one.
static char *running_text(SbSession *session) {
  const SbRunGrade shown =
      sb_session_shows_former(session) ? SB_GRADE_WHOLE : sb_session_grade(session);
  return g_strdup_printf(shown <= SB_GRADE_COARSE ? _("Refining %.0f %%")
                         : shown == SB_GRADE_NEAR || shown == SB_GRADE_STORED
                             ? _("Confirming %.0f %%")
                             : _("Running %.0f %%"),
                         100 * sb_session_progress(session));
}

// Shows the state of the run; NULL for each that it does not have.
static void show_run_state(SbWindow *window, const char *text, const char *style,
                           const char *icon) {
  GtkWidget *parts[] = {window->run_state_icon, window->run_state_label};
  for (guint i = 0; i < G_N_ELEMENTS(parts); i++) {
    GtkStyleContext *context = gtk_widget_get_style_context(parts[i]);
    gtk_style_context_remove_class(context, "sb-warn");
    gtk_style_context_remove_class(context, "sb-error");
    if (style != NULL) {
      gtk_style_context_add_class(context, style);
    }
  }
  gtk_widget_set_visible(window->run_state_icon, icon != NULL);
  if (icon != NULL) {
    gtk_image_set_from_icon_name(GTK_IMAGE(window->run_state_icon), icon, GTK_ICON_SIZE_MENU);
  }
  gtk_label_set_text(GTK_LABEL(window->run_state_label), text != NULL ? text : "");
}

static void refresh_run_state(SbWindow *window) {
  SbSession *session = window->session;
  SbSessionState state = sb_session_state(session);
  int errors = sb_session_error_count(session);
  gboolean running = state == SB_SESSION_RUNNING;
  if (!running || window->run_from == 0) {
    window->run_from = running ? g_get_monotonic_time() : 0;
  }
  g_autofree char *text = NULL;
  const char *style = NULL;
  const char *icon = NULL;
  if (running) {
    text = running_text(session);
  } else if (sb_session_is_faulty(session)) {
    text = g_strdup(_("The file has errors"));
    style = "sb-error";
    icon = "dialog-error-symbolic";
  } else if (errors > 0) {
    text = g_strdup_printf(
        sb_session_run(session) != NULL
            ? ngettext("Last good run, %d value to fix", "Last good run, %d values to fix", errors)
            : ngettext("%d value to fix", "%d values to fix", errors),
        errors);
    style = "sb-warn";
    icon = "dialog-warning-symbolic";
  } else if (state == SB_SESSION_FAILED) {
    text = g_strdup(_("Run failed"));
    style = "sb-error";
    icon = "dialog-error-symbolic";
  } else if (sb_session_shows_former(session)) {
    text = g_strdup(_("Earlier run"));
    style = "sb-warn";
    icon = "dialog-warning-symbolic";
  } else if (state == SB_SESSION_PARTIAL) {
    text = g_strdup(_("Partial run"));
    style = "sb-warn";
    icon = "dialog-warning-symbolic";
  }
  show_run_state(window, text, style, icon);
  gtk_widget_set_visible(window->run_progress, running);
  gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(window->run_progress),
                                running ? sb_session_progress(session) : 0);

  gtk_image_set_from_icon_name(GTK_IMAGE(window->run_icon),
                               running ? "media-playback-stop-symbolic"
                                       : "media-playback-start-symbolic",
                               GTK_ICON_SIZE_BUTTON);
  gtk_label_set_text(GTK_LABEL(window->run_label), running ? _("Stop") : _("Run"));
  sb_style_name(window->run_button, running ? _("Stop") : _("Run"), NULL);
  gtk_widget_set_tooltip_text(window->run_button,
                              running ? _("Stop the run and keep its results so far (Ctrl+R)")
                                      : _("Run the cycle with these values (Ctrl+R)"));
  set_enabled(window, "run-or-stop", running || (sb_session_model(session) != NULL && errors == 0));
}

// Names the edit that an undo (or redo) button changes in its tooltip and accessible description.
static void show_edit(GtkWidget *button, const SbDocument *document, bool redo) {
  g_autofree char *what = sb_param_undo_text(document, redo);
  const char *plain = redo ? _("Redo (Ctrl+Shift+Z)") : _("Undo (Ctrl+Z)");
  g_autofree char *tip = what != NULL ? g_strdup_printf("%s\n%s", plain, what) : g_strdup(plain);
  gtk_widget_set_tooltip_text(button, tip);
  atk_object_set_description(gtk_widget_get_accessible(button), what != NULL ? what : "");
}

static void refresh(SbWindow *window) {
  const SbDocument *document = sb_session_document(window->session);
  refresh_titles(window);
  refresh_run_state(window);
  set_enabled(window, "undo", sb_document_can_undo(document));
  set_enabled(window, "redo", sb_document_can_redo(document));
  show_edit(window->undo_button, document, false);
  show_edit(window->redo_button, document, true);
  set_enabled(window, "previous-event", sb_session_run(window->session) != NULL);
  set_enabled(window, "next-event", sb_session_run(window->session) != NULL);
  set_enabled(window, "export", sb_session_may_keep(window->session));
  set_enabled(window, "pin", sb_session_may_pin(window->session));
  ensure_tick(window);
}

// While frames come only the progress changes; of a run that is done in a moment not even that,
// which takes time from it.
static void on_frames(SbWindow *window) {
  static const gint64 MOMENT = G_USEC_PER_SEC / 4;
  if (sb_session_state(window->session) == SB_SESSION_RUNNING &&
      g_get_monotonic_time() - window->run_from > MOMENT) {
    double progress = sb_session_progress(window->session);
    g_autofree char *text = running_text(window->session);
    if (strcmp(gtk_label_get_text(GTK_LABEL(window->run_state_label)), text) != 0) {
      gtk_label_set_text(GTK_LABEL(window->run_state_label), text);
      gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(window->run_progress), progress);
    }
  }
  ensure_tick(window);
}

// Actions ----------------------------------------------------------------------------------------

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

static void on_pin(GSimpleAction *action, GVariant *parameter, gpointer data) {
  if (sb_session_pin(SB_WINDOW(data)->session)) { // refresh() follows
    sb_toast_show(GTK_WINDOW(data), _("This run is pinned for comparison with later runs."), NULL,
                  NULL, FALSE);
  }
}

static void on_auto_run(GSimpleAction *action, GVariant *state, gpointer data) {
  sb_session_set_auto_run(SB_WINDOW(data)->session, g_variant_get_boolean(state));
  g_simple_action_set_state(action, state);
}

static void on_open(GSimpleAction *action, GVariant *parameter, gpointer data) {
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

// The window has the focus again: another program may have written the file.
static void on_active(SbWindow *window) {
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

static void on_export(GSimpleAction *action, GVariant *parameter, gpointer data) {
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

// A handle on the section was taken: its row is shown, or takes what is typed.
static void on_chosen(void *data, SbParamId id, const char *typed) {
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

// Keys that belong to the playhead unless a field is being typed into.
static gboolean on_key(GtkWidget *widget, GdkEventKey *event, gpointer data) {
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

// Life -------------------------------------------------------------------------------------------

static gboolean on_delete(GtkWidget *widget, GdkEvent *event, gpointer data) {
  SbWindow *window = SB_WINDOW(widget);
  int width = 0;
  int height = 0;
  gtk_window_get_size(GTK_WINDOW(window), &width, &height);
  gboolean maximized = gtk_window_is_maximized(GTK_WINDOW(window));
  if (!maximized) {
    sb_preferences_set_int("width", width);
    sb_preferences_set_int("height", height);
  }
  sb_preferences_set_int("maximized", maximized);
  sb_preferences_set_int("parameters", (int)sb_param_panel_filter(SB_PARAM_PANEL(window->panel)));
  return !sb_window_files_may_discard(window->files);
}

static void dispose(GObject *object) {
  SbWindow *window = SB_WINDOW(object);
  g_clear_pointer(&window->autosave, sb_autosave_free);
  g_clear_pointer(&window->files, sb_window_files_free);
  G_OBJECT_CLASS(sb_window_parent_class)->dispose(object);
}

static void finalize(GObject *object) {
  g_clear_object(&SB_WINDOW(object)->session);
  G_OBJECT_CLASS(sb_window_parent_class)->finalize(object);
}

static void sb_window_class_init(SbWindowClass *class) {
  GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
  G_OBJECT_CLASS(class)->dispose = dispose;
  G_OBJECT_CLASS(class)->finalize = finalize;
  gtk_widget_class_set_template_from_resource(widget, "/org/sealbench/ui/window.ui");
#define CHILD(name) gtk_widget_class_bind_template_child(widget, SbWindow, name)
  CHILD(header);
  CHILD(document_title);
  CHILD(document_file);
  CHILD(pages);
  CHILD(switcher);
  CHILD(recent_button);
  CHILD(run_button);
  CHILD(run_icon);
  CHILD(run_label);
  CHILD(document_box);
  CHILD(export_label);
  CHILD(run_state_icon);
  CHILD(run_state_label);
  CHILD(run_progress);
  CHILD(undo_button);
  CHILD(redo_button);
  CHILD(valve_page);
  CHILD(columns);
  CHILD(views);
  CHILD(left_column);
  CHILD(centre_column);
  CHILD(right_column);
  CHILD(bottom);
#undef CHILD
}

static void add_actions(SbWindow *window) {
  static const GActionEntry entries[] = {
      {.name = "open", .activate = on_open},
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
      {.name = "export", .activate = on_export},
      {.name = "import-measured", .activate = on_import_measured},
      {.name = "import-scan", .activate = on_import_scan},
      {.name = "import-drawing", .activate = on_import_drawing},
      {.name = "studies", .activate = on_studies},
      {.name = "close", .activate = on_close},
      {.name = "help", .activate = on_help},
      {.name = "show-help-overlay", .activate = on_shortcuts},
      {.name = "copy-table", .activate = on_copy_table},
      {.name = "pin", .activate = on_pin},
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

// Fills the column of parameters, the one of the section and the bottom.
static void fill_columns(SbWindow *window) {
  window->panel = sb_param_panel_new(window->session);
  const int filter = sb_preferences_int("parameters", SB_PARAM_FILTER_MAIN);
  sb_param_panel_set_filter(SB_PARAM_PANEL(window->panel),
                            (SbParamFilter)CLAMP(filter, 0, SB_PARAM_FILTER_ALL));
  gtk_box_pack_start(GTK_BOX(window->left_column), window->panel, TRUE, TRUE, 0);
  gtk_box_pack_start(GTK_BOX(window->left_column), sb_derived_panel_new(window->session), FALSE,
                     FALSE, 0);
  gtk_box_pack_start(GTK_BOX(window->left_column), sb_gland_panel_new(window->session), FALSE,
                     FALSE, 0);
  gtk_box_pack_start(GTK_BOX(window->centre_column), sb_message_strip_new(window->session), FALSE,
                     FALSE, 0);
  window->section = sb_section_view_new(window->session);
  sb_section_view_listen(window->section, on_chosen, window);
  gtk_box_pack_start(GTK_BOX(window->centre_column), window->section, TRUE, TRUE, 0);
  // The charts of the valve's cycle at the right, what belongs to a kind of scene under the
  // section.
  sb_chart_column_fill(GTK_BOX(window->right_column), window->session);
  for (int kind = SB_CHART_VIEW_LIFE; kind <= SB_CHART_VIEW_REASONS; kind++) {
    sb_chart_column_add(GTK_BOX(window->centre_column), window->session, (SbChartViewKind)kind,
                        FALSE);
  }
  gtk_box_pack_start(GTK_BOX(window->bottom), sb_timeline_view_new(window->session), FALSE, FALSE,
                     0);
  gtk_box_pack_start(GTK_BOX(window->bottom), sb_status_bar_new(window->session), FALSE, FALSE, 0);
}

static void add_parts(SbWindow *window) {
  GtkWidget *charts = gtk_toggle_button_new();
  gtk_container_add(GTK_CONTAINER(charts),
                    gtk_image_new_from_icon_name("view-dual-symbolic", GTK_ICON_SIZE_BUTTON));
  gtk_widget_show_all(charts);
  gtk_widget_set_visible(charts, FALSE);
  gtk_widget_set_tooltip_text(charts, _("Charts next to the section"));
  sb_style_name(charts, _("Charts"), NULL);
  gtk_header_bar_pack_end(GTK_HEADER_BAR(window->header), charts);
  sb_paned_layout_attach(GTK_PANED(window->columns), GTK_PANED(window->views), charts);
  window->model_switch = sb_model_switch_new(window->session);
  gtk_header_bar_pack_end(GTK_HEADER_BAR(window->header), window->model_switch);
  GtkWidget *verdicts = sb_verdict_strip_new(window->session);
  gtk_box_pack_start(GTK_BOX(window->valve_page), verdicts, FALSE, FALSE, 0);
  gtk_box_reorder_child(GTK_BOX(window->valve_page), verdicts, 0);
  fill_columns(window);
  gtk_stack_add_titled(GTK_STACK(window->pages), sb_design_page_new(window->session), "design",
                       _("Design"));
  gtk_stack_add_titled(GTK_STACK(window->pages), sb_calibrate_page_new(window->session),
                       "calibrate", _("Calibrate"));
  gtk_stack_add_titled(GTK_STACK(window->pages), sb_propellants_page_new(window->session),
                       "propellants", _("Propellants"));
  // Without a title, and so without a tab, for which a narrow header has no room: by the menu.
  gtk_stack_add_named(GTK_STACK(window->pages), sb_thesis_page_new(), "thesis");
  g_autoptr(GList) tabs =
      gtk_container_get_children(GTK_CONTAINER(window->switcher)); // the last is hidden
  sb_style_name(GTK_WIDGET(g_list_last(tabs)->data), _("Thesis"), NULL);
}

static void connect_session(SbWindow *window) {
  g_signal_connect(window, "key-press-event", G_CALLBACK(on_key), NULL);
  g_signal_connect(window, "delete-event", G_CALLBACK(on_delete), NULL);
  g_signal_connect_object(window->session, "params-changed", G_CALLBACK(refresh), window,
                          G_CONNECT_SWAPPED);
  g_signal_connect_object(window->session, "run-changed", G_CALLBACK(refresh), window,
                          G_CONNECT_SWAPPED);
  g_signal_connect_object(window->session, "frames-changed", G_CALLBACK(on_frames), window,
                          G_CONNECT_SWAPPED);
  g_signal_connect_object(window->session, "progress-changed", G_CALLBACK(on_frames), window,
                          G_CONNECT_SWAPPED);
  g_signal_connect_object(window->session, "playhead-changed", G_CALLBACK(ensure_tick), window,
                          G_CONNECT_SWAPPED);
}

static void sb_window_init(SbWindow *window) {
  window->session = sb_session_new();
  gtk_widget_init_template(GTK_WIDGET(window));
  add_actions(window);
  sb_style_window(GTK_WIDGET(window));
  sb_toast_attach(GTK_WINDOW(window));
  sb_review_attach(GTK_APPLICATION_WINDOW(window), window->session);

  add_parts(window);
  window->files = sb_window_files_new_for(GTK_WINDOW(window), window->session,
                                          GTK_MENU_BUTTON(window->recent_button));
  sb_section_view_add_start(window->section, sb_window_files_start(window->files));
  window->autosave = sb_autosave_new(window->session);
  g_signal_connect(window, "notify::is-active", G_CALLBACK(on_active), NULL);
  sb_autosave_offer(window->session, window->autosave, GTK_WINDOW(window));

  connect_session(window);
  const SbHeaderParts parts = {{window->run_label, window->export_label},
                               window->document_box,
                               window->switcher,
                               window->run_progress,
                               window->model_switch};
  sb_header_room_attach(GTK_WIDGET(window), &parts, sb_preferences_int("width", 1600));
  gtk_window_set_default_size(GTK_WINDOW(window), sb_preferences_int("width", 1600),
                              sb_preferences_int("height", 1000));
  if (sb_preferences_int("maximized", 0)) {
    gtk_window_maximize(GTK_WINDOW(window));
  }
  refresh(window);
  sb_section_view_focus(window->section);
}

GtkWidget *sb_window_new(SbApplication *application) {
  return g_object_new(SB_TYPE_WINDOW, "application", application, NULL);
}

void sb_window_open(SbWindow *window, GFile *file) {
  sb_window_files_open(window->files, file);
}

gboolean sb_window_is_fresh(SbWindow *window) {
  return sb_document_path(sb_session_document(window->session)) == NULL &&
         !sb_session_is_modified(window->session);
}

SbSession *sb_window_session(SbWindow *window) {
  return window->session;
}
