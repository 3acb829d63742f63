// See message_strip.h.
#include "ui/window/message_strip.h"

#include "app/base/translation.h"
#include "ui/views/later.h"
#include "ui/views/signals.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <string.h>

// A former run's strip comes when the run of the present values takes longer: what a short one
// replaces at once does not push the section down and up again [ms].
enum { SOON = 500 };

typedef struct {
  SbSession *session;
  GtkWidget *revealer, *box, *icon, *label, *button;
  const char *action;     // that the button starts; NULL: it does what follows
  int id;                 // parameter that the button mends, or -1
  double value;           // and the value it sets [SI]
  SbLater soon;           // shows a former run's strip
  gboolean waited, finds; // long enough; what the run found is told
} Strip;

static void show(Strip *strip, const char *kind, const char *text, const char *button) {
  gtk_revealer_set_reveal_child(GTK_REVEALER(strip->revealer), text != NULL);
  gtk_widget_set_visible(strip->revealer, text != NULL);
  strip->finds = FALSE;
  if (text == NULL) {
    return;
  }
  GtkStyleContext *style = gtk_widget_get_style_context(strip->box);
  gtk_style_context_remove_class(style, "warn");
  gtk_style_context_remove_class(style, "error");
  gtk_style_context_add_class(style, kind);
  gtk_image_set_from_icon_name(GTK_IMAGE(strip->icon),
                               strcmp(kind, "error") == 0 ? "dialog-error-symbolic"
                                                          : "dialog-warning-symbolic",
                               GTK_ICON_SIZE_MENU);
  gtk_label_set_text(GTK_LABEL(strip->label), text);
  gtk_widget_set_visible(strip->button, button != NULL);
  if (button != NULL) {
    gtk_button_set_label(GTK_BUTTON(strip->button), button);
  }
}

// What the displayed run found of the valve that nobody may miss, in full sentences; NULL if
// nothing.
static char *findings_text(const SbSummary *summary) {
  g_autoptr(GString) text = g_string_new(NULL);
  for (size_t i = 0; summary != NULL && i < summary->warnings.count; i++) {
    const SbWarning *warning = &summary->warnings.item[i];
    if (warning->serious) {
      gsize start = text->len + (text->len > 0 ? 1 : 0);
      g_string_append_printf(text, "%s%s.", text->len > 0 ? " " : "", warning->text);
      text->str[start] = g_ascii_toupper(text->str[start]);
    }
  }
  return text->len > 0 ? g_string_free(g_steal_pointer(&text), FALSE) : NULL;
}

static void refresh_message(Strip *strip);

static void on_soon(gpointer data) {
  Strip *strip = data;
  strip->waited = TRUE;
  refresh_message(strip);
}

static void stop_waiting(Strip *strip) {
  sb_later_cancel(&strip->soon);
  strip->waited = FALSE;
}

// The document's file, or its valve's, is not what it was when it was read. FALSE: it is.
static gboolean show_disk(Strip *strip) {
  const SbDiskState state = sb_session_disk_state(strip->session);
  strip->action = NULL;
  if (state == SB_DISK_SAME) {
    return FALSE;
  }
  g_autofree char *name =
      g_filename_display_basename(sb_document_path(sb_session_document(strip->session)));
  g_autofree char *text = g_strdup_printf(
      state == SB_DISK_CHANGED ? _("%s was changed by another program since it was opened here.")
      : state == SB_DISK_VALVE_CHANGED
          ? _("The valve's file of %s was changed by another program since it was opened here.")
          : _("%s is no longer in its folder. Saving writes the file again."),
      name);
  strip->action = state != SB_DISK_GONE ? "file-changed" : NULL;
  show(strip, "warn", text, strip->action != NULL ? _("Choose…") : NULL);
  return TRUE;
}

// What is wrong with the values or the run and the one button that mends it, or else what the run
// found.
// Names a value that is out of range, inconsistent or not readable, and offers the last good one.
static void show_wrong(Strip *strip, SbParamId wrong) {
  SbSession *session = strip->session;
  int differs = -1;
  double value = 0;
  const SbParam *param = sb_param(wrong);
  double old = sb_document_value(sb_session_document(session), wrong);
  if (sb_session_is_stale(session, &differs, &value) && differs == (int)wrong) {
    old = value;
  }
  g_autofree char *shown = sb_param_format(wrong, old);
  g_autofree char *label = sb_translation_inside(param->label);
  const char *what = sb_session_rejected(session, wrong) == NULL
                         ? _("is inconsistent with the other values")
                     : sb_session_is_out_of_range(session, wrong) ? _("is out of range")
                                                                  : _("cannot be read");
  g_autofree char *text = g_strdup_printf(sb_session_run(session) != NULL
                                              ? _("%s %s. Pictures show the last good run, %s %s.")
                                              : _("%s %s. Nothing has run yet; %s %s would do."),
                                          sb_translation(param->label), what, label, shown);
  g_autofree char *button = g_strdup_printf(_("Set %s"), shown);
  strip->id = (int)wrong;
  strip->value = old;
  show(strip, "warn", text, button);
}

static void refresh_message(Strip *strip) {
  SbSession *session = strip->session;
  const char *failure = sb_session_failure(session);
  int wrong = sb_session_first_error(session);
  g_autofree char *former = sb_session_former_text(session);
  strip->id = -1;
  const gboolean awaits = wrong < 0 && failure == NULL && sb_session_awaits(session);
  if (!awaits) {
    stop_waiting(strip);
  }
  if (show_disk(strip)) {
    return;
  }
  if (sb_session_is_faulty(session)) {
    show(strip, "error", failure, NULL);
  } else if (wrong >= 0) {
    show_wrong(strip, (SbParamId)wrong);
  } else if (failure != NULL) {
    g_autofree char *text = former != NULL
                                ? g_strdup_printf(_("%s Pictures show the %s."), failure, former)
                                : g_strdup(failure);
    show(strip, "error", text, _("Run again"));
  } else if (sb_session_state(session) == SB_SESSION_PARTIAL && former == NULL) {
    size_t count = 0;
    const SbFrame *frames = sb_session_frames(session, &count);
    g_autofree char *text =
        g_strdup_printf(_("Cancelled after %.1f s of the cycle: the pictures are partial."),
                        count > 0 ? frames[count - 1].time : 0);
    show(strip, "warn", text, _("Run again"));
  } else if (former != NULL && awaits && !strip->waited) {
    sb_later_ensure(&strip->soon, strip->revealer, SOON, on_soon, strip);
    if (!strip->finds) {
      show(strip, NULL, NULL, NULL);
    }
  } else if (former != NULL) {
    gboolean running = sb_session_state(session) == SB_SESSION_RUNNING;
    g_autofree char *text =
        g_strdup_printf(!running ? _("Values have changed. Pictures show the %s.")
                        : sb_session_chart(session)->predicted != NULL
                            ? _("Until the new run is solved the pictures show the %s; dashed "
                                "curves and pale figures are predicted.")
                            : _("Until the first new frame the pictures show the %s."),
                        former);
    show(strip, "warn", text, running ? NULL : _("Run"));
  } else {
    g_autofree char *findings = findings_text(sb_session_summary(session));
    show(strip, "warn", findings, NULL);
    strip->finds = findings != NULL;
  }
}

static void on_button(GtkButton *button, Strip *strip) {
  if (strip->action != NULL) {
    GtkWidget *window = gtk_widget_get_toplevel(strip->box);
    g_action_group_activate_action(G_ACTION_GROUP(window), strip->action, NULL);
  } else if (strip->id >= 0) {
    int id = strip->id;
    sb_session_clear_error(strip->session, (SbParamId)id);
    sb_session_edit_value(strip->session, (SbParamId)id, strip->value);
  } else {
    sb_session_start(strip->session);
  }
}

GtkWidget *sb_message_strip_new(SbSession *session) {
  Strip *strip = g_new0(Strip, 1);
  strip->session = session;
  strip->revealer = gtk_revealer_new();
  g_object_set_data_full(G_OBJECT(strip->revealer), "strip", strip, g_free);
  gtk_revealer_set_transition_duration(GTK_REVEALER(strip->revealer), 0);
  strip->box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
  sb_style_class(strip->box, "sb-strip");
  strip->icon = gtk_image_new();
  gtk_container_add(GTK_CONTAINER(strip->box), strip->icon);
  strip->label = gtk_label_new(NULL);
  gtk_label_set_xalign(GTK_LABEL(strip->label), 0);
  gtk_label_set_line_wrap(GTK_LABEL(strip->label), TRUE);
  gtk_widget_set_hexpand(strip->label, TRUE);
  gtk_container_add(GTK_CONTAINER(strip->box), strip->label);
  strip->button = gtk_button_new_with_label(_("Run"));
  gtk_container_add(GTK_CONTAINER(strip->box), strip->button);
  gtk_container_add(GTK_CONTAINER(strip->revealer), strip->box);
  gtk_widget_show_all(strip->revealer);
  g_signal_connect(strip->button, "clicked", G_CALLBACK(on_button), strip);
  sb_signals_end_with(strip->revealer, strip->session, strip);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(refresh_message), strip);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(refresh_message), strip);
  refresh_message(strip);
  return strip->revealer;
}
