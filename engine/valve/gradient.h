// Derivatives of figures by real parameters, at one model with overrides.
//
// What is differentiated is evaluate.h's answer, a deterministic function of the parameters: closed
// forms, located events, and equations solved by Newton's method to rounding. It is differentiated
// by central differences at two or more steps, extrapolated (Richardson), one-sided at an end of
// the parameter's range. An error is told with every derivative: what the last extrapolation
// changed, and the rounding that the step magnifies.
//
// Solved rings are the base's to first order in all that is changed (SbQuestion.tangent): two
// back-substitutions each with the active set fixed, on a mesh that follows the contacts
// (ring_ends.c), films linearised about the base's on their meshes (ehl_beside.c). Both are stored
// as slopes to the few numbers that they are given, so that parameters share them
// (sliding_beside.c); friction and motion are computed after them as in a run, in steps of 8e-6 of
// the parameter. The fixed set is contact and slip, the wetted faces, the places where the ring
// sticks to floor and walls, and the order of the curve that recovers the pressure. The error has
// three times the forces that violate the base's set in the perturbed state, over the step
// (ring_contact.h), and the scatter of slopes between meshes (gradient_rings.c). A full solve at
// another value of each such parameter then measures what the fixed set leaves out: a slope that
// disagrees with it is replaced by the difference of the full solves, with that one's error
// (gradient_rings.c; sb_gradient_is_solved()). The ring's friction on floor and walls depends on
// its history: there the difference from the slope to first order is tens of per cent. A ring that
// rolls or jams at the base has no tangent, and its figures have no derivative by what enters it.
// Parameters that do not enter the contacts (sb_evaluator_has_solved()) solve no ring, whatever the
// models.
//
// One acceptance test holds for every slope, and whoever uses slopes uses it: a slope that is
// smaller than its error is not known (reason "uncertain"). A figure that has the same bits on both
// sides does not depend on the parameter: its derivative is an exact 0, of error 0, and so is that
// of a figure which changes by no more than the rounding of what it is the sum of. It has none
// (NaN, with a reason) where the figure itself has no value, where the differences from both sides
// disagree at the smallest step as well (a kink), where they grow as the step shrinks (a jump: an
// event, a stage or an outcome appears or goes), and where no step has values on either side. A yes
// or no that jumps nowhere has the derivative 0.
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
// which is left without a last question. `start` of the question, borrowed: an evaluator that has
// answered the same question with `keep`, whose rings are then the base's; NULL: they are solved.
// SB_ERROR_INPUT: a parameter is not real; else as
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

// Whether the derivative is a difference of full solves (gradient_rings.c).
bool sb_gradient_is_solved(const SbGradient *gradient, size_t figure, size_t parameter);

// Figures with other values of some of its parameters, the last of a parameter counts, by their
// tangents: value[figure] in SI, first order in every change, microseconds. NaN where the figure
// has no derivative by a parameter that changes. SB_ERROR_INPUT for a parameter that it has not,
// SB_ERROR_RANGE for a value beyond its range; nothing is written then. Whether an event comes
// between is not known here: what it says stands in for a solve that is under way.
SbStatus sb_gradient_predict(double *value, const SbGradient *gradient, const SbOverride *override,
                             size_t count, SbReport *report);

// Whether there are derivatives by a parameter: it is real.
bool sb_gradient_wants(SbParamId id);
