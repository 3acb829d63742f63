// A rough surface as a nonlinear spring: mean pressure on the asperities and fraction of real
// contact as functions of the mean gap, for the film solvers. A table may be read by several
// threads; the functions have no state.
//
// The mean gap h is the volume of fluid per area between the surfaces, h > 0. By linear elasticity
// it is also the distance of the deformed mean planes, so it enters both Reynolds' equation and the
// deflection by the total pressure.
//
//   Greenwood and Tripp (greenwood_tripp.h): pressure and real area against lambda, the distance of
// the undeformed mean planes divided by sigma. h = sigma [lambda Phi(lambda) + phi(lambda)] = sigma
// F_1(-lambda) (Patir and Cheng, Trans. ASME J. Lubr. Technol. 100 (1978) 12, their average gap
// h_T), within 0.1 % of lambda sigma above lambda = 2.5. The real area pi^2 (zeta beta sigma)^2 F_2
// is limited to 1.
//   With `work` > 0 their tips adhere (asperity.h, radius beta/2, surfaces separating). p is then
// the elastic pressure; the attraction ("pull") is tabulated separately, so the load is p - pull.
// Both vanish at a gap that depends on the stretch of a tip.
//   Persson (persson.h): mean separation and real area against the pressure. With a percolation
// `threshold` the roughness obstructs the flow by the pressure flow factor phi_p (flow_factor.h),
// which is 0 from the threshold on; the table has a node there. Greenwood and Tripp's law, that of
// the thesis, has no threshold, and phi_p is 1.
//
// All are tabulated against a parameter t that decreases as the surfaces close: t = lambda, or p =
// p_1 ln(1 + exp(-t)). Gap and pressure vary smoothly with t from light to full contact, as
// Newton's method requires. Logarithms are interpolated by cubics with exact slopes (error below
// 1e-7) and extrapolated linearly.
#pragma once

#include "engine/contact/rough/asperity.h"

// Contact model of a rough surface.
typedef enum {
  SB_ROUGH_NONE,
  SB_ROUGH_GREENWOOD_TRIPP,
  SB_ROUGH_PERSSON,
  SB_ROUGH_COUNT
} SbRoughModel;

// What a contact model describes.
typedef struct {
  const char *name; // on the command line
  // Independent asperities, whose real contact follows from the distance of the surfaces: valid
  // while it is a small part of the area. Their tips may adhere (SbRoughSurface.work).
  bool asperities;
  // A spectrum of heights, whose real contact follows from the pressure: valid up to full contact,
  // so that channels between the surfaces can be computed.
  bool spectrum;
} SbRoughKind;

// A rough surface, with a smooth or rough counter-surface.
typedef struct {
  SbRoughModel model;
  double product;         // zeta beta sigma > 0
  double sigma;           // combined standard deviation of heights [m] > 0
  double sigma_over_beta; // sigma divided by the tip radius, > 0
  double modulus;         // E', 2/E' = sum (1 - nu^2)/E [Pa] > 0
  double work; // work of adhesion of the tips [J/m2] >= 0; 0: no adhesion; GREENWOOD_TRIPP only
  // Fraction of real contact at which the last channel closes, 0 to 1; 0: the roughness does not
  // obstruct the flow. PERSSON only.
  double threshold;
} SbRoughSurface;

// Capacity of the tables, and number of tabulated quantities.
enum { SB_ROUGH_NODES_MAX = 448, SB_ROUGH_QUANTITIES = 5 };

// Largest stretch of a tip of the smallest Tabor parameter divided by sigma; above it the surfaces
// adhere everywhere.
#define SB_ROUGH_STRETCH_MAX 60.0

// Tables of one surface; plain data, may be copied.
typedef struct {
  SbRoughSurface surface;
  SbAsperity tip;     // sb_rough_tip(surface) if work > 0, else zero
  int count;          // nodes
  double begin, step; // t of the first node; spacing
  // ln(h/sigma), -ln(p/E'), ln of the real area fraction (not limited), -ln(pull/E') (adhesion),
  // phi_p^(1/4) (threshold); derivatives with respect to t.
  double value[SB_ROUGH_QUANTITIES][SB_ROUGH_NODES_MAX];
  double slope[SB_ROUGH_QUANTITIES][SB_ROUGH_NODES_MAX];
} SbRoughLaw;

// State at one t.
typedef struct {
  double gap, gap_slope;           // h [m], dh/dt > 0
  double pressure, pressure_slope; // p [Pa], dp/dt < 0
  double pull, pull_slope;         // attraction of adhering tips [Pa]; 0 without
  double share, share_slope;       // fraction of real contact, at most 1; d/dt
  double flow, flow_slope;         // phi_p, 0 to 1; d/dt >= 0
} SbRoughPoint;

// Computes the tables (1 ms; 10 ms with adhering tips or a threshold). SB_ERROR_RANGE: a parameter
// is not positive, tips stretch too far, or the threshold is not in 0 to 1. SB_ERROR_INFEASIBLE: no
// random surface has this product (PERSSON). SB_ERROR_INPUT: SB_ROUGH_NONE, `work` < 0, or `work` >
// 0 with another model than GREENWOOD_TRIPP, or a threshold with another than PERSSON.
SbStatus sb_rough_law_init(SbRoughLaw *law, const SbRoughSurface *surface, SbReport *report);

// Returns whether all parameters of two surfaces are equal.
bool sb_rough_same_surface(const SbRoughSurface *a, const SbRoughSurface *b);

// Computes the tables like sb_rough_law_init(), with its errors. Copies the tables of `known`
// instead (NULL: none; may be `law` itself) if both surfaces have equal model, product, sigma,
// sigma_over_beta and threshold, and no adhesion; the modulus may differ.
SbStatus sb_rough_law_like(SbRoughLaw *law, const SbRoughSurface *surface, const SbRoughLaw *known,
                           SbReport *report);

// Computes the state at the parameter t.
void sb_rough_law_at(SbRoughPoint *out, const SbRoughLaw *law, double t);

// Returns the parameter t at a mean gap [m] > 0.
double sb_rough_law_of_gap(const SbRoughLaw *law, double gap);

// Returns the mean gap u* [m] at which the last channel closes; NaN without a threshold.
double sb_rough_law_closed_gap(const SbRoughLaw *law);

// Returns the parameter t at the pressure p [Pa] > 0.
double sb_rough_law_of_pressure(const SbRoughLaw *law, double pressure);

// Returns the parameter t at which pressure minus pull is `load` [Pa] > 0.
double sb_rough_law_of_load(const SbRoughLaw *law, double load);

// Returns the combined tip of a pair of asperities of a GREENWOOD_TRIPP surface.
SbAsperity sb_rough_tip(const SbRoughSurface *surface);

// Returns the fraction of real contact, at most 1, with the undeformed planes `lambda` sigma apart,
// of a GREENWOOD_TRIPP surface with or without adhesion; NaN where sb_gt_area_share() returns NaN.
double sb_rough_area_share(const SbRoughSurface *surface, double lambda);

// Van der Waals attraction between flat walls (Israelachvili; thesis equation 5.17 with the sign
// corrected, docs/thesis.md, 7): p = A_H/(6 pi h^3) per area, which adds to the load that film and
// asperities carry. Valid from the contact distance D0 = 0.165 nm, below which it is constant, to
// about 5 nm (retardation). Between rough surfaces it acts over the open area and gap
// (sb_rough_pull()).

// Returns the attraction [Pa] > 0 at the distance `gap` [m] for the Hamaker constant `hamaker` [J].
double sb_vdw_attraction(double hamaker, double gap);

// Returns the work of adhesion [J/m2] from contact, A_H/(12 pi D0^2).
double sb_vdw_work(double hamaker);

// Returns the total attraction [Pa] at a state of the law: that of the tips, plus van der Waals'
// (`hamaker` [J], 0: none) A_H/(6 pi d^3) over the open area 1 - share with the open gap d = h/(1 -
// share). Writes its derivative with respect to t to *slope.
double sb_rough_pull(double *slope, const SbRoughPoint *at, double hamaker);

// A lubricated contact with attraction.
typedef struct {
  double hamaker;   // A_H [J]; 0: none
  double modulus;   // E' [Pa]
  double width;     // 2 b [m]
  double viscosity; // [Pa s]
  double speed;     // magnitude of the sliding speed u [m/s]; 0: at rest
} SbSnapContact;

// Range of mean gaps [m] in which attraction closes a film. `high` 0: there is no such gap; `low`
// 0: the range extends down to contact.
typedef struct {
  double low, high;
} SbSnapWindow;

// Returns the gaps at which attraction closes a film on `law` (NULL: smooth surfaces).
//
// Where asperities minus attraction weaken as the gap opens, s = d(p_a - p_v)/dh > 0, the film is
// unstable (spinodal) for wave numbers k with E' k/4 < s. The fastest, k = 8 s/(3 E'), grows at the
// rate (h^3/12 eta) (64/27) s^3/E'^2. A gap is in the range if half a wave fits into the contact
// and the growth during the passage at u/2 exceeds e^10, as in the e^N rule of boundary layers. The
// steady equation of smooth films (A_H = 1e-20 to 1e-18 J) has solutions up to N of about 100 and
// none above 600.
SbSnapWindow sb_rough_snap_in(const SbRoughLaw *law, const SbSnapContact *contact);

// Returns what a model describes; of an unknown number that of SB_ROUGH_NONE, which has neither
// asperities nor a spectrum. Static.
const SbRoughKind *sb_rough_kind(SbRoughModel model);

// Returns the name of a model on the command line ("none", "greenwood-tripp", "persson"); static,
// never NULL.
const char *sb_rough_model_name(SbRoughModel model);

// Finds the model with this name. Returns false if there is none; *out is unchanged then.
SB_CHECKED bool sb_rough_model_from_name(SbRoughModel *out, const char *name);
