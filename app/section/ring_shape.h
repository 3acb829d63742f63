// The schematic outline of a ring's section for closed forms: a circle flattened between groove
// floor and bore, with the contact that the engine reports.
//
// It is flat on floor and bore, with half ellipses between the flats, cut by the groove's walls.
// The depth of the half ellipses is chosen so that the area is that of the fitted ring
// (incompressible, volume of revolution at the mean diameter). The outline is in contact with the
// bore exactly over the reported contact and never crosses a wall.
#pragma once

#include <stdbool.h>
#include <stddef.h>

// Points of one side, and of the outline.
enum { SB_RING_SIDE = 40, SB_RING_POINTS = 2 * SB_RING_SIDE + 2 };

// The space for a ring, in the seal's frame: x axial, y radial from the groove floor [m].
typedef struct {
  double space;                 // radial space: bore at y = space
  double wall_left, wall_right; // groove walls, x
  double area;                  // of the section [m2]
  double section;               // fitted section diameter, for the free shape [m]
  // Returns y of the housing at x [m]; used only if a part of the contact is not on the land. NULL:
  // no housing.
  double (*housing)(void *data, double x);
  void *data;
} SbRingRoom;

// An outline.
typedef struct {
  size_t count;
  double x[SB_RING_POINTS], y[SB_RING_POINTS]; // [count], counter-clockwise with y upwards [m]
  bool contact;                       // in contact with the bore over [contact_left, contact_right]
  double contact_left, contact_right; // x [m]
  double area;                        // of the outline [m2]
  bool area_conserved;                // false: the section does not fit into the groove
} SbRingShape;

// Computes the outline with the contact left .. right on the bore [m], of which the fraction
// `land_fraction` is on the land (1: all; 0, or left >= right: the ring is in contact with the
// floor only).
void sb_ring_shape_make(SbRingShape *shape, const SbRingRoom *room, double left, double right,
                        double land_fraction);

// Sets the outline to a rectangle from x = left to right and y = 0 to height [m].
void sb_ring_shape_rectangle(SbRingShape *shape, double left, double right, double height);

// Returns the area of the polygon x[count], y[count] [m2], positive if counter-clockwise.
double sb_ring_shape_area(const double *x, const double *y, size_t count);
