// See hardness.h.
#include "app/base/hardness.h"

#include "app/base/error.h"
#include "app/base/number.h"
#include "engine/numeric/sampling.h"

#include <math.h>
#include <string.h>

static double gent(double S) {
  return 1e6 * 0.0981 * (56 + 7.62336 * S) / (0.137505 * (254 - 2.54 * S));
}

static double iso_48(double irhd) {
  const double middle = 0.364, width = 0.7; // of log10 E in MPa; 100/(0.7 sqrt(2 pi)) = 57
  return 1e6 * pow(10, middle + width * sb_normal_quantile(irhd / 100));
}

typedef struct {
  const char *name, *spelling[4]; // in lower case without spaces
  double low, high;
  double (*modulus)(double hardness); // [Pa]
  const char *relation;
} Scale;

static const Scale scales[] = {
    {"Shore A",
     {"shorea", "sha", "shore"},
     20,
     80,
     gent,
     "E = 0.0981 (56 + 7.62336 S) / (0.137505 (254 - 2.54 S)) MPa, Gent 1958"},
    {"IRHD", {"irhd"}, 30, 85, iso_48, "E = 10^(0.364 + 0.7 z(IRHD/100)) MPa, ISO 48"},
};

static const Scale *scale_of(const char *unit) {
  g_autofree char *lower = g_ascii_strdown(unit, -1);
  g_auto(GStrv) words = g_strsplit_set(lower, " \t", -1);
  g_autofree char *joined = g_strjoinv("", words);
  for (size_t i = 0; i < G_N_ELEMENTS(scales); i++) {
    for (size_t k = 0; scales[i].spelling[k] != NULL; k++) {
      if (strcmp(joined, scales[i].spelling[k]) == 0) {
        return &scales[i];
      }
    }
  }
  return NULL;
}

// The scale of "60 Shore A" and the number; NULL: the text has no unit of hardness.
static const Scale *read_hardness(double *hardness, const char *text) {
  g_autofree char *trimmed = g_strstrip(g_strdup(text));
  const size_t length = sb_number_read(hardness, trimmed);
  return length > 0 ? scale_of(g_strchug(trimmed + length)) : NULL;
}

bool sb_hardness_applies(SbParamId id) {
  return id == SB_P_SEAL_MODULUS || sb_param(id)->parent == SB_P_SEAL_MODULUS;
}

bool sb_hardness_parse(double *modulus, const char *text, GError **error) {
  double hardness = 0;
  const Scale *scale = read_hardness(&hardness, text);
  if (scale == NULL) {
    return false;
  }
  if (!(hardness >= scale->low && hardness <= scale->high)) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "the relation between modulus and %s is valid from %g to %g %s: give the modulus",
                scale->name, scale->low, scale->high, scale->name);
    return false;
  }
  *modulus = scale->modulus(hardness);
  return true;
}

bool sb_hardness_difference(double *out, double at, const char *text, GError **error) {
  double points = 0;
  const Scale *scale = read_hardness(&points, text);
  if (scale == NULL) {
    return false;
  }
  double low = scale->low, high = scale->high;
  if (!(at >= scale->modulus(low) && at <= scale->modulus(high))) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "a difference in %s is known next to a mean of %g to %g %s only: give it in MPa",
                scale->name, low, high, scale->name);
    return false;
  }
  for (double middle; middle = 0.5 * (low + high), high - low > 1e-9;) {
    *(scale->modulus(middle) < at ? &low : &high) = middle;
  }
  const double step = 1e-3;
  *out = points * (scale->modulus(low + step) - scale->modulus(low - step)) / (2 * step);
  return true;
}

void sb_hardness_note(GPtrArray *notes, const char *shown, int line, const char *key, SbParamId id,
                      const char *text) {
  double hardness = 0, modulus = 0;
  const Scale *scale = sb_hardness_applies(id) ? read_hardness(&hardness, text) : NULL;
  if (scale == NULL || !sb_hardness_parse(&modulus, text, NULL)) {
    return;
  }
  // 3 points either side.
  const double spread =
      (scale->modulus(hardness + 3) - scale->modulus(hardness - 3)) / (2 * modulus);
  char value[SB_NUMBER_SIZE], points[SB_NUMBER_SIZE], share[SB_NUMBER_SIZE];
  sb_number_round(value, 1e-6 * modulus, 3);
  sb_number_round(points, hardness, 6);
  sb_number_round(share, 100 * spread, 2);
  sb_issues_add(notes, shown, line, key, NULL,
                "%s: %s %s is a modulus of %s MPa (%s); a reading that is 3 points off changes "
                "it by %s %%, and filled rubbers differ from the relation by up to 20 %%",
                key, points, scale->name, value, scale->relation, share);
}
