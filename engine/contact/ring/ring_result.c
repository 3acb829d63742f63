// Results of the ring: forces, contact ends, pressure profile, volume, checks of its balance.
//
// Ends, profile and peak of a contact are those of the smooth curve that is recovered from its
// nodal forces (ring_pressure.c). If no curve fits, they are nodal: pressures are the nodal contact
// forces divided by the nodes' areas, so they are never negative and their sum is the load. An end
// of a contact is between the last node in contact and the first open node, where the gap, which
// opens with the 3/2 power of the distance, extrapolates to zero; the pressure there is the
// fluid's.
#include "engine/contact/ring/ring_private.h"

#include <math.h>
#include <stdlib.h>

static double angle_of(const SbRing *ring, int i) {
  double turn = i >= ring->contact->count ? 2.0 * M_PI : i < 0 ? -2.0 * M_PI : 0.0;
  return ring->mesh->angle[sb_ring_wrap(ring->contact, i)] + turn;
}

// Returns where a contact ends between its last node in contact and the first open one: the gap
// opens with the 3/2 power of the distance from there.
static void find_end(const SbRing *ring, SbRingSurface surface, int last, int outward,
                     double *angle, double *place) {
  const SbRingContact *contact = ring->contact;
  int axis = surface == SB_RING_BORE || surface == SB_RING_FLOOR ? 1 : 0;
  double x[3][2], q[3];
  for (int k = 0; k < 3; k++) {
    sb_ring_contact_place(contact, last + k * outward, x[k]);
    q[k] = pow(fmax(0.0, sb_ring_frame(&contact->is.now, surface, x[k]).gap), 2.0 / 3.0);
  }
  double span = x[1][axis] - x[0][axis];
  double back = q[2] > q[1] ? q[1] / (q[2] - q[1]) * (x[2][axis] - x[1][axis]) : 0.0;
  double share = fabs(span) > 0.0 ? fmin(1.0, fmax(0.0, 1.0 - back / span)) : 0.5;
  *place = x[0][axis] + share * span;
  *angle = angle_of(ring, last) + share * (angle_of(ring, last + outward) - angle_of(ring, last));
}

bool sb_ring_patch(const SbRing *ring, SbRingSurface surface, SbRingPatch *patch) {
  int count = ring->contact->count;
  // The contact is what the longest open run leaves.
  int run = 0, longest = 0, end = -1, any = 0;
  for (int i = 0; i < 2 * count; i++) {
    if (sb_ring_touch(ring->contact, i % count, surface)->held) {
      run = 0;
      any = 1;
    } else if (++run > longest) {
      longest = run;
      end = i % count;
    }
  }
  if (!any || longest >= count) {
    return false;
  }
  patch->first = (end + 1) % count;
  patch->last = patch->first + count - longest - 1;
  double left = ring->contact->is.now.pressure_left, right = ring->contact->is.now.pressure_right;
  patch->end_pressure[0] = surface == SB_RING_BORE || surface == SB_RING_WALL_LEFT ? left : right;
  patch->end_pressure[1] = surface == SB_RING_BORE || surface == SB_RING_WALL_RIGHT ? right : left;
  if (ring->body.inward && surface != SB_RING_BORE) { // the lower pressure is outside
    patch->end_pressure[surface == SB_RING_WALL_LEFT ? 0 : 1] = fmin(left, right);
  }
  find_end(ring, surface, patch->first, -1, &patch->angle[0], &patch->place[0]);
  find_end(ring, surface, patch->last, 1, &patch->angle[1], &patch->place[1]);
  return true;
}

double sb_ring_node_pressure(const SbRing *ring, int i, SbRingSurface surface) {
  const SbRingContact *contact = ring->contact;
  i = sb_ring_wrap(contact, i);
  const SbRingTouch *touch = sb_ring_touch(contact, i, surface);
  SbRingFrame frame = sb_ring_frame_at(contact, i, surface);
  // At an end the fluid presses the node as well, on the open side.
  const double *fluid = &contact->pressed[2 * i];
  double force = touch->force + frame.n[0] * fluid[0] + frame.n[1] * fluid[1];
  return touch->held && contact->weight[i] > 0.0 ? fmax(0.0, force) / contact->weight[i] : 0.0;
}

// Nodal pressures as they are, for a contact that no smooth curve fits.
static int nodal_profile(const SbRing *ring, const SbRingPatch *patch, double *x, double *pressure,
                         int capacity) {
  int n = 0;
  double before = -HUGE_VAL, margin = 1e-6 * (patch->place[1] - patch->place[0]);
  for (int i = patch->first - 1; i <= patch->last + 1; i++) {
    bool end = i < patch->first || i > patch->last;
    int which = i < patch->first ? 0 : 1;
    double at[2];
    sb_ring_contact_place(ring->contact, i, at);
    double place = end ? patch->place[which] : at[1];
    // A node in contact beyond the end that its neighbours determine is only an artefact of the
    // mesh. Where the surface leaves the contact in between it may fold: its open part is skipped.
    if (!end &&
        (place < patch->place[0] + margin || place > patch->place[1] - margin || place <= before)) {
      continue;
    }
    if (n < capacity) {
      double p = end ? patch->end_pressure[which] : sb_ring_node_pressure(ring, i, SB_RING_BORE);
      x[n] = place * ring->length;
      pressure[n] = p * ring->stress;
    }
    n++;
    before = place;
  }
  return n;
}

int sb_ring_profile(const SbRing *ring, double *x, double *pressure, int capacity) {
  SbRingPatch patch;
  SbDryContact smooth;
  if (!sb_ring_patch(ring, SB_RING_BORE, &patch)) {
    return 0;
  }
  if (!sb_ring_ends(ring, SB_RING_BORE, &patch, &smooth)) {
    return nodal_profile(ring, &patch, x, pressure, capacity);
  }
  for (int i = 0; i < SB_RING_PROFILE && i < capacity; i++) {
    double at = sb_ring_profile_place(&smooth, i);
    x[i] = at * ring->length;
    pressure[i] = sb_dry_contact_pressure(&smooth, at) * ring->stress;
  }
  return SB_RING_PROFILE;
}

bool sb_ring_side_touches(const SbRing *ring, SbRingSurface surface, int side) {
  bool some = false;
  for (int i = 0; i < 3; i++) {
    some = some ||
           sb_ring_touch(ring->contact, sb_ring_wrap(ring->contact, 2 * side + i), surface)->held;
  }
  return some;
}

// Normal force that the fluid still carries in the balance on sides that are only partly within
// the contact; that part belongs to the closed contact. Counted from either end inwards to the
// first closed side, or to a hollow between lobes, whose fluid is no part of the contact.
static double end_share(const SbRing *ring, SbRingSurface surface, const SbRingPatch *patch) {
  const SbRingContact *contact = ring->contact;
  const double low = fmin(patch->place[0], patch->place[1]);
  const double high = fmax(patch->place[0], patch->place[1]);
  const double turn = ring->body.plane_strain ? 1.0 : ring->fem->around;
  double sum = 0.0;
  for (int end = 0; end < 2; end++) {
    const int way = end == 0 ? 1 : -1;
    for (int side = end == 0 ? (patch->first - 2) / 2 : patch->last / 2;
         (4 * side + 2 > patch->first + patch->last) == (end == 1); side += way) {
      const bool within = 2 * side >= patch->first && 2 * side + 2 <= patch->last;
      if (contact->closed[sb_ring_wrap(contact, 2 * side) / 2] ||
          (within && !sb_ring_side_touches(ring, surface, side))) {
        break;
      }
      double a[2], b[2];
      sb_ring_contact_place(contact, 2 * side, a);
      sb_ring_contact_place(contact, 2 * side + 2, b);
      const double overlap = fmin(high, fmax(a[1], b[1])) - fmax(low, fmin(a[1], b[1]));
      const double radius = ring->body.plane_strain ? 1.0 : 0.5 * (a[0] + b[0]);
      sum += fmax(0.0, overlap) * patch->end_pressure[end] * radius * turn;
    }
  }
  return sum;
}

double sb_ring_friction_lack(const SbRing *ring) {
  const SbRingContact *contact = ring->contact;
  double whole = 0.0, lack = 0.0;
  for (int i = 0; i < contact->count && contact->is.now.bore_slides != 0; i++) {
    if (sb_ring_touch(contact, i, SB_RING_BORE)->held) {
      const SbRingFrame frame = sb_ring_frame_at(contact, i, SB_RING_BORE);
      const double normal = sb_ring_touch(contact, i, SB_RING_BORE)->force;
      const double all = sb_ring_grip(contact, i, SB_RING_BORE, normal, 0.0).force;
      const double fluid = sb_ring_fluid_at(contact, i, frame.n);
      whole += all;
      lack += all - sb_ring_grip(contact, i, SB_RING_BORE, normal, fluid).force;
    }
  }
  return whole > 0.0 ? lack / whole : 0.0;
}

const char *sb_ring_state_name(SbRingState state) {
  static const char *const names[] = {"slides", "rolls", "jams", "no-contact"};
  return names[state];
}

// Extent of the section, and the smallest excess of a contact's pressure over the fluid's.
typedef struct {
  double low[2], high[2], least;
} Extent;

// Sums the radial and axial forces of the contacts on each surface, and finds the largest
// penetration. Returns the fluid's axial force.
static double sum_forces(double force[SB_RING_SURFACES][2], Extent *extent, SbRingResult *out,
                         const SbRing *ring) {
  const SbRingContact *contact = ring->contact;
  double axial = 0.0;
  *extent = (Extent){{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}, HUGE_VAL};
  for (int i = 0; i < contact->count; i++) {
    double x[2];
    sb_ring_contact_place(contact, i, x);
    for (int k = 0; k < 2; k++) {
      extent->low[k] = fmin(extent->low[k], x[k]);
      extent->high[k] = fmax(extent->high[k], x[k]);
    }
    axial += contact->fluid[2 * i + 1];
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      SbRingFrame frame = sb_ring_frame(&contact->is.now, (SbRingSurface)s, x);
      const SbRingTouch *touch = sb_ring_touch(contact, i, s);
      out->penetration = fmax(out->penetration, -frame.gap * ring->length);
      if (touch->held) {
        const double *share = &contact->share[2 * i];
        double excess = touch->force - frame.n[0] * share[0] - frame.n[1] * share[1];
        extent->least = fmin(extent->least, excess / contact->weight[i]);
        for (int k = 0; k < 2; k++) {
          force[s][k] += touch->force * frame.n[k] + touch->tangent * frame.t[k];
        }
      }
    }
  }
  return axial;
}

// Finds the contact with one surface and its pressure; without a smooth curve the peak of the nodal
// pressures, and count = 0. Returns whether there is contact.
static bool find_contact(const SbRing *ring, SbRingSurface surface, SbRingPatch *patch,
                         SbDryContact *smooth) {
  const bool touching = sb_ring_patch(ring, surface, patch);
  smooth->peak = 0.0;
  smooth->count = 0;
  if (touching && !sb_ring_ends(ring, surface, patch, smooth)) {
    smooth->count = 0;
    for (int i = patch->first; i <= patch->last; i++) {
      smooth->peak = fmax(smooth->peak, sb_ring_node_pressure(ring, i, surface));
    }
  }
  return touching;
}

// Returns the imbalance of the axial forces divided by the largest force. `axial`: the fluid's.
static double axial_imbalance(double force[SB_RING_SURFACES][2], double axial) {
  double most = fabs(axial);
  for (int s = 0; s < SB_RING_SURFACES; s++) {
    axial += force[s][1];
    most = fmax(most, fmax(fabs(force[s][1]), fabs(force[s][0])));
  }
  return most > 0.0 ? fabs(axial) / most : 0.0;
}

// Returns the relative change of the section's volume.
static double volume_change(const SbRing *ring) {
  double reference = 0.0;
  for (int i = 0; i < ring->mesh->nodes; i++) {
    reference += ring->fem->mass[i];
  }
  return ring->fem->volume / reference - 1.0;
}

void sb_ring_result(const SbRing *ring, SbRingResult *out) {
  const SbRingContact *contact = ring->contact;
  *out = (SbRingResult){.turn = contact->is.turn,
                        .unknowns = 2 * ring->mesh->nodes,
                        .newton_iterations = ring->count.iterations,
                        .load_steps = ring->count.steps,
                        .rejected_steps = ring->count.rejected};
  const double l = ring->length, f = ring->force;
  double force[SB_RING_SURFACES][2] = {{0.0}};
  Extent extent;
  const double axial = sum_forces(force, &extent, out, ring);
  SbRingPatch patch[2] = {0}; // bore and floor
  SbDryContact smooth[2];
  for (int s = SB_RING_FLOOR; s >= SB_RING_BORE; s--) {
    out->touching = find_contact(ring, (SbRingSurface)s, &patch[s], &smooth[s]);
    if (out->touching) {
      force[s][0] +=
          (s == SB_RING_BORE ? -1.0 : 1.0) * end_share(ring, (SbRingSurface)s, &patch[s]);
    }
  }
  out->bore_force = 0.0 - force[SB_RING_BORE][0] * f; // not -0
  out->bore_drag = force[SB_RING_BORE][1] * f;
  out->floor_force = force[SB_RING_FLOOR][0] * f;
  out->floor_drag = force[SB_RING_FLOOR][1] * f;
  out->wall_right_force = 0.0 - force[SB_RING_WALL_RIGHT][1] * f;
  out->wall_left_force = force[SB_RING_WALL_LEFT][1] * f;

  bool slides = ring->state == SB_RING_SLIDES;
  out->state = slides && !out->touching ? SB_RING_NO_CONTACT : ring->state;
  out->drag_limit = ring->drag_limit;
  out->share_limit = ring->share_limit;
  out->pressure_peak = smooth[SB_RING_BORE].peak * ring->stress;
  out->order = out->touching ? (double)smooth[SB_RING_BORE].count /
                                   (patch[SB_RING_BORE].last - patch[SB_RING_BORE].first + 1)
                             : 0.0;
  out->contact_left = patch[SB_RING_BORE].place[0] * l;
  out->contact_right = patch[SB_RING_BORE].place[1] * l;
  out->pressure_least = isfinite(extent.least) ? extent.least * ring->stress : 0.0;
  out->thickness = (extent.high[0] - extent.low[0]) * l;
  out->axial_left = extent.low[1] * l;
  out->axial_right = extent.high[1] * l;
  out->axial_imbalance = axial_imbalance(force, axial);
  out->friction_excess = contact->slip_excess * f;
  out->fault = out->bore_force > 0.0 ? ring->fault * f / out->bore_force : 0.0;
  out->volume_change = volume_change(ring);
}
