// Shared by the files of the window: window.c (parts, state, life) and window_actions.c.
#pragma once

#include "app/session/autosave.h"
#include "app/session/session.h"
#include "ui/window/window.h"
#include "ui/window/window_files.h"

// The window. Its widgets belong to it as a container.
struct _SbWindow {
  GtkApplicationWindow parent_instance;
  SbSession *session; // owned
  // Children of the template (assets/ui/window.ui), with its names.
  GtkWidget *header, *document_title, *document_file, *pages, *switcher, *recent_button,
      *run_button, *run_icon, *run_label, *document_box, *export_label, *model_switch;
  GtkWidget *run_state_icon, *run_state_label, *run_progress;
  GtkWidget *undo_button, *redo_button, *valve_page, *columns, *views, *left_column, *centre_column,
      *right_column, *bottom;
  GtkWidget *panel;     // an SbParamPanel
  GtkWidget *section;   // sb_section_view_new()
  SbWindowFiles *files; // owned
  SbAutosave *autosave; // owned
  guint tick;           // callback of the frame clock; 0: none, nothing moves
  gint64 run_from;      // when the run in the header began [us]; 0: none
};

// Adds the actions "win.…" to the window, whose template is initialised.
void sb_window_add_actions(SbWindow *window);

// A handler of "notify::is-active": checks whether another program has changed the document's file.
void sb_window_on_active(SbWindow *window);

// The callback of sb_section_view_listen(): shows the row of a parameter (`typed` NULL), or passes
// the typed text to its field. `data` is the SbWindow.
void sb_window_on_chosen(void *data, SbParamId id, const char *typed);

// A handler of "key-press-event": keys of the playhead, unless a field is being typed into. Returns
// whether the key was handled.
gboolean sb_window_on_key(GtkWidget *widget, GdkEventKey *event, gpointer data);
