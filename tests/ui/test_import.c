// The import dialog offers the plausible values of a file that can be read in several ways.
#include "app/data/measured.h"
#include "tests/ui/widgets.h"
#include "ui/window/import_dialog.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

// Lets the main loop go on for a while.
static void turn(int milliseconds) {
  gint64 end = g_get_monotonic_time() + milliseconds * 1000;
  while (g_get_monotonic_time() < end) {
    if (!g_main_context_iteration(NULL, FALSE)) {
      g_usleep(1000);
    }
  }
}

typedef struct {
  const char *part;
  const char *found; // text of the label
} Text;

static void find_text(GtkWidget *widget, gpointer data) {
  Text *text = data;
  if (GTK_IS_LABEL(widget)) {
    const char *own = gtk_label_get_text(GTK_LABEL(widget));
    text->found = strstr(own, text->part) != NULL ? own : text->found;
  } else if (GTK_IS_CONTAINER(widget)) {
    gtk_container_forall(GTK_CONTAINER(widget), find_text, data);
  }
}

// Waits for a label that contains `part`; none contains an option of the command line.
static void expect_text(GtkDialog *dialog, const char *part) {
  Text text = {part, NULL}, option = {"--", NULL};
  for (int i = 0; i < 500 && text.found == NULL; i++) {
    turn(20);
    find_text(GTK_WIDGET(dialog), &text);
  }
  if (text.found == NULL) {
    g_error("no label contains \"%s\"", part);
  }
  find_text(GTK_WIDGET(dialog), &option);
  g_assert_cmpstr(option.found, ==, NULL);
}

static void press(GtkDialog *dialog, const char *name) {
  gtk_button_clicked(GTK_BUTTON(named(dialog, name, GTK_TYPE_BUTTON)));
}

static const char *entry_text(GtkDialog *dialog, const char *name) {
  return gtk_entry_get_text(GTK_ENTRY(named(dialog, name, GTK_TYPE_ENTRY)));
}

// An STL, which states no unit, of a prism of 24 sides about z: radius 0.3, length 1.2.
static char *prism(void) {
  GString *out = g_string_new("solid ring\n");
  enum { SIDES = 24 };
  for (int k = 0; k < SIDES; k++) {
    const double a = 2 * G_PI * k / SIDES, b = 2 * G_PI * (k + 1) / SIDES;
    const double p[2][2] = {{0.3 * cos(a), 0.3 * sin(a)}, {0.3 * cos(b), 0.3 * sin(b)}};
    const double facet[4][9] = {
        {0, 0, 0, p[1][0], p[1][1], 0, p[0][0], p[0][1], 0},
        {0, 0, 1.2, p[0][0], p[0][1], 1.2, p[1][0], p[1][1], 1.2},
        {p[0][0], p[0][1], 0, p[1][0], p[1][1], 0, p[1][0], p[1][1], 1.2},
        {p[0][0], p[0][1], 0, p[1][0], p[1][1], 1.2, p[0][0], p[0][1], 1.2}};
    for (int f = 0; f < 4; f++) {
      g_string_append(out, "facet normal 0 0 0\nouter loop\n");
      for (int v = 0; v < 9; v += 3) {
        char x[3][G_ASCII_DTOSTR_BUF_SIZE];
        for (int i = 0; i < 3; i++) {
          g_ascii_formatd(x[i], sizeof x[i], "%.9g", facet[f][v + i]);
        }
        g_string_append_printf(out, "vertex %s %s %s\n", x[0], x[1], x[2]);
      }
      g_string_append(out, "endloop\nendfacet\n");
    }
  }
  g_string_append(out, "endsolid ring\n");
  return g_string_free(out, FALSE);
}

// The loop of the shipped series as a table, its displacement twice, its force without a unit;
// `decimal`: moved so that each number has three digits behind a comma and none is below 1.
static char *ambiguous_table(bool decimal) {
  g_autofree char *path = g_strdup_printf("%s/series/bench.csv", g_getenv("SEALBENCH_ASSETS"));
  SbData *data = sb_data_of_file(path);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbMeasured) m = sb_measured_read(data, 0, NULL, 0, issues);
  g_assert_nonnull(m);
  sb_data_free(data);
  GString *out = g_string_new(decimal ? "Weg [mm];Kraft [N]\n" : "Weg [mm];Stroke [mm];Kraft\n");
  for (size_t i = 0; i < m->count; i++) {
    char place[G_ASCII_DTOSTR_BUF_SIZE], force[G_ASCII_DTOSTR_BUF_SIZE];
    const char *format = decimal ? "%.3f" : "%.4f";
    g_ascii_formatd(place, sizeof place, format, 1e3 * m->displacement[i] + 2);
    g_ascii_formatd(force, sizeof force, format, m->force[i] + 100);
    if (decimal) {
      *strchr(place, '.') = *strchr(force, '.') = ',';
      g_string_append_printf(out, "%s;%s\n", place, force);
    } else {
      g_string_append_printf(out, "%s;%s;%s\n", place, place, force);
    }
  }
  return g_string_free(out, FALSE);
}

// A file of this test, opened by `import`.
static GtkDialog *import_text(void (*import)(GtkWindow *, SbSession *, const char *),
                              SbSession *session, GtkWidget *parent, const char *name, char *text) {
  g_autofree char *path = g_build_filename(g_getenv("XDG_DATA_HOME"), name, NULL);
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
  g_free(text);
  import(GTK_WINDOW(parent), session, path);
  return open_dialog();
}

// A file that can be read in several ways is refused with a button for each of them. A button sets
// its row of the form, which is the only state of the choice.
static void test_import_choices(void) {
  g_autoptr(SbSession) session = sb_session_new();
  GtkWidget *parent = gtk_window_new(GTK_WINDOW_TOPLEVEL);
  static const char unit[] = "Unit of a DXF or STL";
  GtkDialog *dialog = import_text(sb_import_drawing, session, parent, "ring.stl", prism());
  expect_text(dialog, "12 mm in cm, 30.5 mm in inch: choose \"Unit of a DXF or STL\"");
  (void)named(dialog, "Unit of a DXF or STL: mm", GTK_TYPE_BUTTON);
  press(dialog, "Unit of a DXF or STL: cm");
  expect_text(dialog, "1 ring: 335.");
  expect_text(dialog, "Assign the bodies");
  g_assert_cmpstr(entry_text(dialog, unit), ==, "cm");
  Wanted gone = {"Unit of a DXF or STL: mm", GTK_TYPE_BUTTON, NULL};
  find_wanted(GTK_WIDGET(dialog), &gone);
  g_assert_null(gone.found);
  gtk_entry_set_text(GTK_ENTRY(named(dialog, unit, GTK_TYPE_ENTRY)), "mm");
  expect_text(dialog, "1 ring: 0.335");
  press(dialog, "As found");
  expect_text(dialog, "states no unit");
  gtk_dialog_response(dialog, GTK_RESPONSE_CANCEL);

  dialog = import_text(sb_import_measured, session, parent, "two.csv", ambiguous_table(false));
  expect_text(dialog, "\"Stroke\" may both be the displacement: choose \"Columns\"");
  press(dialog, "Columns: -, displacement, force");
  expect_text(dialog, "\"Kraft\" (force) has no unit: choose \"Units\"");
  press(dialog, "Units: -, mm, N");
  expect_text(dialog, "displacement: column 2 \"Stroke\" in mm (as specified)");
  g_assert_cmpstr(entry_text(dialog, "Columns"), ==, "-, displacement, force");
  g_assert_cmpstr(entry_text(dialog, "Units"), ==, "-, mm, N");
  gtk_dialog_response(dialog, GTK_RESPONSE_CANCEL);

  dialog = import_text(sb_import_measured, session, parent, "mark.csv", ambiguous_table(true));
  expect_text(dialog, ": choose \"Decimal mark\"");
  press(dialog, "Decimal mark: comma");
  expect_text(dialog, "separator semicolon, decimal comma");
  gtk_dialog_response(dialog, GTK_RESPONSE_CANCEL);

  dialog = import_text(sb_import_scan, session, parent, "scan.txt",
                       g_strdup("1 2 3 4\n2 3 1 5\n4 1 2 2\n1 5 3 1\n"));
  expect_text(dialog, "the unit of its heights: choose \"Unit of heights\"");
  press(dialog, "Unit of heights: nm");
  expect_text(dialog, "the distance of its points: choose \"Distance of points\"");
  g_assert_cmpstr(entry_text(dialog, "Unit of heights"), ==, "nm");
  gtk_dialog_response(dialog, GTK_RESPONSE_CANCEL);
  gtk_widget_destroy(parent);
}

int main(int argc, char **argv) {
  g_autofree char *folder = g_dir_make_tmp("sealbench-import-XXXXXX", NULL);
  g_setenv("XDG_CONFIG_HOME", folder, TRUE);
  g_setenv("XDG_DATA_HOME", folder, TRUE);
  g_setenv("XDG_CACHE_HOME", folder, TRUE);
  g_setenv("GTK_RECENT_FILES_ENABLED", "0", TRUE);
  gtk_init(&argc, &argv);
  g_test_init(&argc, &argv, NULL);
  g_log_set_always_fatal(G_LOG_LEVEL_CRITICAL | G_LOG_FATAL_MASK);
  g_test_add_func("/import/choices", test_import_choices);
  SbApplication *application = start_application();
  const int failed = g_test_run();
  g_application_release(G_APPLICATION(application));
  g_object_unref(application);
  return failed;
}
