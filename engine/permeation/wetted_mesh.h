// A meshed section for diffusion.h: six-node triangles, axisymmetric or plane. Each node is wetted
// from inside, wetted from outside, or dry (inside the section, or on an impermeable face).
//
// Where a wetted face meets a dry face, p rises with the square root of the distance. Quadratic
// elements converge with h only there. If the mid-side nodes next to such an end are moved to the
// quarter of their side, the elements represent the square root (Barsoum, Int. J. Numer. Meth.
// Engng 10 (1976) 25; for the natural triangle Freese and Tracey, Int. J. Fracture 12 (1976) 767).
#pragma once

#include "engine/base/status.h"

// Boundary condition of a node. A node that belongs to a wetted and a dry face is wetted.
typedef enum {
  SB_FACE_DRY,    // no flux, or inside the section
  SB_FACE_INSIDE, // in contact with the inner fluid
  SB_FACE_OUTSIDE // in contact with the outer fluid
} SbFace;

// The mesh. The structure owns its arrays; the caller fills them after sb_wetted_mesh_create().
typedef struct {
  int nodes, elements;
  double *place; // [nodes][2] coordinates (r, z) [m]
  int *triangle; // [elements][6] node numbers: vertices 0-2, counter-clockwise in (r, z), then
                 // mid-sides 3 = 0-1, 4 = 1-2, 5 = 2-0
  unsigned char *face; // [nodes] SbFace
  unsigned char *end;  // [nodes] 1: a wetted face ends at this vertex; else 0
  bool axisymmetric;   // about r = 0; else plane, 1 m deep
} SbWettedMesh;

// Creates a mesh with arrays for so many nodes and elements; all elements of the arrays are 0.
SbStatus sb_wetted_mesh_create(SbWettedMesh **out, int nodes, int elements, bool axisymmetric,
                               SbReport *report);

// Frees the mesh and its arrays. Takes NULL.
void sb_wetted_mesh_destroy(SbWettedMesh *section);

// Creates a copy of `section`; free it with sb_wetted_mesh_destroy().
SbStatus sb_wetted_mesh_copy(SbWettedMesh **out, const SbWettedMesh *section, SbReport *report);

// Creates a mesh in which each element of `section` is split into four at its mid-side nodes, on
// its curved sides. Old nodes keep their numbers. Free it with sb_wetted_mesh_destroy().
// SB_ERROR_INPUT: a triangle has an invalid node number.
SbStatus sb_wetted_mesh_split(SbWettedMesh **out, const SbWettedMesh *section, SbReport *report);

// Moves the mid-side node of each side with one end vertex (`end` = 1) to the quarter of the side
// next to that vertex. Call it once for a mesh, after splitting.
void sb_wetted_mesh_quarter(SbWettedMesh *section);
