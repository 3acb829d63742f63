// The column of parameters. The catalogue's order and the first part of each key make the groups;
// overrides for one ring get groups of their own, folded until something in them differs. Listed
// are the main ones, those that differ from their defaults, or all; a search goes over all.
// Whatever leaves rows out unfolds the groups of those that stay.
#include "ui/params/param_panel.h"

#include "app/session/effect_watch.h"
#include "app/session/param_list.h"
#include "ui/params/actions.h"
#include "ui/params/drawing_row.h"
#include "ui/params/param_row.h"
#include "ui/params/rubber_row.h"
#include "ui/views/later.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

typedef struct {
  const SbParamHeading *heading;
  GtkWidget *expander, *note;
  GtkWidget *box;
  gboolean unfolded; // as the user left it, while something unfolds all
} Group;

enum { MARKED_MS = 1500 }; // a row that was shown

struct _SbParamPanel {
  GtkBox parent_instance;
  SbSession *session;
  GtkWidget *search, *scroller, *list, *actions, *nothing, *goal;
  SbEffectWatch *effects; // NULL: nobody asks for them
  GtkWidget *filters[SB_PARAM_FILTER_ALL + 1];
  SbParamFilter filter;
  GtkWidget *row[SB_PARAM_COUNT];
  SbLater scroll, marked[SB_PARAM_COUNT];
  GtkWidget *rubber, *section, *groove; // the rows that are of no parameter
  int group_of[SB_PARAM_COUNT];
  GArray *groups;    // of Group
  int kind;          // of the valve whose main ones are listed
  gboolean narrowed; // rows are left out, and all groups unfolded
  gboolean refreshing;
};

G_DEFINE_TYPE(SbParamPanel, sb_param_panel, GTK_TYPE_BOX)

static Group *group_at(SbParamPanel *panel, int index) {
  return &g_array_index(panel->groups, Group, (guint)index);
}

// The group that a parameter belongs to, made on first use.
static int group_for(SbParamPanel *panel, SbParamId id) {
  const SbParamHeading *heading = sb_param_heading(id);
  for (guint g = 0; g < panel->groups->len; g++) {
    if (group_at(panel, (int)g)->heading == heading) {
      return (int)g;
    }
  }
  const char *title = _(heading->title);
  Group group = {.heading = heading};
  group.unfolded = heading->unfolded;
  GtkWidget *caption = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
  GtkWidget *name = gtk_label_new(title);
  gtk_label_set_xalign(GTK_LABEL(name), 0);
  gtk_box_pack_start(GTK_BOX(caption), name, TRUE, TRUE, 0);
  group.note = gtk_label_new(heading->note != NULL ? _(heading->note) : NULL);
  sb_style_class(group.note, "sb-group-note");
  gtk_box_pack_end(GTK_BOX(caption), group.note, FALSE, FALSE, 0);
  group.expander = gtk_expander_new(NULL);
  gtk_expander_set_label_widget(GTK_EXPANDER(group.expander), caption);
  gtk_expander_set_label_fill(GTK_EXPANDER(group.expander), TRUE);
  gtk_expander_set_expanded(GTK_EXPANDER(group.expander), group.unfolded);
  sb_style_name(group.expander, title, NULL);
  sb_style_class(name, "sb-group");
  gtk_widget_set_hexpand(caption, TRUE);
  group.box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 2);
  gtk_widget_set_margin_start(group.box, 22);
  gtk_widget_set_margin_bottom(group.box, 4);
  gtk_container_add(GTK_CONTAINER(group.expander), group.box);
  gtk_box_pack_start(GTK_BOX(panel->list), group.expander, FALSE, FALSE, 0);
  g_array_append_val(panel->groups, group);
  return (int)panel->groups->len - 1;
}

static gboolean is_listed(SbParamPanel *panel, const SbParams *params, const char *needle,
                          SbParamId id) {
  return needle[0] != '\0' ? sb_param_matches(id, needle)
         : panel->filter == SB_PARAM_FILTER_MAIN
             ? sb_param_is_main(id, (int)sb_params_get(params, SB_P_VALVE_KIND))
         : panel->filter == SB_PARAM_FILTER_CHANGED ? sb_param_is_changed(params, id)
                                                    : TRUE;
}

// Whether a search finds the row of a key with a text (SbFileKey; SB_FILE_COUNT: the rubber).
static gboolean is_found(int key, const char *words, const char *needle) {
  return strstr(sb_document_text_keys()[key].key, needle) != NULL || strstr(words, needle) != NULL;
}

static gboolean is_rubber_listed(SbParamPanel *panel, const char *needle) {
  const SbDocument *document = sb_session_document(panel->session);
  return needle[0] != '\0'
             ? is_found(SB_FILE_COUNT, C_("search", "rubber"), needle)
             : panel->filter == SB_PARAM_FILTER_ALL || (panel->filter == SB_PARAM_FILTER_CHANGED &&
                                                        sb_document_rubber(document) != NULL);
}

static gboolean is_section_listed(SbParamPanel *panel, const SbParams *params, const char *needle) {
  const char *words = C_("search", "section drawn file dxf step");
  return needle[0] != '\0' ? is_found(SB_FILE_SECTION, words, needle)
                           : is_listed(panel, params, needle, SB_P_SEAL_PROFILE);
}

static gboolean is_groove_listed(SbParamPanel *panel, const SbParams *params, const char *needle) {
  const SbDocument *document = sb_session_document(panel->session);
  const char *words = C_("search", "groove drawn file dxf step");
  return needle[0] != '\0' ? is_found(SB_FILE_GROOVE, words, needle)
                           : is_listed(panel, params, needle, SB_P_GLAND_CORNER_RADIUS) ||
                                 (panel->filter == SB_PARAM_FILTER_CHANGED &&
                                  sb_document_groove(document) != NULL);
}

// Shows the rows that are listed and unfolds their groups; with all of them as it was before.
static void list(SbParamPanel *panel) {
  g_autofree char *needle = g_utf8_casefold(gtk_entry_get_text(GTK_ENTRY(panel->search)), -1);
  g_strstrip(needle);
  const SbParams params = sb_document_params(sb_session_document(panel->session));
  const gboolean narrowed = needle[0] != '\0' || panel->filter != SB_PARAM_FILTER_ALL;
  if (narrowed && !panel->narrowed) {
    for (guint g = 0; g < panel->groups->len; g++) {
      Group *group = group_at(panel, (int)g);
      group->unfolded = gtk_expander_get_expanded(GTK_EXPANDER(group->expander));
    }
  }
  const struct {
    GtkWidget *row;
    gboolean listed;
  } own[] = {{panel->rubber, is_rubber_listed(panel, needle)},
             {panel->section, is_section_listed(panel, &params, needle)},
             {panel->groove, is_groove_listed(panel, &params, needle)}};
  int found = 0;
  for (guint g = 0; g < panel->groups->len; g++) {
    Group *group = group_at(panel, (int)g);
    int in_group = 0;
    for (int id = 0; id < SB_PARAM_COUNT; id++) {
      if (panel->group_of[id] == (int)g) {
        const gboolean listed = is_listed(panel, &params, needle, (SbParamId)id);
        gtk_widget_set_visible(panel->row[id], listed);
        in_group += listed;
      }
    }
    for (size_t i = 0; i < G_N_ELEMENTS(own); i++) {
      if (group->box == gtk_widget_get_parent(own[i].row)) {
        gtk_widget_set_visible(own[i].row, own[i].listed);
        in_group += own[i].listed;
      }
    }
    found += in_group;
    gtk_widget_set_visible(group->expander, in_group > 0);
    if (narrowed && !panel->narrowed) {
      gtk_expander_set_expanded(GTK_EXPANDER(group->expander), TRUE);
    } else if (!narrowed && panel->narrowed) {
      gtk_expander_set_expanded(GTK_EXPANDER(group->expander), group->unfolded);
    }
  }
  found += sb_action_finder_search(panel->actions, needle);
  gtk_widget_set_visible(panel->nothing, found == 0);
  panel->narrowed = narrowed;
}

static void name_filters(SbParamPanel *panel) {
  const SbParams params = sb_document_params(sb_session_document(panel->session));
  const int kind = (int)sb_params_get(&params, SB_P_VALVE_KIND);
  int count[SB_PARAM_FILTER_ALL + 1] = {0};
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    count[SB_PARAM_FILTER_MAIN] += sb_param_is_main((SbParamId)id, kind);
    count[SB_PARAM_FILTER_CHANGED] += sb_param_is_changed(&params, (SbParamId)id);
    count[SB_PARAM_FILTER_ALL]++;
  }
  for (int i = 0; i <= SB_PARAM_FILTER_ALL; i++) {
    g_autofree char *name = g_strdup_printf(i == SB_PARAM_FILTER_MAIN      ? _("Main %d")
                                            : i == SB_PARAM_FILTER_CHANGED ? _("Changed %d")
                                                                           : _("All %d"),
                                            count[i]);
    if (g_strcmp0(gtk_button_get_label(GTK_BUTTON(panel->filters[i])), name) != 0) {
      gtk_button_set_label(GTK_BUTTON(panel->filters[i]), name);
    }
  }
}

// Bars beside the main parameters of what they do to the chosen figure.
static void show_effects(void *data) {
  SbParamPanel *panel = data;
  const int goal = gtk_combo_box_get_active(GTK_COMBO_BOX(panel->goal)) - 1;
  bool former = false;
  const SbEffects *effects =
      panel->effects != NULL ? sb_effect_watch_effects(panel->effects, &former) : NULL;
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    g_autofree char *text = goal >= 0 ? sb_effect_text(effects, goal, (SbParamId)id) : NULL;
    const double share = text != NULL ? sb_effect_share(effects, goal, id) : NAN;
    sb_param_row_show_effect(SB_PARAM_ROW(panel->row[id]), share, former, text);
  }
}

static void on_goal(GtkComboBox *goal, SbParamPanel *panel) {
  const gboolean asked = gtk_combo_box_get_active(goal) > 0;
  if (asked && panel->effects == NULL) {
    panel->effects = sb_effect_watch_new(panel->session, show_effects, NULL, panel);
  } else if (!asked) {
    g_clear_pointer(&panel->effects, sb_effect_watch_free);
  }
  show_effects(panel);
}

static void refresh_params(SbParamPanel *panel) {
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    sb_param_row_refresh(SB_PARAM_ROW(panel->row[id]));
  }
  sb_rubber_row_refresh(panel->rubber);
  sb_drawing_row_refresh(panel->section);
  sb_drawing_row_refresh(panel->groove);
  if (panel->effects != NULL) {
    show_effects(panel); // of former values from now on
  }
  name_filters(panel);
  const SbParams params = sb_document_params(sb_session_document(panel->session));
  const int kind = (int)sb_params_get(&params, SB_P_VALVE_KIND);
  if (kind != panel->kind) {
    panel->kind = kind;
    list(panel);
  }
  // A row that is being edited stays until another list is asked for.
  GtkWidget *top = gtk_widget_get_toplevel(GTK_WIDGET(panel));
  GtkWidget *focus = GTK_IS_WINDOW(top) ? gtk_window_get_focus(GTK_WINDOW(top)) : NULL;
  if (panel->filter == SB_PARAM_FILTER_CHANGED &&
      (focus == NULL || !gtk_widget_is_ancestor(focus, panel->list))) {
    list(panel);
  }

  // The groups of single seals say how much of them is in force.
  for (guint g = 0; g < panel->groups->len; g++) {
    Group *group = group_at(panel, (int)g);
    int own = 0;
    gboolean override = FALSE;
    for (int id = 0; id < SB_PARAM_COUNT; id++) {
      if (panel->group_of[id] == (int)g && sb_param((SbParamId)id)->parent >= 0) {
        override = TRUE;
        own += sb_document_gives(sb_session_document(panel->session), (SbParamId)id);
      }
    }
    if (override) {
      g_autofree char *note =
          own > 0 ? g_strdup_printf(_("%d differ"), own) : g_strdup(_("as both"));
      gtk_label_set_text(GTK_LABEL(group->note), note);
    }
  }
}

static void on_search(GtkSearchEntry *entry, SbParamPanel *panel) {
  list(panel);
}

void sb_param_panel_set_filter(SbParamPanel *panel, SbParamFilter filter) {
  panel->filter = filter;
  panel->refreshing = TRUE;
  for (int i = 0; i <= SB_PARAM_FILTER_ALL; i++) {
    gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(panel->filters[i]), i == (int)filter);
  }
  panel->refreshing = FALSE;
  list(panel);
}

SbParamFilter sb_param_panel_filter(SbParamPanel *panel) {
  return panel->filter;
}

static void on_filter(GtkToggleButton *button, SbParamPanel *panel) {
  if (panel->refreshing) {
    return;
  }
  for (int i = 0; i <= SB_PARAM_FILTER_ALL; i++) {
    if (panel->filters[i] == GTK_WIDGET(button)) {
      sb_param_panel_set_filter(panel, (SbParamFilter)i);
    }
  }
}

// Escape in the search box clears it (GtkSearchEntry) and gives the focus back to the fields.
static void on_stop_search(GtkSearchEntry *entry, SbParamPanel *panel) {
  gtk_entry_set_text(GTK_ENTRY(entry), "");
  gtk_widget_child_focus(panel->list, GTK_DIR_TAB_FORWARD);
}

static void on_map_scroll(gpointer data) {
  GtkWidget *row = data;
  GtkWidget *scroller = gtk_widget_get_ancestor(row, GTK_TYPE_SCROLLED_WINDOW);
  GtkWidget *list = gtk_bin_get_child(GTK_BIN(gtk_bin_get_child(GTK_BIN(scroller))));
  int x = 0;
  int y = 0;
  if (gtk_widget_translate_coordinates(row, list, 0, 0, &x, &y)) {
    GtkAdjustment *adjustment = gtk_scrolled_window_get_vadjustment(GTK_SCROLLED_WINDOW(scroller));
    gtk_adjustment_clamp_page(adjustment, y - 40, y + gtk_widget_get_allocated_height(row) + 40);
  }
}

// Unfolds what a row is in and scrolls to it.
static void bring_up(SbParamPanel *panel, SbParamId id) {
  gtk_entry_set_text(GTK_ENTRY(panel->search), "");
  const SbParams params = sb_document_params(sb_session_document(panel->session));
  if (!is_listed(panel, &params, "", id)) {
    panel->filter = SB_PARAM_FILTER_ALL;
  }
  sb_param_panel_set_filter(panel, panel->filter); // a search's change is told later
  Group *group = group_at(panel, panel->group_of[id]);
  gtk_expander_set_expanded(GTK_EXPANDER(group->expander), TRUE);
  sb_later_set(&panel->scroll, panel, 0, on_map_scroll, panel->row[id]);
}

void sb_param_panel_reveal(SbParamPanel *panel, SbParamId id) {
  bring_up(panel, id);
  sb_param_row_focus(SB_PARAM_ROW(panel->row[id]));
}

static void on_marked_long(gpointer data) {
  gtk_style_context_remove_class(gtk_widget_get_style_context(data), "sb-marked");
}

void sb_param_panel_show(SbParamPanel *panel, SbParamId id) {
  bring_up(panel, id);
  sb_style_class(panel->row[id], "sb-marked");
  sb_later_set(&panel->marked[id], panel->row[id], MARKED_MS, on_marked_long, panel->row[id]);
}

void sb_param_panel_search(SbParamPanel *panel) {
  gtk_widget_grab_focus(panel->search);
}

GtkWidget *sb_param_panel_new(SbSession *session) {
  SbParamPanel *panel =
      g_object_new(SB_TYPE_PARAM_PANEL, "orientation", GTK_ORIENTATION_VERTICAL, NULL);
  panel->session = session;
  g_autoptr(GtkSizeGroup) fields = gtk_size_group_new(GTK_SIZE_GROUP_HORIZONTAL);
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    panel->group_of[id] = group_for(panel, (SbParamId)id);
    if (panel->rubber == NULL && sb_param_group((SbParamId)id) == SB_PARAMS_RUBBER) {
      panel->rubber = sb_rubber_row_new(session);
      gtk_box_pack_start(GTK_BOX(group_at(panel, panel->group_of[id])->box), panel->rubber, FALSE,
                         FALSE, 0);
    }
    panel->row[id] = sb_param_row_new(session, (SbParamId)id, fields);
    gtk_box_pack_start(GTK_BOX(group_at(panel, panel->group_of[id])->box), panel->row[id], FALSE,
                       FALSE, 0);
    if (id == SB_P_SEAL_PROFILE || id == SB_P_GLAND_EDGE_CHAMFER) {
      const bool groove = id != SB_P_SEAL_PROFILE;
      GtkWidget *row = sb_drawing_row_new(session, groove ? SB_DRAWING_GROOVE : SB_DRAWING_SECTION);
      *(groove ? &panel->groove : &panel->section) = row;
      gtk_box_pack_start(GTK_BOX(group_at(panel, panel->group_of[id])->box), row, FALSE, FALSE, 0);
    }
  }
  g_signal_connect_object(session, "params-changed", G_CALLBACK(refresh_params), panel,
                          G_CONNECT_SWAPPED);
  gtk_widget_show_all(GTK_WIDGET(panel->list));
  refresh_params(panel);
  sb_param_panel_set_filter(panel, SB_PARAM_FILTER_ALL);
  return GTK_WIDGET(panel);
}

static void dispose(GObject *object) {
  g_clear_pointer(&SB_PARAM_PANEL(object)->effects, sb_effect_watch_free);
  G_OBJECT_CLASS(sb_param_panel_parent_class)->dispose(object);
}

static void finalize(GObject *object) {
  g_array_unref(SB_PARAM_PANEL(object)->groups);
  G_OBJECT_CLASS(sb_param_panel_parent_class)->finalize(object);
}

static void sb_param_panel_class_init(SbParamPanelClass *class) {
  G_OBJECT_CLASS(class)->dispose = dispose;
  G_OBJECT_CLASS(class)->finalize = finalize;
}

// Adds the choice of the figure whose effects are shown.
static void add_goals(SbParamPanel *panel) {
  panel->goal = gtk_combo_box_text_new();
  gtk_combo_box_text_append_text(GTK_COMBO_BOX_TEXT(panel->goal), _("no effects"));
  for (int i = 0; i < SB_EFFECT_GOALS; i++) {
    g_autofree char *name = g_strdup_printf(_("effect on %s"), sb_effect_goal_name(i));
    gtk_combo_box_text_append_text(GTK_COMBO_BOX_TEXT(panel->goal), name);
  }
  gtk_combo_box_set_active(GTK_COMBO_BOX(panel->goal), 0);
  sb_style_name(panel->goal, _("Effects"),
                _("Effect of each main parameter on a figure, per tolerance or 5 %"));
  g_object_set(panel->goal, "margin-start", 20, "margin-end", 20, "margin-bottom", 6, NULL);
  g_signal_connect(panel->goal, "changed", G_CALLBACK(on_goal), panel);
  gtk_box_pack_start(GTK_BOX(panel), panel->goal, FALSE, FALSE, 0);
}

static void sb_param_panel_init(SbParamPanel *panel) {
  panel->groups = g_array_new(FALSE, TRUE, sizeof(Group));
  sb_style_class(GTK_WIDGET(panel), "sb-panel");

  panel->search = gtk_search_entry_new();
  g_autofree char *hint = g_strdup_printf(_("Search %d parameters"), SB_PARAM_COUNT);
  gtk_entry_set_placeholder_text(GTK_ENTRY(panel->search), hint);
  sb_style_name(panel->search, _("Search parameters"),
                _("Shows the parameters whose name, other name, key, symbol, choices or help "
                  "contains the text, and the actions"));
  g_object_set(panel->search, "margin-start", 20, "margin-end", 20, "margin-top", 10,
               "margin-bottom", 6, NULL);
  g_signal_connect(panel->search, "search-changed", G_CALLBACK(on_search), panel);
  g_signal_connect(panel->search, "stop-search", G_CALLBACK(on_stop_search), panel);
  gtk_box_pack_start(GTK_BOX(panel), panel->search, FALSE, FALSE, 0);

  GtkWidget *filters = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
  sb_style_class(filters, "linked");
  sb_style_class(filters, "sb-filters");
  gtk_box_set_homogeneous(GTK_BOX(filters), TRUE);
  g_object_set(filters, "margin-start", 20, "margin-end", 20, "margin-bottom", 6, NULL);
  for (int i = 0; i <= SB_PARAM_FILTER_ALL; i++) {
    panel->filters[i] = gtk_toggle_button_new_with_label("");
    g_signal_connect(panel->filters[i], "toggled", G_CALLBACK(on_filter), panel);
    gtk_box_pack_start(GTK_BOX(filters), panel->filters[i], TRUE, TRUE, 0);
  }
  gtk_widget_set_tooltip_text(panel->filters[SB_PARAM_FILTER_MAIN],
                              _("Parameters of a first design"));
  gtk_widget_set_tooltip_text(panel->filters[SB_PARAM_FILTER_CHANGED],
                              _("Values other than their defaults"));
  gtk_box_pack_start(GTK_BOX(panel), filters, FALSE, FALSE, 0);

  add_goals(panel);

  panel->list = gtk_box_new(GTK_ORIENTATION_VERTICAL, 2);
  g_object_set(panel->list, "margin-start", 18, "margin-end", 16, "margin-bottom", 12, NULL);
  panel->actions = sb_action_finder_new();
  gtk_box_pack_start(GTK_BOX(panel->list), panel->actions, FALSE, FALSE, 0);
  panel->nothing = gtk_label_new(_("No parameter matches."));
  sb_style_class(panel->nothing, "sb-note");
  gtk_widget_set_margin_top(panel->nothing, 24);
  gtk_widget_set_no_show_all(panel->nothing, TRUE);
  gtk_box_pack_start(GTK_BOX(panel->list), panel->nothing, FALSE, FALSE, 0);

  panel->scroller = gtk_scrolled_window_new(NULL, NULL);
  gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(panel->scroller), GTK_POLICY_NEVER,
                                 GTK_POLICY_AUTOMATIC);
  gtk_container_add(GTK_CONTAINER(panel->scroller), panel->list);
  gtk_box_pack_start(GTK_BOX(panel), panel->scroller, TRUE, TRUE, 0);
  gtk_widget_show_all(GTK_WIDGET(panel));
}
