// Revolved profiles. See solid.h; meshes are in solid_mesh.c.
#include "engine/mechanism/solid.h"
#include "engine/mechanism/solid_internal.h"
#include "engine/numeric/legendre.h"

#include <float.h>
#include <math.h>

// One piece of the outline.
typedef struct {
  double x0, r0, x1, r1;
  bool arc;
  double cx, cr, radius, from, sweep; // arc: centre, radius, start angle, signed angle
} Piece;

static size_t pieces_of(const SbProfile *p) {
  // An outline that starts and ends on the axis is closed by the axis, which encloses no area.
  bool by_axis = p->point[0].r == 0.0 && p->point[p->count - 1].r == 0.0;
  return by_axis ? p->count - 1 : p->count;
}

static void piece_at(Piece *s, const SbProfile *p, size_t i) {
  const SbProfilePoint *a = &p->point[i], *b = &p->point[(i + 1) % p->count];
  *s = (Piece){.x0 = a->x, .r0 = a->r, .x1 = b->x, .r1 = b->r, .arc = a->bulge != 0.0};
  if (s->arc) {
    double dx = b->x - a->x, dr = b->r - a->r, t = a->bulge;
    // Centre to the left of the chord for a left turn below a half circle.
    double off = (1.0 - t * t) / (4.0 * t);
    s->cx = 0.5 * (a->x + b->x) - off * dr;
    s->cr = 0.5 * (a->r + b->r) + off * dx;
    s->radius = hypot(dx, dr) * (1.0 + t * t) / (4.0 * fabs(t));
    s->from = atan2(a->r - s->cr, a->x - s->cx);
    s->sweep = 4.0 * atan(t);
  }
}

static void point_on(const Piece *s, double f, double *x, double *r) {
  if (s->arc) {
    *x = s->cx + s->radius * cos(s->from + f * s->sweep);
    *r = s->cr + s->radius * sin(s->from + f * s->sweep);
  } else {
    *x = s->x0 + f * (s->x1 - s->x0);
    *r = s->r0 + f * (s->r1 - s->r0);
  }
}

// Whether an angle lies on the arc, as a fraction of it.
static bool on_arc(const Piece *s, double angle, double slack, double *f) {
  double turn = (angle - s->from) * (s->sweep > 0.0 ? 1.0 : -1.0);
  turn -= 2.0 * M_PI * floor(turn / (2.0 * M_PI));
  if (turn > 2.0 * M_PI - slack) {
    turn -= 2.0 * M_PI;
  }
  *f = turn / fabs(s->sweep);
  return turn <= fabs(s->sweep) + slack;
}

// ---- crossings ----

static size_t line_line(const Piece *a, const Piece *b, double f[2], double g[2]) {
  double ax = a->x1 - a->x0, ar = a->r1 - a->r0, bx = b->x1 - b->x0, br = b->r1 - b->r0;
  double det = ax * br - ar * bx, dx = b->x0 - a->x0, dr = b->r0 - a->r0;
  double size = hypot(ax, ar) * hypot(bx, br);
  if (fabs(det) > 1e-12 * size) {
    f[0] = (dx * br - dr * bx) / det;
    g[0] = (dx * ar - dr * ax) / det;
    return 1;
  }
  // Parallel: on one line they may overlap; both ends of the common stretch count.
  if (fabs(dx * ar - dr * ax) > 1e-12 * hypot(ax, ar) * (hypot(dx, dr) + hypot(ax, ar))) {
    return 0;
  }
  double aa = ax * ax + ar * ar;
  double g0 = (dx * ax + dr * ar) / aa, g1 = ((b->x1 - a->x0) * ax + (b->r1 - a->r0) * ar) / aa;
  double low = fmax(0.0, fmin(g0, g1)), high = fmin(1.0, fmax(g0, g1));
  if (low > high) {
    return 0;
  }
  f[0] = low;
  f[1] = high;
  g[0] = (low - g0) / (g1 - g0);
  g[1] = (high - g0) / (g1 - g0);
  return 2;
}

static size_t line_arc(const Piece *a, const Piece *b, double f[2], double g[2]) {
  double ax = a->x1 - a->x0, ar = a->r1 - a->r0, ox = a->x0 - b->cx, orr = a->r0 - b->cr;
  double aa = ax * ax + ar * ar, half = ox * ax + orr * ar;
  double rest = ox * ox + orr * orr - b->radius * b->radius, d = half * half - aa * rest;
  size_t n = 0;
  if (d < -1e-14 * aa * b->radius * b->radius) {
    return 0;
  }
  for (int side = -1; side <= 1; side += 2) {
    double at = (-half + side * sqrt(fmax(d, 0.0))) / aa;
    double angle = atan2(orr + at * ar, ox + at * ax);
    f[n] = at;
    if (on_arc(b, angle, 1e-9, &g[n])) {
      n++;
    }
  }
  return n;
}

static size_t arc_arc(const Piece *a, const Piece *b, double f[2], double g[2]) {
  double dx = b->cx - a->cx, dr = b->cr - a->cr, d = hypot(dx, dr);
  double size = fmax(a->radius, b->radius);
  if (d < 1e-12 * size) {
    if (fabs(a->radius - b->radius) > 1e-12 * size) {
      return 0;
    }
    // The same circle: ends of one on the other.
    size_t n = 0;
    for (int end = 0; end < 2; end++) {
      double angle = b->from + end * b->sweep;
      if (n < 2 && on_arc(a, angle, 1e-9, &f[n])) {
        g[n++] = end;
      }
    }
    return n;
  }
  double along = (d * d + a->radius * a->radius - b->radius * b->radius) / (2.0 * d);
  double across = a->radius * a->radius - along * along;
  if (across < -1e-14 * size * size) {
    return 0;
  }
  across = sqrt(fmax(across, 0.0));
  size_t n = 0;
  for (int side = -1; side <= 1; side += 2) {
    double x = a->cx + (along * dx - side * across * dr) / d;
    double r = a->cr + (along * dr + side * across * dx) / d;
    if (on_arc(a, atan2(r - a->cr, x - a->cx), 1e-9, &f[n]) &&
        on_arc(b, atan2(r - b->cr, x - b->cx), 1e-9, &g[n])) {
      n++;
    }
  }
  return n;
}

static size_t meet(const Piece *a, const Piece *b, double f[2], double g[2]) {
  if (!a->arc && !b->arc) {
    return line_line(a, b, f, g);
  }
  if (!a->arc) {
    return line_arc(a, b, f, g);
  }
  return b->arc ? arc_arc(a, b, f, g) : line_arc(b, a, g, f);
}

static double piece_length(const Piece *s) {
  return s->arc ? s->radius * fabs(s->sweep) : hypot(s->x1 - s->x0, s->r1 - s->r0);
}

// Whether two pieces touch other than where one goes over into the next.
static bool crosses(const SbProfile *p, size_t i, size_t j, double tiny) {
  Piece a, b;
  double f[2], g[2];
  size_t total = pieces_of(p);
  piece_at(&a, p, i);
  piece_at(&b, p, j);
  size_t n = meet(&a, &b, f, g);
  // Where pieces are tangent to each other their meeting is only known to the root of rounding.
  double la = piece_length(&a), lb = piece_length(&b), near = 1e3 * tiny;
  bool follows = j == i + 1, precedes = i == 0 && j + 1 == p->count && total == p->count;
  for (size_t k = 0; k < n; k++) {
    if (f[k] * la < -tiny || (f[k] - 1.0) * la > tiny || g[k] * lb < -tiny ||
        (g[k] - 1.0) * lb > tiny) {
      continue;
    }
    bool joint = follows && (1.0 - f[k]) * la <= near && g[k] * lb <= near;
    joint = joint || (precedes && f[k] * la <= near && (1.0 - g[k]) * lb <= near);
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

static void add_piece(Moments *m, const Piece *s, const double *node, const double *weight) {
  int panels = s->arc ? 1 + (int)(fabs(s->sweep) / 0.6) : 1;
  for (int panel = 0; panel < panels; panel++) {
    for (int i = 0; i < POINTS; i++) {
      double f = (panel + 0.5 + 0.5 * node[i]) / panels, x, r, dx;
      point_on(s, f, &x, &r);
      dx = s->arc ? -s->sweep * (r - s->cr) : s->x1 - s->x0;
      double w = -0.5 * weight[i] / panels * dx;
      m->area += w * r;
      m->volume += w * r * r / 2.0;
      m->first += w * r * r * x / 2.0;
      m->second += w * r * r * x * x / 2.0;
      m->third += w * r * r * r * r / 4.0;
    }
  }
}

static void moments_of(Moments *m, const SbProfile *p) {
  double node[POINTS], weight[POINTS];
  sb_legendre_gauss(node, weight, POINTS);
  *m = (Moments){0};
  size_t n = pieces_of(p);
  for (size_t i = 0; i < n; i++) {
    Piece s;
    piece_at(&s, p, i);
    add_piece(m, &s, node, weight);
  }
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
      return sb_fail(report, SB_ERROR_INPUT, "point %zu of the profile lies below the axis", i);
    }
    extent = fmax(extent, hypot(a->x - p->point[0].x, a->r - p->point[0].r));
  }
  bool by_axis = p->point[0].r == 0.0 && p->point[p->count - 1].r == 0.0;
  if (!by_axis && !p->closed) {
    return sb_fail(report, SB_ERROR_INPUT,
                   "the profile is open: it must close or start and end on the axis");
  }
  size_t n = pieces_of(p);
  double tiny = 1e-9 * extent;
  for (size_t i = 0; i < n; i++) {
    Piece s;
    piece_at(&s, p, i);
    if (hypot(s.x1 - s.x0, s.r1 - s.r0) <= tiny) {
      return sb_fail(report, SB_ERROR_INPUT, "piece %zu of the profile has no length", i);
    }
    double bottom;
    if (s.arc && s.cr - s.radius < -tiny && on_arc(&s, -0.5 * M_PI, 1e-9, &bottom)) {
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
  moments_of(&m, p);
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
  // About the profile's own middle, so that a part far from the origin keeps its digits.
  SbProfilePoint shifted[SB_PROFILE_MAX];
  SbProfile near = {shifted, p->count, p->closed};
  double low = INFINITY, high = -INFINITY;
  for (size_t i = 0; i < p->count; i++) {
    low = fmin(low, p->point[i].x);
    high = fmax(high, p->point[i].x);
  }
  for (size_t i = 0; i < p->count; i++) {
    shifted[i] = p->point[i];
    shifted[i].x -= 0.5 * (low + high);
  }
  Moments m;
  moments_of(&m, &near);
  *solid = (SbSolid){.volume = 2.0 * M_PI * m.volume};
  solid->mass = density * solid->volume;
  double at = m.first / m.volume;
  double axial = 2.0 * M_PI * density * m.third;
  double across = 0.5 * axial + 2.0 * M_PI * density * (m.second - at * m.first);
  solid->centre[0] = at + 0.5 * (low + high);
  solid->inertia[0][0] = axial;
  solid->inertia[1][1] = across;
  solid->inertia[2][2] = across;
  sb_solid_principal(solid);
  return sb_succeed(report);
}

// ---- diameters ----

// Least and largest radius of the outline at x; high -1 if there is none.
static void radii_at(const SbProfile *p, double x, double *low, double *high) {
  *low = INFINITY;
  *high = -1.0;
  size_t n = pieces_of(p);
  for (size_t i = 0; i < n; i++) {
    Piece s;
    piece_at(&s, p, i);
    if (!s.arc) {
      double left = fmin(s.x0, s.x1), right = fmax(s.x0, s.x1);
      if (x >= left && x <= right) {
        double f = right > left ? (x - s.x0) / (s.x1 - s.x0) : 0.0;
        double r = s.r0 + f * (s.r1 - s.r0), other = right > left ? r : s.r1;
        *low = fmin(*low, fmin(r, other));
        *high = fmax(*high, fmax(r, other));
      }
      continue;
    }
    double c = (x - s.cx) / s.radius, f;
    if (fabs(c) <= 1.0) {
      for (int side = -1; side <= 1; side += 2) {
        if (on_arc(&s, side * acos(c), 0.0, &f)) {
          double r = s.cr + side * s.radius * sqrt(1.0 - c * c);
          *low = fmin(*low, r);
          *high = fmax(*high, r);
        }
      }
    }
  }
  // Solid down to the axis, which the outline does not follow.
  bool by_axis = p->point[0].r == 0.0 && p->point[p->count - 1].r == 0.0;
  double a = p->point[0].x, b = p->point[p->count - 1].x;
  if (by_axis && x >= fmin(a, b) && x <= fmax(a, b)) {
    *low = 0.0;
  }
}

// What the stretch has: least and largest outer radius, least inner one.
typedef struct {
  double low, high, hole;
} Radii;

static void look_at(const SbProfile *p, double x, Radii *radii) {
  double low, high;
  radii_at(p, x, &low, &high);
  if (high >= 0.0) {
    radii->low = fmin(radii->low, high);
    radii->high = fmax(radii->high, high);
    radii->hole = fmin(radii->hole, low);
  }
}

static SbStatus look_along(Radii *radii, const SbProfile *p, double x0, double x1,
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
  *radii = (Radii){INFINITY, -1.0, INFINITY};
  double side = 1e-10 * (x1 - x0);
  size_t n = pieces_of(p);
  look_at(p, x0 + side, radii);
  look_at(p, x1 - side, radii);
  for (size_t i = 0; i < n; i++) {
    Piece s;
    piece_at(&s, p, i);
    double at[2] = {s.x0, s.arc ? s.cx : s.x0};
    for (int k = 0; k < 2; k++) {
      for (int way = -1; way <= 1; way += 2) {
        double x = at[k] + way * side;
        if (x > x0 && x < x1) {
          look_at(p, x, radii);
        }
      }
    }
  }
  if (radii->high < 0.0) {
    return sb_fail(report, SB_ERROR_RANGE, "the part does not reach %g .. %g m", x0, x1);
  }
  return sb_succeed(report);
}

SbStatus sb_profile_diameters(double *smallest, double *largest, const SbProfile *p, double x0,
                              double x1, SbReport *report) {
  Radii radii;
  SbStatus status = look_along(&radii, p, x0, x1, report);
  if (status == SB_OK) {
    *smallest = 2.0 * radii.low;
    *largest = 2.0 * radii.high;
  }
  return status;
}

SbStatus sb_profile_bore(double *diameter, const SbProfile *p, double x0, double x1,
                         SbReport *report) {
  Radii radii;
  SbStatus status = look_along(&radii, p, x0, x1, report);
  if (status == SB_OK) {
    *diameter = 2.0 * radii.hole;
  }
  return status;
}
