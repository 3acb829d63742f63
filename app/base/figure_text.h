// Figures of a run (engine/valve/figures/figures.h) as text. Every surface that prints a figure
// uses these functions, so that one figure is one number everywhere: table, terminal, window,
// report, verdict, chart labels. They choose the unit and, by the rounding rule of
// sb_format_decimals(), the digits.
#pragma once

#include "app/base/format.h"
#include "app/base/number.h"

#include "engine/valve/figures/figures.h"

// Number and unit of figure `index` with SI `value` and `error`, an estimate of its relative error
// (0: exact, an input; NaN: not known). True minus and thin spaces. "yes" or "no" for a question;
// an en dash where the value is not a number.
void sb_figure_parts(SbFormatted *out, int index, double value, double error);

// The parts with a no-break space between them, into `out` of SB_FORMAT_MAX bytes; returns `out`.
char *sb_figure_text(char *out, int index, double value, double error);

// sb_figure_text() of a run's own value and error estimate.
char *sb_format_figure(char *out, const SbSummary *summary, int index);

// The same number in plain ASCII for tables of a terminal and files: "-4.1 N"; "-" where the value
// is not a number. Owned by the caller (g_free).
char *sb_figure_format(int index, double value, double error);

// The absolute error [SI] of a figure with SI `value`, in the unit of the value and in plain ASCII,
// with its first digit, or its first two if the first one is 1 or 2: "0.02 N" for 27.40 N. "-"
// where one of the two is not a number. Owned by the caller (g_free).
char *sb_figure_error_format(int index, double value, double error);

// A limit of a figure, which is an input, in the unit of the figure: all its digits. A limit with
// more than 9 digits was computed (a saturation pressure); it has the digits of the figure. Owned
// by the caller (g_free).
char *sb_figure_given(int index, double value);

// A limit on a figure, an open end infinite: ">= 2 N", "8 % .. 25 %". Owned by the caller.
char *sb_limit_format(int figure, double low, double high);

// The label of a figure with its seal or stage: "Load, outer seal". Owned by the caller.
char *sb_figure_label(int index);

// Writes a number in plain ASCII by the rounding rule, with at most `digits` significant digits;
// `error` is relative, 0: exact. Zeros at the end are written where the number is rounded there.
void sb_number_with_error(char out[SB_NUMBER_SIZE], double shown, int digits, double error);

// One figure of one of several designs that are compared.
typedef struct {
  double value;     // SI; NaN: not known
  double error;     // relative; NaN: not known
  uint64_t methods; // of its model: sb_model_methods()
} SbFigureCompared;

// Returns the decimals, in the unit that sb_figure_compared_unit() chooses, with which a figure of
// `count` designs is printed next to each other: those that the error of the differences from the
// first design supports (sb_figure_difference_error()), and no more than the figure's digits.
int sb_figure_compared_decimals(int index, const SbFigureCompared *design, size_t count);

// Unit of all values of a comparison whose first one is `value`. Borrowed.
const char *sb_figure_compared_unit(int index, double value);

// Writes the value of design `at` of `count`, and its difference from the first design with a sign
// ("" for the first design, for a question and where one of the two is not known), with the
// decimals of sb_figure_compared_decimals(), in plain ASCII without the unit. Both texts have
// SB_FORMAT_MAX bytes. Returns the unit, borrowed; "" where there is no number.
const char *sb_figure_compared(char *value, char *change, int index, const SbFigureCompared *design,
                               size_t count, size_t at);
