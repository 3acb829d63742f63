// Shared by the readers of DXF, STEP and STL.
#pragma once

#include "app/base/error.h"
#include "app/base/number.h"
#include "app/base/unit.h"
#include "app/cad/cad.h"

#include "engine/numeric/arc.h"

#include <math.h>
#include <string.h>

// Processor time that sealbench-cad may use for one file [s], after which SIGXCPU ends it; time on
// the clock without any use of the processor [s], after which it ends itself by SIGALRM.
enum { SB_CAD_SECONDS_MAX = 60, SB_CAD_STALLED_MAX = 120 };

// Writes the point of a curve at t in [0, 1] to `xy`.
typedef void (*SbCadCurve)(const void *curve, double t, double xy[2]);

// Appends to `pieces` (of SbPiece) a chain of pieces that follow the curve `at(curve, t)` [m]
// from t = 0 to 1 within SB_CAD_TOLERANCE, first divided into `steps` >= 1 equal intervals of t.
// Returns false, with a part in `pieces`, if the curve is not finite or needs too many pieces.
bool sb_cad_curve(GArray *pieces, SbCadCurve at, const void *curve, int steps);

// Returns the arc from `from` through `middle` to `to`; straight if `middle` is on the line.
SbPiece sb_cad_arc(const double from[2], const double middle[2], const double to[2]);

// Largest number of pieces of a layer: each end is compared with each piece.
enum { SB_CAD_PIECES_MAX = 5000 };

// An outline, as a chain of pieces.
typedef struct {
  GArray *chain; // of SbPiece
  bool closed;   // else by the axis
  guint part;    // equal for outlines of lines that are connected
  bool unsure;   // lines within it are edges of the part or bound a bore
} SbCadOutline;

// What is drawn above the axis, or below it and mirrored. The caller provides the arrays.
typedef struct {
  GPtrArray *outlines; // of SbCadOutline
  GArray *pieces;      // of SbPiece: all those of the outlines; set by the caller
  GArray *alone;       // of SbPiece: they begin at an end that meets no other
  guint doubled;       // pieces drawn twice, of which one is ignored
  guint inner;         // pieces within an outline, which are ignored
  guint crossed;       // pieces of closed entities that bound nothing: they cross themselves
} SbCadLines;

// Finds the first outlines, of the pieces (of SbPiece) of closed entities, above the axis and
// closed by it. Ends within `gap` are one point, pieces within `same` are one [m]. Edges that two
// entities share vanish: they bound neither the material of both nor a recess, an outline at an
// edge.
void sb_cad_add_closed(SbCadLines *lines, const GArray *pieces, double gap, double same);

// Appends the outlines of other lines: the outer boundary of those that are connected. Lines within
// it are edges of shoulders if they are drawn twice, across the axis, or from the middle of a line
// to that of another; else the outline is unsure.
void sb_cad_add_open(SbCadLines *lines, const GArray *pieces, double gap, double same);

// Finds the outlines in `entities` (of GArray of SbPiece) about the line y = 0, with x as drawn
// and r = |y|: those above it, or below if there are none above. Ends within `gap` [m] are one
// point; the line y = 0 closes what ends on it. Appends those of entities that close by themselves
// and of other pieces, in any order, as bodies named `name`, for sb_cad_settle(), and warnings on
// what was ignored and on halves that differ.
void sb_cad_outlines(SbCad *cad, const GPtrArray *entities, const char *name, double gap);

// Sets the profile of a body, and `revolved`, from the pieces of its section in the plane of the
// axis (x along the axis, r = |y|, one half or both), joined as by sb_cad_outlines() (10 nm): the
// outline with the largest revolved volume, with a warning if there are several; or body->why.
void sb_cad_section(SbCad *cad, SbCadBody *body, const GArray *pieces);

// Returns a body with a copy of `name`, empty. Freed with its drawing.
SbCadBody *sb_cad_body_new(const char *name);

// Completes the bodies: applies `flip` and `shift`, orders the profiles counter-clockwise, checks
// them, and computes `revolved`, `solid` (unless `measured`) and the features. If a profile bounds
// no body, it becomes empty and `why` states the problem. A body within another one of its layer
// becomes its cavity. Warns for each measured body that is not one of revolution. Called once.
void sb_cad_settle(SbCad *cad, const SbCadChoices *choices);

// Returns the sentence SbCad.axis for an axis along `direction` [3] through the point `through` [3]
// [m]; `through` NULL: it names no point. Freed by g_free().
char *sb_cad_axis_text(const double *through, const double *direction);

// Returns a drawing without bodies. `format` is static. Freed by sb_cad_free().
SbCad *sb_cad_new(const char *format);

// Writes volume [mm3], centre [mm] and moments about it [mm5], at 1 kg per mm3, of the body with
// this tag in gmsh's kernel; not `mass`. Writes to *coarse whether they can be wrong by 1 %.
// Returns false if the kernel cannot measure it. Only in sealbench-cad.
bool sb_cad_measure(SbSolid *solid, int body, bool *coarse);

// Returns the faces, freed by gmshFree(), that a body and the half-plane y > 0, z = 0 have in
// common, their number, and the volume of their revolution [mm3] by the theorem of Pappus. `box`:
// that of the body. *failed: the kernel cannot cut it. Only in sealbench-cad.
int *sb_cad_cut(size_t *count, double *volume, bool *failed, int body, const double box[6]);

// Reads a STEP file by sealbench-cad into a settled drawing (sb_cad_settle()). Errors as
// sb_cad_read().
SbCad *sb_cad_read_step(const char *path, const SbCadChoices *choices, GError **error);

// Returns whether bytes are an STL file: the size fits the binary header, or "solid" is first.
bool sb_cad_is_stl(const char *data, gsize length);

// Reads the bytes of an STL file `path`, after which bodies are named. Errors as sb_cad_read().
SbCad *sb_cad_parse_stl(const char *data, gsize length, const char *path,
                        const SbCadChoices *choices, GError **error);
