// A meshed section through which something permeates: six-node triangles about an axis or in a
// plane, and which of their nodes are wetted from inside, wetted from outside, or neither (against
// metal or plastic, which let nothing through).
//
// Where a wetted face ends against a dry one the partial pressure rises with the root of the
// distance. Plain elements then converge with h only; in the elements round such an end the
// mid-side nodes stand at the quarter of their sides instead, which gives the quadratic element
// this root (Barsoum, Int. J. Numer. Meth. Engng 10 (1976) 25; for the natural triangle Freese and
// Tracey, Int. J. Fracture 12 (1976) 767).
#pragma once

#include "engine/base/status.h"

typedef enum { SB_FACE_DRY, SB_FACE_INSIDE, SB_FACE_OUTSIDE } SbFace;

typedef struct {
  int nodes, elements;
  double *place;       // [2 nodes] (r, z) [m]
  int *triangle;       // [6 elements] vertices 0-2, mid-sides 3 = 0-1, 4 = 1-2, 5 = 2-0
  unsigned char *face; // [nodes] SbFace; a node of two is wetted
  unsigned char *end;  // [nodes] 1: a wetted face ends here
  bool axisymmetric;   // about r = 0; else per metre of depth
} SbWettedMesh;

// With room for so many; all zero. Owned. SB_ERROR_MEMORY.
SbStatus sb_wetted_mesh_create(SbWettedMesh **out, int nodes, int elements, bool axisymmetric,
                               SbReport *report);
void sb_wetted_mesh_destroy(SbWettedMesh *section); // takes NULL

// Another one alike. Owned. SB_ERROR_MEMORY.
SbStatus sb_wetted_mesh_copy(SbWettedMesh **out, const SbWettedMesh *section, SbReport *report);

// Each element parted into four by the middles of its sides, as they are curved. Owned.
// SB_ERROR_MEMORY, SB_ERROR_INPUT for triangles that name no node.
SbStatus sb_wetted_mesh_split(SbWettedMesh **out, const SbWettedMesh *section, SbReport *report);

// Moves the mid-side nodes of the sides at an end to their quarters.
void sb_wetted_mesh_quarter(SbWettedMesh *section);
