// What the ring tells: forces, contact ends, pressure profile, volume, checks of its own balance.
//
// Ends and profile of a contact are those of the smooth curve that its nodal forces recover
// (ring_pressure.c), the peak is a parabola through the nodes around it. Where no curve fits, nodal
// pressures are the nodal contact forces over the nodes' areas, so they are never negative and
// their sum is the load, and an end of a contact lies between the last held and the first open
// node, where the gap, which opens with the 3/2 power of the distance, extrapolates to zero; the
// pressure there is the fluid's.
#include "engine/contact/ring/ring_private.h"
#include "engine/numeric/dense.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

// Points of a smooth profile.
enum { PROFILE_POINTS = 321 };

static double angle_of(const SbRing *ring, int i) {
  double turn = i >= ring->contact->count ? 2.0 * M_PI : i < 0 ? -2.0 * M_PI : 0.0;
  return ring->mesh->angle[sb_ring_wrap(ring->contact, i)] + turn;
}

// Where a contact ends, near its last held node. Inside, the excess over the fluid's pressure falls
// with the root of the distance, so its square extrapolates linearly from the last two closed
// sides' mid nodes (whose nodal pressure is the accurate one). Outside, the gap opens with the 3/2
// power. The mean of both estimates is taken.
static void find_end(const SbRing *ring, SbRingSurface surface, int last, int outward, double fluid,
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
  double share = fabs(span) > 0.0 ? 1.0 - back / span : 0.5;
  share = fmin(1.0, fmax(0.0, share));

  // The two outermost closed sides.
  double z[2], p[2];
  int found = 0;
  for (int i = last; found < 2 && abs(i - last) < 8; i -= outward) {
    int wrapped = sb_ring_wrap(contact, i);
    const SbRingTouch *touch = sb_ring_touch(contact, i, surface);
    if (wrapped % 2 == 1 && touch->held && contact->closed[wrapped / 2]) {
      double at[2];
      sb_ring_contact_place(contact, i, at);
      double excess = fmax(0.0, touch->force / contact->weight[wrapped] - fluid);
      z[found] = at[axis];
      p[found++] = excess * excess;
    }
  }
  if (found == 2 && p[1] > p[0]) {
    double end = z[0] + (z[0] - z[1]) * p[0] / (p[1] - p[0]);
    double inner[2];
    sb_ring_contact_place(ring->contact, last - outward, inner);
    double by_pressure = (end - x[0][axis]) / span;
    double least = (inner[axis] - x[0][axis]) / span;
    // A last held mid node stands on a side that the fluid may share: the gap knows better.
    if ((last + contact->count) % 2 == 0 && by_pressure >= least && by_pressure <= 1.0) {
      share = 0.5 * (share + by_pressure);
    }
  }
  *place = x[0][axis] + share * span;
  // A share below zero lies between the last two held nodes.
  double step = angle_of(ring, last + outward) - angle_of(ring, last);
  *angle = angle_of(ring, last) + share * step;
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
  find_end(ring, surface, patch->first, -1, patch->end_pressure[0], &patch->angle[0],
           &patch->place[0]);
  find_end(ring, surface, patch->last, 1, patch->end_pressure[1], &patch->angle[1],
           &patch->place[1]);
  return true;
}

// How far a node's contact force exceeds what the fluid would press there.
static double excess(const SbRingContact *contact, int i, SbRingSurface surface) {
  SbRingFrame frame = sb_ring_frame_at(contact, i, surface);
  const double *share = &contact->share[2 * i];
  return sb_ring_touch(contact, i, surface)->force - frame.n[0] * share[0] - frame.n[1] * share[1];
}

double sb_ring_node_pressure(const SbRing *ring, int i, SbRingSurface surface) {
  const SbRingContact *contact = ring->contact;
  int count = contact->count;
  i = sb_ring_wrap(contact, i);
  const SbRingTouch *touch = sb_ring_touch(contact, i, surface);
  double weight = contact->weight[i];
  if (!touch->held || !(weight > 0.0)) {
    return 0.0;
  }
  if (contact->closed[i / 2] && contact->closed[sb_ring_wrap(contact, i - 1 + i % 2) / 2]) {
    return touch->force / weight;
  }
  // At an end the fluid acts on the open side: its pressure plus the excess over it.
  SbRingPatch patch;
  if (!sb_ring_patch(ring, surface, &patch)) {
    assert(!"a held node belongs to a contact");
    return 0.0;
  }
  int past = (i - patch.first + count) % count;
  bool nearer_last = 2 * past > patch.last - patch.first;
  return patch.end_pressure[nearer_last ? 1 : 0] + fmax(0.0, excess(contact, i, surface)) / weight;
}

// Nodal pressures as they are, for a contact that no smooth curve fits.
static int nodal_profile(const SbRing *ring, const SbRingPatch *patch, double *x, double *pressure,
                         int capacity) {
  int n = 0;
  double before = -HUGE_VAL;
  for (int i = patch->first - 1; i <= patch->last + 1; i++) {
    double at[2], p = 0.0;
    if (i < patch->first || i > patch->last) {
      int end = i < patch->first ? 0 : 1;
      at[1] = patch->place[end];
      p = patch->end_pressure[end];
    } else {
      sb_ring_contact_place(ring->contact, i, at);
      // A held node beyond the end that its neighbours tell is only a tail of the mesh.
      double margin = 1e-6 * (patch->place[1] - patch->place[0]);
      if (at[1] < patch->place[0] + margin || at[1] > patch->place[1] - margin) {
        continue;
      }
      // Where the surface lets go within the contact it may fold: its open part is passed over.
      if (at[1] <= before) {
        continue;
      }
      p = sb_ring_node_pressure(ring, i, SB_RING_BORE);
    }
    if (n < capacity) {
      x[n] = at[1] * ring->length;
      pressure[n] = p * ring->stress;
    }
    n++;
    before = at[1];
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
  for (int i = 0; i < PROFILE_POINTS && i < capacity; i++) {
    // Dense at both ends, where the pressure rises with the root of the distance.
    bool last = i == PROFILE_POINTS - 1;
    double share = 0.5 * (1.0 - cos(M_PI * i / (PROFILE_POINTS - 1)));
    double at = last ? patch.place[1] : patch.place[0] + share * (patch.place[1] - patch.place[0]);
    x[i] = at * ring->length;
    pressure[i] = sb_dry_contact_pressure(&smooth, at) * ring->stress;
  }
  return PROFILE_POINTS;
}

// Greatest nodal pressure, refined by a parabola through the nodes around it.
static double find_peak(const SbRing *ring, const SbRingPatch *patch) {
  double peak = 0.0;
  int best = patch->first;
  for (int i = patch->first; i <= patch->last; i++) {
    double p = sb_ring_node_pressure(ring, i, SB_RING_BORE);
    if (p > peak) {
      peak = p;
      best = i;
    }
  }
  double x[2];
  sb_ring_contact_place(ring->contact, best, x);
  double place = x[1];
  // Least squares over two nodes either side smooths the vertex/mid-side pattern.
  int reach = best - patch->first < patch->last - best ? best - patch->first : patch->last - best;
  reach = reach > 3 ? 3 : reach;
  if (reach < 2) {
    return peak;
  }
  double normal[9] = {0.0}, b[3] = {0.0}, scale = 0.0;
  for (int i = best - reach; i <= best + reach; i++) {
    sb_ring_contact_place(ring->contact, i, x);
    scale = fmax(scale, fabs(x[1] - place));
  }
  for (int i = best - reach; i <= best + reach; i++) {
    sb_ring_contact_place(ring->contact, i, x);
    double t = (x[1] - place) / scale, power[3] = {1.0, t, t * t};
    double p = sb_ring_node_pressure(ring, i, SB_RING_BORE);
    for (int k = 0; k < 3; k++) {
      b[k] += power[k] * p;
      for (int l = 0; l < 3; l++) {
        normal[k + 3 * l] += power[k] * power[l];
      }
    }
  }
  if (sb_eliminate(normal, b, 3) && b[2] < 0.0) {
    double t = fmin(1.0, fmax(-1.0, -0.5 * b[1] / b[2]));
    peak = b[0] + t * (b[1] + b[2] * t);
  }
  return peak;
}

// Normal force that the fluid still carries in the balance on sides that are only partly within
// the contact; that part belongs to the closed contact.
static double end_share(const SbRing *ring, const SbRingPatch *patch) {
  double low = fmin(patch->place[0], patch->place[1]),
         high = fmax(patch->place[0], patch->place[1]);
  double turn = ring->body.plane_strain ? 1.0 : 2.0 * M_PI, sum = 0.0;
  for (int side = (patch->first - 2) / 2; side <= patch->last / 2; side++) {
    if (ring->contact->closed[sb_ring_wrap(ring->contact, 2 * side) / 2]) {
      continue;
    }
    double a[2], b[2];
    sb_ring_contact_place(ring->contact, 2 * side, a);
    sb_ring_contact_place(ring->contact, 2 * side + 2, b);
    double overlap = fmin(high, fmax(a[1], b[1])) - fmax(low, fmin(a[1], b[1]));
    int end = 4 * side + 2 > patch->first + patch->last ? 1 : 0;
    double radius = ring->body.plane_strain ? 1.0 : 0.5 * (a[0] + b[0]);
    sum += fmax(0.0, overlap) * patch->end_pressure[end] * radius * turn;
  }
  return sum;
}

void sb_ring_result(const SbRing *ring, SbRingResult *out) {
  const SbRingContact *contact = ring->contact;
  *out = (SbRingResult){.turn = contact->is.turn,
                        .unknowns = 2 * ring->mesh->nodes,
                        .newton_iterations = ring->count.iterations,
                        .load_steps = ring->count.steps,
                        .rejected_steps = ring->count.rejected};
  double l = ring->length, f = ring->force, force[SB_RING_SURFACES][2] = {{0.0}};
  // Forces, extents, penetration, least excess pressure.
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL}, least = HUGE_VAL;
  double axial = 0.0;
  for (int i = 0; i < contact->count; i++) {
    double x[2];
    sb_ring_contact_place(contact, i, x);
    for (int k = 0; k < 2; k++) {
      low[k] = fmin(low[k], x[k]);
      high[k] = fmax(high[k], x[k]);
    }
    axial += contact->fluid[2 * i + 1];
    for (int s = 0; s < SB_RING_SURFACES; s++) {
      SbRingFrame frame = sb_ring_frame(&contact->is.now, (SbRingSurface)s, x);
      const SbRingTouch *touch = sb_ring_touch(contact, i, s);
      out->penetration = fmax(out->penetration, -frame.gap * l);
      if (touch->held) {
        least = fmin(least, excess(contact, i, (SbRingSurface)s) / contact->weight[i]);
        for (int k = 0; k < 2; k++) {
          force[s][k] += touch->force * frame.n[k] + touch->tangent * frame.t[k];
        }
      }
    }
  }
  SbRingPatch patch[2] = {0}; // bore and floor
  SbDryContact smooth;
  for (int s = SB_RING_BORE; s <= SB_RING_FLOOR; s++) {
    bool touches = sb_ring_patch(ring, (SbRingSurface)s, &patch[s]);
    if (touches) {
      sb_ring_ends(ring, (SbRingSurface)s, &patch[s], &smooth);
      force[s][0] += (s == SB_RING_BORE ? -1.0 : 1.0) * end_share(ring, &patch[s]);
    }
    out->touching = out->touching || (touches && s == SB_RING_BORE);
  }
  out->bore_force = 0.0 - force[SB_RING_BORE][0] * f; // not -0
  out->bore_drag = force[SB_RING_BORE][1] * f;
  out->floor_force = force[SB_RING_FLOOR][0] * f;
  out->floor_drag = force[SB_RING_FLOOR][1] * f;
  out->wall_right_force = 0.0 - force[SB_RING_WALL_RIGHT][1] * f;
  out->wall_left_force = force[SB_RING_WALL_LEFT][1] * f;

  out->state = contact->rolls ? SB_RING_ROLLS : out->touching ? SB_RING_SLIDES : SB_RING_NO_CONTACT;
  if (out->touching) {
    out->pressure_peak = find_peak(ring, &patch[SB_RING_BORE]) * ring->stress;
  }
  out->contact_left = patch[SB_RING_BORE].place[0] * l;
  out->contact_right = patch[SB_RING_BORE].place[1] * l;
  out->pressure_least = isfinite(least) ? least * ring->stress : 0.0;
  out->thickness = (high[0] - low[0]) * l;
  out->axial_left = low[1] * l;
  out->axial_right = high[1] * l;
  double axial_most = fabs(axial);
  for (int s = 0; s < SB_RING_SURFACES; s++) {
    axial += force[s][1];
    axial_most = fmax(axial_most, fmax(fabs(force[s][1]), fabs(force[s][0])));
  }
  out->axial_imbalance = axial_most > 0.0 ? fabs(axial) / axial_most : 0.0;
  out->friction_excess = contact->slip_excess * f;
  double reference = 0.0;
  for (int i = 0; i < ring->mesh->nodes; i++) {
    reference += ring->fem->mass[i];
  }
  out->volume_change = ring->fem->volume / reference - 1.0;
}
