// What the files of bodies share: the joints' conditions (bodies_conditions.c) for accelerations
// and reactions (bodies_solve.c) and for the motion that they leave (bodies_tangent.c). Private to
// this folder.
#pragma once

#include "engine/mechanism/bodies.h"

enum {
  ROWS = SB_ASSEMBLY_ROWS,
  COLUMNS = SB_ASSEMBLY_COLUMNS,
  SIZE = SB_ASSEMBLY_SIZE,
};

typedef SbAssemblyConditions Conditions;

// Conditions at the present positions and speeds; turns count times `length`.
void sb_bodies_conditions(Conditions *conditions, const SbAssembly *assembly, double length);

// Solves the constrained system, masses per `mass` and turns times `length`, for one right side:
// top (bodies, per mass) and bottom (conditions). The answer replaces them: accelerations,
// multipliers.
SbStatus sb_bodies_solve(const SbAssembly *assembly, SbAssemblyWork *work, double mass,
                         double length, double *top, double *bottom, SbReport *report);

// Accelerations and reactions without asking whether conditions repeat each other.
SbStatus sb_bodies_forces(SbAssemblyForces *forces, const SbAssembly *assembly,
                          SbAssemblyWork *work, SbReport *report);

// Brings positions, not speeds, onto the joints; *error is what they were off by [m].
SbStatus sb_bodies_settle_positions(SbAssembly *assembly, double *error, SbAssemblyWork *work,
                                    SbReport *report);

// Rank of the first `rows` conditions, from the QR factorisation of their transpose with exchanged
// columns, which stays in `work`; and, from that, motion `index` of those they leave [6 times the
// moving bodies], which are orthogonal to each other.
size_t sb_bodies_rank(SbAssemblyWork *work, const SbAssembly *assembly, size_t rows);
void sb_bodies_free_motion(double *motion, SbAssemblyWork *work, const SbAssembly *assembly,
                           size_t rank, size_t index);

// Angular momentum of a body that spins [kg m2/s], ground axes.
void sb_bodies_momentum(double momentum[3], const SbBody *body, const double spin[3]);

// Moves a body by `share` times a small displacement [m] and turn [rad].
void sb_bodies_move(SbBody *body, const double displacement[3], const double angle[3],
                    double share);

// Length that makes rotations comparable with translations: the assembly's extent [m].
double sb_bodies_extent(const SbAssembly *assembly);
