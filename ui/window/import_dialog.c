// See the header. Files are read on a thread as they are chosen and again with each choice; the
// choices not made are filled with what was found. What was read is drawn as it will be seen.
#include "ui/window/import_dialog.h"

#include "app/base/output.h"
#include "app/chart/half_sections.h"
#include "app/chart/hysteresis.h"
#include "app/export/surface.h"
#include "app/session/measure_job.h"
#include "ui/views/draw_cache.h"
#include "ui/views/later.h"
#include "ui/views/style.h"
#include "ui/window/read_job.h"
#include "ui/window/window.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

typedef struct Dialog Dialog;

// A row of the form: its key in a file or option, and what may be chosen (NULL: a text).
typedef struct {
  const char *key, *label, *words;
} Row;

enum { ROWS = 12, PART_ROW = 8 }; // the row of a drawing's first part

// What kinds of files differ in.
typedef struct {
  const char *title, *picture;
  const Row *row; // up to a key of NULL
  void (*start)(Dialog *dialog);
  const SbReadKind *reader;      // of start_reading()
  char *(*take)(Dialog *dialog); // what was recognised; NULL with the message shown
  void (*draw)(cairo_t *cr, double width, double height, void *dialog);
  bool (*use)(Dialog *dialog); // false: the dialog stays, its message says why
  int width, height;           // of the dialog
} Kind;

struct Dialog {
  const Kind *kind;
  SbSession *session; // owned reference
  GtkWidget *dialog, *choice[ROWS], *area, *text, *message, *spinner;
  SbDrawCache *cache;
  char *path;
  gboolean said[ROWS]; // by the user or the document, not found
  gboolean filling;    // the program writes the choices
  SbLater later;       // reads the file
  SbMeasureJob *measuring;
  SbMeasured *measured;
  SbComparison *comparison;
  SbReadJob *reading;
  const SbSurface *surface; // of `reading`, once a scan is read
  const SbDrawing *drawn;   // of `reading`, once a drawing is read
};

// The form ---------------------------------------------------------------------------------------

static const char *choice_text(const Dialog *dialog, int i) {
  GtkWidget *widget = dialog->choice[i];
  return GTK_IS_ENTRY(widget) ? gtk_entry_get_text(GTK_ENTRY(widget))
                              : gtk_combo_box_get_active_id(GTK_COMBO_BOX(widget));
}

// Shows why a file is not read. Options of the command line are named as the rows of the form.
static void show_problem(Dialog *dialog, const char *why) {
  g_autofree char *text = g_strdup(why != NULL ? why : "");
  for (const Row *row = dialog->kind->row; row->key != NULL; row++) {
    g_autofree char *option = g_strconcat("--", row->key, NULL);
    g_autofree char *label = g_strdup_printf("\"%s\"", _(row->label));
    g_auto(GStrv) parts = g_strsplit(text, option, -1);
    g_free(text);
    text = g_strjoinv(label, parts);
  }
  gtk_label_set_text(GTK_LABEL(dialog->message), text);
}

static void set_choice(Dialog *dialog, int i, const char *text) {
  GtkWidget *widget = dialog->choice[i];
  dialog->filling = TRUE;
  if (GTK_IS_ENTRY(widget)) {
    gtk_entry_set_text(GTK_ENTRY(widget), text);
  } else {
    gtk_combo_box_set_active_id(GTK_COMBO_BOX(widget), text);
  }
  dialog->filling = FALSE;
}

// The choices that were made, as lines "key = value". Owned by the caller.
static char *said_keys(const Dialog *dialog) {
  GString *keys = g_string_new(NULL);
  for (int i = 0; dialog->kind->row[i].key != NULL; i++) {
    const char *text = choice_text(dialog, i);
    if (dialog->said[i] && text != NULL && *text != '\0') {
      g_string_append_printf(keys, "%s = %s\n", dialog->kind->row[i].key, text);
    }
  }
  return g_string_free(keys, FALSE);
}

// Fills the choices from such lines; `said`: as made, else only those that are not.
static void fill(Dialog *dialog, const char *keys, gboolean said) {
  g_auto(GStrv) lines = g_strsplit(keys, "\n", -1);
  for (char **line = lines; *line != NULL; line++) {
    char *equal = strstr(*line, " = ");
    for (int i = 0; equal != NULL && dialog->kind->row[i].key != NULL; i++) {
      const char *key = dialog->kind->row[i].key;
      const gboolean fits =
          strlen(key) == (gsize)(equal - *line) && strncmp(key, *line, strlen(key)) == 0;
      if (fits && (said || !dialog->said[i])) {
        set_choice(dialog, i, equal + 3);
        dialog->said[i] = said;
      }
    }
  }
}

static void busy(Dialog *dialog, gboolean on) {
  (on ? gtk_spinner_start : gtk_spinner_stop)(GTK_SPINNER(dialog->spinner));
  gtk_dialog_set_response_sensitive(GTK_DIALOG(dialog->dialog), GTK_RESPONSE_ACCEPT, FALSE);
}

static void read_file(Dialog *dialog) {
  busy(dialog, TRUE);
  dialog->kind->start(dialog);
}

// A thread has read the file.
static void on_read(void *data) {
  Dialog *dialog = data;
  g_autofree char *text = dialog->kind->take(dialog);
  busy(dialog, FALSE);
  gtk_dialog_set_response_sensitive(GTK_DIALOG(dialog->dialog), GTK_RESPONSE_ACCEPT, text != NULL);
  if (text != NULL) {
    gtk_label_set_text(GTK_LABEL(dialog->message), "");
    gtk_label_set_text(GTK_LABEL(dialog->text), text);
  }
  sb_style_name(dialog->area, dialog->kind->picture, text);
  sb_draw_cache_change(dialog->cache, 0);
}

static void on_later(gpointer data) {
  Dialog *dialog = data;
  read_file(dialog);
}

static void on_choice(GtkWidget *widget, Dialog *dialog) {
  if (dialog->filling) {
    return;
  }
  for (int i = 0; dialog->kind->row[i].key != NULL; i++) {
    const char *text = choice_text(dialog, i);
    if (dialog->choice[i] == widget) {
      dialog->said[i] = text != NULL && *text != '\0';
    }
  }
  enum { TYPING = 300 };
  sb_later_set(&dialog->later, dialog->dialog, TYPING, on_later, dialog);
}

static void on_as_found(GtkWidget *button, Dialog *dialog) {
  memset(dialog->said, 0, sizeof dialog->said);
  for (int i = 0; dialog->kind->row[i].key != NULL; i++) {
    set_choice(dialog, i, "");
  }
  read_file(dialog);
}

// Measured loops ---------------------------------------------------------------------------------

static const Row measured_rows[] = {
    {"separator", N_("Separator"), "comma|semicolon|tab|blank"},
    {"decimal", N_("Decimal mark"), "point|comma"},
    {"encoding", N_("Encoding"), "utf-8|latin-1|utf-16le|utf-16be|shift-jis"},
    {"columns", N_("Columns"), NULL},
    {"units", N_("Units"), NULL},
    {"speed", N_("Speed, of the time alone"), NULL},
    {"direction", N_("Turned round"), "as-is|force|displacement|both"},
    {"zero", N_("At rest, without load"), NULL},
    {"compliance", N_("Compliance"), NULL},
    {"cycle", N_("Cycle"), NULL},
    {0},
};

G_STATIC_ASSERT(G_N_ELEMENTS(measured_rows) <= ROWS + 1);

static void forget_measured(Dialog *dialog) {
  g_clear_pointer(&dialog->comparison, sb_comparison_free);
  g_clear_pointer(&dialog->measured, sb_measured_free);
}

static void start_measured(Dialog *dialog) {
  g_clear_pointer(&dialog->measuring, sb_measure_job_free);
  SbData *data = sb_data_of_file(dialog->path);
  g_autofree char *keys = said_keys(dialog);
  sb_data_set_keys(data, keys);
  dialog->measuring =
      sb_measure_job_start(data, sb_session_drive_speed(dialog->session), on_read, dialog);
}

static char *take_measured(Dialog *dialog) {
  g_autofree char *why = NULL;
  SbMeasured *measured = sb_measure_job_take(dialog->measuring, &why);
  forget_measured(dialog);
  if (measured == NULL) {
    show_problem(dialog, why);
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
  fill(dialog, keys, FALSE);
  return sb_measured_text(measured);
}

static void draw_measured(cairo_t *cr, double width, double height, void *user) {
  Dialog *dialog = user;
  const SbTheme *theme = sb_style_ground(cr, SB_ROLE_PANEL);
  if (dialog->comparison != NULL) {
    SbChartData data = *sb_session_chart(dialog->session);
    data.measured = dialog->comparison;
    data.playing = FALSE;
    sb_hysteresis_draw(cr, (SbRect){0, 0, width, height}, theme, &data, SB_CHART_COMPACT);
  }
}

static bool use_measured(Dialog *dialog) {
  SbData *data = sb_data_of_file(dialog->path);
  g_autofree char *keys = sb_measured_keys(dialog->measured);
  sb_data_set_keys(data, keys);
  sb_session_set_data(dialog->session, data);
  return true;
}

static const Kind measured_kind = {N_("Import measured data"),
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

static const Row scan_rows[] = {
    {"form", N_("Form removed"), "none|plane|quadratic|cylinder"},
    {"outliers", N_("Outliers beyond, deviations"), NULL},
    {"missing", N_("Missing points"), "leave|fill"},
    {"cutoff-short", N_("Shortest wave"), NULL},
    {"cutoff-long", N_("Longest wave"), NULL},
    {"channel", N_("Channel"), NULL},
    {"spacing", N_("Distance of points"), NULL},
    {"unit", N_("Unit of heights"), NULL},
    {"lateral-unit", N_("Unit of lengths"), NULL},
    {0},
};

// Reads a scan or a drawing.
static void start_reading(Dialog *dialog) {
  dialog->surface = NULL;
  dialog->drawn = NULL;
  g_clear_pointer(&dialog->reading, sb_read_job_free);
  g_autofree char *keys = said_keys(dialog);
  dialog->reading = sb_read_job_start(dialog->kind->reader, dialog->path, keys, on_read, dialog);
}

static char *take_scan(Dialog *dialog) {
  const char *why = NULL;
  dialog->surface = sb_read_job_result(dialog->reading, &why);
  if (dialog->surface == NULL) {
    show_problem(dialog, why);
    return NULL;
  }
  const char *reason = NULL;
  g_autofree char *choices = sb_surface_choices_text(dialog->surface);
  g_auto(GStrv) settings = sb_surface_settings(&reason, dialog->surface);
  if (settings == NULL) {
    show_problem(dialog, reason);
    return NULL;
  }
  if (!dialog->said[0]) {
    set_choice(dialog, 0, sb_form_name(dialog->surface->choices->form));
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
  Dialog *dialog = user;
  (void)sb_style_ground(cr, SB_ROLE_PANEL);
  // The page's columns need this width; on less it is drawn smaller.
  const double least = 1150, scale = fmin(width / least, 1);
  if (dialog->surface != NULL) {
    cairo_scale(cr, scale, scale);
    sb_surface_draw(cr, width / scale, height / scale, dialog->surface, sb_style_is_dark());
  }
}

static bool use_scan(Dialog *dialog) {
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

static const Kind scan_kind = {N_("Import a scan"),
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

static const Row drawing_rows[] = {
    {"unit", N_("Unit of a DXF or STL"), NULL},
    {"axis", N_("Direction of the axis"), NULL},
    {"through", N_("A point of the axis"), NULL},
    {"angle", N_("Half-plane of the section"), NULL},
    {"join", N_("Gaps of a DXF closed up to"), NULL},
    {"flip", N_("Canister on the right"), "no|yes"},
    {"shift", N_("Moved along the axis by"), NULL},
    {"density", N_("Density of the parts"), NULL},
    {"housing", N_("Housing: body"), NULL},
    {"stem_centre", N_("Stem centre: body"), NULL},
    {"stem_top", N_("Stem top: body"), NULL},
    {"stem_bottom", N_("Stem bottom: body"), NULL},
    {0},
};

G_STATIC_ASSERT(G_N_ELEMENTS(drawing_rows) <= ROWS + 1);

// The scene with the drawing's parts for a file `path`, and how it differs from the document; NULL
// with the message shown.
static char *drawn_scene(Dialog *dialog, const char *path, char **differences) {
  const SbDocument *document = sb_session_document(dialog->session);
  const SbDrawing *drawn = dialog->drawn;
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) after = NULL;
  char *text = sb_cad_scene(&after, drawn->cad, drawn->part, drawn->settings.density, document,
                            drawn->path, path, issues);
  if (text == NULL) {
    g_autofree char *line = sb_issue_line(issues->pdata[0]);
    show_problem(dialog, line);
    return NULL;
  }
  *differences = sb_cad_differences(document, after);
  return text;
}

static char *take_drawing(Dialog *dialog) {
  const char *why = NULL;
  dialog->drawn = sb_read_job_result(dialog->reading, &why);
  if (dialog->drawn == NULL) {
    show_problem(dialog, why);
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
    if (body >= 0 && !dialog->said[PART_ROW + i]) {
      char number[SB_NUMBER_SIZE];
      set_choice(dialog, PART_ROW + i, sb_number_round(number, body + 1, 3));
    }
  }
  for (guint i = 0; i < cad->warnings->len; i++) {
    g_string_append_printf(text, "%s\n", (const char *)cad->warnings->pdata[i]);
  }
  g_autofree char *differences = NULL;
  g_autofree char *scene = any ? drawn_scene(dialog, "drawn.scene", &differences) : NULL;
  if (!any) {
    gtk_label_set_text(GTK_LABEL(dialog->message),
                       _("Assign the bodies to the parts, by number or name."));
  }
  if (scene != NULL) {
    g_string_append_printf(text, "\n%s",
                           *differences != '\0' ? differences : _("No value in force differs."));
  }
  gtk_label_set_text(GTK_LABEL(dialog->text), text->str);
  return g_string_free(text, scene == NULL);
}

static void draw_drawing(cairo_t *cr, double width, double height, void *user) {
  Dialog *dialog = user;
  const SbTheme *theme = sb_style_ground(cr, SB_ROLE_PANEL);
  if (dialog->drawn != NULL) {
    sb_half_sections_draw(cr, (SbRect){0, 0, width, height}, theme, dialog->drawn->cad,
                          dialog->drawn->part);
  }
}

static bool use_drawing(Dialog *dialog) {
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
      show_problem(dialog, error->message);
    }
    if (written) {
      g_autoptr(GFile) file = g_file_new_for_path(path);
      sb_window_open(SB_WINDOW(parent), file);
    }
  }
  g_object_unref(chooser);
  return written;
}

static const Kind drawing_kind = {N_("Import a drawing"),
                                  N_("Half-sections of the bodies"),
                                  drawing_rows,
                                  start_reading,
                                  &sb_read_drawing,
                                  take_drawing,
                                  draw_drawing,
                                  use_drawing,
                                  1180,
                                  680};

// Life -------------------------------------------------------------------------------------------

static void on_response(GtkDialog *widget, int response, Dialog *dialog) {
  if (response == GTK_RESPONSE_ACCEPT && !dialog->kind->use(dialog)) {
    return;
  }
  gtk_widget_destroy(dialog->dialog);
}

static void on_destroy(GtkWidget *widget, Dialog *dialog) {
  sb_measure_job_free(dialog->measuring);
  forget_measured(dialog);
  sb_read_job_free(dialog->reading);
  g_object_unref(dialog->session);
  g_free(dialog->path);
  g_free(dialog);
}

static GtkWidget *make_choice(Dialog *dialog, const Row *row) {
  GtkWidget *widget;
  if (row->words == NULL) {
    widget = gtk_entry_new();
  } else {
    widget = gtk_combo_box_text_new();
    g_auto(GStrv) words = g_strsplit(row->words, "|", -1);
    for (char **word = words; *word != NULL; word++) {
      gtk_combo_box_text_append(GTK_COMBO_BOX_TEXT(widget), *word, *word);
    }
  }
  g_signal_connect(widget, "changed", G_CALLBACK(on_choice), dialog);
  sb_style_name(widget, _(row->label), NULL);
  return widget;
}

static void add_form(Dialog *dialog, GtkBox *box) {
  GtkGrid *grid = GTK_GRID(gtk_grid_new());
  gtk_grid_set_row_spacing(grid, 6);
  gtk_grid_set_column_spacing(grid, 10);
  int rows = 0;
  for (const Row *row = dialog->kind->row; row->key != NULL; row++, rows++) {
    dialog->choice[rows] = make_choice(dialog, row);
    gtk_widget_set_hexpand(dialog->choice[rows], TRUE);
    gtk_grid_attach(grid, sb_style_label(_(row->label), "sb-row-label", 0), 0, rows, 1, 1);
    gtk_grid_attach(grid, dialog->choice[rows], 1, rows, 1, 1);
  }
  GtkWidget *found = gtk_button_new_with_label(_("As found"));
  gtk_widget_set_tooltip_text(found, _("Resets all choices"));
  g_signal_connect(found, "clicked", G_CALLBACK(on_as_found), dialog);
  gtk_grid_attach(grid, found, 1, rows, 1, 1);
  dialog->text = gtk_label_new(NULL);
  gtk_label_set_xalign(GTK_LABEL(dialog->text), 0);
  gtk_label_set_line_wrap(GTK_LABEL(dialog->text), TRUE);
  gtk_label_set_max_width_chars(GTK_LABEL(dialog->text), 48);
  gtk_label_set_selectable(GTK_LABEL(dialog->text), TRUE);
  sb_style_name(dialog->text, _("Recognised"), NULL);
  gtk_grid_attach(grid, dialog->text, 0, rows + 1, 2, 1);
  gtk_box_pack_start(box, GTK_WIDGET(grid), FALSE, FALSE, 0);
}

static void open_dialog(GtkWindow *parent, SbSession *session, const Kind *kind, const char *path) {
  Dialog *dialog = g_new0(Dialog, 1);
  dialog->kind = kind;
  dialog->session = g_object_ref(session);
  dialog->path = g_canonicalize_filename(path, NULL);
  g_autofree char *name = g_path_get_basename(path);
  g_autofree char *shown = g_filename_display_name(name);
  g_autofree char *title = g_strdup_printf("%s: %s", _(kind->title), shown);
  dialog->dialog = gtk_dialog_new_with_buttons(
      title, parent, GTK_DIALOG_MODAL | GTK_DIALOG_DESTROY_WITH_PARENT, _("_Cancel"),
      GTK_RESPONSE_CANCEL, _("_Import"), GTK_RESPONSE_ACCEPT, NULL);
  gtk_dialog_set_default_response(GTK_DIALOG(dialog->dialog), GTK_RESPONSE_ACCEPT);
  gtk_window_set_default_size(GTK_WINDOW(dialog->dialog), kind->width, kind->height);
  g_signal_connect(dialog->dialog, "response", G_CALLBACK(on_response), dialog);
  g_signal_connect(dialog->dialog, "destroy", G_CALLBACK(on_destroy), dialog);
  GtkWidget *content = gtk_dialog_get_content_area(GTK_DIALOG(dialog->dialog));
  GtkWidget *columns = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 16);
  gtk_container_set_border_width(GTK_CONTAINER(columns), 12);
  add_form(dialog, GTK_BOX(columns));
  dialog->area = gtk_drawing_area_new();
  sb_style_class(dialog->area, "sb-canvas");
  gtk_widget_set_size_request(dialog->area, 420, 320);
  atk_object_set_role(gtk_widget_get_accessible(dialog->area), ATK_ROLE_CHART);
  dialog->cache = sb_draw_cache_attach(dialog->area, kind->draw, dialog);
  gtk_box_pack_start(GTK_BOX(columns), dialog->area, TRUE, TRUE, 0);
  gtk_box_pack_start(GTK_BOX(content), columns, TRUE, TRUE, 0);
  GtkWidget *foot = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
  gtk_container_set_border_width(GTK_CONTAINER(foot), 12);
  dialog->spinner = gtk_spinner_new();
  dialog->message = sb_style_label(NULL, "sb-warn", 0);
  gtk_label_set_line_wrap(GTK_LABEL(dialog->message), TRUE);
  gtk_box_pack_start(GTK_BOX(foot), dialog->spinner, FALSE, FALSE, 0);
  gtk_box_pack_start(GTK_BOX(foot), dialog->message, TRUE, TRUE, 0);
  gtk_box_pack_start(GTK_BOX(content), foot, FALSE, FALSE, 0);
  sb_style_window(dialog->dialog);
  gtk_widget_show_all(dialog->dialog);
  const SbDocument *document = sb_session_document(session);
  const SbData *own = sb_document_data_count(document) > 0 ? sb_document_data(document, 0) : NULL;
  g_autofree char *its = own != NULL ? g_canonicalize_filename(own->path, NULL) : NULL;
  if (kind == &measured_kind && g_strcmp0(its, dialog->path) == 0) {
    g_autoptr(GString) keys = g_string_new(NULL);
    for (int key = 0; key < SB_DATA_KEY_COUNT; key++) {
      if (own->text[key] != NULL) {
        g_string_append_printf(keys, "%s = %s\n", sb_data_key_name((SbDataKey)key), own->text[key]);
      }
    }
    fill(dialog, keys->str, TRUE);
  }
  read_file(dialog);
}

static void import(GtkWindow *parent, SbSession *session, const Kind *kind, const char *path) {
  if (path != NULL) {
    open_dialog(parent, session, kind, path);
    return;
  }
  GtkFileChooserNative *chooser = gtk_file_chooser_native_new(
      _(kind->title), parent, GTK_FILE_CHOOSER_ACTION_OPEN, _("_Open"), _("_Cancel"));
  if (gtk_native_dialog_run(GTK_NATIVE_DIALOG(chooser)) == GTK_RESPONSE_ACCEPT) {
    g_autofree char *file = gtk_file_chooser_get_filename(GTK_FILE_CHOOSER(chooser));
    open_dialog(parent, session, kind, file);
  }
  g_object_unref(chooser);
}

void sb_import_measured(GtkWindow *parent, SbSession *session, const char *path) {
  import(parent, session, &measured_kind, path);
}

void sb_import_scan(GtkWindow *parent, SbSession *session, const char *path) {
  import(parent, session, &scan_kind, path);
}

void sb_import_drawing(GtkWindow *parent, SbSession *session, const char *path) {
  import(parent, session, &drawing_kind, path);
}
