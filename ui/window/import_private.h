// Shared by import_dialog.c (the dialog and its form) and import_kinds.c (kinds of files).
#pragma once

#include "app/export/surface.h"
#include "app/session/measure_job.h"
#include "ui/views/draw_cache.h"
#include "ui/views/later.h"
#include "ui/window/import_dialog.h"
#include "ui/window/read_job.h"

typedef struct SbImportDialog SbImportDialog;

// A row of the form.
typedef struct {
  const char *key;          // its key in a document and as an option; NULL: end of the rows
  const char *label;        // marked for translation
  const char *const *words; // words that may be chosen, ended by NULL; NULL: any text
} SbImportRow;

// Maximum number of rows, and index of the row of a drawing's first part.
enum { SB_IMPORT_ROWS = 12, SB_IMPORT_PART_ROW = 8 };

// A kind of files.
typedef struct {
  const char *title, *picture; // title of the dialog, and name of its picture; for translation
  const SbImportRow *row;      // rows of the form, up to a key of NULL
  void (*start)(SbImportDialog *dialog); // starts to read the file on a thread
  const SbReadKind *reader;              // what dialog->reading reads; NULL: dialog->measuring does
  // Takes what was read and returns it in words, freed with g_free(); NULL after a message.
  char *(*take)(SbImportDialog *dialog);
  // Draws what was taken, or nothing; `dialog` is the SbImportDialog.
  void (*draw)(cairo_t *cr, double width, double height, void *dialog);
  // Gives what was taken to the session. Returns false after a message: the dialog stays open.
  bool (*use)(SbImportDialog *dialog);
  int width, height; // default size of the dialog [px]
} SbImportKind;

// The dialog, freed with its widget `dialog`.
struct SbImportDialog {
  const SbImportKind *kind; // borrowed
  SbSession *session;       // owned reference
  // Widgets; `choice` has one for each row of the form, an entry or a combo box.
  GtkWidget *dialog, *choice[SB_IMPORT_ROWS], *area, *text, *message, *spinner;
  GtkWidget *offers;             // buttons of the values that would resolve a refusal
  SbDrawCache *cache;            // picture of `area`
  char *path;                    // absolute path of the file, owned
  gboolean said[SB_IMPORT_ROWS]; // the row was chosen by the user or the document, not found
  gboolean filling;              // the program, not the user, changes the rows
  SbLater later;                 // delayed reading after a choice
  SbMeasureJob *measuring;       // reads measured data, owned; NULL: none
  SbMeasured *measured;          // measured data that were read, owned; NULL: none
  SbComparison *comparison;      // of `measured` with the displayed run, owned; NULL: none
  SbReadJob *reading;            // reads a scan or a drawing, owned; NULL: none
  const SbSurface *surface;      // scan that was read, borrowed from `reading`; NULL: none
  const SbDrawing *drawn;        // drawing that was read, borrowed from `reading`; NULL: none
};

// ---- The form (import_dialog.c) ----

// Shows `why`, a translated sentence, as the message of the dialog; NULL: no message.
void sb_import_problem(SbImportDialog *dialog, const char *why);

// Shows why a file is not read. `problem` is the message without its remedy, freed here. If
// `choice` (NULL: none) has the key of a row of the form, the message names the row, and there is a
// button for each plausible value, which sets the row and reads the file again.
void sb_import_refuse(SbImportDialog *dialog, char *problem, const SbChoice *choice);

// As sb_import_refuse(), for the error of a reader.
void sb_import_refuse_error(SbImportDialog *dialog, const GError *error);

// Writes row `i` of the form (`text` "": empty), which does not count as chosen by the user.
void sb_import_set_choice(SbImportDialog *dialog, int i, const char *text);

// Returns the choices of the user and of the document as lines "key = value". Freed with g_free().
char *sb_import_keys(const SbImportDialog *dialog);

// Fills the form from lines "key = value": with `said` as choices of the document, otherwise only
// rows without a choice.
void sb_import_fill(SbImportDialog *dialog, const char *keys, gboolean said);

// Shows what was read, or the problem; `data` is the SbImportDialog. The callback `done` of the
// jobs that read.
void sb_import_on_read(void *data);

// ---- Kinds of files (import_kinds.c) ----

// Measured loops.
extern const SbImportKind sb_import_measured_kind;

// Scans of a surface.
extern const SbImportKind sb_import_scan_kind;

// Drawings of a valve's parts.
extern const SbImportKind sb_import_drawing_kind;

// Frees the measured data that were read and their comparison.
void sb_import_forget_measured(SbImportDialog *dialog);
