// Section shapes of a ring: named profiles, drawn ones, and their outlines. The functions have no
// state and may be called concurrently.
//
// An outline is a closed sequence of lines and arcs, counter-clockwise in (r, z), z axial. It
// begins where it crosses z = 0 at the smallest radius (floor side), continues over the left flank
// (z < 0) to z = 0 at the largest radius (bore side), and returns over the right flank. Positions
// on it are given by arc length or by the material angle of ring_mesh.h: -pi at the beginning, 0 at
// the bore side, proportional to arc length on each half.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/inputs.h"

#include <stdbool.h>

// Kind of a section.
typedef enum {
  SB_SEAL_PROFILE_CIRCLE, // the seven names are those of sb_seal_profile_name()
  SB_SEAL_PROFILE_RECTANGLE,
  SB_SEAL_PROFILE_X,
  SB_SEAL_PROFILE_D,
  SB_SEAL_PROFILE_T,
  SB_SEAL_PROFILE_LIP,
  SB_SEAL_PROFILE_FILE, // drawn: SbSealProfile.drawn
  SB_SEAL_PROFILE_COUNT
} SbSealProfileKind;

// Largest number of points of a drawn section.
enum { SB_SEAL_POINTS_MAX = 64 };

// A point of a drawn section, in units of its radial height: r from its middle, -0.5 to 0.5, z from
// its axial middle. `bulge` describes the piece to the next point: tan(angle/4) of an arc, > 0
// counter-clockwise; 0: straight.
typedef struct {
  double r, z, bulge;
} SbSealPoint;

// A drawn section: closed, counter-clockwise in (r, z).
typedef struct {
  int count; // points; 0: none
  SbSealPoint point[SB_SEAL_POINTS_MAX];
} SbSealDrawing;

// A section. {0}: a circle. Lengths are in any unit; functions get the radial height in this unit.
// With SbRingBody, SbFitProblem and SbGland the unit is 1 m and the height their section_diameter.
typedef struct {
  SbSealProfileKind kind;
  double axial_height; // axial extent; not of circle and x, whose extent is their height
  // Radius of all corners; x: of its lobes; lip: at most half the tip's thickness; file: between
  // two straight sides.
  double corner_radius;
  double valley_depth;  // x: depth of the valleys between its lobes
  double web_width;     // t: axial width of the web at the bore
  double flange_height; // t: radial height of the flange at the floor
  double lip_thickness; // lip: radial thickness of both lips at their tips
  double lip_depth;     // lip: axial depth of the groove between them, which opens to the left
  double lip_flare;     // lip: radial distance by which each lip extends beyond the heel
  SbSealDrawing drawn;  // file
} SbSealProfile;

// Returns the name of a kind ("circle", "rectangle", "x", "d", "t", "lip", "file"); static. NULL
// for an invalid one.
const char *sb_seal_profile_name(SbSealProfileKind kind);

// A piece of an outline: a line (radius 0) or an arc around `centre`.
typedef struct {
  double from[2], to[2];                  // end points (r, z)
  double centre[2], radius, angle, sweep; // arc: start angle and signed angle [rad]
  double at, length;                      // arc length at its start; its own length
} SbRingOutlinePart;

// Largest number of pieces.
enum { SB_RING_OUTLINE_MAX = 2 * SB_SEAL_POINTS_MAX + 2 };

// An outline in units of the radial height; r from the section's middle, -0.5 to 0.5.
typedef struct {
  int count;
  SbRingOutlinePart part[SB_RING_OUTLINE_MAX];
  double length;   // of the full outline
  double bore;     // arc length at which it crosses z = 0 on the bore side
  double area;     // enclosed
  double centroid; // r of the area's centroid
  double half;     // half of the axial extent
} SbRingOutline;

// Computes the outline of a section. `height` is the radial height in the unit of the lengths of
// `profile` (1 if these are divided by the radial height). SB_ERROR_RANGE, SB_ERROR_INFEASIBLE: the
// sizes are inconsistent; the report has the input (SB_CONTACT_IN_...).
SbStatus sb_ring_outline_of_profile(SbRingOutline *out, const SbSealProfile *profile, double height,
                                    SbReport *report);

// Returns in *area the area divided by height^2 and in *centroid the radius of its centroid from
// the section's middle divided by `height`; those of the circle if the section has no outline.
void sb_seal_profile_area(double *area, double *centroid, const SbSealProfile *profile,
                          double height);

// Returns whether parts of the section may bend, so that the full section needs small elements.
static inline bool sb_ring_bends(const SbSealProfile *profile) {
  return profile->kind == SB_SEAL_PROFILE_T || profile->kind == SB_SEAL_PROFILE_LIP ||
         profile->kind == SB_SEAL_PROFILE_FILE;
}

// Returns whether the outline is not symmetric in z, by more than 1e-6.
bool sb_ring_outline_has_sides(const SbRingOutline *outline);

// Writes the point (r, z) at the arc length `arc` (0 to length) to x[2].
void sb_ring_outline_place(const SbRingOutline *outline, double arc, double x[2]);

// Returns the material angle [rad] at an arc length.
double sb_ring_outline_angle(const SbRingOutline *outline, double arc);

// Returns the arc length at a material angle [rad]; angles are periodic.
double sb_ring_outline_arc(const SbRingOutline *outline, double angle);
