// The slope of one figure from its values at a level, and which of several levels applies; see
// gradient.c for the equations.
#include "engine/valve/answer/gradient_private.h"

#include <math.h>
#include <stdarg.h>

enum { PLUS, MINUS, PLUS_HALF, MINUS_HALF, POINTS };
enum { HALF = MINUS, QUARTER = PLUS_HALF };
enum { FIRST = SB_GRADIENT_FIRST, RINGS = SB_GRADIENT_RINGS, LEVELS = SB_GRADIENT_LEVELS };

typedef SbGradientLevel Level;
typedef SbGradientWork Work;

// Fraction of a figure by which two answers of one solver may differ; of linearised rings, whose
// contacts' ends are found to that accuracy.
static const double ROUNDING = 4e-14, RINGS_ROUNDING = 1e-10;

// Share of a slope by which those towards both sides may differ for the outer pair of points to be
// enough: what that leaves out is of the order of this share's square. Or what they differ by is
// this part of the figure where the parameter changes by itself.
static const double PAIR = 3e-2, LITTLE = 3e-3;

// By how much more than the forces that violate a ring's active set its figures change once that
// is renewed (measured: 1.3 in the middle, more than 3 only where it is below 2e-3 of the slope).
static const double RESPONSE = 3;

void sb_gradient_estimate(SbGradientEstimate *out, const Work *work, int at, size_t figure) {
  const Level *level = &work->level[at];
  const double f0 = work->base_value[figure], h = level->h;
  double f[POINTS], nearest, last;
  for (int i = 0; i < POINTS; i++) {
    f[i] = sb_gradient_values(work, at, i)[figure];
  }
  if (level->one_sided) {
    const double d1 = (f[PLUS] - f0) / h, d2 = 2 * (f[HALF] - f0) / h;
    const double d4 = 4 * (f[QUARTER] - f0) / h;
    const double first = 2 * d2 - d1;
    last = 2 * d4 - d2;
    *out = (SbGradientEstimate){.slope = (4 * last - first) / 3,
                                .apart = fabs(d4 - d2),
                                .before = fabs(d2 - d1),
                                .step = fabs(h) / 4};
    nearest = fabs(d4);
  } else if (level->pair) {
    const double up = (f[PLUS] - f0) / h, down = (f0 - f[MINUS]) / h;
    *out = (SbGradientEstimate){.slope = (up + down) / 2, .apart = fabs(up - down), .step = h};
    nearest = fmax(fabs(up), fabs(down));
    const bool little = out->apart * h / sb_gradient_parts[at] <= LITTLE * work->size[figure];
    out->before = out->apart <= PAIR * nearest || little ? INFINITY : 0;
    last = out->slope - (nearest > 0 ? out->apart * fmin(out->apart / nearest, 1) : 0);
  } else {
    const double up = 2 * (f[PLUS_HALF] - f0) / h, down = 2 * (f0 - f[MINUS_HALF]) / h;
    last = (f[PLUS_HALF] - f[MINUS_HALF]) / h;
    *out = (SbGradientEstimate){.slope = (4 * last - (f[PLUS] - f[MINUS]) / (2 * h)) / 3,
                                .apart = fabs(up - down),
                                .before = fabs((f[PLUS] - f0) / h - (f0 - f[MINUS]) / h),
                                .step = h / 2};
    nearest = fmax(fabs(up), fabs(down));
  }
  const int seal = sb_figure(work->question.figure[figure])->seal;
  const double part = at >= RINGS ? RINGS_ROUNDING : ROUNDING;
  const double rounding = part * work->size[figure] / out->step;
  out->error =
      fabs(out->slope - last) + 2 * rounding + RESPONSE * level->fault[seal] * work->size[figure];
  out->hidden = 2 * rounding > 0.5 * out->error;
  const bool falls = out->apart < 0.75 * out->before;
  const bool small = out->apart <= fmax(1e-4 * nearest, 8 * rounding);
  out->error += !falls && small ? out->apart / 2 : 0;
  out->kind = !isfinite(out->slope) || !isfinite(out->error) ? SB_GRADIENT_MISSING
              : falls || small                               ? SB_GRADIENT_SMOOTH
                                                             : SB_GRADIENT_ROUGH;
}

void sb_gradient_set(Work *work, size_t parameter, size_t figure, double slope, double error) {
  const size_t cell = figure * work->out->parameters + parameter;
  work->out->slope[cell] = slope;
  work->out->error[cell] = error;
  work->open[figure] = false;
}

void sb_gradient_refuse(Work *work, size_t parameter, size_t figure, const char *format, ...) {
  char text[SB_GRADIENT_TEXT];
  va_list arguments;
  va_start(arguments, format);
  sb_message_v(text, sizeof text, format, arguments);
  va_end(arguments);
  sb_gradient_set(work, parameter, figure, NAN, NAN);
  work->out->why[figure * work->out->parameters + parameter] = sb_gradient_text(work->out, text);
}

void sb_gradient_settle(Work *work, size_t parameter, size_t figure) {
  SbGradientEstimate best = {.kind = SB_GRADIENT_MISSING}, least = {.kind = SB_GRADIENT_MISSING},
                     most = {.kind = SB_GRADIENT_MISSING};
  for (int i = 0; i < LEVELS; i++) {
    SbGradientEstimate now;
    if (!work->level[i].asked) {
      continue;
    }
    sb_gradient_estimate(&now, work, i, figure);
    if (now.kind == SB_GRADIENT_MISSING) {
      continue;
    }
    if (now.kind == SB_GRADIENT_SMOOTH &&
        (best.kind == SB_GRADIENT_MISSING || now.error < best.error)) {
      best = now;
    }
    least = least.kind == SB_GRADIENT_MISSING || now.step < least.step ? now : least;
    most = most.kind == SB_GRADIENT_MISSING || now.step > most.step ? now : most;
  }
  if (best.kind == SB_GRADIENT_SMOOTH &&
      (least.kind == SB_GRADIENT_SMOOTH || best.error < 1e-3 * fabs(best.slope))) {
    sb_gradient_set(work, parameter, figure, best.slope, best.error);
    return;
  }
  if (least.kind == SB_GRADIENT_MISSING) {
    sb_gradient_refuse(work, parameter, figure, "%s: %s",
                       work->refused ? "there is no other value"
                                     : "the figure has no value next to it",
                       work->report.text[0] != '\0' ? work->report.text : work->changed);
    work->out->fixed[figure * work->out->parameters + parameter] = work->refused;
    return;
  }
  // The smallest step determines how far a figure jumps or scatters.
  const double jump = least.apart * least.step;
  const bool scatters = jump < 1e-6 * work->size[figure] && least.apart > 3 * most.apart;
  if (scatters) {
    sb_gradient_set(work, parameter, figure, most.slope, most.error + jump / most.step);
  } else if (work->changed[0] != '\0') {
    sb_gradient_refuse(work, parameter, figure, "%s", work->changed);
  } else if (work->level[FIRST].one_sided) {
    sb_gradient_refuse(work, parameter, figure,
                       "no finite slope at the end of the parameter's range");
  } else {
    sb_gradient_refuse(work, parameter, figure,
                       "it bends or jumps there: the slopes to both sides differ");
  }
}
