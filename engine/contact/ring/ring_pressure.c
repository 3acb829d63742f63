// The contact pressure recovered from nodal forces: a smooth curve with the same load, and its
// ends.
//
// Nodal forces contain the information of the element solver about the pressure: f_i = int N_i p
// dA. Divided by the nodes' areas they oscillate between vertices and mid-sides and end at the
// nearest node. As weights of a smooth p they are far more accurate (they are the residual of the
// balance, tested with the elements' own shape functions). So the pressure of a smooth contact
// (Johnson, Contact Mechanics, 2.7),
//
//   p = p_first (1 - t/pi) + p_last t/pi + sum a_k sin((k + 1) t),   place = middle - half cos t,
//
// is fitted to them: least squares of (f_i - int N_i p dA)^2 / area_i with the exact total force,
// linear in a_k, and Gauss-Newton's method for both ends, which the residual determines about ten
// times more accurately than the gaps of single nodes. The number of terms is that of the smallest
// generalised cross-validation (Golub, Heath and Wahba 1979). The outermost node in contact only
// contributes to the total: its force is that of an end which the mesh cannot locate. On sides that
// the fluid still loads in the balance, f_i only has the excess over the fluid. Not modelled:
// contacts in several parts, and pressures with a corner (a land's edge under the contact). The fit
// is then not good enough and is rejected.
#include "engine/contact/ring/ring_private.h"
#include "engine/numeric/dense.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS_MAX = 640, TERMS_LEAST = 3, TERMS_MOST = 8, POINTS = 4, ENDS_MAX = 12 };

// Largest root mean square of what the curve leaves of the nodal pressures, over theirs; above the
// zigzag of a coarse mesh, below what a corner or a second contact leaves.
static const double MISFIT = 0.03;

// One contact: its nodes from one before the first in contact to one after the last, along the
// loop. The position of node i is x[i], increasing; r[i] is its radius, or 1 in the plane.
typedef struct SbRingRecovery {
  int rows, terms;
  double x[ROWS_MAX], r[ROWS_MAX], z[ROWS_MAX];
  double force[ROWS_MAX], area[ROWS_MAX];
  bool fits[ROWS_MAX];   // is part of the least squares
  bool closed[ROWS_MAX]; // of the side that begins at an even row
  double turn, end_pressure[2];
  double range[2][2]; // what either end may be
  // Of the last fit.
  double matrix[ROWS_MAX][TERMS_MOST], known[ROWS_MAX];
  double a[TERMS_MOST];
  // Residuals at the ends, at displaced ends, and their derivatives with respect to both.
  double here[ROWS_MAX], there[ROWS_MAX], slope[2][ROWS_MAX];
  // The bore's ends of a state that never changes (SbRing.first_order).
  bool kept, found;
  SbRingPatch patch;
  SbDryContact pressure;
} Fit;

SbRingRecovery *sb_ring_recovery_create(void) {
  Fit *fit = malloc(sizeof *fit);
  if (fit != NULL) {
    fit->kept = false;
  }
  return fit;
}

static bool collect(Fit *fit, const SbRing *ring, SbRingSurface surface, const SbRingPatch *patch) {
  const SbRingContact *contact = ring->contact;
  // Whole sides, so that even rows are vertices.
  int first = patch->first - 2 + (patch->first + 2) % 2, last = patch->last + 2 - patch->last % 2;
  int axis = surface == SB_RING_BORE || surface == SB_RING_FLOOR ? 1 : 0;
  double sign = surface == SB_RING_BORE || surface == SB_RING_WALL_LEFT ? 1.0 : -1.0;
  fit->rows = last - first + 1;
  if (fit->rows > ROWS_MAX || fit->rows < 9 || fit->rows > contact->count) {
    return false;
  }
  fit->turn = ring->fem->around != 0.0 ? ring->fem->around : 1.0;
  for (int i = 0; i < fit->rows; i++) {
    int place = sb_ring_wrap(contact, first + i);
    double x[2];
    sb_ring_contact_place(contact, place, x);
    const SbRingTouch *touch = sb_ring_touch(contact, place, surface);
    fit->x[i] = sign * x[axis];
    fit->z[i] = sign * x[1 - axis];
    fit->r[i] = ring->fem->around != 0.0 ? x[0] : 1.0;
    fit->fits[i] = touch->held && first + i > patch->first && first + i < patch->last;
    fit->force[i] = touch->held ? touch->force : 0.0;
    fit->area[i] = contact->weight[place];
    fit->closed[i] = contact->closed[place / 2];
    bool inside = first + i >= patch->first && first + i <= patch->last;
    if (inside && !(touch->held && fit->area[i] > 0.0)) {
      return false; // in parts
    }
    if (i > 0 && !(fit->x[i] > fit->x[i - 1]) && (inside || first + i - 1 >= patch->first)) {
      return false; // folded
    }
  }
  for (int end = 0; end < 2; end++) {
    fit->end_pressure[end] = patch->end_pressure[end];
    // Between two nodes inside the last one in contact and its open neighbour, whose gap is open:
    // the end is nearer to where that gap extrapolates to zero.
    int at = (end == 0 ? patch->first : patch->last) - first, out = end == 0 ? -1 : 1;
    const double open = fit->x[at + out], closed = sign * patch->place[end];
    const double most = out * (open - closed) > 0.0 ? 0.5 * (open + closed) : open;
    fit->range[end][0] = fmin(most, fit->x[at - 2 * out]);
    fit->range[end][1] = fmax(most, fit->x[at - 2 * out]);
  }
  return true;
}

// The angle t of a place between both ends, to rounding at either.
static double angle_at(double place, const double end[2]) {
  double width = end[1] - end[0], share = (place - end[0]) / width;
  return share < 0.5 ? 2.0 * asin(sqrt(share)) : M_PI - 2.0 * asin(sqrt((end[1] - place) / width));
}

// Adds one point of a side to the nodal forces of the terms, fit->matrix, and to their totals, and
// subtracts that of the ends' pressure from the known forces, from row i on. Returns the force of
// the ends' pressure. `weight`: of the point in t.
static inline double add_point(Fit *fit, double total[TERMS_MOST], const double end[2], int i,
                               double t, double weight) {
  const double *x = &fit->x[i], *r = &fit->r[i], *z = &fit->z[i];
  const double middle = 0.5 * (end[0] + end[1]), half = 0.5 * (end[1] - end[0]);
  const int terms = fit->terms;
  double c = cos(t), s = sin(t);
  double at = middle - half * c, n[3], d[3];
  sb_ring_side_at(x, at, n, d);
  double across = sb_ring_side_sum(d, z) / sb_ring_side_sum(d, x);
  double area =
      weight * half * s * sqrt(1.0 + across * across) * fit->turn * sb_ring_side_sum(n, r);
  double known = fit->end_pressure[0] * (1.0 - t / M_PI) + fit->end_pressure[1] * t / M_PI;
  if (!fit->closed[i]) {
    known -= fit->end_pressure[at < middle ? 0 : 1];
  }
  // sin((k + 1) t) by its recurrence.
  double wave[TERMS_MOST], before = 0.0, now = s;
  for (int k = 0; k < terms; k++) {
    wave[k] = area * now;
    total[k] += wave[k];
    double next = 2.0 * c * now - before;
    before = now;
    now = next;
  }
  for (int b = 0; b < 3; b++) {
    fit->known[i + b] -= n[b] * area * known;
    for (int k = 0; k < terms; k++) {
      fit->matrix[i + b][k] += n[b] * wave[k];
    }
  }
  return area * known;
}

// Computes the nodal forces of each term for given ends, fit->matrix, their totals, and the nodal
// forces that remain for the terms, fit->known. Returns the total of the latter.
static double integrate(Fit *fit, const double end[2], double total[TERMS_MOST]) {
  double load = 0.0;
  memset(fit->matrix, 0, sizeof fit->matrix[0] * (size_t)fit->rows);
  memcpy(fit->known, fit->force, sizeof fit->known[0] * (size_t)fit->rows);
  for (int i = 0; i < fit->rows; i++) {
    load += fit->force[i];
  }
  for (int i = 0; i + 2 < fit->rows; i += 2) {
    double low = fmax(fit->x[i], end[0]), high = fmin(fit->x[i + 2], end[1]);
    if (!(high > low)) {
      continue;
    }
    double from = angle_at(low, end), to = angle_at(high, end);
    for (int q = 0; q < POINTS; q++) {
      double t = 0.5 * (from + to) + 0.5 * (to - from) * SB_RING_X4[q];
      load -= add_point(fit, total, end, i, t, 0.5 * (to - from) * SB_RING_W4[q]);
    }
  }
  return load;
}

// Computes the residuals per root of the area. Returns their mean square over that of the nodal
// pressures, negative if these are zero.
static double misfit(const Fit *fit, double *residual) {
  double left = 0.0, whole = 0.0;
  for (int i = 0; i < fit->rows; i++) {
    double rest = fit->known[i];
    for (int k = 0; k < fit->terms; k++) {
      rest -= fit->matrix[i][k] * fit->a[k];
    }
    residual[i] = fit->fits[i] ? rest / sqrt(fit->area[i]) : 0.0;
    left += residual[i] * residual[i];
    whole += fit->fits[i] ? fit->force[i] * fit->force[i] / fit->area[i] : 0.0;
  }
  return whole > 0.0 ? left / whole : -1.0;
}

// Coefficients for given ends; the residual per root of the area, and its mean square over that of
// the nodal pressures. Negative if there is none.
static double solve(Fit *fit, const double end[2], double *residual) {
  enum { N = TERMS_MOST + 1 };
  int terms = fit->terms, order = terms + 1;
  double total[TERMS_MOST] = {0.0}, normal[N * N] = {0.0}, b[N] = {0.0};
  const double load = integrate(fit, end, total);
  for (int i = 0; i < fit->rows; i++) {
    for (int k = 0; k < terms && fit->fits[i]; k++) {
      double weighted = fit->matrix[i][k] / fit->area[i];
      b[k] += weighted * fit->known[i];
      for (int l = 0; l < terms; l++) {
        normal[l * order + k] += weighted * fit->matrix[i][l];
      }
    }
  }
  for (int k = 0; k < terms; k++) {
    normal[terms * order + k] = normal[k * order + terms] = total[k];
  }
  b[terms] = load;
  if (!sb_eliminate(normal, b, (size_t)order)) {
    return -1.0;
  }
  memcpy(fit->a, b, sizeof fit->a[0] * (size_t)terms);
  return misfit(fit, residual);
}

// Gauss-Newton's move of both ends from where the residual is `here`; false if there is none.
static bool move_ends(Fit *fit, const double end[2], double move[2]) {
  double *here = fit->here, *there = fit->there, (*slope)[ROWS_MAX] = fit->slope;
  double m[3] = {0.0}, b[2] = {0.0}, step = 1e-6 * (end[1] - end[0]);
  for (int k = 0; k < 2; k++) {
    double moved[2] = {end[0], end[1]};
    moved[k] += step;
    if (solve(fit, moved, there) < 0.0) {
      return false;
    }
    for (int i = 0; i < fit->rows; i++) {
      slope[k][i] = (there[i] - here[i]) / step;
      b[k] -= slope[k][i] * here[i];
    }
  }
  for (int i = 0; i < fit->rows; i++) {
    m[0] += slope[0][i] * slope[0][i];
    m[1] += slope[0][i] * slope[1][i];
    m[2] += slope[1][i] * slope[1][i];
  }
  double det = m[0] * m[2] - m[1] * m[1];
  move[0] = (m[2] * b[0] - m[1] * b[1]) / det;
  move[1] = (m[0] * b[1] - m[1] * b[0]) / det;
  return det > 0.0;
}

// Both ends by Gauss-Newton's method; the mean square, negative if there is none.
static double find_ends(Fit *fit, double end[2]) {
  double *here = fit->here, *there = fit->there;
  double width = end[1] - end[0], best = solve(fit, end, here);
  for (int it = 0; it < ENDS_MAX && best >= 0.0; it++) {
    double move[2];
    if (!move_ends(fit, end, move)) {
      return -1.0;
    }
    double most = fmax(fabs(move[0]), fabs(move[1])), share = fmin(1.0, 0.05 * width / most);
    bool better = false;
    for (int half = 0; half < 4 && !better; half++, share *= 0.5) {
      double trial[2];
      for (int k = 0; k < 2; k++) {
        trial[k] = fmin(fit->range[k][1], fmax(fit->range[k][0], end[k] + share * move[k]));
      }
      double found = solve(fit, trial, there);
      better = found >= 0.0 && found < best;
      if (better) {
        double moved = fmax(fabs(trial[0] - end[0]), fabs(trial[1] - end[1]));
        memcpy(end, trial, sizeof trial);
        memcpy(here, there, sizeof fit->here);
        better = found < best * (1.0 - 1e-6) || moved > 1e-7 * width;
        best = found;
      }
    }
    if (!better) {
      break;
    }
  }
  return solve(fit, end, here);
}

// Does the same to rounding: a comparison of squares determines an end to the square root of
// rounding only.
static double find_held_ends(Fit *fit, double end[2]) {
  enum { MOVES_MAX = 14 };
  static const double CLOSE = 3e-11;
  double width = end[1] - end[0], best = solve(fit, end, fit->here), move[2] = {width, width};
  for (int it = 0; it < MOVES_MAX && best >= 0.0; it++) {
    if (fmax(fabs(move[0]), fabs(move[1])) <= CLOSE * width || !move_ends(fit, end, move)) {
      break;
    }
    for (int k = 0; k < 2; k++) {
      end[k] = fmin(fit->range[k][1], fmax(fit->range[k][0], end[k] + move[k]));
    }
    best = solve(fit, end, fit->here);
  }
  return best;
}

double sb_ring_profile_place(const SbDryContact *p, int i) {
  double share = 0.5 * (1.0 - cos(M_PI * i / (SB_RING_PROFILE - 1)));
  return i == SB_RING_PROFILE - 1 ? p->right : p->left + share * (p->right - p->left);
}

// Returns whether the curve rises from both ends and nowhere falls below the lower of their
// pressures; finds its peak.
static bool presses(SbDryContact *p) {
  sb_dry_contact_edges(p);
  double low = fmin(p->pressure_left, p->pressure_right);
  bool good = p->edge_left >= 0.0 && p->edge_right >= 0.0;
  for (int i = 1; i < SB_RING_PROFILE - 1 && good; i++) {
    double pressure = sb_dry_contact_pressure(p, sb_ring_profile_place(p, i));
    good = pressure >= low;
    p->peak = fmax(p->peak, pressure);
  }
  return good;
}

// Omits a single node in contact beyond an open one at either end, where the fluid keeps the next
// node open: its force is small and only contributes to the total.
static SbRingPatch without_strays(const SbRing *ring, SbRingSurface surface, SbRingPatch patch) {
  const SbRingContact *contact = ring->contact;
  if (!sb_ring_touch(contact, patch.first + 1, surface)->held &&
      sb_ring_touch(contact, patch.first + 2, surface)->held) {
    patch.first += 2;
  }
  if (!sb_ring_touch(contact, patch.last - 1, surface)->held &&
      sb_ring_touch(contact, patch.last - 2, surface)->held) {
    patch.last -= 2;
  }
  return patch;
}

// The last fit's curve between its ends.
static SbDryContact curve_of(const Fit *fit, const SbRingPatch *patch, const double end[2]) {
  SbDryContact out = {.left = end[0],
                      .right = end[1],
                      .pressure_left = patch->end_pressure[0],
                      .pressure_right = patch->end_pressure[1],
                      .count = fit->terms};
  for (int k = 0; k < fit->terms; k++) {
    out.a[k] = k % 2 == 0 ? fit->a[k] : -fit->a[k]; // from the other end
  }
  return out;
}

static bool fit_ends(const SbRing *ring, SbRingSurface surface, SbRingPatch *patch,
                     SbDryContact *out) {
  Fit *fit = ring->recovery;
  const SbRingHeld *held_as = &ring->held[surface];
  const SbRingPatch whole = without_strays(ring, surface, *patch);
  if ((held_as->known && held_as->terms == 0) || !collect(fit, ring, surface, &whole)) {
    return false;
  }
  double sign = surface == SB_RING_BORE || surface == SB_RING_WALL_LEFT ? 1.0 : -1.0;
  if (held_as->known) {
    double at[2] = {held_as->end[0], held_as->end[1]};
    fit->terms = held_as->terms;
    if (find_held_ends(fit, at) < 0.0) {
      return false;
    }
    *out = curve_of(fit, patch, at);
    (void)presses(out);
    patch->place[0] = sign * at[0];
    patch->place[1] = sign * at[1];
    return true;
  }
  double least = HUGE_VAL, end[2] = {sign * patch->place[0], sign * patch->place[1]};
  int held = whole.last - whole.first - 1, worse = 0;
  // A term of the wrong parity changes nothing: two that do not help end the search.
  for (int terms = TERMS_LEAST; terms <= TERMS_MOST && terms + 3 < held && worse < 2; terms++) {
    fit->terms = terms;
    worse++;
    double left = find_ends(fit, end);
    double free = 1.0 - (double)(terms + 2) / held;
    if (left >= 0.0 && left < MISFIT * MISFIT && left / (free * free) < least) {
      SbDryContact trial = curve_of(fit, patch, end);
      if (presses(&trial)) {
        least = left / (free * free);
        worse = 0;
        *out = trial;
      }
    }
  }
  if (least < HUGE_VAL) {
    patch->place[0] = sign * out->left;
    patch->place[1] = sign * out->right;
  }
  return least < HUGE_VAL;
}

bool sb_ring_ends(const SbRing *ring, SbRingSurface surface, SbRingPatch *patch,
                  SbDryContact *out) {
  Fit *fit = ring->recovery;
  if (!ring->first_order || surface != SB_RING_BORE) {
    return fit_ends(ring, surface, patch, out);
  }
  if (!fit->kept) {
    fit->patch = *patch;
    fit->found = fit_ends(ring, surface, &fit->patch, &fit->pressure);
    fit->kept = true;
  }
  *patch = fit->patch;
  *out = fit->found ? fit->pressure : *out;
  return fit->found;
}
