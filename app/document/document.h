// A document: one valve, scene or project file (a scene with what a review adds to it), and what
// the user has changed since it was read.
//
// Values are in layers: the catalogue's defaults, then (for a scene) those of its valve's file,
// then the document's own. The value *in force* is that of the highest layer that gives the key.
// Edits change the document's own values and can be undone. Files are GKeyFile text with units in
// the values; comments and values that were not edited are saved unchanged.
//
// Each document belongs to one thread; other threads receive SbParams or models. A document that
// sb_document_free() has not freed yet lends strings; unless stated otherwise they are valid until
// the document changes.
#pragma once

#include "app/base/issue.h"
#include "app/base/unit.h"
#include "app/document/data_keys.h"

#include "engine/valve/model/valve.h"

typedef struct SbDocument SbDocument;

// A key whose value is a text (a file or a rubber), which sb_param() does not have.
typedef struct {
  const char *key;  // such as "drive.file"
  const char *help; // sentence for the user
} SbTextKey;

// Keys that name a file. Those from SB_FILE_SECTION on are drawings, which edits can change.
typedef enum {
  SB_FILE_DRIVE,   // measured series of the drive
  SB_FILE_SHELF,   // temperatures of a shelf
  SB_FILE_SECTION, // drawing of the seals' section
  SB_FILE_GROOVE,  // drawing of the groove
  SB_FILE_COUNT
} SbFileKey;

// Returns the table of the keys with a text: those of the files by SbFileKey, then that of the
// rubber (SB_FILE_COUNT); the last row has the key NULL. Static.
const SbTextKey *sb_document_text_keys(void);

// Kind of the file. A project is a scene (sb_document_is_project()).
typedef enum { SB_DOCUMENT_VALVE, SB_DOCUMENT_SCENE } SbDocumentKind;

// Version of the format; largest size of a file [bytes].
enum { SB_DOCUMENT_FORMAT = 1, SB_DOCUMENT_BYTES_MAX = 1 << 20 };

// ---- Reading ----

// Returns an empty valve: all defaults, no file. Freed by sb_document_free().
SbDocument *sb_document_new(void);

// Returns an empty valve in place of a file that could not be read. It does not compile because of
// `issues` (at least one), which are copied. Freed by sb_document_free().
SbDocument *sb_document_new_refused(const GPtrArray *issues);

// Returns whether the files of a document have errors that no edit has corrected, and appends them
// to `issues` (NULL: not wanted). Such a document does not compile.
bool sb_document_faults(const SbDocument *document, GPtrArray *issues);

// Reads a valve or scene file, and the valve of a scene. Appends every problem to `issues`; a key
// with a problem keeps its default, and the document does not compile until the problem is
// corrected (sb_document_faults()). If no issue was added, the document compiles. Returns NULL,
// with at least one issue, if the text is no document at all or the file is not a regular file,
// larger than SB_DOCUMENT_BYTES_MAX, not UTF-8, or binary. Freed by sb_document_free().
//
// "-" is standard input: the document has no path and looks for other files in the current folder,
// as does that of a pipe (sb_reader_folder()).
// From a PNG that this program wrote, the scene that was drawn is read, as a valve with all its
// values and without a path.
SbDocument *sb_document_load(const char *path, GPtrArray *issues);

// Returns the content of the file `path` ("-": standard input) for sb_document_read(), *length
// bytes and a terminating 0; freed by g_free(). NULL with one issue if it is not a regular file,
// cannot be read, or is larger than SB_DOCUMENT_BYTES_MAX (a PNG may be larger).
char *sb_document_load_text(size_t *length, const char *path, GPtrArray *issues);

// As sb_document_load(), from the content of `path` that sb_document_load_text() returned.
SbDocument *sb_document_read(const char *path, const char *text, size_t length, GPtrArray *issues);

// As sb_document_load(), from the `length` bytes of a file. `name` is used as its path in messages;
// `directory` is the folder in which the valve and other files are looked for (NULL: the current
// one). The document has no path.
SbDocument *sb_document_parse(const char *text, size_t length, const char *name,
                              const char *directory, GPtrArray *issues);

// Frees a document.
void sb_document_free(SbDocument *document);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbDocument, sb_document_free)

// ---- The file ----

// Returns whether the document is a valve or a scene.
SbDocumentKind sb_document_kind(const SbDocument *document);

// Returns whether the file has `kind = project`: a scene with its pins, data, bookmarks and notes.
bool sb_document_is_project(const SbDocument *document);

// Returns the path of the file; NULL before the first save. Borrowed until the next save.
const char *sb_document_path(const SbDocument *document);

// Returns the path of a scene's valve file; NULL: a valve. Borrowed until the next save.
const char *sb_document_valve_path(const SbDocument *document);

// Returns notes (of SbIssue, whose text names the key too) that are no errors: values in force that
// differ from a part's shape, and the modulus that follows from a hardness. Borrowed until the next
// call for this document.
const GPtrArray *sb_document_notes(const SbDocument *document);

// Appends a note to `notes` (of SbIssue) for each size that does not fit the others
// (sb_params_size_check()): the file gives it, so it does not follow another size which --set or an
// edit has changed, although both change together in a drawing; or the sizes cannot be built. A run
// has the same text as its warning.
void sb_document_kept(const SbDocument *document, GPtrArray *notes);

// Returns which shape of the document's own file gives the size `id`, such as "the bore of
// [part.housing]": there it is edited. NULL: no shape gives it.
const char *sb_document_shape_source(const SbDocument *document, SbParamId id);

// Returns a sentence on the difference between the value in force of `id` and the size of a part's
// shape in the layers below: "bore.diameter = 6.1 mm applies; the bore of [part.housing] has 6 mm,
// ...". NULL if there is no difference, or no shape gives this size.
char *sb_document_shape_note(const SbDocument *document, SbParamId id);

// Returns the title: `title` of group [sealbench], else the file's name, else "Untitled". Borrowed
// until the next save.
const char *sb_document_title(const SbDocument *document);

// ---- Values ----

// Returns a copy of all values in force [SI]; `given` states which of them a file or an edit gives.
// The member `rubber` is borrowed from the document until it changes.
SbParams sb_document_params(const SbDocument *document);

// Returns the value in force of a parameter [SI]; of a choice its index.
double sb_document_value(const SbDocument *document, SbParamId id);

// Returns the value in force as text with its unit ("1.61 mm").
char *sb_document_text(const SbDocument *document, SbParamId id);

// Compiles the values in force to a model, freed by sb_model_destroy(). Returns false, with at
// least one issue (file, key, allowed range) and *out = NULL, if the values are inconsistent or the
// files have errors.
bool sb_document_compile(const SbDocument *document, SbModel **out, GPtrArray *issues);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbModel, sb_model_destroy)

// ---- Measured data ----

// Returns the number of the document's own groups [data] and [data NAME].
size_t sb_document_data_count(const SbDocument *document);

// Returns group `index`, from 0.
const SbData *sb_document_data(const SbDocument *document, size_t index);

// Replaces the first group, under its name, by `data`, which the document owns from now on and
// whose path must be set (NULL: removes the group). An edit that can be undone and is saved with
// the document. A file's path is written relative to the document's folder.
void sb_document_put_data(SbDocument *document, SbData *data);

// ---- Limits and cases ----

// Returns the [limits] on figures: those of its valve, replaced by its own.
const SbLimits *sb_document_limits(const SbDocument *document);

// Returns the number of [cases]; each is the document with some values replaced.
size_t sb_document_case_count(const SbDocument *document);

// Returns the name of case `index`, from 0.
const char *sb_document_case_name(const SbDocument *document, size_t index);

// As sb_document_compile(), for case `index`; issues name it ("[cases] cold: gland.radial_space:
// ...").
bool sb_document_compile_case(const SbDocument *document, size_t index, SbModel **out,
                              GPtrArray *issues);

// Returns whether all cases compile; appends the issues of those that do not.
bool sb_document_check_cases(const SbDocument *document, GPtrArray *issues);

// ---- Pins: saved designs for comparison, each with all its values ----
//
// Adding, removing and naming pins is saved with the document, but cannot be undone.

// Returns the number of [pins].
size_t sb_document_pin_count(const SbDocument *document);

// Returns the name of pin `index`, from 0; NULL: it has none.
const char *sb_document_pin_name(const SbDocument *document, size_t index);

// Returns all values of pin `index` [SI]. Borrowed until pins are removed or replaced.
const SbParams *sb_document_pin_params(const SbDocument *document, size_t index);

// As sb_document_compile(), for pin `index`.
bool sb_document_compile_pin(const SbDocument *document, size_t index, SbModel **out,
                             GPtrArray *issues);

// Appends a pin without a name: the values in force, of which override[count] replace some. Returns
// false, without a pin, if there are 100 already or a value is out of range.
bool sb_document_add_pin(SbDocument *document, const SbOverride *override, size_t count);

// Removes pin `index`; later ones move up.
void sb_document_remove_pin(SbDocument *document, size_t index);

// Sets the name of pin `index`. Characters that a key cannot contain become blanks. The pin has no
// name if the name is empty, belongs to another pin, or has the form "pin 1".
void sb_document_name_pin(SbDocument *document, size_t index, const char *name);

// Replaces the document's pins by copies of those of `other`.
void sb_document_take_pins(SbDocument *document, const SbDocument *other);

// Sets the values and the rubber of the document to those of pin `index`, as one step for undo.
void sb_document_use_pin(SbDocument *document, size_t index);

// ---- Bookmarks and notes of a review ----
//
// [bookmarks] has lines NAME = TIME of the run, [notes] lines NAME = text. Each kind has its own
// names. Changes are saved with the document, but cannot be undone. Returned strings are valid
// until the next change.

typedef enum { SB_REMARK_BOOKMARK, SB_REMARK_NOTE, SB_REMARK_KINDS } SbRemarkKind;

// Largest number of each kind.
enum { SB_REMARKS_MAX = 100 };

// Returns the number of bookmarks or notes.
size_t sb_document_remark_count(const SbDocument *document, SbRemarkKind kind);

// Returns the name of bookmark or note `index`, from 0, in the order of the file.
const char *sb_document_remark_name(const SbDocument *document, SbRemarkKind kind, size_t index);

// Returns its text: of a bookmark a time with unit ("1.25 s"), of a note any text.
const char *sb_document_remark_text(const SbDocument *document, SbRemarkKind kind, size_t index);

// Returns the text of a name; NULL: there is none.
const char *sb_document_remark(const SbDocument *document, SbRemarkKind kind, const char *name);

// Returns the time of bookmark `index` from the start of the run [s].
double sb_document_bookmark(const SbDocument *document, size_t index);

// Adds a bookmark or note, or changes the text of an existing one; `text` NULL removes it (also if
// there is none: true). The text of a bookmark is a time from 0 with its unit ("1.25 s"). Returns
// false with SB_APP_ERROR_INPUT, without a change, if the name (1 to 80 bytes; no "=", "[", "]" or
// line end, no "#" at its start, no blank at its ends) or the text (at most 4000 bytes) is not
// allowed or there are SB_REMARKS_MAX.
SB_CHECKED bool sb_document_put_remark(SbDocument *document, SbRemarkKind kind, const char *name,
                                       const char *text, GError **error);

// Replaces the document's bookmarks and notes by copies of those of `other`.
void sb_document_take_remarks(SbDocument *document, const SbDocument *other);

// ---- Checks ----

// Appends an issue for each property of the geometry that is possible but probably not intended.
// `model` is the compiled document.
void sb_document_remarks(const SbDocument *document, const SbModel *model, GPtrArray *issues);

// Returns the SHA-256 (64 hexadecimal digits) of all values in force and of the measured series and
// drawings that files give.
char *sb_document_sha256(const SbDocument *document);

// ---- Edits ----

// Sets a parameter from text with unit ("1.63 mm", "reynolds", "400"); an edit that can be undone.
// Returns false with SB_APP_ERROR_RANGE (a number outside the range) or SB_APP_ERROR_INPUT, without
// a change; the message ends with the allowed range.
SB_CHECKED bool sb_document_set(SbDocument *document, SbParamId id, const char *text,
                                GError **error);

// As sb_document_set(), from an SI value (of a choice its index). With `merge`, an edit that
// follows an edit of the same key with `merge` belongs to the same step for undo (dragging).
SB_CHECKED bool sb_document_set_value(SbDocument *document, SbParamId id, double value, bool merge,
                                      GError **error);

// Sets override[count] as one step for undo. Returns false if one of the values was out of range
// and was therefore not set; the others are set.
bool sb_document_set_values(SbDocument *document, const SbOverride *override, size_t count);

// Ends a merge: the next edit is a step of its own, whatever its key.
void sb_document_end_merge(SbDocument *document);

// Applies "KEY=VALUE" of the option --set; also keys that name a file or a rubber, relative to the
// current folder. A percentage with a sign ("+5 %") changes the value in force by this fraction.
// Returns false with an issue whose file is "--set".
bool sb_document_set_option(SbDocument *document, const char *option, GPtrArray *issues);

// Applies all settings (ends with NULL; NULL: none), each as sb_document_set_option(). If they
// change the fluid, properties that the document itself gives are marked as those of its own fluid
// (fluid.figures).
void sb_document_set_options(SbDocument *document, char *const *settings, GPtrArray *issues);

// Removes the document's own value: that of the valve, of a shape or the default is in force again.
// Can be undone.
void sb_document_unset(SbDocument *document, SbParamId id);

// Returns whether the document itself gives this key, not its valve and not the default.
bool sb_document_gives(const SbDocument *document, SbParamId id);

// Returns whether the document's own value of the key differs from the file as last read or saved.
bool sb_document_differs(const SbDocument *document, SbParamId id);

// Returns whether anything differs from the file as last read or saved, so that there is something
// to save.
bool sb_document_is_modified(const SbDocument *document);

// ---- The rubber ----

// Returns the name of the rubber in force, as the file names it; NULL: none.
const char *sb_document_rubber(const SbDocument *document);

// Sets the document's own rubber by name or path; NULL: that of the valve is in force again. Can be
// undone. Returns false with an issue if there is no such rubber.
SB_CHECKED bool sb_document_set_rubber(SbDocument *document, const char *name, GPtrArray *issues);

// Returns whether the document itself names a rubber.
bool sb_document_gives_rubber(const SbDocument *document);

// Returns the names of all rubbers that the document can use, sorted, ends with NULL. Freed by
// g_strfreev().
char **sb_document_rubbers(const SbDocument *document);

// ---- Drawings of the seals' section and of the groove ----

// Returns the name of the file that draws the seals' section, as the document has it; NULL: none.
const char *sb_document_section(const SbDocument *document);

// Sets the seals' section to `section` with its radial height [m], as sb_seal_file_read() read them
// from `path`, which the document then names. One step for undo, with seal.profile = file.
void sb_document_set_section(SbDocument *document, const char *path, const SbSealDrawing *section,
                             double height);

// Returns the name of the file that draws the groove, as the document has it; NULL: none.
const char *sb_document_groove(const SbDocument *document);

// Returns whether the document has a drawn groove that it can remove: not if its valve draws one.
bool sb_document_may_drop_groove(const SbDocument *document);

// Sets the groove as sb_groove_file_read() read it from `path`; `path` NULL removes it (only if
// sb_document_may_drop_groove()), and `groove` is not used. Can be undone.
void sb_document_set_groove(SbDocument *document, const char *path, const SbGrooveDrawing *groove);

// ---- Undo ----

// What an edit changes, apart from an SbParamId.
enum {
  SB_DOCUMENT_RUBBER = SB_PARAM_COUNT, // the rubber
  SB_DOCUMENT_MEASURED,                // the first group of measured data
  SB_DOCUMENT_SECTION,                 // the drawing of the section
  SB_DOCUMENT_GROOVE,                  // the drawing of the groove
  SB_DOCUMENT_WHOLE                    // everything (document_disk.h)
};

// Reverts the last step. Returns what changed, an SbParamId or one of the values above (of a step
// with several edits its first one); -1: there is nothing to undo.
int sb_document_undo(SbDocument *document);

// Repeats the step that was reverted last. Returns as sb_document_undo().
int sb_document_redo(SbDocument *document);

// Returns what sb_document_undo() (with `redo` sb_document_redo()) would change next; -1: nothing.
// For a parameter, writes the values in force before [0] and after [1] the original edit [SI], else
// nothing.
int sb_document_next_undo(const SbDocument *document, bool redo, double value[2]);

// Returns whether there is a step to undo.
bool sb_document_can_undo(const SbDocument *document);

// Returns whether there is a step to redo.
bool sb_document_can_redo(const SbDocument *document);

// Returns a counter that changes of values, pins, bookmarks and notes increase. Two equal numbers
// mean that the values in force have not changed in between.
unsigned sb_document_serial(const SbDocument *document);

// ---- Writing ----

// Returns the text that saving to `path` would write (NULL: to the present path).
char *sb_document_to_text(const SbDocument *document, const char *path);

// Returns the text of a valve with every value in force, which needs no other valve file (for a
// picture that can be opened again).
char *sb_document_to_flat_text(const SbDocument *document);

// Writes the file atomically. Afterwards nothing differs from it, and `path` is the document's
// path. Returns false with SB_APP_ERROR_IO if that fails; an earlier file is then intact. A scene
// that is saved to another folder names its valve by a new relative path.
SB_CHECKED bool sb_document_save(SbDocument *document, const char *path, GError **error);
