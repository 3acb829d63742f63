// Van der Waals attraction between two flat walls, with a stated cut-off and sign.
//
// Source: Israelachvili; thesis equation 5.17 with the sign mended (docs/thesis.md, 7): the walls
// pull each other with p = A_H/(6 pi h^3) per unit area, which ADDS to the load that film and
// asperities carry. The law holds between the contact distance D0 = 0.165 nm (Israelachvili's
// cut-off; closer, the bodies touch and the pull is held at its value there) and some 5 nm (beyond,
// retardation weakens it further). Between rough surfaces it acts over the open part of the area
// and across the gap that is open there (sb_rough_pull).
#pragma once

// Cut-off distance [m].
#define SB_VDW_CUTOFF 0.165e-9

// Attraction [Pa], positive, at distance `gap` [m] for Hamaker constant `hamaker` [J].
double sb_vdw_attraction(double hamaker, double gap);

// Its derivative with respect to the gap [Pa/m]; 0 below the cut-off.
double sb_vdw_slope(double hamaker, double gap);
