// The one error domain of app.
#pragma once

#include <glib.h>

// How messages and exit codes are sorted. INPUT is the user's, IO the system's.
typedef enum {
  SB_APP_ERROR_INPUT,
  SB_APP_ERROR_IO,
  SB_APP_ERROR_CANCELLED,
  SB_APP_ERROR_NOT_CONVERGED
} SbAppError;
#define SB_APP_ERROR (sb_app_error_quark())
GQuark sb_app_error_quark(void);
