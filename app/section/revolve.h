// Bodies of revolution with a quarter cut away, seen by an orbiting camera, in the order in which
// they must be painted (back to front).
//
// Outlines (z along the axis, r from it) are revolved about the axis from 45 to 315 degrees; the
// quarter about angle 0 is open and shows two cut faces. The projection is orthographic. The order
// between sectors is exact: all lines of sight are parallel, so seen along the axis they only
// approach the camera's own angle, and a sector hides what is at a larger angle from it. Within a
// sector (5 degrees) only the plane of the outlines matters; there each piece is painted after all
// that it hides.
//
// Usage: sb_revolve_begin(), sb_revolve_add() for each body, sb_revolve_build(), then paint `step`.
#pragma once

#include "app/section/valve.h"

#include <glib.h>

enum {
  SB_REVOLVE_SECTORS = 54, // of the three quarters
  SB_REVOLVE_FACES = 2     // at +45 and -45 degrees
};

// The camera: unit vectors of the picture to the right, up, and towards the camera. Components: [0]
// along the axis, [1] towards the middle of the open quarter, [2] at angle +90 degrees from that.
typedef struct {
  double right[3], up[3], toward[3];
} SbOrbit;

// Returns the camera with this azimuth about the picture's vertical, from the front and positive
// towards the end of the rod, and this elevation above the horizontal [rad]. At 0, 0 the axis is
// horizontal in the picture, with the canister on the left, and the open quarter faces the front
// and somewhat up.
SbOrbit sb_orbit(double azimuth, double elevation);

// The bodies of a valve.
typedef enum {
  SB_REVOLVE_HOUSING,
  SB_REVOLVE_STEM,
  SB_REVOLVE_OUTER, // seal
  SB_REVOLVE_INNER,
  SB_REVOLVE_COUNT
} SbRevolveBody;

// A visible piece of surface with four corners.
typedef struct {
  float x[4], y[4]; // in the picture [px], y downwards
  float depth[4];   // position towards the camera [m]
  float shade[4];   // brightness, 0 to 1
  SbRevolveBody solid;
} SbRevolveCell;

// A piece of an edge, from (x[0], y[0]) to (x[1], y[1]) [px]. (out_x, out_y) is for a silhouette
// the unit vector away from its body: the line must be on that side, because later cells of the
// body may begin a pixel next to it. For other edges it is zero.
typedef struct {
  float x[2], y[2], out_x, out_y;
} SbRevolveEdge;

// What a step paints.
typedef enum { SB_REVOLVE_CELLS, SB_REVOLVE_EDGES, SB_REVOLVE_FACE } SbRevolveKind;

// One step of painting: `count` elements of `cell` or `edge` from index `first` on, or the cut face
// number `first`.
typedef struct {
  SbRevolveKind kind;
  size_t first, count;
} SbRevolveStep;

// A picture. Initialised by sb_revolve_init(), freed by sb_revolve_finish(); the arrays are reused.
typedef struct {
  SbOrbit orbit;
  double scale, x0, y0;           // [px/m], and the pixel of the origin
  GArray *segment;                // of the outlines; private
  GArray *cell;                   // SbRevolveCell
  GArray *edge;                   // SbRevolveEdge
  GArray *step;                   // SbRevolveStep, back to front
  GArray *facing, *piece, *place; // work space
} SbRevolve;

// Initialises an empty picture.
void sb_revolve_init(SbRevolve *revolve);

// Frees the arrays.
void sb_revolve_finish(SbRevolve *revolve);

// Starts a picture without bodies, with `scale` pixels per metre and the origin at pixel (x0, y0).
void sb_revolve_begin(SbRevolve *revolve, const SbOrbit *orbit, double scale, double x0, double y0);

// Adds a body by its outline point[count]: x is z along the axis, y is r >= 0 [m],
// counter-clockwise with r upwards, closed by its first point. A smooth outline is shaded
// continuously; others have edges at their corners.
void sb_revolve_add(SbRevolve *revolve, SbRevolveBody solid, const SbValvePoint *point,
                    size_t count, bool smooth);

// Computes cells, edges and steps of all bodies.
void sb_revolve_build(SbRevolve *revolve);

// Returns the angle of a cut face, 0 or 1 [rad].
double sb_revolve_face_angle(int face);

// Returns the volume that the surface cells of a body enclose with its cut faces [m3], for tests.
double sb_revolve_volume(const SbRevolve *revolve, SbRevolveBody solid);
