// Errors of slopes through solved rings, and their comparison with full solves; see gradient.h.
//
// A slope S to first order fixes the base's contact set and the places where the ring sticks to
// floor and walls. A full solve at another value finds both from its own history. Full solves on
// both sides of the base's value, x + h and x - h, therefore give a second estimate
//   D = (f(x + h) - f(x - h))/2h,   e_D = scatter/2h + |f(x + h) - 2 f(x) + f(x - h)|/2h,
// where the scatter is that of two solves on different meshes; the second difference has that and
// the curvature. With the error E of S without this comparison and the gap |S - D|:
//   gap <= e_D: S is confirmed; its error is E, but not below the gap nor above the gap and e_D
//   gap > e_D:  D takes its place with the error e_D, unless an event or an outcome differs there
// h is such that the contacts change by MOVES. The cost is two full solves for each parameter that
// enters rings.
#include "engine/valve/answer/gradient_private.h"

#include <math.h>
#include <string.h>

typedef SbGradientWork Work;

// Scatter of the slopes of rings between meshes, as a fraction of the relative changes of load,
// width and peak of the contacts: of a load; of a film, which depends on the pressure at the
// contact's end; and of all other figures (solved rings at 1 to 4 % on either side: at most 0.06,
// 0.06, 0.12). A film on a contact with few nodes for each polynomial of its pressure scatters more
// (0.72 with 7 nodes, none with 12).
static const double SCATTER_LOAD = 0.08, SCATTER_FILM = 0.13, SCATTER = 0.13;
static const double SCATTER_ROUGH = 0.8, ORDER_MOST = 0.1, MANY = 16;
// And where contacts hardly move, rings of two meshes some per cent of a parameter apart differ, as
// part of a figure for a change by the parameter itself (measured: 2.7e-3 at most), and films by
// what they are solved to, so many times the tolerance (measured: 56 at most).
static const double FLOOR = 4e-3, FLOOR_FILM = 80;

// Returns whether a figure is that of a film by its row in the table of figures: by the source of
// its error, or a leakage.
static bool is_of_film(const SbFigure *row) {
  const bool shelf = row->needs == SB_DEPTH_SIZES;
  const SbErrorSource by = row->error;
  return (row->verdict == SB_VERDICT_LEAK && !shelf) || by == SB_BY_FILM ||
         by == SB_BY_FILM_LEAST || by == SB_BY_FILM_SOLVED || by == SB_BY_LIFE_FILM;
}

// Share of what a seal's contact changes by that slopes of a figure scatter by.
static double scatter_of(const SbFigure *row, double order) {
  if (row->error == SB_BY_LOAD) {
    return SCATTER_LOAD;
  }
  return !is_of_film(row) ? SCATTER : order > ORDER_MOST ? SCATTER_ROUGH : SCATTER_FILM;
}

// Returns whether a seal's contact, which was to stay, did, for all that it moves otherwise: where
// the base's films have not converged nothing but the whole state is to be had.
static bool stayed(const Work *work, int seal) {
  const size_t size = sizeof work->up.size[seal];
  return memcmp(work->moved.size[seal], work->up.size[seal], size) != 0 ||
         memcmp(work->up.size[seal], work->contacts.size[seal], size) == 0;
}

// Adds to the errors what a ring's slopes scatter between meshes, by what its contacts change.
// *most: sum of the
// relative changes of load, width and peak of the contact that changes most [1/SI].
static SbStatus add_scatter(Work *work, size_t parameter, double x, double scale, double *most) {
  SbGradient *out = work->out;
  double h = 0, moved[SB_SEAL_COUNT] = {0};
  int level = SB_GRADIENT_RINGS;
  for (; level < SB_GRADIENT_LEVELS && h == 0; level += h == 0) {
    h = work->level[level].asked ? work->level[level].h : 0;
  }
  *most = 0;
  memset(work->follows, 0, out->figures * sizeof *work->follows);
  if (h == 0) {
    return SB_OK;
  }
  const double *value = sb_gradient_values(work, level, SB_GRADIENT_PLUS);
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    for (int way = 0; way < SB_GRADIENT_WAYS; way++) {
      double sum = 0;
      for (int k = 0; k < SB_GRADIENT_SIZES; k++) {
        const double by =
            fabs(work->up.size[i][way][k] / work->contacts.size[i][way][k] - 1) / fabs(h);
        sum += isfinite(by) ? by : 0;
      }
      moved[i] = fmax(moved[i], sum);
    }
    *most = fmax(*most, moved[i]);
  }
  double *held = sb_gradient_values(work, SB_GRADIENT_FIRST, SB_GRADIENT_PLUS);
  work->question.rings = SB_RINGS_STAY;
  SbStatus status = sb_gradient_ask(work, held, x + h, false);
  work->question.rings = SB_RINGS_FOLLOW;
  const bool stay[SB_SEAL_COUNT + 1] = {stayed(work, 0), stayed(work, 1),
                                        stayed(work, 0) && stayed(work, 1)};
  for (size_t i = 0; i < out->figures; i++) {
    const size_t cell = i * out->parameters + parameter;
    const SbFigure *row = sb_figure(out->figure[i]);
    const double by = row->seal < SB_SEAL_COUNT ? moved[row->seal] : *most;
    const double share = scatter_of(row, work->order) * by / (1 + by * scale / MANY) +
                         (FLOOR + (is_of_film(row) ? FLOOR_FILM * work->tolerance : 0)) / scale;
    // Figures that do not depend on the rings do not scatter with them.
    work->follows[i] = isfinite(out->slope[cell]) &&
                       (stay[row->seal] ? value[i] != held[i] : out->slope[cell] != 0);
    out->error[cell] += work->follows[i] ? share * work->size[i] : 0;
  }
  return status;
}

// Sum of the relative changes of load, width and peak at which the comparison is made, and the
// parts of the parameter's scale that bound its step.
static const double MOVES = 0.06, PART_LEAST = 0.015, PART_MOST = 0.3;

// Difference of a figure between two full solves that their meshes and tolerances leave, relative:
// twice the deviation of films and of all else (measured on fits over 7 full runs of the consistent
// valve: deviations of 0.4 % and 0.1 % in the middle, 1.1 % and 0.36 % at most).
static const double APART = 6e-3, APART_FILM = 3e-2;

// A full solve on each side of the parameter's value.
typedef struct {
  const double *value[2]; // of the figures, above and below; NULL: there is none
  double h;               // the distance [SI]
  bool same[2];           // events and outcomes are the base's
} Solved;

static SbStatus solve(Work *work, Solved *out, double x, double h, const SbParam *param) {
  *out = (Solved){.h = h};
  for (int side = 0; side < 2; side++) {
    const double at = side == 0 ? x + h : x - h;
    if (!(at >= param->min && at <= param->max)) {
      continue;
    }
    double *value = sb_gradient_values(work, SB_GRADIENT_FIRST, side);
    SbQuestion question = work->question;
    question.start = NULL;
    question.tangent = false;
    work->override[question.override_count - 1].value = at;
    const SbStatus status = sb_evaluator_ask(value, work->other, &question, NULL);
    if (sb_gradient_ends(status)) {
      return status;
    }
    if (status == SB_OK) {
      SbGradientOutcome now;
      char text[SB_GRADIENT_TEXT];
      sb_gradient_outcome(&now, sb_evaluator_summary(work->other));
      out->value[side] = value;
      out->same[side] = !sb_gradient_differ(text, sizeof text, &work->outcome, &now);
    }
  }
  return SB_OK;
}

// Slope of a figure by the full solves, not a number where there is none, and its error. `moved`:
// relative change of the contacts over a step, which bounds the curvature of a one-sided slope.
static double slope_of(double *error, const Work *work, const Solved *solved, size_t figure,
                       double moved) {
  const double apart = is_of_film(sb_figure(work->out->figure[figure])) ? APART_FILM : APART;
  const double scatter = apart * work->size[figure] / solved->h;
  double slope[2] = {NAN, NAN};
  for (int side = 0; side < 2; side++) {
    const double *value = solved->value[side];
    // A side with the base's events counts, or both sides where neither has them.
    if (value != NULL && (solved->same[side] || !solved->same[!side])) {
      const double by = value[figure] - work->out->value[figure];
      slope[side] = side == 0 ? by / solved->h : -by / solved->h;
    }
  }
  if (isfinite(slope[0]) && isfinite(slope[1])) {
    *error = scatter / 2 + fabs(slope[0] - slope[1]) / 2;
    return (slope[0] + slope[1]) / 2;
  }
  const double one = isfinite(slope[0]) ? slope[0] : slope[1];
  *error = scatter + moved / 2 * fabs(one);
  return one;
}

// Compares one slope with the full solves.
static void compare(Work *work, size_t parameter, size_t figure, const Solved *solved,
                    double moved) {
  SbGradient *out = work->out;
  const size_t cell = figure * out->parameters + parameter;
  double error;
  const double own = out->error[cell];
  const double other = slope_of(&error, work, solved, figure, moved);
  const double gap = fabs(out->slope[cell] - other);
  if (gap <= error) {
    out->error[cell] = fmax(gap, fmin(own, gap + error));
  } else if (isfinite(gap) && (solved->same[0] || solved->same[1])) {
    out->slope[cell] = other;
    out->error[cell] = error;
    out->solved[cell] = true;
  } else {
    out->error[cell] = INFINITY; // one estimate contradicts the other, or there is one alone
  }
}

SbStatus sb_gradient_check_rings(Work *work, size_t parameter, double x, double scale) {
  double most;
  Solved solved;
  bool any = false;
  SbStatus status = add_scatter(work, parameter, x, scale, &most);
  for (size_t i = 0; i < work->out->figures; i++) {
    any = any || work->follows[i];
  }
  if (sb_gradient_ends(status) || !any) {
    return status;
  }
  const double part = fmin(PART_MOST, fmax(PART_LEAST, MOVES / (most * scale)));
  status = solve(work, &solved, x, part * scale, sb_param(work->out->parameter[parameter]));
  for (size_t i = 0; i < work->out->figures && status == SB_OK; i++) {
    if (work->follows[i]) {
      compare(work, parameter, i, &solved, most * solved.h);
    }
  }
  return status;
}
