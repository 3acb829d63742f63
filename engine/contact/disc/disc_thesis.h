// The thesis' own linear disc ("current analysis" of tables 7.2 to 7.4), repaired where it was
// wrong.
//
// The ring is stretched to the fitted mean diameter and its section shrinks by nu eps_z (6.4.1).
// The section is a plane-strain disc under opposite vertical load pairs at nodes one degree apart
// (6.71 with the sign of its shear repaired, in closed form instead of summed elements), squeezed
// until each loaded node lies on the bore; a node with negative pressure is dropped, an overlapped
// one added (6.73), met here as a complementarity problem and not by relaxation. Canister pressure
// acts as horizontal force pairs on both flanks outside the contact (6.4.2), p R dbeta per arc. The
// thesis leaves open how exactly; this reading is the one that fits its nine cases best
// (docs/verification.md): loads within 2 %, peaks within 1 %, width within a node.
//
// The width is printed by the thesis as d sin(n + 1/2 deg) with the free d: quantised to 0.023 mm.
// It leaves out the groove wall, that fluid acts normally, and finite strain; against a
// finite-strain ring its pressurised loads are 8-9 % low and its widths 7-20 % high.
#pragma once

#include "engine/base/status.h"

typedef struct {
  double section_diameter; // d, free [m]
  double section_fitted;   // after stretch [m]
  double radial_space;     // g [m]
  double modulus;          // E [Pa]
  double poisson_ratio;    // nu [-]
  double pressure;         // on both flanks [Pa], at least 0
} SbDiscThesisInput;

// Nodes on one side of the centre, at most (the centre included).
enum { SB_DISC_THESIS_NODES = 160 };

typedef struct {
  bool touches;
  size_t nodes;                          // loaded ones from the centre outwards
  double step;                           // angle between nodes [rad]
  double contact_width;                  // [m]
  double load_per_length;                // [N/m]
  double pressure_peak;                  // [Pa]
  double pressure[SB_DISC_THESIS_NODES]; // at nodes 0, 1, ... [Pa]
  size_t iterations;                     // trial contact sets
} SbDiscThesis;

// Solves with nodes `step` apart: pi/180 is the thesis' scheme. SB_ERROR_RANGE for sizes that are
// not physical; SB_ERROR_NOT_CONVERGED if no set of nodes within 75 degrees satisfies all
// conditions. A disc smaller than the space does not touch: SB_OK, zeros, warning "no-contact".
// Warns "disc-strain" beyond 10 % squeeze of the fitted section.
SbStatus sb_disc_thesis(SbDiscThesis *out, const SbDiscThesisInput *in, double step,
                        SbWarnings *warnings, SbReport *report);
