// Shared by export_dialog.c (the form) and export_dialog_job.c (the export).
#pragma once

#include "app/export/export_job.h"
#include "app/export/render.h"
#include "ui/views/later.h"
#include "ui/window/export_dialog.h"

// The dialog, freed with its widget `dialog`.
typedef struct {
  SbSession *session; // owned reference
  // Widgets of the form (assets/ui/export.ui), with its names.
  GtkWidget *dialog, *form, *view, *format, *size, *width, *height, *theme, *at, *at_label;
  GtkWidget *range_label, *range_box, *from, *to;
  GtkWidget *film_box, *film_label, *fps, *pace, *duration, *duration_unit, *speed, *speed_unit;
  GtkWidget *section_label, *section_box, *halves, *insets, *undeformed;
  GtkWidget *field_label, *field_box, *field, *field_max;
  GtkWidget *path, *choose, *result, *progress;
  GtkWidget *cancel, *export;
  SbExportJob *job; // running export, owned; NULL: none
  SbLater poll;     // shows the progress of `job`
  SbLater later;    // delayed call of sb_export_dialog_later()
  gboolean sizing;  // a preset, not the user, changes the size
} SbExportDialog;

// Returns the chosen view; NULL: none is chosen yet. Static.
const SbRenderView *sb_export_dialog_view(SbExportDialog *dialog);

// Returns whether a sequence of pictures is chosen.
gboolean sb_export_dialog_is_sequence(SbExportDialog *dialog);

// Returns whether a movie is made by its speed, not by its duration.
gboolean sb_export_dialog_by_speed(SbExportDialog *dialog);

// Returns whether the displayed run has rings with fields.
gboolean sb_export_dialog_has_fields(SbExportDialog *dialog);

// Gives the file name the ending of the chosen format, and the name of a sequence a number.
void sb_export_dialog_follow_format(SbExportDialog *dialog);

// Calls call(dialog) from the main loop, soon: a modal question must not start inside a call from a
// screen reader.
void sb_export_dialog_later(SbExportDialog *dialog, void (*call)(gpointer data));

// A handler of "response": starts or cancels the export, or closes the dialog.
void sb_export_dialog_on_response(GtkDialog *widget, int response, SbExportDialog *dialog);
