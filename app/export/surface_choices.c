// Choices of a scan by name; see surface.h.
#include "app/base/error.h"
#include "app/base/unit.h"
#include "app/document/data_keys.h"
#include "app/export/surface.h"

#include <math.h>
#include <string.h>

const char *const sb_surface_missing[] = {"leave", "fill", NULL};

void sb_surface_choices_init(SbSurfaceChoices *choices) {
  *choices = (SbSurfaceChoices){.heights = {.form = SB_FORM_PLANE}};
}

void sb_surface_choices_clear(SbSurfaceChoices *choices) {
  g_free(choices->channel);
  *choices = (SbSurfaceChoices){0};
}

static bool G_GNUC_PRINTF(2, 3) fail_choice(GError **error, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *text = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  g_set_error_literal(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, text);
  return false;
}

static bool choose_form(SbForm *form, const char *text, GError **error) {
  g_autoptr(GString) names = g_string_new(NULL);
  for (int i = 0; i < SB_FORM_COUNT; i++) {
    if (strcmp(text, sb_form_name(i)) == 0) {
      *form = (SbForm)i;
      return true;
    }
    g_string_append_printf(names, "%s%s", i > 0 ? ", " : "", sb_form_name(i));
  }
  return fail_choice(error, "there is no \"%s\" (allowed %s)", text, names->str);
}

bool sb_surface_choose(SbSurfaceChoices *choices, const char *name, const char *text,
                       GError **error) {
  const struct {
    const char *name, *si, *shown;
    double *value;
    bool unit; // the text is a unit's name
  } numbers[] = {
      {"outliers", "1", "", &choices->heights.outliers, false},
      {"cutoff-short", "m", "µm", &choices->heights.cutoff_short, false},
      {"cutoff-long", "m", "µm", &choices->heights.cutoff_long, false},
      {"spacing", "m", "µm", &choices->scan.spacing, false},
      {"unit", "m", "µm", &choices->scan.unit, true},
      {"lateral-unit", "m", "µm", &choices->scan.lateral_unit, true},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(numbers); i++) {
    if (strcmp(numbers[i].name, name) != 0) {
      continue;
    }
    g_autofree char *one = numbers[i].unit ? g_strconcat("1 ", text, NULL) : g_strdup(text);
    double value = 0;
    if (!sb_quantity_parse(&value, one, numbers[i].si, numbers[i].shown, error)) {
      return false;
    }
    if (!(value > 0 && isfinite(value))) {
      return numbers[i].unit ? fail_choice(error, "\"%s\" is not a unit of length", text)
                             : fail_choice(error, "\"%s\": a value above 0 is needed", text);
    }
    *numbers[i].value = value;
    return true;
  }
  if (strcmp(name, "form") == 0) {
    return choose_form(&choices->heights.form, text, error);
  }
  const bool missing = strcmp(name, "missing") == 0;
  if (missing || strcmp(name, "decimal") == 0) {
    const char *const *words = missing ? sb_surface_missing : sb_data_decimals;
    const bool second = strcmp(text, words[1]) == 0;
    choices->heights.fill = missing ? second : choices->heights.fill;
    choices->scan.decimal = missing ? choices->scan.decimal : ".,"[second];
    return second || strcmp(text, words[0]) == 0 ||
           fail_choice(error, "there is no \"%s\" (allowed %s, %s)", text, words[0], words[1]);
  }
  if (strcmp(name, "channel") == 0) {
    g_free(choices->channel);
    choices->scan.channel = choices->channel = g_strdup(text);
    return true;
  }
  return fail_choice(error, "\"%s\" is not a setting of a scan", name);
}
