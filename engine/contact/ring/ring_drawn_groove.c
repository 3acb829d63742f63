// Drawn grooves: an outline divided into floor and walls, each a line with bends; see the header.
//
// One side is processed at a time, from the floor's lowest point to the right edge; the left side
// in the mirrored outline. Lines continue straight beyond their ends, into the stem, so a concave
// corner needs no more points. If floor and wall met with one normal, a point would be in contact
// with both.
#include "engine/contact/ring/ring_drawn_groove.h"
#include "engine/numeric/arc.h"

#include <math.h>
#include <stdlib.h>

// Directions [rad]: of the chords of arcs; largest one of the floor, and of a wall's inclination;
// smallest angle between a wall and the floor's last piece.
static const double CHORD = 7.5 * M_PI / 180, APART = 12 * M_PI / 180;
static const double STEEP = 70 * M_PI / 180 + 1e-9, LEAN = M_PI / 3 + 1e-9;

// Largest deviation of the surfaces from a point, divided by the smaller of width and depth.
static const double MISSED = 0.02;

enum { POINTS = 512 };

typedef struct {
  double z, r;
  bool round; // inside an arc
} Point;

typedef struct {
  Point at[POINTS];
  int count;
} Row;

double sb_groove_ramp(double x, double length, double *slope, double *curvature) {
  if (x <= 0.0) {
    *slope = *curvature = 0.0;
    return 0.0;
  }
  if (x < length) {
    double t = x / length;
    *slope = t * t * (3.0 - 2.0 * t);
    *curvature = 6.0 * t * (1.0 - t) / length;
    return length * t * t * t * (1.0 - 0.5 * t);
  }
  *slope = 1.0;
  *curvature = 0.0;
  return x - 0.5 * length;
}

double sb_groove_line(const SbGrooveLine *line, double at, double *slope, double *curvature) {
  double value = line->offset + (line->slope != 0.0 ? line->slope * at : 0.0);
  *slope = line->slope;
  *curvature = 0.0;
  for (int i = 0; i < line->count; i++) {
    const SbGrooveBend *bend = &line->bend[i];
    double s, c;
    value += bend->turn * sb_groove_ramp(at - bend->at + 0.5 * bend->length, bend->length, &s, &c);
    *slope += bend->turn * s;
    *curvature += bend->turn * c;
  }
  return value;
}

// But for a point that is the last one.
static bool add(Row *row, double z, double r, bool round) {
  if (row->count > 0 && row->at[row->count - 1].z == z && row->at[row->count - 1].r == r) {
    return true;
  }
  if (row->count == POINTS) {
    return false;
  }
  row->at[row->count++] = (Point){z, r, round};
  return true;
}

// The greatest bulge: an arc that is a circle but for 0.2 degrees.
static const double BULGE_MOST = 1e3;

// Divides the arcs. The last point's bulge bends nothing.
static bool divide(Row *row, const SbSealPoint *points, int count) {
  row->count = 0;
  for (int i = 0; i < count; i++) {
    const SbSealPoint *p = &points[i], *q = &points[i + 1];
    if (!add(row, p->z, p->r, false)) {
      return false;
    }
    if (i + 1 == count || p->bulge == 0.0) {
      continue;
    }
    const SbArc arc = sb_arc_of((double[]){p->z, p->r}, (double[]){q->z, q->r}, p->bulge);
    const int parts = (int)ceil(fabs(arc.sweep) / CHORD);
    for (int k = 1; k < parts; k++) {
      double x[2];
      sb_arc_place(&arc, (double)k / parts, x);
      if (!add(row, x[0], x[1], true)) {
        return false;
      }
    }
  }
  return true;
}

static void turn_round(Row *row) {
  for (int i = 0; i < row->count / 2; i++) {
    const Point other = row->at[i];
    row->at[i] = row->at[row->count - 1 - i];
    row->at[row->count - 1 - i] = other;
  }
}

static void mirror(Row *row) {
  turn_round(row);
  for (int i = 0; i < row->count; i++) {
    row->at[i].z = -row->at[i].z;
  }
}

// Direction of a row's piece from the axis, 0 towards the right, a quarter turn outwards.
static double direction(const Row *row, int piece) {
  const Point *p = &row->at[piece], *q = &row->at[piece + 1];
  return atan2(q->r - p->r, q->z - p->z);
}

// Bends a line at a point of a row between two slopes. The lengths are those of the adjacent
// pieces, infinite if there is none.
static bool bend(SbGrooveLine *line, double at, double turn, bool round, double before,
                 double after, double rounding) {
  if (fabs(turn) < 1e-12) {
    return true;
  }
  if (line->count == SB_GROOVE_BENDS_MAX) {
    return false;
  }
  const double shorter = fmin(before, after);
  const double length = round ? 0.5 * (fmin(before, after) + after) : fmin(rounding, shorter);
  line->bend[line->count++] = (SbGrooveBend){at, turn, length};
  return true;
}

static SbStatus fail(SbReport *report, const Point *at, const char *what) {
  return sb_fail(report, SB_ERROR_INPUT, "the groove %s at %.4g, %.4g mm (axial, radial)", what,
                 1e3 * at->z, 1e3 * at->r);
}

// Behind the wall, which leans by less than it, the floor rises no more.
static bool end_floor(SbGrooveLine *floor, const Point *last, double rise, const Point *foot,
                      double lean, double rounding) {
  if (!(rise > 0.0)) {
    return true;
  }
  const double met = (foot->z + lean * (last->r - rise * last->z - foot->r)) / (1.0 - lean * rise);
  if (floor->count == SB_GROOVE_BENDS_MAX || !isfinite(met)) {
    return false;
  }
  floor->bend[floor->count++] = (SbGrooveBend){met + rounding, -rise, rounding};
  return true;
}

// Returns the first point of the wall behind point i, where the floor ends with this slope: not on
// the corner's arc, nor on its remainder if an equally steep piece follows.
static int wall_begin(const Row *row, int i, double slope) {
  const double steep = fmax(STEEP, atan(slope) + APART);
  while (i + 1 < row->count && direction(row, i) < steep && direction(row, i) > 0.0) {
    i++;
  }
  int straight = i;
  while (straight + 1 < row->count && row->at[straight].round) {
    straight++;
  }
  const bool goes_on = straight + 1 < row->count && straight > 0 &&
                       direction(row, straight) > direction(row, straight - 1) - CHORD;
  return goes_on ? straight : i;
}

// Returns the last point of the wall that begins at point i; i if there is no wall.
static int wall_end(const Row *row, int i) {
  int end = row->count - 1;
  while (end > i && fabs(direction(row, end - 1) - M_PI / 2) > LEAN) {
    end--;
  }
  return end;
}

// Processes the right side of a row that rises from `lowest` on. *nearest: point at which its wall
// is nearest; *top: its end point.
static SbStatus side(SbGrooveLine *floor, SbGrooveLine *wall, double *nearest, int *top,
                     const Row *row, int lowest, SbReport *report) {
  const double base = row->at[lowest].r;
  const double rounding = SB_GROOVE_ROUNDING * (row->at[row->count - 1].r - base);
  double slope = 0.0, before = INFINITY;
  int i = lowest;
  for (; i + 1 < row->count && fabs(direction(row, i)) <= STEEP; i++) {
    const Point *p = &row->at[i], *q = &row->at[i + 1];
    const double next = (q->r - p->r) / (q->z - p->z);
    if (!bend(floor, p->z, next - slope, p->round, before, q->z - p->z, rounding)) {
      return fail(report, p, "has too many bends in its floor");
    }
    slope = next;
    before = q->z - p->z;
  }
  const Point last = row->at[i];
  const double rise = slope;
  i = wall_begin(row, i, slope);
  const int end = wall_end(row, i);
  if (end <= i) {
    return fail(report, &row->at[row->count - 1], "has no wall steeper than 70 degrees that ends");
  }
  *nearest = INFINITY;
  for (int k = i; k < end; k++) {
    const Point *p = &row->at[k], *q = &row->at[k + 1];
    if (fabs(direction(row, k) - M_PI / 2) > LEAN) {
      return fail(report, p, "has a wall that leans by more than 60 degrees");
    }
    const double next = (q->z - p->z) / (q->r - p->r);
    if (k == i) {
      if (!end_floor(floor, &last, rise, p, next, rounding)) {
        return fail(report, p, "has no corner between floor and wall");
      }
      wall->slope = next;
      wall->offset = p->z - next * (p->r - base);
    } else if (!bend(wall, p->r - base, next - slope, p->round, before, q->r - p->r, rounding)) {
      return fail(report, p, "has too many bends in its wall");
    }
    slope = next;
    before = q->r - p->r;
    *nearest = fmin(*nearest, fmin(p->z, q->z));
  }
  *top = end;
  wall->offset -= *nearest;
  for (int k = 0; k < floor->count; k++) {
    floor->bend[k].at -= *nearest;
  }
  return SB_OK;
}

// Returns the distance of a point (z, r) from the nearest surface, > 0 in the ring's room. The
// floor is at `base`, the walls are where the drawing has them.
static double off(const SbGrooveDrawing *groove, const double wall[2], double base,
                  const Point *p) {
  double least = INFINITY, rise = base - p->r, s[2] = {0.0}, slope, curvature;
  for (int k = 0; k < 2; k++) {
    const double way = k == 1 ? 1.0 : -1.0;
    const double recess = sb_groove_line(&groove->wall[k], p->r - base, &slope, &curvature);
    const double gap = way * (wall[k] - p->z) + recess;
    least = fmin(least, gap / sqrt(1.0 + slope * slope));
    rise += sb_groove_line(&groove->floor[k], way * (p->z - wall[k]), &s[k], &curvature);
  }
  return fmin(least, -rise / sqrt(1.0 + (s[1] - s[0]) * (s[1] - s[0])));
}

static int lowest_of(const Row *row) {
  int lowest = 0;
  for (int i = 1; i < row->count; i++) {
    lowest = row->at[i].r < row->at[lowest].r ? i : lowest;
  }
  return lowest;
}

// Floors and walls of a divided outline, which is turned round and back.
static SbStatus draw_row(SbGrooveDrawing *out, Row *row, SbReport *report) {
  if (row->at[0].z > row->at[row->count - 1].z) {
    turn_round(row);
  }
  // A joint of an arc and a line belongs to both; the flag of a joint belongs to its point.
  const int lowest = lowest_of(row);
  double wall[2];
  int top[2] = {0, 0};
  SbStatus status = side(&out->floor[1], &out->wall[1], &wall[1], &top[1], row, lowest, report);
  if (status == SB_OK) {
    mirror(row);
    status = side(&out->floor[0], &out->wall[0], &wall[0], &top[0], row, row->count - 1 - lowest,
                  report);
    mirror(row);
    wall[0] = -wall[0];
    top[0] = row->count - 1 - top[0];
  }
  if (status != SB_OK) {
    return status;
  }
  const double base = row->at[lowest].r;
  out->width = wall[1] - wall[0];
  out->depth = fmin(row->at[0].r, row->at[row->count - 1].r) - base;
  if (!(out->width > 0.0) || !(out->depth > 0.0)) {
    return fail(report, &row->at[lowest], "has no room above its floor");
  }
  // At its points and between them.
  for (int i = 2 * top[0]; i <= 2 * top[1]; i++) {
    const Point *a = &row->at[i / 2], *b = &row->at[(i + 1) / 2];
    const Point p = {0.5 * (a->z + b->z), 0.5 * (a->r + b->r), false};
    const double missed = off(out, wall, base, &p);
    if (!(fabs(missed) <= MISSED * fmin(out->width, out->depth))) {
      return fail(report, &p, "has no floor and walls that follow its outline");
    }
  }
  return SB_OK;
}

SbStatus sb_groove_draw(SbGrooveDrawing *out, const SbSealPoint *points, int count,
                        SbReport *report) {
  *out = (SbGrooveDrawing){0};
  for (int i = 0; i < count; i++) {
    const SbSealPoint *p = &points[i];
    if (!isfinite(p->z) || !isfinite(p->r) || !(fabs(p->bulge) < BULGE_MOST)) {
      return fail(report, &(Point){p->z, p->r, false}, "has a point or an arc that is none");
    }
  }
  Row *row = malloc(sizeof *row);
  if (row == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a groove's outline");
  }
  if (count < 3 || !divide(row, points, count)) {
    free(row);
    return sb_fail(report, SB_ERROR_INPUT,
                   "the groove has %d points: at least 3, and no more than %d of its arcs' chords",
                   count, POINTS);
  }
  SbStatus status = draw_row(out, row, report);
  out->count = status == SB_OK ? count : 0;
  free(row);
  return status;
}

int sb_groove_outline(double out[SB_GROOVE_POINTS][2], const SbGrooveDrawing *groove, double width,
                      double height) {
  enum { HALF = SB_GROOVE_POINTS / 2, WALL = HALF / 2 };
  double s, c;
  for (int k = 0; k < 2; k++) {
    // From the edge down to where the floor is met, by bisection, then along the floor.
    const SbGrooveLine *wall = &groove->wall[k], *floor = &groove->floor[k];
    double low = 0.0, high = height;
    for (int i = 0; i < 50; i++) {
      const double r = 0.5 * (low + high);
      const double under = sb_groove_line(floor, sb_groove_line(wall, r, &s, &c), &s, &c) > r;
      *(under ? &low : &high) = r;
    }
    const double reach = 0.5 * width + sb_groove_line(wall, high, &s, &c);
    for (int i = 0; i < HALF; i++) {
      double x[2];
      if (i < WALL) {
        x[1] = height + (high - height) * i / (WALL - 1);
        x[0] = 0.5 * width + sb_groove_line(wall, x[1], &s, &c);
      } else {
        x[0] = reach * (HALF - 1 - i) / (HALF - WALL);
        x[1] = sb_groove_line(floor, x[0] - 0.5 * width, &s, &c) +
               sb_groove_line(&groove->floor[1 - k], -x[0] - 0.5 * width, &s, &c);
      }
      double *const to = out[k == 1 ? i : SB_GROOVE_POINTS - 1 - i];
      to[0] = k == 1 ? x[0] : -x[0];
      to[1] = x[1];
    }
  }
  return SB_GROOVE_POINTS;
}

double sb_groove_drawn_area(const SbGrooveDrawing *groove, double width, double height) {
  double at[SB_GROOVE_POINTS][2], twice = 0.0;
  const double drawn = fmin(height, groove->depth);
  const int count = sb_groove_outline(at, groove, width, drawn);
  for (int i = 0; i < count; i++) {
    const double *p = at[i], *q = at[(i + 1) % count];
    twice += p[0] * q[1] - q[0] * p[1];
  }
  return 0.5 * fabs(twice) + (height - drawn) * (at[0][0] - at[count - 1][0]);
}
