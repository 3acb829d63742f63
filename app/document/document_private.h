// Inside of a document, shared by document.c (reading, values), document_edit.c (edits)
// and document_write.c (files).
#pragma once

#include "app/document/document_parts.h"

#include "app/base/hardness.h"
#include "app/base/writer.h"
#include "app/document/document.h"
#include "engine/valve/sealbench.h"

#include <sys/stat.h>

#define SB_META_GROUP   "sealbench"
#define SB_LIMITS_GROUP "limits"
#define SB_CASES_GROUP  "cases"
#define SB_PINS_GROUP   "pins"

// Keys that name a file and no value: a measured series, a shelf's temperatures, a seal's section,
// a groove's outline. The last ones, from SB_FILE_SECTION on, are drawings, which edits change.
typedef enum {
  SB_FILE_DRIVE,
  SB_FILE_SHELF,
  SB_FILE_SECTION,
  SB_FILE_GROOVE,
  SB_FILE_COUNT
} SbFileKey;

// "drive.file"...: the key of sb_document_text_keys().
const char *sb_document_file_key(int key);

// One of them in force; name NULL: none.
typedef struct {
  char *name, *path; // as it is written; to open
  bool in_valve;     // the scene's valve gives it, not the document itself
} SbNamedFile;

// A drawing, for the edits that change it: of a section with its height [m], or of a groove.
typedef struct {
  SbFileKey key;
  SbNamedFile file; // name NULL: none
  SbSealDrawing section;
  double height;
  SbGrooveDrawing groove;
} SbNamedDrawing;

// The one that names a rubber (rubber_sheet.h).
#define SB_RUBBER_KEY "rubber.name"

// A rubber as a document names it, shared by the edits that change it.
typedef struct {
  char *name, *path; // as it is written; to open
  SbRubberSheet sheet;
} SbNamedRubber;

// A file as it was when it was last read or written (document_disk.c). All zero: there was none.
typedef struct {
  char *sha256; // of its bytes
  bool seen;    // the rest is known
  dev_t device;
  ino_t inode;
  off_t size;
  struct timespec time; // of the last change
} SbFileStamp;

typedef struct {
  int id;        // of a parameter, or SB_DOCUMENT_RUBBER and on
  bool joined;   // one step with the edit before
  bool given[2]; // before, after
  double value[2];
  SbNamedRubber *rubber[2];   // held; NULL: none of its own
  SbData *measured[2];        // owned; NULL: none
  SbNamedDrawing *drawing[2]; // owned
  SbDocument *whole;          // owned: what takes the place of the document's content, and back
} Edit;

struct SbDocument {
  SbDocumentKind kind;
  char *path;                         // NULL before the first save
  char *name;                         // stands for it in messages then
  char *title;                        //
  char *valve_path;                   // scenes: path to open, else NULL
  char *valve_name;                   // scenes: as the file has it
  SbNamedFile file[SB_FILE_COUNT];    //
  double section_height;              // as its file draws it [m]
  bool valve_draws;                   // its valve names a groove, which a scene cannot do without
  char *saved_drawing[SB_FILE_COUNT]; // paths of its own ones in its file, or NULL
  GPtrArray *measured;                // of SbData, its own [data] groups
  SbData *saved_measured;             // the first of them in its file, or NULL
  SbNamedRubber *base_rubber, *own_rubber, *saved_rubber; // as the params; NULL: none
  SbModelData *data;                  // what files brought, and rubber, for its models; NULL: none
  char *text;                         // of the file as last read or written
  SbFileStamp disk, valve_disk;       // its file, and that of its valve
  GPtrArray *entries;                 // of that text
  SbParams base;                      // what the valve gives (scenes)
  SbParams own;                       // what the document gives
  SbParams saved;                     // what its file gives
  SbLimits limits;                    // on figures: the valve's, and its own in their place
  GPtrArray *cases;                   // in the same way (document_cases.c)
  GPtrArray *pins;                    // its own alone, see document_pins.c
  GHashTable *pins_broken;            // names of its lines that are no design; they stay
  bool pins_changed;                  // since the file was read or written
  GPtrArray *remark[SB_REMARK_KINDS]; // what a review adds (document_review.c)
  bool remarks_changed;               // in the same way
  SbShapes *shapes;                   // of the parts
  GPtrArray *notes;                   // of char *, what shapes say against given values
  GPtrArray *all_notes;               // these and those of sizes that stay: sb_document_notes()
  GPtrArray *faults;                  // of SbIssue: errors of the files, see document_faults.c
  GArray *edits;                      // Edit
  guint done;                         // edits before this one are in force
  bool mergeable;                     // the last edit may swallow the next one of its key
  unsigned serial;
};

// Notes that the bytes of `path` are `text`; call it right after they were read or written. Frees
// what a stamp holds.
void sb_file_stamp_set(SbFileStamp *stamp, const char *path, const char *text, size_t length);
void sb_file_stamp_finish(SbFileStamp *stamp);

// Swaps everything but the edits of two documents.
void sb_document_exchange(SbDocument *a, SbDocument *b);

// Records the issues from `first` on as faults of the document's files.
void sb_document_add_faults(SbDocument *document, const GPtrArray *issues, guint first);

// Whether every line of [cases] can be read; adds the errors. Unlike sb_document_check_cases(), for
// documents that do not compile.
bool sb_document_check_case_lines(const SbDocument *document, GPtrArray *issues);

// Whether the case of this name compiles with the values in force; false if there is none.
bool sb_document_case_is_good(const SbDocument *document, const char *name);

// Forgets faults that edits have corrected; to be called when they are saved.
void sb_document_faults_saved(SbDocument *document);

// The key's index, or -1.
int sb_document_find_file(const char *key);

// Reads the file of a key, `name` from `directory` (NULL: the current one), and puts it in force.
// False with an issue about line `line` of `shown`.
bool sb_document_read_file(SbDocument *document, SbFileKey key, const char *name,
                           const char *directory, bool in_valve, const char *shown, int line,
                           GPtrArray *issues);

// A copy of a drawing in force, to be freed; puts a copy of one in force; the path of the
// document's own one, NULL: none.
SbNamedDrawing *sb_document_drawing_now(const SbDocument *document, SbFileKey key);
void sb_document_put_drawing(SbDocument *document, const SbNamedDrawing *drawing);
void sb_named_drawing_free(SbNamedDrawing *drawing);
const char *sb_document_own_drawing(const SbDocument *document, SbFileKey key);

// Makes `drawing` (taken over) the document's; a section as one step with seal.profile = file.
void sb_document_edit_drawing(SbDocument *document, SbNamedDrawing *drawing);

// Keeps which drawings its file has.
void sb_document_drawings_saved(SbDocument *document);
bool sb_document_drawings_differ(const SbDocument *document);

// Notes a drawn section that is not as high as the seals, and a drawn groove of another width.
void sb_document_note_drawings(SbDocument *document);

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

// The same for a group of cases, whose values are looked at when they are compiled
// (document_cases.c).
enum { SB_CASES_MAX = 100 };
typedef struct {
  char *name, *settings;
  char *shown; // the file that has it
} SbCase;
GPtrArray *sb_document_cases_new(void);
void sb_document_read_cases(GPtrArray *cases, const char *group, const GPtrArray *entries,
                            const char *shown, GPtrArray *issues);
void sb_document_append_cases(GString *text, const GPtrArray *cases);

// The values of one, and its rubber where it names one (owned, NULL: the document's); issues name
// `path`. Then the model of them.
bool sb_document_case_params(const SbDocument *document, const SbCase *one, const char *path,
                             SbParams *params, SbNamedRubber **rubber, GPtrArray *issues);
bool sb_document_case_model(const SbDocument *document, SbParams params, SbNamedRubber *rubber,
                            const char *shown, const char *path, SbModel **out, GPtrArray *issues);

// The kept designs of a file that was read (document_pins.c); what saving changes of its group.
GPtrArray *sb_document_pins_new(void);
void sb_document_read_pins(SbDocument *document, const GPtrArray *entries, const char *shown,
                           GPtrArray *issues);
void sb_document_change_pins(GArray *changes, const SbDocument *document);

// The groups of bookmarks and notes (document_review.c).
bool sb_document_is_remark_group(const char *group);
void sb_document_remarks_init(SbDocument *document);
void sb_document_remarks_clear(SbDocument *document);
void sb_document_remarks_read(SbDocument *document, const char *shown, GPtrArray *issues);

// Adds the lines that differ from the file's (of SbChange).
void sb_document_change_remarks(GArray *changes, const SbDocument *document);

// Range of a problem in the parameter's unit, "at least 5.79 mm"; NULL: none. Owned by the caller.
char *sb_document_problem_range(const SbProblem *problem, const SbParam *param);

// A value with unit, or a change of the value in force ("+5 %").
bool sb_document_read_value(double *out, const SbDocument *document, SbParamId id, const char *text,
                            GError **error);

// Reads the rubber of a name or path beside the files of `directory`; `shown` and `line` are where
// that stands. NULL with an issue (document_rubber.c).
SbNamedRubber *sb_named_rubber_read(const char *name, const char *directory, const char *shown,
                                    int line, GPtrArray *issues);
SbNamedRubber *sb_named_rubber_hold(SbNamedRubber *rubber);
void sb_named_rubber_release(SbNamedRubber *rubber); // takes NULL
bool sb_named_rubber_same(const SbNamedRubber *a, const SbNamedRubber *b);

// Puts a rubber (taken over, NULL: none) into the document's base_rubber or own_rubber, and what is
// in force then into its data; data with another one in its place, for the caller to release.
void sb_document_put_rubber(SbDocument *document, SbNamedRubber **place, SbNamedRubber *rubber);
SbModelData *sb_document_data_with(const SbDocument *document, const SbNamedRubber *rubber);

// The rubber in force, NULL: none; borrowed.
SbNamedRubber *sb_document_rubber_in_force(const SbDocument *document);

// Of an Edit.
void sb_document_clear_edit(gpointer edit);

// Whether the first group of measured data is not the file's; from now on it is.
bool sb_document_data_differs(const SbDocument *document);
void sb_document_data_saved(SbDocument *document);

// An undoable edit of the document's own rubber, which it takes over.
void sb_document_edit_rubber(SbDocument *document, SbNamedRubber *rubber);

// What a document in `directory` must call its own rubber; NULL: it has none. Owned by the caller.
char *sb_document_rubber_name_at(const SbDocument *document, const char *directory);

// Adds to `notes`: size `id` stays at `value` [SI], as `file` gives it, while `giver`, with which a
// drawing would change it, goes from `before` to `now`.
void sb_document_note_size(GPtrArray *notes, const char *file, SbParamId id, double value,
                           SbParamId giver, double before, double now);

// Adds a note to the document that states the modulus and the relation if `text`, the value of
// `key`, is a hardness.
void sb_document_note_hardness(SbDocument *document, const char *key, const char *text);

// Adds to the notes that a value in force is not what a shape makes it; `shown` names who says so.
// Nothing where they agree.
void sb_document_note_override(SbDocument *document, SbParamId id, const char *shown);
