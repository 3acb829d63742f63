// A ring dragged by its own friction: ring and film in turns.
#include "engine/valve/states/sliding_private.h"

#include <float.h>
#include <math.h>
#include <string.h>

// A law's friction on a fitment's contact [N].
static double law_force(const SbSlidingLaw *law, const SbFit *fit) {
  double sum = 0, before = 0, slope;
  for (size_t i = 0; i < fit->profile_count; i++) {
    double now = sb_sliding_shear(fit->profile_p[i], &slope, law);
    sum += i > 0 ? 0.5 * (before + now) * (fit->profile_x[i] - fit->profile_x[i - 1]) : 0;
    before = now;
  }
  return sum * fit->circumference;
}

// Returns which fraction of a law's constant shear the contact pressure can transmit: the mean of
// min(S, p)/S over the contact.
static double transmitted(const SbSlidingLaw *law, const SbFit *fit) {
  double sum = 0, width = 0;
  for (size_t i = 1; i < fit->profile_count; i++) {
    const double dx = fit->profile_x[i] - fit->profile_x[i - 1];
    sum +=
        0.5 * dx * (fmin(law->shear, fit->profile_p[i - 1]) + fmin(law->shear, fit->profile_p[i]));
    width += dx;
  }
  return law->shear > 0 && width > 0 ? fmax(sum, 0) / (law->shear * width) : 1;
}

// Reduces the friction of a state, which is that of `law`, to what the dragged section carries: all
// of it while it slides; each part in proportion at the maximum drag of a section that rolls or
// jams, which no dwell increases. While it slides, the difference between the friction of its film
// and that of its section is an error of both.
static SbStatus bear(SbSealState *out, const SbSlidingTask *task, const SbSlidingFitment *on,
                     const SbSlidingLaw *law, SbReport *report) {
  out->area_cut = transmitted(law, &on->fit);
  const double asked =
      out->boundary_load + out->area_cut * (out->boundary_area + out->friction_viscous);
  out->borne_share = asked == 0 ? 1 : fabs(on->fit.ring.drag) / asked;
  SbStatus status = sb_sliding_share_out(out, task, report);
  const double off = fabs(1 - out->borne_share);
  if (out->section == SB_RING_SLIDES && off > 0) {
    out->area_error += off;
    out->boundary_error += off * (out->boundary_area + out->boundary_load);
    out->viscous_error += off * out->friction_viscous;
    out->friction_error += off * sb_sliding_friction(out);
  }
  return status;
}

// A round of sb_sliding_drag(): a friction [N], and the fit that it drags.
typedef struct {
  double friction, load, width, peak;
} Round;

static Round round_of(double friction, const SbFit *fit) {
  return (Round){friction, fit->load, fit->contact_width, fit->pressure_peak};
}

// Without a second round: the section leans on the wall by its friction. Solved rings change their
// load by 0.7 to 0.9 N per newton (ring-cycle, d-ring), and width and peak by less than that.
static SbSlidingPull usual_pull(const SbFit *fit) {
  const double per_newton = 1 / fmax(fit->load, 1e-300); // without load there is no friction either
  return (SbSlidingPull){per_newton, per_newton, per_newton};
}

// Sets *out from two rounds: the slope of their secant. Without fluid (`even`) the opposite
// friction gives the mirror image, so that the fit is an even function of it: the slope of a
// parabola. Rounds that differ by less than what they are apart from their films determine no
// slope.
static void set_pull(SbSlidingPull *out, const Round *one, const Round *now, double apart,
                     bool even) {
  const double by = now->friction - one->friction;
  if (!(fabs(by) > apart)) {
    return;
  }
  const double sum = now->friction + one->friction;
  const double per = (even ? 2 * now->friction / sum : 1) / fabs(by);
  *out = (SbSlidingPull){per * fabs(1 - one->load / now->load),
                         per * fabs(1 - one->width / now->width),
                         per * fabs(1 - one->peak / now->peak)};
}

// Adds to the errors of a sliding ring's state what its fit would change with the difference
// `apart` [N] between the friction that drags it and that of its film.
static SbStatus add_difference(SbSealState *out, const SbSlidingTask *task,
                               const SbSlidingPull *pull, double apart, SbReport *report) {
  out->load_error += pull->load * apart;
  out->width_error += pull->width * apart;
  out->peak_error += pull->peak * apart;
  return sb_sliding_update_errors(out, task, report);
}

// Without fluid a ring that slides in one direction is the mirror image of the ring that slides in
// the other one. Returns false if that ring is not known.
static bool mirror(const SbSlidingTask *task, SbSlidingFitment *on) {
  const SbSlidingFitment *other = &task->memory->fitment[task->speed > 0 ? SB_WAY_OUT : SB_WAY_IN];
  if (task->pressure.left != task->pressure.right || !other->known || other->pressure != 0 ||
      other->seal != task->seal) {
    return false;
  }
  SbFitProblem problem;
  sb_sliding_fit_problem(&problem, task, on, &other->law);
  on->known = sb_fit_mirror(&on->fit, &problem, &other->fit, other->ring, NULL) == SB_OK;
  on->pressure = 0;
  on->modulus = other->modulus;
  on->jump = other->jump;
  on->guess = other->guess;
  on->pull = other->pull;
  on->seal = task->seal;
  SbSlidingMemory *memory = task->memory;
  if (on->known && memory->rested && memory->rest_on == other) {
    memory->rest_on = on; // its dry contact is the mirror image, too
  }
  return on->known;
}

// Returns the next law for the drag: the law found, but between the largest shear that was too
// small and the smallest that was too large.
static void near_law(SbSlidingLaw *found, const SbSlidingLaw *before, double bracket[2]) {
  bracket[found->shear > before->shear ? 0 : 1] = before->shear;
  if (found->shear > before->shear ? found->shear >= bracket[1] : found->shear <= bracket[0]) {
    const double middle = 0.5 * (bracket[0] + bracket[1]);
    const double part = (middle - before->shear) / (found->shear - before->shear);
    found->shear = middle;
    found->coefficient = before->coefficient + part * (found->coefficient - before->coefficient);
  }
}

// Does the same near a stored pair of ring and friction. That pair agrees to the tolerance only;
// its difference remains constant, so that the pair is a smooth function of all inputs.
static SbStatus drag_beside(const SbSlidingTask *task, SbSlidingFitment *on,
                            const SbSlidingStart *start, bool known, SbSealState *out,
                            SbReport *report) {
  // If solved again, nodes of a floor stick and slip alternately (4e-6 of the friction).
  enum { ROUNDS = 12 };
  static const double CLOSE = 1e-9, TURNS = 5e-6;
  SbSlidingLaw law = start->law;
  for (int round = 0;; round++) {
    SbSlidingLaw found;
    SbStatus status = sb_sliding_solve_with(task, known ? NULL : &law, out, report);
    if (!sb_sliding_usable(status) || !(out->load > 0)) {
      return status;
    }
    sb_sliding_law(&found, task->model, out);
    const double asked = law_force(&found, &on->fit);
    const SbSlidingLaw next = {found.coefficient + start->law.coefficient -
                                   start->found.coefficient,
                               found.shear + start->law.shear - start->found.shear};
    const double off = law_force(&next, &on->fit) - law_force(&law, &on->fit);
    if (!isfinite(asked)) {
      return status;
    }
    const bool turns = isinf(on->fit.ring.fault) && fabs(off) <= TURNS * asked;
    if (known || turns || fabs(off) <= CLOSE * asked) {
      SbReport *first = status == SB_OK ? report : NULL;
      const bool slides = on->fit.ring.state == SB_RING_SLIDES;
      const double apart = fabs(asked - law_force(&on->law, &on->fit));
      SbStatus borne = slides ? add_difference(out, task, &start->pull, apart, first) : SB_OK;
      borne = borne == SB_OK ? bear(out, task, on, &found, first) : borne;
      return borne != SB_OK ? borne : status;
    }
    if (round == ROUNDS) {
      return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                     "fitment and friction of the %s seal do not agree next to the base's",
                     sb_seal_name(task->seal));
    }
    law = next;
  }
}

const char *sb_sliding_stroke(const SbSlidingTask *task) {
  return sb_model_way(task->model) * task->speed > 0 ? "on the in-stroke" : "on the return";
}

void sb_ring_warn_limit(SbWarnings *warnings, const SbSlidingTask *task, const SbSealState *state) {
  const bool rolls = state->section == SB_RING_ROLLS;
  sb_warn_serious(warnings, rolls ? "ring-rolls" : "ring-jams", SB_CONTACT_IN_FLOOR_FRICTION,
                  "the %s ring %s %s: its section carries %.0f %% of its friction, turned by %.0f°",
                  sb_seal_name(task->seal), rolls ? "rolls" : "jams", sb_sliding_stroke(task),
                  100 * state->borne_share, state->rotation);
}

// Solves a round of a drag: the ring dragged by `law` (NULL: as it is known) and its film. *like is
// the task with warnings of its own, those of the last round.
static SbStatus drag_round(SbSlidingTask *like, const SbSlidingTask *task, const SbSlidingLaw *law,
                           SbSealState *out, SbReport *report) {
  SbSlidingMemory *memory = task->memory;
  SbWarnings *own = &memory->warnings;
  memset(own, 0, sizeof *own);
  own->subject = task->warnings != NULL ? task->warnings->subject : NULL;
  *like = *task;
  like->warnings = own;
  memory->rest_waits = true;
  const SbStatus status = sb_sliding_solve_with(like, law, out, report);
  memory->rest_waits = memory->near = false;
  return status;
}

// What a round of a drag found.
typedef struct {
  SbSlidingLaw law; // of its film
  double before;    // friction that dragged its ring [N]
  double asked;     // friction of its film on that ring [N]
  bool agrees;      // both are equal to the tolerance
} RoundEnd;

// Returns whether friction and ring of a round agree: to half the model's tolerance, or to a jump
// within the error of the film in `state` (sb_sliding_drag()), which is at most three times its
// estimate, if no smaller difference can be found: in the last round, or in a `bracket` of that
// width. Else moves the next law, *law, into the bracket.
static bool judge_round(SbSlidingLaw *law, const SbSlidingTask *task, SbSlidingFitment *on,
                        const RoundEnd *end, double bracket[2], bool last,
                        const SbSealState *state) {
  static const double ESTIMATES = 3;
  const double close = 0.5 * task->model->tolerance;
  const double asked = end->asked, apart = fabs(asked - end->before);
  if (on->fit.ring.state != SB_RING_SLIDES) {
    return asked >= (1 - close) * fabs(on->fit.ring.drag);
  }
  if (apart > fmax(close, on->jump) * asked) {
    near_law(law, &on->law, bracket);
    last = last || bracket[1] - bracket[0] <= 2 * close * law->shear;
    const bool within = apart <= ESTIMATES * state->central_error * asked;
    on->jump = last && within ? apart / asked : on->jump;
  }
  return apart <= fmax(close, on->jump * (1 + 4 * DBL_EPSILON)) * asked;
}

// Accepts the last round of a drag, whose solution had `status`: solves the state at rest,
// estimates the error of the friction and reduces the friction to what the section carries.
static SbStatus end_drag(SbSealState *out, const SbSlidingTask *task, SbSlidingFitment *on,
                         const RoundEnd *end, SbStatus status, SbReport *report) {
  const SbContactLaw *law = sb_contact_law(task->model);
  const bool slides = on->fit.ring.state == SB_RING_SLIDES;
  const double apart = fabs(end->asked - end->before); // both 0 without friction
  SbStatus next =
      slides ? add_difference(out, task, &on->pull, apart, status == SB_OK ? report : NULL) : SB_OK;
  if (next != SB_OK) {
    return next;
  }
  next = sb_sliding_rest(task, out, status == SB_OK ? report : NULL);
  if (!sb_sliding_usable(next)) {
    return next;
  }
  status = status == SB_OK ? next : status;
  next = bear(out, task, on, &end->law, status == SB_OK ? report : NULL);
  if (!slides && law->detached_scatter > 0) {
    // A film that is a closed form has no error.
    out->friction_error =
        fmax(out->friction_error, 0) + law->detached_scatter * fabs(on->fit.ring.drag);
  }
  status = next != SB_OK ? next : status;
  if (!end->agrees) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                   "fitment and friction of the %s seal do not agree: %.5g N and %.5g N",
                   sb_seal_name(task->seal), end->before, end->asked);
  }
  if (!slides) {
    law->warn_limit(task->warnings, task, out);
  }
  return status;
}

// Computes the state of a sliding ring: friction drags it, and depends on the film on the dragged
// ring. Both are solved in turns until the friction that drags the ring is that of its own film. A
// ring whose maximum drag is less than its friction rolls or jams; the film is then that of this
// last state. The film depends on the nodes at the contact's inlet (sb_sliding_read_film()). Where
// a node enters or leaves the contact the friction jumps: a jump within the film's own error is
// accepted, and is an error of the friction.
SbStatus sb_sliding_drag(const SbSlidingTask *task, SbSealState *out, SbReport *report) {
  enum { ROUNDS = 6 };
  const double pressure = task->pressure.left - task->pressure.right;
  SbSlidingMemory *memory = task->memory;
  SbSlidingFitment *on = &memory->fitment[task->speed > 0 ? SB_WAY_IN : SB_WAY_OUT];
  bool known = on->known && on->pressure == pressure && on->seal == task->seal;
  const SbSlidingStart *start = sb_sliding_start_of(task);
  if (memory->tangent && start != NULL && start->ring != NULL) {
    return drag_beside(task, on, start, known, out, report);
  }
  if (memory->tangent && start == NULL) {
    memory->now = on;
    sb_sliding_clear(out);
    return sb_sliding_no_tangent(task, on, report);
  }
  const bool first = !known;
  bool mirrored = false;
  if (!known) {
    sb_sliding_store(memory, sb_sliding_way(task));
    on->jump = 0;
    known = mirrored = mirror(task, on);
  }
  SbSlidingLaw law = known ? on->law : sb_sliding_first_law(task, on, start);
  SbStatus status = SB_OK;
  double bracket[2] = {-INFINITY, INFINITY};
  Round earlier = {0};
  for (int round = 0;; round++) {
    SbSlidingTask like;
    memory->near = round > 0 || mirrored;
    status = drag_round(&like, task, known && round == 0 ? NULL : &law, out, report);
    if (!sb_sliding_usable(status) || !(out->load > 0)) {
      break;
    }
    sb_sliding_law(&law, task->model, out);
    RoundEnd end = {law, law_force(&on->law, &on->fit), law_force(&law, &on->fit), false};
    if (!isfinite(end.asked)) {
      (void)sb_sliding_rest(&like, out, NULL);
      break;
    }
    const Round now = round_of(end.before, &on->fit);
    if (round > 0) {
      set_pull(&on->pull, &earlier, &now, fabs(end.asked - end.before), pressure == 0);
    } else if (!known) {
      on->pull = start != NULL ? start->pull : usual_pull(&on->fit);
    }
    earlier = now;
    end.agrees = judge_round(&law, &like, on, &end, bracket, round + 1 == ROUNDS, out);
    if (!end.agrees && round + 1 < ROUNDS) {
      continue;
    }
    on->found = first || round > 0 ? law : on->found;
    status = end_drag(out, &like, on, &end, status, report);
    break;
  }
  sb_warnings_merge(task->warnings, &memory->warnings);
  return status;
}
