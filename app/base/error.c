// See error.h.
#include "app/base/error.h"

#include "app/base/issue.h"

#include <string.h>

bool sb_app_error_input(GError **error, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *text = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  g_autofree char *shown = sb_printable(text, strlen(text));
  g_set_error_literal(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, shown);
  return false;
}

void sb_app_error_prefix(GError **error, const char *name) {
  g_autofree char *shown = sb_printable(name, strlen(name));
  g_prefix_error(error, "%s: ", shown);
}

// clang-format off
G_DEFINE_QUARK(sb-app-error-quark, sb_app_error)
