// The groove's rigid surfaces: floor, both walls, and the bore with its land and chamfers.
//
// Each surface gives gap, normal, tangent and curvature at a position. Other functions work on a
// load, which contains the positions of the surfaces. Beyond an end of the land the bore opens with
// the chamfer's slope, which develops smoothly over the edge's rounding; so do the chamfers of the
// walls' edges. Walls are inclined by their draft from where they meet the floor. A rounded corner
// belongs to the floor: its arc up to 60 degrees, then the straight line to the wall, which is
// within 3.6 % of the radius from the remainder of the arc. With a separate arc for a wall,
// positions would be in contact with two surfaces of one normal. Next to a wall with draft it is
// the corner of a wall without draft. The surfaces are rigid.
#include "engine/contact/ring/ring_contact.h"
#include "engine/contact/ring/ring_drawn_groove.h"

#include <math.h>
#include <stddef.h>

// The slope to which a rounded corner rises from the floor, tan 60 degrees, and where, in radii.
static const double CORNER_SLOPE = 1.7320508075688772, CORNER_END = 0.8660254037844386;

// Height of a circle over its tangent; from 60 degrees on the straight line there.
static double bend(double x, double radius, double *slope, double *curvature) {
  *slope = *curvature = 0.0;
  if (x <= 0.0) {
    return 0.0;
  }
  const double end = CORNER_END * radius;
  if (x < end) {
    const double down = sqrt(radius * radius - x * x);
    *slope = x / down;
    *curvature = radius * radius / (down * down * down);
    return radius - down;
  }
  *slope = CORNER_SLOPE;
  return 0.5 * radius + CORNER_SLOPE * (x - end);
}

// A line of a drawn groove at a place, in the load's unit of length.
static double drawn(const SbRingLoad *load, const SbGrooveLine *line, double at, double *slope,
                    double *curvature) {
  const double height = sb_groove_line(line, at / load->groove_unit, slope, curvature);
  *slope *= load->groove_share;
  *curvature *= load->groove_share / load->groove_unit;
  return load->groove_share * load->groove_unit * height;
}

// A wall's place over the radius, from that at the floor, > 0 into the wall; 1 is the right one.
static double wall_recess(const SbRingLoad *load, int wall, double r, double *slope,
                          double *curvature) {
  double recess = 0.0, s, c;
  if (load->groove != NULL) {
    const SbGrooveLine *line = &load->groove->wall[wall];
    return drawn(load, line, r - load->floor_radius, slope, curvature);
  }
  *slope = *curvature = 0.0;
  if (load->wall_draft != 0.0) {
    *slope = tan(load->wall_draft);
    recess = *slope * (r - load->floor_radius);
  }
  if (load->wall_chamfer > 0.0) {
    const double rounded = load->wall_chamfer;
    recess +=
        sb_groove_ramp(r - (load->wall_top - load->wall_chamfer - 0.5 * rounded), rounded, &s, &c);
    *slope += s;
    *curvature += c;
  }
  return recess;
}

// Returns the height of the floor's rounded corners, or of its drawn shape, above the floor.
static double floor_rise(const SbRingLoad *load, double z, double *slope, double *curvature) {
  *slope = *curvature = 0.0;
  if (load->groove != NULL) {
    double s[2], c[2];
    const SbGrooveLine *line = load->groove->floor;
    const double rise = drawn(load, &line[1], z - load->wall_right, &s[1], &c[1]) +
                        drawn(load, &line[0], load->wall_left - z, &s[0], &c[0]);
    *slope = s[1] - s[0];
    *curvature = c[1] + c[0];
    return rise;
  }
  if (!(load->floor_corner > 0.0)) {
    return 0.0;
  }
  double s1, c1, s2, c2;
  const double radius = load->floor_corner;
  const double rise = bend(z - (load->wall_right - radius), radius, &s1, &c1) +
                      bend(load->wall_left + radius - z, radius, &s2, &c2);
  *slope = s1 - s2;
  *curvature = c1 + c2;
  return rise;
}

SbRingFrame sb_ring_frame(const SbRingLoad *load, SbRingSurface surface, const double x[2]) {
  if (surface == SB_RING_FLOOR) {
    double slope, curvature;
    const double gap = x[0] - load->floor_radius - floor_rise(load, x[1], &slope, &curvature);
    const double length = sqrt(1.0 + slope * slope);
    return (SbRingFrame){.n = {1.0 / length, -slope / length},
                         .t = {slope / length, 1.0 / length},
                         .gap = gap / length,
                         .curvature = -curvature / (length * length),
                         .axis = 1};
  }
  if (surface == SB_RING_WALL_RIGHT || surface == SB_RING_WALL_LEFT) {
    // Mirrored for the left one.
    const double way = surface == SB_RING_WALL_RIGHT ? 1.0 : -1.0;
    const double wall = surface == SB_RING_WALL_RIGHT ? load->wall_right : -load->wall_left;
    double slope, curvature;
    const int right = surface == SB_RING_WALL_RIGHT;
    const double gap = wall - way * x[1] + wall_recess(load, right, x[0], &slope, &curvature);
    const double length = sqrt(1.0 + slope * slope);
    return (SbRingFrame){.n = {slope / length, -way / length},
                         .t = {1.0 / length, way * slope / length},
                         .gap = gap / length,
                         .curvature = curvature / (length * length)};
  }
  double s1, c1, s2, c2;
  double opening = sb_groove_ramp(x[1] - load->land_right, load->edge_length, &s1, &c1) +
                   sb_groove_ramp(load->land_left - x[1], load->edge_length, &s2, &c2);
  double chamfer = opening > 0.0 ? tan(load->chamfer_angle) : 0.0;
  double slope = chamfer * (s1 - s2), length = sqrt(1.0 + slope * slope);
  return (SbRingFrame){.n = {-1.0 / length, slope / length},
                       .t = {slope / length, 1.0 / length},
                       .gap = (load->bore_radius + chamfer * opening - x[0]) / length,
                       .curvature = chamfer * (c1 + c2) / (length * length),
                       .axis = 1};
}

// Returns whether two points are on different sides of a line, beyond rounding: sides in one flat
// contact are on a line.
static bool parts(const double a[2], const double b[2], const double c[2], const double d[2]) {
  static const double ROUNDING = 1e-9; // twice the area of a triangle, in section diameters
  const double u[2] = {b[0] - a[0], b[1] - a[1]};
  const double at_c = u[0] * (c[1] - a[1]) - u[1] * (c[0] - a[0]);
  const double at_d = u[0] * (d[1] - a[1]) - u[1] * (d[0] - a[0]);
  return at_c * at_d < 0.0 && fmin(fabs(at_c), fabs(at_d)) > ROUNDING;
}

// Returns whether two sides of the boundary are in one hollow, where the separating stiffness
// allows them to cross.
static bool presses(const SbRingContact *contact, int i, int k) {
  const int *hollow = contact->fem->hollow;
  const int number = hollow[i];
  return number != 0 && hollow[sb_ring_wrap(contact, i + 1)] == number && hollow[k] == number &&
         hollow[sb_ring_wrap(contact, k + 1)] == number;
}

bool sb_ring_crosses_itself(const SbRingContact *contact) {
  const int count = contact->count;
  for (int i = 0; i < count; i++) {
    double a[2], b[2];
    sb_ring_contact_place(contact, i, a);
    sb_ring_contact_place(contact, i + 1, b);
    for (int k = i + 2; k < count - (i == 0 ? 1 : 0); k++) {
      double c[2], d[2];
      sb_ring_contact_place(contact, k, c);
      sb_ring_contact_place(contact, k + 1, d);
      if (parts(a, b, c, d) && parts(c, d, a, b) && !presses(contact, i, k)) {
        return true;
      }
    }
  }
  return false;
}

const char *sb_ring_surface_name(SbRingSurface surface) {
  static const char *const names[SB_RING_SURFACES] = {"bore", "groove floor", "right groove wall",
                                                      "left groove wall"};
  return names[surface];
}

double sb_ring_friction(const SbRingLoad *load, SbRingSurface surface) {
  return surface == SB_RING_BORE    ? (load->use_bore_traction ? 0.0 : load->friction_bore)
         : surface == SB_RING_FLOOR ? load->friction_floor
                                    : load->friction_wall;
}

bool sb_ring_has_friction(const SbRingLoad *load) {
  return load->use_bore_traction || load->friction_bore > 0.0 || load->friction_floor > 0.0 ||
         load->friction_wall > 0.0;
}

// The numbers of a load: lengths, pressures or neither, and the side whose end of the land it is.
static const struct {
  size_t at;
  int length, pressure, end;
} NUMBER[] = {
    {offsetof(SbRingLoad, floor_radius), 1, 0, 0},
    {offsetof(SbRingLoad, bore_radius), 1, 0, 0},
    {offsetof(SbRingLoad, wall_left), 1, 0, 0},
    {offsetof(SbRingLoad, wall_right), 1, 0, 0},
    {offsetof(SbRingLoad, wall_draft), 0, 0, 0},
    {offsetof(SbRingLoad, floor_corner), 1, 0, 0},
    {offsetof(SbRingLoad, wall_chamfer), 1, 0, 0},
    {offsetof(SbRingLoad, wall_top), 1, 0, 0},
    {offsetof(SbRingLoad, groove_unit), 1, 0, 0},
    {offsetof(SbRingLoad, groove_share), 0, 0, 0},
    {offsetof(SbRingLoad, land_left), 1, 0, -1},
    {offsetof(SbRingLoad, land_right), 1, 0, 1},
    {offsetof(SbRingLoad, chamfer_angle), 0, 0, 0},
    {offsetof(SbRingLoad, edge_length), 1, 0, 0},
    {offsetof(SbRingLoad, pressure_left), 0, 1, 0},
    {offsetof(SbRingLoad, pressure_right), 0, 1, 0},
    {offsetof(SbRingLoad, bore_position), 1, 0, 0},
    {offsetof(SbRingLoad, friction_bore), 0, 0, 0},
    {offsetof(SbRingLoad, friction_floor), 0, 0, 0},
    {offsetof(SbRingLoad, friction_wall), 0, 0, 0},
    {offsetof(SbRingLoad, bore_traction), 0, 1, 0},
};
enum { NUMBERS = sizeof NUMBER / sizeof NUMBER[0] };

static double *number(SbRingLoad *load, int i) {
  return (double *)((char *)load + NUMBER[i].at);
}

SbRingLoad sb_ring_load_in(const SbRingLoad *load, double length, double pressure) {
  SbRingLoad out = *load;
  for (int i = 0; i < NUMBERS; i++) {
    *number(&out, i) /= NUMBER[i].length ? length : NUMBER[i].pressure ? pressure : 1.0;
  }
  return out;
}

SbRingLoad sb_ring_load_mirrored(const SbRingLoad *load) {
  SbRingLoad out = *load;
  out.wall_left = -load->wall_right;
  out.wall_right = -load->wall_left;
  out.land_left = -load->land_right;
  out.land_right = -load->land_left;
  out.pressure_left = load->pressure_right;
  out.pressure_right = load->pressure_left;
  out.bore_position = -load->bore_position;
  out.bore_traction = -load->bore_traction;
  out.bore_slides = -load->bore_slides;
  return out;
}

SbRingLoad sb_ring_load_between(const SbRingLoad *a, const SbRingLoad *b, double t) {
  SbRingLoad start = *a, out = *b;
  for (int i = 0; i < NUMBERS; i++) {
    double from = *number(&start, i), to = *number(&out, i), end = NUMBER[i].end;
    if (end != 0.0 && (isfinite(from) || isfinite(to))) {
      from = isfinite(from) ? from : end * SB_RING_REACH;
      to = isfinite(to) ? to : end * SB_RING_REACH;
    }
    *number(&out, i) = isfinite(from) && isfinite(to) ? from + t * (to - from) : to;
  }
  return out;
}
