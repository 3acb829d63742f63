// See pin_names.h.
#include "app/session/pin_names.h"

#include "app/base/translation.h"

#include <glib/gi18n.h>

// Differences that a name tells.
enum { NAMED_MAX = 2 };

// Whether a parameter tells a pin from the present values; not where it follows from others.
static bool differs(const SbParams *pin, const SbParams *now, SbParamId id) {
  return (pin->given[id] || now->given[id]) && sb_params_get(pin, id) != sb_params_get(now, id);
}

// Whether it tells the pins from each other.
static bool parts_pins(const SbDocument *document, SbParamId id) {
  bool parts = false;
  for (size_t i = 1; i < sb_document_pin_count(document); i++) {
    parts = parts || sb_params_get(sb_document_pin_params(document, i), id) !=
                         sb_params_get(sb_document_pin_params(document, 0), id);
  }
  return parts;
}

// What a pin is called: what it differs in from the present values, "section diameter 1.63 mm";
// where that are several, what the pins have in common is left out.
static char *differences(const SbDocument *document, const SbParams *pin) {
  const SbParams now = sb_document_params(document);
  int id[SB_PARAM_COUNT], count = 0, telling = 0;
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    if (differs(pin, &now, (SbParamId)i)) {
      id[count++] = i;
      telling += parts_pins(document, (SbParamId)i);
    }
  }
  g_autoptr(GString) text = g_string_new(NULL);
  int named = 0, told = telling > 0 ? telling : count;
  for (int k = 0; k < count && named < NAMED_MAX; k++) {
    if (telling > 0 && !parts_pins(document, (SbParamId)id[k])) {
      continue;
    }
    const SbParam *param = sb_param((SbParamId)id[k]);
    g_autofree char *shown =
        sb_param_format((SbParamId)id[k], sb_params_get(pin, (SbParamId)id[k]));
    g_autofree char *label =
        param->kind == SB_PARAM_CHOICE ? g_strdup("") : sb_translation_inside(param->label);
    g_string_append_printf(text, "%s%s%s%s", named > 0 ? ", " : "", label,
                           *label != '\0' ? " " : "", shown);
    named++;
  }
  if (told > named) {
    g_string_append_printf(text, _(" and %d more"), told - named);
  }
  if (named == 0) {
    g_string_append(text, _("as now"));
  }
  return g_string_free(g_steal_pointer(&text), FALSE);
}

char *sb_pin_name(const SbDocument *document, size_t index) {
  const char *given = sb_document_pin_name(document, index);
  return given != NULL ? g_strdup(given)
                       : differences(document, sb_document_pin_params(document, index));
}
