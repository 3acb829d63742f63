// What the writers of a solved ring's files share. For app/export/cae*.c only.
#pragma once

#include "app/export/cae.h"

// The nodes, elements and fields of a solved ring, owned by cae.c. Lengths [m], stresses [Pa];
// x axial, y radial.
typedef struct {
  int nodes, elements, sides; // six-node triangles; sides of elements on the boundary
  SbRingSection section;      // mesh and boundary; sizes as sb_ring_section() states
  SbRingFields fields;        // at the nodes; sizes as sb_ring_fields() states
  double *values;             // [8 * nodes]: memory of all fields
  SbRingBody body;            // the ring
  SbRingLoad load;            // its groove, bore and fluid
  SbRingResult result;
} SbCaeMesh;

// Appends `mark` and then `value` with ten significant digits and a decimal point in every locale.
void sb_cae_put(GString *out, const char *mark, double value);

// Returns the coordinate of a node (from 0) in the free section [m]; axis 0: axial, 1: radial.
double sb_cae_free_place(const SbCaeMesh *mesh, int node, int axis);

// Appends the problem as an input file of CalculiX, as cae.h describes it.
void sb_cae_write_calculix(GString *out, const SbCaeMesh *mesh);
