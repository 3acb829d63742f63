// See rig.h.
#include "engine/valve/rig.h"

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

// Keeps the first slip.
static void rig_event(const SbMotionEvent *event, void *user) {
  SbMotionEvent *slip = user;
  if (event->kind == SB_MOTION_SLIP && slip->time < 0.0) {
    *slip = *event;
  }
}

SbStatus sb_rig_run(const SbRig *rig, SbRigEach each, void *user, SbMotionEvent *slip,
                    SbDynamicsEnergy *energy, SbDynamicsCounters *counters, SbReport *report) {
  if (!(rig->load > 0.0) || !(rig->coefficient >= 0.0) || !(rig->duration > 0.0) ||
      !(rig->rate > 0.0) || !isfinite(rig->duration * rig->rate) ||
      rig->duration * rig->rate > 1e8) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "the rig's load, coefficient, duration or rate is wrong");
  }
  SbRig held = *rig;
  SbDynamicsModel model = {.mass = rig->mass,
                           .contacts = SB_RIG_RINGS,
                           .loads = rig_loads,
                           .user = &held,
                           .drive = {.kind = SB_DRIVE_PRESS,
                                     .end = 1e3,
                                     .rise = 1e3 / rig->speed,
                                     .hold = INFINITY,
                                     .fall = 1.0,
                                     .cycles = 1},
                           .drive_stiffness = rig->thread_stiffness,
                           .drive_damping = rig->thread_damping,
                           .start_dwell = rig->rest};
  for (int i = 0; i < SB_RIG_RINGS; i++) {
    model.contact[i] = rig->contact;
  }
  SbDynamics motion;
  SbStatus status = sb_dynamics_init(&motion, &model, report);
  if (status != SB_OK) {
    return status;
  }
  SbMotionEvent first = {.time = -1.0};
  sb_dynamics_listen(&motion, rig_event, &first);
  size_t count = sb_rig_samples(rig);
  for (size_t i = 0; i < count && status == SB_OK; i++) {
    SbDynamicsSample sample;
    status = sb_dynamics_advance(&motion, (double)i / rig->rate, report);
    sb_dynamics_sample(&motion, &sample, i + 1 == count ? energy : NULL);
    if (status == SB_OK && !each(i, &sample, user)) {
      status = sb_fail(report, SB_ERROR_CANCELLED, "cancelled after %zu samples", i + 1);
    }
  }
  if (slip != NULL && first.time >= 0.0) {
    *slip = first;
  }
  if (counters != NULL) {
    *counters = motion.counters;
  }
  return status;
}

double sb_rig_contact_coefficient(double load, double diameter, double radius,
                                  double reduced_modulus, double area_share,
                                  double shear_strength) {
  double length = M_PI * diameter;
  double width = 2.0 * sb_hertz_half_width(load / SB_RIG_RINGS / length, radius, reduced_modulus);
  double area = area_share * SB_RIG_RINGS * length * width;
  return shear_strength * area / load;
}

SbStatus sb_rig_coefficients(SbRigCoefficients *out, const double *force, size_t count, double rate,
                             double load, double prominence, size_t *peak, size_t peak_max,
                             SbReport *report) {
  *out = (SbRigCoefficients){NAN, NAN, NAN, NAN, NAN, 0, false, false};
  if (!(load > 0.0) || !(prominence >= 0.0) || !(rate > 0.0) || count < 3) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "coefficients need a load above 0, a rate and at least three samples");
  }
  // Follow the highest sample since the last trough; it is a peak once the force has fallen from it
  // by the prominence, and the next search starts once it has risen as much from the trough.
  double top = force[0], trough = force[0], sum = 0.0, after = 0.0;
  size_t top_at = 0, first_at = 0;
  bool rising = true;
  for (size_t i = 0; i < count; i++) {
    if (!isfinite(force[i])) {
      return sb_fail(report, SB_ERROR_INPUT, "sample %zu of the force is not a number", i);
    }
    if (rising) {
      if (force[i] > top) {
        top = force[i];
        top_at = i;
      } else if (top - force[i] > prominence && top_at > 0) {
        size_t found = out->found_first ? out->peaks + 1 : 0;
        if (peak != NULL && found < peak_max) {
          peak[found] = top_at;
        }
        if (!out->found_first) {
          out->found_first = true;
          out->first_peak = top;
          out->first_time = (double)top_at / rate;
          first_at = top_at;
        } else {
          sum += top;
          out->peaks++;
        }
        rising = false;
        trough = force[i];
      }
    } else if (force[i] < trough) {
      trough = force[i];
    } else if (force[i] - trough > prominence) {
      rising = true;
      top = force[i];
      top_at = i;
    }
  }
  if (!out->found_first) {
    return sb_fail(report, SB_ERROR_INFEASIBLE,
                   "the force has no first peak: the plate did not break away, or slid smoothly");
  }
  for (size_t i = first_at + 1; i < count; i++) {
    after += force[i];
  }
  out->stick_slip = out->peaks > 0;
  out->static_coefficient = out->first_peak / load;
  out->mean_coefficient = after / (double)(count - first_at - 1) / load;
  out->dynamic_coefficient =
      out->stick_slip ? sum / (double)out->peaks / load : out->mean_coefficient;
  return sb_succeed(report);
}
