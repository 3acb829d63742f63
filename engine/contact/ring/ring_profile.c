// Outlines of named and drawn profiles.
//
// A profile is a polygon whose corners are rounded (rectangle, D, T, lip) or, of the x, eight
// tangent arcs: lobes of one radius in the corners of a square, hollows between them tangent to
// both. Of a drawn one, corners between straight sides are rounded. Geometry only; see the header.
#include "engine/contact/ring/ring_profile.h"
#include "engine/base/check.h"
#include "engine/numeric/arc.h"

#include <math.h>
#include <string.h>

enum { CORNERS_MAX = 12 };

// A joint that turns by less is smooth [rad]: pieces that approximate a curve.
static const double SMOOTH = 0.2;

typedef struct {
  double r, z, radius;
} Corner;

const char *sb_seal_profile_name(SbSealProfileKind kind) {
  static const char *const names[SB_SEAL_PROFILE_COUNT] = {"circle", "rectangle", "x",   "d",
                                                           "t",      "lip",       "file"};
  return (unsigned)kind < SB_SEAL_PROFILE_COUNT ? names[kind] : NULL;
}

// ---- parts

static void part_place(const SbRingOutlinePart *part, double share, double x[2]) {
  if (part->radius > 0.0) {
    double angle = part->angle + share * part->sweep;
    x[0] = part->centre[0] + part->radius * cos(angle);
    x[1] = part->centre[1] + part->radius * sin(angle);
    return;
  }
  for (int k = 0; k < 2; k++) {
    x[k] = part->from[k] + share * (part->to[k] - part->from[k]);
  }
}

// Sets the ends of an arc at both angles, and its length.
static void finish_arc(SbRingOutlinePart *part) {
  part_place(part, 0.0, part->from);
  part_place(part, 1.0, part->to);
  part->length = part->radius * fabs(part->sweep);
}

static void add_line(SbRingOutline *out, const double from[2], const double to[2]) {
  double length = hypot(to[0] - from[0], to[1] - from[1]);
  if (length > 1e-9) {
    out->part[out->count++] =
        (SbRingOutlinePart){.from = {from[0], from[1]}, .to = {to[0], to[1]}, .length = length};
  }
}

static void add_arc(SbRingOutline *out, double r, double z, double radius, double from,
                    double sweep) {
  SbRingOutlinePart *part = &out->part[out->count++];
  *part = (SbRingOutlinePart){.centre = {r, z}, .radius = radius, .angle = from, .sweep = sweep};
  finish_arc(part);
}

// A polygon's outline with its corners rounded; false where two roundings do not fit on a side.
static bool round_corners(SbRingOutline *out, const Corner *corner, int count) {
  double start[CORNERS_MAX][2], end[CORNERS_MAX][2], cut[CORNERS_MAX], turn[CORNERS_MAX];
  for (int i = 0; i < count; i++) {
    const Corner *a = &corner[(i + count - 1) % count], *b = &corner[i],
                 *c = &corner[(i + 1) % count];
    double u[2] = {b->r - a->r, b->z - a->z}, v[2] = {c->r - b->r, c->z - b->z};
    double lu = hypot(u[0], u[1]), lv = hypot(v[0], v[1]);
    turn[i] = atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]);
    cut[i] = b->radius * fabs(tan(0.5 * turn[i]));
    for (int k = 0; k < 2; k++) {
      double at = k == 0 ? b->r : b->z;
      start[i][k] = at - cut[i] * u[k] / lu;
      end[i][k] = at + cut[i] * v[k] / lv;
    }
  }
  for (int i = 0; i < count; i++) {
    const Corner *b = &corner[i], *c = &corner[(i + 1) % count];
    if (cut[i] + cut[(i + 1) % count] > hypot(c->r - b->r, c->z - b->z) * (1.0 + 1e-9)) {
      return false;
    }
    // The arc's centre is on the left of the direction for a left turn.
    const Corner *a = &corner[(i + count - 1) % count];
    double u[2] = {b->r - a->r, b->z - a->z}, l = hypot(u[0], u[1]);
    double side = turn[i] > 0.0 ? 1.0 : -1.0;
    double n[2] = {-side * u[1] / l, side * u[0] / l};
    add_arc(out, start[i][0] + b->radius * n[0], start[i][1] + b->radius * n[1], b->radius,
            atan2(-n[1], -n[0]), turn[i]);
    add_line(out, end[i], start[(i + 1) % count]);
  }
  return true;
}

// ---- drawn ones

// A piece of a drawn outline; radius > 0 of an arc.
static SbRingOutlinePart piece_of(const SbSealPoint *from, const SbSealPoint *to) {
  SbRingOutlinePart part = {.from = {from->r, from->z}, .to = {to->r, to->z}};
  part.length = hypot(to->r - from->r, to->z - from->z);
  if (fabs(from->bulge) > 1e-9) {
    const SbArc arc = sb_arc_of(part.from, part.to, from->bulge);
    part.radius = arc.radius;
    part.centre[0] = arc.centre[0];
    part.centre[1] = arc.centre[1];
    part.angle = arc.start;
    part.sweep = arc.sweep;
  }
  return part;
}

// Direction at a piece's beginning or end [rad].
static double heading(const SbRingOutlinePart *part, bool at_end) {
  if (part->radius > 0.0) {
    return part->angle + (at_end ? part->sweep : 0.0) + copysign(0.5 * M_PI, part->sweep);
  }
  return atan2(part->to[1] - part->from[1], part->to[0] - part->from[0]);
}

// A drawn outline; its corners between straight sides rounded. A corner at an arc must be smooth.
static SbStatus drawn(SbRingOutline *out, const SbSealDrawing *on, double radius,
                      SbReport *report) {
  double turn[SB_SEAL_POINTS_MAX], cut[SB_SEAL_POINTS_MAX];
  const int n = on->count;
  for (int i = 0; i < n; i++) {
    const SbRingOutlinePart before = piece_of(&on->point[(i + n - 1) % n], &on->point[i]);
    const SbRingOutlinePart after = piece_of(&on->point[i], &on->point[(i + 1) % n]);
    turn[i] = remainder(heading(&after, false) - heading(&before, true), 2.0 * M_PI);
    cut[i] = 0.0;
    if (fabs(turn[i]) > SMOOTH && (before.radius > 0.0 || after.radius > 0.0)) {
      return sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_DRAWING,
                           "point %d is a sharp corner of %.0f degrees at an arc: end the arc "
                           "along its neighbour",
                           i + 1, fabs(turn[i]) * 180.0 / M_PI);
    }
    if (fabs(turn[i]) > SMOOTH) {
      cut[i] = radius * fabs(tan(0.5 * turn[i]));
    }
  }
  for (int i = 0; i < n; i++) {
    const SbRingOutlinePart before = piece_of(&on->point[(i + n - 1) % n], &on->point[i]);
    SbRingOutlinePart piece = piece_of(&on->point[i], &on->point[(i + 1) % n]);
    const double ends[2] = {cut[i], cut[(i + 1) % n]};
    if (ends[0] + ends[1] > piece.length * (1.0 + 1e-9)) {
      return sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_CORNER_RADIUS,
                           "the side from point %d of the drawn section is too short for "
                           "corners rounded by %.3g of its height",
                           i + 1, radius);
    }
    if (cut[i] > 0.0) {
      const double u = heading(&before, true), side = copysign(1.0, turn[i]);
      const double start[2] = {on->point[i].r - cut[i] * cos(u), on->point[i].z - cut[i] * sin(u)};
      const double normal = u + side * 0.5 * M_PI;
      add_arc(out, start[0] + radius * cos(normal), start[1] + radius * sin(normal), radius,
              normal + M_PI, turn[i]);
    }
    if (piece.radius > 0.0) {
      add_arc(out, piece.centre[0], piece.centre[1], piece.radius, piece.angle, piece.sweep);
      continue;
    }
    double end[2][2];
    for (int k = 0; k < 2; k++) {
      end[0][k] = piece.from[k] + ends[0] / piece.length * (piece.to[k] - piece.from[k]);
      end[1][k] = piece.to[k] - ends[1] / piece.length * (piece.to[k] - piece.from[k]);
    }
    add_line(out, end[0], end[1]);
  }
  return SB_OK;
}

// ---- the whole

// Where a part crosses z = 0 first, as a share of it; false if it does not. It crosses where it
// ends there, not where it begins.
static bool crosses(const SbRingOutlinePart *part, double *share) {
  enum { PIECES = 64 };
  static const double ROUNDING = 1e-9;
  double before[2], x[2];
  part_place(part, 0.0, before);
  if (fabs(before[1]) < ROUNDING) {
    part_place(part, 1.0 / PIECES, before);
  }
  for (int i = 1; i <= PIECES; i++) {
    part_place(part, (double)i / PIECES, x);
    if (i == PIECES && fabs(x[1]) < ROUNDING) {
      *share = 1.0;
      return true;
    }
    if ((before[1] <= 0.0) != (x[1] <= 0.0)) {
      double from = (double)(i - 1) / PIECES, to = (double)i / PIECES;
      for (int k = 0; k < 60; k++) {
        double middle = 0.5 * (from + to);
        part_place(part, middle, x);
        if ((x[1] <= 0.0) == (before[1] <= 0.0)) {
          from = middle;
        } else {
          to = middle;
        }
      }
      *share = 0.5 * (from + to);
      return true;
    }
    memcpy(before, x, sizeof before);
  }
  return false;
}

// Rotates the outline's order so that it begins where it crosses z = 0 at the smallest radius, and
// finds its sizes.
static void order(SbRingOutline *out) {
  SbRingOutline old = *out;
  int first = 0;
  double share = 0.0, cut = 0.0, least = HUGE_VAL, x[2];
  for (int i = 0; i < old.count; i++) {
    if (crosses(&old.part[i], &share)) {
      part_place(&old.part[i], share, x);
      if (x[0] < least) {
        least = x[0];
        first = i;
        cut = share;
      }
    }
  }
  out->count = 0;
  for (int i = 0; i <= old.count; i++) {
    SbRingOutlinePart part = old.part[(first + i) % old.count];
    double from = i == 0 ? cut : 0.0, to = i == old.count ? cut : 1.0;
    double a[2], b[2];
    part_place(&part, from, a);
    part_place(&part, to, b);
    if (part.radius > 0.0 && part.length * (to - from) > 1e-9) {
      add_arc(out, part.centre[0], part.centre[1], part.radius, part.angle + from * part.sweep,
              (to - from) * part.sweep);
    } else if (part.radius <= 0.0) {
      add_line(out, a, b);
    }
  }
  double moment = 0.0, most = -HUGE_VAL;
  out->area = out->length = out->half = 0.0;
  for (int i = 0; i < out->count; i++) {
    SbRingOutlinePart *part = &out->part[i];
    part->at = out->length;
    out->length += part->length;
    if (crosses(part, &share)) {
      part_place(part, share, x);
      if (x[0] > most) {
        most = x[0];
        out->bore = part->at + share * part->length;
      }
    }
    // Integrals over the area by those of -z dr and -r z dr along the outline.
    enum { PIECES = 256 };
    double before[2];
    part_place(part, 0.0, before);
    for (int k = 1; k <= PIECES; k++) {
      part_place(part, (double)k / PIECES, x);
      double cross = before[0] * x[1] - before[1] * x[0];
      out->area += 0.5 * cross;
      moment += cross * (before[0] + x[0]) / 6.0;
      out->half = fmax(out->half, fabs(x[1]));
      memcpy(before, x, sizeof before);
    }
  }
  out->centroid = moment / out->area;
}

void sb_ring_outline_place(const SbRingOutline *outline, double arc, double x[2]) {
  arc -= outline->length * floor(arc / outline->length);
  int i = 0;
  while (i < outline->count - 1 && arc > outline->part[i].at + outline->part[i].length) {
    i++;
  }
  const SbRingOutlinePart *part = &outline->part[i];
  part_place(part, fmin(1.0, (arc - part->at) / part->length), x);
}

double sb_ring_outline_angle(const SbRingOutline *outline, double arc) {
  double turns = floor(arc / outline->length), at = arc - turns * outline->length;
  double half = at < outline->bore ? at / outline->bore - 1.0
                                   : (at - outline->bore) / (outline->length - outline->bore);
  return M_PI * half + 2.0 * M_PI * turns;
}

double sb_ring_outline_arc(const SbRingOutline *outline, double angle) {
  double turns = floor((angle + M_PI) / (2.0 * M_PI)), half = angle / M_PI - 2.0 * turns;
  double at = half < 0.0 ? (1.0 + half) * outline->bore
                         : outline->bore + half * (outline->length - outline->bore);
  return at + turns * outline->length;
}

// ---- the profiles

static int rectangle(Corner *c, double w, double radius) {
  const Corner all[] = {{-0.5, w, radius}, {-0.5, -w, radius}, {0.5, -w, radius}, {0.5, w, radius}};
  memcpy(c, all, sizeof all);
  return 4;
}

// Flat on the floor, round to the bore: a half circle as wide as the section.
static int d_ring(Corner *c, double w, double radius) {
  const Corner all[] = {{-0.5, w, radius}, {-0.5, -w, radius}, {0.5, -w, w}, {0.5, w, w}};
  memcpy(c, all, sizeof all);
  return 4;
}

static int t_ring(Corner *c, double w, double web, double flange, double radius) {
  const double f = flange - 0.5;
  const Corner all[] = {{-0.5, w, radius}, {-0.5, -w, radius},  {f, -w, radius},
                        {f, -web, radius}, {0.5, -web, radius}, {0.5, web, radius},
                        {f, web, radius},  {f, w, radius}};
  memcpy(c, all, sizeof all);
  return 8;
}

// A heel to the right, two lips flared outwards to the left, and a hollow between them. The tips'
// corners are `beyond` the height that remains after rounding.
static int lip_ring(Corner *c, double w, const SbSealProfile *p, double h, double beyond) {
  const double radius = p->corner_radius / h, thickness = p->lip_thickness / h;
  const double heel = 0.5 - p->lip_flare / h, bottom = p->lip_depth / h - w, tip = 0.5 + beyond;
  const double wide = 0.5 - thickness, floor = fmin(wide, heel - thickness);
  const Corner all[] = {{-heel, w, radius},           {-heel, bottom, 2.0 * radius},
                        {-tip, -w, radius},           {-wide, -w, radius},
                        {-floor, bottom, radius},     {floor, bottom, radius},
                        {wide, -w, radius},           {tip, -w, radius},
                        {heel, bottom, 2.0 * radius}, {heel, w, radius}};
  memcpy(c, all, sizeof all);
  return 10;
}

// Returns how far a tip's corner must project so that its rounding reaches the height. Half the
// angle between its sides determines how much the rounding removes; it hardly depends on the
// corner's position.
static double tip_beyond(const SbSealProfile *p, double h) {
  enum { PASSES = 20 };
  const double radius = p->corner_radius / h, along = p->lip_depth / h;
  double beyond = 0.0;
  for (int i = 0; i < PASSES; i++) {
    // The flank is inclined by this angle from the axis; the centre of the rounding is one radius
    // inside both sides.
    const double lean = atan2(p->lip_flare / h + beyond, along);
    const double centre = 0.5 + beyond - radius * (tan(lean) + 1.0 / cos(lean));
    beyond += 0.5 - (centre + radius);
  }
  return beyond;
}

// Lobes tangent to the square, hollows tangent to the lobes: the distance of their centres is rl +
// rv.
static void x_ring(SbRingOutline *out, double lobe, double valley) {
  const double l = 0.5 - lobe, apart = (valley * valley + l * l) / (2.0 * valley);
  const double hollow = apart - lobe, centre = 0.5 - valley + hollow;
  const double tilt = atan2(l, centre - l); // of the line from a lobe's centre to a hollow's
  for (int k = 0; k < 4; k++) {
    // The hollow at the angle k pi/2 from the lobe before to the one after it.
    const double turn = 0.5 * M_PI * k, c = cos(turn), s = sin(turn);
    add_arc(out, c * centre, s * centre, hollow, turn + M_PI + tilt, -2.0 * tilt);
    add_arc(out, c * l - s * l, s * l + c * l, lobe, turn - tilt, 0.5 * M_PI + 2.0 * tilt);
  }
}

// Sizes, in section heights, that each kind needs.
static SbStatus check(const SbSealProfile *p, double h, SbReport *report) {
  const bool wide = p->kind != SB_SEAL_PROFILE_X && p->kind != SB_SEAL_PROFILE_FILE;
  SbStatus status =
      SB_CHECK(report,
               {SB_CONTACT_IN_AXIAL_HEIGHT, "the section's axial height over its radial one",
                wide ? p->axial_height / h : 1.0, 0.2, 5.0},
               {SB_CONTACT_IN_CORNER_RADIUS, "the corners' radius over the section's radial height",
                p->corner_radius / h, 0.005, 0.5});
  if (status == SB_OK && p->kind == SB_SEAL_PROFILE_X) {
    const double lobe = p->corner_radius / h;
    status =
        SB_CHECK(report,
                 {SB_CONTACT_IN_CORNER_RADIUS, "the lobes' radius over the section's radial height",
                  lobe, 0.05, 0.3},
                 {SB_CONTACT_IN_VALLEY_DEPTH, "the hollows' depth over the section's radial height",
                  p->valley_depth / h, 0.02, 0.25});
  }
  if (status == SB_OK && p->kind == SB_SEAL_PROFILE_T) {
    status =
        SB_CHECK(report,
                 {SB_CONTACT_IN_WEB_WIDTH, "the web's width over the section's axial height",
                  p->web_width / p->axial_height, 0.15, 0.95},
                 {SB_CONTACT_IN_FLANGE_HEIGHT, "the flange's height over the section's radial one",
                  p->flange_height / h, 0.15, 0.85});
  }
  if (status == SB_OK && p->kind == SB_SEAL_PROFILE_LIP) {
    status = SB_CHECK(
        report,
        {SB_CONTACT_IN_LIP_THICKNESS, "the lips' thickness over the section's radial height",
         p->lip_thickness / h, 0.08, 0.4},
        {SB_CONTACT_IN_LIP_DEPTH, "the hollow's depth over the section's axial height",
         p->lip_depth / p->axial_height, 0.1, 0.8},
        {SB_CONTACT_IN_LIP_FLARE, "the lips' reach over the section's radial height",
         p->lip_flare / h, 0.0, 0.25});
  }
  return status;
}

// Outline of a profile with corners; false where its roundings do not fit.
static bool rounded(SbRingOutline *out, const SbSealProfile *p, double h) {
  Corner corner[CORNERS_MAX];
  const double w = 0.5 * p->axial_height / h, radius = p->corner_radius / h;
  const int count = p->kind == SB_SEAL_PROFILE_D ? d_ring(corner, w, radius)
                    : p->kind == SB_SEAL_PROFILE_T
                        ? t_ring(corner, w, 0.5 * p->web_width / h, p->flange_height / h, radius)
                    : p->kind == SB_SEAL_PROFILE_LIP ? lip_ring(corner, w, p, h, tip_beyond(p, h))
                                                     : rectangle(corner, w, radius);
  return round_corners(out, corner, count);
}

// Largest corner radius below the profile's own, which does not fit, that fits [m]; 0: none does.
static double largest_radius(const SbSealProfile *p, double h) {
  enum { HALVINGS = 30 };
  double low = 0.0, high = p->corner_radius;
  for (int i = 0; i < HALVINGS; i++) {
    SbSealProfile trial = *p;
    SbRingOutline ignored = {0};
    trial.corner_radius = 0.5 * (low + high);
    *(rounded(&ignored, &trial, h) ? &low : &high) = trial.corner_radius;
  }
  return low;
}

SbStatus sb_ring_outline_of_profile(SbRingOutline *out, const SbSealProfile *p, double h,
                                    SbReport *report) {
  *out = (SbRingOutline){0};
  if (p->kind == SB_SEAL_PROFILE_CIRCLE) {
    // Needed at every fit: known without order().
    add_arc(out, 0.0, 0.0, 0.5, M_PI, M_PI);
    add_arc(out, 0.0, 0.0, 0.5, 0.0, M_PI);
    out->part[1].at = out->bore = 0.5 * M_PI;
    out->length = M_PI;
    out->area = 0.25 * M_PI;
    out->half = 0.5;
    return sb_succeed(report);
  }
  if (p->kind == SB_SEAL_PROFILE_FILE && p->drawn.count == 0) {
    return sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_DRAWING,
                         "a drawn section needs its drawing");
  }
  SbStatus status = check(p, h, report);
  if (status == SB_OK && p->kind == SB_SEAL_PROFILE_FILE) {
    status = drawn(out, &p->drawn, p->corner_radius / h, report);
    if (status == SB_OK) {
      order(out);
      status = sb_succeed(report);
    }
    return status;
  }
  if (status != SB_OK) {
    return status;
  }
  if (p->kind == SB_SEAL_PROFILE_X) {
    const double valley = p->valley_depth / h, lobe = p->corner_radius / h;
    if (valley * valley + (0.5 - lobe) * (0.5 - lobe) <= 2.1 * lobe * valley) {
      return sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_VALLEY_DEPTH,
                           "hollows %.3g mm deep do not fit between lobes of %.3g mm radius",
                           1e3 * p->valley_depth, 1e3 * p->corner_radius);
    }
    x_ring(out, lobe, valley);
  } else if (!rounded(out, p, h)) {
    return sb_fail_input(
        report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_CORNER_RADIUS,
        "corners of %.3g mm radius do not fit the %s profile; its sizes allow at most %.3g mm",
        1e3 * p->corner_radius, sb_seal_profile_name(p->kind), 1e3 * largest_radius(p, h));
  }
  order(out);
  return sb_succeed(report);
}

void sb_seal_profile_area(double *area, double *centroid, const SbSealProfile *profile,
                          double height) {
  SbRingOutline outline;
  *area = 0.25 * M_PI;
  *centroid = 0.0;
  if (profile->kind != SB_SEAL_PROFILE_CIRCLE &&
      sb_ring_outline_of_profile(&outline, profile, height, NULL) == SB_OK) {
    *area = outline.area;
    *centroid = outline.centroid;
  }
}

bool sb_ring_outline_has_sides(const SbRingOutline *outline) {
  enum { PLACES = 128 };
  for (int i = 1; i < PLACES; i++) {
    const double angle = M_PI * i / PLACES;
    double left[2], right[2];
    sb_ring_outline_place(outline, sb_ring_outline_arc(outline, -angle), left);
    sb_ring_outline_place(outline, sb_ring_outline_arc(outline, angle), right);
    if (hypot(left[0] - right[0], left[1] + right[1]) > 1e-6) {
      return true;
    }
  }
  return false;
}
