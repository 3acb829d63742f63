// Mesh of a solved ring's deformed section for diffusion.h. Its open sides are wetted by the
// adjacent fluid; contacts with bore, floor and walls are dry.
#pragma once

#include "engine/contact/ring/ring.h"
#include "engine/permeation/wetted_mesh.h"

// Creates an axisymmetric mesh of the section of `ring`, which is not a ring of plane strain; free
// the mesh with sb_wetted_mesh_destroy(). Its fields `face` and `end` are set. `inside_right`:
// SB_FACE_INSIDE is the fluid on the right (x > 0), else that on the left. In the mesh z is x of
// the ring. `ring` is only read during the call. SB_ERROR_INFEASIBLE: the two fluids meet, because
// the ring has no contact with the bore or the floor.
SbStatus sb_wetted_ring_create(SbWettedMesh **out, const SbRing *ring, bool inside_right,
                               SbReport *report);
