#include "ui/params/actions.h"

#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <string.h>

enum { SHOWN_MOST = 5, NEEDLE_LEAST = 2 }; // of letters, below which everything matches

static const SbAction table[] = {
    {"win.open", {"<Primary>o"}, N_("Open"), "load file scene valve"},
    {"win.new", {"<Primary>n"}, N_("_New"), "file scene valve"},
    {"win.save", {"<Primary>s"}, N_("Save"), "file keep"},
    {"win.save-as", {"<Primary><Shift>s"}, N_("Save _As…"), "file copy"},
    {"win.undo", {"<Primary>z"}, N_("Undo"), "back"},
    {"win.redo", {"<Primary><Shift>z", "<Primary>y"}, N_("Redo"), "again"},
    {"win.search", {"<Primary>f"}, NULL, NULL},
    {"win.next-error", {"F8"}, N_("Next error"), "problem fix"},
    {"win.run-or-stop", {"<Primary>r"}, N_("Run, or stop the run"), "solve compute start cancel"},
    {"win.auto-run", {NULL}, N_("Run _Again by Itself"), "automatic live"},
    {"win.export",
     {"<Primary>e"},
     N_("Export"),
     "picture png svg movie mp4 gif pdf csv json data step dxf stl vtu inp image animation"},
    {"win.report", {"<Primary><Shift>e"}, N_("_Report…"), "pdf print"},
    {"win.copy-table", {NULL}, N_("Copy _Data Table"), "clipboard csv"},
    {"win.import-measured",
     {NULL},
     N_("Import _Measured Data…"),
     "test machine curve csv load force displacement"},
    {"win.import-scan", {NULL}, N_("Import a S_can…"), "roughness surface sur gwy x3p sigma psd"},
    {"win.import-drawing", {NULL}, N_("Import a D_rawing…"), "cad dxf step stl part profile"},
    {"win.studies",
     {"<Primary>t"},
     N_("Studies"),
     "sweep grid monte carlo sobol morris tolerance squeeze leak stribeck"},
    {"win.page::valve", {"<Primary>1"}, N_("Page of the valve"), "section loop cycle"},
    {"win.page::design",
     {"<Primary>2"},
     N_("Page of the design"),
     "optimise optimize limits map tornado feasible gland"},
    {"win.page::calibrate",
     {"<Primary>3"},
     N_("Page of calibration"),
     "fit measured data posterior intervals"},
    {"win.page::propellants",
     {"<Primary>4"},
     N_("Page of propellants"),
     "hfa hfo 134a 227ea 152a 1234ze swap temperature fluid"},
    {"win.page::thesis", {"<Primary>5"}, N_("Page of the thesis"), "tables figures grimble"},
    {"win.pin", {"<Primary>p"}, N_("Pin this run"), "compare keep design"},
    {"win.bookmark", {"<Primary>b"}, N_("Add a bookmark"), "timeline mark"},
    {"win.clear-bookmarks", {NULL}, N_("Remove All Bookmar_ks"), "delete timeline"},
    {"win.present", {"F5"}, N_("Presentation"), "slides review big type"},
    {"win.full-screen", {"F11"}, N_("Full screen"), "window"},
    {"win.cutaway", {"<Primary>d"}, N_("Cutaway or section"), "3d view"},
    {"win.zoom-in", {"<Primary>plus", "<Primary>equal"}, N_("Zoom the section in"), NULL},
    {"win.zoom-out", {"<Primary>minus"}, N_("Zoom out"), NULL},
    {"win.zoom-fit", {"<Primary>0"}, N_("Full section"), "zoom reset fit"},
    {"win.turn-left", {"<Alt>Left"}, NULL, NULL},
    {"win.turn-right", {"<Alt>Right"}, NULL, NULL},
    {"win.turn-up", {"<Alt>Up"}, NULL, NULL},
    {"win.turn-down", {"<Alt>Down"}, NULL, NULL},
    {"win.previous-event", {"<Primary>Left"}, NULL, NULL},
    {"win.next-event", {"<Primary>Right"}, NULL, NULL},
    {"win.show-parameters", {"F9"}, N_("Parameters"), "hide panel show"},
    {"win.show-charts", {"<Shift>F9"}, N_("Charts"), "hide panel show loop film"},
    {"win.show-timeline", {"<Primary>F9"}, N_("Timeline and status"), "hide panel show"},
    {"app.theme::light", {NULL}, N_("Light"), "theme colours colors bright"},
    {"app.theme::dark", {NULL}, N_("Dark"), "theme colours colors night"},
    {"win.help", {"F1"}, NULL, NULL},
    {"win.show-help-overlay", {"<Primary>question"}, N_("Keyboard shortcuts"), "keys help"},
    {"app.about", {NULL}, N_("_About Sealbench"), "version licence"},
    {"win.close", {"<Primary>w"}, N_("Close the window"), NULL},
    {"app.quit", {"<Primary>q"}, N_("Quit"), "exit"},
};

const SbAction *sb_actions(size_t *count) {
  *count = G_N_ELEMENTS(table);
  return table;
}

// The title without its mnemonic.
static char *title_of(const SbAction *action) {
  g_auto(GStrv) part = g_strsplit(_(action->title), "_", 2);
  return g_strjoinv("", part);
}

static gboolean matches(const SbAction *action, const char *title, const char *needle) {
  g_autofree char *mine = g_utf8_casefold(title, -1);
  g_autofree char *english = g_utf8_casefold(action->title, -1);
  return strstr(mine, needle) != NULL || strstr(english, needle) != NULL ||
         (action->words != NULL && strstr(action->words, needle) != NULL);
}

static GtkWidget *button_of(const SbAction *action, const char *title) {
  GtkWidget *button = gtk_button_new();
  gtk_button_set_relief(GTK_BUTTON(button), GTK_RELIEF_NONE);
  gtk_actionable_set_detailed_action_name(GTK_ACTIONABLE(button), action->name);
  sb_style_name(button, title, _("Action"));
  GtkWidget *line = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
  GtkWidget *name = sb_style_label(title, "sb-derived-name", 0);
  gtk_label_set_ellipsize(GTK_LABEL(name), PANGO_ELLIPSIZE_END);
  gtk_box_pack_start(GTK_BOX(line), name, TRUE, TRUE, 0);
  if (action->accels[0] != NULL) {
    guint key;
    GdkModifierType state;
    gtk_accelerator_parse(action->accels[0], &key, &state);
    g_autofree char *keys = gtk_accelerator_get_label(key, state);
    gtk_box_pack_end(GTK_BOX(line), sb_style_label(keys, "sb-note", 1), FALSE, FALSE, 0);
  }
  gtk_container_add(GTK_CONTAINER(button), line);
  gtk_widget_show_all(button);
  return button;
}

GtkWidget *sb_action_finder_new(void) {
  GtkWidget *finder = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
  gtk_widget_set_no_show_all(finder, TRUE);
  return finder;
}

int sb_action_finder_search(GtkWidget *finder, const char *needle) {
  int found = 0;
  g_autoptr(GList) former = gtk_container_get_children(GTK_CONTAINER(finder));
  for (GList *item = former; item != NULL; item = item->next) {
    gtk_widget_destroy(item->data);
  }
  const gboolean asked = g_utf8_strlen(needle, -1) >= NEEDLE_LEAST;
  for (size_t i = 0; asked && i < G_N_ELEMENTS(table) && found < SHOWN_MOST; i++) {
    if (table[i].title == NULL) {
      continue;
    }
    g_autofree char *title = title_of(&table[i]);
    if (matches(&table[i], title, needle)) {
      gtk_box_pack_start(GTK_BOX(finder), button_of(&table[i], title), FALSE, FALSE, 0);
      found++;
    }
  }
  gtk_widget_set_visible(finder, found > 0);
  return found;
}
