// See the header. The picture is that of app/chart/calibration.h, the request that of
// app/session/calibrate_ask.h; other priors need a study file.
#include "ui/window/calibrate_page.h"

#include "app/base/translation.h"
#include "app/export/calibrate_results.h"
#include "app/session/calibrate_ask.h"
#include "app/session/calibrate_job.h"
#include "app/session/worker.h"
#include "ui/views/draw_cache.h"
#include "ui/views/later.h"
#include "ui/views/style.h"
#include "ui/window/import_dialog.h"

#include <glib/gi18n.h>

typedef struct {
  SbSession *session; // owned reference
  GtkWidget *box, *area, *tick[SB_CALIBRATE_CHOICES], *file_label, *fit, *use, *progress, *stop,
      *message;
  GtkWidget *recognised;
  SbDrawCache *cache;
  SbCalibrateJob *job;
  SbLater poll;
  SbData *fitted; // what the last fit was asked of
  gboolean known; // there is a calibration
  SbCalibration found;
  SbStudyFile *study;
} Page;

static void draw(cairo_t *cr, double width, double height, void *data) {
  Page *page = data;
  if (page->known) {
    sb_calibration_page_draw(cr, (SbRect){0, 0, width, height}, &page->found, page->study,
                             sb_style_is_dark());
  } else {
    (void)sb_style_ground(cr, SB_ROLE_BACKGROUND);
  }
}

// What the picture says, for those who do not see it.
static char *describe(const Page *page) {
  GString *text = g_string_new(NULL);
  for (size_t j = 0; j < page->found.parameters; j++) {
    const SbCalibrated *one = &page->found.parameter[j];
    g_autofree char *value = sb_param_format(one->id, one->estimate);
    if (page->found.samples == 0) { // interrupted: there is no interval
      g_string_append_printf(text, "%s: %s\n", one->name, value);
      continue;
    }
    g_autofree char *low = sb_param_format(one->id, one->interval[0]);
    g_autofree char *high = sb_param_format(one->id, one->interval[1]);
    g_string_append_printf(text, "%s: %s, %s - %s, %s\n", one->name, value, low, high,
                           sb_identifiable_name(one->identifiable));
  }
  g_string_append(text, page->found.sentence);
  return g_string_free(text, FALSE);
}

static const SbData *own_data(const Page *page) {
  return sb_calibrate_data(sb_session_document(page->session));
}

static void refresh(Page *page) {
  const gboolean busy = page->job != NULL;
  const SbData *own = own_data(page);
  const char *path = own != NULL ? own->path : NULL;
  g_autofree char *name = path != NULL ? g_path_get_basename(path) : NULL;
  gboolean ticked = FALSE;
  for (int i = 0; i < SB_CALIBRATE_CHOICES; i++) {
    ticked |= gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(page->tick[i]));
  }
  gtk_label_set_text(GTK_LABEL(page->file_label), name != NULL ? name : _("nothing measured"));
  gtk_widget_set_visible(page->progress, busy);
  gtk_widget_set_visible(page->stop, busy);
  gtk_widget_set_sensitive(page->fit, !busy && path != NULL && ticked);
  gtk_widget_set_sensitive(page->use, !busy && page->known);
  gtk_widget_set_sensitive(page->recognised, path != NULL);
  g_autofree char *text = page->known ? describe(page) : g_strdup(_("Nothing is fitted yet."));
  sb_style_name(page->area, _("Measured loops and the fitted valve"), text);
  sb_draw_cache_change(page->cache, 0);
}

static void say(Page *page, const char *text) {
  gtk_label_set_text(GTK_LABEL(page->message), text);
}

// The fit ----------------------------------------------------------------------------------------

// Returns the study file of what is ticked; NULL, with the reason shown.
static SbStudyFile *make_study(Page *page) {
  SbCalibrateAsk ask;
  for (int i = 0; i < SB_CALIBRATE_CHOICES; i++) {
    ask.fitted[i] = gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(page->tick[i]));
  }
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbStudyFile *study = sb_calibrate_ask_study(&ask, sb_session_document(page->session), issues);
  if (study == NULL) {
    g_autofree char *line = issues->len > 0 ? sb_issue_line(issues->pdata[0]) : g_strdup("");
    say(page, line);
  }
  return study;
}

static void end_job(Page *page) {
  sb_later_cancel(&page->poll);
  g_clear_pointer(&page->job, sb_calibrate_job_free);
}

static void on_poll(gpointer data) {
  Page *page = data;
  gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(page->progress), sb_worker_progress(page->job));
}

static void forget(Page *page) {
  if (page->known) {
    sb_calibration_release(&page->found);
    g_clear_pointer(&page->study, sb_study_file_free);
  }
  page->known = FALSE;
}

static void on_done(void *data) {
  Page *page = data;
  SbCalibration found;
  SbStudyFile *study = NULL;
  g_autofree char *why = NULL;
  const bool good = sb_calibrate_job_take(page->job, &found, &study, &why);
  end_job(page);
  say(page, !good           ? why
            : found.partial ? _("Interrupted: the best values so far, without intervals")
                            : "");
  if (good) {
    forget(page);
    page->found = found;
    page->study = study;
    page->known = TRUE;
  }
  refresh(page);
}

static void fit(Page *page) {
  end_job(page);
  g_clear_pointer(&page->fitted, sb_data_free);
  if (own_data(page) == NULL) {
    forget(page);
    return;
  }
  page->fitted = sb_data_copy(own_data(page));
  SbStudyFile *study = make_study(page);
  if (study != NULL) {
    say(page, "");
    gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(page->progress), 0);
    page->job = sb_calibrate_job_start(study, on_done, page);
    sb_later_repeat(&page->poll, page->box, 50, on_poll, page);
  }
  refresh(page);
}

// Actions ----------------------------------------------------------------------------------------

static void on_recognised(GtkButton *button, Page *page) {
  GtkWidget *top = gtk_widget_get_toplevel(page->box);
  sb_import_measured(GTK_WINDOW(top), page->session, own_data(page)->path);
}

static void on_use(GtkButton *button, Page *page) {
  g_autofree SbOverride *values = g_new(SbOverride, page->found.parameters);
  const size_t count = sb_calibration_estimates(values, &page->found);
  sb_session_edit_values(page->session, values, count);
}

static void on_stop(GtkButton *button, Page *page) {
  if (page->job != NULL) {
    sb_worker_cancel(page->job);
  }
}

// A document's data are fitted when the page is first looked at, and when others were imported.
static void on_look(Page *page) {
  if (gtk_widget_get_mapped(page->box) && !sb_data_same(page->fitted, own_data(page))) {
    fit(page);
  }
  refresh(page);
}

static void on_params(SbSession *session, GtkWidget *box) {
  on_look(g_object_get_data(G_OBJECT(box), "page"));
}

// Life -------------------------------------------------------------------------------------------

static void on_destroy(GtkWidget *widget, Page *page) {
  end_job(page);
  g_clear_object(&page->session);
}

static void page_free(gpointer data) {
  Page *page = data;
  forget(page);
  sb_data_free(page->fitted);
  g_free(page);
}

static GtkWidget *menu_button(GtkBox *bar, const char *label, GtkWidget *content) {
  GtkWidget *button = sb_style_menu_button();
  GtkWidget *popover = gtk_popover_new(button);
  gtk_container_set_border_width(GTK_CONTAINER(content), 10);
  gtk_container_add(GTK_CONTAINER(popover), content);
  gtk_widget_show_all(content);
  gtk_menu_button_set_popover(GTK_MENU_BUTTON(button), popover);
  gtk_container_add(GTK_CONTAINER(button), gtk_label_new(label));
  gtk_box_pack_start(bar, button, FALSE, FALSE, 0);
  return button;
}

static GtkWidget *button_of(GtkBox *bar, const char *label, const char *tip, GCallback call,
                            Page *page) {
  GtkWidget *button = gtk_button_new_with_label(label);
  gtk_widget_set_tooltip_text(button, tip);
  g_signal_connect(button, "clicked", call, page);
  gtk_box_pack_start(bar, button, FALSE, FALSE, 0);
  return button;
}

static void add_toolbar(Page *page) {
  GtkBox *bar = GTK_BOX(gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8));
  sb_style_class(GTK_WIDGET(bar), "sb-toolbar");
  gtk_box_pack_start(bar, sb_style_label(_("Measured"), "sb-heading", 0), FALSE, FALSE, 0);
  page->file_label = sb_style_label(NULL, "sb-row-label", 0);
  gtk_box_pack_start(bar, page->file_label, FALSE, FALSE, 0);
  GtkWidget *import = gtk_button_new_with_label(_("Import…"));
  gtk_widget_set_tooltip_text(import, _("A table of force and displacement from a test machine"));
  gtk_actionable_set_action_name(GTK_ACTIONABLE(import), "win.import-measured");
  gtk_box_pack_start(bar, import, FALSE, FALSE, 0);
  page->recognised =
      button_of(bar, _("Recognised…"), _("How the data were read, with choices to change it"),
                G_CALLBACK(on_recognised), page);
  GtkWidget *list = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);
  SbCalibrateAsk ask;
  sb_calibrate_ask_init(&ask);
  for (int i = 0; i < SB_CALIBRATE_CHOICES; i++) {
    const SbParam *param = sb_param(sb_calibrate_choice(i));
    page->tick[i] = gtk_check_button_new_with_label(param->key);
    gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(page->tick[i]), ask.fitted[i]);
    gtk_widget_set_tooltip_text(page->tick[i], sb_translation(param->help));
    g_signal_connect_swapped(page->tick[i], "toggled", G_CALLBACK(refresh), page);
    gtk_box_pack_start(GTK_BOX(list), page->tick[i], FALSE, FALSE, 0);
  }
  (void)menu_button(bar, _("Parameters"), list);
  page->message = sb_style_label(NULL, "sb-warn", 0);
  gtk_label_set_ellipsize(GTK_LABEL(page->message), PANGO_ELLIPSIZE_END);
  gtk_box_pack_start(bar, page->message, TRUE, TRUE, 0);
  page->progress = gtk_progress_bar_new();
  gtk_widget_set_valign(page->progress, GTK_ALIGN_CENTER);
  sb_style_name(page->progress, _("Progress of the fit"), NULL);
  gtk_box_pack_start(bar, page->progress, FALSE, FALSE, 0);
  page->stop = button_of(bar, _("Cancel"), _("Stop fitting and show the best values so far"),
                         G_CALLBACK(on_stop), page);
  page->fit = gtk_button_new_with_label(_("Fit again"));
  g_signal_connect_swapped(page->fit, "clicked", G_CALLBACK(fit), page);
  gtk_box_pack_start(bar, page->fit, FALSE, FALSE, 0);
  page->use =
      button_of(bar, _("Use estimates"),
                _("Sets the parameters that the data identify; the others keep their values"),
                G_CALLBACK(on_use), page);
  // The window may be narrower than the bar.
  GtkWidget *room = gtk_scrolled_window_new(NULL, NULL);
  gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(room), GTK_POLICY_AUTOMATIC, GTK_POLICY_NEVER);
  gtk_container_add(GTK_CONTAINER(room), GTK_WIDGET(bar));
  gtk_box_pack_start(GTK_BOX(page->box), room, FALSE, FALSE, 0);
  gtk_widget_show_all(room);
}

GtkWidget *sb_calibrate_page_new(SbSession *session) {
  Page *page = g_new0(Page, 1);
  page->session = g_object_ref(session);
  page->box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
  g_object_set_data_full(G_OBJECT(page->box), "page", page, page_free);
  page->area = gtk_drawing_area_new();
  sb_style_class(page->area, "sb-canvas");
  gtk_widget_set_can_focus(page->area, TRUE);
  gtk_widget_set_size_request(page->area, 640, 320);
  atk_object_set_role(gtk_widget_get_accessible(page->area), ATK_ROLE_CHART);
  page->cache = sb_draw_cache_attach(page->area, draw, page);
  add_toolbar(page);
  gtk_box_pack_start(GTK_BOX(page->box), page->area, TRUE, TRUE, 0);
  gtk_widget_show(page->area);
  g_signal_connect(page->box, "destroy", G_CALLBACK(on_destroy), page);
  g_signal_connect_swapped(page->box, "map", G_CALLBACK(on_look), page);
  g_signal_connect_object(page->session, "params-changed", G_CALLBACK(on_params), page->box, 0);
  refresh(page);
  gtk_widget_show(page->box);
  return page->box;
}
