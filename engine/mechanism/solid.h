// Mass, centre and moments of inertia of a part: a half-section revolved about the axis, or a
// closed triangle mesh. Also the diameters of a revolved part.
//
// Half-sections: area integrals are converted to integrals along the outline (Green), by Gauss
// points; exact on straight pieces, to rounding on arcs. Meshes: signed tetrahedra (divergence
// theorem), exact for the polyhedron. The functions have no state and may be called concurrently.
#pragma once

#include "engine/base/status.h"
#include "engine/numeric/arc.h"

// Largest number of points of a half-section.
enum { SB_PROFILE_MAX = 512 };

// A point of a half-section. `bulge` describes the piece to the next point: tan(angle/4) of an arc,
// > 0 if it turns left (counter-clockwise); 0: straight.
typedef struct {
  double x, r; // axial, radial (r >= 0), m
  double bulge;
} SbProfilePoint;

// A half-section in the (x, r) plane, counter-clockwise, so the material is on the left of the
// direction of travel. If the first and the last point are on the axis, the axis closes the
// outline, and the last bulge must be 0. Else `closed` must be true: the piece of the last point
// leads to the first point, which is not repeated.
typedef struct {
  const SbProfilePoint *point; // [count], borrowed
  size_t count;                // 2 to SB_PROFILE_MAX
  bool closed; // the outline is closed by the last piece; if false, it must start and end on the
               // axis
} SbProfile;

// Properties of a body.
typedef struct {
  double volume, mass;  // [m3], [kg]
  double centre[3];     // of mass [m]; profile: x is the axis
  double inertia[3][3]; // tensor about the centre of mass, axes of the coordinates [kg m2]; off the
                        // diagonal minus the products of inertia
} SbSolid;

// Returns piece `index` of an outline, from its point of this index to the next one; y is r [m].
SbPiece sb_profile_piece(const SbProfile *profile, size_t index);

// Returns the area [m2] in an outline of at least 2 points, which need not be counter-clockwise:
// then the area is negative.
double sb_profile_area(const SbProfile *profile);

// Returns whether an outline is inside of another one, which it may touch: about 16 points of its
// area, near its pieces, are. Both satisfy sb_profile_check().
bool sb_profile_encloses(const SbProfile *outer, const SbProfile *inner);

// Checks an outline. SB_ERROR_INPUT: it does not bound a body (open, crosses itself, clockwise,
// below the axis, zero area); the report names the fault and the piece (counted from 0).
SbStatus sb_profile_check(const SbProfile *profile, SbReport *report);

// Computes the body of a revolved half-section. `density` [kg/m3]; SB_ERROR_RANGE if it is not
// above 0. SB_ERROR_INPUT as for sb_profile_check().
SbStatus sb_solid_revolve(SbSolid *solid, const SbProfile *profile, double density,
                          SbReport *report);

// Removes `hole`, a part of `body` in the same coordinates and of the same density, from it.
void sb_solid_remove(SbSolid *body, const SbSolid *hole);

// Diameters of a revolved part within a range of x [m].
typedef struct {
  double smallest, largest; // smallest and largest diameter of the outer surface, such as groove
                            // floor and land
  double bore;              // smallest diameter of the inner surface; 0 if the part is solid there
} SbProfileDiameters;

// Computes the diameters between x0 and x1 [m]. SB_ERROR_RANGE: x1 <= x0, or the part is not in
// this range. SB_ERROR_INPUT as for sb_profile_check().
SbStatus sb_profile_diameters(SbProfileDiameters *out, const SbProfile *profile, double x0,
                              double x1, SbReport *report);

// Writes the unit vector of the axis about which a body is closest to a body of revolution;
// `inertia` is its tensor (SbSolid). The asymmetry of an axis is the difference of the two moments
// across it divided by their sum, including the products of inertia. The result is the coordinate
// axis with the smallest asymmetry. If that exceeds 2 %, or a tenth of the asymmetry of the second
// best principal axis, and a principal axis has less than 2 % and less than a tenth of it, it is
// this principal axis. The largest component of the result is positive. Returns whether the axis is
// unique: false if the second best principal axis has less than 2 % too, and not ten times that of
// the best one, as in a ball.
bool sb_solid_axis(double axis[3], const double inertia[3][3]);

// Orients the triangles of a mesh. A part is a set of triangles that are connected by edges of
// exactly two triangles. A closed part within an odd number of others is a cavity of the innermost
// of them and is oriented inwards, any other closed part outwards, however the file has them. The
// triangles of an open part get the orientation that most of its area has. A mesh of more than 1000
// parts is not changed. *turned receives the number of triangles that were reversed; body[count],
// unless NULL, a number below `count` for each triangle, equal for those of a part and its
// cavities, and for those of all open parts. triangles[count][3] has vertex numbers, vertices[][3]
// the positions (x, y, z) of the vertices, in any unit. SB_ERROR_INPUT: `count` is 0.
SbStatus sb_mesh_orient(size_t *turned, size_t *body, unsigned *triangles, size_t count,
                        const double *vertices, SbReport *report);

// Computes the body of a closed mesh with vertices[vertex_count][3] (x, y, z) [m] and
// triangles[triangle_count][3] of vertex numbers, counter-clockwise seen from outside.
// SB_ERROR_RANGE: `density` [kg/m3] is not above 0. SB_ERROR_INPUT: the mesh is not a closed
// surface, or inside out. Triangles that share a vertex are not tested for intersections.
SbStatus sb_solid_mesh(SbSolid *solid, const double *vertices, size_t vertex_count,
                       const unsigned *triangles, size_t triangle_count, double density,
                       SbReport *report);

// As sb_solid_mesh(), but no triangles are tested for intersections: for a mesh whose vertices are
// on a surface that does not cross itself, where small triangles may overlap.
SbStatus sb_solid_integrate(SbSolid *solid, const double *vertices, size_t vertex_count,
                            const unsigned *triangles, size_t triangle_count, double density,
                            SbReport *report);
