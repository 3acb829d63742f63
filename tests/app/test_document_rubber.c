// Rubbers and measured data of documents: shipped sheets, edited and own ones, and their sources.
#include "app/base/unit.h"
#include "app/document/rubber_sheet.h"
#include "tests/app/document_fixture.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

static SbDocument *with_rubber(const char *folder, const char *more, GPtrArray *issues) {
  g_autofree char *text = g_strdup_printf("[sealbench]\nformat=1\nkind=valve\n%s", more);
  return sb_document_parse(text, strlen(text), "x.valve", folder, issues);
}

// Every rubber that ships is sound: each of its figures stands where nobody gives another, says
// where it comes from, and what is not of a source is called typical. A given value stays, also in
// the text that stands alone.
static void test_rubbers(void) {
  static const char *const names[] = {"nitrile",    "epdm",        "butyl",
                                      "bromobutyl", "chloroprene", "tpe"};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autofree char *more = g_strdup_printf("[rubber]\nname = %s\ndensity = 999 kg/m3\n", names[i]);
    g_autofree char *beside = document_asset("valves"),
                    *epdm = document_asset("rubbers/epdm.rubber"),
                    *nitrile = document_asset("rubbers/nitrile.rubber");
    g_autoptr(SbDocument) document = with_rubber(beside, more, issues);
    for (guint k = 0; k < issues->len; k++) {
      g_error("%s", sb_issue_line(issues->pdata[k]));
    }
    const SbParams params = sb_document_params(document);
    static const SbParamId ids[] = {SB_P_SEAL_MODULUS, SB_P_SEAL_POISSON_RATIO,
                                    SB_P_RUBBER_GLASS_TEMPERATURE, SB_P_RUBBER_THERMAL_EXPANSION};
    for (size_t k = 0; k < G_N_ELEMENTS(ids); k++) {
      SbParamDefault derived;
      sb_params_default(&derived, &params, ids[k]);
      g_assert_cmpstr(derived.from, ==, "rubber.name");
      g_assert_cmpstr(derived.name, ==, names[i]);
      g_assert_cmpstr(derived.tag, ==,
                      g_str_has_prefix(derived.source, "typical") ? "typical" : "published");
      g_assert_cmpfloat(sb_document_value(document, ids[k]), ==, derived.value);
    }
    g_assert_cmpfloat(sb_document_value(document, SB_P_RUBBER_GLASS_TEMPERATURE), <, 250);
    g_assert_cmpfloat(sb_document_value(document, SB_P_RUBBER_DENSITY), ==, 999);
    // Swell is that of the fluid, where there is a figure.
    const double swell = i == 0 ? 0.17 : 0;
    g_assert_cmpfloat(sb_document_value(document, SB_P_RUBBER_SWELL_MASS), ==, 0);
    g_assert_true(sb_document_set(document, SB_P_FLUID_NAME, "hfa-134a", NULL));
    g_assert_cmpfloat(sb_document_value(document, SB_P_RUBBER_SWELL_MASS), ==, swell);
    g_autofree char *flat = sb_document_to_flat_text(document);
    g_autoptr(SbDocument) copy = sb_document_parse(flat, strlen(flat), "flat", NULL, issues);
    g_autofree char *one = sb_document_sha256(document), *two = sb_document_sha256(copy);
    g_assert_cmpstr(one, ==, two);
    g_assert_cmpuint(issues->len, ==, 0);
    // Another one by --set, which a model of the first does not see.
    SbModel *model = NULL;
    g_assert_true(sb_document_compile(document, &model, issues));
    const double before = sb_model_value(model, SB_P_RUBBER_GLASS_TEMPERATURE);
    g_autofree char *other = g_strconcat("rubber.name=", i == 1 ? nitrile : epdm, NULL);
    g_assert_true(sb_document_set_option(document, other, issues));
    g_assert_cmpfloat(sb_model_value(model, SB_P_RUBBER_GLASS_TEMPERATURE), ==, before);
    g_assert_cmpfloat(sb_document_value(document, SB_P_RUBBER_GLASS_TEMPERATURE), !=, before);
    sb_model_destroy(model);
  }
}

// A source that is too long for messages is refused, not cut.
static void test_rubber_source(void) {
  for (int more = 0; more < 2; more++) {
    g_autofree char *source = g_strnfill((gsize)(SB_SOURCE_MAX - 1 + more), 's');
    g_autofree char *text = g_strdup_printf("[sealbench]\nformat = 1\nkind = rubber\n"
                                            "[rubber]\ndensity = 999 kg/m3\n"
                                            "[source]\nrubber.density = %s\n",
                                            source);
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autofree SbRubberSheet *sheet = g_new(SbRubberSheet, 1);
    g_assert_cmpint(sb_rubber_sheet_parse(sheet, text, strlen(text), "x.rubber", issues), ==,
                    more == 0);
    if (more > 0) {
      g_autofree char *line = sb_issue_line(issues->pdata[0]);
      g_assert_nonnull(strstr(line, "density"));
      g_assert_nonnull(strstr(line, "at most 255 bytes"));
    } else {
      g_assert_cmpstr(sheet->figure[0].source, ==, source);
    }
  }
}

// Measured data are put in, taken back and put in again like a value; what is saved is the file's.
static void test_edited_data(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  char *folder = document_folder();
  g_autofree char *scene = g_build_filename(folder, "a.scene", NULL);
  g_autofree char *valve = document_asset("valves/piston.valve");
  g_autofree char *text = g_strdup_printf(
      "[sealbench]\nformat=1\nkind=scene\nvalve=%s\n[data]\nfile = one.csv\n", valve);
  g_assert_true(g_file_set_contents(scene, text, -1, NULL));
  g_autoptr(SbDocument) document = sb_document_load(scene, issues);
  g_assert_nonnull(document);
  g_assert_false(sb_document_is_modified(document));
  SbData *other = sb_data_copy(sb_document_data(document, 0));
  g_free(other->path);
  other->path = g_build_filename(folder, "two.csv", NULL);
  sb_document_put_data(document, sb_data_copy(sb_document_data(document, 0))); // the same
  g_assert_false(sb_document_can_undo(document));
  sb_document_put_data(document, other);
  g_assert_true(sb_document_is_modified(document));
  sb_document_put_data(document, NULL);
  g_assert_cmpuint(sb_document_data_count(document), ==, 0);
  g_assert_cmpint(sb_document_undo(document), ==, SB_DOCUMENT_MEASURED);
  g_assert_true(g_str_has_suffix(sb_document_data(document, 0)->path, "two.csv"));
  g_assert_cmpint(sb_document_undo(document), ==, SB_DOCUMENT_MEASURED);
  g_assert_true(g_str_has_suffix(sb_document_data(document, 0)->path, "one.csv"));
  g_assert_false(sb_document_is_modified(document));
  g_assert_false(sb_document_can_undo(document));
  g_assert_cmpint(sb_document_redo(document), ==, SB_DOCUMENT_MEASURED);
  g_assert_true(sb_document_save(document, scene, NULL));
  g_assert_false(sb_document_is_modified(document));
  g_assert_cmpint(sb_document_undo(document), ==, SB_DOCUMENT_MEASURED);
  g_assert_true(sb_document_is_modified(document));
  g_autoptr(SbDocument) again = sb_document_load(scene, issues);
  g_assert_true(g_str_has_suffix(sb_document_data(again, 0)->path, "two.csv"));
  g_assert_cmpuint(issues->len, ==, 0);
  document_remove_folder(folder);
}

// The rubber is edited like a value: undone, redone, told to be saved, written, carried along to
// another folder, and named in a case; the valve's comes back where the scene's own goes.
static void test_edited_rubber(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  char *folder = document_folder();
  g_autofree char *valve = g_build_filename(folder, "a.valve", NULL),
                  *scene = g_build_filename(folder, "a.scene", NULL),
                  *sub = g_build_filename(folder, "other", NULL),
                  *moved = g_build_filename(sub, "b.scene", NULL),
                  *own = g_build_filename(folder, "mine.rubber", NULL);
  g_assert_true(g_file_set_contents(
      valve, "[sealbench]\nformat=1\nkind=valve\n[rubber]\nname = epdm\n", -1, NULL));
  g_assert_true(g_file_set_contents(
      scene,
      "[sealbench]\nformat=1\nkind=scene\nvalve = a.valve\n[cases]\nwith = rubber.name=nitrile\n"
      "plain = drive.speed=10 mm/min\n",
      -1, NULL));
  g_assert_true(g_file_set_contents(own,
                                    "[sealbench]\nformat = 1\nkind = rubber\n[seal]\nmodulus = 4 "
                                    "MPa\n[source]\nseal.modulus = own\n",
                                    -1, NULL));
  static const char *const shipped[] = {"epdm", "nitrile", "tpe"};
  for (size_t i = 0; i < G_N_ELEMENTS(shipped); i++) {
    g_autofree char *file = g_strconcat(shipped[i], ".rubber", NULL);
    g_autofree char *path = g_build_filename("rubbers", file, NULL), *from = document_asset(path);
    g_autofree char *to = g_build_filename(folder, file, NULL), *text = NULL;
    g_assert_true(g_file_get_contents(from, &text, NULL, NULL));
    g_assert_true(g_file_set_contents(to, text, -1, NULL));
  }
  g_autoptr(SbDocument) document = sb_document_load(scene, issues);
  g_assert_nonnull(document);
  const double epdm = sb_document_value(document, SB_P_RUBBER_GLASS_TEMPERATURE);
  g_assert_cmpstr(sb_document_rubber(document), ==, "epdm");
  g_assert_false(sb_document_gives_rubber(document));
  g_assert_true(sb_document_set_rubber(document, "nitrile", issues));
  const double nitrile = sb_document_value(document, SB_P_RUBBER_GLASS_TEMPERATURE);
  g_assert_cmpfloat(nitrile, !=, epdm);
  g_assert_true(sb_document_is_modified(document));
  g_assert_cmpint(sb_document_undo(document), ==, SB_DOCUMENT_RUBBER);
  g_assert_cmpfloat(sb_document_value(document, SB_P_RUBBER_GLASS_TEMPERATURE), ==, epdm);
  g_assert_false(sb_document_is_modified(document));
  // A case names its own.
  SbModel *model;
  g_assert_true(sb_document_compile_case(document, 0, &model, issues));
  g_assert_cmpfloat(sb_model_value(model, SB_P_RUBBER_GLASS_TEMPERATURE), ==, nitrile);
  sb_model_destroy(model);
  g_assert_true(sb_document_compile_case(document, 1, &model, issues));
  g_assert_cmpfloat(sb_model_value(model, SB_P_RUBBER_GLASS_TEMPERATURE), ==, epdm);
  sb_model_destroy(model);
  g_assert_cmpint(sb_document_redo(document), ==, SB_DOCUMENT_RUBBER);
  g_assert_cmpstr(sb_document_rubber(document), ==, "nitrile");
  // One that is not there changes nothing.
  g_assert_false(sb_document_set_rubber(document, "none", issues));
  g_assert_cmpstr(sb_document_rubber(document), ==, "nitrile");
  g_ptr_array_set_size(issues, 0);
  g_auto(GStrv) names = sb_document_rubbers(document);
  g_assert_true(g_strv_contains((const char *const *)names, "tpe"));
  // Saved, beside and elsewhere: a file of one's own is found again.
  g_assert_true(sb_document_set_rubber(document, "mine", issues));
  g_assert_true(sb_document_save(document, scene, NULL));
  g_assert_false(sb_document_is_modified(document));
  g_autofree char *text = NULL;
  g_assert_true(g_file_get_contents(scene, &text, NULL, NULL));
  g_assert_nonnull(strstr(text, "[rubber]\nname = mine\n"));
  g_assert_cmpint(g_mkdir(sub, 0700), ==, 0);
  g_assert_true(sb_document_save(document, moved, NULL));
  g_autoptr(SbDocument) again = sb_document_load(moved, issues);
  g_assert_nonnull(again);
  g_assert_cmpuint(issues->len, ==, 1); // the case's rubber was beside the scene
  g_ptr_array_set_size(issues, 0);
  g_assert_cmpfloat(sb_document_value(again, SB_P_SEAL_MODULUS), ==, 4e6);
  // Taken out again it is the valve's.
  g_assert_true(sb_document_set_rubber(again, NULL, issues));
  g_assert_true(sb_document_save(again, moved, NULL));
  g_autofree char *without = NULL;
  g_assert_true(g_file_get_contents(moved, &without, NULL, NULL));
  g_assert_null(strstr(without, "name ="));
  g_assert_cmpstr(sb_document_rubber(again), ==, "epdm");
  g_assert_cmpuint(issues->len, ==, 0);
  g_unlink(moved);
  g_rmdir(sub);
  document_remove_folder(folder);
}

// A rubber of one's own beside the valve; what is wrong with it is told with its file and line.
static void test_own_rubber(void) {
#define RUBBER "[sealbench]\nformat = 1\nkind = rubber\n"
  static const struct {
    const char *text, *says; // NULL: it is sound
  } rows[] = {
      {RUBBER "[seal]\nmodulus = 4 MPa\n[permeability]\nhfa-134a = 9 barrer\ncustom = 2 barrer\n"
              "[source]\nseal.modulus = own tensile test\npermeability.hfa-134a = own\n"
              "permeability.custom = own\n",
       NULL},
      {RUBBER "[permeability]\nhfa-134a = 9 MPa\n[source]\npermeability.hfa-134a = own\n",
       "[permeability] hfa-134a: "},
      {RUBBER "[seal]\nmodulus = 4 MPa\n", "own.rubber: [seal] modulus: has no source"},
      {RUBBER "[seal]\nmodulus = 4 mm\n[source]\nseal.modulus = own\n", "[seal] modulus: "},
      {RUBBER "[gland]\nradial_space = 1 mm\n", "is not a figure of a rubber"},
      {RUBBER "[swell]\nhfa-1 = 4 %\n[source]\nswell.hfa-1 = own\n", "names no fluid"},
      {RUBBER "[source]\nseal.modulus = own\n", "source: seal.modulus is not a figure"},
      {"[sealbench]\nformat = 1\nkind = valve\n", "is not a rubber"},
  };
  char *folder = document_folder();
  g_autofree char *path = g_build_filename(folder, "own.rubber", NULL);
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    g_assert_true(g_file_set_contents(path, rows[i].text, -1, NULL));
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autoptr(SbDocument) document = with_rubber(folder, "[rubber]\nname = own\n", issues);
    g_assert_cmpuint(issues->len, ==, rows[i].says != NULL);
    if (rows[i].says != NULL) {
      g_autofree char *line = sb_issue_line(issues->pdata[0]);
      g_assert_nonnull(strstr(line, rows[i].says));
    } else {
      g_assert_cmpfloat(sb_document_value(document, SB_P_SEAL_OUTER_MODULUS), ==, 4e6);
      g_assert_cmpfloat(sb_document_value(document, SB_P_RUBBER_PERMEABILITY), ==, 6.7e-16);
    }
  }
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document = with_rubber(folder, "[rubber]\nname = none\n", issues);
  g_assert_nonnull(document);
  g_autofree char *line = sb_issue_line(issues->pdata[0]);
  g_assert_nonnull(strstr(line, "[rubber] name: there is no rubber \"none\""));
  document_remove_folder(folder);
#undef RUBBER
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/document/rubbers", test_rubbers);
  g_test_add_func("/document/rubber-source", test_rubber_source);
  g_test_add_func("/document/own-rubber", test_own_rubber);
  g_test_add_func("/document/edited-data", test_edited_data);
  g_test_add_func("/document/edited-rubber", test_edited_rubber);
  return g_test_run();
}
