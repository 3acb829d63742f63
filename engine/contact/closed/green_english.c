// Green and English's load fits, thesis eq. 2.12 and table 2.1; see the header.
#include "engine/contact/closed/green_english.h"

#include <math.h>

typedef struct {
  double a, b, c, n, s_max;
} Row;

static const Row rows[SB_GREEN_ENGLISH_COUNT] = {
#define ROW(code, text, a, b, c, n, s_max) [code] = {a, b, c, n, s_max},
    SB_GREEN_ENGLISH_LIST(ROW)
#undef ROW
};

void sb_green_english(SbGreenEnglish *out, SbGreenEnglishRow row, double squeeze,
                      double poisson_ratio, SbWarnings *warnings) {
  *out = (SbGreenEnglish){0};
  if (!(squeeze > 0.0)) {
    return;
  }
  const Row *r = &rows[row];
  if (squeeze > r->s_max) {
    sb_warn(warnings, "green-english-squeeze", "seal.section_diameter",
            "squeeze %.3g %% is beyond %.3g %%, the range of this row of Green and English",
            100.0 * squeeze, 100.0 * r->s_max);
  }
  if (poisson_ratio < 0.45) {
    sb_warn(warnings, "incompressible-assumed", "seal.poisson_ratio",
            "the formula is for incompressible rubber, not Poisson's ratio %.3g", poisson_ratio);
  }
  out->load_factor = r->a * pow(squeeze, r->b) + r->c * pow(squeeze, r->n);
  out->width_ratio = sqrt(6.0 / M_PI * out->load_factor);
}
