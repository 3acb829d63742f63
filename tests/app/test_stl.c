// STL files: both forms, units, what is refused; and the mass of what they hold.
#include "app/cad/cad.h"

#include "app/base/unit.h"
#include "engine/mechanism/solid.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>

// Corners of a box of 2 x 3 x 5, twelve triangles seen from outside.
static const double corner[8][3] = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0},
                                    {0, 0, 5}, {2, 0, 5}, {2, 3, 5}, {0, 3, 5}};
static const unsigned face[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7},
                                     {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                     {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};

static GString *text_box(void) {
  GString *s = g_string_new("solid box of 3 sides\n");
  for (int f = 0; f < 12; f++) {
    g_string_append(s, "  facet normal 0 0 0\n    outer loop\n");
    for (int k = 0; k < 3; k++) {
      const double *c = corner[face[f][k]];
      g_string_append_printf(s, "      vertex %d.0 %de0 %d\n", (int)c[0], (int)c[1], (int)c[2]);
    }
    g_string_append(s, "    endloop\n  endfacet\n");
  }
  return g_string_append(s, "endsolid box\n");
}

static GByteArray *binary_box(void) {
  GByteArray *a = g_byte_array_new();
  char header[80] = "solid but binary";
  g_byte_array_append(a, (guint8 *)header, sizeof header);
  guint32 n = GUINT32_TO_LE(12);
  g_byte_array_append(a, (guint8 *)&n, 4);
  for (int f = 0; f < 12; f++) {
    float record[12] = {0};
    for (int k = 0; k < 9; k++) {
      record[3 + k] = (float)corner[face[f][k / 3]][k % 3];
    }
    for (int k = 0; k < 12; k++) {
      guint32 bits;
      memcpy(&bits, &record[k], 4);
      bits = GUINT32_TO_LE(bits);
      g_byte_array_append(a, (guint8 *)&bits, 4);
    }
    g_byte_array_append(a, (guint8 *)"\0\0", 2);
  }
  return a;
}

static void weigh(const SbStl *stl, double unit) {
  SbSolid solid;
  SbReport report = {0};
  g_assert_cmpuint(stl->vertex_count, ==, 8);
  g_assert_cmpuint(stl->triangle_count, ==, 12);
  g_assert_cmpint(sb_solid_mesh(&solid, stl->vertices, stl->vertex_count, stl->triangles,
                                stl->triangle_count, 1000.0, &report),
                  ==, SB_OK);
  g_assert_cmpstr(report.text, ==, "");
  double volume = 30.0 * unit * unit * unit;
  g_assert_cmpfloat_with_epsilon(solid.volume, volume, 1e-12 * volume);
  g_assert_cmpfloat_with_epsilon(solid.centre[2], 2.5 * unit, 1e-12 * unit);
}

static void test_forms(void) {
  GError *error = NULL;
  SbStl stl;
  GString *text = text_box();
  g_assert_true(sb_stl_read(&stl, text->str, text->len, "mm", "box.stl", &error));
  g_assert_no_error(error);
  weigh(&stl, 1e-3);
  sb_stl_clear(&stl);
  GByteArray *binary = binary_box();
  g_assert_true(sb_stl_read(&stl, (char *)binary->data, binary->len, "inch", "box.stl", &error));
  g_assert_no_error(error);
  weigh(&stl, 0.0254);
  sb_stl_clear(&stl);
  // From a file.
  char *folder = g_dir_make_tmp("sealbench-stl-XXXXXX", NULL);
  char *path = g_build_filename(folder, "box.stl", NULL);
  g_assert_true(g_file_set_contents(path, (char *)binary->data, (gssize)binary->len, NULL));
  g_assert_true(sb_stl_read(&stl, NULL, 0, "mm", path, &error));
  weigh(&stl, 1e-3);
  sb_stl_clear(&stl);
  g_unlink(path);
  g_assert_false(sb_stl_read(&stl, NULL, 0, "mm", path, &error));
  g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_IO);
  g_clear_error(&error);
  // Neither waited for nor read without end.
  g_assert_cmpint(mkfifo(path, 0600), ==, 0);
  const char *const none[] = {path, "/dev/zero", folder};
  for (size_t i = 0; i < G_N_ELEMENTS(none); i++) {
    g_assert_false(sb_stl_read(&stl, NULL, 0, "mm", none[i], &error));
    g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_IO);
    g_assert_nonnull(strstr(error->message, none[i]));
    g_clear_error(&error);
  }
  g_unlink(path);
  g_rmdir(folder);
  g_free(path);
  g_free(folder);
  g_byte_array_unref(binary);
  g_string_free(text, TRUE);
  sb_stl_clear(NULL);
}

static void refuse(const char *data, gsize length, const char *unit, const char *why) {
  GError *error = NULL;
  SbStl stl;
  g_assert_false(sb_stl_read(&stl, data, length, unit, "part.stl", &error));
  g_assert_nonnull(error);
  g_assert_true(error->domain == SB_APP_ERROR);
  g_assert_null(stl.vertices);
  if (strstr(error->message, why) == NULL) {
    g_error("'%s' does not say '%s'", error->message, why);
  }
  g_error_free(error);
}

static void test_refused(void) {
  GString *text = text_box();
  GByteArray *binary = binary_box();
  const char *data = (char *)binary->data;
  refuse(text->str, text->len, "", "unit");
  refuse(text->str, text->len, "kg", "kg");
  refuse(text->str, text->len - 13, "mm", "endsolid");
  refuse(text->str, text->len / 2, "mm", "expected");
  for (gsize n = 0; n < binary->len; n += 37) {
    // Cut short anywhere: neither form, for the header is no text either.
    refuse(data, n, "mm", "part.stl");
  }
  guint32 infinite = GUINT32_TO_LE(0x7f800000u);
  memcpy(binary->data + 84 + 12, &infinite, 4);
  refuse(data, binary->len, "mm", "triangle 0");
  refuse("hello", 5, "mm", "not an STL file");
  refuse("solid x\nendsolid x\n", 19, "mm", "no triangles");
  const char *wrong = "solid x\n facet normal 0 0 0 outer loop vertex 1 2 three";
  refuse(wrong, strlen(wrong), "mm", "part.stl: line 2: a number expected, not 'three'");
  const char *junk = "solid x\n circle 1\nendsolid";
  refuse(junk, strlen(junk), "mm", "'circle' is not part of STL");
  g_byte_array_unref(binary);
  g_string_free(text, TRUE);
}

// A triangle that welding makes a line is left out.
static void test_dropped(void) {
  GString *text = text_box();
  gssize at = (gssize)(strstr(text->str, "endsolid") - text->str);
  g_string_insert(text, at,
                  "facet normal 0 0 1 outer loop vertex 0 0 0 vertex -0 0 0 vertex 2 0 0 endloop "
                  "endfacet\n");
  SbStl stl;
  GError *error = NULL;
  g_assert_true(sb_stl_read(&stl, text->str, text->len, "mm", "box.stl", &error));
  weigh(&stl, 1e-3);
  sb_stl_clear(&stl);
  g_string_free(text, TRUE);
}

// Corners that the writer rounded each in its own way are one vertex, wherever the part lies; what
// is further apart than the tolerance stays apart.
static void test_rounded(void) {
  GRand *random = g_rand_new_with_seed(8);
  for (int far = 0; far < 2; far++) {
    for (int round = 0; round < 20; round++) {
      GString *s = g_string_new("solid\n");
      double away = far ? 2000.0 : 0.0, width = far ? 1e-4 : 2e-5;
      for (int f = 0; f < 12; f++) {
        g_string_append(s, "facet normal 0 0 0 outer loop\n");
        for (int k = 0; k < 3; k++) {
          const double *c = corner[face[f][k]];
          g_string_append(s, "vertex");
          for (int j = 0; j < 3; j++) {
            char digits[G_ASCII_DTOSTR_BUF_SIZE];
            double x = c[j] + away + width * g_rand_double_range(random, -0.5, 0.5);
            g_string_append_printf(s, " %s", g_ascii_dtostr(digits, sizeof digits, x));
          }
          g_string_append_c(s, '\n');
        }
        g_string_append(s, "endloop endfacet\n");
      }
      g_string_append(s, "endsolid\n");
      SbStl stl;
      GError *error = NULL;
      g_assert_true(sb_stl_read(&stl, s->str, s->len, "mm", "box.stl", &error));
      g_assert_cmpuint(stl.vertex_count, ==, 8);
      g_assert_cmpuint(stl.triangle_count, ==, 12);
      SbSolid solid;
      SbReport report = {0};
      SbStatus status = sb_solid_mesh(&solid, stl.vertices, 8, stl.triangles, 12, 1000.0, &report);
      g_assert_cmpstr(report.text, ==, "");
      g_assert_cmpint(status, ==, SB_OK);
      // Each of six faces moves by at most the rounding: relative, over sides of 2, 3 and 5.
      g_assert_cmpfloat_with_epsilon(solid.volume / 30e-9, 1,
                                     width * (1 / 2.0 + 1 / 3.0 + 1 / 5.0));
      sb_stl_clear(&stl);
      g_string_free(s, TRUE);
    }
  }
  g_rand_free(random);
}

// The numbers are decimal, whole and bounded, however long they are.
static void test_numbers(void) {
  GString *text = text_box();
  // 70 characters, of which the exponent is the last: 50, or 5 as the other corners have it.
  g_string_replace(text, " 5\n",
                   " 50.00000000000000000000000000000000000000000000000000000000000000e-1\n", 0);
  SbStl stl;
  GError *error = NULL;
  g_assert_true(sb_stl_read(&stl, text->str, text->len, "mm", "box.stl", &error));
  weigh(&stl, 1e-3);
  sb_stl_clear(&stl);
  g_string_replace(text, "e-1\n",
                   "0000000000000000000000000000000000000000000000000000000000000000"
                   "00000000000000000000000000000000000000000000000000000000000000"
                   "00000000000000e-1\n",
                   0);
  refuse(text->str, text->len, "mm", "too long");
  g_string_free(text, TRUE);
  // Normals are not used: a facet without area may have none.
  text = text_box();
  g_string_replace(text, "normal 0 0 0", "normal nan -nan(ind) 1.#QNAN", 3);
  g_assert_true(sb_stl_read(&stl, text->str, text->len, "mm", "box.stl", &error));
  weigh(&stl, 1e-3);
  sb_stl_clear(&stl);
  g_string_free(text, TRUE);
  static const char *const none[] = {"0x1", "0X1p2", "1e",  "1e+",  "nan",
                                     "inf", ".",     "1,5", "1e999"};
  for (size_t i = 0; i < G_N_ELEMENTS(none); i++) {
    char *wrong = g_strdup_printf("solid x\n facet normal 0 0 1 outer loop vertex 0 0 %s", none[i]);
    refuse(wrong, strlen(wrong), "mm", "a number expected");
    g_free(wrong);
  }
}

// The largest file that is taken, all of whose corners are new or all nearly one, ends: with the
// square of the corners for its work it would not before the test's own limit.
static void test_largest(void) {
  enum { TRIANGLES = 300000 };
  for (int kind = 0; kind < 2; kind++) {
    GByteArray *a = g_byte_array_sized_new(84 + 50 * TRIANGLES);
    g_byte_array_set_size(a, 84 + 50 * TRIANGLES);
    memset(a->data, 0, a->len);
    guint32 n = GUINT32_TO_LE(TRIANGLES);
    memcpy(a->data + 80, &n, 4);
    for (guint32 i = 0; i < 9 * TRIANGLES; i++) {
      // Anywhere in a cube, or in a cell of it beside one far corner.
      guint32 mixed = (i + 1) * 2654435761u;
      float x = (float)(mixed >> 8) * 0x1p-24f * (kind == 0 ? 1.0f : 6e-5f);
      x = i == 0 ? 1.0f : x;
      memcpy(a->data + 84 + 50 * (i / 9) + 12 + 4 * (i % 9), &x, 4);
    }
    SbStl stl;
    g_assert_true(sb_stl_read(&stl, (char *)a->data, a->len, "mm", "many.stl", NULL));
    g_test_message("%d triangles: %zu vertices", TRIANGLES, stl.vertex_count);
    sb_stl_clear(&stl);
    g_byte_array_unref(a);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/cad/stl/forms", test_forms);
  g_test_add_func("/cad/stl/refused", test_refused);
  g_test_add_func("/cad/stl/dropped", test_dropped);
  g_test_add_func("/cad/stl/rounded", test_rounded);
  g_test_add_func("/cad/stl/numbers", test_numbers);
  g_test_add_func("/cad/stl/largest", test_largest);
  return g_test_run();
}
