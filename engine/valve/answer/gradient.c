// Differences of evaluate's answers, extrapolated, with their errors; see the header.
//
// At a step h a smooth figure has, from its values on both sides of its base's f0,
//   D(h) = (f(+h) - f(-h))/2h = f' + O(h^2),   R = (4 D(h/2) - D(h))/3 = f' + O(h^4)
// and the slopes towards both sides differ by f'' h: half as much at h/2. At a kink they differ by
// the same at any step; at a jump, and in rounding, by more the smaller it is. At an end of the
// range one-sided slopes d(h), d(h/2), d(h/4) are extrapolated twice. The error is |R - D(h/2)|,
// that of the last but one order, and what rounding leaves in it.
#include "engine/valve/answer/gradient_private.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PLUS, MINUS, PLUS_HALF, MINUS_HALF, POINTS };
enum { HALF = MINUS, QUARTER = PLUS_HALF };
_Static_assert((int)POINTS == (int)SB_GRADIENT_POINTS, "other points");
enum {
  FIRST = SB_GRADIENT_FIRST,
  SMALLEST = SB_GRADIENT_SMALLEST,
  LARGE = SB_GRADIENT_LARGE,
  RINGS = SB_GRADIENT_RINGS,
  LEVELS = SB_GRADIENT_LEVELS
};

typedef SbGradientLevel Level;
typedef SbGradientWork Work;

const double sb_gradient_parts[SB_GRADIENT_LEVELS] = {1e-3, 6e-5, 4e-6, 1.6e-2, 8e-6, 1.3e-4};

double *sb_gradient_values(const Work *work, int level, int point) {
  return work->value + (size_t)(level * POINTS + point) * work->out->figures;
}

static double *value_of(const Work *work, int level, int point) {
  return sb_gradient_values(work, level, point);
}

bool sb_gradient_ends(SbStatus status) {
  return status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY;
}

static bool ends(SbStatus status) {
  return sb_gradient_ends(status);
}

// Figures with the parameter at x; NaN where there are none.
SbStatus sb_gradient_ask(Work *work, double *value, double x, bool note) {
  work->override[work->question.override_count - 1].value = x;
  SbReport report;
  const bool own = sb_evaluator_has_solved(work->evaluator, &work->question);
  SbEvaluator *by = own ? work->evaluator : work->other;
  work->question.start = own ? work->own_start : work->start;
  work->question.tangent = work->question.start != NULL;
  SbStatus status = sb_evaluator_ask(value, by, &work->question, &report);
  work->refused = status == SB_ERROR_INPUT || status == SB_ERROR_RANGE;
  if (status != SB_OK) {
    work->report = report;
  }
  SbGradientOutcome now;
  const SbSummary *summary = sb_evaluator_summary(by);
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    work->fault[i] = summary != NULL ? summary->ring_fault[i] : 0;
  }
  if (summary != NULL) {
    sb_gradient_contacts(&work->moved, summary);
  }
  sb_gradient_outcome(&now, summary);
  if (note && work->changed[0] == '\0') {
    (void)sb_gradient_differ(work->changed, sizeof work->changed, &work->outcome, &now);
  }
  return status;
}

static SbStatus ask(Work *work, double *value, double x, bool note) {
  return sb_gradient_ask(work, value, x, note);
}

// ---- One parameter

// Change of a figure, relative to its size, below which a slope is rounding: twice ROUNDING
// (gradient_slope.c) over the first step.
static const double NIL = 8e-11;

// Returns whether a derivative with its error is accurate enough: relative to itself, or to the
// change of the figure when the parameter changes by itself.
static bool enough(const SbGradientEstimate *of, double size, double scale) {
  return of->kind == SB_GRADIENT_SMOOTH &&
         of->error <= fmax(1e-6 * fabs(of->slope), 1e-12 * size / scale);
}

// Returns the scale of a parameter's steps.
static double scale_of(SbParamId id, double x) {
  const SbParam *param = sb_param(id);
  return x != 0 ? fabs(x) : param->fallback != 0 ? fabs(param->fallback) : param->max - param->min;
}

// Returns whether figure `figure`, or every one, has at points up to `points` of a level its base's
// bits.
static bool same_bits(const Work *work, int at, int points, size_t figure) {
  for (int i = 0; i < points; i++) {
    if (memcmp(&value_of(work, at, i)[figure], &work->base_value[figure], sizeof(double)) != 0) {
      return false;
    }
  }
  return true;
}

static bool all_same(const Work *work, int at, int points) {
  for (size_t i = 0; i < work->out->figures; i++) {
    if (work->open[i] && !same_bits(work, at, points, i)) {
      return false;
    }
  }
  return true;
}

// Returns whether the outer points of a level determine all figures well.
static bool pair_tells(Work *work, int at) {
  bool well = true;
  work->level[at].pair = true;
  for (size_t i = 0; i < work->out->figures && well; i++) {
    SbGradientEstimate now;
    sb_gradient_estimate(&now, work, at, i);
    well = !work->open[i] || now.kind == SB_GRADIENT_SMOOTH;
  }
  work->level[at].pair = well;
  return well;
}

// Evaluates the points of a level, and reports which sides the model refused.
static SbStatus ask_places(Work *work, int at, double x, bool *refused) {
  static const double sides[POINTS] = {1, -1, 0.5, -0.5}, one[POINTS] = {1, 0.5, 0.25, 0.25};
  Level *level = &work->level[at];
  const size_t size = work->out->figures * sizeof *work->value;
  const double *places = level->one_sided ? one : sides;
  refused[0] = refused[1] = false;
  level->asked = true;
  memset(level->fault, 0, sizeof level->fault);
  for (int i = 0; i < POINTS; i++) {
    if (i == 2 && at >= RINGS && !level->one_sided) {
      // A value that is given may mean more than the same by default.
      if (!pair_tells(work, at)) {
        SbStatus status = ask(work, work->base_value, x, false);
        if (ends(status)) {
          return status;
        }
      }
      if (pair_tells(work, at)) {
        break;
      }
    }
    // If the outermost points do not change anything, the inner ones do not either.
    if ((i == 2 && all_same(work, at, 2)) || (i == 3 && level->one_sided)) {
      memcpy(value_of(work, at, i), value_of(work, at, i - 1), size);
      continue;
    }
    SbStatus status =
        ask(work, value_of(work, at, i), x + places[i] * level->h, at == SMALLEST || at >= RINGS);
    if (ends(status)) {
      return status;
    }
    work->up = i == 0 ? work->moved : work->up;
    refused[places[i] * level->h < 0] |= work->refused;
    if (i < 2) {
      const double half = 0.5 / fabs(places[i] * level->h);
      for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
        level->fault[seal] += half * work->fault[seal];
      }
      level->fault[SB_SEAL_COUNT] += half * fmax(work->fault[SB_OUTER], work->fault[SB_INNER]);
    }
  }
  return SB_OK;
}

// Does the same, on one side if the range or the model does not have the other one.
static SbStatus ask_level(Work *work, int at, double x, double h, const SbParam *param) {
  bool side[2] = {x + h <= param->max, x - h >= param->min};
  for (int round = 0; round < 2 && (side[0] || side[1]); round++) {
    bool refused[2];
    work->level[at].one_sided = !side[0] || !side[1];
    work->level[at].h = side[0] ? h : -h;
    SbStatus status = ask_places(work, at, x, refused);
    if (ends(status) || work->level[at].one_sided || refused[0] == refused[1]) {
      return status;
    }
    side[0] = !refused[0];
    side[1] = !refused[1];
  }
  return SB_OK;
}

// Takes the figures that a level determines; returns whether figures are left that a smaller or
// larger step may determine.
static void take(Work *work, int at, size_t parameter, double scale, bool *smaller, bool *larger) {
  *smaller = *larger = false;
  for (size_t i = 0; i < work->out->figures; i++) {
    SbGradientEstimate now;
    if (!work->open[i] || !work->level[at].asked) {
      *smaller |= work->open[i];
      continue;
    }
    sb_gradient_estimate(&now, work, at, i);
    const bool well =
        at >= RINGS ? now.kind == SB_GRADIENT_SMOOTH : enough(&now, work->size[i], scale);
    if (same_bits(work, at, work->level[at].pair ? 2 : POINTS, i)) {
      sb_gradient_set(work, parameter, i, 0, 0);
    } else if (well) {
      sb_gradient_set(work, parameter, i, now.slope, now.error);
    } else {
      const bool hidden = now.kind == SB_GRADIENT_SMOOTH && now.hidden;
      *larger |= hidden;
      *smaller |= !hidden;
    }
  }
}

// Returns whether a parameter enters rings.
static bool enters_rings(Work *work, double x, double scale) {
  work->override[work->question.override_count - 1].value = x + sb_gradient_parts[RINGS] * scale;
  return work->start != NULL && !sb_evaluator_has_solved(work->evaluator, &work->question);
}

// The acceptance test of every slope, which all users of slopes share: a slope that is smaller than
// its error is not known. It is 0 where the figure changes by less than the rounding of what it is
// the sum of, NIL, as the parameter changes by its own value.
static void accept(Work *work, size_t parameter, double scale) {
  SbGradient *out = work->out;
  for (size_t i = 0; i < out->figures; i++) {
    const size_t cell = i * out->parameters + parameter;
    const double slope = fabs(out->slope[cell]);
    if (!(slope < out->error[cell])) {
      continue;
    }
    if (slope * scale <= NIL * work->size[i]) {
      sb_gradient_set(work, parameter, i, 0, 0);
    } else {
      sb_gradient_refuse(work, parameter, i, SB_GRADIENT_UNCERTAIN);
    }
  }
}

// Features of a groove that it may do without: where it does, rings have no slope by them that is
// worth a tenth of all others' time.
static bool is_feature(SbParamId id) {
  return id == SB_P_GLAND_DRAFT || id == SB_P_GLAND_CORNER_RADIUS || id == SB_P_GLAND_EDGE_CHAMFER;
}

static SbStatus differentiate(Work *work, size_t parameter) {
  SbGradient *out = work->out;
  const SbParamId id = out->parameter[parameter];
  const double x = out->at[parameter], scale = scale_of(id, x);
  bool smaller = true, larger = true;
  work->override[work->question.override_count - 1].id = id;
  work->changed[0] = '\0';
  memset(work->level, 0, sizeof work->level);
  for (size_t i = 0; i < out->figures; i++) {
    work->open[i] = isfinite(out->value[i]);
  }
  work->rings = enters_rings(work, x, scale);
  if (work->rings && x == 0 && is_feature(id)) {
    for (size_t i = 0; i < out->figures; i++) {
      if (work->open[i]) {
        sb_gradient_refuse(work, parameter, i, "not known at 0: the groove does without it");
      }
    }
    return SB_OK;
  }
  memcpy(work->base_value, work->rings ? work->ring_value : work->own_value,
         out->figures * sizeof *out->value);
  for (int at = work->rings ? RINGS : FIRST; at < (work->rings ? LEVELS : RINGS); at++) {
    if (at == LARGE ? !larger : !smaller) {
      continue;
    }
    SbStatus status = ask_level(work, at, x, sb_gradient_parts[at] * scale, sb_param(id));
    bool more;
    if (ends(status)) {
      return status;
    }
    take(work, at, parameter, scale, &smaller, &more);
    larger = at == FIRST ? more : larger || more;
    if (at == FIRST && smaller) { // a value that is given may mean more than the same by default
      status = ask(work, work->base_value, x, false);
      if (ends(status)) {
        return status;
      }
      take(work, at, parameter, scale, &smaller, &larger);
    }
  }
  for (size_t i = 0; i < out->figures; i++) {
    if (work->open[i]) {
      sb_gradient_settle(work, parameter, i);
    }
  }
  SbStatus status = work->rings ? sb_gradient_check_rings(work, parameter, x, scale) : SB_OK;
  accept(work, parameter, scale);
  return ends(status) ? status : SB_OK;
}

// ---- All

static SbStatus set_up(Work *work, const SbQuestion *question) {
  const size_t n = question->figure_count, overrides = question->override_count + 1;
  work->override = calloc(overrides, sizeof *work->override);
  work->base_value = calloc(n + 1, sizeof *work->base_value);
  work->own_value = calloc(2 * n + 1, sizeof *work->own_value); // and those of the rings
  work->size = calloc(n + 1, sizeof *work->size);
  work->value = calloc((n + 1) * LEVELS * POINTS, sizeof *work->value);
  work->open = calloc(n + 1, sizeof *work->open);
  work->follows = calloc(n + 1, sizeof *work->follows);
  if (work->override == NULL || work->base_value == NULL || work->own_value == NULL ||
      work->size == NULL || work->value == NULL || work->open == NULL || work->follows == NULL) {
    return SB_ERROR_MEMORY;
  }
  work->ring_value = work->own_value + n;
  if (sb_evaluator_create(&work->other, NULL) != SB_OK) {
    return SB_ERROR_MEMORY;
  }
  for (size_t i = 0; i < question->override_count; i++) {
    work->override[i] = question->override[i];
  }
  work->question = *question;
  work->question.override = work->override;
  work->question.override_count = overrides;
  return SB_OK;
}

// Solves the base's rings, from which all others are found to first order, unless the question
// brings them.
static SbStatus find_start(Work *work, const SbQuestion *question, SbReport *report) {
  SbQuestion base = *question;
  SbModel *model;
  SbStatus status = sb_model_derive(&model, base.base, base.override, base.override_count, report);
  const bool rings = status == SB_OK && sb_model_fit(model)->section;
  work->tolerance = status == SB_OK ? sb_model_value(model, SB_P_OUTPUT_TOLERANCE) : NAN;
  sb_model_destroy(model);
  if (status != SB_OK || !rings) {
    return status;
  }
  if (question->start != NULL) {
    work->start = question->start;
    for (size_t i = 0; i < question->figure_count; i++) {
      work->out->value[i] = sb_figure_value(sb_evaluator_summary(work->start), question->figure[i]);
    }
    return SB_OK;
  }
  status = sb_evaluator_create(&work->own_rings, report);
  work->start = work->own_rings;
  base.keep = true;
  return status == SB_OK ? sb_evaluator_ask(work->out->value, work->own_rings, &base, report)
                         : status;
}

// The base's own answer, what it is with its rings to first order, and the parameters' values
// there.
static SbStatus begin(Work *work, const SbQuestion *question, SbReport *report) {
  SbGradient *out = work->out;
  SbQuestion base = *question;
  SbStatus status = find_start(work, question, report);
  if (status != SB_OK && status != SB_ERROR_NOT_CONVERGED) {
    return status;
  }
  const SbStatus solved = status;
  const SbReport of_solved = *report;
  base.start = work->own_start = work->start;
  base.tangent = work->start != NULL;
  status = sb_evaluator_ask(work->own_value, work->evaluator, &base, report);
  memcpy(work->ring_value, work->own_value, out->figures * sizeof *out->value);
  if (status == SB_ERROR_NOT_CONVERGED && solved == SB_OK && work->start != NULL) {
    // Rings without a linearisation: figures that do not depend on them use the solved ones.
    base.start = work->own_start = NULL;
    base.tangent = false;
    status = sb_evaluator_ask(work->own_value, work->evaluator, &base, report);
  }
  if (status != SB_OK && status != SB_ERROR_NOT_CONVERGED) {
    return status;
  }
  const SbEvaluator *by = work->start != NULL ? work->start : work->evaluator;
  if (work->start == NULL) {
    memcpy(out->value, work->own_value, out->figures * sizeof *out->value);
  }
  const SbSummary *own = sb_evaluator_summary(work->evaluator);
  sb_gradient_outcome(&work->outcome, own);
  if (own != NULL) {
    sb_gradient_contacts(&work->contacts, own);
    work->order = own->ring_order;
  }
  for (size_t i = 0; i < out->parameters; i++) {
    out->at[i] = sb_model_value(sb_evaluator_model(by), out->parameter[i]);
  }
  for (size_t i = 0; i < out->figures; i++) {
    const char *why = sb_evaluator_reason(by, out->figure[i]);
    out->value_error[i] = sb_figure_error(sb_evaluator_summary(by), out->figure[i]);
    work->size[i] = sb_gradient_size(sb_evaluator_summary(by), out->figure[i]);
    for (size_t k = 0; why != NULL && k < out->parameters; k++) {
      sb_gradient_refuse(work, k, i, "%s", why);
    }
  }
  if (work->start == NULL) {
    return status;
  }
  *report = of_solved;
  return solved;
}

SbStatus sb_gradient_create(SbGradient **out, SbEvaluator *evaluator, const SbQuestion *question,
                            const SbParamId *parameter, size_t count, SbGradientProgress progress,
                            SbReport *report) {
  *out = NULL;
  for (size_t i = 0; i < count; i++) {
    if (!sb_gradient_wants(parameter[i])) {
      return sb_fail_input(report, SB_ERROR_INPUT, sb_input(parameter[i]),
                           "no real number: nothing can be differentiated by it");
    }
  }
  SbReport own = {0};
  Work work = {.evaluator = evaluator, .out = sb_gradient_make(question, parameter, count)};
  SbStatus status = work.out != NULL ? set_up(&work, question) : SB_ERROR_MEMORY;
  status = status == SB_OK ? begin(&work, question, &own)
                           : sb_fail(&own, status, "no memory for derivatives");
  SbStatus answer = status;
  for (size_t i = 0; i < count && (status == SB_OK || status == SB_ERROR_NOT_CONVERGED); i++) {
    status = differentiate(&work, i);
    if (ends(status)) {
      own = work.report;
    } else if (progress != NULL) {
      progress(question->data, i + 1, count);
    }
  }
  const bool well = status == SB_OK || status == SB_ERROR_NOT_CONVERGED;
  free(work.override);
  free(work.base_value);
  free(work.own_value);
  free(work.size);
  free(work.value);
  free(work.open);
  free(work.follows);
  // The caller's evaluator must not refer to what is freed here.
  sb_evaluator_forget(evaluator);
  sb_evaluator_destroy(work.other);
  sb_evaluator_destroy(work.own_rings);
  if (well) {
    *out = work.out;
  } else {
    sb_gradient_destroy(work.out);
  }
  if (report != NULL) {
    *report = own;
  }
  return well ? answer : status;
}
