// Status codes, error reports and validity warnings of the engine.
//
// The engine never prints or exits. A function that can fail returns SbStatus and describes the
// error in the caller's SbReport (NULL: not wanted). A result that is usable but outside the
// validity of its model comes with SbWarnings.
#pragma once

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#if defined(__GNUC__)
#define SB_PRINTF(format_index, first) __attribute__((format(printf, format_index, first)))
#else
#define SB_PRINTF(format_index, first)
#endif

// The compiler warns about an unused result: SB_CHECKED before the declaration of one function;
// SB_EXTENSION and SB_CHECKED_TYPE in the definition of a type, for all functions that return it.
// Cast to (void) to ignore a result intentionally. gcc accepts the attribute of a type only in the
// form of C2x.
#if defined(__clang__)
#define SB_EXTENSION
#define SB_CHECKED      __attribute__((warn_unused_result))
#define SB_CHECKED_TYPE __attribute__((warn_unused_result))
#elif defined(__GNUC__)
#define SB_EXTENSION    __extension__
#define SB_CHECKED      __attribute__((warn_unused_result))
#define SB_CHECKED_TYPE [[nodiscard]]
#else
#define SB_EXTENSION
#define SB_CHECKED
#define SB_CHECKED_TYPE
#endif

// X(code, text): all status codes, with the text of sb_status_text().
#define SB_STATUS_LIST(X)                                                                          \
  X(SB_OK, "done")                                                                                 \
  X(SB_ERROR_INPUT, "bad input")                                                                   \
  X(SB_ERROR_RANGE, "value out of range")                                                          \
  X(SB_ERROR_INFEASIBLE, "no solution exists for this input")                                      \
  X(SB_ERROR_NOT_CONVERGED, "the solver did not converge")                                         \
  X(SB_ERROR_CANCELLED, "cancelled")                                                               \
  X(SB_ERROR_MEMORY, "out of memory")                                                              \
  X(SB_ERROR_IO, "input or output failed")

SB_EXTENSION typedef enum SB_CHECKED_TYPE {
#define SB_STATUS_ENUM(code, text) code,
  SB_STATUS_LIST(SB_STATUS_ENUM)
#undef SB_STATUS_ENUM
} SbStatus;

// Size in bytes of every message (reports, warnings, reasons, verdicts), with the terminating NUL.
// Builds with SB_ASSERT_RUNS abort if a message does not fit.
enum { SB_TEXT = 512 };

// Cause of an error that some callers take as a result, or answer in another way.
typedef enum {
  SB_CAUSE_OTHER,        // any other cause
  SB_CAUSE_FLUID_OPENS,  // the pressure of the fluid opens the contact: there is no film
  SB_CAUSE_FLUID_PASSES, // the fluid passes a clamped gasket
  SB_CAUSE_CREASES       // a path of states ended at a surface that creases
} SbCause;

// First numbers of inputs. Each room below the valve numbers the inputs of its problems from its
// own first number (enumerators SB_CONTACT_IN_X, SB_FILM_IN_X, ...) and knows no key of the
// catalogue. engine/valve/model/params.h numbers the catalogue's inputs; inputs.c maps the rooms'
// inputs to them.
enum {
  SB_CONTACT_INPUTS = 1000,
  SB_FILM_INPUTS = 2000,
  SB_RUBBER_INPUTS = 3000,
  SB_FLUID_INPUTS = 4000,
  SB_MECHANISM_INPUTS = 5000,
  SB_VALVE_INPUTS = 10000
};

// Description of an error, in memory of the caller. The fields are defined after an error only, and
// need no initialisation.
typedef struct {
  SbStatus status;
  SbCause cause;
  char text[SB_TEXT]; // one sentence for the user, without a line break
  int input;       // number of the input at fault, 0 if none; its key: sb_input_key() of params.h
  double residual; // last residual of the iteration; NaN if the error is not from an iteration
  int iteration;   // number of iterations done; 0 if the residual is NaN
} SbReport;

// Returns the fixed text of a status code; static, never NULL.
const char *sb_status_text(SbStatus status);

// Writes `status` and a formatted sentence to `report` (NULL: nothing is written), without an input
// and with SB_CAUSE_OTHER, and returns `status`. Use: `return sb_fail(report, SB_ERROR_RANGE,
// "speed %g m/s ...", u);`. Sets `residual` to NaN and `iteration` to 0.
SbStatus sb_fail(SbReport *report, SbStatus status, const char *format, ...) SB_PRINTF(3, 4);

// Does the same as sb_fail() and also stores the number of the input at fault (0: none).
SbStatus sb_fail_input(SbReport *report, SbStatus status, int input, const char *format, ...)
    SB_PRINTF(4, 5);

// Stores `cause` in `report` (NULL: nothing is written) and returns `status`, which is the result
// of the call that wrote the report: `return sb_fail_because(report, sb_fail(report, ...),
// cause);`. Every other function that writes a report sets SB_CAUSE_OTHER.
SbStatus sb_fail_because(SbReport *report, SbStatus status, SbCause cause);

// Formats a message into out[size] (size > 4). A message that does not fit is truncated as by
// sb_text(); builds with SB_ASSERT_RUNS abort then. All messages of the engine are formatted by
// this function.
void sb_message(char *out, size_t size, const char *format, ...) SB_PRINTF(3, 4);
// Does the same as sb_message() with an argument list.
void sb_message_v(char *out, size_t size, const char *format, va_list arguments) SB_PRINTF(3, 0);

// Formats a text into out[size] (size > 4), with a terminating NUL. A text that does not fit is
// truncated between two UTF-8 characters and ends in "…".
void sb_text(char *out, size_t size, const char *format, ...) SB_PRINTF(3, 4);
// Does the same as sb_text() with an argument list.
void sb_text_v(char *out, size_t size, const char *format, va_list arguments) SB_PRINTF(3, 0);

// Sets all fields of `report` (NULL: none) to zero and returns SB_OK.
SbStatus sb_succeed(SbReport *report);

// Capacity of a list of warnings.
enum { SB_WARNINGS_MAX = 48 };

// One validity warning.
typedef struct {
  char code[48];      // stable identifier of the kind of warning, "film-below-continuum"
  char text[SB_TEXT]; // one sentence, which names the subject
  bool serious;       // reports a defect of the valve, or a model or picture that omits something
                      // relevant: always printed in words; other warnings, which reduce the
                      // confidence in a result, may be shown as a count only
  int input;        // number of the input to change, 0 if none; its key: sb_input_key() of params.h
  char subject[16]; // part that the warning is about, "inner seal"; "" if there is only one
} SbWarning;

// A list of warnings without duplicates (equal code, input and subject). Numbers of inputs are
// compared as they are: a warning that several rooms give has the same number in all of them. It
// owns its texts.
// Initialise with {0}; nothing has to be freed.
typedef struct {
  const char *subject; // subject of warnings that are added next, borrowed; NULL: none
  size_t count;        // elements of `item` in use
  size_t dropped;      // number of warnings that did not fit
  SbWarning item[SB_WARNINGS_MAX];
} SbWarnings;

// Adds a warning about the current subject of `list`, with a formatted sentence. `code` is
// truncated to 47 bytes; `input` 0: no input. "SUBJECT: " is put before the sentence unless the
// sentence contains the subject. Does nothing if the list has a warning with equal code, input and
// subject; counts it in `dropped` if the list is full. All strings are copied. `list` may be NULL.
void sb_warn(SbWarnings *list, const char *code, int input, const char *format, ...)
    SB_PRINTF(4, 5);

// Does the same as sb_warn() with a warning that is `serious`.
void sb_warn_serious(SbWarnings *list, const char *code, int input, const char *format, ...)
    SB_PRINTF(4, 5);

// Formats a new text into each warning of `list` that has this code and this subject ("": no
// subject). The text must name the subject itself. Does nothing if there is no such warning. `list`
// must not be NULL.
void sb_warn_replace(SbWarnings *list, const char *code, const char *subject, const char *format,
                     ...) SB_PRINTF(4, 5);

// Sets the subject of the warnings that are added from now on; `subject` is borrowed until the next
// call of this function with `list`. NULL: no subject. `list` may be NULL.
void sb_warn_about(SbWarnings *list, const char *subject);

// Adds copies of all warnings of `from` to `list` (NULL: does nothing), and adds from->dropped to
// list->dropped. A warning without a subject gets the current subject of `list`.
void sb_warnings_merge(SbWarnings *list, const SbWarnings *from);
