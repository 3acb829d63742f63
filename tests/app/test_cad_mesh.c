// STL meshes as bodies: unit, axis, section and shells, and what is refused.
#include "app/cad/cad_private.h"

#include "app/base/error.h"
#include "tests/app/choices.h"

#include <math.h>
#include <string.h>

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
      {0, 2, 5, 0, SB_CAD_LAND}, {2, 4, 3.2, 0.9, SB_CAD_GROOVE}, {4, 6, 5, 0, SB_CAD_LAND}};
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

// A body turned about y by 0.6 rad, revolved in 48 facets from an outline of (x, r): its axis is
// along (cos 0.6, 0, -sin 0.6).
static GByteArray *turned_mesh(const double (*outline)[2], int points) {
  enum { N = 48 };
  GByteArray *out = g_byte_array_new();
  guint8 head[84] = "binary";
  guint32 count = 0;
  g_byte_array_append(out, head, sizeof head);
  for (int k = 0; k < N; k++) {
    for (int i = 0; i + 1 < points; i++) {
      for (int f = 0; f < 2; f++) {
        if (outline[i + f][1] == 0) {
          continue;
        }
        static const int facet[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
        float data[12] = {0};
        for (int c = 0; c < 3; c++) {
          const double *p = outline[i + facet[1 - f][c][0]];
          const double angle = 2 * G_PI * ((k + facet[1 - f][c][1]) % N) / N;
          const double v[3] = {p[0], p[1] * cos(angle), p[1] * sin(angle)};
          data[3 + 3 * c] = (float)(v[0] * cos(0.6) + v[2] * sin(0.6));
          data[4 + 3 * c] = (float)v[1];
          data[5 + 3 * c] = (float)(v[2] * cos(0.6) - v[0] * sin(0.6));
        }
        const guint16 none = 0;
        g_byte_array_append(out, (const guint8 *)data, sizeof data);
        g_byte_array_append(out, (const guint8 *)&none, sizeof none);
        count++;
      }
    }
  }
  memcpy(out->data + 80, &count, sizeof count);
  return out;
}

// A cylinder of radius r on 48 facets has equal moments at the length sqrt(3 r^2 - 2 r^2 sin^2(pi /
// 48)): it is refused there, and its axis is found 0.1 % beside it. A ball has any axis.
static void test_mesh_axis(void) {
  const double r = 3, equal = r * sqrt(3 - 2 * pow(sin(G_PI / 48), 2));
  const SbCadChoices none = {.unit = "mm"};
  for (int i = 0; i < 3; i++) {
    const double length = equal * (i == 0 ? 1.001 : i == 1 ? 0.999 : 1);
    const double outline[][2] = {{length, 0}, {length, r}, {0, r}, {0, 0}};
    g_autoptr(GError) error = NULL;
    g_autoptr(GByteArray) mesh = turned_mesh(outline, G_N_ELEMENTS(outline));
    g_autoptr(SbCad) cad = parse_mesh(mesh, &none, &error);
    if (i == 2) {
      g_assert_null(cad);
      assert_choice(sb_app_error_choice(error), error->message, "axis", "x\ny\nz");
      continue;
    }
    g_assert_no_error(error);
    g_assert_true(g_str_has_prefix(cad->axis, "along 0.82533")); // of 0.825336: single precision
    const SbCadBody *body = cad->bodies->pdata[0];
    // Corners are rounded to single precision, 1e-7, of which moments that differ by 0.1 % make an
    // angle of 4e-6.
    g_assert_cmpfloat_with_epsilon(body->revolved.volume / (G_PI * r * r * length * 1e-9), 1, 1e-5);
  }
  double half[25][2];
  for (int i = 0; i <= 24; i++) {
    half[i][0] = r * cos(G_PI * i / 24);
    half[i][1] = i % 24 == 0 ? 0 : r * sin(G_PI * i / 24);
  }
  g_autoptr(GError) error = NULL;
  g_autoptr(GByteArray) mesh = turned_mesh((const double(*)[2])half, 25);
  g_autoptr(SbCad) cad = parse_mesh(mesh, &none, &error);
  g_assert_no_error(error);
  g_assert_cmpuint(cad->bodies->len, ==, 1);
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
                  "is 1.2 mm in mm, 12 mm in cm, 30.5 mm in inch: specify it with "
                  "--unit=mm|cm|inch");
  assert_choice(sb_app_error_choice(error), error->message, "unit", "mm\ncm\ninch");
  // A copy with the name of another file has the choice too; each of its units is accepted.
  g_autoptr(GError) copy = g_error_copy(error);
  sb_app_error_prefix(&copy, "x.scene");
  assert_choice(sb_app_error_choice(copy), copy->message, "unit", "mm\ncm\ninch");
  for (char **unit = sb_app_error_choice(copy)->value; *unit != NULL; unit++) {
    g_clear_error(&error);
    g_autoptr(SbCad) chosen = parse_mesh(small, &(SbCadChoices){.unit = *unit}, &error);
    g_assert_no_error(error);
    g_assert_nonnull(chosen);
  }
  g_clear_error(&error);
  // The part is there twice.
  g_autoptr(GByteArray) twice = shaft_mesh(1, false);
  const guint32 facets = 2 * (twice->data[80] + 256U * twice->data[81]);
  g_autofree guint8 *again = g_memdup2(twice->data + 84, twice->len - 84);
  g_byte_array_append(twice, again, twice->len - 84);
  memcpy(twice->data + 80, &facets, 4);
  g_assert_null(parse_mesh(twice, &none, &error));
  g_assert_nonnull(strstr(error->message, "or one is there twice (export each by itself)"));
  g_clear_error(&error);
  // A facet is missing: open.
  const guint32 fewer = slotted->data[80] - 1U + 256U * slotted->data[81];
  memcpy(slotted->data + 80, &fewer, 4);
  g_byte_array_set_size(slotted, slotted->len - 50);
  g_assert_null(parse_mesh(slotted, &none, &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/cad/mesh", test_mesh);
  g_test_add_func("/cad/mesh/shells", test_mesh_shells);
  g_test_add_func("/cad/mesh/axis", test_mesh_axis);
  g_test_add_func("/cad/mesh/refused", test_mesh_refused);
  return g_test_run();
}
