// Inside of a document, shared by document.c (reading, values), document_edit.c (edits)
// and document_write.c (files).
#pragma once

#include "app/document/document_parts.h"

#include "app/document/document.h"
#include "engine/valve/sealbench.h"

#define SB_META_GROUP   "sealbench"
#define SB_LIMITS_GROUP "limits"
#define SB_CASES_GROUP  "cases"

// The one key that names a file and no value.
#define SB_SERIES_KEY "drive.file"
// The one that names a rubber (rubber_sheet.h).
#define SB_RUBBER_KEY "rubber.name"

typedef struct {
  SbParamId id;
  bool given[2]; // before, after
  double value[2];
} Edit;

struct SbDocument {
  SbDocumentKind kind;
  char *path;         // NULL before the first save
  char *name;         // stands for it in messages then
  char *title;        //
  char *valve_path;   // scenes: path to open, else NULL
  char *valve_name;   // scenes: as the file has it
  char *series_name;  // value of drive.file, NULL without one
  char *series_path;  // path to open
  char *rubber_path;  // of the rubber that rubber.name names, the valve's or its own; NULL: none
  SbModelData *data;  // series, outlines and rubber, for its models; NULL: none
  char *text;         // of the file as last read or written
  GPtrArray *entries; // of that text
  SbParams base;      // what the valve gives (scenes)
  SbParams own;       // what the document gives
  SbParams saved;     // what its file gives
  SbLimits limits;    // on figures: the valve's, and its own in their place
  GPtrArray *cases;   // in the same way (document_cases.c)
  SbShapes *shapes;   // of the parts
  GPtrArray *notes;   // of char *, what shapes say against given values
  GArray *edits;      // Edit
  guint done;         // edits before this one are in force
  bool mergeable;     // the last edit may swallow the next one of its key
  unsigned serial;
};

// Sets the title anew from the text or the path.
void sb_document_refresh_title(SbDocument *document);

// ", do you mean KEY?" of the catalogue's key most like `key`, or an empty text. Owned by the
// caller.
char *sb_document_key_hint(const char *key);

// Adds the [limits] of a scanned file; later ones take the place of earlier ones
// (document_limits.c).
void sb_document_read_limits(SbLimits *limits, const GPtrArray *entries, const char *shown,
                             GPtrArray *issues);

// Appends them as a group; nothing where there are none.
void sb_document_append_limits(GString *text, const SbLimits *limits);

// The same for [cases], whose values are looked at when they are compiled (document_cases.c).
enum { SB_CASES_MAX = 100 };
GPtrArray *sb_document_cases_new(void);
void sb_document_read_cases(GPtrArray *cases, const GPtrArray *entries, const char *shown,
                            GPtrArray *issues);
void sb_document_append_cases(GString *text, const GPtrArray *cases);

// Range of a problem in the parameter's unit, "at least 5.79 mm"; NULL: none. Owned by the caller.
char *sb_document_problem_range(const SbProblem *problem, const SbParam *param);

// A value with unit, or a change of the value in force ("+5 %").
bool sb_document_read_value(double *out, const SbDocument *document, SbParamId id, const char *text,
                            GError **error);

// Takes the rubber of a name or path beside the files of `directory`; `shown` and `line` are where
// that stands. False with an issue.
bool sb_document_take_rubber(SbDocument *document, const char *name, const char *directory,
                             const char *shown, int line, GPtrArray *issues);

// Adds to the notes that a value in force is not what a shape makes it; `shown` names who says so.
// Nothing where they agree.
void sb_document_note_override(SbDocument *document, SbParamId id, const char *shown);
