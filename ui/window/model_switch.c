// Follows the document: another fitment than these two (of `list models`) presses neither button.
#include "ui/window/model_switch.h"
#include "app/base/device.h"

#include "ui/views/signals.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>

typedef struct {
  SbSession *session;
  GtkWidget *box, *button[2];
  gboolean refreshing; // changes come from the session, not from the user
} Switch;

static const struct {
  const char *label, *brief, *value, *tip;
  int fit;
} model_choices[2] = {
    {N_("Closed form"), N_("Closed"), "karaszkiewicz",
     N_("Rings by the closed form of Karaszkiewicz: immediate"), SB_FIT_KARASZKIEWICZ},
    {N_("Rings solved"), N_("Solved"), "ring", N_("Rings solved by finite elements: seconds"),
     SB_FIT_RING},
};

static void refresh_models(Switch *self) {
  const int fit = (int)sb_document_value(sb_session_document(self->session), SB_P_MODELS_FIT);
  self->refreshing = TRUE;
  for (int i = 0; i < 2; i++) {
    gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(self->button[i]), fit == model_choices[i].fit);
  }
  self->refreshing = FALSE;
  const SbModel *model = sb_session_model(self->session);
  gtk_widget_set_visible(self->box, sb_device(model)->gland);
}

static void on_toggled(GtkToggleButton *button, Switch *self) {
  if (self->refreshing) {
    return;
  }
  const int chosen = GTK_WIDGET(button) == self->button[1];
  if (gtk_toggle_button_get_active(button)) {
    sb_session_edit(self->session, SB_P_MODELS_FIT, model_choices[chosen].value);
  }
  refresh_models(self); // what is pressed stays so
}

GtkWidget *sb_model_switch_new(SbSession *session) {
  Switch *self = g_new0(Switch, 1);
  self->session = session;
  GtkWidget *box = self->box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
  sb_style_class(box, "linked");
  for (int i = 0; i < 2; i++) {
    self->button[i] = gtk_toggle_button_new_with_label(_(model_choices[i].label));
    sb_style_name(self->button[i], _(model_choices[i].label), NULL);
    gtk_widget_set_tooltip_text(self->button[i], _(model_choices[i].tip));
    gtk_box_pack_start(GTK_BOX(box), self->button[i], FALSE, FALSE, 0);
    g_signal_connect(self->button[i], "toggled", G_CALLBACK(on_toggled), self);
  }
  sb_style_name(box, _("Model of the rings"), NULL);
  g_object_set_data_full(G_OBJECT(box), "switch", self, g_free);
  sb_signals_end_with(box, self->session, self);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(refresh_models), self);
  gtk_widget_show_all(box);
  refresh_models(self);
  return box;
}

void sb_model_switch_set_short(GtkWidget *widget, gboolean on) {
  Switch *self = g_object_get_data(G_OBJECT(widget), "switch");
  for (int i = 0; i < 2; i++) {
    gtk_button_set_label(GTK_BUTTON(self->button[i]),
                         _(on ? model_choices[i].brief : model_choices[i].label));
  }
}
