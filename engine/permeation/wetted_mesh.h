// A meshed section for diffusion.h: six-node triangles, axisymmetric or plane. Each node is wetted
// from inside, wetted from outside, or dry (inside the section, or on an impermeable face).
//
// Where a wetted face meets a dry face, the pressure p of diffusion.h varies with the square root
// of the distance. Quadratic elements converge with h only there. If the mid-side nodes next to
// such an end are moved to the quarter of their side, the elements represent the square root
// (Barsoum, Int. J. Numer. Meth. Engng 10 (1976) 25; for the natural triangle Freese and Tracey,
// Int. J. Fracture 12 (1976) 767).
#pragma once

#include "engine/base/status.h"

// Boundary condition of a node. A node that belongs to a wetted and a dry face is wetted.
typedef enum {
  SB_FACE_DRY,    // no flux, or inside the section
  SB_FACE_INSIDE, // in contact with the inner fluid
  SB_FACE_OUTSIDE // in contact with the outer fluid
} SbFace;

// The mesh. The structure owns its arrays; the caller fills them after sb_wetted_mesh_create().
// Nodes and elements are numbered from 0.
typedef struct {
  int nodes, elements; // numbers of nodes and of triangles, as created
  double *place;       // [nodes][2] coordinates (r, z) [m]
  int *triangle; // [elements][6] node numbers: vertices 0-2, counter-clockwise in (r, z), then
                 // mid-sides 3 = 0-1, 4 = 1-2, 5 = 2-0
  unsigned char *face; // [nodes] boundary condition, an SbFace; also of mid-side nodes
  unsigned char *end;  // [nodes] 1: vertex at which a wetted face meets a dry face; else 0
  bool axisymmetric;   // true: r is the distance from the axis; false: plane, 1 m deep
} SbWettedMesh;

// Creates a mesh of `nodes` nodes and `elements` triangles. Its arrays are filled with zeros (all
// nodes dry, no ends).
SbStatus sb_wetted_mesh_create(SbWettedMesh **out, int nodes, int elements, bool axisymmetric,
                               SbReport *report);

// Frees the mesh and its arrays.
void sb_wetted_mesh_destroy(SbWettedMesh *section);

// Creates a copy of `section`; free it with sb_wetted_mesh_destroy().
SbStatus sb_wetted_mesh_copy(SbWettedMesh **out, const SbWettedMesh *section, SbReport *report);

// Creates a mesh in which each element of `section` is split into four at its mid-side nodes, on
// its curved sides. The nodes of `section` keep their numbers, `face` and `end`. A new node on a
// side between a mid-side node and a vertex gets the `face` of the mid-side node; new nodes inside
// an element are dry. `end` of new nodes is 0. Free the mesh with sb_wetted_mesh_destroy().
// SB_ERROR_INPUT: a triangle has an invalid node number.
SbStatus sb_wetted_mesh_split(SbWettedMesh **out, const SbWettedMesh *section, SbReport *report);

// On each element side of which exactly one vertex has `end` = 1, moves the mid-side node to the
// quarter of the side next to that vertex. Call it at most once for a mesh, after splitting.
void sb_wetted_mesh_quarter(SbWettedMesh *section);
