// Construction of the schematic ring outline. With flats of the same width w on floor and bore and
// half ellipses of depth b on both sides the area is g w + pi g b / 2; walls and unequal flats make
// b the root of a monotone function, found by bisection.
#include "app/section/ring_shape.h"

#include <math.h>

double sb_ring_shape_area(const double *x, const double *y, size_t count) {
  double twice = 0;
  for (size_t i = 0, j = count - 1; i < count; j = i++) {
    twice += x[j] * y[i] - x[i] * y[j];
  }
  return twice / 2;
}

static double clamp(double v, double low, double high) {
  return fmin(fmax(v, low), high);
}

// Flattened outline for depth `bulge`: up the right side, down the left side.
static void flattened(SbRingShape *shape, const SbRingRoom *room, double left, double right,
                      double floor_left, double floor_right, double bulge) {
  double g = room->space;
  for (int i = 0; i <= SB_RING_SIDE; i++) {
    double angle = M_PI * i / SB_RING_SIDE;
    double y = i == SB_RING_SIDE ? g : g / 2 * (1 - cos(angle));
    double t = y / g;
    double out = i == 0 || i == SB_RING_SIDE ? 0 : bulge * sin(angle);
    shape->x[i] = fmin(floor_right + (right - floor_right) * t + out, room->wall_right);
    shape->y[i] = y;
    int j = SB_RING_POINTS - 1 - i;
    shape->x[j] = fmax(floor_left + (left - floor_left) * t - out, room->wall_left);
    shape->y[j] = y;
  }
  shape->count = SB_RING_POINTS;
  shape->area = sb_ring_shape_area(shape->x, shape->y, shape->count);
}

// The whole contact on the land.
static void make_flat(SbRingShape *shape, const SbRingRoom *room, double left, double right) {
  left = clamp(left, room->wall_left, room->wall_right);
  right = clamp(right, left, room->wall_right);
  // A contact too wide for the section leaves a narrower foot.
  double least = 0.15 * room->space;
  double foot = right - left;
  double room_for_foot = 2 * (room->area - M_PI / 2 * room->space * least) / room->space - foot;
  foot = clamp(room_for_foot, 0, foot);
  double middle = (left + right) / 2;
  double low = 0, high = room->wall_right - room->wall_left + room->space;
  for (int i = 0; i < 60; i++) {
    double bulge = (low + high) / 2;
    flattened(shape, room, left, right, middle - foot / 2, middle + foot / 2, bulge);
    if (shape->area < room->area) {
      low = bulge;
    } else {
      high = bulge;
    }
  }
  flattened(shape, room, left, right, middle - foot / 2, middle + foot / 2, (low + high) / 2);
  shape->area_conserved = fabs(shape->area - room->area) < 1e-6 * room->area;
  shape->contact = right > left;
  shape->contact_left = left;
  shape->contact_right = right;
}

// Pushes an outline out of the housing, the floor and the walls.
static void confine(SbRingShape *shape, const SbRingRoom *room) {
  for (size_t i = 0; i < shape->count; i++) {
    shape->x[i] = clamp(shape->x[i], room->wall_left, room->wall_right);
    double top = room->housing == NULL ? HUGE_VAL : room->housing(room->data, shape->x[i]);
    shape->y[i] = clamp(shape->y[i], 0, top);
  }
}

// From the flattened outline towards the free circle by `loose`, swollen sideways by `swell`, then
// confined.
static void loosened(SbRingShape *out, const SbRingShape *flat, const SbRingRoom *room,
                     double loose, double swell) {
  double radius = room->section / 2;
  out->count = flat->count;
  double middle = (flat->contact_left + flat->contact_right) / 2 * (1 - loose);
  for (size_t i = 0; i < flat->count; i++) {
    bool is_left = i > SB_RING_SIDE;
    double angle = M_PI * (double)(is_left ? SB_RING_POINTS - 1 - i : i) / SB_RING_SIDE;
    double x = (is_left ? -radius : radius) * sin(angle);
    double y = radius * (1 - cos(angle));
    x = flat->x[i] + (x - flat->x[i]) * loose;
    out->x[i] = middle + (x - middle) * (1 + swell);
    out->y[i] = flat->y[i] + (y - flat->y[i]) * loose;
  }
  confine(out, room);
  out->area = sb_ring_shape_area(out->x, out->y, out->count);
}

void sb_ring_shape_make(SbRingShape *shape, const SbRingRoom *room, double left, double right,
                        double land_fraction) {
  double loose = 1 - clamp(land_fraction, 0, 1);
  SbRingShape flat;
  if (right > left) {
    make_flat(&flat, room, left, right);
  } else {
    make_flat(&flat, room, 0, 0);
    loose = 1;
  }
  if (loose <= 0) {
    *shape = flat;
    return;
  }
  *shape = (SbRingShape){0};
  double low = -0.5, high = 0.8;
  for (int i = 0; i < 50; i++) {
    double swell = (low + high) / 2;
    loosened(shape, &flat, room, loose, swell);
    if (shape->area < room->area) {
      low = swell;
    } else {
      high = swell;
    }
  }
  shape->area_conserved = fabs(shape->area - room->area) < 1e-6 * room->area;
  shape->contact = loose < 1;
  shape->contact_left = flat.contact_left;
  shape->contact_right = flat.contact_right;
}

void sb_ring_shape_rectangle(SbRingShape *shape, double left, double right, double height) {
  *shape = (SbRingShape){.count = 4,
                         .x = {left, right, right, left},
                         .y = {0, 0, height, height},
                         .contact = true,
                         .contact_left = left,
                         .contact_right = right,
                         .area = (right - left) * height,
                         .area_conserved = true};
}
