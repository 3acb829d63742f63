// The outline of a ring's section as it is drawn from closed forms: a circle flattened between
// groove floor and bore with the contact that the engine reports.
//
// Schematic: flat on floor and bore, sides half ellipses between the flats, cut by the groove's
// walls; the half ellipses' depth is chosen so that the section's area is that of the fitted ring
// (incompressible, volume of revolution at the mean diameter). It touches the bore exactly over the
// contact and never crosses a wall. The true outline is the finite-element ring's.
#pragma once

#include <stdbool.h>
#include <stddef.h>

enum { SB_RING_SIDE = 40, SB_RING_POINTS = 2 * SB_RING_SIDE + 2 };

// Where a ring may be, in the seal's frame: x axial, y radial from the groove floor [m].
typedef struct {
  double space;                 // radial space: bore at y = space
  double wall_left, wall_right; // groove walls, x
  double area;                  // of the section [m2]
  double section;               // fitted section diameter, for the free shape [m]
  // Radius of the housing above the groove floor at x; used only off the land (fraction < 1).
  double (*housing)(void *data, double x);
  void *data;
} SbRingRoom;

typedef struct {
  size_t count;
  double x[SB_RING_POINTS], y[SB_RING_POINTS]; // outline, counterclockwise with y up
  bool contact; // touches the bore over [contact_left, contact_right]
  double contact_left, contact_right;
  double area;         // of the outline [m2]
  bool area_conserved; // false if the groove cannot hold the section
} SbRingShape;

// The shape with contact [left, right] on the bore of which a share `land_fraction` is on the land
// (1: all; 0: the ring is free and touches nothing but the floor).
void sb_ring_shape_make(SbRingShape *shape, const SbRingRoom *room, double left, double right,
                        double land_fraction);

// A rectangle between two walls, as high as it must be.
void sb_ring_shape_rectangle(SbRingShape *shape, double left, double right, double height);

// Area of a polygon [m2], positive counterclockwise.
double sb_ring_shape_area(const double *x, const double *y, size_t count);
