// Mass, centre and moments of inertia of a part: a half-profile revolved, or a closed mesh.
//
// Profile: integrals over the area become integrals along its outline (Green), which Gauss points
// evaluate exactly on straight pieces and to rounding on arcs. Mesh: signed tetrahedra from the
// first vertex (divergence theorem), exact for the polyhedron. The same profile gives the diameters
// of groove, land and pressure. Anything that is not the outline of a body (open, crossing itself,
// inside out, across the axis) is refused by name. SI units.
#pragma once

#include "engine/base/status.h"

enum { SB_PROFILE_MAX = 512 };

// A point of a half-profile; `bulge` bends the piece to the next point: tan of a quarter of the
// arc's angle, > 0 turning left (counter-clockwise), 0 straight.
typedef struct {
  double x, r; // axial, radial (r >= 0), m
  double bulge;
} SbProfilePoint;

// Counter-clockwise in the (x, r) plane, material on the left. Closed by its own last piece back to
// the first point, unless first and last lie on the axis: then the axis closes it (the last bulge
// must be 0 in that case). The first point is not repeated.
typedef struct {
  const SbProfilePoint *point;
  size_t count;
  bool closed; // the maker says that it closes: an outline that is not, off the axis, is refused
} SbProfile;

typedef struct {
  double volume, mass;  // m3, kg
  double centre[3];     // m
  double inertia[3][3]; // about the centre, kg m2, ground axes (profile: x is the axis)
} SbSolid;

// Refuses an outline that bounds no body, naming the fault and the piece.
SbStatus sb_profile_check(const SbProfile *profile, SbReport *report);

// Properties of the body that the profile revolved about r = 0 bounds. density in kg/m3, > 0.
SbStatus sb_solid_revolve(SbSolid *solid, const SbProfile *profile, double density,
                          SbReport *report);

// Diameters between two places of a profile [m].
typedef struct {
  double smallest, largest; // of the outermost surface: groove floor, land
  double bore;              // smallest of the innermost surface; 0 where the part is solid
} SbProfileDiameters;

// SB_ERROR_RANGE if the part has nothing between x0 and x1.
SbStatus sb_profile_diameters(SbProfileDiameters *out, const SbProfile *profile, double x0,
                              double x1, SbReport *report);

// Properties of the body inside a closed mesh: vertices[3 n], triangles[3 m] of vertex indices,
// counter-clockwise seen from outside. Allocates and frees scratch of the order of the mesh.
// Triangles that share a vertex are not tested for crossing each other.
SbStatus sb_solid_mesh(SbSolid *solid, const double *vertices, size_t vertex_count,
                       const unsigned *triangles, size_t triangle_count, double density,
                       SbReport *report);
