// The error domain of app.
#pragma once

#include "app/base/choice.h"

#include <stdbool.h>

// Codes of errors; each has its exit code.
typedef enum {
  SB_APP_ERROR_INPUT,         // the user's input is wrong
  SB_APP_ERROR_RANGE,         // a value is outside its range, or not finite
  SB_APP_ERROR_IO,            // a file cannot be read or written, or memory is short
  SB_APP_ERROR_CANCELLED,     // the user interrupted the work
  SB_APP_ERROR_NOT_CONVERGED, // a solver did not converge
  SB_APP_ERROR_CHANGED        // another program has changed the file
} SbAppError;
#define SB_APP_ERROR (sb_app_error_quark())

// Returns the quark of the domain.
GQuark sb_app_error_quark(void);

// Sets SB_APP_ERROR_INPUT with a formatted sentence that can contain text of an untrusted file; it
// is made printable (sb_printable()). Always returns false, the result of a reader that fails.
bool sb_app_error_input(GError **error, const char *format, ...) G_GNUC_PRINTF(2, 3);

// As sb_app_error_input(), for a refusal that the option `key` ("unit") resolves. The remedy
// follows the sentence: ": specify it with --unit=mm|inch", or ": omit --unit" if the only value is
// "". `values` has the plausible values, one a line; NULL: any value. `key` NULL: no option. The
// key "part=stem" is the choice "stem" of the option `part`.
bool sb_app_error_choose(GError **error, const char *key, const char *values, const char *format,
                         ...) G_GNUC_PRINTF(4, 5);

// Returns the choice that resolves an error; NULL: none. Borrowed from the error.
const SbChoice *sb_app_error_choice(const GError *error);

// Puts "NAME: " before the message of an error, unless `error` or *error is NULL. `name` is made
// printable.
void sb_app_error_prefix(GError **error, const char *name);
