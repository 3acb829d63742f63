// See rig.h.
#include "engine/valve/run/rig.h"

#include "engine/contact/closed_forms.h"

#include <math.h>

size_t sb_rig_samples(const SbRig *rig) {
  return (size_t)floor(rig->duration * rig->rate * (1.0 + 1e-12)) + 1;
}

static void rig_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                      void *user) {
  const SbRig *rig = user;
  for (int i = 0; i < SB_RIG_RINGS; i++) {
    loads->level[i] = rig->coefficient * rig->load / SB_RIG_RINGS;
  }
  loads->constant = true;
}

SbStatus sb_rig_start(SbDynamics *motion, SbDynamicsModel *model, const SbRig *rig,
                      SbReport *report) {
  if (!(rig->load > 0.0) || !(rig->coefficient >= 0.0) || !(rig->duration > 0.0) ||
      !(rig->rate > 0.0) || !isfinite(rig->duration * rig->rate) ||
      rig->duration * rig->rate > 1e8) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "the rig's load, coefficient, duration or rate is wrong");
  }
  const double until = rig->duration + 1.0 / rig->rate;
  *model = (SbDynamicsModel){.mass = rig->mass,
                             .contacts = SB_RIG_RINGS,
                             .loads = rig_loads,
                             .user = (void *)rig,
                             // Not longer than the record, so that nothing after it matters.
                             .drive = {.kind = SB_DRIVE_PRESS,
                                       .end = rig->speed * until,
                                       .rise = until,
                                       .hold = INFINITY,
                                       .fall = 1.0,
                                       .cycles = 1},
                             .drive_stiffness = rig->thread_stiffness,
                             .drive_damping = rig->thread_damping,
                             .start_dwell = rig->rest};
  for (int i = 0; i < SB_RIG_RINGS; i++) {
    model->contact[i] = rig->contact;
  }
  return sb_dynamics_init(motion, model, report);
}

double sb_rig_contact_coefficient(double load, double diameter, double radius,
                                  double reduced_modulus, double area_share,
                                  double shear_strength) {
  double length = M_PI * diameter;
  double width = 2.0 * sb_hertz_half_width(load / SB_RIG_RINGS / length, radius, reduced_modulus);
  double area = area_share * SB_RIG_RINGS * length * width;
  return shear_strength * area / load;
}

bool sb_rig_signal_add(SbRigSignal *s, double force, size_t *peak) {
  // Follow the highest sample since the last trough; it is a peak once the force has fallen from it
  // by the prominence, and the next search starts once it has risen as much from the trough.
  size_t at = s->count++;
  s->after += force;
  if (at == 0 || (!s->falling && force > s->top)) {
    s->top = force;
    s->top_at = at;
    s->after = s->peaks == 0 ? 0.0 : s->after;
  } else if (!s->falling && s->top - force > s->prominence && s->top_at > 0) {
    *peak = s->top_at;
    s->falling = true;
    s->trough = force;
    if (s->peaks++ == 0) {
      s->first = s->top;
      s->first_at = s->top_at;
    } else {
      s->others += s->top;
    }
    return true;
  } else if (s->falling && force < s->trough) {
    s->trough = force;
  } else if (s->falling && force - s->trough > s->prominence) {
    s->falling = false;
    s->top = force;
    s->top_at = at;
  }
  return false;
}

SbStatus sb_rig_coefficients(SbRigCoefficients *out, const SbRigSignal *s, const SbRig *rig,
                             SbReport *report) {
  *out = (SbRigCoefficients){NAN, NAN, NAN, NAN, NAN, 0, false};
  if (!(rig->load > 0.0) || !(s->prominence >= 0.0) || !(rig->rate > 0.0) || s->count < 3) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "coefficients need a load above 0, a rate and at least three samples");
  }
  if (s->peaks == 0) {
    return sb_fail(report, SB_ERROR_INFEASIBLE,
                   "the force has no first peak: the plate did not break away, or slid smoothly");
  }
  double mean = s->after / (double)(s->count - s->first_at - 1);
  *out = (SbRigCoefficients){.static_coefficient = s->first / rig->load,
                             .dynamic_coefficient = mean / rig->load,
                             .mean_coefficient = mean / rig->load,
                             .first_peak = s->first,
                             .first_time = (double)s->first_at / rig->rate,
                             .peaks = s->peaks - 1,
                             .stick_slip = s->peaks > 1};
  if (out->stick_slip) {
    out->dynamic_coefficient = s->others / (double)out->peaks / rig->load;
  }
  return sb_succeed(report);
}
