// A rough surface as a spring: mean pressure on the asperities and share of real contact as
// functions of the mean gap, in the form that the mixed-film solver needs.
//
// The mean gap h is the fluid's volume per area between the surfaces. It cannot be negative, and by
// linear elasticity it is also the distance of the mean planes after deformation, so the same h
// enters Reynolds' equation and the deflection by the total pressure.
//
//   Greenwood and Tripp (greenwood_tripp.h) give pressure and real area against lambda, the
//   distance of the undeformed mean planes over sigma. With the overlap cut off, the gap left is
//   h = sigma [lambda Phi(lambda) + phi(lambda)] = sigma F_1(-lambda) (Patir and Cheng, Trans. ASME
//   J. Lubr. Technol. 100 (1978) 12, their average gap h_T), within 0.1 % of lambda sigma above
//   lambda = 2.5. Pressing on closes the gap but never makes it negative. The real area pi^2
//   (zeta beta sigma)^2 F_2 is limited to the nominal: the share stays at 1 where it would pass it.
//   Greenwood and Tripp's tips may stick (`work` > 0): the same pairs with the laws of asperity.h,
//   radius beta/2, as the surfaces separate. p is then Hertz's on the contacts held open by the
//   stick, the pull is tabled beside it, and both go to nothing as far beyond h as a tip stretches.
//   With w -> 0 it is Greenwood and Tripp.
//   Persson (persson.h) gives the mean separation and the real area against the pressure.
//
// All are tabled against a parameter t that falls as the surfaces close: t = lambda, or p = p_1
// ln(1 + exp(-t)). Pressure and gap both change gently with t over the whole range, light touch to
// full contact, which is what makes Newton's method on t dependable. Logarithms are interpolated by
// cubics with exact slopes (error below 1e-7); beyond the ends the gap (light end: itself, closed
// end: its logarithm) and the logarithm of the pressure are continued straight.
#pragma once

#include "engine/contact/rough/asperity.h"

typedef enum {
  SB_ROUGH_NONE,
  SB_ROUGH_GREENWOOD_TRIPP,
  SB_ROUGH_PERSSON,
  SB_ROUGH_COUNT
} SbRoughModel;

typedef struct {
  SbRoughModel model;
  double product;         // zeta beta sigma > 0
  double sigma;           // combined standard deviation of heights [m] > 0
  double sigma_over_beta; // > 0
  double modulus;         // E', 2/E' = sum (1 - nu^2)/E [Pa] > 0
  double work;            // of adhesion of the tips [J/m2] >= 0; Greenwood and Tripp's only
} SbRoughSurface;

enum { SB_ROUGH_NODES_MAX = 448, SB_ROUGH_QUANTITIES = 4 };

// How far tips of the least Tabor parameter may stretch over sigma; beyond, no heights hold the
// surfaces apart and nothing here describes the contact.
#define SB_ROUGH_STRETCH_MAX 60.0

// Tables of one surface; plain data.
typedef struct {
  SbRoughSurface surface;
  SbAsperity tip; // of a pair, where they stick
  int count;
  double begin, step; // t of the first node, spacing
  // ln(h/sigma), -ln(p/E'), ln of the real area over the nominal, not yet limited, -ln(pull/E') of
  // tips that stick; their slopes to t.
  double value[SB_ROUGH_QUANTITIES][SB_ROUGH_NODES_MAX];
  double slope[SB_ROUGH_QUANTITIES][SB_ROUGH_NODES_MAX];
} SbRoughLaw;

// One point of the law.
typedef struct {
  double gap, gap_slope;           // h [m], dh/dt > 0
  double pressure, pressure_slope; // p [Pa], dp/dt < 0
  double pull, pull_slope;         // of tips that stick [Pa]; 0 without
  double share, share_slope;       // real area over nominal, at most 1; its slope to t
} SbRoughPoint;

// Builds the tables (about a millisecond; ten with tips that stick). SB_ERROR_RANGE for a figure
// that is not positive or tips that stretch too far, SB_ERROR_INFEASIBLE where no random surface
// has the product (Persson only), SB_ERROR_INPUT for a model without asperities or without tips
// that could stick.
SbStatus sb_rough_law_init(SbRoughLaw *law, const SbRoughSurface *surface, SbReport *report);

bool sb_rough_same_surface(const SbRoughSurface *a, const SbRoughSurface *b);

// The same from a law, which may be *law, whose tables serve: heights are the same and no tip
// sticks, so that tables over the modulus do not know it; else, or without one (NULL), anew.
SbStatus sb_rough_law_like(SbRoughLaw *law, const SbRoughSurface *surface, const SbRoughLaw *known,
                           SbReport *report);

// The law at parameter t.
void sb_rough_law_at(SbRoughPoint *out, const SbRoughLaw *law, double t);

// Parameter at a mean gap [m] > 0, at a pressure [Pa] > 0, and where the pressure less the tips'
// pull is that of a load [Pa] > 0.
double sb_rough_law_of_gap(const SbRoughLaw *law, double gap);
double sb_rough_law_of_pressure(const SbRoughLaw *law, double pressure);
double sb_rough_law_of_load(const SbRoughLaw *law, double load);

// Tip of a pair of Greenwood and Tripp's surface.
SbAsperity sb_rough_tip(const SbRoughSurface *surface);

// Real over nominal area, at most 1, with the undeformed planes `lambda` sigma apart, of Greenwood
// and Tripp's surface whose tips may stick; NaN where sb_gt_area_share() refuses lambda.
double sb_rough_area_share(const SbRoughSurface *surface, double lambda);

// Van der Waals attraction between two flat walls, with a stated cut-off and sign.
//
// Source: Israelachvili; thesis equation 5.17 with the sign mended (docs/thesis.md, 7): the walls
// pull each other with p = A_H/(6 pi h^3) per unit area, which ADDS to the load that film and
// asperities carry. The law holds between the contact distance D0 = 0.165 nm (Israelachvili's
// cut-off; closer, the bodies touch and the pull is held at its value there) and some 5 nm (beyond,
// retardation weakens it further). Between rough surfaces it acts over the open part of the area
// and across the gap that is open there (sb_rough_pull).

// Attraction [Pa], positive, at distance `gap` [m] for Hamaker constant `hamaker` [J].
double sb_vdw_attraction(double hamaker, double gap);

// Its work of adhesion [J/m2] from contact on, A_H/(12 pi D0^2).
double sb_vdw_work(double hamaker);

// Pull [Pa] at a point of the law and its slope to t: of the tips, and van der Waals' (`hamaker`,
// 0: none) A_H/(6 pi d^3) over the part of the area that is open, across the gap that is open
// there, d = h/(1 - share).
double sb_rough_pull(double *slope, const SbRoughPoint *at, double hamaker);

// A lubricated contact that pull may close.
typedef struct {
  double hamaker;   // [J]
  double modulus;   // E' [Pa]
  double width;     // 2 b [m]
  double viscosity; // [Pa s]
  double speed;     // sliding, [m/s]; 0 at rest
} SbSnapContact;

// Mean gaps [m] between which pull closes a film; high 0: none, low 0: to the end.
typedef struct {
  double low, high;
} SbSnapWindow;

// Gaps at which pull, van der Waals' or of tips that stick, closes a film on `law` (NULL: smooth
// surfaces).
//
// Where asperities less pull give way as the gap opens, s = d(p_a - p_v)/dh > 0, the film equation
// is one of negative diffusion (spinodal) for waves k that the half-plane does not hold, E' k/4 <
// s. The fastest, k = 8 s/(3 E'), grows at (h^3/12 eta) (64/27) s^3/E'^2. Such a gap is inside the
// window where half a wave fits the contact and the growth over the passage at u/2 exceeds e^10, as
// in the e^N rule of boundary layers: below it disturbances leave the contact before they matter.
// Measured on smooth films, A_H = 1e-20 to 1e-18 J: the steady equation keeps its solution to N of
// some 100 and has none from some 600.
SbSnapWindow sb_rough_snap_in(const SbRoughLaw *law, const SbSnapContact *contact);

// Name on the command line ("none", "greenwood-tripp", "persson"); borrowed, never NULL.
const char *sb_rough_model_name(SbRoughModel model);

// The model of that name; false if there is none.
SB_CHECKED bool sb_rough_model_from_name(SbRoughModel *out, const char *name);
