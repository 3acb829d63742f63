// One thing wrong with what the user gave: where it stands and what would be allowed.
#pragma once

#include <glib.h>

typedef struct {
  char *file;    // file (or "--set"), as the user named it; NULL if none
  int line;      // of the file, from 1; 0 where it does not apply
  char *key;     // catalogue key or "sealbench.kind"; NULL where it does not apply
  char *text;    // one sentence part, no full stop, printable
  char *allowed; // "1.2 to 2.2 mm"; NULL where it does not apply
} SbIssue;

// A list that frees its issues. Owned by the caller (g_ptr_array_unref).
GPtrArray *sb_issues_new(void);

// Adds one; every text is copied and made printable. Issues beyond SB_ISSUES_MAX are counted in a
// last one, so that a hostile file cannot flood anyone.
enum { SB_ISSUES_MAX = 100 };
void sb_issues_add(GPtrArray *issues, const char *file, int line, const char *key,
                   const char *allowed, const char *format, ...) G_GNUC_PRINTF(6, 7);

// Adds a copy of an issue.
void sb_issues_add_copy(GPtrArray *issues, const SbIssue *issue);

// Splits an issue's key: returns the name behind its group, borrowed, and the length of the group,
// which the key begins with; 0: the key has no group. NULL without a key.
const char *sb_issue_key(const SbIssue *issue, int *group_length);

// "piston.valve: [gland] radial_space: 9 m is out of range (allowed 0.1 to 20 mm)". Owned by the
// caller.
char *sb_issue_line(const SbIssue *issue);

// `text` with control characters and invalid UTF-8 replaced; of a text of more than 8 KiB the start
// and the end. Owned by the caller.
char *sb_printable(const char *text, size_t length);
