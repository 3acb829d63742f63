// Linear plane-strain disc squeezed between two rigid frictionless flats, with fluid pressure on
// its flanks and, where the pressures differ, a flat groove wall on the side of the lower one.
//
// A boundary method: the contact pressure is expanded in Chebyshev polynomials over the contact,
// the closed-form kernels of disc_kernel.h are integrated with their logarithm exactly, and the
// edges of the contacts are unknowns. Unilateral contact is met in its smooth form: no penetration
// inside, the pressure above the fluid's, and at an edge continuous with the fluid's (no
// singularity); Newton on the edges. Both signs are checked afterwards. Convergence is spectral.
//
// Kinematics (a linear disc at finite squeeze is an estimate and must say which): the traction
// acts per horizontally projected width and the surface moves vertically onto the flat ("vertical",
// depends on nu only through 1 - nu^2), or both are radial ("radial", Hertz and Michell). The gap
// is the circle's exactly. Against finite strain at 15.5 % squeeze: load -11 % and -1.4 %, width -9
// % and +5 %, peak -5 % and -7 % (docs/verification.md).
//
// Fluid acts normally on the open arcs up to the contact edges of the undeformed circle. The disc
// leans on the wall, which touches it before the pressure comes, and slides frictionless. It leaves
// out: stretch (the caller shrinks the section), finite strain, housing compliance, friction, the
// gap beside the land.
#pragma once

#include "engine/base/status.h"

// enumerator, name
#define SB_DISC_VARIANT_LIST(X)                                                                    \
  X(SB_DISC_VERTICAL, "vertical")                                                                  \
  X(SB_DISC_RADIAL, "radial")

typedef enum {
#define SB_DISC_VARIANT_ENUM(code, text) code,
  SB_DISC_VARIANT_LIST(SB_DISC_VARIANT_ENUM)
#undef SB_DISC_VARIANT_ENUM
      SB_DISC_VARIANT_COUNT
} SbDiscVariant;

typedef struct {
  SbDiscVariant variant;
  double diameter;       // of the section [m]
  double space;          // between the flats [m]
  double modulus;        // E [Pa]
  double poisson_ratio;  // nu [-]
  double pressure_left;  // on the flank x < 0 [Pa]
  double pressure_right; // on the flank x > 0 [Pa]
  double tolerance;      // relative, of load, peak and width; 0: 1e-3
} SbDiscProblem;

// Chebyshev points over a contact, at most.
enum { SB_DISC_POINTS_MAX = 48 };

typedef struct {
  SbDiscProblem problem;
  bool touches;
  bool converged;
  size_t points;            // Chebyshev points over the contact with a flat
  size_t unknowns;          // of the last linear system, edges included
  size_t newton_iterations; // over all resolutions
  double contact_left;      // [m], x of the edges; 0 at the section's centre before pressure
  double contact_right;     // [m]
  double contact_width;     // [m]
  double load_per_length;   // total pressure over the contact [N/m], the fluid's share included
  double pressure_peak;     // [Pa]
  double shift;             // of the section's centre to +x by the pressure on the wall [m]
  double wall_half_width;   // of the contact with the groove wall [m], 0 without
  double wall_load;         // on the groove wall, over the outer fluid pressure [N/m]
  struct {
    double load, pressure_peak, contact_width; // relative, discretisation and iteration
  } error_estimate;
  // The solution: edges as sines on the disc (x/R, before the shift) and, at the Chebyshev points
  // tau_j = cos((j + 1/2) pi/points), the excess pressure times C sqrt(1 - tau^2) and half-width/R.
  double edge_left, edge_right, edge_wall;
  double excess[SB_DISC_POINTS_MAX];
  double wall_excess[SB_DISC_POINTS_MAX];
  size_t wall_points;
  bool mirrored; // solved with left and right exchanged
} SbDisc;

// Solves for the contact. A disc smaller than the space does not touch: SB_OK, zeros and the
// warning "no-contact". Warns "disc-strain" beyond 10 % squeeze (linear elasticity) and
// "disc-pressure" if the pressure difference exceeds a quarter of E. SB_ERROR_RANGE for input that
// is not physical, SB_ERROR_NOT_CONVERGED with the last good state (a smaller pressure or a coarser
// resolution) in `out`. About 0.2 ms without pressure difference, 2 ms with.
SbStatus sb_disc_solve(SbDisc *out, const SbDiscProblem *problem, SbWarnings *warnings,
                       SbReport *report);

// Total contact pressure [Pa] at x [m] from the section's centre before pressure; outside the
// contact the fluid's.
double sb_disc_pressure(const SbDisc *disc, double x);
