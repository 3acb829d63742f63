// Friction of a rough contact with a memory of its sliding: the content of fluid in its cells.
//
// Where hardly any channel is open, fluid cannot flow through a contact of width 2 b. It is
// carried: a cell of the contact keeps its content u (volume per area = mean separation) while the
// roughness carries it along at c = V (1 + s)/2, with the sliding speed V and s = roughness_split.
// What enters at the leading edge has the content of steady sliding at the present speed, u_T(V).
// The pressure squeezes fluid out only while the mean content U exceeds u_T. At rest u_T is u*, the
// content at which the last channel closes:
//
//   du/dt + c du/dx = 0,    u(inlet) = u_T(V)
//   dU/dt = -[S(U) P_f(U) - S(u_T) P_f(u_T)]/(4 eta b^2),   P_f(u) = mean p - p_s(u) >= 0,
//   S = phi_p u^3
//
// with the viscosity eta, the pressure of the solids p_s and the pressure flow factor phi_p
// (rough_law.h). The friction is that of the real contact, whose solids carry at most the pressure
// p(x) of Hertz's contact, and that of the fluid in the open part 1 - A:
//
//   F = int tau_s A(min(p, p_s(u))) + eta V (1 - A)^2/u dx
//
// At content 0 the contact is drained: its solids carry the whole load. At content u_T it slides
// steadily with trapped fluid. Source: reference page percolating-film.md, C2.
//
// Valid if the pressure moves little fluid in the time that a cell takes through the contact, that
// is, at speeds with u_T near u*. Against solutions of the full equations, friction is within
// 2.5 %; within 4 % after the speed drops to 1/300; and within 1 to 10 % while fluid refills a
// drained contact. Half-plane and parabola; flooded inlets on both sides; isoviscous; no loss of
// fluid to the rubber.
#pragma once

#include "engine/film/film.h"

// A problem. Initialise `film` with sb_film_problem_init(), then set what a steady film needs, the
// surface SB_ROUGH_PERSSON and percolation_threshold > 0. film.speed is the speed at the start. If
// it is 0, the contact starts drained and at rest, else in steady sliding. A speed > 0 moves the
// wall to +x, as in film.h.
typedef struct {
  SbFilmProblem film;
  double speed_scale; // largest |speed| that will occur [m/s]; 0: the contact stays at rest
} SbContentProblem;

// Values of a contact.
typedef struct {
  double mean, least; // content of the contact's cells, mean and least [m]
  // On the wall, positive if it resists motion to +x [N/m]. At speed 0 what resists a motion to +x.
  double friction;
  double real_area; // integral over x of the fraction of real contact area [m]
  // Relative error estimates of mean content and friction. They cover the cells and steps (compared
  // with cells twice as wide) and the table of steady films, not the error of the model. NaN of
  // sb_content_uniform(), which computes none.
  double error_mean, error_friction;
} SbContentResult;

// A contact with its memory.
typedef struct SbContent SbContent;

// Creates a contact; solves up to 20 steady films (some seconds) unless it stays at rest. Nothing
// is borrowed but film.cancelled_data, which must stay valid until sb_content_destroy(). *out is
// NULL after an error. SB_ERROR_INPUT: another surface, no threshold, a fitted body, or a starved
// inlet. SB_ERROR_RANGE: |film.speed| > speed_scale. Also the errors of sb_film_solve().
SbStatus sb_content_create(SbContent **out, const SbContentProblem *problem, SbReport *report);

// Frees the contact.
void sb_content_destroy(SbContent *content);

// Advances by `dt` [s] > 0 while the speed changes linearly from its present value to `speed`
// [m/s], |speed| <= speed_scale. SB_ERROR_RANGE: `dt` or `speed` is out of range; nothing is done.
// SB_ERROR_CANCELLED: nothing is done, or, if the speed changes its sign, the part up to rest.
SbStatus sb_content_step(SbContent *content, double dt, double speed, SbReport *report);

// Returns the values of the contact at the present time.
SbContentResult sb_content_result(const SbContent *content);

// Returns the values that the contact would have at its present speed with the content `u` [m] >= 0
// in every cell; changes nothing.
SbContentResult sb_content_uniform(const SbContent *content, double u);

// Returns the content u* [m] at which the last channel closes.
double sb_content_closed(const SbContent *content);
