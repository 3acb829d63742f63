// A document: one valve, scene or project file (a scene with what a review adds to it), what it
// says, and what the user has changed since.
//
// Values lie in layers: the catalogue's defaults, then (for a scene) its valve's file, then the
// document's own keys. Edits go to the document's own keys and can be undone. Files are GKeyFile
// text with units in the values; comments and untouched values survive saving as they stand.
//
// Not thread-safe: a document belongs to one thread. Hand SbParams or models to others.
#pragma once

#include "app/base/issue.h"
#include "app/base/unit.h"
#include "app/document/data_keys.h"

#include "engine/valve/model/valve.h"

typedef struct SbDocument SbDocument;

// A key whose value is a text, with its help for a person.
typedef struct {
  const char *key, *help;
} SbTextKey;

// The table of these keys, which sb_param() does not have; it ends with a key of NULL. Static.
const SbTextKey *sb_document_text_keys(void);

typedef enum { SB_DOCUMENT_VALVE, SB_DOCUMENT_SCENE } SbDocumentKind;

enum { SB_DOCUMENT_FORMAT = 1, SB_DOCUMENT_BYTES_MAX = 1 << 20 };

// An empty valve: all defaults, no file. Owned by the caller.
SbDocument *sb_document_new(void);

// An empty valve in place of a file that could not be read: it does not compile, for these issues
// (at least one). Owned by the caller (sb_document_free).
SbDocument *sb_document_new_refused(const GPtrArray *issues);

// Whether the files of a document have errors that no edit has corrected; adds them to `issues`
// (NULL: not wanted). Such a document does not compile.
bool sb_document_faults(const SbDocument *document, GPtrArray *issues);

// Reads a valve or scene file (and a scene's valve). Every problem found is added to `issues`; a
// key with a problem keeps its default, and the document does not compile until the problem is
// corrected (sb_document_faults()). NULL if nothing could be made of it; then `issues` has at
// least one. With an empty `issues` afterwards the document is sound: its model compiles. Refuses
// what is not a regular file, larger than SB_DOCUMENT_BYTES_MAX, not UTF-8, or binary, without
// reading it. "-" is standard input: the document then has no path and looks for other files in the
// current folder. A PNG that this program wrote gives the scene it was drawn from, as a valve with
// all its values and without a path.
SbDocument *sb_document_load(const char *path, GPtrArray *issues);

// The same from memory; `name` stands in messages, `directory` is where a scene looks for its valve
// (NULL: the current one).
SbDocument *sb_document_parse(const char *text, size_t length, const char *name,
                              const char *directory, GPtrArray *issues);

// Takes NULL.
void sb_document_free(SbDocument *document);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbDocument, sb_document_free)

SbDocumentKind sb_document_kind(const SbDocument *document);

// Whether its file says kind = project: a scene with its pins, data, bookmarks and notes.
bool sb_document_is_project(const SbDocument *document);

// Path of the file, or NULL before the first save; borrowed until the next save.
const char *sb_document_path(const SbDocument *document);

// Path of a scene's valve file, or NULL; borrowed.
const char *sb_document_valve_path(const SbDocument *document);

// Remarks that are no problems: where a part's shape makes another value than the one in force,
// what modulus a hardness is, and which sizes stay while a drawing would change them with another.
// Borrowed until the next call for this document, of const char *.
const GPtrArray *sb_document_notes(const SbDocument *document);

// The shape that a size follows from by the document's own file, as "the bore of [part.housing]":
// it is mended there. NULL for all else; borrowed.
const char *sb_document_shape_source(const SbDocument *document, SbParamId id);

// "bore.diameter = 6.1 mm is in force; the bore of [part.housing] makes it 6 mm, ...": how a value
// in force differs from the size of a part's shape below it. NULL where it does not, or where no
// shape gives that size. Owned by the caller.
char *sb_document_shape_note(const SbDocument *document, SbParamId id);

// Name for titles: the `title` of group [sealbench], else the file's name, else "Untitled";
// borrowed until the next load or save.
const char *sb_document_title(const SbDocument *document);

// All values in force (defaults, valve, own); `given` tells which anybody gave. A copy.
SbParams sb_document_params(const SbDocument *document);

// Value in force of one parameter, SI.
double sb_document_value(const SbDocument *document, SbParamId id);

// The same as text with unit. Owned by the caller.
char *sb_document_text(const SbDocument *document, SbParamId id);

// Compiles the values in force; *out is owned by the caller. False with at least one issue (file,
// key, range) and *out = NULL if they contradict each other or if the files have errors.
bool sb_document_compile(const SbDocument *document, SbModel **out, GPtrArray *issues);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbModel, sb_model_destroy)

// Its own groups of measured data; borrowed.
size_t sb_document_data_count(const SbDocument *document);
const SbData *sb_document_data(const SbDocument *document, size_t index);

// Puts `data` (taken over; NULL: nothing measured) in place of its first group; an undoable edit,
// saved with the document. A group's file is written as seen from the document's folder.
void sb_document_put_data(SbDocument *document, SbData *data);

// The [limits] on figures: its valve's, and its own in their place; borrowed.
const SbLimits *sb_document_limits(const SbDocument *document);

// The [cases]: each is the document with some values replaced. The name is borrowed.
size_t sb_document_case_count(const SbDocument *document);
const char *sb_document_case_name(const SbDocument *document, size_t index);

// As sb_document_compile(), for one case; issues name it ("[cases] cold: gland.radial_space: ...").
bool sb_document_compile_case(const SbDocument *document, size_t index, SbModel **out,
                              GPtrArray *issues);

// Whether all compile.
bool sb_document_check_cases(const SbDocument *document, GPtrArray *issues);

// The [pins]: designs kept beside the document to compare with, each with all its values. The name
// is borrowed, NULL where nobody gave one. Keeping, dropping and naming them is saved with the
// document, but no edit that can be undone.
size_t sb_document_pin_count(const SbDocument *document);
const char *sb_document_pin_name(const SbDocument *document, size_t index);
const SbParams *sb_document_pin_params(const SbDocument *document, size_t index); // borrowed
bool sb_document_compile_pin(const SbDocument *document, size_t index, SbModel **out,
                             GPtrArray *issues);

// Keeps the present values with `count` others in place of some of them; false where there are 100
// already, or one is out of range.
bool sb_document_add_pin(SbDocument *document, const SbOverride *override, size_t count);
void sb_document_remove_pin(SbDocument *document, size_t index);
void sb_document_name_pin(SbDocument *document, size_t index, const char *name);

// Keeps those of another document in place of its own.
void sb_document_take_pins(SbDocument *document, const SbDocument *other);

// Makes a pin's values the document's, as one step that can be undone.
void sb_document_use_pin(SbDocument *document, size_t index);

// What a review adds (document_review.c): [bookmarks] NAME = TIME of the run, [notes] NAME = text.
// Each kind has its names; borrowed until the next change.
typedef enum { SB_REMARK_BOOKMARK, SB_REMARK_NOTE, SB_REMARK_KINDS } SbRemarkKind;
enum { SB_REMARKS_MAX = 100 }; // of each kind
size_t sb_document_remark_count(const SbDocument *document, SbRemarkKind kind);
const char *sb_document_remark_name(const SbDocument *document, SbRemarkKind kind, size_t index);
const char *sb_document_remark_text(const SbDocument *document, SbRemarkKind kind, size_t index);

// The text of a name; NULL: there is none.
const char *sb_document_remark(const SbDocument *document, SbRemarkKind kind, const char *name);

// Time of a bookmark [s].
double sb_document_bookmark(const SbDocument *document, size_t index);

// Adds one, or changes that of this name; `text` NULL takes it away. Saved with the document, but
// no edit that can be undone. On failure SB_APP_ERROR_INPUT and nothing changes.
SB_CHECKED bool sb_document_put_remark(SbDocument *document, SbRemarkKind kind, const char *name,
                                       const char *text, GError **error);

// Keeps those of another document in place of its own.
void sb_document_take_remarks(SbDocument *document, const SbDocument *other);

// Adds what is possible in a compiled document's geometry and hardly meant, as compile() does for
// what is not possible.
void sb_document_remarks(const SbDocument *document, const SbModel *model, GPtrArray *issues);

// SHA-256 (hex) over the canonical text of all values in force. Owned by the caller.
char *sb_document_sha256(const SbDocument *document);

// Sets a parameter from text ("1.63 mm", "reynolds", "400"); an undoable edit. On failure
// SB_APP_ERROR_INPUT, nothing changes, and the message ends with the allowed range.
SB_CHECKED bool sb_document_set(SbDocument *document, SbParamId id, const char *text,
                                GError **error);

// The same from an SI value. With `merge`, an edit of the same key right after another becomes one
// undo step (a drag).
SB_CHECKED bool sb_document_set_value(SbDocument *document, SbParamId id, double value, bool merge,
                                      GError **error);

// Several values as one undo step; false where one of them was out of range and left out.
bool sb_document_set_values(SbDocument *document, const SbOverride *override, size_t count);

// The next edit is a step of its own, whatever its key.
void sb_document_end_merge(SbDocument *document);

// "KEY=VALUE" of --set; a percentage with a sign ("+5 %") changes the value in force by that much.
// Issues name the file "--set".
bool sb_document_set_option(SbDocument *document, const char *option, GPtrArray *issues);

// Applies all settings (NULL-terminated; NULL: none), each as sb_document_set_option(). Where they
// change the fluid, figures that stay as the document gives them are marked as those of its own
// fluid (fluid.figures).
void sb_document_set_options(SbDocument *document, char *const *settings, GPtrArray *issues);

// Removes the document's own value: the valve's or the default is in force again. Undoable.
void sb_document_unset(SbDocument *document, SbParamId id);

// True if the document itself gives this key (not its valve, not the default).
bool sb_document_gives(const SbDocument *document, SbParamId id);

// True if the key differs from what the file on disk says.
bool sb_document_differs(const SbDocument *document, SbParamId id);

// True if any key does: there is something to save.
bool sb_document_is_modified(const SbDocument *document);

// The rubber in force by its name, NULL if none is; an undoable edit of the document's own one
// (NULL: the valve's again), false with an issue; whether it has one; and the names that there are
// (g_strfreev).
const char *sb_document_rubber(const SbDocument *document);
SB_CHECKED bool sb_document_set_rubber(SbDocument *document, const char *name, GPtrArray *issues);
bool sb_document_gives_rubber(const SbDocument *document);

// The file that draws the seals' section, as the document names it; NULL: none. And one that was
// read from `path` (seal_file.h), which the document then names: an undoable edit, one step with
// seal.profile = file.
const char *sb_document_section(const SbDocument *document);
void sb_document_set_section(SbDocument *document, const char *path, const SbSealDrawing *section,
                             double height);

// The same of the groove's outline; path NULL: none, which a scene whose valve draws one cannot
// say.
const char *sb_document_groove(const SbDocument *document);
bool sb_document_may_drop_groove(const SbDocument *document);
void sb_document_set_groove(SbDocument *document, const char *path, const SbGrooveDrawing *groove);

char **sb_document_rubbers(const SbDocument *document);

// Undo and redo; each returns the parameter that changed, one of these, or -1 if there was nothing
// to do.
enum {
  SB_DOCUMENT_RUBBER = SB_PARAM_COUNT,
  SB_DOCUMENT_MEASURED,
  SB_DOCUMENT_SECTION,
  SB_DOCUMENT_GROOVE,
  SB_DOCUMENT_WHOLE // everything, document_disk.h
};
int sb_document_undo(SbDocument *document);
int sb_document_redo(SbDocument *document);
// What undo (or redo) would change next: the parameter or one of these, with the value in
// force before and after that edit [SI]; -1 if there is nothing.
int sb_document_next_undo(const SbDocument *document, bool redo, double value[2]);
bool sb_document_can_undo(const SbDocument *document);
bool sb_document_can_redo(const SbDocument *document);

// Counts every change of a value, a pin, a bookmark or a note; two equal numbers mean that nothing
// has changed.
unsigned sb_document_serial(const SbDocument *document);

// The text that saving to `path` would write (NULL: where it is now). Owned by the caller.
char *sb_document_to_text(const SbDocument *document, const char *path);

// A valve text with every value in force, which stands alone (for a picture that can be opened
// again). Owned by the caller.
char *sb_document_to_flat_text(const SbDocument *document);

// Writes the file by way of a temporary one in the same folder and a rename; afterwards nothing
// differs and `path` is the document's. On failure SB_APP_ERROR_IO and an earlier file is intact. A
// scene saved elsewhere keeps its valve by a new relative path.
SB_CHECKED bool sb_document_save(SbDocument *document, const char *path, GError **error);
