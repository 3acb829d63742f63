// A solved ring's deformed section, wetted by the fluids that stand at its open sides; contacts are
// dry.
#pragma once

#include "engine/contact/ring/ring.h"
#include "engine/permeation/wetted_mesh.h"

// `inside_right`: the inner fluid stands on the right, else on the left. Owned. SB_ERROR_MEMORY;
// SB_ERROR_INFEASIBLE where both fluids meet: the ring does not touch bore or floor.
SbStatus sb_wetted_ring_create(SbWettedMesh **out, const SbRing *ring, bool inside_right,
                               SbReport *report);
