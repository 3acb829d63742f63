// See error.h.
#include "app/base/error.h"

#include "app/base/issue.h"

#include <string.h>

typedef SbChoice SbAppErrorPrivate;

static void sb_app_error_private_init(SbAppErrorPrivate *choice) {
  *choice = (SbAppErrorPrivate){0};
}

static void sb_app_error_private_copy(const SbAppErrorPrivate *from, SbAppErrorPrivate *to) {
  sb_choice_copy(to, from);
}

static void sb_app_error_private_clear(SbAppErrorPrivate *choice) {
  sb_choice_clear(choice);
}

// clang-format off
G_DEFINE_EXTENDED_ERROR(SbAppError, sb_app_error)
// clang-format on

bool sb_app_error_input(GError **error, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *text = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  g_autofree char *shown = sb_printable(text, strlen(text));
  g_set_error_literal(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, shown);
  return false;
}

bool sb_app_error_choose(GError **error, const char *key, const char *values, const char *format,
                         ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *problem = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  const bool any = values != NULL && *values != '\0';
  g_autofree char *list = g_strconcat(any ? "=" : "", values, NULL);
  g_strdelimit(list, "\n", '|');
  g_autofree char *remedy =
      key == NULL ? g_strdup("")
                  : g_strdup_printf(": %s --%s%s",
                                    any || values == NULL ? "specify it with" : "omit", key, list);
  GError *own = NULL;
  sb_app_error_input(&own, "%s%s", problem, remedy);
  const char *own_key = key != NULL && strchr(key, '=') != NULL ? strchr(key, '=') + 1 : key;
  sb_choice_init(sb_app_error_get_private(own), own_key, values, strlen(remedy));
  g_propagate_error(error, own);
  return false;
}

const SbChoice *sb_app_error_choice(const GError *error) {
  const SbChoice *choice = error->domain == SB_APP_ERROR ? sb_app_error_get_private(error) : NULL;
  return choice != NULL && choice->key != NULL ? choice : NULL;
}

void sb_app_error_prefix(GError **error, const char *name) {
  g_autofree char *shown = sb_printable(name, strlen(name));
  g_prefix_error(error, "%s: ", shown);
}
