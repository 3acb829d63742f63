// The one error domain of app.
#pragma once

#include <glib.h>

// How messages and exit codes are sorted. INPUT is the user's, IO the system's.
typedef enum {
  SB_APP_ERROR_INPUT,
  SB_APP_ERROR_IO,
  SB_APP_ERROR_CANCELLED,
  SB_APP_ERROR_NOT_CONVERGED,
  SB_APP_ERROR_CHANGED // another program has changed the file
} SbAppError;
#define SB_APP_ERROR (sb_app_error_quark())
GQuark sb_app_error_quark(void);

// Sets SB_APP_ERROR_INPUT with words of a file that nobody vouches for, made printable
// (sb_printable()).
void sb_app_error_input(GError **error, const char *format, ...) G_GNUC_PRINTF(2, 3);
