// The valve drawn by its parts' profiles: sizes that follow from them against the typed ones of the
// valve that they imitate, areas of the drawn triangles against the profiles' own, motion, and a
// scene that overrides a size.
#include "app/document/document.h"
#include "app/section/draw_cairo.h"
#include "app/section/mesh.h"
#include "app/section/palette.h"
#include "app/section/section.h"
#include "tests/app/picture.h"

#include <math.h>
#include <string.h>

static SbDocument *load(const char *folder, const char *name, GPtrArray *issues) {
  g_autofree char *path = g_build_filename(g_getenv("SEALBENCH_ASSETS"), folder, name, NULL);
  return sb_document_load(path, issues);
}

// A model, which outlives its document. Owned by the caller.
static SbModel *compile(const char *folder, const char *name) {
  SbModel *model = NULL;
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document = load(folder, name, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  g_assert_cmpuint(sb_document_notes(document)->len, ==, 0);
  g_assert_true(sb_document_compile(document, &model, issues));
  return model;
}

static void assert_near(double value, double expected, double tolerance) {
  g_assert_cmpfloat(fabs(value - expected), <=, tolerance * fabs(expected));
}

// Bore, land and gland of the profiles are those that piston.valve types.
static void test_sizes(void) {
  g_autoptr(SbModel) typed = compile("valves", "piston.valve");
  g_autoptr(SbModel) model = compile("valves", "piston-profiles.valve");
  static const SbParamId sizes[] = {SB_P_BORE_DIAMETER, SB_P_GLAND_RADIAL_SPACE,
                                    SB_P_GLAND_AXIAL_WIDTH, SB_P_STEM_PRESSURE_DIAMETER};
  for (size_t i = 0; i < G_N_ELEMENTS(sizes); i++) {
    assert_near(sb_model_value(model, sizes[i]), sb_model_value(typed, sizes[i]), 1e-12);
  }
  assert_near(sb_model_pressure_force(model), sb_model_pressure_force(typed), 1e-12);
  const SbValveShape *shaped = sb_model_shape(model), *by_keys = sb_model_shape(typed);
  assert_near(shaped->seal_spacing, by_keys->seal_spacing, 1e-12);
  assert_near(shaped->land_length, by_keys->land_length, 1e-12);
  assert_near(shaped->entry_length, by_keys->entry_length, 1e-12);
  assert_near(shaped->entry_diameter, by_keys->entry_diameter, 1e-12);
  // The recess by Pappus: a rectangle of 2.9 mm by 0.847 mm less two corners that quarter circles
  // of 0.5 mm leave (area (1 - pi/4) R^2, its centroid R (10 - 3 pi)/(12 - 3 pi) from the
  // corner).
  double land = 2.897e-3, floor = 2.05e-3, R = 0.5e-3;
  double corner = (1 - G_PI / 4) * R * R;
  double centroid = floor + R * (10 - 3 * G_PI) / (12 - 3 * G_PI);
  double recess = G_PI * (land * land - floor * floor) * 2.9e-3 - 2 * 2 * G_PI * centroid * corner;
  double area = G_PI * (land * land - floor * floor);
  assert_near(shaped->chamber_depth, land - floor, 1e-12);
  assert_near(shaped->chamber_length * area, recess, 1e-4);
}

// Area of a part's profile in closed form: the polygon and the segments of its arcs.
static double profile_area(const char *key, double *most_left) {
  g_autofree char *path =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "valves", "piston-profiles.valve", NULL);
  g_autoptr(GKeyFile) file = g_key_file_new();
  g_assert_true(g_key_file_load_from_file(file, path, G_KEY_FILE_NONE, NULL));
  g_autofree char *text = g_key_file_get_string(file, key, "profile", NULL);
  g_auto(GStrv) word = g_strsplit(text, " ", -1);
  guint n = g_strv_length(word);
  double area = 0, x = 0, r = 0;
  *most_left = HUGE_VAL;
  for (guint i = 1; i <= n; i++) {
    g_auto(GStrv) number = g_strsplit(word[i < n ? i : 1], ",", -1);
    double nx = g_ascii_strtod(number[0], NULL), nr = g_ascii_strtod(number[1], NULL);
    if (i > 1) {
      area += (x * nr - nx * r) / 2;
      g_auto(GStrv) before = g_strsplit(word[i - 1], ",", -1);
      double bulge = before[2] != NULL ? g_ascii_strtod(before[2], NULL) : 0;
      double angle = 4 * atan(bulge), chord = hypot(nx - x, nr - r);
      if (bulge != 0) {
        double radius = chord / 2 / sin(angle / 2);
        area += radius * radius / 2 * (angle - sin(angle));
      }
    }
    x = nx;
    r = nr;
    *most_left = fmin(*most_left, nx);
  }
  return area;
}

typedef struct {
  SbDrawList list;
  SbSection *section;
  SbFrame frame;
} Drawing;

static void draw(Drawing *drawing, const SbModel *model, double displacement,
                 const SbSectionView *view) {
  SbSectionLimits limits = {.inner_contact_left = -0.3e-3,
                            .pressure_max = 1.2e6,
                            .film_max = 1e-9,
                            .contact_left = {-0.4e-3, -0.3e-3},
                            .contact_right = {0.4e-3, 0.3e-3}};
  drawing->frame = (SbFrame){.displacement = displacement, .force = 27, .pressure_force = 14.5};
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    bool free = i == SB_INNER && displacement > 4.1e-3;
    drawing->frame.seal[i] = (SbSealFrame){.land_fraction = free ? 0 : 1,
                                           .pressure_left = 0.55e6f,
                                           .contact_left = free ? 0 : -0.3e-3,
                                           .contact_right = free ? 0 : 0.3e-3};
  }
  sb_draw_list_init(&drawing->list);
  drawing->section = sb_section_create(model, &limits);
  SbSectionInstant instant = {.frame = &drawing->frame};
  sb_section_draw(drawing->section, &drawing->list, view, &instant);
}

static void finish(Drawing *drawing) {
  sb_draw_list_finish(&drawing->list);
  sb_section_destroy(drawing->section);
}

static const SbSectionView plain = {
    .width = 1216, .height = 568, .margin = 20, .hide_insets = true};

// The n-th hatched fill of the picture: its triangles' area and its leftmost point [px].
static double triangles(const SbDrawList *list, size_t n, double *left) {
  for (size_t i = 0; i < list->item_count; i++) {
    const SbDrawItem *item = &list->item[i];
    if (item->kind != SB_DRAW_FILL || !(item->hatch.width > 0) || n-- > 0) {
      continue;
    }
    SbMesh mesh;
    sb_mesh_init(&mesh);
    sb_mesh_fill(&mesh, item, list->point + item->first, 1);
    double area = 0;
    *left = HUGE_VAL;
    for (size_t k = 0; k < mesh.count; k += 3) {
      const SbMeshVertex *v = mesh.vertex + k;
      area += fabs((double)(v[1].x - v[0].x) * (double)(v[2].y - v[0].y) -
                   (double)(v[2].x - v[0].x) * (double)(v[1].y - v[0].y)) /
              2;
      for (int c = 0; c < 3; c++) {
        *left = fmin(*left, (double)v[c].x);
      }
    }
    sb_mesh_finish(&mesh);
    return area;
  }
  g_assert_not_reached();
}

// What is filled is the profile: areas to 4e-5 (arcs are drawn within 0.25 um, which takes up to
// 2/3 of that times their length: 3e-5 of the nose's area), the stem's parts shifted by the stroke,
// the housing at rest.
static void test_triangles(void) {
  static const char *const groups[] = {"part.housing", "part.stem_centre", "part.stem_top"};
  static const double strokes[] = {0, 2.15e-3, 6e-3};
  g_autoptr(SbModel) valve_model = compile("valves", "piston-profiles.valve"), model = NULL;
  const SbOverride no_vent = {SB_P_BORE_VENT_DIAMETER, 0}; // which cuts the housing
  g_assert_cmpint(sb_model_derive(&model, valve_model, &no_vent, 1, NULL), ==, SB_OK);
  for (size_t k = 0; k < G_N_ELEMENTS(strokes); k++) {
    Drawing drawing;
    draw(&drawing, model, strokes[k], &plain);
    double scale, x0, y0;
    sb_section_transform(drawing.section, &scale, &x0, &y0);
    const SbValveOutline *valve = sb_section_valve(drawing.section);
    g_assert_false(valve->adjusted);
    for (size_t i = 0; i < G_N_ELEMENTS(groups); i++) {
      double most_left, left;
      double area = profile_area(groups[i], &most_left);
      double drawn = triangles(&drawing.list, i, &left) / (scale * scale) * 1e6;
      assert_near(drawn, area, 4e-5);
      // The inner groove's left wall is at 0 in the stem's frame, the land edge in the housing's.
      double zero = i == 0 ? 0 : valve->groove_left[SB_INNER] - strokes[k];
      assert_near((left - x0) / scale, zero + 1e-3 * most_left, 1e-4);
    }
    finish(&drawing);
  }
}

// The model's rings sit in the drawn grooves, and the walls that they meet are the profile's.
static void test_walls(void) {
  g_autoptr(SbModel) model = compile("valves", "piston-profiles.valve");
  Drawing drawing;
  draw(&drawing, model, 2e-3, &plain);
  const SbValveOutline *valve = sb_section_valve(drawing.section);
  g_assert_cmpfloat_with_epsilon(sb_valve_outline_bore(valve, 1e-3), 3e-3, 1e-12);
  g_assert_cmpfloat_with_epsilon(sb_valve_outline_bore(valve, -1.2e-3), 3.5e-3, 1e-12);
  double on_lead = 3e-3 + (0.4e-3 - 0.025e-3) * tan(0.5);
  g_assert_cmpfloat_with_epsilon(sb_valve_outline_bore(valve, -0.4e-3), on_lead, 1e-7);
  g_assert_false(isfinite(sb_valve_outline_bore(valve, 13e-3)));
  g_assert_cmpfloat_with_epsilon(valve->chamber_floor, 2.05e-3, 1e-9);
  g_assert_cmpfloat_with_epsilon(valve->rod, 1.55e-3, 1e-9);
  finish(&drawing);
}

// A scene may override what its valve's shape gives: a note names both values, the number is in
// force, and the drawing follows the number.
static void test_override(void) {
  g_autofree char *folder = g_build_filename(g_getenv("SEALBENCH_ASSETS"), "scenes", NULL);
  static const char text[] = "[sealbench]\nformat = 1\nkind = scene\n"
                             "valve = ../valves/piston-profiles.valve\n[bore]\ndiameter = 6.1 mm\n"
                             "[gland]\naxial_width = 2.2 mm\n";
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document =
      sb_document_parse(text, strlen(text), "wide.scene", folder, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  const GPtrArray *notes = sb_document_notes(document);
  g_assert_cmpuint(notes->len, ==, 2);
  // The drawn stem and mouth stay while the bore changes, the chamber while the grooves do.
  g_autoptr(GPtrArray) kept = sb_issues_new();
  sb_document_kept(document, kept);
  g_assert_cmpuint(kept->len, ==, 3);
  g_assert_nonnull(strstr(((const SbIssue *)notes->pdata[0])->text,
                          "wide.scene: bore.diameter = 6.1 mm applies; the "
                          "bore of [part.housing] has 6 mm"));
  g_assert_null(sb_document_shape_source(document, SB_P_BORE_DIAMETER));
  g_autoptr(SbModel) model = NULL;
  g_assert_true(sb_document_compile(document, &model, issues));
  g_assert_cmpfloat(sb_model_value(model, SB_P_BORE_DIAMETER), ==, 6.1e-3);
  Drawing drawing;
  draw(&drawing, model, 2e-3, &plain);
  const SbValveOutline *valve = sb_section_valve(drawing.section);
  g_assert_true(valve->adjusted);
  g_assert_cmpfloat_with_epsilon(sb_valve_outline_bore(valve, 1e-3), 3.05e-3, 1e-12);
  double wide = -HUGE_VAL;
  for (size_t i = 0; i < valve->solid_count; i++) {
    for (size_t k = 0; k < valve->solid[i].count; k++) {
      double x = valve->solid[i].point[k].x;
      if (valve->solid[i].moves && x <= valve->groove_left[SB_INNER] + 1e-9) {
        wide = fmax(wide, x);
      }
    }
  }
  g_assert_cmpfloat_with_epsilon(wide, valve->groove_right[SB_INNER] - 2.2e-3, 1e-12);
  finish(&drawing);
  // On the command line too.
  g_assert_true(sb_document_set_option(document, "stem.pressure_diameter=5.7mm", issues));
  notes = sb_document_notes(document);
  g_assert_cmpuint(notes->len, ==, 3); // the stem differs from its shape, and no longer stays
  g_autoptr(GPtrArray) left = sb_issues_new();
  sb_document_kept(document, left);
  g_assert_cmpuint(left->len, ==, 2);
  g_assert_cmpstr(((const SbIssue *)left->pdata[0])->key, ==, "bore.entry_diameter");
  g_assert_cmpstr(((const SbIssue *)left->pdata[1])->key, ==, "stem.chamber_length");
}

// A text that stands alone keeps the shapes, so that a picture opened again draws them.
static void test_flat_text(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document = load("scenes", "part-profiles.scene", issues);
  g_autofree char *flat = sb_document_to_flat_text(document);
  g_autoptr(SbDocument) again = sb_document_parse(flat, strlen(flat), "flat", NULL, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  g_assert_cmpuint(sb_document_notes(again)->len, ==, 0);
  g_autoptr(SbModel) a = NULL, b = NULL;
  g_assert_true(sb_document_compile(document, &a, issues));
  g_assert_true(sb_document_compile(again, &b, issues));
  const SbValveOutlines *of_a = sb_model_outlines(a), *of_b = sb_model_outlines(b);
  g_assert_true(of_b->stem && of_b->housing);
  g_assert_cmpmem(of_a, sizeof *of_a, of_b, sizeof *of_b);
  g_autofree char *hash = sb_document_sha256(document);
  g_autofree char *hash_again = sb_document_sha256(again);
  g_assert_cmpstr(hash, ==, hash_again);
}

static cairo_surface_t *picture(const SbModel *model, bool dark, double displacement) {
  SbSectionView view = {.width = 1216, .height = 568, .margin = 20, .dark = dark};
  Drawing drawing;
  draw(&drawing, model, displacement, &view);
  cairo_surface_t *surface = picture_new(1216, 568, 1);
  cairo_t *cr = cairo_create(surface);
  SbText *text = sb_text_create();
  sb_draw_list_to_cairo(&drawing.list, text, cr);
  sb_text_destroy(text);
  cairo_destroy(cr);
  finish(&drawing);
  return surface;
}

static void test_golden(void) {
  g_autoptr(SbModel) model = compile("valves", "piston-profiles.valve"), wrong = NULL;
  // The nose a fiftieth of a millimetre shorter.
  SbModelData *shorter = NULL;
  g_assert_cmpint(sb_model_data_create(&shorter), ==, SB_OK);
  shorter->outlines = *sb_model_outlines(model);
  SbOutline *nose = &shorter->outlines.part[SB_VALVE_STEM_TOP];
  for (size_t i = 0; i < nose->count; i++) {
    nose->point[i].x = fmax(nose->point[i].x, -2.18e-3);
  }
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document = load("valves", "piston-profiles.valve", issues);
  const SbParams params = sb_document_params(document);
  g_assert_cmpint(sb_model_create(&wrong, &params, shorter, NULL, NULL), ==, SB_OK);
  sb_model_data_release(shorter);
  for (int dark = 0; dark < 2; dark++) {
    const char *name = dark ? "section-profiles-dark" : "section-profiles";
    double displacement = dark ? 5.5e-3 : 2.15e-3;
    cairo_surface_t *right = picture(model, dark, displacement);
    picture_check(right, name);
    cairo_surface_destroy(right);
    cairo_surface_t *off = picture(wrong, dark, displacement);
    g_assert_true(picture_rejects(off, name));
    cairo_surface_destroy(off);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/shapes/sizes", test_sizes);
  g_test_add_func("/shapes/triangles", test_triangles);
  g_test_add_func("/shapes/walls", test_walls);
  g_test_add_func("/shapes/override", test_override);
  g_test_add_func("/shapes/flat-text", test_flat_text);
  g_test_add_func("/shapes/golden", test_golden);
  return g_test_run();
}
