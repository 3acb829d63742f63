// Status codes, reports and warnings: how every part of the engine says what went wrong.
//
// The engine never prints, exits or aborts on input. A function that can fail returns SbStatus and
// fills the caller's SbReport (which may be NULL); a result that is usable but outside its model's
// validity carries SbWarnings.
#pragma once

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#if defined(__GNUC__)
#define SB_PRINTF(format_index, first) __attribute__((format(printf, format_index, first)))
#else
#define SB_PRINTF(format_index, first)
#endif

// The compiler warns where a result is dropped: of one function (SB_CHECKED before its
// declaration), or of every function that returns a type (SB_CHECKED_TYPE in its definition, after
// SB_EXTENSION: gcc knows that attribute of a type only in C2x's form). Where a result is dropped
// on purpose a (void) cast says so.
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

// code, one-line text
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

// Bytes of every message: reports, warnings, reasons, verdicts. A message that combines others has
// this size too; its parts are short enough (asserted in builds with SB_ASSERT_RUNS).
enum { SB_TEXT = 512 };

// Details of a failure, owned by the caller. All fields are zero after a success.
typedef struct {
  SbStatus status;
  char text[SB_TEXT]; // one sentence for a person, no trailing newline
  char parameter[64]; // catalogue key at fault, or empty
  double residual;    // last residual of an iteration, 0 if none
  int iteration;      // iterations done, 0 if none
} SbReport;

// Fixed text of a status code; borrowed, never NULL.
const char *sb_status_text(SbStatus status);

// Fills the report (if any) with a formatted sentence and returns `status`, so that a failing
// function can end in `return sb_fail(report, SB_ERROR_RANGE, "speed %g m/s ...", u);`.
SbStatus sb_fail(SbReport *report, SbStatus status, const char *format, ...) SB_PRINTF(3, 4);

// The same with the catalogue key of the parameter at fault.
SbStatus sb_fail_parameter(SbReport *report, SbStatus status, const char *parameter,
                           const char *format, ...) SB_PRINTF(4, 5);

// Formats a message into `out` of `size` bytes. Every message of the engine is formatted here;
// builds with SB_ASSERT_RUNS abort where one does not fit.
void sb_message(char *out, size_t size, const char *format, ...) SB_PRINTF(3, 4);
void sb_message_v(char *out, size_t size, const char *format, va_list arguments) SB_PRINTF(3, 0);

// Formats a text into `size` bytes; what does not fit ends in "…", between two characters.
void sb_text(char *out, size_t size, const char *format, ...) SB_PRINTF(3, 4);
void sb_text_v(char *out, size_t size, const char *format, va_list arguments) SB_PRINTF(3, 0);

// Clears the report (if any) and returns SB_OK.
SbStatus sb_succeed(SbReport *report);

enum { SB_WARNINGS_MAX = 48 };

// One validity warning: a stable code ("film-below-continuum"), a sentence, the catalogue key of
// the parameter that a user would change (may be empty), and what it is about ("inner seal"; may be
// empty), which the sentence names.
typedef struct {
  char code[48];
  char text[SB_TEXT];
  char parameter[64];
  char subject[16];
} SbWarning;

// A bounded list without duplicates (same code, parameter and subject). `dropped` counts what did
// not fit. While `subject` is set (borrowed), what is added without one is about it.
typedef struct {
  const char *subject;
  size_t count;
  size_t dropped;
  SbWarning item[SB_WARNINGS_MAX];
} SbWarnings;

// Adds a warning unless one with the same code, parameter and subject is there; `list` may be NULL.
void sb_warn(SbWarnings *list, const char *code, const char *parameter, const char *format, ...)
    SB_PRINTF(4, 5);

// Replaces the text of the warning with this code and subject; nothing where there is none.
void sb_warn_replace(SbWarnings *list, const char *code, const char *subject, const char *format,
                     ...) SB_PRINTF(4, 5);

// What the warnings added from now on are about (NULL: nothing of which there are several); `list`
// may be NULL.
void sb_warn_about(SbWarnings *list, const char *subject);

// Whether a warning of this code tells a defect of the valve itself, or a picture or model that
// leaves out what it should show, rather than how far a figure can be trusted: such a finding is
// shown in words wherever results are, never as one of a number of warnings.
bool sb_warning_is_serious(const char *code);

// Adds all of `from` to `list`.
void sb_warnings_merge(SbWarnings *list, const SbWarnings *from);
