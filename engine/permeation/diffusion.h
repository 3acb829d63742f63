// Fick's diffusion through a meshed section, sorbed by Henry's law: c = S p at wetted faces.
//
//   div (P grad p) = 0, steady;  dp/dt = D div grad p, D = P/S  (Crank, The Mathematics of
//   Diffusion, 2nd ed. 1975, 1.2 and 10.1)
//
// in finite elements of six-node triangles, p quadratic: the steady flux is the sum of the nodal
// reactions of a face, which balance to rounding and converge with h^4 (h the side of an element)
// where the solution is smooth; wetted_mesh.h says how the ends of faces are met. With the partial
// pressure 1 inside and 0 outside everything is geometry:
//
//   flux = P S_g (p_in - p_out), S_g [m] the conductance: A/L of a slab, 2 pi H/ln(r2/r1)
//   time lag t_l = l2/D, l2 = int p (1 - p) dV/S_g [m2]: L^2/6 of a slab (Daynes 1920; for any body
//   Frisch, J. Phys. Chem. 61 (1957) 93)
//
// The approach to it from a dry body: time by an L-stable method of fourth order in five stages
// (Hairer and Wanner, Solving ODEs II, table IV.6.5), in steps that grow with the time.
//
// Constant P and D: stretch, swell and concentration do not change them here. SI units; an
// axisymmetric section's figures are those of the whole ring, a plane one's per metre.
#pragma once

#include "engine/permeation/wetted_mesh.h"

typedef struct SbDiffusion SbDiffusion;

typedef struct {
  double conductance;       // S_g [m]; plane: [1]
  double flux_in, flux_out; // through the faces for P = 1 and 1 inside; equal but for rounding
  double lag;               // D times the time lag [m2]
  double volume;            // [m3]; plane: [m2]
} SbDiffusionSteady;

// Assembles and solves the steady state. `section` is borrowed until the end. Owned; free with
// sb_diffusion_destroy(). SB_ERROR_INPUT: an element is turned inside out, or a face has no node;
// SB_ERROR_MEMORY; SB_ERROR_NOT_CONVERGED: not positive definite, a part hangs on no face.
SbStatus sb_diffusion_create(SbDiffusion **out, const SbWettedMesh *section, SbReport *report);
void sb_diffusion_destroy(SbDiffusion *diffusion); // takes NULL

void sb_diffusion_steady(SbDiffusionSteady *out, const SbDiffusion *diffusion);

// The steady partial pressure, 1 inside, at each node; borrowed.
const double *sb_diffusion_field(const SbDiffusion *diffusion);

// Size of its gradient [1/m] at each node, the mean of the elements that share it; the flux per
// area over P and the pressure. At the ends of faces, where it has no bound, that of the elements'
// other nodes. SB_ERROR_MEMORY.
SbStatus sb_diffusion_gradient(double *out, const SbDiffusion *diffusion, SbReport *report);

// One instant of the approach.
typedef struct {
  double time;     // D t [m2]
  double flux_in;  // over P and the pressure [m]
  double flux_out; // [m]
  double sorbed;   // what the body holds over S times the pressure [m3]
} SbDiffusionInstant;

// The approach from a dry body whose inner face is wetted at t = 0, at `count` times each twice the
// one before, the last D t = `last`; `steps` of time between two of them (0: 16).
// SB_ERROR_MEMORY, SB_ERROR_NOT_CONVERGED.
SbStatus sb_diffusion_approach(SbDiffusionInstant *out, int count, double last, int steps,
                               const SbDiffusion *diffusion, SbReport *report);

// The steady state to an estimated error: on the section and on its elements parted into four, both
// with quarter points. What those leave falls with the side of the elements, the angles round an
// end being met by a few of them: the last change once more is added to the finer one's figures,
// and half of it is the estimate.
typedef struct {
  SbDiffusionSteady steady;
  double error;    // of conductance and lag, relative
  double flux_gap; // of the finer mesh, |in - out| over their mean
} SbDiffusionConverged;

// `section` stays as it is. Errors as sb_diffusion_create().
SbStatus sb_diffusion_converge(SbDiffusionConverged *out, const SbWettedMesh *section,
                               SbReport *report);
