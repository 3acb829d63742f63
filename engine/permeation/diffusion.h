// Fick's diffusion of one species through a meshed section. Wetted faces are in equilibrium with
// the fluids by Henry's law: c = S p.
//
//   steady:  div (P grad p) = 0; D = P/S
//   (Crank, The Mathematics of Diffusion, 2nd ed. 1975, 1.2 and 10.1)
//
// P is the permeability, S the solubility, D the diffusivity; they are constant. p is the scaled
// partial pressure (partial pressure - p_out)/(p_in - p_out), with the partial pressures p_in at
// inside faces and p_out at outside faces: p = 1 at inside faces, 0 at outside faces. The results
// depend on the geometry only; the caller multiplies them by P, S, D and p_in - p_out:
//
//   flux = P S_g (p_in - p_out), S_g = conductance: A/L of a slab, 2 pi H/ln(r2/r1) of a tube
//   time lag = l2/D, l2 = int p (1 - p) dV/S_g: L^2/6 of a slab
//   (Daynes 1920; for any body Frisch, J. Phys. Chem. 61 (1957) 93)
//
// Method: finite elements with quadratic shape functions. The flux of a face is the sum of its
// nodal reactions; it converges with h^4 where the solution is smooth (h: size of an element; ends
// of faces: wetted_mesh.h). Not modelled: changes of P and D by stretch, swell and concentration.
//
// Integrals over an axisymmetric section are those of the full ring. Those over a plane section are
// per metre of depth, so their unit has one m less than stated below.
#pragma once

#include "engine/permeation/wetted_mesh.h"

// A section with its equations and its steady solution.
typedef struct SbDiffusion SbDiffusion;

// Steady results.
typedef struct {
  double conductance; // S_g, mean of flux_in and flux_out [m]
  double flux_in;     // into the section through the inside faces, divided by P (p_in - p_out) [m]
  double flux_out;    // out of the outside faces, divided by P (p_in - p_out); equals flux_in up to
                      // rounding [m]
  double lag;         // l2, the time lag multiplied by D [m2]
  double volume;      // volume of the section [m3]
} SbDiffusionSteady;

// Assembles and solves the steady state of `section`, which is borrowed and must not change until
// sb_diffusion_destroy(). SB_ERROR_INPUT: an element has a negative or zero area, a triangle has an
// invalid node number, no node has SB_FACE_INSIDE, or no node has SB_FACE_OUTSIDE.
// SB_ERROR_NOT_CONVERGED: a part of the section has no wetted face (the matrix is singular).
SbStatus sb_diffusion_create(SbDiffusion **out, const SbWettedMesh *section, SbReport *report);

// Frees the object.
void sb_diffusion_destroy(SbDiffusion *diffusion);

// Returns the steady results in *out.
void sb_diffusion_steady(SbDiffusionSteady *out, const SbDiffusion *diffusion);

// Writes |grad p| [1/m] of the steady state to out[section->nodes], averaged over the elements of
// each node. Multiply it by P (p_in - p_out) for the flux per area. At ends of faces, where the
// gradient is unbounded, the mean over the other nodes of the adjacent elements is written.
// SB_ERROR_MEMORY is the only error.
SbStatus sb_diffusion_gradient(double *out, const SbDiffusion *diffusion, SbReport *report);

// Steady results with an error estimate. Two meshes are solved, the section and its elements split
// into four, both with quarter-point elements at ends of faces. Their error is proportional to h
// there. `steady.conductance` and `steady.lag` are extrapolated; the other fields are those of the
// finer mesh.
typedef struct {
  SbDiffusionSteady steady;
  double error;    // estimated relative error of conductance and lag
  double flux_gap; // |flux_in - flux_out| divided by the conductance, finer mesh
} SbDiffusionConverged;

// Computes the steady results with their error. `section` is only read; its fields `end` are set,
// and sb_wetted_mesh_quarter() has not been called for it: this function calls it for copies.
// Errors as for sb_diffusion_create().
SbStatus sb_diffusion_converge(SbDiffusionConverged *out, const SbWettedMesh *section,
                               SbReport *report);
