// What the writers of a solved ring's files share. Internal to them.
#pragma once

#include "app/export/cae.h"

// A ring's nodes, elements and fields, taken once.
typedef struct {
  int nodes, elements, sides;
  SbRingSection section;
  SbRingFields fields;
  double *values; // of all fields
  SbRingBody body;
  SbRingLoad load;
  SbRingResult result;
} SbCaeMesh;

// Numbers with a mark before each, the same in every locale.
void sb_cae_put(GString *out, const char *mark, double value);

// Axial and radial place of a node of the free section [m].
double sb_cae_free_place(const SbCaeMesh *mesh, int node, int axis);

// The problem for CalculiX, as cae.h says.
void sb_cae_write_calculix(GString *out, const SbCaeMesh *mesh);
