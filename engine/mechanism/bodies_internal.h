// Conditions of the joints and their rank: shared by bodies.c and bodies_motion.c, private to
// engine/mechanism.
#pragma once

#include "engine/mechanism/bodies.h"

// Short names in these files.
enum { ROWS = SB_ASSEMBLY_ROWS, COLUMNS = SB_ASSEMBLY_COLUMNS };

typedef SbAssemblyConditions Conditions;

// Computes the conditions at the present positions and velocities. Rotations are multiplied by
// `length` [m].
void sb_bodies_conditions(Conditions *conditions, const SbAssembly *assembly, double length);

// Returns the rank of the first `rows` conditions in work->conditions, by a QR factorisation with
// column pivoting of their transpose. The factorisation remains in `work` for
// sb_bodies_free_motion().
size_t sb_bodies_rank(SbAssemblyWork *work, const SbAssembly *assembly, size_t rows);

// Writes to motion[6 * bodies] the motion number `index` (from 0) that the conditions allow.
// Motions are orthogonal unit vectors of (velocity, length x spin) of each body. sb_bodies_rank()
// with the same `work` must have returned `rank`.
void sb_bodies_free_motion(double *motion, SbAssemblyWork *work, const SbAssembly *assembly,
                           size_t rank, size_t index);

// Returns the length [m] that scales rotations: the largest distance of a joint from a body's
// centre.
double sb_bodies_extent(const SbAssembly *assembly);

// Solves the equations of motion with the conditions in work->conditions for one right-hand side.
// `top` [6 * bodies]: forces divided by `mass` and torques divided by `mass` `length`; replaced by
// accelerations and `length` times spin rates. `bottom` [rows]: right-hand side of the conditions;
// replaced by the multipliers. SB_ERROR_INFEASIBLE: the conditions are redundant.
SbStatus sb_bodies_solve(const SbAssembly *assembly, SbAssemblyWork *work, double mass,
                         double length, double *top, double *bottom, SbReport *report);

// Computes accelerations and reactions like sb_assembly_forces(), but without checking for
// redundant conditions first.
SbStatus sb_bodies_forces(SbAssemblyForces *forces, const SbAssembly *assembly,
                          SbAssemblyWork *work, SbReport *report);

// Moves the bodies so that the joints' position conditions hold; velocities are unchanged. *error
// receives the largest violation before the correction [m]. SB_ERROR_NOT_CONVERGED: the joints
// cannot be closed. SB_ERROR_INFEASIBLE: redundant conditions.
SbStatus sb_bodies_settle_positions(SbAssembly *assembly, double *error, SbAssemblyWork *work,
                                    SbReport *report);
