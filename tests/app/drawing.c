// See drawing.h.
#include "tests/app/drawing.h"

#include <math.h>
#include <string.h>

#include <string.h>

// The stem centre of piston-profiles.valve, about the axis: x, r [mm], bulge.
static const double stem[][3] = {{7.5, 0},
                                 {7.5, 0.9},
                                 {9.3, 0.9},
                                 {9.3, 2.697, 0.41421},
                                 {9.1, 2.897},
                                 {8.2, 2.897},
                                 {8.2, 1.64},
                                 {6.2, 1.64},
                                 {6.2, 2.897},
                                 {5.55, 2.897},
                                 {5.55, 2.55, -0.41421},
                                 {5.05, 2.05},
                                 {3.15, 2.05, -0.41421},
                                 {2.65, 2.55},
                                 {2.65, 2.897},
                                 {2, 2.897},
                                 {2, 1.64},
                                 {0, 1.64},
                                 {0, 2.897},
                                 {-0.3, 2.897, 0.41421},
                                 {-0.5, 2.697},
                                 {-0.5, 0.9},
                                 {1.1, 0.9},
                                 {1.1, 0}};
enum { STEM = G_N_ELEMENTS(stem) };

double drawing_stem_volume(void) {
  SbProfilePoint point[STEM];
  for (size_t i = 0; i < STEM; i++) {
    point[i] = (SbProfilePoint){1e-3 * stem[i][0], 1e-3 * stem[i][1], stem[i][2]};
  }
  const SbProfile profile = {point, STEM, false};
  SbSolid solid;
  SbReport report = {0};
  g_assert_cmpint(sb_solid_revolve(&solid, &profile, 1, &report), ==, SB_OK);
  return solid.volume;
}

// ---- Writing a DXF ----

void drawing_put(GString *dxf, int code, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *value = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  g_string_append_printf(dxf, "%3d\r\n%s\r\n", code, value);
}

GString *drawing_begin(int unit) {
  GString *dxf = g_string_new(NULL);
  drawing_put(dxf, 0, "SECTION");
  drawing_put(dxf, 2, "HEADER");
  drawing_put(dxf, 9, "$ACADVER");
  drawing_put(dxf, 1, "AC1015");
  drawing_put(dxf, 9, "$INSUNITS");
  drawing_put(dxf, 70, "%d", unit);
  drawing_put(dxf, 0, "ENDSEC");
  drawing_put(dxf, 0, "SECTION");
  drawing_put(dxf, 2, "ENTITIES");
  return dxf;
}

void drawing_end(GString *dxf) {
  drawing_put(dxf, 0, "ENDSEC");
  drawing_put(dxf, 0, "EOF");
}

void drawing_move(const DrawingPlace *place, double *x, double *y) {
  const double u = *x, v = *y;
  *x = place->x + u * cos(place->angle) - v * sin(place->angle);
  *y = place->y + u * sin(place->angle) + v * cos(place->angle);
}

void drawing_line(GString *dxf, const char *layer, double x0, double y0, double x1, double y1) {
  drawing_put(dxf, 0, "LINE");
  drawing_put(dxf, 8, "%s", layer);
  drawing_put(dxf, 10, "%.15g", x0);
  drawing_put(dxf, 20, "%.15g", y0);
  drawing_put(dxf, 11, "%.15g", x1);
  drawing_put(dxf, 21, "%.15g", y1);
}

void drawing_arc(GString *dxf, const char *layer, double x0, double y0, double x1, double y1,
                 double bulge) {
  const double c = (1 - bulge * bulge) / (4 * bulge), r = hypot(x1 - x0, y1 - y0);
  const double cx = (x0 + x1) / 2 - (y1 - y0) * c, cy = (y0 + y1) / 2 + (x1 - x0) * c;
  const double start = atan2(y0 - cy, x0 - cx) * 180 / M_PI;
  const double stop = atan2(y1 - cy, x1 - cx) * 180 / M_PI;
  drawing_put(dxf, 0, "ARC");
  drawing_put(dxf, 8, "%s", layer);
  drawing_put(dxf, 10, "%.15g", cx);
  drawing_put(dxf, 20, "%.15g", cy);
  drawing_put(dxf, 40, "%.15g", r * (1 + bulge * bulge) / (4 * fabs(bulge)));
  drawing_put(dxf, 50, "%.15g", bulge > 0 ? start : stop);
  drawing_put(dxf, 51, "%.15g", bulge > 0 ? stop : start);
}

void drawing_stem(GString *dxf, const DrawingPlace *place, double scale, int side) {
  for (size_t k = 0; k + 1 < STEM; k++) {
    const size_t i = (k * 7) % (STEM - 1);
    double x0 = scale * stem[i][0], y0 = side * scale * stem[i][1];
    double x1 = scale * stem[i + 1][0], y1 = side * scale * stem[i + 1][1];
    drawing_move(place, &x0, &y0);
    drawing_move(place, &x1, &y1);
    if (stem[i][2] != 0) {
      drawing_arc(dxf, "Stem centre", x0, y0, x1, y1, side * stem[i][2]);
    } else if (k % 2 == 0) {
      drawing_line(dxf, "Stem centre", x0, y0, x1, y1);
    } else {
      drawing_line(dxf, "Stem centre", x1, y1, x0, y0);
    }
  }
}

SbCad *drawing_parse(const GString *dxf, const SbCadChoices *choices) {
  GError *error = NULL;
  SbCad *cad = sb_cad_parse_dxf(dxf->str, dxf->len, "a.dxf", choices, &error);
  g_assert_no_error(error);
  return cad;
}

// ---- What is read ----

static void check_stem(const SbCadBody *body, double tolerance) {
  static const SbCadFeature expected[] = {
      {-0.5, 1.1, 1.8, 0, SB_CAD_BORE},        {-0.3, 0, 5.794, 0, SB_CAD_LAND},
      {0, 2, 3.28, 1.257, SB_CAD_GROOVE},      {2, 2.65, 5.794, 0, SB_CAD_LAND},
      {2.65, 5.55, 4.1, 0.847, SB_CAD_GROOVE}, {5.55, 6.2, 5.794, 0, SB_CAD_LAND},
      {6.2, 8.2, 3.28, 1.257, SB_CAD_GROOVE},  {7.5, 9.3, 1.8, 0, SB_CAD_BORE},
      {8.2, 9.1, 5.794, 0, SB_CAD_LAND}};
  g_assert_cmpstr(body->why, ==, NULL);
  g_assert_cmpfloat_with_epsilon(body->solid.volume / drawing_stem_volume(), 1, tolerance);
  g_assert_cmpuint(body->profile->len, ==, STEM);
  g_assert_cmpuint(body->features->len, ==, G_N_ELEMENTS(expected));
  for (size_t i = 0; i < G_N_ELEMENTS(expected); i++) {
    const SbCadFeature *f = &g_array_index(body->features, SbCadFeature, i);
    const SbCadFeature *e = &expected[i];
    g_assert_cmpint(f->kind, ==, e->kind);
    g_assert_cmpfloat_with_epsilon(f->x0, 1e-3 * e->x0, 1e-9);
    g_assert_cmpfloat_with_epsilon(f->x1, 1e-3 * e->x1, 1e-9);
    g_assert_cmpfloat_with_epsilon(f->diameter, 1e-3 * e->diameter, 1e-9);
    g_assert_cmpfloat_with_epsilon(f->depth, 1e-3 * e->depth, 1e-9);
  }
}

void drawing_check_stem_alone(const SbCad *cad, const char *warning) {
  g_assert_cmpuint(cad->bodies->len, ==, 1);
  const SbCadBody *body = cad->bodies->pdata[0];
  g_assert_cmpstr(body->name, ==, "Stem centre");
  check_stem(body, 1e-9);
  g_assert_cmpuint(cad->warnings->len, ==, 1);
  g_assert_cmpstr(cad->warnings->pdata[0], ==, warning);
}
