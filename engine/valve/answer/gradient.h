// Derivatives of figures with respect to real parameters, at a model with overrides.
//
// Use: sb_gradient_create() with a question of evaluate.h, then read the slopes. The differentiated
// function is the answer to this question: closed forms, located events, and equations solved to
// rounding. Derivatives are central differences at two or more steps with Richardson extrapolation,
// one-sided at an end of the parameter's range. Each has an error estimate: the last change by
// extrapolation, and the rounding that the step amplifies.
//
// Solved rings are linearised about the base (SbQuestion.tangent): two back-substitutions with a
// constant active set, on a mesh that follows the contacts (ring_ends.c), and films linearised on
// the base's meshes (ehl_beside.c). Both are stored as slopes, which parameters share
// (sliding_beside.c); friction and motion are computed as in a run, with steps of 8e-6 of the
// parameter. The error includes three times the forces that violate the base's active set divided
// by the step, and the scatter between meshes (gradient_rings.c). A full solve at another value of
// each such parameter checks the slope; if they disagree, the difference of full solves replaces it
// (sb_gradient_is_solved()). A ring that rolls or jams at the base has no linearisation: figures
// that depend on it have no derivative. Parameters that do not affect the contacts
// (sb_evaluator_has_solved()) need no ring.
//
// A slope smaller than its error is NaN with the reason "uncertain". If a figure is bit-identical
// on both sides, or changes by rounding only, its derivative is exactly 0. A derivative does not
// exist (NaN with a reason) if the figure has no value, at a kink (one-sided differences disagree
// at the smallest step), at a jump (differences grow as the step shrinks: an event, stage or
// outcome changes), or if no step has values. A figure that is yes or no has the derivative 0 if it
// does not change.
//
// A parameter changes like an override: values that follow from it change too. Not available:
// derivatives with respect to integers, choices and flags; second derivatives.
#pragma once

#include "engine/valve/answer/evaluate.h"

// Derivatives of figures; constant after its creation, so several threads may read it.
typedef struct SbGradient SbGradient;

// Reports that `done` of `count` parameters are finished; called in the thread of
// sb_gradient_create().
typedef void (*SbGradientProgress)(void *data, size_t done, size_t count);

// Computes the derivatives of the figures of `question` with respect to parameter[count], at the
// model of the question with its overrides. All parameters must be real (sb_gradient_wants()).
// `evaluator` is work memory; afterwards it has no solved contacts, and its last answer is
// meaningless. question->start is NULL, or an evaluator to which the same question with `keep` was
// asked last (borrowed during the call; saves solving the rings of the base); keep, tangent and
// rings must be 0. `progress` (NULL: none) gets question->data. Free *out with
// sb_gradient_destroy().
//   SB_ERROR_INPUT          a parameter is not real
//   SB_ERROR_NOT_CONVERGED  *out is created; figures without a value have no derivative
//
// SB_ERROR_RANGE, SB_ERROR_INPUT (the question is refused), SB_ERROR_INFEASIBLE (the base has no
// solution) and SB_ERROR_CANCELLED as for sb_evaluator_ask(), with *out = NULL.
SbStatus sb_gradient_create(SbGradient **out, SbEvaluator *evaluator, const SbQuestion *question,
                            const SbParamId *parameter, size_t count, SbGradientProgress progress,
                            SbReport *report);

// Frees the derivatives.
void sb_gradient_destroy(SbGradient *gradient);

// Returns the number of figures.
size_t sb_gradient_figures(const SbGradient *gradient);

// Returns the number of parameters.
size_t sb_gradient_parameters(const SbGradient *gradient);

// Returns the index for sb_figure() of figure number `figure`, from 0 in the order of
// question->figure. All functions below count figures and parameters in this way.
int sb_gradient_figure(const SbGradient *gradient, size_t figure);

// Returns the parameter number `parameter`, from 0 in the order of the call.
SbParamId sb_gradient_parameter(const SbGradient *gradient, size_t parameter);

// Returns the value of parameter number `parameter` at the base, SI.
double sb_gradient_at(const SbGradient *gradient, size_t parameter);

// Returns the value of figure number `figure` at the base, SI; NaN if it was not computed.
double sb_gradient_value(const SbGradient *gradient, size_t figure);

// Returns the estimated relative error of sb_gradient_value(), as sb_figure_error() of a run.
double sb_gradient_value_error(const SbGradient *gradient, size_t figure);

// Returns the derivative of a figure with respect to a parameter: SI unit of the figure per SI unit
// of the parameter. NaN: sb_gradient_reason() returns why.
double sb_gradient_slope(const SbGradient *gradient, size_t figure, size_t parameter);

// Returns the estimated absolute error of sb_gradient_slope(), in its unit; NaN if the slope is
// NaN.
double sb_gradient_error(const SbGradient *gradient, size_t figure, size_t parameter);

// Returns why a figure has no derivative with respect to a parameter; NULL if it has one. Borrowed.
const char *sb_gradient_reason(const SbGradient *gradient, size_t figure, size_t parameter);

// Returns whether the derivative is a difference of full solves instead of a linearisation
// (gradient_rings.c).
bool sb_gradient_is_solved(const SbGradient *gradient, size_t figure, size_t parameter);

// Returns whether a figure has no derivative with respect to a parameter because the model accepts
// no other value of the parameter.
bool sb_gradient_is_fixed(const SbGradient *gradient, size_t figure, size_t parameter);

// Returns whether a parameter may be differentiated: it is real.
bool sb_gradient_wants(SbParamId id);
