// Bodies of drawings: half-sections, volume and moments of inertia of the parts in a DXF, STEP or
// STL file, and the lands, bores and grooves on them.
// A STEP file is read by the program sealbench-cad (gmsh with OpenCASCADE), which runs with limits
// of time and memory, finds the axis, cuts the bodies by a half-plane through it and measures them.
// An STL is a mesh: each of its connected shells is a body, which is measured and cut here. In a
// DXF each closed outline is a body, or a cavity of the one around it on its layer. All give
// half-profiles of straight pieces and arcs in the form of the key [part.NAME] profile; other
// curves are approximated by arcs within SB_CAD_TOLERANCE. Of several outlines of a cut body, the
// profile is that with the largest revolved volume; `solid` is always the complete body.
// Coordinates: x along the axis of the bodies, 0 where the file's origin projects on it, then
// reversed (`flip`) and moved (`shift`); r is the distance from the axis. The largest component of
// an axis that was found is positive. The valve requires x to point out of the canister.
#pragma once

#include "app/base/reader.h"

#include "engine/mechanism/solid.h"

#include <glib.h>
#include <stdbool.h>

// Largest number of bodies of a file.
enum { SB_CAD_BODIES_MAX = 200 };

// Largest distance of an arc from the curve that it approximates [m].
#define SB_CAD_TOLERANCE 0.1e-6

// A land and a groove are on the outer surface of a body, a bore is an inner surface.
typedef enum { SB_CAD_LAND, SB_CAD_BORE, SB_CAD_GROOVE } SbCadKind;

// A stretch of a half-section with one diameter.
typedef struct {
  double x0, x1;   // ends, x0 < x1 [m]; of a groove its walls
  double diameter; // of the surface [m]; of a groove that of its floor
  double depth;    // of a groove, from the lower of its two shoulders [m]; else 0
  SbCadKind kind;
} SbCadFeature;

// A body of revolution.
typedef struct {
  char *name;       // of the body or layer; "body 2" if the file has none
  GArray *profile;  // of SbProfilePoint, in the order of SbProfile; empty: no half-section
  bool closed;      // as SbProfile.closed
  char *why;        // why the profile is empty; else NULL
  SbSolid revolved; // of the revolved half-section, with a density of 1 kg/m3
  double hollow;    // volume of the cavities that the half-section shows, not in the profile [m3]
  bool measured;    // `solid` is from the file's geometry: a STEP body, an STL, a DXF with cavities
  guint layer;      // equal for the outlines of one layer or section
  SbSolid solid;    // of the body with a density of 1 kg/m3, its axis along x; else as `revolved`
  GArray *features; // of SbCadFeature, in the order of x
} SbCadBody;

// A drawing. Freed by sb_cad_free().
typedef struct {
  const char *format;  // "DXF", "STEP" or "STL"; static
  char *unit;          // of the file, such as "mm"
  char *axis;          // sentence for the user on the axis of revolution
  GPtrArray *bodies;   // of SbCadBody
  GPtrArray *warnings; // of char *: sentences on what was omitted or assumed
  double apart;        // largest gap in lines that close to no outline [m]; 0: none
} SbCad;

// What the caller states about a drawing. Initialise with zeros: as the file states, or as found.
typedef struct {
  // Unit of the coordinates of a DXF or STL: any unit of length that udunits-2 knows ("mm",
  // "inch"); NULL: the unit that a DXF states, or the only one of mm, cm, inch, m and um in which
  // an STL has the size of a valve's part. Not for STEP.
  const char *unit;
  // Direction of the axis [3] in the file's axes, not zero. NULL: DXF: its longest centre line,
  // else x; STEP: found from the normals of the round faces, x for a ball; STL: the axis of
  // rotational symmetry by the moments of inertia, a coordinate axis if that is nearly one.
  const double *axis;
  // A point of the axis [3] [m]. NULL: DXF: the centre line, else the origin; STEP: found with the
  // direction; STL: the middle of the mesh.
  const double *through;
  // Angle of the cutting half-plane about the axis, right-handed [rad]; not for DXF. 0: STEP: the y
  // axis of the file, turned with x when x is turned to the axis by the shortest way; STL: the
  // file's axis after the one nearest to the axis (x after z), made perpendicular to it. NULL:
  // STEP: 37.7 degrees; STL: through a vertex farthest from the axis; the largest of eight
  // half-sections where that one, revolved, has another volume than the body.
  const double *angle;
  double join;  // DXF: largest gap between ends that are one point [m]; 0: 1 um
  double shift; // added to x after `flip` [m]
  bool flip;    // reverse x: for a drawing with the canister on its right
  bool section; // DXF: full sections anywhere; the axis is a line y = constant below all of them
} SbCadChoices;

// Reads the file `path`; its format follows from its content. Returns NULL with an error, mostly
// SB_APP_ERROR_INPUT: not readable, no bodies, ambiguous unit, refused, no sealbench-cad in this
// build, or its limits exceeded. A STEP blocks the calling thread for up to a minute.
SbCad *sb_cad_read(const char *path, const SbCadChoices *choices, GError **error);

// Frees a drawing with its bodies.
void sb_cad_free(SbCad *cad);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbCad, sb_cad_free)

// As sb_cad_read(), from the `length` bytes of a DXF; `name` is used as its path in messages.
SbCad *sb_cad_parse_dxf(const char *text, gsize length, const char *name,
                        const SbCadChoices *choices, GError **error);

// ---- Half-profiles as text, the value of the key [part.NAME] profile ----
// A unit of length (any that udunits-2 knows), then x,r or x,r,bulge of each point, separated by
// blanks or line ends. x is axial, r the distance from the axis, bulge as in SbProfilePoint. A text
// that repeats its first point is closed; another one is closed by the axis. An example:
#define SB_PROFILE_FORM "mm 0,0 10,0 10,2 0,2"

// Returns the points [m] of a text, 2 to SB_PROFILE_MAX, as an array of SbProfilePoint to be freed
// by g_array_unref(). *closed is set to whether the text repeats its first point, which the result
// does not contain twice. NULL with SB_APP_ERROR_INPUT: no unit, not numbers, too few or too many
// points. Orientation and crossings are not checked (sb_profile_check()).
GArray *sb_profile_parse(const char *text, bool *closed, GError **error);

// Orders the points (of SbProfilePoint) counter-clockwise in the (x, r) plane, as SbProfile
// requires: reverses them in place, with their bulges, if they are clockwise. `closed`: a piece
// from the last point to the first closes the outline; else the axis does.
void sb_profile_turn(GArray *points, bool closed);

// Returns the half-profile of a body as such a text, in mm; NULL if the profile is empty.
char *sb_cad_profile_text(const SbCadBody *body);

// ---- Meshes ----
// Triangle meshes from STL files, binary or text. The format states no unit: the caller states it.
// STL repeats its corners, and rounds each time. Corners that differ by at most 1e-5 of the
// diagonal of the part's bounding box along every axis (or by two units of single precision, far
// from the origin) become one vertex, the first of them. Triangles that lose a corner by that are
// removed. Volume and moments change by as much. A file that is not STL, is incomplete,
// has more than SB_STL_TRIANGLES_MAX triangles or a number that is not finite is refused.
enum { SB_STL_TRIANGLES_MAX = 2000000 };

// A mesh. Freed by sb_stl_clear().
typedef struct {
  double *vertices;     // [vertex_count][3]: x, y, z in the file's axes [m]
  unsigned *triangles;  // [triangle_count][3]: vertex indices from 0, in the file's order
  gsize *body;          // [triangle_count]: number of its body, below triangle_count
  gsize vertex_count;   //
  gsize triangle_count; //
  gsize turned;         // triangles reversed to face outwards (sb_mesh_orient())
} SbStl;

// Reads the `length` bytes of the file `path`, NULL: the file itself. Its numbers are in `unit`:
// any unit of length that udunits-2 knows ("mm", "um", "inch", "m", ...). Returns FALSE with
// SB_APP_ERROR_IO (the file cannot be read) or SB_APP_ERROR_INPUT (its contents, or the unit); the
// message names the file and the place. *out is then empty. *out is overwritten: clear an earlier
// mesh first.
gboolean sb_stl_read(SbStl *out, const char *data, gsize length, const char *unit, const char *path,
                     GError **error);

// Writes the corners of the bounding box of points[count][3]; of no points, INFINITY and -INFINITY.
void sb_stl_extent(const double *points, gsize count, double low[3], double high[3]);

// Frees the arrays; the mesh is then empty and may be cleared again. Takes NULL.
void sb_stl_clear(SbStl *stl);
