// What any bytes must survive as an STL file: either a mesh of finite corners whose triangles point
// at them, which the engine weighs or refuses, or one complaint and nothing.
#include "app/base/unit.h"
#include "app/cad/cad_private.h"
#include "engine/mechanism/solid.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// The same mesh as a body of a drawing.
static void as_drawing(const char *data, size_t size) {
  const SbCadChoices choices = {.unit = size % 2 == 0 ? "mm" : NULL, .flip = size % 3 == 0};
  GError *error = NULL;
  SbCad *cad = sb_cad_parse_stl(data, size, "fuzz.stl", &choices, &error);
  if (cad == NULL) {
    g_assert_true(error->domain == SB_APP_ERROR);
    g_error_free(error);
    return;
  }
  g_assert_true(error == NULL && cad->bodies->len > 0);
  for (guint i = 0; i < cad->bodies->len; i++) {
    const SbCadBody *body = cad->bodies->pdata[i];
    g_autofree char *text = sb_cad_profile_text(body);
    g_assert_true(text != NULL || body->why != NULL);
    g_assert_true(text == NULL || (isfinite(body->solid.volume) && body->solid.volume > 0));
  }
  sb_cad_free(cad);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  SbStl stl;
  GError *error = NULL;
  if (!sb_stl_read(&stl, (const char *)data, size, "mm", "fuzz", &error)) {
    g_assert_true(error->domain == SB_APP_ERROR && g_utf8_validate(error->message, -1, NULL));
    g_assert_true(stl.vertices == NULL && stl.triangles == NULL);
    g_error_free(error);
    return 0;
  }
  g_assert_true(error == NULL && stl.triangle_count > 0);
  for (gsize i = 0; i < 3 * stl.vertex_count; i++) {
    g_assert_true(isfinite(stl.vertices[i]));
  }
  for (gsize i = 0; i < 3 * stl.triangle_count; i++) {
    g_assert_cmpuint(stl.triangles[i], <, stl.vertex_count);
  }
  SbSolid solid;
  SbReport report = {0};
  SbStatus status = sb_solid_mesh(&solid, stl.vertices, stl.vertex_count, stl.triangles,
                                  stl.triangle_count, 1000, &report);
  if (status == SB_OK) {
    g_assert_true(isfinite(solid.mass) && solid.mass > 0);
  } else {
    g_assert_true(report.text[0] != '\0');
  }
  sb_stl_clear(&stl);
  as_drawing((const char *)data, size);
  return 0;
}
