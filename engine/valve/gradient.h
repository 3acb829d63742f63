// Derivatives of figures by real parameters, at one model with overrides.
//
// What is differentiated is evaluate.h's answer, a deterministic function of the parameters: closed
// forms, located events, and equations solved by Newton's method to rounding. It is differentiated
// by central differences at two or more steps, extrapolated (Richardson), one-sided at an end of
// the parameter's range. An error is told with every derivative: what the last extrapolation
// changed, and the rounding that the step magnifies.
//
// Solved rings are the base's to first order in all that is changed (SbQuestion.tangent): two
// back-substitutions each with the active set held, on a mesh that follows the contacts
// (ring_ends.c), films beside the base's on their meshes (ehl_beside.c), both kept as slopes to the
// few numbers that they are given, so that parameters share them (sliding_beside.c); friction and
// motion computed after them as ever, in steps of 8e-6 of the parameter. What is differentiated so
// is the figure that the run reports along the active set of its base: contact and slip, the wetted
// faces, the order of the curve that recovers the pressure. Those are kinks of the discrete
// contact, one at each node, not of the figure, so they give no reason for having no derivative.
// What they do to it is told in the error: three times the forces that violate the base's set
// beside it, over the step (ring_contact.h), in smooth grooves 0, with friction on floor and walls
// usually per cents: there the nodes that slide in the base stick as soon as a change leads them
// back. Nodes that stick keep their place on floor and walls; a ring that pressure or gland.start
// laid on its wall goes with it, and where friction dragged it there the error has what the floor's
// friction could change by on a longer way. Differences of solved rings 2 % to
// either side, each on a mesh of its own, are 1 to 3 % away where the base's pressure is a smooth
// curve, and more where a strong drag folds it up at one end, films first: the error has a share of
// what load, width and peak change by, a small one of loads, three quarters for films. A slope that
// is less than such an error is not told. A ring that rolls or jams at the base has no tangent, and
// its figures no derivative by what enters it. Parameters that do not enter the contacts
// (sb_evaluator_has_solved()) ask none again, whatever the models.
//
// A figure that has the same bits on both sides does not depend on the parameter: its derivative is
// an exact 0, of error 0. It has none (NaN, with a reason) where the figure itself has no value,
// where the differences from both sides disagree at the smallest step as well (a kink), where they
// grow as the step shrinks (a jump: an event, a stage or an outcome appears or goes), and where no
// step has values on either side, and where a ring's slope is less than its error. A yes or no that
// jumps nowhere has the derivative 0.
//
// A parameter is moved as an override moves it: what follows from it (a seal's own size from that
// of both, a fluid's properties from its temperature) moves with it; one that a choice or another
// parameter would give keeps what the step gives it.
//
// Leaves out: whole numbers, choices and flags; second derivatives.
#pragma once

#include "engine/valve/evaluate.h"

typedef struct SbGradient SbGradient;

// Derivatives of the question's figures by `count` parameters, all real. On SB_OK *out is owned by
// the caller; it copies what it needs of the question. Each thread needs an evaluator of its own,
// which is left without a last question. SB_ERROR_INPUT: a parameter is not real; else as
// sb_evaluator_ask(), SB_ERROR_NOT_CONVERGED with *out, whose figures have values, others NaN; *out
// is NULL otherwise. Progress: `done` of `count` parameters, on this thread; may be NULL.
typedef void (*SbGradientProgress)(void *data, size_t done, size_t count);
SbStatus sb_gradient_create(SbGradient **out, SbEvaluator *evaluator, const SbQuestion *question,
                            const SbParamId *parameter, size_t count, SbGradientProgress progress,
                            SbReport *report);

// Takes NULL.
void sb_gradient_destroy(SbGradient *gradient);

// What it holds: figures and parameters in the order of the question. Borrowed.
size_t sb_gradient_figures(const SbGradient *gradient);
size_t sb_gradient_parameters(const SbGradient *gradient);
int sb_gradient_figure(const SbGradient *gradient, size_t figure);             // of figures.def
SbParamId sb_gradient_parameter(const SbGradient *gradient, size_t parameter); // of params.def
double sb_gradient_at(const SbGradient *gradient, size_t parameter); // value of it there, SI

// Value of figure `figure` < sb_gradient_figures() at the base, SI; NaN: none.
double sb_gradient_value(const SbGradient *gradient, size_t figure);

// Its derivative by a parameter, SI, and the estimate of that one's absolute error; both NaN where
// the reason says why.
double sb_gradient_slope(const SbGradient *gradient, size_t figure, size_t parameter);
double sb_gradient_error(const SbGradient *gradient, size_t figure, size_t parameter);

// Why a figure has no derivative by a parameter; NULL where it has one. Borrowed.
const char *sb_gradient_reason(const SbGradient *gradient, size_t figure, size_t parameter);

// Figures with other values of some of its parameters, the last of a parameter counts, by their
// tangents: value[figure] in SI, first order in every change, microseconds. NaN where the figure
// has no derivative by a parameter that changes. SB_ERROR_INPUT for a parameter that it has not,
// SB_ERROR_RANGE for a value beyond its range; nothing is written then. Whether an event comes
// between is not known here: what it says stands in for a solve that is under way.
SbStatus sb_gradient_predict(double *value, const SbGradient *gradient, const SbOverride *override,
                             size_t count, SbReport *report);

// Whether there are derivatives by a parameter: it is real.
bool sb_gradient_wants(SbParamId id);
