// The kinds of drawn studies by name.
#include "engine/valve/model/study_kinds.h"

#include <string.h>

typedef struct {
  const char *name, *title, *help;
} Entry;

static const Entry entries[SB_STUDY_COUNT] = {
#define SB_STUDY_ENTRY(code, function, name, title, help) [code] = {name, title, help},
    SB_STUDY_LIST(SB_STUDY_ENTRY)
#undef SB_STUDY_ENTRY
};

static const Entry *find(SbStudyKind kind) {
  static const Entry none;
  return (unsigned)kind < SB_STUDY_COUNT ? &entries[kind] : &none;
}

const char *sb_study_name(SbStudyKind kind) {
  return find(kind)->name;
}

const char *sb_study_title(SbStudyKind kind) {
  return find(kind)->title;
}

const char *sb_study_help(SbStudyKind kind) {
  return find(kind)->help;
}

bool sb_study_from_name(SbStudyKind *out, const char *name) {
  for (int i = 0; i < SB_STUDY_COUNT; i++) {
    if (strcmp(entries[i].name, name) == 0) {
      *out = (SbStudyKind)i;
      return true;
    }
  }
  return false;
}
