// Free sections of a ring that are not circles: named profiles, drawn ones, and the outline that
// they make.
//
// An outline is a closed row of lines and arcs, counter-clockwise in (r, z), of straight or smooth
// joints. It begins where it crosses z = 0 at the least radius (the floor's side), runs over the
// left flank (z < 0) to where it crosses z = 0 at the greatest radius (the bore's side) and back
// over the right one. Places on it are told by the material angle of ring_mesh.h: -pi at its
// beginning, 0 at the bore's side, in proportion to the arc on each half.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>

typedef enum {
  SB_SEAL_PROFILE_CIRCLE,
  SB_SEAL_PROFILE_RECTANGLE,
  SB_SEAL_PROFILE_X,
  SB_SEAL_PROFILE_D,
  SB_SEAL_PROFILE_T,
  SB_SEAL_PROFILE_LIP,
  SB_SEAL_PROFILE_FILE, // drawn: SbSealProfile.drawn
  SB_SEAL_PROFILE_COUNT
} SbSealProfileKind;

enum { SB_SEAL_POINTS_MAX = 64 };

// A section as somebody drew it, in units of its radial height: r from its middle radially,
// -0.5 .. 0.5, z from its middle axially, which is its mirror plane if it has one. Closed,
// counter-clockwise in (r, z). `bulge` bends the piece to the next point: tan of a quarter of the
// arc's angle, > 0 counter-clockwise.
typedef struct {
  double r, z, bulge;
} SbSealPoint;

typedef struct {
  int count; // 0: there is none
  SbSealPoint point[SB_SEAL_POINTS_MAX];
} SbSealDrawing;

// A named profile; lengths in one unit with the section's radial height, which the caller has.
// Zero-initialised: a circle.
typedef struct {
  SbSealProfileKind kind;
  double axial_height;  // axial extent; not of circle and x, which are as high as wide
  double corner_radius; // of all corners; of x its lobes; of lip half the tip's thickness at most;
                        // of a drawn section those between two straight sides
  double valley_depth;  // x: of the hollows between its lobes
  double web_width;     // t: axial width of the web that touches the bore
  double flange_height; // t: radial height of the flange on the floor
  double lip_thickness; // lip: radial thickness of both lips at their tips
  double lip_depth;     // lip: axial depth of the hollow between them, open to the left
  double lip_flare;     // lip: radial reach of each lip beyond the heel
  SbSealDrawing drawn;  // file
} SbSealProfile;

// Name of a kind ("rectangle"); NULL outside the enumeration.
const char *sb_seal_profile_name(SbSealProfileKind kind);

// A line (radius 0) or an arc about a centre, counter-clockwise for sweep > 0.
typedef struct {
  double from[2], to[2]; // (r, z)
  double centre[2], radius, angle, sweep;
  double at, length; // arc from the outline's beginning, own length
} SbRingOutlinePart;

enum { SB_RING_OUTLINE_MAX = 2 * SB_SEAL_POINTS_MAX + 2 };

// In units of the section's radial height; r from the section's middle, -0.5 .. 0.5.
typedef struct {
  int count;
  SbRingOutlinePart part[SB_RING_OUTLINE_MAX];
  double length;   // of the whole
  double bore;     // arc at which it crosses z = 0 at the bore's side
  double area;     // [L^2]
  double centroid; // radius of the area's centroid
  double half;     // half of the axial extent
} SbRingOutline;

// The outline of a profile of a radial height `height`. SB_ERROR_RANGE or SB_ERROR_INFEASIBLE with
// the catalogue key where its sizes make none.
SbStatus sb_ring_outline_of_profile(SbRingOutline *out, const SbSealProfile *profile, double height,
                                    SbReport *report);

// Area over the height's square and the radius of its centroid from the section's middle over the
// height; those of the circle where the profile makes no outline.
void sb_seal_profile_area(double *area, double *centroid, const SbSealProfile *profile,
                          double height);

// Whether parts of the section may bend: their stiffness hangs on the elements everywhere.
static inline bool sb_ring_bends(const SbSealProfile *profile) {
  return profile->kind == SB_SEAL_PROFILE_T || profile->kind == SB_SEAL_PROFILE_LIP ||
         profile->kind == SB_SEAL_PROFILE_FILE;
}

// Whether its mirror image in z = 0 is another one, by more than 1e-6.
bool sb_ring_outline_has_sides(const SbRingOutline *outline);

// Place of an arc from the beginning, 0 .. length.
void sb_ring_outline_place(const SbRingOutline *outline, double arc, double x[2]);

// Material angle of an arc and back; angles beyond -pi .. pi go on round.
double sb_ring_outline_angle(const SbRingOutline *outline, double arc);
double sb_ring_outline_arc(const SbRingOutline *outline, double angle);
