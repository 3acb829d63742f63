// See figures.h.
#include "engine/valve/figures/figures.h"

#include "engine/valve/model/model.h"
#include "engine/valve/model/motion_kind.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

// The SI unit of each quantity.
#define SI_UNIT(quantity, si) static const char SI_##quantity[] = si;
SB_FIGURE_QUANTITY_LIST(SI_UNIT)
#undef SI_UNIT

// From a row's quantity on the columns are those of SbFigure.
#define COLUMNS(quantity, shown, digits, better, error, needs, part, verdict, brief, label, help)  \
  SB_FIGURE_QUANTITY_##quantity, SI_##quantity, shown, digits, SB_BETTER_##better, SB_BY_##error,  \
      SB_DEPTH_##needs, SB_PART_##part, SB_VERDICT_##verdict, brief, label, help
#define CONTACT_COLUMNS(quantity, shown, digits, better, error, needs, ...)                        \
  COLUMNS(quantity, shown, digits, better, error, WHOLE, __VA_ARGS__)
#define SEAL(name, index, path, member, ...)                                                       \
  {"seals." name "." path,                                                                         \
   offsetof(SbSummary, seal[index].member),                                                        \
   name " seal",                                                                                   \
   SB_GROUP_SEAL,                                                                                  \
   index,                                                                                          \
   SB_DIRECTION_NONE,                                                                              \
   COLUMNS(__VA_ARGS__)},
#define CONTACT_IN(name, index, path, member, ...)                                                 \
  {"seals." name ".contact.in_stroke." path,                                                       \
   offsetof(SbSummary, contact[index].in_stroke.member),                                           \
   name " seal, in-stroke",                                                                        \
   SB_GROUP_SEAL,                                                                                  \
   index,                                                                                          \
   SB_DIRECTION_IN,                                                                                \
   COLUMNS(__VA_ARGS__)},
#define CONTACT_OUT(name, index, path, member, ...)                                                \
  {"seals." name ".contact.return." path,                                                          \
   offsetof(SbSummary, contact[index].back.member),                                                \
   name " seal, return",                                                                           \
   SB_GROUP_SEAL,                                                                                  \
   index,                                                                                          \
   SB_DIRECTION_OUT,                                                                               \
   CONTACT_COLUMNS(__VA_ARGS__)},
static const SbFigure figures[SB_FIGURE_COUNT] = {
#define SB_FIGURE(path, member, ...) SB_FIGURE_AT(path, member, "", __VA_ARGS__)
#define SB_FIGURE_AT(path, place, where, group, ...)                                               \
  {path,                                                                                           \
   offsetof(SbSummary, place),                                                                     \
   where,                                                                                          \
   SB_GROUP_##group,                                                                               \
   SB_SEAL_COUNT,                                                                                  \
   SB_DIRECTION_NONE,                                                                              \
   COLUMNS(__VA_ARGS__)},
#include "engine/valve/figures/figures.def"
#define SB_SEAL_FIGURE(...)    SEAL("outer", SB_OUTER, __VA_ARGS__)
#define SB_CONTACT_FIGURE(...) CONTACT_IN("outer", SB_OUTER, __VA_ARGS__)
#include "engine/valve/figures/figures.def"
#define SB_CONTACT_FIGURE(...) CONTACT_OUT("outer", SB_OUTER, __VA_ARGS__)
#include "engine/valve/figures/figures.def"
#define SB_SEAL_FIGURE(...)    SEAL("inner", SB_INNER, __VA_ARGS__)
#define SB_CONTACT_FIGURE(...) CONTACT_IN("inner", SB_INNER, __VA_ARGS__)
#include "engine/valve/figures/figures.def"
#define SB_CONTACT_FIGURE(...) CONTACT_OUT("inner", SB_INNER, __VA_ARGS__)
#include "engine/valve/figures/figures.def"
};

const SbFigure *sb_figure(int index) {
  return &figures[index];
}

int sb_figure_find(const char *path) {
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    if (strcmp(figures[i].path, path) == 0) {
      return i;
    }
  }
  return -1;
}

double sb_figure_value(const SbSummary *summary, int index) {
  return *(const double *)((const char *)summary + figures[index].offset);
}

const char *sb_figure_reason(const SbSummary *summary, int index) {
  const SbReasons *reasons = &summary->reasons;
  if (isfinite(sb_figure_value(summary, index))) {
    return NULL;
  }
  return reasons->of[index] > 0 ? reasons->text[reasons->of[index] - 1]
                                : "this run does not compute its inputs";
}

double sb_figure_error_absolute(const SbSummary *summary, int index) {
  return isfinite(sb_figure_value(summary, index)) ? summary->error[index] : NAN;
}

double sb_figure_error(const SbSummary *summary, int index) {
  const double error = sb_figure_error_absolute(summary, index);
  return error > 0 ? error / fabs(sb_figure_value(summary, index)) : error;
}

// Returns whether a solver's own estimate is the figure's error: above 1 it has not converged. Of a
// figure that follows from solved ones, as a difference or by a steep law, such an error states
// only that the figure is uncertain.
static bool is_solved(const SbFigure *figure) {
  switch (figure->error) {
  case SB_BY_LOAD:
  case SB_BY_PEAK:
  case SB_BY_WIDTH:
  case SB_BY_FILM:
  case SB_BY_FILM_LEAST:
  case SB_BY_FILM_SOLVED:
  case SB_BY_PERMEATION:
    return true;
  default:
    return false;
  }
}

const char *sb_figure_error_reason(const SbSummary *summary, int index) {
  const double error = sb_figure_error(summary, index);
  const SbFigure *figure = &figures[index];
  if (!isfinite(sb_figure_value(summary, index))) {
    return sb_figure_reason(summary, index);
  }
  if (figure->error == SB_BY_RESIDUAL) {
    return "it is an error or a residual itself";
  }
  if (isnan(error)) {
    return "an event or a coarser solution that would give the error is missing";
  }
  if (error > SB_ERROR_LARGE && figure->error == SB_BY_EDGE) {
    return "uncertain: the place is nearer to the section's centre than its error allows to state";
  }
  if (error > SB_ERROR_USELESS && !is_solved(figure)) {
    return "uncertain: the errors of the figure's inputs exceed its magnitude";
  }
  return NULL;
}

double sb_figure_difference_error(double a, double error_a, double b, double error_b,
                                  bool same_methods) {
  if (isnan(error_a) || isnan(error_b)) {
    return NAN;
  }
  if (!same_methods) {
    return error_a * fabs(a) + error_b * fabs(b);
  }
  const double remainder = fabs(error_a > error_b ? a : b);
  return fmin(error_a, error_b) * fabs(b - a) + fabs(error_a - error_b) * remainder;
}

const char *sb_better_name(SbBetter better) {
  static const char *const names[] = {"none", "less", "more"};
  return names[better];
}

void sb_figures_clear(SbSummary *summary) {
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    *(double *)((char *)summary + figures[i].offset) = NAN;
    summary->error[i] = NAN;
  }
  memset(&summary->reasons, 0, sizeof summary->reasons); // 24 KB: not on the stack
}

void sb_figures_of_model(SbSummary *summary, const SbModel *model) {
  if (!sb_motion_kind(model)->valve) {
    return; // the plate has no glands and gives no dose
  }
  summary->metered_volume = model->supply.volume;
  summary->doses = (double)sb_chamber_doses(&model->supply);
  summary->filling_time = model->filling_time;
  summary->pressure_force = model->pressure_force;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    summary->seal[i].section_diameter = model->seal[i].section_diameter;
    summary->seal[i].modulus = model->seal[i].modulus;
    summary->seal[i].network = model->seal[i].storage.network;
    summary->seal[i].compression_set = model->seal[i].storage.compression_set;
    summary->seal[i].swell_share = model->seal[i].storage.uptake;
    summary->seal[i].squeeze = model->seal[i].squeeze;
    summary->seal[i].stretch_inner = model->seal[i].stretch_inner;
    summary->seal[i].gland_fill = model->seal[i].gland_fill;
  }
}

// Number of a text among the reasons, from 1. The last place takes what no longer fits.
static unsigned char text_number(SbReasons *reasons, const char *text) {
  size_t at = 0;
  while (at < reasons->count && strcmp(reasons->text[at], text) != 0) {
    at++;
  }
  if (at == SB_REASONS_MAX) {
    sb_message(reasons->text[--at], SB_TEXT, "one of several failures: see warnings");
  } else if (at == reasons->count) {
    sb_message(reasons->text[reasons->count++], SB_TEXT, "%s", text);
  }
  return (unsigned char)(at + 1);
}

static void SB_PRINTF(3, 0)
    give_reason(SbSummary *summary, const char *pattern, const char *format, va_list arguments) {
  char text[SB_TEXT];
  sb_message_v(text, sizeof text, format, arguments);
  size_t length = strlen(pattern);
  bool many = length > 0 && pattern[length - 1] == '*';
  unsigned char number = 0;
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    bool fits = strncmp(figures[i].path, pattern, many ? length - 1 : SIZE_MAX) == 0;
    if (fits && summary->reasons.of[i] == 0) {
      number = number > 0 ? number : text_number(&summary->reasons, text);
      summary->reasons.of[i] = number;
    }
  }
}

void sb_reason(SbSummary *summary, const char *pattern, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  give_reason(summary, pattern, format, arguments);
  va_end(arguments);
}

void sb_seal_reason(SbSummary *summary, int seal, const char *name, const char *format, ...) {
  char pattern[64];
  snprintf(pattern, sizeof pattern, "seals.%s.%s", sb_seal_name(seal), name);
  va_list arguments;
  va_start(arguments, format);
  give_reason(summary, pattern, format, arguments);
  va_end(arguments);
}

const char *sb_leak_state_name(SbLeakState state) {
  static const char *const names[] = {"not-computed", "closed", "percolating", "open"};
  return names[state];
}

const char *sb_outcome_name(SbOutcome outcome) {
  static const char *const names[] = {NULL, "never-moved", "stuck", "returned", "held"};
  return names[outcome];
}

const char *sb_stage_name(SbStage stage) {
  static const char *const names[SB_STAGE_COUNT] = {"A", "B", "C", "D", "E", "F"};
  return (unsigned)stage < SB_STAGE_COUNT ? names[stage] : "?";
}
