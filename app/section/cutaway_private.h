// Shared by cutaway.c (drawing) and cutaway_labels.c.
#pragma once

#include "app/section/cutaway.h"
#include "app/section/section_private.h"

// Maximum number of points of a ring's outline.
enum { SB_CUTAWAY_RING_POINTS = 72 };

// The cutaway.
struct SbCutaway {
  SbRevolve revolve;    // surfaces of the valve in the order of painting
  SbValveOutline valve; // outline with the housing in one piece, without the gap of the vent
  size_t ring_count[SB_SEAL_COUNT]; // number of points of `ring`
  // Outlines of the rings at this instant in the housing's frame [m], counterclockwise.
  SbValvePoint ring[SB_SEAL_COUNT][SB_CUTAWAY_RING_POINTS];
  double top, bottom;     // ends of the valve in the picture over the full stroke [px]
  GArray *point, *scalar; // buffers for cells: of SbPoint and of float
};

// Returns the plane of a cut face, 0 or 1, in the picture that sb_revolve_begin() started: (axial
// position, radius) in the housing's frame [m].
SbSectionPlane sb_cutaway_plane(const SbRevolve *revolve, int face);

// Draws the names of the parts that the cut faces show, while the camera looks into the open
// quarter and the picture is not enlarged.
void sb_cutaway_labels(SbCutaway *cutaway, SbSection *section);

// Draws the line below the picture that states what it shows.
void sb_cutaway_caption(SbSection *section);
