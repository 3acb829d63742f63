// Lists of problems, and text of strangers made fit to print.
#include "app/base/issue.h"

#include "app/base/error.h"

#include <stdarg.h>
#include <stdbool.h>
#include <string.h>

static void issue_free(gpointer data) {
  SbIssue *issue = data;
  g_free(issue->file);
  g_free(issue->key);
  g_free(issue->text);
  g_free(issue->allowed);
  sb_choice_clear(&issue->choice);
  g_free(issue);
}

GPtrArray *sb_issues_new(void) {
  return g_ptr_array_new_with_free_func(issue_free);
}

bool sb_issues_add(GPtrArray *issues, const char *file, int line, const char *key,
                   const char *allowed, const char *format, ...) {
  // The list is full: the last issue counts.
  if (issues->len > SB_ISSUES_MAX) {
    SbIssue *last = issues->pdata[issues->len - 1];
    last->line++;
    g_free(last->text);
    last->text = g_strdup_printf("and %d more", last->line);
    return false;
  }
  SbIssue *issue = g_new0(SbIssue, 1);
  if (issues->len == SB_ISSUES_MAX) {
    issue->line = 1;
    issue->text = g_strdup("and 1 more");
    g_ptr_array_add(issues, issue);
    return false;
  }
  issue->file = file != NULL ? sb_printable(file, strlen(file)) : NULL;
  issue->line = line;
  issue->key = key != NULL ? sb_printable(key, strlen(key)) : NULL;
  issue->allowed = allowed != NULL ? sb_printable(allowed, strlen(allowed)) : NULL;
  va_list arguments;
  va_start(arguments, format);
  char *text = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  issue->text = sb_printable(text, strlen(text));
  g_free(text);
  g_ptr_array_add(issues, issue);
  return false;
}

bool sb_issues_add_choice(GPtrArray *issues, const char *file, int line, const char *key,
                          const char *values, bool remedy, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *problem = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  int group = 0;
  const char *name = sb_issue_key(&(SbIssue){.key = (char *)key}, &group);
  SbChoice choice;
  sb_choice_init(&choice, name, values, 0);
  g_autofree char *all = g_strjoinv(", ", choice.value);
  g_autofree char *how = remedy && choice.value[0] != NULL
                             ? g_strdup_printf(": specify it, as in %s = %s", name, choice.value[0])
                             : g_strdup("");
  choice.remedy = strlen(how);
  const guint before = issues->len;
  sb_issues_add(issues, file, line, key, remedy ? NULL : all, "%s%s", problem, how);
  if (issues->len > before && issues->len <= SB_ISSUES_MAX) {
    ((SbIssue *)issues->pdata[before])->choice = choice;
  } else {
    sb_choice_clear(&choice);
  }
  return false;
}

void sb_issues_forget_key(GPtrArray *issues, const char *allowed) {
  SbIssue *issue = issues->pdata[issues->len - 1];
  if (issue->choice.key != NULL) {
    g_clear_pointer(&issue->key, g_free);
    g_free(issue->allowed);
    issue->allowed = g_strdup(allowed);
    sb_choice_clear(&issue->choice);
  }
}

void sb_note_add(GPtrArray *notes, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_ptr_array_add(notes, g_strdup_vprintf(format, arguments));
  va_end(arguments);
}

int sb_note_compare(gconstpointer a, gconstpointer b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
}

void sb_issues_add_copy(GPtrArray *issues, const SbIssue *issue) {
  const guint before = issues->len;
  sb_issues_add(issues, issue->file, issue->line, issue->key, issue->allowed, "%s", issue->text);
  if (issue->choice.key != NULL && issues->len > before && issues->len <= SB_ISSUES_MAX) {
    sb_choice_copy(&((SbIssue *)issues->pdata[before])->choice, &issue->choice);
  }
}

const char *sb_issue_key(const SbIssue *issue, int *group_length) {
  *group_length = 0;
  if (issue->key == NULL) {
    return NULL;
  }
  // Names in these groups have dots of their own.
  static const char *const groups[] = {"limits.", "cases.", "vary.", "tolerances.", "correlation."};
  bool named = false;
  for (size_t i = 0; i < G_N_ELEMENTS(groups); i++) {
    named |= g_str_has_prefix(issue->key, groups[i]);
  }
  const char *dot = named ? strchr(issue->key, '.') : strrchr(issue->key, '.');
  *group_length = dot != NULL ? (int)(dot - issue->key) : 0;
  return dot != NULL ? dot + 1 : issue->key;
}

bool sb_issue_error(GError **error, const SbIssue *issue) {
  if (issue->choice.key != NULL) {
    g_autofree char *values = g_strjoinv("\n", issue->choice.value);
    return sb_app_error_choose(error, issue->choice.key, values, "%s", issue->text);
  }
  return issue->line > 0 ? sb_app_error_input(error, "line %d: %s", issue->line, issue->text)
                         : sb_app_error_input(error, "%s", issue->text);
}

char *sb_issue_line(const SbIssue *issue) {
  GString *line = g_string_new(NULL);
  if (issue->file != NULL) {
    g_string_append_printf(line, "%s: ", issue->file);
  }
  if (issue->key != NULL) {
    int group = 0;
    const char *name = sb_issue_key(issue, &group);
    if (group > 0) {
      g_string_append_printf(line, "[%.*s] %s: ", group, issue->key, name);
    } else {
      g_string_append_printf(line, "%s: ", name);
    }
  } else if (issue->file != NULL && issue->line > 0) {
    g_string_append_printf(line, "line %d: ", issue->line);
  }
  g_string_append(line, issue->text);
  if (issue->allowed != NULL) {
    g_string_append_printf(line, " (allowed %s)", issue->allowed);
  }
  return g_string_free(line, FALSE);
}

char *sb_issue_problem(const SbIssue *issue) {
  SbIssue plain = *issue;
  plain.text = sb_choice_problem(&issue->choice, issue->text);
  plain.allowed = issue->choice.key == NULL ? issue->allowed : NULL;
  char *line = sb_issue_line(&plain);
  g_free(plain.text);
  return line;
}

char *sb_printable(const char *text, size_t length) {
  // A message with the longest path fits. Of a longer text, which a hostile file may hold, the
  // start and the end remain.
  enum { BYTES_MAX = 8192, START_BYTES = 6000 };
  GString *out = g_string_new(NULL);
  const char *end = text + length;
  for (const char *c = text; c < end;) {
    if (length > BYTES_MAX && c - text >= START_BYTES) {
      g_string_append(out, " … ");
      c = end - (BYTES_MAX - START_BYTES);
      while (c < end && ((guchar)*c & 0xc0) == 0x80) {
        c++;
      }
      length = 0;
    }
    gunichar code = g_utf8_get_char_validated(c, end - c);
    if (code == (gunichar)-1 || code == (gunichar)-2 || code == 0) {
      g_string_append_c(out, '?');
      c++;
      continue;
    }
    g_string_append_unichar(out, g_unichar_isprint(code) ? code : '?');
    c = g_utf8_next_char(c);
  }
  return g_string_free(out, FALSE);
}
