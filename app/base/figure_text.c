// Figures as text. See figure_text.h.
#include "app/base/figure_text.h"

#include "app/base/unit.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#define MINUS      "\xe2\x88\x92" // U+2212
#define THIN_SPACE "\xe2\x80\x89" // U+2009
#define NO_BREAK   "\xc2\xa0"     // U+00A0
#define EN_DASH    "\xe2\x80\x93"

// Films and volumes span decades: their unit follows the size. Others have the unit of their row.
static const char *unit_of(int index, double value) {
  const SbFigureQuantity quantity = sb_figure(index)->quantity;
  const double size = isfinite(value) ? value : 0;
  return quantity == SB_FIGURE_QUANTITY_FILM     ? sb_quantity_unit(SB_QUANTITY_FILM, size)
         : quantity == SB_FIGURE_QUANTITY_VOLUME ? sb_quantity_unit(SB_QUANTITY_VOLUME, size)
                                                 : sb_figure(index)->shown;
}

// The value in `unit`; *relative is the error relative to it. A point of a scale of temperature has
// another relative error in K than in degrees Celsius.
static double to_unit(double *relative, int index, const char *unit, double value, double error) {
  const char *si = sb_figure(index)->si;
  const double shown = sb_quantity_to_shown(value, si, unit);
  *relative = error;
  if (error > 0 && isfinite(error) && shown != 0) {
    const double above = sb_quantity_to_shown(value + error * fabs(value), si, unit);
    *relative = fabs((above - shown) / shown);
  }
  return shown;
}

// Zeros: 28.6988 is 28.70, and an input of 35 is 35.
void sb_number_with_error(char out[SB_NUMBER_SIZE], double shown, int digits, double error) {
  const int decimals = sb_format_decimals(shown, digits, error);
  const double scale = pow(10, decimals);
  const bool exact = fabs(round(shown * scale) / scale - shown) <= 1e-12 * fabs(shown);
  const bool known = error > 0 && isfinite(error);
  if ((known || !exact) && decimals > 0 && fabs(shown) >= 1e-5) {
    char pattern[16];
    g_snprintf(pattern, sizeof pattern, "%%.%df", decimals);
    g_ascii_formatd(out, SB_NUMBER_SIZE, pattern, shown);
    return;
  }
  const int coarser = sb_format_decimals(shown, digits, 0) - decimals;
  sb_number_round(out, shown, MAX(digits - MAX(coarser, 0), 1));
}

// Number and unit in plain ASCII.
static void plain_parts(char number[SB_NUMBER_SIZE], const char **unit, int index, double value,
                        double error) {
  const SbFigure *figure = sb_figure(index);
  *unit = unit_of(index, value);
  if (!isfinite(value)) {
    g_strlcpy(number, "-", SB_NUMBER_SIZE);
  } else if (figure->digits == 0) {
    g_strlcpy(number, value > 0 ? "yes" : "no", SB_NUMBER_SIZE);
  } else {
    // A sum of forces that is below 1 nN is rounding noise.
    const bool noise = figure->quantity == SB_FIGURE_QUANTITY_FORCE && fabs(value) < 1e-9;
    double relative;
    const double shown = to_unit(&relative, index, *unit, noise ? 0 : value, error);
    sb_number_with_error(number, shown, figure->digits, relative);
  }
}

// A plain number with a true minus, thin spaces from five digits on, and a raised exponent.
static void typeset(char *out, size_t size, const char *plain) {
  const char *digits = plain + (*plain == '-');
  const char *exponent = strchr(digits, 'e');
  const size_t end = exponent != NULL ? (size_t)(exponent - digits) : strlen(digits);
  const size_t whole = MIN(strcspn(digits, "."), end);
  g_strlcpy(out, digits != plain ? MINUS : "", size);
  for (size_t i = 0; i < end; i++) {
    const char one[2] = {digits[i], 0};
    if (whole >= 5 && i > 0 && i < whole && (whole - i) % 3 == 0) {
      g_strlcat(out, THIN_SPACE, size);
    }
    g_strlcat(out, one, size);
  }
  if (exponent != NULL) {
    char power[SB_FORMAT_MAX];
    sb_format_power(power, (int)g_ascii_strtoll(exponent + 1, NULL, 10));
    g_strlcat(out, "\xc2\xb7", size);
    g_strlcat(out, power, size);
  }
}

void sb_figure_parts(SbFormatted *out, int index, double value, double error) {
  char plain[SB_NUMBER_SIZE];
  const char *unit;
  plain_parts(plain, &unit, index, value, error);
  g_strlcpy(out->unit, unit, sizeof out->unit);
  if (isfinite(value) && sb_figure(index)->digits > 0) {
    typeset(out->number, sizeof out->number, plain);
  } else {
    g_strlcpy(out->number, isfinite(value) ? plain : EN_DASH, sizeof out->number);
  }
}

char *sb_figure_text(char *out, int index, double value, double error) {
  SbFormatted parts;
  sb_figure_parts(&parts, index, value, error);
  g_snprintf(out, SB_FORMAT_MAX, "%s%s%s", parts.number, *parts.unit != '\0' ? NO_BREAK : "",
             parts.unit);
  return out;
}

double sb_figure_error_reported(const SbSummary *summary, int index) {
  return sb_figure_error_reason(summary, index) == NULL ? sb_figure_error(summary, index) : NAN;
}

char *sb_format_figure(char *out, const SbSummary *summary, int index) {
  return sb_figure_text(out, index, sb_figure_value(summary, index),
                        sb_figure_error(summary, index));
}

char *sb_seal_figure_text(char *out, const SbSummary *summary, int seal, const char *name,
                          double value) {
  g_autofree char *path = g_strdup_printf("seals.%s.%s", sb_seal_name(seal), name);
  const int figure = sb_figure_find(path);
  return sb_figure_text(out, figure, value,
                        summary != NULL ? sb_figure_error(summary, figure) : NAN);
}

char *sb_figure_format(int index, double value, double error) {
  char plain[SB_NUMBER_SIZE];
  const char *unit;
  plain_parts(plain, &unit, index, value, error);
  return g_strconcat(plain, *unit != '\0' && isfinite(value) ? " " : "",
                     isfinite(value) ? unit : "", NULL);
}

char *sb_figure_error_format(int index, double value, double error) {
  if (!isfinite(value) || !isfinite(error)) {
    return g_strdup("-");
  }
  enum { DIGITS = 2 };
  const char *si = sb_figure(index)->si, *unit = unit_of(index, value);
  // Units are affine: an error has the slope of the scale and not its origin.
  const double slope = sb_quantity_to_shown(1, si, unit) - sb_quantity_to_shown(0, si, unit);
  char number[SB_NUMBER_SIZE];
  sb_number_with_error(number, error * slope, DIGITS, 1);
  return g_strconcat(number, *unit != '\0' ? " " : "", unit, NULL);
}

// Whether a number has more digits than an input.
static bool is_computed(int index, double value) {
  enum { DIGITS = 9 };
  const double shown = sb_quantity_to_shown(value, sb_figure(index)->si, unit_of(index, value));
  const double unit = pow(10, sb_format_decimals(shown, DIGITS, 0));
  return fabs(round(shown * unit) / unit - shown) > 1e-12 * fabs(shown);
}

char *sb_figure_given(int index, double value) {
  const SbFigure *figure = sb_figure(index);
  if (isfinite(value) && figure->digits > 0 && is_computed(index, value)) {
    return sb_figure_format(index, value, 0);
  }
  return figure->digits == 0 || !isfinite(value)
             ? sb_figure_format(index, value, NAN)
             : sb_quantity_format(value, figure->si, unit_of(index, value));
}

char *sb_limit_format(int figure, double low, double high) {
  g_autofree char *first = sb_figure_given(figure, isfinite(low) ? low : high);
  g_autofree char *second = sb_figure_given(figure, high);
  return isfinite(low) && isfinite(high)
             ? g_strdup_printf("%s .. %s", first, second)
             : g_strdup_printf("%s %s", isfinite(low) ? ">=" : "<=", first);
}

int sb_figure_stage_force(SbStage stage) {
  char path[64];
  g_snprintf(path, sizeof path, "cycle.stages.%s.force_N", sb_stage_name(stage));
  return sb_figure_find(path);
}

char *sb_figure_label(int index) {
  const SbFigure *figure = sb_figure(index);
  return g_strconcat(figure->label, *figure->where != '\0' ? ", " : "", figure->where, NULL);
}

// Returns the design whose value has the unit and the digits of a comparison: the first one with a
// value other than 0, which has no size; without one, the first design.
static size_t reference_of(const SbFigureCompared *design, size_t count) {
  for (size_t i = 0; i < count; i++) {
    if (isfinite(design[i].value) && design[i].value != 0) {
      return i;
    }
  }
  return 0;
}

const char *sb_figure_compared_unit(int index, const SbFigureCompared *design, size_t count) {
  return unit_of(index, design[reference_of(design, count)].value);
}

int sb_figure_compared_decimals(int index, const SbFigureCompared *design, size_t count) {
  const size_t reference = reference_of(design, count);
  const SbFigureCompared *base = &design[reference];
  const char *unit = unit_of(index, base->value);
  const int digits = sb_figure(index)->digits;
  double relative;
  const double shown = to_unit(&relative, index, unit, base->value, base->error);
  int decimals = sb_format_decimals(shown, digits, relative);
  for (size_t i = reference + 1; i < count; i++) {
    const bool same = design[i].methods == base->methods;
    const double error = sb_figure_difference_error(base->value, base->error, design[i].value,
                                                    design[i].error, same);
    if (isfinite(error) && base->value != 0) {
      (void)to_unit(&relative, index, unit, base->value, error / fabs(base->value));
      decimals = MAX(decimals, sb_format_decimals(shown, digits, relative));
    }
  }
  return decimals;
}

// A number with `decimals`; without zeros at the end if `exact` and these decimals show all of it.
static void write_decimals(char out[SB_NUMBER_SIZE], double shown, int decimals, bool exact) {
  const double unit = pow(10, -decimals);
  const double rounded = decimals < 0 ? round(shown / unit) * unit : shown;
  const bool full = fabs(round(shown / unit) * unit - shown) <= 1e-12 * fabs(shown);
  if ((exact && full) || decimals > 9) {
    const int exponent = shown != 0 ? (int)floor(log10(fabs(shown))) : 0;
    sb_number_round(out, rounded, CLAMP(decimals + exponent + 1, 1, 17));
    return;
  }
  char pattern[16];
  g_snprintf(pattern, sizeof pattern, "%%.%df", MAX(decimals, 0));
  g_ascii_formatd(out, SB_NUMBER_SIZE, pattern, rounded);
  if (strspn(out, "-0.") == strlen(out)) {
    g_strlcpy(out, "0", SB_NUMBER_SIZE);
  }
}

const char *sb_figure_compared(char *value, char *change, int index, const SbFigureCompared *design,
                               size_t count, size_t at) {
  const SbFigure *figure = sb_figure(index);
  const SbFigureCompared *own = &design[at], *base = &design[0];
  const char *unit = sb_figure_compared_unit(index, design, count);
  *change = '\0';
  if (!isfinite(own->value) || figure->digits == 0) {
    g_autofree char *text = sb_figure_format(index, own->value, NAN);
    g_strlcpy(value, text, SB_FORMAT_MAX);
    return "";
  }
  bool exact = true;
  for (size_t i = 0; i < count; i++) {
    exact = exact && !(design[i].error > 0);
  }
  const int decimals = sb_figure_compared_decimals(index, design, count);
  char number[SB_NUMBER_SIZE];
  const double shown = sb_quantity_to_shown(own->value, figure->si, unit);
  write_decimals(number, shown, decimals, exact);
  g_strlcpy(value, number, SB_FORMAT_MAX);
  if (at > 0 && isfinite(base->value)) {
    const double by = shown - sb_quantity_to_shown(base->value, figure->si, unit);
    write_decimals(number, by, decimals, exact);
    g_snprintf(change, SB_FORMAT_MAX, "%s%s", *number == '-' ? "" : "+", number);
  }
  return unit;
}
