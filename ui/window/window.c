// One window: puts the parts together, turns the session's state into the header and the
// sensitivity of actions, and asks before changes are lost.
#include "ui/window/window.h"

#include "app/session/param_list.h"
#include "ui/params/derived_panel.h"
#include "ui/params/gland_panel.h"
#include "ui/params/param_panel.h"
#include "ui/views/chart_column.h"
#include "ui/views/chart_view.h"
#include "ui/views/section_view.h"
#include "ui/views/style.h"
#include "ui/views/timeline_view.h"
#include "ui/window/autosave_offer.h"
#include "ui/window/calibrate_page.h"
#include "ui/window/design_page.h"
#include "ui/window/header_room.h"
#include "ui/window/message_strip.h"
#include "ui/window/model_switch.h"
#include "ui/window/paned_layout.h"
#include "ui/window/preferences.h"
#include "ui/window/propellants_page.h"
#include "ui/window/review.h"
#include "ui/window/status_bar.h"
#include "ui/window/thesis_page.h"
#include "ui/window/toast.h"
#include "ui/window/verdict_strip.h"
#include "ui/window/window_private.h"

#include <glib/gi18n.h>
#include <string.h>

G_DEFINE_TYPE(SbWindow, sb_window, GTK_TYPE_APPLICATION_WINDOW)

// The clock runs only while something moves ------------------------------------------------------

static gboolean on_window_tick(GtkWidget *widget, GdkFrameClock *clock, gpointer data) {
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
    window->tick = gtk_widget_add_tick_callback(GTK_WIDGET(window), on_window_tick, NULL, NULL);
  }
}

// State to header --------------------------------------------------------------------------------

static void set_window_enabled(SbWindow *window, const char *name, gboolean enabled) {
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
  set_window_enabled(window, "run-or-stop",
                     running || (sb_session_model(session) != NULL && errors == 0));
}

// Names the edit that an undo (or redo) button changes in its tooltip and accessible description.
static void show_edit(GtkWidget *button, const SbDocument *document, bool redo) {
  g_autofree char *what = sb_param_undo_text(document, redo);
  const char *plain = redo ? _("Redo (Ctrl+Shift+Z)") : _("Undo (Ctrl+Z)");
  g_autofree char *tip = what != NULL ? g_strdup_printf("%s\n%s", plain, what) : g_strdup(plain);
  gtk_widget_set_tooltip_text(button, tip);
  atk_object_set_description(gtk_widget_get_accessible(button), what != NULL ? what : "");
}

static void refresh_window(SbWindow *window) {
  const SbDocument *document = sb_session_document(window->session);
  refresh_titles(window);
  refresh_run_state(window);
  set_window_enabled(window, "undo", sb_document_can_undo(document));
  set_window_enabled(window, "redo", sb_document_can_redo(document));
  show_edit(window->undo_button, document, false);
  show_edit(window->redo_button, document, true);
  set_window_enabled(window, "previous-event", sb_session_run(window->session) != NULL);
  set_window_enabled(window, "next-event", sb_session_run(window->session) != NULL);
  set_window_enabled(window, "export", sb_session_may_keep(window->session));
  set_window_enabled(window, "pin", sb_session_may_pin(window->session));
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
  sb_section_view_listen(window->section, sb_window_on_chosen, window);
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
  g_signal_connect(window, "key-press-event", G_CALLBACK(sb_window_on_key), NULL);
  g_signal_connect(window, "delete-event", G_CALLBACK(on_delete), NULL);
  g_signal_connect_object(window->session, "params-changed", G_CALLBACK(refresh_window), window,
                          G_CONNECT_SWAPPED);
  g_signal_connect_object(window->session, "run-changed", G_CALLBACK(refresh_window), window,
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
  sb_window_add_actions(window);
  sb_style_window(GTK_WIDGET(window));
  sb_toast_attach(GTK_WINDOW(window));
  sb_review_attach(GTK_APPLICATION_WINDOW(window), window->session);

  add_parts(window);
  window->files = sb_window_files_new_for(GTK_WINDOW(window), window->session,
                                          GTK_MENU_BUTTON(window->recent_button));
  sb_section_view_add_start(window->section, sb_window_files_start(window->files));
  window->autosave = sb_autosave_new(window->session);
  g_signal_connect(window, "notify::is-active", G_CALLBACK(sb_window_on_active), NULL);
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
  refresh_window(window);
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
