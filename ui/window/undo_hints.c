// An edit reads as it was made, whichever way it is about to go.
#include "ui/window/undo_hints.h"

#include "app/base/translation.h"

#include <glib/gi18n.h>
#include <string.h>

typedef struct {
  SbSession *session;
  GtkWidget *button[2]; // undo, redo
} Hints;

char *sb_undo_hints_text(const SbDocument *document, bool redo) {
  double value[2];
  const int id = sb_document_next_undo(document, redo, value);
  if (id < 0) {
    return NULL;
  }
  if (id == SB_DOCUMENT_RUBBER) {
    return g_strdup(_("Rubber"));
  }
  if (id == SB_DOCUMENT_MEASURED) {
    return g_strdup(_("Measured data"));
  }
  if (id == SB_DOCUMENT_SECTION) {
    return g_strdup(_("Drawn section"));
  }
  if (id == SB_DOCUMENT_GROOVE) {
    return g_strdup(_("Drawn groove"));
  }
  if (id == SB_DOCUMENT_WHOLE) {
    return g_strdup(_("Another version of the file"));
  }
  const SbParam *param = sb_param((SbParamId)id);
  g_autofree char *before = sb_param_format((SbParamId)id, value[0]);
  g_autofree char *after = sb_param_format((SbParamId)id, value[1]);
  // One unit will do where both have it.
  char *unit = strchr(before, ' ');
  if (unit != NULL && g_str_has_suffix(after, unit)) {
    *unit = '\0';
  }
  const char *owner = g_str_has_prefix(param->key, "seal.outer.")   ? _("Outer seal: ")
                      : g_str_has_prefix(param->key, "seal.inner.") ? _("Inner seal: ")
                                                                    : "";
  return g_strdup_printf("%s%s %s → %s", owner, sb_translation(param->label), before, after);
}

static void refresh(Hints *hints) {
  const SbDocument *document = sb_session_document(hints->session);
  for (int redo = 0; redo < 2; redo++) {
    g_autofree char *what = sb_undo_hints_text(document, redo);
    const char *plain = redo ? _("Redo (Ctrl+Shift+Z)") : _("Undo (Ctrl+Z)");
    g_autofree char *tip = what != NULL ? g_strdup_printf("%s\n%s", plain, what) : g_strdup(plain);
    gtk_widget_set_tooltip_text(hints->button[redo], tip);
    atk_object_set_description(gtk_widget_get_accessible(hints->button[redo]),
                               what != NULL ? what : "");
  }
}

static void on_destroy(GtkWidget *widget, Hints *hints) {
  g_signal_handlers_disconnect_by_data(hints->session, hints);
}

void sb_undo_hints_attach(SbSession *session, GtkWidget *undo, GtkWidget *redo) {
  Hints *hints = g_new0(Hints, 1);
  *hints = (Hints){session, {undo, redo}};
  g_object_set_data_full(G_OBJECT(undo), "hints", hints, g_free);
  g_signal_connect(undo, "destroy", G_CALLBACK(on_destroy), hints);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(refresh), hints);
  refresh(hints);
}
