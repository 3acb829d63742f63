// Prints a solved ring's deformed section for compare_ccx_heat.py: pressure [Pa] as its argument.
// Lines: the conductance [m] and its estimate; nodes and elements; (r, axial) [m] and face of each
// node; the six nodes of each element, from 0.
#include "engine/permeation/diffusion.h"
#include "engine/permeation/wetted_ring.h"
#include "tests/engine/seals.h"

#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv) {
  const SbRingLoad load = groove(argc > 1 ? strtod(argv[1], NULL) : 0.0);
  SbRing *ring = fitted(&BODY, &load, 0.02);
  SbWettedMesh *section;
  SbDiffusionConverged value;
  SbReport report;
  if (sb_wetted_ring_create(&section, ring, false, &report) != SB_OK ||
      sb_diffusion_converge(&value, section, &report) != SB_OK) {
    fprintf(stderr, "%s\n", report.text);
    return 1;
  }
  printf("%.12g %.3g\n%d %d\n", value.steady.conductance, value.error, section->nodes,
         section->elements);
  for (int i = 0; i < section->nodes; i++) {
    printf("%.12g %.12g %d\n", section->place[2 * i], section->place[2 * i + 1], section->face[i]);
  }
  for (int i = 0; i < 6 * section->elements; i++) {
    printf(i % 6 == 5 ? "%d\n" : "%d ", section->triangle[i]);
  }
  sb_wetted_mesh_destroy(section);
  sb_ring_destroy(ring);
  return 0;
}
