// See choice.h.
#include "app/base/choice.h"

#include <string.h>

void sb_choice_init(SbChoice *choice, const char *key, const char *values, size_t remedy) {
  *choice = (SbChoice){g_strdup(key), g_new0(char *, 2), remedy};
  if (values != NULL && *values == '\0') {
    choice->value[0] = g_strdup("");
  } else if (values != NULL) {
    g_strfreev(choice->value);
    choice->value = g_strsplit(values, "\n", -1);
  }
}

void sb_choice_copy(SbChoice *choice, const SbChoice *from) {
  *choice = (SbChoice){g_strdup(from->key), g_strdupv(from->value), from->remedy};
}

void sb_choice_clear(SbChoice *choice) {
  g_free(choice->key);
  g_strfreev(choice->value);
  *choice = (SbChoice){0};
}

char *sb_choice_problem(const SbChoice *choice, const char *message) {
  const size_t length = strlen(message);
  return g_strndup(message, length - MIN(choice->remedy, length));
}

// ---- Words for the columns of a table ----

void sb_choice_place(char **layout, size_t column, const char *word) {
  g_auto(GStrv) words = g_strsplit(*layout, ", ", -1);
  const size_t count = g_strv_length(words);
  GString *out = g_string_new(NULL);
  for (size_t i = 0; i < MAX(count, column); i++) {
    const char *here = i + 1 == column && *word != '\0' ? word
                       : i < count && i + 1 != column   ? words[i]
                                                        : "-";
    g_string_append_printf(out, "%s%s", i > 0 ? ", " : "", here);
  }
  g_free(*layout);
  *layout = g_string_free(out, FALSE);
}

char *sb_choice_layouts(const char *layout, guint64 columns, const char *words) {
  enum { BITS = 64 };
  g_auto(GStrv) each = g_strsplit(words, "\n", -1);
  GString *out = g_string_new(NULL);
  for (size_t i = 0; i < BITS; i++) {
    for (char **word = each; (columns >> i & 1) != 0 && *word != NULL; word++) {
      g_autofree char *one = g_strdup(layout);
      sb_choice_place(&one, i + 1, *word);
      g_string_append_printf(out, "%s%s", out->len > 0 ? "\n" : "", one);
    }
  }
  return g_string_free(out, out->len == 0);
}
