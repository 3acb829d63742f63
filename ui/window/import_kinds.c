// The kinds of files of the import dialog: measured loops, scans and drawings. Each one has its
// rows of the form, reads its file on a thread, draws what was read, and uses it.
#include "ui/window/import_private.h"

#include "app/base/output.h"
#include "app/chart/half_sections.h"
#include "app/chart/hysteresis.h"
#include "ui/views/style.h"
#include "ui/window/window.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

// Measured loops ---------------------------------------------------------------------------------

static const SbImportRow measured_rows[] = {
    {"separator", N_("Separator"), sb_data_separators},
    {"decimal", N_("Decimal mark"), sb_data_decimals},
    {"dates", N_("Dates"), sb_data_dates},
    {"encoding", N_("Encoding"), sb_text_table_encodings + 1},
    {"columns", N_("Columns"), NULL},
    {"units", N_("Units"), NULL},
    {"speed", N_("Speed, of the time alone"), NULL},
    {"direction", N_("Turned round"), sb_data_directions},
    {"zero", N_("At rest, without load"), NULL},
    {"compliance", N_("Compliance"), NULL},
    {"cycle", N_("Cycle"), NULL},
    {0},
};

G_STATIC_ASSERT(G_N_ELEMENTS(measured_rows) <= SB_IMPORT_ROWS + 1);

void sb_import_forget_measured(SbImportDialog *dialog) {
  g_clear_pointer(&dialog->comparison, sb_comparison_free);
  g_clear_pointer(&dialog->measured, sb_measured_free);
}

static void start_measured(SbImportDialog *dialog) {
  g_clear_pointer(&dialog->measuring, sb_measure_job_free);
  SbData *data = sb_data_of_file(dialog->path);
  g_autofree char *keys = sb_import_keys(dialog);
  sb_data_set_keys(data, keys);
  dialog->measuring = sb_measure_job_start(data, sb_session_drive_speed(dialog->session),
                                           sb_import_on_read, dialog);
}

static char *take_measured(SbImportDialog *dialog) {
  const SbIssue *why;
  SbMeasured *measured = sb_measure_job_take(dialog->measuring, &why);
  sb_import_forget_measured(dialog);
  if (measured == NULL) {
    sb_import_refuse(dialog, sb_issue_problem(why), &why->choice);
    return NULL;
  }
  // Beside the displayed run, as it will stand on the page.
  SbLoop loop = {0};
  const SbRun *run = sb_session_run(dialog->session);
  if (run != NULL && sb_session_summary(dialog->session) != NULL) {
    (void)sb_loop_take(&loop, run);
  }
  dialog->measured = measured;
  dialog->comparison = sb_comparison_create(measured, &loop);
  sb_loop_clear(&loop);
  g_autofree char *keys = sb_measured_keys(measured);
  sb_import_fill(dialog, keys, FALSE);
  return sb_measured_text(measured);
}

static void draw_measured(cairo_t *cr, double width, double height, void *user) {
  SbImportDialog *dialog = user;
  const SbTheme *theme = sb_style_ground(cr, SB_ROLE_PANEL);
  if (dialog->comparison != NULL) {
    SbChartData data = *sb_session_chart(dialog->session);
    data.measured = dialog->comparison;
    data.playing = FALSE;
    sb_hysteresis_draw(cr, (SbRect){0, 0, width, height}, theme, &data, SB_CHART_COMPACT);
  }
}

static bool use_measured(SbImportDialog *dialog) {
  SbData *data = sb_data_of_file(dialog->path);
  g_autofree char *keys = sb_measured_keys(dialog->measured);
  sb_data_set_keys(data, keys);
  sb_session_set_data(dialog->session, data);
  return true;
}

const SbImportKind sb_import_measured_kind = {N_("Import measured data"),
                                              N_("The loop as it was read"),
                                              measured_rows,
                                              start_measured,
                                              NULL,
                                              take_measured,
                                              draw_measured,
                                              use_measured,
                                              1100,
                                              640};

// Scans ------------------------------------------------------------------------------------------

#define FORM_NAME(code, text) text,
static const char *const forms[] = {SB_FORM_LIST(FORM_NAME) NULL};
#undef FORM_NAME

static const SbImportRow scan_rows[] = {
    {"form", N_("Form removed"), forms},
    {"outliers", N_("Outliers beyond, deviations"), NULL},
    {"missing", N_("Missing points"), sb_surface_missing},
    {"cutoff-short", N_("Shortest wave"), NULL},
    {"cutoff-long", N_("Longest wave"), NULL},
    {"channel", N_("Channel"), NULL},
    {"spacing", N_("Distance of points"), NULL},
    {"decimal", N_("Decimal mark"), sb_data_decimals},
    {"unit", N_("Unit of heights"), NULL},
    {"lateral-unit", N_("Unit of lengths"), NULL},
    {0},
};

// Reads a scan or a drawing.
static void start_reading(SbImportDialog *dialog) {
  dialog->surface = NULL;
  dialog->drawn = NULL;
  g_clear_pointer(&dialog->reading, sb_read_job_free);
  g_autofree char *keys = sb_import_keys(dialog);
  dialog->reading =
      sb_read_job_start(dialog->kind->reader, dialog->path, keys, sb_import_on_read, dialog);
}

static char *take_scan(SbImportDialog *dialog) {
  const GError *why = NULL;
  dialog->surface = sb_read_job_result(dialog->reading, &why);
  if (dialog->surface == NULL) {
    sb_import_refuse_error(dialog, why);
    return NULL;
  }
  const char *reason = NULL;
  g_autofree char *choices = sb_surface_choices_text(dialog->surface);
  g_auto(GStrv) settings = sb_surface_settings(&reason, dialog->surface);
  if (settings == NULL) {
    sb_import_problem(dialog, reason);
    return NULL;
  }
  if (!dialog->said[0]) {
    sb_import_set_choice(dialog, 0, sb_form_name(dialog->surface->choices->form));
  }
  g_autofree char *values = g_strjoinv("\n", settings);
  GString *text = g_string_new(NULL);
  for (guint i = 0; i < dialog->surface->scan->notes->len; i++) {
    g_string_append_printf(text, "%s\n", (char *)dialog->surface->scan->notes->pdata[i]);
  }
  g_string_append_printf(text, "%s\n%s", choices, values);
  return g_string_free(text, FALSE);
}

static void draw_scan(cairo_t *cr, double width, double height, void *user) {
  SbImportDialog *dialog = user;
  (void)sb_style_ground(cr, SB_ROLE_PANEL);
  // The page's columns need this width; on less it is drawn smaller.
  const double least = 1150, scale = fmin(width / least, 1);
  if (dialog->surface != NULL) {
    cairo_scale(cr, scale, scale);
    sb_surface_draw(cr, width / scale, height / scale, dialog->surface, sb_style_is_dark());
  }
}

static bool use_scan(SbImportDialog *dialog) {
  const char *reason = NULL;
  g_auto(GStrv) settings = sb_surface_settings(&reason, dialog->surface);
  for (char **each = settings; each != NULL && *each != NULL; each++) {
    g_auto(GStrv) parts = g_strsplit(*each, "=", 2);
    const int id = sb_param_find(parts[0]);
    if (id >= 0) {
      (void)sb_session_edit(dialog->session, (SbParamId)id, parts[1]);
    }
  }
  return true;
}

const SbImportKind sb_import_scan_kind = {N_("Import a scan"),
                                          N_("Map, spectrum and heights of the scan"),
                                          scan_rows,
                                          start_reading,
                                          &sb_read_scan,
                                          take_scan,
                                          draw_scan,
                                          use_scan,
                                          1320,
                                          820};

// Drawings ---------------------------------------------------------------------------------------

static const char *const flips[] = {"no", "yes", NULL};

static const SbImportRow drawing_rows[] = {
    {"unit", N_("Unit of a DXF or STL"), NULL},
    {"axis", N_("Direction of the axis"), NULL},
    {"through", N_("A point of the axis"), NULL},
    {"angle", N_("Half-plane of the section"), NULL},
    {"join", N_("Gaps of a DXF closed up to"), NULL},
    {"flip", N_("Canister on the right"), flips},
    {"shift", N_("Moved along the axis by"), NULL},
    {"density", N_("Density of the parts"), NULL},
    {"housing", N_("Housing: body"), NULL},
    {"stem_centre", N_("Stem centre: body"), NULL},
    {"stem_top", N_("Stem top: body"), NULL},
    {"stem_bottom", N_("Stem bottom: body"), NULL},
    {0},
};

G_STATIC_ASSERT(G_N_ELEMENTS(drawing_rows) <= SB_IMPORT_ROWS + 1);

// The scene with the drawing's parts for a file `path`, and how it differs from the document; NULL
// with the message shown.
static char *drawn_scene(SbImportDialog *dialog, const char *path, char **differences) {
  const SbDocument *document = sb_session_document(dialog->session);
  const SbDrawing *drawn = dialog->drawn;
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) after = NULL;
  char *text = sb_cad_scene(&after, drawn->cad, drawn->part, drawn->settings.density, document,
                            drawn->path, path, issues);
  if (text == NULL) {
    g_autofree char *line = sb_issue_line(issues->pdata[0]);
    sb_import_problem(dialog, line);
    return NULL;
  }
  *differences = sb_cad_differences(document, after);
  return text;
}

static char *take_drawing(SbImportDialog *dialog) {
  const GError *why = NULL;
  dialog->drawn = sb_read_job_result(dialog->reading, &why);
  if (dialog->drawn == NULL) {
    sb_import_refuse_error(dialog, why);
    return NULL;
  }
  const SbCad *cad = dialog->drawn->cad;
  GString *text = g_string_new(NULL);
  bool any = false;
  for (guint i = 0; i < cad->bodies->len; i++) {
    const SbCadBody *body = cad->bodies->pdata[i];
    char volume[SB_NUMBER_SIZE];
    g_string_append_printf(text, "%u %s: %s mm³%s%s\n", i + 1, body->name,
                           sb_number_round(volume, 1e9 * body->solid.volume, 4),
                           body->why != NULL ? "; " : "", body->why != NULL ? body->why : "");
  }
  for (int i = 0; i < SB_CAD_PART_COUNT; i++) {
    const int body = dialog->drawn->part[i];
    any = any || body >= 0;
    if (body >= 0 && !dialog->said[SB_IMPORT_PART_ROW + i]) {
      char number[SB_NUMBER_SIZE];
      sb_import_set_choice(dialog, SB_IMPORT_PART_ROW + i, sb_number_round(number, body + 1, 3));
    }
  }
  for (guint i = 0; i < cad->warnings->len; i++) {
    g_string_append_printf(text, "%s\n", (const char *)cad->warnings->pdata[i]);
  }
  g_autofree char *differences = NULL;
  g_autofree char *scene = any ? drawn_scene(dialog, "drawn.scene", &differences) : NULL;
  if (!any) {
    sb_import_problem(dialog, _("Assign the bodies to the parts, by number or name."));
  }
  if (scene != NULL) {
    g_string_append_printf(text, "\n%s",
                           *differences != '\0' ? differences : _("No value in force differs."));
  }
  gtk_label_set_text(GTK_LABEL(dialog->text), text->str);
  return g_string_free(text, scene == NULL);
}

static void draw_drawing(cairo_t *cr, double width, double height, void *user) {
  SbImportDialog *dialog = user;
  const SbTheme *theme = sb_style_ground(cr, SB_ROLE_PANEL);
  if (dialog->drawn != NULL) {
    sb_half_sections_draw(cr, (SbRect){0, 0, width, height}, theme, dialog->drawn->cad,
                          dialog->drawn->part);
  }
}

static bool use_drawing(SbImportDialog *dialog) {
  const char *own = sb_document_path(sb_session_document(dialog->session));
  GtkWindow *parent = gtk_window_get_transient_for(GTK_WINDOW(dialog->dialog));
  GtkFileChooserNative *chooser =
      gtk_file_chooser_native_new(_("Write the scene with these parts"), GTK_WINDOW(dialog->dialog),
                                  GTK_FILE_CHOOSER_ACTION_SAVE, _("_Save"), _("_Cancel"));
  gtk_file_chooser_set_do_overwrite_confirmation(GTK_FILE_CHOOSER(chooser), TRUE);
  gtk_file_chooser_set_current_name(GTK_FILE_CHOOSER(chooser), "drawn.scene");
  g_autofree char *folder = own != NULL ? g_path_get_dirname(own) : NULL;
  if (folder != NULL) {
    gtk_file_chooser_set_current_folder(GTK_FILE_CHOOSER(chooser), folder);
  }
  bool written = false;
  if (gtk_native_dialog_run(GTK_NATIVE_DIALOG(chooser)) == GTK_RESPONSE_ACCEPT) {
    g_autofree char *path = gtk_file_chooser_get_filename(GTK_FILE_CHOOSER(chooser));
    g_autofree char *differences = NULL;
    g_autofree char *text = drawn_scene(dialog, path, &differences);
    g_autoptr(GError) error = NULL;
    written = text != NULL && sb_output_write(path, text, strlen(text), &error);
    if (error != NULL) {
      sb_import_problem(dialog, error->message);
    }
    if (written) {
      g_autoptr(GFile) file = g_file_new_for_path(path);
      sb_window_open(SB_WINDOW(parent), file);
    }
  }
  g_object_unref(chooser);
  return written;
}

const SbImportKind sb_import_drawing_kind = {N_("Import a drawing"),
                                             N_("Half-sections of the bodies"),
                                             drawing_rows,
                                             start_reading,
                                             &sb_read_drawing,
                                             take_drawing,
                                             draw_drawing,
                                             use_drawing,
                                             1180,
                                             680};
