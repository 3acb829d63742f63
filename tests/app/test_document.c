// Documents: shipped files hold what the catalogue says, edits undo, saving changes nothing else.
#include "app/base/output.h"
#include "app/base/unit.h"
#include "app/export/still.h"
#include "tests/app/document_fixture.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

// The shipped valve gives every physical key that the thesis has or leaves to be inferred, with the
// catalogue's default, exactly, and none that follows a set of models, a fluid, a rubber or another
// size; sizes are those of its kind of valve.
static bool follows(SbParamId id) {
  for (int i = 0; i < SB_KEEPS_COUNT; i++) {
    SbParamId kept, giver;
    double sign;
    const bool piston = sb_params_keeps(&kept, &giver, &sign, i, SB_VALVE_PISTON);
    if (kept == id) {
      return piston;
    }
  }
  SbParamDefault of;
  int choice, kinds = 0;
  bool others = false;
  for (int i = 0; sb_params_brought(&of, &choice, id, i); i++) {
    kinds += of.giver == SB_P_VALVE_KIND;
    others = others || of.giver != SB_P_VALVE_KIND;
  }
  return kinds > 0 && !others ? sb_param_of_rubber(id) : sb_param_follows(id);
}

static void test_piston(void) {
  char *path = document_asset("valves/piston.valve");
  SbDocument *document = document_load(path);
  g_assert_cmpint(sb_document_kind(document), ==, SB_DOCUMENT_VALVE);
  g_assert_cmpstr(sb_document_title(document), ==, "Piston valve of the thesis");
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParam *param = sb_param((SbParamId)i);
    bool physical = !g_str_has_prefix(param->key, "models.") &&
                    !g_str_has_prefix(param->key, "output.") &&
                    !g_str_has_prefix(param->key, "rig.") &&
                    !g_str_has_prefix(param->key, "study.") && param->parent < 0;
    bool given = sb_document_gives(document, (SbParamId)i);
    if (param->parent < 0 && follows((SbParamId)i)) {
      g_assert_false(given);
    } else if (physical && strcmp(param->tag, "ours") != 0 && !given) {
      g_error("piston.valve lacks %s", param->key);
    }
    if (physical && given) {
      g_assert_cmpfloat(sb_document_value(document, (SbParamId)i), ==, param->fallback);
    }
  }
  sb_document_free(document);
  g_free(path);
}

// Every shipped scene is sound and stands on its valve.
static void test_scenes(void) {
  char *folder = document_asset("scenes");
  GDir *dir = g_dir_open(folder, 0, NULL);
  g_assert_nonnull(dir);
  const char *name;
  int count = 0;
  while ((name = g_dir_read_name(dir)) != NULL) {
    char *path = g_build_filename(folder, name, NULL);
    SbDocument *document = document_load(path);
    g_assert_cmpint(sb_document_kind(document), ==, SB_DOCUMENT_SCENE);
    g_assert_nonnull(sb_document_valve_path(document));
    count++;
    sb_document_free(document);
    g_free(path);
  }
  g_assert_cmpint(count, >=, 2);
  g_dir_close(dir);
  g_free(folder);
}

static void test_layers(void) {
  char *folder = document_folder();
  char *valve = g_build_filename(folder, "a.valve", NULL);
  char *scene = g_build_filename(folder, "b.scene", NULL);
  const char *valve_text = "[sealbench]\nformat=1\nkind=valve\n[seal]\nmodulus = 3 MPa\n"
                           "[seal.outer]\nmodulus = 4 MPa\n";
  const char *scene_text = "[sealbench]\nformat=1\nkind=scene\nvalve=a.valve\n[seal]\n"
                           "modulus = 5 MPa\n[output]\nviews = section;profiles;\nframes = 7\n";
  g_assert_true(g_file_set_contents(valve, valve_text, -1, NULL));
  g_assert_true(g_file_set_contents(scene, scene_text, -1, NULL));
  SbDocument *document = document_load(scene);
  g_assert_cmpfloat(sb_document_value(document, SB_P_SEAL_MODULUS), ==, 5e6);
  g_assert_cmpfloat(sb_document_value(document, SB_P_SEAL_OUTER_MODULUS), ==, 4e6);
  g_assert_cmpfloat(sb_document_value(document, SB_P_SEAL_INNER_MODULUS), ==, 5e6);
  g_assert_cmpfloat(sb_document_value(document, SB_P_OUTPUT_VIEWS), ==,
                    SB_VIEW_SECTION | SB_VIEW_PROFILES);
  g_assert_cmpfloat(sb_document_value(document, SB_P_OUTPUT_FRAMES), ==, 7);
  g_assert_false(sb_document_gives(document, SB_P_SEAL_OUTER_MODULUS));
  SbParams params = sb_document_params(document);
  g_assert_true(params.given[SB_P_SEAL_OUTER_MODULUS]);

  // The hash follows values, not how they are written.
  char *before = sb_document_sha256(document);
  g_assert_true(sb_document_set(document, SB_P_SEAL_MODULUS, "5000 kPa", NULL));
  char *same = sb_document_sha256(document);
  g_assert_true(sb_document_set(document, SB_P_SEAL_MODULUS, "5.1 MPa", NULL));
  char *after = sb_document_sha256(document);
  g_assert_cmpstr(before, ==, same);
  g_assert_cmpstr(before, !=, after);
  g_assert_cmpuint(strlen(before), ==, 64);
  g_free(before);
  g_free(same);
  g_free(after);

  // A text that stands alone has the same values.
  char *flat = sb_document_to_flat_text(document);
  GPtrArray *issues = sb_issues_new();
  SbDocument *copy = sb_document_parse(flat, strlen(flat), "flat", NULL, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  char *one = sb_document_sha256(document);
  char *two = sb_document_sha256(copy);
  g_assert_cmpstr(one, ==, two);
  g_free(one);
  g_free(two);
  g_free(flat);
  g_ptr_array_unref(issues);
  sb_document_free(copy);
  sb_document_free(document);
  g_free(valve);
  g_free(scene);
  document_remove_folder(folder);
}

static void test_undo(void) {
  SbDocument *document = sb_document_new();
  SbParamId d = SB_P_SEAL_SECTION_DIAMETER;
  g_assert_false(sb_document_is_modified(document));
  g_assert_cmpint(sb_document_undo(document), ==, -1);
  g_assert_true(sb_document_set(document, d, "1.62mm", NULL));
  g_assert_true(sb_document_set(document, d, "1.63mm", NULL));
  g_assert_true(sb_document_set(document, SB_P_FLUID_VISCOSITY, "0.209 mPa.s", NULL));
  g_assert_true(sb_document_differs(document, d));
  unsigned serial = sb_document_serial(document);
  g_assert_cmpint(sb_document_undo(document), ==, SB_P_FLUID_VISCOSITY);
  g_assert_cmpint(sb_document_undo(document), ==, d);
  g_assert_cmpfloat(sb_document_value(document, d), ==, 1.62e-3);
  g_assert_cmpuint(sb_document_serial(document), !=, serial);
  g_assert_cmpint(sb_document_redo(document), ==, d);
  g_assert_cmpfloat(sb_document_value(document, d), ==, 1.63e-3);
  // A new edit forgets what could be redone.
  sb_document_unset(document, d);
  g_assert_cmpfloat(sb_document_value(document, d), ==, 1.61e-3);
  g_assert_false(sb_document_can_redo(document));
  g_assert_false(sb_document_is_modified(document));
  g_assert_cmpint(sb_document_undo(document), ==, d);
  g_assert_cmpfloat(sb_document_value(document, d), ==, 1.63e-3);

  // A drag is one step; the same value is none.
  for (int i = 0; i < 10; i++) {
    g_assert_true(sb_document_set_value(document, d, (1.64 + 0.01 * i) * 1e-3, true, NULL));
  }
  g_assert_true(sb_document_set_value(document, d, sb_document_value(document, d), true, NULL));
  g_assert_cmpint(sb_document_undo(document), ==, d);
  g_assert_cmpfloat(sb_document_value(document, d), ==, 1.63e-3);

  // A refused edit changes nothing and names the range.
  GError *error = NULL;
  g_assert_false(sb_document_set(document, d, "30 mm", &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_RANGE);
  g_assert_cmpstr(error->message, ==, "30 mm is out of range (allowed 0.2 to 20 mm)");
  g_clear_error(&error);
  g_assert_false(sb_document_set_value(document, d, NAN, false, &error));
  g_clear_error(&error);
  g_assert_cmpfloat(sb_document_value(document, d), ==, 1.63e-3);
  sb_document_free(document);
}

static void test_save(void) {
  char *folder = document_folder();
  char *path = g_build_filename(folder, "a.valve", NULL);
  const char *text = "# A comment at the top\n[sealbench]\nformat = 1\nkind = valve\n\n"
                     "[seal]\n# why 1610\nsection_diameter = 1610 um\n  modulus=2.5MPa\n\n"
                     "# about the gland\n[gland]\nradial_space = 1.36 mm";
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
  SbDocument *document = document_load(path);

  // Nothing changed: the same bytes (and a final line end).
  char *out = sb_document_to_text(document, NULL);
  char *expected = g_strconcat(text, "\n", NULL);
  g_assert_cmpstr(out, ==, expected);
  g_free(out);
  g_free(expected);

  // Changed, new in a group, new group, removed.
  g_assert_true(sb_document_set(document, SB_P_GLAND_RADIAL_SPACE, "1.37 mm", NULL));
  g_assert_true(sb_document_set(document, SB_P_SEAL_POISSON_RATIO, "0.48", NULL));
  g_assert_true(sb_document_set(document, SB_P_SEAL_INNER_DIAMETER, "2.86 mm", NULL));
  g_assert_true(sb_document_set(document, SB_P_SEAL_OUTER_MODULUS, "2.6 MPa", NULL));
  g_assert_true(sb_document_set(document, SB_P_SEAL_OUTER_POISSON_RATIO, "0.47", NULL));
  sb_document_unset(document, SB_P_SEAL_MODULUS);
  GError *error = NULL;
  g_assert_true(sb_document_save(document, path, &error));
  g_assert_no_error(error);
  g_assert_false(sb_document_is_modified(document));
  g_assert_true(g_file_get_contents(path, &out, NULL, NULL));
  g_assert_cmpstr(out, ==,
                  "# A comment at the top\n[sealbench]\nformat = 1\nkind = valve\n\n"
                  "[seal]\n# why 1610\nsection_diameter = 1610 um\n"
                  "inner_diameter = 2.86 mm\npoisson_ratio = 0.48\n\n"
                  "# about the gland\n[gland]\nradial_space = 1.37 mm\n\n"
                  "[seal.outer]\nmodulus = 2.6 MPa\npoisson_ratio = 0.47\n");
  g_free(out);

  // GLib reads it as a key file.
  GKeyFile *keys = g_key_file_new();
  g_assert_true(g_key_file_load_from_file(keys, path, G_KEY_FILE_KEEP_COMMENTS, &error));
  g_assert_no_error(error);
  char *value = g_key_file_get_string(keys, "seal.outer", "modulus", NULL);
  g_assert_cmpstr(value, ==, "2.6 MPa");
  g_free(value);
  g_key_file_unref(keys);

  // Read again: the same values; a second edit lands in the new text.
  SbDocument *again = document_load(path);
  char *one = sb_document_sha256(document);
  char *two = sb_document_sha256(again);
  g_assert_cmpstr(one, ==, two);
  g_free(one);
  g_free(two);
  g_assert_true(sb_document_set(document, SB_P_SEAL_OUTER_MODULUS, "2.7 MPa", NULL));
  g_assert_true(sb_document_save(document, path, &error));
  sb_document_free(again);
  again = document_load(path);
  g_assert_cmpfloat(sb_document_value(again, SB_P_SEAL_OUTER_MODULUS), ==, 2.7e6);
  sb_document_free(again);

  // Undo goes beyond the save and then differs from the file.
  g_assert_cmpint(sb_document_undo(document), ==, SB_P_SEAL_OUTER_MODULUS);
  g_assert_true(sb_document_is_modified(document));

  // Not writable: an error, the old file stays, no other file appears.
  char *bad = g_build_filename(folder, "no", "such", "x.valve", NULL);
  g_assert_false(sb_document_save(document, bad, &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_IO);
  g_clear_error(&error);
  g_free(bad);
  g_assert_false(sb_document_save(document, folder, &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_IO);
  g_clear_error(&error);
  g_assert_cmpstr(sb_document_path(document), ==, path);
  g_assert_cmpint(g_unlink(path), ==, 0);
  sb_document_free(document);
  g_free(path);
  document_remove_folder(folder); // fails if a temporary file was left
}

// A scene saved into another folder still finds its valve.
static void test_moved_scene(void) {
  char *folder = document_folder();
  char *target = g_build_filename(folder, "moved.scene", NULL);
  char *path = document_asset("scenes/thesis-cycle.scene");
  SbDocument *document = document_load(path);
  GError *error = NULL;
  g_assert_true(sb_document_save(document, target, &error));
  g_assert_no_error(error);
  SbDocument *moved = document_load(target);
  char *one = sb_document_sha256(document);
  char *two = sb_document_sha256(moved);
  g_assert_cmpstr(one, ==, two);
  g_free(one);
  g_free(two);
  sb_document_free(moved);
  sb_document_free(document);
  g_free(path);
  g_free(target);
  document_remove_folder(folder);
}

static void draw_nothing(cairo_t *cr, double width, double height, void *user) {}

// A picture gives back the scene it was drawn from; another picture gives one clear line.
static void test_picture(void) {
  char *folder = document_folder();
  char *path = g_build_filename(folder, "p.png", NULL);
  char *source = document_asset("scenes/thesis-cycle.scene");
  SbDocument *document = document_load(source);
  char *text = sb_document_to_flat_text(document);
  SbStill still = {.width = 32, .height = 32, .scene = text, .draw = draw_nothing};
  GError *error = NULL;
  g_assert_true(sb_still_write(&still, path, &error));
  g_assert_no_error(error);
  SbDocument *back = document_load(path);
  char *one = sb_document_sha256(document);
  char *two = sb_document_sha256(back);
  g_assert_cmpstr(one, ==, two);
  g_assert_cmpstr(sb_document_title(back), ==, sb_document_title(document));
  g_assert_null(sb_document_path(back));
  g_free(one);
  g_free(two);
  g_free(text);
  sb_document_free(back);
  sb_document_free(document);

  static const char *const bad[] = {NULL, "not a picture", "\x89PNG\r\n\x1a\n"};
  for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
    still.scene = NULL;
    if (bad[i] == NULL) {
      g_assert_true(sb_still_write(&still, path, &error));
    } else {
      g_assert_true(g_file_set_contents(path, bad[i], -1, NULL));
    }
    GPtrArray *issues = sb_issues_new();
    g_assert_null(sb_document_load(path, issues));
    g_assert_cmpuint(issues->len, ==, 1);
    g_ptr_array_unref(issues);
  }
  g_unlink(path);
  g_free(path);
  g_free(source);
  document_remove_folder(folder);
}

// Saving through a symbolic link keeps the link, and the file's mode and other names.
static void test_links(void) {
  char *folder = document_folder();
  char *path = g_build_filename(folder, "real.valve", NULL);
  char *link_path = g_build_filename(folder, "link.valve", NULL);
  SbDocument *document = sb_document_new();
  GError *error = NULL;
  g_assert_true(sb_document_save(document, path, &error));
  g_assert_no_error(error);
  g_assert_cmpint(chmod(path, 0660), ==, 0);
  g_assert_cmpint(symlink("real.valve", link_path), ==, 0);
  g_assert_true(sb_document_set(document, SB_P_BORE_DIAMETER, "6.1 mm", &error));
  g_assert_true(sb_document_save(document, link_path, &error));
  g_assert_no_error(error);
  g_assert_true(g_file_test(link_path, G_FILE_TEST_IS_SYMLINK));
  char *text = NULL;
  g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
  g_assert_nonnull(strstr(text, "diameter = 6.1 mm"));
  struct stat info;
  g_assert_cmpint(stat(path, &info), ==, 0);
  g_assert_cmpint(info.st_mode & 07777, ==, 0660);
  g_free(text);
  sb_document_free(document);
  g_free(link_path);
  g_free(path);
  document_remove_folder(folder);
}

// A write-protected file is not replaced, though its folder would allow it. Root may write
// anything: a child that is not root tries.
static void test_protected(void) {
  char *folder = document_folder();
  char *path = g_build_filename(folder, "kept.valve", NULL);
  g_assert_true(g_file_set_contents(path, "kept", -1, NULL));
  g_assert_cmpint(chmod(path, 0444), ==, 0);
  g_assert_cmpint(chmod(folder, 0777), ==, 0);
  pid_t child = fork();
  if (child == 0) {
    const unsigned nobody = 65534;
    if (geteuid() == 0 && (setgid(nobody) != 0 || setuid(nobody) != 0)) {
      _exit(77);
    }
    GError *error = NULL;
    bool written = sb_output_write(path, "new", 3, &error);
    _exit(!written && g_error_matches(error, SB_APP_ERROR, SB_APP_ERROR_IO) ? 0 : 1);
  }
  int status = 0;
  g_assert_true(child > 0 && waitpid(child, &status, 0) == child);
  g_assert_true(WIFEXITED(status));
  if (WEXITSTATUS(status) == 77) {
    g_test_skip("root cannot become another user here");
  } else {
    g_assert_cmpint(WEXITSTATUS(status), ==, 0);
    char *text = NULL;
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    g_assert_cmpstr(text, ==, "kept");
    g_free(text);
  }
  g_free(path);
  document_remove_folder(folder);
}

// A scene with pins, bookmarks and notes: kept over saving, refused where they are no such.
static void test_project(void) {
  static const char text[] =
      "[sealbench]\nformat = 1\nkind = project\nvalve = piston.valve\n"
      "# a comment\n[pins]\nwide = gland.radial_space = 1.38 mm\n"
      "[bookmarks]\nfirst slip = 0.8 s\n[notes]\nwide = one\\ntwo \\\\ three\n";
  g_autofree char *folder = g_build_filename(g_getenv("SEALBENCH_ASSETS"), "valves", NULL);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbDocument *document = sb_document_parse(text, strlen(text), "x.project", folder, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  g_assert_cmpint(sb_document_kind(document), ==, SB_DOCUMENT_SCENE);
  g_assert_true(sb_document_is_project(document));
  g_assert_cmpuint(sb_document_pin_count(document), ==, 1);
  g_assert_cmpfloat(sb_document_bookmark(document, 0), ==, 0.8);
  g_assert_cmpstr(sb_document_remark_text(document, SB_REMARK_NOTE, 0), ==, "one\ntwo \\ three");
  g_autoptr(SbModel) model = NULL;
  g_assert_true(sb_document_compile_pin(document, 0, &model, issues));
  g_assert_cmpfloat(sb_model_value(model, SB_P_GLAND_RADIAL_SPACE), ==, 1.38e-3);
  g_autofree char *same = sb_document_to_text(document, NULL);
  g_assert_cmpstr(same, ==, text);
  g_assert_false(sb_document_is_modified(document));
  // A group of data without its file is an issue of a document that is shown.
  g_autofree char *bare = g_strconcat(text, "[data]\nseparator = comma\n", NULL);
  g_autoptr(GPtrArray) missing = sb_issues_new();
  g_autoptr(SbDocument) shown = sb_document_parse(bare, strlen(bare), "bare", folder, missing);
  g_assert_cmpuint(missing->len, ==, 1);
  g_assert_false(sb_document_is_modified(shown));
  g_autofree char *written = sb_document_to_text(shown, NULL);
  g_assert_cmpstr(written, ==, bare);
  // Edits, and back through the text.
  GError *error = NULL;
  g_assert_false(sb_document_put_remark(document, SB_REMARK_BOOKMARK, "x", "soon", &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
  g_clear_error(&error);
  g_assert_false(sb_document_put_remark(document, SB_REMARK_NOTE, "a = b", "text", &error));
  g_clear_error(&error);
  g_assert_false(sb_document_is_modified(document));
  g_assert_true(sb_document_put_remark(document, SB_REMARK_NOTE, "all", "a\nb", NULL));
  g_assert_true(sb_document_put_remark(document, SB_REMARK_BOOKMARK, "first slip", NULL, NULL));
  g_assert_true(sb_document_is_modified(document));
  g_autofree char *changed = sb_document_to_text(document, NULL);
  g_assert_nonnull(strstr(changed, "# a comment"));
  g_assert_null(strstr(changed, "first slip"));
  SbDocument *again = sb_document_parse(changed, strlen(changed), "x.project", folder, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  g_assert_cmpstr(sb_document_remark_text(again, SB_REMARK_NOTE, 1), ==, "a\nb");
  sb_document_free(again);
  sb_document_free(document);
  // A line that is not a design stays in the file when another design is saved, with its number.
  static const char broken[] = "[sealbench]\nformat = 1\nkind = project\nvalve = piston.valve\n"
                               "[pins]\npin 1 = gland.radial_spaec = 1.38 mm\n";
  g_autoptr(GPtrArray) wrong = sb_issues_new();
  document = sb_document_parse(broken, strlen(broken), "x.project", folder, wrong);
  g_assert_cmpuint(wrong->len, ==, 1);
  g_assert_nonnull(document);
  const SbOverride wide = {SB_P_GLAND_RADIAL_SPACE, 1.39e-3};
  g_assert_true(sb_document_add_pin(document, &wide, 1));
  g_autofree char *saved = sb_document_to_text(document, NULL);
  g_assert_nonnull(strstr(saved, "pin 1 = gland.radial_spaec = 1.38 mm\n"));
  g_assert_nonnull(strstr(saved, "pin 2 = gland.radial_space = 1.39 mm\n"));
  sb_document_free(document);
  // What is no such.
  static const struct {
    const char *lines, *word;
  } bad[] = {{"[bookmarks]\nx = -1 s\n", "at least 0 s"},
             {"[bookmarks]\nx = 3\n", "unit"},
             {"[notes]\n a] = b\n", "name"}};
  for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
    g_autoptr(GPtrArray) told = sb_issues_new();
    g_autofree char *whole = g_strconcat("[sealbench]\nformat = 1\nkind = project\n"
                                         "valve = piston.valve\n",
                                         bad[i].lines, NULL);
    document = sb_document_parse(whole, strlen(whole), "x.project", folder, told);
    g_assert_cmpuint(told->len, >, 0);
    g_autofree char *line = sb_issue_line(told->pdata[0]);
    if (strstr(line, bad[i].word) == NULL) {
      g_error("case %zu: %s", i, line);
    }
    sb_document_free(document);
  }
}

// An edit leaves what a pin's line, a note or a group of data states as it is, also in a file with
// errors.
static void test_lines_stay(void) {
  static const char pins[] = "[pins]\np1 =  seal.modulus = 55 ShoreA\n";
  static const char bad[] = "[models]\nasperities = none\n";
  static const char others[] = "[notes]\n a] = b\n[data x]\nseparator = comma\n";
  g_autofree char *folder = g_build_filename(g_getenv("SEALBENCH_ASSETS"), "valves", NULL);
  for (int faulty = 0; faulty < 2; faulty++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autofree char *text =
        g_strconcat("[sealbench]\nformat = 1\nkind = scene\nvalve = piston.valve\n", pins,
                    faulty ? bad : "", faulty ? others : "", NULL);
    g_autoptr(SbDocument) document =
        sb_document_parse(text, strlen(text), "x.scene", folder, issues);
    g_assert_cmpuint(issues->len > 0, ==, faulty);
    g_assert_true(sb_document_set(document, SB_P_DRIVE_SPEED, "21 mm/min", NULL));
    g_assert_true(sb_document_put_remark(document, SB_REMARK_NOTE, "all", "text", NULL));
    g_autofree char *saved = sb_document_to_text(document, NULL);
    g_assert_nonnull(strstr(saved, "seal.modulus = 55 ShoreA"));
    g_assert_cmpint(strstr(saved, "; drive.speed = ") == NULL, ==, faulty);
    g_assert_cmpint(strstr(saved, "\n a] = b\n") != NULL, ==, faulty);
    // The line of a pin that the edit does not change.
    g_assert_cmpint(sb_document_undo(document), ==, SB_P_DRIVE_SPEED);
    g_autofree char *same = sb_document_to_text(document, NULL);
    g_assert_nonnull(strstr(same, pins));
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/document/project", test_project);
  g_test_add_func("/document/lines-stay", test_lines_stay);
  g_test_add_func("/document/piston", test_piston);
  g_test_add_func("/document/scenes", test_scenes);
  g_test_add_func("/document/layers", test_layers);
  g_test_add_func("/document/undo", test_undo);
  g_test_add_func("/document/save", test_save);
  g_test_add_func("/document/moved-scene", test_moved_scene);
  g_test_add_func("/document/picture", test_picture);
  g_test_add_func("/document/links", test_links);
  g_test_add_func("/document/protected", test_protected);
  return g_test_run();
}
