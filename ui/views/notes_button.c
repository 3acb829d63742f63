// See notes_button.h. A note is stored shortly after the last key and when the popover closes. The
// lists are rebuilt in an idle callback after their content has changed, so that no button is
// destroyed while its signal is handled.
#include "ui/views/notes_button.h"

#include "ui/views/later.h"
#include "ui/views/signals.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <string.h>

enum { TAKE_MS = 400, TEXT_WIDTH = 380, TEXT_HEIGHT = 110, LIST_HEIGHT = 200 };

// The name of the note on the whole, as files have it.
#define WHOLE "review"

// What a note may be on: its name in the file, and the design to be given that name, -1: none.
typedef struct {
  char *name;
  int unnamed_pin;
} Subject;

typedef struct {
  SbSession *session;
  GtkWidget *button, *popover, *on, *text, *problem, *list, *empty;
  GArray *subjects;  // of Subject, in the order of the list
  int subject;       // shown, -1: none
  char *shown;       // what the lists show
  SbLater later;     // refresh()
  SbLater take;      // stores the typed text
  gboolean unstored; // text was typed that is not stored
  gboolean filling;  // the text is being put there by us
} Notes;

static void subject_clear(gpointer data) {
  g_free(((Subject *)data)->name);
}

static Subject *subject_now(Notes *notes) {
  return notes->subject >= 0 && notes->subject < (int)notes->subjects->len
             ? &g_array_index(notes->subjects, Subject, notes->subject)
             : NULL;
}

// The text ----------------------------------------------------------------------------------------

static char *typed(Notes *notes) {
  GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(notes->text));
  GtkTextIter start, end;
  gtk_text_buffer_get_bounds(buffer, &start, &end);
  return g_strstrip(gtk_text_buffer_get_text(buffer, &start, &end, FALSE));
}

static void tell(Notes *notes, const char *problem) {
  gtk_label_set_text(GTK_LABEL(notes->problem), problem != NULL ? problem : "");
  gtk_widget_set_visible(notes->problem, problem != NULL);
}

// Puts what was typed where it belongs.
static void take(Notes *notes) {
  Subject *subject = subject_now(notes);
  sb_later_cancel(&notes->take);
  if (!notes->unstored || subject == NULL) {
    return;
  }
  g_autofree char *text = typed(notes);
  g_autoptr(GError) error = NULL;
  // A design that others are told apart from by its values gets them as its name now.
  if (subject->unnamed_pin >= 0 && *text != '\0') {
    const size_t pin = (size_t)subject->unnamed_pin;
    subject->unnamed_pin = -1;
    sb_session_rename_pin(notes->session, pin, subject->name);
  }
  const gboolean good = sb_session_put_remark(notes->session, SB_REMARK_NOTE, subject->name,
                                              *text != '\0' ? text : NULL, &error);
  notes->unstored = !good;
  g_autofree char *problem = good ? NULL : g_strdup_printf(_("Not stored: it %s"), error->message);
  tell(notes, problem);
}

static void on_take(gpointer data) {
  take(data);
}

static void on_typed(GtkTextBuffer *buffer, Notes *notes) {
  if (!notes->filling) {
    notes->unstored = TRUE;
    sb_later_set(&notes->take, notes->button, TAKE_MS, on_take, notes);
  }
}

static void fill_text(Notes *notes) {
  const Subject *subject = subject_now(notes);
  const char *text = subject != NULL ? sb_document_remark(sb_session_document(notes->session),
                                                          SB_REMARK_NOTE, subject->name)
                                     : NULL;
  notes->filling = TRUE;
  gtk_text_buffer_set_text(gtk_text_view_get_buffer(GTK_TEXT_VIEW(notes->text)),
                           text != NULL ? text : "", -1);
  notes->filling = FALSE;
  notes->unstored = FALSE;
  tell(notes, NULL);
}

static void on_subject(GtkComboBox *combo, Notes *notes) {
  if (!notes->filling) {
    take(notes);
    if (notes->unstored) { // it could not be stored
      notes->filling = TRUE;
      gtk_combo_box_set_active(combo, notes->subject);
      notes->filling = FALSE;
      return;
    }
    notes->subject = gtk_combo_box_get_active(combo);
    fill_text(notes);
  }
}

// The lists ---------------------------------------------------------------------------------------

static void add_subject(Notes *notes, const char *name, int unnamed_pin, const char *label) {
  const Subject subject = {g_strdup(name), unnamed_pin};
  g_array_append_val(notes->subjects, subject);
  gtk_combo_box_text_append_text(GTK_COMBO_BOX_TEXT(notes->on), label);
}

static gboolean is_subject(Notes *notes, const char *name) {
  for (guint i = 0; i < notes->subjects->len; i++) {
    if (strcmp(g_array_index(notes->subjects, Subject, i).name, name) == 0) {
      return TRUE;
    }
  }
  return FALSE;
}

// The whole, kept designs, bookmarks, and what else the file has.
static void fill_subjects(Notes *notes) {
  const Subject *before = subject_now(notes);
  g_autofree char *kept = g_strdup(before != NULL ? before->name : WHOLE);
  const SbDocument *document = sb_session_document(notes->session);
  notes->filling = TRUE;
  gtk_combo_box_text_remove_all(GTK_COMBO_BOX_TEXT(notes->on));
  g_array_set_size(notes->subjects, 0);
  add_subject(notes, WHOLE, -1, _("the whole"));
  for (size_t i = 0; i < sb_session_pin_count(notes->session); i++) {
    const char *given = sb_document_pin_name(document, i);
    const char *name = given != NULL ? given : sb_session_pin_name(notes->session, i);
    g_autofree char *label = g_strdup_printf(_("design: %s"), name);
    add_subject(notes, name, given != NULL ? -1 : (int)i, label);
  }
  for (int kind = 0; kind < SB_REMARK_KINDS; kind++) {
    for (size_t i = 0; i < sb_document_remark_count(document, (SbRemarkKind)kind); i++) {
      const char *name = sb_document_remark_name(document, (SbRemarkKind)kind, i);
      g_autofree char *label =
          kind == SB_REMARK_BOOKMARK ? g_strdup_printf(_("bookmark: %s"), name) : g_strdup(name);
      if (!is_subject(notes, name)) {
        add_subject(notes, name, -1, label);
      }
    }
  }
  notes->subject = 0;
  for (guint i = 0; i < notes->subjects->len; i++) {
    if (strcmp(g_array_index(notes->subjects, Subject, i).name, kept) == 0) {
      notes->subject = (int)i;
    }
  }
  gtk_combo_box_set_active(GTK_COMBO_BOX(notes->on), notes->subject);
  notes->filling = FALSE;
}

static const char *bookmark_of(GtkWidget *widget) {
  return g_object_get_data(G_OBJECT(widget), "bookmark");
}

static void set_bookmark(GtkWidget *widget, const char *name) {
  g_object_set_data_full(G_OBJECT(widget), "bookmark", g_strdup(name), g_free);
}

static void on_go(GtkWidget *button, Notes *notes) {
  const SbDocument *document = sb_session_document(notes->session);
  for (size_t i = 0; i < sb_document_remark_count(document, SB_REMARK_BOOKMARK); i++) {
    if (strcmp(sb_document_remark_name(document, SB_REMARK_BOOKMARK, i), bookmark_of(button)) ==
        0) {
      sb_session_show_time(notes->session, sb_document_bookmark(document, i));
      return;
    }
  }
}

static void on_drop(GtkWidget *button, Notes *notes) {
  sb_session_put_remark(notes->session, SB_REMARK_BOOKMARK, bookmark_of(button), NULL, NULL);
}

// Gives a bookmark, and the note on it, another name.
static void rename_bookmark(GtkWidget *entry, Notes *notes) {
  SbSession *session = notes->session;
  g_autofree char *from = g_strdup(bookmark_of(entry));
  g_autofree char *to = g_strstrip(g_strdup(gtk_entry_get_text(GTK_ENTRY(entry))));
  const SbDocument *document = sb_session_document(session);
  g_autofree char *time = g_strdup(sb_document_remark(document, SB_REMARK_BOOKMARK, from));
  g_autofree char *note = g_strdup(sb_document_remark(document, SB_REMARK_NOTE, from));
  if (time == NULL || strcmp(from, to) == 0) {
    return;
  }
  g_autoptr(GError) error = NULL;
  g_autofree char *problem = NULL;
  if (sb_document_remark(document, SB_REMARK_BOOKMARK, to) != NULL) {
    problem = g_strdup_printf(_("There is a bookmark “%s” already."), to);
  } else if (!sb_session_put_remark(session, SB_REMARK_BOOKMARK, to, time, &error)) {
    problem = g_strdup_printf(_("Not renamed: it %s"), error->message);
  } else {
    set_bookmark(entry, to);
    sb_session_put_remark(session, SB_REMARK_BOOKMARK, from, NULL, NULL);
    if (note != NULL) {
      sb_session_put_remark(session, SB_REMARK_NOTE, to, note, NULL);
      sb_session_put_remark(session, SB_REMARK_NOTE, from, NULL, NULL);
    }
  }
  if (problem != NULL) {
    gtk_entry_set_text(GTK_ENTRY(entry), from);
  }
  tell(notes, problem);
}

static gboolean on_name_left(GtkWidget *entry, GdkEvent *event, Notes *notes) {
  rename_bookmark(entry, notes);
  return GDK_EVENT_PROPAGATE;
}

static void add_bookmark(Notes *notes, size_t index) {
  const SbDocument *document = sb_session_document(notes->session);
  const char *name = sb_document_remark_name(document, SB_REMARK_BOOKMARK, index);
  GtkGrid *grid = GTK_GRID(notes->list);
  const int row = (int)index;
  GtkWidget *entry = gtk_entry_new();
  gtk_entry_set_text(GTK_ENTRY(entry), name);
  gtk_widget_set_hexpand(entry, TRUE);
  g_autofree char *spoken = g_strdup_printf(_("Name of %s"), name);
  sb_style_name(entry, spoken, NULL);
  set_bookmark(entry, name);
  g_signal_connect(entry, "activate", G_CALLBACK(rename_bookmark), notes);
  g_signal_connect(entry, "focus-out-event", G_CALLBACK(on_name_left), notes);
  gtk_grid_attach(grid, entry, 0, row, 1, 1);
  g_autofree char *time = g_strdup_printf(_("%.2f s"), sb_document_bookmark(document, index));
  GtkWidget *go = gtk_button_new_with_label(time);
  g_autofree char *going = g_strdup_printf(_("Go to %s"), name);
  sb_style_name(go, going, NULL);
  gtk_widget_set_tooltip_text(go, going);
  set_bookmark(go, name);
  g_signal_connect(go, "clicked", G_CALLBACK(on_go), notes);
  gtk_grid_attach(grid, go, 1, row, 1, 1);
  GtkWidget *drop = gtk_button_new_from_icon_name("window-close-symbolic", GTK_ICON_SIZE_MENU);
  g_autofree char *dropping = g_strdup_printf(_("Remove %s"), name);
  sb_style_name(drop, dropping, NULL);
  gtk_widget_set_tooltip_text(drop, dropping);
  gtk_button_set_relief(GTK_BUTTON(drop), GTK_RELIEF_NONE);
  set_bookmark(drop, name);
  g_signal_connect(drop, "clicked", G_CALLBACK(on_drop), notes);
  gtk_grid_attach(grid, drop, 2, row, 1, 1);
}

// All that the lists show, to see whether it has changed.
static char *shown_text(SbSession *session) {
  const SbDocument *document = sb_session_document(session);
  GString *text = g_string_new(NULL);
  for (size_t i = 0; i < sb_session_pin_count(session); i++) {
    const char *given = sb_document_pin_name(document, i);
    g_string_append_printf(text, "%s|%d\n", sb_session_pin_name(session, i), given != NULL);
  }
  for (int kind = 0; kind < SB_REMARK_KINDS; kind++) {
    for (size_t i = 0; i < sb_document_remark_count(document, (SbRemarkKind)kind); i++) {
      g_string_append_printf(text, "%d|%s|%g\n", kind,
                             sb_document_remark_name(document, (SbRemarkKind)kind, i),
                             kind == SB_REMARK_BOOKMARK ? sb_document_bookmark(document, i) : 0);
    }
  }
  return g_string_free(text, FALSE);
}

static void destroy(GtkWidget *widget, gpointer data) {
  gtk_widget_destroy(widget);
}

static void refresh(gpointer data) {
  Notes *notes = data;
  const SbDocument *document = sb_session_document(notes->session);
  char *text = shown_text(notes->session);
  if (g_strcmp0(text, notes->shown) != 0) {
    const size_t count = sb_document_remark_count(document, SB_REMARK_BOOKMARK);
    gtk_container_foreach(GTK_CONTAINER(notes->list), destroy, NULL);
    for (size_t i = 0; i < count; i++) {
      add_bookmark(notes, i);
    }
    gtk_widget_show_all(notes->list);
    gtk_widget_set_visible(notes->empty, count == 0);
    fill_subjects(notes);
    g_free(notes->shown);
    notes->shown = g_steal_pointer(&text);
  }
  g_free(text);
  // Another document, or another hand.
  const Subject *subject = subject_now(notes);
  const char *now = sb_document_remark(document, SB_REMARK_NOTE, subject->name);
  g_autofree char *here = typed(notes);
  if (!notes->unstored && strcmp(here, now != NULL ? now : "") != 0) {
    fill_text(notes);
  }
}

static void on_notes_change(Notes *notes) {
  sb_later_ensure(&notes->later, notes->button, 0, refresh, notes);
}

// Life --------------------------------------------------------------------------------------------

static void notes_free(gpointer data) {
  Notes *notes = data;
  g_array_unref(notes->subjects);
  g_free(notes->shown);
  g_free(notes);
}

static GtkWidget *scrolled(GtkWidget *child, int width, int least, int most) {
  GtkWidget *scroller = gtk_scrolled_window_new(NULL, NULL);
  gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_NEVER,
                                 GTK_POLICY_AUTOMATIC);
  gtk_scrolled_window_set_min_content_height(GTK_SCROLLED_WINDOW(scroller), least);
  gtk_scrolled_window_set_max_content_height(GTK_SCROLLED_WINDOW(scroller), most);
  gtk_scrolled_window_set_propagate_natural_height(GTK_SCROLLED_WINDOW(scroller), TRUE);
  gtk_widget_set_size_request(scroller, width, -1);
  gtk_container_add(GTK_CONTAINER(scroller), child);
  return scroller;
}

static GtkWidget *make_content(Notes *notes) {
  GtkWidget *rows = gtk_box_new(GTK_ORIENTATION_VERTICAL, 8);
  gtk_container_set_border_width(GTK_CONTAINER(rows), 12);
  GtkWidget *line = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
  gtk_container_add(GTK_CONTAINER(line), sb_style_label(_("Note on"), "sb-heading", 0));
  notes->on = gtk_combo_box_text_new();
  gtk_widget_set_hexpand(notes->on, TRUE);
  sb_style_name(notes->on, _("Note on"), NULL);
  g_signal_connect(notes->on, "changed", G_CALLBACK(on_subject), notes);
  gtk_container_add(GTK_CONTAINER(line), notes->on);
  gtk_container_add(GTK_CONTAINER(rows), line);
  notes->text = gtk_text_view_new();
  gtk_text_view_set_wrap_mode(GTK_TEXT_VIEW(notes->text), GTK_WRAP_WORD_CHAR);
  gtk_text_view_set_accepts_tab(GTK_TEXT_VIEW(notes->text), FALSE);
  g_object_set(notes->text, "left-margin", 6, "right-margin", 6, "top-margin", 4, NULL);
  sb_style_name(notes->text, _("Note"), NULL);
  g_signal_connect(gtk_text_view_get_buffer(GTK_TEXT_VIEW(notes->text)), "changed",
                   G_CALLBACK(on_typed), notes);
  GtkWidget *scroller = scrolled(notes->text, TEXT_WIDTH, TEXT_HEIGHT, 2 * TEXT_HEIGHT);
  gtk_scrolled_window_set_shadow_type(GTK_SCROLLED_WINDOW(scroller), GTK_SHADOW_IN);
  gtk_container_add(GTK_CONTAINER(rows), scroller);
  notes->problem = sb_style_label("", "sb-error", 0);
  gtk_widget_set_no_show_all(notes->problem, TRUE);
  gtk_widget_hide(notes->problem);
  gtk_container_add(GTK_CONTAINER(rows), notes->problem);
  gtk_container_add(GTK_CONTAINER(rows), sb_style_label(_("Bookmarks"), "sb-heading", 0));
  notes->empty = sb_style_label(_("None yet. Ctrl+B sets one at the playhead."), "sb-note", 0);
  gtk_widget_set_no_show_all(notes->empty, TRUE);
  gtk_container_add(GTK_CONTAINER(rows), notes->empty);
  notes->list = gtk_grid_new();
  gtk_grid_set_row_spacing(GTK_GRID(notes->list), 4);
  gtk_grid_set_column_spacing(GTK_GRID(notes->list), 6);
  gtk_container_add(GTK_CONTAINER(rows), scrolled(notes->list, TEXT_WIDTH, -1, LIST_HEIGHT));
  GtkWidget *add = gtk_button_new_with_label(_("Bookmark here"));
  gtk_actionable_set_action_name(GTK_ACTIONABLE(add), "win.bookmark");
  gtk_widget_set_halign(add, GTK_ALIGN_START);
  gtk_container_add(GTK_CONTAINER(rows), add);
  gtk_widget_show_all(rows);
  return rows;
}

GtkWidget *sb_notes_button_new(SbSession *session) {
  Notes *notes = g_new0(Notes, 1);
  notes->session = session;
  notes->subject = -1;
  notes->subjects = g_array_new(FALSE, FALSE, sizeof(Subject));
  g_array_set_clear_func(notes->subjects, subject_clear);
  notes->button = sb_style_menu_button();
  g_object_set_data_full(G_OBJECT(notes->button), "notes", notes, notes_free);
  gtk_container_add(GTK_CONTAINER(notes->button),
                    gtk_image_new_from_icon_name("document-edit-symbolic", GTK_ICON_SIZE_BUTTON));
  gtk_widget_set_tooltip_text(notes->button, _("Notes and bookmarks"));
  sb_style_name(notes->button, _("Notes and bookmarks"), NULL);
  gtk_menu_button_set_direction(GTK_MENU_BUTTON(notes->button), GTK_ARROW_UP);
  notes->popover = gtk_popover_new(notes->button);
  gtk_container_add(GTK_CONTAINER(notes->popover), make_content(notes));
  gtk_menu_button_set_popover(GTK_MENU_BUTTON(notes->button), notes->popover);
  g_signal_connect_swapped(notes->popover, "closed", G_CALLBACK(take), notes);
  sb_signals_end_with(notes->button, notes->session, notes);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(on_notes_change), notes);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(on_notes_change), notes);
  refresh(notes);
  return notes->button;
}
