// See speed_states.h. The grid of nodes: position 0 is the lowest speed, GRID positions to two
// decades.
#include "engine/valve/states/speed_states.h"

#include "engine/valve/states/contact_law.h"

#include <math.h>
#include <string.h>

enum { LEAST_FILM, CENTRAL_FILM, LAYER, AREA, LOAD, VISCOUS, SHARE };

// A cell of two decades has GRID positions; after DEPTH halvings its nodes are still on the grid.
// Four cells extend from 10 m/s to below the lowest speed. A cell with a state that has no solution
// is halved to UNSOLVED only: a try without a solution costs as much as a hundred solutions.
enum { DEPTH = 4, GRID = 4 << DEPTH, WIDE = 4, UNSOLVED = GRID / 8 };

static const double decades = 2;

static double speed_of(int place) {
  return SB_SPEED_MOST * pow(10, decades * ((double)place / GRID - WIDE));
}

static const SbContactLaw *law_of(const SbSpeedStates *states) {
  return sb_contact_law(states->task.model);
}

static SbSlidingTask task_at(const SbSpeedStates *states, double speed) {
  SbSlidingTask task = states->task;
  task.speed = copysign(speed, states->task.speed);
  task.warnings = NULL;
  return task;
}

static void take(double value[SB_SPEED_VALUES], const SbSealState *state) {
  SbSealState whole = *state;
  sb_sliding_full_friction(&whole);
  value[LEAST_FILM] = log(state->film_min);
  value[CENTRAL_FILM] = log(state->film_central);
  value[LAYER] = log(state->layer);
  value[AREA] = whole.real_area_share;
  value[LOAD] = whole.boundary_load;
  value[VISCOUS] = log(fmax(whole.friction_viscous, 1e-300));
  value[SHARE] = state->asperity_share;
}

// The state that these values are.
static void give(SbSealState *out, const SbSpeedStates *states, double speed,
                 const double value[SB_SPEED_VALUES]) {
  out->film_min = exp(value[LEAST_FILM]);
  out->film_central = exp(value[CENTRAL_FILM]);
  out->layer = exp(value[LAYER]);
  if (law_of(states)->friction_over_speed) {
    out->real_area_share = fmin(fmax(value[AREA], 0), 1);
    out->boundary_load = fmax(value[LOAD], 0);
    out->friction_viscous = exp(value[VISCOUS]);
    out->asperity_share = value[SHARE];
  }
  const SbSlidingTask task = task_at(states, speed);
  (void)sb_sliding_refilm(out, &task, states->roughness, NULL);
}

void sb_speed_states_init(SbSpeedStates *out, const SbSlidingTask *task, const SbSealState *at,
                          const SbSlidingBody *body) {
  memset(out, 0, sizeof *out);
  out->task = *task;
  out->base = *at;
  out->roughness = 1;
  out->power = out->starved_from = NAN;
  out->on_body = body != NULL;
  if (body != NULL) {
    out->body = *body;
  }
  if (!law_of(out)->friction_over_speed && !sb_film_kind(task->model->film)->coupled &&
      at->film_central > 0) {
    SbSealState faster = *at;
    const SbSlidingTask other = task_at(out, 10 * fabs(task->speed));
    // With no more than a supply there is no power, but a law all the same.
    if (sb_sliding_respeed(&faster, &other, NULL, NULL) == SB_OK) {
      out->power = log10(faster.film_central / at->film_central);
    }
  }
}

// Solves the state at a speed; false: there is none.
static bool solve(double value[SB_SPEED_VALUES], SbSpeedStates *states, double speed) {
  SbSealState state = states->base;
  const SbSlidingTask task = task_at(states, speed);
  SbStatus status = sb_sliding_respeed(&state, &task, states->on_body ? &states->body : NULL, NULL);
  bool fatal = status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY;
  states->status = fatal ? status : SB_OK;
  states->solves++;
  take(value, &state);
  const SbFilmSolverInfo *info = &sb_sliding_film(task.memory)->solver;
  const double error = fmax(info->error_film_min, info->error_film_central);
  // That of a film which is used for another speed, or which is above the tolerance.
  if (status == SB_OK && (task.supply.limited || error > task.model->tolerance)) {
    states->error = fmax(states->error, error);
  }
  return status == SB_OK;
}

// Returns whether the supply alone shapes the film at a speed, which then is that of `starved`.
static bool is_starved(SbSpeedStates *states, double speed) {
  if (!states->task.supply.limited || states->status != SB_OK) {
    return false;
  }
  if (isnan(states->starved_from)) {
    const SbSlidingBody *body = states->on_body ? &states->body : NULL;
    static const double BESIDE[] = {1, 1.25, 0.8, 1.6}; // where the solver finds none there
    const double first = sb_sliding_starved_speed(&states->base, &states->task, body);
    const SbSlidingMemory *memory = states->task.memory;
    double from = first;
    bool starved = false;
    for (size_t i = 0; i < sizeof BESIDE / sizeof *BESIDE && !starved && first < SB_SPEED_MOST &&
                       states->status == SB_OK;
         i++) {
      from = BESIDE[i] * first;
      starved = solve(states->starved, states, from) && sb_sliding_film(memory)->starved;
    }
    // Where the solver took a lower speed the film is that from there on.
    const double share = starved ? sb_sliding_film_share(memory) : 1;
    states->starved[VISCOUS] += log(share);
    states->starved_from = starved ? share * from : INFINITY;
    if (starved) {
      // As for a film that is used for another speed (sliding_film.c).
      const SbFilm *film = sb_sliding_film(memory);
      const double end = 2 * states->task.supply.layer;
      const double least = 0.5 * fabs(film->film_min / end - 1);
      states->error = fmax(states->error, fmax(least, fabs(film->film_central / end - 1)));
    }
  }
  return speed >= states->starved_from;
}

// The node at a place, solved if it is not; NULL if there is no room.
static const SbSpeedNode *node_at(SbSpeedStates *states, int place) {
  for (size_t i = 0; i < states->nodes; i++) {
    if (states->node[i].place == place) {
      return &states->node[i];
    }
  }
  if (states->nodes == SB_SPEED_NODES || states->status != SB_OK) {
    return NULL;
  }
  SbSpeedNode *node = &states->node[states->nodes++];
  node->place = place;
  const double speed = speed_of(place);
  if (is_starved(states, speed)) {
    node->solved = true;
    memcpy(node->value, states->starved, sizeof node->value);
    node->value[VISCOUS] += log(speed / states->starved_from);
  } else {
    node->solved = solve(node->value, states, speed);
  }
  return node;
}

// Value at t of the cell, by the cubic through its nodes at 0, 1/4, 1/2 and 1.
static void interpolate(double out[SB_SPEED_VALUES], const SbSpeedCell *cell, double t) {
  const double weight[] = {-8 * (t - 0.25) * (t - 0.5) * (t - 1),
                           64.0 / 3 * t * (t - 0.5) * (t - 1), -16 * t * (t - 0.25) * (t - 1),
                           8.0 / 3 * t * (t - 0.25) * (t - 0.5)};
  for (int k = 0; k < SB_SPEED_VALUES; k++) {
    out[k] = 0;
    for (int i = 0; i < 4; i++) {
      out[k] += weight[i] * cell->value[i][k];
    }
  }
}

// Relative differences of guessed values from the solved ones at a speed.
typedef struct {
  double film, friction;
  double most; // the largest of them and of the real area's part of the friction
} Miss;

static Miss miss_at(const SbSpeedStates *states, double speed, const double *value,
                    const double *guess) {
  SbSealState solved = states->base, guessed = states->base;
  give(&solved, states, speed, value);
  give(&guessed, states, speed, guess);
  const double friction = sb_sliding_friction(&solved);
  Miss miss = {.film = fmax(fabs(guessed.film_min / solved.film_min - 1),
                            fabs(guessed.film_central / solved.film_central - 1)),
               .friction = fabs(sb_sliding_friction(&guessed) / friction - 1)};
  const double area = fabs(guessed.real_area_share - solved.real_area_share) *
                      states->task.model->shear_strength / friction *
                      (solved.contact_right - solved.contact_left) *
                      states->task.model->bore_circumference;
  miss.most = fmax(fmax(miss.film, area), miss.friction);
  return miss;
}

// Returns the same differences for a cell's straight line through its ends, or its parabola through
// ends and middle, at its quarter.
static Miss miss_of(const SbSpeedStates *states, const SbSpeedCell *cell, bool parabola) {
  static const double WEIGHT[2][3] = {{0.75, 0, 0.25}, {0.375, 0.75, -0.125}};
  const double *weight = WEIGHT[parabola];
  double guess[SB_SPEED_VALUES];
  for (int k = 0; k < SB_SPEED_VALUES; k++) {
    guess[k] = weight[0] * cell->value[0][k] + weight[1] * cell->value[2][k] +
               weight[2] * cell->value[3][k];
  }
  return miss_at(states, speed_of(cell->place + cell->width / 4), cell->value[1], guess);
}

// Distance of the two states from the reference speed, in ln(speed).
static const double BESIDE = 0.1;

// Solves the two neighbours of the reference state, whose values are `here`.
static void solve_beside(SbSpeedStates *states, const double here[SB_SPEED_VALUES]) {
  const double reference = fabs(states->task.speed);
  states->beside_known = true;
  states->beside_usable = solve(states->beside[0], states, reference * exp(-BESIDE)) &&
                          solve(states->beside[1], states, reference * exp(BESIDE));
  if (!states->beside_usable) {
    return;
  }
  double guess[SB_SPEED_VALUES];
  for (int k = 0; k < SB_SPEED_VALUES; k++) {
    guess[k] = 0.5 * (states->beside[0][k] + states->beside[1][k]);
  }
  const Miss miss = miss_at(states, reference, here, guess);
  states->beside_usable = miss.most <= SB_SPEED_TOLERANCE;
  states->beside_error = miss.film;
  states->beside_friction_error = miss.friction;
}

// Computes the values at a speed near the reference; false if there is no parabola. Its error has
// the factor t (1 - t^2): the deviation from a straight line times t is at least as large where the
// third difference is at most three times the second one (test_run_speeds.c, beside).
static bool is_beside(double out[SB_SPEED_VALUES], SbSpeedStates *states, double speed) {
  const double t = log(speed / fabs(states->task.speed)) / BESIDE;
  if (!states->near || fabs(t) > 1) {
    return false;
  }
  double here[SB_SPEED_VALUES];
  take(here, &states->base);
  if (!states->beside_known) {
    solve_beside(states, here);
  }
  if (!states->beside_usable) {
    return false;
  }
  states->error = fmax(states->error, fabs(t) * states->beside_error);
  states->friction_error = fmax(states->friction_error, fabs(t) * states->beside_friction_error);
  for (int k = 0; k < SB_SPEED_VALUES; k++) {
    const double below = states->beside[0][k], above = states->beside[1][k];
    out[k] = here[k] + 0.5 * t * (above - below + t * (above - 2 * here[k] + below));
  }
  return true;
}

// Returns the estimated error of the cubic in friction: that of the parabola times twice its ratio
// to the error of the straight line, if that product is smaller.
static double left(double straight, double parabola) {
  return parabola * (straight > 0 ? fmin(1, 2 * parabola / straight) : 1);
}

// Returns the cell that contains a position, created if there is none; NULL if there is no space.
static const SbSpeedCell *cell_at(SbSpeedStates *states, double place) {
  for (size_t i = 0; i < states->cells; i++) {
    const SbSpeedCell *cell = &states->cell[i];
    if (place >= cell->place && place <= cell->place + cell->width) {
      return cell;
    }
  }
  if (states->cells == SB_SPEED_CELLS) {
    return NULL;
  }
  SbSpeedCell cell = {.width = states->near ? GRID / 4 : GRID};
  const int last = WIDE * GRID / cell.width - 1;
  cell.place = cell.width * (int)fmin(fmax(floor(place / cell.width), 0), last);
  Miss miss;
  for (;;) {
    const int at[] = {cell.place, cell.place + cell.width / 4, cell.place + cell.width / 2,
                      cell.place + cell.width};
    cell.usable = true;
    for (int i = 0; i < 4 && cell.usable; i++) {
      const SbSpeedNode *node = node_at(states, at[i]);
      cell.usable = node != NULL && node->solved;
      if (cell.usable) {
        memcpy(cell.value[i], node->value, sizeof node->value);
      }
    }
    miss = cell.usable ? miss_of(states, &cell, true) : (Miss){.most = NAN};
    if (miss.most <= SB_SPEED_TOLERANCE || cell.width <= (cell.usable ? 4 : UNSOLVED) ||
        states->status != SB_OK) {
      break;
    }
    cell.width /= 2;
    cell.place += place >= cell.place + cell.width ? cell.width : 0;
  }
  if (cell.usable) {
    const Miss straight = miss_of(states, &cell, false);
    states->error = fmax(states->error, miss.film);
    states->friction_error = fmax(states->friction_error, left(straight.friction, miss.friction));
  } else if (states->status == SB_OK) {
    sb_warn(states->task.warnings, "film-speed", sb_input(SB_P_MODELS_FILM),
            "no film of the %s seal about %.3g mm/s: it follows the power 0.6 of the speed from "
            "that at %.3g mm/s",
            sb_seal_name(states->task.seal), 1e3 * speed_of(cell.place + cell.width / 2),
            1e3 * fabs(states->task.speed));
  }
  states->cell[states->cells] = cell;
  return &states->cell[states->cells++];
}

void sb_speed_state(SbSealState *out, SbSpeedStates *states, double speed) {
  const double reference = fabs(states->task.speed);
  *out = states->base;
  speed = fmax(fabs(speed), SB_SPEED_LEAST);
  if (speed == reference || !out->touches || !(out->film_central > 0)) {
    return;
  }
  double value[SB_SPEED_VALUES];
  const bool law = !isnan(states->power);
  if (law && states->task.supply.limited) {
    const SbSlidingTask task = task_at(states, speed);
    (void)sb_sliding_respeed(out, &task, NULL, NULL);
    (void)sb_sliding_refilm(out, &task, states->roughness, NULL);
    return;
  }
  if (!law && is_beside(value, states, speed)) {
    give(out, states, speed, value);
    return;
  }
  if (!law && is_starved(states, speed)) {
    memcpy(value, states->starved, sizeof value);
    value[VISCOUS] += log(speed / states->starved_from);
    give(out, states, speed, value);
    return;
  }
  const SbSpeedCell *cell = NULL;
  double place = 0;
  if (!law) {
    speed = fmin(speed, SB_SPEED_MOST);
    place = GRID * (WIDE + log10(speed / SB_SPEED_MOST) / decades);
    cell = cell_at(states, place);
  }
  if (cell != NULL && cell->usable) {
    interpolate(value, cell, (place - cell->place) / cell->width);
  } else {
    take(value, out);
    const double faster = (law ? states->power : 0.6) * log(speed / reference);
    value[LEAST_FILM] += faster;
    value[CENTRAL_FILM] += faster;
    value[LAYER] += faster;
  }
  give(out, states, speed, value);
}
