// States near a stored ring's state as linear sums. The results E of the solvers of fit, surface
// and film are smooth functions of the few numbers z that these solvers get, however many
// parameters the numbers follow from:
//
//   E(z) = E(z0) + sum_i (z_i - z0_i) dE/dz_i
//
// z0 is the first requested state; dE/dz_i is a difference computed when z_i first differs, and
// stored. It is a central difference, except a forward one for the effect of a ring's numbers on
// its surface and its films, which are half of a state's work and hardly nonlinear over such steps.
// A parameter that affects no solver costs nothing, and parameters that affect the same numbers
// share these solves. Everything else (rough contact, friction, its agreement with the law that
// drags the ring, the motion) is computed for each question as usual. The tolerance is not one of
// these numbers: meshes and levels are those of the base. If the slopes on both sides disagree (a
// kink, another order of a curve), or an option is switched on, the state is solved. Films of a
// state near z0 are solved on its meshes (film.h, SB_FILM_BESIDE).
#include "engine/valve/states/sliding_private.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

// Inputs of the solvers: of the fit, then of the films only.
enum {
  SECTION,
  INNER,
  MODULUS,
  POISSON,
  MOONEY,
  SPACE,
  BORE,
  WIDTH,
  DRAFT,
  CORNER,
  CHAMFER,
  LAND,
  FLOOR,
  WALL,
  DIFFERENCE, // of the pressures
  COEFFICIENT,
  SHEAR,
  SPEED,
  FILMS = SPEED,
  LEVEL, // of the pressures: the right one
  RADIUS,
  REDUCED,
  VISCOSITY,
  LAYER,
  BARUS,
  EYRING,
  RUPTURE,
  PRODUCT, // of coupled asperities
  ROUGH = PRODUCT,
  SIGMA,
  BLUNTNESS,
  HAMAKER,
  ADHESION,
  STRENGTH,
  LOAD,
  INPUTS
};

// A part of a number by which it is moved, the smaller where slopes to both sides disagree; and
// beyond which a sum is none. Ends of contacts go through the mesh: sizes show its bends soon.
static const double STEP = 1e-5, FINER = 2e-6, FAR = 2e-3, SIZES = 0.05;

// Slopes to both sides that differ by more than this share are no slope; but for what rounding
// leaves in a value, relative.
static const double BENT = 2e-2, ROUNDING = 1e-10, FILM_ROUNDING = 1e-9;

static double *input(int i, SbModel *model, SbSlidingTask *task, SbSlidingLaw *law) {
  SbSealModel *seal = &model->seal[task->seal];
  double *const place[INPUTS] = {[SECTION] = &seal->section_diameter,
                                 [INNER] = &seal->inner_diameter,
                                 [MODULUS] = &seal->modulus,
                                 [POISSON] = &seal->poisson_ratio,
                                 [MOONEY] = &seal->mooney_share,
                                 [SPACE] = &model->radial_space,
                                 [BORE] = &model->bore_diameter,
                                 [WIDTH] = &model->axial_width,
                                 [DRAFT] = &model->groove_draft,
                                 [CORNER] = &model->groove_corner,
                                 [CHAMFER] = &model->groove_chamfer,
                                 [LAND] = &model->stem_diameter,
                                 [FLOOR] = &model->floor_friction,
                                 [WALL] = &model->wall_friction,
                                 [DIFFERENCE] = &task->pressure.left,
                                 [COEFFICIENT] = &law->coefficient,
                                 [SHEAR] = &law->shear,
                                 [SPEED] = &task->speed,
                                 [LEVEL] = &task->pressure.right,
                                 [RADIUS] = &seal->radius,
                                 [REDUCED] = &seal->reduced_modulus,
                                 [VISCOSITY] = &model->viscosity,
                                 [LAYER] = &task->supply.layer,
                                 [BARUS] = &model->pressure_viscosity,
                                 [EYRING] = &model->eyring_stress,
                                 [RUPTURE] = &model->rupture_pressure,
                                 [PRODUCT] = &model->gt_product,
                                 [SIGMA] = &model->sigma,
                                 [BLUNTNESS] = &model->sigma_over_beta,
                                 [HAMAKER] = &model->hamaker,
                                 [ADHESION] = &model->work_of_adhesion,
                                 [STRENGTH] = &model->shear_strength,
                                 [LOAD] = &model->load_coefficient};
  return place[i];
}

// Returns whether a number enters: the stem's land where the chamfers of its grooves end there.
static bool counts(int i, const SbModel *model) {
  return i != LAND || model->groove_chamfer > 0;
}

// Numbers whose effect is smooth at 0 too, for positive values; other numbers are options that are
// off at 0.
static double step_of(int i, double at, double part) {
  static const double unit[INPUTS] = {
      [MOONEY] = 1, [FLOOR] = 1, [WALL] = 1, [COEFFICIENT] = 1, [BARUS] = 1e-6};
  const bool size = i == SECTION || i == INNER || i == SPACE || i == BORE || i == WIDTH;
  // The effect of a nearly incompressible rubber depends on 1/2 minus Poisson's ratio.
  return part * (i == POISSON ? 5 * (0.5 - at) : at != 0 ? fabs(at) * (size ? SIZES : 1) : unit[i]);
}

// Choices of a task that affect a solver.
enum { CHOICES = 8 };
static void choose(int out[CHOICES], const SbSlidingTask *task) {
  const SbModel *model = task->model;
  const int choice[CHOICES] = {(int)model->fit,
                               (int)model->film,
                               (int)model->asperities,
                               (int)model->surface,
                               model->start_at_wall,
                               task->supply.limited,
                               task->seal,
                               (task->speed > 0) - (task->speed < 0)};
  memcpy(out, choice, sizeof choice);
}

// The slope of a state to one of its numbers, and a state that sums start from.
typedef struct {
  bool bent;       // there is none
  double fault[2]; // of the ring's active set over the number, upwards and downwards
  SbSlidingSolution slope;
} Column;

typedef struct Anchor {
  struct Anchor *next;
  int choice[CHOICES];
  double z[INPUTS];
  SbSlidingSolution is;
  SbFilmSolver *solver[SB_SLIDING_FILMS]; // with its films
  Column *column[INPUTS];                 // NULL: not yet used
} Anchor;

struct SbSlidingSlopes {
  pthread_mutex_t lock; // of the lists, and one of the solvers; all else is constant
  pthread_mutex_t films;
  Anchor *first;
};

SbSlidingSlopes *sb_sliding_slopes_create(void) {
  SbSlidingSlopes *slopes = calloc(1, sizeof *slopes);
  const bool made = slopes != NULL && pthread_mutex_init(&slopes->lock, NULL) == 0;
  if (made && pthread_mutex_init(&slopes->films, NULL) == 0) {
    return slopes;
  }
  if (made) {
    pthread_mutex_destroy(&slopes->lock);
  }
  free(slopes);
  return NULL;
}

static void free_anchor(Anchor *anchor) {
  for (int i = 0; i < INPUTS; i++) {
    free(anchor->column[i]);
  }
  for (int i = 0; i < SB_SLIDING_FILMS; i++) {
    sb_film_solver_destroy(anchor->solver[i]);
  }
  free(anchor);
}

void sb_sliding_slopes_destroy(SbSlidingSlopes *slopes) {
  if (slopes == NULL) {
    return;
  }
  for (Anchor *next, *at = slopes->first; at != NULL; at = next) {
    next = at->next;
    free_anchor(at);
  }
  pthread_mutex_destroy(&slopes->lock);
  pthread_mutex_destroy(&slopes->films);
  free(slopes);
}

// ---- Solving

// Lets the films of a memory use an anchor's solvers: to leave their solutions there, or (`next`)
// to be solved next to these.
static void lend(SbSlidingMemory *memory, SbSlidingSlopes *slopes, Anchor *anchor, bool next) {
  pthread_mutex_lock(&slopes->films);
  memory->lender = slopes;
  for (int i = 0; i < SB_SLIDING_FILMS; i++) {
    sb_sliding_slot(memory, i)->own = &anchor->solver[i];
    sb_sliding_slot(memory, i)->on_base = next;
  }
}

void sb_sliding_sum_end(SbSlidingMemory *memory) {
  memory->sums = SB_SUM_NOTHING;
  for (int i = 0; i < SB_SLIDING_FILMS; i++) {
    sb_sliding_slot(memory, i)->own = NULL;
    sb_sliding_slot(memory, i)->on_base = false;
  }
  if (memory->lender != NULL) {
    pthread_mutex_unlock(&memory->lender->films);
    memory->lender = NULL;
  }
}

// Part of a state that is solved.
typedef enum { WHOLE, BY_FITMENT, FITMENT_ALONE } Part;

// Solves the state of a task whose numbers are z near an anchor: with the anchor's fit if only
// films differ, or its fit alone, without a surface; or the anchor's own state, if `made`. Changes
// the task's memory.
static SbStatus solve_at(SbSlidingSolution *out, const SbSlidingTask *task, const SbSlidingLaw *law,
                         const double *z, SbSlidingSlopes *slopes, Anchor *anchor, Part part) {
  SbSlidingMemory *memory = task->memory;
  const bool made = out == &anchor->is;
  SbModel *model = malloc(sizeof *model);
  if (model == NULL) {
    return SB_ERROR_MEMORY;
  }
  *model = *task->model;
  SbSlidingTask other = *task;
  SbSlidingLaw by = law != NULL ? *law : (SbSlidingLaw){0};
  other.model = model;
  other.warnings = NULL;
  for (int i = 0; i < INPUTS; i++) {
    if (counts(i, task->model)) {
      *input(i, model, &other, &by) = z[i];
    }
  }
  other.pressure.left += other.pressure.right;
  for (int i = 0; i < SB_SLIDING_FILMS; i++) {
    sb_sliding_slot(memory, i)->fresh = false;
  }
  if (part == BY_FITMENT) {
    memory->sum = anchor->is;
  }
  memory->sums = part == BY_FITMENT ? SB_SUM_FITMENT : SB_SUM_NOTHING;
  sb_sliding_forget_fitment(&other);
  const SbSlidingLaw *drags = law != NULL ? &by : NULL;
  SbSealState state;
  SbStatus status;
  if (part == FITMENT_ALONE) {
    bool known;
    memory->bare = true;
    status = sb_sliding_fit_contact(&other, drags, &state, &known, NULL);
    memory->bare = false;
    out->fit = memory->now->fit;
    sb_sliding_forget_fitment(&other); // it has no surface
  } else {
    lend(memory, slopes, anchor, !made);
    status = sb_sliding_solve_once(&other, drags, &state, NULL);
    sb_solution_take(out, memory);
  }
  sb_sliding_sum_end(memory);
  free(model);
  return status;
}

// Returns whether a number bends: its values at the ends and in the middle of equal steps.
static bool bends(const double *a, const double *middle, const double *b, double rounding) {
  const double most = fmax(fabs(*a - *middle), fabs(*b - *middle));
  return !(fabs(*a - 2 * *middle + *b) <= BENT * most + rounding * fabs(*middle));
}

static bool any_bends(const SbSlidingSolution *a, const SbSlidingSolution *middle,
                      const SbSlidingSolution *b, bool fitment) {
#define BENDS(member, rounding) bends(&a->member, &middle->member, &b->member, rounding)
  bool any = BENDS(fit.load, ROUNDING) || BENDS(fit.contact_width, ROUNDING) ||
             BENDS(fit.pressure_peak, ROUNDING);
  for (int i = 0; i < SB_SLIDING_FILMS && !any && !fitment; i++) {
    any = middle->on[i].solved &&
          (BENDS(on[i].film.film_central, FILM_ROUNDING) ||
           BENDS(on[i].film.film_min, FILM_ROUNDING) || BENDS(on[i].film.real_area, FILM_ROUNDING));
  }
#undef BENDS
  return any;
}

// Finds a slope by steps of a part of the number. False: there is none, or *status.
static bool find_slope(Column *out, SbSlidingSolution end[2], const SbSlidingTask *task,
                       const SbSlidingLaw *law, SbSlidingSlopes *slopes, Anchor *anchor, int i,
                       double part, SbStatus *status) {
  const double at = anchor->z[i], h = step_of(i, at, part);
  const double place[2] = {h, at != 0 ? -h : h / 2}; // upwards only from 0
  const bool bare = i < FILMS && at != 0;            // the second is
  double z[INPUTS];
  memcpy(z, anchor->z, sizeof z);
  for (int k = 0; k < 2; k++) {
    z[i] = at + place[k];
    const bool alone = bare && k == 1;
    const Part what = i >= FILMS ? BY_FITMENT : alone ? FITMENT_ALONE : WHOLE;
    *status = solve_at(&end[k], task, law, z, slopes, anchor, what);
    if (*status != SB_OK || !sb_solution_alike(&end[k], &anchor->is, alone)) {
      return false;
    }
  }
  const SbSlidingSolution *is = &anchor->is;
  if (at != 0 ? any_bends(&end[0], is, &end[1], bare) : any_bends(&end[0], &end[1], is, false)) {
    return false;
  }
  memset(&out->slope, 0, sizeof out->slope);
  if (at == 0) { // (4 f(h/2) - f(h) - 3 f(0))/h
    sb_solution_add(&out->slope, 4 / h, &end[1], SB_SOLUTION_WHOLE);
    sb_solution_add(&out->slope, -1 / h, &end[0], SB_SOLUTION_WHOLE);
    sb_solution_add(&out->slope, -3 / h, is, SB_SOLUTION_WHOLE);
  } else {
    const SbSolutionPart central = bare ? SB_SOLUTION_FITMENT : SB_SOLUTION_WHOLE;
    sb_solution_add(&out->slope, 1 / (2 * h), &end[0], central);
    sb_solution_add(&out->slope, -1 / (2 * h), &end[1], central);
    if (bare) {
      sb_solution_add(&out->slope, 1 / h, &end[0], SB_SOLUTION_FILMS);
      sb_solution_add(&out->slope, -1 / h, is, SB_SOLUTION_FILMS);
    }
  }
  for (int k = 0; k < 2; k++) {
    const double fault = fmax(end[k].fit.ring.fault - is->fit.ring.fault, 0);
    out->fault[k] = (fault + ROUNDING) / fabs(place[k]);
  }
  return true;
}

// The column of a number, found if it is not known; NULL: *status.
static const Column *column_of(SbSlidingSlopes *slopes, Anchor *anchor, int i,
                               const SbSlidingTask *task, const SbSlidingLaw *law,
                               SbStatus *status) {
  pthread_mutex_lock(&slopes->lock);
  Column *known = anchor->column[i];
  pthread_mutex_unlock(&slopes->lock);
  *status = SB_OK;
  if (known != NULL) {
    return known;
  }
  Column *column = calloc(1, sizeof *column);
  SbSlidingSolution *end = calloc(2, sizeof *end);
  if (column == NULL || end == NULL) {
    free(column);
    free(end);
    *status = SB_ERROR_MEMORY;
    return NULL;
  }
  column->bent = !find_slope(column, end, task, law, slopes, anchor, i, STEP, status);
  if (column->bent && (*status == SB_OK || *status == SB_ERROR_NOT_CONVERGED)) {
    column->bent = !find_slope(column, end, task, law, slopes, anchor, i, FINER, status);
  }
  free(end);
  if (*status == SB_ERROR_CANCELLED || *status == SB_ERROR_MEMORY) {
    free(column);
    return NULL;
  }
  *status = SB_OK;
  pthread_mutex_lock(&slopes->lock);
  if (anchor->column[i] != NULL) { // another thread has stored it in the meantime
    free(column);
  } else {
    anchor->column[i] = column;
  }
  column = anchor->column[i];
  pthread_mutex_unlock(&slopes->lock);
  return column;
}

// ---- A state

// Returns whether a number is near enough to an anchor's; an option that is off has no nearness of
// its own.
static bool is_near(const Anchor *anchor, int i, double z) {
  const double at = anchor->z[i];
  return z == at || fabs(z - at) <= step_of(i, at, FAR) || (i >= FILMS && !(step_of(i, at, 1) > 0));
}

// The anchor of a task, made of the task itself where there is none near; NULL: *status, or there
// are too many.
static Anchor *anchor_of(SbSlidingSlopes *slopes, const SbSlidingTask *task,
                         const SbSlidingLaw *law, const double *z, int inputs, SbStatus *status) {
  enum { ANCHORS = 8 };
  int count = 0, choice[CHOICES];
  choose(choice, task);
  pthread_mutex_lock(&slopes->lock);
  Anchor *found = NULL;
  for (Anchor *at = slopes->first; at != NULL && found == NULL; at = at->next) {
    bool near = memcmp(at->choice, choice, sizeof choice) == 0;
    for (int i = 0; i < inputs && near; i++) {
      near = is_near(at, i, z[i]);
    }
    found = near ? at : NULL;
    count++;
  }
  pthread_mutex_unlock(&slopes->lock);
  *status = SB_OK;
  if (found != NULL || count >= ANCHORS) {
    return found;
  }
  Anchor *made = calloc(1, sizeof *made);
  if (made == NULL) {
    *status = SB_ERROR_MEMORY;
    return NULL;
  }
  memcpy(made->choice, choice, sizeof choice);
  memcpy(made->z, z, sizeof made->z);
  *status = solve_at(&made->is, task, law, z, slopes, made, WHOLE);
  if (*status != SB_OK) {
    free_anchor(made);
    return NULL;
  }
  pthread_mutex_lock(&slopes->lock);
  made->next = slopes->first;
  slopes->first = made;
  pthread_mutex_unlock(&slopes->lock);
  return made;
}

SbStatus sb_sliding_sum(const SbSlidingTask *task, const SbSlidingLaw *law,
                        SbSlidingSlopes *slopes) {
  SbSlidingMemory *memory = task->memory;
  const int inputs = sb_contact_law(task->model)->shares ? INPUTS : ROUGH;
  SbSlidingTask read = *task;
  SbSlidingLaw by = law != NULL ? *law : (SbSlidingLaw){0};
  double z[INPUTS];
  for (int i = 0; i < INPUTS; i++) {
    z[i] = counts(i, task->model) ? *input(i, (SbModel *)task->model, &read, &by) : 0;
  }
  z[DIFFERENCE] -= z[LEVEL];
  SbStatus status;
  Anchor *anchor = anchor_of(slopes, task, law, z, inputs, &status);
  const bool solved = memory->rings == SB_RINGS_SOLVED;
  SbSumDepth depth = anchor != NULL && !solved ? SB_SUM_ALL : SB_SUM_NOTHING;
  SbSlidingSolution *sum = depth == SB_SUM_ALL ? malloc(sizeof *sum) : NULL;
  if (sum != NULL) {
    *sum = anchor->is;
  } else {
    depth = SB_SUM_NOTHING;
  }
  for (int i = 0; i < inputs && depth != SB_SUM_NOTHING; i++) {
    const double by_this = z[i] - anchor->z[i];
    if (by_this == 0 || (memory->rings == SB_RINGS_STAY && i < FILMS)) {
      continue;
    }
    const bool off = !(step_of(i, anchor->z[i], 1) > 0);
    const Column *column = off ? NULL : column_of(slopes, anchor, i, task, law, &status);
    if (column == NULL || column->bent) {
      depth = i < FILMS || status != SB_OK ? SB_SUM_NOTHING : SB_SUM_FITMENT;
      continue;
    }
    sb_solution_add(sum, by_this, &column->slope, SB_SOLUTION_WHOLE);
    sum->fit.ring.fault += fabs(by_this) * column->fault[by_this < 0];
  }
  if (sum != NULL) {
    memory->sum = *sum;
  }
  free(sum);
  if (depth == SB_SUM_FITMENT || (solved && anchor != NULL)) {
    lend(memory, slopes, anchor, true);
  }
  memory->sums = depth;
  if (depth != SB_SUM_NOTHING) {
    sb_sliding_forget_fitment(task);
  }
  const bool fatal = status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY;
  return fatal ? status : SB_OK;
}
