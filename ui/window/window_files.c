// Opening and saving in a window. What is wrong with a file appears in one dialog with a line for
// each problem; a file that opened in spite of problems says so there too. A document that was
// opened from a path is saved back by way of a temporary file (app/document), so a failed save
// loses nothing.
#include "ui/window/window_files.h"

#include "ui/views/later.h"
#include "ui/views/style.h"
#include "ui/window/preferences.h"
#include "ui/window/toast.h"

#include "app/document/shipped.h"

#include <glib/gi18n.h>
#include <string.h>

struct SbWindowFiles {
  GtkWindow *window;  // borrowed: owns this
  SbSession *session; // borrowed
  SbLater later;      // a dialog that the user requested
  SbLater drop;       // opens `dropped`
  GFile *dropped;     // owned; NULL: no file was dropped
};

static gboolean save_file(SbWindowFiles *files, gboolean as);

enum { START_HEIGHT = 340 }; // of the files that a new window offers [px]

// Lines shown of a list of problems; more are counted.
enum { LINES_MAX = 12 };

static void show_file_message(SbWindowFiles *files, GtkMessageType type, const char *title,
                              const char *text) {
  GtkWidget *dialog =
      gtk_message_dialog_new(files->window, GTK_DIALOG_MODAL | GTK_DIALOG_DESTROY_WITH_PARENT, type,
                             GTK_BUTTONS_CLOSE, "%s", title);
  gtk_message_dialog_format_secondary_text(GTK_MESSAGE_DIALOG(dialog), "%s", text);
  g_signal_connect(dialog, "response", G_CALLBACK(gtk_widget_destroy), NULL);
  gtk_widget_show_all(dialog);
}

static char *lines_of(const GPtrArray *issues) {
  GString *text = g_string_new(NULL);
  for (guint i = 0; i < issues->len && i < LINES_MAX; i++) {
    g_autofree char *line = sb_issue_line(g_ptr_array_index(issues, i));
    g_string_append_printf(text, "%s%s", i > 0 ? "\n" : "", line);
  }
  if (issues->len > LINES_MAX) {
    g_string_append_printf(text,
                           ngettext("\nand %u more", "\nand %u more", issues->len - LINES_MAX),
                           issues->len - LINES_MAX);
  }
  return g_string_free(text, FALSE);
}

static void load_file(SbWindowFiles *files, GFile *file) {
  g_autofree char *path = g_file_get_path(file);
  if (path == NULL) {
    show_file_message(files, GTK_MESSAGE_ERROR, _("This file cannot be opened."),
                      _("Only files on this computer can be opened."));
    return;
  }
  g_autofree char *name = g_path_get_basename(path);
  g_autofree char *shown = g_filename_display_name(name);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  gboolean opened = sb_session_open(files->session, path, issues);
  if (issues->len > 0) {
    g_autofree char *title =
        g_strdup_printf(opened ? _("%s has errors. Nothing is computed until they are corrected.")
                               : _("%s cannot be opened."),
                        shown);
    g_autofree char *text = lines_of(issues);
    show_file_message(files, opened ? GTK_MESSAGE_WARNING : GTK_MESSAGE_ERROR, title, text);
  }
  if (opened) {
    g_autofree char *uri = g_file_get_uri(file);
    g_autofree char *folder = g_path_get_dirname(path);
    gtk_recent_manager_add_item(gtk_recent_manager_get_default(), uri);
    sb_preferences_set_string("folder", folder);
  }
}

// What a merge could not decide by itself.
static void show_conflicts(SbWindowFiles *files, const GPtrArray *conflicts) {
  if (conflicts->len > 0) {
    g_autoptr(GString) text = g_string_new(NULL);
    for (guint i = 0; i < conflicts->len && i < LINES_MAX; i++) {
      g_string_append_printf(text, "%s%s", i > 0 ? "\n" : "", (char *)conflicts->pdata[i]);
    }
    show_file_message(files, GTK_MESSAGE_INFO,
                      _("Both versions changed these values; yours are in force."), text->str);
  }
}

enum { RELOAD = 1, MERGE, ANSWER_KEEP_BOTH, SAVE_OVER };

// Asks what becomes of a file that another program changed. Saving can also replace it.
static int ask_disk(SbWindowFiles *files, gboolean saving) {
  const SbDocument *document = sb_session_document(files->session);
  const gboolean own = sb_session_disk_state(files->session) == SB_DISK_CHANGED;
  g_autofree char *name = g_filename_display_basename(own ? sb_document_path(document)
                                                          : sb_document_valve_path(document));
  GtkWidget *dialog = gtk_message_dialog_new(
      files->window, GTK_DIALOG_MODAL | GTK_DIALOG_DESTROY_WITH_PARENT, GTK_MESSAGE_QUESTION,
      GTK_BUTTONS_NONE, _("“%s” was changed by another program"), name);
  gtk_message_dialog_format_secondary_text(
      GTK_MESSAGE_DIALOG(dialog),
      _("Reload: this window shows the file; your unsaved changes are undone.\n"
        "Merge: the file's changes and yours, value by value.\n"
        "Keep both: your version becomes a new file next to it.\n\n"
        "Each of them can be undone."));
  gtk_dialog_add_button(GTK_DIALOG(dialog), _("_Cancel"), GTK_RESPONSE_CANCEL);
  if (saving) {
    gtk_dialog_add_button(GTK_DIALOG(dialog), _("_Replace the File"), SAVE_OVER);
  }
  if (own) {
    gtk_dialog_add_button(GTK_DIALOG(dialog), _("_Keep Both"), ANSWER_KEEP_BOTH);
  }
  gtk_dialog_add_button(GTK_DIALOG(dialog), _("Re_load"), RELOAD);
  gtk_dialog_add_button(GTK_DIALOG(dialog), _("_Merge"), MERGE);
  gtk_dialog_set_default_response(GTK_DIALOG(dialog), MERGE);
  const int answer = gtk_dialog_run(GTK_DIALOG(dialog));
  gtk_widget_destroy(dialog);
  return answer;
}

// Resolves it as the user wishes. TRUE: the document is saved as a file now.
static gboolean resolve_disk(SbWindowFiles *files, gboolean saving) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(GPtrArray) conflicts = g_ptr_array_new_with_free_func(g_free);
  g_autoptr(GError) error = NULL;
  gboolean good = TRUE, saved = FALSE;
  switch (ask_disk(files, saving)) {
  case RELOAD:
    saved = good = sb_session_reload(files->session, issues);
    break;
  case MERGE:
    good = sb_session_merge(files->session, conflicts, issues);
    saved = good && saving && sb_session_save(files->session, NULL, &error);
    good = error == NULL && good;
    break;
  case ANSWER_KEEP_BOTH:
    saved = good = sb_session_keep_both(files->session, &error);
    break;
  case SAVE_OVER:
    saved = good = sb_session_save_over(files->session, &error);
    break;
  default:
    break;
  }
  if (!good) {
    g_autofree char *text = error != NULL ? g_strdup(error->message) : lines_of(issues);
    show_file_message(files, GTK_MESSAGE_ERROR, _("Nothing was changed."), text);
  }
  show_conflicts(files, conflicts);
  return saved;
}

// Asks to save, discard or stay. True: go on.
gboolean sb_window_files_may_discard(SbWindowFiles *files) {
  if (!sb_session_is_modified(files->session)) {
    return TRUE;
  }
  GtkWidget *dialog =
      gtk_message_dialog_new(files->window, GTK_DIALOG_MODAL | GTK_DIALOG_DESTROY_WITH_PARENT,
                             GTK_MESSAGE_QUESTION, GTK_BUTTONS_NONE, _("Save the changes to “%s”?"),
                             sb_document_title(sb_session_document(files->session)));
  gtk_message_dialog_format_secondary_text(GTK_MESSAGE_DIALOG(dialog),
                                           _("They are lost if you do not save them."));
  gtk_dialog_add_buttons(GTK_DIALOG(dialog), _("Close _without Saving"), GTK_RESPONSE_NO,
                         _("_Cancel"), GTK_RESPONSE_CANCEL, _("_Save"), GTK_RESPONSE_YES, NULL);
  gtk_dialog_set_default_response(GTK_DIALOG(dialog), GTK_RESPONSE_YES);
  int answer = gtk_dialog_run(GTK_DIALOG(dialog));
  gtk_widget_destroy(dialog);
  if (answer == GTK_RESPONSE_YES) {
    return save_file(files, FALSE);
  }
  return answer == GTK_RESPONSE_NO;
}

// A picture that this program drew opens as its scene, but nothing is saved as one.
static void add_filters(GtkFileChooser *chooser, gboolean to_open) {
  static const struct {
    const char *name, *patterns[4];
  } filters[] = {{N_("Valves, scenes and projects"), {"*.valve", "*.scene", "*.project"}},
                 {N_("Valves, scenes, projects and pictures of them"),
                  {"*.valve", "*.scene", "*.project", "*.png"}},
                 {N_("All files"), {"*"}}};
  for (guint i = 0; i < G_N_ELEMENTS(filters); i++) {
    if (i < 2 && (i == 1) != to_open) {
      continue;
    }
    GtkFileFilter *filter = gtk_file_filter_new();
    gtk_file_filter_set_name(filter, _(filters[i].name));
    for (int k = 0; k < 4 && filters[i].patterns[k] != NULL; k++) {
      gtk_file_filter_add_pattern(filter, filters[i].patterns[k]);
    }
    gtk_file_chooser_add_filter(chooser, filter);
  }
}

static void ask_open(SbWindowFiles *files) {
  if (!sb_window_files_may_discard(files)) {
    return;
  }
  GtkWidget *dialog = gtk_file_chooser_dialog_new(
      _("Open a valve or scene"), files->window, GTK_FILE_CHOOSER_ACTION_OPEN, _("_Cancel"),
      GTK_RESPONSE_CANCEL, _("_Open"), GTK_RESPONSE_ACCEPT, NULL);
  gtk_dialog_set_default_response(GTK_DIALOG(dialog), GTK_RESPONSE_ACCEPT);
  add_filters(GTK_FILE_CHOOSER(dialog), TRUE);
  g_autofree char *folder = sb_preferences_string("folder", NULL);
  if (folder != NULL) {
    gtk_file_chooser_set_current_folder(GTK_FILE_CHOOSER(dialog), folder);
  }
  int answer = gtk_dialog_run(GTK_DIALOG(dialog));
  g_autoptr(GFile) file = gtk_file_chooser_get_file(GTK_FILE_CHOOSER(dialog));
  gtk_widget_destroy(dialog);
  if (answer == GTK_RESPONSE_ACCEPT && file != NULL) {
    load_file(files, file);
  }
}

void sb_window_files_open(SbWindowFiles *files, GFile *file) {
  if (sb_window_files_may_discard(files)) {
    load_file(files, file);
  }
}

static void make_new(SbWindowFiles *files) {
  if (sb_window_files_may_discard(files)) {
    sb_session_reset(files->session);
  }
}

// A name from the dialog, or NULL.
static char *ask_name(SbWindowFiles *files) {
  const SbDocument *document = sb_session_document(files->session);
  gboolean scene = sb_document_kind(document) == SB_DOCUMENT_SCENE;
  GtkWidget *dialog = gtk_file_chooser_dialog_new(
      _("Save as"), files->window, GTK_FILE_CHOOSER_ACTION_SAVE, _("_Cancel"), GTK_RESPONSE_CANCEL,
      _("_Save"), GTK_RESPONSE_ACCEPT, NULL);
  GtkFileChooser *chooser = GTK_FILE_CHOOSER(dialog);
  gtk_dialog_set_default_response(GTK_DIALOG(dialog), GTK_RESPONSE_ACCEPT);
  gtk_file_chooser_set_do_overwrite_confirmation(chooser, TRUE);
  add_filters(chooser, FALSE);
  const char *path = sb_document_path(document);
  if (path != NULL) {
    gtk_file_chooser_set_filename(chooser, path);
  } else {
    gtk_file_chooser_set_current_name(chooser, scene ? "untitled.scene" : "untitled.valve");
  }
  char *name = NULL;
  if (gtk_dialog_run(GTK_DIALOG(dialog)) == GTK_RESPONSE_ACCEPT) {
    name = gtk_file_chooser_get_filename(chooser);
  }
  gtk_widget_destroy(dialog);
  return name;
}

static gboolean save_file(SbWindowFiles *files, gboolean as) {
  g_autofree char *name = NULL;
  if (as || sb_document_path(sb_session_document(files->session)) == NULL) {
    name = ask_name(files);
    if (name == NULL) {
      return FALSE;
    }
  }
  g_autoptr(GError) error = NULL;
  if (!sb_session_save(files->session, name, &error)) {
    if (error->code == SB_APP_ERROR_CHANGED) {
      return resolve_disk(files, TRUE);
    }
    show_file_message(files, GTK_MESSAGE_ERROR, _("The file was not saved."), error->message);
    return FALSE;
  }
  if (name != NULL) {
    g_autofree char *uri = g_filename_to_uri(name, NULL, NULL);
    if (uri != NULL) {
      gtk_recent_manager_add_item(gtk_recent_manager_get_default(), uri);
    }
  }
  g_autofree char *shown =
      g_filename_display_basename(sb_document_path(sb_session_document(files->session)));
  g_autofree char *text = g_strdup_printf(_("%s is saved."), shown);
  sb_toast_show(files->window, text, NULL, NULL, FALSE);
  return TRUE;
}

// Dialogs run a loop of their own, which must not start inside a call from a screen reader; so each
// wish is granted from the main loop.
static void later(SbWindowFiles *files, void (*call)(gpointer data)) {
  sb_later_ensure(&files->later, files->window, 0, call, files);
}

static void open_now(gpointer data) {
  SbWindowFiles *files = data;
  ask_open(files);
}

static void new_now(gpointer data) {
  SbWindowFiles *files = data;
  make_new(files);
}

static void save_now(gpointer data) {
  SbWindowFiles *files = data;
  save_file(files, FALSE);
}

static void save_as_now(gpointer data) {
  SbWindowFiles *files = data;
  save_file(files, TRUE);
}

static void resolve_now(gpointer data) {
  (void)resolve_disk(data, FALSE);
}

void sb_window_files_resolve(SbWindowFiles *files) {
  later(files, resolve_now);
}

void sb_window_files_open_dialog(SbWindowFiles *files) {
  later(files, open_now);
}

void sb_window_files_new(SbWindowFiles *files) {
  later(files, new_now);
}

void sb_window_files_save(SbWindowFiles *files, gboolean as) {
  later(files, as ? save_as_now : save_now);
}

static void on_recent(GtkRecentChooser *chooser, SbWindowFiles *files) {
  g_autofree char *uri = gtk_recent_chooser_get_current_uri(chooser);
  if (uri != NULL) {
    g_autoptr(GFile) file = g_file_new_for_uri(uri);
    sb_window_files_open(files, file);
  }
}

static void on_example(GtkMenuItem *item, SbWindowFiles *files) {
  g_autoptr(GFile) file = g_file_new_for_path(g_object_get_data(G_OBJECT(item), "sb-path"));
  sb_window_files_open(files, file);
}

// The scenes that ship, by their titles.
static GtkWidget *examples_item(SbWindowFiles *files) {
  GtkWidget *item = gtk_menu_item_new_with_mnemonic(_("E_xamples")), *menu = gtk_menu_new();
  g_autoptr(GPtrArray) scenes = sb_shipped_files(SB_SHIPPED_SCENES);
  for (guint i = 0; i < scenes->len; i++) {
    const char *path = g_ptr_array_index(scenes, i);
    g_autofree char *title = sb_shipped_title(path);
    g_autofree char *name = g_path_get_basename(path);
    GtkWidget *each = gtk_menu_item_new_with_label(title);
    gtk_widget_set_tooltip_text(each, name);
    g_object_set_data_full(G_OBJECT(each), "sb-path", g_strdup(path), g_free);
    g_signal_connect(each, "activate", G_CALLBACK(on_example), files);
    gtk_menu_shell_append(GTK_MENU_SHELL(menu), each);
  }
  gtk_menu_item_set_submenu(GTK_MENU_ITEM(item), menu);
  gtk_widget_set_sensitive(item, scenes->len > 0);
  gtk_widget_show_all(item);
  return item;
}

static void on_start(GtkButton *button, SbWindowFiles *files) {
  g_autoptr(GFile) file = g_file_new_for_path(g_object_get_data(G_OBJECT(button), "sb-path"));
  sb_window_files_open(files, file);
}

// A heading and a grid of buttons, one a file.
static void add_files(GtkWidget *box, SbWindowFiles *files, const char *heading,
                      const GPtrArray *paths) {
  enum { COLUMNS = 4 };
  if (paths->len == 0) {
    return;
  }
  gtk_container_add(GTK_CONTAINER(box), sb_style_label(heading, "sb-heading", 0));
  GtkWidget *grid = gtk_grid_new();
  gtk_grid_set_column_spacing(GTK_GRID(grid), 8);
  gtk_grid_set_row_spacing(GTK_GRID(grid), 4);
  gtk_grid_set_column_homogeneous(GTK_GRID(grid), TRUE);
  for (guint i = 0; i < paths->len; i++) {
    const char *path = g_ptr_array_index(paths, i);
    g_autofree char *title = sb_shipped_title(path);
    GtkWidget *button = gtk_button_new_with_label(title);
    GtkWidget *label = gtk_bin_get_child(GTK_BIN(button));
    gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
    gtk_label_set_width_chars(GTK_LABEL(label), 17);
    gtk_label_set_max_width_chars(GTK_LABEL(label), 17);
    sb_style_class(button, "sb-choose");
    sb_style_name(button, title, path);
    g_object_set_data_full(G_OBJECT(button), "sb-path", g_strdup(path), g_free);
    g_signal_connect(button, "clicked", G_CALLBACK(on_start), files);
    gtk_grid_attach(GTK_GRID(grid), button, (int)i % COLUMNS, (int)i / COLUMNS, 1, 1);
  }
  gtk_container_add(GTK_CONTAINER(box), grid);
}

// Of this program's kinds, the last first.
static GPtrArray *recent_paths(void) {
  enum { RECENT_MAX = 6 };
  GPtrArray *paths = g_ptr_array_new_with_free_func(g_free);
  GList *items = gtk_recent_manager_get_items(gtk_recent_manager_get_default());
  for (GList *link = items; link != NULL && paths->len < RECENT_MAX; link = link->next) {
    const char *uri = gtk_recent_info_get_uri(link->data);
    g_autofree char *path = g_filename_from_uri(uri, NULL, NULL);
    if (path != NULL &&
        (g_str_has_suffix(path, ".scene") || g_str_has_suffix(path, ".valve") ||
         g_str_has_suffix(path, ".project")) &&
        g_file_test(path, G_FILE_TEST_IS_REGULAR)) {
      g_ptr_array_add(paths, g_steal_pointer(&path));
    }
  }
  g_list_free_full(items, (GDestroyNotify)gtk_recent_info_unref);
  return paths;
}

GtkWidget *sb_window_files_start(SbWindowFiles *files) {
  GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);
  gtk_widget_set_margin_top(box, 16);
  g_autoptr(GPtrArray) recent = recent_paths(), scenes = sb_shipped_files(SB_SHIPPED_SCENES);
  add_files(box, files, _("Recent files"), recent);
  add_files(box, files, _("Examples"), scenes);
  // Above the section; in a low window it scrolls.
  GtkWidget *scroller = gtk_scrolled_window_new(NULL, NULL);
  gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_AUTOMATIC,
                                 GTK_POLICY_AUTOMATIC);
  gtk_scrolled_window_set_propagate_natural_width(GTK_SCROLLED_WINDOW(scroller), TRUE);
  gtk_scrolled_window_set_propagate_natural_height(GTK_SCROLLED_WINDOW(scroller), TRUE);
  gtk_scrolled_window_set_max_content_height(GTK_SCROLLED_WINDOW(scroller), START_HEIGHT);
  gtk_container_add(GTK_CONTAINER(scroller), box);
  gtk_widget_show_all(scroller);
  return scroller;
}

static GtkWidget *recent_menu(SbWindowFiles *files) {
  GtkWidget *menu = gtk_recent_chooser_menu_new_for_manager(gtk_recent_manager_get_default());
  GtkRecentFilter *filter = gtk_recent_filter_new();
  gtk_recent_filter_add_pattern(filter, "*.valve");
  gtk_recent_filter_add_pattern(filter, "*.scene");
  gtk_recent_filter_add_pattern(filter, "*.project");
  gtk_recent_chooser_set_filter(GTK_RECENT_CHOOSER(menu), filter);
  gtk_recent_chooser_set_sort_type(GTK_RECENT_CHOOSER(menu), GTK_RECENT_SORT_MRU);
  gtk_recent_chooser_set_local_only(GTK_RECENT_CHOOSER(menu), TRUE);
  gtk_recent_chooser_set_limit(GTK_RECENT_CHOOSER(menu), 10);
  g_signal_connect(menu, "item-activated", G_CALLBACK(on_recent), files);
  // Recent files come and go behind it.
  gtk_menu_shell_prepend(GTK_MENU_SHELL(menu), examples_item(files));
  return menu;
}

static void open_dropped(gpointer data) {
  SbWindowFiles *files = data;
  g_autoptr(GFile) file = g_steal_pointer(&files->dropped);
  sb_window_files_open(files, file);
}

// A file dropped on the window. The question about unsaved changes must not run inside the drop.
static void on_drop(GtkWidget *widget, GdkDragContext *context, int x, int y,
                    GtkSelectionData *selection, guint info, guint time, SbWindowFiles *files) {
  g_auto(GStrv) uris = gtk_selection_data_get_uris(selection);
  gboolean good = uris != NULL && uris[0] != NULL;
  gtk_drag_finish(context, good, FALSE, time);
  if (good) {
    g_clear_object(&files->dropped);
    files->dropped = g_file_new_for_uri(uris[0]);
    sb_later_set(&files->drop, files->window, 0, open_dropped, files);
  }
}

SbWindowFiles *sb_window_files_new_for(GtkWindow *window, SbSession *session,
                                       GtkMenuButton *recent) {
  SbWindowFiles *files = g_new0(SbWindowFiles, 1);
  files->window = window;
  files->session = session;
  gtk_menu_button_set_popup(recent, recent_menu(files));
  gtk_drag_dest_set(GTK_WIDGET(window), GTK_DEST_DEFAULT_ALL, NULL, 0, GDK_ACTION_COPY);
  gtk_drag_dest_add_uri_targets(GTK_WIDGET(window));
  g_signal_connect(window, "drag-data-received", G_CALLBACK(on_drop), files);
  return files;
}

void sb_window_files_free(SbWindowFiles *files) {
  if (files != NULL) {
    g_signal_handlers_disconnect_by_data(files->window, files);
    sb_later_cancel(&files->later);
    sb_later_cancel(&files->drop);
    g_clear_object(&files->dropped);
    g_free(files);
  }
}
