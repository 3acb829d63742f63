// The line at the bottom: where the playhead is (also for screen readers and tests), models, run
// time, error estimate, and the warnings with a list behind a button.
#include "ui/window/status_bar.h"

#include "app/base/device.h"
#include "app/chart/page.h"
#include "ui/views/later.h"
#include "ui/views/signals.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <math.h>

typedef struct {
  SbSession *session;
  GtkWidget *where, *models, *run, *error, *warnings, *list, *count;
  SbLater later; // renews the texts
} Bar;

static void set_text(GtkWidget *label, const char *text) {
  if (g_strcmp0(gtk_label_get_text(GTK_LABEL(label)), text) != 0) {
    gtk_label_set_text(GTK_LABEL(label), text);
  }
}

static void refresh_model_names(Bar *bar) {
  const SbRun *run = sb_session_run(bar->session);
  const SbModel *model = run != NULL ? sb_run_model(run) : sb_session_model(bar->session);
  if (model == NULL) {
    return;
  }
  char fit[32], film[32], surface[32], motion[32];
  sb_model_choice_name(model, SB_P_MODELS_FIT, fit, sizeof fit);
  sb_model_choice_name(model, SB_P_MODELS_FILM, film, sizeof film);
  sb_model_choice_name(model, SB_P_MODELS_SURFACE, surface, sizeof surface);
  sb_model_choice_name(model, SB_P_MODELS_MOTION, motion, sizeof motion);
  g_autofree char *text =
      sb_device(model)->stem
          ? g_strdup_printf(_("fit %s, film %s, surface %s, motion %s"), fit, film, surface, motion)
          : g_strdup_printf(_("motion %s"), motion);
  if (run == NULL && sb_session_state(bar->session) == SB_SESSION_RUNNING) {
    g_autofree char *computed = g_steal_pointer(&text);
    text = g_strdup_printf(_("being computed: %s"), computed);
  }
  gtk_label_set_text(GTK_LABEL(bar->models), text);
}

// An icon and a text in Pango markup.
static void add_status_row(Bar *bar, const char *icon_name, const char *style, const char *text) {
  GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
  GtkWidget *icon = gtk_image_new_from_icon_name(icon_name, GTK_ICON_SIZE_MENU);
  gtk_widget_set_valign(icon, GTK_ALIGN_START);
  sb_style_class(icon, style);
  gtk_box_pack_start(GTK_BOX(box), icon, FALSE, FALSE, 0);
  GtkWidget *label = gtk_label_new(NULL);
  gtk_label_set_markup(GTK_LABEL(label), text);
  gtk_label_set_xalign(GTK_LABEL(label), 0);
  gtk_label_set_line_wrap(GTK_LABEL(label), TRUE);
  gtk_label_set_max_width_chars(GTK_LABEL(label), 60);
  gtk_label_set_selectable(GTK_LABEL(label), TRUE);
  gtk_widget_set_can_focus(label, FALSE);
  gtk_box_pack_start(GTK_BOX(box), label, TRUE, TRUE, 0);
  gtk_container_add(GTK_CONTAINER(bar->list), box);
}

static void add_warning(Bar *bar, const SbWarning *warning) {
  g_autofree char *text =
      warning->input != 0
          ? g_markup_printf_escaped("%s\n<small>%s, %s</small>", warning->text, warning->code,
                                    sb_input_key(warning->input))
          : g_markup_printf_escaped("%s\n<small>%s</small>", warning->text, warning->code);
  add_status_row(bar, "dialog-warning-symbolic", "sb-warn", text);
}

static void refresh_warnings(Bar *bar, const SbSummary *summary) {
  GList *rows = gtk_container_get_children(GTK_CONTAINER(bar->list));
  for (GList *item = rows; item != NULL; item = item->next) {
    gtk_widget_destroy(item->data);
  }
  g_list_free(rows);
  size_t count = summary != NULL ? summary->warnings.count + summary->warnings.dropped : 0;
  // The serious first.
  size_t serious = 0;
  for (int pass = 1; summary != NULL && pass >= 0; pass--) {
    for (size_t i = 0; i < summary->warnings.count; i++) {
      if (summary->warnings.item[i].serious == (pass == 1)) {
        add_warning(bar, &summary->warnings.item[i]);
        serious += pass == 1;
      }
    }
  }
  // What shapes in the files said against given values when the document was opened.
  const GPtrArray *notes = sb_document_notes(sb_session_document(bar->session));
  for (guint i = 0; i < notes->len; i++) {
    g_autofree char *text = g_markup_escape_text(notes->pdata[i], -1);
    add_status_row(bar, "dialog-information-symbolic", "sb-quiet", text);
  }
  gtk_widget_show_all(bar->list);
  g_autofree char *text =
      serious > 0      ? g_strdup_printf(_("%zu serious of %zu warnings"), serious, count)
      : count > 0      ? g_strdup_printf(ngettext("%zu warning", "%zu warnings", count), count)
      : notes->len > 0 ? g_strdup_printf(ngettext("%u note", "%u notes", notes->len), notes->len)
                       : g_strdup(_("No warnings"));
  gtk_label_set_text(GTK_LABEL(bar->count), text);
  GtkStyleContext *style = gtk_widget_get_style_context(bar->count);
  if (count > 0) {
    gtk_style_context_add_class(style, "sb-warn");
  } else {
    gtk_style_context_remove_class(style, "sb-warn");
  }
  sb_style_name(bar->warnings, text, _("Opens the list of warnings of the displayed run"));
  gtk_widget_set_visible(bar->warnings, summary != NULL);
  gtk_widget_set_sensitive(bar->warnings, count > 0 || notes->len > 0);
}

static void refresh_where(Bar *bar) {
  g_autofree char *where = sb_session_where(bar->session);
  bool running = sb_session_state(bar->session) == SB_SESSION_RUNNING;
  set_text(bar->where, where[0] != '\0' ? where : running ? _("running") : _("nothing has run"));
  GtkStyleContext *style = gtk_widget_get_style_context(bar->where);
  if (where[0] != '\0') {
    gtk_style_context_add_class(style, "sb-now");
  } else {
    gtk_style_context_remove_class(style, "sb-now");
  }
}

// How long the last edit was waited for.
static char *edit_text(const SbEditLatency *latency) {
  return isnan(latency->shown)
             ? g_strdup_printf(_("edit predicted in %.0f ms"), 1e3 * latency->predicted)
         : isnan(latency->predicted)
             ? g_strdup_printf(_("edit shown in %.0f ms"), 1e3 * latency->shown)
             : g_strdup_printf(_("edit predicted in %.0f ms, shown in %.0f ms"),
                               1e3 * latency->predicted, 1e3 * latency->shown);
}

static void refresh_frames(Bar *bar) {
  size_t count = 0;
  sb_session_frames(bar->session, &count);
  const SbSummary *summary = sb_session_summary(bar->session);
  g_autofree char *text = NULL;
  if (summary != NULL && summary->wall_s < 0.0995) {
    text = g_strdup_printf(_("%zu frames in %.2g ms"), summary->frames, 1e3 * summary->wall_s);
  } else if (summary != NULL) {
    text = g_strdup_printf(_("%zu frames in %.2f s"), summary->frames, summary->wall_s);
  } else {
    text = g_strdup_printf(_("%zu frames"), count);
  }
  g_autofree char *grade = sb_session_grade_text(bar->session);
  if (grade != NULL) {
    g_autofree char *plain = g_steal_pointer(&text);
    text = g_strdup_printf("%s, %s", plain, grade);
  }
  const SbEditLatency latency = sb_session_latency(bar->session);
  if (!isnan(latency.predicted) || !isnan(latency.shown)) {
    g_autofree char *plain = g_steal_pointer(&text);
    g_autofree char *edit = edit_text(&latency);
    text = g_strdup_printf("%s, %s", plain, edit);
  }
  set_text(bar->run, text);
  refresh_where(bar);
}

static void on_status_later(gpointer data) {
  Bar *bar = data;
  refresh_frames(bar);
}

// A new text lays the bar out again: ten times a second is enough while something moves.
static void refresh_soon(Bar *bar) {
  if (!sb_session_wants_ticks(bar->session)) {
    refresh_frames(bar);
  } else {
    sb_later_ensure(&bar->later, bar->where, 100, on_status_later, bar);
  }
}

static void refresh_status(Bar *bar) {
  const SbSummary *summary = sb_session_summary(bar->session);
  refresh_model_names(bar);
  refresh_frames(bar);
  refresh_warnings(bar, summary);
  char errors[512] = "–";
  if (summary != NULL) {
    sb_page_errors_text(errors, sizeof errors, summary);
  }
  gtk_label_set_text(GTK_LABEL(bar->error), errors);
}

static GtkWidget *add_label(GtkBox *box, const char *text, const char *style) {
  GtkWidget *label = gtk_label_new(text);
  if (style != NULL) {
    sb_style_class(label, style);
  }
  gtk_box_pack_start(box, label, FALSE, FALSE, 0);
  return label;
}

static GtkWidget *add_pair(GtkBox *box, const char *key, const char *name) {
  GtkWidget *label = add_label(box, key, "sb-key");
  gtk_widget_set_margin_start(label, 14);
  GtkWidget *value = add_label(box, "", NULL);
  gtk_label_set_ellipsize(GTK_LABEL(value), PANGO_ELLIPSIZE_END);
  sb_style_name(label, name, NULL);
  return value;
}

GtkWidget *sb_status_bar_new(SbSession *session) {
  Bar *bar = g_new0(Bar, 1);
  bar->session = session;
  GtkWidget *widget = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
  GtkBox *box = GTK_BOX(widget);
  g_object_set_data_full(G_OBJECT(widget), "bar", bar, g_free);
  sb_style_class(widget, "sb-status");
  atk_object_set_role(gtk_widget_get_accessible(widget), ATK_ROLE_STATUSBAR);
  sb_style_name(widget, _("Status"), NULL);

  bar->where = add_label(box, "", NULL);
  gtk_label_set_width_chars(GTK_LABEL(bar->where), 26);
  gtk_label_set_xalign(GTK_LABEL(bar->where), 0);
  bar->models = add_pair(box, _("Models"), _("Models"));
  bar->run = add_pair(box, C_("status", "Run"), C_("status", "Run"));
  bar->error = add_pair(box, _("Error estimate"), _("Error estimate"));

  bar->warnings = sb_style_menu_button();
  bar->count = gtk_label_new("");
  gtk_container_add(GTK_CONTAINER(bar->warnings), bar->count);
  GtkWidget *popover = gtk_popover_new(bar->warnings);
  bar->list = gtk_box_new(GTK_ORIENTATION_VERTICAL, 10);
  g_object_set(bar->list, "margin", 14, NULL);
  gtk_container_add(GTK_CONTAINER(popover), bar->list);
  gtk_menu_button_set_popover(GTK_MENU_BUTTON(bar->warnings), popover);
  gtk_widget_set_valign(bar->warnings, GTK_ALIGN_CENTER);
  gtk_box_pack_end(box, bar->warnings, FALSE, FALSE, 0);
  gtk_widget_show_all(widget);

  sb_signals_end_with(widget, bar->session, bar);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(refresh_status), bar);
  g_signal_connect_swapped(session, "frames-changed", G_CALLBACK(refresh_soon), bar);
  g_signal_connect_swapped(session, "playhead-changed", G_CALLBACK(refresh_soon), bar);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(refresh_model_names), bar);
  refresh_status(bar);
  return widget;
}
