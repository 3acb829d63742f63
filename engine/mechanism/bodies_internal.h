// What the files of bodies share: the joints' conditions and which of them repeat others
// (bodies.c), for accelerations, reactions and the motion that they leave (bodies_motion.c).
// Private to this folder.
#pragma once

#include "engine/mechanism/bodies.h"

enum { ROWS = SB_ASSEMBLY_ROWS, COLUMNS = SB_ASSEMBLY_COLUMNS };

typedef SbAssemblyConditions Conditions;

// Conditions at the present positions and speeds; turns count times `length`.
void sb_bodies_conditions(Conditions *conditions, const SbAssembly *assembly, double length);

// Rank of the first `rows` conditions, from the QR factorisation of their transpose with exchanged
// columns, which stays in `work`; and, from that, motion `index` of those they leave [6 times the
// bodies], which are orthogonal to each other.
size_t sb_bodies_rank(SbAssemblyWork *work, const SbAssembly *assembly, size_t rows);
void sb_bodies_free_motion(double *motion, SbAssemblyWork *work, const SbAssembly *assembly,
                           size_t rank, size_t index);

// Length that makes rotations comparable with translations: the assembly's extent [m].
double sb_bodies_extent(const SbAssembly *assembly);

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
