// See wetted_ring.h.
#include "engine/permeation/wetted_ring.h"

#include <stdlib.h>

static SbFace face_of(unsigned char side, bool inside_right) {
  return side == SB_RING_SIDE_CLOSED                              ? SB_FACE_DRY
         : (side == SB_RING_SIDE_RIGHT) == (inside_right == true) ? SB_FACE_INSIDE
                                                                  : SB_FACE_OUTSIDE;
}

// Wets the nodes of open sides and marks where they end; false where both fluids meet.
static bool wet(SbWettedMesh *section, const int *loop, const unsigned char *side, int sides,
                bool inside_right) {
  for (int k = 0; k < sides; k++) {
    const SbFace face = face_of(side[k], inside_right);
    const SbFace next = face_of(side[(k + 1) % sides], inside_right);
    for (int i = 0; i < 3 && face != SB_FACE_DRY; i++) {
      section->face[loop[(2 * k + i) % (2 * sides)]] = (unsigned char)face;
    }
    if (face != SB_FACE_DRY && next != SB_FACE_DRY && face != next) {
      return false;
    }
    section->end[loop[(2 * k + 2) % (2 * sides)]] = face != next;
  }
  return true;
}

SbStatus sb_wetted_ring_create(SbWettedMesh **out, const SbRing *ring, bool inside_right,
                               SbReport *report) {
  int nodes, elements, sides;
  sb_ring_section_sizes(ring, &nodes, &elements, &sides);
  SbStatus status = sb_wetted_mesh_create(out, nodes, elements, true, report);
  int *loop = malloc(2 * sizeof *loop * (size_t)sides);
  unsigned char *side = malloc((size_t)sides);
  if (status == SB_OK && (loop == NULL || side == NULL)) {
    status = sb_fail(report, SB_ERROR_MEMORY, "no memory for a ring's section");
  }
  if (status == SB_OK) {
    const SbRingSection fill = {(*out)->place, (*out)->triangle, loop, side};
    sb_ring_section(ring, &fill);
    if (!wet(*out, loop, side, sides, inside_right)) {
      status = sb_fail(report, SB_ERROR_INFEASIBLE,
                       "the fluid has an open path past the ring: permeation is not defined");
    }
  }
  if (status != SB_OK) {
    sb_wetted_mesh_destroy(*out);
    *out = NULL;
  }
  free(loop);
  free(side);
  return status;
}
