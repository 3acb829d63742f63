// Bodies of revolution with a quarter cut away, seen by an orbiting camera, in painter's order.
//
// Outlines (z along the axis, r from it) turn about the axis from 45 to 315 degrees; the quarter
// about angle 0 is open and shows two cut faces. The projection is orthographic. The order is
// exact between sectors, not guessed from depths: all sight lines are parallel, so seen along the
// axis they move only towards the camera's own angle, and a sector hides what is at a larger angle
// from it. Within a sector (5 degrees) only the outlines' plane matters, and there each piece is
// painted after all that it hides.
#pragma once

#include "app/section/valve.h"

#include <glib.h>

enum {
  SB_REVOLVE_SECTORS = 54, // of the three quarters
  SB_REVOLVE_FACES = 2     // at +45 and -45 degrees
};

// The camera. Components of each vector: along the axis, towards the middle of the open quarter,
// and a quarter turn on from that.
typedef struct {
  double right[3], up[3], toward[3]; // unit vectors of the picture; `toward` the camera
} SbOrbit;

// Azimuth about the picture's vertical from the front, positive towards the rod's end; elevation
// above the horizontal [rad]. At 0, 0 the axis lies across the picture, canister left, and the
// open quarter points to the front and somewhat up.
SbOrbit sb_orbit(double azimuth, double elevation);

typedef enum {
  SB_REVOLVE_HOUSING,
  SB_REVOLVE_STEM,
  SB_REVOLVE_OUTER, // seal
  SB_REVOLVE_INNER,
  SB_REVOLVE_COUNT
} SbRevolveBody;

// A visible piece of surface: four corners in the picture [px, y down], how near each is [m] and
// its brightness from 0 to 1.
typedef struct {
  float x[4], y[4], depth[4], shade[4];
  SbRevolveBody solid;
} SbRevolveCell;

// A piece of an edge [px]. Of a silhouette also the unit vector away from its body, on which side
// its line has to be: later cells of the body may begin a pixel beside it. Otherwise zero.
typedef struct {
  float x[2], y[2], out_x, out_y;
} SbRevolveEdge;

typedef enum { SB_REVOLVE_CELLS, SB_REVOLVE_EDGES, SB_REVOLVE_FACE } SbRevolveKind;

// One step of painting: `count` cells or edges from `first`, or the cut face number `first`.
typedef struct {
  SbRevolveKind kind;
  size_t first, count;
} SbRevolveStep;

// Owns its arrays and reuses them from picture to picture.
typedef struct {
  SbOrbit orbit;
  double scale, x0, y0;           // px per m, and the pixel of the origin
  GArray *segment;                // of outlines
  GArray *cell;                   // SbRevolveCell
  GArray *edge;                   // SbRevolveEdge
  GArray *step;                   // SbRevolveStep, back to front
  GArray *facing, *piece, *place; // work space
} SbRevolve;

void sb_revolve_init(SbRevolve *revolve);
void sb_revolve_finish(SbRevolve *revolve);

// Starts a picture without bodies.
void sb_revolve_begin(SbRevolve *revolve, const SbOrbit *orbit, double scale, double x0, double y0);

// Adds a body: an outline counterclockwise with r up (r >= 0, m), closed by its first point.
// A smooth outline is shaded round, others have edges.
void sb_revolve_add(SbRevolve *revolve, SbRevolveBody solid, const SbValvePoint *point,
                    size_t count, bool smooth);

// Makes cells, edges and steps of all bodies.
void sb_revolve_build(SbRevolve *revolve);

// Angle of boundary k of the sectors, 0 to SB_REVOLVE_SECTORS [rad], and of a cut face.
double sb_revolve_angle(int k);
double sb_revolve_face_angle(int face);

// Place of a point (z, r) at an angle: x and y [px], nearness [m].
void sb_revolve_place(const SbRevolve *revolve, double z, double r, double angle, double out[3]);

// Whether a cut face is turned to the camera.
bool sb_revolve_face_shows(const SbRevolve *revolve, int face);

// Volume that the turned body encloses with its cut faces, as its surface is divided [m3].
double sb_revolve_volume(const SbRevolve *revolve, SbRevolveBody solid);
