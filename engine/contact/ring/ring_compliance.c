// Normal compliance of the ring at its bore contact: static condensation of the converged tangent.
//
// The tangent stiffness of the present equilibrium (large strain, prestress, follower fluid, all
// other contacts fixed as they are) is factorised once with the bore's nodes free; one solve per
// node gives its column. It is exact for the discrete ring to first order in the change of
// pressure, as long as no other contact opens or closes. Along the bore the nodes are free
// (frictionless), as under a film. The columns are those of nodal forces: a pressure p acts with
// the forces area_j p_j.
//
// For films much thinner than the mesh the same factor gives the split into the half-plane's
// logarithm and a smooth remainder. The response of the surface to the pressures sqrt(1 - z^2)
// U_l(z) over a window, which the mesh resolves, minus the response of the half-plane, which is
// known in closed form (Johnson, Contact Mechanics, 2.7), is a sum of Chebyshev polynomials in the
// position of the pressure and of the response. The modulus of the half-plane is that of the
// squeezed rubber, from the shortest of these waves; its slight variation along the contact is part
// of the smooth remainder.
#include "engine/contact/compliance.h"
#include "engine/contact/ring/ring_private.h"
#include "engine/numeric/legendre.h"

#include <math.h>
#include <string.h>

// Tangent of the present contact pressure as a follower load that is fixed in space, as that of a
// film is. Forces on material points would roll the section over, because a load that moves with
// its point leaves its support; neither a rigid bore nor a film does that. The force per axial
// length is constant, not the pressure, so that forces are the unknowns throughout.
static void add_follower(SbRing *ring) {
  SbRingFem *fem = ring->fem;
  const SbRingContact *contact = ring->contact;
  SbRingPatch patch;
  if (!sb_ring_patch(ring, SB_RING_BORE, &patch)) {
    return;
  }
  // Whole sides within the contact; at its ends the pressure is the fluid's. The straight line
  // through a side's ends is smooth where nodal pressures zigzag.
  int begin = patch.first + patch.first % 2, end = patch.last - patch.last % 2;
  for (int start = begin; start < end; start += 2) {
    double p[2], x[2][2], force[3][2], k[3][2][3][2], area[3];
    for (int a = 0; a < 2; a++) {
      int i = start + 2 * a;
      p[a] = i == begin ? patch.end_pressure[0]
             : i == end ? patch.end_pressure[1]
                        : sb_ring_node_pressure(ring, i, SB_RING_BORE);
      sb_ring_contact_place(contact, i, x[a]);
    }
    SbRingSidePressure pressure = {p[0], (p[1] - p[0]) / (x[1][1] - x[0][1]), true};
    sb_ring_side_load(contact, start / 2, pressure, force, k, area);
    for (int at = 0; at < 36; at++) {
      int a = at / 12, i = at / 6 % 2, b = at / 2 % 3, j = at % 2;
      sb_ring_fem_add(fem, fem->mesh->loop[sb_ring_wrap(contact, start + a)], i,
                      fem->mesh->loop[sb_ring_wrap(contact, start + b)], j, k[a][i][b][j]);
    }
  }
}

SbStatus sb_ring_free_bore(SbRing *ring, SbReport *report) {
  SbRingFem *fem = ring->fem;
  SbRingContact *contact = ring->contact;
  fem->axial_damping = 0.0;
  if (!sb_ring_fem_assemble(fem)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "the ring's state is not an equilibrium");
  }
  sb_ring_contact_apply(contact);
  add_follower(ring);
  // A node that is also in contact with a wall keeps that condition.
  for (int i = 0; i < contact->count; i++) {
    if (!sb_ring_touch(contact, i, SB_RING_BORE)->held) {
      continue;
    }
    SbRingCondition *condition = &fem->condition[fem->mesh->loop[i]];
    bool wall = sb_ring_touch(contact, i, SB_RING_WALL_RIGHT)->held ||
                sb_ring_touch(contact, i, SB_RING_WALL_LEFT)->held;
    *condition = (SbRingCondition){0};
    if (wall) {
      condition->count = 1;
      condition->direction[0][1] = 1.0;
      condition->direction[1][0] = 1.0;
    }
  }
  return sb_ring_fem_factor(fem, report);
}

// Number of waves of pressure; of those that determine the half-plane's modulus; extent of the
// window beyond the contact divided by its width, less if the surface turns away; smallest order of
// the fit of the dry pressure.
enum { WAVES = 10, WAVE_SHORT = 5, ORDER_LEAST = 2, REACHES = 3 };
static const double REACH[REACHES] = {0.2, 0.12, 0.07};

// The squeezed rubber's modulus over the unstrained one's: 1 to 1.5 from 3 to 40 % squeeze. Others
// come from waves that do not see a half-plane.
static const double MODULUS[2] = {0.8, 2.5};

// Sum of relative errors of both ends and peak above which the gap is refused.
static const double DRY_MOST = 0.01;

// One boundary side: places and displacements of its three nodes.
typedef struct {
  double r[3], z[3], dr[3], dz[3];
} Side;

static void side_of(const SbRing *ring, int side, Side *out) {
  const SbRingFem *fem = ring->fem;
  for (int a = 0; a < 3; a++) {
    int node = fem->mesh->loop[sb_ring_wrap(ring->contact, 2 * side + a)];
    double x[2];
    sb_ring_fem_place(fem, node, x);
    out->r[a] = x[0];
    out->z[a] = x[1];
    out->dr[a] = fem->du[2 * node];
    out->dz[a] = fem->du[2 * node + 1];
  }
}

// Returns the upper side at the axial position z, outwards from the bore's contact. False beyond
// the point where the surface turns away.
static bool find_side(const SbRing *ring, const SbRingPatch *patch, double z, int *side, Side *s) {
  *side = (patch->first + patch->last) / 4;
  side_of(ring, *side, s);
  int step = z > s->z[1] ? 1 : -1;
  for (int k = 0; k < ring->contact->count / 4; k++, *side += step) {
    side_of(ring, *side, s);
    if (!(s->z[2] > s->z[0])) {
      return false;
    }
    if (z >= s->z[0] && z <= s->z[2]) {
      return true;
    }
  }
  return false;
}

// Loads the window, from one side of the surface to another, with the inward pressure sqrt(1 - z^2)
// U_l(z), per length of the bore's circumference so that the answer stays symmetric.
static void load_wave(SbRing *ring, int from, int to, double middle, double half, int l) {
  SbRingFem *fem = ring->fem;
  double turn = fem->around != 0.0 ? fem->around * ring->contact->is.now.bore_radius : 1.0;
  memset(fem->rhs, 0, sizeof(double) * 2 * (size_t)fem->mesh->nodes);
  for (int side = from; side <= to; side++) {
    Side s;
    side_of(ring, side, &s);
    // In the angle of z = -cos(theta), where the wave is smooth up to the window's ends.
    double a = acos(fmin(1.0, fmax(-1.0, -(s.z[0] - middle) / half)));
    double b = acos(fmin(1.0, fmax(-1.0, -(s.z[2] - middle) / half)));
    for (int q = 0; q < 4; q++) {
      double theta = 0.5 * (a + b) + 0.5 * (b - a) * SB_RING_X4[q];
      double z = middle - half * cos(theta);
      double n[3], d[3];
      sb_ring_side_at(s.z, z, n, d);
      // U_l(-cos theta) sin(theta) = sin((l + 1)(pi - theta)).
      double pressure = sin((l + 1) * (M_PI - theta));
      double force = 0.5 * (b - a) * SB_RING_W4[q] * half * sin(theta) * pressure * turn;
      for (int k = 0; k < 3; k++) {
        fem->rhs[2 * fem->mesh->loop[sb_ring_wrap(ring->contact, 2 * side + k)]] -= n[k] * force;
      }
    }
  }
}

// Inward displacement of the surface at fixed axial places, and its slope dr/dz there.
static void read_wave(const SbRing *ring, const SbRingPatch *patch, double middle, double half,
                      double *value, double *slope) {
  for (int i = 0; i < SB_COMPLIANCE_MODES; i++) {
    double z = middle - half * cos(M_PI * (i + 0.5) / SB_COMPLIANCE_MODES), n[3], d[3];
    int side;
    Side s;
    value[i] = slope[i] = 0.0;
    if (find_side(ring, patch, z, &side, &s)) {
      sb_ring_side_at(s.z, z, n, d);
      slope[i] = sb_ring_side_sum(d, s.r) / sb_ring_side_sum(d, s.z);
      value[i] = slope[i] * sb_ring_side_sum(n, s.dz) - sb_ring_side_sum(n, s.dr);
    }
  }
}

// -int ln|x - s| of wave l over the window at Chebyshev's points; lengths in metres.
static void half_plane(double half, int l, double *value) {
  for (int i = 0; i < SB_COMPLIANCE_MODES; i++) {
    double theta = M_PI - M_PI * (i + 0.5) / SB_COMPLIANCE_MODES;
    double upper = cos((l + 2) * theta) / (l + 2);
    value[i] = l == 0 ? 0.5 * M_PI * (M_LN2 - log(half) - upper)
                      : 0.5 * M_PI * (cos(l * theta) / l - upper);
    value[i] *= half;
  }
}

// Computes the Chebyshev coefficients of the smooth part from the responses minus those of the
// half-plane.
//
// A ring without axial support drifts by any amount under an unsymmetric pressure, and its free
// surface next to the contact drifts with it. The part of a response that is proportional to the
// surface's slope is therefore removed, by the drift that leaves the smallest remainder. `slope`
// NULL: the ring has axial support.
static void smooth_part(SbSurfaceCompliance *out, double half,
                        double answer[WAVES][SB_COMPLIANCE_MODES], const double *slope) {
  enum { N = SB_COMPLIANCE_MODES };
  double compliance = sb_compliance_half_plane(out), s[WAVES][WAVES + 2] = {{0.0}};
  for (int l = WAVES - 1; l >= 0; l--) {
    double plane[N], rest[N], v[N], up = 0.0, down = 1e-30;
    half_plane(half, l, plane);
    for (int i = 0; i < N; i++) {
      rest[i] = answer[l][i] - compliance * plane[i];
      up += slope != NULL ? rest[i] * slope[i] : 0.0;
      down += slope != NULL ? slope[i] * slope[i] : 0.0;
    }
    for (int i = 0; i < N && slope != NULL; i++) {
      rest[i] -= up / down * slope[i];
    }
    sb_chebyshev_coefficients(v, rest, N);
    for (int k = 0; k < WAVES; k++) {
      s[k][l] = (4.0 * v[k] / (M_PI * half) + s[k][l + 2]) / (l == 0 ? 2.0 : 1.0);
    }
  }
  out->modes = N;
  for (int k = 0; k < WAVES; k++) {
    for (int l = 0; l < WAVES; l++) {
      out->smooth[k][l] = 0.5 * (s[k][l] + s[l][k]);
    }
  }
}

// Computes the gap whose dry contact has the ring's recovered pressure, and solves that contact for
// a check. As many polynomials as the curve has represent it exactly; fewer are used if the highest
// ones cause contact outside the contact.
static SbStatus dry_gap(const SbRing *ring, SbRingPatch *patch, SbSurfaceCompliance *c,
                        SbReport *report) {
  SbDryContact p, dry;
  if (!sb_ring_ends(ring, SB_RING_BORE, patch, &p)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                   "no smooth pressure fits the ring's bore contact");
  }
  // In SI units, above the lower ambient pressure.
  double low = fmin(p.pressure_left, p.pressure_right) * ring->stress;
  p.left *= ring->length;
  p.right *= ring->length;
  p.pressure_left = p.pressure_left * ring->stress - low;
  p.pressure_right = p.pressure_right * ring->stress - low;
  for (int k = 0; k < p.count; k++) {
    p.a[k] *= ring->stress;
  }
  p.peak = p.peak * ring->stress - low;
  double width = p.right - p.left;
  p.load = 0.25 * M_PI * width * p.a[0] +
           0.5 * (p.pressure_left - p.pressure_right) * (p.left + p.right);
  // An order that gives no contact is as unfit as one that gives another: the next is lower.
  for (; p.count >= ORDER_LEAST; p.count--) {
    sb_compliance_of_pressure(c, &p);
    if (sb_dry_contact(&dry, c, p.load, p.pressure_left, p.pressure_right, report) == SB_OK &&
        fabs(dry.left - p.left) + fabs(dry.right - p.right) +
                fabs(dry.peak / p.peak - 1.0) * width <
            DRY_MOST * width) {
      return sb_succeed(report);
    }
  }
  return sb_fail(report, SB_ERROR_NOT_CONVERGED, "no smooth gap gives the ring's contact pressure");
}

// The surface over a window of one reach.
static SbStatus surface_over(SbRing *ring, SbRingPatch patch, double reach,
                             SbSurfaceCompliance *out, SbReport *report) {
  *out = (SbSurfaceCompliance){0};
  double middle = 0.5 * (patch.place[0] + patch.place[1]);
  double half = (0.5 + reach) * (patch.place[1] - patch.place[0]);
  int from, to;
  Side s;
  if (!find_side(ring, &patch, middle - half, &from, &s) ||
      !find_side(ring, &patch, middle + half, &to, &s)) {
    return sb_fail(report, SB_ERROR_INFEASIBLE,
                   "the ring's surface turns away too near to the bore contact");
  }
  SbStatus status = sb_ring_free_bore(ring, report);
  double answer[WAVES][SB_COMPLIANCE_MODES], slope[SB_COMPLIANCE_MODES];
  double unit = ring->length / ring->stress; // of displacement per pressure
  double length = half * ring->length, up = 0.0, down = 0.0;
  for (int l = 0; l < WAVES && status == SB_OK; l++) {
    load_wave(ring, from, to, middle, half, l);
    status = sb_ring_fem_apply_factor(ring->fem, report);
    read_wave(ring, &patch, middle, half, answer[l], slope);
    double plane[SB_COMPLIANCE_MODES];
    half_plane(length, l, plane);
    for (int i = 0; i < SB_COMPLIANCE_MODES; i++) {
      answer[l][i] *= unit;
      bool counts = l >= WAVE_SHORT && l % 2 == 0;
      up += counts ? answer[l][i] * plane[i] : 0.0;
      down += counts ? plane[i] * plane[i] : 0.0;
    }
  }
  if (!ring->first_order) { // whose forces are the linear model's
    sb_ring_contact_settle(ring->contact);
  }
  if (status != SB_OK) {
    return status;
  }
  out->left = (middle - half) * ring->length;
  out->right = (middle + half) * ring->length;
  out->modulus = 4.0 * down / (M_PI * up);
  double nu = ring->body.poisson_ratio, unstrained = 2.0 * ring->body.modulus / (1.0 - nu * nu);
  if (!(out->modulus > MODULUS[0] * unstrained && out->modulus < MODULUS[1] * unstrained)) {
    return sb_fail(report, SB_ERROR_INFEASIBLE,
                   "the ring's surface is too steep next to the bore contact");
  }
  smooth_part(out, length, answer, ring->fem->axial_spring > 0.0 ? slope : NULL);
  return dry_gap(ring, &patch, out, report);
}

SbStatus sb_ring_surface(SbRing *ring, SbSurfaceCompliance *out, SbReport *report) {
  *out = (SbSurfaceCompliance){0};
  SbRingPatch patch;
  if (!sb_ring_patch(ring, SB_RING_BORE, &patch)) {
    return sb_fail(report, SB_ERROR_INFEASIBLE, "the ring has no contact with the bore");
  }
  SbStatus status = SB_ERROR_INFEASIBLE;
  for (int i = 0; i < REACHES && status != SB_OK && status != SB_ERROR_MEMORY; i++) {
    status = surface_over(ring, patch, REACH[i], out, report);
  }
  return status;
}
