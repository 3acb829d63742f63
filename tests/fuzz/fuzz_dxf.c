// What any bytes must survive as a DXF: bodies whose half-sections the engine takes and weighs, or
// one complaint and nothing.
#include "app/cad/cad.h"

#include "app/base/error.h"

#include <math.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const SbCadChoices choices = {.unit = size % 2 == 0 ? "mm" : NULL, .flip = size % 3 == 0};
  GError *error = NULL;
  SbCad *cad = sb_cad_parse_dxf((const char *)data, size, "fuzz", &choices, &error);
  if (cad == NULL) {
    g_assert_true(error->domain == SB_APP_ERROR && g_utf8_validate(error->message, -1, NULL));
    g_error_free(error);
    return 0;
  }
  g_assert_true(error == NULL && cad->bodies->len > 0);
  for (guint i = 0; i < cad->bodies->len; i++) {
    const SbCadBody *body = cad->bodies->pdata[i];
    g_autofree char *text = sb_cad_profile_text(body);
    if (body->profile->len == 0) {
      g_assert_true(text == NULL && body->why != NULL);
      continue;
    }
    g_assert_true(isfinite(body->solid.volume) && body->solid.volume > 0);
    for (guint k = 0; k < body->features->len; k++) {
      const SbCadFeature *f = &g_array_index(body->features, SbCadFeature, k);
      g_assert_true(f->x1 >= f->x0 && f->diameter > 0);
    }
  }
  sb_cad_free(cad);
  return 0;
}
