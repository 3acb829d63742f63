// Conditions of the joints, their rank, and the scaled equations of motion: shared by bodies.c and
// bodies_motion.c, private to engine/mechanism. Forces, torques and accelerations are in the ground
// frame, torques about the body's centre of mass. Columns are in the order of the bodies, per body
// velocity (x, y, z), then `length` times spin (x, y, z).
#pragma once

#include "engine/mechanism/bodies.h"

// Short names in these files.
enum { ROWS = SB_ASSEMBLY_ROWS, COLUMNS = SB_ASSEMBLY_COLUMNS };

typedef SbAssemblyConditions Conditions;

// Computes the conditions at the present positions and velocities. Rotations are multiplied by
// `length` [m], usually sb_bodies_extent().
void sb_bodies_conditions(Conditions *conditions, const SbAssembly *assembly, double length);

// Returns the rank of the first `rows` conditions in work->conditions, which
// sb_bodies_conditions(&work->conditions, assembly, ...) must have computed. The QR factorisation
// with column pivoting of their transpose remains in `work` for sb_bodies_free_motion().
size_t sb_bodies_rank(SbAssemblyWork *work, const SbAssembly *assembly, size_t rows);

// Writes to motion[6 * bodies] the motion number `index` that the conditions allow, index = 0 to 6
// * bodies - rank - 1. Motions are orthogonal unit vectors in the order of the columns. The last
// sb_bodies_rank() with the same `work` must have returned `rank`.
void sb_bodies_free_motion(double *motion, SbAssemblyWork *work, const SbAssembly *assembly,
                           size_t rank, size_t index);

// Returns the length [m] that scales rotations: the largest distance of a joint from the centre of
// mass of its body; 1 mm if all are 0.
double sb_bodies_extent(const SbAssembly *assembly);

// Solves the scaled equations of motion
//
//   M a + J' l = top,   J a = bottom
//
// with J = work->conditions.jacobian, which sb_bodies_conditions(&work->conditions, assembly,
// length) must have computed with the same `length`. `mass` [kg] > 0 is any scale, such as the
// largest mass of a body. M has the masses divided by `mass` and the moments of inertia divided by
// (mass length^2).
//   top [6 * bodies]  forces divided by `mass`, torques divided by (mass length); replaced by a:
//                     accelerations [m/s2] and `length` times spin rates
//   bottom [rows]     right-hand side, rows = work->conditions.rows (accelerations: minus
//                     conditions.rate); replaced by the multipliers l. The joints' forces on the
//                     bodies are -J' l times `mass`.
// SB_ERROR_INFEASIBLE: the conditions are redundant.
SbStatus sb_bodies_solve(const SbAssembly *assembly, SbAssemblyWork *work, double mass,
                         double length, double *top, double *bottom, SbReport *report);

// Computes accelerations and reactions like sb_assembly_forces(), but without checking for
// redundant conditions first. Computes work->conditions itself. SB_ERROR_INFEASIBLE: the matrix is
// exactly singular; with almost redundant conditions the reactions are meaningless.
SbStatus sb_bodies_forces(SbAssemblyForces *forces, const SbAssembly *assembly,
                          SbAssemblyWork *work, SbReport *report);

// Moves the bodies so that the joints' position conditions hold; velocities are unchanged. Computes
// work->conditions itself. *error receives the largest violation before the correction [m].
// SB_ERROR_NOT_CONVERGED: the joints cannot be closed. SB_ERROR_INFEASIBLE: redundant conditions.
SbStatus sb_bodies_settle_positions(SbAssembly *assembly, double *error, SbAssemblyWork *work,
                                    SbReport *report);
