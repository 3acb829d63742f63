// What the files of bodies share: the joints' conditions (bodies_conditions.c) for accelerations
// and reactions (bodies_solve.c) and for the motion that they leave (bodies_tangent.c). Private to
// this folder.
#pragma once

#include "engine/mechanism/bodies.h"

enum {
  ROWS = 6 * SB_JOINTS_MAX,
  COLUMNS = 6 * SB_BODIES_MAX,
  SIZE = ROWS + COLUMNS,
};

typedef struct {
  size_t rows;
  double jacobian[ROWS][COLUMNS]; // of (velocity, length x spin) of each body
  double rate[ROWS];              // what the rows' second derivative has beside J a
  double error[ROWS];             // violation of the position conditions [m]
  size_t joint[ROWS];
} Conditions;

// Conditions at the present positions and speeds; turns count times `length`.
void sb_bodies_conditions(Conditions *conditions, const SbAssembly *assembly, double length);

// Accelerations and reactions without asking whether conditions repeat each other.
SbStatus sb_bodies_forces(SbAssemblyForces *forces, const SbAssembly *assembly, SbReport *report);

// Brings positions, not speeds, onto the joints; *error is what they were off by [m].
SbStatus sb_bodies_settle_positions(SbAssembly *assembly, double *error, SbReport *report);

// Length that makes rotations comparable with translations: the assembly's extent [m].
double sb_bodies_extent(const SbAssembly *assembly);
