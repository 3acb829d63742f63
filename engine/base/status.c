// Texts of the status codes, and the one place that formats reports and warnings.
#include "engine/base/status.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const char *sb_status_text(SbStatus status) {
  static const char *const texts[] = {
#define SB_STATUS_TEXT(code, text) [code] = text,
      SB_STATUS_LIST(SB_STATUS_TEXT)
#undef SB_STATUS_TEXT
  };
  size_t index = (size_t)status;
  return index < sizeof texts / sizeof texts[0] ? texts[index] : "unknown status";
}

// Returns whether all of the text fits.
SB_PRINTF(3, 0)
static bool fit_text(char *out, size_t size, const char *format, va_list arguments) {
  static const char MARK[] = "…";
  assert(size > sizeof MARK);
  int length = vsnprintf(out, size, format, arguments);
  if (length >= 0 && (size_t)length < size) {
    return true;
  }
  // Not within a character of several bytes, whose later ones are 10xxxxxx.
  size_t at = size - sizeof MARK;
  while (at > 0 && ((unsigned char)out[at] & 0xc0) == 0x80) {
    at--;
  }
  memcpy(out + at, MARK, sizeof MARK);
  return false;
}

void sb_text_v(char *out, size_t size, const char *format, va_list arguments) {
  (void)fit_text(out, size, format, arguments);
}

void sb_message_v(char *out, size_t size, const char *format, va_list arguments) {
  const bool fits = fit_text(out, size, format, arguments);
#ifdef SB_ASSERT_RUNS
  assert(fits);
#else
  (void)fits;
#endif
}

void sb_message(char *out, size_t size, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  sb_message_v(out, size, format, arguments);
  va_end(arguments);
}

void sb_text(char *out, size_t size, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  sb_text_v(out, size, format, arguments);
  va_end(arguments);
}

SB_PRINTF(4, 0)
static void fail_v(SbReport *report, SbStatus status, int input, const char *format,
                   va_list arguments) {
  if (report != NULL) {
    report->status = status;
    report->cause = SB_CAUSE_OTHER;
    report->residual = NAN;
    report->iteration = 0;
    sb_message_v(report->text, sizeof report->text, format, arguments);
    report->input = input;
  }
}

SbStatus sb_fail(SbReport *report, SbStatus status, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  fail_v(report, status, 0, format, arguments);
  va_end(arguments);
  return status;
}

SbStatus sb_fail_input(SbReport *report, SbStatus status, int input, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  fail_v(report, status, input, format, arguments);
  va_end(arguments);
  return status;
}

SbStatus sb_fail_because(SbReport *report, SbStatus status, SbCause cause) {
  if (report != NULL) {
    report->cause = cause;
  }
  return status;
}

SbStatus sb_succeed(SbReport *report) {
  if (report != NULL) {
    memset(report, 0, sizeof *report);
  }
  return SB_OK;
}

void sb_warn_about(SbWarnings *list, const char *subject) {
  if (list != NULL) {
    list->subject = subject;
  }
}

static void add(SbWarnings *list, const char *code, bool serious, int input, const char *subject,
                const char *text) {
  for (size_t i = 0; i < list->count; i++) {
    const SbWarning *there = &list->item[i];
    if (strcmp(there->code, code) == 0 && there->input == input &&
        strcmp(there->subject, subject) == 0) {
      return;
    }
  }
  if (list->count == SB_WARNINGS_MAX) {
    list->dropped++;
    return;
  }
  SbWarning *warning = &list->item[list->count++];
  const bool named = strstr(text, subject) != NULL;
  sb_text(warning->code, sizeof warning->code, "%s", code);
  warning->serious = serious;
  warning->input = input;
  sb_text(warning->subject, sizeof warning->subject, "%s", subject);
  sb_message(warning->text, sizeof warning->text, "%s%s%s", named ? "" : subject, named ? "" : ": ",
             text);
}

SB_PRINTF(5, 0)
static void warn_v(SbWarnings *list, const char *code, bool serious, int input, const char *format,
                   va_list arguments) {
  if (list != NULL) {
    char text[SB_TEXT];
    sb_message_v(text, sizeof text, format, arguments);
    add(list, code, serious, input, list->subject != NULL ? list->subject : "", text);
  }
}

void sb_warn(SbWarnings *list, const char *code, int input, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  warn_v(list, code, false, input, format, arguments);
  va_end(arguments);
}

void sb_warn_serious(SbWarnings *list, const char *code, int input, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  warn_v(list, code, true, input, format, arguments);
  va_end(arguments);
}

void sb_warn_replace(SbWarnings *list, const char *code, const char *subject, const char *format,
                     ...) {
  for (size_t i = 0; i < list->count; i++) {
    SbWarning *at = &list->item[i];
    if (strcmp(at->code, code) == 0 && strcmp(at->subject, subject) == 0) {
      va_list arguments;
      va_start(arguments, format);
      sb_message_v(at->text, sizeof at->text, format, arguments);
      va_end(arguments);
    }
  }
}

void sb_warnings_merge(SbWarnings *list, const SbWarnings *from) {
  for (size_t i = 0; list != NULL && i < from->count; i++) {
    const SbWarning *w = &from->item[i];
    bool own = w->subject[0] != '\0' || list->subject == NULL;
    add(list, w->code, w->serious, w->input, own ? w->subject : list->subject, w->text);
  }
  if (list != NULL) {
    list->dropped += from->dropped;
  }
}
