// Figures of a run (engine/valve/figures/figures.h) as text. Every output that prints a figure uses
// these functions, so that a figure is the same number everywhere: table, terminal, window, report,
// verdict, chart labels. They choose the unit and, by the rounding rule of sb_format_decimals(),
// the digits. `index` is an index of sb_figure(). Any thread.
#pragma once

#include "app/base/format.h"
#include "app/base/number.h"

#include "engine/valve/figures/figures.h"

// Writes number and unit of a figure with the value `value` [SI] and `error`, an estimate of its
// relative error (0: exact, an input; NaN: not known), with a minus sign and thin spaces. "yes" or
// "no" for a figure without a unit that is 0 or 1; an en dash if the value is NaN.
void sb_figure_parts(SbFormatted *out, int index, double value, double error);

// Writes sb_figure_parts() with a no-break space between number and unit to out[SB_FORMAT_MAX] and
// returns `out`.
char *sb_figure_text(char *out, int index, double value, double error);

// Returns the relative error of a figure that tables and files report; NaN if it must not be
// reported: sb_figure_error_reason() then has the reason.
double sb_figure_error_reported(const SbSummary *summary, int index);

// As sb_figure_text(), with the value and error estimate of a run.
char *sb_format_figure(char *out, const SbSummary *summary, int index);

// As sb_figure_text(), of the figure "seals.outer.NAME" or "seals.inner.NAME", which must exist,
// for `name` ("film_min_m") and `seal`. `value` [SI] is its value at one state of a run, and the
// error is that of the figure in `summary`, the run; NULL: not known.
char *sb_seal_figure_text(char *out, const SbSummary *summary, int seal, const char *name,
                          double value);

// Returns number and unit of a figure as sb_figure_parts() in ASCII, for terminals and files:
// "-4.1 N"; "-" if the value is NaN.
char *sb_figure_format(int index, double value, double error);

// Returns the absolute error `error` [SI] of a figure with the value `value` [SI], in the display
// unit of the value and in ASCII, with its first digit, or its first two if the first one is 1 or
// 2: "0.02 N" for 27.40 N. "-" if one of the two is NaN.
char *sb_figure_error_format(int index, double value, double error);

// Returns a limit on a figure [SI] in the figure's unit with all its digits. A limit with more than
// 9 digits was computed (a saturation pressure) and has the digits of the figure.
char *sb_figure_given(int index, double value);

// Returns the limit low .. high [SI] on a figure as in a file: ">= 2 N", "8 % .. 25 %"; an infinite
// end is open.
char *sb_limit_format(int figure, double low, double high);

// Returns the figure that is the force at a stage, an index of sb_figure().
int sb_figure_stage_force(SbStage stage);

// Returns the label of a figure with its seal or stage, untranslated: "Load, outer seal".
char *sb_figure_label(int index);

// Writes the number `shown` in ASCII by the rounding rule, with at most `digits` significant
// digits; `error` is its relative error (0: exact; NaN: not known). Trailing zeros up to the
// rounding place are written.
void sb_number_with_error(char out[SB_NUMBER_SIZE], double shown, int digits, double error);

// One figure of one of several designs that are compared.
typedef struct {
  double value;     // SI; NaN: not known
  double error;     // relative; NaN: not known
  uint64_t methods; // of its model: sb_model_methods()
} SbFigureCompared;

// Returns the decimals, in the unit that sb_figure_compared_unit() chooses, with which a figure of
// `count` designs is printed next to each other: those that the error of the differences from the
// first design with a value other than 0 supports (sb_figure_difference_error()), and no more than
// the figure's digits; negative: tens, hundreds, ... A value that only one design has is printed as
// by sb_figure_format().
int sb_figure_compared_decimals(int index, const SbFigureCompared *design, size_t count);

// Returns the display unit of all values of a comparison: that of the first value other than 0.
// Static.
const char *sb_figure_compared_unit(int index, const SbFigureCompared *design, size_t count);

// Writes the value of design `at` (from 0) of `count`, and its difference from the first design
// with a sign, with the decimals of sb_figure_compared_decimals(), in plain ASCII without the unit.
// A value that is not known is "-", that of a figure without digits "yes" or "no". The difference
// is "" for the first design, for a figure that is yes or no, and where one of the two is not
// known. Both texts have SB_FORMAT_MAX bytes. Returns the unit, static; "" where the value is not a
// number.
const char *sb_figure_compared(char *value, char *change, int index, const SbFigureCompared *design,
                               size_t count, size_t at);
