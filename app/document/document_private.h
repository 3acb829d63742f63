// Shared by the files of documents: document.c (reading, values), document_edit.c (edits),
// document_write.c (files) and those for single groups and keys. None of these functions is called
// from outside of app/document.
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

// Splits "KEY=VALUE". Returns the key, and sets *value to the text after the equals sign, in
// `setting`; NULL: there is no equals sign or no key. Freed by g_free().
char *sb_document_split(const char **value, const char *setting);

// Returns the key of an SbFileKey ("drive.file"). Static.
const char *sb_document_file_key(int key);

// A file in force.
typedef struct {
  char *name;    // as the document has it; NULL: none
  char *path;    // to open
  bool in_valve; // the scene's valve names it, not the document itself
} SbNamedFile;

// A drawing for the edits that change it. Freed by sb_named_drawing_free().
typedef struct {
  SbFileKey key;          // SB_FILE_SECTION or SB_FILE_GROOVE
  SbNamedFile file;       // name NULL: no drawing
  SbSealDrawing section;  // for SB_FILE_SECTION
  double height;          // of the section as its file draws it [m]
  SbGrooveDrawing groove; // for SB_FILE_GROOVE
} SbNamedDrawing;

// The key that names a rubber (rubber_sheet.h).
#define SB_RUBBER_KEY "rubber.name"

// A rubber as a document names it. Reference counted: the edits that change it share it.
typedef struct {
  char *name; // as the document has it
  char *path; // of its file
  SbRubberSheet sheet;
} SbNamedRubber;

// State of a file when it was last read or written (document_disk.c). All zero: there was none.
typedef struct {
  char *sha256; // of its bytes, hexadecimal
  bool seen;    // the members below are known
  dev_t device;
  ino_t inode;
  off_t size;
  struct timespec time; // of the last change
} SbFileStamp;

// One edit: what it changes, [0] before and [1] after it.
typedef struct {
  int id;                     // SbParamId, or SB_DOCUMENT_RUBBER and on
  bool joined;                // belongs to the same step as the edit before it
  bool given[2];              // the document itself gives the value
  double value[2];            // [SI]
  SbNamedRubber *rubber[2];   // a reference each; NULL: no own rubber
  SbData *measured[2];        // owned; NULL: none
  SbNamedDrawing *drawing[2]; // owned
  SbDocument *whole;          // SB_DOCUMENT_WHOLE: the other content, exchanged by undo and redo
} Edit;

struct SbDocument {
  SbDocumentKind kind;
  char *path;                         // NULL before the first save
  char *name;                         // for messages if there is no path
  char *title;                        // see sb_document_title()
  char *valve_path;                   // scenes: path to open, else NULL
  char *valve_name;                   // scenes: as the file has it
  SbNamedFile file[SB_FILE_COUNT];    // in force, of the valve or the document
  double section_height;              // of the drawn section as its file has it [m]
  bool valve_draws;                   // the valve names a groove, which its scene cannot remove
  char *saved_drawing[SB_FILE_COUNT]; // paths of the own drawings in the file; NULL: none
  GPtrArray *measured;                // of SbData, the own groups [data]; NULL: none
  SbData *saved_measured;             // the first of them in the file; NULL: none
  // Rubber of the valve, own rubber, own rubber in the file; a reference each, NULL: none.
  SbNamedRubber *base_rubber, *own_rubber, *saved_rubber;
  SbModelData *data;                  // content of the files and of the rubber; NULL: none
  char *text;                         // of the file as last read or written
  SbFileStamp disk, valve_disk;       // of the file, and of the valve's file
  GPtrArray *entries;                 // of SbEntry, of `text`
  SbParams base;                      // values that the valve gives (scenes)
  SbParams own;                       // values that the document itself gives
  SbParams saved;                     // values that its file gives
  bool stated[SB_PARAM_COUNT];        // --set has set the value
  SbLimits limits;                    // of the valve, replaced by the own ones
  GPtrArray *cases;                   // of SbCase, of the valve, replaced by the own ones
  GPtrArray *pins;                    // only the own ones (document_pins.c)
  GHashTable *pins_broken;            // names of lines of [pins] that cannot be read; they stay
  bool pins_changed;                  // since the file was read or written
  GPtrArray *remark[SB_REMARK_KINDS]; // bookmarks and notes (document_review.c)
  bool remarks_changed;               // since the file was read or written
  SbShapes *shapes;                   // of the parts
  GPtrArray *notes;                   // of SbIssue: differences between shapes and values, ...
  GPtrArray *all_notes;               // result of the last sb_document_notes()
  GPtrArray *faults;                  // of SbIssue: errors of the files (document_faults.c)
  GArray *edits;                      // of Edit
  guint done;                         // number of edits in force; later ones can be repeated
  bool mergeable;                     // the next edit of the same key may join the last one
  unsigned serial;                    // see sb_document_serial()
};

// Records the present state of the file `path`, whose bytes are `text`. Call it immediately after
// the file was read or written.
void sb_file_stamp_set(SbFileStamp *stamp, const char *path, const char *text, size_t length);

// Frees what a stamp owns; it is then all zero.
void sb_file_stamp_finish(SbFileStamp *stamp);

// Exchanges the content of two documents, except their edits.
void sb_document_exchange(SbDocument *a, SbDocument *b);

// ---- Faults ----

// Copies the issues from index `first` on to the faults of the document.
void sb_document_add_faults(SbDocument *document, const GPtrArray *issues, guint first);

// Removes the faults that edits have corrected. Call it when they are saved.
void sb_document_faults_saved(SbDocument *document);

// Returns whether every line of [cases] can be read; appends the issues of others. Also for
// documents that do not compile, unlike sb_document_check_cases().
bool sb_document_check_case_lines(const SbDocument *document, GPtrArray *issues);

// Returns whether the case `name` compiles with the values in force; false if there is none.
bool sb_document_case_is_good(const SbDocument *document, const char *name);

// ---- Files and drawings ----

// Returns the SbFileKey of a key ("drive.file"); -1: none.
int sb_document_find_file(const char *key);

// Reads the file that a key names, `name` relative to `directory` (NULL: the current folder), and
// puts its content in force. `in_valve`: the scene's valve names it. Returns false with an issue on
// line `line` of the file `shown`.
bool sb_document_read_file(SbDocument *document, SbFileKey key, const char *name,
                           const char *directory, bool in_valve, const char *shown, int line,
                           GPtrArray *issues);

// Returns a copy of the drawing in force. Freed by sb_named_drawing_free().
SbNamedDrawing *sb_document_drawing_now(const SbDocument *document, SbFileKey key);

// Puts a copy of `drawing` in force, without an edit.
void sb_document_put_drawing(SbDocument *document, const SbNamedDrawing *drawing);

// Frees a drawing.
void sb_named_drawing_free(SbNamedDrawing *drawing);

// Returns the path of the document's own drawing; NULL: none.
const char *sb_document_own_drawing(const SbDocument *document, SbFileKey key);

// Makes `drawing`, which the document owns from now on, its own by an edit; a section in one step
// with seal.profile = file.
void sb_document_edit_drawing(SbDocument *document, SbNamedDrawing *drawing);

// Records that the file has the document's present drawings.
void sb_document_drawings_saved(SbDocument *document);

// Returns whether the document's own drawings differ from those in its file.
bool sb_document_drawings_differ(const SbDocument *document);

// Appends notes on a drawn section whose height differs from the seals', and on a drawn groove
// whose width differs from gland.axial_width.
void sb_document_note_drawings(SbDocument *document);

// Sets the title from `text` or `path`.
void sb_document_refresh_title(SbDocument *document);

// Returns ", do you mean KEY?" with the key of the catalogue that is most similar to `key`; empty:
// none is similar.
char *sb_document_key_hint(const char *key);

// ---- Limits and cases ----

// Reads the [limits] among `entries` (of SbEntry) of the file `shown` into `limits`; they replace
// earlier ones on the same figure. Appends issues (document_limits.c).
void sb_document_read_limits(SbLimits *limits, const GPtrArray *entries, const char *shown,
                             GPtrArray *issues);

// Appends `limits` to `text` as a group; nothing if there are none.
void sb_document_append_limits(GString *text, const SbLimits *limits);

// Largest number of cases, and of pins.
enum { SB_CASES_MAX = 100 };

// A line of [cases] or [pins], not yet interpreted (document_cases.c).
typedef struct {
  char *name, *settings; // NAME = KEY=VALUE; KEY=VALUE
  char *shown;           // the file that contains it
} SbCase;

// Returns an empty list of SbCase that owns its elements.
GPtrArray *sb_document_cases_new(void);

// Reads the lines of `group` among `entries` (of SbEntry) into `cases`; they replace earlier ones
// of the same name. Appends issues.
void sb_document_read_cases(GPtrArray *cases, const char *group, const GPtrArray *entries,
                            const char *shown, GPtrArray *issues);

// Appends the cases to `text` as group [cases]; nothing if there are none.
void sb_document_append_cases(GString *text, const GPtrArray *cases);

// Writes the values in force with those of a case in their place to *params, and a reference to the
// rubber that it names to *rubber (NULL: none; released by sb_named_rubber_release()). Returns
// false with issues on the key `path`.
bool sb_document_case_params(const SbDocument *document, const SbCase *one, const char *path,
                             SbParams *params, SbNamedRubber **rubber, GPtrArray *issues);

// Compiles such values to a model, freed by sb_model_destroy(). `rubber` (NULL: the document's)
// stays the caller's. Returns false with issues on the key `path` of the file `shown`.
bool sb_document_case_model(const SbDocument *document, SbParams params, SbNamedRubber *rubber,
                            const char *shown, const char *path, SbModel **out, GPtrArray *issues);

// ---- Pins ----

// Returns an empty list of pins that owns its elements.
GPtrArray *sb_document_pins_new(void);

// Reads the [pins] among `entries` (of SbEntry) of the file `shown`. Appends issues.
void sb_document_read_pins(SbDocument *document, const GPtrArray *entries, const char *shown,
                           GPtrArray *issues);

// Keeps the lines of [pins] among `entries` (of SbEntry) as they are, without reading them: for a
// file with errors, whose values are not known.
void sb_document_keep_pins(SbDocument *document, const GPtrArray *entries);

// Appends the changes (of SbChange) of group [pins] with which saving makes the file state the
// pins. The caller frees the three strings of each by g_free().
void sb_document_change_pins(GArray *changes, const SbDocument *document);

// ---- Bookmarks and notes ----

// Returns whether a group is [bookmarks] or [notes].
bool sb_document_is_remark_group(const char *group);

// Creates the empty lists of a new document.
void sb_document_remarks_init(SbDocument *document);

// Frees the lists.
void sb_document_remarks_clear(SbDocument *document);

// Reads both groups from document->entries; `shown` names the file in issues.
void sb_document_remarks_read(SbDocument *document, const char *shown, GPtrArray *issues);

// Appends the changes (of SbChange) of both groups with which saving makes the file state them. The
// caller frees the three strings of each by g_free().
void sb_document_change_remarks(GArray *changes, const SbDocument *document);

// ---- Values ----

// Returns the allowed range of a problem in the parameter's unit, "at least 5.79 mm"; NULL: none.
char *sb_document_problem_range(const SbProblem *problem, const SbParam *param);

// Reads a value with unit, or a percentage of the value in force ("+5 %"), to *out [SI]. Returns
// false with SB_APP_ERROR_INPUT, or with SB_APP_ERROR_RANGE for a value outside its range.
bool sb_document_read_value(double *out, const SbDocument *document, SbParamId id, const char *text,
                            GError **error);

// ---- Rubbers ----

// Reads the rubber `name` as sb_rubber_sheet_read(). Returns it with one reference, released by
// sb_named_rubber_release(); NULL with at least one issue.
SbNamedRubber *sb_named_rubber_read(const char *name, const char *directory, const char *shown,
                                    int line, GPtrArray *issues);

// Adds a reference and returns `rubber`; takes NULL.
SbNamedRubber *sb_named_rubber_hold(SbNamedRubber *rubber);

// Removes a reference; the last one frees the rubber. Takes NULL.
void sb_named_rubber_release(SbNamedRubber *rubber);

// Returns whether both have the same name and path, or are both NULL.
bool sb_named_rubber_same(const SbNamedRubber *a, const SbNamedRubber *b);

// Sets *place, which is &document->base_rubber or &document->own_rubber, to `rubber` (NULL: none),
// whose reference the document takes over, and updates document->data, without an edit.
void sb_document_put_rubber(SbDocument *document, SbNamedRubber **place, SbNamedRubber *rubber);

// Returns a copy of document->data with another rubber (NULL: none). Released by
// sb_model_data_release().
SbModelData *sb_document_data_with(const SbDocument *document, const SbNamedRubber *rubber);

// Returns the rubber in force; NULL: none. Borrowed.
SbNamedRubber *sb_document_rubber_in_force(const SbDocument *document);

// Makes `rubber` (NULL: none), whose reference the document takes over, its own by an edit.
void sb_document_edit_rubber(SbDocument *document, SbNamedRubber *rubber);

// Returns the name that a document in the folder `directory` must use for this document's own
// rubber; NULL: it has none.
char *sb_document_rubber_name_at(const SbDocument *document, const char *directory);

// ---- Edits ----

// Frees what an Edit owns; the clear function of document->edits.
void sb_document_clear_edit(gpointer edit);

// Returns whether the first group of measured data differs from that in the file.
bool sb_document_data_differs(const SbDocument *document);

// Records that the file has the present first group of measured data.
void sb_document_data_saved(SbDocument *document);

// ---- Notes ----

// Appends a note to `notes` (of SbIssue) for each hardness in [cases] and in the file's [pins].
void sb_document_note_cases(const SbDocument *document, GPtrArray *notes);

// Appends a note that a value in force differs from the size of a shape (sb_document_shape_note());
// `shown` names the file that gives the value. Does nothing if they agree.
void sb_document_note_override(SbDocument *document, SbParamId id, const char *shown);
