// Revolved profiles. See solid.h and outline.h; meshes are in solid_mesh.c.
#include "engine/mechanism/outline.h"
#include "engine/numeric/legendre.h"

#include <float.h>
#include <math.h>
#include <string.h>

// What an arc that touches the axis may dip below it where drawings are rounded to 1e-11 m: the
// errors of its height and of its radius.
static const double ROUNDED = 2e-11;

// An outline that starts and ends on the axis is closed by the axis, which encloses no area.
static bool by_axis(const SbProfile *p) {
  return p->point[0].r == 0.0 && p->point[p->count - 1].r == 0.0;
}

static size_t pieces_of(const SbProfile *p) {
  return by_axis(p) ? p->count - 1 : p->count;
}

// Piece i of an outline whose x counts from `origin`.
static SbPiece piece_at(const SbProfile *p, size_t i, double origin) {
  const SbProfilePoint *a = &p->point[i], *b = &p->point[(i + 1) % p->count];
  return (SbPiece){a->x - origin, a->r, b->x - origin, b->r, a->bulge};
}

SbPiece sb_profile_piece(const SbProfile *profile, size_t index) {
  return piece_at(profile, index, 0.0);
}

static double place_on(const SbPiece *s, const double at[2]) {
  double off;
  return sb_piece_place(s, at[0], at[1], &off);
}

// ---- crossings ----

// Points that the lines and circles of two pieces have in common, four at most; of the same line or
// circle the pieces' ends, between which they may overlap.
static size_t meet(double at[4][2], const SbPiece *a, const SbPiece *b) {
  if (a->bulge == 0.0 && b->bulge != 0.0) {
    return meet(at, b, a);
  }
  const double end[4][2] = {{a->x0, a->y0}, {a->x1, a->y1}, {b->x0, b->y0}, {b->x1, b->y1}};
  double bx = b->x1 - b->x0, br = b->y1 - b->y0, lb = hypot(bx, br);
  if (a->bulge == 0.0) {
    double ax = a->x1 - a->x0, ar = a->y1 - a->y0, la = hypot(ax, ar);
    double det = ax * br - ar * bx, dx = b->x0 - a->x0, dr = b->y0 - a->y0;
    if (fabs(det) > 1e-12 * la * lb) {
      double f = (dx * ar - dr * ax) / det; // along b: exact on a cylinder
      at[0][0] = b->x0 + f * bx;
      at[0][1] = b->y0 + f * br;
      return 1;
    }
    bool apart = fabs(dx * ar - dr * ax) > 1e-12 * la * (hypot(dx, dr) + la);
    memcpy(at, end, sizeof end);
    return apart ? 0 : 4;
  }
  // A circle and a line, which of two circles is that through their common points: `foot` is the
  // line's nearest point to a's centre, (ux, ur) its direction.
  const SbArc arc = sb_piece_arc(a);
  double size = arc.radius, ux = bx / lb, ur = br / lb;
  double foot = (b->y0 - arc.centre[1]) * ux - (b->x0 - arc.centre[0]) * ur;
  if (b->bulge != 0.0) {
    const SbArc other = sb_piece_arc(b);
    double dx = other.centre[0] - arc.centre[0], dr = other.centre[1] - arc.centre[1];
    double d = hypot(dx, dr);
    size = fmax(arc.radius, other.radius);
    if (d < 1e-12 * size) {
      memcpy(at, end, sizeof end);
      return fabs(arc.radius - other.radius) > 1e-12 * size ? 0 : 4;
    }
    foot = (d * d + (arc.radius - other.radius) * (arc.radius + other.radius)) / (2.0 * d);
    ux = dr / d;
    ur = -dx / d;
  }
  double across = (arc.radius - foot) * (arc.radius + foot);
  if (across < -1e-14 * size * size) {
    return 0;
  }
  for (int side = 0; side < 2; side++) {
    double along = (side == 0 ? -1.0 : 1.0) * sqrt(fmax(across, 0.0));
    at[side][0] = arc.centre[0] - foot * ur + along * ux;
    at[side][1] = arc.centre[1] + foot * ux + along * ur;
  }
  return 2;
}

// Returns whether two pieces have a common point other than where one continues in the next.
static bool crosses(const SbProfile *p, size_t i, size_t j, double tiny) {
  const SbPiece a = piece_at(p, i, 0.0), b = piece_at(p, j, 0.0);
  double at[4][2];
  size_t total = pieces_of(p);
  size_t n = meet(at, &a, &b);
  // Where pieces are tangent to each other their meeting is only known to the root of rounding.
  double la = sb_piece_length(&a), lb = sb_piece_length(&b), near = 1e3 * tiny;
  bool follows = j == i + 1, precedes = i == 0 && j + 1 == p->count && total == p->count;
  for (size_t k = 0; k < n; k++) {
    // From the start of each piece.
    double f = la * place_on(&a, at[k]), g = lb * place_on(&b, at[k]);
    if (f < -tiny || f - la > tiny || g < -tiny || g - lb > tiny) {
      continue;
    }
    bool joint =
        (follows && la - f <= near && g <= near) || (precedes && f <= near && lb - g <= near);
    if (!joint) {
      return true;
    }
  }
  return false;
}

// ---- integrals ----

enum { POINTS = 10 }; // Gauss points of a piece

typedef struct {
  double area, volume, first, third, second; // A, and integrals of r, r x, r^3, r x^2 over it
} Moments;

static void add_piece(Moments *m, const SbPiece *s, const double *node, const double *weight) {
  const SbArc arc = s->bulge != 0.0 ? sb_piece_arc(s) : (SbArc){0};
  int panels = 1 + (int)(fabs(arc.sweep) / 0.6);
  for (int panel = 0; panel < panels; panel++) {
    for (int i = 0; i < POINTS; i++) {
      double f = (panel + 0.5 + 0.5 * node[i]) / panels, at[2];
      sb_piece_point(s, f, at);
      const double x = at[0], r = at[1];
      double dx = s->bulge != 0.0 ? -arc.sweep * (r - arc.centre[1]) : s->x1 - s->x0;
      double w = -0.5 * weight[i] / panels * dx;
      m->area += w * r;
      m->volume += w * r * r / 2.0;
      m->first += w * r * r * x / 2.0;
      m->second += w * r * r * x * x / 2.0;
      m->third += w * r * r * r * r / 4.0;
    }
  }
}

static void moments_of(Moments *m, const SbProfile *p, double origin) {
  double node[POINTS], weight[POINTS];
  sb_legendre_gauss(node, weight, POINTS);
  *m = (Moments){0};
  size_t n = pieces_of(p);
  for (size_t i = 0; i < n; i++) {
    const SbPiece s = piece_at(p, i, origin);
    add_piece(m, &s, node, weight);
  }
}

double sb_profile_area(const SbProfile *p) {
  double area = 0.0;
  for (size_t i = 0; i < pieces_of(p); i++) {
    const SbPiece piece = piece_at(p, i, p->point[0].x);
    area += sb_piece_area(&piece, 0.0);
  }
  return area;
}

// Whether an outline turns once about a point.
static bool is_inside(const SbProfile *p, double x, double r) {
  double turn = 0.0;
  for (size_t i = 0; i < p->count; i++) { // the axis too, where it closes the outline
    const SbPiece s = piece_at(p, i, x);
    const SbArc arc = s.bulge != 0.0 ? sb_piece_arc(&s) : (SbArc){0};
    double r0 = s.y0 - r, r1 = s.y1 - r, cross = s.x0 * r1 - s.x1 * r0;
    turn += atan2(cross, s.x0 * s.x1 + r0 * r1);
    // Between chord and arc, the arc turns once more about it.
    if (hypot(arc.centre[0], arc.centre[1] - r) < arc.radius && cross * arc.sweep < 0.0) {
      turn += arc.sweep > 0.0 ? 2.0 * M_PI : -2.0 * M_PI;
    }
  }
  return fabs(turn) > M_PI;
}

bool sb_profile_encloses(const SbProfile *outer, const SbProfile *inner) {
  enum { LOOKED = 16 };
  const double step = 1e-3; // along the piece, and of that to the left
  size_t n = 2 * pieces_of(inner);
  bool inside = true;
  for (size_t i = 0; i < n && inside; i += 1 + n / LOOKED) {
    const SbPiece s = piece_at(inner, i / 2, 0.0);
    double at[2], next[2], part = i % 2 == 0 ? 0.25 : 0.5;
    sb_piece_point(&s, part, at);
    sb_piece_point(&s, part + step, next);
    inside = is_inside(outer, at[0] - step * (next[1] - at[1]), at[1] + step * (next[0] - at[0]));
  }
  return inside;
}

SbStatus sb_profile_check(const SbProfile *p, SbReport *report) {
  if (p->count < 2 || p->count > SB_PROFILE_MAX) {
    return sb_fail(report, SB_ERROR_INPUT, "a profile has 2 to %d points, not %zu", SB_PROFILE_MAX,
                   p->count);
  }
  double extent = 0.0;
  for (size_t i = 0; i < p->count; i++) {
    const SbProfilePoint *a = &p->point[i];
    if (!isfinite(a->x) || !isfinite(a->r) || !isfinite(a->bulge)) {
      return sb_fail(report, SB_ERROR_INPUT, "point %zu of the profile is not a number", i);
    }
    if (a->r < 0.0) {
      return sb_fail(report, SB_ERROR_INPUT, "point %zu of the profile is below the axis", i);
    }
    extent = fmax(extent, hypot(a->x - p->point[0].x, a->r - p->point[0].r));
  }
  if (!by_axis(p) && !p->closed) {
    return sb_fail(report, SB_ERROR_INPUT,
                   "the profile is open: it must close or start and end on the axis");
  }
  size_t n = pieces_of(p);
  double tiny = 1e-9 * extent;
  for (size_t i = 0; i < n; i++) {
    const SbPiece s = piece_at(p, i, 0.0);
    if (hypot(s.x1 - s.x0, s.y1 - s.y0) <= tiny) {
      return sb_fail(report, SB_ERROR_INPUT, "piece %zu of the profile has no length", i);
    }
    const SbArc arc = s.bulge != 0.0 ? sb_piece_arc(&s) : (SbArc){0};
    const double bottom[2] = {arc.centre[0], arc.centre[1] - arc.radius};
    if (bottom[1] < -fmax(tiny, ROUNDED) &&
        fabs(place_on(&s, bottom) - 0.5) * fabs(arc.sweep) <= 0.5 * fabs(arc.sweep) + 1e-9) {
      return sb_fail(report, SB_ERROR_INPUT, "arc %zu of the profile dips below the axis", i);
    }
  }
  for (size_t i = 0; i < n; i++) {
    for (size_t j = i + 1; j < n; j++) {
      if (crosses(p, i, j, tiny)) {
        return sb_fail(report, SB_ERROR_INPUT, "the profile crosses itself (pieces %zu and %zu)", i,
                       j);
      }
    }
  }
  Moments m;
  moments_of(&m, p, 0.0);
  if (!(fabs(m.area) > 1e-12 * extent * extent)) {
    return sb_fail(report, SB_ERROR_INPUT, "the profile encloses no area");
  }
  if (m.area < 0.0) {
    return sb_fail(report, SB_ERROR_INPUT,
                   "the profile has the wrong handedness: it must run counter-clockwise");
  }
  return sb_succeed(report);
}

SbStatus sb_solid_revolve(SbSolid *solid, const SbProfile *p, double density, SbReport *report) {
  if (!(density > 0.0) || !isfinite(density)) {
    return sb_fail(report, SB_ERROR_RANGE, "the density must be above 0, not %g kg/m3", density);
  }
  SbStatus status = sb_profile_check(p, report);
  if (status != SB_OK) {
    return status;
  }
  // Relative to the profile's middle, so that a part far from the origin keeps its digits.
  double low = INFINITY, high = -INFINITY;
  for (size_t i = 0; i < p->count; i++) {
    low = fmin(low, p->point[i].x);
    high = fmax(high, p->point[i].x);
  }
  Moments m;
  moments_of(&m, p, 0.5 * (low + high));
  // Rounding leaves none, or less, of an outline that encloses next to nothing.
  if (!(m.volume > 0.0)) {
    return sb_fail(report, SB_ERROR_INPUT, "the profile encloses no volume");
  }
  *solid = (SbSolid){.volume = 2.0 * M_PI * m.volume};
  solid->mass = density * solid->volume;
  double at = m.first / m.volume;
  double axial = 2.0 * M_PI * density * m.third;
  double across = 0.5 * axial + 2.0 * M_PI * density * (m.second - at * m.first);
  solid->centre[0] = at + 0.5 * (low + high);
  solid->inertia[0][0] = axial;
  solid->inertia[1][1] = across;
  solid->inertia[2][2] = across;
  return sb_succeed(report);
}

void sb_solid_remove(SbSolid *body, const SbSolid *hole) {
  const SbSolid part[2] = {*body, *hole};
  *body = (SbSolid){part[0].volume - part[1].volume, part[0].mass - part[1].mass, {0.0}, {{0.0}}};
  for (int k = 0; k < 3; k++) {
    body->centre[k] =
        (part[0].mass * part[0].centre[k] - part[1].mass * part[1].centre[k]) / body->mass;
  }
  for (int n = 0; n < 2; n++) { // parallel axis theorem, to the new centre
    double d[3], square = 0.0;
    for (int k = 0; k < 3; k++) {
      d[k] = part[n].centre[k] - body->centre[k];
      square += d[k] * d[k];
    }
    for (int k = 0; k < 9; k++) {
      int i = k / 3, j = k % 3;
      double about = part[n].inertia[i][j] + part[n].mass * ((i == j ? square : 0.0) - d[i] * d[j]);
      body->inertia[i][j] += n == 0 ? about : -about;
    }
  }
}

// ---- diameters ----

// Returns the smallest and largest radius of the outline at x; high -1 if there is none.
static void radii_at(const SbProfile *p, double x, double *low, double *high) {
  size_t n = pieces_of(p);
  double top = 0.0; // lines count as one by their lengths
  for (size_t i = 0; i < p->count; i++) {
    top = fmax(top, p->point[i].r);
  }
  const SbPiece across = {.x0 = x, .x1 = x, .y1 = top};
  *low = INFINITY;
  *high = -1.0;
  for (size_t i = 0; i < n; i++) {
    const SbPiece s = piece_at(p, i, 0.0);
    double at[4][2];
    for (size_t k = meet(at, &across, &s); k-- > 0;) {
      double place = place_on(&s, at[k]);
      if (place >= 0.0 && place <= 1.0) {
        *low = fmin(*low, at[k][1]);
        *high = fmax(*high, at[k][1]);
      }
    }
  }
  // Solid down to the axis, which the outline does not follow.
  double a = p->point[0].x, b = p->point[p->count - 1].x;
  if (by_axis(p) && x >= fmin(a, b) && x <= fmax(a, b)) {
    *low = 0.0;
  }
}

static void look_at(const SbProfile *p, double x, SbProfileDiameters *out) {
  double low, high;
  radii_at(p, x, &low, &high);
  if (high >= 0.0) {
    out->smallest = fmin(out->smallest, 2.0 * high);
    out->largest = fmax(out->largest, 2.0 * high);
    out->bore = fmin(out->bore, 2.0 * low);
  }
}

SbStatus sb_profile_diameters(SbProfileDiameters *out, const SbProfile *p, double x0, double x1,
                              SbReport *report) {
  SbStatus status = sb_profile_check(p, report);
  if (status != SB_OK) {
    return status;
  }
  if (!(x1 > x0)) {
    return sb_fail(report, SB_ERROR_RANGE, "the stretch must have a length");
  }
  // The surfaces turn only at ends, points and the tops and bottoms of arcs; walls across the axis
  // are looked at from both sides.
  *out = (SbProfileDiameters){INFINITY, -1.0, INFINITY};
  double side = 1e-10 * (x1 - x0);
  size_t n = pieces_of(p);
  look_at(p, x0 + side, out);
  look_at(p, x1 - side, out);
  for (size_t i = 0; i < n; i++) {
    const SbPiece s = piece_at(p, i, 0.0);
    double at[2] = {s.x0, s.bulge != 0.0 ? sb_piece_arc(&s).centre[0] : s.x0};
    for (int k = 0; k < 4; k++) {
      double x = at[k / 2] + (k % 2 == 0 ? -side : side);
      if (x > x0 && x < x1) {
        look_at(p, x, out);
      }
    }
  }
  if (out->largest < 0.0) {
    return sb_fail(report, SB_ERROR_RANGE, "the part does not reach %g .. %g m", x0, x1);
  }
  return sb_succeed(report);
}

// ---- outlines ----

// Number of chords that deviate by at most `sagitta` from a piece.
static size_t divisions(const SbPiece *s, double sagitta) {
  const SbArc arc = s->bulge != 0.0 ? sb_piece_arc(s) : (SbArc){.radius = sagitta};
  double step = 2.0 * acos(1.0 - fmin(sagitta / arc.radius, 1.0));
  return (size_t)fmax(1.0, ceil(fabs(arc.sweep) / step));
}

SbStatus sb_outline_of_profile(SbOutline *out, const SbProfile *p, double sagitta,
                               SbReport *report) {
  SbStatus status = sb_profile_check(p, report);
  out->count = 0;
  if (status != SB_OK) {
    return status;
  }
  for (size_t i = 0; i < p->count;) {
    const SbPiece piece = piece_at(p, i, 0.0);
    size_t n = divisions(&piece, sagitta);
    if (out->count + n > SB_OUTLINE_MAX) {
      // From the start, coarser.
      sagitta *= 2.0;
      i = out->count = 0;
      continue;
    }
    out->point[out->count++] = (SbOutlinePoint){p->point[i].x, p->point[i].r}; // exactly
    for (size_t k = 1; k < n; k++) {
      double at[2];
      sb_piece_point(&piece, (double)k / (double)n, at);
      out->point[out->count++] = (SbOutlinePoint){at[0], fmax(at[1], 0.0)};
    }
    i++;
  }
  return sb_succeed(report);
}
