// Drawings: outlines of a DXF as half-sections, the lands, bores and grooves on them, a scene
// shaped by them, and what is refused.
#include "app/cad/cad_private.h"
#include "app/document/cad_parts.h"

#include "app/base/error.h"

#include <math.h>
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

// Its volume, from the engine [m3].
static double stem_volume(void) {
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

typedef struct {
  double x, y, angle; // where the drawing's own origin and axis lie
} Place;

static void put(GString *dxf, int code, const char *format, ...) G_GNUC_PRINTF(3, 4);
static void put(GString *dxf, int code, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *value = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  g_string_append_printf(dxf, "%3d\r\n%s\r\n", code, value);
}

static GString *begin(int unit) {
  GString *dxf = g_string_new(NULL);
  put(dxf, 0, "SECTION");
  put(dxf, 2, "HEADER");
  put(dxf, 9, "$ACADVER");
  put(dxf, 1, "AC1015");
  put(dxf, 9, "$INSUNITS");
  put(dxf, 70, "%d", unit);
  put(dxf, 0, "ENDSEC");
  put(dxf, 0, "SECTION");
  put(dxf, 2, "ENTITIES");
  return dxf;
}

static void end(GString *dxf) {
  put(dxf, 0, "ENDSEC");
  put(dxf, 0, "EOF");
}

static void move(const Place *place, double *x, double *y) {
  const double u = *x, v = *y;
  *x = place->x + u * cos(place->angle) - v * sin(place->angle);
  *y = place->y + u * sin(place->angle) + v * cos(place->angle);
}

static void put_line(GString *dxf, const char *layer, double x0, double y0, double x1, double y1) {
  put(dxf, 0, "LINE");
  put(dxf, 8, "%s", layer);
  put(dxf, 10, "%.15g", x0);
  put(dxf, 20, "%.15g", y0);
  put(dxf, 11, "%.15g", x1);
  put(dxf, 21, "%.15g", y1);
}

// An arc from one end to the other; CAD knows counter-clockwise ones only.
static void put_arc(GString *dxf, const char *layer, double x0, double y0, double x1, double y1,
                    double bulge) {
  const double c = (1 - bulge * bulge) / (4 * bulge), r = hypot(x1 - x0, y1 - y0);
  const double cx = (x0 + x1) / 2 - (y1 - y0) * c, cy = (y0 + y1) / 2 + (x1 - x0) * c;
  const double start = atan2(y0 - cy, x0 - cx) * 180 / M_PI;
  const double stop = atan2(y1 - cy, x1 - cx) * 180 / M_PI;
  put(dxf, 0, "ARC");
  put(dxf, 8, "%s", layer);
  put(dxf, 10, "%.15g", cx);
  put(dxf, 20, "%.15g", cy);
  put(dxf, 40, "%.15g", r * (1 + bulge * bulge) / (4 * fabs(bulge)));
  put(dxf, 50, "%.15g", bulge > 0 ? start : stop);
  put(dxf, 51, "%.15g", bulge > 0 ? stop : start);
}

// The stem's outline as lines and arcs, in no order; side -1: below the axis.
static void put_stem(GString *dxf, const Place *place, double scale, int side) {
  for (size_t k = 0; k + 1 < STEM; k++) {
    const size_t i = (k * 7) % (STEM - 1);
    double x0 = scale * stem[i][0], y0 = side * scale * stem[i][1];
    double x1 = scale * stem[i + 1][0], y1 = side * scale * stem[i + 1][1];
    move(place, &x0, &y0);
    move(place, &x1, &y1);
    if (stem[i][2] != 0) {
      put_arc(dxf, "Stem centre", x0, y0, x1, y1, side * stem[i][2]);
    } else if (k % 2 == 0) {
      put_line(dxf, "Stem centre", x0, y0, x1, y1);
    } else {
      put_line(dxf, "Stem centre", x1, y1, x0, y0);
    }
  }
}

static SbCad *parse(const GString *dxf, const SbCadChoices *choices) {
  GError *error = NULL;
  SbCad *cad = sb_cad_parse_dxf(dxf->str, dxf->len, "a.dxf", choices, &error);
  g_assert_no_error(error);
  return cad;
}

// ---- What is read ----

static void check_stem(const SbCadBody *body, double tolerance) {
  static const SbCadFeature expected[] = {
      {SB_CAD_BORE, -0.5, 1.1, 1.8, 0},        {SB_CAD_LAND, -0.3, 0, 5.794, 0},
      {SB_CAD_GROOVE, 0, 2, 3.28, 1.257},      {SB_CAD_LAND, 2, 2.65, 5.794, 0},
      {SB_CAD_GROOVE, 2.65, 5.55, 4.1, 0.847}, {SB_CAD_LAND, 5.55, 6.2, 5.794, 0},
      {SB_CAD_GROOVE, 6.2, 8.2, 3.28, 1.257},  {SB_CAD_BORE, 7.5, 9.3, 1.8, 0},
      {SB_CAD_LAND, 8.2, 9.1, 5.794, 0}};
  g_assert_cmpstr(body->why, ==, NULL);
  g_assert_cmpfloat_with_epsilon(body->solid.volume / stem_volume(), 1, tolerance);
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

static void check_stem_alone(const SbCad *cad, const char *warning) {
  g_assert_cmpuint(cad->bodies->len, ==, 1);
  const SbCadBody *body = cad->bodies->pdata[0];
  g_assert_cmpstr(body->name, ==, "Stem centre");
  check_stem(body, 1e-9);
  g_assert_cmpuint(cad->warnings->len, ==, 1);
  g_assert_cmpstr(cad->warnings->pdata[0], ==, warning);
}

// ---- Blocks ----

static GString *begin_blocks(void) {
  GString *dxf = begin(4);
  // The section of the entities comes last.
  const char entities[] = "  0\r\nSECTION\r\n  2\r\nENTITIES\r\n";
  g_assert_true(g_str_has_suffix(dxf->str, entities));
  g_string_truncate(dxf, dxf->len - strlen(entities));
  put(dxf, 0, "SECTION");
  put(dxf, 2, "BLOCKS");
  return dxf;
}

static void begin_block(GString *dxf, const char *name, double x, double y) {
  put(dxf, 0, "BLOCK");
  put(dxf, 8, "0");
  put(dxf, 2, "%s", name);
  put(dxf, 10, "%.15g", x);
  put(dxf, 20, "%.15g", y);
}

static void begin_entities(GString *dxf) {
  put(dxf, 0, "ENDSEC");
  put(dxf, 0, "SECTION");
  put(dxf, 2, "ENTITIES");
}

static void put_insert(GString *dxf, const char *name, double x, double y, double scale_x,
                       double scale_y, double turn) {
  put(dxf, 0, "INSERT");
  put(dxf, 8, "Stem centre");
  put(dxf, 2, "%s", name);
  put(dxf, 10, "%.15g", x);
  put(dxf, 20, "%.15g", y);
  put(dxf, 41, "%.15g", scale_x);
  put(dxf, 42, "%.15g", scale_y);
  put(dxf, 50, "%.15g", turn);
}

// The stem drawn once in a block, at half size, off its place, below the axis and turned, within
// another block that is turned back and mirrored: the same body.
static void test_blocks(void) {
  const SbCadChoices none = {0};
  g_autoptr(GString) dxf = begin_blocks();
  const Place off = {1, 2, 0};
  begin_block(dxf, "OUTER", 0, 0);
  put_insert(dxf, "STEM", 3, 4, 2, -2, 30); // used before it is defined
  put(dxf, 0, "ENDBLK");
  begin_block(dxf, "STEM", 1, 2);
  put_stem(dxf, &off, 0.5, -1);
  put(dxf, 0, "MTEXT");
  put(dxf, 8, "0");
  put(dxf, 0, "ENDBLK");
  begin_entities(dxf);
  // OUTER's point (3, 4) comes to the origin, its 30 degrees to none.
  const double c = cos(G_PI / 6), s = sin(G_PI / 6);
  put_insert(dxf, "OUTER", -(3 * c + 4 * s), -(4 * c - 3 * s), 1, 1, -30);
  put_insert(dxf, "NOWHERE", 0, 0, 1, 1, 0);
  end(dxf);
  g_autoptr(SbCad) cad = parse(dxf, &none);
  check_stem_alone(cad, "left out: 1 INSERT, 1 MTEXT");
}

// A circle that is stretched to an ellipse is revolved to a torus of its area; a row of them.
static void test_stretched_block(void) {
  const SbCadChoices none = {0};
  g_autoptr(GString) dxf = begin_blocks();
  begin_block(dxf, "O", 0, 0);
  put(dxf, 0, "CIRCLE");
  put(dxf, 8, "0");
  put(dxf, 10, "0");
  put(dxf, 20, "0");
  put(dxf, 40, "1");
  put(dxf, 0, "ENDBLK");
  begin_entities(dxf);
  put_insert(dxf, "O", 0, 5, 2, 0.5, 90);
  put(dxf, 70, "3");
  put(dxf, 45, "0");
  put(dxf, 44, "10");
  end(dxf);
  g_autoptr(SbCad) cad = parse(dxf, &none);
  g_assert_cmpuint(cad->bodies->len, ==, 3); // turned by 90 degrees, columns go outwards
  double volume = 0;
  for (guint i = 0; i < 3; i++) {
    const SbCadBody *body = cad->bodies->pdata[i];
    g_assert_cmpstr(body->why, ==, NULL);
    volume += body->solid.volume;
  }
  g_assert_cmpfloat_with_epsilon(volume / (2 * G_PI * G_PI * (5 + 15 + 25) * 1e-9), 1, 1e-4);
}

static void test_hostile_blocks(void) {
  static const char *const nested[] = {"A", "B"};
  const SbCadChoices none = {0};
  for (int kind = 0; kind < 2; kind++) {
    g_autoptr(GError) error = NULL;
    g_autoptr(GString) dxf = begin_blocks();
    if (kind == 0) { // two blocks that hold each other
      for (int i = 0; i < 2; i++) {
        begin_block(dxf, nested[i], 0, 0);
        put_insert(dxf, nested[1 - i], 0, 0, 1, 1, 0);
        put(dxf, 0, "ENDBLK");
      }
    } else { // each holds thirty of the next
      for (int i = 0; i < 7; i++) {
        g_autofree char *name = g_strdup_printf("%c", 'A' + i);
        g_autofree char *next = g_strdup_printf("%c", 'B' + i);
        begin_block(dxf, name, 0, 0);
        for (int k = 0; k < 30; k++) {
          put_insert(dxf, next, 0, 0, 1, 1, 0);
        }
        put(dxf, 0, "ENDBLK");
      }
      begin_block(dxf, "H", 0, 0);
      put(dxf, 0, "ENDBLK");
    }
    begin_entities(dxf);
    put_insert(dxf, "A", 0, 0, 1, 1, 0);
    end(dxf);
    SbCad *cad = sb_cad_parse_dxf(dxf->str, dxf->len, "a.dxf", &none, &error);
    g_assert_null(cad);
    g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
    g_assert_nonnull(
        strstr(error->message, kind == 0 ? "nested more than 8 deep" : "blocks place more"));
  }
}

// ---- Meshes ----

// A shaft with a groove, 6 mm long, revolved in 48 facets about the file's z at (10, -3), as a
// binary STL in millimetres or, by `scale`, another unit.
static GByteArray *shaft_mesh(double scale, bool slotted) {
  enum { N = 48, P = 8 };
  static const double outline[P][2] = {{0, 0},   {0, 2.5}, {2, 2.5}, {2, 1.6},
                                       {4, 1.6}, {4, 2.5}, {6, 2.5}, {6, 0}};
  GByteArray *out = g_byte_array_new();
  const guint32 count = N * 2 * (P - 2);
  guint8 head[80] = "binary";
  g_byte_array_append(out, head, sizeof head);
  g_byte_array_append(out, (const guint8 *)&count, 4);
  for (int k = 0; k < N; k++) {
    for (int i = 0; i + 1 < P; i++) {
      float v[4][3];
      for (int c = 0; c < 4; c++) {
        const double *p = outline[i + c % 2];
        const double angle = 0.1 + 2 * G_PI * (k + c / 2) / N;
        const double r = slotted && (k + c / 2) % (N / 2) < 6 ? 0.6 * p[1] : p[1];
        v[c][0] = (float)(scale * (10 + r * cos(angle)));
        v[c][1] = (float)(scale * (-3 + r * sin(angle)));
        v[c][2] = (float)(scale * p[0]);
      }
      static const int facet[2][3] = {{0, 3, 1}, {0, 2, 3}};
      for (int f = 0; f < 2; f++) {
        if ((i == 0 && f == 1) || (i == P - 2 && f == 0)) {
          continue; // of a cap, which has one facet
        }
        const float normal[3] = {0};
        const guint16 none = 0;
        g_byte_array_append(out, (const guint8 *)normal, sizeof normal);
        for (int c = 0; c < 3; c++) {
          g_byte_array_append(out, (const guint8 *)v[facet[f][c]], sizeof v[0]);
        }
        g_byte_array_append(out, (const guint8 *)&none, sizeof none);
      }
    }
  }
  return out;
}

static SbCad *parse_mesh(const GByteArray *mesh, const SbCadChoices *choices, GError **error) {
  return sb_cad_parse_stl((const char *)mesh->data, mesh->len, "parts/Stem-centre.stl", choices,
                          error);
}

// Its unit, axis, section and groove are found; mass is the mesh's, of chords.
static void test_mesh(void) {
  static const SbCadFeature expected[] = {
      {SB_CAD_LAND, 0, 2, 5, 0}, {SB_CAD_GROOVE, 2, 4, 3.2, 0.9}, {SB_CAD_LAND, 4, 6, 5, 0}};
  const SbCadChoices none = {0}, inch = {.unit = "inch"};
  for (int kind = 0; kind < 2; kind++) {
    g_autoptr(GError) error = NULL;
    g_autoptr(GByteArray) mesh = shaft_mesh(kind == 0 ? 1 : 1 / 25.4, false);
    g_assert_true(sb_cad_is_stl((const char *)mesh->data, mesh->len));
    g_autoptr(SbCad) cad = parse_mesh(mesh, kind == 0 ? &none : &inch, &error);
    g_assert_no_error(error);
    g_assert_cmpstr(cad->unit, ==, kind == 0 ? "mm" : "inch");
    g_assert_cmpstr(cad->axis, ==, "along 0, 0, 1");
    for (guint i = 0; i < cad->warnings->len; i++) {
      g_test_message("%s", (const char *)cad->warnings->pdata[i]);
    }
    g_assert_cmpuint(cad->warnings->len, ==, kind == 0);
    g_assert_cmpuint(cad->bodies->len, ==, 1);
    const SbCadBody *body = cad->bodies->pdata[0];
    g_assert_cmpstr(body->name, ==, "Stem-centre");
    g_assert_cmpstr(body->why, ==, NULL);
    g_assert_cmpuint(body->profile->len, ==, 8);
    const double volume = G_PI * (4 * 2.5 * 2.5 + 2 * 1.6 * 1.6) * 1e-9;
    const double chords = 48 / (2 * G_PI) * sin(2 * G_PI / 48);
    g_assert_cmpfloat_with_epsilon(body->revolved.volume / volume, 1, 1e-5);
    g_assert_cmpfloat_with_epsilon(body->solid.volume / (volume * chords), 1, 1e-5);
    g_assert_cmpfloat_with_epsilon(body->solid.centre[0], 3e-3, 1e-8);
    g_assert_cmpuint(body->features->len, ==, G_N_ELEMENTS(expected));
    for (size_t i = 0; i < G_N_ELEMENTS(expected); i++) {
      const SbCadFeature *f = &g_array_index(body->features, SbCadFeature, i);
      g_assert_cmpint(f->kind, ==, expected[i].kind);
      g_assert_cmpfloat_with_epsilon(f->x0, 1e-3 * expected[i].x0, 1e-7);
      g_assert_cmpfloat_with_epsilon(f->diameter, 1e-3 * expected[i].diameter, 1e-6);
      g_assert_cmpfloat_with_epsilon(f->depth, 1e-3 * expected[i].depth, 1e-6);
    }
  }
}

// Appends the facets of a mesh to another, scaled about the point (10, -3, 3) that shaft_mesh()
// turns about, moved along z, and inside out where `scale` is negative.
static void add_mesh(GByteArray *mesh, const GByteArray *other, double scale, double along) {
  static const double about[3] = {10, -3, 3};
  guint32 count[2];
  memcpy(&count[0], mesh->data + 80, 4);
  memcpy(&count[1], other->data + 80, 4);
  for (guint32 f = 0; f < count[1]; f++) {
    guint8 facet[50];
    memcpy(facet, other->data + 84 + 50 * (gsize)f, sizeof facet);
    for (int c = 0; c < 3; c++) {
      float v[3];
      memcpy(v, other->data + 84 + 50 * (gsize)f + 12 + 12 * (scale < 0 ? 2 - c : c), sizeof v);
      for (int k = 0; k < 3; k++) {
        v[k] = (float)(about[k] + fabs(scale) * ((double)v[k] - about[k]) + (k == 2) * along);
      }
      memcpy(facet + 12 + 12 * c, v, sizeof v);
    }
    g_byte_array_append(mesh, facet, sizeof facet);
  }
  count[0] += count[1];
  memcpy(mesh->data + 80, &count[0], 4);
}

// Each shell is a body with its own volume; a cavity belongs to the body around it, whatever the
// half-plane shows of it.
static void test_mesh_shells(void) {
  const SbCadChoices none = {.unit = "mm"};
  const double angle = 0.4, through[3] = {10e-3, -3e-3, 0}, axis[3] = {0, 0, 2};
  const SbCadChoices given = {.unit = "mm", .angle = &angle, .through = through, .axis = axis};
  g_autoptr(GByteArray) mesh = shaft_mesh(1, false), slotted = shaft_mesh(1, true);
  g_autoptr(GByteArray) one = shaft_mesh(1, false);
  GError *error = NULL;
  add_mesh(mesh, one, 1, 8);
  add_mesh(mesh, one, -0.4, 8);
  g_autoptr(SbCad) alone = parse_mesh(one, &none, &error);
  g_autoptr(SbCad) cad = parse_mesh(mesh, &none, &error);
  g_assert_no_error(error);
  g_assert_cmpuint(cad->bodies->len, ==, 2);
  const SbSolid *whole = &((SbCadBody *)alone->bodies->pdata[0])->solid;
  for (int i = 0; i < 2; i++) {
    const SbCadBody *body = cad->bodies->pdata[i];
    g_assert_true(body->measured);
    g_assert_cmpfloat_with_epsilon(body->solid.volume / whole->volume,
                                   i == 0 ? 1 : 1 - 0.4 * 0.4 * 0.4, 1e-5);
    g_assert_cmpfloat_with_epsilon(body->solid.centre[0], i == 0 ? 3e-3 : 11e-3, 1e-7);
    g_assert_cmpfloat_with_epsilon(body->solid.inertia[0][0] / whole->inertia[0][0],
                                   i == 0 ? 1 : 1 - pow(0.4, 5), 1e-5);
    g_assert_cmpfloat_with_epsilon(body->revolved.volume / whole->volume, 1, 0.01);
  }
  // The half-plane through a slot, and that next to it; the mass is the same.
  g_autoptr(SbCad) next = parse_mesh(slotted, &none, &error);
  g_autoptr(SbCad) slot = parse_mesh(slotted, &given, &error);
  g_assert_no_error(error);
  const SbCadBody *a = next->bodies->pdata[0], *b = slot->bodies->pdata[0];
  g_assert_cmpfloat_with_epsilon(a->solid.volume / b->solid.volume, 1, 1e-9);
  g_assert_cmpfloat_with_epsilon(a->revolved.volume / whole->volume, 1, 0.01);
  g_assert_cmpfloat_with_epsilon(b->revolved.volume / whole->volume, 0.36, 0.01);
  g_assert_cmpstr(slot->axis, ==, "through 10, -3, 0 mm along 0, 0, 1");
}

// What is no body of revolution is told; a size that could be two units is asked about; broken
// meshes are refused.
static void test_mesh_refused(void) {
  const SbCadChoices none = {0};
  g_autoptr(GError) error = NULL;
  g_autoptr(GByteArray) slotted = shaft_mesh(1, true), small = shaft_mesh(0.2, false);
  g_autoptr(SbCad) cad = parse_mesh(slotted, &none, &error);
  g_assert_no_error(error);
  g_assert_true(g_str_has_prefix(cad->warnings->pdata[1], "Stem-centre: not a body of revolution"));
  g_assert_null(parse_mesh(small, &none, &error));
  g_assert_cmpstr(error->message, ==,
                  "parts/Stem-centre.stl: an STL file states no unit, and its longest side of 1.2 "
                  "is 1.2 mm in mm, 12 mm in cm, 30.5 mm in inch: specify it with --unit");
  g_clear_error(&error);
  // A facet is missing: open.
  const guint32 fewer = slotted->data[80] - 1U + 256U * slotted->data[81];
  memcpy(slotted->data + 80, &fewer, 4);
  g_byte_array_set_size(slotted, slotted->len - 50);
  g_assert_null(parse_mesh(slotted, &none, &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
}

// ---- Sections ----

// A half-section above the axis, below it, a whole section, and one about a centre line anywhere,
// in inches: all the same body.
static void test_sections(void) {
  const SbCadChoices none = {0};
  const Place plain = {0, 0, 0};
  for (int kind = 0; kind < 4; kind++) {
    const double scale = kind == 3 ? 1 / 25.4 : 1;
    // Along its own line a drawing begins where the line is nearest to the origin: across it lies
    // off.
    const Place off = {-3 * sin(0.5), 3 * cos(0.5), 0.5};
    const Place *place = kind == 3 ? &off : &plain;
    g_autoptr(GString) dxf = begin(kind == 3 ? 1 : 4);
    if (kind != 1) {
      put_stem(dxf, place, scale, 1);
    }
    if (kind == 1 || kind == 2) {
      put_stem(dxf, place, scale, -1);
    }
    if (kind == 3) {
      double x0 = -1, y0 = 0, x1 = 2, y1 = 0;
      move(place, &x0, &y0);
      move(place, &x1, &y1);
      put_line(dxf, "AXIS", x0, y0, x1, y1);
    }
    put(dxf, 0, "TEXT");
    put(dxf, 1, "scale 10 : 1");
    end(dxf);
    g_autoptr(SbCad) cad = parse(dxf, &none);
    check_stem_alone(cad, "left out: 1 TEXT");
  }
}

// The other way round and moved: from the other end, at another place.
static void test_flip(void) {
  const Place plain = {0, 0, 0};
  const SbCadChoices flip = {.flip = true, .shift = 8.8e-3};
  g_autoptr(GString) dxf = begin(4);
  put_stem(dxf, &plain, 1, 1);
  end(dxf);
  g_autoptr(SbCad) cad = parse(dxf, &flip);
  const SbCadBody *body = cad->bodies->pdata[0];
  g_assert_cmpfloat_with_epsilon(body->solid.volume / stem_volume(), 1, 1e-9);
  const SbCadFeature *f = &g_array_index(body->features, SbCadFeature, 1);
  g_assert_cmpint(f->kind, ==, SB_CAD_LAND);
  g_assert_cmpfloat_with_epsilon(f->x0, -0.3e-3, 1e-9);
  g_assert_cmpfloat_with_epsilon(f->x1, 0.6e-3, 1e-9);
}

// A ring as a polyline with bulges, on the plane's back; an ellipse and a circle as splines.
static void test_curves(void) {
  const SbCadChoices millimetres = {.unit = "mm"};
  g_autoptr(GString) dxf = begin(0);
  put(dxf, 0, "LWPOLYLINE");
  put(dxf, 8, "ring");
  put(dxf, 70, "1");
  put(dxf, 10, "-1");
  put(dxf, 20, "3");
  put(dxf, 42, "1");
  put(dxf, 10, "-2");
  put(dxf, 20, "3");
  put(dxf, 42, "1");
  put(dxf, 230, "-1");
  put(dxf, 0, "ELLIPSE");
  put(dxf, 8, "spheroid");
  put(dxf, 10, "5");
  put(dxf, 20, "0");
  put(dxf, 11, "2");
  put(dxf, 21, "0");
  put(dxf, 40, "0.5");
  put(dxf, 41, "0");
  put(dxf, 42, "3.141592653589793");
  // A quarter of a circle of radius 2 as a rational quadratic, closed by two lines.
  put(dxf, 0, "SPLINE");
  put(dxf, 8, "quarter");
  put(dxf, 71, "2");
  for (int i = 0; i < 6; i++) {
    put(dxf, 40, "%d", i / 3);
  }
  static const double control[3][3] = {{2, 1, 1}, {2, 3, M_SQRT1_2}, {0, 3, 1}};
  for (int i = 0; i < 3; i++) {
    put(dxf, 10, "%.15g", control[i][0]);
    put(dxf, 20, "%.15g", control[i][1]);
    put(dxf, 41, "%.15g", control[i][2]);
  }
  put_line(dxf, "quarter", 0, 3, 0, 1);
  put_line(dxf, "quarter", 0, 1, 2, 1);
  end(dxf);
  g_autoptr(SbCad) cad = parse(dxf, &millimetres);
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

// ---- Habits of other programs ----

// The square 2 <= x <= 4, 1 <= y <= 3 as four lines, of which `first` is written first.
static void put_square(GString *dxf, const char *layer, int first) {
  static const double corner[4][2] = {{2, 1}, {4, 1}, {4, 3}, {2, 3}};
  for (int i = 0; i < 4; i++) {
    const double *p = corner[(first + i) % 4], *q = corner[(first + i + 1) % 4];
    put_line(dxf, layer, p[0], p[1], q[0], q[1]);
  }
}

static void check_square(const SbCad *cad, guint warnings) {
  g_assert_cmpuint(cad->bodies->len, ==, 1);
  const SbCadBody *body = cad->bodies->pdata[0];
  g_assert_cmpstr(body->why, ==, NULL);
  g_assert_cmpfloat_with_epsilon(1e9 * body->solid.volume / (M_PI * 8 * 2), 1, 1e-9);
  g_assert_cmpuint(cad->warnings->len, ==, warnings);
}

// Only entities in object coordinates are mirrored by an extrusion towards -z; the minor axis of an
// ellipse is reversed by it.
static void test_coordinates(void) {
  const SbCadChoices none = {0};
  // Type and flags, and the middle of the body where it is drawn with its own middle at x = 5 mm.
  static const struct {
    const char *type;
    double flags, middle;
  } cases[] = {{"ELLIPSE", 0, 5}, {"CIRCLE", 0, -5},   {"LWPOLYLINE", 1, -5},
               {"LINE", 0, 5},    {"POLYLINE", 1, -5}, {"POLYLINE", 1 | 8, 5}};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    static const double corner[5][2] = {{4, 2}, {6, 2}, {6, 4}, {4, 4}, {4, 2}};
    const bool line = strcmp(cases[i].type, "LINE") == 0;
    const bool poly = strcmp(cases[i].type, "POLYLINE") == 0;
    const bool light = strcmp(cases[i].type, "LWPOLYLINE") == 0;
    g_autoptr(GString) dxf = begin(4);
    for (int k = 0; k < (line ? 4 : 1); k++) {
      put(dxf, 0, "%s", cases[i].type);
      put(dxf, 70, "%g", cases[i].flags);
      put(dxf, 230, "-1");
      if (line) {
        put(dxf, 10, "%g", corner[k][0]);
        put(dxf, 20, "%g", corner[k][1]);
        put(dxf, 11, "%g", corner[k + 1][0]);
        put(dxf, 21, "%g", corner[k + 1][1]);
      } else if (!poly && !light) {
        put(dxf, 10, "5");
        put(dxf, 20, "3");
        put(dxf, 40, "%g", i == 0 ? 0.5 : 1);
        put(dxf, 11, "2");
        put(dxf, 21, "0");
        put(dxf, 41, "0");
        put(dxf, 42, "6.283185307179586");
      } else {
        put(dxf, 30, "0");
      }
      for (int c = 0; (poly || light) && c < 4; c++) {
        if (poly) {
          put(dxf, 0, "VERTEX");
          put(dxf, 70, "32");
        }
        put(dxf, 10, "%g", corner[c][0]);
        put(dxf, 20, "%g", corner[c][1]);
      }
      if (poly) {
        put(dxf, 0, "SEQEND");
      }
    }
    end(dxf);
    g_autoptr(SbCad) cad = parse(dxf, &none);
    g_assert_cmpuint(cad->bodies->len, ==, 1);
    const SbCadBody *body = cad->bodies->pdata[0];
    g_assert_cmpfloat_with_epsilon(body->solid.centre[0], 1e-3 * cases[i].middle, 1e-10);
    const double area = i == 0 ? 2 * M_PI : i == 1 ? M_PI : 4; // about r = 3 mm, by Pappus
    g_assert_cmpfloat_with_epsilon(1e9 * body->solid.volume / (6 * M_PI * area), 1, 1e-4);
  }
  // Half an ellipse from its major axis on, anticlockwise about the extrusion: below the centre.
  for (int up = -1; up <= 1; up += 2) {
    g_autoptr(GString) dxf = begin(4);
    put(dxf, 0, "ELLIPSE");
    put(dxf, 10, "5");
    put(dxf, 20, "3");
    put(dxf, 11, "2");
    put(dxf, 230, "%d", up);
    put(dxf, 40, "0.5");
    put(dxf, 42, "3.141592653589793");
    put_line(dxf, "0", 3, 3, 7, 3);
    end(dxf);
    g_autoptr(SbCad) cad = parse(dxf, &none);
    const SbCadBody *body = cad->bodies->pdata[0];
    const double middle = 3 + up * 4 / (3 * M_PI);
    g_assert_cmpfloat_with_epsilon(1e9 * body->solid.volume / (2 * M_PI * middle * M_PI), 1, 1e-4);
  }
}

// A spline is divided at its knots, so corners are exact, also where a span has no length; what is
// not in model space, not seen or has only fit points is named.
static void test_spline_corners(void) {
  const SbCadChoices none = {0};
  static const double corner[6][2] = {{2, 1}, {4, 1}, {4, 1}, {4, 3}, {2, 3}, {2, 1}};
  for (int degree = 1; degree <= 3; degree++) {
    g_autoptr(GString) dxf = begin(4);
    put(dxf, 0, "SPLINE");
    put(dxf, 71, "%d", degree);
    for (int k = 0; k < 6; k++) {
      for (int i = 0; i < degree + (k == 0 || k == 5); i++) {
        put(dxf, 40, "%g", 0.7 * k * k); // of unequal length
      }
    }
    for (int i = 0; i <= 5 * degree; i++) {
      const double *p = corner[i / degree], *q = corner[MIN(i / degree + 1, 5)];
      const double t = i % degree / (double)degree;
      put(dxf, 10, "%.15g", p[0] + t * (q[0] - p[0]));
      put(dxf, 20, "%.15g", p[1] + t * (q[1] - p[1]));
    }
    end(dxf);
    g_autoptr(SbCad) cad = parse(dxf, &none);
    check_square(cad, 0);
  }
}

static void test_left_out(void) {
  const SbCadChoices none = {0};
  g_autoptr(GString) dxf = begin(4);
  const gsize at = (gsize)(strstr(dxf->str, "  0\r\nSECTION\r\n  2\r\nENTITIES") - dxf->str);
  g_autoptr(GString) tables = g_string_new(NULL);
  put(tables, 0, "SECTION");
  put(tables, 2, "TABLES");
  for (int i = 0; i < 2; i++) {
    put(tables, 0, "LAYER");
    put(tables, 2, "%s", i == 0 ? "Sketch" : "FRAME");
    put(tables, i == 0 ? 62 : 70, "%d", i == 0 ? -7 : 1);
  }
  put(tables, 0, "ENDSEC");
  g_string_insert(dxf, (gssize)at, tables->str);
  put_square(dxf, "part", 0);
  for (int i = 0; i < 4; i++) {
    put_line(dxf, i == 0 ? "SKETCH" : i == 1 ? "frame" : "part", 0, 0, 9, 9);
    put(dxf, i == 2 ? 67 : 60, "%d", i >= 2);
  }
  put(dxf, 0, "SPLINE");
  put(dxf, 8, "part");
  put(dxf, 71, "3");
  put(dxf, 11, "1");
  put(dxf, 21, "1");
  put(dxf, 0, "CIRCLE");
  put(dxf, 40, "1");
  put(dxf, 210, "1");
  put(dxf, 230, "0");
  end(dxf);
  g_autoptr(SbCad) cad = parse(dxf, &none);
  check_square(cad, 1);
  g_assert_cmpstr(cad->warnings->pdata[0], ==,
                  "left out: 1 CIRCLE out of the drawing's plane, 1 LINE in paper space, 1 LINE on "
                  "layer 'SKETCH', which is off, 1 LINE on layer 'frame', which is frozen, 1 LINE "
                  "that is invisible, 1 SPLINE with fit points only");
}

// Lines drawn twice, also in part and the other way round, lines of no length, gaps, and circles
// that touch the axis.
static void test_untidy(void) {
  const SbCadChoices none = {0}, wide = {.join = 0.05e-3};
  for (int kind = 0; kind < 4; kind++) {
    g_autoptr(GString) dxf = begin(4);
    if (kind == 3) {
      put_line(dxf, "0", 2, 1, 4, 1);
      put_line(dxf, "0", 4, 1.04, 4, 3);
      put_line(dxf, "0", 3.97, 3, 2, 3);
      put_line(dxf, "0", 2, 3, 2, 1);
    } else {
      put_square(dxf, "0", kind);
    }
    if (kind == 0) {
      put_line(dxf, "0", 4, 3, 4, 1);
      put_line(dxf, "0", 4, 3, 4, 3);
    } else if (kind == 1) { // the part of one side, and one that is longer than a side's half
      put_line(dxf, "0", 2, 2.5, 2, 1);
      put_line(dxf, "0", 4, 2, 4, 3);
      put_line(dxf, "0", 4, 2.5, 4, 1);
    }
    end(dxf);
    GError *error = NULL;
    if (kind == 3) {
      g_assert_null(sb_cad_parse_dxf(dxf->str, dxf->len, "a.dxf", &none, &error));
      g_assert_nonnull(strstr(error->message, "ends are up to 0.04 mm apart"));
      g_error_free(error);
      g_autoptr(SbCad) cad = parse(dxf, &wide);
      g_assert_cmpuint(cad->bodies->len, ==, 1);
      const SbCadBody *body = cad->bodies->pdata[0];
      g_assert_cmpfloat_with_epsilon(1e9 * body->solid.volume / (M_PI * 16), 1, 0.03);
    } else {
      g_autoptr(SbCad) cad = parse(dxf, &none);
      check_square(cad, kind < 2);
    }
  }
  for (int twice = 0; twice < 2; twice++) {
    g_autoptr(GString) dxf = begin(4);
    for (int i = 0; i <= twice; i++) {
      put(dxf, 0, i == 0 ? "CIRCLE" : "ARC");
      put(dxf, 10, "5");
      put(dxf, 20, "3");
      put(dxf, 40, "3");
      put(dxf, 50, "30");
      put(dxf, 51, "300");
    }
    end(dxf);
    g_autoptr(SbCad) cad = parse(dxf, &none);
    g_assert_cmpuint(cad->bodies->len, ==, 1);
    const SbCadBody *body = cad->bodies->pdata[0];
    g_assert_cmpstr(body->why, ==, NULL);
    g_assert_cmpfloat_with_epsilon(1e9 * body->solid.volume / (2 * M_PI * 3 * M_PI * 9), 1, 1e-6);
  }
}

// All values of $INSUNITS, and a text whose lines end
// in a carriage return alone.
static void test_units(void) {
  static const double unit[] = {25.4e-3,      0.3048,        1609.344,
                                1e-3,         1e-2,          1,
                                1e3,          25.4e-9,       25.4e-6,
                                0.9144,       1e-10,         1e-9,
                                1e-6,         0.1,           10,
                                100,          1e9,           1.495979e11,
                                9.46073e15,   3.085678e16,   1200 / 3937.0,
                                100 / 3937.0, 3600 / 3937.0, 5280 * 1200 / 3937.0};
  const SbCadChoices none = {0};
  for (size_t i = 0; i < G_N_ELEMENTS(unit); i++) {
    g_autoptr(GString) dxf = begin((int)i + 1);
    const double size = 1e-3 / unit[i];
    for (int k = 0; k < 4; k++) {
      static const double corner[5][2] = {{0, 1}, {2, 1}, {2, 3}, {0, 3}, {0, 1}};
      put_line(dxf, "0", size * corner[k][0], size * corner[k][1], size * corner[k + 1][0],
               size * corner[k + 1][1]);
    }
    end(dxf);
    if (i % 2 == 0) {
      g_string_replace(dxf, "\n", "", 0);
    }
    g_autoptr(SbCad) cad = parse(dxf, &none);
    const SbCadBody *body = cad->bodies->pdata[0];
    g_test_message("%s", cad->unit);
    // udunits-2 rounds astronomical units to six or seven digits, and has no inch of the US survey.
    const double rounded = i >= 17 && i < 22 ? 7e-6 : 1e-9;
    g_assert_cmpfloat_with_epsilon(1e9 * body->solid.volume / (M_PI * 8 * 2), 1, rounded);
  }
}

// The drawing's sizes take the place of the scene's; everything else stays.
static void test_scene(void) {
  // At a place that no unit makes round.
  const SbCadChoices none = {.shift = 0.09627022e-3};
  const Place plain = {0, 0, 0};
  g_autoptr(GString) dxf = begin(4);
  put_stem(dxf, &plain, 1, 1);
  end(dxf);
  g_autoptr(SbCad) cad = parse(dxf, &none);
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
               {SB_P_PART_STEM_CENTRE_MASS, 1000 * stem_volume()}};
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
                  "there is no body 'block' for housing (give its number or name)");
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
       "a.dxf: states no unit ($INSUNITS): specify it with --unit"},
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
    g_error_free(error);
  }
  // Lines that close to nothing; a unit that is no length.
  g_autoptr(GString) open = begin(4);
  put_line(open, "0", 0, 1, 2, 3);
  put_line(open, "0", 2, 3, 4, 1);
  end(open);
  GError *error = NULL;
  g_assert_null(sb_cad_parse_dxf(open->str, open->len, "a.dxf", &millimetres, &error));
  g_assert_cmpstr(
      error->message, ==,
      "a.dxf: contains no closed outline; 0: 1 line that closes to no outline: ends are up "
      "to 4 mm apart");
  g_clear_error(&error);
  g_assert_null(sb_cad_parse_dxf(open->str, open->len, "a.dxf", &wrong, &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
  g_error_free(error);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/cad/blocks", test_blocks);
  g_test_add_func("/cad/blocks/stretched", test_stretched_block);
  g_test_add_func("/cad/blocks/hostile", test_hostile_blocks);
  g_test_add_func("/cad/mesh", test_mesh);
  g_test_add_func("/cad/mesh/shells", test_mesh_shells);
  g_test_add_func("/cad/mesh/refused", test_mesh_refused);
  g_test_add_func("/cad/coordinates", test_coordinates);
  g_test_add_func("/cad/spline-corners", test_spline_corners);
  g_test_add_func("/cad/left-out", test_left_out);
  g_test_add_func("/cad/untidy", test_untidy);
  g_test_add_func("/cad/units", test_units);
  g_test_add_func("/cad/sections", test_sections);
  g_test_add_func("/cad/flip", test_flip);
  g_test_add_func("/cad/curves", test_curves);
  g_test_add_func("/cad/scene", test_scene);
  g_test_add_func("/cad/refused", test_refused);
  return g_test_run();
}
