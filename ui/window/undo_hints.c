// An edit has the same text for undo and redo: its value before, then its value after.
#include "ui/window/undo_hints.h"

#include "app/base/translation.h"
#include "app/session/param_list.h"

#include <glib/gi18n.h>
#include <string.h>

// Edits of files and of the complete document.
static const char *const file_edits[] = {
    [SB_DOCUMENT_RUBBER - SB_PARAM_COUNT] = N_("Rubber"),
    [SB_DOCUMENT_MEASURED - SB_PARAM_COUNT] = N_("Measured data"),
    [SB_DOCUMENT_SECTION - SB_PARAM_COUNT] = N_("Drawn section"),
    [SB_DOCUMENT_GROOVE - SB_PARAM_COUNT] = N_("Drawn groove"),
    [SB_DOCUMENT_WHOLE - SB_PARAM_COUNT] = N_("Another version of the file"),
};

char *sb_undo_hints_text(const SbDocument *document, bool redo) {
  double value[2];
  const int id = sb_document_next_undo(document, redo, value);
  if (id < 0) {
    return NULL;
  }
  if (id >= SB_PARAM_COUNT) {
    return g_strdup(_(file_edits[id - SB_PARAM_COUNT]));
  }
  const SbParam *param = sb_param((SbParamId)id);
  g_autofree char *before = sb_param_format((SbParamId)id, value[0]);
  g_autofree char *after = sb_param_format((SbParamId)id, value[1]);
  // The unit is given once if both values have the same one.
  char *unit = strchr(before, ' ');
  if (unit != NULL && g_str_has_suffix(after, unit)) {
    *unit = '\0';
  }
  return g_strdup_printf("%s%s %s → %s", sb_param_owner((SbParamId)id),
                         sb_translation(param->label), before, after);
}

void sb_undo_hints_show(GtkWidget *button, const SbDocument *document, bool redo) {
  g_autofree char *what = sb_undo_hints_text(document, redo);
  const char *plain = redo ? _("Redo (Ctrl+Shift+Z)") : _("Undo (Ctrl+Z)");
  g_autofree char *tip = what != NULL ? g_strdup_printf("%s\n%s", plain, what) : g_strdup(plain);
  gtk_widget_set_tooltip_text(button, tip);
  atk_object_set_description(gtk_widget_get_accessible(button), what != NULL ? what : "");
}
