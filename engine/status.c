// Texts of the status codes, and the one place that formats reports and warnings.
#include "engine/status.h"

#include <stdarg.h>
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

SB_PRINTF(4, 0)
static SbStatus fail_v(SbReport *report, SbStatus status, const char *parameter, const char *format,
                       va_list arguments) {
  if (report != NULL) {
    report->status = status;
    vsnprintf(report->text, sizeof report->text, format, arguments);
    snprintf(report->parameter, sizeof report->parameter, "%s", parameter);
  }
  return status;
}

SbStatus sb_fail(SbReport *report, SbStatus status, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  fail_v(report, status, "", format, arguments);
  va_end(arguments);
  return status;
}

SbStatus sb_fail_parameter(SbReport *report, SbStatus status, const char *parameter,
                           const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  fail_v(report, status, parameter, format, arguments);
  va_end(arguments);
  return status;
}

SbStatus sb_succeed(SbReport *report) {
  if (report != NULL) {
    memset(report, 0, sizeof *report);
  }
  return SB_OK;
}

void sb_warn(SbWarnings *list, const char *code, const char *parameter, const char *format, ...) {
  if (list == NULL) {
    return;
  }
  for (size_t i = 0; i < list->count; i++) {
    if (strcmp(list->item[i].code, code) == 0 && strcmp(list->item[i].parameter, parameter) == 0) {
      return;
    }
  }
  if (list->count == SB_WARNINGS_MAX) {
    list->dropped++;
    return;
  }
  SbWarning *warning = &list->item[list->count++];
  snprintf(warning->code, sizeof warning->code, "%s", code);
  snprintf(warning->parameter, sizeof warning->parameter, "%s", parameter);
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(warning->text, sizeof warning->text, format, arguments);
  va_end(arguments);
}

bool sb_warning_is_serious(const char *code) {
  static const char *const serious[] = {
      "no-return",   "life-no-return", "no-slip",          "static-hold", "no-contact",
      "static-leak", "ring-drag",      "ring-groove-full", "ring-shape",
  };
  for (size_t i = 0; i < sizeof serious / sizeof *serious; i++) {
    if (strcmp(code, serious[i]) == 0) {
      return true;
    }
  }
  return false;
}

void sb_warnings_merge(SbWarnings *list, const SbWarnings *from) {
  for (size_t i = 0; i < from->count; i++) {
    sb_warn(list, from->item[i].code, from->item[i].parameter, "%s", from->item[i].text);
  }
}
