// Studies of the present document. Choosing one computes it on a thread of its own; the earlier
// picture stays until then. A change of values does not start anything (a study may take seconds):
// it marks the picture as stale and offers to compute again. What is drawn is the very page that an
// export writes.
#include "ui/window/study_window.h"

#include "app/base/own_model.h"
#include "app/base/translation.h"
#include "app/chart/study.h"
#include "app/export/studies.h"
#include "app/session/study_job.h"
#include "app/session/worker.h"
#include "ui/views/draw_cache.h"
#include "ui/views/later.h"
#include "ui/views/style.h"
#include "ui/window/export_dialog.h"
#include "ui/window/preferences.h"

#include <glib/gi18n.h>

typedef struct {
  SbSession *session; // owned reference
  GtkWidget *window, *kind, *again, *stop, *progress, *message, *area, *path, *export, *copy, *help;
  SbDrawCache *cache;
  SbStudyJob *job;
  SbLater poll, later;
  SbStudyKind asked; // what the job computes
  SbModel *asked_model;
  char *asked_hash, *asked_scene;
  SbStudy *study; // shown; NULL until the first is done
  SbModel *model; // it belongs to this
  char *hash, *scene;
} Studies;

static SbStudyKind chosen(Studies *studies) {
  return (SbStudyKind)MAX(gtk_combo_box_get_active(GTK_COMBO_BOX(studies->kind)), 0);
}

static gboolean is_stale(Studies *studies) {
  if (studies->study == NULL) {
    return FALSE;
  }
  g_autofree char *now = sb_document_sha256(sb_session_document(studies->session));
  return sb_session_model(studies->session) == NULL || g_strcmp0(now, studies->hash) != 0;
}

static const char *const STALE = "of earlier values";

static SbStudyPage make_page(Studies *studies, gboolean stale) {
  return (SbStudyPage){.model = studies->model,
                       .title = sb_document_title(sb_session_document(studies->session)),
                       .hash = studies->hash,
                       .scene = studies->scene,
                       .stale = stale ? STALE : NULL,
                       .dark = sb_style_is_dark()};
}

static void draw_study(cairo_t *cr, double width, double height, void *data) {
  Studies *studies = data;
  SbRect rect = {0, 0, width, height};
  if (studies->study != NULL) {
    SbStudyPage page = make_page(studies, is_stale(studies));
    sb_study_page_draw(cr, rect, studies->study, &page);
    return;
  }
  (void)sb_style_ground(cr, SB_ROLE_BACKGROUND);
}

// State to widgets -------------------------------------------------------------------------------

static void set_study_status(Studies *studies, const char *text, const char *style) {
  GtkStyleContext *context = gtk_widget_get_style_context(studies->message);
  gtk_style_context_remove_class(context, "sb-warn");
  gtk_style_context_remove_class(context, "sb-error");
  gtk_style_context_remove_class(context, "sb-pass");
  if (style != NULL) {
    gtk_style_context_add_class(context, style);
  }
  gtk_label_set_text(GTK_LABEL(studies->message), text);
}

static void refresh_study(Studies *studies) {
  gboolean busy = studies->job != NULL;
  gboolean possible = sb_session_model(studies->session) != NULL;
  gtk_widget_set_visible(studies->stop, busy);
  gtk_widget_set_visible(studies->progress, busy);
  gtk_widget_set_visible(studies->again, !busy);
  gtk_widget_set_sensitive(studies->again, possible);
  gtk_widget_set_sensitive(studies->export, !busy && studies->study != NULL);
  gtk_widget_set_sensitive(studies->copy, studies->study != NULL);
  gtk_label_set_text(GTK_LABEL(studies->help), sb_translation(sb_study_help(chosen(studies))));
  AtkObject *accessible = gtk_widget_get_accessible(studies->area);
  g_autofree char *text =
      studies->study == NULL ? g_strdup(_("No study yet."))
      : busy ? g_strdup(_("A study is being computed; the picture is of the one before."))
             : sb_study_text(studies->study);
  atk_object_set_description(accessible, text);
  // The picture is of a former study while another is computed, of former values once they changed.
  sb_style_former(studies->area, studies->study != NULL && (busy || is_stale(studies)));
  sb_draw_cache_change(studies->cache, 0);
}

// Values have changed, or the study is done: does what is shown still belong to them?
static void judge(Studies *studies) {
  if (studies->job == NULL && studies->study != NULL) {
    if (sb_session_model(studies->session) == NULL) {
      set_study_status(
          studies, _("The values are inconsistent now; the study shown belongs to earlier values."),
          "sb-warn");
    } else if (is_stale(studies)) {
      set_study_status(studies, _("Values have changed: the study shown is of earlier ones."),
                       "sb-warn");
    } else if (!studies->study->complete) {
      set_study_status(studies,
                       _("A solver did not converge at every point; such points are omitted."),
                       "sb-error");
    } else {
      set_study_status(studies, "", NULL);
    }
  }
  refresh_study(studies);
}

// The job ----------------------------------------------------------------------------------------

static void on_study_poll(gpointer data) {
  Studies *studies = data;
  gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(studies->progress),
                                sb_worker_progress(studies->job));
}

static void end_study_job(Studies *studies) {
  sb_later_cancel(&studies->poll);
  g_clear_pointer(&studies->job, sb_study_job_free);
}

static void follow_kind(Studies *studies) {
  g_autofree char *folder = sb_preferences_string("export-folder", g_get_home_dir());
  g_autofree char *name = g_strdup_printf("study-%s.png", sb_study_name(chosen(studies)));
  g_autofree char *path = g_build_filename(folder, name, NULL);
  gtk_entry_set_text(GTK_ENTRY(studies->path), path);
}

static void on_study_done(void *data) {
  Studies *studies = data;
  const char *why = NULL;
  SbStudy *study = sb_study_job_take(studies->job, &why);
  g_autofree char *text = g_strdup_printf(_("No study: %s."), why != NULL ? why : "");
  end_study_job(studies);
  if (study != NULL) {
    g_free(studies->study);
    g_free(studies->hash);
    g_free(studies->scene);
    studies->study = study;
    sb_model_destroy(studies->model);
    studies->model = g_steal_pointer(&studies->asked_model);
    studies->hash = g_steal_pointer(&studies->asked_hash);
    studies->scene = g_steal_pointer(&studies->asked_scene);
    judge(studies);
  } else {
    refresh_study(studies);
    set_study_status(studies, text, "sb-warn");
  }
}

static void compute_study(Studies *studies) {
  const SbModel *model = sb_session_model(studies->session);
  end_study_job(studies);
  if (model == NULL) {
    set_study_status(studies, _("The values are inconsistent: correct them first."), "sb-error");
    refresh_study(studies);
    return;
  }
  const SbDocument *document = sb_session_document(studies->session);
  studies->asked = chosen(studies);
  sb_model_destroy(studies->asked_model);
  studies->asked_model = sb_own_model(model);
  g_free(studies->asked_hash);
  g_free(studies->asked_scene);
  studies->asked_hash = sb_document_sha256(document);
  studies->asked_scene = sb_document_to_flat_text(document);
  g_autofree char *text =
      studies->study != NULL
          ? g_strdup_printf(_("Computing: %s. The picture is of the study before."),
                            sb_translation(sb_study_title(studies->asked)))
          : g_strdup_printf(_("Computing: %s"), sb_translation(sb_study_title(studies->asked)));
  set_study_status(studies, text, NULL);
  gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(studies->progress), 0);
  studies->job = sb_study_job_start(studies->asked, model, on_study_done, studies);
  sb_later_repeat(&studies->poll, studies->window, 50, on_study_poll, studies);
  refresh_study(studies);
}

// Actions ----------------------------------------------------------------------------------------

static void on_kind(GtkComboBox *combo, Studies *studies) {
  follow_kind(studies);
  compute_study(studies);
}

static void on_again(GtkButton *button, Studies *studies) {
  compute_study(studies);
}

static void on_study_stop(GtkButton *button, Studies *studies) {
  if (studies->job != NULL) {
    sb_worker_cancel(studies->job);
  }
}

static gboolean on_study_key(GtkWidget *widget, GdkEventKey *event, Studies *studies) {
  gboolean control = (event->state & gtk_accelerator_get_default_mod_mask()) == GDK_CONTROL_MASK;
  if (event->keyval == GDK_KEY_Escape || (control && event->keyval == GDK_KEY_w)) {
    gtk_window_close(GTK_WINDOW(widget));
    return GDK_EVENT_STOP;
  }
  return GDK_EVENT_PROPAGATE;
}

static void on_copy(GtkButton *button, Studies *studies) {
  g_autofree char *text = sb_study_text(studies->study);
  gtk_clipboard_set_text(gtk_clipboard_get(GDK_SELECTION_CLIPBOARD), text, -1);
}

static void export_page(gpointer data) {
  Studies *studies = data;
  const char *path = gtk_entry_get_text(GTK_ENTRY(studies->path));
  if (studies->study == NULL || studies->job != NULL) {
    return;
  }
  if (!g_path_is_absolute(path)) {
    set_study_status(studies, _("The file needs its folder: an absolute path."), "sb-error");
    return;
  }
  if (!sb_export_may_replace(GTK_WINDOW(studies->window), path)) {
    return;
  }
  g_autofree char *folder = g_path_get_dirname(path);
  sb_preferences_set_string("export-folder", folder);
  SbStudyPage page = make_page(studies, is_stale(studies));
  g_autoptr(GError) error = NULL;
  g_autofree char *name = g_filename_display_basename(path);
  g_autofree char *text = NULL;
  if (sb_study_still(studies->study, &page, path, &error)) {
    text = g_strdup_printf(_("%s is written."), name);
    set_study_status(studies, text, "sb-pass");
  } else {
    text = g_strdup_printf(_("Nothing was written: %s."), error->message);
    set_study_status(studies, text, "sb-error");
  }
}

// The question runs a loop of its own, which must not start inside a call from a screen reader.
static void on_export(GtkButton *button, Studies *studies) {
  sb_later_ensure(&studies->later, studies->window, 0, export_page, studies);
}

// Life -------------------------------------------------------------------------------------------

static void on_study_destroy(GtkWidget *widget, Studies *studies) {
  end_study_job(studies);
  g_signal_handlers_disconnect_by_data(studies->session, studies);
  g_object_unref(studies->session);
  g_free(studies->asked_hash);
  g_free(studies->asked_scene);
  g_free(studies->study);
  g_free(studies->hash);
  g_free(studies->scene);
  sb_model_destroy(studies->model);
  sb_model_destroy(studies->asked_model);
  g_free(studies);
}

// The study that the scene asks for, else the first.
static int first_kind(SbSession *session) {
  const SbModel *model = sb_session_model(session);
  for (int i = 0; model != NULL && i < SB_STUDY_COUNT; i++) {
    if (((unsigned)sb_model_number(model, SB_P_OUTPUT_STUDIES) & (1u << i)) != 0) {
      return i;
    }
  }
  return 0;
}

void sb_study_window_open(GtkWindow *parent, SbSession *session) {
  Studies *studies = g_new0(Studies, 1);
  studies->session = g_object_ref(session);
  g_autoptr(GtkBuilder) builder = gtk_builder_new_from_resource("/org/sealbench/ui/study.ui");
  const struct {
    const char *id;
    GtkWidget **widget;
  } parts[] = {
      {"window", &studies->window},     {"kind", &studies->kind},
      {"again", &studies->again},       {"stop", &studies->stop},
      {"progress", &studies->progress}, {"message", &studies->message},
      {"area", &studies->area},         {"path", &studies->path},
      {"export", &studies->export},     {"copy", &studies->copy},
      {"help", &studies->help},
  };
  for (guint i = 0; i < G_N_ELEMENTS(parts); i++) {
    *parts[i].widget = GTK_WIDGET(gtk_builder_get_object(builder, parts[i].id));
  }
  gtk_window_set_transient_for(GTK_WINDOW(studies->window), parent);
  gtk_window_set_destroy_with_parent(GTK_WINDOW(studies->window), TRUE);
  for (int i = 0; i < SB_STUDY_COUNT; i++) {
    gtk_combo_box_text_append(GTK_COMBO_BOX_TEXT(studies->kind), sb_study_name((SbStudyKind)i),
                              sb_translation(sb_study_title((SbStudyKind)i)));
  }
  gtk_combo_box_set_active(GTK_COMBO_BOX(studies->kind), first_kind(session));
  sb_style_window(studies->window);
  sb_style_class(studies->area, "sb-canvas");
  gtk_widget_set_can_focus(studies->area, TRUE);
  sb_style_name(studies->area, _("Study"), NULL);
  atk_object_set_role(gtk_widget_get_accessible(studies->area), ATK_ROLE_CHART);
  studies->cache = sb_draw_cache_attach(studies->area, draw_study, studies);
  follow_kind(studies);
  g_signal_connect(studies->kind, "changed", G_CALLBACK(on_kind), studies);
  g_signal_connect(studies->again, "clicked", G_CALLBACK(on_again), studies);
  g_signal_connect(studies->stop, "clicked", G_CALLBACK(on_study_stop), studies);
  g_signal_connect(studies->copy, "clicked", G_CALLBACK(on_copy), studies);
  g_signal_connect(studies->export, "clicked", G_CALLBACK(on_export), studies);
  g_signal_connect(studies->window, "key-press-event", G_CALLBACK(on_study_key), studies);
  g_signal_connect(studies->window, "destroy", G_CALLBACK(on_study_destroy), studies);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(judge), studies);
  compute_study(studies);
  gtk_window_present(GTK_WINDOW(studies->window));
}
