// One problem of an input: its place, and what would be allowed.
#pragma once

#include "app/base/choice.h"

#include <stdbool.h>

// A problem. Strings are owned by the issue.
typedef struct {
  char *file;    // file (or "--set"), as the user named it; NULL: none
  int line;      // of the file, from 1; 0: unknown
  char *key;     // catalogue key or "sealbench.kind"; NULL: none
  char *text;    // the problem, a part of a sentence without full stop, printable
  char *allowed; // allowed range, "1.2 to 2.2 mm"; NULL: none
  // Which value of `key` resolves the problem. Its key is the name of `key` without the group;
  // NULL: none.
  SbChoice choice;
} SbIssue;

// Returns an empty list of SbIssue that frees its elements.
GPtrArray *sb_issues_new(void);

// Largest number of issues in a list. Further ones are only counted: the list then has one more
// element, SB_ISSUES_MAX, whose text is "and 12 more".
enum { SB_ISSUES_MAX = 100 };

// Appends an issue with a formatted text. `file`, `key` and `allowed` may be NULL and `line` 0, as
// in SbIssue. All texts are copied and made printable (sb_printable()). Always returns false, the
// result of a reader that fails.
bool sb_issues_add(GPtrArray *issues, const char *file, int line, const char *key,
                   const char *allowed, const char *format, ...) G_GNUC_PRINTF(6, 7);

// As sb_issues_add(), for a problem that one of the values of `key` resolves: `values`, one a line
// (NULL with `key` NULL: no choice). With `remedy`, the text ends with ": specify it, as in KEY =
// VALUE" with the first value; without, the values are the allowed range.
bool sb_issues_add_choice(GPtrArray *issues, const char *file, int line, const char *key,
                          const char *values, bool remedy, const char *format, ...)
    G_GNUC_PRINTF(7, 8);

// If the last issue has a choice, removes its key and its choice and sets its allowed range to
// `allowed`: for a file without keys, which must itself have what `allowed` states. The list must
// not be empty.
void sb_issues_forget_key(GPtrArray *issues, const char *allowed);

// Appends a formatted sentence to a list of char *.
void sb_note_add(GPtrArray *notes, const char *format, ...) G_GNUC_PRINTF(2, 3);

// Compares the texts of two elements of a list of char * for g_ptr_array_sort().
int sb_note_compare(gconstpointer a, gconstpointer b);

// Appends a copy of an issue.
void sb_issues_add_copy(GPtrArray *issues, const SbIssue *issue);

// Returns the name in an issue's key, the part after its group ("radial_space"); NULL:
// the issue has no key. *group_length is the length of the group at the start of the key; 0: no
// group.
const char *sb_issue_key(const SbIssue *issue, int *group_length);

// Sets an error with the issue's line and text, as sb_app_error_input(), or with its choice, as
// sb_app_error_choose(). Always returns false. `error` may be NULL.
bool sb_issue_error(GError **error, const SbIssue *issue);

// Returns the issue as a line, "piston.valve: [gland] radial_space: 9 m is out of range (allowed
// 0.1 to 20 mm)".
char *sb_issue_line(const SbIssue *issue);

// Returns sb_issue_line() without the remedy and the values that issue->choice has.
char *sb_issue_problem(const SbIssue *issue);

// Returns the `length` bytes of a text, terminated by 0, with control characters and invalid UTF-8
// replaced by "?"; of a text of more than 8 KiB only its start and end.
char *sb_printable(const char *text, size_t length);
