// Friction of a rough contact with a memory of its sliding: the content of fluid in its cells.
//
// Where hardly any channel is open, fluid cannot flow through a contact. It is carried: a cell of
// the contact keeps its content u (volume per area = mean separation) while the roughness carries
// it along at c = V (1 + s)/2, s = roughness_split. What enters at the leading edge has the content
// of steady sliding at the present speed V, u_T(V). Only while the mean content U exceeds u_T (at
// rest: the content u* at which the last channel closes) does the pressure squeeze fluid out:
//
//   du/dt + c du/dx = 0,    u(inlet) = u_T(V)
//   dU/dt = -[S(U) P_f(U) - S(u_T) P_f(u_T)]/(4 eta b^2),   P_f(u) = mean p - p_s(u) >= 0,
//   S = phi_p u^3
//
// with p_s the pressure of the solids and phi_p the pressure flow factor (rough_law.h). The
// friction is that of the real contact, whose solids carry at most the pressure p(x) of Hertz's
// contact, and that of the fluid in the open part 1 - A:
//
//   F = int tau_s A(min(p, p_s(u))) + eta V (1 - A)^2/u dx
//
// A content of 0 is the drained contact, whose solids carry all (boundary friction); u_T that of
// steady sliding with trapped fluid. Source: ../shared/reference/percolating-film.md, C2.
//
// Valid where the pressure hardly moves fluid within a passage, so for speeds whose u_T is near u*;
// against solutions of the full equations its friction is within 2.5 %, 4 % after a step from 300
// times the speed, and 1 to 10 % while a front passes that follows a drained contact. Half-plane
// and parabola; flooded inlets on both sides; isoviscous; no loss of fluid to the rubber.
#pragma once

#include "engine/film/film.h"

// A problem. Initialise `film` with sb_film_problem_init(); it has the surface SB_ROUGH_PERSSON and
// percolation_threshold > 0. film.speed is the speed at the start: not 0: steady sliding; 0: a
// drained contact at rest.
typedef struct {
  SbFilmProblem film;
  double speed_scale; // largest |speed| that will occur [m/s] > 0
} SbContentProblem;

// The contact at the present time.
typedef struct {
  double mean, least; // content of the contact's cells, mean and least [m]
  double friction;    // on the wall, positive if it resists motion to +x [N/m]
  double real_area;   // integral over x of the fraction of real contact area [m]
  // Relative error estimates of mean content and friction: cells and steps (against cells twice as
  // wide), and the table of steady films. Not the error of the model.
  double error_mean, error_friction;
} SbContentResult;

// A contact with its memory.
typedef struct SbContent SbContent;

// Creates a contact; solves up to 20 steady films (some seconds). Nothing is borrowed but
// film.cancelled_data, which must stay valid until sb_content_destroy().
// SB_ERROR_INPUT: another surface, no threshold, a fitted body, or a starved inlet; also the errors
// of sb_film_solve().
SbStatus sb_content_create(SbContent **out, const SbContentProblem *problem, SbReport *report);

// Frees the contact.
void sb_content_destroy(SbContent *content);

// Advances by `dt` [s] > 0 while the speed changes linearly from its present value to `speed`
// [m/s], |speed| <= speed_scale. SB_ERROR_RANGE: `dt` or `speed` is out of range; nothing is done.
// SB_ERROR_CANCELLED: the state is at the last completed step.
SbStatus sb_content_step(SbContent *content, double dt, double speed, SbReport *report);

// Returns the contact at the present time.
SbContentResult sb_content_result(const SbContent *content);

// Returns the contact in which every cell has the content `u` [m] >= 0, at the speed of `content`.
SbContentResult sb_content_uniform(const SbContent *content, double u);

// Returns the content u* [m] at which the last channel closes.
double sb_content_closed(const SbContent *content);
