// Drawings: outlines of a DXF as half-sections, the lands, bores and grooves on them, a scene
// shaped by them, and what is refused.
#include "app/document/cad_parts.h"
#include "tests/app/drawing.h"

#include "app/base/error.h"
#include "tests/app/choices.h"

#include <math.h>
#include <string.h>

// ---- Sections ----

// A half-section above the axis, below it, a whole section, and one about a centre line anywhere,
// in inches: all the same body.
static void test_sections(void) {
  const SbCadChoices none = {0};
  const DrawingPlace plain = {0, 0, 0};
  for (int kind = 0; kind < 4; kind++) {
    const double scale = kind == 3 ? 1 / 25.4 : 1;
    // Along its own line a drawing begins where the line is nearest to the origin: across it lies
    // off.
    const DrawingPlace off = {-3 * sin(0.5), 3 * cos(0.5), 0.5};
    const DrawingPlace *place = kind == 3 ? &off : &plain;
    g_autoptr(GString) dxf = drawing_begin(kind == 3 ? 1 : 4);
    if (kind != 1) {
      drawing_stem(dxf, place, scale, 1);
    }
    if (kind == 1 || kind == 2) {
      drawing_stem(dxf, place, scale, -1);
    }
    if (kind == 3) {
      double x0 = -1, y0 = 0, x1 = 2, y1 = 0;
      drawing_move(place, &x0, &y0);
      drawing_move(place, &x1, &y1);
      drawing_line(dxf, "AXIS", x0, y0, x1, y1);
    }
    drawing_put(dxf, 0, "TEXT");
    drawing_put(dxf, 1, "scale 10 : 1");
    drawing_end(dxf);
    g_autoptr(SbCad) cad = drawing_parse(dxf, &none);
    drawing_check_stem_alone(cad, "left out: 1 TEXT");
  }
}

// The other way round and moved: from the other end, at another place.
static void test_flip(void) {
  const DrawingPlace plain = {0, 0, 0};
  const SbCadChoices flip = {.flip = true, .shift = 8.8e-3};
  g_autoptr(GString) dxf = drawing_begin(4);
  drawing_stem(dxf, &plain, 1, 1);
  drawing_end(dxf);
  g_autoptr(SbCad) cad = drawing_parse(dxf, &flip);
  const SbCadBody *body = cad->bodies->pdata[0];
  g_assert_cmpfloat_with_epsilon(body->solid.volume / drawing_stem_volume(), 1, 1e-9);
  const SbCadFeature *f = &g_array_index(body->features, SbCadFeature, 1);
  g_assert_cmpint(f->kind, ==, SB_CAD_LAND);
  g_assert_cmpfloat_with_epsilon(f->x0, -0.3e-3, 1e-9);
  g_assert_cmpfloat_with_epsilon(f->x1, 0.6e-3, 1e-9);
}

// A ring as a polyline with bulges, on the plane's back; an ellipse and a circle as splines.
static void test_curves(void) {
  const SbCadChoices millimetres = {.unit = "mm"};
  g_autoptr(GString) dxf = drawing_begin(0);
  drawing_put(dxf, 0, "LWPOLYLINE");
  drawing_put(dxf, 8, "ring");
  drawing_put(dxf, 70, "1");
  drawing_put(dxf, 10, "-1");
  drawing_put(dxf, 20, "3");
  drawing_put(dxf, 42, "1");
  drawing_put(dxf, 10, "-2");
  drawing_put(dxf, 20, "3");
  drawing_put(dxf, 42, "1");
  drawing_put(dxf, 230, "-1");
  drawing_put(dxf, 0, "ELLIPSE");
  drawing_put(dxf, 8, "spheroid");
  drawing_put(dxf, 10, "5");
  drawing_put(dxf, 20, "0");
  drawing_put(dxf, 11, "2");
  drawing_put(dxf, 21, "0");
  drawing_put(dxf, 40, "0.5");
  drawing_put(dxf, 41, "0");
  drawing_put(dxf, 42, "3.141592653589793");
  // A quarter of a circle of radius 2 as a rational quadratic, closed by two lines.
  drawing_put(dxf, 0, "SPLINE");
  drawing_put(dxf, 8, "quarter");
  drawing_put(dxf, 71, "2");
  for (int i = 0; i < 6; i++) {
    drawing_put(dxf, 40, "%d", i / 3);
  }
  static const double control[3][3] = {{2, 1, 1}, {2, 3, M_SQRT1_2}, {0, 3, 1}};
  for (int i = 0; i < 3; i++) {
    drawing_put(dxf, 10, "%.15g", control[i][0]);
    drawing_put(dxf, 20, "%.15g", control[i][1]);
    drawing_put(dxf, 41, "%.15g", control[i][2]);
  }
  drawing_line(dxf, "quarter", 0, 3, 0, 1);
  drawing_line(dxf, "quarter", 0, 1, 2, 1);
  drawing_end(dxf);
  g_autoptr(SbCad) cad = drawing_parse(dxf, &millimetres);
  g_assert_cmpuint(cad->bodies->len, ==, 3);
  const SbCadBody *ring = cad->bodies->pdata[0], *spheroid = cad->bodies->pdata[1];
  const SbCadBody *quarter = cad->bodies->pdata[2];
  g_assert_cmpfloat_with_epsilon(1e9 * ring->solid.volume, M_PI / 4 * 2 * M_PI * 3, 1e-9);
  g_assert_cmpfloat_with_epsilon(ring->solid.centre[0], 1.5e-3, 1e-12);
  // Arcs within 0.1 um of an ellipse of 2 x 1 mm.
  g_assert_cmpfloat_with_epsilon(1e9 * spheroid->solid.volume / (4 * M_PI / 3 * 2), 1, 1e-4);
  g_assert_cmpuint(spheroid->profile->len, <, 60);
  // Pappus: the quarter's area at the radius of its centre.
  const double area = M_PI, middle = 1 + 4 * 2 / (3 * M_PI);
  g_assert_cmpfloat_with_epsilon(1e9 * quarter->solid.volume / (2 * M_PI * middle * area), 1, 1e-9);
}

// The drawing's sizes take the place of the scene's; everything else stays.
static void test_scene(void) {
  // At a place that no unit makes round.
  const SbCadChoices none = {.shift = 0.09627022e-3};
  const DrawingPlace plain = {0, 0, 0};
  g_autoptr(GString) dxf = drawing_begin(4);
  drawing_stem(dxf, &plain, 1, 1);
  drawing_end(dxf);
  g_autoptr(SbCad) cad = drawing_parse(dxf, &none);
  int body[SB_CAD_PART_COUNT];
  SbCadSettings settings;
  GError *error = NULL;
  sb_cad_settings_init(&settings);
  g_assert_true(sb_cad_parts(body, cad, &settings, &error));
  g_assert_cmpint(body[SB_VALVE_STEM_CENTRE], ==, 0);
  g_assert_cmpint(body[SB_VALVE_HOUSING], ==, -1);
  static const char text[] = "[sealbench]\nformat = 1\nkind = valve\n"
                             "[gland]\nradial_space = 1.4 mm\n[seal]\nmodulus = 3 MPa\n"
                             "[part.stem_centre]\nmass = 2 g\n";
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) base = sb_document_parse(text, strlen(text), "base", NULL, issues);
  g_autoptr(SbDocument) after = NULL;
  g_autofree char *made = sb_cad_scene(&after, cad, body, 1000, base, "a.dxf", "out.valve", issues);
  g_assert_cmpuint(issues->len, ==, 0);
  g_autofree char *differs = sb_cad_differences(base, after);
  g_assert_nonnull(strstr(differs, "gland.radial_space: 1.4 mm → 1.36 mm\n"));
  g_assert_null(strstr(differs, "seal.modulus"));
  g_assert_nonnull(strstr(made, "# Drawing: a.dxf, Stem centre\n[part.stem_centre]\n"));
  const struct {
    SbParamId id;
    double value;
  } sizes[] = {{SB_P_GLAND_RADIAL_SPACE, 1.36e-3},
               {SB_P_GLAND_AXIAL_WIDTH, 2e-3},
               {SB_P_STEM_PRESSURE_DIAMETER, 5.794e-3},
               {SB_P_STEM_SEAL_SPACING, 6.2e-3},
               {SB_P_STEM_CHAMBER_DEPTH, 0.847e-3},
               {SB_P_SEAL_MODULUS, 3e6},
               {SB_P_PART_STEM_CENTRE_MASS, 1000 * drawing_stem_volume()}};
  for (size_t i = 0; i < G_N_ELEMENTS(sizes); i++) {
    g_assert_cmpfloat_with_epsilon(sb_document_value(after, sizes[i].id) / sizes[i].value, 1, 1e-9);
  }
  // Chosen by hand: a number or a name, of a body that is there.
  g_assert_true(sb_cad_choose(&settings, "stem-top", "1", &error));
  g_assert_true(sb_cad_parts(body, cad, &settings, &error));
  g_assert_cmpint(body[SB_VALVE_STEM_TOP], ==, 0);
  g_assert_true(sb_cad_choose(&settings, "housing", "block", &error));
  g_assert_false(sb_cad_parts(body, cad, &settings, &error));
  g_assert_cmpstr(error->message, ==,
                  "there is no body 'block' for housing, by number or name, among 1 Stem centre: "
                  "specify it with --part=housing=1");
  assert_choice(sb_app_error_choice(error), error->message, "housing", "1");
  g_clear_error(&error);
  g_assert_false(sb_cad_choose(&settings, "density", "0 kg/m3", &error));
  g_assert_cmpstr(error->message, ==, "1 to 30000 kg/m3");
  g_error_free(error);
  sb_cad_settings_clear(&settings);
}

static void test_refused(void) {
  static const struct {
    const char *text, *says;
  } cases[] = {
      {"", "a.dxf: is neither a STEP file (ISO 10303-21) nor a DXF: it has no section"},
      {"hello\nworld\n", "a.dxf: line 1 is not a group code of a DXF"},
      {"  0\nSECTION\n  2\nENTITIES\n  0\nLINE\n 10\nfar\n",
       "a.dxf: line 8: 'far' is not a number here"},
      {"  0\nSECTION\n  2\nENTITIES\n  0\nLINE\n 10\n", "a.dxf: the file ends after line 7"},
      {"  0\nSECTION\n  2\nENTITIES\n  0\nENDSEC\n",
       "a.dxf: states no unit ($INSUNITS): specify it with --unit=mm|cm|inch"},
      {"AutoCAD Binary DXF\r\n\x1a", "a.dxf: is a binary DXF: save it as text (ASCII)"},
  };
  const SbCadChoices none = {0}, millimetres = {.unit = "mm"}, wrong = {.unit = "kg"};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    GError *error = NULL;
    const size_t length = strlen(cases[i].text) + (i == 5 ? 3 : 0);
    const SbCadChoices *choices = i == 4 ? &none : &millimetres;
    g_assert_null(sb_cad_parse_dxf(cases[i].text, length, "a.dxf", choices, &error));
    g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
    g_assert_cmpstr(error->message, ==, cases[i].says);
    g_assert_true((sb_app_error_choice(error) != NULL) == (i == 4));
    if (i == 4) {
      assert_choice(sb_app_error_choice(error), error->message, "unit", "mm\ncm\ninch");
    }
    g_error_free(error);
  }
  // A seal's own section has no option for its unit; an axis out of the plane is refused.
  const SbCadChoices section = {.section = true}, across = {.axis = (double[]){0, 0, 1}};
  GError *problem = NULL;
  const char *bare = cases[4].text;
  g_assert_null(sb_cad_parse_dxf(bare, strlen(bare), "a.dxf", &section, &problem));
  g_assert_cmpstr(problem->message, ==, "a.dxf: states no unit ($INSUNITS)");
  g_assert_null(sb_app_error_choice(problem));
  g_clear_error(&problem);
  g_assert_null(sb_cad_parse_dxf(bare, strlen(bare), "a.dxf", &across, &problem));
  assert_choice(sb_app_error_choice(problem), problem->message, "axis", "x\ny");
  g_clear_error(&problem);
  // Lines that close to nothing; a unit that is no length.
  g_autoptr(GString) open = drawing_begin(4);
  drawing_line(open, "0", 0, 1, 2, 3);
  drawing_line(open, "0", 2, 3, 4, 1); // the axis is as near as that
  drawing_end(open);
  GError *error = NULL;
  g_assert_null(sb_cad_parse_dxf(open->str, open->len, "a.dxf", &millimetres, &error));
  g_assert_cmpstr(
      error->message, ==,
      "a.dxf: contains no closed outline; 0: 1 line that closes to no outline: ends are up "
      "to 1 mm apart");
  g_clear_error(&error);
  g_assert_null(sb_cad_parse_dxf(open->str, open->len, "a.dxf", &wrong, &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
  g_error_free(error);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/cad/sections", test_sections);
  g_test_add_func("/cad/flip", test_flip);
  g_test_add_func("/cad/curves", test_curves);
  g_test_add_func("/cad/scene", test_scene);
  g_test_add_func("/cad/refused", test_refused);
  return g_test_run();
}
