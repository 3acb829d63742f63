// Shapes of parts in valve files: masses, moments and diameters against closed forms, what wins
// where a key says otherwise, and refusals with file, group and key.
#include "app/document/document.h"
#include "engine/valve/sealbench.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

static const char head[] = "[sealbench]\nformat = 1\nkind = valve\n";

static SbDocument *parse(const char *body, GPtrArray *issues) {
  g_autofree char *text = g_strconcat(head, body, NULL);
  return sb_document_parse(text, strlen(text), "test.valve", NULL, issues);
}

static void assert_relative(double value, double expected, double tolerance) {
  g_assert_cmpfloat(fabs(value / expected - 1), <, tolerance);
}

// Mass, axial and transverse moment of the stem top made of a profile.
static void assert_solid(const char *profile, double mass, double axial, double across) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autofree char *body =
      g_strdup_printf("[part.stem_top]\ndensity = 1410 kg/m3\nprofile = %s\n", profile);
  g_autoptr(SbDocument) document = parse(body, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  assert_relative(sb_document_value(document, SB_P_PART_STEM_TOP_MASS), mass, 1e-10);
  assert_relative(sb_document_value(document, SB_P_PART_STEM_TOP_INERTIA_AXIAL), axial, 1e-10);
  assert_relative(sb_document_value(document, SB_P_PART_STEM_TOP_INERTIA_TRANSVERSE), across,
                  1e-10);
  // The moving mass is made of it: no stem.mass is given.
  g_autoptr(SbModel) model = NULL;
  g_assert_true(sb_document_compile(document, &model, issues));
  const SbValvePart *part = sb_model_parts(model)->part;
  assert_relative(part[SB_VALVE_STEM_TOP].mass, mass, 1e-10);
  double moving = 0;
  for (int i = SB_VALVE_STEM_CENTRE; i < SB_VALVE_PARTS; i++) {
    moving += part[i].mass;
  }
  assert_relative(moving, mass + 1.12e-3 + 1.14e-3 + 2 * 3.23e-6 + 1e-10, 1e-10);
}

static void test_solids(void) {
  double rho = 1410;
  double R = 2e-3;
  double r = 1e-3;
  double L = 10e-3;
  double m = rho * G_PI * R * R * L;
  assert_solid("mm 10,0 10,2 0,2 0,0", m, m * R * R / 2, m * (3 * R * R + L * L) / 12);
  // Hollow stem, closed by its first point, in metres.
  m = rho * G_PI * (R * R - r * r) * L;
  assert_solid("m 0,0.001 0.01,0.001 0.01,0.002 0,0.002 0,0.001", m, m * (R * R + r * r) / 2,
               m * (3 * (R * R + r * r) + L * L) / 12);
  // Cone.
  m = rho * G_PI * R * R * L / 3;
  assert_solid("mm 10,0 0,2 0,0", m, 0.3 * m * R * R, m * (0.15 * R * R + 3.0 / 80 * L * L));
  // Torus of two half circles: mean radius 3 mm, section radius 1 mm.
  double D = 3e-3;
  double a = 1e-3;
  m = rho * 2 * G_PI * G_PI * D * a * a;
  assert_solid("mm 1,3,1 -1,3,1 1,3", m, m * (D * D + 0.75 * a * a),
               m * (D * D / 2 + 0.625 * a * a));
}

static const char housing[] = "[part.housing]\n"
                              "density = 1410 kg/m3\n"
                              "profile = mm 0,3.05 12,3.05 12,6 0,6 0,3.05\n"
                              "bore = 2 mm .. 10 mm\n";
static const char stem[] = "[part.stem_centre]\n"
                           "density = 1410 kg/m3\n"
                           "profile = mm 14,0 14,2.9 8,2.9 8,1.65 6,1.65 6,2.9 0,2.9 0,0\n"
                           "land = 8 mm .. 14 mm\n"
                           "groove = 6 mm .. 8 mm\n";

// Bore, land and groove by stretches of the profiles; the model uses them.
static void test_diameters(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autofree char *body = g_strconcat(housing, stem, NULL);
  g_autoptr(SbDocument) document = parse(body, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  // One groove does not tell where the stem sits: it is not drawn, and a note says so.
  g_assert_cmpuint(sb_document_notes(document)->len, ==, 1);
  g_autoptr(SbModel) model = NULL;
  g_assert_true(sb_document_compile(document, &model, issues));
  g_assert_true(sb_model_outlines(model)->housing && !sb_model_outlines(model)->stem);
  assert_relative(sb_model_value(model, SB_P_BORE_DIAMETER), 6.1e-3, 1e-12);
  assert_relative(sb_model_value(model, SB_P_STEM_PRESSURE_DIAMETER), 5.8e-3, 1e-12);
  assert_relative(sb_model_value(model, SB_P_GLAND_RADIAL_SPACE), 1.4e-3, 1e-12);
  assert_relative(sb_model_pressure_force(model), 0.55e6 * G_PI / 4 * 5.8e-3 * 5.8e-3, 1e-12);
}

// In one file the shape takes precedence: a key that says otherwise is an error naming file,
// group, key and both values. A key that agrees is silent, and so is a mass beside it.
static void test_clash(void) {
  static const struct {
    const char *keys, *key, *text;
  } cases[] = {
      {"[bore]\ndiameter = 6.1 mm\n[gland]\nradial_space = 1.4 mm\n[stem]\nmass = 3 g\n", NULL,
       NULL},
      {"[bore]\ndiameter = 6 mm\n", "bore.diameter",
       "is 6 mm, but the bore of [part.housing] results in 6.1 mm"},
      {"[gland]\nradial_space = 1.36 mm\n", "gland.radial_space",
       "is 1.36 mm, but the groove of [part.stem_centre] results in 1.4 mm"},
      {"[stem]\npressure_diameter = 5.794 mm\n", "stem.pressure_diameter",
       "is 5.794 mm, but the land of [part.stem_centre] results in 5.8 mm"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autofree char *body = g_strconcat(housing, stem, cases[i].keys, NULL);
    g_autoptr(SbDocument) document = parse(body, issues);
    if (cases[i].key == NULL) {
      g_assert_cmpuint(issues->len, ==, 0);
      g_assert_cmpfloat(sb_document_value(document, SB_P_BORE_DIAMETER), ==, 6.1e-3);
      g_assert_nonnull(sb_document_shape_source(document, SB_P_BORE_DIAMETER));
      g_assert_null(sb_document_shape_source(document, SB_P_STEM_MASS));
      g_autoptr(SbModel) model = NULL;
      g_assert_true(sb_document_compile(document, &model, issues));
      double mass = 0;
      for (int k = SB_VALVE_STEM_CENTRE; k <= SB_VALVE_STEM_BOTTOM; k++) {
        mass += sb_model_parts(model)->part[k].mass;
      }
      g_assert_cmpfloat_with_epsilon(mass, 3e-3, 1e-15);
      continue;
    }
    g_assert_cmpuint(issues->len, >=, 1);
    const SbIssue *issue = issues->pdata[0];
    g_assert_cmpstr(issue->file, ==, "test.valve");
    g_assert_cmpstr(issue->key, ==, cases[i].key);
    g_assert_cmpint(issue->line, >, 0);
    g_test_message("%s", issue->text);
    g_assert_nonnull(strstr(issue->text, cases[i].text));
  }
}

// A mass beside a shape is in force, and a note tells.
static void test_weighed(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autofree char *body = g_strconcat(stem, "mass = 2 g\n", NULL);
  g_autoptr(SbDocument) document = parse(body, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  g_assert_cmpfloat(sb_document_value(document, SB_P_PART_STEM_CENTRE_MASS), ==, 2e-3);
  const GPtrArray *notes = sb_document_notes(document);
  g_assert_cmpuint(notes->len, ==, 2);
  g_assert_nonnull(strstr(((const SbIssue *)notes->pdata[0])->text,
                          "part.stem_centre.mass = 2 g applies; the profile"));
  g_assert_nonnull(strstr(((const SbIssue *)notes->pdata[1])->text, "the section does not draw"));
}

// What follows from a shape is in force again once the own value beside it goes, as it is when the
// saved text is read.
static void test_unset(void) {
  static const SbParamId id[] = {SB_P_PART_STEM_CENTRE_MASS, SB_P_GLAND_RADIAL_SPACE,
                                 SB_P_STEM_PRESSURE_DIAMETER};
  for (int weighed = 0; weighed < 2; weighed++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autofree char *body = g_strconcat(stem, weighed ? "mass = 2 g\n" : "", NULL);
    g_autoptr(SbDocument) document = parse(body, issues);
    for (size_t i = 0; i < G_N_ELEMENTS(id); i++) {
      g_assert_true(sb_document_set_value(document, id[i],
                                          1.01 * sb_document_value(document, id[i]), false, NULL));
      sb_document_unset(document, id[i]);
    }
    g_autofree char *text = sb_document_to_text(document, NULL);
    g_autoptr(SbDocument) again = sb_document_parse(text, strlen(text), "again", NULL, issues);
    g_assert_cmpuint(issues->len, ==, 0);
    for (size_t i = 0; i < G_N_ELEMENTS(id); i++) {
      assert_relative(sb_document_value(document, id[i]), sb_document_value(again, id[i]), 1e-12);
      g_assert_cmpfloat(fabs(sb_document_value(document, id[i]) / sb_param(id[i])->fallback - 1), >,
                        1e-3);
    }
  }
}

// The stem's mass of the valve under a scene shares out that of the scene's shape: a note tells.
static void test_weighed_below(void) {
  g_autofree char *folder = g_dir_make_tmp("sealbench-parts-XXXXXX", NULL);
  g_autofree char *valve = g_build_filename(folder, "a.valve", NULL);
  g_autofree char *scene = g_build_filename(folder, "a.scene", NULL);
  static const char weighed[] = "[sealbench]\nformat = 1\nkind = valve\n[stem]\nmass = 3.73 g\n"
                                "[part.stem_centre]\nmass = 1.12 g\n[part.stem_top]\n"
                                "mass = 1.47 g\n[part.stem_bottom]\nmass = 1.14 g\n";
  static const char shaped[] = "[sealbench]\nformat = 1\nkind = scene\nvalve = a.valve\n"
                               "[part.stem_centre]\ndensity = 1000 kg/m3\n"
                               "profile = mm 10,0 10,2 0,2 0,0\n";
  g_assert_true(g_file_set_contents(valve, weighed, -1, NULL));
  g_assert_true(g_file_set_contents(scene, shaped, -1, NULL));
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document = sb_document_load(scene, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  const GPtrArray *notes = sb_document_notes(document);
  bool told = false;
  for (guint i = 0; i < notes->len; i++) {
    // 1000 kg/m3 pi (2 mm)^2 10 mm = 0.12566 g beside 1.47 and 1.14 g.
    told = told || strstr(((const SbIssue *)notes->pdata[i])->text,
                          "stem.mass = 3.73 g applies; the stem's parts add up to "
                          "2.7357 g") != NULL;
  }
  g_assert_true(told);
  g_remove(scene);
  g_remove(valve);
  g_rmdir(folder);
}

// A cube of 2 mm written as STL in a folder: mass to the rounding of its floats.
static void test_mesh(void) {
  g_autofree char *folder = g_dir_make_tmp("sealbench-parts-XXXXXX", NULL);
  g_autofree char *mesh = g_build_filename(folder, "top.stl", NULL);
  g_autofree char *valve = g_build_filename(folder, "a.valve", NULL);
  static const char *const face[6][4] = {
      {"0 0 0", "0 2 0", "2 2 0", "2 0 0"}, {"0 0 2", "2 0 2", "2 2 2", "0 2 2"},
      {"0 0 0", "2 0 0", "2 0 2", "0 0 2"}, {"2 0 0", "2 2 0", "2 2 2", "2 0 2"},
      {"2 2 0", "0 2 0", "0 2 2", "2 2 2"}, {"0 2 0", "0 0 0", "0 0 2", "0 2 2"},
  };
  GString *text = g_string_new("solid cube\n");
  for (int i = 0; i < 6; i++) {
    for (int half = 0; half < 2; half++) {
      g_string_append_printf(text,
                             "facet normal 0 0 0\nouter loop\nvertex %s\nvertex %s\nvertex %s\n"
                             "endloop\nendfacet\n",
                             face[i][0], face[i][half + 1], face[i][half + 2]);
    }
  }
  g_string_append(text, "endsolid cube\n");
  g_assert_true(g_file_set_contents(mesh, text->str, -1, NULL));
  g_string_free(text, TRUE);
  g_autofree char *body = g_strconcat(head,
                                      "[part.stem_top]\nstl = top.stl\nunit = mm\naxis = z\n"
                                      "density = 1000 kg/m3\n",
                                      NULL);
  g_assert_true(g_file_set_contents(valve, body, -1, NULL));
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document = sb_document_load(valve, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  // Its section is not drawn, and a note says so.
  const GPtrArray *notes = sb_document_notes(document);
  g_assert_cmpuint(notes->len, ==, 1);
  g_assert_nonnull(strstr(((const SbIssue *)notes->pdata[0])->text,
                          "the mesh of [part.stem_top] gives mass and moments"));
  double m = 8e-6;
  assert_relative(sb_document_value(document, SB_P_PART_STEM_TOP_MASS), m, 1e-10);
  assert_relative(sb_document_value(document, SB_P_PART_STEM_TOP_INERTIA_AXIAL), m * 8e-6 / 12,
                  1e-10);
  // By a relative path: the same, and the text of the whole stands alone anywhere.
  g_autofree char *before = g_get_current_dir();
  g_assert_cmpint(g_chdir(folder), ==, 0);
  g_autoptr(GPtrArray) none = sb_issues_new();
  SbDocument *near = sb_document_load("a.valve", none);
  g_assert_cmpuint(none->len, ==, 0);
  g_autofree char *flat = sb_document_to_flat_text(near);
  g_assert_cmpint(g_chdir(before), ==, 0);
  g_autofree char *line = g_strdup_printf("stl = %s\n", mesh);
  g_assert_nonnull(strstr(flat, line));
  sb_document_free(near);
  g_remove(mesh);
  g_remove(valve);
  g_rmdir(folder);
}

static void test_refused(void) {
  static const struct {
    const char *keys, *key, *text;
  } cases[] = {
      {"profile = mm 0,1 5,1 5,2 0,2\n", "profile", "is open"},
      {"profile = mm 0,1 5,1 5,0.5 3,2 0,1\n", "profile", "crosses itself"},
      {"profile = mm 0,1 0,2 5,2 5,1 0,1\n", "profile", "wrong handedness"},
      {"profile = mm 0,1 5,-1 5,2 0,1\n", "profile", "below the axis"},
      {"profile = mm 0,1\n", "profile", "1 points"},
      {"profile = mm 0,1 5,1 0,1\n", "profile", ""},
      {"profile = 0,1 5,1 5,2\n", "profile", "starts with the unit"},
      {"profile = mm 0,1 5;1 5,2\n", "profile", "point 2"},
      {"profile = mm 0,1 0x5,1 5,2\n", "profile", "point 2"},
      {"profile = mm 10,0 10,2 0,2 0,0\nland = 20 mm .. 30 mm\n", "land", "does not reach"},
      {"profile = mm 10,0 10,2 0,2 0,0\nland = 20 mm\n", "land", "not a stretch"},
      {"stl = nowhere.stl\nunit = mm\n", "stl", "nowhere.stl"},
      {"stl = nowhere.stl\n", "unit", "states no unit"},
      {"stl = a.stl\nunit = mm\nprofile = mm 0,0 1,1 1,0\n", "stl", "not both"},
      {"land = 1 mm .. 2 mm\n", "land", "needs a profile"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autofree char *body =
        g_strconcat("[part.stem_top]\n", cases[i].keys,
                    i + 1 < G_N_ELEMENTS(cases) ? "density = 1 g/ml\n" : "", NULL);
    sb_document_free(parse(body, issues));
    g_assert_cmpuint(issues->len, ==, 1);
    const SbIssue *issue = issues->pdata[0];
    g_autofree char *key = g_strconcat("part.stem_top.", cases[i].key, NULL);
    g_test_message("%s: %s", issue->key, issue->text);
    g_assert_cmpstr(issue->file, ==, "test.valve");
    g_assert_cmpstr(issue->key, ==, key);
    g_assert_nonnull(strstr(issue->text, cases[i].text));
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/parts/solids", test_solids);
  g_test_add_func("/parts/diameters", test_diameters);
  g_test_add_func("/parts/clash", test_clash);
  g_test_add_func("/parts/weighed", test_weighed);
  g_test_add_func("/parts/weighed-below", test_weighed_below);
  g_test_add_func("/parts/unset", test_unset);
  g_test_add_func("/parts/mesh", test_mesh);
  g_test_add_func("/parts/refused", test_refused);
  return g_test_run();
}
